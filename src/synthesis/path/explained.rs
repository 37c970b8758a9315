//! Path generation as a problem, and the formulas of its proof.

use super::{Path, back_to_first};
use crate::diag::{Both, both};
use crate::geom::Point;
use crate::synthesis::candidate::Draft;
use crate::synthesis::told::{angle, centre_of_three, four_bar_wanted, length, of, place};
use crate::synthesis::{Proof, Statement};

/// Places that stand in a list; of more the first are told.
const TOLD: usize = 12;

impl Path {
    pub(super) fn stated(&self) -> Statement {
        let listed = |all: &[Point]| -> Vec<Both> {
            let one = |(k, p): (usize, &Point)| {
                let text = format!("$E_{{{}}} = {}$", k + 1, place(*p));
                Both { en: text.clone(), zh: text }
            };
            let mut out: Vec<Both> = all.iter().take(TOLD).enumerate().map(one).collect();
            if all.len() > TOLD {
                out.push(both!("and {} places more, as in the file", "及文件中的其余 {} 个点", all.len() - TOLD));
            }
            out
        };
        match self {
            Path::Three { points, a, d, crank, be, .. } => {
                let mut given = listed(points);
                given.extend([
                    both!("pivots $A = {}$, $D = {}$", "固定铰链 $A = {}$，$D = {}$", place(*a), place(*d)),
                    both!("crank $l_{{AB}} = {}$", "曲柄 $l_{{AB}} = {}$", length(*crank)),
                    both!("$l_{{BE}} = {}$ on the coupler", "连杆上 $l_{{BE}} = {}$", length(*be)),
                ]);
                Statement {
                    task: both!(
                        "Design a four-bar $ABCD$ whose coupler point $E$ passes through three given places.",
                        "设计四杆机构 $ABCD$，使连杆上的点 $E$ 通过三个预定位置。"
                    ),
                    given,
                    wanted: vec![both!(
                        "the coupler $l_{{BC}}$, $l_{{CE}}$ and the follower $l_{{CD}}$",
                        "连杆 $l_{{BC}}$、$l_{{CE}}$ 与从动连架杆 $l_{{CD}}$"
                    )],
                    open_steps: 1,
                }
            }
            Path::Many { points, timing: Some(turns), .. } => {
                let mut given = listed(points);
                let turned: Vec<String> = turns.iter().skip(1).take(TOLD - 1).map(|t| angle(t - turns[0])).collect();
                let more = if turns.len() > TOLD { ", ..." } else { "" };
                given.push(both!("turns of the crank from $E_1$: ${}{more}$", "曲柄自 $E_1$ 的转角：${}{more}$", turned.join(" ,\\; ")));
                Statement {
                    task: both!(
                        "Design a crank-rocker $ABCD$ whose coupler point $E$ is as near as possible to {} given places, at given turns of the crank.",
                        "设计曲柄摇杆机构 $ABCD$，使曲柄转过给定角度时连杆上的点 $E$ 尽可能接近 {} 个预定位置。",
                        points.len()
                    ),
                    given,
                    wanted: many_wanted(),
                    open_steps: 0,
                }
            }
            Path::Many { points, timing: None, .. } => Statement {
                task: both!(
                    "Design a crank-rocker $ABCD$ whose coupler point $E$ passes as near as possible to {} given places, in their order.",
                    "设计曲柄摇杆机构 $ABCD$，使连杆上的点 $E$ 依次尽可能接近 {} 个预定位置。",
                    points.len()
                ),
                given: listed(points),
                wanted: many_wanted(),
                open_steps: 0,
            },
        }
    }

    pub(super) fn proved(&self, draft: &Draft) -> Vec<Proof> {
        match self {
            Path::Three { points, d, .. } => three(points, *d, draft),
            Path::Many { points, timing, .. } => many(points.len(), timing.is_some(), draft),
        }
    }
}

fn three(e: &[Point; 3], d: Point, draft: &Draft) -> Vec<Proof> {
    let pins: Vec<Point> = draft.wanted.iter().flat_map(|w| &w.places).filter(|(n, _)| n == "B").map(|(_, p)| *p).collect();
    let Ok(b) = <[Point; 3]>::try_from(pins) else { return Vec::new() };
    let turned = [1, 2].map(|k| back_to_first(d, b, e, k));
    let c1 = Point::new(of(draft, "C1_x"), of(draft, "C1_y"));
    let crank = |k: usize| format!("B_{} = {}", k + 1, place(b[k]));
    vec![
        Proof::new(
            both!("$B_i$ lies on the crank's circle and at $l_{{BE}}$ from $E_i$:", "$B_i$ 在曲柄圆上，且到 $E_i$ 的距离为 $l_{{BE}}$："),
            [format!("{} ,\\quad {} ,\\quad {}", crank(0), crank(1), crank(2))],
        ),
        Proof::new(
            both!(
                "Carried back with the coupler into position 1, $\\delta_j$ the turning of $BE$ from position 1 to $j$, $D$ comes to",
                "$D$ 随连杆反转到位置 1（$\\delta_j$ 为 $BE$ 由位置 1 到 $j$ 的转角）："
            ),
            [
                "D_j' = B_1 + R(−\\delta_j)\\,(D − B_j)".to_owned(),
                format!("D_2' = {} ,\\quad D_3' = {}", place(turned[0]), place(turned[1])),
            ],
        ),
        centre_of_three(
            both!(
                "$C_1$ is as far from $D$ as from $D_2'$ and $D_3'$: the squares of the distances, subtracted, are linear equations (mm).",
                "$C_1$ 到 $D$、$D_2'$、$D_3'$ 等距：距离平方相减得线性方程（mm）。"
            ),
            [d, turned[0], turned[1]],
            "C_1",
            c1,
        ),
        Proof::new(both!("So", "于是"), [["BC", "CE", "CD"].map(|n| format!("l_{{{n}}} = {}", length(of(draft, n)))).join(" ,\\quad ")]),
    ]
}

fn many_wanted() -> Vec<Both> {
    vec![four_bar_wanted(), both!("the frame $AD$ and the place of $E$ on the coupler", "机架 $AD$ 及 $E$ 在连杆上的位置")]
}

fn many(count: usize, timed: bool, draft: &Draft) -> Vec<Proof> {
    let lengths = ["AB", "BC", "CD", "AD"].map(|n| format!("l_{{{n}}} = {}", length(of(draft, n))));
    let (how, at) = if timed {
        let how = both!(
            "Ten unknowns (place of $A$, direction of the frame, four lengths, $E$ on the coupler, the crank's first angle $\\varphi_1$) make the sum of the squared distances least at the given turns $\\delta_k$; $E = A + z_1 p_k + z_2 q_k$, with $p_k$, $q_k$ the directions of crank and coupler from the frame, is linear in $A$, $z_1$, $z_2$, so that differential evolution runs over the ratios of the lengths and $\\varphi_1$ only; then Gauss-Newton over all:",
            "十个未知量（$A$ 的位置、机架方向、四个杆长、$E$ 在连杆上的位置、曲柄初位角 $\\varphi_1$）使给定转角 $\\delta_k$ 处的距离平方和最小；$E = A + z_1 p_k + z_2 q_k$（$p_k$、$q_k$ 为曲柄、连杆相对机架的方向）对 $A$、$z_1$、$z_2$ 为线性，故差分进化只搜索杆长比和 $\\varphi_1$；再对全部未知量用高斯–牛顿法："
        );
        (how, "\\varphi_1 + \\delta_k")
    } else {
        let how = both!(
            "Nine unknowns (place of $A$, direction of the frame, four lengths, $E$ on the coupler) and a crank angle for each place make the sum of the squared distances least; found by differential evolution, then Gauss-Newton:",
            "九个未知量（$A$ 的位置、机架方向、四个杆长、$E$ 在连杆上的位置）及各点的曲柄转角使距离平方和最小；先用差分进化，再用高斯–牛顿法："
        );
        (how, "\\varphi_k")
    };
    vec![
        Proof::new(
            how,
            [
                format!("d_k = |E({at}) − E_k| ,\\quad d = \\sqrt{{(d_1^2 + d_2^2 + ... + d_{{{count}}}^2)/{count}}}"),
                format!("d = {} ,\\quad d_{{\\text{{max}}}} = {}", length(of(draft, "rms")), length(of(draft, "max"))),
            ],
        ),
        Proof::new(
            both!("The linkage:", "所得机构："),
            [
                lengths.join(" ,\\quad "),
                format!(
                    "A = {} ,\\quad \\varphi = {} ,\\quad \\varphi_1 = {} ,\\quad u = {} ,\\quad v = {}",
                    place(Point::new(of(draft, "A_x"), of(draft, "A_y"))),
                    angle(of(draft, "phi")),
                    angle(of(draft, "crank_1")),
                    length(of(draft, "u")),
                    length(of(draft, "v"))
                ),
            ],
        ),
    ]
}
