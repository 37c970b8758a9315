//! Chooses one place for each label: coordinate descent, then joint moves of labels in conflict.
//!
//! Nothing is computed twice. The individual cost of a place is kept in its [`Offer`]; its cost
//! beside a neighbour is kept until the neighbour moves ([`NeighbourCosts`]); a pair that could not
//! be improved is tried again only after something around it has moved.

use crate::paper::extent::Rect;
use hodograph_base::budget::spend;

use super::candidate::{self, CandidatePlace};
use super::cost::{self, Around};
use super::obstacle::Obstacles;
use super::offer::{Offer, RINGS};
use super::{CROWDED, ChosenPlace, LeaderReach, MeasuredRequest, Placement};

/// Largest number of sweeps of the descent. Each lowers the total, so it terminates by itself; on
/// sheets of 200 labels after at most 6.
const SWEEPS_MAX: usize = 24;
/// Rounds of joint moves, each followed by a descent.
const ROUNDS_MAX: usize = 8;
/// Cost from which leader lines are tried: more than any place that only has a foreign line nearby.
const POOR: f64 = 5.5;
/// Cost from which leader lines are tried in all directions: a place that covers something or is
/// nearer to another object costs more.
const STRAYED: f64 = 7.0;
/// Cost from which leader lines to any part of the target are tried: that of covering a thick line,
/// or of a leader line through an arc.
const COVERED: f64 = cost::TOUCH * cost::THICK_FACTOR;

/// Cost for a label in a series of figures of leaving its place in the previous figure: less than
/// touching anything, more than any nearness. A label thus stays until something obstructs it.
pub(super) const LEAVE: f64 = 6.0;

struct LabelChoice<'c, 'a> {
    offer: &'c mut Offer<'a>,
    /// Individual cost of each place; a lower bound until it is known.
    fixed: Vec<f64>,
    /// True for each place with a known cost.
    known: Vec<bool>,
    picked: usize,
    /// The place in the previous figure.
    before: Option<usize>,
    /// True if the label considers other places. While the previous place costs less than leaving
    /// it, no other can be better.
    open: bool,
    /// The box around all its places and leader lines.
    reach: Rect,
    /// The labels with a place that could meet one of this label's places.
    neighbours: Vec<usize>,
    /// Costs of its places beside the current places of the others.
    beside: NeighbourCosts,
    /// Time of its last move or extension of places.
    moved: u64,
}

/// Costs of a label's places beside the current places of the others. Most places meet no other
/// label: only positive costs are stored.
#[derive(Default)]
struct NeighbourCosts {
    /// For each place the others that make it costlier, in their order, with the cost.
    rows: Vec<Vec<(usize, f64)>>,
    /// The place assumed for each other label; `None` if not yet considered.
    stand: Vec<Option<usize>>,
}

impl NeighbourCosts {
    /// Updates the costs for another label at its `index`th place.
    fn turn_to(
        &mut self,
        places: &[CandidatePlace],
        j: usize,
        (index, place): (usize, &CandidatePlace),
    ) {
        let before = self.stand[j].replace(index);
        if before == Some(index) {
            return;
        }
        for (row, mine) in self.rows.iter_mut().zip(places) {
            if before.is_some() {
                row.retain(|(other, _)| *other != j);
            }
            let cost = cost::pair(mine, place);
            if cost > 0.0 {
                row.insert(row.partition_point(|(other, _)| *other < j), (j, cost));
            }
        }
    }

    /// Clears all costs after places were added.
    fn restart(&mut self, places: usize, labels: usize) {
        (self.rows, self.stand) = (vec![Vec::new(); places], vec![None; labels]);
    }
}

/// The box around some places and their leader lines.
fn around(places: &[CandidatePlace]) -> Rect {
    places.iter().map(|c| c.reach).reduce(Rect::union).expect("every label has places")
}

impl<'c, 'a> LabelChoice<'c, 'a> {
    fn new(offer: &'c mut Offer<'a>, before: Option<usize>) -> LabelChoice<'c, 'a> {
        // Includes enough rings to contain the place of the previous figure.
        let mut count = offer.up_to(0);
        for ring in 1..RINGS.len() {
            if before.is_some_and(|b| b >= count) {
                count = offer.up_to(ring);
            }
        }
        let before = before.filter(|b| *b < count);
        let reach = around(&offer.places[..count]);
        let (fixed, known) = (vec![f64::INFINITY; count], vec![true; count]);
        let (neighbours, beside) = (Vec::new(), NeighbourCosts::default());
        let mut choice = LabelChoice {
            offer,
            fixed,
            known,
            picked: 0,
            before,
            open: false,
            reach,
            neighbours,
            beside,
            moved: 0,
        };
        if let Some(b) = before {
            choice.picked = b;
            choice.fixed[b] = choice.offer.cost_alone(b);
        }
        if before.is_none_or(|b| choice.fixed[b] >= LEAVE) {
            choice.open();
        }
        if before.is_none() {
            choice.picked = choice.cheapest();
        }
        choice
    }

    /// Number of its places.
    fn count(&self) -> usize {
        self.fixed.len()
    }

    fn places(&self) -> &[CandidatePlace] {
        &self.offer.places[..self.fixed.len()]
    }

    /// Makes the label consider all its places.
    fn open(&mut self) {
        self.open = true;
        for k in (0..self.count()).filter(|k| self.before != Some(*k)) {
            (self.fixed[k], self.known[k]) = (self.offer.places[k].base + self.leave(k), false);
        }
    }

    /// Adds the places up to the end of a ring.
    fn look_far(&mut self, ring: usize) {
        for k in self.count()..self.offer.up_to(ring) {
            self.fixed.push(self.offer.places[k].base + self.leave(k));
            self.known.push(false);
        }
        self.reach = around(self.places());
    }

    /// Computes the individual cost of a place.
    fn know(&mut self, k: usize) {
        if !self.known[k] {
            (self.fixed[k], self.known[k]) = (self.offer.cost(k) + self.leave(k), true);
        }
    }

    /// Computes the individual costs of all places that may cost no more than `enough`.
    fn know_up_to(&mut self, enough: f64) {
        (0..self.count()).for_each(|k| {
            if self.fixed[k] <= enough {
                self.know(k);
            }
        });
    }

    /// Returns the place with the lowest individual cost, the first among equals.
    fn cheapest(&mut self) -> usize {
        self.know(0);
        let mut best = 0;
        for k in 1..self.count() {
            if self.fixed[k] < self.fixed[best] {
                self.know(k);
                if self.fixed[k] < self.fixed[best] {
                    best = k;
                }
            }
        }
        best
    }

    /// Returns the cost of a place for differing from the previous one.
    fn leave(&self, k: usize) -> f64 {
        if self.before.is_some_and(|b| b != k) { LEAVE } else { 0.0 }
    }

    fn place(&self) -> &CandidatePlace {
        &self.offer.places[self.picked]
    }
}

/// Returns for each of these labels (in their order) its place, the cost, and the index of the
/// place; `before` contains the indices in the previous figure.
pub(super) fn run(
    offers: &mut [Offer],
    of: &[usize],
    before: &[Option<usize>],
    leads: LeaderReach,
) -> Vec<ChosenPlace> {
    let stood = |i: usize| before.get(i).copied().flatten();
    let wanted = offers.iter_mut().enumerate().filter(|(k, _)| of.binary_search(k).is_ok());
    let mut search = PlaceSearch::new(
        wanted.enumerate().map(|(i, (_, offer))| LabelChoice::new(offer, stood(i))).collect(),
    );
    // In a series the previous figure has settled the places: one descent resolves new
    // obstructions.
    let rounds = if before.is_empty() { ROUNDS_MAX } else { 0 };
    search.settle(rounds);
    loop {
        spend();
        let content = |i: &usize| search.choices[*i].open || search.total(*i) < LEAVE;
        let others: Vec<usize> = (0..search.choices.len()).filter(|i| !content(i)).collect();
        if others.is_empty() {
            break;
        }
        others.into_iter().for_each(|i| search.choices[i].open());
        search.settle(rounds);
    }
    let rings: &[(usize, f64)] = match leads {
        LeaderReach::Short | LeaderReach::Kept => &[(1, POOR)],
        LeaderReach::Long => &[(1, POOR), (2, CROWDED), (3, STRAYED), (4, COVERED)],
    };
    for &(ring, enough) in rings {
        let is_poor = |i: &usize| search.choices[*i].open && search.total(*i) > enough;
        let poor: Vec<usize> = (0..search.choices.len()).filter(is_poor).collect();
        if !poor.is_empty() {
            poor.into_iter().for_each(|i| search.look_far(i, ring));
            search.settle(rounds);
        }
    }
    let found =
        |(i, c): (usize, &LabelChoice)| (*c.place(), search.total(i) - c.leave(c.picked), c.picked);
    search.choices.iter().enumerate().map(found).collect()
}

/// Returns the cost of a place beside those of other labels.
pub(super) fn cost_beside(place: &Placement, others: &[Placement]) -> f64 {
    let candidate = |p: &Placement| CandidatePlace::new(p.bounds, p.leader, 0.0);
    let own = candidate(place);
    others.iter().map(|other| cost::pair(&own, &candidate(other))).sum()
}

/// Returns the best place near its target for a label beside others that stay in place.
pub(super) fn beside_placed(
    wanted: &MeasuredRequest,
    obstacles: &Obstacles,
    paper: Rect,
    placed: &[Placement],
) -> Option<ChosenPlace> {
    let places = candidate::near(wanted);
    let around = Around::new(&places, wanted, obstacles, paper);
    let others: Vec<CandidatePlace> =
        placed.iter().map(|p| CandidatePlace::new(p.bounds, p.leader, 0.0)).collect();
    let cost =
        |c: &CandidatePlace| around.fixed(c) + others.iter().map(|o| cost::pair(c, o)).sum::<f64>();
    let costs: Vec<f64> = places.iter().map(cost).collect();
    let best = argmin(&costs);
    Some((*places.get(best)?, costs[best], best))
}

/// Returns the index of the smallest cost, the first among equals.
fn argmin(costs: &[f64]) -> usize {
    costs.iter().enumerate().fold(0, |best, (i, c)| if *c < costs[best] { i } else { best })
}

/// All labels that are compared with one another.
struct PlaceSearch<'c, 'a> {
    choices: Vec<LabelChoice<'c, 'a>>,
    /// Counter of moves.
    clock: u64,
    /// For each pair of labels, the time of the last attempt that found no better pair of places:
    /// index `n i + j`.
    tried: Vec<u64>,
}

impl<'c, 'a> PlaceSearch<'c, 'a> {
    fn new(mut choices: Vec<LabelChoice<'c, 'a>>) -> PlaceSearch<'c, 'a> {
        let n = choices.len();
        for c in &mut choices {
            c.beside.restart(c.count(), n);
        }
        PlaceSearch { choices, clock: 1, tried: vec![0; n * n] }
    }

    /// Returns the cost of a label at its current place.
    fn total(&self, i: usize) -> f64 {
        let me = &self.choices[i];
        let beside: f64 =
            me.neighbours.iter().map(|&j| cost::pair(me.place(), self.choices[j].place())).sum();
        me.fixed[me.picked] + beside
    }

    /// Adds the places of a label up to the end of a ring.
    fn look_far(&mut self, i: usize, ring: usize) {
        let n = self.choices.len();
        let me = &mut self.choices[i];
        me.look_far(ring);
        me.beside.restart(me.count(), n);
        self.stamp(i);
    }

    fn pick(&mut self, i: usize, place: usize) {
        self.choices[i].picked = place;
        self.stamp(i);
    }

    fn stamp(&mut self, i: usize) {
        self.clock += 1;
        self.choices[i].moved = self.clock;
    }

    /// Finds the pairs of labels that can meet.
    fn meet(&mut self) {
        let reach: Vec<Rect> = self.choices.iter().map(|c| c.reach).collect();
        for (i, choice) in self.choices.iter_mut().enumerate() {
            choice.neighbours =
                (0..reach.len()).filter(|&j| j != i && cost::close(reach[i], reach[j])).collect();
        }
    }

    fn settle(&mut self, rounds: usize) {
        self.meet();
        self.descend();
        for _ in 0..rounds {
            if !self.move_pairs() {
                return;
            }
            self.descend();
        }
    }

    fn descend(&mut self) {
        for _ in 0..SWEEPS_MAX {
            let mut moved = false;
            for i in 0..self.choices.len() {
                self.look_around(i);
                let me = &mut self.choices[i];
                let (mut best, mut least) = (me.picked, me.total(me.picked, None));
                let now = least;
                for k in 0..me.count() {
                    // Costs beside others only increase: most places need no examination.
                    if me.fixed[k] <= least {
                        me.know(k);
                    }
                    if me.fixed[k] > least || k == me.picked {
                        continue;
                    }
                    let cost = me.total(k, None);
                    // Among equals the first, as in all comparisons.
                    if cost < least || cost == least && k < best && cost < now {
                        (best, least) = (k, cost);
                    }
                }
                if least < now {
                    self.pick(i, best);
                    moved = true;
                }
            }
            if !moved {
                return;
            }
        }
    }

    /// Moves labels in conflict together with each neighbour that obstructs them.
    fn move_pairs(&mut self) -> bool {
        let mut moved = false;
        for i in 0..self.choices.len() {
            let bound = self.total(i);
            if bound < CROWDED {
                continue;
            }
            for j in self.rivals(i, bound) {
                let n = self.choices.len();
                if self.stirred(i).max(self.stirred(j)) <= self.tried[n * i + j] {
                    continue;
                }
                if self.move_pair(i, j) {
                    moved = true;
                } else {
                    self.tried[n * i + j] = self.clock;
                }
            }
        }
        moved
    }

    /// Returns the labels at one of the better places of a label, not only at its current one.
    fn rivals(&mut self, i: usize, bound: f64) -> Vec<usize> {
        self.look_around(i);
        let me = &mut self.choices[i];
        me.know_up_to(bound);
        let better = me.beside.rows.iter().zip(&me.fixed).filter(|(_, fixed)| **fixed < bound);
        let mut found: Vec<usize> =
            better.flat_map(|(row, _)| row.iter().map(|(j, _)| *j)).collect();
        found.sort_unstable();
        found.dedup();
        found
    }

    /// Returns the time at which a label or one of its neighbours last moved.
    fn stirred(&self, i: usize) -> u64 {
        let me = &self.choices[i];
        me.neighbours.iter().map(|&j| self.choices[j].moved).fold(me.moved, u64::max)
    }

    fn move_pair(&mut self, i: usize, j: usize) -> bool {
        self.look_around(i);
        self.look_around(j);
        let choices = &mut self.choices;
        let together = cost::pair(choices[i].place(), choices[j].place());
        let alone = |me: &LabelChoice, without: usize| me.total(me.picked, Some(without));
        let now = alone(&choices[i], j) + alone(&choices[j], i) + together;
        // Rounding must not make two equal places alternate for ever.
        let mut best = now - 1e-9;
        let mut at = None;
        // The least cost of one label bounds the other's: costlier places need no examination.
        let least = choices[j].fixed.iter().copied().fold(f64::INFINITY, f64::min);
        let mine = choices[i].cheap_first(j, best - least);
        let Some(least) = mine.first().map(|m| m.1) else { return false };
        let theirs = choices[j].cheap_first(i, best - least);
        for &(a, cost_a) in &mine {
            for &(b, cost_b) in &theirs {
                let alone = cost_a + cost_b;
                if alone > best {
                    break;
                }
                let both = alone + cost::pair(&choices[i].places()[a], &choices[j].places()[b]);
                // Among equals the first, as in all comparisons.
                if both < best || both == best && at.is_some_and(|at| (a, b) < at) {
                    best = both;
                    at = Some((a, b));
                }
            }
        }
        let Some((a, b)) = at else { return false };
        self.pick(i, a);
        self.pick(j, b);
        true
    }

    /// Updates the costs for the current places of a label's neighbours.
    fn look_around(&mut self, i: usize) {
        let mut beside = std::mem::take(&mut self.choices[i].beside);
        let me = &self.choices[i];
        for &j in &me.neighbours {
            let other = &self.choices[j];
            beside.turn_to(me.places(), j, (other.picked, other.place()));
        }
        self.choices[i].beside = beside;
    }
}

impl LabelChoice<'_, '_> {
    /// Returns the cost of place `k` beside its neighbours, or all of them but one.
    fn total(&self, k: usize, without: Option<usize>) -> f64 {
        let beside: f64 = self.beside.rows[k]
            .iter()
            .filter(|(j, _)| Some(*j) != without)
            .map(|(_, cost)| cost)
            .sum();
        self.fixed[k] + beside
    }

    /// Returns the places that cost no more than `enough` beside all neighbours but one, cheapest
    /// first.
    fn cheap_first(&mut self, without: usize, enough: f64) -> Vec<(usize, f64)> {
        self.know_up_to(enough);
        let affordable = (0..self.count()).filter(|&k| self.fixed[k] <= enough);
        let mut list: Vec<(usize, f64)> = affordable
            .map(|k| (k, self.total(k, Some(without))))
            .filter(|(_, cost)| *cost <= enough)
            .collect();
        list.sort_by(|a, b| a.1.total_cmp(&b.1));
        list
    }
}
