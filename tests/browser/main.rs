//! Lessons and sheets in a real Chromium: drags and steps must show the values of the library, and
//! items must be placed where the checks of sheets assume them ([`ink`]).
//!
//! The browser is `$CHROMIUM`, `chromium`, `chromium-browser` or `google-chrome`; without one these
//! tests report that they were skipped. (Debian and Ubuntu: `apt-get install chromium`.)

mod chromium;
mod design;
mod forces;
mod grip;
mod ink;
mod method;
mod motion;
mod predict;
mod stage;
mod time;
mod touch;
mod weight;
#[path = "../wide/mod.rs"]
mod wide;

use chromium::Browser;
use grip::let_go;
use hodograph::figure::{mechanism, polygon};
use hodograph::lesson::{LessonOptions, lesson};
use hodograph::notation::Notation;
use hodograph::paper::item::Shape;
use hodograph::paper::style::Style;
use hodograph::plan::text::PlanWriter;
use hodograph::report::construction::sentences;
use hodograph::scene::{
    self, DiagramKind, DriverKind, Kind, Lang, Scene, driver_position, templates, with_driver_at,
};
use hodograph::sweep::extreme::ends;
use hodograph::worked::{Scope, Worked, work};
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use wide::every;

const PROJECTOR: [u32; 2] = [1920, 1080];
const PHONE: [u32; 2] = [390, 844];

fn browser() -> Option<Browser> {
    let found = chromium::found();
    if found.is_none() {
        eprintln!(
            "skipped: no Chromium on this machine ($CHROMIUM, chromium, chromium-browser, google-chrome)"
        );
    }
    found.map(|program| Browser::start(&program))
}

fn template(name: &str) -> Scene {
    scene::read(templates::get(name).unwrap()).unwrap().value
}

/// Writes the lesson of a scene to a file.
fn page(name: &str, scene: &Scene) -> PathBuf {
    let page = lesson(scene, &LessonOptions::of_language(Lang::En))
        .unwrap_or_else(|f| panic!("{name}: {f}"))
        .value;
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("lesson-{name}.html"));
    std::fs::write(&path, page).unwrap();
    path
}

/// Asserts that the page requested nothing but itself and wrote no message.
fn assert_quiet(b: &Browser, name: &str) {
    let (asked, said) = b.asked_and_said();
    let foreign: Vec<&String> =
        asked.iter().filter(|u| !u.starts_with("file://") && !u.starts_with("data:")).collect();
    assert!(
        asked.iter().filter(|u| u.starts_with("file://")).count() <= 1 && foreign.is_empty(),
        "{name} fetches {asked:?}"
    );
    assert!(said.is_empty(), "{name}: the console says {said:?}");
}

/// The scene with its driver moved on by `travel`, solved to the scales of the page.
fn worked_at(b: &mut Browser, scene: &Scene, travel: f64) -> (Scene, Worked) {
    let start = driver_position(scene, 0).unwrap();
    let mut there = with_driver_at(scene, 0, start + travel);
    let mut mu = |key: &str| {
        b.eval(&format!("document.querySelector('#{key} svg')?.dataset.mu ?? ''"))
            .as_str()
            .unwrap()
            .parse::<f64>()
            .ok()
    };
    for (kind, shows) in [
        (Kind::Length, "mechanism"),
        (Kind::Velocity, "velocity"),
        (Kind::Acceleration, "acceleration"),
    ] {
        there.paper.scales.set(kind, mu(shows));
    }
    let worked = work(&there, Scope::Figure).unwrap().value;
    (there, worked)
}

type Ends = BTreeMap<String, [f64; 4]>;

/// Every arrow of a polygon and every pin of the mechanism on the page: tail and tip, or the centre
/// twice, in mm from the pole or the diagram's origin, y up.
fn shown(b: &mut Browser) -> Ends {
    let script = r#"(() => {
        const out = {};
        for (const svg of document.querySelectorAll(".drawing svg")) {
            const [x, y] = svg.dataset.origin.split(" ").map(Number);
            const ink = svg.querySelector(".ink:not([display])");
            if (ink.style.display === "none") continue;
            for (const e of ink.children) {
                if (e.getAttribute("display") === "none" || e.classList.contains("label")) continue;
                if (e.tagName === "circle" && /pin/.test(e.getAttribute("class"))) {
                    const [cx, cy] = ["cx", "cy"].map((a) => Number(e.getAttribute(a)));
                    out[e.id || e.dataset.id] = [cx - x, y - cy, cx - x, y - cy];
                } else if (e.tagName === "g" && /edge|absolute/.test(e.getAttribute("class"))) {
                    const [x1, y1] = ["x1", "y1"].map((a) => Number(e.querySelector("line").getAttribute(a)));
                    const [tx, ty] = e.querySelector("path").getAttribute("d").match(/-?[\d.]+/g).map(Number);
                    out[e.id || e.dataset.id] = [x1 - x, y - y1, tx - x, y - ty];
                }
            }
        }
        return out;
    })()"#;
    let value = b.eval(script);
    let ends = |v: &serde_json::Value| std::array::from_fn(|i| v[i].as_f64().unwrap());
    value.as_object().unwrap().iter().map(|(id, v)| (id.clone(), ends(v))).collect()
}

/// Every arrow and pin in the library's own drawings.
fn drawn(scene: &Scene, worked: &Worked) -> Ends {
    let notation = Notation::of_language(Lang::En);
    let w = PlanWriter { scene, plan: &worked.plan, notation: &notation, lang: Lang::En };
    let mut items = mechanism::mechanism(&Style::default(), scene, worked, &notation).items;
    for on in DiagramKind::POLYGONS {
        items.extend(
            worked
                .construction
                .polygon(on)
                .map(|p| {
                    polygon::drawing(&Style::default(), &w, p, polygon::is_full(&w, p))
                        .finish()
                        .items
                })
                .unwrap_or_default(),
        );
    }
    let ends = items.into_iter().filter_map(|i| match i.shape {
        Shape::Circle { centre, .. } if i.class.contains("pin") => {
            Some((i.id, [centre.x, centre.y, centre.x, centre.y]))
        }
        Shape::Arrow { from, to, .. }
            if i.class.contains("edge") || i.class.contains("absolute") =>
        {
            Some((i.id, [from.x, from.y, to.x, to.y]))
        }
        _ => None,
    });
    ends.collect()
}

/// The place in the window of a point of the mechanism (m from the diagram's origin, y up).
fn in_window(b: &mut Browser, [x, y]: [f64; 2]) -> [f64; 2] {
    let script = format!(
        "(() => {{ const svg = document.querySelector('#mechanism svg'); const [x, y] = svg.dataset.origin.split(' ').map(Number); \
         const mu = Number(svg.dataset.mu); \
         const p = new DOMPoint(x + ({x}) / mu, y - ({y}) / mu).matrixTransform(svg.getScreenCTM()); return [p.x, p.y]; }})()"
    );
    let v = b.eval(&script);
    [v[0].as_f64().unwrap(), v[1].as_f64().unwrap()]
}

fn travel(b: &mut Browser) -> f64 {
    b.eval("document.querySelector('.grip').dataset.travel").as_str().unwrap().parse().unwrap()
}

/// The crank's joint (m from the diagram's origin), and the crank's length.
fn crank(scene: &Scene, worked: &Worked) -> ([f64; 2], f64) {
    let DriverKind::Turn { link, against, .. } = scene.drivers[0].kind else {
        panic!("the driver turns")
    };
    let at = |p: scene::PointId| worked.configuration.points[p.0].unwrap();
    let points = &scene.links[link.0].points;
    let joint = points.iter().find(|p| scene.links[against.0].points.contains(p)).unwrap();
    let end = points
        .iter()
        .max_by(|a, b| at(**a).distance(at(*joint)).total_cmp(&at(**b).distance(at(*joint))))
        .unwrap();
    let diagram = &worked.construction.diagram;
    let centre = at(*joint) - diagram.origin;
    ([centre.x, centre.y], at(*end).distance(at(*joint)))
}

#[test]
fn a_dragged_crank_shows_what_the_library_computes() {
    let Some(mut b) = browser() else { return };
    let mut compared = 0;
    for name in ["crank-rocker", "slotted-lever", "shaper", "watt-six-bar", "class-iii-six-bar"]
        .into_iter()
        .step_by(every(2))
    {
        let scene = template(name);
        let window = if name == "shaper" { PHONE } else { PROJECTOR };
        b.open(&page(name, &scene), window);
        let start = driver_position(&scene, 0).unwrap();
        let (_, first) = worked_at(&mut b, &scene, 0.0);
        let (centre, radius) = crank(&scene, &first);
        let mut from = start.to_degrees();
        // With the triad, the crank can only rock.
        for degrees in if name == "class-iii-six-bar" {
            [17.0_f64, 101.5, 60.0, -33.0]
        } else {
            [17.0, 143.0, 260.0, 331.5]
        } {
            // Along the circle, as by hand: the crank's path is closed.
            let on = |d: f64| {
                [
                    centre[0] + radius * d.to_radians().cos(),
                    centre[1] + radius * d.to_radians().sin(),
                ]
            };
            let grip = in_window(&mut b, on(from));
            b.mouse("mousePressed", grip);
            for k in 1..=6 {
                let place = in_window(&mut b, on(from + (degrees - from) * f64::from(k) / 6.0));
                b.mouse("mouseMoved", place);
            }
            let travelled = travel(&mut b);
            let angle = (start + travelled).to_degrees();
            let off = (angle - degrees + 180.0).rem_euclid(360.0) - 180.0;
            assert!(off.abs() < 0.05, "{name}: dragged to {degrees}°, the page says {angle}°");
            let (there, worked) = worked_at(&mut b, &scene, travelled);
            let (shown, drawn) = (shown(&mut b), drawn(&there, &worked));
            // Between two frames the page shows the arrows of the nearer one. Where two vectors
            // nearly coincide, or where another special point becomes the better one, these are not
            // all arrows.
            let apart: Vec<&String> = shown
                .keys()
                .filter(|id| !drawn.contains_key(*id))
                .chain(drawn.keys().filter(|id| !shown.contains_key(*id)))
                .collect();
            assert!(
                apart.len() * 4 <= drawn.len(),
                "{name} at {degrees}°: {apart:?} of {:?}",
                drawn.keys()
            );
            if !apart.is_empty() {
                eprintln!("{name} at {degrees}°: only on one side {apart:?}");
            }
            // Arrows of the special point change with it at once, between two frames.
            let special = |id: &str| name == "class-iii-six-bar" && id.contains('S');
            for (id, want) in drawn.iter().filter(|(id, _)| shown.contains_key(*id) && !special(id))
            {
                let worst =
                    shown[id].iter().zip(want).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                // A vector close to zero (below 0.05 mm it is a dot) is not followed between its
                // last frame and none.
                let length = (want[2] - want[0]).hypot(want[3] - want[1]);
                let most = [(0.2, 0.1), (1.0, 2e-2)]
                    .iter()
                    .find(|m| length > 0.0 && length < m.0)
                    .map_or(1e-2, |m| m.1);
                assert!(
                    worst < most,
                    "{name} at {degrees}°: {id} is off by {worst} mm: {:?} instead of {want:?}",
                    shown[id]
                );
                compared += 4;
            }
            let place = in_window(&mut b, on(degrees));
            let_go(&mut b, place);
            // At rest the driver is where the numbers are known.
            from = (start + travel(&mut b)).to_degrees();
        }
        assert_quiet(&b, name);
    }
    assert!(compared > 500, "{compared}");
}

/// Text without spaces and without marks that formulas set in another way.
fn bare(text: &str) -> String {
    let text = text.replace('²', "2"); // A page raises the digit itself.
    // The page joins a formula and its punctuation by a word joiner.
    text.chars()
        .filter(|c| !c.is_whitespace() && !matches!(c, '_' | '^' | '{' | '}' | '′' | '\u{2060}'))
        .collect()
}

#[test]
fn every_step_reveals_what_it_names() {
    let Some(mut b) = browser() else { return };
    for name in ["crank-rocker", "shaper", "class-iii-six-bar"] {
        let scene = template(name);
        b.open(&page(name, &scene), PROJECTOR);
        let (there, worked) = worked_at(&mut b, &scene, 0.0);
        let notation = Notation::of_language(Lang::En);
        b.key("Home");
        let visible = r##"[...document.querySelectorAll("#velocity .ink:not([display]) > *, #acceleration .ink:not([display]) > *")]
            .filter((e) => getComputedStyle(e).visibility !== "hidden" && e.getAttribute("display") !== "none").map((e) => e.id || e.dataset.id)
            .filter((id) => !id.endsWith("-leader"))"##;
        assert_eq!(
            b.eval(visible).as_array().unwrap().len(),
            0,
            "{name}: the construction begins with empty paper"
        );
        let mut before: BTreeSet<String> = BTreeSet::new();
        let levels =
            [(DiagramKind::Velocity, "velocity"), (DiagramKind::Acceleration, "acceleration")];
        for (on, key) in levels {
            let Some(p) = worked.construction.polygon(on) else { continue };
            let w = PlanWriter {
                scene: &there,
                plan: &worked.plan,
                notation: &notation,
                lang: Lang::En,
            };
            let items =
                polygon::drawing(&Style::default(), &w, p, polygon::is_full(&w, p)).finish().items;
            // The lengths in the sentences are those of the figure.
            let own = work(&scene, Scope::Figure).unwrap().value;
            let writer =
                PlanWriter { scene: &scene, plan: &own.plan, notation: &notation, lang: Lang::En };
            let told = hodograph::certified::steps(&scene, &own, None);
            let said =
                sentences(&writer, &own.construction, own.construction.polygon(on).unwrap(), &told);
            let step = |class: &str| {
                class
                    .split(' ')
                    .filter_map(|w| w.strip_prefix("step-")?.parse::<usize>().ok())
                    .min()
                    .map_or(0, |n| n + 1)
            };
            // The space of a window decides which vectors are named.
            let all = r##"[...document.querySelectorAll(".ink:not([display]) > :not([display])")].map((e) => e.id || e.dataset.id)"##;
            let page: BTreeSet<String> = serde_json::from_value(b.eval(all)).unwrap();
            let both = |id: &str| {
                !id.contains("-label-") || page.contains(id) && items.iter().any(|i| i.id == id)
            };
            for (n, phrase) in said.iter().enumerate() {
                b.key(if n % 2 == 0 { "ArrowRight" } else { "PageDown" });
                let now: BTreeSet<String> = serde_json::from_value(b.eval(visible)).unwrap();
                let new: BTreeSet<&str> =
                    now.difference(&before).map(String::as_str).filter(|id| both(id)).collect();
                // A part without a step of its own belongs to the pole and appears with the first
                // sentence.
                let want: BTreeSet<&str> = items
                    .iter()
                    .filter(|i| step(&i.class) == n && !i.id.ends_with("-leader"))
                    .map(|i| i.id.as_str())
                    .filter(|id| both(id))
                    .collect();
                assert_eq!(new, want, "{name}, {key} step {n}: {}", phrase.plain());
                let text = b.eval("document.getElementById('sentence').textContent");
                assert_eq!(
                    bare(text.as_str().unwrap()),
                    bare(&phrase.plain()),
                    "{name}, {key} step {n}"
                );
                before = now;
            }
        }
        assert_eq!(b.eval("document.getElementById('next').disabled"), true, "{name}");
        b.key("ArrowLeft");
        assert_ne!(b.eval(visible).as_array().unwrap().len(), 0);
        assert_quiet(&b, name);
    }
}

#[test]
fn the_keyboard_alone_does_everything() {
    let Some(mut b) = browser() else { return };
    let scene = template("crank-rocker");
    b.open(&page("keyboard", &scene), PROJECTOR);
    // By Tab to the grip; the arrow keys turn the crank by one frame.
    for _ in 0..20 {
        b.key("Tab");
        if b.eval("document.activeElement.classList.contains('grip')") == true {
            break;
        }
    }
    assert_eq!(b.eval("document.activeElement.getAttribute('role')"), "slider");
    b.key("ArrowUp");
    b.key("ArrowRight");
    let on = travel(&mut b).to_degrees();
    assert!((4.9..10.1).contains(&on), "two frames on: {on}°");
    assert_eq!(
        b.eval("document.activeElement.getAttribute('aria-valuetext')").as_str().unwrap(),
        format!("φ_1 = {}°", 60.0 + (on * 10.0).round() / 10.0)
    );
    b.key("ArrowDown");
    b.key("ArrowLeft");
    assert!(travel(&mut b).abs() < 1e-12);
    b.eval("document.activeElement.blur()");
    b.key("+");
    assert!(travel(&mut b) > 0.0);
    b.key("0");
    assert_eq!(travel(&mut b), 0.0);
    b.key(" ");
    b.eval("new Promise((done) => setTimeout(done, 500))");
    let turned = travel(&mut b);
    b.key(" ");
    assert!(turned > 0.05, "it turns by itself: {turned}");
    // Switches languages, with all their words.
    let words = |b: &mut Browser| b.eval("document.body.innerText").as_str().unwrap().to_owned();
    assert!(
        !words(&mut b).contains("clockwise"),
        "the answers are hidden until they are asked for"
    );
    b.key("r");
    assert!(
        words(&mut b).contains("Velocities")
            && words(&mut b).contains("clockwise")
            && b.eval("document.documentElement.lang") == "en"
    );
    b.key("End");
    b.key("l");
    let chinese = words(&mut b);
    assert!(
        chinese.contains("加速度")
            && chinese.contains("逆时针")
            && b.eval("document.documentElement.lang") == "zh"
    );
    for english in
        ["Velocity", "Results", "clockwise", "Step", "Turn", "position", "undefined", "NaN"]
    {
        assert!(!chinese.contains(english), "{english} in\n{chinese}");
    }
    b.key("ArrowLeft");
    assert!(
        b.eval("document.getElementById('sentence').textContent")
            .as_str()
            .unwrap()
            .chars()
            .any(|c| c > '\u{4e00}')
    );
    b.key("l");
    assert!(
        !words(&mut b)
            .chars()
            .any(|c| ('\u{4e00}'..'\u{9fff}').contains(&c) && !"中文".contains(c))
    );
    let ink = "getComputedStyle(document.querySelector('.ink [stroke]')).stroke";
    let light = b.eval(ink);
    b.key("d");
    assert_ne!(b.eval(ink), light, "dark ink is light");
    assert_quiet(&b, "keyboard");
}

#[test]
fn a_limit_stops_the_driver_and_says_why() {
    let Some(mut b) = browser() else { return };
    let scene = template("five-bar");
    b.open(&page("limit", &scene), PROJECTOR);
    let start = driver_position(&scene, 0).unwrap();
    let said = |b: &mut Browser| {
        b.eval("document.getElementById('limit').textContent").as_str().unwrap().to_owned()
    };
    assert_eq!(said(&mut b), "");
    for (key, up) in [("+", true), ("-", false)] {
        for _ in 0..200 {
            b.key(key);
        }
        let end = travel(&mut b);
        let limit = ends(&scene, 0).unwrap()[usize::from(up)].unwrap();
        assert!((start + end - limit).abs() < 1e-6, "{} instead of {limit}", start + end);
        assert!(
            said(&mut b).contains("link 2 (BC) and link 3 (CD) lie in line"),
            "{}",
            said(&mut b)
        );
    }
    b.key("l");
    assert!(said(&mut b).contains("共线"), "{}", said(&mut b));
    b.key("+");
    assert_eq!(said(&mut b), "");
    assert_quiet(&b, "limit");
}

#[test]
fn pages_fit_phones_and_projectors_and_print() {
    let Some(mut b) = browser() else { return };
    for name in ["crank-rocker", "stephenson-six-bar", "robot-arm", "scotch-yoke", "excavator"]
        .into_iter()
        .step_by(every(2))
    {
        let path = page(&format!("fit-{name}"), &template(name));
        for window in [PHONE, PROJECTOR, [1024, 768]] {
            b.open(&path, window);
            let over =
                b.eval("document.documentElement.scrollWidth - innerWidth").as_f64().unwrap();
            assert!(over <= 0.0, "{name} at {window:?} is {over} pixels too wide");
            assert_quiet(&b, name);
        }
        // In print: every sentence, although only some steps were shown.
        let steps: u64 = serde_json::from_value(
            b.eval("Number(document.getElementById('count').textContent.match(/\\d+/g)[1])"),
        )
        .unwrap();
        b.eval("dispatchEvent(new Event('beforeprint'))");
        assert_eq!(b.eval("document.querySelectorAll('#all li').length").as_u64().unwrap(), steps);
        assert_eq!(b.eval("document.querySelectorAll('.ink .later').length"), 0);
        b.eval("dispatchEvent(new Event('afterprint'))");
        assert_ne!(b.eval("document.querySelectorAll('.ink .later').length"), 0);
    }
}

/// A slider is dragged along its line; motion of the pointer across the line has no effect.
#[test]
fn a_dragged_slider_follows_along_its_line() {
    let Some(mut b) = browser() else { return };
    let scene = template("elliptic-trammel");
    let DriverKind::Slide { guide, .. } = scene.drivers[0].kind else { panic!("a slider drives") };
    b.open(&page("slider", &scene), PHONE);
    let (_, first) = worked_at(&mut b, &scene, 0.0);
    let at = first.configuration.points[scene.guides[guide.0].pin.unwrap().0].unwrap();
    let Some(hodograph::position::Path::Line { direction, .. }) =
        first.configuration.guides[guide.0]
    else {
        panic!("a straight guide")
    };
    let diagram = &first.construction.diagram;
    let place = |along: f64, across: f64| {
        let p =
            (at - diagram.origin) + (direction * along + direction.perp() * across) * diagram.mu;
        [p.x, p.y]
    };
    let grip = in_window(&mut b, place(0.0, 0.0));
    b.mouse("mousePressed", grip);
    for (along, across) in [(1.0, 0.0), (3.5, 2.0), (-4.0, -1.0), (-12.25, 3.0)] {
        let hand = in_window(&mut b, place(along, across));
        b.mouse("mouseMoved", hand);
        let gone = travel(&mut b) / diagram.mu;
        assert!((gone - along).abs() < 0.02, "{gone} mm instead of {along}");
    }
    let there = travel(&mut b);
    let (scene_there, worked) = worked_at(&mut b, &scene, there);
    let (shown, drawn) = (shown(&mut b), drawn(&scene_there, &worked));
    for (id, want) in drawn {
        let worst = shown[&id].iter().zip(want).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-2, "{id} is off by {worst} mm");
    }
    assert_quiet(&b, "slider");
}

/// Moving to a frame must take a small part of the 16 ms between two pictures.
#[test]
fn a_frame_takes_little_time() {
    let Some(mut b) = browser() else { return };
    b.open(&page("speed", &template("stephenson-six-bar")), PROJECTOR);
    let script = "(() => { const t = performance.now(); for (let i = 0; i < 100; i++) \
                  dispatchEvent(new KeyboardEvent('keydown', { key: '+' })); return (performance.now() - t) / 100; })()";
    let ms = b.eval(script).as_f64().unwrap();
    eprintln!("a frame with its words takes {ms:.2} ms");
    assert!(ms < 12.0, "{ms} ms");
}
