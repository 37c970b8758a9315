//! The page of a construction at one or more poses or instants, with the player of its steps.
//!
//! This module puts the page together from drawings, each of which has a fixed part and a part for
//! each frame. The page fetches nothing and holds both languages.

use super::LARGER;
use super::pack::pressed;
use super::page::{BASE, filled, terse, with_fonts};
use crate::diag::Faults;
use crate::figure::particle::ParticleView;
use crate::geom::Point;
use crate::paper::extent::{Rect, bounds, translate};
use crate::paper::item::FigureItem;
use crate::paper::label::Label;
use crate::paper::phrase::Phrase;
use crate::paper::style::Style;
use crate::paper::words::words as figure_words;
use crate::render::escaped;
use crate::render::math::mathml;
use crate::render::number::mm;
use crate::render::svg::Elements;
use crate::scene::{Book, Lang};
use hodograph_base::lang::each;
use serde_json::{Value, json};

use super::steps::LANGS;

const PAGE: &str = concat!(include_str!("head.html"), include_str!("player/player.html"));
const STYLE: [&str; 2] = [BASE, include_str!("player/player.css")];
/// The script, in the order of its modules.
const SCRIPT: [&str; 3] =
    [include_str!("player/frames.js"), include_str!("sheets.js"), include_str!("player/player.js")];
/// Words of the controls: key, both languages.
const PLAYER: [(&str, [&str; 2]); 12] = [
    ("first", each!("First step")),
    ("previous", each!("Previous step")),
    ("next", each!("Next step")),
    ("last", each!("Show all steps")),
    ("step", each!("Step {} of {}")),
    ("steps", each!("steps" => "Construction")),
    ("play", each!("Run or stop")),
    ("theme", each!("Light or dark")),
    ("language", ["中文", "English"]),
    ("coming", each!("Next")),
    ("speaker", each!("Window of the speaker")),
    ("print", each!("Print, six steps on a page")),
];

/// Margin around a drawing (mm).
const AIR_MM: f64 = 2.0;

/// Window of a drawing on a small projector (1280 × 720 pixels).
const STAGE_PX: [f64; 2] = [600.0, 450.0];
/// A first drawing so much wider than high has the whole width of the page.
const WIDE: f64 = 1.9;
/// The least height of a small letter there, so that it is read from the last row.
const LETTER_PX: f64 = 17.0;
/// The least height of a small letter on a phone (pixels).
const PHONE_PX: f64 = 11.5;
/// Height of a small letter in type sizes.
const X_HEIGHT: f64 = 0.43;
/// The largest type (mm): larger type would hide the drawing.
const LARGEST_MM: f64 = 16.0;
/// Rounds of fitting: larger type makes a drawing larger.
const ROUNDS: usize = 6;

/// Returns the style in which the drawings of a page are legible from the last row; `sizes` returns
/// the sizes (mm) of the drawings in a style.
///
/// # Errors
/// Those of the drawings.
pub(super) fn legible(
    style: &Style,
    sizes: impl Fn(&Style) -> Result<Vec<[f64; 2]>, Faults>,
) -> Result<Style, Faults> {
    let sized =
        |small: f64, label: f64| Style { small_mm: small, label_mm: label, ..style.clone() };
    let mut own = sized(style.small_mm * LARGER, style.label_mm * LARGER);
    for _ in 0..ROUNDS {
        let needed = |[w, h]: &[f64; 2]| {
            let [x, y] = if w / h > WIDE { [2.0 * STAGE_PX[0], STAGE_PX[1]] } else { STAGE_PX };
            LETTER_PX / X_HEIGHT / (x / w).min(y / h)
        };
        let most = sizes(&own)?.iter().map(needed).fold(0.0, f64::max).min(LARGEST_MM);
        if most <= own.small_mm {
            break;
        }
        own = sized(most, most.max(own.label_mm));
    }
    Ok(own)
}

/// Returns the sizes of views (mm).
pub(super) fn sizes(views: &[ParticleView]) -> Vec<[f64; 2]> {
    let boxes = views.iter().filter_map(|v| bounds(&v.part.items));
    boxes.map(|b| b.grown(AIR_MM)).map(|b| [b.width_mm(), b.height_mm()]).collect()
}

/// A page of poses or instants with the player.
pub(super) struct PlayerPage<'a> {
    /// English and Chinese.
    pub title: [&'a str; 2],
    /// The language in which it opens.
    pub lang: Lang,
    /// Words around the drawings.
    pub words: &'a [(&'a str, [&'a str; 2])],
    /// The index of the given frame.
    pub base: usize,
    /// Size of the smallest type (mm).
    pub type_mm: f64,
    /// The `frames`, each with its name `at`, and the `steps`, `answers` and `scales` of each frame,
    /// or those of all frames; the frames with buttons of their own (`stops`); true for a closed
    /// motion (`full`).
    pub data: Value,
}

/// A drawing of a page.
pub(super) struct PlayerDrawing {
    /// The window of each frame, or of all: left, top, width, height (mm).
    pub windows_mm: Vec<[f64; 4]>,
    /// Letters that the markup uses.
    pub letters: Elements,
    /// The fixed part.
    pub ground: String,
    /// The part of each frame; empty for a drawing that does not change.
    pub frames: Vec<String>,
    /// English and Chinese.
    pub caption: [String; 2],
    /// The scale as markup.
    pub scale: String,
    /// True for a drawing in the left half.
    pub left: bool,
}

impl PlayerPage<'_> {
    /// True if the first drawing has the whole width of the page.
    fn is_wide(&self, drawings: &[PlayerDrawing]) -> bool {
        let first = drawings.first().filter(|d| d.left);
        first.and_then(|d| d.windows_mm.first()).is_some_and(|[_, _, w, h]| w / h > WIDE)
    }

    /// Writes the page.
    pub fn written(&self, drawings: &[PlayerDrawing]) -> String {
        let own = usize::from(self.lang == Lang::Zh);
        let list = |lang: Lang| {
            let word = |(key, said): &(&str, [&str; 2])| {
                ((*key).to_owned(), json!(said[usize::from(lang == Lang::Zh)]))
            };
            PLAYER.iter().chain(self.words).map(word).collect::<serde_json::Map<_, _>>()
        };
        let mut data = json!({
            "lang": figure_words(self.lang).tag.split('-').next().unwrap_or("en"),
            "tags": {"en": figure_words(Lang::En).tag, "zh": figure_words(Lang::Zh).tag},
            "words": {"en": list(Lang::En), "zh": list(Lang::Zh)},
            "title": self.title,
            "captions": drawings.iter().map(|d| json!(d.caption)).collect::<Vec<_>>(),
            "given": self.base,
            "drawings": drawings.iter().map(|d| json!(d.frames)).collect::<Vec<_>>(),
            "windows": drawings.iter().map(|d| json!(d.views())).collect::<Vec<_>>(),
        });
        if let (Value::Object(all), Value::Object(own)) = (&mut data, &self.data) {
            all.extend(own.clone());
        }
        let put = |left: bool| {
            let numbered = drawings.iter().enumerate().filter(|(_, d)| d.left == left);
            let each = numbered.map(|(k, d)| d.markup(k, (self.base, self.type_mm), own));
            each.collect::<String>()
        };
        let noscript = self.words.iter().find(|w| w.0 == "noscript").map_or("", |w| w.1[own]);
        filled(
            PAGE,
            &[
                ("lang", figure_words(self.lang).tag),
                ("title", &escaped(self.title[own])),
                ("style", &with_fonts(&STYLE)),
                ("letters", &Elements::letters(drawings.iter().map(|d| &d.letters))),
                ("layout", if self.is_wide(drawings) { "wide" } else { "" }),
                ("left", &put(true)),
                ("right", &put(false)),
                ("noscript", &escaped(noscript)),
                ("data", &pressed(&data.to_string())),
                ("script", &terse(&SCRIPT.concat())),
            ],
        )
    }
}

impl PlayerDrawing {
    /// The windows as a page writes them.
    fn views(&self) -> Vec<String> {
        self.windows_mm.iter().map(|w| w.map(mm).join(" ")).collect()
    }

    fn markup(&self, k: usize, (base, type_mm): (usize, f64), own: usize) -> String {
        let views = self.views();
        let view = views.get(base).or(views.first()).map_or("", String::as_str);
        let w = view.split(' ').nth(2).unwrap_or("1");
        let px = mm(PHONE_PX / X_HEIGHT / type_mm);
        format!(
            "<figure class=\"drawing\" id=\"drawing-{k}\" style=\"--w:{w};--px:{px}\">\n<svg viewBox=\"{view}\" role=\"img\">\n<g class=\"ink\">\n{}</g>\n<g class=\"ink moving\">\n{}</g>\n</svg>\n\
             <figcaption><span class=\"caption\">{}</span> <span class=\"scale\">{}</span></figcaption>\n</figure>\n",
            self.ground,
            self.frames.get(base).map_or("", String::as_str),
            escaped(&self.caption[own]),
            self.scale,
        )
    }
}

/// The drawings of a page from the views of each frame, and a fixed background of the first one.
///
/// # Errors
/// The errors of the SVG writer.
pub(super) fn drawings(
    views: &[&[ParticleView]],
    still: Option<&ParticleView>,
    base: usize,
    book: &Book,
) -> Result<Vec<PlayerDrawing>, Faults> {
    let count = views[base].len();
    let of = |k: usize| {
        let ground = still.filter(|_| k == 0);
        let own: Vec<&ParticleView> = views.iter().map(|v| &v[k]).collect();
        let boxes: Vec<Rect> = own
            .iter()
            .map(|v| bounds(&v.part.items).unwrap_or(Rect::new(Point::ORIGIN, Point::ORIGIN)))
            .map(|b| b.grown(AIR_MM))
            .collect();
        let behind = ground.and_then(|v| bounds(&v.part.items)).map(|b| b.grown(AIR_MM));
        let window = boxes.iter().copied().chain(behind).fold(boxes[base], Rect::union);
        // A frame that needs more than the given one is seen smaller.
        let seen = |own: &Rect| {
            let own = if ground.is_some() { window } else { boxes[base].union(*own) };
            let [left, top] = [own.min.x - window.min.x, window.max.y - own.max.y];
            [left, top, own.width_mm(), own.height_mm()]
        };
        let windows_mm = boxes.iter().map(seen).collect();
        let mut letters = Elements::new(window.height_mm());
        let mut written = |v: &ParticleView| {
            let mut items = nameless(v.part.items.iter());
            translate(&mut items, Point::ORIGIN - window.min);
            stepped(&items, &mut letters)
        };
        let ground = ground.map(&mut written).transpose()?.unwrap_or_default();
        let frames = own.iter().map(|v| written(v)).collect::<Result<Vec<String>, Faults>>()?;
        let view = &views[base][k];
        Ok(PlayerDrawing {
            windows_mm,
            letters,
            ground,
            frames,
            caption: LANGS.map(|lang| Phrase::new(lang.of(&view.caption)).plain()),
            scale: mathml(&Label::math(view.scale(book))),
            left: k == 0,
        })
    };
    (0..count).map(of).collect()
}

/// Items without their ids: two drawings in a page must not share ids.
pub(super) fn nameless<'a>(items: impl Iterator<Item = &'a FigureItem>) -> Vec<FigureItem> {
    items.map(|i| FigureItem { id: String::new(), ..i.clone() }).collect()
}

/// The markup of items, each in a group that names its step.
///
/// # Errors
/// The errors of the SVG writer.
pub(super) fn stepped(items: &[FigureItem], letters: &mut Elements) -> Result<String, Faults> {
    let each = letters.of(items)?;
    let of = |(item, element): (&FigureItem, String)| match item.steps().min() {
        Some(k) => format!("<g data-step=\"{k}\">{element}</g>\n"),
        None => format!("{element}\n"),
    };
    Ok(items.iter().zip(each).map(of).collect())
}
