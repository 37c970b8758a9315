//! Positions of a pin held by its legs: on two loci, on a known link, or at a given point of a
//! guide.

use super::Path;
use super::assemble::Assembly;
use super::kernel::{self, Locus, Miss};
use crate::mechanism::{CoreLoci, Hold, Leg, Strut};
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_scene::{GuideId, LinkId, PointId};

impl<N: Real> Assembly<'_, N> {
    /// Returns the possible positions of a pin on its two loci.
    pub(super) fn places_of_pin(
        &self,
        pin: PointId,
        legs: &[Leg],
    ) -> Result<Vec<Point<N>>, Diagnostic> {
        let entry = CoreLoci::of(legs);
        match (entry.carrier, &entry.holds[..]) {
            (Some(link), _) => {
                Ok(vec![self.world(link, pin).ok_or_else(|| self.not_placed(pin, link))?])
            }
            (None, [Hold::Guide { guide, driver: Some(driver), .. }]) => {
                Ok(vec![self.driven_place(*guide, *driver)?])
            }
            (None, [first, second]) => {
                let (a, b) = (self.locus_of_pin(first)?, self.locus_of_pin(second)?);
                kernel::meet(a, b).map_err(|miss| self.cannot_meet(pin, first, second, miss))
            }
            _ => unreachable!("a pin has one leg that takes both freedoms, or two legs"),
        }
    }

    pub(super) fn not_placed(&self, pin: PointId, link: LinkId) -> Diagnostic {
        Diagnostic::error(
            "not-placed",
            both!(
                "{} is not placed on link {}",
                self.scene.point_name(pin),
                self.scene.link_name(link)
            ),
        )
        .at(self.scene.points[pin.0].span)
        .help(both!("give a length, or its coordinates in \"points\""))
    }

    fn locus_of_pin(&self, hold: &Hold) -> Result<Locus<N>, Diagnostic> {
        Ok(match *hold {
            Hold::Distance { near, far, strut } => Locus::Circle {
                centre: self.known(far),
                radius: self.strut_length(near, far, strut)?,
            },
            Hold::Guide { guide, .. } => match self.need_guide(guide)? {
                Path::Line { through, direction } => Locus::Line { through, direction },
                Path::Arc { centre, radius } => Locus::Circle { centre, radius },
            },
            Hold::Slot { .. } | Hold::Glide { .. } | Hold::Rolls { .. } => {
                unreachable!("slots, gliding links and contacts hold no pin")
            }
        })
    }

    /// Returns the distance at which a strut holds a pin from a known pin.
    pub(super) fn strut_length(
        &self,
        near: PointId,
        far: PointId,
        strut: Strut,
    ) -> Result<N, Diagnostic> {
        match strut {
            Strut::Bar(link) => {
                let s = &self.shapes[link.0];
                let (Some(a), Some(b)) = (s.local(far), s.local(near)) else {
                    return Err(self.not_placed(near, link));
                };
                Ok(a.distance(b))
            }
            Strut::Cylinder(driver) => self.cylinder_length(driver),
            Strut::Ram { link, guide, driver } => {
                let runner = self.runner_in_link(link, guide, driver)?;
                let d = self.shapes[link.0].local(far).expect("a link's points have local places");
                Ok(d.distance(runner))
            }
        }
    }

    fn cylinder_length(&self, driver: usize) -> Result<N, Diagnostic> {
        let lacking =
            || self.driver_without_value(driver, "length", both!("how long the cylinder is"));
        self.driven_length(driver).ok_or_else(lacking)
    }

    /// Returns the coordinate at which a driver holds a slider along its guide.
    pub(super) fn way_along(&self, driver: usize) -> Result<N, Diagnostic> {
        let lacking = || {
            self.driver_without_value(
                driver,
                "position",
                both!("how far the slider is along its guide"),
            )
        };
        self.driven_length(driver).ok_or_else(lacking)
    }

    /// Returns the length in the scene at which a driver holds a coordinate or a distance.
    pub(super) fn driven_length(&self, driver: usize) -> Option<N> {
        let driver = &self.scene.drivers[driver];
        Some(self.inputs.driven(driver, driver.kind.length()?))
    }

    /// Returns the position in the plane at which a driver holds a slider on its guide.
    pub(super) fn driven_place(
        &self,
        guide: GuideId,
        driver: usize,
    ) -> Result<Point<N>, Diagnostic> {
        let (path, s) = (self.need_guide(guide)?, self.way_along(driver)?);
        Ok(match (path, self.poses[self.scene.guides[guide.0].on.0]) {
            // The coordinate on an arc is measured from the direction of the link that carries it.
            (Path::Arc { centre, radius }, Some(pose)) => {
                centre + Vec2::from_angle(s / radius).rotate_by(pose.axis) * radius
            }
            (path, _) => path.point_at(s),
        })
    }

    fn cannot_meet(&self, pin: PointId, a: &Hold, b: &Hold, miss: Miss) -> Diagnostic {
        let (wa, wb) = (self.hold_words(pin, a), self.hold_words(pin, b));
        let p = self.scene.point_name(pin);
        let how = match miss {
            Miss::TooFar(x) => {
                both!("they end {} apart", self.scene.length_words(x))
            }
            Miss::TooNear(x) => {
                both!("one is {} too long for the other", self.scene.length_words(x))
            }
            Miss::Parallel(0.0) => {
                both!("they coincide, so that the joint's place is undetermined")
            }
            Miss::Parallel(x) => both!("they run parallel, {} apart", self.scene.length_words(x)),
        };
        let d = Diagnostic::error(
            "cannot-assemble",
            both!("{} and {} cannot meet at {p}: {}", wa, wb, how),
        )
        .at(self.scene.points[pin.0].span);
        d.help(both!("change a length, the driver's position, or a pivot"))
    }

    fn hold_words(&self, pin: PointId, hold: &Hold) -> Both {
        let (p, name) = (self.scene.point_name(pin), |l: LinkId| self.scene.link_name(l));
        match *hold {
            Hold::Distance { near, far, strut } => {
                let length = self.strut_length(near, far, strut).map_or(0.0, Real::approx);
                let (far, length) = (self.scene.point_name(far), self.scene.length_words(length));
                match strut {
                    Strut::Bar(link) => both!("link {} ({far}{p} = {length})", name(link)),
                    Strut::Cylinder(_) => {
                        both!("the cylinder {far}{p} ({length})")
                    }
                    Strut::Ram { link, .. } => both!("before a sign" => "link {}", name(link)),
                }
            }
            Hold::Guide { guide, .. } => self.scene.guide_words(guide),
            Hold::Slot { .. } | Hold::Glide { .. } | Hold::Rolls { .. } => {
                both!("the joint at {p}")
            }
        }
    }
}
