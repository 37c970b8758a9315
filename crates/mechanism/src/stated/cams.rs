//! Contact without penetration: the whole profile of a cam against the whole end of its follower.
//!
//! A round end keeps its radius from the nearest point of the profile and is outside it; a flat
//! face is on the support line of the profile in the direction of its normal. The check is
//! independent of the piece of the profile that the solver took.

use super::Judge;
use hodograph_base::cam::{CamMotion, Follower, FollowerTip, PieceSide, ProfileSegment};
use hodograph_base::geom::{Point, Vec2};
use hodograph_scene::{Cam, DriverKind, PointId, TurningCam};

/// Distance of a follower from its cam.
pub(super) struct FollowerClearance {
    /// Distance between the two (m); negative by the depth to which the follower cuts into the cam.
    pub clearance: f64,
    /// A position near the contact.
    pub at: Point,
}

/// A frame in the plane: origin and x axis.
#[derive(Clone, Copy)]
struct CamAxes {
    origin: Point,
    axis: Vec2,
}

impl CamAxes {
    fn local(&self, at: Point) -> Vec2 {
        (at - self.origin).divide_by(self.axis)
    }

    fn turned_back(&self, way: Vec2) -> Vec2 {
        way.divide_by(self.axis)
    }
}

impl Judge<'_> {
    /// Returns the distance of a follower from its cam; `None` if the two are not placed, or if the
    /// pair determines the direction of the face.
    pub(super) fn contact(&self, cam: &Cam) -> Option<FollowerClearance> {
        if let Some(t) = &cam.disc
            && let CamMotion::Law { .. } = t.disc.motion
        {
            return self.by_law(cam, t);
        }
        let (frame, segments) = self.profile(cam)?;
        if let Some(radius) = cam.follows.radius() {
            let at = self.place(cam.follows.point())?;
            return Some(FollowerClearance {
                clearance: outside(&segments, frame.local(at))? - radius,
                at,
            });
        }
        let (through, normal) = self.face(cam)?;
        let n = frame.turned_back(normal);
        Some(FollowerClearance {
            clearance: frame.local(through).dot(n) - support(&segments, n)?,
            at: through,
        })
    }

    /// Returns the profile of arcs and lines, with its frame.
    fn profile(&self, cam: &Cam) -> Option<(CamAxes, Vec<ProfileSegment>)> {
        if let Some((centre, radius)) = cam.circle {
            let frame = CamAxes { origin: self.place(centre)?, axis: Vec2::unit_x() };
            return Some((
                frame,
                vec![ProfileSegment::Arc {
                    centre: Vec2::ZERO,
                    radius,
                    normals: [0.0, std::f64::consts::TAU],
                }],
            ));
        }
        if let Some(pieces) = &cam.posed {
            let [from, to] = pieces.frame;
            let origin = self.place(from)?;
            return Some((
                CamAxes { origin, axis: (self.place(to)? - origin).unit()? },
                pieces.segments.clone(),
            ));
        }
        let t = cam.disc.as_ref()?;
        let CamMotion::Profile(segments) = &t.disc.motion else { return None };
        Some((self.cam_frame(cam, t)?, segments.clone()))
    }

    /// Returns the frame of a cam on a pivot: origin there, x along its first two points; along the
    /// x axis for a cam that is the ground.
    fn cam_frame(&self, cam: &Cam, t: &TurningCam) -> Option<CamAxes> {
        Some(CamAxes { origin: self.place(t.pivot)?, axis: self.axis(cam.cam, None)? })
    }

    /// Returns the angle by which a cam deviates from the angle in its carrier that the scene gives
    /// (rad); `None` for a single circle, whose piece needs no angle.
    pub(super) fn turned_off(&self, cam: &Cam) -> Option<f64> {
        let t = cam.disc.as_ref().filter(|_| cam.circle.is_none())?;
        let is = self.cam_frame(cam, t)?.axis.divide_by(self.carrier_axis(t)?).angle();
        Some(is - t.start - t.disc.sense * t.phi)
    }

    /// Returns a point of the face and its normal out of the cam, as the scene states them.
    fn face(&self, cam: &Cam) -> Option<(Point, Vec2)> {
        let Some(g) = cam.contact else { return self.face_of_driven(cam) };
        let (through, along) = self.line_of(g)?;
        let normal = if cam.left { -along.perp() } else { along.perp() };
        // The pair that represents the contact runs parallel to the face at the radius of the
        // touched piece.
        Some((through + normal * cam.touched_radius()?, normal))
    }

    /// Returns the face of a follower with a contact represented by a driver.
    fn face_of_driven(&self, cam: &Cam) -> Option<(Point, Vec2)> {
        let t = cam.disc.as_ref()?;
        let at = self.place(cam.follows.point())?;
        match (t.disc.follower, t.disc.touch) {
            (Follower::Translating { direction, .. }, _) => {
                Some((at, direction.rotate_by(self.carrier_axis(t)?)))
            }
            (Follower::Oscillating { sense, .. }, FollowerTip::Flat { lever }) => {
                let (a, b) = self.line_of_driver(t.by_law?)?;
                let normal = (self.place(b)? - self.place(a)?).unit()?.perp() * sense;
                Some((at + normal * lever, normal))
            }
            (Follower::Oscillating { .. }, FollowerTip::Point { .. }) => None,
        }
    }

    fn line_of_driver(&self, driver: usize) -> Option<(PointId, PointId)> {
        match self.scene.drivers[driver].kind {
            DriverKind::Turn { line, .. } => line,
            DriverKind::Slide { .. } | DriverKind::Cylinder { .. } => None,
        }
    }

    /// Returns the x axis of the link that carries cam and follower.
    fn carrier_axis(&self, t: &TurningCam) -> Option<Vec2> {
        match t.axis(self.scene) {
            Some([a, b]) => (self.place(b)? - self.place(a)?).unit(),
            None => Some(Vec2::unit_x()),
        }
    }

    /// Returns the distance of the follower from the position that its law gives, positive outward.
    fn by_law(&self, cam: &Cam, t: &TurningCam) -> Option<FollowerClearance> {
        let frame = self.cam_frame(cam, t)?;
        let carrier = self.carrier_axis(t)?;
        // The law is measured from its start in the sense in which the cam turns in its carrier.
        let phi = t.disc.sense * (frame.axis.divide_by(carrier).angle() - t.start);
        let at = self.place(cam.follows.point())?;
        let here = self.coordinate(cam, t, frame.origin, carrier)?;
        // At a jump of the law both sides are valid positions.
        let off = [PieceSide::Before, PieceSide::After].into_iter().filter_map(|side| {
            let due = t.disc.coordinate(phi, side)?.value();
            let off = here - due;
            Some(match t.disc.follower {
                Follower::Translating { .. } => off,
                Follower::Oscillating { pivot, arm, .. } => {
                    (off - std::f64::consts::TAU * libm::round(off / std::f64::consts::TAU))
                        * if arm > 0.0 { arm } else { pivot.norm() }
                }
            })
        });
        let clearance = off.min_by(|a, b| a.abs().total_cmp(&b.abs()))?;
        Some(FollowerClearance { clearance, at })
    }

    /// Returns the coordinate of a placed follower, as its geometry defines it.
    fn coordinate(&self, cam: &Cam, t: &TurningCam, centre: Point, carrier: Vec2) -> Option<f64> {
        let end = cam.follows.point();
        match t.disc.follower {
            Follower::Translating { direction, .. } => {
                Some((self.place(end)? - centre).dot(direction.rotate_by(carrier)))
            }
            Follower::Oscillating { pivot, sense, .. } => {
                let arm = match (t.by_law, t.disc.touch) {
                    (Some(driver), _) => {
                        let (a, b) = self.line_of_driver(driver)?;
                        self.place(b)? - self.place(a)?
                    }
                    // The outward normal is the direction of the face turned by a quarter, in the
                    // sense in which it moves outward.
                    (None, FollowerTip::Flat { .. }) => self.face(cam)?.1.perp() * -sense,
                    (None, FollowerTip::Point { .. }) => {
                        let shared = |p: &&PointId| {
                            **p != end && self.scene.links[t.frame.0].points.contains(*p)
                        };
                        self.place(end)?
                            - self.place(
                                *self.scene.links[cam.follower.0].points.iter().find(shared)?,
                            )?
                    }
                };
                Some(arm.divide_by(carrier).divide_by(Vec2::ZERO - pivot).angle() * sense)
            }
        }
    }
}

/// Returns the distance of a position from a closed profile, negative inside.
fn outside(segments: &[ProfileSegment], at: Vec2) -> Option<f64> {
    segments.iter().map(|s| nearest(s, at)).min_by(|a, b| a.abs().total_cmp(&b.abs()))
}

/// Returns the signed distance of a position from the nearest point of one piece.
fn nearest(segment: &ProfileSegment, at: Vec2) -> f64 {
    match *segment {
        ProfileSegment::Line { normal, distance, ends: [from, to] } => {
            let n = Vec2::from_angle(normal);
            let (along, above) = (n.perp().dot(at), n.dot(at) - distance);
            if (from.min(to)..=from.max(to)).contains(&along) {
                return above;
            }
            let end = if (along - from).abs() < (along - to).abs() { from } else { to };
            (n * distance + n.perp() * end - at).norm().copysign(above)
        }
        ProfileSegment::Arc { centre, radius, normals: [from, to] } => {
            let way = at - centre;
            // The outward normal points away from the centre, for a hollow arc toward it.
            let outward = if radius < 0.0 { -way } else { way };
            if segment.faces(outward.angle()) {
                return if radius < 0.0 { -radius - way.norm() } else { way.norm() - radius };
            }
            let ends = [from, to].map(|n| {
                let n = Vec2::from_angle(n);
                let off = at - (centre + n * radius);
                off.norm().copysign(n.dot(off))
            });
            if ends[0].abs() < ends[1].abs() { ends[0] } else { ends[1] }
        }
    }
}

/// Returns the support of a profile in a direction: the greatest coordinate of its points along it,
/// from the origin of its frame.
fn support(segments: &[ProfileSegment], n: Vec2) -> Option<f64> {
    let reach = |s: &ProfileSegment| match *s {
        ProfileSegment::Line { normal, distance, ends } => {
            let m = Vec2::from_angle(normal);
            ends.map(|t| n.dot(m * distance + m.perp() * t))
                .into_iter()
                .fold(f64::NEG_INFINITY, f64::max)
        }
        ProfileSegment::Arc { centre, radius, normals } => {
            let within = radius >= 0.0 && s.faces(n.angle());
            let ends = normals.map(|a| n.dot(centre + Vec2::from_angle(a) * radius));
            ends.into_iter()
                .chain(within.then(|| n.dot(centre) + radius))
                .fold(f64::NEG_INFINITY, f64::max)
        }
    };
    segments.iter().map(reach).max_by(f64::total_cmp)
}
