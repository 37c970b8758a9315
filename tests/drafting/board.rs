//! The drawing board's plan and the values measured on it, in all templates and in scenes with
//! every kind of term.

use hodograph::construct::pencil::Blunt;
use hodograph::construct::{Layout, by_hand};
use hodograph::notation::Notation;
use hodograph::plan::text::PlanWriter;
use hodograph::plan::{PlanStep, Term, TermConnection, TermKind, TurningBody, VertexPlace};
use hodograph::scene::{self, DiagramKind, Lang, Scene, templates};
use hodograph::worked::{Scope, Worked, work};

/// Scenes in addition to all templates: a wheel on a turning track, a composite motion, a cylinder
/// that extends with an acceleration, three links one after another on five legs, a five-bar with
/// gears on its floating links.
const MORE: [&str; 5] = [
    r#"{"units": {"length": "m"}, "links": {"1": ["O","A"], "2": ["A","P"], "3": ["P","Q","S"], "4": ["S","R","T"], "5": ["T","U","V"], "6": ["Q","G"],
    "7": ["R","H"], "8": ["U","K"], "9": ["V","L"], "0": ["O","G","H","K","L"]}, "ground": "0",
    "points": {"O": [0,0], "A": [1,1], "P": [2,4], "Q": [3,5.5], "S": [5,4], "R": [6.5,6], "T": [8,4.2], "U": [10,6], "V": [11,4], "G": [1.5,8], "H": [7.5,9],
    "K": [9,9], "L": [13,1]}, "driver": {"link": "1", "omega": "2 rad/s", "alpha": "1 rad/s^2"},
    "find": ["v_S", "a_S", "v_V", "a_V", "omega_3", "omega_4", "alpha_5", "omega_9"]}"#,
    r#"{"links": {"1": ["O", "D"], "2": ["O", "A"], "3": ["A", "B"], "4": ["B", "C"], "5": ["C", "D"]}, "ground": "1",
    "units": {"length": "mm"}, "points": {"O": [0, 0], "D": [200, 0], "A": [25, 43], "B": [135, 95], "C": [225, 105]},
    "gears": [{"links": ["3", "5"], "centres": ["B", "C"], "teeth": [30, 45], "at": "K"}],
    "driver": {"link": "2", "omega": "10 rad/s"}, "find": ["v_B", "a_C", "omega_3", "omega_5", "alpha_4"]}"#,
    r#"{"units": {"length": "mm", "angle": "deg"}, "links": {"1": ["A","D","F"], "2": ["A","B"], "3": ["B","C"], "4": ["C","D"], "5": ["E"], "6": ["E","F"]},
    "ground": "1", "points": {"A": [0,0], "D": [140,0], "F": [20,190]}, "lengths": {"AB": 60, "BC": 140, "CD": 95, "EF": 118},
    "sketch": {"C": [160,90], "E": [74,120]}, "rolling": [{"wheel": "5", "centre": "E", "radius": 25, "on": "3", "line": "BC", "through": "B"}],
    "driver": {"link": "2", "angle": "70 deg", "omega": "4 rad/s", "alpha": "5 rad/s^2"}, "find": ["omega_5", "alpha_5", "a_E"]}"#,
    r#"{"units": {"length": "mm", "angle": "deg"}, "links": {"1": ["A","D"], "2": ["A","B"], "3": ["B","C","E"], "4": ["C","D"]}, "ground": "1",
    "points": {"A": [0,0], "D": [300,0]}, "lengths": {"AB": 100, "BC": 250, "CD": 200, "BE": 150, "CE": 140}, "side": {"C": "left of BD", "E": "left of BC"},
    "driver": {"link": "2", "angle": "60 deg", "omega": "10 rad/s"}, "find": ["ak_E/4", "ar_E/4", "ae_E/4", "a_E"]}"#,
    r#"{"units": {"length": "m"}, "links": {"1": ["A","B"], "2": ["B","C"]}, "ground": "1", "points": {"A": [0,0], "B": [2,0], "C": [1.5,1]},
    "driver": {"cylinder": "AC", "rate": "0.3 m/s", "acceleration": "1 m/s^2", "links": ["3", "4"]}, "find": ["omega_2", "alpha_2", "a_C"]}"#,
];

fn worked(text: &str) -> (Scene, Worked) {
    let scene = scene::read(text).unwrap_or_else(|f| panic!("{f}\n{text}")).value;
    let worked = work(&scene, Scope::Figure).unwrap_or_else(|f| panic!("{f}\n{text}")).value;
    (scene, worked)
}

fn all() -> Vec<(String, Scene, Worked)> {
    let texts =
        templates::list().into_iter().map(|t| (t.name.to_owned(), templates::get(t.name).unwrap()));
    let texts = texts.chain(MORE.iter().enumerate().map(|(k, text)| (format!("scene {k}"), *text)));
    texts
        .map(|(name, text)| {
            let (scene, worked) = worked(text);
            (name, scene, worked)
        })
        .collect()
}

fn steps(worked: &Worked, on: DiagramKind) -> impl Iterator<Item = &PlanStep> {
    worked.plan.steps(on).iter().flat_map(|g| g.alternatives.iter().flatten().chain(&g.further))
}

/// Everything with a construction is drawn and agrees with the loop equations.
#[test]
fn what_can_be_drawn_is_drawn() {
    for (name, scene, w) in all().into_iter().filter(|(name, ..)| name != "double-butterfly") {
        // Centres of velocity have a drawing of their own.
        for r in w.results.iter().filter(|r| !scene.find[r.find].text.starts_with("P_")) {
            let find = &scene.find[r.find].text;
            assert!(r.drawn.is_some(), "{name}: {find} is not drawn");
            assert!(r.agreement.is_none_or(|a| a.holds()), "{name}: {find} {:?}", r.agreement);
        }
    }
}

/// A known magnitude is given by its factors: 2ωv for a Coriolis term, ω²l, ωl, αl.
#[test]
fn magnitudes_name_what_they_are_made_of() {
    let mut seen = std::collections::BTreeSet::new();
    for (name, scene, w) in all() {
        let notation = Notation::of_language(Lang::En);
        let writer =
            PlanWriter { scene: &scene, plan: &w.plan, notation: &notation, lang: Lang::En };
        for on in DiagramKind::POLYGONS {
            for t in w.plan.terms(on).filter(|t| t.known && !w.plan.vanishes(&scene, on, t)) {
                let said = writer.magnitude(on, &t);
                let (begins, holds): (&str, &[&str]) = match (t.kind, t.by) {
                    (TermKind::Coriolis, by) => {
                        seen.insert(match by {
                            TermConnection::Guide { .. } => "guide",
                            TermConnection::Frame { .. } => "frame",
                            TermConnection::Cylinder(_) => "cylinder",
                            TermConnection::Turning(_)
                            | TermConnection::Contact(_)
                            | TermConnection::Apart => "another",
                        });
                        ("2\\omega_", &[" v"])
                    }
                    (TermKind::Relative, TermConnection::Turning(_)) => ("\\omega_", &[" l_"]),
                    (TermKind::Normal, TermConnection::Turning(_)) => ("\\omega^2_", &[" l_"]),
                    (TermKind::Tangential, TermConnection::Turning(_)) => ("\\alpha_", &[" l_"]),
                    _ => continue,
                };
                assert!(
                    said.starts_with(begins) && holds.iter().all(|h| said.contains(h)),
                    "{name}: {t:?} is {said}"
                );
            }
        }
    }
    assert_eq!(seen.into_iter().collect::<Vec<_>>(), ["cylinder", "frame", "guide"]);
}

/// The part that a contact adds has a mark of its own, unless it is the whole acceleration of a
/// point that rolls on the ground.
#[test]
fn rolling_is_marked_where_it_is_a_part() {
    let mut counts = [0; 2];
    for (name, scene, w) in all() {
        let notation = Notation::of_language(Lang::En);
        let writer =
            PlanWriter { scene: &scene, plan: &w.plan, notation: &notation, lang: Lang::En };
        for t in w.plan.terms(DiagramKind::Acceleration).filter(|t| t.kind == TermKind::Roll) {
            let symbol = writer.symbol(DiagramKind::Acceleration, &t);
            let on_ground = w.plan.vertex(t.to).fixed;
            assert_eq!(symbol.contains("ro"), !on_ground, "{name}: {symbol}");
            counts[usize::from(on_ground)] += 1;
        }
    }
    assert!(counts.iter().all(|c| *c > 0), "{counts:?}");
}

/// An equation names its vector: where a chain of several terms starts at a fixed point, the vector
/// is left of them.
#[test]
fn equations_name_their_vector() {
    let (mut sums, mut single) = (0, 0);
    for (name, scene, w) in all() {
        let notation = Notation::of_language(Lang::En);
        let writer =
            PlanWriter { scene: &scene, plan: &w.plan, notation: &notation, lang: Lang::En };
        for on in DiagramKind::POLYGONS {
            for step in steps(&w, on) {
                let PlanStep::Equation { target, chains, .. } = step else { continue };
                let columns = writer.columns(on, *target, chains);
                let terms = chains[0].known.len();
                assert!(chains.len() > 1 || chains[0].unknown.is_empty(), "{name}: {step:?}");
                let (own, fixed) = (
                    notation.vectors.write(writer.vector(on, *target)),
                    w.plan.vertex(chains[0].start).fixed,
                );
                let said = || {
                    columns.iter().map(|c| format!("{} {}", c.joint, c.symbol)).collect::<Vec<_>>()
                };
                if chains.len() > 1 && fixed || columns.is_empty() {
                    continue;
                }
                if terms > 1 || !fixed {
                    assert_eq!(
                        (columns[0].joint, &columns[0].symbol, columns[1].joint),
                        ("", &own, "="),
                        "{name}: {:?}",
                        said()
                    );
                    sums += 1;
                } else {
                    assert_eq!(columns.len(), 1, "{name}: {:?}", said());
                    single += 1;
                }
            }
        }
    }
    assert!(sums > 30 && single > 30, "{sums} {single}");
}

/// True if two rows of terms contain one another, in either sense.
fn shows(row: &[Term], wanted: &[Term]) -> bool {
    let flip = |t: &Term| (t.kind, t.to, t.of);
    let plain = |t: &Term| (t.kind, t.of, t.to);
    row.windows(wanted.len()).any(|w| {
        let same = |f: &dyn Fn(
            &Term,
        ) -> (
            TermKind,
            hodograph::plan::VertexId,
            hodograph::plan::VertexId,
        )| { w.iter().zip(wanted).all(|(a, b)| plain(a) == f(b)) };
        same(&plain) || same(&flip)
    })
}

/// A vector between two images is drawn, once, if it is asked for and no edge shows it.
#[test]
fn no_vector_is_drawn_twice_and_each_that_is_asked_is_drawn() {
    let mut between = 0;
    for t in templates::list() {
        let plain = scene::read(templates::get(t.name).unwrap()).unwrap().value;
        // All relative motions of two points of a link.
        let mut asked = Vec::new();
        for link in plain.links.iter().filter(|l| l.points.len() > 1) {
            for (i, p) in link.points.iter().enumerate() {
                for q in &link.points[i + 1..] {
                    let names = [plain.point_name(*p), plain.point_name(*q)];
                    if names.iter().all(|n| n.len() == 1) {
                        asked.extend(
                            ["v", "a", "an", "at"].map(|k| format!("{k}_{}{}", names[0], names[1])),
                        );
                    }
                }
            }
        }
        let mut text: serde_json::Value =
            serde_json::from_str(templates::get(t.name).unwrap()).unwrap();
        text["find"] = asked.clone().into();
        let Ok(scene) = scene::read(text.to_string()) else { continue };
        let Ok(done) = work(&scene.value, Scope::Questions) else { continue };
        let w = done.value;
        for (r, find) in w.results.iter().map(|r| (r, &scene.value.find[r.find].text)) {
            assert!(r.drawn.is_some(), "{}: {find} is not drawn", t.name);
        }
        for on in DiagramKind::POLYGONS {
            let groups = w.plan.steps(on);
            for (g, group) in groups.iter().enumerate() {
                for (k, b) in group.between.iter().enumerate() {
                    between += 1;
                    let wanted = b.terms();
                    let earlier = groups[..g]
                        .iter()
                        .flat_map(|g| &g.between)
                        .chain(&group.between[..k])
                        .any(|o| shows(&o.terms(), &wanted));
                    let row = |s: &PlanStep| {
                        s.chains().iter().any(|c| {
                            let alone = if c.unknown.len() == 1 { &c.unknown[..] } else { &[] };
                            shows(
                                &c.known.iter().chain(alone).copied().collect::<Vec<_>>(),
                                &wanted,
                            )
                        })
                    };
                    let all = |g: &hodograph::plan::GroupSteps| {
                        !g.alternatives.is_empty()
                            && g.alternatives.iter().all(|a| a.iter().any(row))
                            || g.further.iter().any(row)
                    };
                    assert!(
                        !earlier && !groups.iter().any(all),
                        "{}: {wanted:?} is drawn twice",
                        t.name
                    );
                }
            }
        }
    }
    assert!(between > 50, "{between}");
}

/// By hand, too, an arm has the length of its body: only its direction is taken from the drawing.
/// It is named by its ends.
#[test]
fn arms_are_as_long_as_their_bodies() {
    let (mut arms, mut named) = (0, 0);
    for (name, scene, w) in all() {
        let layout = Layout::of(&w.construction);
        for seed in 0..3 {
            let Ok((drawn, _)) = by_hand(
                &w.construction.acts,
                &scene,
                &w.configuration,
                &w.plan,
                &layout,
                &mut Blunt::new(0.5, seed),
            ) else {
                continue;
            };
            for rate in &drawn.rates {
                let Some(m) = &rate.measured else { continue };
                let spots = [m.line.0, m.line.1].map(|v| w.plan.vertex(v).spot);
                let [VertexPlace::Point(p), VertexPlace::Point(q)] = spots else { continue };
                let on_body = match rate.body {
                    TurningBody::Link(l) => {
                        [p, q].iter().all(|x| scene.links[l.0].points.contains(x))
                    }
                    TurningBody::Cylinder(_) => true,
                };
                if on_body {
                    let given = w.configuration.point(p).distance(w.configuration.point(q));
                    assert!(
                        (m.arm - given).abs() <= 1e-12 * given,
                        "{name}: {:?} is {} long, its body {given}",
                        m.line,
                        m.arm
                    );
                    arms += 1;
                }
            }
        }
        for r in &w.results {
            let Some(m) = r.drawn.as_ref().and_then(|d| d.measured.as_ref()) else { continue };
            let (Some(arm), Some((p, q))) = (m.arm_m, m.arm_of) else { continue };
            let given = w.configuration.point(p).distance(w.configuration.point(q));
            assert!((arm - given).abs() <= 1e-9 * given, "{name}: {arm} {given}");
            named += 1;
        }
    }
    assert!(arms > 100 && named > 30, "{arms} {named}");
}
