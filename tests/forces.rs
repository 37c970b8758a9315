//! Forces against virtual work: on every template each moving link is loaded, and the work of the
//! drivers' balancing moments and forces must be opposite to that of the loads.

#[path = "forces/drawn.rs"]
mod drawn;
#[path = "forces/lever.rs"]
mod lever;
#[path = "forces/sweeps.rs"]
mod sweeps;
#[path = "forces/templates.rs"]
mod template_reactions;
#[path = "forces/wheels.rs"]
mod wheels;

use hodograph::answer::{AnswerValue, MotionSource};
use hodograph::certified::ladder::{AnswerPart, certify};
use hodograph::diag::Warned;
use hodograph::digits::significant;
use hodograph::equilibrium::ForceTerm;
use hodograph::force::{is_determined, rubbing};
use hodograph::geom::Vec2;
use hodograph::mechanism::Mechanism;
use hodograph::notation::Notation;
use hodograph::report::forces::ForceWriter;
use hodograph::scene::quantity::contacts;
use hodograph::scene::{self, GuidePath, Lang, LinkId, PointId, Scene, templates};
use hodograph::sweep::PlacedScene;
use hodograph::sweep::energy::{self, Energy};
use hodograph::worked::{Scope, Worked, work};
use serde_json::{Value as Json, json};

/// Digits requested from the ladder.
const DIGITS: usize = 8;

/// A load of a scene: force at a point of a link.
struct Load {
    link: String,
    point: String,
    force: Vec2,
}

/// A template with a force at a point of each moving link, and the questions for the points'
/// velocities and the drivers' balance.
fn loaded(text: &str, scene: &Scene) -> (Json, Vec<Load>) {
    let mut json: Json = serde_json::from_str(text).unwrap();
    let mut loads = Vec::new();
    for (k, link) in scene.links.iter().enumerate() {
        let Some(p) = link.points.last().filter(|_| k != scene.ground.0) else { continue };
        // Numbers without a pattern, the same in every run.
        let force = Vec2::new(37.0 + 13.0 * k as f64, -29.0 + 17.0 * (k % 3) as f64);
        loads.push(Load { link: link.name.clone(), point: scene.point_name(*p).to_owned(), force });
    }
    json["forces"] =
        loads.iter().map(|l| json!({"on": l.link, "at": l.point, "F": [format!("{} N", l.force.x), format!("{} N", l.force.y)]})).collect();
    let mut find: Vec<String> = Vec::new();
    for l in &loads {
        let v = format!("v_{}", l.point);
        if !find.contains(&v) {
            find.push(v);
        }
    }
    for (d, driver) in scene.drivers.iter().enumerate() {
        let letter = if driver.kind.turns() { "M" } else { "F" };
        find.push(if d == 0 { format!("{letter}_b") } else { format!("{letter}_b{}", d + 1) });
    }
    for key in ["composite", "attempts", "readings"] {
        json.as_object_mut().unwrap().remove(key);
    }
    json["find"] = json!(find);
    (json, loads)
}

fn answer(scene: &Scene, worked: &Worked, find: &str) -> Option<AnswerValue> {
    let i = scene.find.iter().position(|f| f.text == find)?;
    worked.results.iter().find(|r| r.find == i).map(|r| r.computed)
}

/// Friction in all pins of two links and all guides of sliders.
fn friction(scene: &Scene) -> Json {
    let pins = (0..scene.points.len()).map(PointId).filter(|p| scene.carriers(*p).count() == 2);
    let pins = pins.map(|p| json!({"pin": scene.point_name(p), "circle": "0.2 mm"}));
    let mut sliders: Vec<&str> = scene
        .guides
        .iter()
        .filter(|g| matches!(g.path, GuidePath::Line { .. }))
        .filter_map(|g| Some(scene.link_name(g.slider?)))
        .collect();
    sliders.sort_unstable();
    sliders.dedup();
    pins.chain(sliders.into_iter().map(|s| json!({"slider": s, "f": 0.02}))).collect()
}

/// Number of templates checked and of balancing moments drawn, with the faults.
#[derive(Default)]
struct Balance {
    checked: usize,
    drawn: usize,
    failures: Vec<String>,
}

impl Balance {
    /// Loads a template, with friction if `rough`, and compares the drivers' work with that of the
    /// loads and of friction.
    fn of(&mut self, name: &str, text: &str, plain: &Scene, rough: bool) -> Result<(), String> {
        let (mut json, loads) = loaded(text, plain);
        if rough {
            json["friction"] = friction(plain);
        }
        let scene = scene::read(json.to_string()).map_err(|f| f.to_string())?.value;
        let worked = work(&scene, Scope::Questions).map_err(|f| f.to_string())?.value;
        // Friction depends on reactions, which a redundant link or pair, or a belt, leaves
        // undetermined.
        if rough && !is_determined(&scene, &worked.mechanism) {
            return Ok(());
        }
        let (mut work, mut size) = (0.0, 0.0);
        for l in &loads {
            let find = format!("v_{}", l.point);
            let Some(AnswerValue::Vector(v)) = answer(&scene, &worked, &find) else {
                return Err(format!("{find} is not answered"));
            };
            work += v.dot(l.force);
            size += v.norm() * l.force.norm();
        }
        for (d, driver) in scene.drivers.iter().enumerate() {
            let find = &scene.find[scene.find.len() - scene.drivers.len() + d].text;
            let Some(AnswerValue::Scalar(balance)) = answer(&scene, &worked, find) else {
                return Err(format!("{find} is not answered: {:?}", worked.unanswered));
            };
            work += balance * driver.rate.value;
        }
        let forces = worked.solution.forces().ok_or("no forces")?;
        let (rubbing, _) = rubbing(&scene, &worked.configuration, &worked.solution)
            .ok_or("no velocities where it rubs")?;
        work -= rubbing.iter().map(|r| r.power(forces)).sum::<f64>();
        if work.abs() > 1e-9 * size {
            return Err(format!("the power is out of balance by {work} W of {size} W"));
        }
        self.checked += 1;
        for (r, c) in worked.results.iter().zip(certify(&scene, &worked, DIGITS)) {
            let find = &scene.find[r.find];
            if let (AnswerValue::Scalar(x), Some(n)) = (r.computed, c.part(AnswerPart::Scalar)) {
                let off = (x - n.enclosure().approx).abs();
                if off > 1e-9 * r.scale.max(x.abs()) {
                    let told = n.enclosure().approx;
                    self.failures.push(format!(
                        "{name}, rough {rough}: {} by the rows {x}, by the ladder {told}",
                        find.text
                    ));
                }
            }
            if let Some(a) = r.agreement.filter(|_| find.what.kind().is_of_forces()) {
                self.drawn += 1;
                if !a.holds() {
                    self.failures.push(format!(
                        "{name}, rough {rough}: {} drawing and analysis disagree: {a:?}",
                        find.text
                    ));
                }
            }
        }
        Ok(())
    }
}

#[test]
fn balancing_moments_do_the_work_of_the_loads() {
    for rough in [false, true] {
        let mut all = Balance::default();
        for template in templates::list() {
            let name = template.name;
            let text = templates::get(name).unwrap();
            let Ok(plain) = scene::read(text) else { continue };
            // A template with forces of its own lacks points that have none.
            if plain.value.loads.is_empty()
                && let Err(why) = all.of(name, text, &plain.value, rough)
            {
                all.failures.push(format!("{name}, rough {rough}: {why}"));
            }
        }
        let Balance { checked, drawn, failures } = all;
        println!("{checked} templates, {drawn} balancing moments drawn");
        assert!(rough || checked > 40 && drawn > 20, "{checked} templates, {drawn} drawn");
        assert!(failures.is_empty(), "{} failures:\n{}", failures.len(), failures.join("\n"));
    }
}

/// A slider-crank press of crank 100 mm and rod 400 mm at 200 r/min, with a load on its slider.
fn press(load: &Json, angle: &str) -> String {
    json!({
        "links": {"1": ["O", "B"], "2": ["B", "C"], "3": ["C"], "4": ["O"]}, "ground": "4", "points": {"O": [0, 0]},
        "lengths": {"OB": "100 mm", "BC": "400 mm"},
        "guides": [{"pin": "C", "slider": "3", "on": "4", "through": "O", "angle": "0 deg"}],
        "driver": {"link": "1", "angle": angle, "omega": "200 rpm"}, "sketch": {"C": ["400 mm", 0]}, "forces": [load], "find": ["M_b"]
    })
    .to_string()
}

fn energy(text: &str) -> Energy {
    let scene = scene::read(text).unwrap().value;
    let mechanism = Mechanism::new(&scene).unwrap().value;
    energy::energy(&PlacedScene::new(&scene, &mechanism).unwrap(), 0).unwrap().unwrap()
}

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-10 * expected.abs(), "{found} is not {expected}");
}

/// `flywheel-press` of docs/cases.md: 20 kN over the last quarter of the outward stroke; the work
/// is that force times the travel.
#[test]
fn the_flywheel_of_a_press() {
    let load = json!({"on": "3", "F": "20 kN", "against": "motion", "over": {"slide": "C", "toward": "0 deg", "stroke": [0.75, 1]}});
    // For any position of the driver in the file.
    for angle in ["-30 deg", "100 deg", "-54.314665287347946 deg"] {
        let e = energy(&press(&load, angle));
        near(e.mean, 159.154_943_091_895_34);
        near(e.surplus, 854.194_667_269_396_4);
        near(e.flywheel(200.0 * std::f64::consts::PI / 30.0, 1.0 / 30.0), 58.419_909_955_377_98);
        near((e.fastest.to_degrees() - 360.0).rem_euclid(360.0), 360.0 - 54.314_665_287_347_95);
        near(e.slowest.to_degrees().rem_euclid(360.0), 360.0 - 3.651_422_941_562_323);
    }
}

/// `sunhuan-7-flywheel`: the driving moment of an engine by its diagram of 180°, against a constant
/// resistance.
#[test]
fn the_flywheel_of_an_engine() {
    let text = json!({
        "links": {"1": ["O", "B"], "4": ["O"]}, "ground": "4", "points": {"O": [0, 0]}, "lengths": {"OB": "100 mm"},
        "driver": {"link": "1", "angle": "10 deg", "omega": "620 rpm"},
        "forces": [{"on": "1", "diagram": {"turn": "1", "period": "180 deg",
            "points": [["0 deg", 0], ["20 deg", "200 N*m"], ["50 deg", "200 N*m"], ["180 deg", 0]]}}],
        "find": ["M_b"]
    });
    let e = energy(&text.to_string());
    near(e.mean, -350.0 / 3.0);
    near(e.surplus, 89.084_513_903_877_24);
    near(e.flywheel(620.0 * std::f64::consts::PI / 30.0, 0.01), 2.113_302_173_165_667);
    near(e.fastest.to_degrees().rem_euclid(180.0), 104.166_666_666_666_67);
}

/// A load over a part of a stroke acts there only, whether given in parts, in lengths, by a
/// diagram, or by the slower stroke.
#[test]
fn loads_act_where_they_are_stated() {
    let moment = |load: &Json, angle: &str| {
        let scene = scene::read(press(load, angle)).unwrap().value;
        let worked = work(&scene, Scope::Questions).unwrap().value;
        match answer(&scene, &worked, "M_b") {
            Some(AnswerValue::Scalar(x)) => x,
            other => panic!("{other:?}"),
        }
    };
    let constant = json!({"on": "3", "F": "20 kN", "against": "motion"});
    let ways = [
        json!({"on": "3", "F": "20 kN", "against": "motion", "over": {"slide": "C", "toward": "0 deg", "stroke": [0.75, 1]}}),
        json!({"on": "3", "F": "20 kN", "against": "motion", "over": {"slide": "C", "toward": "0 deg", "stroke": ["150 mm", "200 mm"]}}),
        json!({"on": "3", "angle": "180 deg", "diagram": {"slide": "C", "toward": "0 deg", "points": [[0.75, "20 kN"], [1, "20 kN"]]}}),
    ];
    for (angle, acts) in [
        ("-30 deg", true),
        ("-54 deg", true),
        ("-55 deg", false),
        ("30 deg", false),
        ("150 deg", false),
        ("-170 deg", false),
    ] {
        let expected = if acts { moment(&constant, angle) } else { 0.0 };
        for way in &ways {
            let found = moment(way, angle);
            assert!(
                (found - expected).abs() <= 1e-9 * 2000.0,
                "{way} at {angle}: {found}, not {expected}"
            );
        }
    }
    // Linear between its points.
    let rising = json!({"on": "3", "angle": "180 deg", "diagram": {"slide": "C", "toward": "0 deg", "points": [[0, 0], [1, "20 kN"]]}});
    let part = (0.1 * libm::cos(-1.0) + (0.16 - (0.1 * libm::sin(1.0)).powi(2)).sqrt() - 0.3) / 0.2;
    near(moment(&rising, "-1 rad"), part * moment(&constant, "-1 rad"));
    // With two equal strokes, the file must name one.
    let untold = json!({"on": "3", "F": "20 kN", "against": "motion", "over": {"slide": "C", "stroke": [0.75, 1]}});
    let scene = scene::read(press(&untold, "30 deg")).unwrap().value;
    let Warned { value: worked, notes } = work(&scene, Scope::Questions).unwrap();
    assert_eq!((worked.unanswered.len(), notes[0].code), (1, "stroke"));
}

/// A wedge under a load: F = Q tan(α + 2φ) up, Q tan(α − 2φ) down, and it locks itself below 2φ.
#[test]
fn a_wedge_locks_itself_below_twice_the_angle_of_friction() {
    let phi = libm::atan(0.12);
    for (alpha, sense) in
        [(15.0f64, 1.0f64), (15.0, -1.0), (20.0, 1.0), (20.0, -1.0), (13.0, 1.0), (13.0, -1.0)]
    {
        let text = json!({
            "links": {"1": ["A"], "2": ["B"], "3": ["O"]}, "ground": "3", "points": {"O": [0, 0], "A": [0, 0], "B": [0, 0]},
            "guides": [{"slider": "1", "pin": "A", "on": "3", "through": "O", "angle": "0 deg"},
                {"slider": "2", "pin": "B", "on": "3", "through": "O", "angle": "90 deg"},
                {"pin": "B", "on": "1", "through": "A", "angle": format!("{} deg", 180.0 - alpha)}],
            "driver": {"slide": "A", "position": "0 mm", "velocity": format!("{} m/s", 0.1 * sense)},
            "forces": [{"on": "2", "F": [0, "-2000 N"]}], "friction": [{"slider": "1", "f": 0.12}, {"slider": "2", "f": 0.12}],
            "find": ["F_b", "eta"]
        });
        let scene = scene::read(text.to_string()).unwrap().value;
        let Warned { value: worked, notes } = work(&scene, Scope::Questions).unwrap();
        let expected = 2000.0 * libm::tan(alpha.to_radians() + 2.0 * sense * phi);
        let Some(AnswerValue::Scalar(force)) = answer(&scene, &worked, "F_b") else {
            panic!("{alpha}: no force")
        };
        near(force, expected);
        let Some(AnswerValue::Scalar(eta)) = answer(&scene, &worked, "eta") else {
            panic!("{alpha}: no efficiency")
        };
        let smooth = 2000.0 * libm::tan(alpha.to_radians());
        near(eta, if sense > 0.0 { smooth / expected } else { expected / smooth });
        assert_eq!(
            notes.iter().any(|d| d.code == "self-locking"),
            eta <= 0.0,
            "{alpha}: η = {eta}"
        );
    }
}

/// Every reaction of every loaded template, asked for both ways: F_ij = −F_ji, by the rows and by
/// the ladder.
#[test]
fn links_press_on_each_other_alike() {
    let (mut failures, mut checked) = (Vec::new(), 0);
    for template in templates::list() {
        let (name, text) = (template.name, templates::get(template.name).unwrap());
        let Ok(plain) = scene::read(text) else { continue };
        if !plain.value.loads.is_empty() {
            continue;
        }
        let (mut json, _) = loaded(text, &plain.value);
        let name_of = |l: usize| plain.value.link_name(LinkId(l));
        let asked = |i: &str, j: &str| {
            if i.len() + j.len() > 2 { format!("F_{i},{j}") } else { format!("F_{i}{j}") }
        };
        let mut find = Vec::new();
        for (i, j) in (0..plain.value.links.len()).flat_map(|i| (0..i).map(move |j| (i, j))) {
            if let [_] = contacts(&plain.value, LinkId(i), LinkId(j))[..] {
                find.extend([asked(name_of(i), name_of(j)), asked(name_of(j), name_of(i))]);
            }
        }
        json["find"] = json!(find);
        let scene = scene::read(json.to_string()).unwrap_or_else(|f| panic!("{name}: {f}"));
        let worked = work(&scene.value, Scope::Questions).unwrap_or_else(|f| panic!("{name}: {f}"));
        let told = certify(&scene.value, &worked.value, DIGITS);
        for pair in find.chunks(2) {
            let of = |find: &str| {
                let k = worked
                    .value
                    .results
                    .iter()
                    .position(|r| scene.value.find[r.find].text == find)?;
                let AnswerValue::Vector(rows) = worked.value.results[k].computed else {
                    return None;
                };
                let part = |p| told[k].part(p).map_or(f64::NAN, |n| n.enclosure().approx);
                Some((
                    rows,
                    Vec2::new(part(AnswerPart::X), part(AnswerPart::Y)),
                    worked.value.results[k].scale,
                ))
            };
            let (Some(a), Some(b)) = (of(&pair[0]), of(&pair[1])) else { continue };
            checked += 1;
            for (what, off) in
                [("rows", a.0 + b.0), ("ladder", a.1 + b.1), ("rows and ladder", a.0 - a.1)]
            {
                if off.norm() > 1e-8 * a.2 {
                    failures.push(format!(
                        "{name}: {} by {what}: off by {} N of {}",
                        pair[0],
                        off.norm(),
                        a.2
                    ));
                }
            }
        }
    }
    println!("{checked} reactions");
    assert!(checked > 150, "{checked} reactions");
    assert!(failures.is_empty(), "{} failures:\n{}", failures.len(), failures.join("\n"));
}

/// `khurmi-15-two-mass` of docs/cases.md: the rod as a mass at the gudgeon pin and another at its
/// centre of percussion, or as masses at both pins with a couple.
#[test]
fn a_rod_is_reported_as_two_masses() {
    let scene = json!({
        "links": {"1": ["O", "B"], "2": ["C", "B", "S"], "3": ["C"], "4": ["O"]}, "ground": "4", "points": {"O": [0, 0], "S": {"base": "CB", "x": "100 mm", "y": 0}},
        "lengths": {"OB": "60 mm", "BC": "250 mm"}, "guides": [{"pin": "C", "slider": "3", "on": "4", "through": "O", "angle": "0 deg"}],
        "driver": {"link": "1", "angle": "50 deg", "omega": "2000 rpm"}, "sketch": {"C": ["290 mm", 0]},
        "masses": {"2": {"m": "2 kg", "k": "110 mm", "at": "S"}}, "find": ["M_b", "alpha_2"]
    });
    let scene = scene::read(scene.to_string()).unwrap().value;
    let worked = work(&scene, Scope::Figure).unwrap().value;
    let Some(AnswerValue::Scalar(alpha)) = answer(&scene, &worked, "alpha_2") else {
        panic!("alpha_2 is a number")
    };
    let notation = Notation::of_language(Lang::En);
    let told = ForceWriter {
        scene: &scene,
        notation: &notation,
        lang: Lang::En,
        of: worked.equilibrium.as_ref().unwrap(),
    }
    .text();
    let couple = significant(2.0 * (0.1 * 0.15 - 0.11 * 0.11) * alpha, 4);
    for part in [
        "1.095 kg at C and 0.9050 kg at K, SK = 121.0 mm",
        "1.200 kg at C and 0.8000 kg at B",
        &format!("= {} N·m", couple.replace('-', "−")),
    ] {
        assert!(told.contains(part), "{part} is missing in\n{told}");
    }
}

/// At a pin two links may be loaded: each force has the name of its link, and a single load only
/// that of its point.
#[test]
fn loads_of_two_links_at_one_pin_have_two_names() {
    let symbols = |forces: Json| -> Vec<String> {
        let mut json: Json =
            serde_json::from_str(templates::get("four-bar-forces").unwrap()).unwrap();
        json["forces"] = forces;
        let scene = scene::read(json.to_string()).unwrap_or_else(|f| panic!("{f}")).value;
        let worked = work(&scene, Scope::Questions).unwrap_or_else(|f| panic!("{f}")).value;
        let (notation, of) = (Notation::of_language(Lang::En), worked.equilibrium.unwrap());
        let w = ForceWriter { scene: &scene, notation: &notation, lang: Lang::En, of: &of };
        let loads = (0..of.loads.len()).map(|k| w.plain(ForceTerm::Load(k)));
        loads.filter(|symbol| symbol.starts_with("F_C")).collect()
    };
    let at_c =
        |link: &str, angle: &str| json!({"on": link, "at": "C", "F": "50 N", "angle": angle});
    let of_two = json!([at_c("2", "0 deg"), at_c("3", "90 deg")]);
    assert_eq!(symbols(of_two), ["F_C2", "F_C3"]);
    let of_three = json!([at_c("2", "0 deg"), at_c("3", "90 deg"), at_c("3", "20 deg")]);
    assert_eq!(symbols(of_three), ["F_C2", "F_C3,2", "F_C3,3"]);
    assert_eq!(symbols(json!([at_c("2", "0 deg")])), ["F_C"]);
}

/// A couple on a slider shifts the force of its guide off its pin: beyond the length of the slider
/// its two corners carry it, one in each sense.
#[test]
fn a_slider_tilts_where_its_guide_ends() {
    let notes = |length: &str| -> Vec<String> {
        let scene = json!({
            "links": {"1": ["A", "B"], "2": ["B", "C"], "4": ["A"]}, "ground": "4", "points": {"A": [0, 0]},
            "lengths": {"AB": "50 mm", "BC": "200 mm"}, "side": {"C": "right of AB"},
            "guides": [{"pin": "C", "slider": "3", "on": "4", "through": "A", "angle": "0 deg", "length": length}],
            "driver": {"link": "1", "angle": "60 deg", "omega": "1 rad/s"},
            "forces": [{"on": "3", "at": "C", "F": "1000 N", "angle": "180 deg"}, {"on": "3", "M": "20 N*m"}],
            "find": ["F_43", "h_43"]
        });
        let Warned { notes, .. } =
            work(&scene::read(scene.to_string()).unwrap().value, Scope::Questions).unwrap();
        notes.into_iter().filter(|d| d.code == "guide-tilts").map(|d| d.message.en).collect()
    };
    // F_43 = 1000 N · tan β with sin β = 50 sin 60°/200: 221.8 N, at h = 90.2 mm from the pin.
    assert_eq!(notes("190 mm"), Vec::<String>::new());
    let told = notes("100 mm");
    assert!(
        told.len() == 1
            && ["slider 3", "310.9 N", "89.12 N"].iter().all(|part| told[0].contains(part)),
        "{told:?}"
    );
}
