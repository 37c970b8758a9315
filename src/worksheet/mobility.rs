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
use hodograph_base::lang::{each, say, tr};

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
        blocks.push(self.heading(1, each!("Problem")));
        match &self.drawn {
            Some(maker) => {
                blocks.push(self.paragraph(each!(
                    "The figure shows a planar mechanism; the arrow marks the driver."
                )));
                blocks.push(whole(maker));
                blocks.push(self.heading(2, each!("Given")));
                blocks
                    .push(DocumentBlock::List { numbered: false, members: maker.givens().list() });
            }
            None => {
                blocks.push(
                    self.paragraph(each!("A planar mechanism consists of these links and pairs:")),
                );
                blocks.push(DocumentBlock::List {
                    numbered: false,
                    members: pairs::listed(self.scene, self.lang()),
                });
            }
        }
        blocks.push(self.heading(2, each!("Wanted")));
        let determined = match self.scene.drivers.is_empty() {
            false => tr!(self.lang(), "; is the motion of the mechanism determined?"),
            true => tr!(self.lang(), "; how many drivers does it need?"),
        };
        let formula = "$F = 3n - (2p_l + p_h - p') - F'$";
        let members = [
            tr!(self.lang(),
                "Compound hinges, local freedoms and virtual constraints, each with its reason."
            )
            .to_owned(),
            say!(self.lang(), "The degree of freedom {formula}{determined}"),
            tr!(self.lang(),
                "The groups into which it is taken apart, beginning far from the drivers, each with its class; and the class of the mechanism."
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
        blocks.push(self.heading(1, each!("Solution")));
        blocks.push(self.heading(2, each!("Degree of freedom")));
        let Counts { moving, lower, higher } = counted.survey.counts;
        let head =
            [tr!(self.lang(), "quantity"), tr!(self.lang(), "number"), tr!(self.lang(), "which")]
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
            if names.len() == moving { names.join(self.lang().comma()) } else { String::new() };
        row(tr!(self.lang(), "moving links $n$"), moving, vec![Phrase::of_words(&which)]);
        row(tr!(self.lang(), "lower pairs $p_l$"), lower, counted.lower(self.scene, self.lang()));
        row(tr!(self.lang(), "higher pairs $p_h$"), higher, Vec::new());
        let local: Vec<Phrase> = counted.local().iter().map(|b| self.said(b)).collect();
        row(tr!(self.lang(), "local freedoms $F'$"), local.len(), local.clone());
        row(
            tr!(self.lang(), "virtual constraints $p'$"),
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
        match f {
            ..=0 => tr!(self.lang(), "It cannot move.").to_owned(),
            1 => say!(self.lang(), "It needs one driver."),
            _ => say!(self.lang(), "It needs {f} drivers."),
        }
    }

    /// Sentence: whether this number of drivers determines the motion.
    pub fn determined(&self, f: i64, drivers: i64) -> String {
        match f == drivers {
            true => say!(
                self.lang(),
                "As many freedoms as drivers ({drivers}): the motion is determined."
            ),
            false => say!(
                self.lang(),
                "{f} freedoms, {drivers} drivers: what carried parts do by themselves is not driven."
            ),
        }
    }

    fn substituted(&self, blocks: &mut Vec<DocumentBlock>, counted: &Counted) {
        let s = counted.substituted();
        if s == counted.survey.counts {
            return;
        }
        blocks.push(self.paragraph(
            each!("Without local freedoms and virtual constraints, every higher pair replaced by a link with two lower pairs:"),
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
        blocks.push(self.heading(2, each!("Groups")));
        let (driven, highest) = (self.driven(given), class(given, self.lang()));
        blocks.push(DocumentBlock::Paragraph(Phrase::of_words(&say!(
            self.lang(),
            "Driver: {driven}. From the far end, one group after another is removed:"
        ))));
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
        blocks.push(DocumentBlock::Paragraph(Phrase::of_words(&say!(self.lang(), "The driver and the ground remain. The class of the mechanism is the highest class of its groups: class {highest}."))));
        let others: Vec<&ForDrivers> = counted.survey.choices.iter().filter(|c| !c.given).collect();
        if others.is_empty() {
            return;
        }
        blocks.push(self.heading(2, each!("Other drivers")));
        let head = [
            tr!(self.lang(), "driver"),
            tr!(self.lang(), "class"),
            tr!(self.lang(), "groups from the far end"),
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
        let link = |l: LinkId| format!("{} {}", tr!(self.lang(), "link"), scene.link_name(l));
        let turned = |l: LinkId, against: LinkId| match against == scene.ground {
            true => link(l),
            false => say!(self.lang(), "{} against {}", link(l), link(against)),
        };
        let slid = |guide: &Guide| match guide.slider {
            Some(l) => link(l),
            None => say!(
                self.lang(),
                "the pin {} in its slot",
                guide.pin.map_or("", |p| scene.point_name(p))
            ),
        };
        let cylinder = |[a, b]: [PointId; 2]| {
            format!(
                "{} {}{}",
                tr!(self.lang(), "the cylinder"),
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
        own.map(|(_, d)| one(d)).collect::<Vec<_>>().join(self.lang().comma())
    }
}

/// The mechanism with redundant parts drawn like all others.
fn whole(maker: &SheetMaker) -> DocumentBlock {
    let mut bare = maker.worked.clone();
    bare.mechanism.redundant.clear();
    SheetMaker { worked: &bare, ..*maker }.given_mechanism()
}
