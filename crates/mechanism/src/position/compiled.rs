//! Assembly compiled once for each number type.
//!
//! A generic function is compiled anew in every crate that calls it: the assembly of groups, in
//! seven number types, would take a third of the program's build time. Calls go through a method of
//! the number type, which is compiled here.

use super::{Configuration, assemble};
use crate::mechanism::{Demand, Mechanism};
use hodograph_base::diag::Faults;
use hodograph_base::number::{Ball, Big, Dd, Real};
use hodograph_scene::Scene;

/// A number type in which mechanisms are assembled: [`recompute`] and [`later`] as its methods.
pub trait AssemblyNumber: Real {
    /// See [`recompute`].
    #[expect(clippy::missing_errors_doc, reason = "said there")]
    fn recompute(
        scene: &Scene,
        mechanism: &Mechanism,
        demand: &Demand,
        meant: &Configuration,
    ) -> Result<Configuration<Self>, Faults>;

    /// See [`later`].
    #[expect(clippy::missing_errors_doc, reason = "said there")]
    fn later(
        scene: &Scene,
        mechanism: &Mechanism,
        demand: &Demand,
        meant: &Configuration,
        now: &Configuration<Self>,
        t: Self,
    ) -> Result<(Configuration<Self>, Vec<f64>), Faults>;
}

macro_rules! compiled {
    ($($number:ty),*) => {$(
        impl AssemblyNumber for $number {
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
            ) -> Result<(Configuration<Self>, Vec<f64>), Faults> {
                assemble::later(scene, mechanism, demand, meant, now, t)
            }
        }
    )*};
}

compiled!(f32, f64, Dd, Big, Ball<f64>, Ball<Dd>, Ball<Big>);

/// Returns the same assembly in another number type: nothing is chosen or checked again, only
/// computed.
///
/// Closed forms are evaluated in `N`; a group without one is refined from `meant` and, if `N` knows
/// its error, its existence and local uniqueness are proved.
///
/// # Errors
/// A group that cannot be closed in these numbers: as written it misses by less than `f64` can
/// show, or the proof fails.
pub fn recompute<N: AssemblyNumber>(
    scene: &Scene,
    mechanism: &Mechanism,
    demand: &Demand,
    meant: &Configuration,
) -> Result<Configuration<N>, Faults> {
    N::recompute(scene, mechanism, demand, meant)
}

/// Returns the configuration a short time `t` (s) after the scene's instant, with the drivers moved
/// on at their rates. `now` is the configuration at the instant, in the same numbers; quantities
/// given in the pose (guides through the position of a pin) move with their links.
///
/// # Errors
/// As [`recompute`]; and `pose-given` if the pose is given by coordinates, a driver has no
/// position, or a gliding link has no point, so that nothing determines it at another time.
pub fn later<N: AssemblyNumber>(
    scene: &Scene,
    mechanism: &Mechanism,
    demand: &Demand,
    meant: &Configuration,
    now: &Configuration<N>,
    t: N,
) -> Result<Configuration<N>, Faults> {
    later_apart(scene, mechanism, demand, meant, now, t).map(|(at, _)| at)
}

/// Returns the configuration of [`later`], and for each group the largest distance of a pin (m)
/// there and in the other closure of the group, infinite without another closure.
///
/// # Errors
/// As [`later`].
pub fn later_apart<N: AssemblyNumber>(
    scene: &Scene,
    mechanism: &Mechanism,
    demand: &Demand,
    meant: &Configuration,
    now: &Configuration<N>,
    t: N,
) -> Result<(Configuration<N>, Vec<f64>), Faults> {
    N::later(scene, mechanism, demand, meant, now, t)
}
