//! Packs the numbers of many frames into few characters.
//!
//! A column of coordinates over the frames is nearly a polynomial: its third differences are a few
//! thousandths of a millimetre. `read.js` unpacks them on the page; the test in a browser compares
//! the two.

use base64::prelude::{BASE64_STANDARD, Engine};
use miniz_oxide::deflate::compress_to_vec;
use miniz_oxide::inflate::decompress_to_vec_with_limit;

/// Compression level of a page's data: the highest that takes no longer than drawing them.
const LEVEL: u8 = 8;

/// The data of a page, deflated (RFC 1951) and in base64; browsers can decode both.
pub fn pressed(text: &str) -> String {
    BASE64_STANDARD.encode(compress_to_vec(text.as_bytes(), LEVEL))
}

/// The data of a page (JSON) from its text, at most [`MOST_BYTES`]; `None` if the text is not a
/// lesson.
pub fn told(page: &str) -> Option<String> {
    let text = page.split("id=\"data\">").nth(1)?.split("</script>").next()?;
    let bytes =
        decompress_to_vec_with_limit(&BASE64_STANDARD.decode(text).ok()?, MOST_BYTES).ok()?;
    String::from_utf8(bytes).ok()
}

/// Upper limit of the data of a lesson; a larger file is not accepted as a lesson.
const MOST_BYTES: usize = 1 << 26;

/// The digits: printable characters that need no escape in JSON or HTML.
const DIGITS: &[u8; 88] =
    b"!#$%'()*+,-./0123456789:;=?@ABCDEFGHIJKLMNOPQRSTUVWXYZ[]^_`abcdefghijklmnopqrstuvwxyz{|}";
/// The last digit of a number comes from the first half, all digits before it from the second.
const HALF: u64 = 44;

/// The alphabet for the page.
pub fn alphabet() -> &'static str {
    std::str::from_utf8(DIGITS).expect("the digits are ASCII")
}

/// Mark instead of an order: the column equals an earlier one, whose number follows.
const SAME: u64 = 4;

/// Writes a column that equals an earlier one.
pub fn same(column: usize, out: &mut String) {
    number(SAME, out);
    number(column as u64, out);
}

/// Writes a column: the order of its differences, then the numbers.
pub fn column(values: &[i64], out: &mut String) {
    let best = (0..=3).map(|order| packed(values, order)).min_by_key(String::len);
    out.push_str(&best.unwrap_or_default());
}

/// The value predicted by the polynomial of this order through the last values.
fn foretold(values: &[i64], order: usize) -> i64 {
    match (order, values) {
        (0, _) | (_, []) => 0,
        (1, [.., a]) | (_, [a]) => *a,
        (2, [.., b, a]) | (_, [b, a]) => 2 * a - b,
        (_, [.., c, b, a]) => 3 * a - 3 * b + c,
    }
}

fn packed(values: &[i64], order: usize) -> String {
    let mut out = String::new();
    number(order as u64, &mut out);
    for k in 0..values.len() {
        let off = values[k] - foretold(&values[..k], order);
        // 0, −1, 1, −2, 2 …
        number(if off < 0 { 2 * off.unsigned_abs() - 1 } else { 2 * off as u64 }, &mut out);
    }
    out
}

/// Writes a natural number, lowest digits first.
pub fn number(mut n: u64, out: &mut String) {
    while n >= HALF {
        out.push(DIGITS[(HALF + n % HALF) as usize] as char);
        n /= HALF;
    }
    out.push(DIGITS[n as usize] as char);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unpacked(text: &str, count: usize) -> Vec<i64> {
        let mut digits = text.bytes().map(|b| DIGITS.iter().position(|d| *d == b).unwrap() as u64);
        let mut natural = || {
            let (mut n, mut power) = (0, 1);
            loop {
                let d = digits.next().unwrap();
                n += (d % HALF) * power;
                power *= HALF;
                if d < HALF {
                    return n;
                }
            }
        };
        let order = natural() as usize;
        let mut values: Vec<i64> = Vec::new();
        for _ in 0..count {
            let z = natural();
            let off = if z % 2 == 1 { -((z as i64 + 1) / 2) } else { z as i64 / 2 };
            values.push(foretold(&values, order) + off);
        }
        values
    }

    #[test]
    fn columns_come_back() {
        let wave: Vec<i64> =
            (0..72).map(|k| (30_000.0 * libm::sin(f64::from(k) * 0.0873)).round() as i64).collect();
        for values in [vec![], vec![5], vec![-3, 4_000_000, 0, 7], wave.clone()] {
            let mut text = String::new();
            column(&values, &mut text);
            assert_eq!(unpacked(&text, values.len()), values);
        }
        let mut text = String::new();
        column(&wave, &mut text);
        assert!(
            text.len() < 90,
            "a smooth column takes about one character a frame: {}",
            text.len()
        );
    }

    #[test]
    fn digits_need_no_escape() {
        assert!(DIGITS.iter().all(|d| d.is_ascii_graphic() && !b"\"\\<>&".contains(d)));
        let mut sorted = DIGITS.to_vec();
        sorted.dedup();
        assert_eq!(sorted.len(), DIGITS.len());
    }
}
