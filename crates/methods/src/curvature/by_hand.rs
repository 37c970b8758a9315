//! Tolerances of hand drawing: the construction drawn again and again by a hand whose marks miss.

use super::drawing::{Drawing, Traced};
use super::known::Places;
use super::plane::End;
use super::{Curvature, Drawn, OfLink, on_paper};
use hodograph_base::geom::Point;
use hodograph_board::construct::pencil::{Blunt, Hand, bound};
use hodograph_mechanism::answer::Value;

/// Number of drawings: it gives the 95 % bound to a tenth.
const DRAWINGS: u64 = 200;

/// Bounds within which 95 of 100 drawings by hand fall (m); `None` where more than 5 of 100 fail.
#[derive(Clone, Debug, PartialEq)]
pub struct ByHand {
    /// The pencil error (mm).
    pub pencil_mm: f64,
    /// Distance of the pole.
    pub pole: Option<f64>,
    /// Distance of the inflection pole.
    pub inflection_pole: Option<f64>,
    /// Difference of the diameter of the inflection circle.
    pub diameter: Option<f64>,
    /// Distance of Ball's point.
    pub ball: Option<f64>,
    /// Of each point the difference of the radius of curvature, and the distance of its centre.
    pub points: Vec<[Option<f64>; 2]>,
}
