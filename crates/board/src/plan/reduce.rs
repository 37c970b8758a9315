//! Groups higher than class III drawn by their special points.
//!
//! For velocities, a link held along two lines moves like a link pinned at their crossing; with its
//! other pins it is then a bar of a smaller group. Reduced link after link in this way, a group
//! without a core is drawn by crossings of two loci. Accelerations follow in the same way, because
//! their normal parts are known from the velocities. Two links of the group that roll on one
//! another are, in the same sense, pinned at their contact: there both have the same velocity, and
//! the difference Ω²δ of their accelerations along the normal is known from the velocities. If no
//! two lines of any link open a group, only the loop equations solve it.
//!
//! # Source
//! Assur points (特殊点): N. Rosenauer, A. H. Willis, *Kinematics of Mechanisms* (1953), §§ on
//! auxiliary points.

use super::build::PlanBuilder;
use super::{
    Method, PlanStep, Rate, Special, SpecialLine, Term, TermChain, TermConnection, TermKind,
    TurningBody, VertexId, VertexPlace,
};
use hodograph_mechanism::mechanism::{Hold, Level, PairForm, Runner, Strut};
use hodograph_scene::{GuideId, LinkId, PointId, RollingId, Scene};

/// A link of the group that is not merely a bar from a known pin.
pub(super) struct Member {
    pub link: LinkId,
    /// The pins that other members carry too.
    pub shared: Vec<PointId>,
    /// The constraints by known bodies.
    pub holds: Vec<Hold>,
    /// The known pins on which the member turns.
    pub pivots: Vec<PointId>,
    /// The pairs by which the member rolls on other members.
    pub rolls: Vec<RollingId>,
    /// The constraints by other members; each can be used once that member is known.
    pub inner: Vec<(usize, Hold)>,
}

impl Member {
    /// Returns all constraints along lines, by known bodies and by other members.
    fn legs(&self) -> impl Iterator<Item = &Hold> {
        self.holds.iter().chain(self.inner.iter().map(|(_, hold)| hold))
    }

    /// Returns true for a member that turns on one known pin and has no other constraint by known
    /// bodies.
    pub fn is_hinged(&self) -> bool {
        self.holds.is_empty() && self.rolls.is_empty() && self.pivots.len() == 1
    }

    /// Returns true for a member with no other joints to members or known bodies than pins.
    pub fn is_pinned_only(&self) -> bool {
        self.holds.is_empty() && self.rolls.is_empty() && self.inner.is_empty()
    }
}

/// The known part of a member.
#[derive(Clone, Default)]
pub(super) struct MemberState {
    /// Points whose vectors are known.
    pub known: Vec<VertexId>,
    /// The lines on which its special point lies: they give no further information.
    used: Vec<HoldLine>,
    pub done: bool,
}

/// A line along which a member is held: of one of its own legs, or through a shared pin from the
/// special point of a neighbour.
#[derive(Clone, Copy, PartialEq)]
enum HoldLine {
    Leg(Hold),
    Neighbour {
        pin: PointId,
        special: VertexId,
        link: LinkId,
    },
    /// Through a contact, from the special point of the member that rolls there.
    Contact {
        pair: RollingId,
        special: VertexId,
        link: LinkId,
    },
}

impl HoldLine {
    /// True if both run through the same shared pin or the same contact.
    fn passes_with(&self, other: &HoldLine) -> bool {
        match (*self, *other) {
            (HoldLine::Neighbour { pin: a, .. }, HoldLine::Neighbour { pin: b, .. }) => a == b,
            (HoldLine::Contact { pair: a, .. }, HoldLine::Contact { pair: b, .. }) => a == b,
            (HoldLine::Leg(_) | HoldLine::Neighbour { .. } | HoldLine::Contact { .. }, _) => false,
        }
    }

    /// Returns the special point from which the line comes.
    fn from(&self) -> Option<VertexId> {
        match *self {
            HoldLine::Leg(_) => None,
            HoldLine::Neighbour { special, .. } | HoldLine::Contact { special, .. } => {
                Some(special)
            }
        }
    }
}

impl PlanBuilder<'_> {
    /// Returns the steps of a group without a core; `None` if special points do not reduce its
    /// links.
    pub(super) fn reduced(
        &mut self,
        level: Level,
        g: usize,
        members: &[Member],
    ) -> Option<Vec<PlanStep>> {
        let mut states = self.states(members);
        if !self.open_all(level, g, members, &mut states) {
            return None;
        }
        self.sources_of_members(level, members);
        Some(std::mem::take(&mut self.pending))
    }

    /// Returns the initial states of members, with known pivots only.
    pub(super) fn states(&mut self, members: &[Member]) -> Vec<MemberState> {
        members
            .iter()
            .map(|m| MemberState {
                known: m.pivots.iter().map(|pin| self.pin(*pin)).collect(),
                ..MemberState::default()
            })
            .collect()
    }

    /// Opens one link after another; returns true if all are known in the end.
    pub(super) fn open_all(
        &mut self,
        level: Level,
        g: usize,
        members: &[Member],
        states: &mut [MemberState],
    ) -> bool {
        while !states.iter().all(|s| s.done) {
            if !(0..members.len())
                .any(|i| !states[i].done && self.advance(level, g, members, states, i))
            {
                return false;
            }
        }
        true
    }

    /// Adds the sources of the angular quantities of the parts that hold the members.
    pub(super) fn sources_of_members(&mut self, level: Level, members: &[Member]) {
        for hold in members.iter().flat_map(|member| &member.holds) {
            self.sources_of(level, hold);
        }
    }

    /// Finds a further point of a member, or all of it; returns true if there was one to find.
    fn advance(
        &mut self,
        level: Level,
        g: usize,
        members: &[Member],
        states: &mut [MemberState],
        i: usize,
    ) -> bool {
        let member = &members[i];
        if let [a, b, ..] = states[i].known[..] {
            self.finish(level, members, states, i, [a, b]);
            return true;
        }
        let lines = self.lines(members, states, i);
        let ends: Vec<[Option<VertexId>; 2]> =
            lines.iter().map(|l| [l.from(), Some(self.near_of(member.link, l))]).collect();
        match states[i].known[..] {
            [start] => {
                // With one known point and one line, a second point follows.
                let through = |k: &usize| !self.in_line(&[&ends[*k][..], &[Some(start)]].concat());
                let Some(line) = (0..lines.len()).find(through).map(|k| &lines[k]) else {
                    return false;
                };
                let near = self.near_of(member.link, line);
                let rolls = if let HoldLine::Leg(hold) = line {
                    self.rolled(level, member.link, hold)
                } else {
                    None
                };
                // The points on known links are found in any case: the accelerations need the
                // sliding there.
                let second = self.chain_of(level, member.link, line);
                if rolls.is_none() {
                    let (known, unknown) =
                        self.turning(level, TurningBody::Link(member.link), near, start, false);
                    self.equation(
                        level,
                        near,
                        vec![TermChain { start, known, unknown }, second],
                        Method::SameLink,
                    );
                }
                self.known_at(states, members, near, i);
                self.across(level, members, states, near);
                true
            }
            [] => {
                let pairs =
                    (0..lines.len()).flat_map(|k| (k + 1..lines.len()).map(move |l| (k, l)));
                let crossing =
                    pairs.into_iter().find(|&(k, l)| !self.in_line(&[ends[k], ends[l]].concat()));
                let Some((k, l)) = crossing else { return false };
                let (a, b) = (&lines[k], &lines[l]);
                // The tangent at a contact and the line of its centres cross in the contact.
                let contact = [(k, l), (l, k)].into_iter().find(|&(k, l)| {
                    let tangent = matches!(lines[k], HoldLine::Leg(Hold::Rolls { .. }));
                    tangent
                        && ends[l][0].is_some()
                        && self.in_line(&[ends[k][1], ends[l][0], ends[l][1]])
                });
                let lines_of = [a, b].map(|line| special_line(self.scene, line));
                let special = Special {
                    group: g,
                    link: member.link,
                    with: None,
                    lines: lines_of,
                    legs: None,
                };
                let s =
                    contact.and_then(|(k, _)| ends[k][1]).unwrap_or_else(|| self.special(special));
                let rolls = contact.and_then(|(k, _)| {
                    if let HoldLine::Leg(hold) = lines[k] {
                        self.rolled(level, member.link, &hold)
                    } else {
                        None
                    }
                });
                let mut chains = Vec::new();
                for line in [a, b] {
                    let near = self.near_of(member.link, line);
                    let mut chain = self.chain_of(level, member.link, line);
                    if near != s {
                        self.extend_to_special(level, &mut chain, member.link, s, near);
                    }
                    chains.push(chain);
                }
                if rolls.is_none() {
                    self.equation(level, s, chains, Method::Special);
                }
                states[i].known.push(s);
                states[i].used = vec![*a, *b];
                true
            }
            _ => false,
        }
    }

    /// Finds all pins of a member with two known points, by images.
    fn finish(
        &mut self,
        level: Level,
        members: &[Member],
        states: &mut [MemberState],
        i: usize,
        [a, b]: [VertexId; 2],
    ) {
        let member = &members[i];
        self.source(level, TurningBody::Link(member.link), Rate::Measured { of: b, to: a });
        let pins = self.scene.links[member.link.0].points.iter().copied();
        for pin in pins
            .filter(|p| member.shared.contains(p) || member.legs().any(|h| h.near() == Some(*p)))
            .collect::<Vec<_>>()
        {
            let v = self.pin(pin);
            if !self.is_known(level, v) {
                self.pending.push(PlanStep::Image { link: member.link, target: v, from: (a, b) });
                self.learn(level, v);
            }
            self.known_at(states, members, v, i);
        }
        for hold in member.legs() {
            if let Some(near) = self.near(member.link, hold)
                && !self.is_known(level, near)
            {
                self.pending.push(PlanStep::Image {
                    link: member.link,
                    target: near,
                    from: (a, b),
                });
                self.learn(level, near);
            }
        }
        states[i].done = true;
        for &pair in &member.rolls {
            let contact =
                self.coincident(self.scene.rolling[pair.0].at_of(member.link), member.link);
            if !self.is_known(level, contact) {
                self.pending.push(PlanStep::Image {
                    link: member.link,
                    target: contact,
                    from: (a, b),
                });
                self.learn(level, contact);
            }
            self.across(level, members, states, contact);
        }
    }

    /// Finds the point of contact on one member from the known point of contact on the other.
    fn across(
        &mut self,
        level: Level,
        members: &[Member],
        states: &mut [MemberState],
        found: VertexId,
    ) {
        for member in members {
            for &pair in &member.rolls {
                let rolling = &self.scene.rolling[pair.0];
                let Some(other) = rolling.other(member.link) else { continue };
                let (own, from) = (
                    self.coincident(rolling.at_of(member.link), member.link),
                    self.coincident(rolling.at_of(other), other),
                );
                if from != found || self.is_known(level, own) {
                    continue;
                }
                let known = self.roll(level, pair, own, from);
                self.equation(
                    level,
                    own,
                    vec![TermChain { start: from, known, unknown: Vec::new() }],
                    Method::Coincident,
                );
                if let Some(k) = members.iter().position(|m| m.link == member.link) {
                    self.known_at(states, members, own, k);
                }
            }
        }
    }

    /// Returns the difference between the points of two links at a contact: nothing for the
    /// velocity, Ω²δ for the acceleration.
    pub(super) fn roll(
        &mut self,
        level: Level,
        pair: RollingId,
        of: VertexId,
        to: VertexId,
    ) -> Vec<Term> {
        if level == Level::Velocity {
            return Vec::new();
        }
        for link in self.scene.rolling[pair.0].links {
            self.need_rate(TurningBody::Link(link));
        }
        vec![Term { kind: TermKind::Roll, of, to, by: TermConnection::Contact(pair), known: true }]
    }

    /// True if points are permanently on the line of centres of one contact: no two loci cross
    /// there.
    fn in_line(&self, points: &[Option<VertexId>]) -> bool {
        let points: Option<Vec<PointId>> = points
            .iter()
            .map(|v| match self.vertices[(*v)?.0].spot {
                VertexPlace::Point(p) => Some(p),
                VertexPlace::Special(_) => None,
            })
            .collect();
        let Some(points) = points else { return false };
        self.scene.rolling.iter().any(|r| {
            let on = |p: &PointId| r.at.contains(p) || r.centres().contains(&Some(*p));
            points.iter().all(on)
        })
    }

    /// Marks a known pin as known on all members that carry it.
    pub(super) fn known_at(
        &mut self,
        states: &mut [MemberState],
        members: &[Member],
        v: VertexId,
        found_on: usize,
    ) {
        for (k, (member, state)) in members.iter().zip(states.iter_mut()).enumerate() {
            let shares = member.shared.iter().any(|p| self.pin(*p) == v);
            if (shares || k == found_on) && !state.done && !state.known.contains(&v) {
                state.known.push(v);
            }
        }
    }

    /// Returns the lines along which known parts hold a member.
    fn lines(&mut self, members: &[Member], states: &[MemberState], i: usize) -> Vec<HoldLine> {
        let inner =
            members[i].inner.iter().filter(|(other, _)| states[*other].done).map(|(_, hold)| hold);
        let own = members[i].holds.iter().chain(inner).map(|h| HoldLine::Leg(*h));
        let through = members[i].shared.iter().flat_map(|&pin| {
            let others = members
                .iter()
                .zip(states)
                .enumerate()
                .filter(move |(k, (m, _))| *k != i && m.shared.contains(&pin));
            // The line back to the source of a neighbour's point gives nothing new.
            others.filter_map(move |(_, (m, s))| match s.known[..] {
                [special] => {
                    let line = HoldLine::Neighbour { pin, special, link: m.link };
                    (!s.used.iter().any(|l| l.passes_with(&line))).then_some(line)
                }
                _ => None,
            })
        });
        let over = members[i].rolls.iter().flat_map(|&pair| {
            let others = members
                .iter()
                .zip(states)
                .enumerate()
                .filter(move |(k, (m, _))| *k != i && m.rolls.contains(&pair));
            others.filter_map(move |(_, (m, s))| match s.known[..] {
                [special] => {
                    let line = HoldLine::Contact { pair, special, link: m.link };
                    (!s.used.iter().any(|l| l.passes_with(&line))).then_some(line)
                }
                _ => None,
            })
        });
        let lines: Vec<HoldLine> = own.chain(through).chain(over).collect();
        let used = |l: &HoldLine| states[i].used.iter().any(|u| u == l || u.passes_with(l));
        lines.into_iter().filter(|l| !used(l)).collect()
    }

    /// Returns the point of a member on a line.
    fn near_of(&mut self, link: LinkId, line: &HoldLine) -> VertexId {
        match line {
            HoldLine::Leg(hold) => {
                self.near(link, hold).expect("a leg with a line has a point on the link")
            }
            HoldLine::Neighbour { pin, .. } => self.pin(*pin),
            HoldLine::Contact { pair, .. } => {
                self.coincident(self.scene.rolling[pair.0].at_of(link), link)
            }
        }
    }

    fn chain_of(&mut self, level: Level, link: LinkId, line: &HoldLine) -> TermChain {
        match *line {
            HoldLine::Leg(hold) => self.chain(level, Some(link), &hold, None),
            HoldLine::Neighbour { pin, special, link } => {
                let near = self.pin(pin);
                let (known, unknown) =
                    self.turning(level, TurningBody::Link(link), near, special, false);
                TermChain { start: special, known, unknown }
            }
            HoldLine::Contact { pair, special, link: other } => {
                let rolling = &self.scene.rolling[pair.0];
                let (own, near) = (
                    self.coincident(rolling.at_of(link), link),
                    self.coincident(rolling.at_of(other), other),
                );
                let (mut known, unknown) =
                    self.turning(level, TurningBody::Link(other), near, special, false);
                known.extend(self.roll(level, pair, own, near));
                TermChain { start: special, known, unknown }
            }
        }
    }
}

fn special_line(scene: &Scene, line: &HoldLine) -> SpecialLine {
    match line {
        HoldLine::Leg(hold) => SpecialLine::Leg(hold.line().expect("members are held along lines")),
        HoldLine::Neighbour { pin, special, .. } => {
            SpecialLine::Through { pin: *pin, special: *special }
        }
        HoldLine::Contact { pair, special, link } => {
            SpecialLine::Through { pin: scene.rolling[pair.0].at_of(*link), special: *special }
        }
    }
}

/// Returns the members of a group with their constraints; `None` if the group has a pair that is
/// neither a bar, guide, slot, cylinder or contact between a member and a known body, nor a pin,
/// slot or contact between members.
pub(super) fn members(
    scene: &Scene,
    m: &hodograph_mechanism::mechanism::Mechanism,
    g: usize,
) -> Option<Vec<Member>> {
    let group = &m.groups[g];
    let forms: Vec<PairForm> = group.constraints.iter().map(|&c| m.constraints[c].form()).collect();
    let on = |l: LinkId| -> Vec<PointId> {
        forms
            .iter()
            .filter_map(PairForm::meets)
            .filter(|(_, link)| *link == l)
            .map(|(pin, _)| pin)
            .collect()
    };
    let inner = |p: &PointId| group.pins.contains(p);
    // A bar from a known pin without other constraints is a leg of the link at its other end.
    let alone = |l: LinkId| {
        !forms.iter().any(|form| match form {
            PairForm::OnPath { runner: Runner::Pin(_), .. } | PairForm::Related { .. } => {
                form.joins(l)
            }
            PairForm::Meet { .. } | PairForm::Distance { .. } => false,
            PairForm::Angles { .. }
            | PairForm::OnPath { runner: Runner::Link(_), .. }
            | PairForm::AlongPath { .. } => true,
        })
    };
    let bar = |l: LinkId| match on(l)[..] {
        [a, b] if alone(l) && inner(&a) && !inner(&b) => Some((l, a, b)),
        [a, b] if alone(l) && inner(&b) && !inner(&a) => Some((l, b, a)),
        _ => None,
    };
    let bars: Vec<(LinkId, PointId, PointId)> =
        group.links.iter().filter_map(|l| bar(*l)).collect();
    let cores: Vec<LinkId> =
        group.links.iter().copied().filter(|l| !bars.iter().any(|b| b.0 == *l)).collect();
    let holder = |p: PointId| -> Vec<LinkId> {
        cores.iter().copied().filter(|l| on(*l).contains(&p)).collect()
    };
    let mut members: Vec<Member> = cores
        .iter()
        .map(|l| Member {
            link: *l,
            shared: Vec::new(),
            holds: Vec::new(),
            pivots: Vec::new(),
            rolls: Vec::new(),
            inner: Vec::new(),
        })
        .collect();
    let between_members = |r: RollingId| scene.rolling[r.0].links.iter().all(|l| cores.contains(l));
    let mut add = |l: LinkId, hold: Hold| -> Option<()> {
        members.iter_mut().find(|m| m.link == l)?.holds.push(hold);
        Some(())
    };
    // A constraint on a pin belongs to the first member that carries it: the others are pinned to
    // that member.
    for &(link, near, far) in &bars {
        add(*holder(near).first()?, Hold::Distance { near, far, strut: Strut::Bar(link) })?;
    }
    let mut contacts: Vec<(RollingId, [LinkId; 2])> = Vec::new();
    let mut slots: Vec<(PointId, GuideId, [LinkId; 2])> = Vec::new();
    // Index of the end in the group, if the other end is known.
    let ends = |[a, b]: [bool; 2]| if a == b { None } else { Some(usize::from(b)) };
    for form in &forms {
        match *form {
            PairForm::Meet { .. } => {}
            // The rolling pair already records a contact between members.
            PairForm::OnPath { guide, .. }
                if scene.guides[guide.0].rolling.is_some_and(between_members) => {}
            PairForm::OnPath { runner: Runner::Pin(pin), guide, on } => {
                if let Some(&carrier) = holder(pin).first()
                    && inner(&pin)
                    && cores.contains(&on)
                {
                    slots.push((pin, guide, [carrier, on]));
                } else if inner(&pin) && !group.links.contains(&on) {
                    add(*holder(pin).first()?, Hold::Guide { pin, guide, driver: None })?;
                } else if !inner(&pin) && cores.contains(&on) {
                    add(on, Hold::Slot { pin, guide })?;
                } else {
                    return None;
                }
            }
            PairForm::Distance { from, to, driver } => {
                let pins = [from, to];
                let own = ends(pins.map(|p| inner(&p)))?;
                let (near, far) = (pins[own], pins[1 - own]);
                add(
                    *holder(near).first()?,
                    Hold::Distance { near, far, strut: Strut::Cylinder(driver) },
                )?;
            }
            PairForm::Related { pair, links } if links.iter().all(|l| group.links.contains(l)) => {
                // For a strand between two unknown links, neither end determines the other: the
                // strand turns with an arm.
                scene.rolling[pair.0].contact()?;
                contacts.push((pair, links));
            }
            PairForm::Related { pair, links } => {
                let own = ends(links.map(|l| group.links.contains(&l)))?;
                add(
                    links[own],
                    Hold::Rolls {
                        pair,
                        other: links[1 - own],
                        at: scene.rolling[pair.0].at_of(links[own]),
                    },
                )?;
            }
            PairForm::Angles { .. }
            | PairForm::OnPath { runner: Runner::Link(_), .. }
            | PairForm::AlongPath { .. } => return None,
        }
    }
    let at = |l: LinkId| cores.iter().position(|core| *core == l);
    for (pin, guide, [carrier, on]) in slots {
        let (carrier, on) = (at(carrier)?, at(on)?);
        members[carrier].inner.push((on, Hold::Guide { pin, guide, driver: None }));
        members[on].inner.push((carrier, Hold::Slot { pin, guide }));
    }
    for member in &mut members {
        member.rolls.extend(
            contacts
                .iter()
                .filter(|(_, links)| links.contains(&member.link))
                .map(|(pair, _)| *pair),
        );
        for p in on(member.link) {
            if !inner(&p) {
                member.pivots.push(p);
            } else if holder(p).len() > 1 {
                member.shared.push(p);
            }
        }
    }
    Some(members)
}
