//! Pictures of motion: they show the values of a sweep, and they are legible.

use super::legible::{SMALLEST_MM, look};
use super::wide::every;
use hodograph::figure::path::{self, PathContent};
use hodograph::figure::poses;
use hodograph::figure::sheet::SheetOptions;
use hodograph::mechanism::Mechanism;
use hodograph::paper::item::{Figure, Shape};
use hodograph::scene::{Lang, PointId, Scene, Swept, edit, read, templates};
use hodograph::sweep::points::motion;
use hodograph::sweep::{self, PlacedScene, Stations, Width, extreme, station};
use hodograph::worked::{Scope, Worked, work};

/// A coupler point, a foot, a slider, points of rockers and of links that are stopped, a cylinder's
/// rod.
const POINTS: [(&str, &[&str]); 8] = [
    ("crank-rocker", &["E"]),
    ("jansen-leg", &["G"]),
    ("offset-slider-crank", &["S"]),
    ("shaper", &["B", "C"]),
    ("class-iii-six-bar", &["P"]),
    ("stephenson-six-bar", &["E", "H"]),
    ("oscillating-cylinder", &["B"]),
    ("elliptic-trammel", &["P"]),
];

fn open(name: &str) -> (Scene, Worked) {
    let scene = read(templates::get(name).unwrap()).unwrap().value;
    let worked = work(&scene, Scope::Figure).unwrap().value;
    (scene, worked)
}

fn points(scene: &Scene, names: &[&str]) -> Vec<PointId> {
    let of = |name: &&str| {
        PointId(
            scene
                .points
                .iter()
                .position(|p| p.name == **name)
                .unwrap_or_else(|| panic!("no {name}")),
        )
    };
    names.iter().map(of).collect()
}

/// The vectors of the figure come from the loop equations in each pose, those of a sweep from the
/// compiled program.
#[test]
fn hodographs_are_what_a_sweep_tells() {
    let mut compared = 0;
    for (name, names) in POINTS {
        let (scene, worked) = open(name);
        let points = points(&scene, names);
        let moved = motion(
            &scene,
            &worked.mechanism,
            &worked.demand,
            &worked.configuration,
            Swept::Driver(0),
            &points,
            12,
        );
        assert_eq!(moved.marks.len(), 12, "{name}");
        let find: Vec<String> =
            names.iter().flat_map(|n| ["x", "y", "v", "a"].map(|q| format!("{q}_{n}"))).collect();
        let find: Vec<&str> = find.iter().map(String::as_str).collect();
        let asked =
            read(edit::with_find(templates::get(name).unwrap(), &find).unwrap()).unwrap().value;
        let mechanism = Mechanism::new(&asked).unwrap().value;
        let placed = PlacedScene::new(&asked, &mechanism).unwrap();
        let per_value = station::angle_per_value(&asked, &placed.at, 0);
        for mark in &moved.marks {
            // At a limit there are no velocities.
            if mark.vectors.iter().flatten().any(Option::is_none) {
                continue;
            }
            let station = Stations::of_values(vec![mark.place], per_value);
            let table = sweep::run(&placed, 0, &station, Width::One).unwrap();
            for (k, n) in names.iter().enumerate() {
                let column = |c: String| table.column(&c).and_then(|c| c.values.first().copied());
                let at = mark.configuration.points[points[k].0].unwrap();
                let [v, a] = mark.vectors[k].map(Option::unwrap);
                for (column, value, size) in [
                    (column(format!("x_{n}")), at.x, placed.at.extent()),
                    (column(format!("y_{n}")), at.y, placed.at.extent()),
                    (column(format!("v_{n}.x")), v.x, v.norm()),
                    (column(format!("v_{n}.y")), v.y, v.norm()),
                    (column(format!("a_{n}.x")), a.x, a.norm()),
                    (column(format!("a_{n}.y")), a.y, a.norm()),
                ] {
                    // Next to a limit the place of the driver determines no more than half of the
                    // digits.
                    let Some(expected) = column else { continue };
                    let bounded = moved.limits.iter().any(|l| *l);
                    let tolerance = if bounded { 1e-5 } else { 1e-9 };
                    assert!(
                        (expected - value).abs() <= tolerance * size.max(1e-6),
                        "{name} {n}: {expected} {value} at {}",
                        mark.place
                    );
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 400, "{compared}");
}

/// Ends of a bounded travel are the limits found by sweeps.
#[test]
fn paths_end_at_the_limits_of_the_driver() {
    let (scene, worked) = open("class-iii-six-bar");
    let limits = extreme::limits(&scene, &worked.mechanism, 0).unwrap();
    let ends: Vec<f64> = limits.range.ends.iter().map(|e| e.as_ref().unwrap().value).collect();
    let moved = motion(
        &scene,
        &worked.mechanism,
        &worked.demand,
        &worked.configuration,
        Swept::Driver(0),
        &points(&scene, &["P"]),
        5,
    );
    for (mark, end) in [(&moved.marks[0], ends[0]), (&moved.marks[4], ends[1])] {
        assert!((mark.place - end).abs() < 1e-9, "{} {end}", mark.place);
    }
    assert_eq!(moved.limits, [true, true]);
}

fn readable(name: &str, figure: &Figure, links: usize, at_full_size: bool) {
    let found = look(figure, links);
    let smallest = if at_full_size {
        let size =
            |s: &Shape| if let Shape::Label { size_mm, .. } = s { *size_mm } else { f64::INFINITY };
        figure.items.iter().map(|i| size(&i.shape)).fold(f64::INFINITY, f64::min)
    } else {
        found.smallest_mm
    };
    assert_eq!((found.overlaps, found.outside), (0, 0), "{name}");
    assert!(smallest >= SMALLEST_MM, "{name}: {smallest}");
    let mut ids: Vec<&str> =
        figure.items.iter().map(|i| i.id.as_str()).filter(|id| !id.is_empty()).collect();
    ids.sort_unstable();
    let all = ids.len();
    ids.dedup();
    assert_eq!(ids.len(), all, "{name}: names are not unique");
}

/// Checked with the mechanism in one position and in several.
#[test]
fn paths_can_be_read() {
    for (k, (name, names)) in POINTS.into_iter().enumerate() {
        let (scene, worked) = open(name);
        let (lang, poses) = if k % 2 == 0 { (Lang::En, 0) } else { (Lang::Zh, 6) };
        let wanted = PathContent {
            points: points(&scene, names),
            swept: Swept::Driver(0),
            marks: 12,
            poses,
        };
        let figure = path::figure(&scene, &worked, &SheetOptions::of_language(lang), &wanted)
            .unwrap_or_else(|f| panic!("{name}: {f}"));
        readable(name, &figure.value, scene.links.len(), false);
    }
}

/// Poses through a turn, or from limit to limit: to one set of scales, legible at the size of their
/// paper.
#[test]
fn sheets_of_poses_can_be_read() {
    for (name, lang) in [
        ("crank-rocker", Lang::En),
        ("shaper", Lang::Zh),
        ("class-iii-six-bar", Lang::En),
        ("five-bar", Lang::Zh),
    ] {
        let (scene, worked) = open(name);
        let wanted = poses::PosesContent { count: 5, swept: Swept::Driver(0), points: Vec::new() };
        let pages = poses::sheets(&scene, &worked, &SheetOptions::of_language(lang), &wanted)
            .unwrap_or_else(|f| panic!("{name}: {f}"));
        assert!(pages.notes.iter().all(|n| n.code == "poses-driver"), "{name}: {:?}", pages.notes);
        for page in &pages.value {
            readable(name, page, scene.links.len(), true);
        }
    }
}

/// With the default paper, the table of any template is printed on A4 or A3: nothing is cut off,
/// and no page has a single row.
#[test]
fn tables_of_poses_are_printed_on_a4_or_a3() {
    let mut formats = [0; 2];
    for t in templates::list().iter().step_by(every(4)) {
        let (scene, worked) = open(t.name);
        let wanted = poses::PosesContent { count: 6, swept: Swept::Driver(0), points: Vec::new() };
        let Ok(pages) =
            poses::sheets(&scene, &worked, &SheetOptions::of_language(Lang::En), &wanted)
        else {
            continue;
        };
        let mut positions = 0;
        for page in &pages.value {
            let (short, long) =
                (page.width_mm.min(page.height_mm), page.width_mm.max(page.height_mm));
            let format = if short <= 210.0 && long <= 297.0 { 0 } else { 1 };
            assert!(short <= 297.0 && long <= 420.0, "{}: {short} x {long}", t.name);
            formats[format] += 1;
            positions += page
                .items
                .iter()
                .filter(|i| i.id.starts_with("position-") && !i.id.ends_with("-driver"))
                .count();
        }
        assert!(
            positions >= 2 && pages.value.len() <= positions.div_ceil(2),
            "{}: {} pages",
            t.name,
            pages.value.len()
        );
    }
    assert!(formats[0] > formats[1], "{formats:?}");
}

/// Only the first drawing of a column names its vectors and links; all drawings name their points.
#[test]
fn names_stand_in_the_first_row() {
    let (scene, worked) = open("crank-rocker");
    let wanted = poses::PosesContent { count: 4, swept: Swept::Driver(0), points: Vec::new() };
    let pages = poses::sheets(&scene, &worked, &SheetOptions::of_language(Lang::En), &wanted)
        .unwrap()
        .value;
    let labels = |row: usize, what: &str| {
        let start = format!("pose-{row}-{}-label-", hodograph::paper::drawing::prefix(what));
        pages
            .iter()
            .flat_map(|p| &p.items)
            .filter(|i| i.id.starts_with(&start) && !i.id.ends_with("-leader"))
            .count()
    };
    for what in ["mechanism", "velocity", "acceleration"] {
        assert!(
            (2..=4).all(|row| labels(row, what) >= 3 && labels(row, what) < labels(1, what)),
            "{what}"
        );
    }
}

/// A fixed paper size gives several pages; one that is too small is refused.
#[test]
fn a_fixed_paper_makes_pages() {
    let (mut scene, worked) = open("slider-crank");
    let wanted =
        poses::PosesContent { count: 5, swept: Swept::Driver(0), points: points(&scene, &["B"]) };
    let options = SheetOptions::of_language(Lang::En);
    scene.paper.size_mm = Some([420.0, 297.0]);
    let pages = poses::sheets(&scene, &worked, &options, &wanted).unwrap().value;
    assert!(
        pages.len() > 1 && pages.iter().all(|p| (p.width_mm, p.height_mm) == (420.0, 297.0)),
        "{}",
        pages.len()
    );
    scene.paper.size_mm = Some([100.0, 100.0]);
    let faults = poses::sheets(&scene, &worked, &options, &wanted).unwrap_err();
    assert_eq!(faults.list[0].code, "paper-too-small");
}
