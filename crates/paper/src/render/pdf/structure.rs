//! Lists and tables as PDF structure: list members that are drawn part by part, and table cells
//! with their headers.
//!
//! This module decides which tags contain what is drawn; [`Kind`](crate::render::pages::Kind)
//! decides what is a list or a table.

use krilla::surface::Surface;
use krilla::tagging::{Identifier, ListNumbering, TableHeaderScope, Tag, TagGroup};

use super::{PdfPaper, PdfWriter};
use crate::paper::item::FigureItem;

/// A list whose parts are not all drawn yet.
pub(super) struct OpenList {
    numbered: bool,
    /// The contents of each member, by its number.
    members: Vec<(usize, Vec<Identifier>)>,
}

impl PdfWriter<'_> {
    /// Draws members of a list. Members that start at 0 again, or change the numbering, start
    /// another list.
    pub(super) fn list(
        &mut self,
        surface: &mut Surface,
        paper: PdfPaper,
        items: &[FigureItem],
        numbered: bool,
        members: &[usize],
    ) {
        let mut rest = items;
        for run in members.chunk_by(|a, b| a == b) {
            let (these, others) = rest.split_at(run.len().min(rest.len()));
            rest = others;
            let (member, content) = (run[0], self.content(surface, paper, these));
            let goes_on = |l: &OpenList| {
                l.numbered == numbered && l.members.last().is_some_and(|(last, _)| *last <= member)
            };
            if !self.list.as_ref().is_some_and(goes_on) {
                self.end_list();
            }
            let list = self.list.get_or_insert(OpenList { numbered, members: Vec::new() });
            match list.members.last_mut() {
                Some((last, contents)) if *last == member => contents.push(content),
                _ => list.members.push((member, vec![content])),
            }
        }
    }

    pub(super) fn end_list(&mut self) {
        let Some(OpenList { numbered, members }) = self.list.take() else { return };
        let mut list = TagGroup::new(Tag::L(if numbered {
            ListNumbering::Decimal
        } else {
            ListNumbering::None
        }));
        for (_, contents) in members {
            let mut body = TagGroup::new(Tag::LBody);
            contents.into_iter().for_each(|c| body.push(c));
            let mut member = TagGroup::new(Tag::LI);
            member.push(body);
            list.push(member);
        }
        self.tags.push(list.into());
    }

    /// Draws a table: each row has all columns, and each header cell its scope.
    pub(super) fn table(
        &self,
        surface: &mut Surface,
        paper: PdfPaper,
        items: &[FigureItem],
        cells: &[[usize; 2]],
    ) -> TagGroup {
        let count = |k: usize| cells.iter().map(|at| at[k] + 1).max().unwrap_or(0);
        let (written, rules) = items.split_at(cells.len().min(items.len()));
        let mut written = written.iter().zip(cells).peekable();
        let mut table = TagGroup::new(Tag::Table);
        for r in 0..count(0) {
            let mut row = TagGroup::new(Tag::TR);
            for c in 0..count(1) {
                let mut cell = match [r, c] {
                    [0, _] => TagGroup::new(Tag::TH(TableHeaderScope::Column)),
                    [_, 0] => TagGroup::new(Tag::TH(TableHeaderScope::Row)),
                    [_, _] => TagGroup::new(Tag::TD),
                };
                if let Some((item, _)) = written.next_if(|(_, at)| **at == [r, c]) {
                    cell.push(self.content(surface, paper, std::slice::from_ref(item)));
                }
                row.push(cell);
            }
            table.push(row);
        }
        self.artifact(surface, paper, rules);
        table
    }
}
