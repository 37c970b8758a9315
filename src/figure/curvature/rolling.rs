//! The centrodes on paper: the path of the pole in the fixed plane, and that in the moving plane where the link stands now. They touch in
//! the pole and roll on one another.
//!
//! Between two positions the pole runs through infinity where ω changes its sign: the stations are ratios, and what lies between them is
//! drawn from numerators and denominators that go evenly, so that each branch reaches the edge of the paper.

use crate::curvature::centrodes::{STEPS, Station, centrodes};
use crate::curvature::{Curvature, OfLink};
use crate::diag::Faults;
use crate::figure::centres::rays::{clipped, holds};
use crate::figure::extent::Rect;
use crate::figure::item::{Dash, Figure, Shape, Stroke};
use crate::figure::label::Label;
use crate::figure::list::Wanted;
use crate::figure::mechanism;
use crate::figure::place::LabelRequest;
use crate::figure::sheet::Maker;
use crate::geom::{Point, Vec2};
use crate::mechanism::Level;
use crate::report::curvature::Words;

use super::board::Board;

/// Paper around the mechanism for the branches.
const REACH_MM: f64 = 45.0;
/// Parts of the way between two stations.
const PARTS: usize = 8;

/// A path by its name: the numerator of its places, and its line.
type Kind = (&'static str, fn(&Station) -> Vec2, Stroke);

/// The figure of one link.
pub fn figure(w: &Wanted, found: &Curvature, of: &OfLink) -> Result<Figure, Faults> {
    let paths = centrodes(&found.scene, &found.worked, of.link, found.against, STEPS)?;
    let maker = Maker { scene: w.scene, worked: w.worked, options: w.options, certified: Vec::new() };
    let words = Words { found, lang: w.options.lang };
    let (style, diagram) = (&w.options.style, &w.worked.construction.diagram);
    let to_paper = |p: Point| ((p - diagram.origin) * (1.0 / diagram.mu_l)).to_point();
    let d = mechanism::numbered(style, w.scene, w.worked, &w.options.notation);
    let reach = d.bounds().grown(REACH_MM);
    // Branches that stay near need no more paper than they take.
    let all = || paths.stations.iter().flatten().flat_map(|s| [s.fixed, s.moving].map(|v| to_paper((v * (1.0 / s.omega)).to_point())));
    let now = of.pole().map(|p| to_paper(p.pole)).filter(|p| holds(d.bounds().grown(2.0 * REACH_MM), *p));
    let window = all().filter(|p| holds(reach, *p)).chain(now).fold(d.bounds(), |all, p| all.union(Rect::new(p, p))).grown(3.0);
    let mut board = Board::new(style, d, window);
    let kinds: [Kind; 2] = [("fixed", |s| s.fixed, style.vector), ("moving", |s| s.moving, style.vector.dashed(Dash::Dashed))];
    for (name, over, stroke) in kinds {
        let stations: Vec<Option<(Vec2, f64)>> = paths.stations.iter().map(|s| s.as_ref().map(|s| (over(s), s.omega))).collect();
        let runs = runs(&stations, paths.closed, window, &to_paper);
        let longest = runs.iter().enumerate().max_by_key(|(_, r)| r.len()).map(|(k, _)| k);
        for (k, points) in runs.into_iter().enumerate() {
            let middle = points.len() / 3;
            let near = points.get(middle).copied().zip(points.get(middle + 1).copied());
            let mut owner = 0;
            board
                .d
                .behind(|d| owner = d.shape(name, "centrode", Shape::Polyline { points, closed: false, stroke: Some(stroke), fill: None }));
            if let (Some((from, to)), true) = (near, Some(k) == longest) {
                let symbol = if name == "fixed" { "p" } else { "p'" };
                board.d.label(
                    name,
                    "centrode",
                    LabelRequest::along(Label::math(symbol), style.label_mm, from, to, stroke.width_mm / 2.0).owned(owner),
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
    let (_, mu) = maker.caption(Level::Position);
    let caption = format!("{} – {} ({})", maker.words().centrodes, words.heading(of), maker.words().fixed_moving);
    let under = format!("{},\\quad {mu}", words.centrode_legend(of));
    let part = maker.titled(board.d.finish(), Label::text(caption), &under, "centrodes");
    let mut figure = maker.alone(part);
    figure.desc = format!("{} – {}", maker.words().centrodes, words.heading(of));
    Ok(figure)
}

/// The pieces of a path that the paper holds.
fn runs(stations: &[Option<(Vec2, f64)>], closed: bool, window: Rect, to_paper: &dyn Fn(Point) -> Point) -> Vec<Vec<Point>> {
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
                Some(to_paper((over * (1.0 / omega)).to_point())).filter(|p| p.x.is_finite() && p.y.is_finite())
            };
            // Through infinity: the one branch ends at the edge, the other begins there.
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
