//! Three places of a coupler point drawn: B on the crank's circle, D carried back with the coupler, the centre of its places.

use crate::diag::both;
use crate::geom::Point;
use crate::synthesis::board::{Board, Weight};

/// Draws it; all in metres but the board.
pub fn three(board: &mut Board, e: &[Point; 3], [a, d]: [Point; 2], [crank, be]: [f64; 2], left: bool) -> Option<()> {
    let (a, d, e) = (board.at(a), board.at(d), e.map(|p| board.at(p)));
    board.step(both!("Lay off A, D, the places of E and the crank circle", "作出 A、D、E 的各位置及曲柄圆"));
    let radius = board.mm(crank);
    board.circle(a, radius, Weight::Given).mark("A", a).mark("D", d);
    for (k, at) in e.iter().enumerate() {
        board.mark(&format!("E_{}", k + 1), *at);
    }
    board.step(both!(
        "With BE as opening about E1, E2, E3 cut the crank circle: B1, B2, B3",
        "分别以 E1、E2、E3 为圆心、BE 为半径截曲柄圆得 B1、B2、B3"
    ));
    let opening = board.mm(be);
    let mut b = [Point::ORIGIN; 3];
    for (k, at) in e.iter().enumerate() {
        let [one, other] = board.circles(a, radius, *at, opening)?;
        b[k] = if left { one } else { other };
        board.arc(*at, b[k]).line(b[k], *at, Weight::Given).mark(&format!("B_{}", k + 1), b[k]);
    }
    board.step(both!("Carry D back with the coupler BE into position 1: D2', D3'", "把 D 随连杆 BE 反转到位置 1，得 D2'、D3'"));
    let second = board.transfer(d, [b[1], e[1]], [b[0], e[0]])?;
    let third = board.transfer(d, [b[2], e[2]], [b[0], e[0]])?;
    board.mark("D_2'", second).mark("D_3'", third);
    board.step(both!("The bisectors of D, D2', D3' meet in C1", "D、D2'、D3' 的中垂线交于 C1"));
    let c = board.centre(d, second, third)?;
    board.mark("C_1", c).read("CD", c, d);
    board.step(both!("The linkage A B1 C1 D with E1", "位置 1 的机构 A B1 C1 D 及 E1"));
    board.line(a, b[0], Weight::Result).line(b[0], c, Weight::Result).line(c, d, Weight::Result);
    board.line(b[0], e[0], Weight::Result).line(e[0], c, Weight::Result).read("BC", b[0], c).read("CE", c, e[0]).read("AB", a, b[0]);
    Some(())
}
