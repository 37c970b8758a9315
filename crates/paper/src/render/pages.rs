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
    /// Members of a list, which may go on in the part that follows.
    List {
        /// Whether its marks are numbers.
        numbered: bool,
        /// Which member of its list each item belongs to, from 0.
        members: Vec<usize>,
    },
    /// A table of values: row and column of each item, from 0, row by row. The first row and the first column are heads; items after
    /// those are rules.
    Table(Vec<[usize; 2]>),
    /// A formula or the table of an equation, with its reading.
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
