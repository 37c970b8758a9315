//! Small changes to a scene from outside its file: other questions, and quantities that a command line gives.

use super::eval::{NoValue, Value, evaluate};
use super::expr;
use super::json::{self, Kind};
use super::model::Angle;
use super::units::Dim;
use crate::diag::{Diagnostic, Faults};

/// The text of a scene with other questions; everything else stays byte for byte.
///
/// # Errors
/// A text that is no JSON object. Whether the questions can be asked is seen when the text is read.
///
/// ```
/// let text = r#"{"links": {}, "find": ["v_B"]}"#;
/// assert_eq!(hodograph::scene::edit::with_find(text, &["a_B", "x_B"]).unwrap(), r#"{"links": {}, "find": ["a_B","x_B"]}"#);
/// ```
pub fn with_find(text: &str, find: &[&str]) -> Result<String, Faults> {
    let mut faults = Faults::default();
    let (source, root) = json::parse(text.as_bytes(), &mut faults)?;
    let Kind::Object(members) = &root.kind else {
        return Err(Diagnostic::error("not-a-scene", "a scene is a JSON object").at(root.span).into());
    };
    let list = serde_json::json!(find).to_string();
    let mut out = source.to_owned();
    match members.iter().find(|(key, _)| key.text == "find") {
        Some((_, node)) => out.replace_range(node.span.start..node.span.end, &list),
        None => out.insert_str(root.span.start + 1, &format!("\"find\": {list}{}", if members.is_empty() { "" } else { ", " })),
    }
    Ok(out)
}

/// The text of a scene with other values for some of its parameters; everything else stays byte for byte. A value is an expression
/// as in the file; a bare number takes the unit of the value that it replaces.
///
/// # Errors
/// Unknown parameters, values that are no expressions: all of them in one list.
///
/// ```
/// let text = r#"{"parameters": {"r": "100 mm", "s": "2*r"}}"#;
/// let new = hodograph::scene::edit::with_parameters(text, &[("r", "120")]).unwrap();
/// assert_eq!(new, r#"{"parameters": {"r": "120 mm", "s": "2*r"}}"#);
/// ```
pub fn with_parameters(text: &str, values: &[(&str, &str)]) -> Result<String, Faults> {
    super::templates::with_parameters(text, values, "the scene")
}

/// The text of a scene whose drivers all have a rate: that of a driver which says none is 0. For what does not depend on it.
///
/// # Errors
/// A text that is no JSON object.
///
/// ```
/// let text = r#"{"driver": {"link": "1", "angle": "30 deg"}}"#;
/// let new = hodograph::scene::edit::with_rates(text).unwrap();
/// assert_eq!(new, r#"{"driver": {"omega": 0, "link": "1", "angle": "30 deg"}}"#);
/// ```
pub fn with_rates(text: &str) -> Result<String, Faults> {
    let mut faults = Faults::default();
    let (source, root) = json::parse(text.as_bytes(), &mut faults)?;
    let Kind::Object(members) = &root.kind else {
        return Err(Diagnostic::error("not-a-scene", "a scene is a JSON object").at(root.span).into());
    };
    let drivers = members.iter().find(|(key, _)| key.text == "driver").map(|(_, node)| match &node.kind {
        Kind::Array(list) => list.as_slice(),
        _ => std::slice::from_ref(node),
    });
    let mut out = source.to_owned();
    // From the end, so that the earlier places stay true.
    for driver in drivers.unwrap_or_default().iter().rev() {
        let Kind::Object(members) = &driver.kind else { continue };
        let has = |key: &str| members.iter().any(|(k, _)| k.text == key);
        let kinds = [("link", "omega"), ("slide", "velocity"), ("cylinder", "rate")];
        if let Some((_, rate)) = kinds.into_iter().find(|(mark, rate)| has(mark) && !has(rate)) {
            out.insert_str(driver.span.start + 1, &format!("\"{rate}\": 0, "));
        }
    }
    Ok(out)
}

/// An angle as the scene would write it, such as `30 deg` or `pi/6`; a bare number counts degrees.
///
/// # Errors
/// What is no angle; places count in `text`.
///
/// ```
/// use hodograph::scene::{Angle, edit::angle};
/// assert_eq!(angle("90").unwrap(), Angle::Deg(90.0));
/// assert_eq!(angle("1 rad").unwrap(), Angle::Rad(1.0));
/// ```
pub fn angle(text: &str) -> Result<Angle, Faults> {
    let value = quantity(text, "deg")?;
    if value.dim != Dim::ANGLE {
        return Err(wrong(text, "an angle", value));
    }
    Ok(value.angle())
}

/// A length in metres; a bare number counts millimetres.
///
/// # Errors
/// What is no length.
pub fn length(text: &str) -> Result<f64, Faults> {
    let value = quantity(text, "mm")?;
    if (value.dim.length, value.dim.time) != (1, 0) {
        return Err(wrong(text, "a length", value));
    }
    Ok(value.si())
}

fn wrong(text: &str, wanted: &str, value: Value) -> Faults {
    Diagnostic::error("dimension", format!("`{text}` is {}; {wanted} is wanted", value.dim.describe())).into()
}

/// A quantity without parameters; a bare number gets the unit.
fn quantity(text: &str, unit: &str) -> Result<Value, Faults> {
    let parsed = expr::parse(text, &[])?;
    let parsed = if expr::is_bare(&parsed) { expr::parse(&format!("({text}) {unit}"), &[])? } else { parsed };
    evaluate(&parsed, &|_| None).map_err(|e| match e {
        NoValue::Fault(d) => d.into(),
        NoValue::Reported => Faults::default(),
    })
}
