//! All assemblies of a link on three legs, at most six for three bars: the roots of its eliminant
//! ([`super::eliminant`]) are its angles, two legs give its position (two closures at most), and
//! Newton's method on all three legs makes both exact.

use super::Pose;
use super::eliminant;
use super::kernel::{Locus, meet};
use super::proof::{self, Unproven};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;

/// A leg of the link: the locus of a point of the link, as a function of the link's angle.
#[derive(Clone, Copy, Debug)]
pub enum TriadLeg<N = f64> {
    /// Local point `near` at `radius` from `far`.
    Circle {
        /// The point, in the frame of the link.
        near: Point<N>,
        /// The centre, in the plane.
        far: Point<N>,
        /// The distance (m).
        radius: N,
    },
    /// Local point `near` on a line of the plane.
    Line {
        /// The point, in the frame of the link.
        near: Point<N>,
        /// A point of the line, in the plane.
        through: Point<N>,
        /// Direction of the line, in the plane.
        direction: Vec2<N>,
    },
    /// A line of the link passes a point of the plane.
    Slot {
        /// A point of the line, in the frame of the link.
        through: Point<N>,
        /// Direction of the line, in the frame of the link.
        direction: Vec2<N>,
        /// The point, in the plane.
        pin: Point<N>,
    },
}

impl<N: Real> TriadLeg<N> {
    /// Returns the nearest leg in `f64`.
    pub fn approx(&self) -> TriadLeg {
        match *self {
            TriadLeg::Circle { near, far, radius } => {
                TriadLeg::Circle { near: near.approx(), far: far.approx(), radius: radius.approx() }
            }
            TriadLeg::Line { near, through, direction } => TriadLeg::Line {
                near: near.approx(),
                through: through.approx(),
                direction: direction.approx(),
            },
            TriadLeg::Slot { through, direction, pin } => TriadLeg::Slot {
                through: through.approx(),
                direction: direction.approx(),
                pin: pin.approx(),
            },
        }
    }

    /// Returns the locus of the link's origin for the direction `axis` of its frame.
    pub fn locus(&self, axis: Vec2<N>) -> Locus<N> {
        match *self {
            TriadLeg::Circle { near, far, radius } => {
                Locus::Circle { centre: far - near.to_vec2().rotate_by(axis), radius }
            }
            TriadLeg::Line { near, through, direction } => {
                Locus::Line { through: through - near.to_vec2().rotate_by(axis), direction }
            }
            TriadLeg::Slot { through, direction, pin } => Locus::Line {
                through: pin - through.to_vec2().rotate_by(axis),
                direction: direction.rotate_by(axis),
            },
        }
    }

    /// Returns the signed distance by which the leg is missed.
    pub fn miss(&self, origin: Point<N>, axis: Vec2<N>) -> N {
        match self.locus(axis) {
            Locus::Circle { centre, radius } => origin.distance(centre) - radius,
            Locus::Line { through, direction } => direction.cross(origin - through),
        }
    }

    /// Returns the derivatives of [`TriadLeg::miss`] by the origin's x and y and by the angle times
    /// `scale` (so that all three are comparable).
    pub fn gradient(&self, origin: Point<N>, axis: Vec2<N>, scale: f64) -> [N; 3] {
        let (by_origin, by_angle) = match *self {
            TriadLeg::Circle { near, far, .. } => {
                let arm = near.to_vec2().rotate_by(axis);
                let d = origin + arm - far;
                let u = d * (N::from_f64(1.0) / d.norm());
                (u, u.dot(arm.perp()))
            }
            TriadLeg::Line { near, direction, .. } => {
                (direction.perp(), direction.cross(near.to_vec2().rotate_by(axis).perp()))
            }
            TriadLeg::Slot { through, direction, pin } => {
                let (u, q) = (direction.rotate_by(axis), through.to_vec2().rotate_by(axis));
                (u.perp(), u.perp().cross(origin + q - pin) + u.cross(q.perp()))
            }
        };
        [by_origin.x, by_origin.y, by_angle / N::from_f64(scale)]
    }
}

/// Returns all assemblies (origin, axis), at most one for each root of the eliminant and each
/// position that two legs allow there.
///
/// Each pair of legs is used in turn to give the position: if two legs barely reach each other, or
/// are parallel, their intersection is not accurate; that of another pair is. Near a fold two
/// assemblies coincide: the sketched pose is refined as well, which gives the assembly of the
/// sketch.
pub(super) fn assemblies(
    legs: &[TriadLeg; 3],
    sketched: Option<(Point, Vec2)>,
) -> Vec<(Point, Vec2)> {
    let scale = scale_of(legs);
    let mut found: Vec<(Point, Vec2)> = Vec::new();
    let axes: Vec<Vec2> =
        eliminant::angles(legs, scale).into_iter().map(Vec2::from_angle).collect();
    for [a, b, c] in [[0, 1, 2], [0, 2, 1], [1, 2, 0]] {
        for &axis in &axes {
            let places = meet(legs[a].locus(axis), legs[b].locus(axis)).unwrap_or_default();
            let near = places
                .into_iter()
                .filter(|p| p.is_finite() && legs[c].miss(*p, axis).abs() < ROUGH * scale);
            for hit in near.filter_map(|origin| polished(legs, (origin, axis), scale, POLISH)) {
                // Once more from the root: the last step ended at a small residual, not at zero.
                keep(&mut found, polished(legs, hit, scale, POLISH).unwrap_or(hit), scale);
            }
        }
    }
    if let Some(hit) = sketched.and_then(|from| polished(legs, from, scale, SKETCH)) {
        keep(&mut found, hit, scale);
    }
    found
}

/// At a root of the eliminant the third leg is missed within rounding, close to a fold within its
/// square root. A position with a larger miss is the other position that the two legs allow.
const ROUGH: f64 = 1e-2;

/// Returns the assembly near a pose, in the numbers of the legs.
pub(super) fn refined<N: Real>(legs: &[TriadLeg<N>; 3], near: Pose) -> Result<Pose<N>, Unproven> {
    let start: Pose<N> = near.lift();
    if !N::refines() {
        return Ok(start);
    }
    // An axis rounded to f64 is a unit vector only to f64.
    let start = Pose { axis: start.axis.unit().ok_or(Unproven::NoRoot)?, ..start };
    let scale = scale_of(&legs.map(|l| l.approx()));
    proof::root(&TriadEquations { legs, scale }, start, scale)
}

/// A link on three legs as equations for its pose; all three unknowns are lengths, that of the
/// angle multiplied by `scale`.
struct TriadEquations<'a, N> {
    legs: &'a [TriadLeg<N>; 3],
    scale: f64,
}

impl<N: Real> proof::SquareSystem<N> for TriadEquations<'_, N> {
    type State = Pose<N>;

    fn residuals(&self, at: &Pose<N>) -> Vec<N> {
        self.legs.iter().map(|l| l.miss(at.origin, at.axis)).collect()
    }

    fn jacobian(&self, at: &Pose<N>) -> Vec<Vec<N>> {
        self.legs.iter().map(|l| l.gradient(at.origin, at.axis, self.scale).to_vec()).collect()
    }

    fn moved(&self, at: &Pose<N>, step: &[N]) -> Pose<N> {
        let turn = step[2] / N::from_f64(self.scale);
        Pose { origin: at.origin + Vec2::new(step[0], step[1]), axis: proof::turned(at.axis, turn) }
    }

    fn angles(&self) -> Vec<(usize, f64)> {
        vec![(2, self.scale)]
    }
}

/// Polished solutions are accurate to a few units of 1e-16 times their condition number; two
/// assemblies closer together than this are at a fold, where they are one.
const SAME: f64 = 1e-7;

fn keep(found: &mut Vec<(Point, Vec2)>, hit: (Point, Vec2), scale: f64) {
    let same =
        |o: &(Point, Vec2)| (o.0 - hit.0).norm() < SAME * scale && (o.1 - hit.1).norm() < SAME;
    if !found.iter().any(same) {
        found.push(hit);
    }
}

/// A polish moves by rounding; a longer motion would find another assembly or none.
const POLISH: f64 = 1e-2;

/// A sketch may deviate by a tenth of the mechanism; a longer step leads to another assembly.
const SKETCH: f64 = 0.3;

/// Solves the three legs by Newton's method; `None` if it does not converge nearby.
fn polished(
    legs: &[TriadLeg; 3],
    from: (Point, Vec2),
    scale: f64,
    longest: f64,
) -> Option<(Point, Vec2)> {
    let (mut origin, mut axis) = from;
    for _ in 0..12 {
        let rows = legs.map(|l| l.gradient(origin, axis, scale));
        let rhs = legs.map(|l| -l.miss(origin, axis));
        let (step, _) = cramer(rows, rhs);
        let turn = step[2] / scale;
        let size = (step[0].abs() + step[1].abs()) / scale + turn.abs();
        if !size.is_finite() || size > longest {
            return None;
        }
        origin = origin + Vec2::new(step[0], step[1]);
        axis = axis.rotate_by(Vec2::from_angle(turn)).unit()?;
        if size < 4.0 * f64::EPSILON {
            break;
        }
    }
    let off = legs.iter().map(|l| l.miss(origin, axis).abs()).fold(0.0, f64::max);
    (off < 1e-9 * scale).then_some((origin, axis))
}

/// Returns the solution of three linear equations, and their determinant.
pub fn cramer(rows: [[f64; 3]; 3], rhs: [f64; 3]) -> ([f64; 3], f64) {
    let det = |c: [[f64; 3]; 3]| {
        c[0][0] * (c[1][1] * c[2][2] - c[1][2] * c[2][1])
            - c[0][1] * (c[1][0] * c[2][2] - c[1][2] * c[2][0])
            + c[0][2] * (c[1][0] * c[2][1] - c[1][1] * c[2][0])
    };
    let whole = det(rows);
    let solution = [0, 1, 2].map(|k| {
        let mut c = rows;
        for (row, r) in c.iter_mut().zip(rhs) {
            row[k] = r;
        }
        det(c) / whole
    });
    (solution, whole)
}

fn scale_of(legs: &[TriadLeg; 3]) -> f64 {
    legs.iter().map(size).fold(0.0, f64::max)
}

fn size(leg: &TriadLeg) -> f64 {
    match *leg {
        TriadLeg::Circle { near, radius, .. } => radius + near.to_vec2().norm(),
        TriadLeg::Line { near, .. } => near.to_vec2().norm(),
        TriadLeg::Slot { through, .. } => through.to_vec2().norm(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pseudo-random numbers in [0, 1), equal on every platform.
    struct XorShift(u64);

    impl XorShift {
        fn next(&mut self) -> f64 {
            self.0 ^= self.0 << 13;
            self.0 ^= self.0 >> 7;
            self.0 ^= self.0 << 17;
            (self.0 >> 11) as f64 / (1u64 << 53) as f64
        }

        fn point(&mut self) -> Point {
            Point::new(4.0 * self.next() - 2.0, 4.0 * self.next() - 2.0)
        }

        /// Returns a leg of a kind that holds a link in a pose.
        fn leg(&mut self, kind: usize, (origin, axis): (Point, Vec2)) -> TriadLeg {
            let direction = Vec2::from_angle(6.3 * self.next());
            let (near, other) = (self.point(), self.point());
            let there = origin + near.to_vec2().rotate_by(axis);
            match kind {
                0 => TriadLeg::Circle { near, far: other, radius: there.distance(other) },
                1 => TriadLeg::Line {
                    near,
                    through: there + direction * (self.next() - 0.5),
                    direction,
                },
                _ => TriadLeg::Slot {
                    through: near,
                    direction,
                    pin: there + direction.rotate_by(axis) * (self.next() - 0.5),
                },
            }
        }
    }

    #[test]
    fn gradients_are_slopes_of_what_a_leg_is_missed_by() {
        let mut random = XorShift(0x9e37_79b9_7f4a_7c15);
        for k in 0..300 {
            let pose = (random.point(), Vec2::from_angle(6.3 * random.next()));
            let leg = random.leg(k % 3, pose);
            // A pose in which the leg does not hold the link, so that the miss is not zero.
            let (origin, axis, scale) =
                (random.point(), Vec2::from_angle(6.3 * random.next()), 0.5 + 2.0 * random.next());
            let slope = |by: &dyn Fn(f64) -> (Point, Vec2)| {
                let miss = |h: f64| leg.miss(by(h).0, by(h).1);
                (miss(1e-6) - miss(-1e-6)) / 2e-6
            };
            let slopes = [
                slope(&|h| (origin + Vec2::new(h, 0.0), axis)),
                slope(&|h| (origin + Vec2::new(0.0, h), axis)),
                slope(&|h| (origin, axis.rotate_by(Vec2::from_angle(h / scale)))),
            ];
            let gradient = leg.gradient(origin, axis, scale);
            for (g, s) in gradient.iter().zip(slopes) {
                assert!(
                    (g - s).abs() < 1e-7 * (1.0 + s.abs()),
                    "{leg:?}: {gradient:?}, slopes {slopes:?}"
                );
            }
        }
    }

    /// A polish converges to the pose within its limit; if the legs contradict one another it
    /// fails.
    #[test]
    fn a_polish_settles_near_by_or_not_at_all() {
        let mut random = XorShift(0x2545_f491_4f6c_dd1d);
        let (mut settled, mut refused) = (0, 0);
        for k in 0..200 {
            let pose = (random.point(), Vec2::from_angle(6.3 * random.next()));
            let legs = [0, 1, 2].map(|leg| random.leg([0, k % 3, k / 3 % 3][leg], pose));
            let scale = scale_of(&legs);
            let off = 1e-4 * scale;
            let from = (pose.0 + Vec2::new(off, -off), pose.1.rotate_by(Vec2::from_angle(1e-4)));
            if let Some((origin, axis)) = polished(&legs, from, scale, POLISH) {
                let missed = legs.iter().map(|l| l.miss(origin, axis).abs()).fold(0.0, f64::max);
                assert!(missed < 1e-9 * scale, "{k}: misses by {missed:e}");
                settled += usize::from((origin - pose.0).norm() < 0.1 * scale);
            }
            // A step longer than the limit is no polish.
            let far = (
                pose.0 + Vec2::new(0.5 * scale, 0.3 * scale),
                pose.1.rotate_by(Vec2::from_angle(0.9)),
            );
            refused += usize::from(polished(&legs, far, scale, 1e-6).is_none());
        }
        assert!(settled > 180 && refused == 200, "{settled} settle, {refused} are refused");
        // A circle that the pin cannot reach because of the other two legs.
        let at = |x: f64, y: f64| Point::new(x, y);
        let unreachable = [
            TriadLeg::Line {
                near: at(0.0, 0.0),
                through: at(0.0, 0.0),
                direction: Vec2::new(1.0, 0.0),
            },
            TriadLeg::Line {
                near: at(0.0, 0.0),
                through: at(0.0, 1.0),
                direction: Vec2::new(1.0, 0.0),
            },
            TriadLeg::Circle { near: at(1.0, 0.0), far: at(0.0, 0.0), radius: 1.0 },
        ];
        assert!(polished(&unreachable, (at(0.0, 0.5), Vec2::new(1.0, 0.0)), 1.0, SKETCH).is_none());
    }

    /// The pose from which the legs are made is among the assemblies, each assembly satisfies them,
    /// and none occurs twice; a sketch adds none.
    #[test]
    fn every_assembly_is_found_once() {
        let mut random = XorShift(0x1234_5678_9abc_def1);
        let (mut missing, mut tried) = (0, 0);
        for k in 0..3_000 {
            let pose = (random.point(), Vec2::from_angle(6.3 * random.next()));
            let legs = [0, 1, 2].map(|leg| random.leg([0, k % 3, k / 3 % 3][leg], pose));
            let found = assemblies(&legs, None);
            let apart =
                |a: &(Point, Vec2), b: &(Point, Vec2)| (a.0 - b.0).norm() + (a.1 - b.1).norm();
            tried += 1;
            missing += usize::from(!found.iter().any(|f| apart(f, &pose) < 1e-6));
            for (i, f) in found.iter().enumerate() {
                let off = legs.iter().map(|l| l.miss(f.0, f.1).abs()).fold(0.0, f64::max);
                assert!(off < 1e-8, "{k}: {f:?} misses a leg by {off:e}");
                assert!(found[..i].iter().all(|o| apart(o, f) > 1e-8), "{k}: {f:?} is there twice");
            }
            let sketched = assemblies(&legs, Some(pose));
            assert!(
                sketched.iter().any(|f| apart(f, &pose) < 1e-6),
                "{k}: not even with its sketch"
            );
            assert!(
                sketched.len() >= found.len() && sketched.len() <= found.len() + 1,
                "{k}: {} and {}",
                found.len(),
                sketched.len()
            );
        }
        assert_eq!(missing, 0, "of {tried} not found");
    }

    #[test]
    fn three_equations_are_solved() {
        let mut random = XorShift(77);
        for _ in 0..50 {
            let rows = [(); 3].map(|()| [(); 3].map(|()| 2.0 * random.next() - 1.0));
            let x = [(); 3].map(|()| 2.0 * random.next() - 1.0);
            let rhs = rows.map(|r| r[0] * x[0] + r[1] * x[1] + r[2] * x[2]);
            let (solution, whole) = cramer(rows, rhs);
            assert!(
                solution.iter().zip(x).all(|(s, x)| (s - x).abs() < 1e-13 / whole.abs()),
                "{rows:?}: {solution:?}, not {x:?}"
            );
        }
    }
}
