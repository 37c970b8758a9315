//! The file a person writes: raw mirror, validation, units, expressions, embedded templates.

pub mod model;

pub use model::*;
