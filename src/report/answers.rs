//! The answers: as text for people, as JSON for programs.

use super::drafting;
use super::phrase::{sense, tr};
use crate::answer::Value;
use crate::diag::{Diagnostic, Severity};
use crate::quantity::{direction_degrees, shortest, significant};
use crate::scene::{Asked, Find, Lang, Scene};
use crate::worked::{Outcome, Worked};
use serde_json::{Value as Json, json};
use unicode_width::UnicodeWidthStr;

/// The SI unit of a question's answer.
pub fn unit(what: &Asked) -> &'static str {
    match what {
        Asked::Coordinate(..) | Asked::Distance(..) => "m",
        Asked::LinkAngle(_) => "deg",
        Asked::Velocity(_) | Asked::RelativeVelocity(..) | Asked::SlidingVelocity(..) => "m/s",
        Asked::Omega(_) | Asked::RelativeOmega(..) => "rad/s",
        Asked::Alpha(_) | Asked::RelativeAlpha(..) => "rad/s²",
        _ => "m/s²",
    }
}

/// Digits that text answers show.
const DIGITS: usize = 6;

/// Everything `solve` prints: one line a question.
pub fn text(scene: &Scene, worked: &Worked, lang: Lang) -> String {
    let mut rows: Vec<[String; 5]> = Vec::new();
    for r in &worked.results {
        let find = &scene.find[r.find];
        let tolerance = drafting::words(find, worked.drafting.as_ref().and_then(|d| d.tolerances[r.find].as_ref()));
        let value = value_words(find, r.value(), lang);
        rows.push([find.text.clone(), value, tolerance, measured_words(r, lang), agreement_words(r, lang)]);
    }
    let width = |i: usize| rows.iter().map(|r| r[i].width()).max().unwrap_or(0);
    let widths = [width(0), width(1), width(2), width(3)];
    let mut out = String::new();
    let title = scene.title.get(lang);
    if !title.is_empty() {
        out.push_str(title);
        out.push('\n');
    }
    for r in &rows {
        let pad = |i: usize| format!("{}{}", r[i], " ".repeat(widths[i] - r[i].width()));
        let tolerance = if widths[2] > 0 { format!("  {}", pad(2)) } else { String::new() };
        out.push_str(format!("  {} = {}{tolerance}  {}  {}", pad(0), pad(1), pad(3), r[4]).trim_end());
        out.push('\n');
    }
    if let Some(worst) = worst(worked) {
        out.push_str(&format!(
            "{} {}\n",
            tr(lang, "drawing and analysis differ by at most", "图解与解析结果的最大相对偏差为"),
            significant(worst, 1)
        ));
    }
    out
}

/// The largest relative difference between drawing and analysis; `None` where nothing was compared.
pub fn worst(worked: &Worked) -> Option<f64> {
    worked.results.iter().filter_map(|r| r.agreement).map(|a| a.difference).reduce(f64::max)
}

fn value_words(find: &Find, value: Value, lang: Lang) -> String {
    let unit = unit(&find.what);
    match value {
        Value::Vector(v) => {
            let angle = if v.norm() > 0.0 { format!(" ∠ {}°", significant(direction_degrees(v.angle()), 5)) } else { String::new() };
            format!("{} {unit}{angle}", significant(v.norm(), DIGITS))
        }
        Value::Scalar(s) => match find.what {
            Asked::LinkAngle(_) => format!("{}°", significant(s.to_degrees(), DIGITS)),
            Asked::Omega(_) | Asked::Alpha(_) | Asked::RelativeOmega(..) | Asked::RelativeAlpha(..) => {
                let sense = if s == 0.0 { String::new() } else { format!(" {}", sense(lang, s)) };
                format!("{} {unit}{sense}", significant(s.abs(), DIGITS))
            }
            _ => format!("{} {unit}", significant(s, DIGITS)),
        },
    }
}

fn measured_words(r: &Outcome, lang: Lang) -> String {
    match &r.drawn {
        None => tr(lang, "(loop equations)", "（解析）").into(),
        Some(a) => match a.measured {
            Some(m) => {
                let arm = m.arm_m.map(|l| format!(" / {} m", significant(l, 4))).unwrap_or_default();
                let length = if r.value().magnitude() == 0.0 { 0.0 } else { m.length_mm };
                format!("({} mm · μ {}{arm})", significant(length, 4), shortest(m.mu))
            }
            None => String::new(),
        },
    }
}

fn agreement_words(r: &Outcome, lang: Lang) -> String {
    match r.agreement {
        Some(a) if !a.holds() => {
            format!("{} {}", tr(lang, "DRAWING AND ANALYSIS DISAGREE:", "图解与解析不一致："), significant(a.difference, 2))
        }
        _ => String::new(),
    }
}

/// The answers for programs: SI values, components, the measured length, both ways and their difference.
pub fn json(scene: &Scene, worked: &Worked, notes: &[Diagnostic]) -> Json {
    let value = |v: Value| match v {
        Value::Vector(v) => json!({"x": v.x, "y": v.y, "magnitude": v.norm(), "angle_deg": v.angle().to_degrees()}),
        Value::Scalar(s) => json!({"value": s}),
    };
    let answers: Vec<Json> = worked
        .results
        .iter()
        .map(|r| {
            let find = &scene.find[r.find];
            let radians = matches!(find.what, Asked::LinkAngle(_));
            let mut answer = json!({
                "find": find.text,
                "unit": if radians { "rad" } else { unit(&find.what) },
                "drawing": r.drawn.as_ref().map(|a| value(a.value)),
                "analysis": value(r.computed),
                "measured_mm": r.drawn.as_ref().and_then(|a| a.measured).map(|m| m.length_mm),
                "scale": r.drawn.as_ref().and_then(|a| a.measured).map(|m| m.mu),
                "difference": r.agreement.map(|a| a.difference),
                "agrees": r.agreement.map(|a| a.holds()),
            });
            if let (Some(d), Json::Object(fields)) = (&worked.drafting, &mut answer) {
                let of = drafting::answer_fields(d.tolerances[r.find].as_ref());
                fields.extend(of.map(|(key, value)| (key.to_string(), value)));
            }
            answer
        })
        .collect();
    let mut all = json!({
        "title": {"en": scene.title.en, "zh": scene.title.zh},
        "answers": answers,
        "condition": worked.solution.condition,
        "scales": {
            "mu_l": worked.construction.diagram.mu_l,
            "mu_v": worked.construction.velocity.as_ref().map(|p| p.mu),
            "mu_a": worked.construction.acceleration.as_ref().map(|p| p.mu),
        },
        "notes": notes.iter().map(diagnostic).collect::<Vec<_>>(),
    });
    if let Some(d) = &worked.drafting {
        all["drafting"] = drafting::json(scene, worked, d);
    }
    all
}

/// A diagnostic for programs.
pub fn diagnostic(d: &Diagnostic) -> Json {
    json!({
        "severity": match d.severity { Severity::Error => "error", Severity::Warning => "warning", Severity::Note => "note" },
        "code": d.code,
        "message": d.message,
        "help": d.help,
        "span": d.span.map(|s| [s.start, s.end]),
    })
}
