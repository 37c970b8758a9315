//! Each package of the workspace is complete: it holds the files that its sources include, and the
//! texts of its licences.

use super::codes::quoted;
use super::{finish, root, words};
use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;
use std::sync::LazyLock;

/// Macros that read a file when they are expanded.
const INCLUDES: [&str; 3] = ["include", "include_bytes", "include_str"];

/// The built page, which feature `page` puts into the program of a checkout; no package has it.
const PAGE: &str = "web/dist/hodograph.html";

/// The files that Cargo puts into each published package, by the package's folder from the project's root,
/// which is empty for the root package.
static PACKAGES: LazyLock<BTreeMap<String, BTreeSet<String>>> = LazyLock::new(|| {
    let members = ["crates", "."]
        .map(|folder| std::fs::read_dir(root().join(folder)).unwrap().map(|f| f.unwrap().path()));
    let members =
        members.into_iter().flatten().filter(|folder| folder.join("Cargo.toml").is_file());
    let folders = members
        .map(|folder| folder.strip_prefix(root()).unwrap().to_str().unwrap().replace('\\', "/"));
    let of = |folder: String| {
        let manifest = std::fs::read_to_string(root().join(&folder).join("Cargo.toml")).unwrap();
        if manifest.contains("\npublish = false\n") {
            return None;
        }
        let name =
            manifest.lines().find_map(|l| l.strip_prefix("name = ")).and_then(quoted).unwrap();
        let list = ["package", "--list", "--allow-dirty", "--offline", "--package", name];
        let run = Command::new(env!("CARGO")).args(list).current_dir(root()).output().unwrap();
        assert!(run.status.success(), "{folder}: {}", String::from_utf8_lossy(&run.stderr));
        let files = String::from_utf8(run.stdout).unwrap();
        Some((folder, files.lines().map(|f| f.replace('\\', "/")).collect()))
    };
    folders.chain([String::new()]).filter_map(of).collect()
});

/// The path of a file named relative to the folder of another; `None` if it leads out of the
/// package.
fn beside(file: &str, path: &str) -> Option<String> {
    let mut at: Vec<&str> = file.split('/').collect();
    at.pop();
    for part in path.split('/') {
        match part {
            "." => {}
            ".." => drop(at.pop()?),
            name => at.push(name),
        }
    }
    Some(at.join("/"))
}

/// The faults of a source's included files: each with its line and the path as written.
fn faults(file: &str, text: &str, package: &BTreeSet<String>) -> Vec<String> {
    let of = |(before, name, after): (&str, &str, &str)| {
        let argument = after.strip_prefix("!(").filter(|_| INCLUDES.contains(&name))?;
        let line = before.lines().count();
        let Some(path) = quoted(argument) else {
            return Some(format!("{line}: the path is not written out"));
        };
        match beside(file, path) {
            None => Some(format!("{line}: {path} leads out of the package")),
            Some(included) => (included != PAGE && !package.contains(&included))
                .then(|| format!("{line}: {path} is not in the package")),
        }
    };
    words(text).filter_map(of).collect()
}

#[test]
fn each_package_holds_what_it_includes() {
    assert!(PACKAGES.len() > 10 && PACKAGES.contains_key("templates"), "{:?}", PACKAGES.keys());
    let mut all = Vec::new();
    for (folder, files) in &*PACKAGES {
        let at = root().join(folder);
        for file in files.iter().filter(|f| f.ends_with(".rs")) {
            let text = std::fs::read_to_string(at.join(file)).unwrap();
            all.extend(
                faults(file, &text, files)
                    .into_iter()
                    .map(|fault| format!("{}:{fault}", at.join(file).display())),
            );
        }
    }
    finish(&all, "A package includes files of its own.");
}

#[test]
fn what_a_package_lacks_is_reported() {
    let package = BTreeSet::from(["src/a/b.rs".to_owned(), "fonts/a.ttf".to_owned()]);
    let told = |path: &str| {
        faults(
            "src/a/b.rs",
            &format!("\nconst A: &[u8] = {}!(\n    {path}\n);", INCLUDES[1]),
            &package,
        )
        .join("")
    };
    assert_eq!(told("\"../../fonts/a.ttf\""), "");
    assert_eq!(told("\"b.rs\""), "");
    assert_eq!(
        told("\"../../../fonts/a.ttf\""),
        "2: ../../../fonts/a.ttf leads out of the package"
    );
    assert_eq!(told("\"../fonts/a.ttf\""), "2: ../fonts/a.ttf is not in the package");
    assert_eq!(told("concat!(\"a\", \".ttf\")"), "2: the path is not written out");
}

/// Both licences require that their texts accompany every copy.
#[test]
fn each_package_holds_its_licences() {
    let mut faults = Vec::new();
    for (folder, files) in &*PACKAGES {
        for name in ["LICENSE-APACHE", "LICENSE-MIT"] {
            let of = |at: &str| std::fs::read(root().join(at).join(name)).ok();
            if !files.contains(name) || of(folder) != of("") {
                faults.push(format!("{folder}: copy {name} there"));
            }
        }
    }
    finish(&faults, "Each package holds the texts of its licences, those of the project.");
}
