//! Zeros of the answers of a sweep between its stations, by repeated refinement of the steps in
//! which a number changes its sign or a vector its sense.
//!
//! A vector is zero where its component along its own direction before the step changes its sign
//! and its magnitude vanishes; one that only turns by more than 90° in a step is not. A number
//! that touches zero without a change of sign is zero at a lowest magnitude within rounding.

use super::Table;
use hodograph_base::geom::Vec2;

/// The number of stations of each pass; [`LOOKS`] is the number of passes. Each narrows the range
/// by 16, so that eleven make a step of a degree as small as the spacing of `f64`.
const STATIONS: usize = 16;
const LOOKS: usize = 11;
/// Magnitudes below this part of the largest one are zero.
const ROUNDING: f64 = 1e-9;
/// Magnitudes of a stretch of zeros, relative to the largest one.
const STILL: f64 = 1e-12;
/// A magnitude below this part of the largest one, lower than its neighbours, may touch zero.
const NEAR: f64 = 1e-3;

/// A place or stretch at which an answer is zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocatedZero {
    /// The swept quantity there (SI).
    pub at: f64,
    /// Its value at the end of the stretch, if the answer is zero throughout; else that of `at`.
    pub until: f64,
}

/// The rows of an answer: numbers, or the components of vectors.
#[derive(Clone, Copy, Debug)]
pub struct SoughtZeros<'a> {
    /// The names of the column, or of both columns of components.
    pub columns: [Option<&'a str>; 2],
}

impl SoughtZeros<'_> {
    /// Returns the vector of a row; a number has the y component zero.
    fn at(&self, table: &Table, row: usize) -> Option<Vec2> {
        let value = |name: Option<&str>| match name {
            Some(name) => table.column(name)?.values.get(row).copied(),
            None => Some(0.0),
        };
        let [x, y] = self.columns.map(value);
        Some(Vec2::new(x?, y?)).filter(|v| v.x.is_finite() && v.y.is_finite())
    }
}

/// The event that is located in a step.
#[derive(Clone, Copy)]
enum ZeroSearch {
    /// The component along this direction changes its sign.
    Sense(Vec2),
    /// The magnitude is lowest.
    Least,
    /// A stretch of zeros begins or ends.
    Edge,
}

/// A step in which an answer may be zero.
struct ZeroBracket {
    of: usize,
    range: [f64; 2],
    search: ZeroSearch,
}

/// Returns the zeros of each answer of a table, in ascending order. `swept_at` sweeps given values,
/// which ascend.
pub fn zeros(
    table: &Table,
    swept_at: &dyn Fn(Vec<f64>) -> Option<Table>,
    sought: &[SoughtZeros],
) -> Vec<Vec<LocatedZero>> {
    let mut found: Vec<Vec<LocatedZero>> = vec![Vec::new(); sought.len()];
    let Some(places) = table.columns.first().map(|c| c.values.as_slice()) else { return found };
    let mut brackets = Vec::new();
    let mut largest = Vec::new();
    for (of, one) in sought.iter().enumerate() {
        let rows: Vec<Option<Vec2>> = (0..places.len()).map(|row| one.at(table, row)).collect();
        let most = rows.iter().flatten().map(|v| v.norm()).fold(0.0, f64::max);
        largest.push(most);
        if most > 0.0 {
            found[of] = stretches(&rows, places, most);
            brackets.extend(of_rows(of, &rows, places, most));
        }
    }
    for _ in 0..LOOKS {
        let stations = |[from, to]: [f64; 2]| {
            let step = (to - from) / STATIONS as f64;
            (0..=STATIONS).map(move |k| if k == STATIONS { to } else { from + step * k as f64 })
        };
        let mut values: Vec<f64> = brackets.iter().flat_map(|b| stations(b.range)).collect();
        if values.is_empty() {
            break;
        }
        values.sort_by(f64::total_cmp);
        values.dedup();
        let Some(swept) = swept_at(values) else { break };
        let Some(at_rows) = swept.columns.first().map(|c| &c.values) else { break };
        for b in &mut brackets {
            let values: Vec<(f64, Vec2)> = stations(b.range)
                .filter_map(|at| {
                    let row = at_rows.binary_search_by(|v| v.total_cmp(&at)).ok()?;
                    Some((at, sought[b.of].at(&swept, row)?))
                })
                .collect();
            let step = (b.range[1] - b.range[0]) / STATIONS as f64;
            match b.search {
                ZeroSearch::Sense(u) => {
                    let crossed = values.windows(2).find(|w| {
                        let [one, other] = [w[0].1.dot(u), w[1].1.dot(u)];
                        one == 0.0 || (one > 0.0) != (other > 0.0)
                    });
                    if let Some(w) = crossed {
                        b.range = if w[0].1.dot(u) == 0.0 { [w[0].0; 2] } else { [w[0].0, w[1].0] };
                    }
                }
                ZeroSearch::Edge => {
                    let still = |v: Vec2| v.norm() <= STILL * largest[b.of];
                    let edge = values.windows(2).find(|w| still(w[0].1) != still(w[1].1));
                    if let Some(w) = edge {
                        b.range = [w[0].0, w[1].0];
                    }
                }
                ZeroSearch::Least => {
                    let least = values.iter().min_by(|a, b| a.1.norm().total_cmp(&b.1.norm()));
                    if let Some((at, _)) = least {
                        b.range = [(at - step).max(b.range[0]), (at + step).min(b.range[1])];
                    }
                }
            }
        }
    }
    let mut ends: Vec<f64> = brackets.iter().map(|b| 0.5 * (b.range[0] + b.range[1])).collect();
    ends.sort_by(f64::total_cmp);
    ends.dedup();
    let Some(swept) = swept_at(ends) else { return found };
    for b in &brackets {
        let at = 0.5 * (b.range[0] + b.range[1]);
        let rows = swept.columns.first().map(|c| c.values.as_slice()).unwrap_or_default();
        let value = rows
            .binary_search_by(|v| v.total_cmp(&at))
            .ok()
            .and_then(|row| sought[b.of].at(&swept, row));
        // At a pole the sign changes too.
        let edge = matches!(b.search, ZeroSearch::Edge);
        if edge || value.is_some_and(|v| v.norm() <= ROUNDING * largest[b.of]) {
            found[b.of].push(LocatedZero { at, until: at });
        }
    }
    let step = places.windows(2).map(|w| (w[1] - w[0]).abs()).fold(f64::INFINITY, f64::min);
    for zeros in &mut found {
        zeros.sort_by(|a, b| a.at.total_cmp(&b.at));
        // The edges of a stretch are less than a step from its rows.
        zeros.dedup_by(|b, a| {
            let stretch = a.until > a.at || b.until > b.at;
            let near = b.at <= a.until + if stretch { step } else { 1e-6 * step };
            if near && stretch {
                a.until = a.until.max(b.until);
            }
            near
        });
    }
    found
}

/// Returns the stretches of at least two rows on which an answer is zero, and rows that are zero.
fn stretches(rows: &[Option<Vec2>], places: &[f64], most: f64) -> Vec<LocatedZero> {
    let is_zero = |k: &usize| rows[*k].is_some_and(|v| v.norm() <= STILL * most);
    let all: Vec<usize> = (0..rows.len()).filter(is_zero).collect();
    all.chunk_by(|a, b| b - a == 1)
        .filter_map(|run| {
            Some(LocatedZero { at: places[*run.first()?], until: places[*run.last()?] })
        })
        .collect()
}

/// Returns the steps in which an answer may be zero, and those beside a lowest magnitude.
fn of_rows(of: usize, rows: &[Option<Vec2>], places: &[f64], most: f64) -> Vec<ZeroBracket> {
    let small = STILL * most;
    let still = |row: usize| rows.get(row).is_some_and(|v| v.is_some_and(|v| v.norm() <= small));
    let mut out = Vec::new();
    for k in 1..rows.len() {
        let (Some(a), Some(b)) = (rows[k - 1], rows[k]) else { continue };
        if a.dot(b) < 0.0 && a.norm() > small && b.norm() > small {
            let range = [places[k - 1], places[k]];
            out.extend(a.unit().map(|u| ZeroBracket { of, range, search: ZeroSearch::Sense(u) }));
        }
        // A single row is a zero by itself.
        let stretch = still(k - 1) && k > 1 && still(k - 2) || still(k) && still(k + 1);
        if still(k - 1) != still(k) && stretch {
            let range = [places[k - 1], places[k]];
            out.push(ZeroBracket { of, range, search: ZeroSearch::Edge });
        }
        let Some(&Some(c)) = rows.get(k + 1) else { continue };
        let low = b.norm() <= a.norm() && b.norm() <= c.norm() && b.norm() < NEAR * most;
        if low && a.dot(c) > 0.0 && a.dot(b) > 0.0 && b.norm() > small {
            let range = [places[k - 1], places[k + 1]];
            out.push(ZeroBracket { of, range, search: ZeroSearch::Least });
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{PlacedScene, of_values};
    use hodograph_mechanism::mechanism::Mechanism;
    use hodograph_scene::{read_asking, templates};
    use std::f64::consts::TAU;

    fn found(template: &str, find: &str, steps: usize) -> Vec<f64> {
        let scene = read_asking(templates::get(template).unwrap(), find).unwrap().value;
        let mechanism = Mechanism::new(&scene).unwrap().value;
        let placed = PlacedScene::new(&scene, &mechanism).unwrap();
        let swept_at = |values| of_values(&placed, 0, values);
        let rows = (0..=steps).map(|k| TAU * (k as f64 + 0.3) / steps as f64).collect();
        let table = swept_at(rows).unwrap();
        let parts = [".x", ".y"].map(|part| format!("{find}{part}"));
        let vector = table.column(&parts[0]).is_some();
        let columns =
            if vector { parts.each_ref().map(|p| Some(p.as_str())) } else { [Some(find), None] };
        let zeros = zeros(&table, &swept_at, &[SoughtZeros { columns }]).remove(0);
        zeros.iter().map(|z| z.at.to_degrees()).collect()
    }

    /// The lever's rate is zero where the crank is square to it, and the block rests on the lever
    /// where crank and lever are in line.
    #[test]
    fn the_coriolis_acceleration_of_a_shaper_vanishes_at_four_positions() {
        let at = found("shaper", "ak_A3A2", 180);
        let lever = found("shaper", "omega_3", 180);
        assert_eq!((at.len(), lever.len()), (4, 2), "{at:?} {lever:?}");
        let wanted = [90.0, lever[0], 270.0, lever[1]];
        for (a, b) in at.iter().zip(wanted) {
            assert!((a - b).abs() < 1e-9, "{at:?} {wanted:?}");
        }
    }

    #[test]
    fn a_slider_rests_at_the_ends_of_its_stroke_and_its_acceleration_vanishes_between() {
        let v = found("slider-crank", "v_C", 72);
        assert_eq!(v.len(), 2, "{v:?}");
        assert!((v[0] - 180.0).abs() < 1e-9 && (v[1] - 360.0).abs() < 1e-9, "{v:?}");
        let a = found("slider-crank", "a_C", 72);
        assert_eq!(a.len(), 2, "{a:?}");
        // The mechanism is symmetric about its axis.
        assert!((a[0] + a[1] - 360.0).abs() < 1e-9, "{a:?}");
    }
}
