//! The rays of a link that a drawing starts from, each through a point with a path of known centre
//! of curvature.
//!
//! They follow from topology and places alone: a pin on a crank (its path is a circle), a pin on a
//! guide (its path is straight, the centre is at infinity), a guide that runs through a fixed pin
//! (the envelope is that pin, the moving point is at infinity), and a pin on another link, for
//! which the curvature is drawn first.

use super::drawing::{Drawing, Rays, Rolled, Traced, traced};
use super::plane::{End, Line, meet};
use hodograph_base::geom::{Point, Vec2};
use hodograph_board::construct::pencil::Hand;
use hodograph_mechanism::position::{Configuration, Path};
use hodograph_scene::{GuideId, LinkId, PointId, RollingId, Scene};

/// The reason for which a centre of curvature is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why {
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

impl Why {
    /// Returns the moving point, if it has a name.
    pub fn moving(self) -> Option<PointId> {
        match self {
            Why::Crank(p, ..) | Why::Straight(p, _) | Why::Arc(p, ..) | Why::Borrowed(p, _) => Some(p),
            Why::Through(..) => None,
        }
    }

    /// Returns the centre, if it has a name.
    pub fn fixed(self) -> Option<PointId> {
        match self {
            Why::Crank(_, p, _) | Why::Arc(_, p, _) | Why::Through(p, _) => Some(p),
            Why::Straight(..) | Why::Borrowed(..) => None,
        }
    }

    /// True if the centre is permanent.
    pub fn lasts(self) -> bool {
        !matches!(self, Why::Borrowed(..))
    }
}

/// A moving point and the centre of curvature of its path, on one ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Known {
    /// The moving point.
    pub moving: End,
    /// The centre.
    pub fixed: End,
    /// The reason for which it is known.
    pub why: Why,
}

impl Known {
    /// Returns the ray.
    pub fn ray(&self) -> Line {
        self.moving.join(self.fixed)
    }
}

/// The largest length of a chain of links with mutually dependent centres of curvature.
const DEPTH: usize = 4;
/// The smallest sine of the angle at which two rays determine the pole on paper.
const CROSSING: f64 = 1e-6;

/// The known places.
#[derive(Clone, Copy)]
pub struct Places<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Its pose.
    pub at: &'a Configuration,
    /// The reference link of the motion.
    pub against: LinkId,
    /// The hand that draws.
    pub hand: &'a Hand,
}

impl Places<'_> {
    /// Returns the mark of a point.
    pub fn point(&self, p: PointId) -> Option<Point> {
        self.at.points[p.0].map(|at| self.hand.given(at))
    }

    /// Returns the point at infinity square to a guide, whose line is ruled over the size of the mechanism.
    fn square_to(&self, direction: Vec2) -> End {
        End::Infinity(self.hand.ruler(direction, self.at.extent()).perp())
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
    fn rolled(&self, link: LinkId) -> Option<Rolled> {
        let (r, pair) =
            self.scene.rolling.iter().enumerate().find(|(_, r)| r.other(link) == Some(self.against) && r.contact().is_some())?;
        let pole = self.point(pair.contact()?)?;
        let own = usize::from(pair.links[1] == link);
        let centres = pair.centres().map(|c| c.and_then(|c| self.point(c)));
        let normal = centres.iter().flatten().find_map(|c| (*c - pole).unit())?;
        let end = |k: usize| centres[k].map_or(End::Infinity(normal), End::At);
        let (moving, fixed) = (end(own), end(1 - own));
        let inflection = super::drawing::proportion(pole, normal, moving, fixed)?;
        let inflection = self.hand.mark(inflection);
        Some(Rolled { pair: RollingId(r), pole, moving, fixed, inflection })
    }

    /// Returns all rays of a link; rays from other links are added only if its own do not suffice.
    /// `behind` holds the links that wait for this one.
    fn rays(&self, link: LinkId, behind: &[LinkId]) -> Vec<Known> {
        let mut out = Vec::new();
        for p in super::points(self.scene, link) {
            out.extend(self.crank(link, p));
        }
        for (g, guide) in self.scene.guides.iter().enumerate().filter(|(_, g)| g.rolling.is_none()) {
            out.extend(self.guided(link, GuideId(g), guide));
        }
        out.dedup_by(|a, b| a.why.moving().is_some() && a.why.moving() == b.why.moving());
        if out.len() < 2 && behind.len() < DEPTH {
            let has = |p: PointId, out: &[Known]| out.iter().any(|k| k.why.moving() == Some(p));
            for p in self.scene.links[link.0].points.iter().copied() {
                if !has(p, &out) {
                    out.extend(self.borrowed(link, p, behind));
                }
            }
        }
        out
    }

    /// Returns the ray through a pin that another link carries about a pin of the reference link.
    fn crank(&self, link: LinkId, p: PointId) -> Option<Known> {
        let others = self.scene.carriers(p).filter(|l| *l != link && *l != self.against);
        let pivot = |l: LinkId| Some((l, self.scene.links[l.0].points.iter().copied().find(|q| *q != p && self.holds(self.against, *q))?));
        let (by, about) = others.filter_map(pivot).next()?;
        if self.scene.drivers.iter().filter_map(|d| d.kind.ends()).any(|ends| ends == [p, about] || ends == [about, p]) {
            return None;
        }
        Some(Known { moving: End::At(self.point(p)?), fixed: End::At(self.point(about)?), why: Why::Crank(p, about, by) })
    }

    fn guided(&self, link: LinkId, g: GuideId, guide: &hodograph_scene::Guide) -> Option<Known> {
        let path = self.at.guides[g.0]?;
        // A line of a block that slides on a link about a fixed pin always runs through that pin.
        if let (true, Path::Line { direction, .. }, Some(pivot)) = (guide.slider == Some(link), path, self.hinge(guide.on)) {
            let fixed = End::At(self.point(pivot)?);
            return Some(Known { moving: self.square_to(direction), fixed, why: Why::Through(pivot, g) });
        }
        let pin = guide.pin?;
        let place = self.point(pin)?;
        if guide.on == self.against && self.holds(link, pin) {
            return Some(match path {
                Path::Line { direction, .. } => {
                    Known { moving: End::At(place), fixed: self.square_to(direction), why: Why::Straight(pin, g) }
                }
                Path::Arc { centre, .. } => {
                    let hodograph_scene::GuidePath::Arc { centre: about, .. } = guide.path else { return None };
                    Known { moving: End::At(place), fixed: End::At(self.hand.given(centre)), why: Why::Arc(pin, about, g) }
                }
            });
        }
        let Path::Line { direction, .. } = path else { return None };
        let through = guide.on == link && self.holds(self.against, pin);
        through.then(|| Known { moving: self.square_to(direction), fixed: End::At(place), why: Why::Through(pin, g) })
    }

    /// Returns the ray through a pin of another link, for which the curvature is drawn first.
    fn borrowed(&self, link: LinkId, p: PointId, behind: &[LinkId]) -> Option<Known> {
        let behind: Vec<LinkId> = behind.iter().copied().chain([link]).collect();
        let others = self.scene.carriers(p).filter(|l| *l != self.against && !behind.contains(l));
        let known = |l: LinkId| {
            let centre = self.traced(&self.drawing_behind(l, &behind), p)?.centre;
            Some(Known { moving: End::At(self.point(p)?), fixed: centre, why: Why::Borrowed(p, l) })
        };
        others.filter_map(known).next()
    }

    /// Returns the drawing of a link's curvature from its rays; `behind` holds the links that wait
    /// for this one.
    pub fn drawing_behind(&self, link: LinkId, behind: &[LinkId]) -> Drawing {
        if let Some(p) = self.hinge(link) {
            return Drawing::Hinge(p);
        }
        if let Some(rolled) = self.rolled(link) {
            return Drawing::Rolling(rolled);
        }
        let rays = self.rays(link, behind);
        let mut best: Option<(f64, [Known; 2])> = None;
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
        let Some((sine, pair)) = best else { return Drawing::NoRays };
        if self.hand.decide(sine < CROSSING) {
            let [a, b] = pair.map(|k| k.ray());
            let one = meet(a, b).is_none() || a.distance(pair[1].moving).is_some_and(|d| d < CROSSING * self.at.extent());
            return if one { Drawing::OneLine(pair) } else { Drawing::Parallel(pair) };
        }
        Rays::new(pair, self.at.extent(), self.hand).map_or(Drawing::NoRays, |rays| Drawing::Rays(Box::new(rays)))
    }

    /// Draws the centre of a point's path; `None` if the link's drawing has no inflection pole.
    pub fn traced(&self, drawing: &Drawing, p: PointId) -> Option<Traced> {
        let (at, size) = (self.point(p)?, self.at.extent());
        match drawing {
            Drawing::Rays(r) => r.traced(p, at, self.hand),
            Drawing::Rolling(r) => traced(r.pole, r.inflection, p, at, size, self.hand),
            Drawing::Hinge(_) | Drawing::Parallel(_) | Drawing::OneLine(_) | Drawing::NoRays => None,
        }
    }
}
