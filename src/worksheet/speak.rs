//! Text in the reader's language.

use super::DocumentBlock;
use crate::paper::phrase::{Phrase, tr};
use crate::paper::words::{Words, words};
use crate::scene::Lang;

/// A part of a worksheet that knows its language.
pub(super) trait Speak {
    fn lang(&self) -> Lang;

    fn tr(&self, en: &'static str, zh: &'static str) -> &'static str {
        tr(self.lang(), en, zh)
    }

    fn words(&self) -> &'static Words {
        words(self.lang())
    }

    fn heading(&self, level: u8, en: &str, zh: &str) -> DocumentBlock {
        DocumentBlock::Heading(level, if self.lang() == Lang::En { en } else { zh }.into())
    }

    fn paragraph(&self, en: &str, zh: &str) -> DocumentBlock {
        DocumentBlock::Paragraph(Phrase::new(if self.lang() == Lang::En { en } else { zh }))
    }
}
