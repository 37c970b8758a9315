//! Picks one place for each label: coordinate descent, then joint moves of labels in conflict.
//!
//! Decided here: that nothing is found twice. What a place costs by itself is kept in its [`Offer`]; what it costs beside a neighbour is
//! kept until the neighbour moves ([`Beside`]); a pair that could not be bettered is not tried again before something around it has moved.

use crate::paper::extent::Rect;
use hodograph_base::budget::spend;

use super::candidate::{self, Candidate};
use super::cost::{self, Around};
use super::obstacle::Obstacles;
use super::offer::{Offer, RINGS};
use super::{CROWDED, Found, Leads, Placement, Wanted};

/// Sweeps of the descent. Each lowers the total, so it ends by itself; on sheets of 200 labels after 6 at most.
const SWEEPS_MAX: usize = 24;
/// Rounds of joint moves, each followed by a descent.
const ROUNDS_MAX: usize = 8;
/// From this cost on a leader line is worth a try: dearer than any place with nothing but a foreign line near by.
const POOR: f64 = 5.5;
/// From this cost on it is tried in all directions: what covers something or stands nearer to something else costs more.
const STRAYED: f64 = 7.0;
/// From this cost on it is tried to any part of the thing: what covers a thick line or has a leader line through an arc costs as much.
const COVERED: f64 = cost::TOUCH * cost::THICK_FACTOR;

/// What it costs a label of a series of figures to leave the place that it had in the figure before: less than touching
/// anything, more than any nearness, so that it stays beside its thing until something comes in its way.
pub(super) const LEAVE: f64 = 6.0;

struct Choice<'c, 'a> {
    offer: &'c mut Offer<'a>,
    /// What each place costs by itself; while that is not known, what it costs at the least.
    fixed: Vec<f64>,
    /// Whether it is known.
    known: Vec<bool>,
    picked: usize,
    /// The place that it had in the figure before.
    before: Option<usize>,
    /// Whether it looks at other places. While the place of the figure before costs less than leaving it, no other can be better.
    open: bool,
    /// The box around all its places and leader lines.
    reach: Rect,
    /// The labels with a place that could meet one of this label's places.
    neighbours: Vec<usize>,
    /// What its places cost beside the others' where they stand.
    beside: Beside,
    /// When it last took another place or looked at more of them.
    moved: u64,
}

/// What the places of a label cost beside the others where they stand. Most places meet nobody: only what costs something is kept.
#[derive(Default)]
struct Beside {
    /// For each place the others that make it dearer, in their order, and by how much.
    rows: Vec<Vec<(usize, f64)>>,
    /// At which of its places each other label is taken to stand; at none yet.
    stand: Vec<Option<usize>>,
}

impl Beside {
    /// From now on another label stands at its `index`th place.
    fn turn_to(&mut self, places: &[Candidate], j: usize, (index, place): (usize, &Candidate)) {
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

    /// There are more places now: all is found anew.
    fn restart(&mut self, places: usize, labels: usize) {
        (self.rows, self.stand) = (vec![Vec::new(); places], vec![None; labels]);
    }
}

/// The box around some places and their leader lines.
fn around(places: &[Candidate]) -> Rect {
    places.iter().map(|c| c.reach).reduce(Rect::union).expect("every label has places")
}

impl<'c, 'a> Choice<'c, 'a> {
    fn new(offer: &'c mut Offer<'a>, before: Option<usize>) -> Choice<'c, 'a> {
        // As many rings as hold the place of the figure before.
        let mut count = offer.up_to(0);
        for ring in 1..RINGS.len() {
            if before.is_some_and(|b| b >= count) {
                count = offer.up_to(ring);
            }
        }
        let before = before.filter(|b| *b < count);
        let reach = around(&offer.places[..count]);
        let (fixed, known) = (vec![f64::INFINITY; count], vec![true; count]);
        let (neighbours, beside) = (Vec::new(), Beside::default());
        let mut choice = Choice { offer, fixed, known, picked: 0, before, open: false, reach, neighbours, beside, moved: 0 };
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

    /// How many places it has.
    fn count(&self) -> usize {
        self.fixed.len()
    }

    fn places(&self) -> &[Candidate] {
        &self.offer.places[..self.fixed.len()]
    }

    /// From now on it looks at all its places.
    fn open(&mut self) {
        self.open = true;
        for k in (0..self.count()).filter(|k| self.before != Some(*k)) {
            (self.fixed[k], self.known[k]) = (self.offer.places[k].base + self.leave(k), false);
        }
    }

    /// Takes the places up to the end of a ring as well.
    fn look_far(&mut self, ring: usize) {
        for k in self.count()..self.offer.up_to(ring) {
            self.fixed.push(self.offer.places[k].base + self.leave(k));
            self.known.push(false);
        }
        self.reach = around(self.places());
    }

    /// Finds what a place costs by itself.
    fn know(&mut self, k: usize) {
        if !self.known[k] {
            (self.fixed[k], self.known[k]) = (self.offer.cost(k) + self.leave(k), true);
        }
    }

    /// The same for all that may cost no more than `enough`.
    fn know_up_to(&mut self, enough: f64) {
        (0..self.count()).for_each(|k| {
            if self.fixed[k] <= enough {
                self.know(k);
            }
        });
    }

    /// The cheapest place by itself, the first of equals.
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

    /// What a place costs because it is another one than before.
    fn leave(&self, k: usize) -> f64 {
        if self.before.is_some_and(|b| b != k) { LEAVE } else { 0.0 }
    }

    fn place(&self) -> &Candidate {
        &self.offer.places[self.picked]
    }
}

/// For each of these labels (in their order) its place, what that costs, and which of the places it is; `before` says which it was
/// in the figure before.
pub(super) fn run(offers: &mut [Offer], of: &[usize], before: &[Option<usize>], leads: Leads) -> Vec<Found> {
    let stood = |i: usize| before.get(i).copied().flatten();
    let wanted = offers.iter_mut().enumerate().filter(|(k, _)| of.binary_search(k).is_ok());
    let mut search = Search::new(wanted.enumerate().map(|(i, (_, offer))| Choice::new(offer, stood(i))).collect());
    // In a series the figure before has settled what stands where: one descent mends what has come in the way.
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
        Leads::Short => &[(1, POOR)],
        Leads::Long => &[(1, POOR), (2, CROWDED), (3, STRAYED), (4, COVERED)],
    };
    for &(ring, enough) in rings {
        let is_poor = |i: &usize| search.choices[*i].open && search.total(*i) > enough;
        let poor: Vec<usize> = (0..search.choices.len()).filter(is_poor).collect();
        if !poor.is_empty() {
            poor.into_iter().for_each(|i| search.look_far(i, ring));
            search.settle(rounds);
        }
    }
    let found = |(i, c): (usize, &Choice)| (*c.place(), search.total(i) - c.leave(c.picked), c.picked);
    search.choices.iter().enumerate().map(found).collect()
}

/// The best place near its thing for a label beside others that stay where they are.
pub(super) fn beside_placed(wanted: &Wanted, obstacles: &Obstacles, paper: Rect, placed: &[Placement]) -> Option<Found> {
    let places = candidate::near(wanted);
    let around = Around::new(&places, wanted, obstacles, paper);
    let others: Vec<Candidate> = placed.iter().map(|p| Candidate::new(p.bounds, p.leader, 0.0)).collect();
    let cost = |c: &Candidate| around.fixed(c) + others.iter().map(|o| cost::pair(c, o)).sum::<f64>();
    let costs: Vec<f64> = places.iter().map(cost).collect();
    let best = argmin(&costs);
    Some((*places.get(best)?, costs[best], best))
}

/// The first of the smallest.
fn argmin(costs: &[f64]) -> usize {
    costs.iter().enumerate().fold(0, |best, (i, c)| if *c < costs[best] { i } else { best })
}

/// All labels that are weighed against one another.
struct Search<'c, 'a> {
    choices: Vec<Choice<'c, 'a>>,
    /// Counts the moves.
    clock: u64,
    /// For each pair of labels, when it was last found that no two places together are better: `n i + j`.
    tried: Vec<u64>,
}

impl<'c, 'a> Search<'c, 'a> {
    fn new(mut choices: Vec<Choice<'c, 'a>>) -> Search<'c, 'a> {
        let n = choices.len();
        for c in &mut choices {
            c.beside.restart(c.count(), n);
        }
        Search { choices, clock: 1, tried: vec![0; n * n] }
    }

    /// What a label costs where it stands.
    fn total(&self, i: usize) -> f64 {
        let me = &self.choices[i];
        let beside: f64 = me.neighbours.iter().map(|&j| cost::pair(me.place(), self.choices[j].place())).sum();
        me.fixed[me.picked] + beside
    }

    /// Takes the places of a label up to the end of a ring as well.
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

    /// Finds who can meet whom.
    fn meet(&mut self) {
        let reach: Vec<Rect> = self.choices.iter().map(|c| c.reach).collect();
        for (i, choice) in self.choices.iter_mut().enumerate() {
            choice.neighbours = (0..reach.len()).filter(|&j| j != i && cost::close(reach[i], reach[j])).collect();
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
                    // Beside others a place only becomes dearer: most need not be looked at.
                    if me.fixed[k] <= least {
                        me.know(k);
                    }
                    if me.fixed[k] > least || k == me.picked {
                        continue;
                    }
                    let cost = me.total(k, None);
                    // Of equals the first, as everywhere.
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

    /// Moves labels in conflict together with each neighbour that stands in their way.
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

    /// Whoever stands where one of a label's own better places is, not only where it is now.
    fn rivals(&mut self, i: usize, bound: f64) -> Vec<usize> {
        self.look_around(i);
        let me = &mut self.choices[i];
        me.know_up_to(bound);
        let better = me.beside.rows.iter().zip(&me.fixed).filter(|(_, fixed)| **fixed < bound);
        let mut found: Vec<usize> = better.flat_map(|(row, _)| row.iter().map(|(j, _)| *j)).collect();
        found.sort_unstable();
        found.dedup();
        found
    }

    /// When a label or one of its neighbours last moved.
    fn stirred(&self, i: usize) -> u64 {
        let me = &self.choices[i];
        me.neighbours.iter().map(|&j| self.choices[j].moved).fold(me.moved, u64::max)
    }

    fn move_pair(&mut self, i: usize, j: usize) -> bool {
        self.look_around(i);
        self.look_around(j);
        let choices = &mut self.choices;
        let together = cost::pair(choices[i].place(), choices[j].place());
        let alone = |me: &Choice, without: usize| me.total(me.picked, Some(without));
        let now = alone(&choices[i], j) + alone(&choices[j], i) + together;
        // Rounding must not keep two equal places changing for ever.
        let mut best = now - 1e-9;
        let mut at = None;
        // What one of the two costs at the least leaves so much for the other: dearer places need not be looked at.
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
                // Of equals the first, as everywhere.
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

    /// Finds out where the neighbours of a label stand.
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

impl Choice<'_, '_> {
    /// Cost of place `k` beside its neighbours, or all of them but one.
    fn total(&self, k: usize, without: Option<usize>) -> f64 {
        let beside: f64 = self.beside.rows[k].iter().filter(|(j, _)| Some(*j) != without).map(|(_, cost)| cost).sum();
        self.fixed[k] + beside
    }

    /// Its places that cost no more than `enough` beside all neighbours but one, the cheapest first.
    fn cheap_first(&mut self, without: usize, enough: f64) -> Vec<(usize, f64)> {
        self.know_up_to(enough);
        let affordable = (0..self.count()).filter(|&k| self.fixed[k] <= enough);
        let mut list: Vec<(usize, f64)> =
            affordable.map(|k| (k, self.total(k, Some(without)))).filter(|(_, cost)| *cost <= enough).collect();
        list.sort_by(|a, b| a.1.total_cmp(&b.1));
        list
    }
}
