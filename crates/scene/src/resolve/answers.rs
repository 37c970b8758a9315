//! The section `answers`: the units of printed quantities.

use super::*;
use crate::book::{Book, BookUnit};
use hodograph_base::kind::Kind;

pub(super) fn book(raw: &RawScene, faults: &mut Faults) -> Book {
    let mut book = Book::default();
    for (key, unit) in &raw.answers {
        let kind = Kind::ALL
            .into_iter()
            .find(|k| RequiredQuantity::of(*k).key() == Some(key.text.as_str()));
        let Some(kind) = kind else {
            let d = Diagnostic::error(
                "unknown-key",
                both!("`{}` is not a quantity of \"answers\"", key.text),
            )
            .at(key.span);
            faults.push(d.help(suggest(
                &key.text,
                Kind::ALL.iter().filter_map(|k| RequiredQuantity::of(*k).key()),
                both!("the quantities are"),
            )));
            continue;
        };
        match BookUnit::read(&unit.text, kind) {
            Ok(unit) => book.set(kind, unit),
            Err(fitting) => {
                let d = Diagnostic::error(
                    "unit",
                    both!(
                        "`{}` is not a unit of {}",
                        unit.text,
                        RequiredQuantity::of(kind).describe()
                    ),
                )
                .at(unit.span);
                let min = if RequiredQuantity::of(kind).dim().time == 0 {
                    Both::default()
                } else {
                    both!("; min and h may stand for s")
                };
                faults.push(d.help(both!("units that fit are {}{}", Both::names(&fitting), min)));
            }
        }
    }
    book
}
