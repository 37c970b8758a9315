//! The candidate places of a label with their individual costs.

use super::MeasuredRequest;
use super::candidate::{self, CandidatePlace};
use super::cost::Around;
use super::obstacle::Obstacles;
use crate::paper::extent::Rect;
use hodograph_base::budget::spend;

/// Rings of places, from near to far: without a leader line, with one, with a long one, with one in
/// an intermediate direction, with one to any part of the target.
pub(super) const RINGS: [fn(&MeasuredRequest) -> Vec<CandidatePlace>; 5] =
    [candidate::near, candidate::far, candidate::farthest, candidate::between, candidate::anywhere];

/// The places of a label and their individual costs, computed on demand. They are reused when a
/// label is searched again without some of its neighbours, which does not change these costs.
pub(super) struct Offer<'a> {
    wanted: &'a MeasuredRequest,
    obstacles: &'a Obstacles,
    paper: Rect,
    /// The places near the target, followed by those of further rings once a search needs them.
    pub(super) places: Vec<CandidatePlace>,
    /// Number of places up to the end of each ring found so far.
    ends: Vec<usize>,
    costs: Vec<Option<f64>>,
    /// The obstacles around the places of each ring.
    around: [Option<Around<'a>>; RINGS.len()],
}

impl<'a> Offer<'a> {
    /// Returns the places of a label among the obstacles.
    pub(super) fn new(
        wanted: &'a MeasuredRequest,
        obstacles: &'a Obstacles,
        paper: Rect,
    ) -> Offer<'a> {
        spend();
        let around = std::array::from_fn(|_| None);
        let mut offer = Offer {
            wanted,
            obstacles,
            paper,
            places: Vec::new(),
            ends: Vec::new(),
            costs: Vec::new(),
            around,
        };
        offer.up_to(0);
        offer
    }

    /// Returns the number of places up to the end of a ring.
    pub(super) fn up_to(&mut self, ring: usize) -> usize {
        for further in &RINGS[self.ends.len().min(ring + 1)..=ring] {
            self.places
                .extend(further(self.wanted).into_iter().map(|c| c.read_as(self.wanted.reads)));
            self.ends.push(self.places.len());
        }
        self.costs.resize(self.places.len(), None);
        self.ends[ring]
    }

    /// Returns a place by its index, if there is one.
    pub(super) fn place(&mut self, index: usize) -> Option<CandidatePlace> {
        let mut ring = 0;
        while index >= self.up_to(ring) {
            ring += 1;
            if ring == RINGS.len() {
                return None;
            }
        }
        Some(self.places[index])
    }

    /// Returns the ring of a place, and the range of that ring's places.
    fn ring(&self, k: usize) -> (usize, std::ops::Range<usize>) {
        let ring = self.ends.partition_point(|end| *end <= k);
        (ring, if ring == 0 { 0 } else { self.ends[ring - 1] }..self.ends[ring])
    }

    /// Returns the cost of a place; efficient if the costs of most places of its ring are
    /// requested.
    pub(super) fn cost(&mut self, k: usize) -> f64 {
        if let Some(cost) = self.costs[k] {
            return cost;
        }
        let (ring, alike) = self.ring(k);
        let alike = &self.places[alike];
        let around = self.around[ring]
            .get_or_insert_with(|| Around::new(alike, self.wanted, self.obstacles, self.paper));
        let cost = around.fixed(&self.places[k]);
        self.costs[k] = Some(cost);
        cost
    }

    /// Returns the cost of a place; efficient if few others are requested.
    pub(super) fn cost_alone(&mut self, k: usize) -> f64 {
        let here = &self.places[k];
        let found = || {
            Around::new(std::slice::from_ref(here), self.wanted, self.obstacles, self.paper)
                .fixed(here)
        };
        *self.costs[k].get_or_insert_with(found)
    }
}
