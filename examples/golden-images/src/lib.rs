//! The figures of a project: a crank-rocker, drawn for a text.

use hodograph::diag::Faults;
use hodograph::figure::sheet::{SheetOptions, drawing};
use hodograph::render::svg;
use hodograph::scene::{DiagramKind, Lang, build::*};
use hodograph::worked::{Scope, work};

/// The figures by name, as SVG.
pub fn figures() -> Result<Vec<(&'static str, String)>, Faults> {
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
        .find(["v_C", "omega_3"])
        .build()?
        .value;
    let worked = work(&scene, Scope::Figure)?.value;
    let options = SheetOptions::of_language(Lang::En);
    let mut out = Vec::new();
    for on in [DiagramKind::Plane, DiagramKind::Velocity] {
        let figure = drawing(&scene, &worked, &options, on).expect("velocities are asked for");
        out.push((on.word(), svg::write(&figure)?.value));
    }
    Ok(out)
}
