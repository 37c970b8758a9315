//! The three drawings over all frames, each as it is seen through one window or two ([`super::zoom`]).
//!
//! Decided here: what fills a window, which poses it holds, and the order in which labels are placed, each where it stood in the
//! frame before if it can.

use rayon::prelude::*;

use crate::construct::Polygon;
use crate::diag::Faults;
use crate::figure::course::courses;
use crate::figure::drawing::{Habits, Part};
use crate::figure::extent::{Rect, bounds};
use crate::figure::item::{Item, Shape};
use crate::figure::mechanism::{self, Course};
use crate::figure::polygon;
use crate::figure::style::Style;
use crate::geom::{Point, Vec2};
use crate::mechanism::Level;
use crate::plan::notation::Notation;
use crate::plan::text::Writer;
use crate::scene::Lang;
use crate::worked::Worked;

use super::frames::{Frame, Frames};
use super::track::Track;
use super::zoom::{self, GAIN, window_mm};

/// Around the ink in a window.
const MARGIN_MM: f64 = 1.5;
/// A pose is seen through the own window while its ink stays in this much of its margin.
const AIR_MM: f64 = 1.0;
/// A window is full when the ink takes this part of its width or height.
const FILLED: f64 = 0.96;
/// How often a drawing is made larger or smaller until it fills its window.
const PASSES: usize = 3;

/// What a drawing shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shows {
    /// The mechanism.
    Mechanism,
    /// A polygon.
    Polygon(Level),
}

impl Shows {
    /// A word for names in the page.
    pub fn key(self) -> &'static str {
        match self {
            Shows::Mechanism => "mechanism",
            Shows::Polygon(Level::Acceleration) => "acceleration",
            Shows::Polygon(_) => "velocity",
        }
    }
}

/// A drawing over all frames.
pub struct Scenery {
    /// What it shows.
    pub shows: Shows,
    /// Width and height of its windows (mm of the window).
    pub size_mm: [f64; 2],
    /// Its scale (SI per mm of paper).
    pub mu: f64,
    /// What is seen through the window that the scene's own pose fills, in the poses near it; then through the one that holds all
    /// poses, in all. One alone where that serves both.
    pub layouts: Vec<Layout>,
    /// Whether it is on the paper, in each frame.
    pub shown: Vec<bool>,
}

/// A drawing as it is seen through one window.
pub struct Layout {
    /// SI per mm of the window.
    pub mu: f64,
    /// The diagram's origin or the pole in the window, x to the right and y up from its lower left corner.
    pub origin: Point,
    /// Its elements over the frames.
    pub track: Track,
    /// The frames in which the window holds it.
    pub held: Vec<bool>,
}

/// All drawings that the scene calls for.
///
/// # Errors
/// Those of the SVG writer.
pub fn scenery(frames: &Frames, notation: &Notation, style: &Style) -> Result<Vec<Scenery>, Faults> {
    let mut wanted = vec![Shows::Mechanism];
    let drawn = |level: Level| frames.list.iter().any(|f| f.worked.construction.polygon(level).is_some());
    wanted.extend(Level::RATES.into_iter().filter(|l| drawn(*l)).map(Shows::Polygon));
    // The drawings know nothing of one another.
    wanted.into_par_iter().map(|shows| Studio::of(frames, notation, style, shows).scenery()).collect()
}

/// The parts of all frames in which something is drawn.
type Parts = Vec<Option<Part>>;

/// Where one drawing is made.
struct Studio<'a> {
    frames: &'a Frames,
    notation: &'a Notation,
    style: Style,
    shows: Shows,
    /// Whether the polygon has many vectors in some frame: then its type is small in all.
    full: bool,
    /// The scale on paper.
    mu: f64,
}

impl<'a> Studio<'a> {
    fn of(frames: &'a Frames, notation: &'a Notation, style: &Style, shows: Shows) -> Studio<'a> {
        // Black on white: the page gives it the colours of its light or dark theme.
        let Style { palette, plate, .. } = Style::default();
        let style = Style { palette, plate, ..style.clone() };
        let full = frames.list.iter().any(|f| polygon_of(f, shows, notation).is_some_and(|(w, p)| polygon::is_full(&w, p)));
        let mu = match shows {
            Shows::Mechanism => frames.list[frames.base].worked.construction.diagram.mu_l,
            Shows::Polygon(level) => frames.zoom[usize::from(level == Level::Acceleration)].as_ref().map_or(1.0, |z| z.mu),
        };
        Studio { frames, notation, style, shows, full, mu }
    }

    fn scenery(&self) -> Result<Scenery, Faults> {
        match self.shows {
            Shows::Mechanism => self.mechanism(),
            Shows::Polygon(level) => self.polygon(level),
        }
    }

    /// The mechanism has the size of its figure in the own pose, and is smaller only where it would not be seen as a whole.
    fn mechanism(&self) -> Result<Scenery, Faults> {
        let parts = self.parts(self.mu);
        let (own, all) = (ink(&parts[self.frames.base..=self.frames.base]), ink(&parts));
        let [w, h] = size(own);
        let times = (size(all)[0] / w).max(size(all)[1] / h);
        if times <= GAIN {
            return self.told(size(all), vec![(self.mu, all, parts)]);
        }
        let near = self.around_base(parts, own.grown(AIR_MM));
        let (mu, wide) = self.fitted(self.mu * times, size(own), |parts| extents(parts, |i| !i.class.contains("label")));
        self.told(size(own), vec![(self.mu, own, near), (mu, ink(&wide), wide)])
    }

    fn polygon(&self, level: Level) -> Result<Scenery, Faults> {
        let view = self.frames.zoom[usize::from(level == Level::Acceleration)].as_ref().map_or([self.mu; 2], |z| z.view);
        let label = if self.full { self.style.small_mm } else { self.style.label_mm };
        let window = window_mm(label);
        let vectors = |parts: &Parts| extents(parts, |i| matches!(i.shape, Shape::Arrow { .. } | Shape::Line { .. }));
        let (wide_mu, wide) = self.fitted(view[1], window, vectors);
        let base = self.frames.base;
        let mut own_mu = view[0];
        if view[0] < view[1] {
            for _ in 0..PASSES {
                let alone: Parts = vec![self.part(base, own_mu, &mut Habits::new())];
                let Some(next) = refitted(own_mu, &alone, window, vectors) else { break };
                own_mu = next;
            }
        }
        if wide_mu < GAIN * own_mu {
            return self.told(window, vec![(wide_mu, ink(&wide), wide)]);
        }
        let own = self.parts(own_mu);
        let seen = ink(&own[base..=base]);
        let near = self.around_base(own, about(seen.centre(), window).grown(AIR_MM));
        self.told(window, vec![(own_mu, seen, near), (wide_mu, ink(&wide), wide)])
    }

    /// All frames in a window of this size, and the scale at which they fill it.
    fn fitted(&self, first: f64, window: [f64; 2], measured: impl Fn(&Parts) -> [f64; 2]) -> (f64, Parts) {
        let mut mu = first;
        let mut parts = self.parts(mu);
        for _ in 1..PASSES {
            let Some(next) = refitted(mu, &parts, window, &measured) else { break };
            mu = next;
            parts = self.parts(mu);
        }
        (mu, parts)
    }

    /// The parts next to the scene's own pose that a window holds without a break.
    fn around_base(&self, mut parts: Parts, window: Rect) -> Parts {
        let (ahead, back) = ways(self.frames);
        for way in [ahead, back] {
            let mut inside = true;
            for k in way {
                let held = |p: &Part| window.union(p.bounds) == window;
                inside &= parts[k].as_ref().is_some_and(held);
                if !inside {
                    parts[k] = None;
                }
            }
        }
        parts
    }

    /// Every frame's part at a scale, its labels where they stood in the frame before if they can: on from the scene's own pose and
    /// back from it; where the turn is closed the two meet half a turn off.
    fn parts(&self, mu: f64) -> Parts {
        let frames = self.frames;
        let mut at_base = Habits::new();
        let courses = self.courses(mu);
        let part = |k: usize, habits: &mut Habits| self.part_on(k, mu, courses.get(k), habits);
        let first = part(frames.base, &mut at_base);
        let (ahead, back) = ways(frames);
        let along = |way: Vec<usize>, mut habits: Habits| -> Vec<(usize, Option<Part>)> {
            way.into_iter().map(|k| (k, part(k, &mut habits))).collect()
        };
        let (on, before) = rayon::join(|| along(ahead, at_base.clone()), || along(back, at_base.clone()));
        let mut parts: Parts = frames.list.iter().map(|_| None).collect();
        parts[frames.base] = first;
        on.into_iter().chain(before).for_each(|(k, part)| parts[k] = part);
        parts
    }

    fn courses(&self, mu: f64) -> Vec<Course> {
        if self.shows != Shows::Mechanism {
            return Vec::new();
        }
        let drawn: Vec<Worked> = self.frames.list.iter().map(|f| zoom::diagram(&f.worked, self.mu / mu)).collect();
        let poses: Vec<_> = self.frames.list.iter().zip(&drawn).map(|(f, w)| (&f.scene, w)).collect();
        courses(&poses, &self.style, self.notation)
    }

    fn part(&self, k: usize, mu: f64, habits: &mut Habits) -> Option<Part> {
        self.part_on(k, mu, None, habits)
    }

    fn part_on(&self, k: usize, mu: f64, course: Option<&Course>, habits: &mut Habits) -> Option<Part> {
        let frame = &self.frames.list[k];
        match self.shows {
            Shows::Mechanism => {
                let times = self.mu / mu;
                let worked = zoom::diagram(&frame.worked, times);
                let mut part = mechanism::drawing(&self.style, &frame.scene, &worked, self.notation, course?).finish_after(habits);
                part.translate(stray(self.frames, frame) * times);
                Some(part)
            }
            Shows::Polygon(_) => {
                let (w, p) = polygon_of(frame, self.shows, self.notation)?;
                Some(polygon::drawing(&self.style, &w, &zoom::polygon(p, mu), self.full).finish_after(habits))
            }
        }
    }

    /// The drawing told: its windows have one size, and the ink that each is made for stands in its middle.
    fn told(&self, window: [f64; 2], layouts: Vec<(f64, Rect, Parts)>) -> Result<Scenery, Faults> {
        let frames = self.frames;
        let largest = |i: usize| layouts.iter().map(|l| size(l.1)[i]).fold(window[i], f64::max) + 2.0 * MARGIN_MM;
        let size_mm = [largest(0), largest(1)];
        let shown = layouts.last().map_or_else(Vec::new, |l| l.2.iter().map(Option::is_some).collect());
        let mut list = Vec::new();
        for (mu, seen, parts) in layouts {
            let shift = Point::new(0.5 * size_mm[0], 0.5 * size_mm[1]) - seen.centre();
            let mut track = Track::new(size_mm[1], frames.base, frames.list.len());
            let held = parts.iter().map(Option::is_some).collect();
            for (k, part) in parts.into_iter().enumerate() {
                let Some(mut part) = part else { continue };
                part.translate(shift);
                track.add(k, &part.items, &frames.list[k].worked.construction.chosen)?;
            }
            list.push(Layout { mu, origin: Point::ORIGIN + shift, track, held });
        }
        Ok(Scenery { shows: self.shows, size_mm, mu: self.mu, layouts: list, shown })
    }
}

/// The frames after the scene's own pose, and those before it.
fn ways(frames: &Frames) -> (Vec<usize>, Vec<usize>) {
    let (base, count) = (frames.base, frames.list.len());
    if frames.full {
        let half = count / 2;
        ((1..=half).map(|k| (base + k) % count).collect(), (1..count - half).map(|k| (base + count - k) % count).collect())
    } else {
        ((base + 1..count).collect(), (0..base).rev().collect())
    }
}

/// The scale at which parts drawn to another would fill a window; `None` where they do. Names around the vectors keep their size.
fn refitted(mu: f64, parts: &Parts, window: [f64; 2], measured: impl Fn(&Parts) -> [f64; 2]) -> Option<f64> {
    let (seen, lines) = (size(ink(parts)), measured(parts));
    let over = (seen[0] / window[0]).max(seen[1] / window[1]);
    if lines == [0.0; 2] || (FILLED..=1.0 + 1e-9).contains(&over) {
        return None;
    }
    let times = |i: usize| {
        let room = (window[i] - (seen[i] - lines[i])).max(0.3 * window[i]);
        if lines[i] > 0.0 { room / lines[i] } else { f64::INFINITY }
    };
    Some(mu / times(0).min(times(1)))
}

/// The box around all ink of all parts; around nothing where there is none.
fn ink(parts: &[Option<Part>]) -> Rect {
    parts.iter().flatten().map(|p| p.bounds).reduce(Rect::union).unwrap_or(Rect::new(Point::ORIGIN, Point::ORIGIN))
}

/// Width and height of the box around some items of all parts.
fn extents(parts: &Parts, of: impl Fn(&Item) -> bool) -> [f64; 2] {
    let boxes = parts.iter().flatten().flat_map(|p| p.items.iter().filter(|i| of(i)).filter_map(|i| bounds(std::slice::from_ref(i))));
    boxes.reduce(Rect::union).map_or([0.0; 2], size)
}

fn size(r: Rect) -> [f64; 2] {
    [r.width_mm(), r.height_mm()]
}

/// A box of this size about a point.
fn about(centre: Point, [w, h]: [f64; 2]) -> Rect {
    let half = Vec2::new(0.5 * w, 0.5 * h);
    Rect::new(centre - half, centre + half)
}

/// A frame's polygon, where it is on the paper, and who writes its letters (the language does not matter).
fn polygon_of<'a>(frame: &'a Frame, shows: Shows, notation: &'a Notation) -> Option<(Writer<'a>, &'a Polygon)> {
    let Shows::Polygon(level) = shows else { return None };
    let on_paper = frame.shown[Level::RATES.iter().position(|l| *l == level)?];
    let p = frame.worked.construction.polygon(level).filter(|_| on_paper)?;
    Some((Writer { scene: &frame.scene, plan: &frame.worked.plan, notation, lang: Lang::En }, p))
}

/// By how much (mm) a frame's diagram must be moved to lie over that of the scene's own pose: its origin may be a point that
/// moves.
pub fn stray(frames: &Frames, frame: &Frame) -> Vec2 {
    let (here, first) = (&frame.worked.construction.diagram, &frames.list[frames.base].worked.construction.diagram);
    (here.origin - first.origin) * (1.0 / first.mu_l)
}
