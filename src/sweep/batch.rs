//! Many mechanisms: parameters varied over a grid or at random, each mechanism at one or many positions of its driver.
//!
//! Mechanisms are numbered; the values of one depend on its number alone, so that any stretch of a batch can be computed by
//! itself, in any order and on any number of threads, with the same bits. Memory is that of a [`Block`], not of the batch.

use super::general::{General, driver_name};
use super::station::{Stations, angle_per_value, position_now};
use super::vary::Variation;
use super::{Placed, Width, branches, compile, moved, run_parts};
use crate::accuracy::toggle::with_driver_at;
use crate::diag::Faults;
use crate::mechanism::{Demand, Mechanism};
use crate::position::{self, Configuration};
use crate::scene::Scene;
use crate::scene::eval::Value;
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use rayon::prelude::*;
use std::borrow::Cow;

/// How the parameters' values are chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choice {
    /// Every combination; the last parameter runs fastest.
    Grid,
    /// So many mechanisms, each parameter evenly spread between its first and last value.
    Random {
        /// How many.
        count: u64,
        /// Another seed gives other mechanisms.
        seed: u64,
    },
}

/// A batch: which mechanisms, at which positions.
pub struct Batch<'a> {
    /// The scene whose parameters vary.
    pub scene: &'a Scene,
    /// Its topology, the same for all.
    pub mechanism: &'a Mechanism,
    /// The parameters.
    pub variation: Variation,
    /// The values of each.
    pub values: Vec<Vec<Value>>,
    /// Which of them.
    pub choice: Choice,
    /// The driver that is swept.
    pub driver: usize,
    /// Its positions; `None`: where the scene puts it.
    pub stations: Option<Stations>,
}

/// The rows of a stretch of mechanisms.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Block {
    /// The numbers, a column after the other.
    pub columns: Vec<Vec<f64>>,
    /// Positions that have no row, because the mechanism cannot be assembled there.
    pub missing: u64,
}

/// The stations of a mechanism, its columns, and which rows are there.
type Rowed<'a> = (Cow<'a, Stations>, Vec<Vec<f64>>, Vec<bool>);

impl Batch<'_> {
    /// How many mechanisms there are.
    pub fn mechanisms(&self) -> u64 {
        match self.choice {
            Choice::Grid => self.values.iter().map(|v| v.len() as u64).fold(1, u64::saturating_mul),
            Choice::Random { count, .. } => count,
        }
    }

    /// Positions of each mechanism.
    pub fn positions(&self) -> usize {
        self.stations.as_ref().map_or(1, Stations::len)
    }

    /// Name and unit of each column: the mechanism's number, its parameters, the driver's position, the answers.
    pub fn columns(&self) -> Vec<(String, &'static str)> {
        let mut out = vec![("mechanism".to_owned(), "")];
        out.extend(self.variation.names().zip(&self.values).map(|(n, v)| (n.to_owned(), v.first().map_or("", |v| self.variation.unit(v)))));
        out.push(driver_name(self.scene, self.driver));
        for f in &self.scene.find {
            out.extend(compile::ask::names(f));
        }
        out
    }

    /// The varied parameters of a mechanism.
    pub fn parameters(&self, number: u64) -> Vec<Value> {
        match self.choice {
            Choice::Grid => {
                let mut rest = number;
                let mut out: Vec<Value> = self
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
            Choice::Random { seed, .. } => {
                let mut rng = Pcg64Mcg::seed_from_u64(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(number));
                let between = |v: &Vec<Value>, rng: &mut Pcg64Mcg| {
                    let (a, b) = (v[0], v[v.len() - 1]);
                    // 53 random bits: evenly spread multiples of 2^-53.
                    let t = (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
                    Value { number: a.number + (b.number - a.number) * t, ..a }
                };
                self.values.iter().map(|v| between(v, &mut rng)).collect()
            }
        }
    }

    /// The rows of the mechanisms `from..to`, in order.
    pub fn block(&self, from: u64, to: u64) -> Block {
        let width = self.columns().len();
        let parts: Vec<Block> =
            (from..to).into_par_iter().map_init(|| self.scene.clone(), |scene, number| self.one(scene, number, width)).collect();
        let mut whole = Block { columns: vec![Vec::with_capacity(parts.iter().map(|p| p.columns[0].len()).sum()); width], missing: 0 };
        for part in parts {
            whole.missing += part.missing;
            whole.columns.iter_mut().zip(&part.columns).for_each(|(c, p)| c.extend_from_slice(p));
        }
        whole
    }

    fn one(&self, scene: &mut Scene, number: u64, width: usize) -> Block {
        let parameters = self.parameters(number);
        let mut block = Block { columns: vec![Vec::new(); width], missing: 0 };
        scene.drivers.clone_from(&self.scene.drivers);
        match self.variation.set(scene, &parameters).and_then(|()| self.rows(scene)) {
            Ok((stations, columns, there)) => {
                let lead = std::iter::once(number as f64).chain(parameters.iter().map(|p| p.si()));
                let rows = there.iter().filter(|t| **t).count();
                for (column, value) in block.columns.iter_mut().zip(lead) {
                    column.resize(rows, value);
                }
                let numbers = std::iter::once(&stations.values).chain(&columns);
                for (column, values) in block.columns[1 + parameters.len()..].iter_mut().zip(numbers) {
                    column.extend(values.iter().zip(&there).filter(|(_, t)| **t).map(|(v, _)| *v));
                }
                block.missing = (there.len() - rows) as u64;
            }
            Err(_) => block.missing = self.positions() as u64,
        }
        block
    }

    /// The stations of a mechanism, its columns, and which rows are there.
    fn rows(&self, scene: &mut Scene) -> Result<Rowed<'_>, Faults> {
        let demand = Demand::of(scene, self.mechanism);
        let at = self.place(scene, &demand)?;
        let scene = &*scene;
        let placed = Placed { scene, mechanism: self.mechanism, demand, at };
        let per_value = angle_per_value(scene, &placed.at, self.driver);
        let here = || Stations::of_values(vec![position_now(scene, &placed.at, self.driver)], per_value);
        let stations = self.stations.as_ref().map_or_else(|| Cow::Owned(here()), Cow::Borrowed);
        let rows = match compile(scene, self.mechanism, &placed.at, Some(self.driver), &scene.find) {
            Ok(program) => {
                let (parts, _) = branches(program, &placed, self.driver, &stations);
                let mut rows = run_parts(&parts, &placed, self.driver, &stations, Width::Widest);
                rows.complete(&General::new(&placed, self.driver), &stations, &|_| None);
                rows
            }
            Err(_) => moved::follow(&placed, self.driver, &stations).0,
        };
        let there = rows.missing.iter().map(Option::is_none).collect();
        Ok((stations, rows.columns, there))
    }

    /// Where everything is at the instant; where it cannot be assembled there, the driver is put to the first station where it can.
    fn place(&self, scene: &mut Scene, demand: &Demand) -> Result<Configuration, Faults> {
        let first = position::configure(scene, self.mechanism, demand);
        let (Err(why), Some(stations)) = (&first, &self.stations) else { return first.map(|p| p.value) };
        // A dozen places about the way: a mechanism that closes in a smaller part of it is as good as none.
        let step = stations.len().div_ceil(12).max(1);
        for value in stations.values.iter().step_by(step) {
            let there = with_driver_at(scene, self.driver, *value);
            if let Ok(placed) = position::configure(&there, self.mechanism, demand) {
                *scene = there;
                return Ok(placed.value);
            }
        }
        Err(why.clone())
    }
}
