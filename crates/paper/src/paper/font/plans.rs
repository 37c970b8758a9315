//! Cached shaping plans of a font, one per script: computing a plan takes ten times as long as
//! shaping a name with it.

use std::sync::{Arc, Mutex, PoisonError};

use harfrust::{ShapePlan, Shaper, UnicodeBuffer, script};

/// The plans of a font, one for each script and direction used; Unicode has about 170 scripts.
#[derive(Default)]
pub(super) struct Plans(Mutex<Vec<Arc<ShapePlan>>>);

impl Plans {
    /// Returns the plan for a text whose script and direction are set.
    pub fn of(&self, shaper: &Shaper, text: &UnicodeBuffer) -> Arc<ShapePlan> {
        // A thread that panics here leaves the list consistent.
        let mut plans = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let wanted = (text.direction(), text.script());
        if let Some(plan) =
            plans.iter().find(|p| (p.direction(), p.script().unwrap_or(script::UNKNOWN)) == wanted)
        {
            return Arc::clone(plan);
        }
        let script = Some(text.script()).filter(|s| *s != script::UNKNOWN);
        let plan = Arc::new(ShapePlan::new(shaper, text.direction(), script, None, &[]));
        plans.push(Arc::clone(&plan));
        plan
    }
}
