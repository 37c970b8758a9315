//! `hodograph sweep` (all positions of a driver, or values of a parameter, into a file) and
//! `hodograph limits` (results of the whole motion).

use super::args::{LimitsArgs, RangeArgs, SweepArgs};
use super::places::OutputPlace;
use super::values::TableFormat;
use super::{CommandResult, Failure, SceneInput, SourceFaults, choices, files, tables};
use crate::diag::{Both, Diagnostic, Faults, Warned, both};
use crate::mechanism::Mechanism;
use crate::problem::whole::{STEPS, over_a_table};
use crate::report::limits as report;
use crate::scene::{self, Angle, Scene, Swept, edit};
use crate::sweep::extreme;
use crate::sweep::long::LongSweep;
use crate::sweep::pieces::SweepPieces;
use crate::sweep::station::{self, DriverSpan};
use crate::sweep::timed::TimedSweep;
use crate::sweep::vary::{ParameterSpan, Variation, Varied};
use crate::sweep::{self, PlacedScene, StationSteps, Stations};
use std::process::ExitCode;

pub fn sweep(a: SweepArgs) -> CommandResult {
    let mut input = SceneInput::read(&a.common)?;
    // Without a name and a format, the table is printed.
    let asked = a.output.as_deref().or((!a.format.is_empty()).then_some("-"));
    let place =
        asked.map(|output| tables::place(output, &a.format, TableFormat::Csv)).transpose()?;
    ask(&mut input, a.range.find.as_deref())?;
    input.over_a_table();
    let notes = sweep_into(&input, &a, place.as_ref())?;
    input.file.notes.extend(notes);
    input.file.say_notes();
    Ok(ExitCode::SUCCESS)
}

impl SceneInput {
    /// Changes the scene to its whole motion for a table.
    pub(super) fn over_a_table(&mut self) {
        let Warned { value, notes } = over_a_table(self.scene.clone());
        self.scene = value;
        self.file.notes.extend(notes);
    }
}

/// Writes the table to its place; returns its notes.
fn sweep_into(
    input: &SceneInput,
    a: &SweepArgs,
    place: Option<&OutputPlace<TableFormat>>,
) -> Result<Vec<Diagnostic>, Failure> {
    let title = input.scene.title.get(choices(&input.scene, &a.common).0);
    let scene = &input.scene;
    let mechanism = sweep::mechanism(scene).map_err(|f| input.failed(f))?;
    let over = a.range.over.as_deref();
    let swept = over.map_or_else(|| Some(Swept::usual(scene)), |name| Swept::named(scene, name));
    if let (Some(name), None) = (over, swept) {
        let variation =
            Variation::new(scene, &[name]).map_err(|f| Failure::argument("--over", name, f))?;
        let span = values(scene, &variation, name, a)?;
        return write(&mut Varied::new(scene, &mechanism, &variation, span), title, place);
    }
    let placed = PlacedScene::new(scene, &mechanism).map_err(|f| input.failed(f))?;
    if swept == Some(Swept::Time) {
        let (timed, range) = through(&placed, &a.range)?;
        return write(&mut timed.steps(range, a.range.steps.unwrap_or(STEPS)), title, place);
    }
    let driver = driver_of(scene, over)?;
    let steps = steps(input, &placed, driver, &a.range, a.range.steps.unwrap_or(STEPS))?;
    let mut long = LongSweep::new(&placed, driver, steps).map_err(|f| input.failed(f))?;
    write(&mut long, title, place)
}

fn write(
    sweep: &mut dyn SweepPieces,
    title: &str,
    place: Option<&OutputPlace<TableFormat>>,
) -> Result<Vec<Diagnostic>, Failure> {
    match place {
        Some(place) => tables::write(sweep, title, place)?,
        None => files::print_with(|out| tables::print(sweep, out))?,
    }
    Ok(sweep.notes())
}

/// Runs the command `limits`.
pub fn limits(a: LimitsArgs) -> CommandResult {
    // The limits of the motion do not depend on the driver's speed.
    let mut input = SceneInput::read_at_rest(&a.common)?;
    input.over_a_turn();
    let (lang, _) = choices(&input.scene, &a.common);
    let mechanism = Mechanism::new(&input.scene).map_err(|f| input.failed(f))?.value;
    let driver = driver_of(&input.scene, a.over.as_deref())?;
    let limits = extreme::limits(&input.scene, &mechanism, driver).map_err(|f| input.failed(f))?;
    if a.ranges {
        let all = report::ranges::of(&limits).map_err(|d| input.failed(d.into()))?;
        if a.json {
            files::print(&format!("{:#}\n", report::ranges::json(&all)))?;
        } else {
            files::print(&report::ranges::text(&input.scene, &all, lang))?;
        }
    } else {
        let energy = balanced(&input, driver, a.flywheel.as_deref())?;
        if a.json {
            let mut json = report::json(&input.scene, driver, &limits);
            json["energy"] = energy.map(|e| e.json()).into();
            files::print(&format!("{json:#}\n"))?;
        } else {
            files::print(&report::text(&input.scene, driver, &limits, lang))?;
            if let Some(energy) = energy {
                files::print(&energy.text(&input.scene, driver, &limits, lang))?;
            }
        }
    }
    input.file.say_notes();
    Ok(ExitCode::SUCCESS)
}

/// Returns mean balancing moment and surplus energy of a scene with loads, with the flywheel if
/// requested.
fn balanced(
    input: &SceneInput,
    driver: usize,
    delta: Option<&str>,
) -> Result<Option<report::balanced::BalancedEnergy>, Failure> {
    let wrong = |message: Both, help: Both| {
        Failure::argument(
            "--flywheel",
            delta.unwrap_or_default(),
            Diagnostic::error("flywheel", message).help(help),
        )
    };
    let number = |text: &str| {
        let mut parts = text.splitn(2, '/').map(|part| part.trim().parse::<f64>().ok());
        let (above, below) = (parts.next()??, parts.next().map_or(Some(1.0), |x| x)?);
        Some(above / below).filter(|x| x.is_finite() && (0.0..1.0).contains(x) && *x > 0.0)
    };
    let told = match delta {
        Some(text) => Some(number(text).ok_or_else(|| {
            let message = both!(
                "`{text}` is no coefficient of speed fluctuation",
                "`{text}` 不是运转不均匀系数"
            );
            wrong(
                message,
                both!(
                    "write a number between 0 and 1, such as 1/30 or 0.03",
                    "请写 0 与 1 之间的数，如 1/30 或 0.03"
                ),
            )
        })?),
        None => None,
    };
    if input.scene.loads.is_empty() {
        let message = both!(
            "the scene has no loads: there is nothing for a flywheel to even out",
            "机构文件没有载荷，不需要飞轮"
        );
        let help = both!("give \"forces\" or \"masses\"", "请给出 \"forces\" 或 \"masses\"");
        return if told.is_some() { Err(wrong(message, help)) } else { Ok(None) };
    }
    let question = if driver == 0 { "M_b".to_owned() } else { format!("M_b{}", driver + 1) };
    let asked = scene::read_asking(&input.file.source, &question).map(|read| read.value);
    let scene = match asked {
        Ok(scene) => scene,
        // A sliding driver has a force instead, and the rate of another driver may be missing: the
        // limits are printed without the balance.
        Err(_) if told.is_none() => return Ok(None),
        Err(faults) => return Err(input.failed(faults)),
    };
    let energy = sweep::mechanism(&scene)
        .and_then(|m| sweep::energy::energy(&PlacedScene::new(&scene, &m)?, driver));
    let energy = match energy {
        Ok(energy) => energy,
        Err(_) if told.is_none() => return Ok(None),
        Err(faults) => return Err(input.failed(faults)),
    };
    let rate = scene.drivers[driver].rate.value;
    match (energy, told) {
        (Some(_), Some(_)) if rate == 0.0 => {
            let message = both!("the driver stands still", "原动件静止");
            Err(wrong(message, both!("give its \"omega\"", "请给出其 \"omega\"")))
        }
        (Some(energy), delta) => Ok(Some(report::balanced::BalancedEnergy { energy, rate, delta })),
        (None, None) => Ok(None),
        (None, Some(_)) => {
            let message = both!(
                "the driver does not turn fully, or never comes to its first pose again",
                "原动件不能整周转动，或不再回到原位"
            );
            Err(wrong(
                message,
                both!("a flywheel is for a driver that turns", "飞轮用于整周转动的原动件"),
            ))
        }
    }
}

/// Returns the driver that `--over` names; without a name the first.
pub fn driver_of(scene: &Scene, over: Option<&str>) -> Result<usize, Failure> {
    let Some(name) = over.filter(|o| *o != "driver") else { return Ok(0) };
    if let Some(d) = driver_named(scene, name)
        && scene.is_led(d)
    {
        let message = both!(
            "`{name}` follows its cam: it does not move by itself",
            "`{name}` 由凸轮带动，不能单独运动"
        );
        let d =
            Diagnostic::error("no-driver", message).help(both!("let the cam turn", "请使凸轮转动"));
        return Err(Failure::argument("--over", name, d));
    }
    driver_named(scene, name).ok_or_else(|| {
        let names: Vec<String> = (0..scene.drivers.len()).map(|d| scene.driver_name(d).0).collect();
        let d = Diagnostic::error(
            "no-driver",
            both!("the scene has no driver `{name}`", "机构文件没有原动件 `{name}`"),
        );
        Failure::argument(
            "--over",
            name,
            d.help(both!("its drivers are {}", "其原动件有 {}", Both::names(&names))),
        )
    })
}

/// Returns the variable that `--over` names: a driver, or `t`. Without a name, it is time if the
/// scene has laws of time, else the first driver.
pub fn swept_of(scene: &Scene, over: Option<&str>) -> Result<Swept, Failure> {
    match over {
        None => Ok(Swept::usual(scene)),
        Some(name) if Swept::named(scene, name) == Some(Swept::Time) => Ok(Swept::Time),
        Some(_) => driver_of(scene, over).map(Swept::Driver),
    }
}

/// Replaces the scene's questions by those of `--find`; faults point to the argument.
pub fn ask(input: &mut SceneInput, find: Option<&str>) -> Result<(), Failure> {
    let Some(find) = find else { return Ok(()) };
    input.file.asked = Some(find.to_owned());
    let read = scene::read_asking(&input.file.source, find);
    let Warned { value, notes } = read.map_err(|faults| input.failed(faults))?;
    (input.scene, input.file.notes) = (value, notes);
    Ok(())
}

/// Returns the values of a parameter between the bounds of the command line.
fn values(
    scene: &Scene,
    variation: &Variation,
    name: &str,
    a: &SweepArgs,
) -> Result<ParameterSpan, Failure> {
    let bound = |text: Option<&str>, option: &'static str| {
        let missing = || {
            Diagnostic::error("range", both!("{option} is missing", "缺少 {option}")).help(both!(
                "a parameter has no natural range: give --from and --to",
                "参数没有自然的范围：请给出 --from 和 --to"
            ))
        };
        let text = text.ok_or_else(|| Failure::argument("--over", name, missing()))?;
        variation.value(scene, name, text).map_err(|f| Failure::argument(option, text, f))?;
        Ok(text.to_owned())
    };
    let (from, to) =
        (bound(a.range.from.as_deref(), "--from")?, bound(a.range.to.as_deref(), "--to")?);
    variation
        .span(scene, name, &from, &to, a.range.steps.unwrap_or(STEPS))
        .map_err(|f| Failure::argument("--over", name, f))
}

/// Returns a driver by the name of its column: `phi_1`, `s_B`, `l_BC`; `driver` and `driver2` give
/// its number.
pub fn driver_named(scene: &Scene, name: &str) -> Option<usize> {
    (0..scene.drivers.len())
        .find(|&d| scene.driver_name(d).0 == name || name == format!("driver{}", d + 1))
}

/// Returns the stations of a driver between two values in the scene's notation; by default a full
/// turn for a turning driver, and the whole travel for a sliding one.
pub fn stations(
    input: &SceneInput,
    placed: &PlacedScene,
    driver: usize,
    range: &RangeArgs,
    count: usize,
) -> Result<Stations, Failure> {
    Ok(steps(input, placed, driver, range, count)?.all())
}

/// Checks that the number of steps is not larger than `what` allows.
pub fn within(steps: usize, most: usize, what: Both) -> Result<usize, Failure> {
    if steps <= most {
        return Ok(steps);
    }
    let d = Diagnostic::error(
        "too-many",
        both!(
            "--steps {steps}: {} has at most {most} steps",
            "--steps {steps}：{}至多 {most} 步",
            what
        ),
    );
    let d = d.help(both!(
        "write --steps {most} or fewer; `sweep` writes tables of up to ten million rows",
        "请写 --steps {most} 或更少；`sweep` 可写至多一千万行的表"
    ));
    Err(Failure::argument("--steps", &steps.to_string(), d))
}

/// Largest end of a range, in turns: a mechanism with followed links is followed through all of
/// them.
const MOST_TURNS: f64 = 10_000.0;

/// Checks that the end of a range is not too far away.
fn not_too_far(option: &str, text: &str, angle: Angle) -> Result<Angle, Failure> {
    let turns = angle.degrees().abs() / 360.0;
    if turns <= MOST_TURNS {
        return Ok(angle);
    }
    let d = Diagnostic::error(
        "range",
        both!(
            "it lies {turns} turns off; at most {MOST_TURNS} are allowed",
            "相距 {turns} 转；最多允许 {MOST_TURNS} 转"
        ),
    );
    let d = d.help(both!(
        "the motion comes again with every turn, or with every few",
        "运动每转一周或几周即重复"
    ));
    Err(Failure::argument(option, text, d))
}

/// Follows the mechanism through the time of the command line (s); returns it with the ends.
pub fn through<'a>(
    placed: &'a PlacedScene<'a>,
    range: &RangeArgs,
) -> Result<(TimedSweep<'a>, [f64; 2]), Failure> {
    let ends = bounds(range, edit::time)?;
    let text = range.to.as_deref().or(range.from.as_deref()).unwrap_or_default();
    TimedSweep::new(placed, ends).map_err(|f| Failure::argument("--to", text, f))
}

fn steps(
    input: &SceneInput,
    placed: &PlacedScene,
    driver: usize,
    range: &RangeArgs,
    steps: usize,
) -> Result<StationSteps, Failure> {
    let Some(d) = placed.scene.drivers.get(driver) else {
        return Err(input.failed(
            Diagnostic::error("no-driver", both!("the scene has no driver", "机构文件没有原动件"))
                .into(),
        ));
    };
    if d.kind.turns() {
        bounds(range, edit::angle)?;
        let (from, to) =
            (range.from.as_deref().unwrap_or("0"), range.to.as_deref().unwrap_or("360"));
        let [first, last] = edit::angles(from, to).map_err(|f| Failure::argument("--to", to, f))?;
        let way =
            DriverSpan::Turn(not_too_far("--from", from, first)?, not_too_far("--to", to, last)?);
        return Ok(StationSteps { way, steps });
    }
    let per_value = station::angle_per_value(placed.scene, &placed.at, driver);
    let [from, to] = match bounds(range, edit::length)? {
        [Some(from), Some(to)] => [from, to],
        [from, to] => {
            let limits = extreme::limits(placed.scene, placed.mechanism, driver)
                .map_err(|f| input.failed(f))?;
            let [low, high] = limits.range.bounds();
            [from.unwrap_or(low), to.unwrap_or(high)]
        }
    };
    Ok(StationSteps { way: DriverSpan::Slide { from, to, per_value }, steps })
}

/// Reads `--from` and `--to` if given; reports all their faults at once.
fn bounds<T>(
    range: &RangeArgs,
    read: impl Fn(&str) -> Result<T, Faults>,
) -> Result<[Option<T>; 2], Failure> {
    let mut wrong = Vec::new();
    let both = [("--from", &range.from), ("--to", &range.to)].map(|(option, text)| {
        let text = text.as_deref()?;
        read(text).map_err(|faults| wrong.push(SourceFaults::argument(option, text, faults))).ok()
    });
    if wrong.is_empty() { Ok(both) } else { Err(Failure::Input(wrong)) }
}
