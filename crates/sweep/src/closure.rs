//! Kernels of the dyads' positions: two circles, circle and line, two lines, the lever over a pin.
//!
//! These are the closures of [`hodograph_mechanism::position::kernel`], each with its branch fixed
//! by a sign and written over [`Lane`]. Where two loci do not meet the result is NaN; a miss within
//! rounding counts as a touch, by the same rule as there.

use super::kernel::{Kernel, Reg, RegPair};
use super::lane::Lane;
use hodograph_base::geom::Vec2;

/// Rounding slack of a radicand, relative to its terms; the rule is that of
/// [`hodograph_mechanism::position::kernel`].
pub(super) const TOUCH: f64 = 8.0 * f64::EPSILON;

/// The two factors of a closure's radicand, and the size of their terms. Both vanish where the
/// joint's links (or a link and the normal of its guide) come into line, and are smooth functions
/// of the driver on either side of that.
pub struct Margin<N> {
    /// Positive while the loci are near enough to meet.
    pub outer: N,
    /// Positive while neither circle lies within the other; 1 where there is no such case.
    pub inner: N,
    /// The size of the terms of both.
    pub terms: N,
    /// The product of both factors where the loci cross squarely; the product divided by this is
    /// sin² of the crossing angle.
    pub full: N,
}

impl<N: Lane> Margin<N> {
    /// Returns sin² of the angle under which the loci cross, the transmission angle of the group.
    /// It is smooth in the driver's position, negative where the loci miss each other, with a
    /// double zero where they only touch.
    #[inline(always)]
    pub fn crossing(&self) -> N {
        self.outer * self.inner / self.full
    }

    /// Returns the root of the product of both factors; NaN where the loci miss each other.
    #[inline(always)]
    fn root(&self) -> N {
        let slack = self.terms * TOUCH;
        (self.outer.touching(slack) * self.inner.touching(slack)).or_zero().sqrt()
    }
}

/// A closure whose loci can miss each other.
pub trait Closure<const IN: usize> {
    /// Returns the margin by which the loci meet.
    fn margin<N: Lane>(&self, x: [N; IN]) -> Margin<N>;
}

/// The crossing of a closure ([`Margin::crossing`]) as an operation of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosureCrossing<K>(pub K);

/// The crossing of two circles.
pub type CirclesCrossing = ClosureCrossing<Circles>;
/// The crossing of a circle and a line.
pub type CircleLineCrossing = ClosureCrossing<CircleLine>;
/// The crossing of a lever over a pin.
pub type LeverCrossing = ClosureCrossing<SlotLever>;

macro_rules! crossings {
    ($($closure:ident: $in:literal to $out:literal),*) => {
        $(impl Kernel<$in, 1> for ClosureCrossing<$closure> {
            #[inline(always)]
            fn inputs(&self) -> [Reg; $in] {
                Kernel::<$in, $out>::inputs(&self.0)
            }

            #[inline(always)]
            fn eval<N: Lane>(&self, x: [N; $in]) -> [N; 1] {
                [self.0.margin(x).crossing()]
            }
        })*
    };
}
crossings!(Circles: 6 to 3, CircleLine: 7 to 2, SlotLever: 4 to 2);

/// The meeting point of two circles, to the left (`sign` 1) or right (−1) of the line from the
/// first centre to the second, and det = u × w of the arms u, w from the centres to it: twice the
/// signed area of the triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Circles {
    /// The first centre.
    pub a: RegPair,
    /// The first radius.
    pub r: Reg,
    /// The second centre.
    pub b: RegPair,
    /// The second radius.
    pub s: Reg,
    /// The branch: 1 or −1.
    pub sign: f64,
}

impl Closure<6> for Circles {
    #[inline(always)]
    fn margin<N: Lane>(&self, [ax, ay, r, bx, by, s]: [N; 6]) -> Margin<N> {
        let d2 = (Vec2::new(bx, by) - Vec2::new(ax, ay)).norm2();
        let (sum, difference) = (r + s, r - s);
        Margin {
            outer: sum * sum - d2,
            inner: d2 - difference * difference,
            terms: d2 + r * r + s * s,
            full: r * r * s * s * 4.0,
        }
    }
}

/// # Source
/// m = ((r+s)² − d²)(d² − (r−s)²), the squared quadruple area after Heron; C = A + f d + h d⊥ with
/// f = (d² + r² − s²)/2d², h = ±√m/2d².
impl Kernel<6, 3> for Circles {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 6] {
        [self.a.x, self.a.y, self.r, self.b.x, self.b.y, self.s]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, x: [N; 6]) -> [N; 3] {
        let [ax, ay, r, bx, by, s] = x;
        let d = Vec2::new(bx - ax, by - ay);
        let d2 = d.norm2();
        let m = self.margin(x).root() * self.sign;
        let twice = d2 + d2;
        let f = (d2 + (r - s) * (r + s)) / twice;
        let h = m / twice;
        [ax + d.x * f - d.y * h, ay + d.y * f + d.x * h, m * 0.5]
    }
}

/// The meeting point of a circle and a line, ahead (`sign` 1) or behind along the line's direction:
/// the coordinate along the line counted from the foot of the centre, and the point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CircleLine {
    /// The centre.
    pub a: RegPair,
    /// The radius.
    pub r: Reg,
    /// A point of the line.
    pub q: RegPair,
    /// Its unit direction.
    pub t: RegPair,
    /// The branch: 1 ahead, −1 behind.
    pub sign: f64,
}

impl Closure<7> for CircleLine {
    #[inline(always)]
    fn margin<N: Lane>(&self, [ax, ay, r, qx, qy, tx, ty]: [N; 7]) -> Margin<N> {
        let h = Vec2::new(tx, ty).cross(Vec2::new(qx - ax, qy - ay));
        Margin {
            outer: (r - h) * (r + h),
            inner: r.constant(1.0),
            terms: r * r + h * h,
            full: r * r,
        }
    }
}

impl Kernel<7, 2> for CircleLine {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 7] {
        [self.a.x, self.a.y, self.r, self.q.x, self.q.y, self.t.x, self.t.y]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, x: [N; 7]) -> [N; 2] {
        let [ax, ay, _, qx, qy, tx, ty] = x;
        let t = Vec2::new(tx, ty);
        let b = t.dot(Vec2::new(qx - ax, qy - ay));
        let w = straight_root(self.margin(x)) * self.sign - b;
        [qx + tx * w, qy + ty * w]
    }
}

/// The crossing of two lines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lines {
    /// A point of the first line.
    pub p: RegPair,
    /// Its direction.
    pub u: RegPair,
    /// A point of the second line.
    pub q: RegPair,
    /// Its direction.
    pub w: RegPair,
}

impl Kernel<8, 2> for Lines {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 8] {
        [self.p.x, self.p.y, self.u.x, self.u.y, self.q.x, self.q.y, self.w.x, self.w.y]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, [px, py, ux, uy, qx, qy, wx, wy]: [N; 8]) -> [N; 2] {
        let (u, w) = (Vec2::new(ux, uy), Vec2::new(wx, wy));
        let t = Vec2::new(qx - px, qy - py).cross(w) / u.cross(w);
        [px + ux * t, py + uy * t]
    }
}

/// A lever on a pivot with a straight slot over a pin: the slot's unit direction in the plane,
/// times the complex constant `k`.
///
/// In the lever's axes the slot runs `h` to the left of the parallel through the pivot, and the pin
/// is at ±w + h i, w² = |AB|² − h². The slot's direction is therefore t = AB/(±w + h i) = AB (±w −
/// h i)/|AB|².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlotLever {
    /// The pivot A.
    pub a: RegPair,
    /// The pin B.
    pub b: RegPair,
    /// The offset of the slot.
    pub h: f64,
    /// 1 if the pin is ahead of the pivot, −1 if it is behind it.
    pub sign: f64,
    /// The complex factor that turns the slot's direction into the wanted direction of the lever.
    pub k: [f64; 2],
}

impl Closure<4> for SlotLever {
    #[inline(always)]
    fn margin<N: Lane>(&self, [ax, ay, bx, by]: [N; 4]) -> Margin<N> {
        let r2 = Vec2::new(bx - ax, by - ay).norm2();
        let h2 = self.h * self.h;
        Margin { outer: r2 + -h2, inner: r2.constant(1.0), terms: r2 + h2, full: r2 }
    }
}

impl Kernel<4, 2> for SlotLever {
    #[inline(always)]
    fn inputs(&self) -> [Reg; 4] {
        [self.a.x, self.a.y, self.b.x, self.b.y]
    }

    #[inline(always)]
    fn eval<N: Lane>(&self, x: [N; 4]) -> [N; 2] {
        let [ax, ay, bx, by] = x;
        let d = Vec2::new(bx - ax, by - ay);
        let w = straight_root(self.margin(x)) * self.sign;
        let r2 = d.norm2();
        let t = Vec2::new((d.x * w + d.y * self.h) / r2, (d.y * w + d.x * -self.h) / r2);
        [t.x * self.k[0] + t.y * -self.k[1], t.x * self.k[1] + t.y * self.k[0]]
    }
}

/// The root of a margin that has no inner case.
#[inline(always)]
fn straight_root<N: Lane>(m: Margin<N>) -> N {
    m.outer.touching(m.terms * TOUCH).or_zero().sqrt()
}
