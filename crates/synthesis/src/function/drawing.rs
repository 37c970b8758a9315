//! Three pairs of angles drawn by inversion 反转法: the crank's positions B, turned back about D by
//! the follower's angles.

use super::Function;
use crate::board::{PaperLine, SynthesisBoard, Weight};
use crate::candidate::Draft;
use hodograph_base::diag::both;
use hodograph_base::digits::significant;
use hodograph_base::geom::{Point, Vec2};

impl Function {
    /// Frame and crank are laid off; C₁ results. Of more than three pairs that are met exactly, the
    /// first three are drawn.
    pub(super) fn drawn(&self, draft: &Draft, board: &mut SynthesisBoard) -> Option<()> {
        let number = |name: &str| draft.numbers.iter().find(|n| n.name == name).map(|n| n.value);
        // Where least squares or the exchange leave deviations, no intersection of circles gives
        // the linkage.
        if draft.error > 0.0 {
            return self.laid_on(draft, board);
        }
        let (a, d) = (Point::ORIGIN, Point::new(board.mm(number("AD")?), 0.0));
        let (crank, alpha, phi) = (board.mm(number("AB")?), number("alpha0")?, number("phi0")?);
        board.step(if self.steps.len() == 2 {
            both!("Lay off the frame AD and the crank in its two positions AB1, AB2")
        } else {
            both!("Lay off the frame AD and the crank in its first three positions AB1, AB2, AB3")
        });
        board.line(a, d, Weight::Given).circle(a, crank, Weight::Thin).mark("A", a).mark("D", d);
        let b: Vec<Point> =
            self.steps.iter().take(3).map(|s| a + Vec2::from_angle(alpha + s[0]) * crank).collect();
        for (k, at) in b.iter().enumerate() {
            board.line(a, *at, Weight::Given).mark(&format!("B_{}", k + 1), *at);
            if k > 0 {
                board.angle(a, [b[0], *at], &format!("\\alpha_{{1{}}}", k + 1));
            }
        }
        let mut turned = vec![b[0]];
        for (k, at) in b.iter().enumerate().skip(1) {
            let way = self.steps[k][1] - self.steps[0][1];
            let back = d + (*at - d).rotate_by(Vec2::from_angle(-way));
            let (j, angle) = (k + 1, significant(way.to_degrees(), 5));
            board.step(both!(
                "Turn DB{j} back about D by the follower's step φ1{j} = {angle}°: B{j}'"
            ));
            board
                .line(d, *at, Weight::Thin)
                .line(d, back, Weight::Thin)
                .angle(d, [*at, back], &format!("\\varphi_{{1{j}}}"))
                .mark(&format!("B_{j}'"), back);
            turned.push(back);
        }
        let c = match turned[..] {
            [b1, b2] => {
                board.step(both!(
                    "The bisector of B1B2' meets the follower's first direction at C1"
                ));
                let follower = PaperLine::ray(d, phi + self.steps[0][1]);
                let bisector = board.bisector(b1, b2)?;
                let c = bisector.cross(&follower)?;
                board.line(bisector.at, c, Weight::Thin);
                c
            }
            _ => {
                board.step(both!("The bisectors of B1, B2', B3' meet at C1"));
                board.centre(turned[0], turned[1], turned[2])?
            }
        };
        board.mark("C_1", c);
        board.step(both!("Draw the linkage AB1C1D; C1 lies on the follower's first direction"));
        board
            .line(a, b[0], Weight::Result)
            .line(b[0], c, Weight::Result)
            .line(c, d, Weight::Result)
            .read("BC", b[0], c)
            .read("CD", c, d);
        let first = phi + self.steps[0][1];
        let off = (c - d).angle() - first;
        board.read_angle("phi0", phi + libm::atan2(libm::sin(off), libm::cos(off)));
        Some(())
    }
}
