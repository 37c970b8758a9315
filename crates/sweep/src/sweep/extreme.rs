//! What a driver's whole motion comes to: extreme positions of the outputs, strokes, time ratios, Grashof's type.
//!
//! An output is a link pinned to ground, or a pin or slider that runs along a straight guide on ground, and is not driven
//! itself. Its extremes are the zeros of its rate, located by Newton's method on the rate with the acceleration as
//! derivative, the driver running at unit speed. Where it stands still the mechanism is in a dead centre if it is driven from there.

use super::chunks::{Rows, run_parts, run_program};
use super::compile::outputs;
use super::follow::Follower;
use super::follow::extremes::Walk;
use super::limit::{Event, Probe, Range, range};
use super::program::Program;
use super::station::{Stations, angle_per_value, position_now};
use super::{Placed, Width};
use crate::diag::{Diagnostic, Faults, both};
use crate::mechanism::{Core, Demand, Leg, Mechanism};
use crate::scene::{Angle, Given, GuideId, GuidePath, LinkId, Place, PointId, PositionSlot, Scene};
use std::f64::consts::TAU;

/// What moves at the other end of the mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Output {
    /// A link that turns about a pivot on ground: its angle (rad).
    Turning(LinkId),
    /// What runs along a straight guide on ground: its coordinate from the guide's start (m).
    Sliding(GuideId),
}

/// An extreme position of an output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extreme {
    /// Position of the driver (rad or m).
    pub driver: f64,
    /// Position of the output (rad or m); angles run on without jumps.
    pub output: f64,
    /// Whether it is one because the driver itself goes no farther.
    pub at_limit: bool,
}

/// An output over the whole motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Swing {
    /// Which.
    pub output: Output,
    /// Its extremes in the order of the driver's positions.
    pub extremes: Vec<Extreme>,
    /// From the lowest to the highest position (rad or m); `None` where it turns fully.
    pub stroke: Option<f64>,
    /// The crank angle of the slower of two strokes over that of the faster one; where a full turn has just two extremes.
    pub time_ratio: Option<f64>,
}

/// The smallest transmission angle of a group.
#[derive(Clone, Debug, PartialEq)]
pub struct Transmission {
    /// Its links.
    pub links: Vec<LinkId>,
    /// The pin at which they meet, if it is one.
    pub pin: Option<PointId>,
    /// The angle (rad, at most 90°).
    pub angle: f64,
    /// Where it is.
    pub driver: f64,
}

/// The type of a four-bar by Grashof's rule, as seen from its driver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grashof {
    /// The driver turns fully, the output swings.
    CrankRocker,
    /// The driver swings, the output could turn fully.
    RockerCrank,
    /// Both turn fully (drag link).
    DoubleCrank,
    /// The coupler turns fully, both others swing.
    DoubleRocker,
    /// No link turns fully: shortest and longest together are longer than the two others.
    TripleRocker,
    /// Shortest and longest together are as long as the two others: it comes into line.
    ChangePoint,
}

/// Everything about the motion as a whole.
#[derive(Clone, Debug, PartialEq)]
pub struct Limits {
    /// How far the driver goes.
    pub range: Range,
    /// The outputs.
    pub swings: Vec<Swing>,
    /// The smallest transmission angle of each group with a closed form that has one.
    pub transmission: Vec<Transmission>,
    /// The type of a four-bar with its lengths: driver, coupler, output, frame (m).
    pub grashof: Option<(Grashof, [f64; 4])>,
    /// After how many turns of a driver that turns fully everything stands as it did: one, or what rolls needs more; 0: never.
    pub turns: u64,
    /// The turns that were looked through for extremes: those, or one where they are too many.
    pub seen: u64,
}

/// Most turns whose extremes are listed.
pub(super) const MOST_TURNS: u64 = 12;

/// Samples over the whole motion, between which a rate changes its sign at most once.
const SAMPLES: usize = 720;

/// A position or rate that is smaller than this part of the largest is zero.
const ROUNDING: f64 = 1e-12;

/// An angle of 90° to what rounding leaves of its sine.
const SQUARE: f64 = std::f64::consts::FRAC_PI_2 - 1e-7;

/// The limits of a scene for one of its drivers; the others stand.
///
/// # Errors
/// A scene that cannot be placed; a driver that the scene does not have.
pub fn limits(scene: &Scene, mechanism: &Mechanism, driver: usize) -> Result<Limits, Faults> {
    let scene = &posed(at_unit_speed(scene, driver)?, mechanism, driver);
    let placed = placed(scene, mechanism)?;
    let found = outputs_of(scene, mechanism, driver);
    if scene.has_laws(driver) {
        return Ok(walked(&placed, driver, &found));
    }
    let program = match outputs(scene, mechanism, &placed.at, driver, &found) {
        Ok(program) => program,
        // A group without a compiled form, or one that lies on it.
        Err(_) => return Ok(walked(&placed, driver, &found)),
    };
    let range = range(program.clone(), &placed, driver);
    let turning = range.full() && program.angular;
    let seen = if turning { turns_seen(program.turns) } else { 1 };
    let span = if turning { [range.now, range.now + TAU * seen as f64] } else { range.bounds() };
    let swings = swings(&program, &placed, driver, &found, &range, span);
    let probe = Probe::of(program.clone(), &placed, driver);
    let joints = program.joints.iter().zip(probe.transmission(span[0], span[1]));
    let transmission = joints
        // A lever is pushed squarely everywhere.
        .filter(|(_, (at, angle))| at.is_finite() && *angle < SQUARE)
        .map(|(j, (at, angle))| Transmission { links: j.links.clone(), pin: j.pin, angle, driver: at })
        .collect();
    let grashof = grashof(&placed, driver);
    let turns = if turning { program.turns } else { 1 };
    Ok(Limits { range, swings, transmission, grashof, turns, seen })
}

/// Where a driver ends downward and upward, the others standing; `None` where nothing stops it.
///
/// # Errors
/// Those of [`limits`].
pub fn ends(scene: &Scene, driver: usize) -> Result<[Option<f64>; 2], Faults> {
    let mechanism = Mechanism::new(scene)?.value;
    Ok(limits(scene, &mechanism, driver)?.range.ends.map(|end| end.map(|event| event.value)))
}

/// The turns that are looked through of a motion that comes again after so many.
pub(super) fn turns_seen(turns: u64) -> u64 {
    if (1..=MOST_TURNS).contains(&turns) { turns } else { 1 }
}

/// The scene with one driver running at unit speed, so that rates are derivatives by its position; the others stand.
fn at_unit_speed(scene: &Scene, driver: usize) -> Result<Scene, Faults> {
    let mut scene = scene.clone();
    let Some(d) = scene.drivers.get_mut(driver) else {
        return Err(Diagnostic::error("no-driver", both!("the scene has no driver {}", "机构文件没有第 {} 个原动件", driver + 1)).into());
    };
    (d.rate.value, d.acceleration) = (1.0, None);
    for (_, d) in scene.drivers.iter_mut().enumerate().filter(|(i, _)| *i != driver) {
        (d.rate.value, d.acceleration) = (0.0, None);
    }
    Ok(scene)
}

/// The scene with its driver at some position where it can be assembled, where nothing in the scene says at which: the whole motion
/// is looked through from there. The scene itself where there is none, or where it is told.
fn posed(scene: Scene, mechanism: &Mechanism, driver: usize) -> Scene {
    let silent = |f: &Faults| f.list.iter().all(|d| d.code == "driver-without-position");
    if placed(&scene, mechanism).err().is_none_or(|faults| !silent(&faults)) {
        return scene;
    }
    // A slider or a cylinder goes no farther than all lengths together.
    let lengths = scene.lengths.iter().map(|l| l.value.value);
    let coordinates = scene.points.iter().filter_map(|p| match &p.place {
        Place::At([x, y]) => Some(libm::hypot(x.value, y.value)),
        Place::InLink { .. } | Place::Polar { .. } | Place::Unknown => None,
    });
    let reach = lengths.chain(coordinates).sum::<f64>();
    let span = scene.drivers[driver].span;
    let given = |value: f64| Given { value, radius: 0.0, text: format!("{value:?} m"), span };
    let at = |part: f64| {
        let mut scene = scene.clone();
        match scene.drivers[driver].kind.slot() {
            PositionSlot::Angle(angle) => {
                let degrees = 360.0 * part;
                *angle = Some(Given { value: Angle::Deg(degrees), radius: 0.0, text: format!("{degrees:?} deg"), span });
            }
            PositionSlot::Coordinate(position) => *position = Some(given(reach * part)),
            PositionSlot::Distance(length) => *length = Some(given(reach * part.abs())),
        }
        scene
    };
    let parts = (1..=STARTS).flat_map(|k| [1.0, -1.0].map(|sign| sign * k as f64 / STARTS as f64 * 0.5));
    parts.map(at).find(|s| placed(s, mechanism).is_ok()).unwrap_or(scene)
}

/// Positions at each side of zero that are tried as a start: 5° of a turn.
const STARTS: usize = 36;

/// All of a scene placed.
fn placed<'a>(scene: &'a Scene, mechanism: &'a Mechanism) -> Result<Placed<'a>, Faults> {
    let none = Demand { groups: vec![None; mechanism.groups.len()], level: Default::default(), needs: Vec::new() };
    let demand = none.with_all_positions();
    let at = crate::position::configure(scene, mechanism, &demand)?.value;
    Ok(Placed { scene, mechanism, demand, at })
}

/// The same limits without a compiled program, for comparison.
#[cfg(test)]
pub(super) fn limits_walked(scene: &Scene, mechanism: &Mechanism, driver: usize) -> Result<Limits, Faults> {
    let scene = &at_unit_speed(scene, driver)?;
    let placed = placed(scene, mechanism)?;
    Ok(walked(&placed, driver, &outputs_of(scene, mechanism, driver)))
}

/// The same for a mechanism that is followed: no transmission angle and no change point is looked for.
fn walked(placed: &Placed, driver: usize, found: &[Output]) -> Limits {
    let now = position_now(placed.scene, &placed.at, driver);
    let follower = Follower::new(placed.scene, placed.mechanism, &placed.demand, &placed.at, driver);
    let walk = Walk::new(placed, driver, &follower, now);
    let (range, [low, high]) = (walk.range(), walk.span());
    let samples = SAMPLES * walk.turns() as usize;
    let stations = Stations::slid(low, high, samples, angle_per_value(placed.scene, &placed.at, driver));
    let swing_of = |output: &Output| {
        let samples: Vec<Option<[f64; 3]>> = stations.values.iter().map(|x| walk.at(*x, *output)).collect();
        let column = |level: usize| samples.iter().map(|s| s.map_or(f64::NAN, |s| s[level])).collect();
        let lost = samples.iter().enumerate().filter(|(_, s)| s.is_none());
        let missing = lost.map(|(i, _)| (i, Faults::default())).collect();
        let rows = Rows { columns: vec![column(0), column(1), column(2)], missing, open: Vec::new() };
        swing(*output, 0, &rows, &stations, (&range, walk.period()), &|x| walk.at(x, *output))
    };
    let swings = found.iter().map(swing_of).collect();
    let (turns, seen) = if range.full() { (walk.returns(), walk.turns()) } else { (1, 1) };
    Limits { range, swings, transmission: Vec::new(), grashof: grashof(placed, driver), turns, seen }
}

fn outputs_of(scene: &Scene, m: &Mechanism, driver: usize) -> Vec<Output> {
    let ground = &scene.links[scene.ground.0].points;
    let driven = |l: LinkId| scene.drivers.iter().any(|d| d.kind.turned() == Some((l, scene.ground)));
    let mut out = Vec::new();
    for l in (0..scene.links.len()).map(LinkId) {
        let pivoted = scene.links[l.0].points.iter().any(|p| ground.contains(p));
        if l != scene.ground && pivoted && !driven(l) && !m.is_passive(l) && m.group_of_link[l.0].is_some() {
            out.push(Output::Turning(l));
        }
    }
    for (i, g) in scene.guides.iter().enumerate() {
        let mine = scene.drivers[driver].kind.guide() == Some(GuideId(i));
        if g.on == scene.ground && matches!(g.path, GuidePath::Line { .. }) && !mine {
            out.push(Output::Sliding(GuideId(i)));
        }
    }
    out
}

/// Columns of an output in the program: position, rate, acceleration.
fn column(rows: &Rows, output: usize, level: usize) -> &[f64] {
    &rows.columns[3 * output + level]
}

fn swings(program: &Program, placed: &Placed, driver: usize, found: &[Output], range: &Range, [low, high]: [f64; 2]) -> Vec<Swing> {
    let per_value = angle_per_value(placed.scene, &placed.at, driver);
    let (parts, stations) = {
        let turns = if program.angular { ((high - low) / TAU - 1e-9).ceil().max(1.0) } else { 1.0 };
        let stations = Stations::slid(low, high, (SAMPLES as f64 * turns * program.finer()) as usize, per_value);
        (super::branches(program.clone(), placed, driver, &stations).0, stations)
    };
    let rows = run_parts(&parts, placed, driver, &stations, Width::Widest);
    let at = |x: f64, output: usize| -> Option<[f64; 3]> {
        let one = Stations::of_values(vec![x], per_value);
        // The branch is that of the nearest sample.
        let nearest = (0..stations.len()).min_by(|&a, &b| (stations.values[a] - x).abs().total_cmp(&(stations.values[b] - x).abs()))?;
        let part = parts.iter().find(|(_, rows)| rows.contains(&nearest))?;
        let rows = run_program(&part.0, placed, driver, &one, Width::One);
        rows.missing.is_empty().then(|| [0, 1, 2].map(|l| column(&rows, output, l)[0]))
    };
    let period = program.period().filter(|period| range.full() && (high - low - period).abs() < 1e-9);
    found.iter().enumerate().map(|(k, output)| swing(*output, k, &rows, &stations, (range, period), &|x| at(x, k))).collect()
}

/// `period`: that after which the first station comes again, where the stations are all of it.
fn swing(
    output: Output,
    k: usize,
    rows: &Rows,
    stations: &Stations,
    (range, period): (&Range, Option<f64>),
    at: &dyn Fn(f64) -> Option<[f64; 3]>,
) -> Swing {
    let (s, v) = (column(rows, k, 0), column(rows, k, 1));
    let there = |i: usize| !rows.missing.contains_key(&i) && s[i].is_finite() && v[i].is_finite();
    // Angles run on without jumps.
    let mut position = s.to_vec();
    if matches!(output, Output::Turning(_)) {
        for i in 1..position.len() {
            if there(i) && there(i - 1) {
                position[i] -= libm::rint((position[i] - position[i - 1]) / TAU) * TAU;
            }
        }
    }
    // A position in the same turn as the sample beside it.
    let near = |here: f64, i: usize| match output {
        Output::Turning(_) => here - libm::rint((here - position[i]) / TAU) * TAU,
        Output::Sliding(_) => here,
    };
    let x = &stations.values;
    let rounding = ROUNDING * (0..v.len()).filter(|&i| there(i)).map(|i| v[i].abs()).fold(0.0, f64::max);
    // Samples with a rate; one that meets a zero is passed over. After a full turn the first comes again.
    let mut moving: Vec<(f64, usize)> = (0..x.len()).filter(|&i| there(i) && v[i].abs() > rounding).map(|i| (x[i], i)).collect();
    if let (Some(period), Some(&(first, i))) = (period, moving.first()) {
        moving.push((first + period, i));
    }
    let mut extremes: Vec<Extreme> = Vec::new();
    for pair in moving.windows(2) {
        let ((a, i), (b, k)) = (pair[0], pair[1]);
        // A row that is missing in between parts the motion.
        let joined = k < i || (i..=k).all(there);
        if joined && (v[i] > 0.0) != (v[k] > 0.0) {
            let driver = zero(a, b, v[i], at);
            let Some([here, ..]) = at(driver) else { continue };
            extremes.push(Extreme { driver, output: near(here, i), at_limit: false });
        }
    }
    let known: Vec<usize> = (0..x.len()).filter(|&i| there(i)).collect();
    let time_ratio = match (&extremes[..], period) {
        ([a, b], Some(TAU)) => {
            let first = (b.driver - a.driver).rem_euclid(TAU);
            Some(first.max(TAU - first) / first.min(TAU - first))
        }
        _ => None,
    };
    if !range.full() {
        let way = range.bounds()[1] - range.bounds()[0];
        for ((event, end), inward) in range.ends.iter().zip([known.first(), known.last()]).zip([way, -way]) {
            if let (Some(event), Some(&i)) = (event, end) {
                let there = at_limit(event.value, inward, &|x| Some(near(at(x)?[0], i))).unwrap_or(position[i]);
                extremes.push(Extreme { driver: event.value, output: there, at_limit: true });
            }
        }
    }
    // What is zero but for the rounding of the positions it comes from is zero.
    let most = known.iter().map(|&i| position[i].abs()).fold(0.0, f64::max);
    extremes.iter_mut().filter(|e| e.output.abs() < ROUNDING * most).for_each(|e| e.output = 0.0);
    extremes.sort_by(|a, b| a.driver.total_cmp(&b.driver));
    let least = extremes.iter().map(|e| e.output).fold(f64::INFINITY, f64::min);
    let most = extremes.iter().map(|e| e.output).fold(f64::NEG_INFINITY, f64::max);
    Swing { output, stroke: (most >= least).then_some(most - least), extremes, time_ratio }
}

/// A position at a limit of the driver, where the two branches meet: near it the position is a smooth function of the root of the
/// distance from it. The polynomial through a few places on the way `inward` is taken back to the limit itself.
fn at_limit(limit: f64, inward: f64, at: &dyn Fn(f64) -> Option<f64>) -> Option<f64> {
    // At six places within this part of the whole way, what the polynomial leaves out is 1e-14 of the travel.
    const NEAR: f64 = 1e-4;
    const PLACES: [(f64, f64); 6] = [(1.0, 6.0), (2.0, -15.0), (3.0, 20.0), (4.0, -15.0), (5.0, 6.0), (6.0, -1.0)];
    let place = |root: f64| at(limit + inward * NEAR * root * root / 36.0);
    PLACES.iter().map(|(root, weight)| Some(weight * place(*root)?)).sum()
}

/// A zero of a rate between two positions: Newton's method with the acceleration, kept between the bounds.
fn zero(a: f64, b: f64, rate_at_a: f64, at: &dyn Fn(f64) -> Option<[f64; 3]>) -> f64 {
    let (mut inside, mut outside) = (a, b);
    let mut x = 0.5 * (a + b);
    for _ in 0..100 {
        let Some([_, v, acceleration]) = at(x) else { return x };
        if (v > 0.0) == (rate_at_a > 0.0) && v != 0.0 {
            inside = x;
        } else {
            outside = x;
        }
        let newton = x - v / acceleration;
        let within = (newton - inside) * (newton - outside) <= 0.0;
        let next = if within { newton } else { 0.5 * (inside + outside) };
        if next == x || (next - x).abs() <= 2.0 * f64::EPSILON * x.abs() {
            return next;
        }
        x = next;
    }
    x
}

/// The type of a four-bar: a crank on ground, a bar from it, and a bar from ground that meet in one pin.
fn grashof(placed: &Placed, driver: usize) -> Option<(Grashof, [f64; 4])> {
    let (scene, m) = (placed.scene, placed.mechanism);
    let (crank, against) = scene.drivers[driver].kind.turned()?;
    let moving = scene.links.len() - 1;
    let dyad = m.groups.iter().find_map(|g| match &g.core {
        Core::Pin { pin, legs } => {
            let bar = |leg: &Leg| leg.hold()?.bar().map(|(link, _, far)| (link, far));
            let [a, b] = &legs[..] else { return None };
            Some((*pin, [bar(a)?, bar(b)?]))
        }
        Core::Link { .. } | Core::Higher => None,
    })?;
    if against != scene.ground || moving != 3 {
        return None;
    }
    let (pin, bars) = dyad;
    let on_ground = |p: PointId| scene.links[scene.ground.0].points.contains(&p);
    let (coupler, output) = match (on_ground(bars[0].1), on_ground(bars[1].1)) {
        (false, true) => (bars[0], bars[1]),
        (true, false) => (bars[1], bars[0]),
        _ => return None,
    };
    let pivot = *scene.links[crank.0].points.iter().find(|p| on_ground(**p))?;
    let length = |l: LinkId, a: PointId, b: PointId| Some(placed.at.shapes.local(l, a)?.distance(placed.at.shapes.local(l, b)?));
    let lengths = [
        length(crank, pivot, coupler.1)?,
        length(coupler.0, coupler.1, pin)?,
        length(output.0, output.1, pin)?,
        length(scene.ground, pivot, output.1)?,
    ];
    Some((grashof_of(lengths), lengths))
}

/// The type of a four-bar of these lengths: driver, coupler, output, frame.
pub fn grashof_of(lengths: [f64; 4]) -> Grashof {
    let shortest = (0..4).fold(0, |best, k| if lengths[k] < lengths[best] { k } else { best });
    let (least, most) = (lengths[shortest], lengths.iter().copied().fold(0.0, f64::max));
    let excess = 2.0 * (least + most) - lengths.iter().sum::<f64>();
    // What a person writes is equal to ten digits: a sum that differs by rounding is none.
    if excess.abs() <= 1e-12 * most {
        Grashof::ChangePoint
    } else if excess > 0.0 {
        Grashof::TripleRocker
    } else {
        [Grashof::CrankRocker, Grashof::DoubleRocker, Grashof::RockerCrank, Grashof::DoubleCrank][shortest]
    }
}

impl Limits {
    /// The limits of the driver and its change points.
    pub fn events(&self) -> impl Iterator<Item = &Event> {
        self.range.ends.iter().flatten().chain(&self.range.changes)
    }
}
