//! The construction with the ruler, from places alone: no velocity and no acceleration is used.
//!
//! Two rays through points with known centres cross in P. Bobillier: Q = BC × AD, and PQ is the
//! collineation axis. The parallel to PC through A meets it in Q₁, and Q₁B meets PC in J_C, the
//! point of the ray with a straight path. J_B is found in the same way. The perpendiculars to the
//! rays at J_B and J_C cross in J. For any point E, the perpendicular to PE through P meets EJ in
//! H, and the parallel to PJ through H meets PE in the centre E₀; by similar triangles this is PE²
//! = EE₀ · EJ_E (Euler–Savary).
//!
//! # Source
//! É. Bobillier, *Cours de géométrie*, 1870; F. Savary, *Leçons*, 1831; R. Beyer, *Kinematische
//! Getriebesynthese*, §4.

use super::known::{CurvatureRay, CurvatureReason};
use super::plane::{PlaneLine, PlanePoint, meet};
use hodograph_base::geom::{Point, Vec2};
use hodograph_board::construct::pencil::Hand;
use hodograph_scene::{PointId, RollingId};

/// The construction of a link's curvature.
#[derive(Clone, Debug, PartialEq)]
pub enum CurvatureDrawing {
    /// From two rays.
    Rays(Box<Rays>),
    /// Both links carry this pin: it is the permanent pole.
    Hinge(PointId),
    /// The rays are parallel: the pole is at infinity, and the link translates at the instant.
    Parallel([CurvatureRay; 2]),
    /// Both rays lie on one line: a dead centre, at which rays do not determine the pole.
    OneLine([CurvatureRay; 2]),
    /// The link rolls on the other: the contact is the pole, and the wheel's centre lies on the
    /// pole normal.
    Rolling(RollingWheel),
    /// Fewer than two points have a path known beforehand.
    NoRays,
}

impl CurvatureDrawing {
    /// Returns the pole and PJ; `None` if the drawing finds no pole.
    pub fn pole(&self) -> Option<(Point, Vec2)> {
        match self {
            CurvatureDrawing::Rays(r) => Some((r.pole, r.normal())),
            CurvatureDrawing::Rolling(r) => Some((r.pole, r.inflection - r.pole)),
            CurvatureDrawing::Hinge(_)
            | CurvatureDrawing::Parallel(_)
            | CurvatureDrawing::OneLine(_)
            | CurvatureDrawing::NoRays => None,
        }
    }

    /// Returns Ball's point, if it is drawn.
    pub fn ball(&self) -> Option<Point> {
        match self {
            CurvatureDrawing::Rays(r) => r.ball().map(|b| b.at),
            CurvatureDrawing::Rolling(_)
            | CurvatureDrawing::Hinge(_)
            | CurvatureDrawing::Parallel(_)
            | CurvatureDrawing::OneLine(_)
            | CurvatureDrawing::NoRays => None,
        }
    }
}

/// A wheel on its track.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RollingWheel {
    /// The pair.
    pub pair: RollingId,
    /// The contact, which is the pole.
    pub pole: Point,
    /// The centre of the moving link.
    pub moving: PlanePoint,
    /// The centre of the reference link.
    pub fixed: PlanePoint,
    /// J, the inflection pole.
    pub inflection: Point,
}

/// The way in which the point of a ray with a straight path is found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RayMethod {
    /// The point is the pin of a straight guide.
    Given,
    /// From the collineation axis and this point on it.
    Collineation(PlanePoint),
    /// By the fourth proportional on the ray itself: 1/PJ = 1/PB − 1/PA, because the axis would be
    /// crossed at too small an angle.
    Proportion,
}

/// The drawing from two rays.
#[derive(Clone, Debug, PartialEq)]
pub struct Rays {
    /// The points and centres on them.
    pub known: [CurvatureRay; 2],
    /// P, the pole.
    pub pole: Point,
    /// Q, if it is used.
    pub collineation: Option<PlanePoint>,
    /// The ways in which J_B and J_C are found.
    pub how: [RayMethod; 2],
    /// J_B and J_C.
    pub straight: [Point; 2],
    /// J; coincides with the pole if the pole is stationary.
    pub inflection: Point,
    size: f64,
}

/// The drawing of the centre of a point's path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Traced {
    /// The point.
    pub of: PointId,
    /// The place of the point.
    pub at: Point,
    /// J_E, the foot of J on the ray.
    pub foot: Point,
    /// H, on the perpendicular to the ray through P.
    pub helper: PlanePoint,
    /// E₀.
    pub centre: PlanePoint,
}

/// The smallest sine of the angle at which an auxiliary line may cross the axis or the ray.
const FLAT: f64 = 1e-3;
/// Lengths below this fraction of the mechanism's size count as zero.
const NONE: f64 = 1e-11;

impl Rays {
    /// Draws the curvature from two rays; `None` if the rays do not cross.
    pub fn new(known: [CurvatureRay; 2], size: f64, hand: &Hand) -> Option<Rays> {
        let rays = known.map(|k| k.ray());
        let pole = hand.mark(meet(rays[0], rays[1])?.at()?);
        let [b, c] = known;
        let axis = meet(b.moving.join(c.moving), b.fixed.join(c.fixed))
            .filter(|q| hand.decide(q.at().is_none_or(|q| q.distance(pole) > FLAT * size)));
        let axis = axis.map(|q| q.marked(hand));
        let axis_line = axis.map(|q| PlanePoint::At(pole).join(q));
        let mut out = Rays {
            known,
            pole,
            collineation: None,
            how: [RayMethod::Proportion; 2],
            straight: [pole; 2],
            inflection: pole,
            size,
        };
        for k in [0, 1] {
            let (own, other) = (known[k], known[1 - k]);
            let drawn = axis_line.and_then(|line| out.by_collineation(line, own, other, hand));
            (out.how[k], out.straight[k]) = match (own.why, drawn) {
                (CurvatureReason::Straight(..), _) => (RayMethod::Given, own.moving.at()?),
                (_, Some((helper, at))) => (RayMethod::Collineation(helper), at),
                (_, None) => (
                    RayMethod::Proportion,
                    hand.mark(proportion(pole, rays[k].unit()?, own.moving, own.fixed)?),
                ),
            };
        }
        out.collineation =
            axis.filter(|_| out.how.iter().any(|h| matches!(h, RayMethod::Collineation(_))));
        let [p, q] = [0, 1].map(|k| (out.straight[k], rays[k].along.perp()));
        out.inflection = hand.mark(
            meet(
                PlaneLine { through: Some(p.0), along: p.1 },
                PlaneLine { through: Some(q.0), along: q.1 },
            )?
            .at()?,
        );
        Some(out)
    }

    /// Returns the point of a ray with a straight path, from the axis and the other ray's point and
    /// centre.
    fn by_collineation(
        &self,
        axis: PlaneLine,
        own: CurvatureRay,
        other: CurvatureRay,
        hand: &Hand,
    ) -> Option<(PlanePoint, Point)> {
        let ray = own.ray();
        let parallel = other.fixed.join(PlanePoint::Infinity(ray.along));
        let helper = meet(axis, parallel)?.marked(hand);
        let line = helper.join(other.moving);
        let square = line.sine(ray).abs() > FLAT
            && (parallel.through.is_none() || axis.sine(parallel).abs() > FLAT);
        // A helper point far from the mechanism does not fit on paper.
        let near = helper.at().is_none_or(|h| h.distance(self.pole) < 1e3 * self.size);
        let at = hand.mark(meet(line, ray)?.at()?);
        hand.decide(square && near && axis.sine(ray).abs() > FLAT).then_some((helper, at))
    }

    /// Returns PJ; zero if the pole is stationary.
    pub fn normal(&self) -> Vec2 {
        let normal = self.inflection - self.pole;
        if normal.norm() > NONE * self.size { normal } else { Vec2::ZERO }
    }

    /// Draws the centre of a point's path; `None` at the pole.
    pub fn traced(&self, of: PointId, at: Point, hand: &Hand) -> Option<Traced> {
        traced(self.pole, self.inflection, of, at, self.size, hand)
    }

    /// Returns Ball's point by the cubic of stationary curvature through the two points, which
    /// requires permanent centres: 1/r = 1/(M sin ψ) + 1/(N cos ψ) on a ray at ψ from the pole
    /// tangent, crossed with the inflection circle r = d sin ψ. Let x = r/cos ψ and y = r/sin ψ be
    /// the intercepts of the perpendicular to the ray on tangent and normal; then the cubic is the
    /// line x/N + y/M = 1 and the circle the line y = d. `None` if a centre is not permanent, or if
    /// a moving point is at infinity, in the pole, on the tangent or on the normal.
    pub fn ball(&self) -> Option<BallPoint> {
        let normal = self.normal();
        let (d, n) = (normal.norm(), normal.unit()?);
        let t = -n.perp();
        let row = |k: CurvatureRay| {
            if !k.why.lasts() {
                return None;
            }
            let w = k.moving.at()? - self.pole;
            let r = w.norm();
            if r <= NONE * self.size {
                return None;
            }
            // cos ψ/M + sin ψ/N = sin ψ cos ψ / r.
            let (c, s) = (w.dot(t) / r, w.dot(n) / r);
            Some((Vec2::new(c, s), s * c / r))
        };
        let ((p, f), (q, g)) = (row(self.known[0])?, row(self.known[1])?);
        let det = p.cross(q);
        if det.abs() < FLAT {
            return None;
        }
        let (m, k) = ((f * q.y - g * p.y) / det, (p.x * g - q.x * f) / det);
        // (1/d − 1/M) cos ψ = sin ψ / N.
        let cubic = t * k + n * (1.0 / d - m);
        // In Cardan motion the inflection circle is part of the cubic: all its points run straight,
        // and none of them is Ball's point.
        if cubic.norm() * d < FLAT {
            return None;
        }
        let through = |at: Point, along: Vec2| PlaneLine { through: Some(at), along };
        let corner = |k: CurvatureRay| {
            let moving = k.moving.at()?;
            let square = through(moving, (moving - self.pole).perp());
            let [x, y] =
                [t, n].map(|axis| meet(square, through(self.pole, axis)).and_then(PlanePoint::at));
            Some(x? + (y? - self.pole))
        };
        let corners = [corner(self.known[0])?, corner(self.known[1])?];
        let crossing = meet(
            PlanePoint::At(corners[0]).join(PlanePoint::At(corners[1])),
            through(self.inflection, t),
        )?
        .at()?;
        let on_tangent = self.pole + t * (crossing - self.pole).dot(t);
        let square = (self.inflection - on_tangent).unit()?;
        Some(BallPoint {
            corners,
            crossing,
            on_tangent,
            at: on_tangent + square * (self.pole - on_tangent).dot(square),
        })
    }
}

/// The construction of Ball's point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallPoint {
    /// For each of the two moving points, the corner opposite to the pole of the rectangle that the
    /// perpendicular to its ray cuts off on tangent and normal.
    pub corners: [Point; 2],
    /// The crossing of the line of the corners with the parallel to the tangent through J.
    pub crossing: Point,
    /// The foot of the crossing on the tangent.
    pub on_tangent: Point,
    /// Ball's point: the foot of the perpendicular from P on the line from `on_tangent` to J.
    pub at: Point,
}

/// Returns the point of a ray with a straight path, 1/PJ = 1/PB − 1/PA along the ray; the moving
/// point or the centre may be at infinity.
pub fn proportion(pole: Point, ray: Vec2, moving: PlanePoint, fixed: PlanePoint) -> Option<Point> {
    let along = |end: PlanePoint| end.at().map(|p| (p - pole).dot(ray));
    let way = match (along(moving), along(fixed)) {
        (Some(m), Some(f)) => m * f / (f - m),
        (Some(m), None) => m,
        (None, Some(f)) => -f,
        (None, None) => return None,
    };
    way.is_finite().then(|| pole + ray * way)
}

/// Draws the centre of a point's path with the ruler, from pole and inflection pole.
pub fn traced(
    pole: Point,
    inflection: Point,
    of: PointId,
    at: Point,
    size: f64,
    hand: &Hand,
) -> Option<Traced> {
    let ray = (at - pole).unit().filter(|_| hand.decide(at.distance(pole) > NONE * size))?;
    let normal = inflection - pole;
    let foot = pole + ray * normal.dot(ray);
    let square = PlaneLine { through: Some(pole), along: ray.perp() };
    if hand.decide(normal.norm() <= NONE * size) {
        return Some(Traced {
            of,
            at,
            foot,
            helper: PlanePoint::At(pole),
            centre: PlanePoint::At(pole),
        });
    }
    if hand.decide(at.distance(foot) <= NONE * at.distance(pole).max(size)) {
        return Some(Traced {
            of,
            at,
            foot,
            helper: PlanePoint::Infinity(ray.perp()),
            centre: PlanePoint::Infinity(ray),
        });
    }
    // On the pole tangent, both the foot and the centre are P; if J lies on the ray itself, there
    // is no height over the ray to draw with.
    let proportion = || {
        let (e, j) = ((at - pole).dot(ray), normal.dot(ray));
        pole + ray * (e * j / (j - e))
    };
    let helper = meet(PlanePoint::At(at).join(PlanePoint::At(inflection)), square)?.marked(hand);
    let line = PlaneLine { through: Some(pole), along: ray };
    let flat = hand.decide(
        (normal.cross(ray) / normal.norm()).abs() < FLAT
            || normal.dot(ray).abs() < FLAT * normal.norm(),
    );
    let drawn = meet(helper.join(PlanePoint::Infinity(normal)), line)
        .and_then(PlanePoint::at)
        .filter(|_| !flat);
    Some(Traced {
        of,
        at,
        foot,
        helper,
        centre: PlanePoint::At(hand.mark(drawn.unwrap_or_else(proportion))),
    })
}
