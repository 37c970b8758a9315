//! Tables with commas (RFC 4180), each cell with its place in the text, so that a fault is shown
//! where it is; semicolons and tabs as spreadsheets of some countries write them.

use crate::diag::{Diagnostic, Faults, Span, both};

/// A cell and its place in the text.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct TableCell {
    /// Its text, without the spaces around it.
    pub text: String,
    /// Its bytes in the table's text.
    pub at: Span,
}

/// Largest number of rows of a table.
const MOST_ROWS: usize = 200_000;

/// Returns the rows of a table; empty ones are left out.
///
/// # Errors
/// `table` for a quotation mark that is not closed, or more rows than a class can write.
pub(super) fn rows(text: &str) -> Result<Vec<Vec<TableCell>>, Faults> {
    let start = if text.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
    let head = text[start..].lines().next().unwrap_or_default();
    let separator = [b',', b';', b'\t']
        .into_iter()
        .max_by_key(|s| (head.bytes().filter(|b| b == s).count(), *s == b','))
        .unwrap_or(b',');
    let bytes = text.as_bytes();
    let (mut all, mut row, mut at) = (Vec::new(), Vec::new(), start);
    while at < bytes.len() {
        let (cell, end) = cell(text, at, separator)?;
        row.push(cell);
        at = end;
        match bytes.get(at) {
            Some(b) if *b == separator => {
                at += 1;
                if at == bytes.len() {
                    row.push(TableCell { text: String::new(), at: Span::new(at, at) });
                }
                if at < bytes.len() {
                    continue;
                }
            }
            Some(_) => at += if bytes[at..].starts_with(b"\r\n") { 2 } else { 1 },
            None => {}
        }
        let done = std::mem::take(&mut row);
        if done.iter().any(|c| !c.text.is_empty()) {
            all.push(done);
        }
        if all.len() > MOST_ROWS {
            let message = both!("the table has more than {MOST_ROWS} rows");
            return Err(Diagnostic::error("table", message).into());
        }
    }
    Ok(all)
}

/// Reads the cell that begins at a byte; returns it with the byte after it.
fn cell(text: &str, from: usize, separator: u8) -> Result<(TableCell, usize), Faults> {
    let bytes = text.as_bytes();
    let ends = |b: u8| b == separator || b == b'\n' || b == b'\r';
    if bytes.get(from) != Some(&b'"') {
        let end = bytes[from..].iter().position(|b| ends(*b)).map_or(bytes.len(), |n| from + n);
        let (whole, trimmed) = (&text[from..end], text[from..end].trim());
        let start = from + whole.find(trimmed).unwrap_or_default();
        let at = Span::new(start, start + trimmed.len());
        return Ok((TableCell { text: trimmed.to_owned(), at }, end));
    }
    let (mut out, mut at) = (String::new(), from + 1);
    loop {
        let Some(n) = bytes[at..].iter().position(|b| *b == b'"') else {
            let d = Diagnostic::error("table", both!("the quotation mark is not closed"));
            return Err(d.at(Span::new(from, from + 1)).into());
        };
        out += &text[at..at + n];
        at += n + 1;
        if bytes.get(at) != Some(&b'"') {
            break;
        }
        out.push('"');
        at += 1;
    }
    // Text between the mark and the next cell is ignored, as in spreadsheets.
    let end = bytes[at..].iter().position(|b| ends(*b)).map_or(bytes.len(), |n| at + n);
    Ok((TableCell { text: out.trim().to_owned(), at: Span::new(from, end) }, end))
}

/// Returns a cell as it is written: in quotation marks where needed.
pub(super) fn written(text: &str) -> String {
    if text.contains([',', ';', '\t', '"', '\n', '\r']) || text.trim() != text {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

/// Returns a row as it is written.
pub(super) fn line<T: AsRef<str>>(cells: &[T]) -> String {
    let cells: Vec<String> = cells.iter().map(|c| written(c.as_ref())).collect();
    format!("{}\n", cells.join(","))
}

/// Returns the names of a roster: the column `name` or `student`, or the first one of a table
/// without such a head.
///
/// # Errors
/// `table`; `roster` for a name that is given twice, or a table without names.
pub fn names(text: &str) -> Result<Vec<String>, Faults> {
    let all = rows(text)?;
    let is_head = |c: &TableCell| {
        ["name", "student", "姓名", "学生"].contains(&c.text.to_lowercase().as_str())
    };
    let column = all.first().and_then(|head| head.iter().position(is_head));
    let begin = usize::from(column.is_some());
    let (mut names, mut faults) = (Vec::<String>::new(), Faults::default());
    for cell in all.iter().skip(begin).filter_map(|row| row.get(column.unwrap_or(0))) {
        if cell.text.is_empty() {
            continue;
        }
        if names.contains(&cell.text) {
            let message = both!("`{}` is listed twice", cell.text);
            faults.push(
                Diagnostic::error("roster", message)
                    .at(cell.at)
                    .help(both!("add a number or a class to one of the names")),
            );
        }
        names.push(cell.text.clone());
    }
    if names.is_empty() && !faults.has_errors() {
        let message = both!("the roster has no names");
        faults
            .push(Diagnostic::error("roster", message).help(both!("write one name in each line")));
    }
    if faults.has_errors() { Err(faults) } else { Ok(names) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_have_their_places() {
        let text = "\u{feff}a, b ,\"c \"\"x\"\", d\"\r\n\r\n1;2,3,\n";
        let all = rows(text).unwrap();
        let texts: Vec<Vec<&str>> =
            all.iter().map(|r| r.iter().map(|c| c.text.as_str()).collect()).collect();
        assert_eq!(texts, [vec!["a", "b", "c \"x\", d"], vec!["1;2", "3", ""]]);
        let b = &all[0][1];
        assert_eq!(&text[b.at.start..b.at.end], "b");
        assert_eq!(rows("x;y\n1,5;2").unwrap()[1][0].text, "1,5");
        assert!(rows("a,\"b").is_err());
        assert_eq!(line(&["a,b", "\"", "c"]), "\"a,b\",\"\"\"\",c\n");
    }

    #[test]
    fn rosters_have_a_head_or_none() {
        assert_eq!(names("number,name\n1,Ada\n2,Li Lei\n").unwrap(), ["Ada", "Li Lei"]);
        assert_eq!(names("Ada\nLi Lei\n").unwrap(), ["Ada", "Li Lei"]);
        assert!(names("Ada\nAda\n").is_err() && names("\n").is_err());
    }
}
