//! Figures of a disc cam: the motion of its follower over a turn ([`motion`]), its profile by
//! inversion ([`inversion`]), its position at the instant ([`instant`]), and the least base circle for an allowed pressure angle ([`least`]).

pub mod instant;
pub mod inversion;
pub mod least;
pub mod motion;

use hodograph_base::cam::Disc;
use hodograph_base::digits::{inked, shortest};
use hodograph_base::geom::{Point, Vec2};
use hodograph_paper::paper::extent::{Rect, bounds, translate};
use hodograph_paper::paper::item::{Anchor, Colour, Figure, FigureItem, PLACED, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::{LabelRequest, Obstacles, place};
use hodograph_paper::paper::style::Style;
use hodograph_paper::paper::text;
use hodograph_paper::paper::words::words;
use hodograph_report::cam::Report;
use hodograph_scene::{Kind, Lang, Scene};

/// The title of a figure: the scene's title, if any, and the kind of figure.
fn heading(scene: &Scene, otherwise: &str, lang: Lang) -> String {
    let title = scene.title.get(lang);
    match (title.is_empty(), lang) {
        (true, _) => otherwise.to_owned(),
        (false, Lang::En) => format!("{title}: {otherwise}"),
        (false, Lang::Zh) => format!("{title}：{otherwise}"),
    }
}

/// Space around, above and below a drawing (mm).
const MARGIN_MM: f64 = 9.0;
const ABOVE_MM: f64 = 16.0;
const BELOW_MM: f64 = 20.0;

/// A drawing under construction: items in mm about the centre of the cam or another place.
struct CamDrawing<'a> {
    report: &'a Report<'a>,
    style: &'a Style,
    /// Millimetres of paper per metre.
    scale: f64,
    items: Vec<FigureItem>,
    wanted: Vec<LabelRequest>,
}

fn scale_text(report: &Report, mu: f64) -> String {
    let (name, factor) = match report.scene.book.chosen(Kind::Length) {
        Some(unit) => (unit.name().to_owned(), unit.of(1.0)),
        None => ("m".to_owned(), 1.0),
    };
    format!("\\mu_l = {}\\,\\text{{{name}/mm}}", inked(&shortest(mu * factor)))
}

impl<'a> CamDrawing<'a> {
    fn disc(&self) -> &Disc {
        &self.report.turning.disc
    }

    fn at(&self, v: Vec2) -> Point {
        (v * self.scale).to_point()
    }

    fn draw(&mut self, class: &str, shape: Shape, link: Option<usize>) {
        let id = format!("cam-{class}-{}", self.items.len());
        self.items.push(FigureItem { link, ..FigureItem::new(class, shape).with_id(id) });
    }

    fn new(report: &'a Report<'a>, style: &'a Style, mu: f64) -> CamDrawing<'a> {
        CamDrawing { report, style, scale: 1.0 / mu, items: Vec::new(), wanted: Vec::new() }
    }

    fn label(&mut self, text: &str, at: Point, clear_mm: f64, towards: Vec2) {
        let label = Label::math(text).in_fonts(&self.style.fonts);
        let request = LabelRequest::at_point(label, self.style.small_mm, at, clear_mm);
        self.wanted.push(if towards == Vec2::ZERO { request } else { request.towards(towards) });
    }

    /// Places the labels and returns the figure with its title, its caption and its scale.
    fn finish(mut self, mu: f64, title: String, caption: &str, lang: Lang) -> Figure {
        let (report, style) = (self.report, self.style);
        let half = bounds(&self.items)
            .map_or(MARGIN_MM, |b| b.max.y.max(-b.min.y).max(b.max.x).max(-b.min.x))
            + MARGIN_MM;
        let room = Rect::new(Point::new(-half, -half), Point::new(half, half));
        let placed = place(&self.wanted, &Obstacles::of(&self.items), room);
        for (k, (request, at)) in self.wanted.iter().zip(&placed).enumerate() {
            // The label comes last; its leader line is named after it.
            let parts = at.items(request, PLACED, style.thin);
            let leaders = parts.len() - 1;
            self.items.extend(parts.into_iter().enumerate().map(|(n, part)| {
                let end = if n < leaders { "-leader" } else { "" };
                part.with_id(format!("cam-label-{k}{end}"))
            }));
        }
        let mut items = self.items;
        let scale = scale_text(report, mu);
        // For a small drawing the text defines the width of the paper.
        let wide = |text: &str, size_mm: f64| {
            let label = Label::text(text).in_fonts(&style.fonts);
            text::set(&label).width_em * size_mm + 2.0 * MARGIN_MM
        };
        let title_mm = style.caption_mm * 4.0 / 3.0;
        let words_mm = wide(&title, title_mm).max(wide(caption, style.small_mm));
        let (width_mm, height_mm) = ((2.0 * half).max(words_mm), 2.0 * half + ABOVE_MM + BELOW_MM);
        translate(&mut items, Vec2::new(width_mm / 2.0, half + BELOW_MM));
        let mut write = |class: &str, y: f64, label: Label, size_mm: f64| {
            let at = Point::new(width_mm / 2.0, y);
            items.push(words_at(class, at, label, size_mm, Anchor::Middle, style));
        };
        write("title", height_mm - 10.0, Label::text(title.as_str()), title_mm);
        write("caption", 14.0, Label::text(caption), style.small_mm);
        write("mu_l", 7.0, Label::math(scale), style.small_mm);
        let kind = hodograph_report::cam::kind(report.cam, &report.turning.disc, lang);
        let desc = match lang {
            Lang::En => format!("{kind}. {caption}."),
            Lang::Zh => format!("{kind}。{caption}。"),
        };
        let mut figure = Figure {
            width_mm,
            height_mm,
            title,
            desc,
            lang: words(lang).tag.into(),
            paper: Colour::WHITE,
            items,
        };
        style.palette.paint(&mut figure);
        figure
    }
}

/// Text at a given point.
fn words_at(
    class: &str,
    at: Point,
    label: Label,
    size_mm: f64,
    anchor: Anchor,
    style: &Style,
) -> FigureItem {
    FigureItem::new(
        class,
        Shape::Label {
            at,
            label: label.in_fonts(&style.fonts),
            size_mm,
            anchor,
            colour: Colour::BLACK,
        },
    )
}
