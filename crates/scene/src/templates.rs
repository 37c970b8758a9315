//! Templates: complete scenes in the program, with parameters that can be set.

use super::front::TIME;
use super::{decode, expr};
use hodograph_base::diag::{Both, Diagnostic, Faults, Span, both};
use hodograph_base::json::fields::suggest;
use hodograph_base::json::{self, Node, NodeKind, Word};
use hodograph_templates::SCENES;

/// The description of a template, for lists.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneTemplate {
    /// Its name in commands, such as `crank-rocker`.
    pub name: &'static str,
    /// Its title.
    pub title: Both,
    /// Its parameters with their values as written, in the order of the file.
    pub parameters: Vec<(String, String)>,
}

/// Returns all templates, in order. A test checks the templates' files, so unreadable parts remain
/// empty here.
pub fn list() -> Vec<SceneTemplate> {
    SCENES
        .iter()
        .map(|(name, text)| {
            let mut faults = Faults::default();
            let title = match super::read(text) {
                Ok(scene) => scene.value.title,
                Err(_) => Both::default(),
            };
            let parameters = parameters(text, &mut faults)
                .into_iter()
                .filter(|p| p.unit.is_none())
                .map(|p| (p.name, p.old.text))
                .collect();
            SceneTemplate { name, title, parameters }
        })
        .collect()
}

/// Returns the text of a template.
///
/// # Errors
/// An unknown name; the diagnostic suggests the nearest one.
pub fn get(name: &str) -> Result<&'static str, Diagnostic> {
    SCENES.iter().find(|(n, _)| *n == name).map(|(_, text)| *text).ok_or_else(|| {
        let d = Diagnostic::error("unknown-template", both!("there is no template `{name}`"));
        d.help(suggest(name, SCENES.iter().map(|(n, _)| *n), both!("the templates are")))
    })
}

/// Returns the text of a template with other values for some of its parameters; all other bytes
/// remain unchanged.
///
/// A value is an expression as in the file (`120 mm`, `2*l_AB`); a bare number has the unit of the
/// value that it replaces.
///
/// # Errors
/// Unknown template, unknown parameters, values that are not expressions: all of them in one list.
/// Reading the text checks whether the values give a mechanism.
///
/// ```
/// use hodograph_scene::templates::instantiate;
/// let text = instantiate("crank-rocker", &[("l_AB", "80"), ("omega_1", "-2 rad/s")]).unwrap();
/// assert!(text.contains(r#""l_AB": "80 mm""#) && text.contains(r#""omega_1": "-2 rad/s""#));
/// ```
pub fn instantiate(name: &str, values: &[(&str, &str)]) -> Result<String, Faults> {
    with_parameters(get(name)?, values, both!("template `{name}`"))
}

/// Returns the text of a scene with other values for some of its parameters; `whose` begins a
/// sentence about it.
pub(super) fn with_parameters(
    text: &str,
    values: &[(&str, &str)],
    whose: Both,
) -> Result<String, Faults> {
    let mut faults = Faults::default();
    let known = parameters(text, &mut faults);
    let names: Vec<&str> = known.iter().map(|p| p.name.as_str()).collect();
    let mut edits: Vec<(Span, String)> = Vec::new();
    for (parameter, value) in values {
        let Some(i) = names.iter().position(|n| n == parameter) else {
            let d = Diagnostic::error(
                "unknown-parameter",
                both!("{} has no parameter `{parameter}`", whose),
            );
            faults.push(if names.is_empty() {
                d.help(both!(
                    "name values that are to be set: \"parameters\": {{\"{parameter}\": ...}}"
                ))
            } else {
                d.help(suggest(parameter, names.iter().copied(), both!("the parameters are")))
            });
            continue;
        };
        let Parameter { old, unit, .. } = &known[i];
        match replacement_in(parameter, &old.text, value, &names[..i], *unit) {
            Ok(new) if edits.iter().any(|(span, _)| *span == old.span) => {
                faults.push(Diagnostic::error(
                    "given-twice",
                    both!("parameter `{parameter}` is set twice, the second time to `{new}`"),
                ));
            }
            Ok(new) => edits.push((old.span, quoted(&new))),
            // The place would count in the value, which is in no file.
            Err(d) => faults.push(Diagnostic {
                span: None,
                message: both!("parameter `{parameter}`: {}", d.message),
                ..d
            }),
        }
    }
    if faults.has_errors() {
        return Err(faults);
    }
    // From the end, so that earlier places remain valid.
    edits.sort_by_key(|(span, _)| std::cmp::Reverse(span.start));
    let mut out = text.to_owned();
    for (span, new) in edits {
        out.replace_range(span.start..span.end, &new);
    }
    Ok(out)
}

/// Returns the new value; a bare number gets the unit of the old one.
pub fn replacement(
    parameter: &str,
    old: &str,
    new: &str,
    earlier: &[&str],
) -> Result<String, Diagnostic> {
    replacement_in(parameter, old, new, earlier, (parameter == TIME).then_some("s"))
}

/// Returns the new value; `usual` is the unit of a bare number if the old value has none.
fn replacement_in(
    parameter: &str,
    old: &str,
    new: &str,
    earlier: &[&str],
    usual: Option<&str>,
) -> Result<String, Diagnostic> {
    let new = new.trim();
    let is_number = |t: &str| expr::parse(t, &[]).is_ok_and(|e| expr::is_bare(&e));
    expr::parse(new, earlier)?;
    if !is_number(new) || is_number(old) {
        return Ok(new.to_owned());
    }
    let unit_at = old
        .find(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | '-' | '+')))
        .unwrap_or(old.len());
    let (number, unit) = (&old[..unit_at], old[unit_at..].trim());
    let candidate = format!("{new} {unit}");
    if is_number(number)
        && expr::parse(&candidate, earlier).is_ok()
        && new.bytes().all(|b| b.is_ascii_digit() || b".-+eE".contains(&b))
    {
        return Ok(candidate);
    }
    if let Some(unit) = usual {
        return Ok(format!("{new} {unit}"));
    }
    let d = Diagnostic::error(
        "no-unit",
        both!("`{new}` has no unit, and `{old}` does not tell which one is meant"),
    );
    Err(d.help(both!("write {parameter}=\"{new} mm\", or whichever unit it has")))
}

/// A parameter that can be set.
struct Parameter {
    name: String,
    /// The value as written, and its place.
    old: Word,
    /// The unit of a bare number if the value as written has none.
    unit: Option<&'static str>,
}

/// Returns the parameters of a scene, and `t`, the instant in the file, whose value may contain
/// them.
fn parameters(text: &str, faults: &mut Faults) -> Vec<Parameter> {
    let Ok((_, root)) = json::parse(text.as_bytes(), faults) else {
        return Vec::new();
    };
    let spanned = |node: &Node| match &node.kind {
        NodeKind::Text(text) | NodeKind::Number(text) => {
            Some(Word { text: text.clone(), span: node.span })
        }
        _ => None,
    };
    let of = |(key, node): &(Word, Node)| {
        Some(Parameter { name: key.text.clone(), old: spanned(node)?, unit: None })
    };
    let mut all: Vec<Parameter> =
        decode::members_of(&root, "parameters").iter().filter_map(of).collect();
    if let NodeKind::Object(members) = &root.kind
        && let Some(old) =
            members.iter().find(|(key, _)| key.text == "time").and_then(|(_, node)| spanned(node))
        && all.iter().all(|p| p.name != TIME)
    {
        all.push(Parameter { name: TIME.into(), old, unit: Some("s") });
    }
    all
}

fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        if matches!(c, '"' | '\\') {
            out.push('\\');
        }
        out.push(c);
    }
    out.push('"');
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_template_reads_without_a_remark() {
        for (name, text) in SCENES {
            match super::super::read(text) {
                Ok(scene) => assert_eq!(scene.notes, [], "{name}"),
                Err(faults) => panic!("templates/{name}.json: {faults}"),
            }
        }
    }

    #[test]
    fn the_instant_of_laws_is_set_like_a_parameter() {
        let text = get("plate-by-law").unwrap();
        let with = |value| super::super::edit::with_parameters(text, &[(TIME, value)]);
        assert!(with("0.5").unwrap().contains(r#""time": "0.5 s""#));
        assert!(with("2*t1").unwrap().contains(r#""time": "2*t1""#));
        assert!(with("1 min").unwrap().contains(r#""time": "1 min""#));
        // Without laws there is no instant.
        let faults =
            super::super::edit::with_parameters(get("crank-rocker").unwrap(), &[(TIME, "1 s")])
                .unwrap_err();
        assert_eq!(faults.list[0].code, "unknown-parameter");
    }

    #[test]
    fn values_are_replaced_in_place() {
        let text = get("crank-rocker").unwrap();
        assert_eq!(instantiate("crank-rocker", &[]).unwrap(), text);
        let new = instantiate(
            "crank-rocker",
            &[("l_BC", "2.5*l_AB"), ("phi_1", "-30"), ("l_AB", "0.08 m")],
        )
        .unwrap();
        let expected = text
            .replace("\"l_BC\": \"250 mm\"", "\"l_BC\": \"2.5*l_AB\"")
            .replace("\"phi_1\": \"60 deg\"", "\"phi_1\": \"-30 deg\"")
            .replace("\"l_AB\": \"100 mm\"", "\"l_AB\": \"0.08 m\"");
        assert_eq!(new, expected);
        let scene = super::super::read(&new).unwrap().value;
        assert_eq!(scene.parameters[1].1.value, 0.2);
    }

    #[test]
    fn faults_of_values_come_together() {
        let faults = instantiate(
            "crank-rocker",
            &[
                ("l_ab", "80"),
                ("phi_1", "30 degs"),
                ("l_AB", "l_BC"),
                ("omega_1", "1"),
                ("omega_1", "2"),
            ],
        )
        .unwrap_err();
        assert_eq!(
            faults.to_string(),
            "template `crank-rocker` has no parameter `l_ab` (did you mean `l_AB`?)\n\
             parameter `phi_1`: `degs` is not a unit (did you mean `deg`?)\n\
             parameter `l_AB`: `l_BC` is neither a parameter nor a unit (the units are m, cm, mm, km, in, ft, deg, °, rad, rev, s, min, h, kg, g, lb, slug, blob, N, kN, kgf, lbf, W, kW, rpm, r/min (\"parameters\" of the scene name values))\n\
             parameter `omega_1` is set twice, the second time to `2 rad/s`"
        );
        assert_eq!(
            get("crank-rokcer").unwrap_err().to_string(),
            "there is no template `crank-rokcer` (did you mean `crank-rocker`?)"
        );
    }
}
