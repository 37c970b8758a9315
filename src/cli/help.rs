//! Help and the faults of arguments in Chinese: the table of [`words`] translates the English of
//! `args`.
//!
//! The printer of the help knows only English headings; they are translated in its output.

mod words;

use super::args::Args;
use super::files::FileRefusal;
use crate::diag::{Both, Diagnostic};
use crate::figure::cycle::CycleForm;
use crate::figure::list::LIST;
use crate::figure::stepped::METHODS;
use crate::scene::Lang;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Arg, Command, CommandFactory};
use std::ffi::OsString;
use words::{HEADINGS, WORDS};

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
    let names: Vec<String> = command.get_subcommands().map(|c| c.get_name().to_owned()).collect();
    let mut command = translated(command, "");
    for name in names {
        command = command.mut_subcommand(&name, |c| translated(c, &name));
    }
    // Chinese has no spaces at which the printer could break a line: the terminal breaks it.
    command.term_width(0)
}

/// Translates one command and its arguments.
fn translated(command: Command, name: &str) -> Command {
    let command = match entry(name, "") {
        Some(about) => command.about(about).long_about(about),
        None => command,
    };
    let command = match entry(name, "*after") {
        Some(after) => command.after_help(after),
        None => command,
    };
    command.mut_args(|arg: Arg| {
        match entry(name, arg.get_id().as_str()).or_else(|| entry("*", arg.get_id().as_str())) {
            Some(help) => arg.help(help).long_help(help),
            None => arg,
        }
    })
}

fn entry(command: &str, argument: &str) -> Option<&'static str> {
    WORDS.iter().find(|w| (w.0, w.1) == (command, argument)).map(|w| w.2)
}

/// Translates the headings and the names of choices of a printed help into Chinese.
fn headings(text: &str) -> String {
    let figures = LIST.iter().map(|e| (e.about[0], e.about[1]));
    let methods = METHODS.iter().map(|e| (e.about[0], e.about[1]));
    let forms = CycleForm::ALL.into_iter().map(|f| (f.about()[0], f.about()[1]));
    HEADINGS
        .iter()
        .copied()
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

    fn is_chinese(text: &str) -> bool {
        text.chars().any(|c| ('\u{4e00}'..='\u{9fff}').contains(&c))
    }

    #[test]
    fn every_command_and_argument_is_told_in_chinese() {
        let mut command = command(Lang::Zh);
        assert!(is_chinese(&command.get_about().unwrap().to_string()));
        // Skips the list of commands, which `help` repeats.
        for c in command.get_subcommands_mut().filter(|c| c.get_name() != "help") {
            let name = c.get_name().to_owned();
            assert!(
                c.get_about().is_some_and(|a| is_chinese(&a.to_string())),
                "{name}: no Chinese in WORDS"
            );
            for arg in c.get_arguments() {
                let help = arg.get_help().map(ToString::to_string).unwrap_or_default();
                assert!(
                    is_chinese(&help),
                    "{name} {}: no Chinese in WORDS, but {help:?}",
                    arg.get_id()
                );
            }
            let text = headings(&c.render_long_help().to_string());
            // Only names remain in Latin letters: no two lower-case words follow one another.
            let english = text.lines().find(|l| {
                let small = |w: &str| w.len() > 1 && w.chars().all(|c| c.is_ascii_lowercase());
                let words: Vec<&str> = l.split(' ').collect();
                words.windows(3).any(|w| w.iter().all(|w| small(w)))
            });
            assert_eq!(english, None, "{name}:\n{text}");
        }
    }

    #[test]
    fn no_entry_is_left_over() {
        let command = command(Lang::Zh);
        for (c, a, _) in WORDS.iter().filter(|w| w.1 != "*after") {
            let all: Vec<&Command> =
                std::iter::once(&command).chain(command.get_subcommands()).collect();
            let mut meant = all.iter().filter(|x| {
                *c == "*"
                    || x.get_name() == *c
                    || c.is_empty() && x.get_name() == command.get_name()
            });
            assert!(
                meant.any(|x| a.is_empty() || x.get_arguments().any(|arg| arg.get_id() == *a)),
                "{c} {a}: there is no such argument"
            );
        }
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
