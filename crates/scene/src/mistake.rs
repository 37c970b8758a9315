//! The known mistakes in solutions by relative motion, by name.
//!
//! This module defines the names only. The module `attempts` decides where a scene allows a mistake
//! and how the mistake changes the equations, with one file for each.

use hodograph_base::lang::Lang;

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
        let [en, zh] = match self {
            Mistake::ContactPoint => [
                "Momentary contact point taken as a permanent coincident point",
                "把瞬时接触点当作始终不变的重合点",
            ],
            Mistake::NoCoriolis => ["Coriolis acceleration left out", "漏掉科氏加速度"],
            Mistake::CoriolisWrongOmega => {
                ["Coriolis acceleration with the wrong angular velocity", "科氏加速度用错角速度"]
            }
            Mistake::RollingPointAZero => [
                "Contact point of a rolling wheel taken without acceleration",
                "认为纯滚动接触点加速度为零",
            ],
            Mistake::ImageAcrossLinks => ["Image across two links", "跨构件使用影像"],
            Mistake::NoNormal => ["Normal acceleration left out", "漏掉法向加速度"],
            Mistake::AccelerationByCentre => {
                ["Acceleration by the instantaneous centre of velocity", "用速度瞬心求加速度"]
            }
        };
        match lang {
            Lang::En => en,
            Lang::Zh => zh,
        }
    }
}
