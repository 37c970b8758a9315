//! Operations for rolling pairs: the angles of trains, wheels and racks on straight tracks, points
//! of contact.
//!
//! The links of a [`AngleTrain`] turn by a sum of angles: the driver's times a whole ratio
//! ([`Geared`]), and those of lines that no train determines. Such a line turns by whole turns with
//! the driver, found once by following it, and by less than half a turn besides ([`Against`]).

use super::{Compiler, MovingPoint, NoKernel};
use crate::carry::{Arm, ArmSwing, Image, PointAlong, Product, SwingRate, Twist};
use crate::kernel::{Reg, RegPair};
use crate::program::{SweepProgram, VALUE};
use crate::reading::{Dot, WeightedSum};
use crate::station::{angle_per_value, position_now};
use crate::train::{AngleRatio, AngleSource, AngleTrain, Combination, add, together};
use crate::turns::{Against, CosineSine, Geared, WayAcceleration, WayRate};
use hodograph_base::diag::{Diagnostic, both};
use hodograph_base::geom::Vec2;
use hodograph_mechanism::mechanism::{Level, PairForm};
use hodograph_mechanism::position::{Path, Pose};
use hodograph_scene::{LinkId, Normal, PointId, Relation, RollingId, Touch};
use std::f64::consts::{PI, TAU};

const P: Level = Level::Position;
const V: Level = Level::Velocity;
const A: Level = Level::Acceleration;

/// The state of the compiler for trains.
pub(super) struct Trains {
    pub train: AngleTrain,
    /// Groups placed by their angles.
    placed: Vec<usize>,
    /// The driver's angle in quarter turns, and its value at the instant.
    pub(super) quarters: Option<(RegPair, [f64; 2])>,
    rotors: Vec<([f64; 2], RegPair)>,
    wound: Vec<(AngleSource, Wound)>,
    /// The turns after which the pose recurs; see [`SweepProgram::turns`].
    pub turns: u64,
    /// The greatest ratio of a wheel; see [`SweepProgram::fastest`].
    pub fastest: f64,
}

/// The rotation since the instant: the part with the driver, and the rest (rad; of a travel on a
/// track: m).
#[derive(Clone, Copy)]
struct Wound {
    turns: AngleRatio,
    rest: Reg,
}

/// The greatest number of turns through which a line is followed to count its turns.
const MOST_TURNS: u64 = 60;

/// The number of steps for each turn, or for the whole of another travel.
const STEPS: f64 = 360.0;

/// The greatest angle of a line in one step (rad) at which its turns can be counted.
const QUICK: f64 = 1.0;

/// The least distance from half a turn (rad), so that angles between the steps stay within half a
/// turn too.
const ASIDE: f64 = 0.5;

impl Trains {
    pub fn new(train: AngleTrain) -> Trains {
        Trains {
            train,
            placed: Vec::new(),
            quarters: None,
            rotors: Vec::new(),
            wound: Vec::new(),
            turns: 1,
            fastest: 1.0,
        }
    }

    pub fn has_placed(&self, g: usize) -> bool {
        self.placed.contains(&g)
    }
}

impl Compiler<'_> {
    /// Places a group whose links have one pin each and turn with others; returns `true` if it is
    /// such a group.
    pub(super) fn train(&mut self, g: usize) -> Result<bool, NoKernel> {
        let Some(hung) = self.hung(g) else { return Ok(false) };
        for (link, pin) in hung {
            let Some(turned) = self.trains.train.of_link(link).cloned() else { return Ok(false) };
            let rotor = self.rotor(&turned)?;
            let axis = self.at.poses[link.0].ok_or_else(|| self.lost(link))?.axis * self.unit;
            let arm = self.emit_pair(P, Twist { d: rotor, k: [axis.x, axis.y] });
            self.known_by_turning(
                link,
                MovingPoint::Pin(pin),
                pin,
                Vec2::new(self.unit, 0.0),
                arm,
            )?;
            self.pins_of(g, link, P)?;
        }
        self.trains.placed.push(g);
        Ok(true)
    }

    /// The links of a group of rolling ones with the pins that carry them, in an order in which
    /// each pin is known; `None` if they are carried otherwise.
    fn hung(&self, g: usize) -> Option<Vec<(LinkId, PointId)>> {
        let group = &self.m.groups[g];
        let forms = || group.constraints.iter().map(|&c| self.m.constraints[c].form());
        let pinned: Vec<(PointId, LinkId)> = forms().filter_map(|f| f.meets()).collect();
        let others = forms().all(|f| {
            matches!(f, PairForm::Meet { .. } | PairForm::Angles { .. } | PairForm::Related { .. })
        });
        let rolls = forms().any(|f| matches!(f, PairForm::Related { .. }));
        let told = group.links.iter().all(|l| self.trains.train.of_link(*l).is_some());
        if !others || !rolls || !told || pinned.len() != group.links.len() + group.pins.len() {
            return None;
        }
        let mut hung: Vec<(LinkId, PointId)> = Vec::new();
        while hung.len() < group.links.len() {
            let is = |l: &LinkId| hung.iter().any(|(k, _)| k == l);
            let placed = |p: &PointId| {
                !group.pins.contains(p) || pinned.iter().any(|(q, l)| q == p && is(l))
            };
            let (pin, link) =
                pinned.iter().find(|(p, l)| group.links.contains(l) && !is(l) && placed(p))?;
            hung.push((*link, *pin));
        }
        Some(hung)
    }

    /// Places the group's pins that are on a link of it and not placed yet.
    fn pins_of(&mut self, g: usize, link: LinkId, level: Level) -> Result<(), NoKernel> {
        for &p in &self.m.groups[g].pins.clone() {
            if self.points[p.0][level as usize].is_none()
                && let Some(local) = self.at.shapes.local(link, p)
            {
                self.points[p.0][level as usize] =
                    Some(self.spot(MovingPoint::Fixed(link, local), level)?);
            }
        }
        Ok(())
    }

    /// Velocities or accelerations of a group placed by its angles.
    pub(super) fn train_at(&mut self, g: usize, level: Level) -> Result<(), NoKernel> {
        for (link, _) in self.hung(g).unwrap_or_default() {
            let turned = self.trains.train.turned(link);
            let turning = self.rate_of(&turned, level)?;
            self.set_turning(link, level as usize - 1, turning);
            self.pins_of(g, link, level)?;
        }
        Ok(())
    }

    /// Cosine and sine of the rotation of a combination since the instant.
    fn rotor(&mut self, turned: &Combination) -> Result<RegPair, NoKernel> {
        let (with, beside) = self.parts(turned)?;
        let geared = (!with.is_zero()).then(|| self.geared(with)).flatten();
        let turned = beside.map(|angle| self.emit_pair(P, CosineSine { angle }));
        Ok(match (geared, turned) {
            (Some(a), Some(b)) => self.emit_pair(P, Product { a, b }),
            (Some(one), None) | (None, Some(one)) => one,
            (None, None) => self.fixed(Vec2::new(1.0, 0.0)),
        })
    }

    /// The part of a combination that turns with the driver's angle, and the sum of the rest.
    fn parts(&mut self, turned: &Combination) -> Result<(AngleRatio, Option<Reg>), NoKernel> {
        let (mut with, mut beside) = (AngleRatio::of(0, 1), None);
        for &(source, ratio) in turned {
            match source {
                AngleSource::Driver(d) if self.driver == Some(d) => with = with.plus(ratio),
                // The other drivers are at rest, unless cams lead them; without a swept driver
                // everything is.
                AngleSource::Driver(d) => drop(self.even_rates(d)?),
                _ if self.driver.is_none() => {}
                AngleSource::Link(_) | AngleSource::Line(..) | AngleSource::Way(_) => {
                    let wound = self.wound(source)?;
                    with = with.plus(ratio.times(wound.turns));
                    beside = Some(self.plus(P, beside, wound.rest, ratio.value));
                }
            }
        }
        Ok((with, beside))
    }

    /// A sum plus k times another number.
    fn plus(&mut self, level: Level, sum: Option<Reg>, b: Reg, k: f64) -> Reg {
        let a = sum.unwrap_or_else(|| self.zero());
        if sum.is_none() && k == 1.0 { b } else { self.emit(level, WeightedSum { a, b, k }, 1) }
    }

    /// Cosine and sine of a ratio of the driver's travel; `None` without a driver.
    fn geared(&mut self, ratio: AngleRatio) -> Option<RegPair> {
        let driver = self.driver?;
        let (quarters, start) = self.quarters(driver);
        let [p, q] = match ratio.exact {
            Some((p, q)) => [p as f64, q as f64],
            None => [ratio.value, 1.0],
        };
        self.trains.turns = together(self.trains.turns, ratio.exact.map_or(0, |(_, q)| q as u64));
        self.trains.fastest = self.trains.fastest.max(ratio.value.abs());
        if let Some((_, pair)) = self.trains.rotors.iter().find(|(known, _)| *known == [p, q]) {
            return Some(*pair);
        }
        let pair = self.emit_pair(P, Geared { quarters, start, p, q });
        self.trains.rotors.push(([p, q], pair));
        Some(pair)
    }

    /// The rotation, or travel, of a source that no train determines.
    fn wound(&mut self, source: AngleSource) -> Result<Wound, NoKernel> {
        if let Some((_, known)) = self.trains.wound.iter().find(|(s, _)| *s == source) {
            return Ok(*known);
        }
        let wound = match source {
            AngleSource::Way(r) => {
                let (way, _) = self.way(r)?;
                let now = self.way_now(r)?;
                let one = self.constant(1.0);
                Wound {
                    turns: AngleRatio::of(0, 1),
                    rest: self.emit(P, WeightedSum { a: way, b: one, k: -now }, 1),
                }
            }
            AngleSource::Link(_) | AngleSource::Line(..) | AngleSource::Driver(_) => {
                let d = match source {
                    AngleSource::Line(a, b) => {
                        self.between(MovingPoint::Pin(a), MovingPoint::Pin(b))?
                    }
                    AngleSource::Link(l) => self.arm(l, P)?,
                    AngleSource::Driver(_) | AngleSource::Way(_) => {
                        unreachable!("these turn with the driver, or do not turn")
                    }
                };
                let Some((turns, start, centre)) = self.winding(d) else {
                    return Err(self.not_followed(source));
                };
                let turn = match turns.is_zero() {
                    true => self.fixed(Vec2::new(1.0, 0.0)),
                    false => self.geared(turns).ok_or_else(|| self.not_followed(source))?,
                };
                Wound { turns, rest: self.emit(P, Against { d, turn, start, centre }, 1) }
            }
        };
        self.trains.wound.push((source, wound));
        Ok(wound)
    }

    fn not_followed(&self, source: AngleSource) -> NoKernel {
        match source {
            AngleSource::Link(l) => self.lost(l),
            AngleSource::Way(r) => self.lost(self.scene.rolling[r.0].links[1]),
            AngleSource::Line(a, b) => {
                let (a, b) = (self.scene.point_name(a), self.scene.point_name(b));
                Diagnostic::note(
                    "no-kernel",
                    both!("the turns of line {a}{b} cannot be counted beforehand"),
                )
            }
            AngleSource::Driver(d) => Diagnostic::note(
                "no-kernel",
                both!("{} does not turn", self.scene.driver_name(d).0),
            ),
        }
    }

    /// The turns of a line for each turn of the driver, its direction at the instant turned by the
    /// middle of the remaining angle, and this middle; `None` if it strays by half a turn, or
    /// cannot be followed.
    fn winding(&self, d: RegPair) -> Option<(AngleRatio, Vec2, f64)> {
        let driver = self.driver?;
        if !self.tracks.is_empty() || self.trains.turns == 0 || self.trains.turns > MOST_TURNS {
            return None;
        }
        let program = SweepProgram {
            steps: [self.steps[0].clone(), Vec::new(), Vec::new()],
            constants: self.constants.clone(),
            registers: self.registers as usize,
            columns: Vec::new(),
            joints: Vec::new(),
            tracks: Vec::new(),
            motions: Vec::new(),
            angular: false,
            turns: 1,
            fastest: 1.0,
            runs: Default::default(),
        };
        let (now, per_value) = (
            position_now(self.scene, self.at, driver),
            angle_per_value(self.scene, self.at, driver),
        );
        let turning = self.scene.drivers[driver].kind.turns();
        let line = |x: f64| {
            let (s, c) = (libm::sin(x * per_value), libm::cos(x * per_value));
            let mut registers = program.inputs(x, c, s, per_value);
            program.derive_steps(0..program.steps[0].len(), &mut registers);
            Vec2::new(registers[d.x.0 as usize].value, registers[d.y.0 as usize].value)
                .unit()
                .filter(|v| v.is_finite())
        };
        let start = line(now)?;
        let reach = if turning { TAU * self.trains.turns as f64 } else { 2.0 * self.at.extent() };
        let parts = if turning {
            STEPS * self.trains.turns as f64 * self.trains.fastest.ceil().min(16.0)
        } else {
            STEPS
        };
        // The angle at each step as far as the line exists, and `true` if that is all the way.
        let follow = |way: f64| -> Option<(Vec<f64>, bool)> {
            let (mut angles, mut before) = (vec![0.0], start);
            for i in 1..=parts as usize {
                let Some(next) = line(now + way * (i as f64 / parts)) else {
                    return Some((angles, false));
                };
                let turned = next.divide_by(before).angle();
                if turned.abs() > QUICK {
                    return None;
                }
                angles.push(angles[angles.len() - 1] + turned);
                before = next;
            }
            Some((angles, true))
        };
        let (mut angles, full) = follow(reach)?;
        let mut turns = AngleRatio::of(0, 1);
        if full && turning {
            let all = angles[angles.len() - 1] / TAU;
            let whole = libm::round(all);
            if (all - whole).abs() > 1e-6 {
                return None;
            }
            turns = AngleRatio::of(whole as i64, self.trains.turns as i64);
            for (i, angle) in angles.iter_mut().enumerate() {
                *angle -= turns.value * reach * (i as f64 / parts);
            }
        } else {
            angles.extend(follow(-reach)?.0);
        }
        let (low, high) = angles.iter().fold((0.0f64, 0.0f64), |(l, h), a| (l.min(*a), h.max(*a)));
        let centre = 0.5 * (low + high);
        (0.5 * (high - low) < PI - ASIDE)
            .then(|| (turns, start.rotate_by(Vec2::from_angle(centre)), centre))
    }

    /// Angular velocity or acceleration of a combination.
    fn rate_of(&mut self, turned: &Combination, level: Level) -> Result<Reg, NoKernel> {
        let mut driven = 0.0;
        let mut rates = Vec::new();
        for &(source, ratio) in turned {
            match source {
                AngleSource::Driver(d) => {
                    driven += ratio.value * self.even_rates(d)?[level as usize - 1]
                }
                AngleSource::Link(l) => rates.push((self.turning(l, level)?, ratio.value)),
                AngleSource::Line(a, b) => {
                    rates.push((self.turning_of_line([a, b], level)?, ratio.value))
                }
                AngleSource::Way(r) => rates.push((self.rate_of_way(r, level)?, ratio.value)),
            }
        }
        let mut sum = (driven != 0.0 || rates.is_empty()).then(|| self.constant(driven));
        for (rate, k) in rates {
            sum = Some(self.plus(level, sum, rate, k));
        }
        Ok(sum.unwrap_or_else(|| self.zero()))
    }

    fn turning_of_line(&mut self, [a, b]: [PointId; 2], level: Level) -> Result<Reg, NoKernel> {
        let arm = |c: &mut Self, level| -> Result<RegPair, NoKernel> {
            let (from, to) = (c.point(a, level)?, c.point(b, level)?);
            Ok(c.emit_pair(level, Arm { from, to }))
        };
        let (d, v) = (self.between(MovingPoint::Pin(a), MovingPoint::Pin(b))?, arm(self, V)?);
        self.turning_of_arm(d, v, level, |c| arm(c, A), |c| c.turning_of_line([a, b], V))
    }

    /// The wheel's centre, the link with the track, the beginning of the track, and its direction.
    fn on_track(
        &mut self,
        r: RollingId,
    ) -> Result<(PointId, LinkId, MovingPoint, RegPair), NoKernel> {
        let pair = &self.scene.rolling[r.0];
        let Relation::Slide { centre, guide } = pair.relation() else {
            return Err(self.lost(pair.links[1]));
        };
        let Some(Path::Line { through, direction }) = self.at.shapes.guides[guide.0] else {
            return Err(self.lost(pair.links[0]));
        };
        let u = self.direction_on(pair.links[0], direction)?;
        Ok((centre, pair.links[0], MovingPoint::Fixed(pair.links[0], through), u))
    }

    /// The coordinate of a wheel's centre along its track (m), and the vector from the beginning to
    /// the centre.
    fn way(&mut self, r: RollingId) -> Result<(Reg, RegPair), NoKernel> {
        let (centre, _, from, u) = self.on_track(r)?;
        let arm = self.between(from, MovingPoint::Pin(centre))?;
        Ok((self.emit(P, Dot { u, v: arm }, 1), arm))
    }

    /// The coordinate of a wheel's centre along its track at the instant (m).
    fn way_now(&mut self, r: RollingId) -> Result<f64, NoKernel> {
        let (centre, track, from, _) = self.on_track(r)?;
        let Some(Path::Line { direction, .. }) =
            self.scene.rolling[r.0].guide().and_then(|g| self.at.shapes.guides[g.0])
        else {
            return Err(self.lost(track));
        };
        let pose = if track == self.scene.ground {
            Pose::GROUND
        } else {
            self.at.poses[track.0].unwrap_or(Pose::GROUND)
        };
        Ok(pose.turn(direction).dot(self.now(MovingPoint::Pin(centre)) - self.now(from)))
    }

    /// The first or second derivative of the coordinate along the track.
    fn rate_of_way(&mut self, r: RollingId, level: Level) -> Result<Reg, NoKernel> {
        let (centre, track, from, u) = self.on_track(r)?;
        let arm = self.between(from, MovingPoint::Pin(centre))?;
        let between = |c: &mut Self, level| -> Result<RegPair, NoKernel> {
            let (from, to) = (c.spot(from, level)?, c.point(centre, level)?);
            Ok(c.emit_pair(level, Arm { from, to }))
        };
        let way = WayRate { u, r: arm, v: between(self, V)?, omega: self.turning(track, V)? };
        if level == V {
            return Ok(self.emit(V, way, 1));
        }
        let (a, alpha) = (between(self, A)?, self.turning(track, A)?);
        Ok(self.emit(A, WayAcceleration { way, a, alpha }, 1))
    }

    /// The line, square to the track, that contains the held point of a link with a known angle
    /// that rolls along a straight track or carries it: the point of the link, a point of the line
    /// and its direction.
    pub(super) fn along_track(
        &mut self,
        link: LinkId,
        r: RollingId,
    ) -> Result<(MovingPoint, RegPair, RegPair), NoKernel> {
        let pair = &self.scene.rolling[r.0];
        let [track, wheel] = pair.links;
        let rho = self.at.shapes.rolling[r.0][1];
        let now = self.way_now(r)?;
        let mut turned = self.trains.train.turned(wheel);
        add(&mut turned, &self.trains.train.turned(track), AngleRatio::of(-1, 1));
        // The relation is s = s₀ − ρ (Δφ₂ − Δφ₁).
        let (with, beside) = self.parts(&turned)?;
        let mut s = self.constant(now);
        if let (false, Some(driver)) = (with.is_zero(), self.driver) {
            // A coordinate that grows with the driver never recurs.
            self.trains.turns = 0;
            let start = position_now(self.scene, self.at, driver);
            s = self.constant(now + rho * with.value * start);
            s = self.emit(P, WeightedSum { a: s, b: VALUE, k: -rho * with.value }, 1);
        }
        if let Some(beside) = beside {
            s = self.emit(P, WeightedSum { a: s, b: beside, k: -rho }, 1);
        }
        let (centre, _, begin, u) = self.on_track(r)?;
        let normal = self.emit_pair(P, Twist { d: u, k: [0.0, 1.0] });
        if link == track {
            let back = self.emit_pair(P, Twist { d: u, k: [-1.0, 0.0] });
            let q = self.point(centre, P)?;
            return Ok((begin, self.emit_pair(P, PointAlong { q, t: back, s }), normal));
        }
        let local = self.at.shapes.local(wheel, centre).ok_or_else(|| self.lost(wheel))?;
        let q = self.spot(begin, P)?;
        Ok((MovingPoint::Fixed(wheel, local), self.emit_pair(P, PointAlong { q, t: u, s }), normal))
    }

    /// The direction along which the two links of a pair on a straight track have one velocity at
    /// the contact.
    pub(super) fn tangent(&mut self, r: RollingId) -> Result<RegPair, NoKernel> {
        Ok(self.on_track(r)?.3)
    }

    /// One of the points of contact of a pair.
    pub(super) fn contact(&mut self, r: RollingId, at: PointId) -> Result<RegPair, NoKernel> {
        let [r1, r2] = self.at.shapes.rolling[r.0];
        match self.scene.rolling[r.0].touch() {
            Touch::Point(Normal::Centres([a, b])) => {
                let d = self.between(MovingPoint::Pin(a), MovingPoint::Pin(b))?;
                let o = self.point(a, P)?;
                Ok(self.emit_pair(P, Image { o, d, k: [r1 / (r1 + r2), 0.0] }))
            }
            Touch::Point(Normal::Square { centre, .. }) => {
                let d = self.tangent(r)?;
                let o = self.point(centre, P)?;
                Ok(self.emit_pair(P, Image { o, d, k: [0.0, -r2] }))
            }
            Touch::Strand { centres, right, .. } => self.strand_end(r, centres, right, at),
        }
    }

    /// The velocity, or acceleration, of a link at a point.
    pub(super) fn of_link_at(
        &mut self,
        link: LinkId,
        place: RegPair,
        level: Level,
    ) -> Result<RegPair, NoKernel> {
        if link == self.scene.ground {
            return Ok(self.fixed(Vec2::ZERO));
        }
        let from = self.spot(MovingPoint::Own(link), P)?;
        let r = self.emit_pair(P, Arm { from, to: place });
        let (v, omega) = (self.spot(MovingPoint::Own(link), level)?, self.turning(link, V)?);
        Ok(match level {
            A => {
                let alpha = self.turning(link, A)?;
                self.emit_pair(A, SwingRate { a: v, r, omega, alpha })
            }
            P | V => self.emit_pair(V, ArmSwing { v, r, omega }),
        })
    }
}
