//! The configuration of a scene: assembled in `f64`; again in longer numbers where `f64` cannot tell closures apart; with other closures
//! of groups for which the scene does not say which is meant.

use super::Configuration;
use super::assemble::{Assembly, names_of};
use crate::mechanism::{Demand, Mechanism};
use hodograph_base::diag::{Both, Diagnostic, Faults, Severity, Warned, both};
use hodograph_base::number::{Ball, Big, Dd, Real, within};
use hodograph_scene::Scene;

/// Finds where everything is that the demand calls for.
///
/// # Errors
/// Missing and contradictory lengths, groups that cannot be assembled (with the links and the amount by which they miss),
/// poses that nothing fixes. All faults of independent groups are reported together.
pub fn configure(scene: &Scene, mechanism: &Mechanism, demand: &Demand) -> Result<Warned<Configuration>, Faults> {
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
    // What one group leaves open may keep a later one from closing (in Peaucellier's inversor two dyads on the same pivots fall
    // together): another assembly of one of the groups that nothing decided is tried, the last of them first.
    let others = first.open.iter().rev().flat_map(|&(group, ways)| (1..ways).map(move |instead| (group, instead)));
    let found = others.take(MOST_TRIED).find_map(|other| {
        let mut a = Assembly::new(scene, mechanism, demand, None);
        a.instead = Some(other);
        a.go(demand).closed().and_then(Assembly::finish).ok()
    });
    found.ok_or_else(|| {
        let names: Vec<Both> = first.open.iter().map(|(g, _)| both!("link{}", "构件{}", names_of(scene, &mechanism.groups[*g]))).collect();
        let names = Both::join(&names, ", of ", "、");
        let hint = both!(
            "or say with \"side\" or \"sketch\" which assembly of {} is meant",
            "或用 \"side\" 或 \"sketch\" 说明{}取哪一种装配形式",
            names
        );
        let mut faults = first.faults;
        for d in faults.list.iter_mut().filter(|d| does_not_close(d)) {
            d.help = Some(d.help.take().map_or_else(|| hint.clone(), |h| both!("{}; {}", "{}；{}", h, hint)));
        }
        faults
    })
}

/// The assembly in longer numbers, where its faults may be none there: two points less than a unit in the last place apart are one in
/// `f64`, and the direction between them is that of longer numbers. `None` where these cannot tell it either.
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
    let longer = placed_in::<Ball<Dd>>(scene, mechanism, demand)
        .or_else(|| BITS.into_iter().find_map(|bits| within(bits, || placed_in::<Ball<Big>>(scene, mechanism, demand))));
    let Warned { value: at, notes } = longer?;
    let mut checked = Assembly::<f64>::new(scene, mechanism, demand, None);
    checked.check(&at);
    Some(if checked.faults.has_errors() { Err(checked.faults) } else { Ok(Warned { value: at, notes: [notes, checked.notes].concat() }) })
}

/// Faults that may be none in longer numbers.
const HIDDEN: [&str; 2] = ["degenerate-guide", "coincident-points"];

/// Bits of the longer numbers beyond double-double.
const BITS: [usize; 3] = [192, 384, 768];

/// The whole assembly in numbers of another kind, rounded; `None` where these cannot tell it either.
fn placed_in<N: Real>(scene: &Scene, mechanism: &Mechanism, demand: &Demand) -> Option<Warned<Configuration>> {
    let mut placed = Assembly::<N>::new(scene, mechanism, demand, None).place(demand).ok()?.settled();
    let notes = std::mem::take(&mut placed.notes);
    let at = placed.into_configuration().approx();
    let points = at.points.iter().flatten().all(|p| p.is_finite());
    let told = points && at.poses.iter().flatten().all(|p| p.origin.is_finite() && p.axis.is_finite());
    told.then_some(Warned { value: at, notes })
}

/// Codes of faults of a group that cannot be closed on the groups before it.
const DOES_NOT_CLOSE: [&str; 3] = ["cannot-assemble", "coincident-points", "degenerate-guide"];

/// Other assemblies that are tried where the first does not close: each costs as much as the first.
const MOST_TRIED: usize = 32;
