//! A whole sheet from symbols, labels and placement to the drawing: the look of a textbook page, in
//! English and Chinese.
//!
//! The numbers are those of a four-bar linkage solved by hand on the sheet; nothing here computes
//! them from a scene.

mod extra;
mod fonts;
mod forces;
mod geared;
mod keys;
mod legible;
mod motion;
mod pairs;
mod parted;
mod plots;
#[path = "../wide/mod.rs"]
mod wide;
mod width;

use std::sync::LazyLock;
use wide::every;

use hodograph::figure::sheet::{SheetOptions, sheet};
use hodograph::geom::{Point, Vec2, cross_lines};
use hodograph::paper::extent::translate;
use hodograph::paper::item::{Anchor, Colour, Figure, FigureItem, Shape};
use hodograph::paper::label::Label;
use hodograph::paper::place::{CROWDED, LabelRequest, Obstacles, Placement, place};
use hodograph::paper::style::Style;
use hodograph::paper::symbols as sym;
use hodograph::paper::{arrow::ArrowHead, extent::Rect};
use hodograph::render::{png, svg};
use hodograph::scene::{self, DiagramKind, Lang, templates};
use hodograph::worked::{Scope, work};

static STYLE: LazyLock<Style> = LazyLock::new(Style::default);
const PAPER: Rect = Rect { min: Point::ORIGIN, max: Point { x: 210.0, y: 104.0 } };

struct Words {
    lang: &'static str,
    configuration: &'static str,
    polygon: &'static str,
    direction: &'static str,
    magnitude: &'static str,
}

const ENGLISH: Words = Words {
    lang: "en",
    configuration: "(a) Configuration diagram",
    polygon: "(b) Velocity polygon",
    direction: "Direction",
    magnitude: "Magnitude",
};
const CHINESE: Words = Words {
    lang: "zh",
    configuration: "(a) 机构位置图",
    polygon: "(b) 速度多边形",
    direction: "方向",
    magnitude: "大小",
};

/// Items, obstacles for labels, and the labels to be placed.
#[derive(Default)]
struct Board {
    items: Vec<FigureItem>,
    obstacles: Obstacles,
    requests: Vec<LabelRequest>,
    owners: u32,
}

impl Board {
    fn draw(&mut self, items: Vec<FigureItem>) -> u32 {
        self.owners += 1;
        self.obstacles.add(&items, Some(self.owners));
        self.items.extend(items);
        self.owners
    }

    fn vector(&mut self, from: Point, to: Point, label: &str) {
        let shape = Shape::Arrow { from, to, stroke: STYLE.vector, head: ArrowHead::VECTOR };
        let owner = self.draw(vec![FigureItem::new("velocity edge", shape)]);
        self.along(from, to, label, owner);
    }

    fn along(&mut self, from: Point, to: Point, label: &str, owner: u32) {
        self.requests.push(
            LabelRequest::along(
                Label::math(label),
                STYLE.label_mm,
                from,
                to,
                STYLE.vector.width_mm / 2.0,
            )
            .owned(owner),
        );
    }

    fn arc(&mut self, centre: Point, radius_mm: f64, angles: [f64; 2], label: &str, owner: u32) {
        let request = LabelRequest::along_arc(
            Label::math(label),
            STYLE.label_mm,
            centre,
            radius_mm,
            angles,
            STYLE.vector.width_mm / 2.0,
        );
        self.requests.push(request.owned(owner));
    }

    fn point(&mut self, at: Point, clear_mm: f64, label: &str, side: Option<Vec2>) {
        let request = LabelRequest::at_point(Label::math(label), STYLE.label_mm, at, clear_mm);
        self.requests.push(LabelRequest { prefer: side, ..request });
    }

    fn text(&mut self, at: Point, label: Label, size_mm: f64, anchor: Anchor) {
        self.draw(vec![FigureItem::new(
            "text",
            Shape::Label { at, label, size_mm, anchor, colour: Colour::BLACK },
        )]);
    }

    fn finish(mut self, words: &Words) -> (Figure, Vec<Placement>) {
        let placements = place(&self.requests, &self.obstacles, PAPER);
        for (p, r) in placements.iter().zip(&self.requests) {
            self.items.extend(p.items(r, "label", STYLE.thin));
        }
        let figure = Figure {
            width_mm: PAPER.max.x,
            height_mm: PAPER.max.y,
            title: words.configuration.into(),
            desc: words.polygon.into(),
            lang: words.lang.into(),
            paper: Colour::WHITE,
            items: self.items,
        };
        (figure, placements)
    }
}

fn fourbar(words: &Words) -> (Figure, Vec<Placement>) {
    let mut board = Board::default();
    let (a, d, b, c) = (
        Point::new(17.0, 29.0),
        Point::new(98.0, 29.0),
        Point::new(34.0, 53.3),
        Point::new(104.7, 84.0),
    );
    let pin = STYLE.pin_radius_mm + STYLE.outline.width_mm / 2.0;
    let omega = 0.72;
    let vb = (b - a).perp() * omega;
    let vc_along =
        cross_lines(Point::ORIGIN + vb, (c - b).perp(), Point::ORIGIN, (c - d).perp()).at.to_vec2();

    for (p, q, name) in [(a, b, "1"), (b, c, "2"), (d, c, "3")] {
        let owner = board.draw(sym::link(&STYLE, &[p, q]));
        board.requests.push(
            LabelRequest::along(Label::math(name), STYLE.label_mm, p, q, STYLE.link.width_mm / 2.0)
                .owned(owner),
        );
    }
    board.vector(b, b + vb, "v_B");
    board.vector(c, c + vc_along * 0.8, "v_C");
    let crank = (b - a).angle();
    let owner = board.draw(sym::angle(&STYLE, a, 12.0, 0.0, crank));
    board.arc(a, 12.0, [0.0, crank], r"\varphi_1", owner);
    let owner = board.draw(sym::rotation(&STYLE, a, 7.6, 1.4, 3.0));
    board.arc(a, 7.6, [1.4, 3.0], r"\omega_1", owner);
    for p in [a, d] {
        board.draw(sym::fixed_pivot(&STYLE, p, Vec2::new(0.0, -1.0)));
    }
    for p in [b, c] {
        board.draw(sym::pin(&STYLE, p));
    }
    for (p, name) in [(a, "A"), (b, "B"), (c, "C"), (d, "D")] {
        board.point(p, pin, name, None);
    }
    board.text(Point::new(57.5, 20.0), Label::math("4"), STYLE.label_mm, Anchor::Middle);

    let pole = Point::new(178.0, 59.0);
    let (tip_b, tip_c) = (pole + vb * 2.3, pole + vc_along * 2.3);
    board.vector(pole, tip_b, "v_B");
    board.vector(pole, tip_c, "v_C");
    board.vector(tip_b, tip_c, "v_{CB}");
    board.draw(sym::dot(&STYLE, pole));
    let middle = pole + ((tip_b - pole) + (tip_c - pole)) * (1.0 / 3.0);
    for (p, name) in [(pole, "p"), (tip_b, "b"), (tip_c, "c")] {
        board.point(p, 0.6, name, Some(p - middle));
    }
    board.draw(sym::scale_bar(
        &STYLE,
        Point::new(131.0, 49.0),
        20.0,
        [Label::math("0"), Label::math("0.1 m/s")],
    ));

    let columns = [146.0, 156.5, 167.0, 177.5, 188.0];
    for (x, sign) in columns.iter().zip(["v_C", "=", "v_B", "+", "v_{CB}"]) {
        board.text(Point::new(*x, 37.5), Label::math(sign), STYLE.label_mm, Anchor::Middle);
    }
    for (y, word, cells) in [
        (30.0, words.direction, [r"\perp CD", r"\perp AB", r"\perp BC"]),
        (22.5, words.magnitude, ["?", r"\omega_1 l_{AB}", "?"]),
    ] {
        board.text(Point::new(134.0, y), Label::text(word), STYLE.caption_mm, Anchor::End);
        for (x, cell) in [columns[0], columns[2], columns[4]].into_iter().zip(cells) {
            board.text(Point::new(x, y), Label::math(cell), STYLE.caption_mm, Anchor::Middle);
        }
    }
    for (x, words, scale) in [
        (58.0, words.configuration, r"\mu_l = 0.002 m/mm"),
        (161.0, words.polygon, r"\mu_v = 0.01 (m/s)/mm"),
    ] {
        board.text(Point::new(x, 11.0), Label::text(words), STYLE.caption_mm, Anchor::Middle);
        board.text(Point::new(x, 5.0), Label::math(scale), STYLE.small_mm, Anchor::Middle);
    }
    board.finish(words)
}

/// Every symbol once, each rotated, on one sheet.
fn symbols() -> Figure {
    let mut items = Vec::new();
    let at = |x: f64, y: f64| Point::new(x, y);
    for (k, side) in
        [Vec2::new(0.0, -1.0), Vec2::new(1.0, 0.0), Vec2::new(-1.0, 1.0)].into_iter().enumerate()
    {
        items.extend(sym::fixed_pivot(&STYLE, at(15.0 + 22.0 * k as f64, 88.0), side));
    }
    items.extend(sym::guide(&STYLE, at(85.0, 88.0), 0.0, 26.0, sym::GuideForm::OneSided));
    items.extend(sym::block(&STYLE, at(85.0, 88.0), 0.0, false));
    items.extend(sym::pin(&STYLE, at(85.0, 88.0)));
    items.extend(sym::guide(&STYLE, at(125.0, 88.0), 0.5, 26.0, sym::GuideForm::TwoSided));
    items.extend(sym::block(&STYLE, at(125.0, 88.0), 0.5, false));
    items.extend(sym::pin(&STYLE, at(125.0, 88.0)));
    let lever = [at(155.0, 72.0), at(175.0, 100.0)];
    items.extend(sym::link(&STYLE, &lever));
    let (middle, tilt) = (at(165.0, 86.0), (lever[1] - lever[0]).angle());
    items.extend(sym::block(&STYLE, middle, tilt, true));
    items.extend(sym::link(&STYLE, &[at(190.0, 80.0), middle]));
    items.extend(sym::pin(&STYLE, middle));
    items.extend(sym::fixed_pivot(&STYLE, at(190.0, 80.0), Vec2::new(0.0, -1.0)));

    items.extend(sym::slot(&STYLE, at(12.0, 52.0), at(34.0, 64.0)));
    items.extend(sym::pin(&STYLE, at(23.0, 58.0)));
    items.extend(sym::slot_arc(&STYLE, at(62.0, 46.0), 16.0, 2.4, 0.6));
    items.extend(sym::pin(&STYLE, at(62.0, 62.0)));
    let tri = [at(92.0, 48.0), at(122.0, 52.0), at(104.0, 68.0)];
    items.extend(sym::plate(&STYLE, &tri));
    for p in tri {
        items.extend(sym::pin(&STYLE, p));
    }
    let bell = [at(135.0, 50.0), at(150.0, 66.0), at(170.0, 60.0)];
    items.extend(sym::link(&STYLE, &bell));
    items.extend(sym::weld(&STYLE, bell[1], bell[0], bell[2]));
    for p in [bell[0], bell[2]] {
        items.extend(sym::pin(&STYLE, p));
    }
    let (base, tip) = (at(14.0, 20.0), at(52.0, 36.0));
    items.extend(sym::cylinder(&STYLE, base, tip, 22.0));
    items.extend(sym::pin(&STYLE, base));
    items.extend(sym::pin(&STYLE, tip));
    items.extend(sym::dimension(&STYLE, at(70.0, 24.0), at(110.0, 24.0), -8.0));
    items.extend(sym::link(&STYLE, &[at(70.0, 24.0), at(110.0, 24.0)]));
    items.extend(sym::pin(&STYLE, at(70.0, 24.0)));
    items.extend(sym::pin(&STYLE, at(110.0, 24.0)));
    items.extend(sym::rotation(&STYLE, at(135.0, 24.0), 8.0, 2.6, 0.4));
    items.extend(sym::angle(&STYLE, at(155.0, 18.0), 12.0, 0.0, 0.9));
    for (k, length) in [1.0, 2.0, 4.0, 8.0, 16.0].into_iter().enumerate() {
        let from = at(180.0, 12.0 + 5.0 * k as f64);
        let shape = Shape::Arrow {
            from,
            to: from + Vec2::new(length, 0.0),
            stroke: STYLE.vector,
            head: STYLE.head,
        };
        items.push(FigureItem::new("velocity", shape));
    }
    let formulas = [
        r"a^n_{CB}",
        r"\omega_1^2 l_{AB}",
        "b'_2",
        "n''",
        r"v_{B3B2}^r",
        r"2\omega_3 v_{B3B2}",
        r"B \to A",
        r"\parallel BC",
        r"\circled{3}",
        r"\checkmark",
    ];
    let mut row: Vec<FigureItem> = Vec::new();
    for (k, source) in formulas.into_iter().enumerate() {
        let shape = Shape::Label {
            at: at(10.0 + 20.0 * k as f64, 0.0),
            label: Label::math(source),
            size_mm: STYLE.label_mm,
            anchor: Anchor::Start,
            colour: Colour::BLACK,
        };
        row.push(FigureItem::new("label", shape));
    }
    translate(&mut row, Vec2::new(0.0, 4.0));
    items.extend(row);
    Figure {
        width_mm: 210.0,
        height_mm: 104.0,
        title: "Symbols".into(),
        desc: "Every symbol once".into(),
        lang: "en".into(),
        paper: Colour::WHITE,
        items,
    }
}

fn ink(figure: &Figure, name: &str) -> (String, Vec<u8>) {
    let svg = svg::write(figure).expect("every item is sound");
    assert_eq!(svg.notes, [], "{name}");
    let png = png::render(&svg.value, 200.0).expect("the document is sound");
    // To look at the sheets: HODOGRAPH_SHEETS=some/folder cargo test --test sheet
    if let Some(folder) = std::env::var_os("HODOGRAPH_SHEETS") {
        let path = std::path::Path::new(&folder).join(name);
        std::fs::write(path.with_extension("svg"), &svg.value)
            .expect("the folder can be written to");
        std::fs::write(path.with_extension("png"), &png).expect("the folder can be written to");
    }
    (svg.value, png)
}

#[test]
fn fourbar_sheet_in_two_languages() {
    for words in [ENGLISH, CHINESE] {
        let (figure, placements) = fourbar(&words);
        for (i, p) in placements.iter().enumerate() {
            assert!(p.cost < CROWDED && p.leader.is_none(), "label {i} is crowded: {p:?}");
            assert!(
                placements[..i].iter().all(|q| p.bounds.overlap_mm2(q.bounds) <= 0.0),
                "label {i} overlaps"
            );
        }
        let name = format!("fourbar-{}", words.lang);
        let (svg, png) = ink(&figure, &name);
        assert_eq!(ink(&fourbar(&words).0, &name), (svg.clone(), png), "same figure, same bytes");
        let labels = figure.items.iter().filter(|i| matches!(i.shape, Shape::Label { .. })).count();
        assert_eq!(svg.matches("data-text=").count(), labels, "every label is in the document");
        assert!(svg.len() < 60_000, "{} bytes", svg.len());
    }
}

#[test]
fn symbol_sheet() {
    let (svg, _) = ink(&symbols(), "symbols");
    assert!(svg.contains(r#"class="ground hatch""#));
}

/// Largest displacement of a vector drawn aside.
const ASIDE_MM: f64 = 5.0;

/// Checks the properties of every sheet; returns the faults.
fn check(
    name: &str,
    scene: &scene::Scene,
    worked: &hodograph::worked::Worked,
    figure: &Figure,
) -> Vec<String> {
    let mut faults = Vec::new();
    let mut fault = |text: String| faults.push(format!("{name}: {text}"));
    let mut ids = std::collections::HashSet::new();
    let paper = Rect::new(Point::ORIGIN, Point::new(figure.width_mm, figure.height_mm));
    for item in &figure.items {
        if item.id.is_empty() || item.class.is_empty() || !ids.insert(item.id.as_str()) {
            fault(format!("id `{}` of class `{}` is missing or not unique", item.id, item.class));
        }
        if let Some(b) = item.bounds()
            && paper.union(b) != paper
        {
            fault(format!("{} is cut by the paper's edge: {b:?}", item.id));
        }
    }
    let labels: Vec<(&FigureItem, Rect)> = figure
        .items
        .iter()
        .filter(|i| matches!(i.shape, Shape::Label { .. }))
        .filter_map(|i| Some((i, i.bounds()?)))
        .collect();
    for (k, (a, ra)) in labels.iter().enumerate() {
        for (b, rb) in &labels[..k] {
            if ra.overlap_mm2(*rb) > 0.0 {
                fault(format!(
                    "labels {} and {} overlap by {:.2} mm²",
                    a.id,
                    b.id,
                    ra.overlap_mm2(*rb)
                ));
            }
        }
    }
    for (on, kind) in
        [(DiagramKind::Velocity, "velocity"), (DiagramKind::Acceleration, "acceleration")]
    {
        let Some(p) = worked.construction.polygon(on) else { continue };
        let pole = figure
            .items
            .iter()
            .find(|i| i.id == hodograph::paper::drawing::id(kind, "pole"))
            .and_then(|i| match i.shape {
                Shape::Circle { centre, .. } => Some(centre),
                _ => None,
            });
        let Some(pole) = pole else {
            fault(format!("{kind} has no pole"));
            continue;
        };
        let arrows: Vec<(Point, Point)> = figure
            .items
            .iter()
            .filter(|i| i.class.starts_with(kind))
            .filter_map(|i| match i.shape {
                Shape::Arrow { from, to, .. } => Some((from, to)),
                _ => None,
            })
            .collect();
        // Coincident vectors are drawn side by side: with the same length and direction, displaced
        // perpendicular to themselves.
        let shows = |(from, to): &(Point, Point), e: [Point; 2]| {
            let [off, end_off] = [*from - (pole + e[0].to_vec2()), *to - (pole + e[1].to_vec2())];
            let along = (e[1] - e[0]).unit().expect("an edge has a length").dot(off);
            (off - end_off).norm() < 0.1 && along.abs() < 0.1 && off.norm() < ASIDE_MM
        };
        for e in p.edges.iter().filter(|e| e.from.1.distance(e.to.1) > 0.1) {
            if !arrows.iter().any(|arrow| shows(arrow, [e.from.1, e.to.1])) {
                fault(format!("{kind}: no arrow from {:?} to {:?}", e.from, e.to));
            }
        }
        let notes =
            figure.items.iter().filter(|i| i.class.starts_with(&format!("{kind} zero"))).count();
        if p.edges.iter().any(|e| e.from.1.distance(e.to.1) < 0.01) && notes == 0 {
            fault(format!("{kind}: a vector of no length is not noted"));
        }
        for (n, action) in p.actions.iter().enumerate() {
            let word = format!("step-{n}");
            let shown = figure
                .items
                .iter()
                .any(|i| i.class.starts_with(kind) && i.class.split(' ').any(|w| w == word));
            if !shown && !matches!(action, hodograph::construct::Action::Rate(_)) {
                fault(format!("{kind}: {action:?} (step {n}) shows nothing"));
            }
        }
    }
    for r in &worked.results {
        let id = format!(
            "result-{}-value",
            hodograph::paper::shown::question_id(&scene.find[r.find].text)
        );
        if !ids.contains(id.as_str()) {
            fault(format!("no result {id}"));
        }
    }
    faults
}

fn sheets_of(name: &str, values: &[(&str, &str)], languages: &[Lang]) -> Vec<String> {
    let tag: String = values.iter().map(|(k, v)| format!("-{k}={v}")).collect();
    let scene = scene::read(templates::instantiate(name, values).unwrap()).unwrap().value;
    let worked = match work(&scene, Scope::Figure) {
        Ok(w) => w.value,
        Err(f) => return vec![format!("{name}{tag}: {f}")],
    };
    let mut faults = Vec::new();
    for lang in languages {
        let figure = sheet(&scene, &worked, &SheetOptions::of_language(*lang))
            .unwrap_or_else(|f| panic!("{name}{tag}: {f}"));
        let name = format!("{name}{tag}-{}", figure.lang);
        faults.extend(check(&name, &scene, &worked, &figure));
        let (svg, _) = ink(&figure, &name);
        let labels = figure.items.iter().filter(|i| matches!(i.shape, Shape::Label { .. })).count();
        if svg.matches("data-text=").count() != labels {
            faults.push(format!("{name}: a label is not in the document"));
        }
    }
    faults
}

#[test]
fn every_template_in_two_languages() {
    // To look at some only: HODOGRAPH_ONLY=crank-rocker,shaper
    let only = std::env::var("HODOGRAPH_ONLY").unwrap_or_default();
    let wanted = |name: &str| only.is_empty() || only.split(',').any(|o| o == name);
    let names: Vec<&str> =
        templates::list().iter().step_by(every(8)).map(|t| t.name).filter(|n| wanted(n)).collect();
    let faults: Vec<String> =
        names.iter().flat_map(|n| sheets_of(n, &[], &[Lang::En, Lang::Zh])).collect();
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn all_around_the_crank() {
    let mut faults = Vec::new();
    for name in ["crank-rocker", "slotted-lever", "offset-slider-crank"] {
        for degrees in (15..360).step_by(45) {
            faults.extend(sheets_of(name, &[("phi_1", &degrees.to_string())], &[Lang::En]));
        }
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn a_fixed_sheet_is_kept() {
    let text = text_on(r#""A4 landscape""#);
    let scene = scene::read(text).unwrap().value;
    let worked = work(&scene, Scope::Figure).unwrap().value;
    let figure = sheet(&scene, &worked, &SheetOptions::of_language(Lang::En)).unwrap();
    assert_eq!((figure.width_mm, figure.height_mm), (297.0, 210.0));
    assert_eq!(check("a4", &scene, &worked, &figure), Vec::<String>::new());
    ink(&figure, "a4");
    let small = text_on(r#"["120 mm", "80 mm"]"#);
    let scene = scene::read(small).unwrap().value;
    let worked = work(&scene, Scope::Figure).unwrap().value;
    let faults = sheet(&scene, &worked, &SheetOptions::of_language(Lang::En)).unwrap_err();
    assert_eq!(faults.list[0].code, "paper-too-small");
}

fn text_on(size: &str) -> String {
    templates::get("crank-rocker").unwrap().replacen(
        '{',
        &format!(r#"{{"paper": {{"size": {size}}},"#),
        1,
    )
}
