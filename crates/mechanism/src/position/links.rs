//! Poses of a link held by its legs: at a given angle, as a lever over a pin, or on three legs.

use super::assemble::Assembly;
use super::kernel::{self, Locus, Miss};
use super::proof::Unproven;
use super::shape::{FrameAnchor, given_at, given_place};
use super::triad::{self, TriadLeg};
use super::{Path, Pose};
use crate::mechanism::{CoreLoci, Hold, Leg};
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_scene::{Guide, GuideDirection, GuideId, GuidePath, LinkId, PointId, RollingId};

impl<N: Real> Assembly<'_, N> {
    /// Returns the possible poses of a core link.
    pub(super) fn poses_of_link(
        &self,
        link: LinkId,
        legs: &[Leg],
    ) -> Result<Vec<Pose<N>>, Diagnostic> {
        let CoreLoci { pivot, angle, holds, .. } = CoreLoci::of(legs);
        if angle.is_none() && holds.iter().any(|h| matches!(h, Hold::Rolls { .. })) {
            return self.poses_of_rolling(link, pivot, &holds);
        }
        match (pivot, angle) {
            (Some(pin), Some((of, driver))) => {
                if let Some((runner, guide)) = self.posed_by_runner(link, pin, driver) {
                    return self.poses_of_lever(link, pin, runner, guide);
                }
                let axis = self.axis_of(link, of, driver)?;
                let d = self.shapes[link.0].local(pin).expect("a link's points have local places");
                Ok(vec![Pose { origin: self.known(pin) - d.to_vec2().rotate_by(axis), axis }])
            }
            (Some(pin), None) => {
                let [Hold::Slot { pin: runner, guide }] = holds[..] else {
                    return Err(self.no_closure(link));
                };
                self.poses_of_lever(link, pin, runner, guide)
            }
            (None, Some((of, driver))) => {
                let axis = self.axis_of(link, of, driver)?;
                self.poses_at_angle(link, axis, &holds)
            }
            (None, None) => self.poses_of_triad(link, &holds),
        }
    }

    /// Returns the pin and the guide that determine the angle of a link: the guide of a driven link
    /// without a stated angle over a pin with given coordinates, or that of a link without a line
    /// that turns with another link. Two guides determine no angle: one about the pivot itself,
    /// which is the same at every angle, and one with a given angle on a link that never turns.
    pub(super) fn posed_by_runner(
        &self,
        link: LinkId,
        pivot: PointId,
        driver: Option<usize>,
    ) -> Option<(PointId, GuideId)> {
        let shown = match driver.map(|d| &self.scene.drivers[d].kind) {
            Some(kind) => kind.turns() && kind.angle().is_none(),
            None => self.instant.is_none() && self.shapes[link.0].frame == FrameAnchor::Loose,
        };
        if !shown {
            return None;
        }
        let about_pivot =
            |path: &GuidePath| matches!(path, GuidePath::Arc { centre, .. } if *centre == pivot);
        let told = |path: &GuidePath| {
            self.m.never_turns[link.0]
                && matches!(path, GuidePath::Line { direction: GuideDirection::Instant(_), .. })
        };
        let shows = |path: &GuidePath| !about_pivot(path) && !told(path);
        (0..self.scene.guides.len())
            .map(GuideId)
            .filter(|g| self.scene.guides[g.0].on == link && shows(&self.scene.guides[g.0].path))
            .find_map(|g| {
                self.scene.guides[g.0]
                    .pin
                    .filter(|p| given_at(self.scene, *p).is_some())
                    .map(|p| (p, g))
            })
    }

    pub(super) fn no_closure(&self, link: LinkId) -> Diagnostic {
        Diagnostic::error(
            "no-closed-form",
            both!(
                "link {} is held in a way for which a rough pose is needed",
                self.scene.link_name(link)
            ),
        )
        .at(self.scene.links[link.0].span)
        .help(both!("give the coordinates of its joints at the instant in \"points\""))
    }

    /// Returns the direction of a link's frame, from the link with which it turns or relative to
    /// which a driver turns it.
    pub(super) fn axis_of(
        &self,
        link: LinkId,
        of: LinkId,
        driver: Option<usize>,
    ) -> Result<Vec2<N>, Diagnostic> {
        let name = self.scene.link_name(link);
        let shape = &self.shapes[link.0];
        let Some(d) = driver else {
            // At a later time a slider keeps its angle to the other link from the instant.
            let stood = self.instant.and_then(|c| c.poses[link.0].zip(c.poses[of.0]));
            if let (Some((own, other)), Some(now)) = (stood, self.poses[of.0]) {
                return Ok(own.axis.divide_by(other.axis).rotate_by(now.axis));
            }
            return if shape.frame == FrameAnchor::Body {
                Err(Diagnostic::error(
                    "angle-not-given",
                    both!(
                        "link {name} keeps its direction, but its angle against the guide is not given"
                    ),
                )
                .at(self.scene.links[link.0].span)
                .help(both!(
                    "give the coordinates of two of its points at the instant in \"points\""
                )))
            } else if self.is_along_guide(link) {
                self.slid_along(link).ok_or_else(|| self.no_closure(link))
            } else {
                Ok(Vec2::unit_x())
            };
        };
        let [line, against_line] = self.scene.drivers[d].kind.lines();
        let Some(angle) = self.scene.drivers[d].kind.angle() else {
            // A wheel or a block without a line may have any angle.
            let lines = self.scene.guides.iter().any(|g| g.on == link);
            let wheel = self.scene.rolling.iter().any(|r| r.links.contains(&link));
            if shape.frame == FrameAnchor::Loose && (wheel || !lines) && self.instant.is_none() {
                return Ok(Vec2::unit_x());
            }
            return Err(self.driver_without_value(
                d,
                "angle",
                both!("at which angle link {name} stands"),
            ));
        };
        let own = self.line_in(link, line);
        let base = if let Some((a, b)) = against_line {
            self.points[a.0].zip(self.points[b.0]).map(|(a, b)| b - a)
        } else if of == self.scene.ground {
            Some(Vec2::unit_x())
        } else {
            match &self.scene.links[of.0].points[..] {
                [a, b, ..] => self.points[a.0].zip(self.points[b.0]).map(|(a, b)| b - a),
                _ => self.poses[of.0].map(|p| p.axis),
            }
        };
        let (s, c) = self.inputs.driven_sin_cos(&self.scene.drivers[d], angle);
        own.zip(base)
            .and_then(|(own, base)| {
                Vec2::new(c, s).rotate_by(base.unit()?).divide_by(own.unit()?).unit()
            })
            .ok_or_else(|| {
                Diagnostic::error(
                    "angle-of-nothing",
                    both!("the angle of link {name} has no line to count from"),
                )
                .at(angle.span)
                .help(both!(
                    "name two different points of the link with \"line\" (and \"against_line\")"
                ))
            })
    }

    /// Returns true if the frame of a sliding link is aligned with the guide in which it slides:
    /// the angle of a guide on the link is measured from it.
    pub(super) fn is_along_guide(&self, link: LinkId) -> bool {
        let counts = |g: &Guide| {
            matches!(g.path, GuidePath::Line { direction: GuideDirection::Slid(_), .. })
        };
        self.shapes[link.0].frame == FrameAnchor::Loose
            && self.scene.guides.iter().any(|g| g.on == link && counts(g))
    }

    /// Returns the direction in the plane of the guide in which a link slides.
    pub(super) fn slid_along(&self, link: LinkId) -> Option<Vec2<N>> {
        let guide = self.scene.guides.iter().position(|g| g.slider == Some(link)).map(GuideId)?;
        match self.guide_in_plane(guide)? {
            Path::Line { direction, .. } => Some(direction),
            Path::Arc { .. } => None,
        }
    }

    /// Returns the line of a link from which a driver's angle is measured, in the link's frame: the
    /// line of two points if given, otherwise that of its first two points, otherwise its x axis.
    fn line_in(&self, link: LinkId, line: Option<(PointId, PointId)>) -> Option<Vec2<N>> {
        let shape = &self.shapes[link.0];
        let between = |a, b| shape.local(a).zip(shape.local(b)).map(|(a, b)| b - a);
        match (line, &self.scene.links[link.0].points[..]) {
            (Some((a, b)), _) => between(a, b),
            (None, [a, b, ..]) => between(*a, *b),
            (None, _) => Some(Vec2::unit_x()),
        }
    }

    /// Returns the direction of the frame of a driven link in the frame of the link relative to
    /// which it turns, for any pose of the latter.
    pub(super) fn driven_apart(&self, driver: usize) -> Option<Vec2<N>> {
        let kind = &self.scene.drivers[driver].kind;
        let ((link, against), [line, against_line]) = (kind.turned()?, kind.lines());
        let (s, c) = self.inputs.driven_sin_cos(&self.scene.drivers[driver], kind.angle()?);
        let (own, base) = (self.line_in(link, line)?, self.line_in(against, against_line)?);
        Vec2::new(c, s).rotate_by(base.unit()?).divide_by(own.unit()?).unit()
    }

    /// Returns the poses of a link on a known pivot with a slot over a known pin.
    pub(super) fn poses_of_lever(
        &self,
        link: LinkId,
        pivot: PointId,
        runner: PointId,
        guide: GuideId,
    ) -> Result<Vec<Pose<N>>, Diagnostic> {
        let (pivot_at, pin_at) = (
            self.known(pivot),
            given_place(self.scene, &self.inputs, runner).unwrap_or_else(|| self.known(runner)),
        );
        let d = self.shapes[link.0].local(pivot).expect("a link's points have local places");
        let to_pin = pin_at - pivot_at;
        let Some(path) = self.guides[guide.0] else {
            // The guide's direction is given at the instant, or the guide runs through the position
            // of the pin.
            return if self.shapes[link.0].frame == FrameAnchor::Loose {
                Ok(vec![Pose { origin: pivot_at - d.to_vec2(), axis: Vec2::unit_x() }])
            } else {
                Err(Diagnostic::error(
                    "guide-not-placed",
                    both!(
                        "the guide on link {} is given at the instant only, which does not fix it in that link",
                        self.scene.link_name(link)
                    ),
                )
                .at(self.scene.guides[guide.0].span)
                .help(both!(
                    "give it by \"line\", \"angle\" and \"through\" with points of the link, or the link's points by coordinates"
                )))
            };
        };
        let places = match path {
            // A link that has only its pivot and its slot has no front: a pin ahead or behind is
            // equivalent.
            Path::Line { through, direction }
                if self.shapes[link.0].frame == FrameAnchor::Loose && through == d =>
            {
                let mut places = kernel::lever(d, through, direction, to_pin)
                    .map_err(|miss| self.lever_miss(link, pivot, runner, miss))?;
                places.truncate(1);
                places
            }
            Path::Line { through, direction } => kernel::lever(d, through, direction, to_pin)
                .map_err(|miss| self.lever_miss(link, pivot, runner, miss))?,
            Path::Arc { centre, radius } => {
                let k = Locus::Circle { centre: pivot_at, radius: d.distance(centre) };
                let places = kernel::meet(k, Locus::Circle { centre: pin_at, radius })
                    .map_err(|miss| self.lever_miss(link, pivot, runner, miss))?;
                return places
                    .into_iter()
                    .map(|at| {
                        Pose::from_point_and_direction(d, centre - d, pivot_at, at - pivot_at)
                            .ok_or_else(|| {
                                self.degenerate(guide, both!("its centre lies on the pivot"))
                            })
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
                        both!(
                            "pin {} lies on the pivot {}",
                            self.scene.point_name(runner),
                            self.scene.point_name(pivot)
                        ),
                    )
                })
            })
            .collect()
    }

    pub(super) fn lever_miss(
        &self,
        link: LinkId,
        pivot: PointId,
        runner: PointId,
        miss: Miss,
    ) -> Diagnostic {
        let (p, r) = (self.scene.point_name(pivot), self.scene.point_name(runner));
        let by = match miss {
            Miss::TooFar(x) | Miss::TooNear(x) | Miss::Parallel(x) => self.scene.length_words(x),
        };
        Diagnostic::error(
            "cannot-assemble",
            both!(
                "the slot of link {} cannot reach pin {r}: {p}{r} is {by} short of the slot's distance from {p}",
                self.scene.link_name(link)
            ),
        )
        .at(self.scene.links[link.0].span)
        .help(both!("change the slot's offset, a length, or the driver's position"))
    }

    fn poses_at_angle(
        &self,
        link: LinkId,
        axis: Vec2<N>,
        holds: &[Hold],
    ) -> Result<Vec<Pose<N>>, Diagnostic> {
        let stated = |d: usize| self.scene.drivers[d].kind.length().is_some();
        if let [Hold::Glide { guide, driver: Some(driver), .. }] = *holds
            && (stated(driver) || !self.shapes[link.0].points.is_empty())
        {
            return Ok(vec![Pose { origin: self.driven_place(guide, driver)?, axis }]);
        }
        // A point with given coordinates determines the position of a link with a known direction.
        let shape = &self.shapes[link.0];
        if let Some((local, at)) = shape
            .points
            .iter()
            .find_map(|(p, local)| Some((*local, given_place(self.scene, &self.inputs, *p)?)))
        {
            return Ok(vec![Pose { origin: at - local.to_vec2().rotate_by(axis), axis }]);
        }
        // A driven carriage without a point has an arbitrary position along its guide.
        let driven = |h: &Hold| matches!(h, Hold::Glide { driver: Some(_), .. });
        if shape.points.is_empty() && holds.iter().any(driven) {
            return Ok(vec![Pose { origin: Point::origin(), axis }]);
        }
        // A slot with `through` at the pin's own position meets the pin wherever the link is along
        // its guide. If the link only translates, its position changes no vector: its first point
        // is put at the pin.
        let unplaced = |h: &Hold| {
            if let Hold::Slot { guide, pin } = *h {
                self.guides[guide.0].is_none().then_some(pin)
            } else {
                None
            }
        };
        let met = holds.iter().find_map(unplaced);
        if let Some(pin) = met
            && (shape.points.is_empty() || self.m.never_turns[link.0])
        {
            let origin = if shape.points.is_empty() { Point::origin() } else { self.known(pin) };
            return Ok(vec![Pose { origin, axis }]);
        }
        let [a, b] = holds else { return Err(self.no_closure(link)) };
        if let Some((pair, kept)) = rolling_beside(a, b) {
            let line = self.triad_leg(link, kept)?.locus(axis);
            let Some(rolled) = self.origin_of_rack(link, axis, pair) else {
                // At the instant a rack may be anywhere along its guide.
                return match (line, self.instant) {
                    (Locus::Line { through, .. }, None) => Ok(vec![Pose { origin: through, axis }]),
                    _ => Err(self.no_closure(link)),
                };
            };
            let origins = kernel::meet(line, rolled).map_err(|_| self.no_closure(link))?;
            return Ok(origins.into_iter().map(|origin| Pose { origin, axis }).collect());
        }
        let (la, lb) = (self.triad_leg(link, a)?.locus(axis), self.triad_leg(link, b)?.locus(axis));
        let origins = kernel::meet(la, lb).map_err(|miss| {
            let how = match miss {
                Miss::Parallel(0.0) => both!("its two guides run parallel"),
                Miss::TooFar(x) | Miss::TooNear(x) | Miss::Parallel(x) => {
                    both!("its two joints miss each other by {}", self.scene.length_words(x))
                }
            };
            Diagnostic::error(
                "cannot-assemble",
                both!("link {} cannot be placed: {}", self.scene.link_name(link), how),
            )
            .at(self.scene.links[link.0].span)
        })?;
        Ok(origins.into_iter().map(|origin| Pose { origin, axis }).collect())
    }

    fn triad_leg(&self, link: LinkId, hold: &Hold) -> Result<TriadLeg<N>, Diagnostic> {
        let local =
            |p: PointId| self.shapes[link.0].local(p).ok_or_else(|| self.not_placed(p, link));
        Ok(match *hold {
            Hold::Distance { near, far, strut } => {
                let radius = self.strut_length(near, far, strut)?;
                TriadLeg::Circle { near: local(near)?, far: self.known(far), radius }
            }
            Hold::Guide { pin, guide, driver: None } => match self.need_guide(guide)? {
                Path::Line { through, direction } => {
                    TriadLeg::Line { near: local(pin)?, through, direction }
                }
                Path::Arc { centre, radius } => {
                    TriadLeg::Circle { near: local(pin)?, far: centre, radius }
                }
            },
            Hold::Slot { pin, guide } => match self.guides[guide.0] {
                Some(Path::Line { through, direction }) => {
                    TriadLeg::Slot { through, direction, pin: self.known(pin) }
                }
                Some(Path::Arc { centre, radius }) => {
                    TriadLeg::Circle { near: centre, far: self.known(pin), radius }
                }
                None => return Err(self.no_closure(link)),
            },
            Hold::Glide { guide, other, driver: None } => {
                let on = self.scene.guides[guide.0].on;
                let direction = match (self.guide_in_plane(guide), on == other) {
                    (Some(Path::Line { direction, .. }), true) => direction,
                    _ => match self.guides[guide.0] {
                        Some(Path::Line { direction, .. }) => direction,
                        _ => return Err(self.no_closure(link)),
                    },
                };
                // The distance of the link's origin from the guide changes no answer: the origin is
                // put on the guide.
                let through = match self.guide_in_plane(guide) {
                    Some(Path::Line { through, .. }) => through,
                    _ => Point::origin(),
                };
                TriadLeg::Line { near: Point::origin(), through, direction }
            }
            Hold::Guide { driver: Some(_), .. }
            | Hold::Glide { driver: Some(_), .. }
            | Hold::Rolls { .. } => {
                return Err(self.no_closure(link));
            }
        })
    }

    /// Returns the pose of a link from the sketch (or coordinates) of two of its points.
    pub(super) fn sketched_pose(&self, link: LinkId) -> Option<(Point, Vec2)> {
        let rough = |p: PointId| {
            given_at(self.scene, p)
                .or(self.scene.points[p.0].sketch.map(|s| Point::new(s[0], s[1])))
        };
        let mut known = self.shapes[link.0]
            .points
            .iter()
            .filter_map(|(p, local)| Some((local.approx(), rough(*p)?)));
        let (a, b) = (known.next()?, known.next()?);
        let pose = Pose::from_point_and_direction(a.0, b.0 - a.0, a.1, b.1 - a.1)?;
        Some((pose.origin, pose.axis))
    }

    /// Returns the diagnostic for a group without a closed form that these numbers cannot prove.
    pub(super) fn unproven(&self, links: &[LinkId], why: Unproven) -> Diagnostic {
        let names: Vec<_> = links.iter().map(|l| self.scene.link_name(*l)).collect();
        let why = match why {
            Unproven::NoRoot => both!("Newton's method does not settle"),
            Unproven::NotUnique => {
                both!("another assembly may lie closer than the numbers can tell")
            }
            Unproven::NotWritten => both!("its pose is not told by lengths and drivers alone"),
        };
        Diagnostic::error(
            "not-proved",
            both!("the assembly of link {} is not proved: {}", Both::names(&names), why),
        )
        .at(self.scene.links[links[0].0].span)
    }

    fn poses_of_triad(&self, link: LinkId, holds: &[Hold]) -> Result<Vec<Pose<N>>, Diagnostic> {
        let [a, b, c] = holds else { return Err(self.no_closure(link)) };
        let legs = [self.triad_leg(link, a)?, self.triad_leg(link, b)?, self.triad_leg(link, c)?];
        if let Some(pose) = self.known_pose(link) {
            return match triad::refined(&legs, pose) {
                Ok(pose) => Ok(vec![pose]),
                Err(why) => Err(self.unproven(&[link], why)),
            };
        }
        let found = triad::assemblies(&legs.map(|l| l.approx()), self.sketched_pose(link));
        if found.is_empty() {
            return Err(Diagnostic::error(
                "cannot-assemble",
                both!(
                    "link {} cannot be placed on its three legs in any position",
                    self.scene.link_name(link)
                ),
            )
            .at(self.scene.links[link.0].span)
            .help(both!("change a length of the group or the driver's position")));
        }
        Ok(found
            .into_iter()
            .map(|(origin, axis)| Pose { origin: origin.lift(), axis: axis.lift() })
            .collect())
    }
}

/// Returns the rolling pair of two holds, if one of them rolls, and the other hold.
fn rolling_beside<'a>(a: &'a Hold, b: &'a Hold) -> Option<(RollingId, &'a Hold)> {
    match (a, b) {
        (Hold::Rolls { pair, .. }, other) | (other, Hold::Rolls { pair, .. }) => {
            Some((*pair, other))
        }
        _ => None,
    }
}
