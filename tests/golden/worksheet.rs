//! Worksheets: texts as accepted, no answer on the problem side, pages without overlaps, files that
//! other programs can read.

use super::files::{LANGS, WORKSHEETS, check_text, finish, golden};
use super::pdf::{letters, read};
use super::wide::every;
use hodograph::centres::CentreTask;
use hodograph::certified::certify;
use hodograph::digits::significant;
use hodograph::mechanism::Core;
use hodograph::paper::extent::{Rect, bounds};
use hodograph::paper::item::{FigureItem, Shape};
use hodograph::render::pages::{Kind, Page};
use hodograph::render::pdf;
use hodograph::scene::{self, DiagramKind, GuideDirection, GuidePath, Lang, Scene, templates};
use hodograph::worked::{Scope, Worked, work};
use hodograph::worksheet::{
    Document, DocumentBlock, WorksheetOptions, WorksheetSides, html, markdown, pages, typst,
    worksheet,
};

pub fn worked(name: &str) -> (Scene, Worked) {
    let scene = scene::read(templates::get(name).unwrap()).unwrap().value;
    let worked = work(&scene, Scope::Figure).unwrap_or_else(|f| panic!("{name}: {f}")).value;
    (scene, worked)
}

fn document(scene: &Scene, worked: &Worked, lang: Lang, sides: WorksheetSides) -> Document {
    worksheet(scene, worked, &WorksheetOptions { sides, ..WorksheetOptions::of_language(lang) })
}

/// A text without the parts between two marks: drawings have golden files of their own, and a label
/// that moves changes no worksheet.
pub fn without(text: &str, from: &str, to: &str) -> String {
    let mut parts = text.split(from);
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        out += from;
        out += part.split_once(to).map_or("", |(_, rest)| rest);
    }
    out
}

#[test]
fn worksheets_read_as_accepted() {
    let mut failures = Vec::new();
    for name in WORKSHEETS {
        let (scene, worked) = worked(name);
        for (lang, suffix) in LANGS {
            let d = document(&scene, &worked, lang, WorksheetSides::Both);
            let file = |ending: &str| golden(name, &format!("worksheet.{suffix}.{ending}"));
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

/// All texts on the problem side for readers and screen readers.
pub fn told(d: &Document) -> String {
    let mut out = markdown::markdown(d, "x").unwrap().0;
    for block in &d.blocks {
        if let DocumentBlock::Figure { figure, .. } = block {
            out += &format!("\n{}\n{}\n", figure.title, figure.desc);
            for item in &figure.items {
                if let Shape::Label { label, .. } = &item.shape {
                    out += &format!("{}\n", label.source());
                }
            }
        }
    }
    out
}

#[test]
fn the_problem_side_tells_no_answer() {
    for t in templates::list() {
        let (scene, worked) = worked(t.name);
        let mut given = templates::get(t.name).unwrap().to_owned();
        // Values of a driver's law at the instant are given too.
        for driver in &scene.drivers {
            for value in [Some(&driver.rate), driver.acceleration.as_ref()].into_iter().flatten() {
                given += &format!(" {}", significant(value.value.abs(), 4));
            }
        }
        // So is the angle of a guide that the file computes from a parameter.
        for guide in &scene.guides {
            if let GuidePath::Line { direction: GuideDirection::Instant(angle), .. } = &guide.path {
                given += &format!(" {}", significant(angle.value.radians().to_degrees(), 4));
            }
        }
        for (lang, suffix) in LANGS {
            let d = document(&scene, &worked, lang, WorksheetSides::Problem);
            let text = told(&d);
            for (c, r) in certify(&scene, &worked, 4).iter().zip(&worked.results) {
                for (part, number) in &c.parts {
                    // At least three digits, and not those of a given quantity: a length of 150 mm
                    // does not give away a direction.
                    let Some((digits, _)) = number.text_scaled(4, 0) else { continue };
                    let digits = digits
                        .trim_start_matches('-')
                        .trim_end_matches('0')
                        .trim_end_matches('.')
                        .to_owned();
                    let enough = digits
                        .trim_start_matches(['0', '.'])
                        .chars()
                        .filter(char::is_ascii_digit)
                        .count()
                        >= 3
                        && !given.contains(&digits);
                    assert!(
                        !enough || !text.contains(&digits),
                        "{} {suffix}: {} ({part:?}) = {digits} is told",
                        t.name,
                        scene.find[r.find].text
                    );
                }
            }
            let figures: Vec<_> = d
                .blocks
                .iter()
                .filter_map(|b| {
                    if let DocumentBlock::Figure { figure, .. } = b { Some(figure) } else { None }
                })
                .collect();
            assert_eq!(figures.len(), 1, "{}", t.name);
            assert!(
                figures[0].items.iter().all(|i| !i.class.contains("special")),
                "{}: the special point is found by the solver",
                t.name
            );
            assert!(text.contains(if lang == Lang::En { "## Wanted" } else { "## 求" }));
            assert!(!text.contains(if lang == Lang::En { "## Solution" } else { "## 解" }));
        }
    }
}

#[test]
fn the_solution_has_every_answer_and_both_polygons() {
    for t in templates::list() {
        let (scene, worked) = worked(t.name);
        // A task that asks for centres alone is solved by them.
        let by_centres = CentreTask::of(&scene).is_some_and(|task| task.alone);
        for (lang, suffix) in LANGS {
            let d = document(&scene, &worked, lang, WorksheetSides::Both);
            let (text, beside) = markdown::markdown(&d, t.name).unwrap();
            assert!(!text.contains("NaN") && !text.contains("inf "), "{} {suffix}", t.name);
            for (polygon, word) in [
                (worked.construction.polygon(DiagramKind::Velocity), "velocity"),
                (worked.construction.polygon(DiagramKind::Acceleration), "acceleration"),
            ] {
                let name = format!("{}-{word}.svg", t.name);
                assert_eq!(
                    polygon.is_some() && !by_centres,
                    beside.iter().any(|f| f.name == name),
                    "{} {word}",
                    t.name
                );
            }
            // Every written file is named, and vice versa.
            assert_eq!(text.matches("](<").count(), beside.len());
            assert!(beside.iter().all(|f| text.contains(&format!("](<{}>)", f.name))));
            let formulas = text.matches('$').count() - 2 * text.matches("$$").count();
            assert_eq!(formulas % 2, 0, "{} {suffix}: a dollar sign is left open", t.name);
        }
    }
}

fn label_boxes(page: &Page) -> Vec<(&FigureItem, Rect)> {
    let text = |k: &Kind| !matches!(k, Kind::Figure(_));
    let items = page.parts.iter().filter(|p| text(&p.kind)).flat_map(|p| &p.items);
    items
        .filter(|i| matches!(i.shape, Shape::Label { .. }))
        .filter_map(|i| Some((i, i.bounds()?)))
        .collect()
}

/// The faults of a page, one per line.
pub fn faults_of(page: &Page, at: &str) -> Vec<String> {
    let mut faults = Vec::new();
    let all = bounds(&page.parts.iter().flat_map(|p| p.items.clone()).collect::<Vec<_>>()).unwrap();
    // A printer cannot reach the outer 8 mm.
    if all.min.x < 8.0 - 1e-6
        || all.min.y < 8.0 - 1e-6
        || all.max.x > page.width_mm - 8.0 + 1e-6
        || all.max.y > page.height_mm - 8.0 + 1e-6
    {
        faults.push(format!("{at}: ink at {all:?}"));
    }
    let common = |r: &Rect, s: &Rect| {
        let (w, h) = (
            r.max.x.min(s.max.x) - r.min.x.max(s.min.x),
            r.max.y.min(s.max.y) - r.min.y.max(s.min.y),
        );
        w > 0.05 && h > 0.05
    };
    // The sign of a root encloses its row.
    let root =
        |i: &FigureItem| matches!(&i.shape, Shape::Label { label, .. } if label.plain() == "√");
    let labels = label_boxes(page);
    for (k, (a, r)) in labels.iter().enumerate() {
        for (b, s) in &labels[k + 1..] {
            if common(r, s) && !root(a) && !root(b) {
                faults.push(
                    format!("{at}: {:?} on {:?}", a.shape, b.shape).chars().take(300).collect(),
                );
            }
        }
    }
    for part in page.parts.iter().filter(|p| matches!(p.kind, Kind::Figure(_))) {
        let Some(figure) = bounds(&part.items) else { continue };
        let inside = labels.iter().filter(|(_, r)| common(r, &figure));
        faults.extend(
            inside.map(|(_, r)| format!("{at}: text at {r:?} in the drawing at {figure:?}")),
        );
    }
    let last = page.parts.iter().rev().find(|p| p.kind != Kind::Artifact);
    if last.is_some_and(|p| matches!(p.kind, Kind::Heading { .. })) {
        faults.push(format!("{at}: ends in a heading"));
    }
    faults
}

/// All templates in both languages, and the reference problems.
#[test]
fn nothing_overlaps_and_nothing_is_cut_on_any_page() {
    let mut faults = Vec::new();
    let mut check = |name: &str, scene: &Scene, worked: &Worked, lang: Lang| {
        for (n, page) in
            pages::pages(&document(scene, worked, lang, WorksheetSides::Both)).iter().enumerate()
        {
            faults.extend(faults_of(page, &format!("{name} {lang:?} page {}", n + 1)));
        }
    };
    for t in templates::list().iter().step_by(every(8)) {
        let (scene, worked) = worked(t.name);
        LANGS.iter().for_each(|(lang, _)| check(t.name, &scene, &worked, *lang));
    }
    let mut cases = 0;
    let mut files: Vec<_> = std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/cases"))
        .unwrap()
        .map(|file| file.unwrap().path())
        .collect();
    files.sort();
    for path in files.iter().step_by(every(8)) {
        let case: serde_json::Value =
            serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
        let name = path.file_stem().unwrap().to_string_lossy();
        // A case that only counts has no solution.
        if case["expect"].as_array().unwrap().iter().all(|e| e["find"].is_null()) {
            continue;
        }
        let scene = scene::read(case["scene"].to_string().as_bytes())
            .unwrap_or_else(|f| panic!("{name}: {f}"))
            .value;
        let worked = work(&scene, Scope::Figure).unwrap_or_else(|f| panic!("{name}: {f}")).value;
        check(&name, &scene, &worked, Lang::En);
        cases += 1;
    }
    assert!(cases > 90 / every(8), "only {cases} reference problems found");
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

/// The problem takes one page, the solution at most five more: no template needs them all except
/// those with many equations.
#[test]
fn no_page_is_wasted() {
    let mut long = Vec::new();
    for t in templates::list().iter().step_by(every(8)) {
        let (scene, worked) = worked(t.name);
        for (lang, suffix) in LANGS {
            let [problem, both] = [WorksheetSides::Problem, WorksheetSides::Both]
                .map(|sides| pages::pages(&document(&scene, &worked, lang, sides)).len());
            println!("{} {suffix}: {problem} of {both} pages", t.name);
            // Twelve links take one more page, forces one, those of a group of class IV with its
            // trial two.
            let higher = worked.mechanism.groups.iter().any(|g| matches!(g.core, Core::Higher));
            let of_forces = match worked.equilibrium {
                Some(_) => 1 + usize::from(higher),
                None => 0,
            };
            // Each named way of composite motion has its figure.
            let most = 6 + usize::from(scene.links.len() > 7) + of_forces + scene.composite.len();
            if problem > 1 || both > most {
                long.push(format!("{} {suffix}: {problem} of {both} pages", t.name));
            }
        }
    }
    assert!(long.is_empty(), "{long:?}");
}

/// Angular velocities are beside the table from which they are solved; a list's first members stay
/// together, and its last ones.
#[test]
fn formulas_stand_beside_their_tables() {
    let (scene, worked) = worked("radial-engine");
    let sheets = pages::pages(&document(&scene, &worked, Lang::En, WorksheetSides::Both));
    let mut beside = 0;
    for page in &sheets {
        let formulas: Vec<Rect> = page
            .parts
            .iter()
            .filter(|p| matches!(p.kind, Kind::Formula(_)))
            .filter_map(|p| bounds(&p.items))
            .collect();
        for pair in formulas.windows(2) {
            beside += usize::from(
                pair[1].min.x > pair[0].max.x
                    && pair[1].min.y > pair[0].min.y
                    && pair[1].max.y < pair[0].max.y,
            );
        }
    }
    assert_eq!(beside, 4, "one for each equation");
}

/// Text is at the left of the mechanism and of each polygon.
#[test]
fn polygons_are_beside_their_steps() {
    let (scene, worked) = worked("shaper");
    let sheets = pages::pages(&document(&scene, &worked, Lang::En, WorksheetSides::Solution));
    let mut beside = 0;
    for page in &sheets {
        let of = |wanted: fn(&Kind) -> bool| {
            page.parts.iter().filter(move |p| wanted(&p.kind)).filter_map(|p| bounds(&p.items))
        };
        for figure in of(|kind| matches!(kind, Kind::Figure(_))) {
            beside += usize::from(of(|kind| matches!(kind, Kind::List { .. })).any(|list| {
                list.max.x < figure.min.x && list.max.y > figure.min.y && list.min.y < figure.max.y
            }));
        }
    }
    assert_eq!(beside, 3, "mechanism, velocities and accelerations");
}

/// A point on a line is not described as 0 beside it, and no length is negative where words give
/// the side.
#[test]
fn places_are_reported_in_words() {
    let told = |name: &str, lang| {
        let (scene, worked) = worked(name);
        markdown::markdown(&document(&scene, &worked, lang, WorksheetSides::Problem), "x")
            .unwrap()
            .0
    };
    let pantograph = told("pantograph", Lang::En);
    assert!(pantograph.contains("from $O$ toward $B$; $D$ is"), "{pantograph}");
    let excavator = told("excavator", Lang::En);
    assert!(excavator.contains("from $D$ away from $G$ and $0.25"), "{excavator}");
    let excavator = told("excavator", Lang::Zh);
    assert!(excavator.contains(" 的反方向 $0.8") && !excavator.contains("-0.8"), "{excavator}");
}

#[test]
fn pdf_pages_carry_their_text() {
    let (scene, worked) = worked("slotted-lever");
    for (lang, word) in [(Lang::En, "Degree of freedom and groups"), (Lang::Zh, "自由度与杆组")]
    {
        let d = document(&scene, &worked, lang, WorksheetSides::Both);
        let sheets = pages::pages(&d);
        let file = pdf::document(&sheets, &d.title, "en").unwrap().value;
        let found = read(&file, 20.0);
        assert_eq!(found.len(), sheets.len());
        for (page, sheet) in found.iter().zip(&sheets) {
            assert_eq!(page.text, letters(sheet.parts.iter().flat_map(|p| &p.items)));
        }
        assert!(found.iter().any(|p| p.text.contains(word)));
        assert_eq!(file, pdf::document(&pages::pages(&d), &d.title, "en").unwrap().value);
    }
}

#[test]
fn html_is_well_formed_and_fetches_nothing() {
    for t in templates::list() {
        let (scene, worked) = worked(t.name);
        for (lang, suffix) in LANGS {
            let text = html::html(&document(&scene, &worked, lang, WorksheetSides::Both)).unwrap();
            let options = roxmltree::ParsingOptions {
                allow_dtd: true,
                ..roxmltree::ParsingOptions::default()
            };
            let tree = roxmltree::Document::parse_with_options(&text, options)
                .unwrap_or_else(|e| panic!("{} {suffix}: {e}", t.name));
            let count =
                |name: &str| tree.descendants().filter(|n| n.tag_name().name() == name).count();
            assert!(count("math") > 20 && count("svg") >= 1, "{} {suffix}", t.name);
            for (parent, children) in [("mfrac", 2), ("msub", 2), ("msup", 2), ("msubsup", 3)] {
                for n in tree.descendants().filter(|n| n.tag_name().name() == parent) {
                    assert_eq!(
                        n.children().filter(|c| c.is_element()).count(),
                        children,
                        "{} {suffix}: {parent}",
                        t.name
                    );
                }
            }
            for n in tree.descendants() {
                assert!(
                    n.attributes()
                        .all(|a| !matches!(a.name(), "src" | "href") || a.value().starts_with('#')),
                    "{} {suffix}: fetches something",
                    t.name
                );
            }
            let mut ids: Vec<&str> = tree.descendants().filter_map(|n| n.attribute("id")).collect();
            let all = ids.len();
            ids.sort_unstable();
            ids.dedup();
            assert_eq!(ids.len(), all, "{} {suffix}: a name is there twice", t.name);
        }
    }
}

/// Runs if a typst is installed; otherwise the test reports that it was skipped.
#[test]
fn typst_reads_the_source() {
    if std::process::Command::new("typst").arg("--version").output().is_err() {
        println!("skipped: there is no typst on the path");
        return;
    }
    for t in templates::list() {
        let (scene, worked) = worked(t.name);
        for (lang, suffix) in LANGS {
            let folder = tempfile::tempdir().unwrap();
            let (text, beside) =
                typst::typst(&document(&scene, &worked, lang, WorksheetSides::Both), t.name)
                    .unwrap();
            for f in beside {
                std::fs::write(folder.path().join(f.name), f.text).unwrap();
            }
            let source = folder.path().join("sheet.typ");
            std::fs::write(&source, text).unwrap();
            let run =
                std::process::Command::new("typst").arg("compile").arg(&source).output().unwrap();
            assert!(
                run.status.success(),
                "{} {suffix}: {}",
                t.name,
                String::from_utf8_lossy(&run.stderr)
            );
        }
    }
}
