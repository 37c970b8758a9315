//! The problem's side: statement, given, wanted, the mechanism to scale.

use super::{Block, Maker};
use crate::figure::results::symbol;
use crate::figure::sheet::drawing;
use crate::mechanism::Level;
use crate::plan::text::point_label;
use crate::report::phrase::Phrase;
use crate::report::statement::paragraphs;
use crate::scene::{Asked, Axis, Find, Lang, LinkId, OnLink};
use crate::worked::Worked;

impl Maker<'_> {
    pub(super) fn problem(&self, blocks: &mut Vec<Block>) {
        blocks.push(self.heading(1, "Problem", "题目"));
        let stated = paragraphs(self.scene, self.lang());
        match stated.is_empty() {
            false => blocks.extend(stated.into_iter().map(Block::Paragraph)),
            true => blocks.push(self.paragraph(
                "The figure shows a planar mechanism to scale. Solve it by vector polygons.",
                "图示平面机构已按比例画出，试用矢量多边形图解法求解。",
            )),
        }
        blocks.extend(self.given_mechanism());
        blocks.push(self.heading(2, "Given", "已知"));
        blocks.push(Block::List { numbered: false, members: self.given() });
        blocks.push(self.heading(2, "Wanted", "求"));
        blocks.push(Block::List { numbered: false, members: self.wanted() });
    }

    /// What is asked for, in the order of the scene; quantities of one kind share a line.
    fn wanted(&self) -> Vec<Phrase> {
        let colon = self.tr(": ", "：");
        let mut lines: Vec<Vec<&Find>> = Vec::new();
        for f in &self.scene.find {
            let kind = self.kind(&f.what);
            match lines.iter_mut().find(|l| kind.is_some() && self.kind(&l[0].what) == kind) {
                Some(line) => line.push(f),
                None => lines.push(vec![f]),
            }
        }
        let member = |finds: &Vec<&Find>| {
            let symbols: Vec<String> = finds.iter().map(|f| format!("${}$", symbol(f, self.notation()))).collect();
            let words = match (&finds[..], self.kind(&finds[0].what)) {
                ([_, _, ..], Some(kind)) => kind.to_owned(),
                _ => self.asked(&finds[0].what),
            };
            Phrase::new(&format!("{}{colon}{words}", symbols.join(self.words().comma)))
        };
        lines.iter().map(member).collect()
    }

    /// The name of several quantities whose symbols say of what they are.
    fn kind(&self, what: &Asked) -> Option<&'static str> {
        Some(match what {
            Asked::Velocity(OnLink { link: None, .. }) => self.tr("velocities", "各点的速度"),
            Asked::Acceleration(OnLink { link: None, .. }) => self.tr("accelerations", "各点的加速度"),
            Asked::Omega(_) => self.tr("angular velocities of the links", "各构件的角速度"),
            Asked::Alpha(_) => self.tr("angular accelerations of the links", "各构件的角加速度"),
            _ => return None,
        })
    }

    /// The mechanism as it is given: without what the solution finds on it, and described without answers.
    fn given_mechanism(&self) -> Option<Block> {
        let mut bare: Worked = self.worked.clone();
        bare.construction.velocity = None;
        bare.construction.acceleration = None;
        let mut figure = drawing(self.scene, &bare, self.options, Level::Position)?;
        figure.desc = self.words().diagram.into();
        Some(Block::Figure { name: "mechanism", figure: Box::new(figure) })
    }

    /// A wanted quantity in words.
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
        let relative = |en: &str, zh: &str, a: &OnLink, b: &OnLink| {
            // Coincident points are told by their place and the two links.
            let of_link = |p: &OnLink| p.link.map_or(spot(p), |l| format!("{} {}", self.tr("link", "构件"), self.link(l)));
            match (a.point == b.point, self.lang()) {
                (true, Lang::En) => format!("{en} at {}, of {} relative to {}", self.point(a.point), of_link(a), of_link(b)),
                (true, Lang::Zh) => format!("{} 处{} 相对{} 的{zh}", self.point(a.point), of_link(a), of_link(b)),
                (false, Lang::En) => format!("{en} of {} relative to {}", spot(a), spot(b)),
                (false, Lang::Zh) => format!("{} 相对 {} 的{zh}", spot(a), spot(b)),
            }
        };
        let link = |en: &str, zh: &str, l: LinkId| match self.lang() {
            Lang::En => format!("{en} of link {}", self.link(l)),
            Lang::Zh => format!("构件 {} 的{zh}", self.link(l)),
        };
        let against = |en: &str, zh: &str, a: LinkId, b: LinkId| match self.lang() {
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
