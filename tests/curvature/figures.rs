//! The figures of curvature: their descriptions, their lines, their labels.

use super::template;
use hodograph::figure::list::{Extras, FigureInput, named};
use hodograph::figure::sheet::SheetOptions;
use hodograph::geom::Point;
use hodograph::paper::extent::bounds;
use hodograph::paper::item::{Figure, FigureItem, PathPiece, Shape};
use hodograph::paper::shown::escaped;
use hodograph::scene::Lang;
use hodograph::worked::{Scope, work};

/// The curvature figures of a template with its crank at an angle, in a language.
fn figures(name: &str, angle: f64, lang: Lang) -> Vec<Figure> {
    let scene = template(name, &[("phi_1", &format!("{angle} deg"))]);
    let (worked, options) =
        (work(&scene, Scope::Figure).unwrap().value, SheetOptions::of_language(lang));
    let wanted = FigureInput {
        scene: &scene,
        worked: &worked,
        options: &options,
        extras: &Extras::default(),
    };
    (named("curvature").unwrap().draw)(&wanted)
        .unwrap()
        .value
        .into_iter()
        .map(|(_, page)| page)
        .collect()
}

/// The words of a page.
fn said(page: &Figure) -> Vec<String> {
    let text = |i: &FigureItem| {
        if let Shape::Label { label, .. } = &i.shape { label.plain() } else { String::new() }
    };
    page.items.iter().map(text).collect()
}

/// A figure whose places are drawn does not call them calculated; one that finds no pole on paper
/// does, in both languages.
#[test]
fn a_figure_says_what_is_calculated() {
    let words = |lang| match lang {
        Lang::En => "are shown where they are calculated",
        Lang::Zh => "位置由计算得到",
    };
    for lang in [Lang::En, Lang::Zh] {
        let calculated =
            |page: &Figure| said(page).iter().filter(|s| s.contains(words(lang))).count();
        for name in ["crank-rocker", "slider-crank", "watt-six-bar"] {
            for page in figures(name, 60.0, lang) {
                assert_eq!(calculated(&page), 0, "{name}: {:?}", said(&page));
            }
        }
        let pages = figures("class-iv-six-bar", 60.0, lang);
        assert!(pages.iter().any(|page| calculated(page) == 1));
    }
}

/// The lines to Ball's point end there: both corners are named, the line of the corners passes
/// through G, that of T through J, and the perpendicular from P ends in U. Where the paper does not
/// hold all of them, none is drawn.
#[test]
fn the_lines_to_the_point_of_ball_are_drawn() {
    for lang in [Lang::En, Lang::Zh] {
        let page = figures("crank-rocker", 255.0, lang).remove(0);
        let spot = |name: &str| {
            let found = page.items.iter().find(|i| i.id == format!("mechanism-{}", escaped(name)));
            match found.unwrap_or_else(|| panic!("no {name}")).shape {
                Shape::Circle { centre, .. } => centre,
                ref other => panic!("{name}: {other:?}"),
            }
        };
        // Dashed lines are paths of dashes: the ends of the first and of the last dash.
        let ends = |shape: &Shape| match shape {
            Shape::Line { from, to, .. } => [*from, *to],
            Shape::Path { start, pieces, .. } => match pieces.last() {
                Some(PathPiece::Line(to)) => [*start, *to],
                other => panic!("{other:?}"),
            },
            other => panic!("{other:?}"),
        };
        let lines: Vec<[Point; 2]> =
            page.items.iter().filter(|i| i.id.contains("ball-")).map(|i| ends(&i.shape)).collect();
        let carries = |p: Point| {
            lines
                .iter()
                .filter(|[a, b]| ((*b - *a).unit().unwrap().cross(p - *a)).abs() < 0.05)
                .count()
        };
        // Two sides of its rectangle and the line of the corners; that line, the parallel and the
        // perpendicular; the two lines that end in U.
        for (name, least) in [("G_B", 3), ("G_C", 3), ("G", 3), ("U_2", 2)] {
            assert!(carries(spot(name)) >= least, "{name}: {}", carries(spot(name)));
        }
        assert!(
            !figures("crank-rocker", 60.0, lang)[0].items.iter().any(|i| i.id.contains("ball-"))
        );
    }
}

/// Labels do not overlap on any figure, over positions and in both languages.
#[test]
fn labels_do_not_overlap() {
    let (mut figures, mut faults) = (0, Vec::new());
    for name in ["crank-rocker", "slider-crank", "shaper", "watt-six-bar", "oscillating-cylinder"] {
        for k in 0..3 {
            let scene = template(name, &[("phi_1", &format!("{} deg", 23 + 120 * k))]);
            let Ok(worked) = work(&scene, Scope::Figure) else { continue };
            for lang in [Lang::En, Lang::Zh] {
                let options = SheetOptions::of_language(lang);
                let wanted = FigureInput {
                    scene: &scene,
                    worked: &worked.value,
                    options: &options,
                    extras: &Extras::default(),
                };
                for figure in ["curvature", "centrodes"] {
                    for (word, page) in (named(figure).unwrap().draw)(&wanted).unwrap().value {
                        let labels: Vec<_> = page
                            .items
                            .iter()
                            .filter(|i| matches!(i.shape, Shape::Label { .. }))
                            .collect();
                        let boxes: Vec<_> = labels
                            .iter()
                            .map(|i| bounds(std::slice::from_ref(*i)).unwrap())
                            .collect();
                        figures += 1;
                        for i in 0..boxes.len() {
                            for j in 0..i {
                                if boxes[i].overlap_mm2(boxes[j]) > 0.05 {
                                    faults.push(format!(
                                        "{name} {k} {lang:?} {word}: {} {}",
                                        labels[i].id, labels[j].id
                                    ));
                                }
                            }
                        }
                    }
                }
            }
        }
    }
    assert!(
        figures > 50 && faults.is_empty(),
        "{figures} figures, {}:\n{}",
        faults.len(),
        faults.join("\n")
    );
}
