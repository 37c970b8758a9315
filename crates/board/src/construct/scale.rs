//! The one door between SI and millimetres of paper: scales μ from the series 1, 2, 2.5, 5 × 10^k.

pub use crate::construction::scale::number;

use crate::plan::{Plan, Step};
use hodograph_base::geom::{Point, Vec2};
use hodograph_mechanism::position::Configuration;
use hodograph_scene::{Cam, DiagramKind, Kind, Paper, Rolling, Scene};

/// Room for each drawing, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Boxes {
    /// Width and height for the mechanism.
    pub diagram: [f64; 2],
    /// For each polygon.
    pub polygon: [f64; 2],
}

impl Default for Boxes {
    /// What lets a diagram and two polygons stand side by side on A4 across, with room for their labels. A mechanism may be
    /// as tall as wide: beside it there is room for equations.
    fn default() -> Self {
        Boxes { diagram: [130.0, 130.0], polygon: [95.0, 80.0] }
    }
}

/// A polygon with more vectors than this needs more room for their names than the usual box has.
const USUAL_VECTORS: f64 = 9.0;
/// The largest polygon, against the usual one: a sheet of A3.
const LARGEST: f64 = 2.0;
/// Parts of a fixed paper's width and height that the mechanism and each polygon may take; the rest is for captions,
/// equations and results.
const DIAGRAM_PART: [f64; 2] = [0.34, 0.38];
const POLYGON_PART: [f64; 2] = [0.25, 0.34];

impl Boxes {
    /// The room that a plan's drawings get: the usual, more for polygons of many vectors, a part of a fixed paper.
    pub fn of(paper: &Paper, plan: &Plan) -> Boxes {
        if let Some([w, h]) = paper.size_mm {
            let part = |p: [f64; 2]| [p[0] * w, p[1] * h];
            return Boxes { diagram: part(DIAGRAM_PART), polygon: part(POLYGON_PART) };
        }
        let usual = Boxes::default();
        let last = DiagramKind::of(plan.level).max(DiagramKind::Velocity);
        let vectors = plan.steps(last).iter().flat_map(|g| g.steps(0)).map(|s| match s {
            Step::Equation { chains, .. } => chains.iter().map(|c| c.known.len() + c.unknown.len()).sum(),
            Step::Image { .. } | Step::Trials { .. } | Step::Same { .. } => 1_usize,
        });
        // Names need area, and area goes with the square of the side.
        let larger = (vectors.sum::<usize>() as f64 / USUAL_VECTORS).sqrt().clamp(1.0, LARGEST);
        Boxes { polygon: usual.polygon.map(|side| side * larger), ..usual }
    }
}

/// A hollow circle that makes the figure more than so many times as large is drawn as an arc, as books do, and asks for no room.
pub const DWARFS: f64 = 2.0;

/// Width and height of a mechanism (m): of the box around its joints, the profiles of its cams and the circles of its wheels.
pub fn size(scene: &Scene, at: &Configuration) -> [f64; 2] {
    let joints = at.points.iter().flatten().copied();
    let profiles = scene.cams.iter().flat_map(|c| profile(c, at));
    let (rings, wheels): (Vec<_>, Vec<_>) = scene.rolling.iter().flat_map(|pair| circles(pair, at)).partition(|c| c.2);
    let corners = |(centre, r, _): &(Point, f64, bool)| [*centre + Vec2::new(*r, *r), *centre - Vec2::new(*r, *r)];
    let mut places: Vec<Point> = joints.chain(profiles).chain(wheels.iter().flat_map(corners)).collect();
    let [w, h] = extent(places.iter().copied());
    places.extend(rings.iter().filter(|(_, r, _)| 2.0 * r <= DWARFS * w.max(h)).flat_map(corners));
    extent(places.into_iter())
}

/// The circles of a rolling pair: centre, radius, and whether it is hollow.
fn circles(pair: &Rolling, at: &Configuration) -> Vec<(Point, f64, bool)> {
    let round = |i: usize| {
        let centre = at.points[pair.centres()[i]?.0]?;
        Some((centre, centre.distance(at.points[pair.at[i].0]?), pair.hollow() == Some(i)))
    };
    [0, 1].into_iter().filter_map(round).collect()
}

/// Points round the profile of a cam, one for each ten degrees.
fn profile(c: &Cam, at: &Configuration) -> Vec<Point> {
    const STEPS: usize = 36;
    let (centre, points): (_, Vec<Vec2>) = match (&c.circle, &c.disc) {
        (Some((centre, radius)), _) => {
            let round = |k: usize| Vec2::from_angle(std::f64::consts::TAU * k as f64 / STEPS as f64) * *radius;
            (*centre, (0..STEPS).map(round).collect())
        }
        (None, Some(t)) => {
            let turn = Vec2::from_angle(t.disc.sense * t.phi);
            (t.pivot, t.disc.outline(STEPS).into_iter().map(|p| p.rotate_by(turn)).collect())
        }
        (None, None) => return Vec::new(),
    };
    let Some(centre) = at.points[centre.0] else { return Vec::new() };
    points.into_iter().map(|p| centre + p).collect()
}

/// Width and height of the box around all places; zero where there are none.
pub fn extent(places: impl Iterator<Item = Point>) -> [f64; 2] {
    let mut lo = Vec2::new(f64::INFINITY, f64::INFINITY);
    let mut hi = Vec2::new(f64::NEG_INFINITY, f64::NEG_INFINITY);
    for p in places {
        lo = Vec2::new(lo.x.min(p.x), lo.y.min(p.y));
        hi = Vec2::new(hi.x.max(p.x), hi.y.max(p.y));
    }
    if lo.x <= hi.x { [hi.x - lo.x, hi.y - lo.y] } else { [0.0, 0.0] }
}

/// The smallest preferred μ (SI per mm), so the largest drawing, at which `extent` (SI) fits `room` (mm) in both directions.
///
/// An extent of zero (all velocities vanish) fits any scale: 1 is taken.
pub fn choose(extent: [f64; 2], room: [f64; 2]) -> f64 {
    let need = (extent[0] / room[0]).max(extent[1] / room[1]);
    if !(need > 0.0 && need.is_finite()) {
        return 1.0;
    }
    let exponent = libm::floor(libm::log10(need)) as i32;
    for e in [exponent - 1, exponent, exponent + 1] {
        for step in [1.0, 2.0, 2.5, 5.0] {
            let mu = decimal(step, e);
            // A hair's breadth over the box is still in the box: 100 mm on 100 mm must not jump to the next scale.
            if mu * (1.0 + 1e-9) >= need {
                return mu;
            }
        }
    }
    decimal(1.0, exponent + 2)
}

/// The same, round in a unit of so many SI units: 0.2 (ft/s)/mm, and not 0.05 (m/s)/mm, where velocities are printed in ft/s.
pub fn choose_in(unit: f64, extent: [f64; 2], room: [f64; 2]) -> f64 {
    choose(extent.map(|e| e / unit), room) * unit
}

/// The scale of a drawing (SI per mm): the one that the paper fixes for its kind, or the smallest preferred one at which `extent` (SI) fits
/// `room` (mm).
pub fn fitted(paper: &Paper, kind: Kind, extent: [f64; 2], room: [f64; 2]) -> f64 {
    paper.scale(kind, |unit| choose_in(unit, extent, room))
}

/// The largest preferred μ, round in a unit of so many SI units, with which a drawing is at least `factor` times as large as with `mu`.
pub fn finer(unit: f64, mu: f64, factor: f64) -> f64 {
    let need = mu / unit / factor;
    if !(need > 0.0 && need.is_finite()) {
        return mu;
    }
    let exponent = libm::floor(libm::log10(need)) as i32;
    let series = [exponent + 1, exponent, exponent - 1].into_iter().flat_map(|e| [5.0, 2.5, 2.0, 1.0].map(|step| decimal(step, e)));
    // The hair's breadth of `choose`, the other way.
    series.into_iter().find(|then| *then <= need * (1.0 + 1e-9)).unwrap_or(need) * unit
}

/// The smallest preferred μ, round in a unit, with which a drawing is at most a `factor`-th of the size that it has with `mu`.
pub fn coarser(unit: f64, mu: f64, factor: f64) -> f64 {
    choose_in(unit, [mu * factor, 0.0], [1.0, 1.0])
}

/// step × 10^e as the nearest double to the decimal number (0.002, not 2 × 0.001000…02).
fn decimal(step: f64, e: i32) -> f64 {
    format!("{step}e{e}").parse().expect("a decimal number parses")
}

#[cfg(test)]
mod tests {
    use super::*;
    use hodograph_mechanism::mechanism::{Demand, Mechanism};
    use hodograph_mechanism::position::configure;

    #[test]
    fn preferred_series() {
        assert_eq!(choose([0.3, 0.1], [100.0, 100.0]), 0.005);
        assert_eq!(choose([0.2, 0.1], [100.0, 100.0]), 0.002);
        assert_eq!(choose([0.1, 0.25], [100.0, 100.0]), 0.0025);
        assert_eq!(choose([0.0, 0.0], [100.0, 100.0]), 1.0);
        assert_eq!(choose([1.0e12, 0.0], [100.0, 100.0]), 1.0e10);
    }

    #[test]
    fn the_next_finer_of_the_series() {
        for (factor, finer_mu) in [(1.1, 0.005), (2.0, 0.005), (2.1, 0.0025)] {
            assert_eq!(finer(1.0, 0.01, factor), finer_mu);
        }
        assert_eq!(finer(1.0, 0.03, 1.0), 0.025);
        assert_eq!(finer(1.0, 1.0, 1e3), 0.001);
        assert_eq!([finer(0.5, 0.1, 2.0), coarser(0.5, 0.1, 2.0), choose_in(0.5, [0.3, 0.1], [1.0, 1.0])], [0.05, 0.25, 0.5]);
    }

    /// A hollow circle has room in the figure up to twice the size of all else, in any unit.
    #[test]
    fn a_ring_has_room_unless_it_dwarfs_all_else() {
        for unit in [1e-3, 1.0, 1e3] {
            // A planet of radius r on an arm of length 1, oblique, in a ring about O.
            for (r, has_room) in [(0.02, false), (0.5, false), (1.5, true), (3.0, true)] {
                let ring = 1.0 + r;
                let text = format!(
                    r#"{{"links": {{"1": ["O"], "3": ["O", "P"], "4": ["P"]}}, "ground": "1", "points": {{"O": [0, 0], "P": ["0.6*{unit} m", "0.8*{unit} m"]}},
                    "gears": [{{"links": ["4", "1"], "centres": ["P", "O"], "radii": ["{} m", "{} m"], "ring": "1"}}],
                    "driver": {{"link": "3", "omega": "1 rad/s"}}, "find": ["omega_4"]}}"#,
                    r * unit,
                    ring * unit
                );
                let scene = hodograph_scene::read(&text).unwrap_or_else(|f| panic!("{f}\n{text}")).value;
                let m = Mechanism::new(&scene).unwrap().value;
                let at = configure(&scene, &m, &Demand::of(&scene, &m).with_all_positions()).unwrap().value;
                let [w, h] = size(&scene, &at).map(|x| x / unit);
                let wide = |c: f64| (c + r) - (c - r).min(0.0);
                let expected = if has_room { [2.0 * ring, 2.0 * ring] } else { [wide(0.6), wide(0.8)] };
                assert!((w - expected[0]).abs() < 1e-9 && (h - expected[1]).abs() < 1e-9, "{r} of {unit} m: {w} by {h}\n{text}");
            }
        }
    }
}
