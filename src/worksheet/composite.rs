//! The solutions by composite motion: each moving point and frame that the scene names, with its
//! drawing, its equations with values, and its projections.

use super::speak::Speak;
use super::{DocumentBlock, SheetMaker};
use crate::composite::{ChoiceSolution, KnownMotion};
use crate::figure::composite::{NamedSolutions, named_solutions};
use crate::figure::list::{Extras, FigureInput};
use crate::report::composite::{CompositeWords, PER_LINE};
use crate::scene::quantity::Frame;
use crate::scene::{LinkId, Scene};
use hodograph_base::lang::{each, say};

impl SheetMaker<'_> {
    /// Writes the solutions by composite motion; nothing if the scene names no moving point, or if
    /// it has no motion to resolve.
    pub(super) fn composite(&self, blocks: &mut Vec<DocumentBlock>) {
        let extras = Extras::default();
        let input = FigureInput {
            scene: self.scene,
            worked: self.worked,
            options: self.options,
            extras: &extras,
        };
        let Ok(Some(NamedSolutions { staged, each, figures })) = named_solutions(&input) else {
            return;
        };
        let scene = &staged.scene;
        let words = CompositeWords { scene, lang: self.lang(), notation: self.notation() };
        blocks.push(self.heading(2, each!("Solution by composite motion")));
        let bodies: Vec<Option<LinkId>> = each.iter().map(|s| sought(scene, s)).collect();
        let one_body = bodies[0].is_some() && bodies.iter().all(|b| *b == bodies[0]);
        for (k, (s, figure)) in each.iter().zip(figures).enumerate() {
            let number = k + 1;
            let of = words.heading(&s.choice).plain();
            blocks.push(DocumentBlock::Heading(
                3,
                match (each.len(), one_body) {
                    (1, _) => of,
                    (_, true) => say!(self.lang(), "Solution {number}: {}", lower(&of)),
                    (_, false) => {
                        let [open, close] = self.lang().pick([["(", ") "], ["（", "）"]]);
                        format!("{open}{number}{close}{of}")
                    }
                },
            ));
            blocks.push(DocumentBlock::Figure { name: "composite", figure: Box::new(figure) });
            let members = words.body(s, PER_LINE);
            blocks.push(DocumentBlock::List { numbered: false, members });
        }
        let members = words.equated(&each);
        if !members.is_empty() {
            blocks.push(self.heading(3, each!("Both frames together")));
            blocks.push(DocumentBlock::List { numbered: false, members });
        }
    }
}

/// Returns the body whose motion a solution finds.
fn sought(scene: &Scene, s: &ChoiceSolution) -> Option<LinkId> {
    match (s.known, s.choice.frame) {
        (KnownMotion::Transport, _) => s.choice.of.link.or_else(|| scene.mover(s.choice.of.point)),
        (KnownMotion::Absolute, Frame::Link(l)) => Some(l),
        (KnownMotion::Absolute | KnownMotion::Both, _) => None,
    }
}

/// Returns an English heading as the continuation of a sentence.
fn lower(heading: &str) -> String {
    let mut letters = heading.chars();
    let first = letters.next().map(|c| c.to_ascii_lowercase());
    first.into_iter().chain(letters).collect()
}
