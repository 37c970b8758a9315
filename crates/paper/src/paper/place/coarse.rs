//! Places more labels than the search can compare: one after the other, each where the paper is
//! still free.
//!
//! The paper is divided into small cells; ink and labels fill them, and a place costs what its
//! cells contain. The time per label is independent of the number of labels and of the amount of
//! ink, so the total time is linear in the number of labels. In a crowd the result is coarser than
//! that of [`super::search`]: an early label never moves to make space for a late one.
//!
//! # Source
//! Greedy placement on a bitmap of occupied space: I. Mote, *Fast point-feature label placement for
//! dynamic visualizations*, Information Visualization 6 (2007), with a raster instead of the
//! trellis.

use crate::paper::extent::Rect;
use hodograph_base::budget::spend;

use super::candidate::{self, CandidatePlace};
use super::obstacle::Obstacles;
use super::raster::{HEAVY, InkRaster, LINE};
use super::search::LEAVE;
use super::{ChosenPlace, Habit, LabelRequest, MeasuredRequest, Placement, cost};

/// Largest number of labels in a drawing that are placed by search; more are placed one after the
/// other. The busiest textbook figure has about sixty.
pub(super) const MANY: usize = 100;

/// Cost factor of a label on something heavy relative to one on a line.
const HEAVIER: f64 = 3.0;
/// Cost per square millimetre that a label covers.
const PER_MM2: f64 = 2.0;

/// Returns the cost of a place on the raster.
fn cost_of(raster: &mut InkRaster, place: &CandidatePlace, paper: Rect) -> f64 {
    let (lines, heavy) = raster.covered(place.rect);
    let area = raster.cell_mm() * raster.cell_mm();
    let covered =
        |cells: usize| if cells > 0 { cost::TOUCH + PER_MM2 * cells as f64 * area } else { 0.0 };
    place.base + covered(lines) + HEAVIER * covered(heavy) + cost::outside(place.rect, paper)
}

/// Returns a place for each label, `None` for optional ones without a clear place as in
/// [`super::place_or_leave`], and the number of raster cells examined.
pub(super) fn place(
    requests: &[LabelRequest],
    obstacles: &Obstacles,
    paper: Rect,
    before: &[Option<Habit>],
) -> (Vec<Option<Placement>>, usize) {
    let mut raster = InkRaster::of(obstacles, paper);
    let mut out = vec![None; requests.len()];
    // Optional names take the space that the others leave.
    let (last, first): (Vec<usize>, Vec<usize>) =
        (0..requests.len()).partition(|i| requests[*i].optional);
    for i in first.into_iter().chain(last) {
        spend();
        let wanted = MeasuredRequest::new(&requests[i]);
        let stood = match before.get(i).copied().flatten() {
            Some(Habit::At(index)) => Some(index),
            Some(Habit::LeftOut) | None => None,
        };
        let found = best(&mut raster, &wanted, paper, stood, requests[i].optional);
        if requests[i].optional && found.1 >= cost::TOUCH {
            continue;
        }
        raster.fill(found.0.rect, HEAVY);
        if let Some((from, to)) = found.0.leader {
            raster.fill_bar(from, to, 0.0, LINE);
        }
        out[i] = Some(wanted.placement(found));
    }
    (out, raster.touched())
}

/// Returns the cheapest place of a label, the first among equals; far places are considered only if
/// all near ones cover something.
fn best(
    raster: &mut InkRaster,
    wanted: &MeasuredRequest,
    paper: Rect,
    stood: Option<usize>,
    near_only: bool,
) -> ChosenPlace {
    let near = candidate::near(wanted);
    let count = near.len();
    let mut best: Option<(ChosenPlace, f64)> = None;
    let mut look = |raster: &mut InkRaster, index: usize, place: CandidatePlace| {
        let leave = if stood.is_some_and(|s| s != index) { LEAVE } else { 0.0 };
        if best.is_none_or(|(_, least)| place.base + leave < least) {
            let cost = cost_of(raster, &place, paper);
            if best.is_none_or(|(_, least)| cost + leave < least) {
                best = Some(((place, cost, index), cost + leave));
            }
        }
        best.is_some_and(|(_, least)| least >= cost::TOUCH)
    };
    let mut poor = true;
    for (index, place) in near.into_iter().enumerate() {
        poor = look(raster, index, place);
    }
    if poor && !near_only || stood.is_some_and(|s| s >= count) {
        for (k, place) in candidate::far(wanted).into_iter().enumerate() {
            look(raster, count + k, place);
        }
    }
    best.expect("every label has places near its thing").0
}

#[cfg(test)]
mod tests {
    use super::super::raster::CELL_MM;
    use super::*;
    use crate::paper::label::Label;
    use hodograph_base::geom::{Point, Vec2};

    /// Points on a spiral at the closest spacing, with a line from each to the next.
    fn crowd(n: usize, side_mm: f64) -> (Vec<LabelRequest>, Obstacles, Rect) {
        let at = |k: usize| {
            Point::ORIGIN
                + Vec2::from_angle(2.4 * k as f64) * (0.5 * side_mm * (k as f64 / n as f64).sqrt())
        };
        let mut obstacles = Obstacles::default();
        for k in 0..n {
            obstacles.bars.push(super::super::Bar {
                from: at(k),
                to: at(k + 1),
                half_width_mm: 0.2,
                owner: None,
                faint: false,
            });
            obstacles.discs.push(super::super::InkDisc { centre: at(k), radius_mm: 0.6 });
        }
        let requests = (0..n)
            .map(|k| {
                LabelRequest::at_point(Label::math(format!("P_{k}")), 3.6, at(k), 0.8)
                    .optional(k % 3 == 0)
            })
            .collect();
        (requests, obstacles, Rect::new(at(0), at(0)).grown(0.5 * side_mm + 20.0))
    }

    /// Checks that twice as many labels take twice the work, spread out or crowded.
    #[test]
    fn work_grows_with_the_number_of_labels() {
        for spacing in [2.0, 12.0] {
            let mut last: Option<f64> = None;
            for n in [200, 400, 800, 1600] {
                let (requests, obstacles, paper) = crowd(n, spacing * (n as f64).sqrt());
                let (placed, touched) = place(&requests, &obstacles, paper, &[]);
                assert_eq!(placed.len(), n);
                let each = touched as f64 / n as f64;
                // A line of this crowd is as long as the crowd is wide.
                let lines =
                    obstacles.bars.iter().map(|b| b.from.distance(b.to) / CELL_MM).sum::<f64>()
                        / n as f64;
                let each = each - 9.0 * lines;
                assert!(
                    last.is_none_or(|last| each < 1.3 * last.max(1000.0)),
                    "{n} labels {spacing} mm apart: {each} cells each, {last:?} before"
                );
                last = Some(each);
            }
        }
    }

    #[test]
    fn where_there_is_room_nothing_is_covered() {
        let (requests, mut obstacles, paper) = crowd(400, 12.0 * 20.0);
        obstacles.bars.clear();
        let (placed, _) = place(&requests, &obstacles, paper, &[]);
        let all: Vec<Placement> = placed.iter().flatten().copied().collect();
        assert!(all.len() == requests.len() && all.iter().all(|p| p.cost < cost::TOUCH));
        for (k, a) in all.iter().enumerate() {
            for b in &all[..k] {
                assert!(a.bounds.overlap_mm2(b.bounds) == 0.0, "{a:?} {b:?}");
            }
        }
    }

    #[test]
    fn a_label_of_a_series_stays_and_one_beside_the_paper_is_no_fault() {
        let (mut requests, obstacles, paper) = crowd(200, 12.0 * 14.0);
        let first = place(&requests, &obstacles, paper, &[]).0;
        let habits: Vec<_> = first.iter().map(|p| p.map(|p| Habit::At(p.index))).collect();
        let again = place(&requests, &obstacles, paper, &habits).0;
        let kept = first.iter().zip(&again).filter(|(a, b)| a == b).count();
        assert!(kept > 190, "{kept} of 200 stay");
        requests[0] = LabelRequest::at_point(Label::math("Z"), 3.6, Point::new(1e9, -1e9), 0.8);
        assert!(place(&requests, &obstacles, paper, &[]).0[0].is_some());
    }
}
