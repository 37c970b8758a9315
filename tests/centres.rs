//! Instantaneous centres: the cases against places that were computed without this project, the
//! eight-bars that stall, and the message where lines coincide.

use hodograph::answer::AnswerValue;
use hodograph::centres::{
    CentreMotionSource, CentrePlace, Centres, Origin, Undetermined, centres, closure, count,
};
use hodograph::certified::certify;
use hodograph::diag::Warned;
use hodograph::geom::Vec2;
use hodograph::scene::{self, LinkId, Scene, edit, templates};
use hodograph::worked::{Scope, work};
use serde_json::{Value as Json, json};
use std::collections::BTreeMap;

fn read(text: &str) -> Scene {
    scene::read(text).unwrap_or_else(|f| panic!("{f}\n{text}")).value
}

fn link(scene: &Scene, name: &str) -> LinkId {
    LinkId(
        scene.links.iter().position(|l| l.name == name).unwrap_or_else(|| panic!("no link {name}")),
    )
}

fn number(v: &Json) -> f64 {
    v.as_str()
        .map_or_else(|| v.as_f64(), |s| s.parse().ok())
        .unwrap_or_else(|| panic!("not a number: {v}"))
}

/// The expected quantity of a centre, in its unit.
fn answer(scene: &Scene, found: &Centres, e: &Json) -> f64 {
    let [i, j] = [0, 1].map(|k| link(scene, e["pair"][k].as_str().unwrap()));
    let centre = found.of(i, j).expect("every pair has a centre");
    let place =
        centre.place.unwrap_or_else(|| panic!("{} has no place", centre.step.pair.name(scene)));
    let component = e["component"].as_str().unwrap();
    let scale = number(&e["scale"]);
    match (component, place) {
        ("x", CentrePlace::At(p)) => p.x * scale,
        ("y", CentrePlace::At(p)) => p.y * scale,
        ("direction", CentrePlace::Infinity(u)) => u.angle().to_degrees(),
        ("distance", CentrePlace::At(p)) => {
            let from = scene
                .points
                .iter()
                .position(|q| Some(q.name.as_str()) == e["from"].as_str())
                .expect("a point");
            p.distance(found.worked.configuration.points[from].unwrap()) * scale
        }
        ("ratio", CentrePlace::At(_)) => {
            match found.uses.links.iter().find(|t| t.link == i).map(|t| t.by) {
                Some(CentreMotionSource::Ratio { link, of_other, own }) if link == j => {
                    of_other / own
                }
                by => panic!("the rate of {} comes by {by:?}", scene.link_name(i)),
            }
        }
        _ => panic!("{component} of {place:?}"),
    }
}

#[test]
fn centres_of_the_reference_cases() {
    let (mut values, mut faults) = (0, Vec::new());
    let mut files: Vec<_> = std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/cases"))
        .unwrap()
        .map(|f| f.unwrap().path())
        .collect();
    files.sort();
    for path in files {
        let case: Json = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
        let Some(expected) = case["centres"].as_array() else { continue };
        let id = path.file_stem().unwrap().to_string_lossy().into_owned();
        let scene = read(&case["scene"].to_string());
        let found = centres(&scene).unwrap_or_else(|f| panic!("{id}: {f}")).value;
        let counts = json!({"all": found.list.len(), "alone": found.closure.alone});
        if counts != case["counts"] {
            faults.push(format!("{id}: {counts}, expected {}", case["counts"]));
        }
        for e in expected {
            let (got, exact) = (answer(&scene, &found, e), number(&e["exact"]));
            let size = if e["size"].is_null() { exact.abs() } else { number(&e["size"]) };
            // A direction leads to infinity in either sense.
            let turned = if e["component"] == "direction" { 180.0 } else { f64::INFINITY };
            let off = (got - exact).abs() % turned;
            let off = off.min(turned - off) / size;
            values += 1;
            if off.is_nan() || off > number(&e["tolerance"]) {
                faults.push(format!("{id} {}: {got}, expected {exact}, off by {off:e}", e["name"]));
            }
        }
        if found.worst_residual() > 1e-11 || found.worst_triple > 1e-11 {
            faults.push(format!(
                "{id}: residual {:e}, triple {:e}",
                found.worst_residual(),
                found.worst_triple
            ));
        }
    }
    println!("{values} values of centres");
    assert!(values > 140, "only {values} values");
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

/// Case `seed-000-ic-count`: three, six, ten and fifteen; three of a four-bar are absolute.
#[test]
fn counts_of_centres() {
    assert_eq!([3, 4, 5, 6].map(count), [3, 6, 10, 15]);
    let scene = read(templates::get("crank-rocker").unwrap());
    let closure = closure(&scene).unwrap();
    assert_eq!(closure.steps.len(), count(4));
    assert_eq!(closure.steps.iter().filter(|s| s.pair.has(scene.ground)).count(), 3);
}

/// The order of finding belongs to the plan: lengths, angles and speeds do not change it.
#[test]
fn the_order_of_finding_is_topology() {
    let text = templates::get("shaper").unwrap();
    let order = |text: &str| closure(&read(text)).unwrap();
    let other = edit::with_parameters(text, &[("phi_1", "250"), ("l_O1A", "70"), ("l_O2B", "700")])
        .unwrap();
    assert_eq!(order(text), order(&other));
    assert!(order(text) != order(templates::get("whitworth").unwrap()));
}

/// The chains of eight links and ten pins with one degree of freedom: sixteen. The theorem stalls
/// on two of them: on the double butterfly, where it finds only the pins, and on the single flier,
/// where it finds two more. One centre from velocities closes each.
///
/// # Source
/// Sixteen: F. Crossley, 1964. Two: D. Foster, G. Pennock, ASME J. Mech. Des. 127 (2005) 249.
#[test]
fn two_of_sixteen_eight_bars_stall() {
    let mut classes: BTreeMap<Vec<u8>, (usize, usize)> = BTreeMap::new();
    for degrees in [[3, 3, 3, 3, 2, 2, 2, 2], [4, 3, 3, 2, 2, 2, 2, 2], [4, 4, 2, 2, 2, 2, 2, 2]] {
        let mut chains = Vec::new();
        grow(&mut [[false; 8]; 8], degrees, &mut chains);
        let orders = permutations_within(&degrees);
        for chain in chains {
            if !moves_as_one(&chain) {
                continue;
            }
            // The smallest of its adjacency tables names the class.
            let table = |order: &[usize; 8]| {
                (0..8)
                    .map(|a| {
                        (0..8).fold(0u8, |row, b| row << 1 | u8::from(chain[order[a]][order[b]]))
                    })
                    .collect::<Vec<u8>>()
            };
            let name = orders.iter().map(table).min().unwrap();
            classes.entry(name).or_insert_with(|| {
                let closure = closure(&read(&eight_bar(&chain)))
                    .unwrap_or_else(|f| panic!("{f}\n{}", eight_bar(&chain)));
                assert_eq!((closure.steps.len(), closure.primary), (28, 10));
                let [by_theorem, taken] = closure.found_by();
                assert_eq!(10 + by_theorem + taken, 28, "every centre has one way");
                assert_eq!(taken, usize::from(closure.stalled()), "one centre more closes it");
                (closure.alone - closure.primary, taken)
            });
        }
    }
    assert_eq!(classes.len(), 16);
    let mut stalled: Vec<usize> = classes.values().filter(|c| c.1 > 0).map(|c| c.0).collect();
    stalled.sort_unstable();
    assert_eq!(stalled, [0, 2], "centres that the theorem finds before it stalls");
}

type Chain = [[bool; 8]; 8];

/// All graphs with these degrees left: the first link that lacks neighbours takes one after it.
fn grow(chain: &mut Chain, left: [usize; 8], out: &mut Vec<Chain>) {
    let Some(a) = left.iter().position(|d| *d > 0) else {
        out.push(*chain);
        return;
    };
    // Neighbours are taken in rising order, so that each graph comes once.
    let last = (0..8).rev().find(|b| *b > a && chain[a][*b]).unwrap_or(a);
    for b in last + 1..8 {
        if left[b] > 0 {
            (chain[a][b], chain[b][a]) = (true, true);
            let mut less = left;
            less[a] -= 1;
            less[b] -= 1;
            grow(chain, less, out);
            (chain[a][b], chain[b][a]) = (false, false);
        }
    }
}

/// Every part of it has a freedom, and no single link separates it.
fn moves_as_one(chain: &Chain) -> bool {
    let joints = |part: u32| {
        let inside = |k: usize| part >> k & 1 == 1;
        (0..8)
            .flat_map(|a| (a + 1..8).map(move |b| (a, b)))
            .filter(|(a, b)| inside(*a) && inside(*b) && chain[*a][*b])
            .count()
    };
    let rigid = (1u32..255).any(|part| {
        let n = part.count_ones() as usize;
        n >= 3 && 3 * (n - 1) <= 2 * joints(part)
    });
    let connected_without = |gone: usize| {
        let start = usize::from(gone == 0);
        let (mut seen, mut open) = (1u32 << start, vec![start]);
        while let Some(a) = open.pop() {
            for b in (0..8).filter(|b| chain[a][*b] && *b != gone) {
                if seen >> b & 1 == 0 {
                    seen |= 1 << b;
                    open.push(b);
                }
            }
        }
        seen.count_ones() == 7
    };
    !rigid && (0..8).all(connected_without)
}

/// The orders of the links that keep the degrees.
fn permutations_within(degrees: &[usize; 8]) -> Vec<[usize; 8]> {
    fn fill(
        k: usize,
        order: &mut [usize; 8],
        used: &mut [bool; 8],
        degrees: &[usize; 8],
        out: &mut Vec<[usize; 8]>,
    ) {
        if k == 8 {
            out.push(*order);
            return;
        }
        for a in 0..8 {
            if !used[a] && degrees[a] == degrees[k] {
                used[a] = true;
                order[k] = a;
                fill(k + 1, order, used, degrees, out);
                used[a] = false;
            }
        }
    }
    let mut out = Vec::new();
    fill(0, &mut [0; 8], &mut [false; 8], degrees, &mut out);
    out
}

/// A scene of a chain: its last link is the ground, and one of the neighbours of this link drives.
fn eight_bar(chain: &Chain) -> String {
    let mut links: Vec<Vec<String>> = vec![Vec::new(); 8];
    let mut points = serde_json::Map::new();
    for a in 0..8 {
        for b in a + 1..8 {
            if chain[a][b] {
                let k = points.len() as f64;
                let name = format!("J{}", "abcdefghij".chars().nth(points.len()).unwrap());
                points.insert(
                    name.clone(),
                    json!([(k * 37.0) % 11.0, (k * k * 13.0) % 17.0 + k / 7.0]),
                );
                links[a].push(name.clone());
                links[b].push(name);
            }
        }
    }
    let driver = (0..8).find(|a| chain[*a][7]).unwrap();
    let links: serde_json::Map<String, Json> =
        links.into_iter().enumerate().map(|(k, p)| ((k + 1).to_string(), json!(p))).collect();
    json!({"units": {"length": "m"}, "links": links, "ground": "8", "points": points,
        "driver": {"link": (driver + 1).to_string(), "omega": "1 rad/s"}})
    .to_string()
}

fn codes(notes: &[hodograph::diag::Diagnostic]) -> Vec<&'static str> {
    notes.iter().map(|d| d.code).collect()
}

#[test]
fn a_stalled_closure_is_reported() {
    let case = std::fs::read_to_string(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/tests/cases/double-butterfly.json"
    ))
    .unwrap();
    let case: Json = serde_json::from_str(&case).unwrap();
    let Warned { value, notes } = centres(&read(&case["scene"].to_string())).unwrap();
    assert!(value.closure.stalled());
    let told = notes.iter().find(|d| d.code == "centre-stalled").expect("it is told");
    assert!(
        told.message.en.contains("10 of 28") && told.message.en.contains("P13"),
        "{}",
        told.message.en
    );
    assert!(
        told.message.zh.contains("28") && told.message.zh.contains("P13"),
        "{}",
        told.message.zh
    );
}

/// A stalled closure is opened by drawing: normals to two velocities of a link meet in its centre.
#[test]
fn normals_to_two_velocities_open_a_stalled_closure() {
    let found = centres(&read(templates::get("double-butterfly").unwrap())).unwrap().value;
    let (c, [a, b]) = found
        .list
        .iter()
        .find_map(|c| Some((c, found.normals(c)?)))
        .expect("one centre is taken from velocities");
    let centre = c.place.unwrap().point().unwrap();
    for n in [a, b] {
        let off =
            n.velocity.dot(centre - n.at).abs() / (n.velocity.norm() * (centre - n.at).norm());
        assert!(off < 1e-12, "{off}");
    }
    assert_ne!(a.point, b.point);
    // No other centre needs them.
    assert_eq!(found.list.iter().filter(|c| found.normals(c).is_some()).count(), 1);
}

/// With two drivers, centres by the theorem hold always, the others for the given speeds.
#[test]
fn with_two_drivers_some_centres_rest_on_their_rates() {
    let text = templates::get("five-bar").unwrap();
    let places = |text: &str| {
        let Warned { value, notes } = centres(&read(text)).unwrap();
        assert!(codes(&notes).contains(&"centre-given-drivers"), "{:?}", codes(&notes));
        value
    };
    let one = places(text);
    let other = places(&edit::with_parameters(text, &[("omega_4", "-7")]).unwrap());
    for (a, b) in one.list.iter().zip(&other.list) {
        assert_eq!(a.step, b.step);
        let (Some(CentrePlace::At(p)), Some(CentrePlace::At(q))) = (a.place, b.place) else {
            continue;
        };
        // The point of the first that belongs to both links when both drivers turn alike may stay;
        // the others move.
        if !a.step.given_drivers {
            assert!(p.distance(q) < 1e-12, "{} moves", a.step.pair.name(&one.scene));
        }
    }
    assert!(
        one.list.iter().zip(&other.list).any(|(a, b)| a.step.given_drivers && a.place != b.place)
    );
}

/// A driver without an angular velocity, or at rest, gives the same centres.
#[test]
fn the_rate_does_not_matter() {
    let text = templates::get("crank-rocker").unwrap();
    let moving = centres(&read(text)).unwrap().value;
    let resting =
        centres(&read(&edit::with_parameters(text, &[("omega_1", "0")]).unwrap())).unwrap().value;
    assert!(!moving.at_rest && resting.at_rest);
    for (a, b) in moving.list.iter().zip(&resting.list) {
        assert_eq!((a.place, a.origin), (b.place, b.origin));
    }
}

/// If all lines of a centre coincide, velocities give it, or the program says that nothing does.
#[test]
fn lines_that_coincide_are_not_two() {
    let text =
        edit::with_parameters(templates::get("parallelogram").unwrap(), &[("phi_1", "0")]).unwrap();
    let Warned { value, notes } = centres(&read(&text)).unwrap();
    assert!(codes(&notes).contains(&"centre-undetermined"), "{:?}", codes(&notes));
    let waits = value.list.iter().filter(|c| c.why == Some(Undetermined::LinesCoincide)).count();
    assert_eq!(waits, 2, "{:?}", value.list);
    for c in value.list.iter().filter(|c| c.why.is_some()) {
        // On its way through the pose the links translate, but no interval says so: no place is
        // made up.
        assert_eq!((c.place, c.origin), (None, None), "{c:?}");
    }
}

/// A centre with first lines that coincide in every pose of this mechanism, as its pivots are
/// aligned, waits for another line.
#[test]
fn a_centre_waits_for_another_line() {
    let scene = read(templates::get("shaper").unwrap());
    let found = centres(&scene).unwrap().value;
    let c = found.of(link(&scene, "1"), link(&scene, "5")).unwrap();
    assert!(
        matches!(c.origin, Some(Origin::Crossing(_))) && c.round > c.step.round && c.why.is_none(),
        "{c:?}"
    );
}

/// In every pose each centre is found, reported to have no place, or refused with a reason; and
/// every centre found is right.
#[test]
fn templates_at_many_positions() {
    let (mut found, mut missing) = (0, 0);
    for t in templates::list() {
        for (name, _) in t.parameters.iter().filter(|(n, _)| n.starts_with("phi")).take(1) {
            for k in 0..24 {
                let Ok(text) = edit::with_parameters(
                    templates::get(t.name).unwrap(),
                    &[(name.as_str(), &(15 * k).to_string())],
                ) else {
                    continue;
                };
                let Ok(scene) = scene::read(&text) else { continue };
                let Ok(at) = centres(&scene.value) else { continue };
                let at = at.value;
                assert!(
                    at.worst_residual() < 1e-9,
                    "{} at {}°: {:e}",
                    t.name,
                    15 * k,
                    at.worst_residual()
                );
                assert!(at.worst_triple < 1e-9, "{} at {}°: {:e}", t.name, 15 * k, at.worst_triple);
                found += at.list.iter().filter(|c| c.place.is_some()).count();
                missing += at.list.iter().filter(|c| c.place.is_none()).count();
                for c in &at.list {
                    assert_eq!(c.place.is_none(), c.origin.is_none());
                    if let Some(CentrePlace::Infinity(u)) = c.place {
                        assert!((u.norm() - 1.0).abs() < 1e-12 && u != Vec2::ZERO);
                    }
                }
            }
        }
    }
    println!("{found} centres found, {missing} without a place");
    assert!(found > 4000 && missing * 200 < found, "{found} found, {missing} missing");
}

/// `P_24` in `find`: by velocities, certified, and equal to the place by lines.
#[test]
fn centres_can_be_asked() {
    let mut asked = 0;
    for t in templates::list() {
        let found = centres(&read(templates::get(t.name).unwrap())).unwrap().value;
        for c in &found.list {
            let Some(CentrePlace::At(at)) = c.place else { continue };
            let names = [c.step.pair.i, c.step.pair.j].map(|l| found.scene.link_name(l).to_owned());
            let question = format!("P_{},{}", names[0], names[1]);
            let Ok(scene) = scene::read_asking(templates::get(t.name).unwrap(), &question) else {
                continue;
            };
            let scene = scene.value;
            // Zero velocities give no centre.
            if scene.drivers.iter().all(|d| d.rate.value == 0.0) {
                continue;
            }
            let worked = work(&scene, Scope::Questions)
                .unwrap_or_else(|f| panic!("{} {question}: {f}", t.name))
                .value;
            let AnswerValue::Point(p) = worked.results[0].computed else {
                panic!("{question} is a place")
            };
            let size = found.worked.configuration.extent();
            assert!(
                p.distance(at) < 1e-9 * (size + p.distance(at) + at.to_vec2().norm()),
                "{} {question}: {p:?}, {at:?}",
                t.name
            );
            let sure = &certify(&scene, &worked, 9)[0];
            assert_eq!(sure.why, None, "{} {question}", t.name);
            asked += 1;
        }
    }
    println!("{asked} centres asked");
    assert!(asked > 200, "{asked}");
}

#[test]
fn centres_that_are_no_place_are_refused() {
    let codes = |question: &str, text: &str| -> Vec<String> {
        match scene::read_asking(text, question).map(|s| work(&s.value, Scope::Questions)) {
            Ok(Ok(_)) => Vec::new(),
            Ok(Err(f)) | Err(f) => {
                f.list.iter().map(|d| format!("{}: {}", d.code, d.message.en)).collect()
            }
        }
    };
    let slide = templates::get("slider-crank").unwrap();
    let told = |question, text, word: &str| {
        let all = codes(question, text);
        assert!(all.iter().any(|d| d.contains(word)), "{question}: {all:?}");
    };
    told("P_22", slide, "one link twice");
    told("P_29", slide, "does not name two links");
    told("P_2,9", slide, "no link `9`");
}

/// A centre at infinity is an answer: its direction is that of the line of the fixed pivots, of the
/// normal of the coupler's velocity, of the normal of the guide.
#[test]
fn a_centre_at_infinity_is_a_direction() {
    let directions = |name: &str, finds: &[&str]| -> Vec<Option<f64>> {
        let mut json: serde_json::Value =
            serde_json::from_str(hodograph::scene::templates::get(name).unwrap()).unwrap();
        json["find"] = finds.to_vec().into();
        let scene = hodograph::scene::read(json.to_string()).unwrap().value;
        let worked =
            hodograph::worked::work(&scene, hodograph::worked::Scope::Questions).unwrap().value;
        assert!(
            worked.unanswered.is_empty() && worked.at_infinity.len() == finds.len(),
            "{name}: {:?}",
            worked.at_infinity
        );
        worked.at_infinity.iter().map(|f| f.direction_deg).collect()
    };
    // AD is along x; the cranks of the parallelogram are at 60 degrees, and the coupler's points
    // move perpendicular to them.
    let found = directions("parallelogram", &["P_13", "P_24"]);
    assert!(found[0].unwrap().abs() < 1e-9 && (found[1].unwrap() - 60.0).abs() < 1e-9, "{found:?}");
    let found = directions("offset-slider-crank", &["P_34"]);
    assert!((found[0].unwrap() - 90.0).abs() < 1e-9, "{found:?}");
}

/// "Find all centres of the mechanism shown" needs no driver and no angular velocity: the centres
/// are the same, and questions that depend on neither are answered.
#[test]
fn centres_need_no_driver() {
    let bare = r#"{"links": {"1": ["A", "D"], "2": ["A", "B"], "3": ["B", "C"], "4": ["C", "D"]}, "ground": "1",
        "points": {"A": [0, 0], "B": ["30 mm", "40 mm"], "C": ["110 mm", "60 mm"], "D": ["100 mm", 0]}}"#;
    let slider = r#"{"links": {"1": [], "2": ["B", "C"], "3": ["B"], "4": ["C"]}, "ground": "1", "points": {"B": ["30 mm", 0], "C": [0, "40 mm"]},
        "guides": [{"pin": "B", "slider": "3", "through": [0, 0], "angle": "0 deg"}, {"pin": "C", "slider": "4", "through": [0, 0], "angle": "90 deg"}]}"#;
    for (text, name, at) in [
        (bare, "P13", [0.9 / 7.0, 1.2 / 7.0]),
        (bare, "P24", [-0.13, 0.0]),
        (slider, "P12", [0.03, 0.04]),
    ] {
        assert!(hodograph::scene::read(text).is_err());
        let scene = hodograph::scene::read_at_rest(text).unwrap().value;
        let all = hodograph::centres::centres(&scene).unwrap().value;
        let [i, j] = [&name[1..2], &name[2..3]].map(|n| link(&scene, n));
        let Some(CentrePlace::At(p)) = all.of(i, j).unwrap().place else {
            panic!("{name} has no place")
        };
        assert!((p.x - at[0]).abs() < 1e-12 && (p.y - at[1]).abs() < 1e-12, "{name}: {p:?}");
    }
    let asking = bare.replacen('{', r#"{"find": ["P_13", "i_24"], "#, 1);
    let read = hodograph::scene::read_at_any_rate(&asking).unwrap();
    assert!(!read.value.drivers[0].rate_told && read.notes.iter().any(|d| d.code == "free-rate"));
    let worked =
        hodograph::worked::work(&read.value, hodograph::worked::Scope::Questions).unwrap().value;
    // i_24 = P₁₄P₂₄ : P₁₂P₂₄.
    let ratio = worked.results.iter().find(|r| r.find == 1).unwrap().value();
    assert!(
        matches!(ratio, hodograph::answer::AnswerValue::Scalar(i) if (i - 230.0 / 130.0).abs() < 1e-12),
        "{ratio:?}"
    );
    // A quantity that depends on the angular velocity has no answer without one.
    let depends = bare.replacen('{', r#"{"find": ["P_13", "v_B"], "#, 1);
    assert!(hodograph::scene::read_at_any_rate(depends).is_err());
}
