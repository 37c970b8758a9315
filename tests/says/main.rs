//! A sweep agrees with `solve`: every quantity that a scene can ask for, at eight positions of each
//! of its drivers, is compared with the scene that is written for that position and solved alone.
//! That scene is given the driver's position, the coordinates of moving points, and rough places of
//! joints.
//!
//! One scene of 24 is examined. `HODOGRAPH_SAYS=all cargo test --test says` examines all 550;
//! `HODOGRAPH_SAYS=3/8` the third of eight parts of them, `HODOGRAPH_SAYS=cam` those with this in
//! their names.

mod in_time;
mod moved;
mod scenes;

use hodograph::diag::Faults;
use hodograph::geom::Vec2;
use hodograph::mechanism::Mechanism;
use hodograph::position;
use hodograph::scene::{self, Find, Scene};
use hodograph::sweep::batch::{Batch, ParameterChoice};
use hodograph::sweep::follow::course::over_a_turn;
use hodograph::sweep::limit::DriverRange;
use hodograph::sweep::long::LongSweep;
use hodograph::sweep::pieces::gather;
use hodograph::sweep::vary::Variation;
use hodograph::sweep::{
    self, PlacedScene, StationSteps, Stations, Table, Width, compile, extreme, station,
};
use in_time::compare_in_time;
use moved::{Moved, Single, solved};
use rayon::prelude::*;
use scenes::{askable, has_line, read, scenes};
use serde_json::Value as Json;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// The word for all scenes.
const ALL: &str = "all";

/// The requested scenes: all, those with a part of a name, or an empty text for a sample.
fn asked() -> String {
    std::env::var("HODOGRAPH_SAYS").unwrap_or_default()
}

/// The requested part of all scenes, `3/8`: its number, and the number of parts.
fn part(asked: &str) -> Option<(usize, usize)> {
    let (k, n) = asked.split_once('/')?;
    k.parse().ok().zip(n.parse().ok()).filter(|(_, n)| *n > 0)
}

/// Scenes that are always examined: questions without a value in some rows, beyond a change point;
/// a ratio of links that turn by rounding only; a point of a frame that is its pole; a cam behind
/// wheels with a given angle.
const ALWAYS: [&str; 4] = [
    "third-crank",
    "cases/hit-7.17",
    "problems/scissor-lift",
    "problems/cam-shaft-behind-ring-gear",
];

/// Positions of a driver.
const POSITIONS: usize = 8;

/// The place of the first position, as a part of the step: not a multiple of usual numbers.
const OFF: f64 = 0.37;

/// Distances beyond every paper, as a multiple of the mechanism's size.
const FAR: f64 = 1e9;

/// Counts and differences of the comparison.
#[derive(Default)]
struct Tally {
    faults: Vec<String>,
    scenes: usize,
    compared: usize,
    /// Positions that the scene's format cannot express, and those next to a singular pose.
    unsaid: usize,
    singular: usize,
    /// Scenes and drivers without any comparison.
    idle: Vec<String>,
}

impl Tally {
    fn join(mut self, other: Tally) -> Tally {
        self.faults.extend(other.faults);
        self.scenes += other.scenes;
        self.compared += other.compared;
        self.unsaid += other.unsaid;
        self.singular += other.singular;
        self.idle.extend(other.idle);
        self
    }

    /// Compares a number of a table with the expected one; `size` is the size of quantities with
    /// its unit, `largest` the largest number of the answer.
    fn check(
        &mut self,
        what: &dyn Fn() -> String,
        unit: &str,
        [got, expected]: [f64; 2],
        [size, largest]: [f64; 2],
        condition: f64,
    ) {
        self.compared += 1;
        let off = (got - expected).abs();
        let off = if unit == "rad" { off.min((off - TAU).abs()) } else { off };
        // The radius of a straight piece is infinite up to rounding.
        if unit == "m" && got.abs().min(expected.abs()) > FAR * size {
            return;
        }
        // A distant place is an intersection of nearly parallel lines, which rounding moves along
        // them.
        let far = size.max(largest);
        let allowed = 1e-9
            * far
            * (2.0 + 1e-3 * far / size.max(f64::MIN_POSITIVE))
            * (1e-2 * condition).max(1.0);
        if off > allowed || got.is_nan() {
            self.faults.push(format!("{}: {got:e}, solve says {expected:e}", what()));
        }
    }
}

/// The size of quantities with a unit: that of the mechanism and its drivers.
fn size(unit: &str, scene: &Scene, extent: f64) -> f64 {
    // A driver at rest is judged by its velocity after moving by its own size.
    let own = |d: &scene::Driver, rate: f64| rate.abs() / if d.kind.turns() { 1.0 } else { extent };
    let rate = |d: &scene::Driver| {
        own(d, d.rate.value).max(own(d, d.acceleration.as_ref().map_or(0.0, |a| a.value)).sqrt())
    };
    let rate = scene.drivers.iter().map(rate).fold(0.0f64, f64::max);
    match unit {
        "m" => extent,
        "m/s" => extent * rate,
        "m/s²" => extent * rate * rate,
        "rad/s" => rate,
        "rad/s²" => rate * rate,
        _ => 1.0,
    }
}

/// The rows of a table by the value of the swept variable.
fn rows(table: &Table, values: &[f64]) -> Vec<Option<usize>> {
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-12 * a.abs().max(1e-3);
    values.iter().map(|v| table.columns[0].values.iter().position(|x| near(*x, *v))).collect()
}

/// Eight values of a driver: within a turn, or within its travel.
fn values(swept: &Scene, m: &Mechanism, placed: &PlacedScene, driver: usize) -> Vec<f64> {
    let now = station::position_now(swept, &placed.at, driver);
    let [low, high] = if swept.drivers[driver].kind.turns() {
        [now, now + TAU]
    } else {
        extreme::limits(swept, m, driver).map_or([now, now], |l| l.range.bounds())
    };
    (0..POSITIONS).map(|k| low + (high - low) * (k as f64 + OFF) / POSITIONS as f64).collect()
}

/// The numbers of an answer; empty if there is none.
fn values_of<'a>(single: Option<&'a Single>, find: &Find) -> &'a [f64] {
    single.and_then(|s| s.answers.get(&find.text)?.as_deref()).unwrap_or_default()
}

fn asking(scene: &Scene, find: &[Find]) -> Scene {
    Scene { find: find.to_vec(), ..scene.clone() }
}

/// The scene swept in each of the ways of the program.
fn tables(
    scene: &Scene,
    m: &Mechanism,
    driver: usize,
    values: &[f64],
) -> Vec<(&'static str, Table)> {
    let placed = match PlacedScene::new(scene, m) {
        Ok(placed) => placed,
        Err(_) => return Vec::new(),
    };
    let per_value = station::angle_per_value(scene, &placed.at, driver);
    let stations = Stations::of_values(values.to_vec(), per_value);
    let mut out = vec![("curves", sweep::run(&placed, driver, &stations, Width::Widest).unwrap())];
    let [first, last] = [values[0], values[values.len() - 1]];
    let way = if scene.drivers[driver].kind.turns() {
        station::DriverSpan::Turn(scene::Angle::Rad(first), scene::Angle::Rad(last))
    } else {
        station::DriverSpan::Slide { from: first, to: last, per_value }
    };
    out.push((
        "sweep",
        gather(
            &mut LongSweep::new(&placed, driver, StationSteps { way, steps: values.len() - 1 })
                .unwrap(),
        ),
    ));
    if let Ok(variation) = Variation::new(scene, &[]) {
        let batch = Batch {
            scene,
            mechanism: m,
            variation,
            values: Vec::new(),
            choice: ParameterChoice::Grid,
            driver,
            stations: Some(stations),
        };
        let block = batch.block(0, 1);
        let heads = batch.columns().into_iter().zip(block.columns).skip(1);
        let columns =
            heads.map(|((name, unit), values)| sweep::Column { name, unit, values }).collect();
        out.push(("batch", Table { columns, notes: Vec::new() }));
    }
    out
}

/// True if a driver reaches a value, or one that differs by whole turns.
fn goes_there(range: &DriverRange, value: f64, turns: bool) -> bool {
    let [low, high] = range.bounds();
    range.full()
        || if turns {
            low <= value + TAU * ((high - value) / TAU).floor()
        } else {
            (low..=high).contains(&value)
        }
}

/// Compares every question of a scene, with its driver at eight places.
fn compare(name: &str, json: &Json, tally: &mut Tally) {
    let Ok(plain) = scene::read(json.to_string()).map(|s| s.value) else { return };
    if plain.drivers.is_empty() || plain.has_laws_of_time() {
        return;
    }
    let find = askable(json, &plain);
    let plain = match read(json, &find) {
        Ok(plain) => plain,
        Err(f) => {
            return tally.faults.push(format!("{name}: the questions are not taken together: {f}"));
        }
    };
    if solved(&plain, None).is_err() {
        return;
    }
    tally.scenes += 1;
    let swept = over_a_turn(&plain);
    let m = match sweep::mechanism(&swept) {
        Ok(m) => m,
        Err(f) => return tally.faults.push(format!("{name}: {f}")),
    };
    let placed = match PlacedScene::new(&swept, &m) {
        Ok(placed) => placed,
        Err(f) => return tally.faults.push(format!("{name}: {f}")),
    };
    let extent = placed.at.extent();
    for driver in (0..plain.drivers.len()).filter(|d| !swept.is_led(*d)) {
        let before = tally.compared;
        let values = values(&swept, &m, &placed, driver);
        // All places, to be written into the single scenes.
        let of_places = |f: &&Find| ["x_", "y_", "phi_"].iter().any(|s| f.text.starts_with(s));
        let places: Vec<Find> = swept.find.iter().filter(of_places).cloned().collect();
        let scene = asking(&swept, &places);
        let Ok(there) = PlacedScene::new(&scene, &m) else { continue };
        let Some(table) = sweep::of_values(&there, driver, values.clone()) else { continue };
        let at = rows(&table, &values);
        let base = sweep::of_values(
            &there,
            driver,
            vec![station::position_now(&scene, &there.at, driver)],
        );
        let number = |name: &str, row: usize| table.column(name).map(|c| c.values[row]);
        let moved = Moved {
            json,
            plain: &plain,
            driver,
            at: &placed.at,
            now: station::position_now(&swept, &placed.at, driver),
        };
        let mut singles: Vec<Result<Single, String>> = Vec::new();
        let mut said: Vec<bool> = Vec::new();
        for (value, row) in values.iter().zip(&at) {
            let place = |p: &scene::NamedPoint| {
                let row = (*row)?;
                Some((
                    p.name.clone(),
                    [
                        number(&format!("x_{}", p.name), row)?,
                        number(&format!("y_{}", p.name), row)?,
                    ],
                ))
            };
            let turn = |l: &scene::Link| {
                let column = format!("phi_{}", l.name);
                Some((
                    l.name.clone(),
                    number(&column, (*row)?)? - base.as_ref()?.column(&column)?.values.first()?,
                ))
            };
            let places = swept.points.iter().filter_map(place).collect();
            let mut turned: BTreeMap<String, f64> = swept.links.iter().filter_map(turn).collect();
            // A rack of one point has no angle to ask for: it turns with the direction from the
            // wheel's centre to the contact.
            for [link, centre, contact] in moved::touching(json) {
                let way = |table: &Table, row: usize| {
                    let number = |axis: &str, p: &str| {
                        table.column(&format!("{axis}_{p}"))?.values.get(row).copied()
                    };
                    Some(
                        ["x", "y"]
                            .map(|axis| Some(number(axis, &contact)? - number(axis, &centre)?)),
                    )
                    .and_then(|[x, y]| Some(Vec2::new(x?, y?)))
                };
                let by = || Some(way(&table, (*row)?)?.divide_by(way(base.as_ref()?, 0)?).angle());
                if !turned.contains_key(&link)
                    && let Some(by) = by()
                {
                    turned.insert(link, by);
                }
            }
            let written = moved.at(*value, &places, &turned);
            said.push(written.is_some());
            let single = written
                .ok_or_else(Faults::default)
                .and_then(|json| read(&json, &find))
                .and_then(|scene| solved(&scene, Some(driver)));
            singles.push(
                single.map_err(|f| f.list.first().map_or(String::new(), |d| d.message.en.clone())),
            );
        }
        for (k, single) in singles.iter().enumerate() {
            let Ok(single) = single else { continue };
            let turns = swept.drivers[driver].kind.turns();
            let off = if turns {
                Vec2::from_angle(single.value - values[k]).angle()
            } else {
                (single.value - values[k]) / extent
            };
            let lies = swept.drivers[driver]
                .kind
                .turned()
                .map_or(moved.told(), |(l, _)| has_line(&plain, l, &json.to_string()));
            if off.abs() > 1e-9 && single.condition < 1e6 && lies {
                let at = values[k];
                tally.faults.push(format!(
                    "{name} driver {driver} at {at}: by the places of the sweep it stands at {}",
                    single.value
                ));
            }
        }
        let range = extreme::limits(&swept, &m, driver).map(|l| l.range);
        let reached = |value: f64| {
            range
                .as_ref()
                .map_or(true, |range| goes_there(range, value, swept.drivers[driver].kind.turns()))
        };
        let compiled = |f: &Find| {
            compile(&swept, &m, &placed.at, Some(driver), std::slice::from_ref(f)).is_ok()
        };
        // Questions answered in every position are asked together, separated by whether they have a
        // kernel; all others are asked alone.
        let everywhere = |f: &Find| {
            singles.iter().flatten().all(|s| s.answers.get(&f.text).is_some_and(Option::is_some))
        };
        let (whole, parts): (Vec<Find>, Vec<Find>) =
            swept.find.iter().cloned().partition(everywhere);
        let (kernels, others): (Vec<Find>, Vec<Find>) = whole.into_iter().partition(compiled);
        let alone = parts
            .iter()
            .step_by(if asked() == ALL || part(&asked()).is_some() {
                1
            } else {
                (parts.len() / 4).max(1)
            })
            .map(|f| vec![f.clone()]);
        for group in [kernels, others].into_iter().filter(|g| !g.is_empty()).chain(alone) {
            let scene = asking(&swept, &group);
            for (way, table) in tables(&scene, &m, driver, &values) {
                let at = rows(&table, &values);
                for (k, single) in singles.iter().enumerate() {
                    if !said[k] {
                        tally.unsaid += 1;
                        continue;
                    }
                    let here = |what: &str| {
                        format!(
                            "{name} {way} over {} at {:?}: {what}",
                            swept.driver_name(driver).0,
                            values[k]
                        )
                    };
                    let answered = single
                        .as_ref()
                        .ok()
                        .filter(|s| s.answers.get(&group[0].text).is_some_and(Option::is_some));
                    if single.as_ref().is_ok_and(|s| s.condition > 1e6) {
                        tally.singular += 1;
                        continue;
                    }
                    // A place or a radius beyond the paper is infinite up to rounding: a straight
                    // path, a link that does not turn.
                    let off_paper = |v: &f64| v.is_finite() && v.abs() > FAR * extent;
                    let off_paper_in_row = || {
                        at[k].is_some_and(|row| {
                            table.columns[1..].iter().any(|c| off_paper(&c.values[row]))
                        })
                    };
                    if group[0].what.kind() == scene::Kind::Length
                        && (values_of(answered, &group[0]).iter().any(off_paper)
                            || answered.is_none() && off_paper_in_row())
                    {
                        continue;
                    }
                    // Outside the range of the motion `solve` may find another assembly.
                    if at[k].is_none() && !reached(values[k]) {
                        tally.unsaid += 1;
                        continue;
                    }
                    let (Some(single), Some(row)) = (answered, at[k]) else {
                        // A position that the file cannot express may still be reached by the
                        // mechanism.
                        if answered.is_some() != at[k].is_some()
                            && (answered.is_some() || single.is_ok())
                        {
                            let told = if at[k].is_some() {
                                "a row that solve refuses"
                            } else {
                                "no row, solve answers"
                            };
                            let notes: Vec<_> =
                                table.notes.iter().map(|n| n.message.en.as_str()).collect();
                            tally.faults.push(here(&format!(
                                "{told}: {} ({}) {notes:?} {:?}",
                                group[0].text,
                                group.len(),
                                single.as_ref().err()
                            )));
                        }
                        continue;
                    };
                    let columns = &table.columns[1..];
                    let mut of = 0;
                    for f in &group {
                        let expected = single.answers[&f.text].as_ref().unwrap();
                        let largest = expected.iter().fold(0.0f64, |a, b| a.max(b.abs()));
                        for (c, e) in columns[of..].iter().zip(expected) {
                            let size = if c.unit == "m" {
                                extent
                            } else {
                                size(c.unit, &swept, extent).max(largest)
                            };
                            tally.check(
                                &|| here(&c.name),
                                c.unit,
                                [c.values[row], *e],
                                [size, largest],
                                single.condition,
                            );
                        }
                        of += expected.len();
                    }
                }
            }
        }
        limits_hold(name, &swept, &m, driver, &singles, tally);
        if tally.compared == before {
            let (placed, solved) = (at.iter().flatten().count(), singles.iter().flatten().count());
            tally.idle.push(format!(
                "{name} driver {driver}: {placed} positions have places, {solved} are solved: {:?} {:?}",
                table.notes.first().map(|n| &n.message.en),
                singles.iter().find_map(|s| s.as_ref().err())
            ));
        }
    }
}

/// The extremes of `limits` contain all positions that `solve` finds between them, are listed once,
/// and the output is at rest there.
fn limits_hold(
    name: &str,
    swept: &Scene,
    m: &Mechanism,
    driver: usize,
    singles: &[Result<Single, String>],
    tally: &mut Tally,
) {
    let Ok(placed) = PlacedScene::new(swept, m) else { return };
    let extent = placed.at.extent();
    let limits = match extreme::limits(swept, m, driver) {
        Ok(limits) => limits,
        Err(f) => return tally.faults.push(format!("{name}: limits: {f}")),
    };
    let turns = swept.drivers[driver].kind.turns();
    for s in &limits.swings {
        let number = |single: &Single, of: String| single.answers.get(&of)?.as_ref().map(|v| v[0]);
        let position = |single: &Single| match s.output {
            extreme::DrivenOutput::Turning(l) => {
                number(single, format!("phi_{}", swept.link_name(l)))
            }
            extreme::DrivenOutput::Sliding(g) => {
                let guide = &swept.guides[g.0];
                let (p, Some(position::Path::Line { through, direction })) =
                    (swept.point_name(guide.pin?), placed.at.guides[g.0])
                else {
                    return None;
                };
                let at =
                    Vec2::new(number(single, format!("x_{p}"))?, number(single, format!("y_{p}"))?);
                Some(direction.dot(at - through.to_vec2()))
            }
        };
        let rate_of = |single: &Single| match s.output {
            extreme::DrivenOutput::Turning(l) => {
                number(single, format!("omega_{}", swept.link_name(l)))
            }
            extreme::DrivenOutput::Sliding(g) => {
                let (p, Some(position::Path::Line { direction, .. })) =
                    (swept.guides[g.0].pin?, placed.at.guides[g.0])
                else {
                    return None;
                };
                let v = single.answers.get(&format!("v_{}", swept.point_name(p)))?.as_ref()?;
                Some(direction.dot(Vec2::new(v[0], v[1])))
            }
        };
        let what = format!("{name} driver {driver}: limits of {:?}", s.output);
        let size = if matches!(s.output, extreme::DrivenOutput::Turning(_)) { 1.0 } else { extent };
        for (k, e) in s.extremes.iter().enumerate() {
            let again = |o: &extreme::OutputExtreme| {
                let apart = match limits.range.full() {
                    true => Vec2::from_angle(o.driver - e.driver).angle(),
                    false => (o.driver - e.driver) / if turns { 1.0 } else { extent },
                };
                limits.turns == 1 && apart.abs() < 1e-6 && (o.output - e.output).abs() < 1e-6 * size
            };
            if s.extremes[..k].iter().any(again) {
                tally.faults.push(format!("{what}: {e:?} is told twice"));
            }
        }
        let lowest = s.extremes.iter().map(|e| e.output).fold(f64::INFINITY, f64::min);
        let Some(stroke) = s.stroke else {
            // An output without an extreme position moves in one sense only.
            let rates: Vec<f64> = singles
                .iter()
                .flatten()
                .filter(|s| s.condition < 1e6)
                .filter_map(rate_of)
                .collect();
            let least = 1e-9 * rates.iter().fold(0.0f64, |a, r| a.max(r.abs()));
            if s.extremes.is_empty()
                && limits.range.full()
                && rates.iter().any(|r| *r > least)
                && rates.iter().any(|r| *r < -least)
            {
                tally.faults.push(format!(
                    "{what}: no extreme from {:?}, solve says of its rate {rates:?}",
                    limits.range.bounds()
                ));
            }
            continue;
        };
        for single in singles
            .iter()
            .flatten()
            .filter(|s| s.condition < 1e6 && goes_there(&limits.range, s.value, turns))
        {
            let Some(at) = position(single) else { continue };
            let mut over = at - lowest;
            if matches!(s.output, extreme::DrivenOutput::Turning(_)) {
                over -= ((over - 0.5 * stroke) / TAU).round() * TAU;
            }
            tally.compared += 1;
            if stroke < TAU && !(-1e-7 * size..=stroke + 1e-7 * size).contains(&over) {
                tally.faults.push(format!(
                    "{what}: from {lowest} on by {stroke}, solve says {at} at {}: {s:?} {:?}",
                    single.value, limits.range
                ));
            }
        }
    }
}

#[test]
fn a_sweep_says_what_solve_says() {
    let only = asked();
    let all = scenes();
    let picked = |(n, (name, _)): &(usize, &(String, Json))| match only.as_str() {
        "" => n % 24 == 0 || name.starts_with("says/") || ALWAYS.contains(&name.as_str()),
        ALL => true,
        words => part(words).map_or_else(|| name.contains(words), |(k, of)| n % of == k % of),
    };
    let some: Vec<&(String, Json)> =
        all.iter().enumerate().filter(picked).map(|(_, s)| s).collect();
    let one = |(name, json): &&(String, Json)| {
        let mut tally = Tally::default();
        compare(name, json, &mut tally);
        compare_in_time(name, json, &mut tally);
        tally
    };
    let tally = some.par_iter().map(one).reduce(Tally::default, Tally::join);
    println!(
        "{} of {} scenes, {} numbers compared; {} positions cannot be told, {} are singular; {} faults",
        tally.scenes,
        all.len(),
        tally.compared,
        tally.unsaid,
        tally.singular,
        tally.faults.len()
    );
    if !tally.idle.is_empty() {
        println!("nothing is compared of\n{}", tally.idle.join("\n"));
    }
    assert!(tally.faults.is_empty(), "{}", tally.faults.join("\n"));
    assert!(tally.compared > 1000, "{}", tally.compared);
}
