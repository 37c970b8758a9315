//! The worksheet of a synthesis. The problem states the task of the linkage. The solution shows the
//! construction, the numbers measured on paper, the closed formula as their proof, the finished
//! linkage in its prescribed positions, and all candidates.
//!
//! Given and wanted quantities and formulas come from the kind of task
//! ([`crate::synthesis::told`]), the numbers from its candidates.

use super::speak::Speak;
use super::{
    Document, DocumentBlock, DocumentTable, TableKind, WorksheetOptions, WorksheetSides, one_line,
};
use crate::construct::pencil_mm;
use crate::diag::{Both, Faults};
use crate::digits::{inked, shortest, significant};
use crate::figure::synthesis::{self as figure, Set};
use crate::paper::item::Figure;
use crate::paper::label::Label;
use crate::paper::phrase::{Phrase, PhrasePiece};
use crate::render::math::Math;
use crate::report::drafting::DIGITS;
use crate::report::limits::grashof_words;
use crate::report::symbols::symbols;
use crate::report::synthesis::{motion, taken, value};
use crate::scene::{Kind, Lang};
use crate::synthesis::board::{PaperReading, SynthesisBoard};
use crate::synthesis::by_hand::tolerances;
use crate::synthesis::candidate::{letters, symbol};
use crate::synthesis::{Compared, Design, DesignCandidate, Proof, Task};
use hodograph_base::lang::{each, say, tr};

/// Rows of a function's table, both ends included.
const ROWS: usize = 25;
/// Number of lengths of a candidate in the table of all.
const LENGTHS: usize = 5;

/// Makes the worksheet of a synthesis task, with the construction of one of its candidates, counted
/// from 0.
///
/// ```
/// use hodograph::{scene::Lang, synthesis, worksheet::{self, WorksheetOptions}};
/// let task = synthesis::read(synthesis::templates::get("body").unwrap())?.value;
/// let design = synthesis::solve(&task)?;
/// let document = worksheet::design(&task, &design, 0, &WorksheetOptions::of_language(Lang::En))?;
/// assert!(worksheet::markdown::markdown(&document, "body")?.0.contains("## Construction"));
/// # Ok::<(), hodograph::diag::Faults>(())
/// ```
///
/// # Errors
/// Drawing and formula disagree.
///
/// # Panics
/// There is no such candidate.
pub fn design(
    task: &Task,
    design: &Design,
    pick: usize,
    options: &WorksheetOptions,
) -> Result<Document, Faults> {
    let candidate = &design.candidates[pick];
    let lang = options.sheet.lang;
    let board = figure::to_scale(task, candidate)?;
    let set = Set { style: &options.sheet.style, lang, whole: false };
    let maker = DesignMaker { task, design, pick, candidate, board, set };
    let mut blocks = Vec::new();
    if options.sides != WorksheetSides::Solution {
        maker.problem(&mut blocks);
    }
    if options.sides != WorksheetSides::Problem {
        maker.solution(&mut blocks);
    }
    let title = one_line(lang.of(&task.heading.title));
    Ok(Document { title, lang, fonts: options.sheet.style.fonts.clone(), blocks })
}

struct DesignMaker<'a> {
    task: &'a Task,
    design: &'a Design,
    pick: usize,
    candidate: &'a DesignCandidate,
    board: Option<SynthesisBoard>,
    set: Set<'a>,
}

impl Speak for DesignMaker<'_> {
    fn lang(&self) -> Lang {
        self.set.lang
    }
}

impl DesignMaker<'_> {
    fn said(&self, text: &Both) -> Phrase {
        Phrase::new(self.lang().of(text))
    }

    fn problem(&self, blocks: &mut Vec<DocumentBlock>) {
        let stated = self.task.statement();
        blocks.push(self.heading(1, each!("Problem")));
        blocks.push(DocumentBlock::Paragraph(self.said(&stated.task)));
        if let Some(board) = self.board.as_ref().filter(|_| stated.open_steps > 0) {
            let mut open = board.clone();
            open.steps.truncate(stated.open_steps);
            blocks.push(picture(
                "given",
                figure::construction(self.task, self.candidate, &open, self.set),
            ));
        }
        let list = |all: &[Both]| DocumentBlock::List {
            numbered: false,
            members: all.iter().map(|b| self.said(b)).collect(),
        };
        blocks.extend([
            self.heading(2, each!("Given")),
            list(&stated.given),
            self.heading(2, each!("Wanted")),
            list(&stated.wanted),
        ]);
    }

    fn solution(&self, blocks: &mut Vec<DocumentBlock>) {
        blocks.push(self.heading(1, each!("Solution")));
        if self.design.candidates.len() > 1 {
            let which = self.lang().of(&self.candidate.draft.which);
            let (k, n) = (self.pick + 1, self.design.candidates.len());
            let text =
                say!(self.lang(), "Carried out here: candidate {k} of {n}, {}.", symbols(which));
            blocks.push(DocumentBlock::Paragraph(Phrase::new(&text)));
        }
        if let Some(board) = &self.board {
            self.construction(board, blocks);
        }
        self.proof(blocks);
        self.linkage(blocks);
        self.course(blocks);
        self.candidates(blocks);
    }

    /// The drawing, its steps, and the measured values.
    fn construction(&self, board: &SynthesisBoard, blocks: &mut Vec<DocumentBlock>) {
        blocks.push(self.heading(2, each!("heading" => "Construction")));
        blocks.push(picture(
            "construction",
            figure::construction(self.task, self.candidate, board, self.set),
        ));
        let sentence =
            |s: &crate::synthesis::board::BoardStep| Phrase::new(&symbols(self.lang().of(&s.text)));
        blocks.push(DocumentBlock::List {
            numbered: true,
            members: board.steps.iter().map(sentence).collect(),
        });
        let by_hand = tolerances(self.task, self.candidate, board);
        let numbered = board
            .readings
            .iter()
            .zip(by_hand)
            .filter_map(|(r, t)| Some((r, t, self.candidate.number(&r.name)?)));
        let read: Vec<(&PaperReading, Option<f64>, f64)> = numbered.collect();
        if read.is_empty() {
            return;
        }
        blocks.push(self.heading(2, each!("Measured on paper")));
        let scale = inked(&shortest(board.mu_l));
        let head = [
            tr!(self.lang(), "quantity").to_owned(),
            tr!(self.lang(), "measured").to_owned(),
            say!(self.lang(), "times $\\mu_l = {scale}\\,\\text{{m/mm}}$"),
            tr!(self.lang(), "closed formula").to_owned(),
            say!(self.lang(), "by hand ({} mm)", shortest(pencil_mm(&self.task.paper))),
        ];
        let mut rows = vec![head.iter().map(|h: &String| Phrase::new(h)).collect::<Vec<_>>()];
        for (r, tolerance, formula) in read {
            let (measured, drawn, exact) = match r.angle {
                true => (
                    degrees(board.value(r), 4),
                    degrees(board.value(r), 5),
                    degrees(formula.abs(), 6),
                ),
                false => (
                    mm(r.measured * 1e-3, 4),
                    self.length(board.value(r), 5),
                    self.length(formula.abs(), 6),
                ),
            };
            let hand = tolerance.map_or("—".to_owned(), |t| {
                format!("± {}", if r.angle { degrees(t, DIGITS) } else { self.length(t, DIGITS) })
            });
            rows.push(
                [format!("${}$", symbol(&r.name)), measured, drawn, exact, hand]
                    .iter()
                    .map(|c| Phrase::new(c))
                    .collect(),
            );
        }
        blocks.push(DocumentBlock::Table(DocumentTable { kind: TableKind::Values, rows }));
    }

    /// A length in the unit of the file.
    fn length(&self, value_m: f64, digits: usize) -> String {
        let book = &self.task.book;
        match book.chosen(Kind::Length) {
            Some(unit) => {
                format!("${}$", unit.label(&inked(&significant(unit.of(value_m), digits))))
            }
            None => mm(value_m, digits),
        }
    }

    fn proof(&self, blocks: &mut Vec<DocumentBlock>) {
        blocks.push(self.heading(2, each!("Closed formula")));
        for Proof { what, formulas } in self.task.proof(self.candidate) {
            blocks.push(DocumentBlock::Paragraph(self.said(&what)));
            blocks.extend(formulas.iter().map(|f| DocumentBlock::Formula(parts(f))));
        }
    }

    /// The finished linkage, and the results of sweeping its scene.
    fn linkage(&self, blocks: &mut Vec<DocumentBlock>) {
        blocks.push(self.heading(2, each!("The linkage in its positions")));
        blocks.push(picture("positions", figure::linkage(self.task, self.candidate, self.set)));
        let lang = self.lang();
        let motion = motion(self.candidate, lang).replace(" · ", lang.semicolon());
        let swept = say!(lang, "Followed from the first position, the linkage shows: {motion}.");
        blocks.push(DocumentBlock::Paragraph(Phrase::new(&swept)));
        let said: Vec<Phrase> = self
            .candidate
            .notes()
            .map(|d| Phrase::new(&symbols(self.lang().of(&d.message))))
            .collect();
        if !said.is_empty() {
            blocks.push(DocumentBlock::List { numbered: false, members: said });
        }
    }

    /// Wanted and actual values over the range of a function.
    fn course(&self, blocks: &mut Vec<DocumentBlock>) {
        let Some(figure) = figure::deviation(self.task, self.candidate, self.set) else { return };
        let course = &self.candidate.draft.course;
        blocks.push(self.heading(2, each!("Structural error")));
        blocks.extend(
            figure::generated(self.task, self.candidate, self.set).map(|f| picture("function", f)),
        );
        blocks.push(picture("deviation", figure));
        let wanted = tr!(self.lang(), "wanted function");
        let real = tr!(self.lang(), "generated function");
        let head = [
            "$x$".to_owned(),
            "$\\alpha_0 + \\alpha$".into(),
            format!("$\\varphi_0 + \\varphi$ {wanted}"),
            format!("$\\varphi_0 + \\varphi$ {real}"),
            "$\\Delta\\varphi$".into(),
        ];
        let mut rows = vec![head.iter().map(|h| Phrase::new(h)).collect::<Vec<_>>()];
        let turned = |a: f64| degrees(a, 6);
        let row = |c: &Compared| {
            let cells = [
                format!("${}$", inked(&significant(c.x, 5))),
                turned(c.input),
                turned(c.wanted),
                turned(c.real),
                degrees(c.deviation(), 3),
            ];
            cells.iter().map(|c| Phrase::new(c)).collect::<Vec<_>>()
        };
        let all = if self.candidate.draft.whole_course { course.len() } else { ROWS };
        let steps = course.len().min(all).max(2) - 1;
        rows.extend(
            (0..=steps)
                .filter_map(|k| course.get(k * course.len().saturating_sub(1) / steps))
                .map(row),
        );
        blocks.push(DocumentBlock::Table(DocumentTable { kind: TableKind::Values, rows }));
    }

    fn candidates(&self, blocks: &mut Vec<DocumentBlock>) {
        blocks.push(self.heading(2, each!("All candidates")));
        let lengths: Vec<&str> = self
            .candidate
            .draft
            .numbers
            .iter()
            .filter(|n| {
                n.kind == Some(Kind::Length) && n.name.bytes().all(|b| b.is_ascii_uppercase())
            })
            .map(|n| n.name.as_str())
            .take(LENGTHS)
            .collect();
        let mut head = vec![Phrase::default(), Phrase::new(tr!(self.lang(), "candidate"))];
        head.extend(lengths.iter().map(|n| Phrase::new(&format!("${}$", symbol(n)))));
        head.push(Phrase::new("$\\gamma_{\\text{min}}$"));
        head.push(Phrase::new(tr!(self.lang(), "type, defects")));
        let mut rows = vec![head];
        for (k, c) in self.design.candidates.iter().enumerate() {
            let mut row = vec![
                Phrase::new(&(k + 1).to_string()),
                Phrase::new(&symbols(self.lang().of(&c.draft.which))),
            ];
            row.extend(
                lengths
                    .iter()
                    .map(|n| Phrase::new(&c.number(n).map_or("—".into(), |l| self.length(l, 5)))),
            );
            row.push(Phrase::new(
                &c.judged.transmission.map_or("—".into(), |(angle, _)| degrees(angle, 4)),
            ));
            row.push(Phrase::new(&self.verdict(c)));
            rows.push(row);
        }
        blocks.push(DocumentBlock::Table(DocumentTable { kind: TableKind::Values, rows }));
        blocks.push(DocumentBlock::Paragraph(Phrase::new(&taken(self.design, self.lang()))));
        let told: Vec<Phrase> = self
            .design
            .numbers
            .iter()
            .map(|n| {
                let colon = tr!(self.lang(), ": ");
                let words = |text: String| PhrasePiece::Words(text);
                let what = words(format!("{}{colon}", self.lang().of(&n.what)));
                Phrase::of_pieces(vec![
                    what,
                    PhrasePiece::Formula(printed(&n.name)),
                    words(format!(" = {}", inked(&value(&self.task.book, n)))),
                ])
            })
            .collect();
        if !told.is_empty() {
            blocks.push(self.heading(2, each!("Numbers of the task")));
            blocks.push(DocumentBlock::List { numbered: false, members: told });
        }
    }

    /// Grashof's type, and the defects.
    fn verdict(&self, c: &DesignCandidate) -> String {
        let grashof = c.judged.grashof.map(|g| grashof_words(g, self.lang()).to_owned());
        let defects = c.judged.defects.iter().map(|d| self.lang().of(&d.message).to_owned());
        let all: Vec<String> = grashof.into_iter().chain(defects).collect();
        if all.is_empty() {
            tr!(self.lang(), "no defect").to_owned()
        } else {
            all.join(self.lang().semicolon())
        }
    }
}

fn picture(name: &'static str, figure: Figure) -> DocumentBlock {
    DocumentBlock::Figure { name, figure: Box::new(figure) }
}

fn mm(value_m: f64, digits: usize) -> String {
    format!("${} mm$", inked(&significant(value_m * 1e3, digits)))
}

fn degrees(value_rad: f64, digits: usize) -> String {
    format!("${}\\degree$", inked(&significant(value_rad.to_degrees(), digits)))
}

/// A formula with fractions and roots on its top level, split into pieces for typesetting.
fn parts(source: &str) -> Vec<Math> {
    let row = |text: &str| Math::Row(Label::math(text.trim()));
    let mut out = Vec::new();
    let mut rest = source;
    loop {
        let next = ["\\frac", "\\sqrt"].into_iter().filter_map(|w| Some((rest.find(w)?, w))).min();
        let Some((at, word)) = next else { break };
        if !rest[..at].trim().is_empty() {
            out.push(row(&rest[..at]));
        }
        let after = &rest[at + word.len()..];
        let (one, after) = braced(after);
        if word == "\\sqrt" {
            out.push(Math::Root(Label::math(one)));
            rest = after;
        } else {
            let (other, after) = braced(after);
            out.push(Math::Fraction(Label::math(one), Label::math(other)));
            rest = after;
        }
    }
    if !rest.trim().is_empty() {
        out.push(row(rest));
    }
    out
}

/// The text in the braces at the beginning, and the rest.
fn braced(text: &str) -> (&str, &str) {
    let mut level = 0;
    for (k, c) in text.char_indices() {
        match c {
            '{' => level += 1,
            '}' => level -= 1,
            _ => {}
        }
        if level == 0 {
            return (&text[1.min(k)..k], &text[k + c.len_utf8()..]);
        }
    }
    (text, "")
}

/// A number's name as books print it: `P12_x` is the x-coordinate of P₁₂, `alpha1` is α₁.
fn printed(name: &str) -> String {
    let (of, axis) = match name.rsplit_once('_') {
        Some((of, axis @ ("x" | "y"))) => (of, Some(axis)),
        Some(_) | None => (name, None),
    };
    let (sign, index) = letters(of);
    let symbol = if index.is_empty() { sign } else { format!("{sign}_{{{index}}}") };
    axis.map_or(symbol.clone(), |axis| format!("{axis}_{{{symbol}}}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthesis::{self, KINDS, templates};
    use crate::worksheet::WorksheetOptions;

    fn phrases(block: &DocumentBlock) -> Vec<Phrase> {
        match block {
            DocumentBlock::Heading(_, text) => vec![Phrase::of_words(text)],
            DocumentBlock::Paragraph(p) => vec![p.clone()],
            DocumentBlock::List { members, .. } => members.clone(),
            DocumentBlock::Table(t) => t.rows.iter().flatten().cloned().collect(),
            DocumentBlock::Formula(_) | DocumentBlock::Figure { .. } => Vec::new(),
        }
    }

    #[test]
    fn every_kind_has_a_worksheet_without_faults_in_both_languages() {
        for kind in KINDS {
            let task = synthesis::read(templates::get(kind.name).unwrap()).unwrap().value;
            let solved = synthesis::solve(&task).unwrap();
            for lang in [Lang::En, Lang::Zh] {
                let document =
                    design(&task, &solved, 0, &WorksheetOptions::of_language(lang)).unwrap();
                let formulas = document
                    .blocks
                    .iter()
                    .filter(|b| matches!(b, DocumentBlock::Formula(_)))
                    .count();
                assert!(formulas > 1, "{}", kind.name);
                for label in labels(&document) {
                    assert_eq!(label.faults(), [], "{}: {}", kind.name, label.source());
                }
                for phrase in document.blocks.iter().flat_map(phrases) {
                    let text = phrase.plain();
                    assert!(!text.contains("NaN") && !text.contains('$'), "{}: {text}", kind.name);
                    let chinese = text.chars().any(|c| ('\u{4e00}'..='\u{9fff}').contains(&c));
                    assert!(lang == Lang::Zh || !chinese, "{}: {text}", kind.name);
                }
            }
        }
    }

    fn labels(document: &Document) -> Vec<Label> {
        let of_math = |m: &Math| match m {
            Math::Row(l) | Math::Root(l) => vec![l.clone()],
            Math::Fraction(a, b) => vec![a.clone(), b.clone()],
        };
        let of = |b: &DocumentBlock| match b {
            DocumentBlock::Formula(parts) => parts.iter().flat_map(of_math).collect(),
            other => phrases(other).iter().map(Phrase::label).collect::<Vec<_>>(),
        };
        document.blocks.iter().flat_map(of).collect()
    }

    #[test]
    fn the_problem_holds_no_answer() {
        for kind in KINDS {
            let task = synthesis::read(templates::get(kind.name).unwrap()).unwrap().value;
            let solved = synthesis::solve(&task).unwrap();
            let options = WorksheetOptions {
                sides: WorksheetSides::Problem,
                ..WorksheetOptions::of_language(Lang::En)
            };
            let document = design(&task, &solved, 0, &options).unwrap();
            let text: String =
                document.blocks.iter().flat_map(phrases).map(|p| p.plain() + "\n").collect();
            for answer in ["BC", "CD", "AB"].iter().filter_map(|n| solved.candidates[0].number(n)) {
                let told = significant(answer * 1e3, 6);
                let given = self::given(&task).contains(&told);
                assert!(
                    given || !text.contains(&format!(" {told} ")),
                    "{}: {told} in {text}",
                    kind.name
                );
            }
        }
    }

    fn given(task: &Task) -> String {
        task.statement().given.iter().map(|b| b.en.clone()).collect()
    }

    #[test]
    fn fractions_are_taken_apart() {
        assert_eq!(parts("a = \\frac{b + {c}}{2} ,\\quad d").len(), 3);
        assert_eq!(braced("{a{b}}{c}"), ("a{b}", "{c}"));
    }
}
