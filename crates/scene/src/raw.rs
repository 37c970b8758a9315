//! The scene file as written: the words of the file, each with its place, without interpretation.

use super::cams::raw::RawCam;
use super::model::TimeLaw;
use super::rolling::RollingKind;
use hodograph_base::diag::Span;
use hodograph_base::json::Word;

/// A number or expression as written.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct RawQuantity {
    /// Text as written: `100`, `100 mm`, `2*r`.
    pub text: String,
    /// Its place, including quotation marks.
    pub span: Span,
    /// True for a JSON number, without quotation marks.
    pub bare: bool,
}

/// A text in one language (`other` absent) or in both.
#[derive(Clone, Debug, Default)]
pub(super) struct RawLocalized {
    pub en: Option<Word>,
    pub zh: Option<Word>,
}

#[derive(Clone, Debug)]
pub(super) struct RawLink {
    pub name: Word,
    pub points: Vec<Word>,
}

#[derive(Clone, Debug)]
pub(super) enum RawPlace {
    At([RawQuantity; 2]),
    InLink { base: Word, xy: [RawQuantity; 2] },
    Polar { base: Word, length: RawQuantity, angle: RawQuantity },
}

#[derive(Clone, Debug)]
pub(super) enum RawThrough {
    Point(Word),
    At([RawQuantity; 2], Span),
}

#[derive(Clone, Debug)]
pub(super) struct RawGuide {
    pub pin: Option<Word>,
    pub slider: Option<Word>,
    pub on: Option<Word>,
    pub line: Option<Word>,
    pub through: Option<RawThrough>,
    pub angle: Option<RawQuantity>,
    /// True if the angle is measured from the guide in which the carrying link slides.
    pub slid: bool,
    pub offset: Option<RawQuantity>,
    pub centre: Option<Word>,
    pub radius: Option<RawQuantity>,
    pub length: Option<RawQuantity>,
    /// True if the guide replaces the contact of a cam and is not one of the file.
    pub contact: bool,
    pub span: Span,
}

impl RawGuide {
    /// A slot on a link in which a pin runs, at any position.
    pub fn of_pin(pin: Word, on: Word, span: Span) -> RawGuide {
        RawGuide {
            pin: Some(pin),
            slider: None,
            on: Some(on),
            line: None,
            through: None,
            angle: None,
            slid: false,
            offset: None,
            centre: None,
            radius: None,
            length: None,
            contact: false,
            span,
        }
    }
}

/// A gear pair or a wheel on its track.
#[derive(Clone, Debug)]
pub(super) struct RawRolling {
    /// The two links, each with the centre of its circle; a straight track or rack comes first and
    /// has no centre.
    pub sides: [RawRollingSide; 2],
    pub sizes: RawSizes,
    pub kind: RollingKind,
    /// The strand of a belt or chain that joins them.
    pub strand: Option<RawStrand>,
    /// Direction of a straight track, and a point of it.
    pub line: Option<Word>,
    pub through: Option<RawThrough>,
    pub angle: Option<RawQuantity>,
    pub at: Option<Word>,
    pub phase: Option<RawQuantity>,
    pub flanks: RawFlanks,
    pub span: Span,
}

/// A strand of a belt or chain; it begins at the pair's `at`.
#[derive(Clone, Debug)]
pub(super) struct RawStrand {
    /// Index of the belt or chain in the file.
    pub belt: usize,
    pub crossed: bool,
    /// True if the strand is to the right of the line of centres.
    pub right: bool,
    /// Name of its end point.
    pub end: Option<Word>,
}

/// The file's data of a gear pair's flanks.
#[derive(Clone, Debug, Default)]
pub(super) struct RawFlanks {
    pub pressure_angle: Option<RawQuantity>,
    pub shift: Option<Vec<RawQuantity>>,
    pub addendum: Option<RawQuantity>,
    pub clearance: Option<RawQuantity>,
}

/// One link of a rolling pair.
#[derive(Clone, Debug)]
pub(super) struct RawRollingSide {
    /// The link; `None` is the ground.
    pub link: Option<Word>,
    /// Centre of its circle; `None` for a straight contour.
    pub centre: Option<Word>,
    /// True if the other one rolls inside it.
    pub hollow: bool,
}

/// Sizes of the circles of a rolling pair.
#[derive(Clone, Debug)]
pub(super) enum RawSizes {
    /// Radii; for a straight track, the wheel's only.
    Radii(Vec<RawQuantity>),
    /// Numbers of teeth (for a rack, the gear's only), and the module if given.
    Teeth(Vec<RawQuantity>, Option<RawQuantity>),
}

#[derive(Clone, Debug)]
pub(super) struct RawDriver {
    pub kind: RawDriverKind,
    /// Missing if its fault has been reported.
    pub rate: Option<RawQuantity>,
    pub acceleration: Option<RawQuantity>,
    /// The law of time that gives rate and acceleration.
    pub law: Option<TimeLaw>,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub(super) enum RawDriverKind {
    Turn {
        link: Word,
        against: Option<Word>,
        line: Option<Word>,
        against_line: Option<Word>,
        angle: Option<RawQuantity>,
    },
    Slide {
        slide: Word,
        position: Option<RawQuantity>,
    },
    Cylinder {
        ends: Word,
        length: Option<RawQuantity>,
        links: Vec<Word>,
    },
}

#[derive(Clone, Debug)]
pub(super) enum RawSize {
    Named(Word),
    Sides([RawQuantity; 2]),
}

#[derive(Clone, Debug, Default)]
pub(super) struct RawPaper {
    pub size: Option<RawSize>,
    pub mu_l: Option<RawQuantity>,
    pub mu_v: Option<RawQuantity>,
    pub mu_a: Option<RawQuantity>,
    pub mu_f: Option<RawQuantity>,
    pub pencil: Option<RawQuantity>,
}

/// A moving point and a frame.
#[derive(Clone, Debug)]
pub(super) struct RawComposite {
    pub point: Word,
    pub on: Option<Word>,
    pub frame: Word,
    pub span: Span,
}

/// A wrong solution.
#[derive(Clone, Debug)]
pub(super) struct RawAttempt {
    pub mistake: Word,
    pub pair: Option<Word>,
    pub link: Option<Word>,
    /// Questions with their printed results.
    pub printed: Vec<(Word, RawQuantity)>,
    pub why: Option<RawLocalized>,
    pub span: Span,
}

/// The sections of forces.
#[derive(Clone, Debug, Default)]
pub(super) struct RawLoads {
    pub gravity: Option<[RawQuantity; 2]>,
    pub masses: Vec<RawMass>,
    pub applied: Vec<RawApplied>,
    pub springs: Vec<RawSpring>,
    pub friction: Vec<RawFriction>,
    pub balance: Option<RawBalance>,
}

/// Friction in a pin or a guide.
#[derive(Clone, Debug)]
pub(super) struct RawFriction {
    pub pin: Option<Word>,
    pub slider: Option<Word>,
    pub on: Option<Word>,
    pub circle: Option<RawQuantity>,
    pub radius: Option<RawQuantity>,
    pub f: Option<RawQuantity>,
    pub span: Span,
}

/// Mass of a link, or its weight; moment of inertia of a link, or its radius of gyration.
#[derive(Clone, Debug)]
pub(super) struct RawMass {
    pub link: Word,
    pub m: Option<RawQuantity>,
    pub weight: Option<RawQuantity>,
    pub j: Option<RawQuantity>,
    pub k: Option<RawQuantity>,
    pub at: Option<Word>,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub(super) enum RawSizeOfForce {
    Components([RawQuantity; 2]),
    Magnitude(RawQuantity),
}

/// A force or a couple.
#[derive(Clone, Debug)]
pub(super) struct RawApplied {
    pub on: Word,
    pub at: Option<Word>,
    pub force: Option<RawSizeOfForce>,
    pub moment: Option<RawQuantity>,
    pub angle: Option<RawQuantity>,
    pub line: Option<Word>,
    pub against: Option<Word>,
    pub course: Option<RawCourse>,
    pub span: Span,
}

/// The part of a motion over which a load acts, with the amounts there.
#[derive(Clone, Debug)]
pub(super) struct RawCourse {
    pub slide: Option<Word>,
    pub toward: Option<RawQuantity>,
    pub turn: Option<Word>,
    pub period: Option<RawQuantity>,
    pub stations: Vec<(RawQuantity, Option<RawQuantity>)>,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub(super) struct RawSpring {
    pub from: Word,
    pub to: Word,
    pub k: RawQuantity,
    pub free: RawQuantity,
    pub span: Span,
}

/// The balancing force at a point, or the moment on a link.
#[derive(Clone, Debug)]
pub(super) struct RawBalance {
    pub link: Option<Word>,
    pub at: Option<Word>,
    pub angle: Option<RawQuantity>,
    pub span: Span,
}

/// The data of a mechanism that a file must give.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum RequiredData {
    /// Links and pairs: a driver, the direction of a guide and the profile of a cam may be missing.
    Pairs,
    /// The pose as well: only drivers and their rates may be missing.
    Pose,
    /// `Pose` for quantities that do not depend on rates: a missing driver is added, and
    /// missing rates are zero.
    Rest,
    /// `Rest` with missing rates of one unit.
    AnyRate,
    /// The motion: all data.
    #[default]
    Motion,
}

impl RequiredData {
    /// True if links and pairs are enough.
    pub fn is_of_pairs(self) -> bool {
        self == RequiredData::Pairs
    }

    /// True if drivers and their rates may be missing.
    pub fn is_at_rest(self) -> bool {
        self != RequiredData::Motion
    }

    /// True if a missing driver is added.
    pub fn is_driven(self) -> bool {
        matches!(self, RequiredData::Rest | RequiredData::AnyRate)
    }

    /// Returns the rate of a driver without one, in the unit of the driver. It is one where figures
    /// show it, so that they show the positive sense.
    pub fn rate(self) -> f64 {
        match self {
            RequiredData::Rest => 0.0,
            RequiredData::Pairs
            | RequiredData::Pose
            | RequiredData::AnyRate
            | RequiredData::Motion => 1.0,
        }
    }
}

/// A scene file, decoded.
#[derive(Clone, Debug, Default)]
pub(super) struct RawScene {
    /// The data that the file must give.
    pub extent: RequiredData,
    pub title: Option<RawLocalized>,
    pub statement: Option<RawLocalized>,
    pub parameters: Vec<(Word, RawQuantity)>,
    /// True if the last parameter is the instant.
    pub is_timed: bool,
    pub units: Vec<(Word, Word)>,
    pub answers: Vec<(Word, Word)>,
    pub links: Vec<RawLink>,
    /// True if the whole section `links` could be read. If not, a missing name may be in the unread
    /// part.
    pub links_sound: bool,
    pub ground: Option<Word>,
    pub points: Vec<(Word, RawPlace)>,
    pub lengths: Vec<(Word, RawQuantity)>,
    pub guides: Vec<RawGuide>,
    pub cams: Vec<RawCam>,
    pub rolling: Vec<RawRolling>,
    pub drivers: Vec<RawDriver>,
    pub loads: RawLoads,
    pub sketch: Vec<(Word, [RawQuantity; 2])>,
    pub sides: Vec<(Word, Word)>,
    /// `None` if the file has no such key: everything is asked.
    pub find: Option<Vec<Word>>,
    pub composite: Vec<RawComposite>,
    pub attempts: Vec<RawAttempt>,
    /// Names of other readings of the figure; [`super::readings`] reads their changes.
    pub readings: Vec<Word>,
    pub paper: RawPaper,
    pub language: Option<Word>,
    pub notation: Option<Word>,
}
