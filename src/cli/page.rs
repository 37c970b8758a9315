//! The page in one file: that of `edit`, and the lesson with the engine inside.

use super::{Failure, files, lang};
use crate::diag::{Diagnostic, both};
use crate::scene::Lang;
use std::path::{Path, PathBuf};

/// The page in one file, as `npm run build` writes it.
#[cfg(feature = "page")]
const BUILT_IN: Option<&[u8]> = Some(include_bytes!("../../web/dist/hodograph.html"));
#[cfg(not(feature = "page"))]
const BUILT_IN: Option<&[u8]> = None;

/// The rule for connections of the page's script in the single file.
pub const CONNECT: &str = "connect-src 'none'";
const CHARSET: &str = "<meta charset=\"utf-8\">";

/// The page, cut where its body begins.
pub struct PageText {
    text: String,
    body: usize,
}

impl PageText {
    /// Reads the page: the named one, the one in the program, or one near the program.
    pub fn read(named: Option<&str>) -> Result<PageText, Failure> {
        let read = |path: &Path| {
            std::fs::read_to_string(path).map_err(|e| {
                let help = both!("name the page, hodograph.html");
                files::unreadable(path, &e).help(help)
            })
        };
        let text = match (named, BUILT_IN) {
            (Some(path), _) => {
                read(Path::new(path)).map_err(|d| Failure::argument("--page", path, d))?
            }
            (None, Some(bytes)) => String::from_utf8_lossy(bytes).into_owned(),
            (None, None) => near().iter().find_map(|path| read(path).ok()).ok_or_else(|| {
                let d = Diagnostic::error("no-page", both!("the page is not built"));
                let help = both!(
                    "`npm ci` and `npm run engine && npm run build` in the folder web build it; --page FILE names one that is elsewhere"
                );
                Failure::input(d.help(help), "", "")
            })?,
        };
        let body = text.find("<body>").filter(|body| {
            let head = &text[..*body];
            head.contains(CONNECT) && head.contains(CHARSET)
        });
        body.map(|body| PageText { text, body }).ok_or_else(|| {
            let d = Diagnostic::error(
                "no-page",
                both!("this is not the page of hodograph in one file"),
            );
            let help = both!("`npm run build` in the folder web writes it to dist/hodograph.html");
            Failure::argument("--page", named.unwrap_or_default(), d.help(help))
        })
    }

    /// Returns the page with a meta element of a name, its content and the language that the user
    /// asks for; its script may connect as `connect` says.
    pub fn knowing(&self, name: &str, content: &str, connect: &str) -> String {
        let content = content.replace('&', "&amp;").replace('"', "&quot;").replace('<', "&lt;");
        let lang = lang::asked().map_or("", Lang::name);
        let known = format!(
            "{CHARSET}\n<meta name=\"hodograph-{name}\" content=\"{content}\" data-lang=\"{lang}\">"
        );
        let (head, body) = self.text.split_at(self.body);
        head.replacen(CHARSET, &known, 1).replacen(CONNECT, connect, 1) + body
    }
}

/// Places of the page near the program: beside it, and in the checkout in whose folder `target` it
/// is.
fn near() -> Vec<PathBuf> {
    let Ok(program) = std::env::current_exe() else { return Vec::new() };
    let beside = program.parent().map(|folder| folder.join("hodograph.html"));
    let above = program.ancestors().skip(1).take(4);
    beside.into_iter().chain(above.map(|up| up.join("web/dist/hodograph.html"))).collect()
}
