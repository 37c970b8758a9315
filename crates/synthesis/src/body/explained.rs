//! Body guidance as a problem, and the formulas of its proof: circles through three places, poles,
//! Burmester's conditions.

use super::among::Among;
use super::{Body, Method};
use crate::candidate::Draft;
use crate::statement::{angle, centre_of_three, length, of, place};
use crate::{Proof, Statement};
use hodograph_base::diag::{Both, both};
use hodograph_base::geom::Point;

impl Body {
    pub(super) fn stated(&self) -> Statement {
        let mut given: Vec<Both> = self
            .positions
            .iter()
            .enumerate()
            .map(|(k, p)| {
                both!(
                    "position {0}: origin $E_{0}$ at ${1}$, direction $\\theta_{0} = {2}$",
                    k + 1,
                    place(p.origin),
                    angle(p.angle)
                )
            })
            .collect();
        let mut wanted = Vec::new();
        for (side, [pin, pivot]) in [["B", "A"], ["C", "D"]].into_iter().enumerate() {
            given
                .extend(self.moving[side].map(|l| {
                    both!("pin ${pin}$ on the body, from $E$: ${}$", place(l.to_point()))
                }));
            given.extend(self.ground[side].map(|p| both!("pivot ${pivot}$ at ${}$", place(p))));
            if self.moving[side].is_some() {
                wanted.push(both!("the fixed pivot ${pivot}$"));
            } else if self.ground[side].is_some() {
                wanted.push(both!("the pin ${pin}$ on the body"));
            } else {
                wanted.push(both!("the pin ${pin}$ and its pivot ${pivot}$"));
            }
        }
        if let Some((through, direction)) = self.line {
            given.push(both!(
                "line for the pivots: through ${}$, at ${}$",
                place(through),
                angle(direction.angle())
            ));
        }
        match self.among {
            Some(Among::Box([p, q])) => given.push(both!(
                "box for the pivots: from ${}$ to ${}$; the best transmission angle is wanted",
                place(p),
                place(q)
            )),
            Some(Among::Angles([a, d])) => given.push(both!(
                "inscribed angles of the pivots over $P_{{12}}P_{{23}}$: $\\beta_A = {}$, $\\beta_D = {}$",
                angle(a),
                angle(d)
            )),
            None => {}
        }
        let task = both!(
            "Design a four-bar $ABCD$ whose coupler $BC$ carries a body through the {} given positions.",
            self.positions.len()
        );
        Statement { task, given, wanted, open_steps: 1 }
    }

    pub(super) fn proved(&self, draft: &Draft) -> Vec<Proof> {
        let at = |name: &str| {
            Point::new(of(draft, &format!("{name}_x")), of(draft, &format!("{name}_y")))
        };
        let lengths =
            ["AB", "BC", "CD", "AD"].map(|n| format!("l_{{{n}}} = {}", length(of(draft, n))));
        let mut out = match self.method() {
            Method::Bisectors => {
                vec![self.side_proved(0, at("A"), at("B1")), self.side_proved(1, at("D"), at("C1"))]
            }
            Method::Curve | Method::Burmester => self.curve_proved(draft),
        };
        out.push(Proof::new(both!("So"), [lengths.join(" ,\\quad ")]));
        out
    }

    fn side_proved(&self, side: usize, pivot: Point, pin: Point) -> Proof {
        let first = self.positions[0];
        let [pin_name, pivot_name] = [["B", "C"], ["A", "D"]].map(|n| n[side]);
        let (places, sought, found, what) = match self.moving[side] {
            Some(local) => (
                self.positions.iter().map(|p| p.place(local)).collect::<Vec<_>>(),
                pivot_name.to_owned(),
                pivot,
                both!(
                    "${pin_name}$ keeps its distance from ${pivot_name}$: the squares of its distances in two positions, subtracted, are linear equations (mm)."
                ),
            ),
            None => (
                self.positions
                    .iter()
                    .map(|p| p.carry(&first, self.ground[side].unwrap_or(Point::ORIGIN)))
                    .collect(),
                format!("{pin_name}_1"),
                pin,
                both!(
                    "Seen from the body in position 1, ${pivot_name}$ keeps its distance from ${pin_name}_1$: the squares, subtracted, are linear equations (mm)."
                ),
            ),
        };
        match places[..] {
            [p, q, r] => centre_of_three(what, [p, q, r], &sought, found),
            _ => Proof::new(
                both!("With two positions any point of the bisector serves; taken:"),
                [format!("{sought} = {}", place(found))],
            ),
        }
    }

    fn curve_proved(&self, draft: &Draft) -> Vec<Proof> {
        let n = self.positions.len();
        let poles: Vec<String> = (1..n)
            .filter_map(|j| {
                Some(format!(
                    "P_{{1{}}} = {}",
                    j + 1,
                    place(self.positions[0].pole(&self.positions[j])?)
                ))
            })
            .collect();
        let at = |name: &str| {
            place(Point::new(of(draft, &format!("{name}_x")), of(draft, &format!("{name}_y"))))
        };
        let conditions = match self.method() {
            Method::Bisectors | Method::Curve => both!(
                "For a pivot $M$ these are three linear equations in the pin; they agree where a determinant of the third degree in $M$ vanishes: the centre-point curve. Of its points that are allowed:"
            ),
            Method::Burmester => both!(
                "For a pivot $M$ these are four linear equations in the pin; two cubics in $M$ vanish together in at most four points, Burmester's. Of these:"
            ),
        };
        vec![
            Proof::new(
                both!(
                    "Poles of the displacements from position 1, $\\delta_j = \\theta_j − \\theta_1$:"
                ),
                std::iter::once("P_{1j} = \\frac{E_1 + E_j}{2} + \\frac{(E_j − E_1)^\\perp}{2\\tan(\\delta_j/2)}".to_owned()).chain(poles),
            ),
            Proof::new(
                both!(
                    "A pin that is at $W$ in position 1 and at $W_j$ in position $j$ stays on a circle about $M$ when"
                ),
                [format!("|W_j − M|^2 = |W − M|^2 ,\\quad j = 2, ..., {n}")],
            ),
            Proof::new(
                conditions,
                [format!("A = {} ,\\quad B_1 = {}", at("A"), at("B1")), format!("D = {} ,\\quad C_1 = {}", at("D"), at("C1"))],
            ),
        ]
    }
}
