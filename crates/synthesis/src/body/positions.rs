//! Positions as written in the file: origin and angle of the body, or the places of two of its
//! points.
//!
//! Two points B, C of the body define a position as `[x, y, angle]` does: B is its origin, BC its
//! direction. Their distance is constant. Coordinates have the digits of a book, so a small
//! difference is reported and C is taken at the mean distance. B and C then are the moving pins of
//! two or three positions, unless other pins or pivots are given.

use super::pose::BodyPose;
use crate::form::TaskForm;
use hodograph_base::diag::{Diagnostic, both};
use hodograph_base::digits::significant;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::json::{Node, NodeKind};

/// Two distances of the points of a body that differ by no more than this share are equal, as
/// written with the digits of a book.
const WRITTEN: f64 = 1e-2;
/// A difference below this share of the distance is rounding.
const EXACT: f64 = 1e-9;

/// An example of positions as written.
const EXAMPLE: &str = "[[\"0 mm\", \"0 mm\", \"0 deg\"], ...]";

/// The positions of a body, and the pins that they define in its frame.
pub(super) struct GivenPositions {
    /// The positions in order.
    pub all: Vec<BodyPose>,
    /// B and C in the body's frame, where positions are given by their places.
    pub pins: Option<[Vec2; 2]>,
}

/// Reads two to five positions, no two of them equal.
pub(super) fn read(form: &TaskForm) -> Option<GivenPositions> {
    let items = form.items("positions", EXAMPLE, 2)?;
    if items.len() > 5 {
        let d = Diagnostic::error(
            "wrong-count",
            both!(
                "a four-bar guides a body through five positions at most, here are {}",
                items.len()
            ),
        );
        form.fault(d.at(form.span("positions")).help(both!(
            "take the five that matter, or `\"synthesis\": \"path\"` for the path of a point"
        )));
        return None;
    }
    let by_points = items.iter().all(|n| matches!(n.kind, NodeKind::Object(_)));
    let told = if by_points {
        by_places(form, items)?
    } else {
        GivenPositions { all: by_angles(form, items)?, pins: None }
    };
    apart(form, items, &told.all).then_some(told)
}

fn by_angles(form: &TaskForm, items: &[Node]) -> Option<Vec<BodyPose>> {
    let one = |n| {
        let [x, y, angle] =
            form.several::<3>(n, "positions", "[\"12 mm\", \"8 mm\", \"20 deg\"]")?;
        let (x, y, angle) = (
            form.length_of(x, "positions"),
            form.length_of(y, "positions"),
            form.angle_of(angle, "positions"),
        );
        Some(BodyPose { origin: Point::new(x?, y?), angle: angle? })
    };
    let found: Vec<Option<BodyPose>> = items.iter().map(one).collect();
    found.into_iter().collect()
}

fn by_places(form: &TaskForm, items: &[Node]) -> Option<GivenPositions> {
    let one = |n: &Node| {
        let inner = form.object(n, "positions", &["B", "C"])?;
        let place = |key: &str| inner.point_of(inner.need(key, "[\"0 mm\", \"0 mm\"]")?, key);
        let (b, c) = (place("B"), place("C"));
        Some((b?, c?))
    };
    let found: Vec<Option<(Point, Point)>> = items.iter().map(one).collect();
    let found: Vec<(Point, Point)> = found.into_iter().collect::<Option<_>>()?;
    let far: Vec<f64> = found.iter().map(|(b, c)| b.distance(*c)).collect();
    let mean = far.iter().sum::<f64>() / far.len() as f64;
    let off = |d: &f64| (d - mean).abs();
    let worst = (0..far.len()).max_by(|i, j| off(&far[*i]).total_cmp(&off(&far[*j])))?;
    if mean == 0.0 || off(&far[worst]) > WRITTEN * mean {
        let [here, all] = [far[worst], mean].map(|l| significant(l * 1e3, 5));
        let k = worst + 1;
        let message = both!(
            "B and C are {here} mm apart in position {k}, {all} mm on an average of all: they are no two points of one body"
        );
        let help = both!("points of a rigid body keep their distance: check the coordinates");
        form.fault(Diagnostic::error("wrong-given", message).at(items[worst].span).help(help));
        return None;
    }
    if off(&far[worst]) > EXACT * mean {
        let [off, all] = [off(&far[worst]), mean].map(|l| significant(l * 1e3, 4));
        let message = both!(
            "the distances of B and C differ by up to {off} mm: {all} mm is taken, B where it is given, C on its ray"
        );
        form.fault(Diagnostic::note("rounded", message).at(form.span("positions")));
    }
    let all =
        found.iter().map(|(b, c)| BodyPose { origin: *b, angle: (*c - *b).angle() }).collect();
    Some(GivenPositions { all, pins: Some([Vec2::ZERO, Vec2::new(mean, 0.0)]) })
}

/// True if no two positions are equal; reports those that are.
fn apart(form: &TaskForm, items: &[Node], all: &[BodyPose]) -> bool {
    for (j, q) in all.iter().enumerate() {
        for (i, p) in all[..j].iter().enumerate() {
            if p.origin.distance(q.origin) == 0.0
                && libm::sin((p.angle - q.angle) / 2.0).abs() < 1e-12
            {
                let (i, j) = (i + 1, j + 1);
                let d = Diagnostic::error(
                    "precision-points-coincide",
                    both!("positions {i} and {j} are the same"),
                );
                form.fault(
                    d.at(items[j - 1].span)
                        .help(both!("leave one of them out: fewer positions have more solutions")),
                );
                return false;
            }
        }
    }
    true
}
