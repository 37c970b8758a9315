//! The chain of terms that a leg's constraint gives: the table of holds and loci, for velocities
//! and accelerations.
//!
//! # Source
//! Relative-motion method (基点法, 重合点法) as in any text on mechanisms; the acceleration terms are
//! those of the rigid body and of motion relative to a turning guide: a_B2 = a_B1 + 2ω₁ × v_B2B1 +
//! aʳ_B2B1.

use super::build::PlanBuilder;
use super::{Term, TermChain, TermConnection, TermKind, TurningBody, VertexId};
use hodograph_mechanism::mechanism::{Hold, Level, Strut};
use hodograph_scene::{GuideId, GuidePath, LinkId, PointId, RollingId, Touch};

impl PlanBuilder<'_> {
    /// Returns the terms of a turning body between two of its points: known ones and, unless the
    /// rate is known, the unknown one.
    pub(super) fn turning(
        &mut self,
        level: Level,
        body: TurningBody,
        of: VertexId,
        to: VertexId,
        rate_known: bool,
    ) -> (Vec<Term>, Vec<Term>) {
        let by = TermConnection::Turning(body);
        let term = |kind, known| Term { kind, of, to, by, known };
        match level {
            Level::Velocity if rate_known => (vec![term(TermKind::Relative, true)], vec![]),
            Level::Velocity => (vec![], vec![term(TermKind::Relative, false)]),
            Level::Position | Level::Acceleration => {
                self.need_rate(body);
                let mut known = vec![term(TermKind::Normal, true)];
                if !rate_known {
                    return (known, vec![term(TermKind::Tangential, false)]);
                }
                if !self.alpha_is_zero(body) {
                    known.push(term(TermKind::Tangential, true));
                }
                (known, vec![])
            }
        }
    }

    /// Returns the terms of sliding along a guide. `of`/`to` are the coincident points; `carrier`
    /// is the link that carries the guide.
    pub(super) fn sliding(
        &mut self,
        level: Level,
        guide: GuideId,
        of: VertexId,
        to: VertexId,
        driver: Option<usize>,
    ) -> (Vec<Term>, Vec<Term>) {
        let by = TermConnection::Guide { guide, driver };
        let term = |kind, known| Term { kind, of, to, by, known };
        let mut known = Vec::new();
        if level == Level::Acceleration {
            let carrier = self.scene.guides[guide.0].on;
            if !self.m.never_turns[carrier.0] {
                self.need_rate(TurningBody::Link(carrier));
                known.push(term(TermKind::Coriolis, true));
            }
            if matches!(self.scene.guides[guide.0].path, GuidePath::Arc { .. }) {
                known.push(term(TermKind::SlideNormal, true));
            }
        }
        match driver {
            None => (known, vec![term(TermKind::Slide, false)]),
            Some(d) => {
                if level == Level::Velocity || self.scene.drivers[d].acceleration.is_some() {
                    known.push(term(TermKind::Slide, true));
                }
                (known, vec![])
            }
        }
    }

    /// Returns the point of the core for which a hold directly gives a locus; `None` for a gliding
    /// link, for which any point serves.
    pub(super) fn near(&mut self, core: LinkId, hold: &Hold) -> Option<VertexId> {
        match *hold {
            Hold::Distance { near, .. } => Some(self.pin(near)),
            Hold::Guide { pin, .. } => Some(self.pin(pin)),
            Hold::Slot { pin, .. } => Some(self.coincident(pin, core)),
            Hold::Rolls { at, .. } => Some(self.coincident(at, core)),
            Hold::Glide { .. } => None,
        }
    }

    /// Returns the chain that a hold gives for its near point (for a gliding link: for `at`).
    pub(super) fn chain(
        &mut self,
        level: Level,
        core: Option<LinkId>,
        hold: &Hold,
        at: Option<VertexId>,
    ) -> TermChain {
        match *hold {
            Hold::Distance { near, far, strut } => self.strut(level, near, far, strut),
            Hold::Guide { pin, guide, driver } => self.on_guide(level, pin, guide, driver),
            Hold::Slot { pin, guide } => {
                let link = core.expect("a slot belongs to the core link");
                let (of, to) = (self.coincident(pin, link), self.pin(pin));
                let (known, unknown) = self.sliding(level, guide, of, to, None);
                TermChain { start: to, known, unknown }
            }
            Hold::Rolls { pair, other, at } => {
                let link = core.expect("a contact belongs to the core link");
                let (of, to) = (
                    self.coincident(at, link),
                    self.coincident(self.scene.rolling[pair.0].at_of(other), other),
                );
                self.ensure(level, to);
                let apart = Term {
                    kind: TermKind::Roll,
                    of,
                    to,
                    by: TermConnection::Contact(pair),
                    known: false,
                };
                TermChain {
                    start: to,
                    known: self.along_strand(level, pair, of, to),
                    unknown: vec![apart],
                }
            }
            Hold::Glide { guide, other, driver } => {
                self.glide(level, guide, other, driver, at.expect("a gliding link needs a point"))
            }
        }
    }

    /// Returns the difference of the two ends of a strand along it: nothing for velocities; for
    /// accelerations the normal part due to the rotation of the arm with the strand. The difference
    /// across the strand is unknown, as for two points at a contact.
    fn along_strand(
        &mut self,
        level: Level,
        pair: RollingId,
        of: VertexId,
        to: VertexId,
    ) -> Vec<Term> {
        match (self.scene.rolling[pair.0].touch(), level) {
            (Touch::Strand { arm, .. }, Level::Acceleration) if !self.m.never_turns[arm.0] => {
                let body = TurningBody::Link(arm);
                self.need_rate(body);
                vec![Term {
                    kind: TermKind::Normal,
                    of,
                    to,
                    by: TermConnection::Turning(body),
                    known: true,
                }]
            }
            (Touch::Strand { .. } | Touch::Point(_), _) => Vec::new(),
        }
    }

    /// Returns the chain of `near` from the far end of a bar, a cylinder or a ram.
    pub(super) fn strut(
        &mut self,
        level: Level,
        near: PointId,
        far: PointId,
        strut: Strut,
    ) -> TermChain {
        match strut {
            Strut::Bar(link) => {
                let (near, far) = (self.pin(near), self.pin(far));
                let (known, unknown) =
                    self.turning(level, TurningBody::Link(link), near, far, false);
                TermChain { start: far, known, unknown }
            }
            Strut::Cylinder(driver) => {
                let (near, far) = (self.pin(near), self.pin(far));
                let body = TurningBody::Cylinder(driver);
                let (mut known, unknown) = self.turning(level, body, near, far, false);
                let by = TermConnection::Cylinder(driver);
                if level == Level::Acceleration {
                    known.push(Term {
                        kind: TermKind::Coriolis,
                        of: near,
                        to: far,
                        by,
                        known: true,
                    });
                }
                if level == Level::Velocity || self.scene.drivers[driver].acceleration.is_some() {
                    known.push(Term {
                        kind: TermKind::Extension,
                        of: near,
                        to: far,
                        by,
                        known: true,
                    });
                }
                TermChain { start: far, known, unknown }
            }
            Strut::Ram { link, guide, driver } => {
                let (carried, runner, far) =
                    (self.coincident(near, link), self.pin(near), self.pin(far));
                let (mut known, unknown) =
                    self.turning(level, TurningBody::Link(link), carried, far, false);
                let (slide, _) = self.sliding(level, guide, runner, carried, Some(driver));
                known.extend(slide);
                TermChain { start: far, known, unknown }
            }
        }
    }

    fn on_guide(
        &mut self,
        level: Level,
        pin: PointId,
        guide: GuideId,
        driver: Option<usize>,
    ) -> TermChain {
        let of = self.pin(pin);
        let to = self.coincident(pin, self.scene.guides[guide.0].on);
        self.ensure(level, to);
        let (known, unknown) = self.sliding(level, guide, of, to, driver);
        TermChain { start: to, known, unknown }
    }

    fn glide(
        &mut self,
        level: Level,
        guide: GuideId,
        other: LinkId,
        driver: Option<usize>,
        at: VertexId,
    ) -> TermChain {
        let to = self.on_link(at, other);
        self.ensure(level, to);
        let (known, unknown) = self.sliding(level, guide, at, to, driver);
        TermChain { start: to, known, unknown }
    }

    /// Extends a chain for `near` to the special point `s` of the same link: the unknown parts are
    /// along one line.
    pub(super) fn extend_to_special(
        &mut self,
        level: Level,
        chain: &mut TermChain,
        link: LinkId,
        s: VertexId,
        near: VertexId,
    ) {
        let (known, unknown) = self.turning(level, TurningBody::Link(link), s, near, false);
        chain.known.extend(known);
        chain.unknown.extend(unknown);
    }

    /// Extends a chain to another point of a link with known angular quantity.
    pub(super) fn shift(
        &mut self,
        level: Level,
        chain: &mut TermChain,
        link: LinkId,
        to_point: VertexId,
        near: VertexId,
    ) {
        if to_point == near || self.m.never_turns[link.0] {
            return;
        }
        if level == Level::Velocity || !self.alpha_is_zero(TurningBody::Link(link)) {
            self.need_rate_at(level, TurningBody::Link(link));
        }
        let (known, _) = self.turning(level, TurningBody::Link(link), to_point, near, true);
        chain.known.extend(known);
    }
}
