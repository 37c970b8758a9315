//! Forms: the few statements in link frames to which all pairs and drivers reduce.
//!
//! A form names its points, links and guides and the driver that gives its value, and nothing else.
//! Newton's method, the exact position equations, the motion, the loop equations and the sweep
//! match forms, and each differentiates them separately: a form contains no derivative, so
//! agreement of two of them is evidence. This module also derives what follows from a form alone:
//! the nodes that it joins, its number of equations, and the guide that a link must contain for it.

use super::super::Node;
use hodograph_scene::{GuideId, LinkId, PointId, RollingId};

/// A statement about the positions of points and links.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// A pin and the point of the same name on a link meet: two equations.
    Meet {
        /// The pin.
        pin: PointId,
        /// The link.
        link: LinkId,
    },
    /// The angles of two links differ by the value of a driver; without a driver, by the difference
    /// at the instant.
    Angles {
        /// The link whose angle is measured.
        of: LinkId,
        /// The link from which the angle is measured.
        against: LinkId,
        /// The driver.
        driver: Option<usize>,
    },
    /// A point is on the path of a guide; a link without a pin there keeps its distance from the
    /// path at the instant.
    OnPath {
        /// The runner on the path.
        runner: Runner,
        /// The guide.
        guide: GuideId,
        /// The link that carries it.
        on: LinkId,
    },
    /// The coordinate of a point along the path of a guide equals the value of a driver.
    AlongPath {
        /// The runner on the path.
        runner: Runner,
        /// The guide.
        guide: GuideId,
        /// The link that carries it.
        on: LinkId,
        /// The driver.
        driver: usize,
    },
    /// The distance of two pins equals the value of a driver.
    Distance {
        /// One of them.
        from: PointId,
        /// The other.
        to: PointId,
        /// The driver.
        driver: usize,
    },
    /// The rotations of two links, and the rotation of a line of centres or the displacement along
    /// a guide, are linearly related.
    Related {
        /// The pair; the scene gives its relation.
        pair: RollingId,
        /// The two links.
        links: [LinkId; 2],
    },
}

/// The runner in a guide.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Runner {
    /// A pin.
    Pin(PointId),
    /// A link without a pin there, by any of its points.
    Link(LinkId),
}

impl Form {
    /// Returns the two nodes that it joins.
    pub fn ends(&self) -> (Node, Node) {
        match *self {
            Form::Meet { pin, link } => (Node::Pin(pin), Node::Link(link)),
            Form::Angles { of, against, .. } => (Node::Link(of), Node::Link(against)),
            Form::OnPath { runner, on, .. } | Form::AlongPath { runner, on, .. } => (runner.node(), Node::Link(on)),
            Form::Distance { from, to, .. } => (Node::Pin(from), Node::Pin(to)),
            Form::Related { links: [a, b], .. } => (Node::Link(a), Node::Link(b)),
        }
    }

    /// Returns true if a link is one of the two nodes.
    pub fn joins(&self, link: LinkId) -> bool {
        let (a, b) = self.ends();
        a == Node::Link(link) || b == Node::Link(link)
    }

    /// Returns the pin that it puts on a link, and the link.
    pub fn meets(&self) -> Option<(PointId, LinkId)> {
        match *self {
            Form::Meet { pin, link } => Some((pin, link)),
            Form::Angles { .. } | Form::OnPath { .. } | Form::AlongPath { .. } | Form::Distance { .. } | Form::Related { .. } => None,
        }
    }

    /// Returns the number of its scalar equations.
    pub fn equations(&self) -> usize {
        match self {
            Form::Meet { .. } => 2,
            Form::Angles { .. } | Form::OnPath { .. } | Form::AlongPath { .. } | Form::Distance { .. } | Form::Related { .. } => 1,
        }
    }

    /// Returns the driver that gives its value.
    pub fn driver(&self) -> Option<usize> {
        match *self {
            Form::Angles { driver, .. } => driver,
            Form::AlongPath { driver, .. } | Form::Distance { driver, .. } => Some(driver),
            Form::Meet { .. } | Form::OnPath { .. } | Form::Related { .. } => None,
        }
    }

    /// Returns the two links of which the first keeps its direction relative to the second.
    pub fn locks(&self) -> Option<(LinkId, LinkId)> {
        match *self {
            Form::Angles { of, against, driver: None } => Some((of, against)),
            Form::Angles { driver: Some(_), .. } => None,
            Form::Meet { .. } | Form::OnPath { .. } | Form::AlongPath { .. } | Form::Distance { .. } | Form::Related { .. } => None,
        }
    }

    /// Returns the guide on whose path it holds a point, and the link that carries the guide.
    pub fn lies_on(&self) -> Option<(GuideId, LinkId)> {
        match *self {
            Form::OnPath { guide, on, .. } => Some((guide, on)),
            Form::Meet { .. } | Form::Angles { .. } | Form::AlongPath { .. } | Form::Distance { .. } | Form::Related { .. } => None,
        }
    }

    /// Returns the guide that its link must contain.
    pub fn path(&self) -> Option<GuideId> {
        match *self {
            Form::OnPath { guide, .. } | Form::AlongPath { guide, .. } => Some(guide),
            Form::Meet { .. } | Form::Angles { .. } | Form::Distance { .. } | Form::Related { .. } => None,
        }
    }
}

impl Runner {
    /// Returns the node of the runner.
    pub fn node(self) -> Node {
        match self {
            Runner::Pin(p) => Node::Pin(p),
            Runner::Link(l) => Node::Link(l),
        }
    }
}
