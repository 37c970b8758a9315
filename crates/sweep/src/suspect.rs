//! Closures that may have a change point, found from the program before any position of it is
//! computed.
//!
//! A crank leads its pin round a circle. The pin is nearest to a fixed place or line, and farthest
//! from it, at two positions of the crank only, and everywhere else its distance grows or
//! decreases. Between a crank and ground a crossing ([`super::closure::Margin::crossing`]) has its
//! smallest values there, and a double zero, which is a change point, nowhere else. Two numbers
//! therefore decide whether it has one. Joints that depend on other links are searched.

use super::closure::{Circles, Closure};
use super::kernel::{Reg, RegPair};
use super::program::{COS, Joint, Op, SIN, SweepProgram};
use hodograph_base::geom::Vec2;
use hodograph_mechanism::mechanism::Level;

/// The crossing (sin²) above which there is certainly no change point, whatever the rounding: it
/// belongs to under two degrees from one.
const SURE: f64 = 1e-3;

impl SweepProgram {
    /// The crossings of the joints that may have a change point.
    pub(super) fn suspects(&self) -> impl Iterator<Item = Reg> {
        self.joints.iter().filter(|j| self.suspect(j)).map(|j| j.crossing)
    }

    fn suspect(&self, joint: &Joint) -> bool {
        let extremes = self.extremes(&self.steps[Level::Position as usize][joint.step].op);
        // A value that is not a number is not certain either.
        !extremes.is_some_and(|both| both.iter().all(|c| c.abs() > SURE))
    }

    /// The crossings of a closure between a crank's pin and ground where the pin is nearest and
    /// where it is farthest; `None` for other closures.
    fn extremes(&self, closure: &Op) -> Option<[f64; 2]> {
        match closure {
            Op::Circles(k) => {
                let (r, s) = (self.fixed(k.r)?, self.fixed(k.s)?);
                let ways = self.ways(k.a, k.b).or_else(|| self.ways(k.b, k.a))?;
                Some(ways.map(|d| Circles::margin(k, [0.0, 0.0, r, d, 0.0, s]).crossing()))
            }
            Op::CircleLine(k) => {
                let (pin, r, q, t) =
                    (self.pin(k.a)?, self.fixed(k.r)?, self.place(k.q)?, self.place(k.t)?);
                let off = t.cross(q - pin.centre);
                Some(
                    [off - pin.radius, off + pin.radius]
                        .map(|h| k.margin([0.0, 0.0, r, 0.0, h, 1.0, 0.0]).crossing()),
                )
            }
            Op::SlotLever(k) => {
                Some(self.ways(k.b, k.a)?.map(|d| k.margin([0.0, 0.0, d, 0.0]).crossing()))
            }
            _ => None,
        }
    }

    /// The shortest and the longest distance of a crank's pin from a fixed place.
    fn ways(&self, pin: RegPair, place: RegPair) -> Option<[f64; 2]> {
        let (pin, place) = (self.pin(pin)?, self.place(place)?);
        let off = (place - pin.centre).norm();
        Some([off - pin.radius, off + pin.radius])
    }

    /// The circle of a point that turns with the driver about a fixed one.
    fn pin(&self, point: RegPair) -> Option<Pin> {
        let Op::Image(image) = self.maker(point)? else { return None };
        let Op::Twist(arm) = self.maker(image.d)? else { return None };
        let length = |k: [f64; 2]| Vec2::new(k[0], k[1]).norm();
        let turns = arm.d == RegPair { x: COS, y: SIN };
        turns.then_some(Pin {
            centre: self.place(image.o)?,
            radius: length(image.k) * length(arm.k),
        })
    }

    /// The operation that fills a pair of positions.
    fn maker(&self, pair: RegPair) -> Option<&Op> {
        self.steps[Level::Position as usize].iter().find(|s| s.out == pair.x).map(|s| &s.op)
    }

    fn fixed(&self, reg: Reg) -> Option<f64> {
        self.constants.iter().find(|(r, _)| *r == reg).map(|(_, value)| *value)
    }

    fn place(&self, pair: RegPair) -> Option<Vec2<f64>> {
        Some(Vec2::new(self.fixed(pair.x)?, self.fixed(pair.y)?))
    }
}

/// The circle of a crank's pin.
struct Pin {
    centre: Vec2<f64>,
    radius: f64,
}

#[cfg(test)]
mod tests {
    use crate::limit::Probe;
    use crate::{PlacedScene, compile};
    use hodograph_mechanism::mechanism::Mechanism;
    use hodograph_scene::{edit, read, templates};

    /// Cranks with groups of each kind, of many lengths: where no joint is suspect the search finds
    /// no change point, and where the search finds one the joint is suspect.
    #[test]
    fn what_is_not_suspect_has_no_change_point() {
        let lengths = |name: &'static str, of: &'static str, all: &[f64]| {
            all.iter().map(|l| (name, vec![(of, l.to_string())])).collect::<Vec<_>>()
        };
        let mut scenes = lengths("slider-crank", "l_AB", &[20.0, 60.0, 279.0, 280.0]);
        scenes.extend(lengths("whitworth", "l_AB", &[50.0, 60.0, 110.0]));
        // Four-bars: crank-rockers, drag links, rockers, and those with links that can be in line.
        for ab in [60, 90, 100, 140, 250] {
            for bc in [150, 240, 250, 300] {
                for cd in [100, 200, 260] {
                    scenes.push((
                        "crank-rocker",
                        [("l_AB", ab), ("l_BC", bc), ("l_CD", cd)]
                            .map(|(n, l)| (n, l.to_string()))
                            .to_vec(),
                    ));
                }
            }
        }
        let (mut free, mut suspect, mut changing) = (0, 0, 0);
        for (name, set) in scenes {
            let set: Vec<(&str, &str)> = set.iter().map(|(n, l)| (*n, l.as_str())).collect();
            let Ok(text) = templates::instantiate(name, &set) else { continue };
            let scene = read(edit::with_find(&text, &["omega_3"]).unwrap()).unwrap().value;
            let m = Mechanism::new(&scene).unwrap().value;
            let Ok(placed) = PlacedScene::new(&scene, &m) else { continue };
            let program = compile(&scene, &m, &placed.at, Some(0), &scene.find).unwrap();
            let changes = |way: f64| {
                let mut probe = Probe::of(program.clone(), &placed, 0);
                let (now, reach) = (probe.now, probe.reach());
                probe.walk(now + way * reach).1.events.len()
            };
            let found = changes(1.0) + changes(-1.0) > 0;
            match (program.suspects().next().is_some(), found) {
                (false, false) => free += 1,
                (true, false) => suspect += 1,
                (true, true) => changing += 1,
                (false, true) => panic!("{name} {set:?} has a change point that nothing suspected"),
            }
        }
        assert!(
            free > 30 && changing > 2 && suspect < free / 2,
            "{free} free, {suspect} suspect, {changing} changing"
        );
    }
}
