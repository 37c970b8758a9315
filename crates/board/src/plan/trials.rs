//! Groups that no special point opens, drawn by trial polygons.
//!
//! One unknown rate is assumed, 0 in a first trial and a handy value in a second, and one bar CE
//! between two links of the group is removed; all other links then follow one after the other. The
//! bar requires e on the line through the image of C and the bar's normal part, square to CE: the
//! mate x of e is on this line, and the gap from e to x is along CE. All images are linear in the
//! rate, so e and x move on straight lines, and the true e is their crossing.
//!
//! # Source
//! The method of false position (试凑法 of the textbooks), exact here because the equations are
//! linear.

use super::build::{PlanBuilder, slot};
use super::reduce::Member;
use super::{
    Method, PlanStep, Term, TermChain, TermConnection, TermKind, TurningBody, VertexId, VertexTrial,
};
use hodograph_mechanism::mechanism::Level;
use hodograph_scene::PointId;
use std::collections::HashSet;

/// The link with the assumed rate, with a known point and another point; the removed bar with its
/// pins.
pub(super) struct TrialChoice {
    tried: usize,
    pivot: PointId,
    moved: PointId,
    left_out: usize,
    pins: [PointId; 2],
}

impl PlanBuilder<'_> {
    /// Returns the steps of a group by two trials; `None` if the assumed rate does not open it.
    pub(super) fn by_trials(
        &mut self,
        level: Level,
        g: usize,
        members: &[Member],
        choice: &TrialChoice,
    ) -> Option<Vec<PlanStep>> {
        let mut steps = Vec::new();
        let [near, far] = choice.pins.map(|p| self.pin(p));
        let mut found: [[VertexId; 2]; 2] = [[far; 2]; 2];
        for run in [1, 2] {
            let (known, sources) =
                (self.known[slot(level)].clone(), self.sources[slot(level)].clone());
            if !self.one_trial(level, g, members, choice, run) {
                return None;
            }
            let mate = self.tried(far, VertexTrial { run, mate: true });
            let bar = TurningBody::Link(members[choice.left_out].link);
            let (normal, across) = self.turning(level, bar, mate, near, false);
            let gap = Term {
                kind: TermKind::Gap,
                of: mate,
                to: near,
                by: TermConnection::Turning(bar),
                known: false,
            };
            let chains = vec![
                TermChain { start: near, known: normal, unknown: across },
                TermChain { start: far, known: Vec::new(), unknown: vec![gap] },
            ];
            self.pending.push(PlanStep::Equation { target: mate, chains, method: Method::Trial });
            let all = std::mem::take(&mut self.pending);
            let moved = self.pin(choice.moved);
            let (own, kept) = self.renamed(all, moved, run);
            self.known[slot(level)] = known;
            self.sources[slot(level)] = sources;
            for step in kept {
                self.learn(level, step.target());
                steps.push(step);
            }
            steps.extend(own);
            found[usize::from(run) - 1] = [self.tried(far, VertexTrial { run, mate: false }), mate];
        }
        let [[e1, x1], [e2, x2]] = found;
        steps.push(PlanStep::Trials { target: far, images: [e1, e2], mates: [x1, x2] });
        self.learn(level, far);
        let mut states = self.states(members);
        self.known_at(&mut states, members, far, choice.left_out);
        if !self.open_all(level, g, members, &mut states) {
            return None;
        }
        self.sources_of_members(level, members);
        steps.append(&mut self.pending);
        Some(steps)
    }

    /// Finds all links but the removed bar from an assumed rate; returns true if all are known.
    fn one_trial(
        &mut self,
        level: Level,
        g: usize,
        members: &[Member],
        choice: &TrialChoice,
        run: u8,
    ) -> bool {
        let [pivot, moved] = [choice.pivot, choice.moved].map(|p| self.pin(p));
        let link = members[choice.tried].link;
        let (mut known, unknown) =
            self.turning(level, TurningBody::Link(link), moved, pivot, false);
        if run == 2 {
            known.extend(unknown.into_iter().map(|t| Term { known: true, ..t }));
        }
        self.equation(
            level,
            moved,
            vec![TermChain { start: pivot, known, unknown: Vec::new() }],
            Method::Trial,
        );
        let mut states = self.states(members);
        // A bar marked as done gets no known pins, so that it holds nothing.
        states[choice.left_out].done = true;
        self.known_at(&mut states, members, moved, choice.tried);
        self.open_all(level, g, members, &mut states)
    }

    /// Splits steps into those that depend on the rate, with the vertices of a trial, and those
    /// that do not.
    fn renamed(
        &mut self,
        steps: Vec<PlanStep>,
        moved: VertexId,
        run: u8,
    ) -> (Vec<PlanStep>, Vec<PlanStep>) {
        let mut depend: HashSet<VertexId> = HashSet::from([moved]);
        let (mut own, mut kept) = (Vec::new(), Vec::new());
        for step in steps {
            let target = step.target();
            let tried = self.vertices[target.0].trial.is_some();
            if !tried && target != moved && !step.sources().iter().any(|v| depend.contains(v)) {
                kept.push(step);
                continue;
            }
            if !tried {
                depend.insert(target);
            }
            let mut name = |v: VertexId| {
                if depend.contains(&v) {
                    self.tried(v, VertexTrial { run, mate: false })
                } else {
                    v
                }
            };
            own.push(step.with_vertices(&mut name));
        }
        (own, kept)
    }
}

impl PlanStep {
    /// Returns the step with other vertices.
    fn with_vertices(self, name: &mut impl FnMut(VertexId) -> VertexId) -> PlanStep {
        let terms = |terms: Vec<Term>, name: &mut dyn FnMut(VertexId) -> VertexId| -> Vec<Term> {
            terms.into_iter().map(|t| Term { of: name(t.of), to: name(t.to), ..t }).collect()
        };
        match self {
            PlanStep::Equation { target, chains, method: _ } => {
                let chains = chains.into_iter().map(|c| TermChain {
                    start: name(c.start),
                    known: terms(c.known, name),
                    unknown: terms(c.unknown, name),
                });
                let chains = chains.collect();
                PlanStep::Equation { target: name(target), chains, method: Method::Trial }
            }
            PlanStep::Image { link, target, from: (a, b) } => {
                PlanStep::Image { link, target: name(target), from: (name(a), name(b)) }
            }
            PlanStep::Trials { target, images, mates } => PlanStep::Trials {
                target: name(target),
                images: images.map(&mut *name),
                mates: mates.map(&mut *name),
            },
            PlanStep::Same { link, target, from } => {
                PlanStep::Same { link, target: name(target), from: name(from) }
            }
        }
    }
}

/// The largest number of choices tried; fewer for a large group, so that at most `LINKS` links are
/// opened in total.
const MOST: usize = 24;
const LINKS: usize = 400;

/// Returns the choices: links with one known point for the assumed rate, and bars between two links
/// that can be removed, with either pin as the wanted one.
pub(super) fn choices(members: &[Member]) -> Vec<TrialChoice> {
    let tried: Vec<(usize, &Member)> =
        members.iter().enumerate().filter(|(_, m)| m.is_hinged()).collect();
    let bars =
        members.iter().enumerate().filter(|(_, m)| m.is_pinned_only() && m.pivots.is_empty());
    let bars =
        bars.filter_map(|(k, m)| if let [a, b] = m.shared[..] { Some((k, [a, b])) } else { None });
    let ends = bars.flat_map(|(k, [a, b])| [(k, [a, b]), (k, [b, a])]);
    let choices = ends.flat_map(|(left_out, pins)| {
        tried.iter().filter_map(move |&(tried, member)| {
            let moved =
                *member.shared.iter().find(|p| !pins.contains(p)).or(member.shared.first())?;
            Some(TrialChoice { tried, pivot: member.pivots[0], moved, left_out, pins })
        })
    });
    choices.take((LINKS / members.len().max(1)).clamp(1, MOST)).collect()
}
