//! `hodograph new` and `hodograph templates`.

use super::{Failure, Run, files, values};
use crate::scene::templates;
use std::process::ExitCode;

/// Writes a template's scene.
pub fn new(template: &str, set: &[String], output: Option<&str>) -> Run {
    templates::get(template).map_err(|d| Failure::argument("TEMPLATE", template, d))?;
    let text = values::with_values(set, |values| templates::instantiate(template, values))?;
    match output {
        Some(path) => files::write(std::path::Path::new(path), text.as_bytes())?,
        None => {
            files::print(&text)?;
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// Lists the templates with their parameters.
pub fn list() -> Run {
    let mut out = String::new();
    for t in templates::list() {
        out.push_str(&format!("{}\n    {} · {}\n", t.name, t.title.en, t.title.zh));
        let parameters: Vec<String> = t.parameters.iter().map(|(n, v)| format!("{n}={v}")).collect();
        if !parameters.is_empty() {
            out.push_str(&format!("    {}\n", parameters.join("  ")));
        }
    }
    files::print(&out)
}
