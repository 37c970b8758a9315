//! How texts of a script are shaped by a font, found once for each script: to plan it takes ten times as long as to shape a name by it.

use std::sync::{Arc, Mutex, PoisonError};

use harfrust::{ShapePlan, Shaper, UnicodeBuffer, script};

/// The plans of a font, one for each script and direction met; Unicode has some hundred and seventy scripts.
#[derive(Default)]
pub(super) struct Plans(Mutex<Vec<Arc<ShapePlan>>>);

impl Plans {
    /// The plan for a text whose script and direction are set.
    pub fn of(&self, shaper: &Shaper, text: &UnicodeBuffer) -> Arc<ShapePlan> {
        // A thread that ends in here leaves nothing half done.
        let mut plans = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let wanted = (text.direction(), text.script());
        if let Some(plan) = plans.iter().find(|p| (p.direction(), p.script().unwrap_or(script::UNKNOWN)) == wanted) {
            return Arc::clone(plan);
        }
        let script = Some(text.script()).filter(|s| *s != script::UNKNOWN);
        let plan = Arc::new(ShapePlan::new(shaper, text.direction(), script, None, &[]));
        plans.push(Arc::clone(&plan));
        plan
    }
}
