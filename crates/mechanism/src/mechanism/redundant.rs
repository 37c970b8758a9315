//! Selection of the pairs that only repeat others 虚约束 and may be opened, so that every equation
//! is matched.
//!
//! This module decides from topology alone. An equation that stays unmatched depends on its
//! circuit; of the links, guides and double pins of that circuit the fewest are opened that leave
//! as many equations as freedoms. Of several such sets those are preferred that leave no distance
//! held twice by parallel guides ([`super::parallel`]), then those that leave the lowest class of
//! groups, then the last in the file. Lengths decide if an opened pair holds by itself, in
//! [`crate::position::redundant`]: topology cannot distinguish a third crank from a strut that
//! locks the mechanism.
//!
//! If pairs leave some freedom by count, a circuit of two drivers or more has a driver too many,
//! which the diagnosis reports. Two kinds of pairs are redundant whatever drives the mechanism: of
//! equal planets on one arm all but the first, and any pair that repeats a distance between
//! parallel guides.

use super::mobility::Matched;
use super::{
    Constraint, Core, Mechanism, PairItem, Passive, find_constraints, find_pins, touching,
};
use hodograph_base::diag::Span;
use hodograph_scene::{Guide, GuideId, LinkId, Normal, PointId, Rolling, RollingId, Scene, Touch};
use std::cmp::Reverse;
use std::collections::BTreeSet;

/// An opened item.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Opened {
    /// A link reduced to two pins: it follows them ([`Passive::Held`]).
    Link(LinkId),
    /// A guide: its runner is held by others. For the guide of a wheel on its track the contact is
    /// opened, the rolling remains.
    Guide(GuideId),
    /// A rolling pair or a mesh: the condition of no slip follows from others.
    Rolling(RollingId),
    /// The second of two pins that join the same two links: both are on one axis.
    Pin(PointId, LinkId),
}

/// A pair that only repeats others, as far as topology shows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Redundant {
    /// The opened item.
    pub opened: Opened,
    /// Number of its redundant equations.
    pub equations: usize,
}

/// The constraints of a scene with some of them opened.
#[derive(Clone)]
pub(super) struct OpenedPairs {
    pub passive: Vec<Option<Passive>>,
    pub redundant: Vec<Redundant>,
    /// The guide between gears that comes first in the selection of those that hold a distance;
    /// `None` for the order of the scene.
    pub touches: Option<GuideId>,
}

impl OpenedPairs {
    /// Returns true if a pair stays closed.
    pub fn keeps(&self, what: &Opened) -> bool {
        self.redundant.iter().all(|r| r.opened != *what)
    }

    /// Returns true if an item's pair stays closed.
    pub fn keeps_item(&self, item: PairItem) -> bool {
        match item {
            PairItem::Pin(p, l) => self.keeps(&Opened::Pin(p, l)),
            PairItem::Guide(g) => self.keeps(&Opened::Guide(g)),
            PairItem::Rolling(r) => self.keeps(&Opened::Rolling(r)),
            PairItem::Driver(_) => true,
        }
    }

    pub fn pins_and_constraints(&self, scene: &Scene) -> (Vec<PointId>, Vec<Constraint>) {
        let pins = find_pins(scene, self);
        let constraints = find_constraints(scene, self, &pins);
        let constraints = touching(scene, self, &pins, constraints);
        (pins, constraints)
    }

    pub fn matched(&self, scene: &Scene) -> Matched {
        let (pins, constraints) = self.pins_and_constraints(scene);
        Matched::new(scene, &self.passive, &pins, &constraints)
    }

    /// Returns the opening with one more pair opened.
    fn with(&self, candidate: &OpeningCandidate) -> OpenedPairs {
        let mut opening = self.clone();
        if let (Opened::Link(l), [a, b, ..]) = (&candidate.opened, &candidate.pins[..]) {
            opening.passive[l.0] = Some(Passive::Held(*a, *b));
        }
        opening
            .redundant
            .push(Redundant { opened: candidate.opened.clone(), equations: candidate.equations });
        opening
    }
}

/// A pair that may be opened.
struct OpeningCandidate {
    opened: Opened,
    /// The pins of a link.
    pins: Vec<PointId>,
    equations: usize,
    span: Span,
}

/// Greatest number of equations matched in all, which limits the time for any size: a matching
/// takes some microseconds for a textbook mechanism of fifty equations, so some ten thousand sets
/// of pairs are tried there.
const MOST_MATCHED: usize = 500_000;

/// Greatest number of pairs opened together (the coupled axles of a locomotive repeat three).
const MOST_OPENED: usize = 4;

/// Returns the smallest set of opened pairs that leaves as many equations as freedoms; `None` if
/// only a driver can be omitted.
pub(super) fn open(scene: &Scene, closed: &OpenedPairs) -> Option<OpenedPairs> {
    let matched = closed.matched(scene);
    let (pins, constraints) = closed.pins_and_constraints(scene);
    let drives = |c: &usize| constraints[*c].form().driver().is_some();
    let many = |c: BTreeSet<usize>| c.into_iter().filter(drives).count() > 1;
    let moves = super::mobility::count(scene, &constraints).freedom > 0;
    if matched.free() > 0 {
        return None;
    }
    if moves && matched.circuits().any(many) {
        let opening =
            equal_planets(scene).iter().fold(closed.clone(), |opening, c| opening.with(c));
        let opening = between_parallels(scene, opening, &candidates(scene, closed, &pins));
        let left = opening.matched(scene);
        return (left.unmatched() == 0 && left.free() == 0).then_some(opening);
    }
    let candidates = candidates(scene, closed, &pins);
    let mut search = OpeningSearch { scene, left_to_match: MOST_MATCHED, found: Vec::new() };
    for count in 1..=MOST_OPENED {
        search.choose(closed, &candidates, count, matched.unmatched());
        let ranked = std::mem::take(&mut search.found)
            .into_iter()
            .filter_map(|o| Some((rank(scene, &Mechanism::opened(scene, o.clone()).ok()?), o)));
        // Of equal ranks the first is taken: candidates are in the reverse order of the file.
        if let Some((_, best)) = ranked.min_by_key(|r| r.0) {
            return Some(best);
        }
    }
    None
}

/// Returns the opening without guides that repeat a distance across parallel guides, such as the
/// contact of a roller or the second of two planks.
fn between_parallels(
    scene: &Scene,
    mut opening: OpenedPairs,
    candidates: &[OpeningCandidate],
) -> OpenedPairs {
    let still = scene.turning_with(scene.ground);
    let circles =
        |o: &OpenedPairs| super::parallel::circles(scene, &o.pins_and_constraints(scene).1, &still);
    let (mut said, mut unmatched) = (circles(&opening), opening.matched(scene).unmatched());
    for c in candidates.iter().filter(|c| matches!(c.opened, Opened::Guide(_))) {
        if said == 0 || unmatched == 0 {
            break;
        }
        let one = opening.with(c);
        let (of_one, left) = (circles(&one), one.matched(scene).unmatched());
        if of_one < said && left < unmatched {
            (opening, said, unmatched) = (one, of_one, left);
        }
    }
    opening
}

/// A search through sets of candidates.
struct OpeningSearch<'a> {
    scene: &'a Scene,
    left_to_match: usize,
    found: Vec<OpenedPairs>,
}

impl OpeningSearch<'_> {
    /// Finds all sets of `count` candidates whose opening leaves every equation matched and no
    /// freedom open; `unmatched` is the number of equations not matched before.
    fn choose(
        &mut self,
        so_far: &OpenedPairs,
        candidates: &[OpeningCandidate],
        count: usize,
        unmatched: usize,
    ) {
        // No `count` candidates have more redundant equations than this.
        if count * candidates.iter().map(|c| c.equations).max().unwrap_or(0) < unmatched {
            return;
        }
        for (i, c) in candidates.iter().enumerate() {
            let Some(left) = unmatched.checked_sub(c.equations) else { continue };
            if (left == 0) != (count == 1) {
                continue;
            }
            let opening = so_far.with(c);
            let matched = opening.matched(self.scene);
            match self.left_to_match.checked_sub(matched.equations()) {
                Some(rest) => self.left_to_match = rest,
                None => return,
            }
            if matched.unmatched() != left || matched.free() > 0 {
                continue;
            }
            if count == 1 {
                self.found.push(opening);
            } else {
                self.choose(&opening, &candidates[i + 1..], count - 1, left);
            }
        }
    }
}

/// Returns the number of repeated distances across parallel guides, the number of groups above
/// class III, and the number of groups of class III; compared in this order.
fn rank(scene: &Scene, m: &Mechanism) -> [usize; 3] {
    let of = |class| m.groups.iter().filter(|g| g.class() == Some(class)).count();
    [
        super::parallel::circles(scene, &m.constraints, &m.never_turns),
        m.groups.iter().filter(|g| g.core == Core::Higher).count(),
        of("III"),
    ]
}

/// Returns the items that may be opened, the last in the file first.
fn candidates(scene: &Scene, closed: &OpenedPairs, pins: &[PointId]) -> Vec<OpeningCandidate> {
    let links = (0..scene.links.len())
        .map(LinkId)
        .filter(|l| *l != scene.ground && closed.passive[l.0].is_none());
    let mut all: Vec<OpeningCandidate> =
        links.filter_map(|l| as_follower(scene, pins, l)).collect();
    let driven = |g: usize| scene.drivers.iter().any(|d| d.kind.guide() == Some(GuideId(g)));
    // Teeth keep a distance only if nothing else does; a wheel on its track may be in contact
    // because its axle keeps it there.
    let toothed =
        |guide: &Guide| guide.rolling.is_some_and(|r| scene.rolling[r.0].kind.leaves_distance());
    for (g, guide) in
        scene.guides.iter().enumerate().filter(|(g, guide)| !driven(*g) && !toothed(guide))
    {
        let block =
            guide.slider.is_some_and(|s| closed.passive[s.0] == Some(Passive::Block(GuideId(g))));
        let equations = match (guide.slider.filter(|_| !block), guide.pin) {
            (Some(_), _) => 2,
            (None, _) => 1,
        };
        all.push(OpeningCandidate {
            opened: Opened::Guide(GuideId(g)),
            pins: Vec::new(),
            equations,
            span: guide.span,
        });
    }
    for (l, link) in scene
        .links
        .iter()
        .enumerate()
        .filter(|(l, _)| closed.passive[*l].is_none() && *l != scene.ground.0)
    {
        for &p in link.points.iter().rev() {
            let other = |k: &LinkId| {
                k.0 != l
                    && closed.passive[k.0].is_none()
                    && link.points.iter().any(|q| *q != p && scene.links[k.0].points.contains(q))
            };
            if scene.carriers(p).any(|k| other(&k)) {
                all.push(OpeningCandidate {
                    opened: Opened::Pin(p, LinkId(l)),
                    pins: Vec::new(),
                    equations: 2,
                    span: link.span,
                });
            }
        }
    }
    for (r, pair) in scene.rolling.iter().enumerate() {
        all.push(OpeningCandidate {
            opened: Opened::Rolling(RollingId(r)),
            pins: Vec::new(),
            equations: 1,
            span: pair.span,
        });
    }
    all.sort_by_key(|c| Reverse(c.span.start));
    all
}

/// Returns the last mesh of every planet that has an equal planet before it: on the same arm, in
/// mesh with the same wheels, in the same ratios.
fn equal_planets(scene: &Scene) -> Vec<OpeningCandidate> {
    let meshes =
        |l: LinkId| scene.rolling.iter().enumerate().filter(move |(_, r)| r.links.contains(&l));
    let ratios = |l: LinkId| -> Option<Vec<(LinkId, Option<usize>, f64)>> {
        let mut all = meshes(l).map(|(_, r)| ratio(r, l)).collect::<Option<Vec<_>>>()?;
        all.sort_by_key(|(other, ..)| *other);
        Some(all)
    };
    let arm =
        |l: LinkId| (0..scene.links.len()).map(LinkId).find(|a| *a != l && carries(scene, *a, l));
    let links = || (0..scene.links.len()).map(LinkId);
    let fellow = |l: &LinkId| {
        let own = ratios(*l).filter(|r| r.len() > 1);
        own.is_some()
            && arm(*l).is_some()
            && links().take(l.0).any(|k| arm(k) == arm(*l) && ratios(k) == own)
    };
    let last = |l: LinkId| meshes(l).next_back().map(|(r, pair)| (RollingId(r), pair.span));
    let opened = links().filter(fellow).filter_map(last);
    opened
        .map(|(r, span)| OpeningCandidate {
            opened: Opened::Rolling(r),
            pins: Vec::new(),
            equations: 1,
            span,
        })
        .collect()
}

/// Returns true if a wheel has its axis on a link that is no wheel of a pair with it.
fn carries(scene: &Scene, arm: LinkId, wheel: LinkId) -> bool {
    let meets = scene.rolling.iter().any(|r| r.links.contains(&arm) && r.links.contains(&wheel));
    !meets && scene.links[wheel.0].points.iter().any(|p| scene.links[arm.0].points.contains(p))
}

/// Returns the other wheel of a pair of circles, the index of the hollow wheel as seen from this
/// one, and the ratio of their sizes.
fn ratio(pair: &Rolling, wheel: LinkId) -> Option<(LinkId, Option<usize>, f64)> {
    let Touch::Point(Normal::Centres(_)) = pair.touch() else { return None };
    let radii = || pair.radii().map(|radii| radii.map(|r| r.value));
    let [a, b] = pair.teeth().map(|teeth| teeth.map(f64::from)).or_else(radii)?;
    let own = pair.links.iter().position(|l| *l == wheel)?;
    Some((
        pair.links[1 - own],
        pair.hollow().map(|h| h ^ own),
        if own == 0 { a / b } else { b / a },
    ))
}

/// Returns a link that may be reduced to two of its pins: only pins hold it, and nothing drives it.
fn as_follower(scene: &Scene, pins: &[PointId], l: LinkId) -> Option<OpeningCandidate> {
    let slides = scene.guides.iter().any(|g| g.on == l || g.slider == Some(l))
        || scene.rolling.iter().any(|r| r.links.contains(&l));
    let driven = scene.drivers.iter().any(|d| d.kind.turns_link(l));
    let own: Vec<PointId> =
        scene.links[l.0].points.iter().copied().filter(|p| pins.contains(p)).collect();
    // Each pin gives two equations, and the link takes three freedoms with it.
    let equations =
        (2 * own.len()).checked_sub(3).filter(|_| own.len() >= 2 && !slides && !driven)?;
    Some(OpeningCandidate {
        opened: Opened::Link(l),
        pins: own,
        equations,
        span: scene.links[l.0].span,
    })
}
