//! Forces of a scene: masses and gravity, applied forces and moments, springs, and where the balancing force acts.

use super::model::{Angle, Given, LinkId, PointId, Scene};
use hodograph_base::diag::Span;

/// Everything that a scene says about forces.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Loads {
    /// Acceleration of free fall (m/s²), x and y.
    pub gravity: Option<[Given; 2]>,
    /// Masses of links.
    pub masses: Vec<Mass>,
    /// Applied forces and moments.
    pub applied: Vec<Applied>,
    /// Springs.
    pub springs: Vec<Spring>,
    /// The force or moment that keeps the balance; `None`: one at each driver.
    pub balance: Option<Balance>,
}

impl Loads {
    /// True if nothing acts on the mechanism.
    pub fn is_empty(&self) -> bool {
        self.masses.is_empty() && self.applied.is_empty() && self.springs.is_empty()
    }

    /// The mass of a link.
    pub fn mass_of(&self, link: LinkId) -> Option<&Mass> {
        self.masses.iter().find(|m| m.link == link)
    }
}

/// Mass and moment of inertia of a link.
#[derive(Clone, Debug, PartialEq)]
pub struct Mass {
    /// The link.
    pub link: LinkId,
    /// Mass (kg).
    pub m: Option<Given>,
    /// Weight (N), where the file gives that instead of the mass.
    pub weight: Option<Given>,
    /// Moment of inertia about the centre of mass (kg·m²).
    pub j: Option<Given>,
    /// The centre of mass; absent where only a moment of inertia is given.
    pub at: Option<PointId>,
    /// Its place in the file.
    pub span: Span,
}

/// A force at a point of a link, or a couple on a link.
#[derive(Clone, Debug, PartialEq)]
pub struct Applied {
    /// The link.
    pub link: LinkId,
    /// Point of application; `None` for a couple.
    pub at: Option<PointId>,
    /// Size and direction.
    pub size: Size,
    /// Its place in the file.
    pub span: Span,
}

/// Size and direction of a load.
#[derive(Clone, Debug, PartialEq)]
pub enum Size {
    /// Components of a force (N) along the axes.
    Components([Given; 2]),
    /// A force (N) under an angle: from the x axis, or from the line of two points of a link, with which it turns.
    Directed {
        /// Signed magnitude.
        force: Given,
        /// From the first point toward the second.
        line: Option<(PointId, PointId)>,
        /// From the line or the axis, counter-clockwise plus.
        angle: Option<Given<Angle>>,
    },
    /// A force (N) against the velocity of its point.
    AgainstMotion(Given),
    /// A couple (N·m), counter-clockwise plus.
    Couple(Given),
    /// A couple (N·m) against the turning of its link.
    AgainstTurning(Given),
}

impl Size {
    /// True if the motion gives its direction.
    pub fn is_against_motion(&self) -> bool {
        matches!(self, Size::AgainstMotion(_) | Size::AgainstTurning(_))
    }
}

/// A spring between two points: it pulls with k (l − free), and pushes where that is negative.
#[derive(Clone, Debug, PartialEq)]
pub struct Spring {
    /// Its ends, each with the link on which it acts.
    pub ends: [(PointId, LinkId); 2],
    /// Stiffness k (N/m).
    pub stiffness: Given,
    /// Free length (m).
    pub free: Given,
    /// Its place in the file.
    pub span: Span,
}

/// The force or moment that keeps the balance in place of the driver's.
#[derive(Clone, Debug, PartialEq)]
pub struct Balance {
    /// The link on which it acts.
    pub link: LinkId,
    /// Point of application and direction of a force; `None` for a moment.
    pub force: Option<(PointId, Given<Angle>)>,
    /// Its place in the file.
    pub span: Span,
}

impl Scene {
    /// True if links have inertia forces: something has mass, and a driver moves.
    pub fn has_inertia(&self) -> bool {
        let moves = |d: &super::model::Driver| d.rate.value != 0.0 || d.acceleration.as_ref().is_some_and(|a| a.value != 0.0);
        !self.loads.masses.is_empty() && self.drivers.iter().any(moves)
    }
}
