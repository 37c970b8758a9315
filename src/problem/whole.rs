//! Tables and diagrams of the whole motion, in the usual range and steps.

use super::range::{self, RangeFault, SweptRange, WrongValue};
use super::{Look, whole_motion};
use crate::diag::{Both, Diagnostic, Faults, Warned, both};
use crate::figure::curves::{self, CurveDiagram};
use crate::figure::list::Pages;
use crate::mechanism::Mechanism;
use crate::position::Path;
use crate::report::limits::balanced::BalancedEnergy;
use crate::scene::quantity::Meaning;
use crate::scene::{self, LinkId, OnLink, PointId, Scene, Swept};
use crate::sweep::long::LongSweep;
use crate::sweep::pieces::gather;
use crate::sweep::timed::TimedSweep;
use crate::sweep::{self, PlacedScene, Table};

/// Default number of steps: one for each degree of a turn.
pub const STEPS: usize = 360;

/// Largest deviation (sine) of a guide from an axis that counts as rounding of its angle.
const ALONG: f64 = 1e-9;

/// Returns a scene for a table of its whole motion, as [`whole_motion`] does. The rows follow every
/// piece of a profile; where no driver moves the cam, the scene is read again for each row, and no
/// piece is assumed.
pub fn over_a_table(scene: Scene) -> Warned<Scene> {
    let mut whole = whole_motion(scene);
    if whole.value.is_told_everywhere() {
        whole.notes.retain(|d| d.code != "cam-piece");
    }
    whole
}

/// Returns the answers over a full turn of the usual driver in steps of a degree, over the whole
/// travel of a slider, or over the usual time.
///
/// # Errors
/// `no-driver` for a scene without one; those of the sweep.
pub fn table(scene: &Scene) -> Result<Warned<Table>, Faults> {
    let Warned { value: scene, notes } = over_a_table(scene.clone());
    let mechanism = sweep::mechanism(&scene)?;
    let placed = PlacedScene::new(&scene, &mechanism)?;
    let swept = usual(&scene)?;
    Ok(Warned { value: rows(&placed, swept)?, notes })
}

/// Draws displacements, velocities and accelerations over the whole motion of [`table`]. The
/// displacement of each questioned link or slider is added to the questions of the file. The
/// diagrams are in one figure, or `paged` on pages of A4.
///
/// # Errors
/// `no-curve` if no question has a curve; those of [`table`].
pub fn curves(source: &[u8], look: &Look, paged: bool) -> Result<Warned<Pages>, Faults> {
    let Warned { value: scene, mut notes } = asking_for_motion(source, None)?;
    let mechanism = sweep::mechanism(&scene)?;
    let placed = PlacedScene::new(&scene, &mechanism)?;
    let swept = usual(&scene)?;
    let table = rows(&placed, swept)?;
    let (lang, notation) = look.marked(&scene);
    let diagram = match swept {
        Swept::Driver(driver) => CurveDiagram::of(&placed, driver, &table, &notation),
        Swept::Time => {
            let (timed, _) = TimedSweep::new(&placed, [None, None])?;
            let again = |times| Some(timed.table(times));
            CurveDiagram::swept(&scene, swept, &table, &again, &notation)
        }
    };
    if diagram.is_empty() {
        return Err(no_curve().into());
    }
    notes.extend(table.notes);
    let figures = match paged {
        true => curves::pages(&scene, &diagram, &look.style, lang),
        false => vec![curves::figure(&scene, &diagram, &look.style, lang)],
    };
    Ok(Warned { value: figures.into_iter().map(|f| ("curves".to_owned(), f)).collect(), notes })
}

/// Returns a scene for its whole motion with the questions `find`, else with its own and their
/// displacements ([`with_positions`]).
///
/// # Errors
/// Faults of the scene, its positions, and of the questions.
pub fn asking_for_motion(source: &[u8], find: Option<&str>) -> Result<Warned<Scene>, Faults> {
    let asked = match find {
        Some(find) => find.to_owned(),
        None => {
            let Warned { value, notes } = scene::read(source)?;
            let somewhere = notes.iter().all(|n| n.code != "free-centre");
            with_positions(&value, somewhere)?.join(",")
        }
    };
    Ok(over_a_table(scene::read_asking(source, &asked)?.value))
}

/// The fault of a scene whose questions have no curve.
pub fn no_curve() -> Diagnostic {
    Diagnostic::error("no-curve", both!("nothing that is asked has a curve"))
}

/// Returns the quantity that moves where none is named.
///
/// # Errors
/// `no-driver` for a scene without a driver.
pub fn usual(scene: &Scene) -> Result<Swept, Faults> {
    if scene.drivers.is_empty() {
        let message = both!("the scene has no driver");
        return Err(Diagnostic::error("no-driver", message).into());
    }
    Ok(Swept::usual(scene))
}

fn rows(placed: &PlacedScene, swept: Swept) -> Result<Table, Faults> {
    let Swept::Driver(driver) = swept else {
        let (timed, range) = TimedSweep::new(placed, [None, None])?;
        return Ok(gather(&mut timed.steps(range, STEPS)));
    };
    let steps = range::steps(placed, driver, &SweptRange::default()).map_err(Faults::from)?;
    Ok(gather(&mut LongSweep::new(placed, driver, steps)?))
}

/// Returns the scene's questions, each preceded by its displacement: the angle of a link, or the
/// coordinates in which a slider on the ground moves. A point that moves freely has no such
/// coordinate; a gear train without given centres (not `somewhere`) has no angles.
///
/// # Errors
/// The errors of the mechanism and its positions.
pub fn with_positions(scene: &Scene, somewhere: bool) -> Result<Vec<String>, Faults> {
    let mechanism = Mechanism::new(scene)?.value;
    let placed = PlacedScene::new(scene, &mechanism)?;
    let mut words: Vec<String> = Vec::new();
    for find in &scene.find {
        let meaning = find.what.meaning(scene);
        if let Some(l) = meaning.and_then(Meaning::turning_of)
            && somewhere
            && has_line(scene, l)
        {
            words.push(format!("phi_{}", scene.link_name(l)));
        }
        if let Some(OnLink { point, link: None }) = meaning.and_then(Meaning::vector_of) {
            let axes = axes(&placed, point);
            words.extend(axes.iter().map(|axis| format!("{axis}_{}", scene.point_name(point))));
        }
        words.push(find.text.clone());
    }
    let mut seen: Vec<String> = Vec::new();
    for word in words {
        if !seen.contains(&word) {
            seen.push(word);
        }
    }
    Ok(seen)
}

/// Returns true if a link has an angle of its own; a wheel that consists of its centre alone has
/// none.
fn has_line(scene: &Scene, link: LinkId) -> bool {
    let guided = scene
        .guides
        .iter()
        .any(|g| g.rolling.is_none() && (g.on == link || g.slider == Some(link)));
    guided || scene.links[link.0].points.len() >= 2
}

/// Returns the coordinates in which a pin on a straight guide of the ground moves.
fn axes(placed: &PlacedScene, point: PointId) -> &'static [&'static str] {
    let guides = placed.scene.guides.iter().zip(&placed.at.guides);
    let on_ground = guides.filter(|(g, _)| g.pin == Some(point) && g.on == placed.scene.ground);
    match on_ground.map(|(_, path)| path).next() {
        Some(Some(Path::Line { direction, .. })) if direction.y.abs() < ALONG => &["x"],
        Some(Some(Path::Line { direction, .. })) if direction.x.abs() < ALONG => &["y"],
        Some(Some(Path::Line { .. })) => &["x", "y"],
        _ => &[],
    }
}

/// Returns mean balancing moment and surplus energy of a scene with loads, with the flywheel if
/// requested.
///
/// # Errors
/// Faults of the scene; `flywheel` if the flywheel's coefficient cannot be read or has no use.
pub fn balanced(
    scene: &Scene,
    source: &str,
    driver: usize,
    delta: Option<&str>,
) -> Result<Option<BalancedEnergy>, RangeFault> {
    let wrong = |message: Both, help: Both| {
        let d = Diagnostic::error("flywheel", message).help(help);
        RangeFault::from(WrongValue::new("flywheel", delta.unwrap_or_default(), d))
    };
    let number = |text: &str| {
        let mut parts = text.splitn(2, '/').map(|part| part.trim().parse::<f64>().ok());
        let (above, below) = (parts.next()??, parts.next().map_or(Some(1.0), |x| x)?);
        Some(above / below).filter(|x| x.is_finite() && (0.0..1.0).contains(x) && *x > 0.0)
    };
    let told = match delta {
        Some(text) => Some(number(text).ok_or_else(|| {
            let message = both!("`{text}` is no coefficient of speed fluctuation");
            wrong(message, both!("write a number between 0 and 1, such as 1/30 or 0.03"))
        })?),
        None => None,
    };
    if scene.loads.is_empty() {
        let message = both!("the scene has no loads: there is nothing for a flywheel to even out");
        let help = both!("give \"forces\" or \"masses\"");
        return if told.is_some() { Err(wrong(message, help)) } else { Ok(None) };
    }
    let question = if driver == 0 { "M_b".to_owned() } else { format!("M_b{}", driver + 1) };
    let asked = scene::read_asking(source, &question).map(|read| read.value);
    let scene = match asked {
        Ok(scene) => scene,
        // A sliding driver has a force instead, and the rate of another driver may be missing: the
        // limits are printed without the balance.
        Err(_) if told.is_none() => return Ok(None),
        Err(faults) => return Err(RangeFault::Scene(faults)),
    };
    let energy = sweep::mechanism(&scene)
        .and_then(|m| sweep::energy::energy(&PlacedScene::new(&scene, &m)?, driver));
    let energy = match energy {
        Ok(energy) => energy,
        Err(_) if told.is_none() => return Ok(None),
        Err(faults) => return Err(RangeFault::Scene(faults)),
    };
    let rate = scene.drivers[driver].rate.value;
    match (energy, told) {
        (Some(_), Some(_)) if rate == 0.0 => {
            let message = both!("the driver stands still");
            Err(wrong(message, both!("give its \"omega\"")))
        }
        (Some(energy), delta) => Ok(Some(BalancedEnergy { energy, rate, delta })),
        (None, None) => Ok(None),
        (None, Some(_)) => {
            let message =
                both!("the driver does not turn fully, or never comes to its first pose again");
            Err(wrong(message, both!("a flywheel is for a driver that turns")))
        }
    }
}
