//! Fuses the operations of a lever that turns about a fixed pivot and has a slot over a pin.

use super::kernels::SlottedLever;
use super::matching::{Few, Matching, motion_of};
use super::{FusedUnit, Outs};
use crate::carry::{Arm, ArmSwing, SwingRate};
use crate::closure::SlotLever;
use crate::kernel::{Reg, RegPair};
use crate::program::Op;
use crate::rows::{ReducedRate, SlotRate, TurnOf};
use crate::run::{Any, FusedOp};
use arrayvec::ArrayVec;

/// The operations of a lever that are known during the search for the others.
struct LeverSlot<'a> {
    lever: &'a SlotLever,
    arm: RegPair,
    n: RegPair,
    twist: [f64; 2],
}

impl Matching<'_> {
    pub(super) fn lever(&self, i: usize, taken: &mut [bool], units: &mut Vec<FusedUnit>) {
        let Op::SlotLever(lever) = &self.steps[i].op else { return };
        let Some(at) = self.fixed(lever.a).filter(|_| self.alive(i)) else { return };
        let arm = pair(self.steps[i].out);
        let later = || (i + 1..self.steps.len()).filter(|&k| self.alive(k) && !taken[k]);
        // A link has one slot, and its normal is made once.
        let Some((turn, slot, v)) = later().find_map(|k| {
            let Op::TurnOf(turn) = &self.steps[k].op else { return None };
            let Op::Twist(twist) = self.op(turn.n)?.1 else { return None };
            let slot = LeverSlot { lever, arm, n: turn.n, twist: twist.k };
            let v = self.pin_velocity(&slot, turn).filter(|_| twist.d == arm)?;
            Some((k, slot, v))
        }) else {
            return;
        };
        let omega = self.steps[turn].out;
        let swings = |k: &usize| match &self.steps[*k].op {
            Op::ArmSwing(ArmSwing { v, r, omega: w }) => self.still(*v) && *r == arm && *w == omega,
            _ => false,
        };
        let Some(rate) = later().find(swings) else { return };
        let mut b = Few::from_iter([lever.b, v]);
        let mut outs =
            Outs::from_iter([arm.x, arm.y, self.steps[rate].out, pair(self.steps[rate].out).y]);
        let mut done = ArrayVec::<usize, 5>::from_iter([i, turn, rate]);
        let third = later().find_map(|k| {
            let Op::TurnOf(turn) = &self.steps[k].op else { return None };
            let a = self.pin_acceleration(&slot, turn, omega, v)?;
            let alpha = self.steps[k].out;
            let rate = later().find(|&k| match &self.steps[k].op {
                Op::SwingRate(SwingRate { a, r, omega: w, alpha: e }) => {
                    self.still(*a) && *r == arm && *w == omega && *e == alpha
                }
                _ => false,
            })?;
            Some((k, rate, a))
        });
        let LeverSlot { twist: n, .. } = slot;
        let SlotLever { h, sign, k, .. } = *lever;
        let op = match third {
            Some((turn, rate, a)) => {
                b.push(a);
                let out = pair(self.steps[rate].out);
                outs.extend([out.x, out.y, omega, self.steps[turn].out]);
                done.extend([turn, rate]);
                FusedOp::SlottedA(SlottedLever { b: motion_of(&b), at, h, sign, k, n })
            }
            None => {
                outs.push(omega);
                FusedOp::SlottedV(SlottedLever { b: motion_of(&b), at, h, sign, k, n })
            }
        };
        done.into_iter().for_each(|k| taken[k] = true);
        units.push(FusedUnit { op: Any::Whole(op), outs });
    }

    /// The velocity v_B, if `turn` gives the ω of the lever from its slot: ω = n·v_B / n·(r turned
    /// by 90°).
    fn pin_velocity(&self, slot: &LeverSlot, turn: &TurnOf) -> Option<RegPair> {
        let Op::Distance(row) = self.row(turn.c)? else { return None };
        let rests = row.rate == 0.0 && row.n == slot.n && self.still(turn.v);
        (rests && self.reaches(slot, turn.r)).then_some(row.vf)
    }

    /// The acceleration a_B, if `turn` gives the α of the lever from its slot.
    fn pin_acceleration(
        &self,
        slot: &LeverSlot,
        turn: &TurnOf,
        omega: Reg,
        v: RegPair,
    ) -> Option<RegPair> {
        let Op::ReducedRate(ReducedRate { n, r, c, omega: w, alpha }) = *self.row(turn.c)? else {
            return None;
        };
        let Op::SlotRate(SlotRate { n: normal, r: arm, vb, ab, vo, omega: turning }) =
            *self.row(c)?
        else {
            return None;
        };
        let same = [turn.n, n, normal] == [slot.n; 3]
            && [r, arm] == [turn.r; 2]
            && [w, turning] == [omega; 2]
            && vb == v;
        let rests = self.still(turn.v) && self.still(vo) && self.constant(alpha) == Some(0.0);
        (same && rests && self.reaches(slot, turn.r)).then_some(ab)
    }

    /// True if an arm leads from the lever's pivot to its pin.
    fn reaches(&self, slot: &LeverSlot, r: RegPair) -> bool {
        self.op(r)
            .is_some_and(|(_, op)| *op == Op::Arm(Arm { from: slot.lever.a, to: slot.lever.b }))
            && slot.arm != r
    }

    /// The operation that fills a single register.
    fn row(&self, reg: Reg) -> Option<&Op> {
        self.maker(reg).map(|i| &self.steps[i].op)
    }
}

fn pair(x: Reg) -> RegPair {
    RegPair { x, y: Reg(x.0 + 1) }
}
