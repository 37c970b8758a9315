//! Joined names in questions, separated with the names that the scene declares.

use super::*;

#[test]
fn names_that_overlap() {
    // With O and O2 declared, O2 is the point; the point of link 2 at O needs its partner or a
    // comma.
    let scene = |find: &str| {
        format!(
            r#"{{"links": {{"1": ["O", "O2"], "2": ["O2", "AB", "A"], "4": ["O", "B", "BB"]}}, "ground": "4",
            "driver": {{"link": "1", "omega": "1 rad/s"}}, "find": ["{find}"]}}"#
        )
    };
    let asked = |find: &str| written(&good(&scene(find)).find[0].what);
    let on = |point: usize, link: Option<usize>| OnLink {
        point: PointId(point),
        link: link.map(LinkId),
    };
    assert_eq!(asked("v_O2"), ("v", Of::Point(on(1, None))));
    assert_eq!(asked("v_O1"), ("v", Of::Point(on(0, Some(0)))));
    assert_eq!(asked("v_AB"), ("v", Of::Point(on(2, None))));
    assert_eq!(asked("v_A,B"), ("v", Of::Points(on(3, None), on(4, None))));
    assert_eq!(asked("v_AB4B2"), ("v", Of::Points(on(2, Some(2)), on(4, Some(1)))));
    assert_eq!(
        faults(&scene("l_ABB")),
        "[\"l_ABB\"] `ABB` can be read in 2 ways (write \"A,BB\" or \"AB,B\")\n"
    );
}

mod any_input {
    use super::*;
    use crate::templates;
    use proptest::prelude::*;

    /// Reads and prints the result or the faults: neither may panic, and every place must be within
    /// the text.
    fn survives(source: &[u8]) {
        if let Err(faults) = read(source) {
            assert!(faults.has_errors() && !faults.to_string().is_empty());
            if let Ok(text) = std::str::from_utf8(source) {
                for span in faults.list.iter().filter_map(|d| d.span) {
                    assert!(text.get(span.start..span.end).is_some(), "{span:?} in {text}");
                }
            }
        }
    }

    /// Pieces of scenes and expressions, for mutations that pass the first checks.
    const PIECES: &[&str] = &[
        "{}",
        "[]",
        "\"\"",
        "null",
        "true",
        "0",
        "-1",
        "1e999",
        "1e-999",
        "\"A\"",
        "\"AB\"",
        "\"4\"",
        "\"60 deg\"",
        "\"1 mm\"",
        "\"((1))\"",
        "\"-\"",
        "\"2^2^2\"",
        "\"1/0\"",
        "\"l_AB\"",
        "\"曲柄\"",
        "\"\\u0041\"",
        "[0, 0]",
        "{\"base\": \"BC\", \"x\": 0, \"y\": 0}",
        "{\"link\": \"4\"}",
        "\"left of AB\"",
    ];

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(300) })]

        #[test]
        fn random_bytes(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
            survives(&bytes);
        }

        #[test]
        fn mutated_bytes(edits in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4), which in any::<prop::sample::Index>()) {
            let all = templates::list();
            let mut bytes = templates::get(all[which.index(all.len())].name).unwrap().as_bytes().to_vec();
            for (at, byte) in edits {
                let at = at.index(bytes.len());
                bytes[at] = byte;
            }
            survives(&bytes);
        }

        #[test]
        fn exchanged_strings(edits in proptest::collection::vec((any::<prop::sample::Index>(), prop::sample::select(PIECES)), 1..3), which in any::<prop::sample::Index>()) {
            let all = templates::list();
            let mut text = templates::get(all[which.index(all.len())].name).unwrap().to_owned();
            for (at, piece) in edits {
                let quotes: Vec<usize> = text.match_indices('"').map(|(i, _)| i).collect();
                let i = at.index(quotes.len().max(2) / 2) * 2;
                if let (Some(a), Some(b)) = (quotes.get(i), quotes.get(i + 1)) {
                    text.replace_range(*a..=*b, piece);
                }
            }
            survives(text.as_bytes());
        }

        #[test]
        fn random_expressions(text in "[-+*/^()0-9a-z. °πpi]{0,40}") {
            let source = with("lengths", &format!("{{\"AB\": \"{text}\"}}"));
            survives(source.as_bytes());
        }
    }
}
