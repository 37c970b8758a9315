//! A pose at a junction of two pieces of a cam's profile, with cam and follower moving with
//! different links.
//!
//! There is one velocity there and two accelerations, because the curvature jumps. The velocities
//! decide which of the two pieces is in contact from the instant on: the contact moves round the
//! cam in the sense of v_r, on a flat face in the sense of its angular velocity relative to the
//! cam. The scene is therefore solved on the piece with which it was read, and transferred to the
//! other if that one follows. If one link carries both, the scene decides when it is read.

use hodograph_analytic::{self as analytic, Solution};
use hodograph_base::diag::{Both, Diagnostic, Faults, Severity, Warned, both};
use hodograph_base::digits::significant;
use hodograph_mechanism::answer::{AnswerValue, MotionSource};
use hodograph_mechanism::mechanism::{Demand, Level, Mechanism};
use hodograph_mechanism::position::{self, Configuration, pieces};
use hodograph_scene::{Cam, Find, Kind, Pieces, Scene};

/// The distance from an end of its piece (rad, or a part of a line) within which a contact is on
/// the junction: the accuracy of nine digits of a pose.
const ON_THE_JOINT: f64 = 1e-9;

/// The relative difference up to which accelerations are equal.
const ONE: f64 = 1e-9;

/// A scene in motion at its instant.
struct InstantMotion {
    at: Configuration,
    solution: Solution,
}

impl InstantMotion {
    fn of(scene: &Scene) -> Option<InstantMotion> {
        let m = Mechanism::new(scene).ok()?.value;
        let demand = Demand {
            groups: vec![Some(Level::Acceleration); m.groups.len()],
            level: Level::Acceleration,
            needs: Vec::new(),
        };
        let at = position::configure(scene, &m, &demand).ok()?.value;
        let solution = analytic::solve(scene, &m, &at, &demand).ok()?;
        Some(InstantMotion { at, solution })
    }

    /// The piece next to the one in contact, if the two meet in the pose, and `true` if the contact
    /// goes on to it.
    fn joint(&self, scene: &Scene, cam: &Cam, pieces: &Pieces) -> Option<(usize, bool)> {
        let meeting = pieces::meeting(cam, pieces, &self.at)?;
        let (piece, count) = (&pieces.segments[pieces.touched], pieces.segments.len());
        let [before, after] = meeting.beyond(piece).map(|beyond| beyond.abs() <= ON_THE_JOINT);
        let beside = match (before, after) {
            (_, true) => (pieces.touched + 1) % count,
            (true, false) => (pieces.touched + count - 1) % count,
            (false, false) => return None,
        };
        let of = |link| self.solution.vector(Level::Velocity, cam.follows.point(), Some(link));
        let turning = |link| {
            if link == scene.ground {
                Some(0.0)
            } else {
                self.solution.turning(Level::Velocity, link)
            }
        };
        let along = if cam.follows.radius().is_some() {
            of(cam.follower)? - of(cam.cam)?
        } else {
            Default::default()
        };
        let onward = meeting.onward(piece, along, turning(cam.follower)? - turning(cam.cam)?);
        Some((beside, if after { onward > 0.0 } else { onward < 0.0 }))
    }
}

/// Returns the scene as it goes on from its instant: at a junction of two pieces of a cam's profile
/// it touches the piece that follows, and a note gives both accelerations. Everywhere else it
/// returns the scene itself.
pub fn instant(scene: Scene) -> Warned<Scene> {
    match at_joint(&scene) {
        Some(ProfileJunction { next: Some(next), note }) => {
            Warned { value: next, notes: vec![note] }
        }
        Some(ProfileJunction { next: None, note }) => Warned { value: scene, notes: vec![note] },
        None => Warned { value: scene, notes: Vec::new() },
    }
}

/// Refuses a scene whose follower leaves the piece in contact at this very instant.
///
/// # Errors
/// `joint`: the scene must pass [`instant`] first.
pub(super) fn goes_on(scene: &Scene) -> Result<(), Faults> {
    let Some(ProfileJunction { next: Some(_), note }) = at_joint(scene) else { return Ok(()) };
    let d = Diagnostic { severity: Severity::Error, ..note };
    Err(d.help(both!("take the scene by `worked::instant`, which chooses the piece")).into())
}

/// A pose in which two pieces of a profile meet.
struct ProfileJunction {
    /// The scene on the other piece, if that is the one that follows.
    next: Option<Scene>,
    /// The note on both accelerations.
    note: Diagnostic,
}

/// The junction in contact in the pose, if there is one and the accelerations jump there.
fn at_joint(scene: &Scene) -> Option<ProfileJunction> {
    let told = |c: &Cam| c.posed.as_ref().is_some_and(|p| !p.others.is_empty());
    let (index, cam) = scene.cams.iter().enumerate().find(|(_, c)| told(c))?;
    let pieces = cam.posed.as_ref()?;
    let here = InstantMotion::of(scene)?;
    let (beside, onward) = here.joint(scene, cam, pieces)?;
    let other = pieces.on(beside)?;
    let there = InstantMotion::of(other)?;
    let jumps = match onward {
        true => jumps(&[(scene, &here), (other, &there)]),
        false => jumps(&[(other, &there), (scene, &here)]),
    };
    if jumps.is_empty() {
        return None;
    }
    let message = both!(
        "two pieces of the profile of cam `{}` meet here: {}; drawn is what follows",
        scene.link_name(cam.cam),
        Both::join(&jumps, [", ", "、"])
    );
    let note = Diagnostic::note("joint", message).at(cam.span);
    Some(ProfileJunction {
        next: if onward { Some(taken_over(scene, index, beside)?) } else { None },
        note,
    })
}

/// The scene on another piece of a cam, with the rest of the pieces.
fn taken_over(scene: &Scene, cam: usize, piece: usize) -> Option<Scene> {
    let pieces = scene.cams[cam].posed.as_ref()?;
    let mut own = scene.clone();
    own.cams[cam].posed.as_mut()?.others.clear();
    let mut next = pieces.on(piece)?.clone();
    let rest = pieces.others.iter().filter(|(k, _)| *k != piece).cloned();
    next.cams[cam].posed.as_mut()?.others = rest.chain([(pieces.touched, own)]).collect();
    Some(next)
}

/// The requested accelerations that differ before and after the instant.
fn jumps([before, after]: &[(&Scene, &InstantMotion); 2]) -> Vec<Both> {
    let value = |(scene, moving): &(&Scene, &InstantMotion), text: &str| {
        let find = scene.find.iter().find(|f| f.text == text)?;
        moving.solution.answer(scene, &moving.at, &find.what)
    };
    let accelerates = |f: &&Find| matches!(f.what.kind(), Kind::Acceleration | Kind::Alpha);
    let jump = |f: &Find| {
        let (was, is) = (value(before, &f.text)?, value(after, &f.text)?);
        let (off, size) = match (was, is) {
            (AnswerValue::Scalar(a), AnswerValue::Scalar(b)) => {
                ((a - b).abs(), a.abs().max(b.abs()))
            }
            (AnswerValue::Vector(a), AnswerValue::Vector(b)) => {
                ((a - b).norm(), a.norm().max(b.norm()))
            }
            (AnswerValue::Scalar(_) | AnswerValue::Vector(_) | AnswerValue::Point(_), _) => {
                return None;
            }
        };
        let [was, is] = [was, is].map(|v| words(after.0, f.what.kind(), v));
        (off > ONE * size).then(|| both!("{} jumps from {} to {}", f.text, was, is))
    };
    after.0.find.iter().filter(accelerates).filter_map(jump).collect()
}

/// A value in the units of the scene; a vector by its magnitude and direction.
fn words(scene: &Scene, kind: Kind, value: AnswerValue) -> String {
    let text = |x: f64| scene.book.text(kind, &significant(scene.book.value(kind, x), 4));
    match value {
        AnswerValue::Scalar(x) => text(x),
        AnswerValue::Vector(v) => {
            format!("{} ({}°)", text(v.norm()), significant(v.angle().to_degrees(), 4))
        }
        AnswerValue::Point(p) => format!("({}, {})", text(p.x), text(p.y)),
    }
}
