//! The rotation of links: their arms, ω and α, and the points that they carry.

use super::super::carry::{Arm, ArmSwing, ArmTurning, SwingRate, TurningRate};
use super::super::kernel::{Reg, RegPair};
use super::{Compiler, MovingPoint, NoKernel};
use hodograph_base::geom::Vec2;
use hodograph_mechanism::mechanism::{Level, Passive};
use hodograph_mechanism::position::Path;
use hodograph_scene::{LinkId, PointId};

impl Compiler<'_> {
    /// A link's arm or its rates.
    pub(super) fn arm(&mut self, l: LinkId, level: Level) -> Result<RegPair, NoKernel> {
        let body = self.body(l)?;
        if let Some(pair) = body.arm[level as usize] {
            return Ok(pair);
        }
        let pair = match body.between {
            Some((far, near)) => {
                let (from, to) = (self.point(far, level)?, self.point(near, level)?);
                self.emit_pair(level, Arm { from, to })
            }
            None => {
                let r = self.arm(l, Level::Position)?;
                let omega = self.turning(l, Level::Velocity)?;
                let still = self.fixed(Vec2::ZERO);
                match level {
                    Level::Position => return Err(self.lost(l)),
                    Level::Velocity => self.emit_pair(level, ArmSwing { v: still, r, omega }),
                    Level::Acceleration => {
                        let alpha = self.turning(l, Level::Acceleration)?;
                        self.emit_pair(level, SwingRate { a: still, r, omega, alpha })
                    }
                }
            }
        };
        if let Some(body) = &mut self.bodies[l.0] {
            body.arm[level as usize] = Some(pair);
        }
        Ok(pair)
    }

    /// The angular velocity or acceleration of a link.
    pub(super) fn turning(&mut self, l: LinkId, level: Level) -> Result<Reg, NoKernel> {
        let slot = level as usize - 1;
        if let Some(passive) = self.m.passive[l.0] {
            return self.turning_of_follower(l, passive, level);
        }
        self.body(l)?;
        let known = |c: &Self| c.bodies[l.0].as_ref().and_then(|b| b.turning[slot]);
        if let Some(reg) = known(self) {
            return Ok(reg);
        }
        self.link_group(l, level)?;
        if let Some(reg) = known(self) {
            return Ok(reg);
        }
        let (d, v) = (self.arm(l, Level::Position)?, self.arm(l, Level::Velocity)?);
        let reg = self.turning_of_arm(
            d,
            v,
            level,
            |c| c.arm(l, Level::Acceleration),
            |c| c.turning(l, Level::Velocity),
        )?;
        if let Some(body) = &mut self.bodies[l.0] {
            body.turning[slot] = Some(reg);
        }
        Ok(reg)
    }

    /// The angular velocity or acceleration of a line with known arm and rates.
    pub(super) fn turning_of_arm(
        &mut self,
        d: RegPair,
        v: RegPair,
        level: Level,
        a: impl FnOnce(&mut Self) -> Result<RegPair, NoKernel>,
        omega: impl FnOnce(&mut Self) -> Result<Reg, NoKernel>,
    ) -> Result<Reg, NoKernel> {
        Ok(match level {
            Level::Acceleration => {
                let (a, omega) = (a(self)?, omega(self)?);
                self.emit(level, TurningRate { d, v, a, omega }, 1)
            }
            Level::Position | Level::Velocity => self.emit(level, ArmTurning { d, v }, 1),
        })
    }

    /// The angular velocity or acceleration of a passive link: a block turns with its guide, or
    /// with the radius to its pin; barrel and rod turn with the line of their cylinder.
    fn turning_of_follower(
        &mut self,
        l: LinkId,
        passive: Passive,
        level: Level,
    ) -> Result<Reg, NoKernel> {
        let (from, to) = match passive {
            Passive::Block(g) => {
                let guide = &self.scene.guides[g.0];
                match (self.at.shapes.guides[g.0], guide.pin) {
                    (Some(Path::Arc { centre, .. }), Some(pin)) => {
                        (MovingPoint::Fixed(guide.on, centre), MovingPoint::Pin(pin))
                    }
                    _ => return self.turning(guide.on, level),
                }
            }
            Passive::Cylinder(_) | Passive::Held(..) => {
                let (a, b) = self.m.line_of(self.scene, l).ok_or_else(|| self.lost(l))?;
                (MovingPoint::Pin(a), MovingPoint::Pin(b))
            }
        };
        let arm = |c: &mut Self, level| -> Result<RegPair, NoKernel> {
            let (from, to) = (c.spot(from, level)?, c.spot(to, level)?);
            Ok(c.emit_pair(level, Arm { from, to }))
        };
        let (d, v) = (arm(self, Level::Position)?, arm(self, Level::Velocity)?);
        self.turning_of_arm(
            d,
            v,
            level,
            |c| arm(c, Level::Acceleration),
            |c| c.turning(l, Level::Velocity),
        )
    }

    /// The velocity or acceleration of the point of a link that coincides with a point.
    pub(super) fn carried(
        &mut self,
        p: PointId,
        l: LinkId,
        level: Level,
    ) -> Result<RegPair, NoKernel> {
        if self.scene.links[l.0].points.contains(&p) || level == Level::Position {
            return self.point(p, level);
        }
        let base = match self.m.passive[l.0] {
            Some(Passive::Block(g)) => match self.scene.guides[g.0].pin {
                Some(pin) if pin == p => return self.point(p, level),
                Some(pin) => MovingPoint::Pin(pin),
                None => return Err(self.lost(l)),
            },
            Some(Passive::Cylinder(_) | Passive::Held(..)) => {
                let (a, _) = self.m.line_of(self.scene, l).ok_or_else(|| self.lost(l))?;
                MovingPoint::Pin(a)
            }
            None => MovingPoint::Own(l),
        };
        let (from, to) = (self.spot(base, Level::Position)?, self.point(p, Level::Position)?);
        let r = self.emit_pair(Level::Position, Arm { from, to });
        let omega = self.turning(l, Level::Velocity)?;
        let v = self.spot(base, level)?;
        Ok(match level {
            Level::Acceleration => {
                let alpha = self.turning(l, Level::Acceleration)?;
                self.emit_pair(level, SwingRate { a: v, r, omega, alpha })
            }
            Level::Position | Level::Velocity => self.emit_pair(level, ArmSwing { v, r, omega }),
        })
    }
}
