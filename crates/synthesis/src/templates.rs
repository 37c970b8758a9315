//! Templates: a synthesis file for each kind of task, with adjustable parameters.

use hodograph_base::diag::Both;
use hodograph_templates::TASKS;

/// The names of all templates, in order.
pub fn names() -> impl Iterator<Item = &'static str> + Clone {
    TASKS.iter().map(|(name, _)| *name)
}

/// The text of a template; `None` for an unknown name.
///
/// ```
/// let text = hodograph_synthesis::templates::get("time-ratio").unwrap();
/// assert!(hodograph_synthesis::read(text).is_ok());
/// ```
pub fn get(name: &str) -> Option<&'static str> {
    TASKS.iter().find(|(n, _)| *n == name).map(|(_, text)| *text)
}

/// The title of a template.
pub fn title(name: &str) -> Both {
    let task = get(name).and_then(|text| super::read(text).ok());
    task.map(|t| t.value.heading.title).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{KINDS, construct, read, solve};

    #[test]
    fn every_kind_has_a_template_that_is_solved_without_defect_and_drawn() {
        for kind in KINDS {
            let text = get(kind.name).unwrap_or_else(|| {
                panic!("add templates/synthesis/{}.json to the list", kind.name)
            });
            let task = read(text).unwrap_or_else(|f| panic!("{}: {f}", kind.name));
            assert_eq!(task.notes, [], "{}", kind.name);
            let design = solve(&task.value).unwrap_or_else(|f| panic!("{}: {f}", kind.name));
            let best = &design.candidates[0];
            assert_eq!(best.judged.defects, [], "{}", kind.name);
            // Its proportions are given: nothing is constructed.
            if kind.name == "straight-line" {
                continue;
            }
            let board =
                construct(&task.value, best, 1e-3).unwrap_or_else(|f| panic!("{}: {f}", kind.name));
            assert!(
                board.is_some_and(|b| b.steps.len() > 1 && !b.readings.is_empty()),
                "{}",
                kind.name
            );
        }
    }
}
