//! Questions that a scene does not ask, answered for two sets of dimensions and compared.
//!
//! `cargo run --example questions`

use hodograph::answer::AnswerValue;
use hodograph::diag::Faults;
use hodograph::problem::{Answer, Look, Options, read, solve, templates};
use hodograph::scene::edit;

/// Angular velocity of the rocker against the coupler, transmission angle, radius of curvature of
/// the path of E, and a difference of velocities. docs/scene.md lists all quantities.
const QUESTIONS: [&str; 4] = ["omega_3/2", "gamma_C", "rho_E", "v_E - v_C"];

pub fn main() -> Result<(), Faults> {
    let [short, long] = ["80 mm", "100 mm"].map(answers);
    println!("{:12} {:>36} {:>36} {:>8}", "", "l_AB = 80 mm", "l_AB = 100 mm", "ratio");
    for (a, b) in short?.iter().zip(&long?) {
        // `text` is for people, in the unit of the file; `value` is in SI and absent where a
        // question has no answer.
        let ratio = match (a.value, b.value) {
            (Some(a), Some(b)) => format!("{:.4}", size(b) / size(a)),
            _ => "none".to_owned(),
        };
        println!("{:12} {:>36} {:>36} {ratio:>8}", a.find, a.text, b.text);
    }
    Ok(())
}

/// The answers for a length of the crank.
fn answers(crank: &str) -> Result<Vec<Answer>, Faults> {
    let text = templates::text("crank-rocker", &[("l_AB", crank)])?;
    // Only what is asked is planned, drawn and solved: other questions take the place of the
    // template's own.
    let problem = read(edit::with_find(&text, &QUESTIONS)?)?.value;
    Ok(solve(&problem, &Options::default())?.answers(&Look::default()))
}

/// A number, or the magnitude of a vector.
fn size(value: AnswerValue) -> f64 {
    match value {
        AnswerValue::Scalar(number) => number,
        AnswerValue::Vector(_) | AnswerValue::Point(_) => value.magnitude(),
    }
}
