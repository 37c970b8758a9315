//! A group without a core, refined and proved from the pose found by Newton's method in `f64`.
//!
//! The unknowns are the poses of its links and the positions of its pins. Residuals are lengths
//! (those of angles are multiplied by the size of the mechanism) by the shared equations
//! ([`super::equations`]), and so are their derivatives.

mod phase;

use super::assemble::Assembly;
use super::branch::GroupClosure;
use super::equations::{self, FormMeasure, FormValue, PartPositions};
use super::proof::{self, Unproven};
use super::{Configuration, Path, Pose};
use crate::mechanism::{GraphNode, Group, PairForm};
use hodograph_base::diag::Diagnostic;
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use hodograph_scene::{GuideId, LinkId, PointId, Rolling, RollingId};

/// Poses of the group's links and positions of its pins.
#[derive(Clone)]
struct GroupPoses<N> {
    poses: Vec<Pose<N>>,
    pins: Vec<Point<N>>,
}

struct CoupledGroup<'a, N> {
    assembly: &'a Assembly<'a, N>,
    links: &'a [LinkId],
    pins: &'a [PointId],
    forms: Vec<PairForm>,
    scale: f64,
    aside: Option<Aside>,
    /// The known pose.
    meant: &'a Configuration,
}

/// A driver that is moved from its value at the instant by a given amount (rad or m). The other
/// drivers keep their values.
#[derive(Clone, Copy, Debug)]
pub(super) struct Aside {
    pub driver: usize,
    pub by: f64,
}

/// One equation: its residual and its coefficients.
struct GroupEquation<N> {
    off: N,
    row: Vec<N>,
}

/// The group in a state, with the parts that are already placed.
struct PlacedGroup<'a, N> {
    system: &'a CoupledGroup<'a, N>,
    at: &'a GroupPoses<N>,
}

impl<N: Real> PartPositions<N> for PlacedGroup<'_, N> {
    fn pose(&self, l: LinkId) -> Option<Pose<N>> {
        match self.system.links.iter().position(|k| *k == l) {
            Some(i) => Some(self.at.poses[i]),
            None => self.system.assembly.poses[l.0],
        }
    }

    fn point(&self, p: PointId) -> Option<Point<N>> {
        match self.system.pins.iter().position(|q| *q == p) {
            Some(i) => Some(self.at.pins[i]),
            None => self.system.assembly.points[p.0],
        }
    }

    fn local(&self, l: LinkId, p: PointId) -> Option<Point<N>> {
        self.system.assembly.shapes[l.0].local(p)
    }

    fn path(&self, g: GuideId) -> Option<Path<N>> {
        self.system.assembly.guides[g.0]
    }

    fn slip(&self, r: RollingId) -> Option<N> {
        self.system.slip(self, r)
    }

    fn rolling(&self, r: RollingId) -> (&Rolling, [N; 2]) {
        let pair = &self.system.assembly.scene.rolling[r.0];
        (pair, pair.sizes(&self.system.assembly.inputs))
    }
}

impl<N: Real> Assembly<'_, N> {
    pub(super) fn coupled_trial(
        &self,
        group: &Group,
        meant: &Configuration,
    ) -> Result<GroupClosure<N>, Diagnostic> {
        self.coupled_aside(group, meant, None)
    }

    /// Returns the group like [`Self::coupled_trial`], with a driver moved from the instant, whose
    /// configuration the assembly must know.
    pub(super) fn coupled_aside(
        &self,
        group: &Group,
        meant: &Configuration,
        aside: Option<Aside>,
    ) -> Result<GroupClosure<N>, Diagnostic> {
        let unproven = |why| self.unproven(&group.links, why);
        let mut start = GroupPoses { poses: Vec::new(), pins: Vec::new() };
        for l in &group.links {
            let pose = meant.poses[l.0].ok_or_else(|| unproven(Unproven::NoRoot))?.lift::<N>();
            // An axis rounded to f64 is a unit vector only to f64.
            let axis = if N::refines() {
                pose.axis.unit().ok_or_else(|| unproven(Unproven::NoRoot))?
            } else {
                pose.axis
            };
            start.poses.push(Pose { axis, ..pose });
        }
        for p in &group.pins {
            start.pins.push(meant.points[p.0].ok_or_else(|| unproven(Unproven::NoRoot))?.lift());
        }
        let forms = group.constraints.iter().map(|&c| self.m.constraints[c].form()).collect();
        let scale = meant.extent();
        let system = CoupledGroup {
            assembly: self,
            links: &group.links,
            pins: &group.pins,
            forms,
            scale,
            aside,
            meant,
        };
        let root = if N::refines() {
            if system.equations(&start).is_none() {
                return Err(unproven(Unproven::NotWritten));
            }
            proof::root(&system, start, scale).map_err(unproven)?
        } else {
            start
        };
        let pins = group.pins.iter().copied().zip(root.pins).collect();
        Ok(self.trial(pins, group.links.iter().copied().zip(root.poses).collect()))
    }
}

impl<N: Real> CoupledGroup<'_, N> {
    fn zeros(&self) -> Vec<N> {
        vec![N::from_f64(0.0); 3 * self.links.len() + 2 * self.pins.len()]
    }

    /// Returns the index of a part's first unknown; `None` for a part that is already placed.
    fn first(&self, part: GraphNode) -> Option<usize> {
        match part {
            GraphNode::Link(l) => Some(3 * self.links.iter().position(|k| *k == l)?),
            GraphNode::Pin(p) => {
                Some(3 * self.links.len() + 2 * self.pins.iter().position(|q| *q == p)?)
            }
        }
    }

    /// Returns the amount by which a driver is moved from its value at the instant.
    fn by(&self, driver: usize) -> N {
        N::from_f64(self.aside.filter(|a| a.driver == driver).map_or(0.0, |a| a.by))
    }

    /// Returns the given value of a form: the value of a driver, its value at the instant plus the
    /// amount by which the driver is moved, or the value of a slider at the instant; `None` if
    /// nothing determines it.
    fn given(&self, form: PairForm) -> Option<FormValue<N>> {
        let a = self.assembly;
        let then = a.instant.map(|then| (a.scene, then));
        let aside = then.filter(|_| self.aside.is_some());
        let farther = |then, driver| {
            Some(match equations::kept(form, &then)? {
                FormValue::Turned(stood) => {
                    FormValue::Turned(stood.rotate_by(Vec2::from_angle(self.by(driver))))
                }
                FormValue::Length(stood) => FormValue::Length(stood + self.by(driver)),
                given @ (FormValue::Nothing | FormValue::InPlane(_)) => given,
            })
        };
        match form {
            // The distance of a link's origin from its guide changes no answer: at the instant the
            // origin is put on the guide, and it stays there.
            PairForm::Meet { .. } | PairForm::OnPath { .. } | PairForm::Related { .. } => {
                Some(FormValue::Nothing)
            }
            PairForm::AlongPath { driver, .. } | PairForm::Distance { driver, .. } => match aside {
                Some(then) => farther(then, driver),
                None => a.driven_length(driver).map(FormValue::Length),
            },
            // At the instant a slider's frame is parallel to the plane's; later it keeps its angle
            // to the other link from the instant.
            PairForm::Angles { driver: None, .. } => match then {
                Some(then) => equations::kept(form, &then),
                None => match form.ends().0 {
                    GraphNode::Link(slider) if a.is_along_guide(slider) => {
                        a.slid_along(slider).map(FormValue::InPlane)
                    }
                    GraphNode::Link(_) | GraphNode::Pin(_) => {
                        Some(FormValue::InPlane(Vec2::unit_x()))
                    }
                },
            },
            PairForm::Angles { of, against, driver: Some(driver) } => match aside {
                Some(then) => farther(then, driver),
                None if self.links.contains(&against) => {
                    a.driven_apart(driver).map(FormValue::Turned)
                }
                None => a.axis_of(of, against, Some(driver)).ok().map(FormValue::InPlane),
            },
        }
    }

    /// Returns the equations at a state; `None` if one of them is not available. Steps of angles
    /// are measured as lengths, like the deviations of angles.
    fn equations(&self, at: &GroupPoses<N>) -> Option<Vec<GroupEquation<N>>> {
        let (view, scale) = (PlacedGroup { system: self, at }, N::from_f64(self.scale));
        let mut list = Vec::new();
        for &form in &self.forms {
            let given = self.given(form)?;
            let begin = list.len();
            let mut tell = |off| list.push(GroupEquation { off, row: self.zeros() });
            match equations::off(form, given, &view)? {
                FormMeasure::Apart(d) => [d.x, d.y].into_iter().for_each(tell),
                FormMeasure::Length(off) => tell(off),
                FormMeasure::Angle(off) => tell(off * scale),
            }
            equations::slopes(form, given, &view, scale, |equation, part, by| {
                let Some(first) = self.first(part) else { return };
                let row = &mut list[begin + equation].row[first..first + part.freedoms()];
                row.iter_mut().zip(by).for_each(|(c, by)| *c = *c + by);
            })?;
        }
        (list.len() == self.zeros().len()).then_some(list)
    }
}

impl<N: Real> proof::SquareSystem<N> for CoupledGroup<'_, N> {
    type State = GroupPoses<N>;

    fn residuals(&self, at: &GroupPoses<N>) -> Vec<N> {
        self.equations(at).unwrap_or_default().into_iter().map(|e| e.off).collect()
    }

    fn jacobian(&self, at: &GroupPoses<N>) -> Vec<Vec<N>> {
        self.equations(at).unwrap_or_default().into_iter().map(|e| e.row).collect()
    }

    fn moved(&self, at: &GroupPoses<N>, step: &[N]) -> GroupPoses<N> {
        let scale = N::from_f64(self.scale);
        let poses = at.poses.iter().enumerate().map(|(i, pose)| Pose {
            origin: pose.origin + Vec2::new(step[3 * i], step[3 * i + 1]),
            axis: proof::turned(pose.axis, step[3 * i + 2] / scale),
        });
        let first = 3 * self.links.len();
        let pins = at
            .pins
            .iter()
            .enumerate()
            .map(|(i, p)| *p + Vec2::new(step[first + 2 * i], step[first + 2 * i + 1]));
        GroupPoses { poses: poses.collect(), pins: pins.collect() }
    }

    fn angles(&self) -> Vec<(usize, f64)> {
        (0..self.links.len()).map(|i| (3 * i + 2, self.scale)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::proof::SquareSystem;
    use super::*;
    use crate::mechanism::{Demand, Mechanism, Runner};
    use crate::position::{configure, newton};
    use hodograph_scene::{self as scene, templates};
    use std::collections::BTreeSet;

    fn kind(a: &Assembly<f64>, form: PairForm) -> &'static str {
        let arc = |g: GuideId| matches!(a.guides[g.0], Some(Path::Arc { .. }));
        match form {
            PairForm::Meet { .. } => "meet",
            PairForm::OnPath { runner: Runner::Pin(_), guide, .. } if arc(guide) => "pin on an arc",
            PairForm::OnPath { runner: Runner::Pin(_), .. } => "pin on a line",
            PairForm::OnPath { runner: Runner::Link(_), .. } => "link on a line",
            PairForm::AlongPath { guide, .. } if arc(guide) => "along an arc",
            PairForm::AlongPath { .. } => "along a line",
            PairForm::Distance { .. } => "distance",
            PairForm::Angles { driver: Some(_), .. } => "driven angle",
            PairForm::Angles { driver: None, .. } => "kept angle",
            PairForm::Related { .. } => "related",
        }
    }

    /// Checks all groups of a scene as one, in a state slightly off its root, at the instant and
    /// with a driver moved.
    fn check(name: &str, text: &str, seen: &mut BTreeSet<(&'static str, bool)>) {
        let Some(scene) = scene::read(text).ok().map(|s| s.value) else { return };
        let Some(m) = Mechanism::new(&scene).ok().map(|m| m.value) else { return };
        let demand = Demand::of(&scene, &m).with_all_positions();
        let Some(at) = configure(&scene, &m, &demand).ok().map(|c| c.value) else { return };
        let mut assembly = Assembly::<f64>::new(&scene, &m, &demand, Some(&at));
        assembly.guides.clone_from(&at.shapes.guides);
        let groups: Vec<&Group> =
            newton::placed(&m, &at).into_iter().map(|g| &m.groups[g]).collect();
        let links: Vec<LinkId> = groups.iter().flat_map(|g| g.links.clone()).collect();
        let pins: Vec<PointId> = groups.iter().flat_map(|g| g.pins.clone()).collect();
        let forms: Vec<PairForm> =
            groups.iter().flat_map(|g| &g.constraints).map(|&c| m.constraints[c].form()).collect();
        let scale = at.extent();
        for aside in [None, Some(Aside { driver: 0, by: 0.01 })] {
            assembly.instant = aside.map(|_| &at);
            let system = CoupledGroup {
                assembly: &assembly,
                links: &links,
                pins: &pins,
                forms: forms.clone(),
                scale,
                aside,
                meant: &at,
            };
            let state = GroupPoses {
                poses: links.iter().map(|l| at.poses[l.0].expect("placed")).collect(),
                pins: pins.iter().map(|p| at.point(*p)).collect(),
            };
            let n = system.zeros().len();
            let off: Vec<f64> =
                (0..n).map(|k| 0.03 * scale * libm::sin(1.0 + 2.3 * k as f64)).collect();
            let state = system.moved(&state, &off);
            if system.equations(&state).is_none() {
                continue;
            }
            let jacobian = system.jacobian(&state);
            for k in 0..n {
                let beside = |h: f64| {
                    let mut step = vec![0.0; n];
                    step[k] = h * scale;
                    system.residuals(&system.moved(&state, &step))
                };
                let (up, down) = (beside(1e-5), beside(-1e-5));
                for (i, row) in jacobian.iter().enumerate() {
                    let slope = (up[i] - down[i]) / (2e-5 * scale);
                    assert!(
                        (row[k] - slope).abs() < 1e-7 * (1.0 + slope.abs()),
                        "{name}, aside {}: equation {i} by unknown {k} is {}, its slope {slope}",
                        aside.is_some(),
                        row[k]
                    );
                }
            }
            seen.extend(forms.iter().map(|f| (kind(&assembly, *f), aside.is_some())));
        }
    }

    const GEARED: &str = r#"{"links": {"1": ["O", "D"], "2": ["O", "A"], "3": ["A", "B"], "4": ["B", "C"], "5": ["C", "D"]}, "ground": "1",
        "points": {"O": [0, 0], "D": ["200 mm", 0]}, "lengths": {"OA": "50 mm", "AB": "120 mm", "BC": "100 mm", "CD": "110 mm"},
        "sketch": {"B": [0.1, 0.11], "C": [0.19, 0.1]}, "gears": [{"links": ["3", "5"], "centres": ["B", "C"], "teeth": [30, 45], "at": "K", "phase": "10 deg"}],
        "driver": {"link": "2", "angle": "60 deg", "omega": "10 rad/s"}, "find": ["omega_3", "omega_5"]}"#;

    /// A pin that a driver moves along a fixed arc, and one along an arc of a rotating link.
    const ALONG_ARCS: [&str; 2] = [
        r#"{"links": {"0": ["K", "A"], "1": ["A", "B"], "2": ["B", "C"]}, "ground": "0", "units": {"length": "m"},
        "points": {"K": [0, 0], "A": [5, 0]}, "lengths": {"AB": 2, "BC": 3.2}, "sketch": {"B": [5, 2]},
        "guides": [{"pin": "C", "on": "0", "centre": "K", "radius": 3}],
        "driver": {"slide": "C", "position": "3*atan(4/3)*1 m", "velocity": "1 m/s"}, "find": ["omega_1", "omega_2"]}"#,
        r#"{"links": {"0": ["A", "D"], "1": ["A", "B"], "2": ["B", "C", "K"], "3": ["D", "P"]}, "ground": "0", "units": {"length": "m"},
        "points": {"A": [0, 0], "D": [6, 0], "B": [0, 2], "C": [5, 3], "K": [3, 1], "P": [5, 3]}, "guides": [{"pin": "P", "on": "2", "centre": "K"}],
        "driver": [{"link": "1", "omega": "1 rad/s"}, {"slide": "P", "velocity": "1 m/s"}], "find": ["omega_2", "omega_3"]}"#,
    ];

    /// The root does not depend on the derivatives, but its proof does.
    #[test]
    fn derivatives_are_the_slopes_of_the_equations() {
        let mut seen = BTreeSet::new();
        for t in templates::list() {
            check(t.name, templates::get(t.name).expect("its name is of the list"), &mut seen);
        }
        // At the instant only phases determine the rolling.
        check("five-bar with gears on its floating links", GEARED, &mut seen);
        ALONG_ARCS.iter().for_each(|text| check("driven along an arc", text, &mut seen));
        let all = [
            "meet",
            "pin on an arc",
            "pin on a line",
            "link on a line",
            "along a line",
            "along an arc",
            "distance",
            "driven angle",
            "kept angle",
            "related",
        ];
        for kind in all {
            for aside in [false, true] {
                assert!(
                    seen.contains(&(kind, aside)),
                    "no template has {kind}, aside {aside}: {seen:?}"
                );
            }
        }
    }
}
