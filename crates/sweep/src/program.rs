//! A compiled program: a straight list of operations over registers for each effect.
//!
//! An operation reads registers that come before those it fills. The list is what limits and followed links look at, one
//! position at a time and in numbers with derivatives; over many positions it is run as [`super::fuse`] makes it.

use super::carry::{Along, Arm, Image, Product, Swing, SwingRate, Turning, TurningRate, Twist};
use super::closure::{CircleLine, CircleLineCrossing, Circles, CirclesCrossing, Closure, Lever, LeverCrossing, Lines, Margin};
use super::follow::triad::Track;
use super::fuse::Fused;
use super::kernel::{Kernel, Pair, Reg};
use super::lane::{Dual, Lane};
use super::led::{ByAngle, Faced, Higher, Lift, LiftRate, Parabola, Phase, Rock, RockRate, Stretch, Wave};
use super::reading::{Coriolis, Direction, Dot, Length, Part, Quotient, Ratio, Sum};
use super::rows::{Bars, BarsRate, Cross, Distance, DistanceRate, Guided, GuidedRate, Reduced, ReducedRate, SlotRate, Three, TurnOf};
use super::run::{Runner, operations};
use super::turns::{Against, Geared, Quarters, Turned, WayAcceleration, WayRate};
use super::work::{Forward, Massive, Ramp, Repeated, Spring, Times};
use hodograph_mechanism::mechanism::Level;
use hodograph_scene::{LinkId, PointId};
use std::ops::Range;
use std::sync::OnceLock;

operations! { Op:
    /// Two circles.
    Circles,
    /// Circle and line.
    CircleLine,
    /// Two lines.
    Lines,
    /// A lever over a pin.
    Lever,
    /// How squarely two circles cross.
    CirclesCrossing,
    /// How squarely circle and line cross.
    CircleLineCrossing,
    /// How squarely a lever lies to its pivot.
    LeverCrossing,
    /// A point of a link, its velocity, its acceleration.
    Image,
    /// From point to point.
    Arm,
    /// A constant turn and stretch.
    Twist,
    /// A turn by another vector's angle.
    Product,
    /// A quotient of two vectors.
    Quotient,
    /// A ratio of angular velocities.
    Ratio,
    /// So far in a direction.
    Along,
    /// Velocity of a point of a link.
    Swing,
    /// Acceleration of a point of a link.
    SwingRate,
    /// ω of an arm.
    Turning,
    /// α of an arm.
    TurningRate,
    /// Row of a bar or a cylinder.
    Distance,
    /// The same for accelerations.
    DistanceRate,
    /// Row of a guide.
    Guided,
    /// The same for accelerations.
    GuidedRate,
    /// Row of a slot, for accelerations.
    SlotRate,
    /// Row without its turning.
    Reduced,
    /// The same for accelerations.
    ReducedRate,
    /// Turning of a pinned link.
    TurnOf,
    /// Two rows.
    Cross,
    /// Three rows.
    Three,
    /// Two bars.
    Bars,
    /// The same for accelerations.
    BarsRate,
    /// Length of a vector.
    Length,
    /// Angle of a vector.
    Direction,
    /// Part of a vector.
    Part,
    /// Part along a direction.
    Dot,
    /// Coriolis term.
    Coriolis,
    /// Sum of two numbers.
    Sum,
    /// Power of weight and inertia.
    Massive,
    /// Sum with a product.
    Times,
    /// Power of a spring.
    Spring,
    /// Angle of the driver within a period.
    Repeated,
    /// Amount of a load along its course.
    Ramp,
    /// A number in one sense of motion.
    Forward,
    /// The driver's angle in quarter turns.
    Quarters,
    /// A part of the driver's way.
    Geared,
    /// cos and sin of an angle.
    Turned,
    /// How far a line has turned against another.
    Against,
    /// Rate of a way along a track.
    WayRate,
    /// The rate of that.
    WayAcceleration,
    /// The angle of a cam.
    Phase,
    /// What is known of the piece that is touched.
    Stretch,
    /// A translating follower.
    Lift,
    /// Its rates.
    LiftRate,
    /// A translating face with its rates.
    Faced,
    /// An oscillating follower.
    Rock,
    /// Its rates.
    RockRate,
    /// A law of the second degree.
    Parabola,
    /// What is of higher degrees.
    Higher,
    /// A wave.
    Wave,
    /// Rates of what goes by an angle.
    ByAngle,
}

/// An operation and the first of the registers that it fills.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// What is done.
    pub op: Op,
    /// The first register filled.
    pub out: Reg,
}

/// The closure of a group that can miss: where its margin vanishes the driver stops, or the mechanism changes its branch.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// The group, an index into [`hodograph_mechanism::mechanism::Mechanism::groups`].
    pub group: usize,
    /// The step of positions that closes it.
    pub step: usize,
    /// Where its crossing is found ([`Margin::crossing`]), which nothing but a search for its ends asks for.
    pub crossing: Reg,
    /// The links that lie in line where it ends.
    pub links: Vec<LinkId>,
    /// The pin at which they meet.
    pub pin: Option<PointId>,
}

/// A scene compiled for one swept quantity.
#[derive(Clone, Debug)]
pub struct Program {
    /// The operations of each effect: positions, velocities, accelerations.
    pub steps: [Vec<Step>; 3],
    /// Registers with fixed values.
    pub constants: Vec<(Reg, f64)>,
    /// How many registers there are.
    pub registers: usize,
    /// Where each column of the answers is found.
    pub columns: Vec<Reg>,
    /// The closures that can miss, in solving order.
    pub joints: Vec<Joint>,
    /// Position, velocity and acceleration of each point, as far as they are there: what belongs together.
    pub motions: Vec<[Option<Pair>; 3]>,
    /// The groups that are followed from position to position, in solving order.
    pub tracks: Vec<Track>,
    /// Whether the swept quantity is an angle.
    pub angular: bool,
    /// After how many turns of it everything stands as it did: one, or what rolls needs more; 0 where it never does.
    pub turns: u64,
    /// How many times as fast as it the fastest of all wheels turns; at least 1.
    pub fastest: f64,
    /// The program as it is run, once it has been: for its answers, for its joints' crossings, for its answers and some crossings.
    pub(super) runs: [OnceLock<Fused>; 3],
}

/// The registers of the swept quantity: its value, and cosine and sine of it as an angle.
pub const VALUE: Reg = Reg(0);
/// Cosine.
pub const COS: Reg = Reg(1);
/// Sine.
pub const SIN: Reg = Reg(2);

/// All three, the first of all registers.
pub(super) const INPUTS: [Reg; 3] = [VALUE, COS, SIN];

impl Program {
    /// Registers of one position with the inputs filled in, each with its derivative by the swept quantity. `per_value`: the
    /// derivative of the angle whose cosine and sine are given.
    pub fn inputs(&self, value: f64, cos: f64, sin: f64, per_value: f64) -> Vec<Dual> {
        let mut registers = vec![Dual::fixed(0.0); self.registers];
        for (reg, value) in &self.constants {
            registers[reg.0 as usize] = Dual::fixed(*value);
        }
        registers[VALUE.0 as usize] = Dual { value, slope: 1.0 };
        registers[COS.0 as usize] = Dual { value: cos, slope: -sin * per_value };
        registers[SIN.0 as usize] = Dual { value: sin, slope: cos * per_value };
        registers
    }

    /// Runs steps of the positions in numbers with derivatives.
    pub fn derive_steps(&self, steps: Range<usize>, registers: &mut [Dual]) {
        let mut single = Single { registers };
        self.steps[0][steps].iter().for_each(|s| s.op.run(&mut single, s.out));
    }

    /// The margin of a joint, from the registers that `read` reads.
    pub fn margin<N: Lane>(&self, joint: &Joint, read: &impl Fn(Reg) -> N) -> Option<Margin<N>> {
        fn of<N: Lane, const IN: usize, const OUT: usize, K: Kernel<IN, OUT> + Closure<IN>>(k: &K, read: &impl Fn(Reg) -> N) -> Margin<N> {
            k.margin(k.inputs().map(read))
        }
        match &self.steps[Level::Position as usize][joint.step].op {
            Op::Circles(k) => Some(of(k, read)),
            Op::CircleLine(k) => Some(of(k, read)),
            Op::Lever(k) => Some(of(k, read)),
            _ => None,
        }
    }
}

/// Runs one position in numbers of any kind.
struct Single<'a, N> {
    registers: &'a mut [N],
}

impl<N: Lane> Runner for Single<'_, N> {
    fn run<const IN: usize, const OUT: usize, K: Kernel<IN, OUT>>(&mut self, kernel: &K, out: Reg) {
        let v = kernel.eval(kernel.inputs().map(|r| self.registers[r.0 as usize]));
        self.registers[out.0 as usize..][..OUT].copy_from_slice(&v);
    }
}
