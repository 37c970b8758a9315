//! The figure as typed items in millimetres of paper.
//!
//! Everything here is y up and knows no file format; [`crate::render`] turns a [`item::Figure`] into ink.

pub mod arrow;
pub mod extent;
pub mod font;
pub mod item;
pub mod label;
pub mod place;
pub mod sheet;
pub mod style;
pub mod symbols;
pub mod text;
