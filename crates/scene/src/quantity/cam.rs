//! `s_3`, `psi_3`, `h_3`, `Psi_3`, `Phi_3`, `pressure_3`, `rho_2/3`, `rho_min_2`: quantities of a
//! disc cam and its follower; for its whole turn also `Phi_far_3`, `Phi_back_3`, `Phi_near_3`,
//! `pressure_start_3`, `pressure_out_3`, `pressure_back_3`, `rb_min_2`, `face_half_3`.
//!
//! They follow from the geometry of the cam alone ([`hodograph_base::cam`]), in a given number type
//! from the texts of the scene. If no single link carries cam and follower, the pressure angle and
//! the radius of curvature are those of the pose: the angle of a round end's path against the
//! normal at the contact, and the radius of the arc in contact.

use super::along::along;
use super::{
    AnswerValue, Entry, FormulaInputs, Level, Meaning, Need, Of, OverSign, Quantity, ValueForm,
};
use crate::cams::{Cam, TurningCam};
use crate::model::{Find, GuideId, GuidePath, LinkId, PointId, Scene};
use crate::resolve::Question;
use hodograph_base::cam::{
    CamExtreme, CamMotion, Fault, Follower, FollowerTip, PieceSide, in_turn, least_base,
};
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::digits::significant;
use hodograph_base::geom::Vec2;
use hodograph_base::kind::Kind;
use hodograph_base::lang::each;
use hodograph_base::number::Real;

/// A quantity of a cam and its follower.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CamQuantity {
    what: CamProperty,
    /// The follower; for ρ the cam.
    link: LinkId,
    /// The follower, for ρ.
    follower: Option<LinkId>,
    /// The point of a round end.
    end: Option<PointId>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum CamProperty {
    Lift,
    Swing,
    Stroke,
    Angle,
    Pressure,
    Rho,
    Turn(OfTurn),
}

/// Quantities of the whole turn of a cam, with any follower.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum OfTurn {
    Rise,
    Far,
    Back,
    Near,
    RhoMin,
    PressureStart,
    PressureOut,
    PressureBack,
    BaseMin,
    FaceHalf,
}

/// Rows of the table.
const ROWS: [CamProperty; 9] = [
    CamProperty::Lift,
    CamProperty::Swing,
    CamProperty::Stroke,
    CamProperty::Angle,
    CamProperty::Turn(OfTurn::Rise),
    CamProperty::Pressure,
    CamProperty::Rho,
    CamProperty::Turn(OfTurn::BaseMin),
    CamProperty::Turn(OfTurn::FaceHalf),
];

/// Quantities with a word after the symbol of another quantity: `Phi_far_3`.
const WORDS: [(CamProperty, &str, CamProperty); 9] = [
    (CamProperty::Rho, "min_", CamProperty::Turn(OfTurn::RhoMin)),
    (CamProperty::Turn(OfTurn::Rise), "far_", CamProperty::Turn(OfTurn::Far)),
    (CamProperty::Turn(OfTurn::Rise), "back_", CamProperty::Turn(OfTurn::Back)),
    (CamProperty::Turn(OfTurn::Rise), "near_", CamProperty::Turn(OfTurn::Near)),
    (CamProperty::Pressure, "start_", CamProperty::Turn(OfTurn::PressureStart)),
    (CamProperty::Pressure, "out_", CamProperty::Turn(OfTurn::PressureOut)),
    (CamProperty::Pressure, "back_", CamProperty::Turn(OfTurn::PressureBack)),
    (CamProperty::Turn(OfTurn::BaseMin), "min_", CamProperty::Turn(OfTurn::BaseMin)),
    (CamProperty::Turn(OfTurn::FaceHalf), "half_", CamProperty::Turn(OfTurn::FaceHalf)),
];

impl Quantity for CamQuantity {
    const WRITTEN: &'static [Entry] = &[
        Entry::new("s", "s_3", Kind::Length, ValueForm::Scalar, each!("lift of the follower")),
        Entry::new(
            "psi",
            "psi_3",
            Kind::Angle,
            ValueForm::Scalar,
            each!("lift of the swinging follower"),
        )
        .printed("\\psi", OverSign::Nothing),
        Entry::new("h", "h_3", Kind::Length, ValueForm::Scalar, each!("stroke of the follower")),
        Entry::new("Psi", "Psi_3", Kind::Angle, ValueForm::Scalar, each!("swing of the follower"))
            .printed("\\Psi", OverSign::Nothing),
        Entry::new("Phi", "Phi_3", Kind::Angle, ValueForm::Scalar, each!("angle of the rise"))
            .printed("\\Phi", OverSign::Nothing),
        Entry::new(
            "pressure",
            "pressure_3",
            Kind::Angle,
            ValueForm::Scalar,
            each!("pressure angle"),
        )
        .printed("\\alpha", OverSign::Sign("p")),
        Entry::new(
            "rho",
            "rho_2/3",
            Kind::Length,
            ValueForm::Scalar,
            each!("radius of curvature of the profile"),
        )
        .printed("\\rho", OverSign::Nothing),
        Entry::new(
            "rb",
            "rb_min_2",
            Kind::Length,
            ValueForm::Scalar,
            each!("least base radius without undercut"),
        )
        .printed("r", OverSign::Nothing),
        Entry::new(
            "face",
            "face_half_3",
            Kind::Length,
            ValueForm::Scalar,
            each!("half length of the face"),
        )
        .printed("l", OverSign::Nothing),
    ];

    fn read(question: &Question<'_>) -> Result<Option<CamQuantity>, Diagnostic> {
        let what = ROWS[question.row(Self::WRITTEN)];
        let names = question.names();
        // `h_65` is the arm of the force of link 6 on link 5.
        if question.symbol() == "h" && question.link(names).is_err() && question.two_links().is_ok()
        {
            return Ok(None);
        }
        let worded = WORDS.iter().find_map(|(of, word, what)| {
            Some((*what, names.strip_prefix(word)?))
                .filter(|_| *of == ROWS[question.row(Self::WRITTEN)])
        });
        if let Some((what, name)) = worded {
            return Ok(Some(CamQuantity {
                what,
                link: question.link(name.trim())?,
                follower: None,
                end: None,
            }));
        }
        if matches!(what, CamProperty::Turn(OfTurn::BaseMin | OfTurn::FaceHalf)) {
            let message = both!("`{}` is not a quantity that can be asked", question.text());
            let example = Self::WRITTEN[question.row(Self::WRITTEN)].example;
            return Err(question.fault(message).help(both!("write {example}")));
        }
        if what == CamProperty::Rho {
            let Some((cam, follower)) = names.split_once('/') else {
                let d = question
                    .fault(both!("`{}` does not say of which cam and follower", question.text()));
                return Err(d.help(both!("write rho_2/3: of cam 2 at follower 3; or rho_min_2")));
            };
            let (link, follower) = (question.link(cam.trim())?, question.link(follower.trim())?);
            return Ok(Some(CamQuantity { what, link, follower: Some(follower), end: None }));
        }
        let link = question.link(names)?;
        let end = (what == CamProperty::Pressure).then(|| question.end_of(link)).flatten();
        Ok(Some(CamQuantity { what, link, follower: None, end }))
    }

    fn entry(&self) -> &'static Entry {
        let what = WORDS.iter().find(|w| w.2 == self.what).map_or(self.what, |w| w.0);
        &Self::WRITTEN[ROWS.iter().position(|w| *w == what).unwrap_or(0)]
    }

    fn of(&self) -> Of {
        self.follower.map_or(Of::Link(self.link), |f| Of::Links(self.link, f))
    }

    fn meaning(&self, _scene: &Scene) -> Option<Meaning> {
        None
    }

    fn no_value(&self, scene: &Scene) -> Both {
        let link = scene.link_name(self.link);
        match self.what {
            CamProperty::Turn(OfTurn::RhoMin) => {
                both!("the profile of cam {link} is nowhere convex")
            }
            CamProperty::Rho => {
                both!("the profile of cam {link} is straight there, or touches nothing")
            }
            CamProperty::Turn(OfTurn::BaseMin) => {
                both!("no base circle of cam {link} avoids an undercut")
            }
            CamProperty::Turn(
                OfTurn::PressureStart | OfTurn::PressureOut | OfTurn::PressureBack,
            ) => {
                both!("follower {link} does not move so")
            }
            CamProperty::Lift
            | CamProperty::Swing
            | CamProperty::Stroke
            | CamProperty::Angle
            | CamProperty::Pressure
            | CamProperty::Turn(_) => {
                both!("the follower {link} touches nothing in this pose")
            }
        }
    }

    fn needs(&self) -> Vec<(Need, Level)> {
        // If the geometry of the cam does not give the value, the places of the contact do.
        self.end.map(|p| (Need::Point(p, None), Level::Position)).into_iter().collect()
    }

    fn fault(&self, scene: &Scene, find: &Find) -> Option<Diagnostic> {
        let Some((cam, t)) = self.cam(scene) else {
            if self.pair(scene).is_some_and(|c| self.of_the_pose(scene, c)) {
                return None;
            }
            let d = Diagnostic::error(
                "no-cam",
                both!(
                    "`{}` needs a cam that turns about a pin of the link in which its follower slides or turns",
                    find.text
                ),
            );
            let d = d.at(find.span);
            return Some(match self.pair(scene) {
                None => d,
                Some(pair) => {
                    let [cam, follower] = [pair.cam, pair.follower].map(|l| scene.link_name(l));
                    d.help(both!(
                        "no link carries both the pivot of cam `{cam}` and the guide or pivot of `{follower}`: list the pivot in \"links\" among the points of the ground, or of the link that carries the follower"
                    ))
                }
            });
        };
        let swings = matches!(t.disc.follower, Follower::Oscillating { .. });
        if let Some(needed) = self.lacking(t) {
            return Some(
                Diagnostic::error("find", both!("`{}` is of {}", find.text, needed)).at(find.span),
            );
        }
        let wrong = match self.what {
            CamProperty::Lift | CamProperty::Stroke => swings,
            CamProperty::Swing | CamProperty::Angle => !swings,
            CamProperty::Pressure | CamProperty::Rho | CamProperty::Turn(_) => false,
        };
        wrong.then(|| {
            let name = scene.link_name(cam.follower);
            let (kind, help) = if swings {
                (both!("swings"), both!("ask for psi_{name} and Psi_{name}"))
            } else {
                (both!("slides"), both!("ask for s_{name} and h_{name}"))
            };
            Diagnostic::error("cam-follower", both!("follower `{name}` {}", kind))
                .at(find.span)
                .help(help)
        })
    }

    fn infinite(&self, scene: &Scene) -> Option<Both> {
        let cam = self
            .pair(scene)
            .filter(|c| self.what == CamProperty::Rho && c.is_touched_straight())?;
        let name = scene.link_name(cam.cam);
        Some(both!("the profile of cam {name} is straight there"))
    }

    fn note(&self, scene: &Scene, find: &Find) -> Option<Diagnostic> {
        let (_, t) = self.cam(scene).filter(|_| self.what == CamProperty::Turn(OfTurn::RhoMin))?;
        let survey = t.survey.of(&t.disc);
        let undercut = survey.faults.iter().find_map(|f| match f {
            Fault::Undercut { phi, .. } => Some(*phi),
            Fault::RollerTooLarge { .. } | Fault::Pressure { .. } | Fault::NoContact { .. } => None,
        })?;
        let (cam, phi) =
            (scene.link_name(self.link), significant(in_turn(undercut).to_degrees(), 6));
        let message = both!(
            "the profile of cam `{cam}` is undercut: its radius of curvature changes sign, and is least at φ = {phi}°"
        );
        Some(Diagnostic::warning("undercut", message).at(find.span).help(both!(
            "take a larger base circle, a smaller roller, a longer angle or a gentler law; `hodograph cam` tells the least base circle"
        )))
    }

    fn value<N: Real, K: FormulaInputs<N>>(&self, known: &K) -> Option<AnswerValue<N>> {
        let scene = known.scene();
        let Some((_, t)) = self.cam(scene) else { return self.posed(known) };
        let value =
            if N::refines() { self.exactly(scene, t)? } else { N::from_f64(self.doubly(t)?) };
        value.is_decided().then_some(AnswerValue::Scalar(value))
    }
}

/// Returns the least radius of curvature of the profile.
fn least_radius(t: &TurningCam) -> Option<f64> {
    let (_, rho) = t.survey.of(&t.disc).least_rho?;
    let end = match t.disc.touch {
        FollowerTip::Point { radius } => radius,
        FollowerTip::Flat { .. } => 0.0,
    };
    Some(rho - end)
}

/// Returns the necessary half width of a flat face on both sides of its point: the greatest
/// distance of the contact over a turn, where s′ is greatest or least.
fn face_half(t: &TurningCam) -> Option<f64> {
    let reach = |phi: f64| {
        let sides = [PieceSide::Before, PieceSide::After]
            .map(|side| t.disc.station(phi, side).map(|s| (s.contact - s.pitch).norm()));
        sides.into_iter().flatten().reduce(f64::max)
    };
    t.survey.of(&t.disc).velocity.iter().filter_map(|(phi, _)| reach(*phi)).reduce(f64::max)
}

impl CamQuantity {
    /// Returns its value in double precision.
    fn doubly(&self, t: &TurningCam) -> Option<f64> {
        let survey = || t.survey.of(&t.disc);
        match self.what {
            CamProperty::Lift | CamProperty::Swing => match &t.disc.motion {
                CamMotion::Law { program, .. } => Some(program.lift(t.phi, t.side).value()),
                CamMotion::Profile(_) => {
                    Some(t.disc.coordinate(t.phi, t.side)?.value() - survey().rest)
                }
            },
            CamProperty::Stroke | CamProperty::Angle => Some(survey().stroke),
            CamProperty::Turn(OfTurn::Rise) => Some(survey().angle(1, false)),
            CamProperty::Pressure => Some(t.disc.station(t.phi, t.side)?.pressure),
            CamProperty::Rho => Some(t.disc.station(t.phi, t.side)?.rho),
            CamProperty::Turn(OfTurn::RhoMin) => least_radius(t),
            CamProperty::Turn(OfTurn::Far) => Some(survey().angle(0, true)),
            CamProperty::Turn(OfTurn::Back) => Some(survey().angle(-1, false)),
            CamProperty::Turn(OfTurn::Near) => Some(survey().angle(0, false)),
            CamProperty::Turn(OfTurn::PressureStart) => {
                let start = survey().phases.iter().find(|p| p.way == 1)?.from;
                Some(t.disc.station(start, PieceSide::After)?.pressure)
            }
            CamProperty::Turn(OfTurn::PressureOut) => Some(survey().pressure[0]?.1.abs()),
            CamProperty::Turn(OfTurn::PressureBack) => Some(survey().pressure[1]?.1.abs()),
            CamProperty::Turn(OfTurn::BaseMin) => least_base(&t.disc),
            CamProperty::Turn(OfTurn::FaceHalf) => face_half(t),
        }
    }

    /// Returns its value in a number type with error bounds or more digits.
    fn exactly<N: Real>(&self, scene: &Scene, t: &TurningCam) -> Option<N> {
        let (cam, phi) = t.exact::<N>(scene)?;
        let here = (t.phi, t.side);
        match self.what {
            CamProperty::Lift | CamProperty::Swing => cam.lift(here, phi),
            CamProperty::Stroke | CamProperty::Angle => cam.stroke(),
            CamProperty::Turn(OfTurn::Rise) => cam.angle(1, false),
            CamProperty::Pressure => Some(cam.station(here, phi)?.pressure),
            CamProperty::Rho => Some(cam.station(here, phi)?.rho),
            CamProperty::Turn(OfTurn::RhoMin) => cam.least_rho(),
            CamProperty::Turn(OfTurn::Far) => cam.angle(0, true),
            CamProperty::Turn(OfTurn::Back) => cam.angle(-1, false),
            CamProperty::Turn(OfTurn::Near) => cam.angle(0, false),
            CamProperty::Turn(OfTurn::PressureStart) => cam.pressure_at_start(),
            CamProperty::Turn(OfTurn::PressureOut) => {
                Some(cam.mark(CamExtreme::Pressure(0))?[1].magnitude())
            }
            CamProperty::Turn(OfTurn::PressureBack) => {
                Some(cam.mark(CamExtreme::Pressure(1))?[1].magnitude())
            }
            CamProperty::Turn(OfTurn::BaseMin) => cam.least_base(),
            CamProperty::Turn(OfTurn::FaceHalf) => cam.face_half(),
        }
    }

    /// Returns the kind of cam that the quantity needs, if this cam is of another kind.
    fn lacking(&self, t: &TurningCam) -> Option<Both> {
        let flat = matches!(
            (t.disc.touch, t.disc.follower),
            (FollowerTip::Flat { .. }, Follower::Translating { .. })
        );
        match self.what {
            CamProperty::Turn(OfTurn::FaceHalf) if !flat => {
                Some(both!("a sliding flat-faced follower"))
            }
            CamProperty::Turn(OfTurn::BaseMin)
                if !matches!(t.disc.motion, CamMotion::Law { .. }) =>
            {
                Some(both!("a cam by a law"))
            }
            CamProperty::Lift
            | CamProperty::Swing
            | CamProperty::Stroke
            | CamProperty::Angle
            | CamProperty::Pressure
            | CamProperty::Rho
            | CamProperty::Turn(_) => None,
        }
    }

    /// Returns the cam of the quantity.
    fn cam<'s>(&self, scene: &'s Scene) -> Option<(&'s Cam, &'s TurningCam)> {
        let cam = self.pair(scene)?;
        Some((cam, cam.disc.as_ref()?))
    }

    /// Returns true if the pose alone gives the quantity, for any carrier of the cam.
    fn of_the_pose(&self, scene: &Scene, cam: &Cam) -> bool {
        match self.what {
            CamProperty::Rho => cam.touched_radius().is_some() || cam.is_touched_straight(),
            CamProperty::Pressure => {
                cam.follows.radius().is_some()
                    && (cam.contact.is_some() || cam.is_on_course())
                    && way_of(scene, cam).is_some()
            }
            CamProperty::Lift
            | CamProperty::Swing
            | CamProperty::Stroke
            | CamProperty::Angle
            | CamProperty::Turn(_) => false,
        }
    }

    /// Returns its value in the pose.
    fn posed<N: Real, K: FormulaInputs<N>>(&self, known: &K) -> Option<AnswerValue<N>> {
        let scene = known.scene();
        let cam = self.pair(scene)?;
        if self.what == CamProperty::Rho {
            return cam.touched_radius_in(scene).map(AnswerValue::Scalar);
        }
        let end = known.point(cam.follows.point())?;
        let normal = match cam.contact.map(|g| &scene.guides[g.0]) {
            Some(guide) => match guide.path {
                GuidePath::Arc { centre, .. } => end - known.point(centre)?,
                GuidePath::Line { .. } => along(known, guide)?.perp(),
            },
            None => cam.touched_on_course(scene, &|p| known.point(p))?.1,
        };
        let way = match way_of(scene, cam)? {
            FollowerGuidance::Guide(g) => along(known, &scene.guides[g.0])?,
            FollowerGuidance::Pivot(p) => (end - known.point(p)?).perp(),
        };
        let (n, w) = (normal.unit()?, way.unit()?);
        Some(AnswerValue::Scalar(
            Vec2 { x: n.dot(w).magnitude(), y: n.cross(w).magnitude() }.angle(),
        ))
    }

    /// Returns the cam pair of the quantity, on any carrier.
    fn pair<'s>(&self, scene: &'s Scene) -> Option<&'s Cam> {
        let meant = |c: &&Cam| match (self.what, self.follower) {
            (CamProperty::Rho, follower) => c.cam == self.link && follower == Some(c.follower),
            (CamProperty::Turn(OfTurn::RhoMin | OfTurn::BaseMin), _) => c.cam == self.link,
            (
                CamProperty::Lift
                | CamProperty::Swing
                | CamProperty::Stroke
                | CamProperty::Angle
                | CamProperty::Pressure
                | CamProperty::Turn(_),
                _,
            ) => c.follower == self.link,
        };
        scene.cams.iter().find(meant)
    }
}

/// The path of a follower.
enum FollowerGuidance {
    Guide(GuideId),
    Pivot(PointId),
}

/// Returns the guide in which a follower slides, or the pivot about which it turns.
fn way_of(scene: &Scene, cam: &Cam) -> Option<FollowerGuidance> {
    let slides = scene
        .guides
        .iter()
        .position(|g| g.slider == Some(cam.follower))
        .map(|g| FollowerGuidance::Guide(GuideId(g)));
    let joint =
        |p: &PointId| *p != cam.follows.point() && scene.carriers(*p).any(|l| l != cam.follower);
    slides.or_else(|| {
        scene.links[cam.follower.0].points.iter().copied().find(joint).map(FollowerGuidance::Pivot)
    })
}
