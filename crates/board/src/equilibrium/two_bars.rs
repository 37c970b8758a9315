//! Two links, each on a pivot, that two bars join (class IV).
//!
//! The bars transmit forces along their lines, and square to them only parts due to their own
//! loads. The forces along the lines have no moment about the crossing S of the lines: moments of
//! each link about S give the part of its outer reaction square to the arm from S, and the polygon
//! of the whole group crosses the other two parts, as in a dyad with its inner pin in S. The
//! diagonal between the first link and the rest is the force of the bars on it; it is resolved
//! along their lines.

use super::answers::reaction;
use super::joints::{DyadJoint, Hinge, Joints, OuterJoint, turns_on};
use super::scribe::{ActingForce, Polygon, Scribe, square_to};
use super::{About, ForceTerm, MomentResult, Moments, Party, ReactionComponent};
use crate::construction::{Base, Direction, Key, Line, MarkId, Name, Number, NumberId, Op};
use hodograph_base::diag::{Both, both};
use hodograph_mechanism::position::Configuration;
use hodograph_scene::LinkId;

/// A bar with its pins on the first and on the second link.
#[derive(Clone, Copy)]
struct PinnedBar {
    link: LinkId,
    pins: [Hinge; 2],
}

/// A bar with its loads and the forces of the links on it square to the bar; `None` without loads.
struct LoadedBar {
    bar: PinnedBar,
    loads: Vec<ActingForce>,
    across: [Option<NumberId>; 2],
}

/// The group: its links with their outer pins, and the bars.
struct TwoBarGroup {
    links: [LinkId; 2],
    outer: [OuterJoint; 2],
    pivots: [Hinge; 2],
    bars: [PinnedBar; 2],
}

/// The smallest sine of the angle at which two lines cross; below it they count as parallel.
const PARALLEL: f64 = 1e-6;

impl Scribe<'_> {
    /// Writes the equilibrium of two links that two bars join; with parallel bars, or with a block
    /// instead of a bar, as a ring.
    ///
    /// # Errors
    /// A group of another kind; a further group at one of their pins.
    pub(super) fn on_two_bars(
        &mut self,
        links: &[LinkId],
        joints: &Joints,
        at: &Configuration,
    ) -> Result<(), Both> {
        let Some(group) = self.joined(links, joints) else { return self.on_a_ring(links, joints) };
        if let Some(pin) = group
            .bars
            .iter()
            .flat_map(|b| b.pins)
            .filter_map(Hinge::pin)
            .find(|p| !self.pin_loads(*p, group.links[0]).is_empty())
        {
            return Err(both!("a further group presses on pin {}", self.scene.point_name(pin)));
        }
        let along = group.bars.map(|b| {
            let [p, q] = b.pins.map(|p| at.points[p.at.0]);
            p.zip(q).and_then(|(p, q)| (q - p).unit())
        });
        match along {
            [Some(a), Some(b)] if a.cross(b).abs() > PARALLEL => {
                self.two_bars(links, &group);
                Ok(())
            }
            _ => self.on_a_ring(links, joints),
        }
    }

    fn joined(&self, links: &[LinkId], joints: &Joints) -> Option<TwoBarGroup> {
        let [
            first @ OuterJoint::Pin { on: a, hinge: p, .. },
            second @ OuterJoint::Pin { on: b, hinge: q, .. },
        ] = joints.outer[..]
        else {
            return None;
        };
        let has = |l: LinkId, hinge: &Hinge| turns_on(self.scene, l, *hinge);
        let inner: Vec<Hinge> = joints
            .inner
            .iter()
            .map(|pair| if let DyadJoint::Pin(p) = pair { Some(*p) } else { None })
            .collect::<Option<_>>()?;
        let bars: Vec<PinnedBar> = links
            .iter()
            .filter(|l| **l != a && **l != b)
            .map(|&link| {
                let on =
                    |core: LinkId| inner.iter().copied().find(|p| has(link, p) && has(core, p));
                Some(PinnedBar { link, pins: [on(a)?, on(b)?] })
            })
            .collect::<Option<_>>()?;
        (a != b && inner.len() == 4).then_some(())?;
        Some(TwoBarGroup {
            links: [a, b],
            outer: [first, second],
            pivots: [p, q],
            bars: bars.try_into().ok()?,
        })
    }

    fn two_bars(&mut self, links: &[LinkId], group: &TwoBarGroup) {
        let (mut ops, mut found) = (Vec::new(), Vec::new());
        let [one, two] =
            group.bars.map(|bar| self.loaded_bar(&mut ops, &mut found, bar, group.links));
        let lines = [&one, &two].map(|l| {
            let [from, to] = l.bar.pins.map(|p| self.mark(p.at));
            let along = Direction::of(Base::Arm { from, to, known: false });
            let line = self.c.line(Line {
                on: self.plane,
                through: from,
                along,
                moved: false,
                carries: Vec::new(),
            });
            ops.push(Op::Rule(line));
            line
        });
        let crossing = self.c.mark(self.plane, Name::Image(Key::of(self.crossings)));
        self.crossings += 1;
        ops.push(Op::Meet { lines, to: crossing });
        let own = [0, 1].map(|k| self.all_on(group.links[k], &[group.pivots[k]]));
        let square = [0, 1].map(|k| {
            self.square_to_arm(&mut ops, &mut found, (group, k), &own[k], [&one, &two], crossing)
        });
        self.on_plane(ops);
        let mut p = self.polygon();
        p.moments = found;
        let start = p.last;
        let arms = group.pivots.map(|pivot| Base::Arm {
            from: crossing,
            to: self.mark(pivot.at),
            known: false,
        });
        self.part(&mut p, group, 0, arms[0], square[0]);
        let first = p.last;
        self.lay_all(&mut p, &own[0]);
        let between = p.last;
        self.lay_all(&mut p, &one.loads);
        let after_one = p.last;
        self.lay_all(&mut p, &two.loads);
        self.lay_all(&mut p, &own[1]);
        let second = p.last;
        self.part(&mut p, group, 1, arms[1], square[1]);
        let end = p.last;
        let lines = [
            self.line(&mut p, start, Direction::of(arms[0])),
            self.line(&mut p, end, Direction::of(arms[1])),
        ];
        let x = self.meet(&mut p, lines);
        for (k, ends, whole) in [(0, [x, start], [x, first]), (1, [end, x], [second, x])] {
            let (outer, pivot) = (&group.outer[k], group.pivots[k]);
            let part = if square[k].is_some() {
                ReactionComponent::Normal
            } else {
                ReactionComponent::Whole
            };
            if let Some(term) = reaction(outer, part) {
                self.side(&mut p, (term, pivot.at), ends, k == 0);
            }
            if let (true, Some(term)) =
                (square[k].is_some(), reaction(outer, ReactionComponent::Whole))
            {
                self.diagonal(&mut p, (term, pivot.at), whole);
            }
            self.pinned(&mut p, pivot, group.links[k], whole);
        }
        // The force of the bars on the first link runs from `between` to `x`: the force of the
        // first bar to `y`, then the force of the second.
        let from = self.shifted(&mut p, between, &one, (group.links[0], false));
        let to = self.shifted(&mut p, x, &two, (group.links[0], true));
        let along = [&one, &two].map(|l| Direction::of(self.along(l, 0)));
        let lines = [self.line(&mut p, from, along[0]), self.line(&mut p, to, along[1])];
        let y = self.meet(&mut p, lines);
        self.bar_sides(&mut p, &one.bar, group.links, [y, between, after_one]);
        // The loads of the second bar a second time, after the force of the first link on it.
        p.last = y;
        let sides = p.sides.len();
        self.lay_all(&mut p, &two.loads);
        p.sides.truncate(sides);
        let loaded = p.last;
        self.bar_sides(&mut p, &two.bar, group.links, [x, y, loaded]);
        self.finish(p, links, "IV");
    }

    /// Returns the arm to one pin of the bar from the other.
    fn along(&self, l: &LoadedBar, k: usize) -> Base {
        Base::Arm {
            from: self.mark(l.bar.pins[1 - k].at),
            to: self.mark(l.bar.pins[k].at),
            known: false,
        }
    }

    /// Returns the force of a link on a bar, or of the bar on the link, square to the bar.
    fn square_term(l: &LoadedBar, link: LinkId, on_bar: bool) -> ForceTerm {
        let (of, on) = if on_bar { (link, l.bar.link) } else { (l.bar.link, link) };
        ForceTerm::Reaction { of: Party::Link(of), on, part: ReactionComponent::Tangential }
    }

    /// Returns a bar with its loads; the forces square to it follow by moments about its pins.
    fn loaded_bar(
        &mut self,
        ops: &mut Vec<Op>,
        found: &mut Vec<Moments>,
        bar: PinnedBar,
        links: [LinkId; 2],
    ) -> LoadedBar {
        let loads = self.all_on(bar.link, &bar.pins);
        let mut l = LoadedBar { bar, loads, across: [None, None] };
        for k in [0, 1] {
            let (pin, other) = (bar.pins[k], bar.pins[1 - k]);
            let gives = MomentResult::Force(Self::square_term(&l, links[k], true), pin.at);
            let of = self.moments(ops, &[bar.link], &l.loads, About::Point(other.at), gives);
            l.across[k] = self.across(ops, found, of, self.along(&l, k));
        }
        l
    }

    /// Returns the part of a link's outer reaction square to its arm from the crossing of the bars,
    /// by moments about the crossing.
    fn square_to_arm(
        &mut self,
        ops: &mut Vec<Op>,
        found: &mut Vec<Moments>,
        (group, k): (&TwoBarGroup, usize),
        own: &[ActingForce],
        bars: [&LoadedBar; 2],
        crossing: MarkId,
    ) -> Option<NumberId> {
        let (link, pivot) = (group.links[k], group.pivots[k]);
        let axial = bars.map(|l| ForceTerm::Reaction {
            of: Party::Link(l.bar.link),
            on: link,
            part: ReactionComponent::Normal,
        });
        let gives = MomentResult::Force(
            reaction(&group.outer[k], ReactionComponent::Tangential)?,
            pivot.at,
        );
        let mut moments =
            self.moments(ops, &[link], own, About::Crossing { at: crossing, of: axial }, gives);
        for l in bars {
            let (Some(value), pin) = (l.across[k], l.bar.pins[k]) else { continue };
            // The arm of a unit force square to the bar is the component of the connecting vector
            // along the bar; the bar presses in the opposite sense.
            let arm = self.number(
                ops,
                Number::Along(crossing, self.mark(pin.at), Direction::of(self.along(l, k))),
            );
            let turned = self.number(ops, Number::Product(value, arm));
            moments.of.push((
                Self::square_term(l, link, false),
                pin.at,
                self.number(ops, Number::Negative(turned)),
            ));
        }
        self.across(
            ops,
            found,
            moments,
            Base::Arm { from: crossing, to: self.mark(pivot.at), known: false },
        )
    }

    /// Lays off the part of an outer reaction square to its arm.
    fn part(
        &mut self,
        p: &mut Polygon,
        group: &TwoBarGroup,
        k: usize,
        arm: Base,
        value: Option<NumberId>,
    ) {
        if let (Some(value), Some(term)) =
            (value, reaction(&group.outer[k], ReactionComponent::Tangential))
        {
            self.laid(p, (term, group.pivots[k].at), square_to(arm), value);
        }
    }

    /// Returns the end of the force between a bar and the first link square to the bar, on the bar
    /// or on the link, laid off from a vertex.
    fn shifted(
        &mut self,
        p: &mut Polygon,
        from: MarkId,
        l: &LoadedBar,
        (link, on_bar): (LinkId, bool),
    ) -> MarkId {
        let Some(value) = l.across[0] else { return from };
        let times = if on_bar { value } else { self.number(&mut p.ops, Number::Negative(value)) };
        let (last, sides) = (p.last, p.sides.len());
        p.last = from;
        self.laid(
            p,
            (Self::square_term(l, link, on_bar), l.bar.pins[0].at),
            square_to(self.along(l, 0)),
            times,
        );
        p.diagonals.extend(p.sides.split_off(sides));
        std::mem::replace(&mut p.last, last)
    }

    /// Adds the forces at both pins of a bar: the force of the first link on it runs between the
    /// first two vertices, its loads from the second to the third.
    fn bar_sides(
        &mut self,
        p: &mut Polygon,
        bar: &PinnedBar,
        links: [LinkId; 2],
        [a, b, c]: [MarkId; 3],
    ) {
        for (k, [from, to]) in [(0, [a, b]), (1, [c, a])] {
            self.inner_side(p, bar.pins[k], [bar.link, links[k]], [from, to]);
            self.inner_side(p, bar.pins[k], [links[k], bar.link], [to, from]);
        }
    }
}
