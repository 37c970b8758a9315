//! The three drawings over all frames, each as it is seen through one window or two ([`super::zoom`]).
//!
//! Decided here: what fills a window, which poses it holds, and the order in which labels are placed, each where it stood in the
//! frame before if it can.

use crate::budget::here;
use rayon::prelude::*;

use crate::construct::Polygon;
use crate::diag::Faults;
use crate::figure::course::courses;
use crate::figure::mechanism::{self, Course};
use crate::figure::polygon::{self, Share};
use crate::geom::{Point, Vec2};
use crate::notation::Notation;
use crate::paper::drawing::{Drawing, Habits, Part};
use crate::paper::extent::Rect;
use crate::paper::style::Style;
use crate::plan::text::Writer;
use crate::scene::{DiagramKind, Lang};
use crate::worked::Worked;

use super::frames::{Frame, Frames};
use super::track::Track;
use super::zoom::{self, GAIN, stage_mm, window_mm, with_names};

/// Around the ink in a window.
const MARGIN_MM: f64 = 1.5;
/// How often the polygon of the own pose is made smaller for its names.
const PASSES: usize = 3;
/// A pose is seen through the own window while its ink stays in this much of its margin.
const AIR_MM: f64 = 1.0;

/// What a drawing shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shows {
    /// The diagram.
    pub on: DiagramKind,
    /// The part of a polygon that is split.
    pub part: Option<usize>,
}

impl Shows {
    /// A word for names in the page.
    pub fn key(self) -> String {
        let word = self.on.word();
        self.part.map_or_else(|| word.to_owned(), |part| format!("{word}-{}", part + 1))
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
    /// The frames in which it is drawn.
    pub held: Vec<bool>,
    /// How many times as large the window must be to hold all of it, in each frame.
    pub back: Vec<f64>,
}

/// All drawings that the scene calls for.
///
/// # Errors
/// Those of the SVG writer.
pub fn scenery(frames: &Frames, notation: &Notation, style: &Style) -> Result<Vec<Scenery>, Faults> {
    let mut wanted = vec![Shows { on: DiagramKind::Plane, part: None }];
    let drawn = |on: DiagramKind| frames.list.iter().any(|f| f.worked.construction.polygon(on).is_some());
    for on in DiagramKind::POLYGONS.into_iter().filter(|on| drawn(*on)) {
        match frames.split.of(on.kind()) {
            None => wanted.push(Shows { on, part: None }),
            Some(split) => wanted.extend((0..split.parts()).map(|part| Shows { on, part: Some(part) })),
        }
    }
    // The drawings know nothing of one another.
    let here = here();
    wanted.into_par_iter().map(|shows| here.enter(|| Studio::of(frames, notation, style, shows).scenery())).collect()
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
        let share = share_of(frames, shows);
        let is_full = |(w, p): (Writer, &Polygon)| share.map_or_else(|| polygon::is_full(&w, p), |s| polygon::is_full_share(&w, p, s));
        let full = frames.list.iter().any(|f| polygon_of(f, shows, notation).is_some_and(is_full));
        let mu = match shows.on {
            DiagramKind::Plane => frames.list[frames.base].worked.construction.diagram.mu,
            on @ (DiagramKind::Velocity | DiagramKind::Acceleration | DiagramKind::Force) => {
                frames.zoom.of(on.kind()).map_or(1.0, |z| z.mu)
            }
        };
        Studio { frames, notation, style, shows, full, mu }
    }

    fn scenery(&self) -> Result<Scenery, Faults> {
        match self.shows.on {
            DiagramKind::Plane => self.mechanism(),
            on @ (DiagramKind::Velocity | DiagramKind::Acceleration | DiagramKind::Force) => self.polygon(on, self.shows.part.unwrap_or(0)),
        }
    }

    /// The mechanism has the size of its figure in the own pose, and is smaller only where it would not be seen as a whole.
    fn mechanism(&self) -> Result<Scenery, Faults> {
        let label = self.style.label_mm;
        let lines = |k: usize, mu: f64, courses: &[Course]| self.diagram(k, mu, &courses[k]).1;
        let alone = |mu: f64| with_names(lines(self.frames.base, mu, &self.courses(mu)), label);
        let together = |mu: f64| {
            let courses = self.courses(mu);
            let here = here();
            let boxes = (0..self.frames.list.len()).into_par_iter().map(|k| here.enter(|| lines(k, mu, &courses)));
            boxes.reduce_with(Rect::union).map_or(alone(mu), |r| with_names(r, label))
        };
        let times = |box_mm: Rect, [w, h]: [f64; 2]| (size(box_mm)[0] / w).max(size(box_mm)[1] / h).max(1.0);
        // Symbols keep their size, which a first try does not know of.
        let first = self.mu * times(alone(self.mu), stage_mm(label));
        let own_mu = first * times(alone(first), stage_mm(label));
        let (own, all) = (alone(own_mu), together(own_mu));
        if times(all, size(own)) <= GAIN {
            return self.told(size(all), vec![(own_mu, all, self.parts(own_mu, all, false))]);
        }
        let first = own_mu * times(all, size(own));
        let mu = first * times(together(first), size(own));
        let seen = together(mu);
        self.told(size(own), vec![(own_mu, own, self.parts(own_mu, own, true)), (mu, seen, self.parts(mu, seen, false))])
    }

    fn polygon(&self, on: DiagramKind, part: usize) -> Result<Scenery, Faults> {
        let Some(zoom) = self.frames.zoom.of(on.kind()).map(|z| &z.windows[part]) else {
            return self.told([0.0; 2], Vec::new());
        };
        let window = window_mm(self.label_mm());
        let seen = |i: usize, mu: f64| about((zoom.middles[i].to_vec2() * (1.0 / mu)).to_point(), window);
        // The own pose is drawn a little smaller where its names would not be seen whole.
        let mut own = zoom.view[0];
        for _ in 0..PASSES {
            let Some(part) = self.part(self.frames.base, own, None, seen(0, own), &mut Habits::new()) else { break };
            let over = beyond(part.bounds, seen(0, own).centre(), window.map(|side| side + 2.0 * MARGIN_MM));
            if over <= 1.0 {
                break;
            }
            own *= over;
        }
        let layout = |i: usize, mu: f64| (mu, seen(i, mu), self.parts(mu, seen(i, mu), i == 0));
        let layouts =
            if zoom.view[0] == zoom.view[1] { vec![layout(1, own)] } else { vec![layout(0, own), layout(1, zoom.view[1].max(own))] };
        self.told(window, layouts)
    }

    fn label_mm(&self) -> f64 {
        if self.full { self.style.small_mm } else { self.style.label_mm }
    }

    /// Every frame's part at a scale, its labels in the window and where they stood in the frame before if they can: on from the
    /// scene's own pose and back from it; where the turn is closed the two meet half a turn off. With `held` no farther than
    /// the window holds it all.
    fn parts(&self, mu: f64, window: Rect, held: bool) -> Parts {
        let frames = self.frames;
        let mut at_base = Habits::new();
        let courses = self.courses(mu);
        let part = |k: usize, habits: &mut Habits| self.part(k, mu, courses.get(k), window, habits);
        let first = part(frames.base, &mut at_base);
        let (ahead, back) = ways(frames);
        let outer = window.grown(AIR_MM);
        let outer = first.as_ref().map_or(outer, |p| outer.union(p.bounds));
        let stays = |p: &Option<Part>| !held || p.as_ref().is_some_and(|p| outer.union(p.bounds) == outer);
        let along = |way: Vec<usize>, mut habits: Habits| -> Vec<(usize, Option<Part>)> {
            way.into_iter().map(|k| (k, part(k, &mut habits))).take_while(|(_, p)| stays(p)).collect()
        };
        let here = here();
        let (on, before) = rayon::join(|| here.enter(|| along(ahead, at_base.clone())), || here.enter(|| along(back, at_base.clone())));
        let mut parts: Parts = frames.list.iter().map(|_| None).collect();
        parts[frames.base] = first;
        on.into_iter().chain(before).for_each(|(k, part)| parts[k] = part);
        parts
    }

    fn courses(&self, mu: f64) -> Vec<Course> {
        if self.shows.on != DiagramKind::Plane {
            return Vec::new();
        }
        let drawn: Vec<Worked> = self.frames.list.iter().map(|f| zoom::diagram(&f.worked, self.mu / mu)).collect();
        let poses: Vec<_> = self.frames.list.iter().zip(&drawn).map(|(f, w)| (&f.scene, w)).collect();
        courses(&poses, &self.style, self.notation)
    }

    /// A frame's diagram before its labels are placed, and the box around its lines.
    fn diagram(&self, k: usize, mu: f64, course: &Course) -> (Drawing, Rect) {
        let (frame, times) = (&self.frames.list[k], self.mu / mu);
        let worked = zoom::diagram(&frame.worked, times);
        let drawing = mechanism::drawing(&self.style, &frame.scene, &worked, self.notation, course);
        let (lines, by) = (drawing.bounds(), stray(self.frames, frame) * times);
        (drawing, Rect::new(lines.min + by, lines.max + by))
    }

    fn part(&self, k: usize, mu: f64, course: Option<&Course>, window: Rect, habits: &mut Habits) -> Option<Part> {
        let frame = &self.frames.list[k];
        match self.shows.on {
            DiagramKind::Plane => {
                let by = stray(self.frames, frame) * (self.mu / mu);
                let room = Rect::new(window.min - by, window.max - by);
                let mut part = self.diagram(k, mu, course?).0.finish_within(habits, room);
                part.translate(by);
                Some(part)
            }
            DiagramKind::Velocity | DiagramKind::Acceleration | DiagramKind::Force => {
                let (w, p) = polygon_of(frame, self.shows, self.notation)?;
                let p = p.to_scale(mu);
                let drawing = match share_of(self.frames, self.shows) {
                    None => polygon::drawing(&self.style, &w, &p, self.full),
                    Some(share) => polygon::share_drawing(&self.style, &w, &p, share, self.full)?,
                };
                // What is too long for the window has room around it.
                let lines = drawing.bounds();
                let room = if window.union(lines) == window { window } else { with_names(lines, self.label_mm()).union(window) };
                Some(drawing.finish_within(habits, room))
            }
        }
    }

    /// The drawing told: its windows have one size, and what each is made for stands in its middle.
    fn told(&self, window: [f64; 2], layouts: Vec<(f64, Rect, Parts)>) -> Result<Scenery, Faults> {
        let frames = self.frames;
        let size_mm = window.map(|side| side + 2.0 * MARGIN_MM);
        let shown = layouts.last().map_or_else(|| vec![false; frames.list.len()], |l| l.2.iter().map(Option::is_some).collect());
        let plans = frames.plans();
        let mut list = Vec::new();
        for (mu, seen, parts) in layouts {
            let middle = Point::new(0.5 * size_mm[0], 0.5 * size_mm[1]);
            let shift = middle - seen.centre();
            let mut track = Track::new(size_mm[1], frames.base, frames.list.len());
            let held = parts.iter().map(Option::is_some).collect();
            let mut back = vec![1.0; parts.len()];
            for (k, part) in parts.into_iter().enumerate() {
                let Some(mut part) = part else { continue };
                part.translate(shift);
                if let Some(own) = self.shows.part {
                    // What several parts show has a name of its own in each.
                    let whole = self.shows.on.prefix();
                    part.items.iter_mut().for_each(|i| i.id = i.id.replacen(whole, &format!("{whole}-{}", own + 1), 1));
                }
                back[k] = beyond(part.bounds, middle, size_mm);
                let mut drawn = frames.list[k].worked.construction.acts.chosen.clone();
                if self.shows.on != DiagramKind::Plane {
                    drawn.push(plans[k]);
                }
                track.add(k, &part.items, &drawn)?;
            }
            list.push(Layout { mu, origin: Point::ORIGIN + shift, track, held, back });
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

/// How many times as large a window about a place must be to hold a box; 1 where it does.
fn beyond(held: Rect, at: Point, [w, h]: [f64; 2]) -> f64 {
    let over = |low: f64, high: f64, at: f64, side: f64| (high - at).max(at - low) / (0.5 * side);
    over(held.min.x, held.max.x, at.x, w).max(over(held.min.y, held.max.y, at.y, h)).max(1.0)
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
    let p = frame.worked.construction.polygon(shows.on).filter(|_| frame.shown.contains(&shows.on))?;
    Some((Writer { scene: &frame.scene, plan: &frame.worked.plan, notation, lang: Lang::En }, p))
}

/// The part of a split polygon that a drawing shows.
fn share_of(frames: &Frames, shows: Shows) -> Option<Share<'_>> {
    Some(frames.split.of(shows.on.kind())?.share(shows.part?))
}

/// By how much (mm) a frame's diagram must be moved to lie over that of the scene's own pose: its origin may be a point that
/// moves.
pub fn stray(frames: &Frames, frame: &Frame) -> Vec2 {
    let (here, first) = (&frame.worked.construction.diagram, &frames.list[frames.base].worked.construction.diagram);
    (here.origin - first.origin) * (1.0 / first.mu)
}
