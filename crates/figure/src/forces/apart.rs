//! Draws the links of a group apart, with the forces and couples on them and the arms of the
//! moments.

use super::ForcePage;
use crate::mechanism::{self, special::REACH};
use hodograph_base::geom::{Point, Vec2};
use hodograph_board::construction::{MarkId, Op};
use hodograph_board::equilibrium::{
    About, Act, ForceEdge, ForceTerm, GroupForces, MomentResult, Moments,
    ReactionComponent as Which,
};
use hodograph_mechanism::force::Cause;
use hodograph_paper::paper::drawing::Drawing;
use hodograph_paper::paper::item::{Colour, Dash, FigureItem, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_paper::paper::style::Style;
use hodograph_paper::paper::symbols;
use hodograph_scene::{Friction, Guide, GuidePath, LinkId, PointId, Rub};

/// Arrow lengths of the smallest and the largest force.
const ARROW_MM: [f64; 2] = [9.0, 22.0];
/// A force below this part of the largest one is not drawn.
const NO_FORCE: f64 = 1e-9;
/// Radius of the bent arrow of a couple.
const COUPLE_MM: f64 = 6.0;
/// A shorter arm has no space for its dimension.
const SHORTEST_ARM_MM: f64 = 3.0;
/// Distance of a guide's force from its pin beyond which it is drawn at the pin, with its couple.
const FARTHEST_MM: f64 = 45.0;
/// Colour of the links in the background of the forces.
const LINKS: Colour = Colour::grey(150);

impl ForcePage<'_> {
    pub(super) fn apart(&self, group: &GroupForces) -> Drawing {
        let maker = self.maker;
        let style = Style { link: self.style().link.coloured(LINKS), ..self.style().clone() };
        let mut d = mechanism::links(
            &style,
            maker.scene,
            maker.worked,
            &maker.options.notation,
            &group.links,
        );
        let largest = group
            .sides
            .iter()
            .filter_map(|s| self.of.force(s.vector))
            .map(Vec2::norm)
            .fold(0.0, f64::max);
        let before: Vec<(usize, &Moments)> = group
            .moments
            .iter()
            .enumerate()
            .filter(|(_, m)| !matches!(m.gives, MomentResult::Offset(_)))
            .collect();
        for (k, (index, moments)) in before.iter().enumerate() {
            // A force has one arm in the drawing, with the first moment equation that contains it.
            let has_arm = |term: ForceTerm| {
                before[..k].iter().any(|(_, m)| m.of.iter().any(|(own, ..)| *own == term))
            };
            let step = self.step(group, |act| *act == Act::Moments(*index));
            self.arms(&mut d, moments, has_arm, &step);
        }
        // Both components of a reaction are drawn where they are found.
        let own = |s: &&ForceEdge| match s.term {
            ForceTerm::Load(k) => group.links.contains(&self.of.loads[k].link),
            // The path of a wheel presses on the link that carries the wheel's centre.
            ForceTerm::Reaction { of, .. } => {
                !matches!(of, hodograph_board::equilibrium::Party::Link(l) if group.links.contains(&l))
            }
        };
        for side in group.sides.iter().filter(own) {
            self.side(&mut d, side, largest, &self.known_at(group, side));
        }
        for (k, load) in self
            .of
            .loads
            .iter()
            .enumerate()
            .filter(|(_, l)| group.links.contains(&l.link) && l.wrench.couple != 0.0)
        {
            if let Cause::Friction(friction) = load.cause {
                self.friction(&mut d, group, (k, friction));
                continue;
            }
            let centre = load.at.or_else(|| maker.scene.links[load.link.0].points.first().copied());
            self.couple(&mut d, k, centre, load.wrench.couple);
        }
        for (index, m) in group.moments.iter().enumerate() {
            if let MomentResult::Driver(driver) = m.gives {
                let value = self.of.drawn.number(m.value).unwrap_or(0.0);
                let rubs = |f: &Friction| matches!(f.at, Rub::Pin { point, .. } if About::Point(point) == m.about);
                let radius_mm =
                    COUPLE_MM + if maker.scene.loads.friction.iter().any(rubs) { 3.0 } else { 0.0 };
                if let About::Point(about) = m.about {
                    let symbol = self.w.balance(driver);
                    let id = symbol.replace(['{', '}'], "").replace('_', "-");
                    let class =
                        format!("couple{}", self.step(group, |act| *act == Act::Moments(index)));
                    self.bent(&mut d, (&id, &class), &symbol, (about, radius_mm), value);
                }
            }
        }
        d
    }

    /// The class of the step after which a force is known: its moment equation, or its measurement.
    /// Loads and the reactions of earlier groups are known from the start.
    fn known_at(&self, group: &GroupForces, side: &ForceEdge) -> String {
        self.step(group, |act| match act {
            Act::Moments(k) => {
                matches!(group.moments[*k].gives, MomentResult::Force(term, _) | MomentResult::Trial { force: term, .. } if term == side.term)
            }
            Act::Read(own) => own.vector == side.vector,
            Act::Free | Act::Friction | Act::Lay(_) | Act::Cross(_) => false,
        })
    }

    /// Position of a point of the mechanism on paper.
    pub(super) fn place(&self, p: PointId) -> Option<Point> {
        let worked = self.maker.worked;
        let diagram = &worked.construction.diagram;
        Some(((worked.configuration.points[p.0]? - diagram.origin) * (1.0 / diagram.mu)).to_point())
    }

    /// The point at which a force of a guide acts, at distance h from its pin; or the pin and the
    /// couple about it if that distance is too large.
    fn on_line(&self, side: &ForceEdge) -> Option<(Point, f64)> {
        let at = self.place(side.at)?;
        let at_point = Some((at, 0.0));
        let scene = self.maker.scene;
        let ForceTerm::Reaction { of: hodograph_board::equilibrium::Party::Link(by), on, .. } =
            side.term
        else {
            return at_point;
        };
        let joins = |g: &Guide| {
            let straight = matches!(g.path, GuidePath::Line { .. });
            straight && g.slider.is_some_and(|s| [s, g.on] == [on, by] || [s, g.on] == [by, on])
        };
        let Some(guide) = scene.guides.iter().position(joins) else { return at_point };
        let Some((_, w)) = self.of.forces.guides.iter().find(|(g, _)| g.0 == guide) else {
            return at_point;
        };
        let Some(n) = w.force.unit() else { return at_point };
        // r with r × F = M, along the guide.
        let offset = n.perp() * -(w.couple / w.force.norm());
        let offset_mm = offset * (1.0 / self.maker.worked.construction.diagram.mu);
        let couple = if scene.guides[guide].slider == Some(on) { w.couple } else { -w.couple };
        Some(if offset_mm.norm() > FARTHEST_MM { (at, couple) } else { (at + offset_mm, 0.0) })
    }

    fn side(&self, d: &mut Drawing, side: &ForceEdge, largest: f64, step: &str) {
        let (Some((at, couple)), Some(force)) = (self.on_line(side), self.of.force(side.vector))
        else {
            return;
        };
        if force.norm() <= NO_FORCE * largest {
            return;
        }
        if couple != 0.0 {
            let symbol = self.w.symbol(side.term).replacen('F', "M", 1);
            self.bent(
                d,
                (&format!("of-{}", self.key(side.term)), &format!("couple{step}")),
                &symbol,
                (side.at, COUPLE_MM),
                couple,
            );
        }
        self.force(d, (side.term, &format!("force{step}")), at, force, largest);
    }

    /// Draws a force at a point, as an arrow with a length that grows with its part of the largest
    /// force.
    pub(super) fn force(
        &self,
        d: &mut Drawing,
        (term, class): (ForceTerm, &str),
        at: Point,
        force: Vec2,
        largest: f64,
    ) {
        let style = self.style();
        let (size, Some(u)) = (force.norm(), force.unit()) else { return };
        if size <= NO_FORCE * largest {
            return;
        }
        let length = ARROW_MM[0] + (ARROW_MM[1] - ARROW_MM[0]) * (size / largest).sqrt();
        let stroke = self.stroke(term);
        let arrow = |from: Point, to: Point| Shape::Arrow { from, to, stroke, head: style.head };
        // The arrow ends at its point (pushing), or starts there (pulling) if it then covers less
        // of the drawing.
        let (pressing, pulling) =
            ([at - u * (length + 1.0), at - u], [at + u, at + u * (length + 1.0)]);
        let met = |ends: [Point; 2]| d.met_by(&[FigureItem::new("", arrow(ends[0], ends[1]))], 1.0);
        let presses = met(pressing) <= met(pulling);
        let [from, to] = if presses { pressing } else { pulling };
        let class = &if presses { class.to_owned() } else { format!("{class} pulling") };
        let key = self.key(term);
        let owner = d.shape(&format!("force-{key}"), class, arrow(from, to));
        let request = LabelRequest::along(
            Label::math(self.w.symbol(term)),
            style.label_mm,
            from,
            to,
            stroke.width_mm / 2.0,
        );
        d.label(&format!("force-{key}"), class, request.owned(owner));
    }

    pub(super) fn couple(&self, d: &mut Drawing, load: usize, at: Option<PointId>, value: f64) {
        let symbol = self.w.couple_of(load);
        if let Some(at) = at {
            self.bent(
                d,
                (&format!("of-{}", self.key(ForceTerm::Load(load))), "couple"),
                &symbol,
                (at, COUPLE_MM),
                value,
            );
        }
    }

    /// Draws the friction circle of a pin, with the couple if the other link is not in the group.
    fn friction(&self, d: &mut Drawing, group: &GroupForces, (load, friction): (usize, usize)) {
        let scene = self.maker.scene;
        let Rub::Pin { point, circle, .. } = &scene.loads.friction[friction].at else { return };
        let Some(centre) = self.place(*point) else { return };
        let links: Vec<LinkId> =
            scene.carriers(*point).filter(|l| group.links.contains(l)).collect();
        let name = self.maker.scene.point_name(*point);
        if links.first() == Some(&self.of.loads[load].link) {
            let radius_mm = circle.value / self.maker.worked.construction.diagram.mu;
            let stroke = self.style().thin.dashed(Dash::Dashed);
            d.shape(
                &format!("friction-{name}"),
                "friction",
                Shape::Circle { centre, radius_mm, stroke: Some(stroke), fill: None },
            );
        }
        if links.len() == 1 {
            self.couple(d, load, Some(*point), self.of.loads[load].wrench.couple);
        }
    }

    /// Draws a bent arrow about a point, counter-clockwise for a positive value.
    fn bent(
        &self,
        d: &mut Drawing,
        (key, class): (&str, &str),
        symbol: &str,
        (about, radius_mm): (PointId, f64),
        value: f64,
    ) {
        let style = self.style();
        let Some(centre) = self.place(about).filter(|_| value != 0.0) else { return };
        let [from_rad, to_rad] = if value > 0.0 { [-0.6, 2.4] } else { [3.74, 0.74] };
        let stroke = hodograph_paper::paper::item::LineStroke {
            width_mm: style.vector.width_mm * 0.8,
            ..style.vector
        };
        let shape =
            Shape::ArcArrow { centre, radius_mm, from_rad, to_rad, stroke, head: style.head };
        let owner = d.shape(&format!("couple-{key}"), class, shape);
        let tip = centre + Vec2::from_angle(0.5 * (from_rad + to_rad)) * radius_mm;
        let request = LabelRequest::at_point(Label::math(symbol), style.label_mm, tip, 0.6);
        d.label(&format!("couple-{key}"), class, request.owned(owner));
    }

    /// Draws the intersection of two lines of action and the lines; `None` if it is too far away.
    fn crossing(
        &self,
        d: &mut Drawing,
        moments: &Moments,
        at: MarkId,
        step: &str,
    ) -> Option<Point> {
        let style = self.style();
        let centre = self.of.drawn.marks[at.index()]?;
        let c = &self.of.construction;
        let met = c.ops.iter().find_map(|op| match op {
            Op::Meet { lines, to } if *to == at => Some(lines),
            _ => None,
        })?;
        let scene = self.maker.scene;
        let placed = || {
            moments
                .links
                .iter()
                .flat_map(|l| &scene.links[l.0].points)
                .filter_map(|p| self.place(*p))
        };
        let size = placed().flat_map(|p| placed().map(move |q| p.distance(q))).fold(0.0, f64::max);
        if placed().all(|p| p.distance(centre) > REACH * size) {
            return None;
        }
        for line in met {
            let from = self.of.drawn.marks[c.lines[line.index()].through.index()]?;
            d.shape(
                "constraint-line",
                &format!("construction{step}"),
                Shape::Line { from, to: centre, stroke: style.thin.dashed(Dash::DashDot) },
            );
        }
        d.draw("crossing", &format!("special point{step}"), symbols::dot(style, centre));
        let letter = self.w.crossing(at);
        let request = LabelRequest::at_point(
            Label::math(&letter),
            style.label_mm,
            centre,
            style.dot_radius_mm,
        );
        d.label("crossing", &format!("special letter{step}"), request);
        Some(centre)
    }

    /// Draws lines of action with their arms about a point.
    fn arms(
        &self,
        d: &mut Drawing,
        moments: &Moments,
        has_arm: impl Fn(ForceTerm) -> bool,
        step: &str,
    ) {
        let style = self.style();
        let about = match moments.about {
            About::Point(p) => self.place(p),
            About::Crossing { at, .. } => self.crossing(d, moments, at, step),
        };
        let Some(about) = about else { return };
        for (k, (term, at, _)) in moments.of.iter().enumerate() {
            if matches!(term, ForceTerm::Reaction { part: Which::Tangential, .. }) || has_arm(*term)
            {
                continue;
            }
            let (Some(at), Some(arm), Some(u)) =
                (self.place(*at), self.w.arm(moments, k), self.w.direction(*term))
            else {
                continue;
            };
            let foot = at + u * u.dot(about - at);
            if about.distance(foot) < SHORTEST_ARM_MM || arm <= 0.0 {
                continue;
            }
            let line = style.thin.dashed(Dash::DashDot);
            let key = self.key(*term);
            let past = (foot - at).unit().map_or(foot, |v| foot + v * 3.0);
            d.shape(
                &format!("action-{key}"),
                &format!("action{step}"),
                Shape::Line { from: at, to: past, stroke: line },
            );
            let shape =
                Shape::Arrow { from: about, to: foot, stroke: style.thin, head: style.thin_head };
            let owner = d.shape(&format!("arm-{key}"), &format!("arm{step}"), shape);
            let name = self.w.arm_name(*term);
            let request = LabelRequest::along(
                Label::math(name),
                style.small_mm,
                about,
                foot,
                style.thin.width_mm,
            );
            d.label(&format!("arm-{key}"), &format!("arm{step}"), request.owned(owner));
        }
    }
}
