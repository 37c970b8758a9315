//! One set of scales for a series of poses: everything fits the paper, but what stands next to a limit, where vectors grow beyond
//! all bounds.

use hodograph_base::geom::Point;
use hodograph_board::construct::scale::{self, Boxes, extent};
use hodograph_scene::{ByKind, DiagramKind, Kind, Paper};
use hodograph_sweep::points::bounded;
use hodograph_worked::worked::Worked;

/// One scale for each drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Scales {
    /// Of the mechanism and of the polygons that there are, SI per mm.
    pub mu: ByKind,
    /// The largest polygons (in boxes, SI) that the paper holds.
    most: ByKind,
    boxes: Boxes,
}

impl Scales {
    /// The scales at which all poses fit their boxes, but those next to a limit; what the paper fixes stays. Poses come with
    /// the driver's travel; the one with travel 0 is shown in any case.
    pub fn of(paper: &Paper, poses: &[(f64, &Worked)], unlimited: bool, boxes: Boxes) -> Scales {
        let places = poses.iter().flat_map(|(_, w)| w.configuration.points.iter().flatten().copied());
        let lengths = scale::fitted(paper, Kind::Length, extent(places), boxes.diagram);
        let mu = ByKind::default().with(Kind::Length, Some(lengths));
        let mut scales = Scales { mu, most: ByKind::default(), boxes };
        for on in DiagramKind::VECTORS {
            let size = |w: &Worked| size(w, on, &boxes);
            let own = poses.iter().find(|p| p.0 == 0.0).and_then(|p| size(p.1)).unwrap_or(0.0);
            let Some(most) = bounded(poses.iter().filter_map(|p| size(p.1)).collect(), own, unlimited) else { continue };
            let fitting = poses.iter().map(|p| p.1).filter(|w| size(w).is_some_and(|s| s <= most));
            let ends = fitting.flat_map(|w| ends(w, on));
            let mu = scale::fitted(paper, on.kind(), extent(ends.chain([Point::ORIGIN])), boxes.polygon);
            scales.mu.set(on.kind(), Some(mu));
            scales.most.set(on.kind(), Some(most));
        }
        scales
    }

    /// Whether the paper holds a pose's polygon (there is one, and it is not next to a limit).
    pub fn holds(&self, worked: &Worked, on: DiagramKind) -> bool {
        size(worked, on, &self.boxes).is_some_and(|s| s <= self.most.get(on.kind()).unwrap_or(f64::INFINITY))
    }

    /// The diagonal of the room for a polygon (mm): no vector on the paper is longer.
    pub fn longest_mm(&self) -> f64 {
        libm::hypot(self.boxes.polygon[0], self.boxes.polygon[1])
    }

    /// Writes the scales on a paper.
    pub fn fix(&self, paper: &mut Paper) {
        paper.scales.clone_from(&self.mu);
    }
}

/// The ends of all vectors of a pose's polygon, seen from the pole; of force polygons their vertices, seen from the first (SI).
pub fn ends(worked: &Worked, on: DiagramKind) -> impl Iterator<Item = Point> {
    let of_motion = worked.construction.polygon(on).into_iter().flat_map(|p| {
        let mu = p.mu;
        let marks = p.edges.iter().flat_map(|e| [e.from.1, e.to.1]).chain(p.images.iter().flatten().copied());
        marks.map(move |q| (q.to_vec2() * mu).to_point())
    });
    let forces = worked.equilibrium.as_ref().filter(|_| on == DiagramKind::Force);
    of_motion.chain(forces.into_iter().flat_map(|of| of.groups.iter().flat_map(|group| of.vertices(group))))
}

/// The size of a polygon, of force polygons that of the largest (SI per mm of its box).
pub fn size(worked: &Worked, on: DiagramKind, boxes: &Boxes) -> Option<f64> {
    let in_box = |[w, h]: [f64; 2]| (w / boxes.polygon[0]).max(h / boxes.polygon[1]);
    if on == DiagramKind::Force {
        let of = worked.equilibrium.as_ref()?;
        return of.groups.iter().map(|group| in_box(extent(of.vertices(group)))).reduce(f64::max);
    }
    worked.construction.polygon(on).map(|p| in_box(p.extent()))
}
