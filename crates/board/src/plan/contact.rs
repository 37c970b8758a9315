//! Texts for a contact: the line along which its two points differ, and the magnitude of the
//! difference.

use super::Term;
use super::names::{name_label, point_label};
use super::text::PlanWriter;
use hodograph_scene::{Normal, RollingId, Touch};

impl PlanWriter<'_> {
    /// Returns the normal at a contact: the line of centres, or the normal of a straight track.
    pub(super) fn normal_line(&self, pair: RollingId) -> String {
        let pair = &self.scene.rolling[pair.0];
        let p = |q: hodograph_scene::PointId| point_label(self.scene.point_name(q));
        match pair.touch() {
            Touch::Point(Normal::Centres([a, b])) => {
                format!("\\parallel {}{}", p(a.min(b)), p(a.max(b)))
            }
            Touch::Point(Normal::Square { guide, .. }) => {
                format!("\\perp {}", self.guide_line(guide))
            }
            Touch::Strand { .. } => format!("\\perp {}{}", p(pair.at[0]), p(pair.at[1])),
        }
    }

    /// Returns the sense along the normal of Ω²δ of a point relative to the other: toward the
    /// centre of its own contour; for a hollow or straight contour, away from the centre of the
    /// other.
    pub(super) fn toward_centre(&self, pair: RollingId, t: &Term) -> String {
        let rolling = &self.scene.rolling[pair.0];
        let own = usize::from(self.plan.vertex(t.of).on == Some(rolling.links[1]));
        let hollow = match rolling.touch() {
            Touch::Point(Normal::Centres(_)) => rolling.hollow(),
            Touch::Point(Normal::Square { .. }) => Some(0),
            Touch::Strand { .. } => None,
        };
        let centre = |k: usize| {
            rolling.centres()[k].map(|p| point_label(self.scene.point_name(p))).unwrap_or_default()
        };
        match hollow == Some(own) {
            true => format!("{} \\to {}", centre(1 - own), self.spot(t.of)),
            false => format!("{} \\to {}", self.spot(t.of), centre(own)),
        }
    }

    /// Returns Ω²δ at a contact, with the radii of both links.
    pub(super) fn of_contact(&self, pair: RollingId) -> String {
        let rolling = &self.scene.rolling[pair.0];
        let [a, b] = rolling.links.map(|l| name_label(self.scene.link_name(l)));
        let omega = format!("(\\omega_{{{b}}} - \\omega_{{{a}}})^2");
        match rolling.touch() {
            Touch::Point(Normal::Centres(_)) => {
                let sum = match rolling.hollow() {
                    None => format!("r_{{{a}}} + r_{{{b}}}"),
                    Some(0) => format!("r_{{{a}}} - r_{{{b}}}"),
                    Some(_) => format!("r_{{{b}}} - r_{{{a}}}"),
                };
                format!("{omega} r_{{{a}}} r_{{{b}}}/({sum})")
            }
            Touch::Point(Normal::Square { .. }) => format!("{omega} r_{{{b}}}"),
            // Two wheels in a belt have no such term: the difference across the strand is never
            // known beforehand.
            Touch::Strand { .. } => String::new(),
        }
    }
}
