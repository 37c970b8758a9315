//! Any name permitted by the format works everywhere: templates with other names for all points and
//! links, drawn and written in both languages. Nothing fails, no two items of a drawing have one
//! id, no number changes.

use crate::wide::every;
use std::collections::{HashMap, HashSet};

use hodograph::certified::certify;
use hodograph::diag::Severity;
use hodograph::figure::curves::{self, CurveDiagram};
use hodograph::figure::mechanism::Overlay;
use hodograph::figure::sheet::{SheetOptions, diagram, sheet};
use hodograph::figure::{path, steps::StepFigures};
use hodograph::lesson;
use hodograph::mechanism::Mechanism;
use hodograph::notation::Notation;
use hodograph::paper::item::Figure;
use hodograph::plan::text::PlanWriter;
use hodograph::render::{pdf, svg};
use hodograph::report::forces::ForceWriter;
use hodograph::report::{answers, construction, limits, plan, plan_json};
use hodograph::scene::{self, DiagramKind, Lang, PointId, Scene, Swept, templates};
use hodograph::sweep::{self, PlacedScene, Stations, Width, extreme};
use hodograph::worked::{Scope, Worked, work};
use hodograph::worksheet;
use serde_json::{Map, Value, json};

/// Beginnings of names of points: letters with another meaning (pole, special point, directions,
/// quantities), letters in both cases, long, Greek, Chinese.
const POINTS: &[&str] = &[
    "O",
    "P",
    "S",
    "o",
    "p",
    "s",
    "t",
    "x",
    "v",
    "A",
    "a",
    "B",
    "n",
    "k",
    "Kurbelzapfen",
    "Ω",
    "α",
    "Σ",
    "滑块",
    "铰链点",
    "É",
    "left",
    "mu",
    "of",
];
/// Endings of names.
const AFTER: &[&str] =
    &["", "", "1", "2", "21", "_", "_1", "__b", "'", "''", "1'", "'2", "_'", "甲", "x3"];
const LINKS: &[&str] = &[
    "1",
    "2",
    "3",
    "10",
    "21",
    "1a",
    "_",
    "_2",
    "'",
    "''",
    "3'",
    "4_'",
    "曲柄",
    "ω",
    "Pleuel",
    "A",
    "S",
    "t",
    "LangesGliedWort9",
];

struct Rng(u64);

impl Rng {
    fn below(&mut self, n: usize) -> usize {
        // Knuth's MMIX generator.
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) % n as u64) as usize
    }
}

/// Other names, all different.
fn names(
    old: impl Iterator<Item = String>,
    rng: &mut Rng,
    make: impl Fn(&mut Rng) -> String,
) -> HashMap<String, String> {
    let mut used = HashSet::new();
    old.map(|name| {
        let new = std::iter::repeat_with(|| make(rng))
            .find(|n| n.chars().count() <= 16 && used.insert(n.clone()))
            .unwrap();
        (name, new)
    })
    .collect()
}

struct Renamed {
    points: HashMap<String, String>,
    links: HashMap<String, String>,
}

impl Renamed {
    fn point(&self, name: &str) -> String {
        self.points.get(name).unwrap_or_else(|| panic!("{name} is a point")).clone()
    }

    fn link(&self, name: &str) -> String {
        self.links[name].clone()
    }

    /// `AB`, `O2,B`.
    fn pair(&self, text: &str) -> String {
        let halves = text.split_once([',', '-']).or_else(|| {
            text.char_indices()
                .map(|(i, _)| text.split_at(i))
                .find(|(a, b)| self.points.contains_key(*a) && self.points.contains_key(*b))
        });
        let (a, b) = halves.unwrap_or_else(|| panic!("{text} names two points"));
        format!("{},{}", self.points[a.trim()], self.points[b.trim()])
    }

    /// `E`, `B3`, `CB`, `B3B2`.
    fn on_links(&self, text: &str) -> String {
        let one = |t: &str| {
            if let Some(p) = self.points.get(t) {
                return Some(p.clone());
            }
            t.char_indices()
                .map(|(i, _)| t.split_at(i))
                .find_map(|(p, l)| Some(format!("{}{}", self.points.get(p)?, self.links.get(l)?)))
        };
        let two = || {
            text.char_indices()
                .skip(1)
                .map(|(i, _)| text.split_at(i))
                .find_map(|(a, b)| Some(format!("{},{}", one(a)?, one(b)?)))
        };
        one(text).or_else(two).unwrap_or_else(|| panic!("{text} names points"))
    }

    fn question(&self, text: &str) -> String {
        let Some((symbol, rest)) = text.split_once('_') else { return text.to_owned() };
        let link = |l: &str| self.link(l);
        let two_links = || {
            let pair = rest
                .char_indices()
                .map(|(i, _)| rest.split_at(i))
                .find_map(|(a, b)| Some((self.links.get(a)?, self.links.get(b)?)));
            pair.map(|(a, b)| format!("{symbol}_{a},{b}"))
        };
        match symbol {
            // The driver's, or the whole mechanism's.
            "M" | "F" if ["b", "b2", "sh"].contains(&rest) => text.to_owned(),
            "F" | "Fn" | "Ft" | "h" | "M" => {
                two_links().unwrap_or_else(|| format!("{symbol}_{}", self.on_links(rest)))
            }
            "FI" | "MI" => format!("{symbol}_{}", link(rest)),
            "omega" | "alpha" => {
                format!("{symbol}_{}", rest.split('/').map(link).collect::<Vec<_>>().join("/"))
            }
            "phi" => format!("{symbol}_{}", link(rest)),
            // Two links; for a ratio also the arm from which they are seen.
            "i" | "P" => {
                let (pair, arm) = rest
                    .split_once('/')
                    .map_or((rest, None), |(pair, arm)| (pair, Some(link(arm))));
                let halves = pair.char_indices().map(|(i, _)| pair.split_at(i));
                let (a, b) = halves
                    .clone()
                    .find(|(a, b)| self.links.contains_key(*a) && self.links.contains_key(*b))
                    .unwrap();
                format!(
                    "{symbol}_{},{}{}",
                    link(a),
                    link(b),
                    arm.map(|a| format!("/{a}")).unwrap_or_default()
                )
            }
            "l" => format!("{symbol}_{}", self.pair(rest)),
            _ => match rest.split_once('/') {
                Some((of, frame)) => {
                    format!("{symbol}_{}/{}", self.on_links(of), self.frame(frame))
                }
                None => format!("{symbol}_{}", self.on_links(rest)),
            },
        }
    }

    /// A link, or a point with which a frame translates.
    fn frame(&self, text: &str) -> String {
        self.links.get(text).cloned().unwrap_or_else(|| self.point(text))
    }

    /// A moving point with its frame, a motion, a wrong solution.
    fn seen(&self, object: &mut Map<String, Value>) {
        for (key, value) in object.iter_mut() {
            let Some(text) = value.as_str().map(str::to_owned) else { continue };
            *value = match key.as_str() {
                "on" | "link" => self.link(&text),
                "frame" => self.frame(&text),
                "line" => self.pair(&text),
                "centre" => self.point(&text),
                // The contact of a cam is not a point of the scene.
                "point" | "pair" => self.points.get(&text).cloned().unwrap_or(text),
                _ => text,
            }
            .into();
        }
        if let Some(printed) = object.get_mut("printed") {
            let old = std::mem::take(printed.as_object_mut().unwrap());
            *printed =
                Value::Object(old.into_iter().map(|(k, v)| (self.question(&k), v)).collect());
        }
    }

    /// A guide, a pair of gears, a wheel, a belt, a driver, a load or a spring.
    fn part(&self, object: &mut Map<String, Value>) {
        for (key, value) in object.iter_mut() {
            let Some(text) = value.as_str().map(str::to_owned) else {
                let list = |new: &dyn Fn(&str) -> String| {
                    value
                        .as_array()
                        .unwrap()
                        .iter()
                        .map(|v| json!(new(v.as_str().unwrap())))
                        .collect()
                };
                match key.as_str() {
                    "links" | "pulleys" | "sprockets" | "reversed" => {
                        *value = list(&|l| self.link(l))
                    }
                    "centres" | "at" if value.is_array() => *value = list(&|p| self.point(p)),
                    "at" => self.place(value),
                    "over" | "diagram" => self.part(value.as_object_mut().unwrap()),
                    _ => {}
                }
                continue;
            };
            *value = match key.as_str() {
                "pin" | "through" | "centre" | "track" | "at" | "from" | "to" => self.point(&text),
                // A load.
                "against" if text == "motion" => text,
                "slider" | "on" | "link" | "against" | "ring" | "rack" | "wheel" | "drum"
                | "load" => self.link(&text),
                "line" | "against_line" | "cylinder" => self.pair(&text),
                "slide" => self.points.get(&text).cloned().unwrap_or_else(|| self.link(&text)),
                _ => text,
            }
            .into();
        }
    }

    /// A place on a link.
    fn place(&self, place: &mut Value) {
        if let Some(base) = place.get_mut("base") {
            *base = self.pair(base.as_str().unwrap()).into();
        }
    }

    /// A cam: its parts name points of it, its follower's end points of the follower.
    fn cam(&self, value: &mut Value) {
        match value {
            Value::Array(list) => list.iter_mut().for_each(|v| self.cam(v)),
            Value::Object(object) => {
                for (key, value) in object.iter_mut() {
                    let Some(text) = value.as_str().map(str::to_owned) else {
                        self.cam(value);
                        continue;
                    };
                    *value = match key.as_str() {
                        // For a face, `cam` is a side.
                        "cam" | "follower" if !["left", "right"].contains(&text.as_str()) => {
                            self.link(&text)
                        }
                        "pin" | "through" | "centre" | "corner" | "edge" => self.point(&text),
                        "line" => self.pair(&text),
                        _ => text,
                    }
                    .into();
                }
            }
            _ => {}
        }
    }

    fn scene(&self, text: &str) -> String {
        let mut scene: Value = serde_json::from_str(text).unwrap();
        let keys = |value: &mut Value, new: &dyn Fn(&str) -> String| {
            let old = std::mem::take(value.as_object_mut().unwrap());
            *value = Value::Object(old.into_iter().map(|(k, v)| (new(&k), v)).collect());
        };
        for (section, value) in scene.as_object_mut().unwrap() {
            match section.as_str() {
                "links" => {
                    keys(value, &|l| self.link(l));
                    for points in value.as_object_mut().unwrap().values_mut() {
                        *points = points
                            .as_array()
                            .unwrap()
                            .iter()
                            .map(|p| json!(self.point(p.as_str().unwrap())))
                            .collect();
                    }
                }
                "ground" => *value = self.link(value.as_str().unwrap()).into(),
                "points" => {
                    keys(value, &|p| self.point(p));
                    value.as_object_mut().unwrap().values_mut().for_each(|place| self.place(place));
                }
                "sketch" => keys(value, &|p| self.point(p)),
                "lengths" => keys(value, &|ends| self.pair(ends)),
                "masses" => {
                    keys(value, &|l| self.link(l));
                    value
                        .as_object_mut()
                        .unwrap()
                        .values_mut()
                        .for_each(|m| self.part(m.as_object_mut().unwrap()));
                }
                "guides" | "gears" | "rolling" | "belts" | "chains" | "ropes" | "forces"
                | "springs" | "friction" => value
                    .as_array_mut()
                    .unwrap()
                    .iter_mut()
                    .for_each(|g| self.part(g.as_object_mut().unwrap())),
                "cams" => self.cam(value),
                "composite" | "motions" | "attempts" => value
                    .as_array_mut()
                    .unwrap()
                    .iter_mut()
                    .for_each(|c| self.seen(c.as_object_mut().unwrap())),
                "driver" => match value {
                    Value::Array(list) => {
                        list.iter_mut().for_each(|d| self.part(d.as_object_mut().unwrap()))
                    }
                    one => self.part(one.as_object_mut().unwrap()),
                },
                "side" => {
                    keys(value, &|p| self.point(p));
                    for side in value.as_object_mut().unwrap().values_mut() {
                        let (words, line) = side.as_str().unwrap().rsplit_once(' ').unwrap();
                        *side = format!("{words} {}", self.pair(line)).into();
                    }
                }
                "find" => {
                    *value = value
                        .as_array()
                        .unwrap()
                        .iter()
                        .map(|q| json!(self.question(q.as_str().unwrap())))
                        .collect()
                }
                _ => {}
            }
        }
        scene.to_string()
    }
}

/// A template under other names. Names that change the meaning of one of its questions (the point
/// of link 2 at O cannot be distinguished from a point O2) are replaced by others.
fn renamed(text: &str, rng: &mut Rng) -> (String, Scene) {
    let was = scene::read(text).unwrap().value;
    for _ in 0..200 {
        let point = |r: &mut Rng| {
            format!("{}{}", POINTS[r.below(POINTS.len())], AFTER[r.below(AFTER.len())])
        };
        let link = |r: &mut Rng| LINKS[r.below(LINKS.len())].to_owned();
        let new = Renamed {
            points: names(was.points.iter().map(|p| p.name.clone()), rng, point),
            links: names(was.links.iter().map(|l| l.name.clone()), rng, link),
        };
        let text = new.scene(text);
        match scene::read(&text) {
            Ok(now) if now.value.find.iter().zip(&was.find).all(|(a, b)| a.what == b.what) => {
                return (text, now.value);
            }
            Ok(_) => {}
            Err(faults) => {
                assert!(faults.list.iter().any(|d| d.code == "ambiguous"), "{faults}\n{text}")
            }
        }
    }
    panic!("no names serve");
}

/// All numbers of the answers, without names and words.
fn numbers(scene: &Scene, worked: &Worked) -> Value {
    fn bare(value: &mut Value) {
        match value {
            Value::Object(fields) => {
                fields.retain(|key, _| {
                    !matches!(
                        key.as_str(),
                        "find"
                            | "measured_between"
                            | "title"
                            | "notes"
                            | "words"
                            | "links"
                            | "message"
                            | "help"
                    )
                });
                fields.values_mut().for_each(bare);
            }
            Value::Array(list) => list.iter_mut().for_each(bare),
            _ => {}
        }
    }
    let mut json = answers::json(scene, worked, &certify(scene, worked, 6), 6, &[]);
    bare(&mut json);
    json
}

/// Equal except for the rounding of sums, which follows the order of names in the file.
fn alike(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => {
            let [a, b] = [a, b].map(|n| n.as_f64().unwrap());
            (a - b).abs() <= 1e-12 * a.abs().max(1.0)
        }
        (Value::Array(a), Value::Array(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| alike(a, b))
        }
        (Value::Object(a), Value::Object(b)) => {
            a.len() == b.len() && a.iter().all(|(k, v)| b.get(k).is_some_and(|w| alike(v, w)))
        }
        _ => a == b,
    }
}

/// An SVG is written without a remark, and no two of its elements have one id.
fn drawn(what: &str, figure: &Figure, failures: &mut Vec<String>) {
    match svg::write(figure) {
        Err(faults) => failures.push(format!("{what}: {faults}")),
        Ok(svg) => {
            failures.extend(svg.notes.iter().map(|n| format!("{what}: {n}")));
            let mut seen = HashSet::new();
            let ids = svg.value.split(" id=\"").skip(1).filter_map(|rest| rest.split('"').next());
            failures.extend(
                ids.filter(|id| !seen.insert(*id))
                    .map(|id| format!("{what}: two elements have the id {id}")),
            );
        }
    }
}

fn everything(text: &str, scene: &Scene, worked: &Worked, failures: &mut Vec<String>) {
    let stem = "sheet";
    for lang in [Lang::En, Lang::Zh] {
        let notation = Notation::of_language(lang);
        let options = SheetOptions::of_language(lang);
        let w = PlanWriter { scene, plan: &worked.plan, notation: &notation, lang };
        let told = hodograph::certified::steps(scene, worked, None);
        let forces = worked.equilibrium.as_ref().map(|of| ForceWriter {
            scene,
            notation: &notation,
            lang,
            of,
        });
        plan::text(scene, &worked.mechanism, &w, forces.as_ref());
        plan_json::json(&worked.mechanism, &worked.demand, &w, None, &[]);
        construction::text(&w, &worked.construction, &told);
        answers::text(scene, worked, &certify(scene, worked, 6), 6, lang);
        match sheet(scene, worked, &options) {
            Ok(figure) => drawn("sheet", &figure, failures),
            Err(faults) => failures.push(format!("sheet: {faults}")),
        }
        let moving = (0..scene.points.len())
            .map(PointId)
            .find(|p| scene.mover(*p).is_some() && !scene.links[scene.ground.0].points.contains(p));
        let overlay = Overlay {
            vectors: Some(DiagramKind::Velocity),
            dimensions: true,
            ..Overlay::default()
        };
        let overlay = overlay.with_motion(scene, worked, 3, moving.as_slice());
        drawn("overlay", &diagram(scene, worked, &options, &overlay), failures);
        if let Some(figure) = StepFigures::of(scene, worked, &options, None).figures().last() {
            drawn("step", &figure, failures);
        }
        if let Some(point) = moving {
            let wanted = path::PathContent {
                points: vec![point],
                swept: Swept::Driver(0),
                marks: 4,
                poses: 0,
            };
            match path::figure(scene, worked, &options, &wanted) {
                Ok(figure) => drawn("path", &figure.value, failures),
                Err(faults) => failures.push(format!("path: {faults}")),
            }
        }
        let document =
            worksheet::worksheet(scene, worked, &worksheet::WorksheetOptions::of_language(lang));
        let mut written = |what: &str, result: Result<(), hodograph::diag::Faults>| {
            failures.extend(result.err().map(|faults| format!("worksheet as {what}: {faults}")));
        };
        written("HTML", worksheet::html::html(&document).map(drop));
        written("Markdown", worksheet::markdown::markdown(&document, stem).map(drop));
        written("Typst", worksheet::typst::typst(&document, stem).map(drop));
        match pdf::document(&worksheet::pages::pages(&document), &document.title, "en") {
            Ok(file) => {
                failures.extend(file.notes.iter().map(|n| format!("worksheet's pages: {n}")))
            }
            Err(faults) => failures.push(format!("worksheet's pages: {faults}")),
        }
    }
    // A lesson holds both languages.
    let options =
        lesson::LessonOptions { positions: 8, ..lesson::LessonOptions::of_language(Lang::En) };
    match lesson::lesson(scene, &options) {
        Ok(page) => failures.extend(
            page.notes
                .iter()
                .filter(|n| n.severity > Severity::Note)
                .map(|n| format!("lesson: {n}")),
        ),
        Err(faults) => failures.push(format!("lesson: {faults}")),
    }
    if let Err(faults) = lesson::reveal(scene, worked, &SheetOptions::of_language(Lang::En)) {
        failures.push(format!("reveal: {faults}"));
    }
    let mechanism = Mechanism::new(scene).unwrap().value;
    let placed = PlacedScene::new(scene, &mechanism).unwrap();
    let now = sweep::station::position_now(scene, &placed.at, 0);
    let stations = Stations::of_values((0..5).map(|k| now + 1e-3 * f64::from(k)).collect(), 1.0);
    let table = sweep::run(&placed, 0, &stations, Width::Widest).unwrap();
    let curves = curves::figure(
        scene,
        &CurveDiagram::of(&placed, 0, &table, &Notation::of_language(Lang::En)),
        &Default::default(),
        Lang::Zh,
    );
    drawn("curves", &curves, failures);
    if let Ok(found) = extreme::limits(scene, &mechanism, 0) {
        limits::text(scene, 0, &found, Lang::Zh);
    }
    assert!(scene::read(text).is_ok());
}

#[test]
fn any_name_works_everywhere() {
    // The gate draws each template once more; more seeds find more: HODOGRAPH_SEEDS=20.
    let seeds: u64 =
        std::env::var("HODOGRAPH_SEEDS").ok().and_then(|s| s.parse().ok()).unwrap_or(1);
    let mut all = Vec::new();
    for t in templates::list().iter().step_by(every(8)) {
        let text = templates::get(t.name).unwrap();
        let was = scene::read(text).unwrap().value;
        let expected = numbers(&was, &work(&was, Scope::Figure).unwrap().value);
        for seed in 0..seeds {
            let mut rng = Rng(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15)
                ^ t.name.bytes().map(u64::from).sum::<u64>());
            rng.below(2);
            let (text, scene) = renamed(text, &mut rng);
            let worked = work(&scene, Scope::Figure)
                .unwrap_or_else(|f| panic!("{} {seed}: {f}\n{text}", t.name))
                .value;
            let mut failures = Vec::new();
            if !alike(&numbers(&scene, &worked), &expected) {
                failures.push("its numbers are others".to_owned());
            }
            everything(&text, &scene, &worked, &mut failures);
            failures.dedup();
            all.extend(failures.into_iter().map(|f| format!("{} {seed}: {f}", t.name)));
        }
    }
    assert!(all.is_empty(), "{} failures:\n{}", all.len(), all.join("\n"));
}

/// Pivots of a triad's legs may have names that begin like those of poles and special points.
#[test]
fn pivots_of_a_triad_may_be_called_as_poles_are() {
    let text = templates::get("class-iii-six-bar").unwrap();
    let swap = |text: &str, from: &str, to: &str| {
        text.replace(&format!("\"{from}\""), &format!("\"{to}\""))
    };
    let text = swap(&swap(text, "M", "O2"), "N", "P2")
        .replace("\"MQ\"", "\"O2,Q\"")
        .replace("\"NR\"", "\"P2,R\"");
    let scene = scene::read(&text).unwrap_or_else(|f| panic!("{f}")).value;
    let worked = work(&scene, Scope::Figure).unwrap().value;
    let mut failures = Vec::new();
    everything(&text, &scene, &worked, &mut failures);
    assert!(failures.is_empty(), "{failures:#?}");
}
