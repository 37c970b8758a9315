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
use hodograph_methods::curvature::{Asked, couplers, curvature};
use hodograph_scene::LinkId;

use super::list::{Entry, Pages, Wanted};

/// Pole, inflection circle, centres of curvature.
pub const ENTRY: Entry = Entry {
    name: "curvature",
    about: ["Inflection circle and centres of curvature, with construction", "拐点圆和轨迹的曲率中心及其作图"],
    draw,
};
/// The paths of the pole.
pub const CENTRODES: Entry = Entry {
    name: "centrodes",
    about: ["The paths of the pole in the fixed and the moving plane", "瞬心线（定瞬心线和动瞬心线）"],
    draw: paths,
};

/// Maximum number of pages of one scene: for a mechanism with more couplers, `--path` names the
/// relevant ones.
const MOST: usize = 6;

/// The links to draw: those with the selected points, or else all couplers.
fn links(w: &Wanted) -> Vec<LinkId> {
    let points = &w.extras.points;
    let carries = |l: &LinkId| points.is_empty() || points.iter().any(|p| w.scene.links[l.0].points.contains(p));
    couplers(w.scene).into_iter().filter(carries).take(MOST).collect()
}

/// The name of a page, with the link if there are several.
fn named(w: &Wanted, name: &str, all: usize, link: LinkId) -> String {
    if all > 1 { format!("{name}-{}", w.scene.link_name(link)) } else { name.to_owned() }
}

fn draw(w: &Wanted) -> Result<Warned<Pages>, Faults> {
    let asked = Asked { links: links(w), against: None, points: w.extras.points.clone() };
    let Warned { value: found, notes } = curvature(w.scene, &asked)?;
    let notes = notes.into_iter().filter(|d| d.code == "no-curvature").collect();
    let all = found.list.len();
    let page = |of| construction::figure(w, &found, of);
    let pages = found.list.iter().map(|of| (named(w, ENTRY.name, all, of.link), page(of))).collect();
    Ok(Warned { value: pages, notes })
}

fn paths(w: &Wanted) -> Result<Warned<Pages>, Faults> {
    let asked = Asked { links: links(w), against: None, points: w.extras.points.clone() };
    let Warned { value: found, .. } = curvature(w.scene, &asked)?;
    let all = found.list.len();
    let mut pages = Vec::new();
    for of in &found.list {
        pages.push((named(w, CENTRODES.name, all, of.link), rolling::figure(w, &found, of)?));
    }
    Ok(Warned { value: pages, notes: Vec::new() })
}
