//! Tests of the table of quantities.

use super::*;
use crate::{Scene, read};

/// A four-bar linkage whose coupler point moves a slider, with these questions.
fn asking(find: &str) -> Scene {
    let text = format!(
        r#"{{"links": {{"1": ["A", "B"], "2": ["B", "C", "E"], "3": ["C", "D"], "4": ["A", "D"], "6": ["E", "F"]}}, "ground": "4",
 "lengths": {{"AB": "100 mm", "BC": "250 mm", "CD": "200 mm", "AD": "300 mm", "BE": "150 mm", "CE": "140 mm", "EF": "400 mm"}},
 "guides": [{{"pin": "F", "slider": "5", "on": "4", "through": "A", "angle": "0 deg"}}],
 "driver": {{"link": "1", "angle": "60 deg", "omega": "10 rad/s"}}, "find": [{find}]}}"#
    );
    read(text).unwrap_or_else(|f| panic!("{f}")).value
}

#[test]
fn every_line_is_read_from_its_example() {
    let lines: Vec<&Entry> = TABLES.iter().copied().flatten().collect();
    assert!(lines.len() >= 15, "only {} lines", lines.len());
    for line in lines {
        let scene = asking(&format!("\"{}\"", line.example));
        assert_eq!(scene.find[0].what.entry(), line, "{}", line.example);
        // The power has no names.
        assert_eq!(line.example.split_once('_').map_or(line.example, |e| e.0), line.symbol);
    }
}

#[test]
fn lines_of_one_symbol_are_of_one_kind() {
    let has_names = |line: &&Entry| line.example != line.symbol;
    for line in TABLES.iter().copied().flatten().filter(has_names) {
        let first = symbols().into_iter().find(|e| e.symbol == line.symbol).unwrap();
        // P_13 is a place, P_13D a distance from it.
        assert_eq!(
            (line.kind, line.letter, line.over),
            (first.kind, first.letter, first.over),
            "{}",
            line.example
        );
    }
}
