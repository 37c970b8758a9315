//! Results on standard output, and formats: `-o -`, `/dev/stdout`, `--format`.

use super::{hodograph, text};
use std::fs;
use std::path::Path;

/// Commands that write one result, and the ending of its usual format on standard output.
const ONE: [(&str, &str); 14] = [
    ("draw templates/shaper.json", "svg"),
    ("draw templates/shaper.json --figure velocity", "svg"),
    ("draw templates/shaper.json --steps", "pdf"),
    ("draw templates/synthesis/time-ratio.json --figure sheet", "pdf"),
    ("lesson templates/crank-rocker.json --positions 8", "html"),
    ("lesson templates/crank-rocker.json --reveal", "html"),
    ("worksheet templates/crank-rocker.json", "html"),
    ("worksheet templates/crank-rocker.json --problem-only", "pdf"),
    ("curves templates/crank-rocker.json --steps 36", "svg"),
    ("path templates/crank-rocker.json --point E", "svg"),
    ("animate templates/crank-rocker.json --frames 4", "svg"),
    ("mobility templates/crank-rocker.json", "svg"),
    ("sweep templates/crank-rocker.json --find v_C --steps 12", "csv"),
    ("new crank-rocker", "json"),
];

/// Options that request a format on standard output where it is not the default.
fn asking(command: &str, ending: &str) -> Vec<String> {
    let usual = ending != "pdf";
    let words = command.split(' ').map(str::to_owned);
    let format = if usual { Vec::new() } else { vec!["--format".to_owned(), ending.to_owned()] };
    words.chain(format).collect()
}

#[test]
fn one_result_goes_to_standard_output_alone() {
    let folder = tempfile::tempdir().unwrap();
    for (command, ending) in ONE {
        let file = folder.path().join(format!("file.{ending}"));
        hodograph().args(command.split(' ')).arg("-o").arg(&file).assert().success();
        let wanted = fs::read(&file).unwrap();
        for output in ["-", "/dev/stdout"] {
            if output != "-" && !cfg!(target_os = "linux") {
                continue;
            }
            let run =
                hodograph().args(asking(command, ending)).args(["-o", output]).assert().success();
            let got = &run.get_output().stdout;
            assert!(
                *got == wanted,
                "{command} -o {output}: {} bytes, not {}: {}",
                got.len(),
                wanted.len(),
                text(&got[..got.len().min(200)])
            );
        }
    }
    assert!(
        !Path::new(env!("CARGO_MANIFEST_DIR")).join("-").exists(),
        "a folder or a file of that name"
    );
    // Tables of the other commands, a cam's profile, one inversion, one design.
    for (command, begins) in [
        (
            "batch templates/crank-rocker.json --vary l_BC=200..300:3 --find v_C -o -",
            "mechanism,l_BC",
        ),
        (
            "batch templates/crank-rocker.json --vary l_BC=200..300:3 --find v_C -o - --format npy",
            "\u{fffd}NUMPY",
        ),
        ("sweep templates/crank-rocker.json --find v_C --steps 12 --format json", "{\n  \"title\""),
        ("cam templates/cam-offset-roller.json --profile -", "phi [deg],"),
        ("inversions templates/crank-rocker.json --pick 1 -o -", "{"),
        ("synth templates/synthesis/time-ratio.json -o -", "{"),
        ("accuracy templates/crank-rocker.json --patience 1 -o -", "<svg"),
    ] {
        let run = hodograph().args(command.split(' ')).assert().success();
        assert!(
            text(&run.get_output().stdout).starts_with(begins),
            "{command}: {}",
            text(&run.get_output().stdout)
        );
    }
    // Standard output may be a file, and a reader may close before the end.
    let file = folder.path().join("redirected.svg");
    let to = fs::File::create(&file).unwrap();
    let mut run = std::process::Command::new(env!("CARGO_BIN_EXE_hodograph"));
    let run = run
        .args(["draw", "templates/shaper.json", "-o", "-"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .stdout(to);
    assert!(
        run.status().unwrap().success()
            && fs::read_to_string(&file).unwrap().trim_end().ends_with("</svg>")
    );
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let mut run = std::process::Command::new(env!("CARGO_BIN_EXE_hodograph"));
    let run = run
        .args(["draw", "templates/shaper.json", "-o", "-"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .stdout(writer);
    assert!(run.status().unwrap().success());
}

#[test]
fn several_results_for_one_stream_are_refused_with_advice() {
    let folder = tempfile::tempdir().unwrap();
    let kept = fs::canonicalize(env!("CARGO_MANIFEST_DIR")).unwrap().join("templates");
    for (command, advice) in [
        ("draw T/shaper.json -o - --format svg,png", "ask for one format: --format svg"),
        ("draw T/shaper.json -o - --figure velocity,acceleration", "--format pdf"),
        ("draw T/shaper.json -o - --steps", "--format pdf"),
        ("worksheet T/shaper.json -o - --format md", "--format html"),
        ("animate T/shaper.json --frames 4 -o - --format png", "--format gif"),
        ("inversions T/crank-rocker.json -o -", "--pick"),
        ("cam T/cam-offset-roller.json -o -", "--profile -"),
        ("accuracy T/crank-rocker.json --patience 1 -o - --json", "leave --json out"),
        ("mobility T/crank-rocker.json -o - --json", "leave --json out"),
        ("curves T/crank-rocker.json -o - --format svg,pdf", "ask for one format"),
        // Ending and option contradict each other; a name has no format.
        ("draw T/shaper.json -o sheet.svg --format png", "-o sheet --format png"),
        ("curves T/crank-rocker.json -o c.pdf --format svg", "-o c --format svg"),
        ("curves T/crank-rocker.json -o c.txt", "--format svg"),
        ("sweep T/crank-rocker.json -o rows --format csv,npy", "ask for one format: --format csv"),
        ("worksheet T/shaper.json -o sheet", "--format pdf"),
    ] {
        let command = command.replace("T/", &format!("{}/", kept.display()));
        let run = hodograph().current_dir(folder.path()).args(command.split(' ')).assert().code(2);
        let said = text(&run.get_output().stderr);
        assert!(said.contains(advice), "{command}: {said}");
        assert!(run.get_output().stdout.is_empty(), "{command}");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "{command}");
    }
}

/// A list with commas and a repeated option are equivalent everywhere; without an ending each
/// format gets its own.
#[test]
fn formats_are_one_list() {
    let names = |command: &str| {
        let folder = tempfile::tempdir().unwrap();
        let kept = fs::canonicalize(env!("CARGO_MANIFEST_DIR")).unwrap().join("templates");
        let command = command.replace("T/", &format!("{}/", kept.display()));
        hodograph().current_dir(folder.path()).args(command.split(' ')).assert().success();
        let mut names: Vec<String> = fs::read_dir(folder.path())
            .unwrap()
            .map(|f| f.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names.join(" ")
    };
    for (command, a, b, wanted) in [
        (
            "draw T/crank-rocker.json --figure mechanism",
            "svg",
            "pdf",
            "crank-rocker-mechanism.pdf crank-rocker-mechanism.svg",
        ),
        ("curves T/crank-rocker.json --steps 36 -o c", "svg", "pdf", "c.pdf c.svg"),
        (
            "path T/crank-rocker.json --point E",
            "svg",
            "png",
            "crank-rocker-path.png crank-rocker-path.svg",
        ),
        ("path T/crank-rocker.json --point E -o p", "svg", "pdf", "p.pdf p.svg"),
        ("worksheet T/crank-rocker.json -o w", "pdf", "html", "w.html w.pdf"),
        ("animate T/crank-rocker.json --frames 2 -o m", "gif", "png", "m-001.png m-002.png m.gif"),
        ("mobility T/crank-rocker.json -o g", "svg", "pdf", "g.pdf g.svg"),
    ] {
        assert_eq!(names(&format!("{command} --format {a},{b}")), wanted, "{command}");
        assert_eq!(
            names(&format!("{command} --format {a} --format {b} --format {a}")),
            wanted,
            "{command}"
        );
    }
    // An ending with the same format; a single format keeps the name itself; a folder takes the
    // default formats.
    assert_eq!(names("draw T/crank-rocker.json -o sheet.svg --format svg"), "sheet.svg");
    assert_eq!(
        names("sweep T/crank-rocker.json --find v_C --steps 3 -o rows.txt --format csv"),
        "rows.txt"
    );
    assert_eq!(names("draw T/crank-rocker.json"), "crank-rocker.png crank-rocker.svg");
}

/// A page format gives pages of its size, lettered if there are several; a wrong one is refused.
#[test]
fn pages_have_the_requested_format() {
    let folder = tempfile::tempdir().unwrap();
    let run = |scene: &str, page: &str| {
        hodograph()
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .args(["draw", scene, "--format", "svg", "--page", page])
            .args(["-o", folder.path().join(page.replace(':', "-")).to_str().unwrap()])
            .assert()
    };
    let view = |file: &str| {
        let svg = fs::read_to_string(folder.path().join(file)).unwrap();
        svg.split("viewBox=\"").nth(1).unwrap().split('"').next().unwrap().to_owned()
    };
    run("templates/crank-rocker.json", "a4").success();
    assert_eq!(view("a4/crank-rocker.svg"), "0 0 210 297");
    run("templates/excavator.json", "16:9").success();
    for page in ["a", "b"] {
        assert_eq!(view(&format!("16-9/excavator-{page}.svg")), "0 0 338 190");
    }
    for (page, message) in [("a44", "no page format"), ("80mmx1mm", "a side of 1mm")] {
        let refused = run("templates/crank-rocker.json", page).code(2);
        assert!(text(&refused.get_output().stderr).contains(message), "{page}");
    }
}

/// Slides of equal size in a given width, the fragment for slides in a width; too narrow ones are
/// refused.
#[test]
fn steps_and_fragments_have_a_width() {
    let folder = tempfile::tempdir().unwrap();
    let run = |args: &str| {
        hodograph()
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .args(args.split(' '))
            .args(["-o", folder.path().to_str().unwrap()])
            .assert()
    };
    // Side by side, and in a narrow column stacked: higher than wide.
    for (width, narrow) in [(200, false), (80, true)] {
        run(&format!("draw templates/crank-rocker.json --steps --format svg --width {width}mm"))
            .success();
        let sizes: Vec<String> = fs::read_dir(folder.path())
            .unwrap()
            .map(|f| {
                fs::read_to_string(f.unwrap().path())
                    .unwrap()
                    .split("viewBox=\"")
                    .nth(1)
                    .unwrap()
                    .split('"')
                    .next()
                    .unwrap()
                    .to_owned()
            })
            .collect();
        assert!(
            sizes.len() > 5
                && sizes.iter().all(|s| *s == sizes[0] && s.starts_with(&format!("0 0 {width} "))),
            "{sizes:?}"
        );
        let height: f64 = sizes[0].rsplit(' ').next().unwrap().parse().unwrap();
        assert_eq!(height > f64::from(width), narrow, "{sizes:?}");
    }
    run("draw templates/crank-rocker.json --steps --format svg --width 21mm").code(2);
    run("draw templates/synthesis/time-ratio.json --steps --format svg --width 200mm").success();
    let reveal = |width: &str| {
        hodograph()
            .args([
                "lesson",
                "templates/crank-rocker.json",
                "--reveal",
                "--width",
                width,
                "-o",
                "-",
            ])
            .assert()
    };
    let fragment = text(&reveal("240mm").success().get_output().stdout);
    assert!(
        fragment.contains("style=\"width:240mm;max-width:100%") && fragment.contains("fragment"),
        "{}",
        &fragment[..400]
    );
    let view: Vec<f64> = fragment
        .split("viewBox=\"")
        .nth(1)
        .unwrap()
        .split('"')
        .next()
        .unwrap()
        .split(' ')
        .map(|n| n.parse().unwrap())
        .collect();
    assert!((view[2] - 240.0).abs() < 1e-9, "{view:?}");
    let refused = reveal("25mm").code(2);
    assert!(text(&refused.get_output().stderr).contains("paper-too-small"));
    hodograph()
        .args(["lesson", "templates/crank-rocker.json", "--width", "240mm", "-o", "-"])
        .assert()
        .code(2);
}
