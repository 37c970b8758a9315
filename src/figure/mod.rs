//! The figure as typed items in millimetres of paper.
//!
//! Everything here is y up and knows no file format; [`crate::render`] turns a [`item::Figure`] into ink.

pub(crate) use crate::paper::{arrow, drawing, extent, font, grid, item, label, place, style, symbols, text, words};

pub(crate) use crate::paper::lines;

mod arrange;
pub mod attempts;
pub mod cam;
mod centres;
mod cognates;
mod composite;
pub(crate) mod course;
mod curvature;
pub mod curves;
pub mod fit;
mod gears;
pub mod groups;
pub(crate) mod hodograph;
mod inversions;
mod kutzbach;
pub mod list;
pub mod mechanism;
pub mod particle;
pub mod path;
mod plot;
pub mod polygon;
pub mod poses;
pub mod price;
pub(crate) mod remarks;
pub mod results;
pub(crate) mod series;
pub mod sheet;
pub mod steps;
pub mod synthesis;
pub(crate) mod tables;
