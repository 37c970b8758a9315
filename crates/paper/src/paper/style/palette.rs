//! The colours of the ink.
//!
//! Figures are built in black, white and greys. At the end the palette maps black to its ink or to
//! the colour of the item's link, white to its paper, and a grey to a mixture of the two.

use super::super::item::{Colour, Figure, FigureItem, LineStroke, Shape};

/// Colours of a style.
#[derive(Clone, Debug, PartialEq)]
pub struct Palette {
    /// The paper. Paper that is not white is painted.
    pub paper: Colour,
    /// The ink.
    pub ink: Colour,
    /// One colour for each moving link in the order of the scene, repeated cyclically; empty: all
    /// links in ink.
    pub links: Vec<Colour>,
}

impl Default for Palette {
    fn default() -> Palette {
        Palette { paper: Colour::WHITE, ink: Colour::BLACK, links: Vec::new() }
    }
}

impl Palette {
    /// Returns true if the palette changes nothing.
    fn is_plain(&self) -> bool {
        *self == Palette::default()
    }

    /// Returns the colour of a link; the ink if links have no colours.
    pub fn link(&self, link: Option<usize>) -> Colour {
        match (link, self.links.len()) {
            (Some(l), n) if n > 0 => self.links[l % n],
            _ => self.ink,
        }
    }

    /// Colours a finished figure.
    pub fn paint(&self, figure: &mut Figure) {
        if self.is_plain() {
            return;
        }
        figure.items.iter_mut().for_each(|item| self.item(item));
        figure.paper = self.paper;
    }

    /// Colours one item.
    pub fn item(&self, item: &mut FigureItem) {
        let full = self.link(item.link);
        let change = |c: &mut Colour| *c = self.mixed(full, *c);
        let line = |s: &mut LineStroke| s.colour = self.mixed(full, s.colour);
        match &mut item.shape {
            Shape::Line { stroke, .. }
            | Shape::Arc { stroke, .. }
            | Shape::Arrow { stroke, .. }
            | Shape::ArcArrow { stroke, .. } => {
                line(stroke);
            }
            Shape::Polyline { stroke, fill, .. }
            | Shape::Path { stroke, fill, .. }
            | Shape::Circle { stroke, fill, .. } => {
                stroke.as_mut().map(line);
                fill.as_mut().map(change);
            }
            Shape::Label { colour, .. } | Shape::Turned { colour, .. } => change(colour),
        }
    }

    /// Maps a grey to a mixture of the full colour (black) and the paper (white); other colours are
    /// unchanged.
    fn mixed(&self, full: Colour, c: Colour) -> Colour {
        if c.r != c.g || c.g != c.b {
            return c;
        }
        let part = u32::from(c.r);
        let mix =
            |a: u8, b: u8| ((u32::from(a) * (255 - part) + u32::from(b) * part + 127) / 255) as u8;
        Colour::rgb(mix(full.r, self.paper.r), mix(full.g, self.paper.g), mix(full.b, self.paper.b))
    }
}

#[cfg(test)]
mod tests {
    use super::super::Style;
    use super::*;

    /// Returns the relative luminance (WCAG 2.2).
    fn luminance(c: Colour) -> f64 {
        let [r, g, b] = linear(c);
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }

    fn linear(c: Colour) -> [f64; 3] {
        [c.r, c.g, c.b].map(|v| {
            let v = f64::from(v) / 255.0;
            if v <= 0.04045 { v / 12.92 } else { libm::pow((v + 0.055) / 1.055, 2.4) }
        })
    }

    fn contrast(a: Colour, b: Colour) -> f64 {
        let (a, b) = (luminance(a), luminance(b));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    /// Returns a colour in Oklab (B. Ottosson, 2020), as seen without and with the three kinds of
    /// colour blindness (Machado, Oliveira, Fernandes 2009, severity 1).
    fn seen(c: Colour) -> [[f64; 3]; 4] {
        const KINDS: [[[f64; 3]; 3]; 4] = [
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            [
                [0.152286, 1.052583, -0.204868],
                [0.114503, 0.786281, 0.099216],
                [-0.003882, -0.048116, 1.051998],
            ],
            [
                [0.367322, 0.860646, -0.227968],
                [0.280085, 0.672501, 0.047413],
                [-0.011820, 0.042940, 0.968881],
            ],
            [
                [1.255528, -0.076749, -0.178779],
                [-0.078411, 0.930809, 0.147602],
                [0.004733, 0.691367, 0.303900],
            ],
        ];
        let times = |m: &[[f64; 3]; 3], v: [f64; 3]| {
            m.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
        };
        KINDS.map(|kind| {
            let rgb = times(&kind, linear(c)).map(|v| v.max(0.0));
            let lms = times(
                &[
                    [0.4122214708, 0.5363325363, 0.0514459929],
                    [0.2119034982, 0.6806995451, 0.1073969566],
                    [0.0883024619, 0.2817188376, 0.6299787005],
                ],
                rgb,
            )
            .map(libm::cbrt);
            times(
                &[
                    [0.2104542553, 0.7936177850, -0.0040720468],
                    [1.9779984951, -2.4285922050, 0.4505937099],
                    [0.0259040371, 0.7827717662, -0.8086757660],
                ],
                lms,
            )
        })
    }

    #[test]
    fn links_are_told_apart_by_every_eye_and_stand_out_from_the_paper() {
        for style in ["slides", "dark"] {
            let p = Style::named(style).unwrap().palette;
            let all: Vec<Colour> = p.links.iter().copied().chain([p.ink]).collect();
            // An excavator has twelve links.
            assert!(p.links.len() >= 12);
            for (k, a) in all.iter().enumerate() {
                // WCAG requires a contrast of 3 for graphical objects.
                assert!(contrast(*a, p.paper) >= 3.2, "{style} {a:?}: {}", contrast(*a, p.paper));
                for b in &all[..k] {
                    let apart = seen(*a)
                        .into_iter()
                        .zip(seen(*b))
                        .map(|(x, y)| (0..3).map(|i| (x[i] - y[i]).powi(2)).sum::<f64>().sqrt());
                    let worst = apart.fold(f64::INFINITY, f64::min);
                    // A just noticeable difference is about 0.02; the palette of Okabe and Ito has
                    // 0.076.
                    assert!(worst >= 0.075, "{style} {a:?} and {b:?}: {worst:.3}");
                }
            }
        }
    }

    #[test]
    fn black_is_the_link_white_the_paper_grey_between() {
        let p = Palette {
            paper: Colour::rgb(0, 0, 0),
            ink: Colour::rgb(200, 200, 200),
            links: vec![Colour::rgb(255, 0, 100)],
        };
        assert_eq!(p.mixed(p.link(Some(3)), Colour::BLACK), Colour::rgb(255, 0, 100));
        assert_eq!(p.mixed(p.link(None), Colour::WHITE), p.paper);
        assert_eq!(p.mixed(p.link(None), Colour::grey(204)), Colour::rgb(40, 40, 40));
    }
}
