//! Replaces every cam of the raw scene by pairs, points and drivers.

use std::collections::HashSet;

use super::super::model::*;
use super::super::names::Names;
use super::super::raw::{RawQuantity, RawScene};
use super::super::units::RequiredQuantity;
use super::super::values::Values;
use super::by_pose::PosedProfile;
use super::carrier::Lacking;
use super::place::{self, CarriedFollower, NumberText, OnPivot};
use super::raw::*;
use super::reckoned::Reckoned;
use super::{Cam, Follows, Pieces, TurningCam};
use hodograph_base::cam::{CamMotion, Disc, Follower, FollowerTip, PieceSide};
use hodograph_base::diag::{Both, Diagnostic, Faults, Span, both};
use hodograph_base::digits::significant;
use hodograph_base::geom::Vec2;
use hodograph_base::json::Word;

/// A scene with its cams replaced by other pairs, and the cams with the names of their points.
pub(crate) struct Expanded {
    pub raw: RawScene,
    cams: Vec<Pending>,
    /// Parameters that occur only in pieces without contact.
    pub used: HashSet<String>,
}

pub(super) struct Pending {
    cam: String,
    follower: String,
    point: String,
    follows: fn(PointId, f64) -> Follows,
    radius: f64,
    at: Option<String>,
    roller: Option<String>,
    /// For a face: true if the cam is to the left of it.
    pub left: bool,
    end: Option<String>,
    /// Texts of the radii of the pieces.
    pub radii: Vec<Option<String>>,
    pub circle: Option<(String, f64)>,
    pub disc: Option<(String, TurningCam)>,
    pub contact: Option<usize>,
    pub posed: Option<PosedProfile>,
    /// Place of a point of the follower in the axes of a moving carrier.
    pub rough: Option<(String, Vec2)>,
    span: Span,
}

/// True for a fault of a contact that the pose does not determine.
fn of_the_pose(code: &str) -> bool {
    matches!(code, "cam-pose" | "no-contact" | "cam-centres" | "joint")
}

/// Writes the pairs of all cams. `bare` is the scene without them; `on` (cam, piece) overrides the
/// piece in contact in the pose.
pub(crate) fn expand(
    raw: RawScene,
    source: &str,
    bare: &Scene,
    on: Option<(usize, usize)>,
    faults: &mut Faults,
) -> Expanded {
    let parameters = raw.parameters.clone();
    let (values, _) = Values::new(source, &raw.units, &parameters, &mut Faults::default());
    let mut out = Expanded { raw: raw.clone(), cams: Vec::new(), used: HashSet::new() };
    for (i, cam) in raw.cams.iter().enumerate() {
        let on = on.filter(|(k, _)| *k == i).map(|(_, piece)| piece);
        let one = CamReplacement {
            bare,
            values: &values,
            names: Names::new(&bare.points, &bare.links),
            raw: cam,
            name: format!("cam{}", i + 1),
            on,
        };
        out.cams.extend(one.write(&mut out.raw, faults));
    }
    out.used = values.used_names();
    out
}

/// The replacement of one cam.
pub(super) struct CamReplacement<'a> {
    pub bare: &'a Scene,
    pub values: &'a Values<'a>,
    pub names: Names<'a>,
    pub raw: &'a RawCam,
    pub name: String,
    /// The piece in contact, overriding that of the pose.
    pub on: Option<usize>,
}

pub(super) fn note<T>(result: Result<T, Diagnostic>, faults: &mut Faults) -> Option<T> {
    result.map_err(|d| faults.push(d)).ok()
}

impl CamReplacement<'_> {
    pub(super) fn number_text(
        &self,
        q: &RawQuantity,
        wanted: RequiredQuantity,
        faults: &mut Faults,
    ) -> Option<NumberText> {
        if wanted == RequiredQuantity::Angle {
            let given = self.values.angle(q, faults)?;
            return Some(NumberText { value: given.value.radians(), text: given.text });
        }
        let given = self.values.si(q, wanted, faults)?;
        Some(NumberText {
            value: given.value,
            text: if given.value == 0.0 { "0 mm".into() } else { given.text },
        })
    }

    pub(super) fn positive(&self, q: &RawQuantity, faults: &mut Faults) -> Option<NumberText> {
        let given = self.values.positive_length(q, both!("the radius"), faults)?;
        Some(NumberText { value: given.value, text: given.text })
    }

    fn write(&self, raw: &mut RawScene, faults: &mut Faults) -> Option<Pending> {
        let cam = note(self.names.link(&self.raw.cam), faults);
        let follower = note(self.names.link(&self.raw.follower), faults);
        let point = match self.raw.follows.pin() {
            Some(word) => note(self.names.point(word), faults),
            None => None,
        };
        let end = match self.raw.follows.radius() {
            Some(q) => Some(self.positive(q, faults)?),
            None => None,
        };
        let (cam, follower) = (cam?, follower?);
        let untold = raw.extent.is_of_pairs();
        let point = point.or_else(|| self.any_point(follower).filter(|_| untold));
        let Some(point) = point else {
            if let RawFollows::Face(face) = &self.raw.follows
                && self.raw.follows.pin().is_none()
            {
                let d = match face.through {
                    Some(_) => Diagnostic::error(
                        "cam-follower",
                        both!(
                            "a face passes through a point of the follower, not through coordinates"
                        ),
                    ),
                    None => Diagnostic::error("missing-key", both!("\"face\" has no `through`")),
                };
                faults.push(d.at(self.raw.span).help(both!(
                    "add \"through\": \"C\", a point of the follower; a follower that slides in one guide needs none"
                )));
            }
            return None;
        };
        if cam == follower {
            let message = both!("link `{}` cannot be cam and follower at once", self.raw.cam.text);
            faults.push(Diagnostic::error("cam-follower", message).at(self.raw.follower.span));
            return None;
        }
        if !self.bare.links[follower.0].points.contains(&point) {
            let message = both!(
                "`{}` is not a point of the follower `{}`",
                self.bare.point_name(point),
                self.raw.follower.text
            );
            faults.push(Diagnostic::error("not-on-link", message).at(self.raw.follows.pin()?.span));
            return None;
        }
        let mut pending = Pending {
            cam: self.raw.cam.text.clone(),
            follower: self.raw.follower.text.clone(),
            point: self.bare.point_name(point).to_owned(),
            follows: match self.raw.follows {
                RawFollows::Edge(_) => |p, _| Follows::Edge(p),
                RawFollows::Roller { .. } => Follows::Roller,
                RawFollows::Arc { .. } => Follows::Arc,
                RawFollows::Face(_) => |p, _| Follows::Face(p),
            },
            radius: end.as_ref().map_or(0.0, |r| r.value),
            at: self.raw.at.as_ref().map(|w| w.text.clone()),
            roller: match &self.raw.follows {
                RawFollows::Roller { link, .. } => link.as_ref().map(|w| w.text.clone()),
                RawFollows::Edge(_) | RawFollows::Arc { .. } | RawFollows::Face(_) => None,
            },
            left: true,
            end: end.as_ref().map(|r| r.text.clone()),
            radii: Vec::new(),
            circle: None,
            disc: None,
            contact: None,
            posed: None,
            rough: None,
            span: self.raw.span,
        };
        let (before, known) = (untold.then(|| raw.clone()), faults.list.len());
        let placed = self.carried(cam, follower);
        self.behind_wheels(raw, cam, placed.as_ref().ok().map(|p| &p.0), faults)?;
        let told = match &self.raw.profile {
            _ if self.raw.follows.lacks_radius() || self.no_point_of_face() => None,
            RawProfile::Untold => None,
            RawProfile::Parts(parts) => self.by_parts(
                raw,
                parts,
                (cam, follower, point),
                (end, placed),
                &mut pending,
                faults,
            ),
            RawProfile::Law { base, start, clockwise, stages } => {
                let slides = self.bare.guides.iter().any(|g| g.slider == Some(follower));
                let law = self.law(base, start, *clockwise, stages, !slides, faults);
                law.and_then(|law| {
                    self.by_law(raw, law, point, (end, placed), &mut pending, faults)
                })
            }
        };
        match (told, before) {
            (Some(()), _) => {}
            // A mobility count needs no more than the existence of the contact.
            (None, Some(before)) if faults.list[known..].iter().all(|d| of_the_pose(d.code)) => {
                faults.list.truncate(known);
                *raw = before;
                self.replace_for_count(raw, &mut pending);
            }
            (None, _) => return None,
        }
        Some(pending)
    }

    /// True for a face without a named point.
    fn no_point_of_face(&self) -> bool {
        matches!(self.raw.follows, RawFollows::Face(_)) && self.raw.follows.pin().is_none()
    }

    /// Returns any point of a link.
    fn any_point(&self, link: LinkId) -> Option<PointId> {
        self.bare.links[link.0].points.first().copied()
    }

    /// Returns the face as written and completed, its offset, and the outward sense (±1).
    pub(super) fn face(
        &self,
        carried: Option<&CarriedFollower>,
        face: &RawFace,
        faults: &mut Faults,
    ) -> Option<(RawFace, Option<NumberText>, f64)> {
        let offset = match &face.offset {
            Some(q) => Some(self.number_text(q, RequiredQuantity::Length, faults)?),
            None => None,
        };
        let mut face = face.clone();
        let mut offset = offset;
        if let (Some(CarriedFollower::Pivot { pivot, .. }), Some(line), None) =
            (carried, &face.line, &face.angle)
            && let Ok((from, to)) = self.names.pair(line)
            && to == *pivot
            && from != *pivot
        {
            // From the pivot, the line has the opposite sense, and left becomes right.
            let text = format!("{},{}", self.bare.point_name(to), self.bare.point_name(from));
            face.line = Some(Word { text, span: line.span });
            face.left = Some(!face.left.unwrap_or(true));
            offset = offset.map(|o| NumberText { value: -o.value, text: format!("-({})", o.text) });
        }
        if let Some(CarriedFollower::Guide { angle: guide, .. }) = carried {
            match &face.angle {
                None if face.line.is_none() && !face.square => {
                    face.angle = Some(RawQuantity {
                        text: format!("({})+90 deg", guide.text),
                        span: self.raw.span,
                        bare: false,
                    });
                    face.left = Some(face.left.unwrap_or(true));
                }
                // The positive sense of the guide is the rise, unless the scene has the cam's side.
                Some(q) if face.left.is_none() => {
                    let u = Vec2::from_angle(
                        self.number_text(q, RequiredQuantity::Angle, faults)?.value,
                    );
                    face.left = Some(u.perp().dot(Vec2::from_angle(guide.value)) < 0.0);
                }
                _ => {}
            }
        }
        let sense = if face.left.unwrap_or(true) { -1.0 } else { 1.0 };
        Some((face, offset, sense))
    }

    /// True without a face, or if it is square to its guide and passes through its pin.
    fn is_square_to_guide(&self, guide: f64) -> bool {
        let RawFollows::Face(face) = &self.raw.follows else { return true };
        let angle = face
            .angle
            .as_ref()
            .and_then(|q| self.number_text(q, RequiredQuantity::Angle, &mut Faults::default()));
        // Written angles have about nine digits.
        face.line.is_none()
            && face.offset.is_none()
            && angle.is_none_or(|a| libm::cos(a.value - guide).abs() < 1e-9)
    }

    /// Returns −1 for a face along its guide turned by +90°, +1 for the opposite sense.
    fn turned_from_guide(&self, guide: f64) -> f64 {
        let RawFollows::Face(face) = &self.raw.follows else { return -1.0 };
        let angle = face
            .angle
            .as_ref()
            .and_then(|q| self.number_text(q, RequiredQuantity::Angle, &mut Faults::default()));
        angle.map_or(-1.0, |a| if libm::sin(a.value - guide) < 0.0 { 1.0 } else { -1.0 })
    }

    /// Returns the given place of a point in the axes of a link, if both have a place.
    fn coordinates_or_sketch_in(&self, frame: LinkId, point: PointId) -> Option<Vec2> {
        Reckoned::of(self.bare).seen_from(frame, place::coordinates_or_sketch(self.bare, point)?)
    }

    /// Returns the cam with its follower on the side that the scene states. In a guide this is the
    /// side nearer to the coordinates or the sketch of the contact point. On an arm it is the side,
    /// given by `side`, of the line in which the two assemblies are mirror images: that of the
    /// pivots, and on a circular cam that of the arm's pivot and the circle's centre, which the arm
    /// never crosses. `at` returns the places of points in the pose.
    pub(super) fn on_its_side(
        &self,
        disc: Disc,
        phi: f64,
        (frame, centre): (LinkId, Vec2),
        point: PointId,
        at: &dyn Fn(PointId) -> Option<Vec2>,
    ) -> Disc {
        let other = match (disc.touch, disc.follower) {
            (FollowerTip::Point { .. }, Follower::Translating { direction, offset }) => {
                Follower::Translating { direction: -direction, offset: -offset }
            }
            (FollowerTip::Point { .. }, Follower::Oscillating { pivot, arm, sense }) => {
                Follower::Oscillating { pivot, arm, sense: -sense }
            }
            (FollowerTip::Flat { .. }, _) => return disc,
        };
        let other = Disc { follower: other, ..disc.clone() };
        let place = |d: &Disc| {
            Some(centre + d.follower.point(d.coordinate(phi, PieceSide::After)?).order(0))
        };
        if let Follower::Oscillating { .. } = disc.follower {
            if !matches!(&disc.motion, CamMotion::Profile(pieces) if pieces.len() == 1) {
                return disc;
            }
            let (Some(own), Some(mirrored)) = (place(&disc), place(&other)) else { return disc };
            let swaps = |s: &super::super::model::Side| {
                let [from, to] = [at(s.from)?, at(s.to)?];
                let off = |end: Vec2| {
                    ((own - end).norm() - (mirrored - end).norm()).abs()
                        <= 1e-9 * (to - from).norm()
                };
                let left = |b: Vec2| (to - from).cross(b - from) > 0.0;
                Some(off(from) && off(to) && left(own) != s.left && left(mirrored) == s.left)
            };
            let mut said = self.bare.sides.iter().filter(|s| s.point == point);
            return if said.any(|s| swaps(s) == Some(true)) { other } else { disc };
        }
        let Some(told) = self.coordinates_or_sketch_in(frame, point) else { return disc };
        let off = |d: &Disc| Some((place(d)? - told).norm());
        match (off(&disc), off(&other)) {
            (Some(a), Some(b)) if b < a => other,
            (None, Some(_)) => other,
            (Some(_) | None, _) => disc,
        }
    }

    /// Returns the place of a point of the carrying link, or of the cam, in the pose, in the axes
    /// of the carrying link.
    pub(super) fn spot_on(&self, on: &OnPivot, point: PointId) -> Option<Vec2> {
        let of_cam = on
            .local
            .iter()
            .find(|(p, _)| *p == point)
            .map(|(_, at)| on.spot.at() + at.rotate_by(Vec2::from_angle(on.angle.value)));
        of_cam.or_else(|| Some(self.spot_in(on.frame, point)?.at()))
    }

    /// True for a face given by its pivot alone, or by a line that begins there.
    fn goes_out_from(&self, pivot: PointId) -> bool {
        let RawFollows::Face(face) = &self.raw.follows else { return true };
        let begins = |w: &Word| self.names.pair(w).is_ok_and(|(a, _)| a == pivot);
        face.angle.is_none() && face.line.as_ref().is_none_or(begins)
    }

    /// Returns the geometry of the follower; `None` unless it is that of a cam on the ground.
    pub(super) fn follower(
        &self,
        placed: &(OnPivot, CarriedFollower),
        point: PointId,
        offset: Option<&NumberText>,
        sense: f64,
    ) -> Option<(Follower, FollowerTip, Option<NumberText>)> {
        let (cam, carried) = placed;
        let face = matches!(self.raw.follows, RawFollows::Face(_));
        let (arm, sense) = match carried {
            CarriedFollower::Guide { pin, angle, .. }
                if *pin == point && self.is_square_to_guide(angle.value) =>
            {
                (None, if face { sense * self.turned_from_guide(angle.value) } else { 1.0 })
            }
            CarriedFollower::Guide { .. } => return None,
            CarriedFollower::Pivot { pivot, .. } if face => {
                return (*pivot == point && self.goes_out_from(*pivot)).then(|| {
                    let lever = offset.map_or(0.0, |o| o.value) * sense;
                    (
                        place::geometry(carried, cam.spot.at(), 0.0, sense),
                        FollowerTip::Flat { lever },
                        None,
                    )
                });
            }
            CarriedFollower::Pivot { pivot, spot } => {
                let arm = place::apart(self.bare, *pivot, point)?;
                let told = self.coordinates_or_sketch_in(cam.frame, point);
                (
                    Some(arm),
                    place::sense(
                        self.bare,
                        [*pivot, cam.pivot, point],
                        [spot.at(), cam.spot.at()],
                        told,
                    ),
                )
            }
        };
        let geometry =
            place::geometry(carried, cam.spot.at(), arm.as_ref().map_or(0.0, |a| a.value), sense);
        let touch = if face {
            FollowerTip::Flat { lever: 0.0 }
        } else {
            FollowerTip::Point { radius: 0.0 }
        };
        Some((geometry, touch, arm))
    }

    /// Reports that the piece in contact is unknown; `why` is the fault on the carrying link.
    pub(super) fn no_pose<T>(&self, why: Option<&Lacking>, faults: &mut Faults) -> Option<T> {
        let why = why.map_or(Both::default(), |l| both!(": {}", l.what));
        let d = Diagnostic::error(
            "cam-pose",
            both!(
                "nothing tells which part of the profile of cam `{}` is touched{}",
                self.raw.cam.text,
                why
            ),
        );
        faults.push(d.at(self.raw.span).help(both!(
            "let one link, the ground or another, carry the pivot of the cam and the guide (through the point that touches) or pivot of the follower, and give the cam a driver against it with \"angle\"; where different links carry them, give the angles of their drivers, or coordinates of the cam's first two points and of the point that touches (of a face its \"angle\")"
        )));
        None
    }

    pub(super) fn no_contact<T>(&self, faults: &mut Faults) -> Option<T> {
        let d = Diagnostic::error(
            "no-contact",
            both!(
                "the follower `{}` does not reach the profile of cam `{}` in this pose",
                self.raw.follower.text,
                self.raw.cam.text
            ),
        );
        faults.push(
            d.at(self.raw.span)
                .help(both!("check the radii, the offset of the guide and the length of the arm")),
        );
        None
    }

    /// Reports the jump of the acceleration at a joint of two pieces, with both values.
    pub(super) fn joint(&self, disc: &Disc, phi: f64, on: &OnPivot, faults: &mut Faults) {
        let sides = [PieceSide::Before, PieceSide::After].map(|side| disc.coordinate(phi, side));
        let [Some(before), Some(after)] = sides else { return };
        if disc.touched(phi, PieceSide::Before) == disc.touched(phi, PieceSide::After)
            && matches!(disc.motion, CamMotion::Profile(_))
        {
            return;
        }
        let a = [before, after]
            .map(|q| q.0[2] * on.rate * on.rate + q.0[1] * on.acceleration * disc.sense);
        if (a[0] - a[1]).abs() <= 1e-9 * a[0].abs().max(a[1].abs()) {
            return;
        }
        let unit = match disc.follower {
            Follower::Translating { .. } => "m/s²",
            Follower::Oscillating { .. } => "rad/s²",
        };
        let [b, a] = a.map(|a| significant(a, 4));
        let message = both!(
            "two pieces of the profile meet here: the acceleration of `{}` jumps from {b} to {a} {unit}; drawn is what follows",
            self.raw.follower.text
        );
        faults.push(Diagnostic::note("joint", message).at(self.raw.span));
    }
}

impl Expanded {
    /// Returns the cams of the resolved scene.
    pub fn cams(self, scene: &Scene) -> Vec<Cam> {
        let point = |name: &str| scene.points.iter().position(|p| p.name == name).map(PointId);
        let link = |name: &str| scene.links.iter().position(|l| l.name == name).map(LinkId);
        let one = |p: Pending| {
            let disc = p.disc.and_then(|(pivot, turning)| {
                Some(TurningCam {
                    pivot: point(&pivot)?,
                    rough: p.rough.and_then(|(name, at)| Some((point(&name)?, at))),
                    ..turning
                })
            });
            Some(Cam {
                cam: link(&p.cam)?,
                follower: link(&p.follower)?,
                follows: (p.follows)(point(&p.point)?, p.radius),
                touch: p
                    .at
                    .as_deref()
                    .and_then(point)
                    .filter(|p| scene.carriers(*p).next().is_none()),
                left: p.left,
                roller: p.roller,
                at: p.at,
                end: p.end,
                radii: p.radii,
                circle: p.circle.and_then(|(c, r)| Some((point(&c)?, r))),
                disc,
                contact: p.contact.map(GuideId),
                posed: p.posed.and_then(|posed| {
                    let [from, to] = posed.frame.map(|name| point(&name));
                    let (segments, texts, touched) = (posed.segments, posed.texts, posed.touched);
                    Some(Pieces {
                        frame: [from?, to?],
                        segments,
                        texts,
                        touched,
                        others: Vec::new(),
                        led: None,
                    })
                }),
                span: p.span,
            })
        };
        self.cams.into_iter().filter_map(one).collect()
    }
}
