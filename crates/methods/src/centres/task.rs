//! Tasks that ask for centres, and answers by centres to questions.

use super::{Centres, centres};
use hodograph_mechanism::mechanism::Level;
use hodograph_scene::{Asked, Find, OnLink, Scene};

/// A task that asks for centres.
#[derive(Clone, Debug)]
pub struct CentreTask {
    /// All centres of the mechanism.
    pub found: Centres,
    /// True if the centres answer all questions of motion, so that no polygon is needed.
    pub alone: bool,
}

impl CentreTask {
    /// Returns the centres of a scene with a question for a centre; `None` if it has no such
    /// question.
    pub fn of(scene: &Scene) -> Option<CentreTask> {
        scene.find.iter().find(|f| matches!(f.what, Asked::InstantCentre(_)))?;
        let found = centres(scene).ok()?.value;
        let tells =
            |f: &Find| matches!(f.what, Asked::InstantCentre(_)) || found.value(scene, f).is_some();
        let alone = scene.find.iter().all(|f| f.what.level() == Level::Position || tells(f));
        Some(CentreTask { found, alone })
    }
}

impl Centres {
    /// Returns the answer by centres to a question of ω or v; for a vector, the magnitude.
    pub fn value(&self, scene: &Scene, find: &Find) -> Option<f64> {
        let meaning = find.what.meaning(scene).filter(|_| find.what.level() == Level::Velocity)?;
        if let Some(link) = meaning.turning_of() {
            return self.uses.links.iter().find(|t| t.link == link).map(|t| t.omega);
        }
        let OnLink { point, link: None } = meaning.vector_of()? else { return None };
        self.uses.points.iter().find(|s| s.point == point).map(|s| s.velocity.norm())
    }
}
