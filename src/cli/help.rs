//! Help and the faults of arguments in Chinese: the catalogue `po/help.zh.po` translates the English
//! of `args`.
//!
//! The printer of the help knows only English headings; they are translated in its output.

use super::args::Args;
use super::files::FileRefusal;
use crate::diag::{Both, Diagnostic};
use crate::figure::cycle::CycleForm;
use crate::figure::list::LIST;
use crate::figure::stepped::METHODS;
use crate::scene::Lang;
use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Arg, Command, CommandFactory};
use std::collections::BTreeMap;
use std::ffi::OsString;

/// The Chinese texts, by the English ones.
const CATALOGUE: &str = include_str!("../../po/help.zh.po");

/// Texts that the printer of the help writes itself, and the choices of an argument; those of
/// figures, methods and forms come from their lists.
const PRINTED: [&str; 11] = [
    "Usage:",
    "Commands:",
    "Arguments:",
    "Options:",
    "Possible values:",
    "[default: ",
    "[possible values: ",
    "Velocities",
    "Accelerations",
    "Outlines",
    "Text, for drawing programs",
];

/// Returns the texts of the catalogue: English, Chinese.
fn texts() -> BTreeMap<String, String> {
    let (mut all, mut english) = (BTreeMap::new(), String::new());
    for line in CATALOGUE.lines() {
        let text = |word: &str| serde_json::from_str::<String>(line.strip_prefix(word)?).ok();
        if let Some(text) = text("msgid ") {
            english = text;
        } else if let Some(text) = text("msgstr ") {
            all.insert(std::mem::take(&mut english), text);
        }
    }
    // The header.
    all.remove("");
    all
}

/// Returns the value of a global option such as `--lang`, before the arguments are parsed.
pub fn given<T>(
    arguments: &[OsString],
    option: &str,
    named: impl Fn(&str) -> Option<T>,
) -> Option<T> {
    let words: Vec<&str> =
        arguments.iter().skip(1).filter_map(|a| a.to_str()).take_while(|a| *a != "--").collect();
    let apart = words.windows(2).filter(|w| w[0] == option).filter_map(|w| named(w[1]));
    let together = words.iter().filter_map(|w| named(w.strip_prefix(option)?.strip_prefix('=')?));
    apart.chain(together).next()
}

/// Returns a fault of the arguments as a diagnostic: its first sentence, and the usage as advice.
pub fn diagnostic(e: &clap::Error) -> Diagnostic {
    let parts = |text: String, mark: &str| {
        let (said, rest) = text.split_once("\n\n").unwrap_or((&text, ""));
        let line = |part: &str| part.split_whitespace().collect::<Vec<_>>().join(" ");
        (line(said.strip_prefix(mark).unwrap_or(said)), line(rest))
    };
    let (en, zh) = (parts(e.render().to_string(), "error: "), parts(usage(e), "错误："));
    Diagnostic::error("usage", Both { en: en.0, zh: zh.0 }).help(Both { en: en.1, zh: zh.1 })
}

/// Returns the language of the help if the arguments choose none: that of the system.
pub fn of_the_machine() -> Lang {
    // The variables in the order of their priority; an empty one is ignored.
    let set = ["LC_ALL", "LC_MESSAGES", "LANG"]
        .into_iter()
        .filter_map(std::env::var_os)
        .find(|v| !v.is_empty());
    match set {
        Some(name) if name.to_str().is_some_and(|n| n.starts_with("zh")) => Lang::Zh,
        _ => Lang::En,
    }
}

/// Returns the program's arguments with their help in a language.
pub fn command(lang: Lang) -> Command {
    let command = Args::command();
    match lang {
        Lang::En => command,
        Lang::Zh => chinese(command),
    }
}

fn chinese(mut command: Command) -> Command {
    command.build();
    let texts = texts();
    let names: Vec<String> = command.get_subcommands().map(|c| c.get_name().to_owned()).collect();
    let mut command = translated(command, &texts);
    for name in names {
        command = command.mut_subcommand(&name, |c| translated(c, &texts));
    }
    // Chinese has no spaces at which the printer could break a line: the terminal breaks it.
    command.term_width(0)
}

/// Translates one command and its arguments.
fn translated(mut command: Command, texts: &BTreeMap<String, String>) -> Command {
    let of = |english: Option<&StyledStr>| texts.get(&english?.to_string());
    if let Some(about) = of(command.get_about()) {
        command = command.about(about).long_about(about);
    }
    if let Some(after) = of(command.get_after_help()) {
        command = command.after_help(after);
    }
    command.mut_args(|arg: Arg| match of(arg.get_help()) {
        Some(help) => arg.help(help).long_help(help),
        None => arg,
    })
}

/// Translates the headings and the names of choices of a printed help into Chinese.
fn headings(text: &str) -> String {
    let figures = LIST.iter().map(|e| (e.about[0], e.about[1]));
    let methods = METHODS.iter().map(|e| (e.about[0], e.about[1]));
    let forms = CycleForm::ALL.into_iter().map(|f| (f.about()[0], f.about()[1]));
    let texts = texts();
    let printed = PRINTED.iter().filter_map(|en| Some((*en, texts.get(*en)?.as_str())));
    printed
        .chain(figures)
        .chain(methods)
        .chain(forms)
        .fold(text.to_owned(), |text, (en, zh)| text.replace(en, zh))
}

/// Returns the faults of the arguments, or the requested help, in Chinese.
pub fn usage(e: &clap::Error) -> String {
    let value = |kind| e.get(kind).map(|v: &ContextValue| v.to_string()).unwrap_or_default();
    let (argument, given) = (value(ContextKind::InvalidArg), value(ContextKind::InvalidValue));
    let near = |kind| e.get(kind).map_or(String::new(), |v| format!("\n  是否想写 '{v}'？"));
    let said = match e.kind() {
        ErrorKind::InvalidValue if given.is_empty() => format!("参数 '{argument}' 缺少值"),
        ErrorKind::InvalidValue => {
            let choices = e
                .get(ContextKind::ValidValue)
                .map_or(String::new(), |v| format!("\n  可选值：{v}"));
            format!(
                "参数 '{argument}' 的值 '{given}' 无效{choices}{}",
                near(ContextKind::SuggestedValue)
            )
        }
        ErrorKind::ValueValidation => {
            format!("参数 '{argument}' 的值 '{given}' 无效：{}", refused(e))
        }
        ErrorKind::UnknownArgument => {
            format!("没有参数 '{argument}'{}", near(ContextKind::SuggestedArg))
        }
        ErrorKind::InvalidSubcommand => {
            format!(
                "没有命令 '{}'{}",
                value(ContextKind::InvalidSubcommand),
                near(ContextKind::SuggestedSubcommand)
            )
        }
        ErrorKind::MissingRequiredArgument => format!("缺少参数：{argument}"),
        ErrorKind::MissingSubcommand => "缺少命令".to_owned(),
        ErrorKind::ArgumentConflict => {
            format!("参数 '{argument}' 与 '{}' 不能同用", value(ContextKind::PriorArg))
        }
        ErrorKind::NoEquals
        | ErrorKind::TooManyValues
        | ErrorKind::TooFewValues
        | ErrorKind::WrongNumberOfValues => {
            format!("参数 '{argument}' 的值的个数不对")
        }
        ErrorKind::InvalidUtf8 => "参数不是 UTF-8 文字".to_owned(),
        _ => return headings(&e.render().to_string()),
    };
    let usage = e.get(ContextKind::Usage).map_or(String::new(), |u| format!("\n\n{u}"));
    headings(&format!("错误：{said}{usage}\n\n详细说明请用 '--help'。\n"))
}

/// Returns the reason for which the library refuses a value.
fn refused(e: &clap::Error) -> String {
    let source = std::error::Error::source(e);
    if let Some(FileRefusal(words)) = source.and_then(|s| s.downcast_ref()) {
        return words.zh.clone();
    }
    let why = source.map(ToString::to_string).unwrap_or_default();
    match why.split_once(" is not in ") {
        Some((number, range)) => format!("{number} 不在 {range} 之内"),
        None if why.contains("digit") => "不是整数".to_owned(),
        None => why,
    }
}

/// Returns the help, or the faults of the arguments, in the language of the help.
pub fn said(e: &clap::Error, lang: Lang) -> String {
    match lang {
        Lang::En => e.render().to_string(),
        Lang::Zh => usage(e),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    fn is_chinese(text: &str) -> bool {
        text.chars().any(|c| ('\u{4e00}'..='\u{9fff}').contains(&c))
    }

    /// The help texts of a command and its arguments.
    fn own(command: &Command) -> Vec<String> {
        let of_command = [command.get_about(), command.get_after_help()].into_iter().flatten();
        let of_arguments = command.get_arguments().filter_map(Arg::get_help);
        of_command.chain(of_arguments).map(ToString::to_string).collect()
    }

    #[test]
    fn every_command_and_argument_is_told_in_chinese() {
        let mut command = command(Lang::Zh);
        // Skips the list of commands, which `help` repeats.
        for c in command.get_subcommands_mut().filter(|c| c.get_name() != "help") {
            let text = headings(&c.render_long_help().to_string());
            // Only names remain in Latin letters: no two lower-case words follow one another.
            let english = text.lines().find(|l| {
                let small = |w: &str| w.len() > 1 && w.chars().all(|c| c.is_ascii_lowercase());
                let words: Vec<&str> = l.split(' ').collect();
                words.windows(3).any(|w| w.iter().all(|w| small(w)))
            });
            assert_eq!(english, None, "{}:\n{text}", c.get_name());
        }
    }

    /// The catalogue has the text of each command and argument, nothing else, and is sorted.
    #[test]
    fn the_catalogue_has_the_texts_of_the_help() {
        let mut command = command(Lang::En);
        command.build();
        let all = std::iter::once(&command).chain(command.get_subcommands());
        let texts = texts();
        let mut used: BTreeSet<String> = PRINTED.map(str::to_owned).into();
        used.extend(all.flat_map(own));
        for english in &used {
            let chinese = texts.get(english).is_some_and(|text| is_chinese(text));
            assert!(chinese, "po/help.zh.po lacks\nmsgid {english:?}");
        }
        for english in texts.keys() {
            assert!(used.contains(english), "{english:?} is no text of the help");
        }
        let written = CATALOGUE.lines().filter_map(|l| l.strip_prefix("msgid ")).skip(1);
        let written: Vec<String> = written.map(|l| serde_json::from_str(l).unwrap()).collect();
        assert_eq!(written, texts.into_keys().collect::<Vec<_>>());
    }

    #[test]
    fn the_language_is_known_before_the_arguments_are_read() {
        let of = |line: &str| {
            given(&line.split(' ').map(OsString::from).collect::<Vec<_>>(), "--lang", Lang::named)
        };
        assert_eq!(of("hodograph solve --lang zh x.json"), Some(Lang::Zh));
        assert_eq!(of("hodograph solve --lang=en --help"), Some(Lang::En));
        assert_eq!(of("hodograph solve -- --lang zh"), None);
        assert_eq!(of("hodograph solve --lang"), None);
    }
}
