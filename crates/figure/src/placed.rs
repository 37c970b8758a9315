//! A mechanism in several positions of its driver on one paper: the scale that fits all of them,
//! and the positions themselves.

use hodograph_base::diag::Faults;
use hodograph_base::geom::Point;
use hodograph_board::construct::scale::{self, Boxes};
use hodograph_mechanism::position::Configuration;
use hodograph_scene::{Kind, Scene};
use hodograph_sweep::follow::PoseFollower;
use hodograph_sweep::points::pose_at;
use hodograph_worked::worked::{Worked, work_placed};

use super::course::courses;
use super::list::FigureInput;
use super::mechanism::{OtherPosition, SeriesFeatures};

/// Poses of a motion that are followed to find one of them.
const STEPS: usize = 72;

/// Returns the scene and its solution at the scale μ_l at which the mechanism, its other positions
/// and some places (m) fit the space of a diagram.
///
/// # Errors
/// The errors of [`work_placed`].
pub(super) fn fitted(
    scene: &Scene,
    worked: &Worked,
    others: &[Configuration],
    places: impl Iterator<Item = Point>,
) -> Result<(Scene, Worked), Faults> {
    let boxes = Boxes::of(&scene.paper, &worked.plan);
    let joints = others
        .iter()
        .chain([&worked.configuration])
        .flat_map(|c| c.points.iter().flatten().copied());
    let extent = scale::extent(joints.chain(places));
    let mut fitted = scene.clone();
    let mu = scale::fitted(&scene.paper, Kind::Length, extent, boxes.diagram);
    fitted.paper.scales.set(Kind::Length, Some(mu));
    let worked = work_placed(
        &fitted,
        worked.mechanism.clone(),
        worked.demand.clone(),
        worked.configuration.clone(),
    )?
    .value;
    Ok((fitted, worked))
}

/// Returns the positions of the mechanism at these travels of its first driver from the pose of the
/// scene. Where the driver goes no farther than a travel, its last position is taken.
pub(super) fn at_travels(scene: &Scene, worked: &Worked, travels: &[f64]) -> Vec<Configuration> {
    let follower =
        PoseFollower::new(scene, &worked.mechanism, &worked.demand, &worked.configuration, 0);
    let sweep = follower.sweep(STEPS);
    let nearest = |travel: f64| {
        let off = |t: f64| (t - travel).abs();
        sweep.poses.iter().min_by(|a, b| off(a.travel).total_cmp(&off(b.travel))).cloned()
    };
    travels
        .iter()
        .filter_map(|t| pose_at(&follower, &sweep, *t).or_else(|| nearest(*t)))
        .map(|pose| pose.configuration)
        .collect()
}

/// A mechanism with other positions, drawn alike.
pub(super) struct PlacedMechanism {
    /// The scene, at the scale of the drawing.
    pub scene: Scene,
    /// Its solution.
    pub worked: Worked,
    /// The features of its own position.
    pub course: SeriesFeatures,
    /// The other positions.
    pub others: Vec<OtherPosition>,
}

/// Returns a mechanism with other positions, each with the mark of its letters.
///
/// # Errors
/// The errors of [`fitted`].
pub(super) fn placed(
    w: &FigureInput,
    (scene, worked): (&Scene, &Worked),
    others: Vec<(Configuration, String)>,
) -> Result<PlacedMechanism, Faults> {
    let (at, marks): (Vec<Configuration>, Vec<String>) = others.into_iter().unzip();
    let (scene, worked) = fitted(scene, worked, &at, std::iter::empty())?;
    let there: Vec<Worked> =
        at.into_iter().map(|configuration| Worked { configuration, ..worked.clone() }).collect();
    let all: Vec<(&Scene, &Worked)> =
        std::iter::once(&worked).chain(&there).map(|w| (&scene, w)).collect();
    let mut shared = courses(&all, &w.options.style, &w.options.notation).into_iter();
    let course = shared.next().unwrap_or_default();
    let others = there
        .into_iter()
        .zip(marks)
        .zip(shared)
        .map(|((worked, mark), course)| OtherPosition { worked, course, mark })
        .collect();
    Ok(PlacedMechanism { scene, worked, course, others })
}
