//! The section `cams` as written.

use super::super::raw::{RawQuantity, RawThrough};
use hodograph_base::diag::Span;
use hodograph_base::json::Word;

#[derive(Clone, Debug)]
pub(crate) struct RawCam {
    pub cam: Word,
    pub follower: Word,
    pub follows: RawFollows,
    pub profile: RawProfile,
    pub at: Option<Word>,
    /// How the cam stands in the link that carries it, where wheels turn it and not its driver.
    pub angle: Option<RawQuantity>,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub(crate) enum RawFollows {
    Edge(Word),
    /// `link` where the roller is a link of the file.
    Roller {
        pin: Word,
        radius: Option<RawQuantity>,
        link: Option<Word>,
    },
    Arc {
        pin: Word,
        radius: Option<RawQuantity>,
    },
    Face(RawFace),
}

impl RawFollows {
    pub fn pin(&self) -> Option<&Word> {
        match self {
            RawFollows::Edge(pin) | RawFollows::Roller { pin, .. } | RawFollows::Arc { pin, .. } => Some(pin),
            RawFollows::Face(face) => match &face.through {
                Some(RawThrough::Point(word)) => Some(word),
                Some(RawThrough::At(..)) | None => None,
            },
        }
    }

    /// Whether a round end has no radius, as counting needs none.
    pub fn lacks_radius(&self) -> bool {
        match self {
            RawFollows::Roller { radius, .. } | RawFollows::Arc { radius, .. } => radius.is_none(),
            RawFollows::Edge(_) | RawFollows::Face(_) => false,
        }
    }

    /// The centre of a roller.
    pub fn roller(&self) -> Option<&Word> {
        match self {
            RawFollows::Roller { pin, .. } => Some(pin),
            RawFollows::Edge(_) | RawFollows::Arc { .. } | RawFollows::Face(_) => None,
        }
    }

    pub fn radius(&self) -> Option<&RawQuantity> {
        match self {
            RawFollows::Roller { radius, .. } | RawFollows::Arc { radius, .. } => radius.as_ref(),
            RawFollows::Edge(_) | RawFollows::Face(_) => None,
        }
    }
}

#[derive(Clone, Debug)]
pub(crate) struct RawFace {
    /// Nothing for a sliding follower whose guide tells it.
    pub through: Option<RawThrough>,
    pub line: Option<Word>,
    pub angle: Option<RawQuantity>,
    /// Whether it stands square to the guide of its follower on a moving link: its direction is turned from that of the guide by 90°.
    pub square: bool,
    pub offset: Option<RawQuantity>,
    /// Whether the cam lies left of the face.
    pub left: Option<bool>,
}

#[derive(Clone, Debug)]
pub(crate) enum RawProfile {
    Parts(Vec<RawPart>),
    Law {
        base: RawQuantity,
        start: Option<RawQuantity>,
        clockwise: bool,
        stages: Vec<RawStage>,
    },
    /// Nothing is said of it, as counting needs nothing.
    Untold,
}

#[derive(Clone, Debug)]
pub(crate) enum RawPart {
    Circle { centre: Word, radius: RawQuantity },
    Corner(Word),
    Tangent(Span),
    Flank(RawQuantity),
}

#[derive(Clone, Debug)]
pub(crate) enum RawWay {
    Rise(RawQuantity, Word),
    Dwell,
    Return(RawQuantity, Word),
}

#[derive(Clone, Debug)]
pub(crate) struct RawStage {
    pub way: RawWay,
    pub over: RawQuantity,
}
