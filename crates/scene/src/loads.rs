//! Forces of a scene: masses and gravity, applied forces and moments, springs, and where the balancing force acts.

use super::model::{Angle, Given, GuideId, LinkId, PointId, Scene};
use hodograph_base::diag::{Diagnostic, Span};
use std::sync::{Arc, OnceLock};

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
    /// Friction in pins and guides.
    pub friction: Vec<Friction>,
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
    /// Size and direction; of a diagram the largest amount.
    pub size: Size,
    /// The part of the motion over which it acts; `None`: all of it.
    pub course: Option<Course>,
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

/// The part of the motion over which a load acts, and its diagram.
#[derive(Clone, Debug, PartialEq)]
pub struct Course {
    /// The motion.
    pub along: Along,
    /// The load acts from the first to the last; two at least, in order.
    pub stations: Vec<Station>,
    /// Its place in the file.
    pub span: Span,
}

/// The motion along which a load is told.
#[derive(Clone, Debug, PartialEq)]
pub enum Along {
    /// The working stroke of a point in a straight guide on ground. On the way back the load does not act.
    Stroke {
        /// The point.
        point: PointId,
        /// Its guide.
        guide: GuideId,
        /// Direction of the working stroke, from the x axis; `None`: the slower one.
        toward: Option<Given<Angle>>,
        /// Its ends, found where they are first asked for.
        ends: Ends,
    },
    /// The angle of a driven link.
    Turn {
        /// Its driver.
        driver: usize,
        /// The angle after which the load comes again.
        period: Given<Angle>,
    },
}

/// Coordinates along the guide (m) at which a working stroke begins and ends, or the reason for which it has none: found once for a scene and its
/// copies. All are equal: they follow from the rest of the scene.
#[derive(Clone, Debug, Default)]
pub struct Ends(pub Arc<OnceLock<Result<[Given; 2], Diagnostic>>>);

impl PartialEq for Ends {
    fn eq(&self, _: &Ends) -> bool {
        true
    }
}

/// A station of a course.
#[derive(Clone, Debug, PartialEq)]
pub struct Station {
    /// Its place.
    pub at: Abscissa,
    /// Amount of the load there, between stations in proportion; `None` where the load is constant.
    pub amount: Option<Given>,
}

/// A place of a course.
#[derive(Clone, Debug, PartialEq)]
pub enum Abscissa {
    /// A part of the stroke, 0 to 1.
    Part(Given),
    /// Distance (m) from the beginning of the stroke.
    Way(Given),
    /// An angle of the link.
    Angle(Given<Angle>),
}

impl Abscissa {
    /// The part, the distance (m), or the angle (degrees).
    pub fn value(&self) -> f64 {
        match self {
            Abscissa::Part(x) | Abscissa::Way(x) => x.value,
            Abscissa::Angle(a) => a.value.degrees(),
        }
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

/// Friction in a pair.
#[derive(Clone, Debug, PartialEq)]
pub struct Friction {
    /// The pair and how rough it is.
    pub at: Rub,
    /// Its place in the file.
    pub span: Span,
}

/// A pair that rubs.
#[derive(Clone, Debug, PartialEq)]
pub enum Rub {
    /// A pin, with the radius (m) of its friction circle.
    Pin {
        /// The pin.
        point: PointId,
        /// The link in which it is fast: on it the others turn.
        fast: LinkId,
        /// The radius ρ = f r.
        circle: Given,
    },
    /// A straight guide, with its coefficient of friction.
    Guide {
        /// The guide.
        guide: GuideId,
        /// The coefficient f = tan φ.
        f: Given,
    },
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

impl Applied {
    /// True if the load depends on velocities: by its direction, or because it acts in one stroke alone.
    pub fn depends_on_motion(&self) -> bool {
        self.size.is_against_motion() || self.stroke().is_some()
    }

    /// The point and guide of the stroke in which it acts.
    pub fn stroke(&self) -> Option<(PointId, GuideId)> {
        match self.course.as_ref()?.along {
            Along::Stroke { point, guide, .. } => Some((point, guide)),
            Along::Turn { .. } => None,
        }
    }
}

impl Scene {
    /// The link that slides in a guide, and the point of it through which its friction acts: the pin, a point of the slider, else a place where
    /// something runs or rolls on it.
    pub fn sliding_at(&self, guide: GuideId) -> Option<(LinkId, PointId)> {
        let own = &self.guides[guide.0];
        let slider = own.slider.or_else(|| self.carriers(own.pin?).next())?;
        let runs = self.guides.iter().filter(|g| g.on == slider).find_map(|g| g.pin);
        let rolls = self.rolling.iter().find(|r| r.links.contains(&slider)).map(|r| r.at[0]);
        let point = own.pin.or_else(|| self.links[slider.0].points.first().copied()).or(runs).or(rolls)?;
        Some((slider, point))
    }

    /// True if links have inertia forces: something has mass, and a driver moves.
    pub fn has_inertia(&self) -> bool {
        let moves = |d: &super::model::Driver| d.rate.value != 0.0 || d.acceleration.as_ref().is_some_and(|a| a.value != 0.0);
        !self.loads.masses.is_empty() && self.drivers.iter().any(moves)
    }
}
