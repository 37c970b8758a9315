//! Unusual, repeated and incomplete statements in a scene, and their meaning.

use super::{faults, good, read, with, written};
use crate::quantity::Of;
use crate::{Angle, DriverKind, GuideId, LinkId, OnLink, PointId};

/// A disc with only its pivot and its slot, in which a pin runs that a rod guides.
fn slotted(angle: &str, driver: &str) -> String {
    format!(
        r#"{{"links": {{"1": ["O"], "2": ["B", "C"], "4": ["O", "C"]}}, "ground": "4",
 "points": {{"O": [0, 0], "C": ["300 mm", "40 mm"]}}, "lengths": {{"BC": "150 mm"}},
 "guides": [{{"pin": "B", "on": "1", "through": "O"{angle}}}], "driver": {{"link": "1"{driver}, "omega": "2 rad/s"}},
 "sketch": {{"B": [150, 60]}}, "units": {{"length": "mm"}}, "find": ["v_B", "phi_1"]}}"#
    )
}

#[test]
fn the_angle_of_a_slot_is_that_of_its_link() {
    good(&slotted(r#", "angle": "20 deg""#, r#", "angle": "20 deg""#));
    let slot = good(&slotted(r#", "angle": "20 deg""#, ""));
    let DriverKind::Turn { angle: Some(angle), .. } = &slot.drivers[0].kind else {
        panic!("{:?}", slot.drivers)
    };
    assert_eq!(angle.value, Angle::Deg(20.0));
    good(&slotted(r#", "angle": "20 deg""#, r#", "angle": "-340 deg""#));
    for other in ["45 deg", "200 deg", "20.001 deg"] {
        assert_eq!(
            faults(&slotted(r#", "angle": "20 deg""#, &format!(r#", "angle": "{other}""#))),
            format!(
                "[\"{other}\"] the driver puts link `1` at {other}, but its guide, which is its direction, is at 20 deg (leave one of the two angles out)\n"
            )
        );
    }
}

#[test]
fn radians_are_pure_numbers_beside_a_time() {
    let driver = |omega: &str| {
        let parameters = r#"{"vA": "0.5 m/s", "R1": "100 mm"}, "driver""#;
        with("parameters", &format!(r#"{parameters}: {{"link": "1", "angle": "60 deg", "omega": "{omega}", "alpha": "(vA/R1)^2"}}"#))
            .replacen(r#""driver": {"link": "1", "angle": "60 deg", "omega": "10 rad/s"},"#, "", 1)
    };
    let scene = good(&driver("-vA/R1"));
    assert_eq!(
        (scene.drivers[0].rate.value, scene.drivers[0].acceleration.as_ref().unwrap().value),
        (-5.0, 25.0)
    );
    assert_eq!(good(&driver("vA/R1 - 60 rpm")).drivers[0].rate.value, 5.0 - std::f64::consts::TAU);
    // A dimensionless quotient is not an angular velocity, and an angular velocity is not a scale.
    assert!(faults(&driver("1 s*vA/R1")).contains("an angular velocity is wanted here"));
    assert!(
        faults(&with("paper", r#"{"mu_v": "10 rad/s"}"#))
            .contains("a scale of velocities is wanted here")
    );
}

#[test]
fn a_decimal_comma_is_told_with_the_point() {
    let said = faults(&with("lengths", r#"{"AB": "100,5 mm", "BC": "2*(1,25 mm)"}"#));
    assert!(
        said.contains(
            "[,] `100,5 mm` has a comma in a number (write the decimal point: \"100.5 mm\")"
        ),
        "{said}"
    );
    assert!(said.contains("write the decimal point: \"2*(1.25 mm)\""), "{said}");
}

#[test]
fn quantities_are_read_as_they_are_printed() {
    let rate = |omega: &str| {
        let driver = format!(r#"{{"link": "1", "angle": "60 deg", "omega": "{omega}"}}"#);
        with("driver", &driver)
    };
    let tau = std::f64::consts::TAU;
    let of = |omega: &str| good(&rate(omega)).drivers[0].rate.value;
    for (text, value) in [
        ("2π rad/s", tau),
        ("2 pi rad/s", tau),
        ("π*(1 rad/s)", tau / 2.0),
        ("−3 rad/s", -3.0),
        ("2·3 rad/s", 6.0),
        ("4 (rad·s⁻¹)", 4.0),
    ] {
        assert!((of(text) - value).abs() < 1e-14, "{text}: {}", of(text));
    }
    let scene = good(&with(
        "driver",
        r#"{"link": "1", "angle": "60 deg", "omega": "10 rad/s", "alpha": "2 rad/s²"}"#,
    ));
    assert_eq!(scene.drivers[0].acceleration.as_ref().unwrap().value, 2.0);
    for (text, said) in [
        ("10 rad/s clockwise", "clockwise is a minus sign: \"-10 rad/s\""),
        ("10 rad/s 逆时针", "counter-clockwise is positive: \"10 rad/s\""),
        ("atan2(20.52,56.38)", "has a comma between two values (a function takes one value"),
        ("2 rad/s⁻", "ends too early"),
    ] {
        assert!(faults(&rate(text)).contains(said), "{text}: {}", faults(&rate(text)));
    }
}

#[test]
fn a_runner_of_two_guides_is_told_with_what_runs_in_one() {
    let text = r#"{"links": {"1": ["O"], "3": ["O", "E"]}, "ground": "1",
 "points": {"O": [0, 0], "B": ["0.3 m", "0.15 m"], "E": ["0.4 m", "0.2 m"]},
 "guides": [{"pin": "B", "slider": "2", "through": [0, "0.15 m"], "angle": "0 deg"}, {"pin": "B", "on": "3", "line": "OE"}],
 "driver": {"slide": "B", "velocity": "-0.4 m/s"}, "find": ["omega_3"]}"#;
    let said = faults(text);
    assert!(
        said.contains("`B` runs in 2 guides (name what runs in one of them only: \"2\")"),
        "{said}"
    );
    good(&text.replace(r#""slide": "B""#, r#""slide": "2""#));
}

/// A point of contact also runs in the guide that replaces the contact, which the author has not
/// written: a driver refers to the point's own guide.
#[test]
fn a_driver_of_what_touches_means_its_guide() {
    let disc = r#"{"links": {"1": ["C"], "2": ["K"], "3": ["C", "F"]}, "ground": "1",
 "points": {"C": [0, 0], "K": ["50 mm", 0], "F": ["40 mm", "30 mm"]}, "guides": [{"pin": "K", "slider": "2", "angle": "0 deg"}],
 "cams": [{"cam": "2", "follower": "3", "face": {"through": "C", "line": "CF", "cam": "right"}, "profile": {"centre": "K", "radius": "30 mm"}}],
 "driver": {"slide": "K", "velocity": "0.5 m/s"}, "find": ["omega_3"]}"#;
    let rod = |slide: &str| {
        format!(
            r#"{{"links": {{"1": ["O"], "2": ["K"], "3": ["A"]}}, "ground": "1", "points": {{"O": [0, 0], "K": ["-40 mm", 0], "A": [0, "30 mm"]}},
 "guides": [{{"pin": "K", "slider": "2", "through": "O", "angle": "0 deg"}}, {{"pin": "A", "slider": "3", "through": "O", "angle": "90 deg"}}],
 "cams": [{{"cam": "2", "follower": "3", "edge": "A", "profile": {{"centre": "K", "radius": "50 mm"}}}}],
 "driver": {{"slide": "{slide}", "velocity": "0.5 m/s"}}, "find": ["v_A"]}}"#
        )
    };
    for (text, guide) in [(disc.to_owned(), 0), (rod("K"), 0), (rod("A"), 1), (rod("3"), 1)] {
        let drivers = good(&text).drivers;
        assert!(
            matches!(drivers[0].kind, DriverKind::Slide { guide: GuideId(g), .. } if g == guide),
            "{text}: {:?}",
            drivers[0].kind
        );
    }
}

#[test]
fn a_unit_in_the_divisor_is_told() {
    let said = faults(&with("lengths", r#"{"AB": "2*pi/3 s", "BC": "1/(2 mm)"}"#));
    assert!(said.contains("write \"(2*pi/3) s\""), "{said}");
    assert!(said.contains("`1/(2 mm)` is a quantity in 1/m (write it in mm)"), "{said}");
}

/// A unit after any numeric expression makes it a quantity, as a product with one unit does.
#[test]
fn a_unit_stands_behind_any_expression() {
    let numbers = [
        "3",
        "2π",
        "pi",
        "sqrt(3)",
        "0.5*sqrt(3)",
        "sqrt(3)/2",
        "3/4",
        "2*sqrt(3)/3",
        "(1+sqrt(2))",
        "k",
        "2*k",
        "-sqrt(2)",
        "5/sqrt(2)",
        "sqrt(2)/(2)",
    ];
    let value = |text: &str| {
        let scene = read(with("parameters", &format!(r#"{{"k": "1.5", "q": "{text}"}}"#)))
            .unwrap_or_else(|f| panic!("{text}: {f}"))
            .value;
        scene.parameters.iter().find(|(name, _)| name == "q").unwrap().1.value
    };
    for number in numbers {
        for unit in ["mm", "m", "deg", "rpm", "m/s", "mm^2", "rad/s", "m/s^2"] {
            let (behind, product) =
                (value(&format!("{number} {unit}")), value(&format!("({number})*(1 {unit})")));
            assert!(
                (behind - product).abs() <= 1e-15 * product.abs(),
                "{number} {unit}: {behind} {product}"
            );
        }
    }
}

#[test]
fn links_written_as_in_books_are_told() {
    let text = crate::templates::get("crank-rocker").unwrap();
    let asked = |what: &str| faults(&crate::edit::with_find(text, &[what]).unwrap());
    assert!(
        asked("omega_BC").contains("B and C are on link `2`: write `2`"),
        "{}",
        asked("omega_BC")
    );
    assert!(
        asked("omega_21").contains("for link `2` relative to link `1` write `2/1`"),
        "{}",
        asked("omega_21")
    );
}

#[test]
fn a_velocity_of_a_link_is_told_with_its_points() {
    let yoke = crate::templates::get("scotch-yoke").unwrap();
    let asked = |what: &str| faults(&crate::edit::with_find(yoke, &[what]).unwrap());
    assert!(
        asked("v_3").contains("`3` in `v_3` is a link; `v` is of a point (write v_B3)"),
        "{}",
        asked("v_3")
    );
    assert!(asked("a_1").contains("(write a_A or a_B)"), "{}", asked("a_1"));
    assert!(asked("x_1").contains("(write x_A or x_B)"), "{}", asked("x_1"));
}

#[test]
fn a_comma_parts_a_point_from_its_link() {
    let links = r#"{"2": ["O", "B"], "3": ["B", "O2"], "4": ["O", "O2"]}"#;
    let scene = format!(
        r#"{{"links": {links}, "ground": "4", "points": {{"O": [0, 0], "O2": ["1 m", 0], "B": ["1 m", "1 m"]}},
 "driver": {{"link": "2", "omega": "1 rad/s"}}, "find": ["v_B,3", "v_O2", "v_O,2", "v_O,O2"]}}"#
    );
    let scene = read(&scene).unwrap_or_else(|f| panic!("{f}")).value;
    let said: Vec<_> = scene.find.iter().map(|f| f.what.of()).collect();
    let link = |p: &crate::OnLink| p.link.map(|l| scene.link_name(l));
    let Of::Point(b3) = said[0] else { panic!("{said:?}") };
    let Of::Point(o2) = said[1] else { panic!("{said:?}") };
    let Of::Point(o) = said[2] else { panic!("{said:?}") };
    assert_eq!((link(&b3), link(&o2), link(&o)), (Some("3"), None, Some("2")));
    assert!(matches!(said[3], Of::Points(..)));
}

#[test]
fn lists_are_whole() {
    let points: Vec<String> = ('A'..='Z').map(|c| format!("{c}0")).collect();
    let links = format!(r#"{{"1": {points:?}, "4": ["A0", "zz"]}}"#);
    let said = faults(&format!(
        r#"{{"links": {links}, "ground": "4", "driver": {{"link": "1", "omega": "1 rad/s"}}, "find": ["v_9"]}}"#
    ));
    assert!(said.contains("Y0, Z0, zz)") && !said.contains("..."), "{said}");
    let said = faults(&with("lengths", r#"{"QQ": "1 m"}"#));
    assert!(said.contains("the points are A, B, C, E, D"), "{said}");
}

#[test]
fn a_loose_pin_in_two_slots_and_a_height_called_h() {
    let scene = good(
        r#"{"parameters": {"h": "200 mm"}, "links": {"1": ["O", "F"], "2": ["O", "E"], "3": ["O"]}, "ground": "3", "lengths": {"OF": "h", "OE": "2*h"},
        "guides": [{"pin": "M", "on": "1", "line": "OF", "angle": "90 deg", "through": "F"}, {"pin": "M", "on": "2", "line": "OE"}],
        "driver": [{"link": "1", "angle": "0 deg", "omega": "6 rad/s"}, {"link": "2", "angle": "40 deg", "omega": "1 rev/s"}], "find": ["v_M", "vr_MM1"]}"#,
    );
    let on = |link: Option<usize>| OnLink { point: PointId(3), link: link.map(LinkId) };
    assert_eq!(written(&scene.find[1].what), ("vr", Of::Points(on(None), on(Some(0)))));
}

/// A position by a law of time determines rate and acceleration, for drivers and motions; a written
/// rate has priority.
#[test]
fn drivers_by_laws_of_time() {
    let text = |time: &str, driver: &str| {
        let k = if driver.contains('k') { r#""parameters": {"k": "0.5 rad/s^2"},"# } else { "" };
        format!(
            r#"{{{k} "links": {{"1": ["O"], "2": ["O", "A"]}}, "ground": "1", "points": {{"O": [0, 0]}}, "lengths": {{"OA": "1 m"}},
 {time} "driver": {{"link": "2", {driver}}}, "find": ["v_A"]}}"#
        )
    };
    let at = r#""time": "3 s","#;
    let rates = |driver: &str| {
        let d = good(&text(at, driver)).drivers.remove(0);
        (d.rate.value, d.acceleration.map(|a| a.value), d.law.map(|l| l.parameters))
    };
    let told =
        Some(vec![("k".to_owned(), "0.5 rad/s^2".to_owned()), ("t".to_owned(), "3 s".to_owned())]);
    assert_eq!(rates(r#""angle": "k*t^2""#), (3.0, Some(1.0), told));
    let (rate, second, law) = rates(r#""angle": "30 deg + 2 rad/s*t""#);
    assert_eq!((rate, second), (2.0, None));
    assert!(law.is_some());
    let both = rates(r#""angle": "k*t^2", "omega": "7 rad/s""#);
    assert_eq!(both, (7.0, None, None));
    let bare = crate::read(text(at, r#""angle": "t^2""#)).unwrap_err();
    assert_eq!(bare.list.len(), 1, "{bare}");
    assert_eq!(
        bare.list[0].help.as_ref().unwrap().en,
        "t counts in seconds: multiply by 1 rad/s^2"
    );
    for (time, driver, code) in [
        (at, r#""angle": "k*t^2", "alpha": "1 rad/s^2""#, "given-twice"),
        (at, r#""angle": "1 rad*abs(t/(1 s))""#, "law"),
        (at, r#""angle": "30 deg""#, "missing-key"),
        ("", r#""angle": "30 deg""#, "missing-key"),
        (at, r#""angle": "1 m*t""#, "dimension"),
        (r#""time": "3 s", "parameters": {"t": "2 s"},"#, r#""angle": "1 rad/s*t""#, "given-twice"),
    ] {
        let found = crate::read(text(time, driver)).unwrap_err();
        assert!(found.list.iter().any(|d| d.code == code), "{driver}: {found}");
    }
}
