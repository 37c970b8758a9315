//! The lesson of a method: instantaneous centres, composite motion, curvature, cams, gear trains,
//! vector loops. The construction is shown step by step; where it depends on the pose, the driver is
//! moved through its travel.
//!
//! This module chooses the poses that the page holds. [`crate::figure::stepped`] makes the
//! construction anew in each pose, and [`super::player`] writes the page.

use crate::budget::here;
use hodograph_base::lang::each;
use rayon::prelude::*;
use serde_json::{Value, json};

use super::LessonOptions;
use super::frames::SolvedFrame;
use super::page::moved;
use super::player::{PlayerPage, drawings, legible, sizes};
use super::steps::{LANGS, answer, certified};
use crate::diag::{Both, Diagnostic, Faults, both};
use crate::digits::significant;
use crate::figure::list::{Extras, FigureInput};
use crate::figure::particle::ParticleView;
use crate::figure::sheet;
use crate::figure::stepped::{ConstructionMethod, SteppedMethod};
use crate::paper::label::Label;
use crate::paper::phrase::Phrase;
use crate::paper::style::Style;
use crate::render::math::{mathml, mathml_display};
use crate::report::html::sentence as html;
use crate::report::loops::DisplayedFormula;
use crate::scene::{Kind, Scene, Swept};
use crate::sweep::follow::{PoseFollower, PoseSweep, TravelPose};
use crate::worked::{Worked, work_pose};

/// Words of this page in addition to those of the player: key, both languages.
const WORDS: [(&str, [&str; 2]); 6] = [
    ("home", each!("Back to the given position")),
    ("instant", each!("Position of the driver")),
    ("given", each!("given position")),
    ("answers", each!("Answers in this position")),
    (
        "keys",
        each!(
            "Keys: → and ← the steps of the construction; + and − the driver, 0 the given position; Space runs; L language; D light or dark; P print; S window of the speaker."
        ),
    ),
    (
        "noscript",
        each!(
            "The page needs JavaScript to move; without it, it shows the finished construction in the given position."
        ),
    ),
];

/// Every n-th pose of the travel is shown, because each pose holds its own drawings.
const EVERY: usize = 2;

/// A pose with its construction.
struct MethodPose {
    frame: SolvedFrame,
    drawn: SteppedMethod,
}

/// Writes the page of a method.
///
/// # Errors
/// `method` if the scene has nothing to construct by it; the faults of the method; those of the SVG
/// writer.
pub(super) fn lesson(
    scene: &Scene,
    (worked, method): (&Worked, ConstructionMethod),
    options: &LessonOptions,
    (follower, sweep): (&PoseFollower, &PoseSweep),
) -> Result<String, Faults> {
    let in_style = |style: &Style| sheet::SheetOptions {
        style: style.clone(),
        notation: options.notation.clone(),
        ..sheet::SheetOptions::of_language(options.lang)
    };
    let drawn = |scene: &Scene, worked: &Worked, sheet: &sheet::SheetOptions| {
        let extras = Extras::default();
        method.stepped(&FigureInput { scene, worked, options: sheet, extras: &extras })
    };
    let style = legible(&options.style, |style| {
        let drawn = drawn(scene, worked, &in_style(style))?;
        Ok(drawn.map_or_else(Vec::new, |drawn| sizes(&drawn.views)))
    })?;
    let sheet = in_style(&style);
    let own = drawn(scene, worked, &sheet)?.ok_or_else(|| nothing(method))?;
    let alike = |drawn: &SteppedMethod| {
        drawn.views.len() == own.views.len()
            && drawn.steps.len() == own.steps.len()
            && drawn.missing <= own.missing
    };
    let mu = worked.construction.diagram.mu;
    let base = sweep.poses.iter().position(|p| p.travel == 0.0);
    let kept = |k: &usize| match base {
        Some(base) if method.is_still() => *k == base,
        Some(base) => k.abs_diff(base).is_multiple_of(EVERY),
        None => true,
    };
    let poses: Vec<&TravelPose> =
        (0..sweep.poses.len()).filter(kept).map(|k| &sweep.poses[k]).collect();
    let found = |pose: &&TravelPose| {
        let mut scene = follower.scene_at(scene, pose.travel);
        scene.paper.scales.set(Kind::Length, Some(mu));
        let (scene, worked) =
            work_pose(&scene, (&worked.mechanism, &worked.demand), &pose.configuration).ok()?;
        // Poses whose construction has other steps are dropped: the steps of the page are those of
        // the given pose.
        let drawn = drawn(&scene, &worked, &sheet).ok().flatten().filter(alike)?;
        let frame =
            SolvedFrame { travel: pose.travel, scene, worked, shown: Vec::new(), end: false };
        Some(MethodPose { frame, drawn })
    };
    let here = here();
    let frames: Vec<MethodPose> =
        poses.par_iter().filter_map(|pose| here.enter(|| found(pose))).collect();
    let from_own = |k: &usize| frames[*k].frame.travel.abs();
    let Some(base) = (0..frames.len()).min_by(|a, b| from_own(a).total_cmp(&from_own(b))) else {
        let words = both!("no position can be constructed");
        return Err(Diagnostic::error("no-motion", words).into());
    };
    let told: Vec<Value> =
        frames.par_iter().map(|f| here.enter(|| pose_json(f, options))).collect();
    let captions = &frames[base].drawn.views[0].caption;
    let caption = [captions.en.clone(), captions.zh.clone()];
    let title = [scene.title.en.as_str(), scene.title.zh.as_str()];
    let title = if title == ["", ""] { caption.each_ref().map(String::as_str) } else { title };
    let full = sweep.full && poses.len() == frames.len() && frames.len() > 1;
    let page = PlayerPage {
        title,
        lang: options.lang,
        words: &WORDS,
        base,
        type_mm: style.small_mm,
        data: json!({"frames": told, "full": full}),
    };
    let views: Vec<&[ParticleView]> = frames.iter().map(|f| &f.drawn.views[..]).collect();
    Ok(page.written(&drawings(&views, None, base, &scene.book)?))
}

fn nothing(method: ConstructionMethod) -> Diagnostic {
    let missing = Both::from(match method {
        ConstructionMethod::Centres => each!("instantaneous centres"),
        ConstructionMethod::Composite => each!("a moving point with a moving frame"),
        ConstructionMethod::Curvature => each!("a coupler"),
        ConstructionMethod::Cam => each!("a cam with a profile"),
        ConstructionMethod::Trains => each!("a gear train with known speeds"),
        ConstructionMethod::Loops => each!("vector loops or points that drivers move directly"),
    });
    let d = Diagnostic::error("method", both!("the scene does not have {}", missing));
    d.help(both!(
        "choose another --method; without it the lesson shows the polygons of the questions"
    ))
}

/// Data of a pose: its name, the sentences of the steps, the answers, the scales of the drawings.
fn pose_json(f: &MethodPose, options: &LessonOptions) -> Value {
    let set = |text: &str| html(&Phrase::new(text));
    let below = |k: usize| {
        let formulas = f.drawn.formulas.get(&k).into_iter().flatten();
        let set = |parts: &DisplayedFormula| {
            format!("<div class=\"scroll\">{}</div>", mathml_display(parts))
        };
        formulas.map(set).collect::<String>()
    };
    let steps = f.drawn.steps.iter().enumerate();
    let steps: Vec<Value> =
        steps.map(|(k, s)| json!(LANGS.map(|lang| set(lang.of(s)) + &below(k)))).collect();
    let digits = certified(&f.frame, options.swept);
    let answers = LANGS.map(|lang| {
        let told = (0..f.frame.scene.find.len())
            .filter_map(|i| answer(&f.frame, &digits, i, &options.notation, lang));
        told.map(|line| format!("<li>{}</li>", set(&line))).collect::<String>()
    });
    let scales: Vec<String> =
        f.drawn.views.iter().map(|v| mathml(&Label::math(v.scale(&f.frame.scene.book)))).collect();
    json!({"at": position(&f.frame, options.swept), "steps": steps, "answers": answers, "scales": scales})
}

/// The driver's position as markup, `φ₂ = 40°`; its travel where the scene does not state the position.
fn position(frame: &SolvedFrame, swept: Swept) -> String {
    let told = moved(&frame.scene, swept);
    let (symbol, factor) =
        (told["symbol"].as_str().unwrap_or_default(), told["factor"].as_f64().unwrap_or(1.0));
    let value = told["start"].as_f64().unwrap_or(frame.travel * factor);
    let unit = told["unit"].as_str().unwrap_or(if told["turns"].as_bool() == Some(true) {
        "°"
    } else {
        " mm"
    });
    format!("{symbol} = {}{unit}", significant(value, 5))
}
