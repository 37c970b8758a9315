//! Zhukovsky's lever: the image points of the loaded points, turned by a right angle, with the
//! loads and their arms about the pole.

use super::ForcePage;
use crate::arrange::{Tree, put_together};
use crate::scales::DrawingScales;
use crate::sheet::{SheetDrafter, SheetOptions};
use hodograph_base::geom::Point;
use hodograph_base::lang::tr;
use hodograph_board::construct::source;
use hodograph_board::equilibrium::{ForceTerm, Lever};
use hodograph_paper::paper::drawing::{Drawing, DrawingPart};
use hodograph_paper::paper::item::{Dash, Figure, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::phrase::Phrase;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_paper::paper::symbols;
use hodograph_scene::{DiagramKind, PointId, Scene};
use hodograph_worked::worked::Worked;

/// Width of the sentences below the lever.
const TEXT_MM: f64 = 150.0;
/// A shorter arm has no space for its dimension.
const SHORTEST_ARM_MM: f64 = 3.0;

/// Returns the loads on the turned velocity polygon; `None` if no forces are drawn or nothing
/// moves.
pub fn zhukovsky(scene: &Scene, worked: &Worked) -> Option<Lever> {
    let of = worked.equilibrium.as_ref()?;
    let mu = worked.construction.polygon(DiagramKind::Velocity).filter(|p| !p.is_empty())?.mu;
    let motion = source(scene, &worked.mechanism, &worked.plan, &worked.construction);
    Lever::of(scene, &worked.configuration, of, &motion, mu)
}

/// Draws the lever with its moments; `None` if no forces are drawn or nothing moves.
pub fn lever(scene: &Scene, worked: &Worked, options: &SheetOptions) -> Option<Figure> {
    let of = worked.equilibrium.as_ref()?;
    let lever = zhukovsky(scene, worked)?;
    let maker = SheetDrafter { scene, worked, options, certified: Vec::new() };
    let page = ForcePage::of(&maker, of);
    let scale = DrawingScales::of(&scene.book, DiagramKind::Velocity, lever.mu);
    let caption = tr!(options.lang, "Zhukovsky's lever: velocities turned clockwise by 90°");
    let drawing =
        maker.titled(page.on_lever(&lever), Phrase::new(caption).label(), &scale, "lever");
    let words = page.text(&page.w.lever(&lever, &page.pole()), "moments", TEXT_MM);
    Some(maker.alone(put_together(
        Tree::column(vec![Tree::Leaf(0), Tree::Leaf(1)]),
        vec![drawing, words],
    )))
}

impl ForcePage<'_> {
    fn pole(&self) -> String {
        self.maker.writer().pole(DiagramKind::Velocity)
    }

    fn on_lever(&self, lever: &Lever) -> DrawingPart {
        let style = self.style();
        let mut d = Drawing::new("lever", style.clone());
        let pole = Point::ORIGIN;
        let mut ends: Vec<(PointId, Point)> = Vec::new();
        for force in &lever.forces {
            let new = ends
                .iter()
                .all(|(p, at)| *p != force.point || at.distance(force.at) > style.dot_radius_mm);
            if new && force.at.distance(pole) > style.dot_radius_mm {
                ends.push((force.point, force.at));
            }
        }
        for (p, at) in &ends {
            d.shape(
                &format!("end-{}", self.maker.scene.point_name(*p)),
                "image",
                Shape::Line { from: pole, to: *at, stroke: style.thin },
            );
        }
        let largest = lever
            .forces
            .iter()
            .map(|f| self.of.loads[f.load].wrench.force.norm())
            .fold(0.0, f64::max);
        for f in &lever.forces {
            let (term, force) = (ForceTerm::Load(f.load), self.of.loads[f.load].wrench.force);
            self.force(&mut d, (term, "force"), f.at, force, largest);
            let Some(u) = force.unit().filter(|_| f.arm_mm >= SHORTEST_ARM_MM) else { continue };
            let foot = f.at + u * u.dot(pole - f.at);
            let key = self.key(term);
            let action =
                Shape::Line { from: f.at, to: foot, stroke: style.thin.dashed(Dash::DashDot) };
            d.shape(&format!("action-{key}"), "action", action);
            let owner = d.shape(
                &format!("arm-{key}"),
                "arm",
                Shape::Arrow { from: pole, to: foot, stroke: style.thin, head: style.thin_head },
            );
            let request = LabelRequest::along(
                Label::math(self.w.arm_name(term)),
                style.small_mm,
                pole,
                foot,
                style.thin.width_mm,
            );
            d.label(&format!("arm-{key}"), "arm", request.owned(owner));
        }
        d.draw("pole", "pole", symbols::dot(style, pole));
        d.label_at("pole", "pole", &self.pole(), pole, style.dot_radius_mm, None);
        for (p, at) in ends {
            let name = self.maker.scene.point_name(p);
            d.draw(&format!("image-{name}"), "image", symbols::dot(style, at));
            d.label_at(
                &format!("image-{name}"),
                "image",
                &self.maker.writer().letter(p),
                at,
                style.dot_radius_mm,
                None,
            );
        }
        d.finish()
    }
}
