//! Answers questions without a kernel in a mechanism whose positions have a program: the program
//! gives the configuration at each station, and the loop equations answer there.
//!
//! These rows are therefore on the same branches as those of all other questions, whatever events
//! precede them.

use super::chunks::{SweepRows, run_parts};
use super::compile::{self, ask};
use super::general::General;
use super::lane::Width;
use super::pieces::StopSignal;
use super::program::SweepProgram;
use super::station::Stations;
use super::{PlacedScene, branches};
use hodograph_base::budget::here;
use hodograph_base::diag::Faults;
use hodograph_base::geom::{Point, Vec2};
use hodograph_mechanism::position::{self, Configuration, Pose};
use hodograph_scene::{LinkId, PointId};
use rayon::prelude::*;

/// The positions of a mechanism, compiled.
pub(super) struct Stood {
    /// The program of the positions.
    pub program: SweepProgram,
    points: Vec<PointId>,
    links: Vec<LinkId>,
}

impl Stood {
    /// Compiles the positions of a placed mechanism moved by a driver; `None` if a group has no
    /// kernel, or is followed.
    pub fn of(placed: &PlacedScene, driver: usize) -> Option<Stood> {
        Stood::even_followed(placed, driver).filter(|s| s.program.tracks.is_empty())
    }

    /// Compiles as [`Stood::of`] does, but includes groups that are followed.
    pub fn even_followed(placed: &PlacedScene, driver: usize) -> Option<Stood> {
        let (scene, m, at) = (placed.scene, placed.mechanism, &placed.at);
        let points: Vec<PointId> = (0..scene.points.len())
            .map(PointId)
            .filter(|p| at.points[p.0].is_some() && m.pins.contains(p))
            .collect();
        let moves = |l: &LinkId| at.poses[l.0].is_some() && *l != scene.ground && !m.is_passive(*l);
        let links: Vec<LinkId> = (0..scene.links.len()).map(LinkId).filter(moves).collect();
        let program = compile::places(scene, m, at, driver, &points, &links).ok()?;
        Some(Stood { program, points, links })
    }

    /// The rows of stations, by the program of each stretch between change points; `None` if `stop`
    /// asks to stop.
    pub fn rows(
        &self,
        parts: &[(SweepProgram, Vec<usize>)],
        general: &General,
        stations: &Stations,
        stop: StopSignal,
    ) -> Option<SweepRows> {
        let placed = general.placed();
        let there = run_parts(parts, placed, general.driver(), stations, Width::Widest);
        let solve = |i: usize| -> Result<Vec<f64>, Faults> {
            let mut ways =
                general.ways(stations, i, self.laid(placed, &there.columns, i).as_ref())?;
            Ok(ways.swap_remove(0))
        };
        let here = here();
        let row = |i: usize| (!stop()).then(|| here.enter(|| solve(i)));
        let made: Option<Vec<_>> = (0..stations.len()).into_par_iter().map(row).collect();
        let width = general.scene().find.iter().flat_map(ask::names).count();
        let mut rows = SweepRows {
            columns: vec![vec![f64::NAN; stations.len()]; width],
            ..Default::default()
        };
        for (i, row) in made?.into_iter().enumerate() {
            match row {
                Ok(row) => rows.columns.iter_mut().zip(row).for_each(|(c, v)| c[i] = v),
                Err(why) => drop(rows.missing.insert(i, why)),
            }
        }
        Some(rows)
    }

    /// Configurations at stations where a joint may have a change point on the way, beyond which
    /// the closures of the instant do not hold; `None` where they hold, and where the program has
    /// no value.
    pub fn beyond_change_points(
        general: &General,
        stations: &Stations,
        rows: &[usize],
    ) -> Vec<Option<Configuration>> {
        let (placed, driver) = (general.placed(), general.driver());
        let asked = !rows.is_empty() && general.is_closed_everywhere() && !general.is_read_again();
        let stood = if asked {
            Stood::of(placed, driver).filter(|s| s.program.suspects().next().is_some())
        } else {
            None
        };
        let Some(stood) = stood else { return vec![None; rows.len()] };
        let there = stations.pick(rows);
        let (parts, _) = branches(stood.program.clone(), placed, driver, &there);
        let found = run_parts(&parts, placed, driver, &there, Width::Widest);
        (0..rows.len()).map(|k| stood.laid(placed, &found.columns, k)).collect()
    }

    /// The configuration of a row; `None` where the program has no value.
    pub fn laid(
        &self,
        placed: &PlacedScene,
        columns: &[Vec<f64>],
        row: usize,
    ) -> Option<Configuration> {
        let pair = |k: usize| {
            Some(Vec2::new(columns.get(2 * k)?[row], columns.get(2 * k + 1)?[row]))
                .filter(|v| v.is_finite())
        };
        let (mut poses, mut points) =
            (vec![None; placed.scene.links.len()], vec![None; placed.scene.points.len()]);
        for (k, p) in self.points.iter().enumerate() {
            points[p.0] = Some(pair(k)?.to_point());
        }
        for (k, l) in self.links.iter().enumerate() {
            let first = self.points.len() + 2 * k;
            poses[l.0] =
                Some(Pose { origin: Point::ORIGIN + pair(first)?, axis: pair(first + 1)?.unit()? });
        }
        Some(position::laid(placed.scene, placed.mechanism, &placed.at, poses, points))
    }
}
