//! A turn of the cam as its stages: rises, dwells and returns, each by a law over an angle.

use super::jet::Jet;
use super::{Law, Side, in_turn};
use std::f64::consts::TAU;

/// What a stage does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Way {
    /// The follower goes so far out (m, rad) by a law.
    Rise(f64, Law),
    /// It rests.
    Dwell,
    /// It comes back so far by a law.
    Return(f64, Law),
}

/// A stage and the angle over which it goes (rad).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stage {
    /// What it does.
    pub way: Way,
    /// Over which angle of the cam.
    pub over: f64,
}

impl Stage {
    /// How much further out the follower is at its end.
    pub fn gain(&self) -> f64 {
        match self.way {
            Way::Rise(h, _) => h,
            Way::Dwell => 0.0,
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
pub struct Program {
    /// In order.
    pub stages: Vec<Stage>,
}

/// Which derivative jumps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shock {
    /// The velocity: an infinite acceleration 刚性冲击.
    Rigid,
    /// The acceleration 柔性冲击.
    Soft,
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

impl Program {
    /// Where each stage begins, and where the last ends.
    pub fn joints(&self) -> Vec<f64> {
        let mut at = 0.0;
        let ends = self.stages.iter().map(|s| {
            at += s.over;
            at
        });
        std::iter::once(0.0).chain(ends).collect()
    }

    /// The stage in which φ lies, where it begins, and the lift there; at a joint the one of the side.
    pub fn stage(&self, phi: f64, side: Side) -> Option<(usize, f64, f64)> {
        let turn = in_turn(phi);
        // The end of the turn is its beginning, seen from before.
        let turn = if side == Side::Before && turn <= ONE_PLACE { TAU } else { turn };
        let turn = if side == Side::After && turn >= TAU - ONE_PLACE { 0.0 } else { turn };
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
        let (gain, law) = match stage.way {
            Way::Rise(h, law) => (h, law),
            Way::Return(h, law) => (-h, law),
            Way::Dwell => return Jet::constant(lift),
        };
        let turn = in_turn(phi);
        // Seen from before, the start of the turn is its end.
        let turn = if turn + ONE_PLACE < start || side == Side::Before && turn <= ONE_PLACE { turn + TAU } else { turn };
        let x = ((turn - start) / stage.over).clamp(0.0, 1.0);
        // A joint inside a law is met to the last digit only by luck.
        let near = law.pieces().iter().map(|p| p.end).find(|e| (e - x).abs() * stage.over < ONE_PLACE);
        let value = law.at(near.unwrap_or(x), side);
        let mut scale = gain;
        let mut out = [0.0; 4];
        for (out, value) in out.iter_mut().zip(value) {
            *out = scale * value;
            scale /= stage.over;
        }
        out[0] += lift;
        Jet(out)
    }

    /// All places where pieces of the laws meet.
    pub fn corners(&self) -> Vec<f64> {
        let mut out = Vec::new();
        for (stage, start) in self.stages.iter().zip(self.joints()) {
            out.push(start);
            let pieces = stage.law().map_or(&[][..], Law::pieces);
            out.extend(pieces.iter().map(|p| p.end).filter(|e| *e < 1.0).map(|e| start + e * stage.over));
        }
        out
    }

    /// Of each stage, whether the last motion before it goes out: a dwell behind a rise is the outer one.
    pub fn outer(&self) -> Vec<bool> {
        let behind =
            |k: usize| self.stages[..k].iter().rev().chain(self.stages[k..].iter().rev()).map(Stage::gain).find(|gain| *gain != 0.0);
        (0..self.stages.len()).map(|k| behind(k).is_some_and(|gain| gain > 0.0)).collect()
    }

    /// The greatest lift.
    pub fn stroke(&self) -> f64 {
        let mut lift = 0.0f64;
        self.stages.iter().fold(0.0f64, |most, s| {
            lift += s.gain();
            most.max(lift)
        })
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
