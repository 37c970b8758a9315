//! Legibility of the figures of gears and cams: teeth, Kutzbach's plan and the figures of
//! `hodograph cam`, at 24 positions of the driver and in both languages. No label overlaps another,
//! none is beyond the paper.
//!
//! The table: `cargo test --test sheet geared -- --nocapture`

use crate::wide::every;
use hodograph::cam::CamSurvey;
use hodograph::figure::cam::{inversion, motion};
use hodograph::figure::groups;
use hodograph::figure::list::{self, Extras, FigureInput};
use hodograph::figure::sheet::SheetOptions;
use hodograph::paper::item::Figure;
use hodograph::report::cam::Report;
use hodograph::scene::{self, Lang, templates};
use hodograph::worked::{Scope, work};

use super::legible::{Found, look, poses};

/// Type size in these figures (mm).
const SMALLEST_MM: f64 = 1.5;

fn judge(name: &str, figure: &Figure, faults: &mut Vec<String>) -> Found {
    let found = look(figure, usize::MAX);
    if found.overlaps + found.outside > 0 || found.smallest_mm < SMALLEST_MM {
        faults.push(format!(
            "{name}: {} overlaps, {} outside, smallest type {:.2} mm",
            found.overlaps, found.outside, found.smallest_mm
        ));
    }
    found
}

#[test]
fn geared_figures_can_be_read() {
    let (mut faults, mut drawn) = (Vec::new(), 0);
    for t in templates::list() {
        let scene = scene::read(templates::get(t.name).unwrap()).unwrap().value;
        if scene.rolling.is_empty() {
            continue;
        }
        for (k, pose) in poses(&scene).iter().enumerate() {
            let Ok(worked) = work(pose, Scope::Figure) else { continue };
            for lang in [Lang::En, Lang::Zh] {
                let options = SheetOptions::of_language(lang);
                for name in ["gears", "kutzbach"] {
                    let entry = list::named(name).unwrap();
                    let wanted = FigureInput {
                        scene: pose,
                        worked: &worked.value,
                        options: &options,
                        extras: &Extras::default(),
                    };
                    // Pairs given by radii have no teeth.
                    let Ok(pages) = (entry.draw)(&wanted) else { continue };
                    for (page, figure) in pages.value {
                        judge(
                            &format!("{} pose {k} {lang:?} {page}", t.name),
                            &figure,
                            &mut faults,
                        );
                        drawn += 1;
                    }
                }
            }
        }
    }
    assert!(drawn > 200 / every(8), "only {drawn} figures");
    assert!(faults.is_empty(), "{} of {drawn} figures:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn figures_of_cams_can_be_read() {
    let (mut faults, mut drawn) = (Vec::new(), 0);
    for t in templates::list() {
        let scene = scene::read(templates::get(t.name).unwrap()).unwrap().value;
        for (k, pose) in poses(&scene).iter().enumerate() {
            for cam in &pose.cams {
                let Some(turning) = &cam.disc else { continue };
                let survey = CamSurvey::of(&turning.disc);
                let report = Report::new(pose, cam, turning, &survey);
                for lang in [Lang::En, Lang::Zh] {
                    let style = SheetOptions::of_language(lang).style;
                    for (what, figure) in [
                        ("motion", motion::figure(&report, &style, lang)),
                        ("profile", inversion::figure(&report, &style, lang)),
                    ] {
                        judge(
                            &format!("{} pose {k} {lang:?} {what}", t.name),
                            &figure,
                            &mut faults,
                        );
                        drawn += 1;
                    }
                }
            }
        }
    }
    assert!(drawn > 200 / every(8), "only {drawn} figures");
    assert!(faults.is_empty(), "{} of {drawn} figures:\n{}", faults.len(), faults.join("\n"));
}

/// The words below the profile name a line, in both languages, exactly where it is drawn.
#[test]
fn legends_of_cams_name_what_is_drawn() {
    let lines = [
        ("offset", ["offset circle", "偏距圆"]),
        ("pitch", ["pitch curve", "点画线为理论廓线"]),
        ("pitch-circle", ["prime circle", "理论廓线基圆"]),
        ("pivots", ["circle of the pivots", "转动中心所在圆"]),
    ];
    let mut seen = [[0; 2]; 4];
    for t in templates::list() {
        let scene = scene::read(templates::get(t.name).unwrap()).unwrap().value;
        for cam in &scene.cams {
            let Some(turning) = &cam.disc else { continue };
            let survey = CamSurvey::of(&turning.disc);
            let report = Report::new(&scene, cam, turning, &survey);
            for (l, lang) in [Lang::En, Lang::Zh].into_iter().enumerate() {
                let figure =
                    inversion::figure(&report, &SheetOptions::of_language(lang).style, lang);
                for (k, (class, words)) in lines.iter().enumerate() {
                    let drawn = figure.items.iter().any(|i| i.class == *class);
                    let told = figure
                        .desc
                        .replace("base and offset circles", "offset circle")
                        .contains(words[l]);
                    assert_eq!(drawn, told, "{} {lang:?}: {class}: {}", t.name, figure.desc);
                    seen[k][usize::from(drawn)] += 1;
                }
            }
        }
    }
    assert!(
        seen.iter().all(|s| s[0] > 0 && s[1] > 0),
        "each line is drawn in some and not in others: {seen:?}"
    );
}

/// The groups of every template, drawn apart.
#[test]
fn groups_drawn_apart_can_be_read() {
    let (mut faults, mut drawn) = (Vec::new(), 0);
    for t in templates::list() {
        let scene = scene::read(templates::get(t.name).unwrap()).unwrap().value;
        for (k, pose) in poses(&scene).iter().enumerate() {
            let Ok(worked) = work(pose, Scope::Figure) else { continue };
            for lang in [Lang::En, Lang::Zh] {
                let SheetOptions { style, notation, .. } = SheetOptions::of_language(lang);
                let figure = groups::figure(pose, &worked.value, &style, &notation, lang).unwrap();
                judge(&format!("{} pose {k} {lang:?}", t.name), &figure, &mut faults);
                drawn += 1;
            }
        }
    }
    assert!(drawn > 1000 / every(8), "only {drawn} figures");
    assert!(faults.is_empty(), "{} of {drawn} figures:\n{}", faults.len(), faults.join("\n"));
}
