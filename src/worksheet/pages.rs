//! A worksheet as A4 pages of the display list, for the PDF writer (`render::pdf::document`).
//!
//! This module breaks pages: a heading stays with the block after it, a table or drawing is never
//! cut, and a drawing that does not fit moves to the top of the next page while the text continues
//! before it. It also numbers the pages. Drawings keep their millimetres, because their scales are
//! true; a drawing larger than the text area gets a page of its own size. [`blocks`] makes the
//! boxes that are placed on the pages.

mod blocks;

use std::collections::VecDeque;

use super::{Document, DocumentBlock};
use crate::geom::{Point, Vec2};
use crate::paper::extent::{bounds, translate};
use crate::paper::font::own::Fonts;
use crate::paper::item::{Anchor, Colour, FigureItem, Shape};
use crate::paper::label::Label;
use crate::render::pages::{Kind, Page, Part};

/// A4.
const PAPER_MM: [f64; 2] = [210.0, 297.0];
/// Margins left and right: lines of 174 mm hold some 85 letters.
const SIDE_MM: f64 = 18.0;
/// Margins above and below; the page number is in the lower one.
const TOP_MM: f64 = 18.0;
const BOTTOM_MM: f64 = 18.0;
/// The page number's baseline.
const FOOT_MM: f64 = 10.0;
/// Width of the text.
const FULL_MM: f64 = PAPER_MM[0] - 2.0 * SIDE_MM;
/// A drawing up to this part of the text's width is placed at the right, with text beside it.
const BESIDE_PART: f64 = 0.42;
/// The limit for a drawing under a heading of its own, such as a polygon: its steps are beside it.
const HEADED_PART: f64 = 0.58;
/// The limit for a side that would otherwise overflow its page: the text keeps 45 mm, some twenty
/// letters.
const WIDE_BESIDE_PART: f64 = 0.69;
/// Gap between such a drawing and the text.
const BESIDE_GAP_MM: f64 = 8.0;
/// Size of the type: 11 point.
const TEXT_MM: f64 = 3.9;
/// Distance of baselines, in em: formulas in a line have superscripts and subscripts.
const LINE_EM: f64 = 1.6;
/// Distance of baselines in close setting: with less, the scripts of two lines touch.
const CLOSE_LINE_EM: f64 = 1.4;

/// Parameters by which a side is set.
#[derive(Clone, Copy)]
struct Setting {
    /// Distance of baselines.
    line_em: f64,
    /// Drawings up to this part of the text's width are placed at the right.
    beside_part: f64,
    /// True if lists of short members have two columns.
    columns: bool,
    /// True if pages are filled to the end: a table of values continues on the next page with its
    /// head repeated, and text precedes a drawing that does not fit wherever a few lines of it do.
    filled: bool,
}

/// The default setting, and the settings that are tried to save a page, with the smallest change
/// first.
const USUAL: Setting =
    Setting { line_em: LINE_EM, beside_part: BESIDE_PART, columns: false, filled: false };
const CLOSER: [Setting; 5] = [
    Setting { line_em: CLOSE_LINE_EM, ..USUAL },
    Setting { line_em: CLOSE_LINE_EM, columns: true, ..USUAL },
    Setting { beside_part: WIDE_BESIDE_PART, ..USUAL },
    Setting { line_em: CLOSE_LINE_EM, beside_part: WIDE_BESIDE_PART, ..USUAL },
    Setting { line_em: CLOSE_LINE_EM, columns: true, filled: true, ..USUAL },
];

/// Limit of pages: a side of more pages is not set closer. One page less is hardly noticed there,
/// and each setting takes as long as the first.
const LONG: usize = 8;

/// Sets a document on pages. Each side begins a new page and is set closer where that saves a page.
/// A side of one page and a few lines gets its short lists in columns, or else its drawing beside
/// the text.
pub fn pages(document: &Document) -> Vec<Page> {
    let begins = |b: &DocumentBlock| matches!(b, DocumentBlock::Heading(1, _));
    let mut pages = Vec::new();
    for (k, side) in document.blocks.chunk_by(|_, next| !begins(next)).enumerate() {
        let title = (k == 0).then_some(document.title.as_str());
        let mut best = set(document, title, side, USUAL);
        for setting in CLOSER {
            // A narrow column beside a wide drawing is used only if everything then fits on one
            // page.
            let most = if setting.beside_part > BESIDE_PART { 2 } else { best.len() };
            if (2..=LONG).contains(&best.len()) {
                let other = set(document, title, side, setting);
                best = if other.len() < most { other } else { best };
            }
        }
        pages.extend(best);
    }
    let count = pages.len();
    for (n, page) in pages.iter_mut().enumerate() {
        let label = Label::text(format!("{} / {count}", n + 1)).in_fonts(&document.fonts);
        let foot =
            line(&label, Point::new(page.width_mm / 2.0, FOOT_MM), TEXT_MM * 0.9, Anchor::Middle);
        page.parts.push(Part { kind: Kind::Artifact, items: vec![foot] });
    }
    pages
}

fn set(
    document: &Document,
    title: Option<&str>,
    blocks: &[DocumentBlock],
    setting: Setting,
) -> Vec<Page> {
    let mut setter = PageSetter::new(setting, document.fonts.clone());
    if let Some(title) = title {
        setter.heading(0, title);
    }
    for block in blocks {
        match block {
            DocumentBlock::Heading(level, text) => setter.heading(usize::from(*level), text),
            DocumentBlock::Paragraph(p) => setter.paragraph(p),
            DocumentBlock::List { numbered, members } => setter.list(*numbered, members),
            DocumentBlock::Table(t) => setter.table(t),
            DocumentBlock::Formula(parts) => setter.formula(parts),
            DocumentBlock::Figure { figure, .. } => setter.figure(figure),
        }
    }
    setter.finish_page();
    setter.pages
}

/// A box that is placed on a page as a whole; its items hang below the origin.
struct Chunk {
    kind: Kind,
    items: Vec<FigureItem>,
    height_mm: f64,
    /// Space above, except at the top of a page.
    air_mm: f64,
}

struct PageSetter {
    setting: Setting,
    fonts: Fonts,
    pages: Vec<Page>,
    parts: Vec<Part>,
    /// The upper edge of the free space.
    y: f64,
    /// Headings that wait for their next block.
    waiting: Vec<Chunk>,
    /// Drawings that wait for the next page.
    drawings: VecDeque<Chunk>,
    /// Drawings with pages of their own after this one.
    large: Vec<Page>,
    /// A narrow drawing at the right with text beside it: its width and its lower edge.
    beside: Option<[f64; 2]>,
    /// The equation's table that was placed last, if nothing follows it yet: the width of its text
    /// column, its right edge and the baseline of its middle row.
    table: Option<[f64; 3]>,
}

impl PageSetter {
    fn new(setting: Setting, fonts: Fonts) -> PageSetter {
        PageSetter {
            setting,
            fonts,
            pages: Vec::new(),
            parts: Vec::new(),
            y: PAPER_MM[1] - TOP_MM,
            waiting: Vec::new(),
            drawings: VecDeque::new(),
            large: Vec::new(),
            beside: None,
            table: None,
        }
    }

    /// One em of vertical space, reduced in close setting.
    fn air(&self) -> f64 {
        TEXT_MM * self.setting.line_em / LINE_EM
    }

    /// Width of the lines that begin at this height.
    fn width(&self) -> f64 {
        // Waiting headings come above the next line.
        let waiting: f64 = self.waiting.iter().map(|c| c.air_mm + c.height_mm).sum();
        match self.beside {
            Some([wide, bottom]) if self.y - waiting > bottom => FULL_MM - wide - BESIDE_GAP_MM,
            _ => FULL_MM,
        }
    }

    /// Moves below a drawing at the right.
    fn clear(&mut self) {
        if let Some([_, bottom]) = self.beside.take() {
            self.y = self.y.min(bottom);
        }
    }

    fn fresh(&self) -> bool {
        self.parts.is_empty()
    }

    fn need(&self, chunks: &[&Chunk]) -> f64 {
        let air = |i: usize, c: &Chunk| if i == 0 && self.fresh() { 0.0 } else { c.air_mm };
        chunks.iter().enumerate().map(|(i, c)| air(i, c) + c.height_mm).sum()
    }

    fn room(&self) -> f64 {
        self.y - BOTTOM_MM
    }

    /// True if the page has space for a chunk with the headings that wait for it, or is empty.
    fn holds(&self, chunk: &Chunk) -> bool {
        let together: Vec<&Chunk> = self.waiting.iter().chain([chunk]).collect();
        self.need(&together) <= self.room() || self.fresh()
    }

    /// Places a chunk, with the headings that wait for it. A new page may begin with drawings that
    /// fill it.
    fn put(&mut self, chunk: Chunk) {
        while !self.holds(&chunk) {
            self.break_page();
        }
        let waiting = std::mem::take(&mut self.waiting);
        for c in waiting.into_iter().chain([chunk]) {
            self.place(c);
        }
    }

    fn place(&mut self, chunk: Chunk) {
        self.table = None;
        if !self.fresh() {
            self.y -= chunk.air_mm;
        }
        let mut items = chunk.items;
        translate(&mut items, Vec2::new(SIDE_MM, self.y));
        self.y -= chunk.height_mm;
        match self.parts.last_mut() {
            // Consecutive lines of a paragraph form one paragraph.
            Some(last)
                if chunk.kind == Kind::Paragraph
                    && chunk.air_mm == 0.0
                    && last.kind == Kind::Paragraph =>
            {
                last.items.extend(items)
            }
            _ => self.parts.push(Part { kind: chunk.kind, items }),
        }
    }

    /// Ends the page; waiting drawings come first on the next.
    fn break_page(&mut self) {
        let parts = std::mem::take(&mut self.parts);
        self.pages.push(Page { width_mm: PAPER_MM[0], height_mm: PAPER_MM[1], parts });
        self.pages.append(&mut self.large);
        self.y = PAPER_MM[1] - TOP_MM;
        self.beside = None;
        while let Some(next) = self.drawings.front() {
            if self.need(&[next]) > self.room() && !self.fresh() {
                break;
            }
            if let Some(next) = self.drawings.pop_front() {
                self.place(next);
            }
        }
    }

    /// Places a drawing at the right; the text goes on beside it.
    fn place_beside(&mut self, chunk: Chunk) {
        let mut items = chunk.items;
        let Some(ink) = bounds(&items) else { return };
        let air_mm = if self.fresh() { 0.0 } else { chunk.air_mm };
        let to = Vec2::new(SIDE_MM + FULL_MM - ink.max.x, self.y - air_mm - ink.max.y);
        translate(&mut items, to);
        self.parts.push(Part { kind: chunk.kind, items });
        self.beside = Some([ink.width_mm(), self.y - air_mm - ink.height_mm()]);
    }

    /// Ends the page and places everything that waits.
    fn finish_page(&mut self) {
        for c in std::mem::take(&mut self.waiting) {
            self.place(c);
        }
        while !self.drawings.is_empty() {
            self.break_page();
        }
        if !self.fresh() {
            self.break_page();
        }
        self.pages.append(&mut self.large);
    }
}

/// A line of text.
pub(super) fn line(label: &Label, at: Point, size_mm: f64, anchor: Anchor) -> FigureItem {
    FigureItem::new(
        "text",
        Shape::Label { at, label: label.clone(), size_mm, anchor, colour: Colour::BLACK },
    )
}
