//! Gear pairs against unwound threads, meeting polygons, and counted contacts.

use super::*;
use crate::gears::Mate::Gear as External;
use hodograph_base::geom::{Point, Vec2};

fn degrees(d: f64) -> f64 {
    d * PI / 180.0
}

const BASIC: Basic =
    Basic { module: 2.0, alpha: 20.0 * PI / 180.0, addendum: 1.0, clearance: 0.25 };

/// Pairs: teeth, shifts, centre distance.
const PAIRS: &[([u32; 2], [f64; 2])] = &[
    ([20, 40], [0.0, 0.0]),
    ([15, 32], [0.5, 1.3]),
    ([15, 32], [0.3, -0.3]),
    ([17, 17], [0.2, 0.1]),
    ([60, 90], [-0.2, 0.1]),
];

fn pair(teeth: [u32; 2], shifts: [f64; 2]) -> GearPair {
    let distance = distance_of(&BASIC, External, teeth, shifts[0] + shifts[1]).unwrap();
    GearPair::new(BASIC, External, teeth, shifts, distance).unwrap()
}

#[test]
fn the_exercise_of_the_lecture_notes() {
    // Gears of 15 and 32 teeth, module 2 mm, at 50 mm instead of 47 mm; exact values to 20 digits.
    let teeth = [15, 32];
    assert!((standard(&BASIC, External, teeth) - 47.0).abs() < 1e-13);
    assert!((standard(&BASIC, External, [20, 30]) - 50.0).abs() < 1e-13);
    let alpha = operating(&BASIC, External, teeth, 50.0).unwrap();
    assert!((alpha - degrees(27.955_608_553_357_03)).abs() < 1e-14, "{}", alpha * 180.0 / PI);
    let sum = sum_of_shifts(&BASIC, External, teeth, alpha);
    assert!((sum - 1.801_010_721_615_944).abs() < 1e-12, "{sum}");
    assert!((distance_of(&BASIC, External, teeth, sum).unwrap() - 50.0).abs() < 1e-10);
}

#[test]
fn the_inverse_of_the_involute_function() {
    for d in [0.0, 0.01, 1.0, 14.5, 20.0, 45.0, 70.0, 85.0] {
        let alpha = arc_inv(inv(degrees(d))).unwrap();
        assert!(
            (inv(alpha) - inv(degrees(d))).abs() <= 1e-14 * (1.0 + inv(degrees(d)) * 100.0),
            "{d}: {}",
            alpha * 180.0 / PI
        );
    }
    assert_eq!(arc_inv(-0.1), None);
    assert_eq!(arc_inv(f64::NAN), None);
}

#[test]
fn flanks_are_involutes_of_the_base_circle() {
    // A taut thread unwound from the base circle: the free length equals the arc that it leaves,
    // and is square to the flank.
    for (teeth, shifts) in PAIRS {
        for g in pair(*teeth, *shifts).gears {
            let angle = |r: f64| -g.half_tooth(&BASIC, r);
            let begin = angle(g.base);
            for k in 1..=10 {
                let r = g.base + (g.tip - g.base) * f64::from(k) / 10.0;
                let thread = (r * r - g.base * g.base).sqrt();
                let q = Vec2::from_angle(angle(r)) * r;
                let turned = thread / g.base;
                let unwound = Vec2::from_angle(begin + turned) * g.base;
                assert!(
                    ((q - unwound).norm() - thread).abs() < 1e-12 * r,
                    "z = {}: r = {r}",
                    g.teeth
                );
                let h = 1e-6 * r;
                let along = Vec2::from_angle(angle(r + h)) * (r + h)
                    - Vec2::from_angle(angle(r - h)) * (r - h);
                assert!((q - unwound).unit().unwrap().dot(along.unit().unwrap()).abs() < 1e-7);
            }
        }
    }
}

#[test]
fn teeth_fill_the_spaces_without_backlash() {
    for (teeth, shifts) in PAIRS {
        let p = pair(*teeth, *shifts);
        let [a, b] = p.gears.map(|g| 2.0 * g.half_tooth(&BASIC, g.pitch) * g.pitch);
        let pitch = 2.0 * PI * p.gears[0].pitch / f64::from(teeth[0]);
        assert!((a + b - pitch).abs() < 1e-12 * pitch, "{teeth:?}: {a} + {b} and {pitch}");
        let clearance = p.distance - p.gears[0].tip - p.gears[1].root;
        assert!((clearance - 0.25 * BASIC.module).abs() < 1e-12, "{clearance}");
    }
}

#[test]
fn the_contact_ratio_is_the_mean_number_of_contacts() {
    // Points one base pitch apart move along the line of action; those inside both tip circles,
    // between N1 and N2, are in contact.
    for (teeth, shifts) in PAIRS {
        let p = pair(*teeth, *shifts);
        let [a, b] = p.gears;
        let action = Vec2::from_angle(p.operating);
        let [n1, n2] = p.tangents();
        let (steps, centre) = (20_000, [Point::new(0.0, -a.pitch), Point::new(0.0, b.pitch)]);
        let touches = |t: f64| {
            let at = (action * t).to_point();
            t >= n1 && t <= n2 && at.distance(centre[0]) <= a.tip && at.distance(centre[1]) <= b.tip
        };
        let count: usize = (0..steps)
            .map(|k| {
                (-20..20)
                    .filter(|n| {
                        touches((f64::from(*n) + f64::from(k) / f64::from(steps)) * p.base_pitch())
                    })
                    .count()
            })
            .sum();
        let mean = count as f64 / f64::from(steps);
        assert!(
            (mean - p.contact_ratio()).abs() < 3.0 / f64::from(steps),
            "{teeth:?}: {mean} and {}",
            p.contact_ratio()
        );
    }
}

#[test]
fn impossible_pairs_are_none() {
    assert_eq!(operating(&BASIC, External, [20, 40], 50.0), None);
    assert!(GearPair::new(BASIC, External, [20, 40], [0.0, 0.0], 50.0).is_none());
    assert!(GearPair::new(BASIC, External, [2, 40], [0.0, 0.0], 42.0).is_none());
}

/// Gears in rings, teeth and shifts: neither do tips overlap nor do flanks cut into one another.
const RINGS: &[([u32; 2], [f64; 2])] = &[
    ([20, 80], [0.0, 0.0]),
    ([24, 60], [0.2, 0.35]),
    ([30, 48], [0.3, 0.3]),
    ([18, 54], [0.5, 0.2]),
    ([40, 60], [-0.1, 0.2]),
];

fn ring(teeth: [u32; 2], shifts: [f64; 2]) -> GearPair {
    let distance = distance_of(&BASIC, Mate::Ring, teeth, shifts[1] - shifts[0]).unwrap();
    GearPair::new(BASIC, Mate::Ring, teeth, shifts, distance).unwrap()
}

/// Returns the largest depth, as an angle of the ring, to which any point of the gear's teeth
/// enters the ring's teeth while the gear turns through a pitch.
fn overlap(p: &GearPair) -> f64 {
    let [g, r] = &p.gears;
    let (pitch, ring_pitch) = (2.0 * PI / f64::from(g.teeth), 2.0 * PI / f64::from(r.teeth));
    let mut worst = f64::NEG_INFINITY;
    for k in 0..48 {
        let turned = pitch * f64::from(k) / 48.0;
        let of_ring = turned * f64::from(g.teeth) / f64::from(r.teeth);
        for n in 0..g.teeth {
            let middle = g.half_tooth(&p.basic, g.pitch) - turned + f64::from(n) * pitch;
            for q in g.tooth(&p.basic, middle, 24) {
                let q = q.to_vec2() + Vec2::new(p.distance, 0.0);
                let radius = q.norm();
                if radius < r.tip || radius < g.root {
                    continue;
                }
                let space = r.half_tooth(&p.basic, r.pitch) - of_ring;
                let off = (q.angle() - space).rem_euclid(ring_pitch);
                let off = off.min(ring_pitch - off);
                worst = worst.max(off - r.half_tooth(&p.basic, radius.max(r.base)));
            }
        }
    }
    worst
}

#[test]
fn a_gear_turns_in_its_ring() {
    for (teeth, shifts) in RINGS {
        let p = ring(*teeth, *shifts);
        assert!(!p.interferes() && !p.tips_overlap(), "{teeth:?}");
        let worst = overlap(&p);
        // The teeth touch, to rounding, and do not overlap.
        assert!(worst < 1e-12 && worst > -1e-6, "{teeth:?}: {worst:e}");
        // No backlash on the pitch circles, and at least the clearance.
        let [a, b] = p.gears.map(|g| 2.0 * g.half_tooth(&BASIC, g.pitch) * g.pitch);
        assert!((a - b).abs() < 1e-12 * a, "{teeth:?}: {a} and {b}");
        assert!(p.gears[1].root - p.distance - p.gears[0].tip > 0.25 * BASIC.module - 1e-12);
        assert!(p.gears[1].tip - p.distance - p.gears[0].root > 0.25 * BASIC.module - 1e-12);
    }
}

#[test]
fn tips_in_a_ring_overlap_where_the_teeth_do() {
    let mut seen = [0, 0];
    for difference in 3..16 {
        for z in [30, 40, 60] {
            let p = ring([z, z + difference], [0.0, 0.0]);
            let overlaps = overlap(&p) > 1e-9;
            assert_eq!(overlaps, p.tips_overlap(), "{z} in {}: {:e}", z + difference, overlap(&p));
            seen[usize::from(overlaps)] += 1;
        }
    }
    assert!(seen[0] > 5 && seen[1] > 5, "{seen:?}");
}

#[test]
fn a_gear_rolls_on_its_rack() {
    for (z, x) in [(20, 0.0), (12, 0.35), (40, -0.2), (17, 0.1)] {
        let p =
            GearPair::new(BASIC, Mate::Rack, [z, 0], [x, 0.0], f64::from(z) * BASIC.module / 2.0)
                .unwrap();
        let g = &p.gears[0];
        assert_eq!(p.interferes(), x < g.least_shift(&BASIC), "z = {z}");
        // Points of the gear's teeth against the straight flanks, while the gear rolls through a
        // pitch.
        let (tan, m) = (libm::tan(BASIC.alpha), BASIC.module);
        let half = (PI / 4.0 - x * tan) * m;
        let mut worst = f64::NEG_INFINITY;
        for k in 0..48 {
            let turned = 2.0 * PI / f64::from(z) * f64::from(k) / 48.0;
            let first = FRAC_PI_2 + g.half_tooth(&BASIC, g.pitch) - turned;
            for n in -2..=2 {
                for q in g.tooth(&BASIC, first + f64::from(n) * 2.0 * PI / f64::from(z), 24) {
                    let (x, y) = (q.x - turned * g.pitch, q.y - g.pitch);
                    if y > -p.rack()[0] && q.to_vec2().norm() > g.base {
                        let off = (x - half).rem_euclid(PI * m);
                        worst = worst.max((half + y * tan) - off.min(PI * m - off));
                    }
                }
            }
        }
        assert!(worst < 1e-12 * g.tip && worst > -1e-3, "z = {z}: {worst:e}");
        // The flanks of the outline touch those of the gear.
        let outline = p.rack_teeth(1);
        let on = outline.windows(2).filter(|w| w[0].y * w[1].y < 0.0);
        let crossings: Vec<f64> =
            on.map(|w| w[0].x + (w[1].x - w[0].x) * w[0].y / (w[0].y - w[1].y)).collect();
        assert!(crossings.iter().any(|x| x.abs() < 1e-12 * m), "{crossings:?}");
        // B2 to B1 by counting, as for two gears.
        let action = Vec2::from_angle(p.operating);
        let touches = |t: f64| {
            let at = action * t;
            t >= p.tangents()[0]
                && at.y >= -p.rack()[0]
                && (at + Vec2::new(0.0, g.pitch)).norm() <= g.tip
        };
        let steps = 20_000;
        let step =
            |k: i32, n: i32| (f64::from(n) + f64::from(k) / f64::from(steps)) * p.base_pitch();
        let count: usize =
            (0..steps).map(|k| (-20..20).filter(|n| touches(step(k, *n))).count()).sum();
        assert!(
            (count as f64 / f64::from(steps) - p.contact_ratio()).abs() < 3.0 / f64::from(steps),
            "z = {z}"
        );
    }
}
