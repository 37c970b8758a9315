//! Figures as typed items in millimetres of paper, with labels in the label language, fonts, and
//! the placement of labels.
//!
//! Everything in this module is y up and independent of file formats; [`crate::render`] turns an
//! [`item::Figure`] into ink.

pub mod arrow;
pub mod broken;
pub mod drawing;
pub mod extent;
pub mod font;
pub mod grid;
pub mod item;
pub mod label;
pub mod lines;
pub mod memory;
pub mod phrase;
pub mod place;
pub mod shown;
pub mod style;
pub mod symbols;
pub mod text;
pub mod words;
