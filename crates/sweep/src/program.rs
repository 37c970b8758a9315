//! Compiled programs: a straight list of operations over registers for each effect.
//!
//! An operation reads registers that precede those it fills. Limits and followed links evaluate the
//! list itself, one position at a time and in numbers with derivatives; over many positions it runs
//! in the form that [`super::fuse`] makes of it.

use super::carry::{
    Arm, ArmSwing, ArmTurning, Image, PointAlong, Product, SwingRate, TurningRate, Twist,
};
use super::closure::{
    CircleLine, CircleLineCrossing, Circles, CirclesCrossing, Closure, LeverCrossing, Lines,
    Margin, SlotLever,
};
use super::follow::triad::LinkTrack;
use super::fuse::Fused;
use super::kernel::{Kernel, Reg, RegPair};
use super::lane::{Dual, Lane};
use super::led::{
    ByAngle, CamPhase, Faced, Higher, Lift, LiftRate, Parabola, Rock, RockRate, Stretch, Wave,
};
use super::reading::{
    ComponentAlong, Coriolis, Dot, Quotient, RateRatio, VectorDirection, VectorLength, WeightedSum,
};
use super::rows::{
    Bars, BarsRate, Cross, Distance, DistanceRate, Guided, GuidedRate, Reduced, ReducedRate,
    SlotRate, Three, TurnOf,
};
use super::run::{KernelRunner, operations};
use super::turns::{Against, CosineSine, Geared, Quarters, WayAcceleration, WayRate};
use super::work::{Forward, Massive, ProductSum, Ramp, Repeated, SpringPower};
use hodograph_mechanism::mechanism::Level;
use hodograph_scene::{LinkId, PointId};
use std::ops::Range;
use std::sync::OnceLock;

operations! { Op:
    /// Position of the pin of two circles.
    Circles,
    /// Position on circle and line.
    CircleLine,
    /// Position on two lines.
    Lines,
    /// Direction of a lever over a pin.
    SlotLever,
    /// Crossing (sin²) of two circles.
    CirclesCrossing,
    /// Crossing (sin²) of circle and line.
    CircleLineCrossing,
    /// Crossing (sin²) of a lever with its pivot and pin.
    LeverCrossing,
    /// Position, velocity or acceleration of a point of a link.
    Image,
    /// The arm from point to point.
    Arm,
    /// A constant turn and stretch of a vector.
    Twist,
    /// A vector turned by another vector's angle.
    Product,
    /// The quotient of two vectors.
    Quotient,
    /// The ratio of angular velocities.
    RateRatio,
    /// A point at a distance in a direction.
    PointAlong,
    /// Velocity of a point of a link.
    ArmSwing,
    /// Acceleration of a point of a link.
    SwingRate,
    /// Angular velocity of an arm.
    ArmTurning,
    /// Angular acceleration of an arm.
    TurningRate,
    /// The velocity row of a bar or a cylinder.
    Distance,
    /// The acceleration row of a bar or a cylinder.
    DistanceRate,
    /// The velocity row of a guide.
    Guided,
    /// The acceleration row of a guide.
    GuidedRate,
    /// The acceleration row of a slot.
    SlotRate,
    /// A velocity row reduced by the known rotation.
    Reduced,
    /// An acceleration row reduced by the known rotation.
    ReducedRate,
    /// Angular velocity or acceleration of a pinned link.
    TurnOf,
    /// The solution of two rows.
    Cross,
    /// The solution of three rows.
    Three,
    /// Velocity of the pin of two bars.
    Bars,
    /// Acceleration of the pin of two bars.
    BarsRate,
    /// The length of a vector.
    VectorLength,
    /// The angle of a vector.
    VectorDirection,
    /// The component of a vector along another.
    ComponentAlong,
    /// The dot product of a vector and a direction.
    Dot,
    /// The Coriolis term.
    Coriolis,
    /// The sum of two numbers.
    WeightedSum,
    /// The power of weight and inertia.
    Massive,
    /// The sum with a product.
    ProductSum,
    /// The power of a spring.
    SpringPower,
    /// The angle of the driver within a period.
    Repeated,
    /// The amount of a load along its course.
    Ramp,
    /// A number in one sense of motion, else zero.
    Forward,
    /// The driver's angle in quarter turns.
    Quarters,
    /// A ratio of the driver's travel.
    Geared,
    /// Cosine and sine of an angle.
    CosineSine,
    /// The angle of a line relative to another.
    Against,
    /// The rate of the distance along a track.
    WayRate,
    /// The second derivative of the distance along a track.
    WayAcceleration,
    /// The angle of a cam.
    CamPhase,
    /// The numbers of the piece in contact.
    Stretch,
    /// A translating follower.
    Lift,
    /// The rates of a translating follower.
    LiftRate,
    /// A translating flat face with its rates.
    Faced,
    /// An oscillating follower.
    Rock,
    /// The rates of an oscillating follower.
    RockRate,
    /// A law of the second degree.
    Parabola,
    /// The higher degrees of a law.
    Higher,
    /// A wave.
    Wave,
    /// Rates of a function of an angle.
    ByAngle,
}

/// An operation and the first of the registers that it fills.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProgramStep {
    /// The operation.
    pub op: Op,
    /// The first register filled.
    pub out: Reg,
}

/// A closure that can miss: where its margin vanishes, the driver stops or the mechanism changes
/// its branch.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// The group, an index into [`hodograph_mechanism::mechanism::Mechanism::groups`].
    pub group: usize,
    /// The step of positions that closes it.
    pub step: usize,
    /// The register of its crossing ([`Margin::crossing`]), read only by a search for limits and
    /// change points.
    pub crossing: Reg,
    /// The links that are in line at its end.
    pub links: Vec<LinkId>,
    /// The pin at which they meet.
    pub pin: Option<PointId>,
}

/// A scene compiled for one swept quantity.
#[derive(Clone, Debug, Default)]
pub struct SweepProgram {
    /// The operations of each effect: positions, velocities, accelerations.
    pub steps: [Vec<ProgramStep>; 3],
    /// Registers with fixed values.
    pub constants: Vec<(Reg, f64)>,
    /// The number of registers.
    pub registers: usize,
    /// The register of each column of the answers.
    pub columns: Vec<Reg>,
    /// The closures that can miss, in solving order.
    pub joints: Vec<Joint>,
    /// Position, velocity and acceleration of each point, as far as they exist: pairs that belong
    /// together.
    pub motions: Vec<[Option<RegPair>; 3]>,
    /// The groups that are followed from position to position, in solving order.
    pub tracks: Vec<LinkTrack>,
    /// True if the swept quantity is an angle.
    pub angular: bool,
    /// The number of turns after which the pose recurs: one, or more with rolling links; 0 if it
    /// never recurs.
    pub turns: u64,
    /// The greatest ratio of a wheel's angular velocity to that of its driver; at least 1.
    pub fastest: f64,
    /// The forms of the program that run, each once it is needed: for its answers, for its joints'
    /// crossings, for its answers and some crossings.
    pub(super) runs: [OnceLock<Fused>; 3],
}

/// The register of the swept quantity's value.
pub const VALUE: Reg = Reg(0);
/// The register of its cosine, as an angle.
pub const COS: Reg = Reg(1);
/// The register of its sine, as an angle.
pub const SIN: Reg = Reg(2);

/// All three inputs, the first of all registers.
pub(super) const INPUTS: [Reg; 3] = [VALUE, COS, SIN];

impl SweepProgram {
    /// Returns the memory of the program for another one, which has nothing in it yet.
    pub(super) fn emptied(mut self) -> SweepProgram {
        if let Some(fused) = self.runs[0].take() {
            fused.give_back();
        }
        let SweepProgram { mut steps, mut constants, mut columns, mut joints, mut motions, .. } =
            self;
        steps.iter_mut().for_each(Vec::clear);
        constants.clear();
        columns.clear();
        joints.clear();
        motions.clear();
        SweepProgram { steps, constants, columns, joints, motions, ..SweepProgram::default() }
    }

    /// Registers of one position with the inputs filled in, each with its derivative by the swept
    /// quantity. `per_value` is the derivative of the angle that belongs to the cosine and sine.
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
        let mut single = SingleRun { registers };
        self.steps[0][steps].iter().for_each(|s| s.op.run(&mut single, s.out));
    }

    /// The margin of a joint; `read` reads a register.
    pub fn margin<N: Lane>(&self, joint: &Joint, read: &impl Fn(Reg) -> N) -> Option<Margin<N>> {
        fn of<N: Lane, const IN: usize, const OUT: usize, K: Kernel<IN, OUT> + Closure<IN>>(
            k: &K,
            read: &impl Fn(Reg) -> N,
        ) -> Margin<N> {
            k.margin(k.inputs().map(read))
        }
        match &self.steps[Level::Position as usize][joint.step].op {
            Op::Circles(k) => Some(of(k, read)),
            Op::CircleLine(k) => Some(of(k, read)),
            Op::SlotLever(k) => Some(of(k, read)),
            _ => None,
        }
    }
}

/// Runs one position in numbers of any kind.
struct SingleRun<'a, N> {
    registers: &'a mut [N],
}

impl<N: Lane> KernelRunner for SingleRun<'_, N> {
    fn run<const IN: usize, const OUT: usize, K: Kernel<IN, OUT>>(&mut self, kernel: &K, out: Reg) {
        let v = kernel.eval(kernel.inputs().map(|r| self.registers[r.0 as usize]));
        self.registers[out.0 as usize..][..OUT].copy_from_slice(&v);
    }
}
