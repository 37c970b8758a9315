//! Batches in parts: the same bytes for any number of shards, whatever is interrupted or damaged.

use super::{hodograph, started, text};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::time::Duration;

/// 400 mechanisms, some of which are impossible, in parts of 40.
const PARTS: u64 = 10;

fn batch(shard: &str, out: &Path) -> Vec<String> {
    let words = format!(
        "batch templates/crank-rocker.json --vary l_AB=60..260 --vary l_BC=200..300 --random 400 --steps 36 --find a_C {shard} -o"
    );
    words.split_whitespace().map(str::to_owned).chain([out.display().to_string()]).collect()
}

fn shard(format: &str, number: u64, of: u64, out: &Path) -> Vec<String> {
    batch(&format!("--format {format} --per-part 40 --shard {number}/{of}"), out)
}

/// Standard output of `shards`, with the expected exit code.
fn shards(action: &str, folder: &Path, more: &[&str], code: i32) -> String {
    let run = hodograph().args(["shards", action]).arg(folder).args(more).assert().code(code);
    text(&run.get_output().stdout)
}

/// Names and bytes of a folder's files.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entry =
        |e: fs::DirEntry| (e.file_name().into_string().unwrap(), fs::read(e.path()).unwrap());
    fs::read_dir(folder).unwrap().map(|e| entry(e.unwrap())).collect()
}

#[test]
fn parts_are_the_same_for_any_number_of_shards_and_join_to_the_table_of_one_run() {
    let folder = tempfile::tempdir().unwrap();
    for format in ["csv", "npy", "parquet"] {
        let at = |name: &str| folder.path().join(format!("{name}.{format}"));
        hodograph().args(batch("", &at("whole"))).assert().success();
        let mut known = None;
        for of in [1, 3, 12] {
            let parts = folder.path().join(format!("{format}{of}"));
            for number in (1..=of).rev() {
                let run = hodograph()
                    .env("RAYON_NUM_THREADS", (1 + number % 2).to_string())
                    .args(shard(format, number, of, &parts))
                    .assert()
                    .success();
                let count = (PARTS + of - number) / of;
                let said = text(&run.get_output().stdout);
                assert!(said.contains(&format!(", {count} of {PARTS} parts:")), "{said}");
            }
            assert_eq!(shards("missing", &parts, &[], 0), "");
            let verified = shards("verify", &parts, &[], 0);
            assert!(verified.contains("10 parts, 0 missing, 0 damaged"), "{verified}");
            let made = files(&parts);
            assert_eq!(made.len() as u64, 2 * PARTS + 1, "nothing else is left behind");
            assert!(known.get_or_insert_with(|| made.clone()) == &made, "{format}, {of} shards");
            let out = at(&format!("joined{of}"));
            let said = shards("compact", &parts, &["-o", &out.display().to_string()], 0);
            // One block in one run, ten parts here: row groups differ, rows do not.
            assert!(said.contains("400 mechanisms"), "{said}");
            let same = fs::read(&out).unwrap() == fs::read(at("whole")).unwrap();
            assert!(same || format == "parquet", "{format}, {of} shards: another table");
        }
    }
    // In parts of whole blocks, Parquet is the same, too.
    let (whole, parts) = (folder.path().join("whole.parquet"), folder.path().join("blocks"));
    hodograph().args(batch("--shard 1/1", &parts)).assert().success();
    let out = folder.path().join("joined.parquet");
    shards("compact", &parts, &["-o", &out.display().to_string()], 0);
    assert!(fs::read(out).unwrap() == fs::read(whole).unwrap(), "another table");
}

/// Tasks that are killed at any moment and started again, also between the two renamings.
#[test]
fn killed_tasks_repeat_to_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let (whole, parts) = (folder.path().join("whole"), folder.path().join("parts"));
    hodograph().args(shard("npy", 1, 1, &whole)).assert().success();
    for round in 0..12 {
        let mut tasks: Vec<_> = (1..=2).map(|i| started(&shard("npy", i, 2, &parts))).collect();
        std::thread::sleep(Duration::from_millis(20 + 17 * round));
        for task in &mut tasks {
            let _ = task.kill();
            task.wait().unwrap();
        }
    }
    for number in 1..=2 {
        hodograph().args(shard("npy", number, 2, &parts)).assert().success();
    }
    assert!(files(&parts) == files(&whole), "the bytes differ");
    let journal = |ending: &str| parts.join(format!("part-000003.npy{ending}"));
    fs::rename(journal(".journal"), journal(".part.journal")).unwrap();
    fs::remove_file(parts.join("part-000006.npy")).unwrap();
    assert_eq!(shards("missing", &parts, &[], 0), "3,6\n");
    assert_eq!(shards("missing", &parts, &["--of", "4"], 0), "3-4\n");
    for number in 1..=2 {
        hodograph().args(shard("npy", number, 2, &parts)).assert().success();
    }
    assert!(files(&parts) == files(&whole), "the bytes differ");
}

#[test]
fn damaged_parts_are_found_removed_and_computed_again() {
    let folder = tempfile::tempdir().unwrap();
    let parts = folder.path().join("parts");
    hodograph().args(shard("parquet", 1, 1, &parts)).assert().success();
    let sound = files(&parts);
    let change = |part: u64, at: fn(usize) -> usize| {
        let path = parts.join(format!("part-{part:06}.parquet"));
        let mut bytes = fs::read(&path).unwrap();
        let at = at(bytes.len());
        bytes[at] ^= 4;
        fs::write(&path, bytes).unwrap();
    };
    // In the beginning, the rows, and the footer; a byte more at the end.
    change(1, |_| 0);
    change(4, |length| length / 2);
    change(5, |length| length - 9);
    let path = parts.join("part-000007.parquet");
    fs::write(&path, [&fs::read(&path).unwrap()[..], b"x"].concat()).unwrap();
    let said = shards("verify", &parts, &[], 1);
    assert!(said.contains("0 missing, 4 damaged"), "{said}");
    let out = folder.path().join("all.parquet");
    let refused = |code: i32, words: &str| {
        let mut join = hodograph();
        let run = join.args(["shards", "compact"]).arg(&parts).arg("-o").arg(&out).assert();
        let said = text(&run.code(code).get_output().stderr);
        assert!(said.contains(words), "{said}");
    };
    refused(1, "part-000004.parquet is damaged");
    assert!(!out.exists(), "no half table");
    shards("verify", &parts, &["--remove-damaged"], 1);
    assert_eq!(shards("missing", &parts, &[], 0), "1,4-5,7\n");
    refused(2, "4 of 10 parts are missing");
    hodograph().args(shard("parquet", 1, 1, &parts)).assert().success();
    assert!(files(&parts) == sound, "the bytes differ");
}

#[test]
fn a_folder_keeps_to_its_batch() {
    let folder = tempfile::tempdir().unwrap();
    let parts = folder.path().join("parts");
    hodograph().args(shard("csv", 1, 4, &parts)).assert().success();
    let refused = |arguments: &[&str], words: &str| {
        let run = hodograph().args(arguments).assert().code(2);
        let said = text(&run.get_output().stderr);
        assert!(said.contains(words), "{arguments:?}: {said}");
    };
    let name = parts.display().to_string();
    let other = shard("csv", 1, 4, &parts);
    for (from, to) in [("--per-part", "41"), ("--random", "401"), ("--format", "npy")] {
        let at = other.iter().position(|a| a == from).unwrap() + 1;
        let mut other: Vec<&str> = other.iter().map(String::as_str).collect();
        other[at] = to;
        refused(&other, "holds the parts of another batch");
    }
    for bad in ["0/4", "5/4", "1", "a/b", "1/0"] {
        let other = batch(&format!("--shard {bad}"), &parts);
        refused(&other.iter().map(String::as_str).collect::<Vec<_>>(), "write I/N");
    }
    let table = folder.path().join("t.csv");
    let table = batch("--shard 1/2", &table);
    refused(&table.iter().map(String::as_str).collect::<Vec<_>>(), "is no name of a folder");
    refused(&["shards", "verify", "templates"], "makes such a folder");
    refused(&["shards", "compact", &name, "-o", "x.parquet"], "ends in .parquet");
    let description = parts.join("batch.json");
    let text = fs::read_to_string(&description).unwrap();
    for (from, to, words) in [
        ("\"generator\": \"hodograph", "\"generator\": \"hodograph 9", "the parts are of"),
        ("\"format\": \"csv\"", "\"format\": \"exe\"", "is damaged"),
        ("\"mechanisms_per_part\": 40", "\"mechanisms_per_part\": 0", "is damaged"),
        ("\"seed\"", "\"sead\"", "cannot be read"),
        ("\"scene\": \"{", "\"scene\": \"[", "batch.json"),
    ] {
        assert!(text.contains(from), "{from}");
        fs::write(&description, text.replace(from, to)).unwrap();
        refused(&["shards", "missing", &name], words);
    }
}
