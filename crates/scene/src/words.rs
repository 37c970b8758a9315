//! Names of drivers, guides and lengths of a scene in messages.

use super::model::GuideId;
use super::{DriverKind, Kind, LinkId, PointId, Scene};
use hodograph_base::diag::{Both, both};

impl Scene {
    /// Returns the links in the order of their numbers; if not all are numbered, in the order of
    /// the scene.
    pub fn links_in_order(&self) -> Vec<LinkId> {
        let mut links: Vec<LinkId> = (0..self.links.len()).map(LinkId).collect();
        let numbers: Option<Vec<u64>> = self.links.iter().map(|l| l.name.parse().ok()).collect();
        if let Some(numbers) = numbers {
            links.sort_by_key(|l| numbers[l.0]);
        }
        links
    }

    /// Returns the contact that a guide replaces, in the words of the file; `None` for guides of
    /// the file.
    pub fn contact_words(&self, g: GuideId) -> Option<Both> {
        if let Some(cam) = self.cams.iter().find(|c| c.contact == Some(g)) {
            let [cam, follower] = [cam.cam, cam.follower].map(|l| self.link_name(l));
            return Some(both!("the contact of cam {cam} and follower {follower}"));
        }
        let rolling = &self.rolling[self.guides[g.0].rolling?.0];
        let [a, b] = rolling.links.map(|l| self.link_name(l));
        Some(both!("the contact of links {a} and {b}"))
    }

    /// Returns the name of a guide, or of the contact that it replaces: `the guide on link 3`.
    pub fn guide_words(&self, g: GuideId) -> Both {
        let on = self.link_name(self.guides[g.0].on);
        self.contact_words(g).unwrap_or_else(|| both!("the guide on link {on}"))
    }

    /// Returns the name of a driver's position, and its kind: an angle or a length.
    pub fn driver_name(&self, driver: usize) -> (String, Kind) {
        let point = |p: PointId| self.point_name(p);
        match &self.drivers[driver].kind {
            DriverKind::Turn { link, against, .. } if *against == self.ground => {
                (format!("phi_{}", self.link_name(*link)), Kind::Angle)
            }
            DriverKind::Turn { link, against, .. } => {
                (format!("phi_{}/{}", self.link_name(*link), self.link_name(*against)), Kind::Angle)
            }
            DriverKind::Slide { guide, .. } => {
                let g = &self.guides[guide.0];
                (
                    format!(
                        "s_{}",
                        g.pin.map_or_else(|| g.slider.map_or("", |s| self.link_name(s)), point)
                    ),
                    Kind::Length,
                )
            }
            DriverKind::Cylinder { a, b, .. } => {
                (format!("l_{}{}", point(*a), point(*b)), Kind::Length)
            }
        }
    }

    /// Returns name and SI unit of a driver's column.
    pub fn driver_column(&self, driver: usize) -> (String, &'static str) {
        let (name, kind) = self.driver_name(driver);
        (name, kind.si())
    }

    /// Returns a length for messages with four significant digits, in the unit of the book, else in
    /// that of the scene; if that is millimetres, lengths from 10 m on are in metres.
    pub fn length_words(&self, value_m: f64) -> String {
        if let Some(unit) = self.book.chosen(Kind::Length) {
            return unit.text(&hodograph_base::digits::significant(unit.of(value_m), 4));
        }
        match self.length_unit.name {
            "mm" => hodograph_base::digits::metres(value_m),
            name => {
                let value = value_m * self.length_unit.denominator / self.length_unit.numerator;
                format!("{} {name}", hodograph_base::digits::significant(value, 4))
            }
        }
    }
}
