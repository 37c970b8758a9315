//! Wrong solutions: the places at which a scene admits a known mistake, and the consequences.
//!
//! A mistake changes the equations, not the drawing: the changed plan is carried out on the same
//! board, from the same pole, to the same scales, and is read off like the right one. Thus a
//! printed number can be shown to come from a printed equation. The sites follow from the plan,
//! which holds no numbers; a mistake without consequence in the pose (its term is zero) is left out
//! after the plan is drawn. Each file defines one mistake: where it can be made, how it is made,
//! and why it is wrong.

mod by_centre;
mod contact_point;
mod coriolis;
mod image;
mod normal;
mod rewrite;
mod rolling_point;
mod shown;
mod solved;

pub use shown::{EquationPart, Missing, SolutionSide};
pub use solved::{Attempt, AttemptAnswer, AttemptScene, TipGap, solved};

use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_board::plan::Plan;
use hodograph_mechanism::mechanism::Mechanism;
use hodograph_scene::{Attempted, GuideId, LinkId, Mistake, PointId, RollingId, Scene};
use hodograph_worked::worked::Worked;

/// A mistake that the scene admits, with its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Site {
    /// [`Mistake::ContactPoint`], for a cam (index into the scene's list) and the link in which the
    /// point is assumed to slide.
    ContactPoint(usize, LinkId),
    /// [`Mistake::NoCoriolis`], at the pin of a guide.
    NoCoriolis(GuideId),
    /// [`Mistake::CoriolisWrongOmega`], at the pin of a guide, with the angular velocity of a link
    /// other than the guide's carrier.
    CoriolisWrongOmega(GuideId, LinkId),
    /// [`Mistake::RollingPointAZero`], at the contact of a rolling pair: the wheel's image is based
    /// on it.
    RollingPointAZero(RollingId),
    /// [`Mistake::RollingPointAZero`], at a further point of the wheel, found from the contact with
    /// the right angular velocity and acceleration.
    RollingPointAsBase(RollingId, PointId),
    /// [`Mistake::ImageAcrossLinks`], at a point of the first link, found by an image on points of
    /// the second.
    ImageAcrossLinks(PointId, LinkId, LinkId),
    /// [`Mistake::NoNormal`], in the motion of a link.
    NoNormal(LinkId),
    /// [`Mistake::AccelerationByCentre`], in the motion of a link.
    AccelerationByCentre(LinkId),
}

/// The data from which sites are found.
#[derive(Clone, Copy)]
struct Topology<'a> {
    scene: &'a Scene,
    mechanism: &'a Mechanism,
    plan: &'a Plan,
}

/// Returns all mistakes that can be made with a scene's equations, in the order of
/// [`Mistake::ALL`].
pub fn sites(scene: &Scene, worked: &Worked) -> Vec<Site> {
    let t = Topology { scene, mechanism: &worked.mechanism, plan: &worked.plan };
    let of = |mistake| match mistake {
        Mistake::ContactPoint => contact_point::sites(&t),
        Mistake::NoCoriolis => coriolis::without(&t),
        Mistake::CoriolisWrongOmega => coriolis::by_another(&t),
        Mistake::RollingPointAZero => {
            rolling_point::sites(&t).into_iter().chain(rolling_point::bases(&t)).collect()
        }
        Mistake::ImageAcrossLinks => image::sites(&t),
        Mistake::NoNormal => normal::sites(&t),
        Mistake::AccelerationByCentre => by_centre::sites(&t),
    };
    Mistake::ALL.into_iter().flat_map(of).collect()
}

impl Site {
    /// Returns the kind of mistake.
    pub fn mistake(&self) -> Mistake {
        match self {
            Site::ContactPoint(..) => Mistake::ContactPoint,
            Site::NoCoriolis(_) => Mistake::NoCoriolis,
            Site::CoriolisWrongOmega(..) => Mistake::CoriolisWrongOmega,
            Site::RollingPointAZero(_) | Site::RollingPointAsBase(..) => Mistake::RollingPointAZero,
            Site::ImageAcrossLinks(..) => Mistake::ImageAcrossLinks,
            Site::NoNormal(_) => Mistake::NoNormal,
            Site::AccelerationByCentre(_) => Mistake::AccelerationByCentre,
        }
    }

    /// Returns the name of the point by which a scene names the site, if it has one.
    pub fn point(&self, scene: &Scene) -> Option<String> {
        let name = |p: PointId| scene.point_name(p).to_owned();
        match *self {
            Site::NoCoriolis(g) | Site::CoriolisWrongOmega(g, _) => scene.guides[g.0].pin.map(name),
            Site::NoNormal(_) | Site::AccelerationByCentre(_) => None,
            Site::RollingPointAZero(r) => Some(name(scene.rolling[r.0].at[0])),
            Site::RollingPointAsBase(_, p) => Some(name(p)),
            Site::ContactPoint(c, _) => Some(hodograph_worked::worked::contact::name(scene, c)),
            Site::ImageAcrossLinks(p, ..) => Some(name(p)),
        }
    }

    /// Returns the link by which a scene names the site.
    pub fn link(&self, scene: &Scene) -> Option<LinkId> {
        match *self {
            Site::NoCoriolis(g) => Some(scene.guides[g.0].on),
            Site::ContactPoint(_, l)
            | Site::CoriolisWrongOmega(_, l)
            | Site::NoNormal(l)
            | Site::AccelerationByCentre(l)
            | Site::ImageAcrossLinks(_, l, _) => Some(l),
            Site::RollingPointAZero(r) | Site::RollingPointAsBase(r, _) => {
                scene.rolling[r.0].links.into_iter().find(|l| *l != scene.ground)
            }
        }
    }

    /// Returns the place in words: `at B`, `of link 3`.
    pub fn place(&self, scene: &Scene) -> Both {
        if let Site::CoriolisWrongOmega(g, l) = *self {
            let point = scene.guides[g.0].pin.map_or("", |p| scene.point_name(p));
            return both!("at {point}, with ω of link {}", scene.link_name(l));
        }
        if let Site::ContactPoint(c, l) = *self {
            let point = hodograph_worked::worked::contact::name(scene, c);
            return both!("at {point}, frame on link {}", scene.link_name(l));
        }
        if let Site::RollingPointAsBase(r, p) = *self {
            let (contact, point) =
                (scene.point_name(scene.rolling[r.0].at[0]), scene.point_name(p));
            return both!("at {contact}, as the base of {point}");
        }
        match self.point(scene) {
            Some(point) => both!("at {point}"),
            None => {
                both!("of link {}", self.link(scene).map_or("", |l| scene.link_name(l)))
            }
        }
    }

    /// Returns the explanation of why it is wrong.
    pub fn why(&self, scene: &Scene) -> Both {
        match *self {
            Site::ContactPoint(c, l) => contact_point::why(scene, c, l),
            Site::NoCoriolis(g) => coriolis::why_needed(scene, g),
            Site::CoriolisWrongOmega(g, l) => coriolis::why_of_carrier(scene, g, l),
            Site::RollingPointAZero(r) | Site::RollingPointAsBase(r, _) => {
                rolling_point::why(scene, r)
            }
            Site::ImageAcrossLinks(p, own, other) => image::why(scene, p, own, other),
            Site::NoNormal(l) => normal::why(scene, l),
            Site::AccelerationByCentre(l) => by_centre::why(scene, l),
        }
    }
}

/// Returns the sites that a scene's attempts name, each with its attempt: the sites of the same
/// mistake with the named point and link.
///
/// # Errors
/// `attempt`: the mistake cannot be made there, with where it can be; several sites fit.
pub fn named<'a>(scene: &'a Scene, all: &[Site]) -> (Vec<(Site, &'a Attempted)>, Vec<Diagnostic>) {
    let (mut found, mut faults) = (Vec::new(), Vec::new());
    for attempt in &scene.attempts {
        let offered: Vec<Site> =
            all.iter().copied().filter(|s| s.mistake() == attempt.mistake).collect();
        let fits = |s: &&Site| {
            let point = attempt.pair.as_ref().is_none_or(|p| s.point(scene).as_ref() == Some(p));
            point && attempt.link.is_none_or(|l| s.link(scene) == Some(l))
        };
        let fitting: Vec<Site> = offered.iter().filter(fits).copied().collect();
        match fitting[..] {
            [site] => found.push((site, attempt)),
            // Two equations of one mistake: without a named link, the first is meant.
            [site @ Site::ContactPoint(cam, _), Site::ContactPoint(other, _)] if cam == other => {
                found.push((site, attempt))
            }
            [site @ Site::RollingPointAZero(_), ref bases @ ..]
                if bases.iter().all(|s| matches!(s, Site::RollingPointAsBase(..))) =>
            {
                found.push((site, attempt));
            }
            _ => faults.push(not_one(scene, attempt, &offered, fitting.len())),
        }
    }
    (found, faults)
}

fn not_one(scene: &Scene, attempt: &Attempted, offered: &[Site], fitting: usize) -> Diagnostic {
    let name = attempt.mistake.name();
    let places: Vec<Both> = offered.iter().map(|s| s.place(scene)).collect();
    let message = match fitting {
        0 => both!("`{name}` cannot be made there"),
        _ => {
            both!("`{name}` can be made at {fitting} places")
        }
    };
    let help = match offered {
        [] => both!("no equation of this scene offers it; see `hodograph attempts`"),
        _ => {
            both!("it can be made {}: name \"pair\" or \"link\"", Both::join(&places, ["; ", "；"]))
        }
    };
    Diagnostic::error("attempt", message).at(attempt.span).help(help)
}

/// Returns the wrong solutions that a scene names; if it names none, or if `typical` is set, also
/// all others that change an answer.
///
/// # Errors
/// `attempt`: a named mistake cannot be made there, or not in this pose.
pub fn wanted(scene: &Scene, worked: &Worked, typical: bool) -> Result<Vec<Attempt>, Faults> {
    let all = sites(scene, worked);
    let (named, mut faults) = named(scene, &all);
    let mut out = Vec::new();
    for (site, said) in named {
        match solved(scene, worked, site, Some(said)) {
            Some(attempt) => out.push(attempt),
            None => faults.push(nothing(&site, said)),
        }
    }
    if !faults.is_empty() {
        return Err(Faults { list: faults });
    }
    if typical || scene.attempts.is_empty() {
        let told = |s: &Site| out.iter().any(|a| a.site == *s);
        let more: Vec<Site> = all.into_iter().filter(|s| !told(s)).take(MOST).collect();
        out.extend(
            more.into_iter()
                .filter_map(|s| solved(scene, worked, s, None))
                .filter(|a| !a.rows.is_empty()),
        );
    }
    Ok(out)
}

/// The largest number of typical mistakes drawn: a chain of a hundred links has hundreds, all
/// alike.
const MOST: usize = 40;

fn nothing(site: &Site, said: &Attempted) -> Diagnostic {
    let name = site.mistake().name();
    Diagnostic::error("attempt", both!("`{name}` changes nothing in this pose, or cannot be drawn"))
        .at(said.span)
        .help(both!("choose another pose, or another mistake: `hodograph attempts --all`"))
}
