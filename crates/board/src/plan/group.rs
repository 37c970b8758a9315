//! The equations of one group, by the kind of its core.

use super::build::{PlanBuilder, slot};
use super::common::{Common, commons};
use super::reduce::members;
use super::trials::{TrialChoice, choices};
use super::{Method, PlanStep, Rate, Special, SpecialLine, TermChain, TurningBody, VertexId};
use hodograph_mechanism::mechanism::{Core, CoreLoci, Hold, Leg, Level, Strut};
use hodograph_scene::{LinkId, PointId, RollingId, Scene, Touch};

/// A way to draw a group of higher class.
enum GroupMethod<'a> {
    /// By the special points of its links.
    Special,
    /// By the common point of two links.
    Common(&'a Common),
    /// By two trials.
    Trials(&'a TrialChoice),
}

impl PlanBuilder<'_> {
    /// Returns the alternatives of one group and marks its results as known. `None` if it is not
    /// drawn.
    pub(super) fn group(&mut self, level: Level, g: usize) -> Option<Vec<Vec<PlanStep>>> {
        Some(match self.m.groups[g].core.clone() {
            Core::Pin { pin, legs } => {
                self.group_of_pin(level, pin, &legs);
                vec![std::mem::take(&mut self.pending)]
            }
            Core::Link { link, legs } => self.group_of_link(level, g, link, &legs),
            Core::Higher => return self.higher(level, g).map(|steps| vec![steps]),
        })
    }

    /// Returns the steps of a group without a core: by special points, by the common point of two
    /// links, or by trial polygons. If the pose requires a later way, that one or the next one that
    /// succeeds is taken.
    fn higher(&mut self, level: Level, g: usize) -> Option<Vec<PlanStep>> {
        let members = members(self.scene, self.m, g)?;
        let (commons, choices) = (commons(&members), choices(&members));
        let ways = std::iter::once(GroupMethod::Special)
            .chain(commons.iter().map(GroupMethod::Common))
            .chain(choices.iter().map(GroupMethod::Trials));
        let first = self.way.get(&g).copied().unwrap_or(0);
        ways.skip(first).find_map(|way| {
            self.attempt(|b| match way {
                GroupMethod::Special => b.reduced(level, g, &members),
                GroupMethod::Common(common) => b.by_common_point(level, g, &members, common),
                GroupMethod::Trials(choice) => b.by_trials(level, g, &members, choice),
            })
        })
    }

    fn group_of_pin(&mut self, level: Level, pin: PointId, legs: &[Leg]) {
        let target = self.pin(pin);
        let holds = CoreLoci::of(legs).holds;
        if holds.is_empty() {
            // A known link carries the pin.
            return self.ensure(level, target);
        }
        let chains: Vec<TermChain> =
            holds.iter().map(|h| self.chain(level, None, h, None)).collect();
        let method = self.method_of_pin(&holds);
        self.equation(level, target, chains, method);
        for hold in &holds {
            self.sources_of(level, hold);
        }
    }

    /// Returns the method of a pin's equation.
    fn method_of_pin(&self, holds: &[Hold]) -> Method {
        let method = |hold: &Hold| match *hold {
            Hold::Guide { driver: Some(_), .. } => Method::Driven,
            Hold::Guide { guide, driver: None, .. }
                if self.scene.guides[guide.0].on == self.scene.ground =>
            {
                Method::SameLink
            }
            Hold::Distance { strut: Strut::Bar(_), .. } => Method::SameLink,
            Hold::Distance { strut: Strut::Cylinder(_), .. } => Method::Cylinder,
            Hold::Distance { strut: Strut::Ram { .. }, .. }
            | Hold::Guide { .. }
            | Hold::Slot { .. }
            | Hold::Glide { .. }
            | Hold::Rolls { .. } => Method::Coincident,
        };
        let methods: Vec<Method> = holds.iter().map(method).collect();
        let told = [Method::Driven, Method::Coincident, Method::Cylinder]
            .into_iter()
            .find(|m| methods.contains(m));
        told.unwrap_or(Method::SameLink)
    }

    pub(super) fn equation(
        &mut self,
        level: Level,
        target: VertexId,
        chains: Vec<TermChain>,
        method: Method,
    ) {
        // The chain that starts in the pole comes first: its terms are on the left of the equals
        // sign.
        let mut chains = chains;
        if chains.len() == 2
            && !self.vertices[chains[0].start.0].fixed
            && self.vertices[chains[1].start.0].fixed
        {
            chains.swap(0, 1);
        }
        if !self.is_known(level, target) {
            self.pending.push(PlanStep::Equation { target, chains, method });
            self.learn(level, target);
        }
    }

    /// Adds the source of a strut's angular quantity, for known ends.
    pub(super) fn sources_of(&mut self, level: Level, hold: &Hold) {
        let Hold::Distance { near, far, strut } = *hold else { return };
        let (body, of) = match strut {
            Strut::Bar(link) => (TurningBody::Link(link), self.pin(near)),
            Strut::Cylinder(driver) => (TurningBody::Cylinder(driver), self.pin(near)),
            // The carried point under the runner. The Coriolis term of the sliding needs the link's
            // ω at the acceleration level; ω is measured at the velocity level from this point.
            Strut::Ram { link, .. } => (TurningBody::Link(link), self.coincident(near, link)),
        };
        let to = self.pin(far);
        self.source(level, body, Rate::Measured { of, to });
        if let Strut::Ram { guide, driver, .. } = strut {
            // From the runner: the sliding is given.
            let runner = self.pin(near);
            let (terms, _) = self.sliding(level, guide, of, runner, Some(driver));
            self.equation(
                level,
                of,
                vec![TermChain { start: runner, known: terms, unknown: vec![] }],
                Method::Coincident,
            );
        }
    }

    fn group_of_link(
        &mut self,
        level: Level,
        g: usize,
        link: LinkId,
        legs: &[Leg],
    ) -> Vec<Vec<PlanStep>> {
        let body = TurningBody::Link(link);
        let CoreLoci { pivot, angle, holds, .. } = CoreLoci::of(legs);
        if let Some((of, driver)) = angle {
            let rate = match driver {
                _ if self.m.never_turns[link.0] => Rate::Zero,
                Some(driver) => Rate::Given { driver, against: of },
                None => Rate::Same(of),
            };
            self.source(level, body, rate);
        }
        match (pivot, angle, &holds[..]) {
            // A crank, or a lever locked to a known link: its points follow on request.
            (Some(_), Some(_), _) => {}
            (Some(pin), None, [hold]) => {
                let pivot = self.pin(pin);
                let target = self.rolled(level, link, hold).unwrap_or_else(|| {
                    let target = self.near(link, hold).expect("a slot gives a coincident point");
                    let (known, unknown) = self.turning(level, body, target, pivot, false);
                    let chain = self.chain(level, Some(link), hold, None);
                    let method = if let Hold::Rolls { pair, .. } = *hold {
                        self.touching(pair)
                    } else {
                        Method::Coincident
                    };
                    self.equation(
                        level,
                        target,
                        vec![TermChain { start: pivot, known, unknown }, chain],
                        method,
                    );
                    target
                });
                self.source(level, body, Rate::Measured { of: target, to: pivot });
            }
            (None, Some(_), [hold @ Hold::Glide { driver: Some(_), .. }]) => {
                let at = self.any_point(link);
                let chain = self.chain(level, Some(link), hold, Some(at));
                self.equation(level, at, vec![chain], Method::Driven);
            }
            (None, Some(_), [a, b])
                if [a, b].into_iter().any(|h| self.rolled(level, link, h).is_some()) =>
            {
                let target = [a, b]
                    .into_iter()
                    .find_map(|h| self.near(link, h))
                    .expect("a contact is a point of the link");
                for hold in [a, b] {
                    // Adds the points on known links: the accelerations need the sliding there.
                    let _ = self.chain(level, Some(link), hold, Some(target));
                }
                self.ensure(level, target);
                for hold in [a, b] {
                    if let Some(near) = self.near(link, hold) {
                        self.ensure(level, near);
                    }
                    self.sources_of(level, hold);
                }
            }
            (None, Some(_), [a, b]) => {
                // A leg with a point of its own comes first; a gliding leg serves any point.
                let (a, b) = if matches!(a, Hold::Glide { .. }) { (b, a) } else { (a, b) };
                let target = match self.near(link, a) {
                    Some(v) => v,
                    None => self.any_point(link),
                };
                let first = self.chain(level, Some(link), a, Some(target));
                let mut second = self.chain(level, Some(link), b, Some(target));
                if let Some(near) = self.near(link, b) {
                    self.shift(level, &mut second, link, target, near);
                }
                self.equation(level, target, vec![first, second], Method::Coincident);
                let near_b = self.near(link, b);
                for hold in [a, b] {
                    self.sources_of(level, hold);
                }
                if let Some(v) = near_b {
                    self.ensure(level, v);
                }
            }
            (None, None, [_, _, _]) => match in_contact(self.scene, &holds) {
                Some((pair, other, third)) => {
                    self.pinned_at_contact(level, link, (pair, other), &holds[third])
                }
                None => return self.triad(level, g, link, &holds),
            },
            _ => {}
        }
        vec![std::mem::take(&mut self.pending)]
    }

    /// Finds the velocity of a link's point at which it rolls on a known link, or at which a strand
    /// between fixed axes meets it: it equals the velocity of the other link's point there,
    /// independent of the other constraints. `None` for accelerations, which differ across the
    /// contact or the strand, and if nothing rolls.
    pub(super) fn rolled(&mut self, level: Level, link: LinkId, hold: &Hold) -> Option<VertexId> {
        let Hold::Rolls { pair, other, .. } = *hold else { return None };
        let alike = match self.scene.rolling[pair.0].touch() {
            Touch::Point(_) => self.scene.rolling[pair.0].contact().is_some(),
            Touch::Strand { arm, .. } => self.m.never_turns[arm.0],
        };
        (alike && level == Level::Velocity).then(|| self.at_contact(level, link, (pair, other)))
    }

    /// Finds the point of a link at its contact with a known one, with all terms of the difference.
    fn at_contact(
        &mut self,
        level: Level,
        link: LinkId,
        (pair, other): (RollingId, LinkId),
    ) -> VertexId {
        let rolling = &self.scene.rolling[pair.0];
        let (own, from) = (
            self.coincident(rolling.at_of(link), link),
            self.coincident(rolling.at_of(other), other),
        );
        self.ensure(level, from);
        let known = self.roll(level, pair, own, from);
        self.equation(
            level,
            own,
            vec![TermChain { start: from, known, unknown: Vec::new() }],
            self.touching(pair),
        );
        own
    }

    /// Returns the method for two links that roll on one another, or are wheels of one belt.
    fn touching(&self, pair: RollingId) -> Method {
        match self.scene.rolling[pair.0].touch() {
            Touch::Point(_) => Method::Coincident,
            Touch::Strand { .. } => Method::Strand,
        }
    }

    /// Finds the velocities of a link on three legs that rolls on a known link: its point at the
    /// contact is known, and a second point follows from another contact or from a leg with a line
    /// that does not run through the first. Returns true if they are found in this way.
    fn by_contacts(
        &mut self,
        level: Level,
        link: LinkId,
        holds: &[Hold],
        nears: &[VertexId],
    ) -> bool {
        let scene = self.scene;
        let touches = |h: &Hold| matches!(*h, Hold::Rolls { pair, .. } if scene.rolling[pair.0].contact().is_some());
        let Some(first) = holds.iter().position(touches).filter(|_| level == Level::Velocity)
        else {
            return false;
        };
        let others = || (0..holds.len()).filter(|n| *n != first);
        let apart = |n: &usize| contact_on_bar(scene, &holds[first], &holds[*n]).is_none();
        let Some(second) = others().find(|n| touches(&holds[*n])).or_else(|| others().find(apart))
        else {
            return false;
        };
        let (own, near) = (nears[first], nears[second]);
        self.rolled(level, link, &holds[first]);
        if self.rolled(level, link, &holds[second]).is_none() {
            let (known, unknown) = self.turning(level, TurningBody::Link(link), near, own, false);
            let chain = self.chain(level, Some(link), &holds[second], None);
            self.equation(
                level,
                near,
                vec![TermChain { start: own, known, unknown }, chain],
                Method::SameLink,
            );
        }
        for n in others().filter(|n| *n != second) {
            if !self.is_known(level, nears[n]) {
                self.pending.push(PlanStep::Image { link, target: nears[n], from: (own, near) });
                self.learn(level, nears[n]);
            }
        }
        true
    }

    /// Writes a link that touches a known link and rolls on it: at the contact both have the same
    /// velocity, and the difference of their accelerations is known, like at a pin.
    fn pinned_at_contact(
        &mut self,
        level: Level,
        link: LinkId,
        (pair, other): (RollingId, LinkId),
        third: &Hold,
    ) {
        let own = self.at_contact(level, link, (pair, other));
        let near = self.near(link, third).expect("a leg of a triad has a point on the core");
        if self.rolled(level, link, third).is_none() {
            let (known, unknown) = self.turning(level, TurningBody::Link(link), near, own, false);
            let chain = self.chain(level, Some(link), third, None);
            self.equation(
                level,
                near,
                vec![TermChain { start: own, known, unknown }, chain],
                Method::SameLink,
            );
        }
        self.source(level, TurningBody::Link(link), Rate::Measured { of: near, to: own });
        self.sources_of(level, third);
    }

    /// Returns any point of a link that has no point of its own in this group.
    fn any_point(&mut self, link: LinkId) -> VertexId {
        let own = self.scene.links[link.0].points.first().copied();
        let runner = self.scene.guides.iter().filter(|g| g.on == link).find_map(|g| g.pin);
        match own.or(runner) {
            Some(p) => self.coincident(p, link),
            None => self.coincident(PointId(0), link),
        }
    }

    /// Returns the alternatives of a link on three legs: by the special point of each pair of legs
    /// in turn.
    fn triad(
        &mut self,
        level: Level,
        g: usize,
        link: LinkId,
        holds: &[Hold],
    ) -> Vec<Vec<PlanStep>> {
        let body = TurningBody::Link(link);
        let nears: Vec<VertexId> = holds
            .iter()
            .map(|h| self.near(link, h).expect("a leg of a triad has a point on the core"))
            .collect();
        let mut alternatives = Vec::new();
        let before = self.known[slot(level)].clone();
        // The chains' requests for known links are written once, before every alternative.
        for hold in holds {
            let _ = self.chain(level, Some(link), hold, None);
        }
        let shared = std::mem::take(&mut self.pending);
        let base = self.known[slot(level)].clone();
        for (i, j, k) in [(0, 1, 2), (0, 2, 1), (1, 2, 0)] {
            self.known[slot(level)].clone_from(&base);
            self.pending.clone_from(&shared);
            if self.by_contacts(level, link, holds, &nears) {
                alternatives.push(std::mem::take(&mut self.pending));
                continue;
            }
            let s = match contact_on_bar(self.scene, &holds[i], &holds[j]) {
                Some(n) => nears[[i, j][n]],
                None => {
                    let line = |n: usize| {
                        SpecialLine::Leg(
                            holds[n].line().expect("a leg of a triad holds along a line"),
                        )
                    };
                    self.special(Special {
                        group: g,
                        link,
                        with: None,
                        lines: [line(i), line(j)],
                        legs: Some((i, j)),
                    })
                }
            };
            let mut chains = Vec::new();
            for n in [i, j] {
                let mut chain = self.chain(level, Some(link), &holds[n], None);
                if nears[n] != s {
                    self.extend_to_special(level, &mut chain, link, s, nears[n]);
                }
                chains.push(chain);
            }
            self.equation(level, s, chains, Method::Special);
            let (known, unknown) = self.turning(level, body, nears[k], s, false);
            let third = self.chain(level, Some(link), &holds[k], None);
            self.equation(
                level,
                nears[k],
                vec![TermChain { start: s, known, unknown }, third],
                Method::SameLink,
            );
            for n in [i, j] {
                if !self.is_known(level, nears[n]) {
                    self.pending.push(PlanStep::Image {
                        link,
                        target: nears[n],
                        from: (s, nears[k]),
                    });
                    self.learn(level, nears[n]);
                }
            }
            alternatives.push(std::mem::take(&mut self.pending));
        }
        // Special points are valid for this group only.
        self.known[slot(level)] = before;
        for v in base {
            self.learn(level, v);
        }
        for &v in &nears {
            self.learn(level, v);
        }
        for hold in holds {
            self.sources_of(level, hold);
        }
        // Two slots over one pin have the same near point: the angular quantity is measured between
        // two different points.
        let of = nears
            .iter()
            .copied()
            .find(|v| self.vertices[v.0].spot != self.vertices[nears[0].0].spot);
        self.source(level, body, Rate::Measured { of: of.unwrap_or(nears[1]), to: nears[0] });
        alternatives
    }
}

/// Returns the pair by which a link both touches a known link and rolls on it, the known link, and
/// the index of the remaining leg.
fn in_contact(scene: &Scene, holds: &[Hold]) -> Option<(RollingId, LinkId, usize)> {
    let (pair, other) = holds.iter().find_map(|h| {
        if let Hold::Rolls { pair, other, .. } = *h { Some((pair, other)) } else { None }
    })?;
    let touches = |h: &Hold| match *h {
        Hold::Guide { guide, driver: None, .. } | Hold::Slot { guide, .. } => {
            scene.rolling[pair.0].guide() == Some(guide)
        }
        Hold::Guide { driver: Some(_), .. }
        | Hold::Distance { .. }
        | Hold::Glide { .. }
        | Hold::Rolls { .. } => false,
    };
    let rolls = |h: &Hold| matches!(*h, Hold::Rolls { pair: p, .. } if p == pair);
    let third = holds.iter().position(|h| !touches(h) && !rolls(h))?;
    (holds.len() == 3 && holds.iter().any(touches)).then_some((pair, other, third))
}

/// Returns the rolling one of two legs (0 or 1), if the other is a bar that carries both centres:
/// the bar's line and the tangent at the contact cross in the point of contact.
fn contact_on_bar(scene: &Scene, a: &Hold, b: &Hold) -> Option<usize> {
    let (pair, bar, which) = match (*a, *b) {
        (Hold::Rolls { pair, .. }, bar) => (pair, bar, 0),
        (bar, Hold::Rolls { pair, .. }) => (pair, bar, 1),
        _ => return None,
    };
    let (Hold::Distance { near, far, strut: Strut::Bar(_) }, [Some(p), Some(q)]) =
        (bar, scene.rolling[pair.0].centres())
    else {
        return None;
    };
    scene.rolling[pair.0].contact()?;
    ((p, q) == (near, far) || (p, q) == (far, near)).then_some(which)
}
