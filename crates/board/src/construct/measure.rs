//! What is measured on the board, angular rates and sliding velocities, and the known vectors that are calculated from it and laid off.

use super::board::Board;
use super::pencil::Pencil;
use super::scale::{self, Si};
use super::{Action, Mark, Polygon, RateMeasured, RateReading};
use crate::plan::{Body, By, Rate, Spot, Term, TermKind, VertexId};
use hodograph_base::diag::Faults;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_mechanism::position::Path;
use hodograph_scene::{DiagramKind, Normal, RollingId, Touch};

impl<N: Real, P: Pencil<N>> Board<'_, N, P> {
    /// ω or α of a body from what was read so far.
    pub(super) fn rate(&self, on: DiagramKind, body: Body) -> N {
        if let Body::Link(l) = body
            && self.m.never_turns[l.0]
        {
            return N::from_f64(0.0);
        }
        self.done.rate(on, body).expect("the plan finds an angular rate before it uses it")
    }

    /// Finds the turning of a body; needed ones that come earlier in the list are there already. Whether it is known now.
    pub(super) fn turning(&mut self, p: &mut Polygon<N>, body: Body, rate: Rate) -> bool {
        let on = p.on;
        if self.done.rate(on, body).is_some() {
            return true;
        }
        let zero = N::from_f64(0.0);
        let known = |value| RateReading { on, body, value, measured: None };
        let reading = match rate {
            _ if self.stands(on) => known(zero),
            Rate::Zero => known(zero),
            Rate::Same(other) => known(self.rate(on, Body::Link(other))),
            Rate::Given { driver, against } => {
                let own = self.given(on, driver);
                // The driver counts from `against` to its link; a link that is driven "backwards" has the opposite sign.
                let forward = self.scene.drivers[driver].kind.turned().is_some_and(|(link, _)| Body::Link(link) == body);
                let own = if forward { own } else { -own };
                known(self.rate(on, Body::Link(against)) + own)
            }
            Rate::Measured { of, to } => {
                let Some([from, end]) = self.measured_between(p, body, of, to) else { return false };
                let mu: N = scale::number(p.mu);
                let r = self.arm_of(body, of, to);
                let l = r.norm();
                let drawn = self.pencil.read(on, end.1 - from.1);
                // Carried back to the link: the part square to the arm turns it.
                let square = (r * (N::from_f64(1.0) / l)).cross(drawn);
                let length = square.magnitude();
                RateReading {
                    on,
                    body,
                    value: square * mu / l,
                    measured: Some(RateMeasured { length, arm: l, line: (of, to), marks: [from, end] }),
                }
            }
        };
        self.done.rates.push(reading);
        p.actions.push(Action::Rate(self.done.rates.len() - 1));
        true
    }

    /// The two marks from whose distance a turning is measured: the images of two points of a link; for accelerations, and for the line of
    /// a cylinder, the ends of the part square to the arm. `None` as long as they are not there.
    fn measured_between(&self, p: &Polygon<N>, body: Body, of: VertexId, to: VertexId) -> Option<[(Mark, Point<N>); 2]> {
        let kind = match (p.on, body) {
            (DiagramKind::Acceleration, _) => TermKind::Tangential,
            (_, Body::Cylinder(_)) => TermKind::Relative,
            (_, Body::Link(_)) => return Some([(self.mark(to), p.images[to.0]?), (self.mark(of), p.images[of.0]?)]),
        };
        let wanted = Term { kind, of, to, by: By::Turning(body), known: false };
        p.edge_of(&[wanted]).map(|(marks, _)| marks)
    }

    /// A known term.
    pub(super) fn known_vector(&mut self, p: &Polygon<N>, term: &Term) -> Result<Si<N>, Faults> {
        let two = N::from_f64(2.0);
        let arm = || self.arm(term.of, term.to);
        let turning = |body| self.arm_of(body, term.of, term.to);
        Ok(Si(match (term.kind, term.by) {
            (TermKind::Relative, By::Turning(body)) => turning(body).perp() * self.rate(DiagramKind::Velocity, body),
            (TermKind::Normal, By::Turning(body)) => {
                let omega = self.rate(DiagramKind::Velocity, body);
                turning(body) * -(omega * omega)
            }
            (TermKind::Tangential, By::Turning(body)) => turning(body).perp() * self.rate(DiagramKind::Acceleration, body),
            (TermKind::Extension, By::Cylinder(d)) => {
                let e = arm().unit().ok_or_else(|| Faults::from(self.coincide(term.of, term.to)))?;
                e * self.given(p.on, d)
            }
            (TermKind::Coriolis, By::Cylinder(d)) => {
                let e = arm().unit().ok_or_else(|| Faults::from(self.coincide(term.of, term.to)))?;
                e.perp() * (two * self.rate(DiagramKind::Velocity, Body::Cylinder(d)) * self.given(DiagramKind::Velocity, d))
            }
            (TermKind::Slide, By::Guide { driver: Some(d), .. }) => {
                let given = self.given(p.on, d);
                self.guide_tangent(term) * if self.reversed(term) { -given } else { given }
            }
            (TermKind::Coriolis, By::Guide { guide, .. }) => {
                let omega = self.rate(DiagramKind::Velocity, Body::Link(self.plan.coriolis_link(self.scene, guide)));
                self.slide_velocity(term).0.perp() * (two * omega)
            }
            (TermKind::SlideNormal, By::Frame { about: Some(centre), .. }) => {
                let Si(v) = self.slide_velocity(term);
                let Spot::Point(own) = self.plan.vertex(term.of).spot else { unreachable!("a moving point is a point") };
                let inward = self.at.point(centre) - self.at.point(own);
                inward * (v.norm2() / inward.norm2())
            }
            (TermKind::Coriolis, By::Frame { body: Some(body), .. }) => {
                let omega = self.rate(DiagramKind::Velocity, body);
                self.slide_velocity(term).0.perp() * (two * omega)
            }
            (TermKind::SlideNormal, By::Guide { guide, .. }) => {
                let Path::Arc { centre, radius } = self.at.guide(guide) else { unreachable!("only arcs have a normal part of sliding") };
                let Si(v) = self.slide_velocity(term);
                let Spot::Point(pin) = self.plan.vertex(term.of).spot else { unreachable!("a runner is a point") };
                let inward = self.turned(guide, (centre - self.at.point(pin)) * (N::from_f64(1.0) / radius));
                let size = v.norm2() / radius;
                inward * if self.reversed(term) { -size } else { size }
            }
            (TermKind::Roll, By::Contact(pair)) => {
                let links = self.scene.rolling[pair.0].links;
                let [one, other] = links.map(|l| self.rate(DiagramKind::Velocity, Body::Link(l)));
                let way = if self.plan.vertex(term.of).on == Some(links[0]) { -1.0 } else { 1.0 };
                self.contact_radius(pair, term.of) * ((other - one) * (other - one) * N::from_f64(way))
            }
            _ => unreachable!("this kind of term is never known"),
        }))
    }

    /// δn at a contact: δ = ρ₁ρ₂/(ρ₁ + ρ₂), of a straight track ρ of the wheel, n from the first link to the second; the radii as the contact divides the
    /// line of centres, so that (ρ₁ + ρ₂)n is that line.
    fn contact_radius(&self, pair: RollingId, contact: VertexId) -> Vec2<N> {
        let rolling = &self.scene.rolling[pair.0];
        let [a, b] = rolling.sizes(&self.inputs);
        let drawn = |line: Option<Vec2<N>>| line.expect("the centres at a contact are drawn") * self.mu;
        match rolling.touch() {
            Touch::Point(Normal::Centres([p, q])) => {
                drawn(self.joint(p).zip(self.joint(q)).map(|(p, q)| q - p)) * (a * b / ((a + b) * (a + b)))
            }
            Touch::Point(Normal::Square { centre, .. }) => {
                drawn(self.joint(centre).zip(self.done.diagram.spots[contact.0]).map(|(k, q)| k - q))
            }
            Touch::Strand { .. } => unreachable!("what the ends of a strand differ by across it is never known"),
        }
    }

    fn given(&self, on: DiagramKind, driver: usize) -> N {
        let d = &self.scene.drivers[driver];
        match on {
            DiagramKind::Acceleration => d.acceleration.as_ref().map_or(N::from_f64(0.0), |a| self.inputs.number(a)),
            DiagramKind::Plane | DiagramKind::Velocity => self.inputs.number(&d.rate),
        }
    }

    /// Sliding velocity between the two points of a term, measured on the velocity polygon.
    fn slide_velocity(&mut self, term: &Term) -> Si<N> {
        let v = self.done.polygon(DiagramKind::Velocity).expect("velocities are drawn before accelerations");
        let (drawn, mu) = (self.image(v, term.of) - self.image(v, term.to), v.mu);
        Si::measured(self.pencil.read(DiagramKind::Velocity, drawn), mu)
    }
}
