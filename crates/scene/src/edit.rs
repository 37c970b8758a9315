//! Small changes to a scene from outside its file: other questions, and quantities from a command
//! line.

use super::eval::{DimensionedValue, NoValue, evaluate};
use super::json::{self, NodeKind};
use super::model::Angle;
use super::units::{Dim, RequiredQuantity};
use super::{exact, expr};
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::number::Ball;

/// Returns the text of a scene with other questions; all other bytes remain unchanged.
///
/// # Errors
/// Text that is not a JSON object. Reading the text checks the questions.
///
/// ```
/// let text = r#"{"links": {}, "find": ["v_B"]}"#;
/// assert_eq!(hodograph_scene::edit::with_find(text, &["a_B", "x_B"]).unwrap(), r#"{"links": {}, "find": ["a_B","x_B"]}"#);
/// ```
pub fn with_find(text: &str, find: &[&str]) -> Result<String, Faults> {
    let mut faults = Faults::default();
    let (source, root) = json::parse(text.as_bytes(), &mut faults)?;
    let NodeKind::Object(members) = &root.kind else {
        return Err(Diagnostic::error("not-a-scene", both!("a scene is a JSON object"))
            .at(root.span)
            .into());
    };
    let list = serde_json::json!(find).to_string();
    let mut out = source.to_owned();
    match members.iter().find(|(key, _)| key.text == "find") {
        Some((_, node)) => out.replace_range(node.span.start..node.span.end, &list),
        None => out.insert_str(
            root.span.start + 1,
            &format!("\"find\": {list}{}", if members.is_empty() { "" } else { ", " }),
        ),
    }
    Ok(out)
}

/// Returns the text of a scene with other values for some of its parameters; all other bytes remain
/// unchanged. A value is an expression as in the file; a bare number has the unit of the value that
/// it replaces.
///
/// # Errors
/// Unknown parameters, values that are not expressions: all of them in one list.
///
/// ```
/// let text = r#"{"parameters": {"r": "100 mm", "s": "2*r"}}"#;
/// let new = hodograph_scene::edit::with_parameters(text, &[("r", "120")]).unwrap();
/// assert_eq!(new, r#"{"parameters": {"r": "120 mm", "s": "2*r"}}"#);
/// ```
pub fn with_parameters(text: &str, values: &[(&str, &str)]) -> Result<String, Faults> {
    super::templates::with_parameters(text, values, both!("the scene"))
}

/// Reads an angle as in a scene, such as `30 deg` or `pi/6`; a bare number is in degrees. If the
/// angle has more turns than an `f64` resolves, whole turns are subtracted from the written
/// expression.
///
/// # Errors
/// Text that is not an angle; places count in `text`.
///
/// ```
/// use hodograph_scene::{Angle, edit::angle};
/// assert_eq!(angle("90").unwrap(), Angle::Deg(90.0));
/// assert_eq!(angle("1 rad").unwrap(), Angle::Rad(1.0));
/// assert_eq!(angle("108000000000002550").unwrap(), Angle::Deg(30.0));
/// ```
pub fn angle(text: &str) -> Result<Angle, Faults> {
    Ok(angle_read(text)?.less_turns().angle())
}

/// Reads the two angles between which a driver turns: the same whole turns are subtracted from both
/// if an `f64` does not resolve them.
///
/// # Errors
/// As [`angle`].
///
/// ```
/// use hodograph_scene::{Angle, edit::angles};
/// let [from, to] = angles("108000000000002550", "108000000000002910").unwrap();
/// assert_eq!([from, to], [Angle::Deg(30.0), Angle::Deg(390.0)]);
/// ```
pub fn angles(from: &str, to: &str) -> Result<[Angle; 2], Faults> {
    let [first, last] = [angle_read(from)?, angle_read(to)?];
    if first.is_resolved() && last.is_resolved() {
        return Ok([first.value.angle(), last.value.angle()]);
    }
    let start = first.less_turns();
    let way = angle_read(&format!("({}) - ({})", last.text, first.text))?.value;
    // In the unit of the start.
    let way = if start.degrees { way.angle().degrees() } else { way.si() };
    Ok([start.angle(), DimensionedValue { number: start.number + way, ..start }.angle()])
}

/// A quantity with its full text.
struct ReadQuantity {
    text: String,
    value: DimensionedValue,
    /// Bound on the error of the value.
    off: f64,
}

impl ReadQuantity {
    /// Returns true if `f64` resolves the angle within its turn.
    fn is_resolved(&self) -> bool {
        exact::is_resolved(self.value.angle(), self.off)
    }

    /// Returns the angle, without whole turns if there are too many.
    fn less_turns(&self) -> DimensionedValue {
        let rest = if self.is_resolved() {
            None
        } else {
            exact::less_turns(&[], &self.text, self.value.degrees)
        };
        rest.map_or(self.value, |(number, _)| DimensionedValue { number, ..self.value })
    }
}

fn angle_read(text: &str) -> Result<ReadQuantity, Faults> {
    let read = quantity(text, "deg")?;
    if read.value.dim != Dim::ANGLE {
        return Err(wrong(text, both!("an angle"), read.value));
    }
    Ok(read)
}

/// Reads a length in metres; a bare number is in millimetres.
///
/// # Errors
/// Text that is not a length.
pub fn length(text: &str) -> Result<f64, Faults> {
    let value = quantity(text, "mm")?.value;
    if (value.dim.length, value.dim.time) != (1, 0) {
        return Err(wrong(text, both!("a length"), value));
    }
    Ok(value.si())
}

/// Reads an angular velocity in radians per second; a bare number is in radians per second.
///
/// # Errors
/// Text that is not an angular velocity.
pub fn turning(text: &str) -> Result<f64, Faults> {
    let value = quantity(text, "rad/s")?.value;
    if value.dim != RequiredQuantity::Omega.dim() {
        return Err(wrong(text, both!("an angular velocity"), value));
    }
    Ok(value.si())
}

/// Reads a time in seconds; a bare number is in seconds.
///
/// # Errors
/// Text that is not a time.
///
/// ```
/// use hodograph_scene::edit::time;
/// assert_eq!(time("1.5").unwrap(), 1.5);
/// assert_eq!(time("2 min").unwrap(), 120.0);
/// assert!(time("3 m").is_err());
/// ```
pub fn time(text: &str) -> Result<f64, Faults> {
    let value = quantity(text, "s")?.value;
    if value.dim != RequiredQuantity::Time.dim() {
        return Err(wrong(text, both!("a time"), value));
    }
    Ok(value.si())
}

fn wrong(text: &str, wanted: Both, value: DimensionedValue) -> Faults {
    Diagnostic::error(
        "dimension",
        both!("`{text}` is {}; {} is wanted", value.dim.describe(), wanted),
    )
    .into()
}

/// Reads a quantity without parameters; a bare number gets the unit.
fn quantity(text: &str, unit: &str) -> Result<ReadQuantity, Faults> {
    let parsed = expr::parse(text, &[])?;
    let bare = expr::is_bare(&parsed);
    let text = if bare { format!("({text}) {unit}") } else { text.to_owned() };
    let parsed = if bare { expr::parse(&text, &[])? } else { parsed };
    let value = evaluate(&parsed, &|_| None).map_err(|e| match e {
        NoValue::Fault(d) => d.into(),
        NoValue::Reported => Faults::default(),
    })?;
    let unknown = DimensionedValue {
        number: Ball::new(value.number, f64::INFINITY),
        dim: value.dim,
        degrees: value.degrees,
    };
    let (value, ball) =
        exact::settled(Vec::new, &text, value, evaluate(&parsed, &|_| None).unwrap_or(unknown));
    let off = exact::distance(&value, ball);
    Ok(ReadQuantity { text, value, off })
}
