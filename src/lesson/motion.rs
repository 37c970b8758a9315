//! The lesson of a motion without a mechanism: one HTML page with the construction step by step at
//! an instant that the reader moves.
//!
//! This module chooses the instants that the page holds and one set of scales for them. The
//! drawings are those of [`crate::figure::particle`], the numbers those of [`crate::particle`]: at
//! each instant the motion is solved and drawn anew. The page fetches nothing and holds both
//! languages.

use super::player::{PlayerPage, drawings, legible, sizes};
use super::steps::LANGS;
use crate::diag::{Diagnostic, Faults, both};
use crate::digits::significant;
use crate::figure::particle::{ALONE, ParticleDrafter, ParticleView, notation};
use crate::geom::Point;
use crate::paper::label::Label;
use crate::paper::style::Style;
use crate::particle::board::{MotionDrawing, Views, draw, draw_again};
use crate::particle::{ParticleProblem, ParticleSolution, solve, solve_again};
use crate::render::math::mathml;
use crate::report::answers::DIGITS;
use crate::report::html::sentence as html;
use crate::report::particle as report;
use crate::scene::Lang;
use hodograph_base::lang::each;
use serde_json::{Value, json};

/// Words of this page in addition to those of the player.
const WORDS: [(&str, [&str; 2]); 6] = [
    ("home", each!("Back to the given instant")),
    ("instant", each!("The instant")),
    ("given", each!("given instant")),
    ("answers", each!("Answers at the instant")),
    (
        "keys",
        each!(
            "Keys: → and ← the steps of the construction; + and − the instant, 0 the given one; Space runs; L language; D light or dark; P print; S window of the speaker."
        ),
    ),
    (
        "noscript",
        each!(
            "The page needs JavaScript to move; without it, it shows the finished construction at the given instant."
        ),
    ),
];

/// An instant has its own scale if its vectors need one coarser by this factor than the given
/// instant: otherwise all other instants would be drawn too small.
const COARSER: f64 = 4.0;
/// The part of the time to a meeting that is shown: at the meeting the two points coincide, and the
/// line between them has no direction.
const SHOWN: f64 = 0.995;

/// Options of the page.
#[derive(Clone, Debug)]
pub struct MotionOptions {
    /// The language in which the page opens; it holds both, the notation is that of this language.
    pub lang: Lang,
    /// Weights, sizes and fonts of the drawings; the page sets the colours.
    pub style: Style,
    /// Number of instants in addition to the given one.
    pub positions: usize,
    /// Index of the motion among those that have something to draw, from 0.
    pub motion: usize,
}

/// An instant of the page.
struct MotionFrame {
    problem: ParticleProblem,
    solved: ParticleSolution,
    drawn: MotionDrawing,
}

impl MotionFrame {
    /// The frame of another instant; a pursuit continues from its state at this one.
    fn at(&self, t: f64) -> Result<MotionFrame, Faults> {
        let problem = self.problem.at(t, None)?;
        let solved = solve_again(&problem, &self.solved)?;
        let drawn = self.drawn_again(&problem)?;
        Ok(MotionFrame { problem, solved, drawn })
    }

    fn drawn_again(&self, problem: &ParticleProblem) -> Result<MotionDrawing, Faults> {
        let all = draw_again(problem, std::slice::from_ref(&self.drawn))?;
        Ok(all
            .into_iter()
            .find(|d| d.motion == self.drawn.motion)
            .ok_or_else(|| nothing(self.drawn.motion))?)
    }

    /// The frame drawn to other scales.
    fn scaled(self, mu: [f64; 3]) -> Result<MotionFrame, Faults> {
        let problem = self.problem.at(self.problem.instant(), Some(mu))?;
        let drawn = self.drawn_again(&problem)?;
        Ok(MotionFrame { problem, drawn, ..self })
    }

    fn maker<'a>(
        &'a self,
        style: &'a Style,
        lang: Lang,
        also: &'a [Vec<Point>; 2],
    ) -> ParticleDrafter<'a> {
        ParticleDrafter { problem: &self.problem, solved: &self.solved, style, lang, also }
    }
}

fn nothing(which: usize) -> Diagnostic {
    let d = Diagnostic::error(
        "driver",
        both!("there is no motion {} that has something to draw", which + 1),
    );
    d.help(both!(
        "pursuers, and points that move on something, have a construction; --driver counts them from 1"
    ))
}

/// The page of one motion of a file.
///
/// ```
/// use hodograph::{paper::style::Style, lesson::motion, particle, scene::Lang};
/// let problem = particle::read(particle::templates::get("plate-in-space").unwrap())?.value;
/// let options = motion::MotionOptions { lang: Lang::En, style: Style::default(), positions: 8, motion: 0 };
/// assert!(motion::lesson(&problem, &options)?.starts_with("<!DOCTYPE html>"));
/// # Ok::<(), hodograph::diag::Faults>(())
/// ```
///
/// # Errors
/// The motion is not there, or cannot be solved at the given instant; those of the SVG writer.
pub fn lesson(problem: &ParticleProblem, options: &MotionOptions) -> Result<String, Faults> {
    let (frames, base) = frames(problem, options)?;
    let also = needed_points(&frames);
    let given = &frames[base];
    let style = legible(&options.style, |style| {
        Ok(sizes(&seen(&given.maker(style, options.lang, &also), &given.drawn, None)?))
    })?;
    // First the fixed items, then the drawing of each instant.
    let still = given.maker(&style, options.lang, &also).course(&given.drawn, false);
    let mut views: Vec<Vec<ParticleView>> = Vec::new();
    for f in &frames {
        views.push(seen(&f.maker(&style, options.lang, &also), &f.drawn, still.as_ref())?);
    }
    let told: Vec<Value> =
        frames.iter().zip(&views).map(|(f, v)| instant_json(f, v, &style)).collect();
    let title = &problem.title;
    let views: Vec<&[ParticleView]> = views.iter().map(Vec::as_slice).collect();
    let page = PlayerPage {
        title: [title.en.as_str(), title.zh.as_str()],
        lang: options.lang,
        words: &WORDS,
        base,
        type_mm: style.small_mm,
        data: json!({"frames": told}),
    };
    Ok(page.written(&drawings(&views, still.as_ref(), base, &problem.book)?))
}

/// The instants, to one set of scales as far as possible, and the index of the given one.
fn frames(
    problem: &ParticleProblem,
    options: &MotionOptions,
) -> Result<(Vec<MotionFrame>, usize), Faults> {
    let which = options.motion;
    let drawn = draw(problem)?.into_iter().nth(which).ok_or_else(|| nothing(which))?;
    let given = MotionFrame { problem: problem.clone(), solved: solve(problem)?, drawn };
    let now = problem.instant();
    let last = match &given.drawn.views {
        Views::Chase { until, meets, .. } => {
            if *meets {
                SHOWN * until
            } else {
                *until
            }
        }
        Views::Plate { .. } if now > 0.0 => 2.0 * now,
        Views::Plate { .. } => 1.0,
    };
    let count = options.positions.clamp(8, 360);
    let mut times: Vec<f64> = (0..=count)
        .map(|k| last * k as f64 / count as f64)
        .filter(|t| (t - now).abs() > 1e-6 * last)
        .collect();
    times.push(now);
    times.sort_by(f64::total_cmp);
    // An instant at which a law has no value has no picture.
    let natural: Vec<MotionFrame> = times.iter().filter_map(|t| given.at(*t).ok()).collect();
    let usual = [0, 1, 2].map(|k| {
        let own = given.drawn.mu[k];
        natural.iter().map(|f| f.drawn.mu[k]).filter(|mu| *mu <= COARSER * own).fold(own, f64::max)
    });
    let frames: Vec<MotionFrame> = natural
        .into_iter()
        .map(|f| {
            let mu = [0, 1, 2].map(|k| f.drawn.mu[k].max(usual[k]));
            if mu == f.drawn.mu { Ok(f) } else { f.scaled(mu) }
        })
        .collect::<Result<_, Faults>>()?;
    let Some(base) = frames.iter().position(|f| f.problem.instant() == now) else {
        return Err(nothing(which).into());
    };
    Ok((frames, base))
}

/// Points that the two views of a plate must hold at any instant.
fn needed_points(frames: &[MotionFrame]) -> [Vec<Point>; 2] {
    let mut out = ALONE;
    for f in frames {
        let Views::Plate { places, velocities, accelerations, .. } = &f.drawn.views else {
            continue;
        };
        for k in 0..2 {
            out[k].push(places[k]);
            out[k].extend(velocities[k].iter().chain(&accelerations[k]).map(|a| a.to));
        }
    }
    out
}

/// The moving part of the views of an instant.
fn seen(
    maker: &ParticleDrafter,
    drawn: &MotionDrawing,
    still: Option<&ParticleView>,
) -> Result<Vec<ParticleView>, Diagnostic> {
    let Some(still) = still else { return maker.views(drawn) };
    let course = ParticleView {
        part: maker.pair(drawn),
        caption: still.caption.clone(),
        scales: still.scales.clone(),
    };
    Ok([course].into_iter().chain(maker.polygons(drawn)).collect())
}

/// Data of an instant: its time, the sentences of the steps, the answers, the scales of the
/// drawings.
fn instant_json(f: &MotionFrame, views: &[ParticleView], style: &Style) -> Value {
    let both_of = |say: &dyn Fn(Lang) -> String| json!(LANGS.map(say));
    let steps: Vec<Value> = f
        .drawn
        .steps
        .iter()
        .map(|s| both_of(&|lang| html(&report::sentence(s, lang, &notation(style, lang)))))
        .collect();
    let answers = both_of(&|lang| {
        let lines = report::lines(&f.problem, &f.solved, DIGITS, lang, &notation(style, lang));
        lines.iter().map(|l| format!("<li>{}</li>", html(l))).collect()
    });
    let scales: Vec<String> =
        views.iter().map(|v| mathml(&Label::math(v.scale(&f.problem.book)))).collect();
    let at = format!("t = {} s", significant(f.problem.instant(), 5));
    json!({"at": at, "steps": steps, "answers": answers, "scales": scales})
}
