//! Places of a pin that its legs hold: on two loci, on a known link, or at a given place of a guide.

use super::Path;
use super::assemble::Assembly;
use super::kernel::{self, Locus, Miss};
use crate::diag::{Both, Diagnostic, both};
use crate::geom::Point;
use crate::mechanism::Leg;
use crate::number::Real;
use crate::scene::{DriverKind, LinkId, PointId};

impl<N: Real> Assembly<'_, N> {
    /// The possible places of a pin on its two loci.
    pub(super) fn places_of_pin(&self, pin: PointId, legs: &[Leg]) -> Result<Vec<Point<N>>, Diagnostic> {
        match legs {
            [Leg::Carried { link }] => Ok(vec![self.world(*link, pin).ok_or_else(|| self.not_placed(pin, *link))?]),
            [Leg::Driven { guide, driver, .. }] => {
                let path = self.need_guide(*guide)?;
                let DriverKind::Slide { position: Some(s), .. } = &self.scene.drivers[*driver].kind else {
                    return Err(self.driver_without_value(
                        *driver,
                        "position",
                        both!("how far the slider is along its guide", "滑块在导路上的位置"),
                    ));
                };
                Ok(vec![path.point_at(self.inputs.driven(&self.scene.drivers[*driver], s))])
            }
            [first, second] => {
                let (a, b) = (self.locus_of_pin(pin, first)?, self.locus_of_pin(pin, second)?);
                kernel::meet(a, b).map_err(|miss| self.cannot_meet(pin, first, second, miss))
            }
            _ => unreachable!("a pin has one leg that takes both freedoms, or two legs"),
        }
    }

    pub(super) fn not_placed(&self, pin: PointId, link: LinkId) -> Diagnostic {
        Diagnostic::error(
            "not-placed",
            both!("{} is not placed on link {}", "{} 在构件 {} 上的位置未定", self.scene.point_name(pin), self.scene.link_name(link)),
        )
        .at(self.scene.points[pin.0].span)
        .help(both!("give a length, or its coordinates in \"points\"", "请给出长度，或在 \"points\" 中给出其坐标"))
    }

    pub(super) fn locus_of_pin(&self, pin: PointId, leg: &Leg) -> Result<Locus<N>, Diagnostic> {
        Ok(match *leg {
            Leg::Bar { link, far, .. } => {
                let s = &self.shapes[link.0];
                let (a, b) = (s.local(far), s.local(pin));
                let (Some(a), Some(b)) = (a, b) else { return Err(self.not_placed(pin, link)) };
                Locus::Circle { centre: self.known(far), radius: a.distance(b) }
            }
            Leg::OnGuide { guide, .. } => match self.need_guide(guide)? {
                Path::Line { through, direction } => Locus::Line { through, direction },
                Path::Arc { centre, radius } => Locus::Circle { centre, radius },
            },
            Leg::Cylinder { driver, far, .. } => Locus::Circle { centre: self.known(far), radius: self.cylinder_length(driver)? },
            Leg::Ram { link, far, guide, driver, .. } => {
                let runner = self.runner_in_link(link, guide, driver)?;
                let d = self.shapes[link.0].local(far).expect("a link's points have local places");
                Locus::Circle { centre: self.known(far), radius: d.distance(runner) }
            }
            _ => unreachable!("only these legs hold a pin"),
        })
    }

    pub(super) fn cylinder_length(&self, driver: usize) -> Result<N, Diagnostic> {
        match &self.scene.drivers[driver].kind {
            DriverKind::Cylinder { length: Some(l), .. } => Ok(self.inputs.driven(&self.scene.drivers[driver], l)),
            _ => Err(self.driver_without_value(driver, "length", both!("how long the cylinder is", "液压缸的长度"))),
        }
    }

    pub(super) fn cannot_meet(&self, pin: PointId, a: &Leg, b: &Leg, miss: Miss) -> Diagnostic {
        let (wa, wb) = (self.leg_words(pin, a), self.leg_words(pin, b));
        let p = self.scene.point_name(pin);
        let how = match miss {
            Miss::TooFar(x) => both!("they end {} apart", "两端相距 {}", self.scene.length_words(x)),
            Miss::TooNear(x) => both!("one is {} too long for the other", "其一比另一长出 {}", self.scene.length_words(x)),
            Miss::Parallel(0.0) => both!("they coincide, so that the joint's place is undetermined", "两者重合，铰链位置不定"),
            Miss::Parallel(x) => both!("they run parallel, {} apart", "两者平行，相距 {}", self.scene.length_words(x)),
        };
        let d = Diagnostic::error("cannot-assemble", both!("{} and {} cannot meet at {p}: {}", "{}与{}不能在 {p} 相交：{}", wa, wb, how))
            .at(self.scene.points[pin.0].span);
        d.help(both!("change a length, the driver's position, or a pivot", "请改变某一长度、原动件的位置或固定铰链"))
    }

    pub(super) fn leg_words(&self, pin: PointId, leg: &Leg) -> Both {
        let p = self.scene.point_name(pin);
        match *leg {
            Leg::Bar { link, far, .. } => {
                let s = &self.shapes[link.0];
                let l = s.local(far).zip(s.local(pin)).map_or(0.0, |(a, b)| a.distance(b).approx());
                both!(
                    "link {} ({}{p} = {})",
                    "构件 {}（{}{p} = {}）",
                    self.scene.link_name(link),
                    self.scene.point_name(far),
                    self.scene.length_words(l)
                )
            }
            Leg::OnGuide { guide, .. } => {
                both!("the guide on link {}", "构件 {} 上的导路", self.scene.link_name(self.scene.guides[guide.0].on))
            }
            Leg::Cylinder { driver, far, .. } => {
                let l = self.cylinder_length(driver).map_or(0.0, Real::approx);
                both!("the cylinder {}{p} ({})", "液压缸 {}{p}（{}）", self.scene.point_name(far), self.scene.length_words(l))
            }
            Leg::Ram { link, .. } => both!("link {}", "构件 {} ", self.scene.link_name(link)),
            _ => both!("the joint at {p}", "{p} 处的运动副"),
        }
    }
}
