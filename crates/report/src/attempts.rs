//! Wrong solutions in words and as JSON: the printed value, the value by the wrong equation, the
//! true value, and the reason for the mistake.
//!
//! True values are certified, as `solve` prints them. Values of wrong equations are read from their
//! drawing and not certified.

use crate::amount::{amount, number, sense as certified_sense, symbol};
use hodograph_base::digits::{direction_degrees, inked, significant};
use hodograph_base::lang::{say, tr};
use hodograph_base::notation::Notation;
use hodograph_board::plan::PlanStep;
use hodograph_board::plan::names::name_label;
use hodograph_board::plan::text::{EquationColumn, PlanWriter};
use hodograph_mechanism::answer::AnswerValue;
use hodograph_methods::attempts::{Attempt, AttemptAnswer, EquationPart, Site, SolutionSide};
use hodograph_paper::paper::phrase::{Phrase, sense};
use hodograph_paper::paper::words::words;
use hodograph_scene::{Book, Find, GivenQuantity, Lang, Scene};
use hodograph_worked::certified::Certified;
use hodograph_worked::worked::{Worked, contact};
use serde_json::{Value as Json, json};

/// Digits of numbers that are not certified.
const DIGITS: usize = 4;
/// Largest number of digits of printed numbers.
const PRINTED_DIGITS: usize = 8;
/// Largest relative difference at which a printed number is attributed to its equation.
const REPRODUCED: f64 = 0.02;

/// A writer for the wrong solutions of a scene.
pub struct AttemptWords<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The correct solution.
    pub worked: &'a Worked,
    /// The certified answers of the correct solution.
    pub certified: &'a [Certified],
    /// Notation of the marks.
    pub notation: &'a Notation,
    /// Language.
    pub lang: Lang,
    /// Digits of true values.
    pub digits: usize,
}

/// A column of the equation with its frame.
pub struct Framed {
    /// The column.
    pub column: EquationColumn,
    /// True if the vector is missing or wrong, and framed.
    pub framed: bool,
}

impl AttemptWords<'_> {
    /// Returns the name of the mistake and its location.
    pub fn heading(&self, a: &Attempt) -> String {
        let title = a.site.mistake().title(self.lang);
        let place = a.site.place(self.scene);
        match self.lang {
            Lang::En => format!("{title}, {}", place.en),
            Lang::Zh => format!("{title}（{}）", place.zh),
        }
    }

    /// Returns the heading with names of points as formulas.
    pub fn heading_set(&self, a: &Attempt) -> Phrase {
        let (title, place) = (a.site.mistake().title(self.lang), a.site.place(self.scene));
        let contact = if let Site::ContactPoint(c, _) = a.site {
            Some(contact::name(self.scene, c))
        } else {
            None
        };
        let place = self.points_set(self.lang.of(&place), contact.as_deref());
        Phrase::new(&match self.lang {
            Lang::En => format!("{title}, {place}"),
            Lang::Zh => format!("{title}（{place}）"),
        })
    }

    /// Returns words in which every name of a point, including that of a contact, and ω, is a
    /// formula.
    fn points_set(&self, words: &str, contact: Option<&str>) -> String {
        let mut out = String::new();
        let mut name = String::new();
        let set = |name: &mut String, out: &mut String| {
            let point =
                contact == Some(name.as_str()) || self.scene.points.iter().any(|p| p.name == *name);
            if point {
                out.push_str(&format!("${}$", name_label(name)));
            } else {
                out.push_str(if name == "ω" { "$\\omega$" } else { name });
            }
            name.clear();
        };
        for c in words.chars() {
            // Chinese words follow a letter without a space.
            if c.is_alphanumeric() && !('\u{2e80}'..).contains(&c) || c == '\'' || c == '_' {
                name.push(c);
            } else {
                set(&mut name, &mut out);
                out.push(c);
            }
        }
        set(&mut name, &mut out);
        out
    }

    /// Returns writers for the right and the wrong equations.
    pub fn writers<'b>(&'b self, a: &'b Attempt) -> [PlanWriter<'b>; 2] {
        [&a.right, &a.wrong].map(|s| PlanWriter {
            scene: &s.scene,
            plan: &s.worked.plan,
            notation: self.notation,
            lang: self.lang,
        })
    }

    /// Returns the equation that shows the mistake; `None` if the mistake is in a statement.
    pub fn equation(&self, a: &Attempt) -> Option<Vec<Framed>> {
        let [right, wrong] = self.writers(a);
        let w = match a.shown.side {
            SolutionSide::Right => right,
            SolutionSide::Wrong => wrong,
        };
        let EquationPart { on, step, framed, missing, .. } = &a.shown;
        let PlanStep::Equation { target, chains, .. } = step else { return None };
        let columns = w.columns(*on, *target, chains);
        let is_framed = |c: &EquationColumn| c.term.is_some_and(|t| framed.contains(&t));
        let mut all: Vec<Framed> = columns
            .into_iter()
            .map(|column| Framed { framed: is_framed(&column), column })
            .collect();
        if let Some(m) = missing {
            let (symbol, direction, magnitude) =
                (m.symbol.clone(), m.direction.clone(), m.magnitude.clone());
            all.push(Framed {
                column: EquationColumn { joint: "+", symbol, direction, magnitude, term: None },
                framed: true,
            });
        }
        Some(all)
    }

    /// Returns the wrong statement if no equation shows the mistake.
    pub fn statement(&self, a: &Attempt) -> Option<Phrase> {
        let [_, w] = self.writers(a);
        let PlanStep::Image { target, from, .. } = &a.shown.step else { return None };
        let on = a.shown.on;
        let images =
            format!("{}{}{}", w.image(on, from.0), w.image(on, from.1), w.image(on, *target));
        let spots = format!("{}{}{}", w.spot(from.0), w.spot(from.1), w.spot(*target));
        let (vector, similar) = (w.vector(on, *target), &w.notation.similar);
        let image = say!(self.lang, "${vector}$ by the image: Δ${images}$ ${similar}$ Δ${spots}$");
        Some(Phrase::new(&image))
    }

    /// Returns the legend of a frame in a figure.
    pub fn frame(&self, a: &Attempt) -> String {
        tr!(self.lang, "framed: ").to_owned() + self.fault(a)
    }

    /// Returns the legend of the brackets that replace the frame in plain text.
    fn brackets(&self, a: &Attempt) -> String {
        tr!(self.lang, "in brackets: ").to_owned() + self.fault(a)
    }

    /// Returns the fault of the framed part.
    fn fault(&self, a: &Attempt) -> &'static str {
        let missing =
            matches!((&a.shown.missing, a.shown.side), (Some(_), _) | (None, SolutionSide::Right));
        match (missing, printed(a)) {
            (true, true) => tr!(self.lang, "left out in print"),
            (false, true) => tr!(self.lang, "wrong in print"),
            (true, false) => tr!(self.lang, "often left out"),
            (false, false) => tr!(self.lang, "often taken wrongly"),
        }
    }

    /// Returns the legend of the drawing.
    pub fn frame_of_drawing(&self, a: &Attempt) -> &'static str {
        if printed(a) {
            tr!(self.lang, "Right (black) and as printed (red, *), from one pole")
        } else {
            tr!(self.lang, "Right (black) and as it is often done (red, *), from one pole")
        }
    }

    /// Returns a value that is not certified.
    fn plain(&self, find: &Find, value: AnswerValue) -> String {
        let (kind, book): (_, &Book) = (find.what.kind(), &self.scene.book);
        match value {
            AnswerValue::Scalar(s) if kind.turns() => {
                let words = if s == 0.0 { "" } else { sense(self.lang, s) };
                format!(
                    "${}$ {words}",
                    book.label(kind, &number(book.value(kind, s.abs()), DIGITS))
                )
                .trim_end()
                .to_owned()
            }
            AnswerValue::Scalar(s) => {
                format!("${}$", book.label(kind, &number(book.value(kind, s), DIGITS)))
            }
            AnswerValue::Vector(v) => {
                let size = book.label(kind, &number(book.value(kind, v.norm()), DIGITS));
                if v.norm() == 0.0 {
                    format!("${size}$")
                } else {
                    format!("${size}$ ∠ {}°", number(direction_degrees(v.angle()), DIGITS))
                }
            }
            AnswerValue::Point(p) => format!("({}, {})", number(p.x, DIGITS), number(p.y, DIGITS)),
        }
    }

    fn printed(&self, find: &Find, given: &GivenQuantity) -> String {
        let (kind, book) = (find.what.kind(), &self.scene.book);
        let told = |v: f64| book.label(kind, &inked(&significant_at_most(book.value(kind, v))));
        if kind.turns() && given.value != 0.0 {
            return format!("${}$ {}", told(given.value.abs()), sense(self.lang, given.value));
        }
        format!("${}$", told(given.value))
    }

    fn truth(&self, row: &AttemptAnswer) -> String {
        let (r, c) = (&self.worked.results[row.result], &self.certified[row.result]);
        let find = &self.scene.find[r.find];
        let words = words(self.lang);
        let told = certified_sense(find, r.value(), c, words, self.digits).plain();
        let told = if zero(r.value()) { String::new() } else { told };
        format!("${}$ {told}", amount(&self.scene.book, find, r.value(), c, self.digits))
            .trim_end()
            .to_owned()
    }

    /// Returns the line of a question: printed value, value by that equation, true value.
    pub fn row(&self, row: &AttemptAnswer) -> Phrase {
        let symbol = symbol(self.asked(row), self.notation);
        Phrase::new(&format!("${symbol}${}{}", tr!(self.lang, ": "), self.comparison(row)))
    }

    /// Returns the line of a question without formulas: the quantity is written as in `find`.
    fn plain_row(&self, row: &AttemptAnswer) -> String {
        format!(
            "{}{}{}",
            self.asked(row).text,
            tr!(self.lang, ": "),
            Phrase::new(&self.comparison(row)).plain()
        )
    }

    fn asked(&self, row: &AttemptAnswer) -> &Find {
        &self.scene.find[self.worked.results[row.result].find]
    }

    fn comparison(&self, row: &AttemptAnswer) -> String {
        let find = self.asked(row);
        let mut parts = Vec::new();
        parts.extend(
            row.printed
                .as_ref()
                .map(|p| format!("{} {}", tr!(self.lang, "printed"), self.printed(find, p))),
        );
        match row.wrong {
            Some(v) => parts.push(format!(
                "{} {}",
                tr!(self.lang, "by that equation"),
                self.plain(find, v)
            )),
            None => parts.push(tr!(self.lang, "not answered by that equation").to_owned()),
        }
        parts.push(format!("{} {}", tr!(self.lang, "true"), self.truth(row)));
        if !reproduced(row) {
            parts.push(
                tr!(self.lang, "the printed number does not come from this mistake").to_owned(),
            );
        }
        parts.join(" · ")
    }

    /// Returns the result of the wrong solution: the printed value, else the value by its equation.
    pub fn claimed(&self, row: &AttemptAnswer) -> Option<Phrase> {
        let find = self.asked(row);
        let value = match (&row.printed, row.wrong) {
            (Some(p), _) => self.printed(find, p),
            (None, Some(v)) => self.plain(find, v),
            (None, None) => return None,
        };
        Some(Phrase::new(&format!("${}$ = {value}", symbol(find, self.notation))))
    }

    /// Returns the gap between the tips.
    pub fn gap(&self, a: &Attempt) -> Phrase {
        let [_, wrong] = self.writers(a);
        let kind = a.gap.on.kind();
        let size = self
            .scene
            .book
            .label(kind, &number(self.scene.book.value(kind, a.gap.vector.norm()), DIGITS));
        let name = gap_symbol(&wrong, a);
        Phrase::new(&say!(self.lang, "gap between the tips: $|{name}| = {size}$"))
    }

    /// Returns the reason for the mistake, in the author's words if there are any.
    pub fn why(&self, a: &Attempt) -> Phrase {
        let said = a.said.as_ref().and_then(|s| s.why.as_ref()).map(|w| self.lang.of(w).to_owned());
        let why = a.site.why(self.scene);
        match said {
            Some(said) => Phrase::of_words(&said),
            None => Phrase::new(self.lang.of(&why)),
        }
    }

    /// Returns all lines below the drawing.
    pub fn lines(&self, a: &Attempt) -> Vec<Phrase> {
        let mut lines: Vec<Phrase> = a.rows.iter().map(|r| self.row(r)).collect();
        lines.push(self.gap(a));
        lines.push(self.why(a));
        lines
    }
}

fn zero(v: AnswerValue) -> bool {
    matches!(v, AnswerValue::Scalar(0.0))
}

/// Returns a printed number without trailing zeros.
fn significant_at_most(value: f64) -> String {
    let long = significant(value, PRINTED_DIGITS);
    if long.contains('.') && !long.contains('e') {
        long.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        long
    }
}

/// Returns the symbol of the gap: `\Delta a_{E3}`.
pub fn gap_symbol(w: &PlanWriter, a: &Attempt) -> String {
    format!("\\Delta {}", w.vector(a.gap.on, a.gap.wrong))
}

/// Returns true if the wrong solution was printed; false if it is a common mistake.
pub fn printed(a: &Attempt) -> bool {
    a.rows.iter().any(|r| r.printed.is_some())
}

/// Returns true if the printed value is the result of the equation.
fn reproduced(row: &AttemptAnswer) -> bool {
    let (Some(printed), Some(wrong)) = (&row.printed, row.wrong) else { return true };
    let (a, b) = match wrong {
        AnswerValue::Scalar(s) => (printed.value, s),
        AnswerValue::Vector(v) => (printed.value.abs(), v.norm()),
        AnswerValue::Point(_) => return true,
    };
    (a - b).abs() <= REPRODUCED * a.abs().max(b.abs())
}

/// Returns the report as text.
pub fn text(words: &AttemptWords, all: &[Attempt]) -> String {
    let mut lines = Vec::new();
    let title = words.lang.of(&words.scene.title);
    if !title.is_empty() {
        lines.push(title.to_owned());
    }
    if all.is_empty() {
        lines.push(tr!(words.lang, "no known mistake changes an answer of this scene").to_owned());
    }
    for (k, a) in all.iter().enumerate() {
        lines.push(String::new());
        lines.push(format!("({}) {}  [{}]", k + 1, words.heading(a), a.site.mistake().name()));
        if let Some(columns) = words.equation(a) {
            let part = |f: &Framed| {
                let symbol = hodograph_paper::paper::phrase::formula(&f.column.symbol);
                let symbol = if f.framed { format!("[{symbol}]") } else { symbol };
                if f.column.joint.is_empty() {
                    symbol
                } else {
                    format!("{} {symbol}", f.column.joint)
                }
            };
            let formula = columns.iter().map(part).collect::<Vec<_>>().join(" ");
            lines.push(format!("    {formula}"));
            if columns.iter().any(|f| f.framed) {
                lines.push(format!("    {}", words.brackets(a)));
            }
        }
        lines.extend(words.statement(a).map(|p| format!("    {}", p.plain())));
        lines.extend(a.rows.iter().map(|r| format!("    {}", words.plain_row(r))));
        lines.extend([words.gap(a), words.why(a)].iter().map(|p| format!("    {}", p.plain())));
    }
    lines.iter().map(|l| format!("{}\n", l.trim_end())).collect()
}

/// Returns the report as JSON, in SI.
pub fn json(words: &AttemptWords, all: &[Attempt]) -> Json {
    let value = |v: AnswerValue| match v {
        AnswerValue::Scalar(s) => json!(s),
        AnswerValue::Vector(v) => json!([v.x, v.y]),
        AnswerValue::Point(p) => json!([p.x, p.y]),
    };
    let one = |a: &Attempt| {
        let row = |r: &AttemptAnswer| {
            let result = &words.worked.results[r.result];
            json!({
                "find": words.scene.find[result.find].text,
                "printed": r.printed.as_ref().map(|p| p.value),
                "wrong": r.wrong.map(value),
                "true": value(result.value()),
                "reproduced": r.printed.as_ref().map(|_| reproduced(r)),
            })
        };
        let framed = words.equation(a).map(|all| {
            all.iter()
                .filter(|f| f.framed)
                .map(|f| hodograph_paper::paper::phrase::formula(&f.column.symbol))
                .collect::<Vec<_>>()
        });
        json!({
            "mistake": a.site.mistake().name(),
            "pair": a.site.point(words.scene),
            "link": a.site.link(words.scene).map(|l| words.scene.link_name(l)),
            "level": a.gap.on.word(),
            "framed": framed.unwrap_or_default(),
            "gap": [a.gap.vector.x, a.gap.vector.y],
            "answers": a.rows.iter().map(row).collect::<Vec<_>>(),
            "why": Phrase::new(&a.site.why(words.scene).en).plain(),
        })
    };
    json!({"schema": "hodograph/attempts/1", "attempts": all.iter().map(one).collect::<Vec<_>>()})
}
