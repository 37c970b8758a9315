//! The equations that were tried for each group, with their unknowns, and those that are taken
//! (方程可解与不可解), as text and JSON.

use crate::plan::{group_words, method_words, table};
use hodograph_base::diag::{Both, both};
use hodograph_base::lang::{say, tr};
use hodograph_board::plan::text::{PlanWriter, vertex_name};
use hodograph_board::plan::tried::{GroupTrial, PointTrial, unknowns};
use hodograph_board::plan::{PlanStep, TermChain, VertexId};
use hodograph_mechanism::mechanism::Mechanism;
use hodograph_paper::paper::phrase::formula;
use hodograph_scene::DiagramKind;
use serde_json::{Value as Json, json};

/// Returns the trials as text. `w` writes the plan that comes with them.
pub fn text(m: &Mechanism, w: &PlanWriter, tried: &[GroupTrial]) -> String {
    let lang = w.lang;
    let mut out = String::new();
    for on in DiagramKind::POLYGONS {
        let groups: Vec<&GroupTrial> = tried.iter().filter(|t| t.on == on).collect();
        if groups.iter().all(|t| t.points.is_empty()) {
            continue;
        }
        let what = lang.of(&on.vectors()).to_owned();
        out += &say!(lang, "\n{what}: points tried, and the unknowns of their equations\n");
        for trial in groups.iter().filter(|t| !t.points.is_empty()) {
            if let Some(group) = m.assur_of(w.scene, trial.group) {
                out += &format!("  {}\n", group_words(w.scene, m, &group, lang));
            }
            for point in &trial.points {
                let name = point_name(w, point.target);
                out += &format!("    {}\n", tr!(lang, "try {}").replace("{}", &name));
                if !point.chains.is_empty() {
                    out += &equation(w, on, point.target, &point.chains);
                }
                out += &format!("      {}\n", lang.of(&verdict(w, point)));
            }
            out += &taken(w, trial);
        }
    }
    out
}

/// The table of an equation.
fn equation(w: &PlanWriter, on: DiagramKind, target: VertexId, chains: &[TermChain]) -> String {
    let lines = table(w.lang, &w.columns(on, target, chains));
    lines.iter().map(|line| format!("      {}\n", line.trim_end())).collect()
}

/// The name of a point: with its link for one of several coincident points.
fn point_name(w: &PlanWriter, v: VertexId) -> String {
    vertex_name(w.scene, w.plan, v)
}

/// The number of unknowns in words.
fn verdict(w: &PlanWriter, point: &PointTrial) -> Both {
    if point.chains.is_empty() {
        return both!("no known point on its links: there is no equation");
    }
    counted(w, &point.chains)
}

fn counted(w: &PlanWriter, chains: &[TermChain]) -> Both {
    let [open, settled] = unknowns(w.plan, chains);
    if open > 0 && settled == 0 {
        both!("its direction is known, and no equation gives its magnitude: not solvable")
    } else if open <= settled {
        both!("{open} unknowns: solvable")
    } else {
        both!("{open} unknowns, a plane equation settles {settled}: not solvable")
    }
}

/// The steps that are taken: an equation that was not among the trials with its table.
fn taken(w: &PlanWriter, trial: &GroupTrial) -> String {
    let lang = w.lang;
    let mut out = String::new();
    for step in steps(w, trial) {
        let name = |v: VertexId| formula(&w.vector(trial.on, v));
        match step {
            PlanStep::Equation { target, chains, method } => {
                out += &format!(
                    "    {}{} — {}\n",
                    tr!(lang, "taken: "),
                    name(*target),
                    method_words(*method, lang)
                );
                let known = |p: &PointTrial| p.target == *target && p.is_solvable(w.plan);
                if !trial.points.iter().any(known) {
                    out += &equation(w, trial.on, *target, chains);
                    out += &format!("      {}\n", lang.of(&counted(w, chains)));
                }
            }
            PlanStep::Image { target, .. } => {
                out += &format!("    {} — {}\n", name(*target), tr!(lang, "image"));
            }
            PlanStep::Same { .. } | PlanStep::Trials { .. } => {}
        }
    }
    out
}

/// The steps of a group on its diagram.
fn steps<'a>(w: &PlanWriter<'a>, trial: &GroupTrial) -> Vec<&'a PlanStep> {
    let groups = w.plan.steps(trial.on).iter().filter(|g| g.group == trial.group);
    groups.flat_map(|g| g.steps(0)).collect()
}

/// Returns the trials for programs.
pub fn json(w: &PlanWriter, tried: &[GroupTrial]) -> Json {
    let written = |on: DiagramKind, target: VertexId, chains: &[TermChain]| {
        let columns = if chains.is_empty() { Vec::new() } else { w.columns(on, target, chains) };
        let text: Vec<String> = columns
            .iter()
            .map(|c| format!("{} {}", c.joint, formula(&c.symbol)).trim().to_owned())
            .collect();
        let [open, settled] = unknowns(w.plan, chains);
        json!({
            "point": point_name(w, target),
            "equation": text.join(" "),
            "unknowns": open,
            "settled": settled,
            "solvable": open <= settled,
        })
    };
    let group = |t: &GroupTrial| {
        let taken: Vec<Json> = steps(w, t)
            .into_iter()
            .filter_map(|step| match step {
                PlanStep::Equation { target, chains, .. } => Some(written(t.on, *target, chains)),
                PlanStep::Image { .. } | PlanStep::Same { .. } | PlanStep::Trials { .. } => None,
            })
            .collect();
        let points: Vec<Json> =
            t.points.iter().map(|p| written(t.on, p.target, &p.chains)).collect();
        json!({"diagram": t.on.word(), "group": t.group, "points": points, "taken": taken})
    };
    json!(tried.iter().filter(|t| !t.points.is_empty()).map(group).collect::<Vec<_>>())
}
