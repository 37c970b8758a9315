//! The piece in contact where different links carry cam and follower: the coordinates of the pose
//! determine it.
//!
//! On one carrying link the piece follows from the angle of the cam ([`super::by_parts`]). On
//! different links the place of the cam follows from the assembly, and the assembly from the piece.
//! So the pose must give the coordinates of the cam's first two points and of the point of contact,
//! or the direction of the face.

use super::super::model::*;
use super::super::units::RequiredQuantity;
use super::carrier::Lacking;
use super::expand::{CamReplacement, note};
use super::pairs::{Worded, numbers};
use super::place::{self, NumberText};
use super::raw::*;
use super::reckoned::{Reckoned, Touching};
use super::texts::MotionTexts;
use hodograph_base::cam::ProfileSegment;
use hodograph_base::cam::outline::segments;
use hodograph_base::diag::Faults;
use hodograph_base::geom::Vec2;
use hodograph_base::json::Word;

/// A follower at a greater distance from its piece, as a fraction of the cam's size, does not touch
/// it; smaller distances are checked with those of pins from their guides.
const OFF: f64 = 1e-6;

/// A profile of several pieces placed by the pose.
pub(super) struct PosedProfile {
    /// The points of the cam that define the frame of the pieces: origin at the first, x toward the
    /// second.
    pub frame: [String; 2],
    pub segments: Vec<ProfileSegment>,
    pub texts: Option<MotionTexts>,
    pub touched: usize,
    /// Place of a point of the follower without coordinates.
    pub rough: Option<(PointId, Vec2)>,
}

impl CamReplacement<'_> {
    /// Returns the pieces in the frame of the cam's first two points, and the piece in contact in
    /// the pose.
    pub(super) fn by_pose(
        &self,
        worded: &[Worded],
        (cam, follower, point): (LinkId, LinkId, PointId),
        (follows, end): (&RawFollows, Option<&NumberText>),
        (offset, sense): (Option<&NumberText>, f64),
        why: Option<&Lacking>,
        faults: &mut Faults,
    ) -> Option<PosedProfile> {
        let [first, second, ..] = self.bare.links[cam.0].points.as_slice() else {
            return self.no_pose(why, faults);
        };
        let reckoned = Reckoned::of(self.bare);
        let (Some(origin), Some(toward)) = (reckoned.spot(*first), reckoned.spot(*second)) else {
            return self.no_pose(why, faults);
        };
        let Some(axis) = (toward - origin).unit() else { return self.no_pose(why, faults) };
        let Some(known) = place::locals(self.bare, cam, *first, axis.angle()) else {
            return self.no_pose(why, faults);
        };
        let local = |name: &str| {
            let id = self.names.point(&Word { text: name.to_owned(), span: self.raw.span }).ok()?;
            known.iter().find(|(p, _)| *p == id).map(|(_, at)| *at)
        };
        let Some(parts) = worded.iter().map(|w| numbers(w, local)).collect::<Option<Vec<_>>>()
        else {
            return self.no_pose(why, faults);
        };
        let segments = segments(&parts).map_err(|broken| self.broken(broken, faults)).ok()?;
        let texts = self.profile_texts(cam, *first, &known, worded);
        let into = |v: Vec2| v.divide_by(axis);
        let (mut rough, mut touched) = (None, None);
        let mut reckon = |line: Option<PointId>| {
            let lever = offset.map_or(0.0, |o| o.value) * sense;
            let at = Touching {
                segments: &segments,
                centre: *first,
                origin,
                angle: axis.angle(),
                end: end.map(|r| r.value),
                face: (sense, lever, line),
            };
            let edge = matches!(follows, RawFollows::Edge(_));
            let at = Touching { end: at.end.or(edge.then_some(0.0)), ..at };
            self.held_by(&reckoned, (follower, point), &at).map(|(piece, place)| {
                (touched, rough) = (Some(piece), place);
            })
        };
        match follows {
            RawFollows::Face(face) => {
                let Some(along) = self.face_direction(face, follower, faults) else {
                    let line =
                        face.line.as_ref().and_then(|w| self.names.pair(w).ok()).map(|(_, to)| to);
                    return match reckon(line) {
                        Some(()) => {
                            self.posed([*first, *second], (segments, texts), touched, rough, faults)
                        }
                        None => self.no_pose(why, faults),
                    };
                };
                // The outward normal of the cam points away from the side of the face on which the
                // cam is.
                let normal = if face.left.unwrap_or(true) { -along.perp() } else { along.perp() };
                touched = segments.iter().position(|s| s.faces(into(normal).angle()));
            }
            RawFollows::Edge(_) | RawFollows::Roller { .. } | RawFollows::Arc { .. } => {
                let Some(spot) = place::spot(self.bare, point) else {
                    return match reckon(None) {
                        Some(()) => {
                            self.posed([*first, *second], (segments, texts), touched, rough, faults)
                        }
                        None => self.no_pose(why, faults),
                    };
                };
                let at = into(spot.at() - origin);
                let missed = segments.iter().enumerate().filter_map(|(i, s)| {
                    Some((i, s.missed_by(at, end.map_or(0.0, |r| r.value))?.abs()))
                });
                touched = missed
                    .min_by(|a, b| a.1.total_cmp(&b.1))
                    .filter(|(_, missed)| *missed <= OFF * at.norm())
                    .map(|(i, _)| i);
            }
        }
        self.posed([*first, *second], (segments, texts), touched, rough, faults)
    }

    fn posed(
        &self,
        frame: [PointId; 2],
        (segments, texts): (Vec<ProfileSegment>, Option<MotionTexts>),
        touched: Option<usize>,
        rough: Option<(PointId, Vec2)>,
        faults: &mut Faults,
    ) -> Option<PosedProfile> {
        let Some(touched) = self.on.or(touched) else { return self.no_contact(faults) };
        Some(PosedProfile {
            frame: frame.map(|p| self.bare.point_name(p).to_owned()),
            segments,
            texts,
            touched,
            rough,
        })
    }

    /// Returns the direction in the pose of the guide in which a follower slides.
    fn guide_direction(&self, follower: LinkId) -> Option<Vec2> {
        let guide = self.bare.guides.iter().find(|g| g.slider == Some(follower))?;
        let GuidePath::Line { direction: GuideDirection::Along(a, b, turn), .. } = &guide.path
        else {
            return None;
        };
        let way = (place::spot(self.bare, *b)?.at() - place::spot(self.bare, *a)?.at()).unit()?;
        Some(turn.as_ref().map_or(way, |t| way.rotate_by(Vec2::from_angle(t.value.radians()))))
    }

    /// Returns the direction of a face in the pose.
    fn face_direction(
        &self,
        face: &RawFace,
        follower: LinkId,
        faults: &mut Faults,
    ) -> Option<Vec2> {
        if face.square {
            return self.guide_direction(follower).map(Vec2::perp);
        }
        let angle = match &face.angle {
            Some(q) => {
                Vec2::from_angle(self.number_text(q, RequiredQuantity::Angle, faults)?.value)
            }
            None => Vec2::unit_x(),
        };
        let Some(line) = &face.line else { return face.angle.is_some().then_some(angle) };
        let (a, b) = note(self.names.pair(line), faults)?;
        let way = place::spot(self.bare, b)?.at() - place::spot(self.bare, a)?.at();
        Some(angle.rotate_by(way.unit()?))
    }
}
