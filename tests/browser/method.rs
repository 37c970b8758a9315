//! The lessons of methods, of designs, motions and equations on the one player: they open at the
//! first step, each step has a sentence, letters are read from the last row and on a phone, sheets
//! are printed with six steps on a page, and the speaker has a window.

use super::*;
use hodograph::figure::stepped::{ConstructionMethod, METHODS};
use serde_json::json;
use std::path::Path;

const SMALL_PROJECTOR: [u32; 2] = [1280, 720];

/// A scene for each method.
const SCENES: [(&str, &str); 10] = [
    ("crank-rocker", "centres"),
    ("slotted-lever", "composite"),
    ("cam-eccentric", "composite"),
    ("slider-crank", "curvature"),
    ("crank-rocker", "curvature"),
    ("cam-offset-roller", "cam"),
    ("planetary-gear", "trains"),
    ("three-planets", "trains"),
    ("crank-rocker", "loops"),
    ("lathe", "loops"),
];

/// The least height (px) of the first letter of the names in the drawings that are seen, but for
/// tables and signs.
const LETTERS: &str = r##"(() => {
    const shown = [...document.querySelectorAll(".drawing:not(.aside) svg")].filter((svg) => svg.getBoundingClientRect().height > 0);
    const names = shown.flatMap((svg) => [...svg.querySelectorAll("g.label, [class*=' label']")]);
    const first = (e) => (e.querySelector("use, path") || e).getBoundingClientRect();
    // A dash is a letter without height.
    const heights = names.map(first).filter((r) => r.height > 0.45 * r.width).map((r) => r.height);
    return heights.length ? Math.min(...heights) : 1e3;
})()"##;

fn of_method(name: &str, method: &str) -> PathBuf {
    let options = LessonOptions {
        method: ConstructionMethod::named(method),
        positions: 12,
        ..LessonOptions::of_language(Lang::En)
    };
    let page = lesson(&template(name), &options).unwrap_or_else(|f| panic!("{name}: {f}")).value;
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("lesson-{name}-{method}.html"));
    std::fs::write(&path, page).unwrap();
    path
}

fn count(b: &mut Browser) -> [usize; 2] {
    let numbers = b.eval("document.getElementById('count').textContent.match(/\\d+/g).map(Number)");
    serde_json::from_value(numbers).unwrap()
}

#[test]
fn every_method_has_a_lesson_that_is_read_from_the_last_row() {
    let Some(mut b) = browser() else { return };
    for entry in &METHODS {
        assert!(SCENES.iter().any(|s| s.1 == entry.name), "{} has no scene here", entry.name);
    }
    for (name, method) in SCENES {
        let path = of_method(name, method);
        for (window, least) in [(SMALL_PROJECTOR, 14.0_f64), (PHONE, 11.0)] {
            b.open(&path, window);
            let told = format!("{name} by {method} at {window:?}");
            let [first, all] = count(&mut b);
            assert!(first == 1 && all > 3, "{told} opens at step {first} of {all}");
            let over =
                b.eval("document.documentElement.scrollWidth - innerWidth").as_f64().unwrap();
            assert!(over <= 0.0, "{told} is {over} pixels too wide");
            let mut seen = b.eval(design::SEEN).as_f64().unwrap();
            let begun = seen;
            for step in 1..=all {
                for language in 0..2 {
                    let sentence = b.eval("document.getElementById('sentence').textContent");
                    let sentence = sentence.as_str().unwrap();
                    assert!(sentence.trim().chars().count() > 3, "{told}, step {step}: {sentence}");
                    assert!(!sentence.contains("undefined"), "{told}, step {step}: {sentence}");
                    assert_eq!(b.eval(design::WORDS), json!([]), "{told}, step {step}, {language}");
                    b.key("l");
                }
                let letters = b.eval(LETTERS).as_f64().unwrap();
                // Far places make a large drawing, which larger type would hide.
                let least = if method == "curvature" { least.min(12.0) } else { least };
                assert!(letters >= least, "{told}, step {step}: letters of {letters} px");
                let now = b.eval(design::SEEN).as_f64().unwrap();
                assert!(now >= seen, "{told}: step {step} takes something away");
                seen = now;
                b.key("ArrowRight");
            }
            assert!(seen > begun, "{told}: the steps add nothing");
            assert_eq!(b.eval("document.getElementById('next').disabled"), true, "{told}");
            // The driver moves, the step stays.
            b.key("+");
            assert_eq!(count(&mut b), [all, all], "{told}");
        }
        assert_quiet(&b, name);
    }
}

/// In print each step is a card, and a page has six of them.
#[test]
fn sheets_have_six_steps_on_a_page() {
    let Some(mut b) = browser() else { return };
    for path in [page("sheets", &template("crank-rocker")), of_method("crank-rocker", "centres")] {
        b.open(&path, SMALL_PROJECTOR);
        let [_, steps] = count(&mut b);
        b.eval("dispatchEvent(new Event('beforeprint'))");
        b.call("Emulation.setEmulatedMedia", json!({"media": "print"}));
        let cards = "[...document.querySelectorAll('#all li')].map((li) => { const r = li.getBoundingClientRect(), s = li.querySelector('svg').getBoundingClientRect(), \
                     t = li.lastChild.getBoundingClientRect(); return [r.height, s.height, r.bottom - t.bottom, li.textContent.length]; })";
        let cards: Vec<[f64; 4]> = serde_json::from_value(b.eval(cards)).unwrap();
        assert_eq!(cards.len(), steps);
        let page_px = (297.0 - 24.0) / 25.4 * 96.0;
        for [height, picture, below, letters] in cards {
            assert!(3.0 * height < page_px && 4.0 * height > page_px, "{height} px");
            assert!(picture > 60.0 && below > -1.0 && letters > 4.0, "{picture} {below} {letters}");
        }
        assert_eq!(b.eval("document.querySelectorAll('svg .later').length"), 0);
        b.call("Emulation.setEmulatedMedia", json!({"media": ""}));
        b.eval("dispatchEvent(new Event('afterprint'))");
        assert_eq!(count(&mut b)[0], 1);
        assert_eq!(b.eval("document.querySelectorAll('#all li').length"), 0);
    }
}

/// The speaker's window shows what is said now and next, follows the page, and moves it.
#[test]
fn the_speaker_has_a_window() {
    let Some(mut b) = browser() else { return };
    for path in [page("speaker", &template("crank-rocker")), of_method("slider-crank", "curvature")]
    {
        b.open(&path, SMALL_PROJECTOR);
        // The window is a frame here: a test opens no second window.
        b.eval("void (window.open = () => { const f = document.createElement('iframe'); f.id = 'desk'; document.body.append(f); return f.contentWindow; })");
        b.key("s");
        let text = |b: &mut Browser, id: &str| {
            let script = format!(
                "document.getElementById('desk').contentDocument.getElementById('{id}').textContent"
            );
            b.eval(&script).as_str().unwrap().to_owned()
        };
        let sentence = "document.getElementById('sentence').textContent";
        let now = b.eval(sentence).as_str().unwrap().to_owned();
        assert!(text(&mut b, "now").contains(&now), "{}", text(&mut b, "now"));
        let next = text(&mut b, "coming");
        assert!(next.starts_with("Next") && !text(&mut b, "answers").is_empty());
        assert!(text(&mut b, "clock").contains(':'));
        b.eval("void document.getElementById('desk').contentWindow.dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowRight' }))");
        assert_eq!(count(&mut b)[0], 2, "the speaker moves the page");
        let after = b.eval(sentence).as_str().unwrap().to_owned();
        assert!(next.contains(&after) && text(&mut b, "now").contains(&after), "{next}: {after}");
        assert_quiet(&b, "speaker");
    }
}

/// Prediction hides the direction that it asks for, helps on demand, and counts without flattery.
#[test]
fn prediction_hides_the_answer_and_counts_honestly() {
    let Some(mut b) = browser() else { return };
    b.open(&page("hints", &template("crank-rocker")), SMALL_PROJECTOR);
    let text = predict::text;
    b.key("q");
    assert!(predict::asking(&mut b));
    let equation = text(&mut b, "equation");
    assert!(!equation.contains('⊥'), "{equation}");
    let ink = "[...document.querySelectorAll('#equation .now')].map((e) => getComputedStyle(e).color === getComputedStyle(document.body).color)";
    let inks: Vec<bool> = serde_json::from_value(b.eval(ink)).unwrap();
    assert!(inks.iter().all(|plain| *plain), "what is asked is in red");
    // A hint, then the answer shown: neither counts as a first try.
    b.key("?");
    assert_eq!(text(&mut b, "verdict"), "It is square to AB.");
    b.key("?");
    assert!(text(&mut b, "verdict").contains("Its sense follows from that of"));
    b.key("PageDown");
    let verdict = text(&mut b, "verdict");
    assert!(verdict.contains("0 of 1 at the first try. 1 shown."), "{verdict}");
    b.key("Enter");
    assert!(predict::asking(&mut b));
    assert_eq!(text(&mut b, "verdict"), "", "the last verdict is forgotten");
    let equation = bare(&text(&mut b, "equation"));
    assert!(equation.contains('?') && equation.contains("vCB"), "{equation}");
    assert!(!equation.contains("⊥BC") && !equation.contains("⊥CD"), "{equation}");
    assert_quiet(&b, "hints");
}

/// Two fragments with prefixes of their own share no id.
#[test]
fn two_fragments_in_one_page_share_no_id() {
    let folder = tempfile::tempdir().unwrap();
    let ids = |prefix: &str| {
        let path = folder.path().join(format!("{prefix}.html"));
        assert_cmd::Command::cargo_bin("hodograph")
            .unwrap()
            .args(["lesson", concat!(env!("CARGO_MANIFEST_DIR"), "/templates/crank-rocker.json")])
            .args(["--reveal", "--id-prefix", prefix, "-o"])
            .arg(&path)
            .assert()
            .code(0);
        let text = std::fs::read_to_string(path).unwrap();
        assert!(text.contains("data-fragment-index"));
        let ids = text.split(" id=\"").skip(1).filter_map(|rest| rest.split('"').next());
        ids.map(str::to_owned).collect::<BTreeSet<String>>()
    };
    let (one, two) = (ids("one-"), ids("two-"));
    assert!(one.len() > 5 && one.is_disjoint(&two), "{:?}", one.intersection(&two));
}
