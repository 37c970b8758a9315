//! Curvature as JSON, in SI.

use super::answers::diagnostic;
use super::curvature::CurvatureWords;
use hodograph_base::diag::Diagnostic;
use hodograph_base::geom::{Point, Vec2};
use hodograph_methods::curvature::centrodes::{Centrodes, PoleStation};
use hodograph_methods::curvature::drawing::CurvatureDrawing;
use hodograph_methods::curvature::motion::{Bend, PlaneState};
use hodograph_methods::curvature::plane::PlanePoint;
use hodograph_methods::curvature::{LinkCurvatures, OfLink};
use hodograph_scene::Lang;
use serde_json::{Value as Json, json};

fn place(p: Point) -> Json {
    json!([p.x, p.y])
}

fn vector(v: Vec2) -> Json {
    json!([v.x, v.y])
}

fn end(e: PlanePoint) -> Json {
    match e {
        PlanePoint::At(p) => place(p),
        PlanePoint::Infinity(u) => json!({"infinity": vector(u)}),
    }
}

/// Returns the curvature as JSON, with the centrodes if requested.
pub fn json(found: &LinkCurvatures, centrodes: &[Centrodes], notes: &[Diagnostic]) -> Json {
    let scene = &found.scene;
    let links: Vec<Json> = found.list.iter().map(|of| link(found, of, centrodes)).collect();
    json!({
        "title": {"en": scene.title.en, "zh": scene.title.zh},
        "against": scene.link_name(found.against),
        "at_rest": found.at_rest,
        "links": links,
        "notes": notes.iter().map(diagnostic).collect::<Vec<_>>(),
    })
}

fn link(found: &LinkCurvatures, of: &OfLink, centrodes: &[Centrodes]) -> Json {
    let scene = &found.scene;
    let (state, direction) = match of.state {
        PlaneState::Rest => ("rest", None),
        PlaneState::Translation(v) => ("translation", Some(vector(v))),
        PlaneState::Turning(p) if p.stands() => ("pole-stands", None),
        PlaneState::Turning(_) => ("turning", None),
    };
    let drawing = match of.drawing {
        CurvatureDrawing::Rays(_) => "rays",
        CurvatureDrawing::Rolling(_) => "rolling",
        CurvatureDrawing::Hinge(_) => "hinge",
        CurvatureDrawing::Parallel(_) => "parallel-rays",
        CurvatureDrawing::OneLine(_) => "one-line",
        CurvatureDrawing::NoRays => "no-rays",
    };
    let steps = |lang| {
        CurvatureWords { found, lang }.steps(of).iter().map(|s| s.plain()).collect::<Vec<_>>()
    };
    let drawn = of.drawn().map(|d| {
        json!({
            "pole": place(d.pole),
            "inflection_pole": place(d.pole + d.normal),
            "diameter": d.normal.norm(),
            "acceleration_pole": d.acceleration_pole.map(place),
            "pole_velocity": d.pole_velocity.map(vector),
            "ball": d.ball.map(place),
            "bresse_diameter": d.bresse.map(vector),
        })
    });
    let by_hand = of.by_hand.as_ref().map(|t| {
        json!({
            "pencil_mm": t.pencil_mm,
            "pole": t.pole,
            "inflection_pole": t.inflection_pole,
            "diameter": t.diameter,
            "ball": t.ball,
            "radii": t.radii,
        })
    });
    let analysis = of.pole().map(|p| {
        json!({
            "pole": place(p.pole),
            "inflection_pole": place(p.inflection_pole()),
            "diameter": p.diameter(),
            "acceleration_pole": place(p.acceleration_pole),
            "pole_velocity": vector(p.pole_velocity),
            "ball": p.ball.map(place),
            "bresse_diameter": p.bresse.map(vector),
        })
    });
    let points: Vec<Json> = of
        .points
        .iter()
        .map(|p| {
            let (kind, centre, radius) = match p.bend {
                Bend::About(centre, radius) => ("curved", Some(place(centre)), Some(radius)),
                Bend::Straight => ("straight", None, None),
                Bend::AtPole => ("at-pole", None, Some(0.0)),
                Bend::Rest => ("rest", None, None),
            };
            json!({
                "point": scene.point_name(p.point),
                "at": place(p.at),
                "path": kind,
                "radius": radius,
                "centre": centre,
                "drawn_centre": p.drawn.map(|d| end(d.centre)),
            })
        })
        .collect();
    let own = centrodes.iter().find(|c| c.link == of.link).map(paths);
    json!({
        "link": scene.link_name(of.link),
        "state": state,
        "direction": direction,
        "drawing": drawing,
        "drawn": drawn,
        "analysis": analysis,
        "by_hand": by_hand,
        "points": points,
        "apart": of.apart(),
        "steps": {"en": steps(Lang::En), "zh": steps(Lang::Zh)},
        "centrodes": own,
    })
}

/// Returns the stations of both centrodes; `null` if the pole is at infinity or the pose has no
/// motion.
fn paths(c: &Centrodes) -> Json {
    let at = |s: &PoleStation, p: Point| {
        if s.omega != 0.0 && p.is_finite() { place(p) } else { Json::Null }
    };
    let known = |of: &dyn Fn(&PoleStation) -> Json| {
        c.stations.iter().map(|s| s.as_ref().map_or(Json::Null, of)).collect::<Vec<_>>()
    };
    json!({
        "closed": c.closed,
        "travel": known(&|s| json!(s.travel)),
        "fixed": known(&|s| at(s, s.pole())),
        "in_link": known(&|s| at(s, s.in_link())),
    })
}
