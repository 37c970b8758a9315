//! Printed numbers compared with true ones: every printed digit is one of the true number.

use hodograph::answer::AnswerValue;
use hodograph::certified::ladder::{AnswerPart, certify, parts};
use hodograph::effort::truth::BITS;
use hodograph::number::{Ball, Big, Real, within};
use hodograph::scene::{Find, Scene};
use hodograph::worked::Worked;
use std::collections::BTreeMap;

/// Requested numbers of digits.
const DIGITS: [usize; 3] = [4, 6, 12];

/// The comparisons so far.
#[derive(Default)]
pub struct Compared {
    pub scenes: usize,
    pub printed: usize,
    /// Numbers printed with fewer digits than requested.
    pub short: usize,
    pub wrong: Vec<String>,
    /// Questions without printed numbers, by reason.
    pub open: BTreeMap<String, usize>,
    /// Questions by their symbols.
    asked: BTreeMap<&'static str, usize>,
}

impl Compared {
    /// Compares the printed numbers of a scene with true values. `off` is the error of the true
    /// values, as a part of the size of each; `truth` returns those of all questions in order, in a
    /// region of [`BITS`] bits.
    pub fn scene(
        &mut self,
        name: &str,
        scene: &Scene,
        worked: &Worked,
        off: f64,
        truth: impl FnOnce() -> Vec<Option<AnswerValue<Big>>>,
    ) {
        let printed = DIGITS.map(|d| certify(scene, worked, d));
        self.scenes += 1;
        within(BITS, || {
            let truth = truth();
            for (i, r) in worked.results.iter().enumerate() {
                let find = &scene.find[r.find];
                let Some(t) = truth[r.find] else {
                    *self.open.entry("no true value".into()).or_default() += 1;
                    continue;
                };
                *self.asked.entry(find.what.entry().symbol).or_default() += 1;
                let t = t.map(|x| Ball::new(x, off * x.approx().abs().max(r.scale)));
                for (digits, printed) in DIGITS.iter().zip(&printed) {
                    let Ok(expected) = parts(find.what.kind(), t, r.scale, *digits) else {
                        continue;
                    };
                    let c = &printed[i];
                    if c.parts.is_empty() {
                        *self.open.entry(format!("{:?}", c.why)).or_default() += 1;
                    }
                    for (part, n) in &c.parts {
                        let Some((text, certain)) = n.text(*digits) else {
                            self.short += 1;
                            continue;
                        };
                        self.printed += 1;
                        self.short += usize::from(certain < *digits);
                        let Some((_, e)) = expected.iter().find(|(p, _)| p == part) else {
                            self.wrong.push(format!("{name}: {} has no {}", find.text, part.key()));
                            continue;
                        };
                        if n.zero
                            && e.enclosure().largest()
                                <= nothing(*part, *digits, r.scale).max(r.noise)
                        {
                            continue;
                        }
                        let truth = e.text(certain).map_or_else(|| format!("{e:?}"), |t| t.0);
                        if truth != text {
                            let rung = c.rung.name();
                            self.wrong.push(format!(
                                "{name}: {} {} is printed {text}, it is {truth} ({rung})",
                                find.text,
                                part.key()
                            ));
                        }
                    }
                }
            }
        });
    }

    /// Prints the comparisons, and fails if a digit was wrong.
    pub fn done(&self, what: &str, least: usize) {
        println!(
            "{what}: {} scenes, {} printed numbers against {BITS} bit: {} wrong; {} with fewer digits than asked; {:?}; open {:?}",
            self.scenes,
            self.printed,
            self.wrong.len(),
            self.short,
            self.asked,
            self.open
        );
        assert!(
            self.wrong.is_empty(),
            "{} are wrong, first {}",
            self.wrong.len(),
            self.wrong[..self.wrong.len().min(5)].join("\n")
        );
        assert!(self.printed >= least, "only {} numbers were compared", self.printed);
    }
}

/// The limit below which a value may be printed as zero.
fn nothing(part: AnswerPart, digits: usize, scale: f64) -> f64 {
    let whole = match part {
        AnswerPart::Direction => 1e6,
        AnswerPart::Degrees => 360.0,
        AnswerPart::Magnitude
        | AnswerPart::X
        | AnswerPart::Y
        | AnswerPart::Scalar
        | AnswerPart::Printed
        | AnswerPart::PrintedX
        | AnswerPart::PrintedY => scale,
    };
    10f64.powi(-(digits as i32 + 10)) * whole
}

/// True values by the texts of the questions.
pub fn by_text(
    scene: &Scene,
    known: &[(String, AnswerValue<Big>)],
) -> Vec<Option<AnswerValue<Big>>> {
    let of = |f: &Find| known.iter().find(|(text, _)| *text == f.text).map(|(_, value)| *value);
    scene.find.iter().map(of).collect()
}

/// A scene with other questions.
pub fn asking(text: &str, questions: &[String]) -> String {
    let mut json: serde_json::Value = serde_json::from_str(text).unwrap();
    json["find"] = serde_json::json!(questions);
    json.to_string()
}
