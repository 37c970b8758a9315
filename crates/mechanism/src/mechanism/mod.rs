//! Links, pairs and drivers as a graph: mobility, Assur groups in solving order, and the demand of
//! the requests.
//!
//! This module decides from topology alone (no length is used): the list of constraints; if they
//! and the drivers determine every link; the order in which the links can be solved ([`Group`]);
//! and the groups that the scene's requests need ([`Demand`]). It computes no positions.

mod assur;
mod demand;
mod groups;
mod leg;
mod mobility;
mod pair;
mod parallel;
mod redundant;
mod survey;
mod turning;

pub use assur::Assur;
pub use demand::Demand;
pub use demand::nodes_of;
pub use groups::{Core, Group};
pub use leg::{ConstraintLine, CoreLoci, Hold, Leg, LegStatement, Strut};
pub use mobility::Mobility;
pub use pair::{
    Constraint, PairForm, PairItem, Runner, constraints_of, moved_words, mover_words,
    rolling_pair_words, words_of,
};
pub use redundant::{Opened, Redundant};
pub use survey::{Counts, ForDrivers, Local, MobilitySurvey, compound};

use redundant::OpenedPairs;

pub use hodograph_scene::quantity::{Level, Need, PointJoint, joined};

use hodograph_base::diag::{Diagnostic, Faults, Warned, both};
use hodograph_scene::{Guide, GuideId, GuidePath, LinkId, PointId, RollingId, Scene, quantity};

/// A node with an unknown position: a link (three freedoms) or a pin (two).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum GraphNode {
    /// A link.
    Link(LinkId),
    /// A pin: a point at which links meet, that moves in a guide, or at which a cylinder ends.
    Pin(PointId),
}

impl GraphNode {
    /// Returns the number of its freedoms in the plane.
    pub(crate) fn freedoms(self) -> usize {
        match self {
            GraphNode::Link(_) => 3,
            GraphNode::Pin(_) => 2,
        }
    }
}

/// A numbered link whose motion follows from others and which constrains nothing: a block with one
/// pin, the barrel or the rod of a cylinder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Passive {
    /// A block: turns with the link that carries its guide.
    Block(GuideId),
    /// Barrel or rod: turns with the line of the cylinder (index of the driver).
    Cylinder(usize),
    /// A link that only repeats other constraints, known by two of its pins: turns with their line.
    /// See [`Redundant`].
    Held(PointId, PointId),
}

/// The topology of a scene.
#[derive(Clone, Debug)]
pub struct Mechanism {
    /// All constraints, in the order of the scene.
    pub constraints: Vec<Constraint>,
    /// The points that are pins, in the order of the scene.
    pub pins: Vec<PointId>,
    /// For each link the way it follows others, if it is passive.
    pub passive: Vec<Option<Passive>>,
    /// Mobility and pair counts.
    pub mobility: Mobility,
    /// Groups in solving order; ground is known before the first.
    pub groups: Vec<Group>,
    /// The group of each link (ground, passive and isolated links have none).
    pub group_of_link: Vec<Option<usize>>,
    /// The group of each pin.
    pub group_of_pin: Vec<Option<usize>>,
    /// The pairs that only repeat others, in the order in which they are opened. Lengths decide if
    /// they do: [`crate::position::redundant`].
    pub redundant: Vec<Redundant>,
    /// For each link, true if it is ground or keeps its direction for topological reasons (locked
    /// to ground by sliding pairs).
    pub never_turns: Vec<bool>,
}

impl Mechanism {
    /// Determines the topology of a scene.
    ///
    /// # Errors
    /// Too few or too many drivers, overconstrained pairs, links joined to nothing: each with the
    /// links and joints named.
    pub fn new(scene: &Scene) -> Result<Warned<Mechanism>, Faults> {
        let passive = find_passive(scene);
        let mut faults = curved_sliders(scene, &passive);
        cylinder_parts(scene, &passive, &mut faults);
        faults.list.extend(quantity::undefined(scene).list);
        if faults.has_errors() {
            return Err(faults);
        }
        let mut opening = OpenedPairs { passive, redundant: Vec::new(), touches: None };
        if opening.matched(scene).unmatched() > 0 {
            opening = redundant::open(scene, &opening).unwrap_or(opening);
        }
        let mut mechanism = Mechanism::opened(scene, opening.clone())?;
        let higher = |m: &Mechanism| m.groups.iter().any(|g| g.core == Core::Higher);
        if higher(&mechanism) {
            // Another pair of gears may keep a distance that only one pair must keep: the one is
            // chosen that leaves groups of a lower class.
            let other = |g| {
                Mechanism::opened(scene, OpenedPairs { touches: Some(g), ..opening.clone() })
                    .ok()
                    .filter(|m| !higher(m))
            };
            mechanism = holding(scene).take(MOST_OPTIONAL).find_map(other).unwrap_or(mechanism);
        }
        Ok(Warned { value: mechanism, notes: Vec::new() })
    }

    /// Creates the mechanism without the opened items.
    fn opened(scene: &Scene, opening: OpenedPairs) -> Result<Mechanism, Faults> {
        let (pins, constraints) = opening.pins_and_constraints(scene);
        let assignment = mobility::assign(scene, &opening.passive, &pins, &constraints)?;
        let mut mechanism = Mechanism {
            mobility: mobility::count(scene, &constraints),
            constraints,
            pins,
            passive: opening.passive,
            groups: Vec::new(),
            group_of_link: vec![None; scene.links.len()],
            group_of_pin: vec![None; scene.points.len()],
            redundant: opening.redundant,
            never_turns: scene.turning_with(scene.ground),
        };
        groups::find(scene, &mut mechanism, &assignment);
        if let Some(constraints) = turning::from_known_links(&mechanism) {
            let assignment =
                mobility::assign(scene, &mechanism.passive, &mechanism.pins, &constraints)?;
            (mechanism.constraints, mechanism.groups) = (constraints, Vec::new());
            groups::find(scene, &mut mechanism, &assignment);
        }
        Ok(mechanism)
    }

    /// Returns true if a guide constrains: a guide between gears may only repeat other pairs.
    pub fn guide_holds(&self, guide: &Guide, id: GuideId) -> bool {
        self.keeps(id)
            && (guide.rolling.is_none()
                || self.constraints.iter().any(|c| c.item() == PairItem::Guide(id)))
    }

    /// Returns the path that keeps a rolling pair in contact, if it constrains.
    pub fn path_of(&self, scene: &Scene, pair: RollingId) -> Option<GuideId> {
        scene.rolling[pair.0].guide().filter(|g| self.guide_holds(&scene.guides[g.0], *g))
    }

    /// Returns the guides between gears whose distance other pairs must keep, without those along
    /// which a rack slides.
    pub fn kept_apart<'a>(&'a self, scene: &'a Scene) -> impl Iterator<Item = GuideId> + 'a {
        holding(scene).filter(|g| !self.guide_holds(&scene.guides[g.0], *g) && self.keeps(*g))
    }

    fn keeps(&self, guide: GuideId) -> bool {
        !self.is_opened(&Opened::Guide(guide))
    }

    /// Returns true if a link is a part of a pair (a block, a barrel or a rod) and has no form of
    /// its own.
    pub fn is_passive(&self, l: LinkId) -> bool {
        matches!(self.passive[l.0], Some(Passive::Block(_) | Passive::Cylinder(_)))
    }

    /// Returns true if a pair of the scene is opened because it only repeats others.
    pub fn is_opened(&self, what: &Opened) -> bool {
        self.redundant.iter().any(|r| r.opened == *what)
    }

    /// Returns the two pins of a link that only repeats other constraints.
    pub fn held(&self, l: LinkId) -> Option<(PointId, PointId)> {
        match self.passive[l.0] {
            Some(Passive::Held(a, b)) => Some((a, b)),
            Some(Passive::Block(_) | Passive::Cylinder(_)) | None => None,
        }
    }

    /// Returns the link with which a link turns for topological reasons: for a block, the carrier
    /// of its straight guide, otherwise the link itself. A block on a curved guide turns
    /// separately, see [`Mechanism::curved_block`].
    pub fn turns_as(&self, scene: &Scene, l: LinkId) -> LinkId {
        match self.passive[l.0] {
            Some(Passive::Block(g)) if matches!(scene.guides[g.0].path, GuidePath::Line { .. }) => {
                self.turns_as(scene, scene.guides[g.0].on)
            }
            _ => l,
        }
    }

    /// Returns, for a block on a curved guide, its pin, the centre of curvature, and the link that
    /// carries the guide.
    pub fn curved_block(&self, scene: &Scene, l: LinkId) -> Option<(PointId, PointId, LinkId)> {
        let Some(Passive::Block(g)) = self.passive[l.0] else { return None };
        let guide = &scene.guides[g.0];
        match guide.path {
            GuidePath::Arc { centre, .. } => Some((guide.pin?, centre, guide.on)),
            GuidePath::Line { .. } => None,
        }
    }

    /// Returns the two pins with whose line a link turns, its own pin first: the ends of its
    /// cylinder, or the two pins of a link that only repeats others.
    pub fn line_of(&self, scene: &Scene, l: LinkId) -> Option<(PointId, PointId)> {
        match (self.passive[l.0]?, self.held(l)) {
            (Passive::Cylinder(d), _) => {
                scene.drivers[d].kind.ends_of(l).map(<(PointId, PointId)>::from)
            }
            (Passive::Held(..) | Passive::Block(_), held) => held,
        }
    }

    /// Returns the group that determines the position of a node; `None` for ground and passive
    /// links.
    pub fn group_of(&self, n: GraphNode) -> Option<usize> {
        match n {
            GraphNode::Link(l) => self.group_of_link[l.0],
            GraphNode::Pin(p) => self.group_of_pin[p.0],
        }
    }
}

/// Number of gear pairs up to which each is tried as the one that keeps its centres apart.
const MOST_OPTIONAL: usize = 16;

fn find_passive(scene: &Scene) -> Vec<Option<Passive>> {
    let mut passive = vec![None; scene.links.len()];
    for (d, driver) in scene.drivers.iter().enumerate() {
        for l in driver.kind.parts() {
            passive[l.0] = Some(Passive::Cylinder(d));
        }
    }
    for (i, link) in scene.links.iter().enumerate() {
        let id = LinkId(i);
        if id == scene.ground || passive[i].is_some() || link.points.len() != 1 {
            continue;
        }
        let as_slider: Vec<usize> =
            (0..scene.guides.len()).filter(|&g| scene.guides[g].slider == Some(id)).collect();
        let carries = scene.guides.iter().any(|g| g.on == id);
        let turned = scene.drivers.iter().any(|d| d.kind.turns_link(id));
        if let [g] = as_slider[..]
            && scene.guides[g].pin == Some(link.points[0])
            && !carries
            && !turned
            && !scene.rolling.iter().any(|r| r.links.contains(&id))
        {
            passive[i] = Some(Passive::Block(GuideId(g)));
        }
    }
    passive
}

/// A curved guide accepts only a block that carries nothing else: any other link turns about the
/// centre of curvature, which is a pin joint there and must be written as one.
fn curved_sliders(scene: &Scene, passive: &[Option<Passive>]) -> Faults {
    let mut faults = Faults::default();
    for (i, guide) in scene.guides.iter().enumerate() {
        let (Some(s), GuidePath::Arc { centre, .. }) = (guide.slider, &guide.path) else {
            continue;
        };
        if passive[s.0] == Some(Passive::Block(GuideId(i))) {
            continue;
        }
        let (slider, on, centre) =
            (scene.link_name(s), scene.link_name(guide.on), scene.point_name(*centre));
        faults.push(
            Diagnostic::error(
                "curved-slider",
                both!(
                    "link {slider} slides on a curved guide and has more than its pin there: it turns about {centre} on link {on}"
                ),
            )
            .at(guide.span)
            .help(both!(
                "make {centre} a point of link {slider} and leave the guide out, or give a block of its own to the guide"
            )),
        );
    }
    faults
}

/// Barrel and rod of a cylinder only follow it: nothing else may depend on their position.
fn cylinder_parts(scene: &Scene, passive: &[Option<Passive>], faults: &mut Faults) {
    let part = |l: LinkId| matches!(passive[l.0], Some(Passive::Cylinder(_)));
    let guides = scene.guides.iter().map(|g| ([Some(g.on), g.slider], g.span));
    let turns = scene.drivers.iter().filter_map(|d| {
        d.kind.turned().map(|(link, against)| ([Some(link), Some(against)], d.span))
    });
    for (links, span) in guides.chain(turns) {
        for l in links.into_iter().flatten().filter(|l| part(*l)) {
            let message = both!(
                "link {} is a part of a cylinder: no guide and no other driver can rest on it",
                scene.link_name(l)
            );
            let d = Diagnostic::error("cylinder-part", message).at(span);
            faults.push(d.help(both!(
                "describe barrel and rod as links with a guide between them, and drive the slide"
            )));
        }
    }
}

fn find_pins(scene: &Scene, opening: &OpenedPairs) -> Vec<PointId> {
    let mut is_pin = vec![false; scene.points.len()];
    for (p, pin) in is_pin.iter_mut().enumerate() {
        let on = scene
            .carriers(PointId(p))
            .filter(|l| matches!(opening.passive[l.0], None | Some(Passive::Held(..))))
            .count();
        *pin = on >= 2;
    }
    for g in &scene.guides {
        if let Some(p) = g.pin {
            is_pin[p.0] = true;
        }
    }
    for d in &scene.drivers {
        for p in d.kind.ends().into_iter().flatten() {
            is_pin[p.0] = true;
        }
    }
    (0..scene.points.len()).filter(|&p| is_pin[p]).map(PointId).collect()
}

/// Returns the constraints of all items that stay closed. An item that joins a passive link is no
/// constraint: the link only follows.
fn find_constraints(scene: &Scene, opening: &OpenedPairs, pins: &[PointId]) -> Vec<Constraint> {
    let on_links = pins.iter().flat_map(|&p| scene.carriers(p).map(move |l| PairItem::Pin(p, l)));
    let guides = scene
        .guides
        .iter()
        .enumerate()
        .filter(|(_, g)| !is_optional(scene, g))
        .map(|(i, _)| PairItem::Guide(GuideId(i)));
    let drivers = (0..scene.drivers.len()).map(PairItem::Driver);
    let rolling = (0..scene.rolling.len()).map(|r| PairItem::Rolling(RollingId(r)));
    let kept = on_links
        .chain(guides)
        .chain(drivers)
        .chain(rolling)
        .filter(|item| opening.keeps_item(*item));
    let follows = |n: GraphNode| matches!(n, GraphNode::Link(l) if opening.passive[l.0].is_some());
    kept.flat_map(|item| constraints_of(scene, item))
        .filter(|c| !follows(c.ends().0) && !follows(c.ends().1))
        .collect()
}

/// Returns true if a guide keeps two gears in contact that other pairs may already keep in contact:
/// their teeth touch on both sides, but another pair may hold the distance of their centres.
fn is_optional(scene: &Scene, guide: &Guide) -> bool {
    guide.rolling.is_some_and(|r| scene.rolling[r.0].kind.leaves_distance())
}

/// Returns the guides between gears that may be needed to keep them in contact.
fn holding(scene: &Scene) -> impl Iterator<Item = GuideId> {
    let may = |g: &Guide| is_optional(scene, g) && !parallel::runs_along(scene, g);
    scene.guides.iter().enumerate().filter(move |(_, g)| may(g)).map(|(g, _)| GuideId(g))
}

/// Adds the guides that keep gears in contact if nothing else does: those whose equation can be
/// matched in addition to all others. The guide that the opening names comes first.
fn touching(
    scene: &Scene,
    opening: &OpenedPairs,
    pins: &[PointId],
    mut constraints: Vec<Constraint>,
) -> Vec<Constraint> {
    let passive = &opening.passive;
    let optional = holding(scene).filter(|g| opening.touches != Some(*g));
    for g in opening.touches.into_iter().chain(optional) {
        let closed = constraints.len();
        constraints.extend(constraints_of(scene, PairItem::Guide(g)));
        if !mobility::all_matched(scene, passive, pins, &constraints) {
            constraints.truncate(closed);
        }
    }
    constraints
}
