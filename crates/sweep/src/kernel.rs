//! The form of a compiled operation: it reads registers and fills the next ones, position by
//! position.
//!
//! An operation is written as one formula over [`Lane`]; [`super::run`](mod@super::run) decides for
//! all of them alike how it runs over a chunk, four lanes wide or one.

use super::lane::Lane;

/// A register: one number for each position of a chunk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reg(pub u32);

/// The registers of a vector's two components.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RegPair {
    /// The component to the right.
    pub x: Reg,
    /// The upward component.
    pub y: Reg,
}

/// One operation from `IN` numbers to `OUT` numbers.
pub trait Kernel<const IN: usize, const OUT: usize>: Copy {
    /// The registers that the operation reads.
    fn inputs(&self) -> [Reg; IN];

    /// The formula.
    fn eval<N: Lane>(&self, x: [N; IN]) -> [N; OUT];
}
