//! The whole motion of cams of several pieces with followers that move with other links than they
//! do.
//!
//! Along one piece of the profile the contact is a pair like any other, and Newton's method follows
//! the mechanism from step to step (natural continuation). Where the contact leaves its piece,
//! bisection finds the position of the drivers, and the motion goes on with the pair of the next
//! piece, from the same pose. The result is the coordinate of the follower in the pair that carries
//! it, with its rates by the loop equations: the swept scene has a driver there instead of the
//! contact, as it has for a cam and a follower carried by one link.

use super::step::{TravelPose, foretold, is_followed};
use crate::station::position_now;
use hodograph_analytic as analytic;
use hodograph_base::cam::in_half_turns;
use hodograph_base::geom::Vec2;
use hodograph_base::number::{Ball, Real};
use hodograph_mechanism::answer::MotionSource;
use hodograph_mechanism::mechanism::{Demand, Level, Mechanism};
use hodograph_mechanism::motion;
use hodograph_mechanism::position::newton::{self, DriverValues};
use hodograph_mechanism::position::{self, Configuration, Path, pieces};
use hodograph_scene::cams::{FollowerCourse, FollowerSolver, FollowerState, HangsOn};
use hodograph_scene::{
    Cam, GivenQuantity, GuideId, GuidePath, LinkId, Pieces, PointId, Scene, with_driver_at,
};
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::sync::{Arc, Mutex, PoisonError};

/// A step of a turning driver (rad): 5°.
const STEP: f64 = std::f64::consts::PI / 36.0;
/// A step of a sliding driver, as a part of the mechanism's size.
const PART: f64 = 0.02;
/// The number of steps from one position of the drivers to another after which the way counts as
/// blocked.
const MOST_STEPS: usize = 10_000;
/// The part of the way between two positions below which a step is too short.
const SHORTEST: f64 = 1e-9;
/// The greatest distance beyond the end of its piece at which a contact counts as on it (rad, or a
/// part of a line): a junction is found to rounding.
const ON: f64 = 1e-11;

/// Returns a scene for its whole motion: followers of cams of several pieces are drivers, whichever
/// links carry them.
pub fn over_a_turn(scene: &Scene) -> Scene {
    let mut out = scene.over_a_turn();
    let mut several = (0..out.cams.len()).filter(|i| out.cams[*i].posed.is_some());
    // If two such cams lead one another, or another cam leads the follower of one, each piece would
    // occur in many pairs.
    if let (Some(cam), None) = (several.next(), several.next())
        && out.own_drivers() == out.drivers.len()
        && let Some((handed, hangs)) = Handed::of(scene, cam)
    {
        let positions = handed.positions.clone();
        out.lead(cam, hangs, FollowerCourse(Arc::new(handed)), &positions);
    }
    out
}

/// A mechanism with its contact on one of the pieces.
struct Variant {
    scene: Scene,
    mechanism: Mechanism,
}

impl Variant {
    fn of(scene: &Scene) -> Option<Variant> {
        Some(Variant { mechanism: Mechanism::new(scene).ok()?.value, scene: scene.clone() })
    }

    fn cam(&self, index: usize) -> Option<(&Cam, &Pieces)> {
        let cam = &self.scene.cams[index];
        Some((cam, cam.posed.as_ref()?))
    }
}

/// A configuration with the contact on one piece.
#[derive(Clone)]
struct ContactState {
    piece: usize,
    at: Configuration,
    /// The drivers' values, as Newton's method counts them.
    drivers: Vec<f64>,
    /// The follower's coordinate, with counted turns.
    coordinate: f64,
}

/// The pair that carries a follower, in which its coordinate is counted.
#[derive(Clone, Copy)]
enum Hangs {
    Slides { guide: usize, on: LinkId, pin: PointId },
    Turns { follower: LinkId, against: LinkId, line: [PointId; 2] },
}

impl Hangs {
    fn of(scene: &Scene, cam: &Cam) -> Option<Hangs> {
        let slides = scene.guides.iter().enumerate().find(|(_, g)| g.slider == Some(cam.follower));
        if let Some((guide, g)) = slides {
            let straight = matches!(g.path, GuidePath::Line { .. });
            return Some(Hangs::Slides { guide, on: g.on, pin: g.pin.filter(|_| straight)? });
        }
        let touches = cam.follows.radius().map(|_| cam.follows.point());
        let told = |l: &LinkId| *l == scene.ground || scene.links[l.0].points.len() > 1;
        let points = &scene.links[cam.follower.0].points;
        let (pivot, against) = points.iter().filter(|p| touches != Some(**p)).find_map(|p| {
            Some((*p, scene.carriers(*p).find(|l| *l != cam.follower && *l != cam.cam && told(l))?))
        })?;
        let other = points.iter().copied().find(|p| *p != pivot)?;
        Some(Hangs::Turns { follower: cam.follower, against, line: [pivot, other] })
    }

    /// The place of the driver that replaces the contact.
    fn held(self) -> HangsOn {
        match self {
            Hangs::Slides { guide, .. } => HangsOn::Guide(GuideId(guide)),
            Hangs::Turns { against, line, .. } => HangsOn::Pivot { against, line },
        }
    }

    fn coordinate<N: Real>(self, scene: &Scene, at: &Configuration<N>) -> Option<N> {
        match self {
            Hangs::Slides { guide, pin, .. } => {
                Some(at.guides[guide]?.coordinate_of(at.points[pin.0]?))
            }
            Hangs::Turns { against, line: [a, b], .. } => {
                let from = if against == scene.ground {
                    Vec2::unit_x()
                } else {
                    at.link_direction(scene, against)?
                };
                Some((at.points[b.0]? - at.points[a.0]?).divide_by(from).angle())
            }
        }
    }

    fn rates<N: Real>(
        self,
        scene: &Scene,
        at: &Configuration<N>,
        motion: &impl MotionSource<N>,
    ) -> Option<[N; 2]> {
        let turning = |level, l| {
            if l == scene.ground { Some(N::from_f64(0.0)) } else { motion.turning(level, l) }
        };
        match self {
            Hangs::Slides { guide, on, pin } => {
                let Path::Line { direction, .. } = at.guides[guide]? else { return None };
                let seat = |level| {
                    if on == scene.ground {
                        Some(Vec2::zero())
                    } else {
                        motion.vector(level, pin, Some(on))
                    }
                };
                let apart = |level| Some(motion.vector(level, pin, None)? - seat(level)?);
                // The Coriolis term is square to the guide, so that only the sliding is left along
                // it.
                Some([
                    direction.dot(apart(Level::Velocity)?),
                    direction.dot(apart(Level::Acceleration)?),
                ])
            }
            Hangs::Turns { follower, against, .. } => {
                let apart = |level| Some(turning(level, follower)? - turning(level, against)?);
                Some([apart(Level::Velocity)?, apart(Level::Acceleration)?])
            }
        }
    }

    /// The corresponding pair in a scene with the same links but other numbers of points.
    fn within(self, from: &Scene, to: &Scene) -> Option<Hangs> {
        Some(match self {
            Hangs::Slides { guide, on, pin } => {
                Hangs::Slides { guide, on, pin: named(from, to, pin)? }
            }
            Hangs::Turns { follower, against, line: [a, b] } => {
                Hangs::Turns { follower, against, line: [named(from, to, a)?, named(from, to, b)?] }
            }
        })
    }
}

/// The point of the same name.
fn named(from: &Scene, to: &Scene, p: PointId) -> Option<PointId> {
    to.points.iter().position(|q| q.name == from.points[p.0].name).map(PointId)
}

/// A mechanism that passes from piece to piece.
struct Handed {
    cam: usize,
    /// The mechanism for each piece of the profile that can be touched, with the pair that carries
    /// the follower there.
    variants: Vec<Option<(Variant, Hangs)>>,
    start: ContactState,
    /// The positions of the drivers at the start, in the scene's count; `steps` are the lengths of
    /// their steps.
    positions: Vec<f64>,
    steps: Vec<f64>,
    /// Positions a number of steps of one driver from the start; `None` where the way ends before.
    known: Mutex<BTreeMap<(usize, i64), Option<ContactState>>>,
    /// Positions found before, by the bits of the drivers' travels: each output and each rate of a
    /// sweep needs the same ones.
    asked: Mutex<BTreeMap<Vec<u64>, Option<ContactState>>>,
}

/// The greatest number of kept positions.
const KEPT: usize = 4096;

impl Handed {
    /// Prepares the mechanism; returns also the pair that carries its follower.
    fn of(scene: &Scene, cam: usize) -> Option<(Handed, HangsOn)> {
        let own = Variant::of(scene)?;
        let (c, pieces) = own.cam(cam)?;
        let hangs = Hangs::of(scene, c)?;
        let demand = all_of(&own.mechanism);
        let at = position::configure(scene, &own.mechanism, &demand).ok()?.value;
        let on = |piece: usize| {
            let variant =
                Variant::of(if piece == pieces.touched { scene } else { pieces.on(piece)? })?;
            let hangs = hangs.within(scene, &variant.scene)?;
            Some((variant, hangs))
        };
        let variants = (0..pieces.segments.len()).map(on).collect();
        let drivers = newton::driver_values(scene, &at).0;
        let positions = (0..scene.drivers.len()).map(|d| position_now(scene, &at, d)).collect();
        let step =
            |d: &hodograph_scene::Driver| if d.kind.turns() { STEP } else { PART * at.extent() };
        let steps = scene.drivers.iter().map(step).collect();
        let start = ContactState {
            piece: pieces.touched,
            coordinate: hangs.coordinate(scene, &at)?,
            at,
            drivers,
        };
        Some((
            Handed {
                cam,
                variants,
                start,
                positions,
                steps,
                known: Mutex::default(),
                asked: Mutex::default(),
            },
            hangs.held(),
        ))
    }

    /// The position a number of steps of a driver from the start, each reached from the one before
    /// it: it does not depend on the order of requests.
    fn grid(&self, driver: usize, steps: i64) -> Option<ContactState> {
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        let way = steps.signum();
        let mut last = Some(self.start.clone());
        let mut k = 0;
        for j in (1..=steps.abs()).rev() {
            if let Some(there) = known.get(&(driver, way * j)) {
                (last, k) = (there.clone(), j);
                break;
            }
        }
        for j in k + 1..=steps.abs() {
            let mut to = self.start.drivers.clone();
            to[driver] += self.steps[driver] * (way * j) as f64;
            last = last.and_then(|last| self.advance(last, &to));
            known.insert((driver, way * j), last.clone());
        }
        last
    }

    /// The configuration when the drivers have travelled by `gone` from the start.
    fn standing(&self, gone: &[f64]) -> Option<ContactState> {
        let to: Vec<f64> =
            self.start.drivers.iter().zip(gone).map(|(from, by)| from + by).collect();
        let mut moving = gone.iter().enumerate().filter(|(_, by)| **by != 0.0);
        let from = match (moving.next(), moving.next()) {
            (Some((d, by)), None) => self.grid(d, libm::trunc(by / self.steps[d]) as i64)?,
            (Some(_), Some(_)) | (None, _) => self.start.clone(),
        };
        self.advance(from, &to)
    }

    /// Returns [`Handed::standing`], reached in either sense, and keeps it.
    fn stands(&self, gone: &[f64]) -> Option<ContactState> {
        let key: Vec<u64> = gone.iter().map(|x| x.to_bits()).collect();
        let kept = self.asked.lock().unwrap_or_else(PoisonError::into_inner).get(&key).cloned();
        if let Some(kept) = kept {
            return kept;
        }
        let found = self.standing(gone).or_else(|| self.standing(&self.other_way_round(gone)?));
        let mut asked = self.asked.lock().unwrap_or_else(PoisonError::into_inner);
        if asked.len() >= KEPT {
            asked.clear();
        }
        asked.insert(key, found.clone());
        found
    }

    /// The travel to the same position, in the other sense, of a single turning driver; `None` if
    /// there is none.
    fn other_way_round(&self, gone: &[f64]) -> Option<Vec<f64>> {
        let mut moving = (0..gone.len()).filter(|d| gone[*d] != 0.0);
        let (driver, None) = (moving.next()?, moving.next()) else { return None };
        let scene = &self.variants[self.start.piece].as_ref()?.0.scene;
        if !scene.drivers[driver].kind.turns() || !scene.rolling.is_empty() {
            return None;
        }
        let mut other = gone.to_vec();
        other[driver] -= TAU.copysign(gone[driver]);
        Some(other)
    }

    /// Follows a straight way of the drivers, from piece to piece.
    fn advance(&self, mut state: ContactState, to: &[f64]) -> Option<ContactState> {
        let extent = self.start.at.extent();
        for _ in 0..MOST_STEPS {
            let from = state.drivers.clone();
            let gap = |k: usize| (to[k] - from[k]).abs() / self.steps[k];
            let parts = (0..to.len()).map(gap).fold(0.0, f64::max);
            if parts == 0.0 {
                return Some(state);
            }
            state = self.along(state, &from, to, (1.0 / parts).min(1.0), extent)?;
        }
        None
    }

    /// Follows the way on one piece, as far as it leads on it; `most` is the greatest step, as a
    /// part of the way.
    fn along(
        &self,
        state: ContactState,
        from: &[f64],
        to: &[f64],
        most: f64,
        extent: f64,
    ) -> Option<ContactState> {
        let (variant, hangs) = self.variants[state.piece].as_ref()?;
        let at = |part: f64| -> Vec<f64> {
            if part == 1.0 {
                to.to_vec()
            } else {
                from.iter().zip(to).map(|(a, b)| a + (b - a) * part).collect()
            }
        };
        let closed = |part: f64, guess: &Configuration| {
            newton::moved(&variant.scene, &variant.mechanism, guess, &DriverValues(at(part)))
        };
        let on = |now: &TravelPose, coordinate: f64| -> Option<ContactState> {
            let q = hangs.coordinate(&variant.scene, &now.configuration)?;
            let q = if matches!(hangs, Hangs::Turns { .. }) {
                coordinate + in_half_turns(q - coordinate)
            } else {
                q
            };
            Some(ContactState {
                piece: state.piece,
                at: now.configuration.clone(),
                drivers: at(now.travel),
                coordinate: q,
            })
        };
        let (mut before, mut now): (Option<TravelPose>, _) =
            (None, TravelPose { travel: 0.0, configuration: state.at.clone() });
        let (mut step, mut coordinate) = (most, state.coordinate);
        while now.travel < 1.0 {
            let next = (now.travel + step).min(1.0);
            let guess = foretold(before.as_ref(), &now, next);
            let half_way = |mean: &Configuration| closed(0.5 * (now.travel + next), mean);
            let followed =
                |c: &Configuration| is_followed([&now.configuration, &guess, c], extent, half_way);
            let Some(there) = closed(next, &guess).filter(followed) else {
                step *= 0.5;
                if step < SHORTEST {
                    return None;
                }
                continue;
            };
            let there = TravelPose { travel: next, configuration: there };
            if self.left(state.piece, &there.configuration)?.is_some() {
                let (last, side) = self.joint(state.piece, now, there, &closed)?;
                return self.handed_over(on(&last, coordinate)?, side);
            }
            coordinate = on(&there, coordinate)?.coordinate;
            (before, now, step) = (Some(now), there, (1.5 * step).min(most));
        }
        on(&now, coordinate)
    }

    /// The end of its piece beyond which a contact is, if any: before its beginning (−1), or after
    /// its end (+1).
    fn left(&self, piece: usize, at: &Configuration) -> Option<Option<i64>> {
        let (variant, _) = self.variants[piece].as_ref()?;
        let (cam, pieces) = variant.cam(self.cam)?;
        let [before, after] = pieces::meeting(cam, pieces, at)?.beyond(&pieces.segments[piece]);
        Some(if before.max(after) <= ON { None } else { Some(if after > before { 1 } else { -1 }) })
    }

    /// The last pose on a piece between one on it and one beyond it, and the end that it reaches.
    fn joint(
        &self,
        piece: usize,
        mut inside: TravelPose,
        mut outside: TravelPose,
        closed: &dyn Fn(f64, &Configuration) -> Option<Configuration>,
    ) -> Option<(TravelPose, i64)> {
        let mut side = self.left(piece, &outside.configuration)??;
        loop {
            let middle = 0.5 * (inside.travel + outside.travel);
            // No double remains between.
            if middle <= inside.travel || middle >= outside.travel {
                return Some((inside, side));
            }
            let pose = TravelPose {
                travel: middle,
                configuration: closed(middle, &foretold(Some(&inside), &outside, middle))?,
            };
            match self.left(piece, &pose.configuration)? {
                Some(beyond) => (outside, side) = (pose, beyond),
                None => inside = pose,
            }
        }
    }

    /// The pose of a state, solved with the contact on the next piece.
    fn handed_over(&self, state: ContactState, side: i64) -> Option<ContactState> {
        let count = self.variants.len();
        let next =
            if side > 0 { (state.piece + 1) % count } else { (state.piece + count - 1) % count };
        let (from, _) = self.variants[state.piece].as_ref()?;
        let (to, _) = self.variants[next].as_ref()?;
        let rough = self.on_another(from, to, &state.at, [state.piece, next])?;
        let at =
            newton::moved(&to.scene, &to.mechanism, &rough, &DriverValues(state.drivers.clone()))?;
        Some(ContactState { piece: next, at, ..state })
    }

    /// Converts a pose of one variant into one of another.
    fn on_another(
        &self,
        from: &Variant,
        to: &Variant,
        at: &Configuration,
        [piece, next]: [usize; 2],
    ) -> Option<Configuration> {
        let (cam, pieces) = from.cam(self.cam)?;
        let centre = pieces::centre(&from.scene, cam, pieces, at, next);
        // A new point is the centre of the piece.
        let place = |p: PointId| match named(&to.scene, &from.scene, p) {
            Some(q) => at.points[q.0],
            None => centre.map(|c| at.poses[cam.cam.0].map_or(c, |pose| pose.to_world(c))),
        };
        let points = (0..to.scene.points.len()).map(|p| place(PointId(p))).collect();
        let mut shapes = at.shapes.clone();
        for (l, shape) in shapes.points.iter_mut().enumerate() {
            let local = |p: PointId| match named(&to.scene, &from.scene, p) {
                Some(q) => at.shapes.local(LinkId(l), q),
                None => centre,
            };
            *shape =
                to.scene.links[l].points.iter().filter_map(|p| Some((*p, local(*p)?))).collect();
        }
        let contact = cam.contact?;
        shapes.guides[contact.0] =
            Some(pieces::path_on(&from.scene, cam, pieces, at, [piece, next])?);
        let closures = vec![0; to.mechanism.groups.len()];
        Some(Configuration { points, shapes, closures, ..at.clone() })
    }
}

/// A led follower: the configuration, the scene of the piece in contact with its drivers at their
/// rates, and the follower's rates.
struct Following<'a> {
    standing: ContactState,
    variant: &'a Variant,
    hangs: Hangs,
    scene: Scene,
    rates: [f64; 2],
}

impl Handed {
    fn following(&self, drivers: &[[f64; 3]]) -> Option<Following<'_>> {
        let gone: Vec<f64> =
            drivers.iter().zip(&self.positions).map(|([at, ..], from)| at - from).collect();
        if !gone.iter().all(|by| by.is_finite()) {
            return None;
        }
        let standing = self.stands(&gone)?;
        let (variant, hangs) = self.variants[standing.piece].as_ref()?;
        let mut scene = variant.scene.clone();
        for (driver, [_, rate, acceleration]) in scene.drivers.iter_mut().zip(drivers) {
            driver.rate.value = *rate;
            let span = driver.rate.span;
            driver.acceleration = Some(GivenQuantity {
                value: *acceleration,
                radius: 0.0,
                text: String::new(),
                span,
            });
        }
        let motion =
            analytic::solve(&scene, &variant.mechanism, &standing.at, &all_of(&variant.mechanism))
                .ok()?;
        let rates = hangs.rates(&scene, &standing.at, &motion)?;
        Some(Following { standing, variant, hangs: *hangs, scene, rates })
    }
}

impl FollowerSolver for Handed {
    fn led(&self, drivers: &[[f64; 3]]) -> Option<FollowerState> {
        let Following { standing, rates: [rate, acceleration], .. } = self.following(drivers)?;
        Some(FollowerState {
            place: [standing.coordinate, rate, acceleration],
            piece: standing.piece,
        })
    }

    fn off(&self, drivers: &[[f64; 3]]) -> Option<[f64; 3]> {
        let Following { standing, variant, hangs, mut scene, rates } = self.following(drivers)?;
        for (d, [at, ..]) in
            drivers.iter().enumerate().filter(|(d, [at, ..])| *at != self.positions[*d])
        {
            scene = with_driver_at(&scene, d, *at);
        }
        let demand = all_of(&variant.mechanism);
        let at =
            position::recompute::<Ball<f64>>(&scene, &variant.mechanism, &demand, &standing.at)
                .ok()?;
        let [rate, acceleration] =
            hangs.rates(&scene, &at, &motion::solve(&scene, &variant.mechanism, &at, &demand))?;
        let beside = |x: Ball<f64>, told: f64| x - Ball::from_f64(told);
        let place = beside(hangs.coordinate(&scene, &at)?, standing.coordinate);
        let place = if matches!(hangs, Hangs::Turns { .. }) { in_half_turns(place) } else { place };
        Some(
            [place, beside(rate, rates[0]), beside(acceleration, rates[1])]
                .map(|x| x.approx().abs() + x.radius()),
        )
    }
}

/// The demand for all groups, up to accelerations.
fn all_of(m: &Mechanism) -> Demand {
    Demand {
        groups: vec![Some(Level::Acceleration); m.groups.len()],
        level: Level::Acceleration,
        needs: Vec::new(),
    }
}
