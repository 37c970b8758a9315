//! The whole motion of a driver: extreme positions of the outputs, strokes, time ratios, Grashof's
//! type.
//!
//! An output is a link pinned to ground, or a pin or slider on a straight guide on ground, that is
//! not driven itself. Its extremes are the zeros of its rate ([`swing`](super::swing)) with the
//! driver running at unit speed. Where the output has no velocity, the mechanism is in a dead
//! centre if it is driven from there.

use super::chunks::{SweepRows, run_parts, run_program};
use super::compile::outputs;
use super::follow::PoseFollower;
use super::follow::extremes::TravelWalk;
use super::limit::{DriverRange, Event, Probe, range};
use super::program::SweepProgram;
use super::station::{Stations, angle_per_value, position_now};
use super::swing::{DriverSamples, swing};
use super::{PlacedScene, TravelEnds, Width};
use hodograph_base::cam::CamMotion;
use hodograph_base::diag::{Diagnostic, Faults, both};
use hodograph_mechanism::mechanism::{Core, Demand, Leg, Mechanism};
use hodograph_scene::cams::TurningCam;
use hodograph_scene::{
    Angle, GivenQuantity, GuideId, GuidePath, LinkId, PointId, PointPlace, PositionSlot, Scene,
};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// The output at the other end of the mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DrivenOutput {
    /// A link that turns about a pivot on ground: its angle (rad).
    Turning(LinkId),
    /// A point or slider on a straight guide on ground: its coordinate from the guide's start (m).
    Sliding(GuideId),
}

/// An extreme position of an output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutputExtreme {
    /// The position of the driver (rad or m).
    pub driver: f64,
    /// The driver's position at the end of a dwell, if the output dwells there; `driver` is then
    /// its beginning.
    pub until: Option<f64>,
    /// The position of the output (rad or m); angles are continuous.
    pub output: f64,
    /// True if the output is extreme because the driver itself is at a limit.
    pub at_limit: bool,
}

/// The extremes and the stroke of an output over the whole motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Swing {
    /// The output.
    pub output: DrivenOutput,
    /// Its extremes in the order of the driver's positions.
    pub extremes: Vec<OutputExtreme>,
    /// The difference of the lowest and the highest position (rad or m); `None` if the output turns
    /// fully or the driver has no end.
    pub stroke: Option<f64>,
    /// The crank angle of the slower of two strokes divided by that of the faster one, without the
    /// dwells between them; only where a full turn has exactly two extremes.
    pub time_ratio: Option<f64>,
}

/// The smallest transmission angle of a group.
#[derive(Clone, Debug, PartialEq)]
pub struct GroupTransmission {
    /// The links of the group.
    pub links: Vec<LinkId>,
    /// The pin at which they meet, if it is a pin.
    pub pin: Option<PointId>,
    /// The angle (rad, at most 90°).
    pub angle: f64,
    /// The driver's position there (rad or m).
    pub driver: f64,
}

/// The type of a four-bar by Grashof's rule, seen from its driver.
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
    /// No link turns fully: the sum of the shortest and the longest is greater than that of the two
    /// others.
    TripleRocker,
    /// The shortest and the longest together are as long as the two others: the links come into
    /// line.
    ChangePoint,
}

/// The limits, outputs and type of the whole motion.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionLimits {
    /// The range of the driver.
    pub range: DriverRange,
    /// The outputs.
    pub swings: Vec<Swing>,
    /// The smallest transmission angle of each group with a closed form that has one.
    pub transmission: Vec<GroupTransmission>,
    /// The type of a four-bar with its lengths: driver, coupler, output, frame (m).
    pub grashof: Option<(Grashof, [f64; 4])>,
    /// The number of turns of a fully turning driver after which the pose recurs: 1; more with
    /// rolling links, or where a joint meets an odd number of change points in a turn; 0 if it
    /// never recurs.
    pub turns: u64,
    /// The number of turns searched for extremes: `turns`, or 1 if they are too many.
    pub seen: u64,
}

/// The greatest number of turns whose extremes are listed.
pub(super) const MOST_TURNS: u64 = 12;

/// The number of samples over the whole motion, between which a rate changes its sign at most once.
const SAMPLES: usize = 720;

/// An angle of 90° within the rounding of its sine.
const SQUARE: f64 = std::f64::consts::FRAC_PI_2 - 1e-7;

/// Returns the limits of a scene for one of its drivers; the others are at rest.
///
/// # Errors
/// A scene that cannot be placed; a driver that the scene does not have.
pub fn limits(scene: &Scene, mechanism: &Mechanism, driver: usize) -> Result<MotionLimits, Faults> {
    let scene = &posed(at_unit_speed(scene, driver)?, mechanism, driver);
    let placed = placed(scene, mechanism)?;
    let found = outputs_of(scene, mechanism, driver);
    if scene.has_laws(driver) {
        return Ok(walked(&placed, driver, &found));
    }
    let program = match outputs(scene, mechanism, &placed.at, driver, &found) {
        Ok(program) => program,
        // A group without a compiled form, or a group connected to one.
        Err(_) => return Ok(walked(&placed, driver, &found)),
    };
    let range = range(program.clone(), &placed, driver);
    let turning = range.full() && program.angular;
    // After twice as many turns every joint is back on its branch.
    let turns = if turning { program.turns * if range.flipped() { 2 } else { 1 } } else { 1 };
    let seen = if turning { turns_seen(turns) } else { 1 };
    let span = if turning { [range.now, range.now + TAU * seen as f64] } else { range.bounds() };
    let period = (turning && seen == turns).then_some(TAU * seen as f64);
    let swings = swings(&program, &placed, driver, &found, &range, (span, period));
    let probe = Probe::of(program.clone(), &placed, driver);
    let joints = program.joints.iter().zip(probe.transmission(span[0], span[1]));
    let transmission = joints
        // A lever has a transmission angle of 90° everywhere.
        .filter(|(_, (at, angle))| at.is_finite() && *angle < SQUARE)
        .map(|(j, (at, angle))| GroupTransmission {
            links: j.links.clone(),
            pin: j.pin,
            angle,
            driver: at,
        })
        .collect();
    let grashof = grashof(&placed, driver);
    Ok(MotionLimits { range, swings, transmission, grashof, turns, seen })
}

/// Returns the lower and upper end of a driver's travel, the others at rest; `None` where nothing
/// stops it.
///
/// # Errors
/// The errors of [`limits`].
pub fn ends(scene: &Scene, driver: usize) -> Result<[Option<f64>; 2], Faults> {
    let mechanism = Mechanism::new(scene)?.value;
    Ok(limits(scene, &mechanism, driver)?.range.ends.map(|end| end.map(|event| event.value)))
}

/// The turns to search of a motion whose pose recurs after `turns`.
pub(super) fn turns_seen(turns: u64) -> u64 {
    if (1..=MOST_TURNS).contains(&turns) { turns } else { 1 }
}

/// The scene with one driver running at unit speed, so that rates are derivatives by its position;
/// the others are at rest.
fn at_unit_speed(scene: &Scene, driver: usize) -> Result<Scene, Faults> {
    let mut scene = scene.clone();
    let Some(d) = scene.drivers.get_mut(driver) else {
        return Err(Diagnostic::error(
            "no-driver",
            both!("the scene has no driver {}", driver + 1),
        )
        .into());
    };
    (d.rate.value, d.acceleration) = (1.0, None);
    for (_, d) in scene.drivers.iter_mut().enumerate().filter(|(i, _)| *i != driver) {
        (d.rate.value, d.acceleration) = (0.0, None);
    }
    Ok(scene)
}

/// The scene with its driver at a position where it can be assembled, if the scene gives the driver
/// no position: the whole motion is searched from there. Returns the scene unchanged if it gives a
/// position, or if it can be assembled nowhere.
fn posed(scene: Scene, mechanism: &Mechanism, driver: usize) -> Scene {
    let silent = |f: &Faults| f.list.iter().all(|d| d.code == "driver-without-position");
    if placed(&scene, mechanism).err().is_none_or(|faults| !silent(&faults)) {
        return scene;
    }
    // A slider or a cylinder travels no farther than the sum of all lengths.
    let lengths = scene.lengths.iter().map(|l| l.value.value);
    let coordinates = scene.points.iter().filter_map(|p| match &p.place {
        PointPlace::At([x, y]) => Some(libm::hypot(x.value, y.value)),
        PointPlace::InLink { .. } | PointPlace::Polar { .. } | PointPlace::Unknown => None,
    });
    let reach = lengths.chain(coordinates).sum::<f64>();
    let span = scene.drivers[driver].span;
    let given =
        |value: f64| GivenQuantity { value, radius: 0.0, text: format!("{value:?} m"), span };
    let at = |part: f64| {
        let mut scene = scene.clone();
        match scene.drivers[driver].kind.slot() {
            PositionSlot::Angle(angle) => {
                let degrees = 360.0 * part;
                *angle = Some(GivenQuantity {
                    value: Angle::Deg(degrees),
                    radius: 0.0,
                    text: format!("{degrees:?} deg"),
                    span,
                });
            }
            PositionSlot::Coordinate(position) => *position = Some(given(reach * part)),
            PositionSlot::Distance(length) => *length = Some(given(reach * part.abs())),
        }
        scene
    };
    let parts =
        (1..=STARTS).flat_map(|k| [1.0, -1.0].map(|sign| sign * k as f64 / STARTS as f64 * 0.5));
    parts.map(at).find(|s| placed(s, mechanism).is_ok()).unwrap_or(scene)
}

/// The number of starting positions tried at each side of zero: 5° of a turn.
const STARTS: usize = 36;

/// Places the whole scene, all groups included.
fn placed<'a>(scene: &'a Scene, mechanism: &'a Mechanism) -> Result<PlacedScene<'a>, Faults> {
    let none = Demand {
        groups: vec![None; mechanism.groups.len()],
        level: Default::default(),
        needs: Vec::new(),
    };
    let demand = none.with_all_positions();
    let at = hodograph_mechanism::position::configure(scene, mechanism, &demand)?.value;
    Ok(PlacedScene { scene, mechanism, demand, at, ends: TravelEnds::default() })
}

/// Returns the limits without a compiled program, for comparison.
#[cfg(test)]
pub(super) fn limits_walked(
    scene: &Scene,
    mechanism: &Mechanism,
    driver: usize,
) -> Result<MotionLimits, Faults> {
    let scene = &at_unit_speed(scene, driver)?;
    let placed = placed(scene, mechanism)?;
    Ok(walked(&placed, driver, &outputs_of(scene, mechanism, driver)))
}

/// The limits of a mechanism that is followed, without transmission angles and change points.
fn walked(placed: &PlacedScene, driver: usize, found: &[DrivenOutput]) -> MotionLimits {
    let now = position_now(placed.scene, &placed.at, driver);
    let follower =
        PoseFollower::new(placed.scene, placed.mechanism, &placed.demand, &placed.at, driver);
    let walk = TravelWalk::new(placed, driver, &follower, now);
    let (range, [low, high]) = (walk.range(), walk.span());
    let samples = SAMPLES * walk.turns() as usize;
    let stations =
        Stations::slid(low, high, samples, angle_per_value(placed.scene, &placed.at, driver));
    let joints = joints(placed.scene, driver);
    // A motion is solved once for all outputs.
    let at_stations: Vec<Vec<Option<[f64; 3]>>> = stations
        .values
        .iter()
        .map(|x| {
            let motion = walk.at(*x);
            found.iter().map(|output| motion.as_ref()?.of(*output)).collect()
        })
        .collect();
    let swing_of = |(k, output): (usize, &DrivenOutput)| {
        let samples: Vec<Option<[f64; 3]>> = at_stations.iter().map(|all| all[k]).collect();
        let column = |level: usize| -> Vec<f64> {
            samples.iter().map(|s| s.map_or(f64::NAN, |s| s[level])).collect()
        };
        let lost = samples.iter().enumerate().filter(|(_, s)| s.is_none());
        let missing: BTreeMap<usize, Faults> = lost.map(|(i, _)| (i, Faults::default())).collect();
        let extent = placed.at.extent();
        let course = DriverSamples {
            stations: &stations,
            range: &range,
            extent,
            period: walk.period(),
            joints: &joints,
        };
        swing(*output, [&column(0), &column(1)], &missing, &course, &|x| walk.at(x)?.of(*output))
    };
    let swings = found.iter().enumerate().map(swing_of).collect();
    let (turns, seen) = if range.full() { (walk.returns(), walk.turns()) } else { (1, 1) };
    MotionLimits {
        range,
        swings,
        transmission: Vec::new(),
        grashof: grashof(placed, driver),
        turns,
        seen,
    }
}

fn outputs_of(scene: &Scene, m: &Mechanism, driver: usize) -> Vec<DrivenOutput> {
    let ground = &scene.links[scene.ground.0].points;
    let driven =
        |l: LinkId| scene.drivers.iter().any(|d| d.kind.turned() == Some((l, scene.ground)));
    let mut out = Vec::new();
    for l in (0..scene.links.len()).map(LinkId) {
        let pivoted = scene.links[l.0].points.iter().any(|p| ground.contains(p));
        if l != scene.ground
            && pivoted
            && !driven(l)
            && !m.is_passive(l)
            && m.group_of_link[l.0].is_some()
        {
            out.push(DrivenOutput::Turning(l));
        }
    }
    for (i, g) in scene.guides.iter().enumerate() {
        let mine = scene.drivers[driver].kind.guide() == Some(GuideId(i));
        if g.on == scene.ground && matches!(g.path, GuidePath::Line { .. }) && !mine {
            out.push(DrivenOutput::Sliding(GuideId(i)));
        }
    }
    out
}

/// The driver's positions at which cams pass from one stage or piece to the next, each with the
/// period after which it recurs (rad).
fn joints(scene: &Scene, driver: usize) -> Vec<[f64; 2]> {
    let turned = scene.cams.iter().filter_map(|c| c.disc.as_ref()).filter(|t| t.driver == driver);
    let of = |t: &TurningCam| -> Vec<[f64; 2]> {
        let angles = match &t.disc.motion {
            CamMotion::Law { program, .. } => program.joints(),
            CamMotion::Profile(_) => t.disc.stretches().into_iter().map(|(phi, _)| phi).collect(),
        };
        angles
            .into_iter()
            .map(|phi| [(t.disc.sense * phi + t.start - t.from) / t.way, TAU / t.way.abs()])
            .collect()
    };
    turned.flat_map(of).collect()
}

/// The column of an output in the program: position, rate or acceleration.
fn column(rows: &SweepRows, output: usize, level: usize) -> &[f64] {
    &rows.columns[3 * output + level]
}

fn swings(
    program: &SweepProgram,
    placed: &PlacedScene,
    driver: usize,
    found: &[DrivenOutput],
    range: &DriverRange,
    ([low, high], period): ([f64; 2], Option<f64>),
) -> Vec<Swing> {
    let per_value = angle_per_value(placed.scene, &placed.at, driver);
    let (parts, stations) = {
        let turns = if program.angular { ((high - low) / TAU - 1e-9).ceil().max(1.0) } else { 1.0 };
        let stations = Stations::slid(
            low,
            high,
            (SAMPLES as f64 * turns * program.finer()) as usize,
            per_value,
        );
        (super::branches(program.clone(), placed, driver, &stations).0, stations)
    };
    let rows = run_parts(&parts, placed, driver, &stations, Width::Widest);
    let at = |x: f64, output: usize| -> Option<[f64; 3]> {
        let one = Stations::of_values(vec![x], per_value);
        // The branch is that of the nearest sample.
        let nearest = (0..stations.len()).min_by(|&a, &b| {
            (stations.values[a] - x).abs().total_cmp(&(stations.values[b] - x).abs())
        })?;
        let part = parts.iter().find(|(_, rows)| rows.contains(&nearest))?;
        let rows = run_program(&part.0, placed, driver, &one, Width::One);
        rows.missing.is_empty().then(|| [0, 1, 2].map(|l| column(&rows, output, l)[0]))
    };
    let extent = placed.at.extent();
    let course = DriverSamples {
        stations: &stations,
        range,
        extent,
        period,
        joints: &joints(placed.scene, driver),
    };
    let of = |k: usize| [column(&rows, k, 0), column(&rows, k, 1)];
    found
        .iter()
        .enumerate()
        .map(|(k, output)| swing(*output, of(k), &rows.missing, &course, &|x| at(x, k)))
        .collect()
}

/// The type of a four-bar: a crank on ground, a bar from it, and a bar from ground that meet in one
/// pin.
fn grashof(placed: &PlacedScene, driver: usize) -> Option<(Grashof, [f64; 4])> {
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
    let length = |l: LinkId, a: PointId, b: PointId| {
        Some(placed.at.shapes.local(l, a)?.distance(placed.at.shapes.local(l, b)?))
    };
    let lengths = [
        length(crank, pivot, coupler.1)?,
        length(coupler.0, coupler.1, pin)?,
        length(output.0, output.1, pin)?,
        length(scene.ground, pivot, output.1)?,
    ];
    Some((grashof_of(lengths), lengths))
}

/// Returns the type of a four-bar of these lengths: driver, coupler, output, frame.
pub fn grashof_of(lengths: [f64; 4]) -> Grashof {
    let shortest = (0..4).fold(0, |best, k| if lengths[k] < lengths[best] { k } else { best });
    let (least, most) = (lengths[shortest], lengths.iter().copied().fold(0.0, f64::max));
    let excess = 2.0 * (least + most) - lengths.iter().sum::<f64>();
    // Lengths that a person writes agree to ten digits: a sum that differs by rounding counts as
    // equal.
    if excess.abs() <= 1e-12 * most {
        Grashof::ChangePoint
    } else if excess > 0.0 {
        Grashof::TripleRocker
    } else {
        [Grashof::CrankRocker, Grashof::DoubleRocker, Grashof::RockerCrank, Grashof::DoubleCrank]
            [shortest]
    }
}

impl MotionLimits {
    /// The limits of the driver and its change points.
    pub fn events(&self) -> impl Iterator<Item = &Event> {
        self.range.ends.iter().flatten().chain(&self.range.changes)
    }
}
