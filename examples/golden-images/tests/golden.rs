//! Compares the figures with those in `golden/`. `ACCEPT=1 cargo test` accepts the new figures, and
//! fails once, so that nobody accepts them without looking.

use std::path::Path;

use golden_images::figures;
use hodograph::render::diff::{Options, Picture, compare, picture};

/// The accepted figures.
const GOLDEN: [(&str, &str); 2] = [
    ("mechanism", include_str!("../golden/mechanism.svg")),
    ("velocity", include_str!("../golden/velocity.svg")),
];

#[test]
fn figures_are_as_accepted() {
    let mut differ = Vec::new();
    for ((name, now), (golden, accepted)) in figures().unwrap().into_iter().zip(GOLDEN) {
        assert_eq!(name, golden);
        if std::env::var_os("ACCEPT").is_some() {
            let path =
                Path::new(env!("CARGO_MANIFEST_DIR")).join("golden").join(format!("{name}.svg"));
            std::fs::write(&path, &now).unwrap();
            differ.push(format!("{}: accepted", path.display()));
            continue;
        }
        let [old, new] = [accepted, now.as_str()].map(|text| Picture::read(text.into()).unwrap());
        let found = compare(&old, &new, &Options::default()).unwrap();
        if !found.is_empty() {
            let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}-diff.png"));
            std::fs::write(&path, picture(&old, &new, &Options::default()).unwrap()).unwrap();
            let lines: Vec<String> = found.lines().into_iter().map(|line| line.en).collect();
            differ.push(format!("{name} (see {}):\n{}", path.display(), lines.join("\n")));
        }
    }
    assert!(differ.is_empty(), "{}", differ.join("\n\n"));
}
