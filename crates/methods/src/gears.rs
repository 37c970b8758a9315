//! Spur gears with involute flanks: two gears in mesh, a gear in a ring, or a gear on a rack;
//! circles, profile shifts, contact ratio.
//!
//! Lengths are in the unit of the module, angles in radians. With base radii r_b = r cos α, the
//! line of action touches both base circles (N₁, N₂) under the operating pressure angle α′, cos α′
//! = a cos α/a′. Contact begins at the crossing with the driven gear's tip circle (B₂) and ends at
//! the crossing with the driver's (B₁). Formulas of a ring are those of two gears with z₂ − z₁ for
//! z₁ + z₂ and x₂ − x₁ for x₁ + x₂: the *spaces* of a ring are the teeth of a gear of its size. A
//! rack is an infinite gear with its tip line (h_a* − x) m inside the pitch line. This module
//! contains only the geometry; other modules read files and draw.
//!
//! # Source
//! 孙桓、陈作模、葛文杰《机械原理》, chapter on gears; F. L. Litvin, *Gear Geometry and Applied Theory*. G_s, the
//! check of overlapping tips in a ring, is that of textbooks on planetary gears; a test turns the
//! teeth past one another.

use std::f64::consts::{FRAC_PI_2, PI};

mod outline;
pub mod unknown;
pub mod wanted;

/// Returns inv α = tan α − α: the polar angle of an involute at the point with pressure angle α.
pub fn inv(alpha: f64) -> f64 {
    libm::tan(alpha) - alpha
}

/// Returns the angle of an involute function in [0, π/2), by Newton's method from the cube root,
/// which is exact to 1 % up to 45°.
pub fn arc_inv(value: f64) -> Option<f64> {
    if !(value.is_finite() && value >= 0.0) {
        return None;
    }
    let mut alpha = libm::atan(libm::cbrt(3.0 * value));
    // d(inv)/dα = tan²α; inv is convex: from above the steps never pass the root, from below only
    // the first step does.
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

/// The common data of the two gears of a pair.
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

/// The kind of the second member of a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mate {
    /// A gear outside the first.
    Gear,
    /// A ring around the first: its teeth point inwards.
    Ring,
    /// A rack: its teeth are on a straight line.
    Rack,
}

impl Mate {
    /// Returns z₂ + z₁ or z₂ − z₁, which determines centre distance and shifts; a rack has neither.
    fn count(self, teeth: [u32; 2]) -> f64 {
        let [a, b] = teeth.map(f64::from);
        match self {
            Mate::Gear => b + a,
            Mate::Ring => b - a,
            Mate::Rack => a,
        }
    }

    /// Returns x₂ + x₁ or x₂ − x₁.
    pub fn shift(self, shifts: [f64; 2]) -> f64 {
        match self {
            Mate::Gear => shifts[1] + shifts[0],
            Mate::Ring => shifts[1] - shifts[0],
            Mate::Rack => shifts[0],
        }
    }
}

/// One gear of a pair. A rack has no number of teeth, and its radii are infinite.
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
    /// Tip circle, r_a; for a ring the innermost circle.
    pub tip: f64,
    /// Root circle, r_f; for a ring the outermost circle.
    pub root: f64,
}

/// A pair of gears at its centre distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GearPair {
    /// The common data of both gears.
    pub basic: Basic,
    /// The gears, the driver first; with a ring or a rack, the gear first.
    pub gears: [Gear; 2],
    /// The kind of the second member.
    pub mate: Mate,
    /// Operating centre distance a′; for a rack, the distance from its pitch line.
    pub distance: f64,
    /// Operating pressure angle α′ (rad).
    pub operating: f64,
}

/// Returns the operating pressure angle at a centre distance; `None` if the base circles would
/// overlap.
pub fn operating(basic: &Basic, mate: Mate, teeth: [u32; 2], distance: f64) -> Option<f64> {
    if mate == Mate::Rack {
        return Some(basic.alpha);
    }
    let cos = standard(basic, mate, teeth) * libm::cos(basic.alpha) / distance;
    (0.0..=1.0).contains(&cos).then(|| libm::acos(cos))
}

/// Returns the standard centre distance a = m (z₂ ± z₁)/2.
pub fn standard(basic: &Basic, mate: Mate, teeth: [u32; 2]) -> f64 {
    basic.module * mate.count(teeth) / 2.0
}

/// Returns x₂ ± x₁ without backlash at an operating pressure angle: (z₂ ± z₁)(inv α′ − inv α)/(2
/// tan α).
pub fn sum_of_shifts(basic: &Basic, mate: Mate, teeth: [u32; 2], operating: f64) -> f64 {
    mate.count(teeth) * (inv(operating) - inv(basic.alpha)) / (2.0 * libm::tan(basic.alpha))
}

/// Returns the centre distance without backlash at x₂ ± x₁; `None` if it has no pressure angle.
pub fn distance_of(basic: &Basic, mate: Mate, teeth: [u32; 2], sum: f64) -> Option<f64> {
    if mate == Mate::Rack {
        return Some(standard(basic, mate, teeth));
    }
    let operating =
        arc_inv(2.0 * sum * libm::tan(basic.alpha) / mate.count(teeth) + inv(basic.alpha))?;
    Some(standard(basic, mate, teeth) * libm::cos(basic.alpha) / libm::cos(operating))
}

impl GearPair {
    /// Returns the pair with these shifts at its centre distance. The tips of two gears are
    /// shortened by Δy = x₁ + x₂ − y, so that the clearance is kept; in a ring the clearance only
    /// grows, and a rack has no distance to choose. `None` if the base circles would overlap, or if
    /// a gear has no tooth height left.
    pub fn new(
        basic: Basic,
        mate: Mate,
        teeth: [u32; 2],
        shifts: [f64; 2],
        distance: f64,
    ) -> Option<GearPair> {
        let operating = operating(&basic, mate, teeth, distance)?;
        let m = basic.module;
        let shortened = match mate {
            Mate::Gear => mate.shift(shifts) - (distance - standard(&basic, mate, teeth)) / m,
            Mate::Ring | Mate::Rack => 0.0,
        };
        let gear = |i: usize| {
            let reference = m * f64::from(teeth[i]) / 2.0;
            let base = reference * libm::cos(basic.alpha);
            // A ring's teeth are the spaces of a gear: tip and root are exchanged.
            let inward = if mate == Mate::Ring && i == 1 { -1.0 } else { 1.0 };
            Gear {
                teeth: teeth[i],
                shift: shifts[i],
                reference,
                base,
                pitch: base / libm::cos(operating),
                tip: reference + (inward * basic.addendum + shifts[i] - shortened) * m,
                root: reference - (inward * (basic.addendum + basic.clearance) - shifts[i]) * m,
            }
        };
        let endless = f64::INFINITY;
        let rack = Gear {
            teeth: 0,
            shift: 0.0,
            reference: endless,
            base: endless,
            pitch: endless,
            tip: endless,
            root: endless,
        };
        let gears = [gear(0), if mate == Mate::Rack { rack } else { gear(1) }];
        let external = |g: &Gear| g.root > 0.0 && g.tip > g.base && g.tip > g.root;
        let possible = match mate {
            Mate::Gear => gears.iter().all(external),
            Mate::Ring => {
                external(&gears[0])
                    && gears[1].tip > 0.0
                    && gears[1].root > gears[1].tip
                    && gears[1].root > gears[1].base
            }
            Mate::Rack => external(&gears[0]),
        };
        possible.then_some(GearPair { basic, gears, mate, distance, operating })
    }

    /// Returns the distances of a rack's tip line inside its pitch line, and of its root line
    /// outside.
    pub fn rack(&self) -> [f64; 2] {
        let (b, x) = (&self.basic, self.gears[0].shift);
        [(b.addendum - x) * b.module, (b.addendum + b.clearance + x) * b.module]
    }

    /// Returns the base pitch p_b = π m cos α: the distance of flanks along the line of action.
    pub fn base_pitch(&self) -> f64 {
        PI * self.basic.module * libm::cos(self.basic.alpha)
    }

    /// Returns the begin and end of contact along the line of action, from the pitch point,
    /// positive in its direction; never beyond N₁, N₂.
    pub fn contact(&self) -> [f64; 2] {
        let [n1, n2] = self.tangents();
        let ends = [self.begin().max(n1), self.reach(0)];
        match self.mate {
            Mate::Gear => [ends[0], ends[1].min(n2)],
            Mate::Ring | Mate::Rack => ends,
        }
    }

    /// Returns the reach of a gear's tip circle along the line of action, from the pitch point.
    fn reach(&self, i: usize) -> f64 {
        let g = &self.gears[i];
        (g.tip * g.tip - g.base * g.base).max(0.0).sqrt() - g.pitch * libm::sin(self.operating)
    }

    /// Returns the position at which the driven gear's tips reach the line of action.
    fn begin(&self) -> f64 {
        match self.mate {
            Mate::Gear => -self.reach(1),
            Mate::Ring => self.reach(1),
            Mate::Rack => -self.rack()[0] / libm::sin(self.operating),
        }
    }

    /// Returns the points at which the line of action touches the base circles N₁, N₂, from the
    /// pitch point; infinite for a rack.
    pub fn tangents(&self) -> [f64; 2] {
        let [a, b] = self.gears.map(|g| g.pitch * libm::sin(self.operating));
        match self.mate {
            Mate::Gear | Mate::Rack => [-a, b],
            Mate::Ring => [-a, -b],
        }
    }

    /// True if a tip reaches beyond the other gear's base circle on the line of action: there the
    /// flanks would cut into one another.
    pub fn interferes(&self) -> bool {
        let [n1, n2] = self.tangents();
        // Rounding error of a reach that ends in N.
        let slack = 1e-12 * self.gears[0].tip;
        match self.mate {
            Mate::Gear => self.begin() < n1 - slack || self.reach(0) > n2 + slack,
            Mate::Ring | Mate::Rack => self.begin() < n1 - slack,
        }
    }

    /// True if a ring's teeth reach inside its base circle, where it has no involute.
    pub fn without_involute(&self) -> bool {
        self.mate == Mate::Ring && self.gears[1].tip < self.gears[1].base * (1.0 - 1e-12)
    }

    /// True if tips of gear and ring overlap away from the line of action, which happens for small
    /// z₂ − z₁: G_s < 0, with G_s = z₁(inv α_a1 + δ₁) − z₂(inv α_a2 + δ₂) + (z₂ − z₁) inv α′, δ the
    /// angles from the line of centres to the crossing of both tip circles.
    pub fn tips_overlap(&self) -> bool {
        if self.mate != Mate::Ring {
            return false;
        }
        let ([g, r], a) = (&self.gears, self.distance);
        let (p, q) = (g.tip, r.tip);
        // The tip circles do not cross: that of the gear lies inside that of the ring.
        if a + p <= q || p + q <= a {
            return false;
        }
        let at = |g: &Gear| inv(libm::acos((g.base / g.tip).min(1.0)));
        let delta =
            [(q * q - p * p - a * a) / (2.0 * p * a), (q * q - p * p + a * a) / (2.0 * q * a)]
                .map(|c| libm::acos(c.clamp(-1.0, 1.0)));
        let [y, z] = [g.teeth, r.teeth].map(f64::from);
        y * (at(g) + delta[0]) - z * (at(r) + delta[1]) + (z - y) * inv(self.operating) < 0.0
    }

    /// Returns the contact ratio ε = B₁B₂/p_b.
    pub fn contact_ratio(&self) -> f64 {
        let [from, to] = self.contact();
        (to - from) / self.base_pitch()
    }
}

#[cfg(test)]
mod tests;
