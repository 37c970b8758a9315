//! Kinds of file, and the features that each offers.

use crate::diag::{Both, Diagnostic, both};
use crate::{equation, particle, synthesis};

/// A kind of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Kind {
    /// A mechanism at an instant.
    Scene,
    /// A task of design.
    Task,
    /// Motions of points without a mechanism.
    Motion,
    /// A vector equation on its own.
    Equation,
}

impl Kind {
    /// Its word in documents for programs.
    pub fn word(self) -> &'static str {
        match self {
            Kind::Scene => "scene",
            Kind::Task => "task",
            Kind::Motion => "motion",
            Kind::Equation => "equation",
        }
    }
}

/// A feature that only some kinds of file offer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Wish {
    /// Links and joints.
    Mechanism,
    /// Answers to questions, for `solve`.
    Answers,
    /// A candidate to choose.
    Candidate,
    /// Tolerances of drawing by hand.
    Drafting,
    /// A picture for each step.
    Pictures,
    /// Several positions in one figure.
    Poses,
    /// Paths of points.
    Paths,
    /// A fragment for slides.
    Reveal,
    /// A wrong solution in which to find the mistake.
    Mistake,
    /// Degree of freedom and groups.
    Mobility,
    /// The analytic method with vector loops.
    Loops,
    /// A table of the whole motion.
    Table,
    /// Questions on concepts.
    Questions,
    /// The construction of a method, for lessons.
    Method,
}

impl Wish {
    /// The command-line option that requests it; empty if the command itself does.
    pub fn option(self) -> &'static str {
        match self {
            Wish::Mechanism | Wish::Answers => "",
            Wish::Candidate => "--pick",
            Wish::Drafting => "--drafting",
            Wish::Pictures => "--steps",
            Wish::Poses => "--poses",
            Wish::Paths => "--path",
            Wish::Reveal => "--reveal",
            Wish::Mistake => "--find-the-mistake",
            Wish::Mobility => "--mobility",
            Wish::Loops => "--loops",
            Wish::Table => "--table",
            Wish::Questions => "--questions",
            Wish::Method => "--method",
        }
    }
}

impl Kind {
    /// Returns the kind of a file, judged by its keys; a file that cannot be read counts as a
    /// scene.
    pub fn of(source: &[u8]) -> Kind {
        if synthesis::is_task(source) {
            Kind::Task
        } else if equation::is_problem(source) {
            Kind::Equation
        } else if particle::is_problem(source) {
            Kind::Motion
        } else {
            Kind::Scene
        }
    }

    /// Checks that files of this kind offer a feature.
    ///
    /// # Errors
    /// `not-a-scene`, or `no-candidate`, with what to do instead.
    pub fn grants(self, wish: Wish) -> Result<(), Diagnostic> {
        let granted = match self {
            Kind::Scene => wish != Wish::Candidate,
            Kind::Task => matches!(wish, Wish::Candidate | Wish::Pictures),
            Kind::Motion => wish == Wish::Answers,
            Kind::Equation => matches!(wish, Wish::Answers | Wish::Pictures),
        };
        match (granted, wish) {
            (true, _) => Ok(()),
            (false, Wish::Candidate) => Err(no_candidates()),
            (false, Wish::Mechanism | Wish::Answers) => Err(no_mechanism(self)),
            (false, _) => Err(self.refuses(wish.option())),
        }
    }

    fn refuses(self, option: &str) -> Diagnostic {
        let (message, help) = match self {
            Kind::Task => (
                both!("{option} is of scenes, and this is a synthesis file"),
                both!("leave it out, or make a scene first: `hodograph synth FILE -o scene.json`"),
            ),
            Kind::Scene | Kind::Motion | Kind::Equation => (
                both!("{option} is of mechanisms, and this file has none"),
                both!("leave {option} out"),
            ),
        };
        Diagnostic::error("not-a-scene", message).help(help)
    }
}

fn no_candidates() -> Diagnostic {
    let message = both!("a scene has no candidates: they are of synthesis files");
    Diagnostic::error("no-candidate", message).help(both!("leave --pick out"))
}

/// The refusal of a file without links by a command that needs them.
pub(super) fn no_mechanism(kind: Kind) -> Diagnostic {
    let (message, help): (Both, Both) = match kind {
        Kind::Task => (
            both!(
                "this is a synthesis file: it says what a linkage is to do, and is no linkage yet"
            ),
            both!(
                "`hodograph synth FILE -o scene.json` makes the scene; `draw`, `worksheet` and `lesson` take the file itself"
            ),
        ),
        Kind::Equation => (
            both!("this file has a vector equation without a mechanism: there are no links"),
            both!("`solve`, `plan`, `draw`, `worksheet` and `lesson` take it"),
        ),
        Kind::Scene | Kind::Motion => (
            both!("this file has motions without a mechanism: there are no links"),
            both!("`solve`, `draw`, `worksheet` and `lesson` take it"),
        ),
    };
    Diagnostic::error("not-a-scene", message).help(help)
}
