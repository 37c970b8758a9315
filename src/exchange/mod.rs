//! Files of other programs: drawings as DXF, constructions for GeoGebra, linkages for pylinkage and
//! PMKS in both directions, slides for PowerPoint, drawings in books of mdBook.
//!
//! [`Linkage`] is what programs for linkages describe: joints with their places, links, one crank,
//! slides on the ground. It is made from a solved scene or read from a file, and gives the text of a
//! scene. [`export()`] and [`import()`] go from file to file. [`order()`] places its joints one after
//! the other, as GeoGebra and pylinkage do.

mod drawing;
mod formats;
pub mod geogebra;
mod linkage;
#[cfg(feature = "cli")]
pub mod mdbook;
mod placing;
pub mod pmks;
#[cfg(feature = "png")]
pub mod pptx;
pub mod pylinkage;
mod scene;

pub use drawing::{drawing, mechanism};
pub use formats::{ExportFormat, ImportFormat, export, import};
pub use linkage::{Linkage, LinkageBody, LinkageJoint, LinkageSlide};
pub use placing::{PlacedJoint, PlacingRule, order};
pub use scene::{ImportedLinkage, scene};
