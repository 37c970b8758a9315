use super::*;
use crate::keys;

/// A shaper's lever with entries of all kinds except cams, for comparison with its file.
fn all_kinds() -> Builder {
    Builder::new()
        .title("All kinds")
        .parameter("r", mm(40.0))
        .link("1", ["A", "B"])
        .link("3", ["O", "D"])
        .link("4", ["A", "O"])
        .link("6", ["Q"])
        .ground("4")
        .point("A", mm(0.0), mm(100.0))
        .point("O", mm(0.0), mm(0.0))
        .length("AB", Length::expression("r"))
        .length("OD", mm(250.0))
        .guide(Guide::slider("2", "B").on("3").line("OD"))
        .wheel(Wheel::new("6", "Q", mm(20.0)).through_at(mm(0.0), mm(-50.0)).angle(deg(0.0)))
        .driver(Driver::turning("1").angle(deg(30.0)).omega(rpm(60.0)))
        .driver(Driver::sliding("Q").position(mm(10.0)).velocity(m_per_s(0.5)))
        .find(["v_D", "omega_3", "omega_6"])
}

#[test]
fn a_built_scene_is_the_scene_of_its_file() {
    let builder = all_kinds();
    let built = builder.build().unwrap_or_else(|f| panic!("{f}\n{}", builder.json())).value;
    assert_eq!(built, read(builder.json()).unwrap().value);
    assert_eq!(built.drivers.len(), 2);
    assert_eq!(built.lengths[0].value.value, 0.04);
    assert_eq!(built.find.len(), 3);
}

#[test]
fn numbers_are_the_doubles_that_were_given() {
    let third = 1.0 / 3.0;
    for value in [third, 1e-12, 123456789.123, 5e15, -0.25] {
        let scene = all_kinds().sketch("B", m(value), m(0.0)).build().unwrap().value;
        let b = scene.points.iter().find(|p| p.name == "B").unwrap();
        assert_eq!(b.sketch, Some([value, 0.0]), "{value:?}");
    }
    for value in [f64::NAN, f64::INFINITY] {
        assert!(all_kinds().length("OD", mm(value)).build().is_err(), "{value}");
    }
}

#[test]
fn what_is_wrong_is_told_as_of_a_file() {
    let wrong = all_kinds().length("AB", Length::expression("30 deg")).find(["v_Z"]);
    let faults = wrong.build().unwrap_err();
    let codes: Vec<_> = faults.list.iter().filter(|d| d.span.is_some()).map(|d| d.code).collect();
    assert!(codes.len() >= 2, "{faults}");
}

/// Every method writes a key of the format.
#[test]
fn every_member_is_a_key() {
    let of = |v: Value, keys: &[&str]| {
        for key in v.as_object().unwrap().keys() {
            assert!(keys.contains(&key.as_str()), "{key}");
        }
    };
    let turning = Driver::turning("1")
        .against("2")
        .line("AB")
        .against_line("BC")
        .angle(deg(1.0))
        .omega(rpm(1.0))
        .alpha(rad_per_s2(1.0));
    of(turning.json(), keys::TURN);
    of(
        Driver::sliding("C")
            .position(mm(1.0))
            .velocity(mm_per_s(1.0))
            .acceleration(m_per_s2(1.0))
            .json(),
        keys::SLIDE,
    );
    of(
        Driver::cylinder("FG")
            .length(mm(1.0))
            .rate(mm_per_s(1.0))
            .acceleration(m_per_s2(1.0))
            .links("5", "6")
            .json(),
        keys::CYLINDER,
    );
    let straight = Guide::yoke("3").on("4").line("AB").through("A").angle(deg(0.0)).offset(mm(1.0));
    of(straight.json(), keys::GUIDE);
    of(Guide::pin("C").centre("K").radius(mm(1.0)).json(), keys::GUIDE);
    let gears = Gears::pair(["2", "3"], ["A", "B"])
        .radii(&[mm(1.0), mm(2.0)])
        .ring("3")
        .at("K")
        .phase(deg(0.0));
    of(gears.json(), keys::GEAR);
    of(
        Gears::on_rack("2", "A", "5")
            .teeth(&[20])
            .module(mm(2.0))
            .line("FG")
            .angle(deg(0.0))
            .json(),
        keys::GEAR,
    );
    let wheel = Wheel::new("4", "B", mm(1.0))
        .on("1")
        .track("K")
        .track_radius(mm(2.0))
        .inside(true)
        .at("N")
        .phase(deg(0.0))
        .line("AB");
    of(wheel.json(), keys::ROLLING);
    of(
        Value::Object(
            all_kinds().side("D", "left of AO").statement("...").language(Lang::Zh).members,
        ),
        keys::SCENE,
    );
}

/// Every template in the new layout is the same scene, in lines within the limit.
#[test]
fn the_layout_changes_nothing() {
    for t in crate::templates::list() {
        let value: Value = serde_json::from_str(crate::templates::get(t.name).unwrap()).unwrap();
        let text = write(&value);
        assert_eq!(serde_json::from_str::<Value>(&text).unwrap(), value, "{}", t.name);
        let long = |l: &&str| l.chars().count() > 112 && l.matches('"').count() > 4;
        assert_eq!(text.lines().find(long), None, "{}", t.name);
    }
}
