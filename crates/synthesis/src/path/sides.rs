//! The side of AE on which the crank pin B is at each place of a path.
//!
//! One side for all places is usual; a list gives it place by place, for linkages with crank and BE
//! collinear between two places. Without a given side all choices are tried, those with one side
//! first.

use crate::form::TaskForm;
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::json::NodeKind;

/// The choices of sides to try: true for left of AE, for each place.
#[derive(Clone, Debug)]
pub(super) struct Sides {
    /// The choices, each with as many entries as there are places.
    pub all: Vec<Vec<bool>>,
}

/// The words that the file uses.
const WORDS: [&str; 2] = ["left of AE", "right of AE"];

/// Reads `side`; `None` where it cannot be read.
pub(super) fn read(form: &TaskForm, places: usize) -> Option<Sides> {
    let Some(inner) = form.inner("side", &["B"]) else {
        return (!form.has("side")).then(|| Sides { all: every(places) });
    };
    let node = inner.need("B", "\"left of AE\"")?;
    if !matches!(node.kind, NodeKind::Array(_)) {
        let left = inner.choice("B", &WORDS)? == WORDS[0];
        return Some(Sides { all: vec![vec![left; places]] });
    }
    let items = inner.items("B", "[\"left of AE\", \"right of AE\", ...]", 1)?;
    let word = |n| Some(inner.choice_of(n, "B", &WORDS)? == WORDS[0]);
    let sides: Vec<Option<bool>> = items.iter().map(word).collect();
    let sides: Vec<bool> = sides.into_iter().collect::<Option<_>>()?;
    if sides.len() != places {
        let message = both!("\"B\" names {} sides for {} places", sides.len(), places);
        let help = both!("write one side for all, or one for each place");
        form.fault(Diagnostic::error("wrong-count", message).at(node.span).help(help));
        return None;
    }
    Some(Sides { all: vec![sides] })
}

/// All choices: those with one side first, then by the number of changes of side.
fn every(places: usize) -> Vec<Vec<bool>> {
    let mut all: Vec<Vec<bool>> = (0..1_usize << places)
        .map(|bits| (0..places).map(|k| bits >> k & 1 == 0).collect())
        .collect();
    let changes = |s: &Vec<bool>| s.windows(2).filter(|w| w[0] != w[1]).count();
    all.sort_by_key(changes);
    all
}

/// The choice in words.
pub(super) fn told(sides: &[bool]) -> Both {
    let word = |left: &bool| if *left { both!("left") } else { both!("right") };
    match sides {
        [first, rest @ ..] if rest.iter().all(|s| s == first) => {
            both!("B {} of AE", word(first))
        }
        _ => {
            let all: Vec<Both> = sides.iter().map(word).collect();
            both!("in turn" => "B {} of AE", Both::join(&all, [", ", "、"]))
        }
    }
}
