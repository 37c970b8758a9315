//! The layout of a scene file, in the form that a person writes. This module does not interpret
//! values.

use serde_json::Value;

/// Longest line: the width of a printed listing.
const WIDTH: usize = 110;

/// Returns the text of a JSON value. A value that fits is on one line; of a longer value each entry
/// is on its own line, indented by two columns. Only white space depends on the layout.
///
/// ```
/// use hodograph_scene::write;
/// let text = write(&serde_json::json!({"links": {"1": ["A", "B"]}, "ground": "2"}));
/// assert_eq!(text, "{\"links\": {\"1\": [\"A\", \"B\"]}, \"ground\": \"2\"}\n");
/// ```
pub fn write(value: &Value) -> String {
    let mut out = String::new();
    laid_out(value, 0, 0, &mut out);
    out.push('\n');
    out
}

/// Writes a value at an indentation, after `before` columns of its line.
fn laid_out(value: &Value, indent: usize, before: usize, out: &mut String) {
    let line = in_line(value);
    let entries: Vec<(Option<&String>, &Value)> = match value {
        Value::Object(members) => members.iter().map(|(k, v)| (Some(k), v)).collect(),
        Value::Array(list) => list.iter().map(|v| (None, v)).collect(),
        Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => Vec::new(),
    };
    if entries.is_empty() || before + line.chars().count() <= WIDTH {
        out.push_str(&line);
        return;
    }
    let [open, close] = if value.is_object() { ['{', '}'] } else { ['[', ']'] };
    out.push(open);
    for (i, (key, inner)) in entries.iter().enumerate() {
        out.push_str(if i == 0 { "\n" } else { ",\n" });
        let begin = key.map(|k| format!("{}: ", Value::String(k.to_string()))).unwrap_or_default();
        out.extend(std::iter::repeat_n(' ', indent + 2));
        out.push_str(&begin);
        // One column is for the comma.
        laid_out(inner, indent + 2, indent + 3 + begin.chars().count(), out);
    }
    out.push('\n');
    out.extend(std::iter::repeat_n(' ', indent));
    out.push(close);
}

fn in_line(value: &Value) -> String {
    match value {
        Value::Object(members) => {
            let entries = members
                .iter()
                .map(|(k, v)| format!("{}: {}", Value::String(k.clone()), in_line(v)));
            format!("{{{}}}", entries.collect::<Vec<_>>().join(", "))
        }
        Value::Array(list) => {
            format!("[{}]", list.iter().map(in_line).collect::<Vec<_>>().join(", "))
        }
        Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => value.to_string(),
    }
}
