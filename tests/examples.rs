//! The examples run to their end, and those that write files write them.

#[path = "../examples/figure.rs"]
mod figure;
#[path = "../examples/questions.rs"]
mod questions;
#[path = "../examples/solve.rs"]
mod solve;
#[path = "../examples/sweep.rs"]
mod sweep;

/// One test for all examples: they write to the current folder, of which a process has one.
#[test]
fn examples_run() {
    let folder = tempfile::tempdir().unwrap();
    std::env::set_current_dir(folder.path()).unwrap();
    solve::main().unwrap();
    figure::main().unwrap();
    sweep::main().unwrap();
    questions::main().unwrap();
    let length = |name: &str| {
        std::fs::metadata(folder.path().join(name)).unwrap_or_else(|e| panic!("{name}: {e}")).len()
    };
    for name in ["mechanism", "velocity", "acceleration"] {
        assert!(
            length(&format!("{name}.svg")) > 1000 && length(&format!("{name}.png")) > 1000,
            "{name}"
        );
    }
    let table = std::fs::read_to_string(folder.path().join("turn.csv")).unwrap();
    assert_eq!(
        table.lines().filter(|l| !l.starts_with('#')).count(),
        1 + 361,
        "a line of labels and a row for each degree"
    );
}
