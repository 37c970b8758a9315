//! Zhukovsky's lever: the velocity polygon, turned clockwise by a right angle, as a rigid lever
//! about its pole.
//!
//! A force F at a point of velocity v has the moment F·v/μ_v about the pole; a couple M on a link
//! with angular velocity ω has the moment Mω/μ_v. All loads and the balancing moment are in
//! equilibrium on the lever, because their power is zero.
//!
//! # Source
//! N. E. Zhukovsky's theorem: 孙桓, 陈作模, 机械原理, the chapter on the forces of mechanisms.

use super::Equilibrium;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::kind::Level;
use hodograph_mechanism::answer::MotionSource;
use hodograph_mechanism::position::Configuration;
use hodograph_scene::{LinkId, PointId, Scene};

/// The loads on the lever at an instant.
#[derive(Clone, Debug, PartialEq)]
pub struct Lever {
    /// The scale of the velocity polygon ((m/s)/mm).
    pub mu: f64,
    /// The forces.
    pub forces: Vec<LeverForce>,
    /// The couples: each load with its moment Mω/μ_v (N·mm).
    pub couples: Vec<(usize, f64)>,
    /// The moment of all loads about the pole (N·mm), counter-clockwise positive.
    pub moment: f64,
}

/// A force on the lever.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeverForce {
    /// The load, an index into [`Equilibrium::loads`].
    pub load: usize,
    /// The point of application.
    pub point: PointId,
    /// The place of the point on the lever (mm from the pole).
    pub at: Point,
    /// The distance of the line of action from the pole (mm).
    pub arm_mm: f64,
    /// The moment about the pole (N·mm).
    pub moment: f64,
}

impl Lever {
    /// Returns the lever of a scene: `motion` has the velocities read from the polygon of scale
    /// `mu`. Further points of a link follow by images.
    ///
    /// `None` if the polygon does not give the velocity of a load.
    pub fn of(
        scene: &Scene,
        at: &Configuration,
        of: &Equilibrium,
        motion: &impl MotionSource<f64>,
        mu: f64,
    ) -> Option<Lever> {
        let (mut forces, mut couples) = (Vec::new(), Vec::new());
        for (k, load) in of.loads.iter().enumerate() {
            if load.wrench.couple != 0.0 {
                couples.push((
                    k,
                    load.wrench.couple * motion.turning(Level::Velocity, load.link)? / mu,
                ));
            }
            if let (Some(point), Some(along)) = (load.at, load.wrench.force.unit()) {
                let v = velocity(scene, at, motion, point, load.link)? * (1.0 / mu);
                // Turned clockwise: v × F about the pole then equals F·v.
                let end = -v.perp();
                let arm = end.cross(along);
                forces.push(LeverForce {
                    load: k,
                    point,
                    at: end.to_point(),
                    arm_mm: arm.abs(),
                    moment: arm * load.wrench.force.norm(),
                });
            }
        }
        let moment = forces.iter().map(|f| f.moment).chain(couples.iter().map(|(_, m)| *m)).sum();
        Some(Lever { mu, forces, couples, moment })
    }

    /// Returns the balancing moment (N·m) or force (N) of the only driver; `None` for several
    /// drivers, or for a driver at rest.
    pub fn balance(&self, scene: &Scene) -> Option<f64> {
        let [driver] = &scene.drivers[..] else { return None };
        (driver.rate.value != 0.0).then(|| -self.moment * self.mu / driver.rate.value)
    }
}

/// Returns the velocity of a point of a link: as read, or by the image of two other points.
fn velocity(
    scene: &Scene,
    at: &Configuration,
    motion: &impl MotionSource<f64>,
    p: PointId,
    link: LinkId,
) -> Option<Vec2> {
    let read = |p: PointId| motion.vector(Level::Velocity, p, Some(link));
    if let Some(v) = read(p) {
        return Some(v);
    }
    let known: Vec<(PointId, Vec2)> =
        scene.links[link.0].points.iter().filter_map(|q| Some((*q, read(*q)?))).collect();
    let place = |q: PointId| at.points[q.0];
    let &(a, v_a) = known.first()?;
    let arm = place(p)? - place(a)?;
    let second = known[1..].iter().find_map(|(b, v_b)| {
        let base = place(*b)? - place(a)?;
        let size = base.dot(base);
        (size > 0.0).then(|| (base, *v_b - v_a, size))
    });
    match second {
        // The triangle of the three points, turned and at another scale.
        Some((base, image, size)) => {
            Some(v_a + image * (base.dot(arm) / size) + image.perp() * (base.cross(arm) / size))
        }
        None => Some(v_a + arm.perp() * motion.turning(Level::Velocity, link)?),
    }
}
