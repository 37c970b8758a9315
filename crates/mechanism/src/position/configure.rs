//! The configuration of a scene: assembled in `f64`; in longer numbers if `f64` cannot distinguish
//! closures; with other closures of groups that the scene does not determine.

use super::Configuration;
use super::assemble::{Assembly, names_of};
use crate::mechanism::{Demand, Mechanism};
use hodograph_base::diag::{Both, Diagnostic, Faults, Severity, Warned, both};
use hodograph_base::number::{Ball, Big, Dd, Real, within};
use hodograph_scene::Scene;

/// Computes the positions of everything that the demand requests.
///
/// # Errors
/// Missing and contradictory lengths, groups that cannot be assembled (with the links and the
/// amount by which they miss), undetermined poses. All faults of independent groups are reported
/// together.
pub fn configure(
    scene: &Scene,
    mechanism: &Mechanism,
    demand: &Demand,
) -> Result<Warned<Configuration>, Faults> {
    let first = Assembly::new(scene, mechanism, demand, None).go(demand);
    if !first.faults.has_errors() {
        return first.finish();
    }
    if let Some(longer) = in_longer_numbers(scene, mechanism, demand, &first.faults) {
        return longer;
    }
    let does_not_close = |d: &Diagnostic| DOES_NOT_CLOSE.contains(&d.code);
    if first.open.is_empty() || !first.faults.list.iter().any(does_not_close) {
        return first.closed()?.finish();
    }
    // A group that the scene leaves open may prevent a later group from closing (in Peaucellier's
    // inversor two dyads on the same pivots coincide): another assembly of one of the open groups
    // is tried, the last group first.
    let others = first
        .open
        .iter()
        .rev()
        .flat_map(|&(group, ways)| (1..ways).map(move |instead| (group, instead)));
    let found = others.take(MOST_TRIED).find_map(|other| {
        let mut a = Assembly::new(scene, mechanism, demand, None);
        a.instead = Some(other);
        a.go(demand).closed().and_then(Assembly::finish).ok()
    });
    found.ok_or_else(|| {
        let names: Vec<Both> = first
            .open
            .iter()
            .map(|(g, _)| both!("link{}", names_of(scene, &mechanism.groups[*g])))
            .collect();
        let names = Both::join(&names, [", of ", "、"]);
        let hint = both!("or say with \"side\" or \"sketch\" which assembly of {} is meant", names);
        let mut faults = first.faults;
        for d in faults.list.iter_mut().filter(|d| does_not_close(d)) {
            d.help = Some(d.help.take().map_or_else(|| hint.clone(), |h| both!("{}; {}", h, hint)));
        }
        faults
    })
}

/// Returns the assembly in longer numbers, in which its faults may disappear: two points less than
/// a unit in the last place apart are one in `f64`, and longer numbers give the direction between
/// them. `None` if longer numbers do not decide either.
fn in_longer_numbers(
    scene: &Scene,
    mechanism: &Mechanism,
    demand: &Demand,
    faults: &Faults,
) -> Option<Result<Warned<Configuration>, Faults>> {
    let hidden = |d: &Diagnostic| d.severity != Severity::Error || HIDDEN.contains(&d.code);
    if !faults.list.iter().all(hidden) {
        return None;
    }
    let longer = placed_in::<Ball<Dd>>(scene, mechanism, demand).or_else(|| {
        BITS.into_iter()
            .find_map(|bits| within(bits, || placed_in::<Ball<Big>>(scene, mechanism, demand)))
    });
    let Warned { value: at, notes } = longer?;
    let mut checked = Assembly::<f64>::new(scene, mechanism, demand, None);
    checked.check(&at);
    Some(if checked.faults.has_errors() {
        Err(checked.faults)
    } else {
        Ok(Warned { value: at, notes: [notes, checked.notes].concat() })
    })
}

/// Faults that may disappear in longer numbers.
const HIDDEN: [&str; 2] = ["degenerate-guide", "coincident-points"];

/// Bits of the longer numbers beyond double-double.
const BITS: [usize; 3] = [192, 384, 768];

/// Returns the whole assembly in another number type, rounded; `None` if that type does not decide
/// either.
fn placed_in<N: Real>(
    scene: &Scene,
    mechanism: &Mechanism,
    demand: &Demand,
) -> Option<Warned<Configuration>> {
    let mut placed =
        Assembly::<N>::new(scene, mechanism, demand, None).place(demand).ok()?.settled();
    let notes = std::mem::take(&mut placed.notes);
    let at = placed.into_configuration().approx();
    let points = at.points.iter().flatten().all(|p| p.is_finite());
    let told =
        points && at.poses.iter().flatten().all(|p| p.origin.is_finite() && p.axis.is_finite());
    told.then_some(Warned { value: at, notes })
}

/// Codes of faults of a group that cannot be closed on the groups before it.
const DOES_NOT_CLOSE: [&str; 3] = ["cannot-assemble", "coincident-points", "degenerate-guide"];

/// Greatest number of other assemblies tried if the first does not close: each costs as much as the
/// first.
const MOST_TRIED: usize = 32;
