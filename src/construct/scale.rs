//! The one door between SI and millimetres of paper: scales μ from the series 1, 2, 2.5, 5 × 10^k.

/// Room for each drawing, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Boxes {
    /// Width and height for the mechanism.
    pub diagram: [f64; 2],
    /// For each polygon.
    pub polygon: [f64; 2],
}

impl Default for Boxes {
    /// What lets a diagram and two polygons stand side by side on A4 across, with room for their labels.
    fn default() -> Self {
        Boxes { diagram: [120.0, 95.0], polygon: [95.0, 80.0] }
    }
}

/// The smallest preferred μ (SI per mm), so the largest drawing, at which `extent` (SI) fits `room` (mm) in both directions.
///
/// An extent of zero (all velocities vanish) fits any scale: 1 is taken.
pub fn choose(extent: [f64; 2], room: [f64; 2]) -> f64 {
    let need = (extent[0] / room[0]).max(extent[1] / room[1]);
    if !(need > 0.0 && need.is_finite()) {
        return 1.0;
    }
    let exponent = libm::floor(libm::log10(need)) as i32;
    for e in [exponent - 1, exponent, exponent + 1] {
        for step in [1.0, 2.0, 2.5, 5.0] {
            let mu = decimal(step, e);
            // A hair's breadth over the box is still in the box: 100 mm on 100 mm must not jump to the next scale.
            if mu * (1.0 + 1e-9) >= need {
                return mu;
            }
        }
    }
    decimal(1.0, exponent + 2)
}

/// step × 10^e as the nearest double to the decimal number (0.002, not 2 × 0.001000…02).
fn decimal(step: f64, e: i32) -> f64 {
    format!("{step}e{e}").parse().expect("a decimal number parses")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn preferred_series() {
        assert_eq!(choose([0.3, 0.1], [100.0, 100.0]), 0.005);
        assert_eq!(choose([0.2, 0.1], [100.0, 100.0]), 0.002);
        assert_eq!(choose([0.1, 0.25], [100.0, 100.0]), 0.0025);
        assert_eq!(choose([0.0, 0.0], [100.0, 100.0]), 1.0);
        assert_eq!(choose([1.0e12, 0.0], [100.0, 100.0]), 1.0e10);
    }
}
