//! Proof of a configuration against the statements of the scene: lengths, coordinates, sides,
//! guides, drivers, rolling pairs, contacts of cams.
//!
//! Drawing and loop equations share the positions, so neither of them proves these. This check uses
//! the scene and the computed positions, and nothing of the solver: no loci, no closures, no guides
//! that the solver placed in the plane. A configuration that breaks a statement is no answer.
//!
//! A distance is met within [`SAME`] of the size of the mechanism, the accuracy of ten typed
//! digits; an angle within as many radians.

mod cams;

use crate::mechanism::{Mechanism, Opened};
use crate::position::Configuration;
use cams::FollowerClearance;
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::digits::significant;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::trig::sin_cos;
use hodograph_scene::{
    Angle, Contours, Driver, DriverKind, GivenQuantity, GuideDirection, GuideId, GuidePath, LinkId,
    PointId, PointPlace, Rolling, Scene, Sizes, Through,
};
use std::f64::consts::TAU;

/// Permitted deviation from a statement, as a part of the mechanism's size, or in radians.
const SAME: f64 = 1e-9;

/// Angle (rad) beyond which an `f64` determines no phase to [`SAME`].
const MANY: f64 = 1e5;

/// A statement of the scene that a configuration does not meet.
#[derive(Clone, Debug, PartialEq)]
pub struct Breach {
    /// The item and the amount in words.
    pub words: Both,
    /// The amount: metres, or radians for a stated angle.
    pub off: f64,
    /// The statement in the file.
    pub span: hodograph_base::diag::Span,
}

impl Breach {
    /// Returns the breach as an error.
    pub fn diagnostic(&self) -> Diagnostic {
        Diagnostic::error(UNPROVEN, both!("the position found is not that of the scene: {}", self.words))
            .at(self.span)
            .help(both!(
                "check what the scene gives here; where several assemblies are possible, say with \"side\", \"sketch\" or coordinates which one is meant"
            ))
    }
}

/// The code of a breach.
const UNPROVEN: &str = "position-unproven";

/// True if a position that contradicts the scene is among the faults.
pub fn is_unproven(faults: &Faults) -> bool {
    faults.list.iter().any(|d| d.code == UNPROVEN)
}

/// The moment at which a configuration is checked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Moment<'a> {
    /// The scene's own instant: all statements of the scene apply.
    Instant,
    /// Another position of its motion: drivers have other values, sides may have changed, and
    /// quantities given for the instant have moved with their links. Links keep the shape that they
    /// have at the instant, which is the given configuration.
    Later(&'a Configuration),
}

/// Returns the statements of the scene that a configuration breaks, the largest amount first; parts
/// without a position are not checked.
pub fn breaches(
    scene: &Scene,
    mechanism: &Mechanism,
    at: &Configuration,
    moment: Moment<'_>,
) -> Vec<Breach> {
    let mut judge = Judge { scene, mechanism, at, moment, size: at.extent(), found: Vec::new() };
    judge.lengths();
    judge.places();
    judge.guides();
    judge.rolling();
    judge.cams();
    match moment {
        Moment::Instant => {
            judge.sides();
            judge.drivers();
        }
        Moment::Later(instant) => judge.forms(instant),
    }
    judge.found.sort_by(|a, b| b.off.abs().total_cmp(&a.off.abs()));
    judge.found
}

/// Checks that a configuration meets the statements of the scene.
///
/// # Errors
/// `position-unproven`, one for each broken statement.
pub fn proved(
    scene: &Scene,
    mechanism: &Mechanism,
    at: &Configuration,
    moment: Moment<'_>,
) -> Result<(), Faults> {
    let mut faults = Faults::default();
    faults.list.extend(breaches(scene, mechanism, at, moment).iter().map(Breach::diagnostic));
    if faults.has_errors() { Err(faults) } else { Ok(()) }
}

/// Returns the unit vector at an angle from the x axis.
fn way_of(angle: &Angle) -> Vec2 {
    let (sine, cosine) = sin_cos(*angle);
    Vec2::new(cosine, sine)
}

struct Judge<'a> {
    scene: &'a Scene,
    mechanism: &'a Mechanism,
    at: &'a Configuration,
    moment: Moment<'a>,
    size: f64,
    found: Vec<Breach>,
}

impl Judge<'_> {
    fn place(&self, p: PointId) -> Option<Point> {
        self.at.points[p.0]
    }

    fn name(&self, p: PointId) -> &str {
        self.scene.point_name(p)
    }

    /// Returns the permitted deviation (m) of a distance at a position.
    fn slack(&self, at: Point) -> f64 {
        SAME * self.size + 16.0 * f64::EPSILON * at.to_vec2().norm()
    }

    /// Records a length that deviates by `off` (m) at a position.
    fn length_off(
        &mut self,
        off: f64,
        at: Point,
        span: hodograph_base::diag::Span,
        words: impl FnOnce(&Self) -> Both,
    ) {
        // NaN is not accepted as a proof.
        if off.abs() <= self.slack(at) {
            return;
        }
        let words = words(self);
        self.found.push(Breach { words, off, span });
    }

    /// Records an angle that deviates by `off` (rad).
    fn angle_off(
        &mut self,
        off: f64,
        span: hodograph_base::diag::Span,
        words: impl FnOnce(String) -> Both,
    ) {
        let off = off - TAU * libm::round(off / TAU);
        if off.abs() <= SAME {
            return;
        }
        let degrees = format!("{}°", significant(off.to_degrees(), 4));
        self.found.push(Breach { words: words(degrees), off, span });
    }

    fn lengths(&mut self) {
        for l in &self.scene.lengths {
            let (Some(a), Some(b)) = (self.place(l.a), self.place(l.b)) else { continue };
            if self.is_opened_length(l.a, l.b) {
                continue;
            }
            let is = a.distance(b);
            let (span, given) = (l.value.span, l.value.text.clone());
            self.length_off(is - l.value.value, a, span, |j| {
                let (a, b) = (j.name(l.a), j.name(l.b));
                let is = j.scene.length_words(is);
                both!("{a}{b} comes out as {is}, given is {given}")
            });
        }
    }

    /// True for a length of a link, or at a pin, that is a virtual constraint: it is checked
    /// elsewhere.
    fn is_opened_length(&self, a: PointId, b: PointId) -> bool {
        let on = |l: LinkId| [a, b].iter().all(|p| self.scene.links[l.0].points.contains(p));
        let opened = |l: LinkId| {
            self.mechanism.is_opened(&Opened::Link(l))
                || [a, b].iter().any(|p| self.mechanism.is_opened(&Opened::Pin(*p, l)))
        };
        (0..self.scene.links.len()).map(LinkId).filter(|l| on(*l)).any(opened)
    }

    fn places(&mut self) {
        for (i, point) in self.scene.points.iter().enumerate() {
            let Some(at) = self.place(PointId(i)) else { continue };
            let stated = match &point.place {
                PointPlace::Unknown => continue,
                PointPlace::At([x, y]) => {
                    let fixed = self.scene.links[self.scene.ground.0].points.contains(&PointId(i));
                    if !fixed && self.moment != Moment::Instant {
                        continue;
                    }
                    Some(Point::new(x.value, y.value))
                }
                PointPlace::InLink { base: (a, b), xy: [x, y] } => {
                    self.seen_from(*a, *b, Vec2::new(x.value, y.value))
                }
                PointPlace::Polar { base: (a, b), length, angle } => {
                    self.seen_from(*a, *b, way_of(&angle.value) * length.value)
                }
            };
            let Some(stated) = stated else { continue };
            if self
                .scene
                .carriers(PointId(i))
                .any(|l| self.mechanism.is_opened(&Opened::Pin(PointId(i), l)))
            {
                continue;
            }
            let off = at.distance(stated);
            self.length_off(off, at, point.span, |j| {
                let (name, off) = (&point.name, j.scene.length_words(off));
                both!("{name} lies {off} from its given place")
            });
        }
    }

    /// Returns the position at given coordinates in the frame with its origin in `a` and x toward
    /// `b`.
    fn seen_from(&self, a: PointId, b: PointId, xy: Vec2) -> Option<Point> {
        let origin = self.place(a)?;
        Some(origin + xy.rotate_by((self.place(b)? - origin).unit()?))
    }

    /// Checks that points of a link keep their distances from the instant.
    fn forms(&mut self, instant: &Configuration) {
        for (l, link) in self.scene.links.iter().enumerate() {
            let opened = |p: PointId| self.mechanism.is_opened(&Opened::Pin(p, LinkId(l)));
            if self.mechanism.is_opened(&Opened::Link(LinkId(l))) {
                continue;
            }
            let known: Vec<(PointId, Point, Point)> =
                (link.points.iter().copied().filter(|p| !opened(*p)))
                    .filter_map(|p| Some((p, self.place(p)?, instant.points[p.0]?)))
                    .collect();
            // Two points fix the others: each is checked against both.
            for (k, (p, now, then)) in known.iter().enumerate().skip(1) {
                for (q, from, was) in known.iter().take(k.min(2)) {
                    let off = now.distance(*from) - then.distance(*was);
                    self.length_off(off, *now, link.span, |j| {
                        let (p, q, off) = (j.name(*p), j.name(*q), j.scene.length_words(off.abs()));
                        both!("{q}{p} of link {} has changed by {off}", link.name)
                    });
                }
            }
        }
    }

    fn sides(&mut self) {
        for side in &self.scene.sides {
            let (Some(p), Some(a), Some(b)) =
                (self.place(side.point), self.place(side.from), self.place(side.to))
            else {
                continue;
            };
            let Some(along) = (b - a).unit() else { continue };
            // Distance to the left of the line.
            let aside = along.cross(p - a);
            let wrong = if side.left { -aside } else { aside };
            if wrong <= 0.0 {
                continue;
            }
            self.length_off(wrong, p, side.span, |j| {
                let [p, a, b] = [side.point, side.from, side.to].map(|p| j.name(p));
                let off = j.scene.length_words(wrong);
                match side.left {
                    true => both!("{p} lies {off} to the right of {a}{b}"),
                    false => {
                        both!("{p} lies {off} to the left of {a}{b}")
                    }
                }
            });
        }
    }

    /// Returns a point and the direction of a straight guide in the plane, from the statements of
    /// the scene; `None` if the scene leaves one of them to the pose.
    fn line_of(&self, g: GuideId) -> Option<(Point, Vec2)> {
        let guide = &self.scene.guides[g.0];
        let GuidePath::Line { through, direction, offset } = &guide.path else { return None };
        let along = self.direction_of(guide.on, direction)?;
        let at = match through {
            Through::Point(p) => self.place(*p)?,
            Through::At([x, y]) => Point::new(x.value, y.value),
            Through::Pin => return None,
        };
        Some((offset.as_ref().map_or(at, |o| at + along.perp() * o.value), along))
    }

    /// Returns the direction of a straight guide on a link.
    fn direction_of(&self, on: LinkId, direction: &GuideDirection) -> Option<Vec2> {
        let turned = |way: Vec2, angle: &GivenQuantity<Angle>| way.rotate_by(way_of(&angle.value));
        match direction {
            GuideDirection::Instant(angle) => {
                let told = on == self.scene.ground
                    || self.moment == Moment::Instant
                    || self.mechanism.never_turns[on.0];
                told.then(|| way_of(&angle.value))
            }
            GuideDirection::Along(a, b, turn) => {
                let way = (self.place(*b)? - self.place(*a)?).unit()?;
                Some(turn.as_ref().map_or(way, |t| turned(way, t)))
            }
            // The link has no line but its guide: its pose gives the direction.
            GuideDirection::Own => self.at.poses[on.0].map(|pose| pose.axis),
            GuideDirection::Slid(angle) => {
                let along = self.scene.guides.iter().find(|g| g.slider == Some(on))?;
                let GuidePath::Line { direction, .. } = &along.path else { return None };
                Some(turned(self.direction_of(along.on, direction)?, angle))
            }
        }
    }

    fn guides(&mut self) {
        for (i, guide) in self.scene.guides.iter().enumerate() {
            let g = GuideId(i);
            let contact = self.scene.cams.iter().any(|c| c.contact == Some(g));
            let (Some(pin), false) = (guide.pin, contact) else { continue };
            let (Some(at), false) = (self.place(pin), self.mechanism.is_opened(&Opened::Guide(g)))
            else {
                continue;
            };
            let off = match &guide.path {
                GuidePath::Line { .. } => {
                    self.line_of(g).map(|(through, along)| along.cross(at - through))
                }
                GuidePath::Arc { centre, radius } => radius
                    .as_ref()
                    .and_then(|r| Some(at.distance(self.place(*centre)?) - r.value))
                    .filter(|_| guide.rolling.is_none()),
            };
            let Some(off) = off else { continue };
            self.length_off(off, at, guide.span, |j| {
                let (pin, link, off) =
                    (j.name(pin), j.scene.link_name(guide.on), j.scene.length_words(off.abs()));
                both!("{pin} lies {off} beside its guide on link {link}")
            });
        }
    }

    /// Returns the direction from which an angle of a link is measured: that of the given line,
    /// otherwise of its first two points; for the ground the x axis.
    fn axis(&self, link: LinkId, line: Option<(PointId, PointId)>) -> Option<Vec2> {
        let points = &self.scene.links[link.0].points;
        let (a, b) = match line {
            Some(line) => line,
            None if link == self.scene.ground => return Some(Vec2::unit_x()),
            None => (*points.first()?, *points.get(1)?),
        };
        (self.place(b)? - self.place(a)?).unit()
    }

    fn drivers(&mut self) {
        for driver in &self.scene.drivers {
            match &driver.kind {
                DriverKind::Turn { link, against, line, against_line, angle: Some(angle) } => {
                    let (Some(of), Some(from)) =
                        (self.axis(*link, *line), self.axis(*against, *against_line))
                    else {
                        continue;
                    };
                    let off = of.divide_by(from).divide_by(way_of(&angle.value)).angle();
                    let name = self.scene.link_name(*link).to_owned();
                    self.angle_off(off, angle.span, |off| {
                        both!("link {name} is turned {off} from its driver's angle")
                    });
                }
                DriverKind::Slide { guide, position: Some(position) } => {
                    let Some(pin) = self.scene.guides[guide.0].pin else { continue };
                    let Some(at) = self.place(pin) else { continue };
                    let Some((through, along)) = self.line_of(*guide) else { continue };
                    let off = along.dot(at - through) - position.value;
                    self.length_off(off, at, position.span, |j| {
                        let (pin, off) = (j.name(pin), j.scene.length_words(off.abs()));
                        both!("{pin} lies {off} from its driver's position")
                    });
                }
                DriverKind::Cylinder { a, b, length: Some(length), .. } => {
                    let (Some(p), Some(q)) = (self.place(*a), self.place(*b)) else { continue };
                    let off = p.distance(q) - length.value;
                    self.length_off(off, p, length.span, |j| {
                        let (a, b, off) = (j.name(*a), j.name(*b), j.scene.length_words(off.abs()));
                        both!("cylinder {a}{b} is {off} off its length")
                    });
                }
                DriverKind::Turn { angle: None, .. }
                | DriverKind::Slide { position: None, .. }
                | DriverKind::Cylinder { length: None, .. } => {}
            }
        }
    }

    fn rolling(&mut self) {
        for pair in &self.scene.rolling {
            self.distance_of_centres(pair);
            if self.moment == Moment::Instant {
                self.phase(pair);
            }
        }
    }

    /// Checks that two circles of given radii touch, and that a wheel keeps its radius from its
    /// track.
    fn distance_of_centres(&mut self, pair: &Rolling) {
        match &pair.contours {
            Contours::Circles { centres: [p, q], sizes: Sizes::Radii([a, b]), hollow, .. } => {
                let (Some(at), Some(to)) = (self.place(*p), self.place(*q)) else { return };
                let apart =
                    if hollow.is_some() { (a.value - b.value).abs() } else { a.value + b.value };
                let off = at.distance(to) - apart;
                self.length_off(off, at, pair.span, |j| {
                    let (p, q, off) = (j.name(*p), j.name(*q), j.scene.length_words(off.abs()));
                    both!("{p}{q} is {off} off the distance at which the wheels touch")
                });
            }
            Contours::Track { .. } | Contours::Circles { .. } | Contours::Belt { .. } => {}
        }
    }

    /// Checks the phase of two wheels: φ₂ + φ₁ρ₁/ρ₂ = phase, both angles measured from the line of
    /// centres, φ₁ as its driver gives it, otherwise with as many turns as the phase requires.
    fn phase(&mut self, pair: &Rolling) {
        let (Some(phase), Some([p, q])) = (&pair.phase, pair.round()) else { return };
        let (Some(a), Some(b)) = (self.place(p), self.place(q)) else { return };
        let Some(line) = (b - a).unit() else { return };
        let [Some(first), Some(second)] = pair.links.map(|l| self.axis(l, None)) else { return };
        let inside = |hollow: &Option<usize>| if hollow.is_some() { -1.0 } else { 1.0 };
        let ratio = match &pair.contours {
            Contours::Circles { sizes: Sizes::Radii([a, b]), hollow, .. } => {
                inside(hollow) * a.value / b.value
            }
            Contours::Circles { sizes: Sizes::Teeth([a, b]), hollow, .. } => {
                inside(hollow) * f64::from(*a) / f64::from(*b)
            }
            Contours::Belt { radii: [a, b], crossed, .. } => {
                (if *crossed { 1.0 } else { -1.0 }) * a.value / b.value
            }
            Contours::Track { .. } => return,
        };
        let [first, second] = [first, second].map(|axis| axis.divide_by(line).angle());
        let stated = phase.value.radians();
        let turns = libm::ceil((stated / ratio / TAU).abs()).min(64.0) as i32;
        let own = |d: &&Driver| {
            d.kind.turned() == Some((pair.links[0], self.scene.ground))
                && d.kind.lines()[0].is_none()
        };
        let written = self
            .scene
            .drivers
            .iter()
            .filter(own)
            .find_map(|d| Some(d.kind.angle()?.value.radians() - line.angle()));
        let first = written.unwrap_or(first);
        // After this many turns double precision does not determine the angle of the second link
        // within its turn.
        if (first * ratio).abs() > MANY {
            return;
        }
        let turns = if stated.abs() > std::f64::consts::PI { -turns..=turns } else { 0..=0 };
        let off = |k: i32| {
            let off = second + (first + TAU * f64::from(k)) * ratio - stated;
            off - TAU * libm::round(off / TAU)
        };
        let off = turns.map(off).min_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(f64::NAN);
        let names = pair.links.map(|l| self.scene.link_name(l).to_owned());
        self.angle_off(off, phase.span, |off| {
            let [a, b] = &names;
            both!("wheel {b} is turned {off} from its phase on wheel {a}")
        });
    }

    fn cams(&mut self) {
        for cam in &self.scene.cams {
            if cam.contact.is_some_and(|g| self.mechanism.is_opened(&Opened::Guide(g))) {
                continue;
            }
            if let (Some(off), Moment::Instant) = (self.turned_off(cam), self.moment) {
                let name = self.scene.link_name(cam.cam).to_owned();
                self.angle_off(off, cam.span, |off| {
                    both!("cam {name} is turned {off} from its given angle")
                });
            }
            let Some(FollowerClearance { clearance, at }) = self.contact(cam) else { continue };
            self.length_off(clearance, at, cam.span, |j| {
                let (cam, follower) = (j.scene.link_name(cam.cam), j.scene.link_name(cam.follower));
                let off = j.scene.length_words(clearance.abs());
                match clearance < 0.0 {
                    true => both!("follower {follower} cuts {off} into cam {cam}"),
                    false => both!("follower {follower} stands {off} off cam {cam}"),
                }
            });
        }
    }
}
