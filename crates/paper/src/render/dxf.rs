//! Writes drawing exchange files for cutting machines: DXF of release 12 (AC1009), which every
//! program reads. Millimetres, y up.
//!
//! The groups of code and value follow Autodesk's *DXF Reference* for release 12. Arcs stay arcs;
//! other curves become polylines.

use hodograph_base::geom::Vec2;

/// A line of the drawing, in mm.
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
            Entity::Closed(points) => {
                // 66: vertices follow; 70: closed.
                out.text(0, "POLYLINE")
                    .text(8, layer)
                    .text(66, "1")
                    .text(70, "1")
                    .point(0, Vec2::ZERO);
                for p in points {
                    out.text(0, "VERTEX").text(8, layer).point(0, *p);
                }
                out.text(0, "SEQEND").text(8, layer);
            }
        }
    }
    out.text(0, "ENDSEC").text(0, "EOF");
    out.0
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
