//! Fuses a crank with the one group that is connected to its pin: the crank's results stay in the
//! machine's registers.

use super::kernels::*;
use super::{FusedUnit, Ordered};
use crate::kernel::{Kernel, Reg};
use crate::lane::Lane;
use crate::run::{Any, FusedOp};

/// A group that is connected to the pin of a crank and to no other moving part, together with the
/// crank.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnCrank<C, K> {
    /// The crank.
    pub crank: C,
    /// The group, with registers that are not read.
    pub group: K,
}

/// Joins each crank with the unit that reads its numbers, if that unit is the only reader and reads
/// nothing else.
pub(super) fn join(all: &mut Ordered, wanted: &[Reg]) {
    let mut k = 0;
    while k < all.order.len() {
        let crank = all.order[k];
        match reader(all, crank, wanted) {
            Some((unit, op)) => {
                all.units[unit as usize].op = Any::Whole(op);
                all.reads[unit as usize] = all.reads[crank as usize].clone();
                all.order.remove(k);
            }
            None => k += 1,
        }
    }
}

/// The unit to join with a crank, and the kernel of both.
fn reader(all: &Ordered, crank: u32, wanted: &[Reg]) -> Option<(u32, FusedOp)> {
    let FusedUnit { op, outs } = &all.units[crank as usize];
    if !is_crank(op) || outs.iter().any(|r| wanted.contains(r)) {
        return None;
    }
    let mut readers =
        all.order.iter().filter(|unit| all.reads(**unit).iter().any(|r| outs.contains(r)));
    match (readers.next(), readers.next()) {
        (Some(&unit), None) if all.reads(unit) == &outs[..] => {
            Some((unit, joined(*op, all.units[unit as usize].op)?))
        }
        _ => None,
    }
}

fn is_crank(op: &Any) -> bool {
    use FusedOp::*;
    matches!(op, Any::Whole(CrankP(_) | CrankV(_) | CrankA(_) | EvenP(_) | EvenV(_) | EvenA(_)))
}

/// Declares the groups on cranks: the name of each, the kernels of both, the count of numbers from
/// the one to the other, and the count of results; and [`joined`], which finds the kernel of both.
macro_rules! on_cranks {
    ($($name:ident = $crank:ident, $group:ident: $in:literal => $out:literal;)*) => {
        $(
            #[doc = concat!("[`", stringify!($group), "`] on a crank.")]
            pub type $name = OnCrank<$crank, $group>;

            impl Kernel<2, $out> for $name {
                fn inputs(&self) -> [Reg; 2] {
                    self.crank.inputs()
                }

                #[inline(always)]
                fn eval<N: Lane>(&self, x: [N; 2]) -> [N; $out] {
                    let pin: [N; $in] = self.crank.eval(x);
                    self.group.eval(pin)
                }
            }
        )*

        /// The kernel of a group on a crank, if there is one.
        fn joined(crank: Any, group: Any) -> Option<FusedOp> {
            match (crank, group) {
                $((Any::Whole(FusedOp::$crank(crank)), Any::Whole(FusedOp::$group(group))) => {
                    Some(FusedOp::$name(OnCrank { crank, group }))
                })*
                _ => None,
            }
        }
    };
}

on_cranks! {
    CrankDyadP = CrankP, DyadGroundP: 2 => 2;
    CrankDyadV = CrankV, DyadGroundV: 4 => 4;
    CrankDyadA = CrankA, DyadGroundA: 6 => 6;
    CrankDyadVL = CrankV, DyadGroundVL: 4 => 5;
    CrankDyadAL = CrankA, DyadGroundAL: 6 => 8;
    CrankSliderP = CrankP, SliderP: 2 => 2;
    CrankSliderV = CrankV, SliderV: 4 => 4;
    CrankSliderA = CrankA, SliderA: 6 => 6;
    CrankSliderVL = CrankV, SliderVL: 4 => 5;
    CrankSliderAL = CrankA, SliderAL: 6 => 8;
    CrankSlottedV = CrankV, SlottedV: 4 => 5;
    CrankSlottedA = CrankA, SlottedA: 6 => 8;
    EvenDyadP = EvenP, DyadGroundP: 2 => 2;
    EvenDyadV = EvenV, DyadGroundV: 4 => 4;
    EvenDyadA = EvenA, DyadGroundA: 6 => 6;
    EvenDyadVL = EvenV, DyadGroundVL: 4 => 5;
    EvenDyadAL = EvenA, DyadGroundAL: 6 => 8;
    EvenSliderP = EvenP, SliderP: 2 => 2;
    EvenSliderV = EvenV, SliderV: 4 => 4;
    EvenSliderA = EvenA, SliderA: 6 => 6;
    EvenSliderVL = EvenV, SliderVL: 4 => 5;
    EvenSliderAL = EvenA, SliderAL: 6 => 8;
    EvenSlottedV = EvenV, SlottedV: 4 => 5;
    EvenSlottedA = EvenA, SlottedA: 6 => 8;
}
