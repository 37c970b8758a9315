//! Files of other programs: drawings as DXF, constructions for GeoGebra, linkages for pylinkage and
//! PMKS in both directions, slides for PowerPoint, drawings in books of mdBook.
//!
//! [`Linkage`] is what programs for linkages describe: joints with their places, links, one crank,
//! slides on the ground. It is made from a solved scene or read from a file, and gives the text of a
//! scene. [`order()`] places its joints one after the other, as GeoGebra and pylinkage do.

mod drawing;
pub mod geogebra;
mod linkage;
pub mod mdbook;
mod placing;
pub mod pmks;
pub mod pptx;
pub mod pylinkage;
mod scene;

pub use drawing::{drawing, mechanism};
pub use linkage::{Linkage, LinkageBody, LinkageJoint, LinkageSlide};
pub use placing::{PlacedJoint, PlacingRule, order};
pub use scene::{ImportedLinkage, scene};
