//! How drivers and lengths of a scene are called when a person is told of them.

use super::{DriverKind, Kind, PointId, Scene};

impl Scene {
    /// Name of a driver's position, and what it is: an angle or a length.
    pub fn driver_name(&self, driver: usize) -> (String, Kind) {
        let point = |p: PointId| self.point_name(p);
        match &self.drivers[driver].kind {
            DriverKind::Turn { link, against, .. } if *against == self.ground => (format!("phi_{}", self.link_name(*link)), Kind::Angle),
            DriverKind::Turn { link, against, .. } => (format!("phi_{}/{}", self.link_name(*link), self.link_name(*against)), Kind::Angle),
            DriverKind::Slide { guide, .. } => {
                let g = &self.guides[guide.0];
                (format!("s_{}", g.pin.map_or_else(|| g.slider.map_or("", |s| self.link_name(s)), point)), Kind::Length)
            }
            DriverKind::Cylinder { a, b, .. } => (format!("l_{}{}", point(*a), point(*b)), Kind::Length),
        }
    }

    /// Name and SI unit of a driver's column.
    pub fn driver_column(&self, driver: usize) -> (String, &'static str) {
        let (name, kind) = self.driver_name(driver);
        (name, kind.si())
    }

    /// A length for people, in the unit of the book, else in the scene's own, with four significant digits; what is written in
    /// millimetres, in metres from 10 m on.
    pub fn length_words(&self, value_m: f64) -> String {
        if let Some(unit) = self.book.chosen(Kind::Length) {
            return unit.text(&crate::digits::significant(unit.of(value_m), 4));
        }
        match self.length_unit.name {
            "mm" => crate::digits::metres(value_m),
            name => {
                let value = value_m * self.length_unit.denominator / self.length_unit.numerator;
                format!("{} {name}", crate::digits::significant(value, 4))
            }
        }
    }
}
