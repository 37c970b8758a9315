//! A sweep of a group of class IV: its limits compared with independent equations, and its
//! dependent parts.

use super::*;

/// Two ternary links on two bars, a group of class IV, with further links and points, and `K` on
/// the ground with them.
pub fn class_iv(find: &str, more: [&str; 2]) -> Scene {
    let [links, points] = more;
    let text = format!(
        r#"{{"links": {{"1": ["O","A"], "2": ["A","B","C"], "3": ["B","D"], "4": ["C","E"], "5": ["D","E","G"]{links}, "6": ["O","G"{}]}},
        "ground": "6", "find": [{find}], "units": {{"length": "m"}}, "driver": {{"link": "1", "omega": "2 rad/s"}},
        "points": {{"O": [0,0], "A": [1,2], "B": [3,4], "C": [4,1.5], "D": [6,5], "E": [7,2], "G": [9,1]{points}}}}}"#,
        if links.is_empty() { "" } else { r#","K""# }
    );
    read(&text).unwrap_or_else(|f| panic!("{f}")).value
}

/// The crank angle (rad) at which the group of class IV of [`class_iv`] reaches its limit, by
/// independent equations: with the rotations of links 2 and 5 unknown, two bars keep their lengths,
/// and the determinant of these two conditions vanishes.
fn fold_by_hand(from: [f64; 3]) -> f64 {
    type P = [f64; 2];
    let turn =
        |p: P, by: f64| [p[0] * by.cos() - p[1] * by.sin(), p[0] * by.sin() + p[1] * by.cos()];
    let plus = |a: P, b: P| [a[0] + b[0], a[1] + b[1]];
    let minus = |a: P, b: P| [a[0] - b[0], a[1] - b[1]];
    let dot = |a: P, b: P| a[0] * b[0] + a[1] * b[1];
    let [a, b, c, d, e, g] =
        [[1.0, 2.0], [3.0, 4.0], [4.0, 1.5], [6.0, 5.0], [7.0, 2.0], [9.0, 1.0]];
    // Residuals of both bars, and their derivatives by the two rotations: of D − B along the bar,
    // and so on.
    let bars = |q: [f64; 3]| {
        let crank = turn(a, q[2]);
        [(b, d), (c, e)].map(|(near, far)| {
            let (arm, lever) = (turn(minus(near, a), q[0]), turn(minus(far, g), q[1]));
            let bar = minus(plus(g, lever), plus(crank, arm));
            let length = minus(far, near);
            let side = |v: P| [-v[1], v[0]];
            (
                dot(bar, bar) - dot(length, length),
                [-2.0 * dot(bar, side(arm)), 2.0 * dot(bar, side(lever))],
            )
        })
    };
    let conditions = |q: [f64; 3]| {
        let [(f, [fa, fb]), (h, [ha, hb])] = bars(q);
        [f, h, fa * hb - fb * ha]
    };
    let mut q = nalgebra::Vector3::from(from);
    for _ in 0..60 {
        let at =
            |q: nalgebra::Vector3<f64>| nalgebra::Vector3::from(conditions([q[0], q[1], q[2]]));
        let step = 1e-6;
        let columns = [0, 1, 2].map(|k| {
            let mut by = nalgebra::Vector3::zeros();
            by[k] = step;
            (at(q + by) - at(q - by)) / (2.0 * step)
        });
        q -= nalgebra::Matrix3::from_columns(&columns).lu().solve(&at(q)).unwrap();
    }
    q[2] + 2f64.atan2(1.0)
}

/// A mechanism that is followed as a whole stops at a limit that is located and explained as for
/// dyads: the limit of `limits`, where the determinant of the group vanishes.
#[test]
fn the_limits_of_a_group_of_class_iv() {
    let scene = class_iv(r#""phi_2", "phi_5", "omega_5""#, ["", ""]);
    let m = Mechanism::new(&scene).unwrap().value;
    let placed = PlacedScene::new(&scene, &m).unwrap();
    let told = limits_of(&scene);
    let ends = told.range.ends.each_ref().map(|e| e.as_ref().unwrap().value);
    let now = station::position_now(&scene, &placed.at, 0);
    let near = |value: f64| {
        // The last rows before the limit give the start for the independent equations.
        let inward = (now - value).signum();
        let table = sweep::run(
            &placed,
            0,
            &Stations::of_values(vec![now, value + inward * 1e-4], 1.0),
            Width::One,
        )
        .unwrap();
        assert_eq!(table.rows(), 2, "{:?}", table.notes);
        let turned = |name: &str| {
            table.column(name).unwrap().values[1] - table.column(name).unwrap().values[0]
        };
        [turned("phi_2"), turned("phi_5"), value - now]
    };
    for end in ends {
        let exact = fold_by_hand(near(end));
        println!("{end} {exact}");
        assert!((end - exact).abs() < 1e-13, "{end} against {exact}");
    }
    // Over the limits upward; downward; and both.
    let words: Vec<String> =
        ends.iter().map(|e| format!("phi_1 = {}°", significant(e.to_degrees(), 6))).collect();
    for (from, to, limits) in [(now, 4.0, vec![1]), (-4.0, now, vec![0]), (-4.0, 4.0, vec![0, 1])] {
        let stations = Stations::slid(from, to, 100, 1.0);
        let table = sweep::run(&placed, 0, &stations, Width::Widest).unwrap();
        let messages: Vec<&str> = table
            .notes
            .iter()
            .filter(|n| n.code == "limit")
            .map(|n| n.message.en.as_str())
            .collect();
        let expected: Vec<String> = limits
            .iter()
            .map(|&i| format!("the driver goes no farther than {}: there links 2, 3, 4 and 5 leave one freedom open", words[i]))
            .collect();
        assert_eq!(messages, expected);
        let said = &table.notes.iter().find(|n| n.code == "no-position").unwrap().message.en;
        assert!(
            words
                .iter()
                .any(|w| said.ends_with(&format!("the mechanism cannot be assembled beyond {w}"))),
            "{said}"
        );
    }
}

/// If a dyad beside the group of class IV becomes collinear first, its links are named. A crank
/// that is stopped in one sense reaches the remaining positions in the other.
#[test]
fn a_dyad_beside_a_group_of_class_iv_stops_it() {
    let scene = class_iv(
        r#""omega_8""#,
        [r#", "7": ["E","H"], "8": ["H","K"]"#, r#", "H": [8,3.2], "K": [8.6,4.4]"#],
    );
    let m = Mechanism::new(&scene).unwrap().value;
    let placed = PlacedScene::new(&scene, &m).unwrap();
    let told = limits_of(&scene);
    let stations = Stations::turned(Angle::Deg(0.0), Angle::Deg(360.0), 180);
    let table = sweep::run(&placed, 0, &stations, Width::Widest).unwrap();
    let line = |e: &sweep::limit::Event| {
        e.toggle
            .as_ref()
            .is_some_and(|t| t.words(&scene, Lang::En) == "link 7 (EH) and link 8 (HK) lie in line")
    };
    let end = told
        .range
        .ends
        .iter()
        .flatten()
        .find(|e| line(e))
        .expect("a limit where links 7 and 8 lie in line");
    let length = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let reach = length([7.0, 2.0], [8.0, 3.2]) + length([8.0, 3.2], [8.6, 4.4]);
    // Next to it the distance of E and K is that of both links in line.
    let beside =
        Stations::of_values(vec![end.value + (told.range.now - end.value).signum() * 1e-12], 1.0);
    let found = class_iv(
        r#""x_E", "y_E""#,
        [r#", "7": ["E","H"], "8": ["H","K"]"#, r#", "H": [8,3.2], "K": [8.6,4.4]"#],
    );
    let at = sweep::run(&PlacedScene::new(&found, &m).unwrap(), 0, &beside, Width::One).unwrap();
    let e = ["x_E", "y_E"].map(|n| at.column(n).unwrap().values[0]);
    assert!(
        (length(e, [8.6, 4.4]) - reach).abs() < 1e-10,
        "{} against {reach}",
        length(e, [8.6, 4.4])
    );
    let words = "link 7 (EH) and link 8 (HK) lie in line";
    assert!(
        table.notes.iter().any(|n| n.code == "limit" && n.message.en.ends_with(words)),
        "{:#?}",
        table.notes
    );
    // Degrees within the range, a turn away or not.
    let [low, high] = told.range.bounds();
    let within = |x: &f64| {
        (-1..=1).any(|k| (low..=high).contains(&(x + f64::from(k) * std::f64::consts::TAU)))
    };
    assert_eq!(
        table.rows(),
        stations.values.iter().filter(|x| within(x)).count(),
        "{:?} {:#?}",
        told.range,
        table.notes
    );
}
