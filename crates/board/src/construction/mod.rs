//! The construction language: the acts of ruler, set squares and compasses, without coordinates.
//!
//! A [`Construction`] is the list of all acts, as plain data: no coordinates, no scales, no digits,
//! no words. [`draw()`] evaluates it for given places and numbers ([`Givens`]), scales and a
//! [`pencil`], and returns the places of all marks and lines ([`DrawnPlaces`]). Choosing scales,
//! proving digits and simulating a blunt pencil are evaluations of one construction, in poses,
//! kinds of number and pencils of their own.
//!
//! The language is independent of plans and scenes: the givens, and the meaning of a mark or a
//! vector, are identified by a [`Key`] of the construction's author.
//!
//! The velocity of B of a crank AB, ω·AB square to AB:
//! ```
//! use hodograph_base::{diagram::DiagramKind, geom::Point, kind::Kind};
//! use hodograph_board::construction::*;
//! use hodograph_board::construction::pencil::Exact;
//!
//! let mut c = Construction::default();
//! let plane = c.begin(DiagramKind::Plane);
//! let [a, b] = [0, 1].map(|joint| c.mark(plane, Name::Point(Key(joint))));
//! c.step(plane, None, [Op::Set(a), Op::Set(b)]);
//! let polygon = c.begin(DiagramKind::Velocity);
//! let (pole, image) = (c.mark(polygon, Name::Pole), c.mark(polygon, Name::Image(Key(1))));
//! c.step(polygon, None, [Op::Set(pole)]);
//! let omega = c.number(Number::Given(Key(0)));
//! let v = c.vector(Vector { terms: vec![Key(0)], from: pole, to: image });
//! let along = Direction::across(Base::Arm { from: a, to: b, known: true });
//! c.step(polygon, Some([Key(1), Key(0)]), [Op::Lay { vector: v, along, times: omega }]);
//!
//! /// A at the origin, B 40 mm to its right; ω = 10 rad/s.
//! struct Crank;
//! impl Givens<f64> for Crank {
//!     fn place(&self, key: Key) -> Option<Point> { Some(Point::new([0.0, 0.04][key.index()], 0.0)) }
//!     fn number(&self, _: Key) -> f64 { 10.0 }
//!     fn path(&self, _: Key) -> Option<Track<f64>> { None }
//!     fn reach(&self, _: Key) -> f64 { 0.0 }
//!     fn origin(&self) -> Point { Point::ORIGIN }
//!     fn extent(&self) -> f64 { 0.04 }
//! }
//! // 1 mm for 1 mm, and 0.01 (m/s)/mm.
//! let scales = [(Kind::Length, 1e-3), (Kind::Velocity, 0.01)].into_iter().collect();
//! let drawn = draw(&c, &Crank, &scales, &mut Exact).unwrap();
//! assert_eq!(drawn.marks[image.index()].map(|q| (q.x.round(), q.y.round())), Some((0.0, 40.0)));
//! ```

mod draw;
mod measure;
pub mod pencil;
pub(crate) mod scale;

pub use draw::{DrawnPlaces, Givens, Met, Scales, Stop, Track, Why, draw};

use hodograph_base::diagram::DiagramKind;
use serde::{Deserialize, Serialize};
use std::ops::Range;

macro_rules! ids {
    ($($(#[$doc:meta])* $name:ident)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
        #[serde(transparent)]
        pub struct $name(pub u32);

        impl $name {
            /// Returns the id as an index.
            pub fn index(self) -> usize {
                self.0 as usize
            }

            /// Makes an id from an index.
            ///
            /// # Panics
            /// For an index of 2³² or more.
            pub fn of(index: usize) -> $name {
                $name(u32::try_from(index).expect("a construction has fewer acts than 2³²"))
            }
        }
    )*};
}

ids! {
    /// A number by which the author of a construction identifies a place, a given number, a path, a
    /// vertex or a term.
    Key
    /// Index into [`Construction::diagrams`].
    DiagramId
    /// Index into [`Construction::marks`].
    MarkId
    /// Index into [`Construction::lines`].
    LineId
    /// Index into [`Construction::vectors`].
    VectorId
    /// Index into [`Construction::numbers`].
    NumberId
}

/// A construction: its acts in the order in which they are carried out.
///
/// Ids refer to entries of its lists, and an operand of a number comes before it. [`draw()`] panics
/// for ids that refer to nothing.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Construction {
    /// The diagrams, in the order of drawing.
    pub diagrams: Vec<DiagramKind>,
    /// The marks on them.
    pub marks: Vec<Mark>,
    /// The lines on them.
    pub lines: Vec<Line>,
    /// The vectors drawn in them.
    pub vectors: Vec<Vector>,
    /// The numbers that are given, measured and calculated.
    pub numbers: Vec<Number>,
    /// The acts.
    pub ops: Vec<Op>,
    /// The acts by steps, each of which is one sentence.
    pub steps: Vec<Step>,
}

/// A point on a diagram.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Mark {
    /// The diagram.
    pub on: DiagramId,
    /// Its meaning.
    pub name: Name,
}

/// The meaning of a mark.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Name {
    /// The pole of a polygon.
    Pole,
    /// A given place of the mechanism.
    Point(Key),
    /// The image of a point in a polygon; on the mechanism a place that is constructed.
    Image(Key),
    /// The end of a term of an equation.
    End(Key),
    /// The end of a term that is drawn once more.
    Again(Key),
    /// A vertex of a force polygon, by its number in the order of the equation. The first is the
    /// origin.
    Vertex(u32),
}

/// A straight line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Line {
    /// The diagram.
    pub on: DiagramId,
    /// A mark that it passes through.
    pub through: MarkId,
    /// Its direction.
    pub along: Direction,
    /// True for a line drawn parallel through the mark with set squares, which adds an error of its
    /// own.
    pub moved: bool,
    /// The terms whose direction it is.
    pub carries: Vec<Key>,
}

/// A vector drawn from mark to mark.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Vector {
    /// Its terms: one, or several along one line that are drawn as one.
    pub terms: Vec<Key>,
    /// Its tail.
    pub from: MarkId,
    /// Its tip.
    pub to: MarkId,
}

/// A vector, turned counter-clockwise by a number of quarter turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Direction {
    /// The vector.
    pub base: Base,
    /// Quarter turns, 0 to 3.
    pub quarters: u8,
    /// True if it is reduced to unit length.
    pub unit: bool,
}

impl Direction {
    /// The direction of a vector as it is.
    pub fn of(base: Base) -> Direction {
        Direction { base, quarters: 0, unit: false }
    }

    /// The direction of a vector turned by a quarter.
    pub fn across(base: Base) -> Direction {
        Direction { quarters: 1, ..Direction::of(base) }
    }

    /// The unit vector.
    pub fn unit(self) -> Direction {
        Direction { unit: true, ..self }
    }
}

/// A vector from which a direction is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Base {
    /// From one mark to another (mm of their diagram).
    Marks(MarkId, MarkId),
    /// From one mark of the mechanism to another, in metres.
    Arm {
        /// From here.
        from: MarkId,
        /// To here.
        to: MarkId,
        /// True if its length is the given distance of the two joints; otherwise it is measured on
        /// the drawing.
        known: bool,
    },
    /// A part of the distance of two marks of the mechanism, in metres.
    Part(MarkId, MarkId, NumberId),
    /// From one given place to another, in metres, as they are and not as they are drawn.
    Places(Key, Key),
    /// The unit tangent of a given path, at a given place where it is curved.
    Tangent(Key, Option<Key>),
    /// The normal of a given path at a mark.
    Normal(Key, MarkId),
    /// The unit vector from a given place on an arc, the second, towards its centre.
    Inward(Key, Key),
    /// A measured vector, in SI.
    Measured(NumberId),
    /// A given vector, in SI.
    Given(Key),
}

/// A number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Number {
    /// A given number.
    Given(Key),
    /// An integer constant.
    Plain(i32),
    /// The vector from one mark to another, measured: mm × μ.
    Vector(MarkId, MarkId),
    /// The component across an arm of the vector from one mark to another, measured (mm): positive
    /// where it turns the arm counter-clockwise.
    Across {
        /// From here.
        from: MarkId,
        /// To here.
        to: MarkId,
        /// The arm.
        arm: Base,
    },
    /// The component along a direction of the vector from one mark to another, measured: mm × μ.
    Along(MarkId, MarkId, Direction),
    /// The moment of a force about a mark of the mechanism, counter-clockwise positive: its arm is
    /// measured, and multiplied by its magnitude.
    Moment {
        /// The force.
        force: Base,
        /// A mark on its line of action.
        at: MarkId,
        /// The mark about which it turns.
        about: MarkId,
    },
    /// The length of a vector.
    Length(Base),
    /// The length of a vector squared.
    Square(Base),
    /// The radius of a given path (m).
    Radius(Key),
    /// μ of a diagram (SI per mm).
    Scale(DiagramId),
    /// The negative −a.
    Negative(NumberId),
    /// The sum a + b.
    Sum(NumberId, NumberId),
    /// The difference a − b.
    Difference(NumberId, NumberId),
    /// The product a b.
    Product(NumberId, NumberId),
    /// The quotient a / b.
    Quotient(NumberId, NumberId),
}

/// One act.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Op {
    /// Marks a given place of the mechanism, or a pole. A place that is not given leaves no mark.
    Set(MarkId),
    /// Draws a given path.
    Path(Key),
    /// Lays a known vector off: its direction times a number, to the diagram's scale.
    Lay {
        /// The vector.
        vector: VectorId,
        /// The vector whose multiple it is.
        along: Direction,
        /// The number.
        times: NumberId,
    },
    /// Draws a line of known direction through a mark.
    Rule(LineId),
    /// Marks the crossing of two lines. On the mechanism parallel lines leave no mark; in a polygon
    /// the construction stops.
    Meet {
        /// The lines.
        lines: [LineId; 2],
        /// The mark.
        to: MarkId,
    },
    /// Drops the perpendicular from a mark on a line, and marks its foot.
    Foot {
        /// The mark.
        from: MarkId,
        /// The line.
        on: LineId,
        /// The foot.
        to: MarkId,
    },
    /// Copies a triangle of the mechanism by similarity.
    Image {
        /// Its corners: the third is copied.
        of: [MarkId; 3],
        /// The images of the first two.
        onto: [MarkId; 2],
        /// The image of the third.
        to: MarkId,
    },
    /// Puts a mark on another.
    Same {
        /// The other.
        mark: MarkId,
        /// The mark.
        to: MarkId,
        /// The reason.
        because: Because,
    },
    /// Measures or calculates a number.
    Number(NumberId),
    /// Draws a vector between two marks.
    Show(VectorId),
    /// Records that terms along one line are 0 and are not drawn.
    Omit {
        /// The terms.
        terms: Vec<Key>,
        /// The mark.
        at: MarkId,
        /// The mark at that place, in which the last of them would end.
        to: Option<MarkId>,
    },
}

/// The reason for which a mark falls on another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Because {
    /// No further vector is added.
    Reached,
    /// The link of both points does not turn.
    Translates,
}

/// A group of acts that one sentence describes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Step {
    /// The diagram.
    pub on: DiagramId,
    /// Its acts.
    pub ops: Range<u32>,
    /// The keys of the two vertices that give its direction or its arm.
    pub ends: Option<[Key; 2]>,
}

impl Construction {
    /// The acts of a step.
    pub fn ops(&self, step: &Step) -> &[Op] {
        &self.ops[step.ops.start as usize..step.ops.end as usize]
    }

    /// The diagram of a kind, if it is drawn.
    pub fn diagram(&self, kind: DiagramKind) -> Option<DiagramId> {
        self.diagrams.iter().position(|k| *k == kind).map(DiagramId::of)
    }

    /// Returns an empty construction with capacity for the given number of points.
    pub(crate) fn with_room(points: usize) -> Construction {
        Construction {
            diagrams: Vec::with_capacity(3),
            marks: Vec::with_capacity(6 * points),
            lines: Vec::with_capacity(4 * points),
            vectors: Vec::with_capacity(6 * points),
            numbers: Vec::with_capacity(12 * points),
            ops: Vec::with_capacity(20 * points),
            steps: Vec::with_capacity(12 * points),
        }
    }

    /// Begins a diagram.
    pub fn begin(&mut self, kind: DiagramKind) -> DiagramId {
        self.diagrams.push(kind);
        DiagramId::of(self.diagrams.len() - 1)
    }

    /// Names a mark; an act puts it on the diagram.
    pub fn mark(&mut self, on: DiagramId, name: Name) -> MarkId {
        self.marks.push(Mark { on, name });
        MarkId::of(self.marks.len() - 1)
    }

    /// Names a line; an act draws it.
    pub fn line(&mut self, line: Line) -> LineId {
        self.lines.push(line);
        LineId::of(self.lines.len() - 1)
    }

    /// Names a vector; an act draws it.
    pub fn vector(&mut self, vector: Vector) -> VectorId {
        self.vectors.push(vector);
        VectorId::of(self.vectors.len() - 1)
    }

    /// Names a number; one that is measured needs an act.
    pub fn number(&mut self, number: Number) -> NumberId {
        self.numbers.push(number);
        NumberId::of(self.numbers.len() - 1)
    }

    /// Appends a step.
    ///
    /// # Panics
    /// Beyond 2³² acts.
    pub fn step(
        &mut self,
        on: DiagramId,
        ends: Option<[Key; 2]>,
        ops: impl IntoIterator<Item = Op>,
    ) {
        let start = self.ops.len();
        self.ops.extend(ops);
        let count = |n: usize| u32::try_from(n).expect("a construction has fewer acts than 2³²");
        self.steps.push(Step { on, ops: count(start)..count(self.ops.len()), ends });
    }
}
