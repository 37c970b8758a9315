//! Inversions in words: for each ground the type of the mechanism, the rotating and oscillating
//! links with their ranges, and Willis' table of its gear trains.

use super::answers::diagnostic;
use super::{limits, trains};
use hodograph_base::diag::Diagnostic;
use hodograph_base::lang::{say, tr};
use hodograph_methods::inversions::{ChainLink, Inversion};
use hodograph_scene::{Lang, Scene};
use hodograph_sweep::extreme::DrivenOutput;
use serde_json::{Value as Json, json};

/// Returns the report as text: a line for each ground, then the motion of each over the full range.
pub fn text(scene: &Scene, all: &[Inversion], lang: Lang) -> String {
    let mut out = String::new();
    let title = lang.of(&scene.title);
    if !title.is_empty() {
        out.push_str(&format!("{title}\n"));
    }
    for i in all {
        out.push_str(&format!("{}\n", line(i, lang)));
    }
    for i in all {
        out.push('\n');
        out.push_str(&limits::text(&i.scene, 0, &i.limits, lang));
        out.push_str(&trains::text(&i.scene, &i.worked, lang));
    }
    out
}

/// Returns the line of an inversion:
/// `link 4 fixed (as in the scene): crank-rocker; link 1 turns fully`.
pub fn line(i: &Inversion, lang: Lang) -> String {
    let original = if i.original { tr!(lang, " (as in the scene)") } else { "" };
    format!("{}{original}{}{}", heading(i, lang), tr!(lang, ": "), words(i, lang))
}

/// Returns the heading of an inversion: `link 4 fixed`.
pub fn heading(i: &Inversion, lang: Lang) -> String {
    let ground = i.scene.link_name(i.scene.ground);
    say!(lang, "link {ground} fixed")
}

/// Returns the type and the fully rotating links.
pub fn words(i: &Inversion, lang: Lang) -> String {
    let mut parts: Vec<String> = name(i, lang).into_iter().map(str::to_owned).collect();
    let turning = turning(i);
    let links = turning.join(lang.comma());
    parts.push(match turning.len() {
        0 => tr!(lang, "no link on the ground turns fully").to_owned(),
        1 => say!(lang, "link {links} turns fully"),
        _ => say!(lang, "links {links} turn fully"),
    });
    parts.join(lang.semicolon())
}

/// Returns the name of an inversion of a chain of four links with slides; `None` for other chains.
fn chain(i: &Inversion, lang: Lang) -> Option<&'static str> {
    // With the crank as ground, the link with the guide rotates about its pin.
    let full = || i.limits.range.full() && i.limits.swings.iter().all(|s| s.stroke.is_none());
    Some(match i.part? {
        ChainLink::Guide => tr!(lang, "crank-slider"),
        ChainLink::Slider => tr!(lang, "fixed slider (hand pump)"),
        ChainLink::Coupler => tr!(lang, "swinging block (oscillating cylinder)"),
        ChainLink::Crank if full() => tr!(lang, "turning guide (Whitworth)"),
        ChainLink::Crank => tr!(lang, "oscillating guide (crank-shaper)"),
        ChainLink::Cross => tr!(lang, "double slider (elliptic trammel)"),
        ChainLink::Block => tr!(lang, "Scotch yoke"),
        ChainLink::Connector => {
            tr!(lang, "double turning block (Oldham coupling)")
        }
        ChainLink::Alternate => tr!(lang, "tangent mechanism"),
    })
}

/// Returns the type of the mechanism: Grashof's of a four-bar, or the name of the inversion.
fn name(i: &Inversion, lang: Lang) -> Option<&'static str> {
    i.limits.grashof.map(|(kind, _)| limits::grashof_words(kind, lang)).or_else(|| chain(i, lang))
}

/// Returns the links on the ground that rotate fully.
fn turning(i: &Inversion) -> Vec<String> {
    let scene = &i.scene;
    let driver =
        scene.drivers[0].kind.turned().filter(|_| i.limits.range.full()).map(|(link, _)| link);
    // An output without extremes rotates fully if its driver does.
    let outputs =
        i.limits.swings.iter().filter(|s| driver.is_some() && s.extremes.is_empty()).filter_map(
            |s| match s.output {
                DrivenOutput::Turning(l) => Some(l),
                DrivenOutput::Sliding(_) => None,
            },
        );
    let on_ground = |l: &hodograph_scene::LinkId| {
        let own = &scene.links[scene.ground.0].points;
        scene.links[l.0].points.iter().any(|p| own.contains(p))
    };
    driver
        .into_iter()
        .chain(outputs.filter(on_ground))
        .map(|l| scene.link_name(l).to_owned())
        .collect()
}

/// Returns the inversions as JSON, in SI, each with its scene.
pub fn json(scene: &Scene, all: &[Inversion], notes: &[Diagnostic]) -> Json {
    let one = |i: &Inversion| {
        json!({
            "ground": i.scene.link_name(i.scene.ground),
            "original": i.original,
            "name": name(i, Lang::En).zip(name(i, Lang::Zh)).map(|(en, zh)| json!({"en": en, "zh": zh})),
            "driver": i.driver,
            "turning": turning(i),
            "willis": trains::formulas(&i.scene, &i.worked),
            "limits": limits::json(&i.scene, 0, &i.limits),
            "scene": serde_json::from_str::<Json>(&i.text).unwrap_or(Json::Null),
        })
    };
    json!({
        "title": {"en": scene.title.en, "zh": scene.title.zh},
        "inversions": all.iter().map(one).collect::<Vec<_>>(),
        "notes": notes.iter().map(diagnostic).collect::<Vec<_>>(),
    })
}
