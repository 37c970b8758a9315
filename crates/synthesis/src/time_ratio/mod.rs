//! Time ratio 急回, `"synthesis": "time-ratio"`: linkages with two strokes of unequal duration.
//!
//! θ = 180°(K − 1)/(K + 1) is the crank angle between the limit positions 极位夹角. Each linkage has
//! its own file.

mod bar;
mod crank_rocker;
mod slider_crank;
mod slotted;

use super::form::TaskForm;
use super::{KindOfTask, Wish};
use hodograph_base::diag::{Diagnostic, both};
use hodograph_base::lang::each;
pub(super) use slider_crank::sketch;
use std::f64::consts::PI;

/// Time ratio as a kind of task.
pub const KIND: KindOfTask = KindOfTask {
    name: "time-ratio",
    what: each!("linkages with a quick return, from the time ratio K"),
    keys: &[
        "linkage", "K", "theta", "rocker", "frame", "limit", "swing", "gamma", "best", "line",
        "stroke", "offset", "crank", "coupler", "rod", "link",
    ],
    read,
};

/// Reads the task for a linkage.
type TimeRatioReader = fn(&TaskForm) -> Option<Box<dyn Wish>>;

/// The linkages, each with its reader.
const LINKAGES: [(&str, TimeRatioReader); 5] = [
    ("crank-rocker", crank_rocker::read),
    ("slider-crank", slider_crank::read),
    ("slotted-lever", slotted::lever),
    ("whitworth", slotted::whitworth),
    ("shaper", slotted::shaper),
];

fn read(form: &TaskForm) -> Option<Box<dyn Wish>> {
    form.need("linkage", "\"crank-rocker\"")?;
    let name = form.choice("linkage", &LINKAGES.map(|l| l.0))?;
    LINKAGES.iter().find(|l| l.0 == name).and_then(|(_, read)| read(form))
}

/// The time ratio and its angle θ, from either; a K below one is inverted and applies to the other
/// stroke.
#[derive(Clone, Copy, Debug)]
pub(super) struct StrokeRatio {
    /// K, at least 1.
    pub k: f64,
    /// θ (rad).
    pub theta: f64,
    /// True if 1/K was taken.
    pub turned: bool,
}

impl StrokeRatio {
    fn read(form: &TaskForm) -> Option<StrokeRatio> {
        if form.has("K") && form.has("theta") {
            let d = Diagnostic::error("given-twice", both!("`K` and `theta` say the same"));
            form.fault(d.at(form.span("theta")).help(both!("keep one of the two")));
            return None;
        }
        if form.has("theta") {
            let theta = form.angle("theta")?;
            if !(0.0..PI).contains(&theta) {
                let d = Diagnostic::error(
                    "out-of-range",
                    both!("`theta` lies from 0° to less than 180°"),
                );
                form.fault(
                    d.at(form.span("theta"))
                        .help(both!("write \"theta\": \"30 deg\", or \"K\": 1.4")),
                );
                return None;
            }
            return Some(StrokeRatio { k: (PI + theta) / (PI - theta), theta, turned: false });
        }
        form.need("K", "1.5")?;
        let k = form.number("K")?;
        if k <= 0.0 {
            let d = Diagnostic::error("not-positive", both!("`K` must be greater than zero"));
            form.fault(d.at(form.span("K")).help(both!("write \"K\": 1.4; 1 is no quick return")));
            return None;
        }
        let (k, turned) = if k < 1.0 { (1.0 / k, true) } else { (k, false) };
        Some(StrokeRatio { k, theta: PI * (k - 1.0) / (k + 1.0), turned })
    }

    /// Notes on the ratio.
    pub fn notes(self) -> Vec<Diagnostic> {
        let message = both!("K is below one: taken as 1/K, the slow stroke is the other one");
        self.turned.then(|| Diagnostic::note("K-below-one", message)).into_iter().collect()
    }
}

/// Strokes with crank angles that differ by less than this (rad) take equal times: the difference
/// is rounding.
const ALIKE: f64 = 1e-9;

/// A note that names the slow stroke, to choose the crank's sense of rotation.
pub(super) fn slow_stroke(first: f64, second: f64, omega: f64) -> Diagnostic {
    let way = (if omega < 0.0 { first - second } else { second - first }).rem_euclid(2.0 * PI);
    if (way - PI).abs() < ALIKE {
        return Diagnostic::note("slow-stroke", both!("both strokes take the same time"));
    }
    let (from, to) = if way >= PI { (1, 2) } else { (2, 1) };
    let sense = if omega < 0.0 { both!("clockwise") } else { both!("counter-clockwise") };
    Diagnostic::note(
        "slow-stroke",
        both!("with the crank turning {} the stroke from C{from} to C{to} is the slow one", sense),
    )
}
