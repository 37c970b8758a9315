//! The language of the program: that of `--lang`, else the scene's, else English; for the help also
//! that of the system.

use super::wide::every;
use super::{hodograph, text};

/// Returns the text on standard error for a scene, and the printed text.
fn told(arguments: &[&str], scene: &str) -> (String, String) {
    let run = hodograph().args(arguments).write_stdin(scene).assert();
    (text(&run.get_output().stderr), text(&run.get_output().stdout))
}

fn is_chinese(text: &str) -> bool {
    text.chars().any(|c| ('\u{4e00}'..='\u{9fff}').contains(&c))
}

/// A text without the lines that quote the scene.
fn own_words(text: &str) -> String {
    text.lines()
        .filter(|l| !l.contains('│') || l.trim_start().starts_with('│'))
        .collect::<Vec<_>>()
        .join("\n")
}

/// Returns a line with two neighbouring lower-case English words, if any; commands do not count as
/// words.
fn english(text: &str) -> Option<&str> {
    let small = |w: &str| w.len() > 2 && w.chars().all(|c| c.is_ascii_lowercase());
    text.lines()
        .filter(|l| !l.contains("hodograph "))
        .find(|l| l.split(' ').collect::<Vec<_>>().windows(2).any(|w| w.iter().all(|w| small(w))))
}

#[test]
fn a_fault_is_reported_in_the_language_of_the_command_line_or_of_the_scene() {
    let scene = |language: &str| {
        format!("{{{language}\"links\": {{\"1\": [\"A\", \"B\"]}}, \"gruond\": \"1\"}}")
    };
    for (arguments, language, chinese) in [
        (&["solve", "-"][..], "", false),
        (&["solve", "-"], "\"language\": \"zh\", ", true),
        (&["solve", "-", "--lang", "en"], "\"language\": \"zh\", ", false),
        (&["solve", "-", "--lang=zh"], "", true),
        (&["--lang", "zh", "solve", "-"], "\"language\": \"en\", ", true),
        (&["solve", "-"], "\"language\": \"xx\", ", false),
    ] {
        let (said, _) = told(arguments, &scene(language));
        assert_eq!(is_chinese(&said), chinese, "{arguments:?} {language}:\n{said}");
        assert!(said.contains("gruond"));
    }
    // A file that cannot be parsed has no language.
    assert!(!is_chinese(&told(&["solve", "-"], "{\"language\": \"zh\", ").0));
    assert!(is_chinese(&told(&["solve", "-", "--lang", "zh"], "{").0));
}

#[test]
fn every_command_that_takes_a_scene_speaks_chinese() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("x.gif");
    let out = out.to_str().unwrap();
    for command in [
        "draw",
        "lesson",
        "solve",
        "plan",
        "worksheet",
        "accuracy",
        "sweep",
        "batch",
        "curves",
        "path",
        "limits",
        "centres",
        "curvature",
        "inversions",
    ] {
        // A missing scene; a scene that cannot be assembled; an invalid ending.
        let more: &[&str] = match command {
            "worksheet" => &["-o", "x.md"],
            "batch" => &["--vary", "l=1..2:2", "-o", "x.csv"],
            "curves" => &["-o", "x.svg"],
            "path" => &["--point", "C"],
            _ => &[],
        };
        for scene in ["no-such-file.json", "tests/bad/several-faults.json"] {
            let run =
                hodograph().args([command, "--lang", "zh", scene]).args(more).assert().code(2);
            let said = own_words(&text(&run.get_output().stderr));
            assert!(
                is_chinese(&said) && english(&said).is_none(),
                "{command} {scene}: {:?} in\n{said}",
                english(&said)
            );
        }
        if ["draw", "lesson", "worksheet", "sweep", "batch", "curves", "path"].contains(&command) {
            let more: Vec<&str> =
                more.iter().map(|m| if m.starts_with("x.") { out } else { *m }).collect();
            let output: &[&str] = if more.contains(&out) { &[] } else { &["-o", out] };
            let run = hodograph()
                .args([command, "--lang", "zh", "templates/crank-rocker.json"])
                .args(more)
                .args(output)
                .assert();
            let said = own_words(&text(&run.get_output().stderr));
            assert!(
                is_chinese(&said) && english(&said).is_none(),
                "{command} -o x.gif: {:?} in\n{said}",
                english(&said)
            );
        }
    }
}

#[test]
fn notes_and_tables_are_in_the_language_too() {
    let (said, table) = told(
        &[
            "sweep",
            "templates/crank-rocker.json",
            "--set",
            "l_AB=260",
            "--steps",
            "9",
            "--lang",
            "zh",
        ],
        "",
    );
    let notes: String = table.lines().filter(|l| l.starts_with('#')).collect();
    for text in [&own_words(&said), &notes] {
        assert!(is_chinese(text) && english(text).is_none(), "{text}");
    }
}

#[test]
fn the_help_is_in_the_language_of_the_machine() {
    for (variables, arguments, chinese) in [
        (&[("LC_ALL", "zh_CN.UTF-8")][..], &["solve", "--help"][..], true),
        (&[("LC_ALL", ""), ("LC_MESSAGES", ""), ("LANG", "zh_TW")], &["--help"], true),
        (&[("LC_ALL", "C"), ("LANG", "zh_CN.UTF-8")], &["--help"], false),
        (&[("LC_ALL", "zh_CN.UTF-8")], &["draw", "--help", "--lang", "en"], false),
        (&[], &["--lang", "zh", "draw", "-h"], true),
        (&[], &["draw", "-h"], false),
    ] {
        let run = hodograph().envs(variables.iter().copied()).args(arguments).assert().success();
        let help = text(&run.get_output().stdout);
        assert_eq!(is_chinese(&help), chinese, "{variables:?} {arguments:?}:\n{help}");
        assert!(!chinese || english(&help).is_none(), "{help}");
    }
}

#[test]
fn faults_of_arguments_are_reported_in_chinese() {
    for line in [
        "solv",
        "solve",
        "solve x --jso",
        "solve x --digits 77",
        "draw x --poses 99",
        "draw x --poses many",
        "draw x --figure shet",
        "sweep x --steps -1",
    ] {
        let run = hodograph().args(line.split(' ')).args(["--lang", "zh"]).assert().code(2);
        let said = text(&run.get_output().stderr);
        assert!(is_chinese(&said) && english(&said).is_none(), "{line}:\n{said}");
    }
}

/// A code for programs at the head of a sentence: `slow-stroke: ...`.
fn headed_by_a_code(line: &str) -> bool {
    let head = line.trim_start().split(':').next().unwrap_or_default();
    line.contains(':')
        && head.contains('-')
        && head.bytes().all(|b| b.is_ascii_lowercase() || b == b'-')
}

/// True if a Chinese character is directly followed by a half-width mark.
fn half_width(text: &str) -> bool {
    let chars: Vec<char> = text.chars().collect();
    chars.windows(2).any(|w| is_chinese(&w[0].to_string()) && [',', ':', ';'].contains(&w[1]))
}

/// Chinese sentences use full-width punctuation: no English comma, colon or semicolon except in
/// brackets and quotations, none directly after a Chinese character, and no code at the beginning.
#[test]
fn chinese_has_its_own_punctuation() {
    let (mut looked, mut faults) = (0, Vec::new());
    let of_scenes: &[&[&str]] = &[
        &["plan"],
        &["solve"],
        &["solve", "--steps"],
        &["mobility"],
        &["limits"],
        &["centres"],
        &["composite"],
        &["cam"],
        &["inversions"],
        &["curvature", "--steps"],
        &["attempts"],
    ];
    let list = hodograph::scene::templates::list();
    let scenes = list
        .iter()
        .step_by(every(8))
        .map(|t| (t.name, hodograph::scene::templates::get(t.name).unwrap()));
    let tasks = hodograph::synthesis::templates::names().step_by(every(2));
    let tasks = tasks.map(|name| (name, hodograph::synthesis::templates::get(name).unwrap()));
    let of_tasks: &[&[&str]] = &[&["synth", "--steps"]];
    let all = scenes.map(|s| (s, of_scenes)).chain(tasks.map(|t| (t, of_tasks)));
    for ((name, scene), commands) in all {
        for command in commands {
            let arguments = [&command[..1], &["-", "--lang", "zh"], &command[1..]].concat();
            let (said, printed) = told(&arguments, scene);
            for line in
                said.lines().chain(printed.lines()).filter(|l| is_chinese(l) && !l.contains('│'))
            {
                looked += 1;
                let mut depth = 0;
                let bare: String = line
                    .split('`')
                    .step_by(2)
                    .collect::<String>()
                    .chars()
                    .filter(|c| {
                        depth += i32::from("([{".contains(*c)) - i32::from(")]}".contains(*c));
                        depth == 0
                    })
                    .collect();
                let unquoted = line.split('`').step_by(2).collect::<Vec<_>>().join(" ");
                if [", ", "; ", ": "].iter().any(|mark| bare.replace("\": ", "").contains(mark))
                    || headed_by_a_code(line)
                    || half_width(&unquoted)
                {
                    faults.push(format!("{name} {command:?}: {line}"));
                }
            }
        }
    }
    assert!(looked > 1000 / every(8), "only {looked} lines");
    assert!(faults.is_empty(), "{} lines:\n{}", faults.len(), faults.join("\n"));
}

/// Given data of a motion are printed as values and signs, not with the names and units of the
/// file.
#[test]
fn givens_of_a_motion_are_values() {
    let folder = tempfile::tempdir().unwrap();
    let (file, out) = (folder.path().join("plate.json"), folder.path().join("plate.md"));
    std::fs::write(&file, hodograph::particle::templates::get("plate-in-space").unwrap()).unwrap();
    for lang in ["en", "zh"] {
        hodograph()
            .args(["worksheet", "--lang", lang, "--problem-only"])
            .arg(&file)
            .arg("-o")
            .arg(&out)
            .assert()
            .success();
        let said = std::fs::read_to_string(&out).unwrap();
        let given: String =
            said.lines().filter(|l| l.starts_with("- ")).collect::<Vec<_>>().join("\n");
        assert!(
            given.contains("60°") && given.contains("90°") && given.contains("ω = 1/3 rad/s"),
            "{given}"
        );
        for name in ["deg", "theta", "omega"] {
            assert!(!given.contains(name), "{name} in\n{given}");
        }
    }
}
