//! Answers and figures of files of any kind (scenes, design tasks, motions of points) by one call,
//! as for a binding to another language.
//!
//! `cargo run --example answers -- press.json` prints the answers and writes `press-sheet.svg`.

use hodograph::diag::Faults;
use hodograph::problem::{Look, Options, Pictures, read, solve};
use hodograph::render::svg;

/// Returns the answers as JSON, and the figures as SVG, each with its name.
pub fn answers(text: &str) -> Result<(String, Vec<(String, String)>), Faults> {
    let problem = read(text)?.value;
    let solved = solve(&problem, &Options::with_figures())?;
    let look = Look::default();
    let mut figures = Vec::new();
    for (word, figure) in solved.figures(&Pictures::default(), &look)?.value {
        figures.push((word.to_string(), svg::write(&figure)?.value));
    }
    Ok((solved.json(&look, false, &solved.notes).to_string(), figures))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for path in std::env::args_os().skip(1).map(std::path::PathBuf::from) {
        let (json, figures) = answers(&std::fs::read_to_string(&path)?)?;
        println!("{json}");
        for (word, svg) in figures {
            let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            std::fs::write(path.with_file_name(format!("{stem}-{word}.svg")), svg)?;
        }
    }
    Ok(())
}
