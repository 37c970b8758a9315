//! `hodograph explain`: cause and cure of each diagnostic code.
//!
//! The explanations stand in the text files of the folder `explain`. A group begins with
//! `== English | Chinese`; an explanation is `[code]`, title, cause (`- `) and cure (`+ `) in
//! English, the three in Chinese, and perhaps an example (`> `). `tests/tidy` compares them with
//! the codes of the sources, and docs/errors.md is made of them.

use super::{CommandResult, Failure, files, lang};
use crate::diag::{Both, Diagnostic, both};
use crate::scene::Lang;
use clap::Args as ClapArgs;
use hodograph_base::json::fields::nearest;
use hodograph_base::lang::say;
use serde_json::{Value, json};

/// The arguments of the command.
#[derive(ClapArgs, Debug)]
#[command(after_help = "All of them as a page: docs/errors.md")]
pub struct ExplainArgs {
    /// The code in the first line of a message, such as dead-centre (default: the list of all
    /// codes)
    #[arg(value_name = "CODE")]
    pub code: Option<String>,
    /// Print JSON, in both languages
    #[arg(long)]
    pub json: bool,
}

/// The files, in the order of the page.
const FILES: [&str; 4] = [
    include_str!("explain/program.txt"),
    include_str!("explain/mechanism.txt"),
    include_str!("explain/pose.txt"),
    include_str!("explain/methods.txt"),
];

/// A code with its explanation.
struct CodeExplanation {
    group: Both,
    code: &'static str,
    title: Both,
    cause: Both,
    cure: Both,
    example: Option<&'static str>,
}

/// Runs the command.
pub fn run(a: ExplainArgs) -> CommandResult {
    let all = entries();
    let Some(code) = &a.code else {
        let list = || json!({"schema": "hodograph/explain/1", "codes": all.iter().map(CodeExplanation::json).collect::<Vec<_>>()});
        return files::print(&if a.json { format!("{:#}\n", list()) } else { listed(&all) });
    };
    match all.iter().find(|e| e.code == code) {
        Some(entry) if a.json => files::print(&format!("{:#}\n", entry.json())),
        Some(entry) => files::print(&entry.text(lang::now())),
        None => Err(Failure::argument("CODE", code, unknown(code, &all))),
    }
}

fn unknown(code: &str, all: &[CodeExplanation]) -> Diagnostic {
    let help = nearest(code, all.iter().map(|e| e.code));
    let help = help.unwrap_or_else(|| both!("`hodograph explain` lists all codes"));
    Diagnostic::error("unknown-code", both!("no diagnostic has the code `{code}`")).help(help)
}

/// All explanations.
fn entries() -> Vec<CodeExplanation> {
    let mut all: Vec<CodeExplanation> = Vec::new();
    let mut group = Both::default();
    let mut lines = FILES.iter().flat_map(|text| text.lines()).peekable();
    while let Some(line) = lines.next() {
        if let Some((en, zh)) =
            line.strip_prefix("== ").and_then(|heading| heading.split_once(" | "))
        {
            group = Both { en: en.to_owned(), zh: zh.to_owned() };
        }
        let Some(code) = line.strip_prefix('[').and_then(|l| l.strip_suffix(']')) else { continue };
        let mut part = |mark: &str| {
            lines.next().and_then(|l| l.strip_prefix(mark)).unwrap_or_default().to_owned()
        };
        let [title, cause, cure, zh_title, zh_cause, zh_cure] =
            ["", "- ", "+ ", "", "- ", "+ "].map(&mut part);
        let both = |en, zh| Both { en, zh };
        let example = lines.next_if(|l| l.starts_with("> ")).map(|l| &l[2..]);
        let [title, cause, cure] =
            [both(title, zh_title), both(cause, zh_cause), both(cure, zh_cure)];
        all.push(CodeExplanation { group: group.clone(), code, title, cause, cure, example });
    }
    all
}

/// All codes with their titles.
fn listed(all: &[CodeExplanation]) -> String {
    let lang = lang::now();
    let widest = all.iter().map(|e| e.code.len()).max().unwrap_or(0);
    let mut out = String::new();
    let mut group = None;
    for e in all {
        if group != Some(&e.group) {
            out += &format!("{}{}\n", if group.is_some() { "\n" } else { "" }, lang.of(&e.group));
            group = Some(&e.group);
        }
        out += &format!("  {:widest$}  {}\n", e.code, lang.of(&e.title));
    }
    out
}

impl CodeExplanation {
    fn text(&self, lang: Lang) -> String {
        let [title, cause, cure] = [&self.title, &self.cause, &self.cure].map(|text| lang.of(text));
        let example = self
            .example
            .map_or_else(String::new, |e| lang.of(&both!("Example: {}\n", e)).to_owned());
        say!(lang, "{}: {title}\n\nCause: {cause}\nCure: {cure}\n{example}", self.code)
    }

    fn json(&self) -> Value {
        json!({
            "code": self.code,
            "group": self.group.json(),
            "title": self.title.json(),
            "cause": self.cause.json(),
            "cure": self.cure.json(),
            "example": self.example,
        })
    }
}
