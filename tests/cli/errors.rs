//! Faults for programs: `--errors json`, `explain`, the schemas of the printed JSON,
//! docs/errors.md.

use super::{hodograph, templates_path, text};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn printed(args: &[&str]) -> String {
    text(&hodograph().args(args).assert().success().get_output().stdout)
}

/// A schema that the program prints.
fn schema(which: &str) -> jsonschema::Validator {
    jsonschema::validator_for(&serde_json::from_str(&printed(&["schema", which])).unwrap()).unwrap()
}

fn fits(schema: &jsonschema::Validator, told: &Value, what: &str) {
    let faults: Vec<String> =
        schema.iter_errors(told).map(|e| format!("{}: {e}", e.instance_path())).collect();
    assert!(faults.is_empty(), "{what}: {faults:#?}");
}

/// The scenes of a folder.
fn scenes(folder: &str) -> Vec<PathBuf> {
    let all = fs::read_dir(root().join(folder)).unwrap().map(|f| f.unwrap().path());
    let mut all: Vec<PathBuf> =
        all.filter(|p| p.extension().is_some_and(|e| e == "json")).collect();
    all.sort();
    assert!(all.len() > 3, "{folder}");
    all
}

/// Standard error of a run with `--errors json`: one document, all of it.
fn document(args: &[&str]) -> (Value, Option<i32>) {
    let run = hodograph().args(["--errors", "json"]).args(args).output().unwrap();
    let told = serde_json::from_slice(&run.stderr)
        .unwrap_or_else(|e| panic!("{args:?}: {e}\n{}", text(&run.stderr)));
    (told, run.status.code())
}

fn codes(document: &Value) -> Vec<String> {
    document["diagnostics"]
        .as_array()
        .unwrap()
        .iter()
        .map(|d| d["code"].as_str().unwrap().to_owned())
        .collect()
}

#[test]
fn faults_of_broken_scenes_are_one_document_of_the_schema() {
    let schema = schema("--diagnostics");
    for path in scenes("tests/bad") {
        let path = path.to_str().unwrap();
        let (told, code) = document(&["solve", path]);
        fits(&schema, &told, path);
        let plain = hodograph().args(["solve", path]).output().unwrap();
        assert_eq!(code, plain.status.code(), "{path}");
        let (said, source) = (text(&plain.stderr), fs::read_to_string(path).unwrap());
        let list = told["diagnostics"].as_array().unwrap();
        assert_eq!(list.is_empty(), said.is_empty(), "{path}");
        for d in list {
            // As in the text for people.
            assert!(said.contains(d["code"].as_str().unwrap()), "{path}: {d}\n{said}");
            let place = &d["place"];
            if place.is_null() {
                continue;
            }
            assert_eq!(d["file"], path);
            assert!(
                said.contains(&format!("{path}:{}:{}]", place["line"], place["column"])),
                "{path}: {d}\n{said}"
            );
            let [from, to] = ["start", "end"].map(|key| place[key].as_u64().unwrap() as usize);
            let line = source.lines().nth(place["line"].as_u64().unwrap() as usize - 1).unwrap();
            let here: String =
                line.chars().skip(place["column"].as_u64().unwrap() as usize - 1).collect();
            assert!(here.starts_with(source[from..to].lines().next().unwrap()), "{path}: {d}");
        }
    }
}

#[test]
fn whatever_is_reported_on_standard_error_is_the_document() {
    let schema = schema("--diagnostics");
    let shaper = templates_path("shaper");
    let both = ["sweep", &shaper, "--set", "nothing=1", "--set", "other"];
    let told: &[(&[&str], i32, &[&str])] = &[
        // The arguments themselves, in both languages.
        (&["solve"], 2, &["usage"]),
        (&["frobnicate"], 2, &["usage"]),
        (&["solve", "x.json", "--digits", "99"], 2, &["usage"]),
        (&["solve", "x.json", "--lang", "zh", "--digits", "99"], 2, &["usage"]),
        // A missing file, one that cannot be written, faults in two arguments.
        (&["solve", "not-there.json"], 2, &["cannot-read"]),
        (&["new", "crank-rocker", "-o", "tests/bad/README.md/x"], 1, &["cannot-write"]),
        (&both, 2, &["unknown-parameter", "set"]),
        // Nothing to report; help; a note; a warning with an exit code of its own.
        (&["templates"], 0, &[]),
        (&["solve", "--help"], 0, &[]),
        (&["solve", "tests/bad/dead-centre.json"], 4, &["dead-centre"]),
        (&["synth", "templates/synthesis/time-ratio.json", "--speed"], 0, &["speed"]),
    ];
    for (args, due, wanted) in told {
        let (document, code) = document(args);
        fits(&schema, &document, &args.join(" "));
        assert_eq!(code, Some(*due), "{args:?}");
        let codes = codes(&document);
        assert!(
            wanted.iter().all(|w| codes.iter().any(|c| c == w))
                && (codes.is_empty() == wanted.is_empty()),
            "{args:?}: {codes:?}"
        );
    }
    // Answers as JSON hold their notes; so does the document.
    let (told, _) = document(&["solve", "--json", "tests/bad/dead-centre.json"]);
    assert!(codes(&told).iter().any(|c| c == "dead-centre"), "{told}");
    let (usage, _) = document(&["solve", "x.json", "--lang", "zh", "--digits", "99"]);
    let message = &usage["diagnostics"][0]["message"];
    assert!(
        message["en"].as_str().unwrap().contains("not a whole number from 1 to 30"),
        "{message}"
    );
    assert!(message["zh"].as_str().unwrap().contains("不是 1 到 30 的整数"), "{message}");
    // Every command accepts the option, in any place; without it the text stays.
    let run = hodograph().args(["solve", "not-there.json", "--errors=json"]).assert().code(2);
    assert!(text(&run.get_output().stderr).starts_with("{\n  \"schema\": \"hodograph/errors/1\""));
    let run = hodograph().args(["solve", "not-there.json", "--errors=text"]).assert().code(2);
    assert!(text(&run.get_output().stderr).starts_with("cannot-read"));
    hodograph().args(["solve", "x.json", "--errors", "xml"]).assert().code(2);
}

#[test]
fn answers_as_json_fit_their_schema() {
    let schema = schema("--solved");
    let out = tempfile::tempdir().unwrap();
    let parallel = out.path().join("in-line.json");
    fs::write(
        &parallel,
        r#"{"links": {"1": ["A","B"], "2": ["B","C"], "3": ["C","D"], "4": ["A","D"]}, "ground": "4", "units": {"length": "m"},
          "points": {"A": [0,0], "B": [2,0], "C": [7,0], "D": [4,-4]}, "driver": {"link": "3", "omega": "1 rad/s"}, "find": ["omega_1", "v_C"]}"#,
    )
    .unwrap();
    // Templates and motions; a pose next to a toggle, a dead centre; singular scenes and scenes of
    // past faults; tolerances.
    let mut all = [
        scenes("templates"),
        scenes("tests/repro"),
        scenes("templates/particle"),
        scenes("tests/bad"),
    ]
    .concat();
    all.extend([root().join("docs/near-toggle.json"), parallel]);
    let every = super::wide::every(3);
    let (mut seen, mut unanswered, mut motions) = (0, 0, 0);
    for path in all
        .iter()
        .enumerate()
        .filter(|(n, p)| {
            n % every == 0 || *n + 2 >= all.len() || p.to_str().unwrap().contains("dead")
        })
        .map(|(_, p)| p)
    {
        for options in [&[][..], &["--drafting"]] {
            let run =
                hodograph().args(["solve", "--json"]).arg(path).args(options).output().unwrap();
            if !matches!(run.status.code(), Some(0 | 4)) {
                continue;
            }
            let told: Value = serde_json::from_slice(&run.stdout)
                .unwrap_or_else(|e| panic!("{}: {e}", path.display()));
            fits(&schema, &told, path.to_str().unwrap());
            seen += 1;
            unanswered += usize::from(run.status.code() == Some(4));
            motions += usize::from(told["kind"] == "motion");
        }
    }
    assert!(seen > 20 && unanswered >= 2 && motions >= 1, "{seen} {unanswered} {motions}");
    // Design tasks have the same document, with a construction if requested.
    let tasks = scenes("templates/synthesis");
    for path in &tasks {
        for options in [&[][..], &["--steps"]] {
            let run =
                hodograph().args(["synth", "--json"]).arg(path).args(options).output().unwrap();
            let told: Value = serde_json::from_slice(&run.stdout)
                .unwrap_or_else(|e| panic!("{}: {e}", path.display()));
            fits(&schema, &told, path.to_str().unwrap());
            assert!(
                told["kind"] == "task" && told.get("construction").is_some() != options.is_empty(),
                "{}",
                path.display()
            );
        }
    }
    assert!(tasks.len() >= 5, "{tasks:?}");
    // Documents of another shape are refused.
    let mut told: Value =
        serde_json::from_str(&printed(&["solve", "--json", &templates_path("shaper")])).unwrap();
    assert!(schema.is_valid(&told));
    told["answers"][0]["agrees"] = "yes".into();
    assert!(!schema.is_valid(&told));
}

#[test]
fn a_code_is_explained_with_cause_and_cure() {
    let said = printed(&["explain", "dead-centre"]);
    assert!(
        said.starts_with("dead-centre: ") && ["Cause: ", "Cure: "].iter().all(|w| said.contains(w)),
        "{said}"
    );
    let said = printed(&["explain", "unknown-key", "--lang", "zh"]);
    assert!(
        ["原因：", "对策：", "例："].iter().all(|w| said.contains(w)) && !said.contains("Cause"),
        "{said}"
    );
    let json: Value =
        serde_json::from_str(&printed(&["explain", "dead-centre", "--json"])).unwrap();
    assert!(
        json["code"] == "dead-centre" && json["cure"]["zh"].as_str().unwrap().contains("原动件"),
        "{json}"
    );
    let run = hodograph().args(["explain", "dead-center"]).assert().code(2);
    assert!(text(&run.get_output().stderr).contains("did you mean `dead-centre`"));
    let run = hodograph().args(["explain", "xyzzy"]).assert().code(2);
    assert!(text(&run.get_output().stderr).contains("lists all codes"));
    // Every broken scene has its explanation; the list has them all.
    let list = printed(&["explain"]);
    for path in scenes("tests/bad") {
        for code in codes(&document(&["solve", path.to_str().unwrap()]).0) {
            assert!(list.lines().any(|l| l.split_whitespace().next() == Some(&code)), "{code}");
        }
    }
}

/// The page of all codes, made from the program's output.
fn page() -> String {
    let all: Value = serde_json::from_str(&printed(&["explain", "--json"])).unwrap();
    let word = |of: &Value| of.as_str().unwrap().to_owned();
    let mut out = "# Errors, warnings and notes\n\nEvery message has a code, which stands in its first line. Here is each with its cause and its cure, as `hodograph explain CODE` tells them\n(`--lang zh` in Chinese, `--json` for programs). With `--errors json` a run writes its messages as one JSON document to standard error;\n`hodograph schema --diagnostics` is its schema. This page is made from `src/cli/explain/`: `HODOGRAPH_ACCEPT=1 cargo test --test cli page`.\n"
        .to_owned();
    let codes = all["codes"].as_array().unwrap();
    let mut groups: Vec<&Value> = Vec::new();
    for entry in codes {
        if groups.last() != Some(&&entry["group"]) {
            groups.push(&entry["group"]);
        }
    }
    for group in groups {
        out += &format!("\n## {} · {}\n", word(&group["en"]), word(&group["zh"]));
        for e in codes.iter().filter(|e| e["group"] == *group) {
            let of = |key: &str, lang: &str| word(&e[key][lang]);
            out += &format!("\n### `{}`\n", word(&e["code"]));
            out += &format!(
                "**{}.** {} *Cure:* {}\n\n",
                of("title", "en"),
                of("cause", "en"),
                of("cure", "en")
            );
            out += &format!(
                "**{}。**{}*对策：*{}\n",
                of("title", "zh"),
                of("cause", "zh"),
                of("cure", "zh")
            );
            if let Some(example) = e["example"].as_str() {
                out += &format!("\n```text\n{example}\n```\n");
            }
        }
    }
    out
}

#[test]
fn the_page_of_errors_is_current() {
    let (path, page) = (root().join("docs/errors.md"), page());
    if fs::read_to_string(&path).is_ok_and(|kept| kept == page) {
        return;
    }
    if std::env::var_os("HODOGRAPH_ACCEPT").is_some() {
        fs::write(&path, page).unwrap();
        panic!(
            "docs/errors.md is written: look at it (git diff); without HODOGRAPH_ACCEPT the test passes"
        );
    }
    panic!(
        "docs/errors.md is not what `hodograph explain --json` makes: HODOGRAPH_ACCEPT=1 cargo test --test cli page"
    );
}
