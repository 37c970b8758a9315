//! Working strokes of loads that act over a part of a stroke: where they begin and end.

use super::Placed;
use super::extreme::{Extreme, Limits, Output, limits};
use hodograph_base::diag::{Diagnostic, Faults, both};
use hodograph_base::geom::Vec2;
use hodograph_base::trig::sin_cos;
use hodograph_mechanism::mechanism::Mechanism;
use hodograph_mechanism::position::{Configuration, Path};
use hodograph_scene::{Along, Applied, Given, Scene};
use std::f64::consts::TAU;

/// An extreme position is known to so much of the stroke.
const TOLD: f64 = 1e-13;

/// Strokes whose crank angles differ by less than this (rad) are equally slow.
const EQUAL: f64 = 1e-9;

/// The scene with the ends of the working strokes of its loads, as the first driver moves.
///
/// # Errors
/// `stroke`: the point has no stroke, or the file does not tell which of its two strokes is the working one; those of [`limits`].
pub fn with_strokes(mut scene: Scene) -> Result<Scene, Faults> {
    if scene.loads.applied.iter().all(|a| !lacks_ends(a)) {
        return Ok(scene);
    }
    let mechanism = Mechanism::new(&scene)?.value;
    let all = limits(&scene, &mechanism, 0)?;
    let at = Placed::new(&scene, &mechanism)?.at;
    let mut faults = Faults::default();
    let found: Vec<Option<[Given; 2]>> = scene
        .loads
        .applied
        .iter()
        .map(|a| lacks_ends(a).then(|| ends(&scene, &all, &at, a).map_err(|d| faults.push(d)).ok()).flatten())
        .collect();
    if faults.has_errors() {
        return Err(faults);
    }
    for (load, found) in scene.loads.applied.iter_mut().zip(found) {
        if let (Some(Along::Stroke { ends, .. }), Some(found)) = (load.course.as_mut().map(|c| &mut c.along), found) {
            *ends = Some(found);
        }
    }
    Ok(scene)
}

/// True for a load over a stroke whose ends are not known.
pub fn lacks_ends(load: &Applied) -> bool {
    load.course.as_ref().is_some_and(|c| matches!(c.along, Along::Stroke { ends: None, .. }))
}

/// Coordinates at which the working stroke of a load begins and ends.
fn ends(scene: &Scene, all: &Limits, at: &Configuration, load: &Applied) -> Result<[Given; 2], Diagnostic> {
    let Some((point, guide)) = load.stroke() else { return Err(no_stroke(scene, load)) };
    let swing = all.swings.iter().find(|s| s.output == Output::Sliding(guide));
    let Some(swing) = swing.filter(|s| s.stroke.is_some_and(|stroke| stroke > 0.0)) else { return Err(no_stroke(scene, load)) };
    let by_output = |a: &&Extreme, b: &&Extreme| a.output.total_cmp(&b.output);
    let (low, high) = (swing.extremes.iter().min_by(by_output), swing.extremes.iter().max_by(by_output));
    let (Some(low), Some(high)) = (low, high) else { return Err(no_stroke(scene, load)) };
    let toward = match load.course.as_ref().map(|c| &c.along) {
        Some(Along::Stroke { toward: Some(toward), .. }) => Some(toward),
        _ => None,
    };
    let upward = match toward {
        Some(toward) => {
            let Some(Path::Line { direction, .. }) = at.guides[guide.0] else { return Err(no_stroke(scene, load)) };
            let (sin, cos) = sin_cos(toward.value);
            let along = direction.dot(Vec2::new(cos, sin));
            if along.abs() < 1e-9 {
                let message = both!(
                    "the slider at {} does not move in the direction of \"toward\"",
                    "{} 处的滑块不沿 \"toward\" 的方向运动",
                    scene.point_name(point)
                );
                return Err(Diagnostic::error("stroke", message).at(toward.span));
            }
            along > 0.0
        }
        // The slower of two strokes in a full turn.
        None => {
            let rate = scene.drivers[0].rate.value;
            let slower = swing.time_ratio.filter(|_| swing.extremes.len() == 2 && rate != 0.0).map(|_| {
                let up = (high.driver - low.driver).rem_euclid(TAU);
                let up = if rate < 0.0 { TAU - up } else { up };
                up - TAU / 2.0
            });
            let Some(slower) = slower.filter(|s| s.abs() > EQUAL) else {
                let message = both!(
                    "which of the two strokes of {} is the working one is not told",
                    "没有说明 {} 的哪一个行程是工作行程",
                    scene.point_name(point)
                );
                let help = both!(
                    "add \"toward\": \"0 deg\", the direction of the working stroke",
                    "请加上 \"toward\": \"0 deg\"（工作行程的方向）"
                );
                return Err(Diagnostic::error("stroke", message).at(span(load)).help(help));
            };
            slower > 0.0
        }
    };
    let error = TOLD * (high.output - low.output).max(low.output.abs()).max(high.output.abs());
    let given = |e: &Extreme| Given { value: e.output, radius: error, text: String::new(), span: span(load) };
    Ok(if upward { [given(low), given(high)] } else { [given(high), given(low)] })
}

fn span(load: &Applied) -> hodograph_base::diag::Span {
    load.course.as_ref().map_or(load.span, |c| c.span)
}

fn no_stroke(scene: &Scene, load: &Applied) -> Diagnostic {
    let name = load.stroke().map_or("", |(p, _)| scene.point_name(p));
    let message = both!(
        "{name} has no stroke over the motion of the driver: it does not go to and fro",
        "原动件运动时 {name} 没有行程：它不作往复运动"
    );
    let help = both!(
        "tell the load without \"over\" and \"diagram\", or by the angle of a driven link",
        "请去掉 \"over\" 和 \"diagram\"，或按原动件的转角给出载荷"
    );
    Diagnostic::error("stroke", message).at(span(load)).help(help)
}
