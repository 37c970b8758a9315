//! Forms: the few statements in link frames that all pairs and drivers come down to.
//!
//! A form says which points, links and guides it is about and which driver gives its value, and no more. Newton's method, the equations
//! in exact numbers, motion, loop equations and sweep match forms, each differentiates them by itself: that two of them agree is
//! evidence because a form holds no derivative. What follows from a form alone is said here too: the nodes that it joins, how many
//! equations it is, what has to be laid in a link for it.

use super::super::Node;
use hodograph_scene::{GuideId, LinkId, PointId, RollingId};

/// A statement about where points and links are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// A pin and the point of the same name on a link meet: two equations.
    Meet {
        /// The pin.
        pin: PointId,
        /// The link.
        link: LinkId,
    },
    /// The angles of two links differ by what a driver gives; without one, by what they differed at the instant.
    Angles {
        /// The link whose angle counts.
        of: LinkId,
        /// The link from which it counts.
        against: LinkId,
        /// The driver.
        driver: Option<usize>,
    },
    /// A point lies on the path of a guide; a link without a pin there keeps the distance from the path that it had at the instant.
    OnPath {
        /// What lies there.
        runner: Runner,
        /// The guide.
        guide: GuideId,
        /// The link that carries it.
        on: LinkId,
    },
    /// The coordinate of a point along the path of a guide is what a driver gives.
    AlongPath {
        /// What runs there.
        runner: Runner,
        /// The guide.
        guide: GuideId,
        /// The link that carries it.
        on: LinkId,
        /// The driver.
        driver: usize,
    },
    /// The distance of two pins is what a driver gives.
    Distance {
        /// One of them.
        from: PointId,
        /// The other.
        to: PointId,
        /// The driver.
        driver: usize,
    },
    /// Turnings of two links, and that of a line of centres or the way along a guide, are linearly related.
    Related {
        /// Which pair; its relation is that of the scene.
        pair: RollingId,
        /// The two links.
        links: [LinkId; 2],
    },
}

/// What runs in a guide.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Runner {
    /// A pin.
    Pin(PointId),
    /// A link without a pin there, by any of its points.
    Link(LinkId),
}

impl Form {
    /// The two nodes that it joins.
    pub fn ends(&self) -> (Node, Node) {
        match *self {
            Form::Meet { pin, link } => (Node::Pin(pin), Node::Link(link)),
            Form::Angles { of, against, .. } => (Node::Link(of), Node::Link(against)),
            Form::OnPath { runner, on, .. } | Form::AlongPath { runner, on, .. } => (runner.node(), Node::Link(on)),
            Form::Distance { from, to, .. } => (Node::Pin(from), Node::Pin(to)),
            Form::Related { links: [a, b], .. } => (Node::Link(a), Node::Link(b)),
        }
    }

    /// Whether a link is one of the two nodes.
    pub fn joins(&self, link: LinkId) -> bool {
        let (a, b) = self.ends();
        a == Node::Link(link) || b == Node::Link(link)
    }

    /// The pin that it puts on a link, and the link.
    pub fn meets(&self) -> Option<(PointId, LinkId)> {
        match *self {
            Form::Meet { pin, link } => Some((pin, link)),
            Form::Angles { .. } | Form::OnPath { .. } | Form::AlongPath { .. } | Form::Distance { .. } | Form::Related { .. } => None,
        }
    }

    /// How many scalar equations it is.
    pub fn equations(&self) -> usize {
        match self {
            Form::Meet { .. } => 2,
            Form::Angles { .. } | Form::OnPath { .. } | Form::AlongPath { .. } | Form::Distance { .. } | Form::Related { .. } => 1,
        }
    }

    /// The driver that gives its value.
    pub fn driver(&self) -> Option<usize> {
        match *self {
            Form::Angles { driver, .. } => driver,
            Form::AlongPath { driver, .. } | Form::Distance { driver, .. } => Some(driver),
            Form::Meet { .. } | Form::OnPath { .. } | Form::Related { .. } => None,
        }
    }

    /// The two links of which the first keeps its direction against the second.
    pub fn locks(&self) -> Option<(LinkId, LinkId)> {
        match *self {
            Form::Angles { of, against, driver: None } => Some((of, against)),
            Form::Angles { driver: Some(_), .. } => None,
            Form::Meet { .. } | Form::OnPath { .. } | Form::AlongPath { .. } | Form::Distance { .. } | Form::Related { .. } => None,
        }
    }

    /// The guide on whose path it holds a point, and the link that carries the guide.
    pub fn lies_on(&self) -> Option<(GuideId, LinkId)> {
        match *self {
            Form::OnPath { guide, on, .. } => Some((guide, on)),
            Form::Meet { .. } | Form::Angles { .. } | Form::AlongPath { .. } | Form::Distance { .. } | Form::Related { .. } => None,
        }
    }

    /// The guide that has to be laid in its link for it.
    pub fn path(&self) -> Option<GuideId> {
        match *self {
            Form::OnPath { guide, .. } | Form::AlongPath { guide, .. } => Some(guide),
            Form::Meet { .. } | Form::Angles { .. } | Form::Distance { .. } | Form::Related { .. } => None,
        }
    }
}

impl Runner {
    /// The node that it is.
    pub fn node(self) -> Node {
        match self {
            Runner::Pin(p) => Node::Pin(p),
            Runner::Link(l) => Node::Link(l),
        }
    }
}
