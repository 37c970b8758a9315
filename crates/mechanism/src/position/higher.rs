//! Groups without a closed form: Newton's method on their equations, from the sketch.
//!
//! The direction of a slider is not taken from the sketch: at the instant its frame is parallel to
//! the plane's, as in the closed forms.

use super::assemble::Assembly;
use super::branch::GroupClosure;
use super::shape::{FrameAnchor, given_at};
use super::{Configuration, Pose, Shapes, newton};
use crate::mechanism::{GraphNode, Group, PairForm};
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_scene::{GuideId, LinkId, PointId};

impl<N: Real> Assembly<'_, N> {
    /// Returns the closure of a group that only Newton's method from a sketch can solve.
    pub(super) fn newton_trial(
        &self,
        index: usize,
        group: &Group,
    ) -> Result<GroupClosure<N>, Diagnostic> {
        if let Some(meant) = self.meant {
            return self.coupled_trial(group, meant);
        }
        let names: Vec<_> = group.links.iter().map(|l| self.scene.link_name(*l)).collect();
        let lacking = |what: Both| {
            Diagnostic::error(
                "sketch-needed",
                both!(
                    "links {} can only be placed from a rough pose: {}",
                    Both::names(&names),
                    what
                ),
            )
            .at(self.scene.links[group.links[0].0].span)
            .help(both!("give rough coordinates of their joints in \"sketch\""))
        };
        let rough = self.rough_places(group);
        let rough = |p: PointId| rough[p.0];
        let mut start = self.snapshot();
        for &p in &group.pins {
            start.points[p.0] =
                Some(rough(p).ok_or_else(|| {
                    lacking(both!("{} is not sketched", self.scene.point_name(p)))
                })?);
        }
        let sliders: Vec<(LinkId, LinkId)> = group
            .constraints
            .iter()
            .filter_map(|&c| self.m.constraints[c].form().locks())
            .collect();
        for &l in &group.links {
            if let Some((_, on)) = sliders.iter().find(|(s, _)| *s == l) {
                // The frame is parallel to the plane's, unless the slider's points give a direction
                // unrelated to the guide.
                let axis = self.axis_of(l, *on, None)?.approx();
                let seen = self.shapes[l.0].points.iter().find_map(|(p, local)| {
                    Some(rough(*p)? - local.to_vec2().approx().rotate_by(axis))
                });
                let anywhere =
                    || group.pins.iter().find_map(|p| rough(*p)).unwrap_or(Point::ORIGIN);
                start.poses[l.0] = Some(Pose { origin: seen.unwrap_or_else(anywhere), axis });
                continue;
            }
            let known: Vec<(Point, Point)> = self.shapes[l.0]
                .points
                .iter()
                .filter_map(|(p, local)| rough(*p).map(|at| (local.approx(), at)))
                .collect();
            // The frame of a wheel with only its centre is parallel to the plane's: its lines
            // cannot be distinguished.
            if let ([(local, at)], [_]) = (&known[..], &self.shapes[l.0].points[..])
                && self.shapes[l.0].frame == FrameAnchor::Loose
                && self.scene.rolling.iter().any(|r| r.links.contains(&l))
            {
                start.poses[l.0] =
                    Some(Pose { origin: *at - local.to_vec2(), axis: Vec2::new(1.0, 0.0) });
                continue;
            }
            let [a, .., b] = known[..] else {
                return Err(lacking(both!(
                    "link {} has fewer than two placed points",
                    self.scene.link_name(l)
                )));
            };
            start.poses[l.0] = Pose::from_point_and_direction(a.0, b.0 - a.0, a.1, b.1 - a.1);
            if start.poses[l.0].is_none() {
                return Err(lacking(both!(
                    "the sketched points of link {} coincide",
                    self.scene.link_name(l)
                )));
            }
        }
        let drivers = self.driver_values(&start);
        let unlaid = |form: &PairForm| form.path().is_some_and(|g| self.guides[g.0].is_none());
        if let Some(form) =
            group.constraints.iter().map(|c| self.m.constraints[*c].form()).find(unlaid)
        {
            let on = form.ends().1;
            return Err(lacking(both!(
                "a guide on {} is given at the instant only, which does not fix it in that link",
                self.node_name(on)
            )));
        }
        let system =
            newton::System::new(self.scene, self.m, &start.shapes, &start, &[index]).at_instant();
        let (poses, points) = system.solve(&start, &drivers).ok_or_else(|| {
            Diagnostic::error(
                "no-convergence",
                both!("links {} were not brought together from the sketch", Both::names(&names)),
            )
            .at(self.scene.links[group.links[0].0].span)
            .help(both!(
                "improve the sketch, with all joints of these links so that it tells on which side each lies, or check whether the lengths can be assembled"
            ))
        })?;
        let pins =
            group.pins.iter().filter_map(|p| points[p.0].map(|at| (*p, at.lift()))).collect();
        let poses =
            group.links.iter().filter_map(|l| poses[l.0].map(|pose| (*l, pose.lift()))).collect();
        Ok(self.trial(pins, poses))
    }

    /// Returns the positions of points, placed or sketched; for a link with two such points also
    /// those of its other points.
    fn rough_places(&self, group: &Group) -> Vec<Option<Point>> {
        let told = |p: PointId| {
            let sketched = || self.scene.points[p.0].sketch.map(|s| Point::new(s[0], s[1]));
            self.points[p.0]
                .map(Point::approx)
                .or_else(|| given_at(self.scene, p))
                .or_else(sketched)
        };
        let mut places: Vec<Option<Point>> =
            (0..self.scene.points.len()).map(|p| told(PointId(p))).collect();
        // As many rounds as there are links: each round places at least one.
        for _ in &group.links {
            for l in &group.links {
                let points: Vec<(PointId, Point)> =
                    self.shapes[l.0].points.iter().map(|(p, local)| (*p, local.approx())).collect();
                let known: Vec<(Point, Point)> = points
                    .iter()
                    .filter_map(|(p, local)| places[p.0].map(|at| (*local, at)))
                    .collect();
                let [a, .., b] = known[..] else { continue };
                let Some(pose) = Pose::from_point_and_direction(a.0, b.0 - a.0, a.1, b.1 - a.1)
                else {
                    continue;
                };
                for (p, local) in points {
                    places[p.0].get_or_insert_with(|| pose.to_world(local));
                }
            }
        }
        places
    }

    fn node_name(&self, n: GraphNode) -> Both {
        match n {
            GraphNode::Link(l) => both!("before a sign" => "link {}", self.scene.link_name(l)),
            GraphNode::Pin(p) => Both::same(self.scene.point_name(p)),
        }
    }

    fn driver_values(&self, start: &Configuration) -> newton::DriverValues {
        let mut values = newton::driver_values(self.scene, start);
        for (d, driver) in self.scene.drivers.iter().enumerate() {
            if let Some((link, against)) = driver.kind.turned() {
                let known = || {
                    Some(
                        self.axis_of(link, against, Some(d))
                            .ok()?
                            .divide_by(self.poses[against.0]?.axis),
                    )
                };
                // The driver gives the angle between two links of the group.
                if let Some(apart) = known().or_else(|| self.driven_apart(d)) {
                    values.0[d] = apart.approx().angle();
                }
            } else if let Some(length) = driver.kind.length() {
                values.0[d] = length.value;
            }
        }
        values
    }

    /// Returns the parts placed so far, in `f64`.
    fn snapshot(&self) -> Configuration {
        Configuration {
            points: self.points.iter().map(|p| p.map(Point::approx)).collect(),
            poses: self.poses.iter().map(|p| p.map(|p| p.approx())).collect(),
            guides: (0..self.guides.len())
                .map(|g| self.guide_in_plane(GuideId(g)).map(|g| g.approx()))
                .collect(),
            shapes: Shapes {
                points: self
                    .shapes
                    .iter()
                    .map(|s| s.points.iter().map(|(p, at)| (*p, at.approx())).collect())
                    .collect(),
                guides: self.guides.iter().map(|g| g.map(|g| g.approx())).collect(),
                rolling: self.sizes().iter().map(|r| r.map(Real::approx)).collect(),
            },
            closures: self.closures.clone(),
            rolled: Vec::new(),
        }
    }
}
