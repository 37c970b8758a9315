//! Dynamically equivalent two-mass systems of rods, given as a reading aid.
//!
//! Two masses m₁ and m₂ at distances l₁ and l₂ from the centre of mass, on opposite sides, are
//! equivalent to a rod of mass m and radius of gyration k if m₁ + m₂ = m, m₁ l₁ = m₂ l₂ and l₁ l₂ =
//! k². With one mass in a pin the other is at the centre of percussion; masses in both pins, at
//! distances l₁ and l₃, additionally need the couple m (l₁ l₃ − k²) α. The solver uses mass and
//! moment of inertia directly.
//!
//! # Source
//! R. S. Khurmi, J. K. Gupta, *Theory of Machines*, ch. 15; 孙桓, 陈作模, 葛文杰: 机械原理, ch. 4 (质量代换法).

use super::{DIGITS, ForceWriter};
use hodograph_base::digits::{inked, significant};
use hodograph_base::geom::Point;
use hodograph_base::lang::say;
use hodograph_board::plan::names::{name_label, point_label};
use hodograph_mechanism::force::Cause;
use hodograph_scene::quantity::parties;
use hodograph_scene::{Kind, Mass, PointId};

/// Largest distance of a centre of mass from the line of the pins, as a fraction of the rod, at
/// which it counts as on the line.
const BESIDE: f64 = 1e-9;

impl ForceWriter<'_> {
    /// Returns a sentence for each rod between two moving pins with its centre of mass on the line
    /// between them.
    pub(super) fn two_masses(&self) -> Vec<String> {
        self.scene.loads.masses.iter().filter_map(|mass| self.as_two(mass)).collect()
    }

    fn as_two(&self, mass: &Mass) -> Option<String> {
        let (m, j, s) = (mass.m.as_ref()?.value, mass.j.as_ref()?.value, mass.at?);
        let own = self.scene.links[mass.link.0].points.iter().copied();
        let pins: Vec<PointId> = own.filter(|p| *p != s && parties(self.scene, *p) > 1).collect();
        let [first, second] = pins[..] else { return None };
        let [c, at, b] = [self.place(first)?, self.place(s)?, self.place(second)?];
        let (rod, l1, l3) = (b - c, at.distance(c), at.distance(b));
        let ground = &self.scene.links[self.scene.ground.0].points;
        if pins.iter().any(|p| ground.contains(p)) {
            return None;
        }
        let between = rod.cross(at - c).abs() <= BESIDE * rod.norm2()
            && rod.dot(at - c) > 0.0
            && rod.dot(b - at) > 0.0;
        if !between || m <= 0.0 || j <= 0.0 {
            return None;
        }
        let (l2, l) = (j / m / l1, l1 + l3);
        let kg = |x: f64| format!("{}\\,\\text{{kg}}", inked(&significant(x, DIGITS)));
        let [near, far, centre] = [first, second, s].map(|p| point_label(self.scene.point_name(p)));
        let (link, small) =
            (name_label(self.scene.link_name(mass.link)), self.amount(Kind::Length, l2));
        let inertia = self
            .of
            .loads
            .iter()
            .find(|load| load.link == mass.link && load.cause == Cause::Inertia);
        let alpha = -inertia.map_or(0.0, |load| load.wrench.couple) / j;
        let couple = self.amount(Kind::Moment, (m * l1 * l3 - j) * alpha);
        let [split_near, split_far] = [kg(m * l3 / l), kg(m * l1 / l)];
        let [exact_near, exact_far] = [kg(m * l2 / (l1 + l2)), kg(m * l1 / (l1 + l2))];
        Some(say!(
            self.lang,
            "Link {link} as two masses: ${exact_near}$ at ${near}$ and ${exact_far}$ at $K$, ${centre}K={small}$ beyond ${centre}$; or ${split_near}$ at ${near}$ \
                 and ${split_far}$ at ${far}$ with the couple $m(ab-k^2)\\alpha_{{{link}}}={couple}$, $a$ and $b$ from ${centre}$ to the pins."
        ))
    }

    /// Returns a point of the mechanism (m).
    fn place(&self, p: PointId) -> Option<Point> {
        let mark = self.of.drawn.marks[self.of.places[p.0]?.index()]?;
        Some((mark.to_vec2() * self.of.scales.get(Kind::Length)?).to_point())
    }
}
