//! What a compiled operation is: it takes registers and fills the next ones, position by position.
//!
//! An operation is written as one formula over [`Lane`]; how it is run over a chunk, four lanes wide or one, is decided by
//! [`super::run`](mod@super::run) for all of them alike.

use super::lane::Lane;

/// A register: one number for each position of a chunk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reg(pub u32);

/// The registers of a vector's two components.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pair {
    /// To the right.
    pub x: Reg,
    /// Up.
    pub y: Reg,
}

/// One operation: `IN` numbers to `OUT`.
pub trait Kernel<const IN: usize, const OUT: usize>: Copy {
    /// The registers that it reads.
    fn inputs(&self) -> [Reg; IN];

    /// The formula.
    fn eval<N: Lane>(&self, x: [N; IN]) -> [N; OUT];
}
