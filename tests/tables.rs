//! Tables as files: the same numbers in every format, read by the readers of other programs; runs
//! that are interrupted, killed, or out of disk space leave nothing damaged, and the same command
//! continues them.

use assert_cmd::Command;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::time::Duration;

fn hodograph() -> Command {
    let mut c = Command::cargo_bin("hodograph").unwrap();
    c.current_dir(env!("CARGO_MANIFEST_DIR"));
    c
}

/// Labels and columns of a table.
type Read = (Vec<String>, Vec<Vec<f64>>);

fn from_csv(path: &Path) -> Read {
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_path(path).unwrap();
    let labels: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let mut columns = vec![Vec::new(); labels.len()];
    for row in reader.records() {
        row.unwrap().iter().zip(&mut columns).for_each(|(x, c)| c.push(x.parse().unwrap()));
    }
    (labels, columns)
}

/// A structured array as NumPy writes it: a Python literal of names, types and shape behind the
/// magic bytes, then the records.
fn from_npy(path: &Path) -> Read {
    let bytes = std::fs::read(path).unwrap();
    assert_eq!(&bytes[..8], b"\x93NUMPY\x02\x00");
    let begin = 12 + u32::from_le_bytes(bytes[8..12].try_into().unwrap()) as usize;
    assert_eq!(begin % 64, 0, "aligned");
    let header = std::str::from_utf8(&bytes[12..begin]).unwrap();
    let (fields, shape) = header
        .strip_prefix("{'descr': [")
        .unwrap()
        .split_once("], 'fortran_order': False, 'shape': (")
        .unwrap();
    let rows: usize = shape.split_once(",), }").unwrap().0.parse().unwrap();
    let fields: Vec<(&str, &str)> = fields
        .split("), ")
        .filter(|f| !f.is_empty())
        .map(|f| {
            f.strip_prefix("('").unwrap().strip_suffix('\'').unwrap().split_once("', '").unwrap()
        })
        .collect();
    assert_eq!(bytes.len() - begin, rows * fields.len() * 8, "one record a row");
    let mut columns = vec![Vec::with_capacity(rows); fields.len()];
    for record in bytes[begin..].chunks_exact(8 * fields.len()) {
        for ((x, (_, kind)), column) in record.chunks_exact(8).zip(&fields).zip(&mut columns) {
            let x: [u8; 8] = x.try_into().unwrap();
            column.push(match *kind {
                "<f8" => f64::from_le_bytes(x),
                "<i8" => i64::from_le_bytes(x) as f64,
                other => panic!("{other}"),
            });
        }
    }
    // Non-ASCII characters are escaped alike in Python and in JSON.
    let name = |name: &str| serde_json::from_str(&format!("\"{name}\"")).unwrap();
    (fields.iter().map(|(n, _)| name(n)).collect(), columns)
}

fn from_parquet(path: &Path) -> Read {
    let reader = SerializedFileReader::new(File::open(path).unwrap()).unwrap();
    let labels: Vec<String> = reader
        .metadata()
        .file_metadata()
        .schema_descr()
        .columns()
        .iter()
        .map(|c| c.name().to_owned())
        .collect();
    let mut columns = vec![Vec::new(); labels.len()];
    for row in reader {
        for ((_, field), column) in row.unwrap().get_column_iter().zip(&mut columns) {
            column.push(match field {
                Field::Double(x) => *x,
                Field::Long(x) => *x as f64,
                other => panic!("{other:?}"),
            });
        }
    }
    (labels, columns)
}

fn from_json(path: &Path) -> Read {
    let text = std::fs::read_to_string(path).unwrap();
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    let label = |c: &serde_json::Value| match c["unit"].as_str().unwrap() {
        "" => c["name"].as_str().unwrap().to_owned(),
        unit => format!("{} [{unit}]", c["name"].as_str().unwrap()),
    };
    // serde_json reads a number to within its last bit only.
    let numbers = |part: &str| {
        part.split(']').next().unwrap().split(',').map(|v| v.trim().parse().unwrap()).collect()
    };
    let columns = text.split("\"values\": [").skip(1).map(numbers).collect();
    (json["columns"].as_array().unwrap().iter().map(label).collect(), columns)
}

fn same(a: &Read, b: &Read) {
    assert_eq!(a.0, b.0);
    for ((name, x), y) in a.0.iter().zip(&a.1).zip(&b.1) {
        assert!(
            x.len() == y.len() && x.iter().zip(y).all(|(x, y)| x.to_bits() == y.to_bits()),
            "{name}"
        );
    }
}

fn key_values(path: &Path) -> Vec<(String, String)> {
    let reader = SerializedFileReader::new(File::open(path).unwrap()).unwrap();
    let values = reader.metadata().file_metadata().key_value_metadata().unwrap().clone();
    values.into_iter().map(|kv| (kv.key, kv.value.unwrap())).collect()
}

/// A rocker that does not turn fully, so that rows are missing; a question for the driver's angle,
/// so that a name occurs twice; and non-ASCII units.
#[test]
fn a_sweep_is_the_same_in_every_format() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.json");
    hodograph()
        .args(["new", "crank-rocker", "--set", "l_AB=240", "-o"])
        .arg(&scene)
        .assert()
        .success();
    let write = |ending: &str| {
        let path = folder.path().join(format!("table.{ending}"));
        hodograph()
            .args(["sweep", "--steps", "5000", "--find", "phi_1,a_C,omega_3", "-o"])
            .arg(&path)
            .arg(&scene)
            .assert()
            .success();
        path
    };
    let csv = from_csv(&write("csv"));
    assert_eq!(csv.0[..3], ["phi_1 [rad]", "phi_1 (2) [rad]", "a_C.x [m/s²]"], "{:?}", csv.0);
    assert!((1000..5001).contains(&csv.1[0].len()), "{} rows", csv.1[0].len());
    let (json, parquet) = (write("json"), write("parquet"));
    same(&csv, &from_json(&json));
    same(&csv, &from_npy(&write("npy")));
    same(&csv, &from_parquet(&parquet));
    // Data that the rows cannot express are in the file.
    let values = key_values(&parquet);
    let value = |key: &str| {
        &values.iter().find(|(k, _)| k == key).unwrap_or_else(|| panic!("no {key} in {values:?}")).1
    };
    assert!(
        value("title").contains("rank") && value("generator").starts_with("hodograph "),
        "{values:?}"
    );
    assert!(value("units").contains(r#""a_C.x [m/s²]":"m/s²""#), "{values:?}");
    let notes: Vec<serde_json::Value> = serde_json::from_str(value("notes")).unwrap();
    let document: serde_json::Value =
        serde_json::from_slice(&std::fs::read(json).unwrap()).unwrap();
    assert!(notes.len() >= 2 && document["notes"].as_array() == Some(&notes), "{notes:?}");
    let text = std::fs::read_to_string(folder.path().join("table.csv")).unwrap();
    let lines = text.lines().filter_map(|l| l.strip_prefix("# "));
    assert!(lines.eq(notes.iter().map(|n| n["message"].as_str().unwrap())), "{notes:?}");
}

/// The arguments of a batch with a first parameter that makes some of the mechanisms impossible.
fn batch(count: &str, out: &Path) -> Vec<String> {
    let words = format!(
        "batch templates/crank-rocker.json --vary l_AB=60..260 --vary l_BC=200..300 --random {count} --steps 199 --find a_C -o"
    );
    words.split_whitespace().map(str::to_owned).chain([out.display().to_string()]).collect()
}

#[test]
fn a_batch_is_the_same_in_every_format() {
    let folder = tempfile::tempdir().unwrap();
    let write = |ending: &str| {
        let path = folder.path().join(format!("designs.{ending}"));
        let run = hodograph().args(batch("2000", &path)).assert().success();
        (path, String::from_utf8_lossy(&run.get_output().stdout).into_owned())
    };
    let ((csv, said), (npy, _), (parquet, _)) = (write("csv"), write("npy"), write("parquet"));
    let table = from_csv(&csv);
    assert_eq!(table.0[..4], ["mechanism", "l_AB [m]", "l_BC [m]", "phi_1 [rad]"]);
    let rows = table.1[0].len();
    assert!(
        rows < 400_000
            && said.contains(&format!(
                "2000 mechanisms, {rows} rows, {} positions without one",
                400_000 - rows
            )),
        "{said}"
    );
    same(&table, &from_npy(&npy));
    same(&table, &from_parquet(&parquet));
    let missing = format!("{} positions have no row", 400_000 - rows);
    assert!(key_values(&parquet).iter().any(|(k, v)| k == "notes" && v.contains(&missing)));
    let reader = SerializedFileReader::new(File::open(parquet).unwrap()).unwrap();
    assert!(reader.metadata().num_row_groups() > 1, "written as it comes");
    // Repeated values are written once: a number of a mechanism takes a part of its eight bytes per
    // row.
    let size = |c: usize| {
        reader
            .metadata()
            .row_groups()
            .iter()
            .map(|g| g.column(c).compressed_size() as usize)
            .sum::<usize>()
    };
    assert!((0..4).all(|c| size(c) < 2 * rows) && size(4) > 7 * rows);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 3, "nothing else is left behind");
}

/// Starts a run, waits until `ready`, sends it a signal, and returns its exit code.
fn interrupted(arguments: &[String], signal: &str, ready: &dyn Fn() -> bool) -> Option<i32> {
    let mut run = std::process::Command::new(env!("CARGO_BIN_EXE_hodograph"));
    let mut run = run
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .stderr(std::process::Stdio::null())
        .spawn()
        .unwrap();
    while !ready() {
        if let Some(status) = run.try_wait().unwrap() {
            return status.code();
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    let sent =
        std::process::Command::new("kill").args([signal, &run.id().to_string()]).status().unwrap();
    assert!(sent.success());
    run.wait().unwrap().code()
}

fn lines(path: &Path) -> usize {
    std::fs::read(path).map_or(0, |b| b.iter().filter(|c| **c == b'\n').count())
}

#[cfg(unix)]
#[test]
fn an_interrupted_batch_goes_on_to_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    for ending in ["csv", "npy", "parquet"] {
        let at = |name: &str| folder.path().join(format!("{name}.{ending}"));
        let whole = std::fs::read({
            hodograph().args(batch("8000", &at("whole"))).assert().success();
            at("whole")
        });
        let out = at("out");
        let beside = |more: &str| PathBuf::from(format!("{}{more}", out.display()));
        let journal = beside(".part.journal");
        // On a request to stop, the run reports it; a killed run has no time to. A journal that
        // ends within a line belongs to a killed run.
        let code = interrupted(&batch("8000", &out), "-INT", &|| lines(&journal) >= 2);
        assert_eq!(code, Some(130), "{ending}");
        assert!(!out.exists() && beside(".part").exists() && lines(&journal) >= 2, "{ending}");
        let before = lines(&journal);
        let code = interrupted(&batch("8000", &out), "-KILL", &|| lines(&journal) > before);
        assert_eq!((code, out.exists()), (None, false), "{ending}");
        let left = std::fs::read(&journal).unwrap();
        std::fs::write(&journal, &left[..left.len() - 7]).unwrap();
        hodograph().args(batch("8000", &out)).assert().success();
        assert!(
            std::fs::read(&out).unwrap() == *whole.as_ref().unwrap(),
            "{ending}: the bytes differ"
        );
        assert!(!beside(".part").exists() && !journal.exists(), "{ending}");
        // Another job starts anew.
        let code = interrupted(&batch("8000", &out), "-KILL", &|| lines(&journal) >= 3);
        assert_eq!((code, journal.exists()), (None, true), "{ending}");
        hodograph().args(batch("100", &out)).assert().success();
        assert_eq!(from(ending, &out).1[0].iter().fold(0.0f64, |a, b| a.max(*b)), 99.0, "{ending}");
    }
}

fn from(ending: &str, path: &Path) -> Read {
    match ending {
        "csv" => from_csv(path),
        "npy" => from_npy(path),
        _ => from_parquet(path),
    }
}

/// With many pieces, and rows missing across their ends: the document equals that of a writer with
/// all data in memory.
#[test]
fn a_long_json_is_the_document_of_a_whole_one() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.json");
    hodograph()
        .args(["new", "crank-rocker", "--set", "l_AB=240", "-o"])
        .arg(&scene)
        .assert()
        .success();
    let write = |ending: &str| {
        let path = folder.path().join(format!("table.{ending}"));
        hodograph()
            .args(["sweep", "--steps", "140000", "--find", "a_C", "-o"])
            .arg(&path)
            .arg(&scene)
            .assert()
            .success();
        path
    };
    let (json, (labels, columns)) =
        (std::fs::read_to_string(write("json")).unwrap(), from_npy(&write("npy")));
    let title: serde_json::Value = serde_json::from_slice(&std::fs::read(&scene).unwrap()).unwrap();
    let part = |label: &str| {
        label
            .split_once(" [")
            .map(|(n, u)| (n.to_owned(), u.trim_end_matches(']').to_owned()))
            .unwrap()
    };
    let columns = labels.iter().zip(&columns).map(|(label, values)| {
        let (name, unit) = part(label);
        serde_json::json!({"name": name, "unit": unit, "values": values})
    });
    // The other formats give the notes too; they come last.
    let notes =
        json[json.rfind("\"notes\": ").unwrap() + 9..].trim_end().strip_suffix('}').unwrap();
    let notes: serde_json::Value = serde_json::from_str(notes).unwrap();
    assert!(notes.as_array().unwrap().len() >= 2, "{notes}");
    let document = serde_json::json!({
        "title": title["title"]["en"],
        "generator": concat!("hodograph ", env!("CARGO_PKG_VERSION")),
        "columns": columns.collect::<Vec<_>>(),
        "notes": notes,
    });
    assert!(
        json == format!("{document:#}\n"),
        "{} bytes against {}",
        json.len(),
        format!("{document:#}\n").len()
    );
}

/// The printed table equals the written one, with the notes first, although the rows are stored on
/// disk until the notes are known.
#[test]
fn a_long_sweep_is_printed_as_it_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let (scene, out) = (folder.path().join("rocker.json"), folder.path().join("out.csv"));
    // The crank stops twice on the way round.
    hodograph()
        .args(["new", "crank-rocker", "--set", "l_AB=240", "-o"])
        .arg(&scene)
        .assert()
        .success();
    let sweep = |more: &[&str]| {
        let mut c = hodograph();
        c.arg("sweep")
            .arg(&scene)
            .args(["--steps", "200000", "--find", "v_C,a_C"])
            .args(more)
            .assert()
            .success()
            .get_output()
            .stdout
            .clone()
    };
    sweep(&["-o", out.to_str().unwrap()]);
    let (printed, written) = (sweep(&[]), std::fs::read(out).unwrap());
    assert!(printed.starts_with(b"# ") && printed.len() > 9 << 20, "{} bytes", printed.len());
    assert!(printed == written);
}

/// A sweep is written under a temporary name: on a request to stop, this file is removed. By rows
/// and by columns; each row alone, from the one before it, or a mechanism for each.
#[cfg(unix)]
#[test]
fn an_interrupted_sweep_leaves_nothing() {
    let commands = [
        ("sweep templates/crank-rocker.json --steps 400000 --find a_C -o", "csv"),
        ("sweep templates/crank-rocker.json --steps 400000 --find a_C -o", "json"),
        ("sweep templates/class-iii-six-bar.json --steps 400000 --find omega_3 -o", "npy"),
        (
            "sweep templates/crank-rocker.json --over l_BC --from 200 --to 300 --steps 100000 --find a_C -o",
            "parquet",
        ),
    ];
    for (words, ending) in commands {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join(format!("long.{ending}"));
        let arguments: Vec<String> = words
            .split_whitespace()
            .map(str::to_owned)
            .chain([out.display().to_string()])
            .collect();
        let begun = || std::fs::read_dir(folder.path()).unwrap().count() > 0;
        // The writing may end before the signal arrives; then the file is complete.
        let stopped = (0..5).any(|_| {
            let code = interrupted(&arguments, "-INT", &begun);
            let left = std::fs::read_dir(folder.path()).unwrap().count();
            match code {
                Some(130) => assert_eq!(left, 0, "{words} {ending}"),
                _ => assert_eq!((code, left, out.exists()), (Some(0), 1, true), "{words} {ending}"),
            }
            let _ = std::fs::remove_file(&out);
            code == Some(130)
        });
        assert!(stopped, "{words} {ending}: five times too late");
    }
}

/// A limit on the size of files simulates a full disk: the system refuses to write in the middle of
/// the table.
#[cfg(unix)]
#[test]
fn a_full_disk_leaves_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let commands = ["csv", "json", "npy", "parquet"]
        .map(|e| ("sweep templates/crank-rocker.json --steps 20000 --find a_C", e))
        .into_iter();
    let batch = "batch templates/crank-rocker.json --vary l_BC=200..300:200 --steps 199 --find a_C";
    for (command, ending) in commands.chain(["csv", "npy", "parquet"].map(|e| (batch, e))) {
        let out = folder.path().join(format!("table.{ending}"));
        // 200 blocks of 512 or 1024 bytes. Without the trap, the signal of the refusal would end
        // the program first.
        let script = format!("trap '' XFSZ; ulimit -f 200; exec \"$0\" {command} -o \"$1\"");
        let mut run = Command::new("sh");
        let run = run
            .args(["-c", &script, env!("CARGO_BIN_EXE_hodograph")])
            .arg(&out)
            .current_dir(env!("CARGO_MANIFEST_DIR"));
        let said = String::from_utf8_lossy(&run.assert().code(1).get_output().stderr).into_owned();
        assert!(
            said.contains("cannot be written") && said.contains(&format!("table.{ending}")),
            "{said}"
        );
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "{command} {ending}");
    }
}

#[test]
fn places_and_names_that_cannot_be() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a-file");
    std::fs::write(&file, "kept").unwrap();
    let sweep = ["sweep", "templates/crank-rocker.json", "--steps", "10", "-o"];
    let batch = ["batch", "templates/crank-rocker.json", "--vary", "l_BC=200..300:3", "-o"];
    for ending in ["csv", "npy", "parquet"] {
        for command in [&sweep, &batch] {
            // The output needs a folder in place of a file.
            hodograph().args(command).arg(file.join(format!("inside.{ending}"))).assert().code(1);
        }
    }
    for (command, name, allowed) in [
        (&sweep, "table.xlsx", ".csv, .json, .npy, .parquet"),
        (&sweep, "table", ".csv, .json, .npy, .parquet"),
        (&batch, "designs.json", ".csv, .npy, .parquet"),
        (&batch, "parquet", ".csv, .npy, .parquet"),
    ] {
        let run = hodograph().args(command).arg(folder.path().join(name)).assert().code(2);
        let said = String::from_utf8_lossy(&run.get_output().stderr)
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" ");
        let said = said.replace("│ ", "");
        assert!(said.contains(allowed), "{said}");
    }
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "kept");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}
