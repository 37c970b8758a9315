//! Check that a pair opened because it only repeats others ([`crate::mechanism::Redundant`]) holds
//! by itself as a virtual constraint.
//!
//! One pose is never sufficient: a third crank half as long holds in the drawn pose, and to first
//! order about it. The driver is therefore moved to four finite positions, by Newton's method on
//! the pairs that stay closed, and at each position the deviation of the opened pair is computed in
//! double-double balls, so that a zero is proved. A pair with a deviation within the error bound is
//! a virtual constraint. One with a deviation within that of lengths rounded for print is *almost*
//! virtual, and is accepted with a warning. Any other pair locks the mechanism.

use super::assemble::Assembly;
use super::coupled::Aside;
use super::equations::{self, FormMeasure};
use super::finish::complete;
use super::newton::{self, DriverValues, System};
use super::repeats::reason;
pub use super::repeats::{RepeatReason, opened_words};
use super::{Configuration, configure, recompute};
use crate::mechanism::{
    Core, Demand, GraphNode, Group, Level, Mechanism, Need, Opened, PairItem, constraints_of,
};
use hodograph_base::diag::{Both, Diagnostic, Faults};
use hodograph_base::linear::LinearSystem;
use hodograph_base::number::{Ball, Dd, Real};
use hodograph_scene::{LinkId, PointId, Scene};

/// The result of the check of an opened pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RedundancyVerdict {
    /// The pair holds by itself.
    Virtual,
    /// The pair would hold with slightly different lengths.
    Almost,
    /// The pair holds to first order only: the mechanism shakes and does not move.
    Shaky,
    /// The pair locks the mechanism.
    Locked,
}

/// An opened pair, checked in several positions.
#[derive(Clone, Debug, PartialEq)]
pub struct Checked {
    /// The opened pair.
    pub opened: Opened,
    /// The result.
    pub verdict: RedundancyVerdict,
    /// The largest deviation (m), including that in the pose itself.
    pub off_m: f64,
    /// The driver that moves the pair, if there is one.
    pub driver: Option<usize>,
    /// Amount by which the driver is moved at the largest deviation (rad or m); 0 in the pose
    /// itself.
    pub moved: f64,
    /// The error bound of the deviations (m), if proved.
    pub bound_m: Option<f64>,
    /// Number of positions in which the pair is checked.
    pub positions: usize,
    /// The reason why it holds.
    pub reason: RepeatReason,
}

impl Checked {
    /// Returns a description of the pair in words.
    pub fn what(&self, scene: &Scene) -> Both {
        super::repeats::opened_words(scene, &self.opened).0
    }

    /// Returns the diagnostic about the pair.
    pub fn diagnostic(&self, scene: &Scene, m: &Mechanism) -> Diagnostic {
        super::repeats::diagnostic(scene, m, self)
    }
}

/// Relative error of lengths rounded to four digits, as printed in books; a greater deviation is
/// intended.
const ALMOST: f64 = 5e-4;

/// Rounding of `f64` positions, relative to the size of the mechanism, with some fifty operations
/// each.
const ROUNDING: f64 = 1e-13;

/// Angles by which a rotary driver is moved (rad): large enough that an error of a hundredth in a
/// length shows ten times more than [`ALMOST`], and different, so that a pair does not hold in all
/// of them by accident.
const TURNS: [f64; 4] = [0.8, -0.8, 0.35, -0.35];

/// Displacement of a sliding driver for each radian, as a part of the mechanism's size.
const SLIDE: f64 = 0.2;

/// Greatest number of times that the range of the driver is halved until it contains no limit.
const HALVINGS: i32 = 6;

/// One step of the motion (rad): Newton's method converges from the last position.
const STEP: f64 = 0.04;

/// Number of unknowns above which deviations are computed without a proof: an interval matrix of
/// them takes seconds.
const MOST_PROVED: usize = 150;

/// Returns the opened pairs of a mechanism that hold, each checked in several positions; of gears
/// with a distance kept by other pairs, only those that keep it approximately.
///
/// # Errors
/// The errors of [`configure`] for the links that take part; `locked` and `shaky` for a pair that
/// is no repetition.
pub fn check(scene: &Scene, m: &Mechanism) -> Result<Vec<Checked>, Faults> {
    let mut faults = Faults::default();
    let mut all = Vec::new();
    let touching = m.kept_apart(scene).map(Opened::Guide);
    for opened in m.redundant.iter().map(|r| r.opened.clone()).chain(touching) {
        let checked = look(scene, m, &opened)?;
        match checked.verdict {
            RedundancyVerdict::Virtual if !m.is_opened(&opened) => {}
            RedundancyVerdict::Virtual | RedundancyVerdict::Almost => all.push(checked),
            RedundancyVerdict::Shaky | RedundancyVerdict::Locked => {
                faults.push(checked.diagnostic(scene, m))
            }
        }
    }
    if faults.has_errors() { Err(faults) } else { Ok(all) }
}

/// Returns the checks of [`check`] as notes and warnings.
///
/// # Errors
/// As [`check`].
pub fn told(scene: &Scene, m: &Mechanism) -> Result<Vec<Diagnostic>, Faults> {
    Ok(check(scene, m)?.iter().map(|c| c.diagnostic(scene, m)).collect())
}

/// Checks one opened pair; a pair that does not hold is no error here.
///
/// # Errors
/// The errors of [`configure`].
pub fn look(scene: &Scene, m: &Mechanism, opened: &Opened) -> Result<Checked, Faults> {
    let demand = demand(scene, m, opened);
    let at = configure(scene, m, &demand)?.value;
    let way = OpenedMotion::new(scene, m, &at);
    let unit = way.unit();
    let mut stations: Vec<(f64, Configuration)> = vec![(0.0, at.clone())];
    for turn in TURNS {
        let halved = (0..=HALVINGS).map(|k| turn * unit * libm::exp2(-f64::from(k)));
        stations.extend(halved.into_iter().find_map(|by| Some((by, way.to(by)?))));
    }
    let size = size(scene, &at, opened).unwrap_or_else(|| at.extent());
    let proofs = proved(scene, m, &demand, &at, way.driver, &stations, opened);
    let rounding = ROUNDING * at.extent();
    let (mut off_m, mut moved, mut bound_m, mut holds) =
        (0.0, 0.0, proofs.as_ref().map(|_| 0.0), true);
    for (i, (by, there)) in stations.iter().enumerate() {
        let plain = off(scene, m, opened, there, &at).into_iter().map(|x| (x, rounding));
        let balls = proofs.as_ref().map(|p| p[i].clone());
        for (x, radius) in balls.unwrap_or_else(|| plain.collect()) {
            holds &= x.abs() <= radius;
            if x.abs() > off_m {
                (off_m, moved) = (x.abs(), *by);
            }
            bound_m = bound_m.map(|b: f64| b.max(radius));
        }
    }
    let verdict = match holds {
        true => RedundancyVerdict::Virtual,
        false if off_m <= ALMOST * size => RedundancyVerdict::Almost,
        false if way.holds_to_first_order(opened, size) => RedundancyVerdict::Shaky,
        false => RedundancyVerdict::Locked,
    };
    let reason = reason(scene, m, opened, &at, ALMOST);
    let opened = opened.clone();
    Ok(Checked {
        opened,
        verdict,
        off_m,
        driver: way.driver,
        moved,
        bound_m,
        positions: stations.len(),
        reason,
    })
}

/// Checks an opened pair by links and pairs alone, if lengths are missing: a planet between the
/// wheels of another planet of the same arm repeats it, for any sizes, and three links joined by
/// three pins are rigid.
pub fn by_topology(scene: &Scene, m: &Mechanism, opened: &Opened) -> Option<Checked> {
    let (verdict, reason) = match super::repeats::by_topology(scene, m, opened)? {
        reason @ RepeatReason::Triangle(_) => (RedundancyVerdict::Locked, reason),
        reason @ (RepeatReason::ParallelCranks(_)
        | RepeatReason::ParallelGuides(_)
        | RepeatReason::CoaxialPins(..)
        | RepeatReason::SameCircle(..)
        | RepeatReason::SameLine(..)
        | RepeatReason::RepeatedPlanets(_)
        | RepeatReason::OneNormal
        | RepeatReason::Found) => (RedundancyVerdict::Virtual, reason),
    };
    let opened = opened.clone();
    Some(Checked {
        opened,
        verdict,
        off_m: 0.0,
        driver: None,
        moved: 0.0,
        bound_m: None,
        positions: 0,
        reason,
    })
}

/// Returns the demand of all positions that the check of a pair needs.
fn demand(scene: &Scene, m: &Mechanism, opened: &Opened) -> Demand {
    let mut demand = Demand::of_questions(scene, m, []);
    let needs = match opened {
        Opened::Link(l) => {
            own_pins(scene, m, *l).into_iter().map(|p| Need::Point(p, None)).collect()
        }
        Opened::Guide(g) => {
            let guide = &scene.guides[g.0];
            let links =
                [Some(guide.on), guide.slider].into_iter().flatten().filter(|l| *l != scene.ground);
            guide
                .pin
                .map(|p| Need::Point(p, None))
                .into_iter()
                .chain(links.map(Need::Turning))
                .collect::<Vec<_>>()
        }
        Opened::Pin(p, l) => vec![Need::Point(*p, None), Need::Turning(*l)],
        Opened::Rolling(r) => {
            let pair = &scene.rolling[r.0];
            let links = pair.links.into_iter().filter(|l| *l != scene.ground).map(Need::Turning);
            links
                .chain(pair.centres().into_iter().flatten().map(|p| Need::Point(p, None)))
                .collect()
        }
    };
    for need in needs {
        demand.add(scene, m, need, Level::Position);
    }
    demand
}

fn own_pins(scene: &Scene, m: &Mechanism, l: LinkId) -> Vec<PointId> {
    scene.links[l.0].points.iter().copied().filter(|p| m.pins.contains(p)).collect()
}

/// Returns the reference length of a deviation (m): the length of an opened link.
fn size(scene: &Scene, at: &Configuration, opened: &Opened) -> Option<f64> {
    let Opened::Link(l) = opened else { return None };
    let points = &scene.links[l.0].points;
    let local = |p: &PointId| at.shapes.local(*l, *p);
    let pairs =
        points.iter().enumerate().flat_map(|(i, a)| points[..i].iter().map(move |b| (a, b)));
    let lengths = pairs.filter_map(|(a, b)| Some(local(a)?.distance(local(b)?)));
    lengths.reduce(f64::max).filter(|l| *l > 0.0)
}

/// Returns the deviation of an opened pair (m) in the configuration `at`; `then` is the pose at the
/// instant, from which directions are measured.
fn off<N: Real>(
    scene: &Scene,
    m: &Mechanism,
    opened: &Opened,
    at: &Configuration<N>,
    then: &Configuration<N>,
) -> Vec<N> {
    let mut out = Vec::new();
    let follows = |n: GraphNode| matches!(n, GraphNode::Link(l) if m.passive[l.0].is_some());
    let demanded = |item: PairItem, out: &mut Vec<N>| {
        for c in constraints_of(scene, item).filter(|c| !follows(c.ends().0)) {
            let given = equations::kept(c.form(), &(scene, then));
            match given.and_then(|given| equations::off(c.form(), given, &(scene, at))) {
                Some(FormMeasure::Apart(d)) => out.extend([d.x, d.y]),
                Some(FormMeasure::Length(off)) => out.push(off),
                Some(FormMeasure::Angle(off)) => out.push(off * N::from_f64(at.approx().extent())),
                None => {}
            }
        }
    };
    match opened {
        Opened::Link(l) => {
            let pins = own_pins(scene, m, *l);
            for (i, &a) in pins.iter().enumerate() {
                for &b in &pins[..i] {
                    if let (Some(pa), Some(pb)) = (at.points[a.0], at.points[b.0])
                        && let (Some(la), Some(lb)) =
                            (at.shapes.local(*l, a), at.shapes.local(*l, b))
                    {
                        out.push(pa.distance(pb) - la.distance(lb));
                    }
                }
            }
        }
        Opened::Guide(g) => demanded(PairItem::Guide(*g), &mut out),
        Opened::Pin(p, l) => demanded(PairItem::Pin(*p, *l), &mut out),
        Opened::Rolling(r) => {
            out.extend(super::rolling::slipped_m(scene, &at.approx(), *r).map(N::from_f64))
        }
    }
    out
}

/// The motion of the opened mechanism by a driver.
struct OpenedMotion<'a> {
    scene: &'a Scene,
    m: &'a Mechanism,
    at: &'a Configuration,
    /// The driver that moves the checked pair; `None` if there is none.
    driver: Option<usize>,
    held: DriverValues,
}

impl<'a> OpenedMotion<'a> {
    fn new(scene: &'a Scene, m: &'a Mechanism, at: &'a Configuration) -> OpenedMotion<'a> {
        let placed = newton::placed(m, at);
        let forms =
            placed.iter().flat_map(|g| &m.groups[*g].constraints).map(|c| m.constraints[*c].form());
        let driver = forms.filter_map(|form| form.driver()).min();
        OpenedMotion { scene, m, at, driver, held: newton::driver_values(scene, at) }
    }

    /// Returns the displacement of the driver for each radian of a rotary one.
    fn unit(&self) -> f64 {
        match self.driver.map(|d| self.scene.drivers[d].kind.turns()) {
            Some(false) => SLIDE * self.at.extent(),
            Some(true) | None => 1.0,
        }
    }

    /// Returns the configuration after the driver has moved; `None` beyond a limit or a change
    /// point, where another assembly may be reached.
    fn to(&self, by: f64) -> Option<Configuration> {
        let driver = self.driver?;
        let steps = libm::ceil(by.abs() / (STEP * self.unit())).max(1.0);
        let mut at = self.at.clone();
        let sense = self.sense(&at)?;
        for k in 1..=steps as usize {
            let mut drivers = self.held.clone();
            drivers.0[driver] += by * k as f64 / steps;
            at = newton::moved(self.scene, self.m, &at, &drivers)?;
            if self.sense(&at)? != sense {
                return None;
            }
        }
        Some(at)
    }

    /// Returns the sign of the determinant of the equations: it changes at a limit or a change
    /// point of the mechanism.
    fn sense(&self, at: &Configuration) -> Option<bool> {
        let system =
            System::new(self.scene, self.m, &self.at.shapes, at, &newton::placed(self.m, at));
        let held = newton::driver_values(self.scene, at);
        let there = (at.poses.clone(), at.points.clone());
        let d = LinearSystem::new(system.jacobian(&there, &held)?).determinant();
        (d.is_finite() && d != 0.0).then_some(d > 0.0)
    }

    /// Returns true if the pair holds in the pose and its deviation is of higher than first order
    /// in a small motion.
    fn holds_to_first_order(&self, opened: &Opened, size: f64) -> bool {
        const SMALL: f64 = 1e-3;
        let off = |c: &Configuration| off(self.scene, self.m, opened, c, self.at);
        let small = |x: f64| x.abs() <= 1e-6 * size;
        let sides = [SMALL, -SMALL].map(|s| self.to(s * self.unit()));
        let [Some(on), Some(back)] = sides else { return false };
        let slopes = off(&on).into_iter().zip(off(&back)).map(|(a, b)| (a - b) / (2.0 * SMALL));
        off(self.at).into_iter().all(small) && slopes.into_iter().all(small)
    }
}

/// Returns the deviation of the pair in each position, with its proved bound; `None` if one of them
/// is not proved.
fn proved(
    scene: &Scene,
    m: &Mechanism,
    demand: &Demand,
    at: &Configuration,
    driver: Option<usize>,
    stations: &[(f64, Configuration)],
    opened: &Opened,
) -> Option<Vec<Vec<(f64, f64)>>> {
    // The rolling of a pair is recorded in `f64`.
    if matches!(opened, Opened::Rolling(_)) {
        return None;
    }
    type N = Ball<Dd>;
    let now = recompute::<N>(scene, m, demand, at).ok()?;
    let mut assembly = Assembly::<N>::new(scene, m, demand, Some(at));
    assembly.instant = Some(&now);
    assembly.guides.clone_from(&now.shapes.guides);
    let groups = newton::placed(m, at);
    let of = |g: &usize| &m.groups[*g];
    let whole = Group {
        links: groups.iter().flat_map(|g| of(g).links.clone()).collect(),
        pins: groups.iter().flat_map(|g| of(g).pins.clone()).collect(),
        core: Core::Higher,
        upstream: Vec::new(),
        constraints: groups.iter().flat_map(|g| of(g).constraints.clone()).collect(),
    };
    if 3 * whole.links.len() + 2 * whole.pins.len() > MOST_PROVED {
        return None;
    }
    let one = |(by, there): &(f64, Configuration)| {
        let bounded = |list: Vec<N>| -> Option<Vec<(f64, f64)>> {
            list.iter()
                .all(|x| x.is_decided())
                .then(|| list.into_iter().map(|x| (x.approx(), x.radius())).collect())
        };
        let Some(driver) = driver.filter(|_| *by != 0.0) else {
            return bounded(off(scene, m, opened, &now, &now));
        };
        let trial = assembly.coupled_aside(&whole, there, Some(Aside { driver, by: *by })).ok()?;
        let (mut poses, mut points) =
            (vec![None; scene.links.len()], vec![None; scene.points.len()]);
        trial.poses.into_iter().for_each(|(l, pose)| poses[l.0] = Some(pose));
        trial.points.into_iter().for_each(|(p, at)| points[p.0] = Some(at));
        let there =
            complete(scene, m, now.shapes.clone(), (poses, points), now.closures.clone(), &[]);
        bounded(off(scene, m, opened, &there, &now))
    };
    stations.iter().map(one).collect()
}
