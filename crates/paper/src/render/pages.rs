//! Pages of a document: items in mm of paper, with what they are for a reader that follows its structure. Not decided here: how a
//! format writes them (`pdf`), where anything stands (the worksheet's pages).

use crate::paper::item::Item;

/// What a run of items is, for readers that follow a document's structure.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// A heading, from 1 down; it is also a bookmark.
    Heading {
        /// 1 for the title.
        level: u16,
        /// Its words.
        title: String,
    },
    /// Running text.
    Paragraph,
    /// A formula or a table of one, with its reading.
    Formula(String),
    /// A picture, with what it shows in words.
    Figure(String),
    /// No part of the text: page numbers, rules.
    Artifact,
}

/// A run of items of a page.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// What it is.
    pub kind: Kind,
    /// Its items.
    pub items: Vec<Item>,
}

/// A page of a document.
#[derive(Clone, Debug, PartialEq)]
pub struct Page {
    /// Width of the paper.
    pub width_mm: f64,
    /// Height of the paper.
    pub height_mm: f64,
    /// What stands on it, in the order of reading; drawn in this order too.
    pub parts: Vec<Part>,
}
