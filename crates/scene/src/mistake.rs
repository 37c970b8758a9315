//! The known mistakes of solutions by relative motion, by name.
//!
//! Decided here: only what they are called. Where a scene lets one be made, and what it does to the equations, is decided in
//! `attempts`, a file for each.

use hodograph_base::lang::Lang;

/// A known mistake.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Mistake {
    /// The momentary point of contact of two profiles taken for a lasting coincident point.
    ContactPoint,
    /// The Coriolis acceleration at a turning guide left out.
    NoCoriolis,
    /// The Coriolis acceleration with the angular velocity of a link other than that which carries the guide.
    CoriolisWrongOmega,
    /// The point of a rolling wheel that touches taken to have no acceleration against its track, because it has no velocity.
    RollingPointAZero,
    /// An image built on points of two links.
    ImageAcrossLinks,
    /// The normal acceleration of a link left out.
    NoNormal,
    /// Accelerations from the instantaneous centre of velocity, as if it had no acceleration.
    AccelerationByCentre,
}

impl Mistake {
    /// All of them, in the order in which they are told.
    pub const ALL: [Mistake; 7] = [
        Mistake::ContactPoint,
        Mistake::NoCoriolis,
        Mistake::CoriolisWrongOmega,
        Mistake::RollingPointAZero,
        Mistake::ImageAcrossLinks,
        Mistake::NoNormal,
        Mistake::AccelerationByCentre,
    ];

    /// How a scene writes it.
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

    /// What it is called in headings.
    pub fn title(self, lang: Lang) -> &'static str {
        let [en, zh] = match self {
            Mistake::ContactPoint => ["Momentary contact point taken as a permanent coincident point", "把瞬时接触点当作始终不变的重合点"],
            Mistake::NoCoriolis => ["Coriolis acceleration left out", "漏掉科氏加速度"],
            Mistake::CoriolisWrongOmega => ["Coriolis acceleration with the wrong angular velocity", "科氏加速度用错角速度"],
            Mistake::RollingPointAZero => ["Contact point of a rolling wheel taken without acceleration", "认为纯滚动接触点加速度为零"],
            Mistake::ImageAcrossLinks => ["Image across two links", "跨构件使用影像"],
            Mistake::NoNormal => ["Normal acceleration left out", "漏掉法向加速度"],
            Mistake::AccelerationByCentre => ["Acceleration by the instantaneous centre of velocity", "用速度瞬心求加速度"],
        };
        match lang {
            Lang::En => en,
            Lang::Zh => zh,
        }
    }
}
