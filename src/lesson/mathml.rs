//! Formulas of the label language as MathML, words for HTML.

use std::fmt::Write as _;

use crate::figure::font::Slant;
use crate::figure::label::{Label, Node, Role};

/// A formula.
pub fn formula(source: &str) -> String {
    let mut out = String::from("<math>");
    row(Label::math(source).row(), &mut out);
    out.push_str("</math>");
    out
}

pub use crate::render::escaped;

fn row(nodes: &[Node], out: &mut String) {
    for node in nodes {
        atom(node, out);
        if node.space_em > 0.0 {
            let _ = write!(out, "<mspace width=\"{}em\"/>", node.space_em);
        }
    }
}

fn script(nodes: &[Node], out: &mut String) {
    out.push_str("<mrow>");
    row(nodes, out);
    out.push_str("</mrow>");
}

fn atom(node: &Node, out: &mut String) {
    if node.text.is_empty() && node.primes == 0 && node.sub.is_empty() && node.sup.is_empty() {
        return;
    }
    let (sub, sup) = (!node.sub.is_empty(), !node.sup.is_empty() || node.primes > 0);
    let element = match (sub, sup) {
        (false, false) => "",
        (true, false) => "msub",
        (false, true) => "msup",
        (true, true) => "msubsup",
    };
    if !element.is_empty() {
        let _ = write!(out, "<{element}>");
    }
    if sub {
        // Under the descender of φ or μ a subscript would hang lower than under ω: the base is said to have no depth.
        out.push_str("<mpadded depth=\"0\">");
        base(node, out);
        out.push_str("</mpadded>");
        script(&node.sub, out);
    } else {
        base(node, out);
    }
    if sup {
        out.push_str("<mrow>");
        if node.primes > 0 {
            let _ = write!(out, "<mo>{}</mo>", "′".repeat(node.primes));
        }
        row(&node.sup, out);
        out.push_str("</mrow>");
    }
    if !element.is_empty() {
        let _ = write!(out, "</{element}>");
    }
}

/// The characters: what they are follows from how they look, as in the label language.
fn base(node: &Node, out: &mut String) {
    let text = escaped(&node.text);
    let tag = match (node.role, node.slant) {
        (Role::Binary | Role::Relation | Role::Punctuation, _) | (_, Slant::Symbol) => "mo",
        (Role::Function, _) => "mi",
        (_, Slant::Italic) => "mi",
        (_, Slant::Upright) if node.text.starts_with(|c: char| c.is_ascii_digit()) => "mn",
        _ => "mtext",
    };
    // Words and functions stay upright: the page sets every other identifier in italics.
    let class = if tag == "mi" && node.slant != Slant::Italic { " class=\"up\"" } else { "" };
    let _ = write!(out, "<{tag}{class}>{text}</{tag}>");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scripts_numbers_and_units() {
        assert_eq!(
            formula("v_{B3}^r = 2.5 m/s"),
            "<math><msubsup><mpadded depth=\"0\"><mi>v</mi></mpadded><mrow><mi>B</mi><mn>3</mn></mrow><mrow><mi>r</mi></mrow></msubsup><mo>=</mo><mn>2.5</mn>\
             <mspace width=\"0.2em\"/><mtext>m/s</mtext></math>"
                .replace("0.2em", &format!("{}em", Label::math("2.5 m").row().iter().map(|n| n.space_em).fold(0.0, f64::max)))
        );
        assert_eq!(
            formula("b'_2"),
            "<math><msubsup><mpadded depth=\"0\"><mi>b</mi></mpadded><mrow><mn>2</mn></mrow><mrow><mo>′</mo></mrow></msubsup></math>"
        );
    }

    #[test]
    fn words_are_escaped() {
        assert_eq!(escaped("a < b & \"c\""), "a &lt; b &amp; &quot;c&quot;");
    }
}
