//! The result of a sweep: columns of numbers with names and units, and notes on the rows.

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

/// The positions of a sweep, one row each, in the order of the request.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// The swept quantity first, then the answers.
    pub columns: Vec<Column>,
    /// Notes on missing positions with their reasons, changes of branch, and questions without a
    /// compiled form.
    pub notes: Vec<Diagnostic>,
}

impl Table {
    /// Returns the number of rows.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |c| c.values.len())
    }

    /// Returns a column by its name.
    pub fn column(&self, name: &str) -> Option<&Column> {
        self.columns.iter().find(|c| c.name == name)
    }
}
