//! The vector loops of the analytic method as arrows on the mechanism, one page for each loop.

use super::list::{FigureEntry, FigureInput, Pages};
use super::mechanism::{LoopArrow, looped};
use super::particle::ParticleView;
use super::sheet::{SheetDrafter, SheetOptions};
use super::stepped::SteppedMethod;
use hodograph_base::diag::{Both, Faults, Warned, both};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::each;
use hodograph_methods::loops::{Equation, LoopVector, Loops, MotionEquations, VectorSize, placed};
use hodograph_paper::paper::item::Figure;
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::phrase::capital;
use hodograph_report::loops::{LoopWords, closed};
use hodograph_scene::quantity::Frame;
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
/// positions, velocities and accelerations; then the equations of motion of points that drivers move
/// directly. `None` if there are neither.
///
/// # Errors
/// The faults of the method.
pub(super) fn stepped(w: &FigureInput) -> Result<Option<SteppedMethod>, Faults> {
    let all = placed(w.scene, &w.worked.mechanism, &w.worked.configuration)?;
    let words = [Lang::En, Lang::Zh].map(|lang| LoopWords::new(w.scene, &all, lang));
    let mut out = SteppedMethod::default();
    let several = all.groups.iter().map(|g| g.loops.len()).sum::<usize>() > 1;
    for g in &all.groups {
        let heading = words.each_ref().map(|words| capital(&words.heading(g)));
        for of in &g.loops {
            let [en, zh] = heading.clone();
            let caption = if several { Both { en, zh } } else { each!("Vector loop").into() };
            out.views.push(view(w, &arrows(&all, of, Some(out.steps.len())), caption));
            out.steps.extend(of.iter().map(|v| in_both(&words, |words| words.vector(v))));
        }
        for (en, zh) in words[0].steps(g).into_iter().zip(words[1].steps(g)) {
            out.formulas.insert(out.steps.len(), en.1);
            out.steps.push(Both { en: en.0, zh: zh.0 });
        }
    }
    let [en, zh] = words.each_ref().map(|words| words.given_steps());
    out.steps.extend(en.into_iter().zip(zh).map(|(en, zh)| Both { en, zh }));
    let [en, zh] = words.each_ref().map(|words| words.motion_steps());
    for (axes, (en, zh)) in coordinates(w, &all.motion).into_iter().zip(en.into_iter().zip(zh)) {
        let MotionAxes { places: [from, corner, to], symbols: [x, y], caption } = axes;
        let step = Some(out.steps.len());
        let arrow = |symbol: String, key: &str, places: [Point; 2]| {
            let key = format!("{}-{key}", out.views.len() + 1);
            LoopArrow { symbol, key, places, angle: None, step }
        };
        let arrows = [arrow(x, "x", [from, corner]), arrow(y, "y", [corner, to])];
        out.views.push(view(w, &arrows, caption));
        for (en, zh) in en.into_iter().zip(zh) {
            out.formulas.insert(out.steps.len(), en.1);
            out.steps.push(Both { en: en.0, zh: zh.0 });
        }
    }
    Ok((!out.views.is_empty()).then_some(out))
}

/// The mechanism with arrows.
fn view(w: &FigureInput, arrows: &[LoopArrow], caption: Both) -> ParticleView {
    let part = looped(&w.options.style, w.scene, w.worked, &w.options.notation, arrows);
    let scales = vec![(DiagramKind::Plane, w.worked.construction.diagram.mu)];
    ParticleView { part, caption, scales }
}

/// The coordinates of a point, absolute or in a frame.
struct MotionAxes {
    /// The origin, the foot on the first axis, the point (m).
    places: [Point; 3],
    symbols: [String; 2],
    caption: Both,
}

/// The coordinates of all equations of motion, in their order.
fn coordinates(w: &FigureInput, all: &MotionEquations) -> Vec<MotionAxes> {
    let at = &w.worked.configuration;
    let axes = |origin: Point, axis: Vec2, [x, y]: &[Equation; 2], caption: Both| {
        let corner = origin + axis * x.right.value();
        let places = [origin, corner, corner + axis.perp() * y.right.value()];
        MotionAxes { places, symbols: [x.left.text(), y.left.text()], caption }
    };
    let across = Vec2::new(1.0, 0.0);
    let mut out = Vec::new();
    for p in &all.points {
        let name = w.scene.point_name(p.of);
        if let Some([place, ..]) = &p.absolute {
            let caption = both!("Coordinates of point {name}");
            out.push(axes(Point::ORIGIN, across, place, caption));
        }
        for f in &p.frames {
            let origin = at.points[f.origin.0].unwrap_or(Point::ORIGIN);
            let turned = match f.frame {
                Frame::Link(l) => at.direction(w.scene, l).and_then(Vec2::unit),
                Frame::Point(_) => None,
            };
            let caption = match f.frame {
                Frame::Link(l) => {
                    both!("Coordinates of point {name} on link {}", w.scene.link_name(l))
                }
                Frame::Point(_) => {
                    both!("Coordinates of point {name} from point {}", w.scene.point_name(f.origin))
                }
            };
            out.push(axes(origin, turned.unwrap_or(across), &f.relative[0], caption));
        }
    }
    out
}

/// A sentence in both languages.
fn in_both(words: &[LoopWords; 2], of: impl Fn(&LoopWords) -> String) -> Both {
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
