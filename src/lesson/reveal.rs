//! One pose as a fragment for slides: an inline SVG with the classes by which reveal.js shows its
//! parts one by one.

use crate::diag::{Faults, Warned};
use crate::figure::fit;
use crate::figure::forces;
use crate::figure::list::{Extras, FigureInput};
use crate::figure::sheet;
use crate::geom::Point;
use crate::paper::item::Figure;
use crate::render::number::mm;
use crate::render::svg::{Elements, hex};
use crate::scene::{DiagramKind, PageFormat, Scene};
use crate::worked::Worked;

use crate::render::escaped;

/// Gap between two drawings.
const GAP_MM: f64 = 6.0;

/// Writes the mechanism with its polygons side by side, as an SVG to paste into a slide. A group
/// `<g class="fragment" data-fragment-index="n">` encloses the items of the n-th step: first of the
/// velocities, then of the accelerations, then of the forces, group after group.
///
/// # Errors
/// The errors of the SVG writer.
pub fn reveal(
    scene: &Scene,
    worked: &Worked,
    options: &sheet::SheetOptions,
) -> Result<Warned<String>, Faults> {
    let (drawings, _) = drawings(scene, worked, options, false)?;
    Ok(Warned { value: drawings.svg(scene, options, None), notes: Vec::new() })
}

/// Writes [`reveal`] in a given width (mm). Drawings become smaller, type as small as is legible;
/// drawings that would be too small side by side are placed one below the other.
///
/// # Errors
/// `paper-too-small` where the smallest legible drawings are wider.
pub fn reveal_in(
    scene: &Scene,
    worked: &Worked,
    options: &sheet::SheetOptions,
    width_mm: f64,
) -> Result<Warned<String>, Faults> {
    let extras = Extras::default();
    let wanted = FigureInput { scene, worked, options, extras: &extras };
    let format = PageFormat::column(width_mm);
    let value = fit::first_that_fits("reveal", &wanted, &format, false, |w, stacked| {
        let (drawings, size) = drawings(w.scene, w.worked, w.options, stacked)?;
        Ok(if size[0] <= width_mm {
            Ok(drawings.svg(w.scene, w.options, Some(width_mm)))
        } else {
            Err(size)
        })
    })?;
    Ok(Warned { value, notes: Vec::new() })
}

/// The drawings as markup.
struct Drawings {
    body: String,
    letters: String,
    size_mm: [f64; 2],
}

/// The drawings and their common size (mm): those of the motion side by side with those of the
/// forces below, or all stacked.
fn drawings(
    scene: &Scene,
    worked: &Worked,
    options: &sheet::SheetOptions,
    stacked: bool,
) -> Result<(Drawings, [f64; 2]), Faults> {
    let of_motion = DiagramKind::ALL.into_iter().filter_map(|on| {
        Some((on > DiagramKind::Plane, sheet::drawing(scene, worked, options, on)?))
    });
    let groups = worked.equilibrium.as_ref().map_or(0, |of| of.groups.len());
    let of_forces =
        (0..groups).filter_map(|k| Some((true, forces::group(scene, worked, options, k)?)));
    let mut rows: Vec<Vec<(bool, Figure)>> = vec![of_motion.collect(), of_forces.collect()];
    if stacked {
        rows = rows.into_iter().flatten().map(|drawing| vec![drawing]).collect();
    }
    rows.retain(|row| !row.is_empty());
    let widths =
        |row: &[(bool, Figure)]| row.iter().map(|(_, f)| f.width_mm + GAP_MM).sum::<f64>() - GAP_MM;
    let tallest = |row: &[(bool, Figure)]| row.iter().map(|(_, f)| f.height_mm).fold(0.0, f64::max);
    let width = rows.iter().map(|row| widths(row)).fold(0.0, f64::max);
    let height = rows.iter().map(|row| tallest(row) + GAP_MM).sum::<f64>() - GAP_MM;
    let mut top = height;
    let mut body = String::new();
    let mut elements = Elements::new(height);
    let mut done = 0;
    for row in &mut rows {
        // All drawings are aligned at the bottom, with their captions.
        let (mut x, bottom) = ((width - widths(row)) / 2.0, top - tallest(row));
        top = bottom - GAP_MM;
        for (has_steps, figure) in row {
            crate::paper::extent::translate(
                &mut figure.items,
                Point::new(x, bottom) - Point::ORIGIN,
            );
            x += figure.width_mm + GAP_MM;
            let list = elements.of(&figure.items)?;
            // An item that several steps draw comes with the first.
            let of: Vec<Option<usize>> =
                figure.items.iter().map(|i| i.steps().min().filter(|_| *has_steps)).collect();
            let most = of.iter().flatten().max().map_or(0, |n| n + 1);
            // Items of one step stay together, in the order of the drawing; the index gives the
            // order of steps.
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
    }
    let size_mm = [width, height].map(|mm| mm.max(0.0));
    Ok((Drawings { body, letters: Elements::letters([&elements]), size_mm }, size_mm))
}

impl Drawings {
    /// The fragment, as wide as its slide, or in a given width (mm) with the drawings in the
    /// middle.
    fn svg(&self, scene: &Scene, options: &sheet::SheetOptions, width_mm: Option<f64>) -> String {
        let [own, height] = self.size_mm;
        let wide = width_mm.unwrap_or(own);
        let left = (own - wide) / 2.0;
        let (left, w, h) = (mm(left), mm(wide), mm(height));
        let shown = width_mm
            .map_or_else(|| "width:100%".to_owned(), |_| format!("width:{w}mm;max-width:100%"));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" viewBox=\"{left} 0 {w} {h}\" role=\"img\" aria-label=\"{}\" style=\"{shown};background:{}\">\n{}\n{}</svg>\n",
            escaped(options.lang.of(&scene.title)),
            hex(options.style.palette.paper),
            self.letters,
            self.body
        )
    }
}
