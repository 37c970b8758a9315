//! One step of a plan in writing: an equation with its table, or a statement in one line.
//!
//! This module decides which equations need a table. Worksheets and lessons use its result.

use hodograph_base::lang::{say, tr};
use hodograph_board::construct::PlanDrawing;
use hodograph_board::plan::names::mate_letter;
use hodograph_board::plan::text::{EquationColumn, PlanWriter};
use hodograph_board::plan::{PlanStep, TermChain, VertexId};
use hodograph_paper::paper::phrase::{Phrase, fill};
use hodograph_paper::paper::words::words;
use hodograph_scene::DiagramKind;

/// The written form of a step.
#[derive(Clone, Debug, PartialEq)]
pub enum WrittenStep {
    /// A statement.
    Line(Phrase),
    /// An equation with the magnitudes and directions of its vectors.
    Table(Vec<EquationColumn>),
}

/// Returns the equation of a step of a polygon as it is drawn; `None` for a step without text.
pub fn written(
    w: &PlanWriter,
    paper: &PlanDrawing,
    on: DiagramKind,
    step: &PlanStep,
) -> Option<WrittenStep> {
    let line = |text: String| Some(WrittenStep::Line(Phrase::new(&text)));
    match step {
        PlanStep::Equation { target, chains, .. } => equation(w, on, *target, chains),
        PlanStep::Image { target, from, link } => {
            let images =
                format!("{}{}{}", w.image(on, from.0), w.image(on, from.1), w.image(on, *target));
            let spots = format!("{}{}{}", w.spot(from.0), w.spot(from.1), w.spot(*target));
            let (vector, link) = (w.vector(on, *target), w.scene.link_name(*link));
            let parts = |[a, b, x]: [String; 3]| format!("{a}{b}/{a}{x}");
            let all = [from.0, from.1, *target];
            let ratio = || {
                format!(
                    "{} = {}",
                    parts(all.map(|v| w.image(on, v))),
                    parts(all.map(|v| w.spot(v)))
                )
            };
            line(match paper.diagram.in_line(all) {
                true => say!(
                    w.lang,
                    "${vector}$ by the image of link {link}, points in line: ${}$.",
                    ratio()
                ),
                false => say!(
                    w.lang,
                    "${vector}$ by the image of link {link}: ${images}$ is similar to ${spots}$, letters in the same order."
                ),
            })
        }
        PlanStep::Trials { target, images, mates } => {
            let [vector, image] = [w.vector(on, *target), w.image(on, *target)];
            let [a, b] = [images, mates].map(|pair| pair.map(|v| w.image(on, v)).concat());
            line(say!(
                w.lang,
                "${vector}$: ${image}$ lies where the lines ${a}$ and ${b}$ of the two trials cross."
            ))
        }
        PlanStep::Same { target, from, link } => {
            let why = words(w.lang).no_turning.replace("{}", w.scene.link_name(*link));
            let formula = format!("{} = {}", w.summand(on, *target), w.summand(on, *from));
            line(format!("${formula}${}{why}", tr!(w.lang, ": ")))
        }
    }
}

/// Returns the sentence that introduces the mate of a trial, at the step that first finds it.
pub fn mate(w: &PlanWriter, step: &PlanStep) -> Option<String> {
    let [point, bar] = w.mate(step)?;
    Some(fill(words(w.lang).mate, &[("X", mate_letter(w.scene)), ("1", &point), ("", &bar)]))
}

fn equation(
    w: &PlanWriter,
    on: DiagramKind,
    target: VertexId,
    chains: &[TermChain],
) -> Option<WrittenStep> {
    let vector = w.vector(on, target);
    let line = |text: String| Some(WrittenStep::Line(Phrase::new(&text)));
    if let [chain] = chains
        && w.plan.vertex(chain.start).fixed
        && let [term] = chain.known[..]
    {
        // One known term: a driven point, or a point on a known link.
        let (part, magnitude, direction) =
            (w.symbol(on, &term), w.magnitude(on, &term), w.direction(&term));
        let head = if vector == part { vector } else { format!("{vector} = {part}") };
        let known =
            if magnitude == w.notation.known { String::new() } else { format!(" = {magnitude}") };
        let given = if known.is_empty() { tr!(w.lang, " (given)") } else { "" };
        return line(format!(
            "${head}{known}${given}{}${direction}$",
            tr!(w.lang, "clause" => ", ")
        ));
    }
    if let [chain] = chains
        && chain.known.is_empty()
        && chain.unknown.is_empty()
    {
        let start = if w.plan.vertex(chain.start).fixed {
            "0".to_owned()
        } else {
            w.summand(on, chain.start)
        };
        let vector = w.summand(on, target);
        return if chain.start == target { None } else { line(format!("${vector} = {start}$")) };
    }
    Some(WrittenStep::Table(w.columns(on, target, chains)))
}
