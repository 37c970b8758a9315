//! What a sweep returns: columns of numbers with names and units, and notes of what the rows cannot say.

use hodograph_base::diag::Diagnostic;

/// One column.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name, such as `v_E.x`.
    pub name: String,
    /// Its SI unit; empty for a pure number.
    pub unit: &'static str,
    /// A number for each row.
    pub values: Vec<f64>,
}

/// The positions of a sweep, a row each, in the order in which they were asked for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// The swept quantity first, then what was asked for.
    pub columns: Vec<Column>,
    /// Which positions are missing and why, where a branch changed, what had no compiled form.
    pub notes: Vec<Diagnostic>,
}

impl Table {
    /// How many rows there are.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |c| c.values.len())
    }

    /// A column by its name.
    pub fn column(&self, name: &str) -> Option<&Column> {
        self.columns.iter().find(|c| c.name == name)
    }
}
