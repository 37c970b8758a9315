//! Mutated files other than scenes: tasks of synthesis, motions without a mechanism, vector
//! equations. Their seeds are their templates and the tasks of the synthesis tests, so that every
//! kind of file is mutated.

use super::{corpus, finite, fuzz, root, told, well_formed};
use hodograph::figure::{particle as motion_figure, synthesis as design_figure};
use hodograph::lesson::design as design_lesson;
use hodograph::notation::Notation;
use hodograph::paper::style::Style;
use hodograph::particle::{self, board};
use hodograph::problem::{self, Kind};
use hodograph::render::svg;
use hodograph::report::{particle as motion_report, synthesis as design_report};
use hodograph::scene::Lang;
use hodograph::synthesis;
use hodograph::worksheet::{self, WorksheetOptions as Sheets};
use serde_json::Value as Json;

/// The tasks with known designs.
fn tasks() -> impl Iterator<Item = String> {
    ["cases", "further"].into_iter().flat_map(|name| {
        let text = std::fs::read_to_string(root(&format!("tests/synthesis/{name}.json"))).unwrap();
        let cases: Vec<Json> = serde_json::from_str(&text).unwrap();
        cases.into_iter().map(|case| format!("{:#}", case["task"]))
    })
}

/// A task is refused with a message, or has designs: their scenes are read back, and all outputs
/// are well-formed.
fn design_target(input: &[u8], k: u64) -> bool {
    let task = match synthesis::read(input) {
        Ok(t) => t.value,
        Err(faults) => {
            told(&faults, input);
            return false;
        }
    };
    let design = match synthesis::solve(&task) {
        Ok(d) => d,
        Err(faults) => {
            told(&faults, input);
            return false;
        }
    };
    let lang = if k.is_multiple_of(2) { Lang::En } else { Lang::Zh };
    finite(&design_report::text(&task, &design, lang));
    finite(&design_report::json(&task, &design).to_string());
    let Some(candidate) = design.candidates.first() else { return true };
    match design_figure::figures(&task, candidate, &Style::default(), lang) {
        Ok(figures) => figures.iter().for_each(|f| match svg::write(&f.1) {
            Ok(svg) => well_formed(&svg.value),
            Err(faults) => told(&faults, input),
        }),
        Err(faults) => told(&faults, input),
    }
    if k.is_multiple_of(4) {
        match worksheet::design(&task, &design, 0, &Sheets::of_language(lang)) {
            Ok(document) => drop(
                worksheet::html::html(&document)
                    .map(|page| well_formed(page.trim_start_matches("<!DOCTYPE html>"))),
            ),
            Err(faults) => told(&faults, input),
        }
        if let Err(faults) = design_lesson::lesson(
            &task,
            candidate,
            &design_lesson::DesignOptions { lang, style: Style::default() },
        ) {
            told(&faults, input);
        }
    }
    true
}

#[test]
fn fuzz_designs() {
    let mut seeds = corpus(&["templates/synthesis"]);
    seeds.extend(tasks());
    fuzz("designs", &seeds, 60, &design_target);
}

/// A motion is refused with a message, or solved: the board agrees, and all outputs are
/// well-formed.
fn motion_target(input: &[u8], k: u64) -> bool {
    let problem = match particle::read(input) {
        Ok(p) => p.value,
        Err(faults) => {
            told(&faults, input);
            return false;
        }
    };
    let both = particle::solve(&problem).and_then(|solved| Ok((solved, board::draw(&problem)?)));
    let (solved, drawn) = match both {
        Ok(b) => b,
        Err(faults) => {
            told(&faults, input);
            return false;
        }
    };
    for answer in &solved.answers {
        let what = problem.find[answer.find].what;
        let size = motion_report::largest(&problem, &solved, what);
        let apart = motion_report::drawn(&drawn, what)
            .and_then(|d| motion_report::apart(&answer.value, d, size));
        assert!(
            apart.is_none_or(|off| off < 1e-9),
            "{}: drawing and laws differ by {apart:?}",
            problem.find[answer.find].text
        );
    }
    let lang = if k.is_multiple_of(2) { Lang::En } else { Lang::Zh };
    finite(&motion_report::text(
        &problem,
        &solved,
        &drawn,
        6 + k as usize % 20,
        k.is_multiple_of(3).then_some(&Notation::of_language(lang)),
        lang,
    ));
    finite(&motion_report::json(&problem, &solved, &drawn, 6, &[]).to_string());
    match motion_figure::figures(&problem, &solved, &drawn, &Style::default(), lang) {
        Ok(figures) => figures.iter().for_each(|f| match svg::write(&f.1) {
            Ok(svg) => well_formed(&svg.value),
            Err(faults) => told(&faults, input),
        }),
        Err(d) => told(&d.into(), input),
    }
    if k.is_multiple_of(4) {
        match worksheet::particle(&problem, &solved, &drawn, &Sheets::of_language(lang)) {
            Ok(document) => drop(
                worksheet::html::html(&document)
                    .map(|page| well_formed(page.trim_start_matches("<!DOCTYPE html>"))),
            ),
            Err(d) => told(&d.into(), input),
        }
    }
    true
}

/// A vector equation is refused with a message, or solved: the sum of the vectors vanishes, the
/// board agrees, and all outputs are well-formed.
fn equation_target(input: &[u8], k: u64) -> bool {
    use hodograph::problem::{Look, Options, Pictures, Verdict, solve};
    let problem = match problem::read_of(input, Kind::Equation) {
        Ok(p) => p.value,
        Err(faults) => {
            told(&faults, input);
            return false;
        }
    };
    let solved = match solve(&problem, &Options::default()) {
        Ok(solved) => solved,
        Err(faults) => {
            told(&faults, input);
            return false;
        }
    };
    assert_eq!(solved.verdict(), Verdict::Answered);
    let lang = if k.is_multiple_of(2) { Lang::En } else { Lang::Zh };
    let look = Look { lang: Some(lang), digits: 6 + k as usize % 20, ..Look::default() };
    finite(&solved.text(&look, true));
    finite(&solved.json(&look, false, &[]).to_string());
    match solved.figures(&Pictures { steps: k.is_multiple_of(3), ..Pictures::default() }, &look) {
        Ok(pages) => pages.value.iter().for_each(|page| match svg::write(&page.1) {
            Ok(svg) => well_formed(&svg.value),
            Err(faults) => told(&faults, input),
        }),
        Err(faults) => told(&faults, input),
    }
    true
}

#[test]
fn fuzz_equations() {
    fuzz("equations", &corpus(&["templates/equation"]), 60, &equation_target);
}

#[test]
fn fuzz_motions() {
    fuzz("motions", &corpus(&["templates/particle", "tests/motions"]), 60, &motion_target);
}
