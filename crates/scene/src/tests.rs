//! Whole scenes, good and bad: results and messages of the reader.

mod cams;
mod meant;
mod names;
mod rolling;

use super::*;
use crate::quantity::Of;
use hodograph_base::trig::radians;

/// Returns a question as its symbol and its object.
fn written(what: &Asked) -> (&'static str, Of) {
    (what.entry().symbol, what.of())
}

/// Reads a scene that must be good and have no notes.
fn good(source: &str) -> Scene {
    match read(source) {
        Ok(scene) => {
            assert_eq!(scene.notes, []);
            scene.value
        }
        Err(faults) => panic!("{faults} in\n{source}"),
    }
}

/// Returns a scene with a section replaced or added.
fn with(section: &str, value: &str) -> String {
    let sections = [
        ("links", r#"{"1": ["A", "B"], "2": ["B", "C", "E"], "3": ["C", "D"], "4": ["A", "D"]}"#),
        ("ground", r#""4""#),
        (
            "lengths",
            r#"{"AB": "100 mm", "BC": "250 mm", "CD": "200 mm", "AD": "300 mm", "BE": "150 mm", "CE": "140 mm"}"#,
        ),
        ("driver", r#"{"link": "1", "angle": "60 deg", "omega": "10 rad/s"}"#),
    ];
    let mut parts: Vec<String> = sections
        .iter()
        .filter(|(k, _)| *k != section)
        .map(|(k, v)| format!("\"{k}\": {v}"))
        .collect();
    if !value.is_empty() {
        parts.push(format!("\"{section}\": {value}"));
    }
    format!("{{{}}}", parts.join(",\n "))
}

/// Returns the faults of a scene: the text under each span, then the message and the help.
fn faults(source: &str) -> String {
    let list = match read(source) {
        Ok(scene) => scene.notes,
        Err(faults) => faults.list,
    };
    let place = |d: &hodograph_base::diag::Diagnostic| {
        d.span
            .map_or("", |s| source.get(s.start..s.end).expect("a span between characters"))
            .to_owned()
    };
    for d in &list {
        assert_eq!(d.english_in_chinese(), None, "{d:?}");
    }
    list.iter().map(|d| format!("[{}] {d}\n", place(d))).collect()
}

#[test]
fn the_first_example() {
    let scene = good(&with("find", r#"["v_E", "a_E", "omega_3", "alpha_3"]"#));
    let names: Vec<_> = scene.points.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["A", "B", "C", "E", "D"]);
    assert_eq!(scene.ground, LinkId(3));
    let lengths: Vec<_> = scene.lengths.iter().map(|l| l.value.value).collect();
    assert_eq!(lengths, [0.1, 0.25, 0.2, 0.3, 0.15, 0.14]);
    let PointPlace::At([x, y]) = &scene.points[4].place else { panic!("{:?}", scene.points[4]) };
    assert_eq!((x.value, y.value, x.text.as_str()), (0.3, 0.0, "300 mm"));
    let PointPlace::At([x, y]) = &scene.points[0].place else { panic!("{:?}", scene.points[0]) };
    assert_eq!((x.value, y.value), (0.0, 0.0));
    let DriverKind::Turn {
        link: LinkId(0),
        against: LinkId(3),
        line: None,
        angle: Some(angle),
        ..
    } = &scene.drivers[0].kind
    else {
        panic!("{:?}", scene.drivers)
    };
    assert_eq!(angle.value, Angle::Deg(60.0));
    assert_eq!(scene.drivers[0].rate.value, 10.0);
    assert_eq!(written(&scene.find[2].what), ("omega", Of::Link(LinkId(2))));
}

/// The example scenes of `docs/scene.md`, section "Guides", each in a mechanism.
#[test]
fn guides_of_all_kinds() {
    let line = |scene: &Scene, i: usize| match &scene.guides[i].path {
        GuidePath::Line { through, direction, offset } => {
            (through.clone(), direction.clone(), offset.as_ref().map(|o| o.value))
        }
        arc => panic!("{arc:?}"),
    };
    // A slider-crank: the ground 4 has one pivot, the slider's number is 3.
    let crank = |guide: &str| {
        format!(
            r#"{{"links": {{"1": ["A", "B"], "2": ["B", "C"], "4": ["A"]}}, "ground": "4", "guides": [{guide}],
            "driver": {{"link": "1", "angle": "45 deg", "omega": "30 rpm"}}}}"#
        )
    };
    let scene = good(&crank(
        r#"{"pin": "C", "slider": "3", "on": "4", "through": "A", "angle": "0 deg", "offset": "10 mm"}"#,
    ));
    assert_eq!(scene.links[3].name, "3");
    assert_eq!(scene.links[3].points, [PointId(2)]);
    let (through, GuideDirection::Instant(angle), Some(0.01)) = line(&scene, 0) else { panic!() };
    assert_eq!((through, angle.value), (Through::Point(PointId(0)), Angle::Deg(0.0)));
    assert_eq!(scene.drivers[0].rate.value, radians(180.0));
    // No "on": the ground; no "through": the pin.
    let scene = good(&crank(r#"{"pin": "C", "slider": "3", "angle": "pi/2*1 rad"}"#));
    let (through, GuideDirection::Instant(angle), None) = line(&scene, 0) else { panic!() };
    assert_eq!(
        (scene.guides[0].on, through, angle.value),
        (LinkId(2), Through::Pin, Angle::Rad(std::f64::consts::FRAC_PI_2))
    );
    let scene = good(&crank(r#"{"pin": "C", "through": ["1 cm", 0], "angle": 0}"#));
    assert_eq!(scene.guides[0].slider, None);
    assert!(matches!(line(&scene, 0).0, Through::At([x, y]) if x.value == 0.01 && y.value == 0.0));

    // A crank and slotted lever: B runs on lever 3.
    let lever = |links: &str, guide: &str| {
        format!(
            r#"{{"links": {{"1": ["O1", "B"], {links}, "4": ["O1", "O2"]}}, "ground": "4", "lengths": {{"O1,O2": "120 mm", "O1B": "50 mm"}},
            "guides": [{guide}], "driver": {{"link": "1", "angle": "45 deg", "omega": "10 rad/s"}}}}"#
        )
    };
    let scene = good(&lever(
        r#""3": ["O2", "D"]"#,
        r#"{"pin": "B", "slider": "2", "on": "3", "line": "O2D"}"#,
    ));
    assert_eq!(
        line(&scene, 0),
        (Through::Point(PointId(2)), GuideDirection::Along(PointId(2), PointId(3), None), None)
    );
    let scene = good(&lever(
        r#""3": ["O2"]"#,
        r#"{"pin": "B", "slider": "2", "on": "3", "through": "O2"}"#,
    ));
    assert_eq!(line(&scene, 0), (Through::Point(PointId(2)), GuideDirection::Own, None));
    let scene = good(&lever(
        r#""3": ["O2", "K"]"#,
        r#"{"pin": "B", "on": "3", "centre": "K", "radius": "50 mm"}"#,
    ));
    assert!(
        matches!(&scene.guides[0].path, GuidePath::Arc { centre: PointId(3), radius: Some(r) } if r.value == 0.05)
    );

    // A Scotch yoke: the yoke slides without turning on a ground with the pivot as its only point.
    let scene = good(
        r#"{"links": {"1": ["O", "A"], "4": ["O"]}, "ground": "4", "lengths": {"OA": "50 mm"},
        "guides": [{"pin": "A", "slider": "2", "on": "3", "angle": "90 deg"}, {"slider": "3", "on": "4", "angle": "0 deg"}],
        "driver": {"link": "1", "angle": "30 deg", "omega": "10 rad/s"}, "find": ["v_A3", "vr_A2A3"]}"#,
    );
    assert_eq!(scene.links[3].points, []);
    assert_eq!(scene.guides[1].pin, None);
    assert_eq!(
        written(&scene.find[0].what),
        ("v", Of::Point(OnLink { point: PointId(1), link: Some(LinkId(3)) }))
    );
}

#[test]
fn drivers_of_all_kinds() {
    let scene = good(
        r#"{"links": {"1": ["A", "B"], "2": ["B", "C"], "4": ["A", "F"], "7": ["C", "G"]}, "ground": "4",
        "points": {"A": [0, 0], "F": ["2 m", "-1 m"]},
        "guides": [{"pin": "C", "slider": "3", "angle": "0 deg"}],
        "driver": [{"link": "2", "against": "1", "line": "CB", "against_line": "AB", "angle": "30 deg", "omega": "5 rad/s", "alpha": "-2 rad/s^2"},
                   {"slide": "C", "position": "120 mm", "velocity": "2 m/s"},
                   {"cylinder": "FG", "length": "800 mm", "rate": "50 mm/s", "acceleration": "0 m/s^2", "links": ["5", "6"]}]}"#,
    );
    assert!(matches!(
        scene.drivers[0].kind,
        DriverKind::Turn {
            link: LinkId(1),
            against: LinkId(0),
            line: Some((PointId(2), PointId(1))),
            ..
        }
    ));
    assert_eq!(scene.drivers[0].acceleration.as_ref().unwrap().value, -2.0);
    assert!(
        matches!(&scene.drivers[1].kind, DriverKind::Slide { guide: GuideId(0), position: Some(p) } if p.value == 0.12)
    );
    let DriverKind::Cylinder { links, .. } = &scene.drivers[2].kind else { panic!() };
    let names: Vec<_> = links.iter().map(|l| scene.link_name(*l)).collect();
    assert_eq!(names, ["5", "6"]);
    assert_eq!(scene.drivers[2].rate.value, 0.05);
}

#[test]
fn all_that_can_be_asked() {
    let scene = good(&with(
        "find",
        r#"["v_E", "v_B3", "a_C,B", "an_CB", "at_CB", "vr_B3B2", "ar_B3B2", "ak_B3,B2", "omega_3/2", "alpha_3", "x_E", "phi_2", "l_AC", "v_B3B2"]"#,
    ));
    let on = |point: usize, link: Option<usize>| OnLink {
        point: PointId(point),
        link: link.map(LinkId),
    };
    let (b3, b2) = (on(1, Some(2)), on(1, Some(1)));
    let asked: Vec<_> = scene.find.iter().map(|f| written(&f.what)).collect();
    assert_eq!(
        asked,
        [
            ("v", Of::Point(on(3, None))),
            ("v", Of::Point(b3)),
            ("a", Of::Points(on(2, None), on(1, None))),
            ("an", Of::Points(on(2, None), on(1, None))),
            ("at", Of::Points(on(2, None), on(1, None))),
            ("vr", Of::Points(b3, b2)),
            ("ar", Of::Points(b3, b2)),
            ("ak", Of::Points(b3, b2)),
            ("omega", Of::Links(LinkId(2), LinkId(1))),
            ("alpha", Of::Link(LinkId(2))),
            ("x", Of::Point(on(3, None))),
            ("phi", Of::Link(LinkId(1))),
            ("l", Of::Line(PointId(0), PointId(2))),
            ("v", Of::Points(b3, b2)),
        ]
    );
}

#[test]
fn bare_numbers_take_their_unit_from_the_table() {
    let scene = good(&format!(
        "{{\"units\": {{\"length\": \"mm\", \"angle\": \"°\", \"omega\": \"rpm\"}}, \"parameters\": {{\"k\": 2.5}}, {}",
        &with("driver", r#"{"link": "1", "angle": 60, "omega": -300}"#)[1..]
            .replace("\"100 mm\"", "100")
            .replace("\"250 mm\"", "\"k*100\"")
    ));
    assert_eq!(
        (scene.lengths[0].value.value, scene.lengths[0].value.text.as_str()),
        (0.1, "100 mm")
    );
    assert_eq!(
        (scene.lengths[1].value.value, scene.lengths[1].value.text.as_str()),
        (0.25, "(k*100) (mm)")
    );
    assert_eq!(
        (scene.drivers[0].rate.value, scene.drivers[0].rate.text.as_str()),
        (-radians(1800.0), "-300 rpm")
    );
    assert!(
        matches!(&scene.drivers[0].kind, DriverKind::Turn { angle: Some(a), .. } if a.value == Angle::Deg(60.0))
    );
}

#[test]
fn places_sides_and_paper() {
    let scene = good(
        r#"{"links": {"1": ["A", "B"], "2": ["B", "C", "E", "G"], "3": ["C", "D"], "4": ["A", "D"]}, "ground": "4",
        "points": {"A": [0, 0], "D": ["300 mm", 0], "E": {"base": "BC", "x": "100 mm", "y": "-20 mm"}, "G": {"base": "CB", "length": "5 cm", "angle": "30 deg"}},
        "lengths": {"AD": "30 cm", "BC": "250 mm"}, "sketch": {"C": ["3 m", "2 m"]}, "side": {"C": "right of BD"},
        "driver": {"link": "1", "omega": "10 rad/s"}, "language": "zh", "notation": "cn",
        "paper": {"size": "A4 landscape", "mu_l": "0.002 m/mm", "mu_v": "0.05 (m/s)/mm", "mu_a": "1 (m/s^2)/mm", "pencil": "0.2 mm"}}"#,
    );
    assert!(
        matches!(&scene.points[3].place, PointPlace::InLink { base: (PointId(1), PointId(2)), xy } if xy[1].value == -0.02)
    );
    assert!(
        matches!(&scene.points[4].place, PointPlace::Polar { base: (PointId(2), PointId(1)), angle, .. } if angle.value == Angle::Deg(30.0))
    );
    assert_eq!(scene.points[2].sketch, Some([3.0, 2.0]));
    assert!(!scene.sides[0].left);
    assert_eq!(
        scene.paper,
        Paper {
            size_mm: Some([297.0, 210.0]),
            scales: [(Kind::Length, 0.002), (Kind::Velocity, 0.05), (Kind::Acceleration, 1.0)]
                .into_iter()
                .collect(),
            pencil_mm: Some(0.2),
            round_in: ByKind::default(),
        }
    );
    assert_eq!((scene.language, scene.notation.as_deref()), (Some(Lang::Zh), Some("cn")));
}

#[test]
fn what_is_said_about_bad_scenes() {
    let cases: Vec<(&str, String)> = vec![
        ("json", r#"{"links": {"1": ["A", "B"],}}"#.to_owned()),
        ("comment", "{ // no\n}".to_owned()),
        ("empty", String::new()),
        ("list", "[]".to_owned()),
        ("keys", r#"{"Links": {}, "gruond": "4", "driver": {"lnik": "1"}}"#.to_owned()),
        ("types", with("links", r#"{"1": ["A", 2], "2": "BC", "3": ["C", "C"]}"#)),
        ("nothing", "{}".to_owned()),
        ("ground", with("ground", r#""5""#)),
        ("ground number", with("ground", "4")),
        ("two links", r#"{"links": {"1": ["A", "B"]}, "ground": "1", "driver": {"link": "1", "omega": "1 rad/s"}}"#.to_owned()),
        (
            "lengths",
            with(
                "lengths",
                r#"{"AB": "60 deg", "BC": "-250 mm", "AC": "1 m", "AX": "1 m", "CD": 200, "BE": "2*q", "CE": "", "D": "1 m", "EE": "1 m"}"#,
            ),
        ),
        ("twice", with("lengths", r#"{"AB": "100 mm", "BA": "0.1 m", "BC": "1 m", "C-B": "2 m", "AB": "1 m"}"#)),
        (
            "points",
            with(
                "points",
                r#"{"A": [0, 0], "D": ["299 mm", 0], "Q": [1], "E": {"base": "AB", "x": 0, "y": 0}, "B": {"base": "AB", "x": 0, "angle": 0}, "C": {"base": "BE", "length": "1 m"}}"#,
            ),
        ),
        ("circle", with("points", r#"{"C": {"base": "BE", "x": "1 m", "y": 0}, "E": {"base": "BC", "x": "1 m", "y": 0}}"#)),
        ("driver", with("driver", r#"{"link": "1", "angle": "60 mm", "omga": "10 rad/s"}"#)),
        (
            "mixed",
            with(
                "driver",
                r#"[{"link": "1", "slide": "C"}, {"link": "1", "rate": "1 m/s"}, {"link": "4", "omega": "1 rad/s"}, {"link": "1", "line": "BC", "omega": "10"}]"#,
            ),
        ),
        (
            "more drivers",
            with(
                "driver",
                r#"[{"slide": "C", "velocity": "1 m/s"}, {"cylinder": "BC", "rate": "1 m/s"}, {"link": "1", "omega": "1 rad/s"}, {"link": "1", "omega": "2 rad/s"}]"#,
            ),
        ),
        (
            "guides",
            with(
                "guides",
                r#"[{"on": "2"}, {"pin": "A", "on": "9"}, {"pin": "B", "slider": "3", "on": "4", "angle": 0}, {"pin": "B", "on": "4"}, {"pin": "C", "on": "2", "line": "BE"}, {"pin": "A", "on": "2", "line": "AB"}, {"pin": "A", "on": "2", "through": "B"}, {"pin": "A", "on": "2", "centre": "D", "line": "BC"}, {"pin": "B", "on": "3", "through": [0, 0], "angle": 0}, {"slider": "3", "on": "3", "angle": 0}]"#,
            ),
        ),
        (
            "length of no slider in a straight guide",
            with(
                "guides",
                r#"[{"pin": "A", "on": "2", "line": "BC", "length": "1 m"}, {"pin": "D", "on": "2", "centre": "B", "radius": "1 m", "length": "1 m"}]"#,
            ),
        ),
        (
            "find",
            with(
                "find",
                r#"["v_Q", "v", "w_3", "omega_4", "alpha_7", "omega_3/3", "ak_BC", "an_B", "v_BB", "x_AB", "vr_B3C2", "l_AA", "omega_3", "omega_3"]"#,
            ),
        ),
        ("sides", with("side", r#"{"C": "left of BQ", "B": "above AD", "A": "left of AD"}"#)),
        ("paper", with("paper", r#"{"size": "B5", "mu_l": 0.002, "mu_v": "0.05 m/mm", "mu_a": "-1 (m/s^2)/mm"}"#)),
        ("paper size", with("paper", r#"{"size": ["200 m", "100 mm"]}"#)),
        ("pencil", with("paper", r#"{"pencil": "6 mm"}"#)),
        ("pencil sign", with("paper", r#"{"pencil": "-0.1 mm"}"#)),
        ("frames", with("find", r#"["ve_E", "ve_E/", "ve_E/9", "ve_CB/1", "vr_Q/1"]"#)),
        (
            "composite",
            with(
                "composite",
                r#"[{"point": "Q", "frame": "2"}, {"point": "E", "frame": "4"}, {"point": "E", "frame": "2"}, {"frame": "2"}, {"point": "E", "on": "7", "frame": "1"}, 3]"#,
            ),
        ),
        ("motions", with("motions", r#"[{"point": "M", "on": "2", "line": "BC", "s": "6 m/s*t"}, {"point": "M"}, 3]"#)),
        (
            "laws",
            with(
                "time",
                r#""1 s", "motions": [{"point": "M", "on": "2", "line": "BC", "s": "1 m*abs(t/(1 s))"}, {"point": "N", "on": "2", "line": "BC", "s": "1 m*2^(t/(1 s))"}, {"point": "P", "on": "9", "line": "BC", "s": "1 m/s"}]"#,
            ),
        ),
        (
            "arcs",
            with(
                "time",
                r#""1 s", "motions": [{"point": "M", "on": "2", "line": "BC", "centre": "B", "s": "1 m/s*t"}, {"point": "N", "on": "2", "line": "BC", "radius": "1 m", "s": "1 m/s*t"}, {"point": "P", "on": "2", "centre": "B", "s": "1 m/s*t"}]"#,
            ),
        ),
        ("language", with("language", r#""de""#)),
        ("notation", with("notation", r#""chinese""#)),
        ("parameters", with("parameters", r#"{"a": "b", "b": "2*a", "mm": "1 m", "2x": 1, "unused": 3, "c": "2*mm"}"#)),
        ("unused", with("parameters", r#"{"a": "1 mm"}"#)),
        ("units", with("units", r#"{"length": "deg", "speed": "m/s", "omega": "rmp"}"#)),
        ("sketch", with("sketch", r#"{"C": [3, 2]}"#)),
        ("text", with("title", "{}")),
        (
            "masses",
            with("masses", r#"{"1": {}, "2": {"m": "-1 kg", "at": "B"}, "3": {"m": "2 kg"}, "4": {"m": "1 kg"}, "9": {"m": "1 kg"}}"#),
        ),
        (
            "weights",
            with("masses", r#"{"2": {"weight": "20 N", "at": "B"}, "3": {"m": "1 kg", "weight": "2 N", "at": "C"}, "1": {"k": "1 mm"}}"#),
        ),
        (
            "forces",
            with(
                "forces",
                r#"[{"on": "2"}, {"on": "3", "F": "5 N"}, {"on": "3", "F": "5 mm", "angle": "0 deg", "at": "C"}, {"on": "2", "at": "D", "F": "1 N", "angle": "0 deg"}, {"on": "2", "M": "1 N*m", "at": "B"}, {"on": "3", "at": "C", "F": ["1 N", "2 N"], "angle": "3 deg"}, {"on": "3", "at": "C", "F": "2 N", "against": "wind"}]"#,
            ),
        ),
        (
            "springs",
            with(
                "springs",
                r#"[{"from": "B", "to": "B", "k": "3 N/m", "free": "1 m"}, {"from": "B", "to": "Q", "k": "-3 N/m", "free": "1 m"}]"#,
            ),
        ),
        (
            "courses",
            with(
                "forces",
                r#"[{"on": "3", "M": "1 N*m", "over": {"slide": "C"}}, {"on": "3", "M": "1 N*m", "over": {}}, {"on": "3", "M": "1 N*m", "over": {"turn": "2"}}, {"on": "3", "M": "1 N*m", "over": {"turn": "1", "angles": ["90 deg", "20 deg"]}, "diagram": {}}, {"on": "3", "M": "1 N*m", "diagram": {"turn": "1", "points": [["0 deg", "1 N*m"], ["20 deg", 0]]}}, {"on": "3", "diagram": {"turn": "1", "points": [["90 deg", "1 N*m"], ["20 deg", 0]]}}, {"on": "3", "diagram": {"turn": "1", "period": "-1 deg", "points": [["90 deg", "1 N*m"]]}}]"#,
            ),
        ),
        (
            "friction",
            with(
                "friction",
                r#"[{"pin": "B"}, {"pin": "B", "slider": "3", "f": 0.1}, {"pin": "Q", "circle": "3 mm"}, {"slider": "3", "f": 0.1}, {"slider": "3"}, {"pin": "B", "radius": "2 mm", "f": -0.1}, {"pin": "B", "on": "4", "circle": "2 mm"}]"#,
            ),
        ),
        ("efficiency", with("find", r#"["eta", "eta_2"]"#)),
        ("balance", with("balance", r#"{"at": "B"}"#)),
        ("reactions", with("find", r#"["F_13", "F_B", "h_12", "M_b3", "F_b", "FI_4"]"#)),
    ];
    let said: String = cases
        .iter()
        .chain(&rolling::bad())
        .chain(&cams::bad())
        .map(|(name, source)| format!("{name}:\n{}", faults(source)))
        .collect();
    // A golden text: review the difference, then write the printed text into the file.
    let expected = include_str!("bad_scenes.txt");
    assert!(said == expected, "crates/scene/src/bad_scenes.txt should now read:\n<<<\n{said}>>>");
}

#[test]
fn input_beyond_the_limits() {
    let said = |source: &[u8]| read(source).unwrap_err().to_string();
    assert_eq!(said(b"{\"a\": \"\xff\"}"), "byte 7 is not UTF-8 text (save the file as UTF-8)");
    assert_eq!(
        said(&vec![b' '; 2_000_001]),
        "the file has more than 2000000 bytes; none that is written by hand is so long"
    );
    assert_eq!(
        said(&vec![b'['; 1_000_000]),
        "brackets are nested more than 32 deep; four levels are all that is needed"
    );
    let many: Vec<String> = (0..501).map(|i| format!("\"{i}\": [\"A\", \"B{i}\"]")).collect();
    let source = with("links", &format!("{{{}}}", many.join(",")));
    assert!(
        faults(&source)
            .starts_with("[\"500\"] \"links\" has 501 entries; at most 500 are allowed\n"),
        "{}",
        faults(&source)
    );
    let points: Vec<String> = (0..2100).map(|i| format!("\"P{i}\"")).collect();
    let source = with("links", &format!("{{\"1\": [{}], \"4\": [\"A\"]}}", points.join(",")));
    assert!(faults(&source).contains("there are more than 2000 points\n"), "{}", faults(&source));
}

#[test]
fn a_byte_order_mark_moves_no_place() {
    let source = format!("\u{feff}{}", with("ground", "4"));
    assert_eq!(faults(&source), "[4] \"ground\" must be a text, this is a number (write \"4\")\n");
}
