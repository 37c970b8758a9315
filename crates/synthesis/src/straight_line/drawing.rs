//! Drawings of straight-line linkages at the ends of the stretch, in its middle and at the extremes
//! of E; length and deviation are read at right angles.

use super::{Linkage, SHORT, StraightLineTask};
use crate::board::{PaperLine, SynthesisBoard, Weight};
use crate::candidate::Draft;
use crate::fourbar::{FourBar, Heading};
use crate::laid::{LaidFourBar, numbered};
use crate::statement::of;
use hodograph_base::diag::{Both, both};
use hodograph_base::geom::{Point, Vec2};

/// Driver positions that differ by less than this are equal (rad).
const SAME: f64 = 1e-6;
/// The share of the stretch by which the line and the parallels extend beyond it.
const BEYOND: f64 = 0.1;

/// A position on paper: the place of E, the segments of the links, and the pins, the driver's pin
/// first.
struct LinkagePose {
    e: Point,
    links: Vec<[Point; 2]>,
    pins: Vec<(&'static str, Point)>,
}

/// The position on a board for a driver angle (rad).
type Placing = dyn Fn(&SynthesisBoard, f64) -> Option<LinkagePose>;

/// The linkage laid off on paper, and its position for a driver angle.
struct Sheet {
    laid: Both,
    fixed: Vec<(&'static str, Point)>,
    circles: Vec<(Point, f64)>,
    guide: Option<[Point; 2]>,
    moved: Both,
    at: Box<Placing>,
}

impl StraightLineTask {
    /// Lays off the computed lengths; draws E at the positions that determine length and deviation.
    pub(super) fn drawn(&self, draft: &Draft, board: &mut SynthesisBoard) -> Option<()> {
        let made = self.made(self.length / self.unit_length(), &Heading::default())?;
        let sheet = self.sheet(draft, board)?;
        let drivers = drivers(draft, made.wanted.first()?.driver, self.begins_dead());
        let which: Vec<usize> = (1..=drivers.len()).collect();
        board.step(sheet.laid);
        for (centre, radius) in &sheet.circles {
            board.circle(*centre, *radius, Weight::Thin);
        }
        if let Some([p, q]) = sheet.guide {
            board.line(p, q, Weight::Given);
        }
        for (name, at) in &sheet.fixed {
            board.mark(name, *at);
        }
        board.step(both!("{}: {}", sheet.moved, numbered("E", &which)));
        let mut all = Vec::new();
        for (k, driver) in drivers.iter().enumerate() {
            let position = (sheet.at)(board, *driver)?;
            for [p, q] in &position.links {
                board.line(*p, *q, Weight::Thin);
            }
            let (name, pin) = position.pins[0];
            board.mark(&format!("{name}_{}", k + 1), pin).mark(&format!("E_{}", k + 1), position.e);
            all.push(position);
        }
        measured(board, &all, made.along == 'x');
        let first = all.first()?;
        board.step(both!("Draw the linkage in position 1"));
        for [p, q] in &first.links {
            board.line(*p, *q, Weight::Result);
        }
        for (name, at) in &first.pins[1..] {
            board.mark(&format!("{name}_1"), *at);
        }
        Some(())
    }

    /// True if the range begins in a dead centre of the driver.
    fn begins_dead(&self) -> bool {
        match self.linkage {
            Linkage::Chebyshev => true,
            Linkage::Watt
            | Linkage::Roberts
            | Linkage::Hoeken
            | Linkage::ScottRussell
            | Linkage::Peaucellier => false,
        }
    }

    fn sheet(&self, draft: &Draft, board: &SynthesisBoard) -> Option<Sheet> {
        Some(match self.linkage {
            Linkage::Watt => four_bar(draft, board, &super::watt(of(draft, "AB") / 5.0)),
            Linkage::Chebyshev => four_bar(draft, board, &super::chebyshev(of(draft, "AB") / 5.0)),
            Linkage::Roberts => {
                four_bar(draft, board, &super::roberts(of(draft, "AB") / super::ROBERTS))
            }
            Linkage::Hoeken => four_bar(draft, board, &super::hoeken(of(draft, "AB"), self.ratios)),
            Linkage::ScottRussell => scott_russell(draft, board),
            Linkage::Peaucellier => peaucellier(draft, board),
        })
    }
}

/// The driver positions to draw (rad): the middle, the ends, and the extremes across the line if
/// they are elsewhere. A range that is swept from next to a dead centre is drawn from the dead
/// centre itself.
fn drivers(draft: &Draft, middle: f64, dead: bool) -> Vec<f64> {
    let short = if dead { SHORT } else { 0.0 };
    let number = |name: &str| draft.numbers.iter().find(|n| n.name == name).map(|n| n.value);
    let named = |name: &str| number(name).map(|at| if name == "from" { at - short } else { at });
    let mut all: Vec<f64> = vec![middle];
    for at in ["from", "to", "at_least", "at_greatest"].into_iter().filter_map(named) {
        if all.iter().all(|d| (d - at).abs() > SAME) {
            all.push(at);
        }
    }
    all
}

/// Draws the line through E₁, perpendiculars to it at the ends and parallels through the extremes;
/// reads their distances.
fn measured(board: &mut SynthesisBoard, all: &[LinkagePose], level: bool) {
    let along = if level { Vec2::new(1.0, 0.0) } else { Vec2::new(0.0, 1.0) };
    let Some(first) = all.first() else { return };
    let line = PaperLine { at: first.e, along };
    let across = line.square(first.e);
    let ends = |of: &PaperLine| {
        let on = |p: &LinkagePose| of.along.dot(p.e - of.at);
        let (low, high) = all
            .iter()
            .map(on)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        [of.place(low), of.place(high)]
    };
    let ([from, to], [low, high]) = (ends(&line), ends(&across));
    board.step(both!(
        "Draw through E1 the line of the motion, and perpendiculars to it from the outermost E: their distance is the length, that of the parallels through the E farthest to either side the deviation"
    ));
    let beyond = (to - from) * BEYOND;
    for at in [low, high] {
        let shift = at - first.e;
        board.line(from + shift - beyond, to + shift + beyond, Weight::Thin);
    }
    board.read("length", from, to).read("deviation", low, high);
}

fn four_bar(draft: &Draft, board: &SynthesisBoard, l: &FourBar) -> Sheet {
    let opened = LaidFourBar::off(board, draft, [l.a, l.d], l.e);
    let left = (l.d - l.b).cross(l.c - l.b) > 0.0;
    let at = move |board: &SynthesisBoard, crank: f64| {
        let pins = opened.at(board, crank, left)?;
        let links = vec![
            [opened.a, pins.b],
            [pins.b, pins.c],
            [pins.c, opened.d],
            [pins.c, pins.e],
            [pins.b, pins.e],
        ];
        Some(LinkagePose { e: pins.e, links, pins: vec![("B", pins.b), ("C", pins.c)] })
    };
    Sheet {
        laid: both!("Lay off A and D, the circles of AB about A and of CD about D"),
        fixed: vec![("A", opened.a), ("D", opened.d)],
        circles: vec![(opened.a, opened.crank), (opened.d, opened.follower)],
        guide: None,
        moved: if l.e.is_none_or(|e| e.y == 0.0) {
            both!(
                "In the middle, at the ends and the extremes lay off AB, with BC about B cut the circle of CD, and lay off BE on BC"
            )
        } else {
            both!(
                "In the middle, at the ends and the extremes lay off AB, with BC about B cut the circle of CD, and lay the triangle BCE on BC"
            )
        },
        at: Box::new(at),
    }
}

fn scott_russell(draft: &Draft, board: &SynthesisBoard) -> Sheet {
    let (a, crank) = (board.at(Point::ORIGIN), board.mm(of(draft, "AB")));
    let guide = PaperLine { at: a, along: Vec2::new(1.0, 0.0) };
    let at = move |board: &SynthesisBoard, angle: f64| {
        let b = a + Vec2::from_angle(angle) * crank;
        let c = board.cut(&guide, b, crank)?[1];
        let e = PaperLine::through(c, b)?.place(2.0 * crank);
        Some(LinkagePose { e, links: vec![[a, b], [c, e]], pins: vec![("B", b), ("C", c)] })
    };
    Sheet {
        laid: both!("Lay off A, the guide through it and the crank circle"),
        fixed: vec![("A", a)],
        circles: vec![(a, crank)],
        // C moves out to twice the crank's length.
        guide: Some([a, guide.place(2.0 * crank * (1.0 + BEYOND))]),
        moved: both!(
            "In the positions lay off AB, with BC = AB about B cut the guide in C, and lay off CE on CB"
        ),
        at: Box::new(at),
    }
}

fn peaucellier(draft: &Draft, board: &SynthesisBoard) -> Sheet {
    let [crank, long, short] = ["KC", "OX", "CX"].map(|name| board.mm(of(draft, name)));
    let (o, k) = (board.at(Point::ORIGIN), board.at(Point::new(of(draft, "KC"), 0.0)));
    let at = move |board: &SynthesisBoard, angle: f64| {
        let c = k + Vec2::from_angle(angle) * crank;
        let [x, y] = board.circles(o, long, c, short)?;
        let e = board
            .circles(x, short, y, short)?
            .into_iter()
            .max_by(|p, q| p.distance(c).total_cmp(&q.distance(c)))?;
        let links = vec![[k, c], [o, x], [o, y], [c, x], [c, y], [x, e], [y, e]];
        Some(LinkagePose { e, links, pins: vec![("C", c), ("X", x), ("Y", y)] })
    };
    Sheet {
        laid: both!("Lay off O and K, and about K the circle through O"),
        fixed: vec![("O", o), ("K", k)],
        circles: vec![(k, crank), (o, long)],
        guide: None,
        moved: both!(
            "In the positions lay off KC; OX about O and CX about C intersect at X and Y, CX about these at E"
        ),
        at: Box::new(at),
    }
}
