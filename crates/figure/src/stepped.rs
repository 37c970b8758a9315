//! The methods of kinematics as drawings with steps, for lessons. The drawings are those of the
//! figures; the class of each item that a step adds has the step's number (`step-2`).

use hodograph_base::diag::{Both, Faults};
use hodograph_base::lang::each;

use super::list::FigureInput;
use super::particle::ParticleView;
use hodograph_report::loops::DisplayedFormula;
use std::collections::BTreeMap;

/// A method whose construction is shown step by step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConstructionMethod {
    /// Instantaneous centres with the circle diagram.
    Centres,
    /// Composite motion of a point.
    Composite,
    /// Pole, inflection circle and centres of curvature.
    Curvature,
    /// Law of motion, inversion, pressure angle and curvature of disc cams.
    Cam,
    /// Willis' table and Kutzbach's plan of a gear train.
    Trains,
    /// Vector loops of the analytic method.
    Loops,
}

/// The construction of a method in one pose.
#[derive(Default)]
pub struct SteppedMethod {
    /// The drawings.
    pub views: Vec<ParticleView>,
    /// The sentence of each step, with formulas between dollar signs.
    pub steps: Vec<Both>,
    /// The formulas below the sentences of some steps.
    pub formulas: BTreeMap<usize, Vec<DisplayedFormula>>,
    /// Number of places that do not exist in this pose.
    pub missing: usize,
}

/// A method with its name and a line on its construction, English and Chinese.
pub struct MethodEntry {
    /// The method.
    pub method: ConstructionMethod,
    /// The name in commands.
    pub name: &'static str,
    /// The line.
    pub about: [&'static str; 2],
}

const fn entry(
    method: ConstructionMethod,
    name: &'static str,
    about: [&'static str; 2],
) -> MethodEntry {
    MethodEntry { method, name, about }
}

/// The methods in the order of a list.
pub const METHODS: [MethodEntry; 6] = [
    entry(
        ConstructionMethod::Centres,
        "centres",
        each!("Centres of velocity one by one, with the circle diagram"),
    ),
    entry(
        ConstructionMethod::Composite,
        "composite",
        each!("Composite motion: moving point, frame, parallelogram, polygon"),
    ),
    entry(
        ConstructionMethod::Curvature,
        "curvature",
        each!("Curvature of paths by Bobillier and Euler-Savary"),
    ),
    entry(
        ConstructionMethod::Cam,
        "cam",
        each!("A cam: law, inversion, pressure angle, curvature radius"),
    ),
    entry(
        ConstructionMethod::Trains,
        "trains",
        each!("A gear train: Kutzbach's plan ray by ray, Willis' table"),
    ),
    entry(
        ConstructionMethod::Loops,
        "loops",
        each!("The analytic method: vector loops, equations of motion"),
    ),
];

impl ConstructionMethod {
    /// Returns the method of a name.
    pub fn named(name: &str) -> Option<ConstructionMethod> {
        METHODS.iter().find(|e| e.name == name).map(|e| e.method)
    }

    /// Returns the construction of a scene; `None` where the scene has nothing to construct by this
    /// method.
    ///
    /// # Errors
    /// The faults of the method.
    pub fn stepped(self, w: &FigureInput) -> Result<Option<SteppedMethod>, Faults> {
        match self {
            ConstructionMethod::Centres => super::centres::stepped(w).map(Some),
            ConstructionMethod::Composite => super::composite::stepped(w),
            ConstructionMethod::Curvature => super::curvature::stepped(w),
            ConstructionMethod::Cam => Ok(super::cam::stepped(w)),
            ConstructionMethod::Trains => Ok(super::kutzbach::stepped(w)),
            ConstructionMethod::Loops => super::loops::stepped(w),
        }
    }

    /// True if the drawings are the same in all poses.
    pub fn is_still(self) -> bool {
        matches!(self, ConstructionMethod::Cam | ConstructionMethod::Trains)
    }
}
