//! The solution of a task that asks for instantaneous centres: the centres given by pairs,
//! Kennedy's theorem for the others, and the angular velocities and speeds that follow from them.
//!
//! Other questions (accelerations, relative velocities) are solved by polygons after this.

use super::results::COMPARED;
use super::speak::Speak;
use super::{DocumentBlock, DocumentTable, SheetMaker, TableKind};
use crate::answer::AnswerValue;
use crate::centres::{Centre, CentreMethod, CentreTask};
use crate::figure::list::{Extras, FigureInput, named};
use crate::paper::phrase::Phrase;
use crate::report::amount::symbol;
use crate::report::centres::CentreWords;
use hodograph_base::lang::{each, say, tr};

impl SheetMaker<'_> {
    /// Writes the centres and the values that follow from them.
    pub(super) fn centres(&self, blocks: &mut Vec<DocumentBlock>, task: &CentreTask) {
        let words = CentreWords::marked(&task.found, self.lang());
        blocks.push(self.heading(2, each!("Instantaneous centres")));
        let counted = words.counts();
        blocks.push(DocumentBlock::Paragraph(Phrase::new(&say!(
            self.lang(),
            "The ground is one of the links, so that there are $N(N - 1)/2$ centres. {counted}."
        ))));
        let (at_pairs, others): (Vec<_>, Vec<_>) =
            task.found.list.iter().partition(|c| matches!(c.step.how, CentreMethod::Primary(_)));
        let list =
            |all: Vec<&Centre>| all.into_iter().map(|c| words.sentence(c)).collect::<Vec<_>>();
        blocks.push(DocumentBlock::List { numbered: false, members: list(at_pairs) });
        if !others.is_empty() {
            blocks.push(self.paragraph(
                each!("The three centres of any three links are collinear: each further centre lies on two such lines."),
            ));
            blocks.push(DocumentBlock::List { numbered: true, members: list(others) });
        }
        self.drawn_centres(blocks);
        blocks.push(self.heading(2, each!("Velocities by the centres")));
        blocks.push(DocumentBlock::List {
            numbered: true,
            members: words.steps().iter().map(|s| Phrase::new(s)).collect(),
        });
    }

    fn drawn_centres(&self, blocks: &mut Vec<DocumentBlock>) {
        let wanted = FigureInput {
            scene: self.scene,
            worked: self.worked,
            options: self.options,
            extras: &Extras::default(),
        };
        let pages = named("centres")
            .and_then(|entry| (entry.draw)(&wanted).ok())
            .map_or_else(Vec::new, |pages| pages.value);
        blocks.extend(pages.into_iter().map(|(_, figure)| DocumentBlock::Figure {
            name: "centres",
            figure: Box::new(figure),
        }));
    }

    /// The values by centres compared with those of the loop equations.
    pub(super) fn compared_centres(&self, blocks: &mut Vec<DocumentBlock>, task: &CentreTask) {
        let head = [
            tr!(self.lang(), "quantity"),
            tr!(self.lang(), "by centres"),
            tr!(self.lang(), "loop equations"),
        ];
        let mut rows = vec![head.map(Phrase::new).to_vec()];
        for r in &self.worked.results {
            let find = &self.scene.find[r.find];
            let Some(own) = task.found.value(self.scene, find) else { continue };
            let computed = r.computed.magnitude().copysign(
                if matches!(r.computed, AnswerValue::Scalar(s) if s < 0.0) { -1.0 } else { 1.0 },
            );
            // A value that is only a rounding residue is printed as zero.
            let told = |si: f64| {
                if si.abs() <= r.noise {
                    "$0$".to_owned()
                } else {
                    format!("${}$", self.size(find, AnswerValue::Scalar(si), COMPARED))
                }
            };
            rows.push(vec![
                Phrase::new(&format!("${}$", symbol(find, self.notation()))),
                Phrase::new(&told(own)),
                Phrase::new(&told(computed)),
            ]);
        }
        if rows.len() > 1 {
            blocks.push(DocumentBlock::Table(DocumentTable { kind: TableKind::Values, rows }));
        }
    }
}
