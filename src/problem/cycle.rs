//! The motion cycle of a scene: working strokes, returns and dwells of its outputs.

use super::range::{RangeFault, WrongValue, driver_of};
use super::whole_motion;
use crate::diag::Warned;
use crate::figure::cycle::{CycleForm, figure};
use crate::mechanism::Mechanism;
use crate::paper::item::Figure;
use crate::paper::style::Style;
use crate::report::cycle::MotionCycle;
use crate::scene::{Lang, Scene};
use crate::sweep::extreme;

/// A scene with its motion cycle.
#[derive(Clone, Debug)]
pub struct CycledScene {
    /// The scene, over its whole motion.
    pub scene: Scene,
    /// The number of the driver that moves.
    pub driver: usize,
    /// The phases of the outputs.
    pub cycle: MotionCycle,
}

impl CycledScene {
    /// Returns the cycle of a scene, whose rates may be missing, over the motion of a driver (see
    /// [`driver_of`]): of all outputs, or of those named in `find`.
    ///
    /// # Errors
    /// A driver or output that the scene does not have; those of the limits of the motion.
    pub fn of(
        scene: Scene,
        over: Option<&str>,
        find: &[&str],
    ) -> Result<Warned<CycledScene>, RangeFault> {
        let Warned { value: scene, notes } = whole_motion(scene);
        let driver = driver_of(&scene, over)?;
        let mechanism = Mechanism::new(&scene).map_err(RangeFault::Scene)?.value;
        let limits = extreme::limits(&scene, &mechanism, driver).map_err(RangeFault::Scene)?;
        let mut cycle = MotionCycle::of(&scene, driver, &limits);
        if !find.is_empty() {
            cycle.choose(find).map_err(|d| WrongValue::new("find", &find.join(","), d))?;
        }
        Ok(Warned { value: CycledScene { scene, driver, cycle }, notes })
    }

    /// Returns the phases as a table.
    pub fn text(&self, lang: Lang) -> String {
        self.cycle.text(&self.scene, lang)
    }

    /// Draws the cycle.
    pub fn figure(&self, form: CycleForm, style: &Style, lang: Lang) -> Figure {
        figure(&self.scene, self.driver, &self.cycle, form, style, lang)
    }
}
