//! The extreme positions of the outputs on one drawing of the mechanism: the angle θ between the
//! cranks, the swing ψ or the stroke H, and the time ratio K with its numbers below.
//!
//! Outputs with the same extreme positions share a page.

use hodograph_base::diag::{Both, Diagnostic, Faults, Warned, both};
use hodograph_base::digits::shortest;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::{each, tr};
use hodograph_board::plan::names::name_label;
use hodograph_mechanism::position::Configuration;
use hodograph_paper::paper::drawing::DrawingPart;
use hodograph_paper::paper::grid::{self, Cell, Row};
use hodograph_paper::paper::item::Anchor;
use hodograph_paper::paper::label::Label;
use hodograph_report::amount::number;
use hodograph_report::limits::output_words;
use hodograph_scene::{Book, DiagramKind, Kind, Lang, LinkId, PointId, Scene};
use hodograph_sweep::extreme::{self, DrivenOutput, MotionLimits, OutputExtreme, Swing};
use hodograph_worked::worked::{Worked, work_motion};
use std::f64::consts::{PI, TAU};

use super::arrange::{Tree, put_together};
use super::list::{FigureEntry, FigureInput, Pages};
use super::mechanism::{MarkedAngle, MarkedLength, PositionMarks, positions};
use super::placed::{PlacedMechanism, at_travels, placed};
use super::sheet::{SheetDrafter, SheetOptions, swept_symbol};

/// The extreme positions.
pub const ENTRY: FigureEntry = FigureEntry {
    name: "extremes",
    about: each!("Both extreme positions: swing, stroke, angle of the cranks, time ratio"),
    draw,
};

/// Digits of the numbers, the same as in a line diagram.
pub(super) const DIGITS: usize = 4;
/// Travels of the driver within this angle (rad or m) are one position.
const SAME: f64 = 1e-6;
/// Smallest length of an arc, and its radius: as a part of its side, and at least.
const ARC_MM: f64 = 6.0;
const PART: f64 = 0.45;
const RADIUS_MM: f64 = 10.0;
/// Length of a side beyond its arc.
const BEYOND_MM: f64 = 3.0;
/// Line spacing of the numbers.
const ROW_MM: f64 = 6.4;

/// The lowest and the highest position of an output, in the order of the driver's travel.
struct OutputEnds<'a> {
    swing: &'a Swing,
    ends: [&'a OutputExtreme; 2],
}

impl OutputEnds<'_> {
    fn of(swing: &Swing) -> Option<OutputEnds<'_>> {
        swing.stroke.filter(|stroke| *stroke > 0.0)?;
        let by = |a: &&OutputExtreme, b: &&OutputExtreme| a.output.total_cmp(&b.output);
        let mut ends = [swing.extremes.iter().min_by(by)?, swing.extremes.iter().max_by(by)?];
        ends.sort_by(|a, b| a.driver.total_cmp(&b.driver));
        Some(OutputEnds { swing, ends })
    }

    fn same_place(&self, other: &OutputEnds) -> bool {
        self.ends.iter().zip(other.ends).all(|(a, b)| (a.driver - b.driver).abs() < SAME)
    }

    fn dwells(&self) -> bool {
        self.ends.iter().any(|e| e.until.is_some())
    }
}

fn draw(w: &FigureInput) -> Result<Warned<Pages>, Faults> {
    let of_motion = work_motion(w.scene)?;
    let (scene, worked) =
        of_motion.as_ref().map_or((w.scene, w.worked), |(scene, worked)| (scene, worked));
    let limits = extreme::limits(scene, &worked.mechanism, 0)?;
    let mut groups: Vec<Vec<OutputEnds>> = Vec::new();
    for output in limits.swings.iter().filter_map(OutputEnds::of) {
        match groups.iter_mut().find(|g| g[0].same_place(&output)) {
            Some(group) => group.push(output),
            None => groups.push(vec![output]),
        }
    }
    if groups.is_empty() {
        return Err(none(scene, &limits).into());
    }
    let mut pages = Pages::new();
    for (k, group) in groups.iter().enumerate() {
        let number = if groups.len() > 1 { format!("-{}", k + 1) } else { String::new() };
        let page = page(w, (scene, worked), &limits, group)?;
        pages.push((format!("{}{number}", ENTRY.name), page));
    }
    Ok(Warned { value: pages, notes: Vec::new() })
}

/// Returns the reason for which no output has two extreme positions.
fn none(scene: &Scene, limits: &MotionLimits) -> Diagnostic {
    let said = |lang: Lang| -> Vec<String> {
        let words = output_words(scene, 0, limits, lang);
        let of = |(swing, words): (&Swing, String)| match swing.output {
            // An output without extremes turns fully if its driver does.
            DrivenOutput::Turning(l) if limits.range.full() && swing.extremes.is_empty() => {
                let name = scene.link_name(l);
                let Both { en, zh } = both!("link {name} turns fully");
                if lang == Lang::Zh { zh } else { en }
            }
            DrivenOutput::Turning(_) | DrivenOutput::Sliding(_) => words,
        };
        limits.swings.iter().zip(words).map(of).collect()
    };
    let message = if limits.swings.is_empty() {
        both!(
            "besides the driver no link turns about a pin of the ground and nothing slides on it: no output has extreme positions"
        )
    } else {
        let reasons = Both { en: said(Lang::En).join("; "), zh: said(Lang::Zh).join("；") };
        both!("no output has two extreme positions: {}", reasons)
    };
    Diagnostic::error("no-extremes", message)
        .help(both!("see `limits` for the range of the driver and the outputs"))
}

fn page(
    w: &FigureInput,
    of: (&Scene, &Worked),
    limits: &MotionLimits,
    group: &[OutputEnds],
) -> Result<hodograph_paper::paper::item::Figure, Faults> {
    let travels = group[0].ends.map(|e| e.driver - limits.range.now);
    let mut at = at_travels(of.0, of.1, &travels);
    at.truncate(2);
    let others = at.into_iter().zip(["1".to_owned(), "2".to_owned()]).collect();
    let PlacedMechanism { scene, worked, course, others } = placed(w, of, others)?;
    let (scene, worked) = (&scene, &worked);
    let mut marks = PositionMarks { light: true, ..PositionMarks::default() };
    let ends = [0, 1].map(|k| others.get(k).map(|o| &o.worked.configuration));
    if let [Some(one), Some(two)] = ends {
        let ends = [one, two];
        for output in group {
            mark_output(&mut marks, scene, worked, output, ends, group.len() > 1);
        }
        marks.angles.extend(between_cranks(scene, worked, &group[0], ends));
    }
    marks.poses = others;
    let options = w.options;
    let maker = SheetDrafter { scene, worked, options, certified: Vec::new() };
    let (style, notation) = (&options.style, &options.notation);
    let part = positions(style, (scene, worked), notation, &course, &marks);
    let words = tr!(options.lang, "Extreme positions");
    let mu = maker.caption(DiagramKind::Plane).1;
    let titled = maker.titled(part, Label::text(words), &mu, ENTRY.name);
    let rows = numbers(scene, limits, group, options.lang);
    Ok(maker.alone(with_rows(options, titled, rows)))
}

/// Returns a drawing with lines of numbers below.
pub(super) fn with_rows(
    options: &SheetOptions,
    part: DrawingPart,
    rows: Vec<Label>,
) -> DrawingPart {
    let style = &options.style;
    let row = |(k, label): (usize, Label)| Row {
        cells: vec![Some(Cell {
            label: label.in_fonts(&style.fonts),
            size_mm: style.small_mm,
            anchor: Anchor::Start,
            class: "numbers".into(),
            id: format!("numbers-{}", k + 1),
        })],
        height_mm: ROW_MM,
    };
    let rows: Vec<Row> = rows.into_iter().enumerate().map(row).collect();
    let below = DrawingPart::of(grid::set(&rows, 0.0));
    put_together(Tree::column(vec![Tree::Leaf(0), Tree::Leaf(1)]), vec![part, below])
}

/// Returns a value in the fine unit of its kind, in the label language.
pub(super) fn amount(book: &Book, kind: Kind, si: f64) -> String {
    let (unit, factor) = book.fine(kind);
    let gap = if unit.contains("degree") { "" } else { "\\," };
    format!("{}{gap}{unit}", number(si * factor, DIGITS))
}

/// Returns the symbol of an output's travel: ψ or H, with its name if there are several.
fn travel_symbol(scene: &Scene, output: DrivenOutput, named: bool) -> String {
    let (letter, name) = match output {
        DrivenOutput::Turning(l) => ("\\psi", scene.link_name(l)),
        DrivenOutput::Sliding(g) => ("H", runner(scene, g)),
    };
    if named { format!("{letter}_{{{}}}", name_label(name)) } else { letter.to_owned() }
}

fn runner(scene: &Scene, g: hodograph_scene::GuideId) -> &str {
    let guide = &scene.guides[g.0];
    let pin = guide.pin.map(|p| scene.point_name(p));
    pin.or(guide.slider.map(|l| scene.link_name(l))).unwrap_or_default()
}

/// Returns the points of a link that move, with the pivot of the link on the ground.
fn arms(scene: &Scene, link: LinkId) -> Option<(PointId, Vec<PointId>)> {
    let ground = &scene.links[scene.ground.0].points;
    let own = &scene.links[link.0].points;
    let pivot = *own.iter().find(|p| ground.contains(p))?;
    Some((pivot, own.iter().copied().filter(|p| !ground.contains(p)).collect()))
}

/// Returns the pivot (m) of a link and the vectors (m) from it to the link's farthest point in both
/// positions.
fn arm(scene: &Scene, link: LinkId, ends: [&Configuration; 2]) -> Option<(Point, [Vec2; 2])> {
    let (pivot, points) = arms(scene, link)?;
    let to = |at: &Configuration, p: PointId| Some(at.points[p.0]? - at.points[pivot.0]?);
    let far = |p: &PointId| to(ends[0], *p).map_or(0.0, Vec2::norm);
    let tip = points.into_iter().max_by(|a, b| far(a).total_cmp(&far(b)))?;
    Some((ends[0].points[pivot.0]?, [to(ends[0], tip)?, to(ends[1], tip)?]))
}

/// Returns the radius of an arc of an angle (rad) whose sides are this long.
fn radius_mm(side_mm: f64, angle: f64) -> f64 {
    let arc = ARC_MM / angle.abs().max(1e-3);
    (PART * side_mm).max(arc.min(0.9 * side_mm)).max(RADIUS_MM)
}

fn mark_output(
    marks: &mut PositionMarks,
    scene: &Scene,
    worked: &Worked,
    output: &OutputEnds,
    ends: [&Configuration; 2],
    named: bool,
) {
    let Some(stroke) = output.swing.stroke else { return };
    let symbol = travel_symbol(scene, output.swing.output, named);
    match output.swing.output {
        DrivenOutput::Turning(l) => {
            let turn = output.ends[1].output - output.ends[0].output;
            let label = format!("{symbol} = {}", amount(&scene.book, Kind::Angle, stroke));
            let mu = worked.construction.diagram.mu;
            let key = format!("swing-{}", scene.link_name(l));
            if let Some((centre, [from, _])) = arm(scene, l, ends) {
                let radius_mm = radius_mm(from.norm() / mu, turn);
                let sides = [from.angle(), from.angle() + turn];
                // The face of a cam's follower is not a bar.
                let faced = scene.cams.iter().any(|c| c.follower == l);
                let lines_mm = [if faced { radius_mm + BEYOND_MM } else { 0.0 }; 2];
                marks.angles.push(MarkedAngle { key, label, centre, sides, radius_mm, lines_mm });
            } else if let Some(centre) =
                arms(scene, l).and_then(|(pivot, _)| ends[0].points[pivot.0])
            {
                let radius_mm = 2.0 * RADIUS_MM;
                let (sides, lines_mm) = (output.ends.map(|e| e.output), [radius_mm + BEYOND_MM; 2]);
                marks.angles.push(MarkedAngle { key, label, centre, sides, radius_mm, lines_mm });
            }
        }
        DrivenOutput::Sliding(g) => {
            let guide = &scene.guides[g.0];
            let own = || scene.links[guide.slider?.0].points.first().copied();
            let Some(pin) = guide.pin.or_else(own) else { return };
            if let [Some(from), Some(to)] = ends.map(|at| at.points[pin.0]) {
                marks.lengths.push(MarkedLength {
                    key: format!("stroke-{}", scene.point_name(pin)),
                    label: format!("{symbol} = {}", amount(&scene.book, Kind::Length, stroke)),
                    places: [from, to],
                });
            }
        }
    }
}

/// Returns the acute angle between the crank in one extreme position and its extension in the
/// other, on the side of the output; `None` without a crank or without a time ratio.
fn between_cranks(
    scene: &Scene,
    worked: &Worked,
    output: &OutputEnds,
    ends: [&Configuration; 2],
) -> Option<MarkedAngle> {
    let (crank, against) = scene.drivers[0].kind.turned()?;
    output.swing.time_ratio?;
    let theta = theta(output)?;
    if against != scene.ground || theta < SAME {
        return None;
    }
    let (centre, [one, two]) = arm(scene, crank, ends)?;
    // Both pairs of opposite angles are equal; the output's side is marked.
    let towards = side_of(scene, output.swing.output, ends, centre);
    let [first, second] = [[-one, two], [one, -two]].map(|sides| {
        let [a, b] = sides.map(|v| v.unit().unwrap_or(v));
        (sides, (a + b).dot(towards))
    });
    let ([from, to], _) = if second.1 > first.1 { second } else { first };
    let turn = libm::atan2(from.cross(to), from.dot(to));
    let mu = worked.construction.diagram.mu;
    let radius_mm = radius_mm(one.norm() / mu, theta).max(ARC_MM / theta).min(60.0);
    Some(MarkedAngle {
        key: "theta".into(),
        label: format!("\\theta = {}", amount(&scene.book, Kind::Angle, theta)),
        centre,
        sides: [from.angle(), from.angle() + turn],
        radius_mm,
        lines_mm: [radius_mm + BEYOND_MM; 2],
    })
}

/// Returns the direction from a place to an output in its extreme positions.
fn side_of(scene: &Scene, output: DrivenOutput, ends: [&Configuration; 2], from: Point) -> Vec2 {
    let points = match output {
        DrivenOutput::Turning(l) => arms(scene, l).map(|(_, moving)| moving).unwrap_or_default(),
        DrivenOutput::Sliding(g) => scene.guides[g.0].pin.into_iter().collect(),
    };
    let places = ends.iter().flat_map(|at| points.iter().filter_map(|p| at.points[p.0]));
    places.map(|p| p - from).fold(Vec2::new(0.0, 0.0), |sum, v| sum + v)
}

/// Returns the angle by which the crank's two strokes differ from half a turn; `None` with a dwell,
/// at which the crank has no one position.
fn theta(output: &OutputEnds) -> Option<f64> {
    let [one, two] = output.ends;
    (!output.dwells()).then(|| ((two.driver - one.driver).rem_euclid(TAU) - PI).abs())
}

/// Returns the crank's angles of the slower and of the faster stroke.
fn strokes(output: &OutputEnds) -> [f64; 2] {
    let [one, two] = output.ends;
    let way = |from: &OutputExtreme, to: &OutputExtreme| {
        (to.driver - from.until.unwrap_or(from.driver)).rem_euclid(TAU)
    };
    let [out, back] = [way(one, two), way(two, one)];
    [out.max(back), out.min(back)]
}

fn numbers(scene: &Scene, limits: &MotionLimits, group: &[OutputEnds], lang: Lang) -> Vec<Label> {
    let book = &scene.book;
    let (driver, kind) = swept_symbol(scene, 0);
    let wrapped = |value: f64| {
        let turning = kind == Kind::Angle && limits.range.full();
        let value = if turning { value.rem_euclid(TAU * limits.seen as f64) } else { value };
        if turning && TAU * limits.seen as f64 - value < 1e-9 { 0.0 } else { value }
    };
    let mut rows = Vec::new();
    for output in group {
        let (symbol, of) = match output.swing.output {
            DrivenOutput::Turning(l) => {
                (format!("\\varphi_{{{}}}", name_label(scene.link_name(l))), Kind::Angle)
            }
            DrivenOutput::Sliding(g) => {
                (format!("s_{{{}}}", name_label(runner(scene, g))), Kind::Length)
            }
        };
        let each = output.ends.iter().enumerate().map(|(k, e)| {
            format!(
                "\\text{{({})}}\\ {driver} = {},\\ {symbol} = {}",
                k + 1,
                amount(book, kind, wrapped(e.driver)),
                amount(book, of, e.output)
            )
        });
        rows.push(Label::math(each.collect::<Vec<_>>().join("\\quad ")));
        let stroke = output.swing.stroke.unwrap_or(f64::NAN);
        rows.push(Label::math(format!(
            "{} = {}",
            travel_symbol(scene, output.swing.output, group.len() > 1),
            amount(book, of, stroke)
        )));
    }
    let timed = group[0].swing.time_ratio.and(theta(&group[0]));
    rows.extend(
        timed.map(|theta| Label::math(format!("\\theta = {}", amount(book, Kind::Angle, theta)))),
    );
    rows.extend(ratio(scene, &group[0], lang));
    rows
}

/// Returns the time ratio with its formula and numbers, if the output has one.
fn ratio(scene: &Scene, output: &OutputEnds, lang: Lang) -> Option<Label> {
    let k = number(output.swing.time_ratio?, DIGITS);
    let angle = |a: f64| amount(&scene.book, Kind::Angle, a);
    let [slow, fast] = strokes(output).map(angle);
    let half = scene.book.label(Kind::Angle, &shortest(scene.book.value(Kind::Angle, PI)));
    Some(match theta(output) {
        Some(_) => {
            Label::math(format!("K = ({half} + \\theta)/({half} − \\theta) = {slow}/{fast} = {k}"))
        }
        None => Label::math(format!(
            "K = {slow}/{fast} = {k}\\text{{{}}}",
            tr!(lang, " (the cam's angles of both strokes, without dwells)")
        )),
    })
}
