//! The theorems of composite motion, derived on a scene: the displacements of the moving point in
//! Δt on the mechanism and as a triangle, and the changes of the velocities.

use hodograph_base::diag::{Faults, Warned};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::{each, tr};
use hodograph_board::construct::scale;
use hodograph_board::plan::names::point_label;
use hodograph_methods::composite::derivation::{TwoInstants, two_instants};
use hodograph_paper::paper::drawing::{Drawing, DrawingPart};
use hodograph_paper::paper::item::{LineStroke, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::phrase::Phrase;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_paper::paper::style::Style;
use hodograph_paper::paper::symbols as sym;
use hodograph_report::composite::CompositeWords;
use hodograph_scene::quantity::Frame;
use hodograph_scene::{DiagramKind, Kind};

use super::arrange::{Tree, put_together};
use super::composite::named;
use super::extremes::with_rows;
use super::list::{FigureEntry, FigureInput, Pages, page};
use super::mechanism::{LoopArrow, PositionMarks, SHORTEST_MM, positions};
use super::placed::{PlacedMechanism, placed};
use super::relative::track_on;
use super::sheet::SheetDrafter;
use crate::scales::DrawingScales;

/// The derivation.
pub const ENTRY: FigureEntry = FigureEntry {
    name: "derivation",
    about: each!("Theorems of composite motion: displacements, changes of velocity"),
    draw,
};

/// Length of the relative path shown before and behind the displacements, in their lengths.
const NEAR: f64 = 1.5;
/// Space for a triangle.
const ROOM_MM: f64 = 70.0;

fn draw(w: &FigureInput) -> Result<Warned<Pages>, Faults> {
    let Some(two) = two_instants(w.scene)? else { return page(ENTRY.name, None) };
    let words =
        CompositeWords { scene: w.scene, lang: w.options.lang, notation: &w.options.notation };
    let told = words.derivation(&two);
    let mut parts = vec![mechanism(w, &two, &words)?];
    parts.push(named(
        with_rows(w.options, displacements(w, &two), labels(&told.displacements)),
        "displacements",
        0,
    ));
    let mut columns = vec![Tree::Leaf(0), Tree::Leaf(1)];
    if !told.velocities.is_empty() {
        let [transport, relative] = changes(w, &two);
        parts.push(named(transport, "transport", 0));
        parts.push(named(with_rows(w.options, relative, labels(&told.velocities)), "relative", 0));
        columns.extend([Tree::Leaf(2), Tree::Leaf(3)]);
    }
    let rows: Vec<Tree> = columns.chunks(2).map(|row| Tree::row(row.to_vec())).collect();
    let maker = SheetDrafter {
        scene: &two.scene,
        worked: &two.worked,
        options: w.options,
        certified: Vec::new(),
    };
    let mut figure = maker.alone(put_together(Tree::column(rows), parts));
    let lines = told.displacements.iter().chain(&told.velocities);
    figure.desc = lines.map(Phrase::plain).collect::<Vec<_>>().join("; ");
    page(ENTRY.name, Some(figure))
}

fn labels(lines: &[Phrase]) -> Vec<Label> {
    lines.iter().map(Phrase::label).collect()
}

/// Draws the mechanism at both instants with the displacements.
fn mechanism(
    w: &FigureInput,
    two: &TwoInstants,
    words: &CompositeWords,
) -> Result<DrawingPart, Faults> {
    let options = w.options;
    let later = vec![(two.later.clone(), "1".to_owned())];
    let PlacedMechanism { scene, worked, course, others } =
        placed(w, (&two.scene, &two.worked), later)?;
    let [_, carried, _] = two.places;
    let marks = PositionMarks {
        poses: others,
        arrows: arrows(two),
        track: track(w, two),
        place: Some((carried, words.carried_point(two))),
        light: true,
        ..PositionMarks::default()
    };
    let maker = SheetDrafter { scene: &scene, worked: &worked, options, certified: Vec::new() };
    let part = positions(&options.style, (&scene, &worked), &options.notation, &course, &marks);
    let heading = words.heading(&two.solution.choice);
    let mu = maker.caption(DiagramKind::Plane).1;
    Ok(maker.titled(part, heading.label(), &mu, "mechanism"))
}

/// The displacements between M, m₁ and M₁, with their symbols.
fn sides(two: &TwoInstants) -> [(&'static str, &'static str, [Point; 2]); 3] {
    let [from, carried, to] = two.places;
    [
        ("absolute", "\\Delta r_{a}", [from, to]),
        ("transport", "\\Delta r_{e}", [from, carried]),
        ("relative", "\\Delta r_{r}", [carried, to]),
    ]
}

fn arrows(two: &TwoInstants) -> Vec<LoopArrow> {
    let arrow = |(key, symbol, places): (&str, &str, [Point; 2])| LoopArrow {
        symbol: symbol.to_owned(),
        key: key.to_owned(),
        places,
        angle: None,
        step: None,
    };
    sides(two).map(arrow).into()
}

/// Returns the relative path on the frame at the later instant, near the displacements.
fn track(w: &FigureInput, two: &TwoInstants) -> Vec<Point> {
    let choice = two.solution.choice;
    let Frame::Link(link) = choice.frame else { return Vec::new() };
    let scene = &two.scene;
    let (Some(before), Some(after)) =
        (two.worked.configuration.poses[link.0], two.later.poses[link.0])
    else {
        return Vec::new();
    };
    let path = track_on(w.scene, scene.point_name(choice.of.point), scene.link_name(link));
    let path: Vec<Point> =
        path.unwrap_or_default().into_iter().map(|p| after.to_world(before.to_local(p))).collect();
    let [_, carried, to] = two.places;
    let reach =
        NEAR * sides(two).map(|(_, _, [a, b])| a.distance(b)).into_iter().fold(0.0, f64::max);
    let near = |p: &&Point| p.distance(carried).min(p.distance(to)) <= reach;
    let off = |k: &usize| path[*k].distance(carried);
    let Some(nearest) = (0..path.len()).min_by(|a, b| off(a).total_cmp(&off(b))) else {
        return path;
    };
    let (back, ahead) = path.split_at(nearest);
    let back: Vec<&Point> = back.iter().rev().take_while(near).collect();
    back.into_iter().rev().chain(ahead.iter().take_while(near)).copied().collect()
}

/// A vector of a drawing, in units of its quantity.
struct DerivationEdge {
    key: &'static str,
    symbol: String,
    from: Vec2,
    to: Vec2,
    /// True for a difference.
    light: bool,
}

/// Draws vectors at a scale (SI per mm), with letters at some of their ends.
fn polygon(
    style: &Style,
    mu: f64,
    edges: &[DerivationEdge],
    points: &[(Vec2, String)],
) -> DrawingPart {
    let mut d = Drawing::new("derivation", style.clone());
    let paper = |v: Vec2| (v * (1.0 / mu)).to_point();
    for e in edges {
        let [from, to] = [e.from, e.to].map(paper);
        if from.distance(to) <= SHORTEST_MM {
            continue;
        }
        let width_mm = if e.light { style.vector.width_mm * 0.6 } else { style.vector.width_mm };
        let stroke = LineStroke { width_mm, ..style.vector };
        let shape = Shape::Arrow { from, to, stroke, head: style.head };
        let owner = d.shape(e.key, "edge", shape);
        let label = Label::math(&e.symbol);
        let request = LabelRequest::along(label, style.label_mm, from, to, width_mm / 2.0);
        d.label(e.key, "edge", request.owned(owner));
    }
    for (k, (at, letter)) in points.iter().enumerate() {
        let (name, at) = (format!("point-{k}"), paper(*at));
        d.draw(&name, "point", sym::dot(style, at));
        let label = Label::math(letter);
        d.label(
            &name,
            "point",
            LabelRequest::at_point(label, style.label_mm, at, style.dot_radius_mm),
        );
    }
    d.finish()
}

/// Returns the scale at which vectors from the origin fit.
fn mu(w: &FigureInput, kind: Kind, edges: &[DerivationEdge]) -> f64 {
    let ends = || edges.iter().flat_map(|e| [e.from, e.to]);
    let reach = |of: fn(Vec2) -> f64| {
        let (low, high) =
            ends().fold((0.0_f64, 0.0_f64), |(low, high), v| (low.min(of(v)), high.max(of(v))));
        high - low
    };
    let extent = [reach(|v| v.x), reach(|v| v.y)];
    scale::choose_in(w.scene.paper.unit(kind), extent, [ROOM_MM, ROOM_MM])
}

/// Draws the triangle of the displacements.
fn displacements(w: &FigureInput, two: &TwoInstants) -> DrawingPart {
    let from = two.places[0];
    let edges = sides(two).map(|(key, symbol, places)| {
        let [a, b] = places.map(|p| p - from);
        DerivationEdge { key, symbol: symbol.to_owned(), from: a, to: b, light: key != "absolute" }
    });
    let words =
        CompositeWords { scene: w.scene, lang: w.options.lang, notation: &w.options.notation };
    let own = point_label(w.scene.point_name(two.solution.choice.of.point));
    let letters = [own.clone(), words.carried_point(two), format!("{own}_{{1}}")];
    let points: Vec<(Vec2, String)> = two.places.iter().map(|p| *p - from).zip(letters).collect();
    let mu = mu(w, Kind::Length, &edges);
    let caption = tr!(w.options.lang, "Displacements in $\\Delta t$");
    titled(w, polygon(&w.options.style, mu, &edges, &points), caption, DiagramKind::Plane, mu)
}

/// Draws the transport velocities and the relative velocities of both instants with their changes.
fn changes(w: &FigureInput, two: &TwoInstants) -> [DrawingPart; 2] {
    let [_, transport, relative] = two.solution.velocity;
    let later = two.velocities;
    let of = |[one, middle, last]: [(&'static str, &str, Vec2); 3], parts: [&str; 2]| {
        let whole = |(key, symbol, to): (&'static str, &str, Vec2)| DerivationEdge {
            key,
            symbol: symbol.to_owned(),
            from: Vec2::ZERO,
            to,
            light: false,
        };
        let change = |key, symbol: &str, from, to| DerivationEdge {
            key,
            symbol: symbol.to_owned(),
            from,
            to,
            light: true,
        };
        vec![
            whole(one),
            whole(middle),
            whole(last),
            change("first", parts[0], one.2, middle.2),
            change("second", parts[1], middle.2, last.2),
        ]
    };
    let all = [
        of(
            [
                ("v-e", "v_{e}", transport),
                ("v-e1", "v_{e1}", later.carried),
                ("v-e-later", "v_{e}'", later.transport),
            ],
            ["\\Delta v_{e}", "\\Delta v_{e}^{*}"],
        ),
        of(
            [
                ("v-r", "v_{r}", relative),
                ("v-r1", "v_{r1}", later.turned),
                ("v-r-later", "v_{r}'", later.relative),
            ],
            ["\\Delta v_{r}^{*}", "\\Delta v_{r}"],
        ),
    ];
    let captions = [
        tr!(w.options.lang, "Transport velocities of both instants"),
        tr!(w.options.lang, "Relative velocities of both instants"),
    ];
    let mut captions = captions.into_iter();
    all.map(|edges| {
        let mu = mu(w, Kind::Velocity, &edges);
        let pole = vec![(Vec2::ZERO, w.options.notation.pole.clone())];
        let part = polygon(&w.options.style, mu, &edges, &pole);
        titled(w, part, captions.next().unwrap_or_default(), DiagramKind::Velocity, mu)
    })
}

fn titled(
    w: &FigureInput,
    part: DrawingPart,
    caption: &str,
    on: DiagramKind,
    mu: f64,
) -> DrawingPart {
    let maker = SheetDrafter {
        scene: w.scene,
        worked: w.worked,
        options: w.options,
        certified: Vec::new(),
    };
    let scales = DrawingScales::of(&w.scene.book, on, mu);
    maker.titled(part, Phrase::new(caption).label(), &scales, ENTRY.name)
}
