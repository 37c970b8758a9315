//! Positions of a driver in a sweep: its values, with the cosine and sine of each for a turning
//! driver.

use hodograph_base::geom::Vec2;
use hodograph_base::trig;
use hodograph_mechanism::position::{Configuration, Path, newton};
use hodograph_scene::{Angle, LinkId, PointId, Scene, Swept};
use std::f64::consts::TAU;
use std::ops::Range;

/// Values of a driver (rad or m), in order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stations {
    /// The value of each station.
    pub values: Vec<f64>,
    /// The cosine of each as an angle; for a driver along an arc, of the angle that belongs to its
    /// travel.
    pub cosines: Vec<f64>,
    /// The sine of each.
    pub sines: Vec<f64>,
}

impl Stations {
    /// Returns `steps` equal steps from one angle to another, both ends included; degrees are
    /// reduced exactly.
    pub fn turned(from: Angle, to: Angle, steps: usize) -> Stations {
        StationSteps { way: DriverSpan::Turn(from, to), steps }.all()
    }

    /// Returns given values; `angle = value·per_value` gives cosine and sine.
    pub fn of_values(values: Vec<f64>, per_value: f64) -> Stations {
        let (sines, cosines) =
            values.iter().map(|v| (libm::sin(v * per_value), libm::cos(v * per_value))).unzip();
        Stations { values, cosines, sines }
    }

    /// Returns `steps` equal steps from one length to another, both ends included.
    pub fn slid(from: f64, to: f64, steps: usize, per_value: f64) -> Stations {
        StationSteps { way: DriverSpan::Slide { from, to, per_value }, steps }.all()
    }

    /// Returns the stations of some rows.
    pub fn pick(&self, rows: &[usize]) -> Stations {
        let of = |values: &[f64]| rows.iter().map(|&i| values[i]).collect();
        Stations { values: of(&self.values), cosines: of(&self.cosines), sines: of(&self.sines) }
    }

    /// The position of a scene's driver at a station: its value. An angle beyond a turn loses the
    /// whole turns, as exactly as cosine and sine give it, unless wheels are in another position on
    /// every turn.
    pub(super) fn place(&self, i: usize, scene: &Scene, driver: usize) -> f64 {
        // With wheels between them, a turn of the driver is not a turn of a cam.
        let turned = scene.drivers[driver].kind.turns()
            && scene.rolling.is_empty()
            && self.values[i].abs() > TAU;
        if turned { libm::atan2(self.sines[i], self.cosines[i]) } else { self.values[i] }
    }

    /// Indices of the stations in the order of their values.
    pub(super) fn ascending(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.len()).collect();
        order.sort_by(|&a, &b| self.values[a].total_cmp(&self.values[b]));
        order
    }

    /// Returns the number of stations.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Returns true if there are none.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }
}

/// The range of a driver's motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DriverSpan {
    /// From one angle to another.
    Turn(Angle, Angle),
    /// From one value to another (rad or m); `angle = value·per_value` gives cosine and sine.
    Slide {
        /// The first value.
        from: f64,
        /// The last value.
        to: f64,
        /// See [`angle_per_value`].
        per_value: f64,
    },
}

/// Equal steps of a driver, both ends included; the [`Stations`] of any part of them are made where
/// they are needed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StationSteps {
    /// The range.
    pub way: DriverSpan,
    /// The number of steps; there is one station more.
    pub steps: usize,
}

impl StationSteps {
    /// Returns all stations.
    pub fn all(&self) -> Stations {
        self.part(0..self.steps + 1)
    }

    /// Returns the value of one station.
    pub fn value(&self, i: usize) -> f64 {
        match self.way {
            DriverSpan::Slide { from, to, .. } => between(from, to, i, self.steps),
            DriverSpan::Turn(from, to) => turned(from, to, i, self.steps).radians(),
        }
    }

    /// Returns some of the stations; they do not depend on how the steps are divided into parts.
    pub fn part(&self, rows: Range<usize>) -> Stations {
        self.part_in(rows, Stations::default())
    }

    /// Returns some of the stations in the memory of others.
    pub(super) fn part_in(&self, rows: Range<usize>, used: Stations) -> Stations {
        let steps = self.steps;
        match self.way {
            DriverSpan::Slide { from, to, per_value } => {
                Stations::of_values(rows.map(|i| between(from, to, i, steps)).collect(), per_value)
            }
            DriverSpan::Turn(from, to) => {
                let mut s = used;
                [&mut s.values, &mut s.cosines, &mut s.sines].into_iter().for_each(Vec::clear);
                for i in rows {
                    let angle = turned(from, to, i, steps);
                    let (sin, cos) = trig::sin_cos(angle);
                    s.values.push(angle.radians());
                    s.cosines.push(cos);
                    s.sines.push(sin);
                }
                s
            }
        }
    }
}

/// The `i`-th of `steps` equal steps between two angles, in degrees if both ends are.
fn turned(from: Angle, to: Angle, i: usize, steps: usize) -> Angle {
    match (from, to) {
        (Angle::Deg(a), Angle::Deg(b)) => Angle::Deg(between(a, b, i, steps)),
        _ => Angle::Rad(between(from.radians(), to.radians(), i, steps)),
    }
}

/// The `i`-th of `steps` equal steps; the ends are met exactly.
fn between(a: f64, b: f64, i: usize, steps: usize) -> f64 {
    match i {
        0 => a,
        i if i == steps => b,
        i => a + (b - a) * (i as f64 / steps as f64),
    }
}

/// Returns the angle of a driver's motion per unit of its value: 1 if it turns, 1/ρ along an arc, 0
/// if the motion has no angle.
pub fn angle_per_value(scene: &Scene, at: &Configuration, driver: usize) -> f64 {
    let kind = &scene.drivers[driver].kind;
    match kind.guide().and_then(|guide| at.shapes.guides[guide.0]) {
        Some(Path::Arc { radius, .. }) => 1.0 / radius,
        Some(Path::Line { .. }) => 0.0,
        None => f64::from(u8::from(kind.turns())),
    }
}

/// Returns the position of a driver at the instant (rad or m). An angle of more than a turn is
/// reduced to its part of a turn: the pose is the same, and travel from it is counted in turns of
/// the stations, not of the scene's angle. It is not reduced if wheels are in another position on
/// every turn.
pub fn position_now(scene: &Scene, at: &Configuration, driver: usize) -> f64 {
    let written = scene.drivers[driver].kind.angle().map(|angle| angle.value);
    match written.filter(|_| scene.rolling.is_empty()) {
        // The remainder of floating-point numbers is exact.
        Some(Angle::Deg(d)) if d.abs() > 360.0 => Angle::Deg(libm::fmod(d, 360.0)).radians(),
        Some(Angle::Rad(r)) if r.abs() > TAU => libm::atan2(libm::sin(r), libm::cos(r)),
        _ => driver_positions(scene, at)[driver],
    }
}

/// Returns the start of a motion from pose to pose: the driver's position at the instant (rad or
/// m), or the time (s).
pub fn now(scene: &Scene, at: &Configuration, swept: Swept) -> f64 {
    match swept {
        Swept::Driver(d) => position_now(scene, at, d),
        Swept::Time => scene.instant(),
    }
}

/// The value of each driver in a placed mechanism: its angle in the scene's count (rad; the scene's
/// own value where it is given), the coordinate along the guide, the length of the cylinder (m).
pub(super) fn driver_positions(scene: &Scene, at: &Configuration) -> Vec<f64> {
    let measured = newton::driver_values(scene, at);
    scene
        .drivers
        .iter()
        .zip(measured.0)
        .map(|(driver, measured)| {
            let of = |l: LinkId, line: Option<(PointId, PointId)>| match line {
                Some((a, b)) => Some(at.points[b.0]? - at.points[a.0]?),
                None if l == scene.ground => Some(Vec2::new(1.0, 0.0)),
                None => at.link_direction(scene, l).or(at.poses[l.0].map(|p| p.axis)),
            };
            let seen = || {
                let ((link, against), [line, against_line]) =
                    (driver.kind.turned()?, driver.kind.lines());
                Some(of(link, line)?.divide_by(of(against, against_line)?).angle())
            };
            driver
                .kind
                .position()
                .map(hodograph_scene::Position::value)
                .or_else(seen)
                .unwrap_or(measured)
        })
        .collect()
}
