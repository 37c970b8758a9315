//! The method of a sheet: the task is solved as it asks, and each step of a construction can be
//! carried out as described.

use hodograph::answer::AnswerValue;
use hodograph::centres::{CentrePlace, CentreTask};
use hodograph::certified::steps;
use hodograph::composite::{
    ChoiceVerdict, ContactScene, KnownMotion, On, ProjectionTerm, level, projections,
};
use hodograph::construct::Action;
use hodograph::figure::curves::CurveDiagram;
use hodograph::figure::list::{Extras, FigureInput};
use hodograph::figure::sheet::SheetOptions;
use hodograph::figure::stepped::ConstructionMethod;
use hodograph::lesson;
use hodograph::mechanism::Mechanism;
use hodograph::notation::Notation;
use hodograph::paper::item::FigureItem;
use hodograph::plan::text::PlanWriter;
use hodograph::plan::{TermConnection, TermKind, TurningBody};
use hodograph::report::construction::sentences;
use hodograph::scene::quantity::{Frame, RelativePath, relative_path};
use hodograph::scene::{self, Asked, DiagramKind, Lang, Scene, Swept, templates};
use hodograph::sweep::pieces::gather;
use hodograph::sweep::{PlacedScene, timed::TimedSweep};
use hodograph::worked::{Scope, Worked, work};
use hodograph::worksheet::{self, DocumentBlock, WorksheetSides};
use serde_json::{Value as Json, json};

fn read(text: &str) -> Scene {
    scene::read(text).unwrap_or_else(|f| panic!("{f}\n{text}")).value
}

fn worked(scene: &Scene) -> Worked {
    work(scene, Scope::Figure).unwrap_or_else(|f| panic!("{f}")).value
}

/// All templates, and the scenes of the cases, with their names.
fn scenes() -> Vec<(String, Scene)> {
    let mut out: Vec<(String, Scene)> = templates::list()
        .iter()
        .map(|t| (t.name.to_owned(), read(templates::get(t.name).expect("it is in the list"))))
        .collect();
    let mut files: Vec<_> =
        std::fs::read_dir("tests/cases").unwrap().map(|f| f.unwrap().path()).collect();
    files.sort();
    for path in files.iter().filter(|p| p.extension().is_some_and(|e| e == "json")) {
        let file: Json = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
        if let Ok(scene) = scene::read(file["scene"].to_string()) {
            out.push((path.display().to_string(), scene.value));
        }
    }
    assert!(out.len() > 100, "{}", out.len());
    out
}

/// The scenes with a motion, solved.
fn moving() -> impl Iterator<Item = (String, Scene, Worked)> {
    scenes().into_iter().filter_map(|(name, scene)| {
        let worked = work(&scene, Scope::Figure).ok()?.value;
        Some((name, scene, worked))
    })
}

/// A line is drawn through an existing point: where a vector is zero, the point at its other end is
/// found by this very line.
#[test]
fn lines_are_drawn_through_marks_that_are_there() {
    let mut lines = 0;
    for (name, scene, worked) in moving() {
        let told = steps(&scene, &worked, None);
        for lang in [Lang::En, Lang::Zh] {
            let notation = Notation::of_language(lang);
            let w = PlanWriter { scene: &scene, plan: &worked.plan, notation: &notation, lang };
            for p in &worked.construction.diagrams {
                let said: Vec<String> = sentences(&w, &worked.construction, p, &told)
                    .iter()
                    .map(|s| s.source())
                    .collect();
                for (k, action) in p.actions.iter().enumerate() {
                    let Action::Line { .. } = action else { continue };
                    let mark = said[k + 1].split('$').nth(1).unwrap();
                    // A triangle ends in the image that it finds.
                    let known = |s: &String| {
                        s.split('$')
                            .skip(1)
                            .step_by(2)
                            .any(|f| f == mark || f.len() < 24 && f.ends_with(mark))
                    };
                    assert!(
                        said[..=k].iter().any(known),
                        "{name}: {mark} is not there yet: {}\n{}",
                        said[k + 1],
                        said[..=k].join("\n")
                    );
                    lines += 1;
                }
            }
        }
    }
    assert!(lines > 500, "{lines}");
}

/// Without slip the two points of a contact have the same velocity: none is drawn between them.
#[test]
fn rolling_has_no_sliding_velocity() {
    let mut rolling = 0;
    for (name, scene, worked) in moving() {
        for t in worked.plan.terms(DiagramKind::Velocity) {
            if let (TermKind::Roll, TermConnection::Contact(pair)) = (t.kind, t.by) {
                assert!(scene.rolling[pair.0].contact().is_none(), "{name}: {t:?}");
            }
        }
        rolling += usize::from(scene.rolling.iter().any(|r| r.contact().is_some()));
    }
    assert!(rolling > 10, "{rolling}");
}

/// The ground does not turn, and no step mentions its rotation.
#[test]
fn no_step_turns_the_ground() {
    for (name, scene, worked) in moving() {
        let rates =
            DiagramKind::POLYGONS.iter().flat_map(|l| worked.plan.steps(*l)).flat_map(|g| &g.rates);
        assert!(rates.clone().all(|(body, _)| *body != TurningBody::Link(scene.ground)), "{name}");
    }
}

/// A slider without its pin in the file is the same pair as with it: of the same dyad, drawn, with
/// the same answers.
#[test]
fn a_slider_without_a_pin_is_the_dyad_that_it_is_with_one() {
    let kinds = |scene: &Scene| -> Vec<(Option<&'static str>, String)> {
        let m = Mechanism::new(scene).unwrap().value;
        m.assur(scene).iter().map(|g| (g.class(), g.kind().to_owned())).collect()
    };
    let mut tried = 0;
    for t in templates::list() {
        let mut file: Json =
            serde_json::from_str(templates::instantiate(t.name, &[]).unwrap().as_str()).unwrap();
        let own = read(&file.to_string());
        if file["cams"].is_array() || !file["time"].is_null() || file["driver"].is_array() {
            continue;
        }
        let Ok(solved) = work(&own, Scope::Figure) else { continue };
        let at = &solved.value.configuration.points;
        let Some(guides) = file["guides"].as_array().cloned() else { continue };
        let open =
            |g: &Json| g["pin"].is_string() && g["slider"].is_string() && g["centre"].is_null();
        if !guides.iter().any(open) {
            continue;
        }
        // The pose by coordinates, and each slider with its pin.
        let place = |p: usize| {
            (
                own.points[p].name.clone(),
                json!([format!("{:?} m", at[p].unwrap().x), format!("{:?} m", at[p].unwrap().y)]),
            )
        };
        if own.points.iter().enumerate().any(|(p, _)| at[p].is_none()) || !own.rolling.is_empty() {
            continue;
        }
        file["points"] = (0..own.points.len()).map(place).collect::<serde_json::Map<_, _>>().into();
        for key in ["lengths", "side", "sketch"] {
            file.as_object_mut().unwrap().remove(key);
        }
        for key in ["angle", "position"] {
            file["driver"].as_object_mut().unwrap().remove(key);
        }
        for g in guides.iter().filter(|g| open(g)) {
            let slider = g["slider"].as_str().unwrap();
            if file["links"][slider].is_null() {
                file["links"][slider] = json!([g["pin"]]);
            }
        }
        let with = read(&file.to_string());
        file["guides"].as_array_mut().unwrap().iter_mut().filter(|g| open(g)).for_each(|g| {
            g.as_object_mut().unwrap().remove("pin");
        });
        // A driver then names the slider by its number.
        let Ok(without) = scene::read(file.to_string()) else { continue };
        let without = without.value;
        assert_eq!(kinds(&with), kinds(&without), "{}", t.name);
        let (a, b) = (worked(&with), worked(&without));
        for (a, b) in a.results.iter().zip(&b.results) {
            let off = a
                .value()
                .columns()
                .iter()
                .zip(b.value().columns())
                .map(|(x, y)| (x - y).abs())
                .fold(0.0, f64::max);
            assert!(
                off <= 1e-9 * a.value().magnitude().max(1.0),
                "{}: {} is {:?} and {:?}",
                t.name,
                with.find[a.find].text,
                a.value(),
                b.value()
            );
            assert_eq!(a.drawn.is_some(), b.drawn.is_some(), "{}", t.name);
        }
        tried += 1;
    }
    assert!(tried > 8, "{tried}");
}

const RPR: &str = r#"{ "units":{"length":"mm"}, "links":{"1":["A","B"],"2":["B","D"],"3":["C","E"],"4":["A","C"]},"ground":"4",
 "points":{"A":[0,0],"C":[150,0],"B":[40,60],"D":[140,100],"E":[140,30]}, "guides":[{"slider":"3","on":"2","line":"BD"}],
 "driver":{"link":"DRIVER","omega":"10 rad/s"},"find":["omega_2","alpha_3","v_E","a_E"]}"#;

/// A block beside its guide is drawn, whichever of the two links carries the guide, and its dyad is
/// named by its pairs whatever drives.
#[test]
fn an_offset_block_makes_a_dyad_of_its_pairs() {
    let kinds = |driver: &str| {
        let scene = read(&RPR.replace("DRIVER", driver));
        let m = Mechanism::new(&scene).unwrap().value;
        let worked = worked(&scene);
        assert!(
            worked
                .results
                .iter()
                .all(|r| r.drawn.is_some() && r.agreement.unwrap().difference < 1e-12),
            "{:?}",
            worked.results
        );
        m.assur(&scene)
            .iter()
            .filter(|g| g.class() == Some("II"))
            .map(|g| g.kind().to_owned())
            .collect::<Vec<_>>()
    };
    assert_eq!(kinds("1"), ["RPR"]);
    assert_eq!(kinds("3"), ["RRP"]);
}

/// The centre of a body with a single point follows from its velocity and angular velocity, as in
/// `centres`.
#[test]
fn a_body_with_one_point_has_a_centre() {
    let body = r#"{"units":{"length":"m"},"links":{"2":["G"]},"ground":"1","points":{"G":[0,0]},
        "guides":[{"pin":"G","slider":"3","on":"4","angle":"0 deg"},{"slider":"4","on":"1","angle":"90 deg"}],
        "driver":[{"slide":"G","velocity":"2 m/s"},{"slide":"4","velocity":"1 m/s"},{"link":"2","omega":"4 rad/s"}],"find":["P_12","omega_2","v_G"]}"#;
    let scene = read(body);
    let worked = worked(&scene);
    assert!(worked.at_infinity.is_empty());
    let task = CentreTask::of(&scene).unwrap();
    for r in &worked.results {
        let (Asked::InstantCentre(q), AnswerValue::Point(p)) =
            (&scene.find[r.find].what, r.value())
        else {
            continue;
        };
        let Some(CentrePlace::At(at)) = task.found.of(q.links[0].0, q.links[1].0).unwrap().place
        else {
            panic!("it turns")
        };
        assert!(
            at.distance(p) < 1e-12 && at.distance(hodograph::geom::Point::new(-0.25, 0.5)) < 1e-12,
            "{at:?} {p:?}"
        );
        return;
    }
    panic!("P_12 has no place: {:?}", worked.results);
}

/// Barrel and rod of a cylinder turn with its line, each about its own pin: at the pin of the
/// barrel the rod is faster by the cylinder's speed. In the loop equations, in long arithmetic and
/// in a sweep.
#[test]
fn a_rod_moves_along_its_barrel() {
    let find = "v_B7, v_B8, v_C7, v_C8, v_B, v_C, a_B7, a_C8, a_B, a_C";
    let scene = scene::read_asking(templates::get("excavator").unwrap(), find).unwrap().value;
    let worked = worked(&scene);
    let place = |name: &str| worked.configuration.named(&scene, name).unwrap();
    let slides = (place("C") - place("B")).unit().unwrap() * scene.drivers[0].rate.value;
    let certified = hodograph::certified::certify(&scene, &worked, 6);
    let m = Mechanism::new(&scene).unwrap().value;
    let placed = PlacedScene::new(&scene, &m).unwrap();
    let now = scene.drivers[0].kind.position().unwrap().value();
    let row = hodograph::sweep::of_values(&placed, 0, vec![now]).unwrap();
    let of = |name: &str| {
        let r = worked.results.iter().find(|r| scene.find[r.find].text == name).unwrap();
        let AnswerValue::Vector(v) = r.computed else { panic!("{name} is a vector") };
        let swept = ["x", "y"].map(|axis| row.column(&format!("{name}.{axis}")).unwrap().values[0]);
        assert!(
            (v.x - swept[0]).abs() + (v.y - swept[1]).abs() < 1e-9,
            "{name}: {v:?}, in a sweep {swept:?}"
        );
        // Certified digits are those of the value: a value with other digits in long arithmetic has
        // none.
        let k = worked.results.iter().position(|r| scene.find[r.find].text == name).unwrap();
        assert!(!certified[k].parts.is_empty(), "{name}: {:?}", certified[k].why);
        v
    };
    let near = |a: hodograph::geom::Vec2, b: hodograph::geom::Vec2, what: &str| {
        assert!((a - b).norm() < 1e-12, "{what}: {a:?}, not {b:?}")
    };
    near(of("v_B7"), of("v_B"), "the barrel at its pin");
    near(of("v_C8"), of("v_C"), "the rod at its pin");
    near(of("v_B8") - of("v_B7"), slides, "the rod at the pin of the barrel");
    near(of("v_C8") - of("v_C7"), slides, "the rod at its own pin");
    near(of("a_B7"), of("a_B"), "the barrel at its pin");
    near(of("a_C8"), of("a_C"), "the rod at its pin");
}

/// A task for centres is solved by centres: no polygon in the worksheet, and each centre is a step
/// of the lesson.
#[test]
fn a_task_for_centres_is_solved_by_centres() {
    let mut tasks = 0;
    for (name, scene) in scenes() {
        let Some(task) = CentreTask::of(&scene).filter(|t| t.alone) else { continue };
        let worked = worked(&scene);
        for lang in [Lang::En, Lang::Zh] {
            let options = worksheet::WorksheetOptions {
                sides: WorksheetSides::Solution,
                ..worksheet::WorksheetOptions::of_language(lang)
            };
            let document = worksheet::worksheet(&scene, &worked, &options);
            let figures: Vec<&str> = document
                .blocks
                .iter()
                .filter_map(|b| {
                    if let DocumentBlock::Figure { name, .. } = b { Some(*name) } else { None }
                })
                .collect();
            assert!(
                !figures.is_empty() && figures.iter().all(|f| *f == "centres"),
                "{name}: {figures:?}"
            );
            let said: Vec<String> = document
                .blocks
                .iter()
                .filter_map(|b| {
                    if let DocumentBlock::List { members, .. } = b { Some(members) } else { None }
                })
                .flatten()
                .map(|p| p.source())
                .collect();
            for c in &task.found.list {
                let own = format!("$P_{{{}}}$", c.step.pair.indices(&scene));
                assert!(
                    said.iter().any(|s| s.starts_with(&own)),
                    "{name}: {own} is not found in {said:?}"
                );
            }
        }
        if tasks < 2 {
            let options = lesson::LessonOptions {
                positions: 24,
                ..lesson::LessonOptions::of_language(Lang::En)
            };
            let page = lesson::of_worked(&scene, &worked, &options).unwrap().value;
            let data: Json = serde_json::from_str(&lesson::told(&page).unwrap()).unwrap();
            let frames = data["frames"].as_array().unwrap();
            assert!(frames.len() > 4, "{name}");
            for frame in frames {
                let steps = frame["steps"].as_array().unwrap();
                assert_eq!(
                    steps.len(),
                    task.found.list.len()
                        + task.found.uses.links.len()
                        + task.found.uses.points.len(),
                    "{name}"
                );
                assert!(
                    steps.iter().flat_map(|s| s.as_array().unwrap()).all(|s| s
                        .as_str()
                        .unwrap()
                        .len()
                        > 5),
                    "{name}: {steps:?}"
                );
            }
        }
        tasks += 1;
    }
    assert!(tasks >= 2, "{tasks}");
}

/// A point whose motion only two frames determine is drawn step by step in both, and the projections
/// of both follow.
#[test]
fn steps_of_composite_motion_end_with_the_second_frame_where_one_does_not_determine() {
    let scene = read(templates::get("two-slots").unwrap());
    let worked = worked(&scene);
    let (options, extras) = (SheetOptions::of_language(Lang::En), Extras::default());
    let w = FigureInput { scene: &scene, worked: &worked, options: &options, extras: &extras };
    let made = ConstructionMethod::Composite.stepped(&w).unwrap().unwrap();
    assert_eq!(made.views.len(), 6);
    let begins = |text: &str| made.steps.iter().filter(|s| s.en.starts_with(text)).count();
    assert_eq!(begins("Moving point"), 2);
    assert_eq!(begins("Each equation alone has three unknowns"), 1);
    assert!(made.steps.last().unwrap().en.starts_with("Projected on the perpendicular"));
    // The parts of the second frame appear in its own steps.
    let second = made.steps.iter().rposition(|s| s.en.starts_with("Moving point")).unwrap();
    for (k, view) in made.views.iter().enumerate() {
        let steps: Vec<usize> = view.part.items.iter().flat_map(FigureItem::steps).collect();
        assert!(!steps.is_empty() && steps.iter().all(|s| (*s > second) == (k >= 3)), "{steps:?}");
    }
}

/// A projection leaves one unknown: the line is perpendicular to the other one, and a vector of
/// unknown magnitude and direction is found by its components.
#[test]
fn composite_motion_is_projected_across_the_other_unknown() {
    let (mut across, mut sides) = (0, 0);
    for (name, scene, _) in moving() {
        let staged = ContactScene::new(&scene);
        let ground = Frame::Link(scene.ground);
        let served: Vec<_> = staged
            .choices(&scene)
            .into_iter()
            .filter(|c| c.verdict == ChoiceVerdict::Serves)
            .collect();
        let Ok(solved) = staged.solved(&served, level(&scene)) else { continue };
        for s in &solved.value.1 {
            let path = relative_path(&staged.scene, s.choice.of, ground);
            for p in projections(s) {
                let has = |t: ProjectionTerm| p.terms.iter().any(|(own, _)| *own == t);
                match p.on {
                    On::Across if s.known == KnownMotion::Transport => {
                        assert!(
                            path != RelativePath::Unknown,
                            "{name}: the direction of v_a is not known: {p:?}"
                        );
                        let circle = s.circle.is_some() && p.of == DiagramKind::Acceleration;
                        assert!(
                            !(circle && has(ProjectionTerm::Absolute)),
                            "{name}: the direction of a_a is not known: {p:?}"
                        );
                        across += 1;
                    }
                    On::X | On::Y => {
                        assert!(
                            has(ProjectionTerm::Component)
                                && !has(ProjectionTerm::Absolute)
                                && path == RelativePath::Unknown,
                            "{name}: {p:?}"
                        );
                        sides += 1;
                    }
                    On::Across | On::Along => {}
                }
            }
        }
    }
    assert!(across > 20 && sides > 4, "{across} {sides}");
}

/// The drawn length of a link in a worksheet is true of the figure that it shows.
#[test]
fn a_length_is_drawn_as_long_as_the_worksheet_says() {
    for (name, scene, worked) in moving().filter(|(_, scene, _)| !scene.lengths.is_empty()) {
        let document = worksheet::worksheet(
            &scene,
            &worked,
            &worksheet::WorksheetOptions::of_language(Lang::En),
        );
        let lists = document.blocks.iter().filter_map(|b| {
            if let DocumentBlock::List { members, .. } = b { Some(members) } else { None }
        });
        let Some(said) = lists.flatten().map(|p| p.source()).find(|s| s.contains("is drawn"))
        else {
            continue;
        };
        let told = |text: &str| {
            text.split("= ").nth(1).and_then(|t| t.split('$').next()).unwrap_or_default().to_owned()
        };
        let scale = told(&said);
        // The last drawing of the mechanism before it.
        let figure = document.blocks.iter().rev().find_map(|b| match b {
            DocumentBlock::Figure { name: "construction" | "mechanism", figure } => Some(figure),
            _ => None,
        });
        let captions: Vec<String> = figure
            .unwrap()
            .items
            .iter()
            .filter_map(|i| match &i.shape {
                hodograph::paper::item::Shape::Label { label, .. }
                    if label.source().contains("\\mu_l") =>
                {
                    Some(label.source().to_owned())
                }
                _ => None,
            })
            .collect();
        if let [caption] = &captions[..] {
            assert!(caption.contains(&scale), "{name}: {said} beside {caption}");
        }
    }
}

/// Each step of a lesson has its sentence in each position that shows its drawing, and no position
/// has fewer steps than others.
#[test]
fn each_step_of_a_lesson_has_its_sentence() {
    for (name, over) in [
        ("cam-offset-roller", None),
        ("cam-valve-train", None),
        ("cart-by-law", Some(Swept::Time)),
        ("plate-by-law", Some(Swept::Time)),
        ("crank-rocker", None),
    ] {
        let scene = read(templates::get(name).unwrap());
        let mut options =
            lesson::LessonOptions { positions: 16, ..lesson::LessonOptions::of_language(Lang::En) };
        options.swept = over.unwrap_or(options.swept);
        let page = lesson::lesson(&scene, &options).unwrap().value;
        let data: Json = serde_json::from_str(&lesson::told(&page).unwrap()).unwrap();
        let steps = data["steps"].as_array().unwrap();
        for step in steps {
            // A drawing that a position does not show has no pole there.
            let pole = steps.iter().find(|s| s[0] == step[0] && s[1] == -1).unwrap();
            let silent = |said: &Json| {
                let runs = said[1].as_array().cloned().unwrap_or_default();
                let runs: Vec<i64> = runs.iter().map(|n| n.as_i64().unwrap()).collect();
                runs.chunks(2).flat_map(|r| vec![r[0] == -1; r[1] as usize]).collect::<Vec<bool>>()
            };
            for said in [&step[2], &step[3]] {
                let forms: Vec<&str> =
                    said[0].as_array().unwrap().iter().map(|f| f.as_str().unwrap()).collect();
                // On a straight flank fewer vectors are drawn than on an arc.
                let fewer = name == "cam-valve-train" && forms.len() > 1;
                let nothing = |f: &&str| f.contains("nothing more") || f.contains("不再作图");
                assert!(fewer || !forms.iter().any(nothing), "{name}: {forms:?}");
                let (own, all) = (silent(said), silent(&pole[2]));
                assert!(
                    own.iter().enumerate().all(|(k, s)| !s || all.get(k) == Some(&true)),
                    "{name}: {step}"
                );
            }
        }
    }
}

/// A place has no magnitude: its curves are those of its coordinates.
#[test]
fn curves_of_a_place_are_its_coordinates() {
    let lathe = r#"{ "parameters":{"b":"50 mm","w":"2 rad/s"}, "time":"0.3 s", "links":{"1":["O"],"2":["O","W"]}, "ground":"1",
        "points":{"O":[0,0]},"lengths":{"OW":"60 mm"}, "guides":[{"pin":"T","slider":"3","on":"1","through":"O","angle":"0 deg"}],
        "driver":[{"link":"2","angle":"w*t"},{"slide":"T","position":"b*sin(w*t)"}], "find":["path_T/2"] }"#;
    let scene = read(lathe);
    let m = Mechanism::new(&scene).unwrap().value;
    let placed = PlacedScene::new(&scene, &m).unwrap();
    let (timed, range) = TimedSweep::new(&placed, [None, None]).unwrap();
    let table = gather(&mut timed.steps(range, 12));
    let diagram = CurveDiagram::swept(
        &scene,
        Swept::Time,
        &table,
        &|_| None,
        &Notation::of_language(Lang::En),
    );
    assert!(!diagram.is_empty());
    assert_eq!(diagram.panels.iter().map(|p| p.curves.len()).sum::<usize>(), 2);
}
