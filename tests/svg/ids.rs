//! Ids are ASCII, unique in a file, and the same in both languages and all notation profiles.

use std::collections::BTreeSet;

use hodograph::figure::list::{Extras, FigureEntry, FigureInput, LIST, MECHANISM, USUAL};
use hodograph::figure::sheet::SheetOptions;
use hodograph::notation::Notation;
use hodograph::paper::item::{Figure, FigureItem};
use hodograph::problem::{self, Kind, Look, Pictures, solve};
use hodograph::scene::{self, DiagramKind, Lang, Scene, templates};
use hodograph::worked::{Scope, Worked, work};

use crate::wide::every;

/// Labels may be omitted, lines of text break elsewhere, and an inset is drawn if labels do not
/// fit: these items differ between languages.
const WORDS: &[&str] = &[
    "label",
    "leader",
    "remark",
    "inset",
    "heading",
    "caption",
    "statement",
    "answer",
    "title",
    "table",
    "agreement",
    "note",
    "result",
    "list",
];

fn is_named_alike(item: &FigureItem) -> bool {
    let line_of_text = ["given-", "attempt-line-"].iter().any(|start| item.id.starts_with(start));
    !line_of_text && !item.class.split(' ').any(|word| WORDS.contains(&word))
}

/// Faults of the ids of one figure.
fn faults(name: &str, figure: &Figure) -> Vec<String> {
    let (mut seen, mut out) = (BTreeSet::new(), Vec::new());
    for item in figure.items.iter().filter(|i| !i.id.is_empty()) {
        let good = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_');
        if !item.id.starts_with(|c: char| c.is_ascii_lowercase()) || !item.id.chars().all(good) {
            out.push(format!("{name}: {} is not an id in ASCII", item.id));
        }
        if !seen.insert(&item.id) {
            out.push(format!("{name}: {} is not unique", item.id));
        }
    }
    out
}

/// The sheet of a scene in a language and notation, and the other figures if `others`.
fn figures(
    scene: &Scene,
    worked: &Worked,
    (lang, notation): (Lang, &str),
    others: bool,
) -> Vec<(String, Figure)> {
    let options = SheetOptions {
        notation: Notation::named(notation).unwrap(),
        ..SheetOptions::of_language(lang)
    };
    let vectors = |on| Extras { vectors: Some(on), dimensions: true, ..Extras::default() };
    let all =
        [Extras::default(), vectors(DiagramKind::Velocity), vectors(DiagramKind::Acceleration)];
    let mut out = Vec::new();
    for (k, extras) in all.iter().enumerate() {
        let wanted = FigureInput { scene, worked, options: &options, extras };
        let wanted_too = |e: &&&FigureEntry| {
            e.name == USUAL.name && k == 0 || others && (k == 0 || e.name == MECHANISM.name)
        };
        for entry in LIST.iter().filter(wanted_too) {
            let Ok(pages) = (entry.draw)(&wanted) else { continue };
            out.extend(
                pages
                    .value
                    .into_iter()
                    .map(|(word, figure)| (format!("{}-{k}-{word}", entry.name), figure)),
            );
        }
    }
    out
}

/// Faults of a scene's figures in all languages and notations, and the number of items compared.
fn compared(name: &str, text: &str) -> (Vec<String>, usize) {
    let scene = scene::read(text).unwrap_or_else(|f| panic!("{name}: {f}")).value;
    let worked = work(&scene, Scope::Figure).unwrap_or_else(|f| panic!("{name}: {f}")).value;
    let ids = |f: &Figure| -> BTreeSet<String> {
        f.items.iter().filter(|i| is_named_alike(i)).map(|i| i.id.clone()).collect()
    };
    let (mut out, mut count, mut first) = (Vec::new(), 0, None);
    for (lang, notation) in [(Lang::En, "en"), (Lang::Zh, "cn"), (Lang::En, "cn"), (Lang::Zh, "en")]
    {
        // Language and notation change one by one on the sheet, which has most kinds of items, and
        // together on all figures.
        let all =
            figures(&scene, &worked, (lang, notation), (lang == Lang::En) == (notation == "en"));
        all.iter().for_each(|(what, f)| {
            out.extend(faults(&format!("{name} {what} {lang:?} {notation}"), f))
        });
        let named: Vec<(String, BTreeSet<String>)> =
            all.iter().map(|(what, f)| (what.clone(), ids(f))).collect();
        count += named.iter().map(|(_, ids)| ids.len()).sum::<usize>();
        let first = first.get_or_insert_with(|| named.clone());
        for ((what, a), (_, b)) in first.iter().zip(&named) {
            let differ: Vec<&String> = a.symmetric_difference(b).take(4).collect();
            if !differ.is_empty() {
                out.push(format!(
                    "{name} {what}: {lang:?} {notation} has other ids than English: {differ:?}"
                ));
            }
        }
    }
    (out, count)
}

#[test]
fn ids_are_ascii_unique_and_the_same_in_all_languages_and_notations() {
    let (mut all, mut count) = (Vec::new(), 0);
    for t in templates::list().iter().step_by(every(20).max(4)) {
        let (faults, n) = compared(t.name, templates::get(t.name).unwrap());
        all.extend(faults);
        count += n;
    }
    assert!(count > 500, "only {count} ids were compared");
    assert!(all.is_empty(), "{} faults:\n{}", all.len(), all.join("\n"));
}

/// Points and links with non-ASCII names, or with names that coincide without the signs between.
#[test]
fn names_that_are_no_ascii_have_ids_of_their_own() {
    let text = templates::get("crank-rocker").unwrap();
    let text = text
        .replace("\"E\"", "\"杆'\"")
        .replace("BE", "B,杆'")
        .replace("CE", "C,杆'")
        .replace("_E", "_杆'");
    let text = text.replace("\"3\": [", "\"3_\": [").replace("_3\"", "_3_\"");
    let (faults, _) = compared("escaped", &text);
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    let scene = scene::read(&text).unwrap().value;
    let worked = work(&scene, Scope::Figure).unwrap().value;
    let sheet = &figures(&scene, &worked, (Lang::Zh, "cn"), false)[0].1;
    for id in [
        "vel-abs-_6746_0027",
        "acc-abs-_6746_0027",
        "vel-mark-image-_6746_0027",
        "mechanism-link-3_005f",
        "result-v-_6746_0027-value",
    ] {
        assert!(sheet.items.iter().any(|i| i.id == id), "{id} is missing");
    }
    assert!(sheet.vector("v_杆'").is_some());
}

/// Every id of a dimension in the table of docs/svg.md is drawn.
#[test]
fn dimensions_have_the_ids_of_the_document() {
    let document = include_str!("../../docs/svg.md");
    let rows = document.lines().filter(|l| l.contains("mechanism-dimension-"));
    let ids: Vec<&str> = rows.flat_map(|l| l.split('`').skip(1).step_by(2)).collect();
    let ids: Vec<&str> = ids.into_iter().filter(|id| id.starts_with("mechanism-")).collect();
    assert!(ids.len() >= 8, "{ids:?}");
    let mut drawn = BTreeSet::new();
    for name in ["crank-rocker", "offset-slider-crank", "cam-offset-roller", "five-bar-centres"] {
        let scene = scene::read(templates::get(name).unwrap()).unwrap().value;
        let worked = work(&scene, Scope::Figure).unwrap().value;
        let options = SheetOptions::of_language(Lang::En);
        let extras = Extras { dimensions: true, ..Extras::default() };
        let wanted =
            FigureInput { scene: &scene, worked: &worked, options: &options, extras: &extras };
        let pages = (MECHANISM.draw)(&wanted).unwrap().value;
        drawn.extend(pages.into_iter().flat_map(|(_, f)| f.items).map(|item| item.id));
    }
    let missing: Vec<&str> = ids.into_iter().filter(|id| !drawn.contains(*id)).collect();
    assert!(missing.is_empty(), "{missing:?} are not drawn");
}

/// Ids in figures of designs and of motions without a mechanism follow the contents, too.
#[test]
fn designs_and_motions_have_ids_by_meaning() {
    let mut all = Vec::new();
    let named = |figure: &Figure| -> BTreeSet<String> {
        figure.items.iter().filter(|i| is_named_alike(i)).map(|i| i.id.clone()).collect()
    };
    for t in problem::templates::all().into_iter().filter(|t| t.kind != Kind::Scene) {
        let read = problem::read(problem::templates::text(t.name, &[]).unwrap()).unwrap().value;
        let solved = solve(&read, &problem::Options::with_figures()).unwrap();
        let pages = |lang| {
            let pages = solved
                .figures(&Pictures::default(), &Look { lang: Some(lang), ..Look::default() })
                .unwrap()
                .value;
            pages.into_iter().map(|(_, figure)| figure).collect::<Vec<Figure>>()
        };
        let (english, chinese) = (pages(Lang::En), pages(Lang::Zh));
        for (one, other) in english.iter().zip(&chinese) {
            all.extend(faults(t.name, one));
            let lines = |id: &String| {
                id.starts_with("sentence-") || id.starts_with("answer") || id.starts_with("step")
            };
            all.extend(
                named(one)
                    .symmetric_difference(&named(other))
                    .filter(|id| !lines(id))
                    .map(|id| format!("{}: {id} in one language", t.name)),
            );
            all.extend(
                one.items
                    .iter()
                    .filter(|i| i.id.is_empty())
                    .map(|i| format!("{}: {} has no id", t.name, i.class)),
            );
        }
    }
    assert!(all.is_empty(), "{} faults:\n{}", all.len(), all.join("\n"));
    // v_A of a pursuit, a_e^n of a point of a plate, to their scales.
    for (name, vectors) in [("pursuit", ["v_A", "a_A"]), ("plate-in-space", ["vr_M", "ak_M"])] {
        let solved = solve(
            &problem::read(problem::templates::text(name, &[]).unwrap()).unwrap().value,
            &problem::Options::with_figures(),
        )
        .unwrap();
        let pages = solved.figures(&Pictures::default(), &Look::default()).unwrap().value;
        for vector in vectors {
            let shown = pages
                .iter()
                .find_map(|(_, figure)| figure.vector(vector))
                .unwrap_or_else(|| panic!("{name} shows no {vector}"));
            assert!(
                shown.mm > 1.0 && shown.si > 0.0,
                "{name} {vector}: {} mm, {} SI",
                shown.mm,
                shown.si
            );
            // In its own view a vector of the plate has its true length.
            let Some(value) = solved.answer(vector, &Look::default()).and_then(|a| a.value) else {
                continue;
            };
            let exact = value.magnitude();
            assert!(
                (shown.si - exact).abs() < 1e-9 * exact,
                "{name} {vector}: {} is drawn, {exact} is the answer",
                shown.si
            );
        }
    }
}
