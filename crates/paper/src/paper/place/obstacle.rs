//! What labels keep off: the ink of the items, as lines with a width, discs and boxes.

use crate::geom::Point;
use crate::paper::arrow;
use crate::paper::extent::{Rect, on_circle, turned_corners};
use crate::paper::item::{Item, Piece, Shape, Stroke};

/// A straight piece of ink.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bar {
    /// One end.
    pub from: Point,
    /// The other end.
    pub to: Point,
    /// Half its width.
    pub half_width_mm: f64,
    /// To whom it belongs.
    pub owner: Option<u32>,
}

/// A round piece of ink.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    /// Its centre.
    pub centre: Point,
    /// Its radius.
    pub radius_mm: f64,
}

/// Everything that labels keep off.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Obstacles {
    /// Lines.
    pub bars: Vec<Bar>,
    /// Arrowheads, from back to tip: to cover one is worse than to cover a line.
    pub heads: Vec<Bar>,
    /// Joints and dots.
    pub discs: Vec<Disc>,
    /// Boxes: labels with a fixed place, tables.
    pub rects: Vec<Rect>,
    /// Places that have a letter: that of another one stands farther off.
    pub lettered: Vec<Point>,
}

/// Arcs are taken as chords of at most this angle: at 20 mm radius a chord of 0.3 rad is off by 0.2 mm.
const CHORD_RAD: f64 = 0.3;

impl Obstacles {
    /// The obstacles that these items make.
    pub fn of(items: &[Item]) -> Obstacles {
        let mut all = Obstacles::default();
        all.add(items, None);
        all
    }

    /// Adds the obstacles that these items make, all of one owner.
    pub fn add(&mut self, items: &[Item], owner: Option<u32>) {
        items.iter().for_each(|item| self.add_item(item, owner));
    }

    /// How many of these lines and discs others cross, or come nearer to than `air_mm`.
    pub fn met_by(&self, others: &Obstacles, air_mm: f64) -> usize {
        let met = |bar: &&Bar| others.bars.iter().any(|o| super::cost::bars_apart(bar, o) < air_mm);
        let disc = |d: &&Disc| others.bars.iter().any(|o| super::cost::to_bar(d.centre, o) < d.radius_mm + air_mm);
        self.bars.iter().filter(met).count() + self.discs.iter().filter(disc).count()
    }

    fn add_item(&mut self, item: &Item, owner: Option<u32>) {
        let half = |s: &Option<Stroke>| s.map_or(0.0, |s| s.width_mm / 2.0);
        match &item.shape {
            Shape::Line { from, to, stroke } => self.bar(*from, *to, stroke.width_mm / 2.0, owner),
            Shape::Polyline { points, closed, stroke, .. } => {
                for w in points.windows(2) {
                    self.bar(w[0], w[1], half(stroke), owner);
                }
                if let (true, Some(&first), Some(&last)) = (*closed, points.first(), points.last()) {
                    self.bar(last, first, half(stroke), owner);
                }
            }
            Shape::Path { start, pieces, closed, stroke, .. } => {
                let (mut begin, mut here) = (*start, *start);
                for piece in pieces {
                    match *piece {
                        Piece::Move(to) => (begin, here) = (to, to),
                        Piece::Line(to) => {
                            self.bar(here, to, half(stroke), owner);
                            here = to;
                        }
                        Piece::Arc { centre, radius_mm, from_rad, to_rad } => {
                            self.arc(centre, radius_mm, from_rad, to_rad, half(stroke), owner);
                            here = on_circle(centre, radius_mm, to_rad);
                        }
                    }
                }
                if *closed {
                    self.bar(here, begin, half(stroke), owner);
                }
            }
            Shape::Circle { centre, radius_mm, stroke, .. } => {
                self.discs.push(Disc { centre: *centre, radius_mm: radius_mm + half(stroke) });
            }
            Shape::Arc { centre, radius_mm, from_rad, to_rad, stroke } => {
                self.arc(*centre, *radius_mm, *from_rad, *to_rad, stroke.width_mm / 2.0, owner);
            }
            Shape::Arrow { from, to, stroke, head } => {
                self.bar(*from, *to, stroke.width_mm / 2.0, owner);
                self.head(&arrow::straight(*from, *to, *head).head, owner);
            }
            Shape::ArcArrow { centre, radius_mm, from_rad, to_rad, stroke, head } => {
                self.arc(*centre, *radius_mm, *from_rad, *to_rad, stroke.width_mm / 2.0, owner);
                self.head(&arrow::bent(*centre, *radius_mm, *from_rad, *to_rad, *head).head, owner);
            }
            Shape::Turned { at, angle_rad, label, size_mm, .. } => {
                // A bar as thick as the letters are high.
                if let Some([a, b, c, d]) = turned_corners(*at, *angle_rad, label, *size_mm) {
                    let middle = |p: Point, q: Point| p + (q - p) * 0.5;
                    self.bar(middle(a, d), middle(b, c), a.distance(d) / 2.0, owner);
                }
            }
            Shape::Label { .. } => self.rects.extend(item.bounds()),
        }
    }

    fn bar(&mut self, from: Point, to: Point, half_width_mm: f64, owner: Option<u32>) {
        self.bars.push(Bar { from, to, half_width_mm, owner });
    }

    fn arc(&mut self, centre: Point, radius_mm: f64, from_rad: f64, to_rad: f64, half_width_mm: f64, owner: Option<u32>) {
        let n = ((to_rad - from_rad).abs() / CHORD_RAD).ceil().max(1.0);
        let point = |k: f64| on_circle(centre, radius_mm, from_rad + (to_rad - from_rad) * k / n);
        for k in 0..n as usize {
            self.bar(point(k as f64), point(k as f64 + 1.0), half_width_mm, owner);
        }
    }

    fn head(&mut self, corners: &[Point], owner: Option<u32>) {
        if let &[tip, left, notch, right] = corners {
            self.heads.push(Bar { from: notch, to: tip, half_width_mm: left.distance(right) / 2.0, owner });
        }
    }
}
