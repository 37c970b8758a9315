//! Kernel fusion: rewrites the compiled list of operations to fewer ones that each do more, and
//! drops those with results that nothing reads.
//!
//! The compiled list has one small operation for each group and effect; run one by one, most of
//! their time goes into loads and stores. The operations of one point, for its position, velocity
//! and acceleration, are therefore found again ([`matching`]) and replaced by one kernel of
//! [`kernels`]; operations between them run unchanged. This module knows nothing of mechanisms: a
//! dyad is recognised by its operations, in any place. The numbers do not depend on the width.

pub mod cranks;
pub mod kernels;
mod levers;
mod matching;

use super::kernel::Reg;
use super::program::{INPUTS, ProgramStep, SweepProgram};
use super::run::{Any, Buffer, CHUNK, KernelRunner, PlacedOperation};
use arrayvec::ArrayVec;
use hodograph_mechanism::mechanism::Level;
use matching::{Matching, RegisterTables};
use std::cell::RefCell;
use std::ops::Range;

/// A program ready to run.
#[derive(Clone, Debug, Default)]
pub struct Fused {
    pub(super) steps: Vec<PlacedOperation>,
    pub(super) wires: Vec<Reg>,
    pub(super) registers: usize,
    /// The inputs of a position that are read.
    pub(super) inputs: ArrayVec<Reg, 3>,
    /// Registers with fixed values.
    pub(super) constants: Vec<(Reg, f64)>,
    /// The register here of each register of the program, if anything reads it.
    place: Vec<Option<Reg>>,
    /// The values of the program's constant registers.
    values: Vec<Option<f64>>,
}

/// Operations that run together, and the registers of the program that they fill.
pub(super) struct FusedUnit {
    pub op: Any,
    pub outs: Outs,
}

/// The registers that a unit fills: three pairs and the lengths of two of them at most. A mechanism
/// of a batch has its program for some microseconds, so that many small vectors would cost
/// noticeable time.
pub(super) type Outs = ArrayVec<Reg, 8>;

/// The registers that an operation reads, and the number of registers that it fills.
#[derive(Default)]
struct Wires {
    ins: Vec<Reg>,
    outs: u32,
}

impl KernelRunner for Wires {
    fn run<const IN: usize, const OUT: usize, K: super::kernel::Kernel<IN, OUT>>(
        &mut self,
        kernel: &K,
        _: Reg,
    ) {
        self.ins.clear();
        self.ins.extend(kernel.inputs());
        self.outs = OUT as u32;
    }
}

impl SweepProgram {
    /// Returns the program for its answers.
    pub fn fused(&self) -> &Fused {
        self.runs[0].get_or_init(|| Fused::of(self, Level::Acceleration, &self.columns))
    }

    /// Returns the program for the crossings of its joints: positions only.
    pub(super) fn fused_crossings(&self) -> &Fused {
        self.runs[1]
            .get_or_init(|| Fused::of(self, Level::Position, &self.crossings().collect::<Vec<_>>()))
    }

    /// Returns the program for its answers and the crossings of the joints that may have a change
    /// point.
    pub(super) fn fused_watched(&self) -> &Fused {
        self.runs[2].get_or_init(|| {
            Fused::of(
                self,
                Level::Acceleration,
                &self.answers().chain(self.suspects()).collect::<Vec<_>>(),
            )
        })
    }

    fn answers(&self) -> impl Iterator<Item = Reg> {
        self.columns.iter().copied()
    }

    pub(super) fn crossings(&self) -> impl Iterator<Item = Reg> {
        self.joints.iter().map(|j| j.crossing)
    }
}

/// No step, or no unit.
const NONE: u32 = u32::MAX;

/// Gives a list a length, with all entries equal, in its own memory.
fn emptied<T: Clone>(list: &mut Vec<T>, length: usize, entry: T) {
    list.clear();
    list.resize(length, entry);
}

impl Fused {
    fn of(program: &SweepProgram, level: Level, wanted: &[Reg]) -> Fused {
        let FusionMemory { tables, mut ordered, made } = MEMORY.take();
        let steps = in_order(program, level);
        let mut matching = Matching::new(program, &steps, wanted, tables);
        matching.units(&mut ordered.units);
        // Fused operations might wait for one another in a circle; the list as compiled cannot.
        if !ordered.order(program.registers, wanted) {
            matching.singles(&mut ordered.units);
            ordered.order(program.registers, wanted);
        }
        cranks::join(&mut ordered, wanted);
        let fused = ordered.placed(program, &mut matching.tables.constants, wanted, made);
        MEMORY.set(FusionMemory { tables: matching.tables, ordered, made: Fused::default() });
        fused
    }

    /// Keeps the memory of a program that is no more used, for the next one on this thread.
    pub(super) fn give_back(self) {
        MEMORY.with_borrow_mut(|memory| memory.made = self);
    }

    /// Returns the register here of a register of the program; `None` if nothing reads it.
    pub fn place(&self, reg: Reg) -> Option<Reg> {
        self.place.get(reg.0 as usize).copied().flatten()
    }

    /// Returns the number of a register of the program at a row; NaN if nothing reads it.
    pub fn number(&self, buffer: &Buffer, reg: Reg, row: usize) -> f64 {
        match self.place(reg) {
            Some(place) => buffer.get(place, row),
            None => self.values[reg.0 as usize].unwrap_or(f64::NAN),
        }
    }

    /// Returns registers for a chunk, with the constants in their places.
    pub fn buffer(&self) -> Buffer {
        self.buffer_in(Buffer::default())
    }

    /// Returns registers for a chunk in the memory of another buffer.
    pub(super) fn buffer_in(&self, used: Buffer) -> Buffer {
        let mut buffer = used.sized(self.registers);
        for (reg, value) in &self.constants {
            buffer.fill(*reg, &[*value; CHUNK]);
        }
        buffer
    }
}

/// The steps of a program up to a level, in the order of their registers: everything that an
/// operation reads has a lower number than its results.
fn in_order(program: &SweepProgram, level: Level) -> Vec<&ProgramStep> {
    let levels = &program.steps[..=level as usize];
    let mut steps: Vec<&ProgramStep> = Vec::with_capacity(levels.iter().map(Vec::len).sum());
    levels.iter().for_each(|level| steps.extend(level));
    steps.sort_by_key(|s| s.out.0);
    steps
}

/// Memory of earlier programs, to be used again: a mechanism of a batch has its program for some
/// microseconds, and the system's memory for it would take as long as the rest of its making.
#[derive(Default)]
struct FusionMemory {
    tables: RegisterTables,
    ordered: Ordered,
    made: Fused,
}

thread_local! {
    static MEMORY: RefCell<FusionMemory> = RefCell::default();
}

/// Units in an order in which each finds its inputs.
#[derive(Default)]
struct Ordered {
    units: Vec<FusedUnit>,
    order: Vec<u32>,
    /// The inputs of the units, one after the other.
    wires: Vec<Reg>,
    /// The range of inputs of each unit.
    reads: Vec<Range<usize>>,
    /// The unit that fills each register.
    maker: Vec<u32>,
    /// For each unit: 0 not yet reached, 1 waits for its inputs, 2 in order.
    state: Vec<u8>,
    /// The units that wait, each with the next of its inputs.
    stack: Vec<(u32, usize)>,
    ins: Wires,
}

impl Ordered {
    /// Orders the units; returns `false` if units wait for one another.
    fn order(&mut self, registers: usize, wanted: &[Reg]) -> bool {
        let Ordered { units, order, wires, reads, maker, state, stack, ins } = self;
        order.clear();
        wires.clear();
        reads.clear();
        stack.clear();
        emptied(maker, registers, NONE);
        emptied(state, units.len(), 0);
        for (i, unit) in units.iter().enumerate() {
            unit.outs.iter().for_each(|r| maker[r.0 as usize] = i as u32);
            unit.op.run(ins, Reg(0));
            wires.extend_from_slice(&ins.ins);
            reads.push(wires.len() - ins.ins.len()..wires.len());
        }
        // Depth first, with a stack of its own: a chain of dyads is as deep as it is long.
        for reg in wanted {
            let unit = maker[reg.0 as usize];
            if unit != NONE && state[unit as usize] == 0 {
                stack.push((unit, 0));
                state[unit as usize] = 1;
            }
            while let Some((unit, next)) = stack.last_mut() {
                let here = *unit;
                match wires[reads[here as usize].clone()].get(*next) {
                    Some(reg) => {
                        *next += 1;
                        let above = maker[reg.0 as usize];
                        if above != NONE {
                            match state[above as usize] {
                                0 => {
                                    state[above as usize] = 1;
                                    stack.push((above, 0));
                                }
                                1 => return false,
                                _ => {}
                            }
                        }
                    }
                    None => {
                        state[here as usize] = 2;
                        order.push(here);
                        stack.pop();
                    }
                }
            }
        }
        true
    }

    fn reads(&self, unit: u32) -> &[Reg] {
        &self.wires[self.reads[unit as usize].clone()]
    }

    /// Gives every register that is used a place, in the memory of `used`. `constants` are the
    /// values of constant registers; they are exchanged for free memory.
    fn placed(
        &self,
        program: &SweepProgram,
        constants: &mut Vec<Option<f64>>,
        wanted: &[Reg],
        used: Fused,
    ) -> Fused {
        let mut f = Fused { registers: INPUTS.len(), inputs: ArrayVec::new(), ..used };
        f.steps.clear();
        f.wires.clear();
        f.constants.clear();
        emptied(&mut f.place, program.registers, None);
        std::mem::swap(&mut f.values, constants);
        for reg in INPUTS {
            f.place[reg.0 as usize] = Some(reg);
        }
        // The numbers of followed links come from outside.
        for t in &program.tracks {
            for reg in [t.own.x, t.own.y, t.arm.x, t.arm.y] {
                f.give(reg);
            }
        }
        for &i in &self.order {
            for &reg in self.reads(i) {
                f.know(reg);
                f.wires.push(f.place[reg.0 as usize].unwrap_or(reg));
            }
            let unit = &self.units[i as usize];
            let out = Reg(f.registers as u32);
            unit.outs.iter().for_each(|r| f.give(*r));
            f.steps.push(PlacedOperation { op: unit.op, end: f.wires.len(), out });
        }
        wanted.iter().for_each(|r| f.know(*r));
        f.inputs =
            INPUTS.into_iter().filter(|r| f.wires.contains(r) || wanted.contains(r)).collect();
        f
    }
}

impl Fused {
    fn give(&mut self, reg: Reg) {
        self.place[reg.0 as usize] = Some(Reg(self.registers as u32));
        self.registers += 1;
    }

    /// Makes sure that a register that is read has a place: a register that no unit fills is a
    /// constant.
    fn know(&mut self, reg: Reg) {
        if self.place[reg.0 as usize].is_none() {
            self.give(reg);
            let value = self.values[reg.0 as usize].unwrap_or(f64::NAN);
            self.constants.push((Reg(self.registers as u32 - 1), value));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{PlacedScene, Stations, Width, compile, station};
    use hodograph_mechanism::mechanism::Mechanism;
    use hodograph_scene::{Find, edit, read, templates};

    fn program(name: &str, find: &[&str]) -> (SweepProgram, Stations) {
        let text = templates::get(name).unwrap();
        let text =
            if find.is_empty() { text.to_owned() } else { edit::with_find(text, find).unwrap() };
        let scene = read(&text).unwrap().value;
        let m = Mechanism::new(&scene).unwrap().value;
        let placed = PlacedScene::new(&scene, &m).unwrap();
        let now = station::position_now(&scene, &placed.at, 0);
        let reach = 0.01
            * if station::angle_per_value(&scene, &placed.at, 0) == 1.0 {
                1.0
            } else {
                placed.at.extent()
            };
        let stations =
            Stations::slid(now, now + reach, 9, station::angle_per_value(&scene, &placed.at, 0));
        // Questions seen from a frame have no kernel.
        let has =
            |f: &&Find| compile(&scene, &m, &placed.at, Some(0), std::slice::from_ref(*f)).is_ok();
        let find: Vec<Find> = scene.find.iter().filter(has).cloned().collect();
        assert!(!find.is_empty(), "{name}");
        (compile(&scene, &m, &placed.at, Some(0), &find).unwrap(), stations)
    }

    /// Common mechanisms run as one operation for each point.
    #[test]
    fn one_operation_for_each_point() {
        let leg = ["v_C", "v_D", "v_E", "v_F", "v_G", "a_C", "a_D", "a_E", "a_F", "a_G"];
        for (name, find, operations) in [
            ("crank-rocker", &["v_C", "a_C"][..], 1),
            ("crank-rocker", &["x_C", "v_C"], 1),
            ("crank-rocker", &["v_B", "v_C"], 3),
            ("crank-rocker", &["v_C", "a_C", "omega_3", "alpha_3"], 2),
            ("slider-crank", &["v_C", "a_C"], 1),
            // The rates of G do not need its position: they are arm, image and length each.
            ("jansen-leg", &leg, 11),
        ] {
            let (program, _) = program(name, find);
            let fused = program.fused();
            assert_eq!(fused.steps.len(), operations, "{name}: {:#?}", fused.steps);
        }
    }

    /// Fused or one by one, the numbers are equal within rounding.
    #[test]
    fn fused_is_what_the_list_says() {
        for t in templates::list() {
            let (program, stations) = match t.name {
                // Their followed links have numbers only once they are followed.
                "class-iii-six-bar" | "class-iv-six-bar" | "double-butterfly"
                | "stephenson-six-bar" | "two-slots" => continue,
                // Friction has no kernel, and neither have several drivers.
                name @ "compressor-friction" => program(name, &["v_C", "a_C"]),
                name @ ("toggle-clamp" | "loader-forces") => program(name, &["v_D", "a_D"]),
                name => program(name, &[]),
            };
            let wanted = &program.columns[..];
            let steps = in_order(&program, Level::Acceleration);
            let mut matching = Matching::new(&program, &steps, wanted, RegisterTables::default());
            let mut ordered = Ordered::default();
            matching.singles(&mut ordered.units);
            assert!(ordered.order(program.registers, wanted));
            let plain =
                ordered.placed(&program, &mut matching.tables.constants, wanted, Fused::default());
            let run = |fused: &Fused| -> Vec<Vec<f64>> {
                let mut buffer = fused.buffer();
                fused.load(&mut buffer, &stations, 0..stations.len());
                fused.run(&mut buffer, Width::Widest);
                wanted
                    .iter()
                    .map(|r| (0..stations.len()).map(|i| fused.number(&buffer, *r, i)).collect())
                    .collect()
            };
            for ((a, b), column) in run(program.fused()).iter().zip(run(&plain)).zip(1..) {
                let size = b.iter().fold(1.0f64, |m, x| m.max(x.abs()));
                let off = a.iter().zip(&b).fold(0.0f64, |m, (x, y)| m.max((x - y).abs()));
                assert!(off <= 1e-11 * size, "{} column {column}: {off:e} of {size}", t.name);
            }
        }
    }
}
