//! Compiles a scene placed at its instant to a program for all positions of one swept driver.
//!
//! Compilation is on demand: questions need points and angular velocities at a level, those need
//! groups at that level, and groups need those upstream. Lengths, guides and the branch of each
//! closure are those of the instant's configuration: the branch of a dyad is the sign of its area
//! (or the side of the foot of a guide), and a class III group keeps its assembly.
//!
//! This module defines the reference of each link and the order of requests. [`place`] and [`rate`]
//! handle the groups ([`triad`] those that are followed, [`rolling`] the trains), [`driver`] the
//! drivers, [`ask`] the questions, [`work`] those of forces.
//!
//! A group that has no kernel is named ([`Compiler::without_kernel`]); the caller then follows the
//! whole mechanism by Newton's method, position by position.

pub(super) mod ask;
mod belt;
mod driver;
mod place;
mod rate;
mod rolling;
mod triad;
mod turn;
mod work;

use super::carry::{Image, Twist};
use super::extreme::DrivenOutput;
use super::follow::triad::LinkTrack;
use super::kernel::{Reg, RegPair};
use super::program::{Joint, Op, ProgramStep, SIN, SweepProgram};
use super::station::driver_positions;
use super::train::AngleTrain;
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::geom::{Point, Vec2};
use hodograph_mechanism::mechanism::{Level, Mechanism};
use hodograph_mechanism::position::kernel::power_of_two_scale;
use hodograph_mechanism::position::{Configuration, Path};
use hodograph_scene::{Find, GuideId, LinkId, PointId, RollingId, Scene};
use rate::LegCondition;
use rolling::Trains;

/// The reason why a scene is not compiled: the group that has no kernel.
pub type NoKernel = Diagnostic;

/// Compiles the answers to `find` for a swept driver (`None`: all drivers are at rest; the program
/// then has one position).
///
/// # Errors
/// The group that has no kernel.
pub fn compile(
    scene: &Scene,
    m: &Mechanism,
    at: &Configuration,
    driver: Option<usize>,
    find: &[Find],
) -> Result<SweepProgram, NoKernel> {
    compile_in(scene, m, at, driver, find, SweepProgram::default())
}

/// Compiles as [`compile()`] does, in the memory of a program that is no more used.
///
/// # Errors
/// The group that has no kernel.
pub(super) fn compile_in(
    scene: &Scene,
    m: &Mechanism,
    at: &Configuration,
    driver: Option<usize>,
    find: &[Find],
    used: SweepProgram,
) -> Result<SweepProgram, NoKernel> {
    let mut c = Compiler::new(scene, m, at, driver, used);
    find.iter().try_for_each(|f| c.answer(f))?;
    Ok(c.finish())
}

/// Compiles position, rate and acceleration of outputs, three columns each, and the positions of
/// all groups, so that the program contains every joint.
///
/// # Errors
/// The group that has no kernel.
pub fn outputs(
    scene: &Scene,
    m: &Mechanism,
    at: &Configuration,
    driver: usize,
    outputs: &[DrivenOutput],
) -> Result<SweepProgram, NoKernel> {
    let mut c = Compiler::new(scene, m, at, Some(driver), SweepProgram::default());
    for g in 0..m.groups.len() {
        c.group(g, Level::Position)?;
    }
    for output in outputs {
        c.output(*output)?;
    }
    Ok(c.finish())
}

/// Compiles the positions of points, and origin and x axis of the frames of links: two columns
/// each.
///
/// # Errors
/// The group that has no kernel.
pub fn places(
    scene: &Scene,
    m: &Mechanism,
    at: &Configuration,
    driver: usize,
    points: &[PointId],
    links: &[LinkId],
) -> Result<SweepProgram, NoKernel> {
    let mut c = Compiler::new(scene, m, at, Some(driver), SweepProgram::default());
    let mut pairs = Vec::new();
    for p in points {
        pairs.push(c.point(*p, Level::Position)?);
    }
    for l in links {
        pairs.push(c.spot(MovingPoint::Fixed(*l, Point::ORIGIN), Level::Position)?);
        pairs.push(c.direction_on(*l, Vec2::new(1.0, 0.0))?);
    }
    c.columns.extend(pairs.into_iter().flat_map(|v| [v.x, v.y]));
    Ok(c.finish())
}

/// A moving point: a pin, a link's own point, or another point fixed in a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum MovingPoint {
    /// A pin.
    Pin(PointId),
    /// The reference point of a link.
    Own(LinkId),
    /// A place in a link's frame.
    Fixed(LinkId, Point),
}

/// The reference of a link: its own point and its arm.
#[derive(Clone, Debug)]
struct LinkReference {
    /// The point whose motion describes the link.
    origin: MovingPoint,
    /// The own point in the link's frame.
    at: Point,
    /// The arm in the link's frame.
    d: Vec2,
    /// The two pins between which the arm extends; `None` if the angular velocity is known instead.
    between: Option<(PointId, PointId)>,
    /// Own point, its velocity and acceleration, if it is not a pin.
    own: [Option<RegPair>; 3],
    /// The arm and its rates.
    arm: [Option<RegPair>; 3],
    /// The angular velocity and acceleration (index 0 and 1).
    turning: [Option<Reg>; 2],
}

/// A guide in the plane.
#[derive(Clone, Copy)]
struct Slot {
    through: RegPair,
    direction: RegPair,
    normal: RegPair,
}

pub(super) struct Compiler<'a> {
    scene: &'a Scene,
    m: &'a Mechanism,
    at: &'a Configuration,
    driver: Option<usize>,
    /// The value of each driver at the instant: the angle between its two lines (rad), or metres.
    values: Vec<f64>,
    /// A power of two near the size of the mechanism: arms without a length of their own get this
    /// one.
    unit: f64,
    steps: [Vec<ProgramStep>; 3],
    constants: Vec<(Reg, f64)>,
    registers: u32,
    columns: Vec<Reg>,
    joints: Vec<Joint>,
    /// The memory of [`SweepProgram::motions`].
    motions: Vec<[Option<RegPair>; 3]>,
    tracks: Vec<LinkTrack>,
    points: Vec<[Option<RegPair>; 3]>,
    bodies: Vec<Option<LinkReference>>,
    slots: Vec<Option<Slot>>,
    /// The level up to which each group is compiled.
    done: Vec<Option<Level>>,
    rows: Vec<Vec<LegCondition>>,
    trains: Trains,
    /// Followers led by cams.
    leds: Vec<(usize, driver::LedFollower)>,
}

impl<'a> Compiler<'a> {
    fn new(
        scene: &'a Scene,
        m: &'a Mechanism,
        at: &'a Configuration,
        driver: Option<usize>,
        used: SweepProgram,
    ) -> Self {
        let SweepProgram { mut steps, mut constants, columns, joints, motions, .. } =
            used.emptied();
        // A dyad has about this many operations for each effect.
        steps.iter_mut().for_each(|s| s.reserve(6 * (1 + m.groups.len())));
        constants.reserve(8 * (1 + m.groups.len()));
        let mut c = Compiler {
            scene,
            m,
            at,
            driver,
            values: driver_positions(scene, at),
            unit: 1.0 / power_of_two_scale(at.extent()),
            steps,
            constants,
            registers: SIN.0 + 1,
            columns,
            joints,
            motions,
            tracks: Vec::new(),
            points: vec![[None; 3]; scene.points.len()],
            bodies: vec![None; scene.links.len()],
            slots: vec![None; scene.guides.len()],
            done: vec![None; m.groups.len()],
            rows: vec![Vec::new(); m.groups.len()],
            trains: Trains::new(AngleTrain::of(scene, m, at)),
            leds: Vec::new(),
        };
        let zero = c.zero();
        let still = RegPair { x: zero, y: zero };
        let x = RegPair { x: c.constant(1.0), y: zero };
        c.bodies[scene.ground.0] = Some(LinkReference {
            origin: MovingPoint::Own(scene.ground),
            at: Point::ORIGIN,
            d: Vec2::new(1.0, 0.0),
            between: None,
            own: [Some(still); 3],
            arm: [Some(x), Some(still), Some(still)],
            turning: [Some(zero); 2],
        });
        for (p, local) in &at.shapes.points[scene.ground.0] {
            c.points[p.0] = [Some(c.fixed(local.to_vec2())), Some(still), Some(still)];
        }
        c
    }

    fn finish(mut self) -> SweepProgram {
        let own = self.bodies.iter().flatten().map(|b| b.own);
        let motions = self.points.iter().copied().chain(own).filter(|m| m[0].is_some());
        self.motions.extend(motions);
        SweepProgram {
            motions: self.motions,
            runs: Default::default(),
            steps: self.steps,
            constants: self.constants,
            registers: self.registers as usize,
            columns: self.columns,
            joints: self.joints,
            tracks: self.tracks,
            turns: self.trains.turns,
            fastest: self.trains.fastest,
            angular: self.driver.is_some_and(|d| self.scene.drivers[d].kind.turns()),
        }
    }

    /// The message that a group has no kernel.
    fn without_kernel(&self, group: usize) -> NoKernel {
        let g = &self.m.groups[group];
        let names: Vec<_> = g.links.iter().map(|l| self.scene.link_name(*l)).collect();
        let pins: Vec<_> = g.pins.iter().map(|p| self.scene.point_name(*p)).collect();
        let (links, pins, kind) = (Both::names(&names), Both::names(&pins), g.kind());
        let message = both!(
            "links {} with joints {} ({kind}) have no compiled form: the mechanism is followed by Newton's method from position to position",
            links,
            pins
        );
        let d = Diagnostic::note("no-kernel", message);
        match g.links.first() {
            Some(l) => d.at(self.scene.links[l.0].span),
            None => d,
        }
    }

    fn take(&mut self, n: u32) -> Reg {
        let first = Reg(self.registers);
        self.registers += n;
        first
    }

    fn constant(&mut self, value: f64) -> Reg {
        if let Some((reg, _)) = self.constants.iter().find(|(_, v)| v.to_bits() == value.to_bits())
        {
            return *reg;
        }
        let reg = self.take(1);
        self.constants.push((reg, value));
        reg
    }

    fn zero(&mut self) -> Reg {
        self.constant(0.0)
    }

    fn fixed(&mut self, v: Vec2) -> RegPair {
        RegPair { x: self.constant(v.x), y: self.constant(v.y) }
    }

    /// Adds an operation that fills `n` registers.
    fn emit(&mut self, level: Level, op: impl Into<Op>, n: u32) -> Reg {
        let out = self.take(n);
        self.steps[level as usize].push(ProgramStep { op: op.into(), out });
        out
    }

    fn emit_pair(&mut self, level: Level, op: impl Into<Op>) -> RegPair {
        let out = self.emit(level, op, 2);
        RegPair { x: out, y: Reg(out.0 + 1) }
    }

    fn body(&mut self, l: LinkId) -> Result<&LinkReference, NoKernel> {
        if self.bodies[l.0].is_none()
            && let Some(g) = self.m.group_of_link[l.0]
        {
            self.group(g, Level::Position)?;
        }
        let missing = self.bodies[l.0].is_none();
        if missing {
            return Err(self.lost(l));
        }
        Ok(self.bodies[l.0].as_ref().expect("just made sure of"))
    }

    /// The message that no group gives a link its position.
    fn lost(&self, l: LinkId) -> NoKernel {
        Diagnostic::note(
            "no-kernel",
            both!("link {} has no compiled form", self.scene.link_name(l)),
        )
        .at(self.scene.links[l.0].span)
    }

    /// A point of the scene: position, velocity or acceleration.
    pub(super) fn point(&mut self, p: PointId, level: Level) -> Result<RegPair, NoKernel> {
        if let Some(pair) = self.points[p.0][level as usize] {
            return Ok(pair);
        }
        if let Some(g) = self.m.group_of_pin[p.0] {
            self.group(g, level)?;
            if let Some(pair) = self.points[p.0][level as usize] {
                return Ok(pair);
            }
        }
        if let (Level::Position, Some(r)) =
            (level, self.scene.rolling.iter().position(|r| r.at.contains(&p)))
        {
            let pair = self.contact(RollingId(r), p)?;
            self.points[p.0][0] = Some(pair);
            return Ok(pair);
        }
        let carrier = self
            .scene
            .carriers(p)
            .find(|l| !self.m.is_passive(*l) && self.at.shapes.local(*l, p).is_some());
        let Some((l, local)) = carrier.and_then(|l| Some((l, self.at.shapes.local(l, p)?))) else {
            let message = both!("point {} has no compiled form", self.scene.point_name(p));
            return Err(Diagnostic::note("no-kernel", message));
        };
        let pair = self.spot(MovingPoint::Fixed(l, local), level)?;
        self.points[p.0][level as usize] = Some(pair);
        Ok(pair)
    }

    /// The position, velocity or acceleration of any spot.
    pub(super) fn spot(&mut self, spot: MovingPoint, level: Level) -> Result<RegPair, NoKernel> {
        match spot {
            MovingPoint::Pin(p) => self.point(p, level),
            MovingPoint::Own(l) => {
                let origin = self.body(l)?.origin;
                if origin != spot {
                    return self.spot(origin, level);
                }
                self.link_group(l, level)?;
                let own = self.bodies[l.0].as_ref().and_then(|b| b.own[level as usize]);
                own.ok_or_else(|| self.lost(l))
            }
            MovingPoint::Fixed(l, local) => {
                if l == self.scene.ground {
                    return Ok(match level {
                        Level::Position => self.fixed(local.to_vec2()),
                        Level::Velocity | Level::Acceleration => self.fixed(Vec2::ZERO),
                    });
                }
                let body = self.body(l)?;
                let k = (local - body.at).divide_by(body.d);
                if k == Vec2::ZERO {
                    return self.spot(MovingPoint::Own(l), level);
                }
                if let (true, Some((_, near))) = (k == Vec2::new(1.0, 0.0), body.between) {
                    return self.point(near, level);
                }
                let (o, d) = (self.spot(MovingPoint::Own(l), level)?, self.arm(l, level)?);
                Ok(self.emit_pair(level, Image { o, d, k: [k.x, k.y] }))
            }
        }
    }

    /// The position of a spot at the instant.
    fn now(&self, spot: MovingPoint) -> Point {
        let nowhere = Point::new(f64::NAN, f64::NAN);
        match spot {
            MovingPoint::Pin(p) => self.at.points[p.0].unwrap_or(nowhere),
            MovingPoint::Own(l) => match &self.bodies[l.0] {
                Some(b) if b.origin == spot => self.now(MovingPoint::Fixed(l, b.at)),
                Some(b) => self.now(b.origin),
                None => nowhere,
            },
            MovingPoint::Fixed(l, local) => {
                self.at.poses[l.0].map_or(nowhere, |pose| pose.to_world(local))
            }
        }
    }

    /// Brings the group of a link to a level.
    fn link_group(&mut self, l: LinkId, level: Level) -> Result<(), NoKernel> {
        match self.m.group_of_link[l.0] {
            Some(g) => self.group(g, level),
            None => Ok(()),
        }
    }

    /// A direction fixed in a link, in the plane.
    fn direction_on(&mut self, l: LinkId, local: Vec2) -> Result<RegPair, NoKernel> {
        if l == self.scene.ground {
            return Ok(self.fixed(local));
        }
        let k = local.divide_by(self.body(l)?.d);
        let d = self.arm(l, Level::Position)?;
        Ok(self.emit_pair(Level::Position, Twist { d, k: [k.x, k.y] }))
    }

    /// A straight guide in the plane.
    fn slot(&mut self, g: GuideId) -> Result<Option<Slot>, NoKernel> {
        if self.slots[g.0].is_none()
            && let Some(Path::Line { through, direction }) = self.at.shapes.guides[g.0]
        {
            let on = self.scene.guides[g.0].on;
            let slot = Slot {
                through: self.spot(MovingPoint::Fixed(on, through), Level::Position)?,
                direction: self.direction_on(on, direction)?,
                normal: self.direction_on(on, direction.perp())?,
            };
            self.slots[g.0] = Some(slot);
        }
        Ok(self.slots[g.0])
    }
}
