//! Picks one place for each label: coordinate descent, then joint moves of labels in conflict.

use crate::paper::extent::Rect;

use super::candidate::{self, Candidate};
use super::cost::{self, Around};
use super::obstacle::Obstacles;
use super::{CROWDED, Found, Leads, Placement, Wanted};

/// Sweeps of the descent. Each lowers the total, so it ends by itself; on sheets of 200 labels after 6 at most.
const SWEEPS_MAX: usize = 24;
/// Rounds of joint moves, each followed by a descent.
const ROUNDS_MAX: usize = 8;
/// From this cost on a leader line is worth a try: dearer than any place with nothing but a foreign line near by.
const POOR: f64 = 5.5;

/// What it costs a label of a series of figures to leave the place that it had in the figure before: less than touching
/// anything, more than any nearness, so that it stays beside its thing until something comes in its way.
pub(super) const LEAVE: f64 = 6.0;

/// Places from near the thing to far off: without a leader line, with one, with a long one.
const RINGS: [fn(&Wanted) -> Vec<Candidate>; 3] = [candidate::near, candidate::far, candidate::farthest];

/// The places that a label may take and what each costs by itself, found when first asked for: the same label is often searched
/// for again without some of its neighbours, which changes nothing of this.
pub(super) struct Offer<'a> {
    wanted: &'a Wanted,
    obstacles: &'a Obstacles,
    paper: Rect,
    /// Those near its thing, from the first search that needs them on also those of a further ring.
    places: Vec<Candidate>,
    /// How many there are up to the end of each ring found so far.
    ends: Vec<usize>,
    costs: Vec<Option<f64>>,
    /// What is drawn around those of each ring.
    around: [Option<Around<'a>>; RINGS.len()],
}

impl<'a> Offer<'a> {
    /// Of a label among all that is drawn.
    pub(super) fn new(wanted: &'a Wanted, obstacles: &'a Obstacles, paper: Rect) -> Offer<'a> {
        let around = std::array::from_fn(|_| None);
        let mut offer = Offer { wanted, obstacles, paper, places: Vec::new(), ends: Vec::new(), costs: Vec::new(), around };
        offer.up_to(0);
        offer
    }

    /// How many places there are up to the end of a ring.
    fn up_to(&mut self, ring: usize) -> usize {
        for further in &RINGS[self.ends.len().min(ring + 1)..=ring] {
            self.places.extend(further(self.wanted));
            self.ends.push(self.places.len());
        }
        self.costs.resize(self.places.len(), None);
        self.ends[ring]
    }

    /// In which ring a place is, and the places of that ring.
    fn ring(&self, k: usize) -> (usize, std::ops::Range<usize>) {
        let ring = self.ends.partition_point(|end| *end <= k);
        (ring, if ring == 0 { 0 } else { self.ends[ring - 1] }..self.ends[ring])
    }

    /// The cost of a place, of which most others will be asked too.
    fn cost(&mut self, k: usize) -> f64 {
        if let Some(cost) = self.costs[k] {
            return cost;
        }
        let (ring, alike) = self.ring(k);
        let alike = &self.places[alike];
        let around = self.around[ring].get_or_insert_with(|| Around::new(alike, self.wanted, self.obstacles, self.paper));
        let cost = around.fixed(&self.places[k]);
        self.costs[k] = Some(cost);
        cost
    }

    /// The cost of a place that is perhaps the only one.
    fn cost_alone(&mut self, k: usize) -> f64 {
        let here = &self.places[k];
        let found = || Around::new(std::slice::from_ref(here), self.wanted, self.obstacles, self.paper).fixed(here);
        *self.costs[k].get_or_insert_with(found)
    }
}

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
        let mut choice = Choice { offer, fixed, known, picked: 0, before, open: false, reach, neighbours: Vec::new() };
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
    let mut choices: Vec<Choice> = wanted.enumerate().map(|(i, (_, offer))| Choice::new(offer, stood(i))).collect();
    // In a series the figure before has settled what stands where: one descent mends what has come in the way.
    let rounds = if before.is_empty() { ROUNDS_MAX } else { 0 };
    settle(&mut choices, rounds);
    loop {
        let content = |i: &usize| choices[*i].open || total(&choices, *i, choices[*i].picked) < LEAVE;
        let others: Vec<usize> = (0..choices.len()).filter(|i| !content(i)).collect();
        if others.is_empty() {
            break;
        }
        others.into_iter().for_each(|i| choices[i].open());
        settle(&mut choices, rounds);
    }
    let rings: &[(usize, f64)] = match leads {
        Leads::Short => &[(1, POOR)],
        Leads::Long => &[(1, POOR), (2, CROWDED)],
    };
    for &(ring, enough) in rings {
        let is_poor = |i: &usize| choices[*i].open && total(&choices, *i, choices[*i].picked) > enough;
        let poor: Vec<usize> = (0..choices.len()).filter(is_poor).collect();
        if !poor.is_empty() {
            poor.into_iter().for_each(|i| choices[i].look_far(ring));
            settle(&mut choices, rounds);
        }
    }
    let picked = |i: usize| choices[i].picked;
    (0..choices.len()).map(|i| (*choices[i].place(), total(&choices, i, picked(i)) - choices[i].leave(picked(i)), picked(i))).collect()
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

/// Cost of place `k` of label `i` beside the picked places of all others.
fn total(choices: &[Choice], i: usize, k: usize) -> f64 {
    choices[i].fixed[k] + beside(choices, i, k)
}

/// What place `k` of label `i` costs beside the picked places of its neighbours.
fn beside(choices: &[Choice], i: usize, k: usize) -> f64 {
    let me = &choices[i];
    me.neighbours.iter().map(|&j| cost::pair(&me.places()[k], choices[j].place())).sum()
}

fn meet(choices: &mut [Choice]) {
    let reach: Vec<Rect> = choices.iter().map(|c| c.reach).collect();
    for (i, choice) in choices.iter_mut().enumerate() {
        choice.neighbours = (0..reach.len()).filter(|&j| j != i && cost::close(reach[i], reach[j])).collect();
    }
}

fn settle(choices: &mut [Choice], rounds: usize) {
    meet(choices);
    descend(choices);
    for _ in 0..rounds {
        if !move_pairs(choices) {
            return;
        }
        descend(choices);
    }
}

fn descend(choices: &mut [Choice]) {
    let mut others: Vec<Candidate> = Vec::new();
    for _ in 0..SWEEPS_MAX {
        let mut moved = false;
        for i in 0..choices.len() {
            let me = &choices[i];
            others.clear();
            others.extend(me.neighbours.iter().map(|&j| *choices[j].place()).filter(|p| cost::close(me.reach, p.reach)));
            let me = &mut choices[i];
            let (mut best, mut least) = (me.picked, total_beside(me, me.picked, &others, f64::INFINITY));
            let now = least;
            for k in 0..me.count() {
                // Beside others a place only becomes dearer: most need not be looked at.
                if me.fixed[k] <= least {
                    me.know(k);
                }
                if me.fixed[k] > least || k == me.picked {
                    continue;
                }
                let cost = total_beside(me, k, &others, least);
                // Of equals the first, as everywhere.
                if cost < least || cost == least && k < best && cost < now {
                    (best, least) = (k, cost);
                }
            }
            if least < now {
                me.picked = best;
                moved = true;
            }
        }
        if !moved {
            return;
        }
    }
}

/// Cost of a label's place `k` beside these places of its neighbours; from `enough` on some cost that is larger.
fn total_beside(me: &Choice, k: usize, others: &[Candidate], enough: f64) -> f64 {
    let mut beside = 0.0;
    for other in others {
        beside += cost::pair(&me.places()[k], other);
        if me.fixed[k] + beside > enough {
            break;
        }
    }
    me.fixed[k] + beside
}

/// Moves labels in conflict together with each neighbour that stands in their way.
fn move_pairs(choices: &mut [Choice]) -> bool {
    let mut moved = false;
    for i in 0..choices.len() {
        if total(choices, i, choices[i].picked) < CROWDED {
            continue;
        }
        // Whoever stands where one of the label's own better places is, not only where it is now.
        let bound = total(choices, i, choices[i].picked);
        choices[i].know_up_to(bound);
        let all = choices[i].neighbours.iter().copied();
        let rivals: Vec<usize> = all
            .filter(|&j| {
                let here = choices[j].place();
                choices[i].places().iter().zip(&choices[i].fixed).any(|(p, &f)| f < bound && cost::pair(p, here) > 0.0)
            })
            .collect();
        for j in rivals {
            moved |= move_pair(choices, i, j);
        }
    }
    moved
}

fn move_pair(choices: &mut [Choice], i: usize, j: usize) -> bool {
    let (beside_me, beside_other) = (others(choices, i, j), others(choices, j, i));
    let alone = |me: &Choice, others: &[Candidate]| total_beside(me, me.picked, others, f64::INFINITY);
    let together = cost::pair(choices[i].place(), choices[j].place());
    let now = alone(&choices[i], &beside_me) + alone(&choices[j], &beside_other) + together;
    // Rounding must not keep two equal places changing for ever.
    let mut best = now - 1e-9;
    let mut at = None;
    // What one of the two costs at the least leaves so much for the other: dearer places need not be looked at.
    let least = choices[j].fixed.iter().copied().fold(f64::INFINITY, f64::min);
    let mine = cheap_first(&mut choices[i], &beside_me, best - least);
    let Some(least) = mine.first().map(|m| m.1) else { return false };
    let theirs = cheap_first(&mut choices[j], &beside_other, best - least);
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
    let Some(at) = at else { return false };
    (choices[i].picked, choices[j].picked) = at;
    true
}

/// The picked places that can meet one of label `i`'s, without that of label `j`.
fn others(choices: &[Choice], i: usize, j: usize) -> Vec<Candidate> {
    let me = &choices[i];
    let all = me.neighbours.iter().filter(|n| **n != j).map(|&n| *choices[n].place());
    all.filter(|p| cost::close(me.reach, p.reach)).collect()
}

/// A label's places that cost no more than `enough` beside these, the cheapest first.
fn cheap_first(me: &mut Choice, others: &[Candidate], enough: f64) -> Vec<(usize, f64)> {
    me.know_up_to(enough);
    let me = &*me;
    let affordable = (0..me.count()).filter(|&k| me.fixed[k] <= enough);
    let priced = affordable.map(|k| (k, total_beside(me, k, others, enough)));
    let mut list: Vec<(usize, f64)> = priced.filter(|(_, cost)| *cost <= enough).collect();
    list.sort_by(|a, b| a.1.total_cmp(&b.1));
    list
}
