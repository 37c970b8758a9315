//! The page: template, style and script of this folder, filled with the lesson's markup and data.
//!
//! This module arranges the parts. The page is one file and fetches nothing.

use crate::budget::here;
use hodograph_base::lang::say;
use serde_json::{Value, json};

use crate::construct::pencil_mm;
use crate::diag::Faults;
use crate::geom::Point;
use crate::mechanism::Mechanism;
use crate::paper::label::Label;
use crate::paper::words as figure_words;
use crate::plan::names::name_label;
use crate::position::toggle::Toggle;
use crate::render::escaped;
use crate::render::math::mathml;
use crate::render::svg::Elements;
use crate::report::amount::scale_formula;
use crate::report::statement::paragraphs;
use crate::scene::{DiagramKind, DriverKind, Lang, LinkId, PointId, Scene};
use crate::scene::{Swept, driver_position};

use super::bank::{self, Formulas};
use super::equations::equations;
use super::frames::{Frames, SolvedFrame};
use super::marks::marks;
use super::scenery::{Scenery, Shows, WindowLayout, scenery, stray};
use super::steps::{LANGS, answers, steps};
use super::track::{TrackOutput, UNIT, runs};
use super::words::{table, word};
use super::{LessonOptions, pack};
use crate::sweep::follow::PoseSweep;
use crate::webfont;

/// Distance (mm of the diagram) from the pivot at which a link is gripped that has no other point,
/// slot or rim.
const ARM_MM: f64 = 20.0;
/// The buttons of a drawing.
const ZOOMS: &str = "<div class=\"zooms\"><button type=\"button\" class=\"whole\" data-title=\"whole\">⤢</button>\
    <button type=\"button\" class=\"farther\" data-title=\"farther\">−</button><button type=\"button\" class=\"nearer\" data-title=\"nearer\">+</button></div>\n";
/// The common style of all lessons; each page adds its own.
pub const BASE: &str = include_str!("base.css");
const PAGE: &str = concat!(include_str!("head.html"), include_str!("page/page.html"));
const STYLE: [&str; 2] = [BASE, include_str!("page/page.css")];
/// The start of the script.
const BOOT: &str = include_str!("page/boot.js");
/// The script, in the order of its modules.
const SCRIPT: [&str; 8] = [
    include_str!("page/read.js"),
    include_str!("page/draw.js"),
    include_str!("page/told.js"),
    include_str!("page/move.js"),
    include_str!("page/over.js"),
    include_str!("page/predict.js"),
    include_str!("sheets.js"),
    include_str!("page/page.js"),
];

/// Writes the page.
///
/// # Errors
/// The errors of the SVG writer.
pub fn page(
    scene: &Scene,
    options: &LessonOptions,
    (mechanism, sweep): (&Mechanism, &PoseSweep),
    frames: &Frames,
) -> Result<String, Faults> {
    let notation = &options.notation;
    let written = || {
        let mut formulas = Formulas::default();
        let steps = steps(frames, notation, &mut formulas);
        let answers = answers(frames, options.swept, notation, &mut formulas);
        let equations = equations(frames, notation, &mut formulas);
        let marks = marks(frames, notation, &mut formulas);
        (steps, answers, equations, marks, formulas)
    };
    let here = here();
    let (drawings, (steps, answers, equations, marks, mut formulas)) = rayon::join(
        || here.enter(|| scenery(frames, notation, &options.style)),
        || here.enter(written),
    );
    let drawings = drawings?;
    let told: Vec<Vec<TrackOutput>> = drawings
        .iter()
        .map(|d| d.layouts.iter().enumerate().map(|(k, l)| l.track.output(k == 0)).collect())
        .collect();
    let mut figures =
        drawings.iter().zip(&told).map(|(d, told)| figure(d, told, frames, options.lang));
    let first = figures.next().unwrap_or_default();
    let polygons: String = figures.collect();
    let title = |lang: Lang| match lang.of(&scene.title) {
        "" => DiagramKind::Plane.caption(lang).to_owned(),
        title => title.to_owned(),
    };
    let told_drawings: Vec<Value> =
        drawings.iter().zip(&told).map(|(d, t)| drawing(d, t, frames.groups.len() > 1)).collect();
    let book = &frames.list[frames.base].scene.book;
    let scales: Vec<usize> =
        drawings.iter().map(|d| formulas.formula(&scale_formula(book, d.shows.on, d.mu))).collect();
    let mut data = json!({
        "digits": pack::alphabet(),
        "unit": UNIT,
        "lang": tag(options.lang),
        "words": {"en": table(Lang::En), "zh": table(Lang::Zh)},
        "title": LANGS.map(title),
        "statement": LANGS.map(|lang| statement(scene, lang, &mut formulas)),
        "driver": moved(scene, options.swept),
        "travel": frames.list.iter().map(|f| ten_digits(f.travel)).collect::<Vec<_>>(),
        "base": frames.base,
        "full": frames.full,
        "limits": limits(scene, mechanism, sweep),
        "cut": frames.cut,
        "handle": handle(frames, options.swept.lead(scene)),
        "scales": scales,
        "pencil": pencil_mm(&scene.paper),
        "marks": marks,
        "drawings": told_drawings,
        "steps": steps,
        "answers": answers,
        "equations": equations,
        "rows": LANGS.map(|l| [figure_words::words(l).magnitude, figure_words::words(l).direction]),
        "formulas": formulas.list,
        "tags": bank::tags(),
    });
    // Words for a motion that takes more than one turn.
    if frames.full && sweep.turns != 1 {
        data["turns"] = json!(sweep.turns);
    }
    let data = pack::pressed(&data.to_string());
    Ok(filled(
        PAGE,
        &[
            ("lang", tag(options.lang)),
            ("title", &escaped(&title(options.lang))),
            ("style", &with_fonts(&STYLE)),
            (
                "letters",
                &Elements::letters(
                    drawings.iter().flat_map(|d| &d.layouts).map(|l| &l.track.elements_of),
                ),
            ),
            ("mechanism", &first),
            ("polygons", &polygons),
            ("noscript", &escaped(word("noscript", options.lang))),
            ("data", &data),
            ("program", &pack::pressed(&terse(&SCRIPT.concat()))),
            ("boot", &terse(BOOT)),
        ],
    ))
}

/// Fills a template: values replace their names, `{{name}}`. Values are not examined: a title may
/// hold braces.
pub(super) fn filled(template: &str, values: &[(&str, &str)]) -> String {
    let mut out = String::new();
    for (k, part) in template.split("{{").enumerate() {
        let value = part
            .split_once("}}")
            .and_then(|(name, rest)| Some((values.iter().find(|v| v.0 == name)?.1, rest)));
        match value {
            Some((value, rest)) => {
                out += value;
                out += rest;
            }
            None if k == 0 => out += part,
            None => {
                out += "{{";
                out += part;
            }
        }
    }
    out
}

/// Style or script without indents, empty lines and comment lines.
pub(super) fn terse(text: &str) -> String {
    let lines = text.lines().map(str::trim_start).filter(|l| !l.is_empty() && !l.starts_with("//"));
    let lines = lines.filter(|l| !(l.starts_with("/*") && l.ends_with("*/")));
    lines.collect::<Vec<_>>().join("\n")
}

/// The style of a page from its sheets, with the fonts.
pub(super) fn with_fonts(sheets: &[&str]) -> String {
    sheets.iter().map(|s| terse(s) + "\n").collect::<String>() + webfont::faces()
}

/// A number to ten significant digits, more than any screen shows.
fn ten_digits(value: f64) -> f64 {
    format!("{value:.9e}").parse().unwrap_or(value)
}

fn tag(lang: Lang) -> &'static str {
    figure_words::words(lang).tag
}

/// Data of a drawing for the page. Each window has its magnification, the place of the origin (y
/// down), the frames in which it holds the drawing, the moving elements, and the force polygon with
/// which it is seen, if any; the second window also has the elements.
fn drawing(d: &Scenery, told: &[TrackOutput], many: bool) -> Value {
    let layout = |(l, told): (&WindowLayout, &TrackOutput)| {
        let origin = [l.origin.x, d.size_mm[1] - l.origin.y].map(ten_digits);
        // In hundredths; rounding and the round corners of arrowheads alone do not enlarge the
        // window.
        let back = bank::runs(
            &l.back
                .iter()
                .map(|b| if *b < 1.03 { 100 } else { (b * 100.0).ceil() as i64 })
                .collect::<Vec<_>>(),
        );
        let mut value = json!({"mu": l.mu, "times": ten_digits(d.mu / l.mu), "origin": origin, "held": runs(l.held.iter().copied()), "back": back, "moving": told.moving});
        if let Some(group) = l.group {
            value["with"] = json!(Shows { on: DiagramKind::Force, part: Some(group) }.key());
        }
        value
    };
    let mut layouts: Vec<Value> = d.layouts.iter().zip(told).map(layout).collect();
    for (layout, told) in layouts.iter_mut().zip(told).skip(1) {
        // An identifier occurs once in a document: the window of all poses keeps those of its
        // elements in `data-id`.
        layout["markup"] = json!(told.markup.replace(" id=\"", " data-id=\""));
    }
    // A single group has no number.
    let part = d.shows.part.filter(|_| d.shows.on != DiagramKind::Force || many);
    json!({"key": d.shows.key(), "level": d.shows.level(), "part": part, "shown": runs(d.shown.iter().copied()), "layouts": layouts})
}

/// A drawing with its caption, in its initial view.
fn figure(d: &Scenery, told: &[TrackOutput], frames: &Frames, lang: Lang) -> String {
    let [w, h] = d.size_mm.map(crate::render::number::mm);
    let book = &frames.list[frames.base].scene.book;
    let caption = |l: Lang| match (d.shows.on.caption(l), d.shows.part, l) {
        (name, Some(group), _) if d.shows.on == DiagramKind::Force => {
            of_links(name, &frames.groups[group], frames, l)
        }
        (name, None, _) => name.to_owned(),
        (name, Some(part), Lang::En) => format!("{name} ({})", part + 1),
        (name, Some(part), Lang::Zh) => format!("{name}（{}）", part + 1),
    };
    let key = d.shows.key();
    let both = LANGS.map(|l| format!(" data-{}=\"{}\"", tag(l), escaped(&caption(l)))).concat();
    let ink =
        told.first().map_or_else(String::new, |t| format!("<g class=\"ink\">\n{}</g>\n", t.markup));
    format!(
        "<figure id=\"{key}\" class=\"drawing\">\n<svg viewBox=\"0 0 {w} {h}\" style=\"--w:{w};--h:{h}\" role=\"img\" aria-labelledby=\"{key}-caption\">\n\
         {ink}</svg>\n<p class=\"off\" hidden></p>\n{ZOOMS}<figcaption><span id=\"{key}-caption\"{both}>{}</span> <span class=\"scale\">{}</span></figcaption>\n</figure>\n",
        escaped(&caption(lang)),
        mathml(&Label::math(scale_formula(book, d.shows.on, d.mu))),
    )
}

/// The caption of the force polygon of some links.
fn of_links(name: &str, links: &[LinkId], frames: &Frames, lang: Lang) -> String {
    let scene = &frames.list[frames.base].scene;
    let names: Vec<&str> = links.iter().map(|l| scene.link_name(*l)).collect();
    let names = names.join(lang.comma());
    match links.len() {
        1 => say!(lang, "{name}, link {names}"),
        _ => say!(lang, "{name}, links {names}"),
    }
}

/// The problem statement for the page: HTML, formulas by their indices, one line for each
/// paragraph.
fn statement(scene: &Scene, lang: Lang, formulas: &mut Formulas) -> String {
    let stated: Vec<String> = paragraphs(scene, lang).iter().map(|p| formulas.phrase(p)).collect();
    if stated.is_empty() { escaped(word("diagram", lang)) } else { stated.join("<br>") }
}

/// Data of the moved driver or time for the page.
pub(super) fn moved(scene: &Scene, swept: Swept) -> Value {
    match swept {
        Swept::Driver(k) => driver(scene, k),
        Swept::Time => {
            json!({"turns": false, "time": true, "symbol": mathml(&Label::math("t")), "plain": "t", "start": scene.instant(),
            "factor": 1.0, "back": false, "unit": " s", "parts": 1000.0})
        }
    }
}

/// Data of a driver: whether it turns, its symbol, its position in the scene's own pose (degrees or
/// millimetres; null where the scene does not state it), and its unit.
fn driver(scene: &Scene, k: usize) -> Value {
    let driver = &scene.drivers[k];
    let (turns, symbol) = match &driver.kind {
        DriverKind::Turn { link, against, .. } if *against == scene.ground => {
            (true, format!("\\varphi_{{{}}}", name_label(scene.link_name(*link))))
        }
        DriverKind::Turn { link, against, .. } => (
            true,
            format!(
                "\\varphi_{{{}/{}}}",
                name_label(scene.link_name(*link)),
                name_label(scene.link_name(*against))
            ),
        ),
        DriverKind::Slide { guide, .. } => {
            let g = &scene.guides[guide.0];
            let name = g
                .pin
                .map(|p| scene.point_name(p))
                .or(g.slider.map(|s| scene.link_name(s)))
                .unwrap_or_default();
            (false, format!("s_{{{}}}", name_label(name)))
        }
        DriverKind::Cylinder { a, b, .. } => (
            false,
            format!(
                "l_{{{}{}}}",
                name_label(scene.point_name(*a)),
                name_label(scene.point_name(*b))
            ),
        ),
    };
    let (book, what) = (&scene.book, scene.driver_name(k).1);
    let factor = match (book.chosen(what), turns) {
        (Some(unit), _) => unit.of(1.0),
        (None, true) => 180.0 / std::f64::consts::PI,
        (None, false) => 1e3,
    };
    let start = match driver.kind.angle().filter(|_| book.chosen(what).is_none()) {
        Some(angle) => Some(angle.value.degrees()),
        None => driver_position(scene, k).map(|s| s * factor),
    };
    let symbol = if start.is_some() { symbol } else { format!("\\Delta {symbol}") };
    let back = driver.rate.value < 0.0;
    let mut told = json!({"turns": turns, "symbol": mathml(&Label::math(&symbol)), "plain": crate::paper::phrase::formula(&symbol), "start": start, "factor": factor, "back": back});
    // A unit chosen by the scene, and the resolution in which the page gives the position.
    if book.chosen(what).is_some() {
        told["unit"] = json!(book.text(what, ""));
        told["turn"] = json!(std::f64::consts::TAU * factor);
        told["parts"] = json!(book.parts(what, 10.0));
    }
    told
}

/// Texts for each end of the travel, English and Chinese; null where nothing stops the driver.
fn limits(scene: &Scene, mechanism: &Mechanism, sweep: &PoseSweep) -> Value {
    let ends = [sweep.poses.first(), sweep.poses.last()];
    let said = ends.into_iter().zip(sweep.limits).map(|(pose, limit)| {
        let (Some(pose), Some(_)) = (pose, limit) else { return Value::Null };
        let key = if sweep.far(pose) { "limit_far" } else { "limit" };
        let toggle = Toggle::at(mechanism, &pose.configuration).filter(|_| !sweep.far(pose));
        let told =
            |t: &Toggle, lang| word("limit_toggle", lang).replace("{}", &t.words(scene, lang));
        json!(LANGS.map(|lang| {
            toggle.as_ref().map_or_else(|| word(key, lang).to_owned(), |t| told(t, lang))
        }))
    });
    said.collect()
}

/// The point by which the driver is dragged, over the frames: two packed columns ([`UNIT`]) in mm
/// of the mechanism's paper, from its origin, y up.
fn handle(frames: &Frames, driver: usize) -> Value {
    let arm = arm(frames, driver);
    let places: Vec<Point> = frames
        .list
        .iter()
        .map(|f| grip(f, driver, arm).unwrap_or(Point::ORIGIN) + stray(frames, f))
        .collect();
    let mut packed = String::new();
    let whole = |v: f64| (v * UNIT).round() as i64;
    pack::column(&places.iter().map(|p| whole(p.x)).collect::<Vec<_>>(), &mut packed);
    pack::column(&places.iter().map(|p| whole(p.y)).collect::<Vec<_>>(), &mut packed);
    json!(packed)
}

/// Distance (m) from its pivot at which a link without another point is gripped: the farthest place
/// of a pin in its slot or of its rolling contact, else far enough to be turned.
fn arm(frames: &Frames, driver: usize) -> f64 {
    let Some((link, _)) = frames.list[frames.base].scene.drivers[driver].kind.turned() else {
        return 0.0;
    };
    let reaches = frames.list.iter().flat_map(|f| {
        let (scene, at) = (&f.scene, &f.worked.configuration.points);
        let centre = scene.links[link.0].points.first().and_then(|p| at[p.0]);
        let pins = scene
            .guides
            .iter()
            .filter(|g| g.on == link && g.rolling.is_none())
            .filter_map(|g| g.pin);
        let contacts =
            scene.rolling.iter().filter(|r| r.links.contains(&link)).map(|r| r.at_of(link));
        let far = |p: PointId| Some(at[p.0]?.distance(centre?));
        pins.chain(contacts).filter_map(far).collect::<Vec<f64>>()
    });
    let farthest = reaches.fold(0.0, f64::max);
    let least = ARM_MM * frames.list[frames.base].worked.construction.diagram.mu;
    if farthest > 0.0 { farthest } else { least }
}

/// The driver's grip on the diagram (mm from its origin): the farthest point of a turning link, or
/// a place of the link at the distance `arm` from its pivot; the slider; the rod's joint.
fn grip(frame: &SolvedFrame, driver: usize, arm: f64) -> Option<Point> {
    let (scene, at) = (&frame.scene, &frame.worked.configuration);
    let diagram = &frame.worked.construction.diagram;
    let place = match &scene.drivers[driver].kind {
        DriverKind::Turn { link, against, line, .. } => {
            let shared = |p: &&PointId| scene.links[against.0].points.contains(p);
            let points = &scene.links[link.0].points;
            let centre = points.iter().find(shared).and_then(|p| at.points[p.0]);
            let of_line = line.and_then(|(a, b)| Some((at.points[a.0]?, at.points[b.0]?)));
            match (of_line, centre) {
                (Some((a, b)), Some(c)) => Some(if a.distance(c) > b.distance(c) { a } else { b }),
                (Some((_, b)), None) => Some(b),
                (None, Some(c)) if points.len() == 1 => {
                    Some(at.poses[link.0].map_or(c, |pose| c + pose.axis * arm))
                }
                (None, Some(c)) => points
                    .iter()
                    .filter_map(|p| at.points[p.0])
                    .max_by(|a, b| a.distance(c).total_cmp(&b.distance(c))),
                (None, None) => points.iter().find_map(|p| at.points[p.0]),
            }
        }
        DriverKind::Slide { guide, .. } => {
            let g = &scene.guides[guide.0];
            g.pin.and_then(|p| at.points[p.0]).or_else(|| at.poses[g.slider?.0].map(|p| p.origin))
        }
        DriverKind::Cylinder { b, .. } => at.points[b.0],
    }?;
    Some(((place - diagram.origin) * (1.0 / diagram.mu)).to_point())
}
