//! A wrong solution as a problem: find the mistake.
//!
//! The problem shows the wrong equations, their polygon and their values as an author would print
//! them. The solution shows the mistake, drawn over the right solution, explains it, and then gives
//! the right solution as in any worksheet.

use super::speak::Speak;
use super::{Document, DocumentBlock, SheetMaker, WorksheetOptions, WorksheetSides, document};
use crate::attempts::Attempt;
use crate::certified::{certify, steps};
use crate::figure::attempts::{as_printed, page_of};
use crate::paper::phrase::Phrase;
use crate::report::attempts::AttemptWords;
use crate::scene::Scene;
use crate::worked::Worked;
use hodograph_base::lang::each;

/// Makes the worksheet.
pub fn find_the_mistake(
    scene: &Scene,
    worked: &Worked,
    attempt: &Attempt,
    options: &WorksheetOptions,
) -> Document {
    let certified = certify(scene, worked, options.sheet.digits);
    let told = steps(scene, worked, worked.drafting.as_ref().map(|d| d.pencil_mm));
    let maker =
        SheetMaker { scene, worked, options: &options.sheet, certified: &certified, told: &told };
    let wrong = SheetMaker { scene: &attempt.wrong.scene, worked: &attempt.wrong.worked, ..maker };
    let (lang, notation, digits) =
        (options.sheet.lang, &options.sheet.notation, options.sheet.digits);
    let words = AttemptWords { scene, worked, certified: &certified, notation, lang, digits };
    let mut blocks = Vec::new();
    if options.sides != WorksheetSides::Solution {
        maker.problem(&mut blocks);
        wrong.examined(&mut blocks, attempt, &words);
    }
    if options.sides != WorksheetSides::Problem {
        blocks.push(maker.heading(1, each!("The mistake")));
        blocks.push(DocumentBlock::Paragraph(words.heading_set(attempt)));
        blocks.push(DocumentBlock::Figure {
            name: "mistake",
            figure: Box::new(page_of(scene, worked, &options.sheet, attempt)),
        });
        maker.solution(&mut blocks, options.sides == WorksheetSides::Solution);
    }
    document(scene, options, blocks)
}

impl SheetMaker<'_> {
    /// The wrong solution, without any sign that it is wrong.
    fn examined(&self, blocks: &mut Vec<DocumentBlock>, attempt: &Attempt, words: &AttemptWords) {
        blocks.push(self.heading(2, each!("A solution to be examined")));
        blocks.push(self.paragraph(
            each!("The solution below contains one mistake. Find it, say why it is one, and give the right values."),
        ));
        let on = attempt.gap.on;
        for group in self.worked.plan.steps(on) {
            let chosen = group.drawn(self.worked.construction.acts.chosen[group.group]);
            for step in group.steps(chosen) {
                self.step(blocks, on, step);
            }
        }
        let figure = as_printed(attempt, self.options);
        blocks.extend(
            figure.map(|f| DocumentBlock::Figure { name: "examined", figure: Box::new(f) }),
        );
        let members: Vec<Phrase> = attempt.rows.iter().filter_map(|r| words.claimed(r)).collect();
        if !members.is_empty() {
            blocks.push(self.paragraph(each!("Its results:")));
            blocks.push(DocumentBlock::List { numbered: false, members });
        }
    }
}
