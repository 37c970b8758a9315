//! The lesson of a design: every step shows its items, names are legible from the last row, nothing
//! is cut off, and the linkage stops where the library says.

use super::*;
use hodograph::figure::synthesis::to_scale;
use hodograph::lesson::design;
use hodograph::synthesis::{self, DesignCandidate, KINDS, Task};
use serde_json::json;

const SMALL_PROJECTOR: [u32; 2] = [1280, 720];

/// For all drawings: the least height of a name's first letter (px), the items that are cut by the
/// drawing, and drawings beyond the window's sides.
pub const DRAWINGS: &str = r##"(() => {
    let least = Infinity, count = 0;
    const cut = [];
    for (const svg of document.querySelectorAll(".drawing svg")) {
        const box = svg.getBoundingClientRect(), place = svg.parentElement.getBoundingClientRect();
        if (place.right > innerWidth + 1 || place.left < -1) cut.push("drawing beyond the window");
        for (const e of svg.querySelectorAll(".label")) {
            const r = e.getBoundingClientRect(), letter = (e.querySelector("use, path") || e).getBoundingClientRect();
            // A dash is a letter without height.
            if (letter.height <= 0.45 * letter.width) continue;
            least = Math.min(least, letter.height), count++;
            if (r.left < box.left - 1 || r.right > box.right + 1 || r.top < box.top - 1 || r.bottom > box.bottom + 1) cut.push(e.id || e.outerHTML.slice(0, 80));
        }
    }
    return { least, count, cut };
})()"##;

/// For the words of a step: words wider than their space, or below a window that does not scroll.
pub const WORDS: &str = r##"(() => {
    const s = document.getElementById("sentence"), r = s.getBoundingClientRect(), cut = [];
    if (r.right > innerWidth + 1 || s.scrollWidth > s.clientWidth + 1) cut.push("the sentence is too wide");
    if (getComputedStyle(document.getElementById("steps")).position === "fixed") {
        const box = document.getElementById("steps");
        if (box.scrollHeight > box.clientHeight + 1) cut.push("the sentence is scrolled");
    }
    return cut;
})()"##;

/// Parts of the construction that the page shows in this step.
pub const SEEN: &str = "[...document.querySelectorAll('[data-step]')].filter((g) => !g.classList.contains('later')).length";

fn of_kind(name: &str) -> (Task, DesignCandidate, usize, PathBuf) {
    let task = synthesis::read(synthesis::templates::get(name).unwrap()).unwrap().value;
    let candidate = synthesis::solve(&task).unwrap().candidates.remove(0);
    let steps = to_scale(&task, &candidate).unwrap().map_or(0, |b| b.steps.len());
    let page = design::lesson(
        &task,
        &candidate,
        &design::DesignOptions { lang: Lang::En, style: Style::default() },
    )
    .unwrap();
    let path =
        PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("lesson-design-{name}.html"));
    std::fs::write(&path, page).unwrap();
    (task, candidate, steps, path)
}

#[test]
fn designs_are_read_from_the_last_row_and_go_through_their_steps() {
    let Some(mut b) = browser() else { return };
    for kind in KINDS {
        let (_, candidate, steps, path) = of_kind(kind.name);
        for (window, least) in [(SMALL_PROJECTOR, 14.0), (PHONE, 11.0)] {
            b.open(&path, window);
            let told = format!("{} at {window:?}", kind.name);
            let over =
                b.eval("document.documentElement.scrollWidth - innerWidth").as_f64().unwrap();
            assert!(over <= 0.0, "{told} is {over} pixels too wide");
            let seen = b.eval(DRAWINGS);
            eprintln!(
                "{told}: letters of {:.1} px, {} names",
                seen["least"].as_f64().unwrap_or(0.0),
                seen["count"]
            );
            assert_eq!(seen["cut"], json!([]), "{told}");
            assert!(
                seen["count"] == 0 || seen["least"].as_f64().unwrap() >= least,
                "{told}: {seen}"
            );
            stepped(&mut b, &told, steps);
            stopped(&mut b, &told, &candidate);
        }
        assert_quiet(&b, kind.name);
    }
}

/// Goes through all steps in both languages: items of a step stay, and its sentence fits.
fn stepped(b: &mut Browser, told: &str, steps: usize) {
    if steps == 0 {
        assert_eq!(b.eval("document.getElementById('count') === null"), json!(true), "{told}");
        return;
    }
    for language in 0..2 {
        b.key("Home");
        let mut before = 0.0;
        for step in 1..=steps {
            assert_eq!(b.eval(WORDS), json!([]), "{told}, step {step}, language {language}");
            assert!(
                b.eval("document.getElementById('sentence').textContent.length").as_f64().unwrap()
                    > 3.0,
                "{told}, step {step}"
            );
            let now = b.eval(SEEN).as_f64().unwrap();
            assert!(now > before, "{told}: step {step} brings nothing");
            before = now;
            let last = b.eval("document.getElementById('next').disabled");
            assert_eq!(last, json!(step == steps), "{told}: {step} of {steps} steps");
            b.key("ArrowRight");
        }
        b.key("l");
    }
}

/// Checks the button for each prescribed position, at which the driver has the library's value.
fn stopped(b: &mut Browser, told: &str, candidate: &DesignCandidate) {
    let stops =
        b.eval("document.querySelectorAll('#stops button').length").as_f64().unwrap() as usize;
    assert!(stops > 0 && stops <= candidate.draft.wanted.len(), "{told}: {stops} stops");
    let wanted: Vec<f64> = candidate.draft.wanted.iter().map(|w| w.driver.to_degrees()).collect();
    for k in 0..stops {
        b.eval(&format!("document.querySelectorAll('#stops button')[{k}].click()"));
        let travel = b.eval("parseFloat(document.getElementById('travel').textContent.replace('−', '-').replace(/^[^0-9-]*/, ''))");
        let travel = travel.as_f64().unwrap_or_else(|| panic!("{told}: no driver's angle"));
        let near =
            wanted.iter().any(|w| ((w - travel + 180.0).rem_euclid(360.0) - 180.0).abs() < 0.06);
        assert!(near, "{told}: stop {k} at {travel}°, wanted {wanted:?}");
        assert!(
            b.eval("document.querySelectorAll('.linkage .reached').length").as_f64().unwrap() > 0.0,
            "{told}: stop {k}"
        );
    }
}
