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
    /// Angle of the cam in the link that carries it, if wheels turn it instead of its own driver.
    pub angle: Option<RawQuantity>,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub(crate) enum RawFollows {
    Edge(Word),
    /// `link` if the roller is a link of the file.
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
            RawFollows::Edge(pin)
            | RawFollows::Roller { pin, .. }
            | RawFollows::Arc { pin, .. } => Some(pin),
            RawFollows::Face(face) => match &face.through {
                Some(RawThrough::Point(word)) => Some(word),
                Some(RawThrough::At(..)) | None => None,
            },
        }
    }

    /// True for a round end without a radius, which a mobility count does not need.
    pub fn lacks_radius(&self) -> bool {
        match self {
            RawFollows::Roller { radius, .. } | RawFollows::Arc { radius, .. } => radius.is_none(),
            RawFollows::Edge(_) | RawFollows::Face(_) => false,
        }
    }

    /// Returns the centre of a roller.
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
    /// `None` for a sliding follower, if its guide determines the point.
    pub through: Option<RawThrough>,
    pub line: Option<Word>,
    pub angle: Option<RawQuantity>,
    /// True if the face is square to the guide of its follower on a moving link: its direction is
    /// that of the guide turned by 90°.
    pub square: bool,
    pub offset: Option<RawQuantity>,
    /// True if the cam is to the left of the face.
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
    /// Not given, for a mobility count.
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
