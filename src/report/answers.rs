//! The answers: as text for people, as JSON for programs.

use super::phrase::{sense, tr};
use crate::analytic::{Decided, SingularKind, Singularity};
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
    let mut rows: Vec<[String; 4]> = Vec::new();
    for r in &worked.results {
        let find = &scene.find[r.find];
        rows.push([find.text.clone(), value_words(find, r.value(), lang), measured_words(find, r, lang), agreement_words(r, lang)]);
    }
    let width = |i: usize| rows.iter().map(|r| r[i].width()).max().unwrap_or(0);
    let widths = [width(0), width(1), width(2)];
    let mut out = String::new();
    let title = scene.title.get(lang);
    if !title.is_empty() {
        out.push_str(title);
        out.push('\n');
    }
    for r in &rows {
        let pad = |i: usize| format!("{}{}", r[i], " ".repeat(widths[i] - r[i].width()));
        out.push_str(format!("  {} = {}  {}  {}", pad(0), pad(1), pad(2), r[3]).trim_end());
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

fn measured_words(find: &Find, r: &Outcome, lang: Lang) -> String {
    let others: Vec<String> = r.others.iter().map(|v| value_words(find, *v, lang)).collect();
    match &r.drawn {
        None if !others.is_empty() => match lang {
            Lang::En => format!("(loop equations; on the other motion {})", others.join(", ")),
            Lang::Zh => format!("（解析；另一运动：{}）", others.join("，")),
        },
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
            json!({
                "find": find.text,
                "unit": if radians { "rad" } else { unit(&find.what) },
                "value": value(r.value()),
                "drawing": r.drawn.as_ref().map(|a| value(a.value)),
                "analysis": value(r.computed),
                "measured_mm": r.drawn.as_ref().and_then(|a| a.measured).map(|m| m.length_mm),
                "scale": r.drawn.as_ref().and_then(|a| a.measured).map(|m| m.mu),
                "difference": r.agreement.map(|a| a.difference),
                "agrees": r.agreement.map(|a| a.holds()),
                "others": r.others.iter().map(|v| value(*v)).collect::<Vec<_>>(),
            })
        })
        .collect();
    json!({
        "title": {"en": scene.title.en, "zh": scene.title.zh},
        "answers": answers,
        // Infinite where singular, which JSON writes as null.
        "condition": worked.solution.condition,
        "singular": worked.solution.singular.iter().map(|s| singularity(scene, s)).collect::<Vec<_>>(),
        "scales": {
            "mu_l": worked.construction.diagram.mu_l,
            "mu_v": worked.construction.velocity.as_ref().map(|p| p.mu),
            "mu_a": worked.construction.acceleration.as_ref().map(|p| p.mu),
        },
        "notes": notes.iter().map(diagnostic).collect::<Vec<_>>(),
    })
}

fn singularity(scene: &Scene, s: &Singularity) -> Json {
    json!({
        "kind": match s.kind {
            SingularKind::ChangePoint => "change-point",
            SingularKind::Limit => "driver-at-limit",
            SingularKind::Rest => "at-rest",
        },
        "links": s.named.iter().map(|l| scene.link_name(*l)).collect::<Vec<_>>(),
        "words": s.words,
        "decided": s.decided.map(|d| match d {
            Decided::Side => "side",
            Decided::Sketch => "sketch",
            Decided::Kind => "kind",
            Decided::Sense => "sense",
        }),
    })
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
