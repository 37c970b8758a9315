//! The unknowns of a group in closed form: positions by elimination, rates by projection; or the
//! matrix of its equations.

use super::formula::{Formula, UnaryFunction};
use super::vectors::{AngleDifference, LoopVariable, LoopVector, VectorAngle, VectorSize};
use super::{Equation, LoopSystem, PositionForm, factored};
use hodograph_base::geom::Vec2;
use hodograph_base::kind::Kind;
use libm::{cos, sin};
use nalgebra::DVector;
use std::f64::consts::PI;

/// The equations of a group.
pub struct GroupEquations<'a> {
    pub variables: &'a mut Vec<LoopVariable>,
    pub loops: &'a [Vec<LoopVector>],
    pub unknowns: Vec<usize>,
}

/// A term of a rate: the variable, and the direction of its coefficient.
#[derive(Clone, Copy)]
struct RateTerm<'a> {
    vector: &'a LoopVector,
    /// True for the change of the angle, false for that of the length.
    turning: bool,
}

/// The largest difference of a closed form from the pose, in radians or of the longest vector.
const SOUND: f64 = 1e-10;

impl<'a> GroupEquations<'a> {
    /// The longest vector (m).
    fn size(&self) -> f64 {
        let lengths = self.loops.iter().flatten().map(|v| length_of(self.variables, v).abs());
        lengths.fold(0.0, f64::max)
    }

    fn length(&self, v: &LoopVector) -> Formula {
        match &v.size {
            VectorSize::Fixed(text, value) => Formula::symbol(text.clone(), *value),
            VectorSize::Variable(k) => self.variables[*k].symbol(0),
        }
    }

    fn angle(&self, a: &VectorAngle, less: Option<&VectorAngle>) -> AngleDifference {
        AngleDifference::new(self.variables, a, less)
    }

    /// Returns true if an angle is known.
    fn fixed(&self, angle: &VectorAngle) -> bool {
        angle.variable.is_none_or(|k| !self.unknowns.contains(&k))
    }

    fn unknown(&self, v: &LoopVector) -> bool {
        let of = |k: usize| self.unknowns.contains(&k);
        !self.fixed(&v.angle) || matches!(v.size, VectorSize::Variable(k) if of(k))
    }

    /// Returns the real and imaginary part of the sum of vectors, each with its sign.
    fn parts<'v>(&self, vectors: impl Iterator<Item = (bool, &'v LoopVector)>) -> [Formula; 2] {
        let (mut re, mut im) = (Vec::new(), Vec::new());
        for (minus, v) in vectors {
            let [c, s] = self.angle(&v.angle, None).cos_sin();
            re.push((minus, Formula::product([self.length(v), c])));
            im.push((minus, Formula::product([self.length(v), s])));
        }
        [Formula::sum(re), Formula::sum(im)]
    }

    /// Returns the real and imaginary parts of a loop, each side for itself.
    pub fn closure(&self, of: &[LoopVector]) -> [Equation; 2] {
        let side =
            |left: bool| self.parts(of.iter().filter(|v| v.left == left).map(|v| (!v.forward, v)));
        let ([lr, li], [rr, ri]) = (side(true), side(false));
        [Equation::new(lr, rr, Kind::Length), Equation::new(li, ri, Kind::Length)]
    }

    /// Finds the positions of the unknowns in closed form and stores their values; `None` for a
    /// group without one, and where the results are not those of the pose.
    pub fn sound_positions(&mut self) -> Option<(PositionForm, Vec<Equation>)> {
        let pose: Vec<f64> = self.unknowns.iter().map(|k| self.variables[*k].value).collect();
        let size = self.size();
        let found = self.positions();
        let sound = self.unknowns.iter().zip(&pose).all(|(k, of_pose)| {
            let v = &self.variables[*k];
            let unit = if v.angular { 1.0 } else { size };
            (v.value - of_pose).abs() <= SOUND * unit
        });
        if found.is_some() && sound {
            return found;
        }
        self.unknowns.iter().zip(pose).for_each(|(k, value)| self.variables[*k].value = value);
        None
    }

    fn positions(&mut self) -> Option<(PositionForm, Vec<Equation>)> {
        let [of] = self.loops else { return None };
        let [a, b] = self.unknowns[..] else { return None };
        let mut steps = Vec::new();
        let known = self.parts(of.iter().filter(|v| !self.unknown(v)).map(|v| (v.negative(), v)));
        let [x, y] = ["D_x", "D_y"].map(str::to_owned);
        let [dx, dy] = [(x, &known[0]), (y, &known[1])].map(|(name, f)| match f {
            zero @ Formula::Number(_, 0.0) => zero.clone(),
            f => {
                let named = Formula::symbol(name, f.value());
                steps.push(Equation::new(named.clone(), f.clone(), Kind::Length));
                named
            }
        });
        let angular = |k: usize| self.variables[k].angular;
        let of_variable = |k: usize| -> Vec<&LoopVector> {
            let here = |v: &&LoopVector| match angular(k) {
                true => v.angle.variable == Some(k),
                false => v.size == VectorSize::Variable(k),
            };
            of.iter().filter(here).collect()
        };
        let (with_a, with_b) = (of_variable(a), of_variable(b));
        match (angular(a), angular(b), &with_a[..], &with_b[..]) {
            (true, true, [one], [two]) => {
                // The link that the known ones carry on the right is found first.
                let (first, second, bars) =
                    if one.left || !two.left { (b, a, [*two, *one]) } else { (a, b, [*one, *two]) };
                self.two_bars((first, second), bars, [dx, dy], &mut steps);
                Some((PositionForm::TwoAngles, steps))
            }
            (false, false, [one], [two]) => {
                let (of_a, of_b) = (one.angle.clone(), two.angle.clone());
                if !self.fixed(&of_a) || !self.fixed(&of_b) {
                    return None;
                }
                for (k, own, other, minus) in
                    [(a, &of_a, &of_b, one.negative()), (b, &of_b, &of_a, two.negative())]
                {
                    let [c, s] = self.angle(other, None).cos_sin();
                    let [_, across] = self.angle(other, Some(own)).cos_sin();
                    let over = Formula::sum([
                        (false, Formula::product([dx.clone(), s])),
                        (true, Formula::product([dy.clone(), c])),
                    ]);
                    let quotient = over.over(across);
                    self.found(k, if minus { quotient } else { quotient.negative() }, &mut steps);
                }
                Some((PositionForm::TwoLengths, steps))
            }
            _ => {
                let (turn, slide) = if angular(a) { (a, b) } else { (b, a) };
                if angular(slide) {
                    return None;
                }
                let (bars, slides) = (of_variable(turn), of_variable(slide));
                let [along] = slides[..] else { return None };
                let own = along.angle.variable == Some(turn);
                match bars[..] {
                    [bar] if self.fixed(&along.angle) => {
                        self.bar_and_slide((turn, slide), [bar, along], [dx, dy], &mut steps);
                        Some((PositionForm::AngleAndLength, steps))
                    }
                    _ if own && along.angle.plus == 0.0 => {
                        let offsets: Vec<&LoopVector> =
                            bars.iter().filter(|v| v.size != along.size).copied().collect();
                        let square = |v: &&LoopVector| {
                            matches!(
                                self.angle(&v.angle, Some(&along.angle)).cos_sin()[0],
                                Formula::Number(_, 0.0)
                            )
                        };
                        if offsets.len() > 1 || !offsets.iter().all(square) {
                            return None;
                        }
                        self.slotted(
                            (turn, slide),
                            along,
                            offsets.first().copied(),
                            [dx, dy],
                            &mut steps,
                        );
                        Some((PositionForm::SlottedLever, steps))
                    }
                    _ => None,
                }
            }
        }
    }

    /// Adds the result for an unknown and stores its value.
    fn found(&mut self, k: usize, formula: Formula, steps: &mut Vec<Equation>) {
        let v = &mut self.variables[k];
        let value = formula.value();
        v.value = if v.angular { nearest_turn(value, v.value) } else { value };
        steps.push(Equation::new(v.symbol(0), formula, v.kind(0)));
    }

    /// Adds an intermediate quantity and returns its symbol.
    fn named(name: &str, formula: Formula, steps: &mut Vec<Equation>) -> Formula {
        if let Formula::Number(..) = formula {
            return formula;
        }
        let symbol = Formula::symbol(name, formula.value());
        steps.push(Equation::new(symbol.clone(), formula, None));
        symbol
    }

    /// A dyad of two bars: A cos φ + B sin φ + C = 0 for the first, by tan(φ/2); the second from its
    /// components.
    fn two_bars(
        &mut self,
        (first, second): (usize, usize),
        [bar, other]: [&LoopVector; 2],
        [dx, dy]: [Formula; 2],
        steps: &mut Vec<Equation>,
    ) {
        let (lb, la) = (self.length(bar), self.length(other));
        let twice = |d: &Formula| {
            let product = Formula::product([Formula::whole(2), lb.clone(), d.clone()]);
            if bar.negative() { product.negative() } else { product }
        };
        let a = Self::named("A", twice(&dx), steps);
        let b = Self::named("B", twice(&dy), steps);
        let c = Formula::sum([
            (false, dx.clone().squared()),
            (false, dy.clone().squared()),
            (false, lb.clone().squared()),
            (true, la.clone().squared()),
        ]);
        let c = Self::named("C", c, steps);
        let theta = self.angle(&bar.angle, None).formula();
        let [ct, st] = self.angle(&bar.angle, None).cos_sin();
        let equation = Formula::sum([
            (false, Formula::product([a.clone(), ct])),
            (false, Formula::product([b.clone(), st])),
            (false, c.clone()),
        ]);
        steps.push(Equation::new(equation, Formula::whole(0), None));
        let root = Formula::sum([
            (false, a.clone().squared()),
            (false, b.clone().squared()),
            (true, c.clone().squared()),
        ])
        .root();
        let solution = |minus: bool| {
            let over = Formula::sum([(false, b.clone()), (minus, root.clone())]);
            let under = Formula::sum([(false, a.clone()), (true, c.clone())]);
            Formula::product([Formula::whole(2), over.over(under).call(UnaryFunction::Arctan)])
        };
        let pick = nearer([solution(false), solution(true)], theta.value());
        self.found(first, less(pick, bar.angle.plus), steps);
        let [ct, st] = self.angle(&bar.angle, None).cos_sin();
        let component = |d: &Formula, part: Formula| {
            let sum = Formula::sum([
                (false, d.clone()),
                (bar.negative(), Formula::product([lb.clone(), part])),
            ]);
            if other.negative() { sum } else { sum.negative() }
        };
        let direction =
            Formula::Direction { x: Box::new(component(&dx, ct)), y: Box::new(component(&dy, st)) };
        self.found(second, less(direction, other.angle.plus), steps);
    }

    /// A bar whose end slides along a known direction ψ: the component across ψ has the angle alone.
    fn bar_and_slide(
        &mut self,
        (turn, slide): (usize, usize),
        [bar, along]: [&LoopVector; 2],
        [dx, dy]: [Formula; 2],
        steps: &mut Vec<Equation>,
    ) {
        let l = self.length(bar);
        let [c, s] = self.angle(&along.angle, None).cos_sin();
        let psi = self.angle(&along.angle, None).formula();
        let across = Formula::sum([
            (false, Formula::product([dx.clone(), s.clone()])),
            (true, Formula::product([dy.clone(), c.clone()])),
        ]);
        let (minus, sine) = across.over(l.clone()).unsigned();
        let arc = sine.call(UnaryFunction::Arcsin);
        let arc = if minus != bar.negative() { arc.negative() } else { arc };
        let theta = self.angle(&bar.angle, None).formula().value();
        let near = Formula::sum([(false, psi.clone()), (false, arc.clone())]);
        let far = Formula::sum([
            (false, psi),
            (false, Formula::Number("180°".to_owned(), PI)),
            (true, arc),
        ]);
        let pick = nearer([near, far], theta);
        self.found(turn, less(pick, bar.angle.plus), steps);
        let [between, _] = self.angle(&bar.angle, Some(&along.angle)).cos_sin();
        let sum = Formula::sum([
            (false, Formula::product([dx, c])),
            (false, Formula::product([dy, s])),
            (bar.negative(), Formula::product([l, between])),
        ]);
        self.found(slide, if along.negative() { sum } else { sum.negative() }, steps);
    }

    /// A slide along a link of unknown direction, with an offset across it: its length by
    /// Pythagoras, its angle from the components.
    fn slotted(
        &mut self,
        (turn, slide): (usize, usize),
        along: &LoopVector,
        offset: Option<&LoopVector>,
        [dx, dy]: [Formula; 2],
        steps: &mut Vec<Equation>,
    ) {
        let square = Formula::sum([
            (false, dx.clone().squared()),
            (false, dy.clone().squared()),
            (true, offset.map_or_else(|| Formula::whole(0), |v| self.length(v).squared())),
        ]);
        let negative = self.variables[slide].value < 0.0;
        let root = square.root();
        self.found(slide, if negative { root.negative() } else { root }, steps);
        let turned = |f: Formula| if along.negative() != negative { f } else { f.negative() };
        let direction = Formula::Direction { x: Box::new(turned(dx)), y: Box::new(turned(dy)) };
        let formula = match offset {
            None => direction,
            Some(v) => {
                // The offset turns the slide from the known vector by arctan(e/s).
                let [_, side] = self.angle(&v.angle, Some(&along.angle)).cos_sin();
                let e = Formula::product([self.length(v), side]);
                let e = if v.negative() != along.negative() { e.negative() } else { e };
                let s = self.variables[slide].symbol(0);
                let arc = e.over(s).call(UnaryFunction::Arctan);
                Formula::sum([(false, direction), (true, arc)])
            }
        };
        self.found(turn, formula, steps);
    }

    /// Returns the vectors whose length or angle is a variable.
    fn terms(&self, k: usize) -> Vec<(bool, RateTerm<'a>)> {
        let turning = self.variables[k].angular;
        let has = |v: &&LoopVector| match turning {
            true => v.angle.variable == Some(k),
            false => v.size == VectorSize::Variable(k),
        };
        let of = self.loops.iter().flatten().filter(has);
        of.map(|vector| (vector.negative(), RateTerm { vector, turning })).collect()
    }

    /// Returns Im(c · conj(u)) of a coefficient and the direction of another.
    fn projected(&self, length: Option<Formula>, of: RateTerm, onto: RateTerm) -> Formula {
        let [c, s] = self.angle(&of.vector.angle, Some(&onto.vector.angle)).cos_sin();
        let part = match (of.turning, onto.turning) {
            (true, true) | (false, false) => s,
            (true, false) => c,
            (false, true) => c.negative(),
        };
        match length {
            Some(l) => Formula::product([l, part]),
            None => part,
        }
    }

    fn coefficient(&self, terms: &[(bool, RateTerm)], onto: RateTerm) -> Formula {
        Formula::sum(terms.iter().map(|(minus, t)| {
            let length = t.turning.then(|| self.length(t.vector));
            (*minus, self.projected(length, *t, onto))
        }))
    }

    /// Returns the terms of the second derivatives that contain no second derivative: the normal
    /// parts, and the Coriolis parts of slides on turning links; with their directions.
    fn squares(&self) -> Vec<(bool, Formula, RateTerm<'a>)> {
        let mut out = Vec::new();
        for vector in self.loops.iter().flatten() {
            let Some(turn) = vector.angle.variable else { continue };
            let omega = self.variables[turn].symbol(1);
            let normal = Formula::product([self.length(vector), omega.clone().squared()]);
            out.push((!vector.negative(), normal, RateTerm { vector, turning: false }));
            if let VectorSize::Variable(k) = vector.size {
                let speed = self.variables[k].symbol(1);
                let coriolis = Formula::product([Formula::whole(2), speed, omega]);
                out.push((vector.negative(), coriolis, RateTerm { vector, turning: true }));
            }
        }
        out
    }

    /// Finds the derivatives of the unknowns of a single loop by projection onto the direction that
    /// removes the other unknown, and stores their values; `None` for other groups and where the
    /// projection vanishes.
    pub fn by_projection(&mut self, order: usize) -> Option<Vec<Equation>> {
        let [_] = self.loops else { return None };
        let [a, b] = self.unknowns[..] else { return None };
        let mut out = Vec::new();
        for (k, other) in [(a, b), (b, a)] {
            let removed = self.terms(other);
            // Several vectors that the other unknown changes have no common direction.
            let [(_, onto)] = removed[..] else { return None };
            let mut terms = Vec::new();
            for known in 0..self.variables.len() {
                if self.unknowns.contains(&known) {
                    continue;
                }
                let own = self.terms(known);
                let rate = self.variables[known].symbol(order);
                if own.is_empty() || rate.value() == 0.0 {
                    continue;
                }
                let c = self.coefficient(&own, onto);
                terms.push((true, Formula::product([rate, c])));
            }
            if order == 2 {
                for (minus, size, direction) in self.squares() {
                    if size.value() != 0.0 {
                        terms.push((!minus, self.projected(Some(size), direction, onto)));
                    }
                }
            }
            let under = self.coefficient(&self.terms(k), onto);
            if under.value() == 0.0 {
                return None;
            }
            let formula = Formula::sum(terms).over(under);
            let v = &mut self.variables[k];
            let value = formula.value();
            if order == 1 {
                v.rate = value
            } else {
                v.second = value
            }
            out.push(Equation::new(v.symbol(order), formula, v.kind(order)));
        }
        Some(out)
    }

    /// Finds the derivatives of the unknowns by linear equations, the real and imaginary parts of
    /// each loop, and stores their values; `None` for a matrix that is singular or nearly so.
    pub fn rates(&mut self) -> Option<LoopSystem> {
        let columns: Vec<Vec<f64>> = self.unknowns.iter().map(|k| self.column(*k)).collect();
        let rows: Vec<Vec<f64>> =
            (0..columns.len()).map(|r| columns.iter().map(|c| c[r]).collect()).collect();
        let size = self.size();
        let unit = |k: &usize| if self.variables[*k].angular { size } else { 1.0 };
        let units: Vec<f64> = self.unknowns.iter().map(unit).collect();
        let system = factored(&rows, &units)?;
        let mut solved = |order: usize| {
            let right = self.right_side(order);
            let solution = system.solve(&DVector::from_vec(right.clone()))?;
            for ((k, x), unit) in self.unknowns.iter().zip(solution.iter()).zip(&units) {
                let v = &mut self.variables[*k];
                *(if order == 1 { &mut v.rate } else { &mut v.second }) = x / unit;
            }
            Some(right)
        };
        let right = [solved(1)?, solved(2)?];
        Some(LoopSystem { rows, right })
    }

    fn column(&self, k: usize) -> Vec<f64> {
        self.loops.iter().flat_map(|of| self.coefficients(of, k)).collect()
    }

    /// Returns the known part of the first or second derivative of the loops, on the right side.
    fn right_side(&self, order: usize) -> Vec<f64> {
        let mut right: Vec<f64> = match order {
            1 => vec![0.0; 2 * self.loops.len()],
            _ => self.loops.iter().flat_map(|of| self.squares_of(of).map(|x| -x)).collect(),
        };
        for known in (0..self.variables.len()).filter(|k| !self.unknowns.contains(k)) {
            let rate = self.variables[known].symbol(order).value();
            right.iter_mut().zip(self.column(known)).for_each(|(r, c)| *r -= c * rate);
        }
        right
    }

    /// Returns real and imaginary part of the coefficient of a variable's derivative in a loop.
    fn coefficients(&self, of: &[LoopVector], k: usize) -> [f64; 2] {
        let mut sum = Vec2::zero();
        for v in of {
            let sign = if v.negative() { -1.0 } else { 1.0 };
            let theta = angle_of(self.variables, v);
            let direction = Vec2::new(cos(theta), sin(theta));
            if v.angle.variable == Some(k) {
                sum += direction.perp() * (sign * length_of(self.variables, v));
            }
            if v.size == VectorSize::Variable(k) {
                sum += direction * sign;
            }
        }
        [sum.x, sum.y]
    }

    /// Returns real and imaginary part of a loop's second derivative without the second derivatives of
    /// variables.
    fn squares_of(&self, of: &[LoopVector]) -> [f64; 2] {
        let mut sum = Vec2::zero();
        for v in of {
            let Some(turn) = v.angle.variable else { continue };
            let sign = if v.negative() { -1.0 } else { 1.0 };
            let omega = self.variables[turn].rate;
            let theta = angle_of(self.variables, v);
            let direction = Vec2::new(cos(theta), sin(theta));
            let normal = -length_of(self.variables, v) * omega * omega;
            sum += direction * (sign * normal);
            if let VectorSize::Variable(k) = v.size {
                sum += direction.perp() * (sign * 2.0 * self.variables[k].rate * omega);
            }
        }
        [sum.x, sum.y]
    }
}

fn angle_of(variables: &[LoopVariable], v: &LoopVector) -> f64 {
    v.angle.variable.map_or(0.0, |k| variables[k].value) + v.angle.plus
}

fn length_of(variables: &[LoopVariable], v: &LoopVector) -> f64 {
    match v.size {
        VectorSize::Fixed(_, value) => value,
        VectorSize::Variable(k) => variables[k].value,
    }
}

/// Returns a formula less a constant angle.
fn less(f: Formula, plus: f64) -> Formula {
    if plus == 0.0 {
        return f;
    }
    let own = AngleDifference::new(&[], &VectorAngle { variable: None, plus: plus.abs() }, None);
    Formula::sum([(false, f), (plus > 0.0, own.formula())])
}

/// Returns the formula whose angle is nearer to a direction.
fn nearer([one, other]: [Formula; 2], to: f64) -> Formula {
    let off = |f: &Formula| libm::fabs(libm::remainder(f.value() - to, 2.0 * PI));
    if off(&one) <= off(&other) { one } else { other }
}

/// Returns an angle, by whole turns nearest to another.
fn nearest_turn(angle: f64, to: f64) -> f64 {
    to + libm::remainder(angle - to, 2.0 * PI)
}
