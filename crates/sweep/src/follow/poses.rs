//! All poses of a mechanism through the travel of one driver, or through time: followed from the
//! scene's pose without a jump to another assembly, to the full turn or to the limits at both ends.
//!
//! This module decides where the poses are and which of them are limits. It does not decide what is
//! drawn in them.

use super::clock::SweptVariable;
use super::step::{SLIGHT, TravelPose, foretold, is_followed, stray};
use hodograph_base::budget::here;
use std::borrow::Cow;
use std::f64::consts::TAU;

use hodograph_base::diag::{Diagnostic, Faults, both};
use hodograph_base::digits::significant;
use hodograph_mechanism::mechanism::{Demand, Mechanism};
use hodograph_mechanism::position::{self, Configuration, newton};
use hodograph_mechanism::stated::{self, Moment};
use hodograph_scene::{GivenQuantity, LinkId, Scene, Swept};
use hodograph_scene::{driver_position, with_driver_at};

use crate::extreme::turns_seen;
use crate::station::position_now;
use crate::train::AngleTrain;

/// The poses of a driver's travel, or of a time.
#[derive(Clone, Debug)]
pub struct PoseSweep {
    /// The poses in the order of growing travel; the scene's own pose has the travel 0.
    pub poses: Vec<TravelPose>,
    /// True if the mechanism returns to its first pose after a full turn, or after
    /// [`PoseSweep::turns`].
    pub full: bool,
    /// The travel at which the mechanism can go no farther back, and no farther on; the pose there
    /// is the first or the last one.
    pub limits: [Option<f64>; 2],
    /// The turns of a turning driver that are followed: those after which the pose recurs (one
    /// without rolling links), or one if these are too many.
    pub turns: u64,
}

impl PoseSweep {
    /// Returns the travel after which a full motion recurs (rad).
    pub fn period(&self) -> f64 {
        TAU * self.turns as f64
    }

    /// Returns true if nothing stops the motion; no vector then grows beyond all bounds.
    pub fn is_unlimited(&self) -> bool {
        self.limits == [None, None]
    }

    /// Returns true if the driver can go no farther than a pose.
    pub fn is_limit(&self, k: usize) -> bool {
        k == 0 && self.limits[0].is_some() || k + 1 == self.poses.len() && self.limits[1].is_some()
    }

    /// Returns the travel from a pose to its neighbour.
    pub fn step(&self, k: usize) -> f64 {
        let neighbour = if k > 0 { self.poses.get(k - 1) } else { self.poses.get(1) };
        neighbour.map_or(0.0, |n| (n.travel - self.poses[k].travel).abs())
    }

    /// Returns true if a pose is an end because a joint leaves the paper there.
    pub fn far(&self, pose: &TravelPose) -> bool {
        let Some(base) = self.poses.iter().find(|p| p.travel == 0.0) else { return false };
        stray(&pose.configuration, &base.configuration) > FAR * 0.999 * base.configuration.extent()
    }
}

/// The number of halvings of a step after which the motion is taken to end: 5° become 0.0003°.
const HALVINGS: usize = 14;
/// The freedom of a joint close to the end of a motion: as a part of its way in the step before, and
/// in sizes of the mechanism if there was none.
const FREE: f64 = 8.0;
const BROAD: f64 = 0.3;
/// The distance of a joint from its place, in sizes of the mechanism, above which it is off the
/// paper: the crossing of two lines that become parallel goes beyond all bounds.
const FAR: f64 = 3.0;
/// The greatest number of partial steps in a walk, for each of its steps: a mechanism that needs
/// more has no motion to show.
const PARTS: usize = 20;
/// The fewest steps between two limits.
const STEPS_LEAST: usize = 48;

/// Follows a mechanism along one driver's travel, with the other drivers held, or through time.
pub struct PoseFollower<'a> {
    /// The scene with rates such that the drivers reach a pose after unit time: one driver moves,
    /// or all do.
    scene: Scene,
    mechanism: &'a Mechanism,
    demand: &'a Demand,
    base: &'a Configuration,
    course: SweptVariable,
    back: bool,
}

impl<'a> PoseFollower<'a> {
    /// Returns true if the driver moves toward smaller positions in the scene.
    pub fn goes_back(&self) -> bool {
        self.back
    }

    /// Prepares to follow the scene from its own pose; `swept` is the moving quantity.
    pub fn new(
        scene: &Scene,
        mechanism: &'a Mechanism,
        demand: &'a Demand,
        base: &'a Configuration,
        swept: impl Into<Swept>,
    ) -> PoseFollower<'a> {
        let swept = swept.into();
        let course = SweptVariable::of(scene, base, swept);
        let back = matches!(swept, Swept::Driver(d) if scene.drivers[d].rate.value < 0.0);
        let mut scene = scene.clone();
        // Only the driver moves, at unit rate, so that the time is its travel.
        for d in 0..scene.drivers.len() {
            set_rate(&mut scene, d, if swept == Swept::Driver(d) { 1.0 } else { 0.0 });
        }
        PoseFollower { scene, mechanism, demand, base, course, back }
    }

    /// The position of a driver in the scene's own pose (rad or m).
    fn start(&self, driver: usize) -> f64 {
        driver_position(&self.scene, driver)
            .unwrap_or_else(|| position_now(&self.scene, self.base, driver))
    }

    /// Returns a scene of the same drivers at a travel, as far as the scene gives their positions.
    /// With one driver in motion all rates are unchanged; through time they are those of the time.
    pub fn scene_at(&self, scene: &Scene, travel: f64) -> Scene {
        match &self.course {
            SweptVariable::Driver(d) => with_driver_at(scene, *d, self.start(*d) + travel),
            SweptVariable::Time(clock) => clock.scene_at(scene, travel),
        }
    }

    /// True if a turning driver moves.
    fn turns(&self) -> bool {
        matches!(self.course, SweptVariable::Driver(d) if self.scene.drivers[d].kind.turns())
    }

    /// Returns the range of the motion shown before and after the scene's pose (rad, m or s): the
    /// turns of a driver after which the pose recurs; twice the mechanism's size; the time of
    /// [`Clock::reach`](super::clock::Clock::reach).
    pub fn reach(&self) -> [f64; 2] {
        let extent = self.base.extent();
        match &self.course {
            SweptVariable::Driver(_) if self.turns() => {
                [TAU * turns_seen(self.returns()) as f64; 2]
            }
            SweptVariable::Driver(_) => [2.0 * extent; 2],
            SweptVariable::Time(clock) => clock.reach(extent),
        }
    }

    /// Returns the usual range of the motion: that of [`PoseFollower::reach`], but through time
    /// without a bound of the drivers' turns
    /// ([`Clock::usual_reach`](super::clock::Clock::usual_reach)).
    pub fn usual_reach(&self) -> [f64; 2] {
        match &self.course {
            SweptVariable::Driver(_) => self.reach(),
            SweptVariable::Time(clock) => clock.usual_reach(self.base.extent()),
        }
    }

    /// Returns a note if [`PoseFollower::reach`] is less than the usual range.
    pub fn shortened(&self) -> Option<Diagnostic> {
        let [before, after] = self.reach();
        if self.usual_reach() == [before, after] {
            return None;
        }
        let now = self.scene.instant();
        let [from, to] = [now - before, now + after].map(|t| significant(t, 4));
        let note = Diagnostic::note(
            "three-turns",
            both!(
                "the motion is shown from t = {from} s to {to} s: there a driver has made three turns"
            ),
        );
        Some(note.help(both!(
            "for other times give another instant, or `sweep --over t` with --from and --to"
        )))
    }

    /// Returns the least number of steps through time in which no driver turns by much.
    pub fn steps(&self, reach: [f64; 2]) -> usize {
        match &self.course {
            SweptVariable::Driver(_) => 1,
            SweptVariable::Time(clock) => clock.steps(reach),
        }
    }

    /// Returns all poses, in at least `count` steps of a turn or of the whole range.
    pub fn sweep(&self, count: usize) -> PoseSweep {
        self.through(self.reach(), count)
    }

    /// Returns all poses of a given range before and after the scene's pose.
    pub fn through(&self, [before, after]: [f64; 2], count: usize) -> PoseSweep {
        let turns = self.turns();
        let returns = if turns { self.returns() } else { 1 };
        let seen = turns_seen(returns);
        let step = match &self.course {
            SweptVariable::Driver(_) => after / (seen as f64 * count as f64),
            SweptVariable::Time(_) => {
                (before + after) / count.max(self.steps([before, after])) as f64
            }
        };
        let start = TravelPose { travel: 0.0, configuration: self.base.clone() };
        if step == 0.0 {
            return PoseSweep { poses: vec![start], full: false, limits: [None, None], turns: 1 };
        }
        let (mut up, high) = self.walk(step, after, None);
        let back = |p: &TravelPose| {
            self.stray(&p.configuration, self.base) < 1e-6 && self.rolled_back(&p.configuration)
        };
        if turns && high.is_none() && up.last().is_some_and(back) {
            up.pop();
            up.insert(0, start);
            return PoseSweep { poses: up, full: true, limits: [None, None], turns: seen };
        }
        if high.is_none() && returns != seen {
            // One turn of many.
            up.insert(0, start);
            return PoseSweep { poses: up, full: false, limits: [None, None], turns: seen };
        }
        let (mut down, low) = self.walk(-step, before, None);
        let range = up.last().map_or(0.0, |p| p.travel) - down.last().map_or(0.0, |p| p.travel);
        if (low.is_some() || high.is_some()) && range > 0.0 && range < step * STEPS_LEAST as f64 {
            let fine = range / STEPS_LEAST as f64;
            // The ends are known: halving for them anew would be most of the work.
            let ends = [up.pop().filter(|_| high.is_some()), down.pop().filter(|_| low.is_some())];
            let [top, bottom] = ends;
            let here = here();
            let walk = |step: f64, from, end| here.enter(|| self.walk(step, from, end).0);
            (up, down) = rayon::join(|| walk(fine, after, top), || walk(-fine, before, bottom));
        }
        let mut poses: Vec<TravelPose> = down.into_iter().rev().collect();
        poses.push(start);
        poses.extend(up);
        PoseSweep { poses, full: false, limits: [low, high], turns: seen }
    }

    /// Checks that positions of this motion satisfy the statements of the scene.
    ///
    /// # Errors
    /// `position-unproven`, those of the first position that breaks a statement.
    pub fn proved<'c>(
        &self,
        positions: impl IntoIterator<Item = &'c Configuration>,
    ) -> Result<(), Faults> {
        positions.into_iter().try_for_each(|at| {
            stated::proved(&self.scene, self.mechanism, at, Moment::Later(self.base))
        })
    }

    /// Returns the number of turns of the driver after which the pose recurs; 0 if it never does.
    pub fn returns(&self) -> u64 {
        AngleTrain::of(&self.scene, self.mechanism, self.base).turns()
    }

    /// True if all rolling links have the directions of the instant.
    fn rolled_back(&self, at: &Configuration) -> bool {
        let axis = |c: &Configuration, l: LinkId| c.poses[l.0].map(|p| p.axis);
        let links = self.scene.rolling.iter().flat_map(|r| r.links);
        links
            .filter_map(|l| Some((axis(at, l)? - axis(self.base, l)?).norm()))
            .all(|off| off < 1e-6)
    }

    /// Poses from the scene's own on, in steps, as far as `reach`. If the motion ends before, the
    /// last pose is its end, which may be known.
    fn walk(
        &self,
        step: f64,
        reach: f64,
        known: Option<TravelPose>,
    ) -> (Vec<TravelPose>, Option<f64>) {
        let reach = known.as_ref().map_or(reach, |end| end.travel.abs());
        let count = (((reach / step.abs()) * (1.0 - 1e-9)).ceil() as usize)
            .max(usize::from(known.is_some()));
        let start = TravelPose { travel: 0.0, configuration: self.base.clone() };
        let (mut before, mut now) = (None, start);
        let mut poses = Vec::new();
        let mut left = PARTS * count;
        for k in 1..=count {
            let target = if k == count { reach.copysign(step) } else { step * k as f64 };
            if let Some(end) = known.as_ref().filter(|end| end.travel.abs() <= target.abs()) {
                poses.push(end.clone());
                return (poses, Some(end.travel));
            }
            while now.travel != target {
                left = left.saturating_sub(1);
                let end = match self.next(before.as_ref(), &now, target) {
                    Ok(next) if left > 0 => {
                        before = Some(std::mem::replace(&mut now, next));
                        continue;
                    }
                    Ok(_) => now,
                    Err(beyond) => self.end(before.as_ref(), now, beyond),
                };
                let limit = end.travel;
                poses.push(end);
                return (poses, Some(limit));
            }
            poses.push(now.clone());
        }
        (poses, None)
    }

    /// The next pose on the way to a travel: there, or at a part of the way where the motion bends.
    ///
    /// # Errors
    /// The nearest travel that has no pose close to the one it has now, if the motion ends.
    fn next(
        &self,
        before: Option<&TravelPose>,
        now: &TravelPose,
        target: f64,
    ) -> Result<TravelPose, f64> {
        let extent = self.base.extent().max(f64::MIN_POSITIVE);
        let half = |travel: f64| now.travel + (travel - now.travel) / 2.0;
        let (mut travel, mut beyond) = (target, target);
        let mut halvings = 0;
        // After a short last part of the way, the next will hardly be much longer.
        let last = before.map_or(f64::INFINITY, |b| (now.travel - b.travel).abs());
        while halvings < HALVINGS / 2 && (travel - now.travel).abs() > 2.0 * last {
            (travel, halvings) = (half(travel), halvings + 1);
        }
        while halvings < HALVINGS {
            let guess = foretold(before, now, travel);
            let half_way = |mean: &Configuration| self.at(mean, half(travel));
            if let Some(configuration) = self.at(&guess, travel)
                && is_followed([&now.configuration, &guess, &configuration], extent, half_way)
            {
                return Ok(TravelPose { travel, configuration });
            }
            (beyond, travel, halvings) = (travel, half(travel), halvings + 1);
        }
        Err(beyond)
    }

    /// The last pose before the motion ends, found by halving between a pose and the nearest travel
    /// that [`PoseFollower::next`] refuses. Farther beyond an end there may be other assemblies.
    fn end(&self, before: Option<&TravelPose>, now: TravelPose, mut outside: f64) -> TravelPose {
        let moved = |from: &TravelPose, to: &Configuration| self.stray(&from.configuration, to);
        let free = |moved: f64| (FREE * moved).clamp(SLIGHT, BROAD);
        let mut most = before.map_or(BROAD, |b| free(moved(b, &now.configuration)));
        let mut inside = now;
        loop {
            let middle = 0.5 * (inside.travel + outside);
            // No double remains between.
            if middle == inside.travel || middle == outside {
                return inside;
            }
            // Close to its limit a mechanism moves as the root of the distance: the pose is not
            // extrapolated, and nearness is judged broadly. The parts of the way become shorter,
            // and a joint moves little more in one than in the part before it.
            match self.at(&inside.configuration, middle).filter(|c| moved(&inside, c) < most) {
                Some(configuration) => {
                    most = free(moved(&inside, &configuration));
                    inside = TravelPose { travel: middle, configuration };
                }
                None => outside = middle,
            }
        }
    }

    /// Returns the pose at a travel that is nearest to a guess; `None` if the mechanism does not
    /// close, or leaves the paper.
    pub fn at(&self, guess: &Configuration, travel: f64) -> Option<Configuration> {
        self.closed(guess, travel).filter(|c| self.stray(c, self.base) < FAR)
    }

    fn closed(&self, guess: &Configuration, travel: f64) -> Option<Configuration> {
        // Closed forms are exact; other groups must be found from the guess.
        if self.mechanism.groups.iter().any(|g| g.class().is_some_and(|class| class != "II")) {
            return self.by_newton(guess, travel);
        }
        let gone = self.gone(travel)?;
        let (scene, time) = self.later(&gone, travel);
        if scene.lost_follower().is_some() {
            return None;
        }
        let later = |meant: &Configuration| {
            position::later_apart(&scene, self.mechanism, self.demand, meant, self.base, time)
        };
        let (mut best, mut apart) = match later(guess) {
            Ok(found) => found,
            Err(faults) if faults.list.iter().any(|d| d.code == "pose-given") => {
                return self.by_newton(guess, travel);
            }
            Err(_) => return None,
        };
        // At a change point the closed forms of two motions change places. Elsewhere a pin of the
        // group is farther from its guess in the other one than any joint is in this one.
        let mut off = self.stray(&best, guess);
        let extent = self.base.extent();
        let mut meant = guess.clone();
        for g in 0..meant.closures.len() {
            if apart.get(g).is_some_and(|apart| *apart > 2.000_001 * off * extent) {
                continue;
            }
            let kept = meant.closures[g];
            meant.closures[g] = 1 - kept.min(1);
            match later(&meant).ok().filter(|(other, _)| self.stray(other, guess) < off) {
                Some(other) => {
                    (best, apart) = other;
                    off = self.stray(&best, guess);
                }
                None => meant.closures[g] = kept,
            }
        }
        Some(best)
    }

    /// The travel of each driver at a travel of the motion; `None` where a law of time has no
    /// value.
    fn gone(&self, travel: f64) -> Option<Vec<f64>> {
        match &self.course {
            SweptVariable::Driver(d) => Some(
                (0..self.scene.drivers.len()).map(|k| if k == *d { travel } else { 0.0 }).collect(),
            ),
            SweptVariable::Time(clock) => Some(clock.gone(travel)?.iter().map(|g| g.by).collect()),
        }
    }

    /// The scene with drivers at constant rates, and the time after which they have the travels
    /// `gone`. The followers of its cams have their positions of that time, and are at rest.
    fn later(&self, gone: &[f64], travel: f64) -> (Cow<'_, Scene>, f64) {
        let mut scene = self.with_followers(gone);
        if let SweptVariable::Driver(_) = self.course {
            return (scene, travel);
        }
        let owned = scene.to_mut();
        for (d, by) in gone.iter().enumerate().filter(|(d, _)| !self.scene.is_led(*d)) {
            set_rate(owned, d, *by);
        }
        (scene, 1.0)
    }

    /// The scene with the followers of its cams where the drivers' travels hold them, at rest.
    fn with_followers(&self, gone: &[f64]) -> Cow<'_, Scene> {
        let mut scene = Cow::Borrowed(&self.scene);
        for (d, by) in gone.iter().enumerate().filter(|(d, _)| self.scene.has_laws(*d)) {
            let scene = scene.to_mut();
            let rate = std::mem::replace(&mut scene.drivers[d].rate.value, 0.0);
            scene.set_followers(d, Some(self.start(d) + by));
            scene.drivers[d].rate.value = rate;
        }
        if (0..self.scene.drivers.len()).any(|d| self.scene.is_on_a_course(d)) {
            let scene = scene.to_mut();
            scene.set_courses(&|d| Some(self.start(d) + gone[d]));
            (0..self.scene.drivers.len())
                .filter(|d| self.scene.is_on_a_course(*d))
                .for_each(|d| set_rate(scene, d, 0.0));
        }
        scene
    }

    fn by_newton(&self, guess: &Configuration, travel: f64) -> Option<Configuration> {
        let mut values = newton::driver_values(&self.scene, self.base);
        let gone = self.gone(travel)?;
        let own = gone.iter().enumerate().filter(|(d, _)| !self.scene.is_led(*d));
        own.for_each(|(d, by)| values.0[d] += by);
        let scene = self.with_followers(&gone);
        if scene.lost_follower().is_some() {
            return None;
        }
        for k in (0..scene.drivers.len()).filter(|k| scene.is_led(*k)) {
            let place = |s: &Scene| driver_position(s, k);
            values.0[k] +=
                place(&scene).zip(place(&self.scene)).map_or(0.0, |(there, here)| there - here);
        }
        newton::moved(&self.scene, self.mechanism, guess, &values)
    }

    /// The largest distance of a joint in two poses, as a part of the mechanism's size.
    fn stray(&self, a: &Configuration, b: &Configuration) -> f64 {
        stray(a, b) / self.base.extent().max(f64::MIN_POSITIVE)
    }
}

/// Returns the approximate configuration of a pose between two others.
pub fn between(one: &TravelPose, other: &TravelPose, travel: f64) -> Configuration {
    foretold(Some(one), other, travel)
}

/// Gives a driver a constant rate (SI).
fn set_rate(scene: &mut Scene, driver: usize, rate: f64) {
    let of = &mut scene.drivers[driver];
    of.rate =
        GivenQuantity { value: rate, radius: 0.0, text: format!("{rate:?}"), span: of.rate.span };
    of.acceleration = None;
}
