//! A profile by a law: reads the stages and writes the pair or driver that replaces the contact.

use super::super::model::*;
use super::super::raw::{RawQuantity, RawScene};
use super::super::units::RequiredQuantity;
use super::TurningCam;
use super::carrier::Lacking;
use super::expand::{CamReplacement, Pending};
use super::law::{self, LawReplacement, LawText, StageText};
use super::pairs::CamPair;
use super::place::{self, CarriedFollower, NumberText, OnPivot};
use super::raw::*;
use super::texts::MotionTexts;
use hodograph_base::cam::{
    CamMotion, Disc, FollowerTip, MotionLaw, PieceSide, Stage, StageMotion, StageProgram, Surveyed,
};
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::digits::significant;
use hodograph_base::json::Word;

impl CamReplacement<'_> {
    /// Returns the law as numbers and texts.
    pub(super) fn law(
        &self,
        base: &RawQuantity,
        start: &Option<RawQuantity>,
        clockwise: bool,
        stages: &[RawStage],
        turning: bool,
        faults: &mut Faults,
    ) -> Option<(f64, f64, LawText, StageProgram)> {
        let before = faults.list.len();
        let base = self.positive(base, faults);
        let start = match start {
            Some(q) => self.number_text(q, RequiredQuantity::Angle, faults),
            None => Some(NumberText { value: 0.0, text: "0 deg".into() }),
        };
        let (mut texts, mut read) = (Vec::new(), Vec::new());
        for stage in stages {
            let over = self.number_text(&stage.over, RequiredQuantity::Angle, faults);
            if let Some(over) = over.as_ref().filter(|o| o.value.is_nan() || o.value <= 0.0) {
                let message =
                    both!("a stage goes over {}; it must be greater than zero", over.text);
                faults.push(Diagnostic::error("not-positive", message).at(stage.over.span));
            }
            let mut gain = |q: &RawQuantity| {
                if turning {
                    let g = self.values.angle(q, faults)?;
                    Some(GivenQuantity {
                        value: g.value.radians(),
                        radius: g.radius,
                        text: g.text,
                        span: g.span,
                    })
                } else {
                    self.values.si(q, RequiredQuantity::Length, faults)
                }
            };
            let kind = |w: &Word| MotionLaw::named(&w.text);
            let (way, text) = match &stage.way {
                RawWay::Dwell => (Some(StageMotion::Dwell), None),
                RawWay::Rise(q, law) => {
                    let g = gain(q);
                    (g.as_ref().zip(kind(law)).map(|(g, law)| StageMotion::Rise(g.value, law)), g)
                }
                RawWay::Return(q, law) => {
                    let g = gain(q);
                    (g.as_ref().zip(kind(law)).map(|(g, law)| StageMotion::Return(g.value, law)), g)
                }
            };
            let (Some(way), Some(over)) = (way, over) else { continue };
            read.push(Stage { way, over: over.value });
            texts.push(StageText { gain: text, over: over.text });
        }
        if faults.list.len() > before {
            return None;
        }
        let program = StageProgram::new(read);
        let sum: f64 = program.stages().iter().map(|s| s.over).sum();
        let lift: f64 = program.stages().iter().map(Stage::gain).sum();
        let open = |message: Both, help: Both, faults: &mut Faults| {
            faults.push(Diagnostic::error("law-open", message).at(self.raw.span).help(help));
        };
        // A law is written in degrees; nine digits separate typing errors from rounding.
        if (sum - std::f64::consts::TAU).abs() > 1e-9 {
            let degrees = significant(sum.to_degrees(), 6);
            open(
                both!("the stages of the law go over {degrees}°, not 360°"),
                both!("make up the rest with {{\"dwell\": ...}}"),
                faults,
            );
        }
        if lift.abs() > 1e-9 * program.stroke().abs() {
            open(
                both!(
                    "what the law rises it does not return: the follower ends elsewhere than it began"
                ),
                both!("make the returns as large as the rises"),
                faults,
            );
        }
        let (base, start) = (base?, start?);
        let text = LawText { base: base.text, start: start.text, clockwise, stages: texts };
        (faults.list.len() == before).then_some((base.value, start.value, text, program))
    }

    pub(super) fn by_law(
        &self,
        raw: &mut RawScene,
        (base, start, text, program): (f64, f64, LawText, StageProgram),
        point: PointId,
        (end, placed): (Option<NumberText>, Result<(OnPivot, CarriedFollower), Lacking>),
        pending: &mut Pending,
        faults: &mut Faults,
    ) -> Option<()> {
        let (face, offset, sense) = match &self.raw.follows {
            RawFollows::Face(face) => {
                let (face, offset, sense) =
                    self.face(placed.as_ref().ok().map(|p| &p.1), face, faults)?;
                pending.left = face.left.unwrap_or(true);
                (Some(face), offset, sense)
            }
            RawFollows::Edge(_) | RawFollows::Roller { .. } | RawFollows::Arc { .. } => {
                (None, None, 1.0)
            }
        };
        let placed = placed.map_err(|lacking| self.no_law(lacking, faults)).ok()?;
        let Some((follower, touch, arm)) = self.follower(&placed, point, offset.as_ref(), sense)
        else {
            self.no_law(self.not_through(), faults);
            return None;
        };
        let (on, carried) = placed;
        let touch = match touch {
            FollowerTip::Point { .. } => {
                FollowerTip::Point { radius: end.as_ref().map_or(0.0, |r| r.value) }
            }
            FollowerTip::Flat { lever } => FollowerTip::Flat { lever },
        };
        let turn = if text.clockwise { -1.0 } else { 1.0 };
        let disc = Disc {
            follower,
            touch,
            motion: CamMotion::Law { base, program: program.clone() },
            sense: turn,
        };
        if !disc.rest(base).is_finite() {
            return self.no_contact(faults);
        }
        let phi = turn * (on.angle.value - start);
        let disc =
            self.on_its_side(disc, phi, (on.frame, on.spot.at()), point, &|q| self.spot_on(&on, q));
        let along = if on.rate * turn < 0.0 { PieceSide::Before } else { PieceSide::After };
        let end_point = point;
        // The mark that gives the direction of a lever with a face is the last point of its link.
        let point = match (&carried, &face) {
            (CarriedFollower::Pivot { .. }, Some(_)) => {
                let id = self.names.link(&self.raw.follower).ok()?;
                *self.bare.links[id.0].points.iter().find(|p| **p != point)?
            }
            _ => point,
        };
        let radius = match touch {
            FollowerTip::Point { .. } => Some(end.map_or_else(|| "0 mm".to_owned(), |r| r.text)),
            FollowerTip::Flat { .. } => None,
        };
        let far_out = offset.clone();
        let lever = offset.map(|o| if sense < 0.0 { format!("-({})", o.text) } else { o.text });
        let touching = lever.clone().or_else(|| radius.clone());
        let texts = self.texts(
            (&on, &carried),
            (end_point, touching),
            (phi, &text.start),
            Some(MotionTexts::of_law(&text)),
        );
        let at = law::At {
            scene: self.bare,
            of: self.names.link(&self.raw.cam).ok()?,
            cam: &on,
            carried: &carried,
            point,
            radius,
            arm: arm.map(|a| a.text),
            lever,
            follower: &self.raw.follower.text,
            span: self.raw.span,
        };
        let written = law::written(&at, &disc, &program, &text, (phi, along), &self.name)?;
        self.joint(&disc, phi, &on, faults);
        let quantity = |text: String| RawQuantity { text, span: self.raw.span, bare: false };
        for (name, text) in written.parameters {
            raw.parameters.push((Word { text: name, span: self.raw.span }, quantity(text)));
        }
        let by_law = match written.stands {
            LawReplacement::Driver(driver) => {
                raw.drivers.push(driver);
                Some(raw.drivers.len() - 1)
            }
            LawReplacement::Arc { place, radius } => {
                let station = disc.station(phi, along)?;
                let (follows, value) = match &face {
                    Some(face) => (RawFollows::Face(face.clone()), station.rho),
                    None => (self.raw.follows.clone(), station.rho_pitch.abs()),
                };
                pending.rough = self.sketch(raw, &disc, phi, (&on, &follows));
                let contact = CamPair {
                    cam: &self.raw.cam.text,
                    follower: &self.raw.follower.text,
                    follows: &follows,
                    end: None,
                    offset: far_out,
                    span: self.raw.span,
                };
                pending.contact = Some(raw.guides.len());
                contact.about(
                    raw,
                    place,
                    self.bare.point_name(on.pivot),
                    &NumberText { value, text: radius },
                )?;
                None
            }
        };
        let (origin, outward) = place::origin(&carried, on.spot.at(), &disc.follower);
        let turning = TurningCam {
            frame: on.frame,
            pivot: PointId(0),
            disc,
            survey: Surveyed::default(),
            phi,
            driver: on.driver,
            way: on.way,
            from: on.from,
            by_law,
            start,
            origin,
            outward,
            touched: None,
            rough: None,
            side: along,
            texts,
        };
        pending.disc = Some((self.bare.point_name(on.pivot).to_owned(), turning));
        Some(())
    }

    /// Reports why a law is not possible here, or what data it lacks.
    fn no_law(&self, lacking: Lacking, faults: &mut Faults) {
        let (cam, follower) = (&self.raw.cam.text, &self.raw.follower.text);
        let message = both!("the law of cam `{cam}` cannot move `{follower}`: {}", lacking.what);
        faults.push(Diagnostic::error("cam-pose", message).at(self.raw.span).help(lacking.help));
    }

    /// The fault of a follower whose guide does not pass through the point (or the face) of
    /// contact.
    fn not_through(&self) -> Lacking {
        Lacking {
            what: both!("the end that touches has no fixed place in its guide or on its arm"),
            help: both!(
                "let the guide pass through the point that touches, or give its distance from the pivot; a face stands square to its guide, or passes through its pivot or lies at an `offset` from it"
            ),
        }
    }
}
