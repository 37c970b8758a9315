//! The degree of freedom of a mechanism, counted from its links and pairs with every special case
//! listed separately; and its groups for each possible driver.
//!
//! F = 3n − (2 p_l + p_h − p′) − F′: a pin of k links counts k − 1 (compound hinge 复合铰链); F′
//! are local freedoms 局部自由度, of links that carry nothing else; p′ is the number of redundant
//! constraints 虚约束, as far as topology shows. No length is used here.
//!
//! # Source
//! Sun Huan et al., *Mechanisms and Machine Theory* (机械原理), ch. 2.

use super::Mechanism;
use super::redundant::{Opened, OpenedPairs, Redundant};
use hodograph_scene::{
    Driver, DriverKind, Follows, GivenQuantity, GuideId, LinkId, PointId, Scene,
};

/// A link whose only pair is the pin about which it turns: its rotation moves nothing else.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Local {
    /// Name of the link.
    pub link: String,
    /// The name of its pin.
    pub pin: String,
    /// True if it is the body of a bare pin that moves in two slots.
    pub bare: bool,
}

/// The counts of links and pairs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Moving links n.
    pub moving: usize,
    /// Lower pairs p_l.
    pub lower: usize,
    /// Higher pairs p_h.
    pub higher: usize,
}

impl Counts {
    /// Returns F = 3n − (2 p_l + p_h − p′) − F′.
    ///
    /// ```
    /// use hodograph_mechanism::mechanism::Counts;
    /// // A locomotive's three coupled axles: one of the cranks repeats the others.
    /// assert_eq!(Counts { moving: 4, lower: 6, higher: 0 }.freedom(1, 0), 1);
    /// ```
    pub fn freedom(&self, repeated: usize, local: usize) -> i64 {
        3 * self.moving as i64 - (2 * self.lower + self.higher) as i64 + repeated as i64
            - local as i64
    }
}

/// The groups of a mechanism for one choice of drivers.
#[derive(Clone, Debug)]
pub struct ForDrivers {
    /// The scene with these drivers.
    pub scene: Scene,
    /// True if they are the drivers of the file.
    pub given: bool,
    /// Its topology.
    pub mechanism: Mechanism,
}

impl ForDrivers {
    /// Returns the groups from the far end 拆杆组: the last group that can be solved comes first.
    /// Driven and carried parts are no groups.
    pub fn from_the_far_end(&self) -> Vec<super::Assur<'_>> {
        self.mechanism
            .assur(&self.scene)
            .into_iter()
            .rev()
            .filter(|g| g.class().is_some())
            .collect()
    }

    /// Returns the choice with a link in place of the contact of each cam 高副低代; `None` without
    /// cams, and with contacts that no lower pairs replace ([`Scene::replaced`]).
    pub fn replaced(&self) -> Option<ForDrivers> {
        let scene = self.scene.replaced(|_| None)?.scene;
        let mechanism = Mechanism::new(&scene).ok()?.value;
        Some(ForDrivers { scene, given: self.given, mechanism })
    }

    /// Returns the class of the mechanism: that of its highest group; `I` without groups.
    pub fn class(&self) -> &'static str {
        let groups = self.from_the_far_end();
        ["IV or higher", "III", "II"]
            .into_iter()
            .find(|c| groups.iter().any(|g| g.class() == Some(c)))
            .unwrap_or("I")
    }

    /// Returns the names of the parts that the drivers move: `2`, `slider C`; followers led by cams
    /// are no drivers.
    pub fn names(&self) -> Vec<String> {
        (0..self.scene.drivers.len())
            .filter(|d| !self.scene.is_led(*d))
            .map(|d| self.scene.driver_name(d).0)
            .collect()
    }
}

/// The results of the count.
#[derive(Clone, Debug)]
pub struct MobilitySurvey {
    /// The counts before any special case.
    pub counts: Counts,
    /// Pins that join three links or more, with the number of links.
    pub compound: Vec<(PointId, usize)>,
    /// Links with a local freedom: they turn about their pin alone.
    pub local: Vec<Local>,
    /// For each choice of drivers that determines the motion, the groups; the choice of the file
    /// first.
    pub choices: Vec<ForDrivers>,
}

/// Greatest number of choices of drivers.
const MOST_CHOICES: usize = 100;

impl MobilitySurvey {
    /// Counts a scene, and tries as many drivers as the count leaves freedoms, at least one.
    pub fn of(scene: &Scene) -> MobilitySurvey {
        MobilitySurvey::driven_by(scene, 1)
    }

    /// Counts a scene like [`MobilitySurvey::of`], with at least `least` drivers.
    pub fn driven_by(scene: &Scene, least: usize) -> MobilitySurvey {
        let (counts, compound, mut local) = counted(scene);
        let mut idle: Vec<LinkId> =
            (0..scene.links.len()).map(LinkId).filter(|l| is_idle(scene, *l)).collect();
        // Of discs on a pin that nothing else carries, one stays, about which the others turn.
        let on_nothing: Vec<LinkId> =
            (0..scene.points.len()).filter_map(|p| alone(scene, PointId(p), &idle)).collect();
        idle.retain(|l| !on_nothing.contains(l));
        local.extend(idle.iter().map(|l| {
            let link = &scene.links[l.0];
            let pin = link
                .points
                .iter()
                .find(|p| scene.carriers(**p).count() > 1)
                .or(link.points.first());
            Local {
                link: link.name.clone(),
                pin: pin.map_or_else(String::new, |p| scene.point_name(*p).into()),
                bare: false,
            }
        }));
        let rest = without(scene, &idle);
        let own = usize::try_from(counts.freedom(0, local.len())).unwrap_or(0).max(least);
        let wanted = if rest.drivers.is_empty() { own } else { rest.drivers.len().max(own) };
        let mut choices: Vec<ForDrivers> = Vec::new();
        if !rest.drivers.is_empty() {
            choices.extend(Mechanism::new(&rest).ok().map(|m| ForDrivers {
                scene: rest.clone(),
                given: true,
                mechanism: m.value,
            }));
        }
        for drivers in sets(&possible(&rest), wanted) {
            let one = Scene { drivers, ..rest.clone() };
            if !choices.iter().any(|c| same_drivers(&c.scene, &one)) {
                choices.extend(Mechanism::new(&one).ok().map(|m| ForDrivers {
                    scene: one,
                    given: false,
                    mechanism: m.value,
                }));
            }
        }
        MobilitySurvey { counts, compound, local, choices }
    }

    /// Returns the counts without local freedoms and without those pairs of
    /// [`MobilitySurvey::redundant`] that `repeat` others, with every higher pair replaced by a
    /// link with two lower pairs 高副低代.
    pub fn substituted(&self, repeat: impl Fn(usize) -> bool) -> Counts {
        let repeated: Vec<&Redundant> = self
            .redundant()
            .iter()
            .enumerate()
            .filter(|(i, _)| repeat(*i))
            .map(|(_, r)| r)
            .collect();
        substituted(self.choices.first().map(|c| &c.scene), self.counts, &self.local, &repeated)
    }

    /// Returns the pairs that only repeat others, as far as topology shows.
    pub fn redundant(&self) -> &[Redundant] {
        self.choices.first().map_or(&[], |c| &c.mechanism.redundant)
    }
}

/// Counts links and pairs as given. A bare pin in two slots is a separate body whose rotation is a
/// local freedom.
fn counted(scene: &Scene) -> (Counts, Vec<(PointId, usize)>, Vec<Local>) {
    let closed =
        OpenedPairs { passive: super::find_passive(scene), redundant: Vec::new(), touches: None };
    let mobility = super::mobility::count(scene, &closed.pins_and_constraints(scene).1);
    let is_end = |p: PointId| {
        scene.drivers.iter().any(|d| d.kind.ends().is_some_and(|ends| ends.contains(&p)))
    };
    let bare = |p: PointId| scene.carriers(p).next().is_none() && !is_end(p);
    let mut local: Vec<Local> = Vec::new();
    for p in scene
        .guides
        .iter()
        .filter(|g| g.slider.is_none() && g.rolling.is_none())
        .filter_map(|g| g.pin)
        .filter(|p| bare(*p))
    {
        let pin = scene.point_name(p).to_owned();
        if !local.iter().any(|l| l.pin == pin) {
            local.push(Local { link: pin.clone(), pin, bare: true });
        }
    }
    // `count` takes the rotation of such a pin as one more pair.
    let counts = Counts {
        moving: mobility.moving,
        lower: mobility.lower,
        higher: mobility.higher - local.len(),
    };
    (counts, compound(scene), local)
}

/// Returns the pins that join three links or more, with the number of links: each counts as one
/// pair less than the links that it joins.
pub fn compound(scene: &Scene) -> Vec<(PointId, usize)> {
    let joined = |p: PointId| {
        let ends = scene
            .drivers
            .iter()
            .filter(|d| d.kind.ends().is_some_and(|ends| ends.contains(&p)))
            .count();
        let parts = |l: &LinkId| scene.drivers.iter().any(|d| d.kind.parts().contains(l));
        scene.carriers(p).filter(|l| !parts(l)).count() + ends
    };
    (0..scene.points.len()).map(PointId).map(|p| (p, joined(p))).filter(|(_, k)| *k > 2).collect()
}

/// Returns true if a link is on one pin of others and nothing else touches it: a roller about its
/// pin. It has no further point, unlike the last arm of an open chain, and is not pinned to the
/// ground, where it may be driven.
fn is_idle(scene: &Scene, l: LinkId) -> bool {
    let [pin] = scene.links[l.0].points[..] else { return false };
    let slides = scene.guides.iter().any(|g| g.on == l || g.slider == Some(l))
        || scene.rolling.iter().any(|r| r.links.contains(&l));
    let ends_there = |kind: &DriverKind| {
        kind.parts().contains(&l) || kind.ends().is_some_and(|ends| ends.contains(&pin))
    };
    let driven = scene.drivers.iter().any(|d| d.kind.turns_link(l) || ends_there(&d.kind));
    let grounded = scene.links[scene.ground.0].points.contains(&pin);
    l != scene.ground && !grounded && scene.carriers(pin).count() > 1 && !slides && !driven
}

/// Returns the first link on a pin that only idle links carry.
fn alone(scene: &Scene, pin: PointId, idle: &[LinkId]) -> Option<LinkId> {
    let first = scene.carriers(pin).next()?;
    let is_end =
        scene.drivers.iter().any(|d| d.kind.ends().is_some_and(|ends| ends.contains(&pin)));
    (!is_end && scene.carriers(pin).all(|l| idle.contains(&l))).then_some(first)
}

/// Returns the scene without some links, which carry nothing.
fn without(scene: &Scene, links: &[LinkId]) -> Scene {
    let mut rest = scene.clone();
    let place = |l: LinkId| LinkId(l.0 - links.iter().filter(|k| k.0 < l.0).count());
    let kept = |i: usize| !links.contains(&LinkId(i));
    rest.links =
        scene.links.iter().enumerate().filter(|(i, _)| kept(*i)).map(|(_, l)| l.clone()).collect();
    rest.ground = place(scene.ground);
    for g in &mut rest.guides {
        (g.on, g.slider) = (place(g.on), g.slider.map(place));
    }
    for r in &mut rest.rolling {
        r.rename(place);
    }
    for d in &mut rest.drivers {
        match &mut d.kind {
            DriverKind::Turn { link, against, .. } => {
                (*link, *against) = (place(*link), place(*against))
            }
            DriverKind::Slide { .. } => {}
            DriverKind::Cylinder { links, .. } => links.iter_mut().for_each(|l| *l = place(*l)),
        }
    }
    for c in &mut rest.cams {
        let own = |l: &&LinkId| scene.links[l.0].points.as_slice() == [c.follows.point()];
        if let (Follows::Roller(..), Some(roller)) = (c.follows, links.iter().find(own)) {
            c.roller = Some(scene.links[roller.0].name.clone());
        }
        (c.cam, c.follower) = (place(c.cam), place(c.follower));
        if let Some(t) = &mut c.disc {
            t.frame = place(t.frame);
        }
    }
    rest.find.clear();
    rest
}

/// Returns the possible drivers: every link that turns about a pivot on ground, every slider that
/// runs on ground.
fn possible(scene: &Scene) -> Vec<Driver> {
    let on_ground = |p: &PointId| scene.links[scene.ground.0].points.contains(p);
    let span = scene.links[scene.ground.0].span;
    let rate = GivenQuantity { value: 0.0, radius: 0.0, text: "0".into(), span };
    let drive = |kind| Driver {
        kind,
        rate: rate.clone(),
        acceleration: None,
        rate_told: false,
        law: None,
        span,
    };
    let cranks = (0..scene.links.len())
        .map(LinkId)
        .filter(|l| *l != scene.ground && scene.links[l.0].points.iter().any(on_ground));
    let turns = cranks.map(|link| DriverKind::Turn {
        link,
        against: scene.ground,
        line: None,
        against_line: None,
        angle: None,
    });
    let guides = (0..scene.guides.len())
        .map(GuideId)
        .filter(|g| scene.guides[g.0].on == scene.ground && scene.guides[g.0].rolling.is_none());
    let slides = guides.map(|guide| DriverKind::Slide { guide, position: None });
    turns.chain(slides).map(drive).collect()
}

fn same_drivers(a: &Scene, b: &Scene) -> bool {
    let of = |s: &Scene| {
        let mut keys: Vec<String> = (0..s.drivers.len()).map(|d| s.driver_name(d).0).collect();
        keys.sort_unstable();
        keys
    };
    of(a) == of(b)
}

/// Returns all sets of `count` drivers, in order.
fn sets(all: &[Driver], count: usize) -> Vec<Vec<Driver>> {
    let mut found: Vec<Vec<usize>> = vec![Vec::new()];
    for _ in 0..count {
        let longer = found.iter().flat_map(|set| {
            let from = set.last().map_or(0, |i| i + 1);
            (from..all.len()).map(|i| set.iter().copied().chain([i]).collect::<Vec<usize>>())
        });
        found = longer.take(MOST_CHOICES).collect();
    }
    found.into_iter().map(|set| set.into_iter().map(|i| all[i].clone()).collect()).collect()
}

/// The scene is the one without idle links, which contains the pairs.
fn substituted(
    scene: Option<&Scene>,
    counts: Counts,
    local: &[Local],
    repeated: &[&Redundant],
) -> Counts {
    let Counts { mut moving, mut lower, mut higher } = counts;
    for _ in local.iter().filter(|l| !l.bare) {
        (moving, lower) = (moving - 1, lower - 1);
    }
    let Some(scene) = scene else { return replaced(Counts { moving, lower, higher }, local) };
    let opened: Vec<LinkId> = repeated
        .iter()
        .filter_map(|r| if let Opened::Link(l) = r.opened { Some(l) } else { None })
        .collect();
    // A pin joins one link less for each removed link; a single link is not joined.
    let gone = |p: PointId| {
        scene
            .carriers(p)
            .filter(|l| opened.contains(l))
            .count()
            .min(scene.carriers(p).count().saturating_sub(1))
    };
    moving -= opened.len();
    lower -= (0..scene.points.len()).map(|p| gone(PointId(p))).sum::<usize>();
    for r in repeated {
        match r.opened {
            Opened::Link(_) => {}
            // With its block: the guide and the pin.
            Opened::Guide(g) if scene.guides[g.0].slider.is_some_and(|s| is_block(scene, s)) => {
                (moving, lower) = (moving - 1, lower - 2)
            }
            Opened::Guide(g) if scene.guides[g.0].slider.is_some() => lower -= 1,
            // A rolling pair that need not hold the wheel takes one freedom.
            Opened::Guide(g) if scene.guides[g.0].rolling.is_some() => {
                (lower, higher) = (lower - 1, higher + 1)
            }
            Opened::Guide(_) => higher -= 1,
            Opened::Rolling(r) if scene.rolling[r.0].kind.is_lower() => lower -= 1,
            Opened::Rolling(_) => higher -= 1,
            Opened::Pin(..) => lower -= 1,
        }
    }
    replaced(Counts { moving, lower, higher }, local)
}

/// Returns the counts with every higher pair as a link with two lower pairs. The body of a bare pin
/// becomes one of the two blocks.
fn replaced(Counts { moving, lower, higher }: Counts, local: &[Local]) -> Counts {
    let bare = local.iter().filter(|l| l.bare).count().min(higher);
    Counts { moving: moving + higher - bare, lower: lower + 2 * higher - bare, higher: 0 }
}

fn is_block(scene: &Scene, l: LinkId) -> bool {
    scene.links[l.0].points.len() == 1 && !scene.guides.iter().any(|g| g.on == l)
}
