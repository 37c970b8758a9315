//! Golden files: for every template plan and construction as text, for some the plan as JSON, the
//! sheet as SVG (outlines folded to a hash) and PNG.
//!
//! To accept the current output: `HODOGRAPH_ACCEPT=1 cargo test --test golden`. That run writes the
//! files that differ and fails, naming each; look at them (`git diff`), the next run without the
//! variable passes. A quarter of the sheets is compared, all with `HODOGRAPH_WIDE=1`, and all are
//! written when accepting. [`files`] lists the files.

#[path = "golden/files.rs"]
mod files;
#[path = "golden/mobility.rs"]
mod mobility;
#[path = "golden/pdf.rs"]
mod pdf;
mod wide;
#[path = "golden/worksheet.rs"]
mod worksheet;

use files::{
    ASKED, CAM, CENTRES, CURVATURE, CURVES, DESIGNS, DRAFTED, KINDS, LANGS, LESSONS, PATHS,
    PLANS_AS_JSON, POLAR, POSES, SHOWN, accept, check_png, check_text, finish, golden, has_pixels,
    kept,
};
use hodograph::cam::CamSurvey;
use hodograph::centres;
use hodograph::certified::{certify, steps};
use hodograph::effort::Work;
use hodograph::figure::cam::{inversion, motion};
use hodograph::figure::curves::{self, CurveDiagram};
use hodograph::figure::list::{self, Extras, FigureInput};
use hodograph::figure::mechanism::Overlay;
use hodograph::figure::sheet::{SheetOptions, diagram, drawing, equations, sheet};
use hodograph::figure::steps::StepFigures;
use hodograph::figure::synthesis as designs;
use hodograph::figure::{groups, path, poses};
use hodograph::lesson;
use hodograph::mechanism::Mechanism;
use hodograph::notation::Notation;
use hodograph::paper::style::Style;
use hodograph::plan::text::PlanWriter;
use hodograph::render::{png as raster, svg};
use hodograph::report::cam::Report;
use hodograph::report::forces::ForceWriter;
use hodograph::report::{
    answers, centres as report_of_centres, construction, drafting, plan, plan_json,
};
use hodograph::scene::{self, Angle, DiagramKind, Lang, PointId, Swept, edit, templates};
use hodograph::sweep::{self, PlacedScene, Stations, Width, extreme};
use hodograph::synthesis;
use hodograph::worked::{Scope, work};
use std::path::Path;
use wide::every;

/// FNV-1a: any stable hash will do.
fn hash(text: &str) -> String {
    format!(
        "#{:016x}",
        text.bytes().fold(0xcbf2_9ce4_8422_2325u64, |h, b| (h ^ u64::from(b))
            .wrapping_mul(0x100_0000_01b3))
    )
}

/// Replaces outlines, and the letters of a label, by `#` and a hash: a changed letter still shows,
/// and the file stays readable.
fn folded(svg: &str) -> String {
    let mut out = String::with_capacity(svg.len() / 3);
    let mut rest = svg;
    loop {
        let outline = rest
            .find(" d=\"")
            .map(|i| (i + 4, rest[i + 4..].find('"').expect("an attribute ends"), ""));
        // All letters of a label follow one another.
        let letters = rest
            .find("<use ")
            .map(|i| (i, rest[i..].find("</g>").expect("a label ends"), "<use/>"));
        let Some((start, length, mark)) = [outline, letters].into_iter().flatten().min() else {
            break;
        };
        let text = &rest[start..start + length];
        out.push_str(&rest[..start]);
        out.push_str(mark);
        out.push_str(&if length > 80 || !mark.is_empty() { hash(text) } else { text.to_owned() });
        rest = &rest[start + length..];
    }
    out.push_str(rest);
    out
}

/// The words of a picture: title, description, and every label with its place.
fn words(svg: &str) -> String {
    let attribute = |tag: &str, name: &str| {
        let value = tag.split_once(&format!("{name}=\""))?.1;
        value.split_once('"').map(|(value, _)| value.to_owned())
    };
    let told = |line: &str| {
        let line = line.trim();
        if line.starts_with("<title>") || line.starts_with("<desc>") {
            return Some(line.to_owned());
        }
        let (label, place) = (attribute(line, "aria-label")?, attribute(line, "transform")?);
        Some(format!("{label}  {}", place.split("scale").next().unwrap_or_default()))
    };
    let lines: Vec<String> = svg.lines().filter_map(told).collect();
    lines.join("\n") + "\n"
}

/// Compares a figure with its files: in English the SVG (outlines folded) and the pixels, in
/// Chinese its words and their places, and for a few sheets the pixels of the Chinese letters too.
fn check_figure(
    folder: &str,
    name: &str,
    lang: Lang,
    svg: &str,
    dpi: f64,
    failures: &mut Vec<String>,
) {
    let (text, suffix) = match lang {
        Lang::En => (folded(svg), "en"),
        Lang::Zh => (words(svg), "zh"),
    };
    check_text(&golden(folder, &format!("{name}.{suffix}.svg.txt")), &text, failures);
    if has_pixels(folder, name, suffix) {
        check_png(
            &golden(folder, &format!("{name}.{suffix}.png")),
            &raster::render(svg, dpi).unwrap(),
            failures,
        );
    }
}

/// A lesson: its markup with folded outlines, and its data with folded packed columns; style and
/// script are files of their own.
fn lesson_text(page: &str) -> String {
    fn fold(value: &mut serde_json::Value) {
        match value {
            serde_json::Value::String(s) if s.len() > 80 => *s = format!("{} {}", s.len(), hash(s)),
            serde_json::Value::Array(list) => list.iter_mut().for_each(fold),
            serde_json::Value::Object(fields) => fields.values_mut().for_each(fold),
            _ => {}
        }
    }
    let between = |from: &str, to: &str| page.split(from).nth(1).unwrap().split(to).next().unwrap();
    let mut data: serde_json::Value = serde_json::from_str(&lesson::told(page).unwrap()).unwrap();
    data["words"] = "…".into();
    fold(&mut data);
    let lines: Vec<String> =
        data.as_object().unwrap().iter().map(|(key, value)| format!("{key}: {value}")).collect();
    let markup = folded(&page.replace(between("<style>", "</style>"), ""));
    format!(
        "{}\n{}\n",
        markup.split("<script").next().unwrap(),
        lines.join("\n").replace("],[\"", "],\n[\"")
    )
}

#[test]
fn lessons_stay_as_accepted() {
    let mut failures = Vec::new();
    for name in LESSONS {
        let scene = scene::read(templates::get(name).unwrap()).unwrap().value;
        let page = lesson::lesson(&scene, &lesson::LessonOptions::of_language(Lang::En))
            .unwrap_or_else(|f| panic!("{name}: {f}"))
            .value;
        check_text(&golden(name, "lesson.html.txt"), &lesson_text(&page), &mut failures);
        let worked = work(&scene, Scope::Figure).unwrap().value;
        let fragment =
            lesson::reveal(&scene, &worked, &SheetOptions::of_language(Lang::En)).unwrap().value;
        check_text(&golden(name, "reveal.html.txt"), &folded(&fragment), &mut failures);
    }
    finish(&failures);
}

#[test]
fn templates_look_as_accepted() {
    let mut failures = Vec::new();
    let schema =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/plan.schema.json"))
            .unwrap();
    let schema = jsonschema::validator_for(&serde_json::from_str(&schema).unwrap()).unwrap();
    for (n, t) in templates::list().iter().enumerate() {
        let scene = scene::read(templates::get(t.name).unwrap()).unwrap().value;
        let worked =
            work(&scene, Scope::Figure).unwrap_or_else(|f| panic!("{}: {f}", t.name)).value;
        let file = |name: String| golden(t.name, &name);
        for (lang, suffix) in LANGS {
            let notation = Notation::of_language(lang);
            let w = PlanWriter { scene: &scene, plan: &worked.plan, notation: &notation, lang };
            let forces = worked.equilibrium.as_ref().map(|of| ForceWriter {
                scene: &scene,
                notation: w.notation,
                lang: w.lang,
                of,
            });
            check_text(
                &file(format!("plan.{suffix}.txt")),
                &plan::text(&scene, &worked.mechanism, &w, forces.as_ref()),
                &mut failures,
            );
            check_text(
                &file(format!("construction.{suffix}.txt")),
                &construction::text(&w, &worked.construction, &steps(&scene, &worked, None)),
                &mut failures,
            );
            if DRAFTED.contains(&t.name) {
                let asked = work(&scene, Scope::Questions).unwrap().value.with_drafting(&scene);
                let w = PlanWriter { plan: &asked.plan, ..w };
                let text = format!(
                    "{}\n{}",
                    answers::text(
                        &scene,
                        &asked,
                        &certify(&scene, &asked, answers::DIGITS),
                        answers::DIGITS,
                        lang
                    ),
                    drafting::text(
                        &w,
                        &asked,
                        &steps(&scene, &asked, asked.drafting.as_ref().map(|d| d.pencil_mm))
                    )
                );
                check_text(&file(format!("drafting.{suffix}.txt")), &text, &mut failures);
            }
            // Sheets take most of the time.
            if n % every(4) != 0 && !accept() {
                continue;
            }
            let figure = sheet(
                &scene,
                &worked,
                &SheetOptions { notation: notation.clone(), ..SheetOptions::of_language(lang) },
            )
            .unwrap_or_else(|f| panic!("{}: {f}", t.name));
            let done = Work::of(&worked)
                .with_certified(&certify(&scene, &worked, answers::DIGITS))
                .with_labels(figure.labels_placed());
            let json =
                plan_json::json(&worked.mechanism, &worked.demand, &w, Some((&worked, done)), &[]);
            failures.extend(
                schema.iter_errors(&json).map(|e| {
                    format!("{}: docs/plan.schema.json: {}: {e}", t.name, e.instance_path())
                }),
            );
            if PLANS_AS_JSON.contains(&(t.name, suffix)) {
                check_text(
                    &file(format!("plan.{suffix}.json")),
                    &format!("{json:#}\n"),
                    &mut failures,
                );
            }
            let drawn = svg::write(&figure).unwrap_or_else(|f| panic!("{}: {f}", t.name));
            assert!(drawn.notes.is_empty(), "{}: {:?}", t.name, drawn.notes);
            check_figure(t.name, "sheet", lang, &drawn.value, 110.0, &mut failures);
        }
    }
    finish(&failures);
}

/// An inset, styles, single figures, steps, vectors, positions and a path.
#[test]
fn kinds_of_figures_look_as_accepted() {
    let mut failures = Vec::new();
    for (name, kind, style) in KINDS {
        let scene = scene::read(templates::get(name).unwrap()).unwrap().value;
        let worked = work(&scene, Scope::Figure).unwrap().value;
        let options = SheetOptions {
            style: Style::named(style).unwrap(),
            ..SheetOptions::of_language(Lang::En)
        };
        let figure = match kind {
            "inset" => drawing(&scene, &worked, &options, DiagramKind::Acceleration).unwrap(),
            "equations" => equations(&scene, &worked, &options).unwrap(),
            "step" => StepFigures::of(&scene, &worked, &options, None).figures().nth(11).unwrap(),
            "overlay" => {
                let point = PointId(scene.points.iter().position(|p| p.name == "S").unwrap());
                let overlay =
                    Overlay { vectors: Some(DiagramKind::Velocity), ..Overlay::default() }
                        .with_motion(&scene, &worked, 6, &[point]);
                diagram(&scene, &worked, &options, &overlay)
            }
            "groups" => {
                groups::figure(&scene, &worked, &options.style, &options.notation, Lang::En)
                    .unwrap()
            }
            _ => sheet(&scene, &worked, &options).unwrap(),
        };
        let drawn = svg::write(&figure).unwrap().value;
        check_png(
            &golden(name, &format!("{kind}.png")),
            &raster::render(&drawn, 110.0).unwrap(),
            &mut failures,
        );
    }
    finish(&failures);
}

/// Figures that are requested by name; of several pages the last.
#[test]
fn pictures_asked_for_look_as_accepted() {
    let mut failures = Vec::new();
    for (name, figure) in ASKED {
        let scene = scene::read(templates::get(name).unwrap()).unwrap().value;
        let worked = work(&scene, Scope::Figure).unwrap().value;
        for (lang, _) in LANGS {
            let options = SheetOptions::of_language(lang);
            let extras = Extras { dimensions: figure == "dimensions", ..Extras::default() };
            let entry = list::named(figure).unwrap_or(list::MECHANISM);
            let wanted =
                FigureInput { scene: &scene, worked: &worked, options: &options, extras: &extras };
            let pages =
                (entry.draw)(&wanted).unwrap_or_else(|f| panic!("{name} {figure}: {f}")).value;
            let drawn = svg::write(&pages.last().unwrap().1).unwrap().value;
            check_figure(name, figure, lang, &drawn, 110.0, &mut failures);
        }
    }
    finish(&failures);
}

/// All centres of a mechanism as figure and as text.
#[test]
fn centres_look_as_accepted() {
    let mut failures = Vec::new();
    for name in CENTRES {
        let scene = scene::read(templates::get(name).unwrap()).unwrap().value;
        let worked = work(&scene, Scope::Figure).unwrap().value;
        let found = centres::centres(&scene).unwrap().value;
        for (lang, suffix) in LANGS {
            let options = SheetOptions::of_language(lang);
            let wanted = FigureInput {
                scene: &scene,
                worked: &worked,
                options: &options,
                extras: &Extras::default(),
            };
            let page =
                (list::named("centres").unwrap().draw)(&wanted).unwrap().value.swap_remove(0).1;
            let drawn = svg::write(&page).unwrap();
            assert!(drawn.notes.is_empty(), "{name}: {:?}", drawn.notes);
            check_figure(name, "centres", lang, &drawn.value, 110.0, &mut failures);
            check_text(
                &golden(name, &format!("centres.{suffix}.txt")),
                &report_of_centres::text(&found, lang),
                &mut failures,
            );
        }
    }
    finish(&failures);
}

/// Inflection circle, centrodes, cognates, inversions.
#[test]
fn curvature_looks_as_accepted() {
    let mut failures = Vec::new();
    for (name, figures) in CURVATURE {
        let scene = scene::read(templates::get(name).unwrap()).unwrap().value;
        let worked = work(&scene, Scope::Figure).unwrap().value;
        for (lang, _) in LANGS {
            let options = SheetOptions::of_language(lang);
            let wanted = FigureInput {
                scene: &scene,
                worked: &worked,
                options: &options,
                extras: &Extras::default(),
            };
            for figure in figures {
                let page =
                    (list::named(figure).unwrap().draw)(&wanted).unwrap().value.swap_remove(0).1;
                let drawn = svg::write(&page).unwrap();
                assert!(drawn.notes.is_empty(), "{name} {figure}: {:?}", drawn.notes);
                check_figure(name, figure, lang, &drawn.value, 110.0, &mut failures);
            }
        }
    }
    finish(&failures);
}

/// The motion of a cam's follower, and the profile by inversion.
#[test]
fn cams_look_as_accepted() {
    let mut failures = Vec::new();
    let scene = scene::read(templates::get(CAM).unwrap()).unwrap().value;
    let cam = &scene.cams[0];
    let turning = cam.disc.as_ref().unwrap();
    let survey = CamSurvey::of(&turning.disc);
    let report = Report::new(&scene, cam, turning, &survey);
    for (lang, _) in LANGS {
        for (kind, figure) in [
            ("motion", motion::figure(&report, &Style::default(), lang)),
            ("profile", inversion::figure(&report, &Style::default(), lang)),
        ] {
            let drawn = svg::write(&figure).unwrap();
            assert!(drawn.notes.is_empty(), "{kind}: {:?}", drawn.notes);
            check_figure(CAM, kind, lang, &drawn.value, 80.0, &mut failures);
        }
    }
    finish(&failures);
}

/// The construction of each kind of synthesis.
#[test]
fn designs_look_as_accepted() {
    let mut failures = Vec::new();
    for kind in synthesis::KINDS {
        let (_, figure) = DESIGNS
            .iter()
            .find(|d| d.0 == kind.name)
            .unwrap_or_else(|| panic!("add {} to DESIGNS", kind.name));
        let task = synthesis::read(synthesis::templates::get(kind.name).unwrap()).unwrap().value;
        let design = synthesis::solve(&task).unwrap();
        for (lang, _) in LANGS {
            let all =
                designs::figures(&task, &design.candidates[0], &Style::default(), lang).unwrap();
            let drawn = svg::write(&all.iter().find(|f| f.0 == *figure).unwrap().1).unwrap();
            assert!(drawn.notes.is_empty(), "{}: {:?}", kind.name, drawn.notes);
            check_figure(
                "synthesis",
                &format!("{}-{figure}", kind.name),
                lang,
                &drawn.value,
                80.0,
                &mut failures,
            );
        }
    }
    finish(&failures);
}

/// A slider's displacement, velocity and acceleration: signs, extremes between the stations,
/// unwound angles.
#[test]
fn line_diagrams_look_as_accepted() {
    let mut failures = Vec::new();
    let [name] = CURVES;
    let source =
        edit::with_find(templates::get(name).unwrap(), &["x_C", "phi_3", "v_C", "v_B", "a_C"])
            .unwrap();
    let scene = scene::read(source).unwrap().value;
    let mechanism = Mechanism::new(&scene).unwrap().value;
    let placed = PlacedScene::new(&scene, &mechanism).unwrap();
    let table = sweep::run(
        &placed,
        0,
        &Stations::turned(Angle::Deg(0.0), Angle::Deg(360.0), 360),
        Width::Widest,
    )
    .unwrap();
    for (lang, _) in LANGS {
        let diagram = CurveDiagram::of(&placed, 0, &table, &Notation::of_language(lang));
        let figure = curves::figure(&scene, &diagram, &Style::default(), lang);
        check_figure(
            name,
            "curves",
            lang,
            &svg::write(&figure).unwrap().value,
            110.0,
            &mut failures,
        );
        // The ram is at the reversal of the lever: its extremes are those that `limits` finds by
        // Newton's method.
        let limits = extreme::limits(&scene, &mechanism, 0).unwrap();
        let stroke = diagram.panels[0].curves[0]
            .extremes
            .iter()
            .map(|e| e.1)
            .fold([f64::NEG_INFINITY, f64::INFINITY], |[h, l], v| [h.max(v), l.min(v)]);
        let found = stroke[0] - stroke[1];
        let nearest = limits
            .swings
            .iter()
            .filter_map(|s| s.stroke)
            .map(|m| (m * 1e3 - found).abs())
            .fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-6, "stroke {found} mm, {nearest} mm from that of the limits");
    }
    finish(&failures);
}

/// Forces through a turn, drawn from one pole.
#[test]
fn polar_diagrams_look_as_accepted() {
    let mut failures = Vec::new();
    let scene =
        scene::read(edit::with_find(templates::get(POLAR).unwrap(), &["F_12", "F_sh"]).unwrap())
            .unwrap()
            .value;
    let mechanism = Mechanism::new(&scene).unwrap().value;
    let placed = PlacedScene::new(&scene, &mechanism).unwrap();
    let table = sweep::run(
        &placed,
        0,
        &Stations::turned(Angle::Deg(0.0), Angle::Deg(360.0), 360),
        Width::Widest,
    )
    .unwrap();
    for (lang, _) in LANGS {
        let notation = Notation::of_language(lang);
        let figure =
            curves::polar(&scene, Swept::Driver(0), &table, &Style::default(), &notation, lang)
                .unwrap();
        let drawn = svg::write(&figure).unwrap();
        assert!(drawn.notes.is_empty(), "{:?}", drawn.notes);
        check_figure(POLAR, "polar", lang, &drawn.value, 110.0, &mut failures);
    }
    finish(&failures);
}

/// Paths with their hodographs: a coupler curve, a foot also in other positions, a crank that is
/// stopped, a slider and its pin; and the sheet of many poses, with hodographs behind its polygons.
#[test]
fn pictures_of_motion_look_as_accepted() {
    let mut failures = Vec::new();
    for (name, points, poses, style) in PATHS {
        let scene = scene::read(templates::get(name).unwrap()).unwrap().value;
        let worked = work(&scene, Scope::Figure).unwrap().value;
        let of = |name: &&str| PointId(scene.points.iter().position(|p| p.name == **name).unwrap());
        let wanted = path::PathContent {
            points: points.iter().map(of).collect(),
            swept: Swept::Driver(0),
            marks: 12,
            poses,
        };
        for (lang, _) in LANGS {
            let options = SheetOptions {
                style: Style::named(style).unwrap(),
                ..SheetOptions::of_language(lang)
            };
            let figure = path::figure(&scene, &worked, &options, &wanted)
                .unwrap_or_else(|f| panic!("{name}: {f}"))
                .value;
            let drawn = svg::write(&figure).unwrap();
            assert!(drawn.notes.is_empty(), "{name}: {:?}", drawn.notes);
            check_figure(name, "path", lang, &drawn.value, 80.0, &mut failures);
        }
    }
    for (name, point, count) in POSES {
        let scene = scene::read(templates::get(name).unwrap()).unwrap().value;
        let worked = work(&scene, Scope::Figure).unwrap().value;
        let of = |name: &str| PointId(scene.points.iter().position(|p| p.name == name).unwrap());
        let wanted = poses::PosesContent {
            count,
            swept: Swept::Driver(0),
            points: point.map(of).into_iter().collect(),
        };
        for (lang, _) in LANGS {
            let pages = poses::sheets(&scene, &worked, &SheetOptions::of_language(lang), &wanted)
                .unwrap_or_else(|f| panic!("{name}: {f}"));
            let drawn = svg::write(&pages.value[0]).unwrap();
            assert!(drawn.notes.is_empty(), "{name}: {:?}", drawn.notes);
            check_figure(name, "poses", lang, &drawn.value, 60.0, &mut failures);
        }
    }
    finish(&failures);
}

/// Motions without a mechanism, each template in both languages.
#[test]
fn motions_look_as_they_are_drawn() {
    use hodograph::{figure::particle::figures, particle};
    let mut failures = Vec::new();
    for name in particle::templates::names() {
        let problem = particle::read(particle::templates::get(name).unwrap()).unwrap().value;
        let (solved, drawn) =
            (particle::solve(&problem).unwrap(), particle::board::draw(&problem).unwrap());
        for (lang, _) in LANGS {
            for (_, figure) in figures(&problem, &solved, &drawn, &Style::default(), lang).unwrap()
            {
                let drawn = svg::write(&figure).unwrap().value;
                check_figure("motions", name, lang, &drawn, 110.0, &mut failures);
            }
        }
    }
    finish(&failures);
}

/// Vector equations, each template in both languages: the figure and the text with its steps.
#[test]
fn equations_look_as_they_are_drawn() {
    use hodograph::equation::templates;
    use hodograph::problem::{Look, Options, Pictures, read, solve};
    let mut failures = Vec::new();
    for name in templates::names() {
        let problem = read(templates::get(name).unwrap()).unwrap().value;
        let solved = solve(&problem, &Options::default()).unwrap();
        for (lang, tag) in LANGS {
            let look = Look { lang: Some(lang), ..Look::default() };
            let figure = &solved.figures(&Pictures::default(), &look).unwrap().value[0].1;
            let drawn = svg::write(figure).unwrap().value;
            check_figure("equations", name, lang, &drawn, 110.0, &mut failures);
            check_text(
                &golden("equations", &format!("{name}.{tag}.txt")),
                &solved.text(&look, true),
                &mut failures,
            );
        }
    }
    finish(&failures);
}

/// The gallery shows every template.
#[test]
fn the_gallery_is_current() {
    let mut failures = Vec::new();
    let mut page = String::from(
        "# Gallery\n\nEvery kind of picture, then every template as its sheet. `HODOGRAPH_ACCEPT=1 cargo test --test golden` makes the pictures and this\n\
         page anew; the same test without it checks that they are current. Any of them: `hodograph new NAME > scene.json && hodograph draw scene.json -o out/`.\n",
    );
    page += "\n## Kinds of picture\n\nThe mechanism, both polygons, equations and results of a sheet are pictures too: `hodograph draw --figure`.\n";
    for entry in list::LIST {
        let whole =
            ["sheet", "mechanism", "velocity", "acceleration", "results"].contains(&entry.name);
        let asked = format!("draw --figure {}", entry.name);
        assert!(
            whole || SHOWN.iter().any(|(_, command, _)| *command == asked),
            "the gallery does not show `{asked}`"
        );
    }
    for kind in synthesis::KINDS {
        let picture = format!("synthesis/{}-", kind.name);
        assert!(
            SHOWN.iter().any(|(.., file)| file.starts_with(&picture)),
            "the gallery does not show the synthesis of {}",
            kind.name
        );
    }
    for (title, command, picture) in SHOWN {
        assert!(kept().contains(picture), "{picture} is no golden file");
        page +=
            &format!("\n### {title}\n`hodograph {command}`\n\n![{title}](../golden/{picture})\n");
    }
    for t in templates::list() {
        page += &format!(
            "\n## {}\n`{}` · {}\n\n![{}](../golden/{}/sheet.en.png)\n",
            t.title.en, t.name, t.title.zh, t.title.en, t.name
        );
    }
    check_text(
        &Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/gallery.md"),
        &page,
        &mut failures,
    );
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
