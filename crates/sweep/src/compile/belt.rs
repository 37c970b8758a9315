//! Operations for the ends of a strand: both are fixed on the link that carries the centres, so
//! that each is an image of the line of centres.

use super::{Compiler, MovingPoint, NoKernel};
use crate::carry::Image;
use crate::kernel::RegPair;
use hodograph_mechanism::mechanism::Level::Position as P;
use hodograph_mechanism::position::belt;
use hodograph_scene::{PointId, RollingId};

impl Compiler<'_> {
    /// The end `at` of the strand between two wheels.
    pub(super) fn strand_end(
        &mut self,
        r: RollingId,
        centres: [PointId; 2],
        right: bool,
        at: PointId,
    ) -> Result<RegPair, NoKernel> {
        let ([a, b], [r1, r2]) = (centres, self.at.shapes.rolling[r.0]);
        let pair = &self.scene.rolling[r.0];
        let own = usize::from(pair.at[0] != at);
        let distance = (self.now(MovingPoint::Pin(b)) - self.now(MovingPoint::Pin(a))).norm();
        let [cos, sin] =
            belt::normal([r1, r2], distance).ok_or_else(|| self.lost(pair.links[own]))?;
        let d = self.between(MovingPoint::Pin(a), MovingPoint::Pin(b))?;
        let o = self.point(centres[own], P)?;
        let arm = [r1, -r2][own] / distance;
        Ok(self.emit_pair(P, Image { o, d, k: [cos * arm, if right { -sin } else { sin } * arm] }))
    }
}
