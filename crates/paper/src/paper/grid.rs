//! Places labels in rows and columns, as in equation tables and results.
//!
//! This module decides only the positions of the cells. The origin is the upper left corner; rows
//! go down.

use hodograph_base::geom::Point;

use super::item::{Anchor, Colour, FigureItem, Shape};
use super::label::Label;
use super::text;

/// One cell of a grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// The text of the cell.
    pub label: Label,
    /// Type size.
    pub size_mm: f64,
    /// Alignment in the column.
    pub anchor: Anchor,
    /// Class of the item.
    pub class: String,
    /// Name of the item.
    pub id: String,
}

/// A row: its cells from the first column on (`None`: empty), and its height.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The cells, one per column.
    pub cells: Vec<Option<Cell>>,
    /// Distance of this row's baseline from the previous one (for the first row: from the top).
    pub height_mm: f64,
}

/// Places rows in columns that are as wide as their widest cell, with gaps of `gap_mm`.
pub fn set(rows: &[Row], gap_mm: f64) -> Vec<FigureItem> {
    let columns = rows.iter().map(|r| r.cells.len()).max().unwrap_or(0);
    let width = |c: &Cell| text::set(&c.label).width_em * c.size_mm;
    let widths: Vec<f64> = (0..columns)
        .map(|k| {
            rows.iter().filter_map(|r| r.cells.get(k)?.as_ref()).map(width).fold(0.0, f64::max)
        })
        .collect();
    let mut items = Vec::new();
    let mut y = 0.0;
    for row in rows {
        y -= row.height_mm;
        let mut x = 0.0;
        for (cell, wide) in row.cells.iter().zip(&widths) {
            if let Some(c) = cell {
                let dx = match c.anchor {
                    Anchor::Start => 0.0,
                    Anchor::Middle => wide / 2.0,
                    Anchor::End => *wide,
                };
                let shape = Shape::Label {
                    at: Point::new(x + dx, y),
                    label: c.label.clone(),
                    size_mm: c.size_mm,
                    anchor: c.anchor,
                    colour: Colour::BLACK,
                };
                items.push(FigureItem::new(c.class.clone(), shape).with_id(c.id.clone()));
            }
            // An empty column has no gap.
            x += if *wide > 0.0 { wide + gap_mm } else { 0.0 };
        }
    }
    items
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cell(text: &str, anchor: Anchor) -> Option<Cell> {
        Some(Cell {
            label: Label::text(text),
            size_mm: 4.0,
            anchor,
            class: "cell".into(),
            id: text.into(),
        })
    }

    #[test]
    fn columns_are_as_wide_as_their_widest_cell() {
        // Digits of Times are half an em, 2 mm here.
        let rows = [
            Row { cells: vec![cell("20", Anchor::End), cell("1", Anchor::Middle)], height_mm: 5.0 },
            Row {
                cells: vec![cell("1", Anchor::End), None, cell("2", Anchor::Start)],
                height_mm: 6.0,
            },
        ];
        let at: Vec<Point> = set(&rows, 3.0)
            .iter()
            .map(|i| match i.shape {
                Shape::Label { at, .. } => at,
                _ => unreachable!("a grid has labels only"),
            })
            .collect();
        assert_eq!(
            at,
            [
                Point::new(4.0, -5.0),
                Point::new(8.0, -5.0),
                Point::new(4.0, -11.0),
                Point::new(12.0, -11.0)
            ]
        );
    }
}
