//! A crank on whose pin one group alone hangs is done together with that group: what it finds stays in the machine's registers.

use super::kernels::OnCrank;
use super::{Ordered, Unit};
use crate::sweep::kernel::Reg;
use crate::sweep::run::{Any, Whole};

/// The group on a crank, by the kernels of both.
macro_rules! joined {
    ($both:expr; $($crank:ident: $($group:ident => $new:ident),*;)*) => {
        match $both {
            $($((Any::Whole(Whole::$crank(crank)), Any::Whole(Whole::$group(group))) => Some(Whole::$new(OnCrank { crank, group })),)*)*
            _ => None,
        }
    };
}

/// Joins every crank whose numbers one unit alone reads, and reads nothing else, with that unit.
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

/// The unit that a crank is joined with, and what both are then.
fn reader(all: &Ordered, crank: u32, wanted: &[Reg]) -> Option<(u32, Whole)> {
    let Unit { op, outs } = &all.units[crank as usize];
    if !is_crank(op) || outs.iter().any(|r| wanted.contains(r)) {
        return None;
    }
    let mut readers = all.order.iter().filter(|unit| all.reads(**unit).iter().any(|r| outs.contains(r)));
    match (readers.next(), readers.next()) {
        (Some(&unit), None) if all.reads(unit) == &outs[..] => Some((unit, of(*op, all.units[unit as usize].op)?)),
        _ => None,
    }
}

fn is_crank(op: &Any) -> bool {
    use Whole::*;
    matches!(op, Any::Whole(CrankP(_) | CrankV(_) | CrankA(_) | EvenP(_) | EvenV(_) | EvenA(_)))
}

/// The kernel of both.
fn of(crank: Any, group: Any) -> Option<Whole> {
    joined! { (crank, group);
        CrankP: DyadGroundP => CrankDyadP, SliderP => CrankSliderP;
        CrankV: DyadGroundV => CrankDyadV, DyadGroundVL => CrankDyadVL, SliderV => CrankSliderV, SliderVL => CrankSliderVL,
            SlottedV => CrankSlottedV;
        CrankA: DyadGroundA => CrankDyadA, DyadGroundAL => CrankDyadAL, SliderA => CrankSliderA, SliderAL => CrankSliderAL,
            SlottedA => CrankSlottedA;
        EvenP: DyadGroundP => EvenDyadP, SliderP => EvenSliderP;
        EvenV: DyadGroundV => EvenDyadV, DyadGroundVL => EvenDyadVL, SliderV => EvenSliderV, SliderVL => EvenSliderVL,
            SlottedV => EvenSlottedV;
        EvenA: DyadGroundA => EvenDyadA, DyadGroundAL => EvenDyadAL, SliderA => EvenSliderA, SliderAL => EvenSliderAL,
            SlottedA => EvenSlottedA;
    }
}
