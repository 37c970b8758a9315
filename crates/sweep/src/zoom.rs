//! Extremes of a column between the stations of a sweep, by repeated grid refinement around the
//! best station.

use super::Table;

/// The number of stations of each pass; [`LOOKS`] is the number of passes. Each narrows the range
/// by 16, so that five make a step of a degree 1e-6 of it. A smooth extreme is then true to the
/// last digits of `f64`, and the zero of a magnitude to 1e-6 of its value a step away.
const STATIONS: usize = 32;
const LOOKS: usize = 5;

/// Returns the highest or lowest value of a column (by name) between two values of the swept
/// quantity, as (position, value); `table` sweeps given values. `None` if nothing can be assembled
/// or the column does not exist.
pub fn extreme(
    table: &dyn Fn(Vec<f64>) -> Option<Table>,
    column: &str,
    range: [f64; 2],
    highest: bool,
) -> Option<(f64, f64)> {
    let [mut from, mut to] = range;
    let mut best: Option<(f64, f64)> = None;
    for _ in 0..LOOKS {
        let step = (to - from) / STATIONS as f64;
        let table = table((0..=STATIONS).map(|k| from + step * k as f64).collect())?;
        let rows = table.columns.first()?.values.iter().zip(&table.column(column)?.values);
        let better = |a: f64, b: f64| if highest { a > b } else { a < b };
        for (at, value) in rows {
            if best.is_none_or(|(_, b)| better(*value, b)) {
                best = Some((*at, *value));
            }
        }
        let (at, _) = best?;
        (from, to) = ((at - step).max(range[0]), (at + step).min(range[1]));
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{PlacedScene, of_values};
    use hodograph_mechanism::mechanism::Mechanism;
    use hodograph_scene::{read, templates};

    #[test]
    fn the_piston_stops_at_the_ends_of_its_stroke() {
        let scene = read(templates::get("slider-crank").unwrap()).unwrap().value;
        let mechanism = Mechanism::new(&scene).unwrap().value;
        let placed = PlacedScene::new(&scene, &mechanism).unwrap();
        let table = |values| of_values(&placed, 0, values);
        // Between these two stations, at 180 degrees, the crank is in line: the piston's speed is
        // zero there.
        let (at, v) =
            extreme(&table, "v_C", [170.0_f64.to_radians(), 190.0_f64.to_radians()], false)
                .unwrap();
        assert!((at.to_degrees() - 180.0).abs() < 1e-4 && v < 1e-5, "{} {v}", at.to_degrees());
        assert_eq!(extreme(&table, "v_X", [0.0, 1.0], true), None);
    }
}
