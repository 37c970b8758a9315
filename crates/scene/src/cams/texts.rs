//! The numbers of a cam and its follower as written, so that higher-precision numbers are read from
//! the same texts.
//!
//! The choices made in double precision remain: the piece in contact, the outward side of a
//! follower, the stage of a law.

use super::super::exact::Inputs;
use super::super::model::*;
use super::expand::CamReplacement;
use super::law::LawText;
use super::pairs::Worded;
use super::place::{CarriedFollower, NumberText, OnPivot, apart};
use super::{Cam, Pieces, TurningCam};
use hodograph_base::cam::outline::{ProfilePart, segments};
use hodograph_base::cam::{
    CamMotion, Disc, ExactCam, ExactDisc, Follower, FollowerTip, ProfileSegment, Stage,
    StageMotion, StageProgram,
};
use hodograph_base::geom::Vec2;
use hodograph_base::json::Word;
use hodograph_base::number::Real;

/// The texts of all numbers in [`TurningCam`].
#[derive(Clone, Debug, PartialEq)]
pub struct Texts {
    /// φ of the texts (rad); in a scene at another φ, the program has set the position by a number.
    phi: f64,
    /// Angle of the cam, and the angle at φ = 0.
    angle: [String; 2],
    /// The cam's pivot on the link that carries it.
    centre: [String; 2],
    /// A point of the guide and its angle, or the pivot and the arm.
    follower: ([String; 2], String),
    /// Radius of a round end, or offset of a face.
    touch: String,
    motion: MotionTexts,
}

/// The texts of the profile or law that moves the follower.
#[derive(Clone, Debug, PartialEq)]
pub enum MotionTexts {
    /// Base circle; gain and angle of each stage.
    Law(String, Vec<(Option<String>, String)>),
    /// Centre of each part in the frame of the cam, and its radius.
    Profile(Vec<PartTexts>),
}

/// Centre and radius of a part, if it has them.
pub type PartTexts = (Option<[String; 2]>, Option<String>);

impl MotionTexts {
    /// Returns the texts of a law.
    pub(super) fn of_law(law: &LawText) -> MotionTexts {
        let stage =
            |s: &super::law::StageText| (s.gain.as_ref().map(|g| g.text.clone()), s.over.clone());
        MotionTexts::Law(law.base.clone(), law.stages.iter().map(stage).collect())
    }
}

impl MotionTexts {
    /// Returns the pieces of a profile in numbers of a given type; `None` for a law.
    fn segments<N: Real>(&self, inputs: &Inputs<N>) -> Option<Vec<ProfileSegment<N>>> {
        let MotionTexts::Profile(parts) = self else { return None };
        let part = |(centre, radius): &PartTexts| -> Option<ProfilePart<N>> {
            let radius = radius.as_ref().map(|r| inputs.text(r));
            Some(match (centre, radius) {
                (Some([x, y]), Some(radius)) => {
                    ProfilePart::Circle(Vec2::new(inputs.text(x)?, inputs.text(y)?), radius?)
                }
                (None, Some(radius)) => ProfilePart::Flank(radius?),
                (_, None) => ProfilePart::Tangent,
            })
        };
        segments(&parts.iter().map(part).collect::<Option<Vec<_>>>()?).ok()
    }
}

impl Pieces {
    /// Returns the pieces in numbers of a given type; `None` if the scene has no text for one of
    /// their numbers.
    pub(super) fn in_numbers<N: Real>(&self, scene: &Scene) -> Option<Vec<ProfileSegment<N>>> {
        self.texts.as_ref()?.segments(&inputs(scene))
    }
}

/// Largest difference between a text and its number, as a fraction of the size of the cam; a text
/// that differs more has another meaning.
const SAME: f64 = 1e-9;

impl CamReplacement<'_> {
    /// Returns the texts of a profile in axes of the cam with the origin at one of its points,
    /// where its points are `local`; `None` if the place of a centre has no text.
    pub(super) fn profile_texts(
        &self,
        cam: LinkId,
        begin: PointId,
        local: &[(PointId, Vec2)],
        worded: &[Worded],
    ) -> Option<MotionTexts> {
        let centre = |name: &str| -> Option<[String; 2]> {
            let p = self.names.point(&Word { text: name.to_owned(), span: self.raw.span }).ok()?;
            let known = local.iter().find(|(q, _)| *q == p)?.1;
            if p == begin {
                return Some(["0 mm", "0 mm"].map(str::to_owned));
            }
            let [from, to] = [begin, p].map(|q| self.spot_in(cam, q));
            let (from, to) = (from?, to?);
            let same = (to.at() - from.at() - known).norm() <= SAME * known.norm();
            same.then(|| from.way_to(&to))
        };
        let part = |w: &Worded| -> Option<PartTexts> {
            Some(match w {
                Worded::Circle { centre: name, radius } => {
                    (Some(centre(name)?), Some(radius.text.clone()))
                }
                Worded::Tangent { .. } => (None, None),
                Worded::Flank { radius } => (None, Some(radius.text.clone())),
            })
        };
        worded.iter().map(part).collect::<Option<Vec<_>>>().map(MotionTexts::Profile)
    }

    /// Returns the texts of a cam on a pivot and its follower; `None` if one is missing.
    pub(super) fn texts(
        &self,
        (on, carried): (&OnPivot, &CarriedFollower),
        (point, touch): (PointId, Option<String>),
        (phi, start): (f64, &str),
        motion: Option<MotionTexts>,
    ) -> Option<Texts> {
        let of = |x: &NumberText, y: &NumberText| [x.text.clone(), y.text.clone()];
        let follower = match carried {
            CarriedFollower::Guide { through, angle, .. } => {
                (of(&through.x, &through.y), angle.text.clone())
            }
            // A face has no arm.
            CarriedFollower::Pivot { pivot, spot } => (
                of(&spot.x, &spot.y),
                apart(self.bare, *pivot, point).map_or_else(|| "0 mm".to_owned(), |arm| arm.text),
            ),
        };
        Some(Texts {
            phi,
            angle: [on.angle.text.clone(), start.to_owned()],
            centre: of(&on.spot.x, &on.spot.y),
            follower,
            touch: touch.unwrap_or_else(|| "0 mm".to_owned()),
            motion: motion?,
        })
    }
}

/// Returns the parameters of a scene in numbers of a given type.
fn inputs<N: Real>(scene: &Scene) -> Inputs<'_, N> {
    let texts: Vec<(&str, &str)> =
        scene.parameters.iter().map(|(name, given)| (name.as_str(), given.text.as_str())).collect();
    Inputs::of_texts(&texts)
}

impl TurningCam {
    /// Returns the text of the angle of its driver.
    fn driver_angle<'s>(&self, scene: &'s Scene) -> Option<&'s str> {
        match &scene.drivers.get(self.driver)?.kind {
            DriverKind::Turn { angle, .. } => angle.as_ref().map(|a| a.text.as_str()),
            DriverKind::Slide { .. } | DriverKind::Cylinder { .. } => None,
        }
    }

    /// Returns the cam and φ in numbers of a given type; `None` if the scene has no text for one of
    /// its numbers.
    pub fn exact<N: Real>(&self, scene: &Scene) -> Option<(ExactCam<'_, N>, N)> {
        let texts = self.texts.as_ref()?;
        let inputs = inputs::<N>(scene);
        let place = |xy: &[String; 2]| Some(Vec2::new(inputs.text(&xy[0])?, inputs.text(&xy[1])?));
        let centre = place(&texts.centre)?;
        let at = place(&texts.follower.0)? - centre;
        let last = inputs.text(&texts.follower.1)?;
        let follower = match self.disc.follower {
            Follower::Translating { direction: out, .. } => {
                let along = Vec2::from_angle(last);
                // The outward sense of the follower is along its guide, or opposite to it.
                let direction = if along.approx().dot(out) < 0.0 { -along } else { along };
                Follower::Translating { direction, offset: -at.dot(direction.perp()) }
            }
            Follower::Oscillating { sense, .. } => {
                Follower::Oscillating { pivot: at, arm: last, sense }
            }
        };
        let touch = inputs.text(&texts.touch)?;
        let touch = match self.disc.touch {
            FollowerTip::Point { .. } => FollowerTip::Point { radius: touch },
            FollowerTip::Flat { .. } => FollowerTip::Flat { lever: touch },
        };
        let motion = match (&self.disc.motion, &texts.motion) {
            (CamMotion::Law { program, .. }, MotionTexts::Law(base, stages)) => {
                let stage =
                    |(s, (gain, over)): (&Stage, &(Option<String>, String))| -> Option<Stage<N>> {
                        let gain = || inputs.text(gain.as_ref()?);
                        let way = match s.way {
                            StageMotion::Rise(_, law) => StageMotion::Rise(gain()?, law),
                            StageMotion::Dwell => StageMotion::Dwell,
                            StageMotion::Return(_, law) => StageMotion::Return(gain()?, law),
                        };
                        Some(Stage { way, over: inputs.text(over)? })
                    };
                let stages =
                    program.stages().iter().zip(stages).map(stage).collect::<Option<Vec<_>>>()?;
                CamMotion::Law { base: inputs.text(base)?, program: StageProgram::new(stages) }
            }
            (CamMotion::Profile(_), texts) => CamMotion::Profile(texts.segments(&inputs)?),
            (CamMotion::Law { .. }, MotionTexts::Profile(_)) => return None,
        };
        let disc = Disc { follower, touch, motion, sense: self.disc.sense };
        let start = inputs.text(&texts.angle[1])?;
        let turned = |angle: N| if self.disc.sense < 0.0 { start - angle } else { angle - start };
        // At the scene's own instant the texts give the angle; at another position its driver gives
        // it, and for a cam driven through wheels double precision.
        let phi = if (self.phi - texts.phi).abs() <= 4.0 * f64::EPSILON * texts.phi.abs() {
            turned(inputs.text(&texts.angle[0])?)
        } else {
            let told = self
                .driver_angle(scene)
                .filter(|_| self.is_drivers_own())
                .and_then(|text| inputs.text(text));
            let told = told.map(|angle| turned(if self.way < 0.0 { -angle } else { angle }));
            let rounding =
                8.0 * f64::EPSILON * (self.phi.abs() + self.start.abs() + self.from.abs());
            told.filter(|phi| (phi.approx() - self.phi).abs() <= rounding)
                .unwrap_or_else(|| N::from_f64(self.phi).widened(rounding))
        };
        Some((ExactCam::new(&self.disc, &self.survey, ExactDisc::new(disc)), phi))
    }
}

impl TurningCam {
    /// Returns [`TurningCam::rates`] in numbers of a given type.
    pub fn rates_in<N: Real>(&self, scene: &Scene) -> [N; 2] {
        let (driver, inputs) = (&scene.drivers[self.driver], inputs::<N>(scene));
        let way = N::from_f64(self.way * self.disc.sense);
        // The ratio of a train of wheels is a quotient in double precision.
        let way = if self.is_drivers_own() {
            way
        } else {
            way.widened(4.0 * f64::EPSILON * self.way.abs())
        };
        [Some(&driver.rate), driver.acceleration.as_ref()]
            .map(|rate| rate.map_or(N::from_f64(0.0), |r| way * inputs.number(r)))
    }

    /// Returns place, rate and acceleration of a driver that replaces the contact, in numbers of a
    /// given type: see [`Scene::set_followers`].
    pub(super) fn led_in<N: Real>(&self, scene: &Scene) -> Option<[N; 3]> {
        let (cam, phi) = self.exact::<N>(scene)?;
        let [q, dq, ddq, _] = cam.station((self.phi, self.side), phi)?.q.0;
        let (texts, inputs) = (self.texts.as_ref()?, inputs::<N>(scene));
        let origin = match cam.disc().follower {
            Follower::Translating { .. } => {
                let [from, centre] = [&texts.follower.0, &texts.centre]
                    .map(|[x, y]| Some(Vec2::new(inputs.text(x)?, inputs.text(y)?)));
                (centre? - from?).dot(Vec2::from_angle(inputs.text(&texts.follower.1)?))
            }
            Follower::Oscillating { pivot, .. } => (-pivot).angle(),
        };
        let ([w, a], out) = (self.rates_in::<N>(scene), N::from_f64(self.outward));
        Some([origin + out * q, out * dq * w, out * (ddq * w * w + dq * a)])
    }

    /// Returns the vector from the cam's pivot to the contact in the pose and the outward unit
    /// normal of the cam, in the axes of the carrying link, in numbers of a given type.
    pub fn contact_in<N: Real>(&self, scene: &Scene) -> Option<[Vec2<N>; 2]> {
        let here = (self.phi, self.side);
        let (of_cam, phi) = if N::refines() {
            let (cam, phi) = self.exact::<N>(scene)?;
            let station = cam.station(here, phi)?;
            ([station.contact, station.normal], phi)
        } else {
            let station = self.disc.station(self.phi, self.side)?;
            ([station.contact.lift(), station.normal.lift()], N::from_f64(self.phi))
        };
        let turned = Vec2::from_angle(if self.disc.sense < 0.0 { -phi } else { phi });
        Some(of_cam.map(|v| v.rotate_by(turned)))
    }
}

impl Cam {
    /// Returns the radius of its round end in numbers of a given type (m); `None` for a face.
    pub fn end_in<N: Real>(&self, scene: &Scene) -> Option<N> {
        let value = self.follows.radius()?;
        if !N::refines() {
            return Some(N::from_f64(value));
        }
        self.end.as_ref().map_or_else(
            || (value == 0.0).then(|| N::from_f64(0.0)),
            |text| inputs(scene).text(text),
        )
    }

    /// Returns the radius of the arc in contact in numbers of a given type: see
    /// [`Cam::touched_radius`].
    pub fn touched_radius_in<N: Real>(&self, scene: &Scene) -> Option<N> {
        let value = self.touched_radius()?;
        if !N::refines() {
            return Some(N::from_f64(value));
        }
        if let Some(t) =
            self.disc.as_ref().filter(|t| matches!(t.disc.motion, CamMotion::Law { .. }))
        {
            let (cam, phi) = t.exact(scene)?;
            return Some(cam.station((t.phi, t.side), phi)?.rho);
        }
        inputs(scene).text(self.radii.get(self.touched()?)?.as_ref()?)
    }
}
