//! The strand between two wheels of a belt or chain, with its points of tangency; and the direction
//! of a rope.

use super::{Configuration, Path};
use hodograph_base::diag::{Diagnostic, both};
use hodograph_base::digits::significant;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_scene::{GivenQuantity, Guide, GuideId, PointId, Rolling, Scene};

/// Returns the normal m of the strand on the left of the line of centres, pointing away from the
/// first centre, as cosine and sine of its angle from that line. The distance of the strand from
/// either centre is the radius, so (B − A)·m = ρ₁ + ρ₂ with the signed sizes of [`Rolling::sizes`].
/// `None` if one wheel is inside the other.
pub fn normal<N: Real>([r1, r2]: [N; 2], distance: N) -> Option<[N; 2]> {
    let cos = (r1 + r2) / distance;
    let square = N::from_f64(1.0) - cos * cos;
    (square.approx() > 0.0).then(|| [cos, square.sqrt()])
}

/// Returns both ends of a strand: A + ρ₁m and B − ρ₂m.
pub(super) fn strand<N: Real>(
    sizes: [N; 2],
    right: bool,
    a: Point<N>,
    b: Point<N>,
) -> Option<[Point<N>; 2]> {
    let line = b - a;
    let [cos, sin] = normal(sizes, line.norm())?;
    let m = Vec2::new(cos, if right { -sin } else { sin }).rotate_by(line.unit()?);
    let [r1, r2] = sizes;
    Some([a + m * r1, b - m * r2])
}

/// Returns the fault of three or more wheels named counter-clockwise: the strand on the left of
/// each line of centres would be inside. The last wheel is reported.
fn misordered(scene: &Scene, pair: &Rolling, c: &Configuration) -> Option<Diagnostic> {
    let strands: Vec<&Rolling> = scene.rolling.iter().filter(|r| r.belt() == pair.belt()).collect();
    let ends = strands.iter().filter_map(|r| c.points[r.round()?[1].0]);
    let centres: Vec<Point> =
        c.points[strands.first()?.round()?[0].0].into_iter().chain(ends).collect();
    if strands.len() < 2 || !strands.last().is_some_and(|last| std::ptr::eq(*last, pair)) {
        return None;
    }
    let doubled_area: f64 =
        centres.windows(2).map(|w| (w[0] - centres[0]).cross(w[1] - centres[0])).sum();
    let message = both!("the belt or chain names its wheels counter-clockwise");
    let help = both!("name them clockwise, in the opposite order");
    (doubled_area > 0.0).then(|| Diagnostic::error("belt-order", message).at(pair.span).help(help))
}

/// Returns the fault of wheels that overlap, or are not named in the order of the belt.
pub(super) fn misfit(
    scene: &Scene,
    pair: &Rolling,
    [p, q]: [PointId; 2],
    [a, b]: [&GivenQuantity; 2],
    c: &Configuration,
) -> Option<Diagnostic> {
    if let Some(fault) = misordered(scene, pair, c) {
        return Some(fault);
    }
    let (distance, radii) = (c.points[p.0]?.distance(c.points[q.0]?), a.value + b.value);
    if distance > radii {
        return None;
    }
    let (p, q) = (scene.point_name(p), scene.point_name(q));
    let (distance, radii) = (scene.length_words(distance), scene.length_words(radii));
    let wheels = if pair.kind.is_toothed() { both!("sprockets") } else { both!("pulleys") };
    let message = both!(
        "the {0} about {p} and {q} overlap: {p}{q} is {distance}, and their radii make {radii}",
        wheels
    );
    Some(
        Diagnostic::error("belt-overlap", message)
            .at(pair.span)
            .help(both!("correct a radius or a centre")),
    )
}

/// Tolerance of two equal directions typed by a person, as a part of a turn.
const SAME_DIRECTION: f64 = 1e-9;

/// Returns the fault of a rope that is not parallel to the guide of its load: its length would
/// change.
pub(super) fn slack(
    scene: &Scene,
    pair: &Rolling,
    rope: GuideId,
    c: &Configuration,
) -> Option<Diagnostic> {
    let direction = |g: usize| match c.guides[g]? {
        Path::Line { direction, .. } => Some(direction),
        Path::Arc { .. } => None,
    };
    let load = pair.links[0];
    let joins = |g: &Guide| {
        g.rolling.is_none() && g.slider.is_some() && [g.slider, Some(g.on)].contains(&Some(load))
    };
    let own = scene.guides.iter().position(joins).filter(|_| pair.kind.is_flexible())?;
    let (of_rope, of_load) = (direction(rope.0)?, direction(own)?);
    if of_rope.cross(of_load).abs() <= SAME_DIRECTION {
        return None;
    }
    let off = libm::atan(of_rope.cross(of_load) / of_rope.dot(of_load)).abs().to_degrees();
    let load = scene.link_name(load);
    let message =
        both!("the rope of load {load} runs at {0}° to the guide of the load", significant(off, 4));
    let help = both!("give both the same direction");
    Some(Diagnostic::error("rope-direction", message).at(pair.span).help(help))
}
