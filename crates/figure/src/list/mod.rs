//! The figures that are asked for by name, one file and one entry each.
//!
//! What a new figure needs: a file that draws it and says its name, and its entry in [`LIST`]. The command line reads its choices and
//! their help from the list.

mod drawings;
mod equations;
mod forces;
mod gears;
mod kutzbach;
mod plates;
mod results;
mod sheet;

use hodograph_base::diag::{Faults, Warned};
use hodograph_scene::{DiagramKind, PointId, Scene};
use hodograph_worked::worked::Worked;

use super::attempts;
use super::centres;
use super::cognates;
use super::composite;
use super::curvature;
use super::inversions;
use super::mechanism::Overlay;
use super::sheet::Options;
use hodograph_paper::paper::item::Figure;

/// A figure that can be asked for.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Its name on the command line and in the names of files.
    pub name: &'static str,
    /// What it shows, in English and in Chinese.
    pub about: [&'static str; 2],
    /// Draws it: pages with the words that their files are named after; none where the scene does not call for it.
    pub draw: fn(&Wanted) -> Result<Warned<Pages>, Faults>,
}

/// Pages, each with the word that its file is named after; an empty word for the figure that is meant when none is named.
pub type Pages = Vec<(String, Figure)>;

/// All figures, in the order in which they are offered.
pub const LIST: &[&Entry] = &[
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
    &composite::ENTRY,
    &attempts::ENTRY,
    &curvature::ENTRY,
    &curvature::CENTRODES,
    &inversions::ENTRY,
    &cognates::ENTRY,
];

/// The figure that is drawn when none is named.
pub const USUAL: &Entry = &sheet::ENTRY;

/// The figure on which vectors, dimensions and paths are drawn.
pub const MECHANISM: &Entry = &drawings::MECHANISM;

/// The figure of a name.
pub fn named(name: &str) -> Option<&'static Entry> {
    LIST.iter().find(|e| e.name == name).copied()
}

/// What a figure is drawn from.
pub struct Wanted<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The same worked through, with all positions.
    pub worked: &'a Worked,
    /// How it is written.
    pub options: &'a Options,
    /// What is drawn with the mechanism.
    pub extras: &'a Extras,
}

/// What is drawn with the mechanism.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Extras {
    /// Vectors of this polygon at its points.
    pub vectors: Option<DiagramKind>,
    /// The given lengths as dimensions.
    pub dimensions: bool,
    /// So many positions of the first driver.
    pub poses: usize,
    /// Points whose paths are shown.
    pub points: Vec<PointId>,
}

impl Extras {
    /// Whether there is anything.
    pub fn any(&self) -> bool {
        self.vectors.is_some() || self.dimensions || self.poses > 0 || !self.points.is_empty()
    }

    /// Whether the mechanism alone can show it: positions have a sheet of their own.
    pub fn of_mechanism_alone(&self) -> bool {
        self.vectors.is_some() || self.dimensions || self.poses == 0 && !self.points.is_empty()
    }

    /// The same as lines over and behind the mechanism.
    pub fn overlay(&self, scene: &Scene, worked: &Worked) -> Overlay {
        let overlay = Overlay { vectors: self.vectors, dimensions: self.dimensions, ..Overlay::default() };
        if self.poses > 0 || !self.points.is_empty() {
            return overlay.with_motion(scene, worked, self.poses, &self.points);
        }
        overlay
    }
}

/// One page, or none.
pub(super) fn page(name: &str, figure: Option<Figure>) -> Result<Warned<Pages>, Faults> {
    Ok(Warned { value: figure.into_iter().map(|f| (name.to_owned(), f)).collect(), notes: Vec::new() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_and_told_in_both_languages() {
        for (k, entry) in LIST.iter().enumerate() {
            assert!(LIST[..k].iter().all(|e| e.name != entry.name), "{} is there twice", entry.name);
            assert!(named(entry.name).is_some_and(|e| e.name == entry.name));
            assert!(entry.about[0].is_ascii() && !entry.about[1].is_ascii(), "{:?}", entry.about);
        }
        assert!(named(USUAL.name).is_some() && named(MECHANISM.name).is_some());
    }
}
