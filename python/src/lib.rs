//! The native module of the Python package: the calls of [`hodograph::problem`].
//!
//! [`Problem`] is a file that has been read, [`Solved`] its solution, [`Picture`] a figure,
//! [`Sheet`] a worksheet, [`Table`] the columns of a sweep, [`Parts`] a batch in a folder, [`Moving`] a
//! figure that is dragged, [`Cycle`] a motion cycle, [`Comparison`] several designs, [`Variants`]
//! homework.
//! Structured results are exchanged as JSON, columns by the address of their numbers, faults as
//! exceptions of the package. Each call that may take long goes through [`work::run`].

#![warn(missing_docs)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod designs;
mod fault;
mod homework;
mod look;
mod moving;
mod parts;
mod picture;
mod reports;
mod solved;
mod table;
mod work;

// Compiled again when its Chinese texts change.
const _: &str = include_str!("../po/zh.po");

use pyo3::prelude::*;

pub use designs::{Comparison, Cycle};
pub use homework::Variants;
pub use moving::Moving;
pub use parts::Parts;
pub use picture::{Picture, Sheet};
pub use solved::{Problem, Solved};
pub use table::{Column, Table};

/// The functions and classes of the module.
#[pymodule]
mod _native {
    #[pymodule_export]
    use super::designs::{Comparison, Cycle, cam, cam_figures, cam_profile, teeth};
    #[pymodule_export]
    use super::homework::{Variants, mark, roster};
    #[pymodule_export]
    use super::moving::Moving;
    #[pymodule_export]
    use super::parts::Parts;
    #[pymodule_export]
    use super::picture::{Picture, Sheet, pdf_of};
    #[pymodule_export]
    use super::reports::{length_ranges, limits, vector_loops};
    #[pymodule_export]
    use super::solved::{
        Problem, Solved, export_formats, figures, import_linkage, included, kind_of, schema,
        template, templates, with_values,
    };
    #[pymodule_export]
    use super::table::{Column, Table};
    #[pymodule_export]
    use super::work::limit;
}
