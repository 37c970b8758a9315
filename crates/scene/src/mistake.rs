//! The known mistakes in solutions by relative motion, by name.
//!
//! This module defines the names only. The module `attempts` decides where a scene allows a mistake
//! and how the mistake changes the equations, with one file for each.

use hodograph_base::lang::{Lang, each};

/// A known mistake.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Mistake {
    /// Momentary point of contact of two profiles taken as a permanent coincident point.
    ContactPoint,
    /// Coriolis acceleration at a turning guide omitted.
    NoCoriolis,
    /// Coriolis acceleration with the angular velocity of a link other than the one that carries
    /// the guide.
    CoriolisWrongOmega,
    /// Zero acceleration relative to the track assumed for the contact point of a rolling wheel,
    /// because its velocity is zero.
    RollingPointAZero,
    /// Image constructed from points of two links.
    ImageAcrossLinks,
    /// Normal acceleration of a link omitted.
    NoNormal,
    /// Accelerations from the instantaneous centre of velocity, as if it had no acceleration.
    AccelerationByCentre,
}

impl Mistake {
    /// All mistakes, in the order of output.
    pub const ALL: [Mistake; 7] = [
        Mistake::ContactPoint,
        Mistake::NoCoriolis,
        Mistake::CoriolisWrongOmega,
        Mistake::RollingPointAZero,
        Mistake::ImageAcrossLinks,
        Mistake::NoNormal,
        Mistake::AccelerationByCentre,
    ];

    /// Returns its name in a scene.
    pub fn name(self) -> &'static str {
        match self {
            Mistake::ContactPoint => "contact-point",
            Mistake::NoCoriolis => "no-coriolis",
            Mistake::CoriolisWrongOmega => "coriolis-wrong-omega",
            Mistake::RollingPointAZero => "rolling-point-a-zero",
            Mistake::ImageAcrossLinks => "image-across-links",
            Mistake::NoNormal => "no-normal",
            Mistake::AccelerationByCentre => "acceleration-by-centre",
        }
    }

    /// Returns its name in headings.
    pub fn title(self, lang: Lang) -> &'static str {
        lang.pick(match self {
            Mistake::ContactPoint => {
                each!("Momentary contact point taken as a permanent coincident point")
            }
            Mistake::NoCoriolis => each!("Coriolis acceleration left out"),
            Mistake::CoriolisWrongOmega => {
                each!("Coriolis acceleration with the wrong angular velocity")
            }
            Mistake::RollingPointAZero => {
                each!("Contact point of a rolling wheel taken without acceleration")
            }
            Mistake::ImageAcrossLinks => each!("Image across two links"),
            Mistake::NoNormal => each!("Normal acceleration left out"),
            Mistake::AccelerationByCentre => {
                each!("Acceleration by the instantaneous centre of velocity")
            }
        })
    }
}
