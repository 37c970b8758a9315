//! Mutated input: scenes, style files, arguments; scenes through all commands ([`commands`]); tasks
//! and motions ([`tasks`]). (Journals: `src/cli/part/tests.rs`.)
//!
//! Every `cargo test` runs a few seconds of it, always with the same inputs.
//! `HODOGRAPH_FUZZ_TIMES=20 cargo test fuzz` tries twenty times as many,
//! `HODOGRAPH_FUZZ_SECONDS=60` as many as a minute allows, `HODOGRAPH_FUZZ_SEED=7` others. The
//! seeds of scenes are all templates and the scenes of `tests/bad` and `tests/repro`. A failure
//! prints its input.

mod commands;
mod mutate;
mod tasks;

use hodograph::certified::certify;
use hodograph::figure::sheet::{SheetOptions, sheet};
use hodograph::paper::style;
use hodograph::render::svg;
use hodograph::report::answers;
use hodograph::report::diagnostics::render;
use hodograph::scene::{self, Lang, templates};
use hodograph::worked::{Scope, work};
use hodograph::worksheet::{WorksheetOptions as Sheets, html, markdown, typst, worksheet};
use mutate::{Mutator, Rng};
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

/// Time limit of one input, unoptimised, on a busy machine.
const SOON: Duration = Duration::from_secs(60);

fn root(path: &str) -> std::path::PathBuf {
    std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// The texts of all JSON files in these folders.
fn corpus(folders: &[&str]) -> Vec<String> {
    let mut files: Vec<_> = folders
        .iter()
        .flat_map(|f| fs::read_dir(root(f)).unwrap())
        .map(|f| f.unwrap().path())
        .collect();
    files.retain(|f| f.extension().is_some_and(|e| e == "json"));
    files.sort();
    assert!(!files.is_empty());
    files.iter().map(|f| fs::read_to_string(f).unwrap()).collect()
}

/// Integer overflows and failed assertions are found: `cargo test` runs with both checks, in any
/// profile.
#[test]
fn checks_are_on() {
    assert!(
        std::hint::black_box(cfg!(debug_assertions)),
        "Cargo.toml: the profile of these tests has no debug assertions"
    );
    let least = std::hint::black_box(0usize);
    assert!(
        catch_unwind(|| least - 1).is_err(),
        "Cargo.toml: the profile of these tests has no overflow checks"
    );
}

/// Feeds mutated inputs to a target: the default number or a multiple of it, or for a given time.
/// Prints the number of accepted inputs.
fn fuzz(name: &str, seeds: &[String], usual: u64, target: &dyn Fn(&[u8], u64) -> bool) {
    let number = |key: &str| std::env::var(key).ok().and_then(|v| v.parse::<u64>().ok());
    let (seconds, seed) =
        (number("HODOGRAPH_FUZZ_SECONDS"), number("HODOGRAPH_FUZZ_SEED").unwrap_or(1));
    let most = usual * number("HODOGRAPH_FUZZ_TIMES").unwrap_or(1);
    let begin = Instant::now();
    let mutator = Mutator::new(seeds);
    let (mut tried, mut accepted) = (0, 0);
    while seconds.map_or(tried < most, |s| begin.elapsed().as_secs() < s) {
        let mut rng = Rng::new(seed.wrapping_mul(0x9e37_79b9) ^ tried);
        let input = mutator.input(&mut rng);
        let start = Instant::now();
        match catch_unwind(AssertUnwindSafe(|| target(&input, tried))) {
            Ok(whole) => accepted += u64::from(whole),
            Err(e) => {
                let words = e
                    .downcast_ref::<String>()
                    .cloned()
                    .or(e.downcast_ref::<&str>().map(|s| s.to_string()))
                    .unwrap_or_default();
                panic!(
                    "{name}, seed {seed}, input {tried}: {words}\n{}",
                    String::from_utf8_lossy(&input)
                );
            }
        }
        let took = start.elapsed();
        assert!(
            took < SOON,
            "{name}, seed {seed}, input {tried}: took {took:?}\n{}",
            String::from_utf8_lossy(&input)
        );
        tried += 1;
    }
    println!("{name}: {tried} inputs, {accepted} of them accepted, {:.0?}", begin.elapsed());
}

/// Checks that the messages of faults can be printed.
fn told(faults: &hodograph::diag::Faults, input: &[u8]) {
    assert!(faults.has_errors(), "refused without an error: {faults:?}");
    let said = render(faults, "input.json", &String::from_utf8_lossy(input));
    assert!(!said.contains(|c: char| c.is_control() && !matches!(c, '\n' | '\t')), "{said:?}");
}

/// Checks that a printed answer contains no NaN or infinity.
fn finite(text: &str) {
    assert!(!text.contains(|c: char| c.is_control() && !matches!(c, '\n' | '\t')), "{text:?}");
    let mut words = text.split(|c: char| !c.is_alphanumeric());
    assert!(!words.any(|w| matches!(w, "NaN" | "inf")), "{text}");
}

fn well_formed(xml: &str) {
    drop(roxmltree::Document::parse(xml).unwrap());
}

/// A scene is refused with a message, or solved and drawn: all outputs are well-formed.
fn scene_target(input: &[u8], k: u64) -> bool {
    let scene = match scene::read(input) {
        Ok(s) => s.value,
        Err(faults) => {
            told(&faults, input);
            return false;
        }
    };
    let worked = match work(&scene, Scope::Figure) {
        Ok(w) => w.value,
        Err(faults) => {
            told(&faults, input);
            return false;
        }
    };
    let lang = if k.is_multiple_of(2) { Lang::En } else { Lang::Zh };
    let certified = certify(&scene, &worked, answers::DIGITS);
    let text = answers::text(&scene, &worked, &certified, answers::DIGITS, lang);
    finite(&text);
    let drawn =
        sheet(&scene, &worked, &SheetOptions::of_language(lang)).and_then(|f| svg::write(&f));
    match drawn {
        Ok(svg) => well_formed(&svg.value),
        Err(faults) => told(&faults, input),
    }
    if k.is_multiple_of(4) {
        let document = worksheet(&scene, &worked, &Sheets::of_language(lang));
        if let Ok(page) = html::html(&document) {
            well_formed(page.trim_start_matches("<!DOCTYPE html>"));
        }
        if let Ok((source, _)) = typst::typst(&document, "a") {
            let root = typst_syntax::parse(&source);
            assert!(root.errors_and_warnings().0.is_empty(), "{:?}", root.errors_and_warnings().0);
        }
        let _ = markdown::markdown(&document, "a");
    }
    true
}

#[test]
fn fuzz_scenes() {
    let mut seeds = corpus(&["templates", "tests/bad", "tests/repro"]);
    seeds.push("{\"title\": \"曲柄\\u001b\", \"find\": [\"v_A\"]}".into());
    fuzz("scenes", &seeds, 200, &scene_target);
}

/// A style is refused with a message, or a sheet is drawn in it.
#[test]
fn fuzz_styles() {
    let mut seeds = corpus(&["crates/paper/src/paper/style"]);
    seeds.push(r##"{ "base": "print", "lines": { "vector": 0.5 }, "colours": { "links": ["#0072b2", "#d55e00"] }, "notation": { "pole": "P", "coriolis": "k", "sliding": "r", "known": "\\surd", "unknown": "?" } }"##.into());
    let scene = scene::read(templates::get("slider-crank").unwrap()).unwrap().value;
    let worked = work(&scene, Scope::Figure).unwrap().value;
    fuzz("styles", &seeds, 600, &|input, k| match style::read(input) {
        Err(faults) => {
            told(&faults, input);
            false
        }
        Ok(style) => {
            if k.is_multiple_of(8) {
                let usual = SheetOptions::of_language(Lang::En);
                let options =
                    SheetOptions { notation: style.marks.over(&usual.notation), style, ..usual };
                match sheet(&scene, &worked, &options).and_then(|f| svg::write(&f)) {
                    Ok(svg) => well_formed(&svg.value),
                    Err(faults) => told(&faults, input),
                }
            }
            true
        }
    });
}

/// Words of a command line: commands, options, valid and invalid values.
const WORDS: &str = "draw lesson solve plan worksheet accuracy sweep batch curves path limits new templates schema explain export import --to dxf ggb pptx pmks --from pylinkage --frame --page a4 x.dxf x.ggb x.txt --lang en zh --notation cn \
    -o a.svg a.png a.pdf a.csv a.json a.npy a.parquet a.md a.typ a.html out/ /dev/null scene.json style.json missing.json - . .. --format svg,png pdf csv,json --errors json text dead-centre --width 90mm --solved \
    --figure mechanism,velocity sheet results --vectors velocity acceleration --poses 0 2 73 -1 --path E,B Q --dimensions --text editable --steps 3 \
    360 --style print slides dark --font --digits 6 30 31 --drafting 0.1mm --drafting=0.1mm 9mm --dpi 40 1e9 --reveal --positions 8 --driver 1 9 --json \
    --toward-toggle --patience 1 --over phi_1 l_BC driver driver2 --from 0 90deg --to 1e300 1rad nan --find v_C,a_C v_Q omega_3/2 --point E --marks 2 \
    --vary l_BC=200..300:3 l_AB=80..90/5 l_AB=80..90/0 --roster --count 2 --keys keys.csv marks.csv --to moodle,qti3 canvas l_BC=200...300:3 l_BC=..:3 x=1..2 --random 4 --seed 2 crank-rocker shaper --set l_AB=80 l_AB= l_AB=1e400 l_AB=(((( \
    --problem-only --solution --pick 2 --profile p.dxf --frames 3 --centrodes --link 4 --all --speed wish.json cam.json motion.json --help 曲 \u{1b}[31m \u{fffe} =x -- ''";

/// The words in the lines of a help text that hold options.
fn options(help: &str) -> Vec<String> {
    let words = help.split(|c: char| !(c.is_ascii_alphanumeric() || c == '-'));
    let mut all: Vec<String> =
        words.filter(|w| w.starts_with("--") && w.len() > 2).map(str::to_owned).collect();
    all.sort();
    all.dedup();
    all
}

/// The commands that the program lists, each with its options; `edit`, which serves until it is
/// stopped, has its own tests (tests/cli/edit.rs).
fn commands() -> Vec<(String, Vec<String>)> {
    let help = |command: &[&str]| {
        let run = assert_cmd::Command::new(env!("CARGO_BIN_EXE_hodograph"))
            .args(command)
            .args(["--help", "--lang", "en"])
            .output()
            .unwrap();
        String::from_utf8(run.stdout).unwrap()
    };
    let all = help(&[]);
    let listed = all
        .lines()
        .skip_while(|l| !l.starts_with("Commands:"))
        .skip(1)
        .take_while(|l| !l.is_empty());
    let names = listed
        .filter(|l| l.starts_with("  ") && !l.starts_with("   "))
        .filter_map(|l| l.split_whitespace().next());
    names
        .filter(|n| !["help", "edit"].contains(n))
        .map(|n| (n.to_owned(), options(&help(&[n]))))
        .collect()
}

/// With any arguments, the program ends by itself with one of its exit codes. Every command is
/// tried, with its own options.
#[test]
fn fuzz_arguments() {
    let words: Vec<&str> = WORDS.split_whitespace().collect();
    let right = [
        "draw scene.json -o a.svg",
        "solve scene.json --steps --digits 6",
        "sweep scene.json --find v_C --from 0 --to 90deg --steps 3 -o a.csv",
        "batch scene.json --vary l_BC=200..300:3 l_AB=80..90/5 l_AB=80..90/0 --roster --count 2 --keys keys.csv marks.csv --to moodle,qti3 canvas --steps 3 -o a.npy",
        "curves scene.json --steps 8 -o a.svg",
        "path scene.json --point E -o a.svg",
        "new crank-rocker --set l_AB=80 -o new.json",
        "worksheet scene.json -o a.md",
        "variants scene.json --vary l_AB=80..90/5 --count 2 --seed 2 --to moodle,qti3 -o set",
        "mark marks.csv --keys keys.csv -o a.csv",
        "worksheet scene.json --frame --page a4 -o a.pdf",
        "export scene.json --figure mechanism -o x.dxf",
        "export scene.json --to pmks -o x.txt",
        "import linkage.txt --from pmks -o new.json",
        "mdbook supports html",
        "limits scene.json --json",
        "compare scene.json scene.json --find v_C -o a.svg",
        "cycle scene.json --form polar -o a.svg",
        "plan scene.json --json",
        "synth wish.json --pick 1 -o design.json",
        "animate scene.json --frames 3 -o a.gif",
        "cam cam.json --profile p.csv --steps 12",
        "curvature scene.json --link 2 --point E",
        "composite scene.json --json",
        "loops scene.json --json",
        "shards missing parts --of 4",
        "attempts scene.json --all",
        "inversions scene.json -o out",
        "centres scene.json",
        "mobility scene.json",
        "readings scene.json --set l_AB=80",
        "solve motion.json --digits 12",
        "accuracy scene.json --patience 1 -o a.svg",
        "lesson scene.json --positions 8 -o a.html",
        "templates --lang zh",
        "teeth --ratio 3 --distance 150mm --module 2,2.5 --json",
        "schema --synthesis",
        "explain dead-centre --json",
        "solve scene.json --errors json",
        "curves scene.json --steps 8 -o - --format svg",
        "diff first.svg second.svg --tolerance 0.1",
    ];
    let commands = commands();
    assert!(commands.len() > 20, "{commands:?}");
    for (command, options) in &commands {
        assert!(
            right.iter().any(|line| line.split(' ').next() == Some(command)),
            "no command line of `{command}` {options:?} is tried: add one"
        );
    }
    let seeds: Vec<String> = right.iter().map(|s| s.to_string()).collect();
    let folder = tempfile::tempdir().unwrap();
    fs::copy(root("templates/crank-rocker.json"), folder.path().join("scene.json")).unwrap();
    let linkage = "ground,a,R,0,0\na,b,R,0,10\nb,c,R,12,2\nground,c,P,12,0,0\n";
    fs::write(folder.path().join("linkage.txt"), linkage).unwrap();
    for (name, seed) in [
        ("wish", "synthesis/time-ratio"),
        ("cam", "cam-offset-roller"),
        ("motion", "particle/pursuit"),
    ] {
        fs::copy(
            root(&format!("templates/{seed}.json")),
            folder.path().join(format!("{name}.json")),
        )
        .unwrap();
    }
    for (name, table) in [
        ("marks", "student,variant,question,value,unit\nA,1,v_C,2 cw,mm/s\nB,2,v_C,,\n"),
        (
            "keys",
            "variant,question,value,unit,tolerance,mistakes\n1,v_C,2,m/s,0.1,no-normal@link 2=3\n",
        ),
    ] {
        fs::write(folder.path().join(format!("{name}.csv")), table).unwrap();
    }
    fs::copy(root("crates/paper/src/paper/style/dark.json"), folder.path().join("style.json"))
        .unwrap();
    for (name, figure) in [("first", "mechanism"), ("second", "velocity")] {
        fs::copy(
            root(&format!("examples/golden-images/golden/{figure}.svg")),
            folder.path().join(format!("{name}.svg")),
        )
        .unwrap();
    }
    let before = fs::read(folder.path().join("scene.json")).unwrap();
    fuzz("arguments", &seeds, 100, &|input, k| {
        let mut rng = Rng::new(k);
        // The commands in turn.
        let mut line: Vec<String> =
            seeds[k as usize % seeds.len()].split(' ').map(str::to_owned).collect();
        let own = commands.iter().find(|c| c.0 == line[0]).map_or(&[][..], |c| &c.1[..]);
        for _ in 0..1 + rng.below(3) * rng.below(2) {
            let at = 1 + rng.below(line.len() - 1);
            match rng.below(5) {
                4 if !own.is_empty() => line.insert(at, own[rng.below(own.len())].clone()),
                0 => drop(line.remove(at)),
                1 => line[at] = words[rng.below(words.len())].to_owned(),
                2 => {
                    line[at] = String::from_utf8_lossy(&input[..input.len().min(40)])
                        .replace(['\0', '/'], "")
                }
                _ => line.insert(at, words[rng.below(words.len())].to_owned()),
            }
            if line.len() < 2 {
                break;
            }
        }
        let mut run = assert_cmd::Command::new(env!("CARGO_BIN_EXE_hodograph"));
        let run = run
            .current_dir(folder.path())
            .args(&line)
            .timeout(SOON)
            .write_stdin("{")
            .output()
            .unwrap();
        let (out, said) =
            (String::from_utf8_lossy(&run.stdout), String::from_utf8_lossy(&run.stderr));
        let code = run.status.code();
        assert!(matches!(code, Some(0 | 1 | 2 | 4)), "{line:?}: {code:?} {said}");
        assert!(
            !said.contains("panicked") && !said.contains('\u{1b}') && !out.contains('\u{1b}'),
            "{line:?}: {said:?}"
        );
        // Differences count as an answer: they are printed.
        let answered = code == Some(0)
            || code == Some(4)
            || code == Some(1) && line[0] == "diff" && !out.is_empty()
            // mdBook asks by the exit code alone.
            || code == Some(1) && line[0] == "mdbook";
        assert!(answered || !said.is_empty(), "{line:?}: {code:?} without a word");
        assert_eq!(
            fs::read(folder.path().join("scene.json")).unwrap(),
            before,
            "{line:?}: the scene was written over"
        );
        code == Some(0)
    });
}
