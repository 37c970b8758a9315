//! The construction language: a plan written as acts is plain data without coordinates, and all that is drawn is an evaluation of it.

use hodograph::construct::{Acts, Layout, pencil::Exact};
use hodograph::construction::{Construction, Op};
use hodograph::plan;
use hodograph::scene::{Scene, templates};
use hodograph::worked::{Scope, Worked, work};
use std::collections::BTreeMap;
use std::sync::Arc;

fn all() -> impl Iterator<Item = (&'static str, Scene, Worked)> {
    templates::list().into_iter().filter_map(|t| {
        let scene = hodograph::scene::read(templates::get(t.name).unwrap()).ok()?.value;
        let worked = work(&scene, Scope::Figure).ok()?.value;
        Some((t.name, scene, worked))
    })
}

/// Written as JSON and read again, a construction is what it was, and draws the same places bit for bit. The JSON holds no number but counts.
#[test]
fn a_construction_is_plain_data() {
    let mut compared = 0;
    for (name, scene, w) in all() {
        let acts = &w.construction.acts;
        let text = serde_json::to_string(&acts.construction).unwrap();
        assert!(!text.contains('.'), "{name}: {text}");
        let read: Construction = serde_json::from_str(&text).unwrap();
        assert_eq!(read, acts.construction, "{name}");
        let mut other = Acts::clone(acts);
        other.construction = read;
        let again = Arc::new(other).draw(&scene, &w.configuration, &w.plan, &Layout::of(&w.construction), &mut Exact).unwrap();
        assert_eq!(again.diagrams, w.construction.diagrams, "{name}");
        compared += again.diagrams.iter().map(|p| p.edges.len()).sum::<usize>();
    }
    assert!(compared > 500, "{compared}");
}

/// Lengths, rates and the pose change no act: only the plan and the alternatives of its groups do.
#[test]
fn other_numbers_are_drawn_by_the_same_acts() {
    for (name, scene, w) in all() {
        let mut other = scene.clone();
        for driver in &mut other.drivers {
            driver.rate.value *= 1.7;
        }
        let planned = plan::plan(&other, &w.mechanism, &w.demand);
        let acts = Acts::of(&other, &w.mechanism, &planned, &w.construction.acts.chosen);
        if planned == w.plan {
            assert_eq!(acts.construction, w.construction.acts.construction, "{name}");
        }
    }
}

/// Every act is of use: some template draws it, in motion or at rest.
#[test]
fn each_act_is_drawn_by_a_template() {
    let mut seen: BTreeMap<&str, usize> = BTreeMap::new();
    for (_, mut scene, w) in all() {
        scene.drivers.iter_mut().for_each(|d| d.rate.value = 0.0);
        let at_rest = plan::plan(&scene, &w.mechanism, &w.demand);
        let at_rest = Acts::of(&scene, &w.mechanism, &at_rest, &w.construction.acts.chosen);
        for op in w.construction.acts.construction.ops.iter().chain(&at_rest.construction.ops) {
            let kind = match op {
                Op::Set(_) => "set",
                Op::Path(_) => "path",
                Op::Lay { .. } => "lay",
                Op::Rule(_) => "rule",
                Op::Meet { .. } => "meet",
                Op::Foot { .. } => "foot",
                Op::Image { .. } => "image",
                Op::Same { .. } => "same",
                Op::Number(_) => "number",
                Op::Show(_) => "show",
                Op::Omit { .. } => "omit",
            };
            *seen.entry(kind).or_default() += 1;
        }
    }
    assert_eq!(seen.len(), 11, "{seen:?}");
}
