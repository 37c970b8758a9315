//! The order in which parameters are evaluated: a file may list them in any.

use super::expr;
use super::raw::RawQuantity;
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::json::Word;
use std::collections::{BTreeSet, HashMap, HashSet};

/// Indices of the parameters so that each comes after those that it names, otherwise in the order of the file; with a fault for each that names itself by
/// way of others, or rests on such a one: these are left out.
pub(super) fn by_dependence(parameters: &[(Word, RawQuantity)]) -> (Vec<usize>, Vec<Diagnostic>) {
    let names: Vec<&str> = parameters.iter().map(|(name, _)| name.text.as_str()).collect();
    // Of two parameters of one name, which is a fault of its own, the first is meant.
    let index: HashMap<&str, usize> = names.iter().enumerate().rev().map(|(i, name)| (*name, i)).collect();
    let mut lacks: Vec<HashSet<usize>> = Vec::with_capacity(parameters.len());
    let mut wanted_by: Vec<Vec<usize>> = vec![Vec::new(); parameters.len()];
    for (i, (_, quantity)) in parameters.iter().enumerate() {
        let named = expr::parse(&quantity.text, &names).map(|e| e.parameters().iter().filter_map(|n| index.get(n).copied()).collect());
        let named: HashSet<usize> = named.unwrap_or_default();
        named.iter().for_each(|k| wanted_by[*k].push(i));
        lacks.push(named);
    }
    let mut ready: BTreeSet<usize> = (0..parameters.len()).filter(|i| lacks[*i].is_empty()).collect();
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
            both!("parameter `{}` rests on itself, by way of {}", "参数 `{}` 经由 {} 又取决于自身", name.text, Both::names(&others));
        let d = Diagnostic::error("circular-parameter", message).at(quantity.span);
        circular.push(d.help(both!("give one of them as a number", "请把其中一个写成数值")));
    }
    (order, circular)
}
