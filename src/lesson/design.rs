//! The lesson of a synthesis: one HTML page with the construction step by step and the linkage
//! found, which moves to each of the prescribed positions.
//!
//! This module decides what the page holds. The construction is that of
//! [`crate::figure::synthesis`], the motion that of [`crate::sweep::follow`]. The page fetches
//! nothing and holds both languages.

use super::player::{PlayerDrawing, PlayerPage, legible, nameless, stepped};
use super::steps::LANGS;
use crate::diag::{Both, Diagnostic, Faults, both};
use crate::digits::significant;
use crate::figure::synthesis::{self as figure, MOVES, Scaled, Set};
use crate::geom::Point;
use crate::mechanism::{Demand, Mechanism};
use crate::paper::extent::Rect;
use crate::paper::item::FigureItem;
use crate::paper::phrase::Phrase;
use crate::paper::style::Style;
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
use hodograph_base::lang::each;
use serde_json::{Value, json};
use std::f64::consts::TAU;

/// Frames through a turn of the driver.
const FRAMES: usize = 120;

/// Words of this page in addition to those of the player: key, both languages.
const WORDS: [(&str, [&str; 2]); 10] = [
    ("construction", each!("heading" => "Construction")),
    ("linkage", each!("The linkage")),
    ("positions", each!("Wanted positions:")),
    ("home", each!("To the first wanted position")),
    ("instant", each!("Position of the driver")),
    ("given", ["", ""]),
    ("answers", each!("Results")),
    ("measured", each!("Measured on paper × scale, and by the closed formula")),
    (
        "keys",
        each!(
            "Keys: → and ← the steps of the construction; 1, 2, 3 … the positions; + and − the driver; 0 the first position; Space runs; L language; D light or dark; P print; S window of the speaker."
        ),
    ),
    (
        "noscript",
        each!("The page needs JavaScript to move; without it, it shows the finished construction."),
    ),
];

fn word(key: &str, lang: Lang) -> &'static str {
    let found = WORDS.iter().find(|w| w.0 == key).map_or(["", ""], |w| w.1);
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
    let (lang, whole) = (options.lang, false);
    let style = legible(&options.style, |style| {
        let drawn = board
            .as_ref()
            .map(|b| figure::construction(task, candidate, b, Set { style, lang, whole }));
        Ok(drawn.iter().map(|figure| [figure.width_mm, figure.height_mm]).collect())
    })?;
    let set = Set { style: &style, lang, whole };
    let captions = |key| LANGS.map(|lang| word(key, lang).to_owned());
    let mut drawings = Vec::new();
    if let Some(board) = &board {
        let figure = figure::construction(task, candidate, board, set);
        let mut letters = Elements::new(figure.height_mm);
        let ground = stepped(&nameless(figure.items.iter()), &mut letters)?;
        drawings.push(PlayerDrawing {
            windows_mm: vec![[0.0, 0.0, figure.width_mm, figure.height_mm]],
            letters,
            ground,
            frames: Vec::new(),
            caption: captions("construction"),
            scale: String::new(),
            left: true,
        });
    }
    let linkage = figure::scaled(task, candidate, set);
    let motion = LinkageMotion::of(candidate, &linkage)?;
    drawings.push(motion.drawing(&linkage, captions("linkage"))?);
    let sentence = |b: &Both, lang: Lang| html(&Phrase::new(&symbols(lang.of(b))));
    let steps: Vec<Value> = board
        .iter()
        .flat_map(|b| &b.steps)
        .map(|s| json!(LANGS.map(|lang| sentence(&s.text, lang))))
        .collect();
    let facts = LANGS.map(|lang| facts(&task.book, candidate, board.as_ref(), lang));
    let title = &task.heading.title;
    let page = PlayerPage {
        title: [title.en.as_str(), title.zh.as_str()],
        lang: options.lang,
        words: &WORDS,
        base: motion.stops.first().copied().unwrap_or(0),
        type_mm: style.small_mm,
        data: json!({
            "frames": motion.frames.iter().map(|f| json!({"at": f.at})).collect::<Vec<_>>(),
            "steps": steps,
            "answers": facts,
            "stops": motion.stops,
            "full": motion.full,
        }),
    };
    Ok(page.written(&drawings))
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

/// A frame of the linkage's motion.
struct LinkageFrame {
    /// The driver's angle: `φ = 37°`.
    at: String,
    /// The places of the points, in millimetres of the page, y down.
    places: Vec<Point>,
    /// The angles of the sliders (degrees), clockwise.
    turned: Vec<f64>,
}

/// The linkage through the travel of its driver.
struct LinkageMotion {
    /// The indices of each link's points.
    links: Vec<Vec<usize>>,
    /// Points with a slider block.
    blocks: Vec<usize>,
    frames: Vec<LinkageFrame>,
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
        let none = || Diagnostic::error("no-motion", both!("the linkage does not move"));
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
        let grounded = |n: &String| {
            scene.links[scene.ground.0].points.iter().any(|p| scene.point_name(*p) == n)
        };
        let fixed = (0..names.len()).filter(|k| grounded(&names[*k])).collect();
        let mut window: Option<Rect> = None;
        let mut frame = |pose: &TravelPose| {
            let at = places(scene, &pose.configuration, &names);
            let on_page = at.iter().map(|p| linkage.place(*p));
            let places = on_page
                .map(|p| {
                    window = Some(window.map_or(Rect::new(p, p), |w| w.union(Rect::new(p, p))));
                    Point::new(p.x, linkage.figure.height_mm - p.y)
                })
                .collect();
            let posed = pose_of(scene, &pose.configuration);
            // On the page, positive rotation is clockwise.
            let turned = posed.sliders.iter().map(|s| -s.direction.angle().to_degrees()).collect();
            let driver = significant((now + pose.travel).to_degrees().rem_euclid(360.0), 5);
            LinkageFrame { at: format!("φ = {driver}°"), places, turned }
        };
        let frames = poses.iter().map(&mut frame).collect();
        let window = window.ok_or_else(none)?.grown(4.0);
        Ok(LinkageMotion { links, blocks, frames, stops, full, fixed, window })
    }

    /// The drawing: the picture without the moving parts, over all places of its points, and the
    /// moving parts of each frame.
    fn drawing(&self, linkage: &Scaled, caption: [String; 2]) -> Result<PlayerDrawing, Faults> {
        let figure = &linkage.figure;
        let moves = |i: &&FigureItem| i.class.split(' ').any(|c| c == MOVES);
        let items = nameless(figure.items.iter().filter(|i| !moves(i)));
        let mut letters = Elements::new(figure.height_mm);
        let ground = letters.of(&items)?.join("\n");
        let paper = Rect::new(Point::ORIGIN, Point::new(figure.width_mm, figure.height_mm));
        let all = self.window.union(paper);
        Ok(PlayerDrawing {
            windows_mm: vec![[
                all.min.x,
                figure.height_mm - all.max.y,
                all.width_mm(),
                all.height_mm(),
            ]],
            letters,
            ground,
            frames: (0..self.frames.len()).map(|k| self.markup(k)).collect(),
            caption,
            scale: String::new(),
            left: false,
        })
    }

    /// The moving parts in a frame: links, blocks, and pins over the links.
    fn markup(&self, k: usize) -> String {
        let LinkageFrame { places, turned, .. } = &self.frames[k];
        let place = |p: usize| [places[p].x, places[p].y].map(mm);
        let link = |points: &Vec<usize>| {
            let corners: Vec<String> = points.iter().map(|p| place(*p).join(",")).collect();
            let shape = if points.len() > 2 { "polygon" } else { "polyline" };
            format!("<{shape} points=\"{}\"/>", corners.join(" "))
        };
        let block = |(p, angle): (&usize, &f64)| {
            let [x, y] = place(*p);
            format!(
                "<rect x=\"-2.5\" y=\"-1.5\" width=\"5\" height=\"3\" transform=\"translate({x} {y}) rotate({})\"/>",
                mm(*angle)
            )
        };
        let stops = self.stops.contains(&k);
        let pin = |p: usize| {
            let ([x, y], reached) = (place(p), stops && !self.fixed.contains(&p));
            let class = if reached { " class=\"reached\"" } else { "" };
            format!("<circle cx=\"{x}\" cy=\"{y}\" r=\".9\"{class}/>")
        };
        let links = self.links.iter().map(link);
        let parts = links.chain(self.blocks.iter().zip(turned).map(block));
        let parts: String = parts.chain((0..places.len()).map(pin)).collect();
        format!("<g class=\"linkage\">{parts}</g>")
    }
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
