//! Positions as editors show them: lines and columns.

use super::Span;

/// A line and a column of a text, both counted from 1.
///
/// Columns count characters (Unicode scalar values), not bytes or terminal cells. A byte order mark
/// at the beginning of the text does not count as a character of the first line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct LineColumn {
    /// The line; lines end with `\n`.
    pub line: usize,
    /// The column: one more than the number of characters before the position in its line.
    pub column: usize,
}

impl LineColumn {
    /// Returns the position of a byte offset. An offset within a character counts as the beginning
    /// of the character, an offset beyond the text as the end of the text.
    ///
    /// ```
    /// use hodograph_base::diag::LineColumn;
    /// let text = "{\n  \"μ\": 1 }";
    /// assert_eq!(LineColumn::of(text, 0), LineColumn { line: 1, column: 1 });
    /// // The letter μ has two bytes and is one column.
    /// assert_eq!(LineColumn::of(text, 9), LineColumn { line: 2, column: 7 });
    /// ```
    pub fn of(text: &str, offset: usize) -> LineColumn {
        let before = &text[..floor(text, offset)];
        let start = before.rfind('\n').map_or(0, |i| i + 1);
        let line = 1 + before.matches('\n').count();
        let mark = if start == 0 && before.starts_with('\u{feff}') { 1 } else { 0 };
        LineColumn { line, column: 1 + before[start..].chars().count() - mark }
    }
}

/// Returns the offset moved back to the beginning of its character, or to the end of the text.
fn floor(text: &str, offset: usize) -> usize {
    let mut at = offset.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

impl Span {
    /// Returns the span limited to the text and to character boundaries: the text may be a lossy
    /// reading of bytes that are not UTF-8.
    pub fn within(self, text: &str) -> Span {
        let start = floor(text, self.start);
        Span { start, end: floor(text, self.end).max(start) }
    }

    /// Returns lines and columns of a span in its text: of its first character, and of the
    /// character after its last.
    ///
    /// ```
    /// use hodograph_base::diag::{LineColumn, Span};
    /// let [from, to] = Span::new(2, 5).lines("a\nbcd\n");
    /// assert_eq!((from, to), (LineColumn { line: 2, column: 1 }, LineColumn { line: 2, column: 4 }));
    /// ```
    pub fn lines(self, text: &str) -> [LineColumn; 2] {
        let Span { start, end } = self.within(text);
        [start, end].map(|at| LineColumn::of(text, at))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_counted_in_characters_and_stay_in_the_text() {
        let of = |text: &str, at| {
            let LineColumn { line, column } = LineColumn::of(text, at);
            (line, column)
        };
        assert_eq!(of("", 0), (1, 1));
        assert_eq!(of("构件", 3), (1, 2));
        // Within a character, and beyond the end of the text.
        assert_eq!(of("构件", 4), (1, 2));
        assert_eq!(of("构件", 99), (1, 3));
        assert_eq!(of("a\r\nb\n", 4), (2, 2));
        assert_eq!(of("a\r\nb\n", 5), (3, 1));
        // The byte order mark with which some editors begin a file.
        assert_eq!(of("\u{feff}ab\nc", 4), (1, 2));
        assert_eq!(of("\u{feff}ab\nc", 6), (2, 1));
        assert_eq!(Span::new(7, 2).within("abc"), Span::new(3, 3));
    }
}
