//! Operations for the positions of a group, and the rows of its legs for velocities and
//! accelerations.

use super::driver::Rates;
use super::rate::LegCondition;
use super::{Compiler, LinkReference, MovingPoint, NoKernel};
use crate::carry::{Arm, Image, Product, Twist};
use crate::closure::{CircleLine, Circles, ClosureCrossing, Lines, SlotLever};
use crate::kernel::{Reg, RegPair};
use crate::program::{Joint, Op};
use crate::reading::{Quotient, VectorLength};
use hodograph_base::geom::{Point, Vec2};
use hodograph_mechanism::mechanism::{Core, CoreLoci, Hold, Leg, Level, Strut};
use hodograph_mechanism::position::{Path, Pose};
use hodograph_scene::{GuideId, LinkId, PointId};

/// The locus of a point by one leg, with its centre, or a point and direction, at the instant.
#[derive(Clone, Copy)]
pub(super) enum LegLocus {
    Circle { centre: RegPair, radius: Reg, now: Point },
    Line { through: RegPair, direction: RegPair, now: (Point, Vec2) },
}

const P: Level = Level::Position;

impl Compiler<'_> {
    /// Brings a group, and the groups that it depends on, to a level.
    pub(super) fn group(&mut self, g: usize, level: Level) -> Result<(), NoKernel> {
        if self.done[g].is_none() {
            self.done[g] = Some(P);
            self.place(g)?;
        }
        if self.done[g] < Some(Level::Velocity) && level >= Level::Velocity {
            self.done[g] = Some(Level::Velocity);
            self.velocities(g)?;
        }
        if self.done[g] < Some(Level::Acceleration) && level >= Level::Acceleration {
            self.done[g] = Some(Level::Acceleration);
            self.accelerations(g)?;
        }
        Ok(())
    }

    fn place(&mut self, g: usize) -> Result<(), NoKernel> {
        let m = self.m;
        if self.train(g)? {
            return Ok(());
        }
        match &m.groups[g].core {
            Core::Pin { pin, legs } => self.place_pin(g, *pin, legs),
            Core::Link { link, legs } => self.place_link(g, *link, legs),
            Core::Higher => Err(self.without_kernel(g)),
        }
    }

    fn place_pin(&mut self, g: usize, pin: PointId, legs: &[Leg]) -> Result<(), NoKernel> {
        let entry = CoreLoci::of(legs);
        let at = match (entry.carrier, &entry.holds[..]) {
            (Some(link), _) => {
                let local =
                    self.at.shapes.local(link, pin).ok_or_else(|| self.without_kernel(g))?;
                self.rows[g].push(LegCondition::Carried { at: MovingPoint::Fixed(link, local) });
                self.spot(MovingPoint::Fixed(link, local), P)?
            }
            (None, [Hold::Guide { guide, driver: Some(driver), .. }]) => {
                self.driven_along(g, MovingPoint::Pin(pin), *guide, *driver)?
            }
            (None, [first, second]) => {
                let a = self.locus_of_pin(g, pin, first)?;
                let b = self.locus_of_pin(g, pin, second)?;
                let now = self.now(MovingPoint::Pin(pin));
                self.meet(g, a, b, now)?
            }
            _ => return Err(self.without_kernel(g)),
        };
        self.points[pin.0][P as usize] = Some(at);
        for hold in &entry.holds {
            let Hold::Distance { far, strut, .. } = *hold else { continue };
            match strut {
                Strut::Bar(link) => self.bar(link, far, pin)?,
                Strut::Ram { link, guide, driver } => {
                    let (q, _, _) = self.ram(g, link, far, guide, driver)?;
                    let (from, d) = (self.point(far, P)?, self.unit);
                    let line = self.emit_pair(P, Arm { from, to: at });
                    let axis = self.emit_pair(P, Quotient { a: line, b: q });
                    let arm = self.emit_pair(P, Twist { d: axis, k: [d, 0.0] });
                    self.known_by_turning(
                        link,
                        MovingPoint::Pin(far),
                        far,
                        Vec2::new(d, 0.0),
                        arm,
                    )?;
                    self.rows[g].push(LegCondition::Ram { link, far, pin, guide, driver });
                }
                // Barrel and rod do not belong to the group.
                Strut::Cylinder(_) => {}
            }
        }
        Ok(())
    }

    /// Makes the two pins of a bar its reference.
    fn bar(&mut self, link: LinkId, far: PointId, near: PointId) -> Result<(), NoKernel> {
        let (Some(a), Some(b)) =
            (self.at.shapes.local(link, far), self.at.shapes.local(link, near))
        else {
            return Err(self.lost(link));
        };
        self.bodies[link.0] = Some(LinkReference {
            origin: MovingPoint::Pin(far),
            at: a,
            d: b - a,
            between: Some((far, near)),
            own: [None; 3],
            arm: [None; 3],
            turning: [None; 2],
        });
        Ok(())
    }

    /// Makes a pin of a link, and the arm `d` in its frame, its reference; the arm has its position
    /// already.
    pub(super) fn known_by_turning(
        &mut self,
        link: LinkId,
        origin: MovingPoint,
        pin: PointId,
        d: Vec2,
        arm: RegPair,
    ) -> Result<(), NoKernel> {
        let at = self.at.shapes.local(link, pin).ok_or_else(|| self.lost(link))?;
        self.bodies[link.0] = Some(LinkReference {
            origin,
            at,
            d,
            between: None,
            own: [None; 3],
            arm: [Some(arm), None, None],
            turning: [None; 2],
        });
        Ok(())
    }

    fn locus_of_pin(&mut self, g: usize, pin: PointId, hold: &Hold) -> Result<LegLocus, NoKernel> {
        match *hold {
            Hold::Distance { near, far, strut } => {
                self.at_strut(g, MovingPoint::Pin(pin), (near, far), strut)
            }
            Hold::Guide { guide, driver: None, .. } => {
                self.on_guide(g, MovingPoint::Pin(pin), guide)
            }
            Hold::Guide { driver: Some(_), .. }
            | Hold::Slot { .. }
            | Hold::Glide { .. }
            | Hold::Rolls { .. } => Err(self.without_kernel(g)),
        }
    }

    /// The locus of a spot, the pin `near`, at a strut's length from the known pin `far`.
    fn at_strut(
        &mut self,
        g: usize,
        p: MovingPoint,
        (near, far): (PointId, PointId),
        strut: Strut,
    ) -> Result<LegLocus, NoKernel> {
        match strut {
            Strut::Bar(link) => {
                let (Some(a), Some(b)) =
                    (self.at.shapes.local(link, far), self.at.shapes.local(link, near))
                else {
                    return Err(self.lost(link));
                };
                let radius = self.constant(a.distance(b));
                self.circle(
                    g,
                    p,
                    MovingPoint::Pin(far),
                    radius,
                    Rates::NONE,
                    matches!(p, MovingPoint::Pin(_)),
                )
            }
            Strut::Cylinder(driver) => {
                let (radius, rates) = (self.driver_value(driver)?, self.driver_rates(driver)?);
                self.circle(g, p, MovingPoint::Pin(far), radius, rates, false)
            }
            Strut::Ram { link, guide, driver } => {
                let (q, way, rates) = self.ram(g, link, far, guide, driver)?;
                let radius = self.emit(P, VectorLength { v: q }, 1);
                let LegLocus::Circle { centre, now, .. } =
                    self.circle(g, p, MovingPoint::Pin(far), way, rates, false)?
                else {
                    return Err(self.without_kernel(g));
                };
                Ok(LegLocus::Circle { centre, radius, now })
            }
        }
    }

    /// The locus of a spot at a distance from another; adds its row.
    fn circle(
        &mut self,
        g: usize,
        p: MovingPoint,
        far: MovingPoint,
        l: Reg,
        rates: Rates,
        bar: bool,
    ) -> Result<LegLocus, NoKernel> {
        let centre = self.spot(far, P)?;
        self.rows[g].push(LegCondition::Distance { p, far, l, rates, bar });
        Ok(LegLocus::Circle { centre, radius: l, now: self.now(far) })
    }

    /// The locus of a spot on a guide of a known link.
    fn on_guide(&mut self, g: usize, p: MovingPoint, guide: GuideId) -> Result<LegLocus, NoKernel> {
        let on = self.scene.guides[guide.0].on;
        if let Some(slot) = self.slot(guide)? {
            let Some(Path::Line { through, direction }) = self.at.guides[guide.0] else {
                return Err(self.without_kernel(g));
            };
            self.rows[g].push(LegCondition::Guided { p, on, n: slot.normal, rates: Rates::NONE });
            return Ok(LegLocus::Line {
                through: slot.through,
                direction: slot.direction,
                now: (through, direction),
            });
        }
        let Some(Path::Arc { centre, radius }) = self.at.shapes.guides[guide.0] else {
            return Err(self.without_kernel(g));
        };
        let radius = self.constant(radius);
        self.circle(g, p, MovingPoint::Fixed(on, centre), radius, Rates::NONE, false)
    }

    /// The meeting point of two loci, on the branch of the instant.
    fn meet(
        &mut self,
        g: usize,
        a: LegLocus,
        b: LegLocus,
        now: Point,
    ) -> Result<RegPair, NoKernel> {
        // Below this sine the instant itself is at a change of branch, and the closure chosen there
        // counts.
        const DECIDED: f64 = 1e-7;
        let chosen = if self.at.closures[g] == 0 { 1.0 } else { -1.0 };
        let sign = |sine: f64| if sine.abs() > DECIDED { sine.signum() } else { chosen };
        let out = match (a, b) {
            (
                LegLocus::Circle { centre: a, radius: r, now: p },
                LegLocus::Circle { centre: b, radius: s, now: q },
            ) => {
                let (d, u) = (q - p, now - p);
                let sign = sign(d.cross(u) / (d.norm() * u.norm()));
                let closure = Circles { a, r, b, s, sign };
                self.joint(g, ClosureCrossing(closure));
                let out = self.emit(P, closure, 3);
                return Ok(RegPair { x: out, y: Reg(out.0 + 1) });
            }
            (
                LegLocus::Circle { centre: a, radius: r, now: c },
                LegLocus::Line { through: q, direction: t, now: (_, u) },
            )
            | (
                LegLocus::Line { through: q, direction: t, now: (_, u) },
                LegLocus::Circle { centre: a, radius: r, now: c },
            ) => {
                let d = now - c;
                let sign = sign(u.dot(d) / d.norm());
                let closure = CircleLine { a, r, q, t, sign };
                self.joint(g, ClosureCrossing(closure));
                self.emit(P, closure, 2)
            }
            (
                LegLocus::Line { through: p, direction: u, .. },
                LegLocus::Line { through: q, direction: w, .. },
            ) => self.emit(P, Lines { p, u, q, w }, 2),
        };
        Ok(RegPair { x: out, y: Reg(out.0 + 1) })
    }

    /// Records that the next step of positions closes a group and can miss; `crossing` is the sin²
    /// of the angle at which its loci cross.
    fn joint(&mut self, g: usize, crossing: impl Into<Op>) {
        let crossing = self.emit(P, crossing, 1);
        let group = &self.m.groups[g];
        let pin = match &group.core {
            Core::Pin { pin, .. } => Some(*pin),
            Core::Link { .. } | Core::Higher => None,
        };
        self.joints.push(Joint {
            group: g,
            step: self.steps[P as usize].len(),
            crossing,
            links: group.links.clone(),
            pin,
        });
    }

    fn place_link(&mut self, g: usize, link: LinkId, legs: &[Leg]) -> Result<(), NoKernel> {
        let CoreLoci { pivot, angle, holds, .. } = CoreLoci::of(legs);
        if let Some((of, driver)) = angle {
            let (d, arm) = self.arm_at_angle(g, link, of, driver)?;
            let rates = driver.map_or(Ok(Rates::NONE), |d| self.driver_rates(d))?;
            self.rows[g].push(LegCondition::Turning { of, rates });
            match pivot {
                Some(pin) => self.known_by_turning(link, MovingPoint::Pin(pin), pin, d, arm)?,
                None => self.shifted(g, link, &holds, d, arm)?,
            }
        } else if let Some(pin) = pivot {
            self.lever(g, link, pin, &holds)?;
        } else {
            self.triad(g, link, &holds)?;
        }
        // The group's pins are on the core.
        for &p in &self.m.groups[g].pins.clone() {
            let local = self.at.shapes.local(link, p).ok_or_else(|| self.without_kernel(g))?;
            self.points[p.0][P as usize] = Some(self.spot(MovingPoint::Fixed(link, local), P)?);
        }
        for (bar, near, far) in holds.iter().filter_map(Hold::bar) {
            self.bar(bar, far, near)?;
        }
        Ok(())
    }

    /// The arm of a link whose angle relative to a known one is driven, or stays that of the
    /// instant: in its frame, and in the plane.
    fn arm_at_angle(
        &mut self,
        g: usize,
        link: LinkId,
        of: LinkId,
        driver: Option<usize>,
    ) -> Result<(Vec2, RegPair), NoKernel> {
        let pose = |c: &Self, l: LinkId| {
            if l == c.scene.ground { Some(Pose::GROUND) } else { c.at.poses[l.0] }
        };
        let Some(driver) = driver else {
            let (Some(own), Some(base)) = (pose(self, link), pose(self, of)) else {
                return Err(self.without_kernel(g));
            };
            let d = Vec2::new(self.unit, 0.0);
            let arm = self.direction_on(of, own.axis.divide_by(base.axis) * self.unit)?;
            return Ok((d, arm));
        };
        let kind = &self.scene.drivers[driver].kind;
        if kind.turned().is_none_or(|(driven, _)| driven != link) {
            return Err(self.without_kernel(g));
        }
        let [line, against_line] = kind.lines();
        let local = |c: &Self, l: LinkId, line: Option<(PointId, PointId)>| -> Option<Vec2> {
            let (a, b) = match (line, &c.scene.links[l.0].points[..]) {
                (Some(line), _) => line,
                (None, [a, b, ..]) => (*a, *b),
                (None, _) => return Some(Vec2::new(c.unit, 0.0)),
            };
            Some(c.at.shapes.local(l, b)? - c.at.shapes.local(l, a)?)
        };
        let own = local(self, link, line).ok_or_else(|| self.without_kernel(g))?;
        let turn = self.driver_turn(driver, None)?;
        let base = if of == self.scene.ground && against_line.is_none() {
            Vec2::new(1.0, 0.0)
        } else {
            local(self, of, against_line).ok_or_else(|| self.without_kernel(g))?
        };
        let along = base * (own.norm() / base.norm());
        let arm = if of == self.scene.ground {
            self.emit_pair(P, Twist { d: turn, k: [along.x, along.y] })
        } else {
            let along = self.direction_on(of, along)?;
            self.emit_pair(P, Product { a: turn, b: along })
        };
        Ok((own, arm))
    }

    /// Places a link with a known angle, held by two legs, or by a driver along a guide.
    fn shifted(
        &mut self,
        g: usize,
        link: LinkId,
        holds: &[Hold],
        d: Vec2,
        arm: RegPair,
    ) -> Result<(), NoKernel> {
        let at = self.own_point(link, holds);
        self.bodies[link.0] = Some(LinkReference {
            origin: MovingPoint::Own(link),
            at,
            d,
            between: None,
            own: [None; 3],
            arm: [Some(arm), None, None],
            turning: [None; 2],
        });
        let own = match holds {
            [Hold::Glide { guide, driver: Some(driver), .. }] => {
                self.driven_along(g, MovingPoint::Own(link), *guide, *driver)?
            }
            [a, b] => {
                let (a, b) = (self.locus_of_link(g, link, a)?, self.locus_of_link(g, link, b)?);
                let now = self.now(MovingPoint::Own(link));
                self.meet(g, a, b, now)?
            }
            _ => return Err(self.without_kernel(g)),
        };
        if let Some(body) = &mut self.bodies[link.0] {
            body.own[P as usize] = Some(own);
        }
        Ok(())
    }

    /// The reference point of a link on legs: the point at which its first leg holds it.
    pub(super) fn own_point(&self, link: LinkId, holds: &[Hold]) -> Point {
        let near = holds.iter().find_map(Hold::near);
        let local = near.and_then(|p| self.at.shapes.local(link, p));
        local.or(self.at.shapes.points[link.0].first().map(|(_, at)| *at)).unwrap_or(Point::ORIGIN)
    }

    /// The locus of a link's own point, for a known arm.
    fn locus_of_link(&mut self, g: usize, link: LinkId, hold: &Hold) -> Result<LegLocus, NoKernel> {
        let (spot, locus) = self.held(g, link, hold)?;
        // The vector from the held point to the link's own point.
        let body = self.bodies[link.0].as_ref().ok_or_else(|| self.lost(link))?;
        let back = match spot {
            MovingPoint::Fixed(l, local) if l == link => body.at - local,
            MovingPoint::Pin(_) | MovingPoint::Own(_) | MovingPoint::Fixed(..) => Vec2::ZERO,
        };
        if back == Vec2::ZERO {
            return Ok(locus);
        }
        let k = back.divide_by(body.d);
        let (k, d) = ([k.x, k.y], self.arm(link, P)?);
        let turned = self.at.poses[link.0].map_or(back, |pose| pose.turn(back));
        Ok(match locus {
            LegLocus::Circle { centre, radius, now } => LegLocus::Circle {
                centre: self.emit_pair(P, Image { o: centre, d, k }),
                radius,
                now: now + turned,
            },
            LegLocus::Line { through, direction, now } => LegLocus::Line {
                through: self.emit_pair(P, Image { o: through, d, k }),
                direction,
                now: (now.0 + turned, now.1),
            },
        })
    }

    /// The point of a link that a leg holds, and the locus of that point; adds the leg's row.
    pub(super) fn held(
        &mut self,
        g: usize,
        link: LinkId,
        hold: &Hold,
    ) -> Result<(MovingPoint, LegLocus), NoKernel> {
        let local =
            |c: &Self, p: PointId| c.at.shapes.local(link, p).ok_or_else(|| c.without_kernel(g));
        match *hold {
            Hold::Distance { near, far, strut } => {
                let spot = MovingPoint::Fixed(link, local(self, near)?);
                Ok((spot, self.at_strut(g, spot, (near, far), strut)?))
            }
            Hold::Guide { pin, guide, driver: None } => {
                let spot = MovingPoint::Fixed(link, local(self, pin)?);
                Ok((spot, self.on_guide(g, spot, guide)?))
            }
            Hold::Slot { pin, guide } => self.in_slot(g, link, MovingPoint::Pin(pin), guide),
            Hold::Glide { guide, other, driver: None } => {
                if self.scene.guides[guide.0].on == other {
                    let at = self.bodies[link.0].as_ref().ok_or_else(|| self.lost(link))?.at;
                    let spot = MovingPoint::Fixed(link, at);
                    let slot = self.slot(guide)?.ok_or_else(|| self.without_kernel(g))?;
                    let Some(Path::Line { direction, .. }) = self.at.guides[guide.0] else {
                        return Err(self.without_kernel(g));
                    };
                    // The slider keeps its distance from the guide of the instant.
                    let now = self.now(spot);
                    let pose = self.at.poses[other.0].unwrap_or(Pose::GROUND);
                    let through = self.spot(MovingPoint::Fixed(other, pose.to_local(now)), P)?;
                    self.rows[g].push(LegCondition::Guided {
                        p: spot,
                        on: other,
                        n: slot.normal,
                        rates: Rates::NONE,
                    });
                    Ok((
                        spot,
                        LegLocus::Line {
                            through,
                            direction: slot.direction,
                            now: (now, direction),
                        },
                    ))
                } else {
                    self.in_slot(g, link, MovingPoint::Own(other), guide)
                }
            }
            Hold::Rolls { pair, other, .. } => {
                let (spot, through, direction) = self.along_track(link, pair)?;
                let n = self.tangent(pair)?;
                self.rows[g].push(LegCondition::Rolled { pair, other, n });
                let normal =
                    self.at.normal(self.scene, pair).ok_or_else(|| self.without_kernel(g))?;
                Ok((spot, LegLocus::Line { through, direction, now: (self.now(spot), normal) }))
            }
            Hold::Guide { driver: Some(_), .. } | Hold::Glide { driver: Some(_), .. } => {
                Err(self.without_kernel(g))
            }
        }
    }

    /// A slot of the link over a known point: the held point of the link is the beginning of the
    /// slot's line.
    fn in_slot(
        &mut self,
        g: usize,
        link: LinkId,
        over: MovingPoint,
        guide: GuideId,
    ) -> Result<(MovingPoint, LegLocus), NoKernel> {
        match self.at.shapes.guides[guide.0] {
            Some(Path::Line { through, direction }) => {
                let through = match over {
                    // A gliding link keeps the distance of the instant.
                    MovingPoint::Pin(_) => through,
                    MovingPoint::Own(_) | MovingPoint::Fixed(..) => {
                        self.at.poses[link.0].map_or(through, |pose| pose.to_local(self.now(over)))
                    }
                };
                let spot = MovingPoint::Fixed(link, through);
                let at = self.spot(over, P)?;
                let (t, n) = (
                    self.direction_on(link, direction)?,
                    self.direction_on(link, direction.perp())?,
                );
                self.rows[g].push(LegCondition::Slot { link, over, n });
                let turned = self.at.poses[link.0].map_or(direction, |pose| pose.turn(direction));
                Ok((
                    spot,
                    LegLocus::Line { through: at, direction: t, now: (self.now(over), turned) },
                ))
            }
            Some(Path::Arc { centre, radius }) => {
                let (spot, radius) = (MovingPoint::Fixed(link, centre), self.constant(radius));
                Ok((spot, self.circle(g, spot, over, radius, Rates::NONE, false)?))
            }
            None => Err(self.without_kernel(g)),
        }
    }

    /// Places a link on a known pivot, with a slot over a known pin.
    fn lever(
        &mut self,
        g: usize,
        link: LinkId,
        pivot: PointId,
        holds: &[Hold],
    ) -> Result<(), NoKernel> {
        let (&[Hold::Slot { pin, guide }], Some(at)) = (holds, self.at.shapes.local(link, pivot))
        else {
            return Err(self.without_kernel(g));
        };
        let (a, b) = (self.point(pivot, P)?, self.point(pin, P)?);
        match self.at.shapes.guides[guide.0] {
            Some(Path::Line { through, direction }) => {
                let runner = self.at.poses[link.0]
                    .map(|pose| pose.to_local(self.now(MovingPoint::Pin(pin))))
                    .ok_or_else(|| self.lost(link))?;
                let ahead = direction.dot(runner - at);
                let span = (runner - at).norm();
                let chosen = if self.at.closures[g] == 0 { 1.0 } else { -1.0 };
                let sign = if ahead.abs() > 1e-7 * span { ahead.signum() } else { chosen };
                // Relative to the slot's direction, the frame's x axis is its conjugate.
                let k = [direction.x * self.unit, -direction.y * self.unit];
                let closure = SlotLever { a, b, h: direction.cross(through - at), sign, k };
                self.joint(g, ClosureCrossing(closure));
                let arm = self.emit_pair(P, closure);
                self.known_by_turning(
                    link,
                    MovingPoint::Pin(pivot),
                    pivot,
                    Vec2::new(self.unit, 0.0),
                    arm,
                )?;
                let n = self.direction_on(link, direction.perp())?;
                self.rows[g].push(LegCondition::Slot { link, over: MovingPoint::Pin(pin), n });
            }
            Some(Path::Arc { centre, radius }) => {
                let (r, s) = (self.constant(at.distance(centre)), self.constant(radius));
                let nows = (self.now(MovingPoint::Pin(pivot)), self.now(MovingPoint::Pin(pin)));
                let first = LegLocus::Circle { centre: a, radius: r, now: nows.0 };
                let second = LegLocus::Circle { centre: b, radius: s, now: nows.1 };
                let k = self.at.poses[link.0].ok_or_else(|| self.lost(link))?.to_world(centre);
                let k = self.meet(g, first, second, k)?;
                let arm = self.emit_pair(P, Arm { from: a, to: k });
                self.known_by_turning(link, MovingPoint::Pin(pivot), pivot, centre - at, arm)?;
                self.rows[g].push(LegCondition::Distance {
                    p: MovingPoint::Fixed(link, centre),
                    far: MovingPoint::Pin(pin),
                    l: s,
                    rates: Rates::NONE,
                    bar: false,
                });
            }
            None => return Err(self.without_kernel(g)),
        }
        Ok(())
    }
}
