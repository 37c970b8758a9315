//! A prefix for all ids of a document, so that several documents can be combined in one page.

use std::borrow::Cow;

use hodograph_base::diag::{Diagnostic, both};

/// Longest prefix in characters: people read ids too.
const LONGEST: usize = 64;

/// A prefix of ids: a letter, then letters, digits, `-` and `_`, all ASCII.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct IdPrefix(String);

impl IdPrefix {
    /// Reads a prefix; an empty text is no prefix.
    ///
    /// # Errors
    /// `id-prefix` for a text that cannot start an id.
    pub fn new(text: &str) -> Result<IdPrefix, Diagnostic> {
        let starts = text.chars().next().is_none_or(|c| c.is_ascii_alphabetic());
        if starts
            && text.len() <= LONGEST
            && text.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '-' | '_'))
        {
            return Ok(IdPrefix(text.to_owned()));
        }
        let message = both!("`{text}` cannot begin the ids of a figure");
        Err(Diagnostic::error("id-prefix", message).help(both!(
            "an ASCII letter first, then letters, digits, - or _, at most {LONGEST} of them, such as fig1-"
        )))
    }

    /// Returns a document of [`super::write()`] with the prefix before all its ids and before all
    /// references to them.
    ///
    /// ```
    /// use hodograph_paper::render::svg::IdPrefix;
    /// let prefix = IdPrefix::new("fig1-")?;
    /// assert_eq!(prefix.put_before(r##"<g id="a"><use xlink:href="#b"/></g>"##), r##"<g id="fig1-a"><use xlink:href="#fig1-b"/></g>"##);
    /// # Ok::<(), hodograph_base::diag::Diagnostic>(())
    /// ```
    pub fn put_before<'a>(&self, svg: &'a str) -> Cow<'a, str> {
        if self.0.is_empty() {
            return svg.into();
        }
        let mut out = String::with_capacity(svg.len() + svg.len() / 8);
        let (mut rest, mut in_tag) = (svg, false);
        // Text between tags is unchanged, whatever it contains; within a tag each value is read as
        // a whole.
        while let Some(at) = rest.find(if in_tag { ['"', '>'] } else { ['<', '<'] }) {
            let found = rest.as_bytes()[at];
            let (before, after) = rest.split_at(at + 1);
            out.push_str(before);
            rest = after;
            if found != b'"' {
                in_tag = found == b'<';
                continue;
            }
            let end = rest.find('"').map_or(rest.len(), |end| end + 1);
            let (value, after) = rest.split_at(end);
            if before.ends_with(" id=\"") {
                out.push_str(&self.0);
                out.push_str(value);
            } else if let Some(id) =
                value.strip_prefix('#').filter(|_| before.ends_with(" xlink:href=\""))
            {
                out.push('#');
                out.push_str(&self.0);
                out.push_str(id);
            } else {
                out.push_str(value);
            }
            rest = after;
        }
        out.push_str(rest);
        out.into()
    }
}
