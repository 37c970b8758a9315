//! Files of other programs are read back by those programs where they are there: pylinkage and ezdxf
//! in Python, GeoGebra's construction by an evaluation of its commands.

use assert_cmd::Command;
use hodograph::exchange::{self, Linkage, PlacingRule, pmks, pylinkage};
use hodograph::problem::{Look, Options, Pictures, read, solve, templates};
use serde_json::Value as Json;
use std::path::Path;

/// Linkages of circles and lines whose cranks turn fully.
const TURNING: [&str; 12] = [
    "atkinson",
    "crank-rocker",
    "crossed-four-bar",
    "drag-link",
    "jansen-leg",
    "offset-slider-crank",
    "pump-jack",
    "radial-engine",
    "shaper",
    "slotted-lever",
    "watt-six-bar",
    "whitworth",
];

/// Largest distance (mm) of a joint from its place after up to a turn of one-degree steps.
const EXACT_MM: f64 = 1e-9;

fn linkage(text: &str) -> Linkage {
    let problem = read(text).unwrap().value;
    let solved = solve(&problem, &Options::with_figures()).unwrap();
    let (scene, worked) = solved.mechanism().unwrap();
    Linkage::of(scene, worked, scene.title.en.clone()).unwrap()
}

fn template(name: &str) -> String {
    templates::text(name, &[]).unwrap()
}

fn program() -> Command {
    let mut run = Command::new(env!("CARGO_BIN_EXE_hodograph"));
    run.env("LC_ALL", "C");
    run
}

/// What the script prints about a file; `None` where Python or the program is not installed.
fn read_back(arguments: &[&str]) -> Option<Json> {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/exchange/read_back.py");
    let run = std::process::Command::new("python3").arg(script).args(arguments).output().ok()?;
    let (out, said) = (String::from_utf8_lossy(&run.stdout), String::from_utf8_lossy(&run.stderr));
    assert!(run.status.success(), "{arguments:?}: {said}");
    if out.starts_with("missing") {
        println!("skipped {arguments:?}: {out}");
        return None;
    }
    Some(serde_json::from_str(&out).unwrap())
}

/// pylinkage and GeoGebra's commands give the places of the sweep over a whole turn; GeoGebra's
/// velocity polygon is the derivative of its places.
#[test]
fn other_programs_move_the_joints_as_the_sweep_does() {
    for name in TURNING {
        let folder = tempfile::tempdir().unwrap();
        let at = |file: &str| folder.path().join(file).to_str().unwrap().to_owned();
        let scene = at("s.json");
        std::fs::write(&scene, template(name)).unwrap();
        let of = linkage(&template(name));
        let tip = exchange::order(&of).unwrap()[0].joint;
        let from = (of.joints[tip].at - of.joints[of.pivot].at).angle();
        let to = from + std::f64::consts::TAU.copysign(of.rate);
        let find: Vec<String> = of.joints.iter().map(|j| format!("x_{0},y_{0}", j.name)).collect();
        let (from, to) = (format!("--from={from} rad"), format!("--to={to} rad"));
        let sweep = ["sweep", &scene, "--over", "driver", &from, &to, "--steps", "360"];
        let table = at("t.csv");
        program().args(sweep).args(["--find", &find.join(","), "-o", &table]).assert().success();
        for ending in ["py", "json", "ggb"] {
            let file = at(&format!("x.{ending}"));
            if ending == "json" && pylinkage::file(&of).is_err() {
                continue;
            }
            program().args(["export", &scene, "-o", &file]).assert().success();
            let Some(told) = read_back(&[ending, &file, &table]) else { continue };
            let worst = told["worst_mm"].as_f64().unwrap();
            assert!(worst < EXACT_MM, "{name}.{ending}: {worst} mm");
        }
    }
}

/// A linkage comes back from the formats that can be read, by itself and as a scene that is solved.
#[test]
fn linkages_come_back() {
    for name in TURNING {
        let given = linkage(&template(name));
        let file = pylinkage::file(&given).ok();
        let back = [
            ("pmks", Some(pmks::read(&pmks::text(&given)).unwrap())),
            ("pylinkage", file.map(|file| pylinkage::read(&file).unwrap())),
        ];
        for (format, read) in back.into_iter().filter_map(|(f, read)| Some((f, read?))) {
            let again = linkage(&exchange::scene(&read).text);
            for of in [&read, &again] {
                let sorted = |of: &Linkage| {
                    let mut all: Vec<[f64; 2]> =
                        of.joints.iter().map(|j| [j.at.x, j.at.y]).collect();
                    all.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
                    all
                };
                let (one, other) = (sorted(&given), sorted(of));
                assert_eq!(one.len(), other.len(), "{name} by {format}");
                for (a, b) in one.iter().flatten().zip(other.iter().flatten()) {
                    assert!((a - b).abs() < EXACT_MM, "{name} by {format}: {a} {b}");
                }
                let rules = |of: &Linkage| {
                    let all = exchange::order(of).unwrap();
                    all.iter().filter(|p| matches!(p.rule, PlacingRule::OnLine { .. })).count()
                };
                assert_eq!(rules(&given), rules(of), "{name} by {format}");
            }
        }
    }
}

/// Files of PMKS separate by commas or spaces, mark the driver, and share a block.
#[test]
fn both_forms_of_pmks_are_read() {
    let plain =
        "ground,input,R,0,0\ninput,coupler,R,0,10\ncoupler,output,R,12,2\nground,output,P,12,0,0\n";
    let marked = "coupler output R 12 2 +---\ninput,gnd,R,0,0,+--+\n input, coupler,r,0,10,+---\n\
                  output,ground,P,12,0,0,+---\nd=0\n";
    for source in [plain, marked] {
        let read = pmks::read(source).unwrap();
        assert_eq!(read.bodies[read.crank].name, "input");
        assert_eq!(read.joints[read.pivot].at, hodograph::geom::Point::ORIGIN);
        assert_eq!((read.joints.len(), read.slides.len()), (3, 1), "{read:?}");
        let scene = exchange::scene(&read);
        let solved =
            solve(&hodograph::problem::read(&scene.text).unwrap().value, &Options::default());
        assert!(solved.is_ok(), "{}", scene.text);
    }
    let slot =
        pmks::read("ground,input,R,0,0\ncoupler input,RP,2,0,30\ncoupler,ground,R,5,0\n").unwrap();
    assert_eq!(slot.bodies[slot.slides[0].on.unwrap()].name, "coupler");
    let faults = pmks::read("ground,input,R,0,0\nnonsense\n").unwrap_err();
    assert_eq!((faults.list[0].code, faults.list[0].span.unwrap().start), ("import", 19));
}

/// What a format has no place for is refused with the reason.
#[test]
fn parts_that_a_format_lacks_are_refused() {
    for (name, ending) in
        [("planetary-gear", "txt"), ("shaper", "json"), ("class-iii-six-bar", "ggb")]
    {
        let folder = tempfile::tempdir().unwrap();
        let at = |file: &str| folder.path().join(file).to_str().unwrap().to_owned();
        std::fs::write(at("s.json"), template(name)).unwrap();
        let run =
            program().args(["export", &at("s.json"), "-o", &at(&format!("x.{ending}"))]).assert();
        let said = String::from_utf8(run.code(2).get_output().stderr.clone()).unwrap();
        assert!(said.contains("the format has no place for"), "{said}");
    }
}

/// The drawing of the mechanism has its joints in their places in the scene, arcs stay arcs, and the
/// vectors of a polygon begin at its pole in the origin.
#[test]
fn drawings_have_true_millimetres_on_layers_by_meaning() {
    let folder = tempfile::tempdir().unwrap();
    let at = |file: &str| folder.path().join(file).to_str().unwrap().to_owned();
    std::fs::write(at("s.json"), template("crank-rocker")).unwrap();
    for (figure, file) in [("mechanism", "m.dxf"), ("velocity", "v.dxf")] {
        let run = ["export", &at("s.json"), "--figure", figure, "-o", &at(file)];
        program().args(run).assert().success();
    }
    let text = std::fs::read_to_string(at("m.dxf")).unwrap();
    assert!(text.contains("ARC") && text.contains("TEXT"));
    if let Some(drawn) = read_back(&["dxf", &at("m.dxf")]) {
        let joints = drawn["joints"].as_array().unwrap();
        for joint in linkage(&template("crank-rocker")).joints {
            let near = |c: &&Json| {
                let place = [&c[0], &c[1]].map(|v| v.as_f64().unwrap());
                (place[0] - joint.at.x).hypot(place[1] - joint.at.y) < 1e-5
            };
            assert!(joints.iter().any(|c| near(&c)), "{} {joints:?}", joint.name);
        }
        for layer in ["LINKS", "JOINTS", "GROUND", "GIVEN", "TEXT"] {
            assert!(drawn["layers"][layer].as_u64() > Some(0), "{layer}: {}", drawn["layers"]);
        }
        let texts = drawn["texts"].as_array().unwrap();
        assert!(texts.iter().any(|t| t == "B") && texts.iter().any(|t| t == "ω"), "{texts:?}");
    }
    if let Some(drawn) = read_back(&["dxf", &at("v.dxf")]) {
        let from_pole = |l: &&Json| l[0] == 0.0 && l[1] == 0.0;
        let lines = drawn["lines"].as_array().unwrap();
        assert!(lines.iter().filter(from_pole).count() >= 2, "{lines:?}");
    }
}

/// Each step of the construction is a slide with its sentence as text and its drawing as PNG and SVG.
#[test]
fn every_step_is_a_slide_with_text_beside_its_picture() {
    let folder = tempfile::tempdir().unwrap();
    let at = |file: &str| folder.path().join(file).to_str().unwrap().to_owned();
    std::fs::write(at("s.json"), template("slider-crank")).unwrap();
    program().args(["export", &at("s.json"), "-o", &at("s.pptx")]).assert().success();
    let solved = solve(&read(template("slider-crank")).unwrap().value, &Options::with_figures());
    let pictures = Pictures { steps: true, ..Pictures::default() };
    let steps = solved.unwrap().figures(&pictures, &Look::default()).unwrap().value.len();
    let bytes = std::fs::read(at("s.pptx")).unwrap();
    let has = |name: &str| bytes.windows(name.len()).any(|w| w == name.as_bytes());
    for k in 1..=steps {
        assert!(has(&format!("ppt/slides/slide{k}.xml")) && has(&format!("ppt/media/step{k}.svg")));
    }
    assert!(!has(&format!("ppt/slides/slide{}.xml", steps + 1)));
    let Some(slides) = read_back(&["pptx", &at("s.pptx")]) else { return };
    assert_eq!(slides.as_array().unwrap().len(), steps);
    for slide in slides.as_array().unwrap() {
        let said = |k: usize| slide["texts"][k].as_str().unwrap();
        assert!(said(0).contains("step") && said(1).len() > 8, "{slide}");
        assert_eq!(slide["pictures"], serde_json::json!(["image/png"]));
        let ends = slide["ends"][0].as_array().unwrap();
        assert!(ends[0].as_f64() < Some(8_640_000.0) && ends[1].as_f64() < Some(6_858_000.0));
    }
}

/// mdBook's protocol: the renderer is answered by the exit code; fenced scenes, templates and files
/// in chapters and their subchapters become drawings with ids of their own, and other blocks stay.
#[test]
fn scenes_in_a_book_become_drawings() {
    program().args(["mdbook", "supports", "html"]).assert().code(0);
    program().args(["mdbook", "supports", "pandoc"]).assert().code(1);
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir_all(folder.path().join("src/part")).unwrap();
    std::fs::write(folder.path().join("src/part/s.json"), template("shaper")).unwrap();
    let scene = template("crank-rocker");
    let inner = "Text.\n```hodograph figure=velocity lang=zh\ns.json\n```\n";
    let outer = format!(
        "# One\n```hodograph figure=mechanism\n{scene}\n```\n\n```rust\n# hodograph\n```\n```hodograph\nslider-crank\n```\nEnd"
    );
    let book = serde_json::json!([{"root": "."}, {"sections": [
        {"Chapter": {"name": "One", "content": outer, "path": "one.md", "sub_items": [
            {"Chapter": {"name": "Two", "content": inner, "path": "part/two.md", "sub_items": []}}
        ]}}, "Separator"], "__non_exhaustive": null}]);
    let run = |input: String| {
        program().current_dir(folder.path()).arg("mdbook").write_stdin(input).assert()
    };
    let out = run(book.to_string()).success().get_output().stdout.clone();
    let out: Json = serde_json::from_slice(&out).unwrap();
    let one = &out["sections"][0]["Chapter"];
    let text = one["content"].as_str().unwrap();
    assert_eq!(text.matches("<svg").count(), 2, "{text}");
    assert!(text.contains("```rust\n# hodograph\n```\n") && text.ends_with("End\n"));
    assert!(text.contains("id=\"hg1-mechanism") && text.contains("id=\"hg2-"));
    // HTML within Markdown ends at a blank line.
    let drawing = &text[text.find("<svg").unwrap()..text.find("</svg>").unwrap()];
    assert!(!drawing.contains("\n\n"));
    let two = one["sub_items"][0]["Chapter"]["content"].as_str().unwrap();
    assert!(two.contains("id=\"hg3-vel-") && two.contains("速度多边形"), "{two}");
    let wrong = outer.replace("figure=mechanism", "figure=nothing");
    let book =
        serde_json::json!([{}, {"items": [{"Chapter": {"content": wrong, "path": "one.md"}}]}]);
    let said = run(book.to_string()).code(2).get_output().stderr.clone();
    assert!(String::from_utf8(said).unwrap().contains("figure=nothing"));
    run("{}".into()).code(2);
}

/// The example for Typst is set with figures that are drawn by the command that it names.
#[test]
fn the_typst_example_finds_its_figures() {
    let folder = tempfile::tempdir().unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for file in ["hodograph.typ", "demo.typ"] {
        std::fs::copy(root.join("examples/typst").join(file), folder.path().join(file)).unwrap();
    }
    let demo = std::fs::read_to_string(root.join("examples/typst/demo.typ")).unwrap();
    let line = demo.lines().next().unwrap().strip_prefix("// hodograph ").unwrap();
    std::fs::write(folder.path().join("shaper.json"), template("shaper")).unwrap();
    let line = line.replace("../../templates/", "");
    program().current_dir(folder.path()).args(line.split(' ')).assert().success();
    for figure in ["mechanism", "velocity"] {
        assert!(demo.contains(&format!("\"{figure}\"")));
        assert!(folder.path().join(format!("figures/shaper-{figure}.svg")).exists());
    }
    let file = folder.path().join("demo.typ").to_str().unwrap().to_owned();
    let Some(pages) = read_back(&["typ", &file]) else { return };
    assert!(pages[0].as_str().unwrap().matches("<image").count() >= 2);
}
