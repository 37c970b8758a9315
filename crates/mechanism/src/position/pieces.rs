//! Contact of a follower with a cam profile of several pieces, with cam and follower on different
//! moving links: the distance of the contact from the ends of each piece, in a known pose.

use super::{Configuration, Path, Pose};
use hodograph_base::cam::ProfileSegment;
use hodograph_base::geom::{Point, Vec2};
use hodograph_scene::{Cam, LinkId, Pieces, Scene};

/// A contact, in the frame of the cam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// The frame of the pieces in the plane.
    pub frame: Pose,
    end: FollowerEnd,
}

/// The end of the follower, in the frame of the pieces.
#[derive(Clone, Copy, Debug, PartialEq)]
enum FollowerEnd {
    /// A round end: its centre and radius (m).
    Round(Vec2, f64),
    /// A flat face: the direction of the outward normal (rad).
    Flat(f64),
}

/// Returns the frame of the pieces of a cam's profile.
pub fn frame(pieces: &Pieces, at: &Configuration) -> Option<Pose> {
    let [from, to] = pieces.frame;
    let origin = at.points[from.0]?;
    Some(Pose { origin, axis: (at.points[to.0]? - origin).unit()? })
}

/// Returns the contact of a cam and its follower; `None` if they are not placed, or if no pair
/// represents the contact of a flat face.
pub fn meeting(cam: &Cam, pieces: &Pieces, at: &Configuration) -> Option<Meeting> {
    let frame = frame(pieces, at)?;
    let end = match cam.follows.radius() {
        Some(radius) => {
            FollowerEnd::Round(frame.to_local(at.points[cam.follows.point().0]?).to_vec2(), radius)
        }
        None => {
            let guide = cam.contact?;
            let Path::Line { direction, .. } = at.guides[guide.0]? else { return None };
            // The cam is on the left of its face, or on the right.
            let normal = if cam.left { -direction.perp() } else { direction.perp() };
            FollowerEnd::Flat(frame.turn_back(normal).angle())
        }
    };
    Some(Meeting { frame, end })
}

impl Meeting {
    /// Returns the amounts by which the contact is beyond the beginning and beyond the end of a
    /// piece, as defined in [`ProfileSegment::beyond`].
    pub fn beyond(&self, piece: &ProfileSegment) -> [f64; 2] {
        match self.end {
            FollowerEnd::Round(at, radius) => piece.beyond(at, radius),
            FollowerEnd::Flat(direction) => piece.beyond_facing(direction),
        }
    }

    /// Returns a number with the sign of the contact's motion round the cam, positive
    /// counter-clockwise. `along` is the velocity of the follower's point relative to the
    /// coincident point of the cam, `turning` the angular velocity of the follower relative to the
    /// cam.
    pub fn onward(&self, piece: &ProfileSegment, along: Vec2, turning: f64) -> f64 {
        match self.end {
            FollowerEnd::Round(at, radius) => {
                along.dot(self.frame.turn(normal(piece, at, radius)).perp())
            }
            FollowerEnd::Flat(_) => turning,
        }
    }
}

/// Returns the outward normal of a piece at a round end.
fn normal(piece: &ProfileSegment, at: Vec2, radius: f64) -> Vec2 {
    match piece {
        ProfileSegment::Arc { centre, radius: rho, .. } => (at - *centre) * (1.0 / (rho + radius)),
        ProfileSegment::Line { normal, .. } => Vec2::from_angle(*normal),
    }
}

/// Returns the path of a cam's contact in the link that carries it, for contact with another piece:
/// a slot of the cam about the piece's centre or along its line; for a flat face the guide of that
/// centre. `at` is a pose in which the cam touches `now`.
pub fn path_on(
    scene: &Scene,
    cam: &Cam,
    pieces: &Pieces,
    at: &Configuration,
    [now, piece]: [usize; 2],
) -> Option<Path> {
    let guide = cam.contact?;
    let segments = &pieces.segments;
    if let Some(radius) = cam.follows.radius() {
        let frame = frame(pieces, at)?;
        let pose = link_pose(scene, cam.cam, at)?;
        let (to_link, turned) = (
            |v: Vec2| pose.to_local(frame.to_world(v.to_point())),
            |v: Vec2| pose.turn_back(frame.turn(v)),
        );
        return Some(match segments[piece] {
            ProfileSegment::Arc { centre, radius: rho, .. } => {
                Path::Arc { centre: to_link(centre), radius: (rho + radius).abs() }
            }
            ProfileSegment::Line { normal, distance, .. } => {
                let n = Vec2::from_angle(normal);
                Path::Line {
                    through: to_link(n * (distance + radius)),
                    direction: turned(n.perp()),
                }
            }
        });
    }
    let Path::Line { through, direction } = at.shapes.guides[guide.0]? else { return None };
    let radius = |k: usize| match segments[k] {
        ProfileSegment::Arc { radius, .. } => Some(radius),
        ProfileSegment::Line { .. } => None,
    };
    let out = radius(piece)? - radius(now)?;
    let toward = if cam.left { direction.perp() } else { -direction.perp() };
    Some(Path::Line { through: through + toward * out, direction })
}

/// Returns the centre of a piece in the frame of the cam's link; `None` for a line.
pub fn centre(
    scene: &Scene,
    cam: &Cam,
    pieces: &Pieces,
    at: &Configuration,
    piece: usize,
) -> Option<Point> {
    let ProfileSegment::Arc { centre, .. } = pieces.segments[piece] else { return None };
    Some(link_pose(scene, cam.cam, at)?.to_local(frame(pieces, at)?.to_world(centre.to_point())))
}

fn link_pose(scene: &Scene, link: LinkId, at: &Configuration) -> Option<Pose> {
    if link == scene.ground { Some(Pose::GROUND) } else { at.poses[link.0] }
}
