//! A turn of the cam as its stages: rises, dwells and returns, each by a law over an angle.

use super::jet::Jet;
use super::{Law, Side, in_turn, whole_turns};
use crate::number::Real;
use std::f64::consts::TAU;

/// What a stage does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Way<N = f64> {
    /// The follower goes so far out (m, rad) by a law.
    Rise(N, Law),
    /// It rests.
    Dwell,
    /// It comes back so far by a law.
    Return(N, Law),
}

/// A stage and the angle over which it goes (rad).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stage<N = f64> {
    /// What it does.
    pub way: Way<N>,
    /// Over which angle of the cam.
    pub over: N,
}

impl<N: Real> Stage<N> {
    /// How much further out the follower is at its end.
    pub fn gain(&self) -> N {
        match self.way {
            Way::Rise(h, _) => h,
            Way::Dwell => N::from_f64(0.0),
            Way::Return(h, _) => -h,
        }
    }

    /// The law, of what moves.
    pub fn law(&self) -> Option<Law> {
        match self.way {
            Way::Rise(_, law) | Way::Return(_, law) => Some(law),
            Way::Dwell => None,
        }
    }
}

/// The stages of a turn, from the start of the law.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Program<N = f64> {
    /// In order.
    pub stages: Vec<Stage<N>>,
}

/// Which derivative jumps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shock {
    /// The velocity: an infinite acceleration 刚性冲击.
    Rigid,
    /// The acceleration 柔性冲击.
    Soft,
}

impl Shock {
    /// Which derivative of the lift jumps.
    pub fn order(self) -> usize {
        match self {
            Shock::Rigid => 1,
            Shock::Soft => 2,
        }
    }
}

/// A place where velocity or acceleration jumps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jump {
    /// The angle of the cam (rad).
    pub phi: f64,
    /// Which of the two.
    pub shock: Shock,
    /// s′ or s″ before and after.
    pub sides: [f64; 2],
}

/// Angles nearer than this (rad) are one place: a joint that is computed in two ways.
const ONE_PLACE: f64 = 1e-11;

impl<N: Real> Program<N> {
    /// Where each stage begins, and where the last ends.
    pub fn joints(&self) -> Vec<N> {
        let mut at = N::from_f64(0.0);
        let ends = self.stages.iter().map(|s| {
            at = at + s.over;
            at
        });
        std::iter::once(N::from_f64(0.0)).chain(ends).collect()
    }

    /// All places where pieces of the laws meet.
    pub fn corners(&self) -> Vec<N> {
        let mut out = Vec::new();
        for (stage, start) in self.stages.iter().zip(self.joints()) {
            out.push(start);
            let pieces = stage.law().map_or(&[][..], Law::pieces);
            out.extend(pieces.iter().map(|p| p.end).filter(|e| *e < 1.0).map(|e| start + N::from_f64(e) * stage.over));
        }
        out
    }

    /// The greatest lift.
    pub fn stroke(&self) -> N {
        let mut lift = N::from_f64(0.0);
        self.stages.iter().fold(lift, |most, s| {
            lift = lift + s.gain();
            if lift.approx() > most.approx() { lift } else { most }
        })
    }

    /// s, s′, s″, s‴ by the formula that holds in a piece of the law of a stage; whole turns of φ do not count. The piece of a dwell is 0.
    pub fn lift_in(&self, (stage, piece): (usize, usize), phi: N) -> Option<Jet<N>> {
        let before = self.stages.get(..stage)?;
        let [start, lift] = before.iter().fold([N::from_f64(0.0); 2], |[at, lift], s| [at + s.over, lift + s.gain()]);
        let stage = &self.stages[stage];
        let Some(law) = stage.law() else { return Some(Jet::constant(lift)) };
        let from_start = phi - start;
        // An angle before the start by rounding is not one at the end of the turn.
        let turns = libm::floor(from_start.approx() / TAU + ONE_PLACE);
        let x = (from_start - whole_turns(turns)) / stage.over;
        Some(stage.lifted(law.pieces().get(piece)?.at(x), lift))
    }
}

impl<N: Real> Stage<N> {
    /// A law of one over a way of one as what the stage makes of it, from a lift on.
    fn lifted(&self, of_one: Jet<N>, lift: N) -> Jet<N> {
        let mut scale = self.gain();
        let mut out = of_one.0.map(|value| {
            let scaled = scale * value;
            scale = scale / self.over;
            scaled
        });
        out[0] = out[0] + lift;
        Jet(out)
    }
}

impl Program {
    /// Of each stage, whether the last motion before it goes out: a dwell behind a rise is the outer one.
    pub fn outer(&self) -> Vec<bool> {
        let behind =
            |k: usize| self.stages[..k].iter().rev().chain(self.stages[k..].iter().rev()).map(Stage::gain).find(|gain| *gain != 0.0);
        (0..self.stages.len()).map(|k| behind(k).is_some_and(|gain| gain > 0.0)).collect()
    }

    /// The stage in which φ lies, where it begins, and the lift there; at a joint the one of the side.
    pub fn stage(&self, phi: f64, side: Side) -> Option<(usize, f64, f64)> {
        let turn = in_turn_of(phi, side);
        let (mut at, mut lift) = (0.0, 0.0);
        for (i, stage) in self.stages.iter().enumerate() {
            let end = at + stage.over;
            let within = match side {
                Side::Before => turn <= end + ONE_PLACE,
                Side::After => turn < end - ONE_PLACE,
            };
            if within || i + 1 == self.stages.len() {
                return Some((i, at, lift));
            }
            (at, lift) = (end, lift + stage.gain());
        }
        None
    }

    /// s, s′, s″, s‴ at an angle of the cam.
    pub fn lift(&self, phi: f64, side: Side) -> Jet {
        let Some((i, start, lift)) = self.stage(phi, side) else { return Jet::constant(0.0) };
        let stage = &self.stages[i];
        let Some(law) = stage.law() else { return Jet::constant(lift) };
        let x = stage.part(start, phi, side);
        // A joint inside a law is met to the last digit only by luck.
        let near = law.pieces().iter().map(|p| p.end).find(|e| (e - x).abs() * stage.over < ONE_PLACE);
        stage.lifted(Jet(law.at(near.unwrap_or(x), side)), lift)
    }

    /// The stage that holds at an angle of the cam, and the piece of its law.
    pub fn branch(&self, phi: f64, side: Side) -> Option<(usize, usize)> {
        let (i, start, _) = self.stage(phi, side)?;
        let stage = &self.stages[i];
        let Some(law) = stage.law() else { return Some((i, 0)) };
        let x = stage.part(start, phi, side);
        let near = law.pieces().iter().map(|p| p.end).find(|e| (e - x).abs() * stage.over < ONE_PLACE);
        Some((i, law.place(near.unwrap_or(x), side == Side::Before)))
    }
}

/// An angle less whole turns. The place where a turn ends and the next begins belongs to the one on its side: an angle beside it is
/// hardly less than 0, or hardly more than a turn.
pub fn in_turn_of(phi: f64, side: Side) -> f64 {
    let turn = in_turn(phi);
    match side {
        Side::Before if turn <= ONE_PLACE => turn + TAU,
        Side::After if turn >= TAU - ONE_PLACE => turn - TAU,
        Side::Before | Side::After => turn,
    }
}

impl Stage {
    /// Which part of a stage that begins at `start` is over at an angle of the cam.
    fn part(&self, start: f64, phi: f64, side: Side) -> f64 {
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
    fn program() -> Program {
        let stage = |way, over| Stage { way, over: deg(over) };
        let stages = vec![
            stage(Way::Rise(20.0, Law::Cycloidal), 120.0),
            stage(Way::Dwell, 60.0),
            stage(Way::Return(20.0, Law::Harmonic), 120.0),
            stage(Way::Dwell, 60.0),
        ];
        Program { stages }
    }

    /// Rounding at the place where a turn ends and the next begins is no jump of the lift.
    #[test]
    fn a_turn_begins_where_the_last_one_ends() {
        for phi in [0.0, TAU, -TAU, 3.0 * TAU] {
            for off in [-1e-12, -1e-15, 0.0, 1e-15, 1e-12] {
                for side in [Side::Before, Side::After] {
                    let lift = program().lift(phi + off, side);
                    assert!(lift.value().abs() < 1e-9, "{phi} {off} {side:?}: {lift:?}");
                }
            }
        }
    }

    #[test]
    fn stages_follow_one_another() {
        let p = program();
        let s = |phi: f64| p.lift(deg(phi), Side::After).0;
        // Case cam-law-offset-roller at 70°, 5 rad/s, 3 rad/s².
        let [s70, d, dd, _] = s(70.0);
        for (got, exact) in [(s70, 13.258_216_097_585_6), (5.0 * d, 89.096_150_084_203_0), (25.0 * dd + 3.0 * d, -304.640_931_906_243)] {
            assert!((got - exact).abs() < 1e-11 * exact.abs(), "{got} {exact}");
        }
        assert_eq!((s(150.0)[0], s(350.0)[0], s(-10.0)[0]), (20.0, 0.0, 0.0));
        assert!((s(240.0)[0] - 10.0).abs() < 1e-12 && s(240.0)[1] < 0.0);
        let [before, after] = [Side::Before, Side::After].map(|side| p.lift(deg(180.0), side).0[2]);
        assert!(before == 0.0 && after < -20.0, "{before} {after}");
        assert_eq!((p.corners().len(), p.stroke()), (4, 20.0));
        assert_eq!(p.outer(), [false, true, true, false]);
        let both = [Side::Before, Side::After].map(|side| p.lift(0.0, side).0[0]);
        assert_eq!(both, [0.0, 0.0]);
    }
}
