//! Function generation 按两连架杆对应位置, `"synthesis": "function"`: the output angle as a function of the
//! crank angle.
//!
//! The function is either y(x) at Chebyshev's precision points x_k = (a+b)/2 − (b−a)/2
//! cos((2k−1)π/2n), or pairs of angles. A starting angle that is not given is an unknown. As many
//! pairs as unknowns are met exactly ([`freudenstein`]; with crank and frame given, by inversion),
//! more by least squares; or the greatest deviation is minimised (`"fit": "minimax"`).

mod course;
mod drawing;
mod explained;
pub mod freudenstein;
mod laid;
mod nearest;
mod solutions;

use super::board::SynthesisBoard;
use super::candidate::{DesignNumber, Draft, WantedPosition};
use super::form::TaskForm;
use super::fourbar::{FourBar, Heading, named_lengths};
use super::{KindOfTask, Proof, Statement, TaskResult, Wish};
use freudenstein::{Generator, Steps};
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::digits::{metres, shortest};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::each;
use hodograph_scene::front::Curve;
use std::f64::consts::PI;

/// Function generation as a kind of task.
pub const KIND: KindOfTask = KindOfTask {
    name: "function",
    what: each!("the follower's angle as a function of the crank's"),
    keys: &["function", "points", "fit", "input", "output", "pairs", "relative", "frame", "crank"],
    read,
};

/// Largest number of steps of the table of wanted and actual angles.
const MOST_STEPS: f64 = 7200.0;
/// The frame if no size is given (m).
const USUAL_FRAME: f64 = 0.1;

#[derive(Clone, Debug)]
struct Function {
    target: FunctionTarget,
    steps: Steps,
    /// Starting angles, if given (rad).
    start: [Option<f64>; 2],
    minimax: bool,
    frame: Option<f64>,
    crank: Option<f64>,
}

/// The function that the output follows.
#[derive(Clone, Debug)]
enum FunctionTarget {
    /// Pairs of angles; `zero` is the angle from which the first output angle is counted (rad).
    Pairs { zero: f64 },
    /// y(x) over a range, with the swings of input and output.
    Curve {
        text: String,
        curve: Box<Curve>,
        range: [f64; 2],
        swings: [f64; 2],
        values: [f64; 2],
        places: Vec<f64>,
        /// The step of the table of wanted and actual angles, as an angle of the input (rad).
        table: Option<f64>,
    },
}

impl FunctionTarget {
    /// The input and output angles at x, from their starting angles (rad).
    fn step(&self, x: f64) -> Option<[f64; 2]> {
        let FunctionTarget::Curve { curve, range, swings, values, .. } = self else { return None };
        let along = (x - range[0]) / (range[1] - range[0]);
        let up = (curve.at(x).ok()? - values[0]) / (values[1] - values[0]);
        Some([swings[0] * along, swings[1] * up])
    }
}

fn read(form: &TaskForm) -> Option<Box<dyn Wish>> {
    let fit = if form.has("fit") { form.choice("fit", &["points", "minimax"])? } else { "points" };
    let frame = if form.has("frame") { Some(form.size("frame")?) } else { None };
    let crank = if form.has("crank") { Some(form.size("crank")?) } else { None };
    if form.has("function") && form.has("pairs") {
        let message =
            both!("`function` and `pairs` are both given: each alone says what is wanted");
        form.fault(
            Diagnostic::error("wrong-given", message)
                .at(form.span("pairs"))
                .help(both!("leave one of the two out")),
        );
        return None;
    }
    for (key, with) in [("points", "pairs"), ("relative", "function")] {
        if form.has(key) && form.has(with) {
            let message = both!("`{key}` has no meaning beside `{with}`");
            form.fault(
                Diagnostic::error("wrong-given", message)
                    .at(form.span(key))
                    .help(both!("leave it out")),
            );
        }
    }
    let (target, steps, start) = match (form.has("function"), form.has("pairs")) {
        (true, false) => of_curve(form)?,
        (false, true) => of_pairs(form)?,
        _ => {
            let d =
                Diagnostic::error("missing-key", both!("one of `function` and `pairs` is given"));
            form.fault(
                d.at(form.span("function")).help(both!(
                    "write \"function\": {{\"y\": \"ln(x)\", \"from\": 1, \"to\": 2}}"
                )),
            );
            return None;
        }
    };
    let minimax = fit == "minimax";
    if minimax && !matches!(target, FunctionTarget::Curve { .. }) {
        let d = Diagnostic::error("wrong-given", both!("`minimax` wants a function, not pairs"));
        form.fault(
            d.at(form.span("fit")).help(both!("leave \"fit\" out: pairs are met by least squares")),
        );
        return None;
    }
    let unknowns = 3 + start.iter().filter(|s| s.is_none()).count();
    let two = steps.len() == 2;
    if two && (crank.is_none() || frame.is_none() || start.iter().any(Option::is_none)) {
        let message = both!("two pairs leave more than crank and frame can fix");
        let help = both!("give \"crank\", \"frame\" and absolute angles, or a third pair");
        form.fault(Diagnostic::error("wrong-given", message).at(form.span("pairs")).help(help));
        return None;
    }
    let inverted = steps.len() == 3
        && start[0].is_some()
        && start[1].is_none()
        && crank.is_some()
        && frame.is_some();
    if !minimax && !inverted && !two && steps.len() < unknowns {
        let (has, free) = (steps.len(), unknowns - 3);
        let message = both!(
            "{has} points are too few for {unknowns} unknowns: three lengths and {free} starting angles"
        );
        let help = both!(
            "give {unknowns} points, a starting angle (\"from\"), or crank and frame with a given \"input\""
        );
        form.fault(Diagnostic::error("wrong-given", message).at(form.span("points")).help(help));
        return None;
    }
    let alike = steps.iter().all(|[t, p]| t == p);
    if !inverted && !two && !alike && crank.is_some() && frame.is_some() {
        let message = both!(
            "`crank` and `frame` are both given, but the pairs leave only the size free: the proportions follow from them"
        );
        let help = both!(
            "leave one of the two out; three pairs with a given \"input\" and \"relative\": \"output\" take both"
        );
        form.fault(Diagnostic::error("given-twice", message).at(form.span("crank")).help(help));
        return None;
    }
    if let Some((i, j)) = coincide(&steps) {
        let message = both!("the input is the same at points {i} and {j}");
        form.fault(
            Diagnostic::error("precision-points-coincide", message)
                .at(form.span("pairs"))
                .help(both!("leave one of them out")),
        );
        return None;
    }
    Some(Box::new(Function { target, steps, start, minimax, frame, crank }))
}

fn coincide(steps: &Steps) -> Option<(usize, usize)> {
    let pairs = (0..steps.len()).flat_map(|j| (0..j).map(move |i| (i, j)));
    pairs
        .into_iter()
        .find(|&(i, j)| libm::sin((steps[i][0] - steps[j][0]) / 2.0).abs() < 1e-12)
        .map(|(i, j)| (i + 1, j + 1))
}

type FunctionGivens = (FunctionTarget, Steps, [Option<f64>; 2]);

/// Reads precision points with Chebyshev's spacing.
fn of_curve(form: &TaskForm) -> Option<FunctionGivens> {
    let f = form.inner("function", &["y", "from", "to", "step"])?;
    f.need("y", "\"ln(x)\"")?;
    let curve = f.curve("y", "x");
    let text = f.word("y").map_or_else(String::new, |w| w.text);
    let end = |key: &str| f.need(key, "1").and_then(|_| f.number_or_angle(key));
    let (from, to) = (end("from"), end("to"));
    // A range of angles, such as 0 to 90 deg; zero needs no unit.
    let angle = from.zip(to).and_then(|(p, q)| p.1.or(q.1));
    if let Some((p, q)) =
        from.zip(to).filter(|(p, q)| [p, q].iter().any(|v| v.1 != angle && v.0 != 0.0))
    {
        let message = both!("the range goes from {} to {}: of two kinds or units", p.0, q.0);
        let help = both!("write both in degrees, both in radians, or both without a unit");
        form.fault(Diagnostic::error("dimension", message).at(f.span("to")).help(help));
        return None;
    }
    let (from, to) = (from.map(|v| v.0), to.map(|v| v.0));
    let curve = curve.map(|c| match angle {
        Some(degrees) => c.of_angle(degrees),
        None => c,
    });
    let fit_five = form.word("fit").is_some_and(|w| w.text == "minimax");
    let n = if fit_five {
        Some(5)
    } else if form.has("points") {
        form.count("points", 2, 60)
    } else {
        Some(3)
    };
    let scale = |key: &str| {
        form.need(key, "{\"from\": \"86 deg\", \"swing\": \"60 deg\"}")?;
        let inner = form.inner(key, &["from", "swing"])?;
        let swing = inner.need_angle("swing", "\"60 deg\"")?;
        if swing == 0.0 {
            let d = Diagnostic::error("out-of-range", both!("the swing of {key} is zero"));
            form.fault(d.at(inner.span("swing")).help(both!("write \"swing\": \"60 deg\"")));
            return None;
        }
        Some((if inner.has("from") { Some(inner.angle("from")?) } else { None }, swing))
    };
    let (input, output) = (scale("input"), scale("output"));
    let (curve, from, to, n, input, output) = (curve?, from?, to?, n?, input?, output?);
    if from == to {
        let d = Diagnostic::error("out-of-range", both!("the range of x is empty"));
        form.fault(d.at(f.span("to")).help(both!("write \"to\": {}", from + 1.0)));
        return None;
    }
    let table = if f.has("step") { Some(f.angle("step")?) } else { None };
    if let Some(step) = table.filter(|s| !(*s > 0.0 && input.1.abs() / *s <= MOST_STEPS)) {
        let message = both!(
            "a step of {}° does not divide the input's swing of {}° into 1 to {MOST_STEPS} parts",
            shortest(step.to_degrees()),
            shortest(input.1.to_degrees())
        );
        let help = both!("write \"step\": \"0.5 deg\"");
        form.fault(Diagnostic::error("out-of-range", message).at(f.span("step")).help(help));
        return None;
    }
    let hint = if angle.is_some() || ["sin", "cos", "tan"].iter().any(|f| text.contains(f)) {
        both!("where x is an angle, write the range so: \"from\": \"0 deg\"")
    } else {
        both!("take a range on which the function has a value everywhere")
    };
    let value = |x: f64| {
        let faulty = |d: Diagnostic| {
            form.fault(if d.help.is_none() { d.help(hint.clone()) } else { d }.at(f.span("y")))
        };
        curve.at(x).map_err(faulty).ok()
    };
    let values = [value(from)?, value(to)?];
    if values[0] == values[1] {
        let message = both!("y has the same value at both ends: the output's swing has no scale");
        form.fault(
            Diagnostic::error("out-of-range", message)
                .at(f.span("y"))
                .help(both!("take a range on which y rises or falls")),
        );
        return None;
    }
    let places = chebyshev(from, to, n);
    for x in &places {
        value(*x)?;
    }
    let target = FunctionTarget::Curve {
        text,
        curve: Box::new(curve),
        range: [from, to],
        swings: [input.1, output.1],
        values,
        places: places.clone(),
        table,
    };
    let steps = places.iter().filter_map(|x| target.step(*x)).collect();
    Some((target, steps, [input.0, output.0]))
}

/// Precision points: the zeros of Chebyshev's polynomial over the range.
pub fn chebyshev(from: f64, to: f64, n: usize) -> Vec<f64> {
    (1..=n)
        .map(|k| {
            (from + to) / 2.0
                - (to - from) / 2.0 * libm::cos((2 * k - 1) as f64 * PI / (2 * n) as f64)
        })
        .collect()
}

/// Reads pairs as written: absolute, or counted from a given start (`from`), or from an unknown one
/// (`relative`).
fn of_pairs(form: &TaskForm) -> Option<FunctionGivens> {
    let items = form.items("pairs", "[[\"60 deg\", \"0 deg\"], ...]", 2)?;
    let pair = |n| {
        let [input, output] = form.several::<2>(n, "pairs", "[\"60 deg\", \"0 deg\"]")?;
        let (input, output) = (form.angle_of(input, "pairs"), form.angle_of(output, "pairs"));
        Some([input?, output?])
    };
    let pairs: Vec<Option<[f64; 2]>> = items.iter().map(pair).collect();
    let pairs = pairs.into_iter().collect::<Option<Vec<_>>>()?;
    let relative = if form.has("relative") {
        form.choice("relative", &["input", "output", "both"])?
    } else {
        ""
    };
    let free = [matches!(relative, "input" | "both"), matches!(relative, "output" | "both")];
    let mut start = [None; 2];
    let mut zero = [0.0; 2];
    for (side, key) in ["input", "output"].into_iter().enumerate() {
        let from = match form.inner(key, &["from"]) {
            Some(inner) if inner.has("from") => Some(inner.angle("from")?),
            _ => None,
        };
        match from {
            Some(_) if free[side] => {
                let message = both!(
                    "the angles of the {key} count from an unknown start, and from a given one"
                );
                let help = both!("leave out \"relative\" or \"from\"");
                form.fault(Diagnostic::error("wrong-given", message).at(form.span(key)).help(help));
                return None;
            }
            // Angles from a given start are used as written; others count from the first.
            Some(from) => start[side] = Some(from),
            None => {
                zero[side] = pairs[0][side];
                start[side] = (!free[side]).then_some(zero[side]);
            }
        }
    }
    let steps = pairs.iter().map(|p| [p[0] - zero[0], p[1] - zero[1]]).collect();
    Some((FunctionTarget::Pairs { zero: zero[1] }, steps, start))
}

impl Wish for Function {
    fn title(&self) -> Both {
        if matches!(self.target, FunctionTarget::Pairs { .. }) {
            return both!("Function generator for {} pairs of angles", self.steps.len());
        }
        both!("Function generator with {} precision points", self.steps.len())
    }

    fn solve(&self, heading: &Heading) -> Result<TaskResult, Faults> {
        let mut notes = Vec::new();
        let mut numbers = Vec::new();
        if let FunctionTarget::Curve { curve, places, .. } = &self.target {
            for ((k, x), [alpha, phi]) in places.iter().enumerate().zip(&self.steps) {
                let named = |letter: &str| format!("{letter}{}", k + 1);
                numbers.push(DesignNumber::ratio(&named("x"), both!("precision point"), *x));
                numbers.extend(curve.at(*x).ok().map(|y| {
                    DesignNumber::ratio(&named("y"), both!("value at the precision point"), y)
                }));
                numbers.push(DesignNumber::angle(
                    &named("alpha"),
                    both!("the input's turn from its start"),
                    *alpha,
                ));
                numbers.push(DesignNumber::angle(
                    &named("phi"),
                    both!("the output's turn from its start"),
                    *phi,
                ));
            }
        }
        let none =
            |message: Both| Diagnostic::error("no-real-solution", message).help(self.nearest());
        let generators = self.generators().map_err(none)?;
        let unit = self.unit(&mut notes);
        let drafts: Vec<Draft> = generators
            .iter()
            .filter_map(|(which, g)| self.draft(which, g, unit, heading))
            .collect();
        if drafts.is_empty() {
            let message = both!(
                "the coupler's length comes out imaginary: no four-bar closes at these points"
            );
            return Err(none(message).into());
        }
        Ok(TaskResult { drafts, numbers, notes })
    }

    fn construct(&self, draft: &Draft, board: &mut SynthesisBoard) -> Option<()> {
        self.drawn(draft, board)
    }

    fn statement(&self) -> Statement {
        self.stated()
    }

    fn proof(&self, draft: &Draft) -> Vec<Proof> {
        self.proved(draft)
    }
}

impl Function {
    /// Metres for a frame of 1.
    fn unit(&self, notes: &mut Vec<Diagnostic>) -> Option<f64> {
        match (self.frame, self.crank) {
            (Some(frame), _) => Some(frame),
            (None, Some(_)) => None,
            (None, None) => {
                let message =
                    both!("the size is free: a frame of {} is taken", metres(USUAL_FRAME));
                notes.push(
                    Diagnostic::note("free-choice", message)
                        .help(both!("give \"frame\" or \"crank\"")),
                );
                Some(USUAL_FRAME)
            }
        }
    }

    fn draft(
        &self,
        which: &Both,
        g: &Generator,
        unit: Option<f64>,
        heading: &Heading,
    ) -> Option<Draft> {
        let turned: Vec<&str> =
            ["AB", "DC"].into_iter().zip(g.k).filter(|(_, k)| *k < 0.0).map(|(n, _)| n).collect();
        let raw = *g;
        let g = g.upright();
        let [a, b, c] = g.lengths()?;
        let unit = unit.unwrap_or_else(|| self.crank.unwrap_or(USUAL_FRAME) / a);
        let d = Point::new(unit, 0.0);
        // Angles are counted from the start with positive arms, modulo full turns.
        let place = |s: &[f64; 2]| {
            let psi = g.output(s[0], g.start[1] + s[1])?;
            let (crank, follower) = (Vec2::from_angle(g.start[0] + s[0]), Vec2::from_angle(psi));
            Some(((crank * (a * unit)).to_point(), d + follower * (c * unit)))
        };
        let wanted: Option<Vec<WantedPosition>> = self
            .steps
            .iter()
            .map(|s| {
                let (b, c) = place(s)?;
                Some(WantedPosition {
                    driver: g.start[0] + s[0],
                    places: vec![("B".into(), b), ("C".into(), c)],
                })
            })
            .collect();
        let wanted = wanted?;
        let (b1, c1) = place(&self.steps[0])?;
        let four = FourBar { a: Point::ORIGIN, b: b1, c: c1, d, e: None };
        let mut numbers = named_lengths([a * unit, b * unit, c * unit, unit]);
        for (i, (name, what)) in [
            ("alpha0", both!("starting angle of the crank")),
            ("phi0", both!("starting angle of the follower")),
        ]
        .into_iter()
        .enumerate()
        {
            numbers.push(DesignNumber::angle(name, what, g.start[i]));
        }
        numbers.extend(raw.k.iter().enumerate().map(|(i, k)| {
            DesignNumber::ratio(&format!("K{}", i + 1), both!("Freudenstein's constant"), *k)
        }));
        // The form of Chinese course books: cos α = P₀ cos φ + P₁ cos(φ − α) + P₂ with lengths in
        // units of the crank.
        let [k1, k2, k3] = raw.k;
        numbers.extend([("P0", k1 / k2), ("P1", -1.0 / k2), ("P2", k3 / k2)].map(|(name, p)| {
            DesignNumber::ratio(name, both!("constant of the linear equations"), p)
        }));
        numbers.extend([("m", c / a), ("n", 1.0 / a), ("l", b / a)].map(|(name, ratio)| {
            let what = both!("length in units of the crank");
            DesignNumber::ratio(name, what, ratio)
        }));
        let exact = self.steps.iter().all(|s| g.rest(*s).abs() < 1e-9);
        let missed = self.deviations(&g, &mut numbers);
        let error = if exact { 0.0 } else { missed };
        if error > 0.0 {
            numbers.extend(self.outputs(&g, &numbers));
        }
        let mut remarks = Vec::new();
        if !turned.is_empty() {
            let message =
                both!("{} comes out negative: the arm is turned by 180°", Both::names(&turned));
            remarks.push(Diagnostic::note("turned-arm", message));
        }
        Some(Draft {
            ordered: true,
            error,
            course: self.sampled(&g),
            whole_course: matches!(self.target, FunctionTarget::Curve { table: Some(_), .. }),
            remarks,
            ..Draft::new(which.clone(), four.scene(heading), numbers, wanted)
        })
    }
}
