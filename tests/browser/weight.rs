//! The scenes that have a lesson, and the size of its page.

use super::*;

/// Every template gets a lesson of at most 340 KiB, of which the letters take 25; 40 more where a
/// polygon is split, and 40 for each group of forces. A file without a mechanism gets none.
#[test]
fn every_template_has_a_lesson_of_some_size() {
    let mut sizes = Vec::new();
    for t in templates::list().iter().step_by(every(8)) {
        let scene = template(t.name);
        let page = lesson(&scene, &LessonOptions::of_language(Lang::Zh))
            .unwrap_or_else(|f| panic!("{}: {f}", t.name))
            .value;
        let (bytes, split) = (page.len(), page.contains("<figure id=\"acceleration-2\""));
        let groups = page.matches("<figure id=\"force-").count();
        assert!(
            bytes < (if split { 380 } else { 340 } + 40 * groups) * 1024,
            "{}: {bytes} bytes for {} links",
            t.name,
            scene.links.len()
        );
        sizes.push(bytes);
    }
    eprintln!(
        "lessons of {} to {} bytes",
        sizes.iter().min().unwrap(),
        sizes.iter().max().unwrap()
    );
    let folder = tempfile::tempdir().unwrap();
    for file in std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/bad")).unwrap() {
        let path = file.unwrap().path();
        if path.extension().is_some_and(|e| e == "json") {
            let hodograph = || assert_cmd::Command::cargo_bin("hodograph").unwrap();
            // A scene with answers next to a dead centre has a lesson too.
            if hodograph().arg("solve").arg(&path).output().unwrap().status.code() != Some(2) {
                continue;
            }
            let mut run = hodograph();
            run.arg("lesson")
                .arg(&path)
                .arg("-o")
                .arg(folder.path().join("lesson.html"))
                .assert()
                .code(2);
        }
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
