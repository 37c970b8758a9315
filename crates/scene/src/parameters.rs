//! The order of evaluation of parameters: a file may list them in any order.

use super::expr;
use super::raw::RawQuantity;
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::json::Word;
use std::collections::{BTreeSet, HashMap, HashSet};

/// Returns indices of the parameters so that each comes after those in its expression, otherwise in
/// the order of the file. Parameters that depend on themselves, and those that depend on such
/// parameters, are omitted, each with a fault.
pub(super) fn by_dependence(parameters: &[(Word, RawQuantity)]) -> (Vec<usize>, Vec<Diagnostic>) {
    let names: Vec<&str> = parameters.iter().map(|(name, _)| name.text.as_str()).collect();
    // If two parameters have the same name, which is a fault of its own, the first one counts.
    let index: HashMap<&str, usize> =
        names.iter().enumerate().rev().map(|(i, name)| (*name, i)).collect();
    let mut lacks: Vec<HashSet<usize>> = Vec::with_capacity(parameters.len());
    let mut wanted_by: Vec<Vec<usize>> = vec![Vec::new(); parameters.len()];
    for (i, (_, quantity)) in parameters.iter().enumerate() {
        let named = expr::parse(&quantity.text, &names)
            .map(|e| e.parameters().iter().filter_map(|n| index.get(n).copied()).collect());
        let named: HashSet<usize> = named.unwrap_or_default();
        named.iter().for_each(|k| wanted_by[*k].push(i));
        lacks.push(named);
    }
    let mut ready: BTreeSet<usize> =
        (0..parameters.len()).filter(|i| lacks[*i].is_empty()).collect();
    let mut order = Vec::with_capacity(parameters.len());
    while let Some(i) = ready.pop_first() {
        order.push(i);
        for k in std::mem::take(&mut wanted_by[i]) {
            lacks[k].remove(&i);
            if lacks[k].is_empty() {
                ready.insert(k);
            }
        }
    }
    let mut circular = Vec::new();
    for (i, (name, quantity)) in parameters.iter().enumerate() {
        if lacks[i].is_empty() {
            continue;
        }
        let mut others: Vec<usize> = lacks[i].iter().copied().collect();
        others.sort_unstable();
        let others: Vec<&str> = others.into_iter().map(|k| names[k]).collect();
        let message =
            both!("parameter `{}` rests on itself, by way of {}", name.text, Both::names(&others));
        let d = Diagnostic::error("circular-parameter", message).at(quantity.span);
        circular.push(d.help(both!("give one of them as a number")));
    }
    (order, circular)
}
