//! Rules of the project that can be checked in its files: permitted imports, permitted calls of the
//! platform's floating-point functions, lengths of files, and a complete list of modules in the
//! crate's documentation.
//!
//! The test does not link the library: it reads the sources. Rules that a lint can check by types
//! are in `clippy.toml`.

#[path = "tidy/catalogues.rs"]
mod catalogues;
#[path = "tidy/codes.rs"]
mod codes;
#[path = "tidy/comments.rs"]
mod comments;
#[path = "tidy/documents.rs"]
mod documents;
#[path = "tidy/kinds.rs"]
mod kinds;
#[path = "tidy/map.rs"]
mod map;
#[path = "tidy/packages.rs"]
mod packages;
#[path = "tidy/wording.rs"]
mod wording;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Files longer than [`LONGEST`], each with its permitted number of lines. The list only shrinks: a
/// file that grows beyond its number is split, one that becomes shorter gets the smaller number,
/// one that fits is removed.
const LONG_FILES: &[(&str, usize)] =
    &[("tests/random/mech.rs", 672), ("tests/random/properties.rs", 880), ("tests/sweep.rs", 745)];

/// Largest number of lines of a file.
const LONGEST: usize = 650;

/// Functions of `f64` with a last bit that depends on the platform's library. `sqrt`, `mul_add`,
/// `rem_euclid` and rounding are exact everywhere and are not among them.
const PLATFORM_FUNCTIONS: &[&str] = &[
    "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sin_cos", "sinh", "cosh", "tanh",
    "asinh", "acosh", "atanh", "exp", "exp2", "exp_m1", "ln", "ln_1p", "log", "log2", "log10",
    "powf", "powi", "hypot", "cbrt",
];

/// Files in which a method may have such a name, with the reason. The module `number` wraps `libm`;
/// in the others the method is that of the traits of `number`, implemented by `libm` for `f64`.
/// Clippy (`clippy.toml`), which knows types, has no exceptions.
const PLATFORM_FUNCTIONS_ALLOWED: &[(&str, &str)] = &[
    (
        "crates/base/src/number/",
        "defines the functions of each kind of number, by libm where it is f64",
    ),
    ("crates/base/src/geom.rs", "vectors of any kind of number"),
    ("crates/scene/src/eval.rs", "expressions in any kind of number"),
    ("crates/scene/src/exact.rs", "given values in any kind of number"),
    ("crates/base/src/cam/disc.rs", "pressure angles in any kind of number"),
    (
        "crates/base/src/cam/jet.rs",
        "sine, cosine and directions with their derivatives in any kind of number",
    ),
    (
        "crates/methods/src/equation/mod.rs",
        "directions of vectors in any kind of number; `sin_cos` of the inputs",
    ),
    (
        "crates/mechanism/src/force.rs",
        "directions of loads in any kind of number; `sin_cos` of the inputs",
    ),
    (
        "crates/mechanism/src/position/assemble.rs",
        "positions in any kind of number; `sin_cos` of the inputs",
    ),
    (
        "crates/mechanism/src/position/rolling.rs",
        "phases in any kind of number; `sin_cos` of the inputs",
    ),
    (
        "crates/mechanism/src/position/coupled/phase.rs",
        "phases in any kind of number; `sin_cos` of the inputs",
    ),
    (
        "crates/mechanism/src/position/shape.rs",
        "shapes of links in any kind of number; `sin_cos` of the inputs",
    ),
    ("crates/methods/src/particle/", "laws and ways of points in any kind of number"),
    ("crates/worked/src/effort/truth.rs", "differences in longer numbers"),
    ("crates/worked/src/certified/ladder.rs", "directions in intervals"),
    ("crates/worked/src/certified/steps.rs", "angles of crossings in intervals"),
    (
        "crates/synthesis/src/time_ratio/crank_rocker/family.rs",
        "transmission angles in double-double numbers",
    ),
    ("crates/sweep/src/reading.rs", "directions over lanes, by libm"),
    ("crates/sweep/src/turns.rs", "directions over lanes, by libm"),
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All files under a folder, in order, as paths from the project's root with their texts.
fn files(folder: &str, endings: &[&str]) -> Vec<(String, String)> {
    let mut open = vec![root().join(folder)];
    let mut found: Vec<PathBuf> = Vec::new();
    while let Some(at) = open.pop() {
        for entry in std::fs::read_dir(&at).unwrap_or_else(|e| panic!("{}: {e}", at.display())) {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|e| endings.contains(&&*e.to_string_lossy())) {
                found.push(path);
            }
        }
    }
    found.sort();
    let name = |p: &Path| p.strip_prefix(root()).unwrap().to_str().unwrap().replace('\\', "/");
    found.iter().map(|p| (name(p), std::fs::read_to_string(p).unwrap())).collect()
}

/// Files of the root package and of all crates under it.
fn sources(endings: &[&str]) -> Vec<(String, String)> {
    ["src", "crates", "templates"].map(|folder| files(folder, endings)).concat()
}

/// The libraries' files without their tests and comments: lines keep their numbers. `main.rs`
/// belongs to no module, nor does the `lib.rs` of a crate with several.
fn code() -> Vec<(String, String)> {
    let of_none = |name: &str| {
        name == "src/main.rs"
            || name.ends_with("src/lib.rs") && !map::whole().contains(map::crate_of(name))
    };
    let library = sources(&["rs"]).into_iter().filter(|(name, _)| {
        !name.ends_with("/tests.rs") && !name.contains("/tests/") && !of_none(name)
    });
    let bare = |text: String| {
        let end = text
            .match_indices("#[cfg(test)]\nmod ")
            .find(|(i, _)| text[*i..].lines().nth(1).is_some_and(|l| l.ends_with('{')));
        let (code, tests) = text.split_at(end.map_or(text.len(), |(i, _)| i));
        assert!(
            tests.matches("\n}\n").count() <= 1,
            "code behind the tests of a file is not seen here; put them last:\n{tests}"
        );
        code.lines()
            .map(|l| l.split("//").next().unwrap_or_default())
            .collect::<Vec<_>>()
            .join("\n")
    };
    let all: Vec<_> = library.map(|(name, text)| (name, bare(text))).collect();
    assert!(all.len() > 100, "only {} files were found", all.len());
    all
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// The first word of a text.
fn word(text: &str) -> &str {
    &text[..text.find(|c| !is_word(c)).unwrap_or(text.len())]
}

/// Each word of a line with the text before and after it.
fn words(line: &str) -> impl Iterator<Item = (&str, &str, &str)> {
    let starts = line
        .char_indices()
        .filter(|(i, c)| is_word(*c) && !line[..*i].ends_with(is_word))
        .map(|(i, _)| i);
    starts.map(|i| (&line[..i], word(&line[i..]), &line[i + word(&line[i..]).len()..]))
}

fn finish(faults: &[String], law: &str) {
    assert!(faults.is_empty(), "{law}\n{} faults:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn no_function_of_the_platform_decides_a_bit() {
    let mut faults = Vec::new();
    let mut used = BTreeSet::new();
    for (file, text) in code() {
        let allowed = PLATFORM_FUNCTIONS_ALLOWED
            .iter()
            .find(|(at, _)| if at.ends_with('/') { file.starts_with(at) } else { file == *at });
        for (n, line) in text.lines().enumerate() {
            let called = words(line).find(|(before, word, after)| {
                let called = before.ends_with('.') && after.starts_with('(')
                    || before.ends_with("f64::")
                    || before.ends_with("f32::");
                called && PLATFORM_FUNCTIONS.contains(word)
            });
            match (called, allowed) {
                (None, _) => {}
                (Some(_), Some((at, _))) => drop(used.insert(*at)),
                (Some((_, f, _)), None) => faults
                    .push(format!("{file}:{}: {f}; use libm::{f}, or the numbers' own", n + 1)),
            }
        }
    }
    let needless = PLATFORM_FUNCTIONS_ALLOWED.iter().filter(|(at, _)| !used.contains(at));
    faults.extend(needless.map(|(at, _)| {
        format!(
            "{at} calls none any more: strike it off PLATFORM_FUNCTIONS_ALLOWED in tests/tidy.rs"
        )
    }));
    finish(
        &faults,
        "sin, hypot, powi and their like differ between platforms in the last bit, and golden files do not.",
    );
}

/// Clippy knows types; it has the same list of functions.
#[test]
fn clippy_refuses_the_same_functions() {
    let told = std::fs::read_to_string(root().join("clippy.toml")).unwrap();
    for f in PLATFORM_FUNCTIONS {
        assert!(told.contains(&format!("\"f64::{f}\"")), "clippy.toml does not disallow f64::{f}");
    }
    for (name, lib) in sources(&["rs"]).into_iter().filter(|(name, _)| name.ends_with("src/lib.rs"))
    {
        for said in [
            "#![forbid(unsafe_code)]",
            "#![warn(missing_docs)]",
            "#![cfg_attr(not(test), warn(clippy::disallowed_methods))]",
        ] {
            assert!(lib.contains(said), "{name} lacks {said}");
        }
    }
}

/// `f64::clamp` panics if a bound is NaN, or if the lower bound is above the upper one: values from
/// a file use `max` and `min`.
#[test]
fn bounds_of_clamp_are_constants() {
    let mut faults = Vec::new();
    for (file, code) in code() {
        for (at, _) in code.match_indices(".clamp(") {
            let rest = &code[at + ".clamp(".len()..];
            let mut open = 1;
            let end = rest.find(|c| {
                open += i32::from(c == '(') - i32::from(c == ')');
                open == 0
            });
            let bounds = &rest[..end.unwrap_or(rest.len())];
            let constant = |w: &str| {
                w.starts_with(|c: char| c.is_uppercase() || c.is_ascii_digit())
                    || CONSTANT.contains(&w)
            };
            if !words(bounds).all(|(_, w, _)| constant(w)) {
                faults.push(format!("{file}:{}: clamp({bounds})", code[..at].lines().count()));
            }
        }
    }
    finish(&faults, "bounds of `clamp` are constants: others may be no numbers");
}

/// Words in the bounds of `clamp` that are not variables.
const CONSTANT: [&str; 7] = ["as", "f64", "f32", "u16", "usize", "from", "e"];

#[test]
fn files_are_short_enough_to_be_overseen() {
    let mut faults = Vec::new();
    let mut seen = BTreeSet::new();
    for folder in ["src", "crates", "templates", "tests", "bench"] {
        for (file, text) in files(folder, &["rs", "js", "css"]) {
            let lines = text.lines().count();
            match LONG_FILES.iter().find(|(name, _)| *name == file) {
                None if lines > LONGEST => faults
                    .push(format!("{file} has {lines} lines, more than {LONGEST}: take it apart")),
                None => {}
                Some((name, most)) => {
                    seen.insert(*name);
                    if lines <= LONGEST {
                        faults.push(format!("{file} has {lines} lines and fits: strike it off LONG_FILES in tests/tidy.rs"));
                    } else if lines > *most {
                        faults.push(format!(
                            "{file} has {lines} lines, more than the {most} it had: take it apart"
                        ));
                    } else if lines < *most {
                        faults.push(format!("{file} has {lines} lines: write {lines} for {most} in LONG_FILES in tests/tidy.rs"));
                    }
                }
            }
        }
    }
    let gone = LONG_FILES.iter().filter(|(name, _)| !seen.contains(name));
    faults.extend(gone.map(|(name, _)| {
        format!("{name} is no file any more: strike it off LONG_FILES in tests/tidy.rs")
    }));
    finish(&faults, "A file holds one idea, in some 450 lines at most.");
}

/// The README's Rust code is that of the crate's first page, which `cargo test` runs.
#[test]
fn the_code_of_the_readme_is_run() {
    let [readme, page] =
        ["README.md", "src/lib.rs"].map(|f| std::fs::read_to_string(root().join(f)).unwrap());
    let shown = readme
        .split("```rust\n")
        .nth(1)
        .and_then(|rest| rest.split("```").next())
        .expect("the README has Rust code");
    let run: String = page.lines().filter_map(|l| l.strip_prefix("//!")).collect();
    let squeezed = |text: &str| text.split_whitespace().collect::<String>();
    let run = squeezed(&run);
    let faults: Vec<String> = shown
        .lines()
        .map(|l| l.split("//").next().unwrap_or_default())
        .filter(|l| !run.contains(&squeezed(l)))
        .map(|l| format!("README.md: {l}"))
        .collect();
    finish(&faults, "a line of the README's code is not in the first example of src/lib.rs");
}
