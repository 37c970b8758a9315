//! The extremes and zeros of the quantities of a line diagram as text and JSON.

use super::range::{RangeFault, SweptRange, driver_of, steps};
use crate::figure::curves::CurveDiagram;
use crate::notation::Notation;
use crate::paper::label::Label;
use crate::scene::{Lang, Scene, Swept};
use crate::sweep::long::LongSweep;
use crate::sweep::pieces::gather;
use crate::sweep::{self, PlacedScene};
use hodograph_base::digits::legible;
use hodograph_base::lang::{say, tr};
use serde_json::{Value as Json, json};
use std::f64::consts::TAU;

/// Steps of a motion, between which a quantity has one extreme or zero at most.
const STEPS: usize = 720;

/// Digits of a value, the same as of the limits of a motion.
const DIGITS: usize = 6;

/// Returns the diagram of a scene's questions over the motion of a driver, by its name (see
/// [`driver_of`]), with the symbols of a notation.
///
/// # Errors
/// The errors of [`range::rows`](super::range::rows).
pub fn listed(
    scene: &Scene,
    over: Option<&str>,
    notation: &Notation,
) -> Result<CurveDiagram, RangeFault> {
    let mechanism = sweep::mechanism(scene).map_err(RangeFault::Scene)?;
    let placed = PlacedScene::new(scene, &mechanism).map_err(RangeFault::Scene)?;
    let driver = driver_of(scene, over)?;
    let range = SweptRange { steps: Some(STEPS), ..SweptRange::default() };
    let steps = steps(&placed, driver, &range)?;
    let table = gather(&mut LongSweep::new(&placed, driver, steps).map_err(RangeFault::Scene)?);
    let swept_at = |values| sweep::of_values(&placed, driver, values);
    let swept = Swept::Driver(driver);
    let mut diagram = CurveDiagram::swept(scene, swept, &table, &swept_at, notation);
    if scene.drivers[driver].kind.turns() {
        let turn = TAU * diagram.per_si;
        let curves = diagram.panels.iter_mut().flat_map(|p| &mut p.curves);
        curves.for_each(|c| close(&mut c.zeros, turn));
    }
    Ok(diagram)
}

/// Removes the place at which a full turn ends as it began; a stretch that ends or begins there
/// contains it.
fn close(zeros: &mut Vec<[f64; 2]>, turn: f64) {
    let [first, .., last] = zeros[..] else { return };
    if (last[1] - first[0] - turn).abs() > 1e-9 * turn {
        return;
    }
    if last[0] == last[1] {
        zeros.pop();
    } else if first[0] == first[1] {
        zeros.remove(0);
    }
}

/// Returns the quantities as text, each with its highest and lowest value and its zeros. `driver`
/// is the name of the driver, such as `phi_1`.
pub fn text(scene: &Scene, diagram: &CurveDiagram, driver: &str, lang: Lang) -> String {
    let mut out = String::new();
    let title = lang.of(&scene.title);
    if !title.is_empty() {
        out += &format!("{title}\n");
    }
    let value = |x: f64, unit: &str| match unit {
        unit if unit.contains("degree") => format!("{}°", legible(x, DIGITS)),
        _ => format!("{} {}", legible(x, DIGITS), Label::math(unit).plain()).trim_end().to_owned(),
    };
    let place = |x: f64| value(x, &diagram.driver[1]);
    let name = match lang {
        Lang::En => driver.to_owned(),
        Lang::Zh => driver.replacen("phi", "φ", 1),
    };
    for (panel, curve) in diagram.panels.iter().flat_map(|p| p.curves.iter().map(move |c| (p, c))) {
        out += &format!("{}\n", curve.name);
        let words = [tr!(lang, "highest"), tr!(lang, "lowest")];
        for ((at, v), word) in curve.extremes.iter().zip(words) {
            let v = value(*v, &panel.unit);
            out += &say!(lang, "  {word} {v} at {name} = {}\n", place(*at));
        }
        let zeros: Vec<String> = curve
            .zeros
            .iter()
            .map(|[from, to]| match from == to {
                true => place(*from),
                false => format!("{} … {}", place(*from), place(*to)),
            })
            .collect();
        if !zeros.is_empty() {
            out += &say!(lang, "  zero at {name} = {}\n", zeros.join(lang.comma()));
        }
    }
    out
}

/// Returns the quantities as JSON, in SI.
pub fn json(diagram: &CurveDiagram, driver: &str) -> Json {
    let all = diagram.panels.iter().flat_map(|p| &p.curves).map(|curve| {
        let at = |x: f64| x / diagram.per_si;
        let extreme = |k: usize| {
            curve.extremes.get(k).map(|(x, v)| json!({"driver": at(*x), "value": v / curve.per_si}))
        };
        let zeros: Vec<Json> = curve
            .zeros
            .iter()
            .map(|[from, to]| json!({"driver": at(*from), "until": (from != to).then(|| at(*to))}))
            .collect();
        json!({
            "quantity": curve.name,
            "highest": extreme(0),
            "lowest": extreme(1),
            "zeros": zeros,
        })
    });
    json!({"driver": driver, "quantities": all.collect::<Vec<_>>()})
}
