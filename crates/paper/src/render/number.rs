//! Writes numbers for all file formats: millimetres to 0.001, in the shortest form.

/// Returns a number of millimetres as it is written to files: rounded to 0.001 mm, without `-0`,
/// `30.000000000000004` or `.5`.
///
/// 0.001 mm is a two-hundredth of the thinnest line: rounding is invisible, and the text is the
/// same on platforms that differ in the last bits. The number must be finite; [`super::svg::write`]
/// rejects others beforehand.
pub fn mm(value: f64) -> String {
    // `+ 0.0` turns −0 into 0; Rust's shortest form does the rest, because k / 1000 is the double
    // nearest to it.
    ((value * 1000.0).round() / 1000.0 + 0.0).to_string()
}

/// Significant digits of a value in SI units: more than any drawing provides, and few enough to be
/// the same on all platforms.
const SI_DIGITS: usize = 6;

/// Returns a value in SI units as it is written to files: six significant digits in the shortest
/// form, without exponent and without `-0`.
///
/// ```
/// use hodograph_paper::render::number::si;
/// assert_eq!([1.0, 0.58317491, -0.0, 1.5e-7, 123456789.0].map(si), ["1", "0.583175", "0", "0.00000015", "123457000"]);
/// ```
pub fn si(value: f64) -> String {
    let rounded: f64 = format!("{value:.*e}", SI_DIGITS - 1).parse().unwrap_or(value);
    (rounded + 0.0).to_string()
}

#[cfg(test)]
mod tests {
    use super::mm;

    #[test]
    fn shortest_form() {
        for (value, text) in [
            (0.1 + 0.2, "0.3"),
            (-0.0, "0"),
            (-0.0004, "0"),
            (30.000000000000004, "30"),
            (-12.3456, "-12.346"),
            (0.0005, "0.001"),
            (1e-9, "0"),
            (209.9999, "210"),
        ] {
            assert_eq!(mm(value), text, "{value}");
        }
    }
}
