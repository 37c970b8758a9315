//! The lesson of a motion without a mechanism: one HTML page with the construction step by step at
//! an instant that the reader moves.
//!
//! This module chooses the instants that the page holds and one set of scales for them. The
//! drawings are those of [`crate::figure::particle`], the numbers those of [`crate::particle`]: at
//! each instant the motion is solved and drawn anew. The page fetches nothing and holds both
//! languages.

use super::LARGER;
use super::design::nameless;
use super::pack::pressed;
use super::page::{BASE, filled, terse, with_fonts};
use crate::diag::{Diagnostic, Faults, both};
use crate::digits::significant;
use crate::figure::particle::{ALONE, ParticleDrafter, ParticleView, notation};
use crate::geom::Point;
use crate::paper::extent::{Rect, bounds, translate};
use crate::paper::item::FigureItem;
use crate::paper::label::Label;
use crate::paper::phrase::Phrase;
use crate::paper::style::Style;
use crate::paper::words::words as figure_words;
use crate::particle::board::{MotionDrawing, Views, draw, draw_again};
use crate::particle::{ParticleProblem, ParticleSolution, solve, solve_again};
use crate::render::escaped;
use crate::render::math::mathml;
use crate::render::number::mm;
use crate::render::svg::Elements;
use crate::report::answers::DIGITS;
use crate::report::html::sentence as html;
use crate::report::particle as report;
use crate::scene::{Book, Lang};
use serde_json::{Value, json};

const PAGE: &str =
    concat!(include_str!("head.html"), include_str!("player.html"), include_str!("motion.html"));
const STYLE: [&str; 3] = [BASE, include_str!("design.css"), include_str!("motion.css")];
const SCRIPT: &str = concat!(include_str!("motion.js"), include_str!("player.js"));

/// Words of the controls of all pages with a player: key, both languages.
pub(super) const PLAYER: [(&str, [&str; 2]); 9] = [
    ("first", ["First step", "第一步"]),
    ("previous", ["Previous step", "上一步"]),
    ("next", ["Next step", "下一步"]),
    ("last", ["Show all steps", "显示全部步骤"]),
    ("step", ["Step {} of {}", "第 {} 步，共 {} 步"]),
    ("steps", ["Construction", "作图步骤"]),
    ("play", ["Run or stop", "运动或停止"]),
    ("theme", ["Light or dark", "浅色或深色"]),
    ("language", ["中文", "English"]),
];

/// Words of this page in addition to those of [`PLAYER`].
const WORDS: [(&str, [&str; 2]); 6] = [
    ("home", ["Back to the given instant", "回到给定时刻"]),
    ("instant", ["The instant", "时刻"]),
    ("given", ["given instant", "给定时刻"]),
    ("answers", ["Answers at the instant", "该时刻的结果"]),
    (
        "keys",
        [
            "Keys: → and ← the steps of the construction; + and − the instant, 0 the given one; Space runs; L language; D light or dark.",
            "键盘：→、← 作图步骤；+、− 改变时刻，0 回到给定时刻；空格 运动；L 切换语言；D 浅色或深色。",
        ],
    ),
    (
        "noscript",
        [
            "The page needs JavaScript to move; without it, it shows the finished construction at the given instant.",
            "本页需启用 JavaScript；未启用时仅显示给定时刻完成的作图。",
        ],
    ),
];

/// Both languages, in the order of the page's pairs.
const LANGS: [Lang; 2] = [Lang::En, Lang::Zh];
/// An instant has its own scale if its vectors need one coarser by this factor than the given
/// instant: otherwise all other instants would be drawn too small.
const COARSER: f64 = 4.0;
/// The part of the time to a meeting that is shown: at the meeting the two points coincide, and the
/// line between them has no direction.
const SHOWN: f64 = 0.995;
/// Margin around a drawing (mm).
const AIR_MM: f64 = 2.0;

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
        both!(
            "there is no motion {} that has something to draw",
            "没有第 {} 个可作图的运动",
            which + 1
        ),
    );
    d.help(both!(
        "pursuers, and points that move on something, have a construction; --driver counts them from 1",
        "追踪点和在动系上运动的点有作图；--driver 从 1 数起"
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
    let style = Style {
        small_mm: options.style.small_mm * LARGER,
        label_mm: options.style.label_mm * LARGER,
        ..options.style.clone()
    };
    let (frames, base) = frames(problem, options)?;
    let also = needed_points(&frames);
    let given = &frames[base];
    // First the fixed items, then the drawing of each instant.
    let still = given.maker(&style, options.lang, &also).course(&given.drawn, false);
    let mut views: Vec<Vec<ParticleView>> = Vec::new();
    for f in &frames {
        views.push(seen(&f.maker(&style, options.lang, &also), &f.drawn, still.as_ref())?);
    }
    let told: Vec<Value> =
        frames.iter().zip(&views).map(|(f, v)| instant_json(f, v, &style)).collect();
    let title = &problem.title;
    let page = MotionPage {
        title: [title.en.as_str(), title.zh.as_str()],
        lang: options.lang,
        words: &WORDS,
        book: &problem.book,
        base,
        still: still.as_ref(),
    };
    page.written(&views, &told)
}

/// A page of poses or instants, each with its drawings, the steps of its construction and its
/// answers.
pub(super) struct MotionPage<'a> {
    /// English and Chinese.
    pub title: [&'a str; 2],
    /// The language in which it opens.
    pub lang: Lang,
    /// Words around the drawings.
    pub words: &'a [(&'a str, [&'a str; 2])],
    /// The units of the scales.
    pub book: &'a Book,
    /// The index of the given instant.
    pub base: usize,
    /// The fixed background of the first drawing, common to all instants.
    pub still: Option<&'a ParticleView>,
}

impl MotionPage<'_> {
    /// Writes the page from the drawings of each instant and its data: its name `at`, sentences of
    /// `steps`, `answers`, `scales`.
    pub fn written(&self, views: &[Vec<ParticleView>], told: &[Value]) -> Result<String, Faults> {
        let mut elements: Vec<Elements> = Vec::new();
        let mut drawings = Vec::new();
        for k in 0..views[self.base].len() {
            let ground = self.still.filter(|_| k == 0);
            let parts: Vec<&ParticleView> = views.iter().map(|v| &v[k]).collect();
            drawings.push(Sequence::of(&parts, ground, &mut elements)?);
        }
        let pairs =
            |v: &ParticleView| LANGS.map(|lang| escaped(&Phrase::new(lang.of(&v.caption)).plain()));
        let list = |lang: Lang| {
            let word = |(key, said): &(&str, [&str; 2])| {
                ((*key).to_owned(), json!(said[usize::from(lang == Lang::Zh)]))
            };
            PLAYER.iter().chain(self.words).map(word).collect::<serde_json::Map<_, _>>()
        };
        let data = json!({
            "lang": figure_words(self.lang).tag.split('-').next().unwrap_or("en"),
            "tags": {"en": figure_words(Lang::En).tag, "zh": figure_words(Lang::Zh).tag},
            "words": {"en": list(Lang::En), "zh": list(Lang::Zh)},
            "title": self.title,
            "captions": views[self.base].iter().map(pairs).collect::<Vec<_>>(),
            "given": self.base,
            "frames": told,
            "drawings": drawings.iter().map(|d| json!(d.frames)).collect::<Vec<_>>(),
        });
        let half = drawings.len().div_ceil(2).min(if self.still.is_some() { 1 } else { 2 });
        let put = |range: std::ops::Range<usize>| {
            range
                .map(|k| {
                    drawings[k].markup(k, self.base, &views[self.base][k], (self.lang, self.book))
                })
                .collect::<String>()
        };
        let own = usize::from(self.lang == Lang::Zh);
        Ok(filled(
            PAGE,
            &[
                ("lang", figure_words(self.lang).tag),
                ("title", &escaped(self.title[own])),
                ("style", &with_fonts(&STYLE)),
                ("letters", &Elements::letters(&elements)),
                ("left", &put(0..half)),
                ("right", &put(half..drawings.len())),
                (
                    "noscript",
                    &escaped(
                        self.words.iter().find(|w| w.0 == "noscript").map_or("", |w| w.1[own]),
                    ),
                ),
                ("data", &pressed(&data.to_string())),
                ("script", &terse(SCRIPT)),
            ],
        ))
    }
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

/// A drawing at all instants.
struct Sequence {
    size_mm: [f64; 2],
    /// The fixed background.
    ground: String,
    /// The drawing of each instant.
    frames: Vec<String>,
}

impl Sequence {
    fn of(
        views: &[&ParticleView],
        ground: Option<&ParticleView>,
        all: &mut Vec<Elements>,
    ) -> Result<Sequence, Faults> {
        let boxes = views.iter().copied().chain(ground).filter_map(|v| bounds(&v.part.items));
        let window = boxes
            .reduce(Rect::union)
            .unwrap_or(Rect::new(Point::ORIGIN, Point::ORIGIN))
            .grown(AIR_MM);
        let mut elements = Elements::new(window.height_mm());
        let mut written = |v: &ParticleView| -> Result<String, Faults> {
            let mut items: Vec<FigureItem> = nameless(v.part.items.iter());
            translate(&mut items, Point::ORIGIN - window.min);
            let each = elements.of(&items)?;
            let stepped = |(item, element): (&FigureItem, String)| match item.steps().min() {
                Some(k) => format!("<g data-step=\"{k}\">{element}</g>\n"),
                None => format!("{element}\n"),
            };
            Ok(items.iter().zip(each).map(stepped).collect())
        };
        let ground = ground.map(&mut written).transpose()?.unwrap_or_default();
        let frames = views.iter().map(|v| written(v)).collect::<Result<Vec<String>, Faults>>()?;
        all.push(elements);
        Ok(Sequence { size_mm: [window.width_mm(), window.height_mm()], ground, frames })
    }

    fn markup(
        &self,
        k: usize,
        base: usize,
        view: &ParticleView,
        (lang, book): (Lang, &Book),
    ) -> String {
        let [w, h] = self.size_mm.map(mm);
        format!(
            "<figure class=\"drawing\" id=\"drawing-{k}\" style=\"--w:{w}\">\n<svg viewBox=\"0 0 {w} {h}\" role=\"img\">\n<g class=\"ink\">\n{}</g>\n<g class=\"ink moving\">\n{}</g>\n</svg>\n\
             <figcaption><span class=\"caption\">{}</span> <span class=\"scale\">{}</span></figcaption>\n</figure>\n",
            self.ground,
            self.frames[base],
            escaped(&Phrase::new(lang.of(&view.caption)).plain()),
            mathml(&Label::math(view.scale(book))),
        )
    }
}
