//! The problem's statement as sentences, and the faults in its formulas.

use hodograph_base::diag::{Diagnostic, Faults, both};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::phrase::{Phrase, PhrasePiece};
use hodograph_scene::statement::Run;
use hodograph_scene::{Lang, Scene};

/// Returns the paragraphs of the statement; empty if the scene has no statement.
pub fn paragraphs(scene: &Scene, lang: Lang) -> Vec<Phrase> {
    let piece = |run: &Run| match run {
        Run::Words(words) => PhrasePiece::Words(words.clone()),
        Run::Formula(formula, _) => PhrasePiece::Formula(formula.clone()),
    };
    let all = scene.statement.as_ref().map(|s| s.get(lang)).unwrap_or_default();
    all.iter().map(|runs| Phrase::of_pieces(runs.iter().map(piece).collect())).collect()
}

/// Returns the faults in the formulas of the statement, in both languages, each with its position
/// in the file.
pub fn faults(scene: &Scene) -> Faults {
    let mut faults = Faults::default();
    let formulas = [Lang::En, Lang::Zh]
        .into_iter()
        .flat_map(|lang| scene.statement.as_ref().map(|s| s.get(lang)).unwrap_or_default());
    for run in formulas.flatten() {
        let Run::Formula(source, span) = run else { continue };
        for fault in Label::math(source.as_str()).faults() {
            let d = Diagnostic { span: Some(*span), ..fault.clone() };
            let forms = "$v_{B3B2}^r$, $\\omega_1$, $b'_2$, $\\text{words}$";
            let help = both!(
                "see the label language: {forms}; a dollar sign that is to be printed is `\\$`"
            );
            // A fault in a text for both languages is reported once.
            if !faults.list.iter().any(|f| f.span == d.span && f.message == d.message) {
                faults.push(d.help(help));
            }
        }
    }
    faults
}
