//! The contract of SVG files (docs/svg.md): ids by meaning, data of vectors and points, and `diff`,
//! which reads them.

#[path = "../wide/mod.rs"]
mod wide;

mod diff;
mod ids;
mod shown;

/// The example for users of golden images: its sources are compiled with the other tests and run
/// here.
#[path = "../../examples/golden-images/tests/golden.rs"]
mod example;
/// The library of the example, under the crate name that its test uses.
#[path = "../../examples/golden-images/src/lib.rs"]
mod example_figures;
extern crate self as golden_images;
pub use example_figures::figures;

/// With `HODOGRAPH_WIDE=1`, the example is built as a project of its own.
#[test]
fn the_example_is_a_project_of_its_own() {
    if wide::every(2) > 1 {
        return;
    }
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let made = std::process::Command::new(env!("CARGO"))
        .args(["test", "--quiet", "--locked", "--manifest-path"])
        .arg(root.join("examples/golden-images/Cargo.toml"))
        .env("CARGO_TARGET_DIR", root.join("target/example"))
        .output()
        .unwrap();
    assert!(
        made.status.success(),
        "{}{}",
        String::from_utf8_lossy(&made.stdout),
        String::from_utf8_lossy(&made.stderr)
    );
}
