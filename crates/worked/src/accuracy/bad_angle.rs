//! Crossings under a bad angle, and the remedies in each case: only remedies that a trial found to
//! help are proposed.

use super::drafting::{CrossingTolerance, DraftedConstruction, Tolerance, crossings, drafting};
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::digits::{shortest, significant};
use hodograph_base::lang::each;
use hodograph_board::construct::pencil::Exact;
use hodograph_board::construct::{Action, Acts, Layout, PlanDrawing};
use hodograph_board::plan::text::{held_by, vertex_name};
use hodograph_board::plan::{PlanStep, VertexId, VertexPlace};
use hodograph_mechanism::position::Configuration;
use hodograph_mechanism::position::newton::{driver_values, moved};
use hodograph_scene::{DiagramKind, Kind};
use std::collections::BTreeMap;

/// The angle (degrees) below which a pencil error is magnified more than five times (1 / sin 10° =
/// 5.8): the reader is warned.
pub const BAD_DEG: f64 = 10.0;
/// The angle (degrees) from which on a pencil error is magnified less than three times: a pose with
/// such crossings is proposed.
const GOOD_DEG: f64 = 20.0;
/// The greatest angle by which the driver is turned in search of a pose, and the step: a pose
/// further away is another problem.
const SEARCH_DEG: f64 = 30.0;
const SEARCH_STEP_DEG: f64 = 5.0;

/// The number of crossings above which nothing is tried: each trial draws the whole construction
/// anew.
const MANY: usize = 100;

/// A crossing under a bad angle.
#[derive(Clone, Debug, PartialEq)]
pub struct BadAngle {
    /// The crossing; that of the velocity polygon if both polygons have it (the angle is the same).
    pub crossing: CrossingTolerance,
    /// The pencil error for which it is judged (mm).
    pub pencil_mm: f64,
    /// The enlargement with which every answer is within 1 %; `None` if it is within 1 % without,
    /// or if A0 is too small.
    pub larger: Option<f64>,
    /// Another special point of the triad that gives no crossing under a bad angle and a better
    /// worst answer.
    pub special: Option<OtherPoint>,
    /// A pose nearby in which the lines cross under a good angle.
    pub pose: Option<NearbyPose>,
}

/// Another special point of a triad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OtherPoint {
    /// The group.
    pub group: usize,
    /// The two legs with constraint lines through the point.
    pub legs: (usize, usize),
    /// The worst angle of its crossings (degrees).
    pub worst_deg: f64,
}

/// A nearby pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearbyPose {
    /// The driver to turn.
    pub driver: usize,
    /// The angle of the turn (degrees, counter-clockwise positive).
    pub turn_deg: f64,
    /// The driver's angle in the pose, in the scene's count (degrees); `None` if the scene gives
    /// the pose otherwise.
    pub to_deg: Option<f64>,
    /// The angle of the crossing in the pose (degrees).
    pub crossing_deg: f64,
}

/// Returns the crossings under a bad angle, in drawing order, each vertex once; without remedies in
/// a construction of more than a hundred crossings. `known` are those of the same drawing to other
/// scales, which have the same poses nearby.
pub fn bad_angles(
    drawn: &DraftedConstruction,
    pencil_mm: f64,
    known: &[BadAngle],
) -> Vec<BadAngle> {
    let mut bad: Vec<CrossingTolerance> = Vec::new();
    for c in crossings(drawn.construction, pencil_mm) {
        if c.angle_deg() < BAD_DEG && bad.iter().all(|b| b.target != c.target) {
            bad.push(c);
        }
    }
    if bad.is_empty() {
        return Vec::new();
    }
    if crossings(drawn.construction, pencil_mm).len() > MANY {
        return bad
            .into_iter()
            .map(|crossing| BadAngle {
                crossing,
                pencil_mm,
                larger: None,
                special: None,
                pose: None,
            })
            .collect();
    }
    let tolerances = drafting(drawn, pencil_mm).tolerances;
    let larger = larger(&tolerances);
    let mut search = BadAngleSearch::new(drawn);
    bad.into_iter()
        .map(|crossing| BadAngle {
            crossing,
            pencil_mm,
            larger,
            special: other_point(drawn, crossing.target, pencil_mm, worst(&tolerances)),
            pose: match known
                .iter()
                .find(|b| (b.crossing.on, b.crossing.target) == (crossing.on, crossing.target))
            {
                Some(found) => found.pose,
                None => search.pose_for(&crossing),
            },
        })
        .collect()
}

/// The enlargement with which every answer is within 1 %, if it is needed and a sheet is large
/// enough for it.
fn larger(tolerances: &[Option<Tolerance>]) -> Option<f64> {
    let all: Vec<_> = tolerances.iter().flatten().filter_map(|t| t.larger.as_ref()).collect();
    let worst = all.iter().max_by(|a, b| a.factor.total_cmp(&b.factor))?;
    (worst.factor > 1.0 && all.iter().all(|l| l.sheet().is_some())).then(|| worst.rounded())
}

/// The worst relative tolerance; infinite if one is not known.
fn worst(tolerances: &[Option<Tolerance>]) -> f64 {
    tolerances
        .iter()
        .map(|t| t.as_ref().map_or(f64::INFINITY, |t| t.relative.unwrap_or(0.0)))
        .fold(0.0, f64::max)
}

/// The velocities drawn exactly in a configuration; their lines cross under the same angles as
/// those of the accelerations.
fn redrawn(
    drawn: &DraftedConstruction,
    at: &Configuration,
    layout: &Layout,
) -> Option<PlanDrawing> {
    let layout =
        Layout { scales: layout.scales.clone().with(Kind::Acceleration, None), ..layout.clone() };
    drawn.construction.acts.draw(drawn.scene, at, drawn.plan, &layout, &mut Exact).ok()
}

fn other_point(
    drawn: &DraftedConstruction,
    target: VertexId,
    pencil_mm: f64,
    present: f64,
) -> Option<OtherPoint> {
    let layout = Layout::of(drawn.construction);
    let finds = |steps: &[PlanStep], v: VertexId| {
        steps.iter().any(|s| matches!(s, PlanStep::Equation { target, .. } | PlanStep::Trials { target, .. } if *target == v))
    };
    let chosen = |g: usize| drawn.construction.acts.chosen[g];
    let steps = drawn
        .plan
        .steps(DiagramKind::Velocity)
        .iter()
        .find(|s| s.alternatives.get(chosen(s.group)).is_some_and(|a| finds(a, target)))?;
    let group = steps.group;
    let mut best: Option<OtherPoint> = None;
    for (k, alternative) in
        steps.alternatives.iter().enumerate().filter(|(k, _)| *k != chosen(group))
    {
        let mut other = drawn.construction.acts.chosen.clone();
        other[group] = k;
        let acts = Acts::of(drawn.scene, drawn.mechanism, drawn.plan, &other);
        let Ok(paper) =
            acts.draw(drawn.scene, drawn.configuration, drawn.plan, &layout, &mut Exact)
        else {
            continue;
        };
        let own = crossings(&paper, 0.0).into_iter().filter(|c| finds(alternative, c.target));
        let worst_deg = own.map(|c| c.angle_deg()).fold(90.0, f64::min);
        let legs = alternative.iter().find_map(|s| match s {
            PlanStep::Equation { target, .. } => drawn.plan.special(*target)?.legs,
            PlanStep::Image { .. } | PlanStep::Trials { .. } | PlanStep::Same { .. } => None,
        });
        if let Some(legs) = legs
            && worst_deg >= BAD_DEG
            && best.is_none_or(|b| worst_deg > b.worst_deg)
            && worst(
                &drafting(
                    &DraftedConstruction {
                        construction: &paper,
                        equilibrium: None,
                        ..drawn.clone()
                    },
                    pencil_mm,
                )
                .tolerances,
            ) < present
        {
            best = Some(OtherPoint { group, legs, worst_deg });
        }
    }
    best
}

/// A pose of the search, with all its crossings.
struct SearchPose {
    driver: usize,
    turn_deg: f64,
    crossings: Vec<CrossingTolerance>,
}

/// The state of the search for nearby poses: the drivers one after the other, each turned step by
/// step, alternating between the two senses. All crossings under a bad angle share the poses.
struct BadAngleSearch<'a> {
    drawn: &'a DraftedConstruction<'a>,
    /// The sine of each crossing in the drawing. It changes its sign only through a dead centre;
    /// beyond it, or in another assembly, the problem is not the same.
    was: BTreeMap<(DiagramKind, usize), f64>,
    ahead: Vec<(usize, usize, usize)>,
    ways: Vec<[Option<Configuration>; 2]>,
    tried: Vec<SearchPose>,
}

/// The senses in which a driver is turned.
const SENSES: [f64; 2] = [1.0, -1.0];

impl<'a> BadAngleSearch<'a> {
    fn new(drawn: &'a DraftedConstruction<'a>) -> BadAngleSearch<'a> {
        let was = crossings(drawn.construction, 0.0)
            .into_iter()
            .map(|c| ((c.on, c.target.0), c.sine))
            .collect();
        let turning = |driver: &usize| drawn.scene.drivers[*driver].kind.turns();
        let steps = (SEARCH_DEG / SEARCH_STEP_DEG) as usize;
        let drivers = (0..drawn.scene.drivers.len()).filter(turning);
        let mut ahead: Vec<_> = drivers
            .flat_map(|d| {
                (1..=steps).flat_map(move |k| (0..SENSES.len()).map(move |way| (d, k, way)))
            })
            .collect();
        ahead.reverse();
        let ways = drawn
            .scene
            .drivers
            .iter()
            .map(|_| SENSES.map(|_| Some(drawn.configuration.clone())))
            .collect();
        BadAngleSearch { drawn, was, ahead, ways, tried: Vec::new() }
    }

    /// The first pose in which a crossing is good and no other bad.
    fn pose_for(&mut self, crossing: &CrossingTolerance) -> Option<NearbyPose> {
        let mut k = 0;
        loop {
            while k == self.tried.len() {
                let (driver, step, way) = self.ahead.pop()?;
                let turn_deg = SENSES[way] * step as f64 * SEARCH_STEP_DEG;
                let there = self.step(driver, way).map(|crossings| SearchPose {
                    driver,
                    turn_deg,
                    crossings,
                });
                self.tried.extend(there);
            }
            let SearchPose { driver, turn_deg, crossings } = &self.tried[k];
            let here = crossings
                .iter()
                .find(|c| (c.on, c.target) == (crossing.on, crossing.target))
                .map(|c| c.angle_deg());
            if let Some(crossing_deg) = here.filter(|here| *here >= GOOD_DEG)
                && crossings.iter().all(|c| c.angle_deg() >= BAD_DEG)
            {
                let to_deg = self.drawn.scene.drivers[*driver]
                    .kind
                    .angle()
                    .map(|a| a.value.degrees() + turn_deg);
                return Some(NearbyPose {
                    driver: *driver,
                    turn_deg: *turn_deg,
                    to_deg,
                    crossing_deg,
                });
            }
            k += 1;
        }
    }

    /// Advances one step, and returns the crossings there; `None` if the mechanism goes no further
    /// in this sense.
    fn step(&mut self, driver: usize, way: usize) -> Option<Vec<CrossingTolerance>> {
        let drawn = self.drawn;
        let from = self.ways[driver][way].take()?;
        let mut values = driver_values(drawn.scene, &from);
        values.0[driver] += (SENSES[way] * SEARCH_STEP_DEG).to_radians();
        let at = moved(drawn.scene, drawn.mechanism, &from, &values)?;
        let paper = redrawn(drawn, &at, &Layout::of(drawn.construction))?;
        let now = crossings(&paper, 0.0);
        if !now
            .iter()
            .all(|c| self.was.get(&(c.on, c.target.0)).is_some_and(|was| was * c.sine > 0.0))
        {
            return None;
        }
        self.ways[driver][way] = Some(at);
        Some(now)
    }
}

/// The pairs that are nearly at a dead centre, as the beginning of a clause; empty for a special
/// point on the diagram.
fn near(drawn: &DraftedConstruction, c: &CrossingTolerance) -> Both {
    let Some(polygon) = drawn.construction.polygon(c.on) else { return Both::default() };
    let edges = polygon.actions.iter().find_map(|a| {
        let Action::Cross { target, edges, .. } = a else { return None };
        (*target == c.target).then_some(edges)
    });
    let terms = edges.into_iter().flatten().filter_map(|e| polygon.edges[*e].terms.first());
    let words: Vec<Both> = terms.map(|t| held_by(drawn.scene, drawn.plan, t)).collect();
    if words.is_empty() {
        return both!("the lines of two trials are nearly parallel, and ");
    }
    both!("{} are near a dead centre, and ", Both::join(&words, each!(" and ")))
}

impl BadAngle {
    /// Returns the crossing as a warning.
    pub fn diagnostic(&self, drawn: &DraftedConstruction) -> Diagnostic {
        let name = vertex_name(drawn.scene, drawn.plan, self.crossing.target);
        let moves = match self.crossing.moves_on_paper_mm() {
            Some(mm) => both!("by {} mm", significant(mm, 2)),
            None => both!("off the paper"),
        };
        let message = both!(
            "{name} is found under {}°: {}a pencil error of {} mm moves it {}",
            significant(self.crossing.angle_deg(), 2),
            near(drawn, &self.crossing),
            shortest(self.pencil_mm),
            moves
        );
        let mut help = Vec::new();
        if let Some(factor) = self.larger {
            help.push(both!(
                "draw {} times as large, then every answer is within 1 %",
                shortest(factor)
            ));
        }
        if let Some(p) = self.special {
            let point = both!(
                "take the special point on legs {} and {} of the group",
                p.legs.0 + 1,
                p.legs.1 + 1
            );
            help.push(both!(
                "{}, where the lines cross under {}° or more",
                point,
                significant(p.worst_deg, 2)
            ));
        }
        if let Some(p) = self.pose {
            let angle = significant(p.crossing_deg, 2);
            let name = drawn.scene.driver_name(p.driver).0;
            help.push(match p.to_deg {
                Some(to) => both!(
                    "take the pose at {name} = {} deg, where the lines cross under {angle}°",
                    shortest(to)
                ),
                None => both!(
                    "turn the driver {name} by {} deg, where the lines cross under {angle}°",
                    shortest(p.turn_deg)
                ),
            });
        }
        let d = Diagnostic::warning("bad-angle", message);
        let d = match drawn.plan.vertex(self.crossing.target).spot {
            VertexPlace::Point(p) => d.at(drawn.scene.points[p.0].span),
            VertexPlace::Special(_) => d,
        };
        if help.is_empty() { d } else { d.help(Both::join(&help, each!("; or "))) }
    }
}
