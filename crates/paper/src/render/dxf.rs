//! Writes drawing exchange files for cutting machines and drawing programs: DXF of release 12
//! (AC1009), which every program reads. Millimetres, y up.
//!
//! The groups of code and value follow Autodesk's *DXF Reference* for release 12. Arcs stay arcs;
//! other curves become polylines. [`drawn`] gives the lines and texts of a figure.

use crate::paper::arrow;
use crate::paper::extent::{anchor_shift_em, on_circle};
use crate::paper::item::{Anchor, FigureItem, PathPiece, Shape};
use crate::paper::label::Label;
use crate::paper::text::{self, TextRun};
use hodograph_base::geom::{Point, Vec2};
use std::f64::consts::TAU;

/// Height of a capital letter in sizes of the type.
const CAPITAL: f64 = 0.7;

/// A line or text of the drawing, in mm.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Entity {
    /// From one point to another.
    Line([Vec2; 2]),
    /// An arc of a circle, counter-clockwise from one angle to the other (degrees).
    Arc {
        /// Centre.
        centre: Vec2,
        /// Radius.
        radius: f64,
        /// Angles of the ends.
        degrees: [f64; 2],
    },
    /// A whole circle.
    Circle {
        /// Centre.
        centre: Vec2,
        /// Radius.
        radius: f64,
    },
    /// A closed chain of lines.
    Closed(Vec<Vec2>),
    /// An open chain of lines.
    Open(Vec<Vec2>),
    /// A line of text between the ends of its baseline.
    Text {
        /// The ends of the baseline: the text is set as wide.
        ends: [Vec2; 2],
        /// Height of a capital letter.
        height: f64,
        /// The characters.
        text: String,
    },
}

/// Returns the lines and texts of some items, `scale` times as large, each on the layer that
/// `layer` names. Fills and widths of lines are left out, as are marks without ink.
pub fn drawn<'a>(
    items: &[FigureItem],
    scale: f64,
    layer: impl Fn(&FigureItem) -> &'a str,
) -> Vec<(&'a str, Entity)> {
    let of = |item| entities(item, scale).into_iter().map(|entity| (layer(item), entity));
    items.iter().flat_map(of).collect()
}

fn entities(item: &FigureItem, scale: f64) -> Vec<Entity> {
    let at = |p: Point| p.to_vec2() * scale;
    let chain = |points: &[Point], closed: bool| {
        let points = points.iter().map(|p| at(*p)).collect();
        if closed { Entity::Closed(points) } else { Entity::Open(points) }
    };
    let round = |centre: Point, radius_mm: f64, from_rad: f64, to_rad: f64| {
        let (centre, radius) = (at(centre), radius_mm * scale);
        if (to_rad - from_rad).abs() >= TAU {
            return Entity::Circle { centre, radius };
        }
        let degrees = [from_rad.min(to_rad), from_rad.max(to_rad)];
        Entity::Arc { centre, radius, degrees: degrees.map(|a| a.to_degrees().rem_euclid(360.0)) }
    };
    match &item.shape {
        Shape::Line { from, to, .. } => vec![Entity::Line([at(*from), at(*to)])],
        Shape::Polyline { points, closed, .. } => vec![chain(points, *closed)],
        Shape::Path { start, pieces, closed, .. } => {
            let (mut all, mut first, mut here) = (Vec::new(), *start, *start);
            for piece in pieces {
                match *piece {
                    PathPiece::Move(p) => (first, here) = (p, p),
                    PathPiece::Line(p) => {
                        all.push(Entity::Line([at(here), at(p)]));
                        here = p;
                    }
                    PathPiece::Arc { centre, radius_mm, from_rad, to_rad } => {
                        all.push(round(centre, radius_mm, from_rad, to_rad));
                        here = on_circle(centre, radius_mm, to_rad);
                    }
                }
            }
            if *closed && here != first {
                all.push(Entity::Line([at(here), at(first)]));
            }
            all
        }
        Shape::Circle { stroke: None, fill: None, .. } => Vec::new(),
        Shape::Circle { centre, radius_mm, .. } => {
            vec![Entity::Circle { centre: at(*centre), radius: radius_mm * scale }]
        }
        Shape::Arc { centre, radius_mm, from_rad, to_rad, .. } => {
            vec![round(*centre, *radius_mm, *from_rad, *to_rad)]
        }
        // The shaft ends at the tip: its ends are the vector's.
        Shape::Arrow { from, to, head, .. } => {
            let head = arrow::straight(*from, *to, *head).head;
            let head = (!head.is_empty()).then(|| chain(&head, true));
            std::iter::once(Entity::Line([at(*from), at(*to)])).chain(head).collect()
        }
        Shape::ArcArrow { centre, radius_mm, from_rad, to_rad, head, .. } => {
            let parts = arrow::bent(*centre, *radius_mm, *from_rad, *to_rad, *head);
            let shaft = round(*centre, *radius_mm, *from_rad, parts.shaft_end_rad);
            let head = (!parts.head.is_empty()).then(|| chain(&parts.head, true));
            std::iter::once(shaft).chain(head).collect()
        }
        Shape::Turned { at, angle_rad, label, size_mm, .. } => {
            letters(*at, label, *size_mm * scale, (*angle_rad, Anchor::Middle), scale)
        }
        Shape::Label { at, label, size_mm, anchor, .. } => {
            letters(*at, label, *size_mm * scale, (0.0, *anchor), scale)
        }
    }
}

/// The runs of a label: letters and scripts, each as wide as on paper in any font.
fn letters(
    at: Point,
    label: &Label,
    size: f64,
    (angle_rad, anchor): (f64, Anchor),
    scale: f64,
) -> Vec<Entity> {
    let set = text::set(label);
    let right = Vec2::from_angle(angle_rad);
    let shift = anchor_shift_em(anchor, set.width_em);
    let place = |x_em: f64, y_em: f64| {
        at.to_vec2() * scale + (right * (x_em - shift) + right.perp() * y_em) * size
    };
    let run = |run: &TextRun| {
        let width: f64 = run.glyphs.iter().map(|g| g.advance_em).sum();
        let ends = [run.x_em, run.x_em + width * run.size_em].map(|x| place(x, run.y_em));
        Entity::Text { ends, height: CAPITAL * size * run.size_em, text: run.text.clone() }
    };
    set.runs.iter().filter(|r| !r.text.trim().is_empty()).map(run).collect()
}

/// Returns the file, with each entity on the layer given with it.
pub fn dxf(entities: &[(&str, Entity)]) -> String {
    let mut out = DxfText(String::new());
    out.text(0, "SECTION")
        .text(2, "HEADER")
        .text(9, "$ACADVER")
        .text(1, "AC1009")
        .text(0, "ENDSEC");
    out.text(0, "SECTION").text(2, "ENTITIES");
    for (layer, entity) in entities {
        match entity {
            Entity::Line([a, b]) => {
                out.text(0, "LINE").text(8, layer).point(0, *a).point(1, *b);
            }
            Entity::Arc { centre, radius, degrees } => {
                out.text(0, "ARC")
                    .text(8, layer)
                    .point(0, *centre)
                    .number(40, *radius)
                    .number(50, degrees[0])
                    .number(51, degrees[1]);
            }
            Entity::Circle { centre, radius } => {
                out.text(0, "CIRCLE").text(8, layer).point(0, *centre).number(40, *radius);
            }
            Entity::Closed(points) => out.chain(layer, points, "1"),
            Entity::Open(points) => out.chain(layer, points, "0"),
            Entity::Text { ends: [from, to], height, text } => {
                // 72: the text is fitted between the two points.
                out.text(0, "TEXT")
                    .text(8, layer)
                    .point(0, *from)
                    .number(40, *height)
                    .text(1, &ascii(text))
                    .number(50, (*to - *from).angle().to_degrees())
                    .text(72, "5")
                    .point(1, *to);
            }
        }
    }
    out.text(0, "ENDSEC").text(0, "EOF");
    out.0
}

/// A text in ASCII: other characters by their number in Unicode, as AutoCAD writes them.
fn ascii(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        if c == '^' {
            // A caret begins the name of a control character.
            out += "^ ";
        } else if c.is_ascii() && !c.is_ascii_control() {
            out.push(c);
        } else if !c.is_control() {
            c.encode_utf16(&mut [0; 2]).iter().for_each(|u| out += &format!("\\U+{u:04X}"));
        }
    }
    out
}

struct DxfText(String);

impl DxfText {
    fn text(&mut self, code: u16, value: &str) -> &mut DxfText {
        self.0 += &format!("{code:>3}\n{value}\n");
        self
    }

    fn number(&mut self, code: u16, value: f64) -> &mut DxfText {
        // A nanometre is below the precision of any machine; there is no minus before a zero.
        let value = (value * 1e6).round() / 1e6 + 0.0;
        self.text(code, &format!("{value:.6}"))
    }

    fn chain(&mut self, layer: &str, points: &[Vec2], closed: &str) {
        // 66: vertices follow; 70: closed.
        self.text(0, "POLYLINE").text(8, layer).text(66, "1").text(70, closed).point(0, Vec2::ZERO);
        for p in points {
            self.text(0, "VERTEX").text(8, layer).point(0, *p);
        }
        self.text(0, "SEQEND").text(8, layer);
    }

    /// Coordinates of the first point have the codes 10, 20, those of the second 11, 21; the plane
    /// is at z = 0.
    fn point(&mut self, which: u16, p: Vec2) -> &mut DxfText {
        self.number(10 + which, p.x).number(20 + which, p.y).number(30 + which, 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_are_a_code_and_a_value() {
        let entities = [
            ("profile", Entity::Line([Vec2::new(0.0, -0.0), Vec2::new(1.5, -2.0)])),
            ("profile", Entity::Arc { centre: Vec2::ZERO, radius: 30.0, degrees: [90.0, 270.0] }),
            ("profile", Entity::Closed(vec![Vec2::new(1.0, 2.0), Vec2::new(3.0, 4.0)])),
            ("base", Entity::Circle { centre: Vec2::ZERO, radius: 30.0 }),
        ];
        let text = dxf(&entities);
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.len() % 2, 0);
        assert!(lines.chunks(2).all(|g| g[0].trim().parse::<u16>().is_ok()), "{text}");
        let of = |code: &str| {
            lines.chunks(2).filter(|g| g[0].trim() == code).map(|g| g[1]).collect::<Vec<_>>()
        };
        let kinds: Vec<&str> = of("0");
        assert_eq!(
            kinds,
            [
                "SECTION", "ENDSEC", "SECTION", "LINE", "ARC", "POLYLINE", "VERTEX", "VERTEX",
                "SEQEND", "CIRCLE", "ENDSEC", "EOF"
            ]
        );
        assert_eq!(of("21"), ["-2.000000"]);
        assert!(!text.contains("-0.000000"));
    }
}
