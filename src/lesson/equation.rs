//! The lesson of a vector equation: one HTML page with its polygon step by step.
//!
//! The page is that of [`super::player`] with a single frame.

use super::player::{PlayerPage, drawings, legible, sizes};
use crate::diag::Faults;
use crate::figure::vector_equation::EquationSheet;
use crate::paper::label::Label;
use crate::paper::phrase::Phrase;
use crate::render::math::mathml;
use crate::report::answers::DIGITS;
use crate::report::html::sentence as html;
use crate::report::vector_equation as report;
use crate::scene::Lang;
use hodograph_base::lang::each;
use serde_json::{Value, json};

/// Words of this page in addition to those of the player.
const WORDS: [(&str, [&str; 2]); 6] = [
    ("home", each!("Back to the given instant")),
    ("instant", each!("The instant")),
    ("given", each!("given")),
    ("answers", each!("Answers")),
    (
        "keys",
        each!(
            "Keys: → and ← the steps of the construction; L language; D light or dark; P print; S window of the speaker."
        ),
    ),
    (
        "noscript",
        each!(
            "The page needs JavaScript for its steps; without it, it shows the finished construction."
        ),
    ),
];

/// Returns the page of an equation.
///
/// # Errors
/// The errors of the SVG writer.
pub fn lesson(sheet: &EquationSheet) -> Result<String, Faults> {
    let style =
        legible(sheet.style, |style| Ok(sizes(&[EquationSheet { style, ..*sheet }.polygon()])))?;
    let sheet = &EquationSheet { style: &style, ..*sheet };
    let view = sheet.polygon();
    let columns = report::columns(&sheet.problem.terms, sheet.notation);
    let written: Vec<String> =
        columns.iter().map(|c| format!("{} {}", c.joint, c.symbol)).collect();
    let written = format!("${}$", written.join(" ").trim());
    let both_of = |say: &dyn Fn(Lang) -> String| json!([Lang::En, Lang::Zh].map(say));
    let steps: Vec<Value> =
        sheet.drawn.steps.iter().map(|s| both_of(&|lang| html(&Phrase::new(lang.of(s))))).collect();
    let answers = both_of(&|lang| {
        let lines = report::lines(sheet.problem, sheet.solved, DIGITS);
        let count = report::count(&sheet.problem.terms).sentence();
        let told =
            [Phrase::new(&written), Phrase::of_words(lang.of(&count))].into_iter().chain(lines);
        told.map(|l| format!("<li>{}</li>", html(&l))).collect()
    });
    let scales = [mathml(&Label::math(view.scale(&sheet.problem.book)))];
    let told = json!({"at": "", "steps": steps, "answers": answers, "scales": scales});
    let title = &sheet.problem.title;
    let page = PlayerPage {
        title: [title.en.as_str(), title.zh.as_str()],
        lang: sheet.lang,
        words: &WORDS,
        base: 0,
        type_mm: style.small_mm,
        data: json!({"frames": [told]}),
    };
    Ok(page.written(&drawings(&[&[view]], None, 0, &sheet.problem.book)?))
}
