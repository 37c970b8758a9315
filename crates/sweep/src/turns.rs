//! Kernels of cosine and sine of angles that are counted beyond a turn.
//!
//! A driver's angle consists of its value, and its cosine and sine, which are exact for any number
//! of turns if the angle is written in degrees. [`Quarters`] makes of the three a whole number of
//! quarter turns and a remainder, exact to the last digit. [`Geared`] multiplies both by a ratio of
//! whole numbers, the turns in whole numbers, so that no digit is lost after thousands of them.

use super::kernel::{Kernel, Reg, RegPair};
use super::lane::Lane;
use super::program::{COS, SIN, VALUE};
use hodograph_base::geom::Vec2;
use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};

/// π/2 in two parts: the first has 33 bits, so that a whole number of them is exact.
pub(super) const QUARTER: [f64; 2] = [1.570_796_326_734_125_6, 6.077_100_506_506_192e-11];

/// Returns cos and sin of `x` plus `j` quarter turns, for |x| hardly more than an eighth of a turn.
///
/// # Source
/// The polynomials of fdlibm, *k_sin.c* and *k_cos.c* (Sun Microsystems, 1993).
#[inline(always)]
fn rotor<N: Lane>(j: N, x: N) -> [N; 2] {
    let m = j + (j * 0.25).nearest() * -4.0;
    let size = m.or_zero() + (-m).or_zero();
    let (cj, sj) = (-size + 1.0, m * (-size + 2.0));
    let z = x * x;
    let r = z
        * (z * (z * (z * 1.589_690_995_211_55e-10 + -2.505_076_025_340_686_3e-8)
            + 2.755_731_370_707_006_8e-6)
            + -1.984_126_982_985_795e-4)
        + 8.333_333_333_322_49e-3;
    let s = x + z * x * (z * r + -1.666_666_666_666_663_2e-1);
    let r = z
        * (z * (z
            * (z * (z * (z * -1.135_964_755_778_819_5e-11 + 2.087_572_321_298_175e-9)
                + -2.755_731_435_139_066_3e-7)
                + 2.480_158_728_947_673e-5)
            + -1.388_888_888_887_411e-3)
            + 4.166_666_666_666_66e-2);
    let half = z * 0.5;
    let w = -half + 1.0;
    let c = w + ((-w + 1.0 - half) + z * r);
    [c * cj - s * sj, s * cj + c * sj]
}

/// Returns cos and sin of an angle (rad) plus a number of quarter turns.
#[inline(always)]
pub(super) fn turned<N: Lane>(j: N, x: N) -> [N; 2] {
    let more = (x * FRAC_2_PI).nearest();
    rotor(j + more, x + more * -QUARTER[0] + more * -QUARTER[1])
}

/// The driver's angle as a whole number of quarter turns, and the remainder (rad).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quarters;

impl Kernel<3, 2> for Quarters {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 3] {
        [VALUE, COS, SIN]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [value, c, s]: [N; 3]) -> [N; 2] {
        let k = (value * FRAC_2_PI).nearest();
        let near = value + k * -QUARTER[0] + k * -QUARTER[1];
        // The value is rounded in proportion to its size; cosine and sine are not, and give the
        // difference.
        let [cw, sw] = rotor(k, near);
        let off = s * cw - c * sw;
        [k, near + off * (off * off * (1.0 / 6.0) + 1.0)]
    }
}

/// Cosine and sine of p/q of the driver's travel since the instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Geared {
    /// The driver's angle in [`Quarters`].
    pub quarters: RegPair,
    /// The driver's angle at the instant, in the same form.
    pub start: [f64; 2],
    /// The numerator: whole, or any number over 1.
    pub p: f64,
    /// The denominator: whole.
    pub q: f64,
}

impl Kernel<2, 2> for Geared {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 2] {
        [self.quarters.x, self.quarters.y]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [k, r]: [N; 2]) -> [N; 2] {
        let Geared { start: [k0, r0], p, q, .. } = *self;
        let all = (k + -k0) * p;
        // Whole turns first: all of these are whole numbers.
        let part = all + (all * (0.25 / q)).nearest() * (-4.0 * q);
        let whole = (part * (1.0 / q)).nearest();
        let left = part + whole * -q;
        turned(whole, (r + -r0) * (p / q) + left * (FRAC_PI_2 / q))
    }
}

/// Cosine and sine of an angle of any size (rad).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CosineSine {
    /// The angle.
    pub angle: Reg,
}

impl Kernel<1, 2> for CosineSine {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 1] {
        [self.angle]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [angle]: [N; 1]) -> [N; 2] {
        let j = (angle * FRAC_2_PI).nearest();
        rotor(j, angle + j * -QUARTER[0] + j * -QUARTER[1])
    }
}

/// The angle of a line relative to another that turns along with it in the mean (rad), in (centre −
/// π, centre + π].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Against {
    /// The line.
    pub d: RegPair,
    /// Cosine and sine of the other's rotation.
    pub turn: RegPair,
    /// The direction of the line at the instant, turned by the centre.
    pub start: Vec2,
    /// The middle of the interval of the angle.
    pub centre: f64,
}

impl Kernel<4, 1> for Against {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 4] {
        [self.d.x, self.d.y, self.turn.x, self.turn.y]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [dx, dy, c, s]: [N; 4]) -> [N; 1] {
        let (x, y) = (dx * c + dy * s, dy * c - dx * s);
        let [ux, uy] = [self.start.x, self.start.y];
        [(y * ux + x * -uy).atan2(x * ux + y * uy) + self.centre]
    }
}

/// The rate u·ṙ + ω u × r of the distance s = u·r along a direction u of a link with the angular
/// velocity ω.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WayRate {
    /// The direction u.
    pub u: RegPair,
    /// The vector r.
    pub r: RegPair,
    /// The rate ṙ.
    pub v: RegPair,
    /// The angular velocity ω.
    pub omega: Reg,
}

impl Kernel<7, 1> for WayRate {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 7] {
        [self.u.x, self.u.y, self.r.x, self.r.y, self.v.x, self.v.y, self.omega]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [ux, uy, rx, ry, vx, vy, w]: [N; 7]) -> [N; 1] {
        let u = Vec2::new(ux, uy);
        [u.dot(Vec2::new(vx, vy)) + w * u.cross(Vec2::new(rx, ry))]
    }
}

/// The second derivative of the distance: u·r̈ + 2 ω u × ṙ + α u × r − ω² u·r.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WayAcceleration {
    /// The operation of the rate.
    pub way: WayRate,
    /// The second derivative r̈.
    pub a: RegPair,
    /// The angular acceleration α.
    pub alpha: Reg,
}

impl Kernel<10, 1> for WayAcceleration {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 10] {
        let WayRate { u, r, v, omega } = self.way;
        [u.x, u.y, r.x, r.y, v.x, v.y, omega, self.a.x, self.a.y, self.alpha]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [ux, uy, rx, ry, vx, vy, w, ax, ay, e]: [N; 10]) -> [N; 1] {
        let (u, r) = (Vec2::new(ux, uy), Vec2::new(rx, ry));
        [u.dot(Vec2::new(ax, ay)) + w * u.cross(Vec2::new(vx, vy)) * 2.0 + e * u.cross(r)
            - w * w * u.dot(r)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hodograph_base::trig;
    use hodograph_scene::Angle;

    /// After a hundred thousand turns the angles are as exact as after one: compared with whole
    /// numbers, for one position and for four.
    #[test]
    fn no_digit_is_lost_over_many_turns() {
        let start = {
            let (s, c) = trig::sin_cos(Angle::Deg(30.0));
            Quarters.eval([Angle::Deg(30.0).radians(), c, s])
        };
        let reg = Reg(0);
        for (p, q) in [(21i64, 40i64), (-7, 3), (1, 1), (101, 97), (-997, 1009), (1, 12), (44, 7)] {
            let geared =
                Geared { quarters: RegPair { x: reg, y: reg }, start, p: p as f64, q: q as f64 };
            let mut worst: f64 = 0.0;
            for turn in [0i64, 1, 9_999, 10_000, -10_000, 100_000] {
                for part in (-720..=720).step_by(7) {
                    let degrees = 360 * turn + part;
                    let (s, c) = trig::sin_cos(Angle::Deg(degrees as f64));
                    let quarters = Quarters.eval([Angle::Deg(degrees as f64).radians(), c, s]);
                    let [gc, gs] = geared.eval(quarters);
                    // The travel times p/q in whole numbers: degrees over q.
                    let way = (p * (degrees - 30)).rem_euclid(360 * q);
                    let (es, ec) = trig::sin_cos(Angle::Deg(way as f64 / q as f64));
                    worst = worst.max((gc - ec).abs()).max((gs - es).abs());
                }
            }
            let ratio = (p as f64 / q as f64).abs().max(1.0);
            assert!(worst < 6e-16 * (1.0 + ratio), "{p}/{q}: {worst:e}");
        }
    }

    #[test]
    fn angles_of_any_size_have_their_cosines() {
        for k in -40_000..40_000 {
            let x = f64::from(k) * 0.0371;
            let [c, s] = CosineSine { angle: Reg(0) }.eval([x]);
            assert!((c - libm::cos(x)).abs() < 1e-15 && (s - libm::sin(x)).abs() < 1e-15, "{x}");
        }
    }
}
