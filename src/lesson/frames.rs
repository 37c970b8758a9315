//! Solves every pose to common scales, and adds poses where the motion curves strongly.
//!
//! This module ensures that all poses fit the paper, except those next to a limit, where vectors
//! grow without bound. It also determines how many poses the page needs so that its drawings
//! between them are accurate to 0.01 mm. [`super::zoom`] chooses the scales.

use crate::budget::here;
use rayon::prelude::*;

use crate::construct::scale::{self, Boxes};
use crate::diag::{Diagnostic, Faults, both};
use crate::equilibrium::GroupForces;
use crate::figure::series::{SeriesScales, ends};
use crate::geom::Point;
use crate::mechanism::{Demand, Mechanism};
use crate::notation::Notation;
use crate::paper::style::Style;
use crate::position::Configuration;
use crate::scene::{ByKind, DiagramKind, Kind, LinkId, Scene};
use crate::worked::{Worked, work_placed, work_pose};

use super::curve;
use super::split::{PolygonSplit, split};
use super::zoom::{VectorEnds, Windows, Zoom};
use crate::sweep::follow::{PoseFollower, PoseSweep, TravelPose, between};

/// A pose with all its results.
pub struct SolvedFrame {
    /// Travel of the driver from the scene's pose: radians, metres or seconds.
    pub travel: f64,
    /// The scene with its driver at this travel.
    pub scene: Scene,
    /// The solved pose.
    pub worked: Worked,
    /// The diagrams on the paper: polygon of velocities, polygon of accelerations.
    pub shown: Vec<DiagramKind>,
    /// True if the driver can go no farther here; the frame then has no statement of the motion.
    pub end: bool,
}

/// All frames of a lesson.
pub struct Frames {
    /// The frames in the order of travel.
    pub list: Vec<SolvedFrame>,
    /// The index of the scene's own pose.
    pub base: usize,
    /// True if the mechanism turns fully.
    pub full: bool,
    /// The scale and the windows of each polygon, if there is one.
    pub zoom: ByKind<Zoom>,
    /// The division of each polygon into several drawings, if it is split.
    pub split: ByKind<PolygonSplit>,
    /// The links of each group with forces drawn in the scene's own pose.
    pub groups: Vec<Vec<LinkId>>,
    /// True if some polygon next to a limit is too large for the paper.
    pub cut: bool,
}

impl Frames {
    /// For each frame the index of the first frame with the same plan; frames with one plan show
    /// one moving drawing.
    pub fn plans(&self) -> Vec<usize> {
        self.firsts(|a, b| a.worked.plan == b.worked.plan)
    }

    /// For each frame the index of the first frame whose forces are drawn in the same steps.
    pub fn force_plans(&self) -> Vec<usize> {
        self.firsts(|a, b| groups(&a.worked) == groups(&b.worked))
    }

    fn firsts(&self, alike: impl Fn(&SolvedFrame, &SolvedFrame) -> bool) -> Vec<usize> {
        let mut firsts: Vec<usize> = Vec::new();
        let first = |k: usize| {
            let known = firsts.iter().copied().find(|f| alike(&self.list[*f], &self.list[k]));
            known.unwrap_or_else(|| {
                firsts.push(k);
                k
            })
        };
        (0..self.list.len()).map(first).collect()
    }
}

/// The groups with forces drawn in a pose.
pub fn groups(worked: &Worked) -> &[GroupForces] {
    worked.equilibrium.as_ref().map_or(&[], |of| &of.groups)
}

/// Largest error of the page between two frames (mm); with all roundings the page is then accurate
/// to 0.01 mm.
const BETWEEN_MM: f64 = 0.006;
/// Joints farther than this from the origin of the diagram (mm) are not shown: centres of curvature
/// of nearly straight paths.
const FAR_MM: f64 = 1000.0;
/// Largest number of added frames, as a part of the frames requested.
const ADDED: f64 = 0.4;
/// Rounds of halving: next to a limit a step of 5° becomes one of 0.3°.
const ROUNDS: usize = 4;
/// Distances from a pose in which lines coincide, on both sides of it, at which it is shown (parts
/// of a step). At a change point the polygons can be read there; at a limit it is the nearest pose
/// that can be drawn.
const ASIDE: [f64; 1] = [0.05];
const BEFORE: [f64; 4] = [1e-9, 1e-7, 1e-5, 1e-3];

/// A candidate pose, solved to its own scales.
#[derive(Clone)]
struct TrialPose {
    travel: f64,
    scene: Scene,
    /// The configuration in the scene of the motion.
    at: Configuration,
    worked: Worked,
}

/// The scales of all poses.
struct Papers {
    common: SeriesScales,
    /// The scale of the scene's own figure (m/mm).
    mu: f64,
    /// The names of the points of the motion.
    points: Vec<String>,
    zooms: ByKind<Zoom>,
    splits: ByKind<PolygonSplit>,
    groups: Vec<Vec<LinkId>>,
}

/// A point and the index of the window that shows it.
type WindowPoint = (usize, Point);

/// The input of a lesson.
pub struct LessonInput<'a> {
    /// The scene in its own pose.
    pub scene: &'a Scene,
    /// Its topology.
    pub mechanism: &'a Mechanism,
    /// The quantities that the scene asks for, and all positions.
    pub demand: &'a Demand,
    /// The follower that moves the mechanism.
    pub follower: &'a PoseFollower<'a>,
    /// Sizes of the type.
    pub style: &'a Style,
    /// The notation of vectors.
    pub notation: &'a Notation,
}

impl LessonInput<'_> {
    /// Solves all poses of a sweep, and more poses between them.
    ///
    /// # Errors
    /// `no-motion` where no pose can be drawn.
    pub fn frames(&self, sweep: &PoseSweep) -> Result<Frames, Faults> {
        let mut trials: Vec<TrialPose> = Vec::with_capacity(2 * sweep.poses.len());
        let here = here();
        let worked: Vec<Option<TrialPose>> =
            sweep.poses.par_iter().map(|pose| here.enter(|| self.trial(pose))).collect();
        for (k, trial) in worked.into_iter().enumerate() {
            match trial {
                Some(trial) => trials.push(trial),
                None => trials.extend(self.beside(
                    sweep,
                    k,
                    if sweep.is_limit(k) { &BEFORE } else { &ASIDE },
                )),
            }
        }
        if trials.is_empty() {
            // No motion leads on from the scene's own pose (a dead centre or a locked pose): it is
            // shown alone, with the answers that it has.
            trials.extend(
                sweep
                    .poses
                    .iter()
                    .find(|pose| pose.travel == 0.0)
                    .and_then(|pose| self.worked(pose)),
            );
        }
        if sweep.full
            && let Some(first) = trials.first()
        {
            // The turn is closed, so that the interval between the last frame and the first is
            // judged as well.
            let turn = TrialPose { travel: sweep.period(), ..first.clone() };
            trials.push(turn);
        }
        self.refine(&mut trials, sweep);
        if sweep.full {
            trials.pop();
        }
        self.draw(trials, sweep)
    }

    /// A pose that is not singular.
    fn trial(&self, pose: &TravelPose) -> Option<TrialPose> {
        let regular = |w: &Worked| w.solution.singular.is_empty() && w.solution.refused.is_empty();
        self.worked(pose).filter(|trial| regular(&trial.worked))
    }

    /// Any pose, with the answers that it has.
    fn worked(&self, pose: &TravelPose) -> Option<TrialPose> {
        let scene = self.follower.scene_at(self.scene, pose.travel);
        let (scene, worked) =
            work_pose(&scene, (self.mechanism, self.demand), &pose.configuration).ok()?;
        Some(TrialPose { travel: pose.travel, scene, at: pose.configuration.clone(), worked })
    }

    /// Returns the poses next to a singular one.
    fn beside(&self, sweep: &PoseSweep, k: usize, parts: &[f64]) -> Vec<TrialPose> {
        let here = &sweep.poses[k];
        let neighbours =
            [k.checked_sub(1), Some(k + 1)].map(|n| n.and_then(|n| sweep.poses.get(n)));
        let at = |travel: f64| {
            self.trial(&TravelPose {
                travel,
                configuration: self.follower.at(&here.configuration, travel)?,
            })
        };
        let aside = |n: &TravelPose| {
            parts.iter().find_map(|part| at(here.travel + (n.travel - here.travel) * part))
        };
        neighbours.into_iter().flatten().filter_map(aside).collect()
    }

    /// Adds frames where the page could not interpolate accurately enough.
    fn refine(&self, trials: &mut Vec<TrialPose>, sweep: &PoseSweep) {
        let most = trials.len() + (sweep.poses.len() as f64 * ADDED) as usize;
        let mut settled = vec![false; trials.len().saturating_sub(1)];
        for _ in 0..ROUNDS {
            let papers = self.papers(trials, sweep.is_unlimited());
            let open: Vec<usize> =
                (0..trials.len().saturating_sub(1)).filter(|k| !settled[*k]).collect();
            let halved = |k: &usize| {
                let travel = 0.5 * (trials[*k].travel + trials[k + 1].travel);
                let [one, other] = [*k, k + 1].map(|i| TravelPose {
                    travel: trials[i].travel,
                    configuration: trials[i].at.clone(),
                });
                let configuration = self.follower.at(&between(&one, &other, travel), travel)?;
                let middle = self.trial(&TravelPose { travel, configuration })?;
                let error = self.error(trials, *k, &middle, &papers);
                (error > BETWEEN_MM).then_some((*k, error, middle))
            };
            let here = here();
            let mut wanted: Vec<(usize, f64, TrialPose)> =
                open.par_iter().filter_map(|k| here.enter(|| halved(k))).collect();
            // The worst come first, because only a limited number may be added.
            wanted.sort_by(|a, b| b.1.total_cmp(&a.1));
            wanted.truncate(most.saturating_sub(trials.len()));
            if wanted.is_empty() {
                return;
            }
            wanted.sort_by_key(|w| w.0);
            let mut again = Vec::new();
            let mut wanted = wanted.into_iter().peekable();
            for (k, trial) in std::mem::take(trials).into_iter().enumerate() {
                trials.push(trial);
                let halved = wanted.next_if(|w| w.0 == k).map(|w| trials.push(w.2)).is_some();
                again.extend(if halved { vec![false, false] } else { vec![true] });
            }
            again.truncate(trials.len().saturating_sub(1));
            settled = again;
        }
    }

    /// Distance (mm) between a point of the page in the middle of an interval and its true place.
    fn error(&self, trials: &[TrialPose], k: usize, middle: &TrialPose, papers: &Papers) -> f64 {
        let from = k.saturating_sub(2);
        // Polygons by two plans have no points in common.
        let alike = |t: &TrialPose| {
            [t.worked.plan == middle.worked.plan, groups(&t.worked) == groups(&middle.worked)]
        };
        let marks = |t: &TrialPose| papers.marks(t, alike(t));
        let keys: Vec<(f64, Vec<Option<WindowPoint>>)> = (from..(k + 4).min(trials.len()))
            .map(|i| (trials[i].travel, marks(&trials[i])))
            .collect();
        let at = k - from;
        let mut worst: f64 = 0.0;
        for (i, truth) in marks(middle).iter().enumerate() {
            let Some((scale, truth)) = *truth else { continue };
            let mark = |n: usize| keys.get(n).and_then(|key| key.1.get(i).copied().flatten());
            // A pose next to a singular one may have fewer points.
            if (at.saturating_sub(1)..(at + 3).min(keys.len())).any(|n| mark(n).is_none()) {
                continue;
            }
            // Places in another window do not help to interpolate in this one.
            let alike = |n: &usize| mark(*n).is_some_and(|m| m.0 == scale);
            let side = |places: [Option<usize>; 3]| {
                places.into_iter().map_while(|n| n.filter(alike)).collect::<Vec<_>>()
            };
            let (before, after) = (
                side([Some(at), at.checked_sub(1), at.checked_sub(2)]),
                side([Some(at + 1), Some(at + 2), Some(at + 3)]),
            );
            let axis = |of: fn(&Point) -> f64| {
                let known = |n: &usize| (keys[*n].0, mark(*n).map_or(0.0, |m| of(&m.1)));
                match (before.is_empty(), after.is_empty()) {
                    (false, false) => {
                        let around: Vec<usize> = before
                            .iter()
                            .take(2)
                            .rev()
                            .chain(after.iter().take(2))
                            .copied()
                            .collect();
                        curve::between(
                            &around.iter().map(known).collect::<Vec<_>>(),
                            before.len().min(2) - 1,
                            middle.travel,
                        )
                    }
                    (no_before, _) => {
                        let near = if no_before { &after } else { &before };
                        curve::onward(&near.iter().map(known).collect::<Vec<_>>(), middle.travel)
                    }
                }
            };
            if !(before.is_empty() && after.is_empty()) {
                worst = worst.max(truth.distance(Point::new(axis(|p| p.x), axis(|p| p.y))));
            }
        }
        worst
    }

    /// The scales of all poses.
    fn papers(&self, trials: &[TrialPose], unlimited: bool) -> Papers {
        let poses: Vec<(f64, &Worked)> = trials.iter().map(|t| (t.travel, &t.worked)).collect();
        let own = trials
            .iter()
            .min_by(|a, b| a.travel.abs().total_cmp(&b.travel.abs()))
            .map(|t| &t.worked);
        let boxes = own.map_or(Boxes::default(), |w| Boxes::of(&self.scene.paper, &w.plan));
        let common = SeriesScales::of(&self.scene.paper, &poses, unlimited, boxes, scale::fitted);
        let own_poses: Vec<(&Scene, &Worked)> =
            trials.iter().map(|t| (&t.scene, &t.worked)).collect();
        let of = |on| {
            let (split, label_mm) = split(&own_poses, on, self.style, self.notation);
            let ends = |w: &Worked, part| {
                split.as_ref().map_or_else(Vec::new, |s: &PolygonSplit| {
                    s.ends(w, on, part).into_iter().flatten().collect()
                })
            };
            let parts: Option<VectorEnds> = if split.is_some() { Some(&ends) } else { None };
            (Zoom::of(&self.scene.paper, &poses, &common, on, boxes, parts, &label_mm), split)
        };
        let (mut zooms, mut splits) = (ByKind::default(), ByKind::default());
        let sheets: Vec<Vec<LinkId>> =
            own.map_or_else(Vec::new, |w| groups(w).iter().map(|g| g.links.clone()).collect());
        if !sheets.is_empty() {
            let ends = |w: &Worked, part: usize| vertices(w, &sheets[part]).collect();
            let label_mm = vec![self.style.label_mm; sheets.len()];
            let zoom = Zoom::of(
                &self.scene.paper,
                &poses,
                &common,
                DiagramKind::Force,
                boxes,
                Some(&ends),
                &label_mm,
            );
            zooms.set(Kind::Force, zoom);
        }
        for on in DiagramKind::POLYGONS {
            let (zoom, split) = of(on);
            zooms.set(on.kind(), zoom);
            splits.set(on.kind(), split);
        }
        let mu =
            own.map(|w| w.construction.diagram.mu).or(common.mu.get(Kind::Length)).unwrap_or(1.0);
        Papers {
            mu,
            points: self.scene.points.iter().map(|p| p.name.clone()).collect(),
            common,
            zooms,
            splits,
            groups: sheets,
        }
    }

    /// Draws all poses to the common scales.
    fn draw(&self, trials: Vec<TrialPose>, sweep: &PoseSweep) -> Result<Frames, Faults> {
        let papers = self.papers(&trials, sweep.is_unlimited());
        let mut frames = Frames {
            list: Vec::new(),
            base: 0,
            full: sweep.full,
            zoom: papers.zooms.clone(),
            split: papers.splits.clone(),
            groups: papers.groups.clone(),
            cut: false,
        };
        let to_scale = |trial: &TrialPose| {
            let mut scene = trial.scene.clone();
            scene.paper.scales.set(Kind::Length, Some(papers.mu));
            for on in DiagramKind::VECTORS {
                scene.paper.scales.set(on.kind(), papers.zooms.of(on.kind()).map(|z| z.mu));
            }
            let Worked { mechanism, demand, configuration, .. } = &trial.worked;
            let worked =
                work_placed(&scene, mechanism.clone(), demand.clone(), configuration.clone())
                    .ok()?
                    .value;
            Some((scene, worked))
        };
        let here = here();
        let drawn: Vec<Option<(Scene, Worked)>> =
            trials.par_iter().map(|trial| here.enter(|| to_scale(trial))).collect();
        for (trial, drawn) in trials.into_iter().zip(drawn) {
            let Some((scene, worked)) = drawn else { continue };
            let holds = |on: &DiagramKind| papers.common.holds(&trial.worked, *on);
            let drawn = |on: &DiagramKind| {
                worked.construction.polygon(*on).is_some()
                    || *on == DiagramKind::Force && !groups(&worked).is_empty()
            };
            frames.cut |= DiagramKind::VECTORS.iter().any(|on| !holds(on) && drawn(on));
            let shown: Vec<DiagramKind> = DiagramKind::VECTORS.into_iter().filter(holds).collect();
            let near = |k: usize| {
                sweep.is_limit(k)
                    && (sweep.poses[k].travel - trial.travel).abs()
                        < 2.0 * BEFORE[3] * sweep.step(k)
            };
            let end = trial.travel != 0.0 && (near(0) || near(sweep.poses.len() - 1));
            frames.list.push(SolvedFrame {
                travel: trial.travel,
                scene,
                worked,
                shown: if end { Vec::new() } else { shown },
                end,
            });
        }
        // For a scene in a singular pose, the nearest frame is the base.
        let from_own = |k: &usize| frames.list[*k].travel.abs();
        frames.base =
            (0..frames.list.len()).min_by(|a, b| from_own(a).total_cmp(&from_own(b))).unwrap_or(0);
        if frames.list.is_empty() {
            let d = Diagnostic::error(
                "no-motion",
                both!(
                    "the mechanism cannot be followed from its pose: no pose beside it can be drawn"
                ),
            );
            return Err(d
                .help(both!("give another pose, or move another driver with --driver"))
                .into());
        }
        Ok(frames)
    }
}

/// The vertices of the force polygon of some links, seen from the first (N).
fn vertices<'a>(worked: &'a Worked, links: &[LinkId]) -> impl Iterator<Item = Point> + 'a {
    let group = worked.equilibrium.as_ref().and_then(|of| Some((of, of.group_of(links)?)));
    group.into_iter().flat_map(|(of, group)| of.vertices(group))
}

impl Papers {
    /// Joints on paper, then images if polygons are requested, then vertices if those of forces
    /// are, in a fixed order.
    fn marks(&self, trial: &TrialPose, [polygons, forces]: [bool; 2]) -> Vec<Option<WindowPoint>> {
        let TrialPose { scene, worked, .. } = trial;
        let on_paper = |p: Point| {
            Some((p.to_vec2() * (1.0 / self.mu)).to_point()).filter(|p| p.to_vec2().norm() < FAR_MM)
        };
        let joint = |name: &String| Some((0, on_paper(worked.configuration.named(scene, name)?)?));
        let mut marks: Vec<Option<WindowPoint>> = self.points.iter().map(joint).collect();
        if let Some(zoom) = self.zooms.of(Kind::Force).filter(|_| forces) {
            let on_paper = self.common.holds(worked, DiagramKind::Force);
            for (links, windows) in self.groups.iter().zip(&zoom.windows) {
                let scale = windows.place(vertices(worked, links));
                let place = |q: Point| {
                    on_paper
                        .then(|| (scale, (q.to_vec2() * (1.0 / windows.view[scale])).to_point()))
                };
                marks.extend(vertices(worked, links).map(place));
            }
        }
        if !polygons {
            return marks;
        }
        for on in DiagramKind::POLYGONS {
            let (Some(p), Some(zoom)) = (worked.construction.polygon(on), self.zooms.of(on.kind()))
            else {
                continue;
            };
            // Points outside the paper need not be accurate.
            let on_paper = self.common.holds(worked, on);
            let through = |windows: &Windows, scale: usize, q: Point| {
                on_paper.then(|| (scale, (q.to_vec2() * (1.0 / windows.view[scale])).to_point()))
            };
            for (part, windows) in zoom.windows.iter().enumerate() {
                let mut add = |list: Vec<Option<Point>>, scale| {
                    marks.extend(list.into_iter().map(|q| through(windows, scale, q?)))
                };
                match self.splits.of(on.kind()) {
                    None => {
                        let scale = windows.place(ends(worked, on));
                        let in_si = |q: Point| (q.to_vec2() * p.mu).to_point();
                        add(
                            p.images
                                .iter()
                                .map(|q| q.map(in_si))
                                .chain(p.edges.iter().map(|e| Some(in_si(e.to.1))))
                                .collect(),
                            scale,
                        );
                    }
                    Some(split) => {
                        let list = split.ends(worked, on, part);
                        let scale = windows.place(list.iter().flatten().copied());
                        add(list, scale);
                    }
                }
            }
        }
        marks
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Lang, Swept, read, templates};
    use crate::worked::{Scope, work};

    /// In a motion through time each frame is the scene at that instant: the same velocities and
    /// accelerations, the same answers.
    #[test]
    fn each_frame_of_a_law_is_the_scene_at_its_instant() {
        let scene = read(templates::get("plate-by-law").unwrap()).unwrap().value;
        let worked = work(&scene, Scope::Figure).unwrap().value;
        let follower = PoseFollower::new(
            &scene,
            &worked.mechanism,
            &worked.demand,
            &worked.configuration,
            Swept::Time,
        );
        let (style, notation) = (Style::default(), Notation::of_language(Lang::En));
        let (mechanism, demand) = (&worked.mechanism, &worked.demand);
        let maker = LessonInput {
            scene: &scene,
            mechanism,
            demand,
            follower: &follower,
            style: &style,
            notation: &notation,
        };
        let frames = maker.frames(&follower.sweep(8)).unwrap();
        assert!(frames.list.len() > 7 && !frames.cut && !frames.full);
        for frame in frames.list.iter().step_by(3) {
            let instant = format!("{:?} s", scene.instant() + frame.travel);
            let there = read(templates::instantiate("plate-by-law", &[("t", &instant)]).unwrap())
                .unwrap()
                .value;
            let meant = work(&there, Scope::Figure).unwrap().value;
            for (told, meant) in frame.worked.results.iter().zip(&meant.results) {
                let of = |r: &crate::worked::Outcome| r.value().columns();
                let off =
                    of(told).iter().zip(of(meant)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                assert!(
                    off < 1e-12,
                    "{} at {instant}: off by {off}",
                    frame.scene.find[told.find].text
                );
            }
        }
    }
}
