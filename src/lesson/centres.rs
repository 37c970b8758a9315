//! The lesson of a task that asks for instantaneous centres. Each centre is found in a step of its
//! own, by its pair or by two lines; angular velocities and speeds follow from the centres. The
//! driver is moved through its travel.
//!
//! This module chooses the poses that the page holds. [`crate::centres`] finds the centres anew in
//! each pose, [`crate::figure::centres`] draws them, and [`super::motion`] writes the page.

use crate::budget::here;
use rayon::prelude::*;
use serde_json::{Value, json};

use super::frames::SolvedFrame;
use super::motion::MotionPage;
use super::page::moved;
use super::steps::{LANGS, answer, certified};
use super::{LARGER, LessonOptions};
use crate::centres::{CentreTask, Centres, placed};
use crate::diag::{Both, Diagnostic, Faults, both};
use crate::digits::significant;
use crate::figure::centres::stepped;
use crate::figure::list::{Extras, FigureInput};
use crate::figure::particle::ParticleView;
use crate::figure::sheet;
use crate::paper::label::Label;
use crate::paper::phrase::Phrase;
use crate::paper::style::Style;
use crate::paper::words::words as figure_words;
use crate::render::math::mathml;
use crate::report::centres::CentreWords;
use crate::report::html::sentence as html;
use crate::scene::{DiagramKind, Kind, Scene, Swept};
use crate::sweep::follow::{PoseFollower, PoseSweep, TravelPose};
use crate::worked::{Worked, work_pose};

/// Words of this page in addition to those of [`super::motion::PLAYER`]: key, both languages.
const WORDS: [(&str, [&str; 2]); 6] = [
    ("home", ["Back to the given position", "回到给定位置"]),
    ("instant", ["Position of the driver", "原动件位置"]),
    ("given", ["given position", "给定位置"]),
    ("answers", ["Answers in this position", "该位置的结果"]),
    (
        "keys",
        [
            "Keys: → and ← the steps of the construction; + and − the driver, 0 the given position; Space runs; L language; D light or dark.",
            "键盘：→、← 作图步骤；+、− 转动原动件，0 回到给定位置；空格 运动；L 切换语言；D 浅色或深色。",
        ],
    ),
    (
        "noscript",
        [
            "The page needs JavaScript to move; without it, it shows the finished construction in the given position.",
            "本页需启用 JavaScript；未启用时仅显示给定位置完成的作图。",
        ],
    ),
];

/// Centres farther than this from the mechanism are indicated by arrows (mm).
const REACH_MM: f64 = 45.0;
/// Every n-th pose of the travel is shown, because each pose holds its own drawings.
const EVERY: usize = 2;

/// A pose with its centres.
struct CentrePose {
    frame: SolvedFrame,
    centres: Centres,
}

/// Writes the page of a task.
///
/// # Errors
/// No pose can be drawn; those of the SVG writer.
pub(super) fn lesson(
    scene: &Scene,
    (worked, task): (&Worked, &CentreTask),
    options: &LessonOptions,
    (follower, sweep): (&PoseFollower, &PoseSweep),
) -> Result<String, Faults> {
    let mu = worked.construction.diagram.mu;
    let base = sweep.poses.iter().position(|p| p.travel == 0.0);
    let kept = |k: &usize| base.is_none_or(|base| k.abs_diff(base).is_multiple_of(EVERY));
    let poses: Vec<&TravelPose> =
        (0..sweep.poses.len()).filter(kept).map(|k| &sweep.poses[k]).collect();
    let found = |pose: &&TravelPose| {
        let mut scene = follower.scene_at(scene, pose.travel);
        scene.paper.scales.set(Kind::Length, Some(mu));
        let (scene, worked) =
            work_pose(&scene, (&worked.mechanism, &worked.demand), &pose.configuration).ok()?;
        let centres = placed(&scene, &worked.mechanism, &worked.configuration).ok()?.value;
        // Poses in which a centre has no place are dropped: its steps would have nothing to show.
        let whole = centres
            .list
            .iter()
            .zip(&task.found.list)
            .all(|(c, own)| c.place.is_some() || own.place.is_none());
        whole.then_some(CentrePose {
            frame: SolvedFrame {
                travel: pose.travel,
                scene,
                worked,
                shown: Vec::new(),
                end: false,
            },
            centres,
        })
    };
    let here = here();
    let frames: Vec<CentrePose> =
        poses.par_iter().filter_map(|pose| here.enter(|| found(pose))).collect();
    let from_own = |k: &usize| frames[*k].frame.travel.abs();
    let Some(base) = (0..frames.len()).min_by(|a, b| from_own(a).total_cmp(&from_own(b))) else {
        let words = both!("no position has all its centres", "没有任何位置能求得全部瞬心");
        return Err(Diagnostic::error("no-motion", words).into());
    };
    let style = Style {
        small_mm: options.style.small_mm * LARGER,
        label_mm: options.style.label_mm * LARGER,
        ..options.style.clone()
    };
    let sheet = sheet::SheetOptions {
        style,
        notation: options.notation.clone(),
        ..sheet::SheetOptions::of_language(options.lang)
    };
    let views: Vec<Vec<ParticleView>> =
        frames.par_iter().map(|f| here.enter(|| views(f, &sheet))).collect();
    let told: Vec<Value> = frames
        .par_iter()
        .zip(&views)
        .map(|(f, views)| here.enter(|| pose_json(f, views, options)))
        .collect();
    let title = [scene.title.en.as_str(), scene.title.zh.as_str()];
    let title = if title == ["", ""] { LANGS.map(|l| figure_words(l).centres) } else { title };
    MotionPage { title, lang: options.lang, words: &WORDS, book: &scene.book, base, still: None }
        .written(&views, &told)
}

/// The mechanism with its centres, and the circle diagram.
fn views(f: &CentrePose, options: &sheet::SheetOptions) -> Vec<ParticleView> {
    let wanted = FigureInput {
        scene: &f.frame.scene,
        worked: &f.frame.worked,
        options,
        extras: &Extras::default(),
    };
    let [mechanism, circle] = stepped(&wanted, &f.centres, REACH_MM);
    let [en, zh] = LANGS.map(figure_words);
    let both_of = |en: &str, zh: &str| Both { en: en.to_owned(), zh: zh.to_owned() };
    let scales = vec![(DiagramKind::Plane, f.frame.worked.construction.diagram.mu)];
    vec![
        ParticleView { part: mechanism, caption: both_of(en.centres, zh.centres), scales },
        ParticleView {
            part: circle,
            caption: both_of(en.circle_diagram, zh.circle_diagram),
            scales: Vec::new(),
        },
    ]
}

/// Data of a pose: its name, the sentences of the steps, the answers, the scales of the drawings.
fn pose_json(f: &CentrePose, views: &[ParticleView], options: &LessonOptions) -> Value {
    let steps = LANGS.map(|lang| {
        let words = CentreWords::marked(&f.centres, lang);
        let found = f.centres.list.iter().map(|c| html(&words.sentence(c)));
        found.chain(words.steps().iter().map(|s| html(&Phrase::new(s)))).collect::<Vec<_>>()
    });
    let steps: Vec<Value> =
        steps[0].iter().zip(&steps[1]).map(|(en, zh)| json!([en, zh])).collect();
    let digits = certified(&f.frame, options.swept);
    let answers = LANGS.map(|lang| {
        let told = (0..f.frame.scene.find.len())
            .filter_map(|i| answer(&f.frame, &digits, i, &options.notation, lang));
        told.map(|line| format!("<li>{}</li>", html(&Phrase::new(&line)))).collect::<String>()
    });
    let scales: Vec<String> =
        views.iter().map(|v| mathml(&Label::math(v.scale(&f.frame.scene.book)))).collect();
    json!({"at": position(&f.frame, options.swept), "steps": steps, "answers": answers, "scales": scales})
}

/// The driver's position, as `φ₂ = 40°`; its travel where the scene does not state the position.
fn position(frame: &SolvedFrame, swept: Swept) -> String {
    let told = moved(&frame.scene, swept);
    let (plain, factor) =
        (told["plain"].as_str().unwrap_or_default(), told["factor"].as_f64().unwrap_or(1.0));
    let value = told["start"].as_f64().unwrap_or(frame.travel * factor);
    let unit = told["unit"].as_str().unwrap_or(if told["turns"].as_bool() == Some(true) {
        "°"
    } else {
        " mm"
    });
    format!("{plain} = {}{unit}", significant(value, 5))
}
