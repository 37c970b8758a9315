//! Files: no existing file is lost, no half-written file remains, and output goes to its given
//! place.

use super::{batch, hodograph, started, text};
use std::fs;
use std::io::{Read, Write};
use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::time::Duration;

fn beside(path: &Path, more: &str) -> PathBuf {
    PathBuf::from(format!("{}{more}", path.display()))
}

fn count(folder: &Path) -> usize {
    fs::read_dir(folder).unwrap().count()
}

fn lines(path: &Path) -> usize {
    fs::read(path).map_or(0, |b| b.iter().filter(|c| **c == b'\n').count())
}

/// Runs a batch until its journal lists some pieces, then kills it.
fn killed(out: &Path) {
    let journal = beside(out, ".part.journal");
    let mut run = started(&batch("8000", out));
    while lines(&journal) < 4 && run.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(1));
    }
    run.kill().unwrap();
    run.wait().unwrap();
    assert!(beside(out, ".part").exists() && !out.exists(), "the batch was over too soon");
}

#[test]
fn of_two_batches_to_one_file_one_is_reported_and_the_other_is_whole() {
    let folder = tempfile::tempdir().unwrap();
    let (whole, out) = (folder.path().join("whole.csv"), folder.path().join("out.csv"));
    hodograph().args(batch("8000", &whole)).assert().success();
    let link = folder.path().join("link.csv");
    symlink("out.csv", &link).unwrap();
    let mut first = started(&batch("8000", &out));
    while lines(&beside(&out, ".part.journal")) < 3 {
        assert!(first.try_wait().unwrap().is_none(), "the first batch was over too soon");
        std::thread::sleep(Duration::from_millis(1));
    }
    // By its name, by another name, with another job.
    for arguments in [batch("8000", &out), batch("8000", &link), batch("100", &out)] {
        let run = hodograph().args(arguments).assert().code(1);
        assert!(text(&run.get_output().stderr).contains("another run is writing it"));
    }
    assert!(first.wait().unwrap().success());
    assert!(fs::read(&out).unwrap() == fs::read(&whole).unwrap(), "the bytes differ");
    assert_eq!(count(folder.path()), 3);
}

#[test]
fn nothing_that_is_read_is_written_over() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let scene = fs::read_to_string("templates/crank-rocker.json").unwrap();
    for name in ["my.json", "q.svg", "q.html", "q.md", "q.csv", "q.pdf"] {
        fs::write(at(name), &scene).unwrap();
    }
    fs::copy("crates/paper/fonts/tinos-italic.ttf", at("font.svg")).unwrap();
    symlink("my.json", at("link.json")).unwrap();
    let before = count(folder.path());
    for arguments in [
        "sweep my.json -o my.json",
        "sweep my.json -o link.json",
        "sweep link.json -o my.json",
        "sweep - -o my.json",
        "draw q.svg",
        "draw q.svg -o .",
        "draw my.json --style print --font font.svg -o font.svg",
        "draw q.pdf -o new/../q.pdf",
        "lesson q.html",
        "worksheet q.md -o q.md",
        "batch q.csv --vary l_BC=200..300:5 -o q.csv",
        "path q.svg --point E -o ./q.svg",
        "curves q.svg -o q.svg",
        "accuracy q.svg --patience 1 -o q.svg",
    ] {
        let stdin = fs::File::open(at("my.json")).unwrap();
        let mut run = std::process::Command::new(env!("CARGO_BIN_EXE_hodograph"));
        let run = run
            .args(arguments.split(' '))
            .current_dir(folder.path())
            .stdin(stdin)
            .output()
            .unwrap();
        let said = text(&run.stderr);
        let code = run.status.code();
        assert!(code == Some(2) && said.contains("would destroy it"), "{arguments}: {said}");
        // Missing folders are created first: only then the name leads back to the scene.
        let _ = fs::remove_dir(at("new"));
        for name in ["my.json", "q.svg", "q.html", "q.md", "q.csv", "q.pdf"] {
            assert_eq!(fs::read_to_string(at(name)).unwrap(), scene, "{arguments}");
        }
        assert_eq!(count(folder.path()), before, "{arguments}");
    }
    assert!(fs::symlink_metadata(at("link.json")).unwrap().is_symlink());
}

#[test]
fn links_lead_to_their_files() {
    let folder = tempfile::tempdir().unwrap();
    let (here, there) = (folder.path().join("here"), folder.path().join("there"));
    [&here, &there].into_iter().for_each(|f| fs::create_dir(f).unwrap());
    for (k, (command, ending)) in [
        ("sweep templates/crank-rocker.json --find v_C", "csv"),
        ("batch templates/crank-rocker.json --vary l_BC=200..300:5 --find v_C", "npy"),
        ("draw templates/crank-rocker.json", "svg"),
        ("new crank-rocker", "json"),
    ]
    .into_iter()
    .enumerate()
    {
        let (link, file) =
            (here.join(format!("{k}.{ending}")), there.join(format!("file-{k}.{ending}")));
        symlink(format!("../there/file-{k}.{ending}"), &link).unwrap();
        // First the link leads to nothing, then to a file.
        for _ in 0..2 {
            hodograph().args(command.split(' ')).arg("-o").arg(&link).assert().success();
            assert!(
                fs::symlink_metadata(&link).unwrap().is_symlink()
                    && fs::symlink_metadata(&file).unwrap().is_file(),
                "{command}"
            );
            assert!(fs::metadata(&file).unwrap().len() > 100, "{command}");
        }
    }
    symlink("b.csv", here.join("a.csv")).unwrap();
    symlink("a.csv", here.join("b.csv")).unwrap();
    hodograph()
        .args(["sweep", "templates/crank-rocker.json", "-o"])
        .arg(here.join("a.csv"))
        .assert()
        .code(1);
    assert_eq!((count(&here), count(&there)), (6, 4), "nothing else is left behind");
}

#[test]
fn pipes_and_devices_take_the_bytes() {
    let folder = tempfile::tempdir().unwrap();
    for (command, ending) in [
        ("sweep templates/crank-rocker.json --find v_C", "csv"),
        ("sweep templates/crank-rocker.json --find v_C", "json"),
        ("batch templates/crank-rocker.json --vary l_BC=200..300:5 --find v_C", "parquet"),
        ("draw templates/crank-rocker.json", "svg"),
        ("worksheet templates/crank-rocker.json", "html"),
    ] {
        let (pipe, file) = (
            folder.path().join(format!("pipe.{ending}")),
            folder.path().join(format!("file.{ending}")),
        );
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let reading = std::thread::spawn({
            let pipe = pipe.clone();
            move || fs::read(pipe).unwrap()
        });
        hodograph().args(command.split(' ')).arg("-o").arg(&pipe).assert().success();
        hodograph().args(command.split(' ')).arg("-o").arg(&file).assert().success();
        assert!(reading.join().unwrap() == fs::read(&file).unwrap(), "{command} {ending}");
        assert!(fs::symlink_metadata(&pipe).unwrap().file_type().is_fifo(), "{command} {ending}");
        let full = folder.path().join(format!("full.{ending}"));
        symlink("/dev/full", &full).unwrap();
        let run = hodograph().args(command.split(' ')).arg("-o").arg(&full).assert().code(1);
        assert!(text(&run.get_output().stderr).contains("cannot be written"));
        [pipe, file, full].into_iter().for_each(|f| fs::remove_file(f).unwrap());
        assert_eq!(count(folder.path()), 0, "{command} {ending}");
    }
    assert!(fs::metadata("/dev/full").unwrap().file_type().is_char_device());
    let run = hodograph().args(["new", "crank-rocker", "-o", "/dev/stdout"]).assert().success();
    assert_eq!(
        text(&run.get_output().stdout),
        fs::read_to_string("templates/crank-rocker.json").unwrap()
    );
}

#[test]
fn rights_stay_and_protected_files_too() {
    let folder = tempfile::tempdir().unwrap();
    let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode() & 0o777;
    for (command, ending) in [
        ("sweep templates/crank-rocker.json --find v_C", "csv"),
        ("batch templates/crank-rocker.json --vary l_BC=200..300:5 --find v_C", "npy"),
        ("draw templates/crank-rocker.json", "svg"),
    ] {
        let out = folder.path().join(format!("out.{ending}"));
        let script = format!("umask 027; exec \"$0\" {command} -o \"$1\"");
        let run = || {
            let mut c = assert_cmd::Command::new("sh");
            c.args(["-c", &script, env!("CARGO_BIN_EXE_hodograph")])
                .arg(&out)
                .current_dir(env!("CARGO_MANIFEST_DIR"));
            c.assert()
        };
        run().success();
        assert_eq!(mode(&out), 0o640, "{command}: what the mask takes away is taken away");
        for kept in [0o600, 0o664] {
            fs::set_permissions(&out, fs::Permissions::from_mode(kept)).unwrap();
            run().success();
            assert_eq!(mode(&out), kept, "{command}");
        }
        fs::write(&out, "kept").unwrap();
        fs::set_permissions(&out, fs::Permissions::from_mode(0o444)).unwrap();
        run().code(1);
        assert_eq!(fs::read_to_string(&out).unwrap(), "kept", "{command}");
    }
    assert_eq!(count(folder.path()), 3, "nothing else is left behind");
}

/// A foreign file under the name of a part or a journal stays unchanged.
#[test]
fn a_part_takes_nobodys_place() {
    type Lay = fn(&Path, &Path);
    let ways: [(&str, Lay); 5] = [
        ("a link to a file", |name, victim| symlink(victim, name).unwrap()),
        ("a link to nothing", |name, victim| symlink(beside(victim, "-nothing"), name).unwrap()),
        ("another name of a file", |name, victim| fs::hard_link(victim, name).unwrap()),
        ("a file", |name, _| fs::write(name, "mine").unwrap()),
        ("a folder", |name, _| fs::create_dir(name).unwrap()),
    ];
    for ending in [".part", ".part.journal"] {
        for (what, lay) in ways {
            let folder = tempfile::tempdir().unwrap();
            let (out, victim) = (folder.path().join("out.csv"), folder.path().join("victim"));
            fs::write(&victim, "theirs").unwrap();
            let name = beside(&out, ending);
            lay(&name, &victim);
            let run = hodograph().args(batch("100", &out)).assert().code(1);
            let said = text(&run.get_output().stderr);
            assert!(
                said.contains("in the way") && said.contains(ending),
                "{ending} {what}: {said}"
            );
            assert_eq!(fs::read_to_string(&victim).unwrap(), "theirs", "{ending} {what}");
            assert!(
                fs::read_to_string(&name)
                    .map_or(true, |t| ["mine", "theirs"].contains(&t.as_str())),
                "{ending} {what}"
            );
            assert_eq!(count(folder.path()), 2, "{ending} {what}: nothing else is left behind");
        }
    }
}

/// Changed bytes are detected anywhere, and the table is the same as without them.
#[test]
fn changed_bytes_are_found() {
    let folder = tempfile::tempdir().unwrap();
    let (whole, out) = (folder.path().join("whole.npy"), folder.path().join("out.npy"));
    hodograph().args(batch("8000", &whole)).assert().success();
    let change = |path: &Path, at: usize| {
        let mut bytes = fs::read(path).unwrap();
        let at = bytes.len() * at / 8;
        bytes[at] ^= 1;
        fs::write(path, bytes).unwrap();
    };
    let told = [
        (".part", 1, true),
        (".part", 4, true),
        (".part.journal", 7, false),
        (".part.journal", 2, false),
    ];
    for (ending, at, told) in told {
        killed(&out);
        change(&beside(&out, ending), at);
        let run = hodograph().args(batch("8000", &out)).assert().success();
        let said = text(&run.get_output().stderr);
        assert_eq!(said.contains("changed-bytes"), told, "{ending} {at}: {said}");
        assert!(
            fs::read(&out).unwrap() == fs::read(&whole).unwrap(),
            "{ending} {at}: the bytes differ"
        );
        fs::remove_file(&out).unwrap();
    }
    assert_eq!(count(folder.path()), 1, "nothing else is left behind");
}

#[test]
fn files_of_one_command_appear_together_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    for (command, barred, others) in [
        (
            "worksheet templates/shaper.json -o sheet.md",
            "sheet-mechanism.svg",
            &["sheet.md", "sheet-velocity.svg"][..],
        ),
        (
            "worksheet templates/shaper.json -o sheet.typ",
            "sheet.typ",
            &["sheet-mechanism.svg", "sheet-velocity.svg"],
        ),
        ("draw templates/shaper.json -o .", "shaper.png", &["shaper.svg"]),
        (
            "draw templates/shaper.json -o . --figure velocity,mechanism",
            "shaper-mechanism.svg",
            &["shaper-velocity.svg", "shaper-velocity.png"],
        ),
        (
            "animate templates/crank-rocker.json --frames 4 --dpi 40 -o turn.png",
            "turn-003.png",
            &["turn-001.png", "turn-002.png"],
        ),
    ] {
        // One of the names is taken by a folder; one of the other files already exists.
        fs::create_dir(at(barred)).unwrap();
        fs::write(at(others[0]), "before").unwrap();
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let words = command.split(' ').map(|w| {
            if w.starts_with("templates/") { root.join(w).display().to_string() } else { w.into() }
        });
        let run = hodograph().current_dir(folder.path()).args(words).assert().code(1);
        assert!(
            run.get_output().stdout.is_empty() && text(&run.get_output().stderr).contains(barred),
            "{command}"
        );
        assert_eq!(fs::read_to_string(at(others[0])).unwrap(), "before", "{command}");
        assert_eq!(count(folder.path()), 2, "{command}: nothing else appears");
        fs::remove_dir(at(barred)).unwrap();
        fs::remove_file(at(others[0])).unwrap();
    }
}

/// The next run removes the files of a killed run; those of a running one stay.
#[test]
fn the_next_run_clears_what_a_killed_one_left() {
    let folder = tempfile::tempdir().unwrap();
    let sweep = |out: &str| -> Vec<String> {
        let words = "sweep templates/crank-rocker.json --steps 400000 --find a_C -o";
        words
            .split(' ')
            .map(str::to_owned)
            .chain([folder.path().join(out).display().to_string()])
            .collect()
    };
    let begun = |n: usize| {
        while count(folder.path()) < n {
            std::thread::sleep(Duration::from_millis(1));
        }
    };
    let mut run = started(&sweep("killed.json"));
    begun(1);
    run.kill().unwrap();
    run.wait().unwrap();
    assert_eq!(count(folder.path()), 1, "nothing was left to clear");
    let mut live = started(&sweep("live.csv"));
    begun(1);
    while fs::read_dir(folder.path())
        .unwrap()
        .flatten()
        .all(|f| f.metadata().map_or(0, |m| m.len()) == 0)
    {
        std::thread::sleep(Duration::from_millis(1));
    }
    // A foreign file with a similar name stays.
    fs::write(folder.path().join(".hodograph-notes.tmp"), "mine").unwrap();
    hodograph()
        .args(["new", "crank-rocker", "-o"])
        .arg(folder.path().join("new.json"))
        .assert()
        .success();
    assert!(live.wait().unwrap().success());
    let mut names: Vec<String> = fs::read_dir(folder.path())
        .unwrap()
        .map(|f| f.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert_eq!(names, [".hodograph-notes.tmp", "live.csv", "new.json"]);
}

#[test]
fn endings_may_be_written_large() {
    let folder = tempfile::tempdir().unwrap();
    for (command, name, begins) in [
        ("draw templates/crank-rocker.json", "x.SVG", &b"<svg"[..]),
        ("draw templates/crank-rocker.json", "x.Png", b"\x89PNG"),
        ("draw templates/crank-rocker.json", "x.PDF", b"%PDF"),
        ("curves templates/crank-rocker.json", "c.SVG", b"<svg"),
        ("worksheet templates/crank-rocker.json", "x.HTML", b"<!DOCTYPE"),
        ("sweep templates/crank-rocker.json --find v_C", "x.NPY", b"\x93NUMPY"),
        (
            "batch templates/crank-rocker.json --vary l_BC=200..300:5 --find v_C",
            "x.Parquet",
            b"PAR1",
        ),
    ] {
        let out = folder.path().join(name);
        hodograph().args(command.split(' ')).arg("-o").arg(&out).assert().success();
        let mut first = vec![0; begins.len()];
        fs::File::open(&out).unwrap().read_exact(&mut first).unwrap();
        assert_eq!(first, begins, "{name}");
    }
    let style = folder.path().join("s.JSON");
    fs::File::create(&style).unwrap().write_all(b"{ \"base\": \"dark\" }").unwrap();
    let out = folder.path().join("dark.svg");
    hodograph()
        .args(["draw", "templates/crank-rocker.json", "--style"])
        .arg(style)
        .arg("-o")
        .arg(out)
        .assert()
        .success();
}

/// On a full disk, no part of an output remains.
#[test]
fn a_full_disk_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let root = env!("CARGO_MANIFEST_DIR");
    for (command, blocks) in [
        (format!("animate {root}/templates/crank-rocker.json --frames 6 --dpi 40 -o turn.png"), 0),
        (
            format!(
                "batch {root}/templates/crank-rocker.json --vary l_AB=60..100:4 --steps 20 --find a_C -o b.csv"
            ),
            0,
        ),
        (
            format!(
                "batch {root}/templates/crank-rocker.json --vary l_AB=60..100:40 --steps 200 --find a_C -o b.csv"
            ),
            2,
        ),
        (format!("draw {root}/templates/crank-rocker.json -o out.svg"), 1),
        (format!("cam {root}/templates/cam-offset-roller.json --profile p.csv"), 1),
        (format!("sweep {root}/templates/crank-rocker.json --steps 2000 -o s.csv"), 2),
        (format!("lesson {root}/templates/crank-rocker.json --positions 8 -o l.html"), 1),
    ] {
        // A file may have this number of blocks of 512 bytes; a full disk does not send the signal
        // of the shell's limit.
        let limited = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$0\" {command}");
        let run = std::process::Command::new("sh")
            .args(["-c", &limited, env!("CARGO_BIN_EXE_hodograph")])
            .current_dir(folder.path())
            .output();
        let run = run.unwrap();
        assert_eq!(run.status.code(), Some(1), "{command}: {}", text(&run.stderr));
        assert!(run.stdout.is_empty(), "{command}: {}", text(&run.stdout));
        assert_eq!(count(folder.path()), 0, "{command}: something is left behind");
    }
}
