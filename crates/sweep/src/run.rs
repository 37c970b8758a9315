//! Runs a program over chunks of positions, four at a time or one.
//!
//! Registers hold [`CHUNK`] positions each (structure of arrays); each operation runs through the
//! whole chunk before the next begins. Four positions at once and one give the same bits.

// The loops step through several arrays side by side; loops over numbers are certain to be
// unrolled.
#![allow(clippy::needless_range_loop)]

use super::fuse::{Fused, cranks::*, kernels::*};
use super::kernel::{Kernel, Reg};
use super::lane::Width;
use super::program::{COS, INPUTS, Joint, Op, SIN, SweepProgram};
use super::station::Stations;
use fearless_simd::{Simd, SimdBase, SimdFrom, f64x4};
use std::ops::Range;

/// The number of positions run together: the registers of an eight-link mechanism with velocities
/// and accelerations then stay in a first-level cache of 32 KiB.
pub const CHUNK: usize = 64;

/// Groups of four in a chunk.
const QUADS: usize = CHUNK / 4;

/// The numbers of a register at all positions of a chunk.
type ChunkNumbers = [[f64; 4]; QUADS];

/// One register's numbers. They are aligned, because a group of four across two lines of the cache
/// takes twice as long to store.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct RegisterColumn(ChunkNumbers);

/// A runner of kernels of any kind.
pub(super) trait KernelRunner {
    fn run<const IN: usize, const OUT: usize, K: Kernel<IN, OUT>>(&mut self, kernel: &K, out: Reg);
}

/// Declares operations, each named once: the enumeration, its conversions and its one dispatch.
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
            pub(super) fn run<R: KernelRunner>(&self, runner: &mut R, out: Reg) {
                match self {
                    $($all::$name(kernel) => runner.run(kernel, out)),*
                }
            }
        }
    };
}
pub(super) use operations;

operations! { FusedOp:
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
    /// A slot of a lever over the pin of a crank.
    CrankDyadP, CrankDyadV, CrankDyadA, CrankDyadVL, CrankDyadAL,
    CrankSliderP, CrankSliderV, CrankSliderA, CrankSliderVL, CrankSliderAL,
    CrankSlottedV, CrankSlottedA,
    /// A slot of a lever over the pin of a crank that turns evenly.
    EvenDyadP, EvenDyadV, EvenDyadA, EvenDyadVL, EvenDyadAL,
    EvenSliderP, EvenSliderV, EvenSliderA, EvenSliderVL, EvenSliderAL,
    EvenSlottedV, EvenSlottedA,
    /// Angular velocity or acceleration of a line.
    TurnedV, TurnedA,
    /// Angular velocity or acceleration of a line with one fixed point.
    TurnedGroundV, TurnedGroundA,
}

/// An operation to run: one of the compiled list, or several as one.
#[derive(Clone, Copy, Debug)]
pub(super) enum Any {
    One(Op),
    Whole(FusedOp),
}

impl Any {
    #[inline(always)]
    pub fn run<R: KernelRunner>(&self, runner: &mut R, out: Reg) {
        match self {
            Any::One(op) => op.run(runner, out),
            Any::Whole(op) => op.run(runner, out),
        }
    }
}

/// An operation, the end of its inputs in the list of wires, and the first of the registers that it
/// fills.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlacedOperation {
    pub op: Any,
    pub end: usize,
    pub out: Reg,
}

/// The registers of a chunk.
#[derive(Clone, Debug, Default)]
pub struct Buffer {
    columns: Vec<RegisterColumn>,
    /// The number of filled groups of four.
    quads: usize,
}

impl Buffer {
    /// Returns the same memory for a number of registers, with arbitrary contents: an operation
    /// fills registers before others read them.
    pub(super) fn sized(mut self, registers: usize) -> Buffer {
        if self.columns.len() < registers {
            self.columns.resize(registers, RegisterColumn([[0.0; 4]; QUADS]));
        }
        Buffer { quads: QUADS, ..self }
    }

    /// The number of a register at a position of the chunk.
    pub fn get(&self, reg: Reg, row: usize) -> f64 {
        self.columns[reg.0 as usize].0[row / 4][row % 4]
    }

    /// Sets the number of a register at a position of the chunk.
    pub fn set(&mut self, reg: Reg, row: usize, value: f64) {
        self.columns[reg.0 as usize].0[row / 4][row % 4] = value;
    }

    /// The numbers of a register at the first `n` positions.
    pub fn numbers(&self, reg: Reg, n: usize) -> &[f64] {
        &self.columns[reg.0 as usize].0.as_flattened()[..n]
    }

    /// Copies the numbers of answers to their places, which all have one length. Returns true only
    /// if all of them are finite: a sum with an infinite number or NaN is not finite either, so no
    /// number needs a test of its own.
    pub(super) fn hand_out<'a>(
        &self,
        answers: &[AnswerRoute],
        places: impl Iterator<Item = &'a mut [f64]>,
        width: Width,
    ) -> bool {
        if let Some(simd) = width.four() {
            return simd.vectorize(
                #[inline(always)]
                || {
                    // Four sums side by side, because each waits for the addition before it.
                    let mut sums = [f64x4::splat(simd, 0.0); 4];
                    let mut rest = 0.0;
                    for (answer, place) in answers.iter().zip(places) {
                        let (many, few) = place.as_chunks_mut::<16>();
                        match answer {
                            AnswerRoute::There(_) => {
                                for place in many {
                                    for k in 0..4 {
                                        sums[k] +=
                                            f64x4::from_slice(simd, &place[4 * k..4 * k + 4]);
                                    }
                                }
                            }
                            AnswerRoute::In(reg) => {
                                let column = &self.columns[reg.0 as usize].0;
                                few.copy_from_slice(
                                    &column.as_flattened()[16 * many.len()..][..few.len()],
                                );
                                for (place, numbers) in
                                    many.iter_mut().zip(column.as_chunks::<4>().0)
                                {
                                    for k in 0..4 {
                                        let four = f64x4::simd_from(simd, numbers[k]);
                                        four.store_slice(&mut place[4 * k..4 * k + 4]);
                                        sums[k] += four;
                                    }
                                }
                            }
                            AnswerRoute::Nowhere => {
                                many.as_flattened_mut().fill(f64::NAN);
                                few.fill(f64::NAN);
                                rest = f64::NAN;
                            }
                        }
                        rest += few.iter().sum::<f64>();
                    }
                    let all: [f64; 4] = ((sums[0] + sums[1]) + (sums[2] + sums[3])).into();
                    (rest + all.iter().sum::<f64>()).is_finite()
                },
            );
        }
        let mut sum = 0.0;
        for (answer, place) in answers.iter().zip(places) {
            match answer {
                AnswerRoute::There(_) => {}
                AnswerRoute::In(reg) => place.copy_from_slice(self.numbers(*reg, place.len())),
                AnswerRoute::Nowhere => place.fill(f64::NAN),
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
        // The last group repeats the last position, so that none of its lanes holds numbers of
        // another chunk.
        if let Some(last) = values.last() {
            column[values.len()..end].fill(*last);
        }
    }
}

/// The most memory that the registers of a chunk take (bytes), so that a long chain stays in a
/// second-level cache too.
const ROOM: usize = 128 * 1024;

impl Fused {
    /// The best number of positions to run together: a whole chunk, or fewer with many registers.
    pub fn positions(&self) -> usize {
        // Fewer than four groups do not repay the pass through the list.
        4 * (ROOM / (self.registers * size_of::<[f64; 4]>())).clamp(4, QUADS)
    }

    /// Fills in the inputs of a chunk: some stations, [`Fused::positions`] at most.
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

    /// Runs a chunk with filled inputs.
    pub fn run(&self, buffer: &mut Buffer, width: Width) {
        let quads = buffer.quads;
        let Some((inputs, own)) = buffer.columns.split_first_chunk_mut::<{ INPUTS.len() }>() else {
            return;
        };
        let inputs = inputs.each_ref().map(|c| &c.0);
        let Some(own) = own.get_mut(..self.registers - INPUTS.len()) else { return };
        let slots = own.iter_mut().map(|c| &mut c.0).collect();
        self.run_in(Memory { inputs, slots, quads, wires: &[] }, width);
    }

    /// Runs the chunk of [`CHUNK`] stations from `first` on, without filling anything in.
    /// Operations put the answers of the form [`AnswerRoute::There`] directly in their places while
    /// they compute: copying them afterwards takes a fifth of the time more.
    pub(super) fn run_there<'a>(
        &'a self,
        buffer: &'a mut Buffer,
        (stations, first): (&'a Stations, usize),
        answers: &[AnswerRoute],
        places: impl Iterator<Item = &'a mut [f64]>,
        width: Width,
    ) {
        buffer.quads = QUADS;
        let block = |values: &'a [f64]| values[first..].as_chunks().0.first_chunk();
        let inputs = (block(&stations.values), block(&stations.cosines), block(&stations.sines));
        let ((Some(values), Some(cosines), Some(sines)), Some(own)) =
            (inputs, buffer.columns.get_mut(INPUTS.len()..self.registers))
        else {
            return;
        };
        let mut slots: Vec<&mut ChunkNumbers> = own.iter_mut().map(|c| &mut c.0).collect();
        for (answer, place) in answers.iter().zip(places) {
            if let AnswerRoute::There(reg) = answer
                && let Some(place) = place.as_chunks_mut().0.first_chunk_mut()
            {
                slots[reg.0 as usize - INPUTS.len()] = place;
            }
        }
        self.run_in(
            Memory { inputs: [values, cosines, sines], slots, quads: QUADS, wires: &[] },
            width,
        );
    }

    /// The answers in these registers; with `straight`, operations put those that they can directly
    /// in their places.
    pub(super) fn answers(&self, found: &[Option<Reg>], straight: bool) -> Vec<AnswerRoute> {
        let constant = |reg: Reg| self.constants.iter().any(|(r, _)| *r == reg);
        let twice = |reg: Reg| found.iter().filter(|r| **r == Some(reg)).count() > 1;
        let of = |reg: &Option<Reg>| match *reg {
            Some(reg) if straight && !INPUTS.contains(&reg) && !constant(reg) && !twice(reg) => {
                AnswerRoute::There(reg)
            }
            Some(reg) => AnswerRoute::In(reg),
            None => AnswerRoute::Nowhere,
        };
        found.iter().map(of).collect()
    }

    fn run_in<'a>(&'a self, memory: Memory<'a>, width: Width) {
        match width.four() {
            Some(simd) => self.run_all(Four { simd, memory }),
            None => self.run_all(SinglePosition { memory }),
        }
    }

    #[inline(always)]
    fn run_all<'a>(&'a self, mut runner: impl KernelRunner + AsMut<Memory<'a>>) {
        let mut start = 0;
        for step in &self.steps {
            runner.as_mut().wires = &self.wires[start..step.end];
            start = step.end;
            step.op.run(&mut runner, step.out);
        }
    }

    /// True if, at a row of a chunk that was run, some closure misses by more than rounding may
    /// explain. The program must have the crossings of its joints, because the inputs of closures
    /// may be inside another operation.
    pub fn misses(&self, program: &SweepProgram, buffer: &Buffer, row: usize) -> bool {
        // A hundred roundings of the terms: nearer to a touch the general solver decides.
        const SURE: f64 = -100.0 * f64::EPSILON;
        program.joints.iter().any(|j| {
            let margin = self.margin(program, j, buffer, row);
            margin.is_some_and(|m| m.outer < m.terms * SURE || m.inner < m.terms * SURE)
        })
    }

    /// The margin of a joint at a row.
    pub(super) fn margin(
        &self,
        program: &SweepProgram,
        joint: &Joint,
        buffer: &Buffer,
        row: usize,
    ) -> Option<super::closure::Margin<f64>> {
        program.margin(joint, &|reg| self.number(buffer, reg, row))
    }
}

/// The way of an answer to its place in a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum AnswerRoute {
    /// The operation that fills this register puts it there.
    There(Reg),
    /// It is copied from this register.
    In(Reg),
    /// There is no answer.
    Nowhere,
}

/// The registers of a running chunk, and the inputs of its operation.
struct Memory<'a> {
    inputs: [&'a ChunkNumbers; INPUTS.len()],
    /// The registers that are not inputs.
    slots: Vec<&'a mut ChunkNumbers>,
    quads: usize,
    wires: &'a [Reg],
}

/// The inputs and results of an operation.
type OperationColumns<'a, const IN: usize, const OUT: usize> =
    ([&'a ChunkNumbers; IN], [&'a mut ChunkNumbers; OUT]);

impl Memory<'_> {
    #[inline(always)]
    fn columns<const IN: usize, const OUT: usize>(
        &mut self,
        out: Reg,
    ) -> Option<OperationColumns<'_, IN, OUT>> {
        let (known, new) = self.slots.split_at_mut(out.0 as usize - INPUTS.len());
        let wires = self.wires.first_chunk::<IN>()?;
        let mut x = [self.inputs[0]; IN];
        for k in 0..IN {
            let reg = wires[k].0 as usize;
            x[k] = if reg < INPUTS.len() { self.inputs[reg] } else { &*known[reg - INPUTS.len()] };
        }
        Some((x, new.first_chunk_mut::<OUT>()?.each_mut().map(|block| &mut **block)))
    }
}

/// Runs a chunk four positions at a time.
struct Four<'a, S> {
    simd: S,
    memory: Memory<'a>,
}

impl<'a, S> AsMut<Memory<'a>> for Four<'a, S> {
    #[inline(always)]
    fn as_mut(&mut self) -> &mut Memory<'a> {
        &mut self.memory
    }
}

impl<S: Simd> KernelRunner for Four<'_, S> {
    #[inline(always)]
    fn run<const IN: usize, const OUT: usize, K: Kernel<IN, OUT>>(&mut self, kernel: &K, out: Reg) {
        let simd = self.simd;
        let memory = &mut self.memory;
        // Each kernel is a function of its own: all of them in one take three times as long to
        // compile. It finds its columns itself, because as arguments they would go through memory.
        simd.vectorize(
            #[inline(always)]
            || {
                let quads = memory.quads.min(QUADS);
                let Some((x, y)) = memory.columns::<IN, OUT>(out) else { return };
                // The copy cannot alias a number that is written, so values made of its constants
                // are computed before the loop.
                let kernel = *kernel;
                for i in 0..quads {
                    // The loop makes sure of inlining; code that is not inlined runs without SIMD
                    // registers.
                    let mut lanes = [f64x4::splat(simd, 0.0); IN];
                    for k in 0..IN {
                        lanes[k] = f64x4::simd_from(simd, x[k][i]);
                    }
                    let v = kernel.eval(lanes);
                    for j in 0..OUT {
                        y[j][i] = v[j].into();
                    }
                }
            },
        );
    }
}

/// Runs a chunk one position at a time.
struct SinglePosition<'a> {
    memory: Memory<'a>,
}

impl<'a> AsMut<Memory<'a>> for SinglePosition<'a> {
    #[inline(always)]
    fn as_mut(&mut self) -> &mut Memory<'a> {
        &mut self.memory
    }
}

impl KernelRunner for SinglePosition<'_> {
    // A function of its own for each kernel, as with four.
    #[inline(never)]
    fn run<const IN: usize, const OUT: usize, K: Kernel<IN, OUT>>(&mut self, kernel: &K, out: Reg) {
        let quads = self.memory.quads.min(QUADS);
        let Some((x, y)) = self.memory.columns::<IN, OUT>(out) else { return };
        for i in 0..quads {
            for lane in 0..4 {
                let mut numbers = [0.0; IN];
                for k in 0..IN {
                    numbers[k] = x[k][i][lane];
                }
                let v = kernel.eval(numbers);
                for j in 0..OUT {
                    y[j][i][lane] = v[j];
                }
            }
        }
    }
}
