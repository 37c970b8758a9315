//! A turn of the cam as a list of stages: rises, dwells and returns, each with a law over an angle.

use super::jet::CamJet;
use super::{MotionLaw, PieceSide, in_turn, whole_turns};
use crate::number::Real;
use std::f64::consts::TAU;

/// The motion of the follower in a stage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StageMotion<N = f64> {
    /// The follower goes out by this lift (m, rad) according to a law.
    Rise(N, MotionLaw),
    /// The follower rests.
    Dwell,
    /// The follower comes back by this lift (m, rad) according to a law.
    Return(N, MotionLaw),
}

/// A stage and the angle of the cam over which it extends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stage<N = f64> {
    /// The motion.
    pub way: StageMotion<N>,
    /// The angle of the cam (rad).
    pub over: N,
}

impl<N: Real> Stage<N> {
    /// Returns the change of the lift over the stage.
    pub fn gain(&self) -> N {
        match self.way {
            StageMotion::Rise(h, _) => h,
            StageMotion::Dwell => N::from_f64(0.0),
            StageMotion::Return(h, _) => -h,
        }
    }

    /// Returns the law of a rise or return; `None` for a dwell.
    pub fn law(&self) -> Option<MotionLaw> {
        match self.way {
            StageMotion::Rise(_, law) | StageMotion::Return(_, law) => Some(law),
            StageMotion::Dwell => None,
        }
    }
}

/// The stages of a turn, from the start of the law.
#[derive(Clone, Debug, PartialEq)]
pub struct StageProgram<N = f64> {
    stages: Vec<Stage<N>>,
    /// The angle of the cam and the lift at which each stage begins, and those after the last.
    starts: Vec<[N; 2]>,
}

/// The derivative of the lift that jumps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shock {
    /// The velocity: an infinite acceleration 刚性冲击.
    Rigid,
    /// The acceleration, by a finite step 柔性冲击.
    Soft,
}

impl Shock {
    /// Returns the order of the derivative that jumps.
    pub fn order(self) -> usize {
        match self {
            Shock::Rigid => 1,
            Shock::Soft => 2,
        }
    }
}

/// An angle of the cam at which the velocity or the acceleration jumps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jump {
    /// The angle of the cam (rad).
    pub phi: f64,
    /// The kind of shock.
    pub shock: Shock,
    /// s′ or s″ before and after the jump.
    pub sides: [f64; 2],
}

/// Angles closer than this (rad) are the same angle: a joint that is computed in two ways.
const ONE_PLACE: f64 = 1e-11;

impl<N: Real> StageProgram<N> {
    /// Creates the program of some stages, in order.
    pub fn new(stages: Vec<Stage<N>>) -> Self {
        let mut start = [N::from_f64(0.0); 2];
        let ends = stages.iter().map(|s| {
            start = [start[0] + s.over, start[1] + s.gain()];
            start
        });
        let starts = std::iter::once([N::from_f64(0.0); 2]).chain(ends).collect();
        StageProgram { stages, starts }
    }

    /// Returns the stages, in order.
    pub fn stages(&self) -> &[Stage<N>] {
        &self.stages
    }

    /// Returns the angles at which the stages begin, and the end of the last stage.
    pub fn joints(&self) -> Vec<N> {
        self.starts.iter().map(|[at, _]| *at).collect()
    }

    /// Returns all angles at which pieces of the laws meet.
    pub fn corners(&self) -> Vec<N> {
        let mut out = Vec::new();
        for (stage, &[start, _]) in self.stages.iter().zip(&self.starts) {
            out.push(start);
            let pieces = stage.law().map_or(&[][..], MotionLaw::pieces);
            out.extend(
                pieces
                    .iter()
                    .map(|p| p.end)
                    .filter(|e| *e < 1.0)
                    .map(|e| start + N::from_f64(e) * stage.over),
            );
        }
        out
    }

    /// Returns the greatest lift.
    pub fn stroke(&self) -> N {
        self.starts.iter().fold(N::from_f64(0.0), |most, &[_, lift]| {
            if lift.approx() > most.approx() { lift } else { most }
        })
    }

    /// Returns s, s′, s″, s‴ by the formula of a piece of the law of a stage; whole turns of φ do
    /// not count. The piece of a dwell is 0.
    pub fn lift_in(&self, (stage, piece): (usize, usize), phi: N) -> Option<CamJet<N>> {
        let [start, lift] = *self.starts.get(stage)?;
        let stage = self.stages.get(stage)?;
        let Some(law) = stage.law() else { return Some(CamJet::constant(lift)) };
        let from_start = phi - start;
        // An angle that rounding puts before the start is not moved to the end of the turn.
        let turns = libm::floor(from_start.approx() / TAU + ONE_PLACE);
        let x = (from_start - whole_turns(turns)) / stage.over;
        Some(stage.lifted(law.pieces().get(piece)?.at(x), lift))
    }
}

impl<N: Real> Stage<N> {
    /// Scales a normalized law to the stage, starting from a lift.
    fn lifted(&self, of_one: CamJet<N>, lift: N) -> CamJet<N> {
        let mut scale = self.gain();
        let mut out = of_one.0.map(|value| {
            let scaled = scale * value;
            scale = scale / self.over;
            scaled
        });
        out[0] = out[0] + lift;
        CamJet(out)
    }
}

impl StageProgram {
    /// Returns, for each stage, true if the last motion before it goes out: a dwell after a rise is
    /// the outer dwell.
    pub fn outer(&self) -> Vec<bool> {
        let behind = |k: usize| {
            self.stages[..k]
                .iter()
                .rev()
                .chain(self.stages[k..].iter().rev())
                .map(Stage::gain)
                .find(|gain| *gain != 0.0)
        };
        (0..self.stages.len()).map(|k| behind(k).is_some_and(|gain| gain > 0.0)).collect()
    }

    /// Returns the stage that contains φ, the angle at which it begins, and the lift there; at a
    /// joint the stage on the given side.
    pub fn stage(&self, phi: f64, side: PieceSide) -> Option<(usize, f64, f64)> {
        let turn = in_turn_of(phi, side);
        let behind = |[end, _]: &[f64; 2]| match side {
            PieceSide::Before => turn > end + ONE_PLACE,
            PieceSide::After => turn >= end - ONE_PLACE,
        };
        let last = self.stages.len().checked_sub(1)?;
        let i = self.starts[1..].partition_point(behind).min(last);
        let [at, lift] = self.starts[i];
        Some((i, at, lift))
    }

    /// Returns s, s′, s″, s‴ at an angle of the cam.
    pub fn lift(&self, phi: f64, side: PieceSide) -> CamJet {
        let Some((i, start, lift)) = self.stage(phi, side) else { return CamJet::constant(0.0) };
        let stage = &self.stages[i];
        let Some(law) = stage.law() else { return CamJet::constant(lift) };
        let x = stage.part(start, phi, side);
        // Rounding may miss a joint inside a law: an x close to the joint is set to it.
        let near =
            law.pieces().iter().map(|p| p.end).find(|e| (e - x).abs() * stage.over < ONE_PLACE);
        stage.lifted(CamJet(law.at(near.unwrap_or(x), side)), lift)
    }

    /// Returns the stage that applies at an angle of the cam, and the piece of its law.
    pub fn branch(&self, phi: f64, side: PieceSide) -> Option<(usize, usize)> {
        let (i, start, _) = self.stage(phi, side)?;
        let stage = &self.stages[i];
        let Some(law) = stage.law() else { return Some((i, 0)) };
        let x = stage.part(start, phi, side);
        let near =
            law.pieces().iter().map(|p| p.end).find(|e| (e - x).abs() * stage.over < ONE_PLACE);
        Some((i, law.place(near.unwrap_or(x), side == PieceSide::Before)))
    }
}

/// Returns an angle reduced by whole turns. The boundary between two turns belongs to the turn on
/// the given side, so an angle beside it may be slightly less than 0 or slightly more than 2π.
pub fn in_turn_of(phi: f64, side: PieceSide) -> f64 {
    let turn = in_turn(phi);
    match side {
        PieceSide::Before if turn <= ONE_PLACE => turn + TAU,
        PieceSide::After if turn >= TAU - ONE_PLACE => turn - TAU,
        PieceSide::Before | PieceSide::After => turn,
    }
}

impl Stage {
    /// Returns the part of a stage that begins at `start` which is completed at an angle of the
    /// cam.
    fn part(&self, start: f64, phi: f64, side: PieceSide) -> f64 {
        let turn = in_turn_of(phi, side);
        let turn = if turn + ONE_PLACE < start { turn + TAU } else { turn };
        ((turn - start) / self.over).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn deg(a: f64) -> f64 {
        a.to_radians()
    }

    /// Rise 20 in 120° cycloidal, dwell 60°, return in 120° harmonic, dwell 60°.
    fn program() -> StageProgram {
        let stage = |way, over| Stage { way, over: deg(over) };
        let stages = vec![
            stage(StageMotion::Rise(20.0, MotionLaw::Cycloidal), 120.0),
            stage(StageMotion::Dwell, 60.0),
            stage(StageMotion::Return(20.0, MotionLaw::Harmonic), 120.0),
            stage(StageMotion::Dwell, 60.0),
        ];
        StageProgram::new(stages)
    }

    /// Rounding at the boundary between two turns is no jump of the lift.
    #[test]
    fn a_turn_begins_where_the_last_one_ends() {
        for phi in [0.0, TAU, -TAU, 3.0 * TAU] {
            for off in [-1e-12, -1e-15, 0.0, 1e-15, 1e-12] {
                for side in [PieceSide::Before, PieceSide::After] {
                    let lift = program().lift(phi + off, side);
                    assert!(lift.value().abs() < 1e-9, "{phi} {off} {side:?}: {lift:?}");
                }
            }
        }
    }

    #[test]
    fn stages_follow_one_another() {
        let p = program();
        let s = |phi: f64| p.lift(deg(phi), PieceSide::After).0;
        // Case cam-law-offset-roller at 70°, 5 rad/s, 3 rad/s².
        let [s70, d, dd, _] = s(70.0);
        for (got, exact) in [
            (s70, 13.258_216_097_585_6),
            (5.0 * d, 89.096_150_084_203_0),
            (25.0 * dd + 3.0 * d, -304.640_931_906_243),
        ] {
            assert!((got - exact).abs() < 1e-11 * exact.abs(), "{got} {exact}");
        }
        assert_eq!((s(150.0)[0], s(350.0)[0], s(-10.0)[0]), (20.0, 0.0, 0.0));
        assert!((s(240.0)[0] - 10.0).abs() < 1e-12 && s(240.0)[1] < 0.0);
        let [before, after] =
            [PieceSide::Before, PieceSide::After].map(|side| p.lift(deg(180.0), side).0[2]);
        assert!(before == 0.0 && after < -20.0, "{before} {after}");
        assert_eq!((p.corners().len(), p.stroke()), (4, 20.0));
        assert_eq!(p.outer(), [false, true, true, false]);
        let both = [PieceSide::Before, PieceSide::After].map(|side| p.lift(0.0, side).0[0]);
        assert_eq!(both, [0.0, 0.0]);
    }
}
