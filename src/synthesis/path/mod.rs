//! Path generation 按预定轨迹, `"synthesis": "path"`: a point E of the coupler through given places.
//!
//! Three places with A, D, crank and BE given: B_i lies on the crank's circle at BE from E_i; D, carried back with the coupler B_iE_i into
//! position 1, goes round C₁. More places, nothing else given: least squares of the distances ([`search`]), or at given turns of the crank
//! ([`timed`]).

mod drawing;
mod evolution;
mod explained;
pub mod search;
pub mod timed;

use super::board::Board;
use super::body::pose::centre;
use super::candidate::{Draft, Number, Wanted};
use super::form::Form;
use super::fourbar::{FourBar, Heading, meet, named_lengths};
use super::nearest::{number, told};
use super::{Found, KindOfTask, Proof, Statement, Wish};
use crate::diag::{Both, Diagnostic, Faults, both};
use crate::digits::{metres, significant};
use crate::geom::{Point, Vec2};
use search::Fit;
use std::f64::consts::TAU;

/// The kind.
pub const KIND: KindOfTask = KindOfTask {
    name: "path",
    what: ["a coupler point through given places", "按连杆上一点的预定轨迹设计"],
    keys: &["points", "ground", "crank", "BE", "side", "timing", "seed"],
    read,
};

#[derive(Clone, Debug)]
enum Path {
    Three {
        points: [Point; 3],
        a: Point,
        d: Point,
        crank: f64,
        be: f64,
        left: Option<bool>,
    },
    /// The crank's angles at the places, where they are given (rad).
    Many {
        points: Vec<Point>,
        timing: Option<Vec<f64>>,
        seed: u64,
    },
}

fn read(form: &Form) -> Option<Box<dyn Wish>> {
    let points = form.points("points", "[[\"50 mm\", \"70 mm\"], ...]", 3)?;
    for j in 1..points.len() {
        if points[..j].contains(&points[j]) && (j + 1 < points.len() || points[j] != points[0]) {
            let k = j + 1;
            let d = Diagnostic::error(
                "precision-points-coincide",
                both!("point {k} of the path repeats an earlier one", "轨迹上第 {k} 点与前面的点重复"),
            );
            form.fault(d.at(form.span("points")).help(both!("leave it out", "请去掉该点")));
            return None;
        }
    }
    let given: Vec<&str> = ["ground", "crank", "BE", "side"].into_iter().filter(|k| form.has(k)).collect();
    match <[Point; 3]>::try_from(points) {
        Ok(points) => three(form, points),
        Err(points) if given.is_empty() && points.len() >= 5 => {
            let seed = if form.has("seed") { form.count("seed", 0, 1_000_000_000)? } else { 1 };
            let timing = if form.has("timing") { Some(timing(form, points.len())?) } else { None };
            Some(Box::new(Path::Many { points, timing, seed: seed as u64 }))
        }
        Err(points) => {
            let message = match given.first() {
                Some(key) => both!(
                    "`{key}` is given for three points; here are {}, through which all lengths are sought",
                    "`{key}` 只用于三个点；此处有 {} 个点，全部杆长待求",
                    points.len()
                ),
                None => both!(
                    "{} points are too few for a search and too many for the construction",
                    "{} 个点，用于搜索太少，用于作图又太多",
                    points.len()
                ),
            };
            let help = both!(
                "give three points with ground, crank and BE, or five and more points alone",
                "请给三个点及 ground、crank、BE，或只给五个以上的点"
            );
            form.fault(Diagnostic::error("wrong-given", message).at(form.span("points")).help(help));
            None
        }
    }
}

/// The crank's angles at the places: one for each, of which no two are the same position of the crank.
fn timing(form: &Form, places: usize) -> Option<Vec<f64>> {
    let angles: Vec<Option<f64>> = form.items("timing", TIMING, 1)?.iter().map(|n| form.angle_of(n, "timing")).collect();
    let angles: Vec<f64> = angles.into_iter().collect::<Option<_>>()?;
    if angles.len() != places {
        let message = both!(
            "\"timing\" has {} angles for {} points: each has its own",
            "\"timing\" 有 {} 个角，而有 {} 个点：每点应有一个",
            angles.len(),
            places
        );
        let help = both!("write one angle of the crank for each point; only their differences count", "请为每点写一个曲柄转角；只计其差值");
        form.fault(Diagnostic::error("wrong-count", message).at(form.span("timing")).help(help));
        return None;
    }
    for j in 1..angles.len() {
        let same = |i: &usize| libm::sin((angles[j] - angles[*i]) / 2.0).abs() < 1e-9;
        if let Some(i) = (0..j).find(same) {
            let message = both!(
                "the crank stands the same at points {} and {}, which differ",
                "第 {} 点与第 {} 点处曲柄位置相同，而两点不同",
                i + 1,
                j + 1
            );
            let help = both!(
                "give every point an angle of its own within a turn, or leave out one of the two",
                "请在一周内为每点写不同的转角，或去掉其中一点"
            );
            form.fault(Diagnostic::error("precision-points-coincide", message).at(form.span("timing")).help(help));
            return None;
        }
    }
    Some(angles)
}

/// How a timing is written.
const TIMING: &str = "[\"0 deg\", \"20 deg\", ...]";

fn three(form: &Form, points: [Point; 3]) -> Option<Box<dyn Wish>> {
    if form.has("timing") {
        let message = both!("`timing` is given for five and more points", "`timing` 只用于五个以上的点");
        let help =
            both!("three points are met at the crank angles that follow; leave `timing` out", "三点时曲柄转角由作图得出；请去掉 `timing`");
        form.fault(Diagnostic::error("wrong-given", message).at(form.span("timing")).help(help));
    }
    let crank = form.need_size("crank", "\"30 mm\"");
    let be = form.need_size("BE", "\"80 mm\"");
    form.need("ground", "{\"A\": [\"0 mm\", \"0 mm\"], \"D\": [\"100 mm\", \"0 mm\"]}")?;
    let inner = form.inner("ground", &["A", "D"])?;
    let pivot = |key: &str| inner.point_of(inner.need(key, "[\"0 mm\", \"0 mm\"]")?, key);
    let (a, d) = (pivot("A"), pivot("D"));
    let left = match form.inner("side", &["B"]) {
        Some(side) => Some(side.choice("B", &["left of AE", "right of AE"])? == "left of AE"),
        None => None,
    };
    Some(Box::new(Path::Three { points, a: a?, d: d?, crank: crank?, be: be?, left }))
}

impl Wish for Path {
    fn title(&self) -> Both {
        match self {
            Path::Three { .. } => both!("Four-bar whose coupler point passes three places", "连杆点通过三个位置的四杆机构"),
            Path::Many { points, .. } => {
                both!("Four-bar whose coupler point passes near {} places", "连杆点逼近 {} 个位置的四杆机构", points.len())
            }
        }
    }

    fn solve(&self, heading: &Heading) -> Result<Found, Faults> {
        match self {
            Path::Three { points, a, d, crank, be, left } => {
                let sides: &[bool] = match left {
                    Some(true) => &[true],
                    Some(false) => &[false],
                    None => &[true, false],
                };
                let mut drafts = Vec::new();
                let mut faults = Faults::default();
                for left in sides {
                    match by_inversion(points, [*a, *d], [*crank, *be], *left, heading) {
                        Ok(draft) => drafts.push(draft),
                        Err(message) => {
                            let told = Diagnostic::error("no-real-solution", message);
                            faults.push(told.help(nearest(points, [*a, *d], [*crank, *be], sides, heading)));
                        }
                    }
                }
                if drafts.is_empty() { Err(faults) } else { Ok(Found { drafts, ..Found::default() }) }
            }
            Path::Many { points, timing, seed } => {
                let found = match timing {
                    None => search::search(points, *seed),
                    Some(turns) => timed::search(points, turns, *seed),
                };
                let mut drafts: Vec<Draft> = found.fits.iter().filter_map(|f| of_fit(points, f, heading)).collect();
                if timing.is_some() {
                    drafts.iter_mut().zip(&found.fits).for_each(|(d, f)| d.remarks.extend(timed::remark(f, points)));
                }
                let numbers = vec![
                    Number::ratio("evaluations", both!("positions evaluated", "计算的位置数"), found.evaluations as f64),
                    Number::ratio("restarts", both!("runs of the search", "搜索次数"), found.runs as f64),
                ];
                if drafts.is_empty() {
                    let message = both!("the search found no crank-rocker near these places", "没有找到逼近这些点的曲柄摇杆机构");
                    let help = both!("order the points along the path, or try another \"seed\"", "请按轨迹次序排列各点，或换一个 \"seed\"");
                    return Err(Diagnostic::error("no-real-solution", message).help(help).into());
                }
                Ok(Found { drafts, numbers, notes: Vec::new() })
            }
        }
    }

    fn construct(&self, draft: &Draft, board: &mut Board) -> Option<()> {
        let Path::Three { points, a, d, crank, be, .. } = self else { return None };
        let way = |left: bool| move |board: &mut Board| drawing::three(board, points, [*a, *d], [*crank, *be], left);
        board.meant(draft, &[&way(true), &way(false)])
    }

    fn statement(&self) -> Statement {
        self.stated()
    }

    fn proof(&self, draft: &Draft) -> Vec<Proof> {
        self.proved(draft)
    }
}

/// D carried back with the coupler from a position into the first; the coupler's direction is that of BE.
fn back_to_first(d: Point, b: [Point; 3], e: &[Point; 3], k: usize) -> Point {
    let local = (d - b[k]).divide_by(e[k] - b[k]);
    b[0] + local.rotate_by(e[0] - b[0])
}

/// The nearest BE, else the nearest crank, with which the places are reached.
fn nearest(e: &[Point; 3], pivots: [Point; 2], [crank, be]: [f64; 2], sides: &[bool], heading: &Heading) -> Both {
    let works = |lengths: [f64; 2]| {
        // A pivot of C farther off than a hundred times the frame is none.
        let near =
            |draft: Draft| draft.numbers.iter().all(|n| n.name != "CD" || n.value < 100.0 * pivots[0].distance(pivots[1]).max(crank));
        lengths.iter().all(|l| *l > 0.0) && sides.iter().any(|left| by_inversion(e, pivots, lengths, *left, heading).is_ok_and(near))
    };
    let scale = (pivots[0].distance(pivots[1]) + pivots[0].distance(e[0])) * 1e3;
    if let Some(mm) = number(be * 1e3, scale, |mm| works([crank, mm * 1e-3])) {
        return both!("\"BE\": \"{} mm\" does", "\"BE\": \"{} mm\" 时可以", told(mm));
    }
    if let Some(mm) = number(crank * 1e3, scale, |mm| works([mm * 1e-3, be])) {
        return both!("\"crank\": \"{} mm\" does", "\"crank\": \"{} mm\" 时可以", told(mm));
    }
    // BE between the nearest and the farthest place lets the shortest crank reach all.
    let far = e.map(|p| p.distance(pivots[0]) * 1e3);
    let middle = libm::rint((far.iter().copied().fold(f64::INFINITY, f64::min) + far.iter().copied().fold(0.0, f64::max)) / 2.0);
    match number(crank * 1e3, scale, |mm| works([mm * 1e-3, middle * 1e-3])) {
        Some(mm) => both!(
            "\"crank\": \"{} mm\" with \"BE\": \"{} mm\" does",
            "\"crank\": \"{} mm\"、\"BE\": \"{} mm\" 时可以",
            told(mm),
            told(middle)
        ),
        None => both!("move the pivots: both crank and BE must reach all three places", "请移动固定铰链：曲柄与 BE 须能到达三个位置"),
    }
}

/// Three places by inversion.
fn by_inversion(e: &[Point; 3], [a, d]: [Point; 2], [crank, be]: [f64; 2], left: bool, heading: &Heading) -> Result<Draft, Both> {
    let mut b = [Point::ORIGIN; 3];
    for (k, at) in e.iter().enumerate() {
        b[k] = meet(a, crank, *at, be, left).ok_or_else(|| {
            let far = metres(a.distance(*at));
            both!("E{} is {} from A: crank and BE do not reach it", "E{} 距 A {}：曲柄与 BE 够不到", k + 1, far)
        })?;
    }
    let direction = |k: usize| e[k] - b[k];
    let [d1, d2, d3] = [d, back_to_first(d, b, e, 1), back_to_first(d, b, e, 2)];
    let Some((c, _)) = centre(d1, d2, d3) else {
        return Err(both!(
            "D, carried back into position 1, lies in line: C would be infinitely far",
            "D 反转到位置 1 后三点共线：C 在无穷远处"
        ));
    };
    let carried = |k: usize| b[k] + (c - b[0]).divide_by(direction(0)).rotate_by(direction(k));
    let axis = (c - b[0]) * (1.0 / (c - b[0]).norm());
    let local = direction(0);
    let four = FourBar { a, b: b[0], c, d, e: Some(Vec2::new(axis.dot(local), axis.cross(local))) };
    let wanted = (0..3)
        .map(|k| Wanted { driver: (b[k] - a).angle(), places: vec![("B".into(), b[k]), ("C".into(), carried(k)), ("E".into(), e[k])] })
        .collect();
    let mut numbers = named_lengths(four.lengths());
    numbers.push(Number::length("BE", both!("B to E", "B 到 E"), be));
    numbers.push(Number::length("CE", both!("C to E", "C 到 E"), c.distance(e[0])));
    for (name, at) in [("B1", b[0]), ("C1", c)] {
        numbers.push(Number::length(&format!("{name}_x"), both!("place of {name}", "{name} 的位置"), at.x));
        numbers.push(Number::length(&format!("{name}_y"), both!("place of {name}", "{name} 的位置"), at.y));
    }
    numbers.extend(
        b.iter().enumerate().map(|(k, b)| Number::angle(&format!("crank_{}", k + 1), both!("crank angle", "曲柄转角"), (*b - a).angle())),
    );
    let which = if left { both!("B left of AE", "B 在 AE 左侧") } else { both!("B right of AE", "B 在 AE 右侧") };
    Ok(Draft { ordered: true, ..Draft::new(which, four.scene(heading), numbers, wanted) })
}

/// A linkage of the search: what it really does is wanted of its scene, how far that is from the places is told.
fn of_fit(points: &[Point], fit: &Fit, heading: &Heading) -> Option<Draft> {
    let l = &fit.linkage;
    let at: Vec<search::Place> = fit.cranks.iter().map(|t| l.place(*t)).collect::<Option<_>>()?;
    let first = at.first()?;
    let four = FourBar { a: l.a, b: first.b, c: first.c, d: l.d(), e: Some(l.e) };
    let wanted = fit
        .cranks
        .iter()
        .zip(&at)
        .map(|(t, p)| Wanted { driver: *t, places: vec![("B".into(), p.b), ("C".into(), p.c), ("E".into(), p.e)] })
        .collect();
    let far: Vec<f64> = points.iter().zip(&at).map(|(p, q)| p.distance(q.e)).collect();
    let mut numbers = named_lengths(four.lengths());
    numbers.push(Number::length("A_x", both!("place of A", "A 的位置"), l.a.x));
    numbers.push(Number::length("A_y", both!("place of A", "A 的位置"), l.a.y));
    numbers.push(Number::angle("phi", both!("direction of the frame", "机架方向"), l.phi - TAU * libm::rint(l.phi / TAU)));
    numbers.push(Number::length("u", both!("E along BC from B", "E 沿 BC 的坐标"), l.e.x));
    numbers.push(Number::length("v", both!("E to the left of BC", "E 在 BC 左侧的距离"), l.e.y));
    numbers.push(Number::angle(
        "crank_1",
        both!("crank angle at place 1", "位置 1 的曲柄转角"),
        fit.cranks[0] - TAU * libm::rint(fit.cranks[0] / TAU),
    ));
    numbers.push(Number::length("rms", both!("root mean square distance", "均方根距离"), fit.rms));
    numbers.push(Number::length("max", both!("greatest distance", "最大距离"), far.iter().copied().fold(0.0, f64::max)));
    let which = both!("root mean square distance {} mm", "均方根距离 {} mm", significant(fit.rms * 1e3, 4));
    Some(Draft { ordered: true, error: fit.rms, targets: points.to_vec(), ..Draft::new(which, four.scene(heading), numbers, wanted) })
}
