//! The comparison through time, with drivers that move by laws of time.

use super::moved::{Single, solved};
use super::scenes::{askable, read};
use super::{OFF, POSITIONS, Tally, asking, rows, size};
use hodograph::mechanism::Mechanism;
use hodograph::scene::{self, Scene, edit};
use hodograph::sweep::PlacedScene;
use hodograph::sweep::follow::course::over_a_turn;
use hodograph::sweep::timed::TimedSweep;
use serde_json::{Value as Json, json};

/// A scene after a time (s), in which drivers without a law have moved on at their rates.
fn gone_on(mut json: Json, plain: &Scene, time: f64) -> Json {
    for (i, d) in plain.drivers.iter().enumerate().filter(|(_, d)| d.law.is_none()) {
        let own = match &mut json["driver"] {
            Json::Array(list) => &mut list[i],
            one => one,
        };
        let (rate, acceleration) = (d.rate.value, d.acceleration.as_ref().map_or(0.0, |a| a.value));
        let (way, unit) = (
            rate * time + 0.5 * acceleration * time * time,
            if d.kind.turns() { "rad" } else { "m" },
        );
        for (keys, by, unit) in [
            (&["angle", "position", "length"][..], way, unit.to_owned()),
            (&["omega", "velocity"], acceleration * time, format!("{unit}/s")),
        ] {
            for key in keys {
                if let Some(told) = own.get(key).and_then(Json::as_str).map(str::to_owned) {
                    own[key] = json!(format!("({told}) + ({by:?} {unit})"));
                }
            }
        }
    }
    json
}

/// Compares every question of a scene at eight times.
pub fn compare_in_time(name: &str, json: &Json, tally: &mut Tally) {
    let Ok(plain) = scene::read(json.to_string()) else { return };
    // Coordinates give one instant only.
    if !plain.value.has_laws_of_time() || !plain.value.is_told_everywhere() {
        return;
    }
    let find = askable(json, &plain.value);
    let Ok(plain) = read(json, &find) else { return };
    let swept = over_a_turn(&plain);
    let m = Mechanism::new(&swept).unwrap().value;
    let placed = PlacedScene::new(&swept, &m).unwrap();
    tally.scenes += 1;
    let (timed, [from, to]) = TimedSweep::new(&placed, [None, None]).unwrap();
    let times: Vec<f64> =
        (0..POSITIONS).map(|k| from + (to - from) * (k as f64 + OFF) / POSITIONS as f64).collect();
    let text = json.to_string();
    let at = |t: &f64, find: &[String]| {
        let text = edit::with_parameters(&text, &[("t", &format!("{t:?} s"))]).unwrap();
        let json = gone_on(serde_json::from_str(&text).unwrap(), &plain, t - plain.instant());
        read(&json, find).and_then(|scene| solved(&scene, None)).ok()
    };
    let singles: Vec<Option<Single>> = times.iter().map(|t| at(t, &find)).collect();
    for f in &swept.find {
        let scene = asking(&swept, std::slice::from_ref(f));
        let placed = PlacedScene::new(&scene, &m).unwrap();
        let (timed, _) = TimedSweep::new(&placed, [Some(from), Some(to)]).unwrap();
        let table = timed.table(times.clone());
        let found = rows(&table, &times);
        // The motion ends at a limit: later times have no row, while `solve` may find another
        // assembly.
        let ended = |k: usize| {
            let outward: Vec<usize> = if times[k] < plain.instant() {
                (0..=k).collect()
            } else {
                (k..times.len()).collect()
            };
            outward.iter().all(|k| found[*k].is_none()) && found.iter().any(Option::is_some)
        };
        for (k, ((single, row), t)) in singles.iter().zip(&found).zip(&times).enumerate() {
            if ended(k) {
                tally.unsaid += 1;
                continue;
            }
            let here = |what: &str| format!("{name} at {t} s: {what}");
            // If some parts cannot be assembled, the questions that do not need them are answered
            // alone.
            let alone = if single.is_none() && row.is_some() {
                at(t, std::slice::from_ref(&f.text))
            } else {
                None
            };
            let expected = single.as_ref().or(alone.as_ref());
            let expected =
                expected.and_then(|s| Some((s.answers.get(&f.text)?.as_ref()?, s.condition)));
            match (expected, row) {
                (Some((expected, condition)), Some(row)) => {
                    for (c, e) in table.columns[1..].iter().zip(expected) {
                        let size = size(c.unit, &swept, placed.at.extent()).max(1.0);
                        tally.check(
                            &|| here(&c.name),
                            c.unit,
                            [c.values[*row], *e],
                            [size, e.abs()],
                            condition,
                        );
                    }
                }
                (None, None) => {}
                (expected, _) => {
                    let notes: Vec<_> = table.notes.iter().map(|n| n.message.en.as_str()).collect();
                    tally.faults.push(here(&format!(
                        "{} is answered by solve: {} {notes:?}",
                        f.text,
                        expected.is_some()
                    )));
                }
            }
        }
    }
    drop(timed);
}
