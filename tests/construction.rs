//! The construction language: a plan written as acts is plain data without coordinates, and every
//! drawing is an evaluation of it.

use hodograph::construct::pencil::{Exact, Pencil};
use hodograph::construct::{Acts, Layout, by_hand, read};
use hodograph::construction::{Construction, Op};
use hodograph::diagram::DiagramKind;
use hodograph::geom::{Point, Vec2};
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

/// A construction that is written as JSON and read again is equal, and draws the same places bit
/// for bit. The JSON holds no numbers except counts.
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
        let again = Arc::new(other)
            .draw(&scene, &w.configuration, &w.plan, &Layout::of(&w.construction), &mut Exact)
            .unwrap();
        assert_eq!(again.diagrams, w.construction.diagrams, "{name}");
        compared += again.diagrams.iter().map(|p| p.edges.len()).sum::<usize>();
    }
    assert!(compared > 500, "{compared}");
}

/// Other velocities change no act: only the plan and the alternatives of its groups do.
#[test]
fn other_numbers_are_drawn_by_the_same_acts() {
    let mut same = 0;
    for (name, scene, w) in all() {
        let mut other = scene.clone();
        for driver in &mut other.drivers {
            driver.rate.value *= 1.7;
        }
        let planned = plan::plan(&other, &w.mechanism, &w.demand);
        let acts = Acts::of(&other, &w.mechanism, &planned, &w.construction.acts.chosen);
        if planned == w.plan {
            assert_eq!(acts.construction, w.construction.acts.construction, "{name}");
            same += 1;
        }
    }
    assert!(same > 30, "{same}");
}

/// Every act is used: the construction of some template contains it, in motion or at rest.
#[test]
fn each_act_is_written_for_a_template() {
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

/// The exact pencil, except for one of its points, which is drawn beside its place.
struct Stray {
    mark: usize,
    made: usize,
}

impl Pencil for Stray {
    const EXACT: bool = false;

    fn mark(&mut self, _: DiagramKind, at: Point) -> Point {
        self.made += 1;
        if self.made - 1 == self.mark { at + Vec2::new(0.3, 0.2) } else { at }
    }

    fn ruler(&mut self, _: DiagramKind, u: Vec2, _: f64) -> Vec2 {
        u
    }
}

/// Every measured answer depends on drawn points: moving one of them changes the answer, and its
/// length is the distance of its two points.
#[test]
fn what_is_measured_moves_with_its_marks() {
    let mut moved_answers = 0;
    for (name, scene, w) in all() {
        let acts = &w.construction.acts;
        let layout = Layout::of(&w.construction);
        let drawn = |mark| {
            let mut pencil = Stray { mark, made: 0 };
            let (paper, shown) =
                by_hand(acts, &scene, &w.configuration, &w.plan, &layout, &mut pencil).ok()?;
            Some((read(&scene, &w.mechanism, &shown, &w.plan, &paper), pencil.made))
        };
        let (exact, marks) = drawn(usize::MAX).unwrap();
        let mut moved = vec![false; exact.len()];
        for (answers, _) in (0..marks).filter_map(drawn) {
            for ((moved, one), other) in moved.iter_mut().zip(&exact).zip(&answers) {
                *moved |= one.as_ref().map(|a| &a.value) != other.as_ref().map(|a| &a.value);
            }
        }
        for (answer, moved) in exact.iter().zip(moved) {
            let Some((answer, measured)) =
                answer.as_ref().and_then(|a| Some((a, a.measured.as_ref()?)))
            else {
                continue;
            };
            // An image that coincides with the pole because nothing is added to it is no point of
            // its own.
            assert!(
                moved || measured.length_mm == 0.0,
                "{name}: {} is measured, and no mark moves it",
                scene.find[answer.find].text
            );
            let [from, to] = measured.marks.map(|(_, at)| at);
            assert!(
                measured.arm_m.is_some() || (from.distance(to) - measured.length_mm).abs() < 1e-12,
                "{name}: {measured:?}"
            );
            moved_answers += 1;
        }
    }
    assert!(moved_answers > 200, "{moved_answers}");
}
