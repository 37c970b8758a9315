//! Degree of freedom: counts against brute force, and redundant pairs in random mechanisms.

#[path = "mobility/books.rs"]
mod books;

use hodograph::answer::AnswerValue;
use hodograph::diag::{Diagnostic, Faults, Severity};
use hodograph::mechanism::{Mechanism, MobilitySurvey, Opened};
use hodograph::position::redundant::{RedundancyVerdict, RepeatReason, check};
use hodograph::report::mobility;
use hodograph::scene::{self, Driver, DriverKind, Guide, LinkId, PointId, Scene};
use hodograph::worked::{Scope, Worked, work};
use std::collections::{BTreeMap, BTreeSet};

/// A random generator: Knuth's linear congruence, the upper bits.
struct Random(u64);

impl Random {
    fn below(&mut self, n: u64) -> u64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % n
    }

    /// Whole millimetres: sums of them are exact.
    fn mm(&mut self, from: i64, to: i64) -> i64 {
        from + self.below((to - from) as u64) as i64
    }
}

fn read(text: &str) -> Scene {
    scene::read(text).unwrap_or_else(|f| panic!("{f}\n{text}")).value
}

/// A parallelogram on crank AB with a third crank EF, a dyad behind it, and an offset of F (mm, as
/// written).
struct Locomotive {
    b: [i64; 2],
    d: [i64; 2],
    e: [i64; 2],
    h: [i64; 2],
    g: [i64; 2],
}

impl Locomotive {
    /// None of its cranks is in line with the coupler, so that it is far from its change point.
    fn random(r: &mut Random) -> Locomotive {
        let sign = |r: &mut Random| if r.below(2) == 0 { 1 } else { -1 };
        let b = [r.mm(-40, 40), sign(r) * r.mm(60, 100)];
        let d = [sign(r) * r.mm(150, 300), r.mm(-20, 20)];
        let e = [b[0] + r.mm(-200, 200), b[1] + r.mm(-120, 120)];
        let g = [e[0] + r.mm(150, 250), e[1] + r.mm(40, 90)];
        let h = [g[0] + r.mm(60, 90), g[1] - r.mm(150, 250)];
        Locomotive { b, d, e, h, g }
    }

    /// The pose by coordinates; F is where the third crank is equal and parallel, plus this offset
    /// (mm).
    fn scene(&self, beside: [f64; 2]) -> String {
        let Locomotive { b, d, e, h, g } = self;
        let c = [b[0] + d[0], b[1] + d[1]];
        let f = [e[0] - b[0], e[1] - b[1]];
        let off = |k: usize| {
            if beside[k] == 0.0 {
                format!("{} mm", f[k])
            } else {
                format!("{} mm + {:?} mm", f[k], beside[k])
            }
        };
        let at = |p: &[i64; 2]| format!("[\"{} mm\", \"{} mm\"]", p[0], p[1]);
        format!(
            r#"{{ "links": {{"1": ["A","D","F","H"], "2": ["A","B"], "3": ["B","C","E"], "4": ["C","D"], "6": ["E","G"], "7": ["G","H"], "5": ["E","F"]}},
              "ground": "1", "points": {{"A": [0, 0], "B": {}, "C": {}, "D": {}, "E": {}, "F": ["{}", "{}"], "G": {}, "H": {}}},
              "driver": {{"link": "2", "omega": "5 rad/s", "alpha": "3 rad/s^2"}}, "find": ["omega_5", "alpha_5", "omega_2", "v_E", "a_G"] }}"#,
            at(b),
            at(&c),
            at(d),
            at(e),
            off(0),
            off(1),
            at(g),
            at(h)
        )
    }
}

fn scalar(scene: &Scene, worked: &Worked, find: &str) -> f64 {
    let i = scene.find.iter().position(|f| f.text == find).unwrap();
    match worked.results.iter().find(|r| r.find == i).unwrap().computed {
        AnswerValue::Scalar(s) => s,
        other @ (AnswerValue::Vector(_) | AnswerValue::Point(_)) => panic!("{find} = {other:?}"),
    }
}

fn errors(f: &Faults) -> Vec<&'static str> {
    f.list.iter().filter(|d| d.severity == Severity::Error).map(|d| d.code).collect()
}

#[test]
fn a_third_crank_is_virtual_nearly_or_locks() {
    let mut r = Random(11);
    for round in 0..40 {
        let l = Locomotive::random(&mut r);
        let text = l.scene([0.0; 2]);
        let scene = read(&text);
        let worked = work(&scene, Scope::Figure).unwrap_or_else(|f| panic!("{round}: {f}\n{text}"));
        let note = |code: &str| worked.notes.iter().any(|d: &Diagnostic| d.code == code);
        assert!(note("virtual"), "{round}: {:?}\n{text}", worked.notes);
        let [checked] = &worked.value.redundant[..] else {
            panic!("{round}: {:?}", worked.value.redundant)
        };
        assert!(matches!(checked.reason, RepeatReason::ParallelCranks(_)), "{round}: {checked:?}");
        assert_eq!(checked.positions, 5, "{round}: {checked:?}\n{text}");
        assert!(checked.bound_m.unwrap() < 1e-20, "{round}: {checked:?}");
        // It follows the rotation of the cranks, drawn and computed.
        for (asked, as_the_others) in [("omega_5", 5.0), ("alpha_5", 3.0)] {
            let found = scalar(&scene, &worked.value, asked);
            assert!((found - as_the_others).abs() < 1e-10, "{round}: {asked} = {found}\n{text}");
        }
        for o in &worked.value.results {
            assert!(
                o.agreement.is_some_and(|a| a.holds()),
                "{round}: {} {:?}\n{text}",
                scene.find[o.find].text,
                o.agreement
            );
        }
        // A hundredth longer, or aside: it locks, whether a pose shows that or not.
        let (x, y) = (l.b[0] as f64, l.b[1] as f64);
        for beside in [[0.01 * x, 0.01 * y], [0.01 * y, -0.01 * x]] {
            let text = l.scene(beside);
            let faults = work(&read(&text), Scope::Figure)
                .err()
                .unwrap_or_else(|| panic!("{round}: moves\n{text}"));
            assert!(
                matches!(errors(&faults)[..], ["locked" | "shaky"]),
                "{round}: {faults}\n{text}"
            );
        }
        let text = l.scene([1e-9 * x, 1e-9 * y]);
        let nearly =
            work(&read(&text), Scope::Figure).unwrap_or_else(|f| panic!("{round}: {f}\n{text}"));
        let warned =
            |d: &&Diagnostic| d.code == "almost-virtual" && d.severity == Severity::Warning;
        let told = nearly
            .notes
            .iter()
            .find(warned)
            .unwrap_or_else(|| panic!("{round}: {:?}\n{text}", nearly.notes));
        let help = told.help.as_ref().unwrap();
        assert!(help.en.contains("EF") && help.en.contains("AB"), "{help:?}");
    }
}

/// In the pose, and to first order about it, a parallel crank of half the length is as good as one
/// of the full length.
#[test]
fn one_pose_never_decides() {
    let half = r#"{ "units": {"length": "mm"}, "links": {"1": ["A","D","F"], "2": ["A","B"], "3": ["B","C","E"], "4": ["C","D"], "5": ["E","F"]}, "ground": "1",
      "points": {"A": [0,0], "B": [30,40], "C": [130,40], "D": [100,0], "E": [80,40], "F": [65,20]}, "driver": {"link": "2", "omega": "5 rad/s"}, "find": ["omega_5"] }"#;
    let faults = work(&read(half), Scope::Questions).unwrap_err();
    assert_eq!(errors(&faults), ["shaky"]);
    let said = faults.to_string();
    assert!(said.contains("link 5 makes the mechanism shaky, mobility F = 0"), "{said}");
    // By lengths it cannot be assembled at all.
    let text = |ef: &str| {
        format!(
            r#"{{ "links": {{"1": ["A","D","F"], "2": ["A","B"], "3": ["B","C","E"], "4": ["C","D"], "5": ["E","F"]}}, "ground": "1",
              "points": {{"A": [0,0], "D": ["100 mm",0], "F": ["50 mm",0], "E": {{"base": "BC", "x": "50 mm", "y": 0}}}},
              "lengths": {{"AB": "50 mm", "BC": "100 mm", "CD": "50 mm", "EF": "{ef}"}}, "side": {{"C": "left of BD"}},
              "driver": {{"link": "2", "angle": "50 deg", "omega": "5 rad/s"}}, "find": ["omega_5"] }}"#
        )
    };
    for (ef, code) in [
        ("25 mm", Some("locked")),
        ("50.5 mm", Some("locked")),
        ("50 mm", None),
        ("50.00000005 mm", None),
    ] {
        let done = work(&read(&text(ef)), Scope::Questions);
        assert_eq!(
            done.as_ref().err().map(errors).unwrap_or_default(),
            code.into_iter().collect::<Vec<_>>(),
            "{ef}"
        );
    }
}

#[test]
fn every_kind_of_repetition_has_its_words() {
    let parallel = r#"{"units":{"length":"mm"},"links":{"1":["A"],"2":["A","B"],"3":["B","C"],"4":["C","D"]},"ground":"1","points":{"A":[0,0],"B":[30,40],"C":[150,0],"D":[180,20]},
      "guides":[{"pin":"C","slider":"4","through":"A","angle":"0 deg"},{"pin":"D","slider":"4","angle":"0 deg"}],"driver":{"link":"2","omega":"5 rad/s"},"find":["v_D"]}"#;
    let coaxial = r#"{"units":{"length":"mm"},"links":{"1":["A","K","D"],"2":["A","K","B"],"3":["B","C"],"4":["C","D"]},"ground":"1","points":{"A":[0,0],"K":[0,0],"D":[100,0],"B":[20,20],"C":[100,60]},
      "driver":{"link":"2","omega":"5 rad/s","line":"AB"},"find":["omega_4"]}"#;
    let circle = |order: [&str; 2]| {
        format!(
            r#"{{"units":{{"length":"m"}},"links":{{"1":["D"],"2":["A"],"4":["C"],"3":["A","B","C"]{}}},"ground":"1","points":{{"D":[0,0],"A":[8,0],"C":[0,6],"B":[4,3]}},
              "guides":[{{"pin":"A","slider":"2","through":"D","angle":"0 deg"}},{{"pin":"C","slider":"4","through":"D","angle":"90 deg"}}],
              "driver":{{"slide":"A","velocity":"2 m/s"}}{},"find":["omega_3"]}}"#,
            order[0], order[1]
        )
    };
    let of = |text: &str| {
        let scene = read(text);
        let m = Mechanism::new(&scene).unwrap().value;
        let [one] = &check(&scene, &m).unwrap_or_else(|f| panic!("{f}\n{text}"))[..] else {
            panic!("{:?}", m.redundant)
        };
        assert_eq!((one.verdict, one.positions), (RedundancyVerdict::Virtual, 5), "{text}");
        (m.redundant[0].opened.clone(), one.reason.clone())
    };
    assert!(matches!(of(parallel), (Opened::Guide(_), RepeatReason::ParallelGuides(_))));
    assert!(matches!(of(coaxial), (Opened::Pin(..), RepeatReason::CoaxialPins(..))));
    assert!(matches!(
        of(&circle([r#","5":["D","B"]"#, ""])),
        (Opened::Guide(_), RepeatReason::SameLine(..))
    ));
    // A guide that is not parallel locks.
    let skew =
        parallel.replace(r#""slider":"4","angle":"0 deg""#, r#""slider":"4","angle":"3 deg""#);
    assert_eq!(errors(&work(&read(&skew), Scope::Questions).unwrap_err()), ["locked"]);
}

/// Two drivers of a four-bar: one is reported as too many, not a redundant coupler.
#[test]
fn a_driver_too_many_is_reported_as_one() {
    let text = r#"{"units":{"length":"mm"},"links":{"1":["A","D"],"2":["A","B"],"3":["B","C"],"4":["C","D"]},"ground":"1","points":{"A":[0,0],"B":[20,20],"C":[100,60],"D":[100,0]},
      "driver":[{"link":"2","omega":"5 rad/s"},{"link":"4","omega":"3 rad/s"}],"find":["omega_3"]}"#;
    assert_eq!(errors(&Mechanism::new(&read(text)).unwrap_err()), ["too-many-constraints"]);
}

/// Random links on pins: n, p_l, compound hinges and F against a count pin by pin.
#[test]
fn counts_are_those_of_brute_force() {
    let mut r = Random(5);
    let mut with_groups = 0;
    for round in 0..300 {
        let (links, pins) = (2 + r.below(7), 2 + r.below(8));
        let mut on: BTreeMap<String, Vec<String>> = BTreeMap::new();
        for l in 0..=links {
            let mut own: Vec<String> =
                (0..1 + r.below(3)).map(|_| format!("P{}", r.below(pins))).collect();
            own.sort();
            own.dedup();
            on.insert(l.to_string(), own);
        }
        let text = serde_json::json!({"links": on, "ground": "0"}).to_string();
        let scene =
            scene::read_topology(&text).unwrap_or_else(|f| panic!("{round}: {f}\n{text}")).value;
        let joined = |p: &String| on.values().filter(|own| own.contains(p)).count() as i64;
        let mut all: Vec<&String> = on.values().flatten().collect();
        all.sort();
        all.dedup();
        let lower: i64 = all.iter().map(|p| joined(p) - 1).sum();
        // A disc on a pin of moving links turns freely without effect; of discs on a pin of their
        // own, one is the carrier of the others.
        let discs = |p: &String| {
            on.iter().filter(|(l, own)| *l != "0" && **own == [p.clone()]).count() as i64
        };
        let loose: Vec<&&String> =
            all.iter().filter(|p| joined(p) > 1 && !on["0"].contains(p)).collect();
        let idle: i64 = loose.iter().map(|p| discs(p).min(joined(p) - 1)).sum();
        let survey = MobilitySurvey::of(&scene);
        let freedom = 3 * links as i64 - 2 * lower;
        assert_eq!(
            (survey.counts.moving as u64, survey.counts.lower as i64, survey.counts.higher),
            (links, lower, 0),
            "{round}: {text}"
        );
        assert_eq!(survey.local.len() as i64, idle, "{round}: {text}");
        assert_eq!(survey.counts.freedom(0, survey.local.len()), freedom - idle, "{round}: {text}");
        // With every higher pair replaced by a link and two lower ones, and without discs that turn
        // without effect, the degree of freedom is the same.
        let lean = survey.substituted(|_| false);
        assert!(
            lean.moving <= links as usize && lean.lower as i64 <= lower,
            "{round}: {lean:?} {text}"
        );
        assert_eq!(lean.freedom(0, 0), freedom - idle, "{round}: {lean:?} {text}");
        let compound: Vec<(String, i64)> =
            all.iter().map(|p| ((*p).clone(), joined(p))).filter(|(_, k)| *k > 2).collect();
        let mut told: Vec<(String, i64)> = survey
            .compound
            .iter()
            .map(|(p, k)| (scene.point_name(*p).to_owned(), *k as i64))
            .collect();
        told.sort();
        assert_eq!(told, compound, "{round}: {text}");
        // Assur: the links of every group have as many freedoms as its pairs take.
        for choice in &survey.choices {
            with_groups += 1;
            for g in &choice.mechanism.groups {
                let taken: usize = g
                    .constraints
                    .iter()
                    .map(|c| choice.mechanism.constraints[*c].form().equations())
                    .sum();
                assert_eq!(3 * g.links.len() + 2 * g.pins.len(), taken, "{round}: {g:?}\n{text}");
            }
        }
        let (survey, checked) = mobility::surveyed(&scene);
        let json = mobility::json(&scene, &survey, &checked);
        assert!(
            json["F"].is_i64()
                && mobility::text(&scene, &survey, &checked, scene::Lang::Zh).contains("p_l"),
            "{round}"
        );
    }
    assert!(with_groups > 50, "only {with_groups} mechanisms move");
}

/// No link is in two groups: a block belongs to the later one of the groups of its guide and its
/// pin.
#[test]
fn every_link_is_in_one_group() {
    for t in hodograph::scene::templates::list() {
        let scene =
            scene::read_topology(hodograph::scene::templates::get(t.name).unwrap()).unwrap().value;
        let (survey, checked) = mobility::surveyed(&scene);
        let told = mobility::json(&scene, &survey, &checked);
        for choice in told["choices"].as_array().unwrap() {
            let groups = choice["groups"].as_array().unwrap();
            let links: Vec<&str> = groups
                .iter()
                .flat_map(|g| g["links"].as_array().unwrap())
                .map(|l| l.as_str().unwrap())
                .collect();
            let different: BTreeSet<&&str> = links.iter().collect();
            assert_eq!(
                different.len(),
                links.len(),
                "{}: {links:?} in {}",
                t.name,
                choice["drivers"]
            );
        }
    }
}

/// Number of equations of pairs between these links only: two for each link of a pin after the
/// first and for a slider, one for a bare pin in a slot.
fn taken(scene: &Scene, among: &BTreeSet<LinkId>) -> usize {
    let on = |p: PointId| scene.carriers(p).filter(|l| among.contains(l)).count();
    let pins: usize = (0..scene.points.len()).map(|p| 2 * on(PointId(p)).saturating_sub(1)).sum();
    let guide = |g: &Guide| match (g.slider, g.pin) {
        _ if !among.contains(&g.on) => 0,
        (Some(s), _) => 2 * usize::from(among.contains(&s)),
        (None, Some(p)) => on(p).min(1),
        (None, None) => 0,
    };
    pins + scene.guides.iter().map(guide).sum::<usize>()
}

/// In every group, the links have as many freedoms as its whole pairs take, whatever steps solve
/// it: including the halves of an Oldham coupling as one RPP dyad, and a slider with points of its
/// own in the group of its guide.
#[test]
fn groups_are_those_of_whole_pairs() {
    let mut several = Vec::new();
    for t in hodograph::scene::templates::list() {
        let scene =
            scene::read_topology(hodograph::scene::templates::get(t.name).unwrap()).unwrap().value;
        for choice in MobilitySurvey::of(&scene).choices {
            let (scene, m) = (&choice.scene, &choice.mechanism);
            // Wheels, cams, cylinders, driven bare pins and redundant pairs have pairs of their own
            // kinds.
            let own = |d: &Driver| match d.kind {
                DriverKind::Turn { .. } => false,
                DriverKind::Slide { guide, .. } => scene.guides[guide.0].slider.is_none(),
                DriverKind::Cylinder { .. } => true,
            };
            if !scene.rolling.is_empty() || !m.redundant.is_empty() || scene.drivers.iter().any(own)
            {
                continue;
            }
            let mut before = BTreeSet::from([scene.ground]);
            for g in m.assur(scene) {
                let with: BTreeSet<LinkId> = before.iter().chain(&g.links).copied().collect();
                if g.class().is_some() {
                    assert_eq!(
                        3 * g.links.len(),
                        taken(scene, &with) - taken(scene, &before),
                        "{}: {g:?}",
                        t.name
                    );
                }
                if g.steps.len() > 1 {
                    several.push((t.name, g.kind().to_owned()));
                }
                before = with;
            }
        }
    }
    for name in ["oldham-coupling", "cart-by-law"] {
        assert!(several.iter().any(|(n, _)| *n == name), "{several:?}");
    }
    assert!(
        several
            .iter()
            .filter(|(name, _)| *name == "oldham-coupling")
            .all(|(_, kind)| kind == "RPP"),
        "{several:?}"
    );
}

/// The bar of a trammel makes the crank to its middle redundant at every size; another rod, which
/// drives that middle from a slot through the crank's pivot, is not involved.
#[test]
fn a_trammel_is_known_by_equal_lengths() {
    for unit in [1e-3, 0.1, 1.0, 1e3] {
        let rod = |length: f64| {
            // From (4, 3) to the line along (4, 3) through D: nearer to D than B, and not at B's
            // distance from it.
            let (x, y) = (0.8 * length, 0.6 * length);
            format!(
                r#"{{"links":{{"1":["D"],"2":["A"],"4":["C"],"3":["A","B","C"],"5":["D","B"],"6":["B","E"]}},"ground":"1",
                "points":{{"D":[0,0],"A":["8*{unit} m",0],"C":[0,"6*{unit} m"],"B":["4*{unit} m","3*{unit} m"],"E":["{x}*{unit} m","{y}*{unit} m"]}},
                "guides":[{{"pin":"A","slider":"2","through":"D","angle":"0 deg"}},{{"pin":"C","slider":"4","through":"D","angle":"90 deg"}},
                {{"pin":"E","on":"1","through":"D","angle":"atan(0.75)"}}],"driver":{{"slide":"E","velocity":"2 m/s"}},"find":["omega_3","v_A"]}}"#
            )
        };
        for length in [2.0, -2.0, 9.0] {
            let scene = read(&rod(length));
            let m = Mechanism::new(&scene).unwrap().value;
            let all = check(&scene, &m).unwrap_or_else(|f| panic!("{f}\n{}", rod(length)));
            let [one] = &all[..] else { panic!("{:?}", m.redundant) };
            let names = |ends: &[hodograph::scene::PointId; 2]| {
                ends.map(|p| scene.point_name(p).to_owned())
            };
            let equal = match &one.reason {
                RepeatReason::SameCircle(ends, b, d) | RepeatReason::SameLine(ends, b, d) => {
                    (names(ends), scene.point_name(*b), scene.point_name(*d))
                }
                other => panic!("{other:?} in units of {unit} m\n{}", rod(length)),
            };
            assert_eq!(equal, (["A", "C"].map(str::to_owned), "B", "D"), "in units of {unit} m");
        }
    }
}

/// A planet is redundant to another planet, not to the sun or the arm, in any order of the links.
#[test]
fn repeated_planets_name_their_like() {
    for order in [
        ["1", "2", "3", "4", "5"],
        ["3", "5", "1", "4", "2"],
        ["5", "4", "3", "2", "1"],
        ["2", "1", "4", "3", "5"],
    ] {
        let points = |l: &str| match l {
            "3" => r#"["O","P","Q"]"#,
            "4" => r#"["P"]"#,
            "5" => r#"["Q"]"#,
            _ => r#"["O"]"#,
        };
        let links: Vec<String> = order.iter().map(|l| format!(r#""{l}": {}"#, points(l))).collect();
        let text = format!(
            r#"{{"units":{{"length":"mm"}},"links":{{{}}},"ground":"1","points":{{"O":[0,0],"P":[60,0],"Q":[-60,0]}},
            "gears":[{{"links":["2","4"],"centres":["O","P"],"teeth":[40,20]}},{{"links":["4","1"],"centres":["P","O"],"teeth":[20,80],"ring":"1"}},
            {{"links":["2","5"],"centres":["O","Q"],"teeth":[40,20]}},{{"links":["5","1"],"centres":["Q","O"],"teeth":[20,80],"ring":"1"}}],
            "driver":{{"link":"2","omega":"3 rad/s"}},"find":["omega_3","omega_4","omega_5"]}}"#,
            links.join(", ")
        );
        let scene = read(&text);
        let m = Mechanism::new(&scene).unwrap().value;
        let all = check(&scene, &m).unwrap_or_else(|f| panic!("{f}\n{text}"));
        assert!(!all.is_empty(), "{text}");
        for one in &all {
            let Opened::Rolling(r) = one.opened else { panic!("{:?}\n{text}", m.redundant) };
            let pair = scene.rolling[r.0].links.map(|l| scene.link_name(l).to_owned());
            let RepeatReason::RepeatedPlanets(like) = &one.reason else {
                panic!("{:?}\n{text}", one.reason)
            };
            let own = if pair.contains(&"4".to_owned()) { "5" } else { "4" };
            assert_eq!(like, own, "{pair:?}\n{text}");
        }
    }
}

/// A driver with a short travel is moved as far as it can: half of the travel, and half of that.
#[test]
fn a_repetition_is_looked_at_as_far_as_the_driver_goes() {
    // A cylinder from G moves the crank AB of a parallelogram with a third crank EF; G, A and B are
    // almost in line.
    for (g, beside, verdict) in [
        (-150.0, 0.0, RedundancyVerdict::Virtual),
        (-150.0, 1e-7, RedundancyVerdict::Almost),
        (-90.0, 0.0, RedundancyVerdict::Virtual),
    ] {
        let text = format!(
            r#"{{"units":{{"length":"mm"}},"links":{{"1":["A","D","F","G"],"2":["A","B"],"3":["B","C","E"],"4":["C","D"],"5":["E","F"]}},"ground":"1",
            "points":{{"A":[0,0],"B":[48,14],"C":[148,14],"D":[100,0],"E":[88,64],"F":["40 mm + {beside:?} mm",50],"G":[{g},0]}},
            "driver":{{"cylinder":"GB","rate":"5 mm/s"}},"find":["omega_5"]}}"#
        );
        let scene = read(&text);
        let m = Mechanism::new(&scene).unwrap().value;
        let [one] = &check(&scene, &m).unwrap_or_else(|f| panic!("{f}\n{text}"))[..] else {
            panic!("{:?}", m.redundant)
        };
        assert_eq!((one.verdict, one.positions), (verdict, 5), "{text}");
        if verdict == RedundancyVerdict::Almost {
            assert!(one.moved != 0.0 && one.moved.abs() < 0.05, "{}\n{text}", one.moved);
        }
    }
    // A driver that turns freely is moved the whole distance.
    let mut r = Random(3);
    for _ in 0..10 {
        let l = Locomotive::random(&mut r);
        let text = l.scene([1e-9 * l.b[0] as f64, 1e-9 * l.b[1] as f64]);
        let scene = read(&text);
        let m = Mechanism::new(&scene).unwrap().value;
        let [one] = &check(&scene, &m).unwrap()[..] else { panic!("{:?}", m.redundant) };
        assert!([0.8, 0.35].contains(&one.moved.abs()), "{}\n{text}", one.moved);
    }
}
