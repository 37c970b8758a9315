//! Curvature on paper: pole, inflection circle and centres of curvature with the lines that find
//! them, a page for each link; and the centrodes.
//!
//! [`construction`] draws the former, with [`ball`] for Ball's point; [`rolling`] draws the
//! centrodes. Both draw on a [`board`] that cuts everything at the edge of the paper.

mod ball;
mod board;
mod construction;
mod rolling;

use hodograph_base::diag::{Faults, Warned};
use hodograph_methods::curvature::{CurvatureRequest, couplers, curvature};
use hodograph_scene::LinkId;

use super::list::{FigureEntry, FigureInput, Pages};

/// Pole, inflection circle, centres of curvature.
pub const ENTRY: FigureEntry = FigureEntry {
    name: "curvature",
    about: [
        "Inflection circle and centres of curvature, with construction",
        "拐点圆和轨迹的曲率中心及其作图",
    ],
    draw,
};
/// The paths of the pole.
pub const CENTRODES: FigureEntry = FigureEntry {
    name: "centrodes",
    about: [
        "The paths of the pole in the fixed and the moving plane",
        "瞬心线（定瞬心线和动瞬心线）",
    ],
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
