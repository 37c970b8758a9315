//! Reads the elements of an SVG that have ids: positions, texts and paint.

use std::collections::HashMap;

use resvg::usvg::roxmltree::{self, Node, ParsingOptions};

use hodograph_base::diag::{Diagnostic, both};

/// Largest number of nodes: no figure of an accepted scene has more, and drawing more would take
/// unbounded time.
const NODES: u32 = 300_000;
/// Largest nesting depth: figures have three levels, and drawing is recursive.
const DEEPEST: usize = 64;
/// Elements of figures. Of these only a use can multiply what is drawn; uses are checked.
const KNOWN: &[&str] = &[
    "svg", "title", "desc", "defs", "g", "path", "line", "rect", "circle", "use", "text", "tspan",
];
/// Millimetres per CSS pixel.
const PIXEL_MM: f64 = 25.4 / 96.0;

/// The compared parts of an SVG.
pub struct SvgDocument {
    /// Size of the document.
    pub size_mm: [f64; 2],
    /// Title.
    pub title: String,
    /// Description.
    pub desc: String,
    /// Elements with ids, in order.
    pub elements: Vec<SvgElement>,
    by_id: HashMap<String, usize>,
}

/// An element with an id.
pub struct SvgElement {
    pub id: String,
    /// Names of the vector that it shows; empty for other elements.
    pub name: String,
    pub mm: Option<f64>,
    pub si: Option<f64>,
    /// Text of a label.
    pub text: Option<String>,
    /// Colours, widths and patterns of the element and its parts.
    pub paint: String,
    pub geometry: Geometry,
}

/// Geometry of an element's lines.
pub enum Geometry {
    /// Tail and tip.
    Arrow([[f64; 2]; 2]),
    /// Shapes, and their numbers.
    Lines(String, Vec<f64>),
}

impl SvgDocument {
    /// Reads an SVG.
    pub fn read(text: &str) -> Result<SvgDocument, Diagnostic> {
        let options = ParsingOptions { nodes_limit: NODES, ..ParsingOptions::default() };
        let document = roxmltree::Document::parse_with_options(text, options)
            .map_err(|e| super::refused(both!("the SVG cannot be read: {e}")))?;
        let root = document.root_element();
        refuse_foreign(root)?;
        let size_mm = ["width", "height"].map(|side| root.attribute(side).and_then(length_mm));
        let [Some(width), Some(height)] = size_mm else {
            return Err(super::refused(both!("the SVG has no width and height")));
        };
        let said = |name: &str| {
            root.children()
                .find(|n| n.tag_name().name() == name)
                .and_then(|n| n.text())
                .unwrap_or_default()
                .to_owned()
        };
        let elements = named(root)?;
        let by_id = elements.iter().enumerate().rev().map(|(k, e)| (e.id.clone(), k)).collect();
        Ok(SvgDocument {
            size_mm: [width, height],
            title: said("title"),
            desc: said("desc"),
            elements,
            by_id,
        })
    }

    /// Returns the element with an id.
    pub fn find(&self, id: &str) -> Option<&SvgElement> {
        self.by_id.get(id).map(|k| &self.elements[*k])
    }
}

/// Returns the outermost elements with ids, in order.
fn named(root: Node) -> Result<Vec<SvgElement>, Diagnostic> {
    let mut out = Vec::new();
    let mut left: Vec<(Node, usize)> =
        root.children().filter(|n| n.tag_name().name() != "defs").map(|n| (n, 1)).collect();
    left.reverse();
    while let Some((node, depth)) = left.pop() {
        if depth > DEEPEST {
            return Err(super::refused(both!("the SVG is nested more than {DEEPEST} deep")));
        }
        match element(node) {
            Some(element) => out.push(element),
            None => left.extend(node.children().rev().map(|n| (n, depth + 1))),
        }
    }
    Ok(out)
}

/// Rejects elements that no figure contains: filters, patterns and uses of uses can make a small
/// file take hours to draw.
fn refuse_foreign(root: Node) -> Result<(), Diagnostic> {
    let mut drawn_once: HashMap<&str, bool> = HashMap::new();
    for node in root.descendants().filter(Node::is_element) {
        let name = node.tag_name().name();
        if !KNOWN.contains(&name) {
            return Err(super::refused(both!(
                "the SVG has an element <{name}>, which no figure has"
            )));
        }
        if let Some(id) = node.attribute("id") {
            drawn_once.insert(id, name == "path");
        }
    }
    for node in root.descendants().filter(|n| n.tag_name().name() == "use") {
        let target = node
            .attribute(("http://www.w3.org/1999/xlink", "href"))
            .or_else(|| node.attribute("href"))
            .unwrap_or_default();
        if !drawn_once.get(target.trim_start_matches('#')).copied().unwrap_or(false) {
            return Err(super::refused(both!(
                "the SVG uses `{target}`, which is not the outline of a letter"
            )));
        }
    }
    Ok(())
}

fn length_mm(text: &str) -> Option<f64> {
    let (number, factor) = match text.strip_suffix("mm") {
        Some(number) => (number, 1.0),
        None => (text.strip_suffix("px").unwrap_or(text), PIXEL_MM),
    };
    number.parse::<f64>().ok().map(|n| n * factor).filter(|mm| mm.is_finite() && *mm > 0.0)
}

fn element(node: Node) -> Option<SvgElement> {
    let id = node.attribute("id")?.to_owned();
    let number = |key: &str| node.attribute(key).and_then(|v| v.parse::<f64>().ok());
    let name = node.attribute("data-name").unwrap_or_default().to_owned();
    let text = node.attribute("data-text").map(str::to_owned);
    Some(SvgElement {
        id,
        name,
        mm: number("data-mm"),
        si: number("data-si"),
        text,
        paint: paint(node),
        geometry: geometry(node),
    })
}

fn paint(node: Node) -> String {
    let mut out = String::new();
    for n in node.descendants().filter(Node::is_element) {
        for key in ["stroke", "stroke-width", "stroke-dasharray", "stroke-linecap", "fill"] {
            out.push_str(n.attribute(key).unwrap_or("-"));
            out.push(' ');
        }
        // Letters have the colour of their label.
        if n.has_attribute("data-text") {
            break;
        }
    }
    out
}

fn geometry(node: Node) -> Geometry {
    if let Some(ends) = arrow(node) {
        return Geometry::Arrow(ends);
    }
    let (mut form, mut numbers) = (String::new(), Vec::new());
    for n in node.descendants().filter(Node::is_element) {
        form.push_str(n.tag_name().name());
        for key in
            ["x", "y", "width", "height", "x1", "y1", "x2", "y2", "cx", "cy", "r", "d", "transform"]
        {
            n.attribute(key)
                .into_iter()
                .for_each(|value| take_apart(value, &mut form, &mut numbers));
        }
        // The position of a label is sufficient: its letters are determined by its text.
        if n.has_attribute("data-text") {
            break;
        }
    }
    Geometry::Lines(form, numbers)
}

/// Returns tail and tip of a group of a shaft and a head.
fn arrow(node: Node) -> Option<[[f64; 2]; 2]> {
    let head = node.children().find(|n| n.attribute("class") == Some("head"))?;
    let shaft = node.children().find(|n| n.tag_name().name() == "line")?;
    let tail = ["x1", "y1"].map(|key| shaft.attribute(key).and_then(|v| v.parse::<f64>().ok()));
    let mut corners = Vec::new();
    take_apart(head.attribute("d")?, &mut String::new(), &mut corners);
    // The head's outline starts at its tip.
    Some([[tail[0]?, tail[1]?], [*corners.first()?, *corners.get(1)?]])
}

/// Splits a value into its numbers and the text between them.
fn take_apart(value: &str, form: &mut String, numbers: &mut Vec<f64>) {
    let mut rest = value;
    while let Some(c) = rest.chars().next() {
        let inside =
            |(k, c): &(usize, char)| c.is_ascii_digit() || *c == '.' || *k == 0 && *c == '-';
        let end = rest
            .char_indices()
            .take_while(inside)
            .map(|(k, c)| k + c.len_utf8())
            .last()
            .unwrap_or(0);
        match rest[..end].parse::<f64>() {
            Ok(number) => {
                numbers.push(number);
                form.push('#');
                rest = &rest[end..];
            }
            Err(_) => {
                form.push(c);
                rest = &rest[c.len_utf8()..];
            }
        }
    }
}
