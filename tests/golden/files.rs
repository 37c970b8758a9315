//! The list of golden files, and the comparison and acceptance of one.
//!
//! The tests run over these lists, so that a file that no test compares is found: [`kept`] names
//! all, and a comparison under another name panics.

use hodograph::scene::{Lang, templates};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// The command that accepts, named by every failure.
pub const HOW: &str =
    "if this is what you want, look at it and run: HODOGRAPH_ACCEPT=1 cargo test --test golden";

pub const LANGS: [(Lang, &str); 2] = [(Lang::En, "en"), (Lang::Zh, "zh")];

/// Templates with their plan also kept as JSON: Coriolis, in both languages; a triad; cylinders.
pub const PLANS_AS_JSON: [(&str, &str); 4] =
    [("shaper", "en"), ("shaper", "zh"), ("class-iii-six-bar", "en"), ("excavator", "en")];

/// Templates with answers kept with the tolerances of hand drawing.
pub const DRAFTED: [&str; 1] = ["shaper"];

/// Templates with lesson and fragment kept: a crank that turns fully, and one that is stopped.
pub const LESSONS: [&str; 2] = ["crank-rocker", "five-bar"];

/// One picture of every kind of figure: template, kind, style.
pub const KINDS: [(&str, &str, &str); 8] = [
    ("class-iii-six-bar", "inset", "print"),
    ("shaper", "slides", "slides"),
    ("jansen-leg", "dark", "dark"),
    ("offset-slider-crank", "overlay", "slides"),
    ("slotted-lever", "step", "print"),
    ("crank-rocker", "equations", "print"),
    ("shaper", "groups", "print"),
    ("third-crank", "groups", "slides"),
];

/// Line diagrams.
pub const CURVES: [&str; 1] = ["shaper"];

/// Paths: template, points, positions drawn behind, style.
pub const PATHS: [(&str, &[&str], usize, &str); 4] = [
    ("crank-rocker", &["E"], 0, "print"),
    ("jansen-leg", &["G"], 6, "slides"),
    ("class-iii-six-bar", &["P"], 0, "print"),
    ("offset-slider-crank", &["C", "S"], 0, "dark"),
];

/// Sheets of many poses: template, point with hodographs behind the polygons, number of poses.
pub const POSES: [(&str, Option<&str>, usize); 3] =
    [("crank-rocker", Some("E"), 12), ("shaper", None, 4), ("class-iii-six-bar", None, 5)];

/// Figures of centres: a crank-rocker, shapers with centres at infinity, a common normal, a pitch
/// point.
pub const CENTRES: [&str; 5] =
    ["crank-rocker", "shaper", "shaper-centres", "cam-centres", "five-bar-centres"];

/// Figures of curvature, inversions and cognates, by their names.
pub const CURVATURE: [(&str, &[&str]); 3] = [
    ("crank-rocker", &["curvature", "centrodes", "cognates"]),
    ("slider-crank", &["curvature", "inversions"]),
    ("shaper", &["curvature"]),
];

/// Constructions of synthesis: the first candidate of each kind that has one, and the linkage of
/// the kind without one.
pub const DESIGNS: [(&str, &str); 7] = [
    ("function", "construction"),
    ("body", "construction"),
    ("time-ratio", "construction"),
    ("limits", "construction"),
    ("path", "construction"),
    ("cognates", "construction"),
    ("straight-line", "construction"),
];

/// A cam with its two figures kept.
pub const CAM: &str = "cam-offset-roller";

/// Kinds of picture that no other list has: template, the figure's name (`dimensions`: the
/// mechanism with them).
pub const ASKED: [(&str, &str); 23] = [
    ("cam-offset-roller", "cam-instant"),
    ("cam-offset-roller", "replaced"),
    ("crank-rocker", "loops"),
    ("shaper", "extremes"),
    ("offset-slider-crank", "extremes"),
    ("crank-rocker", "transmission"),
    ("four-bar-forces", "lever"),
    ("shaper-forces", "forces"),
    ("engine-forces", "forces"),
    ("compressor-friction", "forces"),
    ("press-forces", "forces"),
    ("four-bar-forces", "forces"),
    ("class-iii-six-bar", "plates"),
    ("planetary-gear", "kutzbach"),
    ("planetary-gear", "gears"),
    ("turning-plate", "composite"),
    ("flat-face-mistake", "attempts"),
    ("flat-face-mistake", "composite"),
    ("slotted-lever", "derivation"),
    ("shaper", "coriolis"),
    ("slotted-lever", "coriolis-cases"),
    ("offset-slider-crank", "evolution"),
    ("crank-rocker", "dimensions"),
];

/// Pictures in the gallery in addition to the sheets: title, the command that draws it, the
/// picture.
pub const SHOWN: [(&str, &str, &str); 46] = [
    (
        "Forces with friction: circles and angles",
        "draw --figure forces",
        "compressor-friction/forces.en.png",
    ),
    (
        "Dimensions: to draw the mechanism again",
        "draw --dimensions",
        "crank-rocker/dimensions.en.png",
    ),
    (
        "Vectors, positions and the path of a point",
        "draw --vectors velocity --poses 6 --path S",
        "offset-slider-crank/overlay.png",
    ),
    ("The groups drawn apart", "draw --figure groups", "shaper/groups.png"),
    (
        "Extreme positions with swing, stroke and time ratio",
        "draw --figure extremes",
        "shaper/extremes.en.png",
    ),
    (
        "Transmission angles, with their formula",
        "draw --figure transmission",
        "crank-rocker/transmission.en.png",
    ),
    ("Equations with their tables", "draw --figure equations", "crank-rocker/equations.png"),
    (
        "Forces: free bodies, force polygons, equations",
        "draw --figure forces",
        "press-forces/forces.en.png",
    ),
    (
        "Zhukovsky's lever: the loads on the turned velocities",
        "draw --figure lever",
        "four-bar-forces/lever.en.png",
    ),
    ("One step of a construction", "draw --steps", "slotted-lever/step.png"),
    ("Plates: a polygon split by group", "draw --figure plates", "class-iii-six-bar/plates.en.png"),
    ("Insets", "draw", "class-iii-six-bar/inset.png"),
    (
        "Many positions to one set of scales",
        "draw --poses 12 --path E",
        "crank-rocker/poses.en.png",
    ),
    ("The path of a point with its hodographs", "path", "crank-rocker/path.en.png"),
    ("Line diagrams of a turn", "curves", "shaper/curves.en.png"),
    (
        "Polar diagrams: a bearing's force, the shaking force",
        "curves --find F_12,F_sh --polar",
        "engine-forces/polar.en.png",
    ),
    ("Instantaneous centres", "draw --figure centres", "crank-rocker/centres.en.png"),
    (
        "Curvature: inflection circle, centres of curvature",
        "draw --figure curvature",
        "crank-rocker/curvature.en.png",
    ),
    ("Centrodes", "draw --figure centrodes", "crank-rocker/centrodes.en.png"),
    ("Cognates", "draw --figure cognates", "crank-rocker/cognates.en.png"),
    ("Inversions", "draw --figure inversions", "slider-crank/inversions.en.png"),
    ("Gear trains: Kutzbach's plan", "draw --figure kutzbach", "planetary-gear/kutzbach.en.png"),
    ("Gears with their teeth", "draw --figure gears", "planetary-gear/gears.en.png"),
    ("The vector loop of the analytic method", "draw --figure loops", "crank-rocker/loops.en.png"),
    ("Composite motion of a point", "draw --figure composite", "turning-plate/composite.en.png"),
    (
        "The theorem of velocities, derived on a mechanism",
        "draw --figure derivation",
        "slotted-lever/derivation.en.png",
    ),
    ("The Coriolis acceleration at each slide", "draw --figure coriolis", "shaper/coriolis.en.png"),
    (
        "Is there a Coriolis acceleration: eight cases",
        "draw --figure coriolis-cases",
        "slotted-lever/coriolis-cases.en.png",
    ),
    (
        "The evolution of the four-bar",
        "draw --figure evolution",
        "offset-slider-crank/evolution.en.png",
    ),
    ("A pursuit with its course", "draw", "motions/pursuit-of-a-ship.en.png"),
    ("A plate that turns in space, in two views", "draw", "motions/plate-in-space.en.png"),
    ("A vector equation: two directions", "draw", "equations/two-directions.en.png"),
    (
        "A wrong solution over the right one",
        "draw --figure attempts",
        "flat-face-mistake/attempts.en.png",
    ),
    ("A cam: the motion of its follower", "draw --figure cam", "cam-offset-roller/motion.en.png"),
    (
        "A cam at the instant: pressure angle, lift, stroke, angles of the stages",
        "draw --figure cam-instant",
        "cam-offset-roller/cam-instant.en.png",
    ),
    (
        "A cam: the linkage of lower pairs in place of it",
        "draw --figure replaced",
        "cam-offset-roller/replaced.en.png",
    ),
    ("A cam: its profile by inversion", "draw --figure cam", "cam-offset-roller/profile.en.png"),
    ("Synthesis: function generation", "draw", "synthesis/function-construction.en.png"),
    ("Synthesis: positions of a body", "draw", "synthesis/body-construction.en.png"),
    ("Synthesis: time ratio", "draw", "synthesis/time-ratio-construction.en.png"),
    ("Synthesis: limit positions", "draw", "synthesis/limits-construction.en.png"),
    ("Synthesis: points of a path", "draw", "synthesis/path-construction.en.png"),
    ("Synthesis: cognates", "draw", "synthesis/cognates-construction.en.png"),
    ("Synthesis: a straight line", "draw", "synthesis/straight-line-construction.en.png"),
    ("The style for slides", "draw --style slides", "shaper/slides.png"),
    ("The style for a dark room", "draw --style dark", "jansen-leg/dark.png"),
];

/// A template with polar diagrams.
pub const POLAR: &str = "engine-forces";
/// Worksheets on mobility: a virtual constraint; a compound hinge and higher pairs.
pub const MOBILITY: [&str; 3] = ["third-crank", "planetary-gear", "three-planets"];
/// Vector equations: the figure and the text with its steps.
pub const EQUATIONS: [&str; 4] =
    ["closing-side", "two-magnitudes", "two-directions", "magnitude-and-direction"];
/// Motions without a mechanism.
pub const MOTIONS: [&str; 4] = ["pursuit", "pursuit-of-a-ship", "plate-in-space", "ring-in-space"];

pub const WORKSHEETS: [&str; 4] = ["crank-rocker", "shaper", "class-iii-six-bar", "pump-jack"];

/// Sheets whose Chinese letters are compared as pixels; elsewhere the words and their places
/// suffice.
const CHINESE: [&str; 2] = ["crank-rocker", "shaper"];

/// True if the pixels of a figure are compared: in English, and of the sheets of [`CHINESE`].
pub fn has_pixels(folder: &str, figure: &str, lang: &str) -> bool {
    lang == "en" || figure == "sheet" && CHINESE.contains(&folder)
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("golden")
}

/// Every golden file, as `template/file`.
pub fn kept() -> BTreeSet<String> {
    let mut all = BTreeSet::new();
    let mut in_both = |template: &str, files: &[&str]| {
        all.extend(LANGS.iter().flat_map(|(_, lang)| {
            files.iter().map(move |f| format!("{template}/{}", f.replace("LANG", lang)))
        }));
    };
    templates::list()
        .iter()
        .for_each(|t| in_both(t.name, &["plan.LANG.txt", "construction.LANG.txt"]));
    DRAFTED.iter().for_each(|t| in_both(t, &["drafting.LANG.txt"]));
    LESSONS.iter().for_each(|t| in_both(t, &["lesson.html.txt", "reveal.html.txt"]));
    KINDS.iter().for_each(|(t, kind, _)| in_both(t, &[&format!("{kind}.png")]));
    CENTRES.iter().for_each(|t| in_both(t, &["centres.LANG.txt"]));
    MOBILITY
        .iter()
        .for_each(|t| in_both(t, &["mobility.LANG.md", "mobility.LANG.typ", "mobility.LANG.html"]));
    EQUATIONS.iter().for_each(|t| in_both("equations", &[&format!("{t}.LANG.txt")]));
    WORKSHEETS.iter().for_each(|t| {
        in_both(t, &["worksheet.LANG.md", "worksheet.LANG.typ", "worksheet.LANG.html"])
    });
    for (folder, figure) in figures() {
        in_both(&folder, &[&format!("{figure}.LANG.svg.txt")]);
        let pixels = LANGS.iter().filter(|(_, lang)| has_pixels(&folder, &figure, lang));
        pixels.for_each(|(_, lang)| in_both(&folder, &[&format!("{figure}.{lang}.png")]));
    }
    all.extend(PLANS_AS_JSON.iter().map(|(t, lang)| format!("{t}/plan.{lang}.json")));
    all
}

/// Every figure that is compared in both languages: folder and name.
fn figures() -> Vec<(String, String)> {
    let mut all: Vec<(String, String)> =
        templates::list().iter().map(|t| (t.name.to_owned(), "sheet".to_owned())).collect();
    let mut add = |folder: &str, figure: &str| all.push((folder.to_owned(), figure.to_owned()));
    ASKED.iter().for_each(|(t, figure)| add(t, figure));
    CURVES.iter().for_each(|t| add(t, "curves"));
    add(POLAR, "polar");
    PATHS.iter().for_each(|(t, ..)| add(t, "path"));
    POSES.iter().for_each(|(t, ..)| add(t, "poses"));
    CENTRES.iter().for_each(|t| add(t, "centres"));
    for (t, figures) in CURVATURE {
        figures.iter().for_each(|f| add(t, f));
    }
    DESIGNS.iter().for_each(|(kind, figure)| add("synthesis", &format!("{kind}-{figure}")));
    ["motion", "profile"].iter().for_each(|f| add(CAM, f));
    MOTIONS.iter().for_each(|t| add("motions", t));
    EQUATIONS.iter().for_each(|t| add("equations", t));
    all
}

/// Returns the path of a golden file.
///
/// # Panics
/// If [`kept`] does not list it: it would count as an orphan.
pub fn golden(template: &str, file: &str) -> PathBuf {
    let name = format!("{template}/{file}");
    assert!(kept().contains(&name), "golden/{name} is in no list of tests/golden/files.rs");
    root().join(name)
}

pub fn accept() -> bool {
    std::env::var_os("HODOGRAPH_ACCEPT").is_some_and(|v| v == "1")
}

/// Writes the new file if accepting, and counts as a failure all the same: nothing is accepted
/// unseen, and a variable left set does not turn a failing run into a passing one.
fn write_if_accepting(path: &Path, now: &[u8], failures: &mut Vec<String>) -> bool {
    if accept() {
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, now).unwrap();
        failures.push(format!(
            "{}: accepted. Look at it (git diff --stat, git diff) and run without HODOGRAPH_ACCEPT: cargo test --test golden",
            path.display()
        ));
    }
    accept()
}

/// Compares a text with its file; reports the first line that differs.
pub fn check_text(path: &Path, now: &str, failures: &mut Vec<String>) {
    let was = std::fs::read_to_string(path).unwrap_or_default();
    if was == now || write_if_accepting(path, now.as_bytes(), failures) {
        return;
    }
    let line = was
        .lines()
        .zip(now.lines())
        .position(|(a, b)| a != b)
        .unwrap_or(was.lines().count().min(now.lines().count()));
    let at =
        |t: &str| t.lines().nth(line).unwrap_or("(nothing)").chars().take(160).collect::<String>();
    failures.push(format!(
        "{}:{}\n    expected: {}\n    actual:   {}\n    {HOW}",
        path.display(),
        line + 1,
        at(&was),
        at(now)
    ));
}

/// Width, height, kind and samples of a PNG.
pub fn pixels(bytes: &[u8]) -> Option<(u32, u32, png::ColorType, Vec<u8>)> {
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().ok()?;
    let mut buffer = vec![0; reader.output_buffer_size()?];
    let info = reader.next_frame(&mut buffer).ok()?;
    buffer.truncate(info.buffer_size());
    Some((info.width, info.height, info.color_type, buffer))
}

/// Compares a picture with its file, each sample within 1 of 255; leaves the actual picture and the
/// difference among the build's temporary files.
pub fn check_png(path: &Path, now: &[u8], failures: &mut Vec<String>) {
    let was = std::fs::read(path).unwrap_or_default();
    let fault = match (pixels(&was), pixels(now)) {
        (_, None) => panic!("{}: what was drawn is no PNG", path.display()),
        (None, _) => "there is no golden picture".to_owned(),
        (Some(a), Some(b)) if (a.0, a.1, a.2) != (b.0, b.1, b.2) => {
            format!("{}x{} expected, {}x{} drawn", a.0, a.1, b.0, b.1)
        }
        (Some(a), Some(b)) => {
            let off: Vec<u8> = a.3.iter().zip(&b.3).map(|(x, y)| x.abs_diff(*y)).collect();
            let bad = off.iter().filter(|d| **d > 1).count();
            if bad == 0 {
                return;
            }
            let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
            let part = |p: &Path| p.file_name().unwrap().to_string_lossy().into_owned();
            let name = format!("{}-{}", part(path.parent().unwrap()), part(path));
            let (actual, difference) =
                (folder.join(format!("actual-{name}")), folder.join(format!("difference-{name}")));
            std::fs::write(&actual, now).unwrap();
            let mut encoder =
                png::Encoder::new(std::fs::File::create(&difference).unwrap(), a.0, a.1);
            encoder.set_color(a.2);
            let ink: Vec<u8> = off.iter().map(|d| 255 - d.saturating_mul(4)).collect();
            encoder.write_header().unwrap().write_image_data(&ink).unwrap();
            format!(
                "{bad} values differ by more than 1\n    actual:     {}\n    difference: {}",
                actual.display(),
                difference.display()
            )
        }
    };
    if !write_if_accepting(path, now, failures) {
        failures.push(format!("{}: {fault}\n    {HOW}", path.display()));
    }
}

/// Ends a test that compared golden files.
pub fn finish(failures: &[String]) {
    assert!(
        failures.is_empty(),
        "{} golden files differ:\n{}",
        failures.len(),
        failures.join("\n")
    );
}

/// Every golden file is compared by some test.
#[test]
fn no_golden_file_is_an_orphan() {
    let mut found = BTreeSet::new();
    for folder in std::fs::read_dir(root()).unwrap() {
        let folder = folder.unwrap();
        let name = folder.file_name().into_string().unwrap();
        match std::fs::read_dir(folder.path()) {
            Ok(files) => found.extend(
                files.map(|f| format!("{name}/{}", f.unwrap().file_name().into_string().unwrap())),
            ),
            Err(_) => drop(found.insert(name)),
        }
    }
    let kept = kept();
    let orphans: Vec<String> = found.difference(&kept).map(|f| format!("golden/{f}")).collect();
    let missing: Vec<String> = kept.difference(&found).map(|f| format!("golden/{f}")).collect();
    assert!(
        orphans.is_empty(),
        "no test compares these; remove them: git rm {}",
        orphans.join(" ")
    );
    assert!(missing.is_empty(), "these are missing: {}\n{HOW}", missing.join(" "));
}
