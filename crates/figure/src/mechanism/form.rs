//! The form of a link: bars between its points, a plate, the bars along its guides, and its rigid
//! corners.

use hodograph_base::geom::{Point, Vec2};
use hodograph_mechanism::position::Path;
use hodograph_scene::{GuideId, GuidePath, LinkId};

use super::MechanismDraft;

/// A link on paper.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct LinkForm {
    /// Corners of the plate of a link with three or more points that are not collinear; otherwise
    /// empty.
    pub plate: Vec<Point>,
    /// Plain bars.
    pub bars: Vec<(Point, Point)>,
    /// Bars along guides: blocks slide on them.
    pub guide_bars: Vec<(Point, Point)>,
    /// Slots for bare pins: outermost positions of the pin.
    pub slots: Vec<(Point, Point)>,
    /// Slots along arcs: centre, radius, angles.
    pub arcs: Vec<(Point, f64, [f64; 2])>,
    /// Rigid corners between bars: the corner, and a point on each bar.
    pub corners: Vec<(Point, Point, Point)>,
}

impl LinkForm {
    /// Returns all straight lines of the form, including the edges of plates.
    pub fn segments(&self) -> Vec<(Point, Point)> {
        let mut all: Vec<(Point, Point)> =
            self.bars.iter().chain(&self.guide_bars).copied().collect();
        for k in 0..self.plate.len() {
            all.push((self.plate[k], self.plate[(k + 1) % self.plate.len()]));
        }
        all
    }
}

/// Three points are collinear if the middle one deviates by no more than half a link's width.
const IN_LINE_MM: f64 = 0.35;
/// Extension of a guide beyond the block, which shows that the block can slide.
const BEYOND_BLOCK_MM: f64 = 7.0;
/// Half the length of a slot, unless a joint of the link is nearer.
const SLOT_HALF_MM: f64 = 11.0;
/// Distance between the end of a slot and the centre of the next joint.
const SLOT_TO_JOINT_MM: f64 = 4.0;

/// Returns true if `p` is on the segment a–b, within `tolerance_mm`.
pub(super) fn on_segment(p: Point, a: Point, b: Point, tolerance_mm: f64) -> bool {
    let d = b - a;
    if d.norm2() <= 0.0 {
        return p.distance(a) < tolerance_mm;
    }
    let t = ((p - a).dot(d) / d.norm2()).clamp(0.0, 1.0);
    p.distance(a + d * t) < tolerance_mm
}

/// Returns true if `p` is in a convex polygon with counter-clockwise corners; false for an empty
/// one.
pub(super) fn inside(p: Point, corners: &[Point]) -> bool {
    let n = corners.len();
    n > 2 && (0..n).all(|k| (corners[(k + 1) % n] - corners[k]).cross(p - corners[k]) >= 0.0)
}

/// Returns true if an arc from `from` through `sweep`, or its reference line, passes the support in
/// the direction `angle`.
pub(super) fn sweeps(from: f64, sweep: f64, angle: f64) -> bool {
    use std::f64::consts::TAU;
    let turned = ((angle - from) * sweep.signum()).rem_euclid(TAU);
    // Half the angle of the support's hatching, seen from the joint.
    let half = 0.95;
    turned < sweep.abs() + half || turned > TAU - half
}

impl MechanismDraft<'_> {
    /// The form of a link; `None` for the ground, for blocks and cylinder parts, and for links
    /// without a position.
    pub(super) fn form(&self, l: LinkId) -> Option<LinkForm> {
        let (rods, blocks): (Vec<_>, Vec<_>) = self
            .swings()
            .into_iter()
            .filter(|s| s.rod == l || s.block == l)
            .partition(|s| s.rod == l);
        if !rods.is_empty() {
            return Some(LinkForm {
                bars: rods.into_iter().map(|s| s.ends).collect(),
                ..LinkForm::default()
            });
        }
        if !blocks.is_empty() {
            return None;
        }
        if l == self.scene.ground || self.worked.mechanism.is_passive(l) {
            return None;
        }
        let link = &self.scene.links[l.0];
        // A cam and a flat face have their own drawings.
        if self.is_profile(l) {
            return None;
        }
        let drawn = |g: &GuideId| self.scene.guides[g.0].rolling.is_none() && !self.is_contact(*g);
        let own_guides: Vec<GuideId> = (0..self.scene.guides.len())
            .map(GuideId)
            .filter(|g| self.scene.guides[g.0].on == l && drawn(g))
            .collect();
        // The centre of a slot is not part of the body, unless something is pinned there.
        let centre_only = |p| {
            !self.is_pin(p)
                && own_guides.iter().any(|g| matches!(self.scene.guides[g.0].path, GuidePath::Arc { centre, .. } if centre == p))
        };
        let points: Vec<Point> = link
            .points
            .iter()
            .filter(|p| !centre_only(**p))
            .filter_map(|p| self.point(*p))
            .collect();
        let mut form = LinkForm::default();
        if points.len() >= 3 && !in_line(&points) {
            let corners = hull(&points);
            match self.spider(l, &points, &corners) {
                Some(middle) => form.bars = corners.into_iter().map(|c| (middle, c)).collect(),
                None => form.plate = corners,
            }
        }
        for g in own_guides {
            match self.guide(g) {
                Some(Path::Line { direction, .. }) => {
                    self.straight(&mut form, g, direction, &points)
                }
                Some(Path::Arc { centre, radius }) => {
                    self.arc(&mut form, g, centre, radius, &points)
                }
                None => {}
            }
        }
        if form.plate.is_empty() && points.len() >= 2 {
            let (a, b) = ends(&points);
            let covered = |(p, q): &(Point, Point)| {
                on_segment(a, *p, *q, IN_LINE_MM) && on_segment(b, *p, *q, IN_LINE_MM)
            };
            let held =
                |p: &Point| form.bars.iter().any(|(a, b)| on_segment(*p, *a, *b, IN_LINE_MM));
            // The arm of an offset guide, or of a slot, holds one of the points; the bar to the
            // others starts there.
            if !form.guide_bars.iter().any(covered)
                && (form.bars.is_empty() || !points.iter().all(held))
            {
                form.bars.push((a, b));
            }
        }
        // A yoke slides on its own rods, which `slides` draws.
        let empty = form == LinkForm::default();
        (!empty).then_some(form)
    }

    /// The middle of an arm that carries wheels round a point: a plate would hide their contacts.
    fn spider(&self, l: LinkId, points: &[Point], corners: &[Point]) -> Option<Point> {
        let mut within =
            points.iter().filter(|p| corners.iter().all(|c| c.distance(**p) > super::SAME_MM));
        let (middle, None) = (within.next()?, within.next()) else { return None };
        let axes: Vec<Point> = self
            .scene
            .rolling
            .iter()
            .flat_map(|r| r.centres())
            .flatten()
            .filter(|p| self.scene.links[l.0].points.contains(p))
            .filter_map(|p| self.point(p))
            .collect();
        let carries = |c: &Point| axes.iter().any(|a| a.distance(*c) < super::SAME_MM);
        corners.iter().all(carries).then_some(*middle)
    }

    /// A straight guide: a bar for a block, a slot for a bare pin.
    fn straight(&self, form: &mut LinkForm, g: GuideId, u: Vec2, points: &[Point]) {
        let guide = &self.scene.guides[g.0];
        let Some((at, _)) = self.runner(g) else { return };
        let along = |p: Point| (p - at).dot(u);
        let off = |p: Point| (p - at).cross(u).abs();
        let mut on_line: Vec<Point> =
            points.iter().copied().filter(|p| off(*p) < IN_LINE_MM).collect();
        let foot = |p: Point| at + u * along(p);
        if on_line.is_empty()
            && let Some(near) = points.iter().copied().min_by(|p, q| off(*p).total_cmp(&off(*q)))
        {
            // No joint is on the line: an arm perpendicular to the guide holds it.
            form.bars.push((near, foot(near)));
            form.corners.push((foot(near), near, at));
            on_line.push(foot(near));
        }
        let reach = |sign: f64, own: f64| {
            on_line.iter().map(|p| along(*p) * sign).fold(own, f64::max) * sign
        };
        if guide.slider.is_some() {
            let [back, on] = self.travel(g);
            let own = |sign: f64| {
                self.style.block_length_mm / 2.0
                    + BEYOND_BLOCK_MM
                    + if sign > 0.0 { on } else { -back }
            };
            // A known end of the lever is its end; otherwise the bar continues past the block.
            let far = |sign: f64| {
                let ends_there =
                    on_line.iter().any(|p| along(*p) * sign > self.style.block_length_mm / 2.0);
                if ends_there { reach(sign, 0.0) } else { reach(sign, own(sign)) }
            };
            form.guide_bars.push((at + u * far(-1.0), at + u * far(1.0)));
        } else {
            let free = |sign: f64| {
                let joint = on_line
                    .iter()
                    .map(|p| along(*p) * sign)
                    .filter(|t| *t > SLOT_TO_JOINT_MM)
                    .fold(f64::INFINITY, f64::min);
                let [back, on] = self.travel(g);
                let goes = if sign > 0.0 { on } else { -back };
                (SLOT_HALF_MM + goes)
                    .min(joint - SLOT_TO_JOINT_MM)
                    .max(self.style.pin_radius_mm + goes)
                    * sign
            };
            let (lo, hi) = (free(-1.0), free(1.0));
            form.slots.push((at + u * lo, at + u * hi));
            form.guide_bars.push((at + u * reach(-1.0, -lo), at + u * reach(1.0, hi)));
        }
        // Points of the link off the guide: the corner where their bar meets it.
        if form.plate.is_empty()
            && let (Some(off_line), Some(corner)) = (
                points.iter().copied().find(|p| off(*p) >= IN_LINE_MM),
                points.iter().copied().find(|p| off(*p) < IN_LINE_MM),
            )
            && corner.distance(at) > IN_LINE_MM
        {
            form.corners.push((corner, off_line, at));
        }
    }

    /// A slot along a circle, and the arm that holds it.
    fn arc(&self, form: &mut LinkForm, g: GuideId, centre: Point, radius: f64, points: &[Point]) {
        let Some((at, _)) = self.runner(g) else { return };
        let middle = (at - centre).angle();
        let half = (SLOT_HALF_MM / radius).min(std::f64::consts::FRAC_PI_2);
        let [back, on] = self.travel(g).map(|t| t / radius);
        let angles = [middle + back - half, middle + on + half];
        form.arcs.push((centre, radius, angles));
        let ends = angles.map(|a| centre + Vec2::from_angle(a) * radius);
        let pairs = points.iter().flat_map(|p| ends.map(|e| (*p, e)));
        if let Some((p, e)) = pairs.min_by(|x, y| x.0.distance(x.1).total_cmp(&y.0.distance(y.1))) {
            // The arm ends at the slot's wall: inside the slot it would look like a second pin.
            let wall = (p - e)
                .unit()
                .map_or(e, |u| e + u * (self.style.slot_width_mm / 2.0).min(p.distance(e)));
            form.bars.push((p, wall));
        }
    }
}

/// The two points that are farthest apart.
fn ends(points: &[Point]) -> (Point, Point) {
    let mut best = (points[0], points[1]);
    for (i, a) in points.iter().enumerate() {
        for b in &points[i + 1..] {
            if a.distance(*b) > best.0.distance(best.1) {
                best = (*a, *b);
            }
        }
    }
    best
}

fn in_line(points: &[Point]) -> bool {
    let (a, b) = ends(points);
    points.iter().all(|p| on_segment(*p, a, b, IN_LINE_MM))
}

/// The convex hull, counter-clockwise (Andrew's monotone chain); points inside or on an edge are
/// not corners.
fn hull(points: &[Point]) -> Vec<Point> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let chain = |points: &mut dyn Iterator<Item = Point>| {
        let mut out: Vec<Point> = Vec::new();
        for p in points {
            while let [.., a, b] = out[..] {
                if (b - a).cross(p - b) > 0.0 {
                    break;
                }
                out.pop();
            }
            out.push(p);
        }
        out.pop();
        out
    };
    let mut lower = chain(&mut sorted.iter().copied());
    lower.extend(chain(&mut sorted.iter().rev().copied()));
    lower
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hull_of_a_square_with_a_point_inside() {
        let p = |x: f64, y: f64| Point::new(x, y);
        let corners =
            hull(&[p(0.0, 0.0), p(4.0, 4.0), p(2.0, 1.0), p(4.0, 0.0), p(0.0, 4.0), p(2.0, 0.0)]);
        assert_eq!(corners, [p(0.0, 0.0), p(4.0, 0.0), p(4.0, 4.0), p(0.0, 4.0)]);
    }

    #[test]
    fn arcs_and_sides() {
        let (deg, down, up) = (f64::to_radians, -90_f64, 90_f64);
        assert!(!sweeps(0.0, deg(60.0), deg(down)) && sweeps(0.0, deg(240.0), deg(up)));
        assert!(sweeps(0.0, deg(-100.0), deg(down)) && sweeps(0.0, deg(60.0), 0.0));
    }

    #[test]
    fn three_points_of_a_bar_are_in_line() {
        let p = |x: f64, y: f64| Point::new(x, y);
        assert!(in_line(&[p(0.0, 0.0), p(10.0, 10.0), p(5.0, 5.1)]));
        assert!(!in_line(&[p(0.0, 0.0), p(10.0, 10.0), p(5.0, 6.0)]));
    }
}
