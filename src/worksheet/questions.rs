//! A worksheet with questions on concepts, set and solved from a scene: degree of freedom and class,
//! the number and the kinds of instantaneous centres, images, the three motions of a moving point, and
//! at each slide whether there is a Coriolis acceleration.
//!
//! The problem shows the mechanism with its dimensions and asks; the solution answers each question
//! with its reason.

use super::mobility::MobilitySheet;
use super::speak::Speak;
use super::{Document, DocumentBlock, SheetMaker, WorksheetOptions, WorksheetSides, document};
use crate::centres::{CentreMethod, Centres, centres};
use crate::certified::steps;
use crate::composite::ContactScene;
use crate::composite::coriolis::{CoriolisVerdict, SlideCoriolis, coriolis};
use crate::paper::label::Label;
use crate::paper::phrase::{Phrase, capital};
use crate::plan::names::{name_label, point_label};
use crate::render::math::Math;
use crate::report::centres::CentreWords;
use crate::report::composite::CompositeWords;
use crate::report::mobility::{Counted, class, kinds};
use crate::scene::Scene;
use crate::worked::Worked;
use hodograph_base::lang::{each, say, tr};

/// A question with the blocks of its answer.
struct ConceptQuestion {
    asked: Phrase,
    answer: Vec<DocumentBlock>,
}

/// Makes the worksheet of a scene that is solved for [`crate::worked::Scope::Figure`].
///
/// ```
/// use hodograph::{scene, worksheet, worked::{work, Scope}};
/// let scene = scene::read(scene::templates::get("slotted-lever").unwrap()).unwrap().value;
/// let worked = work(&scene, Scope::Figure).unwrap().value;
/// let document = worksheet::questions(&scene, &worked, &worksheet::WorksheetOptions::of_language(scene::Lang::En));
/// assert!(worksheet::markdown::markdown(&document, "q").unwrap().0.contains("Coriolis"));
/// ```
pub fn questions(scene: &Scene, worked: &Worked, options: &WorksheetOptions) -> Document {
    let told = steps(scene, worked, None);
    let maker = SheetMaker { scene, worked, options: &options.sheet, certified: &[], told: &told };
    let all = maker.concepts();
    let mut blocks = Vec::new();
    if options.sides != WorksheetSides::Solution {
        blocks.push(maker.heading(1, each!("Problem")));
        blocks.push(maker.paragraph(
            each!("The figure shows a planar mechanism in a pose of its motion; the arrow marks the driver."),
        ));
        blocks.push(maker.given_mechanism());
        blocks.push(maker.heading(2, each!("Given")));
        blocks.push(DocumentBlock::List { numbered: false, members: maker.givens().list() });
        blocks.push(maker.heading(2, each!("Questions")));
        let members = all.iter().map(|q| q.asked.clone()).collect();
        blocks.push(DocumentBlock::List { numbered: true, members });
    }
    if options.sides != WorksheetSides::Problem {
        blocks.push(maker.heading(1, each!("questions" => "Answers")));
        for (k, question) in all.into_iter().enumerate() {
            let number = format!("{}", k + 1);
            let heading = say!(maker.lang(), "Question {number}");
            blocks.push(DocumentBlock::Heading(2, heading));
            blocks.push(DocumentBlock::Paragraph(question.asked));
            blocks.extend(question.answer);
        }
    }
    document(scene, options, blocks)
}

impl SheetMaker<'_> {
    fn concepts(&self) -> Vec<ConceptQuestion> {
        let counted = Counted::of(self.scene);
        let mut all = vec![self.freedom(&counted)];
        all.extend(self.class(&counted));
        if let Ok(found) = centres(self.scene) {
            all.extend(self.of_centres(&found.value));
        }
        all.push(self.images());
        all.extend(self.transport());
        if let Ok((_, slides)) = coriolis(self.scene) {
            all.extend(slides.iter().filter_map(|s| self.coriolis(s)));
        }
        all
    }

    fn freedom(&self, counted: &Counted) -> ConceptQuestion {
        let (f, formula) = counted.formula();
        let drivers = self.scene.own_drivers() as i64;
        let sheet = MobilitySheet { scene: self.scene, options: self.options, drawn: None };
        let verdict = if drivers == 0 { sheet.needed(f) } else { sheet.determined(f, drivers) };
        ConceptQuestion {
            asked: Phrase::new(tr!(
                self.lang(),
                "How many degrees of freedom has the mechanism? Is its motion determined, and why?"
            )),
            answer: vec![
                DocumentBlock::Formula(vec![Math::Row(Label::math(formula))]),
                DocumentBlock::Paragraph(Phrase::new(&verdict)),
            ],
        }
    }

    fn class(&self, counted: &Counted) -> Option<ConceptQuestion> {
        let choices = &counted.survey.choices;
        let given = choices.iter().find(|c| c.given).or(choices.first())?;
        let (groups, highest) = (kinds(given, self.lang()), class(given, self.lang()));
        let answer = say!(
            self.lang(),
            "Taken apart from the far end: {groups}. The class of a mechanism is the highest class of its groups: class {highest}."
        );
        Some(ConceptQuestion {
            asked: Phrase::new(tr!(
                self.lang(),
                "Into which groups can it be taken apart, and what is the class of the mechanism?"
            )),
            answer: vec![DocumentBlock::Paragraph(Phrase::of_words(&answer))],
        })
    }

    fn of_centres(&self, found: &Centres) -> [ConceptQuestion; 3] {
        let words = CentreWords::marked(found, self.lang());
        let links = found.closure.links.len();
        let count = links * links.saturating_sub(1) / 2;
        let number = ConceptQuestion {
            asked: Phrase::new(tr!(
                self.lang(),
                "How many instantaneous centres has the mechanism?"
            )),
            answer: vec![DocumentBlock::Paragraph(Phrase::new(&say!(
                self.lang(),
                "Any two links have one centre, and the ground is one of the links: $N = {links}$, $N(N - 1)/2 = {count}$."
            )))],
        };
        let absolute = links.saturating_sub(1);
        let mut of_kinds = capital(&words.absolute().source());
        of_kinds.push_str(tr!(self.lang(), "."));
        let kinds = ConceptQuestion {
            asked: Phrase::new(tr!(
                self.lang(),
                "Which of them are absolute centres, how many are they, and why?"
            )),
            answer: vec![
                DocumentBlock::Paragraph(Phrase::new(&of_kinds)),
                DocumentBlock::Paragraph(Phrase::new(&say!(
                    self.lang(),
                    "A centre of a moving link and the ground is absolute: the ground is at rest, so that the velocity of the link is zero there in this instant. Each of the {absolute} moving links has one. At a relative centre two moving links have the same velocity, which is in general not zero."
                ))),
            ],
        };
        let primary = |c: &&crate::centres::Centre| matches!(c.step.how, CentreMethod::Primary(_));
        let names: Vec<String> = found
            .list
            .iter()
            .filter(primary)
            .map(|c| format!("$P_{{{}}}$", name_label(&c.step.pair.indices(self.scene))))
            .collect();
        let comma = self.lang().comma();
        let direct = ConceptQuestion {
            asked: Phrase::new(tr!(
                self.lang(),
                "Which centres are known from the pairs, and which theorem gives the others?"
            )),
            answer: vec![DocumentBlock::Paragraph(Phrase::new(&say!(
                self.lang(),
                "From pairs: {}; a pin is the centre of its links, and a straight slide has its centre at infinity, square to the guide. The others by the theorem of three centres: those of any three links are on one straight line.",
                names.join(comma)
            )))],
        };
        [number, kinds, direct]
    }

    /// Asks for the Coriolis acceleration of a pin in its guide; `None` for a guide without a pin.
    fn coriolis(&self, s: &SlideCoriolis) -> Option<ConceptQuestion> {
        let scene = self.scene;
        let guide = &scene.guides[s.guide.0];
        // The flank of a cam is a guide that the file does not have.
        let own = scene.cams.iter().all(|c| c.cam != guide.on);
        let pin = guide.pin.filter(|_| own)?;
        let (point, on) =
            (point_label(scene.point_name(pin)), name_label(scene.link_name(guide.on)));
        let asked = Phrase::new(&say!(
            self.lang(),
            "Has the acceleration of ${point}$ against the guide on link ${on}$ a Coriolis part? Is it there in this pose?"
        ));
        let answer = match s.verdict {
            CoriolisVerdict::GuideFixed => self.paragraph(
                each!("No: the guide is fixed, its angular velocity is always zero."),
            ),
            CoriolisVerdict::GuideTranslates => self.paragraph(
                each!("No: the guide translates, its angular velocity is always zero."),
            ),
            CoriolisVerdict::Present => DocumentBlock::Paragraph(Phrase::new(&say!(self.lang(), "Yes: the guide turns with link ${on}$ and the point slides along it, $a^k = 2\\omega_{{{on}}} v^r$, square to the guide; in this pose neither is zero."))),
            CoriolisVerdict::GuideDwells => self.paragraph(
                each!("In this pose there is none: the angular velocity of the guide is zero here."),
            ),
            CoriolisVerdict::NoSliding => self.paragraph(
                each!("In general yes, for the guide turns; in this pose it is zero, because the point does not slide along the guide here."),
            ),
        };
        Some(ConceptQuestion { asked, answer: vec![answer] })
    }

    /// Asks for the three motions of the first moving point that serves.
    fn transport(&self) -> Option<ConceptQuestion> {
        let staged = ContactScene::new(self.scene);
        let choice = staged.shown(self.scene, 1).into_iter().next()?;
        let words = CompositeWords {
            scene: &staged.scene,
            lang: self.lang(),
            notation: &self.options.notation,
        };
        let heading = words.heading(&choice).source();
        let asked = Phrase::new(&say!(
            self.lang(),
            "{heading}: what are its absolute, relative and transport motion? Of which point is $v_{{e}}$ the velocity?"
        ));
        let motions = format!("{}{}", words.three_motions(&choice).source(), tr!(self.lang(), "."));
        let answer = vec![
            DocumentBlock::Paragraph(Phrase::new(&motions)),
            self.paragraph(
                each!("The transport motion is a motion of the frame, a body; $v_{e}$ is the velocity of the one point of it that coincides with the moving point in this instant. At the next instant it is another point."),
            ),
        ];
        Some(ConceptQuestion { asked, answer })
    }

    /// Asks to which points images apply, and for the images of the links.
    fn images(&self) -> ConceptQuestion {
        let scene = self.scene;
        let moving = scene.links_in_order().into_iter().filter(|l| *l != scene.ground);
        let shown = moving.filter(|l| scene.links[l.0].points.len() >= 3).map(|l| {
            let names: Vec<&str> =
                scene.links[l.0].points.iter().take(3).map(|p| scene.point_name(*p)).collect();
            let plane = name_label(&names.concat());
            let image = plane.to_lowercase();
            say!(self.lang(), "On link {} △${image}$ is similar to △${plane}$.", scene.link_name(l))
        });
        let shown = shown.collect::<Vec<_>>().join(self.lang().pick([" ", ""]));
        let none = tr!(self.lang(), "No moving link here has three named points.");
        ConceptQuestion {
            asked: Phrase::new(tr!(self.lang(),
                "To which points may the velocity and the acceleration image be applied? Which links have one here?"
            )),
            answer: vec![
                self.paragraph(
                    each!("Only to points of one and the same link: their images form a figure similar to the link, with the letters in the same order, turned by 90° in the sense of $\\omega$ for velocities. From the vectors of two points of a link those of all its points follow; points of different links have no common image."),
                ),
                DocumentBlock::Paragraph(Phrase::new(if shown.is_empty() { none } else { &shown })),
            ],
        }
    }
}
