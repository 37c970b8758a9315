//! Classification of singular and nearly singular poses, and the messages about them.

use super::fork::{self, Decided};
use super::relation::EquationRow;
use super::rows::UnknownLayout;
use super::singular::{
    Blocks, ContinuedMotion, FactoredBlock, Fork, Passed, Refusal, RefusalReason,
};
use super::{Solution, blocks::EquationBlock, words};
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_mechanism::mechanism::{Demand, Level};
use hodograph_mechanism::position::Configuration;
use hodograph_scene::{LinkId, PointId, PointPlace, Scene};
use nalgebra::DVector;

/// A part of a mechanism that is singular in the pose but has a solution.
#[derive(Clone, Debug, PartialEq)]
pub struct Singularity {
    /// The kind of singular pose.
    pub kind: SingularKind,
    /// The links whose velocities do not follow from the directions of the pose alone: none of
    /// their lines can be intersected on paper.
    pub links: Vec<LinkId>,
    /// Pins of the part that are on no link.
    pub pins: Vec<PointId>,
    /// The links that are in line, or leave the freedom open together with guides.
    pub named: Vec<LinkId>,
    /// Description in words, with the joints: `link 1 (AB) and link 2 (BC) lie in line at B`.
    pub words: Both,
    /// Distance of the pose from one that is exactly singular (radians, or parts of the mechanism's
    /// size): the answers differ by as much from those of the singular pose, relative to the
    /// largest of them.
    pub off: f64,
    /// The criterion that decides between two motions; `None` if there is only one.
    pub decided: Option<Decided>,
    /// The motion of the whole mechanism on the branch that is not selected.
    pub other: Option<Box<Solution>>,
}

/// A part of a mechanism without a determined motion in the pose; everything that depends on it has
/// none either.
#[derive(Clone, Debug, PartialEq)]
pub struct RefusedPart {
    /// The reason.
    pub why: RefusalReason,
    /// The links without a motion (except those that depend on them).
    pub links: Vec<LinkId>,
    /// Pins of the part that are on no link.
    pub pins: Vec<PointId>,
    /// The links that are in line, or leave the freedom open together with guides.
    pub named: Vec<LinkId>,
    /// Description in words, with the joints: `link 1 (AB) and link 2 (BC) lie in line at B`.
    pub words: Both,
    /// The diagnostic for the reader, with its position in the scene and the remedy.
    pub diagnostic: Diagnostic,
}

/// The kinds of singular pose that have a solution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SingularKind {
    /// Two motions lead through the pose: a change point.
    ChangePoint,
    /// The driver is at the limit of its range and turns back.
    Limit,
    /// A dead centre or change point with all drivers permanently at rest: nothing moves.
    Rest,
}

pub(super) struct PosedLayout<'a> {
    pub scene: &'a Scene,
    pub at: &'a Configuration,
    pub demand: &'a Demand,
    pub layout: &'a UnknownLayout,
}

/// A part of a mechanism whose equations are nearly singular in the pose.
#[derive(Clone, Debug, PartialEq)]
pub struct NearSingular {
    /// The links of the part.
    pub links: Vec<LinkId>,
    /// Pins of the part that are on no link.
    pub pins: Vec<PointId>,
    /// The links that are nearly in line, in words: `link 1 (AB) and link 2 (BC) lie in line at B`.
    pub words: Both,
    /// Possible error of its velocities from the rounding of the coordinates, relative to the
    /// largest velocity.
    pub loss: f64,
}

/// A part with a greater possible loss is nearly singular: some hundred rounding errors in its
/// velocities, ten thousand in its accelerations, and a thousand times that if these are small
/// compared with the largest.
const SLIGHT: f64 = 2e-14;

impl PosedLayout<'_> {
    /// Returns true if positions of a block follow from lengths: its pose near a limit is then
    /// accurate only to the square root of their rounding.
    fn by_lengths(&self, block: &EquationBlock) -> bool {
        let point = |p: PointId| matches!(self.scene.points[p.0].place, PointPlace::At(_));
        block.unknowns.iter().any(|u| match (self.layout.link_of(*u), self.layout.bare_of(*u)) {
            (Some(l), _) => !self.scene.links[l.0].points.iter().all(|p| point(*p)),
            (None, Some(p)) => !point(p),
            (None, None) => false,
        })
    }

    /// Returns the pivot up to which a block may be singular within the accuracy of its pose.
    pub fn blur(&self, block: &EquationBlock, rounding: f64) -> f64 {
        if self.by_lengths(block) { (8.0 * rounding).sqrt() } else { 0.0 }
    }

    /// Returns the blocks that are nearly singular but not treated as singular, the worst first.
    pub fn near(
        &self,
        system: &[EquationRow],
        blocks: &Blocks,
        rounding: f64,
    ) -> Vec<NearSingular> {
        let loss = |p: &FactoredBlock| rounding * p.factor.magnified / p.factor.ratio;
        let mut near: Vec<&FactoredBlock> =
            blocks.list.iter().filter(|p| p.deficiency == 0 && loss(p) > SLIGHT).collect();
        near.sort_by(|a, b| loss(b).total_cmp(&loss(a)));
        let told = |p: &FactoredBlock| NearSingular {
            links: words::links_of(self.layout, p),
            pins: self.bare_pins(p),
            words: words::held(self.scene, self.at, self.layout, system, p).text,
            loss: loss(p),
        };
        near.into_iter().map(told).collect()
    }

    /// Returns the motion through a singular pose, as far as it exists.
    pub fn singular(
        &self,
        system: &[EquationRow],
        blocks: &Blocks,
        mut empty: Solution,
    ) -> Solution {
        empty.condition = f64::INFINITY;
        // Drivers that start from rest, or stay at rest: with t² for t their accelerations take the
        // part of the rates elsewhere. Only if that gives a dead point (a driver at its own limit),
        // velocities arise immediately.
        let starts = system.iter().all(|r| r.relation.drive()[0] == 0.0);
        if starts {
            let slow: Vec<EquationRow> = system.iter().map(EquationRow::started).collect();
            let slow = self.ways(&slow, blocks, &empty, true);
            if slow.refused.iter().all(|r| r.why != RefusalReason::DeadPoint) {
                return self.with_notes(slow);
            }
        }
        self.with_notes(self.ways(system, blocks, &empty, false))
    }

    /// Returns the selected motion, with the other motion at each change point.
    fn ways(
        &self,
        rows: &[EquationRow],
        blocks: &Blocks,
        empty: &Solution,
        from_rest: bool,
    ) -> Solution {
        let terms = if self.demand.level >= Level::Acceleration && !from_rest { 2 } else { 1 };
        let choose = |fork: &Fork| {
            let of = words::links_of(self.layout, &blocks.list[fork.block]);
            let both = fork.ways.each_ref().map(|w| {
                let mut way = self.unpacked(empty, w, None);
                self.layout.keep(|u| fork.motion.order(u), &mut way);
                way.settle(self.scene, self.layout);
                way
            });
            fork::choose(self.scene, self.at, &both, &of, fork.turning)
        };
        let mut decided: Vec<(usize, Decided)> = Vec::new();
        let taken = blocks.carry(rows, terms, |fork| {
            let (way, by) = choose(fork);
            decided.push((fork.block, by));
            way
        });
        let mut solution = self.solution(empty, &taken, from_rest);
        for passed in &taken.passed {
            let by = decided.iter().find(|d| d.0 == passed.block).map(|d| d.1);
            // The other motion through this block; the same rules select the motion of later
            // blocks.
            let other = by.and_then(|_| {
                let turned = blocks.carry(rows, terms, |fork| {
                    let way = choose(fork).0;
                    if fork.block == passed.block { 1 - way } else { way }
                });
                turned
                    .refused
                    .is_empty()
                    .then(|| Box::new(self.solution(empty, &turned, from_rest)))
            });
            solution.singular.push(self.singularity(rows, blocks, passed, by, other));
        }
        solution.refused = taken.refused.iter().map(|r| self.refused(rows, blocks, r)).collect();
        solution
    }

    fn refused(&self, rows: &[EquationRow], blocks: &Blocks, refusal: &Refusal) -> RefusedPart {
        let part = &blocks.list[refusal.block];
        let held = words::held(self.scene, self.at, self.layout, rows, part);
        let diagnostic = words::refusal(self.scene, self.layout, part, refusal, &held);
        RefusedPart {
            why: refusal.why,
            links: words::links_of(self.layout, part),
            pins: self.bare_pins(part),
            named: held.links,
            words: held.text,
            diagnostic,
        }
    }

    /// Returns the pins of a block that are on no link.
    fn bare_pins(&self, part: &FactoredBlock) -> Vec<PointId> {
        let mut pins: Vec<PointId> =
            part.block.unknowns.iter().filter_map(|u| self.layout.bare_of(*u)).collect();
        pins.dedup();
        pins
    }

    fn singularity(
        &self,
        rows: &[EquationRow],
        blocks: &Blocks,
        passed: &Passed,
        decided: Option<Decided>,
        other: Option<Box<Solution>>,
    ) -> Singularity {
        let part = &blocks.list[passed.block];
        let held = words::held(self.scene, self.at, self.layout, rows, part);
        let pins = self.bare_pins(part);
        let kind = match (passed.rest, passed.turning) {
            (true, _) => SingularKind::Rest,
            (false, true) => SingularKind::Limit,
            (false, false) => SingularKind::ChangePoint,
        };
        let links = words::links_of(self.layout, part);
        Singularity {
            kind,
            links,
            pins,
            named: held.links,
            words: held.text,
            off: passed.off,
            decided,
            other,
        }
    }

    /// Returns a solution from the rates, and from the accelerations if known.
    fn unpacked(
        &self,
        empty: &Solution,
        rates: &DVector<f64>,
        accelerations: Option<&DVector<f64>>,
    ) -> Solution {
        let mut out = empty.clone();
        self.layout.unpack_rates(rates, &mut out);
        if let Some(accelerations) = accelerations {
            self.layout.unpack_accelerations(accelerations, &mut out);
            out.size[1] = self.layout.unknowns;
        }
        out.settle(self.scene, self.layout);
        out
    }

    fn solution(&self, empty: &Solution, carried: &ContinuedMotion, from_rest: bool) -> Solution {
        let n = self.layout.unknowns;
        let term = |k: usize| DVector::from_iterator(n, (0..n).map(|u| carried.motion.term(u, k)));
        let (rates, accelerations) =
            if from_rest { (DVector::zeros(n), term(1) * 2.0) } else { (term(1), term(2) * 2.0) };
        let wanted = self.demand.level >= Level::Acceleration;
        let mut out = self.unpacked(empty, &rates, wanted.then_some(&accelerations));
        let order = |u: usize| carried.motion.order(u) + usize::from(from_rest);
        self.layout.keep(|u| if carried.motion.order(u) == 0 { 0 } else { order(u) }, &mut out);
        out.settle(self.scene, self.layout);
        out
    }

    fn with_notes(&self, mut s: Solution) -> Solution {
        s.notes.extend(s.singular.iter().map(note));
        s.notes.extend(s.refused.iter().map(|r| r.diagnostic.clone()));
        s
    }
}

fn note(s: &Singularity) -> Diagnostic {
    let words = &s.words;
    let by = match s.decided {
        Some(Decided::Side) => both!("\"side\" says which is meant, as it is just after the pose"),
        Some(Decided::Sketch) => {
            both!("taken is the one that leads toward the sketch")
        }
        Some(Decided::Kind) => both!(
            "taken is the one on which the assembly keeps its kind (a parallelogram stays a parallelogram)"
        ),
        Some(Decided::Sense) => both!(
            "taken is the one on which the first link of them that turns goes counter-clockwise"
        ),
        None => Both::default(),
    };
    let undrawn =
        both!("their velocities are not crossed on paper, they come from the loop equations");
    match s.kind {
        SingularKind::ChangePoint if s.other.is_some() => Diagnostic::note(
            "change-point",
            both!(
                "change point: {}, and two motions lead through this pose; {}; {}",
                words,
                by,
                undrawn
            ),
        )
        .help(both!(
            "the other motion stands beside the answers; \"side\", told for the pose just after, chooses"
        )),
        SingularKind::ChangePoint => Diagnostic::note(
            "change-point",
            both!(
                "change point: {}, and one motion only leads through this pose with the driver moving as given; {}",
                words,
                undrawn
            ),
        ),
        SingularKind::Limit => Diagnostic::note(
            "driver-at-limit",
            both!(
                "the driver stands at its limit and turns back: {}, and the links pass through in one sense or the other; {}; {}",
                words,
                by,
                undrawn
            ),
        )
        .help(both!(
            "the other sense stands beside the answers; \"side\", told for the pose just after, chooses"
        )),
        SingularKind::Rest => {
            Diagnostic::note("at-rest", both!("{} while the drivers stand still: everything rests", words))
        }
    }
}
