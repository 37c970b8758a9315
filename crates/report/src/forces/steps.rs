//! The steps of a group's equilibrium, one sentence each.

use super::{DIGITS, ForceWriter};
use hodograph_base::digits::{inked, significant};
use hodograph_base::lang::{say, tr};
use hodograph_board::construction::{MarkId, Op};
use hodograph_board::equilibrium::{
    Act, ForceEdge, ForceTerm, GroupForces, Party, ReactionComponent,
};
use hodograph_paper::paper::phrase::Phrase;
use hodograph_scene::Kind;

impl ForceWriter<'_> {
    /// Returns the sentence of each step of a group, in the order of
    /// [`hodograph_board::equilibrium::Equilibrium::acts`].
    pub fn steps(&self, group: &GroupForces) -> Vec<Phrase> {
        let acts = self.of.acts(group);
        let mut begun = false;
        acts.iter().map(|act| Phrase::new(&self.step(group, act, &mut begun))).collect()
    }

    /// Returns the sentence of a step; `begun` is set once a force is drawn.
    fn step(&self, group: &GroupForces, act: &Act, begun: &mut bool) -> String {
        match act {
            Act::Free => self.freed(group),
            Act::Friction => self.friction(group).unwrap_or_default(),
            Act::Moments(k) => self.moments(&group.moments[*k]),
            Act::Lay(side) => self.laid_off(group, side, std::mem::replace(begun, true)),
            Act::Cross(to) => self.crossed(group, *to),
            Act::Read(side) => {
                let reading = self.reading(group, side).unwrap_or_default();
                say!(self.lang, "The polygon gives ${reading}$.")
            }
        }
    }

    /// Returns the letters of a vector's ends: `ab`.
    pub(super) fn between(&self, group: &GroupForces, side: &ForceEdge) -> String {
        let v = &self.of.construction.vectors[side.vector.index()];
        self.vertex(group, v.from) + &self.vertex(group, v.to)
    }

    fn vertex(&self, group: &GroupForces, mark: MarkId) -> String {
        self.letters(group)
            .into_iter()
            .find(|(m, _)| *m == mark)
            .map_or_else(String::new, |(_, letter)| letter)
    }

    /// Returns the loads on the free-body diagrams of the links, and the reactions to be found.
    fn freed(&self, group: &GroupForces) -> String {
        let mut known: Vec<String> = Vec::new();
        let mut add = |symbol: String| {
            if !known.contains(&symbol) {
                known.push(symbol);
            }
        };
        for (k, load) in
            self.of.loads.iter().enumerate().filter(|(_, l)| group.links.contains(&l.link))
        {
            if load.at.is_some() && load.wrench.force.norm() > 0.0 {
                add(self.symbol(ForceTerm::Load(k)));
            }
            if load.wrench.couple != 0.0 {
                add(self.couple(ForceTerm::Load(k)));
            }
        }
        // Reactions from groups that are drawn before.
        let inside = |of: Party| matches!(of, Party::Link(l) if group.links.contains(&l));
        let whole = |s: &ForceEdge| match s.term {
            ForceTerm::Reaction { of, on, .. } if !inside(of) => {
                Some(self.symbol(ForceTerm::Reaction { of, on, part: ReactionComponent::Whole }))
            }
            ForceTerm::Reaction { .. } | ForceTerm::Load(_) => None,
        };
        let mut unknown: Vec<String> = Vec::new();
        for symbol in self.of.measured(group).iter().filter_map(whole) {
            if !unknown.contains(&symbol) {
                unknown.push(symbol);
            }
        }
        for symbol in group.sides.iter().filter(|s| s.known).filter_map(whole) {
            if !unknown.contains(&symbol) && !known.contains(&symbol) {
                known.push(symbol);
            }
        }
        let names: Vec<&str> = group.links.iter().map(|l| self.scene.link_name(*l)).collect();
        let list = |symbols: &[String]| {
            symbols.iter().map(|s| format!("${s}$")).collect::<Vec<_>>().join(self.lang.comma())
        };
        let (lang, sought, acting) = (self.lang, list(&unknown), list(&known));
        let reactions = match unknown.len() {
            0 => String::new(),
            1 => say!(lang, " The reaction {sought} is sought."),
            _ => say!(lang, " The reactions {sought} are sought."),
        };
        let loads = match (known.len(), names.len()) {
            (0, 1) => tr!(lang, " No load acts on it.").into(),
            (0, _) => tr!(lang, " No load acts on them.").into(),
            (1, 1) => say!(lang, " {acting} acts on it."),
            (1, _) => say!(lang, " {acting} acts on them."),
            (_, 1) => say!(lang, " {acting} act on it."),
            (_, _) => say!(lang, " {acting} act on them."),
        };
        let links = names.join(lang.comma());
        match names.len() {
            1 => say!(lang, "Draw link {links} apart.{loads}{reactions}"),
            _ => say!(lang, "Draw links {links} apart.{loads}{reactions}"),
        }
    }

    fn laid_off(&self, group: &GroupForces, side: &ForceEdge, begun: bool) -> String {
        let force = self.of.force(side.vector).map_or(0.0, |f| f.norm());
        let (symbol, size) = (self.symbol(side.term), self.amount(Kind::Force, force));
        let (ends, mm) =
            (self.between(group, side), inked(&significant(force / self.of.mu(), DIGITS)));
        let from = self.vertex(group, self.of.construction.vectors[side.vector.index()].from);
        let line = format!("${symbol} = {size}$");
        let length = format!("${ends} = {mm}\\,\\text{{mm}}$");
        match begun {
            false => {
                say!(self.lang, "Choose a point ${from}$. From ${from}$ lay off {line}: {length}.")
            }
            true => say!(self.lang, "From ${from}$ lay off {line}: {length}."),
        }
    }

    fn crossed(&self, group: &GroupForces, to: MarkId) -> String {
        let c = &self.of.construction;
        let lines = c.ops.iter().find_map(|op| match op {
            Op::Meet { lines, to: own } if *own == to => Some(*lines),
            _ => None,
        });
        let at = self.vertex(group, to);
        let line = |k: usize| {
            let through = c.lines[lines?[k].index()].through;
            let on = |s: &&ForceEdge| {
                let v = &c.vectors[s.vector.index()];
                [(v.from, v.to), (v.to, v.from)].contains(&(through, to))
            };
            let side = group.sides.iter().chain(&group.diagonals).find(on)?;
            Some((self.symbol(side.term), self.vertex(group, through)))
        };
        match (line(0), line(1)) {
            (Some((a, p)), Some((b, q))) => say!(
                self.lang,
                "Draw the line of ${a}$ through ${p}$ and that of ${b}$ through ${q}$; they cross in ${at}$."
            ),
            (_, _) => {
                say!(self.lang, "Draw the two lines of known direction; they cross in ${at}$.")
            }
        }
    }
}
