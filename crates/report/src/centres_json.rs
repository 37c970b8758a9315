//! Instantaneous centres as JSON.

use super::answers::diagnostic;
use super::centres::CentreWords;
use super::writing::PointForm;
use hodograph_base::diag::Diagnostic;
use hodograph_base::digits::line_degrees;
use hodograph_methods::centres::{CentreMethod, CentrePlace, Centres, LinkPair, Origin};
use hodograph_scene::Lang;
use serde_json::{Value as Json, json};

/// Returns the centres as JSON, in SI.
pub fn json(found: &Centres, notes: &[Diagnostic]) -> Json {
    let w = CentreWords::new(found, Lang::En);
    let scene = &found.scene;
    let names = |p: LinkPair| [scene.link_name(p.i).to_owned(), scene.link_name(p.j).to_owned()];
    let centres: Vec<Json> = found
        .list
        .iter()
        .enumerate()
        .map(|(k, c)| {
            let (at, direction) = match c.place {
                Some(CentrePlace::At(p)) => (Some([p.x, p.y]), None),
                Some(CentrePlace::Infinity(u)) => (None, Some(line_degrees(u.angle()))),
                None => (None, None),
            };
            let lines: Vec<String> = match c.origin {
                Some(Origin::Crossing(lines)) => {
                    lines.iter().map(|l| w.line(c.step.pair, *l, PointForm::Plain)).collect()
                }
                Some(Origin::Pair | Origin::Velocities) | None => Vec::new(),
            };
            json!({
                "name": c.step.pair.name(scene),
                "links": names(c.step.pair),
                "round": c.round,
                "by": match (&c.step.how, c.origin) {
                    (_, None) => "none",
                    (CentreMethod::Primary(_), _) => "pair",
                    (_, Some(Origin::Velocities)) => "velocities",
                    (_, Some(Origin::Crossing(_) | Origin::Pair)) => "lines",
                },
                "how": w.how(c),
                "lines": lines,
                "at": at,
                "infinity_deg": direction,
                "tolerance": found.by_hand.as_ref().and_then(|t| t.centres[k]),
                "given_drivers": c.step.given_drivers,
                "residual": c.residual,
            })
        })
        .collect();
    let values: Vec<Json> = w
        .values()
        .into_iter()
        .map(|(symbol, kind, value, [drawing, analysis])| {
            json!({"symbol": symbol, "unit": kind.si(), "centres": value, "drawing": drawing, "analysis": analysis})
        })
        .collect();
    let [by_theorem, by_velocities] = found.closure.found_by();
    json!({
        "title": {"en": scene.title.en, "zh": scene.title.zh},
        "links": found.closure.links.iter().map(|l| scene.link_name(*l)).collect::<Vec<_>>(),
        "count": found.closure.steps.len(),
        "primary": found.closure.primary,
        "by_theorem": by_theorem,
        "by_velocities": by_velocities,
        "stalled": found.closure.stalled(),
        "centres": centres,
        "steps": {"en": w.steps(), "zh": CentreWords::new(found, Lang::Zh).steps()},
        "values": values,
        "worst_residual": found.worst_residual(),
        "worst_triple": found.worst_triple,
        "notes": notes.iter().map(diagnostic).collect::<Vec<_>>(),
    })
}
