//! Evaluates answers together although some of them may depend on a group that does not close.

use super::ladder::MissingDigits;
use hodograph_base::diag::Diagnostic;
use hodograph_mechanism::mechanism::Demand;

/// A function that evaluates some answers together.
type AnswerEvaluation<'a, T> =
    &'a dyn Fn(&[usize]) -> Result<Vec<Result<T, MissingDigits>>, Diagnostic>;

/// Evaluates some answers together. One group that does not close must not remove the answers of
/// the others: the first such group is found by halving, because those before it close; answers
/// that depend on it are refused, and the rest is evaluated again.
pub(super) fn apart<T>(
    open: &[usize],
    look: AnswerEvaluation<T>,
    demand: &dyn Fn(&[usize]) -> Demand,
    closes: &dyn Fn(&Demand) -> Result<(), Diagnostic>,
) -> Vec<Result<T, MissingDigits>> {
    let mut out: Vec<Option<Result<T, MissingDigits>>> = open.iter().map(|_| None).collect();
    let mut left: Vec<usize> = (0..open.len()).collect();
    while !left.is_empty() {
        let these: Vec<usize> = left.iter().map(|k| open[*k]).collect();
        let mut why = match look(&these) {
            Ok(seen) => {
                left.drain(..).zip(seen).for_each(|(k, seen)| out[k] = Some(seen));
                break;
            }
            Err(why) => why,
        };
        let whole = demand(&these);
        let first = |groups: usize| {
            let mut part = whole.clone();
            part.groups[groups..].fill(None);
            closes(&part).err()
        };
        let (mut sound, mut broken) = (0, whole.groups.len());
        while broken - sound > 1 {
            let middle = sound + (broken - sound) / 2;
            match first(middle) {
                Some(fault) => (broken, why) = (middle, fault),
                None => sound = middle,
            }
        }
        let rests = |k: &usize| demand(&[open[*k]]).groups.get(sound).is_some_and(Option::is_some);
        let (mut lost, rest): (Vec<usize>, Vec<usize>) = left.iter().copied().partition(rests);
        if lost.is_empty() {
            // The fault is not a group that does not close: no requested answer can be given.
            lost.clone_from(&left);
            left.clear();
        } else {
            left = rest;
        }
        lost.into_iter().for_each(|k| out[k] = Some(Err(MissingDigits::Refused(why.clone()))));
    }
    out.into_iter().map(|seen| seen.unwrap_or(Err(MissingDigits::NoValue))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use hodograph_base::diag::Both;
    use hodograph_mechanism::mechanism::Level;
    use std::cell::Cell;

    /// A chain of groups, each dependent on the one before it, with one that does not close:
    /// answers that depend on it are refused, the rest is given, and the number of times that
    /// positions are found grows with the logarithm of the chain's length.
    #[test]
    fn a_group_that_does_not_close_takes_only_what_rests_on_it() {
        for n in [1, 2, 50, 100, 200, 400] {
            for bad in [0, n / 3, n - 1, n] {
                let tried = Cell::new(0);
                let demand = |open: &[usize]| {
                    let deepest = open.iter().max().map_or(0, |k| k + 1);
                    let groups = (0..n).map(|g| (g < deepest).then_some(Level::Velocity)).collect();
                    Demand { groups, level: Level::Velocity, needs: Vec::new() }
                };
                let closes = |demand: &Demand| {
                    tried.set(tried.get() + 1);
                    let wanted = demand.groups.get(bad).copied().flatten();
                    wanted.map_or(Ok(()), |_| {
                        Err(Diagnostic::error(
                            "cannot-assemble",
                            Both::same(format!("group {bad}")),
                        ))
                    })
                };
                let look = |open: &[usize]| {
                    closes(&demand(open)).map(|()| open.iter().map(|k| Ok(*k)).collect())
                };
                let open: Vec<usize> = (0..n).collect();
                let seen = apart(&open, &look, &demand, &closes);
                for (k, seen) in seen.iter().enumerate() {
                    match seen {
                        Ok(_) => assert!(k < bad, "{n} groups, {bad} does not close: {k} is told"),
                        Err(MissingDigits::Refused(d)) => {
                            assert!(k >= bad && d.message.en == format!("group {bad}"), "{d}")
                        }
                        Err(why) => panic!("{why:?}"),
                    }
                }
                assert!(
                    tried.get() <= 4 + n.ilog2() as usize + 1,
                    "{n} groups, {bad} does not close: {} trials",
                    tried.get()
                );
            }
        }
    }
}
