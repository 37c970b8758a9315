//! The figures that can be requested by name, one file and one entry each.
//!
//! A new figure needs a file that draws it and gives its name, and an entry in [`LIST`]. The
//! command line takes its choices and their help from this list.

mod cam;
mod drawings;
mod equations;
mod forces;
mod gears;
mod groups;
mod kutzbach;
mod plates;
mod replaced;
mod results;
mod sheet;

use hodograph_base::diag::{Faults, Warned};
use hodograph_scene::{DiagramKind, PointId, Scene};
use hodograph_worked::worked::Worked;

use super::attempts;
use super::centres;
use super::cognates;
use super::composite;
use super::coriolis;
use super::curvature;
use super::derivation;
use super::evolution;
use super::extremes;
use super::inversions;
use super::loops;
use super::mechanism::Overlay;
use super::sheet::SheetOptions;
use super::transmission;
use hodograph_paper::paper::item::Figure;

/// A figure that can be requested.
#[derive(Clone, Copy, Debug)]
pub struct FigureEntry {
    /// The name on the command line and in file names.
    pub name: &'static str,
    /// The content, in English and in Chinese.
    pub about: [&'static str; 2],
    /// Draws the figure: pages with the words for their file names; no pages if the scene does not
    /// apply.
    pub draw: fn(&FigureInput) -> Result<Warned<Pages>, Faults>,
}

/// Pages, each with the word for its file name; the word is empty for the default figure.
pub type Pages = Vec<(String, Figure)>;

/// All figures, in the order of the help.
pub const LIST: &[&FigureEntry] = &[
    &sheet::ENTRY,
    &drawings::MECHANISM,
    &drawings::VELOCITY,
    &drawings::ACCELERATION,
    &forces::ENTRY,
    &forces::LEVER,
    &plates::ENTRY,
    &equations::ENTRY,
    &results::ENTRY,
    &centres::ENTRY,
    &kutzbach::ENTRY,
    &gears::ENTRY,
    &cam::ENTRY,
    &cam::INSTANT,
    &replaced::ENTRY,
    &groups::ENTRY,
    &extremes::ENTRY,
    &transmission::ENTRY,
    &composite::ENTRY,
    &derivation::ENTRY,
    &coriolis::ENTRY,
    &coriolis::CASES_ENTRY,
    &loops::ENTRY,
    &attempts::ENTRY,
    &curvature::ENTRY,
    &curvature::CENTRODES,
    &inversions::ENTRY,
    &evolution::ENTRY,
    &cognates::ENTRY,
];

/// The default figure.
pub const USUAL: &FigureEntry = &sheet::ENTRY;

/// The figure on which vectors, dimensions and paths are drawn.
pub const MECHANISM: &FigureEntry = &drawings::MECHANISM;

/// Returns the figure with a name.
pub fn named(name: &str) -> Option<&'static FigureEntry> {
    LIST.iter().find(|e| e.name == name).copied()
}

/// The input of a figure.
pub struct FigureInput<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The worked scene, with all positions.
    pub worked: &'a Worked,
    /// The options of style and language.
    pub options: &'a SheetOptions,
    /// The additions to the mechanism.
    pub extras: &'a Extras,
}

/// Additions to the drawing of the mechanism.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Extras {
    /// Vectors of this polygon at the mechanism's points.
    pub vectors: Option<DiagramKind>,
    /// True if the given lengths are drawn as dimensions.
    pub dimensions: bool,
    /// Number of positions of the first driver.
    pub poses: usize,
    /// Points with their paths shown.
    pub points: Vec<PointId>,
}

impl Extras {
    /// Returns true if there is any addition.
    pub fn any(&self) -> bool {
        self.vectors.is_some() || self.dimensions || self.poses > 0 || !self.points.is_empty()
    }

    /// Returns true if the mechanism alone can show the additions: positions have a separate sheet.
    pub fn of_mechanism_alone(&self) -> bool {
        self.vectors.is_some() || self.dimensions || self.poses == 0 && !self.points.is_empty()
    }

    /// Returns the additions as lines over and behind the mechanism.
    pub fn overlay(&self, scene: &Scene, worked: &Worked) -> Overlay {
        let overlay =
            Overlay { vectors: self.vectors, dimensions: self.dimensions, ..Overlay::default() };
        if self.poses > 0 || !self.points.is_empty() {
            return overlay.with_motion(scene, worked, self.poses, &self.points);
        }
        overlay
    }
}

/// Returns one page, or none.
pub(super) fn page(name: &str, figure: Option<Figure>) -> Result<Warned<Pages>, Faults> {
    Ok(Warned {
        value: figure.into_iter().map(|f| (name.to_owned(), f)).collect(),
        notes: Vec::new(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_and_told_in_both_languages() {
        for (k, entry) in LIST.iter().enumerate() {
            assert!(
                LIST[..k].iter().all(|e| e.name != entry.name),
                "{} is there twice",
                entry.name
            );
            assert!(named(entry.name).is_some_and(|e| e.name == entry.name));
            assert!(entry.about[0].is_ascii() && !entry.about[1].is_ascii(), "{:?}", entry.about);
        }
        assert!(named(USUAL.name).is_some() && named(MECHANISM.name).is_some());
    }
}
