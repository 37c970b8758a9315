//! The lesson of a synthesis: one HTML page with the construction step by step and the linkage
//! found, which moves to each of the prescribed positions.
//!
//! This module decides what the page holds. The construction is that of
//! [`crate::figure::synthesis`], the motion that of [`crate::sweep::follow`]. The page fetches
//! nothing and holds both languages.

use super::LARGER;
use super::motion::PLAYER;
use super::page::{BASE, filled, terse, with_fonts};
use crate::diag::{Both, Diagnostic, Faults, both};
use crate::digits::significant;
use crate::figure::synthesis::{self as figure, MOVES, Scaled, Set};
use crate::geom::Point;
use crate::mechanism::{Demand, Mechanism};
use crate::paper::extent::Rect;
use crate::paper::item::{Figure, FigureItem};
use crate::paper::phrase::Phrase;
use crate::paper::style::Style;
use crate::paper::words::words as figure_words;
use crate::position::{self, Configuration};
use crate::render::escaped;
use crate::render::number::mm;
use crate::render::svg::Elements;
use crate::report::html::sentence as html;
use crate::report::symbols::symbols;
use crate::report::synthesis::{pose_of, value};
use crate::scene::{self, Book, Lang, Scene};
use crate::sweep::follow::{PoseFollower, TravelPose};
use crate::sweep::station::position_now;
use crate::synthesis::board::SynthesisBoard;
use crate::synthesis::candidate::letters;
use crate::synthesis::{DesignCandidate, Task};
use serde_json::{Value, json};
use std::f64::consts::TAU;

const PAGE: &str =
    concat!(include_str!("head.html"), include_str!("player.html"), include_str!("design.html"));
const STYLE: [&str; 2] = [BASE, include_str!("design.css")];
const SCRIPT: &str = concat!(include_str!("design.js"), include_str!("player.js"));
/// Frames through a turn of the driver.
const FRAMES: usize = 120;

/// Words of this page in addition to those of [`PLAYER`]: key, both languages.
const WORDS: [(&str, [&str; 2]); 6] = [
    ("construction", ["Construction", "作图"]),
    ("linkage", ["The linkage", "所得机构"]),
    ("positions", ["Wanted positions:", "预定位置："]),
    (
        "measured",
        ["Measured on paper × scale, and by the closed formula", "图上量得 × 比例尺，与公式值对照"],
    ),
    (
        "keys",
        [
            "Keys: → and ← the steps of the construction; 1, 2, 3 … the positions; + and − the driver; Space runs; L language; D light or dark.",
            "键盘：→、← 作图步骤；1、2、3…… 预定位置；+、− 转动原动件；空格 运动；L 切换语言；D 浅色或深色。",
        ],
    ),
    (
        "noscript",
        [
            "The page needs JavaScript to move; without it, it shows the finished construction.",
            "本页需启用 JavaScript；未启用时仅显示完成的作图。",
        ],
    ),
];

fn word(key: &str, lang: Lang) -> &'static str {
    let found = PLAYER.iter().chain(&WORDS).find(|w| w.0 == key).map_or(["", ""], |w| w.1);
    found[usize::from(lang == Lang::Zh)]
}

/// Options of the page.
#[derive(Clone, Debug)]
pub struct DesignOptions {
    /// The language in which the page opens; it holds both.
    pub lang: Lang,
    /// Weights, sizes and fonts of the drawings; the page sets the colours.
    pub style: Style,
}

/// The page of a candidate of a synthesis task.
///
/// ```
/// use hodograph::{paper::style::Style, lesson::design, scene::Lang, synthesis};
/// let task = synthesis::read(synthesis::templates::get("body").unwrap())?.value;
/// let found = synthesis::solve(&task)?;
/// let page = design::lesson(&task, &found.candidates[0], &design::DesignOptions { lang: Lang::En, style: Style::default() })?;
/// assert!(page.starts_with("<!DOCTYPE html>"));
/// # Ok::<(), hodograph::diag::Faults>(())
/// ```
///
/// # Errors
/// Drawing and formula disagree; a generated scene cannot be placed; those of the SVG writer.
pub fn lesson(
    task: &Task,
    candidate: &DesignCandidate,
    options: &DesignOptions,
) -> Result<String, Faults> {
    let board = figure::to_scale(task, candidate)?;
    // Small type is enlarged: the page is read from the last row.
    let style = Style { small_mm: options.style.small_mm * LARGER, ..options.style.clone() };
    let set = Set { style: &style, lang: options.lang, whole: false };
    let mut drawn: Vec<Elements> = Vec::new();
    let construction = match &board {
        Some(board) => {
            stepped(&figure::construction(task, candidate, board, set), &mut drawn, options.lang)?
        }
        None => String::new(),
    };
    let linkage = figure::scaled(task, candidate, set);
    let motion = LinkageMotion::of(candidate, &linkage)?;
    let markup = moving(&linkage, motion.window, &mut drawn)?;
    let sentence = |b: &Both, lang: Lang| html(&Phrase::new(&symbols(lang.of(b))));
    let both_of = |b: &Both| json!([sentence(b, Lang::En), sentence(b, Lang::Zh)]);
    let steps: Vec<Value> = board.iter().flat_map(|b| &b.steps).map(|s| both_of(&s.text)).collect();
    let title = &task.heading.title;
    let tables =
        [Lang::En, Lang::Zh].map(|lang| facts(&task.book, candidate, board.as_ref(), lang));
    let list = |lang: Lang| {
        PLAYER
            .iter()
            .chain(&WORDS)
            .map(|(k, _)| ((*k).to_owned(), json!(word(k, lang))))
            .collect::<serde_json::Map<_, _>>()
    };
    let data = json!({
        "lang": figure_words(options.lang).tag.split('-').next().unwrap_or("en"),
        "tags": {"en": figure_words(Lang::En).tag, "zh": figure_words(Lang::Zh).tag},
        "words": {"en": list(Lang::En), "zh": list(Lang::Zh)},
        "title": [title.en, title.zh],
        "steps": steps,
        "facts": tables,
        "links": motion.links, "pins": motion.pins, "blocks": motion.blocks, "frames": motion.frames,
        "stops": motion.stops, "full": motion.full, "fixed": motion.fixed,
    });
    // In a script element, `</` may end the script, and `<!--` may hide its end.
    let data = data.to_string().replace("</", "<\\/").replace("<!", "\\u003c!");
    Ok(filled(
        PAGE,
        &[
            ("lang", figure_words(options.lang).tag),
            ("title", &escaped(options.lang.of(title))),
            ("style", &with_fonts(&STYLE)),
            ("letters", &Elements::letters(&drawn)),
            ("construction", &construction),
            ("linkage", &markup),
            ("noscript", &escaped(word("noscript", options.lang))),
            ("data", &data),
            ("script", &terse(SCRIPT)),
        ],
    ))
}

/// Items without their ids: two drawings in a page must not share ids.
pub(super) fn nameless<'a>(items: impl Iterator<Item = &'a FigureItem>) -> Vec<FigureItem> {
    items.map(|i| FigureItem { id: String::new(), ..i.clone() }).collect()
}

/// The construction, each element in a group that names its step.
fn stepped(figure: &Figure, drawn: &mut Vec<Elements>, lang: Lang) -> Result<String, Faults> {
    let mut elements = Elements::new(figure.height_mm);
    let mut body = String::new();
    let items = nameless(figure.items.iter());
    for (item, element) in items.iter().zip(elements.of(&items)?) {
        body += &match item.steps().min() {
            Some(k) => format!("<g data-step=\"{k}\">{element}</g>\n"),
            None => format!("{element}\n"),
        };
    }
    drawn.push(elements);
    let (w, h) = (mm(figure.width_mm), mm(figure.height_mm));
    Ok(format!(
        "<figure id=\"construction\" class=\"drawing\">\n<svg viewBox=\"0 0 {w} {h}\" style=\"--w:{w};--h:{h}\" role=\"img\">\n<g class=\"ink\">\n{body}</g>\n</svg>\n\
         <figcaption data-word=\"construction\">{}</figcaption>\n</figure>\n",
        escaped(word("construction", lang))
    ))
}

/// The linkage's picture without the moving parts, over all places of its points.
fn moving(linkage: &Scaled, window: Rect, drawn: &mut Vec<Elements>) -> Result<String, Faults> {
    let figure = &linkage.figure;
    let items = nameless(figure.items.iter().filter(|i| !i.class.split(' ').any(|c| c == MOVES)));
    let mut elements = Elements::new(figure.height_mm);
    let body = elements.of(&items)?.join("\n");
    drawn.push(elements);
    let all = window.union(Rect::new(Point::ORIGIN, Point::new(figure.width_mm, figure.height_mm)));
    let (w, h) = (mm(all.width_mm()), mm(all.height_mm()));
    Ok(format!(
        "<svg viewBox=\"{} {} {w} {h}\" style=\"--w:{w};--h:{h}\" role=\"img\">\n<g class=\"ink\">\n{body}\n</g>\n<g class=\"moving\"></g>\n</svg>",
        mm(all.min.x),
        mm(figure.height_mm - all.max.y)
    ))
}

/// A number's name in markup: φ with an index for `phi0`.
fn name(name: &str) -> String {
    let (word, index) = letters(name);
    if index.is_empty() { escaped(&word) } else { format!("{}<sub>{index}</sub>", escaped(&word)) }
}

/// The values measured on paper beside the formula's numbers; without a drawing the numbers alone.
fn facts(
    book: &Book,
    candidate: &DesignCandidate,
    board: Option<&SynthesisBoard>,
    lang: Lang,
) -> String {
    let row = |cells: [String; 3], tag: &str| {
        format!("<tr>{}</tr>", cells.map(|c| format!("<{tag}>{c}</{tag}>")).concat())
    };
    let read = board.iter().flat_map(|b| b.readings.iter().map(move |r| (*b, r)));
    let rows: String = read
        .filter_map(|(b, r)| {
            let number = candidate.draft.numbers.iter().find(|n| n.name == r.name)?;
            let drawn = match r.angle {
                true => format!("{}°", significant(b.value(r).to_degrees(), 5)),
                false => format!(
                    "{} mm · {} = {} mm",
                    significant(r.measured, 4),
                    crate::digits::shortest(b.mu_l),
                    significant(b.value(r) * 1e3, 5)
                ),
            };
            Some(row([name(&r.name), drawn, value(book, number)], "td"))
        })
        .collect();
    if rows.is_empty() {
        let all = candidate
            .draft
            .numbers
            .iter()
            .map(|n| row([name(&n.name), escaped(lang.of(&n.what)), value(book, n)], "td"));
        return format!("<table>{}</table>", all.collect::<String>());
    }
    format!(
        "<table><tr><th colspan=\"3\">{}</th></tr>{rows}</table>",
        escaped(word("measured", lang))
    )
}

/// The linkage through the travel of its driver, in millimetres of the page, y down.
struct LinkageMotion {
    /// The indices of each link's points.
    links: Vec<Vec<usize>>,
    /// Pins, also those on the ground: they are drawn over the links.
    pins: Vec<usize>,
    /// Points with a slider block.
    blocks: Vec<usize>,
    frames: Vec<Value>,
    /// The frames of the prescribed positions.
    stops: Vec<usize>,
    full: bool,
    /// Points on the ground.
    fixed: Vec<usize>,
    window: Rect,
}

impl LinkageMotion {
    fn of(candidate: &DesignCandidate, linkage: &Scaled) -> Result<LinkageMotion, Faults> {
        let scene = scene::read(candidate.scene_text())?.value;
        let mechanism = Mechanism::new(&scene)?.value;
        let demand = Demand::of(&scene, &mechanism).with_all_positions();
        let base = position::configure(&scene, &mechanism, &demand)?.value;
        let follower = PoseFollower::new(&scene, &mechanism, &demand, &base, 0);
        let sweep = follower.sweep(FRAMES);
        let now = position_now(&scene, &base, 0);
        let mut poses = sweep.poses;
        let stops = candidate
            .draft
            .wanted
            .iter()
            .map(|w| stop(&mut poses, &follower, w.driver - now, sweep.full))
            .collect::<Vec<_>>();
        // Frames were inserted: later frames have a larger index.
        let travels: Vec<f64> = stops.into_iter().flatten().collect();
        let stops =
            travels.iter().filter_map(|t| poses.iter().position(|p| p.travel == *t)).collect();
        LinkageMotion::drawn(&scene, linkage, &poses, now, stops, sweep.full)
    }

    fn drawn(
        scene: &Scene,
        linkage: &Scaled,
        poses: &[TravelPose],
        now: f64,
        stops: Vec<usize>,
        full: bool,
    ) -> Result<LinkageMotion, Faults> {
        let none =
            || Diagnostic::error("no-motion", both!("the linkage does not move", "机构不能运动"));
        let first = pose_of(scene, &poses.first().ok_or_else(none)?.configuration);
        let mut names: Vec<String> = Vec::new();
        let mut index = |name: &String| match names.iter().position(|n| n == name) {
            Some(k) => k,
            None => {
                names.push(name.clone());
                names.len() - 1
            }
        };
        let links: Vec<Vec<usize>> = first
            .links
            .iter()
            .map(|(_, points)| points.iter().map(|(n, _)| index(n)).collect())
            .collect();
        let guided = scene.guides.iter().filter_map(|g| Some(scene.point_name(g.pin?).to_owned()));
        let blocks: Vec<usize> = guided.map(|n| index(&n)).collect();
        let pins = (0..names.len()).collect();
        let grounded = |n: &String| {
            scene.links[scene.ground.0].points.iter().any(|p| scene.point_name(*p) == n)
        };
        let fixed = (0..names.len()).filter(|k| grounded(&names[*k])).collect();
        let mut window: Option<Rect> = None;
        let mut frame = |pose: &TravelPose| {
            let at = places(scene, &pose.configuration, &names);
            let on_page = at.iter().map(|p| linkage.place(*p));
            let places: Vec<Value> = on_page
                .flat_map(|p| {
                    window = Some(window.map_or(Rect::new(p, p), |w| w.union(Rect::new(p, p))));
                    [p.x, linkage.figure.height_mm - p.y].map(hundredths)
                })
                .collect();
            let posed = pose_of(scene, &pose.configuration);
            // On the page, positive rotation is clockwise.
            let turned: Vec<Value> = posed
                .sliders
                .iter()
                .map(|s| hundredths(-s.direction.angle().to_degrees()))
                .collect();
            let driver = significant((now + pose.travel).to_degrees().rem_euclid(360.0), 5);
            json!({"p": places, "r": turned, "d": driver})
        };
        let frames = poses.iter().map(&mut frame).collect();
        let window = window.ok_or_else(none)?.grown(4.0);
        Ok(LinkageMotion { links, pins, blocks, frames, stops, full, fixed, window })
    }
}

/// A place of the page, to a hundredth of a millimetre.
fn hundredths(value: f64) -> Value {
    json!((value * 100.0).round() / 100.0)
}

/// Points by their names; a point without place in a pose is put at the origin, and no drawing
/// shows it.
fn places(scene: &Scene, at: &Configuration, names: &[String]) -> Vec<Point> {
    let of = |name: &String| {
        (0..scene.points.len()).find(|p| scene.points[*p].name == *name).and_then(|p| at.points[p])
    };
    names.iter().map(|n| of(n).unwrap_or(Point::ORIGIN)).collect()
}

/// Inserts the pose of a prescribed position; returns its travel if the motion reaches it.
fn stop(
    poses: &mut Vec<TravelPose>,
    follower: &PoseFollower,
    travel: f64,
    full: bool,
) -> Option<f64> {
    let (low, high) = (poses.first()?.travel, poses.last()?.travel);
    let step = (high - low) / poses.len() as f64;
    let inside = |t: &f64| full && (0.0..TAU).contains(t) || (low - 1e-9..=high + 1e-9).contains(t);
    let turned = if full { travel.rem_euclid(TAU) } else { travel };
    let wanted = [turned, turned - TAU, turned + TAU].into_iter().find(inside)?;
    let nearest = poses
        .iter()
        .min_by(|a, b| (a.travel - wanted).abs().total_cmp(&(b.travel - wanted).abs()))?;
    if (nearest.travel - wanted).abs() < 1e-6 * step.max(1e-3) {
        return Some(nearest.travel);
    }
    let configuration = follower.at(&nearest.configuration, wanted)?;
    let after = poses.iter().position(|p| p.travel > wanted).unwrap_or(poses.len());
    poses.insert(after, TravelPose { travel: wanted, configuration });
    Some(wanted)
}
