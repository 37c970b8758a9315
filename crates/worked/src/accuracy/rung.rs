//! The rungs of the precision ladder: balls over `f64`, over double-double, over longer and longer
//! numbers.

use hodograph_base::budget::spend;
use hodograph_base::number::decimal::Certain;
use hodograph_base::number::{Ball, Big, Dd, within};
use hodograph_mechanism::motion::MotionNumber;

/// A rung of the ladder.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Rung {
    /// `f64` with a bound of its error.
    Double,
    /// Double-double with a bound of its error.
    DoubleDouble,
    /// Numbers of this many bits, with a bound of their error.
    Long(usize),
}

impl Rung {
    /// All rungs, the cheapest first. The last has more digits than any request loses by the depth
    /// of a dead centre written with twenty decimals; beyond it only ties and poses that are
    /// singular as written remain.
    pub const LADDER: [Rung; 5] =
        [Rung::Double, Rung::DoubleDouble, Rung::Long(192), Rung::Long(384), Rung::Long(768)];

    /// The last rung: beyond it nothing is tried.
    pub const LAST: Rung = Rung::LADDER[Rung::LADDER.len() - 1];

    /// Does the work in this rung's numbers.
    pub fn climb<C: Climb>(self, work: &C) -> C::Found {
        spend();
        match self {
            Rung::Double => work.with::<Ball<f64>>(),
            Rung::DoubleDouble => work.with::<Ball<Dd>>(),
            Rung::Long(bits) => within(bits, || work.with::<Ball<Big>>()),
        }
    }

    /// Returns the name for programs and tables: `f64`, `double-double`, `192 bit`.
    pub fn name(self) -> String {
        match self {
            Rung::Double => "f64".into(),
            Rung::DoubleDouble => "double-double".into(),
            Rung::Long(bits) => format!("{bits} bit"),
        }
    }
}

/// Work that can be done on any rung.
pub trait Climb {
    /// The result of the work. It contains no numbers of the rung, which have no meaning outside.
    type Found;

    /// Does the work in numbers of type `N`.
    fn with<N: Certain + MotionNumber>(&self) -> Self::Found;
}
