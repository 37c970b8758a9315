//! Sentences over all frames in few characters: common words are stored once, apart from the
//! numbers that change.

use std::collections::HashMap;

use serde_json::{Value, json};

use crate::paper::label::Label;
use crate::paper::phrase::Phrase;
use crate::render::math::mathml;
use crate::report::html::sentence_with;

/// Formulas without changing numbers, each stored once.
#[derive(Default)]
pub struct Formulas {
    /// Formulas in abbreviated MathML.
    pub list: Vec<String>,
    known: HashMap<String, usize>,
}

impl Formulas {
    /// Returns the index of a formula in the label language.
    pub fn formula(&mut self, source: &str) -> usize {
        self.index(mathml(&Label::math(source)))
    }

    /// A sentence without changing numbers as HTML; its formulas are given by their indices.
    pub fn phrase(&mut self, phrase: &Phrase) -> String {
        sentence_with(phrase, |source| self.placeholder(source))
    }

    fn placeholder(&mut self, source: &str) -> String {
        format!("{}{}{}", FORMULA[0], self.formula(source), FORMULA[1])
    }

    fn index(&mut self, markup: String) -> usize {
        let next = self.list.len();
        let index = *self.known.entry(markup.clone()).or_insert(next);
        if index == next {
            self.list.push(short(&markup));
        }
        index
    }
}

/// Frequent pieces of formulas; each is written to the page as one private character from [`TAG`]
/// on.
const TAGS: [&str; 24] = [
    "<math><mrow>",
    "</mrow></math>",
    "<mpadded depth=\"0\">",
    "<mpadded width=\"0\">",
    "</mpadded>",
    "<mo lspace=\"0\" rspace=\"0\">",
    "<mspace width=\"",
    "<msubsup>",
    "</msubsup>",
    "<msub>",
    "</msub>",
    "<msup>",
    "</msup>",
    "<mtext>",
    "</mtext>",
    "<mrow>",
    "</mrow>",
    "<mi>",
    "<mi mathvariant=\"normal\">",
    "</mi>",
    "<mn>",
    "</mn>",
    "<mo>",
    "</mo>",
];
const TAG: u32 = 0xE010;

/// The tags for the page.
pub fn tags() -> &'static [&'static str] {
    &TAGS
}

fn short(markup: &str) -> String {
    let sign = |k: usize| char::from_u32(TAG + k as u32).unwrap_or_default().to_string();
    TAGS.iter().enumerate().fold(markup.to_owned(), |text, (k, tag)| text.replace(tag, &sign(k)))
}

/// Characters before and after the index of a formula.
const FORMULA: [char; 2] = ['\u{E001}', '\u{E002}'];
/// Placeholder of a changing number (a private character).
const HOLE: char = '\u{E000}';

/// Packs one sentence over the frames, in label language with formulas between dollar signs; `None`
/// where a frame has no sentence. Returns the forms with placeholders, the form of each frame, and
/// the numbers for its placeholders.
pub fn packed_sentences(frames: &[Option<String>], formulas: &mut Formulas) -> Value {
    let mut forms: Vec<(Vec<String>, Vec<Vec<&str>>)> = Vec::new();
    let mut index: HashMap<Vec<&str>, usize> = HashMap::new();
    let mut which: Vec<Option<(usize, usize)>> = Vec::new();
    for text in frames {
        let Some(text) = text else {
            which.push(None);
            continue;
        };
        let (words, numbers) = taken_apart(text);
        let form = *index.entry(words.clone()).or_insert_with(|| {
            forms.push((words.iter().map(|w| (*w).to_owned()).collect(), Vec::new()));
            forms.len() - 1
        });
        forms[form].1.push(numbers);
        which.push(Some((form, forms[form].1.len() - 1)));
    }
    // Numbers that never change belong to the form.
    let open: Vec<Vec<bool>> = forms
        .iter()
        .map(|(_, uses)| {
            (0..uses[0].len()).map(|n| uses.iter().any(|u| u[n] != uses[0][n])).collect()
        })
        .collect();
    let markup: Vec<String> = forms
        .iter()
        .zip(&open)
        .map(|((words, uses), open)| form(words, &uses[0], open, formulas))
        .collect();
    let mut sequence: Vec<i64> = Vec::new();
    let mut numbers: Vec<String> = Vec::new();
    for w in &which {
        match w {
            None => sequence.push(-1),
            Some((f, use_of)) => {
                sequence.push(*f as i64);
                let mine = forms[*f].1[*use_of].iter().zip(&open[*f]).filter(|(_, open)| **open);
                numbers.extend(mine.map(|(n, _)| (*n).to_owned()));
            }
        }
    }
    // 0 means one form in all frames.
    let sequence = if sequence.iter().all(|s| *s == 0) { json!(0) } else { json!(runs(&sequence)) };
    json!([markup, sequence, numbers.join(" ")])
}

/// Returns runs of equal neighbours as (value, count) in one list.
pub fn runs(list: &[i64]) -> Vec<i64> {
    let mut out: Vec<i64> = Vec::new();
    for &v in list {
        match out.len() {
            n if n > 1 && out[n - 2] == v => out[n - 1] += 1,
            _ => out.extend([v, 1]),
        }
    }
    out
}

/// Returns the form as HTML, with placeholders for the changing numbers.
fn form(words: &[String], numbers: &[&str], open: &[bool], formulas: &mut Formulas) -> String {
    // A number that occurs in no sentence keeps the place of the placeholder while the formula is
    // parsed.
    let keeper = |n: usize| format!("{}", 90_000_001 + n);
    let mut text = words[0].clone();
    for (n, word) in words[1..].iter().enumerate() {
        text.push_str(&if open[n] { keeper(n) } else { numbers[n].to_owned() });
        text.push_str(word);
    }
    let kept = || (0..open.len()).filter(|n| open[*n]).map(keeper);
    let html = sentence_with(&Phrase::new(&text), |source| {
        if kept().any(|k| source.contains(&k)) {
            mathml(&Label::math(source))
        } else {
            formulas.placeholder(source)
        }
    });
    short(&kept().fold(html, |html, k| html.replace(&k, &HOLE.to_string())))
}

/// Returns the pieces of text between the numbers, and the numbers.
fn taken_apart(text: &str) -> (Vec<&str>, Vec<&str>) {
    let bytes = text.as_bytes();
    let (mut words, mut numbers) = (Vec::new(), Vec::new());
    let (mut from, mut i) = (0, 0);
    while i < bytes.len() {
        if !bytes[i].is_ascii_digit() {
            i += 1;
            continue;
        }
        let start = i;
        while i < bytes.len()
            && (bytes[i].is_ascii_digit()
                || bytes[i] == b'.' && bytes.get(i + 1).is_some_and(u8::is_ascii_digit))
        {
            i += 1;
        }
        words.push(&text[from..start]);
        numbers.push(&text[start..i]);
        from = i;
    }
    words.push(&text[from..]);
    (words, numbers)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_changes_is_a_hole() {
        let said = |mm: &str| Some(format!("From $b_2$ lay off {mm} mm, $v = {mm} m/s$."));
        let mut formulas = Formulas::default();
        let told = packed_sentences(&[said("36.2"), said("7"), None, said("7.25")], &mut formulas);
        assert_eq!(told[0][0].as_str().unwrap().matches(HOLE).count(), 2, "{told}");
        assert!(
            formulas.list.len() == 1 && formulas.list[0] == short(&mathml(&Label::math("b_2"))),
            "b₂ is a formula that stays: {:?}",
            formulas.list
        );
        assert_eq!(
            (&told[1], &told[2]),
            (&json!([0, 2, -1, 1, 0, 1]), &json!("36.2 36.2 7 7 7.25 7.25"))
        );
    }

    #[test]
    fn other_words_are_another_form() {
        let told = packed_sentences(
            &[Some("3 up".into()), Some("4 down".into()), Some("5 up".into())],
            &mut Formulas::default(),
        );
        assert_eq!(told, json!([[format!("{HOLE} up"), "4 down"], [0, 1, 1, 1, 0, 1], "3 5"]));
    }
}
