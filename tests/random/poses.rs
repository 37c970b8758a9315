//! Instantaneous centres, quantities of a pole, curvature of paths and parts of composite motion,
//! by geometry alone: poles of small finite rotations, circles through three places, differences of
//! places seen in a frame. No formula with velocities or accelerations is used.

use hodograph::answer::AnswerValue;
use hodograph::effort::truth::Differences;
use hodograph::geom::{Point, Vec2};
use hodograph::number::{Big, Real};
use hodograph::position::{Configuration, Pose};
use hodograph::scene::quantity::composite::CompositePart;
use hodograph::scene::quantity::curvature::{OfPath, OfPole};
use hodograph::scene::quantity::{Composite, Curvature, Frame, InstantCentre};
use hodograph::scene::{Asked, DriverKind, LinkId, OnLink, Scene};

type V = Vec2<Big>;

/// The answers to questions about centres, curvature and composite motion.
pub struct Oracle<'a> {
    pub scene: &'a Scene,
    pub d: &'a Differences<Big>,
}

fn number(x: f64) -> Big {
    Big::from_f64(x)
}

/// Values before, at and after the instant.
type Three<T> = [T; 3];

/// Rotation and displacement from the axes of one link to those of another.
type Relative = (V, V);

impl Oracle<'_> {
    /// The answer; `None` if this file has no formula, or there is no answer.
    pub fn answer(&self, what: &Asked) -> Option<AnswerValue<Big>> {
        match what {
            Asked::InstantCentre(c) => Some(AnswerValue::Point(self.centre(c)?)),
            Asked::FromCentre(f) => Some(AnswerValue::Scalar(
                self.d.now.points[f.point.0]?.distance(self.centre(&f.centre)?),
            )),
            Asked::Curvature(Curvature::Path(p, of)) => self.path(*p, *of),
            Asked::Curvature(Curvature::Pole(links, of)) => self.pole(links.map(|l| l.0), *of),
            Asked::Composite(c) => self.part(c),
            _ => None,
        }
    }

    fn each<T>(&self, f: impl Fn(&Configuration<Big>) -> Option<T>) -> Option<Three<T>> {
        Some([f(&self.d.before)?, f(&self.d.now)?, f(&self.d.after)?])
    }

    /// The pose of a link; barrel and rod of a cylinder are each on their own pin, along its line.
    fn pose(&self, at: &Configuration<Big>, l: LinkId) -> Option<Pose<Big>> {
        if l == self.scene.ground {
            return Some(Pose::ground());
        }
        let part = self.scene.drivers.iter().find_map(|d| match &d.kind {
            DriverKind::Cylinder { a, b, links, .. } => {
                Some((*a, *b, links.iter().position(|own| *own == l)?))
            }
            DriverKind::Turn { .. } | DriverKind::Slide { .. } => None,
        });
        let Some((a, b, k)) = part else { return at.poses[l.0] };
        let (a, b) = (at.points[a.0]?, at.points[b.0]?);
        Some(Pose { origin: [a, b][k], axis: (b - a).unit()? })
    }

    /// The poses of one link in the axes of another.
    fn relative(&self, [i, j]: [LinkId; 2]) -> Option<Three<Relative>> {
        self.each(|at| {
            let (of, frame) = (self.pose(at, i)?, self.pose(at, j)?);
            Some((of.axis.divide_by(frame.axis), (of.origin - frame.origin).divide_by(frame.axis)))
        })
    }

    fn centre(&self, c: &InstantCentre) -> Option<Point<Big>> {
        let [i, j] = c.links.map(|l| l.0);
        let [before, _, after] = self.relative([i, j])?;
        Some(self.pose(&self.d.now, j)?.to_world(turned_about(before, after)?.1.to_point()))
    }

    fn pole(&self, [i, j]: [LinkId; 2], of: OfPole) -> Option<AnswerValue<Big>> {
        let [before, now, after] = self.relative([i, j])?;
        let frame = self.pose(&self.d.now, j)?;
        let (in_link, pole) = turned_about(before, after)?;
        let h = self.d.step;
        let turn = after.0.divide_by(before.0).angle() / (h + h);
        let on = |v: V| AnswerValue::Point(frame.to_world(v.to_point()));
        let way = (turned_about(now, after)?.1 - turned_about(before, now)?.1) * (number(1.0) / h);
        Some(match of {
            OfPole::PoleVelocity => AnswerValue::Vector(frame.turn(way)),
            OfPole::Diameter => AnswerValue::Scalar(absolute(way.norm() / turn)),
            OfPole::InflectionPole => on(pole - way.perp() * (number(1.0) / turn)),
            OfPole::AccelerationPole => {
                let bend = |f: fn(&Relative) -> V| (f(&after) - f(&now)) - (f(&now) - f(&before));
                let at = -bend(|r| r.1).divide_by(bend(|r| r.0));
                on(now.1 + at.rotate_by(now.0))
            }
            OfPole::InLink => {
                let pose = self.pose(&self.d.now, i)?;
                let [a, b, ..] = self.scene.links[i.0].points[..] else { return None };
                let [a, b] = [a, b].map(|p| self.d.now.point(p));
                AnswerValue::Point(
                    (pose.to_world(in_link.to_point()) - a).divide_by((b - a).unit()?).to_point(),
                )
            }
            _ => return None,
        })
    }

    /// The places of a point of a link.
    fn places(&self, p: OnLink) -> Option<Three<Point<Big>>> {
        let carried = |l: LinkId| {
            let local = self.pose(&self.d.now, l)?.to_local(self.d.now.points[p.point.0]?);
            self.each(|at| Some(self.pose(at, l)?.to_world(local)))
        };
        p.link.map_or_else(|| self.each(|at| at.points[p.point.0]), carried)
    }

    /// The circle through three places.
    fn path(&self, p: OnLink, of: OfPath) -> Option<AnswerValue<Big>> {
        let [a, b, c] = self.places(p)?;
        let (p, q) = (a - b, c - b);
        let to = (p.perp() * q.norm2() - q.perp() * p.norm2()) * (number(0.5) / p.cross(q));
        Some(match of {
            OfPath::Radius => AnswerValue::Scalar(to.norm()),
            OfPath::Centre => AnswerValue::Point(b + to),
            _ => return None,
        })
    }

    /// The place of a point as seen from a frame, in axes with the frame's present direction.
    fn seen(&self, of: OnLink, frame: Frame) -> Option<Three<V>> {
        let moving = self.places(of)?;
        match frame {
            Frame::Point(c) => {
                let seat = self.places(c)?;
                Some([0, 1, 2].map(|k| moving[k] - seat[k]))
            }
            Frame::Link(l) => {
                let [before, now, after] = self.each(|at| self.pose(at, l))?;
                Some(
                    [(before, moving[0]), (now, moving[1]), (after, moving[2])]
                        .map(|(pose, p)| now.turn(pose.to_local(p).to_vec2())),
                )
            }
        }
    }

    fn seat(&self, of: OnLink, frame: Frame) -> Option<Three<V>> {
        let places = match frame {
            Frame::Link(l) => self.places(OnLink { point: of.point, link: Some(l) })?,
            Frame::Point(c) => self.places(c)?,
        };
        Some(places.map(Point::to_vec2))
    }

    fn part(&self, c: &Composite) -> Option<AnswerValue<Big>> {
        let h = self.d.step;
        let first = |p: Three<V>| (p[2] - p[0]) * (number(1.0) / (h + h));
        let second = |p: Three<V>| ((p[2] - p[1]) - (p[1] - p[0])) * (number(1.0) / (h * h));
        let (seat, seen) = (self.seat(c.of, c.frame)?, self.seen(c.of, c.frame)?);
        // Along the path, and across it.
        let along = |p: Three<V>| {
            let (v, a) = (first(p), second(p));
            // A point at rest has no path.
            (v.norm().approx() > 1e-40).then(|| v * (v.dot(a) / v.norm2()))
        };
        Some(AnswerValue::Vector(match c.part {
            CompositePart::TransportVelocity => first(seat),
            CompositePart::RelativeVelocity => first(seen),
            CompositePart::Transport => second(seat),
            CompositePart::TransportNormal => second(seat) - along(seat)?,
            CompositePart::TransportTangential => along(seat)?,
            CompositePart::Relative => second(seen),
            CompositePart::RelativeNormal => second(seen) - along(seen)?,
            CompositePart::RelativeTangential => along(seen)?,
            CompositePart::Coriolis => {
                second(self.places(c.of)?.map(Point::to_vec2)) - second(seat) - second(seen)
            }
            CompositePart::Path => return None,
        }))
    }
}

/// The point about which a link rotates from one pose to another: in its own axes, and in those of
/// the other.
fn turned_about(a: Relative, b: Relative) -> Option<(V, V)> {
    let turn = b.0 - a.0;
    // Links without relative rotation have no pole.
    if turn.norm().approx() < 1e-100 {
        return None;
    }
    let own = -(b.1 - a.1).divide_by(turn);
    Some((own, a.1 + own.rotate_by(a.0)))
}

fn absolute(x: Big) -> Big {
    if x.approx() < 0.0 { -x } else { x }
}
