//! Motion laws of cams by the textbook formulas, in long numbers.

use crate::cam_truth::whole;
use hodograph::number::{Big, Real};

/// S(x) of a law, in the form of the given half of its range.
pub fn normal(law: &str, x: Big, half: usize) -> Big {
    let pi = Big::pi();
    let sine = |t: Big| t.sin_cos().0;
    let power = |n: i32| (0..n).fold(whole(1), |p, _| p * x);
    match law {
        "uniform" => x,
        "parabolic" if half == 0 => whole(2) * x * x,
        "parabolic" => whole(1) - whole(2) * (whole(1) - x) * (whole(1) - x),
        "harmonic" => (whole(1) - (pi * x).sin_cos().1) / whole(2),
        "cycloidal" => x - sine(whole(2) * pi * x) / (whole(2) * pi),
        "3-4-5" => whole(10) * power(3) - whole(15) * power(4) + whole(6) * power(5),
        "4-5-6-7" => {
            whole(35) * power(4) - whole(84) * power(5) + whole(70) * power(6)
                - whole(20) * power(7)
        }
        "modified-sine" => {
            let over = whole(4) + pi;
            match half {
                0 => (pi * x - sine(whole(4) * pi * x) / whole(4)) / over,
                1 => {
                    (whole(2) + pi * x
                        - whole(9) / whole(4) * sine(whole(4) * pi * x / whole(3) + pi / whole(3)))
                        / over
                }
                _ => (whole(4) + pi * x - sine(whole(4) * pi * x) / whole(4)) / over,
            }
        }
        other => panic!("{other}"),
    }
}

/// Ends of the parts of a law with formulas of their own.
pub fn ends(law: &str) -> &'static [f64] {
    match law {
        "parabolic" => &[0.5, 1.0],
        "modified-sine" => &[0.125, 0.875, 1.0],
        _ => &[1.0],
    }
}
