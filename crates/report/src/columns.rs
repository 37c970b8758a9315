//! Tables as plain text with aligned columns.

use unicode_width::UnicodeWidthStr;

/// Returns a line for each row; columns from `right` on are right-aligned.
pub(super) fn columns(rows: &[Vec<String>], right: usize) -> Vec<String> {
    let many = rows.iter().map(Vec::len).max().unwrap_or(0);
    let widths: Vec<usize> = (0..many)
        .map(|k| rows.iter().filter_map(|r| r.get(k)).map(|c| c.width()).max().unwrap_or(0))
        .collect();
    let cell = |(k, text): (usize, &String)| {
        let air = " ".repeat(widths[k].saturating_sub(text.width()));
        if k >= right { format!("{air}{text}") } else { format!("{text}{air}") }
    };
    rows.iter().map(|row| row.iter().enumerate().map(cell).collect::<Vec<_>>().join("  ")).collect()
}
