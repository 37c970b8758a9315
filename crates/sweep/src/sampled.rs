//! Proof of a sweep by samples: some of its positions are judged by the statements of the scene.

use super::chunks::run_parts;
use super::general::General;
use super::lane::Width;
use super::positions::Stood;
use super::station::Stations;
use super::{PlacedScene, branches};
use hodograph_base::diag::Faults;
use hodograph_mechanism::position::Configuration;
use hodograph_mechanism::stated::{self, Moment};

/// The number of positions judged in a sweep of any length: both ends, and others evenly between
/// them. The tests judge every position of sweeps of all templates.
const SAMPLES: usize = 9;

/// The largest number of stations through which a group is followed to the judged positions: about
/// that of a usual sweep.
const FOLLOWED: usize = 73;

/// Checks that some positions of a sweep's compiled program satisfy the statements of the scene.
/// `value` returns the driver's value at each of `count` stations. Positions that the mechanism
/// does not reach are not judged. Rows made without a program are proved one by one as they are
/// made.
///
/// # Errors
/// `position-unproven`, one for each statement that is broken.
pub fn proved(
    placed: &PlacedScene,
    driver: usize,
    count: usize,
    value: impl Fn(usize) -> f64,
) -> Result<(), Faults> {
    let general = General::new(placed, driver);
    if count == 0 || general.is_read_again() {
        return Ok(());
    }
    let Some(stood) = Stood::even_followed(placed, driver) else { return Ok(()) };
    let through = count.min(if stood.program.tracks.is_empty() { SAMPLES } else { FOLLOWED });
    let among = |k: usize, few: usize, many: usize| k * (many - 1) / (few - 1).max(1);
    let chosen = (0..through).map(|k| value(among(k, through, count)));
    let stations = Stations::of_values(
        chosen.collect(),
        super::station::angle_per_value(placed.scene, &placed.at, driver),
    );
    let judge = |i: usize, at: &Configuration| {
        stated::proved(
            &general.scene_at(&stations, i),
            placed.mechanism,
            at,
            Moment::Later(&placed.at),
        )
    };
    let (parts, _) = branches(stood.program.clone(), placed, driver, &stations);
    let rows = run_parts(&parts, placed, driver, &stations, Width::One);
    let samples = SAMPLES.min(through);
    let there =
        (0..samples).map(|k| among(k, samples, through)).filter(|i| !rows.missing.contains_key(i));
    there
        .filter_map(|i| Some((i, stood.laid(placed, &rows.columns, i)?)))
        .try_for_each(|(i, at)| judge(i, &at))
}
