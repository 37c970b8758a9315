//! Other values of a scene's parameters, without reading its file again: for sweeps over a
//! parameter and for batches.
//!
//! The quantities that depend on the varied parameters are found once, with their expressions;
//! setting values only evaluates these. Values that the reader refuses (a length that is not
//! positive) are refused here too.

use super::chunks::{SweepRows, run_program};
use super::follow::course::over_a_turn;
use super::general::General;
use super::pieces::{Gaps, StopSignal, SweepPieces, never};
use super::station::{Stations, position_now};
use super::{PlacedScene, Width, without_program};
use hodograph_base::budget::here;
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::digits::shortest;
use hodograph_mechanism::mechanism::Mechanism;
use hodograph_scene::eval::{DimensionedValue, NoValue, evaluate};
use hodograph_scene::expr::{self, Expr, ExprKind};
use hodograph_scene::units::{Dim, RequiredQuantity};
use hodograph_scene::{
    Angle, GivenQuantity, GuideDirection, GuidePath, Kind, PointPlace, PositionSlot, Scene,
    Through, templates,
};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::ops::Range;

/// A quantity of a scene.
enum SceneQuantity<'a> {
    /// A number in SI units; `true` if it must be greater than zero.
    Number(&'a mut GivenQuantity, bool),
    Angle(&'a mut GivenQuantity<Angle>),
}

/// Every quantity of a scene, always in the same order.
fn slots(scene: &mut Scene) -> Vec<SceneQuantity<'_>> {
    let parts = scene.points.len() + scene.guides.len() + scene.rolling.len() + scene.drivers.len();
    let mut out = Vec::with_capacity(4 * parts + scene.lengths.len());
    for p in &mut scene.points {
        match &mut p.place {
            PointPlace::Unknown => {}
            PointPlace::At(xy) | PointPlace::InLink { xy, .. } => {
                out.extend(xy.iter_mut().map(|x| SceneQuantity::Number(x, false)))
            }
            PointPlace::Polar { length, angle, .. } => {
                out.extend([SceneQuantity::Number(length, true), SceneQuantity::Angle(angle)])
            }
        }
    }
    for g in &mut scene.guides {
        match &mut g.path {
            GuidePath::Line { through, direction, offset } => {
                if let Through::At(xy) = through {
                    out.extend(xy.iter_mut().map(|x| SceneQuantity::Number(x, false)));
                }
                match direction {
                    GuideDirection::Instant(angle)
                    | GuideDirection::Slid(angle)
                    | GuideDirection::Along(_, _, Some(angle)) => {
                        out.push(SceneQuantity::Angle(angle))
                    }
                    GuideDirection::Along(_, _, None) | GuideDirection::Own => {}
                }
                out.extend(offset.iter_mut().map(|x| SceneQuantity::Number(x, false)));
            }
            GuidePath::Arc { radius, .. } => {
                out.extend(radius.iter_mut().map(|x| SceneQuantity::Number(x, true)))
            }
        }
    }
    out.extend(scene.lengths.iter_mut().map(|l| SceneQuantity::Number(&mut l.value, true)));
    for r in &mut scene.rolling {
        out.extend(r.contours.radii_mut().into_iter().map(|x| SceneQuantity::Number(x, true)));
        out.extend(r.phase.iter_mut().map(SceneQuantity::Angle));
    }
    for d in &mut scene.drivers {
        match d.kind.slot() {
            PositionSlot::Angle(angle) => out.extend(angle.iter_mut().map(SceneQuantity::Angle)),
            PositionSlot::Coordinate(position) => {
                out.extend(position.iter_mut().map(|x| SceneQuantity::Number(x, false)))
            }
            PositionSlot::Distance(length) => {
                out.extend(length.iter_mut().map(|x| SceneQuantity::Number(x, true)))
            }
        }
        out.push(SceneQuantity::Number(&mut d.rate, false));
        out.extend(d.acceleration.iter_mut().map(|x| SceneQuantity::Number(x, false)));
    }
    out
}

/// The varied parameters, and the quantities that depend on them.
#[derive(Clone, Debug)]
pub struct Variation {
    /// All parameters in order, with their expressions.
    parameters: Vec<(String, Expr)>,
    /// The varied parameters, as indices into `parameters`.
    varied: Vec<usize>,
    /// The value of each parameter that does not depend on the varied ones.
    fixed: Vec<Option<DimensionedValue>>,
    /// The dependent quantities, as indices into [`slots`], with their expressions.
    dependent: Vec<(usize, Expr)>,
    /// The scene to read again for other values, if it has cams or loads: the geometry of cams is
    /// made where it is read, and strokes of loads follow from the whole scene.
    again: Option<RereadScene>,
}

/// The scene to read again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum RereadScene {
    /// The scene of the instant.
    Instant,
    /// The scene of the whole motion, with followers as drivers.
    Motion,
}

impl Variation {
    /// The variation of some parameters of a scene.
    ///
    /// # Errors
    /// A name that is no parameter, or is named twice.
    pub fn new(scene: &Scene, names: &[&str]) -> Result<Variation, Faults> {
        let moves = scene.own_drivers() < scene.drivers.len();
        let again = scene
            .source
            .as_ref()
            .filter(|_| !scene.cams.is_empty() || !scene.loads.is_empty())
            .map(|_| if moves { RereadScene::Motion } else { RereadScene::Instant });
        Ok(Variation { again, ..Variation::of(scene, names)? })
    }

    /// Makes a variation as [`Variation::new`] does, but leaves the cams as they are in the scene.
    pub(super) fn of(scene: &Scene, names: &[&str]) -> Result<Variation, Faults> {
        let mut faults = Faults::default();
        let known: Vec<&str> = scene.parameters.iter().map(|p| p.0.as_str()).collect();
        let mut varied = Vec::new();
        for name in names {
            match known.iter().position(|k| k == name) {
                Some(i) if !varied.contains(&i) => varied.push(i),
                Some(_) => faults.push(Diagnostic::error(
                    "given-twice",
                    both!("parameter `{name}` is varied twice"),
                )),
                None => {
                    let d = Diagnostic::error(
                        "unknown-parameter",
                        both!("the scene has no parameter `{name}`"),
                    );
                    faults.push(d.help(match known[..] {
                        [] => both!("give the lengths to be varied names in \"parameters\""),
                        _ => both!("its parameters are {}", Both::names(&known)),
                    }));
                }
            }
        }
        if faults.has_errors() {
            return Err(faults);
        }
        let mut parameters = Vec::new();
        for (name, given) in &scene.parameters {
            parameters.push((name.clone(), expr::parse(&given.text, &known)?));
        }
        // The names of parameters that change with the varied ones, directly or through others.
        let mut moving: Vec<&str> = varied.iter().map(|&i| known[i]).collect();
        for (i, (name, expr)) in parameters.iter().enumerate() {
            if !varied.contains(&i) && mentions(expr, &moving) {
                moving.push(name);
            }
        }
        let mut dependent = Vec::new();
        for (i, slot) in slots(&mut scene.clone()).into_iter().enumerate() {
            let text = match &slot {
                SceneQuantity::Number(given, _) => &given.text,
                SceneQuantity::Angle(given) => &given.text,
            };
            let expr = expr::parse(text, &known)?;
            if mentions(&expr, &moving) {
                dependent.push((i, expr));
            }
        }
        let moves: Vec<bool> = known.iter().map(|name| moving.contains(name)).collect();
        let mut variation =
            Variation { parameters, varied, fixed: Vec::new(), dependent, again: None };
        let usual = variation.values(&[])?;
        variation.fixed =
            usual.into_iter().zip(moves).map(|(value, moves)| (!moves).then_some(value)).collect();
        Ok(variation)
    }

    /// The names of the varied parameters, in the order in which their values are set.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.varied.iter().map(|&i| self.parameters[i].0.as_str())
    }

    /// The unit of a varied parameter's SI value, for a column's head.
    pub fn unit(&self, value: &DimensionedValue) -> &'static str {
        // An arc over time is a velocity.
        let dim = if value.dim.length == 1 && value.dim.time < 0 {
            Dim { angle: 0, ..value.dim }
        } else {
            value.dim
        };
        Kind::ALL
            .into_iter()
            .find(|kind| RequiredQuantity::of(*kind).dim() == dim)
            .map_or("", Kind::si)
    }

    /// Reads a value of a parameter from a command line: a bare number takes the unit that the
    /// scene writes.
    ///
    /// # Errors
    /// A text that is no quantity of the parameter's kind.
    pub fn value(&self, scene: &Scene, name: &str, text: &str) -> Result<DimensionedValue, Faults> {
        let known: Vec<&str> = self.parameters.iter().map(|p| p.0.as_str()).collect();
        let i = known
            .iter()
            .position(|k| *k == name)
            .ok_or_else(|| Diagnostic::error("unknown-parameter", both!("`{name}`")))?;
        let written = templates::replacement(name, &scene.parameters[i].1.text, text, &[])?;
        let value = self.evaluate(&expr::parse(&written, &[])?, &[])?;
        let usual = self.evaluate(&self.parameters[i].1, &self.values(&[])?)?;
        if value.dim != usual.dim {
            return Err(Diagnostic::error(
                "dimension",
                both!("`{text}` is {}; `{name}` is {}", value.dim.describe(), usual.dim.describe()),
            )
            .into());
        }
        Ok(value)
    }

    /// Returns `steps` equal steps between two values, both ends included.
    ///
    /// # Errors
    /// The errors of [`Variation::value`].
    pub fn span(
        &self,
        scene: &Scene,
        name: &str,
        from: &str,
        to: &str,
        steps: usize,
    ) -> Result<ParameterSpan, Faults> {
        let (a, b) = (self.value(scene, name, from)?, self.value(scene, name, to)?);
        // Degrees stay degrees only if both ends are degrees.
        let degrees = a.degrees && b.degrees;
        let number = |v: DimensionedValue| if degrees { v.number } else { v.si() };
        Ok(ParameterSpan {
            first: DimensionedValue { number: number(a), dim: a.dim, degrees },
            last: number(b),
            steps,
        })
    }

    /// Returns all values of [`Variation::span`].
    ///
    /// # Errors
    /// The errors of [`Variation::value`].
    pub fn range(
        &self,
        scene: &Scene,
        name: &str,
        from: &str,
        to: &str,
        steps: usize,
    ) -> Result<Vec<DimensionedValue>, Faults> {
        let span = self.span(scene, name, from, to, steps)?;
        Ok((0..=steps).map(|i| span.value(i)).collect())
    }

    fn evaluate(
        &self,
        expr: &Expr,
        values: &[DimensionedValue],
    ) -> Result<DimensionedValue, Faults> {
        let lookup = |name: &str| {
            self.parameters[..values.len()].iter().rposition(|p| p.0 == name).map(|i| values[i])
        };
        evaluate(expr, &lookup).map_err(|e| match e {
            NoValue::Fault(d) => Diagnostic { span: None, ..d }.into(),
            NoValue::Reported => {
                Diagnostic::error("unknown-parameter", both!("a parameter has no value")).into()
            }
        })
    }

    /// The values of all parameters, with the given values of the varied ones (or as written
    /// without any).
    fn values(&self, varied: &[DimensionedValue]) -> Result<Vec<DimensionedValue>, Faults> {
        let mut values = Vec::with_capacity(self.parameters.len());
        for (i, (_, expr)) in self.parameters.iter().enumerate() {
            let given =
                || self.varied.iter().position(|v| *v == i).and_then(|k| varied.get(k)).copied();
            let value = match self.fixed.get(i).copied().flatten().or_else(given) {
                Some(value) => value,
                None => self.evaluate(expr, &values)?,
            };
            values.push(value);
        }
        Ok(values)
    }

    /// The topology of a scene after its parameters were set, if it differs from the one before:
    /// the driver that replaces the contact of a cam may change.
    pub(super) fn topology(&self, scene: &Scene) -> Result<Option<Mechanism>, Faults> {
        self.again.map(|_| super::mechanism(scene)).transpose()
    }

    /// Gives the varied parameters their values, one each, in a scene for which this variation was
    /// made.
    ///
    /// # Errors
    /// A length that becomes zero or negative; a value that is no number.
    pub fn set(&self, scene: &mut Scene, varied: &[DimensionedValue]) -> Result<(), Faults> {
        let values = self.values(varied)?;
        if let Some(again) = self.again {
            let written = |value: &DimensionedValue| match value.degrees {
                true => format!("({:?}) deg", value.number),
                false => format!("({:?}) {}", value.si(), self.unit(value)).replace('²', "^2"),
            };
            let texts: Vec<(&str, String)> = self.names().zip(varied.iter().map(written)).collect();
            let read = scene.read_with(&texts)?;
            *scene = if again == RereadScene::Motion { over_a_turn(&read) } else { read };
            return Ok(());
        }
        let mut slots = slots(scene);
        for (i, expr) in &self.dependent {
            let value = self.evaluate(expr, &values)?;
            match &mut slots[*i] {
                SceneQuantity::Number(given, positive) => {
                    let si = value.si();
                    if *positive && si <= 0.0 {
                        return Err(Diagnostic::error(
                            "not-positive",
                            both!("`{}` becomes {}", given.text, shortest(si)),
                        )
                        .at(given.span)
                        .into());
                    }
                    (given.value, given.radius) = (si, si.abs() * f64::EPSILON);
                }
                SceneQuantity::Angle(given) => {
                    (given.value, given.radius) =
                        (value.angle(), value.number.abs() * f64::EPSILON);
                }
            }
        }
        Ok(())
    }
}

/// True if an expression uses one of the names.
fn mentions(expr: &Expr, names: &[&str]) -> bool {
    match &expr.kind {
        ExprKind::Parameter(name) => names.contains(&name.as_str()),
        ExprKind::Number(_) | ExprKind::Pi | ExprKind::Unit(_) => false,
        ExprKind::Neg(a) | ExprKind::Call(_, a) => mentions(a, names),
        ExprKind::Binary(_, a, b) => mentions(a, names) || mentions(b, names),
    }
}

/// Equal steps of a parameter, both ends included.
#[derive(Clone, Copy, Debug)]
pub struct ParameterSpan {
    first: DimensionedValue,
    /// The last value, in the unit of the first.
    last: f64,
    /// The number of steps; there is one value more.
    pub steps: usize,
}

impl ParameterSpan {
    /// Returns one of the values.
    pub fn value(&self, i: usize) -> DimensionedValue {
        let number = match i {
            0 => self.first.number,
            i if i == self.steps => self.last,
            i => {
                self.first.number + (self.last - self.first.number) * (i as f64 / self.steps as f64)
            }
        };
        DimensionedValue { number, ..self.first }
    }
}

/// The answers to the scene's questions for each value of one varied parameter, with the drivers at
/// the scene's positions: [`SweepPieces`]. Values without a mechanism are missing rows, with their
/// reason in the notes.
pub struct Varied<'a> {
    scene: &'a Scene,
    mechanism: &'a Mechanism,
    variation: &'a Variation,
    span: ParameterSpan,
    gaps: Gaps,
}

impl<'a> Varied<'a> {
    /// Starts the sweep of a variation of one parameter.
    pub fn new(
        scene: &'a Scene,
        mechanism: &'a Mechanism,
        variation: &'a Variation,
        span: ParameterSpan,
    ) -> Varied<'a> {
        Varied { scene, mechanism, variation, span, gaps: Gaps::of(scene) }
    }

    fn name(&self) -> (String, &'static str) {
        (
            self.variation.names().next().unwrap_or_default().to_owned(),
            self.variation.unit(&self.span.first),
        )
    }
}

/// The number of rows that take a moment: each is a mechanism placed and compiled, some tens of
/// microseconds.
const AT_ONCE: usize = 4096;

impl SweepPieces for Varied<'_> {
    fn columns(&self) -> Vec<(String, &'static str)> {
        std::iter::once(self.name())
            .chain(self.scene.find.iter().flat_map(super::compile::ask::names))
            .collect()
    }

    fn count(&self) -> usize {
        self.span.steps + 1
    }

    fn at_once(&self) -> usize {
        AT_ONCE
    }

    fn piece(
        &mut self,
        rows: Range<usize>,
        _used: Vec<Vec<f64>>,
        stop: StopSignal,
    ) -> Option<Vec<Vec<f64>>> {
        let (first, width) = (rows.start, self.columns().len());
        let one = |scene: &mut Scene, i: usize| -> Result<Vec<f64>, Faults> {
            let value = self.span.value(i);
            self.variation.set(scene, &[value])?;
            let topology = self.variation.topology(scene)?;
            let placed = PlacedScene::new(scene, topology.as_ref().unwrap_or(self.mechanism))?;
            let now = position_now(scene, &placed.at, 0);
            let stations = Stations::of_values(
                vec![now],
                super::station::angle_per_value(scene, &placed.at, 0),
            );
            let row = one_row(&placed, &stations)?;
            Ok(std::iter::once(value.si()).chain(row.columns.iter().map(|c| c[0])).collect())
        };
        let here = here();
        let made: Option<Vec<Result<Vec<f64>, Faults>>> = rows
            .into_par_iter()
            .map_init(
                || self.scene.clone(),
                |scene, i| (!stop()).then(|| here.enter(|| one(scene, i))),
            )
            .collect();
        let made = made?;
        let mut columns = vec![Vec::with_capacity(made.len()); width];
        let mut missing = BTreeMap::new();
        for (i, row) in made.into_iter().enumerate() {
            match row {
                Ok(row) => {
                    self.gaps.see(first + i, |column| row[1 + column]);
                    columns.iter_mut().zip(row).for_each(|(c, v): (&mut Vec<f64>, _)| c.push(v));
                }
                Err(why) => drop(missing.insert(i, why)),
            }
        }
        self.gaps.add(&missing, first);
        Some(columns)
    }

    fn notes(&self) -> Vec<Diagnostic> {
        let (name, unit) = self.name();
        let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
        self.gaps.notes(&|k| format!("{name} = {}{unit}", shortest(self.span.value(k).si())))
    }
}

/// The answers at one station, by the program where there is one.
fn one_row(placed: &PlacedScene, stations: &Stations) -> Result<SweepRows, Faults> {
    let general = General::new(placed, 0);
    let mut rows = match super::compile(
        placed.scene,
        placed.mechanism,
        &placed.at,
        Some(0),
        &placed.scene.find,
    ) {
        Ok(program) => {
            let mut rows = run_program(&program, placed, 0, stations, Width::Widest);
            rows.complete(&general, stations, &never, &|_| None);
            rows
        }
        Err(why) => without_program(&general, stations, &why).0,
    };
    match rows.missing.remove(&0) {
        Some(why) => Err(why),
        None => Ok(rows),
    }
}
