//! Draws disc cams: the actual profile with roller, edge or face of the follower, and, in thin
//! lines, the equivalent linkage 高副替代机构.

use std::f64::consts::{FRAC_PI_2, TAU};

use hodograph_base::cam::{CamStation, ProfileSegment};
use hodograph_base::geom::{Point, Vec2};
use hodograph_board::plan::names::{name_label, point_label};
use hodograph_mechanism::answer::AnswerValue;
use hodograph_mechanism::mechanism::Opened;
use hodograph_mechanism::position::Path;
use hodograph_paper::paper::drawing::Drawing;
use hodograph_paper::paper::item::{Dash, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::{LabelRequest, Reads};
use hodograph_paper::paper::style::Style;
use hodograph_paper::paper::symbols as sym;
use hodograph_scene::{
    Asked, Cam, DiagramKind, Follows, GuideDirection, GuideId, GuidePath, LinkId, Pieces, PointId,
    TurningCam,
};

use super::MechanismDraft;
use super::letters::NumberPlace;

/// Points of a profile: one for each degree.
const STEPS: usize = 360;
/// Distance from the end of a follower to the middle of its guide.
const ROD_MM: f64 = 16.0;
/// Extension of a face beyond its contact.
const BEYOND_MM: f64 = 7.0;
/// A centre of curvature farther away than this is not drawn: the profile is nearly straight there.
const FAR_MM: f64 = 120.0;
/// The arrow of a roller's rotation: distance from the roller, and half angle about the middle of
/// the free side.
const SPIN_OFF_MM: f64 = 2.0;
const SPIN_RAD: f64 = 0.8;

/// Number of pieces of a rim for the number, and the angle of the first one: below the middle, on
/// the left.
const PLACES: usize = 12;
const NUMBER_FROM_RAD: f64 = 3.6;
/// Beyond this distance from all joints all pieces are equally good.
const FAR_ENOUGH_MM: f64 = 22.0;

impl MechanismDraft<'_> {
    /// True if a guide only represents the contact of a cam.
    pub(super) fn is_contact(&self, g: GuideId) -> bool {
        self.scene.cams.iter().any(|c| c.contact == Some(g))
    }

    /// True if a link is only a cam, or only a lever with a flat face: it has no joint except its
    /// own pivot.
    pub(super) fn is_profile(&self, l: LinkId) -> bool {
        let faced = |c: &Cam| c.follower == l && matches!(c.follows, Follows::Face(_));
        let named = self.scene.cams.iter().any(|c| c.cam == l || faced(c));
        let joint =
            |p: &PointId| self.is_pin(*p) && !self.on_ground(*p) && !self.represents_contact(*p);
        named && !self.scene.links[l.0].points.iter().any(joint)
    }

    /// True if a point is a pin only because it runs in the guide that represents a contact.
    fn represents_contact(&self, p: PointId) -> bool {
        self.scene.cams.iter().any(|c| {
            c.contact.is_some_and(|g| self.scene.guides[g.0].pin == Some(p)) && self.on_cam(c, p)
        })
    }

    /// True if a flat face is named by a line through this point: tables write ∥CF.
    pub(super) fn on_face(&self, p: PointId) -> bool {
        let along = |g: GuideId| match self.scene.guides[g.0].path {
            GuidePath::Line { direction: GuideDirection::Along(a, b, _), .. } => a == p || b == p,
            GuidePath::Line {
                direction:
                    GuideDirection::Own | GuideDirection::Instant(_) | GuideDirection::Slid(_),
                ..
            }
            | GuidePath::Arc { .. } => false,
        };
        let faced = |c: &Cam| match c.follows {
            Follows::Face(_) => c.contact.is_some_and(along),
            Follows::Edge(_) | Follows::Roller(..) | Follows::Arc(..) => false,
        };
        self.scene.cams.iter().any(faced)
    }

    fn on_cam(&self, c: &Cam, p: PointId) -> bool {
        self.scene.links[c.cam.0].points.contains(&p)
    }

    /// Offset of the block and the guide of a cam's follower from the follower's end.
    pub(super) fn raised(&self, g: GuideId, tangent: Vec2) -> Vec2 {
        let guide = &self.scene.guides[g.0];
        let of =
            |c: &&Cam| guide.slider == Some(c.follower) && guide.pin == Some(c.follows.point());
        self.scene
            .cams
            .iter()
            .find(of)
            .map_or(Vec2::ZERO, |c| tangent * (ROD_MM + self.mm(c.follows.radius().unwrap_or(0.0))))
    }

    /// For a knife edge that is at no joint: the direction in which the follower extends from it.
    pub(super) fn knife_edge(&self, p: PointId) -> Option<Vec2> {
        let c = self.scene.cams.iter().find(|c| matches!(c.follows, Follows::Edge(q) if q == p))?;
        if self.scene.carriers(p).any(|l| l != c.follower) {
            return None;
        }
        let slides = |g: &usize| {
            self.scene.guides[*g].slider == Some(c.follower) && self.scene.guides[*g].pin == Some(p)
        };
        if let Some(g) = (0..self.scene.guides.len()).find(slides) {
            let Some(Path::Line { direction, .. }) = self.guide(GuideId(g)) else { return None };
            return Some(direction);
        }
        let at = self.point(p)?;
        let others = self.scene.links[c.follower.0].points.iter().filter(|q| **q != p);
        others.filter_map(|q| self.point(*q)).find_map(|q| (q - at).unit())
    }

    pub(super) fn mm(&self, length: f64) -> f64 {
        length / self.worked.construction.diagram.mu
    }

    /// Maps the frame of a pose's profile pieces to paper.
    fn of_pieces(&self, pieces: &Pieces) -> Option<impl Fn(Vec2) -> Point + use<'_>> {
        let [from, to] = pieces.frame.map(|p| self.point(p));
        let (from, mu) = (from?, self.worked.construction.diagram.mu);
        let axis = (to? - from).unit()?;
        Some(move |v: Vec2| from + v.rotate_by(axis) * (1.0 / mu))
    }

    /// Maps the frame of a cam to paper, with the cam in its present position.
    fn of_cam(&self, c: &Cam) -> Option<impl Fn(Vec2) -> Point + use<'_>> {
        let t = c.disc.as_ref()?;
        let centre = self.point(t.pivot)?;
        let (turn, mu) = (self.turned(t)?, self.worked.construction.diagram.mu);
        Some(move |v: Vec2| centre + v.rotate_by(turn) * (1.0 / mu))
    }

    /// The direction of the x axis of a cam's frame in its present position: turned with the cam in
    /// its carrier, and with the carrier.
    fn turned(&self, t: &TurningCam) -> Option<Vec2> {
        let carrier = match t.axis(self.scene) {
            Some([a, b]) => (self.point(b)? - self.point(a)?).unit()?,
            None => Vec2::unit_x(),
        };
        Some(Vec2::from_angle(t.disc.sense * t.phi).rotate_by(carrier))
    }

    /// The known data of the contact at the instant.
    fn station(&self, c: &Cam) -> Option<CamStation> {
        let t = c.disc.as_ref()?;
        t.disc.station(t.phi, t.side)
    }

    /// The contact and the centre of curvature of the profile, on paper.
    pub(super) fn contact(&self, c: &Cam) -> Option<(Point, Option<Point>)> {
        let touch = self.worked.configuration.touch(self.scene, c)?;
        Some((self.paper(touch.at), self.centre(c)))
    }

    /// The centre of curvature of the profile at the contact, on paper; `None` if the profile is
    /// nearly straight there.
    fn centre(&self, c: &Cam) -> Option<Point> {
        if let (Some(s), Some(at)) = (self.station(c), self.of_cam(c)) {
            let k = s.centre();
            return (k.is_finite() && self.mm((k - s.contact).norm()) < FAR_MM).then(|| at(k));
        }
        if let Some((k, _)) = c.circle {
            return self.point(k);
        }
        let pieces = c.posed.as_ref()?;
        match pieces.segments[pieces.touched] {
            ProfileSegment::Arc { centre, radius, .. } => self
                .of_pieces(pieces)
                .filter(|_| self.mm(radius.abs()) < FAR_MM)
                .map(|at| at(centre)),
            ProfileSegment::Line { .. } => None,
        }
    }

    /// Draws the profiles behind the links.
    pub(super) fn cams(&mut self) {
        let scene = self.scene;
        scene.cams.iter().for_each(|c| self.profile(c));
    }

    /// Draws the ends of the followers over the plates: a plate with a roller at its corner would
    /// hide half of the roller.
    pub(super) fn followers(&mut self) {
        let scene = self.scene;
        scene.cams.iter().for_each(|c| self.end(c));
    }

    /// The piece of a rim with its number farthest from joints and supports, because a number near
    /// these would be read as theirs. Distances that are large enough count as equal; the first
    /// piece wins.
    fn freest(&self, pieces: impl Iterator<Item = [Point; 2]>) -> [Point; 2] {
        let joints =
            (0..self.scene.points.len()).map(PointId).filter_map(|p| Some((p, self.point(p)?)));
        let busy: Vec<Point> = joints
            .flat_map(|(p, at)| [at, at + self.support_side(p) * self.style.pivot_height_mm])
            .collect();
        let free = |[a, b]: &[Point; 2]| {
            let middle = *a + (*b - *a) * 0.5;
            busy.iter().map(|p| p.distance(middle)).fold(FAR_ENOUGH_MM, f64::min)
        };
        pieces.reduce(|a, b| if free(&b) > free(&a) { b } else { a }).unwrap_or([Point::ORIGIN; 2])
    }

    fn profile(&mut self, c: &Cam) {
        let id = format!("cam-{}", self.scene.link_name(c.cam));
        self.d.of_link(Some(c.cam.0));
        let (owner, [from, to]) = if let Some((k, radius)) = c.circle {
            let Some(centre) = self.point(k) else { return self.d.of_link(None) };
            let radius_mm = self.mm(radius);
            let owner = self.d.shape(&id, "cam", sym::round_body(self.style, centre, radius_mm));
            let piece = |k: usize| {
                [k as f64, k as f64 + 1.5].map(|a| {
                    centre + Vec2::from_angle(NUMBER_FROM_RAD + a * TAU / PLACES as f64) * radius_mm
                })
            };
            (owner, self.freest((0..PLACES).map(piece)))
        } else {
            let of_disc = || {
                Some(
                    c.disc.as_ref()?.disc.outline(STEPS).into_iter().map(self.of_cam(c)?).collect(),
                )
            };
            let of_pieces = || {
                let pieces = c.posed.as_ref()?;
                Some(
                    pieces
                        .segments
                        .iter()
                        .flat_map(|s| s.points(TAU / STEPS as f64))
                        .map(self.of_pieces(pieces)?)
                        .collect(),
                )
            };
            let points: Vec<Point> = of_disc().or_else(of_pieces).unwrap_or_default();
            let n = points.len();
            if n == 0 {
                return self.d.of_link(None);
            }
            let ends = self.freest(
                (0..PLACES)
                    .map(|k| [points[k * n / PLACES], points[(k * n / PLACES + n / 12) % n]]),
            );
            (
                self.d.shape(
                    &id,
                    "cam",
                    Shape::Polyline {
                        points,
                        closed: true,
                        stroke: Some(self.style.outline),
                        fill: Some(self.style.plate),
                    },
                ),
                ends,
            )
        };
        self.d.of_link(None);
        if self.forms[c.cam.0].is_none() && self.number_at[c.cam.0].is_none() {
            self.number_at[c.cam.0] = Some(NumberPlace::Along(from, to, owner));
        }
    }

    /// Draws the roller, the round end or the face.
    fn end(&mut self, c: &Cam) {
        let id = format!("follower-{}", self.scene.link_name(c.follower));
        let stroke = self.style.outline;
        self.d.of_link(Some(c.follower.0));
        match c.follows {
            Follows::Edge(_) => {}
            Follows::Roller(p, radius) => {
                if let Some(centre) = self.point(p) {
                    let disc = sym::round_body(self.style, centre, self.mm(radius));
                    self.d.shape(&id, "roller", disc);
                    if let Some(name) = &c.roller {
                        let label = Label::math(name_label(name));
                        let request = LabelRequest::at_point(
                            label,
                            self.style.label_mm,
                            centre,
                            self.mm(radius),
                        );
                        self.d.label(
                            &format!("number-{name}"),
                            "number",
                            request.read_as(Reads::Number),
                        );
                    }
                    self.spin(c, centre, self.mm(radius));
                }
            }
            Follows::Arc(p, radius) => {
                if let (Some(centre), Some((contact, _))) = (self.point(p), self.contact(c)) {
                    let middle = (contact - centre).angle();
                    let arc = Shape::Arc {
                        centre,
                        radius_mm: self.mm(radius),
                        from_rad: middle - 0.6,
                        to_rad: middle + 0.6,
                        stroke,
                    };
                    self.d.shape(&id, "round-end", arc);
                }
            }
            Follows::Face(p) => self.face(c, p, &id),
        }
        self.d.of_link(None);
    }

    /// Draws the sense in which a roller turns, if it is requested and the velocities are drawn.
    fn spin(&mut self, c: &Cam, centre: Point, radius_mm: f64) {
        if self.worked.construction.polygon(DiagramKind::Velocity).is_none() {
            return;
        }
        let asked = |find: usize| {
            self.scene
                .find
                .get(find)
                .is_some_and(|f| matches!(f.what, Asked::RollerSpin(q) if q.follower == c.follower))
        };
        let Some(AnswerValue::Scalar(rate)) =
            self.worked.results.iter().find(|r| asked(r.find)).map(|r| r.computed)
        else {
            return;
        };
        if rate == 0.0 {
            return;
        }
        // Away from the contact.
        let free = self.contact(c).map_or(FRAC_PI_2, |(contact, _)| (centre - contact).angle());
        let (low, high) = (free - SPIN_RAD, free + SPIN_RAD);
        let [from, to] = if rate > 0.0 { [low, high] } else { [high, low] };
        let (id, radius) =
            (format!("spin-{}", self.scene.link_name(c.follower)), radius_mm + SPIN_OFF_MM);
        let owner =
            self.d.draw(&id, "rotation", sym::rotation(self.style, centre, radius, from, to));
        let symbol = match &c.roller {
            Some(own) => format!("\\omega_{{{}}}", name_label(own)),
            None => format!("\\omega^s_{{{}}}", name_label(self.scene.link_name(c.follower))),
        };
        let clear = self.style.vector.width_mm / 2.0;
        let request = LabelRequest::along_arc(
            Label::math(symbol),
            self.style.label_mm,
            centre,
            radius,
            [from, to],
            clear,
        );
        self.d.label(&id, "rotation", request.owned(owner));
    }

    /// Draws a flat face from the foot of its point to beyond the contact, and the arm that holds
    /// it.
    fn face(&mut self, c: &Cam, p: PointId, id: &str) {
        let (Some(through), Some(touch)) =
            (self.point(p), self.worked.configuration.touch(self.scene, c))
        else {
            return;
        };
        let (contact, n) = (self.paper(touch.at), touch.normal);
        let foot = through - n * (through - contact).dot(n);
        let along = contact - foot;
        let u = along.unit().unwrap_or(n.perp());
        let slides = self.scene.guides.iter().any(|g| g.slider == Some(c.follower));
        // Points that name the face are on it, or on the arm that it makes with them.
        let named = self.scene.links[c.follower.0]
            .points
            .iter()
            .filter(|p| self.on_face(**p))
            .filter_map(|p| self.point(*p));
        let farthest = named
            .filter(|p| (*p - foot).dot(n).abs() < super::SAME_MM)
            .map(|p| (p - foot).dot(u))
            .fold(0.0, f64::max);
        let reach = (along.norm() + BEYOND_MM).max(farthest);
        let apart = (foot - through).norm() > super::SAME_MM;
        // A second face of a sliding follower is held by a frame round the cam.
        let yoke = c
            .touched_radius()
            .filter(|_| apart && slides)
            .map(|r| u * (along.norm() + self.mm(r) + BEYOND_MM));
        let [from, to] = match yoke {
            Some(half) => [foot - half, foot + half],
            None => [if slides { foot - u * reach } else { foot }, foot + u * reach],
        };
        let items = sym::link(self.style, &[from, to]);
        let items = c.contact.map_or(items.clone(), |g| self.as_opened(Opened::Guide(g), items));
        let owner = self.d.draw(id, "", items);
        if let Some(half) = yoke {
            for [from, to] in
                [[from, through - half], [through - half, through + half], [through + half, to]]
            {
                self.d.draw(id, "", sym::link(self.style, &[from, to]));
            }
        }
        if apart && !slides {
            self.d.draw(id, "", sym::link(self.style, &[through, foot]));
            self.d.draw(id, "", sym::weld(self.style, foot, through, contact));
        }
        if !slides && self.number_at[c.follower.0].is_none() {
            self.number_at[c.follower.0] = Some(NumberPlace::Along(foot, contact, owner));
        }
    }

    /// Draws the equivalent linkage in thin lines: pivot – centre of curvature – follower; and the
    /// contact on it.
    pub(super) fn equivalents(&mut self) {
        for i in 0..self.scene.cams.len() {
            let c = &self.scene.cams[i];
            let Some((contact, k)) = self.contact(c) else { continue };
            let id = format!("equivalent-{}", self.scene.link_name(c.cam));
            let stroke = self.style.thin.dashed(Dash::DashDot);
            let end = match c.follows {
                Follows::Face(_) => contact,
                Follows::Edge(p) | Follows::Roller(p, _) | Follows::Arc(p, _) => {
                    self.point(p).unwrap_or(contact)
                }
            };
            let mut line = |from: Point, to: Point| {
                if from.distance(to) > super::SAME_MM {
                    self.d.shape(&id, "equivalent", Shape::Line { from, to, stroke });
                }
            };
            match k {
                Some(k) => line(k, end),
                None => line(contact, end),
            }
            let pivot =
                self.scene.links[c.cam.0].points.iter().copied().find(|p| self.on_ground(*p));
            if let (Some(k), Some(pivot)) = (k, pivot.and_then(|p| self.point(p))) {
                self.d.shape(&id, "equivalent", Shape::Line { from: pivot, to: k, stroke });
                if k.distance(pivot) > super::SAME_MM {
                    self.d.draw(&id, "equivalent", sym::dot(self.style, k));
                }
            }
            contact_dot(&mut self.d, self.style, (i, &self.scene.cams[i]), contact);
        }
    }
}

/// Draws the contact of a cam with its number in the scene; it has a letter if the cam gives one.
pub(super) fn contact_dot(d: &mut Drawing, style: &Style, (i, cam): (usize, &Cam), at: Point) {
    d.draw(&format!("contact-{i}"), "contact", sym::dot(style, at));
    if let Some(name) = &cam.at {
        let (name, id) = (point_label(name), format!("contact-{i}-letter"));
        d.label_at(&id, "letter", &name, at, style.dot_radius_mm, None);
    }
}
