//! The work depends on the questions: templates with one question or a few, and the work of each
//! stage.
//!
//! The expected numbers are counted by hand from the mechanics: a driven link and a dyad have one
//! equation each, an intersection draws two vectors, a moving link has three unknowns.

use hodograph::certified::certify;
use hodograph::effort::{MotionWork, Work};
use hodograph::plan::{Effect, Reason};
use hodograph::scene::{self, Scene, templates};
use hodograph::worked::{Scope, Worked, work};
use serde_json::{Value, json};

/// No work at a level.
const NONE: [usize; 6] = [0; 6];

/// A template, its changes, the questions, and the expected work: groups placed; groups, equations,
/// images, vectors, rates and unknowns at velocity and at acceleration level; numbers certified.
type Row = (
    &'static str,
    &'static [(&'static str, &'static str)],
    &'static [&'static str],
    usize,
    [usize; 6],
    [usize; 6],
    usize,
);

const STOPPED: (&str, &str) = ("/parameters/omega_1", "0 rad/s");
const STARTING: (&str, &str) = ("/driver/alpha", "3 rad/s^2");

#[rustfmt::skip]
const TABLE: &[Row] = &[
    // Eight links: crank 1; dyads 2-3 (C), 4-5 (D), 6-7 (F) in this order, the last on both others.
    ("jansen-leg", &[], &["x_A"], 1, NONE, NONE, 1),
    ("jansen-leg", &[], &["x_C", "y_C"], 2, NONE, NONE, 2),
    ("jansen-leg", &[], &["x_G"], 4, NONE, NONE, 1),
    ("jansen-leg", &[], &["v_A"], 1, [1, 1, 0, 1, 1, 3], NONE, 2),
    ("jansen-leg", &[], &["v_C"], 2, [2, 2, 0, 3, 1, 9], NONE, 2),
    ("jansen-leg", &[], &["v_D"], 2, [2, 2, 0, 3, 1, 9], NONE, 2),
    ("jansen-leg", &[], &["v_E"], 2, [2, 2, 1, 3, 1, 9], NONE, 2),
    ("jansen-leg", &[], &["omega_3"], 2, [2, 2, 0, 3, 2, 9], NONE, 1),
    // Velocities of the upstream links only for their normal accelerations: rates of crank and
    // dyad.
    ("jansen-leg", &[], &["a_C"], 2, [2, 2, 0, 3, 3, 9], [2, 2, 0, 5, 0, 9], 2),
    ("jansen-leg", &[], &["alpha_3"], 2, [2, 2, 0, 3, 3, 9], [2, 2, 0, 5, 1, 9], 1),
    ("jansen-leg", &[], &["v_C", "v_D"], 3, [3, 3, 0, 5, 1, 15], NONE, 4),
    ("jansen-leg", &[], &["v_G"], 4, [4, 4, 2, 7, 1, 21], NONE, 2),
    // G's own velocity is not asked for: only E's image is needed, for the dyad attached to it.
    ("jansen-leg", &[], &["a_G"], 4, [4, 4, 1, 7, 7, 21], [4, 4, 2, 13, 0, 21], 2),
    // Accelerations of the requested points only, not of all moving links.
    ("jansen-leg", &[], &["v_G", "a_D"], 4, [4, 4, 2, 7, 3, 21], [2, 2, 0, 5, 0, 9], 4),
    // A driver at rest: equations are written, no vector of the velocities is drawn.
    ("jansen-leg", &[STOPPED], &["v_D"], 2, [2, 2, 0, 0, 1, 9], NONE, 1),
    ("jansen-leg", &[STOPPED, STARTING], &["a_D"], 2, [2, 2, 0, 0, 3, 9], [2, 2, 0, 3, 1, 9], 2),
    ("slider-crank", &[], &["x_C"], 2, NONE, NONE, 1),
    ("slider-crank", &[], &["v_C"], 2, [2, 2, 0, 3, 1, 9], NONE, 2),
    // The guide is fixed: no Coriolis vector, so normal part, tangential part and sliding only.
    ("slider-crank", &[], &["a_C"], 2, [2, 2, 0, 3, 2, 9], [2, 2, 0, 4, 0, 9], 2),
    ("slider-crank", &[], &["a_B"], 1, [1, 1, 0, 1, 1, 3], [1, 1, 0, 1, 0, 3], 2),
    ("slider-crank", &[STARTING], &["a_B"], 1, [1, 1, 0, 1, 1, 3], [1, 1, 0, 2, 1, 3], 2),
    ("slider-crank", &[STOPPED], &["v_C"], 2, [2, 2, 0, 0, 1, 9], NONE, 1),
    ("slotted-lever", &[], &["omega_3"], 2, [2, 2, 0, 3, 2, 9], NONE, 1),
    ("slotted-lever", &[], &["alpha_3"], 2, [2, 2, 0, 3, 2, 9], [2, 2, 0, 5, 1, 9], 1),
    ("slotted-lever", &[], &["ak_B2B3"], 2, [2, 2, 0, 3, 2, 9], [2, 2, 0, 5, 0, 9], 2),
    ("shaper", &[], &["phi_3"], 2, NONE, NONE, 1),
    ("shaper", &[], &["omega_3"], 2, [2, 2, 0, 3, 2, 9], NONE, 1),
    ("shaper", &[], &["v_C"], 3, [3, 3, 1, 5, 1, 15], NONE, 2),
    ("shaper", &[], &["a_C"], 3, [3, 3, 1, 5, 3, 15], [3, 3, 1, 8, 0, 15], 2),
    ("whitworth", &[], &["omega_3"], 2, [2, 2, 0, 3, 2, 9], NONE, 1),
    ("whitworth", &[], &["v_E"], 3, [3, 3, 1, 5, 1, 15], NONE, 2),
    // A fixed point, for which nothing is solved.
    ("whitworth", &[], &["v_A"], 0, NONE, NONE, 1),
    // Three legs: the special point, one more point, and the two others by image.
    ("class-iii-six-bar", &[], &["v_A"], 1, [1, 1, 0, 1, 1, 3], NONE, 2),
    ("class-iii-six-bar", &[], &["v_P"], 2, [2, 3, 2, 5, 1, 15], NONE, 2),
    ("class-iii-six-bar", &[], &["a_Q"], 2, [2, 3, 2, 5, 5, 15], [2, 3, 2, 11, 0, 15], 2),
    // One of two drivers at rest: its point is fixed, all others move.
    ("five-bar", &[("/parameters/omega_4", "0 rad/s")], &["v_C"], 3, [3, 3, 0, 3, 2, 12], NONE, 2),
    ("five-bar", &[("/parameters/omega_4", "0 rad/s")], &["a_C"], 3, [3, 3, 0, 3, 4, 12], [3, 3, 0, 5, 0, 12], 2),
    ("watt-six-bar", &[], &["v_C"], 2, [2, 2, 0, 3, 1, 9], NONE, 2),
    ("watt-six-bar", &[], &["v_F"], 3, [3, 3, 1, 5, 1, 15], NONE, 2),
];

/// A template with other questions.
fn asking(template: &str, changes: &[(&str, &str)], find: &[&str]) -> Scene {
    let mut json: Value = serde_json::from_str(templates::get(template).unwrap()).unwrap();
    for (pointer, value) in changes {
        let (object, key) = pointer.rsplit_once('/').unwrap();
        json.pointer_mut(object).unwrap()[key] = json!(value);
    }
    json["find"] = json!(find);
    scene::read(json.to_string())
        .unwrap_or_else(|f| panic!("{template} {changes:?} {find:?}: {f}"))
        .value
}

fn solved(scene: &Scene) -> Worked {
    work(scene, Scope::Questions).unwrap_or_else(|f| panic!("{f}")).value
}

fn motion([groups, equations, images, vectors, rates, unknowns]: [usize; 6]) -> MotionWork {
    MotionWork {
        groups,
        equations_planned: equations,
        equations_closed: equations,
        images,
        vectors,
        rates,
        unknowns,
    }
}

#[test]
fn the_work_is_what_is_asked() {
    let mut failures = Vec::new();
    for (template, changes, find, groups_placed, velocity, acceleration, certified_values) in TABLE
    {
        let scene = asking(template, changes, find);
        let worked = solved(&scene);
        let done = Work::of(&worked).with_certified(&certify(&scene, &worked, 6));
        let expected = Work {
            groups_placed: *groups_placed,
            velocity: motion(*velocity),
            acceleration: motion(*acceleration),
            // A trial for the scales, and the drawing: no stage repeats an earlier one.
            drawings: 2,
            answers: find.len(),
            certified_values: *certified_values,
            labels_placed: 0,
        };
        if done != expected {
            failures.push(format!("{template} {changes:?}, asked for {find:?}\n  expected {expected:?}\n  done     {done:?}"));
        }
        let levels = usize::from(*groups_placed > 0)
            + usize::from(*velocity != NONE)
            + usize::from(*acceleration != NONE);
        assert_eq!(done.levels(), levels, "{template} {find:?}");
        let disagree: Vec<_> =
            worked.results.iter().filter(|o| o.agreement.is_some_and(|a| !a.holds())).collect();
        assert!(disagree.is_empty(), "{template} {find:?}: {disagree:?}");
    }
    assert!(
        failures.is_empty(),
        "{} of {} rows:\n{}",
        failures.len(),
        TABLE.len(),
        failures.join("\n")
    );
}

/// For each row the effects that are left out, or included for a reason of their own.
#[test]
fn the_plan_says_why_an_effect_is_out() {
    let guide = |scene: &Scene, at: &str| {
        let index = scene
            .guides
            .iter()
            .position(|g| g.pin.is_some_and(|p| scene.point_name(p) == at))
            .unwrap();
        Effect::Coriolis(scene::GuideId(index))
    };
    let check = |template: &str,
                 changes: &[(&str, &str)],
                 find: &[&str],
                 at: Option<&str>,
                 included: bool,
                 why: Reason| {
        let scene = asking(template, changes, find);
        let plan = solved(&scene).plan;
        let effect = at.map_or(Effect::DriverRate(0), |at| guide(&scene, at));
        let found = plan.effects.iter().find(|e| e.0 == effect);
        assert_eq!(
            found,
            Some(&(effect, included, why)),
            "{template} {changes:?} {find:?}: {:?}",
            plan.effects
        );
    };
    check("shaper", &[], &["a_C"], Some("C"), false, Reason::GuideDoesNotTurn);
    check("shaper", &[], &["a_C"], Some("A"), true, Reason::GuideTurns);
    check("shaper", &[STOPPED, STARTING], &["a_C"], Some("A"), false, Reason::AtRest);
    check("shaper", &[STOPPED], &["v_C"], None, false, Reason::AtRest);
    // Velocities only: the rotation of a guide has no influence, and nothing is said of it.
    let scene = asking("shaper", &[], &["v_C"]);
    let plan = solved(&scene).plan;
    assert!(
        !plan
            .effects
            .iter()
            .any(|e| matches!(e.0, Effect::Coriolis(_) | Effect::DriverAcceleration(_))),
        "{:?}",
        plan.effects
    );
    assert!(plan.effects.contains(&(Effect::Accelerations, false, Reason::NotAsked)));
}

/// Labels are placed only when a figure is laid out, by its drawing code, and fewer for fewer
/// questions.
#[test]
fn labels_are_placed_for_a_figure_only() {
    use hodograph::figure::sheet::{SheetOptions, sheet};
    let labels = |find: &[&str]| {
        let scene = asking("shaper", &[], find);
        let worked = work(&scene, Scope::Figure).unwrap().value;
        assert_eq!(Work::of(&worked).labels_placed, 0);
        let figure = sheet(&scene, &worked, &SheetOptions::of_language(scene::Lang::En)).unwrap();
        Work::of(&worked).with_labels(figure.labels_placed()).labels_placed
    };
    let [positions, velocities, both] = [&["x_C"][..], &["v_C"], &["v_C", "a_C"]].map(labels);
    assert!(
        0 < positions && positions < velocities && velocities < both,
        "{positions} {velocities} {both}"
    );
}
