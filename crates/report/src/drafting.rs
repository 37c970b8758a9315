//! Tolerances of drawing by hand: as words beside an answer, as a table, as JSON.

use hodograph_base::digits::{shortest, significant};
use hodograph_base::lang::{say, tr};
use hodograph_board::plan::text::{PlanWriter, vertex_name};
use hodograph_paper::paper::phrase::formula;
use hodograph_scene::{Book, DiagramKind, Find, Kind, Lang, Scene};
use hodograph_worked::accuracy::{CrossingTolerance, Drafting, Tolerance};
use hodograph_worked::certified::CertifiedSteps;
use hodograph_worked::certified::steps::StepNumber;
use hodograph_worked::worked::Worked;
use serde_json::{Value as Json, json};
use unicode_width::UnicodeWidthStr;

/// Digits of a tolerance: it is an estimate.
pub const DIGITS: usize = 2;

/// Returns a tolerance beside its answer: in % of it, or in its unit if a percentage is meaningless
/// (an answer of zero or smaller than its tolerance, a coordinate, an angle). `None` for values
/// that are given, not read.
pub fn amount(book: &Book, find: &Find, t: &Tolerance) -> Option<ToleranceAmount> {
    if t.absolute == 0.0 {
        return None;
    }
    let kind = find.what.kind();
    Some(match t.relative {
        Some(r) if r < 1.0 => ToleranceAmount::Percent(r * 100.0),
        _ => ToleranceAmount::Of(kind, book.value(kind, t.absolute)),
    })
}

/// Returns the meaning of tolerances on a drawing of the mechanism alone.
pub fn by_hand_words(lang: Lang, pencil_mm: f64, mu_l: f64) -> String {
    say!(
        lang,
        "by hand: 95 of 100 drawings to μ_l = {mu_l} m/mm with a pencil error of {pencil_mm} mm fall within ±"
    )
}

/// The form of a tolerance.
pub enum ToleranceAmount {
    /// In % of the answer.
    Percent(f64),
    /// In the unit of its kind.
    Of(Kind, f64),
}

/// Returns the words of [`amount`] for a terminal.
pub fn words(book: &Book, find: &Find, t: Option<&Tolerance>) -> String {
    match t.and_then(|t| amount(book, find, t)) {
        Some(ToleranceAmount::Percent(value)) => format!("± {} %", significant(value, DIGITS)),
        Some(ToleranceAmount::Of(kind, value)) => {
            format!("± {}", book.text(kind, &significant(value, DIGITS)))
        }
        None => String::new(),
    }
}

/// Returns the intersections and the scales for 1 %, as tables; empty if no tolerances were
/// requested. `steps` contains the certified numbers of the construction for the same pencil error.
pub fn text(w: &PlanWriter, worked: &Worked, steps: &CertifiedSteps) -> String {
    let Some(d) = &worked.drafting else { return String::new() };
    let (lang, book) = (w.lang, &w.scene.book);
    let pencil = shortest(d.pencil_mm);
    let mut out = say!(lang, "drawn by hand, 95 % of the marks within {pencil} mm\n");
    if !d.crossings.is_empty() {
        let head = [tr!(lang, "crossing"), tr!(lang, "angle"), tr!(lang, "moves by"), ""];
        let mut rows = vec![head.map(str::to_owned)];
        let certain = DiagramKind::OF_MOTION
            .into_iter()
            .flat_map(|on| steps.crossings(&worked.construction, on));
        rows.extend(d.crossings.iter().zip(certain).map(|(c, certain)| {
            let told = |what, rough: f64| {
                certain(what).unwrap_or_else(|| format!("≈ {}", significant(rough, 1)))
            };
            let [moves, si] = match c.moves_on_paper_mm() {
                Some(mm) => [
                    format!("{} mm", told(StepNumber::Moved, mm)),
                    book.text(
                        c.on.kind(),
                        &told(StepNumber::Off, book.value(c.on.kind(), c.moves)),
                    ),
                ],
                None => [tr!(lang, "off the paper").to_string(), String::new()],
            };
            [crossing_name(w, c), format!("{}°", told(StepNumber::Angle, c.angle_deg())), moves, si]
        }));
        out.push_str(&table(&rows));
    }
    let forces = if worked.equilibrium.is_some() { "μ_F" } else { "" };
    let mut rows = vec![
        [
            tr!(lang, "for 1 %"),
            tr!(lang, "larger by"),
            "μ_l",
            "μ_v",
            "μ_a",
            forces,
            tr!(lang, "paper"),
        ]
        .map(str::to_string),
    ];
    for (find, t) in w.scene.find.iter().zip(&d.tolerances) {
        let Some(l) = t.as_ref().filter(|t| t.absolute > 0.0).and_then(|t| t.larger.as_ref())
        else {
            continue;
        };
        let [width, height] = l.size_mm;
        let by = if l.factor > 1.0 {
            format!("× {}", shortest(l.rounded()))
        } else {
            tr!(lang, "as it is").to_string()
        };
        let mu = DiagramKind::ALL.map(|on| {
            let kind = on.kind();
            l.scales.get(kind).map_or(String::new(), |mu| {
                format!("{} {}", shortest(book.value(kind, mu)), book.scale_name(kind))
            })
        });
        let sheet = l.sheet().unwrap_or(tr!(lang, "larger than A0"));
        let [l_, v, a, f] = mu;
        rows.push([
            find.text.clone(),
            by,
            l_,
            v,
            a,
            f,
            format!("{width:.0} × {height:.0} mm, {sheet}"),
        ]);
    }
    if rows.len() > 1 {
        out.push_str(&table(&rows));
    }
    out
}

fn crossing_name(w: &PlanWriter, c: &CrossingTolerance) -> String {
    match c.on {
        DiagramKind::Plane => vertex_name(w.scene, w.plan, c.target),
        on @ (DiagramKind::Velocity | DiagramKind::Acceleration | DiagramKind::Force) => {
            formula(&w.image(on, c.target))
        }
    }
}

fn table<const N: usize>(rows: &[[String; N]]) -> String {
    let wide: Vec<usize> =
        (0..N).map(|i| rows.iter().map(|r| r[i].width()).max().unwrap_or(0)).collect();
    let mut out = String::new();
    for row in rows {
        let cells = row
            .iter()
            .zip(&wide)
            .filter(|(_, w)| **w > 0)
            .map(|(c, w)| format!("{c}{}", " ".repeat(w - c.width())));
        out.push_str(format!("  {}", cells.collect::<Vec<_>>().join("  ")).trim_end());
        out.push('\n');
    }
    out
}

/// Returns the pencil error and the intersections as JSON.
pub fn json(scene: &Scene, worked: &Worked, d: &Drafting) -> Json {
    let crossing = |c: &CrossingTolerance| {
        json!({
            "point": vertex_name(scene, &worked.plan, c.target),
            "drawing": if c.on == DiagramKind::Plane { "diagram".to_owned() } else { c.on.name(Lang::En) },
            "sine": c.sine,
            "angle_deg": c.angle_deg(),
            "tolerance_mm": c.moves_mm,
            "tolerance": c.moves,
            "unit": c.on.kind().si(),
        })
    };
    json!({"pencil_mm": d.pencil_mm, "part_within": hodograph_board::construct::pencil::WITHIN, "crossings": d.crossings.iter().map(crossing).collect::<Vec<_>>()})
}

/// Returns the JSON fields of one answer.
pub fn answer_fields(t: Option<&Tolerance>) -> [(&'static str, Json); 3] {
    let larger = t.and_then(|t| t.larger.as_ref()).map(|l| {
        let mut all = json!({"factor": l.factor});
        for (kind, key) in
            DiagramKind::ALL.into_iter().filter_map(|on| Some((on.kind(), on.kind().scale_key()?)))
        {
            if kind != Kind::Force || l.scales.get(kind).is_some() {
                all[key] = l.scales.get(kind).into();
            }
        }
        (all["largest_drawing_mm"], all["paper"]) = (json!(l.size_mm), json!(l.sheet()));
        all
    });
    [
        ("tolerance", t.map(|t| t.absolute).into()),
        ("relative", t.and_then(|t| t.relative).into()),
        ("scale_for_1_percent", larger.into()),
    ]
}
