//! Decomposition of a system into square blocks, in an order in which they can be solved.
//!
//! Each equation is matched with one of its unknowns; an unknown then depends on the other unknowns
//! of its equation. Unknowns that depend on each other form one block. The values of the
//! coefficients have no influence, only the occurrence of unknowns in equations.
//!
//! # Source
//! The fine decomposition of A. L. Dulmage and N. S. Mendelsohn; strong components by R. E. Tarjan,
//! *Depth-first search and linear graph algorithms*, SIAM J. Comput. 1 (1972).

use super::relation::EquationRow;

/// A set of equations with as many unknowns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct EquationBlock {
    /// Indices of the equations, ascending.
    pub rows: Vec<usize>,
    /// Indices of the unknowns, ascending.
    pub unknowns: Vec<usize>,
}

/// Returns the blocks of a square system of `n` unknowns; the whole system as one block if the
/// unknowns allow no matching.
pub(super) fn blocks(rows: &[EquationRow], n: usize) -> Vec<EquationBlock> {
    let lists: Vec<Vec<usize>> = rows
        .iter()
        .map(|r| {
            let mut of: Vec<usize> = r.coefficients.iter().map(|c| c.0).collect();
            of.sort_unstable();
            of.dedup();
            of
        })
        .collect();
    of_lists(&lists, n)
}

pub(super) fn of_lists(lists: &[Vec<usize>], n: usize) -> Vec<EquationBlock> {
    let mut row_of: Vec<Option<usize>> = vec![None; n];
    for r in 0..lists.len() {
        if !matched(r, lists, &mut row_of, &mut vec![false; n]) {
            return vec![EquationBlock {
                rows: (0..lists.len()).collect(),
                unknowns: (0..n).collect(),
            }];
        }
    }
    let rests_on: Vec<&[usize]> =
        row_of.iter().map(|r| r.map_or(&[][..], |r| &lists[r][..])).collect();
    let mut search = ComponentSearch {
        rests_on: &rests_on,
        found: vec![0; n],
        low: vec![0; n],
        open: vec![false; n],
        stack: Vec::new(),
        count: 0,
        out: Vec::new(),
    };
    for u in 0..n {
        if search.found[u] == 0 {
            search.visit(u);
        }
    }
    let block = |mut unknowns: Vec<usize>| {
        unknowns.sort_unstable();
        let mut rows: Vec<usize> = unknowns.iter().filter_map(|u| row_of[*u]).collect();
        rows.sort_unstable();
        EquationBlock { rows, unknowns }
    };
    search.out.into_iter().map(block).collect()
}

/// Finds an unknown for row `r`, and moves earlier rows to other unknowns of theirs if necessary.
fn matched(
    r: usize,
    lists: &[Vec<usize>],
    row_of: &mut [Option<usize>],
    seen: &mut [bool],
) -> bool {
    for &u in &lists[r] {
        if seen[u] {
            continue;
        }
        seen[u] = true;
        let free = match row_of[u] {
            None => true,
            Some(other) => matched(other, lists, row_of, seen),
        };
        if free {
            row_of[u] = Some(r);
            return true;
        }
    }
    false
}

/// Tarjan's search; it returns components after those on which they depend.
struct ComponentSearch<'a> {
    rests_on: &'a [&'a [usize]],
    /// 1 + the number of unknowns found before; 0 if not yet found.
    found: Vec<usize>,
    low: Vec<usize>,
    open: Vec<bool>,
    stack: Vec<usize>,
    count: usize,
    out: Vec<Vec<usize>>,
}

impl ComponentSearch<'_> {
    fn visit(&mut self, u: usize) {
        self.count += 1;
        self.found[u] = self.count;
        self.low[u] = self.count;
        self.open[u] = true;
        self.stack.push(u);
        for &w in self.rests_on[u] {
            if self.found[w] == 0 {
                self.visit(w);
                self.low[u] = self.low[u].min(self.low[w]);
            } else if self.open[w] {
                self.low[u] = self.low[u].min(self.found[w]);
            }
        }
        if self.low[u] == self.found[u] {
            let from = self.stack.iter().rposition(|w| *w == u).unwrap_or(0);
            let component = self.stack.split_off(from);
            for w in &component {
                self.open[*w] = false;
            }
            self.out.push(component);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_rests_on_each_other_is_one_block() {
        // 0 and 1 together, 2 depends on 1, 3 alone.
        let blocks = of_lists(&[vec![0, 1], vec![1, 2], vec![0, 1], vec![3]], 4);
        let unknowns: Vec<&[usize]> = blocks.iter().map(|b| &b.unknowns[..]).collect();
        assert_eq!(unknowns, [&[0, 1][..], &[2], &[3]]);
        assert_eq!(blocks[0].rows, [0, 2]);
        assert_eq!(of_lists(&[vec![0], vec![0]], 2).len(), 1, "no matching: one block");
    }
}
