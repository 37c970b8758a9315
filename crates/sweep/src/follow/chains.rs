//! Follows a mechanism from one position of its driver to the next, in pieces; the states do not
//! depend on the pieces.
//!
//! Each state is computed from the one before it, so the rows of a sweep form chains: one from the
//! driver's start upward and one downward, which runs backward in the table. A chain keeps its
//! state at every [`STRIDE`]-th position (checkpoints), so that any part of it can be computed
//! again without the whole; the memory is that of these states. A crank that is stopped in one
//! sense may reach a position in the other: positions beyond a chain's end are searched from there,
//! in chains of the same kind.

use hodograph_base::diag::Faults;
use std::f64::consts::TAU;
use std::ops::Range;

/// A motion to follow.
pub(crate) trait Follow {
    /// The state of everything that is followed.
    type State: Clone;

    /// Returns the state at the driver's start; `None` if the pose does not fit.
    fn start(&self) -> Option<Self::State>;

    /// Returns the state at a value of the driver, reached from another without a jump; else the
    /// last one that was reached.
    fn advance(&self, from: &Self::State, value: f64) -> Result<Self::State, Self::State>;

    /// The reason why the mechanism stops on its way to a value, after the last state that was
    /// reached (`None`: at the start already).
    fn stopped(&self, last: Option<&Self::State>, toward: f64) -> Faults;

    /// True if a position recurs after a turn of the driver.
    fn turns(&self) -> bool;
}

/// The number of positions from one kept state to the next.
pub(crate) const STRIDE: usize = 4096;

/// Positions in the order in which they are reached, each from the one before.
struct Chain<S> {
    /// The positions; their values ascend.
    positions: Range<usize>,
    /// True if the last position is reached first.
    backward: bool,
    /// The summand of each value: a turn, for positions that are reached in the other sense.
    shift: f64,
    /// The number of positions reached so far, and the state at the last of them.
    front: (usize, S),
    /// The state before every [`STRIDE`]-th step, as far as it was reached.
    kept: Vec<S>,
    /// The reason why no more positions can be reached.
    end: Option<Faults>,
    /// The chains in which the rest is then searched.
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
pub(crate) type ValueFunction<'a> = &'a dyn Fn(usize) -> f64;

/// The receiver of each position's state, or of the reason why there is none.
type Visit<'a, S> = &'a mut dyn FnMut(usize, Result<&S, &Faults>);

impl<F: Follow> Chains<F> {
    /// Prepares a course through `count` positions from the driver's value `start`.
    pub fn new(follow: F, start: f64, count: usize, values: ValueFunction) -> Chains<F> {
        let first = follow.start();
        let chains = first
            .as_ref()
            .map_or_else(Vec::new, |first| outward(first, start, 0..count, 0.0, values));
        Chains { follow, start, first, chains }
    }

    /// Returns the motion that is followed.
    pub fn follow(&self) -> &F {
        &self.follow
    }

    /// Shows the state at each of some positions, in any order, or the reason why there is none.
    /// Stops early and returns `false` if `stop` asks for it.
    pub fn states(
        &mut self,
        part: Range<usize>,
        values: ValueFunction,
        stop: &dyn Fn() -> bool,
        visit: Visit<F::State>,
    ) -> bool {
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
            // The reader needs the reason why the direct way ends.
            lost.iter().flat_map(|rest| overlap(rest, &part)).for_each(|p| visit(p, Err(&why)));
        }
        true
    }

    /// The last states of the direct ways from the start, downward and upward, that were found to
    /// end.
    pub fn ended(&self) -> impl Iterator<Item = &F::State> {
        self.chains.iter().rev().filter(|c| c.end.is_some()).map(|c| &c.front.1)
    }
}

/// The chains upward and downward from the start, through positions with ascending values.
fn outward<S: Clone>(
    first: &S,
    start: f64,
    positions: Range<usize>,
    shift: f64,
    values: ValueFunction,
) -> Vec<Chain<S>> {
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
    /// The position of a step.
    fn position(&self, step: usize) -> usize {
        if self.backward { self.positions.end - 1 - step } else { self.positions.start + step }
    }

    /// The positions that are not reached, once the end is known.
    fn rest(&self) -> Option<Range<usize>> {
        let Range { start, end } = self.positions;
        self.end.as_ref().map(|_| {
            if self.backward { start..end - self.front.0 } else { start + self.front.0..end }
        })
    }

    /// Follows as far as the requested positions, or repeats a part of the chain, and shows the
    /// positions that are reached.
    fn walk<F: Follow<State = S>>(
        &mut self,
        follow: &F,
        part: &Range<usize>,
        values: ValueFunction,
        stop: &dyn Fn() -> bool,
        visit: Visit<S>,
    ) -> bool {
        let mine = overlap(&self.positions, part);
        if mine.is_empty() {
            return true;
        }
        let Range { start, end } = self.positions;
        let steps = if self.backward {
            end - mine.end..end - mine.start
        } else {
            mine.start - start..mine.end - start
        };
        // Steps already passed are repeated from the last kept state.
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
                    // The last state gives the place of the stop.
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
