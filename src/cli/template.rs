//! `hodograph new` and `hodograph templates`.

use super::{Failure, Run, files, values};
use crate::diag::{Diagnostic, both};
use crate::json::fields::suggest;
use crate::particle::templates as motions;
use crate::scene::{edit, templates};
use crate::synthesis::templates as wishes;
use std::process::ExitCode;

/// Names of all templates: scenes, synthesis files, motions.
fn names() -> Vec<&'static str> {
    templates::list().iter().map(|t| t.name).chain(wishes::names()).chain(motions::names()).collect()
}

/// Writes a template's scene.
pub fn new(template: Option<&str>, set: &[String], output: Option<&str>) -> Run {
    let names = names();
    let all = |got: &str| suggest(got, names.iter().copied(), both!("the templates are", "模板有"));
    let Some(template) = template else {
        let d = Diagnostic::error("no-template", both!("no template is named", "没有写出模板名"));
        let help = both!("{}; `hodograph templates` tells what they are", "{}；`hodograph templates` 列出其内容", all(""));
        return Err(Failure::argument("TEMPLATE", "", d.help(help)));
    };
    if !names.contains(&template) {
        let d = Diagnostic::error("unknown-template", both!("there is no template `{template}`", "没有模板 `{template}`"));
        return Err(Failure::argument("TEMPLATE", template, d.help(all(template))));
    }
    let text = match wishes::get(template).or_else(|| motions::get(template)) {
        Some(text) => values::with_values(set, |values| edit::with_parameters(text, values))?,
        None => values::with_values(set, |values| templates::instantiate(template, values))?,
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
