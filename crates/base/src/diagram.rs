//! Kinds of diagrams: the list of all drawings with their own scale, and the properties that differ
//! between them.

use crate::diag::{Both, both};
use crate::kind::{Kind, Level};
use crate::lang::{Lang, tr};
use serde::{Deserialize, Serialize};

/// A kind of diagram.
///
/// A [`Level`] is the order of a derivative; a diagram kind names a drawing. To add a kind, add an
/// entry to [`DiagramKind::ALL`] and one to each function below; the compiler shows every other
/// affected place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DiagramKind {
    /// The mechanism in its plane, drawn to μ_l.
    Plane,
    /// The velocity polygon.
    Velocity,
    /// The acceleration polygon.
    Acceleration,
    /// A force polygon: one for each group and each driver, without a pole.
    Force,
}

impl DiagramKind {
    /// All kinds, in drawing order.
    pub const ALL: [DiagramKind; 4] =
        [DiagramKind::Plane, DiagramKind::Velocity, DiagramKind::Acceleration, DiagramKind::Force];

    /// The diagrams of one construction of the motion at an instant: the plane and the polygons
    /// with a pole.
    pub const OF_MOTION: [DiagramKind; 3] =
        [DiagramKind::Plane, DiagramKind::Velocity, DiagramKind::Acceleration];

    /// The diagrams with vectors drawn from a pole, in drawing order.
    pub const POLYGONS: [DiagramKind; 2] = [DiagramKind::Velocity, DiagramKind::Acceleration];

    /// The diagrams of vectors, in drawing order.
    pub const VECTORS: [DiagramKind; 3] =
        [DiagramKind::Velocity, DiagramKind::Acceleration, DiagramKind::Force];

    /// Returns the polygon of the derivatives of an order; the plane for positions.
    pub const fn of(level: Level) -> DiagramKind {
        match level {
            Level::Position => DiagramKind::Plane,
            Level::Velocity => DiagramKind::Velocity,
            Level::Acceleration => DiagramKind::Acceleration,
        }
    }

    /// Returns the order of derivative of the drawn quantity; the lowest level for forces, which
    /// are no derivatives.
    pub const fn level(self) -> Level {
        match self {
            DiagramKind::Plane | DiagramKind::Force => Level::Position,
            DiagramKind::Velocity => Level::Velocity,
            DiagramKind::Acceleration => Level::Acceleration,
        }
    }

    /// Returns the kind of quantity that a distance on the diagram represents.
    pub const fn kind(self) -> Kind {
        match self {
            DiagramKind::Plane => Kind::Length,
            DiagramKind::Velocity => Kind::Velocity,
            DiagramKind::Acceleration => Kind::Acceleration,
            DiagramKind::Force => Kind::Force,
        }
    }

    /// Returns the kind of quantity of a link's rotation that is measured on the diagram.
    pub const fn turning(self) -> Kind {
        match self {
            DiagramKind::Plane => Kind::Angle,
            DiagramKind::Velocity => Kind::Omega,
            DiagramKind::Acceleration => Kind::Alpha,
            DiagramKind::Force => Kind::Moment,
        }
    }

    /// Returns the symbol of its vectors, which is the subscript of its scale: `l`, `v`, `a`.
    pub const fn letter(self) -> &'static str {
        match self {
            DiagramKind::Plane => "l",
            DiagramKind::Velocity => "v",
            DiagramKind::Acceleration => "a",
            DiagramKind::Force => "F",
        }
    }

    /// Returns the symbol of a link's rotation, in the label language.
    pub const fn turning_letter(self) -> &'static str {
        match self {
            DiagramKind::Plane => "\\varphi",
            DiagramKind::Velocity => "\\omega",
            DiagramKind::Acceleration => "\\alpha",
            DiagramKind::Force => "M",
        }
    }

    /// Returns the mark after the letters of its points: p, b; p′, b′.
    pub const fn prime(self) -> &'static str {
        match self {
            DiagramKind::Plane | DiagramKind::Velocity | DiagramKind::Force => "",
            DiagramKind::Acceleration => "'",
        }
    }

    /// Returns the word for it in files, arguments and the classes of items of figures.
    pub const fn word(self) -> &'static str {
        match self {
            DiagramKind::Plane => "mechanism",
            DiagramKind::Velocity => "velocity",
            DiagramKind::Acceleration => "acceleration",
            DiagramKind::Force => "force",
        }
    }

    /// Returns the prefix of the ids of its items.
    pub const fn prefix(self) -> &'static str {
        match self {
            DiagramKind::Plane => "mechanism",
            DiagramKind::Velocity => "vel",
            DiagramKind::Acceleration => "acc",
            DiagramKind::Force => "force",
        }
    }

    /// Returns the name of one of its vectors.
    pub fn vector(self) -> Both {
        match self {
            DiagramKind::Plane => both!("length"),
            DiagramKind::Velocity => both!("velocity"),
            DiagramKind::Acceleration => both!("acceleration"),
            DiagramKind::Force => both!("force"),
        }
    }

    /// Returns the name of several of its vectors.
    pub fn vectors(self) -> Both {
        match self {
            DiagramKind::Plane => both!("lengths"),
            DiagramKind::Velocity => both!("velocities"),
            DiagramKind::Acceleration => both!("accelerations"),
            DiagramKind::Force => both!("forces"),
        }
    }

    /// Returns the name of the drawing, as a caption.
    pub const fn caption(self, lang: Lang) -> &'static str {
        match self {
            DiagramKind::Plane => tr!(lang, "Kinematic diagram"),
            DiagramKind::Velocity => tr!(lang, "Velocity polygon"),
            DiagramKind::Acceleration => tr!(lang, "Acceleration polygon"),
            DiagramKind::Force => tr!(lang, "Force polygon"),
        }
    }

    /// Returns the name of the drawing for use within a sentence.
    pub fn name(self, lang: Lang) -> String {
        self.caption(lang).to_lowercase()
    }
}
