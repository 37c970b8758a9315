//! Answers through time: all drivers move, each by its law or at its rate.
//!
//! The mechanism is followed from its instant to both ends once ([`PoseFollower`]). Each row is
//! found from the nearest pose on that path, and answered by the loop equations. The mechanism
//! never jumps to another assembly, and no row depends on the position of others.

use super::follow::whole::event;
use super::follow::{PoseFollower, PoseSweep, TravelPose};
use super::general::General;
use super::pieces::{Gaps, StopSignal, SweepPieces};
use super::table::Table;
use super::{PlacedScene, compile::ask, pieces};
use hodograph_base::budget::here;
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::digits::{shortest, significant};
use hodograph_scene::{Lang, Swept};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::ops::Range;

/// The least number of steps over the time.
const STEPS: usize = 360;
/// The greatest number of steps, of 10° of the fastest driver, that are followed.
const MOST_STEPS: usize = 36_000;
/// The number of rows that take a moment.
const AT_ONCE: usize = 4096;

/// A mechanism followed through time.
pub struct TimedSweep<'a> {
    placed: &'a PlacedScene<'a>,
    follower: PoseFollower<'a>,
    sweep: PoseSweep,
    /// The instant (s).
    now: f64,
}

impl<'a> TimedSweep<'a> {
    /// Follows a placed scene between two times (s); times that are not given are the ends of its
    /// usual range ([`PoseFollower::usual_reach`]).
    ///
    /// # Errors
    /// `range`: more turns of the drivers than are followed.
    pub fn new(
        placed: &'a PlacedScene<'a>,
        [from, to]: [Option<f64>; 2],
    ) -> Result<(TimedSweep<'a>, [f64; 2]), Faults> {
        let now = placed.scene.instant();
        let follower = PoseFollower::new(
            placed.scene,
            placed.mechanism,
            &placed.demand,
            &placed.at,
            Swept::Time,
        );
        let [before, after] = follower.usual_reach();
        let [from, to] = [from.unwrap_or(now - before), to.unwrap_or(now + after)];
        let reach = [now - from.min(to), from.max(to) - now].map(|way| way.max(0.0));
        if !(reach[0] + reach[1]).is_finite() || follower.steps(reach) > MOST_STEPS {
            let message = both!(
                "from {from} s to {to} s the drivers turn more than {} times",
                MOST_STEPS / 36
            );
            return Err(Diagnostic::error("range", message)
                .help(both!("take a shorter time"))
                .into());
        }
        let sweep = follower.through(reach, STEPS);
        Ok((TimedSweep { placed, follower, sweep, now }, [from, to]))
    }

    /// Returns equal steps from one time (s) to another.
    pub fn steps(&'a self, [from, to]: [f64; 2], steps: usize) -> TimedRows<'a> {
        let at =
            |i: usize| if i == steps { to } else { from + (to - from) * (i as f64 / steps as f64) };
        TimedRows {
            timed: self,
            times: (0..=steps).map(at).collect(),
            gaps: Gaps::of(self.placed.scene),
        }
    }

    /// Returns the answers at given times (s).
    pub fn table(&self, times: Vec<f64>) -> Table {
        pieces::gather(&mut TimedRows { timed: self, times, gaps: Gaps::of(self.placed.scene) })
    }

    /// The reason why the motion ends at a travel, the last one reached.
    fn stopped(&self, travel: f64) -> Faults {
        let (scene, mechanism, at) =
            (self.placed.scene, self.placed.mechanism, significant(self.now + travel, 6));
        let pose = self.sweep.poses.iter().find(|p| p.travel == travel);
        let message = match pose.map(|pose| {
            (self.sweep.far(pose), event(mechanism, travel, &pose.configuration).toggle)
        }) {
            Some((true, _)) => both!("beyond t = {at} s a joint leaves the paper"),
            Some((false, Some(toggle))) => {
                let held =
                    Both { en: toggle.words(scene, Lang::En), zh: toggle.words(scene, Lang::Zh) };
                both!("the drivers go no farther than t = {at} s: there {}", held)
            }
            Some((false, None)) | None => {
                both!("the mechanism cannot be followed beyond t = {at} s")
            }
        };
        Diagnostic::error("limit", message).into()
    }

    fn row(&self, time: f64) -> Result<Vec<f64>, Faults> {
        let travel = time - self.now;
        let far = |p: &TravelPose| (p.travel - travel).abs();
        let near = self.sweep.poses.iter().min_by(|a, b| far(a).total_cmp(&far(b)));
        let beyond = |limit: f64| self.stopped(limit);
        let [low, high] = self.sweep.limits;
        if let Some(limit) = low.filter(|low| travel < *low).or(high.filter(|high| travel > *high))
        {
            return Err(beyond(limit));
        }
        let at = match near {
            Some(near) if near.travel == travel => near.configuration.clone(),
            Some(near) => {
                self.follower.at(&near.configuration, travel).ok_or_else(|| beyond(near.travel))?
            }
            None => return Err(beyond(0.0)),
        };
        let there = self.follower.scene_at(self.placed.scene, travel);
        let mut ways = General::new(self.placed, 0).answers(&there, &at)?;
        Ok(ways.swap_remove(0))
    }
}

/// Rows at given times.
pub struct TimedRows<'a> {
    timed: &'a TimedSweep<'a>,
    times: Vec<f64>,
    gaps: Gaps,
}

impl SweepPieces for TimedRows<'_> {
    fn columns(&self) -> Vec<(String, &'static str)> {
        let scene = self.timed.placed.scene;
        let (name, kind) = Swept::Time.name(scene);
        std::iter::once((name, kind.si())).chain(scene.find.iter().flat_map(ask::names)).collect()
    }

    fn count(&self) -> usize {
        self.times.len()
    }

    fn at_once(&self) -> usize {
        AT_ONCE
    }

    fn piece(
        &mut self,
        rows: Range<usize>,
        _used: Vec<Vec<f64>>,
        stop: StopSignal,
    ) -> Option<Vec<Vec<f64>>> {
        let (first, width) = (rows.start, self.columns().len());
        let here = here();
        let row = |i: usize| (!stop()).then(|| here.enter(|| self.timed.row(self.times[i])));
        let made: Option<Vec<_>> = rows.into_par_iter().map(row).collect();
        let mut columns = vec![Vec::new(); width];
        let mut missing = BTreeMap::new();
        for (i, row) in made?.into_iter().enumerate() {
            match row {
                Ok(row) => {
                    self.gaps.see(first + i, |column| row[column]);
                    columns
                        .iter_mut()
                        .zip(std::iter::once(self.times[first + i]).chain(row))
                        .for_each(|(c, v)| c.push(v));
                }
                Err(why) => drop(missing.insert(i, why)),
            }
        }
        self.gaps.add(&missing, first);
        Some(columns)
    }

    fn notes(&self) -> Vec<Diagnostic> {
        self.gaps.notes(&|k| format!("t = {} s", shortest(self.times[k])))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hodograph_mechanism::mechanism::Mechanism;
    use hodograph_scene::{read, templates};

    /// A table through time holds the answers of the scene at each instant.
    #[test]
    fn each_row_is_the_scene_at_its_instant() {
        for name in ["plate-by-law", "cart-by-law"] {
            let scene = read(templates::get(name).unwrap()).unwrap().value;
            let mechanism = Mechanism::new(&scene).unwrap().value;
            let placed = PlacedScene::new(&scene, &mechanism).unwrap();
            let (timed, range) = TimedSweep::new(&placed, [None, None]).unwrap();
            assert_eq!(range, [0.0, 2.0 * scene.instant()]);
            let table = pieces::gather(&mut timed.steps(range, 4));
            assert_eq!((table.rows(), table.notes.len()), (5, 0), "{name}");
            for row in 1..5 {
                let t = table.columns[0].values[row];
                let there =
                    read(templates::instantiate(name, &[("t", &format!("{t} s"))]).unwrap())
                        .unwrap()
                        .value;
                let placed = PlacedScene::new(&there, &mechanism).unwrap();
                let meant =
                    General::new(&placed, 0).answers(&there, &placed.at).unwrap().swap_remove(0);
                for (column, meant) in table.columns[1..].iter().zip(meant) {
                    let off = (column.values[row] - meant).abs();
                    assert!(
                        off < 1e-12,
                        "{name}, {} at t = {t} s: {} against {meant}",
                        column.name,
                        column.values[row]
                    );
                }
            }
        }
    }

    /// For drivers without laws the rows are those of the scene advanced by its rates: speeds are
    /// the differences of positions.
    #[test]
    fn several_drivers_go_on_together() {
        let mut scene = read(templates::get("five-bar").unwrap()).unwrap().value;
        scene.find =
            hodograph_scene::read_asking(templates::get("five-bar").unwrap(), "x_C,y_C,v_C")
                .unwrap()
                .value
                .find;
        let mechanism = Mechanism::new(&scene).unwrap().value;
        let placed = PlacedScene::new(&scene, &mechanism).unwrap();
        let h = 1e-6;
        let (timed, _) = TimedSweep::new(&placed, [Some(0.0), Some(0.02)]).unwrap();
        let table = timed.table(vec![0.01 - h, 0.01, 0.01 + h]);
        let column = |name: &str| &table.column(name).unwrap_or_else(|| panic!("{name}")).values;
        for axis in ["x", "y"] {
            let place = column(&format!("{axis}_C"));
            let meant = (place[2] - place[0]) / (2.0 * h);
            let told = column(&format!("v_C.{axis}"))[1];
            assert!((told - meant).abs() < 1e-7, "{axis}: {told} against {meant}");
        }
    }

    /// One driver at a constant rate: through time the rows are those of a sweep of the driver, for
    /// every kind of mechanism.
    #[test]
    fn through_time_one_driver_does_what_its_sweep_tells() {
        let mut compared = 0;
        for t in templates::list() {
            let mut scene = read(templates::get(t.name).unwrap()).unwrap().value.over_a_turn();
            if scene.own_drivers() != 1
                || scene.has_laws_of_time()
                || scene.drivers[0].rate.value == 0.0
            {
                continue;
            }
            scene.drivers[0].acceleration = None;
            let mechanism = Mechanism::new(&scene).unwrap().value;
            let placed = PlacedScene::new(&scene, &mechanism).unwrap();
            let (timed, [_, whole]) = TimedSweep::new(&placed, [None, None])
                .unwrap_or_else(|f| panic!("{}: {f}", t.name));
            let times: Vec<f64> = (0..=7).map(|k| 0.97 * whole * f64::from(k) / 7.0).collect();
            let now = crate::station::position_now(&scene, &placed.at, 0);
            let values =
                times.iter().map(|time| now + scene.drivers[0].rate.value * time).collect();
            let (told, meant) = (timed.table(times), crate::of_values(&placed, 0, values).unwrap());
            // A crank can be assembled beyond a limit, but time does not lead there.
            assert!(
                told.rows() == meant.rows() || 0 < told.rows() && !told.notes.is_empty(),
                "{}: {:?} {:?}",
                t.name,
                told.notes,
                meant.notes
            );
            let place = |k: usize| now + scene.drivers[0].rate.value * told.columns[0].values[k];
            assert!(
                (0..told.rows()).all(|k| (meant.columns[0].values[k] - place(k)).abs() < 1e-9),
                "{}",
                t.name
            );
            for (a, b) in told.columns[1..].iter().zip(&meant.columns[1..]) {
                let alike =
                    meant.columns[1..].iter().filter(|c| c.unit == b.unit).flat_map(|c| &c.values);
                // Where all answers of a kind vanish, only rounding of the driver's own size
                // remains.
                let most = alike
                    .fold(0.1 * scene.drivers[0].rate.value.powi(2), |m: f64, v| m.max(v.abs()));
                for (k, (a, v)) in a.values.iter().zip(&b.values).enumerate() {
                    assert!(
                        (a - v).abs() <= 1e-7 * most,
                        "{}, {} in row {k}: {a} against {v}",
                        t.name,
                        b.name
                    );
                    compared += 1;
                }
            }
        }
        assert!(compared > 1000, "{compared}");
    }

    #[test]
    fn a_time_of_too_many_turns_is_refused() {
        let scene = read(templates::get("five-bar").unwrap()).unwrap().value;
        let mechanism = Mechanism::new(&scene).unwrap().value;
        let placed = PlacedScene::new(&scene, &mechanism).unwrap();
        for to in [1e9, f64::MAX, f64::INFINITY] {
            let told = TimedSweep::new(&placed, [None, Some(to)]).err().expect("too long");
            assert_eq!(told.list[0].code, "range");
        }
    }
}
