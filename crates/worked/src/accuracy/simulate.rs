//! Repeated drawing with a blunt pencil, and the errors of the readings.

use super::drafting::DraftedConstruction;
use hodograph_base::geom::Vec2;
use hodograph_board::construct::Layout;
use hodograph_board::construct::pencil::Blunt;
use hodograph_mechanism::answer::AnswerValue;
use hodograph_scene::{Asked, Kind};

/// The errors of one answer over many drawings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawingErrors {
    /// The error (SI) that half of the drawings stay within; infinite if half of them fail.
    pub median: f64,
    /// The error that 95 % of the drawings stay within.
    pub within_95: f64,
    /// Both errors as parts of the answer; `None` for an answer of zero.
    pub relative: Option<[f64; 2]>,
}

/// Draws the scene `runs` times with a pencil of the given error (mm), to the scales of the
/// finished construction. Returns the errors of each question's answer; `None` for questions that
/// are not drawn, and if `runs` is zero.
///
/// The error of a vector is the length of the difference, so that a wrong direction counts too. A
/// drawing in which the pencil made two lines parallel has an infinite error. The same seed gives
/// the same numbers.
pub fn simulate(
    drawn: &DraftedConstruction,
    pencil_mm: f64,
    runs: usize,
    seed: u64,
) -> Vec<Option<DrawingErrors>> {
    let layout = Layout::of(drawn.construction);
    let mut pencil = Blunt::new(pencil_mm, seed);
    let mut errors: Vec<Vec<f64>> = vec![Vec::with_capacity(runs); drawn.values.len()];
    for _ in 0..runs {
        let read = drawn.read_with(&layout, &mut pencil).ok();
        for (find, list) in errors.iter_mut().enumerate() {
            let read = read.as_ref().and_then(|r| r[find]);
            list.push(match (read, drawn.values[find]) {
                (Some(a), Some(b)) => difference(&drawn.scene.find[find].what, a, b).norm(),
                _ => f64::INFINITY,
            });
        }
    }
    let of = |(list, value): (Vec<f64>, &Option<AnswerValue>)| summary(list, (*value)?.magnitude());
    errors.into_iter().zip(&drawn.values).map(of).collect()
}

/// The difference of two answers, a number as a vector along x; angles by the shorter way round.
fn difference(what: &Asked, a: AnswerValue, b: AnswerValue) -> Vec2 {
    match (a, b) {
        (AnswerValue::Vector(a), AnswerValue::Vector(b)) => a - b,
        (AnswerValue::Point(a), AnswerValue::Point(b)) => a - b,
        (AnswerValue::Scalar(a), AnswerValue::Scalar(b)) if what.kind() == Kind::Angle => {
            Vec2::new(Vec2::from_angle(a - b).angle(), 0.0)
        }
        (AnswerValue::Scalar(a), AnswerValue::Scalar(b)) => Vec2::new(a - b, 0.0),
        (AnswerValue::Vector(_) | AnswerValue::Scalar(_) | AnswerValue::Point(_), _) => {
            Vec2::new(f64::INFINITY, 0.0)
        }
    }
}

fn summary(mut errors: Vec<f64>, size: f64) -> Option<DrawingErrors> {
    errors.sort_by(f64::total_cmp);
    // The smallest error that the part `p` of the drawings does not exceed.
    let within =
        |p: f64| errors.get(((p * errors.len() as f64).ceil() as usize).saturating_sub(1)).copied();
    let (median, within_95) = (within(0.5)?, within(0.95)?);
    Some(DrawingErrors {
        median,
        within_95,
        relative: (size > 0.0).then(|| [median / size, within_95 / size]),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn median_and_95_percent_of_twenty() {
        let e = summary((1..=20).rev().map(f64::from).collect(), 2.0).unwrap();
        assert_eq!((e.median, e.within_95, e.relative), (10.0, 19.0, Some([5.0, 9.5])));
        assert_eq!(summary(Vec::new(), 1.0), None);
        assert_eq!(summary(vec![1.0], 0.0).unwrap().relative, None);
    }
}
