//! Drawings of the places of a coupler point: B on the crank's circle or turned back about A, D
//! moved back with the coupler, and the centre of its places.

use crate::board::{SynthesisBoard, Weight};
use hodograph_base::diag::{Both, both};
use hodograph_base::digits::significant;
use hodograph_base::geom::{Point, Vec2};

/// Crank and BE given: B at the intersection of two circles, and D, if not given, without a
/// construction. Arguments in metres.
pub fn by_lengths(
    board: &mut SynthesisBoard,
    e: &[Point],
    [a, d]: [Point; 2],
    [crank, be]: [f64; 2],
    sides: &[bool],
) -> Option<()> {
    let (a, e) = (board.at(a), e.iter().map(|p| board.at(*p)).collect::<Vec<Point>>());
    board.step(both!("Lay off A, D, the places of E and the crank circle"));
    let radius = board.mm(crank);
    board.circle(a, radius, Weight::Given);
    let d = laid(board, a, d, &e);
    let [centres, pins] = ["E", "B"].map(|letter| numbered(letter, "", 1..=e.len()));
    board.step(both!("With BE as opening about {} cut the crank circle: {}", centres, pins));
    let opening = board.mm(be);
    let mut b = Vec::new();
    for (k, (at, left)) in e.iter().zip(sides).enumerate() {
        let [one, other] = board.circles(a, radius, *at, opening)?;
        let pin = if *left { one } else { other };
        board.arc(*at, pin).line(pin, *at, Weight::Given).mark(&format!("B_{}", k + 1), pin);
        b.push(pin);
    }
    follower(board, [a, d], &e, &b)
}

/// The crank's rotations given: E turned back about A, B₁ the centre of its places.
pub fn by_turns(
    board: &mut SynthesisBoard,
    e: &[Point],
    [a, d]: [Point; 2],
    turns: &[f64],
) -> Option<()> {
    let (a, e) = (board.at(a), e.iter().map(|p| board.at(*p)).collect::<Vec<Point>>());
    board.step(both!("Lay off A, D and the places of E"));
    let d = laid(board, a, d, &e);
    let by: Vec<String> = turns[1..]
        .iter()
        .map(|t| format!("{}°", significant((t - turns[0]).to_degrees(), 5)))
        .collect();
    let by = Both::names(&by);
    let (places, back) = (numbered("E", "", 2..=e.len()), numbered("E", "'", 2..=e.len()));
    board.step(both!("Turn {} about A back with the crank, by {}: {}", places, by, back));
    let turned: Vec<Point> = (1..e.len())
        .map(|k| a + (e[k] - a).rotate_by(Vec2::from_angle(turns[0] - turns[k])))
        .collect();
    for (k, at) in turned.iter().enumerate() {
        board.arc(a, *at).mark(&format!("E_{}'", k + 2), *at);
    }
    let pins = numbered("B", "", 2..=e.len());
    board.step(both!(
        "The bisectors of E1, E2', E3' meet at B1; {} lie on the crank's circle",
        pins
    ));
    let first = board.centre(e[0], turned[0], turned[1])?;
    for further in turned.iter().skip(2) {
        board.read("BE", first, *further);
    }
    let b: Vec<Point> =
        turns.iter().map(|t| a + (first - a).rotate_by(Vec2::from_angle(t - turns[0]))).collect();
    board.circle(a, a.distance(first), Weight::Thin).read("BE", first, e[0]);
    for (k, pin) in b.iter().enumerate() {
        board.line(*pin, e[k], Weight::Given).mark(&format!("B_{}", k + 1), *pin);
    }
    follower(board, [a, d], &e, &b)
}

/// A letter with the numbers of places: `E1, E2, E3`.
fn numbered(letter: &str, dash: &str, of: std::ops::RangeInclusive<usize>) -> Both {
    let all: Vec<String> = of.map(|k| format!("{letter}{k}{dash}")).collect();
    Both::names(&all)
}

/// Marks the givens; returns D on the paper.
fn laid(board: &mut SynthesisBoard, a: Point, d: Point, e: &[Point]) -> Point {
    let d = board.at(d);
    board.mark("A", a).mark("D", d);
    for (k, at) in e.iter().enumerate() {
        board.mark(&format!("E_{}", k + 1), *at);
    }
    d
}

/// D moved back with the coupler; the circle through its first three places, on which any further
/// place lies.
fn follower(
    board: &mut SynthesisBoard,
    [a, d]: [Point; 2],
    e: &[Point],
    b: &[Point],
) -> Option<()> {
    board.step(both!(
        "Carry D back with the coupler BE into position 1: {}",
        numbered("D", "'", 2..=e.len())
    ));
    let mut places = vec![d];
    for k in 1..e.len() {
        let back = board.transfer(d, [b[k], e[k]], [b[0], e[0]])?;
        board.mark(&format!("D_{}'", k + 1), back);
        places.push(back);
    }
    board.step(both!("The bisectors of D, D2', D3' meet at C1"));
    let c = board.centre(places[0], places[1], places[2])?;
    board.mark("C_1", c).read("CD", c, d);
    for further in places.iter().skip(3) {
        board.read("CD", c, *further);
    }
    board.step(both!("Draw the linkage AB1C1D with E1"));
    board.line(a, b[0], Weight::Result).line(b[0], c, Weight::Result).line(c, d, Weight::Result);
    board
        .line(b[0], e[0], Weight::Result)
        .line(e[0], c, Weight::Result)
        .read("BC", b[0], c)
        .read("CE", c, e[0])
        .read("AB", a, b[0]);
    Some(())
}
