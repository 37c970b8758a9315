//! Friction on the links of a group, in words.

use super::{DIGITS, ForceWriter};
use hodograph_base::digits::{inked, significant};
use hodograph_base::lang::say;
use hodograph_board::equilibrium::ForceTerm;
use hodograph_board::equilibrium::{GroupForces, Party, ReactionComponent};
use hodograph_mechanism::force::Cause;
use hodograph_scene::quantity::{Contact, contacts};
use hodograph_scene::{Kind, LinkId, Rub};

impl ForceWriter<'_> {
    /// Returns the part of a reaction that the polygon contains: for a guide with friction the
    /// normal force.
    pub(super) fn part(&self, of: Party, on: LinkId, part: ReactionComponent) -> ReactionComponent {
        let rubs = |by: LinkId| {
            self.scene.loads.friction.iter().any(|f| match f.at {
                Rub::Guide { guide, .. } => contacts(self.scene, by, on)
                    .iter()
                    .any(|c| matches!(c, Contact::Guide(g, _) if *g == guide)),
                Rub::Pin { .. } => false,
            })
        };
        match of {
            Party::Link(by) if part == ReactionComponent::Whole && rubs(by) => {
                ReactionComponent::Normal
            }
            Party::Link(_) | Party::Pin(_) | Party::Cylinder(_) | Party::Driver(_) => part,
        }
    }

    /// Returns the friction on the links of a group, from the reactions of the previous polygon.
    pub(super) fn friction(&self, group: &GroupForces) -> Option<String> {
        let mut seen = Vec::new();
        let mut all = Vec::new();
        for (n, load) in
            self.of.loads.iter().enumerate().filter(|(_, l)| group.links.contains(&l.link))
        {
            let Cause::Friction(k) = load.cause else { continue };
            if seen.contains(&k) {
                continue;
            }
            seen.push(k);
            let symbol = self.symbol(ForceTerm::Load(n));
            all.push(match &self.scene.loads.friction[k].at {
                Rub::Pin { circle, .. } => {
                    let couple = load.wrench.couple.abs();
                    let (rho, force) = (
                        self.amount(Kind::Length, circle.value),
                        self.amount(Kind::Force, couple / circle.value),
                    );
                    format!(
                        "${symbol} = \\rho F = {rho} \\cdot {force} = {}$",
                        self.amount(Kind::Moment, couple)
                    )
                }
                Rub::Guide { f, .. } => {
                    let force = load.wrench.force.norm();
                    let normal = self.amount(Kind::Force, force / f.value);
                    format!(
                        "${symbol} = fF^n = {} \\cdot {normal} = {}$",
                        inked(&significant(f.value, DIGITS)),
                        self.amount(Kind::Force, force)
                    )
                }
            });
        }
        let all = (!all.is_empty()).then(|| all.join(self.lang.semicolon()))?;
        Some(say!(
            self.lang,
            "Friction (force polygons repeated until the forces stay the same): {all}."
        ))
    }
}
