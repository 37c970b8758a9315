//! The vector loops of the analytic method as arrows on the mechanism, one page for each loop.

use super::list::{FigureEntry, FigureInput, Pages};
use super::mechanism::{LoopArrow, looped};
use super::particle::ParticleView;
use super::sheet::{SheetDrafter, SheetOptions};
use super::stepped::SteppedMethod;
use hodograph_base::diag::{Both, Faults, Warned};
use hodograph_base::lang::each;
use hodograph_methods::loops::{LoopVector, Loops, VectorSize, placed};
use hodograph_paper::paper::item::Figure;
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::phrase::capital;
use hodograph_report::loops::{LoopWords, closed};
use hodograph_scene::{DiagramKind, Lang, Scene};
use hodograph_worked::worked::Worked;
use std::collections::BTreeSet;

/// The closed vectors of the analytic method.
pub const ENTRY: FigureEntry = FigureEntry {
    name: "loops",
    about: each!("The vector loops of the analytic method, one page for each loop"),
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

/// The loops step by step: each vector, the closed loop, its two parts, and the formulas of
/// positions, velocities and accelerations.
///
/// # Errors
/// The faults of the method.
pub(super) fn stepped(w: &FigureInput) -> Result<SteppedMethod, Faults> {
    let all = placed(w.scene, &w.worked.mechanism, &w.worked.configuration)?;
    let words = [Lang::En, Lang::Zh].map(|lang| LoopWords::new(w.scene, &all, lang));
    let mut out = SteppedMethod::default();
    let several = all.groups.iter().map(|g| g.loops.len()).sum::<usize>() > 1;
    for g in &all.groups {
        let heading = words.each_ref().map(|words| capital(&words.heading(g)));
        for of in &g.loops {
            let arrows = arrows(&all, of, Some(out.steps.len()));
            let options = w.options;
            let part = looped(&options.style, w.scene, w.worked, &options.notation, &arrows);
            let [en, zh] = heading.clone();
            let caption = if several { Both { en, zh } } else { each!("Vector loop").into() };
            let scales = vec![(DiagramKind::Plane, w.worked.construction.diagram.mu)];
            out.views.push(ParticleView { part, caption, scales });
            out.steps.extend(of.iter().map(|v| both(&words, |words| words.vector(v))));
        }
        for (en, zh) in words[0].steps(g).into_iter().zip(words[1].steps(g)) {
            out.formulas.insert(out.steps.len(), en.1);
            out.steps.push(Both { en: en.0, zh: zh.0 });
        }
    }
    Ok(out)
}

/// A sentence in both languages.
fn both(words: &[LoopWords; 2], of: impl Fn(&LoopWords) -> String) -> Both {
    let [en, zh] = words.each_ref().map(of);
    Both { en, zh }
}

/// Draws each loop on the mechanism.
pub fn pages(scene: &Scene, worked: &Worked, options: &SheetOptions, all: &Loops) -> Vec<Figure> {
    let maker = SheetDrafter { scene, worked, options, certified: Vec::new() };
    let page = |of: &Vec<LoopVector>| {
        let part = looped(&options.style, scene, worked, &options.notation, &arrows(all, of, None));
        let mu = maker.caption(DiagramKind::Plane).1;
        maker.alone(maker.titled(part, Label::math(closed(all, of)), &mu, ENTRY.name))
    };
    all.groups.iter().flat_map(|g| &g.loops).map(page).collect()
}

/// Returns the vectors of a loop as arrows; the angle of a variable is drawn once, and that of a
/// driver belongs to the mechanism. With a first step each arrow has a step of its own.
fn arrows(all: &Loops, of: &[LoopVector], first: Option<usize>) -> Vec<LoopArrow> {
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
        let step = first.map(|first| first + k);
        LoopArrow { symbol, key: (k + 1).to_string(), places: v.places, angle, step }
    };
    of.iter().enumerate().map(arrow).collect()
}
