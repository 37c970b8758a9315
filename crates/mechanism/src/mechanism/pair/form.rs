//! Forms: the few statements in link frames to which all pairs and drivers reduce.
//!
//! A form names its points, links and guides and the driver that gives its value, and nothing else.
//! Newton's method, the exact position equations, the motion, the loop equations and the sweep
//! match forms, and each differentiates them separately: a form contains no derivative, so
//! agreement of two of them is evidence. This module also derives what follows from a form alone:
//! the nodes that it joins, its number of equations, and the guide that a link must contain for it.

use super::super::GraphNode;
use hodograph_scene::{GuideId, LinkId, PointId, RollingId};

/// A statement about the positions of points and links.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PairForm {
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

impl PairForm {
    /// Returns the two nodes that it joins.
    pub fn ends(&self) -> (GraphNode, GraphNode) {
        match *self {
            PairForm::Meet { pin, link } => (GraphNode::Pin(pin), GraphNode::Link(link)),
            PairForm::Angles { of, against, .. } => (GraphNode::Link(of), GraphNode::Link(against)),
            PairForm::OnPath { runner, on, .. } | PairForm::AlongPath { runner, on, .. } => {
                (runner.node(), GraphNode::Link(on))
            }
            PairForm::Distance { from, to, .. } => (GraphNode::Pin(from), GraphNode::Pin(to)),
            PairForm::Related { links: [a, b], .. } => (GraphNode::Link(a), GraphNode::Link(b)),
        }
    }

    /// Returns true if a link is one of the two nodes.
    pub fn joins(&self, link: LinkId) -> bool {
        let (a, b) = self.ends();
        a == GraphNode::Link(link) || b == GraphNode::Link(link)
    }

    /// Returns the pin that it puts on a link, and the link.
    pub fn meets(&self) -> Option<(PointId, LinkId)> {
        match *self {
            PairForm::Meet { pin, link } => Some((pin, link)),
            PairForm::Angles { .. }
            | PairForm::OnPath { .. }
            | PairForm::AlongPath { .. }
            | PairForm::Distance { .. }
            | PairForm::Related { .. } => None,
        }
    }

    /// Returns the number of its scalar equations.
    pub fn equations(&self) -> usize {
        match self {
            PairForm::Meet { .. } => 2,
            PairForm::Angles { .. }
            | PairForm::OnPath { .. }
            | PairForm::AlongPath { .. }
            | PairForm::Distance { .. }
            | PairForm::Related { .. } => 1,
        }
    }

    /// Returns the driver that gives its value.
    pub fn driver(&self) -> Option<usize> {
        match *self {
            PairForm::Angles { driver, .. } => driver,
            PairForm::AlongPath { driver, .. } | PairForm::Distance { driver, .. } => Some(driver),
            PairForm::Meet { .. } | PairForm::OnPath { .. } | PairForm::Related { .. } => None,
        }
    }

    /// Returns the two links of which the first keeps its direction relative to the second.
    pub fn locks(&self) -> Option<(LinkId, LinkId)> {
        match *self {
            PairForm::Angles { of, against, driver: None } => Some((of, against)),
            PairForm::Angles { driver: Some(_), .. } => None,
            PairForm::Meet { .. }
            | PairForm::OnPath { .. }
            | PairForm::AlongPath { .. }
            | PairForm::Distance { .. }
            | PairForm::Related { .. } => None,
        }
    }

    /// Returns the guide on whose path it holds a point, and the link that carries the guide.
    pub fn point_guide(&self) -> Option<(GuideId, LinkId)> {
        match *self {
            PairForm::OnPath { guide, on, .. } => Some((guide, on)),
            PairForm::Meet { .. }
            | PairForm::Angles { .. }
            | PairForm::AlongPath { .. }
            | PairForm::Distance { .. }
            | PairForm::Related { .. } => None,
        }
    }

    /// Returns the guide that its link must contain.
    pub fn path(&self) -> Option<GuideId> {
        match *self {
            PairForm::OnPath { guide, .. } | PairForm::AlongPath { guide, .. } => Some(guide),
            PairForm::Meet { .. }
            | PairForm::Angles { .. }
            | PairForm::Distance { .. }
            | PairForm::Related { .. } => None,
        }
    }
}

impl Runner {
    /// Returns the node of the runner.
    pub fn node(self) -> GraphNode {
        match self {
            Runner::Pin(p) => GraphNode::Pin(p),
            Runner::Link(l) => GraphNode::Link(l),
        }
    }
}
