//! Strokes, extremes, dwells and time ratios of `limits`, compared with formulas by hand, for any
//! position of the driver in the scene.

use super::{limits_of, scene};
use hodograph::scene::{Scene, edit, read, templates};
use hodograph::sweep::extreme::{DrivenOutput, Grashof, OutputExtreme, Swing};
use hodograph::sweep::follow::course::over_a_turn;
use std::f64::consts::{PI, TAU};

/// Positions of the driver at which the motion starts: at extremes, at joints of stages, within
/// dwells and strokes.
const STARTS: [f64; 8] = [0.0, 35.0, 90.0, 100.0, 135.0, 170.0, 270.0, 300.0];

/// An expected extreme: the driver's angle, the angle at which a dwell ends (degrees), the output
/// (rad or m).
type Wanted = (f64, Option<f64>, f64);

/// Compares the extremes of a swing, each listed once, with those expected, in any order of a turn.
fn same(swing: &Swing, wanted: &[Wanted], what: &str) {
    let apart = |a: f64, b: f64| (a - b - ((a - b) / TAU).round() * TAU).abs();
    let is = |e: &OutputExtreme, (driver, until, output): &Wanted| {
        let until = match (e.until, until) {
            (Some(a), Some(b)) => apart(a, b.to_radians()) < 1e-9,
            (a, b) => a.is_none() && b.is_none(),
        };
        until
            && apart(e.driver, driver.to_radians()) < 1e-7
            && (e.output - output).abs() < 1e-12
            && !e.at_limit
    };
    assert_eq!(swing.extremes.len(), wanted.len(), "{what}: {swing:?}");
    assert!(
        wanted.iter().all(|w| swing.extremes.iter().any(|e| is(e, w))),
        "{what}: {swing:?}, not {wanted:?}"
    );
}

/// Compares stroke and time ratio of a swing with those expected.
fn strokes(swing: &Swing, stroke: f64, ratio: f64, what: &str) {
    assert!((swing.stroke.unwrap() - stroke).abs() < 1e-12, "{what}: {swing:?}, not {stroke}");
    assert!((swing.time_ratio.unwrap() - ratio).abs() < 1e-9, "{what}: {swing:?}, not {ratio}");
}

/// A roller of 10 mm on a vertical guide at an offset from O, on a cam of this profile, for its
/// whole motion.
fn roller(offset: f64, two: &str, profile: &str, angle: f64) -> Scene {
    let text = format!(
        r#"{{"units": {{"length": "mm"}}, "links": {{"1": ["O"], "2": [{two}], "3": ["B"]}}, "ground": "1", "points": {{"O": [0, 0]}},
        "lengths": {{{}}}, "guides": [{{"pin": "B", "slider": "3", "on": "1", "through": [{offset:?}, 0], "angle": "90 deg"}}],
        "cams": [{{"cam": "2", "follower": "3", "roller": {{"pin": "B", "radius": 10}}, "profile": {profile}}}],
        "driver": {{"link": "2", "angle": "{angle:?} deg", "omega": "5 rad/s"}}, "find": ["v_B"]}}"#,
        if two.contains('Q') { r#""OQ": 20"# } else { "" }
    );
    over_a_turn(&read(&text).unwrap_or_else(|f| panic!("{f}\n{text}")).value)
}

/// Rise over 100°, return over 130°, dwells of 70° and 60°: one extreme for each dwell, from its
/// start to its end; the time ratio is that of the strokes alone, 130/100, not that of 200/160 with
/// the dwells.
#[test]
fn a_dwell_is_one_extreme_and_no_part_of_a_stroke() {
    let law = |of: &str| {
        format!(
            r#"{{"base": 30, "law": [{{"rise": 20, "over": "100 deg", "law": "{of}"}}, {{"dwell": "70 deg"}},
            {{"return": 20, "over": "130 deg", "law": "{of}"}}, {{"dwell": "60 deg"}}]}}"#
        )
    };
    // The guide is 9 mm from O: at its lowest the roller's centre is 40 mm from O.
    let low = (0.04f64 * 0.04 - 0.009 * 0.009).sqrt();
    for (start, of) in
        STARTS.into_iter().zip(["uniform", "harmonic", "cycloidal", "3-4-5"].into_iter().cycle())
    {
        let limits = limits_of(&roller(9.0, r#""O""#, &law(of), start));
        let what = format!("{of} from {start}°");
        assert!(limits.range.full() && limits.swings.len() == 1, "{what}");
        same(
            &limits.swings[0],
            &[(100.0, Some(170.0), low + 0.02), (300.0, Some(360.0), low)],
            &what,
        );
        strokes(&limits.swings[0], 0.02, 1.3, &what);
    }
}

/// A tangent cam: the roller dwells on the base circle from one flank to the other and reverses at
/// the nose without a dwell; the flanks begin acos((R − r)/OQ) to either side of the nose.
#[test]
fn a_nose_is_an_extreme_and_a_base_circle_a_dwell() {
    let profile =
        r#"[{"centre": "O", "radius": 20}, "tangent", {"centre": "Q", "radius": 8}, "tangent"]"#;
    let flank = (12.0f64 / 20.0).acos().to_degrees();
    for start in STARTS {
        let limits = limits_of(&roller(0.0, r#""O", "Q""#, profile, start));
        // The angle of the driver is that of OQ; the nose is at the top at 90°.
        same(
            &limits.swings[0],
            &[(90.0, None, 0.038), (90.0 + flank, Some(90.0 - flank), 0.03)],
            &format!("from {start}°"),
        );
        strokes(&limits.swings[0], 0.008, 1.0, &format!("from {start}°"));
    }
}

/// An eccentric circle lifts its follower by twice its eccentricity; with an offset guide, by the
/// stroke of the offset slider-crank.
#[test]
fn an_eccentric_has_a_stroke_of_twice_its_eccentricity() {
    let profile = r#"{"centre": "Q", "radius": 35}"#;
    for start in STARTS {
        let what = format!("from {start}°");
        let limits = limits_of(&roller(0.0, r#""O", "Q""#, profile, start));
        same(&limits.swings[0], &[(90.0, None, 0.065), (270.0, None, 0.025)], &what);
        strokes(&limits.swings[0], 0.04, 1.0, &what);
        // OQ is the crank, QB the rod, 45 mm; the extremes are where they are in line.
        let limits = limits_of(&roller(15.0, r#""O", "Q""#, profile, start));
        let high = (0.015f64 / 0.065).acos();
        let low = (0.015f64 / 0.025).acos();
        let far = |l: f64| (l * l - 0.015f64 * 0.015).sqrt();
        same(
            &limits.swings[0],
            &[(high.to_degrees(), None, far(0.065)), (180.0 + low.to_degrees(), None, far(0.025))],
            &what,
        );
        let turn = PI + low - high;
        strokes(
            &limits.swings[0],
            far(0.065) - far(0.025),
            (TAU - turn).max(turn) / (TAU - turn).min(turn),
            &what,
        );
    }
    let text = r#"{"units": {"length": "mm"}, "links": {"1": ["O"], "2": ["O", "Q"]}, "ground": "1", "points": {"O": [0, 0]}, "lengths": {"OQ": 12},
        "guides": [{"slider": "3", "on": "1", "angle": "90 deg", "through": "O"}],
        "cams": [{"cam": "2", "follower": "3", "face": {}, "profile": {"centre": "Q", "radius": 35}}],
        "driver": {"link": "2", "angle": "40 deg", "omega": "5 rad/s"}, "find": ["s_3"]}"#;
    let flat = limits_of(&read(text).unwrap_or_else(|f| panic!("{f}")).value);
    assert_eq!(flat.swings[0].extremes.len(), 2, "{flat:?}");
    strokes(&flat.swings[0], 0.024, 1.0, "a flat face");
}

/// The scene of a template with its crank at an angle.
fn turned(template: &str, parameter: &str, angle: f64) -> Scene {
    let text = templates::instantiate(template, &[(parameter, &format!("{angle:?}"))]).unwrap();
    read(edit::with_find(&text, &["v_C"]).unwrap())
        .unwrap_or_else(|f| panic!("{template} at {angle}: {f}"))
        .value
}

/// A crank-rocker's extremes are where crank and coupler are in line, extended or folded.
#[test]
fn a_crank_rocker_has_two_extremes_wherever_it_starts() {
    let [a, b, c, d] = [0.1f64, 0.25, 0.2, 0.3];
    let crank = |s: f64| ((s * s + d * d - c * c) / (2.0 * s * d)).acos().to_degrees();
    let rocker = |s: f64| PI - ((c * c + d * d - s * s) / (2.0 * c * d)).acos();
    let (far, near) = (crank(a + b), 180.0 + crank(b - a));
    let wanted = [(far, None, rocker(a + b)), (near, None, rocker(b - a))];
    let ratio = (near - far).max(360.0 - near + far) / (near - far).min(360.0 - near + far);
    for start in STARTS.into_iter().chain([far, near]) {
        let limits = limits_of(&turned("crank-rocker", "phi_1", start));
        same(&limits.swings[0], &wanted, &format!("from {start}°"));
        strokes(&limits.swings[0], rocker(b - a) - rocker(a + b), ratio, &format!("from {start}°"));
    }
}

/// A shaper's crank is perpendicular to the slotted lever at both extremes: sin θ/2 = O₁A/O₁O₂, K =
/// (π + θ)/(π − θ), the ram moves 2 O₂B sin θ/2.
#[test]
fn a_shaper_cuts_slowly_and_returns_fast() {
    let half = (110.0f64 / 380.0).asin();
    let ratio = (PI + 2.0 * half) / (PI - 2.0 * half);
    let degrees = half.to_degrees();
    for start in STARTS.into_iter().chain([180.0 + degrees, -degrees]) {
        let limits = limits_of(&turned("shaper", "phi_1", start));
        let what = format!("from {start}°");
        let of = |wanted: fn(&DrivenOutput) -> bool| {
            limits.swings.iter().find(|s| wanted(&s.output)).unwrap()
        };
        let (lever, ram) = (
            of(|o| matches!(o, DrivenOutput::Turning(_))),
            of(|o| matches!(o, DrivenOutput::Sliding(_))),
        );
        same(
            lever,
            &[(180.0 + degrees, None, PI / 2.0 + half), (-degrees, None, PI / 2.0 - half)],
            &what,
        );
        strokes(lever, 2.0 * half, ratio, &what);
        assert_eq!(ram.extremes.len(), 2, "{what}: {ram:?}");
        strokes(ram, 2.0 * 0.65 * 110.0 / 380.0, ratio, &what);
    }
    assert_eq!(limits_of(&scene("shaper", &[])).swings.len(), 2);
}

/// A four-bar by hand: extremes of the rocker where crank and coupler are in line, transmission
/// angle where crank and frame are.
#[test]
fn limits_of_a_crank_rocker() {
    let scene = scene("crank-rocker", &[]);
    let limits = limits_of(&scene);
    let (a, b, c, d) = (0.1f64, 0.25f64, 0.2f64, 0.3f64);
    assert_eq!(limits.grashof.unwrap().0, Grashof::CrankRocker);
    let swing = &limits.swings[0];
    let angle = |s: f64| PI - ((c * c + d * d - s * s) / (2.0 * c * d)).acos();
    assert!(
        (swing.stroke.unwrap() - (angle(b - a) - angle(a + b)).abs()).abs() < 1e-14,
        "{swing:?}"
    );
    let crank = |s: f64| ((s * s + d * d - c * c) / (2.0 * s * d)).acos();
    let turn = PI + crank(b - a) - crank(b + a);
    let (long, short) = (turn.max(TAU - turn), turn.min(TAU - turn));
    assert!((swing.time_ratio.unwrap() - long / short).abs() < 1e-13, "{swing:?}");
    let gamma = |s: f64| ((b * b + c * c - s * s) / (2.0 * b * c)).acos();
    let worst = gamma(d - a).min(PI - gamma(d + a));
    assert!(
        (limits.transmission[0].angle - worst).abs() < 1e-14,
        "{:?} {worst}",
        limits.transmission
    );
}
