//! The catalogue of a crate: English texts with their translations.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::SystemTime;

/// An English text, with a context where the text alone has several translations.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Key {
    /// The context, `msgctxt`.
    pub context: Option<String>,
    /// The English text, `msgid`.
    pub text: String,
}

/// The translations of a crate.
#[derive(Debug)]
pub struct Catalogue {
    path: PathBuf,
    changed: Option<SystemTime>,
    texts: HashMap<Key, String>,
}

impl Catalogue {
    /// Returns the catalogue of the crate being compiled. It is read once; a language server, which
    /// compiles several crates, reads it again where it has changed.
    ///
    /// # Errors
    /// The file cannot be read, or a line of it is not of the format.
    pub fn of_crate() -> Result<Arc<Catalogue>, String> {
        static LAST: Mutex<Option<Arc<Catalogue>>> = Mutex::new(None);
        let folder = std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default();
        let path = Path::new(&folder).join("po/zh.po");
        let changed = std::fs::metadata(&path).and_then(|m| m.modified()).ok();
        let mut last = LAST.lock().unwrap_or_else(PoisonError::into_inner);
        match &*last {
            Some(c) if c.path == path && c.changed == changed => Ok(Arc::clone(c)),
            _ => {
                let source = std::fs::read_to_string(&path)
                    .map_err(|e| format!("{} cannot be read: {e}", path.display()))?;
                let texts = read(&source).map_err(|line| {
                    format!("{}:{line}: neither msgid, msgstr nor a text", path.display())
                })?;
                let read = Arc::new(Catalogue { path, changed, texts });
                *last = Some(Arc::clone(&read));
                Ok(read)
            }
        }
    }

    /// Returns the translation of a text.
    ///
    /// # Errors
    /// The catalogue has none.
    pub fn get(&self, key: &Key) -> Result<String, String> {
        self.texts.get(key).filter(|text| !text.is_empty()).cloned().ok_or_else(|| {
            let context =
                key.context.iter().map(|c| format!("msgctxt {c:?}\n")).collect::<String>();
            format!(
                "no translation; add to {}:\n{context}msgid {:?}\nmsgstr \"\"",
                self.path.display(),
                key.text
            )
        })
    }
}

/// Reads a catalogue: entries of `msgctxt`, `msgid` and `msgstr`, each followed by one or more
/// quoted texts, and comments. The first faulty line, counted from 1, is the error.
fn read(source: &str) -> Result<HashMap<Key, String>, usize> {
    let mut texts = HashMap::new();
    let mut key = Key::default();
    let mut value: Option<String> = None;
    let mut word = "";
    for (line, number) in source.lines().map(str::trim).zip(1..) {
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let begins = line.starts_with("msg");
        let (head, quoted) =
            if begins { line.split_once(' ').ok_or(number)? } else { (word, line) };
        let text = unescaped(quoted).ok_or(number)?;
        if begins {
            word = head;
            if word != "msgstr"
                && let Some(value) = value.take()
            {
                texts.insert(std::mem::take(&mut key), value);
            }
        }
        match word {
            "msgctxt" => key.context.get_or_insert_default().push_str(&text),
            "msgid" => key.text.push_str(&text),
            "msgstr" => value.get_or_insert_default().push_str(&text),
            _ => return Err(number),
        }
    }
    if let Some(value) = value {
        texts.insert(key, value);
    }
    Ok(texts)
}

/// Returns the value of a string literal of Rust or gettext; `None` for anything else.
pub fn unescaped(literal: &str) -> Option<String> {
    if let Some(raw) = literal.strip_prefix('r') {
        let hashes = raw.len() - raw.trim_start_matches('#').len();
        let end = raw.len().checked_sub(hashes)?;
        return raw.get(hashes..end)?.strip_prefix('"')?.strip_suffix('"').map(str::to_owned);
    }
    let body = literal.strip_prefix('"')?.strip_suffix('"')?;
    let mut text = String::with_capacity(body.len());
    let mut rest = body.chars().peekable();
    while let Some(c) = rest.next() {
        match (c, if c == '\\' { rest.next()? } else { ' ' }) {
            ('"', _) => return None,
            ('\\', 'n') => text.push('\n'),
            ('\\', 't') => text.push('\t'),
            ('\\', '\n') => while rest.next_if(|c| c.is_whitespace()).is_some() {},
            ('\\', 'u') => {
                rest.next_if_eq(&'{')?;
                let mut code = 0_u32;
                while let Some(digit) = rest.next_if(char::is_ascii_hexdigit) {
                    code = code.checked_mul(16)?.checked_add(digit.to_digit(16)?)?;
                }
                rest.next_if_eq(&'}')?;
                text.push(char::from_u32(code)?);
            }
            ('\\', quote @ ('"' | '\\' | '\'')) => text.push(quote),
            ('\\', _) => return None,
            (plain, _) => text.push(plain),
        }
    }
    Some(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn literals_have_the_values_of_rust() {
        assert_eq!(unescaped(r#""a\n\"b\" \u{3c6}""#).as_deref(), Some("a\n\"b\" \u{3c6}"));
        assert_eq!(unescaped("\"one \\\n      line\"").as_deref(), Some("one line"));
        assert_eq!(unescaped("r#\"a \"b\" \\n\"#").as_deref(), Some("a \"b\" \\n"));
        for faulty in ["a", "\"a", "\"a\"b\"", r#""\q""#, r#""\u{110000}""#, "r#"] {
            assert_eq!(unescaped(faulty), None, "{faulty}");
        }
    }

    #[test]
    fn contexts_and_continued_texts_are_read() {
        let texts = read(
            "# Chinese.\nmsgid \"\"\nmsgstr \"head\"\n\nmsgctxt \"cam\"\nmsgid \"out\"\nmsgstr \"\"\n\"推\"\n\"程\"\n\nmsgid \"out\"\nmsgstr \"外\"\n",
        )
        .unwrap();
        let key =
            |context: Option<&str>| Key { context: context.map(str::to_owned), text: "out".into() };
        assert_eq!(texts[&key(Some("cam"))], "推程");
        assert_eq!(texts[&key(None)], "外");
        assert_eq!(texts.len(), 3);
        assert_eq!(read("msgid \"a\"\nmsgstr b\n"), Err(2));
        assert_eq!(read("\"a\"\n"), Err(1));
    }
}
