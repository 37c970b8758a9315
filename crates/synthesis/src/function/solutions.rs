//! The linkages of a function: exactly through as many pairs as there are unknowns, by inversion,
//! by least squares, by the Remez exchange; a parallelogram where both links rotate alike.

use super::freudenstein::{Generator, Steps, exact, least_squares, linear, minimax};
use super::{Function, FunctionTarget, chebyshev};
use crate::body::pose::centre;
use hodograph_base::diag::{Both, both};
use hodograph_base::geom::{Point, Vec2};
use std::f64::consts::PI;

/// The greatest ratio of two links.
const MOST: f64 = 100.0;
/// Angles that differ by less than this (rad) are equal.
const ALIKE: f64 = 1e-12;
/// The starting angle of a parallelogram if none is given (rad), and its frame over its crank.
const USUAL_START: f64 = PI / 3.0;
const USUAL_RATIO: f64 = 2.0;
/// Factors of the output's swing from which least squares of the angles begin.
const DRAWN_TOGETHER: [f64; 8] = [1.0, 0.99, 0.97, 0.95, 0.9, 0.8, 1.03, 1.1];

impl Function {
    /// The solutions with their descriptions.
    pub(super) fn generators(&self) -> Result<Vec<(Both, Generator)>, Both> {
        if self.minimax {
            return self.best();
        }
        if let Some(found) = self.parallelogram() {
            return Ok(vec![found]);
        }
        let free = self.start.iter().filter(|s| s.is_none()).count();
        if let (2, [Some(alpha), Some(phi)], Some(a), Some(d)) =
            (self.steps.len(), self.start, self.crank, self.frame)
        {
            return self.two([alpha, phi], d / a);
        }
        if let (3, [Some(alpha), None], Some(a), Some(d)) =
            (self.steps.len(), self.start, self.crank, self.frame)
        {
            return self.inverted(alpha, a / d);
        }
        if self.steps.len() == 3 + free {
            let all = exact(self.start, &self.steps);
            let (all, far): (Vec<Generator>, Vec<Generator>) = all.into_iter().partition(bounded);
            if all.is_empty() && !far.is_empty() {
                return Err(both!(
                    "only linkages whose links differ more than {MOST} times in length pass through these {} pairs",
                    self.steps.len()
                ));
            }
            if all.is_empty() {
                return Err(both!("no four-bar passes through these {} pairs", self.steps.len()));
            }
            let count = all.len();
            let named = |(k, g)| {
                (if count == 1 { both!("the only solution") } else { both!("root {}", k + 1) }, g)
            };
            return Ok(all.into_iter().enumerate().map(named).collect());
        }
        self.by_squares()
    }

    /// More pairs than unknowns: linear least squares for K, then least squares of the angles.
    fn by_squares(&self) -> Result<Vec<(Both, Generator)>, Both> {
        let free = self.start.map(|s| s.is_none());
        let grid = |given: Option<f64>| {
            given.map_or_else(|| (0..24).map(|k| PI * k as f64 / 24.0).collect(), |a| vec![a])
        };
        let sum = |g: &Generator| {
            self.steps.iter().map(|s| g.deviation(*s).map(|d| d * d)).sum::<Option<f64>>()
        };
        // Where the linear solution does not close at a pair, a slightly reduced swing gives one
        // that closes; least squares of the angles start from it.
        let mut linear_best: Option<(f64, Generator)> = None;
        let mut best: Option<(f64, Generator)> = None;
        let keep = |kept: &mut Option<(f64, Generator)>, g: Generator| {
            let s = sum(&g).filter(|_| bounded(&g));
            if let Some(s) = s.filter(|s| kept.is_none_or(|k| *s < k.0)) {
                *kept = Some((s, g));
            }
        };
        for alpha in grid(self.start[0]) {
            for phi in grid(self.start[1]) {
                for share in DRAWN_TOGETHER {
                    let Some(g) = linear([alpha, phi], &self.drawn_together(share))
                        .filter(|g| g.lengths().is_some())
                    else {
                        continue;
                    };
                    if share == 1.0 {
                        keep(&mut linear_best, g);
                    }
                    keep(&mut best, g);
                }
            }
        }
        let Some((_, first)) = best else {
            return Err(both!("least squares leave no four-bar that closes at all pairs"));
        };
        let mut all = Vec::new();
        if let (Some((_, g)), [false, false]) = (linear_best, free) {
            all.push((both!("least squares of Freudenstein's equation"), g));
        }
        all.extend(
            least_squares(first, free, &self.steps)
                .map(|g| (both!("least squares of the output angles"), g)),
        );
        Ok(all)
    }

    /// The pairs with the output angles scaled by a factor about their mean.
    fn drawn_together(&self, share: f64) -> Steps {
        let middle = self.steps.iter().map(|s| s[1]).sum::<f64>() / self.steps.len() as f64;
        self.steps.iter().map(|[t, p]| [*t, middle + share * (p - middle)]).collect()
    }

    /// C₁ is the centre of the circle through B₁ and the others, turned back about D by the output
    /// angles.
    fn inverted(&self, alpha: f64, a: f64) -> Result<Vec<(Both, Generator)>, Both> {
        let d = Point::new(1.0, 0.0);
        let back = |s: &[f64; 2]| {
            d + ((Vec2::from_angle(alpha + s[0]) * a).to_point() - d)
                .rotate_by(Vec2::from_angle(-s[1]))
        };
        let b: Vec<Point> = self.steps.iter().map(back).collect();
        let Some((c, _)) = centre(b[0], b[1], b[2]) else {
            return Err(both!(
                "B1 and the turned-back B2, B3 lie in line: C would be infinitely far"
            ));
        };
        let (reach, b_len) = (c.distance(d), c.distance(b[0]));
        let k = [
            1.0 / a,
            1.0 / reach,
            (a * a - b_len * b_len + reach * reach + 1.0) / (2.0 * a * reach),
        ];
        Ok(vec![(
            both!("C1 by inversion about D"),
            Generator { start: [alpha, (c - d).angle()], k },
        )])
    }

    /// The best approximation, starting from the five Chebyshev points.
    fn best(&self) -> Result<Vec<(Both, Generator)>, Both> {
        let FunctionTarget::Curve { range, .. } = &self.target else { return Ok(Vec::new()) };
        let steps: Steps = chebyshev(range[0], range[1], 5)
            .into_iter()
            .filter_map(|x| self.target.step(x))
            .collect();
        let step_of = |x: f64| self.target.step(x);
        let roots = exact([None, None], &steps);
        let found: Vec<_> = roots.iter().filter_map(|g| minimax(*g, *range, &step_of)).collect();
        if found.is_empty() {
            return Err(both!(
                "no linkage through five Chebyshev points has six alternating deviations to start from"
            ));
        }
        Ok(found
            .into_iter()
            .map(|(g, ..)| (both!("least greatest deviation"), g.upright()))
            .collect())
    }

    /// A parallelogram with any cranks, where input and output rotate alike from the same
    /// direction.
    fn parallelogram(&self) -> Option<(Both, Generator)> {
        let alike = self.steps.iter().all(|[t, p]| (t - p).abs() < ALIKE);
        let start = match self.start {
            [Some(alpha), Some(phi)] if libm::sin((alpha - phi) / 2.0).abs() > ALIKE => {
                return None;
            }
            [Some(start), _] | [None, Some(start)] => start,
            [None, None] => USUAL_START,
        };
        let ratio = match (self.frame, self.crank) {
            (Some(d), Some(a)) => d / a,
            _ => USUAL_RATIO,
        };
        let which = both!("parallelogram: the two turn alike with cranks of any length");
        alike.then_some((which, Generator { start: [start; 2], k: [ratio, ratio, 1.0] }))
    }

    /// Two pairs, crank and frame given: K₂ and K₃ remain, from two linear equations.
    fn two(&self, [alpha, phi]: [f64; 2], k1: f64) -> Result<Vec<(Both, Generator)>, Both> {
        let [one, other] = [0, 1].map(|k| {
            let (t, p) = (alpha + self.steps[k][0], phi + self.steps[k][1]);
            (libm::cos(t), libm::cos(t - p) - k1 * libm::cos(p))
        });
        // −K₂ cos θ + K₃ = cos(θ − ψ) − K₁ cos ψ, twice.
        let k2 = (other.1 - one.1) / (one.0 - other.0);
        let g = Generator { start: [alpha, phi], k: [k1, k2, one.1 + k2 * one.0] };
        if !(g.k.iter().all(|k| k.is_finite()) && bounded(&g)) {
            return Err(both!(
                "C would be infinitely far: the bisector of B1B2' is parallel to the follower's direction"
            ));
        }
        Ok(vec![(both!("C1 on the bisector of B1 B2' and on the follower's direction"), g)])
    }
}

/// True if no link is more than [`MOST`] times another: beyond, the solution is a root at infinity,
/// cut off by rounding.
fn bounded(g: &Generator) -> bool {
    let Some([a, b, c]) = g.lengths().map(|l| l.map(f64::abs)) else { return true };
    let all = [a, b, c, 1.0];
    all.iter().copied().fold(0.0, f64::max)
        <= MOST * all.iter().copied().fold(f64::INFINITY, f64::min)
}
