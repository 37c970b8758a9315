//! Group after group to a configuration.

use super::branch::{self, Trial};
use super::kernel::{self, Locus, Miss};
use super::newton;
use super::shape::{self, Frame, LinkShape, given_at};
use super::triad::{self, TriadLeg};
use super::{Configuration, Path, Pose, Shapes};
use crate::diag::{Diagnostic, Faults, Warned};
use crate::geom::{Point, Vec2};
use crate::mechanism::{Core, Demand, Group, Leg, Mechanism, Passive};
use crate::quantity::metres;
use crate::scene::{Direction, DriverKind, GuideId, GuidePath, LinkId, PointId, Scene, Through};
use crate::trig;

/// Finds where everything is that the demand calls for.
///
/// # Errors
/// Missing and contradictory lengths, groups that cannot be assembled (with the links and the amount by which they miss),
/// poses that nothing fixes. All faults of independent groups are reported together.
pub fn configure(scene: &Scene, mechanism: &Mechanism, demand: &Demand) -> Result<Warned<Configuration>, Faults> {
    let mut a = Assembly::new(scene, mechanism, demand);
    if a.faults.has_errors() {
        return Err(a.faults);
    }
    let mut failed = vec![false; mechanism.groups.len()];
    for (i, group) in mechanism.groups.iter().enumerate() {
        if demand.groups[i].is_none() {
            continue;
        }
        if group.upstream.iter().any(|u| failed[*u]) {
            failed[i] = true;
        } else if let Err(d) = a.solve(i, group) {
            a.faults.push(d);
            failed[i] = true;
        }
    }
    if a.faults.has_errors() {
        return Err(a.faults);
    }
    a.finish()
}

struct Assembly<'a> {
    scene: &'a Scene,
    m: &'a Mechanism,
    shapes: Vec<LinkShape>,
    points: Vec<Option<Point>>,
    poses: Vec<Option<Pose>>,
    guides: Vec<Option<Path>>,
    faults: Faults,
    notes: Vec<Diagnostic>,
}

impl<'a> Assembly<'a> {
    fn new(scene: &'a Scene, m: &'a Mechanism, demand: &Demand) -> Self {
        let mut faults = Faults::default();
        let wanted = |l: LinkId| {
            l == scene.ground
                || m.group_of_link[l.0].is_some_and(|g| demand.groups[g].is_some())
                || m.passive[l.0].is_some_and(|p| matches!(p, Passive::Block(_)))
        };
        let shapes: Vec<LinkShape> = (0..scene.links.len())
            .map(LinkId)
            .map(|l| if wanted(l) { shape::of_link(scene, l, &mut faults) } else { LinkShape { points: Vec::new(), frame: Frame::Loose } })
            .collect();
        let guides =
            (0..scene.guides.len()).map(GuideId).map(|g| shape::guide_in_link(scene, m, &shapes[scene.guides[g.0].on.0], g)).collect();
        let mut a = Assembly {
            scene,
            m,
            shapes,
            points: vec![None; scene.points.len()],
            poses: vec![None; scene.links.len()],
            guides,
            faults,
            notes: Vec::new(),
        };
        a.poses[scene.ground.0] = Some(Pose::GROUND);
        for (p, at) in &a.shapes[scene.ground.0].points {
            a.points[p.0] = Some(*at);
        }
        a
    }

    /// A guide in the plane; where its link's form alone does not give it, from the pose and the pin's place.
    fn guide_in_plane(&self, g: GuideId) -> Option<Path> {
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
                    Direction::Instant(angle) => {
                        let (s, c) = trig::sin_cos(angle.value);
                        Vec2::new(c, s)
                    }
                    Direction::Along(a, b, angle) => {
                        let base = (self.points[b.0]? - self.points[a.0]?).unit()?;
                        let (s, c) = angle.as_ref().map_or((0.0, 1.0), |a| trig::sin_cos(a.value));
                        Vec2::new(c, s).rotate_by(base)
                    }
                    Direction::Own => pose.axis,
                };
                let through = match through {
                    Through::Point(p) => pose.to_world(self.shapes[guide.on.0].local(*p)?),
                    Through::At([x, y]) => Point::new(x.value, y.value),
                    // A slider without a pin of its own keeps whatever distance it has: the line may lie anywhere.
                    Through::Pin if guide.pin.is_none() => pose.origin,
                    Through::Pin => pin?,
                };
                Some(Path::Line { through: through + direction.perp() * offset.as_ref().map_or(0.0, |o| o.value), direction })
            }
        }
    }

    /// The guide in the plane, or what is missing.
    fn need_guide(&self, g: GuideId) -> Result<Path, Diagnostic> {
        self.guide_in_plane(g).ok_or_else(|| {
            let on = self.scene.link_name(self.scene.guides[g.0].on);
            Diagnostic::error("guide-not-placed", format!("the guide on link {on} is not placed: nothing says through which point it runs"))
                .at(self.scene.guides[g.0].span)
                .help("give \"through\" (a point of that link, or coordinates on ground), or the pin's coordinates in \"points\"")
        })
    }

    fn world(&self, l: LinkId, p: PointId) -> Option<Point> {
        Some(self.poses[l.0]?.to_world(self.shapes[l.0].local(p)?))
    }

    fn solve(&mut self, index: usize, group: &Group) -> Result<(), Diagnostic> {
        // What the scene gives by coordinates is taken as given; links with two such points lie in the plane's own frame.
        let given_pins: Vec<(PointId, Point)> = group.pins.iter().filter_map(|p| given_at(self.scene, *p).map(|at| (*p, at))).collect();
        for &(p, at) in &given_pins {
            self.points[p.0] = Some(at);
        }
        for &l in &group.links {
            if self.shapes[l.0].frame == Frame::Plane {
                self.poses[l.0] = Some(Pose::GROUND);
            }
        }
        let all_pins = given_pins.len() == group.pins.len();
        let trials = match &group.core {
            Core::Pin { pin, legs } => {
                let places = match self.points[pin.0] {
                    Some(at) => vec![at],
                    None => self.places_of_pin(*pin, legs)?,
                };
                places.into_iter().map(|at| self.trial_of_pin(group, *pin, at)).collect::<Result<Vec<_>, _>>()?
            }
            Core::Link { link, legs } => {
                let poses = match self.poses[link.0] {
                    Some(pose) => vec![pose],
                    None => self.nearest_to_given(*link, &given_pins, self.poses_of_link(*link, legs)?),
                };
                poses.into_iter().map(|pose| self.trial_of_link(group, *link, pose, legs)).collect::<Result<Vec<_>, _>>()?
            }
            Core::Higher => {
                if all_pins && group.links.iter().all(|l| self.poses[l.0].is_some()) {
                    let poses = group.links.iter().map(|l| (*l, Pose::GROUND)).collect();
                    vec![self.trial(given_pins.clone(), poses)]
                } else {
                    vec![self.newton_trial(index, group)?]
                }
            }
        };
        let names: Vec<_> = group.links.iter().map(|l| self.scene.link_name(*l)).collect();
        let names = match names[..] {
            [one] => format!(" {one}"),
            _ => format!("s {}", names.join(", ")),
        };
        let (pick, note) = branch::choose(self.scene, &self.points, &trials, &names)?;
        self.notes.extend(note);
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

    /// Where pins of the group have coordinates, only the pose that puts the link there is meant.
    fn nearest_to_given(&self, link: LinkId, given: &[(PointId, Point)], poses: Vec<Pose>) -> Vec<Pose> {
        let off = |pose: &Pose| -> f64 {
            given.iter().filter_map(|(p, at)| Some((pose.to_world(self.shapes[link.0].local(*p)?) - *at).norm2())).sum()
        };
        if given.is_empty() {
            return poses;
        }
        poses.into_iter().min_by(|a, b| off(a).total_cmp(&off(b))).into_iter().collect()
    }

    /// Collects a closure: adds the points of all its links.
    fn trial(&self, pins: Vec<(PointId, Point)>, poses: Vec<(LinkId, Pose)>) -> Trial {
        let mut points = pins;
        for (l, pose) in &poses {
            for (p, local) in &self.shapes[l.0].points {
                if !points.iter().any(|(q, _)| q == p) && self.points[p.0].is_none() {
                    points.push((*p, pose.to_world(*local)));
                }
            }
        }
        Trial { points, poses }
    }

    /// The pose of a link from two of its points.
    fn pose_from_points(&self, l: LinkId, a: (PointId, Point), b: (PointId, Point)) -> Result<Pose, Diagnostic> {
        if self.shapes[l.0].frame == Frame::Plane {
            return Ok(Pose::GROUND);
        }
        let local = |p: PointId| self.shapes[l.0].local(p).expect("a link's points have local places");
        let (la, lb) = (local(a.0), local(b.0));
        Pose::from_point_and_direction(la, lb - la, a.1, b.1 - a.1).ok_or_else(|| {
            let (pa, pb) = (self.scene.point_name(a.0), self.scene.point_name(b.0));
            Diagnostic::error(
                "coincident-points",
                format!("{pa} and {pb} of link {} coincide: it has no direction", self.scene.link_name(l)),
            )
            .at(self.scene.links[l.0].span)
        })
    }

    fn trial_of_pin(&self, group: &Group, pin: PointId, at: Point) -> Result<Trial, Diagnostic> {
        let Core::Pin { legs, .. } = &group.core else { unreachable!("called for pin cores only") };
        let mut poses = Vec::new();
        for leg in legs {
            match *leg {
                Leg::Bar { link, far, .. } => poses.push((link, self.pose_from_points(link, (far, self.known(far)), (pin, at))?)),
                Leg::Ram { link, far, guide, driver, .. } => {
                    let stated = matches!(self.scene.drivers[driver].kind, DriverKind::Slide { position: Some(_), .. });
                    let pose = if let Some(pose) = self.poses[link.0] {
                        pose
                    } else if !stated && given_at(self.scene, pin).is_some() {
                        // Coordinates of the pin show how far the slider is: the slot is laid over them.
                        let poses = self.poses_of_lever(link, far, pin, guide)?;
                        poses.into_iter().next().ok_or_else(|| self.no_closure(link))?
                    } else {
                        let runner = self.runner_in_link(link, guide, driver)?;
                        let d = self.shapes[link.0].local(far).expect("a link's points have local places");
                        let far_at = self.known(far);
                        Pose::from_point_and_direction(d, runner - d, far_at, at - far_at)
                            .ok_or_else(|| self.degenerate(guide, "the pin lies on the pivot"))?
                    };
                    poses.push((link, pose));
                }
                _ => {}
            }
        }
        Ok(self.trial(vec![(pin, at)], poses))
    }

    fn trial_of_link(&self, group: &Group, link: LinkId, pose: Pose, legs: &[Leg]) -> Result<Trial, Diagnostic> {
        let mut poses = vec![(link, pose)];
        let mut pins = Vec::new();
        for &p in &group.pins {
            let local = self.shapes[link.0].local(p).expect("the group's pins sit on its core");
            pins.push((p, self.points[p.0].unwrap_or(pose.to_world(local))));
        }
        for leg in legs {
            if let Leg::Bar { link: bar, near, far } = *leg {
                let near_at = pins.iter().find(|(p, _)| *p == near).map(|p| p.1).expect("a bar ends at a pin of its group");
                poses.push((bar, self.pose_from_points(bar, (far, self.known(far)), (near, near_at))?));
            }
        }
        Ok(self.trial(pins, poses))
    }

    /// Place of a pin that an earlier group placed.
    fn known(&self, p: PointId) -> Point {
        self.points[p.0].expect("groups come after those they need")
    }

    fn degenerate(&self, g: GuideId, why: &str) -> Diagnostic {
        let on = self.scene.link_name(self.scene.guides[g.0].on);
        Diagnostic::error("degenerate-guide", format!("the guide on link {on} gives it no direction: {why}"))
            .at(self.scene.guides[g.0].span)
    }

    /// Where a driven runner is in the frame of the link that carries its guide.
    fn runner_in_link(&self, link: LinkId, guide: GuideId, driver: usize) -> Result<Point, Diagnostic> {
        let path = self.guides[guide.0].ok_or_else(|| {
            Diagnostic::error("guide-not-placed", format!("the guide on link {} is not placed in that link", self.scene.link_name(link)))
                .at(self.scene.guides[guide.0].span)
                .help("give \"line\" or \"through\" by points of the link")
        })?;
        let DriverKind::Slide { position: Some(s), .. } = &self.scene.drivers[driver].kind else {
            return Err(self.driver_without_value(driver, "position", "how far the slider is along its guide"));
        };
        Ok(point_along(path, s.value))
    }

    fn driver_without_value(&self, driver: usize, key: &str, what: &str) -> Diagnostic {
        Diagnostic::error("driver-without-position", format!("the driver does not say {what}, and no coordinates give it"))
            .at(self.scene.drivers[driver].span)
            .help(format!("add \"{key}\" to the driver, or the coordinates of the moving joints to \"points\""))
    }

    /// The possible places of a pin on its two loci.
    fn places_of_pin(&self, pin: PointId, legs: &[Leg]) -> Result<Vec<Point>, Diagnostic> {
        match legs {
            [Leg::Carried { link }] => Ok(vec![self.world(*link, pin).ok_or_else(|| self.not_placed(pin, *link))?]),
            [Leg::Driven { guide, driver, .. }] => {
                let path = self.need_guide(*guide)?;
                let DriverKind::Slide { position: Some(s), .. } = &self.scene.drivers[*driver].kind else {
                    return Err(self.driver_without_value(*driver, "position", "how far the slider is along its guide"));
                };
                Ok(vec![point_along(path, s.value)])
            }
            [first, second] => {
                let (a, b) = (self.locus_of_pin(pin, first)?, self.locus_of_pin(pin, second)?);
                kernel::meet(a, b).map_err(|miss| self.cannot_meet(pin, first, second, miss))
            }
            _ => unreachable!("a pin has one leg that takes both freedoms, or two legs"),
        }
    }

    fn not_placed(&self, pin: PointId, link: LinkId) -> Diagnostic {
        Diagnostic::error("not-placed", format!("{} is not placed on link {}", self.scene.point_name(pin), self.scene.link_name(link)))
            .at(self.scene.points[pin.0].span)
            .help("give a length, or its coordinates in \"points\"")
    }

    fn locus_of_pin(&self, pin: PointId, leg: &Leg) -> Result<Locus, Diagnostic> {
        Ok(match *leg {
            Leg::Bar { link, far, .. } => {
                let s = &self.shapes[link.0];
                let (a, b) = (s.local(far), s.local(pin));
                let (Some(a), Some(b)) = (a, b) else { return Err(self.not_placed(pin, link)) };
                Locus::Circle { centre: self.known(far), radius: a.distance(b) }
            }
            Leg::OnGuide { guide, .. } => match self.need_guide(guide)? {
                Path::Line { through, direction } => Locus::Line { through, direction },
                Path::Arc { centre, radius } => Locus::Circle { centre, radius },
            },
            Leg::Cylinder { driver, far, .. } => Locus::Circle { centre: self.known(far), radius: self.cylinder_length(driver)? },
            Leg::Ram { link, far, guide, driver, .. } => {
                let runner = self.runner_in_link(link, guide, driver)?;
                let d = self.shapes[link.0].local(far).expect("a link's points have local places");
                Locus::Circle { centre: self.known(far), radius: d.distance(runner) }
            }
            _ => unreachable!("only these legs hold a pin"),
        })
    }

    fn cylinder_length(&self, driver: usize) -> Result<f64, Diagnostic> {
        match &self.scene.drivers[driver].kind {
            DriverKind::Cylinder { length: Some(l), .. } => Ok(l.value),
            _ => Err(self.driver_without_value(driver, "length", "how long the cylinder is")),
        }
    }

    fn cannot_meet(&self, pin: PointId, a: &Leg, b: &Leg, miss: Miss) -> Diagnostic {
        let (wa, wb) = (self.leg_words(pin, a), self.leg_words(pin, b));
        let p = self.scene.point_name(pin);
        let how = match miss {
            Miss::TooFar(x) => format!("they end {} apart", metres(x)),
            Miss::TooNear(x) => format!("one is {} too long for the other", metres(x)),
            Miss::Parallel(0.0) => "they coincide, so that the joint's place is undetermined".to_string(),
            Miss::Parallel(x) => format!("they run parallel, {} apart", metres(x)),
        };
        let d = Diagnostic::error("cannot-assemble", format!("{wa} and {wb} cannot meet at {p}: {how}")).at(self.scene.points[pin.0].span);
        d.help("change a length, the driver's position, or a pivot")
    }

    fn leg_words(&self, pin: PointId, leg: &Leg) -> String {
        let p = self.scene.point_name(pin);
        match *leg {
            Leg::Bar { link, far, .. } => {
                let s = &self.shapes[link.0];
                let l = s.local(far).zip(s.local(pin)).map_or(0.0, |(a, b)| a.distance(b));
                format!("link {} ({}{p} = {})", self.scene.link_name(link), self.scene.point_name(far), metres(l))
            }
            Leg::OnGuide { guide, .. } => format!("the guide on link {}", self.scene.link_name(self.scene.guides[guide.0].on)),
            Leg::Cylinder { driver, far, .. } => {
                let l = self.cylinder_length(driver).unwrap_or(0.0);
                format!("the cylinder {}{p} ({})", self.scene.point_name(far), metres(l))
            }
            Leg::Ram { link, .. } => format!("link {}", self.scene.link_name(link)),
            _ => format!("the joint at {p}"),
        }
    }

    /// The possible poses of a core link.
    fn poses_of_link(&self, link: LinkId, legs: &[Leg]) -> Result<Vec<Pose>, Diagnostic> {
        let pinned = legs.iter().find_map(|l| if let Leg::Pinned { pin } = l { Some(*pin) } else { None });
        let angle = legs.iter().find_map(|l| if let Leg::Angle { of, driver } = l { Some((*of, *driver)) } else { None });
        match (pinned, angle) {
            (Some(pin), Some((of, driver))) => {
                if let Some((runner, guide)) = self.posed_by_runner(link, driver) {
                    return self.poses_of_lever(link, pin, runner, guide);
                }
                let axis = self.axis_of(link, of, driver)?;
                let d = self.shapes[link.0].local(pin).expect("a link's points have local places");
                Ok(vec![Pose { origin: self.known(pin) - d.to_vec2().rotate_by(axis), axis }])
            }
            (Some(pin), None) => {
                let slot = legs.iter().find_map(|l| if let Leg::InSlot { pin, guide } = l { Some((*pin, *guide)) } else { None });
                let (runner, guide) = slot.ok_or_else(|| self.no_closure(link))?;
                self.poses_of_lever(link, pin, runner, guide)
            }
            (None, Some((of, driver))) => {
                let axis = self.axis_of(link, of, driver)?;
                let rest: Vec<&Leg> = legs.iter().filter(|l| !matches!(l, Leg::Angle { .. })).collect();
                self.poses_at_angle(link, axis, &rest)
            }
            (None, None) => self.poses_of_triad(link, legs),
        }
    }

    /// A driven link without a stated angle whose guide runs over a pin with given coordinates: the pin shows its angle.
    fn posed_by_runner(&self, link: LinkId, driver: Option<usize>) -> Option<(PointId, GuideId)> {
        let DriverKind::Turn { angle: None, .. } = &self.scene.drivers[driver?].kind else { return None };
        (0..self.scene.guides.len())
            .map(GuideId)
            .filter(|g| self.scene.guides[g.0].on == link)
            .find_map(|g| self.scene.guides[g.0].pin.filter(|p| given_at(self.scene, *p).is_some()).map(|p| (p, g)))
    }

    fn no_closure(&self, link: LinkId) -> Diagnostic {
        Diagnostic::error(
            "no-closed-form",
            format!("link {} is held in a way for which a rough pose is needed", self.scene.link_name(link)),
        )
        .at(self.scene.links[link.0].span)
        .help("give the coordinates of its joints at the instant in \"points\"")
    }

    /// Direction of a link's frame, from the link whose turning it shares or against which a driver turns it.
    fn axis_of(&self, link: LinkId, of: LinkId, driver: Option<usize>) -> Result<Vec2, Diagnostic> {
        let name = self.scene.link_name(link);
        let shape = &self.shapes[link.0];
        let Some(d) = driver else {
            return if shape.frame == Frame::Body {
                Err(Diagnostic::error(
                    "angle-not-given",
                    format!("link {name} keeps its direction, but its angle against the guide is not given"),
                )
                .at(self.scene.links[link.0].span)
                .help("give the coordinates of two of its points at the instant in \"points\""))
            } else {
                Ok(Vec2::new(1.0, 0.0))
            };
        };
        let DriverKind::Turn { line, against_line, angle, .. } = &self.scene.drivers[d].kind else {
            unreachable!("an angle comes from a turning driver or a slider")
        };
        let Some(angle) = angle else {
            return Err(self.driver_without_value(d, "angle", &format!("at which angle link {name} stands")));
        };
        let own = match line {
            Some((a, b)) => shape.local(*a).zip(shape.local(*b)).map(|(a, b)| b - a),
            None => match &self.scene.links[link.0].points[..] {
                [a, b, ..] => shape.local(*a).zip(shape.local(*b)).map(|(a, b)| b - a),
                _ => Some(Vec2::new(1.0, 0.0)),
            },
        };
        let base = if let Some((a, b)) = against_line {
            self.points[a.0].zip(self.points[b.0]).map(|(a, b)| b - a)
        } else if of == self.scene.ground {
            Some(Vec2::new(1.0, 0.0))
        } else {
            match &self.scene.links[of.0].points[..] {
                [a, b, ..] => self.points[a.0].zip(self.points[b.0]).map(|(a, b)| b - a),
                _ => self.poses[of.0].map(|p| p.axis),
            }
        };
        let (s, c) = trig::sin_cos(angle.value);
        own.zip(base).and_then(|(own, base)| Vec2::new(c, s).rotate_by(base.unit()?).divide_by(own.unit()?).unit()).ok_or_else(|| {
            Diagnostic::error("angle-of-nothing", format!("the angle of link {name} has no line to count from"))
                .at(angle.span)
                .help("name two different points of the link with \"line\" (and \"against_line\")")
        })
    }

    /// A link on a known pivot whose slot runs over a known pin.
    fn poses_of_lever(&self, link: LinkId, pivot: PointId, runner: PointId, guide: GuideId) -> Result<Vec<Pose>, Diagnostic> {
        let (pivot_at, pin_at) = (self.known(pivot), given_at(self.scene, runner).unwrap_or_else(|| self.known(runner)));
        let d = self.shapes[link.0].local(pivot).expect("a link's points have local places");
        let to_pin = pin_at - pivot_at;
        let Some(path) = self.guides[guide.0] else {
            // The guide's direction is given at the instant, or it runs through the pin where that is.
            return if self.shapes[link.0].frame == Frame::Loose {
                Ok(vec![Pose { origin: pivot_at - d.to_vec2(), axis: Vec2::new(1.0, 0.0) }])
            } else {
                Err(Diagnostic::error(
                    "guide-not-placed",
                    format!(
                        "the guide on link {} is given at the instant only, which does not fix it in that link",
                        self.scene.link_name(link)
                    ),
                )
                .at(self.scene.guides[guide.0].span)
                .help("give it by \"line\", \"angle\" and \"through\" with points of the link, or the link's points by coordinates"))
            };
        };
        let places = match path {
            // A link that is nothing but its pivot and its slot has no front: pin ahead or behind is the same thing.
            Path::Line { through, direction } if self.shapes[link.0].frame == Frame::Loose && through == d => {
                let mut places = kernel::lever(d, through, direction, to_pin).map_err(|miss| self.lever_miss(link, pivot, runner, miss))?;
                places.truncate(1);
                places
            }
            Path::Line { through, direction } => {
                kernel::lever(d, through, direction, to_pin).map_err(|miss| self.lever_miss(link, pivot, runner, miss))?
            }
            Path::Arc { centre, radius } => {
                let k = Locus::Circle { centre: pivot_at, radius: d.distance(centre) };
                let places =
                    kernel::meet(k, Locus::Circle { centre: pin_at, radius }).map_err(|miss| self.lever_miss(link, pivot, runner, miss))?;
                return places
                    .into_iter()
                    .map(|at| {
                        Pose::from_point_and_direction(d, centre - d, pivot_at, at - pivot_at)
                            .ok_or_else(|| self.degenerate(guide, "its centre lies on the pivot"))
                    })
                    .collect();
            }
        };
        places
            .into_iter()
            .map(|local| {
                Pose::from_point_and_direction(d, local - d, pivot_at, to_pin).ok_or_else(|| {
                    self.degenerate(
                        guide,
                        &format!("pin {} lies on the pivot {}", self.scene.point_name(runner), self.scene.point_name(pivot)),
                    )
                })
            })
            .collect()
    }

    fn lever_miss(&self, link: LinkId, pivot: PointId, runner: PointId, miss: Miss) -> Diagnostic {
        let (p, r) = (self.scene.point_name(pivot), self.scene.point_name(runner));
        let by = match miss {
            Miss::TooFar(x) | Miss::TooNear(x) | Miss::Parallel(x) => metres(x),
        };
        Diagnostic::error(
            "cannot-assemble",
            format!(
                "the slot of link {} cannot reach pin {r}: {p}{r} is {by} short of the slot's distance from {p}",
                self.scene.link_name(link)
            ),
        )
        .at(self.scene.links[link.0].span)
        .help("change the slot's offset, a length, or the driver's position")
    }

    fn poses_at_angle(&self, link: LinkId, axis: Vec2, legs: &[&Leg]) -> Result<Vec<Pose>, Diagnostic> {
        if let [Leg::DrivenGlide { guide, driver, .. }] = legs[..] {
            let path = self.need_guide(*guide)?;
            let DriverKind::Slide { position: Some(s), .. } = &self.scene.drivers[*driver].kind else {
                return Err(self.driver_without_value(*driver, "position", "how far the slider is along its guide"));
            };
            return Ok(vec![Pose { origin: point_along(path, s.value), axis }]);
        }
        // A point with given coordinates shows the place of a link whose direction is known.
        let shape = &self.shapes[link.0];
        if let Some((local, at)) = shape.points.iter().find_map(|(p, local)| Some((*local, given_at(self.scene, *p)?))) {
            return Ok(vec![Pose { origin: at - local.to_vec2().rotate_by(axis), axis }]);
        }
        // A slot that passes "through the pin where it is" is met wherever the link is put along its guide. Where the link
        // only translates its place changes no vector: its first point is put at the pin.
        let met = legs.iter().find_map(|l| match l {
            Leg::InSlot { guide, pin } if self.guides[guide.0].is_none() => Some(*pin),
            _ => None,
        });
        if let Some(pin) = met
            && (shape.points.is_empty() || self.m.never_turns[link.0])
        {
            let origin = if shape.points.is_empty() { Point::ORIGIN } else { self.known(pin) };
            return Ok(vec![Pose { origin, axis }]);
        }
        let [a, b] = legs[..] else { return Err(self.no_closure(link)) };
        let (la, lb) = (self.triad_leg(link, a)?.locus(axis), self.triad_leg(link, b)?.locus(axis));
        let origins = kernel::meet(la, lb).map_err(|miss| {
            let how = match miss {
                Miss::Parallel(0.0) => "its two guides run parallel".to_string(),
                Miss::TooFar(x) | Miss::TooNear(x) | Miss::Parallel(x) => format!("its two joints miss each other by {}", metres(x)),
            };
            Diagnostic::error("cannot-assemble", format!("link {} cannot be placed: {how}", self.scene.link_name(link)))
                .at(self.scene.links[link.0].span)
        })?;
        Ok(origins.into_iter().map(|origin| Pose { origin, axis }).collect())
    }

    fn triad_leg(&self, link: LinkId, leg: &Leg) -> Result<TriadLeg, Diagnostic> {
        let local = |p: PointId| self.shapes[link.0].local(p).ok_or_else(|| self.not_placed(p, link));
        Ok(match *leg {
            Leg::Bar { link: bar, near, far } => {
                let s = &self.shapes[bar.0];
                let (Some(a), Some(b)) = (s.local(near), s.local(far)) else { return Err(self.not_placed(near, bar)) };
                TriadLeg::Circle { near: local(near)?, far: self.known(far), radius: a.distance(b) }
            }
            Leg::Cylinder { driver, near, far } => {
                TriadLeg::Circle { near: local(near)?, far: self.known(far), radius: self.cylinder_length(driver)? }
            }
            Leg::OnGuide { pin, guide } => match self.need_guide(guide)? {
                Path::Line { through, direction } => TriadLeg::Line { near: local(pin)?, through, direction },
                Path::Arc { centre, radius } => TriadLeg::Circle { near: local(pin)?, far: centre, radius },
            },
            Leg::InSlot { pin, guide } => match self.guides[guide.0] {
                Some(Path::Line { through, direction }) => TriadLeg::Slot { through, direction, pin: self.known(pin) },
                Some(Path::Arc { centre, radius }) => TriadLeg::Circle { near: centre, far: self.known(pin), radius },
                None => return Err(self.no_closure(link)),
            },
            Leg::Glide { guide, other } => {
                let on = self.scene.guides[guide.0].on;
                let direction = match (self.guide_in_plane(guide), on == other) {
                    (Some(Path::Line { direction, .. }), true) => direction,
                    _ => match self.guides[guide.0] {
                        Some(Path::Line { direction, .. }) => direction,
                        _ => return Err(self.no_closure(link)),
                    },
                };
                // How far the link's own origin lies beside the guide is nobody's concern: it lies on it.
                let through = match self.guide_in_plane(guide) {
                    Some(Path::Line { through, .. }) => through,
                    _ => Point::ORIGIN,
                };
                TriadLeg::Line { near: Point::ORIGIN, through, direction }
            }
            _ => return Err(self.no_closure(link)),
        })
    }

    /// The pose that the sketch (or coordinates) of two of a link's points gives it.
    fn sketched_pose(&self, link: LinkId) -> Option<(Point, Vec2)> {
        let rough = |p: PointId| given_at(self.scene, p).or(self.scene.points[p.0].sketch.map(|s| Point::new(s[0], s[1])));
        let mut known = self.shapes[link.0].points.iter().filter_map(|(p, local)| Some((*local, rough(*p)?)));
        let (a, b) = (known.next()?, known.next()?);
        let pose = Pose::from_point_and_direction(a.0, b.0 - a.0, a.1, b.1 - a.1)?;
        Some((pose.origin, pose.axis))
    }

    fn poses_of_triad(&self, link: LinkId, legs: &[Leg]) -> Result<Vec<Pose>, Diagnostic> {
        let [a, b, c] = legs else { return Err(self.no_closure(link)) };
        let legs = [self.triad_leg(link, a)?, self.triad_leg(link, b)?, self.triad_leg(link, c)?];
        let found = triad::assemblies(&legs, self.sketched_pose(link));
        if found.is_empty() {
            return Err(Diagnostic::error(
                "cannot-assemble",
                format!("link {} cannot be placed on its three legs in any position", self.scene.link_name(link)),
            )
            .at(self.scene.links[link.0].span)
            .help("change a length of the group or the driver's position"));
        }
        Ok(found.into_iter().map(|(origin, axis)| Pose { origin, axis }).collect())
    }

    /// A group for which only Newton's method from a sketch remains.
    fn newton_trial(&self, index: usize, group: &Group) -> Result<Trial, Diagnostic> {
        let names: Vec<_> = group.links.iter().map(|l| self.scene.link_name(*l)).collect();
        let lacking = |what: &str| {
            Diagnostic::error("sketch-needed", format!("links {} can only be placed from a rough pose: {what}", names.join(", ")))
                .at(self.scene.links[group.links[0].0].span)
                .help("give rough coordinates of their joints in \"sketch\"")
        };
        let rough =
            |p: PointId| self.points[p.0].or(given_at(self.scene, p)).or(self.scene.points[p.0].sketch.map(|s| Point::new(s[0], s[1])));
        let mut start = self.snapshot();
        for &p in &group.pins {
            start.points[p.0] = Some(rough(p).ok_or_else(|| lacking(&format!("{} is not sketched", self.scene.point_name(p))))?);
        }
        for &l in &group.links {
            let known: Vec<(Point, Point)> =
                self.shapes[l.0].points.iter().filter_map(|(p, local)| rough(*p).map(|at| (*local, at))).collect();
            let [a, .., b] = known[..] else {
                return Err(lacking(&format!("link {} has fewer than two placed points", self.scene.link_name(l))));
            };
            start.poses[l.0] = Pose::from_point_and_direction(a.0, b.0 - a.0, a.1, b.1 - a.1);
            if start.poses[l.0].is_none() {
                return Err(lacking(&format!("the sketched points of link {} coincide", self.scene.link_name(l))));
            }
        }
        let drivers = self.driver_values(&start);
        let system = newton::System::new(self.scene, self.m, &start.shapes, &start, &[index]);
        let (poses, points) = system.solve(&start, &drivers).ok_or_else(|| {
            Diagnostic::error("no-convergence", format!("links {} were not brought together from the sketch", names.join(", ")))
                .at(self.scene.links[group.links[0].0].span)
                .help("improve the sketch, or check whether the lengths can be assembled")
        })?;
        let pins = group.pins.iter().filter_map(|p| points[p.0].map(|at| (*p, at))).collect();
        let poses = group.links.iter().filter_map(|l| poses[l.0].map(|pose| (*l, pose))).collect();
        Ok(self.trial(pins, poses))
    }

    fn driver_values(&self, start: &Configuration) -> newton::DriverValues {
        let mut values = newton::driver_values(self.scene, start);
        for (d, driver) in self.scene.drivers.iter().enumerate() {
            match &driver.kind {
                DriverKind::Turn { link, against, .. } => {
                    if let (Ok(axis), Some(base)) = (self.axis_of(*link, *against, Some(d)), self.poses[against.0]) {
                        values.0[d] = axis.divide_by(base.axis).angle();
                    }
                }
                DriverKind::Slide { position: Some(s), .. } => values.0[d] = s.value,
                DriverKind::Cylinder { length: Some(l), .. } => values.0[d] = l.value,
                _ => {}
            }
        }
        values
    }

    fn snapshot(&self) -> Configuration {
        Configuration {
            points: self.points.clone(),
            poses: self.poses.clone(),
            guides: (0..self.guides.len()).map(|g| self.guide_in_plane(GuideId(g))).collect(),
            shapes: Shapes { points: self.shapes.iter().map(|s| s.points.clone()).collect(), guides: self.guides.clone() },
        }
    }

    fn finish(mut self) -> Result<Warned<Configuration>, Faults> {
        for l in (0..self.scene.links.len()).map(LinkId) {
            let Some(pose) = self.poses[l.0] else { continue };
            for (p, local) in self.shapes[l.0].points.clone() {
                if self.points[p.0].is_none() {
                    self.points[p.0] = Some(pose.to_world(local));
                }
            }
        }
        for g in (0..self.scene.guides.len()).map(GuideId) {
            if self.guides[g.0].is_some() {
                continue;
            }
            let on = self.scene.guides[g.0].on;
            if let (Some(path), Some(pose)) = (self.guide_in_plane(g), self.poses[on.0]) {
                self.guides[g.0] = Some(match path {
                    Path::Line { through, direction } => {
                        Path::Line { through: pose.to_local(through), direction: pose.turn_back(direction) }
                    }
                    Path::Arc { centre, radius } => Path::Arc { centre: pose.to_local(centre), radius },
                });
            }
        }
        for g in (0..self.scene.guides.len()).map(GuideId) {
            self.check_placed(g);
        }
        if self.faults.has_errors() {
            return Err(self.faults);
        }
        let shapes = Shapes { points: self.shapes.iter().map(|s| s.points.clone()).collect(), guides: self.guides.clone() };
        let configuration = complete(self.scene, self.m, shapes, self.poses.clone(), self.points.clone());
        self.check(&configuration);
        if self.faults.has_errors() { Err(self.faults) } else { Ok(Warned { value: configuration, notes: self.notes }) }
    }

    /// Where a guide's carrier and its runner are placed, so must be the guide: coordinates may have placed both past it.
    fn check_placed(&mut self, g: GuideId) {
        let guide = &self.scene.guides[g.0];
        let runner = match (guide.pin, guide.slider) {
            (Some(p), _) => self.points[p.0].is_some(),
            (None, s) => s.is_some_and(|s| self.poses[s.0].is_some()),
        };
        if self.guides[g.0].is_some() || self.poses[guide.on.0].is_none() || !runner {
            return;
        }
        let d = match &guide.path {
            GuidePath::Line { direction: Direction::Along(a, b, _), .. } => {
                let (a, b) = (self.scene.point_name(*a), self.scene.point_name(*b));
                self.degenerate(g, &format!("{a} and {b} coincide"))
            }
            _ => match self.need_guide(g) {
                Err(d) => d,
                Ok(_) => return,
            },
        };
        self.faults.push(d);
    }

    /// Pins given by coordinates must lie on their guides and links, and driver angles must agree with the pose.
    fn check(&mut self, c: &Configuration) {
        let extent = c.extent();
        for (g, guide) in self.scene.guides.iter().enumerate() {
            let (Some(p), Some(path)) = (guide.pin, c.guides[g]) else { continue };
            let Some(at) = c.points[p.0] else { continue };
            let off = match path {
                Path::Line { through, direction } => direction.cross(at - through).abs(),
                Path::Arc { centre, radius } => (at.distance(centre) - radius).abs(),
            };
            if off > same_place(extent, at) {
                self.faults.push(
                    Diagnostic::error(
                        "pin-off-guide",
                        format!(
                            "pin {} lies {} beside its guide on link {}",
                            self.scene.point_name(p),
                            metres(off),
                            self.scene.link_name(guide.on)
                        ),
                    )
                    .at(guide.span)
                    .help("correct its coordinates or the guide, or leave out what can be derived"),
                );
            }
        }
        for (l, shape) in self.shapes.iter().enumerate() {
            let Some(pose) = c.poses[l] else { continue };
            for (p, local) in &shape.points {
                let Some(at) = c.points[p.0] else { continue };
                let off = at.distance(pose.to_world(*local));
                if off > same_place(extent, at) {
                    self.faults.push(
                        Diagnostic::error(
                            "pin-off-link",
                            format!(
                                "{} lies {} from where the data of link {} put it",
                                self.scene.point_name(*p),
                                metres(off),
                                self.scene.links[l].name
                            ),
                        )
                        .at(self.scene.points[p.0].span)
                        .help("coordinates and lengths contradict each other: leave one out, or move rough coordinates to \"sketch\""),
                    );
                }
            }
        }
        for (d, driver) in self.scene.drivers.iter().enumerate() {
            if let DriverKind::Turn { link, against, angle: Some(angle), .. } = &driver.kind
                && let (Some(pose), Ok(axis)) = (c.poses[link.0], self.axis_of(*link, *against, Some(d)))
                && pose.axis.cross(axis).abs() + (1.0 - pose.axis.dot(axis)) > SAME_PLACE
            {
                self.faults.push(
                    Diagnostic::error(
                        "contradictory-angle",
                        format!("the driver's angle {} contradicts the coordinates of link {}", angle.text, self.scene.link_name(*link)),
                    )
                    .at(angle.span)
                    .help("leave one of the two out"),
                );
            }
        }
    }
}

/// Two descriptions of one place may differ by the rounding of what a person types (ten digits), relative to the size of
/// the mechanism. Coarser contradictions would show as a disagreement between drawing and analysis.
const SAME_PLACE: f64 = 1e-9;

/// How far two descriptions of the place `at` may be apart: see [`SAME_PLACE`], and a few units in the last place of the
/// coordinates themselves (a single point has no size of its own, and one far from the origin is rounded coarsely).
fn same_place(extent: f64, at: Point) -> f64 {
    SAME_PLACE * extent + 16.0 * f64::EPSILON * at.to_vec2().norm()
}

fn point_along(path: Path, s: f64) -> Point {
    match path {
        Path::Line { through, direction } => through + direction * s,
        Path::Arc { centre, radius } => centre + Vec2::from_angle(s / radius) * radius,
    }
}

/// A configuration from poses and pins: adds tracer points, guides in the plane, and the links that only follow.
pub(super) fn complete(
    scene: &Scene,
    m: &Mechanism,
    shapes: Shapes,
    mut poses: Vec<Option<Pose>>,
    mut points: Vec<Option<Point>>,
) -> Configuration {
    poses[scene.ground.0] = Some(Pose::GROUND);
    for (pose, carried) in poses.iter().zip(&shapes.points) {
        let Some(pose) = pose else { continue };
        for (p, local) in carried {
            // Pins keep their own place; every other point follows its link.
            if !m.pins.contains(p) || points[p.0].is_none() {
                points[p.0] = Some(pose.to_world(*local));
            }
        }
    }
    let guides: Vec<Option<Path>> =
        (0..scene.guides.len()).map(|g| Some(shapes.guides[g]?.to_world(&poses[scene.guides[g].on.0]?))).collect();
    for (l, passive) in m.passive.iter().enumerate() {
        poses[l] = match *passive {
            Some(Passive::Block(g)) => scene.guides[g.0]
                .pin
                .and_then(|p| points[p.0])
                .zip(guides[g.0])
                .map(|(origin, path)| Pose { origin, axis: path.tangent_at(origin) }),
            Some(Passive::Cylinder(d)) => match scene.drivers[d].kind {
                DriverKind::Cylinder { a, b, .. } => {
                    points[a.0].zip(points[b.0]).and_then(|(a, b)| Some(Pose { origin: a, axis: (b - a).unit()? }))
                }
                _ => None,
            },
            None => poses[l],
        };
    }
    Configuration { points, poses, guides, shapes }
}
