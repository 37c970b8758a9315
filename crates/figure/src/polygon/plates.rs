//! Splits a polygon of many vectors by group: each plate shows the vectors that one group adds, to
//! its own scale, with the known vectors from which it starts in grey.

use std::collections::HashMap;

use hodograph_base::geom::Point;
use hodograph_board::construct::{Action, Polygon, PolygonMark, scale};
use hodograph_board::plan::text::PlanWriter;
use hodograph_board::plan::{GroupSteps, VertexId};
use hodograph_mechanism::mechanism::Mechanism;
use hodograph_paper::paper::drawing::{Drawing, DrawingPart};
use hodograph_paper::paper::item::Colour;
use hodograph_paper::paper::style::Style;

use super::{MANY_ARROWS, PolygonDraft, is_one};

/// Space for a plate: beside its equations on an A4 page in landscape.
const ROOM_MM: [f64; 2] = [125.0, 120.0];
/// Colour of known vectors: visible, but distinct from the plate's own.
const KNOWN: Colour = Colour::grey(150);

/// Maximum number of vectors of combined groups; vectors that are found together may be more.
const MOST_TOGETHER: usize = 10;

/// The vectors that a group adds to a polygon.
pub struct GroupPlate {
    /// The group, by its index in the mechanism's list, followed by pins that only belong to its
    /// links.
    pub groups: Vec<usize>,
    /// The scale (SI units per mm).
    pub mu: f64,
    /// The drawing, with its pole at the origin.
    pub part: DrawingPart,
}

/// A selected part of a split polygon.
#[derive(Clone, Copy)]
pub struct Share<'a> {
    /// The part of each action ([`shares`]).
    pub of: &'a [usize],
    /// The selected part.
    pub part: usize,
}

impl Share<'_> {
    /// Returns true if an action belongs to the part.
    pub fn holds(&self, action: usize) -> bool {
        self.of.get(action) == Some(&self.part)
    }

    /// Returns the ends of the part's vectors and the points that they find, on paper, in an order
    /// that poses with the same actions share; the pole is not included.
    pub fn ends(&self, p: &Polygon) -> Vec<Option<Point>> {
        let mut ends = Vec::new();
        for (_, action) in p.actions.iter().enumerate().filter(|(k, _)| self.holds(*k)) {
            ends.extend(
                action
                    .edges()
                    .iter()
                    .flat_map(|e| [p.edges[*e].from.1, p.edges[*e].to.1])
                    .map(Some),
            );
            ends.extend(action.finds().map(|v| p.images[v.0]));
        }
        ends
    }
}

/// Returns the part that each action of a polygon belongs to, counted from 0. The polygon is split
/// so that about ten vectors at most are together: groups are combined, in solving order, to as few
/// parts as possible. A single part is no split.
pub fn shares(w: &PlanWriter, mechanism: &Mechanism, p: &Polygon) -> Vec<usize> {
    let heads = heads(w, mechanism, p);
    let of: Vec<usize> = groups_of_actions(w, p)
        .into_iter()
        .map(|group| {
            group.and_then(|g| heads.iter().position(|head| head.contains(&g))).unwrap_or(0)
        })
        .collect();
    let mut sizes = vec![0; heads.len()];
    p.actions.iter().zip(&of).for_each(|(action, head)| {
        sizes[*head] += action.edges().len() + usize::from(action.finds().is_some())
    });
    let (mut part, mut held) = (0, 0);
    let part_of: Vec<usize> = sizes
        .iter()
        .map(|size| {
            if held > 0 && held + size > MOST_TOGETHER {
                (part, held) = (part + 1, 0);
            }
            held += size;
            part
        })
        .collect();
    of.into_iter().map(|head| part_of[head]).collect()
}

/// Draws a part of a split polygon before its labels are placed; `None` if it has no vector. `full`
/// as for [`super::drawing`].
pub fn share_drawing(
    style: &Style,
    w: &PlanWriter,
    p: &Polygon,
    share: Share,
    full: bool,
) -> Option<Drawing> {
    let draft = PolygonDraft::of(w, p).only(&|step| share.holds(step))?;
    let mut style = style.clone();
    if full {
        style.label_mm = style.small_mm;
    }
    Some(draft.draw(&style, &[]).0)
}

/// Returns true if a part of a split polygon has more vectors than can be named in type of the
/// usual size.
pub fn is_full_share(w: &PlanWriter, p: &Polygon, share: Share) -> bool {
    PolygonDraft::of(w, p)
        .only(&|step| share.holds(step))
        .is_some_and(|draft| draft.arrows.len() > MANY_ARROWS)
}

/// The groups that start a plate, each followed by the pins that only belong to its links.
fn heads(w: &PlanWriter, mechanism: &Mechanism, p: &Polygon) -> Vec<Vec<usize>> {
    let mut heads: Vec<Vec<usize>> = Vec::new();
    for group in w.plan.steps(p.on).iter().map(|g| g.group) {
        match heads.last_mut() {
            Some(head) if mechanism.groups[group].is_carried() => head.push(group),
            _ => heads.push(vec![group]),
        }
    }
    heads
}

/// Returns the plates of a polygon in solving order; groups that add no vector have none.
pub fn plates(
    style: &Style,
    w: &PlanWriter,
    mechanism: &Mechanism,
    p: &Polygon,
) -> Vec<GroupPlate> {
    let heads = heads(w, mechanism, p);
    let of = groups_of_actions(w, p);
    let of_head = |groups: Vec<usize>| {
        let mine =
            |step: usize| of.get(step).copied().flatten().is_some_and(|g| groups.contains(&g));
        let (mu, part) = plate(style, w, p, &mine)?;
        Some(GroupPlate { groups, mu, part })
    };
    heads.into_iter().filter_map(of_head).collect()
}

fn plate(
    style: &Style,
    w: &PlanWriter,
    p: &Polygon,
    mine: &dyn Fn(usize) -> bool,
) -> Option<(f64, DrawingPart)> {
    let (draft, _) = PolygonDraft::new(style, w, p, false);
    let shown = draft.only(mine)?;
    let ends: Vec<Point> =
        shown.arrows.iter().flat_map(|a| [a.from, a.to]).chain([Point::ORIGIN]).collect();
    let over = |f: fn(&Point) -> f64| {
        let all = ends.iter().map(f);
        all.clone().fold(f64::NEG_INFINITY, f64::max) - all.fold(f64::INFINITY, f64::min)
    };
    let mu = scale::choose_in(
        w.scene.book.size(p.on.kind()),
        [over(|q| q.x) * p.mu, over(|q| q.y) * p.mu],
        ROOM_MM,
    );
    let own = p.to_scale(mu);
    let mut draft = PolygonDraft::of(w, &own).only(mine)?;
    draft.side_by_side(style.vector.width_mm);
    let part = draft.named(style, Some(f64::INFINITY), &Drawing::finish);
    Some((mu, part))
}

/// The group of the image point that each action finds or helps to find; an action that reads
/// between image points belongs to the group before it.
fn groups_of_actions(w: &PlanWriter, p: &Polygon) -> Vec<Option<usize>> {
    let mut of: HashMap<VertexId, usize> = HashMap::new();
    for GroupSteps { group, alternatives, further, .. } in w.plan.steps(p.on) {
        for step in alternatives.iter().flatten().chain(further) {
            of.entry(step.target()).or_insert(*group);
        }
    }
    let laid = |action: &Action| {
        let Action::LayOff(e) = action else { return None };
        match p.edges[*e].to.0 {
            PolygonMark::Image(v) => Some(v),
            PolygonMark::Pole | PolygonMark::Part(_) | PolygonMark::Again(_) => None,
        }
    };
    let found: Vec<Option<usize>> = p
        .actions
        .iter()
        .map(|action| action.finds().or_else(|| laid(action)).and_then(|v| of.get(&v).copied()))
        .collect();
    let mut out = vec![None; found.len()];
    let mut before = None;
    for (k, action) in p.actions.iter().enumerate() {
        let next = || found[k..].iter().flatten().next().copied();
        out[k] = if action.reads() { before } else { next().or(before) };
        before = out[k].or(before);
    }
    out
}

impl PolygonDraft<'_> {
    /// Keeps the elements that these steps draw, and in grey the vectors from which they start;
    /// `None` if they draw no vector.
    fn only(mut self, mine: &dyn Fn(usize) -> bool) -> Option<Self> {
        let own = |steps: &[usize]| steps.iter().any(|s| mine(*s));
        let ends: Vec<Point> =
            self.arrows.iter().filter(|a| own(&a.steps)).flat_map(|a| [a.from, a.to]).collect();
        if ends.is_empty() {
            return None;
        }
        let corners: Vec<Point> = self
            .copies
            .iter()
            .filter(|c| mine(c.1))
            .flat_map(|c| c.0)
            .filter_map(|v| self.p.images[v.0])
            .collect();
        let touches = |p: Point| ends.iter().chain(&corners).any(|q| is_one(*q, p));
        self.arrows.retain_mut(|a| {
            if !own(&a.steps) {
                a.colour = KNOWN;
            }
            own(&a.steps) || is_one(a.from, Point::ORIGIN) && touches(a.to)
        });
        self.lines.retain(|l| mine(l.2));
        self.copies.retain(|c| mine(c.1));
        self.zeros.retain(|z| mine(z.step));
        let kept: Vec<Point> = self
            .arrows
            .iter()
            .flat_map(|a| [a.from, a.to])
            .chain(corners)
            .chain([Point::ORIGIN])
            .collect();
        self.letters.retain(|l| kept.iter().any(|q| is_one(l.at, *q)));
        Some(self)
    }
}
