//! Following a mechanism from one position of its driver to the next, in pieces, with the same states whatever pieces are asked for.
//!
//! Each state is computed from the one before it, so the rows of a sweep form chains: one from where the driver stands upward, one downward, which is
//! backward in the table. A chain keeps its state at every [`STRIDE`]-th position (checkpoints), so that any part of it can be computed again without
//! the whole; memory is that of these states. A crank that is stopped on one way round may reach a position on the other: what lies beyond a chain's
//! end is looked for from there, in chains of the same kind.

use hodograph_base::diag::Faults;
use std::f64::consts::TAU;
use std::ops::Range;

/// What is followed.
pub(crate) trait Follow {
    /// Where everything that is followed stands.
    type State: Clone;

    /// The state where the driver stands; `None` where the pose does not fit.
    fn start(&self) -> Option<Self::State>;

    /// The state at a value of the driver, reached from another without a jump; else the last one that was reached.
    fn advance(&self, from: &Self::State, value: f64) -> Result<Self::State, Self::State>;

    /// Why the mechanism stops on its way to a value, after the last state that was reached (`None`: at the start already).
    fn stopped(&self, last: Option<&Self::State>, toward: f64) -> Faults;

    /// Whether a position comes again after a turn of the driver.
    fn turns(&self) -> bool;
}

/// Positions between two states that are kept.
pub(crate) const STRIDE: usize = 4096;

/// Positions in the order in which they are reached, one from the other.
struct Chain<S> {
    /// Which; their values ascend.
    positions: Range<usize>,
    /// Whether the last one is reached first.
    backward: bool,
    /// What is added to each value: a turn, for positions that are reached on the other way round.
    shift: f64,
    /// How many have been reached, and the state at the last of them.
    front: (usize, S),
    /// The state before every [`STRIDE`]-th step, as far as it was reached.
    kept: Vec<S>,
    /// Why no more of them are reached than have been.
    end: Option<Faults>,
    /// Where the rest is looked for then.
    beyond: Vec<Chain<S>>,
}

/// A mechanism on its way through values of its driver, which ascend with their positions.
pub(crate) struct Chains<F: Follow> {
    follow: F,
    start: f64,
    first: Option<F::State>,
    chains: Vec<Chain<F::State>>,
}

/// The value at each position.
pub(crate) type Values<'a> = &'a dyn Fn(usize) -> f64;

/// What becomes of a position.
type Visit<'a, S> = &'a mut dyn FnMut(usize, Result<&S, &Faults>);

impl<F: Follow> Chains<F> {
    /// A course through `count` positions from where the driver stands, `start`.
    pub fn new(follow: F, start: f64, count: usize, values: Values) -> Chains<F> {
        let first = follow.start();
        let chains = first.as_ref().map_or_else(Vec::new, |first| outward(first, start, 0..count, 0.0, values));
        Chains { follow, start, first, chains }
    }

    /// What is followed.
    pub fn follow(&self) -> &F {
        &self.follow
    }

    /// Shows the state at each of some positions, in no order, or why there is none. Comes to an early end, and says false, when
    /// asked to stop.
    pub fn states(&mut self, part: Range<usize>, values: Values, stop: &dyn Fn() -> bool, visit: Visit<F::State>) -> bool {
        let Some(first) = &self.first else {
            let why = self.follow.stopped(None, self.start);
            part.for_each(|p| visit(p, Err(&why)));
            return true;
        };
        for chain in &mut self.chains {
            if !chain.walk(&self.follow, &part, values, stop, visit) {
                return false;
            }
            let Some((rest, why)) = chain.rest().zip(chain.end.clone()) else { continue };
            if chain.beyond.is_empty() && self.follow.turns() {
                let shift = if chain.backward { TAU } else { -TAU };
                chain.beyond = outward(first, self.start, rest.clone(), shift, values);
            }
            let mut lost = vec![rest];
            if !chain.beyond.is_empty() {
                lost.clear();
                for other in &mut chain.beyond {
                    if !other.walk(&self.follow, &part, values, stop, visit) {
                        return false;
                    }
                    lost.extend(other.rest());
                }
            }
            // Why the way there directly ends is what the reader asks first.
            lost.iter().flat_map(|rest| overlap(rest, &part)).for_each(|p| visit(p, Err(&why)));
        }
        true
    }

    /// The last states of the ways directly from the start, downward and upward, that have been found to end.
    pub fn ended(&self) -> impl Iterator<Item = &F::State> {
        self.chains.iter().rev().filter(|c| c.end.is_some()).map(|c| &c.front.1)
    }
}

/// The chains upward and downward from the start, through positions whose values ascend.
fn outward<S: Clone>(first: &S, start: f64, positions: Range<usize>, shift: f64, values: Values) -> Vec<Chain<S>> {
    // The first position that is not below the start.
    let (mut low, mut high) = (positions.start, positions.end);
    while low < high {
        let middle = low + (high - low) / 2;
        if values(middle) + shift < start { low = middle + 1 } else { high = middle }
    }
    let chain = |positions: Range<usize>, backward| Chain {
        positions,
        backward,
        shift,
        front: (0, first.clone()),
        kept: Vec::new(),
        end: None,
        beyond: Vec::new(),
    };
    let both = [chain(low..positions.end, false), chain(positions.start..low, true)];
    both.into_iter().filter(|c| !c.positions.is_empty()).collect()
}

fn overlap(a: &Range<usize>, b: &Range<usize>) -> Range<usize> {
    let from = a.start.max(b.start);
    from..a.end.min(b.end).max(from)
}

impl<S: Clone> Chain<S> {
    /// The position that is reached in a step.
    fn position(&self, step: usize) -> usize {
        if self.backward { self.positions.end - 1 - step } else { self.positions.start + step }
    }

    /// The positions that are not reached, once the end is known.
    fn rest(&self) -> Option<Range<usize>> {
        let Range { start, end } = self.positions;
        self.end.as_ref().map(|_| if self.backward { start..end - self.front.0 } else { start + self.front.0..end })
    }

    /// Follows as far as the positions asked for, or over them again, and shows those of them that are reached.
    fn walk<F: Follow<State = S>>(
        &mut self,
        follow: &F,
        part: &Range<usize>,
        values: Values,
        stop: &dyn Fn() -> bool,
        visit: Visit<S>,
    ) -> bool {
        let mine = overlap(&self.positions, part);
        if mine.is_empty() {
            return true;
        }
        let Range { start, end } = self.positions;
        let steps = if self.backward { end - mine.end..end - mine.start } else { mine.start - start..mine.end - start };
        // What has been passed is gone over again, from the last state that was kept.
        let (mut step, mut state) = match self.front.0 <= steps.start {
            true => self.front.clone(),
            false => (steps.start / STRIDE * STRIDE, self.kept[steps.start / STRIDE].clone()),
        };
        let last = if self.end.is_some() { steps.end.min(self.front.0) } else { steps.end };
        while step < last {
            if step == STRIDE * self.kept.len() {
                self.kept.push(state.clone());
            }
            if stop() {
                return false;
            }
            let value = values(self.position(step)) + self.shift;
            match follow.advance(&state, value) {
                Ok(reached) => state = reached,
                Err(reached) => {
                    self.end = Some(follow.stopped(Some(&reached), value));
                    // The last state tells where it stops.
                    self.front = (step, reached);
                    return true;
                }
            }
            if step >= steps.start {
                visit(self.position(step), Ok(&state));
            }
            step += 1;
        }
        if step > self.front.0 {
            self.front = (step, state);
        }
        true
    }
}
