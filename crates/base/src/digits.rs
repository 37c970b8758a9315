//! Formatting of numbers with units, shared by diagnostics, text answers and figures.

/// Returns a length for a diagnostic: millimetres with four significant digits, or metres from 10 m
/// on.
pub fn metres(value_m: f64) -> String {
    if value_m.abs() >= 10.0 {
        format!("{} m", significant(value_m, 4))
    } else {
        format!("{} mm", significant(value_m * 1e3, 4))
    }
}

/// Returns a number with `digits` significant digits, without an exponent between 1e-4 and 1e6.
///
/// Zero is `0`. Trailing zeros are kept, since they are significant. An infinite value is `∞`, an
/// undefined value `—`.
pub fn significant(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return unbounded(value).into();
    }
    plain(&format!("{:.*e}", digits.max(1) - 1, value))
}

/// Returns the text for a number that is not finite.
fn unbounded(value: f64) -> &'static str {
    match value {
        _ if value.is_nan() => "—",
        _ if value > 0.0 => "∞",
        _ => "-∞",
    }
}

/// Returns a number for people: [`significant`] with the sign of [`minus`].
pub fn legible(value: f64, digits: usize) -> String {
    minus(&significant(value, digits))
}

/// Returns a plain number with a minus sign as long as a plus sign: `−2.5`. An exponent keeps its
/// hyphen. Scene files may contain either sign.
pub fn minus(text: &str) -> String {
    text.strip_prefix('-').map_or_else(|| text.to_owned(), |rest| format!("−{rest}"))
}

/// Converts a number from e notation: without an exponent between 1e-4 and 1e6, its digits kept.
pub fn plain(scientific: &str) -> String {
    let Some((mantissa, exponent)) = scientific.split_once('e') else { return scientific.into() };
    if mantissa.bytes().all(|b| matches!(b, b'0' | b'.' | b'-')) {
        return "0".into();
    }
    let e: i32 = exponent.parse().unwrap_or(0);
    if !(-4..6).contains(&e) {
        return format!("{mantissa}e{e}");
    }
    // The digits are already rounded: only the decimal point moves.
    let negative = mantissa.starts_with('-');
    let ciphers: String = mantissa.chars().filter(char::is_ascii_digit).collect();
    let decimals = (ciphers.len() as i32 - 1 - e).max(0);
    let plain = if e < 0 {
        format!("0.{}{}", "0".repeat((-e - 1) as usize), ciphers)
    } else {
        let whole = e as usize + 1;
        let padded = format!("{ciphers:0<whole$}");
        if decimals == 0 {
            padded[..whole].to_string()
        } else {
            format!("{}.{}", &padded[..whole], &padded[whole..])
        }
    };
    if negative { format!("-{plain}") } else { plain }
}

/// Returns a plain number in the label language: `1.5e9` as `1.5 \times 10^{9}`, with a minus sign
/// as long as a plus sign.
pub fn inked(text: &str) -> String {
    let text = match text.split_once('e') {
        // The power ends with a brace, and the unit after it begins with a space.
        Some((mantissa, exponent)) => format!("{mantissa} \\times 10^{{{exponent}}}"),
        None => text.to_owned(),
    };
    text.replace('-', "−")
}

/// Returns the direction of a vector in degrees, in (−180, 180].
///
/// A direction within rounding of the x axis is set to 0 or 180: the sign of a last bit has no
/// meaning.
pub fn direction_degrees(angle_rad: f64) -> f64 {
    const ROUNDING: f64 = 1e-10;
    let degrees = angle_rad.to_degrees();
    if degrees.abs() < ROUNDING {
        0.0
    } else if 180.0 - degrees.abs() < ROUNDING {
        180.0
    } else {
        degrees
    }
}

/// Returns the direction of a line in degrees, in [0, 180): both senses of a line are equal, as
/// both its ends are one point at infinity.
pub fn line_degrees(angle_rad: f64) -> f64 {
    let degrees = direction_degrees(angle_rad).rem_euclid(180.0);
    // A value below zero by less than half a unit in the last place of 180 is rounded up to 180.
    if degrees >= 180.0 { 0.0 } else { degrees }
}

/// Returns the shortest form of a number, for scales and given values: `0.002`, `60`, `2.5`.
pub fn shortest(value: f64) -> String {
    if !value.is_finite() {
        return unbounded(value).into();
    }
    let rounded: f64 = format!("{value:.12e}").parse().expect("a formatted float parses");
    let rounded = rounded + 0.0;
    if rounded != 0.0 && !(1e-4..1e7).contains(&rounded.abs()) {
        format!("{rounded:e}")
    } else {
        format!("{rounded}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn significant_digits() {
        assert_eq!(significant(12.3456, 4), "12.35");
        assert_eq!(significant(-0.00123456, 3), "-0.00123");
        assert_eq!(significant(99.996, 4), "100.0");
        assert_eq!(significant(123456.0, 4), "123500");
        assert_eq!(significant(1.5e9, 4), "1.500e9");
        assert_eq!(significant(0.0, 4), "0");
        assert_eq!(
            [f64::INFINITY, -f64::INFINITY, f64::NAN].map(|x| significant(x, 4)),
            ["∞", "-∞", "—"]
        );
        assert_eq!(shortest(f64::INFINITY), "∞");
    }

    #[test]
    fn numbers_for_people_have_a_long_minus_sign() {
        assert_eq!([-12.3456, -1.5e-9, 2.0].map(|x| legible(x, 3)), ["−12.3", "−1.50e-9", "2.00"]);
        assert_eq!(legible(-f64::INFINITY, 3), "−∞");
    }

    #[test]
    fn shortest_numbers() {
        assert_eq!(shortest(0.1 + 0.2), "0.3");
        assert_eq!(shortest(-0.0), "0");
        assert_eq!(shortest(2e-6), "2e-6");
    }
}
