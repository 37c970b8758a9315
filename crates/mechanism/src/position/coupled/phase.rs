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
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_scene::{GuideId, LinkId, PointId, Relation, RollingId};

/// Deviation of a pair from rolling, as an angle of its second link, and the coefficients of the
/// deviation for steps measured as lengths.
pub(super) struct Slip<N> {
    pub off: N,
    pub row: Vec<N>,
}

impl<N: Real> CoupledGroup<'_, N> {
    /// Returns the equation of a rolling pair; `None` if only a rough sketch determines it.
    pub(super) fn slip(&self, view: &PlacedGroup<N>, r: RollingId) -> Option<Slip<N>> {
        match (self.assembly.scene.rolling[r.0].relation(), self.assembly.instant) {
            (Relation::Turnings(centres), Some(then)) => self.turned_since(view, r, centres, then),
            (Relation::Turnings(centres), None) => self.in_phase(view, r, centres),
            (Relation::Slide { centre, guide }, Some(then)) => {
                self.gone_since(view, r, (centre, guide), then)
            }
            (Relation::Slide { .. }, None) => None,
        }
    }

    /// Returns the equation of two circles since the instant.
    fn turned_since(
        &self,
        view: &PlacedGroup<N>,
        r: RollingId,
        centres: [PointId; 2],
        then: &Configuration<N>,
    ) -> Option<Slip<N>> {
        let pair = &self.assembly.scene.rolling[r.0];
        let [a, b] = self.turned(view, r, then)?;
        let line = self.line(view, pair.links, centres)?;
        let before = then.points[centres[1].0]? - then.points[centres[0].0]?;
        let line_turned = whole(line.divide_by(before).angle(), self.near(r)[2]);
        self.of_circles(view, r, centres, [a, b, line_turned])
    }

    /// Returns the equation of two circles in their phase.
    fn in_phase(
        &self,
        view: &PlacedGroup<N>,
        r: RollingId,
        centres: [PointId; 2],
    ) -> Option<Slip<N>> {
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
        let mut slip =
            self.of_circles(view, r, centres, [angle(0)?, angle(1)?, N::from_f64(0.0)])?;
        slip.off = whole(slip.off - Vec2::new(c, s).angle(), 0.0);
        Some(slip)
    }

    /// Returns the equation of (φ₂ − β) + (φ₁ − β) ρ₁/ρ₂.
    fn of_circles(
        &self,
        view: &PlacedGroup<N>,
        r: RollingId,
        centres: [PointId; 2],
        [a, b, line]: [N; 3],
    ) -> Option<Slip<N>> {
        let pair = &self.assembly.scene.rolling[r.0];
        let [r1, r2] = pair.sizes(&self.assembly.inputs);
        let ratio = r1 / r2;
        let mut row = self.zeros();
        self.add_turn(&mut row, pair.links[0], ratio);
        self.add_turn(&mut row, pair.links[1], N::from_f64(1.0));
        let d = self.line(view, pair.links, centres)?;
        let k = d.perp() * (N::from_f64(self.scale) * (N::from_f64(1.0) + ratio) / d.norm2());
        for (link, centre, k) in [(pair.links[0], centres[0], k), (pair.links[1], centres[1], -k)] {
            self.add_centre(view, &mut row, link, centre, k)?;
        }
        Some(Slip { off: (b - line) + (a - line) * ratio, row })
    }

    /// Returns the equation of a wheel on a straight track since the instant.
    fn gone_since(
        &self,
        view: &PlacedGroup<N>,
        r: RollingId,
        (centre, guide): (PointId, GuideId),
        then: &Configuration<N>,
    ) -> Option<Slip<N>> {
        let pair = &self.assembly.scene.rolling[r.0];
        let ([on, wheel], [_, radius]) = (pair.links, pair.sizes(&self.assembly.inputs));
        let Path::Line { through, direction } = view.path(guide)? else { return None };
        let pose = view.pose(on)?;
        let at = self.centre(view, wheel, centre)?;
        let before = direction.dot(then.poses[on.0]?.to_local(then.points[centre.0]?) - through);
        let gone = direction.dot(pose.to_local(at) - through) - before;
        let [a, b] = self.turned(view, r, then)?;
        let mut row = self.zeros();
        self.add_turn(&mut row, on, N::from_f64(-1.0));
        self.add_turn(&mut row, wheel, N::from_f64(1.0));
        let k = pose.turn(direction) * (N::from_f64(self.scale) / radius);
        self.add_centre(view, &mut row, wheel, centre, k)?;
        self.add_link(view.at, &mut row, on, at, -k);
        Some(Slip { off: gone / radius + (b - a), row })
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
        Some(self.centre(view, links[1], centres[1])? - self.centre(view, links[0], centres[0])?)
    }

    /// Returns the position of a centre: it moves with its link; if the link has no such point, the
    /// centre's position in the plane is taken.
    fn centre(&self, view: &PlacedGroup<N>, link: LinkId, centre: PointId) -> Option<Point<N>> {
        match view.local(link, centre) {
            Some(local) => Some(view.pose(link)?.to_world(local)),
            None => view.point(centre),
        }
    }

    /// Adds ±k·(motion of a centre).
    fn add_centre(
        &self,
        view: &PlacedGroup<N>,
        row: &mut [N],
        link: LinkId,
        centre: PointId,
        k: Vec2<N>,
    ) -> Option<()> {
        match view.local(link, centre) {
            Some(_) => self.add_link(view.at, row, link, self.centre(view, link, centre)?, k),
            None => self.add_pin(row, centre, k),
        }
        Some(())
    }
}
