//! Figures of a disc cam: the motion of its follower over a turn ([`motion`]) and its profile by
//! inversion ([`inversion`]).

pub mod inversion;
pub mod motion;

use crate::list::FigureInput;
use crate::particle::ParticleView;
use crate::stepped::SteppedMethod;
use hodograph_base::cam::FollowerTip;
use hodograph_base::diag::Both;
use hodograph_base::digits::shortest;
use hodograph_base::geom::Point;
use hodograph_paper::paper::item::{Anchor, Colour, FigureItem, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::phrase::tr;
use hodograph_paper::paper::style::Style;
use hodograph_report::cam::{CamSubject, Report};
use hodograph_scene::{DiagramKind, Lang, Scene};
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
            tr(
                lang,
                "The smooth curve through the centres of the roller is the pitch curve.",
                "将各滚子中心连成光滑曲线，即理论廓线。",
            )
            .to_owned()
        }));
    }
    steps.push(both(&|lang| {
        match (rolls, flat) {
            (true, _) => tr(
                lang,
                "The curve that touches all circles of the roller from inside is the profile.",
                "作各滚子圆的内包络线，即实际廓线。",
            ),
            (false, true) => tr(
                lang,
                "The curve that touches all places of the face is the profile.",
                "作平底各位置的包络线，即凸轮廓线。",
            ),
            (false, false) => tr(
                lang,
                "The smooth curve through the tips is the profile.",
                "将各尖顶位置连成光滑曲线，即凸轮廓线。",
            ),
        }
        .to_owned()
    }));
    let pressure = report.survey.pressure[0].map(|_| CamSubject::Pressure);
    let curvature = report.survey.least_rho.map(|_| CamSubject::Curvature);
    steps.extend(pressure.into_iter().chain(curvature).map(subject));
    let style = &w.options.style;
    let (profile, mu) = inversion::stepped(&report, style, first);
    let caption = |en: &str, zh: &str| Both { en: en.to_owned(), zh: zh.to_owned() };
    let mut views = vec![ParticleView {
        part: profile,
        caption: caption("Profile by inversion", "反转法绘制凸轮廓线"),
        scales: vec![(DiagramKind::Plane, mu)],
    }];
    let diagrams = motion::stepped(&report, style, w.options.lang, 1);
    let captions = [["Displacement", "位移"], ["Velocity", "速度"], ["Acceleration", "加速度"]];
    views.extend(diagrams.into_iter().zip(captions).map(|(part, [en, zh])| ParticleView {
        part,
        caption: caption(en, zh),
        scales: Vec::new(),
    }));
    Some(SteppedMethod { views, steps, ..SteppedMethod::default() })
}

/// The sentence of a station of the inversion.
fn station(report: &Report, k: usize, lang: Lang) -> String {
    let phi = TAU * k as f64 / inversion::STATIONS as f64;
    let degrees = shortest((phi.to_degrees() * 1e4).round() / 1e4);
    let lift = report.lift_words(phi).unwrap_or_else(|| "–".to_owned());
    match (k, lang) {
        (0, Lang::En) => format!(
            "The cam is held, and the follower goes round it with $−\\omega$. Station 0: the follower at its beginning, with the lift {lift}."
        ),
        (0, Lang::Zh) => format!(
            "设想凸轮不动，从动件连同导路以 $−\\omega$ 绕凸轮轴心反转。位置 0：从动件的起始位置，位移为 {lift}。"
        ),
        (_, Lang::En) => format!(
            "Station {k}: the cam has turned by $\\varphi = {degrees}°$; the follower is drawn turned back by this angle, with the lift {lift}."
        ),
        (_, Lang::Zh) => format!(
            "位置 {k}：凸轮转过 $\\varphi = {degrees}°$；将从动件反转同一角度，并量取位移 {lift}。"
        ),
    }
}

/// The title of a figure: the scene's title, if any, and the kind of figure.
fn heading(scene: &Scene, otherwise: &str, lang: Lang) -> String {
    let title = scene.title.get(lang);
    match (title.is_empty(), lang) {
        (true, _) => otherwise.to_owned(),
        (false, Lang::En) => format!("{title}: {otherwise}"),
        (false, Lang::Zh) => format!("{title}：{otherwise}"),
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
