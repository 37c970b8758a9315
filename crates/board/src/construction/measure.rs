//! Numbers of a construction: what is measured and calculated.

use super::draw::{Board, Givens, Track, Value, Why};
use super::pencil::Pencil;
use super::{Number, NumberId};
use hodograph_base::diagram::DiagramKind;
use hodograph_base::geom::Vec2;
use hodograph_base::number::Real;

impl<N: Real, G: Givens<N>, P: Pencil<N>> Board<'_, N, G, P> {
    /// Measures or calculates a number.
    pub(super) fn value(&mut self, id: NumberId) -> Result<Value<N>, Why> {
        Ok(match self.construction.numbers[id.index()] {
            Number::Vector(from, to) => {
                let (kind, on) = (self.on(to), self.construction.marks[to.index()].on);
                let drawn = self.place(to)? - self.place(from)?;
                Value::Vector(self.pencil.read(kind, drawn) * self.mu(on))
            }
            Number::Across { from, to, arm } => {
                let r = self.base(&arm)?;
                let l = r.norm();
                let drawn = self.pencil.read(self.on(to), self.place(to)? - self.place(from)?);
                Value::Scalar((r * (N::from_f64(1.0) / l)).cross(drawn))
            }
            Number::Along(from, to, direction) => {
                let u = self.direction(&direction)?.unit().ok_or(Why::Coincide)?;
                let drawn = self.pencil.read(self.on(to), self.place(to)? - self.place(from)?);
                Value::Scalar(u.dot(drawn) * self.mu(self.construction.marks[to.index()].on))
            }
            Number::Moment { force, at, about } => {
                let force = self.base(&force)?;
                let reach = self.place(at)? - self.place(about)?;
                // The foot of the perpendicular from the mark on the line of action.
                let arm = match force.unit() {
                    Some(u) => self.pencil.read(DiagramKind::Plane, reach - u * u.dot(reach)),
                    None => Vec2::zero(),
                };
                Value::Scalar((arm * self.mu_l).cross(force))
            }
            Number::Given(_)
            | Number::Plain(_)
            | Number::Length(_)
            | Number::Square(_)
            | Number::Radius(_)
            | Number::Scale(_)
            | Number::Negative(_)
            | Number::Sum(..)
            | Number::Difference(..)
            | Number::Product(..)
            | Number::Quotient(..) => Value::Scalar(self.number(id)?),
        })
    }

    pub(super) fn vector(&self, id: NumberId) -> Result<Vec2<N>, Why> {
        match self.drawn.numbers[id.index()] {
            Some(Value::Vector(v)) => Ok(v),
            Some(Value::Scalar(_)) | None => Err(Why::Coincide),
        }
    }

    pub(super) fn number(&self, id: NumberId) -> Result<N, Why> {
        if let Some(value) = self.drawn.number(id) {
            return Ok(value);
        }
        let of = |id: NumberId| self.number(id);
        Ok(match self.construction.numbers[id.index()] {
            Number::Given(key) => self.givens.number(key),
            Number::Plain(x) => N::from_f64(f64::from(x)),
            Number::Vector(..)
            | Number::Across { .. }
            | Number::Along(..)
            | Number::Moment { .. } => return Err(Why::Coincide),
            Number::Length(base) => self.base(&base)?.norm(),
            Number::Square(base) => self.base(&base)?.norm2(),
            Number::Radius(path) => match self.givens.path(path) {
                Some(Track::Arc { radius, .. }) => radius,
                Some(Track::Line(_)) | None => return Err(Why::Coincide),
            },
            Number::Scale(on) => self.mu(on),
            Number::Negative(a) => -of(a)?,
            Number::Sum(a, b) => of(a)? + of(b)?,
            Number::Difference(a, b) => of(a)? - of(b)?,
            Number::Product(a, b) => of(a)? * of(b)?,
            Number::Quotient(a, b) => of(a)? / of(b)?,
        })
    }
}
