//! The solution of a task that asks for instantaneous centres: where the pairs give them, the theorem of three centres for the others, angular
//! velocities and speeds by them.
//!
//! What is asked besides and centres do not tell (accelerations, relative velocities) is solved by polygons behind them.

use super::results::COMPARED;
use super::speak::Speak;
use super::{Block, Maker, Table, TableKind};
use crate::answer::Value;
use crate::centres::{Centre, Centres, How, centres};
use crate::figure::list::{Extras, Wanted, named};
use crate::mechanism::Level;
use crate::paper::phrase::Phrase;
use crate::report::amount::symbol;
use crate::report::centres::Words;
use crate::scene::quantity::Meaning;
use crate::scene::{Asked, Find, Lang, OnLink, Scene};

/// A task that asks for centres.
pub(super) struct Task {
    /// All centres of the mechanism.
    pub found: Centres,
    /// Whether they answer all that is asked of motion.
    pub alone: bool,
}

impl Task {
    /// The centres, where a question of the scene asks for one.
    pub fn of(scene: &Scene) -> Option<Task> {
        scene.find.iter().find(|f| matches!(f.what, Asked::InstantCentre(_)))?;
        let found = centres(scene).ok()?.value;
        let alone = scene.find.iter().all(|f| f.what.level() == Level::Position || tells(&found, scene, f));
        Some(Task { found, alone })
    }
}

/// Whether centres tell what a question asks.
fn tells(found: &Centres, scene: &Scene, find: &Find) -> bool {
    matches!(find.what, Asked::InstantCentre(_)) || by_centres(found, scene, find).is_some()
}

/// What centres answer to a question, a vector by its magnitude.
fn by_centres(found: &Centres, scene: &Scene, find: &Find) -> Option<f64> {
    match find.what.meaning(scene)? {
        _ if find.what.level() != Level::Velocity => None,
        Meaning::Turning(link, None) => found.uses.links.iter().find(|t| t.link == link).map(|t| t.omega),
        Meaning::Vector(OnLink { point, link: None }) => {
            found.uses.points.iter().find(|s| s.point == point).map(|s| s.velocity.norm())
        }
        Meaning::Vector(_) | Meaning::Turning(..) | Meaning::Ratio(..) | Meaning::Relative(..) | Meaning::Seen(..) | Meaning::Place(_) => None,
    }
}

impl Maker<'_> {
    /// The centres, and what they tell.
    pub(super) fn centres(&self, blocks: &mut Vec<Block>, task: &Task) {
        let words = Words::marked(&task.found, self.lang());
        let n = task.found.closure.links.len();
        blocks.push(self.heading(2, "Instantaneous centres", "速度瞬心"));
        let counted = words.counts();
        blocks.push(Block::Paragraph(Phrase::new(&match self.lang() {
            Lang::En => format!("With the ground, $N(N - 1)/2$ centres for $N = {n}$: {counted}."),
            Lang::Zh => format!("包括机架，$N = {n}$，瞬心数为 $N(N - 1)/2$：{counted}。"),
        })));
        let (at_pairs, others): (Vec<_>, Vec<_>) = task.found.list.iter().partition(|c| matches!(c.step.how, How::Primary(_)));
        let list = |all: Vec<&Centre>| all.into_iter().map(|c| words.sentence(c)).collect::<Vec<_>>();
        blocks.push(Block::List { numbered: false, members: list(at_pairs) });
        if !others.is_empty() {
            blocks.push(self.paragraph(
                "The three centres of any three links are collinear: each further centre lies on two such lines.",
                "任意三个构件的三个瞬心共线：其余各瞬心均为两条这样的直线的交点。",
            ));
            blocks.push(Block::List { numbered: true, members: list(others) });
        }
        self.drawn_centres(blocks);
        blocks.push(self.heading(2, "Velocities by the centres", "用瞬心求速度"));
        blocks.push(Block::List { numbered: true, members: words.steps().iter().map(|s| Phrase::new(s)).collect() });
    }

    fn drawn_centres(&self, blocks: &mut Vec<Block>) {
        let wanted = Wanted { scene: self.scene, worked: self.worked, options: self.options, extras: &Extras::default() };
        let pages = named("centres").and_then(|entry| (entry.draw)(&wanted).ok()).map_or_else(Vec::new, |pages| pages.value);
        blocks.extend(pages.into_iter().map(|(_, figure)| Block::Figure { name: "centres", figure: Box::new(figure) }));
    }

    /// The values by centres beside those of the loop equations.
    pub(super) fn compared_centres(&self, blocks: &mut Vec<Block>, task: &Task) {
        let head = [self.tr("quantity", "量"), self.tr("by centres", "瞬心法"), self.tr("loop equations", "解析")];
        let mut rows = vec![head.map(Phrase::new).to_vec()];
        for r in &self.worked.results {
            let find = &self.scene.find[r.find];
            let Some(own) = by_centres(&task.found, self.scene, find) else { continue };
            let computed = r.computed.magnitude().copysign(if matches!(r.computed, Value::Scalar(s) if s < 0.0) { -1.0 } else { 1.0 });
            // What is left of rounding is nothing.
            let told = |si: f64| if si.abs() <= r.noise { "$0$".to_owned() } else { format!("${}$", self.size(find, Value::Scalar(si), COMPARED)) };
            rows.push(vec![
                Phrase::new(&format!("${}$", symbol(find, self.notation()))),
                Phrase::new(&told(own)),
                Phrase::new(&told(computed)),
            ]);
        }
        if rows.len() > 1 {
            blocks.push(Block::Table(Table { kind: TableKind::Values, rows }));
        }
    }
}
