//! A profile of arcs and lines: checks its parts, finds the piece in contact, writes the pair of
//! that piece and selects the assembly.

use super::super::model::*;
use super::super::raw::{RawQuantity, RawScene};
use super::super::units::RequiredQuantity;
use super::TurningCam;
use super::carrier::Lacking;
use super::expand::{CamReplacement, Pending, note};
use super::pairs::{CamPair, Worded, numbers};
use super::place::{self, CarriedFollower, NumberText, OnPivot};
use super::raw::*;
use hodograph_base::cam::outline::{Broken, segments};
use hodograph_base::cam::{CamMotion, Disc, Follower, FollowerTip, PieceSide, Surveyed};
use hodograph_base::diag::{Diagnostic, Faults, both};
use hodograph_base::geom::Vec2;
use hodograph_base::json::Word;

impl CamReplacement<'_> {
    pub(super) fn by_parts(
        &self,
        raw: &mut RawScene,
        parts: &[RawPart],
        (cam, follower, point): (LinkId, LinkId, PointId),
        (end, placed): (Option<NumberText>, Result<(OnPivot, CarriedFollower), Lacking>),
        pending: &mut Pending,
        faults: &mut Faults,
    ) -> Option<()> {
        let worded = self.worded(cam, parts, faults)?;
        let (follows, offset, sense) = match &self.raw.follows {
            RawFollows::Face(face) => {
                let (face, offset, sense) =
                    self.face(placed.as_ref().ok().map(|p| &p.1), face, faults)?;
                pending.left = face.left.unwrap_or(true);
                (RawFollows::Face(face), offset, sense)
            }
            round @ (RawFollows::Edge(_) | RawFollows::Roller { .. } | RawFollows::Arc { .. }) => {
                (round.clone(), None, 1.0)
            }
        };
        pending.radii = worded.iter().map(|w| w.radius().map(|r| r.text.clone())).collect();
        if let [Worded::Circle { centre, radius }] = worded.as_slice() {
            pending.circle = Some((centre.clone(), radius.value));
        }
        // The direction of a face that slides on a moving link follows from the pose; a profile of
        // one circle does not need it.
        let leans = |p: &(OnPivot, CarriedFollower)| {
            matches!((&follows, &p.1), (RawFollows::Face(f), CarriedFollower::Guide { .. }) if !f.square)
                && p.0.frame != self.bare.ground
        };
        if let Ok(p) = &placed
            && leans(p)
            && worded.len() > 1
        {
            return self.no_line(p.0.frame, faults);
        }
        let geometry = placed
            .as_ref()
            .ok()
            .filter(|p| !leans(p))
            .and_then(|p| self.follower(p, point, offset.as_ref(), sense));
        let lever = match (&follows, &offset) {
            (RawFollows::Face(_), Some(o)) => {
                Some(if sense < 0.0 { format!("-({})", o.text) } else { o.text.clone() })
            }
            _ => end.as_ref().map(|r| r.text.clone()),
        };
        let contact = CamPair {
            cam: &self.raw.cam.text,
            follower: &self.raw.follower.text,
            follows: &follows,
            end: end.clone(),
            offset,
            span: self.raw.span,
        };
        let mut touched = 0;
        if let (Ok((on, carried)), Some((follower, touch, _))) = (&placed, geometry) {
            let local = |name: &str| {
                let id =
                    self.names.point(&Word { text: name.to_owned(), span: self.raw.span }).ok()?;
                on.local.iter().find(|(p, _)| *p == id).map(|(_, at)| *at)
            };
            let Some(parts) = worded.iter().map(|w| numbers(w, local)).collect::<Option<Vec<_>>>()
            else {
                return self.no_pose(None, faults);
            };
            let segments = segments(&parts).map_err(|broken| self.broken(broken, faults)).ok()?;
            let touch = match touch {
                FollowerTip::Point { .. } => {
                    FollowerTip::Point { radius: end.as_ref().map_or(0.0, |r| r.value) }
                }
                FollowerTip::Flat { lever } => FollowerTip::Flat { lever },
            };
            let backward = on.rate < 0.0 || on.rate == 0.0 && on.acceleration < 0.0;
            let turn = if backward { -1.0 } else { 1.0 };
            let disc = Disc { follower, touch, motion: CamMotion::Profile(segments), sense: turn };
            let phi = turn * on.angle.value;
            let disc = self
                .on_its_side(disc, phi, (on.frame, on.spot.at()), point, &|q| self.spot_on(on, q));
            let Some(found) = disc.touched(phi, PieceSide::After) else {
                return self.no_contact(faults);
            };
            touched = found;
            self.joint(&disc, phi, on, faults);
            pending.rough = self.sketch(raw, &disc, phi, (on, &follows));
            let (origin, outward) = place::origin(carried, on.spot.at(), &disc.follower);
            let turning = TurningCam {
                frame: on.frame,
                pivot: PointId(0),
                disc,
                survey: Surveyed::default(),
                phi,
                driver: on.driver,
                way: on.way,
                from: on.from,
                by_law: None,
                start: 0.0,
                origin,
                outward,
                touched: Some(found),
                rough: None,
                side: PieceSide::After,
                texts: self.texts(
                    (on, carried),
                    (point, lever),
                    (phi, "0 deg"),
                    self.profile_texts(cam, on.pivot, &on.local, &worded),
                ),
            };
            pending.disc = Some((self.bare.point_name(on.pivot).to_owned(), turning));
        } else if worded.len() > 1 {
            let why = placed.as_ref().err();
            let lies = (contact.offset.as_ref(), sense);
            let posed = self.by_pose(
                &worded,
                (cam, follower, point),
                (&follows, end.as_ref()),
                lies,
                why,
                faults,
            )?;
            if let Some((p, at)) = posed.rough {
                self.sketched(raw, self.bare.point_name(p), at);
            }
            touched = posed.touched;
            pending.posed = Some(posed);
        }
        pending.contact = Some(raw.guides.len());
        contact.write(raw, &worded, touched)
    }

    /// Reports a face that slides on a moving link: the guide that replaces its contact has a
    /// direction at the instant only.
    fn no_line<T>(&self, frame: LinkId, faults: &mut Faults) -> Option<T> {
        let (follower, frame) = (&self.raw.follower.text, self.bare.link_name(frame));
        let message = both!(
            "the face of `{follower}` slides on the moving link `{frame}`: its direction follows from the pose, which only coordinates tell before the contact is replaced"
        );
        faults.push(Diagnostic::error("cam-pose", message).at(self.raw.span).help(both!(
            "give the profile as a law or as one circle with an \"angle\" of the face, or let the carrier be the ground (`hodograph inversions`)"
        )));
        None
    }

    /// Selects the assembly by the place of a point of the follower in the pose. On the ground the
    /// place is added to the sketch; on a moving link it is returned, in the axes of that link.
    pub(super) fn sketch(
        &self,
        raw: &mut RawScene,
        disc: &Disc,
        phi: f64,
        (on, follows): (&OnPivot, &RawFollows),
    ) -> Option<(String, Vec2)> {
        let q = disc.coordinate(phi, PieceSide::After)?;
        let (name, at) = match (follows, disc.touch, disc.follower) {
            (_, FollowerTip::Point { .. }, _) => {
                (follows.pin()?.text.clone(), disc.follower.point(q).order(0))
            }
            (
                RawFollows::Face(face),
                FollowerTip::Flat { .. },
                Follower::Oscillating { pivot, sense, .. },
            ) => {
                let (from, to) = self.names.pair(face.line.as_ref()?).ok()?;
                let arm = place::apart(self.bare, from, to)?.value;
                let reach =
                    Disc { follower: Follower::Oscillating { pivot, arm, sense }, ..disc.clone() };
                (self.bare.point_name(to).to_owned(), reach.follower.point(q).order(0))
            }
            (_, FollowerTip::Flat { .. }, _) => return None,
        };
        let at = on.spot.at() + at;
        if on.frame != self.bare.ground {
            let said = raw.sketch.iter().any(|(w, _)| w.text == name)
                || raw.points.iter().any(|(w, _)| w.text == name);
            return (!said).then_some((name, at));
        }
        self.sketched(raw, &name, at);
        None
    }

    /// Adds the place of a point in the pose to the sketch, unless the scene gives it.
    fn sketched(&self, raw: &mut RawScene, name: &str, at: Vec2) {
        if raw.sketch.iter().any(|(w, _)| w.text == name)
            || raw.points.iter().any(|(w, _)| w.text == name)
        {
            return;
        }
        let quantity =
            |x: f64| RawQuantity { text: format!("({x:?}) m"), span: self.raw.span, bare: false };
        raw.sketch.push((
            Word { text: name.to_owned(), span: self.raw.span },
            [quantity(at.x), quantity(at.y)],
        ));
    }

    /// Returns the parts with texts and checked numbers.
    pub(super) fn worded(
        &self,
        cam: LinkId,
        parts: &[RawPart],
        faults: &mut Faults,
    ) -> Option<Vec<Worded>> {
        let n = parts.len();
        let centre = |i: usize| match &parts[i % n] {
            RawPart::Circle { centre, .. } | RawPart::Corner(centre) => Some(centre),
            RawPart::Tangent(_) | RawPart::Flank(_) => None,
        };
        let mut out = Vec::new();
        let before = faults.list.len();
        for (i, part) in parts.iter().enumerate() {
            if let Some(word) = centre(i)
                && let Some(p) = note(self.names.point(word), faults)
                && !self.bare.links[cam.0].points.contains(&p)
            {
                let message = both!(
                    "centre `{}` is not a point of the cam `{}`",
                    word.text,
                    self.raw.cam.text
                );
                faults.push(
                    Diagnostic::error("not-on-link", message)
                        .at(word.span)
                        .help(both!("name it in \"links\" among the points of the cam")),
                );
            }
            match part {
                RawPart::Circle { centre, radius } => {
                    let radius = self.positive(radius, faults);
                    out.extend(
                        radius.map(|radius| Worded::Circle { centre: centre.text.clone(), radius }),
                    );
                }
                RawPart::Corner(p) => {
                    out.push(Worded::Circle {
                        centre: p.text.clone(),
                        radius: NumberText { value: 0.0, text: "0 mm".into() },
                    });
                }
                RawPart::Flank(radius) => out.extend(
                    self.number_text(radius, RequiredQuantity::Length, faults)
                        .map(|radius| Worded::Flank { radius }),
                ),
                RawPart::Tangent(span) => {
                    let ends = centre(i + n - 1).zip(centre(i + 1));
                    let ids = ends
                        .and_then(|(a, b)| self.names.point(a).ok().zip(self.names.point(b).ok()));
                    let Some((a, b)) = ids else { continue };
                    match place::apart(self.bare, a, b) {
                        Some(apart) => out.push(Worded::Tangent { apart }),
                        None => {
                            let [a, b] = [a, b].map(|p| self.bare.point_name(p));
                            let message = both!(
                                "the tangent of the circles about {a} and {b} needs their distance"
                            );
                            faults.push(
                                Diagnostic::error("cam-centres", message)
                                    .at(*span)
                                    .help(both!("add \"{a},{b}\" to \"lengths\"")),
                            );
                        }
                    }
                }
            }
        }
        if out.len() < n && faults.list.len() == before {
            let at = parts.iter().position(|p| matches!(p, RawPart::Tangent(_))).unwrap_or(0);
            self.broken(Broken::NoNeighbour(at), faults);
        }
        (faults.list.len() == before && out.len() == n && n > 0).then_some(out)
    }

    pub(super) fn broken(&self, broken: Broken, faults: &mut Faults) {
        let message = match broken {
            Broken::NoCircle => both!("the profile has no circle"),
            Broken::NoNeighbour(i) => {
                both!("part {} of the profile has no circle on both sides", i + 1)
            }
            Broken::Apart(i) => both!(
                "part {} of the profile cannot touch its neighbours: their centres are too near or too far apart",
                i + 1
            ),
        };
        faults.push(Diagnostic::error("cam-profile", message).at(self.raw.span).help(both!(
            "list arcs and lines counter-clockwise round the cam: a circle, \"tangent\" or {{\"radius\"}}, the next circle, ..."
        )));
    }
}
