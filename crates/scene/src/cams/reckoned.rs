//! Places of points in the pose, as far as they are needed to select a piece of a profile: from
//! coordinates, from drivers that turn links about known points, and from two lengths to known
//! points with the side of the joint.
//!
//! Double precision is enough, because only a selection depends on it. If this module finds no
//! place, the scene must give the coordinates of the pose.

use super::super::model::*;
use super::expand::CamReplacement;
use super::place::{apart, coordinates_or_sketch, locals};
use hodograph_base::cam::{
    CamJet, CamMotion, Disc, Follower, FollowerTip, PieceSide, ProfileSegment,
};
use hodograph_base::geom::Vec2;

/// Known places of points.
pub(super) struct Reckoned<'a> {
    scene: &'a Scene,
    at: Vec<Option<Vec2>>,
}

impl<'a> Reckoned<'a> {
    pub fn of(scene: &'a Scene) -> Reckoned<'a> {
        let told = |p: &NamedPoint| match &p.place {
            PointPlace::At([x, y]) => Some(Vec2::new(x.value, y.value)),
            PointPlace::Unknown | PointPlace::InLink { .. } | PointPlace::Polar { .. } => None,
        };
        let mut known = Reckoned { scene, at: scene.points.iter().map(told).collect() };
        // Each pass places at least one point, or is the last.
        for _ in 0..scene.points.len() {
            let before = known.at.iter().flatten().count();
            (0..scene.links.len()).map(LinkId).for_each(|l| known.by_link(l));
            (0..scene.points.len()).map(PointId).for_each(|p| known.by_lengths(p));
            if known.at.iter().flatten().count() == before {
                break;
            }
        }
        known
    }

    pub fn spot(&self, p: PointId) -> Option<Vec2> {
        self.at[p.0]
    }

    /// Returns a place of the fixed plane in the axes of a link: origin at its first point, x
    /// toward the second; the ground's axes are those of the plane.
    pub fn seen_from(&self, link: LinkId, at: Vec2) -> Option<Vec2> {
        if link == self.scene.ground {
            return Some(at);
        }
        let origin = self.spot(*self.scene.links[link.0].points.first()?)?;
        Some((at - origin).rotate_by(Vec2::from_angle(-self.direction(link)?)))
    }

    /// Returns the direction of a link's first two points; for the ground, the x axis.
    fn direction(&self, l: LinkId) -> Option<f64> {
        if l == self.scene.ground {
            return Some(0.0);
        }
        let [a, b, ..] = self.scene.links[l.0].points[..] else { return None };
        if let (Some(a), Some(b)) = (self.spot(a), self.spot(b)) {
            return Some((b - a).angle());
        }
        self.scene.drivers.iter().find_map(|d| match &d.kind {
            DriverKind::Turn {
                link,
                against,
                line: None,
                against_line: None,
                angle: Some(angle),
            } if *link == l => {
                Some(self.direction(*against).filter(|_| *against != l)? + angle.value.radians())
            }
            DriverKind::Turn { .. } | DriverKind::Slide { .. } | DriverKind::Cylinder { .. } => {
                None
            }
        })
    }

    /// Places all points of a link with one known point and a known direction.
    fn by_link(&mut self, l: LinkId) {
        let points = &self.scene.links[l.0].points;
        let Some(from) = points
            .iter()
            .copied()
            .find(|p| self.spot(*p).is_some())
            .filter(|_| l != self.scene.ground)
        else {
            return;
        };
        let (Some(origin), Some(angle)) = (self.spot(from), self.direction(l)) else { return };
        let Some(placed) = locals(self.scene, l, from, angle) else { return };
        for (p, local) in placed {
            self.at[p.0].get_or_insert(origin + local.rotate_by(Vec2::from_angle(angle)));
        }
    }

    /// Places a joint at two lengths from known points, on the given side.
    fn by_lengths(&mut self, p: PointId) {
        if self.spot(p).is_some() {
            return;
        }
        let beside = |l: &&Link| l.points.contains(&p);
        let near = self
            .scene
            .links
            .iter()
            .filter(beside)
            .flat_map(|l| l.points.iter().copied())
            .filter(|q| *q != p);
        let reach: Vec<(PointId, Vec2, f64)> =
            near.filter_map(|q| Some((q, self.spot(q)?, apart(self.scene, p, q)?.value))).collect();
        let pairs =
            reach.iter().enumerate().flat_map(|(i, a)| reach[i + 1..].iter().map(move |b| (a, b)));
        for ((i, a, ra), (j, b, rb)) in pairs {
            let said = self
                .scene
                .sides
                .iter()
                .find(|s| s.point == p && [(*i, *j), (*j, *i)].contains(&(s.from, s.to)));
            let rough = || {
                self.scene.points[p.0]
                    .sketch
                    .map(|[x, y]| (*b - *a).cross(Vec2::new(x, y) - *a) > 0.0)
            };
            let Some(left) = said.map(|s| s.left == (s.from == *i)).or_else(rough) else {
                continue;
            };
            let way = *b - *a;
            let d = way.norm();
            let foot = (d * d + ra * ra - rb * rb) / (2.0 * d);
            let height = (ra * ra - foot * foot).sqrt();
            if height.is_finite() {
                let u = way * (1.0 / d);
                self.at[p.0] = Some(*a + u * foot + u.perp() * if left { height } else { -height });
                return;
            }
        }
    }

    /// Returns the path of a sliding follower in the fixed plane: a place on the path of its point,
    /// and the direction of its rise.
    fn slide(&self, follower: LinkId) -> Option<(Vec2, Vec2)> {
        let guide = self.scene.guides.iter().find(|g| g.slider == Some(follower))?;
        let GuidePath::Line { through, direction, offset: None } = &guide.path else { return None };
        let through = match through {
            Through::At([x, y]) => Vec2::new(x.value, y.value),
            Through::Point(p) => self.spot(*p)?,
            Through::Pin => return None,
        };
        let direction = match direction {
            GuideDirection::Instant(angle) if guide.on == self.scene.ground => {
                Vec2::from_angle(angle.value.radians())
            }
            GuideDirection::Along(a, b, turn) => {
                let way = (self.spot(*b)? - self.spot(*a)?).unit()?;
                turn.as_ref().map_or(way, |t| way.rotate_by(Vec2::from_angle(t.value.radians())))
            }
            GuideDirection::Instant(_) | GuideDirection::Own | GuideDirection::Slid(_) => {
                return None;
            }
        };
        Some((through, direction))
    }

    /// Returns the pivot of a swinging follower.
    fn pivot(&self, follower: LinkId, end: PointId) -> Option<(PointId, Vec2)> {
        let joint = |p: &PointId| *p != end && self.scene.carriers(*p).any(|l| l != follower);
        self.scene.links[follower.0]
            .points
            .iter()
            .copied()
            .filter(joint)
            .find_map(|p| Some((p, self.spot(p)?)))
    }
}

/// The contact in the pose.
pub(super) struct Touching<'a> {
    pub segments: &'a [ProfileSegment],
    /// The first point of the cam, the origin of the frame of the pieces; the fields below are its
    /// place and the angle of that frame.
    pub centre: PointId,
    pub origin: Vec2,
    pub angle: f64,
    /// Radius of a round end; `None` for a face.
    pub end: Option<f64>,
    /// For a face: its outward sense, its distance from its pivot, and the end of its line.
    pub face: (f64, f64, Option<PointId>),
}

impl CamReplacement<'_> {
    /// Returns the piece in contact with a follower, and the resulting place of a point of the
    /// follower; `None` if the path of the follower is not known.
    pub(super) fn held_by(
        &self,
        known: &Reckoned,
        (follower, point): (LinkId, PointId),
        t: &Touching,
    ) -> Option<(usize, Option<(PointId, Vec2)>)> {
        let slides = self.bare.guides.iter().any(|g| g.slider == Some(follower));
        let geometry = if slides {
            let (through, rise) = known.slide(follower)?;
            // The face is square to its guide, turned from it by +90°; the cam is to the left or
            // right of it.
            let direction = if t.end.is_none() { rise * -t.face.0 } else { rise };
            Follower::Translating { direction, offset: -(through - t.origin).dot(direction.perp()) }
        } else {
            match t.end {
                Some(_) => {
                    let (pivot, at) = known.pivot(follower, point)?;
                    let arm = apart(self.bare, pivot, point)?.value;
                    let sense = super::place::sense(
                        self.bare,
                        [pivot, t.centre, point],
                        [at, t.origin],
                        coordinates_or_sketch(self.bare, point),
                    );
                    Follower::Oscillating { pivot: at - t.origin, arm, sense }
                }
                None => Follower::Oscillating {
                    pivot: known.spot(point)? - t.origin,
                    arm: 0.0,
                    sense: t.face.0,
                },
            }
        };
        let touch = match t.end {
            Some(radius) => FollowerTip::Point { radius },
            None => FollowerTip::Flat { lever: if slides { 0.0 } else { t.face.1 } },
        };
        let disc = Disc {
            follower: geometry,
            touch,
            motion: CamMotion::Profile(t.segments.to_vec()),
            sense: 1.0,
        };
        let disc = self
            .on_its_side(disc, t.angle, (self.bare.ground, t.origin), point, &|q| known.spot(q));
        let (touched, q) = match self.on {
            Some(piece) => (
                piece,
                t.segments[piece].coordinate(
                    &disc.follower,
                    &disc.touch,
                    CamJet::variable(t.angle),
                ),
            ),
            None => (
                disc.touched(t.angle, PieceSide::After)?,
                disc.coordinate(t.angle, PieceSide::After)?,
            ),
        };
        let rough = match (disc.follower, t.face.2) {
            (follower, _) if t.end.is_some() => Some((point, follower)),
            // The distance of the end of the line is its length.
            (Follower::Oscillating { pivot, sense, .. }, Some(end)) => apart(self.bare, point, end)
                .map(|arm| (end, Follower::Oscillating { pivot, arm: arm.value, sense })),
            (Follower::Oscillating { .. } | Follower::Translating { .. }, _) => None,
        };
        Some((touched, rough.map(|(p, follower)| (p, t.origin + follower.point(q).order(0)))))
    }
}
