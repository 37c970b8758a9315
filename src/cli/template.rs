//! `hodograph new` and `hodograph templates`.

use super::{Failure, Run, files, values};
use crate::particle::templates as motions;
use crate::scene::{edit, templates};
use crate::synthesis::templates as wishes;
use std::process::ExitCode;

/// Writes a template's scene.
pub fn new(template: &str, set: &[String], output: Option<&str>) -> Run {
    let text = match wishes::get(template).or_else(|| motions::get(template)) {
        Some(text) => values::with_values(set, |values| edit::with_parameters(text, values))?,
        None => {
            templates::get(template).map_err(|d| Failure::argument("TEMPLATE", template, d))?;
            values::with_values(set, |values| templates::instantiate(template, values))?
        }
    };
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
    // Synthesis files come after the scenes.
    for name in wishes::names() {
        let title = wishes::title(name);
        out.push_str(&format!("{name} (synthesis · 综合文件)\n    {} · {}\n", title.en, title.zh));
    }
    for name in motions::names() {
        let title = motions::title(name);
        out.push_str(&format!("{name} (motion without a mechanism · 无机构的运动)\n    {} · {}\n", title.en, title.zh));
    }
    files::print(&out)
}
