//! The scene after reading: names resolved, SI units, nothing left to interpret.
//!
//! Lengths are metres, angles radians (see [`Angle`]), rates per second. The order of every list is the order in the file.
//! Whether the given things suffice to fix the mechanism is *not* decided here but in `mechanism` and
//! `position`.

use super::again::Source;
use super::book::Book;
use super::quantity::{Asked, Frame};
use super::rolling::{Rolling, RollingId};
use super::statement::Statement;
use super::units::Unit;
use hodograph_base::diag::Span;
use hodograph_base::kind::{ByKind, Kind};

pub use super::cams::{Cam, Follows, Pieces, Turning};
pub use super::loads::{Abscissa, Along, Applied, Balance, Course, Ends, Friction, Loads, Mass, Rub, Size, Spring, Station};
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

/// A text in both languages; a scene that gives one gets it in both.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Localized {
    /// English.
    pub en: String,
    /// Chinese.
    pub zh: String,
}

impl Localized {
    /// The text in one language.
    pub fn get(&self, lang: Lang) -> &str {
        match lang {
            Lang::En => &self.en,
            Lang::Zh => &self.zh,
        }
    }
}

/// A quantity as the scene writes it, with its SI value and its place in the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Given<T = f64> {
    /// SI value.
    pub value: T,
    /// How far the value may be from what is written: a decimal is seldom an `f64` (of an angle: in the unit of `value`).
    pub radius: f64,
    /// The text as written (`"100 mm"`, `"2*r"`), for the "given" list and for exact arithmetic.
    pub text: String,
    /// Where it stands.
    pub span: Span,
}

/// A named point.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Name as written, such as `A` or `O2`.
    pub name: String,
    /// How its place is given, if at all.
    pub place: Place,
    /// Rough coordinates (m) that say which assembly is meant.
    pub sketch: Option<[f64; 2]>,
    /// First mention.
    pub span: Span,
}

/// How a point's place is given.
#[derive(Clone, Debug, PartialEq)]
pub enum Place {
    /// Not given: to be found from lengths and guides.
    Unknown,
    /// Coordinates in the plane at the instant (m): a fixed pivot, or part of the pose.
    At([Given; 2]),
    /// Coordinates (m) in the link that carries `base`: origin in `base.0`, x toward `base.1`, y to the left.
    InLink {
        /// Two points of the link.
        base: (PointId, PointId),
        /// x and y.
        xy: [Given; 2],
    },
    /// At `length` (m) from `base.0`, the direction turned by `angle` (counter-clockwise) from that of `base.0`→`base.1`.
    Polar {
        /// Two points of the link.
        base: (PointId, PointId),
        /// Distance from `base.0`.
        length: Given,
        /// Angle from the base, counter-clockwise plus.
        angle: Given<Angle>,
    },
}

/// A link. Pins are not listed: a point on several links is a pin that joins them all.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// Number or name as written.
    pub name: String,
    /// Its points, without repetition. A numbered slider has its pin here too. Empty for a slider without a pin, for a ground
    /// that only carries guides, and for barrel and rod that only a cylinder names.
    pub points: Vec<PointId>,
    /// Where it is declared.
    pub span: Span,
}

/// A sliding pair. With `pin` and no `slider`: a bare pin in a slot (one constraint). With `slider`: that link keeps
/// its direction against `on` as well (a prismatic pair, two constraints). At least one of the two is given.
#[derive(Clone, Debug, PartialEq)]
pub struct Guide {
    /// The point that runs in the guide; with `slider` a point of that link. A bare pin that runs in two guides may be on no link.
    pub pin: Option<PointId>,
    /// The numbered slider.
    pub slider: Option<LinkId>,
    /// The link that carries the guide.
    pub on: LinkId,
    /// Its shape.
    pub path: GuidePath,
    /// The length (m) over which its slider bears, half of it on either side of the point from which the place of its force counts.
    pub length: Option<Given>,
    /// The rolling pair whose second centre runs in it, where it is not the file's own guide: it keeps the two in touch, and a toothed
    /// pair's holds only what nothing else holds.
    pub rolling: Option<RollingId>,
    /// Where it is declared.
    pub span: Span,
}

/// The shape of a guide, in the link that carries it.
#[derive(Clone, Debug, PartialEq)]
pub enum GuidePath {
    /// A straight guide.
    Line {
        /// A point of the line (before `offset`).
        through: Through,
        /// Its direction; also the positive sense of sliding.
        direction: Direction,
        /// The line lies this far (m) to the left of the parallel through `through` (left when looking along the direction).
        offset: Option<Given>,
    },
    /// A slot along a circle about a point of the carrying link.
    Arc {
        /// Centre, a point of the carrying link.
        centre: PointId,
        /// Radius (m); where absent, the distance centre–pin of the pose.
        radius: Option<Given>,
    },
}

/// What a straight guide passes through (before its offset).
#[derive(Clone, Debug, PartialEq)]
pub enum Through {
    /// The running pin itself, where it is at the instant; where a slider has no pin, the line's place does not matter.
    Pin,
    /// A point of the carrying link.
    Point(PointId),
    /// A place in the plane (m); for guides on ground.
    At([Given; 2]),
}

/// The direction of a straight guide.
#[derive(Clone, Debug, PartialEq)]
pub enum Direction {
    /// At this angle from the x axis at the instant.
    Instant(Given<Angle>),
    /// From the first point toward the second, both on the carrying link, turned by the angle if one is given.
    Along(PointId, PointId, Option<Given<Angle>>),
    /// Not given: the carrying link has no other direction of its own, so its guide *is* its direction
    /// (a lever known by its pivot and its slot only).
    Own,
    /// Turned by this angle from the guide of another moving link in which the carrying link slides: the face of a follower.
    Slid(Given<Angle>),
}

/// What drives the mechanism.
#[derive(Clone, Debug, PartialEq)]
pub struct Driver {
    /// Which motion is given.
    pub kind: DriverKind,
    /// Rate: rad/s for turning, m/s for sliding and cylinders.
    pub rate: Given,
    /// Rate of the rate; absent means constant rate.
    pub acceleration: Option<Given>,
    /// Whether its rate is told; where only the pose is read it may count as one.
    pub rate_told: bool,
    /// The law of time that gives its position, rate and acceleration at the instant.
    pub law: Option<TimeLaw>,
    /// Where it is declared.
    pub span: Span,
}

/// A law of time, as it is written.
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
    /// A link turns against another (usually ground).
    Turn {
        /// The driven link.
        link: LinkId,
        /// The link against which angle and rate are counted.
        against: LinkId,
        /// The line of the driven link whose angle is given; default: its first two points.
        line: Option<(PointId, PointId)>,
        /// The line of `against` from which the angle is counted; default: the x axis for ground, else its first two points.
        against_line: Option<(PointId, PointId)>,
        /// The angle; absent where the pose is given by coordinates.
        angle: Option<Given<Angle>>,
    },
    /// A pin or slider moves along its guide.
    Slide {
        /// Which guide.
        guide: GuideId,
        /// Coordinate along the guide from its `through` point (m; metres of arc on a curved guide).
        position: Option<Given>,
    },
    /// The distance of two points is given: a cylinder.
    Cylinder {
        /// One end.
        a: PointId,
        /// The other end.
        b: PointId,
        /// Their distance (m); absent where the pose is given by coordinates.
        length: Option<Given>,
        /// Numbers of barrel and rod, where they have numbers: links that turn with the line a–b. They carry no further points.
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
    /// Metres.
    pub value: Given,
}

/// Says on which side of the directed line `from`→`to` a point lies.
#[derive(Clone, Debug, PartialEq)]
pub struct Side {
    /// The point.
    pub point: PointId,
    /// Left (true) or right of the line.
    pub left: bool,
    /// Start of the line.
    pub from: PointId,
    /// End of the line.
    pub to: PointId,
    /// Where it is said.
    pub span: Span,
}

/// A point of a certain link: `B3` is the point of link 3 that lies at B.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct OnLink {
    /// The place.
    pub point: PointId,
    /// The link; `None` where the point is the same on all links that carry it.
    pub link: Option<LinkId>,
}

/// One asked quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Find {
    /// Which.
    pub what: Asked,
    /// As written, such as `v_E`.
    pub text: String,
    /// Where.
    pub span: Span,
}

/// What moves in a composite motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Moving {
    /// A point of the scene.
    Point(OnLink),
    /// The point of a link, the cam or its follower, at which the two touch at the instant.
    Contact {
        /// Index into [`Scene::cams`].
        cam: usize,
        /// The link whose point it is.
        on: LinkId,
    },
}

/// A moving point, and the frame from which its motion is seen.
#[derive(Clone, Debug, PartialEq)]
pub struct Seen {
    /// The moving point.
    pub of: Moving,
    /// The frame.
    pub frame: Frame,
    /// Where it is said.
    pub span: Span,
}

/// A wrong solution that is to be shown beside the right one.
#[derive(Clone, Debug, PartialEq)]
pub struct Attempted {
    /// What was done wrong.
    pub mistake: Mistake,
    /// The point at which it was done, where several offer themselves: a pin in a slot, a contact, a point found by image.
    pub pair: Option<String>,
    /// The link of which it was done.
    pub link: Option<LinkId>,
    /// What was printed, by the question that it answers; of a vector its magnitude.
    pub printed: Vec<(Find, Given)>,
    /// The author's words for why it is wrong.
    pub why: Option<Localized>,
    /// Where it is said.
    pub span: Span,
}

/// Paper and scales. A fixed scale is in SI per millimetre of paper.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Paper {
    /// Width and height in mm; absent: as large as the sheet needs.
    pub size_mm: Option<[f64; 2]>,
    /// Fixed scales, SI per mm of paper.
    pub scales: ByKind,
    /// The pencil error (mm) within which 95 % of the marks fall.
    pub pencil_mm: Option<f64>,
    /// Units (SI) in which scales are round; of a kind without one the SI unit.
    pub round_in: ByKind,
}

impl Paper {
    /// The scale of a kind (SI per mm): the fixed one, or the one that is chosen round in a unit (SI).
    pub fn scale(&self, kind: Kind, choose: impl FnOnce(f64) -> f64) -> f64 {
        self.scales.get(kind).unwrap_or_else(|| choose(self.unit(kind)))
    }

    /// The unit (SI) in which the scale of a kind is round.
    pub fn unit(&self, kind: Kind) -> f64 {
        self.round_in.get(kind).unwrap_or(1.0)
    }
}

/// A scene: everything its file says.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Title.
    pub title: Localized,
    /// The problem statement, if the file has one.
    pub statement: Option<Statement>,
    /// Named parameters with their SI values, as written.
    pub parameters: Vec<(String, Given)>,
    /// Points in order of first mention.
    pub points: Vec<Point>,
    /// Links; sliders that are named only in a guide come after those of `links`.
    pub links: Vec<Link>,
    /// The fixed link.
    pub ground: LinkId,
    /// Sliding pairs, those that stand for the contact of a cam among them; after those of the file the guides of rolling pairs.
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
    /// Sides that choose the assembly.
    pub sides: Vec<Side>,
    /// What is asked.
    pub find: Vec<Find>,
    /// Moving points and frames whose composite motions are shown.
    pub composite: Vec<Seen>,
    /// Wrong solutions that are shown beside the right one.
    pub attempts: Vec<Attempted>,
    /// Names of other readings of a figure that is lost; see [`readings`](super::readings).
    pub readings: Vec<String>,
    /// Language of the output unless the caller says otherwise.
    pub language: Option<Lang>,
    /// Name of the notation profile (`en`, `cn`), unless the caller says otherwise.
    pub notation: Option<String>,
    /// Paper.
    pub paper: Paper,
    /// The unit in which the file writes its lengths: what is said of the scene is said in it.
    pub length_unit: &'static Unit,
    /// The units in which answers, scales and tables are printed.
    pub book: Book,
    /// The file of a scene with cams or loads: other positions and parameters are read from it again.
    pub source: Option<Source>,
}

impl Scene {
    /// For each link whether it turns as this one for topological reasons: it is this one, or joined to one that does by a slider, which
    /// keeps its direction on a straight guide.
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

    /// Name of a point.
    pub fn point_name(&self, p: PointId) -> &str {
        &self.points[p.0].name
    }

    /// Name of a link.
    pub fn link_name(&self, l: LinkId) -> &str {
        &self.links[l.0].name
    }

    /// The first moving link that carries a point.
    pub fn mover(&self, p: PointId) -> Option<LinkId> {
        self.carriers(p).find(|l| *l != self.ground)
    }

    /// The links that carry a point, in order.
    pub fn carriers(&self, p: PointId) -> impl Iterator<Item = LinkId> + '_ {
        self.links.iter().enumerate().filter(move |(_, l)| l.points.contains(&p)).map(|(i, _)| LinkId(i))
    }
}
