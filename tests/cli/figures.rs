//! Commands that draw: figures in every format, worksheets, fonts, paths, positions.

use super::{hodograph, templates_path, text};
use std::path::Path;

#[test]
fn draws_svg_and_png_whole() {
    let out = tempfile::tempdir().unwrap();
    hodograph().args(["draw", "templates/shaper.json", "-o"]).arg(out.path()).assert().success();
    let svg = std::fs::read_to_string(out.path().join("shaper.svg")).unwrap();
    assert!(svg.trim_end().ends_with("</svg>"));
    assert!(std::fs::read(out.path().join("shaper.png")).unwrap().starts_with(b"\x89PNG"));
    assert_eq!(std::fs::read_dir(out.path()).unwrap().count(), 2, "nothing else is left behind");
}

/// Motion by laws of time is swept, drawn and taught through time; so are several drivers on
/// request.
#[test]
fn laws_of_time_go_on_with_the_time() {
    let out = tempfile::tempdir().unwrap();
    let plate = "templates/plate-by-law.json";
    let told = |args: &[&str]| text(&hodograph().args(args).assert().success().get_output().stdout);
    let rows = told(&["sweep", plate, "--steps", "4", "--find", "v_M"]);
    let row = |k: usize| {
        rows.lines()
            .nth(k)
            .unwrap()
            .split(',')
            .map(|v| v.parse::<f64>().unwrap())
            .collect::<Vec<_>>()
    };
    assert!(rows.starts_with("t [s],v_M.x"), "{rows}");
    // At 2 s: ω = 2 rad/s about O, M 16 cm along its groove, which is 10 cm from O and in which it
    // moves at 16 cm/s.
    let (omega, vr) = (2.0_f64, 0.16);
    let meant = (omega * 0.16).hypot(omega * 0.1 + vr);
    assert_eq!((row(1)[0], row(1)[3], row(5)[0]), (0.0, 0.0, 2.0));
    assert!((row(5)[3] - meant).abs() < 1e-12, "{} against {meant}", row(5)[3]);
    assert_eq!(
        rows,
        told(&[
            "sweep", plate, "--over", "t", "--from", "0", "--to", "2 s", "--steps", "4", "--find",
            "v_M"
        ])
    );
    // The driver alone, at the angular velocity of the instant, is requested by its name.
    assert!(told(&["sweep", plate, "--over", "phi_2", "--steps", "4"]).starts_with("phi_2 [rad]"));
    let written = |args: &[&str], file: &str| {
        let path = out.path().join(file);
        hodograph().args(args).arg("-o").arg(&path).assert().success();
        String::from_utf8_lossy(&std::fs::read(path).unwrap()).into_owned()
    };
    assert!(written(&["curves", plate], "curves.svg").contains("Diagrams against t."));
    assert!(written(&["path", plate, "--point", "M"], "path.svg").contains("position-driver-1"));
    assert!(written(&["animate", plate, "--frames", "3"], "turn.svg").contains("<svg"));
    assert!(written(&["lesson", plate], "law.html").len() > 10_000);
    assert!(
        written(
            &["lesson", "templates/excavator.json", "--over", "t", "--positions", "8"],
            "all.html"
        )
        .len()
            > 10_000
    );
    let stopped = hodograph()
        .args(["sweep", "templates/five-bar.json", "--over", "t", "--steps", "2"])
        .assert()
        .success();
    let said = text(&stopped.get_output().stderr)
        .split_whitespace()
        .filter(|w| *w != "│")
        .collect::<Vec<_>>()
        .join(" ");
    assert!(
        said.contains("t = 0.0209134 s: there link 2 (BC) and link 3 (CD) lie in line"),
        "{said}"
    );
    let long = hodograph().args(["sweep", plate, "--over", "t", "--to", "1e9"]).assert().code(2);
    assert!(text(&long.get_output().stderr).contains("take a shorter time"));
    let length =
        hodograph().args(["curves", plate, "--to", "3 mm", "-o", "x.svg"]).assert().code(2);
    assert!(text(&length.get_output().stderr).contains("a time is wanted"));
}

/// All frames have one size and are as many as requested; the motion returns the same way where the
/// driver does not turn fully.
#[test]
fn a_motion_is_a_gif_an_svg_or_numbered_pictures() {
    let out = tempfile::tempdir().unwrap();
    let run = |scene: &str, file: &str, more: &[&str]| {
        let path = out.path().join(file);
        let run = hodograph()
            .args(["animate", scene, "--frames", "4", "--dpi", "40", "-o"])
            .arg(&path)
            .args(more)
            .assert()
            .success();
        (path, text(&run.get_output().stdout))
    };
    let (gif, said) = run("templates/crank-rocker.json", "turn.gif", &[]);
    assert!(
        std::fs::read(gif).unwrap().starts_with(b"GIF89a") && said.trim_end().ends_with("turn.gif")
    );
    let (svg, _) = run(
        "templates/shaper.json",
        "turn.svg",
        &["--lang", "zh", "--style", "dark", "--seconds", "2"],
    );
    let svg = std::fs::read_to_string(svg).unwrap();
    assert!(
        roxmltree::Document::parse(&svg).is_ok() && svg.contains("dur=\"2s\""),
        "{}",
        &svg[..500]
    );
    let (_, said) = run("templates/toggle-press.json", "film/turn.png", &[]);
    let pictures: Vec<Vec<u8>> =
        said.lines().map(|name| std::fs::read(name.trim()).unwrap()).collect();
    // Width and height are at fixed places of a PNG.
    let size = |p: &Vec<u8>| [16, 20].map(|k| u32::from_be_bytes(p[k..k + 4].try_into().unwrap()));
    assert_eq!(pictures.len(), 4);
    assert!(
        pictures
            .iter()
            .all(|p| size(p) == size(&pictures[0]) && size(p).iter().all(|side| side % 2 == 0))
    );
    assert!(out.path().join("film/turn-004.png").exists());
    let bad =
        hodograph().args(["animate", "templates/shaper.json", "-o", "turn.mp4"]).assert().code(2);
    assert!(text(&bad.get_output().stderr).contains("ends in none of .gif, .svg, .png"));
}

/// There is a plate for each group and level, and no vector is missing from them.
#[test]
fn plates_show_what_each_group_adds() {
    let out = tempfile::tempdir().unwrap();
    let arguments =
        ["draw", "templates/excavator.json", "--figure", "plates", "--format", "svg", "-o"];
    hodograph().args(arguments).arg(out.path()).assert().success();
    let read = |name: String| std::fs::read_to_string(out.path().join(name)).unwrap();
    let ids = |svg: &str| -> Vec<String> {
        let page = roxmltree::Document::parse(svg).unwrap();
        let edges = page.descendants().filter(|n| {
            n.attribute("class").is_some_and(|c| c.contains(" edge ") && !c.contains("label"))
        });
        edges
            .filter_map(|n| n.attribute("id"))
            .filter(|id| !id.contains("inset") && !id.ends_with("leader"))
            .map(str::to_owned)
            .collect()
    };
    for kind in ["velocity", "acceleration"] {
        let plates: Vec<String> =
            (1..=4).map(|k| read(format!("excavator-{kind}-{k}.svg"))).collect();
        assert!(
            plates.iter().all(|p| p.contains("#969696") || p == &plates[0]),
            "{kind}: known vectors are grey"
        );
        let shown: Vec<String> = plates.iter().flat_map(|p| ids(p)).collect();
        hodograph()
            .args(["draw", "templates/excavator.json", "--figure", kind, "-o"])
            .arg(out.path().join("whole.svg"))
            .assert()
            .success();
        let missing: Vec<String> =
            ids(&read("whole.svg".into())).into_iter().filter(|id| !shown.contains(id)).collect();
        assert!(missing.is_empty() && !shown.is_empty(), "{kind}: {missing:?}");
    }
    assert!(!out.path().join("excavator-velocity-5.svg").exists());
}

#[test]
fn pdf_holds_one_figure_or_many() {
    let out = tempfile::tempdir().unwrap();
    for arguments in
        [vec![], vec!["--figure", "mechanism,velocity"], vec!["--style", "dark", "--steps"]]
    {
        let file = out.path().join(format!("{}.pdf", arguments.len()));
        hodograph()
            .args(["draw", "templates/crank-rocker.json", "-o"])
            .arg(&file)
            .args(&arguments)
            .assert()
            .success();
        assert!(std::fs::read(file).unwrap().starts_with(b"%PDF-1.7"));
    }
}

#[test]
fn a_font_of_ones_own_sets_the_figures() {
    let out = tempfile::tempdir().unwrap();
    let draw = |name: &str, fonts: &[&str]| {
        let file = out.path().join(name);
        let fonts = fonts.iter().flat_map(|f| ["--font", f]);
        let run = hodograph()
            .args(["draw", "templates/crank-rocker.json", "--lang", "zh", "-o"])
            .arg(&file)
            .args(fonts)
            .assert()
            .success();
        (std::fs::read(file).unwrap(), text(&run.get_output().stderr))
    };
    let (usual, _) = draw("usual.svg", &[]);
    let (italic, said) = draw("italic.svg", &["crates/paper/fonts/tinos-italic.ttf"]);
    // The same letters from a file: the same widths and places, under other names.
    assert!(!said.contains("font"), "{said}");
    assert_eq!(text(&usual).matches("<use").count(), text(&italic).matches("<use").count());
    assert!(text(&italic).contains("id=\"gp") && !text(&usual).contains("id=\"gp"));
    // A font that lacks letters leaves them to the bundled ones, with a note.
    let (signs, said) = draw("signs.svg", &["crates/paper/fonts/song-gb1-cff.otf"]);
    assert!(text(&signs).contains("id=\"go"), "Chinese words come from it");
    assert!(text(&signs).contains("id=\"gi"), "slanted letters from the bundled italic");
    assert!(!said.contains("error"), "{said}");
    let (pdf, _) = draw(
        "own.pdf",
        &["crates/paper/fonts/tinos-italic.ttf", "crates/paper/fonts/tinos-normal.ttf"],
    );
    assert!(pdf.starts_with(b"%PDF-1.7"));
    // Paths of fonts are relative to the style file; every command that draws accepts it, or the
    // font alone.
    std::fs::create_dir(out.path().join("type")).unwrap();
    for (from, to) in
        [("tinos-italic.ttf", "type/slanted.ttf"), ("tinos-normal.ttf", "type/upright.ttf")]
    {
        std::fs::copy(
            Path::new(env!("CARGO_MANIFEST_DIR")).join("crates/paper/fonts").join(from),
            out.path().join(to),
        )
        .unwrap();
    }
    let style = out.path().join("book.json");
    std::fs::write(
        &style,
        r#"{ "base": "print", "fonts": ["type/upright.ttf", "type/slanted.ttf"] }"#,
    )
    .unwrap();
    let commands: [(&[&str], &str); 7] = [
        (&["draw"], "svg"),
        (&["curves"], "svg"),
        (&["path", "--point", "E"], "svg"),
        (&["accuracy", "--patience", "1"], "svg"),
        (&["worksheet"], "html"),
        (&["lesson", "--positions", "8"], "html"),
        (&["lesson", "--reveal"], "html"),
    ];
    for (command, ending) in commands {
        let file = out.path().join(format!("figure.{ending}"));
        let run = |look: [&str; 2]| {
            let scene = ["templates/crank-rocker.json", "--lang", "zh"];
            let run = hodograph()
                .args(command)
                .args(scene)
                .args(look)
                .arg("-o")
                .arg(&file)
                .assert()
                .success();
            (text(&std::fs::read(&file).unwrap()), text(&run.get_output().stderr))
        };
        // The measurement of accuracy has no quantities.
        let letters = command[0] != "accuracy";
        let (drawn, _) = run(["--style", style.to_str().unwrap()]);
        assert!(
            drawn.contains("id=\"go")
                && drawn.contains("id=\"gp") == letters
                && !drawn.contains("id=\"gi"),
            "{command:?}"
        );
        let (drawn, said) = run(["--font", "crates/paper/fonts/tinos-italic.ttf"]);
        assert!(
            drawn.contains("id=\"gp") == letters && !said.contains("font"),
            "{command:?}: {said}"
        );
    }
    std::fs::write(out.path().join("lost.json"), r#"{ "fonts": ["lost.ttf"] }"#).unwrap();
    let run = hodograph()
        .args(["draw", "templates/crank-rocker.json", "--style"])
        .arg(out.path().join("lost.json"))
        .assert()
        .code(2);
    assert!(text(&run.get_output().stderr).contains("lost.ttf"));
}

#[test]
fn what_is_no_font_is_reported() {
    let out = tempfile::tempdir().unwrap();
    let italic = "crates/paper/fonts/tinos-italic.ttf";
    for fonts in [vec!["templates/shaper.json"], vec!["nosuch.ttf"], vec![italic, italic]] {
        let fonts = fonts.iter().flat_map(|f| ["--font", f]);
        let run = hodograph()
            .args(["draw", "templates/shaper.json", "-o"])
            .arg(out.path())
            .args(fonts)
            .assert()
            .code(2);
        assert!(text(&run.get_output().stderr).contains("font"));
    }
    assert_eq!(std::fs::read_dir(out.path()).unwrap().count(), 0);
}

#[test]
fn a_worksheet_in_each_format() {
    let out = tempfile::tempdir().unwrap();
    for (ending, begins) in [
        ("pdf", "%PDF-1.7"),
        ("html", "<!DOCTYPE html>"),
        ("md", "# Shaper"),
        ("typ", "#set document"),
    ] {
        let file = out.path().join(format!("sheet.{ending}"));
        let run = hodograph()
            .args(["worksheet", "templates/shaper.json", "-o"])
            .arg(&file)
            .assert()
            .success();
        assert!(std::fs::read(&file).unwrap().starts_with(begins.as_bytes()), "{ending}");
        // Every written file is named, each on its line.
        for line in text(&run.get_output().stdout).lines() {
            assert!(Path::new(line).exists(), "{line}");
        }
    }
    // Markdown and Typst share their three drawings.
    assert_eq!(std::fs::read_dir(out.path()).unwrap().count(), 4 + 3);
}

#[test]
fn a_worksheet_that_cannot_be_is_reported() {
    let out = tempfile::tempdir().unwrap();
    for name in ["sheet", "sheet.docx", "sheet.PDF.", "-"] {
        let run = hodograph()
            .args(["worksheet", "templates/shaper.json", "-o"])
            .arg(out.path().join(name))
            .assert()
            .code(2);
        assert!(text(&run.get_output().stderr).contains(".typ"), "{name}");
    }
    hodograph()
        .args(["worksheet", "tests/bad/no-driver.json", "-o"])
        .arg(out.path().join("sheet.pdf"))
        .assert()
        .code(2);
    hodograph()
        .args(["worksheet", "templates/shaper.json", "--problem-only", "--solution", "-o", "x.pdf"])
        .assert()
        .code(2);
    assert_eq!(std::fs::read_dir(out.path()).unwrap().count(), 0);
}

/// A path gets a file of its own; a point without path is reported, and nothing is written.
#[test]
fn a_path_is_drawn_or_refused() {
    let folder = tempfile::tempdir().unwrap();
    hodograph()
        .current_dir(&folder)
        .args(["new", "crank-rocker", "-o", "scene.json"])
        .assert()
        .success();
    hodograph()
        .current_dir(&folder)
        .args(["path", "scene.json", "--point", "E", "--poses", "4"])
        .assert()
        .success();
    let drawn = std::fs::read_to_string(folder.path().join("scene-path.svg")).unwrap();
    assert!(
        drawn.contains("id=\"caption-vel-hodograph-E\"")
            && drawn.contains("id=\"mechanism-path-E-4\""),
        "{}",
        &drawn[..2000]
    );
    for (args, words) in [
        (&["--point", "F"][..], "no point `F`"),
        (&["--point", "A"], "point A stands still"),
        (&["--point", "E", "--over", "phi_9"], "no driver `phi_9`"),
    ] {
        let run = hodograph()
            .current_dir(&folder)
            .args(["path", "scene.json", "-o", "bad.svg"])
            .args(args)
            .assert()
            .code(2);
        let said = text(&run.get_output().stderr);
        assert!(said.contains(words), "no {words:?} in\n{said}");
    }
    hodograph()
        .current_dir(&folder)
        .args(["path", "scene.json", "--point", "E", "-o", "bad.txt"])
        .assert()
        .code(2);
    assert!(!folder.path().join("bad.svg").exists() && !folder.path().join("bad.txt").exists());
}

/// `--poses` gives a table of positions for the sheet, an overlay for the mechanism; each has its
/// own file.
#[test]
fn positions_make_a_sheet_or_lie_over_one_another() {
    let folder = tempfile::tempdir().unwrap();
    let run = |args: &[&str]| {
        let scene = templates_path("slider-crank");
        hodograph().current_dir(&folder).arg("draw").arg(scene).args(args).assert().success();
    };
    run(&["-o", "out", "--format", "svg", "--poses", "4", "--figure", "sheet,mechanism"]);
    let read = |name: &str| std::fs::read_to_string(folder.path().join("out").join(name)).unwrap();
    // A table higher than a page takes several pages.
    let (sheet, over) = (
        read("slider-crank-poses-1.svg") + &read("slider-crank-poses-2.svg"),
        read("slider-crank-mechanism.svg"),
    );
    for k in 1..=4 {
        assert!(sheet.contains(&format!("id=\"pose-{k}-vel-rel-C-B\"")), "pose {k}");
    }
    assert!(over.contains("id=\"mechanism-pose-3-pin\"") && !over.contains("vel-abs"));
    run(&["-o", "vectors.svg", "--vectors", "velocity", "--poses", "4"]);
    assert!(folder.path().join("vectors.svg").exists());
}

/// A wheel that consists of its centre alone has no angle to show, and a train without given places
/// has none at all.
#[test]
fn gears_and_wheels_have_line_diagrams() {
    let out = tempfile::tempdir().unwrap();
    for name in ["hibbeler-16-27", "shigley-13-6", "involute-tooth-contact-gears", "spool-and-rope"]
    {
        let text = std::fs::read_to_string(format!(
            "{}/tests/cases/{name}.json",
            env!("CARGO_MANIFEST_DIR")
        ))
        .unwrap();
        let case: serde_json::Value = serde_json::from_str(&text).unwrap();
        let mut run = hodograph();
        run.args(["curves", "-", "--steps", "2", "-o"]).arg(out.path().join(format!("{name}.svg")));
        run.write_stdin(case["scene"].to_string()).assert().success();
    }
}

/// A drawing without a figure is refused: the requested figure has no step.
#[test]
fn no_figure_is_reported() {
    let out = tempfile::tempdir().unwrap();
    for target in ["dir/", "steps.pdf"] {
        let target = out.path().join(target);
        let asked = ["draw", "tests/cli/no-steps.json", "--steps", "-o"];
        let run = hodograph().args(asked).arg(target).assert().code(2);
        assert!(
            text(&run.get_output().stderr).contains("no-figure"),
            "{}",
            text(&run.get_output().stderr)
        );
        assert_eq!(std::fs::read_dir(out.path()).unwrap().count(), 0);
    }
}
