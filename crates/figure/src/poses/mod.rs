//! Draws the sheet of many poses: for each of them the mechanism with its velocity and acceleration
//! polygon, all to one set of scales, in the rows of a table, as in course design work.
//!
//! This module chooses the poses and their scales. [`cells`] fills the cells, [`page`] forms the
//! pages; [`turn`](mod@turn) shows the poses one after the other.

mod cells;
mod page;
mod turn;

pub use turn::{PoseFrames, turn};

use hodograph_base::diag::{Diagnostic, Faults, Warned, both};
use hodograph_base::geom::Point;
use hodograph_board::construct::scale::{self, Boxes};
use hodograph_scene::{DiagramKind, PointId, Scene, Swept};
use hodograph_sweep::follow::{PoseFollower, TravelPose};
use hodograph_sweep::points::{PathMotion, at_equal_steps, motion};
use hodograph_sweep::station;
use hodograph_worked::worked::{Worked, work_motion, work_placed, work_pose};

use super::series::{ScaleChoice, SeriesScales};
use super::sheet::SheetOptions;
use hodograph_paper::paper::item::{Anchor, Colour, Figure, FigureItem, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::style::Style;

/// Steps in which the mechanism is followed through a turn: 2°.
const STEPS: usize = 180;
/// Space for the drawings of one pose in the table: a row of three is as wide as A4 portrait, which
/// holds four or five rows.
const BOXES: Boxes = Boxes { diagram: [48.0, 44.0], polygon: [44.0, 44.0] };

/// The content of the sheet.
#[derive(Clone, Debug, PartialEq)]
pub struct PosesContent {
    /// Number of poses, at equal steps of the driver or of time: from the scene's own pose through
    /// a full turn, or from one end of the travel to the other.
    pub count: usize,
    /// The moving driver, or time.
    pub swept: Swept,
    /// Points with their paths and hodographs behind the drawings.
    pub points: Vec<PointId>,
}

/// Draws the sheets, on as many pages as needed: of the size that the scene fixes for its paper, or
/// else A4, or A3 if a row is wider.
///
/// # Errors
/// `no-motion` if the mechanism cannot be followed from its pose; `paper-too-small` if the paper
/// does not hold one row.
///
/// ```
/// use hodograph_figure::{poses, sheet::SheetOptions};
/// use hodograph_scene::{self as scene, Lang, Swept, templates};
/// use hodograph_worked::worked::{Scope, work};
/// let scene = scene::read(templates::get("slider-crank").unwrap())?.value;
/// let worked = work(&scene, Scope::Figure)?.value;
/// let wanted = poses::PosesContent { count: 4, swept: Swept::Driver(0), points: Vec::new() };
/// let pages = poses::sheets(&scene, &worked, &SheetOptions::of_language(Lang::En), &wanted)?.value;
/// assert_eq!(pages.len(), 2); // a page of A4 holds two or three rows
/// # Ok::<(), hodograph_base::diag::Faults>(())
/// ```
pub fn sheets(
    scene: &Scene,
    worked: &Worked,
    options: &SheetOptions,
    wanted: &PosesContent,
) -> Result<Warned<Vec<Figure>>, Faults> {
    let poses = Poses::of(scene, worked, wanted, (BOXES, scale::fitted))?;
    let style = Style { label_mm: options.style.small_mm, ..options.style.clone() };
    let options = SheetOptions { style, ..options.clone() };
    let pages = poses.table(&options, wanted.swept, false).pages(scene.paper.size_mm)?;
    Ok(Warned { value: pages, notes: poses.notes(scene, wanted) })
}

/// All poses, solved and drawn to one set of scales.
struct Poses {
    rows: Vec<PoseRow>,
    full: bool,
    moved: Option<PathMotion>,
    scales: SeriesScales,
    shortened: Option<Diagnostic>,
}

impl Poses {
    fn of(
        scene: &Scene,
        worked: &Worked,
        wanted: &PosesContent,
        (boxes, choice): (Boxes, ScaleChoice),
    ) -> Result<Poses, Faults> {
        let motion_of_cams = work_motion(scene)?;
        let (scene, worked) =
            motion_of_cams.as_ref().map_or((scene, worked), |(scene, worked)| (scene, worked));
        let follower = PoseFollower::new(
            scene,
            &worked.mechanism,
            &worked.demand,
            &worked.configuration,
            wanted.swept,
        );
        let sweep = follower.sweep(STEPS);
        let poses = at_equal_steps(&follower, &sweep, wanted.count);
        follower.proved(poses.iter().map(|p| &p.configuration))?;
        // First to their own scales, which give the sizes.
        let work = |p: &TravelPose| {
            work_pose(
                &follower.scene_at(scene, p.travel),
                (&worked.mechanism, &worked.demand),
                &p.configuration,
            )
            .ok()
        };
        let trials: Vec<(&TravelPose, (Scene, Worked))> =
            poses.iter().filter_map(|p| Some((p, work(p)?))).collect();
        let sized: Vec<(f64, &Worked)> = trials.iter().map(|(p, (_, w))| (p.travel, w)).collect();
        let scales = SeriesScales::of(&scene.paper, &sized, sweep.is_unlimited(), boxes, choice);
        let now = station::now(scene, &worked.configuration, wanted.swept);
        // Each trial is dropped when its row is made.
        let rows: Vec<PoseRow> = trials
            .into_iter()
            .filter_map(|(pose, (mut scene, trial))| {
                let end = sweep.limits.iter().flatten().any(|limit| *limit == pose.travel);
                scales.fix(&mut scene.paper);
                let shown = DiagramKind::POLYGONS
                    .into_iter()
                    .filter(|on| scales.holds(&trial, *on))
                    .collect();
                let Worked { mechanism, demand, configuration, .. } = trial;
                let worked = work_placed(&scene, mechanism, demand, configuration).ok()?.value;
                Some(PoseRow { scene, worked, shown, end, place: now + pose.travel })
            })
            .collect();
        // A table has at least two rows, unless a single pose is requested.
        if rows.is_empty() || rows.len() < 2 && wanted.count > 1 {
            let d = Diagnostic::error(
                "no-motion",
                both!("the mechanism cannot be followed from its pose"),
            );
            return Err(d
                .help(both!("give another pose, or ask for the sheet of this one"))
                .into());
        }
        let moved = (!wanted.points.is_empty()).then(|| {
            motion(
                scene,
                &worked.mechanism,
                &worked.demand,
                &worked.configuration,
                wanted.swept,
                &wanted.points,
                0,
            )
        });
        Ok(Poses { rows, full: sweep.full, moved, scales, shortened: follower.shortened() })
    }

    fn table<'a>(&'a self, options: &'a SheetOptions, swept: Swept, still: bool) -> PoseTable<'a> {
        let Poses { rows, full, moved, scales, .. } = self;
        PoseTable {
            options,
            rows,
            full: *full,
            swept,
            moved: moved.as_ref(),
            scales: scales.clone(),
            still,
        }
    }

    /// Notes about the requested poses.
    fn notes(&self, scene: &Scene, wanted: &PosesContent) -> Vec<Diagnostic> {
        let rows = &self.rows;
        let mut notes = Vec::from_iter(self.shortened.clone());
        if rows.len() < wanted.count {
            notes.push(Diagnostic::note(
                "poses",
                both!("{} of {} poses can be drawn", rows.len(), wanted.count),
            ));
        }
        if scene.own_drivers() > 1 && wanted.swept != Swept::Time {
            let text = both!(
                "the scene has several drivers: one of them moves from pose to pose, the others hold their positions, with their rates"
            );
            notes.push(Diagnostic::note("poses-driver", text));
        }
        notes
    }
}

/// A pose to the common scales.
struct PoseRow {
    scene: Scene,
    worked: Worked,
    shown: Vec<DiagramKind>,
    /// True if the driver is at a limit: then only the driver has a vector, and there is no
    /// polygon.
    end: bool,
    /// The place of the driver (rad, m), or the time (s).
    place: f64,
}

impl PoseRow {
    fn unbounded(&self) -> bool {
        self.end || !self.worked.solution.refused.is_empty()
    }
}

/// All poses, ready for layout.
struct PoseTable<'a> {
    options: &'a SheetOptions,
    rows: &'a [PoseRow],
    full: bool,
    swept: Swept,
    moved: Option<&'a PathMotion>,
    scales: SeriesScales,
    /// True if names keep their places from pose to pose, because the poses follow one another in
    /// time.
    still: bool,
}

fn text(class: &str, at: Point, label: Label, size_mm: f64, anchor: Anchor) -> FigureItem {
    FigureItem::new(class, Shape::Label { at, label, size_mm, anchor, colour: Colour::BLACK })
}
