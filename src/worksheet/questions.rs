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
use crate::scene::{Lang, Scene};
use crate::worked::Worked;

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
        }
        all.push(self.images());
        all.extend(self.transport());
        if let Ok((_, slides)) = coriolis(self.scene) {
            all.extend(slides.iter().filter_map(|s| self.coriolis(s)));
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
    fn coriolis(&self, s: &SlideCoriolis) -> Option<ConceptQuestion> {
        let scene = self.scene;
        let guide = &scene.guides[s.guide.0];
        // The flank of a cam is a guide that the file does not have.
        let own = scene.cams.iter().all(|c| c.cam != guide.on);
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
        let answer = match s.verdict {
            CoriolisVerdict::GuideFixed => self.answered(
                "No: the guide is fixed, its angular velocity is always zero.",
                "没有：导路固定，其角速度恒为零。",
            ),
            CoriolisVerdict::GuideTranslates => self.answered(
                "No: the guide translates, its angular velocity is always zero.",
                "没有：导路作平移，其角速度恒为零。",
            ),
            CoriolisVerdict::Present => DocumentBlock::Paragraph(Phrase::new(&match self.lang() {
                Lang::En => format!(
                    "Yes: the guide turns with link ${on}$ and the point slides along it, $a^k = 2\\omega_{{{on}}} v^r$, square to the guide; in this pose neither is zero."
                ),
                Lang::Zh => format!(
                    "有：导路随构件 ${on}$ 转动，点又沿导路滑动，$a^k = 2\\omega_{{{on}}} v^r$，方向垂直于导路；图示位置两者都不为零。"
                ),
            })),
            CoriolisVerdict::GuideDwells => self.answered(
                "In this pose there is none: the angular velocity of the guide is zero here.",
                "图示位置没有：此时导路的角速度为零。",
            ),
            CoriolisVerdict::NoSliding => self.answered(
                "In general yes, for the guide turns; in this pose it is zero, because the point does not slide along the guide here.",
                "一般有，因为导路转动；但图示位置相对速度为零，科氏加速度为零。",
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
        let asked = Phrase::new(&match self.lang() {
            Lang::En => format!(
                "{heading}: what are its absolute, relative and transport motion? Of which point is $v_{{e}}$ the velocity?"
            ),
            Lang::Zh => format!(
                "{heading}，其绝对运动、相对运动和牵连运动各是什么运动？$v_{{e}}$ 是哪一点的速度？"
            ),
        });
        let motions = format!("{}{}", words.three_motions(&choice).source(), self.tr(".", "。"));
        let answer = vec![
            DocumentBlock::Paragraph(Phrase::new(&motions)),
            self.paragraph(
                "The transport motion is a motion of the frame, a body; $v_{e}$ is the velocity of the one point of it that coincides with the moving point in this instant. At the next instant it is another point.",
                "牵连运动是动系（刚体）的运动；$v_{e}$ 是该瞬时动系上与动点重合的那一点（牵连点）的速度，下一瞬时牵连点是动系上的另一点。",
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
            match self.lang() {
                Lang::En => {
                    format!("On link {} △${image}$ is similar to △${plane}$.", scene.link_name(l))
                }
                Lang::Zh => {
                    format!("构件 {} 上 △${image}$ 与 △${plane}$ 相似。", scene.link_name(l))
                }
            }
        });
        let shown = shown.collect::<Vec<_>>().join(self.tr(" ", ""));
        let none = self.tr(
            "No moving link here has three named points.",
            "本机构中没有含三个命名点的活动构件。",
        );
        ConceptQuestion {
            asked: Phrase::new(self.tr(
                "To which points may the velocity and the acceleration image be applied? Which links have one here?",
                "速度影像和加速度影像适用于哪些点？本机构哪些构件可用？",
            )),
            answer: vec![
                self.paragraph(
                    "Only to points of one and the same link: their images form a figure similar to the link, with the letters in the same order, turned by 90° in the sense of $\\omega$ for velocities. From the vectors of two points of a link those of all its points follow; points of different links have no common image.",
                    "只适用于同一构件上的点：各点的影像与构件上的图形相似，字母顺序一致，速度影像相对构件沿 $\\omega$ 方向转过 90°。已知同一构件上两点的速度（加速度），即可求该构件上任一点的速度（加速度）；不同构件上的点不能用影像求解。",
                ),
                DocumentBlock::Paragraph(Phrase::new(if shown.is_empty() { none } else { &shown })),
            ],
        }
    }
}
