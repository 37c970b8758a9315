//! Draws insets: a cluster of vectors too small for their names is drawn again beside the polygon,
//! to its own scale.

use hodograph_base::geom::{Point, Vec2};
use hodograph_board::construct::scale;
use hodograph_paper::paper::drawing::Drawing;
use hodograph_paper::paper::item::{Anchor, Colour, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::style::Style;
use hodograph_report::amount::scale_formula;

use super::names::VectorPlace;
use super::{PolygonDraft, SAME_MM, ZERO_MM, middle};

/// A longer vector has space for its name.
const SHORT_MM: f64 = 10.0;
/// A shorter vector is a head without a shaft.
const HEADLESS_MM: f64 = 1.2;
/// Crowded vectors closer than this form one cluster.
const NEAR_MM: f64 = 9.0;
/// Maximum number of insets.
const INSETS_MAX: usize = 2;
/// Space for an enlarged cluster.
const ROOM_MM: f64 = 42.0;
/// A smaller enlargement is not worth a second drawing.
const LEAST: f64 = 2.0;
/// Space around a cluster in the inset, for the letters at its ends.
const AIR_MM: f64 = 7.0;
/// Distance from the polygon to the inset.
const GAP_MM: f64 = 9.0;

/// A cluster and the place of its enlargement.
pub(super) struct Inset {
    /// The indices of its arrows.
    pub arrows: Vec<usize>,
    /// The centre of the cluster, and the radius that includes its letters.
    centre: Point,
    radius_mm: f64,
    /// The scale of the enlargement (SI units per mm), and the magnification.
    mu: f64,
    times: f64,
    /// The centre of the enlargement.
    at: Point,
}

impl Inset {
    /// Returns true if a point belongs to the cluster and to no vector outside it.
    pub fn has_alone(&self, draft: &PolygonDraft, p: Point) -> bool {
        let ends = |k: usize| {
            let a = &draft.arrows[k];
            a.from.distance(p) < SAME_MM || a.to.distance(p) < SAME_MM
        };
        self.arrows.iter().any(|k| ends(*k))
            && !(0..draft.arrows.len()).any(|k| !self.arrows.contains(&k) && ends(k))
    }

    fn map(&self, p: Point) -> Point {
        self.at + (p - self.centre) * self.times
    }

    fn outer_mm(&self) -> f64 {
        self.radius_mm * self.times
    }
}

impl PolygonDraft<'_> {
    /// The clusters that need an inset because the names of some of their vectors found no place:
    /// the largest [`INSETS_MAX`].
    pub(super) fn insets(&self, unnamed: impl Fn(usize) -> bool) -> Vec<Inset> {
        let length = |k: usize| self.arrows[k].from.distance(self.arrows[k].to);
        let short: Vec<usize> =
            (0..self.arrows.len()).filter(|&k| (ZERO_MM..SHORT_MM).contains(&length(k))).collect();
        let trouble = |k: &&usize| unnamed(**k) || length(**k) < HEADLESS_MM;
        let mut clusters: Vec<Vec<usize>> = Vec::new();
        for &k in short.iter().filter(trouble) {
            let (together, apart): (Vec<_>, Vec<_>) = clusters
                .into_iter()
                .partition(|c| c.iter().any(|o| self.apart_mm(*o, k) < NEAR_MM));
            clusters = apart;
            clusters.push(together.into_iter().flatten().chain([k]).collect());
        }
        // A single vector that its ends name needs no second drawing.
        clusters.retain(|c| c.len() > 1 || c.iter().any(|k| length(*k) < HEADLESS_MM));
        clusters.sort_by_key(|c| (std::cmp::Reverse(c.len()), c[0]));
        let mut insets: Vec<Inset> = Vec::new();
        for mut cluster in clusters.into_iter().take(INSETS_MAX) {
            // Its short neighbours are drawn with it.
            let joined = short.iter().filter(|k| {
                !cluster.contains(k) && cluster.iter().any(|o| self.apart_mm(*o, **k) < SAME_MM)
            });
            let joined: Vec<usize> = joined.copied().collect();
            cluster.extend(joined);
            cluster.sort_unstable();
            insets.extend(self.enlarged(cluster, &insets));
        }
        insets
    }

    /// The least distance between the ends of two vectors.
    fn apart_mm(&self, a: usize, b: usize) -> f64 {
        let (a, b) = (&self.arrows[a], &self.arrows[b]);
        let pairs = [(a.from, b.from), (a.from, b.to), (a.to, b.from), (a.to, b.to)];
        pairs.into_iter().map(|(p, q)| p.distance(q)).fold(f64::INFINITY, f64::min)
    }

    /// Places a cluster's enlargement to the right, to the left or below the polygon and the
    /// previous insets, whichever is nearest.
    fn enlarged(&self, arrows: Vec<usize>, before: &[Inset]) -> Option<Inset> {
        let ends: Vec<Point> =
            arrows.iter().flat_map(|k| [self.arrows[*k].from, self.arrows[*k].to]).collect();
        let (lo, hi) = around(ends.iter().copied());
        let size = hi - lo;
        let mu = scale::choose_in(
            self.w.scene.book.size(self.p.on.kind()),
            [size.x * self.p.mu, size.y * self.p.mu],
            [ROOM_MM, ROOM_MM],
        );
        let times = self.p.mu / mu;
        if !(times.is_finite() && times >= LEAST) {
            return None;
        }
        let centre = lo + size * 0.5;
        let mut inset = Inset {
            arrows,
            centre,
            radius_mm: size.norm() / 2.0 + AIR_MM / times,
            mu,
            times,
            at: centre,
        };
        let mut all: Vec<Point> = self.arrows.iter().flat_map(|a| [a.from, a.to]).collect();
        all.extend(self.image_circles().iter().flat_map(|c| c.corners()));
        for i in before {
            all.extend(
                [Vec2::new(1.0, 1.0), Vec2::new(-1.0, -1.0)].map(|u| i.at + u * i.outer_mm()),
            );
        }
        let (lo, hi) = around(all.iter().copied());
        let off = inset.outer_mm() + GAP_MM;
        let sides = [
            Point::new(hi.x + off, centre.y),
            Point::new(lo.x - off, centre.y),
            Point::new(centre.x, lo.y - off),
        ];
        let at = sides
            .into_iter()
            .min_by(|a, b| a.distance(centre).total_cmp(&b.distance(centre)))
            .unwrap_or(centre);
        // Clear of the ring around the cluster, which may extend beyond the polygon.
        let u = (at - centre).unit().unwrap_or(Vec2::new(1.0, 0.0));
        inset.at =
            centre + u * at.distance(centre).max(inset.radius_mm + inset.outer_mm() + GAP_MM / 2.0);
        Some(inset)
    }

    /// Draws the enlargement of a cluster.
    pub(super) fn inset(&self, d: &mut Drawing, style: &Style, inset: &Inset) {
        let steps: Vec<usize> =
            inset.arrows.iter().flat_map(|k| self.arrows[*k].steps.iter().copied()).collect();
        let class =
            steps.iter().fold("inset".to_owned(), |class, step| format!("{class} step-{step}"));
        let ring = |centre, radius_mm| Shape::Arc {
            centre,
            radius_mm,
            from_rad: 0.0,
            to_rad: std::f64::consts::TAU,
            stroke: style.thin,
        };
        let u = (inset.at - inset.centre).unit().unwrap_or(Vec2::new(1.0, 0.0));
        let near = inset.radius_mm;
        let lead = Shape::Line {
            from: inset.centre + u * near,
            to: inset.at - u * inset.outer_mm(),
            stroke: style.thin,
        };
        d.behind(|d| {
            d.shape("inset-of", &class, ring(inset.centre, near));
        });
        d.shape("inset-frame", &class, ring(inset.at, near * inset.times));
        d.shape("inset-lead", &class, lead);
        let ends: Vec<Point> =
            inset.arrows.iter().flat_map(|k| [self.arrows[*k].from, self.arrows[*k].to]).collect();
        let inner = middle(ends.iter().map(|p| inset.map(*p)));
        // Other vectors that pass through, without names.
        for (_, a) in self.arrows.iter().enumerate().filter(|(k, _)| !inset.arrows.contains(k)) {
            let Some((from, to)) = within(a.from, a.to, inset.centre, near) else { continue };
            d.of_link(a.link);
            let ends_here = to.distance(a.to) < SAME_MM;
            let (from, to) = (inset.map(from), inset.map(to));
            let shape = if ends_here {
                Shape::Arrow { from, to, stroke: a.stroke(style), head: style.head }
            } else {
                Shape::Line { from, to, stroke: a.stroke(style) }
            };
            d.shape(&format!("inset-part-{}", a.key()), &format!("inset {}", a.classes()), shape);
        }
        for &k in &inset.arrows {
            let a = &self.arrows[k];
            let (from, to) = (inset.map(a.from), inset.map(a.to));
            d.of_link(a.link);
            let shape = Shape::Arrow { from, to, stroke: a.stroke(style), head: style.head };
            let shown = a.shown(self.p.mu, inset.times);
            let owner = d.vector(
                &format!("inset-{}", a.key()),
                &format!("inset {}", a.classes()),
                shape,
                shown,
            );
            if self.listed.contains(&k) {
                continue;
            }
            self.name(
                d,
                style,
                a,
                VectorPlace { ends: (from, to), owner, middle: inner, within: "inset" },
            );
        }
        d.of_link(None);
        // Marks that the enlargement separates have separate names.
        for (k, l) in self.letters(SAME_MM / inset.times).iter().enumerate() {
            if l.at.distance(inset.centre) < near {
                let at = inset.map(l.at);
                let name = format!("inset-mark-{}", l.keys[0]);
                d.label_at(
                    &name,
                    &format!("inset {}", l.class(k)),
                    &l.names.join(", "),
                    at,
                    0.3,
                    (at - inner).unit(),
                );
            }
        }
        let mu = scale_formula(&self.w.scene.book, self.p.on, inset.mu);
        let at = inset.at - Vec2::new(0.0, inset.outer_mm() + style.small_mm + 0.8);
        let label = Shape::Label {
            at,
            label: Label::math(mu),
            size_mm: style.small_mm,
            anchor: Anchor::Middle,
            colour: Colour::BLACK,
        };
        d.shape("inset-scale", &class, label);
    }
}

/// The part of a segment inside a circle.
fn within(a: Point, b: Point, centre: Point, radius_mm: f64) -> Option<(Point, Point)> {
    let (d, m) = (b - a, a - centre);
    let (p, q) = (m.dot(d) / d.norm2(), (m.norm2() - radius_mm * radius_mm) / d.norm2());
    let root = (p * p - q).max(0.0).sqrt();
    let (t0, t1) = ((-p - root).max(0.0), (-p + root).min(1.0));
    (t0 < t1).then(|| (a + d * t0, a + d * t1))
}

fn around(points: impl Iterator<Item = Point>) -> (Point, Point) {
    let start = (
        Point::new(f64::INFINITY, f64::INFINITY),
        Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY),
    );
    points.fold(start, |(lo, hi), p| {
        (Point::new(lo.x.min(p.x), lo.y.min(p.y)), Point::new(hi.x.max(p.x), hi.y.max(p.y)))
    })
}
