//! Messages of the reader for cams with faults.

use super::with;

/// Names and texts of bad scenes.
pub(super) fn bad() -> Vec<(&'static str, String)> {
    vec![
        ("cams", with("cams", CAMS)),
        (
            "cam law open",
            cam(
                r#""roller": {"pin": "B", "radius": "5 mm"}, "profile": {"base": "30 mm", "law": [{"rise": "9 mm", "over": "90 deg", "law": "harmonic"}, {"dwell": "200 deg"}]}"#,
            ),
        ),
        (
            "cam no contact",
            cam(
                r#""edge": "B", "profile": [{"centre": "O", "radius": "3 mm"}, "tangent", {"centre": "Q", "radius": "2 mm"}, "tangent"]"#,
            ),
        ),
        (
            "cam apart",
            cam(
                r#""edge": "B", "profile": [{"centre": "O", "radius": "30 mm"}, {"radius": "31 mm"}, {"centre": "Q", "radius": "2 mm"}, "tangent"]"#,
            ),
        ),
        (
            "cam line and face",
            cam(
                r#""face": {"through": "B"}, "profile": ["tangent", {"centre": "R", "radius": "2 mm"}]"#,
            ),
        ),
    ]
}

/// Cams with one fault each, on a four-bar.
const CAMS: &str = r#"[
  {"cam": "1", "follower": "2", "profile": {"centre": "B", "radius": "5 mm"}},
  {"cam": "1", "follower": "2", "edge": "C", "roller": {"pin": "C", "radius": 1}, "profile": {"centre": "B", "radius": "5 mm"}},
  {"cam": "1", "follower": "9", "edge": "C", "profile": {"centre": "B", "radius": "5 mm"}},
  {"cam": "1", "follower": "1", "edge": "B", "profile": {"centre": "B", "radius": "5 mm"}},
  {"cam": "1", "follower": "2", "edge": "C", "profile": {"base": "5 mm", "law": [{"rise": "1 mm", "over": "10 deg", "law": "cyclodial"}]}},
  {"cam": "1", "follower": "2", "edge": "C", "profile": {"base": "5 mm", "law": [{"rise": "1 mm", "dwell": "10 deg"}]}},
  {"cam": "1", "follower": "2", "edge": "C", "profile": ["line"]},
  {"cam": "1", "follower": "2", "face": {"through": "C", "cam": "below"}, "profile": 3}
]"#;

/// A cam about O with a point Q, under a slider B.
fn cam(rest: &str) -> String {
    format!(
        r#"{{"links": {{"1": ["O"], "2": ["O", "Q"], "3": ["B"]}}, "ground": "1", "points": {{"O": [0, 0]}}, "lengths": {{"OQ": "20 mm"}},
        "guides": [{{"pin": "B", "slider": "3", "on": "1", "through": ["40 mm", 0], "angle": "90 deg"}}],
        "cams": [{{"cam": "2", "follower": "3", {rest}}}], "driver": {{"link": "2", "angle": "10 deg", "omega": "1 rad/s"}}, "find": ["v_B"]}}"#
    )
}
