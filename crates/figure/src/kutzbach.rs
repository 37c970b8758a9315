//! Kutzbach's plan of a gear train: velocities perpendicular to the line of centres (线速度图),
//! angular velocities on a parallel line (转速图), and Willis' table beside them.
//!
//! The line of centres is vertical. The velocities of a link along it end on one straight line, its
//! ray. Two known points define a ray; where two pitch circles touch, two rays intersect. Parallels
//! to the rays through one pole cut the angular velocities off a horizontal line. This module draws
//! the plan and the text beside it; [`hodograph_methods::trains`] computes the angular velocities.
//!
//! # Source
//! K. Kutzbach, *Mehrgliedrige Radgetriebe und ihre Gesetze*, 1927.

mod steps;

pub(super) use steps::stepped;

use hodograph_base::lang::each;
use std::f64::consts::TAU;

use hodograph_base::geom::{Point, Vec2};
use hodograph_board::plan::names::{name_label, point_label};
use hodograph_methods::trains::{GearTrain, TrainSpeeds, trains};
use hodograph_paper::paper::phrase::Phrase;
use hodograph_report::trains::{number, omega, table, turns};
use hodograph_scene::{DiagramKind, Kind, LinkId, PointId};

use super::sheet::SheetDrafter;
use crate::scales::DrawingScales;
use hodograph_paper::paper::drawing::{Drawing, DrawingPart};
use hodograph_paper::paper::grid::{self, Cell, Row};
use hodograph_paper::paper::item::{Anchor, Dash, Figure, FigureItem, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::symbols as sym;
use hodograph_report::amount::scale;

/// Gap between the circles and the plan of velocities: space for the plan's arrows and a name.
const APART_MM: f64 = 12.0;
/// Distance from the plan of velocities down to the pole of the angular velocities.
const BELOW_MM: f64 = 12.0;
/// Pole distances, the longest first: 转速图 as wide as the plan of velocities, to an easily read
/// scale.
const POLE_MM: [f64; 5] = [50.0, 40.0, 25.0, 20.0, 10.0];
/// Maximum extent of the plan of angular velocities to one side.
const RATES_MM: f64 = 60.0;
/// Extension of rays beyond their last point.
const BEYOND_MM: f64 = 6.0;
/// Shorter vectors are points.
const ZERO_MM: f64 = 0.05;
/// Centres that deviate from one line by more than this have no plan: a tenth of a line width.
const IN_LINE_MM: f64 = 0.02;
/// Gap between the drawing and the table, and between columns and rows of the table.
const TABLE_MM: f64 = 14.0;
const GAP_MM: f64 = 5.0;
const ROW_MM: f64 = 7.2;

/// A point on the line of centres, on paper.
struct KutzbachPoint {
    name: String,
    /// The position along the line (mm).
    s: f64,
    /// The links with this point.
    links: Vec<LinkId>,
}

/// Draws the plan of each train of the scene, with the name of its arm. Trains with centres that
/// are not collinear, or with a moving axis, have only their table.
pub(super) fn plans(maker: &SheetDrafter) -> Vec<(String, Figure)> {
    let scene = maker.scene;
    let all = trains(scene);
    let one = all.len() == 1;
    let figure = |t: &GearTrain| {
        let turns = turns(scene, maker.worked, t)?;
        let name = if one { String::new() } else { format!("-{}", scene.link_name(t.arm)) };
        let plan = KutzbachPlan { maker, train: t, turns, order: Vec::new() };
        Some((name, plan.figure()))
    };
    all.iter().filter_map(figure).collect()
}

/// Captions in both languages.
const CAPTION: [&str; 2] = each!("Kutzbach plan: linear and angular velocities");
const TABLE: [&str; 2] = each!("Willis' table");

/// The plan as drawn.
struct KutzbachDrawing {
    part: DrawingPart,
    /// The scales of lengths and velocities.
    scales: [(DiagramKind, f64); 2],
    /// The scale of angular velocities as a formula.
    of_rates: String,
}

struct KutzbachPlan<'a> {
    maker: &'a SheetDrafter<'a>,
    train: &'a GearTrain,
    turns: TrainSpeeds,
    /// The links in the order in which their rays are drawn; empty for a drawing without steps.
    order: Vec<LinkId>,
}

impl KutzbachPlan<'_> {
    fn figure(&self) -> Figure {
        let table = self.table();
        let lang = self.maker.options.lang;
        match self.drawing() {
            None => self.maker.alone(table),
            Some(KutzbachDrawing { part, scales, of_rates }) => {
                let book = &self.maker.scene.book;
                let [(plane, mu_l), (velocity, mu_v)] = scales;
                let scales = DrawingScales::of(book, plane, mu_l)
                    .and(DrawingScales::of(book, velocity, mu_v))
                    .and(DrawingScales::words(of_rates));
                let caption = Label::text(lang.pick(CAPTION));
                let mut part = self.maker.titled(part, caption, &scales, "kutzbach");
                let mut beside = table;
                beside.stand_at(Point::new(part.bounds.max.x + TABLE_MM, part.bounds.max.y));
                part.items.extend(beside.items);
                self.maker.alone(DrawingPart::of(part.items))
            }
        }
    }

    /// The angular velocity of a link of the train.
    fn rate(&self, link: LinkId) -> f64 {
        self.train.gear(link).map_or(self.turns.arm, |g| self.train.rate(g, self.turns))
    }

    /// Centres and contacts on the line of centres, measured from the axis; `None` if they are not
    /// collinear.
    fn stations(&self) -> Option<Vec<KutzbachPoint>> {
        let (scene, worked, train) = (self.maker.scene, self.maker.worked, self.train);
        let place = |p: PointId| worked.configuration.points[p.0];
        let (origin, mu_l) = (place(train.axis)?, worked.construction.diagram.mu);
        if !scene.links[scene.ground.0].points.contains(&train.axis) {
            return None;
        }
        let other = train.gears.iter().find(|g| g.centre != train.axis)?.centre;
        let u = (place(other)? - origin).unit()?;
        let mut all: Vec<KutzbachPoint> = Vec::new();
        let mut add = |p: PointId, links: &[LinkId]| {
            let d = (place(p)? - origin) * (1.0 / mu_l);
            if u.cross(d).abs() > IN_LINE_MM {
                return None;
            }
            let name = scene.point_name(p).to_owned();
            match all.iter_mut().find(|s| s.name == name) {
                Some(s) => links.iter().for_each(|l| {
                    if !s.links.contains(l) {
                        s.links.push(*l)
                    }
                }),
                None => all.push(KutzbachPoint { name, s: u.dot(d), links: links.to_vec() }),
            }
            Some(())
        };
        for g in &train.gears {
            add(g.centre, &[g.link, train.arm])?;
        }
        for m in &train.meshes {
            let pair = &scene.rolling[m.0];
            add(pair.at[0], &pair.links)?;
        }
        Some(all)
    }

    fn drawing(&self) -> Option<KutzbachDrawing> {
        let (maker, train) = (self.maker, self.train);
        let style = &maker.options.style;
        let stations = self.stations()?;
        let (mu_l, mu_v) = (
            maker.worked.construction.diagram.mu,
            maker.worked.construction.polygon(DiagramKind::Velocity)?.mu,
        );
        // A link that turns to the left moves to the left above its centre: the plan is the
        // mechanism turned upright.
        let speed = |link: LinkId, s: f64| self.speed(&stations, link, s) * (-mu_l / mu_v);
        let mut d = Drawing::new("kutzbach", style.clone());
        let (low, high) =
            stations.iter().fold((0.0_f64, 0.0_f64), |(a, b), s| (a.min(s.s), b.max(s.s)));
        let widest = stations
            .iter()
            .flat_map(|s| s.links.iter().map(|l| speed(*l, s.s)))
            .fold([0.0_f64; 2], |[a, b], x| [a.min(x), b.max(x)]);
        // The pitch circles, on the left.
        let circles: Vec<(LinkId, f64, f64)> =
            train.meshes.iter().flat_map(|m| self.circles(&stations, m.0)).collect();
        let radius = circles.iter().map(|c| c.2).fold(0.0, f64::max);
        let off = widest[0].min(self.rates_mm(mu_v / mu_l).1[0] - BEYOND_MM) - APART_MM - radius;
        for (link, s, r) in &circles {
            let shape = Shape::Arc {
                centre: Point::new(off, *s),
                radius_mm: *r,
                from_rad: 0.0,
                to_rad: TAU,
                stroke: style.outline.dashed(Dash::DashDot),
            };
            d.of_link((*link != maker.scene.ground).then_some(link.0));
            d.shape(&format!("circle-{}", maker.scene.link_name(*link)), "wheel", shape);
        }
        d.of_link(None);
        let line = |from, to, stroke| Shape::Line { from, to, stroke };
        d.shape(
            "centres",
            "line",
            line(Point::new(off, low), Point::new(off, high), style.thin.dashed(Dash::DashDot)),
        );
        d.shape(
            "zero",
            "line",
            line(
                Point::new(0.0, low - BEYOND_MM),
                Point::new(0.0, high + BEYOND_MM),
                style.outline,
            ),
        );
        for s in &stations {
            let ends = s.links.iter().map(|l| speed(*l, s.s)).fold(0.0_f64, f64::max);
            let across = line(
                Point::new(off, s.s),
                Point::new(ends.max(0.0), s.s),
                style.thin.dashed(Dash::Dotted),
            );
            d.frame(&format!("height-{}", s.name), "height", across);
            d.draw(&format!("point-{}", s.name), "point", sym::dot(style, Point::new(off, s.s)));
            d.label_at(
                &s.name,
                "point",
                &point_label(&s.name),
                Point::new(off, s.s),
                style.dot_radius_mm,
                Some(Vec2::new(1.0, 1.0)),
            );
        }
        for s in &stations {
            let Some(v) = s.links.iter().map(|l| speed(*l, s.s)).find(|v| v.abs() > ZERO_MM) else {
                continue;
            };
            let (from, to) = (Point::new(0.0, s.s), Point::new(v, s.s));
            d.at_step(s.links.iter().filter_map(|l| self.step_of(*l)).min());
            let owner = d.shape(
                &format!("vel-{}", s.name),
                "vector",
                Shape::Arrow { from, to, stroke: style.vector, head: style.head },
            );
            let name = format!("v_{{{}}}", name_label(&s.name));
            d.label_along(
                &format!("vel-{}", s.name),
                "vector",
                &name,
                (from, to),
                style.vector.width_mm / 2.0,
                owner,
            );
        }
        // One ray for each link.
        for link in self.links() {
            let own: Vec<f64> =
                stations.iter().filter(|s| s.links.contains(&link)).map(|s| s.s).collect();
            let (a, b) = own
                .iter()
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), s| (a.min(*s), b.max(*s)));
            let at = |s: f64| Point::new(speed(link, s), s);
            let (Some(u), true) = ((at(b) - at(a)).unit(), a < b) else { continue };
            let (from, to) = (at(a) - u * BEYOND_MM, at(b) + u * BEYOND_MM);
            let name = maker.scene.link_name(link);
            d.of_link((link != maker.scene.ground).then_some(link.0));
            if link != maker.scene.ground {
                d.at_step(self.step_of(link));
                let owner = d.shape(&format!("ray-{name}"), "ray", line(from, to, style.outline));
                d.label_along(
                    &format!("ray-{name}"),
                    "number",
                    &name_label(name),
                    (from, to),
                    style.outline.width_mm / 2.0,
                    owner,
                );
            }
        }
        d.of_link(None);
        d.at_step(None);
        let mu_omega = self.rates(&mut d, low - BELOW_MM, mu_v / mu_l);
        let book = &maker.scene.book;
        let of_rates = format!(
            "\\mu_{{\\omega}} = {} {}",
            scale(book.value(Kind::Omega, mu_omega)),
            book.scale_label(Kind::Omega)
        );
        let scales = [(DiagramKind::Plane, mu_l), (DiagramKind::Velocity, mu_v)];
        Some(KutzbachDrawing { part: d.finish(), scales, of_rates })
    }

    /// All links of the train, each once: the gears, then the arm.
    fn links(&self) -> Vec<LinkId> {
        let mut all: Vec<LinkId> = self.train.gears.iter().map(|g| g.link).collect();
        if !all.contains(&self.train.arm) {
            all.push(self.train.arm);
        }
        all
    }

    /// Velocity of a link's point on the line of centres, positive to the left, in mm of paper
    /// times rad/s.
    fn speed(&self, stations: &[KutzbachPoint], link: LinkId, s: f64) -> f64 {
        let centre =
            self.train.gear(link).map(|g| self.maker.scene.point_name(self.train.gears[g].centre));
        let at = centre.and_then(|c| stations.iter().find(|t| t.name == c)).map_or(0.0, |t| t.s);
        self.turns.arm * at + self.rate(link) * (s - at)
    }

    /// The two circles of a mesh: link, height of the centre, radius.
    fn circles(&self, stations: &[KutzbachPoint], mesh: usize) -> Vec<(LinkId, f64, f64)> {
        let scene = self.maker.scene;
        let pair = &scene.rolling[mesh];
        let height =
            |p: PointId| stations.iter().find(|s| s.name == scene.point_name(p)).map(|s| s.s);
        let circle = |i: usize| {
            let (c, q) = (height(pair.centres()[i]?)?, height(pair.at[0])?);
            Some((pair.links[i], c, (q - c).abs()))
        };
        [0, 1].into_iter().filter_map(circle).collect()
    }

    /// The pole distance of the plan of angular velocities, and the plan's extent to the left and
    /// to the right. `slope` is the angular velocity of a ray at 45°.
    fn rates_mm(&self, slope: f64) -> (f64, [f64; 2]) {
        let rates: Vec<f64> = self.links().into_iter().map(|l| -self.rate(l) / slope).collect();
        let [a, b] = rates.iter().fold([0.0_f64; 2], |[a, b], x| [a.min(*x), b.max(*x)]);
        let pole_mm = POLE_MM
            .into_iter()
            .find(|h| b.max(-a) * h <= RATES_MM)
            .unwrap_or(POLE_MM[POLE_MM.len() - 1]);
        (pole_mm, [a * pole_mm, b * pole_mm])
    }

    /// Draws the plan of angular velocities, with its pole at the height `top`; returns its scale
    /// ((rad/s)/mm).
    fn rates(&self, d: &mut Drawing, top: f64, slope: f64) -> f64 {
        let (maker, style) = (self.maker, &self.maker.options.style);
        let links = self.links();
        let (pole_mm, [a, b]) = self.rates_mm(slope);
        let (pole, foot) = (Point::new(0.0, top), top - pole_mm);
        let at = |w: f64| Point::new(-w / slope * pole_mm, foot);
        let mut ends: Vec<(Point, Vec<LinkId>)> = vec![(at(0.0), vec![maker.scene.ground])];
        for l in links.into_iter().filter(|l| *l != maker.scene.ground) {
            let p = at(self.rate(l));
            match ends.iter_mut().find(|e| e.0.distance(p) < ZERO_MM) {
                Some(e) => e.1.push(l),
                None => ends.push((p, vec![l])),
            }
        }
        let axis = Shape::Line {
            from: Point::new(a - BEYOND_MM, foot),
            to: Point::new(b + BEYOND_MM, foot),
            stroke: style.outline,
        };
        let begun = (!self.order.is_empty()).then(|| self.order.len() + 1);
        d.at_step(begun);
        d.shape("rates", "line", axis);
        for (end, who) in &ends {
            d.at_step(who.iter().filter_map(|l| self.rate_step(*l)).min().or(begun));
            let names: Vec<&str> = who.iter().map(|l| maker.scene.link_name(*l)).collect();
            d.shape(
                &format!("rate-{}", names[0]),
                "ray",
                Shape::Line { from: pole, to: *end, stroke: style.thin },
            );
            d.draw(&format!("end-{}", names[0]), "point", sym::dot(style, *end));
            let text = names.iter().map(|n| name_label(n)).collect::<Vec<_>>().join(", ");
            d.label_at(
                &format!("rate-{}", names[0]),
                "number",
                &text,
                *end,
                style.dot_radius_mm,
                Some(Vec2::new(0.0, -1.0)),
            );
        }
        for (end, who) in ends.iter().filter(|e| e.0.x.abs() > ZERO_MM) {
            let from = Point::new(0.0, foot);
            d.at_step(who.iter().filter_map(|l| self.rate_step(*l)).min());
            let shape = Shape::Arrow { from, to: *end, stroke: style.vector, head: style.head };
            let id = format!("omega-{}", maker.scene.link_name(who[0]));
            let owner = d.shape(&id, "vector", shape);
            let text = omega(maker.scene, who[0]);
            d.label_along(&id, "vector", &text, (from, *end), style.vector.width_mm / 2.0, owner);
        }
        d.at_step(begun);
        d.draw("pole", "pole", sym::dot(style, pole));
        d.label_at("pole", "pole", "P", pole, style.dot_radius_mm, Some(Vec2::new(1.0, 0.5)));
        slope / pole_mm
    }

    /// Willis' table, with its results below.
    fn table(&self) -> DrawingPart {
        let (maker, style, lang) = (self.maker, &self.maker.options.style, self.maker.options.lang);
        let table = table(maker.scene, self.train, self.turns, lang, maker.options.digits);
        let cell = |label: Label, size_mm: f64, anchor: Anchor, id: String| {
            Some(Cell {
                label: label.in_fonts(&style.fonts),
                size_mm,
                anchor,
                class: "willis table".into(),
                id,
            })
        };
        let heading = Label::text(lang.pick(TABLE));
        let shape = Shape::Label {
            at: Point::ORIGIN,
            label: heading.in_fonts(&style.fonts),
            size_mm: style.caption_mm,
            anchor: Anchor::Start,
            colour: hodograph_paper::paper::item::Colour::BLACK,
        };
        let mut items = vec![FigureItem::new("willis heading", shape).with_id("willis-heading")];
        let head = std::iter::once(None).chain(table.head.iter().enumerate().map(|(k, h)| {
            cell(Label::math(h), style.label_mm, Anchor::Middle, format!("willis-head-{k}"))
        }));
        let mut rows = vec![Row { cells: head.collect(), height_mm: ROW_MM + 1.0 }];
        for (r, (words, cells)) in table.rows.iter().enumerate() {
            let first = cell(
                Phrase::new(words).label(),
                style.caption_mm,
                Anchor::Start,
                format!("willis-{r}"),
            );
            let rest = cells.iter().enumerate().map(|(k, c)| {
                cell(Label::math(c), style.caption_mm, Anchor::Middle, format!("willis-{r}-{k}"))
            });
            rows.push(Row {
                cells: std::iter::once(first).chain(rest).collect(),
                height_mm: ROW_MM,
            });
        }
        items.extend(grid::set(&rows, GAP_MM));
        let mut y = -(ROW_MM * (rows.len() as f64 + 1.0) + 2.0);
        let mut with = format!("x = {}", self.rate_text(self.turns.first));
        if self.train.arm != maker.scene.ground {
            with = format!("{with},\\quad y = {}", self.rate_text(self.turns.arm));
        }
        for (k, line) in std::iter::once(&with).chain(&table.results).enumerate() {
            let label = Label::math(line).in_fonts(&style.fonts);
            let shape = Shape::Label {
                at: Point::new(0.0, y),
                label,
                size_mm: style.label_mm,
                anchor: Anchor::Start,
                colour: hodograph_paper::paper::item::Colour::BLACK,
            };
            items.push(
                FigureItem::new("willis result", shape).with_id(format!("willis-result-{k}")),
            );
            y -= ROW_MM;
        }
        DrawingPart::of(items)
    }

    fn rate_text(&self, rate: f64) -> String {
        let book = &self.maker.scene.book;
        book.label(Kind::Omega, &number(book.value(Kind::Omega, rate), self.maker.options.digits))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sheet::SheetOptions;
    use hodograph_scene::{Lang, read};
    use hodograph_worked::certified::certify;
    use hodograph_worked::worked::{Scope, work};

    const TRAIN: &str = r#"{"units": {"length": "mm", "angle": "deg"}, "ground": "1",
        "links": {"1": ["O"], "2": ["O", "Q"], "3": ["Q"], "4": ["O"]}, "points": {"O": [0, 0], "Q": [36, 48]},
        "gears": [{"links": ["1", "3"], "centres": ["O", "Q"], "teeth": [75, 45], "at": "K"},
                  {"links": ["3", "4"], "centres": ["Q", "O"], "teeth": [90, 30], "at": "E"}],
        "driver": {"link": "2", "omega": "-100 rpm"}, "find": ["omega_3", "omega_4"]}"#;

    #[test]
    fn rays_meet_where_pitch_circles_touch() {
        let scene = read(TRAIN).unwrap().value;
        let worked = work(&scene, Scope::Questions).unwrap().value;
        let options = SheetOptions::of_language(Lang::En);
        let maker = SheetDrafter {
            scene: &scene,
            worked: &worked,
            options: &options,
            certified: certify(&scene, &worked, 4),
        };
        let all = trains(&scene);
        let plan = KutzbachPlan {
            maker: &maker,
            train: &all[0],
            turns: turns(&scene, &worked, &all[0]).unwrap(),
            order: Vec::new(),
        };
        let stations = plan.stations().unwrap();
        assert_eq!(stations.len(), 4);
        let largest = stations
            .iter()
            .flat_map(|s| s.links.iter().map(|l| plan.speed(&stations, *l, s.s).abs()))
            .fold(0.0, f64::max);
        for s in &stations {
            let speeds: Vec<f64> = s.links.iter().map(|l| plan.speed(&stations, *l, s.s)).collect();
            assert!(
                s.links.len() > 1 && speeds.iter().all(|v| (v - speeds[0]).abs() < 1e-12 * largest),
                "{}: {speeds:?}",
                s.name
            );
        }
    }

    #[test]
    fn both_languages_have_table_and_plan_and_a_linkage_has_none() {
        let scene = read(TRAIN).unwrap().value;
        let worked = work(&scene, Scope::Questions).unwrap().value;
        for lang in [Lang::En, Lang::Zh] {
            let options = SheetOptions::of_language(lang);
            let maker = SheetDrafter {
                scene: &scene,
                worked: &worked,
                options: &options,
                certified: certify(&scene, &worked, 4),
            };
            let pages = plans(&maker);
            assert_eq!(pages.len(), 1);
            let items = &pages[0].1.items;
            for part in ["kutzbach-ray-4", "kutzbach-rate-4", "willis-0-3", "willis-result-2"] {
                assert!(items.iter().any(|i| i.id == part), "{part}");
            }
            assert!(items.iter().all(FigureItem::is_finite));
        }
        let scene = read(hodograph_scene::templates::get("crank-rocker").unwrap()).unwrap().value;
        let worked = work(&scene, Scope::Questions).unwrap().value;
        let options = SheetOptions::of_language(Lang::En);
        let maker = SheetDrafter {
            scene: &scene,
            worked: &worked,
            options: &options,
            certified: certify(&scene, &worked, 4),
        };
        assert!(plans(&maker).is_empty());
    }
}
