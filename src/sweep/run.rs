//! A program run over chunks of positions, four at a time or one.
//!
//! Registers hold [`CHUNK`] positions each (structure of arrays); each operation runs through the whole chunk before the next
//! begins. Whether four positions are run at once or one changes no bit.

// Several arrays are gone through side by side; loops over numbers are sure to be unrolled.
#![allow(clippy::needless_range_loop)]

use super::fuse::{Fused, cranks::*, kernels::*};
use super::kernel::{Kernel, Reg};
use super::lane::Width;
use super::program::{COS, Joint, Op, Program, SIN};
use super::station::Stations;
use fearless_simd::{Simd, SimdBase, SimdFrom, f64x4};
use std::ops::Range;

/// Positions run together: the registers of an eight-link mechanism with velocities and accelerations then stay in a
/// first-level cache of 32 KiB.
pub const CHUNK: usize = 64;

/// Groups of four in a chunk.
const QUADS: usize = CHUNK / 4;

/// One register's numbers. Aligned, for a group of four that lies across two lines of the cache takes twice as long to store.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Column([[f64; 4]; QUADS]);

/// Runs kernels of whatever kind.
pub(super) trait Runner {
    fn run<const IN: usize, const OUT: usize, K: Kernel<IN, OUT>>(&mut self, kernel: &K, out: Reg);
}

/// Operations, each named once: the enumeration, its conversions and its one dispatch.
macro_rules! operations {
    ($all:ident: $($(#[$doc:meta])* $name:ident),* $(,)?) => {
        /// An operation.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum $all {
            $(
                $(#[$doc])*
                #[doc = concat!("[`", stringify!($name), "`].")]
                $name($name)
            ),*
        }

        $(impl From<$name> for $all {
            fn from(kernel: $name) -> $all {
                $all::$name(kernel)
            }
        })*

        impl $all {
            #[inline(always)]
            pub(super) fn run<R: Runner>(&self, runner: &mut R, out: Reg) {
                match self {
                    $($all::$name(kernel) => runner.run(kernel, out)),*
                }
            }
        }
    };
}
pub(super) use operations;

operations! { Whole:
    /// Two bars.
    DyadP, DyadV, DyadA, DyadVL, DyadAL,
    /// Two bars, one of them on ground.
    DyadGroundP, DyadGroundV, DyadGroundA, DyadGroundVL, DyadGroundAL,
    /// A point of the driver.
    CrankP, CrankV, CrankA,
    /// A point of a driver that turns evenly.
    EvenP, EvenV, EvenA,
    /// A point of a link by two others.
    CoupledP, CoupledV, CoupledA, CoupledVL, CoupledAL,
    /// A point of a link by two others, one of them fixed.
    CoupledGroundP, CoupledGroundV, CoupledGroundA, CoupledGroundVL, CoupledGroundAL,
    /// A point of a link by another and an arm.
    ImagesP, ImagesV, ImagesA, ImagesVL, ImagesAL,
    /// Bar and fixed guide.
    SliderP, SliderV, SliderA, SliderVL, SliderAL,
    /// A slot of a lever over a pin.
    SlottedV, SlottedA,
    /// The same on the pin of a crank.
    CrankDyadP, CrankDyadV, CrankDyadA, CrankDyadVL, CrankDyadAL,
    CrankSliderP, CrankSliderV, CrankSliderA, CrankSliderVL, CrankSliderAL,
    CrankSlottedV, CrankSlottedA,
    /// The same, the crank turning evenly.
    EvenDyadP, EvenDyadV, EvenDyadA, EvenDyadVL, EvenDyadAL,
    EvenSliderP, EvenSliderV, EvenSliderA, EvenSliderVL, EvenSliderAL,
    EvenSlottedV, EvenSlottedA,
    /// Turning of a line.
    TurnedV, TurnedA,
    /// Turning of a line of which one point is fixed.
    TurnedGroundV, TurnedGroundA,
}

/// What is run: an operation of the compiled list, or several as one.
#[derive(Clone, Copy, Debug)]
pub(super) enum Any {
    One(Op),
    Whole(Whole),
}

impl Any {
    #[inline(always)]
    pub fn run<R: Runner>(&self, runner: &mut R, out: Reg) {
        match self {
            Any::One(op) => op.run(runner, out),
            Any::Whole(op) => op.run(runner, out),
        }
    }
}

/// An operation, where what it reads ends in the list of wires, and the first of the registers that it fills.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed {
    pub op: Any,
    pub end: usize,
    pub out: Reg,
}

/// A chunk's registers.
#[derive(Clone, Debug, Default)]
pub struct Buffer {
    columns: Vec<Column>,
    /// Groups of four that are filled.
    quads: usize,
}

impl Buffer {
    /// The same memory for so many registers, with whatever is in it: an operation fills registers before others read them.
    pub(super) fn sized(mut self, registers: usize) -> Buffer {
        if self.columns.len() < registers {
            self.columns.resize(registers, Column([[0.0; 4]; QUADS]));
        }
        Buffer { quads: QUADS, ..self }
    }

    /// The number of a register at a position of the chunk.
    pub fn get(&self, reg: Reg, row: usize) -> f64 {
        self.columns[reg.0 as usize].0[row / 4][row % 4]
    }

    /// Sets it.
    pub fn set(&mut self, reg: Reg, row: usize, value: f64) {
        self.columns[reg.0 as usize].0[row / 4][row % 4] = value;
    }

    /// The numbers of a register at the first `n` positions.
    pub fn numbers(&self, reg: Reg, n: usize) -> &[f64] {
        &self.columns[reg.0 as usize].0.as_flattened()[..n]
    }

    /// Copies the numbers of registers to places of one length; NaN where there is no register. Whether all of them are finite, for
    /// sure: a sum with what is not finite is not either, and none need be looked at by itself.
    pub(super) fn hand_out<'a>(&self, regs: &[Option<Reg>], places: impl Iterator<Item = &'a mut [f64]>, width: Width) -> bool {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64", target_arch = "aarch64"))]
        if let Some(simd) = width.four() {
            return simd.vectorize(
                #[inline(always)]
                || {
                    // Four sums side by side, for each waits for what was added before.
                    let mut sums = [f64x4::splat(simd, 0.0); 4];
                    let mut rest = 0.0;
                    for (reg, place) in regs.iter().zip(places) {
                        let Some(reg) = reg else {
                            place.fill(f64::NAN);
                            rest = f64::NAN;
                            continue;
                        };
                        let column = &self.columns[reg.0 as usize].0;
                        let (many, few) = place.as_chunks_mut::<16>();
                        for (place, numbers) in many.iter_mut().zip(column.as_chunks::<4>().0) {
                            for k in 0..4 {
                                let four = f64x4::simd_from(simd, numbers[k]);
                                four.store_slice(&mut place[4 * k..4 * k + 4]);
                                sums[k] += four;
                            }
                        }
                        let last = &column.as_flattened()[16 * many.len()..][..few.len()];
                        few.copy_from_slice(last);
                        rest += last.iter().sum::<f64>();
                    }
                    let all: [f64; 4] = ((sums[0] + sums[1]) + (sums[2] + sums[3])).into();
                    (rest + all.iter().sum::<f64>()).is_finite()
                },
            );
        }
        let mut sum = 0.0;
        for (reg, place) in regs.iter().zip(places) {
            match reg {
                Some(reg) => place.copy_from_slice(self.numbers(*reg, place.len())),
                None => place.fill(f64::NAN),
            }
            sum += place.iter().sum::<f64>();
        }
        sum.is_finite()
    }

    /// Fills a register with the values of up to [`CHUNK`] positions.
    pub(super) fn fill(&mut self, reg: Reg, values: &[f64]) {
        let end = values.len().next_multiple_of(4);
        let column = self.columns[reg.0 as usize].0.as_flattened_mut();
        column[..values.len()].copy_from_slice(values);
        // The last group repeats the last position, so that no lane of it meets numbers of another chunk.
        if let Some(last) = values.last() {
            column[values.len()..end].fill(*last);
        }
    }
}

/// The registers of a chunk take no more than this, so that a long chain stays in a second-level cache too.
const ROOM: usize = 128 * 1024;

impl Fused {
    /// How many positions are best run together: a whole chunk, or fewer where there are many registers.
    pub fn positions(&self) -> usize {
        // Fewer than four groups would not pay for going through the list.
        4 * (ROOM / (self.registers * size_of::<[f64; 4]>())).clamp(4, QUADS)
    }

    /// Fills in the inputs of a chunk: some stations, as many as [`Fused::positions`] at most.
    pub fn load(&self, buffer: &mut Buffer, stations: &Stations, rows: Range<usize>) {
        buffer.quads = rows.len().div_ceil(4);
        for reg in &self.inputs {
            let values = match *reg {
                COS => &stations.cosines,
                SIN => &stations.sines,
                _ => &stations.values,
            };
            buffer.fill(*reg, &values[rows.clone()]);
        }
    }

    /// Runs a chunk whose inputs are filled in.
    pub fn run(&self, buffer: &mut Buffer, width: Width) {
        let Buffer { columns, quads } = buffer;
        let quads = *quads;
        #[cfg(any(target_arch = "x86", target_arch = "x86_64", target_arch = "aarch64"))]
        if let Some(simd) = width.four() {
            return simd.vectorize(
                #[inline(always)]
                || self.run_all(Four { simd, columns, quads, wires: &[] }),
            );
        }
        self.run_all(One { columns, quads, wires: &[] });
    }

    #[inline(always)]
    fn run_all<'a>(&'a self, mut runner: impl Runner + Wired<'a>) {
        let mut start = 0;
        for step in &self.steps {
            runner.wire(&self.wires[start..step.end]);
            start = step.end;
            step.op.run(&mut runner, step.out);
        }
    }

    /// Whether at a row of a chunk that was run some closure misses by more than rounding may explain: of a program that has the
    /// crossings of its joints, for what closures read may be inside an operation of another.
    pub fn misses(&self, program: &Program, buffer: &Buffer, row: usize) -> bool {
        // As much as a hundred roundings of the terms: nearer to a touch the general solver decides.
        const SURE: f64 = -100.0 * f64::EPSILON;
        program.joints.iter().any(|j| {
            let margin = self.margin(program, j, buffer, row);
            margin.is_some_and(|m| m.outer < m.terms * SURE || m.inner < m.terms * SURE)
        })
    }

    /// The margin of a joint at a row.
    pub(super) fn margin(&self, program: &Program, joint: &Joint, buffer: &Buffer, row: usize) -> Option<super::closure::Margin<f64>> {
        program.margin(joint, &|reg| self.number(buffer, reg, row))
    }
}

/// A runner that is told where an operation reads.
pub(super) trait Wired<'a> {
    fn wire(&mut self, wires: &'a [Reg]);
}

/// Runs a chunk four positions at a time.
struct Four<'a, S> {
    simd: S,
    columns: &'a mut [Column],
    quads: usize,
    wires: &'a [Reg],
}

impl<'a, S> Wired<'a> for Four<'a, S> {
    #[inline(always)]
    fn wire(&mut self, wires: &'a [Reg]) {
        self.wires = wires;
    }
}

impl<S: Simd> Runner for Four<'_, S> {
    #[inline(always)]
    fn run<const IN: usize, const OUT: usize, K: Kernel<IN, OUT>>(&mut self, kernel: &K, out: Reg) {
        let (known, new) = self.columns.split_at_mut(out.0 as usize);
        let (Some(wires), Some(y)) = (self.wires.first_chunk::<IN>(), new.first_chunk_mut::<OUT>()) else { return };
        let mut x = [&known[0].0; IN];
        for k in 0..IN {
            x[k] = &known[wires[k].0 as usize].0;
        }
        // A copy, which no number that is put out can lie in: what is made of its constants is made before the loop.
        let kernel = *kernel;
        for i in 0..self.quads.min(QUADS) {
            // A loop, for what is not inlined runs without the machine's wide registers.
            let mut lanes = [f64x4::splat(self.simd, 0.0); IN];
            for k in 0..IN {
                lanes[k] = f64x4::simd_from(self.simd, x[k][i]);
            }
            let v = kernel.eval(lanes);
            for j in 0..OUT {
                y[j].0[i] = v[j].into();
            }
        }
    }
}

/// Runs a chunk one position at a time.
struct One<'a> {
    columns: &'a mut [Column],
    quads: usize,
    wires: &'a [Reg],
}

impl<'a> Wired<'a> for One<'a> {
    #[inline(always)]
    fn wire(&mut self, wires: &'a [Reg]) {
        self.wires = wires;
    }
}

impl Runner for One<'_> {
    #[inline(always)]
    fn run<const IN: usize, const OUT: usize, K: Kernel<IN, OUT>>(&mut self, kernel: &K, out: Reg) {
        let (known, new) = self.columns.split_at_mut(out.0 as usize);
        let (Some(wires), Some(y)) = (self.wires.first_chunk::<IN>(), new.first_chunk_mut::<OUT>()) else { return };
        let mut x = [&known[0].0; IN];
        for k in 0..IN {
            x[k] = &known[wires[k].0 as usize].0;
        }
        for i in 0..self.quads.min(QUADS) {
            for lane in 0..4 {
                let mut numbers = [0.0; IN];
                for k in 0..IN {
                    numbers[k] = x[k][i][lane];
                }
                let v = kernel.eval(numbers);
                for j in 0..OUT {
                    y[j].0[i][lane] = v[j];
                }
            }
        }
    }
}
