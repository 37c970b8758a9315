//! A worksheet as pages of A4 in our own display list, for a writer of PDF (`render::pdf::document`).
//!
//! Decided here: where pages break (a heading stays with what follows, a table or drawing is never cut, a drawing that
//! does not fit goes to the top of the next page while the text flows on), and page numbers. Drawings keep their
//! millimetres, because their scales are true; one that is larger than the page's text has a page as large as itself.
//! [`blocks`] makes the boxes that are put on them.

mod blocks;

use std::collections::VecDeque;

use super::{Block, Document};
use crate::geom::{Point, Vec2};
use crate::paper::extent::translate;
use crate::paper::font::own::Fonts;
use crate::paper::item::{Anchor, Colour, Item, Shape};
use crate::paper::label::Label;
use crate::render::pages::{Kind, Page, Part};

/// A4.
const PAPER_MM: [f64; 2] = [210.0, 297.0];
/// Left and right: lines of 174 mm hold some 85 letters.
const SIDE_MM: f64 = 18.0;
/// Above and below; the page number stands in the lower one.
const TOP_MM: f64 = 18.0;
const BOTTOM_MM: f64 = 18.0;
/// The page number's baseline.
const FOOT_MM: f64 = 10.0;
/// Width of the text.
const FULL_MM: f64 = PAPER_MM[0] - 2.0 * SIDE_MM;
/// A drawing up to this part of the text's width stands at the right, with text beside it.
const BESIDE_PART: f64 = 0.42;
/// The same for a side that else runs over its page: the text keeps 45 mm, some twenty letters.
const WIDE_BESIDE_PART: f64 = 0.69;
/// Between such a drawing and the text.
const BESIDE_GAP_MM: f64 = 8.0;
/// Size of the type: 11 point.
const TEXT_MM: f64 = 3.9;
/// Distance of baselines, in em: formulas in the line have scripts above and below.
const LINE_EM: f64 = 1.6;
/// The same where the text is set closer: less, and the scripts of two lines touch.
const CLOSE_LINE_EM: f64 = 1.4;

/// How a side is set.
#[derive(Clone, Copy)]
struct Setting {
    /// Distance of baselines.
    line_em: f64,
    /// Drawings up to this part of the text's width stand at the right.
    beside_part: f64,
    /// Whether lists of short members stand in two columns.
    columns: bool,
    /// Whether pages are filled to the end: a table of values goes on, under its head again, on the next page, and text stands
    /// before a drawing that does not fit wherever a few lines of it do.
    filled: bool,
}

/// As a side is set where nothing is gained by another setting, and what is tried to save a page: the least change first.
const USUAL: Setting = Setting { line_em: LINE_EM, beside_part: BESIDE_PART, columns: false, filled: false };
const CLOSER: [Setting; 5] = [
    Setting { line_em: CLOSE_LINE_EM, ..USUAL },
    Setting { line_em: CLOSE_LINE_EM, columns: true, ..USUAL },
    Setting { beside_part: WIDE_BESIDE_PART, ..USUAL },
    Setting { line_em: CLOSE_LINE_EM, beside_part: WIDE_BESIDE_PART, ..USUAL },
    Setting { line_em: CLOSE_LINE_EM, columns: true, filled: true, ..USUAL },
];

/// A side of more pages is not set closer: one page less of so many is not noticed, and each setting costs as much as the first.
const LONG: usize = 8;

/// Sets a document on pages. Each of its sides begins on a new one, and is set closer where that saves a page; a side of a page
/// and some lines has its short lists in columns, or else its drawing beside the text.
pub fn pages(document: &Document) -> Vec<Page> {
    let begins = |b: &Block| matches!(b, Block::Heading(1, _));
    let mut pages = Vec::new();
    for (k, side) in document.blocks.chunk_by(|_, next| !begins(next)).enumerate() {
        let title = (k == 0).then_some(document.title.as_str());
        let mut best = set(document, title, side, USUAL);
        for setting in CLOSER {
            // A narrow column beside a wide drawing is worth it only where all then stands on one page.
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
        let foot = line(&label, Point::new(page.width_mm / 2.0, FOOT_MM), TEXT_MM * 0.9, Anchor::Middle);
        page.parts.push(Part { kind: Kind::Artifact, items: vec![foot] });
    }
    pages
}

fn set(document: &Document, title: Option<&str>, blocks: &[Block], setting: Setting) -> Vec<Page> {
    let mut setter = Setter::new(setting, document.fonts.clone());
    if let Some(title) = title {
        setter.heading(0, title);
    }
    for block in blocks {
        match block {
            Block::Heading(level, text) => setter.heading(usize::from(*level), text),
            Block::Paragraph(p) => setter.paragraph(p),
            Block::List { numbered, members } => setter.list(*numbered, members),
            Block::Table(t) => setter.table(t),
            Block::Formula(parts) => setter.formula(parts),
            Block::Figure { figure, .. } => setter.figure(figure),
        }
    }
    setter.finish_page();
    setter.pages
}

/// A box that stands on a page as a whole: its items hang below the origin.
struct Chunk {
    kind: Kind,
    items: Vec<Item>,
    height_mm: f64,
    /// Air above, unless it is first on its page.
    air_mm: f64,
}

struct Setter {
    setting: Setting,
    fonts: Fonts,
    pages: Vec<Page>,
    parts: Vec<Part>,
    /// The upper edge of what is still free.
    y: f64,
    /// Headings that wait for what follows them.
    waiting: Vec<Chunk>,
    /// Drawings that wait for the next page.
    drawings: VecDeque<Chunk>,
    /// Drawings with pages of their own, after this one.
    large: Vec<Page>,
    /// A narrow drawing at the right, beside which the text stands: its width and its lower edge.
    beside: Option<[f64; 2]>,
    /// The equation's table that was put last, if nothing has been put since: the width of the text it stands in, its right edge and the
    /// baseline of its middle row.
    table: Option<[f64; 3]>,
}

impl Setter {
    fn new(setting: Setting, fonts: Fonts) -> Setter {
        Setter {
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

    /// An em of air: less where the lines stand closer.
    fn air(&self) -> f64 {
        TEXT_MM * self.setting.line_em / LINE_EM
    }

    /// Width of the lines that begin here.
    fn width(&self) -> f64 {
        // What waits stands above the line that begins next.
        let waiting: f64 = self.waiting.iter().map(|c| c.air_mm + c.height_mm).sum();
        match self.beside {
            Some([wide, bottom]) if self.y - waiting > bottom => FULL_MM - wide - BESIDE_GAP_MM,
            _ => FULL_MM,
        }
    }

    /// Goes below a drawing at the right.
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

    /// Puts a chunk, with the headings that wait for it.
    fn put(&mut self, chunk: Chunk) {
        let mut together: Vec<&Chunk> = self.waiting.iter().collect();
        together.push(&chunk);
        if self.need(&together) > self.room() && !self.fresh() {
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
            // The lines of a paragraph are one paragraph.
            Some(last) if chunk.kind == Kind::Paragraph && chunk.air_mm == 0.0 && last.kind == Kind::Paragraph => last.items.extend(items),
            _ => self.parts.push(Part { kind: chunk.kind, items }),
        }
    }

    /// Ends the page; drawings that wait come first on the next.
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

    /// Ends the page and puts all that waits.
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
pub(super) fn line(label: &Label, at: Point, size_mm: f64, anchor: Anchor) -> Item {
    Item::new("text", Shape::Label { at, label: label.clone(), size_mm, anchor, colour: Colour::BLACK })
}
