//! Worksheets with questions on concepts.

use super::hodograph;

fn sheet(scene: &str, more: &[&str]) -> String {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("q.md").display().to_string();
    let args = ["worksheet", scene, "--questions", "-o", &path];
    hodograph().args(args).args(more).assert().success();
    std::fs::read_to_string(&path).unwrap()
}

/// A shaper has six links: 15 centres, and five of them belong to the ground.
#[test]
fn centres_are_counted_and_the_absolute_ones_are_those_of_the_ground() {
    let answers = sheet("templates/shaper.json", &["--solution"]);
    assert!(answers.contains("$N(N-1)/2=15$"), "{answers}");
    let absolute = answers.lines().find(|l| l.starts_with("Absolute: ")).unwrap();
    let (own, _) = absolute.split_once(';').unwrap();
    let names: Vec<&str> = own.trim_start_matches("Absolute: ").split(", ").collect();
    assert_eq!(names.len(), 5, "{absolute}");
    assert!(names.iter().all(|n| n.contains('6')), "{absolute}");
    assert!(answers.contains("class II."), "{answers}");
    assert!(answers.contains("3\\times5-(2\\times7+0-0)-0=1"), "{answers}");
}

/// The Coriolis acceleration of the shaper's block is zero in four poses: where crank and lever are
/// in line nothing slides, where the lever is at its limits it does not turn.
#[test]
fn the_coriolis_part_is_judged_in_general_and_in_the_pose() {
    let shaper = "templates/shaper.json";
    let limit = format!("{:?}", 180.0 + (110.0_f64 / 380.0).asin().to_degrees());
    for (phi, words) in [
        ("20", "in this pose neither is zero"),
        ("90", "the point does not slide along the guide here"),
        ("270", "the point does not slide along the guide here"),
        (limit.as_str(), "the angular velocity of the guide is zero here"),
    ] {
        let answers = sheet(shaper, &["--set", &format!("phi_1={phi}"), "--solution"]);
        assert!(answers.contains(words), "{phi}: {answers}");
        assert!(answers.contains("the guide is fixed"), "{phi}: {answers}");
    }
}

/// The problem holds the questions and no answer; both languages.
#[test]
fn the_problem_tells_no_answer() {
    let problem = sheet("templates/shaper.json", &["--problem-only", "--lang", "zh"]);
    assert!(problem.contains("其中哪些是绝对瞬心") && problem.contains("有无科氏加速度"));
    assert!(!problem.contains("绝对瞬心：") && !problem.contains("=15"), "{problem}");
    // A yoke that only translates: no point of it is needed to see that it does not turn.
    let yoke = sheet("templates/scotch-yoke.json", &["--solution", "--lang", "zh"]);
    assert!(yoke.contains("没有：导路作平移，其角速度恒为零。"), "{yoke}");
}
