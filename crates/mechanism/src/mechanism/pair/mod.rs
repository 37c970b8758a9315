//! Pairs and drivers as values: one file a kind, and the list of them.
//!
//! Each kind says of which items of the scene it is, which [`Form`] it demands there, and how it is named. All else follows from the
//! form: the nodes that a constraint joins and how many equations it is ([`form`]), the leg that it makes of a group
//! ([`super::groups`]), its equations of position, motion and sweep. So a new pair is one file here, its line in [`KINDS`], the scene's
//! reading of it and its symbol in the figure; only one that is none of the forms asks more of the solvers.

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

pub use form::{Form, Runner};

use super::Node;
use hodograph_base::diag::{Both, Span};
use hodograph_scene::{DriverKind, Guide, GuideId, LinkId, PointId, RollingId, RollingKind, Scene};

/// What of a scene constrains: a point on a link, a guide, a driver, a rolling pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Item {
    /// A point at which something meets, on one of its links.
    Pin(PointId, LinkId),
    /// A guide.
    Guide(GuideId),
    /// A driver (index).
    Driver(usize),
    /// A rolling pair.
    Rolling(RollingId),
}

/// A kind of pair or driver: the form that it demands of an item, if the item is of this kind, and its name in a message, from the two
/// nodes that it joins.
struct Kind {
    form: Demands,
    words: fn(&Scene, Node, Node) -> Both,
}

/// Of which items a kind is.
enum Demands {
    Pin(fn(PointId, LinkId) -> Option<Form>),
    Guide(fn(GuideId, &Guide) -> Option<Form>),
    Driver(DriverForm),
    /// All of them relate turnings, or turning and sliding, linearly; `told` says in a list of pairs which links those are.
    Rolling {
        kind: RollingKind,
        told: fn(&str, &str) -> Both,
    },
}

/// What a kind of driver says besides: how it is named as what moves something, and what it moves.
struct DriverForm {
    form: fn(usize, &DriverKind, &Scene) -> Option<Form>,
    mover: fn(&Scene, Node, Node) -> Both,
    moved: fn(&Scene, Node, Node) -> Both,
}

/// All kinds, in the order in which the constraints of one item come.
const KINDS: &[Kind] = &[
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
    item: Item,
    form: Form,
}

/// The constraints that an item of a scene stands for.
pub fn constraints_of(scene: &Scene, item: Item) -> impl Iterator<Item = Constraint> {
    let demanded = move |kind: &Kind| match (&kind.form, item) {
        (Demands::Pin(form), Item::Pin(p, l)) => form(p, l),
        (Demands::Guide(form), Item::Guide(g)) => form(g, &scene.guides[g.0]),
        (Demands::Driver(driver), Item::Driver(d)) => (driver.form)(d, &scene.drivers[d].kind, scene),
        (Demands::Rolling { kind, .. }, Item::Rolling(pair)) => {
            let of = &scene.rolling[pair.0];
            (of.kind == *kind).then_some(Form::Related { pair, links: of.links })
        }
        (Demands::Pin(_) | Demands::Guide(_) | Demands::Driver(_) | Demands::Rolling { .. }, _) => None,
    };
    KINDS.iter().enumerate().filter_map(move |(kind, k)| Some(Constraint { kind, item, form: demanded(k)? }))
}

/// What an item of one constraint is called.
pub fn words_of(scene: &Scene, item: Item) -> Both {
    constraints_of(scene, item).next().map_or_else(|| Both::same(""), |c| c.words(scene))
}

/// A rolling pair in a list of pairs.
pub fn told_words(scene: &Scene, pair: RollingId) -> Both {
    let [a, b] = scene.rolling[pair.0].links.map(|l| scene.link_name(l));
    let told = |kind: &Kind| match kind.form {
        Demands::Rolling { kind, told } if kind == scene.rolling[pair.0].kind => Some(told(a, b)),
        Demands::Pin(_) | Demands::Guide(_) | Demands::Driver(_) | Demands::Rolling { .. } => None,
    };
    KINDS.iter().find_map(told).unwrap_or_else(|| Both::same(""))
}

/// How a driver is named as what moves something.
pub fn mover_words(scene: &Scene, driver: usize) -> Both {
    driver_words(scene, driver, |d| d.mover)
}

/// How that is named which a driver moves.
pub fn moved_words(scene: &Scene, driver: usize) -> Both {
    driver_words(scene, driver, |d| d.moved)
}

fn driver_words(scene: &Scene, driver: usize, words: impl Fn(&DriverForm) -> fn(&Scene, Node, Node) -> Both) -> Both {
    let of = |c: Constraint| match &KINDS[c.kind].form {
        Demands::Driver(driver) => Some(words(driver)(scene, c.ends().0, c.ends().1)),
        Demands::Pin(_) | Demands::Guide(_) | Demands::Rolling { .. } => None,
    };
    constraints_of(scene, Item::Driver(driver)).find_map(of).unwrap_or_else(|| Both::same(""))
}

impl Constraint {
    /// What it demands.
    pub fn form(&self) -> Form {
        self.form
    }

    /// The same lock said of another pair of links: where `a` turns as `b` and `b` as `c`, what locks `a` and `b` may as well lock `a`
    /// and `c`.
    pub(super) fn locking(self, of: LinkId, against: LinkId) -> Constraint {
        Constraint { form: Form::Angles { of, against, driver: None }, ..self }
    }

    /// The item of the scene that it comes from.
    pub fn item(&self) -> Item {
        self.item
    }

    /// The two nodes that it joins.
    pub fn ends(&self) -> (Node, Node) {
        self.form.ends()
    }

    /// Its name in a message.
    pub fn words(&self, scene: &Scene) -> Both {
        let (a, b) = self.ends();
        (KINDS[self.kind].words)(scene, a, b)
    }

    /// Where the file says it.
    pub fn span(&self, scene: &Scene) -> Span {
        match self.item {
            Item::Pin(_, l) => scene.links[l.0].span,
            Item::Guide(g) => scene.guides[g.0].span,
            Item::Driver(d) => scene.drivers[d].span,
            Item::Rolling(r) => scene.rolling[r.0].span,
        }
    }
}

impl Node {
    /// The name that the file gives it.
    pub fn name(self, scene: &Scene) -> &str {
        match self {
            Node::Link(l) => scene.link_name(l),
            Node::Pin(p) => scene.point_name(p),
        }
    }
}

impl Runner {
    /// What runs in a guide: its pin, else its slider.
    fn of(guide: &Guide) -> Option<Runner> {
        guide.pin.map(Runner::Pin).or(guide.slider.map(Runner::Link))
    }
}
