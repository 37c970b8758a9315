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
                    "位置 {0}：原点 $E_{0}$ ${1}$，方向角 $\\theta_{0} = {2}$",
                    k + 1,
                    place(p.origin),
                    angle(p.angle)
                )
            })
            .collect();
        let mut wanted = Vec::new();
        for (side, [pin, pivot]) in [["B", "A"], ["C", "D"]].into_iter().enumerate() {
            given.extend(self.moving[side].map(|l| {
                both!(
                    "pin ${pin}$ on the body, from $E$: ${}$",
                    "连杆上铰链 ${pin}$（相对 $E$）：${}$",
                    place(l.to_point())
                )
            }));
            given.extend(
                self.ground[side].map(|p| {
                    both!("pivot ${pivot}$ at ${}$", "固定铰链 ${pivot}$：${}$", place(p))
                }),
            );
            if self.moving[side].is_some() {
                wanted.push(both!("the fixed pivot ${pivot}$", "固定铰链 ${pivot}$"));
            } else if self.ground[side].is_some() {
                wanted.push(both!("the pin ${pin}$ on the body", "连杆上的铰链 ${pin}$"));
            } else {
                wanted.push(both!(
                    "the pin ${pin}$ and its pivot ${pivot}$",
                    "铰链 ${pin}$ 及固定铰链 ${pivot}$"
                ));
            }
        }
        if let Some((through, direction)) = self.line {
            given.push(both!(
                "line for the pivots: through ${}$, at ${}$",
                "固定铰链所在直线：过 ${}$，方向角 ${}$",
                place(through),
                angle(direction.angle())
            ));
        }
        match self.among {
            Some(Among::Box([p, q])) => given.push(both!(
                "box for the pivots: from ${}$ to ${}$; the best transmission angle is wanted",
                "固定铰链应在方框内：由 ${}$ 到 ${}$，并使传动角最好",
                place(p),
                place(q)
            )),
            Some(Among::Angles([a, d])) => given.push(both!(
                "inscribed angles of the pivots over $P_{{12}}P_{{23}}$: $\\beta_A = {}$, $\\beta_D = {}$",
                "固定铰链对 $P_{{12}}P_{{23}}$ 的圆周角：$\\beta_A = {}$，$\\beta_D = {}$",
                angle(a),
                angle(d)
            )),
            None => {}
        }
        let task = both!(
            "Design a four-bar $ABCD$ whose coupler $BC$ carries a body through the {} given positions.",
            "设计四杆机构 $ABCD$，使其连杆 $BC$ 依次占据给定的 {} 个位置。",
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
        out.push(Proof::new(both!("So", "于是"), [lengths.join(" ,\\quad ")]));
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
                    "${pin_name}$ keeps its distance from ${pivot_name}$: the squares of its distances in two positions, subtracted, are linear equations (mm).",
                    "${pin_name}$ 到 ${pivot_name}$ 的距离不变：两位置的距离平方相减，得线性方程（mm）。"
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
                    "Seen from the body in position 1, ${pivot_name}$ keeps its distance from ${pin_name}_1$: the squares, subtracted, are linear equations (mm).",
                    "以位置 1 的连杆为参考，${pivot_name}$ 到 ${pin_name}_1$ 的距离不变：距离平方相减，得线性方程（mm）。"
                ),
            ),
        };
        match places[..] {
            [p, q, r] => centre_of_three(what, [p, q, r], &sought, found),
            _ => Proof::new(
                both!(
                    "With two positions any point of the bisector serves; taken:",
                    "两个位置时中垂线上任一点均可；取："
                ),
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
                "For a pivot $M$ these are three linear equations in the pin; they agree where a determinant of the third degree in $M$ vanishes: the centre-point curve. Of its points that are allowed:",
                "对固定铰链 $M$，这是铰链坐标的三个线性方程；相容条件是 $M$ 的三次式为零，即圆心曲线。在其允许的点中取："
            ),
            Method::Burmester => both!(
                "For a pivot $M$ these are four linear equations in the pin; two cubics in $M$ vanish together in at most four points, Burmester's. Of these:",
                "对固定铰链 $M$，这是铰链坐标的四个线性方程；$M$ 的两个三次式同时为零，至多有四个点，即布尔梅斯特点。取其中："
            ),
        };
        vec![
            Proof::new(
                both!(
                    "Poles of the displacements from position 1, $\\delta_j = \\theta_j − \\theta_1$:",
                    "由位置 1 到各位置的转动极，$\\delta_j = \\theta_j − \\theta_1$："
                ),
                std::iter::once("P_{1j} = \\frac{E_1 + E_j}{2} + \\frac{(E_j − E_1)^\\perp}{2\\tan(\\delta_j/2)}".to_owned()).chain(poles),
            ),
            Proof::new(
                both!(
                    "A pin that is at $W$ in position 1 and at $W_j$ in position $j$ stays on a circle about $M$ when",
                    "铰链在位置 1 为 $W$、在位置 $j$ 为 $W_j$，它在以 $M$ 为圆心的圆上的条件是"
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
