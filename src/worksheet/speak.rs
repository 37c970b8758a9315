//! Text in the reader's language.

use super::DocumentBlock;
use crate::paper::phrase::Phrase;
use crate::paper::words::{Words, words};
use crate::scene::Lang;

/// A part of a worksheet that knows its language.
pub(super) trait Speak {
    fn lang(&self) -> Lang;

    fn words(&self) -> &'static Words {
        words(self.lang())
    }

    fn heading(&self, level: u8, words: [&str; 2]) -> DocumentBlock {
        DocumentBlock::Heading(level, self.lang().pick(words).into())
    }

    fn paragraph(&self, words: [&str; 2]) -> DocumentBlock {
        DocumentBlock::Paragraph(Phrase::new(self.lang().pick(words)))
    }
}
