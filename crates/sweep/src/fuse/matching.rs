//! Pattern matching on the list of operations: finds those that give position, velocity and
//! acceleration of one point, or angular velocity and angular acceleration of one line.

use super::kernels::{CoupledPoint, Crank, Dyad, Images, LineTurning, MotionRegisters, Slider};
use super::{FusedUnit, NONE, Outs, Wires, emptied};
use crate::carry::Arm;
use crate::kernel::{Reg, RegPair};
use crate::program::{COS, Op, ProgramStep, SIN, SweepProgram};
use crate::rows::Cross;
use crate::run::{Any, FusedOp};
use arrayvec::ArrayVec;

/// A program indexed by its registers.
pub struct Matching<'a> {
    pub(super) program: &'a SweepProgram,
    pub(super) steps: &'a [&'a ProgramStep],
    pub tables: RegisterTables,
}

/// The entries of a program's registers and steps.
#[derive(Default)]
pub struct RegisterTables {
    /// The values of constant registers.
    pub constants: Vec<Option<f64>>,
    /// The step that fills each register.
    maker: Vec<u32>,
    /// The number of times that each register is read by needed steps and wanted answers.
    uses: Vec<u32>,
    /// The number of registers that each step fills; `alive` is true for the steps that are needed.
    outs: Vec<u32>,
    alive: Vec<bool>,
    /// The step that computes the length of the vector that begins at a register.
    length: Vec<u32>,
    /// True for the steps that are part of a unit.
    taken: Vec<bool>,
    wires: Wires,
}

/// A whole kernel of the given number of levels, with lengths or without.
macro_rules! levels {
    ($levels:expr, $lengths:expr, $kernel:expr => $p:ident $v:ident $a:ident $vl:ident $al:ident) => {
        match ($levels, $lengths) {
            (1, _) => FusedOp::$p($kernel),
            (2, false) => FusedOp::$v($kernel),
            (2, true) => FusedOp::$vl($kernel),
            (_, false) => FusedOp::$a($kernel),
            (_, true) => FusedOp::$al($kernel),
        }
    };
}

/// A list with an entry for each level of motion.
pub(super) type Few<T> = ArrayVec<T, 3>;

/// The kernel found for one point, by levels and lengths.
type KernelChoice<'a> = &'a dyn Fn(usize, bool) -> FusedOp;

impl<'a> Matching<'a> {
    /// Indexes a program, in the memory of other tables.
    pub fn new(
        program: &'a SweepProgram,
        steps: &'a [&'a ProgramStep],
        wanted: &[Reg],
        mut tables: RegisterTables,
    ) -> Self {
        let n = program.registers;
        let RegisterTables { constants, maker, uses, outs, alive, length, taken, wires } =
            &mut tables;
        emptied(constants, n, None);
        emptied(maker, n, NONE);
        emptied(uses, n, 0);
        emptied(outs, steps.len(), 0);
        emptied(alive, steps.len(), false);
        emptied(length, n, NONE);
        emptied(taken, steps.len(), false);
        for (reg, value) in &program.constants {
            constants[reg.0 as usize] = Some(*value);
        }
        wanted.iter().for_each(|r| uses[r.0 as usize] += 1);
        for (i, step) in steps.iter().enumerate().rev() {
            step.op.run(wires, step.out);
            outs[i] = wires.outs;
            let out = step.out.0 as usize..(step.out.0 + wires.outs) as usize;
            maker[out.clone()].fill(i as u32);
            alive[i] = uses[out].iter().any(|u| *u > 0);
            if alive[i] {
                wires.ins.iter().for_each(|r| uses[r.0 as usize] += 1);
                if let Op::VectorLength(l) = step.op {
                    length[l.v.x.0 as usize] = i as u32;
                }
            }
        }
        Matching { program, steps, tables }
    }

    /// Lists every needed step as a unit of its own.
    pub fn singles(&self, units: &mut Vec<FusedUnit>) {
        units.clear();
        units.extend((0..self.steps.len()).filter(|&i| self.alive(i)).map(|i| self.single(i)));
    }

    fn single(&self, i: usize) -> FusedUnit {
        let step = &self.steps[i];
        FusedUnit {
            op: Any::One(step.op),
            outs: (0..self.tables.outs[i]).map(|k| Reg(step.out.0 + k)).collect(),
        }
    }

    /// Lists the needed steps, with those that belong together combined.
    pub fn units(&mut self, units: &mut Vec<FusedUnit>) {
        units.clear();
        let mut taken = std::mem::take(&mut self.tables.taken);
        for motion in &self.program.motions {
            self.motion(motion, &mut taken, units);
        }
        for i in 0..self.steps.len() {
            self.turning(i, &mut taken, units);
            self.lever(i, &mut taken, units);
        }
        units.extend(
            (0..self.steps.len()).filter(|&i| self.alive(i) && !taken[i]).map(|i| self.single(i)),
        );
        self.tables.taken = taken;
    }

    /// True if a step is needed.
    pub(super) fn alive(&self, i: usize) -> bool {
        self.tables.alive[i]
    }

    /// The operation that fills a pair, if it is needed.
    pub(super) fn op(&self, pair: RegPair) -> Option<(usize, &Op)> {
        let i = self.tables.maker[pair.x.0 as usize];
        let step = self.steps.get(i as usize)?;
        (self.alive(i as usize) && step.out == pair.x && pair.y.0 == pair.x.0 + 1)
            .then_some((i as usize, &step.op))
    }

    /// The step that fills a register.
    pub(super) fn maker(&self, reg: Reg) -> Option<usize> {
        Some(self.tables.maker[reg.0 as usize] as usize).filter(|i| *i < self.steps.len())
    }

    pub(super) fn constant(&self, reg: Reg) -> Option<f64> {
        self.tables.constants[reg.0 as usize]
    }

    pub(super) fn fixed(&self, p: RegPair) -> Option<[f64; 2]> {
        Some([self.constant(p.x)?, self.constant(p.y)?])
    }

    pub(super) fn still(&self, p: RegPair) -> bool {
        self.fixed(p) == Some([0.0; 2])
    }

    /// The position, if it is constant and its rates are zero.
    fn ground(&self, m: &[RegPair]) -> Option<[f64; 2]> {
        self.fixed(m[0]).filter(|_| m[1..].iter().all(|rate| self.still(*rate)))
    }

    /// Combines position, velocity and acceleration of a point.
    fn motion(
        &self,
        motion: &[Option<RegPair>; 3],
        taken: &mut [bool],
        units: &mut Vec<FusedUnit>,
    ) {
        let (mut pairs, mut ops) = (Few::new(), Few::new());
        for pair in motion.iter().map_while(|p| *p) {
            let Some((i, op)) = self.op(pair).filter(|(i, _)| !taken[*i]) else { break };
            pairs.push(pair);
            ops.push((i, op));
        }
        // As many levels as the kernel can do together; the rest stays as it is.
        for levels in (1..=pairs.len()).rev() {
            let kinds: Few<&Op> = ops[..levels].iter().map(|o| o.1).collect();
            let mut put = |measured: bool, made: KernelChoice| {
                let lengths: Few<usize> = pairs[1..levels]
                    .iter()
                    .map(|p| self.tables.length[p.x.0 as usize] as usize)
                    .collect();
                let all = measured
                    && levels > 1
                    && lengths.iter().all(|l| *l < self.steps.len() && !taken[*l]);
                let mut outs: Outs = pairs[..levels].iter().flat_map(|p| [p.x, p.y]).collect();
                ops[..levels].iter().for_each(|o| taken[o.0] = true);
                if all {
                    lengths.iter().for_each(|l| taken[*l] = true);
                    outs.extend(lengths.iter().map(|l| self.steps[*l].out));
                }
                units.push(FusedUnit { op: Any::Whole(made(levels, all)), outs });
            };
            if self.dyad(&kinds, &pairs, &mut put)
                || self.image(&kinds, &mut put)
                || self.slider(&kinds, &pairs, &mut put)
            {
                return;
            }
        }
    }

    /// Matches two bars.
    fn dyad(
        &self,
        ops: &[&Op],
        pairs: &[RegPair],
        put: &mut dyn FnMut(bool, KernelChoice),
    ) -> bool {
        let Op::Circles(c) = ops[0] else { return false };
        let (Some(r), Some(s)) = (self.constant(c.r), self.constant(c.s)) else { return false };
        let (mut a, mut b) = (Few::from_iter([c.a]), Few::from_iter([c.b]));
        // Numbers passed from effect to effect must have no other readers.
        let det = Reg(pairs[0].x.0 + 2);
        if let Some(op) = ops.get(1) {
            let Op::Bars(v) = op else { return false };
            if (v.c, v.a, v.b, v.det, self.tables.uses[det.0 as usize])
                != (pairs[0], c.a, c.b, det, 1)
            {
                return false;
            }
            a.push(v.va);
            b.push(v.vb);
            let inverse = Reg(pairs[1].x.0 + 2);
            if let Some(op) = ops.get(2) {
                let Op::BarsRate(w) = op else { return false };
                if w.bars != *v || w.vc != pairs[1] || w.inverse != inverse {
                    return false;
                }
                a.push(w.aa);
                b.push(w.ab);
            }
            if self.tables.uses[inverse.0 as usize] != u32::from(ops.len() > 2) {
                return false;
            }
        } else if self.tables.uses[det.0 as usize] != 0 {
            return false;
        }
        let (moving, at, r, s, sign) = match (self.ground(&a), self.ground(&b)) {
            (_, Some(at)) => (a, Some(at), r, s, c.sign),
            // Seen from B, left becomes right.
            (Some(at), None) => (b.clone(), Some(at), s, r, -c.sign),
            (None, None) => (a, None, r, s, c.sign),
        };
        let (a, b) = (motion_of(&moving), motion_of(&b));
        put(true, &|levels, lengths| match at {
            Some(at) => {
                levels!(levels, lengths, Dyad { a, b: a, at, r, s, sign } => DyadGroundP DyadGroundV DyadGroundA DyadGroundVL DyadGroundAL)
            }
            None => {
                levels!(levels, lengths, Dyad { a, b, at: [0.0; 2], r, s, sign } => DyadP DyadV DyadA DyadVL DyadAL)
            }
        });
        true
    }

    /// Matches a point of a link.
    fn image(&self, ops: &[&Op], put: &mut dyn FnMut(bool, KernelChoice)) -> bool {
        let mut images = Few::new();
        for op in ops {
            let Op::Image(i) = op else { return false };
            images.push(*i);
        }
        let k = images[0].k;
        if images.iter().any(|i| i.k != k) {
            return false;
        }
        let (o, d): (Few<RegPair>, Few<RegPair>) = images.iter().map(|i| (i.o, i.d)).unzip();
        let ground = self.ground(&o);
        if let Some(crank) = ground.and_then(|o| self.crank(o, k, &d)) {
            put(false, &|levels, _| match (levels, crank.is_even()) {
                (1, false) => FusedOp::CrankP(crank.turned_to()),
                (2, false) => FusedOp::CrankV(crank.turned_to()),
                (_, false) => FusedOp::CrankA(crank),
                (1, true) => FusedOp::EvenP(crank.turned_to()),
                (2, true) => FusedOp::EvenV(crank.turned_to()),
                (_, true) => FusedOp::EvenA(crank.turned_to()),
            });
            return true;
        }
        let ends: Option<Few<RegPair>> =
            d.iter().zip(&o).map(|(d, o)| self.end_from(*d, *o)).collect();
        let (o, d) = (motion_of(&o), motion_of(&d));
        match ends {
            Some(ends) => {
                let n = motion_of(&ends);
                put(true, &|levels, lengths| match ground {
                    Some(at) => {
                        levels!(levels, lengths, CoupledPoint { n, o: n, at, k } => CoupledGroundP CoupledGroundV CoupledGroundA CoupledGroundVL CoupledGroundAL)
                    }
                    None => {
                        levels!(levels, lengths, CoupledPoint { n, o, at: [0.0; 2], k } => CoupledP CoupledV CoupledA CoupledVL CoupledAL)
                    }
                });
            }
            None => put(
                true,
                &|levels, lengths| levels!(levels, lengths, Images { o, d, k } => ImagesP ImagesV ImagesA ImagesVL ImagesAL),
            ),
        }
        true
    }

    /// The end of an arm that begins at a point.
    fn end_from(&self, d: RegPair, o: RegPair) -> Option<RegPair> {
        match self.op(d)? {
            (_, Op::Arm(Arm { from, to })) if *from == o => Some(*to),
            _ => None,
        }
    }

    /// Matches an arm that turns with the driver, and its rates.
    fn crank(&self, o: [f64; 2], k: [f64; 2], d: &[RegPair]) -> Option<Crank<3, false>> {
        let (_, Op::Twist(twist)) = self.op(d[0])? else { return None };
        let turn = RegPair { x: COS, y: SIN };
        let [p, q] = twist.k;
        let mut crank = Crank {
            turn,
            o,
            k: [p * k[0] - q * k[1], p * k[1] + q * k[0]],
            omega: 0.0,
            alpha: 0.0,
        };
        if twist.d != turn {
            return None;
        }
        if let Some(v) = d.get(1) {
            let (_, Op::ArmSwing(swing)) = self.op(*v)? else { return None };
            crank.omega =
                self.constant(swing.omega).filter(|_| swing.r == d[0] && self.still(swing.v))?;
            if let Some(a) = d.get(2) {
                let (_, Op::SwingRate(rate)) = self.op(*a)? else { return None };
                let same = rate.r == d[0] && rate.omega == swing.omega && self.still(rate.a);
                crank.alpha = self.constant(rate.alpha).filter(|_| same)?;
            }
        }
        Some(crank)
    }

    /// Matches a pin on a bar and on a fixed guide.
    fn slider(
        &self,
        ops: &[&Op],
        pairs: &[RegPair],
        put: &mut dyn FnMut(bool, KernelChoice),
    ) -> bool {
        self.sliding(ops, pairs).is_some_and(|s| {
            let Slider { a, r, q, t, sign } = s;
            put(
                true,
                &|levels, lengths| levels!(levels, lengths, Slider { a, r, q, t, sign } => SliderP SliderV SliderA SliderVL SliderAL),
            );
            true
        })
    }

    fn sliding(&self, ops: &[&Op], pairs: &[RegPair]) -> Option<Slider<3, false>> {
        let Op::CircleLine(c) = ops[0] else { return None };
        let (r, q, t) = (self.constant(c.r)?, self.fixed(c.q)?, self.fixed(c.t)?);
        let mut a = Few::from_iter([c.a]);
        for (level, op) in ops.iter().enumerate().skip(1) {
            let Op::Cross(cross) = op else { return None };
            let (n, bar, square, guide) = self.rows_of(cross)?;
            let along_bar =
                self.op(n).is_some_and(|(_, op)| *op == Op::Arm(Arm { from: c.a, to: pairs[0] }));
            if !along_bar || self.fixed(square)? != [-t[1], t[0]] {
                return None;
            }
            a.push(match (level, bar, guide) {
                (1, Op::Distance(d), Op::Guided(g)) => {
                    let rests =
                        self.still(g.vo) && self.constant(g.omega) == Some(0.0) && g.rate == 0.0;
                    (rests && d.rate == 0.0 && g.n == square).then_some(d.vf)?
                }
                (2, Op::DistanceRate(d), Op::GuidedRate(g)) => {
                    let turning = [g.omega, g.alpha].iter().any(|w| self.constant(*w) != Some(0.0));
                    let rests =
                        !turning && self.still(g.vo) && self.still(g.ao) && g.acceleration == 0.0;
                    let same = d.vp == pairs[1]
                        && a.last() == Some(&d.vf)
                        && d.rate == 0.0
                        && d.acceleration == 0.0;
                    (rests && same).then_some(d.af)?
                }
                _ => return None,
            });
        }
        Some(Slider { a: motion_of(&a), r, q, t, sign: c.sign })
    }

    /// The two rows of a crossing, that of a distance first: each with its direction and operation.
    fn rows_of(&self, c: &Cross) -> Option<(RegPair, &Op, RegPair, &Op)> {
        let row = |reg: Reg| self.maker(reg).map(|i| &self.steps[i].op);
        let (first, second) = (row(c.c1)?, row(c.c2)?);
        match first {
            Op::Distance(_) | Op::DistanceRate(_) => Some((c.n1, first, c.n2, second)),
            _ => Some((c.n2, second, c.n1, first)),
        }
    }

    /// Combines ω and α of a line between two points.
    fn turning(&self, i: usize, taken: &mut [bool], units: &mut Vec<FusedUnit>) {
        let Op::ArmTurning(turning) = &self.steps[i].op else { return };
        if !self.alive(i) || taken[i] {
            return;
        }
        let arm = |d: RegPair| match self.op(d) {
            Some((_, Op::Arm(arm))) => Some(*arm),
            _ => None,
        };
        let (Some(d), Some(v)) = (arm(turning.d), arm(turning.v)) else { return };
        let omega = self.steps[i].out;
        let (mut o, mut n) = (Few::from_iter([d.from, v.from]), Few::from_iter([d.to, v.to]));
        let mut outs = Outs::from_iter([omega]);
        taken[i] = true;
        let rate = (i + 1..self.steps.len()).find(|&k| match &self.steps[k].op {
            Op::TurningRate(rate) => {
                self.alive(k)
                    && !taken[k]
                    && rate.omega == omega
                    && rate.d == turning.d
                    && rate.v == turning.v
            }
            _ => false,
        });
        if let Some(k) = rate
            && let Op::TurningRate(rate) = &self.steps[k].op
            && let Some(a) = arm(rate.a)
        {
            taken[k] = true;
            o.push(a.from);
            n.push(a.to);
            outs.push(self.steps[k].out);
        }
        let ground = self.ground(&o);
        let (o, n, three) = (motion_of(&o), motion_of(&n), outs.len() > 1);
        let op = match (ground, three) {
            (Some(at), false) => FusedOp::TurnedGroundV(LineTurning { n, o: n, at }),
            (Some(at), true) => FusedOp::TurnedGroundA(LineTurning { n, o: n, at }),
            (None, false) => FusedOp::TurnedV(LineTurning { n, o, at: [0.0; 2] }),
            (None, true) => FusedOp::TurnedA(LineTurning { n, o, at: [0.0; 2] }),
        };
        units.push(FusedUnit { op: Any::Whole(op), outs });
    }
}

/// The motion of the given pairs; rates that do not exist repeat the last one, and nothing reads
/// them.
pub(super) fn motion_of(pairs: &[RegPair]) -> MotionRegisters {
    std::array::from_fn(|i| pairs[i.min(pairs.len() - 1)])
}
