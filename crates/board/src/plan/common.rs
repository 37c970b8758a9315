//! Two unknown links that two legs join: their common point.
//!
//! Each leg, a bar or a slot, allows relative motion square to its line only. The crossing S of the
//! two lines is therefore the relative instant centre of the links, and v_S is the same on both.
//! With the known pins of the links it is the crossing of two loci. For accelerations, α of the
//! first link is assumed as 0 in a trial: from the point of the first link at S both legs lead to
//! the point of the other link at S, with all unknowns square to their lines. The true α moves that
//! point square to the arm of S on the first link.
//!
//! # Source
//! Assur points: N. Rosenauer, A. H. Willis, *Kinematics of Mechanisms* (1953); the difference of
//! the accelerations at S follows from the equations of the two legs.

use super::build::PlanBuilder;
use super::reduce::Member;
use super::{
    Method, PlanStep, Rate, Special, SpecialLine, TermChain, TurningBody, VertexId, VertexTrial,
};
use hodograph_mechanism::mechanism::{ConstraintLine, Hold, Level};
use hodograph_scene::{GuideId, LinkId, PointId};

/// Two links with a known pin each, and two legs between them.
pub(super) struct Common {
    links: [usize; 2],
    legs: [Joining; 2],
}

/// A leg from the first link to the second.
#[derive(Clone, Copy)]
enum Joining {
    /// A bar, with its pins on both.
    Bar { link: LinkId, pins: [PointId; 2] },
    /// A pin of one link in a slot of the other.
    Slot { pin: PointId, guide: GuideId },
}

impl Joining {
    fn line(self) -> SpecialLine {
        SpecialLine::Leg(match self {
            Joining::Bar { pins: [near, far], .. } => ConstraintLine::Along { near, far },
            Joining::Slot { pin, guide } => ConstraintLine::Normal { pin, guide },
        })
    }
}

impl PlanBuilder<'_> {
    /// Returns the steps of a group by the common point of two links.
    pub(super) fn by_common_point(
        &mut self,
        level: Level,
        g: usize,
        members: &[Member],
        common: &Common,
    ) -> Option<Vec<PlanStep>> {
        let [first, second] = common.links;
        let links = common.links.map(|k| members[k].link);
        let pivots = common.links.map(|k| self.pin(members[k].pivots[0]));
        let lines = common.legs.map(Joining::line);
        let point = self.special(Special {
            group: g,
            link: links[0],
            with: Some(links[1]),
            lines,
            legs: None,
        });
        let [own, other] = links.map(|l| self.on_link(point, l));
        let arms = [own, other].into_iter().zip(links).zip(pivots);
        let mut states = self.states(members);
        let mut chains: Vec<TermChain> = Vec::new();
        for ((point, link), start) in arms {
            let (known, unknown) =
                self.turning(level, TurningBody::Link(link), point, start, false);
            chains.push(TermChain { start, known, unknown });
        }
        if level == Level::Velocity {
            self.equation(level, other, chains, Method::Special);
            self.equation(
                level,
                own,
                vec![TermChain { start: other, known: Vec::new(), unknown: Vec::new() }],
                Method::Coincident,
            );
            self.known_at(&mut states, members, own, first);
        } else {
            let [with_zero, by_legs] = [own, other].map(|v| self.tried(v, FIRST));
            let normal =
                self.turning(level, TurningBody::Link(links[0]), with_zero, pivots[0], false).0;
            self.equation(
                level,
                with_zero,
                vec![TermChain { start: pivots[0], known: normal, unknown: Vec::new() }],
                Method::Special,
            );
            let legs =
                common.legs.map(|leg| self.along_leg(level, leg, links, [with_zero, by_legs]));
            self.equation(level, by_legs, legs.to_vec(), Method::Special);
            chains[0] = TermChain {
                start: by_legs,
                known: Vec::new(),
                unknown: std::mem::take(&mut chains[0].unknown),
            };
            self.equation(level, other, chains, Method::Special);
            self.source(
                level,
                TurningBody::Link(links[0]),
                Rate::Measured { of: own, to: pivots[0] },
            );
        }
        self.known_at(&mut states, members, other, second);
        if !self.open_all(level, g, members, &mut states) {
            return None;
        }
        self.sources_of_members(level, members);
        Some(std::mem::take(&mut self.pending))
    }

    /// Returns the chain along a leg, from the point of one link at S to the point of the other, if
    /// the first link has no angular acceleration.
    fn along_leg(
        &mut self,
        level: Level,
        leg: Joining,
        links: [LinkId; 2],
        [from, to]: [VertexId; 2],
    ) -> TermChain {
        let ends = match leg {
            Joining::Bar { pins, .. } => pins.map(|p| self.pin(p)),
            Joining::Slot { pin, .. } => links.map(|l| self.coincident(pin, l)),
        };
        let ends = ends.map(|v| self.tried(v, FIRST));
        let (mut known, _) = self.turning(level, TurningBody::Link(links[0]), ends[0], from, false);
        let (across, mut unknown) = match leg {
            Joining::Bar { link, .. } => {
                self.turning(level, TurningBody::Link(link), ends[1], ends[0], false)
            }
            Joining::Slot { guide, .. } => self.sliding(level, guide, ends[1], ends[0], None),
        };
        let (normal, tangential) =
            self.turning(level, TurningBody::Link(links[1]), to, ends[1], false);
        known.extend(across.into_iter().chain(normal));
        unknown.extend(tangential);
        TermChain { start: from, known, unknown }
    }
}

/// The trial without angular acceleration of the first link.
const FIRST: VertexTrial = VertexTrial { run: 1, mate: false };

/// Returns the pairs of links with a known pin each that two legs join.
pub(super) fn commons(members: &[Member]) -> Vec<Common> {
    let hinged: Vec<usize> = (0..members.len()).filter(|k| members[*k].is_hinged()).collect();
    let pairs =
        hinged.iter().enumerate().flat_map(|(n, &i)| hinged[n + 1..].iter().map(move |&j| [i, j]));
    let found = pairs.filter_map(|links| {
        let mut legs = legs_between(members, links);
        Some(Common { links, legs: [legs.next()?, legs.next()?] })
    });
    found.collect()
}

fn legs_between(members: &[Member], [i, j]: [usize; 2]) -> impl Iterator<Item = Joining> + '_ {
    let bars =
        members.iter().filter(|m| m.is_pinned_only() && m.pivots.is_empty()).filter_map(move |m| {
            let [p, q] = m.shared[..] else { return None };
            let ends = [[p, q], [q, p]]
                .into_iter()
                .find(|[a, b]| members[i].shared.contains(a) && members[j].shared.contains(b))?;
            Some(Joining::Bar { link: m.link, pins: ends })
        });
    let slots =
        members[i].inner.iter().filter(move |(other, _)| *other == j).filter_map(|(_, hold)| {
            match *hold {
                Hold::Guide { pin, guide, .. } | Hold::Slot { pin, guide } => {
                    Some(Joining::Slot { pin, guide })
                }
                Hold::Distance { .. } | Hold::Glide { .. } | Hold::Rolls { .. } => None,
            }
        });
    bars.chain(slots)
}
