//! The places that a label may take, and what each costs by itself.

use super::Wanted;
use super::candidate::{self, Candidate};
use super::cost::Around;
use super::obstacle::Obstacles;
use crate::paper::extent::Rect;
use hodograph_base::budget::spend;

/// Places from near the thing to far off: without a leader line, with one, with a long one, with one in a direction between, with one to any part
/// of the thing.
pub(super) const RINGS: [fn(&Wanted) -> Vec<Candidate>; 5] =
    [candidate::near, candidate::far, candidate::farthest, candidate::between, candidate::anywhere];

/// The places that a label may take and what each costs by itself, found when first asked for: the same label is often searched
/// for again without some of its neighbours, which changes nothing of this.
pub(super) struct Offer<'a> {
    wanted: &'a Wanted,
    obstacles: &'a Obstacles,
    paper: Rect,
    /// Those near its thing, from the first search that needs them on also those of a further ring.
    pub(super) places: Vec<Candidate>,
    /// How many there are up to the end of each ring found so far.
    ends: Vec<usize>,
    costs: Vec<Option<f64>>,
    /// What is drawn around those of each ring.
    around: [Option<Around<'a>>; RINGS.len()],
}

impl<'a> Offer<'a> {
    /// Of a label among all that is drawn.
    pub(super) fn new(wanted: &'a Wanted, obstacles: &'a Obstacles, paper: Rect) -> Offer<'a> {
        spend();
        let around = std::array::from_fn(|_| None);
        let mut offer = Offer { wanted, obstacles, paper, places: Vec::new(), ends: Vec::new(), costs: Vec::new(), around };
        offer.up_to(0);
        offer
    }

    /// How many places there are up to the end of a ring.
    pub(super) fn up_to(&mut self, ring: usize) -> usize {
        for further in &RINGS[self.ends.len().min(ring + 1)..=ring] {
            self.places.extend(further(self.wanted).into_iter().map(|c| c.read_as(self.wanted.reads)));
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
    pub(super) fn cost(&mut self, k: usize) -> f64 {
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
    pub(super) fn cost_alone(&mut self, k: usize) -> f64 {
        let here = &self.places[k];
        let found = || Around::new(std::slice::from_ref(here), self.wanted, self.obstacles, self.paper).fixed(here);
        *self.costs[k].get_or_insert_with(found)
    }
}
