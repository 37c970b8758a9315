//! Obstacles of labels: the ink of the items, as lines with a width, discs and boxes.

use crate::paper::arrow;
use crate::paper::extent::{Rect, on_circle, turned_corners};
use crate::paper::item::{FigureItem, LineStroke, PathPiece, Shape};
use hodograph_base::geom::Point;

/// A straight piece of ink.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bar {
    /// One end.
    pub from: Point,
    /// The other end.
    pub to: Point,
    /// Half the width.
    pub half_width_mm: f64,
    /// The owner of the ink.
    pub owner: Option<u32>,
    /// True if it is drawn in the background, as construction lines are: a letter on it stays
    /// legible.
    pub faint: bool,
}

/// A round piece of ink.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InkDisc {
    /// Centre.
    pub centre: Point,
    /// Radius.
    pub radius_mm: f64,
}

/// All obstacles of labels.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Obstacles {
    /// Lines.
    pub bars: Vec<Bar>,
    /// Arrowheads, from back to tip: covering one is worse than covering a line.
    pub heads: Vec<Bar>,
    /// The two barbs of each arrowhead.
    pub barbs: Vec<[Point; 2]>,
    /// Joints and dots.
    pub discs: Vec<InkDisc>,
    /// Boxes: labels with a fixed place, tables.
    pub rects: Vec<Rect>,
    /// Lines that no leader line may cross: hatching, in which it is lost, and arcs of angles and
    /// rotations, of which it looks like a part.
    pub barred: Vec<Bar>,
    /// Points that have a letter or could have one: letters of other points must be farther off.
    pub marks: Vec<Point>,
}

/// Arcs are approximated by chords of at most this angle: at 20 mm radius a chord of 0.3 rad
/// deviates by 0.2 mm.
const CHORD_RAD: f64 = 0.3;

/// Margin added to boxes, so that rounding never separates touching objects.
const SLACK_MM: f64 = 1e-6;

fn overlap(a: &Rect, b: &Rect) -> bool {
    a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y
}

impl Obstacles {
    /// Returns the obstacles that these items make.
    pub fn of(items: &[FigureItem]) -> Obstacles {
        let mut all = Obstacles::default();
        all.add(items, None);
        all
    }

    /// Returns the obstacle of a turned label whose box has these corners, counter-clockwise from
    /// the start of its lower edge.
    pub fn of_turned(corners: [Point; 4]) -> Obstacles {
        let mut all = Obstacles::default();
        all.turned(corners, None);
        all
    }

    /// Adds the obstacles that these items make, all with one owner.
    pub fn add(&mut self, items: &[FigureItem], owner: Option<u32>) {
        for item in items {
            let (bars, heads) = (self.bars.len(), self.heads.len());
            self.add_item(item, owner);
            self.bar_leaders(&item.class, [bars, heads]);
        }
    }

    /// Counts the lines and discs in `self` that the others cross, or approach to less than
    /// `air_mm`.
    pub fn met_by(&self, others: &Obstacles, air_mm: f64) -> usize {
        // Most of a drawing is far away: boxes exclude it, first one box around all the others,
        // then one for each.
        let boxes: Vec<Rect> = others
            .bars
            .iter()
            .map(|o| Rect::new(o.from, o.to).grown(o.half_width_mm + air_mm.max(0.0) + SLACK_MM))
            .collect();
        let Some(all) = boxes.iter().copied().reduce(Rect::union) else { return 0 };
        let any = |own: Rect, meets: &dyn Fn(&Bar) -> bool| {
            overlap(&own, &all)
                && boxes.iter().zip(&others.bars).any(|(b, o)| overlap(&own, b) && meets(o))
        };
        let met = |bar: &&Bar| {
            any(Rect::new(bar.from, bar.to).grown(bar.half_width_mm), &|o| {
                super::cost::bars_apart(bar, o) < air_mm
            })
        };
        let disc = |d: &&InkDisc| {
            any(Rect::new(d.centre, d.centre).grown(d.radius_mm), &|o| {
                super::cost::to_bar(d.centre, o) < d.radius_mm + air_mm
            })
        };
        self.bars.iter().filter(met).count() + self.discs.iter().filter(disc).count()
    }

    /// Bars leader lines from crossing the bars and heads from these indices on, which belong to an
    /// item of this class.
    fn bar_leaders(&mut self, class: &str, [bars, heads]: [usize; 2]) {
        let is = |word| class.split(' ').any(|w| w == word);
        if is("rotation") || is("angle") && !is("reference") {
            self.barred.extend_from_slice(&self.bars[bars..]);
            // The barbs extend back beyond the notch, where the shaft becomes visible.
            for (head, [left, right]) in self.heads[heads..].iter().zip(&self.barbs[heads..]) {
                let edges = [(*left, head.to), (*right, head.to), (*left, *right)];
                self.barred.extend(edges.map(|(from, to)| Bar {
                    from,
                    to,
                    half_width_mm: 0.0,
                    ..*head
                }));
            }
        } else if is("hatch") {
            // From tip to tip: a leader line between two strokes of hatching is lost among them as
            // well.
            let next = |w: &&[Bar]| w[0].to.distance(w[1].to) < 2.0 * w[0].from.distance(w[0].to);
            let tips = self.bars[bars..].windows(2).filter(next).map(|w| Bar {
                from: w[0].to,
                to: w[1].to,
                ..w[0]
            });
            self.barred.extend(tips);
            self.barred.extend_from_slice(&self.bars[bars..]);
        }
    }

    /// Returns true if a point is in hatching, or nearer than `air_mm` to hatching or an arc.
    pub fn is_barred(&self, p: Point, air_mm: f64) -> bool {
        self.barred.iter().any(|bar| super::cost::to_bar(p, bar) < air_mm)
    }

    fn add_item(&mut self, item: &FigureItem, owner: Option<u32>) {
        let half = |s: &Option<LineStroke>| s.map_or(0.0, |s| s.width_mm / 2.0);
        match &item.shape {
            Shape::Line { from, to, stroke } => self.bar(*from, *to, stroke.width_mm / 2.0, owner),
            Shape::Polyline { points, closed, stroke, .. } => {
                for w in points.windows(2) {
                    self.bar(w[0], w[1], half(stroke), owner);
                }
                if let (true, Some(&first), Some(&last)) = (*closed, points.first(), points.last())
                {
                    self.bar(last, first, half(stroke), owner);
                }
            }
            Shape::Path { start, pieces, closed, stroke, .. } => {
                let (mut begin, mut here) = (*start, *start);
                for piece in pieces {
                    match *piece {
                        PathPiece::Move(to) => (begin, here) = (to, to),
                        PathPiece::Line(to) => {
                            self.bar(here, to, half(stroke), owner);
                            here = to;
                        }
                        PathPiece::Arc { centre, radius_mm, from_rad, to_rad } => {
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
                self.discs.push(InkDisc { centre: *centre, radius_mm: radius_mm + half(stroke) });
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
                if let Some(corners) = turned_corners(*at, *angle_rad, label, *size_mm) {
                    self.turned(corners, owner);
                }
            }
            Shape::Label { .. } => self.rects.extend(item.bounds()),
        }
    }

    /// Adds a bar as thick as the letters are high.
    fn turned(&mut self, [a, b, c, d]: [Point; 4], owner: Option<u32>) {
        let middle = |p: Point, q: Point| p + (q - p) * 0.5;
        self.bar(middle(a, d), middle(b, c), a.distance(d) / 2.0, owner);
    }

    fn bar(&mut self, from: Point, to: Point, half_width_mm: f64, owner: Option<u32>) {
        self.bars.push(Bar { from, to, half_width_mm, owner, faint: false });
    }

    fn arc(
        &mut self,
        centre: Point,
        radius_mm: f64,
        from_rad: f64,
        to_rad: f64,
        half_width_mm: f64,
        owner: Option<u32>,
    ) {
        let n = ((to_rad - from_rad).abs() / CHORD_RAD).ceil().max(1.0);
        let point = |k: f64| on_circle(centre, radius_mm, from_rad + (to_rad - from_rad) * k / n);
        for k in 0..n as usize {
            self.bar(point(k as f64), point(k as f64 + 1.0), half_width_mm, owner);
        }
    }

    fn head(&mut self, corners: &[Point], owner: Option<u32>) {
        if let &[tip, left, notch, right] = corners {
            self.heads.push(Bar {
                from: notch,
                to: tip,
                half_width_mm: left.distance(right) / 2.0,
                owner,
                faint: false,
            });
            self.barbs.push([left, right]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::paper::place::cost::{bars_apart, to_bar};

    /// Checks that the boxes exclude nothing that meets: the count equals that of all against all.
    #[test]
    fn what_is_met_is_counted_as_without_boxes() {
        let mut state = 7_u64;
        let mut random = |size: f64| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / (1u64 << 24) as f64 * size
        };
        let mut counts = [0; 2];
        for _ in 0..60 {
            let mut some = |bars: usize, size: f64| {
                let mut all = Obstacles::default();
                for k in 0..bars {
                    let from = Point::new(random(size), random(size));
                    // Includes vertical and horizontal lines, and lines of length zero.
                    let to = match k % 4 {
                        0 => Point::new(from.x, random(size)),
                        1 => Point::new(random(size), from.y),
                        2 => from,
                        _ => Point::new(random(size), random(size)),
                    };
                    all.bar(from, to, random(0.5), None);
                    all.discs.push(InkDisc { centre: to, radius_mm: random(2.0) });
                }
                all
            };
            let (drawn, others) = (some(40, 90.0), some(3, 30.0));
            for air in [-0.2, 0.0, 0.1, 3.0] {
                let met = drawn
                    .bars
                    .iter()
                    .filter(|b| others.bars.iter().any(|o| bars_apart(b, o) < air))
                    .count()
                    + drawn
                        .discs
                        .iter()
                        .filter(|d| {
                            others.bars.iter().any(|o| to_bar(d.centre, o) < d.radius_mm + air)
                        })
                        .count();
                assert_eq!(drawn.met_by(&others, air), met, "{drawn:?} {others:?} {air}");
                counts[usize::from(met > 0)] += 1;
            }
        }
        assert!(counts[0] > 0 && counts[1] > 100, "{counts:?}");
    }
}
