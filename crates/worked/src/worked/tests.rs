//! Tests of scenes with alternative notations, by their answers and notes.

use super::{Scope, Worked, work};
use hodograph_analytic::SingularKind;
use hodograph_base::diag::Diagnostic;
use hodograph_mechanism::answer::AnswerValue;
use hodograph_scene::{DiagramKind, read, templates};

fn values(source: &str) -> Vec<AnswerValue> {
    let scene = read(source).unwrap_or_else(|f| panic!("{f}")).value;
    work(&scene, Scope::Questions)
        .unwrap_or_else(|f| panic!("{f}"))
        .value
        .results
        .iter()
        .map(|r| r.value())
        .collect()
}

fn notes(source: &str) -> Vec<Diagnostic> {
    let scene = read(source).unwrap_or_else(|f| panic!("{f}")).value;
    work(&scene, Scope::Questions).unwrap_or_else(|f| panic!("{f}")).notes
}

const LENGTHS: &str = r#"{"AB": "100 mm", "BC": "250 mm", "CD": "200 mm", "AD": "300 mm", "BE": "150 mm", "CE": "140 mm"}"#;

/// A four-bar with a coupler point, with the given sides and lengths.
fn four_bar(side: &str, lengths: &str) -> String {
    format!(
        r#"{{"links": {{"1": ["A", "B"], "2": ["B", "C", "E"], "3": ["C", "D"], "4": ["A", "D"]}}, "ground": "4", "lengths": {lengths},
 "driver": {{"link": "1", "angle": "60 deg", "omega": "10 rad/s"}}, "side": {side}}}"#
    )
}

#[test]
fn the_angle_of_a_slot_is_that_of_its_link() {
    // A disc that consists of its pivot and its slot only; a pin on a guided rod runs in the slot.
    let slotted = |driver: &str| {
        format!(
            r#"{{"links": {{"1": ["O"], "2": ["B", "C"], "4": ["O", "C"]}}, "ground": "4",
 "points": {{"O": [0, 0], "C": ["300 mm", "40 mm"]}}, "lengths": {{"BC": "150 mm"}},
 "guides": [{{"pin": "B", "on": "1", "through": "O", "angle": "20 deg"}}], "driver": {{"link": "1"{driver}, "omega": "2 rad/s"}},
 "sketch": {{"B": [150, 60]}}, "units": {{"length": "mm"}}, "find": ["v_B", "phi_1"]}}"#
        )
    };
    assert_eq!(values(&slotted("")), values(&slotted(r#", "angle": "20 deg""#)));
}

#[test]
fn notes_speak_in_the_units_of_the_scene() {
    let in_unit = |unit: &str| {
        format!(
            r#"{{"links": {{"1": ["A", "B"], "2": ["B", "C"], "3": ["C", "D"], "4": ["A", "D"]}}, "ground": "4",
 "lengths": {{"AB": "1 {unit}", "BC": "2.5 {unit}", "CD": "2 {unit}", "AD": "3 {unit}"}},
 "driver": {{"link": "1", "angle": "60 deg", "omega": "1 rad/s"}}, "find": ["v_C"]}}"#
        )
    };
    for unit in ["in", "ft", "m", "cm", "mm", "km"] {
        let said = notes(&in_unit(unit));
        let note = said
            .iter()
            .find(|d| d.code == "assembly-by-default")
            .unwrap_or_else(|| panic!("{said:?}"));
        assert!(
            note.message.en.contains(&format!("C at (2.737 {unit}, 1.983 {unit})")),
            "{unit}: {note}"
        );
    }
    // Bare numbers have the unit of the table.
    let bare = in_unit("#").replace(" #", "").replacen('{', r#"{"units": {"length": "in"}, "#, 1);
    assert!(
        notes(&bare).iter().any(|d| d.message.en.contains("(2.737 in, 1.983 in)")),
        "{:?}",
        notes(&bare)
    );
    let far = in_unit("in").replace("3 in", "9 in");
    let scene = read(&far).unwrap().value;
    let said = work(&scene, Scope::Questions).unwrap_err().to_string();
    assert!(said.contains(" in ") && !said.contains(" mm"), "{said}");
}

#[test]
fn a_side_that_fits_all_assemblies_does_not_decide() {
    // D is to the right of AB in both assemblies; C is above AD in one of them only.
    let side = |said: &str| {
        notes(&four_bar(said, LENGTHS))
            .into_iter()
            .filter(|d| d.code.contains("side") || d.code.contains("assembly"))
            .collect()
    };
    let idle: Vec<Diagnostic> = side(r#"{"D": "right of AB", "E": "left of BC"}"#);
    assert!(
        idle.iter().any(|d| d.code == "assembly-by-default"),
        "a side of what the group does not move says nothing of it: {idle:?}"
    );
    let decided: Vec<Diagnostic> = side(r#"{"C": "left of AD", "E": "left of BC"}"#);
    assert!(decided.is_empty(), "{decided:?}");
    // A long coupler puts C beyond AB in both.
    let long = r#"{"AB": "20 mm", "BC": "250 mm", "CD": "240 mm", "AD": "300 mm", "BE": "150 mm", "CE": "140 mm"}"#;
    let said = notes(&four_bar(r#"{"C": "right of AB", "E": "left of BC"}"#, long));
    let note = said.iter().find(|d| d.code == "side-undecided");
    match note {
        Some(note) => assert!(note.message.en.contains("this side does not decide"), "{note}"),
        None => panic!("{said:?}"),
    }
}

/// Two dyads on the same pivots: the first assembly of each makes them coincide, and the last one
/// has no base.
#[test]
fn another_assembly_is_tried_where_the_first_does_not_close() {
    let text = r#"{"links": {"1": ["Q", "C"], "2": ["O", "A"], "3": ["O", "B"], "4": ["A", "C"], "5": ["C", "B"], "6": ["A", "P"],
  "7": ["P", "B"], "8": ["O", "Q"]}, "ground": "8", "points": {"O": [0, 0], "Q": ["60 mm", 0]},
 "lengths": {"QC": "60 mm", "OA": "180 mm", "OB": "180 mm", "AC": "80 mm", "CB": "80 mm", "AP": "80 mm", "PB": "80 mm"},
 "driver": {"link": "1", "angle": "30 deg", "omega": "5 rad/s"}, "find": ["v_P", "x_P"]}"#;
    let scene = read(text).unwrap().value;
    let worked = work(&scene, Scope::Questions).unwrap_or_else(|f| panic!("{f}"));
    // P moves on a straight line square to OQ, at k²/(2·OQ) from O with k² = OA² − AC².
    let AnswerValue::Vector(v) = worked.value.results[0].value() else {
        panic!("a velocity is a vector")
    };
    let AnswerValue::Scalar(x) = worked.value.results[1].value() else {
        panic!("a coordinate is a number")
    };
    assert!(
        v.x.abs() < 1e-12 * v.norm()
            && (x - (0.18f64.powi(2) - 0.08f64.powi(2)) / 0.12).abs() < 1e-12,
        "{v:?} {x}"
    );
    assert!(
        worked.notes.iter().any(|d| d.code == "assembly-by-default"),
        "what was chosen is said: {:?}",
        worked.notes
    );
    assert!(worked.value.solution.singular.iter().all(|s| s.kind != SingularKind::ChangePoint));
    // If none closes, the first fault is reported, with the remedy.
    let apart = text.replace(r#""AP": "80 mm", "PB": "80 mm""#, r#""AP": "1 mm", "PB": "1 mm""#);
    let said = work(&read(apart).unwrap().value, Scope::Questions).unwrap_err().to_string();
    assert!(said.contains("or say with \"side\" or \"sketch\" which assembly of links"), "{said}");
}

#[test]
fn answers_have_the_form_that_the_table_says() {
    for t in templates::list() {
        let scene = read(templates::get(t.name).unwrap()).unwrap().value;
        let worked =
            work(&scene, Scope::Questions).unwrap_or_else(|f| panic!("{}: {f}", t.name)).value;
        for r in &worked.results {
            let find = &scene.find[r.find];
            let entry = find.what.entry();
            for value in r.drawn.iter().map(|d| d.value).chain([r.computed]) {
                assert_eq!(value.form(), entry.form, "{} {}", t.name, find.text);
                assert_eq!(value.columns().len(), entry.form.columns().len());
            }
            // A quantity answered by a formula is known to be required.
            assert!(
                find.what.needs().iter().any(|n| n.1 == entry.level),
                "{} {}",
                t.name,
                find.text
            );
        }
    }
}

#[test]
fn ratios_are_those_of_the_teeth() {
    // Sun 2 of 40 teeth, planet 4 of 20, ring 1 of 80 fixed, arm 3.
    let text = templates::get("planetary-gear").unwrap();
    let asking = |find: &str| text.replace(r#""find": ["#, &format!(r#""find": ["{find}", "#));
    for (find, expected) in [
        ("i_2,3", 3.0),
        ("i_3/2", 1.0 / 3.0),
        ("i_24", -1.0),
        ("i_24/3", -0.5),
        ("i_21/3", -2.0),
        ("i_41/3", 4.0),
        ("i_14/3", 0.25),
    ] {
        let scene = read(asking(find)).unwrap_or_else(|f| panic!("{find}: {f}")).value;
        let worked = work(&scene, Scope::Questions).unwrap().value;
        let outcome = worked
            .results
            .iter()
            .find(|r| r.find == 0)
            .unwrap_or_else(|| panic!("{find} is not answered"));
        for value in [outcome.drawn.as_ref().map(|d| d.value), Some(outcome.computed)] {
            let Some(AnswerValue::Scalar(i)) = value else { panic!("{find}: {value:?}") };
            assert!((i - expected).abs() < 1e-13, "{find}: {i}");
        }
    }
    for wrong in ["i_22", "i_1,2", "i_24/4", "i_3", "i_24/9"] {
        let faults = read(asking(wrong)).unwrap_err();
        assert!(
            faults.list.iter().all(|d| d.code == "find" || d.help.is_some()),
            "{wrong}: {faults}"
        );
    }
    // A link at rest divides nothing.
    let still = text.replace("240 rpm", "0 rpm").replace(r#""find": ["#, r#""find": ["i_24", "#);
    let scene = read(still).unwrap().value;
    let worked = work(&scene, Scope::Questions).unwrap().value;
    let found: Vec<usize> = worked.unanswered.iter().map(|u| u.find).collect();
    assert!(
        found.contains(&0)
            && worked.results.len() > 2
            && found.len() + worked.results.len() == scene.find.len(),
        "{:?}",
        worked.unanswered
    );
}

/// Every question about links at rest is answered or reported to have no value; no question removes
/// the others' answers.
#[test]
fn what_rest_leaves_undefined_is_one_answer_of_many() {
    let mut undefined = 0;
    for template in ["crank-rocker", "planetary-gear", "disc-on-rod"] {
        let text = templates::get(template).unwrap();
        let mut json: serde_json::Value = serde_json::from_str(text).unwrap();
        let own: Vec<String> = json["find"]
            .as_array()
            .unwrap()
            .iter()
            .map(|f| f.as_str().unwrap().to_owned())
            .collect();
        let scene = read(text).unwrap().value;
        let (points, links) =
            (scene.points.iter().map(|p| &p.name), scene.links.iter().map(|l| &l.name));
        let (points, links): (Vec<_>, Vec<_>) = (points.collect(), links.collect());
        let pairs = |of: &[&String]| {
            of.iter().flat_map(|a| of.iter().map(move |b| format!("{a},{b}"))).collect::<Vec<_>>()
        };
        let mut asked = own.clone();
        for symbol in [
            "i", "rho", "O", "J", "d", "K", "u", "p", "P", "an", "at", "vr", "aen", "aet", "arn",
            "art",
        ] {
            let names = points
                .iter()
                .chain(&links)
                .map(|n| n.to_string())
                .chain(pairs(&points))
                .chain(pairs(&links));
            let framed = points.iter().flat_map(|p| links.iter().map(move |l| format!("{p}/{l}")));
            asked.extend(names.chain(framed).map(|n| format!("{symbol}_{n}")));
        }
        // The questions that apply to the scene.
        asked.retain(|q| {
            json["find"] = serde_json::json!([q]);
            read(json.to_string())
                .is_ok_and(|s| hodograph_scene::quantity::undefined(&s.value).list.is_empty())
        });
        json["find"] = serde_json::json!(asked);
        let mut scene = read(json.to_string()).unwrap_or_else(|f| panic!("{template}: {f}")).value;
        for d in &mut scene.drivers {
            d.rate.value = 0.0;
            d.acceleration = None;
        }
        let worked =
            work(&scene, Scope::Questions).unwrap_or_else(|f| panic!("{template}: {f}")).value;
        assert_eq!(
            worked.results.len() + worked.unanswered.len() + worked.at_infinity.len(),
            scene.find.len(),
            "{template}"
        );
        assert!(worked.results.len() >= own.len().min(2), "{template} answers nothing");
        undefined += worked.unanswered.len();
    }
    assert!(undefined > 5, "only {undefined} questions without a value");
}

/// A finished work drawn to other scales is the work of a scene with these scales, to the last bit.
#[test]
fn scales_are_a_parameter_of_the_drawing() {
    let flat = four_bar(r#"{"C": "left of BD", "E": "left of BC"}"#, LENGTHS);
    let templates = ["shaper", "stephenson-six-bar", "four-bar-forces", "class-iv-six-bar"];
    let texts = templates.iter().map(|name| templates::get(name).unwrap().to_owned());
    for text in texts.chain([flat]) {
        let mut scene = read(&text).unwrap().value;
        let worked = work(&scene, Scope::Figure).unwrap().value;
        for on in DiagramKind::ALL {
            let coarser = worked.scale(on).map(|mu| 2.5 * mu);
            scene.paper.scales.set(on.kind(), coarser);
        }
        let again = work(&scene, Scope::Figure).unwrap().value;
        let drawn = worked.to_scales(&scene).unwrap();
        assert_ne!(drawn.construction, worked.construction);
        assert_eq!(drawn.construction, again.construction);
        assert_eq!(drawn.results, again.results);
        assert_eq!(drawn.bad_angles, again.bad_angles);
        let mu = |w: &Worked| DiagramKind::ALL.map(|on| w.scale(on));
        assert_eq!(mu(&drawn), mu(&again));
    }
}
