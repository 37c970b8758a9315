//! The candidates of a synthesis as text and JSON: lengths, errors, defects, transmission angles,
//! and the chosen candidate with the reason.

use super::limits::grashof_words;
use hodograph_base::diag::{Both, Diagnostic};
use hodograph_base::digits::{legible, metres, minus, shortest};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::{say, tr};
use hodograph_mechanism::mechanism::{Demand, Mechanism};
use hodograph_mechanism::position::{self, Configuration, Path};
use hodograph_paper::paper::label::Label;
use hodograph_scene::{self as scene, Book, Guide, Kind, Lang, PointId, Scene};
use hodograph_sweep::station::position_now;
use hodograph_sweep::{self as sweep, PlacedScene, Stations, Width};
use hodograph_synthesis::candidate::{DesignNumber, scene_text};
use hodograph_synthesis::{Design, DesignCandidate, SynthesisBoard, Task, WantedPosition, judge};
use serde_json::{Value as Json, json};
use std::f64::consts::TAU;

/// Returns the table of candidates.
pub fn text(task: &Task, design: &Design, lang: Lang) -> String {
    let mut out = format!("{}\n", lang.of(&task.heading.title));
    for line in design
        .numbers
        .iter()
        .map(|n| format!("{} = {}", printed(&n.name), value(&task.book, n)))
        .collect::<Vec<_>>()
        .chunks(4)
    {
        out += &format!("{}\n", line.join("   "));
    }
    for (k, c) in design.candidates.iter().enumerate() {
        out += &format!("\n{}. {}\n", k + 1, lang.of(&c.draft.which));
        let numbers: Vec<String> = c
            .draft
            .numbers
            .iter()
            .map(|n| format!("{} = {}", printed(&n.name), value(&task.book, n)))
            .collect();
        for line in numbers.chunks(6) {
            out += &format!("   {}\n", line.join("   "));
        }
        out += &format!("   {}\n", motion(c, lang));
        for d in c.notes() {
            out += &match lang {
                Lang::En => format!("   {}: {}\n", d.code, d.message.en),
                Lang::Zh => format!("   {}（{}）\n", d.message.zh, d.code),
            };
        }
    }
    out + &format!("\n{}\n", taken(design, lang))
}

/// Returns the name of a number in text: Greek letters and signs in place of the words used in
/// JSON.
fn printed(name: &str) -> String {
    const NAMES: [(&str, &str); 15] = [
        ("alpha", "α"),
        ("beta", "β"),
        ("gamma", "γ"),
        ("theta", "θ"),
        ("psi", "ψ"),
        ("phi", "φ"),
        ("max_error", "Δφ_max"),
        ("x_max", "x(Δφ_max)"),
        ("error", "Δφ"),
        ("deviation", "Δ"),
        ("delta", "δ"),
        ("at_least", "φ(y_min)"),
        ("at_greatest", "φ(y_max)"),
        ("least", "y_min"),
        ("greatest", "y_max"),
    ];
    let (letters, index) = match name.find(|c: char| c.is_ascii_digit()) {
        Some(at) if at > 0 => name.split_at(at),
        Some(_) | None => (name, ""),
    };
    let said = |word: &str| NAMES.iter().find(|n| n.0 == word).map(|n| n.1);
    let (stem, joint) = letters.strip_suffix('_').map_or((letters, ""), |stem| (stem, "_"));
    if let Some(sign) = said(name) {
        return sign.to_owned();
    }
    // A word before an underscore: alpha_max.
    let first =
        stem.split_once('_').map(|(word, rest)| said(word).map(|sign| format!("{sign}_{rest}")));
    let stem = said(stem).map(str::to_owned).or(first.flatten()).unwrap_or_else(|| stem.to_owned());
    format!("{stem}{joint}{index}")
}

/// Returns the motion of the finished scene in one line.
pub fn motion(c: &DesignCandidate, lang: Lang) -> String {
    let j = &c.judged;
    let mut parts = Vec::new();
    parts.extend(j.grashof.map(|g| grashof_words(g, lang).to_owned()));
    parts.push(
        match j.rotates {
            true => tr!(lang, "the driver turns fully"),
            false => tr!(lang, "the driver swings"),
        }
        .to_owned(),
    );
    if let Some((angle, at)) = j.transmission {
        let (angle, at) = (legible(angle.to_degrees(), 5), legible(turn(at.to_degrees()), 5));
        parts.push(say!(lang, "least γ = {angle}° at {at}°"));
    }
    if let Some(k) = j.time_ratio {
        parts.push(format!("K = {}", legible(k, 6)));
    }
    if !c.draft.wanted.is_empty() {
        parts.push(lang.of(&judge::accuracy(c)).to_owned());
    }
    parts.join(" · ")
}

/// Returns a direction reduced to the range from 0 to 360°.
fn turn(degrees: f64) -> f64 {
    let turned = degrees.rem_euclid(360.0);
    if turned < 5e-4 || 360.0 - turned < 5e-4 { 0.0 } else { turned }
}

/// Returns a number of a design with its unit.
pub fn value(book: &Book, n: &DesignNumber) -> String {
    match n.kind {
        // Values with a unit requested by the file.
        Some(kind @ (Kind::Length | Kind::Angle)) if book.chosen(kind).is_some() => book.text(
            kind,
            &legible(book.value(kind, if n.value.abs() < 1e-12 { 0.0 } else { n.value }), 6),
        ),
        Some(Kind::Length) => metres_fine(n.value),
        Some(Kind::Angle) => format!(
            "{}°",
            legible(if n.value.abs() < 1e-12 { 0.0 } else { n.value.to_degrees() }, 6)
        ),
        // A count has no decimals.
        None if n.value.fract() == 0.0 && n.value.abs() < 1e15 => minus(&format!("{}", n.value)),
        Some(
            Kind::Velocity
            | Kind::Acceleration
            | Kind::Omega
            | Kind::Alpha
            | Kind::Force
            | Kind::Moment
            | Kind::Power
            | Kind::Time
            | Kind::Number,
        )
        | None => legible(n.value, 6),
    }
}

fn metres_fine(value_m: f64) -> String {
    if value_m.abs() >= 10.0 {
        minus(&metres(value_m))
    } else {
        format!("{} mm", legible(value_m * 1e3, 6))
    }
}

/// Returns the chosen candidate, and the reason.
pub fn taken(design: &Design, lang: Lang) -> String {
    let Some(first) = design.candidates.first() else { return String::new() };
    let j = &first.judged;
    let why = match (j.defects.is_empty(), j.rotates, design.candidates.len()) {
        (_, _, 1) => tr!(lang, "it is the only one"),
        (false, ..) => tr!(lang, "it has the fewest defects, but has some"),
        (true, true, _) => tr!(
            lang,
            "no defect, a crank that turns fully, the best transmission angle among those"
        ),
        (true, false, _) => tr!(lang, "no defect, the best transmission angle among those"),
    };
    say!(lang, "Taken: 1 ({why}).")
}

/// Returns the construction as JSON: steps, the marks that each adds (m), and the readings (mm of
/// paper, rad).
pub fn construction(board: &SynthesisBoard) -> Json {
    let marks = |marks: &[(String, Point)]| -> Vec<Json> {
        let told = |(name, p): &(String, Point)| json!({"name": Label::math(name.as_str()).plain(), "x": p.x * board.mu_l, "y": p.y * board.mu_l});
        marks.iter().map(told).collect()
    };
    let steps =
        board.steps.iter().map(|s| json!({"text": s.text.json(), "marks": marks(&s.marks)}));
    let readings =
        board.readings.iter().map(|r| json!({"name": r.name, "measured": r.measured, "angle": r.angle, "value": board.value(r)}));
    json!({"mu_l": board.mu_l, "steps": steps.collect::<Vec<_>>(), "readings": readings.collect::<Vec<_>>()})
}

/// Returns the candidates as JSON, in SI.
pub fn json(task: &Task, design: &Design) -> Json {
    json!({
        "synthesis": task.kind,
        "title": {"en": task.heading.title.en, "zh": task.heading.title.zh},
        "numbers": named(&design.numbers),
        "candidates": design.candidates.iter().map(candidate).collect::<Vec<_>>(),
        "notes": design.notes.iter().map(note).collect::<Vec<_>>(),
    })
}

fn named(numbers: &[DesignNumber]) -> Json {
    Json::Object(numbers.iter().map(|n| (n.name.clone(), json!(n.value))).collect())
}

fn candidate(c: &DesignCandidate) -> Json {
    let j = &c.judged;
    let positions: Vec<Json> = c
        .draft
        .wanted
        .iter()
        .map(|w| json!({"driver": w.driver, "points": w.places.iter().map(|(n, p)| (n.clone(), json!([p.x, p.y]))).collect::<serde_json::Map<_, _>>()}))
        .collect();
    json!({
        "which": c.draft.which.json(),
        "numbers": named(&c.draft.numbers),
        "wanted": positions,
        "deviation": c.draft.course.iter().map(|c| [c.x, c.deviation()]).collect::<Vec<_>>(),
        "course": c.draft.course.iter().map(|c| json!({"x": c.x, "input": c.input, "wanted": c.wanted, "output": c.real})).collect::<Vec<_>>(),
        "off": j.off_m,
        "size": j.size_m,
        "full_turn": j.rotates,
        "grashof": j.grashof.map(|g| grashof_words(g, Lang::En)),
        "transmission": j.transmission.map(|(angle, driver)| json!({"angle": angle, "driver": driver})),
        "time_ratio": j.time_ratio,
        "stroke": j.stroke,
        "defects": j.defects.iter().map(note).collect::<Vec<_>>(),
        "remarks": c.draft.remarks.iter().chain(&j.remarks).map(note).collect::<Vec<_>>(),
        "scene": c.draft.scene,
    })
}

fn note(d: &Diagnostic) -> Json {
    json!({"code": d.code, "severity": d.severity.word(), "message": d.message.json(), "help": d.help.as_ref().map(Both::json)})
}

/// A position of a linkage: each moving link with its points (m), and the fixed pivots.
pub struct LinkagePosition {
    /// Links by their index in the scene.
    pub links: Vec<(usize, Vec<(String, Point)>)>,
    /// Pivots on the ground.
    pub fixed: Vec<(String, Point)>,
    /// Blocks of sliders, in the order of the scene's guides.
    pub sliders: Vec<SliderBlock>,
}

/// A slider's block.
#[derive(Clone, Copy, Debug)]
pub struct SliderBlock {
    /// Position of its pin (m).
    pub at: Point,
    /// Direction of its guide, a unit vector.
    pub direction: Vec2,
    /// True if the guide is on the ground.
    pub fixed: bool,
}

/// Returns the linkage in all its prescribed positions, as computed by the general position solver.
pub fn positions(candidate: &DesignCandidate) -> Vec<LinkagePosition> {
    candidate.draft.wanted.iter().filter_map(|w| posed(&candidate.draft.scene, w)).collect()
}

fn posed(scene: &Json, wanted: &WantedPosition) -> Option<LinkagePosition> {
    let mut scene = scene.clone();
    let object = scene.as_object_mut()?;
    object.shift_remove("side");
    let rough: serde_json::Map<String, Json> = wanted
        .places
        .iter()
        .map(|(n, p)| (n.clone(), json!([format!("{} m", p.x), format!("{} m", p.y)])))
        .collect();
    object.insert("sketch".into(), Json::Object(rough));
    object.get_mut("driver")?["angle"] = json!(format!("{} rad", wanted.driver));
    let scene = scene::read(scene_text(&scene)).ok()?.value;
    let mechanism = Mechanism::new(&scene).ok()?.value;
    let demand = Demand::of(&scene, &mechanism).with_all_positions();
    let at = position::configure(&scene, &mechanism, &demand).ok()?.value;
    Some(pose_of(&scene, &at))
}

/// Returns the positions of all parts of a scene, for drawing. A lever that is known by its slot
/// extends to the block on it.
pub fn pose_of(scene: &Scene, at: &Configuration) -> LinkagePosition {
    let named = |p: &PointId| Some((scene.points[p.0].name.clone(), at.points[p.0]?));
    let of = |l: usize| (l, scene.links[l].points.iter().filter_map(named).collect::<Vec<_>>());
    let on =
        |l: usize| scene.guides.iter().filter(move |g| g.on.0 == l).filter_map(|g| named(&g.pin?));
    let links = (0..scene.links.len()).filter(|l| *l != scene.ground.0).map(|l| {
        let (l, mut points) = of(l);
        if points.len() < 2 {
            points.extend(on(l));
        }
        (l, points)
    });
    let block = |(g, path): (&Guide, &Option<Path>)| match path {
        Some(Path::Line { direction, .. }) => Some(SliderBlock {
            at: at.points[g.pin?.0]?,
            direction: *direction,
            fixed: g.on == scene.ground,
        }),
        Some(Path::Arc { .. }) | None => None,
    };
    let sliders = scene.guides.iter().zip(&at.guides).filter_map(block).collect();
    LinkagePosition {
        links: links.filter(|l| l.1.len() > 1).collect(),
        fixed: of(scene.ground.0).1,
        sliders,
    }
}

/// Returns the path of a point while the driver rotates, in pieces if the rotation is not complete;
/// empty if the linkage has no such point.
pub fn traced(candidate: &DesignCandidate, point: &str) -> Vec<Vec<Point>> {
    const STEPS: usize = 360;
    let path = || {
        let scene = scene::read_asking(candidate.scene_text(), &format!("x_{point}, y_{point}"))
            .ok()?
            .value;
        let mechanism = Mechanism::new(&scene).ok()?.value;
        let placed = PlacedScene::new(&scene, &mechanism).ok()?;
        let now = position_now(&scene, &placed.at, 0);
        let all = (0..=STEPS).map(|k| now + TAU * (k as f64 / STEPS as f64 - 0.5)).collect();
        let table = sweep::run(&placed, 0, &Stations::of_values(all, 1.0), Width::One).ok()?;
        let of = |axis: char| table.column(&format!("{axis}_{point}")).map(|c| c.values.clone());
        let places: Vec<Point> =
            of('x')?.into_iter().zip(of('y')?).map(|(x, y)| Point::new(x, y)).collect();
        // Positions that cannot be assembled divide the path.
        let mut pieces: Vec<Vec<Point>> = Vec::new();
        let mut last = f64::NEG_INFINITY;
        for (driver, at) in table.columns[0].values.iter().zip(places) {
            if driver - last > 1.5 * TAU / STEPS as f64 {
                pieces.push(Vec::new());
            }
            last = *driver;
            pieces.last_mut()?.push(at);
        }
        Some(pieces)
    };
    path().unwrap_or_default()
}

/// Returns the construction step by step, with the readings.
pub fn steps(candidate: &DesignCandidate, board: &SynthesisBoard, lang: Lang) -> String {
    let mut out = say!(lang, "\nConstruction (μ_l = {} m/mm)\n", shortest(board.mu_l));
    for (k, step) in board.steps.iter().enumerate() {
        let at = |p: Point| {
            [p.x, p.y]
                .map(|x| {
                    legible(
                        if (x * board.mu_l).abs() < 1e-12 { 0.0 } else { x * board.mu_l * 1e3 },
                        6,
                    )
                })
                .join(", ")
        };
        let marks = step
            .marks
            .iter()
            .map(|(name, p)| format!("{} ({})", Label::math(name.as_str()).plain(), at(*p)));
        let marks = marks.collect::<Vec<_>>().join(tr!(lang, "clause" => ", "));
        let marks = match (marks.is_empty(), lang) {
            (true, _) => String::new(),
            (false, Lang::En) => format!(" [{marks} mm]"),
            (false, Lang::Zh) => format!("［{marks} mm］"),
        };
        out += &format!("({}) {}{marks}\n", k + 1, lang.of(&step.text));
    }
    for r in &board.readings {
        let Some(formula) = candidate.number(&r.name) else { continue };
        // The error of a value of zero is relative to the size of the linkage.
        let scale = if formula != 0.0 { formula.abs() } else { candidate.judged.size_m };
        let off = legible((board.value(r) - formula.abs()).abs() / scale, 2);
        let formula = if r.angle {
            format!("{}°", legible(formula.abs().to_degrees(), 6))
        } else {
            metres_fine(formula)
        };
        let drawn = match r.angle {
            true => format!("{}°", legible(board.value(r).to_degrees(), 6)),
            false => {
                format!("{} mm · μ_l = {}", legible(r.measured, 4), metres_fine(board.value(r)))
            }
        };
        let name = printed(&r.name);
        out += &say!(lang, "{name} = {drawn}; formula {formula}, off by {off}\n");
    }
    out
}

/// Returns the table of wanted and actual angles of a function as comma-separated values, in
/// degrees; `None` if the design is for no function.
pub fn course_csv(c: &DesignCandidate) -> Option<String> {
    if c.draft.course.is_empty() {
        return None;
    }
    let mut out =
        "x,alpha0+alpha [°],phi0+phi wanted [°],phi0+phi real [°],deviation [°]\n".to_owned();
    for row in &c.draft.course {
        let angles = [row.input, row.wanted, row.real, row.deviation()];
        let angles = angles.map(|a| shortest(a.to_degrees()));
        out += &format!("{},{}\n", shortest(row.x), angles.join(","));
    }
    Some(out)
}
