//! Pages of a document: items in mm of paper, with their structural role. The format (`pdf`) and
//! the layout (the worksheet's pages) are decided elsewhere.

use crate::paper::item::{Colour, Figure, FigureItem, Shape};
use hodograph_base::geom::Point;

/// The role of a run of items, for readers that follow a document's structure.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "wire", derive(serde::Serialize, serde::Deserialize))]
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
#[cfg_attr(feature = "wire", derive(serde::Serialize, serde::Deserialize))]
pub struct Part {
    /// Role of the items.
    pub kind: Kind,
    /// The items.
    pub items: Vec<FigureItem>,
}

/// A page of a document.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "wire", derive(serde::Serialize, serde::Deserialize))]
pub struct Page {
    /// Width of the paper.
    pub width_mm: f64,
    /// Height of the paper.
    pub height_mm: f64,
    /// The parts of the page, in reading order, which is also the drawing order.
    pub parts: Vec<Part>,
}

impl Page {
    /// Returns the page of a figure, as large as the figure.
    pub fn of(f: &Figure) -> Page {
        let words = if f.desc.is_empty() { &f.title } else { &f.desc };
        let mut parts = vec![Part { kind: Kind::Figure(words.clone()), items: f.items.clone() }];
        // White is the colour of the paper itself.
        if f.paper != Colour::WHITE {
            let corners =
                [(0.0, 0.0), (f.width_mm, 0.0), (f.width_mm, f.height_mm), (0.0, f.height_mm)];
            let points = corners.map(|(x, y)| Point::new(x, y)).to_vec();
            let ground =
                Shape::Polyline { points, closed: true, stroke: None, fill: Some(f.paper) };
            parts
                .insert(0, Part { kind: Kind::Artifact, items: vec![FigureItem::new("", ground)] });
        }
        Page { width_mm: f.width_mm, height_mm: f.height_mm, parts }
    }
}
