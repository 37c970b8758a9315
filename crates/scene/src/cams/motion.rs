//! A cam beyond its instant: the replacement of its contact during motion.
//!
//! Over a turn the contact passes from piece to piece, and with a law the equivalent linkage
//! changes continuously: one set of lower pairs is right at one instant only. For the whole motion
//! the follower is therefore a driver whose place and rates follow from the angle of the cam. A
//! profile of one circle is replaced exactly everywhere and remains as it is.

use super::super::driver::{Position, PositionSlot};
use super::super::model::*;
use super::course::{FollowerCourse, FollowerState, HangsOn};
use hodograph_base::cam::{CamJet, Follower, PieceSide};
use hodograph_base::diag::Span;
use hodograph_base::number::{Ball, Real};

impl Scene {
    /// Returns true if followers of cams are drivers that depend on this driver; they are then set
    /// together with it.
    pub fn has_laws(&self, driver: usize) -> bool {
        let of_disc = self
            .cams
            .iter()
            .filter_map(|c| c.disc.as_ref())
            .any(|t| t.driver == driver && t.by_law.is_some());
        of_disc || self.courses().next().is_some() && !self.is_led(driver)
    }

    /// Returns true if a driver is a follower that a cam moves.
    pub fn is_led(&self, driver: usize) -> bool {
        self.is_on_a_course(driver)
            || self.cams.iter().filter_map(|c| c.disc.as_ref()).any(|t| t.by_law == Some(driver))
    }

    /// Returns true if a driver is a follower moved by a cam on another link.
    pub fn is_on_a_course(&self, driver: usize) -> bool {
        self.courses().any(|(_, k, _)| k == driver)
    }

    /// Returns the followers moved by cams on other links: cam, driver, and the computation of the
    /// states.
    fn courses(&self) -> impl Iterator<Item = (usize, usize, &FollowerCourse)> {
        self.cams.iter().enumerate().filter_map(|(i, c)| {
            let (k, course) = c.posed.as_ref()?.led.as_ref()?;
            Some((i, *k, course))
        })
    }

    /// Returns the number of independent drivers; followers moved by cams do not count.
    pub fn own_drivers(&self) -> usize {
        (0..self.drivers.len()).filter(|d| !self.is_led(*d)).count()
    }

    /// Returns true if the pairs that replace a cam are right at the instant only.
    pub fn has_momentary_cams(&self) -> bool {
        let momentary = |c: &Cam| c.circle.is_none() && (c.disc.is_some() || c.posed.is_some());
        self.cams.iter().any(momentary)
    }

    /// Returns the scene for its whole motion: followers of profiles of several pieces become
    /// drivers too.
    pub fn over_a_turn(&self) -> Scene {
        let mut scene = self.clone();
        for i in 0..scene.cams.len() {
            let c = &scene.cams[i];
            if let (Some(guide), Some(turning), None) = (c.contact, &c.disc, c.circle)
                && turning.by_law.is_none()
                && let Some(kind) = scene.follower_driver(c, turning)
            {
                let (led, span) = (turning.driver, c.span);
                let zero = || GivenQuantity { value: 0.0, radius: 0.0, text: "0".into(), span };
                let index = scene.drivers.len();
                scene.drivers.push(Driver {
                    kind,
                    rate: zero(),
                    acceleration: Some(zero()),
                    rate_told: true,
                    law: None,
                    span,
                });
                scene.cams[i].contact = None;
                if let Some(t) = &mut scene.cams[i].disc {
                    t.by_law = Some(index);
                }
                scene.without_guide(guide);
                scene.set_followers(led, None);
            }
        }
        scene
    }

    /// Makes the follower of a cam on another link a driver whose states come from `course`; other
    /// drivers without a position get theirs from `positions`.
    pub fn lead(&mut self, cam: usize, hangs: HangsOn, course: FollowerCourse, positions: &[f64]) {
        let Some(guide) = self.cams[cam].contact.take() else { return };
        let span = self.cams[cam].span;
        let kind = match hangs {
            HangsOn::Guide(guide) => {
                DriverKind::Slide { guide, position: Some(number(0.0, "m", span)) }
            }
            HangsOn::Pivot { against, line: [a, b] } => {
                let link = self.cams[cam].follower;
                DriverKind::Turn {
                    link,
                    against,
                    line: Some((a, b)),
                    against_line: None,
                    angle: Some(angle(0.0, span)),
                }
            }
        };
        for (d, at) in self.drivers.iter_mut().zip(positions) {
            match d.kind.slot() {
                PositionSlot::Angle(place @ None) => *place = Some(angle(*at, span)),
                PositionSlot::Coordinate(place @ None) | PositionSlot::Distance(place @ None) => {
                    *place = Some(number(*at, "m", span))
                }
                PositionSlot::Angle(Some(_))
                | PositionSlot::Coordinate(Some(_))
                | PositionSlot::Distance(Some(_)) => {}
            }
        }
        let index = self.drivers.len();
        let zero = || number(0.0, "m/s", span);
        self.drivers.push(Driver {
            kind,
            rate: zero(),
            acceleration: Some(zero()),
            rate_told: true,
            law: None,
            span,
        });
        self.without_guide(guide);
        if let Some(pieces) = &mut self.cams[cam].posed {
            pieces.led = Some((index, course));
        }
        self.set_courses(&|_| None);
    }

    /// Sets the followers of cams on other links for the driver positions `at`, with the stated
    /// positions as default. A follower that cannot be followed gets the place NaN.
    pub fn set_courses(&mut self, at: &dyn Fn(usize) -> Option<f64>) {
        if self.courses().next().is_none() {
            return;
        }
        let standing = self.driver_states(at);
        let all: Vec<(usize, usize, Option<FollowerState>)> =
            self.courses().map(|(i, k, course)| (i, k, course.0.led(&standing))).collect();
        for (cam, driver, led) in all {
            let span = self.cams[cam].span;
            let [place, rate, acceleration] = led.map_or([f64::NAN, 0.0, 0.0], |led| led.place);
            if let (Some(pieces), Some(led)) = (&mut self.cams[cam].posed, led) {
                pieces.touched = led.piece;
            }
            self.put(driver, [place, rate, acceleration], span);
        }
    }

    /// Returns place, rate and acceleration of the drivers without a course, at the positions `at`,
    /// with the stated positions as default.
    fn driver_states(&self, at: &dyn Fn(usize) -> Option<f64>) -> Vec<[f64; 3]> {
        let own = (0..self.drivers.len()).filter(|d| !self.is_on_a_course(*d));
        let of = |d: usize| {
            let driver = &self.drivers[d];
            let stated = driver.kind.position().map_or(0.0, Position::value);
            [
                at(d).unwrap_or(stated),
                driver.rate.value,
                driver.acceleration.as_ref().map_or(0.0, |a| a.value),
            ]
        };
        own.map(of).collect()
    }

    /// Returns the scene with error bounds on the followers that are drivers: their place, rate and
    /// acceleration are double-precision values with these bounds at every precision of the ladder;
    /// `None` without such followers.
    pub fn bounded(&self) -> Option<Scene> {
        let standing = self.driver_states(&|_| None);
        let on_courses = self.courses().map(|(_, k, course)| (k, course.0.off(&standing)));
        let discs = self.cams.iter().filter_map(|c| c.disc.as_ref());
        let on_discs =
            discs.filter_map(|t| Some((t.by_law.filter(|k| self.drivers[*k].is_put())?, t)));
        let on_discs = on_discs.map(|(k, t)| (k, t.off(self, &self.drivers[k])));
        let all: Vec<(usize, [f64; 3])> = on_courses
            .chain(on_discs)
            .map(|(k, off)| (k, off.unwrap_or([f64::INFINITY; 3])))
            .collect();
        if all.is_empty() {
            return None;
        }
        let mut scene = self.clone();
        for (driver, [place, rate, acceleration]) in all {
            let d = &mut scene.drivers[driver];
            match d.kind.slot() {
                PositionSlot::Angle(Some(angle)) => within(angle, place),
                PositionSlot::Coordinate(Some(x)) | PositionSlot::Distance(Some(x)) => {
                    within(x, place)
                }
                PositionSlot::Angle(None)
                | PositionSlot::Coordinate(None)
                | PositionSlot::Distance(None) => {}
            }
            within(&mut d.rate, rate);
            d.acceleration.iter_mut().for_each(|a| within(a, acceleration));
        }
        Some(scene)
    }

    /// Returns the cam whose follower, itself a driver, does not touch it at the positions of the
    /// drivers.
    pub fn lost_follower(&self) -> Option<&Cam> {
        let lost = |d: usize| self.drivers[d].kind.position().is_some_and(|at| at.value().is_nan());
        let led = |c: &Cam| {
            c.disc
                .as_ref()
                .and_then(|t| t.by_law)
                .or_else(|| Some(c.posed.as_ref()?.led.as_ref()?.0))
        };
        self.cams.iter().find(|c| led(c).is_some_and(lost))
    }

    /// Sets place, rate and acceleration (SI) of a driver that replaces a contact.
    fn put(&mut self, driver: usize, [place, rate, acceleration]: [f64; 3], span: Span) {
        let d = &mut self.drivers[driver];
        let units = if d.kind.turns() { ["rad/s", "rad/s^2"] } else { ["m/s", "m/s^2"] };
        match d.kind.slot() {
            PositionSlot::Angle(place_of) => *place_of = Some(angle(place, span)),
            PositionSlot::Coordinate(position) => *position = Some(number(place, "m", span)),
            PositionSlot::Distance(_) => {}
        }
        d.rate = number(rate, units[0], span);
        d.acceleration = Some(number(acceleration, units[1], span));
    }

    /// Returns cams whose pairs are right at the instant only and have no driver for a whole turn:
    /// a swinging flat face without a line, and a cam and follower on different links if the
    /// follower is not joined by a single pair.
    pub fn kept_cams(&self) -> impl Iterator<Item = &Cam> {
        self.cams.iter().filter(|c| {
            c.circle.is_none()
                && c.contact.is_some()
                && c.disc.as_ref().is_none_or(|t| t.by_law.is_none())
        })
    }

    /// Returns the driver of a follower on the link that carries the cam; `None` for a face without
    /// a line to measure its angle.
    fn follower_driver(&self, c: &Cam, t: &TurningCam) -> Option<DriverKind> {
        let given = |value: f64| GivenQuantity {
            value,
            radius: 0.0,
            text: format!("({value:?}) m"),
            span: c.span,
        };
        match t.disc.follower {
            Follower::Translating { .. } => {
                let guide = self
                    .guides
                    .iter()
                    .position(|g| g.slider == Some(c.follower) && g.on == t.frame)
                    .map(GuideId)?;
                Some(DriverKind::Slide { guide, position: Some(given(0.0)) })
            }
            Follower::Oscillating { .. } => {
                let pivot = self.links[c.follower.0]
                    .points
                    .iter()
                    .copied()
                    .find(|p| self.links[t.frame.0].points.contains(p))?;
                // A face through the pivot turns with its own line.
                let line = Some((pivot, c.follows.point()))
                    .filter(|(a, b)| a != b)
                    .or_else(|| self.face_line(c, pivot))?;
                Some(DriverKind::Turn {
                    link: c.follower,
                    against: t.frame,
                    line: Some(line),
                    against_line: None,
                    angle: Some(angle(0.0, c.span)),
                })
            }
        }
    }

    /// Returns the line of a flat face that begins at its pivot.
    fn face_line(&self, c: &Cam, pivot: PointId) -> Option<(PointId, PointId)> {
        match self.guides[c.contact?.0].path {
            GuidePath::Line { direction: GuideDirection::Along(a, b, None), .. } => {
                Some((a, b)).filter(|(a, _)| *a == pivot)
            }
            GuidePath::Line {
                direction:
                    GuideDirection::Along(_, _, Some(_))
                    | GuideDirection::Own
                    | GuideDirection::Instant(_)
                    | GuideDirection::Slid(_),
                ..
            }
            | GuidePath::Arc { .. } => None,
        }
    }

    /// Removes a guide and renumbers the references to later ones.
    fn without_guide(&mut self, out: GuideId) {
        self.guides.remove(out.0);
        let shift = |g: &mut GuideId| {
            if g.0 > out.0 {
                g.0 -= 1;
            }
        };
        for d in &mut self.drivers {
            if let DriverKind::Slide { guide, .. } = &mut d.kind {
                shift(guide);
            }
        }
        self.cams.iter_mut().filter_map(|c| c.contact.as_mut()).for_each(shift);
        self.rolling.iter_mut().filter_map(crate::Rolling::guide_mut).for_each(shift);
    }

    /// Turns the cams of a driver and sets the followers that are drivers. The driver's position is
    /// `value` (rad), else its stated position, else that of the pose given by coordinates. A
    /// follower without contact gets the place NaN.
    pub fn set_followers(&mut self, driver: usize, value: Option<f64>) {
        let Some(lead) = self.drivers.get(driver) else { return };
        let stated = match &lead.kind {
            DriverKind::Turn { angle, .. } => angle.as_ref().map(|a| a.value.radians()),
            DriverKind::Slide { .. } | DriverKind::Cylinder { .. } => None,
        };
        let (rate, acceleration) =
            (lead.rate.value, lead.acceleration.as_ref().map_or(0.0, |a| a.value));
        for i in 0..self.cams.len() {
            let c = &mut self.cams[i];
            let (Some(t), span) = (&mut c.disc, c.span) else { continue };
            if t.driver != driver {
                continue;
            }
            let sense = t.disc.sense * t.way;
            if let Some(at) = value.or(stated) {
                t.phi = t.disc.sense * (t.way * at + t.from - t.start);
            }
            t.side = if rate * sense < 0.0 { PieceSide::Before } else { PieceSide::After };
            let Some(k) = t.by_law else { continue };
            let Some(q) = t.disc.coordinate(t.phi, t.side) else {
                self.put(k, [f64::NAN, 0.0, 0.0], span);
                continue;
            };
            let CamJet([q, dq, ddq, _]) = q;
            let (place, out) = (t.origin + t.outward * q, t.outward);
            let (v, a) = (
                out * dq * sense * rate,
                out * (ddq * (sense * rate) * (sense * rate) + dq * sense * acceleration),
            );
            self.put(k, [place, v, a], span);
        }
        self.set_courses(&|d| value.filter(|_| d == driver));
    }
}

impl Driver {
    /// True if its place is a number of double precision that the program has set.
    fn is_put(&self) -> bool {
        let is = |text: &str, value: f64| {
            text.strip_prefix('(').is_some_and(|t| t.starts_with(&format!("{value:?})")))
        };
        match self.kind.position() {
            Some(Position::Angle(a)) => is(&a.text, a.value.radians()),
            Some(Position::Length(x)) => is(&x.text, x.value),
            None => false,
        }
    }
}

impl TurningCam {
    /// Returns bounds of the errors of place, rate and acceleration of a driver that replaces the
    /// contact; `None` where there is no enclosure.
    fn off(&self, scene: &Scene, driver: &Driver) -> Option<[f64; 3]> {
        let told = [
            driver.kind.position()?.value(),
            driver.rate.value,
            driver.acceleration.as_ref()?.value,
        ];
        let exact = self.led_in::<Ball<f64>>(scene)?;
        Some(
            [0, 1, 2]
                .map(|k| exact[k] - Ball::from_f64(told[k]))
                .map(|x| x.approx().abs() + x.radius()),
        )
    }
}

/// Gives a number a bound of its error and deletes its text, which would replace the bound.
fn within<T>(given: &mut GivenQuantity<T>, off: f64) {
    given.radius = off;
    given.text.clear();
}

/// A value in double precision, with the shortest decimal text that reads back as the same number.
fn number(value: f64, unit: &str, span: Span) -> GivenQuantity {
    GivenQuantity {
        value,
        radius: value.abs() * f64::EPSILON,
        text: format!("({value:?}) ({unit})"),
        span,
    }
}

fn angle(value: f64, span: Span) -> GivenQuantity<Angle> {
    GivenQuantity {
        value: Angle::Rad(value),
        radius: value.abs() * f64::EPSILON,
        text: format!("({value:?}) rad"),
        span,
    }
}
