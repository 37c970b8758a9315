//! The parts at rest at the instant because a driver has the rate 0.
//!
//! Such terms are written, with the magnitude 0, because they count at the next instant; the
//! drawing board does not lay them off. The question states whether a driver is at rest, as it
//! states whether it has an acceleration. The magnitude of the rate is irrelevant: only the rate 0
//! as written counts.

use super::{Plan, Term, TermConnection, TermKind, TurningBody};
use hodograph_mechanism::mechanism::Mechanism;
use hodograph_scene::{DiagramKind, Driver, GuidePath, Scene};

/// The parts at rest.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rest {
    /// For each driver, true if its rate is 0.
    pub drivers: Vec<bool>,
    /// For each link, true if it does not turn: for topological reasons, or because its driver is
    /// at rest.
    pub links: Vec<bool>,
}

fn is_held(d: &Driver) -> bool {
    d.rate.value == 0.0
}

impl Rest {
    /// Returns the parts of a scene at rest.
    pub fn of(scene: &Scene, m: &Mechanism) -> Rest {
        let drivers: Vec<bool> = scene.drivers.iter().map(is_held).collect();
        let mut links = m.never_turns.clone();
        if drivers.iter().all(|held| *held) {
            links.fill(true);
        } else if drivers.contains(&true) {
            while spread(scene, &drivers, &mut links) {}
        }
        Rest { drivers, links }
    }

    /// True if no driver moves, so that nothing moves.
    pub fn is_all(&self) -> bool {
        self.drivers.iter().all(|held| *held)
    }
}

/// Spreads rest from link to link over drivers at rest and over sliders that keep their direction.
fn spread(scene: &Scene, drivers: &[bool], links: &mut [bool]) -> bool {
    let turns = scene
        .drivers
        .iter()
        .zip(drivers)
        .filter(|(_, held)| **held)
        .filter_map(|(d, _)| d.kind.turned());
    let sliders = scene.guides.iter().filter_map(|g| match g.path {
        GuidePath::Line { .. } => g.slider.map(|s| (s, g.on)),
        GuidePath::Arc { .. } => None,
    });
    let mut more = false;
    for (a, b) in turns.chain(sliders) {
        if links[a.0] != links[b.0] {
            (links[a.0], links[b.0], more) = (true, true, true);
        }
    }
    more
}

impl Plan {
    /// True if a term vanishes at the instant because a driver is at rest.
    pub fn vanishes(&self, scene: &Scene, on: DiagramKind, t: &Term) -> bool {
        let rest = &self.rest;
        if rest.is_all() {
            return on == DiagramKind::Velocity
                || matches!(t.kind, TermKind::Normal | TermKind::SlideNormal | TermKind::Coriolis);
        }
        // An unknown term may turn out to be zero in the drawing, but is not known to vanish.
        if !t.known {
            return false;
        }
        let still = |body: TurningBody| matches!(body, TurningBody::Link(l) if rest.links[l.0]);
        match (t.kind, t.by) {
            (TermKind::Relative | TermKind::Normal, TermConnection::Turning(body)) => still(body),
            (TermKind::Coriolis, TermConnection::Guide { guide, driver }) => {
                rest.links[scene.guides[guide.0].on.0] || driver.is_some_and(|d| rest.drivers[d])
            }
            (TermKind::SlideNormal, TermConnection::Guide { driver, .. }) => {
                driver.is_some_and(|d| rest.drivers[d])
            }
            (TermKind::Coriolis, TermConnection::Cylinder(d)) => rest.drivers[d],
            (TermKind::Coriolis, TermConnection::Frame { body, .. }) => body.is_none_or(still),
            (TermKind::Slide, TermConnection::Guide { driver: Some(d), .. })
            | (TermKind::Extension, TermConnection::Cylinder(d)) => {
                on == DiagramKind::Velocity && rest.drivers[d]
            }
            _ => false,
        }
    }
}
