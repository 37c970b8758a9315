//! Measured quantities (angular velocities and accelerations, sliding velocities), and the known
//! vectors calculated from them.

use super::acts::{BodyRate, GivenNumber};
use super::board::{ActWriter, path_key, place_key};
use crate::construction::{Base, DiagramId, Direction, MarkId, Number, NumberId, Op};
use crate::plan::{Rate, Term, TermConnection, TermKind, TurningBody, VertexId, VertexPlace};
use hodograph_scene::{DiagramKind, Normal, PointId, RollingId, Touch};

/// A multiple of a vector, with the readings that precede it.
type VectorMultiple = (Vec<Op>, Direction, NumberId);

impl ActWriter<'_> {
    /// Returns ω or α of a body from the readings so far.
    fn rate(&mut self, on: DiagramKind, body: TurningBody) -> NumberId {
        if let TurningBody::Link(l) = body
            && self.m.never_turns[l.0]
        {
            return self.number(Number::Plain(0));
        }
        self.done
            .turning(on, body)
            .expect("the plan finds an angular rate before it uses it")
            .number
    }

    /// Finds the angular quantity of a body; those on which it depends come earlier in the list.
    /// Returns true if it is known afterwards.
    pub(super) fn turning(&mut self, on: DiagramId, body: TurningBody, rate: Rate) -> bool {
        let kind = self.kind(on);
        if self.done.turning(kind, body).is_some() {
            return true;
        }
        let mut ops = Vec::new();
        let mut measured = None;
        let number = match rate {
            _ if self.stands(on) => self.number(Number::Plain(0)),
            Rate::Zero => self.number(Number::Plain(0)),
            Rate::Same(other) => self.rate(kind, TurningBody::Link(other)),
            Rate::Given { driver, against } => {
                let own = self.driven(kind, driver);
                // The driver's rate is that of its link relative to `against`; for the opposite
                // body the sign is reversed.
                let forward = self.scene.drivers[driver]
                    .kind
                    .turned()
                    .is_some_and(|(link, _)| TurningBody::Link(link) == body);
                let own = if forward { own } else { self.number(Number::Negative(own)) };
                let base = self.rate(kind, TurningBody::Link(against));
                self.number(Number::Sum(base, own))
            }
            Rate::Measured { of, to } => {
                let Some([from, end]) = self.measured_between(on, body, of, to) else {
                    return false;
                };
                let arm = self.arm_of(body, of, to);
                // Transferred to the link: the part of the vector square to the arm gives the rate.
                let across = self.number(Number::Across { from, to: end, arm });
                let arm = self.number(Number::Length(arm));
                let mu = self.number(Number::Scale(on));
                let size = self.number(Number::Product(across, mu));
                ops.extend([Op::Number(across), Op::Number(arm)]);
                measured = Some(([across, arm], (of, to)));
                self.number(Number::Quotient(size, arm))
            }
        };
        ops.push(Op::Number(number));
        self.turns(BodyRate {
            on: kind,
            body,
            number,
            measured,
            step: self.done.construction.steps.len(),
        });
        match measured {
            Some((_, line)) => self.act_of(on, line, ops),
            None => self.act(on, ops),
        }
        true
    }

    /// Returns the two marks between which an angular quantity is measured: the images of two
    /// points of a link; for accelerations, and for the line of a cylinder, the ends of the part
    /// square to the arm. `None` if they are not drawn yet.
    fn measured_between(
        &self,
        on: DiagramId,
        body: TurningBody,
        of: VertexId,
        to: VertexId,
    ) -> Option<[MarkId; 2]> {
        let kind = match (self.kind(on), body) {
            (DiagramKind::Acceleration, _) => TermKind::Tangential,
            (_, TurningBody::Cylinder(_)) => TermKind::Relative,
            (_, TurningBody::Link(_)) => {
                return Some([self.done.image(on, to)?, self.done.image(on, of)?]);
            }
        };
        let wanted = Term { kind, of, to, by: TermConnection::Turning(body), known: false };
        self.done.edge_of(on, &[wanted]).map(|(marks, _)| marks)
    }

    /// Returns a known term as a multiple of a vector.
    pub(super) fn known_vector(&mut self, on: DiagramId, term: &Term) -> VectorMultiple {
        let velocity = DiagramKind::Velocity;
        let laid = |along, times| (Vec::new(), along, times);
        // In a trial, the chosen rate.
        let chosen = self.plan.vertex(term.of).trial.is_some();
        match (term.kind, term.by) {
            (TermKind::Relative | TermKind::Tangential, TermConnection::Turning(body))
                if chosen =>
            {
                let rate = self.given(GivenNumber::Trial(self.kind(on)));
                laid(Direction::across(self.arm_of(body, term.of, term.to)), rate)
            }
            (TermKind::Relative, TermConnection::Turning(body)) => laid(
                Direction::across(self.arm_of(body, term.of, term.to)),
                self.rate(velocity, body),
            ),
            (TermKind::Normal, TermConnection::Turning(body)) => {
                let omega = self.rate(velocity, body);
                let squared = self.number(Number::Product(omega, omega));
                laid(
                    Direction::of(self.arm_of(body, term.of, term.to)),
                    self.number(Number::Negative(squared)),
                )
            }
            (TermKind::Tangential, TermConnection::Turning(body)) => laid(
                Direction::across(self.arm_of(body, term.of, term.to)),
                self.rate(DiagramKind::Acceleration, body),
            ),
            (TermKind::Extension, TermConnection::Cylinder(d)) => laid(
                Direction::of(self.arm(term.of, term.to)).unit(),
                self.driven(self.kind(on), d),
            ),
            (TermKind::Coriolis, TermConnection::Cylinder(d)) => {
                let (omega, grows) =
                    (self.rate(velocity, TurningBody::Cylinder(d)), self.driven(velocity, d));
                let twice = self.twice(omega);
                laid(
                    Direction::across(self.arm(term.of, term.to)).unit(),
                    self.number(Number::Product(twice, grows)),
                )
            }
            (TermKind::Slide, TermConnection::Guide { driver: Some(d), guide }) => {
                let given = self.driven(self.kind(on), d);
                let given =
                    if self.reversed(term) { self.number(Number::Negative(given)) } else { given };
                laid(Direction::of(self.guide_tangent(guide, term.of)), given)
            }
            (TermKind::Coriolis, TermConnection::Guide { guide, .. }) => {
                let omega = self
                    .rate(velocity, TurningBody::Link(self.plan.coriolis_link(self.scene, guide)));
                self.coriolis(term, omega)
            }
            (TermKind::Coriolis, TermConnection::Frame { body: Some(body), .. }) => {
                let omega = self.rate(velocity, body);
                self.coriolis(term, omega)
            }
            (TermKind::SlideNormal, TermConnection::Frame { about: Some(centre), .. }) => {
                let VertexPlace::Point(own) = self.plan.vertex(term.of).spot else {
                    unreachable!("a moving point is a point")
                };
                let (own, centre) = (place_key(own), place_key(centre));
                let v = self.slide_velocity(term);
                let inward = Base::Places(own, centre);
                let (squared, apart) = (
                    self.number(Number::Square(Base::Measured(v))),
                    self.number(Number::Square(inward)),
                );
                let times = self.number(Number::Quotient(squared, apart));
                (vec![Op::Number(v)], Direction::of(inward), times)
            }
            (TermKind::SlideNormal, TermConnection::Guide { guide, .. }) => {
                let VertexPlace::Point(pin) = self.plan.vertex(term.of).spot else {
                    unreachable!("a runner is a point")
                };
                let v = self.slide_velocity(term);
                let (squared, radius) = (
                    self.number(Number::Square(Base::Measured(v))),
                    self.number(Number::Radius(path_key(guide))),
                );
                let size = self.number(Number::Quotient(squared, radius));
                let times =
                    if self.reversed(term) { self.number(Number::Negative(size)) } else { size };
                (
                    vec![Op::Number(v)],
                    Direction::of(Base::Inward(path_key(guide), place_key(pin))),
                    times,
                )
            }
            (TermKind::Roll, TermConnection::Contact(pair)) => {
                let links = self.scene.rolling[pair.0].links;
                let [one, other] = links.map(|l| self.rate(velocity, TurningBody::Link(l)));
                let way =
                    self.number(Number::Plain(if self.plan.vertex(term.of).on == Some(links[0]) {
                        -1
                    } else {
                        1
                    }));
                let against = self.number(Number::Difference(other, one));
                let squared = self.number(Number::Product(against, against));
                let times = self.number(Number::Product(squared, way));
                laid(Direction::of(self.contact_radius(pair, term.of)), times)
            }
            _ => unreachable!("this kind of term is never known"),
        }
    }

    fn twice(&mut self, number: NumberId) -> NumberId {
        let two = self.number(Number::Plain(2));
        self.number(Number::Product(two, number))
    }

    /// Returns 2ω times the sliding velocity turned by a quarter revolution.
    fn coriolis(&mut self, term: &Term, omega: NumberId) -> VectorMultiple {
        let times = self.twice(omega);
        let v = self.slide_velocity(term);
        (vec![Op::Number(v)], Direction::across(Base::Measured(v)), times)
    }

    /// Returns δn at a contact: δ = ρ₁ρ₂/(ρ₁ + ρ₂), for a straight track ρ of the wheel, n from the
    /// first link to the second. The radii divide the line of centres at the contact, so that (ρ₁ +
    /// ρ₂)n is that line.
    fn contact_radius(&mut self, pair: RollingId, contact: VertexId) -> Base {
        match self.scene.rolling[pair.0].touch() {
            Touch::Point(Normal::Centres([p, q])) => {
                let [a, b] = [0, 1].map(|i| self.given(GivenNumber::Size(pair, i)));
                let (product, sum) =
                    (self.number(Number::Product(a, b)), self.number(Number::Sum(a, b)));
                let squared = self.number(Number::Product(sum, sum));
                let part = self.number(Number::Quotient(product, squared));
                Base::Part(self.joint(p), self.joint(q), part)
            }
            Touch::Point(Normal::Square { centre, .. }) => self.arm_from(contact, centre),
            Touch::Strand { .. } => {
                unreachable!("what the ends of a strand differ by across it is never known")
            }
        }
    }

    /// Returns the arm from a vertex to a joint, in metres.
    fn arm_from(&self, v: VertexId, to: PointId) -> Base {
        let from = self.spot(v);
        Base::Arm { from, to: self.joint(to), known: false }
    }

    /// Returns the given rate or acceleration of a driver.
    fn driven(&mut self, on: DiagramKind, driver: usize) -> NumberId {
        match on {
            DiagramKind::Acceleration if self.scene.drivers[driver].acceleration.is_none() => {
                self.number(Number::Plain(0))
            }
            DiagramKind::Acceleration => self.given(GivenNumber::Acceleration(driver)),
            DiagramKind::Plane | DiagramKind::Velocity | DiagramKind::Force => {
                self.given(GivenNumber::Rate(driver))
            }
        }
    }

    /// Returns the sliding velocity between the two points of a term, measured on the velocity
    /// polygon.
    fn slide_velocity(&mut self, term: &Term) -> NumberId {
        let velocities = self
            .done
            .construction
            .diagram(DiagramKind::Velocity)
            .expect("velocities are drawn before accelerations");
        let [from, to] = [term.to, term.of].map(|v| self.image(velocities, self.plan.untried(v)));
        self.number(Number::Vector(from, to))
    }
}
