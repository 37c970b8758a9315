//! Rolling in the equations of a group that is solved as a whole.
//!
//! At the instant two circles have the phase given in the scene: ρ₁(φ₁ − β) + ρ₂(φ₂ − β) = ρ₂·phase
//! with the angles of the links' lines. Later the change of this sum is zero, as is that of s +
//! ρ(φ₂ − φ₁) for a straight track. Angles known up to whole turns are taken closest to those of
//! the known pose.

use super::{CoupledGroup, PlacedGroup};
use crate::position::equations::PartPositions;
use crate::position::rolling::whole;
use crate::position::{Configuration, Path};
use hodograph_base::geom::Vec2;
use hodograph_base::number::Real;
use hodograph_scene::{GuideId, LinkId, PointId, Relation, RollingId};

impl<N: Real> CoupledGroup<'_, N> {
    /// Returns the deviation of a pair from rolling, as an angle of its second link; `None` if only
    /// a rough sketch determines it.
    pub(super) fn slip(&self, view: &PlacedGroup<N>, r: RollingId) -> Option<N> {
        match (self.assembly.scene.rolling[r.0].relation(), self.assembly.instant) {
            (Relation::Turnings(centres), Some(then)) => self.turned_since(view, r, centres, then),
            (Relation::Turnings(centres), None) => self.in_phase(view, r, centres),
            (Relation::Slide { centre, guide }, Some(then)) => {
                self.gone_since(view, r, (centre, guide), then)
            }
            (Relation::Slide { .. }, None) => None,
        }
    }

    /// Returns the deviation of two circles since the instant.
    fn turned_since(
        &self,
        view: &PlacedGroup<N>,
        r: RollingId,
        centres: [PointId; 2],
        then: &Configuration<N>,
    ) -> Option<N> {
        let pair = &self.assembly.scene.rolling[r.0];
        let [a, b] = self.turned(view, r, then)?;
        let line = self.line(view, pair.links, centres)?;
        let before = then.points[centres[1].0]? - then.points[centres[0].0]?;
        let line_turned = whole(line.divide_by(before).angle(), self.near(r)[2]);
        Some(self.of_circles(r, [a, b, line_turned]))
    }

    /// Returns the deviation of two circles from their phase.
    fn in_phase(&self, view: &PlacedGroup<N>, r: RollingId, centres: [PointId; 2]) -> Option<N> {
        let a = self.assembly;
        let pair = &a.scene.rolling[r.0];
        let (s, c) = a.inputs.sin_cos(pair.phase.as_ref()?);
        let line = self.line(view, pair.links, centres)?;
        // Measured from the line of centres.
        let angle = |k: usize| {
            Some(
                a.mark(pair.links[k])?
                    .rotate_by(view.pose(pair.links[k])?.axis)
                    .divide_by(line)
                    .angle(),
            )
        };
        let sum = self.of_circles(r, [angle(0)?, angle(1)?, N::from_f64(0.0)]);
        Some(whole(sum - Vec2::new(c, s).angle(), 0.0))
    }

    /// Returns (φ₂ − β) + (φ₁ − β) ρ₁/ρ₂.
    fn of_circles(&self, r: RollingId, [a, b, line]: [N; 3]) -> N {
        let [r1, r2] = self.assembly.scene.rolling[r.0].sizes(&self.assembly.inputs);
        (b - line) + (a - line) * (r1 / r2)
    }

    /// Returns the deviation of a wheel on a straight track since the instant.
    fn gone_since(
        &self,
        view: &PlacedGroup<N>,
        r: RollingId,
        (centre, guide): (PointId, GuideId),
        then: &Configuration<N>,
    ) -> Option<N> {
        let pair = &self.assembly.scene.rolling[r.0];
        let ([on, wheel], [_, radius]) = (pair.links, pair.sizes(&self.assembly.inputs));
        let Path::Line { through, direction } = view.path(guide)? else { return None };
        let pose = view.pose(on)?;
        let at = view.centre(wheel, centre)?;
        let before = direction.dot(then.poses[on.0]?.to_local(then.points[centre.0]?) - through);
        let gone = direction.dot(pose.to_local(at) - through) - before;
        let [a, b] = self.turned(view, r, then)?;
        Some(gone / radius + (b - a))
    }

    /// Returns the rotations of both links since the instant.
    fn turned(
        &self,
        view: &PlacedGroup<N>,
        r: RollingId,
        then: &Configuration<N>,
    ) -> Option<[N; 2]> {
        let links = self.assembly.scene.rolling[r.0].links;
        let of = |k: usize| {
            Some(whole(
                view.pose(links[k])?.axis.divide_by(then.poses[links[k].0]?.axis).angle(),
                self.near(r)[k],
            ))
        };
        Some([of(0)?, of(1)?])
    }

    /// Returns the rotations of links and line in the known pose.
    fn near(&self, r: RollingId) -> [f64; 3] {
        self.meant
            .rolled
            .get(r.0)
            .and_then(Option::as_ref)
            .map_or([0.0; 3], |rolled| rolled.turned())
    }

    /// Returns the vector from the first centre to the second.
    fn line(
        &self,
        view: &PlacedGroup<N>,
        links: [LinkId; 2],
        centres: [PointId; 2],
    ) -> Option<Vec2<N>> {
        Some(view.centre(links[1], centres[1])? - view.centre(links[0], centres[0])?)
    }
}
