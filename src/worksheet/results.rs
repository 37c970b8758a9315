//! The results with their senses, and the comparison of the drawing with the loop equations.

use super::speak::Speak;
use super::{DocumentBlock, DocumentTable, SheetMaker, TableKind};
use crate::answer::AnswerValue;
use crate::centres::CentreTask;
use crate::certified::ladder::MissingDigits;
use crate::digits::shortest;
use crate::figure::remarks::remarks;
use crate::figure::results::{ResultsContent, by_lines, measured, named};
use crate::paper::label::Label;
use crate::paper::phrase::{Phrase, fill};
use crate::render::math::Math;
use crate::report::amount::{amount, number, sense, symbol};
use crate::report::answers::{AnswerLine, at_infinity, lines, reason, verdict};
use crate::report::drafting;
use crate::scene::Find;
use crate::worked::Outcome;
use hodograph_base::lang::{each, say, tr};

/// Digits at which drawing and analysis are compared: more than are printed as results.
pub(super) const COMPARED: usize = 8;

/// The column of the results with lengths on paper.
const MEASURED: usize = 1;

impl SheetMaker<'_> {
    /// Writes the results; `task` is one that asks for centres.
    pub(super) fn results(&self, blocks: &mut Vec<DocumentBlock>, task: Option<&CentreTask>) {
        self.answers(blocks, task);
        match task.filter(|t| t.alone) {
            Some(task) => {
                self.loop_equations(blocks);
                self.compared_centres(blocks, task);
            }
            None => self.comparison(blocks),
        }
    }

    /// Writes the results of formulas, without what is measured on polygons.
    pub(super) fn results_of_formulas(&self, blocks: &mut Vec<DocumentBlock>) {
        let from = blocks.len();
        self.answers(blocks, None);
        for block in &mut blocks[from..] {
            if let DocumentBlock::Table(table) = block {
                table.rows.iter_mut().for_each(|row| drop(row.remove(MEASURED)));
            }
        }
    }

    fn answers(&self, blocks: &mut Vec<DocumentBlock>, task: Option<&CentreTask>) {
        let (scene, words, digits) = (self.scene, self.words(), self.options.digits);
        blocks.push(DocumentBlock::Heading(2, words.results.into()));
        let head = [
            tr!(self.lang(), "quantity"),
            tr!(self.lang(), "measured"),
            tr!(self.lang(), "value"),
            tr!(self.lang(), "sense or direction"),
        ];
        let mut rows = vec![head.map(Phrase::new).to_vec()];
        let mut said = Vec::new();
        let centres = task.map(|t| &t.found);
        let alone = task.is_some_and(|t| t.alone);
        for line in lines(self.worked, self.certified) {
            let (r, c) = match line {
                AnswerLine::Answer(r, c) => (r, c),
                AnswerLine::InfiniteCentre(far) => {
                    let name = math(&symbol(&scene.find[far.find], self.notation()));
                    rows.push(vec![
                        name,
                        Phrase::default(),
                        Phrase::of_words(&at_infinity(far, self.lang())),
                        Phrase::default(),
                    ]);
                    continue;
                }
                AnswerLine::None(u) => {
                    let name = math(&symbol(&scene.find[u.find], self.notation()));
                    let none = Phrase::new(verdict(u, self.lang()));
                    said.push(Phrase::new(&reason(scene, u, self.lang())));
                    rows.push(vec![name, Phrase::default(), none, Phrase::default()]);
                    continue;
                }
            };
            let find = &scene.find[r.find];
            let value = r.value();
            let name = symbol(find, self.notation());
            // A singular pose is reported once for all, among the remarks.
            if let Some(why) = c.why.as_ref().filter(|w| !matches!(w, MissingDigits::NextOrder(_)))
            {
                said.push(Phrase::new(&fill(
                    words.uncertain,
                    &[("", &format!("${name}$")), ("why", &why.words(self.lang()))],
                )));
            }
            let by_ruler = centres.and_then(|found| by_lines(found, find, words));
            let read =
                by_ruler.or_else(|| measured(&scene.book, r, c, find, words).filter(|_| !alone));
            rows.push(vec![
                math(&named(&self.writer(), find, r)),
                read.map_or(Phrase::default(), |l| of_label(&l)),
                math(&amount(&scene.book, find, value, c, digits)),
                of_label(&sense(find, value, c, words, digits)),
            ]);
        }
        blocks.push(DocumentBlock::Table(DocumentTable { kind: TableKind::Values, rows }));
        let answers = ResultsContent {
            scene,
            worked: self.worked,
            certified: self.certified,
            notation: self.notation(),
            words,
            digits,
        };
        if !alone {
            said.extend(remarks(&answers));
        }
        said.dedup();
        if !said.is_empty() {
            blocks.push(DocumentBlock::List { numbered: false, members: said });
        }
    }

    /// Describes the loop equations.
    fn loop_equations(&self, blocks: &mut Vec<DocumentBlock>) {
        blocks.push(self.heading(2, each!("Comparison with the loop equations")));
        let [v, a] = self.worked.solution.size;
        blocks.push(DocumentBlock::Paragraph(Phrase::new(&match a { 0 => say!(self.lang(), "All constraints of the mechanism, differentiated with respect to time, give {v} linear equations in the {v} unknown velocities, which are solved simultaneously, without any polygon."),
_ => say!(self.lang(), "All constraints of the mechanism, differentiated once and twice with respect to time, give {v} linear equations in the unknown velocities and {a} in the unknown accelerations, which are solved simultaneously, without any polygon."), })));
    }

    fn comparison(&self, blocks: &mut Vec<DocumentBlock>) {
        if !self.worked.results.iter().any(|r| r.agreement.is_some()) {
            return;
        }
        let by_hand = self.worked.by_hand(self.scene);
        self.loop_equations(blocks);
        self.components(blocks);
        let mm = shortest(by_hand.pencil_mm);
        let hand = fill(tr!(self.lang(), "by hand ({} mm)"), &[("", &mm)]);
        let head = [
            tr!(self.lang(), "quantity"),
            tr!(self.lang(),"method" => "drawing"),
            tr!(self.lang(), "loop equations"),
            &hand,
        ];
        let mut rows = vec![head.map(Phrase::new).to_vec()];
        for r in &self.worked.results {
            let (Some(drawn), Some(_)) = (&r.drawn, r.agreement) else { continue };
            let find = &self.scene.find[r.find];
            let shown = |v: AnswerValue| {
                if v.magnitude() <= r.noise {
                    "$0$".into()
                } else {
                    format!("${}$", self.size(find, v, trusted(r)))
                }
            };
            rows.push(vec![
                math(&symbol(find, self.notation())),
                Phrase::new(&shown(drawn.value)),
                Phrase::new(&shown(r.computed)),
                Phrase::new(&drafting::words(
                    &self.scene.book,
                    find,
                    by_hand.tolerances[r.find].as_ref(),
                )),
            ]);
        }
        blocks.push(DocumentBlock::Table(DocumentTable { kind: TableKind::Values, rows }));
    }

    /// A vector by its magnitude, a number as it is, a place by its coordinates, with the printed
    /// unit.
    pub(super) fn size(&self, find: &Find, value: AnswerValue, digits: usize) -> String {
        let (book, kind) = (&self.scene.book, find.what.kind());
        let told = |si: f64| number(book.value(kind, si), digits);
        let plain = match value {
            AnswerValue::Vector(v) => told(v.norm()),
            AnswerValue::Scalar(s) => told(s),
            AnswerValue::Point(p) => format!("({},\\,{})", told(p.x), told(p.y)),
        };
        book.label(kind, &plain)
    }

    /// Derives the magnitude of the first vector from the components that the equations give.
    fn components(&self, blocks: &mut Vec<DocumentBlock>) {
        let first = self.worked.results.iter().find_map(|r| match r.computed {
            AnswerValue::Vector(v) if r.agreement.is_some() && v.norm() > r.noise => Some((r, v)),
            AnswerValue::Vector(_) | AnswerValue::Scalar(_) | AnswerValue::Point(_) => None,
        });
        let Some((r, v)) = first else { return };
        let find = &self.scene.find[r.find];
        let name = symbol(find, self.notation());
        let printed = |si: f64| self.scene.book.value(find.what.kind(), si);
        let digits = trusted(r).min(self.options.digits + 1);
        let part =
            |x: f64| if x.abs() <= r.noise { "0".to_owned() } else { number(printed(x), digits) };
        // A number with a sign or a power of ten gets brackets before it is squared.
        let squared = |x: f64| match part(x) {
            text if text.starts_with('−') || text.contains('^') => format!("({text})^2"),
            text => format!("{text}^2"),
        };
        let squares = format!("{} + {}", squared(v.x), squared(v.y));
        blocks.push(DocumentBlock::Formula(vec![
            Math::Row(Label::math(format!("{name} ="))),
            Math::Root(Label::math(squares)),
            Math::Row(Label::math(format!(
                "= {}",
                self.scene.book.label(find.what.kind(), &number(printed(v.norm()), digits))
            ))),
        ]));
    }
}

/// Digits on which drawing and analysis agree, at most the number that is compared.
fn trusted(r: &Outcome) -> usize {
    let difference = r.agreement.map_or(1.0, |a| a.difference).max(f64::EPSILON);
    ((-libm::log10(difference)).floor().max(1.0) as usize).min(COMPARED)
}

/// A cell's label from a figure: words if it is one piece, else a formula.
fn of_label(label: &Label) -> Phrase {
    if label.row().len() > 1 { math(label.source()) } else { Phrase::new(label.source()) }
}

fn math(source: &str) -> Phrase {
    Phrase::new(&format!("${source}$"))
}
