//! A pair of external spur gears with involute flanks: its circles, its profile shifts and how many teeth are in contact.
//!
//! Lengths in the unit of the module, angles in radians. With base radii r_b = r cos α the line of action touches both base circles (N₁,
//! N₂) under the operating pressure angle α′, cos α′ = (r_b1 + r_b2)/a′; contact begins where the driven gear's tip circle crosses it (B₂)
//! and ends where the driver's does (B₁). Decided here: the geometry; what a file says, and what is drawn of it, are other rooms' matter.
//!
//! # Source
//! 孙桓、陈作模、葛文杰《机械原理》, chapter on gears; F. L. Litvin, *Gear Geometry and Applied Theory*.

use crate::geom::{Point, Vec2};
use std::f64::consts::{FRAC_PI_2, PI};

/// inv α = tan α − α: the polar angle of an involute where its pressure angle is α.
pub fn inv(alpha: f64) -> f64 {
    libm::tan(alpha) - alpha
}

/// The angle of an involute function in [0, π/2); Newton's method from the cube root, which is exact to 1 % up to 45°.
pub fn arc_inv(value: f64) -> Option<f64> {
    if !(value.is_finite() && value >= 0.0) {
        return None;
    }
    let mut alpha = libm::atan(libm::cbrt(3.0 * value));
    // d(inv)/dα = tan²α; it is convex: from above the steps never pass the root, from below only the first does.
    for _ in 0..60 {
        let slope = libm::tan(alpha) * libm::tan(alpha);
        if slope == 0.0 {
            break;
        }
        let next = alpha - (inv(alpha) - value) / slope;
        let next = next.clamp(0.0, FRAC_PI_2 - 1e-9);
        if next == alpha {
            break;
        }
        alpha = next;
    }
    Some(alpha)
}

/// What the two gears of a pair have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Basic {
    /// Module m.
    pub module: f64,
    /// Pressure angle α of the basic rack (rad).
    pub alpha: f64,
    /// Addendum over the module, h_a*.
    pub addendum: f64,
    /// Clearance over the module, c*.
    pub clearance: f64,
}

/// One gear of a pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gear {
    /// Number of teeth z.
    pub teeth: u32,
    /// Profile shift over the module, x.
    pub shift: f64,
    /// Radius of the reference circle, r = m z/2.
    pub reference: f64,
    /// Base circle, r_b.
    pub base: f64,
    /// Operating pitch circle, r′.
    pub pitch: f64,
    /// Tip circle, r_a.
    pub tip: f64,
    /// Root circle, r_f.
    pub root: f64,
}

/// A pair of gears at its centre distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// What both have.
    pub basic: Basic,
    /// The gears, the driver first.
    pub gears: [Gear; 2],
    /// Operating centre distance a′.
    pub distance: f64,
    /// Operating pressure angle α′ (rad).
    pub operating: f64,
}

/// The operating pressure angle at a centre distance; `None` where the base circles would overlap.
pub fn operating(basic: &Basic, teeth: [u32; 2], distance: f64) -> Option<f64> {
    let cos = standard(basic, teeth) * libm::cos(basic.alpha) / distance;
    (0.0..=1.0).contains(&cos).then(|| libm::acos(cos))
}

/// The standard centre distance a = m (z₁ + z₂)/2.
pub fn standard(basic: &Basic, teeth: [u32; 2]) -> f64 {
    basic.module * teeth.iter().map(|z| f64::from(*z)).sum::<f64>() / 2.0
}

/// The sum of profile shifts without backlash at an operating pressure angle: x₁ + x₂ = (z₁ + z₂)(inv α′ − inv α)/(2 tan α).
pub fn sum_of_shifts(basic: &Basic, teeth: [u32; 2], operating: f64) -> f64 {
    let z: f64 = teeth.iter().map(|z| f64::from(*z)).sum();
    z * (inv(operating) - inv(basic.alpha)) / (2.0 * libm::tan(basic.alpha))
}

/// The centre distance without backlash at a sum of profile shifts; `None` where no pressure angle belongs to it.
pub fn distance_of(basic: &Basic, teeth: [u32; 2], sum: f64) -> Option<f64> {
    let z: f64 = teeth.iter().map(|z| f64::from(*z)).sum();
    let operating = arc_inv(2.0 * sum * libm::tan(basic.alpha) / z + inv(basic.alpha))?;
    Some(standard(basic, teeth) * libm::cos(basic.alpha) / libm::cos(operating))
}

impl Pair {
    /// The pair with these shifts at its centre distance; the tips are shortened by Δy = x₁ + x₂ − y, so that the clearance stays.
    /// `None` where the base circles would overlap, or a gear has no tooth left.
    pub fn new(basic: Basic, teeth: [u32; 2], shifts: [f64; 2], distance: f64) -> Option<Pair> {
        let operating = operating(&basic, teeth, distance)?;
        let m = basic.module;
        let shortened = shifts[0] + shifts[1] - (distance - standard(&basic, teeth)) / m;
        let gear = |i: usize| {
            let reference = m * f64::from(teeth[i]) / 2.0;
            let base = reference * libm::cos(basic.alpha);
            Gear {
                teeth: teeth[i],
                shift: shifts[i],
                reference,
                base,
                pitch: base / libm::cos(operating),
                tip: reference + (basic.addendum + shifts[i] - shortened) * m,
                root: reference - (basic.addendum + basic.clearance - shifts[i]) * m,
            }
        };
        let gears = [gear(0), gear(1)];
        gears.iter().all(|g| g.root > 0.0 && g.tip > g.base && g.tip > g.root).then_some(Pair { basic, gears, distance, operating })
    }

    /// Base pitch p_b = π m cos α: the distance of flanks along the line of action.
    pub fn base_pitch(&self) -> f64 {
        PI * self.basic.module * libm::cos(self.basic.alpha)
    }

    /// Where contact begins and ends along the line of action, from the pitch point, positive in its direction; never beyond N₁, N₂.
    pub fn contact(&self) -> [f64; 2] {
        let reach = |g: &Gear| (g.tip * g.tip - g.base * g.base).max(0.0).sqrt() - g.pitch * libm::sin(self.operating);
        let [n1, n2] = self.tangents();
        [(-reach(&self.gears[1])).max(n1), reach(&self.gears[0]).min(n2)]
    }

    /// Where the line of action touches the base circles N₁, N₂, from the pitch point.
    pub fn tangents(&self) -> [f64; 2] {
        let [a, b] = self.gears.map(|g| g.pitch * libm::sin(self.operating));
        [-a, b]
    }

    /// Whether a tip reaches beyond the other's base circle on the line of action: there the flanks would cut into one another.
    pub fn interferes(&self) -> bool {
        let tip = |g: &Gear| libm::hypot(g.base, self.distance * libm::sin(self.operating)) < g.tip;
        self.gears.iter().any(tip)
    }

    /// The contact ratio ε = B₁B₂/p_b.
    pub fn contact_ratio(&self) -> f64 {
        let [from, to] = self.contact();
        (to - from) / self.base_pitch()
    }
}

impl Gear {
    /// Half the angle of a tooth at a radius on or outside the base circle: (π/2 + 2x tan α)/z + inv α − inv α_r.
    pub fn half_tooth(&self, basic: &Basic, radius: f64) -> f64 {
        let at = libm::acos((self.base / radius).min(1.0));
        (FRAC_PI_2 + 2.0 * self.shift * libm::tan(basic.alpha)) / f64::from(self.teeth) + inv(basic.alpha) - inv(at)
    }

    /// The radius at which the two flanks of a tooth meet, if that is inside the tip circle: the tooth is pointed.
    pub fn pointed(&self, basic: &Basic) -> bool {
        self.half_tooth(basic, self.tip) <= 0.0
    }

    /// The least profile shift without undercut by a rack, x_min = h_a* − z sin²α/2.
    pub fn least_shift(&self, basic: &Basic) -> f64 {
        let sin = libm::sin(basic.alpha);
        basic.addendum - f64::from(self.teeth) * sin * sin / 2.0
    }

    /// A tooth's outline in the gear's own frame, its middle in the direction `middle` (rad): from the root before it, counter-clockwise,
    /// to the root behind it; `steps` points a flank. Below the base circle the flank goes straight to the root.
    pub fn tooth(&self, basic: &Basic, middle: f64, steps: usize) -> Vec<Point> {
        let from = self.base.max(self.root);
        let radius = |k: usize| from + (self.tip - from) * k as f64 / steps as f64;
        let at = |r: f64, angle: f64| (Vec2::from_angle(angle) * r).to_point();
        let mut out = Vec::new();
        let low = self.half_tooth(basic, from);
        if self.root < from {
            out.push(at(self.root, middle - low));
        }
        out.extend((0..=steps).map(|k| at(radius(k), middle - self.half_tooth(basic, radius(k)).max(0.0))));
        out.extend((0..=steps).rev().map(|k| at(radius(k), middle + self.half_tooth(basic, radius(k)).max(0.0))));
        if self.root < from {
            out.push(at(self.root, middle + low));
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn degrees(d: f64) -> f64 {
        d * PI / 180.0
    }

    const BASIC: Basic = Basic { module: 2.0, alpha: 20.0 * PI / 180.0, addendum: 1.0, clearance: 0.25 };

    /// Pairs: teeth, shifts, centre distance.
    const PAIRS: &[([u32; 2], [f64; 2])] =
        &[([20, 40], [0.0, 0.0]), ([15, 32], [0.5, 1.3]), ([15, 32], [0.3, -0.3]), ([17, 17], [0.2, 0.1]), ([60, 90], [-0.2, 0.1])];

    fn pair(teeth: [u32; 2], shifts: [f64; 2]) -> Pair {
        let distance = distance_of(&BASIC, teeth, shifts[0] + shifts[1]).unwrap();
        Pair::new(BASIC, teeth, shifts, distance).unwrap()
    }

    #[test]
    fn the_exercise_of_the_lecture_notes() {
        // Gears of 15 and 32 teeth, module 2 mm, at 50 mm instead of 47 mm; exact values to 20 digits.
        let teeth = [15, 32];
        assert!((standard(&BASIC, teeth) - 47.0).abs() < 1e-13);
        assert!((standard(&BASIC, [20, 30]) - 50.0).abs() < 1e-13);
        let alpha = operating(&BASIC, teeth, 50.0).unwrap();
        assert!((alpha - degrees(27.955_608_553_357_03)).abs() < 1e-14, "{}", alpha * 180.0 / PI);
        let sum = sum_of_shifts(&BASIC, teeth, alpha);
        assert!((sum - 1.801_010_721_615_944).abs() < 1e-12, "{sum}");
        assert!((distance_of(&BASIC, teeth, sum).unwrap() - 50.0).abs() < 1e-10);
    }

    #[test]
    fn the_inverse_of_the_involute_function() {
        for d in [0.0, 0.01, 1.0, 14.5, 20.0, 45.0, 70.0, 85.0] {
            let alpha = arc_inv(inv(degrees(d))).unwrap();
            assert!((inv(alpha) - inv(degrees(d))).abs() <= 1e-14 * (1.0 + inv(degrees(d)) * 100.0), "{d}: {}", alpha * 180.0 / PI);
        }
        assert_eq!(arc_inv(-0.1), None);
        assert_eq!(arc_inv(f64::NAN), None);
    }

    #[test]
    fn flanks_are_involutes_of_the_base_circle() {
        // A taut thread unwound from the base circle: what is unwound is as long as the arc that it leaves, and square to the flank.
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
                    assert!(((q - unwound).norm() - thread).abs() < 1e-12 * r, "z = {}: r = {r}", g.teeth);
                    let h = 1e-6 * r;
                    let along = Vec2::from_angle(angle(r + h)) * (r + h) - Vec2::from_angle(angle(r - h)) * (r - h);
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
        // Points one base pitch apart move along the line of action; those inside both tip circles, between N1 and N2, are in contact.
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
                .map(|k| (-20..20).filter(|n| touches((f64::from(*n) + f64::from(k) / f64::from(steps)) * p.base_pitch())).count())
                .sum();
            let mean = count as f64 / f64::from(steps);
            assert!((mean - p.contact_ratio()).abs() < 3.0 / f64::from(steps), "{teeth:?}: {mean} and {}", p.contact_ratio());
        }
    }

    #[test]
    fn impossible_pairs_are_none() {
        assert_eq!(operating(&BASIC, [20, 40], 50.0), None);
        assert!(Pair::new(BASIC, [20, 40], [0.0, 0.0], 50.0).is_none());
        assert!(Pair::new(BASIC, [2, 40], [0.0, 0.0], 42.0).is_none());
    }
}
