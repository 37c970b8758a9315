//! Worksheets on mobility: texts as accepted, no count and no dashed lines on the problem side,
//! pages without overlaps.

use super::files::{LANGS, MOBILITY, check_text, finish, golden};
use super::worksheet::{faults_of, told, without, worked};
use hodograph::mechanism::MobilitySurvey;
use hodograph::paper::item::{Dash, FigureItem, Shape};
use hodograph::scene::{Lang, Scene, templates};
use hodograph::worked::Worked;
use hodograph::worksheet::{
    Document, DocumentBlock, WorksheetOptions, WorksheetSides, html, markdown, mobility, pages,
    typst,
};

fn document(scene: &Scene, worked: &Worked, lang: Lang, sides: WorksheetSides) -> Document {
    mobility(scene, worked, &WorksheetOptions { sides, ..WorksheetOptions::of_language(lang) })
}

#[test]
fn worksheets_on_mobility_read_as_accepted() {
    let mut failures = Vec::new();
    for name in MOBILITY {
        let (scene, worked) = worked(name);
        for (lang, suffix) in LANGS {
            let d = document(&scene, &worked, lang, WorksheetSides::Both);
            let file = |ending: &str| golden(name, &format!("mobility.{suffix}.{ending}"));
            check_text(&file("md"), &markdown::markdown(&d, name).unwrap().0, &mut failures);
            check_text(
                &file("typ"),
                &without(&typst::typst(&d, name).unwrap().0, ", width: ", "mm"),
                &mut failures,
            );
            check_text(
                &file("html"),
                &without(&without(&html::html(&d).unwrap(), "<svg", "</svg>"), "base64,", ")"),
                &mut failures,
            );
        }
    }
    finish(&failures);
}

fn figures(d: &Document) -> Vec<&[FigureItem]> {
    d.blocks
        .iter()
        .filter_map(|b| {
            if let DocumentBlock::Figure { figure, .. } = b {
                Some(&figure.items[..])
            } else {
                None
            }
        })
        .collect()
}

#[test]
fn every_template_is_counted_and_split_on_clean_pages() {
    let mut faults = Vec::new();
    for t in templates::list() {
        let (scene, worked) = worked(t.name);
        let f = MobilitySurvey::of(&scene).counts;
        for (lang, suffix) in LANGS {
            let problem = document(&scene, &worked, lang, WorksheetSides::Problem);
            let text = told(&problem);
            assert_eq!(figures(&problem).len(), 1, "{} {suffix}", t.name);
            assert!(
                !text.contains("F=3n-(2p_{l}+p_{h}-p')-F'="),
                "{} {suffix}: the count is told",
                t.name
            );
            let both = document(&scene, &worked, lang, WorksheetSides::Both);
            let (text, beside) = markdown::markdown(&both, t.name).unwrap();
            assert_eq!(beside.len(), 2, "{} {suffix}", t.name);
            let begins = format!(
                "F=3n-(2p_{{l}}+p_{{h}}-p')-F'=3\\times{}-(2\\times{}+{}",
                f.moving, f.lower, f.higher
            );
            assert!(text.contains(&begins), "{} {suffix}: {text}", t.name);
            for (n, page) in pages::pages(&both).iter().enumerate() {
                faults.extend(faults_of(page, &format!("{} {suffix} page {}", t.name, n + 1)));
            }
        }
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

/// A dashed crank would show which one is redundant.
#[test]
fn the_problem_does_not_show_what_repeats() {
    let (scene, worked) = worked("third-crank");
    let dashed = |items: &[FigureItem]| {
        items
            .iter()
            .filter(
                |i| matches!(&i.shape, Shape::Line { stroke, .. } if stroke.dash == Dash::Dashed),
            )
            .count()
    };
    let both = document(&scene, &worked, Lang::En, WorksheetSides::Both);
    let [problem, groups] = figures(&both)[..] else { panic!() };
    assert_eq!(dashed(problem), 0);
    assert!(dashed(groups) > 0);
}
