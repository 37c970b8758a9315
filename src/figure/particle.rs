//! Motions without a mechanism: the course of a pursuit with its lines of sight, velocities and accelerations at the instant; a plate that turns in space in
//! two views, square to it and along its axis, with the parts of velocity and acceleration at the point.
//!
//! What is drawn comes from [`crate::particle::board`]; decided here are scales of the course, captions and where the parts stand.

use crate::construct::scale::choose;
use crate::diag::Diagnostic;
use crate::geom::{Point, Vec2};
use crate::mechanism::Level;
use crate::paper::phrase::tr;
use crate::particle::board::{Arrow, Drawn, Views};
use crate::particle::law::Way;
use crate::particle::pursuit::End;
use crate::particle::{Kind, Problem, Solved, course};
use crate::report::amount::of_level;
use crate::report::answers::DIGITS;
use crate::report::particle as report;
use crate::scene::{Book, Lang};

use super::arrange::Tree;
use super::drawing::{Drawing, Part};
use super::grid::{self, Cell, Row};
use super::item::{Anchor, Colour, Dash, Figure, Item, Shape};
use super::label::Label;
use super::lines::wrapped;
use super::place::LabelRequest;
use super::sheet::MARGIN_MM;
use super::style::Style;
use super::symbols as sym;
use super::words::words;

/// Room of the course of a pursuit (mm).
const COURSE_MM: [f64; 2] = [120.0, 75.0];
/// Lines of sight.
const SIGHTS: usize = 8;
/// Places between two of them.
const FINE: usize = 12;
/// Width of the text below.
const TEXT_MM: f64 = 165.0;
/// Below a drawing: its caption, then its scale.
const CAPTION_MM: f64 = 6.0;
const SCALE_MM: f64 = 5.6;

/// A plate seen on its edge lies behind the vectors along it.
const PLATE: Colour = Colour::grey(175);

/// What all drawings need.
struct Maker<'a> {
    problem: &'a Problem,
    solved: &'a Solved,
    style: &'a Style,
    lang: Lang,
}

/// The figures, one for each motion that has something to draw, each with the word that names its file.
///
/// # Errors
/// Laws without a value on the way.
pub fn figures(
    problem: &Problem,
    solved: &Solved,
    board: &[Drawn],
    style: &Style,
    lang: Lang,
) -> Result<Vec<(String, Figure)>, Diagnostic> {
    let maker = Maker { problem, solved, style, lang };
    let name = |d: &Drawn| if board.len() == 1 { String::new() } else { problem.motions[d.motion].point.clone() };
    board.iter().map(|d| Ok((name(d), maker.figure(d, true)?))).collect()
}

/// The figure of one motion without title and answers, for documents.
///
/// # Errors
/// Laws without a value on the way.
pub fn within_text(problem: &Problem, solved: &Solved, drawn: &Drawn, style: &Style, lang: Lang) -> Result<Figure, Diagnostic> {
    Maker { problem, solved, style, lang }.figure(drawn, false)
}

impl Maker<'_> {
    fn figure(&self, d: &Drawn, whole: bool) -> Result<Figure, Diagnostic> {
        let mut parts: Vec<Part> = Vec::new();
        let mut add = |part: Part| {
            parts.push(part);
            Tree::Leaf(parts.len() - 1)
        };
        let mut rows = Vec::new();
        match &d.views {
            Views::Chase { velocities, foot, accelerations, .. } => {
                rows.push(Tree::row(vec![add(self.course(d)?)]));
                let polygons = [(Level::Velocity, velocities, Some(*foot)), (Level::Acceleration, accelerations, None)];
                let drawn: Vec<Tree> = polygons.iter().map(|(level, arrows, foot)| add(self.polygon(d, *level, arrows, *foot))).collect();
                rows.push(Tree::row(drawn));
            }
            Views::Plate { velocities, accelerations, .. } => {
                for (level, views) in [(Level::Velocity, velocities), (Level::Acceleration, accelerations)] {
                    let two = vec![add(self.on_plate(d, level, &views[0])?), add(self.along_axis(d, level, &views[1]))];
                    rows.push(Tree::row(two));
                }
            }
        }
        if whole {
            rows.push(add(self.text()));
        }
        let tree = Tree::column(rows);
        let size = tree.size(&parts);
        let head = if whole { 12.0 } else { 0.0 };
        let page = [size[0] + 2.0 * MARGIN_MM, size[1] + 2.0 * MARGIN_MM + head];
        tree.put(&mut parts, Point::new(MARGIN_MM, page[1] - MARGIN_MM - head));
        let mut items: Vec<Item> = parts.into_iter().flat_map(|p| p.items).collect();
        let title = self.lang.of(&self.problem.title).to_owned();
        if whole {
            items.push(self.words(
                "title",
                Point::new(page[0] / 2.0, page[1] - MARGIN_MM - 4.0),
                Label::text(title.as_str()),
                self.style.caption_mm * 1.15,
            ));
        }
        for (k, item) in items.iter_mut().enumerate() {
            item.id = format!("particle-{k}");
        }
        let lines = report::lines(self.problem, self.solved, DIGITS, self.lang);
        let desc = lines.iter().map(|l| l.plain()).collect::<Vec<_>>().join("; ");
        let lang = words(self.lang).tag.into();
        let mut figure = Figure { width_mm: page[0], height_mm: page[1], title, desc, lang, paper: Colour::WHITE, items };
        self.style.palette.paint(&mut figure);
        Ok(figure)
    }

    fn words(&self, class: &str, at: Point, label: Label, size_mm: f64) -> Item {
        let label = label.in_fonts(&self.style.fonts);
        Item::new(class, Shape::Label { at, label, size_mm, anchor: Anchor::Middle, colour: Colour::BLACK })
    }

    /// A part with its caption, and its scales below.
    fn captioned(&self, part: Part, caption: &str, scales: &[(Level, f64)]) -> Part {
        let (x, y) = (part.bounds.centre().x, part.bounds.min.y - CAPTION_MM);
        let mut items = part.items;
        let told: Vec<String> = scales.iter().map(|(level, mu)| of_level(&Book::default(), *level, *mu)).collect();
        items.push(self.words("caption", Point::new(x, y), Label::text(caption), self.style.caption_mm));
        items.push(self.words("scale", Point::new(x, y - SCALE_MM), Label::math(told.join(",\\quad ")), self.style.small_mm));
        Part::of(items)
    }

    fn text(&self) -> Part {
        let style = self.style;
        let lines = report::lines(self.problem, self.solved, DIGITS, self.lang);
        let labels = lines.iter().flat_map(|l| wrapped(l, TEXT_MM, style.small_mm, &style.fonts));
        let row = |label: Label| Row {
            cells: vec![Some(Cell { label, size_mm: style.small_mm, anchor: Anchor::Start, class: "answer".into(), id: String::new() })],
            height_mm: style.small_mm * 1.6,
        };
        Part::of(grid::set(&labels.map(row).collect::<Vec<_>>(), 0.0))
    }

    fn arrow(&self, d: &mut Drawing, a: &Arrow) {
        let style = self.style;
        let width_mm = if a.whole { style.vector.width_mm } else { style.vector.width_mm * 0.7 };
        if a.from.distance(a.to) <= 0.3 {
            return;
        }
        let stroke = super::item::Stroke { width_mm, ..style.vector };
        let owner = d.shape(&a.symbol, "vector", Shape::Arrow { from: a.from, to: a.to, stroke, head: style.head });
        let symbol = match self.lang {
            Lang::En => a.symbol.replace("a_k", "a_c"),
            Lang::Zh => a.symbol.clone(),
        };
        d.label(&a.symbol, "vector", LabelRequest::along(Label::math(&symbol), style.label_mm, a.from, a.to, width_mm / 2.0).owned(owner));
    }

    fn line(&self, d: &mut Drawing, name: &str, points: Vec<Point>, stroke: super::item::Stroke) {
        d.shape(name, name, Shape::Polyline { points, closed: false, stroke: Some(stroke), fill: None });
    }

    fn named(&self, d: &mut Drawing, name: &str, at: Point) {
        d.draw(name, "point", sym::dot(self.style, at));
        d.label_at(name, "point", name, at, self.style.dot_radius_mm, None);
    }

    /// The course of pursuer and target from the start to the meeting, with lines of sight at equal times.
    fn course(&self, drawn: &Drawn) -> Result<Part, Diagnostic> {
        let (problem, style) = (self.problem, self.style);
        let motion = &problem.motions[drawn.motion];
        let mut d = Drawing::new("course", style.clone());
        let Some((chase, target)) = problem.chase(motion) else { return Ok(d.finish()) };
        let start = chase.start::<f64>()?;
        let end = self.solved.ends.iter().find(|e| e.0 == drawn.motion).map(|e| e.1);
        let met = matches!(end, Some(End::Meet { .. }));
        let last = match end {
            Some(End::Meet { time, .. }) => crate::number::Real::approx(time),
            // Of a pursuit without an end so much as shows how it goes.
            Some(End::Apart { .. }) | None => {
                (2.0 * problem.instant()).max(8.0 * start.distance() / crate::particle::law::jet(chase.speed, 0.0)?.0[0])
            }
        };
        let count = SIGHTS * FINE;
        let reach = if met { last * (1.0 - 1e-6) } else { last };
        let mut times: Vec<f64> = (0..=count).map(|k| reach * k as f64 / count as f64).collect();
        let now = problem.instant();
        let at = times.iter().position(|t| *t >= now).unwrap_or(times.len());
        times.insert(at, now);
        let states = course(&chase, &times)?;
        let mut both: Vec<[Point; 2]> = Vec::new();
        for s in &states {
            let [x, y] = chase.target.at(s.t)?;
            let b = Point::new(x.0[0], y.0[0]);
            both.push([b - Vec2::new(s.d[0], s.d[1]), b]);
        }
        let all = || both.iter().flatten();
        let most = |f: fn(&Point) -> f64| all().map(f).fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], x| [l.min(x), h.max(x)]);
        let ([x0, x1], [y0, y1]) = (most(|p| p.x), most(|p| p.y));
        let mu = choose([x1 - x0, y1 - y0], COURSE_MM);
        let paper = |p: Point| Point::new(p.x / mu, p.y / mu);
        let here = both.remove(at);
        for k in 0..=SIGHTS {
            let [a, b] = both[k * FINE].map(paper);
            if a.distance(b) > 1.0 {
                self.line(&mut d, "sight", vec![a, b], style.thin.coloured(Colour::grey(150)));
            }
        }
        self.line(&mut d, "target", both.iter().map(|p| paper(p[1])).collect(), style.thin.dashed(Dash::DashDot));
        self.line(&mut d, "pursuer", both.iter().map(|p| paper(p[0])).collect(), style.vector);
        for k in 1..SIGHTS {
            for at in both[k * FINE].map(paper) {
                d.draw("tick", "position", sym::dot(style, at));
                let number = LabelRequest::at_point(Label::math(k.to_string()), style.small_mm * 0.85, at, style.dot_radius_mm);
                d.label("tick", "position", number.optional(true));
            }
        }
        let [a, b] = here.map(paper);
        self.line(&mut d, "line", vec![a, b], style.outline);
        let moved = now > 0.0;
        if moved {
            for (name, at) in [(&motion.point, both[0][0]), (&target.to_owned(), both[0][1])] {
                d.draw(name, "point", sym::dot(style, paper(at)));
                d.label_at(name, "point", &format!("{name}_0"), paper(at), style.dot_radius_mm, None);
            }
        }
        self.named(&mut d, &motion.point, a);
        self.named(&mut d, target, b);
        if let Some([_, p]) = both.last().filter(|_| met) {
            self.named(&mut d, "P", paper(*p));
        }
        let caption = match (self.lang, met) {
            (Lang::En, true) => {
                format!("Courses from t = 0 to the meeting P at {} s, lines of sight at equal times", crate::digits::significant(last, 5))
            }
            (Lang::En, false) => {
                format!("Courses from t = 0 to {} s, lines of sight at equal times; no meeting", crate::digits::significant(last, 3))
            }
            (Lang::Zh, true) => format!("自 t = 0 至 {} s 相遇于 P 的轨迹，视线间隔时间相等", crate::digits::significant(last, 5)),
            (Lang::Zh, false) => format!("自 t = 0 至 {} s 的轨迹，视线间隔时间相等；不相遇", crate::digits::significant(last, 3)),
        };
        Ok(self.captioned(d.finish(), &caption, &[(Level::Position, mu)]))
    }

    fn polygon(&self, drawn: &Drawn, level: Level, arrows: &[Arrow], foot: Option<Point>) -> Part {
        let style = self.style;
        let mut d = Drawing::new("polygon", style.clone());
        let pole = match (level, self.lang) {
            (Level::Acceleration, Lang::En) => "o'",
            (Level::Acceleration, Lang::Zh) => "p'",
            (_, Lang::En) => "o",
            (_, Lang::Zh) => "p",
        };
        for a in arrows {
            self.arrow(&mut d, a);
        }
        if let (Some(foot), Some(b)) = (foot, arrows.get(1)) {
            let tip_a = arrows[0].to;
            // v_A's line goes on to the foot where it ends before.
            if foot.to_vec2().norm() > tip_a.to_vec2().norm() || foot.to_vec2().dot(tip_a.to_vec2()) < 0.0 {
                self.line(&mut d, "beyond", vec![tip_a, foot], style.thin);
            }
            let owner = d.shape("across", "across", Shape::Line { from: b.to, to: foot, stroke: style.thin.dashed(Dash::Dashed) });
            let name = format!("\\omega {}", "l");
            if b.to.distance(foot) > 3.0 {
                d.label(
                    "across",
                    "across",
                    LabelRequest::along(Label::math(&name), style.small_mm, b.to, foot, 0.1).owned(owner).optional(true),
                );
            }
        }
        d.draw("pole", "pole", sym::dot(style, Point::ORIGIN));
        d.label_at("pole", "pole", pole, Point::ORIGIN, style.dot_radius_mm, None);
        let (caption, mu) = match level {
            Level::Acceleration => (tr(self.lang, "Acceleration of the pursuer", "追踪点的加速度"), drawn.mu[2]),
            Level::Position | Level::Velocity => (tr(self.lang, "Velocities at the instant", "此瞬时的速度"), drawn.mu[1]),
        };
        self.captioned(d.finish(), caption, &[(level, mu)])
    }

    fn scales(&self, drawn: &Drawn, level: Level) -> [(Level, f64); 2] {
        let mu = if level == Level::Acceleration { drawn.mu[2] } else { drawn.mu[1] };
        [(Level::Position, drawn.mu[0]), (level, mu)]
    }

    /// The view on the plate: its axis upward, the path, v_r or a_r at the point.
    fn on_plate(&self, drawn: &Drawn, level: Level, arrows: &[Arrow]) -> Result<Part, Diagnostic> {
        let style = self.style;
        let mut d = Drawing::new("front", style.clone());
        let Views::Plate { places, .. } = &drawn.views else { return Ok(d.finish()) };
        let motion = &self.problem.motions[drawn.motion];
        let Kind::OnPlate(k, way) = &motion.kind else { return Ok(d.finish()) };
        let plate = &self.problem.plates[*k];
        let (m, mu) = (places[0], drawn.mu[0]);
        let path = self.path(way, mu)?;
        let ends = || path.iter().copied().chain([m, Point::ORIGIN]).chain(arrows.iter().map(|a| a.to));
        let most = |f: fn(Point) -> f64| ends().map(f).fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], x| [l.min(x), h.max(x)]);
        let ([x0, x1], [y0, y1]) = (most(|p| p.x), most(|p| p.y));
        let (low, high) = (y0 - 6.0, y1 + 6.0);
        let (left, right) = (if x0 < -0.5 { x0 - 4.0 } else { 0.0 }, x1 + 4.0);
        let sheet = [Point::new(left, low), Point::new(right, low), Point::new(right, high), Point::new(left, high)];
        d.draw("plate", "plate", sym::plate(style, &sheet));
        let axis = [Point::new(0.0, low - 5.0), Point::new(0.0, high + 7.0)];
        let stroke = style.thin.dashed(Dash::DashDot);
        let owner = d.shape("axis", "axis", Shape::Arrow { from: axis[0], to: axis[1], stroke, head: style.thin_head });
        d.label("axis", "axis", LabelRequest::at_point(Label::math(plate.axis.letter()), style.label_mm, axis[1], 0.6).owned(owner));
        self.line(&mut d, "path", path, style.outline);
        for a in arrows {
            self.arrow(&mut d, a);
        }
        self.named(&mut d, &motion.point, m);
        d.label("link", "link", LabelRequest::at_point(Label::math(&plate.link), style.label_mm, sheet[1] + Vec2::new(-5.0, 5.0), 0.0));
        let caption = tr(self.lang, "View on the plate", "板面视图");
        Ok(self.captioned(d.finish(), caption, &self.scales(drawn, level)))
    }

    /// The path on the plate in millimetres: a line beyond the point and its beginning, a whole circle, a stretch of another way.
    fn path(&self, way: &Way, mu: f64) -> Result<Vec<Point>, Diagnostic> {
        let t = self.problem.instant();
        let place = |t: f64| -> Result<Point, Diagnostic> {
            let [r, z] = way.at(t)?;
            Ok(Point::new(r.0[0] / mu, z.0[0] / mu))
        };
        let now = place(t)?;
        Ok(match way {
            Way::Line { from, angle, .. } => {
                let (s, c) = crate::particle::law::sine_cosine(angle, t)?;
                let along = Vec2::new(s.0[0], c.0[0]);
                let value = |k: usize| crate::particle::law::jet(&from[k], t).map(|j| j.0[0] / mu);
                let start = Point::new(value(0)?, value(1)?);
                let there = along.dot(now - start);
                vec![start + along * there.min(0.0), start + along * (there.max(0.0) + 8.0)]
            }
            Way::Circle { centre, .. } => {
                let value = |k: usize| crate::particle::law::jet(&centre[k], t).map(|j| j.0[0] / mu);
                let centre = Point::new(value(0)?, value(1)?);
                let arm = now - centre;
                (0..=120).map(|k| centre + arm.rotate_by(Vec2::from_angle(std::f64::consts::TAU * f64::from(k) / 120.0))).collect()
            }
            Way::Free(_) => {
                let span = if t > 0.0 { 2.0 * t } else { 1.0 };
                (0..=60).filter_map(|k| place(span * f64::from(k) / 60.0).ok()).collect()
            }
        })
    }

    /// The view along the axis: the plate as a line, and all that is square to the axis.
    fn along_axis(&self, drawn: &Drawn, level: Level, arrows: &[Arrow]) -> Part {
        let style = self.style;
        let mut d = Drawing::new("top", style.clone());
        let Views::Plate { places, along, .. } = &drawn.views else { return d.finish() };
        let motion = &self.problem.motions[drawn.motion];
        let Kind::OnPlate(k, _) = &motion.kind else { return d.finish() };
        let plate = &self.problem.plates[*k];
        let (m, o) = (places[1], Point::ORIGIN);
        let foot = o + along.perp() * along.perp().dot(m.to_vec2());
        let far = along.dot(m - foot);
        let ends = [foot + *along * (far.min(0.0) - 4.0), foot + *along * (far.max(0.0) + 10.0)];
        let order = plate.axis.order();
        for (direction, place) in [(Vec2::new(1.0, 0.0), order[0]), (Vec2::new(0.0, 1.0), order[1])] {
            let reach = arrows.iter().flat_map(|a| [a.from, a.to]).chain(ends).map(|p| direction.dot(p.to_vec2())).fold(12.0, f64::max);
            let tip = o + direction * (reach + 6.0);
            let owner = d.shape("axis", "axis", Shape::Arrow { from: o, to: tip, stroke: style.thin, head: style.thin_head });
            let letter = ["x", "y", "z"][place];
            d.label("axis", "axis", LabelRequest::at_point(Label::math(letter), style.label_mm, tip, 0.6).owned(owner).towards(direction));
        }
        d.shape("plate", "link", Shape::Line { from: ends[0], to: ends[1], stroke: style.link.coloured(PLATE) });
        if foot.distance(o) > 0.5 {
            self.line(&mut d, "offset", vec![o, foot], style.thin.dashed(Dash::Dashed));
        }
        // The axis comes toward the reader.
        d.shape("axis", "axis", Shape::Circle { centre: o, radius_mm: 1.4, stroke: Some(style.outline), fill: Some(Colour::WHITE) });
        d.draw("axis", "axis", sym::dot(style, o));
        d.label("axis", "axis", LabelRequest::at_point(Label::math(plate.axis.letter()), style.label_mm, o, 1.6));
        if let Ok(turn) = plate.turning.at(self.problem.instant())
            && turn.omega != 0.0
        {
            let turn_by = if turn.omega > 0.0 { 1.0 } else { -1.0 };
            let start = along.angle() + turn_by * 0.5;
            let owner = d.draw("omega", "rotation", sym::rotation(style, o, 7.0, start, start + turn_by * 1.3));
            let ring = LabelRequest::along_arc(
                Label::math(format!("\\omega_{{{}}}", plate.link)),
                style.label_mm,
                o,
                7.0,
                [start, start + turn_by * 1.3],
                0.2,
            );
            d.label("omega", "rotation", ring.owned(owner));
        }
        if let (Level::Velocity, [one, other, whole]) = (level, arrows) {
            for from in [one.to, other.to] {
                self.line(&mut d, "parallelogram", vec![from, whole.to], style.thin.dashed(Dash::Dashed));
            }
        }
        for a in arrows {
            self.arrow(&mut d, a);
        }
        self.named(&mut d, &motion.point, m);
        let caption = tr(self.lang, "View along the axis (v′, a′ as they are seen there)", "沿轴视图（v′、a′ 为其投影）");
        self.captioned(d.finish(), caption, &self.scales(drawn, level))
    }
}
