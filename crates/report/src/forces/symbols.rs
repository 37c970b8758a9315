//! Symbols of forces, couples and arms.

use super::ForceWriter;
use hodograph_board::construction::{MarkId, Name};
use hodograph_board::equilibrium::{ForceTerm, Party, ReactionComponent};
use hodograph_board::plan::names::{crossing_letter, name_label};
use hodograph_mechanism::force::Cause;
use hodograph_scene::{DiagramKind, GuideId, LinkId, LoadSize, PointId, Rub};

impl ForceWriter<'_> {
    /// Returns the symbol of a force, in the label language: `F^{t}_{12}`, `G_{2}`, `F_{I2}`.
    pub fn symbol(&self, term: ForceTerm) -> String {
        match self.marks(term) {
            (letter, "", sub) => format!("{letter}_{{{sub}}}"),
            (letter, sup, sub) => format!("{letter}^{{{sup}}}_{{{sub}}}"),
        }
    }

    /// Returns the letter of a force, its superscript and its subscript.
    fn marks(&self, term: ForceTerm) -> (char, &str, String) {
        let (of, on, part) = match term {
            ForceTerm::Load(k) => {
                let (letter, sub) = self.load(k);
                return (letter, "", sub);
            }
            ForceTerm::Reaction { of, on, part } => (of, on, part),
        };
        let link = |l: LinkId| name_label(self.scene.link_name(l));
        let long = [Some(on), if let Party::Link(l) = of { Some(l) } else { None }];
        let comma =
            if long.into_iter().flatten().any(|l| self.scene.link_name(l).chars().count() > 1) {
                ","
            } else {
                ""
            };
        let sub = match of {
            Party::Link(l) => format!("{}{comma}{}", link(l), link(on)),
            Party::Pin(p) => format!("{}{comma}{}", name_label(self.scene.point_name(p)), link(on)),
            Party::Cylinder(d) | Party::Driver(d) => {
                return ('F', "", self.balanced(d));
            }
        };
        let sup = match self.part(of, on, part) {
            ReactionComponent::Whole => "",
            ReactionComponent::Normal => "n",
            ReactionComponent::Tangential => &self.notation.tangential,
        };
        ('F', sup, format!("{}{sub}", self.notation.reaction))
    }

    /// Returns the letter and the subscript of a load; for a load that is only a couple, those of
    /// the couple.
    fn load(&self, k: usize) -> (char, String) {
        let load = &self.of.loads[k];
        let link = name_label(self.scene.link_name(load.link));
        let at = |p: PointId| name_label(self.scene.point_name(p));
        match load.cause {
            Cause::Weight => ('G', link),
            Cause::Inertia => ('F', format!("I{link}")),
            Cause::Balance => ('F', "b".into()),
            Cause::Teeth(_) => ('F', "r".into()),
            Cause::Friction(k) => match self.scene.loads.friction[k].at {
                Rub::Pin { point, .. } => ('M', format!("f{}", at(point))),
                Rub::Guide { .. } => ('F', format!("f{link}")),
            },
            Cause::Spring(s) => {
                ('F', self.scene.loads.springs[s].ends.map(|(p, _)| at(p)).concat())
            }
            Cause::Applied(a) => {
                let applied = &self.scene.loads.applied[a];
                let here = || self.scene.loads.applied.iter().filter(|o| o.at == applied.at);
                let twins = here().filter(|other| other.link == applied.link).count();
                let number = if twins > 1 { format!(",{}", a + 1) } else { String::new() };
                // At a pin two links may be loaded.
                let by_link = if twins < here().count() { link.as_str() } else { "" };
                match (applied.at, &applied.size) {
                    (Some(_), LoadSize::AgainstMotion(_)) => ('F', format!("r{by_link}{number}")),
                    (Some(p), _) => ('F', format!("{}{by_link}{number}", at(p))),
                    (None, _) => ('M', format!("{link}{number}")),
                }
            }
        }
    }

    /// Returns a force as `find` writes it: `F_12`, `Fn_12`.
    pub fn plain(&self, term: ForceTerm) -> String {
        match term {
            ForceTerm::Load(_) => self.symbol(term).replace(['{', '}', '\\'], ""),
            ForceTerm::Reaction { of, on, part } => {
                let letter = match self.part(of, on, part) {
                    ReactionComponent::Whole => "F",
                    ReactionComponent::Normal => "Fn",
                    ReactionComponent::Tangential => "Ft",
                };
                let on = self.scene.link_name(on);
                match of {
                    Party::Link(l) => format!(
                        "{letter}_{}{}{on}",
                        self.scene.link_name(l),
                        if self.scene.link_name(l).len() + on.len() > 2 { "," } else { "" }
                    ),
                    Party::Pin(p) => format!("{letter}_{}{on}", self.scene.point_name(p)),
                    Party::Cylinder(d) | Party::Driver(d) => format!("F_{}", self.balanced(d)),
                }
            }
        }
    }

    /// Returns the symbol of a load's couple.
    pub fn couple_of(&self, load: usize) -> String {
        self.couple(ForceTerm::Load(load))
    }

    /// Returns the name of the arm of a force: `h_{G2}`.
    pub fn arm_name(&self, term: ForceTerm) -> String {
        let (letter, sup, sub) = self.marks(term);
        let letter = if letter == 'F' { String::new() } else { letter.to_string() };
        format!("h_{{{letter}{sup}{sub}}}")
    }

    /// Returns the symbol of the couple of a load or of a reaction on a link.
    pub(super) fn couple(&self, term: ForceTerm) -> String {
        match term {
            ForceTerm::Load(k) => match self.of.loads[k].cause {
                Cause::Inertia => {
                    format!("M_{{I{}}}", name_label(self.scene.link_name(self.of.loads[k].link)))
                }
                Cause::Applied(_)
                | Cause::Weight
                | Cause::Spring(_)
                | Cause::Balance
                | Cause::Teeth(_)
                | Cause::Friction(_) => self.symbol(term),
            },
            ForceTerm::Reaction { .. } => self.symbol(term).replacen('F', "M", 1),
        }
    }

    /// Returns the letter of an intersection of lines of action.
    pub fn crossing(&self, at: MarkId) -> String {
        let letter = crossing_letter(self.scene);
        let c = &self.of.construction;
        let crossings = c.marks.iter().enumerate().filter(|(_, m)| {
            c.diagrams[m.on.index()] == DiagramKind::Plane && matches!(m.name, Name::Image(_))
        });
        let all: Vec<usize> = crossings.map(|(k, _)| k).collect();
        match all.iter().position(|k| *k == at.index()) {
            Some(k) if all.len() > 1 => format!("{letter}_{{{}}}", k + 1),
            _ => letter.to_owned(),
        }
    }

    /// Returns the links that a guide joins, as a subscript.
    pub(super) fn pair(&self, guide: GuideId) -> String {
        let g = &self.scene.guides[guide.0];
        g.slider.map_or_else(String::new, |s| {
            format!("{}{}", self.scene.link_name(g.on), self.scene.link_name(s))
        })
    }

    /// Returns the symbol of a driver's balancing moment.
    pub fn balance(&self, driver: usize) -> String {
        format!("M_{{{}}}", self.balanced(driver))
    }

    /// Returns the subscript of a driver's balancing force or moment, as in questions: b, b2.
    fn balanced(&self, driver: usize) -> String {
        if driver > 0 { format!("b{}", driver + 1) } else { "b".into() }
    }
}
