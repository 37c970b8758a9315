//! The problem's side: statement, given, wanted, the mechanism to scale.

use super::{Block, Maker};
use crate::figure::results::symbol;
use crate::figure::sheet::{Single, single};
use crate::plan::text::point_label;
use crate::report::phrase::Phrase;
use crate::scene::{Asked, Axis, Lang, OnLink};
use crate::worked::Worked;

impl Maker<'_> {
    pub(super) fn problem(&self, blocks: &mut Vec<Block>) {
        blocks.push(self.heading(1, "Problem", "题目"));
        match self.scene.statement.as_ref().map(|s| s.get(self.lang())).filter(|s| !s.is_empty()) {
            Some(words) => blocks.push(Block::Paragraph(Phrase::new(&words.replace('$', "")))),
            None => blocks.push(self.paragraph(
                "The figure shows a planar mechanism to scale. Solve it by vector polygons.",
                "图示平面机构已按比例画出，试用矢量多边形图解法求解。",
            )),
        }
        blocks.push(self.heading(2, "Given", "已知"));
        blocks.push(Block::List { numbered: false, members: self.given() });
        blocks.push(self.heading(2, "Wanted", "求"));
        let members = self.scene.find.iter().map(|f| Phrase::new(&format!("{} ${}$", self.asked(&f.what), symbol(f, self.notation()))));
        blocks.push(Block::List { numbered: false, members: members.collect() });
        blocks.extend(self.given_mechanism());
    }

    /// The mechanism as it is given: without what the solution finds on it, and described without answers.
    fn given_mechanism(&self) -> Option<Block> {
        let mut bare: Worked = self.worked.clone();
        bare.construction.velocity = None;
        bare.construction.acceleration = None;
        let mut figure = single(self.scene, &bare, self.options, Single::Mechanism)?;
        figure.desc = self.words().diagram.into();
        Some(Block::Figure { name: "mechanism", figure: Box::new(figure) })
    }

    /// A wanted quantity in words, before its symbol.
    fn asked(&self, what: &Asked) -> String {
        let spot = |p: &OnLink| match (p.link, self.lang()) {
            (None, _) => self.point(p.point),
            (Some(l), Lang::En) => format!("the point of link {} at {}", self.link(l), self.point(p.point)),
            (Some(l), Lang::Zh) => format!("构件 {} 上与 {} 重合的点", self.link(l), self.point(p.point)),
        };
        let of = |en: &str, zh: &str, p: &OnLink| match self.lang() {
            Lang::En => format!("{en} of {}", spot(p)),
            Lang::Zh => format!("{} 的{zh}", spot(p)),
        };
        let relative = |en: &str, zh: &str, a: &OnLink, b: &OnLink| match self.lang() {
            Lang::En => format!("{en} of {} relative to {}", spot(a), spot(b)),
            Lang::Zh => format!("{} 相对 {} 的{zh}", spot(a), spot(b)),
        };
        let link = |en: &str, zh: &str, l| match self.lang() {
            Lang::En => format!("{en} of link {}", self.link(l)),
            Lang::Zh => format!("构件 {} 的{zh}", self.link(l)),
        };
        let against = |en: &str, zh: &str, a, b| match self.lang() {
            Lang::En => format!("{en} of link {} against link {}", self.link(a), self.link(b)),
            Lang::Zh => format!("构件 {} 相对构件 {} 的{zh}", self.link(a), self.link(b)),
        };
        match what {
            Asked::Coordinate(p, axis) => {
                let axis = if *axis == Axis::X { "x" } else { "y" };
                of(&format!("coordinate ${axis}$"), &format!("坐标 ${axis}$"), &OnLink { point: *p, link: None })
            }
            Asked::Distance(a, b) => {
                let ends = format!("${}{}$", point_label(self.scene.point_name(*a)), point_label(self.scene.point_name(*b)));
                format!("{}{ends}", self.tr("distance ", "距离 "))
            }
            Asked::LinkAngle(l) => link("angle", "位置角", *l),
            Asked::Velocity(p) => of("velocity", "速度", p),
            Asked::Acceleration(p) => of("acceleration", "加速度", p),
            Asked::RelativeVelocity(a, b) => relative("velocity", "速度", a, b),
            Asked::RelativeAcceleration(a, b) => relative("acceleration", "加速度", a, b),
            Asked::NormalAcceleration(a, b) => relative("normal acceleration", "法向加速度", a, b),
            Asked::TangentialAcceleration(a, b) => relative("tangential acceleration", "切向加速度", a, b),
            Asked::SlidingVelocity(a, b) => relative("sliding velocity", "相对滑动速度", a, b),
            Asked::SlidingAcceleration(a, b) => relative("sliding acceleration", "相对滑动加速度", a, b),
            Asked::Coriolis(a, b) => relative("Coriolis acceleration", "科氏加速度", a, b),
            Asked::Omega(l) => link("angular velocity", "角速度", *l),
            Asked::Alpha(l) => link("angular acceleration", "角加速度", *l),
            Asked::RelativeOmega(a, b) => against("angular velocity", "角速度", *a, *b),
            Asked::RelativeAlpha(a, b) => against("angular acceleration", "角加速度", *a, *b),
        }
    }
}
