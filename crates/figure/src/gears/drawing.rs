//! The drawing of a gear pair: teeth, circles, line of action, contacts.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use hodograph_base::geom::{Point, Vec2};
use hodograph_board::construct::scale::choose_in;
use hodograph_board::plan::names::{name_label, point_label};
use hodograph_methods::gears::{Gear, Mate};
use hodograph_paper::paper::drawing::{Drawing, DrawingPart};
use hodograph_paper::paper::item::{Dash, LineStroke, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::phrase::tr;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_paper::paper::symbols as sym;
use hodograph_scene::{DiagramKind, Kind, Lang};

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

/// Angle over which a gear is drawn on either side of the line of centres (rad): as far as its
/// teeth extend, which are offset to one side.
fn sector(g: &Gear) -> f64 {
    TAU * (f64::from(TEETH) + 0.9) / f64::from(g.teeth)
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
        let mut d = Drawing::new("gears", style.clone());
        let (from, to) = (Point::new(0.0, -down * k), Point::new(0.0, up * k));
        d.shape(
            "centres",
            "line",
            Shape::Line { from, to, stroke: style.thin.dashed(Dash::DashDot) },
        );
        for (i, (g, y)) in rounds.iter().zip(&centres).enumerate() {
            let centre = Point::new(0.0, y * k);
            // Direction of the pitch point from the centre.
            let toward = if *y < 0.0 { FRAC_PI_2 } else { -FRAC_PI_2 };
            self.circles(&mut d, (i, centre, toward), reach, k);
            let pitch_angle = TAU / f64::from(g.teeth);
            // The driver's right flank, the driven gear's left one: seen from the centre, the first
            // tooth (for a ring: space) is ahead.
            let first = toward + g.half_tooth(&pair.basic, g.pitch);
            let most = TEETH.min((g.teeth as i32 - 1) / 2);
            let points = (-most..=most)
                .flat_map(|n| {
                    g.tooth(&pair.basic, first + pitch_angle * f64::from(n), FLANK_POINTS)
                })
                .map(|p| centre + p.to_vec2() * k)
                .collect();
            self.teeth(&mut d, i, points);
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
        self.action(&mut d, reach, k);
        let scales = DrawingScales::of(&maker.scene.book, DiagramKind::Plane, mu);
        let (lang, a, b) = (maker.options.lang, self.name(0), self.name(1));
        let names = match (pair.mate, lang) {
            (Mate::Gear, Lang::En) => format!("Gears {a} and {b}"),
            (Mate::Gear, Lang::Zh) => format!("齿轮 {a} 与 {b}"),
            (Mate::Ring, Lang::En) => format!("Gear {a} in ring {b}"),
            (Mate::Ring, Lang::Zh) => format!("齿轮 {a} 与内齿轮 {b}"),
            (Mate::Rack, Lang::En) => format!("Gear {a} on rack {b}"),
            (Mate::Rack, Lang::Zh) => format!("齿轮 {a} 与齿条 {b}"),
        };
        let words = match lang {
            Lang::En => format!("{names}; {a} drives, clockwise"),
            Lang::Zh => format!("{names}（{a} 主动，顺时针）"),
        };
        maker.titled(d.finish(), Label::text(words), &scales, "gears")
    }

    /// Draws an outline of teeth.
    fn teeth(&self, d: &mut Drawing, i: usize, points: Vec<Point>) {
        d.of_link(Some(self.rolling.links[self.order[i]].0));
        let stroke = Some(self.maker.options.style.outline);
        d.shape(
            &format!("teeth-{}", self.name(i)),
            "teeth",
            Shape::Polyline { points, closed: false, stroke, fill: None },
        );
        d.of_link(None);
    }

    /// Draws the teeth of a rack with pitch line, tip line and root line, each named at its end.
    fn rack(&self, d: &mut Drawing, k: f64) {
        let style = &self.maker.options.style;
        let points =
            self.pair.rack_teeth(TEETH).into_iter().map(|p| (p.to_vec2() * k).to_point()).collect();
        self.teeth(d, 1, points);
        let [tip, root] = self.pair.rack();
        let half = PI * self.pair.basic.module * (f64::from(TEETH) + 0.8) * k;
        let lang = self.maker.options.lang;
        let lines = [
            ("pitch", tr(lang, "pitch line", "节线"), 0.0, style.thin.dashed(Dash::DashDot), 1.0),
            ("tip", tr(lang, "tip line", "齿顶线"), -tip * k, style.thin, -1.0),
            ("root", tr(lang, "root line", "齿根线"), root * k, style.thin, -1.0),
        ];
        for (name, words, y, stroke, side) in lines {
            let (from, to) = (Point::new(-half, y), Point::new(half, y));
            let owner = d.shape(&format!("line-{name}"), "line", Shape::Line { from, to, stroke });
            let end = if side > 0.0 { to } else { from };
            let request = LabelRequest::at_point(Label::text(words), style.small_mm, end, 0.8);
            d.label(
                &format!("line-{name}"),
                "line",
                request.owned(owner).towards(Vec2::new(side, 0.0)),
            );
        }
    }

    /// Draws the circles of a gear as arcs about the line of centres, each named at its end.
    fn circles(
        &self,
        d: &mut Drawing,
        (i, centre, toward): (usize, Point, f64),
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
            let owner = d.shape(
                &id,
                "circle",
                Shape::Arc { centre, radius_mm: radius * k, from_rad, to_rad, stroke },
            );
            let along = Vec2::from_angle(toward + side * half);
            let end = centre + along * (radius * k);
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
