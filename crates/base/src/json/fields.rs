//! Decoding of JSON objects: known keys, expected types, and a diagnostic for everything else.

use super::{Node, NodeKind, Word};
use crate::diag::{Both, Diagnostic, Faults, Piece, Span, both};

/// The subject of a message: a key in quotation marks, which is the same in both languages, or
/// words.
pub struct FaultSubject(Both);

impl FaultSubject {
    /// Returns true if it is this key.
    pub fn is(&self, key: &str) -> bool {
        self.0.en == key
    }
}

impl Piece for FaultSubject {
    type Shown = str;
    fn en(&self) -> &str {
        &self.0.en
    }
    fn zh(&self) -> &str {
        &self.0.zh
    }
}

impl From<&FaultSubject> for FaultSubject {
    fn from(what: &FaultSubject) -> FaultSubject {
        FaultSubject(what.0.clone())
    }
}

impl From<Both> for FaultSubject {
    fn from(words: Both) -> FaultSubject {
        FaultSubject(words)
    }
}

impl From<&Both> for FaultSubject {
    fn from(words: &Both) -> FaultSubject {
        FaultSubject(words.clone())
    }
}

impl From<&str> for FaultSubject {
    fn from(key: &str) -> FaultSubject {
        FaultSubject(Both::same(key))
    }
}

impl From<&String> for FaultSubject {
    fn from(key: &String) -> FaultSubject {
        FaultSubject(Both::same(key))
    }
}

/// Number of bytes that a message can quote in one line.
const LINE: usize = 120;

/// The members of an object after its keys are checked.
pub struct Fields<'a> {
    what: Both,
    span: Span,
    members: &'a [(Word, Node)],
}

impl<'a> Fields<'a> {
    /// Opens an object; every key that is not in `keys` is a fault. `None` (with a fault) if the
    /// node is no object.
    pub fn open(
        node: &'a Node,
        what: impl Into<FaultSubject>,
        keys: &[&str],
        faults: &mut Faults,
    ) -> Option<Self> {
        let what = what.into().0;
        let members = object(node, what.clone(), faults)?;
        for (key, _) in members {
            if !keys.contains(&key.text.as_str()) {
                let d = Diagnostic::error(
                    "unknown-key",
                    both!("`{}` is not a key of {}", key.text, what),
                )
                .at(key.span);
                faults.push(d.help(suggest(
                    &key.text,
                    keys.iter().copied(),
                    both!("the keys are"),
                )));
            }
        }
        Some(Fields { what, span: node.span, members })
    }

    /// Returns the value of a key, if present.
    pub fn get(&self, key: &str) -> Option<&'a Node> {
        self.members.iter().find(|(k, _)| k.text == key).map(|(_, v)| v)
    }

    /// Returns the value of a required key.
    pub fn need(
        &self,
        key: &str,
        example: impl Into<FaultSubject>,
        faults: &mut Faults,
    ) -> Option<&'a Node> {
        let found = self.get(key);
        if found.is_none() {
            let d = Diagnostic::error("missing-key", both!("{} has no `{key}`", self.what));
            // An object longer than a line is quoted by its opening brace alone: the whole would
            // fill the page.
            let long = self.span.end - self.span.start > LINE;
            let d = if long {
                d.at(Span::new(self.span.start, self.span.start + 1))
            } else {
                d.at(self.span)
            };
            let example = example.into();
            faults.push(d.help(both!("add \"{key}\": {}", example)));
        }
        found
    }

    /// Returns the span of the object.
    pub fn span(&self) -> Span {
        self.span
    }
}

/// Returns the members of any object, in order.
pub fn object<'a>(
    node: &'a Node,
    what: impl Into<FaultSubject>,
    faults: &mut Faults,
) -> Option<&'a [(Word, Node)]> {
    match &node.kind {
        NodeKind::Object(members) => Some(members),
        _ => wrong(node, what, both!("example" => "an object"), faults),
    }
}

/// Returns the items of a list.
pub fn list<'a>(
    node: &'a Node,
    what: impl Into<FaultSubject>,
    faults: &mut Faults,
) -> Option<&'a [Node]> {
    match &node.kind {
        NodeKind::Array(items) => Some(items),
        _ => wrong(node, what, both!("example" => "a list"), faults),
    }
}

/// Returns a text that is not empty.
pub fn word(node: &Node, what: impl Into<FaultSubject>, faults: &mut Faults) -> Option<Word> {
    match &node.kind {
        NodeKind::Text(text) if text.trim().is_empty() => {
            let what = what.into();
            faults.push(Diagnostic::error("empty", both!("{} is empty", what)).at(node.span));
            None
        }
        NodeKind::Text(text) => Some(Word { text: text.clone(), span: node.span }),
        _ => wrong(node, what, both!("example" => "a text"), faults),
    }
}

/// Reports a value that has another type than expected.
pub fn wrong<T>(
    node: &Node,
    what: impl Into<FaultSubject>,
    wanted: Both,
    faults: &mut Faults,
) -> Option<T> {
    let what = what.into();
    let d = Diagnostic::error(
        "wrong-type",
        both!("{} must be {}, this is {}", what, wanted, node.what()),
    )
    .at(node.span);
    faults.push(match &node.kind {
        NodeKind::Number(n) if wanted.en == "a text" => d.help(both!("write \"{n}\"")),
        _ => d,
    });
    None
}

/// Returns the nearest of the known names for a help line: `did you mean ...?`, or all of them if
/// none is near.
pub fn suggest<'a>(
    got: &str,
    known: impl Iterator<Item = &'a str> + Clone,
    otherwise: Both,
) -> Both {
    nearest(got, known.clone()).unwrap_or_else(|| {
        // All names: the expected name may be the last.
        let known: Vec<&str> = known.collect();
        both!("{} {}", otherwise, Both::names(&known))
    })
}

/// Returns a help line with the nearest of the known names, `did you mean ...?`; `None` if none is
/// near.
pub fn nearest<'a>(got: &str, known: impl Iterator<Item = &'a str>) -> Option<Both> {
    let lower = got.to_lowercase();
    // Jaro-Winkler 0.7 finds a misspelt long name (`lnik`) and does not suggest `links` for `x`; in
    // names of three or four letters it misses a swapped pair (`rmp`), which one step of the edit
    // distance finds. Two letters, given or known, are too few to guess from: `mn` is as near to
    // `min` as to `mm`.
    let one_slip = |k: &str| k.chars().count() >= 3 && strsim::osa_distance(got, k) == 1;
    let score = |k: &str| match k.to_lowercase() == lower {
        true => 1.0,
        false if got.chars().count() < 3 => 0.0,
        false if one_slip(k) => 0.95,
        false => strsim::jaro_winkler(got, k),
    };
    let near = known.map(|k| (score(k), k)).filter(|(score, _)| *score >= 0.7).fold(
        None,
        |best: Option<(f64, &str)>, (score, k)| {
            if best.is_some_and(|b| b.0 >= score) { best } else { Some((score, k)) }
        },
    );
    near.map(|(_, name)| both!("did you mean `{name}`?"))
}

/// Returns a text of at most `most` characters that serves for both languages, or one text for
/// each: `{"en": ..., "zh": ...}`. The result is English and Chinese, `None` for a missing
/// language.
pub fn localized(
    node: &Node,
    what: &'static str,
    most: usize,
    faults: &mut Faults,
) -> Option<[Option<Word>; 2]> {
    if let NodeKind::Object(_) = node.kind {
        let f = Fields::open(node, what, &["en", "zh"], faults)?;
        let mut text = |key: &str| {
            f.get(key)
                .and_then(|n| word(n, both!("`{key}` of {what}"), faults))
                .and_then(|w| no_longer(w, what, most, faults))
        };
        let texts = ["en", "zh"].map(&mut text);
        if f.get("en").is_none() && f.get("zh").is_none() {
            faults.push(
                Diagnostic::error("empty", both!("{what} says nothing"))
                    .at(node.span)
                    .help(both!("give \"en\", \"zh\" or both")),
            );
        }
        return Some(texts);
    }
    let text = word(node, what, faults).and_then(|w| no_longer(w, what, most, faults));
    text.map(|text| [Some(text.clone()), Some(text)])
}

/// Returns a text if it has at most `most` characters.
fn no_longer(word: Word, what: &str, most: usize, faults: &mut Faults) -> Option<Word> {
    let count = word.text.chars().count();
    if count > most {
        faults.push(
            Diagnostic::error(
                "too-long",
                both!("{what} has {count} characters; at most {most} are allowed"),
            )
            .at(word.span),
        );
        return None;
    }
    Some(word)
}
