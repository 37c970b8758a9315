//! The derivation of the theorems of composite motion, in words and numbers.

use super::{CompositeWords, symbol};
use hodograph_base::digits::shortest;
use hodograph_base::geom::Vec2;
use hodograph_base::lang::{say, tr};
use hodograph_board::plan::names::point_label;
use hodograph_methods::composite::derivation::TwoInstants;
use hodograph_paper::paper::phrase::Phrase;
use hodograph_scene::quantity::composite::CompositePart;
use hodograph_scene::{DiagramKind, Kind};

/// The lines beside the drawings.
pub struct DerivationWords {
    /// On the displacements.
    pub displacements: Vec<Phrase>,
    /// On the changes of the velocities; empty without accelerations.
    pub velocities: Vec<Phrase>,
}

impl CompositeWords<'_> {
    /// Returns the letter of the point of the frame that was at the moving point.
    pub fn carried_point(&self, two: &TwoInstants) -> String {
        let own = point_label(self.scene.point_name(two.solution.choice.of.point));
        let small: String = own.chars().flat_map(char::to_lowercase).collect();
        format!("{small}_{{1}}")
    }

    /// Returns the lines of the derivation: the sums, each with its quotients by Δt and the limits.
    pub fn derivation(&self, two: &TwoInstants) -> DerivationWords {
        let (lang, dt) = (self.lang, two.dt);
        let [from, carried, to] = two.places;
        let [absolute, transport, relative] = two.solution.velocity;
        let own = point_label(self.scene.point_name(two.solution.choice.of.point));
        let small = self.carried_point(two);
        let time =
            self.scene.book.label(Kind::Time, &shortest(self.scene.book.value(Kind::Time, dt)));
        let row = |over: &str, change: Vec2, limit: &str, value: Vec2, kind: Kind| {
            let quotient = self.amount(kind, change.norm() / dt);
            let value = self.amount(kind, value.norm());
            Phrase::new(&format!(
                "$|{over}|/\\Delta t = {quotient}${}$|{limit}| = {value}$",
                tr!(lang, "; as $\\Delta t \\to 0$: ")
            ))
        };
        let v = Kind::Velocity;
        let mut displacements = vec![
            Phrase::new(&say!(
                lang,
                "In $\\Delta t = {time}$ the point goes from ${own}$ to ${own}_{{1}}$, the frame's point from ${own}$ to ${small}$:"
            )),
            Phrase::new("$\\Delta r_{a} = \\Delta r_{e} + \\Delta r_{r}$"),
            row("\\Delta r_{a}", to - from, "v_{a}", absolute, v),
            row("\\Delta r_{e}", carried - from, "v_{e}", transport, v),
            row("\\Delta r_{r}", to - carried, "v_{r}", relative, v),
        ];
        let limit = tr!(lang, "Divided by $\\Delta t$, in the limit: ");
        displacements.push(Phrase::new(&format!("{limit}$v_{{a}} = v_{{e}} + v_{{r}}$")));
        let acceleration = |parts: &[CompositePart]| {
            two.solution
                .acceleration
                .iter()
                .filter(|(part, _)| part.is_some_and(|p| parts.contains(&p)))
                .map(|(_, v)| *v)
                .fold(Vec2::ZERO, |sum, v| sum + v)
        };
        let mut velocities = Vec::new();
        if !two.solution.acceleration.is_empty() {
            let a = Kind::Acceleration;
            let later = two.velocities;
            let coriolis = acceleration(&[CompositePart::Coriolis]);
            let half = coriolis * 0.5;
            let of_frame =
                acceleration(&[CompositePart::TransportNormal, CompositePart::TransportTangential]);
            let of_point = acceleration(&[
                CompositePart::Relative,
                CompositePart::RelativeNormal,
                CompositePart::RelativeTangential,
            ]);
            velocities.push(Phrase::new(&say!(lang, "$v_{{e1}}$: velocity of ${small}$; $v_{{r1}}$: $v_{{r}}$ turned with the frame; $v_{{e}}'$, $v_{{r}}'$: at ${own}_{{1}}$")));
            velocities.push(Phrase::new(
                "$\\Delta v_{a} = \\Delta v_{e} + \\Delta v_{e}^{*} + \\Delta v_{r}^{*} + \\Delta v_{r}$",
            ));
            velocities.push(row("\\Delta v_{e}", later.carried - transport, "a_{e}", of_frame, a));
            velocities.push(row(
                "\\Delta v_{e}^{*}",
                later.transport - later.carried,
                "\\omega \\times v_{r}",
                half,
                a,
            ));
            velocities.push(row(
                "\\Delta v_{r}^{*}",
                later.turned - relative,
                "\\omega \\times v_{r}",
                half,
                a,
            ));
            velocities.push(row(
                "\\Delta v_{r}",
                later.relative - later.turned,
                "a_{r}",
                of_point,
                a,
            ));
            let k = symbol(Some(CompositePart::Coriolis), DiagramKind::Acceleration, self.notation);
            velocities.push(Phrase::new(&format!(
                "{limit}$a_{{a}} = a_{{e}} + a_{{r}} + {k}${}${k} = 2\\omega \\times v_{{r}}$",
                tr!(lang, "clause" => ", ")
            )));
        }
        DerivationWords { displacements, velocities }
    }
}
