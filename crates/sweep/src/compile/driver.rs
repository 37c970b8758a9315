//! Drivers as registers: the swept one, those at rest, and followers led by a cam on the swept one.
//!
//! A led follower has its position and its rates in registers ([`crate::led`]). The cam's angle
//! selects the piece of its profile, or of its law, at each position: the angles at which the
//! stretches of a turn begin are found once. At a junction of two pieces the one ahead in the
//! driver's sense counts. A sweep that needs a quantity without an operation solves each position
//! by itself.

use super::rate::LegCondition;
use super::{Compiler, MovingPoint, NoKernel};
use crate::carry::{Image, PointAlong, Product, Twist};
use crate::kernel::{Kernel, Reg, RegPair};
use crate::led::{
    ByAngle, CamPhase, Faced, Higher, Lift, LiftRate, Parabola, Rock, RockRate, Stretch, Wave,
};
use crate::program::{COS, SIN, VALUE};
use crate::reading::WeightedSum;
use crate::station::position_now;
use crate::turns::{CosineSine, Quarters};
use hodograph_base::cam::{
    CamMotion, Disc, Follower, FollowerTip, ProfileSegment, StageMotion, StageProgram as Law,
};
use hodograph_base::diag::{Diagnostic, both};
use hodograph_base::geom::Vec2;
use hodograph_mechanism::mechanism::Level;
use hodograph_mechanism::position::Path;
use hodograph_scene::cams::TurningCam;
use hodograph_scene::{GuideId, LinkId, PointId};

const P: Level = Level::Position;
const V: Level = Level::Velocity;

/// The angles before a junction from which the following piece counts (rad): the distance that
/// [`Disc::touched`] looks ahead, and the tolerance within which stages of a law meet.
const AHEAD: [f64; 2] = [1e-9, 1e-11];

/// Rate and acceleration of a driver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Rates {
    /// Constant at all positions.
    Even([f64; 2]),
    /// Rates of a follower led by a cam.
    Led([Reg; 2]),
}

impl Rates {
    pub const NONE: Rates = Rates::Even([0.0; 2]);

    /// Returns the constant part, and the register to add to it.
    pub fn parts(self, level: Level) -> (f64, Option<Reg>) {
        let slot = level as usize - 1;
        match self {
            Rates::Even(rates) => (rates[slot], None),
            Rates::Led(rates) => (0.0, Some(rates[slot])),
        }
    }
}

/// A follower led by a cam, in registers.
#[derive(Clone, Copy, Debug)]
pub(super) struct LedFollower {
    place: FollowerPlace,
    rates: [Reg; 2],
}

/// The position of a led follower.
#[derive(Clone, Copy, Debug)]
enum FollowerPlace {
    /// Its coordinate along its guide.
    Way(Reg),
    /// The direction of its arm.
    Direction(RegPair),
}

impl Compiler<'_> {
    /// The swept driver's value, a driver's fixed value, or the coordinate of a follower led by a
    /// cam.
    pub(super) fn driver_value(&mut self, d: usize) -> Result<Reg, NoKernel> {
        if self.driver == Some(d) {
            return Ok(VALUE);
        }
        match self.led(d)? {
            Some(LedFollower { place: FollowerPlace::Way(reg), .. }) => Ok(reg),
            Some(_) => Err(self.not_led(d)),
            None => Ok(self.constant(self.values[d])),
        }
    }

    /// Cosine and sine of a driver's angle; with `arc`, of its travel along an arc of this radius.
    pub(super) fn driver_turn(&mut self, d: usize, arc: Option<f64>) -> Result<RegPair, NoKernel> {
        if self.driver == Some(d) {
            return Ok(RegPair { x: COS, y: SIN });
        }
        match self.led(d)? {
            Some(LedFollower { place: FollowerPlace::Direction(pair), .. }) => return Ok(pair),
            Some(_) => return Err(self.not_led(d)),
            None => {}
        }
        let (s, c) = match self.scene.drivers[d].kind.angle() {
            Some(angle) => hodograph_base::trig::sin_cos(angle.value),
            None => {
                let angle = self.values[d] / arc.unwrap_or(1.0);
                (libm::sin(angle), libm::cos(angle))
            }
        };
        Ok(self.fixed(Vec2::new(c, s)))
    }

    /// Rate and acceleration of a driver.
    pub(super) fn driver_rates(&mut self, d: usize) -> Result<Rates, NoKernel> {
        Ok(match self.led(d)? {
            Some(led) => Rates::Led(led.rates),
            None => Rates::Even(self.given_rates(d)),
        })
    }

    /// Rate and acceleration of a driver that no cam leads.
    pub(super) fn even_rates(&mut self, d: usize) -> Result<[f64; 2], NoKernel> {
        match self.driver_rates(d)? {
            Rates::Even(rates) => Ok(rates),
            Rates::Led(_) => Err(self.not_led(d)),
        }
    }

    fn given_rates(&self, d: usize) -> [f64; 2] {
        let driver = &self.scene.drivers[d];
        [driver.rate.value, driver.acceleration.as_ref().map_or(0.0, |a| a.value)]
    }

    /// The swept driver's angle in quarter turns, and its value at the instant.
    pub(super) fn quarters(&mut self, driver: usize) -> (RegPair, [f64; 2]) {
        if let Some(known) = self.trains.quarters {
            return known;
        }
        let value = position_now(self.scene, self.at, driver);
        let written = self.scene.drivers[driver].kind.angle();
        let (s, c) = written.map_or_else(
            || (libm::sin(value), libm::cos(value)),
            |angle| hodograph_base::trig::sin_cos(angle.value),
        );
        let known = (self.emit_pair(P, Quarters), Quarters.eval([value, c, s]));
        self.trains.quarters = Some(known);
        known
    }

    /// A spot that a driver pushes along a guide of a known link.
    pub(super) fn driven_along(
        &mut self,
        g: usize,
        p: MovingPoint,
        guide: GuideId,
        driver: usize,
    ) -> Result<RegPair, NoKernel> {
        let on = self.scene.guides[guide.0].on;
        let rates = self.driver_rates(driver)?;
        if let Some(slot) = self.slot(guide)? {
            let s = self.driver_value(driver)?;
            self.rows[g].push(LegCondition::Guided { p, on, n: slot.normal, rates: Rates::NONE });
            self.rows[g].push(LegCondition::Guided { p, on, n: slot.direction, rates });
            return Ok(self.emit_pair(P, PointAlong { q: slot.through, t: slot.direction, s }));
        }
        let Some(Path::Arc { centre, radius }) = self.at.shapes.guides[guide.0] else {
            return Err(self.without_kernel(g));
        };
        let turn = self.driver_turn(driver, Some(radius))?;
        let axis = self.direction_on(on, Vec2::new(radius, 0.0))?;
        let arm = self.emit_pair(P, Product { a: turn, b: axis });
        let o = self.spot(MovingPoint::Fixed(on, centre), P)?;
        let tangent = self.emit_pair(P, Twist { d: arm, k: [0.0, 1.0 / radius] });
        let l = self.constant(radius);
        self.rows[g].push(LegCondition::Distance {
            p,
            far: MovingPoint::Fixed(on, centre),
            l,
            rates: Rates::NONE,
            bar: false,
        });
        self.rows[g].push(LegCondition::Guided { p, on, n: tangent, rates });
        Ok(self.emit_pair(P, Image { o, d: arm, k: [1.0, 0.0] }))
    }

    /// The geometry of a ram, a link that is pinned at `far` and carries a straight guide along
    /// which a driver pushes a pin: the vector from pivot to pin in the link's frame, its component
    /// along the guide, and the driver's rates.
    pub(super) fn ram(
        &mut self,
        g: usize,
        link: LinkId,
        far: PointId,
        guide: GuideId,
        driver: usize,
    ) -> Result<(RegPair, Reg, Rates), NoKernel> {
        let (Some(Path::Line { through, direction }), Some(pivot)) =
            (self.at.shapes.guides[guide.0], self.at.shapes.local(link, far))
        else {
            return Err(self.without_kernel(g));
        };
        let start = (through - pivot).divide_by(direction);
        let s = self.driver_value(driver)?;
        let from = self.constant(start.x);
        let way = self.emit(P, WeightedSum { a: from, b: s, k: 1.0 }, 1);
        let side = self.constant(start.y);
        let straight = RegPair { x: way, y: side };
        let q = self.emit_pair(P, Twist { d: straight, k: [direction.x, direction.y] });
        Ok((q, way, Rates::Even(self.even_rates(driver)?)))
    }

    /// The message that a follower leads a quantity without an operation.
    fn not_led(&self, d: usize) -> NoKernel {
        let name = self.scene.driver_name(d).0;
        Diagnostic::note("no-kernel", both!("what {name} moves has no compiled form"))
    }

    /// A driver that is led by a cam on the swept one.
    fn led(&mut self, d: usize) -> Result<Option<LedFollower>, NoKernel> {
        let scene = self.scene;
        if scene.is_on_a_course(d) {
            return Err(self.not_led(d));
        }
        let led_by = |t: &&TurningCam| t.by_law == Some(d) && Some(t.driver) == self.driver;
        let Some(turning) = scene.cams.iter().filter_map(|c| c.disc.as_ref()).find(led_by) else {
            return Ok(None);
        };
        if let Some((_, known)) = self.leds.iter().find(|(k, _)| *k == d) {
            return Ok(Some(*known));
        }
        let led = match &turning.disc.motion {
            CamMotion::Law { base, program } => {
                self.led_by_law(turning, turning.disc.rest(*base), program)
            }
            CamMotion::Profile(segments) if turning.start == 0.0 => {
                self.led_by_pieces(turning, segments)
            }
            CamMotion::Profile(_) => return Err(self.not_led(d)),
        };
        self.leds.push((d, led));
        Ok(Some(led))
    }

    /// The angle of a cam from the beginning of its first stretch, shifted ahead to the side of
    /// junctions in the driver's sense, and the shift.
    fn phase(&mut self, t: &TurningCam, first: f64, ahead: f64) -> (Reg, f64) {
        let sense = t.disc.sense * t.way;
        let backward = self.given_rates(t.driver)[0] * sense < 0.0;
        let ahead = if backward { -ahead } else { ahead };
        let (quarters, _) = self.quarters(t.driver);
        let start = t.disc.sense * (t.start - t.from) + first - ahead;
        (self.emit(P, CamPhase { quarters, sense, start }, 1), ahead)
    }

    /// Four numbers of the stretch at the cam's angle; `stretches` gives each with the angle at
    /// which it begins.
    fn of_stretch(&mut self, at: Reg, stretches: &[(f64, [f64; 4])]) -> [Reg; 4] {
        let Some((_, first)) = stretches.first() else { return [self.zero(); 4] };
        let mut regs = first.map(|x| self.constant(x));
        let mut last = first.map(f64::to_bits);
        for &(from, numbers) in &stretches[1..] {
            let bits = numbers.map(f64::to_bits);
            if std::mem::replace(&mut last, bits) != bits {
                let out = self.emit(P, Stretch { at, before: regs, from, numbers }, 4);
                regs = std::array::from_fn(|i| Reg(out.0 + i as u32));
            }
        }
        regs
    }

    /// A follower led by a profile of arcs and lines.
    fn led_by_pieces(&mut self, t: &TurningCam, segments: &[ProfileSegment]) -> LedFollower {
        let stretches = t.disc.stretches();
        let first = stretches[0].0;
        let numbers =
            |piece: Option<usize>| piece.map_or([f64::NAN; 4], |i| numbers(&t.disc, &segments[i]));
        let table: Vec<(f64, [f64; 4])> =
            stretches.iter().map(|(phi, piece)| (phi - first, numbers(*piece))).collect();
        let at = if table.len() > 1 { self.phase(t, first, AHEAD[0]).0 } else { VALUE };
        let piece = self.of_stretch(at, &table);
        let (turn, way) = if t.is_drivers_own() {
            (RegPair { x: COS, y: SIN }, t.way)
        } else {
            let (quarters, _) = self.quarters(t.driver);
            let angle = self.emit(P, CamPhase { quarters, sense: t.way, start: -t.from }, 1);
            (self.emit_pair(P, CosineSine { angle }), 1.0)
        };
        let rates = self.given_rates(t.driver).map(|rate| t.way * rate);
        let two = |first: Reg| [first, Reg(first.0 + 1)];
        match (t.disc.follower, t.disc.touch) {
            (Follower::Translating { direction, offset }, FollowerTip::Point { .. }) => {
                let out = self.emit(
                    P,
                    Lift { piece, turn, way, direction, offset, origin: t.origin, out: t.outward },
                    5,
                );
                let lift = std::array::from_fn(|i| Reg(out.0 + 1 + i as u32));
                let rate = self.emit(
                    V,
                    LiftRate { lift, a: piece[0], direction, offset, rates, out: t.outward },
                    2,
                );
                LedFollower { place: FollowerPlace::Way(out), rates: two(rate) }
            }
            (Follower::Translating { direction, .. }, FollowerTip::Flat { .. }) => {
                let out = self.emit(
                    P,
                    Faced { piece, turn, way, direction, origin: t.origin, rates, out: t.outward },
                    3,
                );
                LedFollower { place: FollowerPlace::Way(out), rates: two(Reg(out.0 + 1)) }
            }
            (Follower::Oscillating { pivot, arm, sense }, touch) => {
                let (m, pivot, sign) = match touch {
                    FollowerTip::Point { .. } => {
                        (pivot * (2.0 * arm), pivot * (-1.0 / arm), -sense)
                    }
                    FollowerTip::Flat { .. } => (pivot.perp() * sense, Vec2::ZERO, sense),
                };
                let out = self.emit(P, Rock { piece, turn, way, m, pivot, sign }, 5);
                let rock = std::array::from_fn(|i| Reg(out.0 + i as u32));
                let rate = self.emit(V, RockRate { rock, h: piece[3], pivot, rates }, 2);
                LedFollower {
                    place: FollowerPlace::Direction(RegPair { x: rock[0], y: rock[1] }),
                    rates: two(rate),
                }
            }
        }
    }

    /// A follower led by a law, from its place on the base circle.
    fn led_by_law(&mut self, t: &TurningCam, rest: f64, law: &Law) -> LedFollower {
        let (at, ahead) = self.phase(t, 0.0, AHEAD[1]);
        let table = Terms::of(law, t.origin + t.outward * rest, t.outward);
        let group = |k: usize| -> Vec<(f64, [f64; 4])> {
            table.iter().map(|s| (s.from, s.groups[k])).collect()
        };
        let numbers = self.of_stretch(at, &group(0));
        let mut low = self.emit(P, Parabola { at, numbers, ahead }, 4);
        let (more, waves) = (self.of_stretch(at, &group(1)), self.of_stretch(at, &group(2)));
        let zero = self.zero();
        if more != [zero; 4] || waves[0] != zero {
            low = self.emit(P, Higher { low, numbers: more, last: waves[0] }, 4);
        }
        if waves[1] != zero {
            low = self.emit(P, Wave { low, numbers: [waves[1], waves[2], waves[3]] }, 4);
        }
        let sense = t.disc.sense * t.way;
        let rates = self.given_rates(t.driver).map(|rate| sense * rate);
        let rate = self.emit(V, ByAngle { low, rates }, 2);
        let place = match t.disc.follower {
            Follower::Translating { .. } => FollowerPlace::Way(low),
            Follower::Oscillating { .. } => {
                FollowerPlace::Direction(self.emit_pair(P, CosineSine { angle: low }))
            }
        };
        LedFollower { place, rates: [rate, Reg(rate.0 + 1)] }
    }
}

/// The numbers of a piece that the operation for this kind of follower reads.
fn numbers(disc: &Disc, segment: &ProfileSegment) -> [f64; 4] {
    let [a, x, y, h] = match (*segment, disc.touch) {
        (ProfileSegment::Arc { centre, radius, .. }, FollowerTip::Point { radius: r }) => {
            let l = radius + r;
            let (g, far) = (centre * (1.0 / l), centre.norm());
            [0.5 / l, g.x, g.y, (far - l) * (far + l) * (0.5 / l)]
        }
        (ProfileSegment::Line { normal, distance, .. }, FollowerTip::Point { radius: r }) => {
            let n = Vec2::from_angle(normal);
            [0.0, -n.x, -n.y, -(distance + r)]
        }
        (ProfileSegment::Arc { centre, radius, .. }, FollowerTip::Flat { .. }) if radius >= 0.0 => {
            [1.0, centre.x, centre.y, radius]
        }
        // A face touches neither concave flanks nor lines.
        (ProfileSegment::Arc { .. } | ProfileSegment::Line { .. }, FollowerTip::Flat { .. }) => {
            [f64::NAN; 4]
        }
    };
    match (disc.follower, disc.touch) {
        (Follower::Translating { .. }, _) => [a, x, y, h],
        (Follower::Oscillating { pivot, arm, .. }, FollowerTip::Point { .. }) => {
            [a, -arm * x, -arm * y, -h - a * (pivot.norm2() + arm * arm)]
        }
        (Follower::Oscillating { sense, .. }, FollowerTip::Flat { lever }) => {
            [a, sense * y, -sense * x, lever - h]
        }
    }
}

/// The terms of a law in one of its stretches, with u counted from the beginning of the stage: u₀,
/// c₀, c₁, c₂; c₃ to c₆; c₇, A, k, p.
struct Terms {
    /// The angle at which the stretch begins.
    from: f64,
    groups: [[f64; 4]; 3],
}

impl Terms {
    /// Returns the terms of all stretches of a law, with its lift counted from `base` in the sense
    /// `outward`.
    fn of(law: &Law, base: f64, outward: f64) -> Vec<Terms> {
        let mut out = Vec::new();
        let mut lift = 0.0;
        for (stage, start) in law.stages().iter().zip(law.joints()) {
            let still = base + outward * lift;
            let gain = outward * stage.gain();
            match stage.way {
                StageMotion::Dwell => out.push(Terms {
                    from: start,
                    groups: [[start, still, 0.0, 0.0], [0.0; 4], [0.0; 4]],
                }),
                StageMotion::Rise(_, kind) | StageMotion::Return(_, kind) => {
                    let mut from = start;
                    for piece in kind.pieces() {
                        let mut c = [0.0; 8];
                        let mut scale = gain;
                        for (c, coefficient) in c.iter_mut().zip(piece.polynomial) {
                            *c = coefficient.value::<f64>() * scale;
                            scale /= stage.over;
                        }
                        let wave = piece.wave.map_or([0.0; 3], |(amplitude, k, phase)| {
                            [
                                amplitude.value::<f64>() * gain,
                                k.to_radians() / stage.over,
                                phase.to_radians(),
                            ]
                        });
                        let low = [start, still + c[0], c[1], c[2]];
                        out.push(Terms {
                            from,
                            groups: [
                                low,
                                [c[3], c[4], c[5], c[6]],
                                [c[7], wave[0], wave[1], wave[2]],
                            ],
                        });
                        from = start + piece.end * stage.over;
                    }
                }
            }
            lift += stage.gain();
        }
        out
    }
}
