//! Several designs side by side: the same results of each over its whole motion, as a table and as
//! one diagram with a curve for each design.

use super::listed::listed;
use super::range::{RangeFault, driver_of};
use crate::diag::{Diagnostic, both};
use crate::figure::curves::{CurveDiagram, CurveLegend, DiagramCurve, Panel};
use crate::mechanism::Mechanism;
use crate::notation::Notation;
use crate::report::comparison::{ComparedCell, ComparedRow, Comparison, MotionResult};
use crate::report::limits::output_name;
use crate::scene::{DiagramKind, Kind, Lang, Scene};
use crate::sweep::extreme::{self, MotionLimits};
use hodograph_base::lang::tr;
use std::f64::consts::TAU;

/// Places of the driver closer than this part of the whole motion are one.
const SAME: f64 = 1e-9;

/// A scene to compare, with its questions and its whole motion: see
/// [`over_a_table`](super::whole::over_a_table).
#[derive(Clone, Debug)]
pub struct ComparedScene {
    /// The name of its file.
    pub file: String,
    /// The scene.
    pub scene: Scene,
}

/// A design with its results.
struct ComparedMotion<'a> {
    scene: &'a Scene,
    driver: (String, Kind),
    limits: MotionLimits,
    diagram: CurveDiagram,
}

/// One curve of a design, in SI units.
#[derive(Clone)]
struct MotionCurve {
    name: String,
    symbol: String,
    values: Vec<f64>,
    extremes: Vec<(f64, f64)>,
    zero: Option<f64>,
    places: Vec<f64>,
}

/// Returns the table of several scenes and the diagram of their quantities, over the motion of one
/// driver of each (see [`driver_of`]).
///
/// Outputs and quantities of the same name are in one row. A vector that is given by a component in
/// one scene and by a magnitude, or another component, in another scene is compared by magnitudes.
///
/// # Errors
/// The number of the scene at fault, with its fault: those of [`range::rows`](super::range::rows)
/// and of the limits; `other-driver` if one driver turns and another slides.
pub fn compare(
    scenes: &[ComparedScene],
    over: Option<&str>,
    lang: Lang,
    notation: &Notation,
) -> Result<(Comparison, CurveDiagram), (usize, RangeFault)> {
    let mut all: Vec<ComparedMotion> = Vec::new();
    for (k, ComparedScene { scene, .. }) in scenes.iter().enumerate() {
        let motion = motion(scene, over, notation).map_err(|fault| (k, fault))?;
        if let Some(first) = all.first().filter(|first| first.driver.1 != motion.driver.1) {
            return Err((
                k,
                RangeFault::Scene(other_driver(&first.driver.0, &motion.driver.0).into()),
            ));
        }
        all.push(motion);
    }
    let same = |name: &&String| all.iter().all(|m| m.driver.0 == **name);
    let driver = all.first().map(|m| &m.driver.0).filter(same).cloned();
    let mut comparison = Comparison {
        files: names(scenes),
        titles: scenes.iter().map(|s| lang.of(&s.scene.title).to_owned()).collect(),
        driver: driver.clone().unwrap_or_else(|| "driver".to_owned()),
        driver_unit: all.first().map_or((String::new(), 1.0), driver_unit),
        rows: outputs(&all),
    };
    let mut diagram = CurveDiagram {
        driver: match all.first() {
            Some(first) if driver.is_some() => first.diagram.driver.clone(),
            _ => [tr!(lang, "\\text{driver}").to_owned(), comparison.driver_unit.0.clone()],
        },
        per_si: comparison.driver_unit.1,
        places: common_places(&all).iter().map(|x| x * comparison.driver_unit.1).collect(),
        panels: Vec::new(),
        legend: Some(CurveLegend {
            heading: tr!(lang, "Comparison of designs").to_owned(),
            names: comparison.names(lang),
        }),
    };
    for (question, kind) in questions(&all) {
        for curves in quantities(&all, &question, kind) {
            let unit = unit_of(&all, &question, kind);
            let named = name_of(&curves, &question);
            let is_rate = DiagramKind::of(kind.level()) != DiagramKind::Plane;
            comparison.rows.extend(results(&named, &unit, is_rate, &curves));
            diagram.panels.push(panel(&curves, &unit, &diagram.places, diagram.per_si));
        }
    }
    Ok((comparison, diagram))
}

/// Returns the name of each file, with its folder where two have the same name.
fn names(scenes: &[ComparedScene]) -> Vec<String> {
    let short =
        |s: &ComparedScene| s.file.rsplit(['/', '\\']).next().unwrap_or_default().to_owned();
    let all: Vec<String> = scenes.iter().map(short).collect();
    let name = |(s, own): (&ComparedScene, &String)| {
        let alone = all.iter().filter(|n| *n == own).count() == 1;
        if alone { own.clone() } else { s.file.clone() }
    };
    scenes.iter().zip(&all).map(name).collect()
}

fn other_driver(first: &str, this: &str) -> Diagnostic {
    let message = both!(
        "`{this}` and `{first}` of the first scene are not of one kind: one turns, the other slides"
    );
    Diagnostic::error("other-driver", message).help(both!(
        "compare mechanisms with drivers of one kind, or name another driver with --over"
    ))
}

fn motion<'a>(
    scene: &'a Scene,
    over: Option<&str>,
    notation: &Notation,
) -> Result<ComparedMotion<'a>, RangeFault> {
    let mechanism = Mechanism::new(scene).map_err(RangeFault::Scene)?.value;
    let driver = driver_of(scene, over)?;
    let diagram = listed(scene, over, notation)?;
    let limits = extreme::limits(scene, &mechanism, driver).map_err(RangeFault::Scene)?;
    Ok(ComparedMotion { scene, driver: scene.driver_name(driver), limits, diagram })
}

/// Returns a place of a driver that turns fully within one turn: its end is the beginning.
fn first_turn(motion: &ComparedMotion, at: f64) -> f64 {
    if motion.driver.1 != Kind::Angle || !motion.limits.range.full() {
        return at;
    }
    let rest = at.rem_euclid(TAU);
    if TAU - rest < SAME * TAU { 0.0 } else { rest }
}

fn driver_unit(motion: &ComparedMotion) -> (String, f64) {
    (motion.diagram.driver[1].clone(), motion.diagram.per_si)
}

/// Returns the rows of strokes, time ratios and transmission angles.
fn outputs(all: &[ComparedMotion]) -> Vec<ComparedRow> {
    let mut names: Vec<(String, Kind)> = Vec::new();
    let kind = |output| match output {
        extreme::DrivenOutput::Turning(_) => Kind::Angle,
        extreme::DrivenOutput::Sliding(_) => Kind::Length,
    };
    for motion in all {
        for swing in motion.limits.swings.iter().filter(|s| s.stroke.is_some()) {
            let name = (output_name(motion.scene, swing.output), kind(swing.output));
            if !names.contains(&name) {
                names.push(name);
            }
        }
    }
    let fine = |kind| all.first().map_or((String::new(), 1.0), |m| m.scene.book.fine(kind));
    let mut rows = Vec::new();
    for (name, of) in names {
        let swing = |m: &ComparedMotion| {
            let named = |s: &&extreme::Swing| {
                output_name(m.scene, s.output) == name && kind(s.output) == of
            };
            m.limits.swings.iter().find(named).map(|s| (s.stroke, s.time_ratio))
        };
        let found: Vec<_> = all.iter().map(|m| swing(m).unwrap_or_default()).collect();
        let cell = |value| ComparedCell { value, at: None };
        rows.push(ComparedRow {
            quantity: name.clone(),
            result: MotionResult::Stroke,
            unit: fine(of),
            cells: found.iter().map(|(stroke, _)| stroke.map(cell)).collect(),
        });
        rows.push(ComparedRow {
            quantity: name,
            result: MotionResult::TimeRatio,
            unit: (String::new(), 1.0),
            cells: found.iter().map(|(_, ratio)| ratio.map(cell)).collect(),
        });
    }
    let least = |m: &ComparedMotion| {
        let worst = m.limits.transmission.iter().min_by(|a, b| a.angle.total_cmp(&b.angle))?;
        Some(ComparedCell { value: worst.angle, at: Some(first_turn(m, worst.driver)) })
    };
    rows.insert(
        0,
        ComparedRow {
            quantity: String::new(),
            result: MotionResult::Transmission,
            unit: fine(Kind::Angle),
            cells: all.iter().map(least).collect(),
        },
    );
    rows.retain(|row| row.cells.iter().any(Option::is_some));
    rows
}

/// Returns the questions of all scenes, each once, in the order of the panels of the first scene
/// that asks it.
fn questions(all: &[ComparedMotion]) -> Vec<(String, Kind)> {
    let mut found: Vec<(String, Kind)> = Vec::new();
    for motion in all {
        for curve in motion.diagram.panels.iter().flat_map(|p| &p.curves) {
            found.extend(question(motion.scene, &curve.name).filter(|q| !found.contains(q)));
        }
    }
    found
}

/// Returns the question that a curve answers, without the axis of a component.
fn question(scene: &Scene, name: &str) -> Option<(String, Kind)> {
    let text = name.strip_suffix(".x").or(name.strip_suffix(".y")).unwrap_or(name);
    scene.find.iter().find(|f| f.text == text).map(|f| (f.text.clone(), f.what.kind()))
}

fn unit_of(all: &[ComparedMotion], text: &str, kind: Kind) -> (String, f64) {
    let asks =
        |m: &&ComparedMotion| m.scene.find.iter().any(|f| f.text == text && f.what.kind() == kind);
    all.iter().find(asks).map_or((String::new(), 1.0), |m| m.scene.book.fine(kind))
}

/// Returns the curves of a question, one list for each quantity, with a place for each design.
fn quantities(all: &[ComparedMotion], text: &str, kind: Kind) -> Vec<Vec<Option<MotionCurve>>> {
    let of = |m: &ComparedMotion| -> Vec<MotionCurve> {
        let curves = m.diagram.panels.iter().flat_map(|p| &p.curves);
        let asked = curves
            .filter(|c| question(m.scene, &c.name).is_some_and(|q| q == (text.to_owned(), kind)));
        asked.map(|c| curve_of(m, c)).collect()
    };
    let found: Vec<Vec<MotionCurve>> = all.iter().map(of).collect();
    if found.iter().any(|curves| curves.len() > 1) {
        let mut names: Vec<String> = Vec::new();
        for curve in found.iter().flatten().filter(|c| !names.contains(&c.name)).collect::<Vec<_>>()
        {
            if !names.contains(&curve.name) {
                names.push(curve.name.clone());
            }
        }
        let named = |name: &String| {
            found.iter().map(|curves| curves.iter().find(|c| c.name == *name).cloned()).collect()
        };
        return names.iter().map(named).collect();
    }
    let mut alone: Vec<Option<MotionCurve>> = found.into_iter().map(|mut c| c.pop()).collect();
    let first = alone.iter().flatten().next().map(|c| c.name.clone());
    if alone.iter().flatten().any(|c| Some(&c.name) != first.as_ref()) {
        alone.iter_mut().flatten().for_each(|c| c.take_magnitude(text));
    }
    vec![alone]
}

fn curve_of(motion: &ComparedMotion, curve: &DiagramCurve) -> MotionCurve {
    let driver = motion.diagram.per_si;
    MotionCurve {
        name: curve.name.clone(),
        symbol: curve.symbol.clone(),
        values: curve.values.iter().map(|v| v / curve.per_si).collect(),
        extremes: curve
            .extremes
            .iter()
            .map(|(x, v)| (first_turn(motion, x / driver), v / curve.per_si))
            .collect(),
        zero: curve.zeros.first().map(|[from, _]| first_turn(motion, from / driver)),
        places: motion.diagram.places.iter().map(|x| x / driver).collect(),
    }
}

impl MotionCurve {
    /// Takes the magnitude of the values: the curve of the question itself.
    fn take_magnitude(&mut self, question: &str) {
        let greatest = self.greatest();
        let lowest = match self.extremes[..] {
            [_, (at, low)] if low > 0.0 => Some((at, low)),
            [(at, high), _] if high < 0.0 => Some((at, -high)),
            _ => self.zero.map(|at| (at, 0.0)),
        };
        self.name = question.to_owned();
        let symbol = self.symbol.trim_matches('|');
        let axis = [",x}", ",y}"].iter().find_map(|axis| symbol.strip_suffix(axis));
        let symbol = axis.map_or(symbol.to_owned(), |before| format!("{before}}}"));
        self.symbol = format!("|{symbol}|");
        self.values.iter_mut().for_each(|v| *v = v.abs());
        self.extremes = greatest.into_iter().chain(lowest).collect();
    }

    /// Returns the greatest magnitude of the extremes, with its place.
    fn greatest(&self) -> Option<(f64, f64)> {
        let sizes = self.extremes.iter().map(|(x, v)| (*x, v.abs()));
        sizes.max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Returns the mean over the position of the driver, by the trapezoidal rule; steps without an
    /// answer do not count.
    fn mean(&self) -> Option<f64> {
        let points: Vec<(f64, f64)> =
            self.places.iter().copied().zip(self.values.iter().copied()).collect();
        let steps = points.windows(2).map(|w| (w[1].0 - w[0].0, 0.5 * (w[0].1 + w[1].1)));
        let usual = steps.clone().map(|(dx, _)| dx).fold(f64::INFINITY, f64::min);
        let known = steps.filter(|(dx, v)| v.is_finite() && *dx <= 1.5 * usual);
        let (length, area) = known.fold((0.0, 0.0), |(l, a), (dx, v)| (l + dx, a + dx * v));
        let mean = area / length;
        let greatest = self.greatest().map_or(0.0, |(_, v)| v);
        // A mean within rounding of zero is zero.
        (length > 0.0).then_some(if mean.abs() < SAME * greatest { 0.0 } else { mean })
    }
}

/// Returns the name of a quantity: that of its columns, or the question itself.
fn name_of(curves: &[Option<MotionCurve>], question: &str) -> String {
    curves.iter().flatten().next().map_or(question.to_owned(), |c| c.name.clone())
}

/// Returns the rows of a quantity.
fn results(
    name: &str,
    unit: &(String, f64),
    is_rate: bool,
    curves: &[Option<MotionCurve>],
) -> Vec<ComparedRow> {
    let row = |result, of: &dyn Fn(&MotionCurve) -> Option<ComparedCell>| ComparedRow {
        quantity: name.to_owned(),
        result,
        unit: unit.clone(),
        cells: curves.iter().map(|c| c.as_ref().and_then(of)).collect(),
    };
    let cell = |(at, value): (f64, f64)| ComparedCell { value, at: Some(at) };
    let lowest = |c: &MotionCurve| c.extremes.get(1).or(c.extremes.first()).copied();
    let signed = curves.iter().flatten().any(|c| lowest(c).is_some_and(|(_, v)| v < 0.0));
    let mut rows = vec![
        row(MotionResult::Highest, &|c| c.extremes.first().copied().map(cell)),
        row(MotionResult::Lowest, &|c| lowest(c).map(cell)),
    ];
    if is_rate && signed {
        rows.push(row(MotionResult::Greatest, &|c| c.greatest().map(cell)));
    }
    rows.push(row(MotionResult::Mean, &|c| c.mean().map(|value| ComparedCell { value, at: None })));
    rows
}

/// Returns the places of the drivers of all designs (SI), each once.
fn common_places(all: &[ComparedMotion]) -> Vec<f64> {
    let of = |m: &ComparedMotion| {
        m.diagram.places.iter().map(|x| x / m.diagram.per_si).collect::<Vec<_>>()
    };
    let mut places: Vec<f64> = all.iter().flat_map(of).collect();
    places.sort_by(f64::total_cmp);
    let span = match places[..] {
        [first, .., last] => last - first,
        _ => 0.0,
    };
    places.dedup_by(|next, kept| *next - *kept <= SAME * span);
    places
}

/// Returns the panel of a quantity, with a curve for each design; a design without the quantity has
/// a curve without points.
fn panel(
    curves: &[Option<MotionCurve>],
    (unit, per_si): &(String, f64),
    places: &[f64],
    driver_per_si: f64,
) -> Panel {
    let shared = curves.iter().flatten().next().map(|c| c.symbol.clone());
    let curve = |(k, curve): (usize, &Option<MotionCurve>)| {
        let mut values = vec![f64::NAN; places.len()];
        let span = places.last().unwrap_or(&0.0) - places.first().unwrap_or(&0.0);
        let known = curve.iter().flat_map(|c| c.places.iter().zip(&c.values));
        for (x, value) in known {
            let at = x * driver_per_si;
            let place = places.partition_point(|p| *p < at - SAME * span);
            values.get_mut(place).into_iter().for_each(|slot| *slot = value * per_si);
        }
        let extremes = curve.iter().flat_map(|c| &c.extremes);
        DiagramCurve {
            name: curve.as_ref().map_or_else(String::new, |c| c.name.clone()),
            symbol: format!("\\text{{{}}}", k + 1),
            per_si: *per_si,
            values,
            extremes: extremes.map(|(x, v)| (x * driver_per_si, v * per_si)).collect(),
            zeros: Vec::new(),
            link: Some(k),
        }
    };
    Panel { unit: unit.clone(), shared, curves: curves.iter().enumerate().map(curve).collect() }
}
