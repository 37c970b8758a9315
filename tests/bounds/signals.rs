//! A signal ends every command during any computation, within half a second if the processor is
//! free. Every command is tried, at sizes that take it seconds.
//!
//! The tests measure the processor time of the program after the signal, which does not depend on
//! other load.

use crate::scenes::{chain, points_on_a_link};
use crate::wide::every;
use crate::{hodograph, template, written};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Half a second on each of two cores, plus the delay until a busy machine delivers the signal.
const MOST_S: f64 = 1.5;
/// Deadline on a machine under any load.
const DEADLINE: Duration = Duration::from_secs(60);
/// Commands that take at most a second with any scene; `shards` reads as much as there is.
pub const AT_ONCE: [&str; 10] = [
    "new",
    "templates",
    "schema",
    "explain",
    "diff",
    "shards",
    "mark",
    "import",
    "mdbook",
    "teeth",
];

/// Every command at a size that takes it seconds (or its longest possible time): its arguments, and
/// the scene.
const LONG: [(&str, &str); 29] = [
    ("draw SCENE -o a.svg", "points-1900"),
    ("draw SCENE --figure mechanism --dimensions -o b.svg", "points-1900"),
    ("lesson SCENE --positions 360 -o c.html", "points-40"),
    ("solve SCENE --steps --digits 30", "chain-200"),
    ("plan SCENE --json --figure", "chain-200"),
    ("worksheet SCENE -o d.pdf", "points-1900"),
    ("export SCENE -o n.pptx", "chain-60"),
    ("variants SCENE --vary l_OA=80..100/0.01 --count 200 -o set", "six"),
    ("accuracy SCENE --patience 10000 --toward-toggle", "six"),
    ("sweep SCENE --steps 10000000 -o e.npy", "six"),
    ("sweep SCENE --over l_OA --from 80 --to 80.001 --steps 10000000 -o f.csv", "six"),
    ("batch SCENE --steps 100000 --vary l_OA=80..80.001:1000 -o g.csv", "six"),
    ("curves SCENE --steps 100000 -o h.svg", "chain-200"),
    ("path SCENE --point P7 --poses 72 -o i.svg", "chain-60"),
    ("animate SCENE --frames 360 -o j.gif", "chain-60"),
    ("cam SCENE --steps 100000 --profile k.csv -o k", "cam"),
    ("limits SCENE", "chain-200"),
    ("compare SCENE SCENE -o n.svg", "chain-200"),
    ("cycle SCENE -o p.svg", "chain-200"),
    ("mobility SCENE -o l.svg", "chain-200"),
    ("centres SCENE", "chain-30"),
    ("inversions SCENE -o m", "chain-10"),
    ("curvature SCENE --steps", "chain-60"),
    ("composite SCENE", "chain-60"),
    ("loops SCENE", "chain-200"),
    ("attempts SCENE --all", "chain-60"),
    ("synth SCENE", "wish"),
    ("readings SCENE", "chain-60"),
    ("solve SCENE --digits 30", "pursuit"),
];

/// A search for a path through sixty places of a noisy ellipse.
fn wish() -> String {
    let place = |k: usize| {
        let turn = std::f64::consts::TAU * k as f64 / 60.0;
        let noise = 2.0 * libm::sin(17.0 * k as f64);
        format!(
            r#"["{:.3} mm", "{:.3} mm"]"#,
            100.0 + 60.0 * libm::cos(turn) + noise,
            80.0 + 25.0 * libm::sin(turn)
        )
    };
    let places: Vec<String> = (0..60).map(place).collect();
    format!(r#"{{"synthesis": "path", "points": [{}]}}"#, places.join(", "))
}

fn scene(folder: &Path, name: &str) -> std::path::PathBuf {
    let file = format!("{name}.json");
    let number = |prefix: &str| name.strip_prefix(prefix).and_then(|n| n.parse::<usize>().ok());
    let text = |text: &str| {
        let path = folder.join(&file);
        std::fs::write(&path, text).unwrap();
        path
    };
    match (number("chain-"), number("points-"), name) {
        (Some(n), ..) => written(folder, &file, &chain(n)),
        (_, Some(n), _) => written(folder, &file, &points_on_a_link(n)),
        (.., "cam") => template(folder, "cam-valve-train", &[]),
        (.., "wish") => text(&wish()),
        (.., "pursuit") => text(PURSUIT),
        _ => template(folder, "class-iii-six-bar", &[]),
    }
}

/// Pursuit of a faster target on a circle: it has no end.
const PURSUIT: &str = r#"{"points": {"A": [0, 0]}, "motions": [
    {"point": "B", "centre": [0, 0], "radius": "100 m", "s": "9 m/s*t"}, {"point": "A", "toward": "B", "speed": "5 m/s"}], "find": ["T_AB"]}"#;

/// The processor time of a running program (s): the 14th and 15th field of its `stat`, in
/// hundredths.
pub fn taken(child: &Child) -> Option<f64> {
    let stat = std::fs::read_to_string(format!("/proc/{}/stat", child.id())).ok()?;
    let fields: Vec<&str> = stat.rsplit(')').next()?.split_whitespace().collect();
    Some((fields.get(11)?.parse::<f64>().ok()? + fields.get(12)?.parse::<f64>().ok()?) / 100.0)
}

/// True if SIGINT is ignored here, as in background jobs of a shell: child processes inherit that.
fn interrupts_are_ignored() -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status
        .lines()
        .find_map(|l| l.strip_prefix("SigIgn:"))
        .and_then(|m| u64::from_str_radix(m.trim(), 16).ok());
    mask.is_some_and(|m| m & 0b10 != 0)
}

/// Returns the processor time after the signal; `None` if the program had already ended.
fn interrupted(folder: &Path, arguments: &[String], signal: &str, after: Duration) -> Option<f64> {
    let mut run = Command::new(env!("CARGO_BIN_EXE_hodograph"));
    let mut child = run
        .current_dir(folder)
        .args(arguments)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    std::thread::sleep(after);
    if child.try_wait().unwrap().is_some() {
        return None;
    }
    let before = taken(&child).unwrap_or(0.0);
    assert!(
        Command::new("kill").arg(signal).arg(child.id().to_string()).status().unwrap().success()
    );
    let (asked, mut last) = (Instant::now(), before);
    while child.try_wait().unwrap().is_none() {
        last = taken(&child).filter(|t| *t > 0.0).unwrap_or(last);
        assert!(asked.elapsed() < DEADLINE, "{arguments:?} does not heed {signal}");
        std::thread::sleep(Duration::from_millis(10));
    }
    Some(last - before)
}

/// The commands that the program lists; `edit`, which serves until it is stopped, has its own tests
/// (tests/cli/edit.rs).
pub fn commands() -> Vec<String> {
    let help = hodograph().args(["--help", "--lang", "en"]).output().unwrap().stdout;
    let help = String::from_utf8(help).unwrap();
    let listed = help
        .lines()
        .skip_while(|l| !l.starts_with("Commands:"))
        .skip(1)
        .take_while(|l| !l.is_empty());
    let names = listed
        .filter(|l| !l.starts_with("   "))
        .filter_map(|l| l.split_whitespace().next())
        .filter(|c| !["help", "edit"].contains(c));
    names.map(str::to_owned).collect()
}

#[test]
fn a_signal_ends_every_command() {
    for command in commands() {
        let tried = AT_ONCE.contains(&command.as_str())
            || LONG.iter().any(|(line, _)| line.split(' ').next() == Some(&command));
        assert!(
            tried,
            "no signal is sent to `{command}`: add a command line that takes it seconds"
        );
    }
    let ignored = interrupts_are_ignored();
    let mut ended = 0;
    for (k, (line, name)) in LONG.iter().enumerate().step_by(every(3)) {
        let folder = tempfile::tempdir().unwrap();
        let path = scene(folder.path(), name);
        let arguments: Vec<String> = line
            .split(' ')
            .map(|w| if w == "SCENE" { path.display().to_string() } else { w.to_owned() })
            .collect();
        let signal = if k % 2 == 0 && !ignored { "-INT" } else { "-TERM" };
        let Some(after) =
            interrupted(folder.path(), &arguments, signal, Duration::from_millis(800))
        else {
            continue;
        };
        ended += 1;
        assert!(after < MOST_S, "{line} of {name}: {after} s of the processor after {signal}");
        // No half-written file has its final name.
        let left: Vec<_> = std::fs::read_dir(folder.path())
            .unwrap()
            .map(|e| e.unwrap().file_name().into_string().unwrap())
            .collect();
        let named = |n: &&String| {
            !n.ends_with(".json") && !n.starts_with('.') && !n.contains(".part") && n.contains('.')
        };
        assert!(!left.iter().any(|n| named(&n)), "{line} of {name} leaves {left:?}");
    }
    assert!(ended > 6 / every(3), "only {ended} commands took long enough to be interrupted");
}
