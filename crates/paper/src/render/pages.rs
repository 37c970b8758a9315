//! Pages of a document: items in mm of paper, with their structural role. The format (`pdf`) and
//! the layout (the worksheet's pages) are decided elsewhere.

use crate::paper::item::FigureItem;

/// The role of a run of items, for readers that follow a document's structure.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// A heading, from level 1 down; it is also a bookmark.
    Heading {
        /// Level, 1 for the title.
        level: u16,
        /// Text of the heading.
        title: String,
    },
    /// Running text.
    Paragraph,
    /// Members of a list, which may continue in the next part.
    List {
        /// True if the list is numbered.
        numbered: bool,
        /// The list member of each item, from 0.
        members: Vec<usize>,
    },
    /// A table of values: row and column of each item, from 0, row by row. The first row and the
    /// first column are headers; items after those are rules.
    Table(Vec<[usize; 2]>),
    /// A formula or the table of an equation, with its text for screen readers.
    Formula(String),
    /// A picture, with its description.
    Figure(String),
    /// Not part of the text: page numbers, rules.
    Artifact,
}

/// A run of items of a page.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Role of the items.
    pub kind: Kind,
    /// The items.
    pub items: Vec<FigureItem>,
}

/// A page of a document.
#[derive(Clone, Debug, PartialEq)]
pub struct Page {
    /// Width of the paper.
    pub width_mm: f64,
    /// Height of the paper.
    pub height_mm: f64,
    /// The parts of the page, in reading order, which is also the drawing order.
    pub parts: Vec<Part>,
}
