//! The templates of all kinds of file in the library.

use super::Kind;
use crate::diag::{Both, Faults};
use crate::scene::{self, edit};
use crate::{equation, particle, synthesis};

/// A template: a file with parameters that can be set.
#[derive(Clone, Debug, PartialEq)]
pub struct Template {
    /// Its name.
    pub name: &'static str,
    /// Its kind.
    pub kind: Kind,
    /// Its title.
    pub title: Both,
    /// Parameters of a scene with their values.
    pub parameters: Vec<(String, String)>,
}

/// Returns all templates: scenes, tasks of design, motions, vector equations.
pub fn all() -> Vec<Template> {
    let scenes = scene::templates::list().into_iter();
    let of = |name, kind, title| Template { name, kind, title, parameters: Vec::new() };
    scenes
        .map(|t| Template {
            parameters: t.parameters,
            ..of(t.name, Kind::Scene, Both { en: t.title.en, zh: t.title.zh })
        })
        .chain(
            synthesis::templates::names()
                .map(|name| of(name, Kind::Task, synthesis::templates::title(name))),
        )
        .chain(
            particle::templates::names()
                .map(|name| of(name, Kind::Motion, particle::templates::title(name))),
        )
        .chain(
            equation::templates::names()
                .map(|name| of(name, Kind::Equation, equation::templates::title(name))),
        )
        .collect()
}

/// Returns the text of a template with other values of its parameters, each given as `NAME`,
/// `VALUE`.
///
/// # Errors
/// A template or parameter that does not exist; values that cannot be read.
pub fn text(name: &str, values: &[(&str, &str)]) -> Result<String, Faults> {
    let other = synthesis::templates::get(name)
        .or_else(|| particle::templates::get(name))
        .or_else(|| equation::templates::get(name));
    match other {
        Some(text) => edit::with_parameters(text, values),
        None => scene::templates::instantiate(name, values),
    }
}
