//! Sentences and formulas as XHTML of letters, subscripts and superscripts: the platforms strip
//! MathML from what they import.

use crate::paper::font::Slant;
use crate::paper::label::{Label, LabelNode, Role};
use crate::paper::phrase::Phrase;
use crate::render::escaped;
use crate::report::html::sentence_with;

/// Returns a formula in the label language as XHTML.
pub fn formula(source: &str) -> String {
    let mut out = String::new();
    row(Label::math(source).row(), &mut out);
    out
}

fn row(nodes: &[LabelNode], out: &mut String) {
    for node in nodes {
        let spaced = matches!(node.role, Role::Relation | Role::Binary);
        *out += if spaced { " " } else { "" };
        let text = escaped(&node.text);
        *out += &match node.slant {
            Slant::Italic if !text.trim().is_empty() => format!("<i>{text}</i>"),
            Slant::Bold => format!("<b><i>{text}</i></b>"),
            Slant::Italic | Slant::Upright | Slant::Symbol => text,
        };
        out.extend(std::iter::repeat_n('′', node.primes));
        for (tag, script) in [("sub", &node.sub), ("sup", &node.sup)] {
            if !script.is_empty() {
                *out += &format!("<{tag}>");
                row(script, out);
                *out += &format!("</{tag}>");
            }
        }
        let after = spaced || node.space_em > 0.0 || node.role == Role::Punctuation;
        *out += if after { " " } else { "" };
    }
}

fn sentence(phrase: &Phrase) -> String {
    sentence_with(phrase, formula)
}

/// Returns a heading.
pub fn heading(text: &str) -> String {
    format!("<p><strong>{}</strong></p>\n", escaped(text))
}

/// Returns a paragraph.
pub fn paragraph(phrase: &Phrase) -> String {
    format!("<p>{}</p>\n", sentence(phrase))
}

/// Returns a list.
pub fn list(members: &[Phrase]) -> String {
    let members: Vec<String> =
        members.iter().map(|m| format!("<li>{}</li>\n", sentence(m))).collect();
    format!("<ul>\n{}</ul>\n", members.concat())
}

/// Returns a unit of a key: `m/s^2` as `m/s²`.
pub fn unit(ascii: &str) -> String {
    escaped(&ascii.replace("^2", "²").replace("^3", "³").replace('*', "·").replace("deg", "°"))
}
