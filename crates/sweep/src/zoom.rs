//! Extremes of a column between the stations of a sweep, by repeated grid refinement around the
//! best station.

use super::Table;

/// The number of stations of each pass; [`LOOKS`] is the number of passes. Each narrows the range
/// by 16, so that five make a step of a degree 1e-6 of it. A smooth extreme is then true to the
/// last digits of `f64`, and the zero of a magnitude to 1e-6 of its value a step away.
const STATIONS: usize = 32;
const LOOKS: usize = 5;

/// An extreme to locate.
#[derive(Clone, Copy, Debug)]
pub struct SoughtExtreme<'a> {
    /// The name of the column.
    pub column: &'a str,
    /// The row of the table next to the extreme: it is sought between the two rows beside this one.
    pub row: usize,
    /// True for the highest value, false for the lowest.
    pub highest: bool,
}

/// Returns the row of the highest or lowest value.
pub fn extreme_row(values: &[f64], highest: bool) -> Option<usize> {
    let by = |a: &usize, b: &usize| match highest {
        true => values[*a].total_cmp(&values[*b]),
        false => values[*b].total_cmp(&values[*a]),
    };
    (0..values.len()).max_by(by)
}

/// Returns each extreme beside its row of a table as (position, value); `None` if nothing can be
/// assembled there or the column does not exist.
///
/// `swept_at` sweeps given values, which ascend. Each pass is one sweep for all extremes: a
/// mechanism that is followed from its instant is followed once in a pass.
pub fn extremes(
    table: &Table,
    swept_at: &dyn Fn(Vec<f64>) -> Option<Table>,
    sought: &[SoughtExtreme],
) -> Vec<Option<(f64, f64)>> {
    let mut found: Vec<Option<(f64, f64)>> = vec![None; sought.len()];
    let Some(places) = table.columns.first().map(|c| &c.values) else { return found };
    let beside = |s: &SoughtExtreme| {
        [s.row.saturating_sub(1), (s.row + 1).min(places.len() - 1)].map(|row| places[row])
    };
    let mut ranges: Vec<[f64; 2]> = sought.iter().map(beside).collect();
    for _ in 0..LOOKS {
        let stations = |[from, to]: [f64; 2]| {
            let step = (to - from) / STATIONS as f64;
            (0..=STATIONS).map(move |k| from + step * k as f64)
        };
        let mut values: Vec<f64> = ranges.iter().flat_map(|r| stations(*r)).collect();
        values.sort_by(f64::total_cmp);
        values.dedup();
        let Some(swept) = swept_at(values) else { break };
        let Some(at_rows) = swept.columns.first().map(|c| &c.values) else { break };
        for ((one, range), best) in sought.iter().zip(&mut ranges).zip(&mut found) {
            let Some(column) = swept.column(one.column) else { continue };
            let better = |a: f64, b: f64| if one.highest { a > b } else { a < b };
            for at in stations(*range) {
                let Ok(row) = at_rows.binary_search_by(|v| v.total_cmp(&at)) else { continue };
                let value = column.values[row];
                if best.is_none_or(|(_, b)| better(value, b)) {
                    *best = Some((at, value));
                }
            }
            let Some((at, _)) = *best else { continue };
            let step = (range[1] - range[0]) / STATIONS as f64;
            let [low, high] = beside(one);
            *range = [(at - step).max(low), (at + step).min(high)];
        }
    }
    found
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
        let swept_at = |values| of_values(&placed, 0, values);
        // The crank is in line at 180 and at 360 degrees: the piston's speed is zero there.
        let rows = [10.0, 170.0, 190.0, 350.0, 365.0].map(f64::to_radians);
        let table = swept_at(rows.to_vec()).unwrap();
        let sought = |column, row| SoughtExtreme { column, row, highest: false };
        let found =
            extremes(&table, &swept_at, &[sought("v_C", 1), sought("v_X", 0), sought("v_C", 4)]);
        for (found, place) in [found[0], found[2]].into_iter().zip([180.0, 360.0]) {
            let (at, v) = found.unwrap();
            assert!((at.to_degrees() - place).abs() < 1e-4 && v < 1e-5, "{} {v}", at.to_degrees());
        }
        assert_eq!(found[1], None);
    }
}
