//! Followers of cams with a motion law: their motion is differentiated from the law, not taken from
//! the arc that replaces the profile in the drawing.

use super::relation::{EquationPair, EquationRow};
use super::rows::UnknownLayout;
use hodograph_base::cam::CamMotion;
use hodograph_mechanism::mechanism::Runner;
use hodograph_mechanism::position::Configuration;
use hodograph_scene::{Cam, GuideId, Scene, TurningCam};

/// Returns the cam with its law for a guide that represents the contact of a cam with a law.
fn law_of(scene: &Scene, g: GuideId) -> Option<(&Cam, &TurningCam)> {
    let cam = scene.cams.iter().find(|c| c.contact == Some(g))?;
    let turning = cam.disc.as_ref()?;
    matches!(turning.disc.motion, CamMotion::Law { .. }).then_some((cam, turning))
}

/// True if a guide represents the contact of a cam with a law.
pub(super) fn is_of_law(scene: &Scene, g: GuideId) -> bool {
    law_of(scene, g).is_some()
}

impl UnknownLayout {
    /// Adds the rows of all followers of cams with a law.
    pub(super) fn by_laws(&self, scene: &Scene, at: &Configuration, rows: &mut Vec<EquationRow>) {
        for g in (0..scene.guides.len()).map(GuideId) {
            rows.extend(law_of(scene, g).and_then(|(cam, turning)| {
                self.by_law(scene, at, (cam, turning), EquationPair::Guide(g))
            }));
        }
    }

    /// Returns the third time derivative that a law prescribes for its follower, s⃛ = s‴φ̇³ +
    /// 3s″φ̇φ̈ in the units of its row; 0 for other pairs.
    pub(super) fn third_by_law(&self, scene: &Scene, of: EquationPair) -> f64 {
        let EquationPair::Guide(g) = of else { return 0.0 };
        let Some((cam, t)) = law_of(scene, g) else { return 0.0 };
        let Some([_, _, second, third]) = t.disc.coordinate(t.phi, t.side).map(|q| q.0) else {
            return 0.0;
        };
        let [rate, acceleration] = t.rates(scene);
        let slides = scene.guides.iter().any(|g| g.slider == Some(cam.follower) && g.on == t.frame);
        let unit = if slides { self.scale } else { 1.0 };
        t.outward * (third * rate * rate * rate + 3.0 * second * rate * acceleration) * unit
    }

    /// Returns the row of the motion that a law prescribes for its follower: along its guide ṡ =
    /// s′φ̇, s̈ = s″φ̇² + s′φ̈, and correspondingly for its angle.
    fn by_law(
        &self,
        scene: &Scene,
        at: &Configuration,
        (cam, t): (&Cam, &TurningCam),
        of: EquationPair,
    ) -> Option<EquationRow> {
        let [_, first, second, _] = t.disc.coordinate(t.phi, t.side)?.0;
        let [rate, acceleration] = t.rates(scene);
        let drive =
            [first * rate, second * rate * rate + first * acceleration].map(|x| t.outward * x);
        let Some(guide) =
            scene.guides.iter().position(|g| g.slider == Some(cam.follower) && g.on == t.frame)
        else {
            return self.lock(scene, cam.follower, t.frame, drive, of);
        };
        let runner = Runner::Pin(scene.guides[guide].pin?);
        self.along_path(
            scene,
            at,
            (runner, GuideId(guide), t.frame),
            drive.map(|x| x * self.scale),
            of,
        )
    }
}
