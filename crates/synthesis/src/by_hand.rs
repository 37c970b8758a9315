//! Tolerances of a construction drawn with pencil and ruler, by repeated drawing with errors.
//!
//! Every place laid off, opening of the compasses, intersection of bisectors, rotated place and
//! reading has the pencil's error, as marks of scenes do ([`Blunt`](hodograph_board::construct::pencil::Blunt)); given angles are laid off
//! exactly. The tolerance of a reading is the bound that contains 95 of 100 drawings.

use super::board::PaperReading;
use super::{DesignCandidate, SynthesisBoard, Task};
use hodograph_board::construct::pencil::bounds;
use hodograph_board::construct::pencil_mm;

/// Returns the tolerances of a board's readings in their order (m or rad), which contain 95 of 100
/// drawings with this pencil. `None` where too many drawings fail, because circles that just meet
/// miss one another.
pub fn tolerances(
    task: &Task,
    candidate: &DesignCandidate,
    board: &SynthesisBoard,
) -> Vec<Option<f64>> {
    bounds(pencil_mm(&task.paper), board.readings.len(), |pencil| {
        let mut hand = SynthesisBoard::by_hand(board.mu_l, pencil);
        if task.wish.construct(&candidate.draft, &mut hand).is_none() {
            return Vec::new();
        }
        let error = |(exact, read): (&PaperReading, &PaperReading)| {
            (read.name == exact.name).then(|| (board.value(read) - board.value(exact)).abs())
        };
        board.readings.iter().zip(&hand.readings).map(error).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{KINDS, construct, read, solve, templates};
    use hodograph_base::geom::Point;
    use hodograph_board::construct::pencil::Blunt;

    /// A point has one mark, however often the construction uses it.
    #[test]
    fn a_point_is_marked_once() {
        let mut seen = 0;
        for kind in KINDS {
            let task = read(templates::get(kind.name).unwrap()).unwrap().value;
            let design = solve(&task).unwrap();
            for candidate in &design.candidates {
                let Some(board) = construct(&task, candidate, 1e-3).unwrap() else { continue };
                let mut hand = SynthesisBoard::by_hand(board.mu_l, Blunt::new(0.1, 3));
                if task.wish.construct(&candidate.draft, &mut hand).is_none() {
                    continue;
                }
                let mut marks: Vec<&str> =
                    hand.steps.iter().flat_map(|s| &s.marks).map(|m| m.0.as_str()).collect();
                let exact = board.steps.iter().flat_map(|s| &s.marks).count();
                assert_eq!(marks.len(), exact, "{}: {marks:?}", kind.name);
                marks.sort_unstable();
                let all = marks.len();
                marks.dedup();
                assert_eq!(marks.len(), all, "{}", kind.name);
                let place = Point::new(0.125, -0.25);
                assert_eq!(hand.at(place), hand.at(place));
                seen += all;
            }
        }
        assert!(seen > 50, "{seen}");
    }

    /// In `body`, the given origins E are laid off once, not at each use: B and C of a position
    /// have the error of the lengths laid off from its one E, and BC that of two lengths laid off
    /// and two ends read, each with σ = 0.1 mm/2.448 along it: 1.96 σ √4 = 0.160 mm.
    #[test]
    fn given_positions_are_laid_off_once() {
        let task = read(templates::get("body").unwrap()).unwrap().value;
        let design = solve(&task).unwrap();
        let board = construct(&task, &design.candidates[0], 1e-3).unwrap().unwrap();
        let at = board.readings.iter().position(|r| r.name == "BC").unwrap();
        let off_mm = tolerances(&task, &design.candidates[0], &board)[at].unwrap() / board.mu_l;
        assert!((0.144..0.176).contains(&off_mm), "{off_mm}");
    }

    /// A blunter pencil has larger errors: in proportion, except where circles nearly touch, whose
    /// intersections depend on the square root. No reading of a template is hopeless, and every run
    /// gives the same result.
    #[test]
    fn tolerances_grow_with_the_pencil() {
        for kind in KINDS {
            let text = templates::get(kind.name).unwrap();
            let with = |pencil: &str| {
                text.replacen('{', &format!("{{\"paper\": {{\"pencil\": \"{pencil}\"}},"), 1)
            };
            let of = |pencil: &str| {
                let task = read(with(pencil)).unwrap().value;
                let design = solve(&task).unwrap();
                let candidate = &design.candidates[0];
                let board = construct(&task, candidate, 1e-3).unwrap().unwrap();
                (tolerances(&task, candidate, &board), board.readings)
            };
            let ((fine, readings), (blunt, _)) = (of("0.05 mm"), of("0.1 mm"));
            assert_eq!(fine, of("0.05 mm").0);
            for ((fine, blunt), reading) in fine.iter().zip(&blunt).zip(&readings) {
                let (fine, blunt) = (fine.unwrap(), blunt.unwrap());
                // An angle that is laid off and read with the protractor is exact.
                assert!(fine > 0.0 || reading.angle, "{}: {}", kind.name, reading.name);
                assert!(
                    fine == 0.0 || (1.05..2.5).contains(&(blunt / fine)),
                    "{} {}: {fine} {blunt}",
                    kind.name,
                    reading.name
                );
            }
        }
    }
}
