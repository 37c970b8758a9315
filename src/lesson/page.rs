//! The page: template, style and script of this folder with the lesson's markup and data in them.
//!
//! Decided here: what stands where. Nothing is fetched: all is in the one file.

use serde_json::{Value, json};

use crate::diag::Faults;
use crate::figure::label::Label;
use crate::figure::sheet;
use crate::figure::words as figure_words;
use crate::geom::Point;
use crate::mechanism::Level;
use crate::plan::names::name_label;
use crate::position::toggle::Toggle;
use crate::render::escaped;
use crate::render::svg::Elements;
use crate::report::math::mathml;
use crate::report::statement::paragraphs;
use crate::scene::driver_position;
use crate::scene::{Book, DriverKind, Lang, Scene};

use super::bank::{self, Formulas};
use super::equations::equations;
use super::frames::{Frame, Frames};
use super::scenery::{Scenery, Shows, scenery, stray};
use super::steps::{LANGS, answers, steps};
use super::track::{Told, UNIT, runs};
use super::words::{table, word};
use super::{Options, pack};
use crate::sweep::follow::Sweep;

const PAGE: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

/// Writes the page.
///
/// # Errors
/// Those of the SVG writer.
pub fn page(scene: &Scene, options: &Options, sweep: &Sweep, frames: &Frames) -> Result<String, Faults> {
    let notation = &options.notation;
    let written = || {
        let mut formulas = Formulas::default();
        let steps = steps(frames, notation, &mut formulas);
        let answers = answers(frames, options.driver, notation, &mut formulas);
        let equations = equations(frames, notation, &mut formulas);
        (steps, answers, equations, formulas)
    };
    let (drawings, (steps, answers, equations, mut formulas)) = rayon::join(|| scenery(frames, notation, &options.style), written);
    let drawings = drawings?;
    let told: Vec<Told> = drawings.iter().map(|d| d.track.told()).collect();
    let mut figures = drawings.iter().zip(&told).map(|(d, told)| figure(d, told, frames, options.lang));
    let mechanism = figures.next().unwrap_or_default();
    let polygons: String = figures.collect();
    let title = |lang: Lang| match scene.title.get(lang) {
        "" => figure_words::words(lang).diagram.to_owned(),
        title => title.to_owned(),
    };
    let told_drawings: Vec<Value> = drawings.iter().zip(&told).map(|(d, t)| drawing(d, t, frames, &mut formulas)).collect();
    let mut data = json!({
        "digits": pack::alphabet(),
        "unit": UNIT,
        "lang": tag(options.lang),
        "words": {"en": table(Lang::En), "zh": table(Lang::Zh)},
        "title": LANGS.map(title),
        "statement": LANGS.map(|lang| statement(scene, lang, &mut formulas)),
        "driver": driver(scene, options.driver),
        "travel": frames.list.iter().map(|f| ten_digits(f.travel)).collect::<Vec<_>>(),
        "base": frames.base,
        "full": frames.full,
        "limits": limits(scene, sweep, frames),
        "cut": frames.cut,
        "handle": handle(frames, options.driver, &drawings[0]),
        "drawings": told_drawings,
        "steps": steps,
        "answers": answers,
        "equations": equations,
        "rows": LANGS.map(|l| [figure_words::words(l).magnitude, figure_words::words(l).direction]),
        "formulas": formulas.list,
        "tags": bank::tags(),
    });
    // Those of a motion that takes more than one.
    if frames.full && sweep.turns != 1 {
        data["turns"] = json!(sweep.turns);
    }
    // Inside a script element `</` could end it, and after `<!--` nothing might.
    let data = data.to_string().replace("</", "<\\/").replace("<!", "\\u003c!");
    Ok(filled(
        PAGE,
        &[
            ("lang", tag(options.lang)),
            ("title", &escaped(&title(options.lang))),
            ("style", &terse(STYLE)),
            ("letters", &Elements::letters(drawings.iter().map(|d| &d.track.elements_of))),
            ("mechanism", &mechanism),
            ("polygons", &polygons),
            ("noscript", &escaped(word("noscript", options.lang))),
            ("data", &data),
            ("script", &terse(SCRIPT)),
        ],
    ))
}

/// A template with values in the places of their names, `{{name}}`. What a value says is not looked at: a title may hold braces.
pub(super) fn filled(template: &str, values: &[(&str, &str)]) -> String {
    let mut out = String::new();
    for (k, part) in template.split("{{").enumerate() {
        let value = part.split_once("}}").and_then(|(name, rest)| Some((values.iter().find(|v| v.0 == name)?.1, rest)));
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

/// Style or script without indents, empty lines and lines that are nothing but a comment.
pub(super) fn terse(text: &str) -> String {
    let lines = text.lines().map(str::trim_start).filter(|l| !l.is_empty() && !l.starts_with("//"));
    let lines = lines.filter(|l| !(l.starts_with("/*") && l.ends_with("*/")));
    lines.collect::<Vec<_>>().join("\n")
}

/// A number in ten significant digits: more than any screen shows.
fn ten_digits(value: f64) -> f64 {
    format!("{value:.9e}").parse().unwrap_or(value)
}

fn tag(lang: Lang) -> &'static str {
    figure_words::words(lang).tag
}

/// What the page is told of a drawing. `scales`, where there are several: for each its μ and the index of the formula that says
/// it, and which one each frame has.
fn drawing(d: &Scenery, told: &Told, frames: &Frames, formulas: &mut Formulas) -> Value {
    let (list, book) = (scales(d.shows, frames), &frames.list[frames.base].scene.book);
    let scales = if list.len() > 1 {
        let said: Vec<Value> = list.iter().map(|mu| json!([mu, formulas.formula(&scale_formula(book, d.shows, *mu))])).collect();
        let level = usize::from(d.shows == Shows::Polygon(Level::Acceleration));
        let which: Vec<i64> = frames.list.iter().map(|f| f.scale[level] as i64).collect();
        json!([said, bank::runs(&which)])
    } else {
        json!(0)
    };
    json!({"key": d.shows.key(), "moving": told.moving, "shown": runs(d.shown.iter().copied()), "scales": scales})
}

/// The scales of a drawing, the usual one first.
fn scales(shows: Shows, frames: &Frames) -> &[f64] {
    match shows {
        Shows::Mechanism => std::slice::from_ref(&frames.list[frames.base].worked.construction.diagram.mu_l),
        Shows::Polygon(level) => &frames.mu[usize::from(level == Level::Acceleration)],
    }
}

/// A scale as the label language says it.
fn scale_formula(book: &Book, shows: Shows, mu: f64) -> String {
    let level = match shows {
        Shows::Mechanism => Level::Position,
        Shows::Polygon(level) => level,
    };
    sheet::of_level(book, level, mu)
}

/// A drawing with its caption; its scale is said below.
fn figure(d: &Scenery, told: &Told, frames: &Frames, lang: Lang) -> String {
    let [w, h] = d.size_mm.map(crate::render::number::mm);
    let (x, y) = (crate::render::number::mm(d.origin.x), crate::render::number::mm(d.size_mm[1] - d.origin.y));
    let (list, book) = (scales(d.shows, frames), &frames.list[frames.base].scene.book);
    let mu = list.first().copied().unwrap_or(0.0);
    let caption: fn(Lang) -> &'static str = match d.shows {
        Shows::Mechanism => |l| figure_words::words(l).diagram,
        Shows::Polygon(Level::Acceleration) => |l| figure_words::words(l).acceleration_polygon,
        Shows::Polygon(_) => |l| figure_words::words(l).velocity_polygon,
    };
    // Kept free where it is not said, so that nothing moves when it is.
    let smaller = if list.len() > 1 {
        format!(" <span class=\"smaller\" data-text=\"smaller\">{}</span>", word("smaller", lang))
    } else {
        String::new()
    };
    let key = d.shows.key();
    let both = LANGS.map(|l| format!(" data-{}=\"{}\"", tag(l), escaped(caption(l)))).concat();
    format!(
        "<figure id=\"{key}\" class=\"drawing\">\n<svg viewBox=\"0 0 {w} {h}\" style=\"--w:{w};--h:{h}\" data-origin=\"{x} {y}\" data-mu=\"{mu}\" role=\"img\" aria-labelledby=\"{key}-caption\">\n\
         <g class=\"ink\">\n{}</g>\n</svg>\n<p class=\"off\" hidden></p>\n<figcaption><span id=\"{key}-caption\"{both}>{}</span> <span class=\"scale\">{}</span>{smaller}</figcaption>\n</figure>\n",
        told.markup,
        escaped(caption(lang)),
        mathml(&Label::math(scale_formula(book, d.shows, mu))),
    )
}

/// The statement for the page: HTML, its formulas told by their indices, a line for each paragraph.
fn statement(scene: &Scene, lang: Lang, formulas: &mut Formulas) -> String {
    let stated: Vec<String> = paragraphs(scene, lang).iter().map(|p| formulas.phrase(p)).collect();
    if stated.is_empty() { escaped(word("diagram", lang)) } else { stated.join("<br>") }
}

/// What is moved: whether it turns, its symbol, where it stands in the scene's own pose (degrees or millimetres; null where no
/// one says), and its unit.
fn driver(scene: &Scene, k: usize) -> Value {
    let driver = &scene.drivers[k];
    let (turns, symbol) = match &driver.kind {
        DriverKind::Turn { link, against, .. } if *against == scene.ground => {
            (true, format!("\\varphi_{{{}}}", name_label(scene.link_name(*link))))
        }
        DriverKind::Turn { link, against, .. } => {
            (true, format!("\\varphi_{{{}/{}}}", name_label(scene.link_name(*link)), name_label(scene.link_name(*against))))
        }
        DriverKind::Slide { guide, .. } => {
            let g = &scene.guides[guide.0];
            let name = g.pin.map(|p| scene.point_name(p)).or(g.slider.map(|s| scene.link_name(s))).unwrap_or_default();
            (false, format!("s_{{{}}}", name_label(name)))
        }
        DriverKind::Cylinder { a, b, .. } => {
            (false, format!("l_{{{}{}}}", name_label(scene.point_name(*a)), name_label(scene.point_name(*b))))
        }
    };
    let (book, what) = (&scene.book, scene.driver_name(k).1);
    let factor = match (book.chosen(what), turns) {
        (Some(unit), _) => unit.of(1.0),
        (None, true) => 180.0 / std::f64::consts::PI,
        (None, false) => 1e3,
    };
    let start = match &driver.kind {
        DriverKind::Turn { angle: Some(a), .. } if book.chosen(what).is_none() => Some(a.value.degrees()),
        _ => driver_position(scene, k).map(|s| s * factor),
    };
    let symbol = if start.is_some() { symbol } else { format!("\\Delta {symbol}") };
    let back = driver.rate.value < 0.0;
    let mut told = json!({"turns": turns, "symbol": mathml(&Label::math(&symbol)), "plain": crate::paper::phrase::formula(&symbol), "start": start, "factor": factor, "back": back});
    // A unit of the book, and in how many parts of it the page tells the position.
    if book.chosen(what).is_some() {
        told["unit"] = json!(book.text(what, ""));
        told["turn"] = json!(std::f64::consts::TAU * factor);
        told["parts"] = json!(book.parts(what, 10.0));
    }
    told
}

/// What is said at each end of the travel, English and Chinese; null where nothing stops the driver.
fn limits(scene: &Scene, sweep: &Sweep, frames: &Frames) -> Value {
    let mechanism = &frames.list[frames.base].worked.mechanism;
    let ends = [sweep.poses.first(), sweep.poses.last()];
    let said = ends.into_iter().zip(sweep.limits).map(|(pose, limit)| {
        let (Some(pose), Some(_)) = (pose, limit) else { return Value::Null };
        let key = if sweep.far(pose) { "limit_far" } else { "limit" };
        let toggle = Toggle::at(mechanism, &pose.configuration).filter(|_| !sweep.far(pose));
        let told = |t: &Toggle, lang| word("limit_toggle", lang).replace("{}", &t.words(scene, lang));
        json!(LANGS.map(|lang| toggle.as_ref().map_or_else(|| word(key, lang).to_owned(), |t| told(t, lang))))
    });
    said.collect()
}

/// The point by which the driver is dragged, over the frames: two packed columns ([`UNIT`]) on the
/// mechanism's paper, y down.
fn handle(frames: &Frames, driver: usize, paper: &Scenery) -> Value {
    let places: Vec<Point> =
        frames.list.iter().map(|f| grip(f, driver).unwrap_or(Point::ORIGIN) + stray(frames, f) + (paper.origin - Point::ORIGIN)).collect();
    let mut packed = String::new();
    let whole = |v: f64| (v * UNIT).round() as i64;
    pack::column(&places.iter().map(|p| whole(p.x)).collect::<Vec<_>>(), &mut packed);
    pack::column(&places.iter().map(|p| whole(paper.size_mm[1] - p.y)).collect::<Vec<_>>(), &mut packed);
    json!(packed)
}

/// The driver's grip on the diagram (mm from its origin): the farthest point of a turning link, the slider, the rod's joint.
fn grip(frame: &Frame, driver: usize) -> Option<Point> {
    let (scene, at) = (&frame.scene, &frame.worked.configuration);
    let diagram = &frame.worked.construction.diagram;
    let place = match &scene.drivers[driver].kind {
        DriverKind::Turn { link, against, line, .. } => {
            let shared = |p: &&crate::scene::PointId| scene.links[against.0].points.contains(p);
            let points = &scene.links[link.0].points;
            let centre = points.iter().find(shared).and_then(|p| at.points[p.0]);
            let of_line = line.and_then(|(a, b)| Some((at.points[a.0]?, at.points[b.0]?)));
            match (of_line, centre) {
                (Some((a, b)), Some(c)) => Some(if a.distance(c) > b.distance(c) { a } else { b }),
                (Some((_, b)), None) => Some(b),
                (None, Some(c)) => points.iter().filter_map(|p| at.points[p.0]).max_by(|a, b| a.distance(c).total_cmp(&b.distance(c))),
                (None, None) => points.iter().find_map(|p| at.points[p.0]),
            }
        }
        DriverKind::Slide { guide, .. } => {
            let g = &scene.guides[guide.0];
            g.pin.and_then(|p| at.points[p.0]).or_else(|| at.poses[g.slider?.0].map(|p| p.origin))
        }
        DriverKind::Cylinder { b, .. } => at.points[b.0],
    }?;
    Some(((place - diagram.origin) * (1.0 / diagram.mu_l)).to_point())
}
