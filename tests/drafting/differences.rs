//! Tolerances of hand drawing by differences of redrawn constructions, and the radius by bisection:
//! an oracle that shares neither derivatives nor Newton's method with `accuracy::drafting`.

use hodograph::accuracy::{DraftedConstruction, drafting, relative_tolerances};
use hodograph::answer::AnswerValue;
use hodograph::construct::Layout;
use hodograph::construct::pencil::{Pencil, WITHIN, radius_in_deviations};
use hodograph::geom::{Point, Vec2};
use hodograph::scene::{DiagramKind, Kind, Scene, templates};

/// A pencil that counts the marks, and displaces one of them.
#[derive(Default)]
struct Displaced {
    marks: Vec<DiagramKind>,
    by: Option<(usize, Vec2)>,
}

impl Pencil for Displaced {
    const EXACT: bool = false;

    fn mark(&mut self, on: DiagramKind, at: Point) -> Point {
        self.marks.push(on);
        match self.by {
            Some((mark, by)) if mark + 1 == self.marks.len() => at + by,
            _ => at,
        }
    }
}

/// The difference of two answers; angles by the shorter way round.
fn difference(scene: &Scene, find: usize, a: AnswerValue, b: AnswerValue) -> Vec2 {
    match (a, b) {
        (AnswerValue::Vector(a), AnswerValue::Vector(b)) => a - b,
        (AnswerValue::Point(a), AnswerValue::Point(b)) => a - b,
        (AnswerValue::Scalar(a), AnswerValue::Scalar(b))
            if scene.find[find].what.kind() == Kind::Angle =>
        {
            Vec2::new(Vec2::from_angle(a - b).angle(), 0.0)
        }
        (AnswerValue::Scalar(a), AnswerValue::Scalar(b)) => Vec2::new(a - b, 0.0),
        _ => panic!("two forms of one answer"),
    }
}

/// The effects of all marks on an answer, each displaced by its deviation in x and in y.
type Effects = Vec<(DiagramKind, Vec2)>;

/// The effects for each question, `None` for questions that are not drawn.
fn effects(scene: &Scene, drawn: &DraftedConstruction, pencil_mm: f64) -> Vec<Option<Effects>> {
    let layout = Layout::of(drawn.construction);
    let mut first = Displaced::default();
    let read = drawn.read_with(&layout, &mut first).unwrap();
    let mut all: Vec<Option<Effects>> = read.iter().map(|v| v.map(|_| Vec::new())).collect();
    for (mark, on) in first.marks.into_iter().enumerate() {
        let [width, height] = drawn.size_mm(on);
        // Linear for all crossings of the templates, with ten digits left by rounding.
        let h = width.max(height) / 1_048_576.0;
        if h == 0.0 {
            continue;
        }
        for axis in [Vec2::new(h, 0.0), Vec2::new(0.0, h)] {
            let at = |by: Vec2| {
                let mut pencil = Displaced { by: Some((mark, by)), ..Displaced::default() };
                drawn.read_with(&layout, &mut pencil).unwrap()
            };
            let (ahead, behind) = (at(axis), at(-axis));
            for (find, effects) in all.iter_mut().enumerate() {
                let Some(effects) = effects else { continue };
                let change = difference(scene, find, ahead[find].unwrap(), behind[find].unwrap());
                effects.push((on, change * (0.5 * pencil_mm / radius_in_deviations() / h)));
            }
        }
    }
    all
}

/// The radius that contains the share [`WITHIN`] of the sums of some effects.
fn radius(effects: impl Iterator<Item = Vec2> + Clone) -> f64 {
    let sum = |of: fn(Vec2) -> f64| effects.clone().map(of).sum::<f64>();
    let (xx, xy, yy) = (sum(|v| v.x * v.x), sum(|v| v.x * v.y), sum(|v| v.y * v.y));
    let half = (0.5 * (xx - yy)).hypot(xy);
    let [large, small] = [half, -half].map(|half| (0.5 * (xx + yy) + half).max(0.0));
    let outside = |r: f64| {
        let steps = (0..200).map(|k| (f64::from(k) + 0.5) * std::f64::consts::FRAC_PI_2 / 200.0);
        let variance = |turn: f64| large * turn.cos().powi(2) + small * turn.sin().powi(2);
        steps.map(|turn| (-0.5 * r * r / variance(turn)).exp()).sum::<f64>() / 200.0
    };
    let (mut lo, mut hi) = (0.0, 3.0 * large.sqrt());
    for _ in 0..60 {
        let mid = 0.5 * (lo + hi);
        if outside(mid) > 1.0 - WITHIN { lo = mid } else { hi = mid }
    }
    hi
}

/// Every tolerance, and its part from each drawing.
#[test]
fn tolerances_are_those_of_differences() {
    let (mut compared, mut parts) = (0, 0);
    for t in templates::list() {
        let (scene, w) = super::template(t.name);
        let drawn = w.drawn(&scene);
        let effects = effects(&scene, &drawn, 0.1);
        let derived = drafting(&drawn, 0.1).tolerances;
        let relative = relative_tolerances(&drawn, 0.1);
        for (find, (effects, derived)) in effects.iter().zip(&derived).enumerate() {
            assert_eq!(derived.as_ref().and_then(|d| d.relative), relative[find]);
            let (Some(effects), Some(derived)) = (effects, derived) else { continue };
            let all = radius(effects.iter().map(|(_, v)| *v));
            let near = |a: f64, b: f64| (a - b).abs() <= 1e-7 * all;
            let what = format!("{} {}", t.name, scene.find[find].text);
            assert!(near(derived.absolute, all), "{what}: {} {all}", derived.absolute);
            compared += 1;
            for on in DiagramKind::ALL {
                let part = radius(effects.iter().filter(|(own, _)| *own == on).map(|(_, v)| *v));
                let own = derived.parts.get(on.kind()).unwrap_or(0.0);
                assert!(near(own, part), "{what}, {on:?}: {own} {part}");
                parts += usize::from(part > 0.0);
            }
        }
    }
    assert!(compared > 200 && parts > 400, "{compared} with {parts} parts");
}
