//! Draws the instantaneous centres: the mechanism with all centres and the lines that find them,
//! and the circle diagram (瞬心多边形).
//!
//! [`diagram`] draws over the mechanism, [`rays`] selects the lines and their lengths, [`circle`]
//! draws the circle diagram with its list.

mod circle;
mod diagram;
pub(super) mod rays;

use hodograph_base::diag::{Both, Faults, Warned};
use hodograph_base::geom::Point;
use hodograph_base::lang::each;
use hodograph_board::plan::names::name_label;
use hodograph_methods::centres::{CentreMethod, Centres, LinkPair, centres, placed};
use hodograph_paper::paper::words::{Words, words};
use hodograph_report::centres::CentreWords;
use hodograph_scene::{DiagramKind, Lang, Scene};

use rays::CentrePlate;

use super::arrange::{AIM_MM, Tree};
use super::list::{FigureEntry, FigureInput, Pages, page};
use super::particle::ParticleView;
use super::sheet::{MARGIN_MM, SheetDrafter};
use super::stepped::SteppedMethod;
use crate::scales::DrawingScales;
use hodograph_paper::paper::drawing::DrawingPart;
use hodograph_paper::paper::item::Figure;
use hodograph_paper::paper::label::Label;

/// Maximum number of centres found by lines in a single drawing: those of a six-bar.
const MOST: usize = 12;
/// Centres per drawing if there are more.
const PER_PLATE: usize = 5;

/// All centres with the circle diagram.
pub const ENTRY: FigureEntry = FigureEntry {
    name: "centres",
    about: each!("The instantaneous centres, with the circle diagram"),
    draw,
};

fn draw(w: &FigureInput) -> Result<Warned<Pages>, Faults> {
    let Warned { value: found, notes } = centres(w.scene)?;
    // The notes about the pose already appear with the scene's own questions.
    let notes = notes.into_iter().filter(|d| d.code.starts_with("centre-")).collect();
    let plates = plates(&found);
    let pages = if plates.len() > 1 {
        parted(w, &found, plates)
    } else {
        page(ENTRY.name, Some(figure(w, &found)))?.value
    };
    Ok(Warned { value: pages, notes })
}

/// Centres farther than this from the mechanism are indicated by arrows in a construction step by
/// step (mm).
const REACH_MM: f64 = 45.0;

/// The mechanism with its centres, and the circle diagram, step by step: each centre is found in a
/// step of its own, and angular velocities and speeds follow.
///
/// # Errors
/// The faults of the scene.
pub(super) fn stepped(w: &FigureInput) -> Result<SteppedMethod, Faults> {
    let found = placed(w.scene, &w.worked.mechanism, &w.worked.configuration)?.value;
    let [en, zh] = [Lang::En, Lang::Zh].map(|lang| {
        let told = CentreWords::marked(&found, lang);
        let centres = found.list.iter().map(|c| told.sentence(c).source());
        centres.chain(told.steps()).collect::<Vec<_>>()
    });
    let steps = en.into_iter().zip(zh).map(|(en, zh)| Both { en, zh }).collect();
    let captions = [Lang::En, Lang::Zh].map(words);
    let caption = |of: fn(&Words) -> &'static str| {
        let [en, zh] = captions.map(of);
        Both { en: en.to_owned(), zh: zh.to_owned() }
    };
    let scales = vec![(DiagramKind::Plane, w.worked.construction.diagram.mu)];
    let views = vec![
        ParticleView {
            part: diagram::stepped(w, &found, REACH_MM),
            caption: caption(|words| words.centres),
            scales,
        },
        ParticleView {
            part: circle::stepped(w, &found),
            caption: caption(|words| words.circle_diagram),
            scales: Vec::new(),
        },
    ];
    let missing = found.list.iter().filter(|c| c.place.is_none()).count();
    Ok(SteppedMethod { views, steps, missing, ..SteppedMethod::default() })
}

/// The centres that are found by lines, in their order, with only as many per drawing as keep its
/// lines distinct.
fn plates(found: &Centres) -> Vec<CentrePlate> {
    let by_lines =
        |how: &CentreMethod| matches!(how, CentreMethod::Lines(_) | CentreMethod::Velocities);
    // The list is in the order of finding.
    let order: Vec<usize> =
        (0..found.list.len()).filter(|k| by_lines(&found.list[*k].step.how)).collect();
    if order.len() <= MOST {
        return vec![CentrePlate::default()];
    }
    let count = order.len().div_ceil(PER_PLATE);
    order
        .chunks(order.len().div_ceil(count))
        .map(|c| CentrePlate { found: Some(c.to_vec()) })
        .collect()
}

/// A page for each plate, and one for the circle diagram with the order of finding.
fn parted(w: &FigureInput, found: &Centres, plates: Vec<CentrePlate>) -> Pages {
    let maker = SheetDrafter {
        scene: w.scene,
        worked: w.worked,
        options: w.options,
        certified: Vec::new(),
    };
    let words = maker.words();
    let (_, mu) = maker.caption(DiagramKind::Plane);
    let mut pages = Pages::new();
    let mut first = 1;
    for (k, plate) in plates.iter().enumerate() {
        let last = first + plate.found.as_ref().map_or(0, Vec::len) - 1;
        let caption = format!("{} {first} – {last}", words.centres);
        let part =
            maker.titled(diagram::part(w, found, plate), Label::text(caption), &mu, "centres");
        pages.push((
            format!("{}-{}", ENTRY.name, k + 1),
            described(maker.alone(part), w, found, words.centres),
        ));
        first = last + 1;
    }
    let circle = maker.titled(
        circle::part(w, found),
        Label::text(words.circle_diagram),
        &DrawingScales::default(),
        "circle",
    );
    pages.push((
        format!("{}-{}", ENTRY.name, plates.len() + 1),
        described(maker.alone(circle), w, found, words.circle_diagram),
    ));
    pages
}

fn described(mut figure: Figure, w: &FigureInput, found: &Centres, title: &str) -> Figure {
    figure.desc = format!("{title} {}", hodograph_report::centres::places(found, w.options.lang));
    figure
}

/// The figure: both drawings side by side, or one below the other.
fn figure(w: &FigureInput, found: &Centres) -> Figure {
    let maker = SheetDrafter {
        scene: w.scene,
        worked: w.worked,
        options: w.options,
        certified: Vec::new(),
    };
    let words = maker.words();
    let (_, mu) = maker.caption(DiagramKind::Plane);
    let first = maker.titled(
        diagram::part(w, found, &CentrePlate::default()),
        Label::text(format!("(a) {}", words.centres)),
        &mu,
        "centres",
    );
    let second = maker.titled(
        circle::part(w, found),
        Label::text(format!("(b) {}", words.circle_diagram)),
        &DrawingScales::default(),
        "circle",
    );
    let mut parts = [first, second];
    let trees = [
        Tree::row(vec![Tree::Leaf(0), Tree::Leaf(1)]),
        Tree::column(vec![Tree::Leaf(0), Tree::Leaf(1)]),
    ];
    // The arrangement that fills a page best, portrait or landscape.
    let fits = |[w, h]: [f64; 2]| {
        let [a, b] = AIM_MM.map(|mm| mm - 2.0 * MARGIN_MM);
        (a / w).min(b / h).max((b / w).min(a / h))
    };
    let [row, column] = trees.each_ref().map(|t| fits(t.size(&parts)));
    trees[usize::from(column > row)].put(&mut parts, Point::ORIGIN);
    described(
        maker.alone(DrawingPart::of(parts.into_iter().flat_map(|p| p.items).collect())),
        w,
        found,
        words.centres,
    )
}

/// The name of a centre in the label language: `P_{24}`.
fn symbol(scene: &Scene, pair: LinkPair) -> String {
    format!("P_{{{}}}", name_label(&pair.indices(scene)))
}
