//! Mechanisms from book chapters on mobility, given by links and pairs alone: no profile, no
//! radius, no teeth, no direction, no driver.

use hodograph::report::mobility;
use hodograph::scene::{self, Lang};
use hodograph::worksheet::{WorksheetOptions, markdown, mobility_of_pairs};
use serde_json::Value as Json;

/// n, p_l, p_h, F′, certain p′, F, and F if pairs that may be redundant are.
struct Book {
    name: &'static str,
    scene: &'static str,
    counts: [i64; 6],
    if_virtual: Option<i64>,
}

const fn book(name: &'static str, counts: [i64; 6], scene: &'static str) -> Book {
    Book { name, scene, counts, if_virtual: None }
}

const BOOKS: &[Book] = &[
    book(
        "roller on a rocker, the roller a link",
        [3, 3, 1, 1, 0, 1],
        r#"{"links": {"1": ["O","P"], "2": ["O"], "3": ["P","B"], "4": ["B"]}, "ground": "1", "cams": [{"cam": "2", "follower": "3", "roller": {"pin": "B"}}]}"#,
    ),
    book(
        "roller on a rocker, not numbered",
        [2, 2, 1, 0, 0, 1],
        r#"{"links": {"1": ["O","P"], "2": ["O"], "3": ["P","B"]}, "ground": "1", "cams": [{"cam": "2", "follower": "3", "roller": {"pin": "B"}}]}"#,
    ),
    book(
        "knife edge, sliding",
        [2, 2, 1, 0, 0, 1],
        r#"{"links": {"1": ["O"], "2": ["O"], "3": ["B"]}, "ground": "1", "guides": [{"pin": "B", "slider": "3", "on": "1"}], "cams": [{"cam": "2", "follower": "3", "edge": "B"}]}"#,
    ),
    book(
        "flat face, sliding",
        [2, 2, 1, 0, 0, 1],
        r#"{"links": {"1": ["O"], "2": ["O"]}, "ground": "1", "guides": [{"slider": "3", "on": "1"}], "cams": [{"cam": "2", "follower": "3", "face": {}}]}"#,
    ),
    book(
        "flat face, swinging",
        [2, 2, 1, 0, 0, 1],
        r#"{"links": {"1": ["O","P"], "2": ["O"], "3": ["P"]}, "ground": "1", "cams": [{"cam": "2", "follower": "3", "face": {}}]}"#,
    ),
    book(
        "round end, cam on a slide (移动凸轮)",
        [2, 2, 1, 0, 0, 1],
        r#"{"links": {"1": ["P"], "3": ["P","B"]}, "ground": "1", "guides": [{"slider": "2", "on": "1"}], "cams": [{"cam": "2", "follower": "3", "arc": {"pin": "B"}}]}"#,
    ),
    book(
        "bulldozer (推土机)",
        [5, 7, 0, 0, 0, 1],
        r#"{"links": {"1": ["A","D","E"], "2": ["A","B","F"], "3": ["D","C"], "4": ["B","C"]}, "ground": "1", "driver": {"cylinder": "EF", "links": ["5","6"]}}"#,
    ),
    book(
        "dosing pump (加药泵)",
        [6, 8, 1, 0, 0, 1],
        r#"{"links": {"1": ["O","P","E"], "2": ["O"], "3": ["P","B","C"], "4": ["C","D"], "5": ["D","E","F"], "6": ["F","G"]}, "ground": "1",
            "guides": [{"pin": "G", "slider": "7", "on": "1"}], "cams": [{"cam": "2", "follower": "3", "edge": "B"}]}"#,
    ),
    book(
        "cloth feed of a sewing machine (缝纫机送布)",
        [4, 4, 2, 0, 0, 2],
        r#"{"links": {"1": ["O","Q","P"], "2": ["O"], "3": ["Q"], "4": ["P","C"], "5": ["C","U","V"]}, "ground": "1",
            "cams": [{"cam": "2", "follower": "5", "edge": "U"}, {"cam": "3", "follower": "5", "edge": "V"}]}"#,
    ),
    book(
        "Geneva wheel",
        [2, 2, 1, 0, 0, 1],
        r#"{"links": {"1": ["O","Q"], "2": ["O","B"], "3": ["Q"]}, "ground": "1", "guides": [{"pin": "B", "on": "3"}]}"#,
    ),
    book(
        "gear with a cam on its shaft",
        [3, 3, 2, 0, 0, 1],
        r#"{"links": {"1": ["O","Q"], "2": ["O"], "3": ["Q"], "4": ["B"]}, "ground": "1", "guides": [{"pin": "B", "slider": "4", "on": "1"}],
            "gears": [{"links": ["2","3"], "centres": ["O","Q"]}], "cams": [{"cam": "3", "follower": "4", "edge": "B"}]}"#,
    ),
    book(
        "rack and pinion",
        [2, 2, 1, 0, 0, 1],
        r#"{"links": {"1": ["O"], "2": ["O"]}, "ground": "1", "guides": [{"slider": "3", "on": "1"}], "gears": [{"links": ["2","3"], "centres": ["O"], "rack": "3"}]}"#,
    ),
    book(
        "rack and pinion, the guide aslant",
        [2, 2, 1, 0, 0, 1],
        r#"{"links": {"1": ["O"], "2": ["O"]}, "ground": "1", "guides": [{"slider": "3", "on": "1", "angle": "30 deg"}], "gears": [{"links": ["2","3"], "centres": ["O"], "rack": "3"}]}"#,
    ),
    book(
        "planetary train with three planets",
        [5, 5, 6, 0, 2, 1],
        r#"{"links": {"1": ["O"], "2": ["O"], "3": ["O","P","Q","R"], "4": ["P"], "5": ["Q"], "6": ["R"]}, "ground": "1",
            "gears": [{"links": ["2","4"], "centres": ["O","P"]}, {"links": ["2","5"], "centres": ["O","Q"]}, {"links": ["2","6"], "centres": ["O","R"]},
            {"links": ["4","1"], "centres": ["P","O"], "ring": "1"}, {"links": ["5","1"], "centres": ["Q","O"], "ring": "1"}, {"links": ["6","1"], "centres": ["R","O"], "ring": "1"}]}"#,
    ),
    book(
        "cam, roller, compound hinge and two toggles",
        [7, 9, 1, 1, 0, 1],
        r#"{"links": {"1": ["O","G","H"], "2": ["O"], "3": ["B"], "4": ["B","C"], "5": ["C","D"], "6": ["C","E"], "7": ["D","G"], "8": ["E","H"]}, "ground": "1",
            "guides": [{"pin": "B", "slider": "4", "on": "1"}], "cams": [{"cam": "2", "follower": "4", "roller": {"pin": "B"}}]}"#,
    ),
    book(
        "radial engine, three rods on one pin",
        [7, 10, 0, 0, 0, 1],
        r#"{"links": {"1": ["O"], "2": ["O","A"], "3": ["A","B"], "4": ["A","C"], "5": ["A","D"]}, "ground": "1",
            "guides": [{"pin": "B", "slider": "6"}, {"pin": "C", "slider": "7"}, {"pin": "D", "slider": "8"}]}"#,
    ),
    book(
        "wheel on a rail, pushed by a rod (no radius, no direction)",
        [3, 4, 0, 0, 0, 1],
        r#"{"links": {"1": ["O"], "2": ["O","A"], "3": ["A","C"], "4": ["C"]}, "ground": "1", "rolling": [{"wheel": "4", "centre": "C", "on": "1"}]}"#,
    ),
    book(
        "valve train: cam, tappet, pushrod, rocker, valve",
        [5, 6, 2, 0, 0, 1],
        r#"{"links": {"1": ["O","R"], "2": ["O"], "3": ["B"], "4": ["B","C"], "5": ["C","R","S"], "6": ["V"]}, "ground": "1",
            "guides": [{"pin": "B", "slider": "3", "on": "1"}, {"pin": "V", "slider": "6", "on": "1"}],
            "cams": [{"cam": "2", "follower": "3", "face": {}}, {"cam": "5", "follower": "6", "edge": "V"}]}"#,
    ),
    book(
        "cam on a crank, follower on the coupler",
        [5, 6, 1, 0, 0, 2],
        r#"{"links": {"1": ["A","D"], "2": ["A","B"], "3": ["B","C","P"], "4": ["C","D"], "5": ["B"], "6": ["P","E"]}, "ground": "1",
            "cams": [{"cam": "5", "follower": "6", "edge": "E"}]}"#,
    ),
    book(
        "trammel with a crank, moved by a cam with a roller",
        [6, 8, 1, 1, 1, 1],
        r#"{"units": {"length": "mm"}, "links": {"1": ["O","D"], "6": ["O"], "2": ["A","R"], "7": ["R"], "3": ["A","B","C"], "4": ["C"], "5": ["D","B"]}, "ground": "1",
            "points": {"D": [0, 0], "A": [8, 0], "B": [4, 3], "C": [0, 6], "R": [10, 0], "O": [20, 0]},
            "guides": [{"pin": "A", "slider": "2", "on": "1", "through": "D", "angle": "0 deg"}, {"pin": "C", "slider": "4", "on": "1", "through": "D", "angle": "90 deg"}],
            "cams": [{"cam": "6", "follower": "2", "roller": {"pin": "R"}}]}"#,
    ),
    book(
        "sieve (大筛机构): roller, second guide, compound hinge",
        [8, 11, 1, 1, 2, 2],
        r#"{"links": {"1": ["A","O"], "2": ["A","B"], "3": ["B","C"], "4": ["F","D","G"], "5": ["D","C"], "6": ["C","E"], "8": ["O"], "9": ["F"]}, "ground": "1",
            "guides": [{"pin": "F", "slider": "4", "on": "1"}, {"pin": "G", "slider": "4", "on": "1"}, {"pin": "E", "slider": "7", "on": "1"}],
            "cams": [{"cam": "8", "follower": "4", "roller": {"pin": "F"}}]}"#,
    ),
    book(
        "cam and two guides of its follower",
        [2, 3, 1, 0, 2, 1],
        r#"{"links": {"1": ["O"], "2": ["O"], "3": ["B","G"]}, "ground": "1",
            "guides": [{"pin": "B", "slider": "3", "on": "1", "angle": "90 deg"}, {"pin": "G", "slider": "3", "on": "1", "angle": "90 deg"}], "cams": [{"cam": "2", "follower": "3", "edge": "B"}]}"#,
    ),
    book(
        "small press 2-12: geared shafts, eccentric, cam with roller, rocker, toggles",
        [8, 10, 2, 1, 0, 1],
        r#"{"links": {"0": ["O","Q"], "1": ["O","A"], "2": ["A","B"], "3": ["B","C"], "4": ["C","D","E"], "5": ["E"], "6": ["Q"], "7": ["D","F"]}, "ground": "0",
            "guides": [{"pin": "B", "slider": "3", "on": "0"}, {"pin": "F", "slider": "8", "on": "0"}],
            "gears": [{"links": ["1","6"], "centres": ["O","Q"]}], "cams": [{"cam": "6", "follower": "4", "roller": {"pin": "E"}}]}"#,
    ),
    book(
        "ladder of three bars: no mechanism",
        [2, 3, 0, 0, 0, 0],
        r#"{"links": {"1": ["A","C"], "2": ["A","B"], "3": ["B","C"]}, "ground": "1"}"#,
    ),
];

#[test]
fn links_and_pairs_are_counted_as_books_count_them() {
    let mut faults = Vec::new();
    for b in BOOKS {
        let scene = match scene::read_topology(b.scene) {
            Ok(scene) => scene.value,
            Err(f) => {
                faults.push(format!("{}: {f}", b.name));
                continue;
            }
        };
        let (survey, checked) = mobility::surveyed(&scene);
        let told: Json = mobility::json(&scene, &survey, &checked);
        let of = |key: &str| told[key].as_i64().unwrap_or(-99);
        let counts = |key: &str| told["counts"][key].as_i64().unwrap_or(-99);
        let found =
            [counts("n"), counts("p_l"), counts("p_h"), of("F_local"), of("p_virtual"), of("F")];
        if found != b.counts || told["F_if_virtual"].as_i64() != b.if_virtual {
            faults.push(format!(
                "{}: n p_l p_h F' p' F = {found:?}, {:?}; expected {:?}\n{}",
                b.name,
                told["F_if_virtual"],
                b.counts,
                mobility::text(&scene, &survey, &checked, Lang::En)
            ));
        }
        // A worksheet lists links and pairs; a drawing is not needed.
        for lang in [Lang::En, Lang::Zh] {
            let document = mobility_of_pairs(&scene, &WorksheetOptions::of_language(lang));
            let (text, beside) = markdown::markdown(&document, "count").unwrap();
            assert!(beside.is_empty(), "{}", b.name);
            assert!(
                text.contains(&format!("={}", b.counts[5]))
                    || text.contains(&format!("= {}", b.counts[5])),
                "{}: {text}",
                b.name
            );
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n\n"));
}
