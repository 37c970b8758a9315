//! Several readings of a statement whose figure is lost: the scene, and variants with some members
//! replaced.
//!
//! A reading is a merge patch (RFC 7396): members of objects are replaced one by one, other values
//! as a whole; `null` removes one. The program does not decide which reading is intended.

use hodograph_base::diag::{Diagnostic, Faults, both};
use serde_json::Value;

/// A reading: its name, and the text of its scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Reading {
    /// Its name; empty for the file itself.
    pub name: String,
    /// The text of the whole scene.
    pub text: String,
}

/// Returns the readings of a scene's text, the file itself first.
///
/// # Errors
/// Text that is not JSON. Reading the result checks whether it is a scene.
///
/// ```
/// let text = r#"{"points": {"A": [0, 0], "B": [1, 0]}, "readings": {"2": {"points": {"A": [1, 2]}}}}"#;
/// let all = hodograph_scene::readings::readings(text).unwrap();
/// assert_eq!(all[1].text, r#"{"points":{"A":[1,2],"B":[1,0]}}"#);
/// ```
pub fn readings(text: &str) -> Result<Vec<Reading>, Faults> {
    let mut scene: Value = serde_json::from_str(text.trim_start_matches('\u{feff}'))
        .map_err(|e| Diagnostic::error("json", both!("the scene cannot be read: {e}")))?;
    let patches = scene.as_object_mut().and_then(|o| o.shift_remove("readings"));
    let mut all = vec![Reading { name: String::new(), text: scene.to_string() }];
    for (name, patch) in patches.as_ref().and_then(Value::as_object).into_iter().flatten() {
        let mut other = scene.clone();
        merge(&mut other, patch);
        all.push(Reading { name: name.clone(), text: other.to_string() });
    }
    Ok(all)
}

/// Applies a patch (RFC 7396).
fn merge(target: &mut Value, patch: &Value) {
    let Some(members) = patch.as_object() else {
        *target = patch.clone();
        return;
    };
    if !target.is_object() {
        *target = Value::Object(serde_json::Map::new());
    }
    let Some(object) = target.as_object_mut() else { return };
    for (key, value) in members {
        if value.is_null() {
            object.shift_remove(key);
        } else {
            merge(object.entry(key.clone()).or_insert(Value::Null), value);
        }
    }
}
