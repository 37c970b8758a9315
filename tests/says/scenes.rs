//! The scenes that are swept, and all their possible questions.

use hodograph::diag::Faults;
use hodograph::mechanism::Mechanism;
use hodograph::position;
use hodograph::scene::{self, LinkId, PointId, Scene, templates};
use serde_json::{Value as Json, json};

/// The templates, the cases, the problems, and scenes with past faults in sweeps.
pub fn scenes() -> Vec<(String, Json)> {
    let read = |path: &str| std::fs::read_to_string(path).unwrap();
    let parsed = |text: &str| serde_json::from_str::<Json>(text).unwrap();
    let root = env!("CARGO_MANIFEST_DIR");
    let files = |folder: &str| {
        let all = std::fs::read_dir(format!("{root}/{folder}")).unwrap().map(|f| f.unwrap().path());
        let mut files: Vec<_> =
            all.filter(|p| p.extension().is_some_and(|e| e == "json")).collect();
        files.sort();
        files
    };
    let mut out: Vec<(String, Json)> = templates::list()
        .iter()
        .map(|t| (t.name.to_owned(), parsed(templates::get(t.name).unwrap())))
        .collect();
    for path in files("tests/cases") {
        let case = parsed(&read(path.to_str().unwrap()));
        if case["scene"].is_object() {
            out.push((
                format!("cases/{}", path.file_stem().unwrap().display()),
                case["scene"].clone(),
            ));
        }
    }
    for file in ["motion", "centres"] {
        for problem in
            parsed(&read(&format!("{root}/tests/problems/{file}.json"))).as_array().unwrap()
        {
            out.push((
                format!("problems/{}", problem["name"].as_str().unwrap()),
                problem["scene"].clone(),
            ));
        }
    }
    for path in files("tests/says") {
        out.push((
            format!("says/{}", path.file_stem().unwrap().display()),
            parsed(&read(path.to_str().unwrap())),
        ));
    }
    out
}

pub fn read(json: &Json, find: &[String]) -> Result<Scene, Faults> {
    let mut json = json.clone();
    json["find"] = json!(find);
    let scene = scene::read(json.to_string())?.value;
    Mechanism::new(&scene).map(|_| scene)
}

/// Every possible question of the scene: all symbols, with all points, links, pairs and frames that
/// they accept.
pub fn askable(json: &Json, plain: &Scene) -> Vec<String> {
    // Not the points of the equivalent linkage of a cam, which is another one on every piece.
    let file = json.to_string();
    let own = |name: &&str| plain.cams.is_empty() || is_named(&file, name);
    let points: Vec<&str> = plain.points.iter().map(|p| p.name.as_str()).filter(own).collect();
    let links: Vec<&str> = plain.links.iter().map(|l| l.name.as_str()).collect();
    let mut all: Vec<String> = plain.find.iter().map(|f| f.text.clone()).collect();
    let mut ask =
        |symbols: &[&str], of: &str| all.extend(symbols.iter().map(|s| format!("{s}_{of}")));
    for p in &points {
        ask(&["x", "y", "v", "a", "rho", "O", "gamma"], p);
        for q in points.iter().filter(|q| *q > p) {
            ask(&["l", "v", "a", "an", "at"], &format!("{p}{q}"));
        }
        let on: Vec<&str> = links
            .iter()
            .copied()
            .filter(|l| {
                plain
                    .links
                    .iter()
                    .any(|k| k.name == *l && k.points.iter().any(|q| plain.point_name(*q) == *p))
            })
            .collect();
        for l in &links {
            ask(&["v", "a"], &format!("{p}{l}"));
            ask(
                &["ve", "vr", "ae", "aen", "aet", "ar", "arn", "art", "ak", "path"],
                &format!("{p}/{l}"),
            );
            for k in links.iter().filter(|k| *k != l && on.contains(k)) {
                ask(&["vr", "ar", "ak"], &format!("{p}{k}{p}{l}"));
            }
        }
    }
    for l in &links {
        ask(
            &[
                "phi", "omega", "alpha", "J", "d", "K", "u", "p", "s", "psi", "h", "Psi", "Phi",
                "pressure", "rho_min", "spin",
            ],
            l,
        );
        for k in links.iter().filter(|k| *k != l) {
            ask(&["omega", "alpha", "rho"], &format!("{l}/{k}"));
            if k > l {
                ask(&["P", "i"], &format!("{l}{k}"));
            }
        }
    }
    all.retain(|q| !is_of_no_line(plain, q, &file));
    all.sort();
    all.dedup();
    let mut out = Vec::new();
    taken(json, all, &mut out);
    out
}

/// True if a link has a line. A link without one, such as a wheel, has the direction of the plane
/// in every written scene, and turns in a sweep.
pub fn has_line(scene: &Scene, l: LinkId, file: &str) -> bool {
    let own = |p: &&PointId| scene.cams.is_empty() || is_named(file, scene.point_name(**p));
    let touches = scene.cams.iter().any(|c| c.cam == l || c.follower == l);
    scene.links[l.0].points.iter().filter(own).count() > 1
        || !touches && position::guide_of(scene, l).is_some()
}

/// True if a file names a point, alone or in a pair of points.
pub fn is_named(file: &str, point: &str) -> bool {
    file.contains(&format!("\"{point}\""))
}

/// True if a question refers to the axes of a link that has no line.
pub fn is_of_no_line(scene: &Scene, question: &str, file: &str) -> bool {
    let Some((symbol, of)) = question.split_once('_') else { return false };
    let link = match symbol {
        "phi" | "p" => of,
        "path" => of.split_once('/').map_or(of, |(_, frame)| frame),
        _ => return false,
    };
    (0..scene.links.len())
        .map(LinkId)
        .any(|l| scene.link_name(l) == link && !has_line(scene, l, file))
}

/// The questions of a list that the scene accepts.
pub fn taken(json: &Json, mut all: Vec<String>, out: &mut Vec<String>) {
    if all.is_empty() {
        return;
    }
    if read(json, &all).is_ok() {
        out.append(&mut all);
    } else if all.len() > 1 {
        let rest = all.split_off(all.len() / 2);
        taken(json, all, out);
        taken(json, rest, out);
    }
}
