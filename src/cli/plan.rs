//! `hodograph plan`: the equations without numbers, as text and as JSON.

use super::{CommandResult, InputFile, SceneInput, args, choices, files, look_of, verdict};
use crate::certified::certify;
use crate::diag::Warned;
use crate::effort::Work;
use crate::figure::sheet;
use crate::notation::Notation;
use crate::paper::style::Style;
use crate::plan::text::PlanWriter;
use crate::plan::tried;
use crate::problem::{self, Extent, Kind, Problem, Verdict};
use crate::report::forces::ForceWriter;
use crate::report::{answers, plan as plan_text, plan_json, tried as tried_text};
use crate::scene::Lang;
use crate::worked::{Scope, work};
use std::process::ExitCode;

pub(super) fn run(a: args::PlanArgs) -> CommandResult {
    let mut file = InputFile::open(&a.common.scene, &a.common.set)?;
    if Kind::of(file.source.as_bytes()) == Kind::Equation {
        return equation(&mut file, &a);
    }
    let mut input = SceneInput::of_file(file, Extent::Motion)?;
    let (lang, notation) = choices(&input.scene, &a.common);
    if a.json {
        return plan_for_programs(input, lang, &notation, &a);
    }
    let (mechanism, mut notes) = match crate::mechanism::Mechanism::new(&input.scene) {
        Ok(Warned { value, notes }) => (value, notes),
        Err(faults) => return Err(input.failed(faults)),
    };
    let demand = crate::mechanism::Demand::of(&input.scene, &mechanism);
    let plan = crate::plan::plan(&input.scene, &mechanism, &demand);
    let w = PlanWriter { scene: &input.scene, plan: &plan, notation: &notation, lang };
    let worked =
        if demand.wants_forces() { work(&input.scene, Scope::Questions).ok() } else { None };
    let drawn = worked.as_ref().and_then(|w| w.value.equilibrium.as_ref());
    let forces = drawn.map(|of| ForceWriter { scene: &input.scene, notation: &notation, lang, of });
    let mut out = plan_text::text(&input.scene, &mechanism, &w, forces.as_ref());
    if a.why {
        let (plan, trials) = tried::plan_tried(&input.scene, &mechanism, &demand);
        out += &tried_text::text(&mechanism, &PlanWriter { plan: &plan, ..w }, &trials);
    }
    files::print(&out)?;
    notes.append(&mut input.file.notes);
    input.file.notes = notes;
    input.file.say_notes();
    Ok(ExitCode::SUCCESS)
}

/// Prints the table of a vector equation and the number of its unknowns.
fn equation(file: &mut InputFile, a: &args::PlanArgs) -> CommandResult {
    let problem = file.read(|bytes| problem::read_of(bytes, Kind::Equation))?;
    if let Problem::Equation(equation) = &problem {
        let look = look_of(&a.common, Style::default(), answers::DIGITS);
        let (text, json) = problem::equation_plan(equation, &look);
        files::print(&if a.json { format!("{json:#}\n") } else { text })?;
    }
    file.say_notes();
    Ok(ExitCode::SUCCESS)
}

/// Prints the plan and the work done for it. A plan needs no numbers: if the pose cannot be solved,
/// the plan is printed alone, and the notes give the reason.
fn plan_for_programs(
    mut input: SceneInput,
    lang: Lang,
    notation: &Notation,
    a: &args::PlanArgs,
) -> CommandResult {
    let fail = |input: &SceneInput, faults| input.failed(faults);
    let mut code = ExitCode::SUCCESS;
    let mut document =
        match work(&input.scene, if a.figure { Scope::Figure } else { Scope::Questions }) {
            Ok(Warned { value: worked, notes }) => {
                input.file.notes.extend(notes);
                // A question without an answer in the pose is not a fault of the plan.
                code = if Verdict::of(&worked) == Verdict::Disagree {
                    verdict(Verdict::Disagree)
                } else {
                    code
                };
                let certified = certify(&input.scene, &worked, answers::DIGITS);
                let mut done = Work::of(&worked).with_certified(&certified);
                if a.figure {
                    let options = sheet::SheetOptions {
                        notation: notation.clone(),
                        ..sheet::SheetOptions::of_language(lang)
                    };
                    done = done.with_labels(
                        sheet::sheet(&input.scene, &worked, &options)
                            .map_err(|f| fail(&input, f))?
                            .labels_placed(),
                    );
                }
                let w = PlanWriter { scene: &input.scene, plan: &worked.plan, notation, lang };
                plan_json::json(
                    &worked.mechanism,
                    &worked.demand,
                    &w,
                    Some((&worked, done)),
                    &input.file.notes,
                )
            }
            Err(faults) => {
                let mechanism = crate::mechanism::Mechanism::new(&input.scene)
                    .map_err(|f| fail(&input, f))?
                    .value;
                let demand = crate::mechanism::Demand::of(&input.scene, &mechanism);
                let plan = crate::plan::plan(&input.scene, &mechanism, &demand);
                let w = PlanWriter { scene: &input.scene, plan: &plan, notation, lang };
                input.file.notes.extend(faults.list);
                plan_json::json(&mechanism, &demand, &w, None, &input.file.notes)
            }
        };
    if a.why {
        let mechanism =
            crate::mechanism::Mechanism::new(&input.scene).map_err(|f| fail(&input, f))?.value;
        let demand = crate::mechanism::Demand::of(&input.scene, &mechanism);
        let (plan, trials) = tried::plan_tried(&input.scene, &mechanism, &demand);
        let w = PlanWriter { scene: &input.scene, plan: &plan, notation, lang };
        document["tried"] = tried_text::json(&w, &trials);
    }
    files::print(&format!("{document:#}\n"))?;
    input.file.say_notes_beside_json();
    Ok(code)
}
