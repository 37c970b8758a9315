//! The one scale of a polygon, and the two windows through which the page looks at it.
//!
//! Decided here: that a polygon has the scale of the scene's own figure in all positions, so that vectors can be compared and every
//! sentence names the lengths of the worksheet; and that the page looks at it through a window that the polygon of the scene's own
//! pose fills, and, once a vector would leave that, through one that holds the polygons of all poses. A window is told in
//! millimetres of its own, in which type, weights and arrowheads have the sizes of the style: through either the type is as
//! large on the screen.

use crate::construct::scale::{self, Boxes, extent};
use crate::figure::series::{Scales, ends, size};
use crate::geom::{Point, Vec2};
use crate::mechanism::Level;
use crate::paper::extent::Rect;
use crate::scene::Paper;
use crate::worked::Worked;

/// The usual polygon is that of the scene's own pose; it is not taken for smaller than this part of what half of all poses have.
const OF_HALF: f64 = 0.5;
/// How much larger the polygon of the scene's own pose must be seen through a window of its own to be worth one.
pub const GAIN: f64 = 1.25;
/// The stage of a polygon on a projector of 1280 × 720 pixels: width and height (px).
const STAGE_PX: [f64; 2] = [700.0, 430.0];
/// The type there: letters without ascenders, 0.44 of it, are 14.5 px high, and digits of indices as high.
const TYPE_PX: f64 = 33.0;
/// The stage of the mechanism there, and its type.
const DIAGRAM_PX: [f64; 2] = [505.0, 435.0];
const DIAGRAM_TYPE_PX: f64 = 24.0;
/// Room for names around the vectors, at each side (em of the type).
const NAMES_EM: [f64; 2] = [1.7, 1.1];
/// The window of all poses holds polygons up to so many times those of the own pose, or of half of all poses: what is longer still,
/// next to a limit or a dead centre, leaves it, and the page steps back from it.
const LONGEST: f64 = 2.5;

/// Width and height of a polygon's window (mm of the window), for type of this size.
pub fn window_mm(label_mm: f64) -> [f64; 2] {
    STAGE_PX.map(|px| px * label_mm / TYPE_PX)
}

/// The same for the mechanism: its figure is not seen through a larger window, so that its letters can be read from far too.
pub fn stage_mm(label_mm: f64) -> [f64; 2] {
    DIAGRAM_PX.map(|px| px * label_mm / DIAGRAM_TYPE_PX)
}

/// Width and height of the room that it has for vectors.
fn inner_mm(label_mm: f64) -> [f64; 2] {
    let window = window_mm(label_mm);
    [0, 1].map(|i| window[i] - 2.0 * NAMES_EM[i] * label_mm)
}

/// The room for names around what is drawn.
pub fn with_names(lines: Rect, label_mm: f64) -> Rect {
    let room = Vec2::new(NAMES_EM[0] * label_mm, NAMES_EM[1] * label_mm);
    Rect::new(lines.min - room, lines.max + room)
}

/// The scale and windows of a polygon.
#[derive(Clone, Debug, PartialEq)]
pub struct Zoom {
    /// The scale, of all poses (SI per mm of paper).
    pub mu: f64,
    /// SI per mm of the window, for the scene's own pose and for all of them; equal where one window serves both.
    pub view: [f64; 2],
    level: Level,
    /// What the two windows look at (SI): the middles of the vectors that they are made for.
    pub middles: [Point; 2],
    /// How far the own window holds vectors to either side (SI).
    half: [f64; 2],
}

impl Zoom {
    /// That of a polygon that `common` has a scale for; `None` where there is no such polygon. Poses come with the driver's travel.
    pub fn of(paper: &Paper, poses: &[(f64, &Worked)], common: &Scales, level: Level, boxes: Boxes, label_mm: f64) -> Option<Zoom> {
        let later = level == Level::Acceleration;
        let one = common.mu[usize::from(later)]?;
        let on_paper = |w: &&Worked| common.holds(w, level);
        let sized = |w: &Worked| size(w, level, &boxes).unwrap_or(0.0);
        let mut sizes: Vec<f64> = poses.iter().map(|p| p.1).filter(on_paper).map(sized).collect();
        sizes.sort_by(f64::total_cmp);
        let base = poses.iter().min_by(|a, b| a.0.abs().total_cmp(&b.0.abs())).map(|p| p.1)?;
        let own = sized(base);
        let half = OF_HALF * sizes.get(sizes.len() / 2).copied().unwrap_or(0.0);
        let fixed = if later { paper.mu_a } else { paper.mu_v };
        let usual = if own >= half { base.construction.polygon(level).map(|p| p.mu) } else { None };
        let around = |longest: f64| {
            let held = poses.iter().map(|p| p.1).filter(on_paper).flat_map(|w| {
                let part = if longest.is_finite() { (longest / sized(w)).min(1.0) } else { 1.0 };
                ends(w, level).map(move |p| (p.to_vec2() * part).to_point())
            });
            held.chain([Point::ORIGIN]).collect::<Vec<Point>>()
        };
        let usual_mu = || scale::choose_in(paper.unit(level as usize), extent(around(half).into_iter()), boxes.polygon);
        let mu = fixed.or(usual).unwrap_or_else(|| if half > 0.0 { usual_mu() } else { one });
        let inner = inner_mm(label_mm);
        let needed = |points: &[Point]| {
            let [w, h] = extent(points.iter().copied());
            (w / inner[0]).max(h / inner[1])
        };
        let typical = own.max(half / OF_HALF);
        let all = around(if typical > 0.0 { LONGEST * typical } else { f64::INFINITY });
        let shown: Vec<Point> = if own >= half { ends(base, level).chain([Point::ORIGIN]).collect() } else { around(half) };
        let (turn, own) = (needed(&all), needed(&shown));
        let two = own > 0.0 && turn > GAIN * own;
        let view = match (turn > 0.0, two) {
            (false, _) => [one; 2],
            (true, false) => [turn; 2],
            (true, true) => [own, turn],
        };
        let middles = [middle(if two { &shown } else { &all }), middle(&all)];
        Some(Zoom { mu, view, level, middles, half: inner.map(|side| 0.5 * side * view[0]) })
    }

    /// Through which window a pose's polygon is first seen: the own one where its vectors lie in that.
    pub fn place(&self, worked: &Worked) -> usize {
        let at = self.middles[0];
        let inside = |p: Point| (p.x - at.x).abs() <= self.half[0] && (p.y - at.y).abs() <= self.half[1];
        usize::from(self.view[0] < self.view[1] && !ends(worked, self.level).all(inside))
    }
}

/// The middle of the box around points.
fn middle(points: &[Point]) -> Point {
    let axis = |of: fn(&Point) -> f64| {
        let (low, high) = points.iter().map(of).fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        0.5 * (low + high)
    };
    Point::new(axis(|p| p.x), axis(|p| p.y))
}

/// The pose with its diagram drawn so many times as large, about the diagram's origin.
pub fn diagram(worked: &Worked, k: f64) -> Worked {
    let mut worked = worked.clone();
    let diagram = &mut worked.construction.diagram;
    diagram.mu_l /= k;
    diagram.spots.iter_mut().flatten().for_each(|p| *p = (p.to_vec2() * k).to_point());
    worked
}
