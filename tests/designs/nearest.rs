//! Impossible tasks: each is refused with the nearest possible task, and that task, put in, is
//! solved.

use crate::{Mixed, mm};
use hodograph::diag::Diagnostic;
use hodograph::synthesis::{Design, read, solve};
use serde_json::{Value as Json, json};

fn tried(task: &Json) -> Result<Design, Vec<Diagnostic>> {
    read(task.to_string()).and_then(|t| solve(&t.value)).map_err(|f| f.list)
}

/// The numbers of a text, in order.
fn numbers(text: &str) -> Vec<f64> {
    let number = |c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '−');
    text.split(|c: char| !number(c))
        .map(|t| t.replace('−', "-"))
        .filter_map(|t| t.trim_end_matches('.').parse().ok())
        .collect()
}

/// Checks that a task is refused with this code, and solves the task with the numbers of the help.
fn cured(task: &Json, code: &str, put: impl Fn(&mut Json, &[f64])) -> Design {
    let list = match tried(task) {
        Ok(design) => design.notes,
        Err(list) => list,
    };
    let d = list.iter().find(|d| d.code == code).unwrap_or_else(|| panic!("{task}: {list:?}"));
    list.iter().for_each(|d| assert_eq!(d.english_in_chinese(), None, "{d}"));
    let help = d.help.as_ref().unwrap_or_else(|| panic!("{task}: {d} names no wish that works"));
    let told = numbers(&help.en);
    assert!(!told.is_empty(), "{task}: {d} names no number");
    assert_eq!(told, numbers(&help.zh), "{d}");
    let mut other = task.clone();
    put(&mut other, &told);
    let design = tried(&other).unwrap_or_else(|f| panic!("{task}: {d}\nbut {other}: {f:?}"));
    assert!(!design.candidates.is_empty());
    assert!(!design.notes.iter().any(|d| d.code == code), "{d}\nbut {other}: {:?}", design.notes);
    design
}

/// Solves as [`cured`], and checks that the result has no defect.
fn sound(task: &Json, code: &str, put: impl Fn(&mut Json, &[f64])) {
    let design = cured(task, code, put);
    let list: Vec<_> = design.candidates.iter().map(|c| &c.judged.defects).collect();
    assert!(list.iter().any(|d| d.is_empty()), "{task}: {list:?}");
}

fn length(v: f64) -> Json {
    mm(v)
}

fn deg(v: f64) -> Json {
    json!(format!("{v} deg"))
}

#[test]
fn time_ratios() {
    let rocker = |given: Json| {
        let mut task =
            json!({"synthesis": "time-ratio", "linkage": "crank-rocker", "rocker": "75 mm"});
        task.as_object_mut().unwrap().extend(given.as_object().unwrap().clone());
        task
    };
    // No second limit; a frame that the circle does not reach; limits on two assemblies.
    for given in [
        json!({"K": 1.5, "frame": "300 mm", "limit": "45 deg"}),
        json!({"K": 2.5, "frame": "100 mm", "limit": "120 deg"}),
        json!({"K": 1.4, "swing": "50 deg", "frame": "400 mm"}),
        json!({"K": 1.1, "swing": "30 deg", "frame": "20 mm"}),
        json!({"K": 1, "swing": "30 deg", "frame": "60 mm"}),
    ] {
        let task = rocker(given);
        let code = if tried(&task).is_err() { "no-real-solution" } else { "not-a-crank" };
        sound(&task, code, |t, n| t["frame"] = length(n[0]));
    }
    // The same task with the K given beside the frame.
    sound(
        &rocker(json!({"K": 1.4, "swing": "50 deg", "frame": "400 mm"})),
        "no-real-solution",
        |t, n| t["K"] = json!(n[1]),
    );
    // K = 3 with a swing of 10°, by a frame.
    let hard = rocker(json!({"K": 3, "swing": "10 deg", "frame": "50 mm"}));
    let code = if tried(&hard).is_err() { "no-real-solution" } else { "not-a-crank" };
    sound(&hard, code, |t, n| t["frame"] = length(n[0]));
    sound(&rocker(json!({"K": 12, "swing": "10 deg"})), "no-real-solution", |t, n| {
        t["K"] = json!(n[0] - 1e-3)
    });
    sound(&rocker(json!({"K": 1, "swing": "30 deg"})), "free-choice", |t, n| {
        t["frame"] = length(n[0] * 1.3)
    });
    let line = rocker(
        json!({"K": 1.4, "swing": "50 deg", "line": {"through": ["0 mm", "500 mm"], "angle": "0 deg"}}),
    );
    sound(&line, "no-real-solution", |t, n| {
        t["line"]["through"] = json!([length(n[0]), length(n[1])])
    });
    for (given, key) in [
        ("offset", "90 mm"),
        ("offset", "0 mm"),
        ("crank", "40 mm"),
        ("rod", "24 mm"),
        ("rod", "500 mm"),
    ]
    .map(|(k, v)| ((k, v), k))
    {
        let task = json!({"synthesis": "time-ratio", "linkage": "slider-crank", "K": 1.5, "stroke": "50 mm", given.0: given.1});
        sound(&task, "no-real-solution", |t, n| {
            t[key] = length((n[n.len() - 2] + n[n.len() - 1]) / 2.0)
        });
    }
    let centric = json!({"synthesis": "time-ratio", "linkage": "slider-crank", "K": 1, "stroke": "50 mm", "rod": "20 mm"});
    sound(&centric, "free-choice", |t, n| t["rod"] = length(n[0] * 2.0));
    let short = |linkage: &str, link: &str| json!({"synthesis": "time-ratio", "linkage": linkage, "K": 1.5, "stroke": "300 mm", "crank": "80 mm", "link": link});
    sound(&short("shaper", "5 mm"), "no-real-solution", |t, n| t["link"] = length(n[0] * 1.5));
    sound(&short("whitworth", "100 mm"), "no-real-solution", |t, n| t["link"] = length(n[0] * 1.5));
    let theta = json!({"synthesis": "time-ratio", "linkage": "slotted-lever", "theta": "190 deg", "frame": "100 mm"});
    sound(&theta, "out-of-range", |t, n| t["theta"] = deg(n[0]));
    let k =
        json!({"synthesis": "time-ratio", "linkage": "slotted-lever", "K": -2, "frame": "100 mm"});
    sound(&k, "not-positive", |t, n| t["K"] = json!(n[0]));
}

#[test]
fn presses() {
    let press = |given: Json| {
        let mut task = json!({"synthesis": "limits", "linkage": "press", "x1": "50 mm", "x2": "140 mm", "y": "220 mm",
            "angles": ["60 deg", "120 deg"], "stroke": "150 mm", "CE/CD": 0.5, "EF/DE": 0.25});
        task.as_object_mut().unwrap().extend(given.as_object().unwrap().clone());
        task
    };
    sound(&press(json!({"x2": "400 mm"})), "no-real-solution", |t, n| t["x2"] = length(n[1]));
    sound(&press(json!({"y": "0 mm"})), "no-real-solution", |t, n| {
        if n[0] == 1.0 { t["x1"] = length(n[1]) } else { t["y"] = length(n[0]) }
    });
    // A beside the rocker: the crank does not turn fully.
    sound(&press(json!({"x1": "140 mm", "y": "70 mm"})), "not-a-crank", |t, n| {
        if n[0] == 1.0 { t["x1"] = length(n[1]) } else { t["y"] = length(n[0]) }
    });
    sound(&press(json!({"angles": ["120 deg", "60 deg"]})), "out-of-range", |t, n| {
        t["angles"] = json!([deg(n[0]), deg(n[1])])
    });
}

fn positions(all: &[[f64; 3]]) -> Vec<Json> {
    all.iter().map(|[x, y, a]| json!([mm(*x), mm(*y), deg(*a)])).collect()
}

#[test]
fn bodies() {
    // Three places in line: of a pin, of the whole body, and of an inverted pivot.
    let line = json!({"synthesis": "body", "positions": positions(&[[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [25.0, 0.0, 30.0]]),
        "moving": {"B": [0, 0], "C": ["30 mm", "5 mm"]}});
    cured(&line, "no-real-solution", |t, n| t["moving"]["B"] = json!([length(n[0]), length(n[1])]));
    let shifted = json!({"synthesis": "body", "positions": positions(&[[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [25.0, 0.0, 0.0]]),
        "moving": {"B": [0, 0], "C": ["30 mm", "5 mm"]}});
    cured(&shifted, "no-real-solution", |t, n| {
        t["positions"][1] = json!([length(n[1]), length(n[2]), "0 deg"])
    });
    let back = json!({"synthesis": "body", "positions": positions(&[[0.0, 0.0, 0.0], [-10.0, 0.0, 0.0], [-25.0, 0.0, 0.0]]),
        "ground": {"A": [0, 0], "D": ["30 mm", "5 mm"]}});
    cured(&back, "no-real-solution", |t, n| {
        t["positions"][1] = json!([length(n[1]), length(n[2]), "0 deg"])
    });
    let three = positions(&[[0.0, 0.0, 0.0], [60.0, 35.0, 20.0], [95.0, 95.0, 55.0]]);
    let one =
        json!({"synthesis": "body", "positions": three, "moving": {"B": [0, 0], "C": [0, 0]}});
    cured(&one, "wrong-given", |t, n| t["moving"]["C"] = json!([length(n[0]), length(n[1])]));
    let still = json!({"synthesis": "body", "positions": positions(&[[0.0, 0.0, 0.0], [0.0, 0.0, 40.0]]), "moving": {"B": [0, 0], "C": ["30 mm", 0]}});
    cured(&still, "no-real-solution", |t, n| {
        t["moving"]["B"] = json!([length(n[0]), length(n[1])])
    });
    // Four: a line far from the curve, a box, angles.
    let four =
        positions(&[[0.0, 0.0, 0.0], [12.0, 8.0, 20.0], [30.0, 14.0, 55.0], [50.0, 10.0, 95.0]]);
    let far = json!({"synthesis": "body", "positions": four, "line": {"through": [mm(0.0), mm(900.0)], "angle": "0 deg"}});
    cured(&far, "no-real-solution", |t, n| {
        t["line"] = json!({"through": [length(n[0]), length(n[1])], "angle": deg(n[2])});
    });
    let boxed = json!({"synthesis": "body", "positions": four, "box": {"from": [mm(400.0), mm(400.0)], "to": [mm(410.0), mm(410.0)]}});
    cured(&boxed, "no-real-solution", |t, n| {
        t["box"] =
            json!({"from": [length(n[0]), length(n[1])], "to": [length(n[2]), length(n[3])]});
    });
    let mut seen = 0;
    for pair in
        [[1.0, 2.0], [10.0, 170.0], [90.0, 91.0], [178.0, 179.0], [45.0, 60.0], [120.0, 150.0]]
    {
        let task = json!({"synthesis": "body", "positions": four, "angles": pair.map(deg)});
        if tried(&task).is_err() {
            cured(&task, "no-real-solution", |t, n| t["angles"] = json!([deg(n[0]), deg(n[1])]));
            seen += 1;
        }
    }
    assert!(seen > 0);
    let angles = json!({"synthesis": "body", "positions": four, "angles": ["0 deg", "190 deg"]});
    assert!(
        tried(&angles).unwrap_err().iter().all(|d| d.code == "out-of-range" && d.help.is_some())
    );
    // Five positions without a real pair.
    let mut none = 0;
    for k in 0..40 {
        let at = |i: usize| {
            let mix = |m: f64| ((f64::from(k) * 12.9898 + i as f64 * m).sin() * 43758.545).fract();
            [mix(78.233) * 40.0, mix(37.719) * 40.0, mix(9.151) * 80.0]
        };
        let task = json!({"synthesis": "body", "positions": positions(&[at(0), at(1), at(2), at(3), at(4)])});
        if tried(&task).is_err() {
            cured(&task, "no-real-solution", |t, n| t["positions"][4][2] = deg(n[1]));
            none += 1;
        }
    }
    assert!(none > 0, "all have pairs");
}

#[test]
fn functions() {
    let ln = |given: Json| {
        let mut task = json!({"synthesis": "function", "function": {"y": "ln(x)", "from": 1, "to": 2}, "points": 3,
            "input": {"from": "86 deg", "swing": "60 deg"}, "output": {"from": "24 deg", "swing": "85 deg"}, "frame": "100 mm"});
        task.as_object_mut().unwrap().extend(given.as_object().unwrap().clone());
        task
    };
    // With both starts given, three pairs always have a linkage; with a free start, four or five
    // random pairs need not have one.
    let mut r = Mixed(51);
    let mut seen = [0, 0];
    for k in 0..24 {
        let count = 4 + k % 2;
        let pairs: Vec<[f64; 2]> =
            (0..count).map(|_| [r.between(0.0, 360.0), r.between(0.0, 360.0)]).collect();
        let relative = ["output", "both"][k % 2];
        let task = json!({"synthesis": "function", "pairs": pairs.iter().map(|p| p.map(deg)).collect::<Vec<_>>(), "relative": relative});
        if tried(&task).is_err() {
            cured(&task, "no-real-solution", |t, n| t["pairs"][count - 1][1] = deg(n[0]));
            seen[k % 2] += 1;
        }
    }
    assert!(seen[0] + seen[1] > 0, "all have a linkage");
    // Too many free angles, an empty range, a swing of zero.
    let free = ln(json!({"input": {"swing": "60 deg"}, "output": {"swing": "85 deg"}}));
    cured(&free, "wrong-given", |t, n| t["points"] = json!(n[0]));
    cured(&ln(json!({"function": {"y": "ln(x)", "from": 1, "to": 1}})), "out-of-range", |t, n| {
        t["function"]["to"] = json!(n[0])
    });
    cured(&ln(json!({"input": {"from": "86 deg", "swing": "0 deg"}})), "out-of-range", |t, n| {
        t["input"]["swing"] = deg(n[0])
    });
}

#[test]
fn paths() {
    let path = |points: [[f64; 2]; 3], crank: f64, be: f64| {
        json!({"synthesis": "path", "points": points.map(|p| p.map(mm)), "ground": {"A": [0, 0], "D": ["100 mm", 0]},
            "crank": mm(crank), "BE": mm(be), "side": {"B": "right of AE"}})
    };
    for task in [
        path([[500.0, 0.0], [400.0, 10.0], [300.0, 0.0]], 30.0, 60.0),
        path([[50.0, 70.0], [30.0, 75.0], [10.0, 62.0]], 30.0, 10.0),
        path([[50.0, 70.0], [30.0, 75.0], [10.0, 62.0]], 30.0, 300.0),
    ] {
        let help = tried(&task).unwrap_err()[0].help.clone().unwrap().en;
        cured(&task, "no-real-solution", |t, n| {
            let keys: Vec<&str> =
                ["crank", "BE"].into_iter().filter(|k| help.contains(k)).collect();
            keys.iter().zip(n).for_each(|(k, v)| t[*k] = length(*v));
        });
    }
}
