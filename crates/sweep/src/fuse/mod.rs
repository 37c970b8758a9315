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
use matching::Matching;
use std::ops::Range;

/// A program ready to run.
#[derive(Clone, Debug)]
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
        self.runs[0].get_or_init(|| {
            Fused::of(self, Level::Acceleration, &self.answers().collect::<Vec<_>>())
        })
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

impl Fused {
    fn of(program: &SweepProgram, level: Level, wanted: &[Reg]) -> Fused {
        // Everything that an operation reads has a lower number than its results.
        let mut steps: Vec<ProgramStep> = program.steps[..=level as usize].concat();
        steps.sort_by_key(|s| s.out.0);
        let matching = Matching::new(program, &steps, wanted);
        let fused = Ordered::of(program.registers, matching.units(), wanted);
        // Fused operations might wait for one another in a circle; the list as compiled cannot.
        let mut ordered = fused
            .or_else(|| Ordered::of(program.registers, matching.singles(), wanted))
            .unwrap_or_default();
        cranks::join(&mut ordered, wanted);
        ordered.placed(program, matching.constants, wanted)
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

/// Units in an order in which each finds its inputs.
#[derive(Default)]
struct Ordered {
    units: Vec<FusedUnit>,
    order: Vec<u32>,
    /// The inputs of the units, one after the other.
    wires: Vec<Reg>,
    /// The range of inputs of each unit.
    reads: Vec<Range<usize>>,
}

impl Ordered {
    /// Orders the units; `None` if units wait for one another.
    fn of(registers: usize, units: Vec<FusedUnit>, wanted: &[Reg]) -> Option<Ordered> {
        let mut maker = vec![NONE; registers];
        let n = units.len();
        // A unit reads hardly more than a dozen registers.
        let mut o = Ordered {
            order: Vec::with_capacity(n),
            wires: Vec::with_capacity(12 * n),
            reads: Vec::with_capacity(n),
            units: Vec::new(),
        };
        let mut ins = Wires::default();
        for (i, unit) in units.iter().enumerate() {
            unit.outs.iter().for_each(|r| maker[r.0 as usize] = i as u32);
            unit.op.run(&mut ins, Reg(0));
            o.wires.extend_from_slice(&ins.ins);
            o.reads.push(o.wires.len() - ins.ins.len()..o.wires.len());
        }
        o.units = units;
        // Depth first, with a stack of its own: a chain of dyads is as deep as it is long.
        let mut state = vec![0u8; o.units.len()];
        let mut stack: Vec<(u32, usize)> = Vec::with_capacity(n);
        for reg in wanted {
            let unit = maker[reg.0 as usize];
            if unit != NONE && state[unit as usize] == 0 {
                stack.push((unit, 0));
                state[unit as usize] = 1;
            }
            while let Some((unit, next)) = stack.last_mut() {
                let here = *unit;
                match o.reads(here).get(*next) {
                    Some(reg) => {
                        *next += 1;
                        let above = maker[reg.0 as usize];
                        if above != NONE {
                            match state[above as usize] {
                                0 => {
                                    state[above as usize] = 1;
                                    stack.push((above, 0));
                                }
                                1 => return None,
                                _ => {}
                            }
                        }
                    }
                    None => {
                        state[here as usize] = 2;
                        o.order.push(here);
                        stack.pop();
                    }
                }
            }
        }
        Some(o)
    }

    fn reads(&self, unit: u32) -> &[Reg] {
        &self.wires[self.reads[unit as usize].clone()]
    }

    /// Gives every register that is used a place.
    fn placed(&self, program: &SweepProgram, constants: Vec<Option<f64>>, wanted: &[Reg]) -> Fused {
        let mut f = Fused {
            steps: Vec::with_capacity(self.order.len()),
            wires: Vec::with_capacity(self.wires.len()),
            registers: INPUTS.len(),
            inputs: ArrayVec::new(),
            constants: Vec::with_capacity(program.constants.len()),
            place: vec![None; program.registers],
            values: constants,
        };
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
            let mut steps: Vec<ProgramStep> = program.steps.concat();
            steps.sort_by_key(|s| s.out.0);
            let matching = Matching::new(&program, &steps, wanted);
            let plain = Ordered::of(program.registers, matching.singles(), wanted).unwrap().placed(
                &program,
                matching.constants,
                wanted,
            );
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
