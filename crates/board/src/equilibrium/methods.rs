//! The methods: moments and polygon for each kind of group.

use super::answers::reaction;
use super::joints::{DyadJoint, Hinge, Joints, OuterJoint};
use super::scribe::{ActingForce, Polygon, Scribe, square_to};
use super::{About, ForceTerm, MomentResult, Party, ReactionComponent};
use crate::construction::{Base, Direction, Key, MarkId, Number, NumberId};
use hodograph_base::diag::Both;
use hodograph_mechanism::position::Configuration;
use hodograph_scene::{GuideId, LinkId, PointId};

/// Returns the direction of a straight guide.
pub(super) fn tangent(guide: GuideId) -> Base {
    Base::Tangent(Key::of(guide.0), None)
}

/// Returns the direction square to a straight guide.
pub(super) fn normal(guide: GuideId) -> Direction {
    square_to(tangent(guide))
}

impl Scribe<'_> {
    /// Writes the equilibrium of a group by the method of its kind.
    ///
    /// # Errors
    /// A kind without a method.
    pub(super) fn group(
        &mut self,
        links: &[LinkId],
        joints: &Joints,
        at: &Configuration,
    ) -> Result<(), Both> {
        match (links, &joints.inner[..], &joints.outer[..]) {
            ([a, b], [DyadJoint::Pin(c)], [x, y]) => {
                let on =
                    |link: LinkId| [x, y].into_iter().copied().find(|o| carries(o) == Some(link));
                let (Some(first), Some(second)) = (on(*a), on(*b)) else {
                    return Err(joints.no_method(self.scene, links));
                };
                let bears =
                    |o: &OuterJoint| matches!(o, OuterJoint::Pin { .. } | OuterJoint::Slide { .. });
                if !bears(&first) || !bears(&second) {
                    return Err(joints.no_method(self.scene, links));
                }
                self.on_a_pin([&[*a], &[*b]], *c, [first, second]);
                Ok(())
            }
            (
                [_, _, _],
                [DyadJoint::Pin(c), DyadJoint::Slide { guide, slider, on }]
                | [DyadJoint::Slide { guide, slider, on }, DyadJoint::Pin(c)],
                [x, y],
            ) => match self.ram(links, *c, (*guide, *slider, *on), [*x, *y]) {
                Some((ram, moved, outer)) => {
                    self.on_a_ram(&ram, moved, *c, outer);
                    Ok(())
                }
                None => self.on_three_legs(links, joints, at),
            },
            ([_, _], [DyadJoint::Slide { guide, slider, on }], [x, y]) => {
                let of =
                    |link: LinkId| [x, y].into_iter().copied().find(|o| carries(o) == Some(link));
                match (of(*slider), of(*on)) {
                    (
                        Some(OuterJoint::Pin { hinge, .. }),
                        Some(OuterJoint::Pin { hinge: pivot, .. }),
                    ) => {
                        self.sliding([*slider, *on], *guide, [hinge, pivot]);
                        Ok(())
                    }
                    (
                        Some(pin @ OuterJoint::Pin { .. }),
                        Some(slide @ OuterJoint::Slide { .. }),
                    ) => {
                        self.twice_sliding([*slider, *on], *guide, [pin, slide]);
                        Ok(())
                    }
                    (
                        Some(slide @ OuterJoint::Slide { .. }),
                        Some(pin @ OuterJoint::Pin { .. }),
                    ) => {
                        self.twice_sliding([*on, *slider], *guide, [pin, slide]);
                        Ok(())
                    }
                    _ => Err(joints.no_method(self.scene, links)),
                }
            }
            ([link], [], [x, y]) => match (*x, *y) {
                (OuterJoint::Pin { hinge, .. }, OuterJoint::Turn { driver, against, .. }) => {
                    self.driven(*link, hinge, driver, against);
                    Ok(())
                }
                (
                    pin @ OuterJoint::Pin { .. },
                    touch @ (OuterJoint::Slot { .. }
                    | OuterJoint::Mesh { .. }
                    | OuterJoint::Cylinder { .. }
                    | OuterJoint::Balance { .. }
                    | OuterJoint::Push { .. }),
                )
                | (
                    touch @ (OuterJoint::Slot { .. }
                    | OuterJoint::Mesh { .. }
                    | OuterJoint::Cylinder { .. }),
                    pin @ OuterJoint::Pin { .. },
                ) => {
                    self.on_a_pivot(*link, pin, touch);
                    Ok(())
                }
                (
                    slide @ OuterJoint::Slide { .. },
                    touch @ (OuterJoint::Slot { .. }
                    | OuterJoint::Mesh { .. }
                    | OuterJoint::Cylinder { .. }
                    | OuterJoint::Balance { .. }
                    | OuterJoint::Push { .. }),
                )
                | (
                    touch @ (OuterJoint::Slot { .. }
                    | OuterJoint::Mesh { .. }
                    | OuterJoint::Cylinder { .. }),
                    slide @ OuterJoint::Slide { .. },
                ) => {
                    self.in_a_guide(*link, slide, touch);
                    Ok(())
                }
                _ => Err(joints.no_method(self.scene, links)),
            },
            ([_, _, _, _], [_, _, _, _], [_, _]) => self.on_two_bars(links, joints, at),
            (_, inner, outer) if outer.len() > 2 && inner.len() == 2 * outer.len() => {
                self.on_a_ring(links, joints)
            }
            _ => self.on_three_legs(links, joints, at),
        }
    }

    /// Writes RRR, RRP, PRP: two links on an inner pin. Either may consist of two links that a
    /// driver holds together; the last of them has the pin.
    fn on_a_pin(&mut self, bodies: [&[LinkId]; 2], inner: Hinge, outer: [OuterJoint; 2]) {
        let kind = match outer.map(|o| matches!(o, OuterJoint::Pin { .. })) {
            [true, true] => "RRR",
            [false, false] => "PRP",
            _ => "RRP",
        };
        let (p, ..) = self.around_a_pin(bodies, inner, outer);
        self.finish(p, &bodies.concat(), kind);
    }

    /// Returns the polygon of two bodies on an inner pin, the loads of the last link of the first
    /// body, and the vertices around this link and around the force of the pin.
    pub(super) fn around_a_pin(
        &mut self,
        bodies: [&[LinkId]; 2],
        inner: Hinge,
        outer: [OuterJoint; 2],
    ) -> (Polygon, Vec<ActingForce>, [MarkId; 3]) {
        let held = |o: &OuterJoint| {
            if let OuterJoint::Pin { hinge, .. } = *o { vec![hinge, inner] } else { vec![inner] }
        };
        let links = bodies.map(|body| body[body.len() - 1]);
        // In the polygon, the forces on the link with the inner pin are adjacent to the pin's
        // force.
        let pinned = [0, 1].map(|k| self.all_on(links[k], &held(&outer[k])));
        let others = [0, 1].map(|k| {
            let others = &bodies[k][..bodies[k].len() - 1];
            others
                .iter()
                .flat_map(|l| self.all_on(*l, &held(&outer[k])))
                .collect::<Vec<ActingForce>>()
        });
        let acting = [[&others[0][..], &pinned[0]].concat(), [&pinned[1][..], &others[1]].concat()];
        let mut ops = Vec::new();
        let mut moments = Vec::new();
        // The part square to the bar, if a load has a moment about the inner pin.
        let parts = [0, 1].map(|k| {
            let OuterJoint::Pin { hinge: Hinge { at, .. }, .. } = outer[k] else { return None };
            if acting[k].is_empty() {
                return None;
            }
            let term = reaction(&outer[k], ReactionComponent::Tangential)?;
            let of = self.moments(
                &mut ops,
                bodies[k],
                &acting[k],
                About::Point(inner.at),
                MomentResult::Force(term, at),
            );
            let bar = Base::Arm { from: self.mark(inner.at), to: self.mark(at), known: false };
            Some(((term, at), self.across(&mut ops, &mut moments, of, bar)?, bar))
        });
        self.on_plane(ops);
        let mut p = self.polygon();
        p.moments = moments;
        let start = p.last;
        if let Some((term, value, bar)) = parts[0] {
            self.laid(&mut p, term, square_to(bar), value);
        }
        let first = p.last;
        self.lay_all(&mut p, &others[0]);
        let between = p.last;
        self.lay_all(&mut p, &pinned[0]);
        let before = p.last;
        let on_pin = inner.pin().map_or_else(Vec::new, |pin| self.pin_loads(pin, links[0]));
        self.lay_all(&mut p, &on_pin);
        let after = p.last;
        self.lay_all(&mut p, &acting[1]);
        let second = p.last;
        if let Some((term, value, bar)) = parts[1] {
            self.laid(&mut p, term, square_to(bar), value);
        }
        let end = p.last;
        let along = |s: &Self, o: &OuterJoint| match *o {
            OuterJoint::Pin { hinge, .. } => Direction::of(Base::Arm {
                from: s.mark(inner.at),
                to: s.mark(hinge.at),
                known: false,
            }),
            OuterJoint::Slide { guide, .. } => normal(guide),
            OuterJoint::Slot { .. }
            | OuterJoint::Mesh { .. }
            | OuterJoint::Cylinder { .. }
            | OuterJoint::Turn { .. }
            | OuterJoint::Balance { .. }
            | OuterJoint::Push { .. } => Direction::of(Base::Given(Key(0))),
        };
        let directions = [along(self, &outer[0]), along(self, &outer[1])];
        let lines =
            [self.line(&mut p, start, directions[0]), self.line(&mut p, end, directions[1])];
        let x = self.meet(&mut p, lines);
        for (k, ends, whole) in [(0, [x, start], [x, first]), (1, [end, x], [second, x])] {
            let split = parts[k].is_some();
            let part = if split { ReactionComponent::Normal } else { ReactionComponent::Whole };
            let at = place(&outer[k]).unwrap_or(inner.at);
            if let Some(term) = reaction(&outer[k], part) {
                self.side(&mut p, (term, at), ends, k == 0);
            }
            if let (true, Some(term)) = (split, reaction(&outer[k], ReactionComponent::Whole)) {
                self.diagonal(&mut p, (term, at), whole);
            }
        }
        self.inner_pin(&mut p, inner, links, [before, x, after]);
        for (k, whole) in [(0, [x, first]), (1, [second, x])] {
            match outer[k] {
                OuterJoint::Pin { hinge, on, .. } => self.pinned(&mut p, hinge, on, whole),
                OuterJoint::Slide { on, .. } => {
                    let inner_ends = if k == 0 { [before, x] } else { [x, after] };
                    let force = self.measured(&mut p, inner_ends[0], inner_ends[1]);
                    let of = Party::Link(links[1 - k]);
                    let inside = ActingForce {
                        term: ForceTerm::Reaction { of, on, part: ReactionComponent::Whole },
                        force: Some((Base::Measured(force), inner.at)),
                        couple: None,
                    };
                    let all: Vec<ActingForce> = acting[k].iter().copied().chain([inside]).collect();
                    self.offset(&mut p, outer[k], &all, whole);
                }
                OuterJoint::Slot { .. }
                | OuterJoint::Mesh { .. }
                | OuterJoint::Cylinder { .. }
                | OuterJoint::Turn { .. }
                | OuterJoint::Balance { .. }
                | OuterJoint::Push { .. } => {}
            }
        }
        let [loads, _] = pinned;
        (p, loads, [between, before, x])
    }

    /// Finds the couple of an outer guide about its point from all other forces on its link, and
    /// adds it to the answers and to the loads of the other link.
    pub(super) fn offset(
        &mut self,
        p: &mut Polygon,
        slide: OuterJoint,
        acting: &[ActingForce],
        ends: [MarkId; 2],
    ) {
        let OuterJoint::Slide { guide, on, at, .. } = slide else { return };
        let mut moments =
            self.moments(&mut p.ops, &[on], acting, About::Point(at), MomentResult::Offset(guide));
        let couple = self.balancing(&mut p.ops, &moments);
        moments.value = couple;
        p.moments.push(moments);
        self.guided(p, slide, ends, couple);
    }

    /// Writes RPR: a slider pinned at `at` on a lever pinned at `pivot`.
    fn sliding(&mut self, links: [LinkId; 2], guide: GuideId, hinges: [Hinge; 2]) {
        let [slider, lever] = links;
        let [at, pivot] = hinges.map(|hinge| hinge.at);
        let place = self.reference(guide).unwrap_or(at);
        let acting = [self.all_on(slider, &[hinges[0]]), self.all_on(lever, &[hinges[1]])];
        let mut p = self.polygon();
        let start = p.last;
        self.lay_all(&mut p, &acting[0]);
        let loaded = p.last;
        let of = super::joints::party(self.scene, hinges[0], slider);
        let part = |part| ForceTerm::Reaction { of, on: slider, part };
        let mut all: Vec<ActingForce> = acting.concat();
        if loaded != start {
            // No other force acts on the slider along the guide.
            let loads = self
                .number(&mut p.ops, Number::Along(start, loaded, Direction::of(tangent(guide))));
            let along = self.number(&mut p.ops, Number::Negative(loads));
            self.laid(
                &mut p,
                (part(ReactionComponent::Tangential), at),
                Direction::of(tangent(guide)).unit(),
                along,
            );
            let last = p.last;
            let force = self.measured(&mut p, loaded, last);
            all.push(ActingForce {
                term: part(ReactionComponent::Tangential),
                force: Some((Base::Measured(force), at)),
                couple: None,
            });
        }
        let whole = loaded != start;
        let term = part(if whole { ReactionComponent::Normal } else { ReactionComponent::Whole });
        let mut moments = self.moments(
            &mut p.ops,
            &links,
            &all,
            About::Point(pivot),
            MomentResult::Force(term, at),
        );
        let turning = self.balancing(&mut p.ops, &moments);
        let arm = self.number(
            &mut p.ops,
            Number::Along(self.mark(pivot), self.mark(at), Direction::of(tangent(guide))),
        );
        let across = self.number(&mut p.ops, Number::Quotient(turning, arm));
        moments.value = across;
        p.moments.push(moments);
        self.laid(&mut p, (term, at), normal(guide), across);
        let held = p.last;
        self.lay_all(&mut p, &acting[1]);
        let end = p.last;
        let by = super::joints::party(self.scene, hinges[1], lever);
        self.side(
            &mut p,
            (ForceTerm::Reaction { of: by, on: lever, part: ReactionComponent::Whole }, pivot),
            [end, start],
            false,
        );
        if whole {
            self.diagonal(&mut p, (part(ReactionComponent::Whole), at), [loaded, held]);
        }
        for (on, other, ends) in [(slider, lever, [held, start]), (lever, slider, [start, held])] {
            self.diagonal(
                &mut p,
                (
                    ForceTerm::Reaction {
                        of: Party::Link(other),
                        on,
                        part: ReactionComponent::Whole,
                    },
                    place,
                ),
                ends,
            );
        }
        self.pinned(&mut p, hinges[0], slider, [loaded, held]);
        self.pinned(&mut p, hinges[1], lever, [end, start]);
        self.inner_guide(&mut p, guide, slider, (at, place), &acting[0], [held, start]);
        self.finish(p, &links, "RPR");
    }

    /// Finds the couple of an inner guide on a link pinned at `pin`, and adds it to the answers;
    /// `place` is the reference point of the force. Returns the couple.
    pub(super) fn inner_guide(
        &mut self,
        p: &mut Polygon,
        guide: GuideId,
        on: LinkId,
        (pin, place): (PointId, PointId),
        acting: &[ActingForce],
        ends: [MarkId; 2],
    ) -> NumberId {
        let force = self.measured(p, ends[0], ends[1]);
        let of = Party::Link(if self.scene.guides[guide.0].slider == Some(on) {
            self.scene.guides[guide.0].on
        } else {
            self.scene.guides[guide.0].slider.unwrap_or(on)
        });
        let own = ActingForce {
            term: ForceTerm::Reaction { of, on, part: ReactionComponent::Whole },
            force: Some((Base::Measured(force), place)),
            couple: None,
        };
        let all: Vec<ActingForce> = acting.iter().copied().chain([own]).collect();
        let mut moments =
            self.moments(&mut p.ops, &[on], &all, About::Point(pin), MomentResult::Offset(guide));
        let couple = self.balancing(&mut p.ops, &moments);
        moments.value = couple;
        p.moments.push(moments);
        let of_slider = self.scene.guides[guide.0].slider == Some(on);
        let answer = if of_slider {
            (guide, force, Some(couple))
        } else {
            let back = self.measured(p, ends[1], ends[0]);
            let opposite = self.number(&mut p.ops, Number::Negative(couple));
            (guide, back, Some(opposite))
        };
        self.answers.guides.push(answer);
        couple
    }

    /// Writes RPP: the first link is pinned and slides on the second, which slides in an outer
    /// guide.
    fn twice_sliding(&mut self, links: [LinkId; 2], guide: GuideId, outer: [OuterJoint; 2]) {
        let (OuterJoint::Pin { hinge, .. }, OuterJoint::Slide { guide: outside, at: counted, .. }) =
            (outer[0], outer[1])
        else {
            return;
        };
        let ([pinned, sliding], at) = (links, hinge.at);
        let place = self.reference(guide).unwrap_or(at);
        let acting = [self.all_on(pinned, &[hinge]), self.all_on(sliding, &[])];
        let mut p = self.polygon();
        let start = p.last;
        self.lay_all(&mut p, &acting[1]);
        let end = p.last;
        let lines =
            [self.line(&mut p, start, normal(guide)), self.line(&mut p, end, normal(outside))];
        let x = self.meet(&mut p, lines);
        self.side(
            &mut p,
            (
                ForceTerm::Reaction {
                    of: Party::Link(pinned),
                    on: sliding,
                    part: ReactionComponent::Whole,
                },
                place,
            ),
            [x, start],
            true,
        );
        if let Some(term) = reaction(&outer[1], ReactionComponent::Whole) {
            self.side(&mut p, (term, counted), [end, x], false);
        }
        // The pinned link: its loads from the crossing on, then the closing side.
        p.last = x;
        let inner = ForceTerm::Reaction {
            of: Party::Link(sliding),
            on: pinned,
            part: ReactionComponent::Whole,
        };
        self.diagonal(&mut p, (inner, place), [start, x]);
        self.lay_all(&mut p, &acting[0]);
        let close = p.last;
        if let Some(term) = reaction(&outer[0], ReactionComponent::Whole) {
            self.side(&mut p, (term, at), [close, start], false);
        }
        self.pinned(&mut p, hinge, pinned, [close, start]);
        let couple = self.inner_guide(&mut p, guide, pinned, (at, place), &acting[0], [start, x]);
        let back = self.number(&mut p.ops, Number::Negative(couple));
        let force = self.measured(&mut p, x, start);
        let inside = ActingForce {
            term: ForceTerm::Reaction {
                of: Party::Link(pinned),
                on: sliding,
                part: ReactionComponent::Whole,
            },
            force: Some((Base::Measured(force), place)),
            couple: Some(back),
        };
        let all: Vec<ActingForce> = acting[1].iter().copied().chain([inside]).collect();
        self.offset(&mut p, outer[1], &all, [end, x]);
        self.finish(p, &links, "RPP");
    }
}

/// Returns the link of the group that an outer joint holds.
pub(super) fn carries(outer: &OuterJoint) -> Option<LinkId> {
    match *outer {
        OuterJoint::Pin { on, .. }
        | OuterJoint::Slide { on, .. }
        | OuterJoint::Slot { on, .. }
        | OuterJoint::Mesh { on, .. }
        | OuterJoint::Cylinder { on, .. }
        | OuterJoint::Balance { on, .. }
        | OuterJoint::Turn { on, .. } => Some(on),
        OuterJoint::Push { .. } => None,
    }
}

/// Returns a point on the line of action of an outer joint's force.
fn place(outer: &OuterJoint) -> Option<PointId> {
    match *outer {
        OuterJoint::Pin { hinge: Hinge { at, .. }, .. }
        | OuterJoint::Slide { at, .. }
        | OuterJoint::Slot { at, .. }
        | OuterJoint::Mesh { at, .. }
        | OuterJoint::Balance { at, .. }
        | OuterJoint::Cylinder { at, .. } => Some(at),
        OuterJoint::Turn { .. } | OuterJoint::Push { .. } => None,
    }
}
