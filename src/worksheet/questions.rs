//! A worksheet with questions on concepts, set and solved from a scene: degree of freedom and class,
//! the number and the kinds of instantaneous centres, and at each slide whether there is a Coriolis
//! acceleration.
//!
//! The problem shows the mechanism with its dimensions and asks; the solution answers each question
//! with its reason. A Coriolis acceleration vanishes in a pose if the guide does not turn there, or
//! if nothing slides along it.

use super::mobility::MobilitySheet;
use super::speak::Speak;
use super::{Document, DocumentBlock, SheetMaker, WorksheetOptions, WorksheetSides, document};
use crate::answer::AnswerValue;
use crate::centres::{CentreMethod, Centres, centres, omega, velocity};
use crate::certified::steps;
use crate::geom::Vec2;
use crate::paper::label::Label;
use crate::paper::phrase::{Phrase, capital};
use crate::plan::names::{name_label, point_label};
use crate::render::math::Math;
use crate::report::centres::CentreWords;
use crate::report::mobility::{Counted, class, kinds};
use crate::scene::{Guide, Lang, LinkId, Scene};
use crate::worked::Worked;

/// Rates below this part of the greatest of their kind are zero.
const ZERO: f64 = 1e-9;

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
        blocks.push(maker.heading(1, "Problem", "题目"));
        blocks.push(maker.paragraph(
            "The figure shows a planar mechanism in a pose of its motion; the arrow marks the driver.",
            "图示为一平面机构在某一瞬时的位置，箭头所示为原动件。",
        ));
        blocks.push(maker.given_mechanism());
        blocks.push(maker.heading(2, "Given", "已知"));
        blocks.push(DocumentBlock::List { numbered: false, members: maker.givens().list() });
        blocks.push(maker.heading(2, "Questions", "思考题"));
        let members = all.iter().map(|q| q.asked.clone()).collect();
        blocks.push(DocumentBlock::List { numbered: true, members });
    }
    if options.sides != WorksheetSides::Problem {
        blocks.push(maker.heading(1, "Answers", "解答"));
        for (k, question) in all.into_iter().enumerate() {
            let number = format!("{}", k + 1);
            let heading = match maker.lang() {
                Lang::En => format!("Question {number}"),
                Lang::Zh => format!("第 {number} 题"),
            };
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
            let guides = self.scene.guides.iter();
            all.extend(guides.filter_map(|g| self.coriolis(g, &found.value)));
        }
        all
    }

    fn answered(&self, en: &str, zh: &str) -> DocumentBlock {
        self.paragraph(en, zh)
    }

    fn freedom(&self, counted: &Counted) -> ConceptQuestion {
        let (f, formula) = counted.formula();
        let drivers = self.scene.own_drivers() as i64;
        let sheet = MobilitySheet { scene: self.scene, options: self.options, drawn: None };
        let verdict = if drivers == 0 { sheet.needed(f) } else { sheet.determined(f, drivers) };
        ConceptQuestion {
            asked: Phrase::new(match self.lang() {
                Lang::En => {
                    "How many degrees of freedom has the mechanism? Is its motion determined, and why?"
                }
                Lang::Zh => "机构的自由度是多少？其运动是否确定？为什么？",
            }),
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
        let answer = match self.lang() {
            Lang::En => format!(
                "Taken apart from the far end: {groups}. The class of a mechanism is the highest class of its groups: class {highest}."
            ),
            Lang::Zh => format!(
                "由远离原动件处依次拆下：{groups}。机构的级别取决于杆组的最高级别：{highest}机构。"
            ),
        };
        Some(ConceptQuestion {
            asked: Phrase::new(match self.lang() {
                Lang::En => {
                    "Into which groups can it be taken apart, and what is the class of the mechanism?"
                }
                Lang::Zh => "机构由哪些基本杆组组成？它是几级机构？",
            }),
            answer: vec![DocumentBlock::Paragraph(Phrase::of_words(&answer))],
        })
    }

    fn of_centres(&self, found: &Centres) -> [ConceptQuestion; 3] {
        let words = CentreWords::marked(found, self.lang());
        let links = found.closure.links.len();
        let count = links * links.saturating_sub(1) / 2;
        let number = ConceptQuestion {
            asked: Phrase::new(match self.lang() {
                Lang::En => "How many instantaneous centres has the mechanism?",
                Lang::Zh => "机构共有多少个速度瞬心？",
            }),
            answer: vec![DocumentBlock::Paragraph(Phrase::new(&match self.lang() {
                Lang::En => format!(
                    "Any two links have one centre, and the ground is one of the links: $N = {links}$, $N(N - 1)/2 = {count}$."
                ),
                Lang::Zh => format!(
                    "每两个构件有一个瞬心，机架也计为构件：$N = {links}$，瞬心数 $N(N - 1)/2 = {count}$。"
                ),
            }))],
        };
        let absolute = links.saturating_sub(1);
        let mut of_kinds = capital(&words.absolute().source());
        of_kinds.push_str(self.tr(".", "。"));
        let kinds = ConceptQuestion {
            asked: Phrase::new(match self.lang() {
                Lang::En => "Which of them are absolute centres, how many are they, and why?",
                Lang::Zh => "其中哪些是绝对瞬心？有几个？为什么？",
            }),
            answer: vec![
                DocumentBlock::Paragraph(Phrase::new(&of_kinds)),
                DocumentBlock::Paragraph(Phrase::new(&match self.lang() {
                    Lang::En => format!(
                        "A centre of a moving link and the ground is absolute: the ground is at rest, so that the velocity of the link is zero there in this instant. Each of the {absolute} moving links has one. At a relative centre two moving links have the same velocity, which is in general not zero."
                    ),
                    Lang::Zh => format!(
                        "活动构件与机架的瞬心是绝对瞬心：机架不动，该瞬时构件上此点的速度为零。{absolute} 个活动构件各有一个。相对瞬心是两个活动构件上速度相同的重合点，其速度一般不为零。"
                    ),
                })),
            ],
        };
        let primary = |c: &&crate::centres::Centre| matches!(c.step.how, CentreMethod::Primary(_));
        let names: Vec<String> = found
            .list
            .iter()
            .filter(primary)
            .map(|c| format!("$P_{{{}}}$", name_label(&c.step.pair.indices(self.scene))))
            .collect();
        let comma = self.tr(", ", "、");
        let direct = ConceptQuestion {
            asked: Phrase::new(match self.lang() {
                Lang::En => {
                    "Which centres are known from the pairs, and which theorem gives the others?"
                }
                Lang::Zh => "哪些瞬心可由运动副直接确定？其余瞬心用什么定理求得？",
            }),
            answer: vec![DocumentBlock::Paragraph(Phrase::new(&match self.lang() {
                Lang::En => format!(
                    "From pairs: {}; a pin is the centre of its links, and a straight slide has its centre at infinity, square to the guide. The others by the theorem of three centres: those of any three links are on one straight line.",
                    names.join(comma)
                ),
                Lang::Zh => format!(
                    "由运动副直接确定：{}；转动副的中心即瞬心，直移动副的瞬心在垂直于导路的无穷远处。其余用三心定理：任意三个构件的三个瞬心共线。",
                    names.join(comma)
                ),
            }))],
        };
        [number, kinds, direct]
    }

    /// Asks for the Coriolis acceleration of a pin in its guide; `None` for a guide without a pin.
    fn coriolis(&self, guide: &Guide, found: &Centres) -> Option<ConceptQuestion> {
        let scene = self.scene;
        // The flank of a cam and the contact of wheels are guides that the file does not have.
        let own = guide.rolling.is_none() && scene.cams.iter().all(|c| c.cam != guide.on);
        let pin = guide.pin.filter(|_| own)?;
        let (point, on) =
            (point_label(scene.point_name(pin)), name_label(scene.link_name(guide.on)));
        let asked = Phrase::new(&match self.lang() {
            Lang::En => format!(
                "Has the acceleration of ${point}$ against the guide on link ${on}$ a Coriolis part? Is it there in this pose?"
            ),
            Lang::Zh => {
                format!("点 ${point}$ 相对构件 ${on}$ 上导路运动时有无科氏加速度？在图示位置呢？")
            }
        });
        let answer = if guide.on == scene.ground {
            self.answered(
                "No: the guide is fixed, its angular velocity is always zero.",
                "没有：导路固定，其角速度恒为零。",
            )
        } else {
            let (turning, sliding) = self.guide_rates(guide, found)?;
            match (turning, sliding) {
                (true, true) => DocumentBlock::Paragraph(Phrase::new(&match self.lang() {
                    Lang::En => format!(
                        "Yes: the guide turns with link ${on}$ and the point slides along it, $a^k = 2\\omega_{{{on}}} v^r$, square to the guide; in this pose neither is zero."
                    ),
                    Lang::Zh => format!(
                        "有：导路随构件 ${on}$ 转动，点又沿导路滑动，$a^k = 2\\omega_{{{on}}} v^r$，方向垂直于导路；图示位置两者都不为零。"
                    ),
                })),
                (false, _) => self.answered(
                    "In this pose there is none: the angular velocity of the guide is zero here.",
                    "图示位置没有：此时导路的角速度为零。",
                ),
                (true, false) => self.answered(
                    "In general yes, for the guide turns; in this pose it is zero, because the point does not slide along the guide here.",
                    "一般有，因为导路转动；但图示位置相对速度为零，科氏加速度为零。",
                ),
            }
        };
        Some(ConceptQuestion { asked, answer: vec![answer] })
    }

    /// Returns whether a guide turns in the pose, and whether its pin slides along it.
    fn guide_rates(&self, guide: &Guide, found: &Centres) -> Option<(bool, bool)> {
        let (scene, worked) = (&found.scene, &found.worked);
        let (solution, at) = (&worked.solution, &worked.configuration);
        let rate = |l: LinkId| match solution.answer(scene, at, &omega(l, None))? {
            AnswerValue::Scalar(x) => Some(x),
            AnswerValue::Vector(_) | AnswerValue::Point(_) => None,
        };
        let speed = |p| match solution.answer(scene, at, &velocity(p))? {
            AnswerValue::Vector(v) => Some(v),
            AnswerValue::Scalar(_) | AnswerValue::Point(_) => None,
        };
        let links = scene.links_in_order();
        let fastest = links.iter().filter_map(|l| rate(*l)).fold(0.0, |m: f64, w| m.max(w.abs()));
        let own = rate(guide.on)?;
        if own.abs() <= ZERO * fastest {
            return Some((false, false));
        }
        let pin = guide.pin?;
        let base =
            scene.links[guide.on.0].points.iter().copied().find(|p| at.points[p.0].is_some())?;
        let arm: Vec2 = at.points[pin.0]? - at.points[base.0]?;
        let carried = speed(base)? + arm.perp() * own;
        let relative = speed(pin)? - carried;
        let size = speed(pin)?.norm().max(carried.norm());
        Some((true, relative.norm() > ZERO * size))
    }
}
