//! Path generation as a problem, and the formulas of its proof.

use super::PathTask;
use super::inversion::{back_to_first, turned_back};
use super::prescribed::{Prescribed, Ray};
use crate::candidate::Draft;
use crate::statement::{angle, centre_of_three, four_bar_wanted, length, of, place};
use crate::{Proof, Statement};
use hodograph_base::diag::{Both, both};
use hodograph_base::geom::Point;

/// Greatest number of places in a list; of more, the first are printed.
const TOLD: usize = 12;

impl PathTask {
    pub(super) fn stated(&self) -> Statement {
        let listed = |all: &[Point]| -> Vec<Both> {
            let one = |(k, p): (usize, &Point)| {
                let text = format!("$E_{{{}}} = {}$", k + 1, place(*p));
                Both { en: text.clone(), zh: text }
            };
            let mut out: Vec<Both> = all.iter().take(TOLD).enumerate().map(one).collect();
            if all.len() > TOLD {
                out.push(both!("and {} places more, as in the file", all.len() - TOLD));
            }
            out
        };
        match self {
            PathTask::Three { points, pivots: [a, d], lengths, .. } => {
                let mut given = listed(points);
                given.push(pivots_told(*a, *d));
                given.extend(lengths_told(*lengths));
                Statement {
                    task: both!(
                        "Design a four-bar $ABCD$ whose coupler point $E$ passes through three given places."
                    ),
                    given,
                    wanted: vec![both!(
                        "the coupler $l_{{BC}}$, $l_{{CE}}$ and the follower $l_{{CD}}$"
                    )],
                    open_steps: 1,
                }
            }
            PathTask::Turned { points, pivots: [a, d], turns } => {
                let mut given = listed(points);
                given.push(pivots_told(*a, *d));
                given.push(turns_told(turns));
                Statement {
                    task: both!(
                        "Design a four-bar $ABCD$ whose coupler point $E$ passes through three given places at given turns of the crank."
                    ),
                    given,
                    wanted: vec![both!(
                        "the crank $l_{{AB}}$, the coupler $l_{{BC}}$, $l_{{BE}}$, $l_{{CE}}$ and the follower $l_{{CD}}$"
                    )],
                    open_steps: 1,
                }
            }
            PathTask::Prescribed(Prescribed { points, turns, lines }) => {
                let mut given = listed(points);
                given.push(turns_told(turns));
                given.extend(lines.iter().flat_map(|[a, d]| [on_line("A", *a), on_line("D", *d)]));
                Statement {
                    task: both!(
                        "Design a four-bar $ABCD$ whose coupler point $E$ passes through four given places at given turns of the crank."
                    ),
                    given,
                    wanted: vec![both!(
                        "the pivots $A$, $D$, the crank $l_{{AB}}$, the coupler $l_{{BC}}$, $l_{{BE}}$, $l_{{CE}}$ and the follower $l_{{CD}}$"
                    )],
                    open_steps: 0,
                }
            }
            PathTask::Several { points, a, lengths, line, .. } => {
                let mut given = listed(points);
                given.push(both!("pivot $A = {}$", place(*a)));
                given.extend(lengths_told(*lengths));
                given.extend(line.map(|line| on_line("D", line)));
                let count = points.len();
                Statement {
                    task: both!(
                        "Design a four-bar $ABCD$ whose coupler point $E$ passes through {count} given places."
                    ),
                    given,
                    wanted: vec![both!(
                        "the pivot $D$, the coupler $l_{{BC}}$, $l_{{CE}}$ and the follower $l_{{CD}}$"
                    )],
                    open_steps: 0,
                }
            }
            PathTask::Many { points, timing: Some(turns), .. } => {
                let mut given = listed(points);
                given.push(turns_told(turns));
                Statement {
                    task: both!(
                        "Design a crank-rocker $ABCD$ whose coupler point $E$ is as near as possible to {} given places, at given turns of the crank.",
                        points.len()
                    ),
                    given,
                    wanted: many_wanted(),
                    open_steps: 0,
                }
            }
            PathTask::Many { points, timing: None, .. } => Statement {
                task: both!(
                    "Design a crank-rocker $ABCD$ whose coupler point $E$ passes as near as possible to {} given places, in their order.",
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
            PathTask::Three { points, pivots, .. } => three(points, pivots[1], draft),
            PathTask::Turned { points, pivots, turns } => {
                let mut out = first_pin(points, pivots[0], turns, draft);
                out.extend(three(points, pivots[1], draft));
                out
            }
            PathTask::Prescribed(wish) => by_burmester(&wish.points, &wish.turns, draft),
            PathTask::Many { points, timing: Some(turns), .. } if super::is_met(draft) => {
                by_burmester(points, turns, draft)
            }
            PathTask::Several { points, .. } => several(points, draft),
            PathTask::Many { points, timing, .. } => many(points.len(), timing.is_some(), draft),
        }
    }
}

/// A from the positions of a plane that rotates with the crank, B₁ from the places turned back, D
/// and C₁ from the positions of the coupler.
fn by_burmester(e: &[Point], turns: &[f64], draft: &Draft) -> Vec<Proof> {
    let a = Point::new(of(draft, "A_x"), of(draft, "A_y"));
    let centre = Proof::new(
        both!(
            "$A$ is a centre point (Burmester) of the positions of a plane that has its origin in $E_k$ and turns with the crank:"
        ),
        [format!("A = {}", place(a))],
    );
    [vec![centre], first_pin(e, a, turns, draft), several(e, draft)].concat()
}

/// B₁ from the places turned back with the crank.
fn first_pin(e: &[Point], a: Point, turns: &[f64], draft: &Draft) -> Vec<Proof> {
    let back = turned_back(e, a, turns);
    let [Some(second), Some(third)] = [1, 2].map(|k| back.get(k).copied()) else {
        return Vec::new();
    };
    let b1 = Point::new(of(draft, "B1_x"), of(draft, "B1_y"));
    let places: Vec<String> = back
        .iter()
        .enumerate()
        .skip(1)
        .map(|(k, p)| format!("E_{}' = {}", k + 1, place(*p)))
        .collect();
    vec![
        Proof::new(
            both!(
                "Turned back about $A$ with the crank, $\\delta_k$ its turn from place 1 to $k$, $E_k$ comes to"
            ),
            ["E_k' = A + R(−\\delta_k)\\,(E_k − A)".to_owned(), places.join(" ,\\quad ")],
        ),
        centre_of_three(
            both!(
                "$B_1$ is as far from $E_1$ as from $E_2'$ and $E_3'$: the squares of the distances, subtracted, are linear equations (mm)."
            ),
            [e[0], second, third],
            "B_1",
            b1,
        ),
    ]
}

/// The crank's rotations from the first place; of many, the first.
fn turns_told(turns: &[f64]) -> Both {
    let turned: Vec<String> =
        turns.iter().skip(1).take(TOLD - 1).map(|t| angle(t - turns[0])).collect();
    let more = if turns.len() > TOLD { ", ..." } else { "" };
    both!("turns of the crank from $E_1$: ${}{more}$", turned.join(" ,\\quad "))
}

fn on_line(letter: &str, (through, along): Ray) -> Both {
    let (at, angle) = (place(through), angle(along.angle()));
    both!("${letter}$ on the line through ${at}$ under ${angle}$")
}

fn pivots_told(a: Point, d: Point) -> Both {
    both!("pivots $A = {}$, $D = {}$", place(a), place(d))
}

fn lengths_told([crank, be]: [f64; 2]) -> [Both; 2] {
    [
        both!("crank $l_{{AB}} = {}$", length(crank)),
        both!("$l_{{BE}} = {}$ on the coupler", length(be)),
    ]
}

/// The places of B in all positions.
fn pins(draft: &Draft) -> Vec<Point> {
    draft.wanted.iter().flat_map(|w| &w.places).filter(|(n, _)| n == "B").map(|(_, p)| *p).collect()
}

/// Four or five places: D on the centre-point curve, checked by its places moved back.
fn several(e: &[Point], draft: &Draft) -> Vec<Proof> {
    let b = pins(draft);
    if b.len() != e.len() {
        return Vec::new();
    }
    let [d, c] =
        ["D", "C1"].map(|n| Point::new(of(draft, &format!("{n}_x")), of(draft, &format!("{n}_y"))));
    let listed = |letter: &str, all: Vec<Point>, from: usize, dash: &str| {
        let one = |(k, p): (usize, &Point)| format!("{letter}_{}{dash} = {}", k + from, place(*p));
        all.iter().enumerate().map(one).collect::<Vec<_>>().join(" ,\\quad ")
    };
    let back: Vec<Point> = (1..e.len()).map(|k| back_to_first(d, &b, e, k)).collect();
    let far: Vec<String> = back.iter().map(|p| length(p.distance(c))).collect();
    vec![
        Proof::new(
            both!("$B_i$ lies on the crank's circle and at $l_{{BE}}$ from $E_i$:"),
            [listed("B", b.clone(), 1, "")],
        ),
        Proof::new(
            both!(
                "$D$ is a centre point of the positions of $BE$ (Burmester), $C_1$ its pin. Carried back with the coupler into position 1 all places of $D$ lie on a circle about $C_1$:"
            ),
            [
                format!("D = {} ,\\quad C_1 = {}", place(d), place(c)),
                listed("D", back, 2, "'"),
                format!("l_{{CD}} = {} ,\\quad {}", length(of(draft, "CD")), far.join(" ,\\quad ")),
            ],
        ),
        Proof::new(
            both!("So"),
            [["BC", "CE", "CD"]
                .map(|n| format!("l_{{{n}}} = {}", length(of(draft, n))))
                .join(" ,\\quad ")],
        ),
    ]
}

fn three(e: &[Point; 3], d: Point, draft: &Draft) -> Vec<Proof> {
    let Ok(b) = <[Point; 3]>::try_from(pins(draft)) else { return Vec::new() };
    let turned = [1, 2].map(|k| back_to_first(d, &b, e, k));
    let c1 = Point::new(of(draft, "C1_x"), of(draft, "C1_y"));
    let crank = |k: usize| format!("B_{} = {}", k + 1, place(b[k]));
    vec![
        Proof::new(
            both!("$B_i$ lies on the crank's circle and at $l_{{BE}}$ from $E_i$:"),
            [format!("{} ,\\quad {} ,\\quad {}", crank(0), crank(1), crank(2))],
        ),
        Proof::new(
            both!(
                "Carried back with the coupler into position 1, $\\delta_j$ the turning of $BE$ from position 1 to $j$, $D$ comes to"
            ),
            [
                "D_j' = B_1 + R(−\\delta_j)\\,(D − B_j)".to_owned(),
                format!("D_2' = {} ,\\quad D_3' = {}", place(turned[0]), place(turned[1])),
            ],
        ),
        centre_of_three(
            both!(
                "$C_1$ is as far from $D$ as from $D_2'$ and $D_3'$: the squares of the distances, subtracted, are linear equations (mm)."
            ),
            [d, turned[0], turned[1]],
            "C_1",
            c1,
        ),
        Proof::new(
            both!("So"),
            [["BC", "CE", "CD"]
                .map(|n| format!("l_{{{n}}} = {}", length(of(draft, n))))
                .join(" ,\\quad ")],
        ),
    ]
}

fn many_wanted() -> Vec<Both> {
    vec![four_bar_wanted(), both!("the frame $AD$ and the place of $E$ on the coupler")]
}

fn many(count: usize, timed: bool, draft: &Draft) -> Vec<Proof> {
    let lengths = ["AB", "BC", "CD", "AD"].map(|n| format!("l_{{{n}}} = {}", length(of(draft, n))));
    let (how, at) = if timed {
        let how = both!(
            "Ten unknowns (place of $A$, direction of the frame, four lengths, $E$ on the coupler, the crank's first angle $\\varphi_1$) make the sum of the squared distances least at the given turns $\\delta_k$; $E = A + z_1 p_k + z_2 q_k$, with $p_k$, $q_k$ the directions of crank and coupler from the frame, is linear in $A$, $z_1$, $z_2$, so that differential evolution runs over the ratios of the lengths and $\\varphi_1$ only; then Gauss-Newton over all:"
        );
        (how, "\\varphi_1 + \\delta_k")
    } else {
        let how = both!(
            "Nine unknowns (place of $A$, direction of the frame, four lengths, $E$ on the coupler) and a crank angle for each place make the sum of the squared distances least; found by differential evolution, then Gauss-Newton:"
        );
        (how, "\\varphi_k")
    };
    vec![
        Proof::new(
            how,
            [
                format!(
                    "d_k = |E({at}) − E_k| ,\\quad d = \\sqrt{{(d_1^2 + d_2^2 + ... + d_{{{count}}}^2)/{count}}}"
                ),
                format!(
                    "d = {} ,\\quad d_{{\\text{{max}}}} = {}",
                    length(of(draft, "rms")),
                    length(of(draft, "max"))
                ),
            ],
        ),
        Proof::new(
            both!("The linkage:"),
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
