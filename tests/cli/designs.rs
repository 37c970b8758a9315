//! Synthesis files in the commands for scenes: figures of any candidate, worksheets, lessons.

use super::hodograph;
use hodograph::synthesis::templates;

/// A folder with the template of each kind in a file.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for name in templates::names() {
        std::fs::write(folder.path().join(format!("{name}.json")), templates::get(name).unwrap())
            .unwrap();
    }
    folder
}

#[test]
fn worksheets_and_lessons_are_written_for_every_kind_in_both_languages() {
    let folder = folder();
    for name in templates::names() {
        for lang in ["en", "zh"] {
            let task = format!("{name}.json");
            for ending in ["pdf", "html", "md", "typ"] {
                let out = format!("{name}-{lang}.{ending}");
                let run = hodograph()
                    .current_dir(folder.path())
                    .args(["worksheet", &task, "--lang", lang, "-o", &out])
                    .assert()
                    .success();
                assert_eq!(
                    String::from_utf8_lossy(&run.get_output().stderr).matches("error").count(),
                    0
                );
                assert!(std::fs::metadata(folder.path().join(&out)).unwrap().len() > 1000, "{out}");
            }
            let out = format!("{name}-{lang}-lesson.html");
            hodograph()
                .current_dir(folder.path())
                .args(["lesson", &task, "--lang", lang, "-o", &out])
                .assert()
                .success();
            let page = std::fs::read_to_string(folder.path().join(&out)).unwrap();
            assert!(page.starts_with("<!DOCTYPE html>") && !page.contains("{{"), "{out}");
            assert!(
                page.contains(&format!("<html lang=\"{lang}\">")) && !page.contains("src=\"http"),
                "{out}"
            );
        }
    }
}

#[test]
fn any_candidate_is_drawn_and_one_that_is_not_there_is_reported() {
    let folder = folder();
    let draw = |pick: &str, out: &str| {
        hodograph()
            .current_dir(folder.path())
            .args(["draw", "cognates.json", "--pick", pick, "--format", "svg", "-o", out])
            .assert()
    };
    draw("1", "one/").success();
    draw("3", "three/").success();
    let read =
        |of: &str| std::fs::read(folder.path().join(of).join("cognates-positions.svg")).unwrap();
    assert_ne!(read("one"), read("three"));
    for command in
        [&["draw", "-o", "x/"][..], &["worksheet", "-o", "x.html"], &["lesson", "-o", "x.html"]]
    {
        let args = [&command[..1], &["cognates.json", "--pick", "9"], &command[1..]].concat();
        let run = hodograph().current_dir(folder.path()).args(&args).assert().code(2);
        assert!(
            String::from_utf8_lossy(&run.get_output().stderr).contains("there are 3"),
            "{args:?}"
        );
        // A scene has no candidates.
        let scene = super::templates_path("crank-rocker");
        let args = [&command[..1], &[scene.as_str(), "--pick", "1"], &command[1..]].concat();
        let run = hodograph().current_dir(folder.path()).args(&args).assert().code(2);
        assert!(
            String::from_utf8_lossy(&run.get_output().stderr).contains("leave --pick out"),
            "{args:?}"
        );
    }
    for refused in [
        &["worksheet", "body.json", "--find-the-mistake", "-o", "x.html"][..],
        &["lesson", "body.json", "--reveal", "-o", "x.html"],
    ] {
        hodograph().current_dir(folder.path()).args(refused).assert().code(2);
    }
    assert!(!folder.path().join("x.html").exists() && !folder.path().join("x").exists());
}

/// Ranges of the lengths of a four-bar, and the refusal of other mechanisms.
#[test]
fn ranges_of_lengths_are_reported() {
    let run = hodograph()
        .args(["limits", &super::templates_path("crank-rocker"), "--ranges"])
        .assert()
        .success();
    let said = String::from_utf8_lossy(&run.get_output().stdout).into_owned();
    assert!(said.contains("200.0 mm .. 400.0 mm  crank-rocker; change point at the end"), "{said}");
    let run = hodograph()
        .args(["limits", &super::templates_path("crank-rocker"), "--ranges", "--json"])
        .assert()
        .success();
    let told: serde_json::Value = serde_json::from_slice(&run.get_output().stdout).unwrap();
    assert_eq!(told[3]["ranges"][0]["type"], "double crank (drag link)");
    hodograph()
        .args(["limits", &super::templates_path("slider-crank"), "--ranges"])
        .assert()
        .code(2);
}

/// A pipe gives its bytes once: a command that examines whether they are a scene or a synthesis
/// does not lose them.
#[test]
fn what_comes_through_a_pipe_is_read_once() {
    let folder = folder();
    let text = |name: &str| hodograph().args(["new", name]).output().unwrap().stdout;
    let pipes = if cfg!(unix) { &["-", "/dev/stdin"][..] } else { &["-"] };
    for name in ["crank-rocker", "function"] {
        for command in [["draw", "x/"], ["worksheet", "x.html"], ["lesson", "x.html"]] {
            for pipe in pipes {
                let mut run = hodograph();
                run.current_dir(folder.path()).args([command[0], pipe, "-o", command[1]]);
                run.write_stdin(text(name)).assert().success();
            }
        }
    }
}
