//! The scale of a polygon, and the two windows through which the page shows it.
//!
//! A polygon has the scale of the scene's own figure in all positions, so that vectors can be
//! compared and every sentence gives the lengths of the worksheet. The page shows it through a
//! window that the polygon of the scene's own pose fills. Once a vector would leave that window,
//! the page shows it through one that holds the polygons of all poses. Each part of a split polygon
//! ([`super::split`]) has windows of its own. A window is measured in millimetres of its own, in
//! which type, weights and arrowheads have the sizes of the style: type is equally large on the
//! screen through either.

use crate::construct::scale::{self, Boxes, extent};
use crate::equilibrium::Equilibrium;
use crate::figure::series::{SeriesScales, ends, size};
use crate::geom::{Point, Vec2};
use crate::paper::extent::Rect;
use crate::scene::{DiagramKind, Paper};
use crate::worked::Worked;

/// The usual polygon is that of the scene's own pose, but at least this part of the median size
/// over all poses; this is the limit for the scale, the next one for the window.
const OF_HALF: f64 = 0.5;
const WINDOW_OF_HALF: f64 = 0.1;
/// The least magnification at which the polygon of the scene's own pose gets a window of its own.
pub const GAIN: f64 = 1.25;
/// The area of a polygon on a projector of 1280 × 720 pixels: width and height (px).
const STAGE_PX: [f64; 2] = [700.0, 430.0];
/// The type size there: letters without ascenders (0.44 of it) and digits of indices are 14.5 px
/// high.
const TYPE_PX: f64 = 33.0;
/// The area of the mechanism there, and its type size: letters without ascenders are 15 px high,
/// and 11 px on a phone.
const DIAGRAM_PX: [f64; 2] = [505.0, 435.0];
const DIAGRAM_TYPE_PX: f64 = 34.0;
/// Space for names around the vectors, on each side (em of the type).
const NAMES_EM: [f64; 2] = [1.7, 1.1];
/// Largest polygon in the window of all poses, as a multiple of the larger of the own and the
/// median polygon. Longer vectors, next to a limit or a dead centre, leave the window, and the page
/// enlarges it.
const LONGEST: f64 = 2.5;

/// Width and height of a polygon's window (mm of the window), for type of this size.
pub fn window_mm(label_mm: f64) -> [f64; 2] {
    STAGE_PX.map(|px| px * label_mm / TYPE_PX)
}

/// Width and height of the mechanism's window (mm of the window). The figure is shown through no
/// larger window, so that its letters are legible from a distance.
pub fn stage_mm(label_mm: f64) -> [f64; 2] {
    DIAGRAM_PX.map(|px| px * label_mm / DIAGRAM_TYPE_PX)
}

/// Width and height of the window's space for vectors.
fn inner_mm(label_mm: f64) -> [f64; 2] {
    let window = window_mm(label_mm);
    [0, 1].map(|i| window[i] - 2.0 * NAMES_EM[i] * label_mm)
}

/// A box with the space for names around it.
pub fn with_names(lines: Rect, label_mm: f64) -> Rect {
    let room = Vec2::new(NAMES_EM[0] * label_mm, NAMES_EM[1] * label_mm);
    Rect::new(lines.min - room, lines.max + room)
}

/// The scale of a polygon, and the windows of its drawings: of the whole polygon, or of each part
/// where it is split.
#[derive(Clone, Debug, PartialEq)]
pub struct Zoom {
    /// The scale of all poses (SI per mm of paper).
    pub mu: f64,
    /// The windows of each drawing.
    pub windows: Vec<Windows>,
}

/// The two windows of a drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Windows {
    /// SI per mm of the window, for the scene's own pose and for all of them; equal where one
    /// window serves both.
    pub view: [f64; 2],
    /// Centres of the two windows (SI): the middles of the vectors that they are made for.
    pub middles: [Point; 2],
    /// Half of width and height that the own window can show (SI).
    half: [f64; 2],
}

/// The ends of the vectors in a part of a pose's polygon (SI).
pub type VectorEnds<'a> = &'a dyn Fn(&Worked, usize) -> Vec<Point>;

/// A pose's polygon, or a part of it, as one drawing shows it.
struct Sight {
    /// Travel of the driver.
    travel: f64,
    /// True if the paper holds the polygon.
    held: bool,
    /// Its size (SI per mm of the box for polygons).
    size: f64,
    /// The ends of its vectors seen from the pole (SI).
    ends: Vec<Point>,
}

impl Zoom {
    /// Returns the zoom of a polygon for which `common` has a scale; `None` if there is no such
    /// polygon. Poses come with the driver's travel. `parts` gives the ends of the vectors of each
    /// part of a split polygon; `label_mm` is the type size of each drawing.
    pub fn of(
        paper: &Paper,
        poses: &[(f64, &Worked)],
        common: &SeriesScales,
        on: DiagramKind,
        boxes: Boxes,
        parts: Option<VectorEnds>,
        label_mm: &[f64],
    ) -> Option<Zoom> {
        let one = common.mu.get(on.kind())?;
        let whole = |w: &Worked| (size(w, on, &boxes).unwrap_or(0.0), ends(w, on).collect());
        let whole = Sight::list(poses, |w| common.holds(w, on), whole);
        let (own, middling) = Sight::usual(&whole)?;
        let half = OF_HALF * middling;
        let fixed = paper.scales.get(on.kind());
        let base = poses.iter().min_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?.1;
        let own_mu = || match on {
            DiagramKind::Force => base.equilibrium.as_ref().map(Equilibrium::mu),
            DiagramKind::Plane | DiagramKind::Velocity | DiagramKind::Acceleration => {
                base.construction.polygon(on).map(|p| p.mu)
            }
        };
        let usual = if own.size >= half { own_mu() } else { None };
        let usual_mu = || {
            scale::choose_in(
                paper.unit(on.kind()),
                extent(Sight::around(&whole, half).into_iter()),
                boxes.polygon,
            )
        };
        let mu = fixed.or(usual).unwrap_or_else(|| if half > 0.0 { usual_mu() } else { one });
        let windows = match parts {
            None => vec![Windows::of(&whole, label_mm[0], one)?],
            Some(ends_of) => {
                let part = |(k, label_mm): (usize, &f64)| {
                    let seen = |w: &Worked| {
                        let ends = ends_of(w, k);
                        let [width, height] = extent(ends.iter().copied().chain([Point::ORIGIN]));
                        ((width / boxes.polygon[0]).max(height / boxes.polygon[1]), ends)
                    };
                    Windows::of(&Sight::list(poses, |w| common.holds(w, on), seen), *label_mm, one)
                };
                label_mm.iter().enumerate().map(part).collect::<Option<_>>()?
            }
        };
        Some(Zoom { mu, windows })
    }
}

impl Sight {
    fn list(
        poses: &[(f64, &Worked)],
        held: impl Fn(&Worked) -> bool,
        seen: impl Fn(&Worked) -> (f64, Vec<Point>),
    ) -> Vec<Sight> {
        let of = |(travel, w): &(f64, &Worked)| {
            let (size, ends) = seen(w);
            Sight { travel: *travel, held: held(w), size, ends }
        };
        poses.iter().map(of).collect()
    }

    /// The sight of the scene's own pose, and the median size over all poses.
    fn usual(list: &[Sight]) -> Option<(&Sight, f64)> {
        let own = list.iter().min_by(|a, b| a.travel.abs().total_cmp(&b.travel.abs()))?;
        let mut sizes: Vec<f64> = list.iter().filter(|s| s.held).map(|s| s.size).collect();
        sizes.sort_by(f64::total_cmp);
        Some((own, sizes.get(sizes.len() / 2).copied().unwrap_or(0.0)))
    }

    /// The ends of all vectors that the paper holds; a polygon larger than `longest` is reduced to
    /// it about the pole.
    fn around(list: &[Sight], longest: f64) -> Vec<Point> {
        let held = list.iter().filter(|s| s.held).flat_map(|s| {
            let part = if longest.is_finite() { (longest / s.size).min(1.0) } else { 1.0 };
            s.ends.iter().map(move |p| (p.to_vec2() * part).to_point())
        });
        held.chain([Point::ORIGIN]).collect()
    }
}

impl Windows {
    /// The windows of a drawing; `one` is the scale of a window without vectors (SI/mm).
    fn of(list: &[Sight], label_mm: f64, one: f64) -> Option<Windows> {
        let (base, middling) = Sight::usual(list)?;
        let (own, least) = (base.size, WINDOW_OF_HALF * middling);
        let inner = inner_mm(label_mm);
        let needed = |points: &[Point]| {
            let [w, h] = extent(points.iter().copied());
            (w / inner[0]).max(h / inner[1])
        };
        let typical = own.max(middling);
        let all =
            Sight::around(list, if typical > 0.0 { LONGEST * typical } else { f64::INFINITY });
        let shown: Vec<Point> = if own >= least {
            base.ends.iter().copied().chain([Point::ORIGIN]).collect()
        } else {
            Sight::around(list, least)
        };
        let (turn, own) = (needed(&all), needed(&shown));
        let two = own > 0.0 && turn > GAIN * own;
        let view = match (turn > 0.0, two) {
            (false, _) => [one; 2],
            (true, false) => [turn; 2],
            (true, true) => [own, turn],
        };
        let middles = [middle(if two { &shown } else { &all }), middle(&all)];
        Some(Windows { view, middles, half: inner.map(|side| 0.5 * side * view[0]) })
    }

    /// Index of the window that shows a pose's drawing first: the own one if its vectors lie in
    /// that. Ends from the pole (SI).
    pub fn place(&self, mut ends: impl Iterator<Item = Point>) -> usize {
        let at = self.middles[0];
        let inside =
            |p: Point| (p.x - at.x).abs() <= self.half[0] && (p.y - at.y).abs() <= self.half[1];
        usize::from(self.view[0] < self.view[1] && !ends.all(inside))
    }
}

/// The middle of the box around points.
fn middle(points: &[Point]) -> Point {
    let axis = |of: fn(&Point) -> f64| {
        let (low, high) = points
            .iter()
            .map(of)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        0.5 * (low + high)
    };
    Point::new(axis(|p| p.x), axis(|p| p.y))
}

/// The pose with its diagram enlarged by a factor about the diagram's origin.
pub fn diagram(worked: &Worked, k: f64) -> Worked {
    let mut worked = worked.clone();
    let diagram = &mut worked.construction.diagram;
    diagram.mu /= k;
    diagram.spots.iter_mut().flatten().for_each(|p| *p = (p.to_vec2() * k).to_point());
    worked.equilibrium = worked.equilibrium.map(|of| of.enlarged(k));
    worked
}
