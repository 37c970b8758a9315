//! Random mechanisms with cams, gears and wheels given by lengths ([`crate::grown`]): the drawing,
//! the loop equations and differences of positions agree.

use crate::grown;
use crate::properties::seeds;
use crate::wide::every;
use hodograph::answer::MotionSource;
use hodograph::mechanism::Level;
use hodograph::scene::{Scene, driver_position, with_driver_at};
use hodograph::worked::{Scope, Worked, work};

fn each(own: u64, mut check: impl FnMut(u64, &str, &Scene, &Worked)) {
    let (mut solved, mut refused) = (0, Vec::new());
    for seed in seeds(own) {
        let Some((text, scene)) = grown::scene(seed) else { continue };
        match work(&scene, Scope::Questions) {
            Ok(w) => {
                solved += 1;
                check(seed, &text, &scene, &w.value);
            }
            Err(f) => refused.push(format!("seed {seed}: {f}\n{text}")),
        }
    }
    let closes = |f: &&String| {
        ![
            "in none of the",
            "cannot meet",
            "cannot-assemble",
            "dead-centre",
            "singular",
            "no-contact",
        ]
        .iter()
        .any(|code| f.contains(code))
    };
    assert!(!refused.iter().any(|f| closes(&f)), "{}", refused.iter().find(closes).unwrap());
    let tried = seeds(own).end;
    assert!(solved * 3 > tried * 2, "{solved} of {tried} solved; first {:?}", refused.first());
}

fn largest(w: &Worked, level: Level, scene: &Scene) -> f64 {
    let of = w.results.iter().filter(|r| scene.find[r.find].what.level() == level);
    // A follower may rest while its cam turns.
    let rate = scene.drivers[0].rate.value;
    let of_driver = if level == Level::Velocity { rate } else { rate * rate };
    of.map(|r| r.computed.magnitude()).fold(0.02 * of_driver, f64::max)
}

#[test]
fn grown_cams_and_gears_are_drawn_as_they_are_computed() {
    each(240, |seed, text, scene, w| {
        for r in &w.results {
            let asked = &scene.find[r.find].text;
            let Some(drawn) = &r.drawn else { panic!("seed {seed}: {asked} is not drawn\n{text}") };
            let off = drawn.value.apart(&r.computed).unwrap()
                / largest(w, scene.find[r.find].what.level(), scene);
            assert!(
                off < 1e-11 * w.solution.condition.max(1.0),
                "seed {seed}: {asked} is off by {off:e}\n{text}"
            );
        }
    });
}

/// With the driver slightly before and after, every point's velocity and acceleration agree with
/// differences of its places.
#[test]
fn grown_cams_and_gears_move_as_differences_say() {
    const STEP: f64 = 2e-5;
    let mut compared = 0;
    each(120, |seed, text, scene, w| {
        if w.solution.condition > 1e3 {
            return;
        }
        let Some(start) = driver_position(scene, 0) else { return };
        // A rack is placed by coordinates, which hold for the instant alone.
        let placed = |p: &hodograph::scene::NamedPoint| {
            matches!(p.place, hodograph::scene::PointPlace::At(_))
        };
        let pivots = &scene.links[scene.ground.0].points;
        if scene
            .points
            .iter()
            .enumerate()
            .any(|(i, p)| placed(p) && !pivots.iter().any(|q| q.0 == i))
        {
            return;
        }
        let driver = &scene.drivers[0];
        let (rate, acceleration) =
            (driver.rate.value, driver.acceleration.as_ref().map_or(0.0, |a| a.value));
        let at = |k: f64| {
            work(&with_driver_at(scene, 0, start + k * STEP), Scope::Questions)
                .ok()
                .map(|w| w.value.configuration)
        };
        let all: Option<Vec<_>> = [-2.0, -1.0, 1.0, 2.0].map(at).into_iter().collect();
        let Some(all) = all else { return };
        for (p, point) in scene.points.iter().enumerate() {
            let of = |level| w.solution.vector(level, hodograph::scene::PointId(p), None);
            let (Some(v0), Some(a0), Some(now)) =
                (of(Level::Velocity), of(Level::Acceleration), w.configuration.points[p])
            else {
                continue;
            };
            if scene.carriers(hodograph::scene::PointId(p)).next().is_none() {
                continue;
            }
            let place = |k: usize| all[k].points[p].map(|q| q - now);
            let (Some(a), Some(b), Some(c), Some(d)) = (place(0), place(1), place(2), place(3))
            else {
                continue;
            };
            let slope = ((c - b) * 8.0 - (d - a)) * (1.0 / (12.0 * STEP));
            let bend = ((b + c) * 16.0 - (a + d)) * (1.0 / (12.0 * STEP * STEP));
            // Across a joint of the profile the acceleration jumps: the printed one belongs to one
            // side.
            let jumps = ((b + c) - (a + d) * 0.25).norm() / (STEP * STEP)
                > 1e-3 * (bend.norm() + slope.norm());
            let (v, acc) = (slope * rate, bend * (rate * rate) + slope * acceleration);
            let (sv, sa) =
                (largest(w, Level::Velocity, scene), largest(w, Level::Acceleration, scene));
            assert!(
                (v - v0).norm() < 1e-6 * sv,
                "seed {seed}: v of {} is {v0:?}, differences say {v:?}\n{text}",
                point.name
            );
            assert!(
                jumps || (acc - a0).norm() < 2e-3 * sa.max(sv),
                "seed {seed}: a of {} is {a0:?}, differences say {acc:?}\n{text}",
                point.name
            );
            compared += 1;
        }
    });
    assert!(compared > 200 / every(8), "{compared}");
}
