//! The joints of a group for the analysis of forces: inner joints, and outer joints to the links
//! that hold the group.

use super::Party;
use hodograph_base::diag::{Both, both};
use hodograph_mechanism::mechanism::Mechanism;
use hodograph_mechanism::position::Configuration;
use hodograph_scene::quantity::{met_at, parties};
use hodograph_scene::{GuideId, GuidePath, LinkId, PointId, RollingId, Scene, Touch};

/// The centre about which one link turns on another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hinge {
    /// The pin, or the centre of the curved guide.
    pub at: PointId,
    /// The kind of connection.
    pub kind: HingeKind,
}

/// The kind of connection at a hinge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HingeKind {
    /// A common pin.
    Pin,
    /// A curved guide: its slider turns about the centre of the arc like about a pin.
    Arc(GuideId),
    /// A pin of one link in a slot of the other, along which a driver moves it.
    Driven {
        /// The slot.
        guide: GuideId,
        /// The driver.
        driver: usize,
    },
}

impl Hinge {
    /// Returns the pin of a pinned hinge.
    pub fn pin(self) -> Option<PointId> {
        match self.kind {
            HingeKind::Pin | HingeKind::Driven { .. } => Some(self.at),
            HingeKind::Arc(_) => None,
        }
    }

    /// Returns the curved guide, if the hinge is one.
    pub fn arc(self) -> Option<GuideId> {
        if let HingeKind::Arc(guide) = self.kind { Some(guide) } else { None }
    }
}

impl From<PointId> for Hinge {
    fn from(at: PointId) -> Hinge {
        Hinge { at, kind: HingeKind::Pin }
    }
}

/// A joint by which other links hold a group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OuterJoint {
    /// A hinge: two unknowns.
    Pin {
        /// The place.
        hinge: Hinge,
        /// The link of the group.
        on: LinkId,
        /// The party that holds the link there.
        by: Party,
    },
    /// A straight guide with a slider: the unknowns are the normal force and its line of action.
    Slide {
        /// The guide.
        guide: GuideId,
        /// The link of the group.
        on: LinkId,
        /// The other link.
        by: LinkId,
        /// The reference point for the line of action of the force.
        at: PointId,
    },
    /// A pin in a slot: a force square to the slot.
    Slot {
        /// The guide.
        guide: GuideId,
        /// The pin.
        at: PointId,
        /// The link of the group.
        on: LinkId,
        /// The other link, or the pin if the slot is on the group's link and its pin joins several
        /// links.
        by: Party,
    },
    /// Teeth in mesh, or the friction of a wheel: a force along the line of action. A path that
    /// keeps the wheel in contact presses on its centre.
    Mesh {
        /// The pair.
        rolling: RollingId,
        /// The point of contact.
        at: PointId,
        /// The link of the group.
        on: LinkId,
        /// The other link.
        by: LinkId,
    },
    /// A cylinder without loads on its parts: a force along its line.
    Cylinder {
        /// The driver.
        driver: usize,
        /// The pin on the link of the group.
        at: PointId,
        /// The other pin.
        far: PointId,
        /// The link of the group.
        on: LinkId,
    },
    /// A driver that turns a link: a moment.
    Turn {
        /// The driver.
        driver: usize,
        /// The link of the group.
        on: LinkId,
        /// The link relative to which it turns.
        against: LinkId,
    },
    /// The balancing force of a driver at a point, in a given direction.
    Balance {
        /// The driver.
        driver: usize,
        /// The point.
        at: PointId,
        /// The link of the group.
        on: LinkId,
    },
    /// A driver that pushes a slider along its guide.
    Push {
        /// The driver.
        driver: usize,
        /// The guide.
        guide: GuideId,
        /// The link of the group.
        on: LinkId,
        /// The other link.
        by: LinkId,
    },
}

/// The joint between the two links of a dyad.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DyadJoint {
    /// A hinge.
    Pin(Hinge),
    /// A straight guide with its slider and the link that carries it.
    Slide {
        /// The guide.
        guide: GuideId,
        /// The slider.
        slider: LinkId,
        /// The link that carries the guide.
        on: LinkId,
    },
}

/// True if a link turns about a hinge.
pub(super) fn turns_on(scene: &Scene, link: LinkId, hinge: Hinge) -> bool {
    let carries = scene.links[link.0].points.contains(&hinge.at);
    match hinge.kind {
        HingeKind::Pin => carries,
        HingeKind::Arc(guide) => sides(scene, guide).is_some_and(|sides| sides.contains(&link)),
        HingeKind::Driven { guide, .. } => carries || scene.guides[guide.0].on == link,
    }
}

/// Returns a slider and the link that carries its guide.
pub(super) fn sides(scene: &Scene, g: GuideId) -> Option<[LinkId; 2]> {
    let guide = &scene.guides[g.0];
    Some([guide.slider?, guide.on])
}

/// The joints of a group's links.
pub(super) struct Joints {
    pub outer: Vec<OuterJoint>,
    pub inner: Vec<DyadJoint>,
}

impl Joints {
    /// Returns the reason for which a group is not drawn: no method covers its joints.
    pub fn no_method(&self, scene: &Scene, links: &[LinkId]) -> Both {
        let point = |p: PointId| scene.point_name(p);
        let slider = |g: GuideId| {
            let name = scene.guides[g.0].slider.map_or("", |s| scene.link_name(s));
            both!("slider {name}")
        };
        let hinged =
            |hinge: Hinge| hinge.arc().map_or_else(|| both!("pin {}", point(hinge.at)), slider);
        let outer = self.outer.iter().map(|o| match *o {
            OuterJoint::Pin { hinge, .. } => hinged(hinge),
            OuterJoint::Slide { guide, .. } => slider(guide),
            OuterJoint::Slot { at, .. } => both!("pin {} in a slot", point(at)),
            OuterJoint::Mesh { at, .. } => both!("contact {}", point(at)),
            OuterJoint::Cylinder { at, .. } => {
                both!("cylinder at {}", point(at))
            }
            OuterJoint::Balance { at, .. } => {
                both!("balancing force at {}", point(at))
            }
            OuterJoint::Turn { driver, .. } | OuterJoint::Push { driver, .. } => {
                both!("driver {}", driver + 1)
            }
        });
        let inner = self.inner.iter().map(|pair| match *pair {
            DyadJoint::Pin(hinge) => hinged(hinge),
            DyadJoint::Slide { guide, .. } => slider(guide),
        });
        let all = Both::listed(&outer.chain(inner).collect::<Vec<_>>());
        both!("there is no method for {} links with {}", links.len(), all)
    }
}

/// Returns the reference point for the line of action of a guide's force: the pin that runs there,
/// otherwise the slider's first placed joint.
pub(super) fn reference(
    scene: &Scene,
    g: GuideId,
    placed: impl Fn(PointId) -> bool,
) -> Option<PointId> {
    let guide = &scene.guides[g.0];
    guide.pin.filter(|p| placed(*p)).or_else(|| met_at(scene, guide.slider?).find(|p| placed(*p)))
}

/// Returns the party that presses on a link at a hinge: the other link if there is only one,
/// otherwise the pin.
pub(super) fn party(scene: &Scene, hinge: Hinge, on: LinkId) -> Party {
    let at = hinge.at;
    match hinge.kind {
        HingeKind::Pin => {}
        HingeKind::Arc(guide) => {
            let other = sides(scene, guide).and_then(|sides| sides.into_iter().find(|l| *l != on));
            return other.map_or(Party::Pin(at), Party::Link);
        }
        // The slot and the driver press on the pin together.
        HingeKind::Driven { .. } => return Party::Pin(at),
    }
    let mut others = scene.carriers(at).filter(|l| *l != on);
    match (others.next(), others.next(), parties(scene, at)) {
        (Some(other), None, 2) => Party::Link(other),
        _ => Party::Pin(at),
    }
}

/// Returns the joints of links among themselves and with links that are not yet in equilibrium
/// (`open`).
///
/// # Errors
/// A joint for which there is no method.
pub(super) fn joints(
    scene: &Scene,
    m: &Mechanism,
    at: &Configuration,
    links: &[LinkId],
    open: &[bool],
) -> Result<Joints, Both> {
    let (mut outer, mut inner) = (Vec::new(), Vec::new());
    let mine = |l: LinkId| links.contains(&l);
    let upstream = |l: LinkId| open[l.0] && !mine(l);
    let cylinder = |d: usize| scene.drivers[d].kind.parts();
    let ends_of = |d: usize| scene.drivers[d].kind.ends();
    for p in (0..scene.points.len()).map(PointId).filter(|p| at.points[p.0].is_some()) {
        let here: Vec<LinkId> = scene.carriers(p).filter(|l| mine(*l)).collect();
        if here.is_empty() || parties(scene, p) < 2 {
            continue;
        }
        let runs = |g: &usize| scene.guides[*g].pin == Some(p) && scene.guides[*g].slider.is_none();
        let slots: Vec<usize> = (0..scene.guides.len())
            .filter(|g| runs(g) && m.guide_holds(&scene.guides[*g], GuideId(*g)))
            .collect();
        let rods: Vec<usize> = (0..scene.drivers.len())
            .filter(|d| ends_of(*d).is_some_and(|ends| ends.contains(&p)))
            .filter(|d| !cylinder(*d).iter().any(|l| mine(*l)))
            // A cylinder that moves a link in equilibrium is a load of its pin.
            .filter(|d| {
                ends_of(*d)
                    .into_iter()
                    .flatten()
                    .any(|q| q != p && scene.carriers(q).any(|l| mine(l) || upstream(l)))
            })
            .collect();
        let rod_links: Vec<LinkId> = rods.iter().flat_map(|d| cylinder(*d)).copied().collect();
        let held: Vec<LinkId> =
            scene.carriers(p).filter(|l| upstream(*l) && !rod_links.contains(l)).collect();
        let pin = Hinge::from(p);
        match (&slots[..], &rods[..], &here[..]) {
            // A cylinder on the pin of a link that still holds the group belongs to the group of
            // that link.
            ([], _, [..]) if !held.is_empty() => {
                outer.extend(here.iter().map(|on| OuterJoint::Pin {
                    hinge: pin,
                    on: *on,
                    by: party(scene, pin, *on),
                }));
            }
            ([], [], [_]) => {}
            ([], [], [_, _]) => inner.push(DyadJoint::Pin(pin)),
            // A cylinder belongs to the group that it moves.
            ([], [d], [on]) if held.is_empty() => {
                let [a, b] = scene.drivers[*d].kind.ends().unwrap_or([p, p]);
                outer.push(OuterJoint::Cylinder {
                    driver: *d,
                    at: p,
                    far: if a == p { b } else { a },
                    on: *on,
                });
            }
            // The slot holds the pin together with the last of its links.
            ([g], [], [on]) if !held.is_empty() && !mine(scene.guides[*g].on) => {
                outer.push(OuterJoint::Pin { hinge: pin, on: *on, by: Party::Pin(p) });
            }
            ([g], [], [on]) if held.is_empty() => {
                let (guide, by) = (GuideId(*g), scene.guides[*g].on);
                match driven(scene, guide) {
                    Some(hinge) if upstream(by) => {
                        outer.push(OuterJoint::Pin { hinge, on: *on, by: Party::Pin(p) })
                    }
                    Some(hinge) if mine(by) => inner.push(DyadJoint::Pin(hinge)),
                    None if upstream(by) => {
                        outer.push(OuterJoint::Slot { guide, at: p, on: *on, by: Party::Link(by) })
                    }
                    None if mine(by) => {
                        let (pin, slot) = (scene.point_name(p), scene.link_name(by));
                        return Err(both!(
                            "pin {pin} runs in a slot of link {slot}, which belongs to the same group"
                        ));
                    }
                    Some(_) | None => {}
                }
            }
            _ => return Err(too_many(scene, p)),
        }
    }
    for (g, guide) in scene.guides.iter().enumerate() {
        let id = GuideId(g);
        if at.guides[g].is_none() || !m.guide_holds(guide, id) {
            continue;
        }
        match guide.slider {
            Some(slider) => {
                let arc = match guide.path {
                    GuidePath::Arc { centre, .. } => {
                        Some(Hinge { at: centre, kind: HingeKind::Arc(id) })
                    }
                    GuidePath::Line { .. } => None,
                };
                match (mine(slider), mine(guide.on)) {
                    (true, true) => inner.push(arc.map_or(
                        DyadJoint::Slide { guide: id, slider, on: guide.on },
                        DyadJoint::Pin,
                    )),
                    (true, false) | (false, true) => {
                        let (on, by) =
                            if mine(slider) { (slider, guide.on) } else { (guide.on, slider) };
                        if upstream(by) {
                            let at = reference(scene, id, |p| at.points[p.0].is_some())
                                .ok_or_else(|| {
                                    both!(
                                        "the slider {} meets nothing at a point",
                                        scene.link_name(slider)
                                    )
                                })?;
                            let slide = OuterJoint::Slide { guide: id, on, by, at };
                            outer.push(arc.map_or(slide, |hinge| OuterJoint::Pin {
                                hinge,
                                on,
                                by: Party::Link(by),
                            }));
                        }
                    }
                    (false, false) => {}
                }
            }
            // The slot is on a link of the group; its pin is on a link that holds the group.
            None => {
                let Some(p) = guide.pin.filter(|_| mine(guide.on)) else { continue };
                let hinge = driven(scene, id);
                if scene.carriers(p).any(mine) {
                    if hinge.is_some_and(|hinge| inner.contains(&DyadJoint::Pin(hinge))) {
                        continue;
                    }
                    return Err(too_many(scene, p));
                }
                let pushed = scene
                    .drivers
                    .iter()
                    .any(|d| d.kind.ends().is_some_and(|ends| ends.contains(&p)));
                let slots =
                    scene.guides.iter().filter(|g| g.pin == Some(p) && g.slider.is_none()).count();
                if pushed && slots > 1 {
                    return Err(too_many(scene, p));
                }
                if let Some(by) = scene.carriers(p).find(|l| upstream(*l)) {
                    let by = if parties(scene, p) == 2 { Party::Link(by) } else { Party::Pin(p) };
                    let on = guide.on;
                    outer.push(
                        hinge.map_or(OuterJoint::Slot { guide: id, at: p, on, by }, |hinge| {
                            OuterJoint::Pin { hinge, on, by: Party::Pin(p) }
                        }),
                    );
                }
            }
        }
    }
    for (r, pair) in scene.rolling.iter().enumerate() {
        let rolling = RollingId(r);
        let [a, b] = pair.links;
        let (on, by) = match (mine(a), mine(b)) {
            (true, true) => {
                let [a, b] = [a, b].map(|l| scene.link_name(l));
                return Err(both!("its links {a} and {b} roll on each other"));
            }
            (true, false) if upstream(b) => (a, b),
            (false, true) if upstream(a) => (b, a),
            _ => continue,
        };
        let place = pair.at[0];
        if !matches!(pair.touch(), Touch::Point(_)) || at.points[place.0].is_none() {
            return Err(both!("the pull of belts, chains and ropes is not drawn"));
        }
        outer.push(OuterJoint::Mesh { rolling, at: place, on, by });
    }
    for (d, driver) in scene.drivers.iter().enumerate() {
        if let Some((link, against)) = driver.kind.turned() {
            if mine(link) {
                outer.push(balance(scene, d, link)?.unwrap_or(OuterJoint::Turn {
                    driver: d,
                    on: link,
                    against,
                }));
            } else if mine(against) && open[link.0] {
                let [of, on] = [against, link].map(|l| scene.link_name(l));
                return Err(both!("a driver on its link {of} turns link {on}"));
            }
        }
        if let Some(guide) = driver.kind.guide().filter(|g| driven(scene, *g).is_none()) {
            let g = &scene.guides[guide.0];
            let runner = g.slider.or_else(|| scene.carriers(g.pin?).next());
            for (on, by) in runner.into_iter().flat_map(|runner| [(runner, g.on), (g.on, runner)]) {
                if mine(on) && upstream(by) {
                    outer.push(balance(scene, d, on)?.unwrap_or(OuterJoint::Push {
                        driver: d,
                        guide,
                        on,
                        by,
                    }));
                }
            }
        }
    }
    Ok(Joints { outer, inner })
}

/// Returns the reason for which a pin has no construction.
pub(super) fn too_many(scene: &Scene, pin: PointId) -> Both {
    both!("pin {} joins too many for a construction", scene.point_name(pin))
}

/// Returns the pin that a driver moves along a slot.
fn driven(scene: &Scene, guide: GuideId) -> Option<Hinge> {
    let g = &scene.guides[guide.0];
    let at = g.pin.filter(|_| g.slider.is_none() && scene.loads.balance.is_none())?;
    let driver = scene.drivers.iter().position(|d| d.kind.guide() == Some(guide))?;
    Some(Hinge { at, kind: HingeKind::Driven { guide, driver } })
}

/// Returns the balancing force on a driver's link, which replaces the driver's moment or push.
///
/// # Errors
/// A balance on another link.
fn balance(scene: &Scene, driver: usize, on: LinkId) -> Result<Option<OuterJoint>, Both> {
    let Some(balance) = &scene.loads.balance else { return Ok(None) };
    if balance.link != on {
        return Err(both!("the balance does not act on the link of the driver"));
    }
    Ok(balance.force.as_ref().map(|(at, _)| OuterJoint::Balance { driver, at: *at, on }))
}
