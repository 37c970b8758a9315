//! What figures are made of: typed items in millimetres of paper, labels in a language of their own, fonts, and where labels are put.
//!
//! Everything here is y up and knows no file format; [`crate::render`] turns an [`item::Figure`] into ink.

pub mod arrow;
pub mod broken;
pub mod drawing;
pub mod extent;
pub mod font;
pub mod grid;
pub mod item;
pub mod label;
pub mod lines;
pub mod phrase;
pub mod place;
pub mod shown;
pub mod style;
pub mod symbols;
pub mod text;
pub mod words;
