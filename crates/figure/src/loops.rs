//! The vector loops of the analytic method as arrows on the mechanism, one page for each loop.

use super::list::{FigureEntry, FigureInput, Pages};
use super::mechanism::{LoopArrow, looped};
use super::sheet::{SheetDrafter, SheetOptions};
use hodograph_base::diag::{Faults, Warned};
use hodograph_methods::loops::{LoopVector, Loops, VectorSize, placed};
use hodograph_paper::paper::item::Figure;
use hodograph_paper::paper::label::Label;
use hodograph_report::loops::closed;
use hodograph_scene::{DiagramKind, Scene};
use hodograph_worked::worked::Worked;
use std::collections::BTreeSet;

/// The closed vectors of the analytic method.
pub const ENTRY: FigureEntry = FigureEntry {
    name: "loops",
    about: [
        "The vector loops of the analytic method, one page for each loop",
        "解析法的封闭矢量多边形，每个多边形一页",
    ],
    draw,
};

fn draw(w: &FigureInput) -> Result<Warned<Pages>, Faults> {
    let all = placed(w.scene, &w.worked.mechanism, &w.worked.configuration)?;
    let figures = pages(w.scene, w.worked, w.options, &all);
    let one = figures.len() == 1;
    let named = |(k, figure)| {
        let number = if one { String::new() } else { format!("-{}", k + 1) };
        (format!("{}{number}", ENTRY.name), figure)
    };
    Ok(Warned { value: figures.into_iter().enumerate().map(named).collect(), notes: Vec::new() })
}

/// Draws each loop on the mechanism.
pub fn pages(scene: &Scene, worked: &Worked, options: &SheetOptions, all: &Loops) -> Vec<Figure> {
    let maker = SheetDrafter { scene, worked, options, certified: Vec::new() };
    let page = |of: &Vec<LoopVector>| {
        let part = looped(&options.style, scene, worked, &options.notation, &arrows(all, of));
        let mu = maker.caption(DiagramKind::Plane).1;
        maker.alone(maker.titled(part, Label::math(closed(all, of)), &mu, ENTRY.name))
    };
    all.groups.iter().flat_map(|g| &g.loops).map(page).collect()
}

/// Returns the vectors of a loop as arrows; the angle of a variable is drawn once, and that of a
/// driver belongs to the mechanism.
fn arrows(all: &Loops, of: &[LoopVector]) -> Vec<LoopArrow> {
    let mut marked = BTreeSet::new();
    let arrow = |(k, v): (usize, &LoopVector)| {
        let symbol = match &v.size {
            VectorSize::Fixed(text, _) => text.clone(),
            VectorSize::Variable(k) => all.variables[*k].symbol(0).text(),
        };
        let free = |k: &usize| all.variables[*k].driver.is_none() && marked.insert(*k);
        let angle = v.angle.variable.filter(free).map(|_| {
            let angle = v.angle.formula(&all.variables);
            (angle.text(), angle.value())
        });
        LoopArrow { symbol, key: (k + 1).to_string(), places: v.places, angle }
    };
    of.iter().enumerate().map(arrow).collect()
}
