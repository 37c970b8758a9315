//! Remarks on loads and friction, and the reason for which forces have no value.

use hodograph_analytic::Solution;
use hodograph_base::diag::{Both, Diagnostic, Severity, both};
use hodograph_base::digits::significant;
use hodograph_mechanism::answer::MotionSource;
use hodograph_mechanism::force::{Cause, Load, faults_of_strokes, is_determined, loads, rubbing};
use hodograph_mechanism::mechanism::{Demand, Mechanism};
use hodograph_mechanism::motion;
use hodograph_mechanism::position::{Configuration, Path};
use hodograph_scene::quantity::{ROUNDING, Wrench};
use hodograph_scene::{Applied, Asked, Find, Guide, Kind, Loads, Rub, Scene};

/// The reason for which forces have no value: the links of the group whose reactions no finite
/// force balances.
pub(super) fn unbalanced(
    scene: &Scene,
    m: &Mechanism,
    at: &Configuration,
    demand: &Demand,
    find: &Find,
) -> Option<Both> {
    if !matches!(find.what, Asked::Force(_)) {
        return None;
    }
    if let Some(fault) = faults_of_strokes(scene).into_iter().next() {
        return Some(fault.message);
    }
    let solved = motion::solve::<f64>(scene, m, at, demand);
    let Some(group) = solved.unbalanced else {
        if !is_determined(scene, m) && !scene.loads.friction.is_empty() {
            return Some(both!(
                "friction rests on the reactions, which are not determined: a link or pair only repeats what the others hold, or a belt pulls with a tension that is not told"
            ));
        }
        let smooth =
            Scene { loads: Loads { friction: Vec::new(), ..scene.loads.clone() }, ..scene.clone() };
        let told = !scene.loads.friction.is_empty() && rubbing(scene, at, &solved).is_some();
        let locked = told && motion::solve::<f64>(&smooth, m, at, demand).forces().is_some();
        return (locked && solved.forces().is_none()).then(|| {
            both!(
                "the mechanism locks itself: with this friction no finite forces balance the loads"
            )
        });
    };
    let group = &m.groups[group];
    let names: Vec<&str> = group.links.iter().map(|l| scene.link_name(*l)).collect();
    let names = Both::names(&names);
    Some(both!(
        "the reactions of links {0} are unbounded or not determined: they lie in a dead centre, where no finite force of their joints balances the loads",
        names
    ))
}

/// Remarks on loads: a resistance whose point is at rest has no direction; a load over a part of
/// the motion does not act elsewhere.
pub(super) fn of_loads(scene: &Scene, at: &Configuration, solution: &Solution) -> Vec<Diagnostic> {
    let resting = |load: &Load| match load.cause {
        Cause::Applied(k) if load.wrench == Wrench::zero() => Some(&scene.loads.applied[k])
            .filter(|a| a.size.is_against_motion() || a.course.is_some()),
        _ => None,
    };
    let note = |a: &Applied| {
        let link = scene.link_name(a.link);
        if a.course.is_some() {
            let message = both!(
                "the load on link {link} is zero here: the pose lies outside the part of the motion over which it acts, or at its end"
            );
            return Diagnostic::note("load-elsewhere", message).at(a.span);
        }
        let message = both!(
            "the resistance on link {link} is left out: what it acts on is at rest, so that it has no direction"
        );
        Diagnostic::note("load-at-rest", message).at(a.span)
    };
    let mut notes: Vec<Diagnostic> = loads(scene, at, solution)
        .unwrap_or_default()
        .iter()
        .filter_map(resting)
        .map(note)
        .collect();
    notes.extend(of_friction(scene, at, solution));
    notes.extend(of_guides(scene, at, solution));
    notes.extend(
        faults_of_strokes(scene)
            .into_iter()
            .map(|d| Diagnostic { severity: Severity::Warning, ..d }),
    );
    notes
}

/// Remarks on friction: a pair in which nothing moves, and a mechanism that locks itself.
fn of_friction(scene: &Scene, at: &Configuration, solution: &Solution) -> Vec<Diagnostic> {
    let Some((rubbing, mut still)) =
        rubbing(scene, at, solution).filter(|_| !scene.loads.friction.is_empty())
    else {
        return Vec::new();
    };
    still.dedup();
    let rest = |k: usize| {
        let message = both!(
            "no friction counts in {}: its links do not move on each other, so that it has no sense",
            pair_words(scene, k)
        );
        Diagnostic::note("friction-at-rest", message).at(scene.loads.friction[k].span)
    };
    let mut notes: Vec<Diagnostic> = still.into_iter().map(rest).collect();
    let forces = solution.forces();
    let eta = forces.and_then(|f| f.efficiency());
    let worst = rubbing.iter().max_by(|a, b| {
        forces.map_or(0.0, |f| a.power(f)).total_cmp(&forces.map_or(0.0, |f| b.power(f)))
    });
    if let (Some(eta), Some(worst)) = (eta.filter(|eta| *eta <= 0.0), worst) {
        let message = both!(
            "the mechanism locks itself: η = {}; most is lost in {}",
            significant(eta, 4),
            pair_words(scene, worst.friction)
        );
        notes.push(
            Diagnostic::note("self-locking", message).at(scene.loads.friction[worst.friction].span),
        );
    }
    notes
}

/// Remarks on sliders that bear the force of their guide outside their length.
fn of_guides(scene: &Scene, at: &Configuration, solution: &Solution) -> Vec<Diagnostic> {
    let Some(forces) = solution.forces() else { return Vec::new() };
    let tilt = |(g, guide): (usize, &Guide)| {
        let (slider, length) = (guide.slider?, guide.length.as_ref()?);
        let (_, wrench) = forces.guides.iter().find(|(own, _)| own.0 == g)?;
        let Some(Path::Line { direction, .. }) = at.guides[g] else { return None };
        let normal = direction.perp().dot(wrench.force);
        // Moments about the other corner.
        let corners = [1.0, -1.0].map(|side| normal / 2.0 + side * wrench.couple / length.value);
        let tilts = corners[0] * corners[1] < 0.0
            && corners.iter().all(|force| force.abs() > ROUNDING * forces.largest);
        let newtons = |force: f64| {
            scene
                .book
                .text(Kind::Force, &significant(scene.book.value(Kind::Force, force.abs()), 4))
        };
        let message = both!(
            "slider {} tilts in its guide: the force of the guide acts outside the length {}; its corners press with {} and {}, in opposite senses",
            scene.link_name(slider),
            length.text,
            newtons(corners[0]),
            newtons(corners[1])
        );
        tilts.then(|| Diagnostic::note("guide-tilts", message).at(length.span))
    };
    scene.guides.iter().enumerate().filter_map(tilt).collect()
}

/// A pair that rubs: `pin B`, `the guide of link 3`.
fn pair_words(scene: &Scene, friction: usize) -> Both {
    match scene.loads.friction[friction].at {
        Rub::Pin { point, .. } => both!("pin {}", scene.point_name(point)),
        Rub::Guide { guide, .. } => {
            let own = &scene.guides[guide.0];
            match (own.slider, own.pin) {
                (Some(slider), _) => {
                    both!("the guide of link {}", scene.link_name(slider))
                }
                (None, Some(pin)) => both!("the slot of {}", scene.point_name(pin)),
                (None, None) => both!("a guide"),
            }
        }
    }
}
