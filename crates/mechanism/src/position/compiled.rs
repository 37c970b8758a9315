//! Assembling compiled once for each number in which it is asked for.
//!
//! A generic function is compiled anew in every crate that calls it: the assembly of groups, in seven numbers, was a third of what the program
//! took to build. Calls go through a method of the number, which is compiled here.

use super::{Configuration, assemble};
use crate::mechanism::{Demand, Mechanism};
use hodograph_base::diag::Faults;
use hodograph_base::number::{Ball, Big, Dd, Real};
use hodograph_scene::Scene;

/// A number in which mechanisms are assembled: [`recompute`] and [`later`] as methods of it.
pub trait Placed: Real {
    /// See [`recompute`].
    #[expect(clippy::missing_errors_doc, reason = "said there")]
    fn recompute(scene: &Scene, mechanism: &Mechanism, demand: &Demand, meant: &Configuration) -> Result<Configuration<Self>, Faults>;

    /// See [`later`].
    #[expect(clippy::missing_errors_doc, reason = "said there")]
    fn later(
        scene: &Scene,
        mechanism: &Mechanism,
        demand: &Demand,
        meant: &Configuration,
        now: &Configuration<Self>,
        t: Self,
    ) -> Result<Configuration<Self>, Faults>;
}

macro_rules! compiled {
    ($($number:ty),*) => {$(
        impl Placed for $number {
            fn recompute(scene: &Scene, mechanism: &Mechanism, demand: &Demand, meant: &Configuration) -> Result<Configuration<Self>, Faults> {
                assemble::recompute(scene, mechanism, demand, meant)
            }

            fn later(
                scene: &Scene,
                mechanism: &Mechanism,
                demand: &Demand,
                meant: &Configuration,
                now: &Configuration<Self>,
                t: Self,
            ) -> Result<Configuration<Self>, Faults> {
                assemble::later(scene, mechanism, demand, meant, now, t)
            }
        }
    )*};
}

compiled!(f32, f64, Dd, Big, Ball<f64>, Ball<Dd>, Ball<Big>);

/// The same assembly in other numbers: nothing is chosen or checked again, only computed.
///
/// Closed forms are evaluated in `N`; a group that has none is refined from `meant` and, where `N` knows its error, its
/// existence and uniqueness near by are proved.
///
/// # Errors
/// A group that cannot be closed in these numbers: as written it misses by less than `f64` can tell, or the proof fails.
pub fn recompute<N: Placed>(
    scene: &Scene,
    mechanism: &Mechanism,
    demand: &Demand,
    meant: &Configuration,
) -> Result<Configuration<N>, Faults> {
    N::recompute(scene, mechanism, demand, meant)
}

/// The configuration a short time `t` (s) after the scene's instant, the drivers having gone on at their rates. `now` is the
/// one at the instant, in the same numbers; what is given in the pose (guides that run through a pin where it is) is
/// carried along in the links.
///
/// # Errors
/// As [`recompute`]; and `pose-given`, where the pose is given by coordinates, a driver says no position, or a gliding link
/// has no point of its own, so that nothing tells it at another time.
pub fn later<N: Placed>(
    scene: &Scene,
    mechanism: &Mechanism,
    demand: &Demand,
    meant: &Configuration,
    now: &Configuration<N>,
    t: N,
) -> Result<Configuration<N>, Faults> {
    N::later(scene, mechanism, demand, meant, now, t)
}
