//! The questions as columns: the registers that answer them. The definitions are those of
//! [`hodograph_mechanism::answer::evaluate`]. Questions without a [`Meaning`] have no kernel; the
//! loop equations answer them.

use super::{Compiler, MovingPoint, NoKernel};
use crate::carry::{Arm, Twist};
use crate::extreme::DrivenOutput;
use crate::kernel::{Reg, RegPair};
use crate::reading::{
    ComponentAlong, Coriolis, Dot, RateRatio, VectorDirection, VectorLength, WeightedSum,
};
use hodograph_base::diag::{Diagnostic, both};
use hodograph_base::geom::Vec2;
use hodograph_mechanism::mechanism::{Level, PointJoint, joined};
use hodograph_scene::quantity::{Meaning, Place, RelativeComponent};
use hodograph_scene::{Asked, Axis, Driver, Find, GuideId, LinkId, OnLink, PointId};

const P: Level = Level::Position;
const V: Level = Level::Velocity;
const A: Level = Level::Acceleration;

impl Compiler<'_> {
    /// Adds the columns of a question: a number has one, a vector its two components and its
    /// length.
    pub(super) fn answer(&mut self, find: &Find) -> Result<(), NoKernel> {
        let one = |c: &mut Self, reg: Reg| c.columns.push(reg);
        let vector = |c: &mut Self, level: Level, v: RegPair| c.vector_columns(level, v);
        let level = find.what.level();
        if let Asked::Force(force) = &find.what
            && let Some(what) = force.by_motion()
        {
            return self.by_motion(what, find);
        }
        match find.what.meaning(self.scene).ok_or_else(|| no_kernel(find))? {
            Meaning::Place(Place::Coordinate(p, axis)) => {
                let at = self.point(p, P)?;
                one(self, if axis == Axis::X { at.x } else { at.y })
            }
            Meaning::Place(Place::LinkAngle(l)) => {
                let v = self.line_of(l)?;
                let angle = self.emit(P, VectorDirection { v }, 1);
                one(self, angle)
            }
            Meaning::Place(Place::Distance(a, b)) => {
                let v = self.line(a, b)?;
                let length = self.emit(P, VectorLength { v }, 1);
                one(self, length)
            }
            Meaning::Place(Place::Along(guide, ..)) => {
                let (way, ..) = self.along(guide)?;
                one(self, way)
            }
            Meaning::Vector(p) => {
                let v = self.vector(&p, level)?;
                vector(self, level, v)
            }
            Meaning::Relative(RelativeComponent::Whole, a, b) => {
                let v = self.relative(&a, &b, level)?;
                vector(self, level, v)
            }
            Meaning::Relative(RelativeComponent::Sliding, a, b) if level == V => {
                self.no_cylinder(&a, &b, find)?;
                let v = self.relative(&a, &b, V)?;
                vector(self, V, v)
            }
            Meaning::Relative(RelativeComponent::Sliding, a, b) => {
                let (from, to) = (self.coriolis(&a, &b, find)?, self.relative(&a, &b, A)?);
                let v = self.emit_pair(A, Arm { from, to });
                vector(self, A, v)
            }
            Meaning::Relative(RelativeComponent::Along, a, b) => {
                self.no_cylinder(&a, &b, find)?;
                let (u, v) = (self.line(b.point, a.point)?, self.relative(&a, &b, A)?);
                let part = self.emit_pair(A, ComponentAlong { u, v });
                vector(self, A, part)
            }
            Meaning::Relative(RelativeComponent::Across, a, b) => {
                self.no_cylinder(&a, &b, find)?;
                let (d, v) = (self.line(b.point, a.point)?, self.relative(&a, &b, A)?);
                let u = self.emit_pair(P, Twist { d, k: [0.0, 1.0] });
                let part = self.emit_pair(A, ComponentAlong { u, v });
                vector(self, A, part)
            }
            Meaning::Relative(RelativeComponent::Coriolis, a, b) => {
                let v = self.coriolis(&a, &b, find)?;
                vector(self, V, v)
            }
            // These have no kernel: the loop equations answer them.
            Meaning::Relative(
                RelativeComponent::SlidingNormal | RelativeComponent::SlidingTangential,
                ..,
            )
            | Meaning::Seen(..) => {
                return Err(no_kernel(find));
            }
            Meaning::Ratio(links, arm) => {
                let [a, b] = match arm {
                    None => [self.turning(links[0], V)?, self.turning(links[1], V)?],
                    Some(arm) => [
                        self.relative_turning(links[0], arm, V)?,
                        self.relative_turning(links[1], arm, V)?,
                    ],
                };
                let size = self.at.extent();
                let rate =
                    |d: &Driver| d.rate.value.abs() / if d.kind.turns() { 1.0 } else { size };
                let driven = self
                    .scene
                    .drivers
                    .iter()
                    .map(rate)
                    .filter(|w| w.is_finite())
                    .fold(0.0, f64::max);
                let ratio = self.emit(V, RateRatio { a, b, driven }, 1);
                one(self, ratio)
            }
            Meaning::Turning(l, None) => {
                let reg = self.turning(l, level)?;
                one(self, reg)
            }
            Meaning::Turning(l, Some(against)) => {
                let reg = self.relative_turning(l, against, level)?;
                one(self, reg)
            }
        }
        Ok(())
    }

    /// Adds a vector's two components and its length.
    pub(super) fn vector_columns(&mut self, level: Level, v: RegPair) {
        let length = self.emit(level, VectorLength { v }, 1);
        self.columns.extend([v.x, v.y, length]);
    }

    /// Adds position, rate and acceleration of an output.
    pub(super) fn output(&mut self, output: DrivenOutput) -> Result<(), NoKernel> {
        let regs = match output {
            DrivenOutput::Turning(l) => {
                let v = self.line_of(l)?;
                [self.emit(P, VectorDirection { v }, 1), self.turning(l, V)?, self.turning(l, A)?]
            }
            DrivenOutput::Sliding(g) => {
                let (way, u, runner) = self.along(g)?;
                let (v, a) = (self.spot(runner, V)?, self.spot(runner, A)?);
                [way, self.emit(V, Dot { u, v }, 1), self.emit(A, Dot { u, v: a }, 1)]
            }
        };
        self.columns.extend(regs);
        Ok(())
    }

    /// The coordinate of the runner along a straight guide, the guide's direction, and the runner.
    fn along(&mut self, g: GuideId) -> Result<(Reg, RegPair, MovingPoint), NoKernel> {
        let guide = &self.scene.guides[g.0];
        let (slot, runner) = match (self.slot(g)?, guide.pin, guide.slider) {
            (Some(slot), Some(p), _) => (slot, MovingPoint::Pin(p)),
            (Some(slot), None, Some(l)) => (slot, MovingPoint::Own(l)),
            _ => return Err(self.lost(guide.on)),
        };
        let (from, to, u) = (slot.through, self.spot(runner, P)?, slot.direction);
        let way = self.emit_pair(P, Arm { from, to });
        Ok((self.emit(P, Dot { u, v: way }, 1), u, runner))
    }

    pub(super) fn vector(&mut self, p: &OnLink, level: Level) -> Result<RegPair, NoKernel> {
        match p.link {
            None => self.point(p.point, level),
            Some(l) => self.carried(p.point, l, level),
        }
    }

    fn relative(&mut self, a: &OnLink, b: &OnLink, level: Level) -> Result<RegPair, NoKernel> {
        let (to, from) = (self.vector(a, level)?, self.vector(b, level)?);
        Ok(self.emit_pair(level, Arm { from, to }))
    }

    fn relative_turning(&mut self, a: LinkId, b: LinkId, level: Level) -> Result<Reg, NoKernel> {
        let (a, b) = (self.turning(a, level)?, self.turning(b, level)?);
        Ok(self.emit(level, WeightedSum { a, b, k: -1.0 }, 1))
    }

    fn line(&mut self, from: PointId, to: PointId) -> Result<RegPair, NoKernel> {
        let (from, to) = (self.point(from, P)?, self.point(to, P)?);
        Ok(self.emit_pair(P, Arm { from, to }))
    }

    /// The line that defines a link's angle: from its first point to its second, else that of its
    /// guide, else its frame's axis.
    fn line_of(&mut self, l: LinkId) -> Result<RegPair, NoKernel> {
        if let [a, b, ..] = self.scene.links[l.0].points[..] {
            return self.line(a, b);
        }
        // As in a pose, a guide defined on the link takes precedence over the guide in which it
        // slides.
        if let Some(g) = hodograph_mechanism::position::guide_of(self.scene, l)
            && let Some(direction) = self.direction_in_link(g)
        {
            return self.direction_on(self.scene.guides[g.0].on, direction);
        }
        if let Some(hodograph_mechanism::mechanism::Passive::Block(g)) = self.m.passive[l.0] {
            let guide = &self.scene.guides[g.0];
            return match (self.at.shapes.guides[g.0], guide.pin) {
                (Some(hodograph_mechanism::position::Path::Arc { centre, .. }), Some(pin)) => {
                    let (from, to) =
                        (self.spot(MovingPoint::Fixed(guide.on, centre), P)?, self.point(pin, P)?);
                    let d = self.emit_pair(P, Arm { from, to });
                    Ok(self.emit_pair(P, Twist { d, k: [0.0, 1.0] }))
                }
                (Some(hodograph_mechanism::position::Path::Line { direction, .. }), _) => {
                    self.direction_on(guide.on, direction)
                }
                _ => Err(self.lost(l)),
            };
        }
        if let Some(hodograph_mechanism::mechanism::Passive::Cylinder(d)) = self.m.passive[l.0]
            && let Some([a, b]) = self.scene.drivers[d].kind.ends()
        {
            return self.line(a, b);
        }
        self.direction_on(l, Vec2::new(1.0, 0.0))
    }

    /// The direction of a straight guide in the frame of its link, by the shape of the link, else
    /// by the pose.
    fn direction_in_link(&self, g: GuideId) -> Option<Vec2> {
        use hodograph_mechanism::position::{Path, Pose};
        let on = self.scene.guides[g.0].on;
        let pose = if on == self.scene.ground { Some(Pose::GROUND) } else { self.at.poses[on.0] };
        match (self.at.shapes.guides[g.0], self.at.guides[g.0]) {
            (Some(Path::Line { direction, .. }), _) => Some(direction),
            (None, Some(Path::Line { direction, .. })) => Some(pose?.turn_back(direction)),
            (Some(Path::Arc { .. }), _) | (None, Some(Path::Arc { .. }) | None) => None,
        }
    }

    /// The acceleration 2 ω × v_r, with ω of the link that carries the guide between the two
    /// points.
    fn coriolis(&mut self, a: &OnLink, b: &OnLink, find: &Find) -> Result<RegPair, NoKernel> {
        let v = self.relative(a, b, V)?;
        let Some(PointJoint::Guide(g)) = joined(self.scene, a, b) else {
            return Err(no_kernel(find));
        };
        let omega = self.turning(self.scene.guides[g.0].on, V)?;
        Ok(self.emit_pair(V, Coriolis { v, omega }))
    }

    /// Refuses parts of the motion of a cylinder's ends, which have no kernel: the loop equations
    /// answer them.
    fn no_cylinder(&self, a: &OnLink, b: &OnLink, find: &Find) -> Result<(), NoKernel> {
        match joined(self.scene, a, b) {
            Some(PointJoint::Cylinder(_)) => Err(no_kernel(find)),
            Some(PointJoint::Link(_) | PointJoint::Guide(_)) | None => Ok(()),
        }
    }
}

pub(super) fn no_kernel(find: &Find) -> NoKernel {
    Diagnostic::note(
        "no-kernel",
        both!("{} has no compiled form: each position is solved by itself", find.text),
    )
    .at(find.span)
}

/// Name and unit of each column of a question.
pub(crate) fn names(find: &Find) -> Vec<(String, &'static str)> {
    let entry = find.what.entry();
    entry.form.columns().iter().map(|c| (format!("{}{c}", find.text), entry.kind.si())).collect()
}
