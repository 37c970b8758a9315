//! The three drawings over all frames, each on one paper for all poses.
//!
//! Decided here: the paper (what holds all poses) and the order in which labels are placed, each where it stood in the frame
//! before if it can.

use rayon::prelude::*;

use crate::construct::Polygon;
use crate::diag::Faults;
use crate::figure::course::courses;
use crate::figure::drawing::{Habits, Part};
use crate::figure::extent::Rect;
use crate::figure::mechanism::{self, Course};
use crate::figure::polygon;
use crate::figure::style::Style;
use crate::geom::{Point, Vec2};
use crate::mechanism::Level;
use crate::plan::notation::Notation;
use crate::plan::text::Writer;
use crate::scene::Lang;

use super::frames::{Frame, Frames};
use super::track::Track;

/// Around all ink of all poses.
const MARGIN_MM: f64 = 3.0;
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
    /// Width and height of its paper (mm).
    pub size_mm: [f64; 2],
    /// The diagram's origin or the pole on that paper, x to the right and y up from its lower left corner.
    pub origin: Point,
    /// Its elements over the frames.
    pub track: Track,
    /// Whether it is on the paper, in each frame.
    pub shown: Vec<bool>,
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
    wanted.into_par_iter().map(|shows| one(frames, notation, style, shows)).collect()
}

fn one(frames: &Frames, notation: &Notation, style: &Style, shows: Shows) -> Result<Scenery, Faults> {
    // Black on white: the page gives it the colours of its light or dark theme.
    let Style { palette, plate, .. } = Style::default();
    let style = Style { palette, plate, ..style.clone() };
    let poses: Vec<_> = frames.list.iter().map(|f| (&f.scene, &f.worked)).collect();
    let courses = if shows == Shows::Mechanism { courses(&poses, &style, notation) } else { Vec::new() };
    let full = frames.list.iter().any(|f| polygon_of(f, shows, notation).is_some_and(|(w, p)| polygon::is_full(&w, p)));
    let looks = Looks { notation, style, courses, full };
    let mut at_base = Habits::new();
    let first = part(frames, frames.base, &looks, shows, &mut at_base);
    // On from the scene's pose and back from it; where the turn is closed the two meet half a turn off.
    let (base, count) = (frames.base, frames.list.len());
    let (ahead, back): (Vec<usize>, Vec<usize>) = if frames.full {
        let half = count / 2;
        ((1..=half).map(|k| (base + k) % count).collect(), (1..count - half).map(|k| (base + count - k) % count).collect())
    } else {
        ((base + 1..count).collect(), (0..base).rev().collect())
    };
    let along = |way: Vec<usize>, mut habits: Habits| -> Vec<(usize, Option<Part>)> {
        way.into_iter().map(|k| (k, part(frames, k, &looks, shows, &mut habits))).collect()
    };
    let (on, before) = rayon::join(|| along(ahead, at_base.clone()), || along(back, at_base.clone()));
    let mut parts: Vec<Option<Part>> = frames.list.iter().map(|_| None).collect();
    parts[base] = first;
    on.into_iter().chain(before).for_each(|(k, part)| parts[k] = part);
    let all = parts.iter().flatten().map(|p| p.bounds).reduce(Rect::union);
    let paper = all.unwrap_or(Rect::new(Point::ORIGIN, Point::ORIGIN)).grown(MARGIN_MM);
    let shift = Point::ORIGIN - paper.min;
    let mut track = Track::new(paper.height_mm(), frames.base, frames.list.len());
    let shown = parts.iter().map(Option::is_some).collect();
    for (k, part) in parts.into_iter().enumerate() {
        let Some(mut part) = part else { continue };
        part.translate(shift);
        track.add(k, &part.items, &frames.list[k].worked.construction.chosen)?;
    }
    Ok(Scenery { shows, size_mm: [paper.width_mm(), paper.height_mm()], origin: Point::ORIGIN + shift, track, shown })
}

/// What the drawings of all frames have in common.
struct Looks<'a> {
    notation: &'a Notation,
    style: Style,
    courses: Vec<Course>,
    /// Whether the polygon has many vectors in some frame: then its type is small in all.
    full: bool,
}

/// A frame's polygon, where it is on the paper, and who writes its letters (the language does not matter).
fn polygon_of<'a>(frame: &'a Frame, shows: Shows, notation: &'a Notation) -> Option<(Writer<'a>, &'a Polygon)> {
    let Shows::Polygon(level) = shows else { return None };
    let on_paper = frame.shown[Level::RATES.iter().position(|l| *l == level)?];
    let p = frame.worked.construction.polygon(level).filter(|_| on_paper)?;
    Some((Writer { scene: &frame.scene, plan: &frame.worked.plan, notation, lang: Lang::En }, p))
}

fn part(frames: &Frames, k: usize, looks: &Looks, shows: Shows, habits: &mut Habits) -> Option<Part> {
    let frame = &frames.list[k];
    let Looks { notation, style, courses, full } = looks;
    match shows {
        Shows::Mechanism => {
            let mut part = mechanism::drawing(style, &frame.scene, &frame.worked, notation, &courses[k]).finish_after(habits);
            part.translate(stray(frames, frame));
            Some(part)
        }
        Shows::Polygon(_) => {
            let (w, p) = polygon_of(frame, shows, notation)?;
            Some(polygon::drawing(style, &w, p, *full).finish_after(habits))
        }
    }
}

/// By how much (mm) a frame's diagram must be moved to lie over that of the scene's own pose: its origin may be a point that
/// moves.
pub fn stray(frames: &Frames, frame: &Frame) -> Vec2 {
    let (here, first) = (&frame.worked.construction.diagram, &frames.list[frames.base].worked.construction.diagram);
    (here.origin - first.origin) * (1.0 / first.mu_l)
}
