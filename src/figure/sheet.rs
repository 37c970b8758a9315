//! stub
use super::item::Figure;
use crate::diag::Faults;
/// o
pub struct Options {
    /// l
    pub lang: crate::scene::Lang,
    /// n
    pub notation: crate::plan::notation::Notation,
}
/// s
pub fn sheet(_: &crate::scene::Scene, _: &crate::worked::Worked, _: &Options) -> Result<Figure, Faults> {
    Err(Faults::default())
}
