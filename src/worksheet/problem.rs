//! The problem side: statement, given, wanted, the mechanism to scale.

use super::speak::Speak;
use super::{DocumentBlock, SheetMaker};
use crate::figure::fit::to_part;
use crate::figure::mechanism::Overlay;
use crate::figure::sheet::problem_diagram;
use crate::paper::item::Figure;
use crate::paper::phrase::Phrase;
use crate::plan::text::point_label;
use crate::report::amount::symbol;
use crate::report::given::GivenSentences;
use crate::report::statement::paragraphs;
use crate::scene::quantity::combined::Operation;
use crate::scene::quantity::{Frame, Meaning, Of};
use crate::scene::{Asked, DiagramKind, Find, Kind, LinkId, OnLink, PointId};
use crate::worked::Worked;
use hodograph_base::lang::{each, say, tr};

/// A wider drawing is placed in the text, not beside it; one that is also higher leaves no space
/// for the rest of the problem.
const HALF_MM: f64 = 118.0;
const HIGH_MM: f64 = 150.0;
/// Such a drawing is reduced to at most this part of its size.
const SMALLER: f64 = 0.85;

impl SheetMaker<'_> {
    pub(super) fn problem(&self, blocks: &mut Vec<DocumentBlock>) {
        blocks.push(self.heading(1, each!("Problem")));
        let stated = paragraphs(self.scene, self.lang());
        match stated.is_empty() {
            false => blocks.extend(stated.into_iter().map(DocumentBlock::Paragraph)),
            true => blocks.push(self.paragraph(each!(
                "The figure shows a planar mechanism to scale. Solve it by vector polygons."
            ))),
        }
        blocks.push(self.given_mechanism());
        blocks.push(self.heading(2, each!("Given")));
        blocks.push(DocumentBlock::List { numbered: false, members: self.givens().list() });
        blocks.push(self.heading(2, each!("Wanted")));
        blocks.push(DocumentBlock::List { numbered: false, members: self.wanted() });
    }

    /// The wanted quantities, in the order of the scene; quantities of one kind share a line.
    fn wanted(&self) -> Vec<Phrase> {
        let colon = tr!(self.lang(), ": ");
        let mut lines: Vec<Vec<&Find>> = Vec::new();
        for f in &self.scene.find {
            let kind = self.kind(&f.what);
            match lines.iter_mut().find(|l| kind.is_some() && self.kind(&l[0].what) == kind) {
                Some(line) => line.push(f),
                None => lines.push(vec![f]),
            }
        }
        let member = |finds: &Vec<&Find>| {
            let symbols: Vec<String> =
                finds.iter().map(|f| format!("${}$", symbol(f, self.notation()))).collect();
            let words = match (&finds[..], self.kind(&finds[0].what)) {
                ([_, _, ..], Some(kind)) => kind.to_owned(),
                _ => self.asked(&finds[0].what),
            };
            Phrase::new(&format!("{}{colon}{words}", symbols.join(self.lang().comma())))
        };
        lines.iter().map(member).collect()
    }

    /// The common name of several quantities with symbols that say what they belong to.
    fn kind(&self, what: &Asked) -> Option<&'static str> {
        match what.of() {
            Of::Point(OnLink { link: None, .. }) | Of::Link(_) => what.entry().several(self.lang()),
            Of::Point(OnLink { link: Some(_), .. })
            | Of::Points(..)
            | Of::Links(..)
            | Of::Line(..)
            | Of::Seen(..)
            | Of::Mechanism => None,
        }
    }

    /// The given mechanism with its given lengths as dimensions, without points that the solution
    /// constructs, and with a description that gives no answers.
    pub(super) fn given_mechanism(&self) -> DocumentBlock {
        let mut figure = self.given_drawing().0;
        figure.desc = DiagramKind::Plane.caption(self.lang()).into();
        DocumentBlock::Figure { name: "mechanism", figure: Box::new(figure) }
    }

    /// Its drawing, and its μ_l (m/mm).
    pub(super) fn given_drawing(&self) -> (Figure, f64) {
        let bare = |worked: &Worked| {
            let mut bare = worked.clone();
            bare.construction.diagrams.clear();
            bare
        };
        let dimensioned = Overlay { dimensions: true, ..Overlay::default() };
        let figure = problem_diagram(self.scene, &bare(self.worked), self.options, &dimensioned);
        // Dimensions need space; a mechanism that fits neither beside the text nor above it is
        // drawn to a smaller scale.
        let large = figure.width_mm > HALF_MM && figure.height_mm > HIGH_MM;
        match large.then(|| to_part(self.scene, self.worked, self.options, SMALLER)).flatten() {
            Some((scene, worked)) => (
                problem_diagram(&scene, &bare(&worked), self.options, &dimensioned),
                worked.construction.diagram.mu,
            ),
            None => (figure, self.worked.construction.diagram.mu),
        }
    }

    pub(super) fn givens(&self) -> GivenSentences<'_> {
        GivenSentences { scene: self.scene, lang: self.lang() }
    }

    /// A point as a formula.
    fn point(&self, p: PointId) -> String {
        self.givens().point(p)
    }

    /// A wanted quantity in words.
    fn asked(&self, what: &Asked) -> String {
        let spot = |p: &OnLink| match p.link {
            None => self.point(p.point),
            Some(l) => {
                say!(self.lang(), "the point of link {} at {}", self.link(l), self.point(p.point))
            }
        };
        // Coincident points are identified by their place and the two links.
        let of_link = |p: &OnLink| {
            p.link.map_or(spot(p), |l| format!("{} {}", tr!(self.lang(), "link"), self.link(l)))
        };
        let name = what.entry().name(self.lang());
        if let Some(Meaning::Ratio([a, b], arm)) = what.meaning(self.scene) {
            return match arm.map(|h| self.link(h)) {
                None => {
                    say!(self.lang(), "{name} of link {} to link {}", self.link(a), self.link(b))
                }
                Some(h) => say!(
                    self.lang(),
                    "{name} of link {} to link {}, both relative to the arm {h}",
                    self.link(a),
                    self.link(b)
                ),
            };
        }
        if let Asked::Combined(c) = what {
            let [a, b] = c.operands.map(|q| self.asked(&q.asked()));
            return match c.operation {
                Operation::Sum => say!(self.lang(), "the sum of the {a} and the {b}"),
                Operation::Difference => say!(self.lang(), "the difference of the {a} and the {b}"),
                Operation::Ratio => say!(self.lang(), "the ratio of the {a} to the {b}"),
            };
        }
        if let Asked::FromCentre(q) = what {
            let ([a, b], point) = (q.centre.links.map(|(l, _)| self.link(l)), self.point(q.point));
            return say!(
                self.lang(),
                "distance of {point} from the instantaneous centre of links {a} and {b}"
            );
        }
        let lang = self.lang();
        match what.of() {
            // A name of a link ends with its own particle in Chinese.
            Of::Point(p) if p.link.is_some() => say!(lang, "of a link" => "{name} of {}", spot(&p)),
            Of::Point(p) => say!(lang, "{name} of {}", spot(&p)),
            Of::Points(a, b) if a.point == b.point && a.link.is_none() => {
                say!(
                    lang,
                    "{name} at {}, of {} relative to {}",
                    self.point(a.point),
                    of_link(&a),
                    of_link(&b)
                )
            }
            Of::Points(a, b) if a.point == b.point => {
                say!(lang, "of a link" => "{name} at {}, of {} relative to {}", self.point(a.point), of_link(&a), of_link(&b))
            }
            Of::Points(a, b) => say!(lang, "{name} of {} relative to {}", spot(&a), spot(&b)),
            Of::Link(l) => say!(lang, "{name} of link {}", self.link(l)),
            Of::Links(a, b) if what.entry().symbol == "P" => {
                let fixed = |l: LinkId| l == self.scene.ground;
                let moving = if fixed(a) { self.link(b) } else { self.link(a) };
                match fixed(a) || fixed(b) {
                    true => say!(lang, "absolute instantaneous centre of link {moving}"),
                    false => say!(
                        lang,
                        "relative instantaneous centre of links {} and {}",
                        self.link(a),
                        self.link(b)
                    ),
                }
            }
            // The names of the table say what they belong to.
            Of::Mechanism => name.to_string(),
            Of::Links(a, b) if what.kind() == Kind::Force => {
                say!(lang, "{name} of link {} on link {}", self.link(a), self.link(b))
            }
            Of::Links(a, b) => {
                say!(lang, "{name} of link {} relative to link {}", self.link(a), self.link(b))
            }
            Of::Seen(p, frame) => {
                let own = match frame {
                    Frame::Link(l) => say!(lang, "is fixed to link {}", self.link(l)),
                    Frame::Point(c) => say!(lang, "translates with {}", spot(&c)),
                };
                say!(lang, "{name} of the moving point {}; the frame {own}", spot(&p))
            }
            Of::Line(a, b) => {
                format!(
                    "{name} ${}{}$",
                    point_label(self.scene.point_name(a)),
                    point_label(self.scene.point_name(b))
                )
            }
        }
    }
}
