//! The figure as typed items in millimetres of paper.
//!
//! Everything here is y up and knows no file format; [`crate::render`] turns a [`item::Figure`] into ink.

mod arrange;
pub mod arrow;
pub mod attempts;
pub mod cam;
mod centres;
mod cognates;
mod composite;
pub(crate) mod course;
mod curvature;
pub mod curves;
pub mod drawing;
pub mod extent;
pub mod font;
mod gears;
pub mod grid;
pub mod groups;
pub mod hodograph;
mod inversions;
pub mod item;
mod kutzbach;
pub mod label;
pub(crate) mod lines;
pub mod list;
pub mod mechanism;
pub mod path;
pub mod place;
mod plot;
pub mod polygon;
pub mod poses;
pub mod price;
pub(crate) mod remarks;
pub mod results;
pub mod series;
pub mod sheet;
pub mod steps;
pub mod style;
pub mod symbols;
pub mod synthesis;
pub mod tables;
pub mod text;
pub mod words;
