use super::*;
use crate::paper::arrow::ArrowHead;
use crate::paper::item::Anchor;
use crate::paper::label::Label;

fn figure(items: Vec<FigureItem>) -> Figure {
    Figure {
        width_mm: 100.0,
        height_mm: 50.0,
        title: "A < B".into(),
        desc: "two \"things\"".into(),
        lang: "en".into(),
        paper: Colour::WHITE,
        items,
    }
}

fn line(id: &str, from: Point, to: Point) -> FigureItem {
    FigureItem::new("link", Shape::Line { from, to, stroke: LineStroke::new(0.7) }).with_id(id)
}

fn label(source: &str) -> FigureItem {
    let shape = Shape::Label {
        at: Point::new(10.0, 10.0),
        label: Label::math(source),
        size_mm: 4.0,
        anchor: Anchor::Start,
        colour: Colour::BLACK,
    };
    FigureItem::new("label", shape)
}

#[test]
fn y_is_turned_over_here() {
    let svg = write(&figure(vec![line("l1", Point::new(0.1 + 0.2, 0.0), Point::new(20.0, 40.0))]))
        .unwrap()
        .value;
    assert!(svg.contains(r#"id="l1""#) && svg.contains(r#"class="link""#), "{svg}");
    assert!(svg.contains(r#"x1="0.3" x2="20" y1="50" y2="10""#), "{svg}");
    assert!(
        svg.contains(r#"width="100mm""#)
            && svg.contains(r#"viewBox="0 0 100 50""#)
            && svg.contains(r#"role="img""#)
    );
    assert!(svg.contains("<title>A &lt; B</title>"), "{svg}");
}

#[test]
fn counter_clockwise_stays_counter_clockwise() {
    let arc = |to_rad| {
        let shape = Shape::Arc {
            centre: Point::new(50.0, 25.0),
            radius_mm: 10.0,
            from_rad: 0.0,
            to_rad,
            stroke: LineStroke::new(0.2),
        };
        write(&figure(vec![FigureItem::new("", shape)])).unwrap().value
    };
    // From the right to the top of the paper: y 25 to y 15 in the file, counter-clockwise.
    assert!(arc(std::f64::consts::FRAC_PI_2).contains("M60 25A10 10 0 0 0 50 15"));
    assert!(arc(-std::f64::consts::FRAC_PI_2).contains("M60 25A10 10 0 0 1 50 35"));
    assert_eq!(arc(std::f64::consts::TAU).matches("A10").count(), 3);
}

#[test]
fn letters_are_drawn_once_and_used() {
    let svg = write(&figure(vec![label("v_{B3B2}^r")])).unwrap().value;
    // v; B, 3, 2 and r in the smaller size. The second B is used again.
    assert_eq!((svg.matches("<path").count(), svg.matches("<use").count()), (5, 6), "{svg}");
    assert!(svg.contains(r#"transform="translate(10 40)scale(0.004)""#), "{svg}");
    assert!(
        svg.contains(r#"data-text="v_{B3B2}^r""#) && svg.contains(r#"aria-label="v_B3B2^r""#),
        "{svg}"
    );
    for used in svg.split("xlink:href=\"#").skip(1).map(|s| s.split('"').next().unwrap()) {
        assert!(svg.contains(&format!("id=\"{used}\"")), "{used} is nowhere defined");
    }
    let d = svg.split(" d=\"").nth(1).unwrap().split('"').next().unwrap();
    assert!(!d.contains('.') && d.starts_with('m'), "{d}");
    assert!(!write(&figure(vec![label("")])).unwrap().value.contains("defs"));
}

#[test]
fn same_figure_same_bytes() {
    let arrow = Shape::Arrow {
        from: Point::ORIGIN,
        to: Point::new(30.0, 20.0),
        stroke: LineStroke::new(0.4),
        head: ArrowHead::VECTOR,
    };
    let f = figure(vec![
        FigureItem::new("velocity edge", arrow).with_id("e1"),
        label(r"\omega_1"),
        line("", Point::ORIGIN, Point::new(1.0, 1.0)),
    ]);
    let first = write(&f).unwrap().value;
    for _ in 0..5 {
        assert_eq!(write(&f).unwrap().value, first);
    }
}

#[test]
fn faults_are_collected() {
    let bad =
        figure(vec![line("nan", Point::new(f64::NAN, 0.0), Point::ORIGIN), label(r"\nosuch")]);
    let faults = write(&bad).unwrap_err();
    let codes: Vec<_> = faults.list.iter().map(|d| d.code).collect();
    assert_eq!(codes, ["not-finite", "label-syntax"]);
    assert!(faults.list[0].message.en.contains("nan"));
    let warned = write(&figure(vec![label("v \u{2620}")])).unwrap();
    assert_eq!(warned.notes[0].code, "missing-glyph");
}
