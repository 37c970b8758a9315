//! A ram with two separate links, a slider and its guide, that moves a third link: the two are one
//! body, in which the driver pushes along the guide.

use super::joints::{Hinge, OuterJoint, turns_on};
use super::methods::{carries, normal, tangent};
use super::scribe::{ActingForce, Scribe};
use super::{ForceTerm, Party, ReactionComponent};
use crate::construction::{Base, Direction, Number};
use hodograph_scene::{GuideId, LinkId};

/// The two links of a ram and its driver.
pub(super) struct Ram {
    driver: usize,
    guide: GuideId,
    /// The link with the pin that the ram moves.
    rod: LinkId,
    /// The other link of the ram.
    barrel: LinkId,
}

impl Scribe<'_> {
    /// Returns the ram of a group of three links, the link that it moves, and the outer joints of
    /// both.
    pub(super) fn ram(
        &self,
        links: &[LinkId],
        inner: Hinge,
        (guide, slider, on): (GuideId, LinkId, LinkId),
        outer: [OuterJoint; 2],
    ) -> Option<(Ram, LinkId, [OuterJoint; 2])> {
        // With a balancing force the driver does not hold the two links together.
        let driver = self
            .scene
            .drivers
            .iter()
            .position(|d| d.kind.guide() == Some(guide))
            .filter(|_| self.scene.loads.balance.is_none())?;
        let pinned = |l: LinkId| turns_on(self.scene, l, inner);
        let (rod, barrel) = if pinned(slider) { (slider, on) } else { (on, slider) };
        let moved = links
            .iter()
            .copied()
            .find(|l| ![rod, barrel].contains(l))
            .filter(|l| pinned(*l) && pinned(rod))?;
        let of = |link: LinkId| outer.into_iter().find(|o| carries(o) == Some(link));
        let (
            held @ OuterJoint::Pin { .. },
            far @ (OuterJoint::Pin { .. } | OuterJoint::Slide { .. }),
        ) = (of(barrel)?, of(moved)?)
        else {
            return None;
        };
        Some((Ram { driver, guide, rod, barrel }, moved, [held, far]))
    }

    /// Writes a dyad of a ram and the link that it moves.
    pub(super) fn on_a_ram(
        &mut self,
        ram: &Ram,
        moved: LinkId,
        inner: Hinge,
        outer: [OuterJoint; 2],
    ) {
        let Ram { driver, guide, rod, barrel } = *ram;
        let (mut p, loads, [from, _, x]) =
            self.around_a_pin([&[barrel, rod], &[moved]], inner, outer);
        let place = self.reference(guide).unwrap_or(inner.at);
        // The force of the barrel on the rod closes the forces on the rod: along the guide the
        // driver pushes, square to it the guide presses.
        let lines = [
            self.line(&mut p, x, Direction::of(tangent(guide))),
            self.line(&mut p, from, normal(guide)),
        ];
        let corner = self.meet(&mut p, lines);
        let push = ForceTerm::Reaction {
            of: Party::Driver(driver),
            on: rod,
            part: ReactionComponent::Whole,
        };
        self.diagonal(&mut p, (push, place), [x, corner]);
        self.diagonal(
            &mut p,
            (
                ForceTerm::Reaction {
                    of: Party::Link(barrel),
                    on: rod,
                    part: ReactionComponent::Whole,
                },
                place,
            ),
            [corner, from],
        );
        let force = self.measured(&mut p, x, corner);
        let pushed =
            ActingForce { term: push, force: Some((Base::Measured(force), place)), couple: None };
        let all: Vec<ActingForce> = loads.into_iter().chain([pushed]).collect();
        self.inner_guide(&mut p, guide, rod, (inner.at, place), &all, [corner, from]);
        // The force is positive on the sliding link, in the sense of the guide.
        let ends =
            if self.scene.guides[guide.0].slider == Some(rod) { [x, corner] } else { [corner, x] };
        let size =
            self.number(&mut p.ops, Number::Along(ends[0], ends[1], Direction::of(tangent(guide))));
        self.answers.drivers.push((driver, size));
        p.drivers.push((driver, size));
        let kind = if matches!(outer[1], OuterJoint::Pin { .. }) { "RRR" } else { "RRP" };
        self.finish(p, &[barrel, rod, moved], kind);
    }
}
