//! Draws a wrong solution over the right one, from the same pole and to the same μ: the wrong
//! vectors are dashed and red, the gap between the tips is red and named. Below are the equation
//! with the missing or wrong vector in a frame, and its consequence.

use hodograph_base::diag::{Faults, Warned};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::each;
use hodograph_board::construct::{Edge, Polygon};
use hodograph_board::plan::VertexId;
use hodograph_board::plan::text::{PlanWriter, vertex_name};
use hodograph_methods::attempts::{Attempt, wanted};
use hodograph_paper::paper::phrase::{Phrase, PhrasePiece};
use hodograph_report::attempts::{AttemptWords, gap_symbol};
use hodograph_scene::{DiagramKind, Scene};
use hodograph_worked::certified::certify;
use hodograph_worked::worked::Worked;
use unicode_width::UnicodeWidthChar;

use super::arrange::Tree;
use super::list::{Extras, FigureEntry, FigureInput, Pages};
use super::polygon;
use super::polygon::aside::lane;
use super::sheet::{SheetDrafter, SheetOptions};
use crate::scales::DrawingScales;
use hodograph_paper::paper::drawing::{Drawing, DrawingPart};
use hodograph_paper::paper::grid::{self, Cell, Row};
use hodograph_paper::paper::item::{Anchor, Colour, Dash, Figure, FigureItem, LineStroke, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_paper::paper::style::{Captioned, Style};
use hodograph_paper::paper::text::set;

/// Each wrong solution on its own page.
pub const ENTRY: FigureEntry = FigureEntry {
    name: "attempts",
    about: each!("Wrong solutions over the right one, a page for each"),
    draw,
};

/// Colour of the wrong parts.
const RED: Colour = Colour::rgb(200, 20, 30);
/// Marks closer than this are one.
const SAME_MM: f64 = 0.05;
/// Distance of a frame from its content.
const FRAME_MM: f64 = 0.9;
/// Line spacing of the text.
const ROW_MM: f64 = 5.8;
/// Row heights of the equation.
const TABLE_MM: [f64; 2] = [7.0, 6.0];
/// Maximum width of a line of text.
const PAGE_MM: f64 = 150.0;

fn draw(w: &FigureInput) -> Result<Warned<Pages>, Faults> {
    let all = wanted(w.scene, w.worked, false)?;
    let certified = certify(w.scene, w.worked, w.options.digits);
    let words = AttemptWords {
        scene: w.scene,
        worked: w.worked,
        certified: &certified,
        notation: &w.options.notation,
        lang: w.options.lang,
        digits: w.options.digits,
    };
    let name = |k: usize| {
        if all.len() == 1 { ENTRY.name.to_owned() } else { format!("{}-{}", ENTRY.name, k + 1) }
    };
    let pages = all.iter().enumerate().map(|(k, a)| (name(k), figure(w, &words, a))).collect();
    Ok(Warned { value: pages, notes: Vec::new() })
}

/// Draws the page of one wrong solution.
fn figure(w: &FigureInput, words: &AttemptWords, a: &Attempt) -> Figure {
    let maker = SheetDrafter {
        scene: w.scene,
        worked: w.worked,
        options: w.options,
        certified: Vec::new(),
    };
    let mut parts = vec![text(w, &[words.heading_set(a)], "heading", w.options.style.caption_mm)];
    if let Some(part) = overlay(w, &maker, words, a) {
        parts.push(part);
    }
    parts.extend(equation(w, words, a));
    parts.push(text(
        w,
        &folded(&w.options.style, &words.lines(a)),
        "line",
        w.options.style.small_mm,
    ));
    let tree = Tree::column((0..parts.len()).map(Tree::Leaf).collect());
    tree.put(&mut parts, Point::ORIGIN);
    let mut figure =
        maker.alone(DrawingPart::of(parts.into_iter().flat_map(|p| p.items).collect()));
    let said: Vec<String> = words.lines(a).iter().map(Phrase::plain).collect();
    figure.desc = format!("{}. {}", words.heading(a), said.join("; "));
    figure
}

/// Draws the right polygon with the wrong one over it.
fn overlay(
    w: &FigureInput,
    maker: &SheetDrafter,
    words: &AttemptWords,
    a: &Attempt,
) -> Option<DrawingPart> {
    let on = a.gap.on;
    let (right, wrong) =
        (a.right.worked.construction.polygon(on)?, a.wrong.worked.construction.polygon(on)?);
    let [right_words, wrong_words] = words.writers(a);
    let mut d = polygon::drawing(&w.options.style, &right_words, right, false);
    let style = &w.options.style;
    let stroke = LineStroke { dash: Dash::Dashed, colour: RED, ..style.vector };
    let mut lettered: Vec<Point> =
        right.images.iter().flatten().copied().chain([Point::ORIGIN]).collect();
    let whole = right.images.iter().flatten().map(|tip| (Point::ORIGIN, *tip));
    let right_edges: Vec<(Point, Point)> =
        right.edges.iter().map(|e| (e.from.1, e.to.1)).chain(whole).collect();
    // A vector over another one is drawn beside it, joined to its true position.
    let mut placed = right_edges.clone();
    let mut beside = |d: &mut Drawing, name: &str, (from, to): (Point, Point), width_mm: f64| {
        let by = lane((from, to), &placed, width_mm);
        let moved = (from + by, to + by);
        for (end, shifted) in
            [(from, moved.0), (to, moved.1)].into_iter().filter(|_| by != Vec2::ZERO)
        {
            d.shape(
                &format!("aside-{name}"),
                "wrong",
                Shape::Line { from: end, to: shifted, stroke: style.thin.coloured(RED) },
            );
        }
        placed.push(moved);
        moved
    };
    let mut arrow = |d: &mut Drawing, ends: (Point, Point), (key, symbol): (&str, &str)| {
        let name = format!("wrong-{key}");
        let (from, to) = beside(d, &name, ends, style.vector.width_mm);
        let owner = d.shape(&name, "wrong", Shape::Arrow { from, to, stroke, head: style.head });
        let request = LabelRequest::along(
            Label::math(format!("{symbol}*")),
            style.label_mm,
            from,
            to,
            stroke.width_mm / 2.0,
        );
        d.label(&name, "wrong", request.owned(owner).optional(true));
    };
    let mut drawn: Vec<(Point, Point)> = Vec::new();
    let is_there = |from: Point, to: Point, all: &[(Point, Point)]| {
        let one = |a: Point, b: Point| a.distance(b) < SAME_MM;
        all.iter().any(|(a, b)| one(*a, from) && one(*b, to))
    };
    for e in &wrong.edges {
        let (from, to) = (e.from.1, e.to.1);
        if from.distance(to) < SAME_MM
            || is_there(from, to, &right_edges)
            || is_there(from, to, &drawn)
        {
            continue;
        }
        drawn.push((from, to));
        arrow(&mut d, (from, to), (&key(e, &wrong_words, on), &symbol(e, &wrong_words, on)));
    }
    let tips = gap_tips(right, wrong, a)?;
    if tips[1].to_vec2().norm() > SAME_MM && !is_there(Point::ORIGIN, tips[1], &drawn) {
        arrow(
            &mut d,
            (Point::ORIGIN, tips[1]),
            (&wrong_words.vector_key(a.gap.wrong), &wrong_words.vector(on, a.gap.wrong)),
        );
    }
    for (v, at) in wrong.images.iter().enumerate().filter_map(|(v, at)| Some((VertexId(v), (*at)?)))
    {
        if a.wrong.worked.plan.vertex(v).fixed || lettered.iter().any(|p| p.distance(at) < SAME_MM)
        {
            continue;
        }
        lettered.push(at);
        // No equation leads to a point that is found as an image point: its whole vector is drawn.
        if !drawn.iter().any(|(a, b)| a.distance(at) < SAME_MM || b.distance(at) < SAME_MM) {
            drawn.push((Point::ORIGIN, at));
            arrow(
                &mut d,
                (Point::ORIGIN, at),
                (&wrong_words.vector_key(v), &wrong_words.vector(on, v)),
            );
        }
        let name = format!("wrong-image-{}", vertex_name(wrong_words.scene, wrong_words.plan, v));
        d.draw(&name, "wrong", hodograph_paper::paper::symbols::dot(style, at));
        let label = Label::math(format!("{}*", wrong_words.image(on, v)));
        d.label(
            &name,
            "wrong",
            LabelRequest::at_point(label, style.label_mm, at, style.dot_radius_mm),
        );
    }
    let gap = LineStroke { width_mm: style.vector.width_mm * 1.6, colour: RED, ..style.vector };
    let (from, to) = beside(&mut d, "gap", (tips[0], tips[1]), gap.width_mm);
    let owner = d.shape("gap", "gap", Shape::Line { from, to, stroke: gap });
    let label = Label::math(gap_symbol(&wrong_words, a));
    d.label(
        "gap",
        "gap",
        LabelRequest::along(label, style.label_mm, from, to, gap.width_mm / 2.0).owned(owner),
    );
    // Beside a much larger wrong solution the right one may shrink to a spot.
    d.thin_out(&[Point::ORIGIN, tips[0], tips[1], from + (to - from) * 0.5]);
    let caption = words.frame_of_drawing(a);
    Some(maker.titled(
        d.finish(),
        Label::text(caption),
        &DrawingScales::of(&w.scene.book, on, right.mu),
        "attempt",
    ))
}

fn symbol(e: &Edge, w: &PlanWriter, on: DiagramKind) -> String {
    e.terms.iter().map(|t| w.symbol(on, t)).collect::<Vec<_>>().join(" + ")
}

fn key(e: &Edge, w: &PlanWriter, on: DiagramKind) -> String {
    e.terms.iter().map(|t| w.key(on, t)).collect::<Vec<_>>().join("-and-")
}

fn gap_tips(right: &Polygon, wrong: &Polygon, a: &Attempt) -> Option<[Point; 2]> {
    Some([right.images[a.gap.right.0]?, wrong.images[a.gap.wrong.0]?])
}

/// The equation with the wrong column framed, or the statement in a frame.
fn equation(w: &FigureInput, words: &AttemptWords, a: &Attempt) -> Option<DrawingPart> {
    let style = &w.options.style;
    let cell = |label: Label, size_mm: f64, anchor: Anchor, id: String| {
        Some(Cell {
            label: label.in_fonts(&style.fonts),
            size_mm,
            anchor,
            class: "attempt table".into(),
            id,
        })
    };
    let Some(columns) = words.equation(a) else {
        let said = words.statement(a)?;
        let row = Row {
            cells: vec![cell(said.label(), style.label_mm, Anchor::Start, "statement".into())],
            height_mm: TABLE_MM[0],
        };
        let mut items = grid::set(&[row], 0.0);
        items.push(frame(&items.clone()));
        return Some(noted(w, words, a, items));
    };
    let own = hodograph_paper::paper::words::words(w.options.lang);
    let heading = |word: &str, id: &str| {
        cell(
            Label::text(word).then(Label::math("\\quad")),
            style.caption_mm,
            Anchor::End,
            format!("attempt-{id}"),
        )
    };
    let mut rows = [
        vec![None],
        vec![heading(own.magnitude, "magnitude")],
        vec![heading(own.direction, "direction")],
    ];
    for (k, f) in columns.iter().enumerate() {
        let c = &f.column;
        let math = |text: &str, size: f64, what: &str| {
            cell(Label::math(text), size, Anchor::Middle, format!("attempt-{what}-{k}"))
        };
        rows[0].push(if c.joint.is_empty() {
            None
        } else {
            math(c.joint, style.label_mm, "joint")
        });
        rows[0].push(math(&c.symbol, style.label_mm, "symbol"));
        rows[1].extend([None, math(&c.magnitude, style.caption_mm, "magnitude")]);
        rows[2].extend([None, math(&c.direction, style.caption_mm, "direction")]);
    }
    let [symbols, magnitudes, directions] = rows;
    let both = if w.options.notation.first_row == "direction" {
        [directions, magnitudes]
    } else {
        [magnitudes, directions]
    };
    let heights = [TABLE_MM[0], TABLE_MM[1], TABLE_MM[1]];
    let rows: Vec<Row> = [symbols]
        .into_iter()
        .chain(both)
        .zip(heights)
        .map(|(cells, height_mm)| Row { cells, height_mm })
        .collect();
    let mut items = grid::set(&rows, 1.6);
    for k in columns.iter().enumerate().filter(|(_, f)| f.framed).map(|(k, _)| k) {
        let of = |i: &&FigureItem| {
            ["symbol", "magnitude", "direction"]
                .iter()
                .any(|what| i.id == format!("attempt-{what}-{k}"))
        };
        let column: Vec<FigureItem> = items.iter().filter(of).cloned().collect();
        items.push(frame(&column));
    }
    Some(noted(w, words, a, items))
}

fn frame(around: &[FigureItem]) -> FigureItem {
    let b = DrawingPart::of(around.to_vec()).bounds.grown(FRAME_MM);
    let points = vec![b.min, Point::new(b.max.x, b.min.y), b.max, Point::new(b.min.x, b.max.y)];
    let stroke = LineStroke::new(0.35).coloured(RED);
    FigureItem::new(
        "attempt frame",
        Shape::Polyline { points, closed: true, stroke: Some(stroke), fill: None },
    )
}

/// Adds the meaning of the frame below the items.
fn noted(
    w: &FigureInput,
    words: &AttemptWords,
    a: &Attempt,
    mut items: Vec<FigureItem>,
) -> DrawingPart {
    let style = &w.options.style;
    let low = DrawingPart::of(items.clone()).bounds.min.y;
    let label = Label::text(words.frame(a)).in_fonts(&style.fonts);
    let shape = Shape::Label {
        at: Point::new(0.0, low - ROW_MM),
        label,
        size_mm: style.small_mm,
        anchor: Anchor::Start,
        colour: Colour::BLACK,
    };
    items.push(FigureItem::new("attempt remark", shape).with_id("attempt-frame"));
    DrawingPart::of(items)
}

/// Sets lines of text.
fn text(w: &FigureInput, lines: &[Phrase], what: &str, size_mm: f64) -> DrawingPart {
    let style = &w.options.style;
    let row = |(i, line): (usize, &Phrase)| {
        let cell = Cell {
            label: line.label().in_fonts(&style.fonts),
            size_mm,
            anchor: Anchor::Start,
            class: format!("attempt {what}"),
            id: format!("attempt-{what}-{}", i + 1),
        };
        Row { cells: vec![Some(cell)], height_mm: ROW_MM }
    };
    let rows: Vec<Row> = lines.iter().enumerate().map(row).collect();
    DrawingPart::of(grid::set(&rows, 0.0))
}

/// Breaks sentences into lines no wider than a page: at spaces, between Chinese characters, and
/// beside formulas.
fn folded(style: &Style, lines: &[Phrase]) -> Vec<Phrase> {
    let width = |p: &PhrasePiece| {
        set(&Phrase::of_pieces(vec![p.clone()]).label().in_fonts(&style.fonts)).width_em
            * style.small_mm
    };
    let mut out = Vec::new();
    for line in lines {
        let (mut here, mut used): (Vec<PhrasePiece>, f64) = (Vec::new(), 0.0);
        for piece in line.pieces().iter().flat_map(parted) {
            let wide = width(&piece);
            // Punctuation does not begin a line.
            let stop = matches!(&piece, PhrasePiece::Words(w) if w.starts_with(['，', '。', '；', '：', '）', '、', '.', ',', ';', ')']));
            if used + wide > PAGE_MM && !here.is_empty() && !stop {
                out.push(Phrase::of_pieces(std::mem::take(&mut here)));
                used = 0.0;
            }
            used += wide;
            here.push(piece);
        }
        out.push(Phrase::of_pieces(here));
    }
    out
}

/// Splits a piece into the pieces between which a line may break.
fn parted(piece: &PhrasePiece) -> Vec<PhrasePiece> {
    let PhrasePiece::Words(words) = piece else { return vec![piece.clone()] };
    let mut out: Vec<String> = vec![String::new()];
    for c in words.chars() {
        let breaks = out.last().is_some_and(|w: &String| w.ends_with(' ') && c != ' ')
            || !c.is_ascii() && c.width() == Some(2);
        if breaks && out.last().is_some_and(|w| !w.is_empty()) {
            out.push(String::new());
        }
        if let Some(last) = out.last_mut() {
            last.push(c);
        }
    }
    out.into_iter().map(PhrasePiece::Words).collect()
}

/// Draws the polygon of a wrong solution as its author would draw it, without any mark of the
/// error.
pub fn as_printed(a: &Attempt, options: &SheetOptions) -> Option<Figure> {
    let maker = SheetDrafter {
        scene: &a.wrong.scene,
        worked: &a.wrong.worked,
        options,
        certified: Vec::new(),
    };
    let on = a.gap.on;
    let drawn = maker.polygon(a.wrong.worked.construction.polygon(on)?, f64::INFINITY);
    let part = maker.captioned(drawn, "", on);
    let mut figure = maker.alone(part);
    figure.desc = maker.name(Captioned::Drawing(on)).into();
    Some(figure)
}

/// Draws the page of a wrong solution for documents.
pub fn page_of(scene: &Scene, worked: &Worked, options: &SheetOptions, a: &Attempt) -> Figure {
    let certified = certify(scene, worked, options.digits);
    let words = AttemptWords {
        scene,
        worked,
        certified: &certified,
        notation: &options.notation,
        lang: options.lang,
        digits: options.digits,
    };
    figure(&FigureInput { scene, worked, options, extras: &Extras::default() }, &words, a)
}
