//! `F_12`, `F_B3`, `h_65`, `M_b`, `P`: reactions, balancing moment and force, inertia forces,
//! power.
//!
//! F_ij is the force of link i on link j; F_ji = −F_ij. [`Forces`] holds the forces of an instant:
//! the free-body solutions fill it, a question looks its value up.

use super::contact::{Contact, bar, contacts, parties};
use super::forces::{Forces, Wrench};
use super::{
    AnswerValue, Entry, FormulaInputs, Level, Meaning, Need, Of, OverSign, Quantity, ValueForm,
};
use crate::model::{Find, GuideId, GuidePath, LinkId, PointId, Scene};
use crate::resolve::Question;
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::geom::Vec2;
use hodograph_base::kind::Kind;
use hodograph_base::lang::each;
use hodograph_base::number::Real;

/// A quantity of forces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Force(ForceQuantity);

/// A part of a reaction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReactionPart {
    /// The whole force.
    Whole,
    /// The part along the bar from the pin to the next joint of the second link.
    Normal,
    /// The part perpendicular to it.
    Tangential,
}

/// A quantity that follows from motion and loads without reactions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ByMotion {
    /// The power of the drivers.
    Power,
    /// The balancing moment or force of a driver.
    Balance(usize),
    /// The inertia force of a link.
    Inertia(LinkId),
    /// The inertia couple of a link.
    InertiaCouple(LinkId),
    /// The sum of all inertia forces.
    Shaking,
}

impl Force {
    /// Returns the quantity, if it contains no reaction.
    pub fn by_motion(&self) -> Option<ByMotion> {
        match self.0 {
            ForceQuantity::Power => Some(ByMotion::Power),
            ForceQuantity::Balance { driver, .. } => Some(ByMotion::Balance(driver)),
            ForceQuantity::InertiaForce(l) => Some(ByMotion::Inertia(l)),
            ForceQuantity::InertiaCouple(l) => Some(ByMotion::InertiaCouple(l)),
            ForceQuantity::Shaking => Some(ByMotion::Shaking),
            ForceQuantity::Reaction(..)
            | ForceQuantity::OfPin(..)
            | ForceQuantity::Offset(_)
            | ForceQuantity::Couple(_)
            | ForceQuantity::Efficiency => None,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum ForceQuantity {
    Reaction([LinkId; 2], ReactionPart),
    OfPin(PointId, LinkId),
    Offset([LinkId; 2]),
    Couple([LinkId; 2]),
    Balance { driver: usize, force: bool },
    InertiaForce(LinkId),
    InertiaCouple(LinkId),
    Shaking,
    Power,
    Efficiency,
}

const REACTION: usize = 0;
const NORMAL: usize = 1;
const TANGENTIAL: usize = 2;
const BALANCE_FORCE: usize = 3;
const OFFSET: usize = 4;
const MOMENT: usize = 5;
const INERTIA: usize = 6;
const INERTIA_COUPLE: usize = 7;
const POWER: usize = 8;
const SHAKING: usize = 9;
const EFFICIENCY: usize = 10;

impl Quantity for Force {
    const WRITTEN: &'static [Entry] = &[
        Entry::new("F", "F_12", Kind::Force, ValueForm::Vector, each!("reaction")),
        Entry::new(
            "Fn",
            "Fn_12",
            Kind::Force,
            ValueForm::Vector,
            each!("reaction along the link, or square to the guide"),
        )
        .printed("F", OverSign::Sign("n")),
        Entry::new(
            "Ft",
            "Ft_12",
            Kind::Force,
            ValueForm::Vector,
            each!("reaction square to the link, or along the guide"),
        )
        .printed("F", OverSign::Sign("t")),
        Entry::new("F", "F_b", Kind::Force, ValueForm::Scalar, each!("balancing force")),
        Entry::new(
            "h",
            "h_65",
            Kind::Length,
            ValueForm::Scalar,
            each!("distance of the force of a guide from the pin"),
        ),
        Entry::new("M", "M_b", Kind::Moment, ValueForm::Scalar, each!("balancing moment")),
        Entry::new("FI", "FI_2", Kind::Force, ValueForm::Vector, each!("inertia force"))
            .printed("F_I", OverSign::Nothing),
        Entry::new("MI", "MI_2", Kind::Moment, ValueForm::Scalar, each!("inertia couple"))
            .printed("M_I", OverSign::Nothing),
        Entry::new("P", "P", Kind::Power, ValueForm::Scalar, each!("power of the driver")),
        Entry::new("F", "F_sh", Kind::Force, ValueForm::Vector, each!("shaking force")),
        Entry::new("eta", "eta", Kind::Number, ValueForm::Scalar, each!("efficiency"))
            .printed("\\eta", OverSign::Nothing),
    ];

    fn read(question: &Question<'_>) -> Result<Option<Force>, Diagnostic> {
        let names = question.names();
        let which = match question.symbol() {
            "P" => match names {
                "" => ForceQuantity::Power,
                _ => return Ok(None),
            },
            "eta" => match names {
                "" => ForceQuantity::Efficiency,
                _ => return Ok(None),
            },
            "F" if names == "sh" => ForceQuantity::Shaking,
            "F" => match balanced(names) {
                Some(driver) => {
                    ForceQuantity::Balance { driver: question.driver(driver)?, force: true }
                }
                None => match question.two_links() {
                    Ok(links) => ForceQuantity::Reaction(links, ReactionPart::Whole),
                    Err(_) => match question.points() {
                        Ok((at, None)) if at.link.is_some() => {
                            let link = at.link.unwrap_or(question.ground());
                            ForceQuantity::OfPin(at.point, link)
                        }
                        _ => return Err(reaction_wanted(question)),
                    },
                },
            },
            "Fn" => ForceQuantity::Reaction(question.two_links()?, ReactionPart::Normal),
            "Ft" => ForceQuantity::Reaction(question.two_links()?, ReactionPart::Tangential),
            "h" => ForceQuantity::Offset(question.two_links()?),
            "M" => match balanced(names) {
                Some(driver) => {
                    ForceQuantity::Balance { driver: question.driver(driver)?, force: false }
                }
                None => ForceQuantity::Couple(question.two_links()?),
            },
            "FI" => ForceQuantity::InertiaForce(moving(question)?),
            "MI" => ForceQuantity::InertiaCouple(moving(question)?),
            _ => return Ok(None),
        };
        Ok(Some(Force(which)))
    }

    fn entry(&self) -> &'static Entry {
        &Self::WRITTEN[match self.0 {
            ForceQuantity::Reaction(_, ReactionPart::Whole) | ForceQuantity::OfPin(..) => REACTION,
            ForceQuantity::Reaction(_, ReactionPart::Normal) => NORMAL,
            ForceQuantity::Reaction(_, ReactionPart::Tangential) => TANGENTIAL,
            ForceQuantity::Balance { force: true, .. } => BALANCE_FORCE,
            ForceQuantity::Offset(_) => OFFSET,
            ForceQuantity::Balance { force: false, .. } | ForceQuantity::Couple(_) => MOMENT,
            ForceQuantity::InertiaForce(_) => INERTIA,
            ForceQuantity::InertiaCouple(_) => INERTIA_COUPLE,
            ForceQuantity::Power => POWER,
            ForceQuantity::Shaking => SHAKING,
            ForceQuantity::Efficiency => EFFICIENCY,
        }]
    }

    fn of(&self) -> Of {
        match self.0 {
            ForceQuantity::Reaction([i, j], _)
            | ForceQuantity::Offset([i, j])
            | ForceQuantity::Couple([i, j]) => Of::Links(i, j),
            ForceQuantity::OfPin(p, link) => {
                Of::Point(crate::model::OnLink { point: p, link: Some(link) })
            }
            ForceQuantity::InertiaForce(l) | ForceQuantity::InertiaCouple(l) => Of::Link(l),
            ForceQuantity::Balance { .. }
            | ForceQuantity::Power
            | ForceQuantity::Efficiency
            | ForceQuantity::Shaking => Of::Mechanism,
        }
    }

    fn meaning(&self, _scene: &Scene) -> Option<Meaning> {
        None
    }

    fn needs(&self) -> Vec<(Need, Level)> {
        vec![(Need::Forces, Level::Position)]
    }

    fn places(&self, scene: &Scene) -> Vec<LinkId> {
        match self.0 {
            ForceQuantity::Reaction(links, _)
            | ForceQuantity::Offset(links)
            | ForceQuantity::Couple(links) => links.to_vec(),
            ForceQuantity::OfPin(p, link) => scene.carriers(p).chain([link]).collect(),
            ForceQuantity::InertiaForce(_)
            | ForceQuantity::InertiaCouple(_)
            | ForceQuantity::Balance { .. }
            | ForceQuantity::Power
            | ForceQuantity::Efficiency
            | ForceQuantity::Shaking => Vec::new(),
        }
    }

    fn no_value(&self, _scene: &Scene) -> Both {
        match self.0 {
            ForceQuantity::Offset(_) => {
                both!("the force of the guide is zero: it has a couple, but no line of action")
            }
            ForceQuantity::Reaction(..) | ForceQuantity::OfPin(..) | ForceQuantity::Couple(_) => {
                both!(
                    "the reactions are not determined: a link or pair only repeats what the others hold, or a belt pulls with a tension that is not told"
                )
            }
            ForceQuantity::Balance { .. } | ForceQuantity::Power => both!(
                "the balancing force does no work in this pose: its line passes through the pole of its link, or its point is at rest"
            ),
            ForceQuantity::Efficiency => {
                both!("the balancing moment does no work here")
            }
            ForceQuantity::InertiaForce(_)
            | ForceQuantity::InertiaCouple(_)
            | ForceQuantity::Shaking => {
                both!("the forces are not determined in this pose")
            }
        }
    }

    fn fault(&self, scene: &Scene, find: &Find) -> Option<Diagnostic> {
        let at = |message: Both| Diagnostic::error("find", message).at(find.span);
        match self.0 {
            ForceQuantity::Reaction([i, j], part) => {
                let [a, b] = [i, j].map(|l| scene.link_name(l));
                match contacts(scene, i, j)[..] {
                    [Contact::Pin(p)] if part != ReactionPart::Whole => bar(scene, p, j).is_none().then(|| {
                        at(both!("`{}`: link {b} has no second joint", find.text))
                            .help(both!("ask for F_{a}{b}"))
                    }),
                    [Contact::Guide(g, _)] if matches!(scene.guides[g.0].path, GuidePath::Line { .. }) => None,
                    [_] if part != ReactionPart::Whole => Some(
                        at(both!(
                            "`{}`: links {a} and {b} are joined neither by a pin nor by a straight guide",
                            find.text
                        ))
                        .help(both!("ask for F_{a}{b}")),
                    ),
                    [_] => None,
                    [_, _, ..] => Some(at(both!(
                        "`{}`: links {a} and {b} press on each other in several places",
                        find.text
                    ))),
                    [] => Some(self.not_joined(scene, find, [i, j])),
                }
            }
            ForceQuantity::OfPin(p, link) => {
                let pin = scene.point_name(p);
                let joined = scene.links[link.0].points.contains(&p) && parties(scene, p) > 1;
                (!joined).then(|| {
                    at(both!(
                        "`{}`: no pin at {pin} acts on link {}",
                        find.text,
                        scene.link_name(link)
                    ))
                })
            }
            ForceQuantity::Offset([i, j]) | ForceQuantity::Couple([i, j]) => {
                let guided = contacts(scene, i, j)
                    .iter()
                    .any(|c| matches!(c, Contact::Guide(g, _) if slides(scene, *g)));
                (!guided).then(|| {
                    let [a, b] = [i, j].map(|l| scene.link_name(l));
                    at(both!("`{}`: no straight guide joins links {a} and {b}", find.text))
                })
            }
            ForceQuantity::InertiaForce(l) | ForceQuantity::InertiaCouple(l) => {
                let has = scene.loads.mass_of(l).is_some_and(|m| {
                    if matches!(self.0, ForceQuantity::InertiaForce(_)) {
                        m.m.is_some()
                    } else {
                        m.j.is_some()
                    }
                });
                (!has).then(|| {
                    let name = scene.link_name(l);
                    at(both!("`{}`: link {name} has no mass of this kind", find.text)).help(both!(
                        "add it to \"masses\": {{\"{name}\": {{\"m\": \"2 kg\", \"J\": \"0.01 kg*m^2\", \"at\": \"S{name}\"}}}}"
                    ))
                })
            }
            ForceQuantity::Balance { driver, force } => {
                let by_force = match &scene.loads.balance {
                    Some(balance) => balance.force.is_some(),
                    None => !scene.drivers.get(driver)?.kind.turns(),
                };
                (by_force != force).then(|| {
                    let [m, f] = ["M_b", "F_b"];
                    let (asked, right) = if force { (f, m) } else { (m, f) };
                    at(both!(
                        "`{}`: the balance is kept by a {}",
                        find.text,
                        if force { both!("moment") } else { both!("force") }
                    ))
                    .help(both!("ask for {right} instead of {asked}"))
                })
            }
            ForceQuantity::Efficiency => scene.loads.friction.is_empty().then(|| {
                let message = both!("`{}`: the scene has no friction", find.text);
                at(message)
                    .help(both!("give \"friction\": [{{\"pin\": \"B\", \"circle\": \"4 mm\"}}]"))
            }),
            ForceQuantity::Power | ForceQuantity::Shaking => None,
        }
    }

    fn value<N: Real, K: FormulaInputs<N>>(&self, known: &K) -> Option<AnswerValue<N>> {
        let (scene, forces) = (known.scene(), known.forces()?);
        match self.0 {
            ForceQuantity::Reaction([i, j], part) => {
                let contact = *contacts(scene, i, j).first()?;
                let force = reaction(forces, contact, j)?.force;
                let along = |p: PointId| (known.point(bar(scene, p, j)?)? - known.point(p)?).unit();
                // The normal force of a guide is perpendicular to it.
                let u = match (contact, part) {
                    (_, ReactionPart::Whole) | (Contact::Rolling(..), _) => {
                        return Some(AnswerValue::Vector(force));
                    }
                    (Contact::Pin(p), ReactionPart::Normal) => along(p)?,
                    (Contact::Pin(p), ReactionPart::Tangential) => along(p)?.perp(),
                    (Contact::Guide(g, _), ReactionPart::Normal) => known.guide(g)?.1.perp(),
                    (Contact::Guide(g, _), ReactionPart::Tangential) => known.guide(g)?.1,
                };
                Some(AnswerValue::Vector(u * u.dot(force)))
            }
            ForceQuantity::OfPin(p, link) => Some(AnswerValue::Vector(of_pin(forces, p, link)?)),
            ForceQuantity::Offset([i, j]) | ForceQuantity::Couple([i, j]) => {
                let guide = contacts(scene, i, j)
                    .into_iter()
                    .find(|c| matches!(c, Contact::Guide(g, _) if slides(scene, *g)))?;
                let wrench = reaction(forces, guide, j)?;
                if matches!(self.0, ForceQuantity::Couple(_)) {
                    return Some(AnswerValue::Scalar(wrench.couple));
                }
                let Contact::Guide(g, _) = guide else { return None };
                let normal = known.guide(g)?.1.perp().dot(wrench.force);
                let nothing =
                    !N::refines() && normal.approx().abs() <= super::ROUNDING * forces.largest;
                (!nothing).then(|| AnswerValue::Scalar(wrench.couple / normal))
            }
            ForceQuantity::Balance { driver, .. } => {
                let of_scene = scene.loads.balance.is_some();
                Some(AnswerValue::Scalar(if of_scene {
                    forces.balance?
                } else {
                    *forces.drivers.get(driver)?
                }))
            }
            ForceQuantity::InertiaForce(l) => forces
                .inertia
                .iter()
                .find(|(own, _)| *own == l)
                .map(|(_, w)| AnswerValue::Vector(w.force)),
            ForceQuantity::InertiaCouple(l) => forces
                .inertia
                .iter()
                .find(|(own, _)| *own == l)
                .map(|(_, w)| AnswerValue::Scalar(w.couple)),
            ForceQuantity::Shaking => Some(AnswerValue::Vector(
                forces.inertia.iter().fold(Vec2::zero(), |sum, (_, w)| sum + w.force),
            )),
            ForceQuantity::Power => Some(AnswerValue::Scalar(forces.power)),
            ForceQuantity::Efficiency => {
                Some(AnswerValue::Scalar(forces.efficiency().filter(|eta| eta.is_decided())?))
            }
        }
    }
}

impl Force {
    /// Returns true for a reaction between two links, or of a pin on a link.
    pub fn is_reaction(&self) -> bool {
        matches!(self.0, ForceQuantity::Reaction(..) | ForceQuantity::OfPin(..))
    }

    /// Returns the fault of a question for the force of two links that do not press on each other,
    /// with the pin that they share with others.
    fn not_joined(&self, scene: &Scene, find: &Find, [i, j]: [LinkId; 2]) -> Diagnostic {
        let [a, b] = [i, j].map(|l| scene.link_name(l));
        let shared =
            scene.links[i.0].points.iter().copied().find(|p| scene.links[j.0].points.contains(p));
        match shared {
            Some(p) => {
                let pin = scene.point_name(p);
                let message = both!(
                    "`{}` is not one force: pin {pin} joins more links than {a} and {b}",
                    find.text
                );
                Diagnostic::error("shared-pin", message)
                    .at(find.span)
                    .help(both!("ask for the force of the pin on a link: F_{pin}{b}"))
            }
            None => {
                let message = both!("`{}`: links {a} and {b} are not joined", find.text);
                Diagnostic::error("find", message).at(find.span).help(both!(
                    "name two links that touch, such as F_12, or a pin and a link, such as F_B3"
                ))
            }
        }
    }
}

/// Returns the index of the driver in `b`, `b2`: 0, 1.
fn balanced(names: &str) -> Option<usize> {
    match names.strip_prefix('b')? {
        "" => Some(0),
        number => number.parse::<usize>().ok()?.checked_sub(1),
    }
}

fn moving(question: &Question<'_>) -> Result<LinkId, Diagnostic> {
    let link = question.link(question.names())?;
    if question.is_ground(link) {
        return Err(question.fault(both!("`{}`: the ground does not move", question.text())));
    }
    Ok(link)
}

fn reaction_wanted(question: &Question<'_>) -> Diagnostic {
    let message = both!("`{}` names neither two links nor a pin and a link", question.text());
    question.fault(message).help(both!(
        "write F_12 (of link 1 on link 2), F_B3 (of pin B on link 3), F_b (balancing force) or F_sh (shaking force)"
    ))
}

/// Returns true if a numbered slider runs in a straight guide.
fn slides(scene: &Scene, g: GuideId) -> bool {
    let guide = &scene.guides[g.0];
    guide.slider.is_some() && matches!(guide.path, GuidePath::Line { .. })
}

/// Returns the force of a contact on one of its links, with its couple about the place of the
/// contact.
fn reaction<N: Real>(forces: &Forces<N>, contact: Contact, on: LinkId) -> Option<Wrench<N>> {
    if !forces.determinate {
        return None;
    }
    let reversed = |w: Wrench<N>, back: bool| if back { w.reversed() } else { w };
    match contact {
        Contact::Pin(p) => Some(Wrench { force: of_pin(forces, p, on)?, ..Wrench::zero() }),
        Contact::Guide(g, back) => {
            forces.guides.iter().find(|(own, _)| *own == g).map(|(_, w)| reversed(*w, back))
        }
        Contact::Rolling(r, back) => {
            let force = forces.rolling.iter().find(|(own, _)| *own == r)?.1;
            Some(reversed(Wrench { force, ..Wrench::zero() }, back))
        }
    }
}

fn of_pin<N: Real>(forces: &Forces<N>, p: PointId, link: LinkId) -> Option<Vec2<N>> {
    let found = forces.pins.iter().find(|(at, l, _)| (*at, *l) == (p, link));
    found.filter(|_| forces.determinate).map(|(.., force)| *force)
}
