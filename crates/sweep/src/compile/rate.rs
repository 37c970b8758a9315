//! Operations for velocities and accelerations of a group: a row for each leg, and the solution of
//! the rows.

use super::driver::Rates;
use super::{Compiler, MovingPoint, NoKernel};
use crate::carry::{Arm, ArmTurning, PointAlong};
use crate::kernel::{Reg, RegPair};
use crate::program::Op;
use crate::reading::{Dot, WeightedSum};
use crate::rows::{
    Bars, BarsRate, Cross, Distance, DistanceRate, Guided, GuidedRate, Reduced, ReducedRate,
    SlotRate, Three, TurnOf,
};
use hodograph_base::geom::Vec2;
use hodograph_mechanism::mechanism::{Core, Level};
use hodograph_mechanism::position::Path;
use hodograph_scene::{GuideId, LinkId, PointId, RollingId};

/// The condition of a leg on the motion of a group's core. Rates are those of a driver, or zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum LegCondition {
    /// A pin on a known link.
    Carried { at: MovingPoint },
    /// `p` keeps the distance `l` from `far`; two rows with `bar` make the RRR dyad.
    Distance { p: MovingPoint, far: MovingPoint, l: Reg, rates: Rates, bar: bool },
    /// `p` moves at a rate along `n`, fixed in a known link.
    Guided { p: MovingPoint, on: LinkId, n: RegPair, rates: Rates },
    /// A slot of the core link, square to `n`, runs over a known point.
    Slot { link: LinkId, over: MovingPoint, n: RegPair },
    /// The core link turns relative to a known one at a rate.
    Turning { of: LinkId, rates: Rates },
    /// The core link rolls on a known one: at the contact both have one velocity along `n`, and
    /// equal components of their accelerations along it.
    Rolled { pair: RollingId, other: LinkId, n: RegPair },
    /// A link pinned at `far`, along whose guide a driver pushes the core pin: it follows.
    Ram { link: LinkId, far: PointId, pin: PointId, guide: GuideId, driver: usize },
}

const V: Level = Level::Velocity;
const A: Level = Level::Acceleration;
const P: Level = Level::Position;

impl Compiler<'_> {
    pub(super) fn velocities(&mut self, g: usize) -> Result<(), NoKernel> {
        let m = self.m;
        if self.trains.has_placed(g) {
            return self.train_at(g, V);
        }
        match &m.groups[g].core {
            Core::Pin { pin, .. } => self.pin_at(g, *pin, V),
            Core::Link { link, .. } => self.link_at(g, *link, V),
            Core::Higher => Err(self.without_kernel(g)),
        }
    }

    pub(super) fn accelerations(&mut self, g: usize) -> Result<(), NoKernel> {
        let m = self.m;
        if self.trains.has_placed(g) {
            return self.train_at(g, A);
        }
        match &m.groups[g].core {
            Core::Pin { pin, .. } => self.pin_at(g, *pin, A),
            Core::Link { link, .. } => self.link_at(g, *link, A),
            Core::Higher => Err(self.without_kernel(g)),
        }
    }

    /// The velocity or acceleration of a core pin.
    fn pin_at(&mut self, g: usize, pin: PointId, level: Level) -> Result<(), NoKernel> {
        // The rows are put back below: nothing else needs the rows of a group while it is solved.
        let rows = std::mem::take(&mut self.rows[g]);
        let mut solved = rows.iter().filter(|r| !matches!(r, LegCondition::Ram { .. }));
        let pair = match (solved.next(), solved.next(), solved.next()) {
            (Some(LegCondition::Carried { at }), None, _) => self.spot(*at, level)?,
            (
                Some(LegCondition::Distance { far: a, bar: true, .. }),
                Some(LegCondition::Distance { far: b, bar: true, .. }),
                None,
            ) => self.two_bars(g, pin, *a, *b, level)?,
            (Some(first), Some(second), None) => match self.led_on_ground(first, second, level) {
                Some(pair) => pair,
                None => {
                    let (n1, _, c1) = self.row(first, None, level)?;
                    let (n2, _, c2) = self.row(second, None, level)?;
                    self.emit_pair(level, Cross { n1, c1, n2, c2 })
                }
            },
            _ => return Err(self.without_kernel(g)),
        };
        self.points[pin.0][level as usize] = Some(pair);
        for row in &rows {
            if let LegCondition::Ram { link, far, pin, guide, driver } = *row {
                let turning = self.turning_of_ram(link, far, pin, guide, driver, level)?;
                if let Some(body) = &mut self.bodies[link.0] {
                    body.turning[level as usize - 1] = Some(turning);
                }
            }
        }
        self.rows[g] = rows;
        Ok(())
    }

    /// The RRR dyad, in one operation for each effect.
    fn two_bars(
        &mut self,
        g: usize,
        pin: PointId,
        a: MovingPoint,
        b: MovingPoint,
        level: Level,
    ) -> Result<RegPair, NoKernel> {
        let joint =
            self.joints.iter().find(|j| j.group == g).ok_or_else(|| self.without_kernel(g))?;
        let det = Reg(self.steps[P as usize][joint.step].out.0 + 2);
        let bars = Bars {
            c: self.point(pin, P)?,
            a: self.spot(a, P)?,
            b: self.spot(b, P)?,
            va: self.spot(a, V)?,
            vb: self.spot(b, V)?,
            det,
        };
        if level == V {
            let out = self.emit(V, bars, 3);
            return Ok(RegPair { x: out, y: Reg(out.0 + 1) });
        }
        let vc = self.point(pin, V)?;
        let (aa, ab) = (self.spot(a, A)?, self.spot(b, A)?);
        Ok(self.emit_pair(A, BarsRate { bars, vc, aa, ab, inverse: Reg(vc.x.0 + 2) }))
    }

    /// Velocity or acceleration of a core link's own point, and its angular velocity or
    /// acceleration.
    fn link_at(&mut self, g: usize, link: LinkId, level: Level) -> Result<(), NoKernel> {
        let rows = self.rows[g].clone();
        let turned = rows.iter().find_map(|r| {
            if let LegCondition::Turning { of, rates } = r { Some((*of, *rates)) } else { None }
        });
        let held: Vec<LegCondition> =
            rows.into_iter().filter(|r| !matches!(r, LegCondition::Turning { .. })).collect();
        let slot = level as usize - 1;
        if let Some((of, rates)) = turned {
            let turning = self.turned(of, rates, level)?;
            self.set_turning(link, slot, turning);
            if let [first, second] = held[..] {
                let own = match self.led_on_ground(&first, &second, level) {
                    Some(own) => own,
                    None => {
                        let (n1, c1) = self.reduced(&first, link, level)?;
                        let (n2, c2) = self.reduced(&second, link, level)?;
                        self.emit_pair(level, Cross { n1, c1, n2, c2 })
                    }
                };
                self.set_own(link, level, own);
            }
        } else if let [only] = held[..] {
            let (n, r, c) = self.row(&only, Some(link), level)?;
            let r = r.ok_or_else(|| self.without_kernel(g))?;
            let c = self.without_centripetal(link, n, r, c, level)?;
            let v = self.spot(MovingPoint::Own(link), level)?;
            let turning = self.emit(level, TurnOf { n, r, c, v }, 1);
            self.set_turning(link, slot, turning);
        } else if let [first, second, third] = held[..] {
            let mut three = Vec::new();
            for row in [first, second, third] {
                let (n, r, c) = self.row(&row, Some(link), level)?;
                let r = r.ok_or_else(|| self.without_kernel(g))?;
                three.push((n, r, self.without_centripetal(link, n, r, c, level)?));
            }
            let rows = [three[0], three[1], three[2]];
            let out = self.emit(level, Three { rows }, 3);
            self.set_own(link, level, RegPair { x: out, y: Reg(out.0 + 1) });
            self.set_turning(link, slot, Reg(out.0 + 2));
        } else {
            return Err(self.without_kernel(g));
        }
        for &p in &self.m.groups[g].pins.clone() {
            let local = self.at.shapes.local(link, p).ok_or_else(|| self.without_kernel(g))?;
            self.points[p.0][level as usize] =
                Some(self.spot(MovingPoint::Fixed(link, local), level)?);
        }
        Ok(())
    }

    pub(super) fn set_turning(&mut self, link: LinkId, slot: usize, turning: Reg) {
        if let Some(body) = &mut self.bodies[link.0] {
            body.turning[slot] = Some(turning);
        }
    }

    fn set_own(&mut self, link: LinkId, level: Level, own: RegPair) {
        if let Some(body) = &mut self.bodies[link.0] {
            body.own[level as usize] = Some(own);
        }
    }

    /// Angular velocity or acceleration of a link that turns relative to a known one at a rate.
    fn turned(&mut self, of: LinkId, rates: Rates, level: Level) -> Result<Reg, NoKernel> {
        let (rate, led) = rates.parts(level);
        if of == self.scene.ground {
            return Ok(led.unwrap_or_else(|| self.constant(rate)));
        }
        let base = self.turning(of, level)?;
        match led {
            Some(led) => Ok(self.emit(level, WeightedSum { a: base, b: led, k: 1.0 }, 1)),
            None if rate == 0.0 => Ok(base),
            None => {
                let one = self.constant(1.0);
                Ok(self.emit(level, WeightedSum { a: base, b: one, k: rate }, 1))
            }
        }
    }

    /// The velocity or acceleration of a point led by a cam along a guide of the ground: the rate
    /// times the direction of the guide.
    fn led_on_ground(
        &mut self,
        first: &LegCondition,
        second: &LegCondition,
        level: Level,
    ) -> Option<RegPair> {
        let (
            LegCondition::Guided { on: a, rates: Rates::Even([0.0, 0.0]), .. },
            LegCondition::Guided { on: b, n, rates, .. },
        ) = (first, second)
        else {
            return None;
        };
        let s = rates.parts(level).1.filter(|_| *a == self.scene.ground && a == b)?;
        let q = self.fixed(Vec2::ZERO);
        Some(self.emit_pair(level, PointAlong { q, t: *n, s }))
    }

    /// Adds, for accelerations, the centripetal part to the row of a link's point: c + ω² n·r.
    fn without_centripetal(
        &mut self,
        link: LinkId,
        n: RegPair,
        r: RegPair,
        c: Reg,
        level: Level,
    ) -> Result<Reg, NoKernel> {
        if level == V {
            return Ok(c);
        }
        let (omega, alpha) = (self.turning(link, V)?, self.zero());
        Ok(self.emit(A, ReducedRate { n, r, c, omega, alpha }, 1))
    }

    /// The row of a link's own point for a known angular velocity.
    fn reduced(
        &mut self,
        row: &LegCondition,
        link: LinkId,
        level: Level,
    ) -> Result<(RegPair, Reg), NoKernel> {
        let (n, r, c) = self.row(row, Some(link), level)?;
        let Some(r) = r else { return Ok((n, c)) };
        let omega = self.turning(link, V)?;
        let c = match level {
            A => {
                let alpha = self.turning(link, A)?;
                self.emit(A, ReducedRate { n, r, c, omega, alpha }, 1)
            }
            P | V => self.emit(V, Reduced { n, r, c, omega }, 1),
        };
        Ok((n, c))
    }

    /// The normal n, the arm from the core link's own point to the point that the leg holds (with a
    /// core link), and c.
    fn row(
        &mut self,
        row: &LegCondition,
        core: Option<LinkId>,
        level: Level,
    ) -> Result<(RegPair, Option<RegPair>, Reg), NoKernel> {
        match *row {
            LegCondition::Distance { p, far, l, rates, .. } => {
                let Rates::Even([rate, acceleration]) = rates else {
                    unreachable!("no cam leads a cylinder")
                };
                let n = self.between(far, p)?;
                let r = self.arm_to(core, p)?;
                let vf = self.spot(far, V)?;
                let c = match level {
                    A => {
                        let (vp, af) = (self.spot(p, V)?, self.spot(far, A)?);
                        self.emit(A, DistanceRate { n, vp, vf, af, l, rate, acceleration }, 1)
                    }
                    P | V => self.emit(V, Distance { n, vf, l, rate }, 1),
                };
                Ok((n, r, c))
            }
            LegCondition::Guided { p, on, n, rates } => {
                let (rate, led) = rates.parts(level);
                let reach = self.arm_to(core, p)?;
                // A guide on ground does not move; the start of its arm does not enter.
                let (r, vo, omega) = match on == self.scene.ground {
                    true => (self.fixed(Vec2::ZERO), self.fixed(Vec2::ZERO), self.zero()),
                    false => (
                        self.between(MovingPoint::Own(on), p)?,
                        self.spot(MovingPoint::Own(on), V)?,
                        self.turning(on, V)?,
                    ),
                };
                let c = match level {
                    A => {
                        let (vp, ao, alpha) = (
                            self.spot(p, V)?,
                            self.spot(MovingPoint::Own(on), A)?,
                            self.turning(on, A)?,
                        );
                        self.emit(
                            A,
                            GuidedRate { n, r, vp, vo, ao, omega, alpha, acceleration: rate },
                            1,
                        )
                    }
                    P | V => self.emit(V, Guided { n, r, vo, omega, rate }, 1),
                };
                let c =
                    led.map_or(c, |led| self.emit(level, WeightedSum { a: c, b: led, k: 1.0 }, 1));
                Ok((n, reach, c))
            }
            LegCondition::Slot { link, over, n } => {
                let r = self.between(MovingPoint::Own(link), over)?;
                let vb = self.spot(over, V)?;
                let c = match level {
                    A => {
                        let (ab, vo, omega) = (
                            self.spot(over, A)?,
                            self.spot(MovingPoint::Own(link), V)?,
                            self.turning(link, V)?,
                        );
                        self.emit(A, SlotRate { n, r, vb, ab, vo, omega }, 1)
                    }
                    P | V => {
                        let l = self.zero();
                        self.emit(V, Distance { n, vf: vb, l, rate: 0.0 }, 1)
                    }
                };
                Ok((n, Some(r), c))
            }
            LegCondition::Rolled { pair, other, n } => {
                let place = self.contact(pair, self.scene.rolling[pair.0].at[0])?;
                let v = self.of_link_at(other, place, level)?;
                let c = self.emit(level, Dot { u: n, v }, 1);
                let r = match core {
                    Some(l) => {
                        let from = self.spot(MovingPoint::Own(l), P)?;
                        Some(self.emit_pair(P, Arm { from, to: place }))
                    }
                    None => None,
                };
                Ok((n, r, c))
            }
            LegCondition::Carried { .. }
            | LegCondition::Turning { .. }
            | LegCondition::Ram { .. } => {
                unreachable!("these are no rows of a place")
            }
        }
    }

    /// The arm from one spot to another, emitted once.
    pub(super) fn between(
        &mut self,
        from: MovingPoint,
        to: MovingPoint,
    ) -> Result<RegPair, NoKernel> {
        let (from, to) = (self.spot(from, P)?, self.spot(to, P)?);
        let arm = Arm { from, to };
        if let Some(step) = self.steps[P as usize].iter().find(|s| s.op == Op::Arm(arm)) {
            return Ok(RegPair { x: step.out, y: Reg(step.out.0 + 1) });
        }
        Ok(self.emit_pair(P, arm))
    }

    fn arm_to(
        &mut self,
        core: Option<LinkId>,
        p: MovingPoint,
    ) -> Result<Option<RegPair>, NoKernel> {
        match core {
            Some(l) if p != MovingPoint::Own(l) => Ok(Some(self.between(MovingPoint::Own(l), p)?)),
            _ => Ok(None),
        }
    }

    /// Angular velocity or acceleration of a link AB in which a driver pushes B along a guide of
    /// direction t: ω = AB × (v_B − v_A − ṡ t)/|AB|² and α = AB × (a_B − a_A − 2 ω × ṡ t − s̈
    /// t)/|AB|².
    fn turning_of_ram(
        &mut self,
        link: LinkId,
        far: PointId,
        pin: PointId,
        guide: GuideId,
        driver: usize,
        level: Level,
    ) -> Result<Reg, NoKernel> {
        let Some(Path::Line { direction, .. }) = self.at.shapes.guides[guide.0] else {
            return Err(self.lost(link));
        };
        let [rate, acceleration] = self.even_rates(driver)?;
        let d = self.between(MovingPoint::Pin(far), MovingPoint::Pin(pin))?;
        let t = self.direction_on(link, direction)?;
        let (from, to) = (self.point(far, level)?, self.point(pin, level)?);
        let relative = self.emit_pair(level, Arm { from, to });
        let s = self.constant(if level == V { -rate } else { -acceleration });
        let mut v = self.emit_pair(level, PointAlong { q: relative, t, s });
        if level == A {
            let normal = self.direction_on(link, direction.perp())?;
            let omega = self.turning(link, V)?;
            let none = self.zero();
            let twice = self.emit(A, WeightedSum { a: none, b: omega, k: -2.0 * rate }, 1);
            v = self.emit_pair(A, PointAlong { q: v, t: normal, s: twice });
        }
        Ok(self.emit(level, ArmTurning { d, v }, 1))
    }
}
