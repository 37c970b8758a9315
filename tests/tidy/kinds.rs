//! Files that match the kinds of growing enumerations.

use super::{code, finish, word, words};

/// Enumerations with growing kinds: the kinds (all if none is named), the files and folders that
/// match them, and the alternative for others. Kinds of pair are not among them: they are private
/// to `mechanism/pair`. The lists only shrink.
type Kinds = (&'static str, &'static [&'static str], &'static [&'static str], &'static str);
const KINDS: &[Kinds] = &[
    (
        "Leg",
        &[],
        &["crates/mechanism/src/mechanism/groups.rs", "crates/mechanism/src/mechanism/leg.rs"],
        "Leg::gives, hold or line",
    ),
    (
        "DriverKind",
        &[],
        &[
            "crates/scene/src/",
            "crates/mechanism/src/mechanism/survey.rs",
            "crates/mechanism/src/stated/",
            "crates/methods/src/centres/",
            "crates/figure/src/mechanism/marks.rs",
            "src/lesson/page.rs",
            "crates/report/src/given.rs",
            "crates/report/src/plan_json.rs",
        ],
        "DriverKind::turns, turned, guide, ends, parts or position",
    ),
    (
        "PairForm",
        &["Meet", "Angles", "OnPath", "AlongPath", "Distance", "Related"],
        &[
            "crates/mechanism/src/mechanism/pair/",
            "crates/mechanism/src/mechanism/groups.rs",
            "crates/mechanism/src/position/",
            "crates/mechanism/src/motion/",
            "crates/board/src/plan/reduce.rs",
            "crates/analytic/src/rows.rs",
            "crates/sweep/src/train.rs",
            "crates/sweep/src/compile/rolling.rs",
        ],
        "PairForm::ends, driver, path, meets, locks, point_guide or equations",
    ),
    (
        "Contours",
        &[],
        &[
            "crates/scene/src/rolling.rs",
            "crates/scene/src/cams/geared.rs",
            "crates/scene/src/resolve/",
            "crates/mechanism/src/stated/",
            "crates/figure/src/mechanism/belts.rs",
            "crates/methods/src/inversions/",
            "crates/report/src/given/",
        ],
        "Rolling::relation, touch, sizes, hollow, radii or teeth",
    ),
    (
        "RollingKind",
        &[],
        &[
            "crates/scene/src/rolling.rs",
            "crates/scene/src/decode/",
            "crates/scene/src/resolve/",
            "crates/mechanism/src/mechanism/pair/",
            "crates/methods/src/inversions/",
            "crates/report/src/given/",
        ],
        "RollingKind::is_lower, is_toothed or meshes",
    ),
];

#[test]
fn kinds_are_distinguished_where_the_list_says() {
    let mut faults = Vec::new();
    for (of, kinds, told, ask) in KINDS {
        let mut idle = told.to_vec();
        for (name, code) in code() {
            for (n, line) in code.lines().enumerate() {
                let after = words(line)
                    .filter(|(_, word, _)| word == of)
                    .filter_map(|(_, _, after)| after.strip_prefix("::").map(word));
                for kind in after.filter(|w| {
                    w.starts_with(char::is_uppercase) && (kinds.is_empty() || kinds.contains(w))
                }) {
                    match told.iter().find(|file| {
                        name == **file || file.ends_with('/') && name.starts_with(**file)
                    }) {
                        Some(file) => idle.retain(|f| f != file),
                        None => faults
                            .push(format!("{name}:{}: {of}::{kind}; ask what {ask} tells", n + 1)),
                    }
                }
            }
        }
        faults.extend(idle.iter().map(|file| format!("{file} tells no {of} apart: strike it off")));
    }
    finish(
        &faults,
        "A new kind is one file, or one arm, where the list in tests/tidy/kinds.rs says.",
    );
}
