//! Scenes that once failed (wrong answers, refusals, panics), found by random mechanisms and
//! reduced.

use hodograph::geom::Point;
use hodograph::scene;
use hodograph::worked::{Scope, Worked, work};

fn solved(text: &str) -> Worked {
    let scene = scene::read(text).unwrap_or_else(|f| panic!("{f}\n{text}")).value;
    let done = work(&scene, Scope::Figure).unwrap_or_else(|f| panic!("{f}\n{text}")).value;
    for o in &done.results {
        let name = &scene.find[o.find].text;
        assert!(o.drawn.is_some(), "{name} was not drawn\n{text}");
        assert!(o.agreement.is_none_or(|a| a.holds()), "{name}: {o:?}\n{text}");
    }
    done
}

fn refused(text: &str, code: &str) {
    let result = scene::read(text).and_then(|s| work(&s.value, Scope::Figure));
    let faults = result.expect_err("this scene has no answer");
    assert!(faults.list.iter().any(|d| d.code == code), "no {code} in {faults}");
}

/// A block on a curved guide turns with the radius, not with its carrier. 3-4-5: the pin is 5 from
/// the centre.
#[test]
fn a_block_on_a_curved_guide_turns_with_the_radius() {
    let scene = |find: &str| {
        format!(
            r#"{{"links": {{"0": ["K", "A"], "1": ["A", "B"]}}, "ground": "0", "points": {{"K": [0, 0], "A": ["4 m", "1 m"], "B": ["4 m", "3 m"]}},
            "guides": [{{"pin": "C", "slider": "3", "on": "0", "centre": "K"}}, {{"pin": "C", "on": "1", "line": "A,B"}}],
            "units": {{"length": "m"}}, "driver": {{"link": "1", "omega": "1 rad/s"}}, "find": [{find}]}}"#
        )
        .replace(r#""B": ["4 m", "3 m"]"#, r#""B": ["4 m", "2 m"], "C": ["4 m", "3 m"]"#)
    };
    let done = solved(&scene(r#""omega_3", "alpha_3""#));
    // v_C is perpendicular to KC; its component along x is −ω·AC = −2, so |v_C| = 2·5/3 and ω₃ =
    // 2/3.
    let omega = done.results[0].value().magnitude();
    assert!((omega - 2.0 / 3.0).abs() < 1e-14, "{omega}");
    // A point of the block elsewhere: the block's angular velocity is found before it is used.
    solved(&scene(r#""a_B3", "v_A3""#));
}

/// The angular velocity of a link with two slots over one pin needs two different points.
#[test]
fn two_slots_over_one_pin() {
    solved(
        r#"{"links": {"0": ["O", "Q"], "1": ["O", "A"], "2": ["P", "R"]}, "ground": "0",
        "points": {"O": ["0 m", "0 m"], "A": ["1 m", "0.5 m"], "Q": ["3 m", "0.2 m"], "P": ["2 m", "1.5 m"], "R": ["0.5 m", "2 m"]},
        "guides": [{"pin": "A", "on": "2", "angle": "20 deg"}, {"pin": "A", "on": "2", "centre": "P"}, {"pin": "Q", "on": "2", "angle": "70 deg"}],
        "driver": {"link": "1", "omega": "1 rad/s", "alpha": "2 rad/s^2"}, "find": ["omega_2", "alpha_2", "a_R"]}"#,
    );
}

/// A ram with its stroke given by coordinates only.
#[test]
fn a_ram_by_coordinates() {
    let done = solved(
        r#"{"links": {"0": ["A", "B"], "1": ["A"], "2": ["B", "C"]}, "ground": "0",
        "points": {"A": ["0 m", "0 m"], "B": ["3 m", "0 m"], "C": ["2 m", "2 m"]},
        "guides": [{"pin": "C", "on": "1", "through": "A"}], "driver": {"slide": "C", "velocity": "1 m/s"}, "find": ["omega_1", "a_C"]}"#,
    );
    assert_eq!(done.configuration.points[2], Some(Point::new(2.0, 2.0)));
}

/// A guide without a pin, given at the instant on a moving link, must be placed.
#[test]
fn a_guide_without_a_pin_on_a_moving_link() {
    solved(
        r#"{"links": {"0": ["O", "Q"], "1": ["O", "A"], "2": ["B", "C"], "3": ["Q", "B"]}, "ground": "0",
        "points": {"O": ["0 m", "0 m"], "A": ["1 m", "0.5 m"], "Q": ["3 m", "0.2 m"], "B": ["2 m", "1.5 m"], "C": ["1.5 m", "2 m"]},
        "guides": [{"slider": "1", "on": "2", "angle": "20 deg"}],
        "driver": {"link": "1", "omega": "1 rad/s"}, "find": ["omega_2", "alpha_3", "a_C"]}"#,
    );
}

/// A guide along two coincident points, on a link placed by coordinates.
#[test]
fn a_guide_along_coincident_points() {
    refused(
        r#"{"links": {"0": ["O", "Q"], "1": ["O", "A"], "2": ["Q", "S", "T"]}, "ground": "0",
        "points": {"O": ["0 m", "0 m"], "A": ["1 m", "0.5 m"], "Q": ["3 m", "0.2 m"], "S": ["3 m", "0.2 m"], "T": ["2 m", "1 m"]},
        "guides": [{"pin": "A", "on": "2", "line": "Q,S"}], "driver": {"link": "1", "omega": "1 rad/s"}, "find": ["omega_2"]}"#,
        "degenerate-guide",
    );
}

/// A mechanism of a single point has no size against which a place can be judged; its pin has only
/// its own unknowns.
#[test]
fn a_single_driven_slider() {
    for find in [r#""v_A", "a_A""#, r#""v_A", "omega_2""#] {
        solved(&format!(
            r#"{{"links": {{"2": ["A", "B"]}}, "ground": "1", "points": {{"A": ["0.1 m", "0.3 m"], "B": ["0.7 m", "1.1 m"]}},
            "guides": [{{"pin": "A", "slider": "2", "on": "1", "angle": "0.3 rad", "through": ["0.4 m", "0.3928008748814 m"]}}],
            "driver": {{"slide": "A", "velocity": "1 m/s"}}, "find": [{find}]}}"#
        ));
    }
    solved(
        r#"{"links": {"2": ["A", "B"]}, "ground": "1", "points": {"A": ["0.1 m", "0.3 m"], "B": ["0.7 m", "1.1 m"]},
        "guides": [{"pin": "A", "slider": "2", "on": "1", "angle": "0.3 rad"}],
        "driver": {"slide": "A", "velocity": "1 m/s"}, "find": ["a_A"]}"#,
    );
}

/// Fixed points that are asked for coincide with the pole of the drawing.
#[test]
fn a_fixed_point_is_drawn() {
    solved(
        r#"{"links": {"0": ["O", "Q"], "1": ["O", "A"]}, "ground": "0", "points": {"O": ["0 m", "0 m"], "Q": ["1 m", "0 m"], "A": ["1 m", "1 m"]},
        "driver": {"link": "1", "omega": "1 rad/s"}, "find": ["v_Q", "a_O", "v_A"]}"#,
    );
}

/// An assembly near the end of the reach of two of a triad's legs is found: 3, 4 and 3, almost
/// stretched.
#[test]
fn a_triad_whose_legs_are_almost_stretched() {
    for hair in [1e-1f64, 1e-2, 1e-3, 1e-4] {
        // A and B are lifted by 3·sin(hair), AB stays level; C is 3 above B, W 4 above C.
        let (s, c) = (3.0 * libm::sin(hair), 3.0 * libm::cos(hair));
        let text = format!(
            r#"{{"links": {{"0": ["U", "V", "W"], "1": ["A", "B", "C"], "3": ["V", "B"], "4": ["W", "C"]}}, "ground": "0",
            "points": {{"U": ["0 m", "0 m"], "V": ["{v} m", "0 m"], "W": ["{w} m", "{h} m"]}},
            "lengths": {{"AB": "4 m", "VB": "3 m", "AC": "5 m", "BC": "3 m", "WC": "4 m"}},
            "sketch": {{"A": ["{c} m", "{s} m"], "B": ["{b} m", "{s} m"], "C": ["{b} m", "{k} m"]}},
            "driver": {{"cylinder": "U,A", "length": "3 m", "rate": "1 m/s"}}, "find": ["x_A", "x_C"]}}"#,
            v = 4.0 + 2.0 * c,
            w = c + 4.0,
            h = s + 7.0,
            b = c + 4.0,
            k = s + 3.0,
        );
        let scene = scene::read(&text).unwrap_or_else(|f| panic!("{f}\n{text}")).value;
        let done = work(&scene, Scope::Figure)
            .unwrap_or_else(|f| panic!("hair {hair:e}: {f}\n{text}"))
            .value;
        let at = scene.points.iter().position(|p| p.name == "A").unwrap();
        let off = done.configuration.points[at].unwrap().distance(Point::new(c, s));
        assert!(off < 1e-10, "hair {hair:e}: A lies {off:e} from its sketch");
    }
}

/// A link that slides on a curved guide turns about the guide's centre.
#[test]
fn a_link_on_a_curved_guide_is_a_pin_joint() {
    let scene = |links: &str, guides: &str| {
        format!(
            r#"{{"links": {{"0": ["O", "K"], "1": ["O", "A"], "2": ["A", "C"], {links}}}, "ground": "0",
            "points": {{"O": ["0 m", "0 m"], "A": ["1 m", "0.5 m"], "K": ["2 m", "0.5 m"], "C": ["2.5 m", "2 m"], "D": ["1.5 m", "2.5 m"]}},
            "guides": [{guides}], "driver": {{"link": "1", "omega": "1 rad/s"}}, "find": ["omega_3", "alpha_3", "a_D"]}}"#
        )
    };
    refused(
        &scene(r#""3": ["C", "D"]"#, r#"{"pin": "C", "slider": "3", "on": "0", "centre": "K"}"#),
        "curved-slider",
    );
    solved(&scene(r#""3": ["K", "C", "D"]"#, ""));
}

/// A guide on the barrel of a cylinder is refused.
#[test]
fn a_cylinder_part_carries_nothing() {
    refused(
        r#"{"links": {"0": ["O", "Q"], "1": ["O", "A"], "4": ["Q", "B"]}, "ground": "0",
        "points": {"O": ["0 m", "0 m"], "Q": ["3 m", "0.2 m"], "A": ["1 m", "0.5 m"], "B": ["2 m", "1.5 m"]},
        "guides": [{"pin": "B", "on": "2", "angle": "20 deg"}],
        "driver": {"cylinder": "Q,A", "rate": "1 m/s", "links": ["2", "3"]}, "find": ["omega_1", "omega_4"]}"#,
        "cylinder-part",
    );
}

/// The acceleration of a point of a block on a curved guide needs the block's ω, which the plan
/// must find.
#[test]
fn a_point_of_a_block_on_a_curved_guide_is_found_with_its_turning() {
    for asked in ["a_K4", "ae_K/4", "a_C4"] {
        let done = solved(&format!(
            r#"{{"links": {{"1": ["A", "B"], "2": ["C", "K"], "3": ["A", "C"], "4": ["B"]}}, "ground": "3",
            "lengths": {{"AB": "100 mm", "AC": "260 mm", "CK": "160 mm"}}, "side": {{"K": "left of BC"}},
            "guides": [{{"pin": "B", "slider": "4", "on": "2", "centre": "K", "radius": "180 mm"}}],
            "driver": {{"link": "1", "angle": "60 deg", "omega": "10 rad/s"}}, "find": ["{asked}"]}}"#
        ));
        assert_eq!(done.results.len(), 1, "{asked}");
    }
}
