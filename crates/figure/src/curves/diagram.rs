//! The content of a line diagram: the answers of a sweep as panels of curves, with their extremes.

use crate::plot::over;
use crate::sheet::swept_symbol;
use hodograph_base::notation::Notation;
use hodograph_report::amount::symbol;
use hodograph_scene::quantity::Of;
use hodograph_scene::{Asked, DiagramKind, Find, Kind, Scene, Swept};
use hodograph_sweep::zeros::{SoughtZeros, zeros};
use hodograph_sweep::zoom::{self, SoughtExtreme, extreme_row};
use hodograph_sweep::{PlacedScene, Table, of_values};
use std::f64::consts::TAU;

/// The degree, upright in the label language: its axes have special tick steps.
pub(super) const DEGREE: &str = "\\degree";
/// Values below this part of a line's largest value count as zero: the kink of a magnitude is
/// located to 1e-6 of a step.
const ZERO: f64 = 1e-6;
/// One line of a diagram.
#[derive(Clone, Debug, PartialEq)]
pub struct DiagramCurve {
    /// The name of its column of a sweep, such as `v_C.x`.
    pub name: String,
    /// The symbol, in the label language.
    pub symbol: String,
    /// The number of units of the panel in one SI unit.
    pub per_si: f64,
    /// The values in the unit of the panel, one for each place of the driver.
    pub values: Vec<f64>,
    /// The highest and the lowest point: place of the driver and value.
    pub extremes: Vec<(f64, f64)>,
    /// The places at which a rate, an acceleration or a force is zero: the first and the last one of
    /// each stretch.
    pub zeros: Vec<[f64; 2]>,
    /// The link of which the curve shows the motion.
    pub link: Option<usize>,
}

/// Curves of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// The unit, in the label language.
    pub unit: String,
    /// The symbol of the quantity, if the curves are named after something else.
    pub shared: Option<String>,
    /// The curves.
    pub curves: Vec<DiagramCurve>,
}

impl Panel {
    /// Returns the quantity in the label language: the shared symbol, the symbol of a single curve,
    /// or the letters of several.
    pub fn quantity(&self) -> String {
        if let Some(shared) = &self.shared {
            return shared.clone();
        }
        if let [one] = &self.curves[..] {
            return one.symbol.clone();
        }
        let letter = |c: &DiagramCurve| {
            c.symbol.trim_matches('|').split(['_', '^']).next().unwrap_or_default().to_owned()
        };
        let mut letters: Vec<String> = Vec::new();
        for found in self.curves.iter().map(letter) {
            if !letters.contains(&found) {
                letters.push(found);
            }
        }
        letters.join(" ,\\, ")
    }
}

/// The content of a diagram.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveDiagram {
    /// The driver's symbol and unit, in the label language.
    pub driver: [String; 2],
    /// The number of units of the driver in one SI unit.
    pub per_si: f64,
    /// The driver's places, increasing; a step longer than the usual one is a gap without values.
    pub places: Vec<f64>,
    /// The panels, from top to bottom.
    pub panels: Vec<Panel>,
    /// The heading in place of the scene's title, with what the n-th curve of every panel shows.
    pub legend: Option<CurveLegend>,
}

/// The heading of a diagram whose panels have the same curves, and the name of each curve.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveLegend {
    /// The heading.
    pub heading: String,
    /// The name of each curve, in the order of the curves of a panel.
    pub names: Vec<String>,
}

impl CurveDiagram {
    /// True if there is nothing to draw.
    pub fn is_empty(&self) -> bool {
        self.panels.is_empty()
    }

    /// Returns each quantity over its unit, in the label language: the driver, then all curves.
    pub fn heads(&self) -> Vec<String> {
        let [driver, unit] = &self.driver;
        let curves = self.panels.iter().flat_map(|p| p.curves.iter().map(move |c| (p, c)));
        let of_curves = curves.map(|(panel, curve)| over(&curve.symbol, &panel.unit));
        std::iter::once(over(driver, unit)).chain(of_curves).collect()
    }

    /// Returns the answers of a sweep of one driver: see [`CurveDiagram::swept`].
    pub fn of(
        placed: &PlacedScene,
        driver: usize,
        table: &Table,
        notation: &Notation,
    ) -> CurveDiagram {
        let swept_at = |values| of_values(placed, driver, values);
        CurveDiagram::swept(placed.scene, Swept::Driver(driver), table, &swept_at, notation)
    }

    /// Returns the answers of a sweep of one driver, or of time, with a panel each for
    /// displacements, angles, velocities, angular velocities, accelerations and angular
    /// accelerations. A vector that is parallel to one axis throughout (a slider's) is shown with
    /// its sign, any other by its magnitude. `swept_at` sweeps other values, for the extremes
    /// between those of the table.
    pub fn swept(
        scene: &Scene,
        swept: Swept,
        table: &Table,
        swept_at: &dyn Fn(Vec<f64>) -> Option<Table>,
        notation: &Notation,
    ) -> CurveDiagram {
        let column = |name: &str| table.column(name).map(|c| c.values.clone());
        let first = table.columns.first();
        let (named, moves) = swept_symbol(scene, swept);
        let (driver_unit, factor) = scene.book.fine(moves);
        let si: &[f64] = first.map_or(&[], |c| &c.values);
        let places = si.iter().map(|v| v * factor).collect();
        let mut shown = Vec::new();
        for find in &scene.find {
            let parts = [".x", ".y"].map(|part| format!("{}{part}", find.text));
            let own = symbol(find, notation);
            // Components and magnitudes are named as such: both appear in one panel. A position has
            // no magnitude, only coordinates.
            let [x, y] = [0, 1].map(|k| (parts[k].clone(), component(&own, ['x', 'y'][k])));
            let wanted = match parts.each_ref().map(|p| column(p)) {
                [Some(_), Some(_)] if column(&find.text).is_none() => vec![x, y],
                [Some(a), Some(b)] if vanishes(&b, &a) => vec![x],
                [Some(a), Some(b)] if vanishes(&a, &b) => vec![y],
                [Some(_), Some(_)] => vec![(find.text.clone(), format!("|{own}|"))],
                [_, None] | [None, _] => vec![(find.text.clone(), own)],
            };
            let magnitude = parts.iter().all(|part| column(part).is_some());
            shown.extend(wanted.into_iter().filter_map(|(name, symbol)| {
                let values = column(&name)?;
                let parts = (magnitude && name == find.text).then(|| parts.clone());
                Some(ShownColumn { parts, ..ShownColumn::new(scene, find, name, symbol, values) })
            }));
        }
        let sought: Vec<SoughtExtreme> = shown.iter().flat_map(ShownColumn::extremes).collect();
        let mut found = zoom::extremes(table, swept_at, &sought).into_iter().zip(&sought);
        let wanted: Vec<SoughtZeros> =
            shown.iter().filter(|c| !c.is_place()).map(ShownColumn::components).collect();
        let mut zeros = zeros(table, swept_at, &wanted).into_iter().peekable();
        let mut panels: Vec<((DiagramKind, bool, Kind), Panel)> = Vec::new();
        for column in &shown {
            let ShownColumn { find, symbol, values, times, line, .. } = column;
            let most = values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
            let mut extremes: Vec<(f64, f64)> = found
                .by_ref()
                .take(column.extremes().count())
                .map(|(found, &SoughtExtreme { row, .. })| {
                    // The extreme of an angle is sought on the turn of the line, not across its
                    // jump.
                    let found =
                        found.filter(|(_, v)| !column.turning || (v - values[row]).abs() < 1.0);
                    let (at, value) = found.unwrap_or((si[row], values[row]));
                    let value = if value.abs() < ZERO * most { 0.0 } else { value };
                    (at * factor, line[row] + (value - values[row]) * times)
                })
                .collect();
            // A constant curve has one value.
            if extremes.len() == 2 && extremes[0].1 - extremes[1].1 <= ZERO * most * times.abs() {
                extremes.pop();
            }
            let zeros = zeros.next_if(|_| !column.is_place()).unwrap_or_default();
            let curve = DiagramCurve {
                name: column.name.clone(),
                symbol: symbol.clone(),
                per_si: *times,
                values: line.clone(),
                extremes,
                zeros: zeros.iter().map(|z| [z.at, z.until].map(|at| at * factor)).collect(),
                link: link(scene, &find.what),
            };
            let order = order(&find.what);
            match panels.iter_mut().find(|(o, _)| *o == order) {
                Some((_, panel)) => panel.curves.push(curve),
                None => {
                    let unit = column.unit.clone();
                    panels.push((order, Panel { unit, shared: None, curves: vec![curve] }));
                }
            }
        }
        panels.sort_by_key(|p| p.0);
        CurveDiagram {
            driver: [named, driver_unit],
            per_si: factor,
            places,
            panels: panels.into_iter().map(|p| p.1).collect(),
            legend: None,
        }
    }
}

/// A column of a table that becomes a curve.
struct ShownColumn<'a> {
    find: &'a Find,
    name: String,
    symbol: String,
    /// The column itself, in SI.
    values: Vec<f64>,
    unit: String,
    /// The factor from SI to the unit.
    times: f64,
    turning: bool,
    /// The columns of both components, for a magnitude.
    parts: Option<[String; 2]>,
    /// The curve, in the unit; an angle without jumps.
    line: Vec<f64>,
}

impl<'a> ShownColumn<'a> {
    fn new(
        scene: &Scene,
        find: &'a Find,
        name: String,
        symbol: String,
        values: Vec<f64>,
    ) -> ShownColumn<'a> {
        let kind = find.what.kind();
        let (unit, times) = scene.book.fine(kind);
        let turning = kind == Kind::Angle;
        let line: Vec<f64> = values.iter().map(|v| v * times).collect();
        let line = if turning { unwound(&line, TAU * times) } else { line };
        ShownColumn { find, name, symbol, values, unit, times, turning, parts: None, line }
    }

    /// True for a coordinate or an angle: its zero depends on the choice of an axis.
    fn is_place(&self) -> bool {
        DiagramKind::of(self.find.what.kind().level()) == DiagramKind::Plane
    }

    /// Returns the columns of its vector, or its own.
    fn components(&self) -> SoughtZeros<'_> {
        let columns = match &self.parts {
            Some(parts) => parts.each_ref().map(|p| Some(p.as_str())),
            None => [Some(self.name.as_str()), None],
        };
        SoughtZeros { columns }
    }

    /// Returns its highest and lowest row.
    fn extremes(&self) -> impl Iterator<Item = SoughtExtreme<'_>> {
        [true, false].into_iter().filter_map(|highest| {
            let row = extreme_row(&self.line, highest)?;
            Some(SoughtExtreme { column: &self.name, row, highest })
        })
    }
}

/// Returns the symbol of a vector's component: `v_{C}` → `v_{C,x}`.
fn component(symbol: &str, axis: char) -> String {
    match symbol.strip_suffix('}') {
        Some(before) => format!("{before},{axis}}}"),
        None => format!("{symbol}_{axis}"),
    }
}

/// The panel order of a quantity, from the top: diagram by diagram, links below points, each kind
/// in its own unit.
fn order(what: &Asked) -> (DiagramKind, bool, Kind) {
    let kind = what.kind();
    let on = DiagramKind::of(kind.level());
    (on, kind != on.kind(), kind)
}

/// The link to which the motion belongs: for a pin the first moving link.
fn link(scene: &Scene, what: &Asked) -> Option<usize> {
    let link = match what.of() {
        Of::Link(l) => Some(l),
        Of::Point(p) => p.link.or_else(|| scene.mover(p.point)),
        Of::Points(..) | Of::Links(..) | Of::Line(..) | Of::Seen(..) | Of::Mechanism => None,
    };
    link.map(|l| l.0)
}

/// True if one component is only rounding error beside the other.
fn vanishes(small: &[f64], large: &[f64]) -> bool {
    let most = |v: &[f64]| v.iter().filter(|x| x.is_finite()).fold(0.0, |m: f64, x| m.max(x.abs()));
    most(small) <= 1e-9 * most(large)
}

/// Angles without jumps by a full turn, in the unit of that turn.
fn unwound(angles: &[f64], turn: f64) -> Vec<f64> {
    let mut out: Vec<f64> = Vec::with_capacity(angles.len());
    for d in angles {
        let before = out.last().copied().unwrap_or(*d);
        out.push(d - turn * libm::round((d - before) / turn));
    }
    out
}
