//! The section `cams` as written.

use super::super::raw::{RawQuantity, RawThrough};
use crate::diag::Span;
use crate::json::Word;

#[derive(Clone, Debug)]
pub(in crate::scene) struct RawCam {
    pub cam: Word,
    pub follower: Word,
    pub follows: RawFollows,
    pub profile: RawProfile,
    pub at: Option<Word>,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub(in crate::scene) enum RawFollows {
    Edge(Word),
    Roller { pin: Word, radius: RawQuantity },
    Arc { pin: Word, radius: RawQuantity },
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

    /// The centre of a roller.
    pub fn roller(&self) -> Option<&Word> {
        match self {
            RawFollows::Roller { pin, .. } => Some(pin),
            RawFollows::Edge(_) | RawFollows::Arc { .. } | RawFollows::Face(_) => None,
        }
    }

    pub fn radius(&self) -> Option<&RawQuantity> {
        match self {
            RawFollows::Roller { radius, .. } | RawFollows::Arc { radius, .. } => Some(radius),
            RawFollows::Edge(_) | RawFollows::Face(_) => None,
        }
    }
}

#[derive(Clone, Debug)]
pub(in crate::scene) struct RawFace {
    /// Nothing for a sliding follower whose guide tells it.
    pub through: Option<RawThrough>,
    pub line: Option<Word>,
    pub angle: Option<RawQuantity>,
    pub offset: Option<RawQuantity>,
    /// Whether the cam lies left of the face.
    pub left: Option<bool>,
}

#[derive(Clone, Debug)]
pub(in crate::scene) enum RawProfile {
    Parts(Vec<RawPart>),
    Law { base: RawQuantity, start: Option<RawQuantity>, clockwise: bool, stages: Vec<RawStage> },
}

#[derive(Clone, Debug)]
pub(in crate::scene) enum RawPart {
    Circle { centre: Word, radius: RawQuantity },
    Corner(Word),
    Tangent(Span),
    Flank(RawQuantity),
}

#[derive(Clone, Debug)]
pub(in crate::scene) enum RawWay {
    Rise(RawQuantity, Word),
    Dwell,
    Return(RawQuantity, Word),
}

#[derive(Clone, Debug)]
pub(in crate::scene) struct RawStage {
    pub way: RawWay,
    pub over: RawQuantity,
}
