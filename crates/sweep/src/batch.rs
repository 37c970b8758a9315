//! Batches of mechanisms: parameters vary over a grid or at random, and each mechanism is solved at
//! one or many positions of its driver.
//!
//! Mechanisms are numbered, and the values of one depend on its number alone. Any stretch of a
//! batch can therefore be computed by itself, in any order and on any number of threads, with the
//! same bits. The memory is that of a [`Block`], not of the batch.

use super::chunks::run_on_branches;
use super::compile::{self, compile_in};
use super::general::General;
use super::pieces::{StopSignal, never};
use super::program::SweepProgram;
use super::station::{Stations, angle_per_value};
use super::vary::Variation;
use super::{PlacedScene, TravelEnds, Width, beside, without_program};
use hodograph_base::budget::here;
use hodograph_base::diag::Faults;
use hodograph_mechanism::mechanism::{Demand, Mechanism};
use hodograph_mechanism::position::{self, Configuration};
use hodograph_scene::Scene;
use hodograph_scene::eval::DimensionedValue;
use hodograph_scene::with_driver_at;
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use rayon::prelude::*;
use std::borrow::Cow;

/// The choice of the parameters' values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ParameterChoice {
    /// Every combination; the last parameter varies fastest.
    Grid,
    /// Random mechanisms, each parameter evenly distributed between its first and last value.
    Random {
        /// The number of mechanisms.
        count: u64,
        /// The seed; another seed gives other mechanisms.
        seed: u64,
    },
}

/// A batch: the mechanisms and their positions.
pub struct Batch<'a> {
    /// The scene whose parameters vary.
    pub scene: &'a Scene,
    /// Its topology, common to all mechanisms.
    pub mechanism: &'a Mechanism,
    /// The parameters.
    pub variation: Variation,
    /// The values of each parameter.
    pub values: Vec<Vec<DimensionedValue>>,
    /// The choice of values for each mechanism.
    pub choice: ParameterChoice,
    /// The driver that is swept.
    pub driver: usize,
    /// Its positions; `None` for the scene's own position.
    pub stations: Option<Stations>,
}

/// The rows of a range of mechanisms.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Block {
    /// The numbers, column after column.
    pub columns: Vec<Vec<f64>>,
    /// The number of positions that have no row because the mechanism cannot be assembled there.
    pub missing: u64,
}

/// The parts of a thread that it uses again for the next mechanism.
struct Worker {
    scene: Scene,
    program: SweepProgram,
}

impl Batch<'_> {
    /// The number of mechanisms.
    pub fn mechanisms(&self) -> u64 {
        match self.choice {
            ParameterChoice::Grid => {
                self.values.iter().map(|v| v.len() as u64).fold(1, u64::saturating_mul)
            }
            ParameterChoice::Random { count, .. } => count,
        }
    }

    /// The number of positions of each mechanism.
    pub fn positions(&self) -> usize {
        self.stations.as_ref().map_or(1, Stations::len)
    }

    /// Name and unit of each column: the mechanism's number, its parameters, the driver's position,
    /// the answers.
    pub fn columns(&self) -> Vec<(String, &'static str)> {
        let mut out = vec![("mechanism".to_owned(), "")];
        out.extend(
            self.variation
                .names()
                .zip(&self.values)
                .map(|(n, v)| (n.to_owned(), v.first().map_or("", |v| self.variation.unit(v)))),
        );
        out.push(self.scene.driver_column(self.driver));
        for f in &self.scene.find {
            out.extend(compile::ask::names(f));
        }
        out
    }

    /// The varied parameters of a mechanism.
    pub fn parameters(&self, number: u64) -> Vec<DimensionedValue> {
        match self.choice {
            ParameterChoice::Grid => {
                let mut rest = number;
                let mut out: Vec<DimensionedValue> = self
                    .values
                    .iter()
                    .rev()
                    .map(|v| {
                        let i = rest % v.len() as u64;
                        rest /= v.len() as u64;
                        v[i as usize]
                    })
                    .collect();
                out.reverse();
                out
            }
            ParameterChoice::Random { seed, .. } => {
                let mut rng = Pcg64Mcg::seed_from_u64(
                    seed.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(number),
                );
                let between = |v: &Vec<DimensionedValue>, rng: &mut Pcg64Mcg| {
                    let (a, b) = (v[0], v[v.len() - 1]);
                    // 53 random bits give evenly spread multiples of 2^-53.
                    let t = (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
                    DimensionedValue { number: a.number + (b.number - a.number) * t, ..a }
                };
                self.values.iter().map(|v| between(v, &mut rng)).collect()
            }
        }
    }

    /// The rows of the mechanisms `from..to`, in order.
    pub fn block(&self, from: u64, to: u64) -> Block {
        self.block_in(from, to, Block::default())
    }

    /// [`Batch::block`] in the memory of a block that is free to be reused: fresh memory costs as
    /// much as the numbers in it.
    pub fn block_in(&self, from: u64, to: u64, used: Block) -> Block {
        self.block_unless(from, to, used, &never).unwrap_or_default()
    }

    /// [`Batch::block_in`] that can be stopped; returns `None` if `stop` asks for it.
    pub fn block_unless(&self, from: u64, to: u64, used: Block, stop: StopSignal) -> Option<Block> {
        let (width, positions) = (self.columns().len(), self.positions().max(1));
        let mut columns = used.columns;
        columns.resize_with(width, Vec::new);
        columns.iter_mut().for_each(|c| c.resize((to - from) as usize * positions, 0.0));
        let mut parts: Vec<Vec<&mut [f64]>> =
            (from..to).map(|_| Vec::with_capacity(width)).collect();
        for column in &mut columns {
            parts.iter_mut().zip(column.chunks_mut(positions)).for_each(|(part, c)| part.push(c));
        }
        let demand = Demand::of(self.scene, self.mechanism);
        let here = here();
        let one = |worker: &mut Worker, i: usize, part| {
            here.enter(|| self.one(worker, &demand, from + i as u64, part))
        };
        let missing: Option<Vec<Vec<usize>>> = parts
            .into_par_iter()
            .enumerate()
            .map_init(
                || Worker { scene: self.scene.clone(), program: SweepProgram::default() },
                |worker, (i, part)| (!stop()).then(|| one(worker, i, part)),
            )
            .collect();
        let missing = missing?;
        let gaps: Vec<usize> = (0..)
            .step_by(positions)
            .zip(&missing)
            .flat_map(|(first, rows)| rows.iter().map(move |k| first + k))
            .collect();
        columns.par_iter_mut().for_each(|c| close(c, &gaps));
        Some(Block { columns, missing: gaps.len() as u64 })
    }

    /// Fills the columns of a mechanism; returns the rows that are missing.
    fn one(
        &self,
        Worker { scene, program }: &mut Worker,
        demand: &Demand,
        number: u64,
        mut columns: Vec<&mut [f64]>,
    ) -> Vec<usize> {
        let parameters = self.parameters(number);
        let lead = std::iter::once(number as f64).chain(parameters.iter().map(|p| p.si()));
        columns.iter_mut().zip(lead).for_each(|(column, value)| column.fill(value));
        let rows = self.variation.set(scene, &parameters).and_then(|()| {
            let answers = columns.split_off(1 + parameters.len());
            match self.variation.topology(scene)? {
                Some(own) => self.rows(scene, (&own, &Demand::of(scene, &own)), answers, program),
                None => self.rows(scene, (self.mechanism, demand), answers, program),
            }
        });
        rows.unwrap_or_else(|_| (0..self.positions()).collect())
    }

    /// The driver's positions and the answers of a mechanism; returns the rows that are missing.
    /// Its program is made in the memory of the last one.
    fn rows(
        &self,
        scene: &Scene,
        (mechanism, demand): (&Mechanism, &Demand),
        mut columns: Vec<&mut [f64]>,
        last: &mut SweepProgram,
    ) -> Result<Vec<usize>, Faults> {
        let (at, moved) = self.place(scene, mechanism, demand)?;
        let scene = moved.as_ref().unwrap_or(scene);
        let placed = PlacedScene {
            scene,
            mechanism,
            demand: demand.clone(),
            at,
            ends: TravelEnds::default(),
        };
        let per_value = angle_per_value(scene, &placed.at, self.driver);
        let here = || {
            Stations::of_values(
                vec![super::station::driver_positions(scene, &placed.at)[self.driver]],
                per_value,
            )
        };
        let stations = self.stations.as_ref().map_or_else(|| Cow::Owned(here()), Cow::Borrowed);
        let general = General::new(&placed, self.driver);
        let answers = columns.split_off(1);
        columns[0].copy_from_slice(&stations.values);
        let (driver, used) = (Some(self.driver), std::mem::take(last));
        let rows = match compile_in(scene, mechanism, &placed.at, driver, &scene.find, used) {
            Ok(program) => {
                let (mut rows, _) = run_on_branches(
                    &program,
                    &placed,
                    self.driver,
                    &stations,
                    Width::Widest,
                    answers,
                );
                rows.complete(&general, &stations, &never, &|row| {
                    beside(&program, &placed, self.driver, stations.values[row])
                });
                *last = program;
                rows
            }
            Err(why) => without_program(&general, &stations, &why).0.copied_to(answers),
        };
        Ok(rows.missing.into_keys().collect())
    }

    /// The configuration at the instant. If the mechanism cannot be assembled there, the driver is
    /// moved to the first of a dozen evenly chosen stations where it can be, and the changed scene
    /// is returned too.
    fn place(
        &self,
        scene: &Scene,
        mechanism: &Mechanism,
        demand: &Demand,
    ) -> Result<(Configuration, Option<Scene>), Faults> {
        let first = position::configure(scene, mechanism, demand);
        let (Err(why), Some(stations)) = (&first, &self.stations) else {
            return first.map(|p| (p.value, None));
        };
        // A dozen stations over the range: a mechanism that closes only in a smaller part of it is
        // of no use.
        let step = stations.len().div_ceil(12).max(1);
        for value in stations.values.iter().step_by(step) {
            let there = with_driver_at(scene, self.driver, *value);
            if let Ok(placed) = position::configure(&there, mechanism, demand) {
                return Ok((placed.value, Some(there)));
            }
        }
        Err(why.clone())
    }
}

/// Removes the numbers of the missing rows, given in order, from a column.
fn close(column: &mut Vec<f64>, gaps: &[usize]) {
    let (mut end, all) = (gaps.first().copied().unwrap_or(column.len()), column.len());
    for (k, &gap) in gaps.iter().enumerate() {
        let kept = gap + 1..gaps.get(k + 1).copied().unwrap_or(all);
        let next = end + kept.len();
        column.copy_within(kept, end);
        end = next;
    }
    column.truncate(end);
}
