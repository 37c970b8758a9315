//! A worksheet on mobility: count the degree of freedom of a mechanism and split it into groups.
//!
//! The problem shows the mechanism with its dimensions; nothing is dashed and no count is given.
//! The author's text about the scene is left out: it asks for the motion and may reveal redundant
//! constraints. The solution counts in a table, with every special case in words, and draws the
//! groups apart. For a scene with links and pairs only, these are listed and nothing is drawn.

use super::solution::replacing;
use super::speak::Speak;
use super::{
    Document, DocumentBlock, DocumentTable, SheetMaker, TableKind, WorksheetOptions,
    WorksheetSides, document, pairs,
};
use crate::certified::steps;
use crate::figure::groups;
use crate::figure::sheet;
use crate::mechanism::{Counts, ForDrivers};
use crate::paper::label::Label;
use crate::paper::phrase::Phrase;
use crate::render::math::Math;
use crate::report::mobility::{Counted, class, kinds};
use crate::report::plan::group_set;
use crate::scene::{Driver, Guide, Lang, LinkId, PointId, Scene};
use crate::worked::Worked;

/// Makes the worksheet of a scene that is solved for [`crate::worked::Scope::Figure`].
pub fn mobility(scene: &Scene, worked: &Worked, options: &WorksheetOptions) -> Document {
    let told = steps(scene, worked, None);
    let drawn = SheetMaker { scene, worked, options: &options.sheet, certified: &[], told: &told };
    MobilitySheet { scene, options: &options.sheet, drawn: Some(drawn) }.document(options)
}

/// Makes the worksheet of links and pairs ([`crate::scene::read_topology`]), which are listed, not
/// drawn.
///
/// ```
/// use hodograph::{scene, worksheet};
/// let text = r#"{"links": {"1": ["A", "D"], "2": ["A", "B"], "3": ["B", "C"], "4": ["C", "D"]}, "ground": "1"}"#;
/// let scene = scene::read_topology(text).unwrap().value;
/// let document = worksheet::mobility_of_pairs(&scene, &worksheet::WorksheetOptions::of_language(scene::Lang::En));
/// assert_eq!(document.blocks[0], worksheet::DocumentBlock::Heading(1, "Problem".into()));
/// ```
pub fn mobility_of_pairs(scene: &Scene, options: &WorksheetOptions) -> Document {
    MobilitySheet { scene, options: &options.sheet, drawn: None }.document(options)
}

/// The input of the sheet.
pub(super) struct MobilitySheet<'a> {
    pub scene: &'a Scene,
    pub options: &'a sheet::SheetOptions,
    /// The maker of drawings, if the pose is given.
    pub drawn: Option<SheetMaker<'a>>,
}

impl Speak for MobilitySheet<'_> {
    fn lang(&self) -> Lang {
        self.options.lang
    }
}

impl MobilitySheet<'_> {
    fn document(&self, options: &WorksheetOptions) -> Document {
        let counted = Counted::of(self.scene);
        let mut blocks = Vec::new();
        if options.sides != WorksheetSides::Solution {
            self.asked_to_count(&mut blocks);
        }
        if options.sides != WorksheetSides::Problem {
            self.count(&mut blocks, &counted);
            self.split(&mut blocks, &counted);
        }
        document(self.scene, options, blocks)
    }

    fn link(&self, l: LinkId) -> &str {
        self.scene.link_name(l)
    }

    fn asked_to_count(&self, blocks: &mut Vec<DocumentBlock>) {
        blocks.push(self.heading(1, "Problem", "题目"));
        match &self.drawn {
            Some(maker) => {
                blocks.push(self.paragraph(
                    "The figure shows a planar mechanism; the arrow marks the driver.",
                    "图示为一平面机构，箭头所示为原动件。",
                ));
                blocks.push(whole(maker));
                blocks.push(self.heading(2, "Given", "已知"));
                blocks
                    .push(DocumentBlock::List { numbered: false, members: maker.givens().list() });
            }
            None => {
                blocks.push(self.paragraph(
                    "A planar mechanism consists of these links and pairs:",
                    "某平面机构由下列构件和运动副组成：",
                ));
                blocks.push(DocumentBlock::List {
                    numbered: false,
                    members: pairs::listed(self.scene, self.lang()),
                });
            }
        }
        blocks.push(self.heading(2, "Wanted", "求"));
        let determined = match (self.scene.drivers.is_empty(), self.lang()) {
            (false, Lang::En) => "; is the motion of the mechanism determined?",
            (false, Lang::Zh) => "；机构是否具有确定的运动？",
            (true, Lang::En) => "; how many drivers does it need?",
            (true, Lang::Zh) => "；机构需要几个原动件？",
        };
        let formula = "$F = 3n - (2p_l + p_h - p') - F'$";
        let members = [
            self.tr(
                "Compound hinges, local freedoms and virtual constraints, each with its reason.",
                "指出复合铰链、局部自由度和虚约束，并说明理由。",
            )
            .to_owned(),
            match self.lang() {
                Lang::En => format!("The degree of freedom {formula}{determined}"),
                Lang::Zh => format!("计算自由度 {formula}{determined}"),
            },
            self.tr(
                "The groups into which it is taken apart, beginning far from the drivers, each with its class; and the class of the mechanism.",
                "由远离原动件处开始拆杆组，指出各杆组的级别，并确定机构的级别。",
            )
            .to_owned(),
        ];
        blocks.push(DocumentBlock::List {
            numbered: true,
            members: members.map(|m| Phrase::new(&m)).to_vec(),
        });
    }

    fn said(&self, both: &crate::diag::Both) -> Phrase {
        Phrase::of_words(if self.lang() == Lang::En { &both.en } else { &both.zh })
    }

    fn count(&self, blocks: &mut Vec<DocumentBlock>, counted: &Counted) {
        blocks.push(self.heading(1, "Solution", "解"));
        blocks.push(self.heading(2, "Degree of freedom", "自由度"));
        let Counts { moving, lower, higher } = counted.survey.counts;
        let head = [self.tr("quantity", "量"), self.tr("number", "数目"), self.tr("which", "说明")]
            .map(Phrase::new)
            .to_vec();
        let mut rows = vec![head];
        let mut row = |name: &str, number: usize, reasons: Vec<Phrase>| {
            let mut reasons = reasons.into_iter();
            rows.push(vec![
                Phrase::new(name),
                Phrase::new(&format!("${number}$")),
                reasons.next().unwrap_or_default(),
            ]);
            rows.extend(reasons.map(|r| vec![Phrase::default(), Phrase::default(), r]));
        };
        let links = self.scene.links_in_order().into_iter().filter(|l| *l != self.scene.ground);
        let names: Vec<&str> = links.map(|l| self.link(l)).collect();
        let which =
            if names.len() == moving { names.join(self.words().comma) } else { String::new() };
        row(self.tr("moving links $n$", "活动构件 $n$"), moving, vec![Phrase::of_words(&which)]);
        row(
            self.tr("lower pairs $p_l$", "低副 $p_l$"),
            lower,
            counted.lower(self.scene, self.lang()),
        );
        row(self.tr("higher pairs $p_h$", "高副 $p_h$"), higher, Vec::new());
        let local: Vec<Phrase> = counted.local().iter().map(|b| self.said(b)).collect();
        row(self.tr("local freedoms $F'$", "局部自由度 $F'$"), local.len(), local.clone());
        row(
            self.tr("virtual constraints $p'$", "虚约束 $p'$"),
            counted.sure,
            counted.repeats().iter().map(|b| self.said(b)).collect(),
        );
        blocks.push(DocumentBlock::Table(DocumentTable { kind: TableKind::Values, rows }));
        let (f, formula) = counted.formula();
        blocks.push(DocumentBlock::Formula(vec![Math::Row(Label::math(formula))]));
        self.substituted(blocks, counted);
        let drivers = self.scene.own_drivers() as i64;
        let verdict = if drivers == 0 { self.needed(f) } else { self.determined(f, drivers) };
        blocks.push(DocumentBlock::Paragraph(Phrase::new(&verdict)));
    }

    /// Sentence: the number of drivers that a mechanism without drivers needs.
    pub fn needed(&self, f: i64) -> String {
        match (f, self.lang()) {
            (..=0, Lang::En) => "It cannot move.".to_owned(),
            (..=0, Lang::Zh) => "它不能运动，不是机构。".to_owned(),
            (1, Lang::En) => "It needs one driver.".to_owned(),
            (_, Lang::En) => format!("It needs {f} drivers."),
            (_, Lang::Zh) => format!("需要 {f} 个原动件，机构才具有确定的运动。"),
        }
    }

    /// Sentence: whether this number of drivers determines the motion.
    pub fn determined(&self, f: i64, drivers: i64) -> String {
        match (f == drivers, self.lang()) {
            (true, Lang::En) => {
                format!("As many freedoms as drivers ({drivers}): the motion is determined.")
            }
            (true, Lang::Zh) => format!("自由度等于原动件数（{drivers}），机构具有确定的运动。"),
            (false, Lang::En) => format!(
                "{f} freedoms, {drivers} drivers: what carried parts do by themselves is not driven."
            ),
            (false, Lang::Zh) => {
                format!("自由度为 {f}，原动件数为 {drivers}：其余自由度不由原动件确定。")
            }
        }
    }

    fn substituted(&self, blocks: &mut Vec<DocumentBlock>, counted: &Counted) {
        let s = counted.substituted();
        if s == counted.survey.counts {
            return;
        }
        blocks.push(self.paragraph(
            "Without local freedoms and virtual constraints, every higher pair replaced by a link with two lower pairs:",
            "去掉局部自由度和虚约束，并将高副低代：",
        ));
        let (n, p) = (s.moving, s.lower);
        let formula = format!(
            "n = {n} ,\\quad p_l = {p} ,\\quad F = 3 \\times {n} - 2 \\times {p} = {}",
            s.freedom(0, 0)
        );
        blocks.push(DocumentBlock::Formula(vec![Math::Row(Label::math(formula))]));
    }

    fn split(&self, blocks: &mut Vec<DocumentBlock>, counted: &Counted) {
        let given = counted.survey.choices.iter().find(|c| c.given);
        let Some(given) = given.or(counted.survey.choices.first()) else { return };
        blocks.push(self.heading(2, "Groups", "杆组"));
        let (driven, highest) = (self.driven(given), class(given, self.lang()));
        blocks.push(DocumentBlock::Paragraph(Phrase::of_words(&match self.lang() {
            Lang::En => {
                format!("Driver: {driven}. From the far end, one group after another is removed:")
            }
            Lang::Zh => format!("原动件为{driven}。由远离原动件处开始，依次拆下："),
        })));
        let replaced = given.replaced();
        let listed = replaced.as_ref().unwrap_or(given);
        let members = listed
            .from_the_far_end()
            .into_iter()
            .map(|g| group_set(&listed.scene, &listed.mechanism, &g, self.lang()));
        blocks.push(DocumentBlock::List { numbered: true, members: members.collect() });
        blocks.extend(replacing(&given.scene, self.lang()));
        let (style, notation) = (&self.options.style, &self.options.notation);
        let drawn = |maker: &SheetMaker| {
            groups::figure(self.scene, maker.worked, style, notation, self.lang()).ok()
        };
        if let Some(figure) = self.drawn.as_ref().and_then(drawn) {
            blocks.push(DocumentBlock::Figure { name: "groups", figure: Box::new(figure) });
        }
        blocks.push(DocumentBlock::Paragraph(Phrase::of_words(&match self.lang() {
            Lang::En => {
                format!("The driver and the ground remain. The class of the mechanism is the highest class of its groups: class {highest}.")
            }
            Lang::Zh => format!("最后剩下原动件和机架。机构的级别取决于杆组的最高级别：{highest}机构。"),
        })));
        let others: Vec<&ForDrivers> = counted.survey.choices.iter().filter(|c| !c.given).collect();
        if others.is_empty() {
            return;
        }
        blocks.push(self.heading(2, "Other drivers", "换用其他原动件"));
        let head = [
            self.tr("driver", "原动件"),
            self.tr("class", "机构级别"),
            self.tr("groups from the far end", "由远端拆下的杆组"),
        ];
        let mut rows = vec![head.map(Phrase::new).to_vec()];
        for c in others {
            let cells = [self.driven(c), class(c, self.lang()).to_owned(), kinds(c, self.lang())];
            rows.push(cells.iter().map(|c| Phrase::of_words(c)).collect());
        }
        blocks.push(DocumentBlock::Table(DocumentTable { kind: TableKind::Values, rows }));
    }

    /// The driven part: `link 2`, `the slider at C`.
    fn driven(&self, choice: &ForDrivers) -> String {
        let scene = &choice.scene;
        let link = |l: LinkId| format!("{} {}", self.tr("link", "构件"), scene.link_name(l));
        let turned = |l: LinkId, against: LinkId| match self.lang() {
            _ if against == scene.ground => link(l),
            Lang::En => format!("{} against {}", link(l), link(against)),
            Lang::Zh => format!("{}（相对{}）", link(l), link(against)),
        };
        let slid = |guide: &Guide| match (guide.slider, self.lang()) {
            (Some(l), _) => link(l),
            (None, Lang::En) => {
                format!("the pin {} in its slot", guide.pin.map_or("", |p| scene.point_name(p)))
            }
            (None, Lang::Zh) => {
                format!("槽中的销 {}", guide.pin.map_or("", |p| scene.point_name(p)))
            }
        };
        let cylinder = |[a, b]: [PointId; 2]| {
            format!(
                "{} {}{}",
                self.tr("the cylinder", "液压缸"),
                scene.point_name(a),
                scene.point_name(b)
            )
        };
        let one = |d: &Driver| {
            let turned = d.kind.turned().map(|(l, against)| turned(l, against));
            let slid = || d.kind.guide().map(|g| slid(&scene.guides[g.0]));
            turned.or_else(slid).or_else(|| d.kind.ends().map(cylinder)).unwrap_or_default()
        };
        let own = scene.drivers.iter().enumerate().filter(|(d, _)| !scene.is_led(*d));
        own.map(|(_, d)| one(d)).collect::<Vec<_>>().join(self.words().comma)
    }
}

/// The mechanism with redundant parts drawn like all others.
fn whole(maker: &SheetMaker) -> DocumentBlock {
    let mut bare = maker.worked.clone();
    bare.mechanism.redundant.clear();
    SheetMaker { worked: &bare, ..*maker }.given_mechanism()
}
