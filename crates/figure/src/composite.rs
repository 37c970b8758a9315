//! Draws the composite motion of a point. For each moving point and frame there is one column: v_a
//! = v_e + v_r at the point on the mechanism, as a parallelogram with the diagonal v_a; the
//! components of the acceleration at the point; their polygon; and the projections in words.
//! Several solutions of one problem are side by side, to one μ.

use hodograph_base::diag::{Both, Faults, Warned};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::each;
use hodograph_board::construct::scale;
use hodograph_methods::composite::{ChoiceSolution, ContactScene, level, name_of};
use hodograph_report::composite::{CompositeStep, CompositeWords, symbol};
use hodograph_scene::quantity::composite::CompositePart as Piece;
use hodograph_scene::quantity::{Frame, RelativePath};
use hodograph_scene::{DiagramKind, GuidePath, Kind, Lang, Scene};
use hodograph_worked::worked::Worked;

use super::arrange::{AIM_MM, caption_y};
use super::list::{FigureEntry, FigureInput, Pages, page};
use super::mechanism::{self, Composed, ComposedVector};
use super::particle::ParticleView;
use super::relative::track_on;
use super::sheet::{MARGIN_MM, SheetDrafter};
use super::stepped::SteppedMethod;
use crate::scales::DrawingScales;
use hodograph_paper::paper::drawing::{Drawing, DrawingPart};
use hodograph_paper::paper::extent::Rect;
use hodograph_paper::paper::grid::{self, Cell, Row};
use hodograph_paper::paper::item::{Anchor, Figure, FigureItem, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::phrase::Phrase;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_paper::paper::shown::{ShownLength, ShownQuantity};
use hodograph_paper::paper::style::Captioned;

/// The parallelograms and the components of the accelerations.
pub const ENTRY: FigureEntry = FigureEntry {
    name: "composite",
    about: each!("Composite motion of a point: its parallelogram and its parts"),
    draw,
};

/// Maximum number of columns if the scene names no moving point.
const MOST: usize = 1;
/// Space for the longest vector.
const VECTOR_MM: f64 = 60.0;
/// Gap between drawings.
const GAP_MM: f64 = 10.0;
/// Values per line below a drawing.
const PER_LINE: usize = 2;
/// Line spacing of the text.
const ROW_MM: f64 = 5.6;
/// The smallest comfortable type size on the printed page.
const TYPE_MM: f64 = 2.3;
/// Minimum length of a vector that is drawn.
const SHORTEST_MM: f64 = mechanism::SHORTEST_MM;

fn draw(w: &FigureInput) -> Result<Warned<Pages>, Faults> {
    let staged = ContactScene::new(w.scene);
    let choices = staged.shown(w.scene, MOST);
    if choices.is_empty() {
        return page(ENTRY.name, None);
    }
    let solved = staged.solved_with_second(w.scene, &choices, level(w.scene))?;
    let (worked, each) = solved.value;
    let staged = FigureInput { scene: &staged.scene, ..*w };
    page(ENTRY.name, (!each.is_empty()).then(|| figure(&staged, &worked, &each)))
}

/// The scales of all columns (SI units per mm).
struct CompositeScales {
    velocity: f64,
    acceleration: Option<f64>,
}

impl CompositeScales {
    fn of(w: &FigureInput, each: &[ChoiceSolution]) -> CompositeScales {
        let one = |kind: Kind, all: Vec<Vec2>| {
            let most =
                all.iter().fold([0.0_f64; 2], |[x, y], v| [x.max(v.x.abs()), y.max(v.y.abs())]);
            scale::choose_in(w.scene.paper.unit(kind), most, [VECTOR_MM, VECTOR_MM])
        };
        let velocities = each.iter().flat_map(|s| s.velocity).collect();
        let accelerations: Vec<Vec2> =
            each.iter().flat_map(|s| s.acceleration.iter().map(|a| a.1)).collect();
        let any = !accelerations.is_empty();
        CompositeScales {
            velocity: one(Kind::Velocity, velocities),
            acceleration: any.then(|| one(Kind::Acceleration, accelerations)),
        }
    }
}

/// The composite motion of the first choice step by step: the velocities at the moving point, the
/// accelerations there, and their polygon. If only two frames determine the motion, those of the
/// second follow, and the projections of both.
///
/// # Errors
/// The faults of the scene.
pub(super) fn stepped(w: &FigureInput) -> Result<Option<SteppedMethod>, Faults> {
    let staged = ContactScene::new(w.scene);
    let choices: Vec<_> = staged.shown(w.scene, MOST).into_iter().take(MOST).collect();
    if choices.is_empty() {
        return Ok(None);
    }
    let (worked, each) = staged.solved_with_second(w.scene, &choices, level(w.scene))?.value;
    if each.is_empty() {
        return Ok(None);
    }
    let w = FigureInput { scene: &staged.scene, ..*w };
    let scales = CompositeScales::of(&w, &each);
    let words = |lang| CompositeWords { scene: w.scene, lang, notation: &w.options.notation };
    let [en, zh] = [Lang::En, Lang::Zh].map(words);
    let mut out = SteppedMethod::default();
    for s in &each {
        let first = out.steps.len();
        let steps = en.steps(s);
        out.views.extend(step_views(&w, &worked, &scales, s, &steps, first));
        let both = steps.iter().zip(zh.steps(s));
        out.steps.extend(both.map(|(en, zh)| Both { en: en.text.source(), zh: zh.text.source() }));
    }
    let both = en.equated(&each).into_iter().zip(zh.equated(&each));
    out.steps.extend(both.map(|(en, zh)| Both { en: en.source(), zh: zh.source() }));
    Ok(Some(out))
}

/// Draws the views of a choice, whose steps have numbers from `first`.
fn step_views(
    w: &FigureInput,
    worked: &Worked,
    scales: &CompositeScales,
    s: &ChoiceSolution,
    steps: &[CompositeStep],
    first: usize,
) -> Vec<ParticleView> {
    let placed = |on: DiagramKind, mu: f64| {
        let mut all = vectors(w, s, on, mu);
        let parts = s.acceleration.iter().map(|a| a.0);
        let parts: Vec<Option<Piece>> = match on {
            DiagramKind::Velocity => {
                vec![None, Some(Piece::TransportVelocity), Some(Piece::RelativeVelocity)]
            }
            DiagramKind::Plane | DiagramKind::Acceleration | DiagramKind::Force => parts.collect(),
        };
        for (v, part) in all.iter_mut().zip(parts) {
            let step = steps.iter().position(|step| step.on == on && step.draws.contains(&part));
            v.step = step.map(|k| first + k);
        }
        // What is laid off first begins at the pole.
        all.sort_by_key(|v| v.step);
        all
    };
    let view = |part, on: DiagramKind, mu: f64, [en, zh]: [&str; 2]| ParticleView {
        part,
        caption: Both { en: en.to_owned(), zh: zh.to_owned() },
        scales: vec![(on, mu)],
    };
    let at_point = |on, mu, parallelogram| {
        let composed = Composed {
            at: Some(s.choice.of.point),
            numbered: false,
            vectors: placed(on, mu),
            parallelogram,
            track: if parallelogram { track(w, s) } else { Vec::new() },
        };
        let (style, notation) = (&w.options.style, &w.options.notation);
        mechanism::composed(style, w.scene, worked, notation, &composed)
    };
    let mut views = vec![view(
        at_point(DiagramKind::Velocity, scales.velocity, true),
        DiagramKind::Velocity,
        scales.velocity,
        each!("Velocities at the moving point"),
    )];
    if let Some(mu) = scales.acceleration {
        let words = [Lang::En, Lang::Zh]
            .map(|lang| hodograph_paper::paper::words::words(lang).composite_acceleration);
        let on = DiagramKind::Acceleration;
        views.push(view(at_point(on, mu, false), on, mu, words));
        views.push(view(edges(w, &placed(on, mu)), on, mu, each!("Acceleration polygon")));
    }
    views
}

/// The moving points and frames that a scene names, with their motions and a drawing of each, all to
/// one μ.
pub struct NamedSolutions {
    /// The scene with the points of contact of its cams.
    pub staged: ContactScene,
    /// The motions.
    pub each: Vec<ChoiceSolution>,
    /// Their drawings, without the equations.
    pub figures: Vec<Figure>,
}

/// Solves and draws the choices that a scene names; `None` if it names none.
///
/// # Errors
/// The faults of the scene.
pub fn named_solutions(w: &FigureInput) -> Result<Option<NamedSolutions>, Faults> {
    let staged = ContactScene::new(w.scene);
    let choices = staged.shown(w.scene, 0);
    if choices.is_empty() {
        return Ok(None);
    }
    let (worked, each) = staged.solved_with_second(w.scene, &choices, level(w.scene))?.value;
    let w = FigureInput { scene: &staged.scene, ..*w };
    let maker =
        SheetDrafter { scene: w.scene, worked: &worked, options: w.options, certified: Vec::new() };
    let scales = CompositeScales::of(&w, &each);
    let words =
        CompositeWords { scene: w.scene, lang: w.options.lang, notation: &w.options.notation };
    let page = |(k, s): (usize, &ChoiceSolution)| {
        let heading = words.heading(&s.choice);
        let mut parts = drawings(&w, &maker, &scales, s, heading.label(), k);
        let column: Vec<usize> = (0..parts.len()).collect();
        arrange(&mut parts, &[column], w.options.style.small_mm);
        let mut figure =
            maker.alone(DrawingPart::of(parts.into_iter().flat_map(|p| p.items).collect()));
        figure.desc = heading.plain();
        figure
    };
    let figures = each.iter().enumerate().map(page).collect();
    Ok(Some(NamedSolutions { staged, each, figures }))
}

/// Draws a choice: the velocities and accelerations at the moving point, and the polygon.
fn drawings(
    w: &FigureInput,
    maker: &SheetDrafter,
    scales: &CompositeScales,
    s: &ChoiceSolution,
    heading: Label,
    k: usize,
) -> Vec<DrawingPart> {
    let mut parts = vec![velocities(w, maker, scales, s, heading, k)];
    if let Some(mu) = scales.acceleration {
        parts.push(accelerations(w, maker, mu, s, k));
        parts.push(polygon(w, maker, mu, s, k));
    }
    parts
}

fn figure(w: &FigureInput, worked: &Worked, each: &[ChoiceSolution]) -> Figure {
    let maker = SheetDrafter { scene: w.scene, worked, options: w.options, certified: Vec::new() };
    let scales = CompositeScales::of(w, each);
    let words =
        CompositeWords { scene: w.scene, lang: w.options.lang, notation: &w.options.notation };
    let both = words.equated(each);
    let mut parts: Vec<DrawingPart> = Vec::new();
    let mut columns: Vec<Vec<usize>> = Vec::new();
    for (k, s) in each.iter().enumerate() {
        let letter = if each.len() > 1 { format!("({}) ", k + 1) } else { String::new() };
        let heading = Label::text(letter).then(words.heading(&s.choice).label());
        let first = parts.len();
        parts.extend(drawings(w, &maker, &scales, s, heading, k));
        let mut lines = words.body(s, PER_LINE);
        if k + 1 == each.len() {
            lines.extend(both.iter().cloned());
        }
        parts.push(text(w, lines, k));
        columns.push((first..parts.len()).collect());
    }
    arrange(&mut parts, &columns, w.options.style.small_mm);
    let mut figure =
        maker.alone(DrawingPart::of(parts.into_iter().flat_map(|p| p.items).collect()));
    let told = each.iter().flat_map(|s| words.lines(s)).chain(both);
    figure.desc = told.map(|l| l.plain()).collect::<Vec<_>>().join("; ");
    figure
}

/// Arranges one solution across a page: drawings in a row, text below; in shorter rows if a long
/// mechanism would make the type on the page too small. Several solutions are side by side, or one
/// below the other if that would make the type too small.
fn arrange(parts: &mut [DrawingPart], columns: &[Vec<usize>], type_mm: f64) {
    let [one] = columns else {
        let row = |k: usize| columns.iter().map(|column| column[k]).collect();
        let beside: Vec<Vec<usize>> = (0..columns[0].len()).map(row).collect();
        stand(parts, &beside);
        let printed_mm = type_mm * printed(parts);
        if printed_mm < TYPE_MM {
            stand(parts, columns);
            if type_mm * printed(parts) < printed_mm {
                stand(parts, &beside);
            }
        }
        return;
    };
    let in_rows_of = |n: usize| one.chunks(n).map(<[usize]>::to_vec).collect::<Vec<_>>();
    let mut best: (f64, usize) = (0.0, 1);
    for n in (1..one.len()).rev() {
        stand(parts, &in_rows_of(n));
        let printed_mm = type_mm * printed(parts);
        if printed_mm > best.0 {
            best = (printed_mm, n);
        }
        if printed_mm >= TYPE_MM {
            return;
        }
    }
    stand(parts, &in_rows_of(best.1));
}

/// Reduction factor at which the parts fit on A4 with its margins, portrait or landscape.
fn printed(parts: &[DrawingPart]) -> f64 {
    let Some(all) = parts.iter().map(|p| p.bounds).reduce(Rect::union) else { return 1.0 };
    let [width, height] = [all.width_mm(), all.height_mm()].map(|side| side + 2.0 * MARGIN_MM);
    let [long, short] = AIM_MM;
    let fits = |x: f64, y: f64| (x / width).min(y / height);
    fits(long, short).max(fits(short, long)).min(1.0)
}

/// Places parts in rows and columns: each row as high as its highest part, each column as wide as
/// its widest.
fn stand(parts: &mut [DrawingPart], rows: &[Vec<usize>]) {
    let many = rows.iter().map(Vec::len).max().unwrap_or(0);
    // A row of one part does not widen the first column of the others.
    let counts = |r: &&Vec<usize>| r.len() > 1 || many == 1;
    let width = |k: usize| {
        rows.iter()
            .filter(counts)
            .filter_map(|r| r.get(k))
            .map(|p| parts[*p].bounds.width_mm())
            .fold(0.0, f64::max)
    };
    let widths: Vec<f64> = (0..many).map(width).collect();
    let mut y = 0.0;
    for row in rows {
        let mut x = 0.0;
        // Captions of a row are on one line; text is aligned at the top.
        let above = |p: &DrawingPart| caption_y(p).map(|y| p.bounds.max.y - y);
        let high = row.iter().filter_map(|p| above(&parts[*p])).fold(0.0, f64::max);
        let drop = |p: &DrawingPart| above(p).map_or(0.0, |own| high - own);
        let heights = row.iter().map(|p| drop(&parts[*p]) + parts[*p].bounds.height_mm());
        let height = heights.fold(0.0, f64::max);
        for (p, wide) in row.iter().zip(&widths) {
            let down = drop(&parts[*p]);
            parts[*p].stand_at(Point::new(x, y - down));
            x += wide + GAP_MM;
        }
        y -= height + GAP_MM;
    }
}

/// The vectors of a polygon on paper, the absolute one first.
fn vectors(w: &FigureInput, s: &ChoiceSolution, on: DiagramKind, mu: f64) -> Vec<ComposedVector> {
    let notation = &w.options.notation;
    let vector = |part: Option<Piece>, v: Vec2| {
        let mm = v * (1.0 / mu);
        let shown = ShownQuantity {
            names: vec![quantity(w.scene, s, part, on)],
            length: Some(ShownLength { mm: mm.norm(), si: v.norm() }),
        };
        ComposedVector {
            symbol: symbol(part, on, notation),
            key: key(part).into(),
            shown,
            mm,
            absolute: part.is_none(),
            step: None,
        }
    };
    match on {
        DiagramKind::Acceleration => {
            s.acceleration.iter().map(|(part, v)| vector(*part, *v)).collect()
        }
        DiagramKind::Plane | DiagramKind::Velocity | DiagramKind::Force => {
            let parts = [None, Some(Piece::TransportVelocity), Some(Piece::RelativeVelocity)];
            parts.into_iter().zip(s.velocity).map(|(part, v)| vector(part, v)).collect()
        }
    }
}

/// The key of a component of the motion, for ids.
fn key(part: Option<Piece>) -> &'static str {
    match part {
        None => "abs",
        Some(Piece::TransportVelocity | Piece::Transport) => "transport",
        Some(Piece::TransportNormal) => "transport-normal",
        Some(Piece::TransportTangential) => "transport-tangential",
        Some(Piece::RelativeVelocity | Piece::Relative | Piece::Path) => "relative",
        Some(Piece::RelativeNormal) => "relative-normal",
        Some(Piece::RelativeTangential) => "relative-tangential",
        Some(Piece::Coriolis) => "coriolis",
    }
}

/// A component of the motion in the notation of `find`: `ve_A/2`, `a_A`.
fn quantity(scene: &Scene, s: &ChoiceSolution, part: Option<Piece>, on: DiagramKind) -> String {
    let letters = match part {
        None => "",
        Some(Piece::TransportVelocity | Piece::Transport) => "e",
        Some(Piece::TransportNormal) => "en",
        Some(Piece::TransportTangential) => "et",
        Some(Piece::RelativeVelocity | Piece::Relative | Piece::Path) => "r",
        Some(Piece::RelativeNormal) => "rn",
        Some(Piece::RelativeTangential) => "rt",
        Some(Piece::Coriolis) => "k",
    };
    let letter = on.letter();
    let frame = match s.choice.frame {
        Frame::Link(l) => scene.link_name(l).to_owned(),
        Frame::Point(p) => name_of(scene, &p),
    };
    let seen = part.map_or_else(String::new, |_| format!("/{frame}"));
    format!("{letter}{letters}_{}{seen}", name_of(scene, &s.choice.of))
}

/// Returns the relative path of the moving point where its frame is a link. A straight guide shows
/// it already.
fn track(w: &FigureInput, s: &ChoiceSolution) -> Vec<Point> {
    let Frame::Link(link) = s.choice.frame else { return Vec::new() };
    if let RelativePath::Guide(g) = s.choice.path
        && matches!(w.scene.guides[g.0].path, GuidePath::Line { .. })
    {
        return Vec::new();
    }
    let (point, link) = (w.scene.point_name(s.choice.of.point), w.scene.link_name(link));
    track_on(w.scene, point, link).unwrap_or_default()
}

fn velocities(
    w: &FigureInput,
    maker: &SheetDrafter,
    scales: &CompositeScales,
    s: &ChoiceSolution,
    heading: Label,
    k: usize,
) -> DrawingPart {
    let composed = Composed {
        at: Some(s.choice.of.point),
        numbered: false,
        vectors: vectors(w, s, DiagramKind::Velocity, scales.velocity),
        parallelogram: true,
        track: track(w, s),
    };
    let part = mechanism::composed(
        &w.options.style,
        w.scene,
        maker.worked,
        &w.options.notation,
        &composed,
    );
    let of_vectors = DrawingScales::of(&w.scene.book, DiagramKind::Velocity, scales.velocity);
    let mu = maker.caption(DiagramKind::Plane).1.and(of_vectors);
    named(maker.titled(part, heading, &mu, "velocities"), "velocities", k)
}

fn accelerations(
    w: &FigureInput,
    maker: &SheetDrafter,
    mu: f64,
    s: &ChoiceSolution,
    k: usize,
) -> DrawingPart {
    let composed = Composed {
        at: Some(s.choice.of.point),
        numbered: false,
        vectors: vectors(w, s, DiagramKind::Acceleration, mu),
        parallelogram: false,
        track: Vec::new(),
    };
    let part = mechanism::composed(
        &w.options.style,
        w.scene,
        maker.worked,
        &w.options.notation,
        &composed,
    );
    let words = maker.words().composite_acceleration;
    named(
        maker.titled(
            part,
            Label::text(words),
            &DrawingScales::of(&w.scene.book, DiagramKind::Acceleration, mu),
            "accelerations",
        ),
        "accelerations",
        k,
    )
}

/// Draws the components one after another from the pole, and the absolute vector from the pole to
/// their end.
fn polygon(
    w: &FigureInput,
    maker: &SheetDrafter,
    mu: f64,
    s: &ChoiceSolution,
    k: usize,
) -> DrawingPart {
    let part = edges(w, &vectors(w, s, DiagramKind::Acceleration, mu));
    let words = maker.name(Captioned::Drawing(DiagramKind::Acceleration));
    named(
        maker.titled(
            part,
            Phrase::new(words).label(),
            &DrawingScales::of(&w.scene.book, DiagramKind::Acceleration, mu),
            "polygon",
        ),
        "polygon",
        k,
    )
}

/// The polygon of some accelerations.
fn edges(w: &FigureInput, all: &[ComposedVector]) -> DrawingPart {
    let style = &w.options.style;
    let mut d = Drawing::new("composite", style.clone());
    let pole = Point::ORIGIN;
    let mut at = pole;
    let arrow = |d: &mut Drawing, from: Point, v: &ComposedVector| {
        if v.mm.norm() <= SHORTEST_MM {
            return;
        }
        let to = from + v.mm;
        d.at_step(v.step);
        let width_mm = if v.absolute { style.vector.width_mm } else { style.vector.width_mm * 0.7 };
        let stroke = hodograph_paper::paper::item::LineStroke { width_mm, ..style.vector };
        let owner = d.vector(
            &v.key,
            "edge",
            Shape::Arrow { from, to, stroke, head: style.head },
            v.shown.clone(),
        );
        let request =
            LabelRequest::along(Label::math(&v.symbol), style.label_mm, from, to, width_mm / 2.0);
        d.label(&v.key, "edge", request.owned(owner));
    };
    for v in all.iter().filter(|v| !v.absolute) {
        arrow(&mut d, at, v);
        at = at + v.mm;
    }
    all.iter().filter(|v| v.absolute).for_each(|v| arrow(&mut d, pole, v));
    d.at_step(None);
    let pole_name = format!("{}'", w.options.notation.pole);
    d.draw("pole", "pole", hodograph_paper::paper::symbols::dot(style, pole));
    d.label(
        "pole",
        "pole",
        LabelRequest::at_point(Label::math(pole_name), style.label_mm, pole, style.dot_radius_mm),
    );
    d.finish()
}

/// The text below the drawings.
fn text(w: &FigureInput, lines: Vec<Phrase>, k: usize) -> DrawingPart {
    let style = &w.options.style;
    let row = |(i, line): (usize, Phrase)| {
        let (label, id) =
            (line.label().in_fonts(&style.fonts), format!("composite-{}-line-{}", k + 1, i + 1));
        let cell = Cell {
            label,
            size_mm: style.small_mm,
            anchor: Anchor::Start,
            class: "remark".into(),
            id,
        };
        Row { cells: vec![Some(cell)], height_mm: ROW_MM }
    };
    let rows: Vec<Row> = lines.into_iter().enumerate().map(row).collect();
    DrawingPart::of(grid::set(&rows, 0.0))
}

/// Prefixes the ids of a part, so that they differ between columns.
pub(super) fn named(mut part: DrawingPart, what: &str, k: usize) -> DrawingPart {
    let name = |item: &mut FigureItem| {
        if !item.id.is_empty() {
            item.id = format!("{what}-{}-{}", k + 1, item.id);
        }
    };
    part.items.iter_mut().for_each(name);
    part
}
