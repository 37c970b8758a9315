//! Draws the centrodes: the path of the pole in the fixed plane, and the path in the moving plane
//! at the present position of the link. They touch in the pole and roll on each other.
//!
//! Between two positions the pole runs through infinity if ω changes its sign. The stations are
//! therefore ratios, and intermediate places are interpolated in numerators and denominators, so
//! that each branch reaches the edge of the paper.

use crate::centres::rays::{clipped, holds};
use crate::list::FigureInput;
use crate::mechanism;
use crate::scales::DrawingScales;
use crate::sheet::SheetDrafter;
use hodograph_base::diag::Faults;
use hodograph_base::geom::{Point, Vec2, cross_lines};
use hodograph_methods::curvature::centrodes::{PoleStation, STEPS, centrodes};
use hodograph_methods::curvature::{LinkCurvatures, OfLink};
use hodograph_paper::paper::extent::Rect;
use hodograph_paper::paper::item::{Dash, Figure, LineStroke, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_report::curvature::CurvatureWords;
use hodograph_scene::{DiagramKind, Lang};

use super::board::CurvatureBoard;
use std::f64::consts::TAU;

/// Space around the mechanism for the branches.
const REACH_MM: f64 = 45.0;
/// Centrodes up to this size are drawn in full.
const WHOLE_MM: f64 = 240.0;
/// Tolerance within which a path counts as a circle.
const SAME_MM: f64 = 1e-6;
/// Range of angles for the letter of such a circle.
const LETTERED_RAD: [f64; 2] = [4.2, 5.2];
/// Intermediate steps between two stations.
const PARTS: usize = 8;

/// Clearance between a mark and the name of a path: any closer, the name reads as that of the mark.
const ROOM_MM: f64 = 8.0;

/// A kind of path: its name, the numerator of its places, and its stroke.
type PathStyle = (&'static str, fn(&PoleStation) -> Vec2, LineStroke);

/// A part of a path with space for the path's name: the part nearest to its first third that is
/// [`ROOM_MM`] from everything `around`, or else the part farthest from it. `None` for a path of
/// one point.
fn free_part(path: &[Point], around: &[Point]) -> Option<(Point, Point)> {
    let clearance = |p: Point| around.iter().map(|q| q.distance(p)).fold(f64::INFINITY, f64::min);
    // The ends are at the edge of the paper.
    let end = path.len() / 8;
    let mut parts: Vec<(usize, Point, Point)> =
        path.windows(2).enumerate().map(|(k, ends)| (k, ends[0], ends[1])).collect();
    parts.truncate(parts.len().saturating_sub(end).max(1));
    parts.drain(..end.min(parts.len().saturating_sub(1)));
    parts.sort_by_key(|(k, ..)| k.abs_diff(path.len() / 3));
    let free = parts.iter().find(|(_, p, _)| clearance(*p) > ROOM_MM);
    let (_, from, to) =
        free.or_else(|| parts.iter().max_by(|a, b| clearance(a.1).total_cmp(&clearance(b.1))))?;
    Some((*from, *to))
}

/// Draws the figure of one link.
pub fn figure(w: &FigureInput, found: &LinkCurvatures, of: &OfLink) -> Result<Figure, Faults> {
    let paths = centrodes(&found.scene, &found.worked, of.link, found.against, STEPS)?;
    let maker = SheetDrafter {
        scene: w.scene,
        worked: w.worked,
        options: w.options,
        certified: Vec::new(),
    };
    let words = CurvatureWords { found, lang: w.options.lang };
    let (style, diagram) = (&w.options.style, &w.worked.construction.diagram);
    let to_paper = |p: Point| ((p - diagram.origin) * (1.0 / diagram.mu)).to_point();
    let d =
        mechanism::rolling(style, w.scene, w.worked, &w.options.notation, [of.link, found.against]);
    // Branches that stay near define the size of the paper.
    let all =
        || {
            paths.stations.iter().flatten().flat_map(|s| {
                [s.fixed, s.moving].map(|v| to_paper((v * (1.0 / s.omega)).to_point()))
            })
        };
    let whole = all().fold(d.bounds(), |all, p| all.union(Rect::new(p, p)));
    let reach = if whole.width_mm().max(whole.height_mm()) < WHOLE_MM {
        whole
    } else {
        d.bounds().grown(REACH_MM)
    };
    let now =
        of.pole().map(|p| to_paper(p.pole)).filter(|p| holds(d.bounds().grown(2.0 * REACH_MM), *p));
    let window = all()
        .filter(|p| holds(reach, *p))
        .chain(now)
        .fold(d.bounds(), |all, p| all.union(Rect::new(p, p)))
        .grown(3.0);
    let mut board = CurvatureBoard::new(style, d, window);
    let pins: Vec<Point> =
        w.worked.configuration.points.iter().flatten().map(|p| to_paper(*p)).collect();
    let kinds: [PathStyle; 2] = [
        ("fixed", |s| s.fixed, style.vector),
        ("moving", |s| s.moving, style.vector.dashed(Dash::Dashed)),
    ];
    let [(_, fixed, _), (_, moving, _)] = kinds;
    for (name, over, stroke) in kinds {
        let (symbol, another) = if name == "fixed" { ("p", moving) } else { ("p'", fixed) };
        let stations: Vec<Option<(Vec2, f64)>> =
            paths.stations.iter().map(|s| s.as_ref().map(|s| (over(s), s.omega))).collect();
        if let Some((centre, radius_mm)) = whole_circle(&stations, window, &to_paper) {
            let circle = Shape::Arc { centre, radius_mm, from_rad: 0.0, to_rad: TAU, stroke };
            let mut owner = 0;
            board.d.behind(|d| owner = d.shape(name, "centrode", circle));
            let request = LabelRequest::along_arc(
                Label::math(symbol),
                style.label_mm,
                centre,
                radius_mm,
                LETTERED_RAD,
                stroke.width_mm / 2.0,
            );
            board.d.label(name, "centrode", request.owned(owner));
            continue;
        }
        let runs = runs(&stations, paths.closed, window, &to_paper);
        let other = paths
            .stations
            .iter()
            .flatten()
            .map(|s| to_paper((another(s) * (1.0 / s.omega)).to_point()));
        let around: Vec<Point> =
            pins.iter().copied().chain(other.filter(|p| holds(window, *p))).collect();
        let longest = runs.iter().enumerate().max_by_key(|(_, r)| r.len()).map(|(k, _)| k);
        for (k, points) in runs.into_iter().enumerate() {
            let beside = if Some(k) == longest { free_part(&points, &around) } else { None };
            let mut owner = 0;
            board.d.behind(|d| {
                owner = d.shape(
                    name,
                    "centrode",
                    Shape::Polyline { points, closed: false, stroke: Some(stroke), fill: None },
                )
            });
            if let Some((from, to)) = beside {
                board.d.label(
                    name,
                    "centrode",
                    LabelRequest::along(
                        Label::math(symbol),
                        style.label_mm,
                        from,
                        to,
                        stroke.width_mm / 2.0,
                    )
                    .owned(owner),
                );
            }
        }
    }
    if let Some(pole) = of.pole() {
        let at = to_paper(pole.pole);
        let symbol = words.pole(of);
        if let (Some(t), true) = (pole.normal.perp().unit(), board.holds(at)) {
            let cut = board.cut(at - t * 25.0, at + t * 25.0);
            board.line("tangent", "curvature tangent", cut, style.thin.dashed(Dash::DashDot));
        }
        board.spot("pole", Label::math(symbol), at, false);
    }
    board.spots();
    let (_, mu) = maker.caption(DiagramKind::Plane);
    let [open, close] = match w.options.lang {
        Lang::En => [" (", ")"],
        Lang::Zh => ["（", "）"],
    };
    let caption = Label::text(format!("{} – ", maker.words().centrodes))
        .then(words.heading_set(of).label())
        .then(Label::text(format!("{open}{}{close}", maker.words().fixed_moving)));
    let under = DrawingScales::words(words.centrode_legend(of)).and(mu);
    let part = maker.titled(board.d.finish(), caption, &under, "centrodes");
    let mut figure = maker.alone(part);
    figure.desc = format!("{} – {}", maker.words().centrodes, words.heading(of));
    Ok(figure)
}

/// The circle that a path traverses, once or several times. It is drawn once, because the dashes of
/// several turns would fill each other's gaps.
fn whole_circle(
    stations: &[Option<(Vec2, f64)>],
    window: Rect,
    to_paper: &dyn Fn(Point) -> Point,
) -> Option<(Point, f64)> {
    let place = |s: &Option<(Vec2, f64)>| {
        s.map(|(over, omega)| to_paper((over * (1.0 / omega)).to_point()))
    };
    let places: Vec<Point> = stations.iter().map(place).collect::<Option<_>>()?;
    let [a, .., _] = places[..] else { return None };
    // Perpendicular bisectors of two chords: the longest from the first place, and the chord to the
    // place farthest from it.
    let b = places.iter().copied().max_by(|p, q| a.distance(*p).total_cmp(&a.distance(*q)))?;
    let off = |p: &Point| (*p - a).cross(b - a).abs();
    let c = places.iter().copied().max_by(|p, q| off(p).total_cmp(&off(q)))?;
    let centre =
        cross_lines(a + (b - a) * 0.5, (b - a).perp(), a + (c - a) * 0.5, (c - a).perp()).at;
    let radius = centre.distance(a);
    let even =
        radius.is_finite() && places.iter().all(|p| (centre.distance(*p) - radius).abs() < SAME_MM);
    let turn = |w: &[Point]| (w[0] - centre).cross(w[1] - centre) / (radius * radius);
    let around: f64 = places.windows(2).map(|w| libm::asin(turn(w).clamp(-1.0, 1.0))).sum();
    let held = holds(window, centre + Vec2::new(radius, radius))
        && holds(window, centre - Vec2::new(radius, radius));
    (even && held && around.abs() > TAU * (1.0 - 2.0 / STEPS as f64)).then_some((centre, radius))
}

/// The pieces of a path on the paper.
fn runs(
    stations: &[Option<(Vec2, f64)>],
    closed: bool,
    window: Rect,
    to_paper: &dyn Fn(Point) -> Point,
) -> Vec<Vec<Point>> {
    let mut out: Vec<Vec<Point>> = Vec::new();
    let mut run: Vec<Point> = Vec::new();
    let mut before: Option<Point> = None;
    let n = stations.len();
    let pairs = if closed { n } else { n.saturating_sub(1) };
    let end = |run: &mut Vec<Point>, out: &mut Vec<Vec<Point>>| {
        let done = std::mem::take(run);
        if done.len() > 1 {
            out.push(done);
        }
    };
    for k in 0..pairs {
        let (Some(a), Some(b)) = (stations[k], stations[(k + 1) % n]) else {
            end(&mut run, &mut out);
            before = None;
            continue;
        };
        for part in 0..PARTS {
            let t = [part, part + 1].map(|p| p as f64 / PARTS as f64);
            let [p, q] = t.map(|t| (a.0 * (1.0 - t) + b.0 * t, a.1 * (1.0 - t) + b.1 * t));
            let place = |(over, omega): (Vec2, f64)| {
                Some(to_paper((over * (1.0 / omega)).to_point()))
                    .filter(|p| p.x.is_finite() && p.y.is_finite())
            };
            // Through infinity: one branch ends at the edge, the other begins there.
            let through = p.1 * q.1 <= 0.0;
            let (from, to) = (place(p), place(q));
            if through {
                end(&mut run, &mut out);
                before = None;
                continue;
            }
            let (Some(from), Some(to)) = (from, to) else { continue };
            match cut(window, from, to) {
                Some([a, b]) => {
                    if before.is_none_or(|p| p.distance(a) > 1e-6) {
                        end(&mut run, &mut out);
                        run.push(a);
                    }
                    run.push(b);
                    before = Some(b);
                }
                None => {
                    end(&mut run, &mut out);
                    before = None;
                }
            }
        }
    }
    end(&mut run, &mut out);
    out
}

fn cut(window: Rect, a: Point, b: Point) -> Option<[Point; 2]> {
    let u = (b - a).unit()?;
    let [low, high] = clipped(window, a, u)?;
    let (low, high) = (low.max(0.0), high.min(a.distance(b)));
    (low < high).then(|| [a + u * low, a + u * high])
}

#[cfg(test)]
mod tests {
    use super::{ROOM_MM, free_part};
    use hodograph_base::geom::Point;

    #[test]
    fn a_name_stands_away_from_pins() {
        let path: Vec<Point> = (0..60).map(|k| Point::new(f64::from(k), 0.0)).collect();
        let third = free_part(&path, &[]).unwrap();
        assert_eq!(third, (path[20], path[21]));
        // With a pin at that place, the name is moved as far as necessary.
        let (from, _) = free_part(&path, &[path[20]]).unwrap();
        assert!((ROOM_MM..ROOM_MM + 1.5).contains(&from.distance(path[20])), "{from:?}");
        // If no part is free, the freest one.
        let pins: Vec<Point> =
            (0..60).filter(|k| (k - 40_i32).abs() > 2).map(|k| path[k as usize]).collect();
        assert_eq!(free_part(&path, &pins).unwrap().0, path[40]);
        assert_eq!(free_part(&path[..1], &pins), None);
        assert_eq!(free_part(&path[..2], &pins).unwrap().0, path[0]);
    }
}
