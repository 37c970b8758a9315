//! One pose as a fragment for slides: an inline SVG whose parts carry the classes by which reveal.js shows them one by one.

use crate::diag::{Faults, Warned};
use crate::figure::sheet;
use crate::geom::Point;
use crate::mechanism::Level;
use crate::paper::extent::Rect;
use crate::render::number::mm;
use crate::render::svg::{Elements, hex};
use crate::scene::Scene;
use crate::worked::Worked;

use crate::render::escaped;

/// Between two drawings.
const GAP_MM: f64 = 6.0;

/// The mechanism with its polygons side by side, as an SVG to paste into a slide: `<g class="fragment" data-fragment-index="n">` around
/// what the n-th step draws, first of the velocities, then of the accelerations.
///
/// # Errors
/// Those of the SVG writer.
pub fn reveal(scene: &Scene, worked: &Worked, options: &sheet::Options) -> Result<Warned<String>, Faults> {
    let drawn = |level| Some((level, sheet::drawing(scene, worked, options, level)?));
    let mut figures: Vec<_> = Level::ALL.into_iter().filter_map(drawn).collect();
    let height = figures.iter().map(|(_, f)| f.height_mm).fold(0.0, f64::max);
    let mut x = 0.0;
    let mut body = String::new();
    let mut elements = Elements::new(height);
    let mut done = 0;
    for (level, figure) in &mut figures {
        // All stand on one line, their captions at the bottom.
        crate::paper::extent::translate(&mut figure.items, Point::new(x, 0.0) - Point::ORIGIN);
        x += figure.width_mm + GAP_MM;
        let list = elements.of(&figure.items)?;
        // An item that several steps draw comes with the first.
        let of: Vec<Option<usize>> = figure.items.iter().map(|i| i.steps().min().filter(|_| *level > Level::Position)).collect();
        let most = of.iter().flatten().max().map_or(0, |n| n + 1);
        // What comes in one step stays together, in the order of the drawing; the order of steps is told by the index.
        for (element, of) in list.iter().zip(&of) {
            match of {
                Some(n) => {
                    let index = done + n;
                    body.push_str(&format!("<g class=\"fragment\" data-fragment-index=\"{index}\">\n{element}\n</g>\n"));
                }
                None => body.push_str(&format!("{element}\n")),
            }
        }
        done += most;
    }
    let paper = Rect::new(Point::ORIGIN, Point::new((x - GAP_MM).max(0.0), height));
    let title = scene.title.get(options.lang);
    let (w, h) = (mm(paper.width_mm()), mm(paper.height_mm()));
    let value = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" viewBox=\"0 0 {w} {h}\" role=\"img\" aria-label=\"{}\" style=\"width:100%;background:{}\">\n{}\n{body}</svg>\n",
        escaped(title),
        hex(options.style.palette.paper),
        Elements::letters([&elements])
    );
    Ok(Warned { value, notes: Vec::new() })
}
