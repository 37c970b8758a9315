//! The point of contact of a cam and its follower as moving point.
//!
//! At the instant, a point of one body touches the contour of the other. v_r lies along the common
//! tangent. The path of the point is not the contour, but the normal part of a_r follows from the
//! velocities. Let Ω be the angular velocity of the point's body relative to the frame, v_s its
//! sliding along t (the outward normal of the frame's contour turned by −90°), and ρ₁, ρ₂ the radii
//! of the contours of frame and body. Then a_rⁿ = Ω²ρ₂ − (v_s − Ωρ₂)²/(ρ₁ + ρ₂) along the normal;
//! Ω²ρ₁ + 2Ωv_s for a flat body, Ω²ρ₂ for a flat frame. The point therefore serves with the cam as
//! frame, with the follower as frame, and with axes that translate with the centre of the cam's
//! circle, in which that circle is at rest.
//!
//! Another point is in contact at the next instant: the point is added to the scene in its pose
//! ([`hodograph_worked::worked::contact`]).

use super::equated::{equated, needs_second};
use super::{
    ChoicePlace, ChoiceSolution, ChoiceVerdict, FrameChoice, choices, judge, solved, usable,
};
use hodograph_base::diag::{Faults, Warned};
use hodograph_base::geom::Vec2;
use hodograph_mechanism::answer::MotionSource;
use hodograph_mechanism::mechanism::{Demand, Level, Mechanism};
use hodograph_mechanism::position::{self, Configuration};
use hodograph_scene::quantity::{Frame, RelativePath};
use hodograph_scene::{CompositePoint, Follows, LinkId, OnLink, PointId, Scene};
use hodograph_worked::worked::contact::{with_contact, work_at};
use hodograph_worked::worked::{Scope, Worked, work};

/// A point of contact of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CamContact {
    /// Index into the scene's cams.
    pub cam: usize,
    /// The links: the cam and its follower.
    pub links: [LinkId; 2],
    /// The point.
    pub point: PointId,
    /// The centre of the cam's circle.
    pub centre: PointId,
    /// Radii of curvature of cam and follower (m); `None` for a face.
    pub radii: [Option<f64>; 2],
    /// The unit normal, out of the cam.
    pub normal: Vec2,
}

/// The known properties of the relative motion at a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactSlip {
    /// Radii of curvature (m) of the contours of the frame and of the body; `None` for a face.
    pub radii: [Option<f64>; 2],
    /// The angular velocity of the point's body relative to the frame (rad/s).
    pub omega: f64,
    /// The sliding velocity along t (m/s).
    pub sliding: f64,
    /// The unit normal, out of the frame's contour.
    pub normal: Vec2,
}

impl ContactSlip {
    /// Returns a_rⁿ along the normal (m/s²), by the formula.
    pub fn acceleration(&self) -> f64 {
        let (omega, v) = (self.omega, self.sliding);
        match self.radii {
            [Some(r), None] => omega * omega * r + 2.0 * omega * v,
            [None, Some(r)] => omega * omega * r,
            [Some(p), Some(q)] => omega * omega * q - (v - omega * q) * (v - omega * q) / (p + q),
            // Two faces never touch at a point.
            [None, None] => 0.0,
        }
    }
}

/// A scene with the points of contact of its cams, and its pose.
#[derive(Clone, Debug)]
pub struct ContactScene {
    /// The scene with the points of contact among its points.
    pub scene: Scene,
    /// The points of contact.
    pub contacts: Vec<CamContact>,
    at: Option<Configuration>,
}

impl ContactScene {
    /// Places a scene in its pose; a scene that cannot be placed has no contacts.
    pub fn new(scene: &Scene) -> ContactScene {
        let bare = || ContactScene { scene: scene.clone(), contacts: Vec::new(), at: None };
        let offers = |c: &hodograph_scene::Cam| {
            matches!(c.follows, Follows::Face(_) | Follows::Arc(..)) && c.circle.is_some()
        };
        if !scene.cams.iter().any(offers) {
            return bare();
        }
        let placed = || {
            let mechanism = Mechanism::new(scene).ok()?.value;
            let demand = Demand::of(scene, &mechanism).with_all_positions();
            position::configure(scene, &mechanism, &demand).ok().map(|w| w.value)
        };
        let Some(mut at) = placed() else { return bare() };
        let (mut out, mut contacts) = (scene.clone(), Vec::new());
        for (index, cam) in scene.cams.iter().enumerate().filter(|(_, c)| offers(c)) {
            let Some((centre, radius)) = cam.circle else { continue };
            let Some(touched) = at.touch(scene, cam) else { continue };
            let Some((with, pose, point)) =
                with_contact(&out, &at, index, cam.follower, touched.at)
            else {
                continue;
            };
            (out, at) = (with, pose);
            let radii = [Some(radius), cam.follows.radius()];
            contacts.push(CamContact {
                cam: index,
                links: [cam.cam, cam.follower],
                point,
                centre,
                radii,
                normal: touched.normal,
            });
        }
        ContactScene { scene: out, contacts, at: Some(at) }
    }

    /// Returns all choices: those that the scene names, those at slides, pins and contacts of
    /// wheels, then those at the cams.
    pub fn choices(&self, scene: &Scene) -> Vec<FrameChoice> {
        let mut all: Vec<FrameChoice> = self.named(scene);
        let more =
            choices(scene).into_iter().chain(self.contacts.iter().flat_map(|c| self.at_contact(c)));
        for c in more {
            if !all.iter().any(|a| a.of == c.of && a.frame == c.frame) {
                all.push(c);
            }
        }
        all
    }

    /// Returns the choices to show: those that the scene names, otherwise the first `most` that
    /// serve.
    pub fn shown(&self, scene: &Scene, most: usize) -> Vec<FrameChoice> {
        let named: Vec<FrameChoice> = self.named(scene).into_iter().filter(usable).collect();
        if !named.is_empty() {
            return named;
        }
        self.choices(scene)
            .into_iter()
            .filter(|c| c.verdict == ChoiceVerdict::Serves)
            .take(most)
            .collect()
    }

    /// Returns the parts of the motion for these choices.
    ///
    /// # Errors
    /// The faults of the scene; at a dead centre there is no motion to resolve.
    pub fn solved(
        &self,
        choices: &[FrameChoice],
        level: Level,
    ) -> Result<Warned<(Worked, Vec<ChoiceSolution>)>, Faults> {
        solved(self, choices, level)
    }

    /// Returns the parts of the motion for these choices. A moving point whose motion only two frames
    /// determine has its second frame directly after the first, if a choice gives one.
    ///
    /// # Errors
    /// As [`ContactScene::solved`].
    pub fn solved_with_second(
        &self,
        scene: &Scene,
        choices: &[FrameChoice],
        level: Level,
    ) -> Result<Warned<(Worked, Vec<ChoiceSolution>)>, Faults> {
        let alone = self.solved(choices, level)?;
        let of_scene = self.choices(scene);
        let mut all: Vec<FrameChoice> = Vec::new();
        for s in &alone.value.1 {
            all.push(s.choice);
            let is_one = |c: &FrameChoice| {
                c.verdict == ChoiceVerdict::Serves
                    && c.of == s.choice.of
                    && c.frame != s.choice.frame
            };
            if needs_second(s) && !choices.iter().any(is_one) {
                all.extend(of_scene.iter().copied().find(is_one));
            }
        }
        if all.len() == alone.value.1.len() {
            return Ok(alone);
        }
        let both = self.solved(&all, level)?;
        let more = equated(&both.value.1).len() > equated(&alone.value.1).len();
        Ok(if more { both } else { alone })
    }

    /// Solves the scene with other questions.
    pub(super) fn work(&self, asking: &Scene) -> Result<Warned<Worked>, Faults> {
        let posed = self
            .at
            .clone()
            .filter(|_| !self.contacts.is_empty())
            .and_then(|at| work_at(asking, at));
        posed.map_or_else(
            || work(asking, Scope::Figure),
            |value| Ok(Warned { value, notes: Vec::new() }),
        )
    }

    fn named(&self, scene: &Scene) -> Vec<FrameChoice> {
        let one = |s: &hodograph_scene::ObservedPoint| match s.of {
            CompositePoint::Point(of) => Some(judge(&self.scene, of, s.frame, ChoicePlace::Named)),
            CompositePoint::Contact { cam, on } => {
                let contact = self.contacts.iter().find(|c| c.cam == cam)?;
                Some(self.choice(contact, on, s.frame, ChoicePlace::Named))
            }
        };
        scene.composite.iter().filter_map(one).collect()
    }

    /// Returns the choices at a contact: the point of each body relative to the other body, and the
    /// follower's point relative to axes that translate with the centre.
    fn at_contact(&self, c: &CamContact) -> Vec<FrameChoice> {
        let [cam, follower] = c.links;
        let centre = Frame::Point(OnLink { point: c.centre, link: None });
        let place = ChoicePlace::Cam(c.cam);
        let all = [(follower, Frame::Link(cam)), (cam, Frame::Link(follower)), (follower, centre)];
        let moves = |(on, frame): &(LinkId, Frame)| {
            *on != self.scene.ground && !frame.is_fixed(&self.scene)
        };
        all.into_iter().filter(moves).map(|(on, frame)| self.choice(c, on, frame, place)).collect()
    }

    fn choice(&self, c: &CamContact, on: LinkId, frame: Frame, place: ChoicePlace) -> FrameChoice {
        let of = OnLink { point: c.point, link: (on != c.links[1]).then_some(on) };
        let other = if on == c.links[0] { c.links[1] } else { c.links[0] };
        let serves = match frame {
            Frame::Link(l) => l == other,
            Frame::Point(p) => p.point == c.centre && on == c.links[1],
        };
        let path = RelativePath::Unknown;
        if serves && !frame.is_fixed(&self.scene) {
            return FrameChoice { of, frame, place, verdict: ChoiceVerdict::Serves, path };
        }
        let judged = judge(&self.scene, of, frame, place);
        // The verdict that the pairs give for permanent points does not hold for this point.
        let verdict = if judged.verdict == ChoiceVerdict::Serves {
            ChoiceVerdict::PointChanges
        } else {
            judged.verdict
        };
        FrameChoice { verdict, path, ..judged }
    }

    /// Returns the sliding at the contact of a choice; `None` if its moving point is not a point of
    /// contact.
    pub fn slip(
        &self,
        choice: &FrameChoice,
        worked: &Worked,
        relative: Vec2,
    ) -> Option<ContactSlip> {
        let c = self
            .contacts
            .iter()
            .find(|c| c.point == choice.of.point && choice.verdict == ChoiceVerdict::Serves)?;
        let [cam, follower] = c.links;
        let on_cam = choice.of.link == Some(cam);
        let rate = |l: LinkId| {
            if l == self.scene.ground {
                0.0
            } else {
                worked.solution.turning(Level::Velocity, l).unwrap_or(0.0)
            }
        };
        let own = rate(if on_cam { cam } else { follower });
        let carried = match choice.frame {
            Frame::Link(l) => rate(l),
            Frame::Point(_) => 0.0,
        };
        let (normal, radii) =
            if on_cam { (-c.normal, [c.radii[1], c.radii[0]]) } else { (c.normal, c.radii) };
        Some(ContactSlip {
            radii,
            omega: own - carried,
            sliding: relative.dot(-normal.perp()),
            normal,
        })
    }
}
