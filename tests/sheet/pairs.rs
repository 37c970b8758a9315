//! The figure shows the pairs that the scene names: blocks and levers, with the given velocities.

use hodograph::figure::mechanism::mechanism;
use hodograph::geom::Point;
use hodograph::notation::Notation;
use hodograph::paper::extent::Rect;
use hodograph::paper::item::{Dash, FigureItem, PathPiece, Shape};
use hodograph::paper::style::Style;
use hodograph::scene::{self, Lang, templates};
use hodograph::worked::{Scope, work};

fn drawn(text: &str) -> Vec<FigureItem> {
    let scene = scene::read(text).unwrap_or_else(|f| panic!("{f}")).value;
    let worked = work(&scene, Scope::Figure).unwrap_or_else(|f| panic!("{f}")).value;
    mechanism(&Style::default(), &scene, &worked, &Notation::of_language(Lang::En)).items
}

/// The links drawn as blocks, by their numbers in the scene.
fn blocks(items: &[FigureItem]) -> Vec<String> {
    let mut names: Vec<String> = items
        .iter()
        .filter(|i| i.class.ends_with("slider"))
        .map(|i| i.id.trim_start_matches("mechanism-").to_owned())
        .collect();
    names.sort();
    names
}

fn written(items: &[FigureItem]) -> Vec<&str> {
    fn label(i: &FigureItem) -> Option<&str> {
        match &i.shape {
            Shape::Label { label, .. } => Some(label.source()),
            _ => None,
        }
    }
    items.iter().filter_map(label).collect()
}

/// A lever that consists of its pivot and a slot, with the block in a guide of the ground or on a
/// wire.
const LEVER: &str = r#"{"links": {"1": ["O"], "2": ["O"]}, "ground": "1", "points": {"O": [0, 0]},
    "guides": [{"pin": "B", "slider": "3", "on": "2", "through": "O"},
               {"pin": "B", "slider": "4", "on": "1", "through": ["300 mm", 0], "angle": "90 deg"}],
    "driver": {"link": "2", "angle": "25 deg", "omega": "2 rad/s", "alpha": "-1 rad/s^2"}, "find": ["v_B"]}"#;

#[test]
fn a_driven_lever_is_no_swinging_block() {
    let items = drawn(LEVER);
    assert_eq!(blocks(&items), ["link-3", "link-4"]);
    for rate in ["\\omega_{2}", "\\alpha_{2}", "\\varphi_{2}"] {
        assert!(written(&items).contains(&rate), "{rate}: {:?}", written(&items));
    }
}

#[test]
fn what_swings_about_one_joint_is_a_block() {
    assert_eq!(blocks(&drawn(templates::get("oscillating-cylinder").unwrap())), ["link-3"]);
}

#[test]
fn both_arms_of_a_cross_are_drawn() {
    let oldham = r#"{"links": {"1": ["A", "B"], "2": ["A"], "3": ["P"], "4": ["B"]}, "ground": "1", "lengths": {"AB": "35 mm"},
        "points": {"P": ["35 mm*cos(50 deg)^2", "35 mm*cos(50 deg)*sin(50 deg)"]},
        "guides": [{"slider": "3", "on": "2", "pin": "P", "through": "A"},
                   {"pin": "B", "slider": "4", "on": "3", "through": "P", "angle": "140 deg"}],
        "driver": {"link": "2", "omega": "12 rad/s"}, "find": ["omega_4"]}"#;
    let items = drawn(oldham);
    let blocks = blocks(&items);
    assert!(
        matches!(&blocks[..], [a, b] if a.starts_with("link-3") && b.starts_with("link-4")),
        "{blocks:?}"
    );
    let bars = |link: usize| {
        items.iter().filter(|i| i.link == Some(link) && i.class.ends_with("link")).count()
    };
    assert_eq!([bars(1), bars(2)], [1, 1], "a lever 2, and the other arm of 3");
}

#[test]
fn a_plank_is_guided_where_it_lies() {
    let plank = r#"{"links": {"1": ["O"], "2": ["O", "A"], "3": ["A", "C"], "4": ["C"], "5": []}, "ground": "1", "points": {"O": [0, 0]},
        "lengths": {"OA": "150 mm", "AC": "500 mm"}, "guides": [{"slider": "5", "angle": "0 deg"}],
        "rolling": [{"wheel": "4", "centre": "C", "radius": "80 mm", "on": "1", "through": [0, "-130 mm"], "angle": "0 deg", "at": "N"},
                    {"wheel": "4", "centre": "C", "radius": "80 mm", "on": "5", "angle": "180 deg", "at": "T"}],
        "driver": {"link": "2", "angle": "60 deg", "omega": "5 rad/s"}, "side": {"C": "right of OA"}, "find": ["v_T5"]}"#;
    let items = drawn(plank);
    let level = |i: &FigureItem| match i.shape {
        Shape::Line { from, to, .. } if i.id.ends_with("link-5") || i.id.ends_with("track-T") => {
            Some([from, to])
        }
        _ => None,
    };
    let ends: Vec<Point> = items.iter().filter_map(level).flatten().collect();
    assert!(ends.len() >= 4, "body and track: {ends:?}");
    assert!(ends.iter().all(|p| (p.y - ends[0].y).abs() < 1e-9), "{ends:?}");
}

#[test]
fn oblique_guides_have_names_of_their_own() {
    let bars = r#"{"links": {"1": ["O"], "2": ["A"], "3": ["B"]}, "ground": "1",
        "points": {"O": [0, 0], "A": ["-0.3 m*cos(20 deg)", "-0.3 m*sin(20 deg)"], "B": ["-0.2 m*cos(100 deg)", "-0.2 m*sin(100 deg)"],
                   "M": [0, 0]},
        "guides": [{"pin": "A", "slider": "2", "angle": "110 deg"}, {"pin": "B", "slider": "3", "angle": "190 deg"},
                   {"pin": "M", "on": "2", "through": "A", "angle": "20 deg"}, {"pin": "M", "on": "3", "through": "B", "angle": "100 deg"}],
        "driver": [{"slide": "A", "velocity": "0.4 m/s"}, {"slide": "B", "velocity": "0.25 m/s"}], "find": ["v_M"]}"#;
    let items = drawn(bars);
    let names: Vec<&str> = written(&items)
        .into_iter()
        .filter(|t| t.starts_with("t_") || t.starts_with("t\\"))
        .collect();
    let mut different = names.clone();
    different.sort_unstable();
    different.dedup();
    assert_eq!((names.len(), different.len()), (4, 4), "{names:?}");
}

/// A cam of constant breadth between two faces: both touch it, and the redundant one is dashed.
#[test]
fn a_yoke_has_two_faces() {
    let yoke = r#"{"links": {"1": ["O"], "2": ["O", "B"]}, "ground": "1", "points": {"O": [0, 0]}, "lengths": {"OB": "20 mm"},
        "guides": [{"pin": "F", "slider": "3", "on": "1", "through": "O", "angle": "90 deg"}],
        "cams": [{"cam": "2", "follower": "3", "face": {}, "profile": {"centre": "B", "radius": "30 mm"}},
                 {"cam": "2", "follower": "3", "face": {"through": "F", "angle": "0 deg", "offset": "-60 mm", "cam": "left"},
                  "profile": {"centre": "B", "radius": "30 mm"}}],
        "driver": {"link": "2", "angle": "50 deg", "omega": "2 rad/s"}, "find": ["v_F"]}"#;
    let items = drawn(yoke);
    let circle = items.iter().find_map(|i| match &i.shape {
        Shape::Path { pieces, .. } if i.class.ends_with("cam") => Some(pieces[0]),
        _ => None,
    });
    let Some(PathPiece::Arc { centre, radius_mm: radius, .. }) = circle else {
        panic!("the cam is round: {circle:?}")
    };
    let faces: Vec<(f64, Dash)> = items
        .iter()
        .filter_map(|i| match i.shape {
            Shape::Line { from, to, stroke }
                if i.id.contains("follower-3") && (from.y - to.y).abs() < 1e-9 =>
            {
                Some((from.y - centre.y, stroke.dash))
            }
            _ => None,
        })
        .collect();
    assert!(faces.iter().all(|(off, _)| (off.abs() - radius).abs() < 1e-9), "{faces:?} {radius}");
    assert!(
        faces.iter().any(|f| f.0 > 0.0 && f.1 == Dash::Solid)
            && faces.iter().any(|f| f.0 < 0.0 && f.1 == Dash::Dashed),
        "{faces:?}"
    );
}

/// The disc of Oldham's coupling is one body with an arm in each slot: no joint where they meet, no
/// block on the second shaft.
#[test]
fn a_block_in_two_slots_is_a_cross() {
    let items = drawn(templates::get("oldham-coupling").unwrap());
    assert_eq!(blocks(&items), ["link-3"]);
    let corners = items.iter().find_map(|i| match &i.shape {
        Shape::Polyline { points, closed: true, .. } if i.class.ends_with("slider") => {
            Some(points.len())
        }
        _ => None,
    });
    assert_eq!(corners, Some(12));
    assert!(items.iter().all(|i| !i.id.ends_with("pin-C")), "nothing is joined at C");
    let bars = |link: usize| {
        items.iter().filter(|i| i.link == Some(link) && i.class.ends_with("link")).count()
    };
    assert_eq!([bars(1), bars(3)], [1, 1], "levers 2 and 4");
}

/// Oldham's coupling as two blocks that turn about the shafts, through which the arms of 3 slide.
const TURNED_BLOCKS: &str = r#"{"links": {"1": ["A", "D"], "2": ["A"], "3": ["C"], "4": ["D"]}, "ground": "1", "lengths": {"AD": "40 mm"},
    "points": {"C": ["40 mm*cos(50 deg)^2", "40 mm*cos(50 deg)*sin(50 deg)"]},
    "guides": [{"pin": "A", "slider": "2", "on": "3", "through": "C", "angle": "50 deg"},
               {"pin": "D", "slider": "4", "on": "3", "through": "C", "angle": "140 deg"}],
    "driver": {"link": "2", "omega": "20 rad/s"}, "find": ["omega_4", "v_C"]}"#;

#[test]
fn a_driven_block_has_its_arrow_and_two_guides_of_a_link_two_names() {
    let items = drawn(TURNED_BLOCKS);
    let written = written(&items);
    assert!(written.contains(&"\\omega_{2}"), "{written:?}");
    assert!(["t_{3A}", "t_{3D}"].iter().all(|t| written.contains(t)), "{written:?}");
}

/// The ground's number is at a hatching, on every template with a fixed pivot.
#[test]
fn the_number_of_the_ground_is_at_its_hatching() {
    let mut seen = 0;
    for template in templates::list() {
        let text = templates::get(template.name).unwrap();
        let ground = scene::read(text).unwrap().value;
        let name = ground.link_name(ground.ground).to_owned();
        let items = drawn(text);
        let hatched: Vec<Rect> = items
            .iter()
            .filter(|i| i.class.ends_with("hatch") && i.id.contains("pivot"))
            .filter_map(FigureItem::bounds)
            .collect();
        let number = items
            .iter()
            .find(|i| i.id == format!("mechanism-label-number-{name}"))
            .and_then(FigureItem::bounds);
        let (Some(number), false) = (number, hatched.is_empty()) else { continue };
        let off = hatched.iter().map(|h| gap_mm(number, *h)).fold(f64::INFINITY, f64::min);
        assert!(off < 4.0, "{}: {off} mm from the nearest hatching", template.name);
        seen += 1;
    }
    assert!(seen > 30, "{seen}");
}

fn gap_mm(a: Rect, b: Rect) -> f64 {
    let x = (a.min.x - b.max.x).max(b.min.x - a.max.x).max(0.0);
    let y = (a.min.y - b.max.y).max(b.min.y - a.max.y).max(0.0);
    x.hypot(y)
}
