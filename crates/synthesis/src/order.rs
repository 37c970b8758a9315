//! Order defects: wanted positions that the driver does not meet one after the other without
//! reversing.

use hodograph_base::diag::{Both, Diagnostic, both};
use std::f64::consts::TAU;

/// The defect of a list of positions, each with the driver's position (rad); a crank that turns
/// fully may pass its start once.
pub fn defect(drivers: &[(usize, f64)], rotates: bool) -> Option<Diagnostic> {
    let steps: Vec<f64> = drivers.windows(2).map(|w| w[1].1 - w[0].1).collect();
    let forward = |sense: f64| match rotates {
        true => {
            steps.iter().map(|s| (sense * s).rem_euclid(TAU)).sum::<f64>() < TAU * (1.0 + 1e-12)
        }
        false => steps.iter().all(|s| sense * s >= 0.0),
    };
    if forward(1.0) || forward(-1.0) {
        return None;
    }
    let mut met: Vec<(usize, f64)> = drivers.to_vec();
    if rotates {
        let first = met.first().map_or(0.0, |m| m.1);
        met.iter_mut().for_each(|m| m.1 = (m.1 - first).rem_euclid(TAU));
    }
    met.sort_by(|a, b| a.1.total_cmp(&b.1));
    let order = met.iter().map(|(i, _)| (i + 1).to_string()).collect::<Vec<_>>();
    let message = both!("the driver meets the positions in the order {}", Both::names(&order));
    Some(Diagnostic::warning("defect-order", message))
}
