//! Locates the centres in the pose: for each centre, in the order of finding, two lines are drawn
//! and crossed.
//!
//! A centre is at infinity only if topology requires it, or if the difference of the angular
//! velocities is certified to be zero. If all lines of a centre coincide in the pose, velocities
//! give its place where they can.

use hodograph_base::geom::Point;
use hodograph_board::construct::pencil::Hand;
use hodograph_mechanism::position::Path;
use hodograph_scene::{DriverKind, GuideId, PointId, Scene};
use hodograph_worked::worked::Worked;

use super::lines::{
    CentrePlace, ProjectiveFrame, ProjectiveUnit, Ruled, choose, meet, norm, volume,
};
use super::primary::Primary;
use super::rounds::{CentreClosure, CentreLocus, CentreMethod, CentreStep, LinkPair};
use super::velocities::Velocities;

/// A crossing farther away than this many sizes of the mechanism is tested for being at infinity.
const FAR: f64 = 1e7;

/// The reason for which lines do not give the place of a centre in this pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Undetermined {
    /// All lines that can be drawn coincide.
    LinesCoincide,
    /// Fewer than two lines can be drawn, because centres are missing or coincide.
    NoLines,
    /// The theorem gives no line, and the links have no relative motion from which the centre
    /// follows.
    NoMotion,
}

/// The origin of a centre's place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Origin {
    /// The kinematic pair of the two links.
    Pair,
    /// The crossing of these two lines.
    Crossing([CentreLocus; 2]),
    /// The velocities from the loop equations.
    Velocities,
}

/// A centre in the pose.
#[derive(Clone, Debug, PartialEq)]
pub struct Centre {
    /// The centre's step in the order of finding.
    pub step: CentreStep,
    /// The round in which the centre is found in this pose: later than topology predicts if its
    /// lines coincide.
    pub round: usize,
    /// The place, if it is known.
    pub place: Option<CentrePlace>,
    /// The origin of the place.
    pub origin: Option<Origin>,
    /// The reason for which the lines of the theorem do not give the place.
    pub why: Option<Undetermined>,
    /// The velocity of one link relative to the other at this place, divided by the largest
    /// velocity at its distance.
    pub residual: Option<f64>,
}

/// Locates all centres of a closure, round by round. A centre whose lines coincide in this pose is
/// postponed: later rounds may give another line for it. If no round does, the place of the first
/// postponed centre is computed from velocities, and the rounds continue.
pub(super) fn locate(
    scene: &Scene,
    worked: &Worked,
    closure: &CentreClosure,
    velocities: &Velocities,
) -> Vec<Centre> {
    let hand = Hand::default();
    let mut board =
        CentreSearch { scene, worked, closure, velocities, hand: &hand, list: Vec::new() };
    let last = closure.steps.last().map_or(0, |s| s.round);
    let mut waiting: Vec<(&CentreStep, Undetermined)> = Vec::new();
    let mut round = 0;
    while round <= last || !waiting.is_empty() {
        let mut found = Vec::new();
        let again = std::mem::take(&mut waiting);
        for (step, why) in again {
            match board.by_lines(step, &board.all_lines(step)) {
                Ok(place) => found.push(board.centre(step, round, place, None)),
                Err(_) => waiting.push((step, why)),
            }
        }
        for step in closure.steps.iter().filter(|s| s.round == round) {
            match board.find(step) {
                Ok(place) => found.push(board.centre(step, round, place, None)),
                Err(why) if step.how == CentreMethod::Velocities => {
                    found.push(board.centre(step, round, None, Some(why)))
                }
                Err(why) => waiting.push((step, why)),
            }
        }
        if found.is_empty() && round >= last && !waiting.is_empty() {
            let (step, why) = waiting.remove(0);
            let place =
                velocities.centre(step.pair, step.infinite).map(|p| (p, Origin::Velocities));
            found.push(board.centre(step, round, place, Some(why)));
        }
        board.list.extend(found);
        round += 1;
    }
    board.list
}

/// Draws the centres of `exact` once more with another hand: the same lines, crossed at other
/// marks. Centres that velocities give stay where they are.
pub(super) fn again(
    scene: &Scene,
    worked: &Worked,
    closure: &CentreClosure,
    velocities: &Velocities,
    exact: &[Centre],
    hand: &Hand,
) -> Vec<Option<CentrePlace>> {
    let mut board = CentreSearch { scene, worked, closure, velocities, hand, list: Vec::new() };
    for centre in exact {
        let place = match (&centre.step.how, centre.origin) {
            (CentreMethod::Primary(primary), Some(Origin::Pair)) => board.primary(*primary),
            (_, Some(Origin::Crossing(lines))) => board.crossing(
                centre.step.pair,
                lines,
                matches!(centre.place, Some(CentrePlace::Infinity(_))),
            ),
            (_, Some(Origin::Pair | Origin::Velocities) | None) => centre.place,
        };
        board.list.push(Centre { place, ..centre.clone() });
    }
    board.list.into_iter().map(|c| c.place).collect()
}

struct CentreSearch<'a> {
    scene: &'a Scene,
    worked: &'a Worked,
    closure: &'a CentreClosure,
    velocities: &'a Velocities<'a>,
    hand: &'a Hand,
    list: Vec<Centre>,
}

/// A place with its origin if it is known, or the reason for which the lines do not give it.
type LocatedCentre = Result<Option<(CentrePlace, Origin)>, Undetermined>;

impl CentreSearch<'_> {
    fn centre(
        &self,
        step: &CentreStep,
        round: usize,
        found: Option<(CentrePlace, Origin)>,
        why: Option<Undetermined>,
    ) -> Centre {
        let place = found.map(|f| f.0);
        let residual = place.and_then(|p| self.velocities.residual(step.pair, p));
        Centre { step: step.clone(), round, place, origin: found.map(|f| f.1), why, residual }
    }

    fn find(&self, step: &CentreStep) -> LocatedCentre {
        match &step.how {
            CentreMethod::Primary(primary) => Ok(self.primary(*primary).map(|p| (p, Origin::Pair))),
            CentreMethod::Velocities => {
                let place = self
                    .velocities
                    .centre(step.pair, step.infinite)
                    .ok_or(Undetermined::NoMotion)?;
                Ok(Some((place, Origin::Velocities)))
            }
            CentreMethod::Lines(lines) => self.by_lines(step, lines),
        }
    }

    fn primary(&self, primary: Primary) -> Option<CentrePlace> {
        let at = &self.worked.configuration;
        match primary {
            Primary::Pin(p) => self.mark(p).map(CentrePlace::At),
            Primary::Contact(r) => self.mark(self.scene.rolling[r.0].at[0]).map(CentrePlace::At),
            Primary::Strand(r) => {
                let [a, b] = self.scene.rolling[r.0].round()?.map(|p| self.mark(p));
                let ((a, b), [r1, r2]) = ((a?, b?), at.shapes.rolling[r.0]);
                if r1 + r2 == 0.0 {
                    CentrePlace::infinity(b - a)
                } else {
                    Some(CentrePlace::At(self.hand.mark(a + (b - a) * (r1 / (r1 + r2)))))
                }
            }
            Primary::Slide(g) => match at.guides[g.0]? {
                Path::Line { direction, .. } => {
                    CentrePlace::infinity(self.hand.ruler(direction, at.extent()).perp())
                }
                Path::Arc { centre, .. } => Some(CentrePlace::At(self.hand.given(centre))),
            },
            Primary::Cylinder(d) => match self.scene.drivers[d].kind {
                DriverKind::Cylinder { a, b, .. } => {
                    CentrePlace::infinity((self.mark(b)? - self.mark(a)?).perp())
                }
                DriverKind::Turn { .. } | DriverKind::Slide { .. } => None,
            },
        }
    }

    /// Returns the mark of a point.
    fn mark(&self, p: PointId) -> Option<Point> {
        self.worked.configuration.points[p.0].map(|at| self.hand.given(at))
    }

    /// Returns the crossing of two lines of a pair.
    fn crossing(
        &self,
        pair: LinkPair,
        lines: [CentreLocus; 2],
        infinite: bool,
    ) -> Option<CentrePlace> {
        let [a, b] = [self.ruled(pair, lines[0])?, self.ruled(pair, lines[1])?];
        let place = self.frame().place(meet(a.line, b.line)?, infinite)?;
        Some(if let CentrePlace::At(p) = place {
            CentrePlace::At(self.hand.mark(p))
        } else {
            place
        })
    }

    fn frame(&self) -> ProjectiveFrame {
        self.velocities.frame
    }

    /// Returns the lines of a step, and those through every other link.
    fn all_lines(&self, step: &CentreStep) -> Vec<CentreLocus> {
        let mut lines =
            if let CentreMethod::Lines(lines) = &step.how { lines.clone() } else { Vec::new() };
        for k in self.closure.links.iter().filter(|k| !step.pair.has(**k)) {
            if !lines.contains(&CentreLocus::Through(*k)) {
                lines.push(CentreLocus::Through(*k));
            }
        }
        lines
    }

    fn by_lines(&self, step: &CentreStep, lines: &[CentreLocus]) -> LocatedCentre {
        let drawn: Vec<(CentreLocus, Ruled)> =
            lines.iter().filter_map(|l| Some((*l, self.ruled(step.pair, *l)?))).collect();
        let ruled: Vec<Ruled> = drawn.iter().map(|d| d.1).collect();
        let none =
            if ruled.len() < 2 { Undetermined::NoLines } else { Undetermined::LinesCoincide };
        let ([k, l], at) = choose(&ruled).ok_or(none)?;
        let origin = Origin::Crossing([drawn[k].0, drawn[l].0]);
        let far = at[2].abs() * FAR <= norm([at[0], at[1], 0.0]);
        let infinite = step.infinite || far && self.velocities.surely_translate(step.pair);
        // Parallel to rounding, and not certainly at infinity: the lines do not give the distance.
        if !infinite && at[2].abs() <= f64::EPSILON * 16.0 {
            return Err(Undetermined::LinesCoincide);
        }
        Ok(Some((self.frame().place(at, infinite).ok_or(none)?, origin)))
    }

    fn placed(&self, pair: LinkPair) -> Option<ProjectiveUnit> {
        let place = self.list.iter().find(|c| c.step.pair == pair)?.place?;
        Some(self.frame().of(place))
    }

    fn ruled(&self, pair: LinkPair, line: CentreLocus) -> Option<Ruled> {
        match line {
            CentreLocus::Through(k) => Ruled::through(
                self.placed(self.closure.pair(pair.i, k))?,
                self.placed(self.closure.pair(k, pair.j))?,
            ),
            CentreLocus::Normal(g) => {
                let [pin, square] = normal(self.scene, self.worked, g, self.hand)?;
                Ruled::through(self.frame().of(pin), self.frame().of(square))
            }
            CentreLocus::Infinity => {
                Some(Ruled { line: [0.0, 0.0, 1.0], through: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] })
            }
        }
    }
}

/// Returns the normal of a slot at its pin: the place of the pin, and the direction as a place at
/// infinity.
pub(super) fn normal(
    scene: &Scene,
    worked: &Worked,
    g: GuideId,
    hand: &Hand,
) -> Option<[CentrePlace; 2]> {
    let pin = hand.given(worked.configuration.points[scene.guides[g.0].pin?.0]?);
    let direction = match worked.configuration.guides[g.0]? {
        Path::Line { direction, .. } => hand.ruler(direction, worked.configuration.extent()).perp(),
        Path::Arc { centre, .. } => hand.given(centre) - pin,
    };
    Some([CentrePlace::At(pin), CentrePlace::infinity(direction)?])
}

/// Returns the largest deviation from collinearity of all triples P_ij, P_jk, P_ik, as the volume
/// of their unit vectors. Links without relative motion (a rigid triangle) have every place as a
/// centre: their centres are left out.
pub(super) fn worst_triple(
    velocities: &Velocities,
    closure: &CentreClosure,
    list: &[Centre],
) -> f64 {
    let frame = velocities.frame;
    let n = closure.links.len();
    let rank = |l| closure.links.iter().position(|k| *k == l).unwrap_or(0);
    let mut places: Vec<Option<ProjectiveUnit>> = vec![None; n * n];
    for c in list.iter().filter(|c| !velocities.rests(c.step.pair)) {
        let (i, j) = (rank(c.step.pair.i), rank(c.step.pair.j));
        places[i * n + j] = c.place.map(|p| frame.of(p));
    }
    let mut worst = 0.0f64;
    for i in 0..n {
        for j in i + 1..n {
            for k in j + 1..n {
                if let (Some(a), Some(b), Some(c)) =
                    (places[i * n + j], places[j * n + k], places[i * n + k])
                {
                    worst = worst.max(volume(a, b, c));
                }
            }
        }
    }
    worst
}
