//! Data of the page about each action of the construction: the links that it highlights, the line
//! of the mechanism to which its vector is perpendicular or parallel, and the data by which the
//! page judges a wrong guess.

use serde_json::{Value, json};

use crate::construct::{Action, PlanDrawing, Polygon};
use crate::equilibrium;
use crate::notation::Notation;
use crate::plan::text::PlanWriter;
use crate::plan::{Term, TermConnection, TermKind, TurningBody, VertexId};
use crate::scene::{DiagramKind, Lang, LinkId, Scene};

use super::bank::Formulas;
use super::frames::SolvedFrame;
use super::steps::writer;

/// Returns, for each action of a polygon, its kind, its links, and the data of its first term; −1
/// where there is none.
///
/// * Kind: `l` a vector laid off, `d` a direction, `x` a crossing, `c` a copied image, `j` two
///   points joined, `p` a perpendicular; empty where nothing is drawn.
/// * Vertices: the term's own vertex and the vertex from which it is seen; for a crossing or an
///   image the vertex found, and −1.
/// * Sense, decided by: `t` an angular velocity or acceleration, `n` a centre, `k` an angular
///   velocity and a sliding velocity, `s` a sliding velocity.
/// * Formulas of symbol, direction, line and angular velocity or acceleration.
pub fn acts(
    frame: &SolvedFrame,
    on: DiagramKind,
    notation: &Notation,
    formulas: &mut Formulas,
) -> Vec<Value> {
    let (scene, paper) = (&frame.scene, &frame.worked.construction);
    let Some(p) = paper.polygon(on) else { return Vec::new() };
    let w = PlanWriter { scene, plan: &frame.worked.plan, notation, lang: Lang::En };
    p.actions.iter().map(|a| PolygonActs { w: &w, on, p, paper }.action_json(a, formulas)).collect()
}

/// [`acts`] for the equilibrium of some links: known forces are laid off, and lines cross in a
/// vertex without number.
pub fn acts_of_forces(
    frame: &SolvedFrame,
    links: &[LinkId],
    notation: &Notation,
    formulas: &mut Formulas,
) -> Vec<Value> {
    let Some((w, group)) = writer(frame, links, notation, Lang::En) else { return Vec::new() };
    let own: Vec<usize> = group.links.iter().map(|l| l.0).collect();
    let of = |act: &equilibrium::Act| match act {
        equilibrium::Act::Lay(side) => {
            let symbol = formulas.formula(&notation.vectors.write(w.symbol(side.term)));
            json!(["l", own, -1, -1, "", symbol, -1, -1, -1])
        }
        equilibrium::Act::Cross(_) => json!(["x", own, -1, -1]),
        equilibrium::Act::Free
        | equilibrium::Act::Friction
        | equilibrium::Act::Moments(_)
        | equilibrium::Act::Read(_) => {
            json!(["", own, -1, -1])
        }
    };
    // The first step has no number.
    w.of.acts(group).iter().skip(1).map(of).collect()
}

struct PolygonActs<'a> {
    w: &'a PlanWriter<'a>,
    on: DiagramKind,
    p: &'a Polygon,
    paper: &'a PlanDrawing,
}

impl PolygonActs<'_> {
    fn action_json(&self, action: &Action, formulas: &mut Formulas) -> Value {
        let of_edges = |edges: &[usize]| {
            edges.iter().flat_map(|e| self.p.edges[*e].terms.clone()).collect::<Vec<Term>>()
        };
        match action {
            Action::LayOff(e) => self.of_terms("l", &of_edges(&[*e]), formulas),
            Action::Line { terms, .. } => self.of_terms("d", terms, formulas),
            Action::Join(e) => self.of_terms("j", &of_edges(&[*e]), formulas),
            Action::Perpendicular { edges, .. } => self.of_terms("p", &of_edges(edges), formulas),
            Action::Cross { target, edges, .. } => {
                json!(["x", self.links(&of_edges(edges)), target.0, -1])
            }
            Action::Trials { target, .. } => json!(["x", self.of_vertex(*target), target.0, -1]),
            Action::Copy { target, .. } => json!(["c", self.of_vertex(*target), target.0, -1]),
            Action::Reach(v) | Action::Same { target: v, .. } => {
                json!(["", self.of_vertex(*v), v.0, -1])
            }
            Action::Nothing { terms, .. } => self.of_terms("", terms, formulas),
            Action::Rate(r) => json!([
                "",
                self.paper.rates.get(*r).map_or_else(Vec::new, |r| of_body(self.w.scene, r.body)),
                -1,
                -1
            ]),
        }
    }

    fn of_terms(&self, kind: &str, terms: &[Term], formulas: &mut Formulas) -> Value {
        let [first, ..] = terms else { return json!([kind, [], -1, -1]) };
        let direction = self.w.direction(first);
        let line = ["\\perp ", "\\parallel "]
            .iter()
            .find_map(|sign| direction.strip_prefix(sign))
            .unwrap_or_default();
        let symbols: Vec<String> = terms.iter().map(|t| self.w.symbol(self.on, t)).collect();
        let told = if direction == self.w.notation.unknown { "" } else { direction.as_str() };
        let mut formula =
            |text: &str| if text.is_empty() { -1 } else { formulas.formula(text) as i64 };
        json!([
            kind,
            self.links(terms),
            first.of.0,
            first.to.0,
            sense(first),
            formula(&symbols.join(" + ")),
            formula(told),
            formula(line),
            formula(&self.turning(first))
        ])
    }

    /// The angular velocity or acceleration that decides a term's sense.
    fn turning(&self, t: &Term) -> String {
        let (on, body) = match (t.kind, t.by) {
            (TermKind::Coriolis, TermConnection::Guide { guide, .. }) => {
                (DiagramKind::Velocity, Some(TurningBody::Link(self.w.scene.guides[guide.0].on)))
            }
            (TermKind::Coriolis, TermConnection::Frame { body, .. }) => {
                (DiagramKind::Velocity, body)
            }
            (TermKind::Coriolis, TermConnection::Cylinder(d)) => {
                (DiagramKind::Velocity, Some(TurningBody::Cylinder(d)))
            }
            (_, TermConnection::Turning(body)) => (self.on, Some(body)),
            (
                _,
                TermConnection::Guide { .. }
                | TermConnection::Cylinder(_)
                | TermConnection::Contact(_)
                | TermConnection::Frame { .. }
                | TermConnection::Apart,
            ) => return String::new(),
        };
        body.map_or_else(String::new, |body| self.w.turning(on, body))
    }

    /// The links to whose motion the terms belong, each once.
    fn links(&self, terms: &[Term]) -> Vec<usize> {
        let mut links: Vec<usize> = terms.iter().flat_map(|t| self.of_term(t)).collect();
        links.sort_unstable();
        links.dedup();
        links
    }

    fn of_term(&self, t: &Term) -> Vec<usize> {
        let scene = self.w.scene;
        match t.by {
            TermConnection::Turning(body) | TermConnection::Frame { body: Some(body), .. } => {
                of_body(scene, body)
            }
            TermConnection::Cylinder(d) => of_body(scene, TurningBody::Cylinder(d)),
            TermConnection::Guide { guide, .. } => {
                let g = &scene.guides[guide.0];
                [Some(g.on), g.slider]
                    .into_iter()
                    .flatten()
                    .filter(|l| *l != scene.ground)
                    .map(|l| l.0)
                    .collect()
            }
            TermConnection::Contact(_)
            | TermConnection::Frame { body: None, .. }
            | TermConnection::Apart => {
                let on = |v: VertexId| {
                    self.w.plan.vertex(v).link(scene).filter(|l: &LinkId| *l != scene.ground)
                };
                [on(t.of), on(t.to)].into_iter().flatten().map(|l| l.0).collect()
            }
        }
    }

    fn of_vertex(&self, v: VertexId) -> Vec<usize> {
        self.w.plan.vertex(v).link(self.w.scene).into_iter().map(|l| l.0).collect()
    }
}

fn of_body(scene: &Scene, body: TurningBody) -> Vec<usize> {
    match body {
        TurningBody::Link(l) => vec![l.0],
        TurningBody::Cylinder(d) => scene.drivers[d].kind.parts().iter().map(|l| l.0).collect(),
    }
}

/// Quantity that decides the sense of a term along its line.
fn sense(t: &Term) -> &'static str {
    match t.kind {
        TermKind::Relative | TermKind::Tangential => "t",
        TermKind::Normal | TermKind::SlideNormal => "n",
        TermKind::Coriolis => "k",
        TermKind::Slide | TermKind::Extension | TermKind::Roll | TermKind::Gap => "s",
    }
}
