//! The only conversion between SI and millimetres of paper: scales μ from the series 1, 2, 2.5, 5 ×
//! 10^k.

pub use crate::construction::scale::number;

use crate::plan::{Plan, PlanStep};
use hodograph_base::geom::{Point, Vec2};
use hodograph_mechanism::position::Configuration;
use hodograph_scene::{Cam, DiagramKind, Kind, Paper, Rolling, Scene};

/// The space for each drawing (mm).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Boxes {
    /// Width and height for the mechanism.
    pub diagram: [f64; 2],
    /// Width and height for each polygon.
    pub polygon: [f64; 2],
}

impl Default for Boxes {
    /// Returns the space at which a diagram and two polygons fit next to one another on A4
    /// landscape, with space for their labels. A mechanism may be as tall as wide: the space next
    /// to it is for equations.
    fn default() -> Self {
        Boxes { diagram: [130.0, 130.0], polygon: [95.0, 80.0] }
    }
}

/// A polygon with more vectors than this needs more space for their names than the usual box has.
const USUAL_VECTORS: f64 = 9.0;
/// The largest ratio of a polygon's side to the usual one: a sheet of A3.
const LARGEST: f64 = 2.0;
/// Fractions of a fixed paper's width and height for the mechanism and each polygon; the rest is
/// for captions, equations and results.
const DIAGRAM_PART: [f64; 2] = [0.34, 0.38];
const POLYGON_PART: [f64; 2] = [0.25, 0.34];

impl Boxes {
    /// Returns the space for a plan's drawings: the usual boxes, larger ones for polygons of many
    /// vectors, or a fraction of a fixed paper.
    pub fn of(paper: &Paper, plan: &Plan) -> Boxes {
        if let Some([w, h]) = paper.size_mm {
            let part = |p: [f64; 2]| [p[0] * w, p[1] * h];
            return Boxes { diagram: part(DIAGRAM_PART), polygon: part(POLYGON_PART) };
        }
        let usual = Boxes::default();
        let last = DiagramKind::of(plan.level).max(DiagramKind::Velocity);
        let vectors = plan.steps(last).iter().flat_map(|g| g.steps(0)).map(|s| match s {
            PlanStep::Equation { chains, .. } => {
                chains.iter().map(|c| c.known.len() + c.unknown.len()).sum()
            }
            PlanStep::Image { .. } | PlanStep::Trials { .. } | PlanStep::Same { .. } => 1_usize,
        });
        // Names need area, which grows with the square of the side.
        let larger = (vectors.sum::<usize>() as f64 / USUAL_VECTORS).sqrt().clamp(1.0, LARGEST);
        Boxes { polygon: usual.polygon.map(|side| side * larger), ..usual }
    }
}

/// A ring gear that would enlarge the figure by more than this factor is drawn as an arc, as in
/// books, and needs no space.
pub const DWARFS: f64 = 2.0;

/// Returns width and height of a mechanism (m): the box around its joints, the profiles of its cams
/// and the circles of its wheels.
pub fn size(scene: &Scene, at: &Configuration) -> [f64; 2] {
    let joints = at.points.iter().flatten().copied();
    let profiles = scene.cams.iter().flat_map(|c| profile(c, at));
    let (rings, wheels): (Vec<_>, Vec<_>) =
        scene.rolling.iter().flat_map(|pair| circles(pair, at)).partition(|c| c.2);
    let corners = |(centre, r, _): &(Point, f64, bool)| {
        [*centre + Vec2::new(*r, *r), *centre - Vec2::new(*r, *r)]
    };
    let mut places: Vec<Point> =
        joints.chain(profiles).chain(wheels.iter().flat_map(corners)).collect();
    let [w, h] = extent(places.iter().copied());
    places.extend(rings.iter().filter(|(_, r, _)| 2.0 * r <= DWARFS * w.max(h)).flat_map(corners));
    extent(places.into_iter())
}

/// Returns the circles of a rolling pair: centre, radius, and true for a hollow one (ring gear).
fn circles(pair: &Rolling, at: &Configuration) -> Vec<(Point, f64, bool)> {
    let round = |i: usize| {
        let centre = at.points[pair.centres()[i]?.0]?;
        Some((centre, centre.distance(at.points[pair.at[i].0]?), pair.hollow() == Some(i)))
    };
    [0, 1].into_iter().filter_map(round).collect()
}

/// Returns points on the profile of a cam, one for every ten degrees.
fn profile(c: &Cam, at: &Configuration) -> Vec<Point> {
    const STEPS: usize = 36;
    let (centre, points): (_, Vec<Vec2>) = match (&c.circle, &c.disc) {
        (Some((centre, radius)), _) => {
            let round = |k: usize| {
                Vec2::from_angle(std::f64::consts::TAU * k as f64 / STEPS as f64) * *radius
            };
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

/// Returns width and height of the box around all places; zero if there are none.
pub fn extent(places: impl Iterator<Item = Point>) -> [f64; 2] {
    let mut lo = Vec2::new(f64::INFINITY, f64::INFINITY);
    let mut hi = Vec2::new(f64::NEG_INFINITY, f64::NEG_INFINITY);
    for p in places {
        lo = Vec2::new(lo.x.min(p.x), lo.y.min(p.y));
        hi = Vec2::new(hi.x.max(p.x), hi.y.max(p.y));
    }
    if lo.x <= hi.x { [hi.x - lo.x, hi.y - lo.y] } else { [0.0, 0.0] }
}

/// Returns the smallest preferred μ (SI per mm), that is the largest drawing, at which `extent`
/// (SI) fits `room` (mm) in both directions.
///
/// An extent of zero (all velocities vanish) fits any scale: the result is 1.
pub fn choose(extent: [f64; 2], room: [f64; 2]) -> f64 {
    let need = (extent[0] / room[0]).max(extent[1] / room[1]);
    if !(need > 0.0 && need.is_finite()) {
        return 1.0;
    }
    let exponent = libm::floor(libm::log10(need)) as i32;
    for e in [exponent - 1, exponent, exponent + 1] {
        for step in [1.0, 2.0, 2.5, 5.0] {
            let mu = decimal(step, e);
            // A rounding error over the box still counts as in the box: 100 mm on 100 mm must not
            // take the next scale.
            if mu * (1.0 + 1e-9) >= need {
                return mu;
            }
        }
    }
    decimal(1.0, exponent + 2)
}

/// Returns the smallest preferred μ that is a round number in a given unit (SI): 0.2 (ft/s)/mm, and
/// not 0.05 (m/s)/mm, if velocities are printed in ft/s.
pub fn choose_in(unit: f64, extent: [f64; 2], room: [f64; 2]) -> f64 {
    choose(extent.map(|e| e / unit), room) * unit
}

/// Returns the scale of a drawing (SI per mm): the scale that the paper fixes for its kind, or the
/// smallest preferred one at which `extent` (SI) fits `room` (mm).
pub fn fitted(paper: &Paper, kind: Kind, extent: [f64; 2], room: [f64; 2]) -> f64 {
    paper.scale(kind, |unit| choose_in(unit, extent, room))
}

/// Returns the scale of a drawing that is seen and not measured: the scale that the paper fixes for
/// its kind, or the smallest μ of two digits at which `extent` (SI) fits `room` (mm).
pub fn filling(paper: &Paper, kind: Kind, extent: [f64; 2], room: [f64; 2]) -> f64 {
    paper.scale(kind, |unit| {
        let need = (extent[0] / room[0]).max(extent[1] / room[1]) / unit;
        if !(need > 0.0 && need.is_finite()) {
            return unit;
        }
        let last = libm::floor(libm::log10(need)) as i32 - 1;
        // The rounding tolerance of `choose`.
        let steps = libm::ceil(need / decimal(1.0, last) * (1.0 - 1e-9));
        decimal(steps, last) * unit
    })
}

/// Returns the largest preferred μ, round in a given unit (SI), with which a drawing is at least
/// `factor` times as large as with `mu`.
pub fn finer(unit: f64, mu: f64, factor: f64) -> f64 {
    let need = mu / unit / factor;
    if !(need > 0.0 && need.is_finite()) {
        return mu;
    }
    let exponent = libm::floor(libm::log10(need)) as i32;
    let series = [exponent + 1, exponent, exponent - 1]
        .into_iter()
        .flat_map(|e| [5.0, 2.5, 2.0, 1.0].map(|step| decimal(step, e)));
    // The rounding tolerance of `choose`, in the opposite direction.
    series.into_iter().find(|then| *then <= need * (1.0 + 1e-9)).unwrap_or(need) * unit
}

/// Returns the smallest preferred μ, round in a unit, with which a drawing has at most 1/`factor`
/// of its size with `mu`.
pub fn coarser(unit: f64, mu: f64, factor: f64) -> f64 {
    choose_in(unit, [mu * factor, 0.0], [1.0, 1.0])
}

/// Returns step × 10^e as the nearest double to the decimal number (0.002, not 2 × 0.001000…02).
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
    fn a_drawing_that_is_only_seen_fills_its_space() {
        let paper = Paper::default();
        let of = |extent| filling(&paper, Kind::Length, extent, [100.0, 50.0]);
        assert_eq!(of([0.231, 0.01]), 0.0024);
        assert_eq!(of([0.1, 0.115]), 0.0023);
        assert_eq!(of([100.0, 1.0]), 1.0);
        assert_eq!(of([0.0, 0.0]), 1.0);
    }

    #[test]
    fn the_next_finer_of_the_series() {
        for (factor, finer_mu) in [(1.1, 0.005), (2.0, 0.005), (2.1, 0.0025)] {
            assert_eq!(finer(1.0, 0.01, factor), finer_mu);
        }
        assert_eq!(finer(1.0, 0.03, 1.0), 0.025);
        assert_eq!(finer(1.0, 1.0, 1e3), 0.001);
        assert_eq!(
            [finer(0.5, 0.1, 2.0), coarser(0.5, 0.1, 2.0), choose_in(0.5, [0.3, 0.1], [1.0, 1.0])],
            [0.05, 0.25, 0.5]
        );
    }

    /// A ring gear gets space in the figure up to twice the size of everything else, in any unit.
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
                let scene =
                    hodograph_scene::read(&text).unwrap_or_else(|f| panic!("{f}\n{text}")).value;
                let m = Mechanism::new(&scene).unwrap().value;
                let at = configure(&scene, &m, &Demand::of(&scene, &m).with_all_positions())
                    .unwrap()
                    .value;
                let [w, h] = size(&scene, &at).map(|x| x / unit);
                let wide = |c: f64| (c + r) - (c - r).min(0.0);
                let expected =
                    if has_room { [2.0 * ring, 2.0 * ring] } else { [wide(0.6), wide(0.8)] };
                assert!(
                    (w - expected[0]).abs() < 1e-9 && (h - expected[1]).abs() < 1e-9,
                    "{r} of {unit} m: {w} by {h}\n{text}"
                );
            }
        }
    }
}
