//! A compiled program: a straight list of operations over registers, one pass for each effect, run over chunks.
//!
//! Registers hold [`CHUNK`] positions each (structure of arrays). An operation reads registers that come before those it
//! fills. The list of one effect is run through a whole chunk before the next effect begins; what nothing asks for is not in
//! the list. Whether four positions are run at once or one changes no bit.

use super::carry::{Along, Arm, Image, Product, Swing, SwingRate, Turning, TurningRate, Twist};
use super::closure::{CircleLine, Circles, Closure, Lever, Lines, Margin};
use super::kernel::{Kernel, Reg};
use super::lane::{Dual, Lane, Width};
use super::reading::{Coriolis, Direction, Dot, Length, Part, Quotient, Sum};
use super::rows::{Bars, BarsRate, Cross, Distance, DistanceRate, Guided, GuidedRate, Reduced, ReducedRate, SlotRate, Three, TurnOf};
use super::track::Track;
use crate::mechanism::Level;
use crate::scene::{LinkId, PointId};
use fearless_simd::{Simd, SimdFrom, f64x4};
use std::ops::Range;

/// Positions run together: the registers of an eight-link mechanism with velocities and accelerations then stay in a
/// first-level cache of 32 KiB, or nearly so.
pub const CHUNK: usize = 64;

/// Groups of four in a chunk.
const QUADS: usize = CHUNK / 4;

/// One register's numbers.
type Column = [[f64; 4]; QUADS];

/// Runs kernels of whatever kind.
trait Runner {
    fn run<const IN: usize, const OUT: usize, K: Kernel<IN, OUT>>(&mut self, kernel: &K, out: Reg);
}

/// The operations, each named once: the enumeration, its conversions and its one dispatch.
macro_rules! operations {
    ($($(#[$doc:meta])* $name:ident),* $(,)?) => {
        /// An operation.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum Op {
            $($(#[$doc])* $name($name)),*
        }

        $(impl From<$name> for Op {
            fn from(kernel: $name) -> Op {
                Op::$name(kernel)
            }
        })*

        impl Op {
            #[inline(always)]
            fn run<R: Runner>(&self, runner: &mut R, out: Reg) {
                match self {
                    $(Op::$name(kernel) => runner.run(kernel, out)),*
                }
            }
        }
    };
}

operations! {
    /// Two circles.
    Circles,
    /// Circle and line.
    CircleLine,
    /// Two lines.
    Lines,
    /// A lever over a pin.
    Lever,
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
    /// The group, an index into [`crate::mechanism::Mechanism::groups`].
    pub group: usize,
    /// The step of positions that closes it.
    pub step: usize,
    /// The links that lie in line where it ends.
    pub links: Vec<LinkId>,
    /// The pin at which they meet.
    pub pin: Option<PointId>,
}

/// One column of the result.
#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    /// Its name, such as `v_E.x`.
    pub name: String,
    /// Its SI unit.
    pub unit: &'static str,
    /// Where it is found.
    pub reg: Reg,
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
    /// What is asked for.
    pub columns: Vec<Asked>,
    /// The closures that can miss, in solving order.
    pub joints: Vec<Joint>,
    /// The groups that are followed from position to position, in solving order.
    pub tracks: Vec<Track>,
    /// Whether the swept quantity is an angle.
    pub angular: bool,
}

/// The registers of the swept quantity: its value, and cosine and sine of it as an angle.
pub const VALUE: Reg = Reg(0);
/// Cosine.
pub const COS: Reg = Reg(1);
/// Sine.
pub const SIN: Reg = Reg(2);

/// A chunk's registers.
#[derive(Clone, Debug)]
pub struct Buffer {
    pub(super) columns: Vec<Column>,
}

impl Buffer {
    /// The number of a register at a position of the chunk.
    pub fn get(&self, reg: Reg, row: usize) -> f64 {
        self.columns[reg.0 as usize][row / 4][row % 4]
    }

    /// Sets it.
    pub fn set(&mut self, reg: Reg, row: usize, value: f64) {
        self.columns[reg.0 as usize][row / 4][row % 4] = value;
    }

    /// The numbers of a register at the first `n` positions.
    pub fn numbers(&self, reg: Reg, n: usize) -> &[f64] {
        &self.columns[reg.0 as usize].as_flattened()[..n]
    }

    /// Fills a register with the values of up to [`CHUNK`] positions; the rest repeats the last one.
    pub fn fill(&mut self, reg: Reg, values: &[f64]) {
        let column = self.columns[reg.0 as usize].as_flattened_mut();
        column[..values.len()].copy_from_slice(values);
        if let Some(last) = values.last() {
            column[values.len()..].fill(*last);
        }
    }
}

impl Program {
    /// Registers for a chunk, with the constants in their places.
    pub fn buffer(&self) -> Buffer {
        let mut columns = vec![[[0.0; 4]; QUADS]; self.registers];
        for (reg, value) in &self.constants {
            columns[reg.0 as usize] = [[*value; 4]; QUADS];
        }
        Buffer { columns }
    }

    /// Runs all effects over a chunk whose inputs are filled in, with nothing to follow from position to position.
    pub fn run(&self, buffer: &mut Buffer, width: Width) {
        self.run_steps(self.steps.iter().map(Vec::as_slice), buffer, width);
    }

    /// Runs some of the steps.
    pub(super) fn run_steps<'a>(&self, steps: impl Iterator<Item = &'a [Step]>, buffer: &mut Buffer, width: Width) {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64", target_arch = "aarch64"))]
        if let Some(simd) = width.four() {
            return simd.vectorize(
                #[inline(always)]
                || run_all(steps, &mut Four { simd, columns: &mut buffer.columns }),
            );
        }
        run_all(steps, &mut One { columns: &mut buffer.columns });
    }

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
        run_all(std::iter::once(&self.steps[0][steps]), &mut Single { registers });
    }

    /// Whether at a row of a chunk that was run some closure misses by more than rounding may explain.
    pub fn misses(&self, buffer: &Buffer, row: usize) -> bool {
        // As much as a hundred roundings of the terms: nearer to a touch the general solver decides.
        const SURE: f64 = -100.0 * f64::EPSILON;
        self.joints.iter().any(|j| {
            let margin = self.margin(j, &|r| buffer.get(r, row));
            margin.is_some_and(|m| m.outer < m.terms * SURE || m.inner < m.terms * SURE)
        })
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

#[inline(always)]
fn run_all<'a>(lists: impl Iterator<Item = &'a [Step]>, runner: &mut impl Runner) {
    for list in lists {
        for step in list {
            step.op.run(runner, step.out);
        }
    }
}

/// Runs a chunk four positions at a time.
struct Four<'a, S> {
    simd: S,
    columns: &'a mut [Column],
}

impl<S: Simd> Runner for Four<'_, S> {
    #[inline(always)]
    fn run<const IN: usize, const OUT: usize, K: Kernel<IN, OUT>>(&mut self, kernel: &K, out: Reg) {
        let (known, new) = self.columns.split_at_mut(out.0 as usize);
        let x = kernel.inputs().map(|r| &known[r.0 as usize]);
        let Some(y) = new.first_chunk_mut::<OUT>() else { return };
        for i in 0..QUADS {
            let v = kernel.eval(x.map(|c| f64x4::simd_from(self.simd, c[i])));
            for j in 0..OUT {
                y[j][i] = v[j].into();
            }
        }
    }
}

/// Runs a chunk one position at a time.
struct One<'a> {
    columns: &'a mut [Column],
}

impl Runner for One<'_> {
    #[inline(always)]
    fn run<const IN: usize, const OUT: usize, K: Kernel<IN, OUT>>(&mut self, kernel: &K, out: Reg) {
        let (known, new) = self.columns.split_at_mut(out.0 as usize);
        let x = kernel.inputs().map(|r| known[r.0 as usize].as_flattened());
        let Some(y) = new.first_chunk_mut::<OUT>() else { return };
        for i in 0..CHUNK {
            let v = kernel.eval(x.map(|c| c[i]));
            for j in 0..OUT {
                y[j].as_flattened_mut()[i] = v[j];
            }
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
