//! Units of the book: printed values are the SI values in these units, nothing is left in SI, and
//! for an unknown unit the message lists the known ones.

use super::{hodograph, text};
use serde_json::{Value, json};

/// Kind, unit, and its value in SI units.
type Units = [(&'static str, &'static str, f64); 6];

const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// No unit of the first list is an SI unit or the name of one.
const BOOKS: [Units; 3] = [
    [
        ("length", "in", 0.0254),
        ("angle", "rev", 360.0 * DEGREE),
        ("velocity", "ft/s", 0.3048),
        ("acceleration", "in/s^2", 0.0254),
        ("omega", "rpm", 6.0 * DEGREE),
        ("alpha", "rev/min^2", DEGREE / 10.0),
    ],
    [
        ("length", "km", 1000.0),
        ("angle", "rad", 1.0),
        ("velocity", "mm/min", 1e-3 / 60.0),
        ("acceleration", "mm/s^2", 1e-3),
        ("omega", "r/min", 6.0 * DEGREE),
        ("alpha", "deg/s^2", DEGREE),
    ],
    [
        ("length", "ft", 0.3048),
        ("angle", "deg", DEGREE),
        ("velocity", "cm/s", 1e-2),
        ("acceleration", "ft/min^2", 0.3048 / 3600.0),
        ("omega", "deg/s", DEGREE),
        ("alpha", "rad/min^2", 1.0 / 3600.0),
    ],
];

/// Scenes with a question of every kind, including those that only a slot answers.
fn scenes() -> Vec<Value> {
    let of = |template: &str, find: &[&str]| {
        let mut scene: Value =
            serde_json::from_str(hodograph::scene::templates::get(template).unwrap()).unwrap();
        scene["find"] = json!(find);
        scene
    };
    let four_bar = [
        "x_E",
        "y_E",
        "phi_3",
        "l_AC",
        "v_E",
        "v_CB",
        "a_E",
        "a_CB",
        "an_CB",
        "at_CB",
        "omega_3",
        "omega_3/2",
        "alpha_2",
        "alpha_3/2",
    ];
    vec![
        of("crank-rocker", &four_bar),
        of("slotted-lever", &["vr_B2B3", "ar_B2B3", "ak_B2B3", "omega_3", "alpha_3"]),
        of("excavator", &["v_K", "a_K", "omega_5", "alpha_5"]),
    ]
}

fn with(scene: &Value, units: &Units) -> String {
    let mut scene = scene.clone();
    scene["answers"] = units
        .iter()
        .map(|(kind, unit, _)| ((*kind).to_owned(), json!(unit)))
        .collect::<serde_json::Map<_, _>>()
        .into();
    scene.to_string()
}

/// Returns the output of a command for a scene.
fn printed(arguments: &[&str], scene: &str) -> String {
    let mut all = arguments.to_vec();
    all.insert(1, "-");
    let run = hodograph().args(all).write_stdin(scene.to_owned()).assert().success();
    text(&run.get_output().stdout)
}

/// Half a unit of the last digit of a number with this number of digits, the limit of rounding.
fn half_a_unit(number: f64, digits: u64) -> f64 {
    0.5 * 10f64.powi(number.abs().log10().floor() as i32 + 1 - digits as i32)
}

#[test]
fn a_printed_number_times_its_unit_is_the_si_value() {
    let mut checked = 0;
    for scene in scenes() {
        for units in &BOOKS {
            for digits in ["3", "6", "12"] {
                let all: Value = serde_json::from_str(&printed(
                    &["solve", "--json", "--digits", digits],
                    &with(&scene, units),
                ))
                .unwrap();
                for answer in all["answers"].as_array().unwrap() {
                    let unit = answer["in_unit"]["unit"]
                        .as_str()
                        .unwrap()
                        .replace('²', "^2")
                        .replace('°', "deg");
                    let si_unit = answer["unit"].as_str().unwrap();
                    let (_, _, size) =
                        units.iter().find(|u| u.1 == unit).unwrap_or_else(|| panic!("{unit}"));
                    let value = &answer["value"];
                    let si = value["magnitude"].as_f64().or(value["value"].as_f64()).unwrap();
                    let number = answer["in_unit"]["text"].as_str().unwrap();
                    let shown: f64 = number.parse().unwrap();
                    let off = (shown * size - si).abs();
                    let certain =
                        answer["certified"]["numbers"]["in_unit"]["digits"].as_u64().unwrap();
                    assert_eq!(certain.to_string(), digits, "{}", answer["find"]);
                    let rounding =
                        (1.0 + 1e-6) * half_a_unit(shown, certain) * size + 1e-14 * si.abs();
                    assert!(
                        off <= rounding,
                        "{}: {number} {unit} is not {si} {si_unit}",
                        answer["find"]
                    );
                    let in_f64 = answer["in_unit"]["value"].as_f64().unwrap();
                    assert!(
                        (in_f64 * size - si).abs() <= 1e-14 * si.abs(),
                        "{}: {in_f64} {unit}",
                        answer["find"]
                    );
                    checked += 1;
                }
            }
        }
    }
    assert!(checked > 150, "{checked}");
}

/// The formulas of a document as plain text.
fn plain(document: &str) -> String {
    document.replace("\\text{", "").replace(['{', '}', '\\'], "")
}

#[test]
fn nothing_is_left_in_si() {
    let out = tempfile::tempdir().unwrap();
    let file = |name: &str| out.path().join(name).to_string_lossy().into_owned();
    for (k, scene) in scenes().iter().enumerate() {
        let scene = with(scene, &BOOKS[0]);
        let mut all = vec![
            ("solve", printed(&["solve", "--steps", "--drafting", "0.1mm"], &scene)),
            ("solve zh", printed(&["solve", "--steps", "--lang", "zh"], &scene)),
        ];
        let mut writes = vec![
            ("worksheet", vec!["worksheet"], "md"),
            ("sheet", vec!["draw"], "svg"),
            ("curves", vec!["curves", "--steps", "8"], "svg"),
        ];
        if k == 0 {
            all.push(("limits", printed(&["limits"], &scene)));
            writes.push(("path", vec!["path", "--point", "E"], "svg"));
            writes.push(("poses", vec!["draw", "--poses", "3"], "svg"));
            writes.push(("lesson", vec!["lesson", "--positions", "8"], "html"));
        }
        for (name, mut arguments, ending) in writes {
            let path = file(&format!("{name}-{k}.{ending}"));
            arguments.extend(["-o", &path]);
            printed(&arguments, &scene);
            let text = std::fs::read_to_string(&path).unwrap();
            let told = hodograph::lesson::told(&text).unwrap_or_default();
            all.push((name, text + &told));
        }
        for (name, said) in all {
            // The deflated data of a page are read through its own decoder.
            let said: Vec<&str> = said
                .split_inclusive(['"', '>', '<', '`'])
                .filter(|part| part.len() < 1000 || part.contains(' '))
                .collect();
            let said = plain(&said.concat());
            for si in ["m/s", "rad/s", "m/mm", "(m/"] {
                let at = said
                    .match_indices(si)
                    .find(|(i, _)| !said[..*i].ends_with(|c: char| c.is_ascii_alphabetic()));
                assert!(at.is_none(), "{name} {k}: ...{}...", around(&said, at.unwrap().0));
            }
            assert!(
                name == "limits" || said.contains("ft/s") && said.contains("in/s"),
                "{name} {k} has no unit of the book"
            );
        }
    }
}

fn around(text: &str, at: usize) -> String {
    text[..at]
        .chars()
        .rev()
        .take(60)
        .collect::<Vec<_>>()
        .into_iter()
        .rev()
        .chain(text[at..].chars().take(40))
        .collect()
}

#[test]
fn what_is_no_unit_is_answered_by_those_that_fit() {
    let mut scene = scenes().remove(0);
    scene["answers"] =
        json!({"velocity": "mm", "omega": "rmp", "alpha": "2*rad/s^2", "speed": "m/s"});
    let run = hodograph().args(["solve", "-"]).write_stdin(scene.to_string()).assert().code(2);
    let said = text(&run.get_output().stderr);
    for part in [
        "`mm` is not a unit of a velocity (units that fit are m/s, cm/s, mm/s, km/s, in/s, ft/s; min and h may stand for s)",
        "`rmp` is not a unit of an angular velocity (units that fit are deg/s, rad/s, rev/s, rpm, r/min;",
        "`2*rad/s^2` is not a unit of an angular acceleration (units that fit are deg/s^2,",
        "`speed` is not a quantity of \"answers\"",
    ] {
        assert!(said.contains(part), "{part}\n{said}");
    }
}

/// Scales are round in their printed unit.
#[test]
fn scales_are_of_the_series_in_the_unit_of_the_book() {
    for scene in scenes() {
        let said = printed(&["solve", "--steps"], &with(&scene, &BOOKS[0]));
        let scales: Vec<&str> = said
            .lines()
            .filter_map(|l| l.split("μ_").nth(1)?.split(" = ").nth(1)?.split(' ').next())
            .collect();
        assert!(scales.len() >= 3, "{said}");
        for mu in scales {
            let series = mu.trim_start_matches(['0', '.']).trim_end_matches('0');
            assert!(["1", "2", "25", "2.5", "5"].contains(&series), "{mu}\n{said}");
        }
    }
}

#[test]
fn statements_hold_mathematics_and_values() {
    let out = tempfile::tempdir().unwrap();
    let problem = |statement: &str, parameters: Value| {
        let mut scene = scenes().remove(0);
        scene["statement"] = json!(statement);
        scene["parameters"]
            .as_object_mut()
            .unwrap()
            .extend(parameters.as_object().unwrap().clone());
        let path = out.path().join("problem.md").to_string_lossy().into_owned();
        let run = hodograph()
            .args(["worksheet", "-", "--problem-only", "-o", &path])
            .write_stdin(scene.to_string())
            .assert();
        let said = text(&run.get_output().stderr);
        let written = std::fs::read_to_string(&path).unwrap_or_default();
        let _ = std::fs::remove_file(&path);
        (written.split("\n\n").nth(2).unwrap_or_default().to_owned(), said)
    };
    let more = json!({"n": "300 rpm", "r": "4.50 in", "b": "2*r", "k": "2.5", "e": "-1.5 rad/s^2"});
    for (statement, shown) in [
        ("turns at {n}, find $v_D$", r"turns at $300\ \text{rpm}$, find $v_{D}$"),
        ("{r}, {b}, {k}, {phi_1}", r"$4.50\ \text{in}$, $9\ \text{in}$, $2.5$, $60{}^\circ$"),
        (
            r"$\omega_1 = {n}$ and $a^n_{CB}$, {e}",
            r"$\omega_{1}=300\ \text{rpm}$ and $a_{CB}^{n}$, $-1.5\ \text{rad/s}^{2}$",
        ),
        ("it costs $5", r"it costs \$5"),
        ("$5 or $6, US$7, 8 $", r"\$5 or \$6, US\$7, 8 \$"),
        (r"\$x\$", r"\$x\$"),
        ("{{r}} and { r }, } {", "{r} and { r }, } {"),
        ("  two   spaces\t$x$", "two spaces $x$"),
    ] {
        let (written, said) = problem(statement, more.clone());
        assert_eq!(written, shown, "{statement}: {said}");
    }
    for (statement, fault) in [
        ("the crank {l_ab}", "`{l_ab}` in the statement names no parameter (did you mean `l_AB`?"),
        ("$v = {l_ab}$", "`{l_ab}` in the statement names no parameter"),
        ("find $v_{D$ now", "label `v_{D`: a { without its }"),
        (&format!("${}x$", "{".repeat(9000)), "braces of a formula are nested more than 24 deep"),
        (r"find $\omga_1$", r"label `\omga_1`: unknown command \omga"),
    ] {
        let (written, said) = problem(statement, json!({}));
        assert!(
            written.is_empty() && said.contains(fault) && said.contains("standard input:1:"),
            "{statement}: {said}"
        );
    }
}

/// A two-letter name is similar to many: all units are listed, and no unit of another kind is
/// proposed.
#[test]
fn short_names_of_units_are_not_guessed_from() {
    for (length, told) in [
        ("10 mn", "the units are m, "),
        ("10 xm", "the units are m, "),
        ("10 MM", "did you mean `mm`?"),
        ("10 inn", "did you mean"),
    ] {
        let source = json!({"links": {"1": ["A", "B"], "2": ["A"]}, "ground": "2", "lengths": {"AB": length},
            "driver": {"link": "1", "angle": "0 deg", "omega": "1 rad/s"}, "find": ["v_B"]});
        let faults = hodograph::scene::read(source.to_string()).unwrap_err();
        let fault = faults
            .list
            .iter()
            .find(|d| d.code == "unknown-unit")
            .unwrap_or_else(|| panic!("{length}: {faults}"));
        let help = format!("{:?}", fault.help);
        assert!(help.contains(told), "{length}: {help}");
    }
}
