//! Drawings of a linkage found by search at all places of its path, with the distances of its
//! coupler point from them.

use crate::board::{SynthesisBoard, Weight};
use crate::candidate::{DesignNumber, Draft};
use crate::laid::{LaidFourBar, numbered, shown, side};
use crate::statement::of;
use hodograph_base::diag::both;
use hodograph_base::geom::{Point, Vec2};

/// A distance below this share of the path is rounding.
const NOTHING: f64 = 1e-12;

/// The least distance (mm) at which E is named separately from its place.
const APART_MM: f64 = 1.0;

/// The distances of the coupler point from the drawn places (m).
pub fn distances(far: &[f64], extent: f64) -> Vec<DesignNumber> {
    let what = both!("distance of E from the place");
    let told = |v: f64| if v < NOTHING * extent { 0.0 } else { v };
    shown(far.len())
        .into_iter()
        .map(|k| DesignNumber::length(&format!("delta{}", k + 1), what.clone(), told(far[k])))
        .collect()
}

/// Lays off the computed lengths, with the crank at its angle for each place, and reads the
/// distances.
pub fn drawn(board: &mut SynthesisBoard, draft: &Draft) -> Option<()> {
    let a = Point::new(of(draft, "A_x"), of(draft, "A_y"));
    let d = a + Vec2::from_angle(of(draft, "phi")) * of(draft, "AD");
    let laid =
        LaidFourBar::off(board, draft, [a, d], Some(Vec2::new(of(draft, "u"), of(draft, "v"))));
    let all = shown(draft.targets.len());
    let which: Vec<usize> = all.iter().map(|k| k + 1).collect();
    board.step(both!("Lay off the wanted places {}", numbered("P", &which)));
    let targets: Vec<Point> = all.iter().map(|k| board.at(draft.targets[*k])).collect();
    for (k, at) in which.iter().zip(&targets) {
        board.mark(&format!("P_{k}"), *at);
    }
    board.step(both!(
        "Lay off the computed lengths: A and D, the crank circle AB and the follower's circle CD"
    ));
    board.line(laid.a, laid.d, Weight::Given).circle(laid.a, laid.crank, Weight::Thin).circle(
        laid.d,
        laid.follower,
        Weight::Thin,
    );
    board.mark("A", laid.a).mark("D", laid.d);
    board.step(both!(
        "For each place draw the crank at its angle, C with BC as opening about B, E by the set square on BC: {}",
        numbered("E", &which)
    ));
    let mut first = None;
    for (k, target) in all.iter().zip(&targets) {
        let wanted = draft.wanted.get(*k)?;
        let pins = laid.at(board, wanted.driver, side(wanted, d)?)?;
        board.arc(pins.b, pins.c).arc(laid.d, pins.c).line(pins.b, pins.c, Weight::Thin).line(
            pins.b,
            pins.e,
            Weight::Thin,
        );
        board.line(pins.c, pins.e, Weight::Thin).mark(&format!("B_{}", k + 1), pins.b);
        if pins.e.distance(*target) > APART_MM {
            board.mark(&format!("E_{}", k + 1), pins.e);
        }
        board.read(&format!("delta{}", k + 1), pins.e, *target);
        first = first.or(Some(pins));
    }
    board.step(both!(
        "Draw the linkage at place 1; read the distances of {} from {}",
        numbered("E", &which),
        numbered("P", &which)
    ));
    laid.draw(board, &first?, Weight::Result);
    Some(())
}
