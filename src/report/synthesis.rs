//! The candidates of a synthesis for people and programs: lengths, errors, defects, transmission, and which is taken and why.

use super::limits::grashof_words;
use super::phrase::tr;
use crate::diag::{Both, Diagnostic, Severity};
use crate::digits::{metres, significant};
use crate::scene::{Kind, Lang};
use crate::synthesis::candidate::Number;
use crate::synthesis::{Candidate, Design, Task, judge};
use serde_json::{Value as Json, json};

/// The table of candidates.
pub fn text(task: &Task, design: &Design, lang: Lang) -> String {
    let mut out = format!("{}\n", lang.of(&task.heading.title));
    for line in design.numbers.iter().map(|n| format!("{} = {}", n.name, value(n))).collect::<Vec<_>>().chunks(6) {
        out += &format!("{}\n", line.join("   "));
    }
    for (k, c) in design.candidates.iter().enumerate() {
        out += &format!("\n{}. {}\n", k + 1, lang.of(&c.draft.which));
        let numbers: Vec<String> = c.draft.numbers.iter().map(|n| format!("{} = {}", n.name, value(n))).collect();
        for line in numbers.chunks(6) {
            out += &format!("   {}\n", line.join("   "));
        }
        out += &format!("   {}\n", motion(c, lang));
        for d in c.notes() {
            out += &format!("   {}: {}\n", d.code, lang.of(&d.message));
        }
    }
    out + &format!("\n{}\n", taken(design, lang))
}

/// What the finished scene does, in a line.
fn motion(c: &Candidate, lang: Lang) -> String {
    let j = &c.judged;
    let mut parts = Vec::new();
    parts.extend(j.grashof.map(|g| grashof_words(g, lang).to_owned()));
    parts.push(
        tr(
            lang,
            if j.rotates { "the driver turns fully" } else { "the driver swings" },
            if j.rotates { "原动件整周转动" } else { "原动件摆动" },
        )
        .to_owned(),
    );
    if let Some((angle, at)) = j.transmission {
        let (angle, at) = (significant(angle.to_degrees(), 5), significant(turn(at.to_degrees()), 5));
        parts.push(match lang {
            Lang::En => format!("least γ = {angle}° at {at}°"),
            Lang::Zh => format!("原动件在 {at}° 时 γ 最小，为 {angle}°"),
        });
    }
    if let Some(k) = j.time_ratio {
        parts.push(format!("K = {}", significant(k, 6)));
    }
    if !c.draft.wanted.is_empty() {
        parts.push(lang.of(&judge::accuracy(j)).to_owned());
    }
    parts.join(" · ")
}

/// A direction as people count it, from 0 to 360°.
fn turn(degrees: f64) -> f64 {
    let turned = degrees.rem_euclid(360.0);
    if turned < 5e-4 || 360.0 - turned < 5e-4 { 0.0 } else { turned }
}

/// A number of a design with its unit.
pub fn value(n: &Number) -> String {
    match n.kind {
        Some(Kind::Length) => metres_fine(n.value),
        Some(Kind::Angle) => format!("{}°", significant(if n.value.abs() < 1e-12 { 0.0 } else { n.value.to_degrees() }, 6)),
        Some(Kind::Velocity | Kind::Acceleration | Kind::Omega | Kind::Alpha | Kind::Number) | None => significant(n.value, 6),
    }
}

fn metres_fine(value_m: f64) -> String {
    if value_m.abs() >= 10.0 { metres(value_m) } else { format!("{} mm", significant(value_m * 1e3, 6)) }
}

/// Which candidate is taken, and why.
fn taken(design: &Design, lang: Lang) -> String {
    let Some(first) = design.candidates.first() else { return String::new() };
    let j = &first.judged;
    let why = match (j.defects.is_empty(), j.rotates, design.candidates.len()) {
        (_, _, 1) => tr(lang, "it is the only one", "只有这一个方案"),
        (false, ..) => tr(lang, "it has the fewest defects, but has some", "缺陷最少，但仍有缺陷"),
        (true, true, _) => tr(
            lang,
            "no defect, a crank that turns fully, the best transmission angle among those",
            "无缺陷，原动件整周转动，且其中传动角最好",
        ),
        (true, false, _) => tr(lang, "no defect, the best transmission angle among those", "无缺陷，且其中传动角最好"),
    };
    match lang {
        Lang::En => format!("Taken: 1 ({why})."),
        Lang::Zh => format!("取方案 1（{why}）。"),
    }
}

/// The candidates as JSON, in SI.
pub fn json(task: &Task, design: &Design) -> Json {
    json!({
        "synthesis": task.kind,
        "title": {"en": task.heading.title.en, "zh": task.heading.title.zh},
        "numbers": named(&design.numbers),
        "candidates": design.candidates.iter().map(candidate).collect::<Vec<_>>(),
        "notes": design.notes.iter().map(note).collect::<Vec<_>>(),
    })
}

fn named(numbers: &[Number]) -> Json {
    Json::Object(numbers.iter().map(|n| (n.name.clone(), json!(n.value))).collect())
}

fn candidate(c: &Candidate) -> Json {
    let j = &c.judged;
    let positions: Vec<Json> = c
        .draft
        .wanted
        .iter()
        .map(|w| json!({"driver": w.driver, "points": w.places.iter().map(|(n, p)| (n.clone(), json!([p.x, p.y]))).collect::<serde_json::Map<_, _>>()}))
        .collect();
    json!({
        "which": both(&c.draft.which),
        "numbers": named(&c.draft.numbers),
        "wanted": positions,
        "off": j.off_m,
        "size": j.size_m,
        "full_turn": j.rotates,
        "grashof": j.grashof.map(|g| grashof_words(g, Lang::En)),
        "transmission": j.transmission.map(|(angle, driver)| json!({"angle": angle, "driver": driver})),
        "time_ratio": j.time_ratio,
        "stroke": j.stroke,
        "defects": j.defects.iter().map(note).collect::<Vec<_>>(),
        "remarks": c.draft.remarks.iter().chain(&j.remarks).map(note).collect::<Vec<_>>(),
        "scene": c.draft.scene,
    })
}

fn note(d: &Diagnostic) -> Json {
    let severity = match d.severity {
        Severity::Note => "note",
        Severity::Warning => "warning",
        Severity::Error => "error",
    };
    json!({"code": d.code, "severity": severity, "message": both(&d.message), "help": d.help.as_ref().map(both)})
}

fn both(text: &Both) -> Json {
    json!({"en": text.en, "zh": text.zh})
}
