//! The cost of accuracy as a table and as JSON.

use super::columns::columns;
use hodograph_base::digits::significant;
use hodograph_base::lang::{each, tr};
use hodograph_scene::{Lang, Scene};
use hodograph_worked::accuracy::Rung;
use hodograph_worked::effort::ways::{AnswerMethod, MethodMeasurement, TogglePose};
use serde_json::{Value as Json, json};

/// Returns the name of a way of solution.
pub fn name(way: AnswerMethod, lang: Lang) -> String {
    let power = |x: f64| format!("{x:e}");
    match way {
        AnswerMethod::Paper(mm) => {
            format!("{} {mm} mm", tr!(lang, "paper, pencil"))
        }
        AnswerMethod::DrawingSingle => tr!(lang, "drawing, f32").into(),
        AnswerMethod::Drawing => tr!(lang, "drawing, f64").into(),
        AnswerMethod::ClosedSingle => tr!(lang, "closed form, f32").into(),
        AnswerMethod::Closed => tr!(lang, "closed form, f64").into(),
        AnswerMethod::ClosedDouble => tr!(lang, "closed form, double-double").into(),
        AnswerMethod::ClosedLong(bits) => {
            format!("{} {bits} bit", tr!(lang, "closed form,"))
        }
        AnswerMethod::Loops(t) => {
            format!("{} {}", tr!(lang, "loop equations, Newton to"), power(t))
        }
        AnswerMethod::Differences(h) => {
            format!("{} {}", tr!(lang, "finite differences, step"), power(h))
        }
        AnswerMethod::Certified(Rung::Double) => tr!(lang, "certified, f64").into(),
        AnswerMethod::Certified(Rung::DoubleDouble) => tr!(lang, "certified, double-double").into(),
        AnswerMethod::Certified(Rung::Long(bits)) => {
            format!("{} {bits} bit", tr!(lang, "certified,"))
        }
    }
}

/// Returns an error as a power of ten with one digit; `fails` if there is no result.
fn error(e: Option<f64>, lang: Lang) -> String {
    match e {
        None => "–".into(),
        Some(0.0) => "0".into(),
        Some(e) if e.is_finite() => format!("{e:.1e}"),
        Some(_) => tr!(lang, "fails").into(),
    }
}

fn time(seconds: Option<f64>) -> String {
    match seconds {
        None => "–".into(),
        Some(s) if s < 1e-3 => format!("{} µs", significant(s * 1e6, 2)),
        Some(s) => format!("{} ms", significant(s * 1e3, 2)),
    }
}

/// Returns a table with the first column left-aligned and numbers right-aligned.
fn table(rows: &[Vec<String>]) -> String {
    columns(rows, 1).iter().map(|line| format!("  {}\n", line.trim_end())).collect()
}

/// Returns the table of all ways of solution.
pub fn text(scene: &Scene, ways: &[MethodMeasurement], lang: Lang) -> String {
    let heading = [
        each!("way"),
        each!("error" => "velocity"),
        each!("error" => "acceleration"),
        each!("time"),
    ];
    let mut rows = vec![heading.map(|words| lang.pick(words).to_owned()).to_vec()];
    for m in ways {
        let both = |k: usize| match (m.errors[k], m.within_95[k]) {
            (Some(_), Some(_)) => {
                format!("{} ({})", error(m.errors[k], lang), error(m.within_95[k], lang))
            }
            _ => error(m.errors[k], lang),
        };
        rows.push(vec![name(m.way, lang), both(0), both(1), time(m.seconds)]);
    }
    let title = lang.of(&scene.title);
    let note = tr!(
        lang,
        "worst relative error of the answers against 512-bit arithmetic; on paper the median of 400 drawings (95 %); certified: the bound; time: median of a whole solution from positions to answers"
    );
    format!(
        "{}{}\n{note}\n",
        if title.is_empty() { String::new() } else { format!("{title}\n") },
        table(&rows).trim_end()
    )
}

/// Returns the table of a series of poses: errors of the accelerations (of the velocities if no
/// acceleration is requested).
pub fn series_text(series: &[TogglePose], lang: Lang) -> String {
    let Some(first) = series.iter().find(|n| !n.ways.is_empty()) else { return String::new() };
    let mut rows = vec![
        std::iter::once(tr!(lang, "before the toggle").to_string())
            .chain(first.ways.iter().map(|m| name(m.way, lang)))
            .collect::<Vec<_>>(),
    ];
    for near in series {
        let mut row = vec![format!("{:.0e}", near.distance)];
        match near.ways.len() {
            0 => row.extend(first.ways.iter().map(|_| tr!(lang, "fails").to_string())),
            _ => row.extend(near.ways.iter().map(|m| error(m.errors[1].or(m.errors[0]), lang))),
        }
        rows.push(row);
    }
    table(&rows)
}

/// Returns both tables as JSON.
pub fn json(ways: &[MethodMeasurement], series: &[TogglePose]) -> Json {
    let finite = |e: Option<f64>| e.filter(|e| e.is_finite());
    let one = |m: &MethodMeasurement| {
        json!({
            "way": name(m.way, Lang::En),
            "velocity": finite(m.errors[0]),
            "acceleration": finite(m.errors[1]),
            "velocity_95": finite(m.within_95[0]),
            "acceleration_95": finite(m.within_95[1]),
            "fails": m.errors.iter().flatten().any(|e| !e.is_finite()),
            "seconds": m.seconds,
        })
    };
    let poses: Vec<Json> = series
        .iter()
        .map(|n| json!({"distance": n.distance, "position": n.position, "ways": n.ways.iter().map(one).collect::<Vec<_>>()}))
        .collect();
    json!({"ways": ways.iter().map(one).collect::<Vec<_>>(), "toward_toggle": poses})
}
