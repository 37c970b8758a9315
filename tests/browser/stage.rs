//! Legibility from the last row and on a phone, measured in the browser: sizes of letters, filled
//! windows, nothing cut off.

use super::*;
use serde_json::Value;

const SMALL_PROJECTOR: [u32; 2] = [1280, 720];
const TEMPLATES: [&str; 7] = [
    "crank-rocker",
    "shaper",
    "excavator",
    "stephenson-six-bar",
    "class-iii-six-bar",
    "planetary-gear",
    "cam-offset-roller",
];

/// For the visible polygon: the least height of a name's first letter (px), the part of its
/// window's width or height that the drawing fills, and names cut by the window.
const POLYGON: &str = r##"(() => {
    const svg = [...document.querySelectorAll("#polygons .drawing")].find((f) => !f.classList.contains("aside")).querySelector("svg");
    const ink = svg.querySelector(".ink:not([display])"), box = svg.getBoundingClientRect();
    const seen = [...ink.children].filter((e) => e.getAttribute("display") !== "none" && !e.classList.contains("later"));
    const labels = seen.filter((e) => e.classList.contains("label"));
    const least = Math.min(...labels.map((e) => (e.querySelector("use, path") || e).getBoundingClientRect().height));
    const rects = seen.map((e) => e.getBoundingClientRect());
    const [left, top] = [Math.min(...rects.map((r) => r.left)), Math.min(...rects.map((r) => r.top))];
    const [right, bottom] = [Math.max(...rects.map((r) => r.right)), Math.max(...rects.map((r) => r.bottom))];
    const m = svg.getScreenCTM(), view = svg.viewBox.baseVal;
    const cut = labels.filter((e) => { const r = e.getBoundingClientRect();
        return r.left < box.left - 1 || r.right > box.right + 1 || r.top < box.top - 1 || r.bottom > box.bottom + 1; }).map((e) => e.id);
    return { least, count: labels.length, fill: Math.max((right - left) / (view.width * m.a), (bottom - top) / (view.height * m.d)), cut };
})()"##;

/// For the words: sentences and equations that are cut off or must be scrolled.
const WORDS: &str = r##"(() => {
    const told = document.getElementById("told"), room = told.getBoundingClientRect(), cut = [];
    const boxed = getComputedStyle(told).overflow === "hidden";
    for (const e of document.querySelectorAll("#sentence, #equation > *")) {
        const r = e.getBoundingClientRect();
        if (r.right > innerWidth + 1 || e.scrollWidth > e.parentElement.clientWidth + 1) cut.push(`${e.id || e.tagName} is too wide`);
        if (boxed && r.bottom > room.bottom + 1) cut.push(`${e.id || e.tagName} is too high by ${r.bottom - room.bottom}`);
    }
    if (boxed && room.bottom > innerHeight + 1) cut.push(`the words end ${room.bottom - innerHeight} px below the window`);
    return cut;
})()"##;

fn number(v: &Value, key: &str) -> f64 {
    v[key].as_f64().unwrap_or_else(|| panic!("{key} in {v}"))
}

fn measured(b: &mut Browser, name: &str, path: &std::path::Path, window: [u32; 2], least_px: f64) {
    b.open(path, window);
    b.key("End");
    for key in ["velocity", "acceleration"] {
        b.eval(&format!("document.getElementById('tab-{key}')?.click()"));
        let seen = b.eval(POLYGON);
        let (least, fill) = (number(&seen, "least"), number(&seen, "fill"));
        eprintln!(
            "{name} {key} at {window:?}: letters of {least:.1} px, {:.0} % filled, {} names",
            100.0 * fill,
            seen["count"]
        );
        assert!(least >= least_px, "{name} {key} at {window:?}: a letter is {least} px high");
        assert!(fill > 0.7, "{name} {key} at {window:?} fills {fill} of its window");
        assert_eq!(seen["cut"], serde_json::json!([]), "{name} {key} at {window:?}");
    }
    let over = b.eval("document.documentElement.scrollWidth - innerWidth").as_f64().unwrap();
    assert!(over <= 0.0, "{name} at {window:?} is {over} pixels too wide");
    for language in 0..2 {
        b.key("Home");
        for _ in 0..200 {
            assert_eq!(
                b.eval(WORDS),
                serde_json::json!([]),
                "{name} at {window:?}, language {language}: {}",
                b.eval("document.getElementById('count').textContent")
            );
            if b.eval("document.getElementById('next').disabled") == true {
                break;
            }
            b.key("ArrowRight");
        }
        b.key("l");
    }
    assert_quiet(b, name);
}

#[test]
fn letters_are_read_from_the_last_row_and_nothing_is_cut() {
    let Some(mut b) = browser() else { return };
    for name in TEMPLATES.into_iter().step_by(every(4)) {
        let path = page(&format!("stage-{name}"), &template(name));
        for (window, least) in [(SMALL_PROJECTOR, 14.0), (PROJECTOR, 20.0), (PHONE, 11.0)] {
            measured(&mut b, name, &path, window, least);
        }
        // On a phone the polygon stays above the words while the reader scrolls them.
        b.open(&path, PHONE);
        b.key("Home");
        b.key("ArrowRight");
        b.key("ArrowRight");
        let read = "(() => { const s = document.querySelector('#equation').getBoundingClientRect(); scrollBy(0, Math.max(0, s.bottom - innerHeight + 60)); \
                    const p = document.querySelector('#polygons .drawing:not(.aside)').getBoundingClientRect(); \
                    const t = document.querySelector('#sentence').getBoundingClientRect(); return [p.top, p.bottom, t.top, t.bottom, innerHeight]; })()";
        let v: Vec<f64> = serde_json::from_value(b.eval(read)).unwrap();
        assert!(
            v[0] >= 0.0 && v[1] <= v[2] + 1.0 && v[3] <= v[4] - 40.0,
            "{name}: polygon from {} to {}, sentence from {} to {} of {}",
            v[0],
            v[1],
            v[2],
            v[3],
            v[4]
        );
    }
}

/// Paths, hodographs and vectors are drawn at their places, and grow while the driver turns.
#[test]
fn what_is_drawn_over_the_drawings_is_true() {
    let Some(mut b) = browser() else { return };
    let scene = template("crank-rocker");
    b.open(&page("over", &scene), SMALL_PROJECTOR);
    let count = |b: &mut Browser, what: &str| {
        b.eval(&format!("document.querySelectorAll('{what}').length")).as_u64().unwrap()
    };
    for (key, what) in [
        ("c", "#mechanism .path"),
        ("v", "#mechanism .vector.velocity"),
        ("a", "#mechanism .vector.acceleration"),
        ("h", "#velocity .hodograph"),
    ] {
        assert_eq!(count(&mut b, what), 0);
        b.key(key);
        assert!(count(&mut b, what) > 0, "{what}");
    }
    // The velocity of C on the mechanism has the library's direction and begins at C.
    let (_, worked) = worked_at(&mut b, &scene, 0.0);
    let c = scene.points.iter().position(|p| p.name == "C").unwrap();
    let at = worked.configuration.points[c].unwrap() - worked.construction.diagram.origin;
    let place = in_window(&mut b, [at.x, at.y]);
    let ends = "[...document.querySelectorAll('#mechanism .vector.velocity:not(.head)')].map((e) => { const n = e.getAttribute('d').match(/-?[\\d.]+/g).map(Number); \
                const m = e.getScreenCTM(); return [0, 2].flatMap((i) => { const p = new DOMPoint(n[i], n[i + 1]).matrixTransform(m); return [p.x, p.y]; }); })";
    let ends: Vec<[f64; 4]> = serde_json::from_value(b.eval(ends)).unwrap();
    let own = ends
        .iter()
        .find(|e| (e[0] - place[0]).hypot(e[1] - place[1]) < 0.5)
        .unwrap_or_else(|| panic!("{ends:?} {place:?}"));
    let p = worked.construction.polygon(DiagramKind::Velocity).unwrap();
    let of_c = worked
        .plan
        .vertices
        .iter()
        .position(|v| matches!(v.spot, hodograph::plan::VertexPlace::Point(q) if q.0 == c))
        .unwrap();
    let v = p.images[of_c].unwrap();
    let off = ((own[3] - own[1]) * v.x + (own[2] - own[0]) * v.y).abs()
        / v.to_vec2().norm()
        / (own[2] - own[0]).hypot(own[3] - own[1]);
    assert!(off < 1e-2 && (own[2] - own[0]) * v.x > 0.0, "{own:?} {v:?}");
    // During playback a hodograph grows from the start of the motion; also backwards and faster.
    b.key(">");
    b.key("b");
    b.eval("new Promise((done) => setTimeout(done, 300))");
    let length = |b: &mut Browser| {
        b.eval("document.querySelector('#velocity .hodograph').getTotalLength()").as_f64().unwrap()
    };
    let early = length(&mut b);
    b.eval("new Promise((done) => setTimeout(done, 500))");
    let later = length(&mut b);
    b.key("b");
    assert!(later > early && early > 0.0, "{early} {later}");
    assert_quiet(&b, "over");
}

/// All positions have one scale; where a vector would leave the paper the window becomes larger,
/// once in a turn, and the drawing stays true.
#[test]
fn one_scale_and_at_most_one_larger_window() {
    let Some(mut b) = browser() else { return };
    let scene = template("slotted-lever");
    b.open(&page("scales", &scene), PROJECTOR);
    let caption = "document.querySelector('#acceleration .scale').textContent";
    let first = b.eval(caption);
    let mut windows = vec![b.eval("document.querySelector('#acceleration svg').dataset.mu")];
    for _ in 0..13 {
        assert_eq!(b.eval(caption), first);
        let there = travel(&mut b);
        let (scene_there, worked) = worked_at(&mut b, &scene, there);
        let (shown, drawn) = (shown(&mut b), drawn(&scene_there, &worked));
        for (id, want) in drawn {
            let worst = shown[&id].iter().zip(want).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(worst < 1e-2, "{there}: {id} is off by {worst} mm");
        }
        for _ in 0..7 {
            b.key("+");
        }
        let window = b.eval("document.querySelector('#acceleration svg').dataset.mu");
        if windows.last() != Some(&window) {
            windows.push(window);
        }
    }
    assert_eq!(windows.len(), 2, "{windows:?}");
    b.key("0");
    assert_eq!(
        b.eval("document.querySelector('#acceleration svg').dataset.mu"),
        windows[0],
        "the given position fills its window again"
    );
    assert_quiet(&b, "scales");
}

/// The names of a polygon have one size in all frames, even if many of its vectors vanish in some.
#[test]
fn names_keep_their_size() {
    for name in ["double-butterfly", "jansen-leg"] {
        let page = lesson(&template(name), &LessonOptions::of_language(Lang::En)).unwrap().value;
        let figures: Vec<&str> = page
            .split("<figure id=\"acceleration")
            .skip(1)
            .filter_map(|rest| rest.split("</figure>").next())
            .collect();
        assert!(!figures.is_empty());
        for figure in figures {
            let sizes: std::collections::BTreeSet<&str> =
                figure.split("scale(").skip(1).filter_map(|rest| rest.split(')').next()).collect();
            assert_eq!(sizes.len(), 1, "{name}: {sizes:?}");
        }
    }
}

/// A polygon of many vectors is split by group: each step is drawn in its part, no part has more
/// names than are legible, and in every position the vectors are those of the library's whole
/// polygon.
#[test]
fn a_polygon_of_many_vectors_is_split() {
    let Some(mut b) = browser() else { return };
    let scene = template("excavator");
    b.open(&page("split", &scene), PROJECTOR);
    let parts: Vec<String> = serde_json::from_value(
        b.eval("[...document.querySelectorAll('#polygons figure')].map((f) => f.id)"),
    )
    .unwrap();
    assert!(
        parts.len() > 4 && parts.iter().all(|p| p.ends_with(|c: char| c.is_ascii_digit())),
        "{parts:?}"
    );
    // Ids are unique in the document.
    let twice = "(() => { const ids = [...document.querySelectorAll('[id]')].map((e) => e.id); return ids.length - new Set(ids).size; })()";
    assert_eq!(b.eval(twice), 0);
    let names = "[...document.querySelectorAll('#polygons figure')].map((f) => f.querySelectorAll('.ink:not([display]) > .label:not([display])').length)";
    let names: Vec<usize> = serde_json::from_value(b.eval(names)).unwrap();
    assert!(names.iter().all(|n| *n <= 24), "{names:?}");
    // Items of a step are highlighted in the visible part only.
    b.key("Home");
    let now = "[...document.querySelectorAll('#polygons figure')].filter((f) => f.querySelector('.ink:not([display]) > .now:not([display])')).map((f) => [f.id, f.classList.contains('aside')])";
    let mut seen = std::collections::BTreeSet::new();
    loop {
        b.key("ArrowRight");
        let marked: Vec<(String, bool)> = serde_json::from_value(b.eval(now)).unwrap();
        let on_stage: Vec<String> = marked.iter().filter(|m| !m.1).map(|m| m.0.clone()).collect();
        assert!(marked.is_empty() || on_stage.len() == 1, "{marked:?}");
        seen.extend(on_stage);
        if b.eval("document.getElementById('next').disabled") == true {
            break;
        }
    }
    assert_eq!(seen.len(), parts.len(), "{seen:?}");
    for _ in 0..4 {
        let there = travel(&mut b);
        let (scene_there, worked) = worked_at(&mut b, &scene, there);
        let library: Ends = drawn(&scene_there, &worked);
        let mut compared = 0;
        for (id, ends) in shown(&mut b) {
            // The figure `velocity-2` has the ids `vel-2-abs-B`, in the library they are
            // `vel-abs-B`.
            let own = |part: &str| {
                let (kind, number) = part.split_once('-')?;
                let kind = hodograph::paper::drawing::prefix(kind);
                Some(format!("{kind}-{}", id.strip_prefix(&format!("{kind}-{number}-"))?))
            };
            let Some((part, whole)) = parts.iter().find_map(|p| Some((p, own(p)?))) else {
                continue;
            };
            let Some(want) = library.get(&whole) else { continue };
            let mu: f64 = b
                .eval(&format!("document.querySelector('#{part} svg').dataset.mu"))
                .as_str()
                .unwrap()
                .parse()
                .unwrap();
            let on = if part.starts_with('a') {
                DiagramKind::Acceleration
            } else {
                DiagramKind::Velocity
            };
            let times = worked.construction.polygon(on).unwrap().mu / mu;
            let off = ends.iter().zip(want).map(|(a, b)| (a - b * times).abs()).fold(0.0, f64::max);
            assert!(off < 1e-2, "{id} at {there}: off by {off} mm");
            compared += 1;
        }
        assert!(compared > 40, "{compared}");
        // Not far: a distant position, solved alone, takes the assembly nearest to the scene's
        // coordinates.
        for _ in 0..3 {
            b.key("+");
        }
    }
    assert_quiet(&b, "split");
}
