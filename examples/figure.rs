//! Figures by name as SVG and PNG, and the place of a vector in them.
//!
//! `cargo run --example figure` writes `mechanism.svg`, `velocity.svg`, `acceleration.svg` and
//! their PNG files to the current folder.

use hodograph::figure::list;
use hodograph::problem::{Look, Options, Pictures, read, solve, templates};
use hodograph::render::{png, svg};
use hodograph::scene::Lang;
use std::error::Error;

/// Resolution of the PNG files (dots per inch).
const DPI: f64 = 150.0;

pub fn main() -> Result<(), Box<dyn Error>> {
    let problem = read(templates::text("shaper", &[])?)?.value;
    // Figures need the positions of all links, not only of those that the questions concern.
    let solved = solve(&problem, &Options::with_figures())?;

    // `list::LIST` has the names of all figures, as `hodograph draw --figure` takes them.
    let entries: Vec<_> =
        ["mechanism", "velocity", "acceleration"].into_iter().filter_map(list::named).collect();
    let pictures = Pictures { figures: &entries, ..Pictures::default() };
    let look = Look { lang: Some(Lang::En), ..Look::default() };

    for (name, figure) in solved.figures(&pictures, &look)?.value {
        let markup = svg::write(&figure)?.value;
        std::fs::write(format!("{name}.svg"), &markup)?;
        std::fs::write(format!("{name}.png"), png::render(&markup, DPI)?)?;

        // Places are in mm of the paper, y up. The id is that of the element in the SVG file.
        for vector in figure.vectors() {
            let (from, to) = (vector.from, vector.to);
            println!(
                "{name}.svg#{}: ({:.2}, {:.2}) to ({:.2}, {:.2}) mm, {:.4} in SI",
                vector.id, from.x, from.y, to.x, to.y, vector.si
            );
        }
        // A vector is found by its name, as `find` writes it.
        if let Some(v) = figure.vector("v_C") {
            println!("v_C is {:.2} mm long and has the id {}", v.mm, v.id);
        }
    }
    Ok(())
}
