//! Assembly of a configuration: places the groups one after the other in solving order.

use super::branch::{self, GroupClosure};
use super::shape::{self, FrameAnchor, LinkShape, given_place};
use super::{Configuration, Path, Pose};
use crate::mechanism::{Core, Demand, Group, Hold, Leg, Mechanism, Passive, Strut};
use hodograph_base::budget::spend;
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_scene::exact::Inputs;
use hodograph_scene::{
    GuideDirection, GuideId, GuidePath, LinkId, PointId, PointPlace, Scene, Through,
};

/// See [`super::recompute`].
pub(super) fn recompute<N: Real>(
    scene: &Scene,
    mechanism: &Mechanism,
    demand: &Demand,
    meant: &Configuration,
) -> Result<Configuration<N>, Faults> {
    Ok(Assembly::new(scene, mechanism, demand, Some(meant))
        .place(demand)?
        .settled()
        .into_configuration())
}

/// See [`super::later`].
pub(super) fn later<'a, N: Real>(
    scene: &'a Scene,
    mechanism: &'a Mechanism,
    demand: &Demand,
    meant: &'a Configuration,
    now: &'a Configuration<N>,
    t: N,
) -> Result<(Configuration<N>, Vec<f64>), Faults> {
    let mut moving = vec![true; scene.points.len()];
    scene.links[scene.ground.0].points.iter().for_each(|p| moving[p.0] = false);
    let mut moving = scene.points.iter().zip(moving).filter(|(_, moving)| *moving);
    let posed = moving.any(|(p, _)| matches!(p.place, PointPlace::At(_)));
    let silent = scene.drivers.iter().any(|d| d.kind.position().is_none());
    // A link that only glides, without a point, has an arbitrary position along its guide.
    let pointless =
        mechanism.groups.iter().flat_map(|g| &g.links).any(|l| scene.links[l.0].points.is_empty());
    if posed || silent || pointless {
        return Err(Diagnostic::error(
            "pose-given",
            both!("nothing in the scene tells the pose at another time"),
        )
        .into());
    }
    let mut a = Assembly::new(scene, mechanism, demand, Some(meant));
    a.inputs = a.inputs.later(t);
    a.instant = Some(now);
    a.guides.clone_from(&now.shapes.guides);
    let placed = a.place(demand)?.settled();
    let apart = placed.apart.clone();
    Ok((placed.into_configuration(), apart))
}

/// An assembly in progress: the parts placed so far.
pub(super) struct Assembly<'a, N> {
    pub scene: &'a Scene,
    pub m: &'a Mechanism,
    pub inputs: Inputs<'a, N>,
    /// The known assembly, if only its numbers are to be improved.
    pub meant: Option<&'a Configuration>,
    /// The configuration at the scene's instant, for an assembly at a later time.
    pub instant: Option<&'a Configuration<N>>,
    pub shapes: Vec<LinkShape<N>>,
    pub points: Vec<Option<Point<N>>>,
    pub poses: Vec<Option<Pose<N>>>,
    pub guides: Vec<Option<Path<N>>>,
    /// For each group the index of the closure taken.
    pub closures: Vec<usize>,
    /// For each group the largest distance of a pin (m) in the closure taken and in the other one;
    /// infinite without another one.
    pub apart: Vec<f64>,
    /// Groups with a closure that nothing in the scene determines, with the number of their
    /// closures.
    pub open: Vec<(usize, usize)>,
    /// One of these groups, and the index of the closure that is taken instead of the first.
    pub instead: Option<(usize, usize)>,
    pub faults: Faults,
    pub notes: Vec<Diagnostic>,
}

impl<'a, N: Real> Assembly<'a, N> {
    pub(super) fn new(
        scene: &'a Scene,
        m: &'a Mechanism,
        demand: &Demand,
        meant: Option<&'a Configuration>,
    ) -> Self {
        let inputs = Inputs::of(scene);
        let mut faults = Faults::default();
        let wanted = |l: LinkId| {
            l == scene.ground
                || m.group_of_link[l.0].is_some_and(|g| demand.groups[g].is_some())
                || m.passive[l.0].is_some_and(|p| matches!(p, Passive::Block(_)))
                || m.held(l).is_some_and(|(a, b)| demand.places(m, a) && demand.places(m, b))
        };
        let shapes: Vec<LinkShape<N>> = (0..scene.links.len())
            .map(LinkId)
            .map(|l| {
                if wanted(l) {
                    shape::of_link(scene, &inputs, l, meant.is_none(), &mut faults)
                } else {
                    LinkShape { points: Vec::new(), frame: FrameAnchor::Loose }
                }
            })
            .collect();
        let guides = (0..scene.guides.len())
            .map(GuideId)
            .map(|g| shape::guide_in_link(scene, &inputs, m, &shapes[scene.guides[g.0].on.0], g))
            .collect();
        let mut a = Assembly {
            scene,
            m,
            inputs,
            meant,
            instant: None,
            shapes,
            closures: vec![0; m.groups.len()],
            apart: vec![f64::INFINITY; m.groups.len()],
            points: vec![None; scene.points.len()],
            poses: vec![None; scene.links.len()],
            guides,
            open: Vec::new(),
            instead: None,
            faults,
            notes: Vec::new(),
        };
        a.poses[scene.ground.0] = Some(Pose::ground());
        for (p, at) in &a.shapes[scene.ground.0].points {
            a.points[p.0] = Some(*at);
        }
        a
    }

    /// Places group after group.
    pub(super) fn place(self, demand: &Demand) -> Result<Self, Faults> {
        self.go(demand).closed()
    }

    /// Returns the assembly if there are no errors.
    pub(super) fn closed(self) -> Result<Self, Faults> {
        if self.faults.has_errors() { Err(self.faults) } else { Ok(self) }
    }

    /// Places group after group, as far as possible.
    pub(super) fn go(mut self, demand: &Demand) -> Self {
        if self.faults.has_errors() {
            return self;
        }
        let m = self.m;
        let mut failed = vec![false; m.groups.len()];
        for (i, group) in m.groups.iter().enumerate() {
            spend();
            if demand.groups[i].is_none() {
                continue;
            }
            if group.upstream.iter().any(|u| failed[*u]) {
                failed[i] = true;
            } else if let Err(d) = self.solve(i, group) {
                self.faults.push(d);
                failed[i] = true;
            }
        }
        self
    }

    /// Returns the pose of a link in the known assembly.
    pub(super) fn known_pose(&self, link: LinkId) -> Option<Pose> {
        self.meant.and_then(|m| m.poses[link.0])
    }

    /// Returns a guide in the plane: from the shape of its link if that suffices, otherwise from
    /// the pose and the position of the pin.
    pub(super) fn guide_in_plane(&self, g: GuideId) -> Option<Path<N>> {
        let guide = &self.scene.guides[g.0];
        let pose = self.poses[guide.on.0]?;
        if let Some(path) = self.guides[g.0] {
            return Some(path.to_world(&pose));
        }
        let pin = guide.pin.and_then(|p| self.points[p.0]);
        match &guide.path {
            GuidePath::Arc { centre, .. } => {
                let centre = pose.to_world(self.shapes[guide.on.0].local(*centre)?);
                Some(Path::Arc { centre, radius: pin?.distance(centre) })
            }
            GuidePath::Line { through, direction, offset } => {
                let direction = match direction {
                    GuideDirection::Instant(angle) => {
                        let (s, c) = self.inputs.sin_cos(angle);
                        Vec2::new(c, s)
                    }
                    GuideDirection::Along(a, b, angle) => {
                        let base = (self.points[b.0]? - self.points[a.0]?).unit()?;
                        match angle {
                            Some(angle) => {
                                let (s, c) = self.inputs.sin_cos(angle);
                                Vec2::new(c, s).rotate_by(base)
                            }
                            None => base,
                        }
                    }
                    GuideDirection::Own => pose.axis,
                    GuideDirection::Slid(angle) => {
                        let (s, c) = self.inputs.sin_cos(angle);
                        Vec2::new(c, s).rotate_by(self.slid_along(guide.on)?)
                    }
                };
                let through = match through {
                    Through::Point(p) => pose.to_world(self.shapes[guide.on.0].local(*p)?),
                    Through::At([x, y]) => Point::new(self.inputs.number(x), self.inputs.number(y)),
                    // A slider without a pin keeps any distance that it has: the line is arbitrary.
                    Through::Pin if guide.pin.is_none() => pose.origin,
                    Through::Pin => pin?,
                };
                let through = offset
                    .as_ref()
                    .map_or(through, |o| through + direction.perp() * self.inputs.number(o));
                Some(Path::Line { through, direction })
            }
        }
    }

    /// Returns the guide in the plane, or a diagnostic about the missing data.
    pub(super) fn need_guide(&self, g: GuideId) -> Result<Path<N>, Diagnostic> {
        self.guide_in_plane(g).ok_or_else(|| {
            let message = both!(
                "{} is not placed: nothing says through which point it runs",
                self.scene.guide_words(g)
            );
            Diagnostic::error("guide-not-placed", message).at(self.scene.guides[g.0].span).help(both!(
                "give \"through\" (a point of that link, or coordinates on ground), or the pin's coordinates in \"points\""
            ))
        })
    }

    pub(super) fn world(&self, l: LinkId, p: PointId) -> Option<Point<N>> {
        Some(self.poses[l.0]?.to_world(self.shapes[l.0].local(p)?))
    }

    pub(super) fn solve(&mut self, index: usize, group: &Group) -> Result<(), Diagnostic> {
        // Coordinates in the scene are taken as given; the frame of a link with two such points is
        // that of the plane.
        let given_pins: Vec<(PointId, Point<N>)> = group
            .pins
            .iter()
            .filter_map(|p| given_place(self.scene, &self.inputs, *p).map(|at| (*p, at)))
            .collect();
        for &(p, at) in &given_pins {
            self.points[p.0] = Some(at);
        }
        for &l in &group.links {
            if self.shapes[l.0].frame == FrameAnchor::Plane {
                self.poses[l.0] = Some(Pose::ground());
            }
        }
        let trials = match &group.core {
            Core::Pin { pin, legs } => {
                let places = match self.points[pin.0] {
                    Some(at) => vec![at],
                    None => self.places_of_pin(*pin, legs)?,
                };
                places
                    .into_iter()
                    .map(|at| self.trial_of_pin(group, *pin, at))
                    .collect::<Result<Vec<_>, _>>()?
            }
            Core::Link { link, legs } => {
                let poses = match self.poses[link.0] {
                    Some(pose) => vec![pose],
                    None => {
                        self.nearest_to_given(*link, &given_pins, self.poses_of_link(*link, legs)?)
                    }
                };
                poses
                    .into_iter()
                    .map(|pose| self.trial_of_link(group, *link, pose, legs))
                    .collect::<Result<Vec<_>, _>>()?
            }
            Core::Higher => {
                let pins = self.given_pins_of(group, given_pins);
                let told: Option<Vec<_>> =
                    group.links.iter().map(|l| Some((*l, self.given_pose(*l, &pins)?))).collect();
                if let (true, Some(poses)) = (pins.len() == group.pins.len(), told) {
                    vec![self.trial(pins, poses)]
                } else {
                    vec![self.newton_trial(index, group)?]
                }
            }
        };
        let scene = self.scene;
        let names = || names_of(scene, group);
        let pick = match self.meant {
            // If `f64` cannot distinguish the closures, these numbers choose again, by the same
            // rules.
            Some(meant) => {
                let again = N::refines() && branch::alike(&trials, meant.extent());
                let chosen = if again {
                    branch::choose(self.scene, &self.points, &trials, 0, &names).ok()
                } else {
                    None
                };
                chosen.map_or(meant.closures[index], |choice| choice.pick)
            }
            None => {
                let instead = self
                    .instead
                    .filter(|(group, _)| *group == index)
                    .map_or(0, |(_, instead)| instead);
                let choice = branch::choose(self.scene, &self.points, &trials, instead, &names)?;
                self.notes.extend(choice.note);
                self.open.extend((choice.open > 0).then_some((index, choice.open)));
                choice.pick
            }
        };
        self.closures[index] = pick;
        // Coordinates may leave only one of several closures.
        let other = trials.get((1 - pick.min(1)).min(trials.len() - 1));
        let pick = pick.min(trials.len() - 1);
        if let Some(other) = other.filter(|_| trials.len() > 1) {
            let pins = group.pins.iter().filter(|p| self.points[p.0].is_none());
            let moved = pins.filter_map(|p| Some((other.at(*p)?, trials[pick].at(*p)?)));
            let distances = moved.map(|(a, b)| a.distance(b).approx());
            self.apart[index] = distances.fold(0.0, f64::max);
        }
        let chosen = trials.into_iter().nth(pick).expect("the chosen closure is one of the trials");
        for (l, pose) in chosen.poses {
            self.poses[l.0] = Some(pose);
        }
        for (p, at) in chosen.points {
            if self.points[p.0].is_none() {
                self.points[p.0] = Some(at);
            }
        }
        Ok(())
    }

    /// If pins of the group have coordinates, returns only the pose that puts the link there.
    pub(super) fn nearest_to_given(
        &self,
        link: LinkId,
        given: &[(PointId, Point<N>)],
        poses: Vec<Pose<N>>,
    ) -> Vec<Pose<N>> {
        let off = |pose: &Pose<N>| -> f64 {
            given
                .iter()
                .filter_map(|(p, at)| {
                    Some((pose.to_world(self.shapes[link.0].local(*p)?) - *at).approx().norm2())
                })
                .sum()
        };
        if given.is_empty() {
            return poses;
        }
        poses.into_iter().min_by(|a, b| off(a).total_cmp(&off(b))).into_iter().collect()
    }

    /// Returns a closure with the points of all its links.
    pub(super) fn trial(
        &self,
        pins: Vec<(PointId, Point<N>)>,
        poses: Vec<(LinkId, Pose<N>)>,
    ) -> GroupClosure<N> {
        let mut points = pins;
        points.reserve(poses.iter().map(|(l, _)| self.shapes[l.0].points.len()).sum());
        for (l, pose) in &poses {
            for (p, local) in &self.shapes[l.0].points {
                if !points.iter().any(|(q, _)| q == p) && self.points[p.0].is_none() {
                    points.push((*p, pose.to_world(*local)));
                }
            }
        }
        GroupClosure { points, poses }
    }

    /// Returns the pose of a link from two of its points.
    pub(super) fn pose_from_points(
        &self,
        l: LinkId,
        a: (PointId, Point<N>),
        b: (PointId, Point<N>),
    ) -> Result<Pose<N>, Diagnostic> {
        if self.shapes[l.0].frame == FrameAnchor::Plane {
            return Ok(Pose::ground());
        }
        let local =
            |p: PointId| self.shapes[l.0].local(p).expect("a link's points have local places");
        let (la, lb) = (local(a.0), local(b.0));
        Pose::from_point_and_direction(la, lb - la, a.1, b.1 - a.1).ok_or_else(|| {
            let (pa, pb) = (self.scene.point_name(a.0), self.scene.point_name(b.0));
            Diagnostic::error(
                "coincident-points",
                both!(
                    "{pa} and {pb} of link {} coincide: it has no direction",
                    self.scene.link_name(l)
                ),
            )
            .at(self.scene.links[l.0].span)
        })
    }

    pub(super) fn trial_of_pin(
        &self,
        group: &Group,
        pin: PointId,
        at: Point<N>,
    ) -> Result<GroupClosure<N>, Diagnostic> {
        let Core::Pin { legs, .. } = &group.core else { unreachable!("called for pin cores only") };
        let mut poses = Vec::with_capacity(legs.len());
        for leg in legs {
            let Some(Hold::Distance { far, strut, .. }) = leg.hold() else { continue };
            match strut {
                Strut::Bar(link) => poses
                    .push((link, self.pose_from_points(link, (far, self.known(far)), (pin, at))?)),
                Strut::Ram { link, guide, driver } => {
                    let stated = self.scene.drivers[driver].kind.length().is_some();
                    let pose = if let Some(pose) = self.poses[link.0] {
                        pose
                    } else if !stated && matches!(self.scene.points[pin.0].place, PointPlace::At(_))
                    {
                        // Coordinates of the pin determine the slider's position: the slot is
                        // placed over them.
                        let poses = self.poses_of_lever(link, far, pin, guide)?;
                        poses.into_iter().next().ok_or_else(|| self.no_closure(link))?
                    } else {
                        let runner = self.runner_in_link(link, guide, driver)?;
                        let d = self.shapes[link.0]
                            .local(far)
                            .expect("a link's points have local places");
                        let far_at = self.known(far);
                        Pose::from_point_and_direction(d, runner - d, far_at, at - far_at)
                            .ok_or_else(|| {
                                self.degenerate(guide, both!("the pin lies on the pivot"))
                            })?
                    };
                    poses.push((link, pose));
                }
                // Barrel and rod are no links of the group.
                Strut::Cylinder(_) => {}
            }
        }
        Ok(self.trial(vec![(pin, at)], poses))
    }

    pub(super) fn trial_of_link(
        &self,
        group: &Group,
        link: LinkId,
        pose: Pose<N>,
        legs: &[Leg],
    ) -> Result<GroupClosure<N>, Diagnostic> {
        let mut poses = vec![(link, pose)];
        let mut pins = Vec::new();
        for &p in &group.pins {
            let local = self.shapes[link.0].local(p).expect("the group's pins sit on its core");
            pins.push((p, self.points[p.0].unwrap_or(pose.to_world(local))));
        }
        for leg in legs {
            if let Some((bar, near, far)) = leg.hold().and_then(|h| h.bar()) {
                let near_at = pins
                    .iter()
                    .find(|(p, _)| *p == near)
                    .map(|p| p.1)
                    .expect("a bar ends at a pin of its group");
                poses.push((
                    bar,
                    self.pose_from_points(bar, (far, self.known(far)), (near, near_at))?,
                ));
            }
        }
        Ok(self.trial(pins, poses))
    }

    /// Returns the position of a pin that an earlier group placed.
    pub(super) fn known(&self, p: PointId) -> Point<N> {
        self.points[p.0].expect("groups come after those they need")
    }

    pub(super) fn degenerate(&self, g: GuideId, why: Both) -> Diagnostic {
        let guide = self.scene.guide_words(g);
        Diagnostic::error("degenerate-guide", both!("{} gives it no direction: {}", guide, why))
            .at(self.scene.guides[g.0].span)
    }

    /// Returns the position of a driven runner in the frame of the link that carries its guide.
    pub(super) fn runner_in_link(
        &self,
        link: LinkId,
        guide: GuideId,
        driver: usize,
    ) -> Result<Point<N>, Diagnostic> {
        let path = self.guides[guide.0].ok_or_else(|| {
            Diagnostic::error(
                "guide-not-placed",
                both!(
                    "the guide on link {} is not placed in that link",
                    self.scene.link_name(link)
                ),
            )
            .at(self.scene.guides[guide.0].span)
            .help(both!("give \"line\" or \"through\" by points of the link"))
        })?;
        Ok(path.point_at(self.way_along(driver)?))
    }

    pub(super) fn driver_without_value(&self, driver: usize, key: &str, what: Both) -> Diagnostic {
        Diagnostic::error(
            "driver-without-position",
            both!("the driver does not say {}, and no coordinates give it", what),
        )
        .at(self.scene.drivers[driver].span)
        .help(both!(
            "add \"{key}\" to the driver, or the coordinates of the moving joints to \"points\""
        ))
    }
}

/// Returns the links of a group for a sentence that begins with "link".
pub(super) fn names_of(scene: &Scene, group: &Group) -> Both {
    let names: Vec<_> = group.links.iter().map(|l| scene.link_name(*l)).collect();
    match names[..] {
        [one] => Both::same(format!(" {one}")),
        _ => both!("s {}", Both::names(&names)),
    }
}
