//! The lines that find Ball's point: rectangles on pole tangent and pole normal, the line through
//! their corners, and its intersections.

use super::construction::CurvatureOverlay;
use hodograph_base::geom::{Point, Vec2};
use hodograph_methods::curvature::drawing::{BallPoint, Rays};
use hodograph_methods::curvature::known::CurvatureRay;
use hodograph_methods::curvature::plane::PlanePoint;
use hodograph_paper::paper::item::Dash;
use hodograph_report::curvature_steps::CurvatureStage;
use hodograph_scene::PointId;

/// Three corners of a point's rectangle: on the tangent, opposite the pole, on the normal.
fn rectangle(rays: &Rays, corner: Point) -> [Point; 3] {
    let normal = rays.normal().unit().unwrap_or(Vec2::ZERO);
    let up = normal * (corner - rays.pole).dot(normal);
    [corner - up, corner, rays.pole + up]
}

/// All points of the construction.
pub(super) fn places(rays: &Rays) -> Vec<Point> {
    let Some(ball) = rays.ball() else { return Vec::new() };
    let rectangles = ball.corners.iter().flat_map(|corner| rectangle(rays, *corner));
    rectangles.chain([ball.crossing, ball.on_tangent, ball.at, rays.inflection]).collect()
}

impl CurvatureOverlay<'_, '_> {
    /// Draws the construction of Ball's point with the letters of its steps, if the paper holds all
    /// of it: lines that lead off the paper explain nothing.
    pub(super) fn ball(&mut self, rays: &Rays, ball: &BallPoint) {
        let corner = |known: &CurvatureRay| {
            self.words.below(self.words.corner(), known.why.moving().unwrap_or(PointId(0)))
        };
        let corners = rays.known.each_ref().map(corner);
        if !places(rays).iter().all(|p| self.board.holds(self.at(*p))) {
            corners.iter().for_each(|name| self.leave_out(name));
            self.leave_out(self.words.corner());
            self.leave_out(self.words.foot());
            return;
        }
        self.begin(CurvatureStage::Ball(0));
        for ((known, name), corner) in rays.known.iter().zip(corners).zip(ball.corners) {
            let PlanePoint::At(moving) = known.moving else { continue };
            let [on_tangent, corner, on_normal] = rectangle(rays, corner).map(|p| self.at(p));
            let moving = self.at(moving);
            self.chain("ball-perpendicular", &[on_tangent, moving, on_normal]);
            self.axes(self.at(rays.pole), on_tangent, on_normal);
            for side in [on_tangent, on_normal] {
                self.segment("ball-rectangle", [side, corner], Dash::Dashed);
            }
            self.spot(&name, corner);
        }
        let [g, h] = ball.corners.map(|p| self.at(p));
        let [crossing, foot, at, j, pole] =
            [ball.crossing, ball.on_tangent, ball.at, rays.inflection, rays.pole]
                .map(|p| self.at(p));
        self.begin(CurvatureStage::Ball(1));
        self.chain("ball-line", &[g, h, crossing]);
        self.chain("ball-parallel", &[j, crossing]);
        self.segment("ball-foot", [crossing, foot], Dash::Dashed);
        self.chain("ball-line", &[foot, j, at]);
        self.segment("ball-foot", [pole, at], Dash::Dashed);
        self.spot(self.words.corner(), crossing);
        self.spot(self.words.foot(), foot);
    }

    /// Extends tangent and normal to the corners on them where they are shorter.
    fn axes(&mut self, pole: Point, on_tangent: Point, on_normal: Point) {
        let normal = self.board.cut(pole, on_normal);
        self.board.line("ball-normal", "curvature line", normal, self.thin);
        let way = on_tangent - pole;
        let drawn = self.half_tangent();
        if way.norm() > drawn {
            self.segment(
                "ball-tangent",
                [pole + way * (drawn / way.norm()), on_tangent],
                Dash::DashDot,
            );
        }
    }

    fn segment(&mut self, name: &str, [from, to]: [Point; 2], dash: Dash) {
        let cut = self.board.cut(from, to);
        self.board.line(name, "curvature line", cut, self.thin.dashed(dash));
    }
}
