//! Every kind of file through the single call of the library.

use hodograph::budget::Budget;
use hodograph::diag::Severity;
use hodograph::figure::list::Extras;
use hodograph::mechanism::Mechanism;
use hodograph::problem::{
    Extent, Kind, Lesson, Look, Options, Pictures, Problem, Verdict, Wish, included, read, read_as,
    solve, templates,
};
use hodograph::scene::{Lang, Swept};
use hodograph::sweep::{self, PlacedScene, Stations, Width};
use hodograph::worksheet::{WorksheetSides, WorksheetTask};
use std::process::Command;
use std::time::{Duration, Instant};

mod wide;

/// The example of a binding, a project of its own (`tests/svg` builds it), run here on a file of
/// each kind.
#[path = "../examples/golden-images/examples/answers.rs"]
#[expect(dead_code, reason = "its `main` is run by Cargo")]
mod binding;

fn problem(name: &str) -> Problem {
    let text = templates::text(name, &[]).unwrap_or_else(|f| panic!("{name}: {f}"));
    read(text).unwrap_or_else(|f| panic!("{name}: {f}")).value
}

/// Each template of each kind is read, solved and written by the same calls, and the results are
/// consistent: the text contains the answers, drawing and analysis agree, and a figure and a
/// worksheet exist.
#[test]
fn templates_of_all_kinds_take_the_same_calls() {
    let look = Look::default();
    let (mut answered, mut kinds) = (0, Vec::new());
    for t in templates::all().iter().step_by(3) {
        let problem = problem(t.name);
        assert_eq!(problem.kind(), t.kind, "{}", t.name);
        let solved =
            solve(&problem, &Options::with_figures()).unwrap_or_else(|f| panic!("{}: {f}", t.name));
        let (text, json) = (solved.text(&look, true), solved.json(&look, true, &solved.notes));
        let answers = solved.answers(&look);
        assert_eq!(answers.len(), json["answers"].as_array().map_or(0, Vec::len), "{}", t.name);
        for a in &answers {
            assert!(text.contains(&a.text), "{}: {a:?}\n{text}", t.name);
            assert!(a.difference.is_none_or(|d| d < 1e-9), "{}: {a:?}", t.name);
            assert_eq!(solved.answer(&a.find, &look).as_ref(), Some(a), "{}", t.name);
            answered += usize::from(a.value.is_some());
        }
        assert_ne!(solved.verdict(), Verdict::Disagree, "{}", t.name);
        assert_eq!(solved.mechanism().is_some(), t.kind == Kind::Scene, "{}", t.name);
        assert_eq!(solved.design().is_some(), t.kind == Kind::Task, "{}", t.name);
        let pages = solved
            .figures(&Pictures::default(), &look)
            .unwrap_or_else(|f| panic!("{}: {f}", t.name))
            .value;
        assert!(!pages.is_empty() && pages.iter().all(|(_, f)| !f.items.is_empty()), "{}", t.name);
        let document = solved.worksheet(
            WorksheetSides::Both,
            WorksheetTask::Polygons,
            &Look { lang: Some(Lang::Zh), ..look.clone() },
        );
        assert!(
            document.unwrap_or_else(|f| panic!("{}: {f}", t.name)).blocks.len() > 2,
            "{}",
            t.name
        );
        if !kinds.contains(&t.kind) {
            let page = solved
                .lesson(&Lesson { positions: 8, ..Lesson::default() }, &look)
                .unwrap_or_else(|f| panic!("{}: {f}", t.name));
            assert!(page.value.starts_with("<!DOCTYPE html>"), "{}", t.name);
            kinds.push(t.kind);
        }
    }
    assert!(answered > 100 && kinds.len() == 4, "{answered} {kinds:?}");
}

/// A binding gets answers and figures of each kind of file by one call.
#[test]
fn a_binding_takes_files_of_all_kinds() {
    for (name, has) in [("shaper", "omega_3"), ("time-ratio", "candidates"), ("pursuit", "answers")]
    {
        let (json, figures) = binding::answers(&templates::text(name, &[]).unwrap())
            .unwrap_or_else(|f| panic!("{name}: {f}"));
        assert!(json.contains(has), "{name}: {json}");
        assert!(
            !figures.is_empty() && figures.iter().all(|(_, svg)| svg.starts_with("<svg")),
            "{name}"
        );
    }
}

/// The library and the program give one text.
#[test]
fn the_program_prints_the_text_of_the_library() {
    for name in ["shaper", "cam-valve-train", "pursuit"] {
        let solved = solve(&problem(name), &Options::default()).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("s.json");
        std::fs::write(&path, templates::text(name, &[]).unwrap()).unwrap();
        let out = Command::new(env!("CARGO_BIN_EXE_hodograph"))
            .args(["solve", "--steps", "--lang", "en"])
            .arg(&path)
            .output()
            .unwrap();
        let look = Look { lang: Some(Lang::En), ..Look::default() };
        assert_eq!(String::from_utf8(out.stdout).unwrap(), solved.text(&look, true), "{name}");
    }
}

/// Requests that a kind of file does not support are refused with an alternative.
#[test]
fn kinds_refuse_with_a_way_out() {
    let wishes = [
        Wish::Mechanism,
        Wish::Answers,
        Wish::Candidate,
        Wish::Drafting,
        Wish::Pictures,
        Wish::Poses,
        Wish::Paths,
        Wish::Reveal,
        Wish::Mistake,
        Wish::Mobility,
    ];
    let mut refused = 0;
    for kind in [Kind::Scene, Kind::Task, Kind::Motion, Kind::Equation] {
        for wish in wishes {
            let Err(d) = kind.grants(wish) else { continue };
            assert!(
                d.severity == Severity::Error
                    && d.help.is_some()
                    && d.english_in_chinese().is_none(),
                "{kind:?} {wish:?}: {d:?}"
            );
            refused += 1;
        }
    }
    assert_eq!(refused, 1 + 8 + 9 + 8);
    assert_eq!(problem("body").into_scene().unwrap_err().code, "not-a-scene");
    assert!(problem("shaper").into_scene().is_ok());
}

/// A driver that follows its cam, or does not exist, is refused as the moved driver of a lesson.
#[test]
fn a_lesson_moves_only_what_moves_by_itself() {
    for name in ["cam-valve-train", "cam-offset-roller", "crank-rocker", "five-bar"] {
        let solved =
            solve(&problem(name), &Options { whole_motion: true, ..Options::with_figures() })
                .unwrap();
        let (scene, _) = solved.mechanism().unwrap();
        for driver in 0..=scene.drivers.len() {
            let moved = driver < scene.drivers.len() && !scene.is_led(driver);
            let lesson = Lesson { positions: 8, swept: Swept::Driver(driver), ..Lesson::default() };
            assert_eq!(solved.lesson(&lesson, &Look::default()).is_ok(), moved, "{name} {driver}");
        }
    }
}

/// Lessons of the collected cases with cams are made or refused with a reason. A frame is read as a
/// file of its own, with the mechanism of its piece of the cam; the ends of the motion belong to
/// the mechanism that was followed.
#[test]
fn lessons_of_cams_are_made() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/cases");
    let texts = std::fs::read_dir(folder)
        .unwrap()
        .map(|f| std::fs::read_to_string(f.unwrap().path()).unwrap());
    let (mut made, mut ended) = (0, 0);
    let mut texts: Vec<String> = texts.filter(|t| t.contains("\"cams\"")).collect();
    texts.sort();
    // Cams that touch a coupler, with the most different frames, and a part of the others.
    let (couplers, others): (Vec<&String>, Vec<&String>) =
        texts.iter().partition(|t| t.contains("\"case\": \"jet-"));
    for text in couplers.into_iter().chain(others.into_iter().step_by(wide::every(8))) {
        let scene = serde_json::from_str::<serde_json::Value>(text).unwrap()["scene"].to_string();
        let Ok(problem) = read(&scene) else { continue };
        let Ok(solved) =
            solve(&problem.value, &Options { whole_motion: true, ..Options::with_figures() })
        else {
            continue;
        };
        let lesson = Lesson { positions: 8, ..Lesson::default() };
        if let Ok(page) = solved.lesson(&lesson, &Look::default()) {
            made += 1;
            ended += u32::from(!page.value.contains("\"limits\":[null,null]"));
        }
    }
    assert!(made >= 6 && ended >= 1, "{made} {ended}");
}

/// A missing candidate is named; a pose needs no rate; a task takes the scene that it names.
#[test]
fn options_are_checked() {
    let faults =
        solve(&problem("body"), &Options { candidate: 99, ..Options::default() }).unwrap_err();
    assert_eq!(faults.list[0].code, "no-candidate");
    let still = r#"{"links": {"1": ["A", "D"], "2": ["A", "B"], "3": ["B", "C"], "4": ["C", "D"]}, "ground": "1",
        "points": {"A": [0, 0], "B": ["30 mm", "40 mm"], "C": ["120 mm", "60 mm"], "D": ["100 mm", 0]}, "find": ["P_24"]}"#;
    let posed = read_as(still, Extent::Pose).unwrap().value;
    assert_eq!(solve(&posed, &Options::default()).unwrap().answers(&Look::default()).len(), 1);
    let task = br#"{"synthesis": "cognates", "scene": "linkage.json"}"#.to_vec();
    let whole = included(task.clone(), |name| Ok(format!("\"{name} read\"").into_bytes())).unwrap();
    assert_eq!(
        String::from_utf8(whole).unwrap(),
        r#"{"synthesis": "cognates", "scene": "linkage.json read"}"#
    );
    let scene = templates::text("shaper", &[]).unwrap().into_bytes();
    assert_eq!(included(scene.clone(), |_| unreachable!()).unwrap(), scene);
    let extras = Extras { poses: 3, ..Extras::default() };
    let shaper =
        solve(&problem("shaper"), &Options { whole_motion: true, ..Options::with_figures() })
            .unwrap();
    assert_eq!(
        shaper
            .figures(&Pictures { extras, ..Pictures::default() }, &Look::default())
            .unwrap()
            .value
            .len(),
        1
    );
}

/// Answers can be sent between threads, as services and bindings need.
#[test]
fn answers_go_between_threads() {
    fn crosses<T: Send + Sync>(_: &T) {}
    crosses(&solve(&problem("crank-rocker"), &Options::default()).unwrap());
}

/// Every long computation checks its budget: after the deadline none completes, on any thread;
/// without one, or with enough time, all do.
#[test]
fn a_budget_stops_every_computation() {
    let past = Budget::default().until(Instant::now());
    let later = Budget::default().until(Instant::now() + Duration::from_secs(3600));
    let look = Look::default();
    let mut tried = 0;
    for name in [
        "crank-rocker",
        "jansen-leg",
        "cam-offset-roller",
        "plate-by-law",
        "path",
        "body",
        "pursuit",
    ] {
        let problem = problem(name);
        let solved = later.run(|| solve(&problem, &Options::with_figures()).unwrap()).unwrap();
        let lesson = Lesson { positions: 6, ..Lesson::default() };
        // Closed formulas and readings take too little time for a budget.
        let works: [(&str, &dyn Fn()); 4] = [
            ("solve", &|| drop(solve(&problem, &Options::with_figures()))),
            ("figures", &|| drop(solved.figures(&Pictures::default(), &look))),
            ("worksheet", &|| {
                drop(solved.worksheet(WorksheetSides::Both, WorksheetTask::Polygons, &look))
            }),
            ("lesson", &|| drop(solved.lesson(&lesson, &look))),
        ];
        // The loops below the facade are tested too.
        if let Problem::Scene(scene) = &problem {
            let m = Mechanism::new(scene).unwrap().value;
            let placed = PlacedScene::new(scene, &m).unwrap();
            let stations = Stations::of_values(vec![0.1, 0.2], 1.0);
            let swept = past.run(|| sweep::run(&placed, 0, &stations, Width::Widest).map(|_| ()));
            assert_eq!(swept.err().map(|d| d.code), Some("stopped"), "a sweep of {name}");
        }
        for (what, work) in works {
            let stopped = past.run(work).err().map(|d| d.code);
            assert_eq!(stopped, Some("stopped"), "{what} of {name}");
            tried += 1;
        }
    }
    assert_eq!(tried, 28);
}
