//! The quantities that can be asked for: one file a family, and one list of them.
//!
//! A family says everything that is decided about its quantities before anything is solved: how `find` writes them, their symbol, what
//! they are of, kind (hence unit) and level, form of the value, which motions have to be known, and by which joint the quantity is
//! defined at all. Every other room asks [`Asked`]; none tells families apart. A new quantity is a file with an `impl Quantity` and its
//! name in the list below.
//!
//! The drawing board, the loop equations and the sweep each have ways of their own to answer; they go by the [`Meaning`] of a question.
//! One without it is calculated by its own formula ([`Asked::value`]) from places, vectors and angular velocities.

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
pub use entry::{Entry, Form, Of, Over};
pub use force::{Along, ByMotion, Force};
pub use forces::{Forces, Wrench};
pub use frame::owns;
pub use frame::{Frame, RelativePath, relative_path};
pub use from_centre::FromCentre;
pub use hodograph_base::kind::Level;
pub use joined::{Joined, joined};
pub use level::{Need, Rate};
pub use meaning::ratio;
pub use meaning::{Meaning, Split};
pub use place::{Axis, Place};
pub use point::PointMotion;
pub use ratio::Ratio;
pub use relative::Relative;
pub use roller::RollerSpin;
pub use seen::Seen;
pub use seen::{heading, split};
pub use sliding::Sliding;
pub use transmission::Transmission;
pub use turning::Turning;
pub use value::{Known, ROUNDING, Value};

use super::model::{Find, LinkId, OnLink, Scene};
use super::resolve::Question;
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::diagram::DiagramKind;
use hodograph_base::kind::Kind;
use hodograph_base::number::Real;

/// A family of quantities.
trait Quantity: Copy + Into<Asked> {
    /// The lines of the table: all that share a symbol's letters, kind and name.
    const WRITTEN: &'static [Entry];

    /// Reads a question whose symbol is among [`Quantity::WRITTEN`]; `None` where the names behind it make it another family's.
    ///
    /// # Errors
    /// Names that do not fit the symbol in any family.
    fn read(question: &Question<'_>) -> Result<Option<Self>, Diagnostic>;

    /// Its line of the table.
    fn entry(&self) -> &'static Entry;

    /// What it is a quantity of.
    fn of(&self) -> Of;

    /// What it comes down to; `None`: no room has a way of its own for it.
    fn meaning(&self, scene: &Scene) -> Option<Meaning>;

    /// The motions that must be known.
    fn needs(&self) -> Vec<(Need, Level)> {
        self.of().needs(self.entry().level)
    }

    /// The links that must be placed beside what moves as [`Quantity::needs`] says.
    fn places(&self, _scene: &Scene) -> Vec<LinkId> {
        Vec::new()
    }

    /// Why it is not defined in this scene.
    fn fault(&self, _scene: &Scene, _find: &Find) -> Option<Diagnostic> {
        None
    }

    /// Why it has no value where the motion is known: what it is divided by vanishes, or a direction that it needs is that of a zero vector.
    fn no_value(&self, _scene: &Scene) -> Both {
        both!("nothing defines it in this pose", "该位置此量无定义")
    }

    /// Why it is infinite in the pose of the scene, if it is.
    fn infinite(&self, _scene: &Scene) -> Option<Both> {
        None
    }

    /// A remark on what the answer is of.
    fn note(&self, _scene: &Scene, _find: &Find) -> Option<Diagnostic> {
        None
    }

    /// Its value where places, vectors and rates are known.
    fn value<N: Real, K: Known<N>>(&self, known: &K) -> Option<Value<N>> {
        self.meaning(known.scene())?.value(self.entry().level, known)
    }
}

/// Writes the closed type of all families, and the doors to each.
macro_rules! families {
    ($($(#[$doc:meta])* $Family:ident),+ $(,)?) => {
        /// A quantity that is asked for.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum Asked {
            $($(#[$doc])* $Family($Family)),+
        }

        $(impl From<$Family> for Asked {
            fn from(q: $Family) -> Asked {
                Asked::$Family(q)
            }
        })+

        /// The lines of all families, in the order of the list.
        const TABLES: &[&[Entry]] = &[$($Family::WRITTEN),+];

        impl Asked {
            /// Reads a question of a known symbol: the first family that takes it.
            pub(crate) fn read(question: &Question<'_>) -> Result<Option<Asked>, Diagnostic> {
                $(if question.is_among($Family::WRITTEN) && let Some(q) = $Family::read(question)? {
                    return Ok(Some(q.into()));
                })+
                Ok(None)
            }

            /// Its line of the table: symbol, kind, level, form, names.
            pub fn entry(&self) -> &'static Entry {
                match self { $(Asked::$Family(q) => q.entry()),+ }
            }

            /// What it is a quantity of.
            pub fn of(&self) -> Of {
                match self { $(Asked::$Family(q) => q.of()),+ }
            }

            /// By which the rooms that answer go; `None`: by the formula of [`Asked::value`].
            pub fn meaning(&self, scene: &Scene) -> Option<Meaning> {
                match self { $(Asked::$Family(q) => q.meaning(scene)),+ }
            }

            /// The motions that must be known for it, each with its level.
            pub fn needs(&self) -> Vec<(Need, Level)> {
                match self { $(Asked::$Family(q) => q.needs()),+ }
            }

            /// The links that must be placed beside what has to move.
            pub fn places(&self, scene: &Scene) -> Vec<LinkId> {
                match self { $(Asked::$Family(q) => q.places(scene)),+ }
            }

            /// Its value by the formulas of relative motion; `None` where something is not known, or nothing defines it.
            pub fn value<N: Real, K: Known<N>>(&self, known: &K) -> Option<Value<N>> {
                match self { $(Asked::$Family(q) => q.value(known)),+ }
            }

            /// Why it has no value in a pose of which the motion is known.
            pub fn no_value(&self, scene: &Scene) -> Both {
                match self { $(Asked::$Family(q) => q.no_value(scene)),+ }
            }

            /// Why it is infinite in the pose of the scene, if it is.
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
    /// `v_E`, `a_B3`: how a point moves.
    PointMotion,
    /// `v_CB`, `an_CB`: how a point moves against another.
    Relative,
    /// `vr_B3B2`, `ak_B3B2`: how a point slides on another link.
    Sliding,
    /// `ve_A/2`, `arn_A/2`, `path_A/2`: how a point moves as a frame carries it and sees it.
    Composite,
    /// `omega_3`, `alpha_3/2`: how a link turns.
    Turning,
    /// `x_E`, `phi_3`, `l_AB`: where things are.
    Place,
    /// `rho_E`, `J_2`, `K_2`: how paths bend, and what belongs to the pole of a link.
    Curvature,
    /// `s_3`, `pressure_3`, `rho_2/3`: of a cam and its follower.
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
    /// `omega_2 + omega_4`, `P13D/P13A`: the sum, the difference or the ratio of two.
    Combined,
}

impl Asked {
    /// The kind of the quantity: which unit it has.
    pub fn kind(&self) -> Kind {
        self.entry().kind
    }

    /// How deep it asks.
    pub fn level(&self) -> Level {
        self.entry().level
    }

    /// The diagram on which it is read.
    pub fn diagram(&self) -> DiagramKind {
        if self.kind().is_of_forces() { DiagramKind::Force } else { DiagramKind::of(self.level()) }
    }

    /// The points of whose motion it is asked, the one from which the other is seen last.
    pub fn points(&self, scene: &Scene) -> Vec<OnLink> {
        match self.meaning(scene) {
            Some(Meaning::Vector(p)) => vec![p],
            Some(Meaning::Relative(_, a, b)) => vec![a, b],
            Some(Meaning::Seen(_, of, frame, _)) => vec![of, frame.transport_point(of)],
            Some(Meaning::Turning(..) | Meaning::Ratio(..) | Meaning::Place(_)) | None => Vec::new(),
        }
    }
}

/// All lines of the table, in the order of the families.
pub(crate) fn lines() -> impl Iterator<Item = &'static Entry> {
    TABLES.iter().copied().flatten()
}

/// The lines of the table, one for each symbol, in the order of the families.
pub(crate) fn symbols() -> Vec<&'static Entry> {
    let mut out: Vec<&Entry> = Vec::new();
    for entry in lines() {
        if !out.iter().any(|e| e.symbol == entry.symbol) {
            out.push(entry);
        }
    }
    out
}

/// Remarks on what is asked, each once.
pub fn notes(scene: &Scene) -> Vec<Diagnostic> {
    let mut out: Vec<Diagnostic> = Vec::new();
    for note in scene.find.iter().filter_map(|f| f.what.note(scene, f)) {
        if !out.iter().any(|d| d.message == note.message) {
            out.push(note);
        }
    }
    out
}

/// The faults of questions that nothing in the scene defines, such as a sliding without a guide.
pub fn undefined(scene: &Scene) -> Faults {
    let mut faults = Faults::default();
    scene.find.iter().filter_map(|f| f.what.fault(scene, f)).for_each(|d| faults.push(d));
    faults
}
