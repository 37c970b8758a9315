//! Motion of particles without a mechanism, as text and JSON: answers to their certain digits, the
//! values by drawing, and a note if a pursuit is integrated.

use super::answers::diagnostic;
use crate::amount::scale_formula;
use hodograph_base::diag::{Both, Diagnostic};
use hodograph_base::digits::{legible, minus, plain};
use hodograph_base::lang::tr;
use hodograph_base::notation::Notation;
use hodograph_base::number::Ball;
use hodograph_base::number::decimal::{Certain, Enclosure};
use hodograph_methods::particle::board::MotionDrawing;
use hodograph_methods::particle::plate::PlateComponent;
use hodograph_methods::particle::pursuit::PursuitEnd;
use hodograph_methods::particle::{
    Mutual, ParticleMotionKind, ParticleProblem, ParticleQuantity, ParticleSolution, ParticleValue,
};
use hodograph_paper::paper::phrase::Phrase;
use hodograph_scene::{Book, DiagramKind, Kind as Quantity, Lang};
use serde_json::{Value as Json, json};

/// Returns the kind of an answer; `None` for a time.
pub fn kind(what: ParticleQuantity) -> Option<Quantity> {
    match what {
        ParticleQuantity::MeetingTime(_) => None,
        ParticleQuantity::MeetingPlace(_)
        | ParticleQuantity::Distance(_)
        | ParticleQuantity::Place(_)
        | ParticleQuantity::Curvature(_)
        | ParticleQuantity::Between(_, Mutual::Distance) => Some(Quantity::Length),
        ParticleQuantity::LineOmega(_) | ParticleQuantity::Between(_, Mutual::Turning) => {
            Some(Quantity::Omega)
        }
        ParticleQuantity::Velocity(_) | ParticleQuantity::Between(_, Mutual::Velocity) => {
            Some(Quantity::Velocity)
        }
        ParticleQuantity::Acceleration(_) | ParticleQuantity::Between(_, Mutual::Acceleration) => {
            Some(Quantity::Acceleration)
        }
        ParticleQuantity::Part(_, part) if part.is_velocity() => Some(Quantity::Velocity),
        ParticleQuantity::Part(..) => Some(Quantity::Acceleration),
    }
}

/// Returns the unit of an answer: that of the file's `answers`, else SI.
pub fn unit(book: &Book, what: ParticleQuantity) -> &str {
    kind(what).map_or("s", |k| book.name(k))
}

/// Returns an SI value in the unit of the answer.
pub fn in_unit(book: &Book, what: ParticleQuantity, si: f64) -> f64 {
    kind(what).map_or(si, |k| book.value(k, si))
}

/// Returns an enclosure in the unit of the answer.
pub(crate) fn enclosed(book: &Book, kind: Option<Quantity>, e: &Enclosure) -> Enclosure {
    let chosen = kind.filter(|k| book.chosen(*k).is_some());
    chosen
        .and_then(|k| book.in_chosen(k, Ball::new(e.approx, e.radius)).enclosure())
        .unwrap_or_else(|| e.clone())
}

/// Returns a number to at most `digits` digits, all of them certain; zero if it is negligible
/// relative to `size`.
pub fn number(e: &Enclosure, size: f64, digits: usize) -> String {
    if e.contains_zero() && e.largest() <= 1e-10 * size || e.approx == 0.0 && e.radius == 0.0 {
        return "0".to_owned();
    }
    let told = (1..=digits).rev().find_map(|d| e.rounded(d));
    told.map_or_else(|| "?".to_owned(), |text| plain(&text))
}

/// The names of the components.
const AXES: [&str; 3] = ["x", "y", "z"];

/// Returns the largest answer of the same kind; values negligible relative to it are printed as
/// zero.
pub fn largest(
    problem: &ParticleProblem,
    solved: &ParticleSolution,
    what: ParticleQuantity,
) -> f64 {
    let of = |a: &hodograph_methods::particle::ParticleAnswer| match &a.value {
        ParticleValue::Vector(_, size) if kind(problem.find[a.find].what) == kind(what) => {
            size.approx
        }
        ParticleValue::Vector(..) | ParticleValue::Scalar(_) | ParticleValue::None(_) => 0.0,
    };
    solved.answers.iter().map(of).fold(0.0, f64::max)
}

/// Returns the value of an answer: components, and the magnitude; `size` is the largest value of
/// its kind (SI).
pub fn value(
    book: &Book,
    what: ParticleQuantity,
    value: &ParticleValue,
    size: f64,
    digits: usize,
    lang: Lang,
) -> String {
    let unit = unit(book, what);
    let told = |e: &Enclosure, size: f64| {
        minus(&number(&enclosed(book, kind(what), e), in_unit(book, what, size), digits))
    };
    match value {
        ParticleValue::None(d) => format!("{} ({})", tr!(lang, "none"), lang.of(&d.message)),
        ParticleValue::Scalar(e) => format!("{} {unit}", told(e, e.approx.abs().max(size))),
        ParticleValue::Vector(parts, whole) => {
            let size = whole.approx.max(size);
            let each: Vec<String> = parts
                .iter()
                .zip(AXES)
                .map(|(e, axis)| format!("{axis} {}", told(e, size)))
                .collect();
            if what.is_place() {
                format!("({}) {unit}", each.join(", "))
            } else {
                format!("{} {unit} ({})", told(whole, size), each.join(", "))
            }
        }
    }
}

/// Returns the note on a pursuit.
pub fn integrated(lang: Lang) -> &'static str {
    tr!(
        lang,
        "The pursuit is integrated (Gragg, Bulirsch, Stoer; the errors of the steps are added up and bound all printed digits); what follows at the instant is exact."
    )
}

/// Returns the difference between drawing and answer, as a fraction of the answer.
pub fn apart(answer: &ParticleValue, drawn: &[f64], largest: f64) -> Option<f64> {
    let all = answer.vector().or_else(|| answer.scalar().map(|s| vec![s.abs()]))?;
    let norm = |v: &mut dyn Iterator<Item = f64>| v.fold(0.0, |s, x| s + x * x).sqrt();
    let drawn: Vec<f64> = if all.len() == 1 { vec![drawn[0].abs()] } else { drawn.to_vec() };
    // A small answer is compared with a thousandth of the largest of its kind.
    let size = norm(&mut all.iter().copied()).max(1e-3 * largest);
    let off = norm(&mut all.iter().zip(&drawn).map(|(a, b)| a - b));
    Some(if size > 0.0 { off / size } else { off })
}

/// Returns the drawn value of an answer; `None` if it is only calculated.
pub fn drawn(all: &[MotionDrawing], what: ParticleQuantity) -> Option<&[f64]> {
    all.iter()
        .filter(|d| !d.calculated)
        .flat_map(|d| &d.readings)
        .find(|r| r.0 == what)
        .map(|r| r.1.as_slice())
}

/// Returns the report as text.
pub fn text(
    problem: &ParticleProblem,
    solved: &ParticleSolution,
    board: &[MotionDrawing],
    digits: usize,
    steps: Option<&Notation>,
    lang: Lang,
) -> String {
    let mut out = format!("{}\n", lang.of(&problem.title));
    out += &format!("t = {} s\n\n", legible(problem.instant(), 6));
    let wide = problem.find.iter().map(|f| f.text.chars().count()).max().unwrap_or(0);
    for answer in &solved.answers {
        let find = &problem.find[answer.find];
        let size = largest(problem, solved, find.what);
        let told = value(&problem.book, find.what, &answer.value, size, digits, lang);
        let beside = drawn(board, find.what).and_then(|d| apart(&answer.value, d, size)).map_or(
            String::new(),
            |off| {
                let off = if off < 1e-14 { "0".to_owned() } else { format!("{off:.0e}") };
                format!("   {} {off}", tr!(lang, "drawing differs by"))
            },
        );
        out += &format!("{:wide$} = {told}{beside}\n", find.text);
    }
    if problem.motions.iter().any(|m| matches!(m.kind, ParticleMotionKind::Toward { .. })) {
        out += &format!("\n{}\n", integrated(lang));
    }
    if let Some(notation) = steps {
        for d in board {
            out += &format!(
                "\n{}{}\n",
                head(d, lang),
                Phrase::new(&scales(&problem.book, d.mu)).plain()
            );
            for (k, s) in d.steps.iter().enumerate() {
                out += &format!("{}. {}\n", k + 1, sentence(s, lang, notation).plain());
            }
        }
    }
    out
}

/// Returns the heading of the steps of a drawing.
fn head(drawn: &MotionDrawing, lang: Lang) -> &'static str {
    match drawn.calculated {
        true => tr!(lang, "Calculated, shown to scale: "),
        false => tr!(lang, "Drawing: "),
    }
}

/// Returns the scales of a drawing in the label language.
pub fn scales(book: &Book, [l, v, a]: [f64; 3]) -> String {
    let all = [(DiagramKind::Plane, l), (DiagramKind::Velocity, v), (DiagramKind::Acceleration, a)];
    all.map(|(on, mu)| format!("${}$", scale_formula(book, on, mu))).join(", ")
}

/// Returns the report as JSON, in SI.
pub fn json(
    problem: &ParticleProblem,
    solved: &ParticleSolution,
    board: &[MotionDrawing],
    digits: usize,
    notes: &[Diagnostic],
) -> Json {
    let told = |e: &Enclosure, size: f64| json!({"value": e.approx, "radius": e.radius, "text": number(e, size, digits)});
    let answers: Vec<Json> = solved
        .answers
        .iter()
        .map(|a| {
            let find = &problem.find[a.find];
            let size = largest(problem, solved, find.what);
            let mut out = match &a.value {
                ParticleValue::Scalar(e) => told(e, e.approx.abs()),
                ParticleValue::Vector(parts, whole) => {
                    let each: Vec<Json> = parts.iter().map(|e| told(e, whole.approx.max(size))).collect();
                    json!({"value": parts.iter().map(|e| e.approx).collect::<Vec<_>>(), "components": each, "magnitude": told(whole, whole.approx.max(size))})
                }
                ParticleValue::None(d) => json!({"value": null, "why": diagnostic(d)}),
            };
            if let Some(object) = out.as_object_mut() {
                object.insert("find".into(), json!(find.text));
                object.insert("unit".into(), json!(unit(&Book::default(), find.what)));
                object.insert("drawn".into(), json!(drawn(board, find.what)));
            }
            out
        })
        .collect();
    let ends: Vec<Json> = solved
        .ends
        .iter()
        .map(|(k, end)| {
            let point = &problem.motions[*k].point;
            match end {
                PursuitEnd::Meet { time, .. } => {
                    json!({"pursuer": point, "integrated": true, "meets": true, "time": hodograph_base::number::Real::approx(*time)})
                }
                PursuitEnd::Apart { until, distance } => {
                    json!({"pursuer": point, "integrated": true, "meets": false, "until": until, "distance": distance})
                }
            }
        })
        .collect();
    json!({
        "title": {"en": problem.title.en, "zh": problem.title.zh},
        "time": problem.instant(),
        "answers": answers,
        "pursuits": ends,
        "notes": notes.iter().map(diagnostic).collect::<Vec<_>>(),
    })
}

/// Returns a sentence of a construction with the marks of a notation.
pub fn sentence(of: &Both, lang: Lang, notation: &Notation) -> Phrase {
    Phrase::new(&marked(&lang.of(of).replace("a_c", "a_k"), notation))
}

/// Returns symbols of a board with the marks of a notation for tangential and Coriolis components.
pub fn marked(symbols: &str, notation: &Notation) -> String {
    symbols
        .replace("^t", &format!("^{{{}}}", notation.tangential))
        .replace("a_k", &format!("a_{{{}}}", notation.coriolis))
}

/// Returns the symbol of a question in the label language.
pub fn symbol(problem: &ParticleProblem, what: ParticleQuantity, notation: &Notation) -> String {
    let name = |k: usize| problem.motions[k].point.as_str();
    let pair = |k: usize| {
        let m = &problem.motions[k];
        format!("{}{}", m.point, problem.chase(m).map_or("", |c| c.1))
    };
    match what {
        ParticleQuantity::MeetingTime(k) => format!("T_{{{}}}", pair(k)),
        ParticleQuantity::MeetingPlace(k) => format!("P_{{{}}}", pair(k)),
        ParticleQuantity::Distance(k) => format!("l_{{{}}}", pair(k)),
        ParticleQuantity::LineOmega(k) => format!("\\omega_{{{}}}", pair(k)),
        ParticleQuantity::Place(k) => name(k).to_owned(),
        ParticleQuantity::Velocity(k) => format!("v_{{{}}}", name(k)),
        ParticleQuantity::Acceleration(k) => format!("a_{{{}}}", name(k)),
        ParticleQuantity::Curvature(k) => format!("\\rho_{{{}}}", name(k)),
        ParticleQuantity::Part(_, part) => marked(part_symbol(part), notation),
        ParticleQuantity::Between([a, b], m) => {
            let letter = match m {
                Mutual::Distance => "l",
                Mutual::Turning => "\\omega",
                Mutual::Velocity => "v",
                Mutual::Acceleration => "a",
            };
            format!("{letter}_{{{}{}}}", name(a), name(b))
        }
    }
}

fn part_symbol(part: PlateComponent) -> &'static str {
    match part {
        PlateComponent::TransportVelocity => "v_e",
        PlateComponent::RelativeVelocity => "v_r",
        PlateComponent::Transport => "a_e",
        PlateComponent::TransportNormal => "a^n_e",
        PlateComponent::TransportTangential => "a^t_e",
        PlateComponent::Relative => "a_r",
        PlateComponent::RelativeNormal => "a^n_r",
        PlateComponent::RelativeTangential => "a^t_r",
        PlateComponent::Coriolis => "a_k",
    }
}

/// Returns the answers as sentences with formulas, one line each.
pub fn lines(
    problem: &ParticleProblem,
    solved: &ParticleSolution,
    digits: usize,
    lang: Lang,
    notation: &Notation,
) -> Vec<Phrase> {
    let mut out: Vec<Phrase> = solved
        .answers
        .iter()
        .map(|a| {
            let what = problem.find[a.find].what;
            Phrase::new(&format!(
                "${}$ = {}",
                symbol(problem, what, notation),
                inked_words(&value(
                    &problem.book,
                    what,
                    &a.value,
                    largest(problem, solved, what),
                    digits,
                    lang
                ))
            ))
        })
        .collect();
    if problem.motions.iter().any(|m| matches!(m.kind, ParticleMotionKind::Toward { .. })) {
        out.push(Phrase::of_words(integrated(lang)));
    }
    out
}

/// Returns numbers as they are printed: a minus as wide as a plus.
fn inked_words(text: &str) -> String {
    text.replace('-', "−")
}
