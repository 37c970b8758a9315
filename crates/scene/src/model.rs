//! The scene after reading: names resolved, SI units, nothing left to interpret.
//!
//! Lengths are in metres, angles in radians (see [`Angle`]), rates per second. Every list keeps the
//! order of the file. Whether the data determine the mechanism is *not* decided here but in
//! `mechanism` and `position`.

use super::book::Book;
use super::quantity::{Asked, Frame};
use super::rolling::{Rolling, RollingId};
use super::source::Source;
use super::statement::Statement;
use super::units::Unit;
use hodograph_base::diag::{Both, Span};
use hodograph_base::kind::{ByKind, Kind};

pub use super::cams::{Cam, Follows, Pieces, TurningCam};
pub use super::loads::{
    Abscissa, Applied, Balance, Friction, LoadCourse, LoadSize, LoadStation, LoadTravel, Loads,
    Mass, Rub, Spring, StrokeEnds,
};
pub use super::mistake::Mistake;
pub use hodograph_base::lang::Lang;
pub use hodograph_base::trig::Angle;

/// Index into [`Scene::points`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct PointId(pub usize);

/// Index into [`Scene::links`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct LinkId(pub usize);

/// Index into [`Scene::guides`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct GuideId(pub usize);

/// A quantity as the scene writes it, with its SI value and its place in the file.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenQuantity<T = f64> {
    /// SI value.
    pub value: T,
    /// Bound on the error of `value`: few decimals are an exact `f64` (of an angle: in its unit).
    pub radius: f64,
    /// Text as written (`"100 mm"`, `"2*r"`), for the data list and exact arithmetic.
    pub text: String,
    /// Place in the file.
    pub span: Span,
}

/// A named point.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedPoint {
    /// Name as written, such as `A` or `O2`.
    pub name: String,
    /// The data that give its place, if any.
    pub place: PointPlace,
    /// Rough coordinates (m) that select the assembly.
    pub sketch: Option<[f64; 2]>,
    /// Place of the first mention.
    pub span: Span,
}

/// The data that give a point's place.
#[derive(Clone, Debug, PartialEq)]
pub enum PointPlace {
    /// Not given; it follows from lengths and guides.
    Unknown,
    /// Coordinates in the fixed plane at the instant (m): a fixed pivot, or part of the pose.
    At([GivenQuantity; 2]),
    /// Coordinates (m) in the link that carries `base`: origin `base.0`, x toward `base.1`, y left.
    InLink {
        /// Two points of the link.
        base: (PointId, PointId),
        /// x and y.
        xy: [GivenQuantity; 2],
    },
    /// Polar coordinates in the link that carries `base`: at `length` (m) from `base.0`, in the
    /// direction of `base.0`→`base.1` turned by `angle` (counter-clockwise).
    Polar {
        /// Two points of the link.
        base: (PointId, PointId),
        /// Distance from `base.0`.
        length: GivenQuantity,
        /// Angle from the base, positive counter-clockwise.
        angle: GivenQuantity<Angle>,
    },
}

/// A link. Pins are not listed: a point on several links is a pin that joins them all.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// Number or name as written.
    pub name: String,
    /// Its points, each once. A numbered slider has its pin here too. Empty for a slider without a
    /// pin, for a ground that only carries guides, and for a barrel and rod that only a cylinder
    /// names.
    pub points: Vec<PointId>,
    /// Place of the declaration.
    pub span: Span,
}

/// A sliding pair. With `pin` and no `slider`: a bare pin in a slot (one constraint). With
/// `slider`: that link also keeps its direction relative to `on` (a prismatic pair, two
/// constraints). At least one of the two is given.
#[derive(Clone, Debug, PartialEq)]
pub struct Guide {
    /// The running point (of the `slider`); a bare pin that runs in two guides may be on no link.
    pub pin: Option<PointId>,
    /// The numbered slider.
    pub slider: Option<LinkId>,
    /// The link that carries the guide.
    pub on: LinkId,
    /// Shape of the guide.
    pub path: GuidePath,
    /// Bearing length of the slider (m), centred on the reference point of the guide force.
    pub length: Option<GivenQuantity>,
    /// The rolling pair that needs this guide for its second centre, unless the guide is one of the
    /// file: it keeps the two links in touch. The guide of a toothed pair only constrains what no
    /// other pair constrains.
    pub rolling: Option<RollingId>,
    /// Place of the declaration.
    pub span: Span,
}

/// The shape of a guide, in the link that carries it.
#[derive(Clone, Debug, PartialEq)]
pub enum GuidePath {
    /// A straight guide.
    Line {
        /// A point of the line (before `offset`).
        through: Through,
        /// Its direction, also the positive sense of sliding.
        direction: GuideDirection,
        /// Distance (m) from the parallel through `through`, positive to the left of the direction.
        offset: Option<GivenQuantity>,
    },
    /// A slot along a circle about a point of the carrying link.
    Arc {
        /// Centre, a point of the carrying link.
        centre: PointId,
        /// Radius (m); if absent, the distance from centre to pin in the pose.
        radius: Option<GivenQuantity>,
    },
}

/// The point that fixes a straight guide (before its offset).
#[derive(Clone, Debug, PartialEq)]
pub enum Through {
    /// The running pin itself, at its place at the instant; without a pin, any line.
    Pin,
    /// A point of the carrying link.
    Point(PointId),
    /// A place in the fixed plane (m); for guides on ground.
    At([GivenQuantity; 2]),
}

/// The direction of a straight guide.
#[derive(Clone, Debug, PartialEq)]
pub enum GuideDirection {
    /// Angle from the x axis at the instant.
    Instant(GivenQuantity<Angle>),
    /// From the first point toward the second, on the carrying link, turned by the angle if given.
    Along(PointId, PointId, Option<GivenQuantity<Angle>>),
    /// Not given: no other data fix the direction of the carrying link, so the guide *is* the
    /// link's direction (a lever known by its pivot and its slot only).
    Own,
    /// Turned by this angle from the guide in which the carrying link slides, a guide of another
    /// moving link: the face of a follower.
    Slid(GivenQuantity<Angle>),
}

/// A driver of the mechanism.
#[derive(Clone, Debug, PartialEq)]
pub struct Driver {
    /// The motion that is given.
    pub kind: DriverKind,
    /// Rate: rad/s for a turning driver, m/s for a sliding one and a cylinder.
    pub rate: GivenQuantity,
    /// Time derivative of the rate; `None`: the rate is constant.
    pub acceleration: Option<GivenQuantity>,
    /// True if the scene gives the rate; for reading a pose, a missing rate may count as one unit.
    pub rate_told: bool,
    /// The law of time for its position; rate and acceleration at the instant follow from it.
    pub law: Option<TimeLaw>,
    /// Place of the declaration.
    pub span: Span,
}

/// A law of time, as written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TimeLaw {
    /// The expression in t.
    pub text: String,
    /// The parameters in it with their texts; the last is t, the instant.
    pub parameters: Vec<(String, String)>,
}

/// The kinds of driver.
#[derive(Clone, Debug, PartialEq)]
pub enum DriverKind {
    /// A link turns relative to another (usually ground).
    Turn {
        /// The driven link.
        link: LinkId,
        /// The link from which angle and rate are measured.
        against: LinkId,
        /// The line of the driven link whose angle is given; default: its first two points.
        line: Option<(PointId, PointId)>,
        /// Zero line of the angle on `against`; default: x axis, or its first two points.
        against_line: Option<(PointId, PointId)>,
        /// The angle (rad); absent if coordinates give the pose.
        angle: Option<GivenQuantity<Angle>>,
    },
    /// A pin or slider moves along its guide.
    Slide {
        /// The guide.
        guide: GuideId,
        /// Coordinate along the guide from its `through` point (m; arc length on a curved guide).
        position: Option<GivenQuantity>,
    },
    /// The distance of two points is given: a cylinder.
    Cylinder {
        /// One end.
        a: PointId,
        /// The other end.
        b: PointId,
        /// Their distance (m); absent if coordinates give the pose.
        length: Option<GivenQuantity>,
        /// Numbers of barrel and rod, if any: links that turn with the line a–b without further
        /// points.
        links: Vec<LinkId>,
    },
}

/// A given distance between two points of one link.
#[derive(Clone, Debug, PartialEq)]
pub struct Length {
    /// One end.
    pub a: PointId,
    /// The other end.
    pub b: PointId,
    /// Distance (m).
    pub value: GivenQuantity,
}

/// The side of the directed line `from`→`to` on which a point is.
#[derive(Clone, Debug, PartialEq)]
pub struct Side {
    /// The point.
    pub point: PointId,
    /// True for left of the line, false for right.
    pub left: bool,
    /// Start of the line.
    pub from: PointId,
    /// End of the line.
    pub to: PointId,
    /// Place in the file.
    pub span: Span,
}

/// A point of a certain link: `B3` is the point of link 3 at the place B.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct OnLink {
    /// The place.
    pub point: PointId,
    /// The link; `None` if the point is the same on all links that carry it.
    pub link: Option<LinkId>,
}

/// A question: one quantity to find.
#[derive(Clone, Debug, PartialEq)]
pub struct Find {
    /// The quantity.
    pub what: Asked,
    /// Text as written, such as `v_E`.
    pub text: String,
    /// Place in the file.
    pub span: Span,
}

/// The moving point of a composite motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CompositePoint {
    /// A point of the scene.
    Point(OnLink),
    /// The point of a link, the cam or its follower, at which the two touch at the instant.
    Contact {
        /// Index into [`Scene::cams`].
        cam: usize,
        /// The link that carries the point.
        on: LinkId,
    },
}

/// A moving point and the frame from which its motion is observed.
#[derive(Clone, Debug, PartialEq)]
pub struct ObservedPoint {
    /// The moving point.
    pub of: CompositePoint,
    /// The frame.
    pub frame: Frame,
    /// Place in the file.
    pub span: Span,
}

/// A wrong solution to show beside the right one.
#[derive(Clone, Debug, PartialEq)]
pub struct Attempted {
    /// The mistake.
    pub mistake: Mistake,
    /// The point of the mistake, if several are possible: a pin in a slot, a contact, an image
    /// point.
    pub pair: Option<String>,
    /// The link for which it is made.
    pub link: Option<LinkId>,
    /// Printed results, each with its question; of a vector the magnitude.
    pub printed: Vec<(Find, GivenQuantity)>,
    /// The author's explanation of the mistake.
    pub why: Option<Both>,
    /// Place in the file.
    pub span: Span,
}

/// Paper and scales. A fixed scale is in SI per millimetre of paper.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Paper {
    /// Width and height in mm; `None`: as large as the sheet needs.
    pub size_mm: Option<[f64; 2]>,
    /// Fixed scales, SI per mm of paper.
    pub scales: ByKind,
    /// The pencil error (mm) within which 95 % of the marks fall.
    pub pencil_mm: Option<f64>,
    /// Units (SI) in which scales are round; a kind without one has the SI unit.
    pub round_in: ByKind,
}

impl Paper {
    /// Returns the scale of a kind (SI per mm): the fixed one, or a round one from `choose`.
    pub fn scale(&self, kind: Kind, choose: impl FnOnce(f64) -> f64) -> f64 {
        self.scales.get(kind).unwrap_or_else(|| choose(self.unit(kind)))
    }

    /// Returns the unit (SI) in which the scale of a kind is round.
    pub fn unit(&self, kind: Kind) -> f64 {
        self.round_in.get(kind).unwrap_or(1.0)
    }
}

/// A scene: the whole contents of its file.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Title.
    pub title: Both,
    /// The problem statement, if the file has one.
    pub statement: Option<Statement>,
    /// Named parameters with their SI values, as written.
    pub parameters: Vec<(String, GivenQuantity)>,
    /// Points in order of first mention.
    pub points: Vec<NamedPoint>,
    /// Links; sliders that only a guide names follow those of `links`.
    pub links: Vec<Link>,
    /// The fixed link.
    pub ground: LinkId,
    /// Sliding pairs, including those that replace the contact of a cam; the guides of rolling
    /// pairs follow those of the file.
    pub guides: Vec<Guide>,
    /// Disc cams.
    pub cams: Vec<Cam>,
    /// Gears in mesh, gears on racks, wheels on tracks.
    pub rolling: Vec<Rolling>,
    /// Given distances.
    pub lengths: Vec<Length>,
    /// Drivers.
    pub drivers: Vec<Driver>,
    /// Masses, forces, springs.
    pub loads: Loads,
    /// Sides that select the assembly.
    pub sides: Vec<Side>,
    /// The questions.
    pub find: Vec<Find>,
    /// Moving points and frames of the composite motions to show.
    pub composite: Vec<ObservedPoint>,
    /// Wrong solutions to show beside the right one.
    pub attempts: Vec<Attempted>,
    /// Names of other readings of a figure that is lost; see [`readings`](super::readings).
    pub readings: Vec<String>,
    /// Language of the output, unless the caller chooses another.
    pub language: Option<Lang>,
    /// Name of the notation profile (`en`, `cn`), unless the caller chooses another.
    pub notation: Option<String>,
    /// Paper and scales.
    pub paper: Paper,
    /// The unit in which the file writes its lengths; messages about the scene use it.
    pub length_unit: &'static Unit,
    /// The units of printed answers, scales and tables.
    pub book: Book,
    /// The file of a scene with cams or loads, to be read again at other positions and parameters.
    pub source: Option<Source>,
}

impl Scene {
    /// Returns for each link whether it turns with `link` in every position: it is `link` itself,
    /// or a slider on a straight guide joins it to a link that does.
    pub fn turning_with(&self, link: LinkId) -> Vec<bool> {
        let mut turning = vec![false; self.links.len()];
        turning[link.0] = true;
        let straight = self.guides.iter().filter(|g| matches!(g.path, GuidePath::Line { .. }));
        let locks: Vec<[LinkId; 2]> = straight.filter_map(|g| Some([g.on, g.slider?])).collect();
        while let Some(lock) = locks.iter().find(|[a, b]| turning[a.0] != turning[b.0]) {
            lock.iter().for_each(|l| turning[l.0] = true);
        }
        turning
    }

    /// Returns the name of a point.
    pub fn point_name(&self, p: PointId) -> &str {
        &self.points[p.0].name
    }

    /// Returns the name of a link.
    pub fn link_name(&self, l: LinkId) -> &str {
        &self.links[l.0].name
    }

    /// Returns the first moving link that carries a point.
    pub fn mover(&self, p: PointId) -> Option<LinkId> {
        self.carriers(p).find(|l| *l != self.ground)
    }

    /// Returns the links that carry a point, in order.
    pub fn carriers(&self, p: PointId) -> impl Iterator<Item = LinkId> + '_ {
        self.links
            .iter()
            .enumerate()
            .filter(move |(_, l)| l.points.contains(&p))
            .map(|(i, _)| LinkId(i))
    }
}
