//! The solution by the analytic method: the vector loops of each group, their real and imaginary
//! parts, and every unknown as a formula with its value.

use super::speak::Speak;
use super::{
    Document, DocumentBlock, DocumentTable, SheetMaker, TableKind, WorksheetOptions, solved_by,
};
use crate::diag::Faults;
use crate::figure::loops::pages;
use crate::loops::{Equation, GroupLoops, Loops, placed};
use crate::paper::label::Label;
use crate::paper::phrase::Phrase;
use crate::render::math::Math;
use crate::report::loops::{LoopWords, WrittenMotion, closed};
use crate::scene::Scene;
use crate::worked::Worked;
use hodograph_base::lang::{each, say, tr};

/// Makes the worksheet of a scene whose solution is the analytic method.
///
/// # Errors
/// `loops` for pairs and poses of which no loops are written out.
pub fn by_loops(
    scene: &Scene,
    worked: &Worked,
    options: &WorksheetOptions,
) -> Result<Document, Faults> {
    let all = placed(scene, &worked.mechanism, &worked.configuration)?;
    Ok(solved_by(scene, worked, options, |maker, blocks| {
        blocks.push(maker.heading(1, each!("Solution")));
        if !all.groups.is_empty() {
            maker.loops(blocks, &all);
        }
        maker.motion(blocks, &all);
        maker.results_of_formulas(blocks);
    }))
}

impl SheetMaker<'_> {
    fn loops(&self, blocks: &mut Vec<DocumentBlock>, all: &Loops) {
        let words = LoopWords::new(self.scene, all, self.lang());
        blocks.push(self.heading(2, each!("Vector loops")));
        blocks.push(self.paragraph(
            each!("Links and guides form closed loops of vectors. Each vector has a length and an angle from the $x$ axis; the vectors along \
             the two paths from the first joint to the last have the same sum."),
        ));
        let figures = pages(self.scene, self.worked, self.options, all);
        blocks.extend(
            figures
                .into_iter()
                .map(|figure| DocumentBlock::Figure { name: "loop", figure: Box::new(figure) }),
        );
        for (k, g) in all.groups.iter().enumerate() {
            let number = k + 1;
            let heading = words.heading(g);
            blocks.push(DocumentBlock::Heading(2, say!(self.lang(), "Group {number}: {heading}")));
            self.group_loops(blocks, all, g, &words);
        }
    }

    /// Writes the equations of motion of points that drivers move directly.
    fn motion(&self, blocks: &mut Vec<DocumentBlock>, all: &Loops) {
        let words = LoopWords::new(self.scene, all, self.lang());
        let motions = words.motions();
        if motions.is_empty() {
            return;
        }
        blocks.push(self.heading(2, each!("Equations of motion")));
        blocks.push(DocumentBlock::List { numbered: false, members: words.given_motions() });
        for WrittenMotion { heading, parts } in motions {
            blocks.push(DocumentBlock::Heading(3, heading.plain()));
            for (sentence, equations) in parts {
                blocks.push(DocumentBlock::Paragraph(sentence));
                blocks.extend(equations.iter().map(|e| formula(&words, e)));
            }
        }
    }

    fn group_loops(
        &self,
        blocks: &mut Vec<DocumentBlock>,
        all: &Loops,
        g: &GroupLoops,
        words: &LoopWords,
    ) {
        let line = |text: &str| Phrase::new(&format!("${text}$"));
        blocks.push(self.heading(3, each!("Position")));
        for of in &g.loops {
            blocks.push(DocumentBlock::Formula(vec![Math::Row(Label::math(closed(all, of)))]));
            let head = [
                tr!(self.lang(), "vector"),
                tr!(self.lang(), "link"),
                tr!(self.lang(), "length"),
                tr!(self.lang(), "angle"),
            ];
            let mut rows = vec![head.map(Phrase::new).to_vec()];
            rows.extend(of.iter().map(|v| {
                let [way, link, length, angle] = words.row(v);
                vec![line(&way), Phrase::of_words(&link), line(&length), line(&angle)]
            }));
            blocks.push(DocumentBlock::Table(DocumentTable { kind: TableKind::Values, rows }));
        }
        blocks.push(self.paragraph(each!("Real and imaginary parts:")));
        blocks.extend(g.closures.iter().map(|e| formula(words, e)));
        blocks.push(DocumentBlock::Paragraph(Phrase::new(&words.method(g))));
        blocks.extend(g.position.iter().map(|e| formula(words, e)));
        if g.position.is_empty() {
            let found = g.unknowns.iter().map(|k| line(&words.result(*k, 0))).collect();
            blocks.push(DocumentBlock::List { numbered: false, members: found });
        }
        let levels = [
            (self.heading(3, each!("Velocity")), &g.velocities, 1),
            (self.heading(3, each!("Acceleration")), &g.accelerations, 2),
        ];
        for (heading, equations, order) in levels {
            blocks.push(heading);
            blocks.push(DocumentBlock::Paragraph(Phrase::new(words.derived(order))));
            let rows: Vec<Vec<Phrase>> = words
                .system(g, order)
                .iter()
                .map(|row| row.iter().map(|cell| line(cell)).collect())
                .collect();
            blocks.push(DocumentBlock::Table(DocumentTable { kind: TableKind::Values, rows }));
            if equations.is_empty() {
                let found = g.unknowns.iter().map(|k| line(&words.result(*k, order))).collect();
                blocks.push(DocumentBlock::List { numbered: false, members: found });
            } else {
                blocks.push(DocumentBlock::Paragraph(Phrase::new(words.projected())));
                blocks.extend(equations.iter().map(|e| formula(words, e)));
            }
        }
    }
}

/// An equation on a line of its own, with the value that it gives.
fn formula(words: &LoopWords, e: &Equation) -> DocumentBlock {
    DocumentBlock::Formula(words.display(e))
}
