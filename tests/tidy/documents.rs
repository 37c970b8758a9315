//! The documents: their links lead to files and headings that exist, and so do the paths that
//! docs/architecture.md names.

use super::{files, finish, root};
use std::path::{Component, Path, PathBuf};

/// The documents, as paths from the project's root with their texts.
fn documents() -> Vec<(String, String)> {
    let of_root = ["README.md", "CONTRIBUTING.md", "CHANGELOG.md"];
    let top =
        of_root.map(|name| (name.to_owned(), std::fs::read_to_string(root().join(name)).unwrap()));
    [top.to_vec(), files("docs", &["md"]), files("examples", &["md"])].concat()
}

/// Lines outside of blocks of code, with their numbers.
fn prose(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut code = false;
    (1..).zip(text.lines()).filter(move |(_, line)| {
        let fence = line.starts_with("```");
        code ^= fence;
        !code && !fence
    })
}

/// The anchor of a heading, as forges make it.
fn anchor(heading: &str) -> String {
    let kept = heading.trim().to_lowercase();
    kept.chars()
        .filter(|c| c.is_alphanumeric() || "-_ ".contains(*c))
        .map(|c| if c == ' ' { '-' } else { c })
        .collect()
}

/// A path without `.` and `..`.
fn plain(path: &Path) -> PathBuf {
    let mut out = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => drop(out.pop()),
            Component::CurDir => {}
            other => out.push(other),
        }
    }
    out
}

#[test]
fn links_of_documents_lead_somewhere() {
    let (mut faults, mut seen) = (Vec::new(), 0);
    for (name, text) in documents() {
        for (n, line) in prose(&text) {
            let targets = line.split("](").skip(1).filter_map(|rest| rest.split(')').next());
            for target in targets.filter(|t| !t.starts_with("http")) {
                seen += 1;
                let (file, heading) = target
                    .split_once('#')
                    .map_or((target, None), |(file, heading)| (file, Some(heading)));
                let at = if file.is_empty() {
                    root().join(&name)
                } else {
                    plain(&root().join(&name).with_file_name(file))
                };
                if !at.exists() {
                    faults.push(format!("{name}:{n}: {target}: there is no such file"));
                } else if let Some(heading) = heading {
                    let page = std::fs::read_to_string(&at).unwrap();
                    let found = prose(&page).any(|(_, l)| {
                        l.starts_with('#') && anchor(l.trim_start_matches('#')) == heading
                    });
                    if !found {
                        faults.push(format!("{name}:{n}: {target}: there is no such heading"));
                    }
                }
            }
        }
    }
    assert!(seen > 50, "only {seen} links were found");
    finish(&faults, "Links between documents lead to files and headings that exist.");
}

#[test]
fn the_architecture_names_files_that_exist() {
    let page = std::fs::read_to_string(root().join("docs/architecture.md")).unwrap();
    let folders = ["crates/", "src/", "tests/", "templates/", "docs/"];
    let paths: Vec<_> = page
        .split('`')
        .skip(1)
        .step_by(2)
        .filter(|t| folders.iter().any(|f| t.starts_with(f)) && !t.contains(' '))
        .collect();
    assert!(paths.len() > 50, "only {} paths were found", paths.len());
    let gone = paths.iter().filter(|path| !root().join(path).exists());
    finish(
        &gone.map(|path| format!("docs/architecture.md: {path}")).collect::<Vec<_>>(),
        "The architecture names files that exist.",
    );
}

/// The table of crates beside the manifests.
#[test]
fn the_architecture_knows_the_crates() {
    let page = std::fs::read_to_string(root().join("docs/architecture.md")).unwrap();
    let mut faults = Vec::new();
    for folder in
        std::fs::read_dir(root().join("crates")).unwrap().map(|entry| entry.unwrap().path())
    {
        let name = folder.file_name().unwrap().to_str().unwrap().to_owned();
        let manifest = std::fs::read_to_string(folder.join("Cargo.toml")).unwrap();
        let section = manifest
            .split("[dependencies]")
            .nth(1)
            .unwrap_or_default()
            .split("\n[")
            .next()
            .unwrap_or_default();
        let mut needed: Vec<&str> = section
            .lines()
            .filter_map(|l| l.strip_prefix("hodograph-"))
            .filter_map(|l| l.split('.').next())
            .collect();
        let row =
            page.lines().find(|l| l.starts_with(&format!("| `{name}` |"))).unwrap_or_default();
        let cell = row.split('|').nth(2).unwrap_or_default();
        let mut told: Vec<&str> = cell.split([',', ' ']).filter(|w| !w.is_empty()).collect();
        needed.sort_unstable();
        told.sort_unstable();
        if needed != told {
            faults.push(format!(
                "docs/architecture.md: {name} depends on {}, not on {}",
                needed.join(", "),
                told.join(", ")
            ));
        }
    }
    finish(&faults, "The table of crates in docs/architecture.md says what each depends on.");
}
