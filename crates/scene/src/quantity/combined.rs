//! `omega_2 + omega_4`, `v_B - v_C`, `P13D/P13A`: the sum, the difference or the ratio of two
//! quantities. The ratio of two vectors is that of their magnitudes.

use super::*;
use hodograph_base::lang::each;

/// The operation that combines two quantities.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// The sum.
    Sum,
    /// The difference.
    Difference,
    /// The ratio.
    Ratio,
}

impl Operation {
    /// Returns its sign in the label language.
    pub fn sign(self) -> &'static str {
        match self {
            Operation::Sum => " + ",
            Operation::Difference => " − ",
            Operation::Ratio => "/",
        }
    }
}

/// The sum, the difference or the ratio of two quantities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Combined {
    /// The operation.
    pub operation: Operation,
    /// The two quantities.
    pub operands: [Operand; 2],
    entry: &'static Entry,
}

/// Writes the closed type of the possible operands.
macro_rules! operands {
    ($($Family:ident),+ $(,)?) => {
        /// An operand: any quantity except a combination.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum Operand {
            $(
                /// A quantity of this family.
                $Family($Family)
            ),+
        }

        impl Operand {
            /// Returns the operand as a question.
            pub fn asked(self) -> Asked {
                match self { $(Operand::$Family(q) => q.into()),+ }
            }

            fn of(asked: Asked) -> Option<Operand> {
                match asked {
                    $(Asked::$Family(q) => Some(Operand::$Family(q)),)+
                    Asked::Combined(_) => None,
                }
            }
        }
    };
}

operands!(
    PointMotion,
    Relative,
    Sliding,
    Composite,
    Turning,
    Place,
    Curvature,
    CamQuantity,
    FromCentre,
    InstantCentre,
    Ratio,
    RollerSpin,
    Transmission,
    Force,
);

const KINDS: [Kind; 11] = [
    Kind::Length,
    Kind::Angle,
    Kind::Velocity,
    Kind::Acceleration,
    Kind::Omega,
    Kind::Alpha,
    Kind::Time,
    Kind::Number,
    Kind::Force,
    Kind::Moment,
    Kind::Power,
];
const FORMS: [ValueForm; 2] = [ValueForm::Scalar, ValueForm::Vector];
const LEVELS: [Level; 3] = [Level::Position, Level::Velocity, Level::Acceleration];

/// One row for each kind, form and level of a combination.
static ENTRIES: [Entry; KINDS.len() * FORMS.len() * LEVELS.len()] = {
    let first =
        Entry::new("", "omega_2 + omega_4", Kind::Number, ValueForm::Scalar, each!("quantity"));
    let mut all = [first; KINDS.len() * FORMS.len() * LEVELS.len()];
    let mut k = 0;
    while k < all.len() {
        all[k].kind = KINDS[k / (FORMS.len() * LEVELS.len())];
        all[k].form = FORMS[k / LEVELS.len() % FORMS.len()];
        all[k].level = LEVELS[k % LEVELS.len()];
        k += 1;
    }
    all
};

/// Returns the ways to split a text into two operands, with the operation: one for each sign.
pub fn halves(text: &str) -> impl Iterator<Item = (Operation, [&str; 2])> {
    text.char_indices().filter_map(move |(at, c)| {
        let operation = match c {
            '+' => Operation::Sum,
            '-' | '−' => Operation::Difference,
            '/' => Operation::Ratio,
            _ => return None,
        };
        Some((operation, [text[..at].trim(), text[at + c.len_utf8()..].trim()]))
            .filter(|(_, halves)| halves.iter().all(|h| !h.is_empty()))
    })
}

/// Returns the two halves of a combination's text, each of which is a question.
pub fn halves_of<'t>(combined: &Combined, text: &'t str) -> Option<[&'t str; 2]> {
    let is = |half: &str, operand: Operand| {
        half.starts_with(operand.asked().entry().symbol) || !half.is_ascii()
    };
    let fits = |(operation, [a, b]): &(Operation, [&str; 2])| {
        let [p, q] = combined.operands;
        *operation == combined.operation && is(a, p) && is(b, q)
    };
    halves(text).find(fits).map(|(_, halves)| halves)
}

impl Combined {
    /// Returns the combination of two quantities; `None` if their kinds or forms do not fit.
    pub(crate) fn new(operation: Operation, [a, b]: [Asked; 2]) -> Option<Combined> {
        let (x, y) = (a.entry(), b.entry());
        let (kind, form) = match operation {
            Operation::Sum | Operation::Difference
                if x.kind == y.kind && x.form == y.form && x.form != ValueForm::Point =>
            {
                (x.kind, x.form)
            }
            Operation::Sum | Operation::Difference => return None,
            Operation::Ratio if x.form == ValueForm::Point || y.form == ValueForm::Point => {
                return None;
            }
            Operation::Ratio => (quotient(x.kind, y.kind)?, ValueForm::Scalar),
        };
        let level = x.level.max(y.level);
        let entry =
            ENTRIES.iter().find(|e| e.kind == kind && e.form == form && e.level == level)?;
        Some(Combined { operation, operands: [Operand::of(a)?, Operand::of(b)?], entry })
    }
}

/// Returns the kind of a quotient; `None` if the quotient has no unit here.
fn quotient(a: Kind, b: Kind) -> Option<Kind> {
    Some(match (a, b) {
        (a, b) if a == b => Kind::Number,
        (a, Kind::Number) => a,
        (Kind::Velocity, Kind::Omega) | (Kind::Acceleration, Kind::Alpha) => Kind::Length,
        (Kind::Velocity, Kind::Length) => Kind::Omega,
        (Kind::Acceleration, Kind::Length) => Kind::Alpha,
        (Kind::Length, Kind::Velocity) => Kind::Time,
        _ => return None,
    })
}

impl Quantity for Combined {
    /// The texts of the operands determine a combination.
    const WRITTEN: &'static [Entry] = &[];

    fn read(_question: &Question<'_>) -> Result<Option<Combined>, Diagnostic> {
        Ok(None)
    }

    fn entry(&self) -> &'static Entry {
        self.entry
    }

    fn of(&self) -> Of {
        self.operands[0].asked().of()
    }

    fn meaning(&self, _scene: &Scene) -> Option<Meaning> {
        None
    }

    fn needs(&self) -> Vec<(Need, Level)> {
        self.operands.iter().flat_map(|q| q.asked().needs()).collect()
    }

    fn fault(&self, scene: &Scene, find: &Find) -> Option<Diagnostic> {
        self.operands.iter().find_map(|q| q.asked().fault(scene, find))
    }

    fn no_value(&self, scene: &Scene) -> Both {
        match self.operation {
            Operation::Ratio => both!("one of the two has no value, or the divisor is zero"),
            Operation::Sum | Operation::Difference => self.operands[0].asked().no_value(scene),
        }
    }

    fn value<N: Real, K: FormulaInputs<N>>(&self, known: &K) -> Option<AnswerValue<N>> {
        let [a, b] = self.operands.map(|q| q.asked().value(known));
        combine(self.operation, a?, b?)
    }
}

/// Combines two values; returns `None` if the forms differ, or if a ratio is undecided or not
/// finite.
pub fn combine<N: Real>(
    operation: Operation,
    a: AnswerValue<N>,
    b: AnswerValue<N>,
) -> Option<AnswerValue<N>> {
    let size = |v: AnswerValue<N>| match v {
        AnswerValue::Scalar(s) => Some(s),
        AnswerValue::Vector(v) => Some(v.norm()),
        AnswerValue::Point(_) => None,
    };
    Some(match (operation, a, b) {
        (Operation::Sum, AnswerValue::Scalar(a), AnswerValue::Scalar(b)) => {
            AnswerValue::Scalar(a + b)
        }
        (Operation::Sum, AnswerValue::Vector(a), AnswerValue::Vector(b)) => {
            AnswerValue::Vector(a + b)
        }
        (Operation::Difference, AnswerValue::Scalar(a), AnswerValue::Scalar(b)) => {
            AnswerValue::Scalar(a - b)
        }
        (Operation::Difference, AnswerValue::Vector(a), AnswerValue::Vector(b)) => {
            AnswerValue::Vector(a - b)
        }
        (Operation::Ratio, a, b) => {
            let ratio = size(a)? / size(b)?;
            return ratio
                .is_decided()
                .then_some(ratio)
                .filter(|r| r.approx().is_finite())
                .map(AnswerValue::Scalar);
        }
        (Operation::Sum | Operation::Difference, ..) => return None,
    })
}
