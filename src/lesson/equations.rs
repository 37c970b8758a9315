//! The equation that each step solves, with its table, for the page.
//!
//! This module decides which table belongs to a step and which of its columns the step draws. The
//! text is that of [`crate::report::equation`]; the page shows the columns of the step in colour
//! and those of later steps in grey.

use serde_json::{Value, json};

use crate::construct::{Action, Polygon};
use crate::construction::MarkId;
use crate::equilibrium::{Act, ForceEdge};
use crate::figure::tables::found_by;
use crate::notation::Notation;
use crate::plan::text::{EquationColumn, PlanWriter};
use crate::plan::{PlanStep, Term};
use crate::report::equation::{WrittenStep, written};
use crate::scene::{DiagramKind, Lang, LinkId};

use super::acts::{acts, acts_of_forces};
use super::bank::{Formulas, runs};
use super::frames::{Frames, SolvedFrame, groups};
use super::steps::{LANGS, writer};

/// Returns the texts of the equations for the page, and the variant of the construction in each
/// frame.
///
/// * `written`: a table is a list of columns (sign before it, symbol, direction, magnitude: indices
///   of formulas, −1 for none), a statement is an object with both languages.
/// * `variants`: for each polygon, then for each group's forces, and for each of its actions: 0, or
///   the index of the text and the columns that the action draws.
/// * `acts`: for each variant and polygon the data of its actions ([`super::acts`]).
/// * `frames`: runs of variants, −1 for none; 0 if all frames have the first.
pub fn equations(frames: &Frames, notation: &Notation, formulas: &mut Formulas) -> Value {
    let mut table = EquationTexts { written: Vec::new() };
    let (mut variants, mut about): (Vec<Value>, Vec<Value>) = (Vec::new(), Vec::new());
    let mut known: Vec<&SolvedFrame> = Vec::new();
    let mut which: Vec<i64> = Vec::new();
    for frame in &frames.list {
        if frame.end {
            which.push(-1);
            continue;
        }
        let index = known.iter().position(|k| alike(k, frame)).unwrap_or_else(|| {
            known.push(frame);
            let mut levels =
                DiagramKind::POLYGONS.map(|on| table.level(frame, on, notation, formulas)).to_vec();
            levels.extend(
                frames.groups.iter().map(|links| table.forces(frame, links, notation, formulas)),
            );
            variants.push(json!(levels));
            let mut list =
                DiagramKind::POLYGONS.map(|on| acts(frame, on, notation, formulas)).to_vec();
            list.extend(
                frames.groups.iter().map(|links| acts_of_forces(frame, links, notation, formulas)),
            );
            about.push(json!(list));
            known.len() - 1
        });
        which.push(index as i64);
    }
    let which = if which.iter().all(|v| *v == 0) { json!(0) } else { json!(runs(&which)) };
    json!({"written": table.written, "variants": variants, "acts": about, "frames": which, "direction_first": notation.first_row == "direction"})
}

/// True if two frames are drawn by the same equations in the same steps.
fn alike(a: &SolvedFrame, b: &SolvedFrame) -> bool {
    let forces = || {
        groups(&a.worked) == groups(&b.worked)
            && a.shown.contains(&DiagramKind::Force) == b.shown.contains(&DiagramKind::Force)
    };
    a.worked.plan == b.worked.plan
        && a.worked.construction.acts == b.worked.construction.acts
        && forces()
}

/// The terms that an action draws.
fn drawn(p: &Polygon, action: usize) -> Vec<Term> {
    let of_edges =
        |edges: &[usize]| edges.iter().flat_map(|e| p.edges[*e].terms.iter().copied()).collect();
    match &p.actions[action] {
        Action::LayOff(edge) => of_edges(&[*edge]),
        Action::Cross { edges, .. } => of_edges(edges),
        Action::Nothing { terms, .. } | Action::Line { terms, .. } => terms.clone(),
        Action::Join(edge) => of_edges(&[*edge]),
        Action::Perpendicular { edges, .. } => of_edges(edges),
        Action::Reach(_)
        | Action::Trials { .. }
        | Action::Copy { .. }
        | Action::Same { .. }
        | Action::Rate(_) => Vec::new(),
    }
}

/// The action that solves an equation, the index of its text, and its columns.
type SolvedEquation = (usize, Option<usize>, Vec<EquationColumn>);

/// Texts of all frames, each stored once.
struct EquationTexts {
    written: Vec<Value>,
}

impl EquationTexts {
    fn index(&mut self, value: Value) -> usize {
        self.written.iter().position(|w| *w == value).unwrap_or_else(|| {
            self.written.push(value);
            self.written.len() - 1
        })
    }

    /// For each action of a polygon: 0, or the index of its text and the columns that it draws.
    fn level(
        &mut self,
        frame: &SolvedFrame,
        on: DiagramKind,
        notation: &Notation,
        formulas: &mut Formulas,
    ) -> Vec<Value> {
        let (paper, plan) = (&frame.worked.construction, &frame.worked.plan);
        let Some(polygon) = paper.polygon(on) else { return Vec::new() };
        let writers = LANGS.map(|lang| PlanWriter { scene: &frame.scene, plan, notation, lang });
        let mut all: Vec<SolvedEquation> = Vec::new();
        for group in plan.steps(on) {
            for step in group.steps(group.drawn(paper.acts.chosen[group.group])) {
                let (Some(found), [Some(en), Some(zh)]) = (
                    found_by(polygon, step.target()),
                    writers.map(|w| written(&w, paper, on, step)),
                ) else {
                    continue;
                };
                match (en, zh, step) {
                    (WrittenStep::Table(columns), ..) => {
                        let cells: Vec<Value> =
                            columns.iter().map(|c| cells(c, formulas)).collect();
                        all.push((found, Some(self.index(json!(cells))), columns));
                    }
                    (WrittenStep::Line(en), WrittenStep::Line(zh), PlanStep::Equation { .. }) => {
                        let both = [en, zh].map(|line| formulas.phrase(&line));
                        all.push((found, Some(self.index(json!({"line": both}))), Vec::new()));
                    }
                    // The sentence of such a step states the same.
                    _ => all.push((found, None, Vec::new())),
                }
            }
        }
        (0..polygon.actions.len()).map(|action| of_action(polygon, action, &all)).collect()
    }
}

impl EquationTexts {
    /// For each step of a group's equilibrium after the first: 0, or its equation and the columns
    /// that the step draws.
    fn forces(
        &mut self,
        frame: &SolvedFrame,
        links: &[LinkId],
        notation: &Notation,
        formulas: &mut Formulas,
    ) -> Vec<Value> {
        let Some((w, group)) = writer(frame, links, notation, Lang::En) else { return Vec::new() };
        let [known, unknown, plus, end] = [&notation.known, &notation.unknown, "+", "= 0"]
            .map(|text| formulas.formula(text) as i64);
        let equations: Vec<(usize, Vec<ForceEdge>)> = w
            .equations(group)
            .into_iter()
            .map(|sides| {
                let column = |(k, s): (usize, &ForceEdge)| {
                    let symbol = formulas.formula(&notation.vectors.write(w.symbol(s.term))) as i64;
                    json!([
                        if k > 0 { plus } else { -1 },
                        symbol,
                        known,
                        if s.known { known } else { unknown }
                    ])
                };
                let mut columns: Vec<Value> = sides.iter().enumerate().map(column).collect();
                columns.push(json!([end, -1, -1, -1]));
                (self.index(json!(columns)), sides)
            })
            .collect();
        let crossed = |side: &ForceEdge, to: MarkId| {
            let v = &w.of.construction.vectors[side.vector.index()];
            !side.known && [v.from, v.to].contains(&to)
        };
        let drawn = |act: &Act, side: &ForceEdge| match act {
            Act::Lay(own) | Act::Read(own) => own.vector == side.vector,
            Act::Cross(to) => crossed(side, *to),
            Act::Free | Act::Friction | Act::Moments(_) => false,
        };
        let of_act = |act: &Act| {
            let columns = |sides: &[ForceEdge]| {
                (0..sides.len()).filter(|k| drawn(act, &sides[*k])).collect::<Vec<_>>()
            };
            let found = equations
                .iter()
                .map(|(index, sides)| (*index, columns(sides)))
                .find(|(_, columns)| !columns.is_empty());
            found.map_or(json!(0), |(index, columns)| {
                json!([index].into_iter().chain(columns).collect::<Vec<_>>())
            })
        };
        w.of.acts(group).iter().skip(1).map(of_act).collect()
    }
}

/// Assigns an action to the first equation that is solved at it or after it; an action that only
/// reads a value belongs to none.
fn of_action(polygon: &Polygon, action: usize, all: &[SolvedEquation]) -> Value {
    if polygon.actions[action].reads() {
        return json!(0);
    }
    let Some((found, Some(index), columns)) = all.iter().find(|(found, ..)| *found >= action)
    else {
        return json!(0);
    };
    let terms = drawn(polygon, action);
    // The unknown vector comes before the equals sign and is found last.
    let sought = |k: usize, c: &EquationColumn| k == 0 && c.term.is_none() && *found == action;
    let now = |(k, c): &(usize, &EquationColumn)| {
        c.term.is_some_and(|t| terms.contains(&t)) || sought(*k, c)
    };
    let mut told = vec![*index];
    told.extend(columns.iter().enumerate().filter(now).map(|(k, _)| k));
    json!(told)
}

fn cells(c: &EquationColumn, formulas: &mut Formulas) -> Value {
    let mut cell = |text: &str| if text.is_empty() { -1 } else { formulas.formula(text) as i64 };
    json!([cell(c.joint), cell(&c.symbol), cell(&c.direction), cell(&c.magnitude)])
}
