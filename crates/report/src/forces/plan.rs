//! The plan of forces: the groups in reverse solving order, each with its moments and its equation.

use super::ForceWriter;
use crate::plan::table;
use hodograph_base::lang::{say, tr};
use hodograph_board::equilibrium::{About, ForceEdge, GroupForces, MomentResult, Moments};
use hodograph_board::plan::names::{name_label, point_label};
use hodograph_board::plan::text::EquationColumn;
use hodograph_paper::paper::phrase::formula;
use hodograph_scene::LinkId;
use serde_json::{Value as Json, json};

impl ForceWriter<'_> {
    /// Returns the plan as lines of text, after the `before` equations of velocities and
    /// accelerations.
    pub fn plan(&self, before: usize) -> String {
        let mut out = format!("{}\n", tr!(self.lang, "forces"));
        let mut number = before;
        for group in &self.of.groups {
            out += &format!("  {}\n", self.heading(group));
            let (after, first): (Vec<&Moments>, Vec<&Moments>) =
                group.moments.iter().partition(|m| matches!(m.gives, MomentResult::Offset(_)));
            let lines = |all: Vec<&Moments>| -> String {
                all.into_iter().map(|m| format!("  {}\n", self.moments_planned(m))).collect()
            };
            out += &lines(first);
            for sides in self.equations(group) {
                number += 1;
                let rows = table(self.lang, &self.planned(&sides));
                out += &format!("  ({number}) {}\n", tr!(self.lang, "equilibrium of forces"));
                out.extend(rows.iter().map(|row| format!("      {}\n", row.trim_end())));
            }
            out += &lines(after);
        }
        out + &self.undrawn()
    }

    /// Returns the plan as JSON.
    pub fn plan_json(&self) -> Json {
        let names =
            |links: &[LinkId]| links.iter().map(|l| self.scene.link_name(*l)).collect::<Vec<_>>();
        let both = |tex: &str| json!({"text": formula(tex), "tex": tex});
        let moments = |m: &Moments| json!({"links": names(&m.links), "about": both(&self.about(m.about)), "gives": both(&self.given(m))});
        let side = |s: &ForceEdge| json!({"symbol": both(&self.symbol(s.term)), "known": s.known});
        let group = |g: &GroupForces| {
            let equations: Vec<Json> =
                self.equations(g).iter().map(|sides| sides.iter().map(side).collect()).collect();
            json!({"links": names(&g.links), "kind": g.kind, "moments": g.moments.iter().map(moments).collect::<Vec<_>>(), "equations": equations})
        };
        let undrawn = |u: &hodograph_board::equilibrium::Undrawn| json!({"links": names(&u.links), "why": {"en": u.why.en, "zh": u.why.zh}});
        json!({
            "groups": self.of.groups.iter().map(group).collect::<Vec<_>>(),
            "undrawn": self.of.undrawn.iter().map(undrawn).collect::<Vec<_>>(),
        })
    }

    fn planned(&self, sides: &[ForceEdge]) -> Vec<EquationColumn> {
        let terms = self.columns(sides).into_iter().enumerate().map(|(k, c)| EquationColumn {
            joint: if k == 0 { "" } else { "+" },
            symbol: c.symbol,
            magnitude: if c.magnitude { &self.notation.known } else { &self.notation.unknown }
                .clone(),
            direction: self.notation.known.clone(),
            term: None,
        });
        let zero = EquationColumn {
            joint: "=",
            symbol: "0".into(),
            magnitude: String::new(),
            direction: String::new(),
            term: None,
        };
        terms.chain([zero]).collect()
    }

    fn moments_planned(&self, m: &Moments) -> String {
        let names: Vec<&str> = m.links.iter().map(|l| self.scene.link_name(*l)).collect();
        let (about, given) = (formula(&self.about(m.about)), formula(&self.given(m)));
        if matches!(m.gives, MomentResult::Trial { .. }) {
            return format!("{}{given}", tr!(self.lang, "two trials: "));
        }
        let links = names.join(self.lang.comma());
        match names.len() {
            1 => say!(self.lang, "moments of link {links} about {about}: {given}"),
            _ => say!(self.lang, "moments of links {links} about {about}: {given}"),
        }
    }

    /// Returns the point about which moments are taken, in the label language.
    pub(super) fn about(&self, about: About) -> String {
        match about {
            About::Point(p) => point_label(self.scene.point_name(p)),
            About::Crossing { at, .. } => self.crossing(at),
        }
    }

    /// Returns the unknown that moments determine, in the label language.
    fn given(&self, m: &Moments) -> String {
        match m.gives {
            MomentResult::Force(term, _) | MomentResult::Trial { force: term, .. } => {
                self.symbol(term)
            }
            MomentResult::Offset(guide) => format!("h_{{{}}}", name_label(&self.pair(guide))),
            MomentResult::Driver(d) => self.balance(d),
        }
    }
}
