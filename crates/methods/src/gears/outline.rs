//! The outline of teeth: involute flanks of gears and rings, straight flanks of racks.

use std::f64::consts::{FRAC_PI_2, PI};

use super::{Basic, Gear, GearPair, inv};
use hodograph_base::geom::{Point, Vec2};

impl Gear {
    /// Returns half the angle of a tooth (for a ring: of a space) at a radius on or outside the
    /// base circle: (π/2 + 2x tan α)/z + inv α − inv α_r.
    pub fn half_tooth(&self, basic: &Basic, radius: f64) -> f64 {
        let at = libm::acos((self.base / radius).min(1.0));
        (FRAC_PI_2 + 2.0 * self.shift * libm::tan(basic.alpha)) / f64::from(self.teeth)
            + inv(basic.alpha)
            - inv(at)
    }

    /// True if the tooth is pointed: the flanks of a tooth meet before its tip circle, or for a
    /// ring those of a space before the root circle.
    pub fn pointed(&self, basic: &Basic) -> bool {
        let half = self.half_tooth(basic, self.tip.max(self.base));
        let inward = self.tip < self.root;
        if inward {
            half >= PI / f64::from(self.teeth) || self.half_tooth(basic, self.root) <= 0.0
        } else {
            half <= 0.0
        }
    }

    /// Returns the smallest profile shift without undercut by a rack, x_min = h_a* − z sin²α/2.
    pub fn least_shift(&self, basic: &Basic) -> f64 {
        let sin = libm::sin(basic.alpha);
        basic.addendum - f64::from(self.teeth) * sin * sin / 2.0
    }

    /// Returns the outline of a tooth, or for a ring of a space, in the gear's own frame, with its
    /// middle in the direction `middle` (rad): counter-clockwise from the inner circle before it to
    /// the inner circle behind it, with `steps` points on each flank. Below the base circle the
    /// flank is straight.
    pub fn tooth(&self, basic: &Basic, middle: f64, steps: usize) -> Vec<Point> {
        let (inner, outer) = (self.root.min(self.tip), self.root.max(self.tip));
        let from = self.base.max(inner);
        let radius = |k: usize| from + (outer - from) * k as f64 / steps as f64;
        let at = |r: f64, angle: f64| (Vec2::from_angle(angle) * r).to_point();
        let mut out = Vec::new();
        let low = self.half_tooth(basic, from);
        if inner < from {
            out.push(at(inner, middle - low));
        }
        out.extend(
            (0..=steps).map(|k| at(radius(k), middle - self.half_tooth(basic, radius(k)).max(0.0))),
        );
        out.extend(
            (0..=steps)
                .rev()
                .map(|k| at(radius(k), middle + self.half_tooth(basic, radius(k)).max(0.0))),
        );
        if inner < from {
            out.push(at(inner, middle + low));
        }
        out
    }
}

impl GearPair {
    /// Returns the outline of a rack's teeth from −`teeth` to `teeth` about the pitch point, along
    /// +x, with the gear below: the rack's flank touches the gear's right flank at the pitch point.
    pub fn rack_teeth(&self, teeth: i32) -> Vec<Point> {
        let (basic, x) = (&self.basic, self.gears[0].shift);
        let (m, tan) = (basic.module, libm::tan(basic.alpha));
        let [tip, root] = self.rack();
        // The width of a tooth on the pitch line; it grows outwards on both sides by tan α.
        let half = (PI / 4.0 - x * tan) * m;
        let mut out = Vec::new();
        for n in -teeth..=teeth {
            let middle = half + f64::from(n) * PI * m;
            let wide = |y: f64| half + y * tan;
            out.push(Point::new(middle - wide(root), root));
            out.push(Point::new(middle - wide(-tip), -tip));
            out.push(Point::new(middle + wide(-tip), -tip));
            out.push(Point::new(middle + wide(root), root));
        }
        out
    }
}
