//! The rays of a link that a drawing starts from, each through a point with a path of known centre
//! of curvature.
//!
//! They follow from topology and places alone: a pin on a crank (its path is a circle), a pin on a
//! guide (its path is straight, the centre is at infinity), a guide that runs through a fixed pin
//! (the envelope is that pin, the moving point is at infinity), and a pin on another link, for
//! which the curvature is drawn first.

use super::drawing::{CurvatureDrawing, Rays, RollingWheel, Traced, traced};
use super::plane::{PlaneLine, PlanePoint, meet};
use hodograph_base::geom::{Point, Vec2};
use hodograph_board::construct::pencil::Hand;
use hodograph_mechanism::position::{Configuration, Path};
use hodograph_scene::{GuideId, LinkId, PointId, RollingId, Scene};

/// The reason for which a centre of curvature is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CurvatureReason {
    /// The first point runs on a circle: this link carries it about the second point.
    Crank(PointId, PointId, LinkId),
    /// The point runs on a straight guide.
    Straight(PointId, GuideId),
    /// The point runs in a circular slot about the second point.
    Arc(PointId, PointId, GuideId),
    /// A straight guide of the link runs through this fixed pin.
    Through(PointId, GuideId),
    /// The point also belongs to another link with a curvature drawn before.
    Borrowed(PointId, LinkId),
}

impl CurvatureReason {
    /// Returns the moving point, if it has a name.
    pub fn moving(self) -> Option<PointId> {
        match self {
            CurvatureReason::Crank(p, ..)
            | CurvatureReason::Straight(p, _)
            | CurvatureReason::Arc(p, ..)
            | CurvatureReason::Borrowed(p, _) => Some(p),
            CurvatureReason::Through(..) => None,
        }
    }

    /// Returns the centre, if it has a name.
    pub fn fixed(self) -> Option<PointId> {
        match self {
            CurvatureReason::Crank(_, p, _)
            | CurvatureReason::Arc(_, p, _)
            | CurvatureReason::Through(p, _) => Some(p),
            CurvatureReason::Straight(..) | CurvatureReason::Borrowed(..) => None,
        }
    }

    /// True if the centre is permanent.
    pub fn lasts(self) -> bool {
        !matches!(self, CurvatureReason::Borrowed(..))
    }
}

/// A moving point and the centre of curvature of its path, on one ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvatureRay {
    /// The moving point.
    pub moving: PlanePoint,
    /// The centre.
    pub fixed: PlanePoint,
    /// The reason for which it is known.
    pub why: CurvatureReason,
}

impl CurvatureRay {
    /// Returns the ray.
    pub fn ray(&self) -> PlaneLine {
        self.moving.join(self.fixed)
    }
}

/// The largest length of a chain of links with mutually dependent centres of curvature.
const DEPTH: usize = 4;
/// The smallest sine of the angle at which two rays determine the pole on paper.
const CROSSING: f64 = 1e-6;

/// The known places.
#[derive(Clone, Copy)]
pub struct CurvaturePlaces<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Its pose.
    pub at: &'a Configuration,
    /// The reference link of the motion.
    pub against: LinkId,
    /// The hand that draws.
    pub hand: &'a Hand,
}

impl CurvaturePlaces<'_> {
    /// Returns the mark of a point.
    pub fn point(&self, p: PointId) -> Option<Point> {
        self.at.points[p.0].map(|at| self.hand.given(at))
    }

    /// Returns the point at infinity square to a guide, whose line is ruled over the size of the
    /// mechanism.
    fn square_to(&self, direction: Vec2) -> PlanePoint {
        PlanePoint::Infinity(self.hand.ruler(direction, self.at.extent()).perp())
    }

    fn holds(&self, link: LinkId, p: PointId) -> bool {
        self.scene.links[link.0].points.contains(&p)
    }

    /// Returns the pin that a link shares with the reference link.
    pub fn hinge(&self, link: LinkId) -> Option<PointId> {
        self.scene.links[link.0].points.iter().copied().find(|p| self.holds(self.against, *p))
    }

    /// Returns the drawing of a link that rolls on the reference link: the contact is the pole, and
    /// the centres lie on its normal.
    fn rolled(&self, link: LinkId) -> Option<RollingWheel> {
        let (r, pair) = self
            .scene
            .rolling
            .iter()
            .enumerate()
            .find(|(_, r)| r.other(link) == Some(self.against) && r.contact().is_some())?;
        let pole = self.point(pair.contact()?)?;
        let own = usize::from(pair.links[1] == link);
        let centres = pair.centres().map(|c| c.and_then(|c| self.point(c)));
        let normal = centres.iter().flatten().find_map(|c| (*c - pole).unit())?;
        let end = |k: usize| centres[k].map_or(PlanePoint::Infinity(normal), PlanePoint::At);
        let (moving, fixed) = (end(own), end(1 - own));
        let inflection = super::drawing::proportion(pole, normal, moving, fixed)?;
        let inflection = self.hand.mark(inflection);
        Some(RollingWheel { pair: RollingId(r), pole, moving, fixed, inflection })
    }

    /// Returns all rays of a link; rays from other links are added only if its own do not suffice.
    /// `behind` holds the links that wait for this one.
    fn rays(&self, link: LinkId, behind: &[LinkId]) -> Vec<CurvatureRay> {
        let mut out = Vec::new();
        for p in super::points(self.scene, link) {
            out.extend(self.crank(link, p));
        }
        for (g, guide) in self.scene.guides.iter().enumerate().filter(|(_, g)| g.rolling.is_none())
        {
            out.extend(self.guided(link, GuideId(g), guide));
        }
        out.dedup_by(|a, b| a.why.moving().is_some() && a.why.moving() == b.why.moving());
        if out.len() < 2 && behind.len() < DEPTH {
            let has =
                |p: PointId, out: &[CurvatureRay]| out.iter().any(|k| k.why.moving() == Some(p));
            for p in self.scene.links[link.0].points.iter().copied() {
                if !has(p, &out) {
                    out.extend(self.borrowed(link, p, behind));
                }
            }
        }
        out
    }

    /// Returns the ray through a pin that another link carries about a pin of the reference link.
    fn crank(&self, link: LinkId, p: PointId) -> Option<CurvatureRay> {
        let others = self.scene.carriers(p).filter(|l| *l != link && *l != self.against);
        let pivot = |l: LinkId| {
            Some((
                l,
                self.scene.links[l.0]
                    .points
                    .iter()
                    .copied()
                    .find(|q| *q != p && self.holds(self.against, *q))?,
            ))
        };
        let (by, about) = others.filter_map(pivot).next()?;
        if self
            .scene
            .drivers
            .iter()
            .filter_map(|d| d.kind.ends())
            .any(|ends| ends == [p, about] || ends == [about, p])
        {
            return None;
        }
        Some(CurvatureRay {
            moving: PlanePoint::At(self.point(p)?),
            fixed: PlanePoint::At(self.point(about)?),
            why: CurvatureReason::Crank(p, about, by),
        })
    }

    fn guided(
        &self,
        link: LinkId,
        g: GuideId,
        guide: &hodograph_scene::Guide,
    ) -> Option<CurvatureRay> {
        let path = self.at.guides[g.0]?;
        // A line of a block that slides on a link about a fixed pin always runs through that pin.
        if let (true, Path::Line { direction, .. }, Some(pivot)) =
            (guide.slider == Some(link), path, self.hinge(guide.on))
        {
            let fixed = PlanePoint::At(self.point(pivot)?);
            return Some(CurvatureRay {
                moving: self.square_to(direction),
                fixed,
                why: CurvatureReason::Through(pivot, g),
            });
        }
        let pin = guide.pin?;
        let place = self.point(pin)?;
        if guide.on == self.against && self.holds(link, pin) {
            return Some(match path {
                Path::Line { direction, .. } => CurvatureRay {
                    moving: PlanePoint::At(place),
                    fixed: self.square_to(direction),
                    why: CurvatureReason::Straight(pin, g),
                },
                Path::Arc { centre, .. } => {
                    let hodograph_scene::GuidePath::Arc { centre: about, .. } = guide.path else {
                        return None;
                    };
                    CurvatureRay {
                        moving: PlanePoint::At(place),
                        fixed: PlanePoint::At(self.hand.given(centre)),
                        why: CurvatureReason::Arc(pin, about, g),
                    }
                }
            });
        }
        let Path::Line { direction, .. } = path else { return None };
        let through = guide.on == link && self.holds(self.against, pin);
        through.then(|| CurvatureRay {
            moving: self.square_to(direction),
            fixed: PlanePoint::At(place),
            why: CurvatureReason::Through(pin, g),
        })
    }

    /// Returns the ray through a pin of another link, for which the curvature is drawn first.
    fn borrowed(&self, link: LinkId, p: PointId, behind: &[LinkId]) -> Option<CurvatureRay> {
        let behind: Vec<LinkId> = behind.iter().copied().chain([link]).collect();
        let others = self.scene.carriers(p).filter(|l| *l != self.against && !behind.contains(l));
        let known = |l: LinkId| {
            let centre = self.traced(&self.drawing_behind(l, &behind), p)?.centre;
            Some(CurvatureRay {
                moving: PlanePoint::At(self.point(p)?),
                fixed: centre,
                why: CurvatureReason::Borrowed(p, l),
            })
        };
        others.filter_map(known).next()
    }

    /// Returns the drawing of a link's curvature from its rays; `behind` holds the links that wait
    /// for this one.
    pub fn drawing_behind(&self, link: LinkId, behind: &[LinkId]) -> CurvatureDrawing {
        if let Some(p) = self.hinge(link) {
            return CurvatureDrawing::Hinge(p);
        }
        if let Some(rolled) = self.rolled(link) {
            return CurvatureDrawing::Rolling(rolled);
        }
        let rays = self.rays(link, behind);
        let mut best: Option<(f64, [CurvatureRay; 2])> = None;
        for (i, a) in rays.iter().enumerate() {
            for b in &rays[i + 1..] {
                let sine = a.ray().sine(b.ray()).abs();
                // Among rays that cross at a sufficient angle, the first two in the order of the
                // scene are taken.
                if self.hand.decide(best.as_ref().is_none_or(|(s, _)| *s < 0.2 && sine > 2.0 * s)) {
                    best = Some((sine, [*a, *b]));
                }
            }
        }
        let Some((sine, pair)) = best else { return CurvatureDrawing::NoRays };
        if self.hand.decide(sine < CROSSING) {
            let [a, b] = pair.map(|k| k.ray());
            let one = meet(a, b).is_none()
                || a.distance(pair[1].moving).is_some_and(|d| d < CROSSING * self.at.extent());
            return if one {
                CurvatureDrawing::OneLine(pair)
            } else {
                CurvatureDrawing::Parallel(pair)
            };
        }
        Rays::new(pair, self.at.extent(), self.hand)
            .map_or(CurvatureDrawing::NoRays, |rays| CurvatureDrawing::Rays(Box::new(rays)))
    }

    /// Draws the centre of a point's path; `None` if the link's drawing has no inflection pole.
    pub fn traced(&self, drawing: &CurvatureDrawing, p: PointId) -> Option<Traced> {
        let (at, size) = (self.point(p)?, self.at.extent());
        match drawing {
            CurvatureDrawing::Rays(r) => r.traced(p, at, self.hand),
            CurvatureDrawing::Rolling(r) => traced(r.pole, r.inflection, p, at, size, self.hand),
            CurvatureDrawing::Hinge(_)
            | CurvatureDrawing::Parallel(_)
            | CurvatureDrawing::OneLine(_)
            | CurvatureDrawing::NoRays => None,
        }
    }
}
