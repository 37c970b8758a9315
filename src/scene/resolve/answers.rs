//! The section `answers`: the units in which is printed.

use super::*;
use crate::scene::book::{Book, BookUnit, Kind};

pub(super) fn book(raw: &RawScene, faults: &mut Faults) -> Book {
    let mut book = Book::default();
    for (key, unit) in &raw.answers {
        let kind = Kind::ALL.into_iter().find(|k| k.wanted().key() == Some(key.text.as_str()));
        let Some(kind) = kind else {
            let d = Diagnostic::error("unknown-key", format!("`{}` is not a quantity of \"answers\"", key.text)).at(key.span);
            faults.push(d.help(suggest(&key.text, Wanted::TABLE.iter().map(|(k, _)| *k), "the quantities are")));
            continue;
        };
        match BookUnit::read(&unit.text, kind) {
            Ok(unit) => book.set(kind, unit),
            Err(fitting) => {
                let d = Diagnostic::error("unit", format!("`{}` is not a unit of {}", unit.text, kind.wanted().describe())).at(unit.span);
                let min = if kind.wanted().dim().time == 0 { "" } else { "; min and h may stand for s" };
                faults.push(d.help(format!("units that fit are {}{min}", fitting.join(", "))));
            }
        }
    }
    book
}
