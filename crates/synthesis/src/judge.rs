//! Judging of a design by its scene as written: its actual motion, defects, transmission angle,
//! Grashof type.
//!
//! The scene is read back, placed and swept by the modules that every other scene uses,
//! independently of the formula that gave the design. A wanted position is reached if the sweep
//! from the first position arrives there without leaving its branch. A position that is not reached
//! is on another branch (the driver would have to pass a dead centre) or on another circuit (no
//! motion joins the two). The two cases are distinguished by driving the other links, and by
//! Grashof's invariant where no single link drives through.

use super::candidate::{Demand, DesignCandidate, Draft, WantedPosition, scene_text};
use super::order;
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::digits::{metres, significant};
use hodograph_base::geom::Point;
use hodograph_mechanism::mechanism::Mechanism;
use hodograph_scene::{self as scene, Scene};
use hodograph_sweep::extreme::{Grashof, MotionLimits, limits};
use hodograph_sweep::station::position_now;
use hodograph_sweep::{PlacedScene, Stations, Sweep, Table, Width};
use serde_json::{Value as Json, json};
use std::f64::consts::{PI, TAU};

/// A place farther off than this share of the size is not reached. The formula leaves some 1e-13;
/// another assembly is off by whole lengths, except for positions next to a dead centre, where the
/// two agree to half the digits.
const REACHED: f64 = 1e-9;

/// The least acceptable transmission angle if the task gives none (rad): 40° as in course books.
pub const USUAL_GAMMA: f64 = 40.0 * PI / 180.0;

/// Results of the finished scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Judged {
    /// The largest distance of a wanted place from the actual one (m), over the positions reached.
    pub off_m: f64,
    /// The size of the mechanism (m).
    pub size_m: f64,
    /// The least transmission angle and the driver's position there (rad): over the whole turn, or
    /// between the wanted positions.
    pub transmission: Option<(f64, f64)>,
    /// The type of a four-bar.
    pub grashof: Option<Grashof>,
    /// True if the driver turns fully.
    pub rotates: bool,
    /// The time ratio of the last output that has one.
    pub time_ratio: Option<f64>,
    /// The stroke of that output (rad or m).
    pub stroke: Option<f64>,
    /// Circuit, branch and order defects, and a driver that is no crank where one is demanded.
    pub defects: Vec<Diagnostic>,
    /// Further remarks from the sweep.
    pub remarks: Vec<Diagnostic>,
}

/// Judges a draft; `gamma` is the least acceptable transmission angle (rad).
///
/// # Errors
/// A scene that cannot be read or placed, which is an error of this program: impossible drafts have
/// none.
pub fn judge(draft: Draft, gamma: f64) -> Result<DesignCandidate, Faults> {
    let text = scene_text(&draft.scene);
    let scene = scene::read(&text)?.value;
    let mechanism = Mechanism::new(&scene)?.value;
    let limits = limits(&scene, &mechanism, 0)?;
    let mut judged = Judged {
        rotates: limits.range.full(),
        grashof: limits.grashof.map(|g| g.0),
        ..Judged::default()
    };
    let output = limits.swings.iter().rev().find(|s| s.stroke.is_some());
    judged.time_ratio = output.and_then(|s| s.time_ratio);
    judged.stroke = output.and_then(|s| s.stroke);
    let walk = Walk::new(&draft.scene, &limits)?;
    judged.size_m = walk.size_m;
    let drivers = positions(&draft, &walk, &mut judged);
    if draft.ordered {
        // A position on another circuit is still met at its own angle once the linkage is
        // reassembled.
        let at = |i: usize, angle: f64| {
            drivers.iter().find(|d| d.0 == i).map_or_else(|| walk.nearest(angle), |d| d.1)
        };
        let all: Vec<(usize, f64)> =
            draft.wanted.iter().enumerate().map(|(i, w)| (i, at(i, w.driver))).collect();
        judged.defects.extend(order::defect(&all, judged.rotates));
    }
    // A function prescribes the driver's angles, not its places alone.
    if !draft.course.is_empty() && !judged.rotates && judged.defects.is_empty() {
        judged.defects.extend(turned_otherwise(&draft, &drivers));
    }
    judged.transmission =
        if judged.rotates { least(&limits) } else { walk.transmission(&drivers, least(&limits)) };
    if let Some((angle, _)) = judged.transmission.filter(|(angle, _)| *angle < gamma - 1e-9) {
        let message = both!(
            "the transmission angle falls to {}°; {}° is wanted",
            significant(angle.to_degrees(), 4),
            significant(gamma.to_degrees(), 4)
        );
        judged.remarks.push(Diagnostic::warning("poor-transmission", message));
    }
    demands(&draft, &mut judged);
    Ok(DesignCandidate { draft, judged })
}

/// Adds defects for demands on the whole motion that are not met.
fn demands(draft: &Draft, judged: &mut Judged) {
    for demand in &draft.demands {
        let missed = match *demand {
            Demand::FullTurn => (!judged.rotates).then(|| both!("the driver does not turn fully")),
            Demand::TimeRatio(k) => off(judged.time_ratio, k)
                .then(|| told(judged.time_ratio, &both!("time ratio"), k, |v| significant(v, 6))),
            Demand::Stroke(h) => {
                off(judged.stroke, h).then(|| told(judged.stroke, &both!("stroke"), h, metres))
            }
            Demand::Swing(psi) => {
                let degrees = |v: f64| format!("{}°", significant(v.to_degrees(), 6));
                off(judged.stroke, psi).then(|| told(judged.stroke, &both!("swing"), psi, degrees))
            }
        };
        if let Some(message) = missed {
            let code = if *demand == Demand::FullTurn { "not-a-crank" } else { "defect-branch" };
            judged.defects.push(Diagnostic::warning(code, message));
        }
    }
}

/// True if a value of the whole motion differs from the wanted one. Extremes are located to some
/// 1e-12, and so is a stroke between them.
fn off(real: Option<f64>, wanted: f64) -> bool {
    real.is_none_or(|r| (r - wanted).abs() > 1e-9 * wanted.abs().max(1e-3))
}

fn told(real: Option<f64>, what: &Both, wanted: f64, written: impl Fn(f64) -> String) -> Both {
    let real = real.map_or("—".to_owned(), &written);
    both!("the whole motion has the {} {} instead of {}", what, real, written(wanted))
}

fn least(limits: &MotionLimits) -> Option<(f64, f64)> {
    limits.transmission.iter().map(|t| (t.angle, t.driver)).min_by(|a, b| a.0.total_cmp(&b.0))
}

/// Visits all wanted positions; returns the driver's position at those that are reached, in the
/// order of the draft.
fn positions(draft: &Draft, walk: &Walk, judged: &mut Judged) -> Vec<(usize, f64)> {
    let mut reached = Vec::new();
    let mut others: [Vec<usize>; 2] = Default::default();
    for (i, wanted) in draft.wanted.iter().enumerate() {
        match walk.reach(wanted) {
            Some((driver, off_m)) => {
                judged.off_m = judged.off_m.max(off_m);
                reached.push((i, driver));
            }
            None => others
                [usize::from(walk.other_circuit(&draft.scene, draft.wanted.first(), wanted))]
            .push(i),
        }
    }
    let [branch, circuit] = others;
    if !branch.is_empty() {
        let message = both!(
            "position {} lies beyond a dead point of the driver, seen from position 1",
            listed(&branch)
        );
        judged.defects.push(Diagnostic::warning("defect-branch", message));
    }
    if !circuit.is_empty() {
        let message = both!(
            "position {} lies on another circuit than position 1: no motion joins them",
            listed(&circuit)
        );
        judged.defects.push(Diagnostic::warning("defect-circuit", message));
    }
    reached
}

/// Positions by their numbers from 1, consecutive ones as a range.
fn listed(all: &[usize]) -> Both {
    let mut rows: Vec<[usize; 2]> = Vec::new();
    for i in all {
        match rows.last_mut() {
            Some(row) if row[1] + 1 == *i => row[1] = *i,
            _ => rows.push([*i, *i]),
        }
    }
    let told = |[from, to]: &[usize; 2]| match to - from {
        0 => vec![format!("{}", from + 1)],
        1 => vec![format!("{}", from + 1), format!("{}", to + 1)],
        _ => vec![format!("{}–{}", from + 1, to + 1)],
    };
    let each: Vec<String> = rows.iter().flat_map(told).collect();
    Both::names(&each)
}

/// Reports positions that an oscillating driver meets with another number of turns than wanted: its
/// angles, full turns included, count from position 1.
fn turned_otherwise(draft: &Draft, drivers: &[(usize, f64)]) -> Option<Diagnostic> {
    let start = drivers.iter().find(|d| d.0 == 0)?.1;
    let turn = |i: usize| draft.wanted[i].driver - draft.wanted[0].driver;
    let other: Vec<usize> = drivers
        .iter()
        .filter(|(i, at)| (at - start - turn(*i)).abs() > REACHED)
        .map(|d| d.0)
        .collect();
    let message = both!(
        "the driver does not turn fully: it comes to position {} by another turn than the wanted one",
        listed(&other)
    );
    (!other.is_empty()).then(|| Diagnostic::warning("defect-order", message))
}

/// A scene that gives the places of its points at a position of its driver.
struct Walk {
    scene: Scene,
    mechanism: Mechanism,
    range: [f64; 2],
    full: bool,
    size_m: f64,
    grashof: Option<(Grashof, [f64; 4])>,
}

impl Walk {
    /// The results asked of the scene are the places of all its points.
    fn new(scene: &Json, limits: &MotionLimits) -> Result<Walk, Faults> {
        let text = scene_text(scene);
        let plain = scene::read(&text)?.value;
        let all: Vec<String> = plain
            .points
            .iter()
            .flat_map(|p| [format!("x_{}", p.name), format!("y_{}", p.name)])
            .collect();
        let scene = scene::read_asking(&text, &all.join(", "))?.value;
        let mechanism = Mechanism::new(&scene)?.value;
        let size_m = PlacedScene::new(&scene, &mechanism)?.at.extent();
        let (range, full) = (limits.range.bounds(), limits.range.full());
        Ok(Walk { scene, mechanism, range, full, size_m, grashof: limits.grashof })
    }

    fn table(&self, drivers: Vec<f64>) -> Option<Table> {
        let placed = PlacedScene::new(&self.scene, &self.mechanism).ok()?;
        Some(Sweep::new(&placed, 0).ok()?.run(
            &Stations::of_values(drivers, 1.0),
            Width::One,
            Table::default(),
        ))
    }

    /// The angle, changed by full turns, nearest to the driver's position in the scene.
    fn nearest(&self, angle: f64) -> f64 {
        let now = PlacedScene::new(&self.scene, &self.mechanism)
            .map_or(angle, |p| position_now(&self.scene, &p.at, 0));
        angle - TAU * libm::rint((angle - now) / TAU)
    }

    /// The possible driver positions for a wanted angle: the one nearest to the scene's position,
    /// or all within the range.
    fn drivers(&self, angle: f64) -> Vec<f64> {
        let near = self.nearest(angle);
        if self.full {
            return vec![near];
        }
        let [low, high] = self.range;
        let inside = |x: &f64| (low - REACHED..=high + REACHED).contains(x);
        [near, near + TAU, near - TAU]
            .into_iter()
            .filter(inside)
            .map(|x| x.max(low).min(high))
            .collect()
    }

    /// The driver's position at which all places are as wanted, and the largest distance left (m).
    fn reach(&self, wanted: &WantedPosition) -> Option<(f64, f64)> {
        let off = |driver: &f64| {
            let table = self.table(vec![*driver])?;
            let far =
                wanted.places.iter().map(|(name, at)| Some(found(&table, name, 0)?.distance(*at)));
            far.collect::<Option<Vec<f64>>>()?.into_iter().reduce(f64::max)
        };
        let all = self.drivers(wanted.driver).into_iter().filter_map(|d| Some((d, off(&d)?)));
        all.filter(|(_, off)| *off <= REACHED * self.size_m).min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// True if no motion joins a position with the first one: neither driving the follower nor the
    /// coupler leads there, and the circuits of a Grashof chain differ.
    fn other_circuit(
        &self,
        scene: &Json,
        first: Option<&WantedPosition>,
        wanted: &WantedPosition,
    ) -> bool {
        let Some((_, [a, b, c, d])) = self.grashof else { return false };
        let mut sorted = [a, b, c, d];
        sorted.sort_by(f64::total_cmp);
        // Without a link that turns fully, all assemblies are joined.
        if sorted[0] + sorted[3] > sorted[1] + sorted[2] {
            return false;
        }
        let joined = ["3", "2"]
            .iter()
            .any(|link| first.is_some_and(|first| driven_by(scene, link, first, wanted)));
        let side = |w: &WantedPosition| {
            let at = |name: &str| {
                w.places
                    .iter()
                    .find(|(n, _)| n == name)
                    .map(|(_, p)| *p)
                    .or_else(|| self.fixed(name))
            };
            let [pa, pb, pc, pd] = ["A", "B", "C", "D"].map(at);
            invariant([pa?, pb?, pc?, pd?], [a, b, c, d])
        };
        !joined && first.and_then(side) != side(wanted)
    }

    fn fixed(&self, name: &str) -> Option<Point> {
        found(
            &self.table(vec![self.drivers(0.0).first().copied().unwrap_or(self.range[0])])?,
            name,
            0,
        )
    }

    /// The least transmission angle of a four-bar between the wanted positions; `of_all` is the
    /// exact one of the whole range, which applies if it is between them.
    fn transmission(
        &self,
        drivers: &[(usize, f64)],
        of_all: Option<(f64, f64)>,
    ) -> Option<(f64, f64)> {
        const STEPS: usize = 360;
        const NEAR: f64 = 1e-9;
        let low = drivers.iter().map(|d| d.1).fold(f64::INFINITY, f64::min);
        let high = drivers.iter().map(|d| d.1).fold(f64::NEG_INFINITY, f64::max);
        self.grashof?;
        // A wanted position that is a limit misses it by the rounding of the lengths.
        let between = |(_, at): &(f64, f64)| {
            (low - NEAR * (high - low)..=high + NEAR * (high - low)).contains(at)
        };
        if let Some(least) = of_all.filter(between) {
            return Some(least);
        }
        let table = self
            .table((0..=STEPS).map(|i| low + (high - low) * i as f64 / STEPS as f64).collect())?;
        let angle = |row: usize| {
            let at = |name| found(&table, name, row);
            let (u, v) = (at("B")? - at("C")?, at("D")? - at("C")?);
            Some((libm::atan2(u.cross(v).abs(), u.dot(v).abs()), table.columns[0].values[row]))
        };
        (0..table.rows()).filter_map(angle).min_by(|a, b| a.0.total_cmp(&b.0))
    }
}

/// A point's place in a row of a table.
fn found(table: &Table, name: &str, row: usize) -> Option<Point> {
    let of = |axis: char| table.column(&format!("{axis}_{name}"))?.values.get(row).copied();
    Some(Point::new(of('x')?, of('y')?))
}

/// The circuit of a Grashof chain in a position: the sense of the angle at a joint that is on
/// neither end of the shortest link. This angle never becomes 0 or 180°.
fn invariant([a, b, c, d]: [Point; 4], [ab, bc, cd, ad]: [f64; 4]) -> Option<bool> {
    let sense = |p: Point, q: Point, r: Point| (p - q).cross(r - q) > 0.0;
    let least = ab.min(bc).min(cd).min(ad);
    Some(if least == ab || least == ad { sense(b, c, d) } else { sense(d, a, b) })
}

/// True if driving another link leads from one position to another.
fn driven_by(scene: &Json, link: &str, from: &WantedPosition, to: &WantedPosition) -> bool {
    let reached = || -> Option<bool> {
        let mut scene = scene.clone();
        let at = |w: &WantedPosition, name: &str| {
            w.places.iter().find(|(n, _)| n == name).map(|(_, p)| *p)
        };
        let object = scene.as_object_mut()?;
        let ends = object
            .get("links")?
            .get(link)?
            .as_array()?
            .iter()
            .filter_map(Json::as_str)
            .map(str::to_owned)
            .collect::<Vec<_>>();
        let fixed = |name: &str| {
            let at = object.get("points")?.get(name)?.as_array()?;
            let of = |i: usize| at.get(i)?.as_str()?.strip_suffix(" mm")?.parse::<f64>().ok();
            Some(Point::new(of(0)? * 1e-3, of(1)? * 1e-3))
        };
        let [p, q] = [ends.first()?, ends.get(1)?];
        let angle = |w: &WantedPosition| {
            Some((at(w, q).or_else(|| fixed(q))? - at(w, p).or_else(|| fixed(p))?).angle())
        };
        let (now, then) = (angle(from)?, angle(to)?);
        object.shift_remove("side");
        object.insert(
            "driver".into(),
            json!({"link": link, "angle": format!("{now} rad"), "omega": "1 rad/s"}),
        );
        let sketch = |name: &str| at(from, name).map(|p| json!([p.x * 1e3, p.y * 1e3]));
        let rough: serde_json::Map<String, Json> =
            ["B", "C"].iter().filter_map(|n| Some(((*n).to_owned(), sketch(n)?))).collect();
        object.insert("sketch".into(), Json::Object(rough));
        let text = scene_text(&scene);
        let read = scene::read(&text).ok()?.value;
        let mechanism = Mechanism::new(&read).ok()?.value;
        let limits = limits(&read, &mechanism, 0).ok()?;
        let walk = Walk::new(&scene, &limits).ok()?;
        Some(walk.reach(&WantedPosition { driver: then, places: to.places.clone() }).is_some())
    };
    reached().unwrap_or(false)
}

/// A deviation below this share of the size is the rounding of the lengths.
const ROUNDING: f64 = 1e-12;

/// The text that states the distance of the finished scene from the wanted places.
pub fn accuracy(candidate: &DesignCandidate) -> Both {
    let judged = &candidate.judged;
    if judged.off_m <= ROUNDING * judged.size_m {
        let size = metres(judged.size_m);
        // Between its precision points a function has its structural error.
        return if candidate.draft.course.is_empty() {
            both!("what was wanted is met exactly (size {size})")
        } else {
            both!("the precision points are met exactly (size {size})")
        };
    }
    both!("greatest deviation {} (size {})", metres(judged.off_m), metres(judged.size_m))
}
