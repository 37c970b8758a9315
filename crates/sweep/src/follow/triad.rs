//! Class III groups along a sweep: predictor–corrector continuation with step control, which stays
//! on its assembly.
//!
//! A link on three legs has up to six assemblies, which no single sign distinguishes. From an
//! accepted position the next is predicted along the tangent and corrected by Newton's method. It
//! is accepted only if the iteration converges within [`PATIENCE`] steps, the correction is small
//! relative to the predicted move, and the determinant of the three legs keeps its sign (two
//! assemblies that meet at a fold have opposite signs); else the step is halved. Where steps become
//! as small as [`SMALLEST`] the mechanism is at its limit.
//!
//! # Source
//! E. L. Allgower, K. Georg, *Numerical Continuation Methods* (1990), ch. 6.

use crate::kernel::{Reg, RegPair};
use crate::lane::Dual;
use crate::program::SweepProgram;
use hodograph_base::geom::{Point, Vec2};
use hodograph_mechanism::position::toggle::PARALLEL;
use hodograph_mechanism::position::triad::{TriadLeg, cramer};
use hodograph_scene::LinkId;

/// A leg that holds a followed link: its known quantities, in registers. Local places count from
/// the link's own point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TrackLeg {
    /// The local point `near` at a distance from `far`.
    Circle {
        /// The point in the link.
        near: Vec2,
        /// The point in the plane.
        far: RegPair,
        /// The distance.
        radius: Reg,
    },
    /// The local point `near` on a line.
    Line {
        /// The point in the link.
        near: Vec2,
        /// A point of the line.
        through: RegPair,
        /// Its direction.
        direction: RegPair,
    },
    /// A line of the link passes a point.
    Slot {
        /// A point of the line, in the link.
        through: Vec2,
        /// Its direction, in the link.
        direction: Vec2,
        /// The point in the plane.
        over: RegPair,
    },
}

/// A link that is followed from position to position.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkTrack {
    /// Its group.
    pub group: usize,
    /// The link.
    pub link: LinkId,
    /// The number of steps of positions that come before it.
    pub step: usize,
    /// The registers of its own point.
    pub own: RegPair,
    /// The registers of its arm: the frame's x axis, `unit` long.
    pub arm: RegPair,
    /// The length of the arm, near the size of the mechanism (m).
    pub unit: f64,
    /// Its legs.
    pub held: [TrackLeg; 3],
    /// Its own point and axis at the instant.
    pub start: (Point, Vec2),
}

/// The smallest step of the driver, relative to a radian or to the size of the mechanism: nearer to
/// a fold than this, Newton's method meets the square root of rounding.
const SMALLEST: f64 = 1e-9;

/// The greatest number of steps of Newton's method in an accepted move: from a good prediction
/// quadratic convergence needs three or four.
const PATIENCE: usize = 5;

/// The largest correction, as a part of the predicted move: the tangent of a smooth path is truer
/// than this, the way to another assembly is not.
const LEAP: f64 = 0.3;

/// The greatest ratio by which the determinant may grow or shrink in one move: toward a fold it
/// varies as the root of the distance, so that the distance itself may shrink sixteenfold.
const STEADY: f64 = 4.0;

/// The correction (relative to the mechanism) below which a move is no leap, however short.
const SLIGHT: f64 = 1e-6;

/// The positions of the followed links, and their tangents.
#[derive(Clone, Debug)]
pub struct FollowedState {
    /// The value of the swept quantity.
    pub value: f64,
    links: Vec<Followed>,
}

#[derive(Clone, Copy, Debug)]
struct Followed {
    own: Point,
    axis: Vec2,
    /// Derivatives of the own point and of the angle by the swept quantity.
    slope: (Vec2, f64),
    /// The determinant of the three legs; its sign distinguishes neighbouring assemblies.
    det: f64,
}

/// A function that returns cosine and sine of the swept quantity's value, and the derivative of
/// that angle by the value.
pub type TurnFunction<'a> = &'a dyn Fn(f64) -> (f64, f64, f64);

impl SweepProgram {
    /// Returns the followed links at the instant, with the given value of the swept quantity;
    /// `None` if the pose does not fit.
    pub fn start(&self, value: f64, turn: TurnFunction) -> Option<FollowedState> {
        let guess: Vec<Followed> = self
            .tracks
            .iter()
            .map(|t| Followed {
                own: t.start.0,
                axis: t.start.1,
                slope: (Vec2::ZERO, 0.0),
                det: 0.0,
            })
            .collect();
        self.settle(&FollowedState { value, links: guess }, value, turn).map(|(state, _)| state)
    }

    /// Advances to a value of the swept quantity; on failure returns the last state that was
    /// reached.
    pub fn advance(
        &self,
        from: &FollowedState,
        value: f64,
        turn: TurnFunction,
    ) -> Result<FollowedState, FollowedState> {
        let scale = if self.angular { 1.0 } else { self.tracks.first().map_or(1.0, |t| t.unit) };
        let mut state = from.clone();
        let mut step = value - state.value;
        while state.value != value {
            let next =
                if (value - state.value).abs() <= step.abs() { value } else { state.value + step };
            match self.settle(&state, next, turn) {
                Some((reached, easy)) => {
                    state = reached;
                    if easy {
                        step *= 2.0;
                    }
                }
                None => {
                    step = 0.5 * (next - state.value);
                    if step.abs() < SMALLEST * scale {
                        return Err(state);
                    }
                }
            }
        }
        Ok(state)
    }

    /// Makes one guarded move; returns also `true` if it was so easy that the next may be longer.
    fn settle(
        &self,
        from: &FollowedState,
        value: f64,
        turn: TurnFunction,
    ) -> Option<(FollowedState, bool)> {
        let (cos, sin, per_value) = turn(value);
        let mut registers = self.inputs(value, cos, sin, per_value);
        let mut done = 0;
        let mut links = Vec::with_capacity(self.tracks.len());
        let mut easy = true;
        for (track, last) in self.tracks.iter().zip(&from.links) {
            self.derive_steps(done..track.step, &mut registers);
            done = track.step;
            let moved = value - from.value;
            let (followed, simple) = track.move_on(last, moved, &registers)?;
            easy &= simple;
            track.store(&followed, &mut registers);
            links.push(followed);
        }
        Some((FollowedState { value, links }, easy))
    }

    /// Writes the followed links of a state into a buffer's row.
    pub fn show(
        &self,
        state: &FollowedState,
        fused: &crate::fuse::Fused,
        buffer: &mut crate::run::Buffer,
        row: usize,
    ) {
        for (t, f) in self.tracks.iter().zip(&state.links) {
            let numbers = [
                (t.own.x, f.own.x),
                (t.own.y, f.own.y),
                (t.arm.x, f.axis.x * t.unit),
                (t.arm.y, f.axis.y * t.unit),
            ];
            for (reg, number) in numbers {
                if let Some(place) = fused.place(reg) {
                    buffer.set(place, row, number);
                }
            }
        }
    }

    /// Returns the registers of all positions in a state.
    pub fn placed(&self, at: &FollowedState, turn: TurnFunction) -> Vec<Dual> {
        let (cos, sin, per_value) = turn(at.value);
        let mut registers = self.inputs(at.value, cos, sin, per_value);
        let mut done = 0;
        for (track, f) in self.tracks.iter().zip(&at.links) {
            self.derive_steps(done..track.step, &mut registers);
            done = track.step;
            track.store(f, &mut registers);
        }
        self.derive_steps(done..self.steps[0].len(), &mut registers);
        registers
    }

    /// Returns true if the lines along which a followed link's legs hold it are parallel in a state
    /// next to its fold; else they meet in one point.
    pub fn parallel(&self, track: usize, at: &FollowedState, turn: TurnFunction) -> bool {
        let t = &self.tracks[track];
        let registers = self.placed(at, turn);
        let f = &at.links[track];
        // A leg holds the link along the gradient of its residual.
        let along = t
            .legs(&registers)
            .map(|l| l.gradient(f.own, f.axis, t.unit))
            .map(|g| Vec2::new(g[0], g[1]).unit());
        let [Some(u), Some(v), Some(w)] = along else { return false };
        [u.cross(v), v.cross(w), w.cross(u)].iter().all(|sine| sine.abs() < PARALLEL)
    }

    /// Returns the determinants of the followed links' legs: where one vanishes, the driver stops.
    pub fn determinants(&self, state: &FollowedState) -> Vec<f64> {
        state.links.iter().map(|f| f.det).collect()
    }
}

impl LinkTrack {
    fn store(&self, f: &Followed, registers: &mut [Dual]) {
        let (v, omega) = f.slope;
        let put = |registers: &mut [Dual], reg: Reg, value: f64, slope: f64| {
            registers[reg.0 as usize] = Dual { value, slope }
        };
        put(registers, self.own.x, f.own.x, v.x);
        put(registers, self.own.y, f.own.y, v.y);
        let (arm, rate) = (f.axis * self.unit, f.axis.perp() * (self.unit * omega));
        put(registers, self.arm.x, arm.x, rate.x);
        put(registers, self.arm.y, arm.y, rate.y);
    }

    /// The legs in the form of the position solver.
    fn legs(&self, registers: &[Dual]) -> [TriadLeg; 3] {
        let number = |r: Reg| registers[r.0 as usize].value;
        let point = |p: RegPair| Point::new(number(p.x), number(p.y));
        self.held.map(|h| match h {
            TrackLeg::Circle { near, far, radius } => {
                TriadLeg::Circle { near: near.to_point(), far: point(far), radius: number(radius) }
            }
            TrackLeg::Line { near, through, direction } => TriadLeg::Line {
                near: near.to_point(),
                through: point(through),
                direction: point(direction).to_vec2(),
            },
            TrackLeg::Slot { through, direction, over } => {
                TriadLeg::Slot { through: through.to_point(), direction, pin: point(over) }
            }
        })
    }

    /// The derivative of each leg's residual by the swept quantity with the link at rest.
    fn drift(&self, registers: &[Dual], own: Point, axis: Vec2) -> [f64; 3] {
        let slope = |r: Reg| registers[r.0 as usize].slope;
        let number = |r: Reg| registers[r.0 as usize].value;
        let vector = |p: RegPair, of: &dyn Fn(Reg) -> f64| Vec2::new(of(p.x), of(p.y));
        self.held.map(|h| match h {
            TrackLeg::Circle { near, far, radius } => {
                let d = own + near.rotate_by(axis) - vector(far, &number).to_point();
                -d.dot(vector(far, &slope)) / d.norm() - slope(radius)
            }
            TrackLeg::Line { near, through, direction } => {
                let d = own + near.rotate_by(axis) - vector(through, &number).to_point();
                vector(direction, &slope).cross(d)
                    - vector(direction, &number).cross(vector(through, &slope))
            }
            TrackLeg::Slot { direction, over, .. } => {
                -direction.rotate_by(axis).cross(vector(over, &slope))
            }
        })
    }

    /// Makes one guarded move of the link; returns also `true` if it was easy.
    fn move_on(&self, last: &Followed, moved: f64, registers: &[Dual]) -> Option<(Followed, bool)> {
        let legs = self.legs(registers);
        let (along, turned) = (last.slope.0 * moved, last.slope.1 * moved);
        let predicted = along.norm() / self.unit + turned.abs();
        // A prediction that turns the link by more than a radian is useless.
        if predicted.is_nan() || predicted > 1.0 {
            return None;
        }
        let (mut own, mut axis) = (last.own + along, last.axis.rotate_by(Vec2::from_angle(turned)));
        let mut corrected = 0.0;
        let mut size = f64::INFINITY;
        for _ in 0..PATIENCE {
            let rows = legs.map(|l| l.gradient(own, axis, self.unit));
            let rhs = legs.map(|l| -l.miss(own, axis));
            let (step, _) = cramer(rows, rhs);
            let turn = step[2] / self.unit;
            let before = size;
            size = (libm::hypot(step[0], step[1])) / self.unit + turn.abs();
            if !size.is_finite() || size > 1.0 {
                return None;
            }
            own = own + Vec2::new(step[0], step[1]);
            axis = axis.rotate_by(Vec2::from_angle(turn)).unit()?;
            corrected += size;
            if size < 8.0 * f64::EPSILON || (size < 1e-9 && size >= before) {
                break;
            }
        }
        let first = last.det == 0.0;
        if size > 1e-9 || (!first && corrected > SLIGHT && corrected > LEAP * predicted) {
            return None;
        }
        let rows = legs.map(|l| l.gradient(own, axis, self.unit));
        let (slope, det) = cramer(rows, self.drift(registers, own, axis).map(|d| -d));
        if !first && det * last.det <= 0.0 || !slope.iter().all(|s| s.is_finite()) {
            return None;
        }
        let slope = (Vec2::new(slope[0], slope[1]), slope[2] / self.unit);
        if !first {
            // The tangent at the new place leads back to the old one, and the determinant changes
            // little: between two assemblies that come close to each other it passes through a
            // small value, or through two zeros.
            let back = (own - slope.0 * moved - last.own).norm() / self.unit
                + (axis.divide_by(last.axis).angle() - slope.1 * moved).abs();
            let ratio = det / last.det;
            if back > SLIGHT + LEAP * predicted.max(corrected)
                || !(1.0 / STEADY..=STEADY).contains(&ratio)
            {
                return None;
            }
        }
        Some((Followed { own, axis, slope, det }, corrected < 0.1 * LEAP * predicted))
    }
}

/// The greatest number of steps of Newton's method on a fold; from a state next to it half of them
/// suffice.
const FOLD_PATIENCE: usize = 30;

impl SweepProgram {
    /// Returns the fold next to a state: the value of the swept quantity at which the legs'
    /// equations and their determinant vanish together.
    ///
    /// There the pose moves along the kernel of the legs while the driver is at rest, so that the
    /// value is exact to second order. Returns `None` if Newton's method does not converge near by,
    /// or another followed link comes before this one.
    pub fn fold(&self, track: usize, near: &FollowedState, turn: TurnFunction) -> Option<f64> {
        let t = &self.tracks[track];
        if track > 0 {
            return None;
        }
        let registers = |x: f64| {
            let (cos, sin, per_value) = turn(x);
            let mut registers = self.inputs(x, cos, sin, per_value);
            self.derive_steps(0..t.step, &mut registers);
            registers
        };
        let scale = if self.angular { 1.0 } else { t.unit };
        let place = |q: [f64; 4]| {
            (Point::new(q[0] * t.unit, q[1] * t.unit), Vec2::from_angle(q[2]), q[3] * scale)
        };
        let det = |q: [f64; 4]| {
            let (own, axis, x) = place(q);
            let rows = t.legs(&registers(x)).map(|l| l.gradient(own, axis, t.unit));
            cramer(rows, [0.0; 3]).1
        };
        let f = &near.links[track];
        let mut q = [f.own.x / t.unit, f.own.y / t.unit, f.axis.angle(), near.value / scale];
        for _ in 0..FOLD_PATIENCE {
            let (own, axis, x) = place(q);
            let known = registers(x);
            let legs = t.legs(&known);
            let drift = t.drift(&known, own, axis);
            let mut matrix = nalgebra::Matrix4::zeros();
            let mut rhs = nalgebra::Vector4::zeros();
            for i in 0..3 {
                let g = legs[i].gradient(own, axis, t.unit);
                for k in 0..3 {
                    matrix[(i, k)] = g[k];
                }
                matrix[(i, 3)] = drift[i] * scale / t.unit;
                rhs[i] = -legs[i].miss(own, axis) / t.unit;
            }
            // Central differences: their error slows the last steps, it does not move the fold.
            const STEP: f64 = 1.0 / 65_536.0;
            for k in 0..4 {
                let (mut hi, mut lo) = (q, q);
                hi[k] += STEP;
                lo[k] -= STEP;
                matrix[(3, k)] = (det(hi) - det(lo)) * (0.5 / STEP);
            }
            rhs[3] = -det(q);
            let step = matrix.lu().solve(&rhs)?;
            let size = step.amax();
            if !size.is_finite() || size > 0.1 {
                return None;
            }
            for k in 0..4 {
                q[k] += step[k];
            }
            if size < 4.0 * f64::EPSILON {
                break;
            }
        }
        let x = q[3] * scale;
        ((x - near.value).abs() < 1e-4 * scale).then_some(x)
    }
}
