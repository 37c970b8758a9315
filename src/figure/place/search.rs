//! Picks one place for each label: coordinate descent, then joint moves of labels in conflict.

use crate::figure::extent::Rect;

use super::candidate::{self, Candidate};
use super::cost::{self, Around};
use super::obstacle::Obstacles;
use super::{CROWDED, Found, Placement, Wanted};

/// Sweeps of the descent. Each lowers the total, so it ends by itself; on sheets of 200 labels after 6 at most.
const SWEEPS_MAX: usize = 24;
/// Rounds of joint moves, each followed by a descent.
const ROUNDS_MAX: usize = 8;
/// From this cost on a leader line is worth a try: dearer than any place with nothing but a foreign line near by.
const POOR: f64 = 5.5;

/// What it costs a label of a series of figures to leave the place that it had in the figure before: less than touching
/// anything, more than any nearness, so that it stays beside its thing until something comes in its way.
const LEAVE: f64 = 6.0;

struct Choice {
    places: Vec<Candidate>,
    fixed: Vec<f64>,
    picked: usize,
    /// The place that it had in the figure before.
    before: Option<usize>,
    /// Whether all places have their cost. While the place of the figure before costs less than leaving it, no other can be
    /// better, and none needs a cost.
    priced: bool,
    /// The labels with a place that could meet one of this label's places.
    neighbours: Vec<usize>,
}

impl Choice {
    fn offer(&mut self, places: Vec<Candidate>, wanted: &Wanted, obstacles: &Obstacles, paper: Rect) {
        let around = self.priced.then(|| Around::new(&places, wanted, obstacles, paper));
        for place in places {
            let leave = self.leave(self.places.len());
            self.fixed.push(around.as_ref().map_or(f64::INFINITY, |a| a.fixed(&place) + leave));
            self.places.push(place);
        }
    }

    /// Gives every place its cost.
    fn price(&mut self, wanted: &Wanted, obstacles: &Obstacles, paper: Rect) {
        self.priced = true;
        let around = Around::new(&self.places, wanted, obstacles, paper);
        self.fixed = (0..self.places.len()).map(|k| around.fixed(&self.places[k]) + self.leave(k)).collect();
    }

    /// The box around all its places and leader lines.
    fn reach(&self) -> Rect {
        self.places.iter().map(cost::with_leader).reduce(Rect::union).expect("every label has places")
    }

    /// What a place costs because it is another one than before.
    fn leave(&self, k: usize) -> f64 {
        if self.before.is_some_and(|b| b != k) { LEAVE } else { 0.0 }
    }

    fn place(&self) -> &Candidate {
        &self.places[self.picked]
    }
}

/// For each label its place, what that costs, and which of the places it is; `before` says which it was in the figure before.
pub(super) fn run(wanted: &[Wanted], obstacles: &Obstacles, paper: Rect, before: &[Option<usize>]) -> Vec<Found> {
    let mut choices: Vec<Choice> = wanted
        .iter()
        .enumerate()
        .map(|(i, w)| {
            let before = before.get(i).copied().flatten();
            let mut choice =
                Choice { places: Vec::new(), fixed: Vec::new(), picked: 0, before, priced: before.is_none(), neighbours: Vec::new() };
            choice.offer(candidate::near(w), w, obstacles, paper);
            if before.is_some_and(|b| b >= choice.places.len()) {
                choice.offer(candidate::far(w), w, obstacles, paper);
            }
            match before {
                Some(b) if b < choice.places.len() => {
                    choice.picked = b;
                    let here = std::slice::from_ref(&choice.places[b]);
                    choice.fixed[b] = Around::new(here, w, obstacles, paper).fixed(&here[0]);
                    if choice.fixed[b] >= LEAVE {
                        choice.price(w, obstacles, paper);
                    }
                }
                Some(_) => {
                    choice.before = None;
                    choice.price(w, obstacles, paper);
                    choice.picked = argmin(&choice.fixed);
                }
                None => choice.picked = argmin(&choice.fixed),
            }
            choice
        })
        .collect();
    // In a series the figure before has settled what stands where: one descent mends what has come in the way.
    let rounds = if before.is_empty() { ROUNDS_MAX } else { 0 };
    settle(&mut choices, rounds);
    loop {
        let unpriced: Vec<usize> =
            (0..choices.len()).filter(|&i| !choices[i].priced && total(&choices, i, choices[i].picked) >= LEAVE).collect();
        if unpriced.is_empty() {
            break;
        }
        unpriced.into_iter().for_each(|i| choices[i].price(&wanted[i], obstacles, paper));
        settle(&mut choices, rounds);
    }
    let is_poor = |i: &usize| choices[*i].priced && total(&choices, *i, choices[*i].picked) > POOR;
    let poor: Vec<usize> = (0..choices.len()).filter(is_poor).collect();
    if !poor.is_empty() {
        for i in poor {
            if choices[i].places.iter().any(|c| c.leader.is_some()) {
                continue;
            }
            choices[i].offer(candidate::far(&wanted[i]), &wanted[i], obstacles, paper);
        }
        settle(&mut choices, rounds);
    }
    let picked = |i: usize| choices[i].picked;
    (0..choices.len()).map(|i| (*choices[i].place(), total(&choices, i, picked(i)) - choices[i].leave(picked(i)), picked(i))).collect()
}

/// The best place near its thing for a label beside others that stay where they are.
pub(super) fn beside_placed(wanted: &Wanted, obstacles: &Obstacles, paper: Rect, placed: &[Placement]) -> Option<Found> {
    let places = candidate::near(wanted);
    let around = Around::new(&places, wanted, obstacles, paper);
    let others: Vec<Candidate> = placed.iter().map(|p| Candidate { rect: p.bounds, leader: p.leader, base: 0.0 }).collect();
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
    choices[i].fixed[k] + beside(choices, i, k, i)
}

/// What place `k` of label `i` costs beside the picked places of its neighbours, `without` left out.
fn beside(choices: &[Choice], i: usize, k: usize, without: usize) -> f64 {
    let me = &choices[i];
    me.neighbours.iter().filter(|&&j| j != without).map(|&j| cost::pair(&me.places[k], choices[j].place())).sum()
}

fn meet(choices: &mut [Choice]) {
    let reach: Vec<Rect> = choices.iter().map(|c| c.reach().grown(cost::PAIR_AIR_MM)).collect();
    for (i, choice) in choices.iter_mut().enumerate() {
        choice.neighbours = (0..reach.len()).filter(|&j| j != i && reach[i].overlap_mm2(reach[j]) > 0.0).collect();
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
            others.extend(me.neighbours.iter().map(|&j| *choices[j].place()));
            let (mut best, mut least) = (me.picked, total_beside(me, me.picked, &others, f64::INFINITY));
            let now = least;
            for k in 0..me.places.len() {
                // Beside others a place only becomes dearer: most need not be looked at.
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
                choices[i].picked = best;
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
        beside += cost::pair(&me.places[k], other);
        if beside > enough {
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
        let all = choices[i].neighbours.iter().copied();
        let rivals: Vec<usize> = all
            .filter(|&j| {
                let here = choices[j].place();
                choices[i].places.iter().zip(&choices[i].fixed).any(|(p, &f)| f < bound && cost::pair(p, here) > 0.0)
            })
            .collect();
        for j in rivals {
            moved |= move_pair(choices, i, j);
        }
    }
    moved
}

fn move_pair(choices: &mut [Choice], i: usize, j: usize) -> bool {
    let costs = |me: usize, other: usize| -> Vec<f64> {
        choices[me].fixed.iter().enumerate().map(|(k, fixed)| fixed + beside(choices, me, k, other)).collect()
    };
    let (ci, cj) = (costs(i, j), costs(j, i));
    let (mut best, mut at) = (f64::INFINITY, (choices[i].picked, choices[j].picked));
    let now = ci[at.0] + cj[at.1] + cost::pair(choices[i].place(), choices[j].place());
    for (a, place_a) in choices[i].places.iter().enumerate() {
        for (b, place_b) in choices[j].places.iter().enumerate() {
            let alone = ci[a] + cj[b];
            if alone < best {
                let both = alone + cost::pair(place_a, place_b);
                if both < best {
                    best = both;
                    at = (a, b);
                }
            }
        }
    }
    // Rounding must not keep two equal places changing for ever.
    if best < now - 1e-9 {
        (choices[i].picked, choices[j].picked) = at;
        return true;
    }
    false
}
