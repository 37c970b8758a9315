//! Trains of rolling pairs: the ratios that relate the angles of links.
//!
//! Rolling and locking are linear in the angles. Two circles keep ρ₁(φ₁ − β) + ρ₂(φ₂ − β) (β: the
//! line of centres), a straight track keeps s + ρ(φ₂ − φ₁), a slider keeps its angle relative to
//! its guide. Within a group elimination therefore finds the angles from the known ones, an arm and
//! its planets at once: each is a [`Combination`] of independent angles. Numbers of teeth are
//! whole, so the ratios are fractions of whole numbers, and the angle of a link after a thousand
//! turns is known to the last digit.

use hodograph_mechanism::mechanism::{Mechanism, PairForm};
use hodograph_mechanism::position::Configuration;
use hodograph_scene::{LinkId, PointId, Relation, RollingId, Scene};

/// A ratio of angles: a fraction of whole numbers where it is one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct AngleRatio {
    /// The value of the ratio.
    pub value: f64,
    /// Numerator and denominator, the latter positive, without a common factor.
    pub exact: Option<(i64, i64)>,
}

/// The greatest denominator of a fraction that a ratio of radii is taken for: within the rounding
/// of the radii hardly any other number is so near to one.
const MOST_DENOMINATOR: i64 = 100_000;

/// The size, relative to 1, below which a number is the rounding of zero.
const ZERO: f64 = 1e-12;

impl AngleRatio {
    pub const ONE: AngleRatio = AngleRatio { value: 1.0, exact: Some((1, 1)) };

    /// Returns the fraction p/q.
    pub fn of(p: i64, q: i64) -> AngleRatio {
        let g = gcd(p, q).max(1) * if q < 0 { -1 } else { 1 };
        AngleRatio { value: p as f64 / q as f64, exact: (q != 0).then_some((p / g, q / g)) }
    }

    /// Returns a number that comes from lengths, as the fraction that it equals within their
    /// rounding, if there is one.
    pub fn near(value: f64) -> AngleRatio {
        // The convergents of its continued fraction.
        let (mut a, mut b) = ((0i64, 1i64), (1i64, 0i64));
        let mut rest = value.abs();
        while rest.is_finite() && rest < 1e9 {
            let whole = libm::floor(rest) as i64;
            let next = (
                whole.saturating_mul(b.0).saturating_add(a.0),
                whole.saturating_mul(b.1).saturating_add(a.1),
            );
            if next.1 > MOST_DENOMINATOR {
                break;
            }
            (a, b) = (b, next);
            if (value.abs() - b.0 as f64 / b.1 as f64).abs() <= 4.0 * f64::EPSILON * value.abs() {
                return AngleRatio::of(if value < 0.0 { -b.0 } else { b.0 }, b.1);
            }
            rest = 1.0 / (rest - whole as f64);
        }
        AngleRatio { value, exact: None }
    }

    pub fn plus(self, o: AngleRatio) -> AngleRatio {
        let exact = self.exact.zip(o.exact).and_then(|((a, b), (c, d))| {
            fraction(a.checked_mul(d)?.checked_add(c.checked_mul(b)?)?, b.checked_mul(d)?)
        });
        AngleRatio::with(exact, self.value + o.value)
    }

    pub fn times(self, o: AngleRatio) -> AngleRatio {
        let exact = self
            .exact
            .zip(o.exact)
            .and_then(|((a, b), (c, d))| fraction(a.checked_mul(c)?, b.checked_mul(d)?));
        AngleRatio::with(exact, self.value * o.value)
    }

    fn over(self, o: AngleRatio) -> AngleRatio {
        let exact = self
            .exact
            .zip(o.exact)
            .and_then(|((a, b), (c, d))| fraction(a.checked_mul(d)?, b.checked_mul(c)?));
        AngleRatio::with(exact, self.value / o.value)
    }

    pub fn negative(self) -> AngleRatio {
        AngleRatio { value: -self.value, exact: self.exact.map(|(p, q)| (-p, q)) }
    }

    fn with(exact: Option<(i64, i64)>, value: f64) -> AngleRatio {
        exact.map_or(AngleRatio { value, exact: None }, |(p, q)| AngleRatio::of(p, q))
    }

    pub fn is_zero(self) -> bool {
        self.exact.map_or(self.value.abs() < ZERO, |(p, _)| p == 0)
    }
}

fn fraction(p: i64, q: i64) -> Option<(i64, i64)> {
    (q != 0).then_some((p, q))
}

fn gcd(a: i64, b: i64) -> i64 {
    let (mut a, mut b) = (a.unsigned_abs(), b.unsigned_abs());
    while b != 0 {
        (a, b) = (b, a % b);
    }
    i64::try_from(a).unwrap_or(1)
}

/// The turns after which both of two recurring states recur, from the turns of each; 0 if never.
pub(super) fn together(a: u64, b: u64) -> u64 {
    if a == 0 || b == 0 {
        return 0;
    }
    let g = gcd(a as i64, b as i64).max(1) as u64;
    // A recurrence after more turns than this counts as none.
    (a / g).checked_mul(b).filter(|n| *n < 1 << 40).unwrap_or(0)
}

/// An independent angle or distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum AngleSource {
    /// A turning driver.
    Driver(usize),
    /// A link that is no part of a train.
    Link(LinkId),
    /// The line from one point to another.
    Line(PointId, PointId),
    /// The travel of a wheel along its track (m).
    Way(RollingId),
}

/// The rotation of a link since the instant, as a sum of factors times independent angles.
pub(super) type Combination = Vec<(AngleSource, AngleRatio)>;

/// The links of a mechanism with angles that follow from others.
#[derive(Clone, Debug, Default)]
pub(super) struct AngleTrain {
    /// The rotation of each link; `None` for one whose angle follows from its position.
    links: Vec<Option<Combination>>,
}

/// An angle in the equations of a group.
enum TrainAngle {
    Unknown(usize),
    Known(Combination),
}

/// One equation of a group: factors of its links' angles, and their sum.
struct TrainEquation {
    factors: Vec<AngleRatio>,
    sum: Combination,
}

impl AngleTrain {
    /// Finds all angles that follow from rolling, locking and driving.
    pub fn of(scene: &Scene, m: &Mechanism, at: &Configuration) -> AngleTrain {
        let mut train = AngleTrain { links: vec![None; scene.links.len()] };
        if scene.rolling.is_empty() {
            return train;
        }
        train.links[scene.ground.0] = Some(Vec::new());
        for (g, group) in m.groups.iter().enumerate() {
            let equations: Vec<TrainEquation> = group
                .constraints
                .iter()
                .filter_map(|&c| train.equation(scene, m, at, g, m.constraints[c].form()))
                .collect();
            for (link, found) in group.links.iter().zip(solved(equations, group.links.len())) {
                train.links[link.0] = found;
            }
        }
        train
    }

    /// Returns the rotation of a link, if it follows from others.
    pub fn of_link(&self, l: LinkId) -> Option<&Combination> {
        self.links.get(l.0)?.as_ref()
    }

    /// Returns the rotation of any link; that of a link outside a train is its own.
    pub fn turned(&self, l: LinkId) -> Combination {
        self.of_link(l).cloned().unwrap_or_else(|| vec![(AngleSource::Link(l), AngleRatio::ONE)])
    }

    /// Returns the turns of a driver after which the angles of all links recur; 0 if they never do.
    /// Links outside a train recur with every turn.
    pub fn turns(&self) -> u64 {
        let all = self
            .links
            .iter()
            .flatten()
            .flatten()
            .filter(|(s, _)| !matches!(s, AngleSource::Way(_)));
        all.map(|(_, ratio)| ratio.exact.map_or(0, |(_, q)| q as u64)).fold(1, together)
    }

    /// Returns the greatest ratio of a wheel's angular velocity to that of its source; at least 1.
    pub fn fastest(&self) -> f64 {
        let all = self
            .links
            .iter()
            .flatten()
            .flatten()
            .filter(|(s, _)| !matches!(s, AngleSource::Way(_)));
        all.map(|(_, ratio)| ratio.value.abs()).fold(1.0, f64::max)
    }

    fn seen(&self, m: &Mechanism, g: usize, l: LinkId) -> TrainAngle {
        match m.groups[g].links.iter().position(|k| *k == l) {
            Some(i) => TrainAngle::Unknown(i),
            None => TrainAngle::Known(self.turned(l)),
        }
    }

    fn equation(
        &self,
        scene: &Scene,
        m: &Mechanism,
        at: &Configuration,
        g: usize,
        form: PairForm,
    ) -> Option<TrainEquation> {
        let mut e = TrainEquation {
            factors: vec![AngleRatio::of(0, 1); m.groups[g].links.len()],
            sum: Vec::new(),
        };
        match form {
            PairForm::Angles { of, against, driver } => {
                e.add(self.seen(m, g, of), AngleRatio::ONE);
                e.add(self.seen(m, g, against), AngleRatio::of(-1, 1));
                if let Some(d) = driver {
                    e.add(
                        TrainAngle::Known(vec![(AngleSource::Driver(d), AngleRatio::of(-1, 1))]),
                        AngleRatio::ONE,
                    );
                }
            }
            PairForm::Related { pair: r, links: [a, b] } => {
                let pair = &scene.rolling[r.0];
                let [ra, rb] = at.shapes.rolling[r.0];
                match pair.relation() {
                    Relation::Turnings(centres) => {
                        let k = match pair.teeth() {
                            Some([za, zb]) => AngleRatio::of(
                                i64::from(za) * if ra * rb < 0.0 { -1 } else { 1 },
                                i64::from(zb),
                            ),
                            None => AngleRatio::near(ra / rb),
                        };
                        e.circles(
                            self.seen(m, g, a),
                            self.seen(m, g, b),
                            self.line(scene, m, g, centres)?,
                            k,
                        );
                    }
                    Relation::Slide { centre, .. } => {
                        let placed = |p: PointId| m.group_of_pin[p.0] != Some(g);
                        // A track or a centre that belongs to the group itself gets its position
                        // from this pair.
                        if m.groups[g].links.contains(&a) || !placed(centre) {
                            return None;
                        }
                        e.add(self.seen(m, g, b), AngleRatio::ONE);
                        e.add(self.seen(m, g, a), AngleRatio::of(-1, 1));
                        e.add(
                            TrainAngle::Known(vec![(
                                AngleSource::Way(r),
                                AngleRatio { value: 1.0 / rb, exact: None },
                            )]),
                            AngleRatio::ONE,
                        );
                    }
                }
            }
            PairForm::Meet { .. }
            | PairForm::OnPath { .. }
            | PairForm::AlongPath { .. }
            | PairForm::Distance { .. } => return None,
        }
        Some(e)
    }

    /// The line of two centres: that of a link which carries both, else of two known points.
    fn line(
        &self,
        scene: &Scene,
        m: &Mechanism,
        g: usize,
        [a, b]: [PointId; 2],
    ) -> Option<TrainAngle> {
        let both = |l: &LinkId| {
            scene.links[l.0].points.contains(&a)
                && scene.links[l.0].points.contains(&b)
                && !m.is_passive(*l)
        };
        let carriers = || (0..scene.links.len()).map(LinkId).filter(both);
        let mine = |l: &LinkId| m.groups[g].links.contains(l);
        if let Some(l) =
            carriers().find(|l| self.of_link(*l).is_some()).or_else(|| carriers().find(mine))
        {
            return Some(self.seen(m, g, l));
        }
        let known = |p: PointId| m.group_of_pin[p.0] != Some(g);
        (known(a) && known(b))
            .then(|| TrainAngle::Known(vec![(AngleSource::Line(a, b), AngleRatio::ONE)]))
    }
}

impl TrainEquation {
    /// Adds k (φ₁ − β) + (φ₂ − β), with k the ratio of the first circle to the second.
    fn circles(&mut self, first: TrainAngle, second: TrainAngle, line: TrainAngle, k: AngleRatio) {
        self.add(first, k);
        self.add(second, AngleRatio::ONE);
        self.add(line, k.plus(AngleRatio::ONE).negative());
    }

    /// Adds an angle with its factor to the side of the unknowns.
    fn add(&mut self, angle: TrainAngle, factor: AngleRatio) {
        match angle {
            TrainAngle::Unknown(i) => self.factors[i] = self.factors[i].plus(factor),
            TrainAngle::Known(known) => add(&mut self.sum, &known, factor.negative()),
        }
    }

    fn less(&mut self, other: &TrainEquation, times: AngleRatio) {
        let times = times.negative();
        for (a, b) in self.factors.iter_mut().zip(&other.factors) {
            *a = a.plus(b.times(times));
        }
        add(&mut self.sum, &other.sum, times);
    }
}

/// Adds a combination times a factor.
pub(super) fn add(to: &mut Combination, other: &Combination, factor: AngleRatio) {
    for (source, ratio) in other {
        let more = ratio.times(factor);
        match to.iter_mut().find(|(s, _)| s == source) {
            Some((_, sum)) => *sum = sum.plus(more),
            None => to.push((*source, more)),
        }
    }
    to.retain(|(_, ratio)| !ratio.is_zero());
}

/// The unknowns that the equations determine, by elimination.
fn solved(mut equations: Vec<TrainEquation>, unknowns: usize) -> Vec<Option<Combination>> {
    let mut of = vec![None; unknowns];
    let mut done = 0;
    for (column, of) in of.iter_mut().enumerate() {
        let best = (done..equations.len()).max_by(|&a, &b| {
            let size = |i: usize| equations[i].factors[column].value.abs();
            size(a).total_cmp(&size(b))
        });
        let Some(pivot) = best.filter(|&i| !equations[i].factors[column].is_zero()) else {
            continue;
        };
        equations.swap(done, pivot);
        let factor = AngleRatio::ONE.over(equations[done].factors[column]);
        let row = {
            let r = &mut equations[done];
            r.factors.iter_mut().for_each(|f| *f = f.times(factor));
            r.sum.iter_mut().for_each(|(_, f)| *f = f.times(factor));
            TrainEquation { factors: r.factors.clone(), sum: r.sum.clone() }
        };
        for (i, other) in equations.iter_mut().enumerate() {
            let times = other.factors[column];
            if i != done && !times.is_zero() {
                other.less(&row, times);
            }
        }
        *of = Some(done);
        done += 1;
    }
    let alone = |row: usize, column: usize| {
        equations[row].factors.iter().enumerate().all(|(i, f)| i == column || f.is_zero())
    };
    of.iter()
        .enumerate()
        .map(|(column, row)| row.filter(|r| alone(*r, column)).map(|r| equations[r].sum.clone()))
        .collect()
}
