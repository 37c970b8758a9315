//! Ranges of a sweep in words: what moves, from where to where, in how many steps.
//!
//! [`rows`] finds the sweep of a range, which makes its table piece by piece.

use super::whole::STEPS;
use crate::diag::{Both, Diagnostic, Faults, Span, both};
use crate::kind::Kind;
use crate::scene::{Angle, Book, Scene, Swept, edit};
use crate::sweep::long::LongSweep;
use crate::sweep::pieces::SweepPieces;
use crate::sweep::station::{self, DriverSpan};
use crate::sweep::timed::TimedSweep;
use crate::sweep::vary::{ParameterSpan, Variation, Varied};
use crate::sweep::{self, PlacedScene, StationSteps, extreme};

/// The range of a sweep in the notation of the scene. An absent value is the usual one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SweptRange<'a> {
    /// The variable: a driver, a parameter, or `t`, the time.
    pub over: Option<&'a str>,
    /// The beginning.
    pub from: Option<&'a str>,
    /// The end.
    pub to: Option<&'a str>,
    /// The number of equal steps.
    pub steps: Option<usize>,
}

/// Faults of a value of a request.
#[derive(Clone, Debug, PartialEq)]
pub struct WrongValue {
    /// The value, such as `over` or `from`.
    pub of: &'static str,
    /// Its text, to which the places of the faults refer.
    pub text: String,
    /// The faults, each with a place unless the text is empty.
    pub faults: Faults,
}

/// The reason why a request, such as the range of a sweep, cannot be met.
#[derive(Clone, Debug, PartialEq)]
pub enum RangeFault {
    /// Faults of the scene.
    Scene(Faults),
    /// Faults of values of the request.
    Values(Vec<WrongValue>),
}

impl WrongValue {
    pub(crate) fn new(of: &'static str, text: &str, faults: impl Into<Faults>) -> WrongValue {
        let whole = (!text.is_empty()).then(|| Span::new(0, text.len()));
        let mut faults = faults.into();
        for d in &mut faults.list {
            d.span = d.span.filter(|s| s.end <= text.len()).or(whole);
        }
        WrongValue { of, text: text.to_owned(), faults }
    }
}

impl From<Faults> for RangeFault {
    fn from(faults: Faults) -> RangeFault {
        RangeFault::Scene(faults)
    }
}

impl From<WrongValue> for RangeFault {
    fn from(wrong: WrongValue) -> RangeFault {
        RangeFault::Values(vec![wrong])
    }
}

/// All faults, those of values without their places.
impl From<RangeFault> for Faults {
    fn from(fault: RangeFault) -> Faults {
        match fault {
            RangeFault::Scene(faults) => faults,
            RangeFault::Values(all) => {
                let list = all.into_iter().flat_map(|wrong| wrong.faults.list);
                Faults { list: list.map(|d| Diagnostic { span: None, ..d }).collect() }
            }
        }
    }
}

/// Begins the sweep of a range and passes it to `take`.
///
/// ```
/// use hodograph::problem::{range::{SweptRange, rows}, read, templates};
/// use hodograph::sweep::pieces::gather;
/// let scene = read(templates::text("crank-rocker", &[])?)?.value.into_scene()?;
/// let range = SweptRange { from: Some("0"), to: Some("90"), steps: Some(9), ..SweptRange::default() };
/// assert_eq!(rows(&scene, &range, |pieces| gather(pieces)).unwrap().rows(), 10);
/// # Ok::<(), hodograph::diag::Faults>(())
/// ```
///
/// # Errors
/// Values that cannot be read or do not fit the scene; those of the sweep.
pub fn rows<T>(
    scene: &Scene,
    range: &SweptRange,
    take: impl FnOnce(&mut dyn SweepPieces) -> T,
) -> Result<T, RangeFault> {
    let mechanism = sweep::mechanism(scene).map_err(RangeFault::Scene)?;
    let swept =
        range.over.map_or_else(|| Some(Swept::usual(scene)), |name| Swept::named(scene, name));
    if let (Some(name), None) = (range.over, swept) {
        let variation =
            Variation::new(scene, &[name]).map_err(|f| WrongValue::new("over", name, f))?;
        let span = values(scene, &variation, name, range)?;
        return Ok(take(&mut Varied::new(scene, &mechanism, &variation, span)));
    }
    let placed = PlacedScene::new(scene, &mechanism).map_err(RangeFault::Scene)?;
    if swept == Some(Swept::Time) {
        let (timed, ends) = through(&placed, range)?;
        return Ok(take(&mut timed.steps(ends, range.steps.unwrap_or(STEPS))));
    }
    let driver = driver_of(scene, range.over)?;
    let steps = steps(&placed, driver, range)?;
    Ok(take(&mut LongSweep::new(&placed, driver, steps).map_err(RangeFault::Scene)?))
}

/// Returns a driver by its name (see [`driver_named`]); without a name the first.
///
/// # Errors
/// `no-driver`: a name that the scene does not have, or a driver that follows a cam.
pub fn driver_of(scene: &Scene, over: Option<&str>) -> Result<usize, WrongValue> {
    let Some(name) = over.filter(|o| *o != "driver") else { return Ok(0) };
    if let Some(d) = driver_named(scene, name)
        && scene.is_led(d)
    {
        let message = both!("`{name}` follows its cam: it does not move by itself");
        let d = Diagnostic::error("no-driver", message).help(both!("let the cam turn"));
        return Err(WrongValue::new("over", name, d));
    }
    driver_named(scene, name).ok_or_else(|| {
        let own = (0..scene.drivers.len()).filter(|d| !scene.is_led(*d));
        let names: Vec<String> = own.map(|d| scene.driver_name(d).0).collect();
        let d = Diagnostic::error("no-driver", both!("the scene has no driver `{name}`"));
        WrongValue::new("over", name, d.help(both!("its drivers are {}", Both::names(&names))))
    })
}

/// Returns a driver by the name of its column: `phi_1`, `s_B`, `l_BC`; `driver` and `driver2` give
/// its number.
pub fn driver_named(scene: &Scene, name: &str) -> Option<usize> {
    (0..scene.drivers.len())
        .find(|&d| scene.driver_name(d).0 == name || name == format!("driver{}", d + 1))
}

/// Returns the variable with a name: a driver, or `t`. Without a name, it is time if the scene has
/// laws of time, else the first driver.
///
/// # Errors
/// As [`driver_of`].
pub fn swept_of(scene: &Scene, over: Option<&str>) -> Result<Swept, WrongValue> {
    match over {
        None => Ok(Swept::usual(scene)),
        Some(name) if Swept::named(scene, name) == Some(Swept::Time) => Ok(Swept::Time),
        Some(_) => driver_of(scene, over).map(Swept::Driver),
    }
}

/// Returns the values of a parameter between the bounds of a range.
fn values(
    scene: &Scene,
    variation: &Variation,
    name: &str,
    range: &SweptRange,
) -> Result<ParameterSpan, WrongValue> {
    let bound = |text: Option<&str>, of: &'static str| {
        let missing = || {
            Diagnostic::error("range", both!("--{of} is missing"))
                .help(both!("a parameter has no default range: give --from and --to"))
        };
        let text = text.ok_or_else(|| WrongValue::new("over", name, missing()))?;
        variation.value(scene, name, text).map_err(|f| WrongValue::new(of, text, f))?;
        Ok(text.to_owned())
    };
    let (from, to) = (bound(range.from, "from")?, bound(range.to, "to")?);
    variation
        .span(scene, name, &from, &to, range.steps.unwrap_or(STEPS))
        .map_err(|f| WrongValue::new("over", name, f))
}

/// Largest end of a range, in turns: a mechanism with followed links is followed through all of
/// them.
const MOST_TURNS: f64 = 10_000.0;

/// Checks that the end of a range is not too far away.
fn not_too_far(of: &'static str, text: &str, angle: Angle) -> Result<Angle, WrongValue> {
    let turns = angle.degrees().abs() / 360.0;
    if turns <= MOST_TURNS {
        return Ok(angle);
    }
    let d = Diagnostic::error(
        "range",
        both!("this end of the range is {turns} turns away from zero; the limit is {MOST_TURNS}"),
    );
    let d = d.help(both!("the motion repeats after one turn or a few"));
    Err(WrongValue::new(of, text, d))
}

/// Follows the mechanism through the time of a range (s); returns it with the ends.
///
/// # Errors
/// Ends that are no times; those of [`TimedSweep::new`].
pub fn through<'a>(
    placed: &'a PlacedScene<'a>,
    range: &SweptRange,
) -> Result<(TimedSweep<'a>, [f64; 2]), RangeFault> {
    let ends = bounds(range, edit::time)?;
    let text = range.to.or(range.from).unwrap_or_default();
    Ok(TimedSweep::new(placed, ends).map_err(|f| WrongValue::new("to", text, f))?)
}

/// Returns the steps of a driver between two values; by default a full turn for a turning driver,
/// and the whole travel for a sliding one.
///
/// # Errors
/// `no-driver` for a scene without one; ends that cannot be read; those of the limits of a travel.
pub fn steps(
    placed: &PlacedScene,
    driver: usize,
    range: &SweptRange,
) -> Result<StationSteps, RangeFault> {
    let steps = range.steps.unwrap_or(STEPS);
    let Some(d) = placed.scene.drivers.get(driver) else {
        return Err(RangeFault::Scene(
            Diagnostic::error("no-driver", both!("the scene has no driver")).into(),
        ));
    };
    if d.kind.turns() {
        bounds(range, edit::angle)?;
        let (from, to) = (range.from.unwrap_or("0"), range.to.unwrap_or("360"));
        let [first, last] = edit::angles(from, to).map_err(|f| WrongValue::new("to", to, f))?;
        let way = DriverSpan::Turn(not_too_far("from", from, first)?, not_too_far("to", to, last)?);
        return Ok(StationSteps { way, steps });
    }
    let per_value = station::angle_per_value(placed.scene, &placed.at, driver);
    let [from, to] = match bounds(range, edit::length)? {
        [Some(from), Some(to)] => [from, to],
        [from, to] => {
            let limits = extreme::limits(placed.scene, placed.mechanism, driver)
                .map_err(RangeFault::Scene)?;
            let [low, high] = limits.range.bounds();
            [from.unwrap_or(low), to.unwrap_or(high)]
        }
    };
    Ok(StationSteps { way: DriverSpan::Slide { from, to, per_value }, steps })
}

/// Reads the ends if given; reports all their faults at once.
fn bounds<T>(
    range: &SweptRange,
    read: impl Fn(&str) -> Result<T, Faults>,
) -> Result<[Option<T>; 2], RangeFault> {
    let mut wrong = Vec::new();
    let both = [("from", range.from), ("to", range.to)].map(|(of, text)| {
        let text = text?;
        read(text).map_err(|faults| wrong.push(WrongValue::new(of, text, faults))).ok()
    });
    if wrong.is_empty() { Ok(both) } else { Err(RangeFault::Values(wrong)) }
}

/// Returns the unit of the scene in which each column is printed, with the number of these units in
/// one SI unit.
pub fn book_units(scene: &Scene, columns: &[(String, &'static str)]) -> Vec<(String, f64)> {
    units_of(scene, &scene.book, columns)
}

/// Returns the units of a table from the list of `--units` (see [`Book::of_table`]), one for each
/// column, with the number of these units in one SI unit.
///
/// # Errors
/// `unit` for a word that is no unit.
pub fn listed_units(
    scene: &Scene,
    list: &str,
    columns: &[(String, &'static str)],
) -> Result<Vec<(String, f64)>, WrongValue> {
    let book = scene.book.of_table(list).map_err(|word| {
        let message = both!("`{word}` is no unit of an answer");
        let help = both!("write `book`, or units such as mm,deg,mm/s,r/min");
        WrongValue::new("units", list, Diagnostic::error("unit", message).help(help))
    })?;
    Ok(units_of(scene, &book, columns))
}

fn units_of(scene: &Scene, book: &Book, columns: &[(String, &'static str)]) -> Vec<(String, f64)> {
    let kind = |(name, unit): &(String, &'static str)| {
        let question = name.strip_suffix(".x").or(name.strip_suffix(".y")).unwrap_or(name);
        let asked = scene.find.iter().find(|f| f.text == question).map(|f| f.what.kind());
        asked.or_else(|| Kind::ALL.into_iter().find(|kind| kind.si() == *unit))
    };
    let told = |column: &(String, &'static str)| match kind(column) {
        Some(kind) => (book.name(kind).to_owned(), book.value(kind, 1.0)),
        None => (column.1.to_owned(), 1.0),
    };
    columns.iter().map(told).collect()
}
