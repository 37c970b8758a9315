//! The quantities that a question can name: one file per family, and one list of the families.
//!
//! A family defines all properties of its quantities that do not depend on a solution: the form in
//! `find`, symbol, object, kind (hence unit) and level, form of the value, the motions that must be
//! known, and the joint without which the quantity is not defined. Every other module uses
//! [`Asked`] and does not distinguish families. A new quantity is a file with an `impl Quantity`
//! and its name in the list below.
//!
//! The drawing board, the loop equations and the sweep have their own ways to answer; they use the
//! [`Meaning`] of a question. A question without a meaning is computed by its own formula
//! ([`Asked::value`]) from places, vectors and angular velocities.

mod along;
mod cam;
mod centre;
pub mod combined;
pub mod composite;
mod contact;
pub mod curvature;
mod entry;
mod force;
mod forces;
mod frame;
mod from_centre;
mod joined;
mod level;
mod meaning;
mod place;
mod point;
mod ratio;
pub mod relative;
mod roller;
mod seen;
pub mod sliding;
#[cfg(test)]
mod tests;
mod transmission;
mod turning;
mod value;

pub use cam::CamQuantity;
pub use centre::InstantCentre;
pub use combined::{Combined, Operand};
pub use composite::Composite;
pub use contact::{Contact, bar, contacts, met_at, parties};
pub use curvature::{Curvature, OfPath, OfPole};
pub use entry::{Entry, Of, OverSign, ValueForm};
pub use force::{ByMotion, Force, ReactionPart};
pub use forces::{Forces, Wrench};
pub use frame::owns;
pub use frame::{Frame, RelativePath, relative_path};
pub use from_centre::FromCentre;
pub use hodograph_base::kind::Level;
pub use joined::{PointJoint, joined};
pub use level::{Need, Rate};
pub use meaning::ratio;
pub use meaning::{Meaning, RelativeComponent};
pub use place::{Axis, Place};
pub use point::PointMotion;
pub use ratio::Ratio;
pub use relative::Relative;
pub use roller::RollerSpin;
pub use seen::ObservedPart;
pub use seen::{heading, split};
pub use sliding::Sliding;
pub use transmission::Transmission;
pub use turning::Turning;
pub use value::{AnswerValue, FormulaInputs, ROUNDING};

use super::model::{Find, LinkId, OnLink, Scene};
use super::resolve::Question;
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::diagram::DiagramKind;
use hodograph_base::kind::Kind;
use hodograph_base::number::Real;

/// A family of quantities.
trait Quantity: Copy + Into<Asked> {
    /// The rows of the table: all combinations of symbol, kind and name.
    const WRITTEN: &'static [Entry];

    /// Reads a question whose symbol is among [`Quantity::WRITTEN`]; returns `None` if the names
    /// after it belong to another family.
    ///
    /// # Errors
    /// Names that do not fit the symbol in any family.
    fn read(question: &Question<'_>) -> Result<Option<Self>, Diagnostic>;

    /// Returns its row of the table.
    fn entry(&self) -> &'static Entry;

    /// Returns the object of the quantity.
    fn of(&self) -> Of;

    /// Returns its meaning; `None` if no module has its own way to answer it.
    fn meaning(&self, scene: &Scene) -> Option<Meaning>;

    /// Returns the motions that must be known.
    fn needs(&self) -> Vec<(Need, Level)> {
        self.of().needs(self.entry().level)
    }

    /// Returns the links that must have a place, in addition to the motions of [`Quantity::needs`].
    fn places(&self, _scene: &Scene) -> Vec<LinkId> {
        Vec::new()
    }

    /// Returns the reason why it is not defined in this scene.
    fn fault(&self, _scene: &Scene, _find: &Find) -> Option<Diagnostic> {
        None
    }

    /// Returns the reason why it has no value although the motion is known: a divisor vanishes, or
    /// it needs the direction of a zero vector.
    fn no_value(&self, _scene: &Scene) -> Both {
        both!("nothing defines it in this pose")
    }

    /// Returns the reason why it is infinite in the pose of the scene, if it is.
    fn infinite(&self, _scene: &Scene) -> Option<Both> {
        None
    }

    /// Returns a note on the object of the answer.
    fn note(&self, _scene: &Scene, _find: &Find) -> Option<Diagnostic> {
        None
    }

    /// Returns its value from known places, vectors and rates.
    fn value<N: Real, K: FormulaInputs<N>>(&self, known: &K) -> Option<AnswerValue<N>> {
        self.meaning(known.scene())?.value(self.entry().level, known)
    }
}

/// Writes the closed type of all families, and the calls to each.
macro_rules! families {
    ($($(#[$doc:meta])* $Family:ident),+ $(,)?) => {
        /// A quantity to find.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum Asked {
            $($(#[$doc])* $Family($Family)),+
        }

        $(impl From<$Family> for Asked {
            fn from(q: $Family) -> Asked {
                Asked::$Family(q)
            }
        })+

        /// The rows of all families, in the order of the list.
        const TABLES: &[&[Entry]] = &[$($Family::WRITTEN),+];

        impl Asked {
            /// Reads a question with a known symbol: the first family that accepts it.
            pub(crate) fn read(question: &Question<'_>) -> Result<Option<Asked>, Diagnostic> {
                $(if question.is_among($Family::WRITTEN) && let Some(q) = $Family::read(question)? {
                    return Ok(Some(q.into()));
                })+
                Ok(None)
            }

            /// Returns its row of the table: symbol, kind, level, form, names.
            pub fn entry(&self) -> &'static Entry {
                match self { $(Asked::$Family(q) => q.entry()),+ }
            }

            /// Returns the object of the quantity.
            pub fn of(&self) -> Of {
                match self { $(Asked::$Family(q) => q.of()),+ }
            }

            /// Returns the meaning by which other modules answer; `None`: by the formula of
            /// [`Asked::value`].
            pub fn meaning(&self, scene: &Scene) -> Option<Meaning> {
                match self { $(Asked::$Family(q) => q.meaning(scene)),+ }
            }

            /// Returns the motions that must be known for it, each with its level.
            pub fn needs(&self) -> Vec<(Need, Level)> {
                match self { $(Asked::$Family(q) => q.needs()),+ }
            }

            /// Returns the links that must have a place, in addition to the moving ones.
            pub fn places(&self, scene: &Scene) -> Vec<LinkId> {
                match self { $(Asked::$Family(q) => q.places(scene)),+ }
            }

            /// Returns its value by the formulas of relative motion; `None` if data are unknown, or
            /// if it is not defined.
            pub fn value<N: Real, K: FormulaInputs<N>>(&self, known: &K) -> Option<AnswerValue<N>> {
                match self { $(Asked::$Family(q) => q.value(known)),+ }
            }

            /// Returns the reason why it has no value in a pose with known motion.
            pub fn no_value(&self, scene: &Scene) -> Both {
                match self { $(Asked::$Family(q) => q.no_value(scene)),+ }
            }

            /// Returns the reason why it is infinite in the pose of the scene, if it is.
            pub fn infinite(&self, scene: &Scene) -> Option<Both> {
                match self { $(Asked::$Family(q) => q.infinite(scene)),+ }
            }

            fn note(&self, scene: &Scene, find: &Find) -> Option<Diagnostic> {
                match self { $(Asked::$Family(q) => q.note(scene, find)),+ }
            }

            fn fault(&self, scene: &Scene, find: &Find) -> Option<Diagnostic> {
                match self { $(Asked::$Family(q) => q.fault(scene, find)),+ }
            }
        }
    };
}

families! {
    /// `v_E`, `a_B3`: motion of a point.
    PointMotion,
    /// `v_CB`, `an_CB`: motion of a point relative to another.
    Relative,
    /// `vr_B3B2`, `ak_B3B2`: sliding of a point on another link.
    Sliding,
    /// `ve_A/2`, `arn_A/2`, `path_A/2`: motion of a point with a frame and relative to it.
    Composite,
    /// `omega_3`, `alpha_3/2`: rotation of a link.
    Turning,
    /// `x_E`, `phi_3`, `l_AB`: places, angles and distances.
    Place,
    /// `rho_E`, `J_2`, `K_2`: curvature of paths, and the quantities of the pole of a link.
    Curvature,
    /// `s_3`, `pressure_3`, `rho_2/3`: quantities of a cam and its follower.
    CamQuantity,
    /// `P_13D`: the distance of a point from the instantaneous centre of two links.
    FromCentre,
    /// `P_24`: the instantaneous centre of two links.
    InstantCentre,
    /// `i_24`: the transmission ratio of two links.
    Ratio,
    /// `spin_3`: the angular velocity of a roller.
    RollerSpin,
    /// `gamma_C`: the transmission angle at a pin.
    Transmission,
    /// `F_12`, `M_b`, `FI_3`: forces and moments.
    Force,
    /// `omega_2 + omega_4`, `P13D/P13A`: the sum, the difference or the ratio of two quantities.
    Combined,
}

impl Asked {
    /// Returns the kind of the quantity, which determines its unit.
    pub fn kind(&self) -> Kind {
        self.entry().kind
    }

    /// Returns its level.
    pub fn level(&self) -> Level {
        self.entry().level
    }

    /// Returns the diagram in which it is read.
    pub fn diagram(&self) -> DiagramKind {
        if self.kind().is_of_forces() { DiagramKind::Force } else { DiagramKind::of(self.level()) }
    }

    /// Returns the points of the question; the reference point comes last.
    pub fn points(&self, scene: &Scene) -> Vec<OnLink> {
        match self.meaning(scene) {
            Some(Meaning::Vector(p)) => vec![p],
            Some(Meaning::Relative(_, a, b)) => vec![a, b],
            Some(Meaning::Seen(_, of, frame, _)) => vec![of, frame.transport_point(of)],
            Some(Meaning::Turning(..) | Meaning::Ratio(..) | Meaning::Place(_)) | None => {
                Vec::new()
            }
        }
    }
}

/// Returns all rows of the table, in the order of the families.
pub(crate) fn lines() -> impl Iterator<Item = &'static Entry> {
    TABLES.iter().copied().flatten()
}

/// Returns the rows of the table, one for each symbol, in the order of the families.
pub(crate) fn symbols() -> Vec<&'static Entry> {
    let mut out: Vec<&Entry> = Vec::new();
    for entry in lines() {
        if !out.iter().any(|e| e.symbol == entry.symbol) {
            out.push(entry);
        }
    }
    out
}

/// Returns the notes on all questions, each once.
pub fn notes(scene: &Scene) -> Vec<Diagnostic> {
    let mut out: Vec<Diagnostic> = Vec::new();
    for note in scene.find.iter().filter_map(|f| f.what.note(scene, f)) {
        if !out.iter().any(|d| d.message == note.message) {
            out.push(note);
        }
    }
    out
}

/// Returns the faults of questions that are not defined in the scene, such as sliding without a
/// guide.
pub fn undefined(scene: &Scene) -> Faults {
    let mut faults = Faults::default();
    scene.find.iter().filter_map(|f| f.what.fault(scene, f)).for_each(|d| faults.push(d));
    faults
}
