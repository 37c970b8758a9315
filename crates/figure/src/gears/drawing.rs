//! The drawing of a gear pair: teeth, circles, line of action, contacts.

use hodograph_base::lang::{say, tr};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use hodograph_base::geom::{Point, Vec2};
use hodograph_board::construct::scale::choose_in;
use hodograph_board::plan::names::{name_label, point_label};
use hodograph_methods::gears::{Gear, Mate};
use hodograph_paper::paper::drawing::{Drawing, DrawingPart};
use hodograph_paper::paper::extent::on_circle;
use hodograph_paper::paper::item::{Dash, LineStroke, PathPiece, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_paper::paper::style::Style;
use hodograph_paper::paper::symbols as sym;
use hodograph_scene::{DiagramKind, Kind};

use super::DrawnGears;
use crate::scales::DrawingScales;

/// Space for the pair: a page with the table beside it, as large as a sheet.
const ROOM_MM: [f64; 2] = [240.0, 240.0];
/// Largest distance of the centres (modules) at which both are in the drawing: beyond it a tooth
/// would be smaller than its letters.
const WHOLE_MODULES: f64 = 45.0;
/// Largest distance (modules) of a ring's centre from its teeth at which the centre is in the
/// drawing.
const RING_MODULES: f64 = 25.0;
/// Distance from the pitch point (modules) within which a larger pair is drawn.
const NEAR_MODULES: f64 = 8.0;
/// Number of teeth drawn on either side of the pitch point: more than are ever in contact.
const TEETH: i32 = 3;
/// Extent of the line of action, as a part of half the height of the drawing.
const FAR: f64 = 1.4;
/// Points of a flank: for a tooth as high as a hand the chords deviate by less than a line width.
const FLANK_POINTS: usize = 16;

/// Thickness of the filled rim behind the teeth (modules).
const RIM_MODULES: f64 = 1.0;
/// Two corners are on one circle if their distances from its centre differ by less.
const ROUND_MM: f64 = 1e-6;

/// The angle from one direction to another, the shorter way (rad).
fn turn(from: f64, to: f64) -> f64 {
    (to - from + PI).rem_euclid(TAU) - PI
}

/// Angle over which a gear is drawn on either side of the line of centres (rad): as far as its
/// teeth extend, which are offset to one side.
fn sector(g: &Gear) -> f64 {
    TAU * (f64::from(TEETH) + 0.9) / f64::from(g.teeth)
}

/// The outline of a gear's teeth, and the way behind them back to its start.
struct TeethOutline {
    start: Point,
    teeth: Vec<PathPiece>,
    back: Vec<PathPiece>,
}

impl TeethOutline {
    /// The teeth and the rim behind them, filled.
    fn rim(&self, style: &Style) -> Shape {
        let pieces = [self.teeth.as_slice(), &self.back].concat();
        let fill = Some(style.plate);
        Shape::Path { start: self.start, pieces, closed: true, stroke: None, fill }
    }

    /// The line of the teeth.
    fn teeth(&self, style: &Style) -> Shape {
        let (pieces, stroke) = (self.teeth.clone(), Some(style.outline));
        Shape::Path { start: self.start, pieces, closed: false, stroke, fill: None }
    }
}

impl DrawnGears<'_> {
    pub(super) fn drawing(&self) -> DrawingPart {
        let (maker, pair) = (self.maker, &self.pair);
        let style = &maker.options.style;
        let m = pair.basic.module;
        // Relative to the pitch point (m): the centres, the extent of the drawing downwards and
        // upwards, and whether it holds the centres.
        let centres = match pair.mate {
            Mate::Gear => vec![-pair.gears[0].pitch, pair.gears[1].pitch],
            Mate::Ring => vec![-pair.gears[0].pitch, -pair.gears[1].pitch],
            Mate::Rack => vec![-pair.gears[0].pitch],
        };
        let lowest = centres.iter().copied().fold(0.0, f64::min);
        let highest = centres.iter().copied().fold(0.0, f64::max);
        // The space around a ring's centre is empty: the centre is shown for small rings only; the
        // gear's centre may be shown without it.
        let farthest = if pair.mate == Mate::Ring { RING_MODULES } else { WHOLE_MODULES } * m;
        let whole = highest - lowest <= farthest;
        let shown = |y: f64| whole || pair.mate == Mate::Ring && y.abs() <= NEAR_MODULES * 2.0 * m;
        // Where there is no centre, there are teeth or the ring's rim.
        let side = |centre: f64| if centre == 0.0 { 3.0 * m } else { centre.abs() };
        let [down, up] = if whole {
            [side(lowest), side(highest)]
        } else {
            let near = centres
                .iter()
                .filter(|y| shown(**y))
                .fold(NEAR_MODULES * m, |far, y| far.max(y.abs()));
            [near, if pair.mate == Mate::Gear { near } else { 3.0 * m }]
        };
        let rounds = &pair.gears[..centres.len()];
        let half_width = |g: &Gear| g.tip.max(g.root) * libm::sin(sector(g).min(FRAC_PI_2));
        let width = 2.0 * rounds.iter().map(half_width).fold(0.0, f64::max);
        let mu =
            choose_in(maker.scene.book.size(Kind::Length), [width, down + up + 2.0 * m], ROOM_MM);
        let k = 1.0 / mu;
        let reach = (down + up) / 2.0 * k;
        // Direction of the pitch point from a centre.
        let toward = |y: f64| if y < 0.0 { FRAC_PI_2 } else { -FRAC_PI_2 };
        let mut d = Drawing::new("gears", style.clone());
        // The corners of the teeth of each round gear.
        let corners: Vec<Vec<Point>> = rounds
            .iter()
            .zip(&centres)
            .map(|(g, y)| {
                // The driver's right flank, the driven gear's left one: seen from the centre, the
                // first tooth (for a ring: space) is ahead.
                let first = toward(*y) + g.half_tooth(&pair.basic, g.pitch);
                let most = TEETH.min((g.teeth as i32 - 1) / 2);
                let middle = |n: i32| first + TAU / f64::from(g.teeth) * f64::from(n);
                (-most..=most)
                    .flat_map(|n| g.tooth(&pair.basic, middle(n), FLANK_POINTS))
                    .map(|p| Point::new(0.0, y * k) + p.to_vec2() * k)
                    .collect()
            })
            .collect();
        let mut outlines: Vec<Option<TeethOutline>> = corners
            .iter()
            .zip(&centres)
            .enumerate()
            .map(|(i, (corners, y))| self.outline(i, Point::new(0.0, y * k), corners, k))
            .collect();
        if pair.mate == Mate::Rack {
            outlines.push(self.rack_outline(k));
        }
        let body = |d: &mut Drawing, class: &str, of: &dyn Fn(&TeethOutline) -> Shape| {
            for (i, outline) in outlines.iter().enumerate() {
                let Some(outline) = outline else { continue };
                d.of_link(Some(self.rolling.links[self.order[i]].0));
                d.shape(&format!("{class}-{}", self.name(i)), class, of(outline));
                d.of_link(None);
            }
        };
        // The bodies behind all lines, the outlines of the teeth over the circles.
        body(&mut d, "rim", &|o| o.rim(style));
        let (from, to) = (Point::new(0.0, -down * k), Point::new(0.0, up * k));
        d.shape(
            "centres",
            "line",
            Shape::Line { from, to, stroke: style.thin.dashed(Dash::DashDot) },
        );
        for (i, (corners, y)) in corners.iter().zip(&centres).enumerate() {
            let centre = Point::new(0.0, y * k);
            self.circles(&mut d, (i, centre, toward(*y)), corners, reach, k);
            if shown(*y) {
                let name = self.rolling.centres()[self.order[i]]
                    .map_or("O", |p| maker.scene.point_name(p));
                d.draw(&format!("centre-{name}"), "point", sym::dot(style, centre));
                d.label_at(
                    name,
                    "point",
                    &point_label(name),
                    centre,
                    style.dot_radius_mm,
                    Some(Vec2::new(1.0, 0.0)),
                );
            }
        }
        if pair.mate == Mate::Rack {
            self.rack(&mut d, k);
        }
        body(&mut d, "teeth", &|o| o.teeth(style));
        self.action(&mut d, reach, k);
        let scales = DrawingScales::of(&maker.scene.book, DiagramKind::Plane, mu);
        let (lang, a, b) = (maker.options.lang, self.name(0), self.name(1));
        let names = match pair.mate {
            Mate::Gear => say!(lang, "Gears {a} and {b}"),
            Mate::Ring => say!(lang, "Gear {a} in ring {b}"),
            Mate::Rack => say!(lang, "Gear {a} on rack {b}"),
        };
        let words = say!(lang, "{names}; {a} drives, clockwise");
        maker.titled(d.finish(), Label::text(words), &scales, "gears")
    }

    /// The outline of a round gear through the corners of its teeth: flanks, and arcs of the tip
    /// circle and the root circle between them.
    fn outline(&self, i: usize, centre: Point, corners: &[Point], k: f64) -> Option<TeethOutline> {
        let (&start, rest) = corners.split_first()?;
        let g = &self.pair.gears[i];
        let polar = |p: Point| (p.distance(centre), (p - centre).angle());
        let mut teeth = Vec::new();
        let mut before = start;
        for p in rest {
            let ((r, from_rad), (other, to)) = (polar(before), polar(*p));
            teeth.push(if (r - other).abs() < ROUND_MM {
                let to_rad = from_rad + turn(from_rad, to);
                PathPiece::Arc { centre, radius_mm: r, from_rad, to_rad }
            } else {
                PathPiece::Line(*p)
            });
            before = *p;
        }
        let rim = (g.root - g.tip).signum() * RIM_MODULES * self.pair.basic.module;
        let (from_rad, radius_mm) = (polar(before).1, ((g.root + rim) * k).max(0.0));
        let to_rad = from_rad - (from_rad - polar(start).1).rem_euclid(TAU);
        let back = vec![
            PathPiece::Line(on_circle(centre, radius_mm, from_rad)),
            PathPiece::Arc { centre, radius_mm, from_rad, to_rad },
        ];
        Some(TeethOutline { start, teeth, back })
    }

    /// The corners of the rack's teeth on paper.
    fn rack_corners(&self, k: f64) -> Vec<Point> {
        self.pair.rack_teeth(TEETH).into_iter().map(|p| (p.to_vec2() * k).to_point()).collect()
    }

    /// The outline of the rack.
    fn rack_outline(&self, k: f64) -> Option<TeethOutline> {
        let points = self.rack_corners(k);
        let ([start, rest @ ..], Some(last)) = (points.as_slice(), points.last()) else {
            return None;
        };
        let behind = (self.pair.rack()[1] + RIM_MODULES * self.pair.basic.module) * k;
        Some(TeethOutline {
            start: *start,
            teeth: rest.iter().map(|p| PathPiece::Line(*p)).collect(),
            back: [last.x, start.x].map(|x| PathPiece::Line(Point::new(x, behind))).to_vec(),
        })
    }

    /// Draws pitch line, tip line and root line of a rack, each named at its end. The tip line and
    /// the root line are left out between the teeth.
    fn rack(&self, d: &mut Drawing, k: f64) {
        let style = &self.maker.options.style;
        let [tip, root] = self.pair.rack();
        let half = PI * self.pair.basic.module * (f64::from(TEETH) + 0.8) * k;
        let lang = self.maker.options.lang;
        let lines = [
            ("pitch", tr!(lang, "pitch line"), 0.0, style.thin.dashed(Dash::DashDot), 1.0),
            ("tip", tr!(lang, "tip line"), -tip * k, style.thin, -1.0),
            ("root", tr!(lang, "root line"), root * k, style.thin, -1.0),
        ];
        let corners = self.rack_corners(k);
        for (name, words, y, stroke, side) in lines {
            let (from, to) = (Point::new(-half, y), Point::new(half, y));
            let on = corners.iter().filter(|p| (p.y - y).abs() < ROUND_MM).map(|p| p.x);
            let toothed = on.fold(None, |ends: Option<[f64; 2]>, x| {
                Some(ends.map_or([x, x], |[first, last]| [first.min(x), last.max(x)]))
            });
            let shape = match toothed {
                Some([first, last]) => {
                    let at = |x: f64| Point::new(x, y);
                    let pieces = vec![
                        PathPiece::Line(at(first)),
                        PathPiece::Move(at(last)),
                        PathPiece::Line(to),
                    ];
                    let stroke = Some(stroke);
                    Shape::Path { start: from, pieces, closed: false, stroke, fill: None }
                }
                None => Shape::Line { from, to, stroke },
            };
            let owner = d.shape(&format!("line-{name}"), "line", shape);
            let end = if side > 0.0 { to } else { from };
            let request = LabelRequest::at_point(Label::text(words), style.small_mm, end, 0.8);
            d.label(
                &format!("line-{name}"),
                "line",
                request.owned(owner).towards(Vec2::new(side, 0.0)),
            );
        }
    }

    /// Draws the circles of a gear as arcs about the line of centres, each named at its end. The
    /// tip circle and the root circle are left out between the teeth, whose
    /// corners are `corners`.
    fn circles(
        &self,
        d: &mut Drawing,
        (i, centre, toward): (usize, Point, f64),
        corners: &[Point],
        reach: f64,
        k: f64,
    ) {
        let style = &self.maker.options.style;
        let g = &self.pair.gears[i];
        // As far as the teeth extend, and past N if N is in the drawing.
        let tangent = self.pair.tangents()[i].abs() * k <= FAR * reach;
        let past = if tangent { self.pair.operating + 0.12 } else { 0.0 };
        let half = sector(g).max(past).min(PI);
        // Names alternate between the two sides, so that neighbours do not collide.
        let rings: [(&str, &str, f64, LineStroke, f64); 4] = [
            ("root", "r_{f", g.root, style.thin, 1.0),
            ("base", "r_{b", g.base, style.thin.dashed(Dash::Dashed), -1.0),
            ("pitch", "r'_{", g.pitch, style.thin.dashed(Dash::DashDot), 1.0),
            ("tip", "r_{a", g.tip, style.thin, -1.0),
        ];
        for (name, letter, radius, stroke, side) in rings {
            let (from_rad, to_rad) = (toward - half, toward + half);
            let text = format!("{letter}{}}}", name_label(self.name(i)));
            let id = format!("circle-{name}-{}", self.name(i));
            let radius_mm = radius * k;
            let on = |p: &&Point| (p.distance(centre) - radius_mm).abs() < ROUND_MM;
            let turned = |p: &Point| toward + turn(toward, (*p - centre).angle());
            let toothed = [corners.iter().find(on), corners.iter().rev().find(on)];
            let shape = match toothed.map(|corner| corner.map(turned)) {
                [Some(first), Some(last)] if matches!(name, "root" | "tip") => {
                    let arc = |from_rad: f64, to_rad: f64| PathPiece::Arc {
                        centre,
                        radius_mm,
                        from_rad,
                        to_rad,
                    };
                    let at = |angle: f64| on_circle(centre, radius_mm, angle);
                    let pieces = vec![
                        arc(from_rad, first.max(from_rad)),
                        PathPiece::Move(at(last.min(to_rad))),
                        arc(last.min(to_rad), to_rad),
                    ];
                    let (start, stroke) = (at(from_rad), Some(stroke));
                    Shape::Path { start, pieces, closed: false, stroke, fill: None }
                }
                _ => Shape::Arc { centre, radius_mm, from_rad, to_rad, stroke },
            };
            let owner = d.shape(&id, "circle", shape);
            let along = Vec2::from_angle(toward + side * half);
            let end = centre + along * radius_mm;
            let out = if side > 0.0 {
                Vec2::from_angle(toward + FRAC_PI_2)
            } else {
                Vec2::from_angle(toward - FRAC_PI_2)
            };
            let request =
                LabelRequest::at_point(Label::math(text.clone()), style.small_mm, end, 0.3);
            d.label(&id, "circle", request.owned(owner).towards(out));
        }
    }

    /// Draws the line of action with its points and contacts, within `reach` of the pitch point.
    fn action(&self, d: &mut Drawing, reach: f64, k: f64) {
        let (pair, style) = (&self.pair, &self.maker.options.style);
        // The driver turns clockwise and pushes to the right and upwards.
        let along = Vec2::from_angle(pair.operating);
        let at = |t: f64| (along * (t * k)).to_point();
        let [n1, n2] = pair.tangents();
        let [b2, b1] = pair.contact();
        let cut = |t: f64| t.max(-FAR * reach / k).min(FAR * reach / k);
        let (first, last) = (n1.min(n2), n1.max(b1).max(n2));
        let last = if last.is_finite() { last } else { b1 * 1.6 };
        d.shape(
            "action",
            "line",
            Shape::Line {
                from: at(cut(first * 1.12)),
                to: at(cut(last * 1.12)),
                stroke: style.thin,
            },
        );
        let active = Shape::Line { from: at(b2), to: at(b1), stroke: style.outline };
        d.shape("action-active", "line", active);
        let side = along.perp();
        let named = [(n1, "N", 0, -1.0), (n2, "N", 1, 1.0), (b2, "B", 1, 1.0), (b1, "B", 0, -1.0)];
        for (t, letter, i, up) in named {
            if cut(t) == t {
                let name = self.symbol(letter, i);
                d.draw(&format!("{letter}-{}", self.name(i)), "point", sym::dot(style, at(t)));
                d.label_at(&name, "point", &name, at(t), style.dot_radius_mm, Some(side * up));
            }
        }
        // Contacts, one base pitch apart; one of them is at the pitch point.
        let p_b = pair.base_pitch();
        for n in -3..=3 {
            let t = f64::from(n) * p_b;
            if t >= b2 && t <= b1 {
                let circle = Shape::Circle {
                    centre: at(t),
                    radius_mm: 1.2,
                    stroke: Some(style.outline),
                    fill: None,
                };
                d.shape("contact", "contact", circle);
            }
        }
        let name = self.maker.scene.point_name(self.rolling.at[0]).to_owned();
        d.label_at(
            &name,
            "point",
            &point_label(&name),
            Point::ORIGIN,
            1.6,
            Some(Vec2::new(-1.0, 0.6)),
        );
        // The operating pressure angle, between the common tangent and the line of action.
        let radius = (0.75 * reach).min(26.0);
        d.shape(
            "tangent",
            "line",
            Shape::Line {
                from: Point::new(-radius * 1.3, 0.0),
                to: Point::new(radius * 1.3, 0.0),
                stroke: style.thin,
            },
        );
        let owner =
            d.draw("angle", "angle", sym::angle(style, Point::ORIGIN, radius, 0.0, pair.operating));
        let angle = LabelRequest::along_arc(
            Label::math("\\alpha'"),
            style.label_mm,
            Point::ORIGIN,
            radius,
            [0.0, pair.operating],
            style.thin.width_mm,
        );
        d.label("alpha", "angle", angle.owned(owner));
    }
}
