//! Figures of a disc cam: the motion of its follower over a turn ([`motion`]), its profile by
//! inversion ([`inversion`]), its position at the instant ([`instant`]), and the least base
//! circle for an allowed pressure angle ([`least`]).

pub mod instant;
pub mod inversion;
pub mod least;
pub mod motion;

use crate::list::FigureInput;
use crate::particle::ParticleView;
use crate::sheet::painted;
use crate::stepped::SteppedMethod;
use hodograph_base::cam::{Disc, FollowerTip};
use hodograph_base::diag::Both;
use hodograph_base::digits::{inked, shortest};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::{each, say, tr};
use hodograph_paper::paper::extent::{Rect, bounds, translate};
use hodograph_paper::paper::item::{Anchor, Colour, Figure, FigureItem, PLACED, Shape, tag};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::{LabelRequest, Obstacles, place};
use hodograph_paper::paper::style::Style;
use hodograph_paper::paper::text;
use hodograph_report::cam::{CamSubject, Report};
use hodograph_scene::{DiagramKind, Kind, Lang, Scene};
use std::f64::consts::TAU;

/// The first cam step by step: its law of motion, the profile by inversion, pressure angle and
/// curvature; `None` for a scene without a cam that has a profile.
pub(super) fn stepped(w: &FigureInput) -> Option<SteppedMethod> {
    let report = w.scene.cams.iter().find_map(|cam| Report::of(w.scene, cam))?;
    let both = |of: &dyn Fn(Lang) -> String| Both { en: of(Lang::En), zh: of(Lang::Zh) };
    let subject = |of| both(&|lang| report.sentence(of, lang).unwrap_or_default());
    let of_law =
        [CamSubject::Data, CamSubject::Law, CamSubject::Velocity, CamSubject::Acceleration];
    let mut steps: Vec<Both> = of_law.map(subject).into();
    let first = steps.len();
    steps.extend((0..inversion::STATIONS).map(|k| both(&|lang| station(&report, k, lang))));
    let rolls = inversion::rolls(&report.turning.disc);
    let flat = matches!(report.turning.disc.touch, FollowerTip::Flat { .. });
    if rolls {
        steps.push(both(&|lang| {
            tr!(lang, "The smooth curve through the centres of the roller is the pitch curve.")
                .to_owned()
        }));
    }
    steps.push(both(&|lang| {
        match (rolls, flat) {
            (true, _) => tr!(
                lang,
                "The curve that touches all circles of the roller from inside is the profile."
            ),
            (false, true) => {
                tr!(lang, "The curve that touches all places of the face is the profile.")
            }
            (false, false) => tr!(lang, "The smooth curve through the tips is the profile."),
        }
        .to_owned()
    }));
    let pressure = report.survey.pressure[0].map(|_| CamSubject::Pressure);
    let curvature = report.survey.least_rho.map(|_| CamSubject::Curvature);
    steps.extend(pressure.into_iter().chain(curvature).map(subject));
    let style = &w.options.style;
    let (profile, mu) = inversion::stepped(&report, style, first);
    let mut views = vec![ParticleView {
        part: profile,
        caption: each!("Profile by inversion").into(),
        scales: vec![(DiagramKind::Plane, mu)],
    }];
    let diagrams = motion::stepped(&report, style, w.options.lang, 1);
    let captions = [each!("Displacement"), each!("Velocity"), each!("Acceleration")];
    views.extend(diagrams.into_iter().zip(captions).map(|(part, caption)| ParticleView {
        part,
        caption: caption.into(),
        scales: Vec::new(),
    }));
    Some(SteppedMethod { views, steps, ..SteppedMethod::default() })
}

/// The sentence of a station of the inversion.
fn station(report: &Report, k: usize, lang: Lang) -> String {
    let phi = TAU * k as f64 / inversion::STATIONS as f64;
    let degrees = shortest((phi.to_degrees() * 1e4).round() / 1e4);
    let lift = report.lift_words(phi).unwrap_or_else(|| "–".to_owned());
    match k {
        0 => say!(
            lang,
            "The cam is held, and the follower goes round it with $−\\omega$. Station 0: the follower at its beginning, with the lift {lift}."
        ),
        _ => say!(
            lang,
            "Station {k}: the cam has turned by $\\varphi = {degrees}°$; the follower is drawn turned back by this angle, with the lift {lift}."
        ),
    }
}

/// The title of a figure: the scene's title, if any, and the kind of figure.
fn heading(scene: &Scene, otherwise: &str, lang: Lang) -> String {
    let title = lang.of(&scene.title);
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
    /// Labels, each with its step.
    wanted: Vec<(LabelRequest, Option<usize>)>,
    /// The first step of the construction; `None` for a drawing without steps.
    first: Option<usize>,
    /// The step of what is drawn next.
    step: Option<usize>,
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
        let step = self.step.map_or_else(String::new, |step| format!(" step-{step}"));
        let item = FigureItem::new(format!("{class}{step}"), shape).with_id(id);
        self.items.push(FigureItem { link, ..item });
    }

    /// Assigns what is drawn next to a step, counted from the first one of this drawing.
    fn begin(&mut self, step: usize) {
        self.step = self.first.map(|first| first + step);
    }

    fn want(&mut self, request: LabelRequest) {
        self.wanted.push((request, self.step));
    }

    fn new(report: &'a Report<'a>, style: &'a Style, mu: f64) -> CamDrawing<'a> {
        CamDrawing {
            report,
            style,
            scale: 1.0 / mu,
            items: Vec::new(),
            wanted: Vec::new(),
            first: None,
            step: None,
        }
    }

    /// The drawing with its construction in steps from `first` on.
    fn in_steps(self, first: usize) -> CamDrawing<'a> {
        CamDrawing { first: Some(first), step: Some(first), ..self }
    }

    fn label(&mut self, text: &str, at: Point, clear_mm: f64, towards: Vec2) {
        let label = Label::math(text).in_fonts(&self.style.fonts);
        let request = LabelRequest::at_point(label, self.style.small_mm, at, clear_mm);
        self.want(if towards == Vec2::ZERO { request } else { request.towards(towards) });
    }

    /// Places the labels; returns all items and half the extent of the drawing with its margin
    /// (mm).
    fn labelled(mut self) -> (Vec<FigureItem>, f64) {
        let half = bounds(&self.items)
            .map_or(MARGIN_MM, |b| b.max.y.max(-b.min.y).max(b.max.x).max(-b.min.x))
            + MARGIN_MM;
        let room = Rect::new(Point::new(-half, -half), Point::new(half, half));
        let requests: Vec<LabelRequest> = self.wanted.iter().map(|w| w.0.clone()).collect();
        let placed = place(&requests, &Obstacles::of(&self.items), room);
        for (k, ((request, step), at)) in self.wanted.iter().zip(&placed).enumerate() {
            // The label comes last; its leader line is named after it.
            let parts = at.items(request, PLACED, self.style.thin);
            let leaders = parts.len() - 1;
            self.items.extend(parts.into_iter().enumerate().map(|(n, part)| {
                let end = if n < leaders { "-leader" } else { "" };
                let mut part = part.with_id(format!("cam-label-{k}{end}"));
                if let Some(step) = step {
                    tag(std::slice::from_mut(&mut part), &format!("step-{step}"));
                }
                part
            }));
        }
        (self.items, half)
    }

    /// Places the labels and returns the figure with its title, its caption and its scale.
    fn finish(self, mu: f64, title: String, caption: &str, lang: Lang) -> Figure {
        let (report, style) = (self.report, self.style);
        let mut items = self.labelled().0;
        let ink = bounds(&items).unwrap_or(Rect::new(Point::ORIGIN, Point::ORIGIN));
        let ink = ink.grown(MARGIN_MM);
        let scale = scale_text(report, mu);
        // For a small drawing the text defines the width of the paper.
        let wide = |text: &str, size_mm: f64| {
            let label = Label::text(text).in_fonts(&style.fonts);
            text::set(&label).width_em * size_mm + 2.0 * MARGIN_MM
        };
        let title_mm = style.caption_mm * 4.0 / 3.0;
        let words_mm = wide(&title, title_mm).max(wide(caption, style.small_mm));
        let size = [ink.width_mm().max(words_mm), ink.height_mm() + ABOVE_MM + BELOW_MM];
        let [width_mm, height_mm] = size;
        translate(&mut items, Vec2::new(width_mm / 2.0 - ink.centre().x, BELOW_MM - ink.min.y));
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
        painted(style, lang, [width_mm, height_mm], [title, desc], items)
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
