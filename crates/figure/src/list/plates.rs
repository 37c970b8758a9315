//! The polygons of a mechanism with many links, split by group: an A4 page for the additions of
//! each group, with its equations.

use crate::arrange::{Tree, put_together};
use crate::polygon::plates;
use crate::scales::DrawingScales;
use crate::sheet::SheetDrafter;
use hodograph_base::diag::{Faults, Warned};
use hodograph_base::lang::{each, tr};
use hodograph_paper::paper::drawing::DrawingPart;
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::phrase::Phrase;
use hodograph_paper::paper::style::Captioned;
use hodograph_report::plan::group_set;
use hodograph_scene::DiagramKind;
use hodograph_worked::certified::{certify, steps};

use super::{FigureEntry, FigureInput, Pages};

/// The plates.
pub const ENTRY: FigureEntry = FigureEntry {
    name: "plates",
    about: each!("The polygons split by group, with the equations of each"),
    draw,
};

fn draw(w: &FigureInput) -> Result<Warned<Pages>, Faults> {
    let certified = certify(w.scene, w.worked, w.options.digits);
    let maker = SheetDrafter { scene: w.scene, worked: w.worked, options: w.options, certified };
    let numbers = steps(w.scene, w.worked, None);
    let (writer, lang) = (maker.writer(), w.options.lang);
    let mut pages = Pages::new();
    for on in DiagramKind::POLYGONS {
        let Some(polygon) = w.worked.construction.polygon(on) else { continue };
        for plate in plates(&w.options.style, &writer, &w.worked.mechanism, polygon) {
            let m = &w.worked.mechanism;
            let group = m
                .assur_of(w.scene, plate.groups[0])
                .map(|g| group_set(w.scene, m, &g, lang).label());
            let words = Phrase::new(&format!(
                "{}{}",
                maker.name(Captioned::Drawing(on)),
                tr!(lang, "clause" => ", ")
            ))
            .label();
            let words = group.into_iter().fold(words, Label::then);
            let mu = DrawingScales::of(&w.scene.book, on, plate.mu);
            let drawn = maker.titled(plate.part, words, &mu, on.prefix());
            let mut parts: Vec<DrawingPart> = vec![drawn];
            parts.extend(
                maker.tables(&writer, &numbers).parts_of(on, |g| plate.groups.contains(&g)),
            );
            let written: Vec<Tree> = (1..parts.len()).map(Tree::Leaf).collect();
            let tree = Tree::row(vec![Tree::Leaf(0), Tree::text_column(written)]);
            let kind = on.word();
            let number = pages.iter().filter(|(name, _)| name.starts_with(kind)).count() + 1;
            pages.push((format!("{kind}-{number}"), maker.alone(put_together(tree, parts))));
        }
    }
    Ok(Warned { value: pages, notes: Vec::new() })
}
