//! The drawings over all frames, each seen through one or two windows ([`super::zoom`]).
//!
//! This module decides what fills a window, which poses a window holds, and the order in which
//! labels are placed; a label keeps its place of the frame before if it can.

use crate::budget::here;
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::construct::Polygon;
use crate::diag::Faults;
use crate::figure::course::courses;
use crate::figure::forces;
use crate::figure::mechanism::{self, SeriesFeatures};
use crate::figure::polygon::{self, Share};
use crate::figure::sheet::SheetOptions;
use crate::geom::{Point, Vec2};
use crate::notation::Notation;
use crate::paper::drawing::{Drawing, DrawingPart, Habits};
use crate::paper::extent::Rect;
use crate::paper::style::Style;
use crate::plan::text::PlanWriter;
use crate::scene::{DiagramKind, Lang};
use crate::worked::Worked;

use super::frames::{Frames, SolvedFrame};
use super::track::DrawingTrack;
use super::zoom::{self, GAIN, stage_mm, window_mm, with_names};

/// Largest magnification of the free bodies relative to the mechanism, and largest reduction.
const NEAREST: f64 = 3.0;
const FARTHEST: f64 = 1.5;
/// Margin around the drawing in a window.
const MARGIN_MM: f64 = 1.5;
/// Number of times that the polygon of the own pose is reduced to make space for its names.
const PASSES: usize = 3;
/// A pose is seen through the own window while its drawing exceeds the window by no more than this.
const AIR_MM: f64 = 1.0;

/// The content of a drawing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shows {
    /// The diagram.
    pub on: DiagramKind,
    /// The part of a split polygon; for forces the group.
    pub part: Option<usize>,
}

impl Shows {
    /// The key of the drawing in names on the page.
    pub fn key(self) -> String {
        let word = self.on.word();
        self.part.map_or_else(|| word.to_owned(), |part| format!("{word}-{}", part + 1))
    }

    /// The index of its list of steps on the page: for a polygon its place among the polygons, for
    /// a group of forces a place after those.
    pub fn level(self) -> Option<usize> {
        let of_forces = |group| DiagramKind::POLYGONS.len() + group;
        DiagramKind::POLYGONS.iter().position(|on| *on == self.on).or(self.part.map(of_forces))
    }
}

/// A drawing over all frames.
pub struct Scenery {
    /// The content.
    pub shows: Shows,
    /// Width and height of its windows (mm of the window).
    pub size_mm: [f64; 2],
    /// Its scale (SI per mm of paper).
    pub mu: f64,
    /// The drawing through the window that the scene's own pose fills, in the poses near it, then
    /// through the window that holds all poses; a single layout where one window serves both. For
    /// the mechanism, then one layout for the free bodies of each group with drawn forces.
    pub layouts: Vec<WindowLayout>,
    /// True in each frame in which the drawing is on the paper.
    pub shown: Vec<bool>,
}

/// A drawing seen through one window.
pub struct WindowLayout {
    /// SI per mm of the window.
    pub mu: f64,
    /// The place in the window of the diagram's origin or of the pole, x to the right and y up from
    /// the lower left corner.
    pub origin: Point,
    /// Its elements over the frames.
    pub track: DrawingTrack,
    /// The frames in which it is drawn.
    pub held: Vec<bool>,
    /// The magnification of the window that is needed to hold the whole drawing, in each frame.
    pub back: Vec<f64>,
    /// The group with its free bodies shown in the mechanism, if any.
    pub group: Option<usize>,
}

/// A view of a drawing over all frames.
struct DrawingView {
    mu: f64,
    seen: Rect,
    parts: FrameParts,
    group: Option<usize>,
}

/// Draws all drawings that the scene calls for.
///
/// # Errors
/// Those of the SVG writer.
pub fn scenery(
    frames: &Frames,
    notation: &Notation,
    style: &Style,
) -> Result<Vec<Scenery>, Faults> {
    let mut wanted = vec![Shows { on: DiagramKind::Plane, part: None }];
    let drawn =
        |on: DiagramKind| frames.list.iter().any(|f| f.worked.construction.polygon(on).is_some());
    for on in DiagramKind::POLYGONS.into_iter().filter(|on| drawn(*on)) {
        match frames.split.of(on.kind()) {
            None => wanted.push(Shows { on, part: None }),
            Some(split) => {
                wanted.extend((0..split.parts()).map(|part| Shows { on, part: Some(part) }))
            }
        }
    }
    wanted.extend(
        (0..frames.groups.len()).map(|group| Shows { on: DiagramKind::Force, part: Some(group) }),
    );
    // The drawings are independent of one another.
    let here = here();
    wanted
        .into_par_iter()
        .map(|shows| here.enter(|| Studio::of(frames, notation, style, shows).scenery()))
        .collect()
}

/// The parts of all frames; `None` where nothing is drawn.
type FrameParts = Vec<Option<DrawingPart>>;

/// The maker of one drawing.
struct Studio<'a> {
    frames: &'a Frames,
    notation: &'a Notation,
    /// The letters do not depend on the language.
    options: SheetOptions,
    shows: Shows,
    /// True if the polygon has many vectors in some frame: its type is then small in all frames.
    full: bool,
    /// The scale on paper.
    mu: f64,
    /// The courses of all frames at each scale so far.
    courses: Mutex<Vec<(f64, Arc<[SeriesFeatures]>)>>,
    /// The diagrams of frames that were measured at the last scale and wait for their labels.
    measured: Mutex<(f64, MeasuredDiagrams)>,
}

/// Diagrams before their labels are placed, each with the box around its lines, by frame.
type MeasuredDiagrams = HashMap<usize, (Drawing, Rect)>;

impl<'a> Studio<'a> {
    fn of(frames: &'a Frames, notation: &'a Notation, style: &Style, shows: Shows) -> Studio<'a> {
        // Black on white: the page applies the colours of its light or dark theme.
        let Style { palette, plate, .. } = Style::default();
        let mut style = Style { palette, plate, ..style.clone() };
        // The numbers of teeth are read from the last row, too.
        if shows.on == DiagramKind::Plane {
            style.small_mm = style.label_mm;
        }
        let share = share_of(frames, shows);
        let is_full = |(w, p): (PlanWriter, &Polygon)| {
            share.map_or_else(|| polygon::is_full(&w, p), |s| polygon::is_full_share(&w, p, s))
        };
        let full = frames.list.iter().any(|f| polygon_of(f, shows, notation).is_some_and(is_full));
        let mu = match shows.on {
            DiagramKind::Plane => frames.list[frames.base].worked.construction.diagram.mu,
            on @ (DiagramKind::Velocity | DiagramKind::Acceleration | DiagramKind::Force) => {
                frames.zoom.of(on.kind()).map_or(1.0, |z| z.mu)
            }
        };
        let options = SheetOptions {
            notation: notation.clone(),
            style,
            ..SheetOptions::of_language(Lang::En)
        };
        let (courses, measured) = Default::default();
        Studio { frames, notation, options, shows, full, mu, courses, measured }
    }

    fn scenery(&self) -> Result<Scenery, Faults> {
        match self.shows.on {
            DiagramKind::Plane => self.mechanism(),
            on @ (DiagramKind::Velocity | DiagramKind::Acceleration | DiagramKind::Force) => {
                self.polygon(on, self.shows.part.unwrap_or(0))
            }
        }
    }

    /// Draws the mechanism in the size of its figure in the own pose, smaller only where it would
    /// not be seen as a whole.
    fn mechanism(&self) -> Result<Scenery, Faults> {
        let label = self.options.style.label_mm;
        let lines = |k: usize, mu: f64, courses: &[SeriesFeatures]| self.lines(k, mu, &courses[k]);
        let alone = |mu: f64| with_names(lines(self.frames.base, mu, &self.courses(mu)), label);
        let together = |mu: f64| {
            let courses = self.courses(mu);
            let here = here();
            let boxes = (0..self.frames.list.len())
                .into_par_iter()
                .map(|k| here.enter(|| lines(k, mu, &courses)));
            boxes.reduce_with(Rect::union).map_or(alone(mu), |r| with_names(r, label))
        };
        let times = |box_mm: Rect, [w, h]: [f64; 2]| {
            (size(box_mm)[0] / w).max(size(box_mm)[1] / h).max(1.0)
        };
        // Symbols keep their size, which the first estimate of the scale does not take into
        // account.
        let first = self.mu * times(alone(self.mu), stage_mm(label));
        let own_mu = first * times(alone(first), stage_mm(label));
        let (own, all) = (alone(own_mu), together(own_mu));
        if times(all, size(own)) <= GAIN {
            // One window for all poses, no larger than the stage.
            let mu = own_mu * times(all, stage_mm(label));
            let seen = if mu > own_mu { together(mu) } else { all };
            let parts = self.parts(mu, seen, false);
            let view = DrawingView { mu, seen, parts, group: None };
            return self.told(size(seen), self.with_groups(vec![view], mu, size(seen)));
        }
        let first = own_mu * times(all, size(own));
        let mu = first * times(together(first), size(own));
        let seen = together(mu);
        let near = DrawingView {
            mu: own_mu,
            seen: own,
            parts: self.parts(own_mu, own, true),
            group: None,
        };
        let whole = DrawingView { mu, seen, parts: self.parts(mu, seen, false), group: None };
        self.told(size(own), self.with_groups(vec![near, whole], own_mu, size(own)))
    }

    /// Adds the free bodies of each group, as large as the window can hold them in all frames.
    fn with_groups(
        &self,
        mut views: Vec<DrawingView>,
        own_mu: f64,
        [w, h]: [f64; 2],
    ) -> Vec<DrawingView> {
        let frames = &self.frames.list;
        for group in 0..self.frames.groups.len() {
            let around = |mu: f64| {
                let here = here();
                let boxes = (0..frames.len())
                    .into_par_iter()
                    .filter_map(|k| here.enter(|| Some(self.bodies(k, group, mu)?.1)));
                boxes.reduce_with(Rect::union).map(|r| with_names(r, self.options.style.label_mm))
            };
            let mut mu = own_mu;
            // Arrows keep their length, so the box grows less than the scale.
            for _ in 0..PASSES {
                let Some([wide, high]) = around(mu).map(size) else { break };
                mu = (mu * (wide / w).max(high / h)).max(own_mu / NEAREST).min(own_mu * FARTHEST);
            }
            let Some(lines) = around(mu) else { continue };
            let seen = about(lines.centre(), [w, h]);
            let courses = self.courses(mu);
            let parts = self.over_frames(seen, false, |k, habits| {
                self.freed(k, group, (mu, &courses[k]), seen, habits)
            });
            views.push(DrawingView { mu, seen, parts, group: Some(group) });
        }
        views
    }

    /// The free bodies of a group in a frame before their labels are placed, the box around their
    /// lines, and the displacement that brings them over the own pose.
    fn bodies(&self, k: usize, group: usize, mu: f64) -> Option<(Drawing, Rect, Vec2)> {
        let frame = &self.frames.list[k];
        if !frame.shown.contains(&DiagramKind::Force) {
            return None;
        }
        let worked = zoom::diagram(&frame.worked, self.mu / mu);
        let by = stray(self.frames, frame) * (self.mu / mu);
        let drawing =
            forces::free_bodies(&frame.scene, &worked, &self.options, &self.frames.groups[group])?;
        let lines = drawing.bounds();
        Some((drawing, Rect::new(lines.min + by, lines.max + by), by))
    }

    /// The free bodies of a group over the mechanism without its letters.
    fn freed(
        &self,
        k: usize,
        group: usize,
        (mu, course): (f64, &SeriesFeatures),
        seen: Rect,
        habits: &mut Habits,
    ) -> Option<DrawingPart> {
        let (drawing, lines, by) = self.bodies(k, group, mu)?;
        let room = with_names(lines, self.options.style.label_mm).union(seen);
        let mut part = drawing.finish_within(habits, Rect::new(room.min - by, room.max - by));
        let mut behind = self.diagram(k, mu, course).0;
        behind.only_named(|_| false);
        let mut items = behind.finish().items;
        items.iter_mut().for_each(|i| i.class.push_str(" behind"));
        for mut item in std::mem::take(&mut part.items) {
            item.id = format!("group-{}-{}", group + 1, item.id);
            items.push(item);
        }
        part.items = items;
        part.translate(by);
        Some(part)
    }

    fn polygon(&self, on: DiagramKind, part: usize) -> Result<Scenery, Faults> {
        let Some(zoom) = self.frames.zoom.of(on.kind()).map(|z| &z.windows[part]) else {
            return self.told([0.0; 2], Vec::new());
        };
        let window = window_mm(self.label_mm());
        let seen =
            |i: usize, mu: f64| about((zoom.middles[i].to_vec2() * (1.0 / mu)).to_point(), window);
        // The own pose is drawn slightly smaller where its names would be cut off.
        let mut own = zoom.view[0];
        for _ in 0..PASSES {
            let Some(part) =
                self.part(self.frames.base, own, None, seen(0, own), &mut Habits::new())
            else {
                break;
            };
            let over = beyond(
                part.bounds,
                seen(0, own).centre(),
                window.map(|side| side + 2.0 * MARGIN_MM),
            );
            if over <= 1.0 {
                break;
            }
            own *= over;
        }
        let layout = |i: usize, mu: f64| DrawingView {
            mu,
            seen: seen(i, mu),
            parts: self.parts(mu, seen(i, mu), i == 0),
            group: None,
        };
        let layouts = if zoom.view[0] == zoom.view[1] {
            vec![layout(1, own)]
        } else {
            vec![layout(0, own), layout(1, zoom.view[1].max(own))]
        };
        self.told(window, layouts)
    }

    fn label_mm(&self) -> f64 {
        if self.full { self.options.style.small_mm } else { self.options.style.label_mm }
    }

    /// Every frame's part at a scale, with its labels in the window and, if possible, at their
    /// places in the frame before. The order runs forward and backward from the scene's own pose;
    /// in a closed turn the two meet half a turn away. With `held`, each direction ends where the
    /// window does not hold the whole part.
    fn parts(&self, mu: f64, window: Rect, held: bool) -> FrameParts {
        let courses = self.courses(mu);
        self.over_frames(window, held, |k, habits| self.part(k, mu, courses.get(k), window, habits))
    }

    fn over_frames(
        &self,
        window: Rect,
        held: bool,
        part: impl Fn(usize, &mut Habits) -> Option<DrawingPart> + Sync,
    ) -> FrameParts {
        let frames = self.frames;
        let mut at_base = Habits::new();
        let first = part(frames.base, &mut at_base);
        let (ahead, back) = ways(frames);
        let outer = window.grown(AIR_MM);
        let outer = first.as_ref().map_or(outer, |p| outer.union(p.bounds));
        let stays = |p: &Option<DrawingPart>| {
            !held || p.as_ref().is_some_and(|p| outer.union(p.bounds) == outer)
        };
        let along = |way: Vec<usize>, mut habits: Habits| -> Vec<(usize, Option<DrawingPart>)> {
            way.into_iter()
                .map(|k| (k, part(k, &mut habits)))
                .take_while(|(_, p)| stays(p))
                .collect()
        };
        let here = here();
        let (on, before) = rayon::join(
            || here.enter(|| along(ahead, at_base.clone())),
            || here.enter(|| along(back, at_base.clone())),
        );
        let mut parts: FrameParts = frames.list.iter().map(|_| None).collect();
        parts[frames.base] = first;
        on.into_iter().chain(before).for_each(|(k, part)| parts[k] = part);
        parts
    }

    fn courses(&self, mu: f64) -> Arc<[SeriesFeatures]> {
        if self.shows.on != DiagramKind::Plane {
            return Arc::default();
        }
        if let Some((_, known)) = locked(&self.courses).iter().find(|(at, _)| *at == mu) {
            return known.clone();
        }
        let drawn: Vec<Worked> =
            self.frames.list.iter().map(|f| zoom::diagram(&f.worked, self.mu / mu)).collect();
        let poses: Vec<_> =
            self.frames.list.iter().zip(&drawn).map(|(f, w)| (&f.scene, w)).collect();
        let made: Arc<[SeriesFeatures]> =
            courses(&poses, &self.options.style, self.notation).into();
        locked(&self.courses).push((mu, made.clone()));
        made
    }

    /// Returns the box around the lines of a frame's diagram, and keeps the diagram until its labels
    /// are placed or another scale is measured.
    fn lines(&self, k: usize, mu: f64, course: &SeriesFeatures) -> Rect {
        let diagram = self.diagram(k, mu, course);
        let lines = diagram.1;
        let mut measured = locked(&self.measured);
        if measured.0 != mu {
            *measured = (mu, HashMap::new());
        }
        measured.1.insert(k, diagram);
        lines
    }

    /// Takes a frame's diagram at a scale, if it has been measured.
    fn taken(&self, k: usize, mu: f64) -> Option<(Drawing, Rect)> {
        let mut measured = locked(&self.measured);
        if measured.0 == mu { measured.1.remove(&k) } else { None }
    }

    /// A frame's diagram before its labels are placed, and the box around its lines.
    fn diagram(&self, k: usize, mu: f64, course: &SeriesFeatures) -> (Drawing, Rect) {
        if let Some(diagram) = self.taken(k, mu) {
            return diagram;
        }
        let (frame, times) = (&self.frames.list[k], self.mu / mu);
        let worked = zoom::diagram(&frame.worked, times);
        let mut drawing =
            mechanism::drawing(&self.options.style, &frame.scene, &worked, self.notation, course);
        forces::given_loads(&frame.scene, &worked, &self.options, &mut drawing);
        let (lines, by) = (drawing.bounds(), stray(self.frames, frame) * times);
        (drawing, Rect::new(lines.min + by, lines.max + by))
    }

    fn part(
        &self,
        k: usize,
        mu: f64,
        course: Option<&SeriesFeatures>,
        window: Rect,
        habits: &mut Habits,
    ) -> Option<DrawingPart> {
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
                let drawing = self.polygon_at(frame, mu)?;
                // Lines too long for the window get a margin.
                let lines = drawing.bounds();
                let room = if window.union(lines) == window {
                    window
                } else {
                    with_names(lines, self.label_mm()).union(window)
                };
                Some(drawing.finish_within(habits, room))
            }
        }
    }

    /// A frame's polygon to a scale, before its labels are placed.
    fn polygon_at(&self, frame: &SolvedFrame, mu: f64) -> Option<Drawing> {
        if self.shows.on == DiagramKind::Force {
            let links = self.frames.groups.get(self.shows.part?)?;
            let of = frame
                .worked
                .equilibrium
                .as_ref()
                .filter(|_| frame.shown.contains(&DiagramKind::Force))?;
            let worked = Worked { equilibrium: Some(of.to_scale(mu)), ..frame.worked.clone() };
            return forces::polygon(&frame.scene, &worked, &self.options, links);
        }
        let (w, p) = polygon_of(frame, self.shows, self.notation)?;
        let p = p.to_scale(mu);
        match share_of(self.frames, self.shows) {
            None => Some(polygon::drawing(&self.options.style, &w, &p, self.full)),
            Some(share) => polygon::share_drawing(&self.options.style, &w, &p, share, self.full),
        }
    }

    /// The finished drawing: its windows have one size, and the contents of each are centred.
    fn told(&self, window: [f64; 2], views: Vec<DrawingView>) -> Result<Scenery, Faults> {
        let frames = self.frames;
        let size_mm = window.map(|side| side + 2.0 * MARGIN_MM);
        let whole = views.iter().rfind(|v| v.group.is_none());
        let shown = whole.map_or_else(
            || vec![false; frames.list.len()],
            |v| v.parts.iter().map(Option::is_some).collect(),
        );
        let (plans, force_plans) = (frames.plans(), frames.force_plans());
        let mut list = Vec::new();
        for DrawingView { mu, seen, parts, group } in views {
            let middle = Point::new(0.5 * size_mm[0], 0.5 * size_mm[1]);
            let shift = middle - seen.centre();
            let mut track = DrawingTrack::new(size_mm[1], frames.base, frames.list.len());
            let held = parts.iter().map(Option::is_some).collect();
            let mut back = vec![1.0; parts.len()];
            for (k, part) in parts.into_iter().enumerate() {
                let Some(mut part) = part else { continue };
                part.translate(shift);
                if let Some(own) = self.shows.part {
                    // An item that several parts show has a name of its own in each.
                    let whole = self.shows.on.prefix();
                    part.items.iter_mut().for_each(|i| {
                        i.id = i.id.replacen(whole, &format!("{whole}-{}", own + 1), 1)
                    });
                }
                back[k] = beyond(part.bounds, middle, size_mm);
                let mut drawn = frames.list[k].worked.construction.acts.chosen.clone();
                match self.shows.on {
                    DiagramKind::Plane if group.is_none() => {}
                    DiagramKind::Velocity | DiagramKind::Acceleration => drawn.push(plans[k]),
                    DiagramKind::Plane | DiagramKind::Force => drawn.push(force_plans[k]),
                }
                track.add(k, &part.items, &drawn)?;
            }
            list.push(WindowLayout { mu, origin: Point::ORIGIN + shift, track, held, back, group });
        }
        Ok(Scenery { shows: self.shows, size_mm, mu: self.mu, layouts: list, shown })
    }
}

/// Locks a value; one that a panicking thread has left is used as it is.
fn locked<T>(of: &Mutex<T>) -> MutexGuard<'_, T> {
    of.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The frames after the scene's own pose, and those before it.
fn ways(frames: &Frames) -> (Vec<usize>, Vec<usize>) {
    let (base, count) = (frames.base, frames.list.len());
    if frames.full {
        let half = count / 2;
        (
            (1..=half).map(|k| (base + k) % count).collect(),
            (1..count - half).map(|k| (base + count - k) % count).collect(),
        )
    } else {
        ((base + 1..count).collect(), (0..base).rev().collect())
    }
}

/// The magnification that a window about a place needs to hold a box; 1 where the window holds it.
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

/// A frame's polygon, if it is on the paper, and the writer of its letters (independent of the
/// language).
fn polygon_of<'a>(
    frame: &'a SolvedFrame,
    shows: Shows,
    notation: &'a Notation,
) -> Option<(PlanWriter<'a>, &'a Polygon)> {
    let p =
        frame.worked.construction.polygon(shows.on).filter(|_| frame.shown.contains(&shows.on))?;
    Some((
        PlanWriter { scene: &frame.scene, plan: &frame.worked.plan, notation, lang: Lang::En },
        p,
    ))
}

/// The part of a split polygon that a drawing shows.
fn share_of(frames: &Frames, shows: Shows) -> Option<Share<'_>> {
    Some(frames.split.of(shows.on.kind())?.share(shows.part?))
}

/// Displacement (mm) that brings a frame's diagram over that of the scene's own pose: the origin of
/// the diagram may be a moving point.
pub fn stray(frames: &Frames, frame: &SolvedFrame) -> Vec2 {
    let (here, first) =
        (&frame.worked.construction.diagram, &frames.list[frames.base].worked.construction.diagram);
    (here.origin - first.origin) * (1.0 / first.mu)
}
