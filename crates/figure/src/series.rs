//! One set of scales for a series of poses: everything fits the paper, except poses next to a
//! limit, where vectors grow without bound.

use hodograph_base::geom::Point;
use hodograph_board::construct::scale::{Boxes, extent};
use hodograph_scene::{ByKind, DiagramKind, Kind, Paper};
use hodograph_sweep::points::bounded;
use hodograph_worked::worked::Worked;

/// The choice of a scale: [`hodograph_board::construct::scale::fitted`], or
/// [`hodograph_board::construct::scale::filling`] for what is seen and not measured.
pub type ScaleChoice = fn(&Paper, Kind, [f64; 2], [f64; 2]) -> f64;

/// One scale for each drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct SeriesScales {
    /// The scales of the mechanism and of the polygons that exist (SI units per mm).
    pub mu: ByKind,
    /// The largest polygons that the paper holds (in boxes, SI units).
    most: ByKind,
    boxes: Boxes,
}

impl SeriesScales {
    /// Returns the scales at which all poses fit their boxes, except those next to a limit; scales
    /// that the paper fixes are kept. Poses come with the driver's travel; the one with travel 0 is
    /// shown in any case.
    pub fn of(
        paper: &Paper,
        poses: &[(f64, &Worked)],
        unlimited: bool,
        boxes: Boxes,
        choice: ScaleChoice,
    ) -> SeriesScales {
        let places =
            poses.iter().flat_map(|(_, w)| w.configuration.points.iter().flatten().copied());
        let lengths = choice(paper, Kind::Length, extent(places), boxes.diagram);
        let mu = ByKind::default().with(Kind::Length, Some(lengths));
        let mut scales = SeriesScales { mu, most: ByKind::default(), boxes };
        for on in DiagramKind::VECTORS {
            let size = |w: &Worked| size(w, on, &boxes);
            let own = poses.iter().find(|p| p.0 == 0.0).and_then(|p| size(p.1)).unwrap_or(0.0);
            let Some(most) =
                bounded(poses.iter().filter_map(|p| size(p.1)).collect(), own, unlimited)
            else {
                continue;
            };
            let fitting = poses.iter().map(|p| p.1).filter(|w| size(w).is_some_and(|s| s <= most));
            let ends = fitting.flat_map(|w| ends(w, on));
            let mu = choice(paper, on.kind(), extent(ends.chain([Point::ORIGIN])), boxes.polygon);
            scales.mu.set(on.kind(), Some(mu));
            scales.most.set(on.kind(), Some(most));
        }
        scales
    }

    /// Returns true if the paper holds a pose's polygon (it exists, and the pose is not next to a
    /// limit).
    pub fn holds(&self, worked: &Worked, on: DiagramKind) -> bool {
        size(worked, on, &self.boxes)
            .is_some_and(|s| s <= self.most.get(on.kind()).unwrap_or(f64::INFINITY))
    }

    /// Returns the diagonal of the space for a polygon (mm): no vector on the paper is longer.
    pub fn longest_mm(&self) -> f64 {
        libm::hypot(self.boxes.polygon[0], self.boxes.polygon[1])
    }

    /// Writes the scales on a paper.
    pub fn fix(&self, paper: &mut Paper) {
        paper.scales.clone_from(&self.mu);
    }
}

/// Returns the ends of all vectors of a pose's polygon, relative to the pole; for force polygons
/// their vertices, relative to the first one (SI units).
pub fn ends(worked: &Worked, on: DiagramKind) -> impl Iterator<Item = Point> {
    let of_motion = worked.construction.polygon(on).into_iter().flat_map(|p| {
        let mu = p.mu;
        let marks = p
            .edges
            .iter()
            .flat_map(|e| [e.from.1, e.to.1])
            .chain(p.images.iter().flatten().copied());
        marks.map(move |q| (q.to_vec2() * mu).to_point())
    });
    let forces = worked.equilibrium.as_ref().filter(|_| on == DiagramKind::Force);
    of_motion.chain(
        forces.into_iter().flat_map(|of| of.groups.iter().flat_map(|group| of.vertices(group))),
    )
}

/// Returns the size of a polygon; for force polygons, of the largest one (SI units per mm of its
/// box).
pub fn size(worked: &Worked, on: DiagramKind, boxes: &Boxes) -> Option<f64> {
    let in_box = |[w, h]: [f64; 2]| (w / boxes.polygon[0]).max(h / boxes.polygon[1]);
    if on == DiagramKind::Force {
        let of = worked.equilibrium.as_ref()?;
        return of.groups.iter().map(|group| in_box(extent(of.vertices(group)))).reduce(f64::max);
    }
    worked.construction.polygon(on).map(|p| in_box(p.extent()))
}
