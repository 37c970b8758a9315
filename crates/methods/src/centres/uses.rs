//! Uses of centres: angular velocities from ratios of distances, and speeds of sliders and points,
//! starting at one driver.
//!
//! ω_k/ω_m = P_fm P_km : P_fk P_km, with the same sense if P_km lies outside P_fm P_fk. A link that
//! does not turn has the velocity of link m at P_km. The frame f is the link to which the driver's
//! motion is relative, usually the ground. Velocities only: the acceleration of a centre is not
//! zero.

use hodograph_base::geom::{Point, Vec2};
use hodograph_mechanism::answer::MotionSource;
use hodograph_mechanism::mechanism::Level;
use hodograph_mechanism::position::Path;
use hodograph_scene::{DriverKind, LinkId, PointId, Scene};
use hodograph_worked::worked::Worked;

use super::lines::{CentrePlace, SAME};
use super::locate::Centre;
use super::rounds::CentreClosure;
use super::velocities::RESTING;

/// The motion of a link relative to the frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RelativeMotion {
    /// Rotation (rad/s, counter-clockwise plus) about the link's centre.
    Turn(f64),
    /// Translation: all points have this velocity (m/s).
    Slide(Vec2),
}

/// The source of a link's motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CentreMotionSource {
    /// The driver gives it.
    Driver,
    /// The loop equations, because no driver acts between two numbered links.
    Analysis,
    /// The other link turns, and has at the common centre the velocity of this link, which turns
    /// too.
    Ratio {
        /// The other link m.
        link: LinkId,
        /// P_fm P_km (m).
        of_other: f64,
        /// P_fk P_km (m).
        own: f64,
    },
    /// The other link turns with the same angular velocity: the common centre is at infinity.
    Together(LinkId),
    /// The other link turns, and has at the common centre the velocity of this link, which does not
    /// turn.
    Slides {
        /// The other link m.
        link: LinkId,
        /// P_fm P_km (m).
        arm: f64,
    },
    /// Neither link turns: both have the same velocity component along the direction of their
    /// centre at infinity.
    Wedge(LinkId),
    /// The other link does not turn, and this link has its velocity at the common centre.
    FromSlide {
        /// The other link m.
        link: LinkId,
        /// P_fk P_km (m).
        arm: f64,
    },
}

/// The motion of one link by centres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CentreMotion {
    /// The link.
    pub link: LinkId,
    /// The source of the motion.
    pub by: CentreMotionSource,
    /// The motion relative to the frame.
    pub motion: RelativeMotion,
    /// ω relative to the ground (rad/s).
    pub omega: f64,
}

/// The velocity of a point by centres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Speed {
    /// The point.
    pub point: PointId,
    /// The link from which the velocity is found.
    pub link: LinkId,
    /// The point's distance from the link's centre relative to the ground (m); `None` if that
    /// centre is at infinity.
    pub arm: Option<f64>,
    /// The velocity relative to the ground (m/s).
    pub velocity: Vec2,
}

/// Angular velocities and speeds by centres.
#[derive(Clone, Debug, PartialEq)]
pub struct Uses {
    /// The link to which the motions are relative.
    pub frame: LinkId,
    /// The links, each after the links on which it depends.
    pub links: Vec<CentreMotion>,
    /// The points.
    pub points: Vec<Speed>,
}

/// Returns angular velocities and speeds, starting at the first driver.
pub(super) fn uses(
    scene: &Scene,
    worked: &Worked,
    closure: &CentreClosure,
    list: &[Centre],
) -> Uses {
    let mut chain =
        MotionChain { scene, worked, closure, list, frame: scene.ground, known: Vec::new() };
    let (frame, first) = match chain.driver(0) {
        Some((frame, link, motion)) => (frame, Some((link, CentreMotionSource::Driver, motion))),
        None => (scene.ground, chain.analysis()),
    };
    chain.frame = frame;
    if let Some((link, by, motion)) = first {
        chain.known.push(CentreMotion { link, by, motion, omega: 0.0 });
    }
    // Further drivers with the same reference link.
    for k in 1..scene.drivers.len() {
        match chain.driver(k) {
            Some((other, link, motion))
                if other == frame && !chain.known.iter().any(|t| t.link == link) =>
            {
                chain.known.push(CentreMotion {
                    link,
                    by: CentreMotionSource::Driver,
                    motion,
                    omega: 0.0,
                });
            }
            Some(_) | None => {}
        }
    }
    chain.go_on();
    chain.against_ground();
    let points =
        scene.find.iter().filter_map(|f| chain.speed(f.what.meaning(scene)?.vector_of()?.point));
    let points = points.collect();
    Uses { frame, links: chain.known, points }
}

struct MotionChain<'a> {
    scene: &'a Scene,
    worked: &'a Worked,
    closure: &'a CentreClosure,
    list: &'a [Centre],
    frame: LinkId,
    known: Vec<CentreMotion>,
}

impl MotionChain<'_> {
    fn place(&self, a: LinkId, b: LinkId) -> Option<CentrePlace> {
        let pair = self.closure.pair(a, b);
        self.list.iter().find(|c| c.step.pair == pair)?.place
    }

    /// Returns the frame, the link and the motion that a driver gives.
    fn driver(&self, k: usize) -> Option<(LinkId, LinkId, RelativeMotion)> {
        let driver = self.scene.drivers.get(k)?;
        let rate = driver.rate.value;
        let at = &self.worked.configuration;
        match &driver.kind {
            DriverKind::Turn { link, against, .. } => {
                Some((*against, *link, RelativeMotion::Turn(rate)))
            }
            DriverKind::Slide { guide, .. } => {
                let g = &self.scene.guides[guide.0];
                let path = at.guides[guide.0]?;
                let velocity = |at: Point| path.tangent_at(at) * rate;
                match (g.slider, path, g.pin) {
                    (Some(slider), Path::Line { direction, .. }, _) => {
                        Some((g.on, slider, RelativeMotion::Slide(direction * rate)))
                    }
                    (Some(slider), Path::Arc { radius, .. }, _) => {
                        Some((g.on, slider, RelativeMotion::Turn(rate / radius)))
                    }
                    (None, _, Some(pin)) => {
                        let link = self.scene.carriers(pin).find(|l| *l != g.on)?;
                        let pin = at.points[pin.0]?;
                        Some((g.on, link, about(self.place(g.on, link)?, pin, velocity(pin))?))
                    }
                    (None, _, None) => None,
                }
            }
            DriverKind::Cylinder { a, b, links, .. } => match links[..] {
                [barrel, rod] => Some((
                    barrel,
                    rod,
                    RelativeMotion::Slide((at.points[b.0]? - at.points[a.0]?).unit()? * rate),
                )),
                _ => None,
            },
        }
    }

    /// Returns the first link that turns, with its motion from the loop equations.
    fn analysis(&self) -> Option<(LinkId, CentreMotionSource, RelativeMotion)> {
        let solution = &self.worked.solution;
        let moves = |l: &LinkId| {
            *l != self.scene.ground
                && solution.turning(Level::Velocity, *l).is_some_and(|omega| omega != 0.0)
        };
        let link = self.closure.links.iter().copied().find(moves)?;
        Some((
            link,
            CentreMotionSource::Analysis,
            RelativeMotion::Turn(solution.turning(Level::Velocity, link)?),
        ))
    }

    /// Adds one link after another, each by the first known link that determines it.
    fn go_on(&mut self) {
        if self.known.is_empty() {
            return;
        }
        loop {
            let before = self.known.len();
            for k in self.closure.links.clone() {
                if k == self.frame || self.known.iter().any(|t| t.link == k) {
                    continue;
                }
                if let Some((by, motion)) = self.known.iter().find_map(|m| self.next(k, m)) {
                    let motion = self.settled(motion);
                    self.known.push(CentreMotion { link: k, by, motion, omega: 0.0 });
                }
            }
            if self.known.len() == before {
                return;
            }
        }
    }

    /// Returns the motion of link k from the motion of link m.
    fn next(&self, k: LinkId, m: &CentreMotion) -> Option<(CentreMotionSource, RelativeMotion)> {
        let (own, shared) = (self.place(self.frame, k)?, self.place(k, m.link)?);
        match (own, shared, m.motion) {
            (CentrePlace::At(o), CentrePlace::At(x), _) => {
                let motion = about(own, x, self.velocity(m, x)?)
                    .filter(|_| o.distance(x) > SAME * self.size())?;
                let by = match self.place(self.frame, m.link)? {
                    CentrePlace::At(c) => CentreMotionSource::Ratio {
                        link: m.link,
                        of_other: c.distance(x),
                        own: o.distance(x),
                    },
                    CentrePlace::Infinity(_) => {
                        CentreMotionSource::FromSlide { link: m.link, arm: o.distance(x) }
                    }
                };
                Some((by, motion))
            }
            (CentrePlace::At(_), CentrePlace::Infinity(_), RelativeMotion::Turn(omega)) => {
                Some((CentreMotionSource::Together(m.link), RelativeMotion::Turn(omega)))
            }
            (CentrePlace::Infinity(_), CentrePlace::At(x), RelativeMotion::Turn(_)) => {
                let arm = self.place(self.frame, m.link)?.point()?.distance(x);
                Some((
                    CentreMotionSource::Slides { link: m.link, arm },
                    RelativeMotion::Slide(self.velocity(m, x)?),
                ))
            }
            (
                CentrePlace::Infinity(own),
                CentrePlace::Infinity(shared),
                RelativeMotion::Slide(v),
            ) => {
                let along = own.perp();
                let part = along.dot(shared);
                (part.abs() > SAME).then(|| {
                    (
                        CentreMotionSource::Wedge(m.link),
                        RelativeMotion::Slide(along * (v.dot(shared) / part)),
                    )
                })
            }
            (CentrePlace::At(_), CentrePlace::Infinity(_), RelativeMotion::Slide(_))
            | (CentrePlace::Infinity(_), CentrePlace::At(_), RelativeMotion::Slide(_))
            | (CentrePlace::Infinity(_), CentrePlace::Infinity(_), RelativeMotion::Turn(_)) => None,
        }
    }

    /// Sets a motion to rest if it is negligible beside the fastest known one: two distances that
    /// cancel leave a rounding error.
    fn settled(&self, motion: RelativeMotion) -> RelativeMotion {
        let size = self.size();
        let rate = |m: &RelativeMotion| match m {
            RelativeMotion::Turn(omega) => omega.abs(),
            RelativeMotion::Slide(v) => v.norm() / size,
        };
        let fastest = self.known.iter().map(|t| rate(&t.motion)).fold(0.0, f64::max);
        match motion {
            m if rate(&m) > RESTING * fastest => m,
            RelativeMotion::Turn(_) => RelativeMotion::Turn(0.0),
            RelativeMotion::Slide(_) => RelativeMotion::Slide(Vec2::ZERO),
        }
    }

    fn size(&self) -> f64 {
        self.worked.configuration.extent()
    }

    /// Returns the velocity of a link's point at a place, relative to the frame.
    fn velocity(&self, of: &CentreMotion, at: Point) -> Option<Vec2> {
        match of.motion {
            RelativeMotion::Turn(omega) => {
                Some((at - self.place(self.frame, of.link)?.point()?).perp() * omega)
            }
            RelativeMotion::Slide(v) => Some(v),
        }
    }

    fn of(&self, l: LinkId) -> Option<&CentreMotion> {
        self.known.iter().find(|t| t.link == l)
    }

    /// Computes ω relative to the ground, in case the motions are relative to another link.
    fn against_ground(&mut self) {
        let rate = |t: &CentreMotion| match t.motion {
            RelativeMotion::Turn(omega) => omega,
            RelativeMotion::Slide(_) => 0.0,
        };
        let ground = self.of(self.scene.ground).map_or(0.0, rate);
        self.known.iter_mut().for_each(|t| t.omega = rate(t) - ground);
    }

    /// Returns the velocity of a point, from the first link that carries it and has a known motion.
    fn speed(&self, point: PointId) -> Option<Speed> {
        let at = self.worked.configuration.points[point.0]?;
        let still = CentreMotion {
            link: self.frame,
            by: CentreMotionSource::Driver,
            motion: RelativeMotion::Slide(Vec2::ZERO),
            omega: 0.0,
        };
        let of = |l: LinkId| if l == self.frame { Some(&still) } else { self.of(l) };
        let ground = self.velocity(of(self.scene.ground)?, at)?;
        let link =
            self.scene.carriers(point).find(|l| *l != self.scene.ground && of(*l).is_some())?;
        let velocity = self.velocity(of(link)?, at)? - ground;
        let arm = self.place(self.scene.ground, link)?.point().map(|c| c.distance(at));
        Some(Speed { point, link, arm, velocity })
    }
}

/// Returns the motion about a centre that gives a place this velocity.
fn about(centre: CentrePlace, at: Point, v: Vec2) -> Option<RelativeMotion> {
    match centre {
        CentrePlace::At(c) => {
            let r = at - c;
            let omega = r.cross(v) / r.norm2();
            omega.is_finite().then_some(RelativeMotion::Turn(omega))
        }
        CentrePlace::Infinity(_) => Some(RelativeMotion::Slide(v)),
    }
}
