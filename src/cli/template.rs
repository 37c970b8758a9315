//! `hodograph new` and `hodograph templates`.

use super::{CommandResult, Failure, files, values};
use crate::diag::{Diagnostic, both};
use crate::problem::{Kind, templates};
use hodograph_base::json::fields::suggest;
use std::process::ExitCode;

/// Writes a template.
pub fn new(template: Option<&str>, set: &[String], output: Option<&str>) -> CommandResult {
    let names: Vec<&str> = templates::all().iter().map(|t| t.name).collect();
    let all = |got: &str| suggest(got, names.iter().copied(), both!("the templates are"));
    let Some(template) = template else {
        let d = Diagnostic::error("no-template", both!("no template is named"));
        let help = both!("{}; `hodograph templates` tells what they are", all(""));
        return Err(Failure::argument("TEMPLATE", "", d.help(help)));
    };
    if !names.contains(&template) {
        let d = Diagnostic::error("unknown-template", both!("there is no template `{template}`"));
        return Err(Failure::argument("TEMPLATE", template, d.help(all(template))));
    }
    let text = values::with_values(set, |values| templates::text(template, values))?;
    match output {
        Some(path) => files::write(std::path::Path::new(path), text.as_bytes())?,
        None => {
            files::print(&text)?;
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// Lists the templates with their parameters.
pub fn list() -> CommandResult {
    let mut out = String::new();
    for t in templates::all() {
        let kind = match t.kind {
            Kind::Scene => "",
            Kind::Task => " (synthesis · 综合文件)",
            Kind::Motion => " (motion without a mechanism · 无机构的运动)",
            Kind::Equation => " (vector equation · 矢量方程)",
        };
        out.push_str(&format!("{}{kind}\n    {} · {}\n", t.name, t.title.en, t.title.zh));
        let parameters: Vec<String> =
            t.parameters.iter().map(|(n, v)| format!("{n}={v}")).collect();
        if !parameters.is_empty() {
            out.push_str(&format!("    {}\n", parameters.join("  ")));
        }
    }
    files::print(&out)
}
