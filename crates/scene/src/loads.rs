//! Forces of a scene: masses and gravity, applied forces and moments, springs, and the place of the
//! balancing force.

use super::model::{Angle, GivenQuantity, GuideId, LinkId, PointId, Scene};
use hodograph_base::diag::{Diagnostic, Span};
use std::sync::{Arc, OnceLock};

/// All data of a scene on forces.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Loads {
    /// Acceleration of free fall (m/s²), x and y.
    pub gravity: Option<[GivenQuantity; 2]>,
    /// Masses of links.
    pub masses: Vec<Mass>,
    /// Applied forces and moments.
    pub applied: Vec<Applied>,
    /// Springs.
    pub springs: Vec<Spring>,
    /// Friction in pins and guides.
    pub friction: Vec<Friction>,
    /// The balancing force or moment; `None`: one at each driver.
    pub balance: Option<Balance>,
}

impl Loads {
    /// True if nothing acts on the mechanism.
    pub fn is_empty(&self) -> bool {
        self.masses.is_empty() && self.applied.is_empty() && self.springs.is_empty()
    }

    /// Returns the mass of a link.
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
    pub m: Option<GivenQuantity>,
    /// Weight (N), if the file gives it instead of the mass.
    pub weight: Option<GivenQuantity>,
    /// Moment of inertia about the centre of mass (kg·m²).
    pub j: Option<GivenQuantity>,
    /// The centre of mass; absent if only a moment of inertia is given.
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
    /// Size and direction; for a diagram the largest amount.
    pub size: LoadSize,
    /// The part of the motion over which it acts; `None`: all of it.
    pub course: Option<LoadCourse>,
    /// Its place in the file.
    pub span: Span,
}

/// Size and direction of a load.
#[derive(Clone, Debug, PartialEq)]
pub enum LoadSize {
    /// Components of a force (N) along the axes.
    Components([GivenQuantity; 2]),
    /// A force (N) at an angle from the x axis, or from the line of two points of a link, with
    /// which it turns.
    Directed {
        /// Signed magnitude.
        force: GivenQuantity,
        /// Reference line, from the first point toward the second.
        line: Option<(PointId, PointId)>,
        /// Angle from the line or the axis, positive counter-clockwise.
        angle: Option<GivenQuantity<Angle>>,
    },
    /// A force (N) opposite to the velocity of its point.
    AgainstMotion(GivenQuantity),
    /// A couple (N·m), positive counter-clockwise.
    Couple(GivenQuantity),
    /// A couple (N·m) opposite to the rotation of its link.
    AgainstTurning(GivenQuantity),
}

impl LoadSize {
    /// True if the motion determines its direction.
    pub fn is_against_motion(&self) -> bool {
        matches!(self, LoadSize::AgainstMotion(_) | LoadSize::AgainstTurning(_))
    }
}

/// The part of the motion over which a load acts, and its diagram.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadCourse {
    /// The motion.
    pub along: LoadTravel,
    /// Stations, at least two, in order; the load acts from the first to the last.
    pub stations: Vec<LoadStation>,
    /// Its place in the file.
    pub span: Span,
}

/// The motion along which a load is given.
#[derive(Clone, Debug, PartialEq)]
pub enum LoadTravel {
    /// The working stroke of a point in a straight guide on ground. The load does not act during
    /// the return stroke.
    Stroke {
        /// The point.
        point: PointId,
        /// Its guide.
        guide: GuideId,
        /// Direction of the working stroke, from the x axis; `None`: the slower one.
        toward: Option<GivenQuantity<Angle>>,
        /// Its ends, computed at the first use.
        ends: StrokeEnds,
    },
    /// The angle of a driven link.
    Turn {
        /// Its driver.
        driver: usize,
        /// The angle after which the load repeats.
        period: GivenQuantity<Angle>,
    },
}

/// Coordinates along the guide (m) of the beginning and end of a working stroke, or the reason why
/// there is none: computed once for a scene and its copies. All compare equal, because they follow
/// from the rest of the scene.
#[derive(Clone, Debug, Default)]
pub struct StrokeEnds(pub Arc<OnceLock<Result<[GivenQuantity; 2], Diagnostic>>>);

impl PartialEq for StrokeEnds {
    fn eq(&self, _: &StrokeEnds) -> bool {
        true
    }
}

/// A station of a course.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadStation {
    /// Its place.
    pub at: Abscissa,
    /// Amount of the load there, linear between stations; `None` if the load is constant.
    pub amount: Option<GivenQuantity>,
}

/// A place of a course.
#[derive(Clone, Debug, PartialEq)]
pub enum Abscissa {
    /// A fraction of the stroke, 0 to 1.
    Part(GivenQuantity),
    /// Distance (m) from the beginning of the stroke.
    Way(GivenQuantity),
    /// An angle of the link.
    Angle(GivenQuantity<Angle>),
}

impl Abscissa {
    /// Returns the fraction, the distance (m), or the angle (degrees).
    pub fn value(&self) -> f64 {
        match self {
            Abscissa::Part(x) | Abscissa::Way(x) => x.value,
            Abscissa::Angle(a) => a.value.degrees(),
        }
    }
}

/// A spring between two points: it pulls with k (l − free), and pushes if this is negative.
#[derive(Clone, Debug, PartialEq)]
pub struct Spring {
    /// Its ends, each with the link on which it acts.
    pub ends: [(PointId, LinkId); 2],
    /// Stiffness k (N/m).
    pub stiffness: GivenQuantity,
    /// Free length (m).
    pub free: GivenQuantity,
    /// Its place in the file.
    pub span: Span,
}

/// Friction in a pair.
#[derive(Clone, Debug, PartialEq)]
pub struct Friction {
    /// The pair and its friction.
    pub at: Rub,
    /// Its place in the file.
    pub span: Span,
}

/// A pair with friction.
#[derive(Clone, Debug, PartialEq)]
pub enum Rub {
    /// A pin, with the radius (m) of its friction circle.
    Pin {
        /// The pin.
        point: PointId,
        /// The link on which the pin is fixed; the others turn on it.
        fast: LinkId,
        /// The radius ρ = f r.
        circle: GivenQuantity,
    },
    /// A straight guide, with its coefficient of friction.
    Guide {
        /// The guide.
        guide: GuideId,
        /// The coefficient f = tan φ.
        f: GivenQuantity,
    },
}

/// The balancing force or moment that replaces that of the driver.
#[derive(Clone, Debug, PartialEq)]
pub struct Balance {
    /// The link on which it acts.
    pub link: LinkId,
    /// Point of application and direction of a force; `None` for a moment.
    pub force: Option<(PointId, GivenQuantity<Angle>)>,
    /// Its place in the file.
    pub span: Span,
}

impl Applied {
    /// True if the load depends on velocities: by its direction, or because it acts in one stroke
    /// only.
    pub fn depends_on_motion(&self) -> bool {
        self.size.is_against_motion() || self.stroke().is_some()
    }

    /// Returns the point and guide of the stroke in which it acts.
    pub fn stroke(&self) -> Option<(PointId, GuideId)> {
        match self.course.as_ref()?.along {
            LoadTravel::Stroke { point, guide, .. } => Some((point, guide)),
            LoadTravel::Turn { .. } => None,
        }
    }
}

impl Scene {
    /// Returns the link that slides in a guide, and its point through which the friction acts: the
    /// pin, else a point of the slider, else a place at which another body runs or rolls on the
    /// slider.
    pub fn sliding_at(&self, guide: GuideId) -> Option<(LinkId, PointId)> {
        let own = &self.guides[guide.0];
        let slider = own.slider.or_else(|| self.carriers(own.pin?).next())?;
        let runs = self.guides.iter().filter(|g| g.on == slider).find_map(|g| g.pin);
        let rolls = self.rolling.iter().find(|r| r.links.contains(&slider)).map(|r| r.at[0]);
        let point =
            own.pin.or_else(|| self.links[slider.0].points.first().copied()).or(runs).or(rolls)?;
        Some((slider, point))
    }

    /// True if links have inertia forces: there are masses, and a driver moves.
    pub fn has_inertia(&self) -> bool {
        let moves = |d: &super::model::Driver| {
            d.rate.value != 0.0 || d.acceleration.as_ref().is_some_and(|a| a.value != 0.0)
        };
        !self.loads.masses.is_empty() && self.drivers.iter().any(moves)
    }
}
