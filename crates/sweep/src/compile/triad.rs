//! Operations for links on three legs, which are followed from position to position.

use super::place::LegLocus;
use super::{Compiler, LinkReference, MovingPoint, NoKernel};
use crate::follow::triad::{LinkTrack, TrackLeg};
use crate::kernel::{Reg, RegPair};
use hodograph_base::geom::{Point, Vec2};
use hodograph_mechanism::mechanism::{Hold, Level};
use hodograph_mechanism::position::Path;
use hodograph_scene::LinkId;

const P: Level = Level::Position;

impl Compiler<'_> {
    /// Places a link on three legs: it is followed from position to position.
    pub(super) fn triad(&mut self, g: usize, link: LinkId, holds: &[Hold]) -> Result<(), NoKernel> {
        let [_, _, _] = holds else { return Err(self.without_kernel(g)) };
        let pose = self.at.poses[link.0].ok_or_else(|| self.lost(link))?;
        let at = self.own_point(link, holds);
        let d = Vec2::new(self.unit, 0.0);
        let first = self.take(4);
        let pair = |i: u32| RegPair { x: Reg(first.0 + i), y: Reg(first.0 + i + 1) };
        let (own, arm) = (pair(0), pair(2));
        let body = LinkReference {
            origin: MovingPoint::Own(link),
            at,
            d,
            between: None,
            own: [Some(own), None, None],
            arm: [Some(arm), None, None],
            turning: [None; 2],
        };
        let mut held = Vec::new();
        for hold in holds {
            held.push(self.held_for_track(g, link, &body, hold)?);
        }
        let held: [TrackLeg; 3] = held.try_into().map_err(|_| self.without_kernel(g))?;
        let step = self.steps[P as usize].len();
        let start = (pose.to_world(at), pose.axis);
        self.tracks.push(LinkTrack {
            group: g,
            link,
            step,
            own,
            arm,
            unit: self.unit,
            held,
            start,
        });
        self.bodies[link.0] = Some(body);
        // The rows come after the track: they need the link's points.
        for hold in holds {
            self.held(g, link, hold)?;
        }
        Ok(())
    }

    /// A leg of a followed link: its known quantities, in registers.
    fn held_for_track(
        &mut self,
        g: usize,
        link: LinkId,
        body: &LinkReference,
        hold: &Hold,
    ) -> Result<TrackLeg, NoKernel> {
        // Local places are counted from the link's own point.
        let from_own = |local: Point| local - body.at;
        match *hold {
            Hold::Slot { pin, guide } => match self.at.shapes.guides[guide.0] {
                Some(Path::Line { through, direction }) => Ok(TrackLeg::Slot {
                    through: from_own(through),
                    direction,
                    over: self.point(pin, P)?,
                }),
                Some(Path::Arc { centre, radius }) => Ok(TrackLeg::Circle {
                    near: from_own(centre),
                    far: self.point(pin, P)?,
                    radius: self.constant(radius),
                }),
                None => Err(self.without_kernel(g)),
            },
            // A gliding leg needs the link's own position at the instant, which is known before the
            // link is.
            Hold::Glide { .. } | Hold::Rolls { .. } => Err(self.without_kernel(g)),
            Hold::Distance { .. } | Hold::Guide { .. } => {
                let rows = self.rows[g].len();
                let (spot, locus) = self.held(g, link, hold)?;
                self.rows[g].truncate(rows);
                let MovingPoint::Fixed(_, local) = spot else { return Err(self.without_kernel(g)) };
                Ok(match locus {
                    LegLocus::Circle { centre, radius, .. } => {
                        TrackLeg::Circle { near: from_own(local), far: centre, radius }
                    }
                    LegLocus::Line { through, direction, .. } => {
                        TrackLeg::Line { near: from_own(local), through, direction }
                    }
                })
            }
        }
    }
}
