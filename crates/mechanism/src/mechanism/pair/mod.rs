//! Pairs and drivers as values: one file for each kind, and the list of kinds.
//!
//! Each kind defines its items of the scene, the [`PairForm`] that it demands there, and its name.
//! Everything else follows from the form: the nodes that a constraint joins and its number of
//! equations ([`form`]), the leg that it becomes in a group ([`super::groups`]), its equations of
//! position, motion and sweep. A new pair therefore needs one file here, a line in [`KINDS`], its
//! reading in the scene and its symbol in the figure; only a pair with a new form needs changes in
//! the solvers.

mod belt;
mod cylinder;
mod form;
mod glide;
mod lock;
mod pin;
mod rolling;
mod rope;
mod sliding;
mod slot;
mod turning;

pub use form::{PairForm, Runner};

use super::GraphNode;
use hodograph_base::diag::{Both, Span};
use hodograph_scene::{DriverKind, Guide, GuideId, LinkId, PointId, RollingId, RollingKind, Scene};

/// An item of a scene that constrains: a point on a link, a guide, a driver, a rolling pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PairItem {
    /// A joint, on one of its links.
    Pin(PointId, LinkId),
    /// A guide.
    Guide(GuideId),
    /// A driver (index).
    Driver(usize),
    /// A rolling pair.
    Rolling(RollingId),
}

/// A kind of pair or driver: the form that it demands of an item of this kind, and its name in a
/// message, from the two nodes that it joins.
struct PairKind {
    form: Demands,
    words: fn(&Scene, GraphNode, GraphNode) -> Both,
}

/// The items of a kind, with the form that it demands.
enum Demands {
    Pin(fn(PointId, LinkId) -> Option<PairForm>),
    Guide(fn(GuideId, &Guide) -> Option<PairForm>),
    Driver(DriverForm),
    /// All of them relate rotations, or rotation and sliding, linearly; `told` names the links in a
    /// list of pairs.
    Rolling {
        kind: RollingKind,
        told: fn(&str, &str) -> Both,
    },
}

/// The additional data of a kind of driver: its name as a mover, and the name of the part that it
/// moves.
struct DriverForm {
    form: fn(usize, &DriverKind, &Scene) -> Option<PairForm>,
    mover: fn(&Scene, GraphNode, GraphNode) -> Both,
    moved: fn(&Scene, GraphNode, GraphNode) -> Both,
}

/// All kinds, in the order of the constraints of one item.
const KINDS: &[PairKind] = &[
    pin::PIN,
    slot::SLOT,
    lock::LOCK,
    glide::GLIDE,
    turning::TURNING,
    sliding::SLIDING,
    cylinder::CYLINDER,
    rolling::GEARS,
    rolling::WHEEL,
    belt::BELT,
    belt::CHAIN,
    rope::ROPE,
];

/// One pair or driver, or a part of one, as a constraint between two nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Constraint {
    kind: usize,
    item: PairItem,
    form: PairForm,
}

/// Returns the constraints of an item of a scene.
pub fn constraints_of(scene: &Scene, item: PairItem) -> impl Iterator<Item = Constraint> {
    let demanded = move |kind: &PairKind| match (&kind.form, item) {
        (Demands::Pin(form), PairItem::Pin(p, l)) => form(p, l),
        (Demands::Guide(form), PairItem::Guide(g)) => form(g, &scene.guides[g.0]),
        (Demands::Driver(driver), PairItem::Driver(d)) => {
            (driver.form)(d, &scene.drivers[d].kind, scene)
        }
        (Demands::Rolling { kind, .. }, PairItem::Rolling(pair)) => {
            let of = &scene.rolling[pair.0];
            (of.kind == *kind).then_some(PairForm::Related { pair, links: of.links })
        }
        (Demands::Pin(_) | Demands::Guide(_) | Demands::Driver(_) | Demands::Rolling { .. }, _) => {
            None
        }
    };
    KINDS
        .iter()
        .enumerate()
        .filter_map(move |(kind, k)| Some(Constraint { kind, item, form: demanded(k)? }))
}

/// Returns the name of an item with one constraint.
pub fn words_of(scene: &Scene, item: PairItem) -> Both {
    constraints_of(scene, item).next().map_or_else(|| Both::same(""), |c| c.words(scene))
}

/// Returns the description of a rolling pair in a list of pairs.
pub fn rolling_pair_words(scene: &Scene, pair: RollingId) -> Both {
    let [a, b] = scene.rolling[pair.0].links.map(|l| scene.link_name(l));
    let told = |kind: &PairKind| match kind.form {
        Demands::Rolling { kind, told } if kind == scene.rolling[pair.0].kind => Some(told(a, b)),
        Demands::Pin(_) | Demands::Guide(_) | Demands::Driver(_) | Demands::Rolling { .. } => None,
    };
    KINDS.iter().find_map(told).unwrap_or_else(|| Both::same(""))
}

/// Returns the name of a driver as a mover.
pub fn mover_words(scene: &Scene, driver: usize) -> Both {
    driver_words(scene, driver, |d| d.mover)
}

/// Returns the name of the part that a driver moves.
pub fn moved_words(scene: &Scene, driver: usize) -> Both {
    driver_words(scene, driver, |d| d.moved)
}

fn driver_words(
    scene: &Scene,
    driver: usize,
    words: impl Fn(&DriverForm) -> fn(&Scene, GraphNode, GraphNode) -> Both,
) -> Both {
    let of = |c: Constraint| match &KINDS[c.kind].form {
        Demands::Driver(driver) => Some(words(driver)(scene, c.ends().0, c.ends().1)),
        Demands::Pin(_) | Demands::Guide(_) | Demands::Rolling { .. } => None,
    };
    constraints_of(scene, PairItem::Driver(driver)).find_map(of).unwrap_or_else(|| Both::same(""))
}

impl Constraint {
    /// Returns the form.
    pub fn form(&self) -> PairForm {
        self.form
    }

    /// Returns the lock applied to another pair of links: if `a` turns with `b` and `b` with `c`, a
    /// lock of `a` and `b` is equivalent to a lock of `a` and `c`.
    pub(super) fn locking(self, of: LinkId, against: LinkId) -> Constraint {
        Constraint { form: PairForm::Angles { of, against, driver: None }, ..self }
    }

    /// Returns the item of the scene.
    pub fn item(&self) -> PairItem {
        self.item
    }

    /// Returns the two nodes that it joins.
    pub fn ends(&self) -> (GraphNode, GraphNode) {
        self.form.ends()
    }

    /// Returns the name in a message.
    pub fn words(&self, scene: &Scene) -> Both {
        let (a, b) = self.ends();
        (KINDS[self.kind].words)(scene, a, b)
    }

    /// Returns the span in the file.
    pub fn span(&self, scene: &Scene) -> Span {
        match self.item {
            PairItem::Pin(_, l) => scene.links[l.0].span,
            PairItem::Guide(g) => scene.guides[g.0].span,
            PairItem::Driver(d) => scene.drivers[d].span,
            PairItem::Rolling(r) => scene.rolling[r.0].span,
        }
    }
}

impl GraphNode {
    /// Returns the name in the file.
    pub fn name(self, scene: &Scene) -> &str {
        match self {
            GraphNode::Link(l) => scene.link_name(l),
            GraphNode::Pin(p) => scene.point_name(p),
        }
    }
}

impl Runner {
    /// Returns the runner of a guide: its pin, otherwise its slider.
    fn of(guide: &Guide) -> Option<Runner> {
        guide.pin.map(Runner::Pin).or(guide.slider.map(Runner::Link))
    }
}
