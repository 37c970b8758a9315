//! Path generation 按预定轨迹, `"synthesis": "path"`: guides a point E of the coupler through given
//! places.
//!
//! Places met exactly, by [`inversion`]: three with A, D and either crank and BE or the crank's
//! rotations; four and five with A, crank and BE; four at given rotations of the crank with lines
//! for A and D ([`prescribed`]). Five places and more without other givens: least squares of the
//! distances ([`hodograph_search`]), or at given rotations of the crank
//! ([`hodograph_search::timed`]).

mod drawing;
mod explained;
mod inversion;
mod laid;
mod prescribed;
mod sides;

use super::board::SynthesisBoard;
use super::candidate::{DesignNumber, Draft, WantedPosition};
use super::form::TaskForm;
use super::fourbar::{FourBar, Heading, named_lengths};
use super::{KindOfTask, Proof, Statement, TaskResult, Wish};
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::digits::significant;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::each;
use hodograph_search::{self as search, Fit, timed};
use prescribed::Prescribed;
use sides::Sides;
use std::f64::consts::TAU;

/// Path generation as a kind of task.
pub const KIND: KindOfTask = KindOfTask {
    name: "path",
    what: each!("a coupler point through given places"),
    keys: &["points", "ground", "crank", "BE", "side", "line", "line_A", "timing", "seed"],
    read,
};

#[derive(Clone, Debug)]
enum PathTask {
    /// Three places, with crank and BE given.
    Three { points: [Point; 3], pivots: [Point; 2], lengths: [f64; 2], sides: Sides },
    /// Three places at given crank angles (rad).
    Turned { points: [Point; 3], pivots: [Point; 2], turns: [f64; 3] },
    /// Four places at given crank angles.
    Prescribed(Prescribed),
    /// Four places with a line for D, or five; with crank and BE given.
    Several {
        points: Vec<Point>,
        a: Point,
        lengths: [f64; 2],
        sides: Sides,
        line: Option<(Point, Vec2)>,
    },
    /// Many places, with the crank angles at them if given (rad).
    Many { points: Vec<Point>, timing: Option<Vec<f64>>, seed: u64 },
}

fn read(form: &TaskForm) -> Option<Box<dyn Wish>> {
    let points = form.points("points", "[[\"50 mm\", \"70 mm\"], ...]", 3)?;
    for j in 1..points.len() {
        if points[..j].contains(&points[j]) && (j + 1 < points.len() || points[j] != points[0]) {
            let k = j + 1;
            let d = Diagnostic::error(
                "precision-points-coincide",
                both!("point {k} of the path repeats an earlier one"),
            );
            form.fault(d.at(form.span("points")).help(both!("point" => "leave it out")));
            return None;
        }
    }
    let given: Vec<&str> = ["ground", "crank", "BE", "side", "line", "line_A"]
        .into_iter()
        .filter(|k| form.has(k))
        .collect();
    match <[Point; 3]>::try_from(points) {
        Ok(points) => three(form, points),
        Err(points) if points.len() == 4 && form.has("timing") => {
            Some(Box::new(PathTask::Prescribed(prescribed::read(form, points)?)))
        }
        Err(points) if points.len() == 4 || points.len() == 5 && !given.is_empty() => {
            several(form, points)
        }
        Err(points) if given.is_empty() => {
            let seed = if form.has("seed") { form.count("seed", 0, 1_000_000_000)? } else { 1 };
            let timing = if form.has("timing") { Some(timing(form, points.len())?) } else { None };
            Some(Box::new(PathTask::Many { points, timing, seed: seed as u64 }))
        }
        Err(points) => {
            let (key, count) = (given[0], points.len());
            let message = both!(
                "`{key}` is given for three to five points; here are {count}, through which all lengths are sought"
            );
            let help =
                both!("give five points at most with ground, crank and BE, or the points alone");
            form.fault(
                Diagnostic::error("wrong-given", message).at(form.span("points")).help(help),
            );
            None
        }
    }
}

/// The crank angles at the places (rad): one for each, no two of them equal modulo a full turn.
fn timing(form: &TaskForm, places: usize) -> Option<Vec<f64>> {
    let angles: Vec<Option<f64>> =
        form.items("timing", TIMING, 1)?.iter().map(|n| form.angle_of(n, "timing")).collect();
    let angles: Vec<f64> = angles.into_iter().collect::<Option<_>>()?;
    if angles.len() != places {
        let message =
            both!("\"timing\" has {} angles for {} points: each has its own", angles.len(), places);
        let help =
            both!("write one angle of the crank for each point; only their differences count");
        form.fault(Diagnostic::error("wrong-count", message).at(form.span("timing")).help(help));
        return None;
    }
    for j in 1..angles.len() {
        let same = |i: &usize| libm::sin((angles[j] - angles[*i]) / 2.0).abs() < 1e-9;
        if let Some(i) = (0..j).find(same) {
            let message =
                both!("the crank stands the same at points {} and {}, which differ", i + 1, j + 1);
            let help = both!(
                "give every point an angle of its own within a turn, or leave out one of the two"
            );
            form.fault(
                Diagnostic::error("precision-points-coincide", message)
                    .at(form.span("timing"))
                    .help(help),
            );
            return None;
        }
    }
    Some(angles)
}

/// A result of the search with an error below this share of the path meets the places exactly.
const MET: f64 = 1e-9;

/// An example of crank angles as written.
const TIMING: &str = "[\"0 deg\", \"20 deg\", ...]";

/// Reads a task of three places: A and D, with crank and BE or the crank angles.
fn three(form: &TaskForm, points: [Point; 3]) -> Option<Box<dyn Wish>> {
    form.need("ground", "{\"A\": [\"0 mm\", \"0 mm\"], \"D\": [\"100 mm\", \"0 mm\"]}")?;
    let inner = form.inner("ground", &["A", "D"])?;
    let pivot = |key: &str| inner.point_of(inner.need(key, "[\"0 mm\", \"0 mm\"]")?, key);
    let (a, d) = (pivot("A"), pivot("D"));
    if form.has("timing") {
        if let Some(key) = ["crank", "BE", "side"].into_iter().find(|k| form.has(k)) {
            let message = both!("with `timing` three places fix `{key}` by themselves");
            let help = both!("leave it out, or leave `timing` out");
            form.fault(Diagnostic::error("wrong-given", message).at(form.span(key)).help(help));
            return None;
        }
        let turns = <[f64; 3]>::try_from(timing(form, 3)?).ok()?;
        return Some(Box::new(PathTask::Turned { points, pivots: [a?, d?], turns }));
    }
    let lengths = lengths(form);
    let sides = sides::read(form, 3);
    Some(Box::new(PathTask::Three { points, pivots: [a?, d?], lengths: lengths?, sides: sides? }))
}

/// Reads a task of four or five places: A, crank and BE; for four, a line on which D lies.
fn several(form: &TaskForm, points: Vec<Point>) -> Option<Box<dyn Wish>> {
    if let Some(key) = ["timing", "seed"].into_iter().find(|k| form.has(k)) {
        let message = match key {
            "timing" => {
                both!("`timing` is given for three or four places, or for five and more alone")
            }
            _ => both!("`seed` belongs to a search; four and five places are met exactly"),
        };
        form.fault(
            Diagnostic::error("wrong-given", message)
                .at(form.span(key))
                .help(both!("leave it out")),
        );
        return None;
    }
    form.need("ground", "{\"A\": [\"0 mm\", \"0 mm\"]}")?;
    let inner = form.inner("ground", &["A", "D"])?;
    let a = inner.point_of(inner.need("A", "[\"0 mm\", \"0 mm\"]")?, "A");
    if inner.has("D") {
        let message =
            both!("with four or five places D follows: it lies on the centre-point curve");
        let help = both!("leave D out; for four places give the \"line\" on which it lies");
        form.fault(Diagnostic::error("wrong-given", message).at(inner.span("D")).help(help));
        return None;
    }
    let lengths = lengths(form);
    let sides = sides::read(form, points.len());
    let line = match points.len() {
        4 => Some(prescribed::ray(form, "line")?),
        _ => None,
    };
    Some(Box::new(PathTask::Several { points, a: a?, lengths: lengths?, sides: sides?, line }))
}

/// Reads crank and BE (m).
fn lengths(form: &TaskForm) -> Option<[f64; 2]> {
    let (crank, be) = (form.need_size("crank", "\"30 mm\""), form.need_size("BE", "\"80 mm\""));
    Some([crank?, be?])
}

impl Wish for PathTask {
    fn title(&self) -> Both {
        match self {
            PathTask::Three { .. } | PathTask::Turned { .. } => {
                both!("Four-bar whose coupler point passes three places")
            }
            PathTask::Prescribed(Prescribed { points, .. }) | PathTask::Several { points, .. } => {
                both!("Four-bar whose coupler point passes {} places", points.len())
            }
            PathTask::Many { points, .. } => {
                both!("Four-bar whose coupler point passes near {} places", points.len())
            }
        }
    }

    fn solve(&self, heading: &Heading) -> Result<TaskResult, Faults> {
        let drafts = match self {
            PathTask::Three { points, pivots, lengths, sides } => {
                of_three(points, *pivots, *lengths, sides, heading)?
            }
            PathTask::Turned { points, pivots, turns } => {
                let found = inversion::turned(points, *pivots, turns, heading);
                vec![found.map_err(|message| {
                    Diagnostic::error("no-real-solution", message).help(unturned())
                })?]
            }
            PathTask::Prescribed(wish) => wish.solve(heading)?,
            PathTask::Several { points, a, lengths, sides, line } => {
                of_several(points, *a, *lengths, sides, *line, heading)?
            }
            PathTask::Many { points, timing, seed } => {
                return searched(points, timing.as_deref(), *seed, heading);
            }
        };
        Ok(TaskResult { drafts, ..TaskResult::default() })
    }

    fn construct(&self, draft: &Draft, board: &mut SynthesisBoard) -> Option<()> {
        // D, and A if not given, come from centre-point curves.
        let found = |letter: &str| {
            Point::new(
                super::statement::of(draft, &format!("{letter}_x")),
                super::statement::of(draft, &format!("{letter}_y")),
            )
        };
        let by_sides = |board: &mut SynthesisBoard,
                        points: &[Point],
                        pivots: [Point; 2],
                        lengths: [f64; 2],
                        sides: &Sides| {
            let ways: Vec<_> = sides
                .all
                .iter()
                .map(|s| {
                    move |b: &mut SynthesisBoard| drawing::by_lengths(b, points, pivots, lengths, s)
                })
                .collect();
            let ways: Vec<&super::board::ConstructionVariant> =
                ways.iter().map(|w| w as &super::board::ConstructionVariant).collect();
            board.meant(draft, &ways)
        };
        match self {
            PathTask::Three { points, pivots, lengths, sides } => {
                by_sides(board, points, *pivots, *lengths, sides)
            }
            PathTask::Turned { points, pivots, turns } => {
                drawing::by_turns(board, points, *pivots, turns)
            }
            PathTask::Prescribed(wish) => {
                drawing::by_turns(board, &wish.points, [found("A"), found("D")], &wish.turns)
            }
            PathTask::Several { points, a, lengths, sides, .. } => {
                by_sides(board, points, [*a, found("D")], *lengths, sides)
            }
            PathTask::Many { points, timing: Some(turns), .. } if is_met(draft) => {
                drawing::by_turns(board, points, [found("A"), found("D")], turns)
            }
            PathTask::Many { .. } => laid::drawn(board, draft),
        }
    }

    fn statement(&self) -> Statement {
        self.stated()
    }

    fn proof(&self, draft: &Draft) -> Vec<Proof> {
        self.proved(draft)
    }
}

/// True if a linkage meets its places exactly, without a search.
fn is_met(draft: &Draft) -> bool {
    draft.targets.is_empty()
}

/// Three places with crank and BE: a linkage for each choice of sides that reaches them.
fn of_three(
    e: &[Point; 3],
    pivots: [Point; 2],
    lengths: [f64; 2],
    sides: &Sides,
    heading: &Heading,
) -> Result<Vec<Draft>, Faults> {
    let mut drafts = Vec::new();
    let mut told: Vec<Both> = Vec::new();
    for s in &sides.all {
        match inversion::three(e, pivots, lengths, s, heading) {
            Ok(draft) => drafts.push(draft),
            Err(message) if !told.contains(&message) => told.push(message),
            Err(_) => {}
        }
    }
    if !drafts.is_empty() {
        return Ok(drafts);
    }
    let mut faults = Faults::default();
    for message in told {
        let help = inversion::nearest(e, pivots, lengths, sides, heading);
        faults.push(Diagnostic::error("no-real-solution", message).help(help));
    }
    Err(faults)
}

/// Four or five places with crank and BE: a linkage for each pivot D that the coupler's positions
/// allow.
fn of_several(
    e: &[Point],
    a: Point,
    lengths: [f64; 2],
    sides: &Sides,
    line: Option<(Point, Vec2)>,
    heading: &Heading,
) -> Result<Vec<Draft>, Faults> {
    let found = |lengths: [f64; 2]| -> Result<Vec<Draft>, Both> {
        let mut drafts = Vec::new();
        let mut unreached = None;
        for s in &sides.all {
            match inversion::pins(e, a, lengths, s) {
                Ok(b) => {
                    let pairs = inversion::followers(e, &b, a, line);
                    let told = |k: usize| both!("{}, pivot {}", sides::told(s), k + 1);
                    drafts.extend(pairs.iter().enumerate().map(|(k, p)| {
                        inversion::draft(e, &b, [a, p.centre], p.pin, told(k), heading)
                    }));
                }
                Err(message) => unreached = Some(message),
            }
        }
        match unreached {
            Some(message) if drafts.is_empty() => Err(message),
            _ => Ok(drafts),
        }
    };
    let scale = a.distance(e[0]) * 1e3;
    let works =
        |l: [f64; 2]| l.iter().all(|x| *x > 0.0) && found(l).is_ok_and(|all| !all.is_empty());
    let message = match found(lengths) {
        Ok(drafts) if !drafts.is_empty() => return Ok(drafts),
        Ok(_) => match line {
            Some(_) => {
                both!("the line does not meet the centre-point curve of the coupler's positions")
            }
            None => both!("the coupler's positions have no further Burmester point"),
        },
        Err(message) => message,
    };
    Err(Diagnostic::error("no-real-solution", message)
        .help(inversion::nearest_lengths(e, a, lengths, scale, works))
        .into())
}

fn unturned() -> Both {
    both!("change one of the crank's angles, or move A")
}

/// Many places: the best optima of a search.
fn searched(
    points: &[Point],
    timing: Option<&[f64]>,
    seed: u64,
    heading: &Heading,
) -> Result<TaskResult, Faults> {
    let found = match timing {
        None => search::search(points, seed),
        Some(turns) => timed::search(points, turns, seed),
    };
    let (_, extent) = search::extent(points);
    let told = |f: &Fit| {
        let mut draft = of_fit(points, f, heading)?;
        draft.remarks.extend(search::remarks(f, points));
        Some(draft)
    };
    // Five places at given rotations determine ten unknowns: exact solutions are found without a
    // search.
    let met = match timing {
        Some(turns) if points.len() == 5 => {
            let wish = Prescribed { points: points.to_vec(), turns: turns.to_vec(), lines: None };
            let longest = |d: &Draft| {
                ["AB", "BC", "CD", "AD", "BE"]
                    .map(|n| super::statement::of(d, n))
                    .into_iter()
                    .fold(0.0, f64::max)
            };
            wish.linkages(heading)
                .into_iter()
                .filter(|d| longest(d) <= search::LARGEST * extent)
                .collect()
        }
        Some(_) | None => Vec::new(),
    };
    let near =
        found.fits.iter().filter(|f| met.is_empty() || f.rms > MET * extent).filter_map(told);
    let drafts: Vec<Draft> = met.iter().cloned().chain(near).collect();
    let numbers = vec![
        DesignNumber::ratio("evaluations", both!("positions evaluated"), found.evaluations as f64),
        DesignNumber::ratio("restarts", both!("runs of the search"), found.runs as f64),
    ];
    if drafts.is_empty() {
        let message = both!("the search found no crank-rocker near these places");
        let help = both!("order the points along the path, or try another \"seed\"");
        return Err(Diagnostic::error("no-real-solution", message).help(help).into());
    }
    Ok(TaskResult { drafts, numbers, notes: Vec::new() })
}

/// The design of a search result: its scene is required to reach the places that the result
/// actually has; their distances from the given places are numbers.
fn of_fit(points: &[Point], fit: &Fit, heading: &Heading) -> Option<Draft> {
    let l = &fit.linkage;
    let at: Vec<search::PositionPoints> =
        fit.cranks.iter().map(|t| l.place(*t)).collect::<Option<_>>()?;
    let first = at.first()?;
    let four = FourBar { a: l.a, b: first.b, c: first.c, d: l.d(), e: Some(l.e) };
    let wanted = fit
        .cranks
        .iter()
        .zip(&at)
        .map(|(t, p)| WantedPosition {
            driver: *t,
            places: vec![("B".into(), p.b), ("C".into(), p.c), ("E".into(), p.e)],
        })
        .collect();
    let far: Vec<f64> = points.iter().zip(&at).map(|(p, q)| p.distance(q.e)).collect();
    let mut numbers = named_lengths(four.lengths());
    numbers.push(DesignNumber::length("A_x", both!("place of A"), l.a.x));
    numbers.push(DesignNumber::length("A_y", both!("place of A"), l.a.y));
    numbers.push(DesignNumber::angle(
        "phi",
        both!("direction of the frame"),
        l.phi - TAU * libm::rint(l.phi / TAU),
    ));
    numbers.push(DesignNumber::length("u", both!("E along BC from B"), l.e.x));
    numbers.push(DesignNumber::length("v", both!("E to the left of BC"), l.e.y));
    numbers.push(DesignNumber::angle(
        "crank_1",
        both!("crank angle at place 1"),
        fit.cranks[0] - TAU * libm::rint(fit.cranks[0] / TAU),
    ));
    numbers.push(DesignNumber::length("rms", both!("root mean square distance"), fit.rms));
    numbers.push(DesignNumber::length(
        "max",
        both!("greatest distance"),
        far.iter().copied().fold(0.0, f64::max),
    ));
    numbers.extend(laid::distances(&far, search::extent(points).1));
    let which = both!("root mean square distance {} mm", significant(fit.rms * 1e3, 4));
    Some(Draft {
        ordered: true,
        error: fit.rms,
        targets: points.to_vec(),
        ..Draft::new(which, four.scene(heading), numbers, wanted)
    })
}
