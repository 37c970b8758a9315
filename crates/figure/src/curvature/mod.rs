//! Curvature on paper: pole, inflection circle and centres of curvature with the lines that find
//! them, a page for each link; and the centrodes.
//!
//! [`construction`] draws the former, with [`ball`] for Ball's point; [`rolling`] draws the
//! centrodes. Both draw on a [`board`] that cuts everything at the edge of the paper.

mod ball;
mod board;
mod construction;
mod rolling;

use hodograph_base::diag::{Both, Faults, Warned};
use hodograph_base::lang::each;
use hodograph_methods::curvature::{CurvatureRequest, couplers, curvature};
use hodograph_paper::paper::phrase::capital;
use hodograph_report::curvature::CurvatureWords;
use hodograph_scene::{DiagramKind, Lang, LinkId};

use super::list::{FigureEntry, FigureInput, Pages};
use super::particle::ParticleView;
use super::stepped::SteppedMethod;

/// Pole, inflection circle, centres of curvature.
pub const ENTRY: FigureEntry = FigureEntry {
    name: "curvature",
    about: each!("Inflection circle and centres of curvature, with construction"),
    draw,
};
/// The paths of the pole.
pub const CENTRODES: FigureEntry = FigureEntry {
    name: "centrodes",
    about: each!("The paths of the pole in the fixed and the moving plane"),
    draw: paths,
};

/// Maximum number of pages of one scene: for a mechanism with more couplers, `--path` names the
/// relevant ones.
const MOST: usize = 6;

/// The links to draw: those with the selected points, or else all couplers.
fn links(w: &FigureInput) -> Vec<LinkId> {
    let points = &w.extras.points;
    let carries = |l: &LinkId| {
        points.is_empty() || points.iter().any(|p| w.scene.links[l.0].points.contains(p))
    };
    couplers(w.scene).into_iter().filter(carries).take(MOST).collect()
}

/// The name of a page, with the link if there are several.
fn named(w: &FigureInput, name: &str, all: usize, link: LinkId) -> String {
    if all > 1 { format!("{name}-{}", w.scene.link_name(link)) } else { name.to_owned() }
}

fn draw(w: &FigureInput) -> Result<Warned<Pages>, Faults> {
    let asked =
        CurvatureRequest { links: links(w), against: None, points: w.extras.points.clone() };
    let Warned { value: found, notes } = curvature(w.scene, &asked)?;
    let notes = notes.into_iter().filter(|d| d.code == "no-curvature").collect();
    let all = found.list.len();
    let page = |of| construction::figure(w, &found, of);
    let pages =
        found.list.iter().map(|of| (named(w, ENTRY.name, all, of.link), page(of))).collect();
    Ok(Warned { value: pages, notes })
}

/// Maximum number of links in a construction step by step.
const MOST_STEPPED: usize = 2;

/// The construction of each coupler step by step.
///
/// # Errors
/// The faults of the method.
pub(super) fn stepped(w: &FigureInput) -> Result<Option<SteppedMethod>, Faults> {
    let links: Vec<LinkId> = links(w).into_iter().take(MOST_STEPPED).collect();
    if links.is_empty() {
        return Ok(None);
    }
    let asked = CurvatureRequest { links, against: None, points: w.extras.points.clone() };
    let found = curvature(w.scene, &asked)?.value;
    let words = [Lang::En, Lang::Zh].map(|lang| CurvatureWords { found: &found, lang });
    let mut out = SteppedMethod::default();
    for of in &found.list {
        let [en, zh] = words.each_ref().map(|words| words.stages(of));
        // The steps of earlier links come first.
        let mut stages = vec![None; out.steps.len()];
        stages.extend(en.iter().map(|(stage, _)| Some(*stage)));
        let sentences = en.iter().zip(&zh);
        out.steps.extend(sentences.map(|(en, zh)| Both { en: en.1.source(), zh: zh.1.source() }));
        if en.is_empty() {
            let told = words.each_ref().map(|words| {
                let told = words.remarks(of).into_iter().chain([words.calculated()]);
                told.map(|p| p.source()).collect::<Vec<_>>()
            });
            let [en, zh] = told;
            let sentence = |text: &str, stop| format!("{}{stop}", capital(text));
            out.steps.extend(
                en.iter()
                    .zip(&zh)
                    .map(|(en, zh)| Both { en: sentence(en, "."), zh: sentence(zh, "。") }),
            );
        }
        let lang = w.options.lang;
        let own = &words[usize::from(lang == Lang::Zh)];
        let heading = words.each_ref().map(|words| words.heading_set(of).source());
        let [en, zh] = heading;
        out.views.push(ParticleView {
            part: construction::part(w, own, of, &stages).0,
            caption: Both { en: capital(&en), zh },
            scales: vec![(DiagramKind::Plane, w.worked.construction.diagram.mu)],
        });
    }
    Ok((!out.steps.is_empty()).then_some(out))
}

fn paths(w: &FigureInput) -> Result<Warned<Pages>, Faults> {
    let asked =
        CurvatureRequest { links: links(w), against: None, points: w.extras.points.clone() };
    let Warned { value: found, .. } = curvature(w.scene, &asked)?;
    let all = found.list.len();
    let mut pages = Vec::new();
    for of in &found.list {
        pages.push((named(w, CENTRODES.name, all, of.link), rolling::figure(w, &found, of)?));
    }
    Ok(Warned { value: pages, notes: Vec::new() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::list::Extras;
    use crate::sheet::SheetOptions;
    use hodograph_methods::curvature::drawing::CurvatureDrawing;
    use hodograph_paper::render::svg;
    use hodograph_scene::{Lang, read, templates};
    use hodograph_worked::worked::{Scope, work};

    /// A mark that is moved on the drawing is moved on the figure: nothing is taken from the
    /// analysis.
    #[test]
    fn the_figure_shows_the_drawing() {
        let scene = read(templates::get("slider-crank").unwrap()).unwrap().value;
        let worked = work(&scene, Scope::Figure).unwrap().value;
        let (options, extras) = (SheetOptions::of_language(Lang::En), Extras::default());
        let w = FigureInput { scene: &scene, worked: &worked, options: &options, extras: &extras };
        let asked = CurvatureRequest { links: links(&w), ..CurvatureRequest::default() };
        let mut found = curvature(&scene, &asked).unwrap().value;
        let circle = |found: &hodograph_methods::curvature::LinkCurvatures| {
            let markup =
                svg::write(&construction::figure(&w, found, &found.list[0])).unwrap().value;
            markup
                .lines()
                .filter(|l| l.contains("curvature inflection"))
                .map(str::to_owned)
                .collect::<Vec<_>>()
        };
        let before = circle(&found);
        assert!(!before.is_empty());
        let CurvatureDrawing::Rays(rays) = &mut found.list[0].drawing else {
            panic!("a crank and a guide are two rays")
        };
        rays.inflection = rays.pole + (rays.inflection - rays.pole) * 0.5;
        let after = circle(&found);
        assert!(!after.is_empty());
        assert_ne!(before, after);
    }
}
