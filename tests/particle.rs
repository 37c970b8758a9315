//! Motions without a mechanism: the cases of the collections with further numbers, pursuits against
//! closed forms, parts against the differentiated whole, drawing against analysis, and refusals.

use hodograph::figure::particle::figures;
use hodograph::notation::Notation;
use hodograph::paper::style::Style;
use hodograph::particle::plate::PlateComponent;
use hodograph::particle::{
    ParticleQuantity, ParticleSolution, board, read, solve, solve_again, templates,
};
use hodograph::report::particle as report;
use hodograph::scene::Lang;
use serde_json::Value as Json;

fn solved(text: &str) -> (hodograph::particle::ParticleProblem, ParticleSolution) {
    let problem = read(text).unwrap_or_else(|f| panic!("{f}")).value;
    let solved = solve(&problem).unwrap_or_else(|f| panic!("{f}"));
    (problem, solved)
}

fn scalar(text: &str, find: &str) -> f64 {
    let (problem, solved) = solved(text);
    let at = problem.find.iter().position(|f| f.text == find).unwrap_or_else(|| panic!("{find}"));
    solved.answers[at]
        .value
        .scalar()
        .unwrap_or_else(|| panic!("{find}: {:?}", solved.answers[at].value))
}

#[test]
fn the_description_of_motions_can_be_solved() {
    let text = include_str!("../docs/scene.md");
    let blocks = text.split("```json\n").skip(1).filter_map(|b| b.split("```").next());
    let motions: Vec<&str> =
        blocks.filter(|b| b.starts_with('{') && b.contains("\"motions\"")).collect();
    assert!(motions.len() >= 2);
    for block in motions {
        let (problem, solved) = solved(block);
        assert_eq!(problem.find.len(), solved.answers.len(), "{block}");
    }
}

/// The cases, each file with its expected values.
#[test]
fn cases_of_motions_without_a_mechanism() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/motions");
    let mut seen = 0;
    for file in std::fs::read_dir(folder).unwrap() {
        let text = std::fs::read_to_string(file.unwrap().path()).unwrap();
        let case: Json = serde_json::from_str(&text).unwrap();
        let (problem, solved) = solved(&case["scene"].to_string());
        let drawn = board::draw(&problem).unwrap();
        for expect in case["expect"].as_array().unwrap() {
            let find = expect["find"].as_str().unwrap();
            let at = problem
                .find
                .iter()
                .position(|f| f.text == find)
                .unwrap_or_else(|| panic!("{find}"));
            let pick = |all: Vec<f64>| match expect["component"].as_str() {
                Some("x") => all[0],
                Some("y") => all[1],
                Some("z") => all[2],
                Some("norm") => all.iter().map(|x| x * x).sum::<f64>().sqrt(),
                _ => all[0],
            };
            let value = &solved.answers[at].value;
            let exact: f64 = expect["exact"].as_str().unwrap().parse().unwrap();
            let tolerance = expect["tolerance"].as_f64().unwrap() * exact.abs();
            let found = pick(value.vector().or_else(|| value.scalar().map(|s| vec![s])).unwrap());
            assert!((found - exact).abs() <= tolerance, "{}: {find} {found} {exact}", case["case"]);
            if let Some(read) = shown(&drawn, problem.find[at].what) {
                assert!(
                    (pick(read.to_vec()) - exact).abs() <= tolerance.max(1e-9 * exact.abs()),
                    "{}: {find} drawn",
                    case["case"]
                );
            }
            seen += 1;
        }
    }
    assert_eq!(seen, 18);
}

/// T = l v / (v² − u²) for a target perpendicular to the first line of sight, with any numbers.
#[test]
fn pursuit_of_a_straight_runner_ends_when_the_formula_says() {
    for (l, u, v) in
        [(1.0, 0.1, 3.0), (2.0, 1.0, 2.0), (5.0, 1.9, 2.0), (0.02, 30.0, 70.0), (1e4, 1.0, 1.05)]
    {
        let text = format!(
            r#"{{"points": {{"A": [0, 0], "B": [0, "{l} m"]}}, "motions": [{{"point": "B", "angle": "0 deg", "s": "{u} m/s*t"}},
                {{"point": "A", "toward": "B", "speed": "{v} m/s"}}], "find": ["T_AB"]}}"#
        );
        let (_, found) = solved(&text);
        let value = &found.answers[0].value;
        let exact = l * v / (v * v - u * u);
        let hodograph::particle::ParticleValue::Scalar(e) = value else { panic!("{value:?}") };
        assert!(
            (e.approx - exact).abs() <= e.radius + 1e-15 * exact,
            "{l} {u} {v}: {} {exact} ± {}",
            e.approx,
            e.radius
        );
        assert!(e.radius < 1e-11 * exact, "{l} {u} {v}: {}", e.radius);
    }
}

/// For a straight target at any angle, d/dt of D·(v e + u) is the constant v² − u², so T = (v l +
/// u·D)/(v² − u²) from any first line of sight.
#[test]
fn pursuit_from_any_side_and_at_any_instant_keeps_its_integral() {
    for (x, y, angle) in [(3.0, 4.0, 10.0), (-2.0, 1.0, 200.0), (0.5, -7.0, 77.0)] {
        let (u, v, x, y): (f64, f64, f64, f64) = (1.3, 2.1, x, y);
        let text = format!(
            r#"{{"time": "0.7 s", "points": {{"A": [0, 0], "B": ["{x} m", "{y} m"]}}, "motions": [{{"point": "B", "angle": "{angle} deg", "s": "{u} m/s*t"}},
                {{"point": "A", "toward": "B", "speed": "{v} m/s"}}]}}"#
        );
        let along = f64::to_radians(angle);
        let length = (x * x + y * y).sqrt();
        let exact = (v * length + u * (x * along.cos() + y * along.sin())) / (v * v - u * u);
        assert!((scalar(&text, "T_AB") - exact).abs() < 1e-12 * exact, "{x} {y} {angle}");
        // The formula holds for the distance left at the instant.
        let (problem, found) = solved(&text);
        let value = |find: &str| {
            found.answers[problem.find.iter().position(|f| f.text == find).unwrap()].value.vector()
        };
        let (a, l) = (value("r_A").unwrap(), scalar(&text, "l_AB"));
        let b = [x + u * 0.7 * along.cos(), y + u * 0.7 * along.sin()];
        let left = (v * l + u * ((b[0] - a[0]) * along.cos() + (b[1] - a[1]) * along.sin()))
            / (v * v - u * u);
        assert!((left + 0.7 - exact).abs() < 1e-12 * exact, "{x} {y} {angle}");
    }
}

/// Velocity and acceleration of the pursuer are the differences of its integrated places.
#[test]
fn what_follows_at_the_instant_is_that_of_differences() {
    let text = templates::get("pursuit-of-a-ship").unwrap();
    let at = |t: f64| {
        let (problem, found) = solved(
            &text
                .replace("\"15 s\"", &format!("\"{t} s\""))
                .replace("\"find\": [", "\"find\": [\"r_A\", "),
        );
        let value = |find: &str| {
            found.answers[problem.find.iter().position(|f| f.text == find).unwrap()]
                .value
                .vector()
                .unwrap()
        };
        (value("r_A"), value("v_A"), value("a_A"))
    };
    let h = 1e-3;
    let ((before, ..), (here, v, a), (after, ..)) = (at(15.0 - h), at(15.0), at(15.0 + h));
    for k in 0..2 {
        assert!(((after[k] - before[k]) / (2.0 * h) - v[k]).abs() < 1e-6, "{k}");
        assert!(((after[k] - 2.0 * here[k] + before[k]) / (h * h) - a[k]).abs() < 1e-5, "{k}");
    }
}

#[test]
fn a_slower_pursuer_is_distinguished() {
    let text = templates::get("pursuit").unwrap().replace("\"5 m/s\"", "\"3 m/s\"");
    let (_, found) = solved(&text);
    let hodograph::particle::ParticleValue::None(d) = &found.answers[0].value else { panic!() };
    assert_eq!(d.code, "never-meets");
}

/// The value of a question on the board, read or calculated.
fn shown(all: &[board::MotionDrawing], what: ParticleQuantity) -> Option<&[f64]> {
    all.iter().flat_map(|d| &d.readings).find(|r| r.0 == what).map(|r| r.1.as_slice())
}

/// Board and analysis agree, for all templates and for plates in every direction; the parts add up
/// to the whole.
#[test]
fn parts_make_up_the_whole_and_drawing_agrees() {
    let ring = templates::get("ring-in-space").unwrap();
    let mut texts: Vec<String> =
        templates::names().map(|n| templates::get(n).unwrap().to_owned()).collect();
    for axis in ["x", "y", "z"] {
        for k in 0..8 {
            let text = ring.replace(
                "\"axis\": \"z\"",
                &format!("\"axis\": \"{axis}\", \"offset\": \"{} mm\"", 15 * k),
            );
            texts.push(
                text.replace("\"0.5 s\"", &format!("\"{} s\"", 0.1 + 0.4 * f64::from(k)))
                    .replace("w*t^2", "w*t^2 - 1 rad/s*t"),
            );
        }
    }
    for mut text in texts {
        text.truncate(
            text.find("\"find\"").map_or(text.len(), |at| text[..at].rfind(',').unwrap()),
        );
        text += "}";
        let (problem, found) = solved(&text);
        let drawn = board::draw(&problem).unwrap();
        for a in &found.answers {
            let what = problem.find[a.find].what;
            if let Some(read) = shown(&drawn, what) {
                let off = report::apart(&a.value, read, report::largest(&problem, &found, what))
                    .unwrap_or(0.0);
                assert!(off < 1e-11, "{}: {off} {text}", problem.find[a.find].text);
            }
        }
        let value = |wanted: ParticleQuantity| {
            found
                .answers
                .iter()
                .find(|a| problem.find[a.find].what == wanted)
                .unwrap()
                .value
                .vector()
                .unwrap()
        };
        for (k, _) in
            problem.motions.iter().enumerate().filter(|(_, m)| {
                matches!(m.kind, hodograph::particle::ParticleMotionKind::OnPlate(..))
            })
        {
            let part = |p: PlateComponent| value(ParticleQuantity::Part(k, p));
            let sum = |all: &[Vec<f64>]| {
                (0..3).map(|c| all.iter().map(|v| v[c]).sum::<f64>()).collect::<Vec<_>>()
            };
            let near =
                |a: Vec<f64>, b: Vec<f64>| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-13);
            assert!(
                near(
                    value(ParticleQuantity::Velocity(k)),
                    sum(&[
                        part(PlateComponent::TransportVelocity),
                        part(PlateComponent::RelativeVelocity)
                    ])
                ),
                "{text}"
            );
            let five = [
                PlateComponent::TransportNormal,
                PlateComponent::TransportTangential,
                PlateComponent::RelativeNormal,
                PlateComponent::RelativeTangential,
                PlateComponent::Coriolis,
            ];
            assert!(near(value(ParticleQuantity::Acceleration(k)), sum(&five.map(part))), "{text}");
        }
    }
}

/// Words and drawings of every template in both languages, at many instants: no label overlaps
/// another.
#[test]
fn figures_have_no_labels_on_one_another() {
    for name in templates::names() {
        let (_, first) = solved(templates::get(name).unwrap());
        for k in 0..24 {
            let text = templates::get(name).unwrap();
            // The instants of all templates are before their meetings.
            let t = match name {
                "pursuit" => format!("\"t1\": \"{} s\"", 60 * k),
                "pursuit-of-a-ship" => format!("\"t1\": \"{} s\"", 0.85 * f64::from(k)),
                _ => format!("\"t1\": \"{} s\"", 0.2 * f64::from(k)),
            };
            let text = text
                .replace("\"t1\": \"0 s\"", &t)
                .replace("\"t1\": \"15 s\"", &t)
                .replace("\"t1\": \"0.5 s\"", &t);
            let text =
                text.replace("\"angle\": \"90 deg\"", &format!("\"angle\": \"{} deg\"", 15 * k));
            let problem = read(&text).unwrap_or_else(|f| panic!("{f}")).value;
            // The end of a pursuit does not change from instant to instant.
            let found = solve_again(&problem, &first).unwrap_or_else(|f| panic!("{f}"));
            let drawn = board::draw(&problem).unwrap();
            for lang in [Lang::En, Lang::Zh] {
                for (_, figure) in
                    figures(&problem, &found, &drawn, &Style::default(), lang).unwrap()
                {
                    let boxes: Vec<_> = figure
                        .items
                        .iter()
                        .filter(|i| matches!(i.shape, hodograph::paper::item::Shape::Label { .. }))
                        .collect();
                    for (i, one) in boxes.iter().enumerate() {
                        for other in &boxes[..i] {
                            let (Some(a), Some(b)) = (one.bounds(), other.bounds()) else {
                                continue;
                            };
                            assert!(
                                a.overlap_mm2(b) < 0.05,
                                "{name} {k} {lang:?}: {one:?} on {other:?}"
                            );
                        }
                    }
                }
            }
        }
    }
}

/// A place without a motion is a point at rest if a pursuer runs toward it or a question names it:
/// it gives the answers of a point with constant x and y. Otherwise it is reported as unused.
#[test]
fn places_that_are_asked_for_are_points_at_rest() {
    let runs = r#"{"point": "A", "angle": "-10 deg", "s": "200 m/s*t + 3 m/s^2*t^2"}"#;
    let chases = r#"{"point": "A", "toward": "O", "speed": "20 m/s + 1 m/s^2*t"}"#;
    let text = |place: &str, motions: &str, find: &str| {
        format!(
            r#"{{"time": "2 s", "points": {{"A": ["1 km", "2 km"]{place}}}, "motions": [{motions}]{find}}}"#
        )
    };
    let rest = r#", "O": ["300 m", "-40 m"]"#;
    let stays = r#"{"point": "O", "x": "300 m", "y": "-40 m"}"#;
    for (motion, find) in [
        (
            runs,
            r#", "find": ["l_OA", "omega_OA", "l_AO", "omega_AO", "vr_A/O", "ar_O/A", "v_A", "v_O"]"#,
        ),
        (chases, r#", "find": ["T_AO", "P_AO", "l_AO", "omega_AO", "v_A", "a_A", "r_O"]"#),
        (chases, ""),
    ] {
        let (one, other) = (
            solved(&text(rest, motion, find)),
            solved(&text("", &format!("{motion}, {stays}"), find)),
        );
        let told =
            |(problem, solved): &(hodograph::particle::ParticleProblem, ParticleSolution)| {
                report::text(problem, solved, &[], 6, None, Lang::En)
            };
        assert_eq!(told(&one), told(&other));
        assert!(!one.1.answers.is_empty());
    }
    let warned =
        |text: String| read(&text).unwrap().notes.iter().map(|d| d.code).collect::<Vec<_>>();
    assert_eq!(warned(text(rest, runs, r#", "find": ["l_OA"]"#)), Vec::<&str>::new());
    assert_eq!(warned(text(rest, runs, r#", "find": ["v_A"]"#)), ["unused-point"]);
    assert_eq!(warned(text(rest, runs, "")), ["unused-point"]);
}

/// All faults are reported with their places.
#[test]
fn faults_are_reported_with_their_places() {
    for (text, codes) in [
        (r#"{"motions": []}"#, vec!["wrong-count"]),
        (
            r#"{"parameters": {"t": "2 s"}, "motions": [{"point": "A", "x": "1 m/s*t", "y": "0 m"}]}"#,
            vec!["name"],
        ),
        (
            r#"{"motions": [{"point": "A", "toward": "B", "speed": "5 m/s"}]}"#,
            vec!["missing-key", "unknown-point"],
        ),
        (
            r#"{"points": {"A": [0, 0]}, "motions": [{"point": "A", "toward": "B", "speed": "5 m/s"}]}"#,
            vec!["unknown-point"],
        ),
        (
            r#"{"points": {"A": [0, 0]}, "motions": [{"point": "A", "toward": "A", "speed": "5 m/s"}]}"#,
            vec!["pursuit"],
        ),
        (
            r#"{"points": {"A": [0, 0]}, "motions": [{"point": "A", "toward": "B", "speed": "5 m", "s": "1 m"}, {"point": "B", "x": "1 s*t"}]}"#,
            vec!["motion", "dimension", "dimension", "missing-key"],
        ),
        (
            r#"{"plates": [{"link": "2", "axis": "w", "angle": "0 deg"}], "motions": [{"point": "M", "on": "3", "to_axis": "0 deg", "s": "1 m"}]}"#,
            vec!["unknown-word", "unknown-plate"],
        ),
        (
            r#"{"time": "-1 s", "motions": [{"point": "B", "x": "1 m/s*t", "y": "0 m"}], "find": ["v_C"]}"#,
            vec!["time", "unknown-question"],
        ),
        (
            r#"{"motions": [{"point": "B", "x": "1 m/s*t", "y": "0 m"}], "find": ["v_C"]}"#,
            vec!["unknown-question"],
        ),
    ] {
        let faults = read(text).unwrap_err();
        let mut told: Vec<&str> = faults.list.iter().map(|d| d.code).collect();
        let mut codes = codes;
        told.sort_unstable();
        codes.sort_unstable();
        assert_eq!(told, codes, "{text}: {faults}");
        assert!(faults.list.iter().all(|d| d.span.is_some()), "{text}: {faults}");
    }
    for (text, code) in [
        (
            templates::get("pursuit").unwrap().replace("\"t1\": \"0 s\"", "\"t1\": \"2000 s\""),
            "pursuit",
        ),
        (templates::get("pursuit").unwrap().replace("\"5 m/s\"", "\"0 m/s\""), "pursuit"),
        (
            templates::get("plate-in-space")
                .unwrap()
                .replace("b*sin(t/3*(1 rad/s))", "b*sqrt(t/(1 s) - pi/2)"),
            "law",
        ),
    ] {
        let faults = read(text).and_then(|p| solve(&p.value)).unwrap_err();
        assert_eq!(faults.list[0].code, code, "{faults}");
    }
}

fn run_after(u: f64, v: f64, angle: f64) -> String {
    format!(
        r#"{{"time": "0 s", "points": {{"A": [0, 0], "B": ["30 m", "40 m"]}},
        "motions": [{{"point": "B", "angle": "{angle} deg", "s": "{u} m/s*t"}}, {{"point": "A", "toward": "B", "speed": "{v} m/s"}}], "find": ["T_AB", "l_AB"]}}"#
    )
}

/// T = r₀(v + u cos θ)/(v² − u²), however close the two speeds are; with equal speeds the distance
/// tends to r₀(1 + cos θ)/2.
#[test]
fn pursuits_of_nearly_equal_speed_are_followed() {
    for (u, angle, cosine) in [(4.9, 90.0, 0.8), (4.95, 0.0, 0.6)] {
        let exact = 50.0 * (5.0 + u * cosine) / (25.0 - u * u);
        let found = scalar(&run_after(u, 5.0, angle), "T_AB");
        assert!((found - exact).abs() < 1e-9 * exact, "{u}, {angle}: {found} {exact}");
    }
    let (problem, solved) = solved(&run_after(5.0, 5.0, 0.0));
    assert!((solved.answers[1].value.scalar().unwrap() - 50.0).abs() < 1e-12);
    let told = report::text(&problem, &solved, &[], 6, None, Lang::En);
    assert!(told.contains("does not catch") && told.contains("4.0000e1 m"), "{told}");
}

/// Faults in shape, names and questions are reported in one list.
#[test]
fn all_faults_of_a_file_are_reported_at_once() {
    let text = r#"{"motions": [{"point": "B", "angle": "0 deg", "s": "4 m"}, {"point": "A", "toward": "C", "speed": "5 furlong"}, {"point": "D", "toward": "E", "speed": "5 m/s"}],
        "points": {"A": [0, 0], "B": [0, "3 km"], "D": [1, 0]}, "find": ["v_B", "x_B", "a_A"]}"#;
    let faults = read(text).unwrap_err();
    let codes: Vec<&str> = faults.list.iter().map(|d| d.code).collect();
    // C, the unit, E, the place of D, x_B. Consequences are not faults of their own: the start of
    // D, and a_A.
    assert_eq!(
        codes,
        ["unknown-point", "unknown-unit", "unknown-point", "no-unit", "unknown-question"],
        "{faults}"
    );
}

/// At another instant, the motion has the answers of a file with that instant; rates of an instant
/// continue with their acceleration.
#[test]
fn an_instant_can_be_moved() {
    for name in templates::names() {
        let (problem, a) = solved(templates::get(name).unwrap());
        let later = problem.at(problem.instant() + 0.25, None).unwrap();
        let b = solve_again(&later, &a).unwrap();
        let moved =
            a.answers.iter().zip(&b.answers).any(|(a, b)| a.value.vector() != b.value.vector());
        assert!(moved, "{name} stands still");
        let drawn = board::draw_again(&later, &board::draw(&problem).unwrap()).unwrap();
        let fresh = board::draw(&later).unwrap();
        for ((what, one), (_, other)) in drawn[0].readings.iter().zip(&fresh[0].readings) {
            let size = one.iter().map(|x| x * x).sum::<f64>().sqrt();
            assert!(
                one.iter().zip(other).all(|(a, b)| (a - b).abs() <= 1e-9 * size),
                "{name}: {what:?}"
            );
        }
    }
}

/// Answers and scales are in the units of the file, with the same certified digits; JSON stays in
/// SI.
#[test]
fn answers_have_the_units_of_the_file() {
    let text = |answers: &str| {
        format!(
            r#"{{{answers}"points": {{"A": [0, 0], "B": ["30 m", "40 m"]}}, "motions": [{{"point": "B", "angle": "0 deg", "s": "36 km/h*t"}},
            {{"point": "A", "toward": "B", "speed": "54 km/h"}}], "find": ["v_A", "l_AB", "T_AB"]}}"#
        )
    };
    let told = |text: String| {
        let problem = hodograph::particle::read(&text).unwrap_or_else(|f| panic!("{f}")).value;
        let solved = hodograph::particle::solve(&problem).unwrap();
        let json = hodograph::report::particle::json(&problem, &solved, &[], 6, &[]);
        (
            hodograph::report::particle::text(
                &problem,
                &solved,
                &[],
                6,
                None,
                hodograph::scene::Lang::En,
            ),
            json["answers"].clone(),
        )
    };
    let (plain, si) = told(text(""));
    let (booked, same) = told(text(r#""answers": {"velocity": "km/h", "length": "ft"}, "#));
    assert!(
        plain.contains("v_A  = 15.0000 m/s (x 9.00000, y 12.0000)")
            && plain.contains("l_AB = 50.0000 m"),
        "{plain}"
    );
    assert!(
        booked.contains("v_A  = 54.0000 km/h (x 32.4000, y 43.2000)")
            && booked.contains("l_AB = 164.042 ft"),
        "{booked}"
    );
    assert_eq!(si, same);
}

/// A circle without a radius gives no path.
#[test]
fn a_radius_of_nothing_is_refused() {
    let text = templates::get("ring-in-space").unwrap();
    for radius in ["0.0 m", "-200 mm"] {
        let mut file: Json = serde_json::from_str(text).unwrap();
        file["parameters"]["R"] = radius.into();
        let faults = read(file.to_string()).unwrap_err();
        assert!(faults.list.iter().any(|d| d.code == "not-positive"), "{radius}: {faults}");
    }
}

/// Two points by laws: distance, rotation of their line, relative motion, against differences of
/// their places; likewise for a pursuer and a point other than its target, and for polar
/// coordinates against x and y.
#[test]
fn two_points_are_seen_from_one_another() {
    let text = |t: f64| {
        format!(
            r#"{{"time": "{t} s", "points": {{"A": ["-200 m", "30 m"], "D": [0, 0], "P": ["3 m", "-2 m"]}}, "motions": [
            {{"point": "A", "angle": "20 deg", "s": "5 m/s*t + 0.05 m/s^2*t^2"}}, {{"point": "B", "centre": [0, 0], "radius": "150 m", "s": "3 m/s*t"}},
            {{"point": "D", "toward": "A", "speed": "9 m/s"}}, {{"point": "P", "r": "2 m + 1 m/s*t", "phi": "0.3 rad/s^2*t^2"}},
            {{"point": "Q", "x": "3 m + (2 m + 1 m/s*t)*cos(0.3 rad/s^2*t^2)", "y": "-2 m + (2 m + 1 m/s*t)*sin(0.3 rad/s^2*t^2)"}}],
            "find": ["l_AB", "omega_AB", "vr_A/B", "ar_A/B", "l_DB", "vr_D/B", "r_P", "r_Q", "a_P", "a_Q", "l_PQ", "r_A", "r_B", "r_D"]}}"#
        )
    };
    let (t, h) = (4.0, 1e-3);
    let at = |t: f64| {
        let (problem, solved) = solved(&text(t));
        let value = |find: &str| {
            &solved.answers[problem.find.iter().position(|f| f.text == find).unwrap()].value
        };
        let vector = |find: &str| value(find).vector().unwrap();
        let scalar = |find: &str| value(find).scalar().unwrap_or(0.0);
        let off = |a: &str, b: &str| [0, 1].map(|k| vector(a)[k] - vector(b)[k]);
        let all = ["vr_A/B", "ar_A/B", "vr_D/B", "r_P", "r_Q", "a_P", "a_Q"].map(vector);
        (
            [off("r_A", "r_B"), off("r_D", "r_B")],
            ["l_AB", "omega_AB", "l_DB", "l_PQ"].map(scalar),
            all,
        )
    };
    let ([before, ..], ([d, e], [l, omega, far, none], [v, a, w, p, q, pp, qq]), [after, ..]) =
        ([at(t - h).0], at(t), [at(t + h).0]);
    let near = |a: f64, b: f64, off: f64| assert!((a - b).abs() < off, "{a} {b}");
    near(l, d[0].hypot(d[1]), 1e-12);
    near(far, e[0].hypot(e[1]), 1e-9);
    near(none, 0.0, 1e-12);
    near(
        omega,
        (after[0][1].atan2(after[0][0]) - before[0][1].atan2(before[0][0])) / (2.0 * h),
        1e-8,
    );
    for k in 0..2 {
        near(v[k], (after[0][k] - before[0][k]) / (2.0 * h), 1e-6);
        near(a[k], (after[0][k] - 2.0 * d[k] + before[0][k]) / (h * h), 1e-5);
        near(w[k], (after[1][k] - before[1][k]) / (2.0 * h), 1e-5);
        near(p[k], q[k], 1e-13);
        near(pp[k], qq[k], 1e-12);
    }
}

/// The vectors of a plate are calculated: both languages say so, and no answer is shown as drawn.
#[test]
fn what_is_calculated_is_not_drawn() {
    for name in templates::names() {
        let (problem, found) = solved(templates::get(name).unwrap());
        let drawn = board::draw(&problem).unwrap();
        let calculated = drawn.iter().all(|d| d.calculated);
        assert_eq!(calculated, !name.starts_with("pursuit"), "{name}");
        for (lang, words, claim) in
            [(Lang::En, "alculated", "drawing differs by"), (Lang::Zh, "计算所得", "作图相差")]
        {
            let said =
                report::text(&problem, &found, &drawn, 6, Some(&Notation::of_language(lang)), lang);
            assert_eq!(said.contains(words), calculated, "{name}: {said}");
            assert_eq!(said.contains(claim), !calculated, "{name}: {said}");
            assert!(
                !calculated || !said.contains("measure") && !said.contains("量得"),
                "{name}: {said}"
            );
        }
        let json = report::json(&problem, &found, &drawn, 6, &[]);
        let any = json["answers"].as_array().unwrap().iter().any(|a| !a["drawn"].is_null());
        assert_eq!(any, !calculated, "{name}");
    }
}

/// Toward the meeting the line of sight turns more and more slowly: values that the board cannot
/// show are not read from it, with a note; values that it shows agree.
#[test]
fn nothing_is_read_that_the_board_cannot_show() {
    let (mut unread, mut read_off) = (0, 0);
    for t in (0..10)
        .map(|k| 70.0 * f64::from(k))
        .chain((0..8).map(|k| 1300.0 + 50.0 * f64::from(k)))
        .chain([1660.0, 1666.5, 1666.66])
    {
        let text = templates::get("pursuit")
            .unwrap()
            .replace("\"t1\": \"0 s\"", &format!("\"t1\": \"{t} s\""));
        let (problem, found) = solved(&text);
        let drawn = board::draw(&problem).unwrap();
        unread += usize::from(drawn[0].unread.is_some());
        for a in &found.answers {
            let what = problem.find[a.find].what;
            let Some(read) = report::drawn(&drawn, what) else { continue };
            let off = report::apart(&a.value, read, report::largest(&problem, &found, what))
                .unwrap_or(0.0);
            assert!(off <= 1e-9, "{t} s: {} {off:e}", problem.find[a.find].text);
            read_off += usize::from(matches!(what, ParticleQuantity::LineOmega(_)));
        }
    }
    assert!(unread > 2 && read_off > 10, "{unread} {read_off}");
}
