use std::sync::LazyLock;

use super::*;
use crate::paper::extent::{Rect, bounds};
use crate::paper::item::{FigureItem, PathPiece, Shape};
use crate::paper::place::Obstacles;
use crate::paper::style::Style;
use hodograph_base::geom::{Point, Vec2};

static STYLE: LazyLock<Style> = LazyLock::new(Style::default);

fn boxed(items: &[FigureItem]) -> Rect {
    bounds(items).expect("a symbol has ink")
}

#[test]
fn hatching_lies_on_the_right() {
    let ground = boxed(&ground_line(&STYLE, Point::ORIGIN, Point::new(20.0, 0.0)));
    assert!(ground.min.y < -1.7 && ground.max.y < 0.3, "{ground:?}");
    let other = boxed(&ground_line(&STYLE, Point::new(20.0, 0.0), Point::ORIGIN));
    assert!(other.max.y > 1.7 && other.min.y > -0.3, "{other:?}");
    assert!(ground_line(&STYLE, Point::ORIGIN, Point::ORIGIN).is_empty());
}

#[test]
fn pivot_stands_on_the_side_it_is_told() {
    let down = boxed(&fixed_pivot(&STYLE, Point::ORIGIN, Vec2::new(0.0, -1.0)));
    assert!(down.min.y < -6.0 && down.max.y < 1.5, "{down:?}");
    let left = boxed(&fixed_pivot(&STYLE, Point::ORIGIN, Vec2::new(-2.0, 0.0)));
    assert!(left.min.x < -6.0 && left.max.x < 1.5, "{left:?}");
}

#[test]
fn slot_is_as_wide_as_it_says_in_every_direction() {
    let h = boxed(&slot(&STYLE, Point::ORIGIN, Point::new(20.0, 0.0)));
    let ink = STYLE.outline.width_mm;
    assert!(
        (h.height_mm() - STYLE.slot_width_mm - ink).abs() < 1e-9
            && (h.width_mm() - 20.0 - STYLE.slot_width_mm - ink).abs() < 1e-9
    );
    let v = boxed(&slot(&STYLE, Point::new(0.0, 20.0), Point::ORIGIN));
    assert!(
        (v.width_mm() - h.height_mm()).abs() < 1e-9 && (v.height_mm() - h.width_mm()).abs() < 1e-9
    );
}

/// Checks that each arc begins at the current point of the path: SVG draws from there, whatever
/// `from_rad` is.
#[test]
fn slots_are_joined_without_a_gap() {
    let turned = slot(&STYLE, Point::new(1.0, 2.0), Point::new(-5.0, 9.0));
    for item in turned.iter().chain(&slot_arc(&STYLE, Point::new(3.0, 4.0), 15.0, 2.0, 0.4)) {
        let Shape::Path { start, pieces, .. } = &item.shape else { panic!("a slot is one path") };
        let mut here = *start;
        for piece in pieces {
            match *piece {
                PathPiece::Move(p) | PathPiece::Line(p) => here = p,
                PathPiece::Arc { centre, radius_mm, from_rad, to_rad } => {
                    assert!(
                        here.distance(centre + Vec2::from_angle(from_rad) * radius_mm) < 1e-9,
                        "{piece:?} begins elsewhere"
                    );
                    here = centre + Vec2::from_angle(to_rad) * radius_mm;
                }
            }
        }
        assert!(here.distance(*start) < 1e-9, "closed");
    }
}

#[test]
fn piston_stays_in_the_barrel() {
    for reach in [10.0, 22.0, 35.0, 60.0] {
        let items = cylinder(&STYLE, Point::ORIGIN, Point::new(reach, 0.0), 18.0);
        let barrel = items.iter().find(|i| i.class == "cylinder").unwrap().bounds().unwrap();
        let piston = items.iter().find(|i| i.class.contains("piston")).unwrap().bounds().unwrap();
        assert!(
            piston.min.x > barrel.min.x && piston.max.x < barrel.max.x,
            "{reach}: {piston:?} in {barrel:?}"
        );
    }
}

#[test]
fn symbols_are_obstacles() {
    let all = Obstacles::of(&fixed_pivot(&STYLE, Point::ORIGIN, Vec2::ZERO));
    assert_eq!((all.discs.len(), all.heads.len()), (1, 0));
    // Three sides, the ground line, and a stroke of hatching for each pitch.
    assert_eq!(all.bars.len(), 4 + (2.0 * STYLE.ground_half_mm / STYLE.hatch_pitch_mm) as usize);
    assert_eq!(Obstacles::of(&rotation(&STYLE, Point::ORIGIN, 8.0, 0.0, 2.0)).heads.len(), 1);
}

#[test]
fn dimension_is_beside_its_thing() {
    let d = boxed(&dimension(&STYLE, Point::ORIGIN, Point::new(30.0, 0.0), -8.0));
    assert!(d.min.y < -8.0 && d.max.y < -1.0, "{d:?}");
}
