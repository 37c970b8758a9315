//! Answers of a template and of a scene that is built in the program: certified digits, and drawing
//! against analysis.
//!
//! `cargo run --example solve`

use hodograph::diag::Faults;
use hodograph::problem::{Look, Options, Problem, Verdict, read, solve, templates};
use hodograph::scene::build::{Builder, Driver, deg, mm, rad_per_s};

pub fn main() -> Result<(), Faults> {
    // A template with a crank of 90 mm. `read` takes the text of any scene file.
    let template = read(templates::text("crank-rocker", &[("l_AB", "90 mm")])?)?;
    print_answers("crank-rocker, l_AB = 90 mm", &template.value)?;

    // The same kind of mechanism without a file.
    let scene = Builder::new()
        .link("1", ["A", "B"])
        .link("2", ["B", "C"])
        .link("3", ["C", "D"])
        .link("4", ["A", "D"])
        .ground("4")
        .length("AB", mm(100.0))
        .length("BC", mm(250.0))
        .length("CD", mm(200.0))
        .length("AD", mm(300.0))
        .driver(Driver::turning("1").angle(deg(60.0)).omega(rad_per_s(10.0)))
        .side("C", "left of BD")
        .find(["v_C", "a_C", "omega_3"])
        .build()?;
    print_answers("built", &Problem::of_scene(scene.value).value)
}

fn print_answers(title: &str, problem: &Problem) -> Result<(), Faults> {
    let solved = solve(problem, &Options::default())?;
    for note in &solved.notes {
        eprintln!("{note}");
    }
    println!("{title}");
    // Ten significant digits. Where fewer are certain, fewer are printed.
    let look = Look { digits: 10, ..Look::default() };
    for answer in solved.answers(&look) {
        println!("  {} = {}", answer.find, answer.text);
        if let (Some(drawn), Some(difference)) = (answer.drawn, answer.difference) {
            println!(
                "    drawn {:.6} {}, relative difference from the analysis {difference:.0e}",
                drawn.magnitude(),
                answer.unit
            );
        }
    }
    assert_eq!(solved.verdict(), Verdict::Answered);
    Ok(())
}
