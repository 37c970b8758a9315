//! Arranges a crowded sheet in columns that are read one after the other, as in a newspaper: the
//! drawings, then all equations, then the results. A column holds whole drawings and any number of
//! lines of equations.

use super::{BoxDirection, GAP_MM, HEADING_AIR_MM, SheetLayout, Tree};

/// The greatest number of parts: the time grows with its cube. No page holds more, in columns or not.
const MOST_PARTS: usize = 100;
/// Heights at which columns are set: their number, and their differences relative to the page.
const HEIGHTS: usize = 100;
const HEIGHT_STEP: f64 = 0.02;
/// Least height of a column of text, relative to the height of all columns.
const LEAST_TEXT: f64 = 0.5;
/// Gap between columns: less than between the parts of a spacious sheet.
const COLUMN_GAP_MM: f64 = 7.0;

impl SheetLayout {
    /// The columns of least width for each of several heights, from that of the page upwards.
    pub(super) fn in_columns(&self, aim: [f64; 2]) -> Vec<Tree> {
        let lines = self.equations.iter().flatten();
        let order: Vec<usize> =
            self.drawings.iter().chain(lines).chain([&self.results]).copied().collect();
        if order.len() > MOST_PARTS {
            return Vec::new();
        }
        let sizes: Vec<Vec<[f64; 2]>> = (1..=order.len())
            .map(|end| (0..end).map(|start| self.run_mm(&order[start..end])).collect())
            .collect();
        let title_mm = self.title.map_or(0.0, |k| self.parts[k].bounds.height_mm() + GAP_MM);
        let set = |k: usize| {
            let height_mm = (1.0 + HEIGHT_STEP * k as f64) * aim[1] - title_mm;
            let starts = narrowest(&sizes, self.drawings.len(), height_mm)?;
            let ends = starts.iter().copied().skip(1).chain([order.len()]);
            let runs = starts.iter().zip(ends).map(|(start, end)| &order[*start..end]);
            Some(vec![Tree::Group {
                along: BoxDirection::Row,
                gap_mm: COLUMN_GAP_MM,
                children: runs.map(|run| self.column(run)).collect(),
                centred: false,
            }])
        };
        self.complete((0..HEIGHTS).filter_map(set).collect())
    }

    fn is_heading(&self, part: usize) -> bool {
        self.equations.iter().any(|lines| lines.first() == Some(&part))
    }

    /// The size of consecutive parts in a column. None ends with a heading.
    fn run_mm(&self, run: &[usize]) -> [f64; 2] {
        let [width, height] = self.column(run).size(&self.parts);
        let headed = run.last().is_some_and(|part| self.is_heading(*part));
        [width, if headed { f64::INFINITY } else { height }]
    }

    /// Consecutive parts one below the other: the drawings, centred, and the text below them.
    fn column(&self, run: &[usize]) -> Tree {
        let mut lines = Vec::new();
        for part in run.iter().filter(|part| self.equations.iter().any(|e| e.contains(*part))) {
            if self.is_heading(*part) && !lines.is_empty() {
                lines.push(Tree::Air(HEADING_AIR_MM));
            }
            lines.push(Tree::Leaf(*part));
        }
        let leaves = |of: &[usize]| -> Vec<Tree> {
            run.iter().filter(|part| of.contains(*part)).map(|part| Tree::Leaf(*part)).collect()
        };
        let mut text = if lines.is_empty() { Vec::new() } else { vec![Tree::text_column(lines)] };
        text.extend(leaves(&[self.results]));
        let text = Tree::Group {
            along: BoxDirection::Column,
            gap_mm: GAP_MM,
            children: text,
            centred: false,
        };
        Tree::column(leaves(&self.drawings).into_iter().chain([text]).collect())
    }
}

/// The first part of each column, for the least width of all columns that are not higher than this:
/// the shortest path from the first part to the last. `None` if a part is higher. A column without
/// one of the `drawings`, which come first, has a least height, except the last. `sizes` are those of
/// all runs of parts, by the number of parts up to the end, then by the first one.
fn narrowest(sizes: &[Vec<[f64; 2]>], drawings: usize, height_mm: f64) -> Option<Vec<usize>> {
    // For each number of parts: the least width, and the part that begins the last column.
    let mut least = vec![(-COLUMN_GAP_MM, 0)];
    for runs in sizes {
        let is_last = runs.len() == sizes.len();
        let fitting = runs.iter().enumerate().filter(|(start, [_, high])| {
            let short = *high < LEAST_TEXT * height_mm;
            *high <= height_mm && (*start < drawings || is_last || !short)
        });
        let columns =
            fitting.map(|(start, [wide, _])| (least[start].0 + COLUMN_GAP_MM + wide, start));
        let best = columns.min_by(|a, b| a.0.total_cmp(&b.0));
        least.push(best.unwrap_or((f64::INFINITY, 0)));
    }
    if least.last().is_none_or(|(width, _)| width.is_infinite()) {
        return None;
    }
    let (mut starts, mut end) = (Vec::new(), sizes.len());
    while end > 0 {
        end = least[end].1;
        starts.push(end);
    }
    starts.reverse();
    Some(starts)
}
