//! Friction in pins and guides: couples and forces that depend on the reactions, which in turn
//! depend on them.
//!
//! In a pin the force is tangent to the friction circle of radius ρ, which is equivalent to the
//! couple ρF against the relative rotation of the two links. In a guide the force is inclined by
//! the angle of friction, which is equivalent to the force fN against the sliding. The velocities
//! give both senses. The reactions are solved without friction, then the friction from them, then
//! the reactions again, until they converge: with small circles each pass gains a factor of about
//! l/ρ.
//!
//! # Source
//! 孙桓, 陈作模, 葛文杰: 机械原理, ch. 4 and 5.

use super::{Cause, Load, fastest};
use crate::answer::MotionSource;
use crate::mechanism::{Level, Mechanism};
use crate::position::{Configuration, Path};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_scene::exact::Inputs;
use hodograph_scene::quantity::{Forces, ROUNDING, Wrench};
use hodograph_scene::{GuideId, LinkId, PointId, Rub, Scene, Touch};

/// Two links that rub on each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rubbing<N = f64> {
    /// Index in the scene's friction.
    pub friction: usize,
    /// The link on which the friction acts, and the link on which its opposite acts.
    pub links: [LinkId; 2],
    /// The pair.
    pub pair: Rubbed,
    /// The point of application of a friction force; `None` for a couple.
    pub at: Option<PointId>,
    /// Position of the point.
    pub place: Point<N>,
    /// Friction on the first link for a reaction of 1 N.
    pub unit: Wrench<N>,
    /// Power (W) dissipated for a reaction of 1 N.
    pub takes: f64,
}

/// A pair with friction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rubbed {
    /// A pin.
    Pin(PointId),
    /// A guide.
    Guide(GuideId),
}

/// Returns true if reactions, and therefore friction, are determined: no pair is redundant, and no
/// belt pulls on its pulleys with a tension that the scene does not give.
pub fn is_determined(scene: &Scene, m: &Mechanism) -> bool {
    m.redundant.is_empty() && scene.rolling.iter().all(|r| matches!(r.touch(), Touch::Point(_)))
}

/// Returns the pairs that rub in a pose, and those at rest, by their index in the scene's friction:
/// at rest friction has no sense.
///
/// `None` if a position or a velocity is not known.
pub fn rubbing<N: Real>(
    scene: &Scene,
    at: &Configuration<N>,
    motion: &impl MotionSource<N>,
) -> Option<(Vec<Rubbing<N>>, Vec<usize>)> {
    let inputs = Inputs::<N>::of(scene);
    let zero = N::from_f64(0.0);
    let speed = fastest(scene, at);
    let (mut out, mut still) = (Vec::new(), Vec::new());
    for (k, friction) in scene.loads.friction.iter().enumerate() {
        match &friction.at {
            Rub::Pin { point, fast, circle } => {
                let omega = |l: LinkId| {
                    if l == scene.ground { Some(zero) } else { motion.turning(Level::Velocity, l) }
                };
                for link in scene.carriers(*point).filter(|l| l != fast) {
                    let turning = (omega(link)? - omega(*fast)?).approx();
                    if turning.abs() * at.extent() <= ROUNDING * speed {
                        still.push(k);
                        continue;
                    }
                    let unit = Wrench {
                        force: Vec2::zero(),
                        couple: inputs.number(circle) * N::from_f64(-turning.signum()),
                    };
                    let place = at.points[point.0]?;
                    out.push(Rubbing {
                        friction: k,
                        links: [link, *fast],
                        pair: Rubbed::Pin(*point),
                        at: None,
                        place,
                        unit,
                        takes: (unit.couple.approx() * turning).abs(),
                    });
                }
            }
            Rub::Guide { guide, f } => {
                let own = &scene.guides[guide.0];
                let (slider, point) = scene.sliding_at(*guide)?;
                let Path::Line { direction, .. } = at.guides[guide.0]? else { continue };
                let of = |l: LinkId| {
                    if l == scene.ground {
                        Some(Vec2::zero())
                    } else {
                        motion.vector(Level::Velocity, point, Some(l))
                    }
                };
                let sliding = (of(slider)? - of(own.on)?).dot(direction).approx();
                if sliding.abs() <= ROUNDING * speed {
                    still.push(k);
                    continue;
                }
                let unit = Wrench {
                    force: direction * (inputs.number(f) * N::from_f64(-sliding.signum())),
                    couple: zero,
                };
                let place = at.points[point.0]?;
                out.push(Rubbing {
                    friction: k,
                    links: [slider, own.on],
                    pair: Rubbed::Guide(*guide),
                    at: Some(point),
                    place,
                    unit,
                    takes: inputs.number(f).approx() * sliding.abs(),
                });
            }
        }
    }
    Some((out, still))
}

impl Rubbing {
    /// Converts the pair to another number type.
    pub fn lift<N: Real>(&self) -> Rubbing<N> {
        let Rubbing { friction, links, pair, at, place, unit, takes } = *self;
        Rubbing { friction, links, pair, at, place: place.lift(), unit: unit.lift(), takes }
    }
}

impl<N: Real> Rubbing<N> {
    /// Returns the reaction (N) that presses the links on each other.
    fn pressure(
        &self,
        pins: &[(PointId, LinkId, Vec2<N>)],
        guides: &[(GuideId, Wrench<N>)],
    ) -> Option<N> {
        match self.pair {
            Rubbed::Pin(p) => {
                let of = |l: LinkId| {
                    pins.iter().find(|(at, on, _)| (*at, *on) == (p, l)).map(|x| x.2.norm())
                };
                of(self.links[0]).or_else(|| of(self.links[1]))
            }
            Rubbed::Guide(g) => {
                guides.iter().find(|(own, _)| *own == g).map(|(_, w)| w.force.norm())
            }
        }
    }

    /// Returns the power (W) dissipated under the forces at an instant.
    pub fn power(&self, forces: &Forces<N>) -> f64 {
        // The reaction of a guide includes its friction.
        let within = libm::hypot(1.0, self.unit.force.norm().approx());
        self.pressure(&forces.pins, &forces.guides)
            .map_or(0.0, |pressure| self.takes * pressure.approx() / within)
    }

    /// Returns the friction under a pressure (N) as loads of both links.
    fn loads(&self, ground: LinkId, pressure: N) -> impl Iterator<Item = Load<N>> {
        let wrench =
            Wrench { force: self.unit.force * pressure, couple: self.unit.couple * pressure };
        let Rubbing { friction, links: [link, other], at, place, .. } = *self;
        let load = move |link: LinkId, wrench: Wrench<N>| Load {
            cause: Cause::Friction(friction),
            link,
            at,
            place,
            wrench,
        };
        [load(link, wrench), load(other, wrench.reversed())]
            .into_iter()
            .filter(move |l| l.link != ground)
    }
}

/// Returns the reactions of guides including the friction that they cause.
pub fn with_friction<N: Real>(
    mut guides: Vec<(GuideId, Wrench<N>)>,
    rubbing: &[Rubbing<N>],
) -> Vec<(GuideId, Wrench<N>)> {
    for (g, wrench) in &mut guides {
        let own = rubbing.iter().find(|r| r.pair == Rubbed::Guide(*g));
        let pressure = wrench.force.norm();
        wrench.force = own.map_or(wrench.force, |r| wrench.force + r.unit.force * pressure);
    }
    guides
}

/// Forces of pins on links, and reactions of guides.
pub type Reactions<N> = (Vec<(PointId, LinkId, Vec2<N>)>, Vec<(GuideId, Wrench<N>)>);

/// Greatest number of passes until the reactions converge.
const PASSES: usize = 600;

/// Relative change of the reactions below which the passes have converged, if the change does not
/// decrease further.
const SETTLED: f64 = 1e-12;

/// Returns reactions with friction: `solve` returns those under the loads of friction, `read` reads
/// the forces of pins and guides from them. In numbers that know their error the result encloses a
/// solution: the passes map a box of pressures into itself (Brouwer).
///
/// `Ok(None)` if the passes do not converge: with so large a friction no finite reactions balance
/// the loads.
///
/// # Errors
/// The errors of `solve`.
pub fn settled<N: Real, R, E>(
    scene: &Scene,
    rubbing: &[Rubbing<N>],
    mut solve: impl FnMut(&[Load<N>]) -> Result<R, E>,
    read: impl Fn(&R) -> Reactions<N>,
) -> Result<Option<R>, E> {
    let pressures = |found: &R| {
        let (pins, guides) = read(found);
        rubbing.iter().map(|r| r.pressure(&pins, &guides)).collect::<Option<Vec<N>>>()
    };
    let loads = |u: &[N]| {
        rubbing.iter().zip(u).flat_map(|(r, x)| r.loads(scene.ground, *x)).collect::<Vec<_>>()
    };
    let middles = |u: Vec<N>| u.into_iter().map(Real::mid).collect::<Vec<N>>();
    let Some(first) = pressures(&solve(&[])?) else { return Ok(None) };
    let mut u = middles(first);
    let mut before = f64::INFINITY;
    let mut settled = false;
    for _ in 0..PASSES {
        let Some(next) = pressures(&solve(&loads(&u))?).map(middles) else { return Ok(None) };
        let size = next.iter().map(|x| x.approx().abs()).fold(f64::MIN_POSITIVE, f64::max);
        let off =
            next.iter().zip(&u).map(|(a, b)| (*a - *b).approx().abs() / size).fold(0.0, f64::max);
        u = next;
        if !off.is_finite() {
            return Ok(None);
        }
        if off == 0.0 || off <= SETTLED && off >= before {
            settled = true;
            break;
        }
        before = off;
    }
    if !settled && before > SETTLED {
        return Ok(None);
    }
    let found = solve(&loads(&u))?;
    if !N::knows_its_error() {
        return Ok(Some(found));
    }
    let Some(next) = pressures(&found) else { return Ok(None) };
    let mut by: Vec<f64> = next
        .iter()
        .zip(&u)
        .map(|(a, b)| 4.0 * ((*a - *b).approx().abs() + a.radius()) + f64::MIN_POSITIVE)
        .collect();
    for _ in 0..ROUNDS {
        let wide: Vec<N> = u.iter().zip(&by).map(|(x, by)| x.widened(*by)).collect();
        let found = solve(&loads(&wide))?;
        let Some(next) = pressures(&found) else { return Ok(None) };
        let reach = |(a, b): (&N, &N)| ((*a - *b).approx().abs() + a.radius()) * (1.0 + 1e-9);
        if next.iter().zip(&u).map(reach).zip(&by).all(|(reach, by)| reach <= *by) {
            return Ok(Some(found));
        }
        by.iter_mut().for_each(|by| *by *= 4.0);
    }
    Ok(None)
}

/// Number of successively wider boxes that are tried.
const ROUNDS: usize = 12;
