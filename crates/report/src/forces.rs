//! Forces in words: symbols, equations of equilibrium with their tables, moments, results of the
//! polygons.

mod checks;
mod friction;
mod masses;
mod plan;
mod steps;
mod symbols;

use hodograph_base::digits::{inked, significant};
use hodograph_base::geom::Vec2;
use hodograph_base::lang::{say, tr};
use hodograph_base::notation::Notation;
use hodograph_board::construction::{MarkId, NumberId};
use hodograph_board::equilibrium::{
    About, Equilibrium, ForceEdge, ForceTerm, GroupForces, MomentResult, Moments, Party,
};
use hodograph_board::plan::names::name_label;
use hodograph_paper::paper::phrase::Phrase;
use hodograph_scene::{Kind, Lang, Scene};

/// Digits of measured lengths and forces in sentences: one more than a ruler provides.
const DIGITS: usize = 4;

/// Largest arm (mm) that is attributed to rounding.
const NO_ARM_MM: f64 = 1e-6;

/// Number of terms of a sum of moments per line; of forces four times as many.
const TOGETHER: usize = 2;
/// The end of a formula and the start of the next: a line may break between them.
const BREAK: &str = "$ $";

/// A writer for the forces of a scene.
#[derive(Clone, Copy)]
pub struct ForceWriter<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Notation of the marks.
    pub notation: &'a Notation,
    /// Language.
    pub lang: Lang,
    /// The equilibrium as drawn.
    pub of: &'a Equilibrium,
}

/// A column of an equation's table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ForceColumn {
    /// The force.
    pub symbol: String,
    /// True if its magnitude is known.
    pub magnitude: bool,
}

/// A sum of moments in the label language.
#[derive(Default)]
struct MomentSum {
    text: String,
    terms: usize,
}

impl MomentSum {
    /// Adds a term with the sign of its moment.
    fn add(&mut self, moment: f64, text: String) {
        let sign = match (moment < 0.0, self.terms) {
            (true, 0) => "−",
            (true, _) => "− ",
            (false, 0) => "",
            (false, _) => "+ ",
        };
        let before = match self.terms % TOGETHER {
            _ if self.terms == 0 => "",
            0 => BREAK,
            _ => " ",
        };
        // A sign at the start of a formula has no space around it.
        let space = if before == BREAK { "\\," } else { "" };
        self.text += &format!("{before}{sign}{space}{text}");
        self.terms += 1;
    }
}

impl ForceWriter<'_> {
    /// Returns the direction of a force, from any group that draws it.
    pub fn direction(&self, term: ForceTerm) -> Option<Vec2> {
        if let ForceTerm::Load(k) = term {
            return self.of.loads[k].wrench.force.unit();
        }
        let ForceTerm::Reaction { of, on, part } = term else { return None };
        let opposite = match of {
            Party::Link(l) => Some(ForceTerm::Reaction { of: Party::Link(on), on: l, part }),
            Party::Pin(_) | Party::Cylinder(_) | Party::Driver(_) => None,
        };
        let find = |t: ForceTerm| {
            let mut sides = self.of.groups.iter().flat_map(|g| g.sides.iter().chain(&g.diagonals));
            sides.find(|s| s.term == t).and_then(|s| self.of.force(s.vector)?.unit())
        };
        find(term).or_else(|| opposite.and_then(find))
    }

    /// Returns the equations of a group, each a list of forces with a sum of zero.
    pub fn equations(&self, group: &GroupForces) -> Vec<Vec<ForceEdge>> {
        if group.kind != "RPP" {
            return vec![group.sides.clone()];
        }
        // The first equation starts and ends at the intersection.
        let v = |side: &ForceEdge| &self.of.construction.vectors[side.vector.index()];
        let Some(first) = group.sides.first() else { return Vec::new() };
        let crossing = v(first).from;
        let end = group
            .sides
            .iter()
            .position(|s| v(s).to == crossing)
            .map_or(group.sides.len(), |k| k + 1);
        let rest =
            group.diagonals.first().copied().into_iter().chain(group.sides[end..].iter().copied());
        vec![group.sides[..end].to_vec(), rest.collect()]
    }

    /// Returns an equation in the label language: `F_{12} + G_{2} + F_{32} = 0`.
    pub fn equation(&self, sides: &[ForceEdge]) -> String {
        let symbols: Vec<String> =
            sides.iter().map(|s| self.notation.vectors.write(self.symbol(s.term))).collect();
        let lines: Vec<String> =
            symbols.chunks(4 * TOGETHER).map(|line| line.join(" + ")).collect();
        // A sign at the start of a formula has no space around it.
        format!("{} = 0", lines.join(&format!("{BREAK}+\\,")))
    }

    /// Returns the table of an equation.
    pub fn columns(&self, sides: &[ForceEdge]) -> Vec<ForceColumn> {
        sides
            .iter()
            .map(|s| ForceColumn {
                symbol: self.notation.vectors.write(self.symbol(s.term)),
                magnitude: s.known,
            })
            .collect()
    }

    /// Returns the vertices of a group with their letters, in the order of the equation, then those
    /// on diagonals only.
    pub fn letters(&self, group: &GroupForces) -> Vec<(MarkId, String)> {
        let mut out: Vec<MarkId> = Vec::new();
        for side in group.sides.iter().chain(&group.diagonals) {
            let v = &self.of.construction.vectors[side.vector.index()];
            for mark in [v.from, v.to] {
                if !out.contains(&mark) {
                    out.push(mark);
                }
            }
        }
        out.into_iter().enumerate().map(|(k, mark)| (mark, letter(k))).collect()
    }

    /// Returns the heading of a group: `Links 4, 5 (RRP)`.
    pub fn heading(&self, group: &GroupForces) -> String {
        let names: Vec<&str> = group.links.iter().map(|l| self.scene.link_name(*l)).collect();
        let kind = match group.kind {
            "driver" => tr!(self.lang, "driver"),
            "RH" => tr!(self.lang, "pivot and one line of action"),
            "PH" => tr!(self.lang, "guide and one line of action"),
            "III" => tr!(self.lang, "class III"),
            "IV" => tr!(self.lang, "class IV"),
            "VI" => tr!(self.lang, "class VI"),
            kind => kind,
        };
        let links = names.join(self.lang.comma());
        match names.len() {
            1 => say!(self.lang, "Link {links} ({kind})"),
            _ => say!(self.lang, "Links {links} ({kind})"),
        }
    }

    /// Returns an amount with its unit; a length in the unit of small lengths.
    fn amount(&self, kind: Kind, si: f64) -> String {
        let (unit, per_si) = self.scene.book.fine(kind);
        format!("{}\\,{unit}", inked(&significant(si * per_si, DIGITS)))
    }

    fn number(&self, id: NumberId) -> f64 {
        self.of.drawn.number(id).unwrap_or(f64::NAN)
    }

    /// Returns the magnitude of a force (N).
    fn size(&self, group: &GroupForces, term: ForceTerm) -> Option<f64> {
        let side = group.sides.iter().chain(&group.diagonals).find(|s| s.term == term)?;
        self.of.force(side.vector).map(|f| f.norm())
    }

    /// Returns the arm (m) of a force with a known moment.
    pub fn arm(&self, moments: &Moments, k: usize) -> Option<f64> {
        let (term, _, id) = moments.of.get(k)?;
        let force = self.strength(*term)?;
        (force > 0.0).then(|| (self.number(*id) / force).abs())
    }

    /// Returns the magnitude of a force, from any group that draws it.
    fn strength(&self, term: ForceTerm) -> Option<f64> {
        if let ForceTerm::Load(k) = term {
            return Some(self.of.loads[k].wrench.force.norm());
        }
        let ForceTerm::Reaction { of, on, part } = term else { return None };
        let opposite = match of {
            Party::Link(l) => Some(ForceTerm::Reaction { of: Party::Link(on), on: l, part }),
            Party::Pin(_) | Party::Cylinder(_) | Party::Driver(_) => None,
        };
        let find = |t: ForceTerm| self.of.groups.iter().find_map(|g| self.size(g, t));
        find(term).or_else(|| opposite.and_then(find))
    }

    /// Returns a sentence on moments: the terms, with arms as measured, and the result.
    pub fn moments(&self, m: &Moments) -> String {
        let names: Vec<&str> = m.links.iter().map(|l| self.scene.link_name(*l)).collect();
        let about = match m.about {
            About::Point(_) => format!("${}$", self.about(m.about)),
            About::Crossing { of, .. } => {
                let ([a, b], point) = (of.map(|t| self.symbol(t)), self.about(m.about));
                say!(self.lang, "${point}$, where the lines of ${a}$ and ${b}$ cross")
            }
        };
        let mut sum = MomentSum::default();
        for (k, (term, ..)) in m.of.iter().enumerate() {
            let moment = self.number(m.of[k].2);
            // A line of action through the point has no moment, except for rounding.
            let Some(arm) = self.arm(m, k).filter(|arm| *arm > NO_ARM_MM * 1e-3) else { continue };
            sum.add(
                moment,
                format!("{}\\cdot {}", self.symbol(*term), self.amount(Kind::Length, arm)),
            );
        }
        for (term, id) in &m.couples {
            sum.add(self.number(*id), self.couple(*term));
        }
        let value = self.number(m.value);
        let (given, result) = match m.gives {
            MomentResult::Force(term, _) => {
                let symbol = self.symbol(term);
                (
                    format!("{symbol}\\,l"),
                    format!("|{symbol}| = {}", self.amount(Kind::Force, value.abs())),
                )
            }
            MomentResult::Offset(guide) => {
                let pair = self.pair(guide);
                let force = self
                    .of
                    .forces
                    .guides
                    .iter()
                    .find(|(own, _)| *own == guide)
                    .map_or(0.0, |(_, w)| w.force.norm());
                let pair = name_label(&pair);
                let result = match force > 0.0 {
                    true => format!(
                        "h_{{{pair}}} = {}",
                        self.amount(Kind::Length, (value / force).abs())
                    ),
                    false => format!("M_{{{pair}}} = {}", self.amount(Kind::Moment, value)),
                };
                (format!("M_{{{pair}}}"), result)
            }
            MomentResult::Driver(d) => {
                let symbol = self.balance(d);
                (symbol.clone(), format!("{symbol} = {}", self.amount(Kind::Moment, value)))
            }
            MomentResult::Trial { force, tried, left } => {
                return self.trial(m, force, [tried, left]);
            }
        };
        let equation = if sum.terms == 0 {
            format!("{given} = 0")
        } else {
            format!("{given} + ({}) = 0", sum.text)
        };
        let links = names.join(self.lang.comma());
        match names.len() {
            1 => {
                say!(
                    self.lang,
                    "Moments of link {links} about {about}: ${equation}$, hence ${result}$."
                )
            }
            _ => say!(
                self.lang,
                "Moments of links {links} about {about}: ${equation}$, hence ${result}$."
            ),
        }
    }

    /// Returns the sentence on a force with two trial values: the residual moments of the last link
    /// of the ring, and the force for which the residual is zero.
    fn trial(&self, m: &Moments, force: ForceTerm, [tried, left]: [[NumberId; 2]; 2]) -> String {
        let (symbol, about) = (self.symbol(force), self.about(m.about));
        let tried = tried.map(|id| self.amount(Kind::Force, self.number(id)));
        let left = left.map(|id| self.amount(Kind::Moment, self.number(id)));
        let value = self.amount(Kind::Force, self.number(m.value));
        let names = m.links.iter().skip(1).map(|l| self.scene.link_name(*l)).collect::<Vec<_>>();
        let last = m.links.first().map_or("", |l| self.scene.link_name(*l));
        let links = names.join(self.lang.comma());
        let ([f, g], [m, n]) = (tried, left);
        match names.len() {
            1 => say!(
                self.lang,
                "${symbol}$ is tried twice. The moments of link {links} with the bars about its pivot give the forces along the other bars; those of link {last} about ${about}$ then leave ${m}$ for ${symbol} = {f}$ and ${n}$ for ${symbol} = {g}$. They are linear in ${symbol}$, hence ${symbol} = {value}$."
            ),
            _ => say!(
                self.lang,
                "${symbol}$ is tried twice. The moments of links {links} with the bars about their pivots give the forces along the other bars; those of link {last} about ${about}$ then leave ${m}$ for ${symbol} = {f}$ and ${n}$ for ${symbol} = {g}$. They are linear in ${symbol}$, hence ${symbol} = {value}$."
            ),
        }
    }

    /// Returns the unknown sides and diagonals of a group's polygon, as measured.
    pub fn measured(&self, group: &GroupForces) -> Vec<String> {
        self.of.measured(group).iter().filter_map(|s| self.reading(group, s)).collect()
    }

    /// Returns a force as measured on the polygon:
    /// `F_{65} = \\mu_{F}\\cdot ea = 31.2 mm·\\mu_{F} = 62 N`.
    fn reading(&self, group: &GroupForces, side: &ForceEdge) -> Option<String> {
        let force = self.of.force(side.vector)?;
        let mm = inked(&significant(force.norm() / self.of.mu(), DIGITS));
        Some(format!(
            "{} = \\mu_{{F}}\\cdot {} = {mm}\\,\\text{{mm}}\\cdot\\mu_{{F}} = {}",
            self.symbol(side.term),
            self.between(group, side),
            self.amount(Kind::Force, force.norm())
        ))
    }

    /// Returns the moments that come before the polygon.
    pub fn before(&self, group: &GroupForces) -> Vec<Phrase> {
        let before = |m: &&Moments| !matches!(m.gives, MomentResult::Offset(_));
        let friction = self.friction(group).map(|s| Phrase::new(&s));
        friction
            .into_iter()
            .chain(group.moments.iter().filter(before).map(|m| Phrase::new(&self.moments(m))))
            .collect()
    }

    /// Returns the results of the polygon, and the moments that determine the points of action of
    /// guide forces.
    pub fn after(&self, group: &GroupForces) -> Vec<Phrase> {
        let after = group
            .moments
            .iter()
            .filter(|m| matches!(m.gives, MomentResult::Offset(_)))
            .map(|m| self.moments(m));
        self.measured(group)
            .into_iter()
            .map(|m| format!("${m}$"))
            .chain(after)
            .map(|s| Phrase::new(&s))
            .collect()
    }

    /// Returns all sentences of a group, in drawing order.
    pub fn sentences(&self, group: &GroupForces) -> Vec<Phrase> {
        let mut out = self.before(group);
        for sides in self.equations(group) {
            let unknown: Vec<String> = sides
                .iter()
                .filter(|s| !s.known)
                .map(|s| format!("${}$", self.symbol(s.term)))
                .collect();
            let unknown = unknown.join(self.lang.comma());
            let sentence = say!(
                self.lang,
                "Equilibrium of forces: ${}$; the polygon gives {unknown}.",
                self.equation(&sides)
            );
            out.push(Phrase::new(&sentence));
        }
        out.extend(self.after(group));
        out
    }

    /// Returns the complete report as plain text, group after group.
    pub fn text(&self) -> String {
        let mut out = String::new();
        let book = &self.scene.book;
        let mu = format!(
            "{} {}",
            hodograph_base::digits::shortest(book.value(Kind::Force, self.of.mu())),
            book.scale_name(Kind::Force)
        );
        out += &format!("{}μ_F = {mu}\n", tr!(self.lang, "force polygons: "));
        for group in &self.of.groups {
            out += &format!("  {}\n", self.heading(group));
            for (k, s) in self.sentences(group).iter().enumerate() {
                out += &format!("  {:>3}. {}\n", k + 1, s.plain());
            }
        }
        for told in self.two_masses() {
            out += &format!("  {}\n", Phrase::new(&told).plain());
        }
        out + &self.undrawn()
    }

    /// Returns the groups that are not drawn, with the reason.
    fn undrawn(&self) -> String {
        let mut out = String::new();
        for undrawn in &self.of.undrawn {
            let names: Vec<&str> = undrawn.links.iter().map(|l| self.scene.link_name(*l)).collect();
            let links = names.join(self.lang.comma());
            out += &match names.len() {
                1 => say!(self.lang, "  Link {links} is not drawn: {}\n", undrawn.why),
                _ => say!(self.lang, "  Links {links} are not drawn: {}\n", undrawn.why),
            };
        }
        out
    }
}

/// Returns the letter of a vertex: a to z, then with a number.
fn letter(k: usize) -> String {
    let base = char::from(b'a' + u8::try_from(k % 26).unwrap_or(0));
    if k < 26 { base.to_string() } else { format!("{base}_{{{}}}", k / 26) }
}
