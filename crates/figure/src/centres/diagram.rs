//! The mechanism with its centres: dots, the lines that find them, and arrows to centres off the
//! paper.

use crate::list::FigureInput;
use crate::mechanism;
use hodograph_base::geom::{Point, Vec2};
use hodograph_board::plan::names::name_label;
use hodograph_mechanism::position::Path;
use hodograph_methods::centres::{Centre, CentreMethod, CentrePlace, Centres, Primary};
use hodograph_paper::paper::drawing::{Drawing, DrawingPart};
use hodograph_paper::paper::extent::Rect;
use hodograph_paper::paper::item::{Colour, Dash, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_paper::paper::shown::ShownQuantity;
use hodograph_paper::paper::symbols as sym;

use super::rays::{CentrePaper, CentrePlate, CentreRay, CentreSpot, clipped, holds};
use super::symbol;

/// Distance around the mechanism within which centres are drawn in place: half the height of an A4
/// page.
const REACH_MM: f64 = 85.0;
/// Margin around the outermost centre, so that lines visibly pass through it.
const EDGE_MM: f64 = 6.0;
/// Centres closer than this share one dot and one label.
const SAME_MM: f64 = 0.6;
/// Position of the name of a centre off the paper, as a part of the line behind its last centre.
const LAST_PART: f64 = 0.7;
/// Length of the arrow to a centre at infinity that no line leads to.
const ARROW_MM: f64 = 16.0;
/// Length of the longer of two velocities whose normals give a centre.
const VELOCITY_MM: f64 = 16.0;
/// Colour of lines in the background of the mechanism.
const LINES: Colour = Colour::grey(120);

/// Draws the mechanism with the centres of a plate.
pub fn part(w: &FigureInput, found: &Centres, plate: &CentrePlate) -> DrawingPart {
    drawn(w, found, plate, REACH_MM, false)
}

/// Draws the mechanism with all centres within `reach_mm` around it; each item of a centre has the
/// centre's place in the order of finding as its step.
pub fn stepped(w: &FigureInput, found: &Centres, reach_mm: f64) -> DrawingPart {
    drawn(w, found, &CentrePlate::default(), reach_mm, true)
}

fn drawn(
    w: &FigureInput,
    found: &Centres,
    plate: &CentrePlate,
    reach_mm: f64,
    stepped: bool,
) -> DrawingPart {
    let (style, scene) = (&w.options.style, w.scene);
    let diagram = &w.worked.construction.diagram;
    let to_paper = |p: Point| ((p - diagram.origin) * (1.0 / diagram.mu)).to_point();
    let mut d = mechanism::numbered(style, scene, w.worked, &w.options.notation);
    let lines = d.bounds();
    let window = window(found, plate, (lines, reach_mm), &to_paper);
    let paper = CentrePaper { found, to_paper: &to_paper, window };
    let mut over = CentreOverlay {
        w,
        found,
        paper: &paper,
        d: &mut d,
        plate,
        stepped,
        labelled: vec![false; found.list.len()],
    };
    over.lines();
    over.normals();
    over.spots();
    over.far();
    d.finish()
}

/// The part of the paper that is used: the mechanism, and all centres near it.
fn window(
    found: &Centres,
    plate: &CentrePlate,
    (lines, reach_mm): (Rect, f64),
    to_paper: &dyn Fn(Point) -> Point,
) -> Rect {
    let reach = lines.grown(reach_mm);
    let shown =
        found.list.iter().enumerate().filter(|(k, _)| plate.shows(found, *k)).map(|(_, c)| c);
    let near = shown.filter_map(|c| Some(to_paper(c.place?.point()?))).filter(|p| holds(reach, *p));
    near.fold(lines, |all, p| all.union(Rect::new(p, p))).grown(EDGE_MM)
}

struct CentreOverlay<'a, 'b> {
    w: &'a FigureInput<'a>,
    found: &'a Centres,
    paper: &'a CentrePaper<'a>,
    d: &'b mut Drawing,
    plate: &'a CentrePlate,
    /// True if the class of an item names the step that draws it.
    stepped: bool,
    /// For each centre, true if it has its label.
    labelled: Vec<bool>,
}

impl CentreOverlay<'_, '_> {
    /// The class of an item drawn for a centre.
    fn class(&self, word: &str, k: usize) -> String {
        if self.stepped { format!("{word} step-{k}") } else { word.to_owned() }
    }

    /// Draws the lines behind the mechanism.
    fn lines(&mut self) {
        let rays = self.paper.rays(self.plate);
        let thin = self.w.options.style.thin.coloured(LINES);
        let mut owners = Vec::new();
        let classes: Vec<String> = rays
            .iter()
            .map(|ray| self.class(if ray.normal { "centre normal" } else { "centre line" }, ray.by))
            .collect();
        self.d.behind(|d| {
            for (ray, class) in rays.iter().zip(&classes) {
                let stroke = if ray.normal { thin.dashed(Dash::DashDot) } else { thin };
                owners.push(d.shape(
                    "kennedy",
                    class,
                    Shape::Line { from: ray.from, to: ray.to, stroke },
                ));
            }
        });
        for (ray, owner) in rays.iter().zip(owners) {
            self.arrows(ray, owner);
        }
    }

    /// Draws the step that reopens a stalled closure: two velocities of a link, and their
    /// normals, which cross in the centre.
    fn normals(&mut self) {
        let style = &self.w.options.style;
        let thin = style.thin.coloured(LINES).dashed(Dash::DashDot);
        for (k, c) in self.found.list.iter().enumerate().filter(|(k, _)| self.plate.finds(*k)) {
            let (normal, velocity) =
                (self.class("centre normal", k), self.class("centre velocity", k));
            let (Some(two), Some(CentreSpot::On(centre))) =
                (self.found.normals(c), self.paper.spot(c))
            else {
                continue;
            };
            let longest = two.iter().map(|n| n.velocity.norm()).fold(0.0, f64::max);
            for n in two {
                let at = (self.paper.to_paper)(n.at);
                self.d.behind(|d| {
                    d.shape(
                        &format!("normal-{}", self.w.scene.point_name(n.point)),
                        &normal,
                        Shape::Line { from: at, to: centre, stroke: thin },
                    );
                });
                let (tip, name) = (
                    at + n.velocity * (VELOCITY_MM / longest),
                    name_label(self.w.scene.point_name(n.point)),
                );
                let stroke = style.vector;
                let arrow = Shape::Arrow { from: at, to: tip, stroke, head: style.head };
                let (point, mu) = (self.w.scene.point_name(n.point), longest / VELOCITY_MM);
                let (key, shown) = (
                    format!("vel-abs-{point}"),
                    ShownQuantity::vector(format!("v_{point}"), at, tip, mu),
                );
                let owner = self.d.vector(&key, &velocity, arrow, shown);
                let request = LabelRequest::along(
                    Label::math(format!("v_{{{name}}}")),
                    style.small_mm,
                    at,
                    tip,
                    stroke.width_mm / 2.0,
                );
                self.d.label(&key, &velocity, request.owned(owner));
            }
        }
    }

    /// Draws the arrows at the edge of the paper and names each centre once.
    fn arrows(&mut self, ray: &CentreRay, owner: u32) {
        for a in &ray.arrows {
            // The name is at the end of the line, behind its last centre.
            let back = a.last - a.tip;
            let Some(along) = back.unit() else { continue };
            let base = a.tip + along * ARROW_MM.min(LAST_PART * back.norm());
            self.arrow((a.to, a.to.max(ray.by)), a.from, [base, a.tip], owner);
        }
    }

    /// Draws the arrowhead at the edge, with the name of its centre and the step that draws it.
    /// With an `owner` the line is already drawn; without one the arrow has its own shaft.
    fn arrow(
        &mut self,
        (k, step): (usize, usize),
        measured: Option<usize>,
        [base, to]: [Point; 2],
        owner: u32,
    ) {
        let class = self.class("centre far", step);
        let style = &self.w.options.style;
        let c = &self.found.list[k];
        let name = c.step.pair.name(self.w.scene);
        let stroke = style.thin.coloured(LINES);
        let along = (to - base).unit().unwrap_or(Vec2::ZERO);
        // A shaft over the line would make the line darker.
        let from = if owner > 0 { to - along * style.thin_head.length_mm * 1.5 } else { base };
        self.d.shape(
            &format!("to-{name}"),
            &class,
            Shape::Arrow { from, to, stroke, head: style.thin_head },
        );
        let again = std::mem::replace(&mut self.labelled[k], true);
        let label = self.far_label(c, measured.filter(|_| !again));
        let request = LabelRequest::along(label, style.small_mm, base, to, stroke.width_mm / 2.0);
        self.d.label(&name, &class, request.owned(owner).optional(again));
    }

    /// `P_{12}P_{13} = 6.83 m`: the distance from another centre on the line. A centre at infinity
    /// has the infinity sign.
    fn far_label(&self, c: &Centre, measured: Option<usize>) -> Label {
        let symbol = symbol(self.w.scene, c.step.pair);
        let from =
            measured.and_then(|k| Some((&self.found.list[k], self.found.list[k].place?.point()?)));
        match (c.place, from) {
            (Some(CentrePlace::Infinity(_)), _) => Label::math(format!("{symbol}^{{\\infty}}")),
            (Some(CentrePlace::At(p)), Some((other, from))) => {
                // Space at both ends: without it the distance would run together with a link number
                // beside it.
                let air = || Label::math("\\,\\,");
                let other = self::symbol(self.w.scene, other.step.pair);
                air()
                    .then(Label::math(format!("{other}{symbol} = ")))
                    .then(Label::text(self.w.scene.length_words(p.distance(from))))
                    .then(air())
            }
            (Some(CentrePlace::At(_)) | None, _) => Label::math(symbol),
        }
    }

    /// Draws the dots and names of the centres on the paper; centres at one place share them.
    fn spots(&mut self) {
        let style = &self.w.options.style;
        let mut places: Vec<(Point, Vec<usize>)> = Vec::new();
        for (k, c) in self.found.list.iter().enumerate() {
            let Some(CentreSpot::On(at)) =
                self.paper.spot(c).filter(|_| self.plate.shows(self.found, k))
            else {
                continue;
            };
            match places.iter_mut().find(|(p, _)| p.distance(at) < SAME_MM) {
                Some((_, members)) => members.push(k),
                None => places.push((at, vec![k])),
            }
        }
        for (at, members) in places {
            let of = |k: &usize| &self.found.list[*k];
            let joint = members
                .iter()
                .any(|k| matches!(of(k).step.how, CentreMethod::Primary(Primary::Pin(_))));
            let measured = members.iter().any(|k| of(k).step.how == CentreMethod::Velocities);
            let names: Vec<String> =
                members.iter().map(|k| symbol(self.w.scene, of(k).step.pair)).collect();
            let name = of(&members[0]).step.pair.name(self.w.scene);
            let clear = if joint { style.pin_radius_mm } else { style.dot_radius_mm };
            let first = members[0];
            let class = self.class("centre", first);
            if !joint {
                // A centre found on an earlier plate is given here.
                let new = members.iter().any(|k| self.plate.finds(*k));
                if new {
                    self.d.draw(&name, &class, sym::dot(style, at));
                } else {
                    let dot = Shape::Circle {
                        centre: at,
                        radius_mm: style.dot_radius_mm,
                        stroke: None,
                        fill: Some(LINES),
                    };
                    self.d.shape(&name, "centre known", dot);
                }
            }
            if measured {
                // A ring marks a centre that no lines find.
                let ring = Shape::Circle {
                    centre: at,
                    radius_mm: 2.0 * style.dot_radius_mm,
                    stroke: Some(style.thin),
                    fill: None,
                };
                self.d.shape(&format!("{name}-ring"), &class, ring);
            }
            let clear = if measured { 2.0 * style.dot_radius_mm } else { clear };
            let request =
                LabelRequest::at_point(Label::math(names.join(", ")), style.small_mm, at, clear);
            self.d.label(&name, &class, request);
            members.iter().for_each(|k| self.labelled[*k] = true);
        }
    }

    /// Draws arrows to the centres not yet named by a line; a primary centre at infinity is drawn
    /// at its slider.
    fn far(&mut self) {
        for k in 0..self.found.list.len() {
            let c = &self.found.list[k];
            if self.labelled[k] || !self.plate.shows(self.found, k) {
                continue;
            }
            let Some(spot) = self.paper.spot(c) else { continue };
            let at = self
                .anchor(c)
                .filter(|p| holds(self.paper.window, *p))
                .unwrap_or(self.paper.window.centre());
            let (from, to) = match spot {
                CentreSpot::Infinite(u) => {
                    let up = if u.y >= 0.0 { u } else { -u };
                    (at, at + up * ARROW_MM)
                }
                CentreSpot::On(p) | CentreSpot::Off(p) => match self.to_edge(at, p) {
                    Some(edge) => edge,
                    None => continue,
                },
            };
            self.arrow((k, k), None, [from, to], 0);
        }
    }

    /// The last piece of the line to a point, up to the edge of the paper.
    fn to_edge(&self, at: Point, p: Point) -> Option<(Point, Point)> {
        let along: Vec2 = (p - at).unit()?;
        let [_, high] = clipped(self.paper.window, at, along)?;
        Some((at + along * (high - ARROW_MM).max(0.0), at + along * high))
    }

    /// Position of the slider (or other pair) of a primary centre.
    fn anchor(&self, c: &Centre) -> Option<Point> {
        let configuration = &self.found.worked.configuration;
        let at = match c.step.how {
            CentreMethod::Primary(Primary::Slide(g)) => {
                match (self.w.scene.guides[g.0].pin, configuration.guides[g.0]?) {
                    (Some(pin), _) => configuration.points[pin.0]?,
                    (None, Path::Line { through, .. }) => through,
                    (None, Path::Arc { centre, .. }) => centre,
                }
            }
            CentreMethod::Primary(Primary::Cylinder(d)) => {
                let [a, b] =
                    self.w.scene.drivers[d].kind.ends()?.map(|p| configuration.points[p.0]);
                a? + (b? - a?) * 0.5
            }
            CentreMethod::Primary(Primary::Pin(p)) => configuration.points[p.0]?,
            CentreMethod::Primary(Primary::Strand(r)) => {
                configuration.points[self.w.scene.rolling[r.0].round()?[0].0]?
            }
            CentreMethod::Primary(Primary::Contact(r)) => {
                configuration.points[self.w.scene.rolling[r.0].at[0].0]?
            }
            CentreMethod::Lines(_) | CentreMethod::Velocities => return None,
        };
        Some((self.paper.to_paper)(at))
    }
}
