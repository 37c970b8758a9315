//! Reactions and balancing moments, group by group in the reverse of the kinematic order, for any
//! number type.
//!
//! The last group is solved first: its loads are known. The forces in its outer pairs act on the
//! groups on which it depends, and so on to the drivers, whose moments and forces are the balancing
//! ones. Each group is its transposed kinematic system ([`Conditions::reactions`]).
//!
//! A passive link (a block, barrel and rod of a cylinder) passes its loads to the links that it
//! follows, by the same virtual power; its own reactions follow from its equilibrium afterwards.

use super::MechanismMotion;
use super::conditions::{ActingForces, Conditions, Reaction};
use crate::force::{
    Load, Rubbing, between_teeth, completed, is_determined, loads, pressed_apart, rubbing, settled,
    unit_balance, with_friction,
};
use crate::mechanism::{Demand, Mechanism, PairForm, PairItem, Passive, Runner};
use crate::position::{Configuration, Path};
use hodograph_base::geom::Vec2;
use hodograph_base::number::Real;
use hodograph_scene::exact::Inputs;
use hodograph_scene::quantity::{Forces, Wrench};
use hodograph_scene::{GuideId, LinkId, Normal, PointId, RollingId, Scene, Touch};

/// The mechanism in a pose, with the demand.
struct PosedMechanism<'a, N> {
    scene: &'a Scene,
    m: &'a Mechanism,
    at: &'a Configuration<N>,
    demand: &'a Demand,
    /// A motion at rest: equilibrium needs no velocities.
    rest: MechanismMotion<N>,
}

/// The reactions under some loads.
#[derive(Clone)]
struct LoadReactions<N> {
    pins: Vec<(PointId, LinkId, Vec2<N>)>,
    /// Force on the runner of a guide, and couple on a slider about its position.
    guides: Vec<Option<Wrench<N>>>,
    /// Force by which a driver pushes the runner of a guide.
    pushes: Vec<Vec2<N>>,
    rolling: Vec<Option<Vec2<N>>>,
    drivers: Vec<N>,
}

/// Returns the forces at an instant.
///
/// # Errors
/// The group that has no equilibrium in the pose (a dead centre); `None` if a quantity that a load
/// needs is not known, the forces are not determined, or the balancing force does no work.
pub(super) fn forces<N: Real>(
    scene: &Scene,
    m: &Mechanism,
    at: &Configuration<N>,
    demand: &Demand,
    motion: &MechanismMotion<N>,
) -> Result<Forces<N>, Option<usize>> {
    let posed = PosedMechanism { scene, m, at, demand, rest: MechanismMotion::at_rest(scene, at) };
    let loads = loads(scene, at, motion).ok_or(None)?;
    let smooth = posed.whole(&loads)?;
    if scene.loads.friction.is_empty() {
        return Ok(posed.as_forces(smooth, &[]));
    }
    if !is_determined(scene, m) {
        return Err(None);
    }
    let (rubbing, _) = rubbing(scene, at, motion).ok_or(None)?;
    let under = |friction: &[Load<N>]| {
        posed.whole(&loads.iter().chain(friction).copied().collect::<Vec<_>>())
    };
    let rough =
        settled(scene, &rubbing, under, |whole| (whole.found.pins.clone(), whole.found.guides()))?
            .ok_or(None)?;
    let power = smooth.power;
    Ok(Forces { smooth: Some(power), ..posed.as_forces(rough, &rubbing) })
}

/// The reactions under all loads, with the force that maintains the balance.
struct BalancedReactions<N> {
    loads: Vec<Load<N>>,
    teeth: Vec<Load<N>>,
    found: LoadReactions<N>,
    balance: Option<N>,
    power: N,
}

impl<N: Real> LoadReactions<N> {
    fn guides(&self) -> Vec<(GuideId, Wrench<N>)> {
        self.guides.iter().enumerate().filter_map(|(g, w)| Some((GuideId(g), (*w)?))).collect()
    }
}

impl<N: Real> PosedMechanism<'_, N> {
    /// Returns the reactions under loads, the balancing force and the forces that press teeth
    /// apart.
    fn whole(&self, loads: &[Load<N>]) -> Result<BalancedReactions<N>, Option<usize>> {
        let PosedMechanism { scene, at, .. } = *self;
        let mut loads = loads.to_vec();
        let mut found = self.balanced(&loads)?;
        let rate = Inputs::of(scene);
        let power = scene
            .drivers
            .iter()
            .zip(&found.drivers)
            .fold(N::from_f64(0.0), |sum, (d, x)| sum + *x * rate.number(&d.rate));
        let mut balance = None;
        if let Some(unit) = unit_balance(scene, at) {
            // One driver: the load that does the same work replaces its moment.
            let (own, by_unit) = (
                *found.drivers.first().ok_or(None)?,
                *self.balanced(&[unit])?.drivers.first().ok_or(None)?,
            );
            if by_unit.approx().abs() <= by_unit.radius() || by_unit.approx() == 0.0 {
                return Err(None);
            }
            let size = -own / by_unit;
            let wrench =
                Wrench { force: unit.wrench.force * size, couple: unit.wrench.couple * size };
            loads.push(Load { wrench, ..unit });
            found = self.balanced(&loads)?;
            balance = Some(size);
        }
        let rolling: Vec<(RollingId, Vec2<N>)> = found
            .rolling
            .iter()
            .enumerate()
            .filter_map(|(r, force)| Some((RollingId(r), (*force)?)))
            .collect();
        let teeth = between_teeth(scene, at, &rolling);
        if !teeth.is_empty() {
            let all: Vec<Load<N>> = loads.iter().chain(&teeth).copied().collect();
            found = self.balanced(&all)?;
        }
        Ok(BalancedReactions { loads, teeth, found, balance, power })
    }

    /// Returns the reactions under loads.
    fn balanced(&self, loads: &[Load<N>]) -> Result<LoadReactions<N>, Option<usize>> {
        let PosedMechanism { scene, m, at, .. } = *self;
        let zero = N::from_f64(0.0);
        let mut acting = ActingForces::none(scene, at);
        for load in loads {
            acting.on_link(load.link, load.place, load.wrench);
        }
        let own = acting.clone();
        let mut found = LoadReactions {
            pins: Vec::new(),
            guides: vec![None; scene.guides.len()],
            pushes: vec![Vec2::zero(); scene.guides.len()],
            rolling: vec![None; scene.rolling.len()],
            drivers: vec![zero; scene.drivers.len()],
        };
        let passive: Vec<(LinkId, Passive)> = (0..scene.links.len())
            .map(LinkId)
            .filter_map(|l| Some((l, m.passive[l.0]?)))
            .filter(|(l, _)| at.poses[l.0].is_some())
            .collect();
        for &(l, kind) in &passive {
            self.handed_on(l, kind, &own, &mut acting).ok_or(None)?;
        }
        // Forces of cylinders on their pins.
        let mut pulls: Vec<(PointId, Vec2<N>)> = Vec::new();
        let mut couples: Vec<(GuideId, LinkId, LinkId, N)> = Vec::new();
        let inputs = Inputs::of(scene);
        for (g, group) in
            m.groups.iter().enumerate().rev().filter(|(g, _)| self.demand.groups[*g].is_some())
        {
            let conditions = Conditions::of_group(scene, m, at, &inputs, &m.groups[g], &self.rest);
            let mut reactions = conditions.reactions(&mut acting).ok_or(Some(g))?.into_iter();
            for _ in 0..group.constraints.len() {
                let Some((c, first)) = reactions.next() else { break };
                match (m.constraints[c].form(), first) {
                    (PairForm::Meet { pin, link }, Reaction::Force(x)) => {
                        let y = reactions.next().map(|(_, r)| r);
                        let Some(Reaction::Force(y)) = y else { continue };
                        found.pins.push((pin, link, x + y));
                    }
                    (PairForm::OnPath { guide, .. }, Reaction::Force(force)) => {
                        let w = found.guides[guide.0].get_or_insert(Wrench::zero());
                        w.force += force;
                    }
                    (PairForm::AlongPath { runner, guide, driver, .. }, Reaction::Force(force)) => {
                        let place = self.place(runner, guide).ok_or(None)?;
                        found.drivers[driver] = at.guide(guide).tangent_at(place).dot(force);
                        found.pushes[guide.0] += force;
                    }
                    (PairForm::Distance { from, to, driver }, Reaction::Force(force)) => {
                        let line = at.points[to.0]
                            .zip(at.points[from.0])
                            .and_then(|(to, from)| (to - from).unit());
                        found.drivers[driver] = line.ok_or(None)?.dot(force);
                        pulls.extend([(to, force), (from, -force)]);
                    }
                    (PairForm::Angles { driver: Some(d), .. }, Reaction::Couple(couple)) => {
                        found.drivers[d] = couple
                    }
                    (PairForm::Angles { of, against, driver: None }, Reaction::Couple(couple)) => {
                        if let PairItem::Guide(g) = m.constraints[c].item() {
                            couples.push((g, of, against, couple));
                        }
                    }
                    (PairForm::Related { pair, .. }, Reaction::Force(force)) => {
                        found.rolling[pair.0] = Some(force)
                    }
                    // The moment that a belt or a chain transmits is no force at a point.
                    (PairForm::Related { .. }, Reaction::Couple(_)) => {}
                    (
                        PairForm::Meet { .. }
                        | PairForm::OnPath { .. }
                        | PairForm::AlongPath { .. }
                        | PairForm::Distance { .. },
                        Reaction::Couple(_),
                    )
                    | (PairForm::Angles { .. }, Reaction::Force(_)) => {}
                }
            }
        }
        self.share(&couples, &mut found);
        for (g, guide) in scene.guides.iter().enumerate() {
            // The slider presses on its pin; the guide presses on the slider.
            if let (Some(p), Some(s), Some(w)) = (guide.pin, guide.slider, found.guides[g])
                && m.passive[s.0].is_none()
                && let Some(pin) = found.pins.iter_mut().find(|(at, l, _)| (*at, *l) == (p, s))
            {
                pin.2 = pin.2 - w.force - found.pushes[g];
            }
        }
        for &(l, kind) in &passive {
            self.follower(l, kind, &own, &pulls, &mut found).ok_or(None)?;
        }
        Ok(found)
    }

    /// Returns the position of the runner of a guide.
    fn place(&self, runner: Runner, guide: GuideId) -> Option<hodograph_base::geom::Point<N>> {
        match runner {
            Runner::Pin(p) => self.at.points[p.0],
            Runner::Link(l) => {
                let pin = self.scene.links[l.0]
                    .points
                    .first()
                    .or(self.scene.guides[guide.0].pin.as_ref());
                pin.and_then(|p| self.at.points[p.0])
                    .or_else(|| self.at.poses[l.0].map(|pose| pose.origin))
            }
        }
    }

    /// Computes the couples of guides on their sliders from those of the locks: a lock may
    /// represent another pair of the links that turn together, which form a tree.
    fn share(&self, couples: &[(GuideId, LinkId, LinkId, N)], found: &mut LoadReactions<N>) {
        let zero = N::from_f64(0.0);
        let mut net = vec![zero; self.scene.links.len()];
        for (_, of, against, couple) in couples {
            net[of.0] = net[of.0] + *couple;
            net[against.0] = net[against.0] - *couple;
        }
        let mut open: Vec<(GuideId, LinkId, LinkId)> = couples
            .iter()
            .filter_map(|(g, ..)| {
                let guide = &self.scene.guides[g.0];
                Some((*g, guide.slider?, guide.on))
            })
            .collect();
        while let Some(k) = (0..open.len()).find(|k| {
            let ends = |l: LinkId| open.iter().filter(|(_, s, o)| *s == l || *o == l).count() == 1;
            ends(open[*k].1) || ends(open[*k].2)
        }) {
            let (g, slider, on) = open[k];
            let leaf = open.iter().filter(|(_, s, o)| *s == slider || *o == slider).count() == 1;
            // Only the couple of this guide acts on the leaf.
            let couple = if leaf { net[slider.0] } else { -net[on.0] };
            net[slider.0] = net[slider.0] - couple;
            net[on.0] = net[on.0] + couple;
            let w = found.guides[g.0].get_or_insert(Wrench::zero());
            w.couple = w.couple + couple;
            open.remove(k);
        }
    }

    /// Passes the loads of a passive link to the links that it follows.
    fn handed_on(
        &self,
        l: LinkId,
        kind: Passive,
        own: &ActingForces<N>,
        acting: &mut ActingForces<N>,
    ) -> Option<()> {
        match kind {
            Passive::Block(g) => {
                let guide = &self.scene.guides[g.0];
                let pin = guide.pin?;
                let place = self.at.points[pin.0]?;
                let load = own.about(l, place);
                match self.at.guides[g.0]? {
                    Path::Line { .. } => {
                        acting.on_pin(pin, load.force);
                        acting.links[guide.on.0].couple =
                            acting.links[guide.on.0].couple + load.couple;
                    }
                    Path::Arc { centre, .. } => {
                        let f = pair_of(place - centre, load.couple);
                        acting.on_pin(pin, load.force + f);
                        acting.on_link(guide.on, centre, Wrench { force: -f, ..Wrench::zero() });
                    }
                }
            }
            Passive::Cylinder(_) | Passive::Held(..) => {
                let (a, b) = self.m.line_of(self.scene, l)?;
                let (p, q) = (self.at.points[a.0]?, self.at.points[b.0]?);
                let load = own.about(l, p);
                let f = pair_of(q - p, load.couple);
                acting.on_pin(a, load.force - f);
                acting.on_pin(b, f);
            }
        }
        Some(())
    }

    /// Computes the reactions on a passive link.
    fn follower(
        &self,
        l: LinkId,
        kind: Passive,
        own: &ActingForces<N>,
        pulls: &[(PointId, Vec2<N>)],
        found: &mut LoadReactions<N>,
    ) -> Option<()> {
        match kind {
            Passive::Block(g) => {
                let pin = self.scene.guides[g.0].pin?;
                let place = self.at.points[pin.0]?;
                let load = own.about(l, place);
                let wrench = found.guides[g.0].get_or_insert(Wrench::zero());
                if let Path::Arc { centre, .. } = self.at.guides[g.0]? {
                    wrench.force += pair_of(place - centre, load.couple);
                }
                wrench.couple = -load.couple;
                let force = -(wrench.force + load.force + found.pushes[g.0]);
                found.pins.push((pin, l, force));
            }
            Passive::Cylinder(d) => {
                let [a, _] = self.scene.drivers[d].kind.ends_of(l)?;
                // The total force of the cylinder's parts at this pin, where only this part is
                // held.
                let mut at_pin = pulls
                    .iter()
                    .filter(|(p, _)| *p == a)
                    .fold(Vec2::zero(), |sum, (_, f)| sum + *f);
                for part in self.scene.drivers[d].kind.parts() {
                    let [p, q] = self.scene.drivers[d].kind.ends_of(*part)?;
                    let (start, end) = (self.at.points[p.0]?, self.at.points[q.0]?);
                    let load = own.about(*part, start);
                    let f = pair_of(end - start, load.couple);
                    at_pin += if *part == l { load.force - f } else { f };
                }
                found.pins.push((a, l, -at_pin));
            }
            Passive::Held(..) => {}
        }
        Some(())
    }

    fn as_forces(&self, whole: BalancedReactions<N>, rubbing: &[Rubbing<N>]) -> Forces<N> {
        let BalancedReactions { loads, teeth, found, balance, power } = whole;
        let guides = with_friction(found.guides(), rubbing);
        let rolling = found.rolling.into_iter().enumerate().filter_map(|(r, force)| {
            let pair = RollingId(r);
            // A separate guide holds the wheels in contact: the two parts are one force.
            let apart = self.scene.rolling[r]
                .guide()
                .and_then(|g| guides.iter().find(|(own, _)| *own == g))
                .map(|(_, w)| w.force);
            let toward = match self.scene.rolling[r].touch() {
                Touch::Point(Normal::Centres(_) | Normal::Square { .. }) => {
                    apart.unwrap_or(Vec2::zero())
                }
                Touch::Strand { .. } => Vec2::zero(),
            };
            Some((pair, force? + toward + pressed_apart(self.scene, &teeth, pair)))
        });
        let reactions = Forces {
            rolling: rolling.collect(),
            pins: found.pins,
            drivers: found.drivers,
            determinate: is_determined(self.scene, self.m),
            guides,
            balance,
            power,
            ..Forces::none()
        };
        completed(self.scene, self.at, &loads, reactions)
    }
}

/// Returns the force at the end of the line d which, with its opposite at the start, has the moment
/// of a couple: d⊥ C/d².
fn pair_of<N: Real>(d: Vec2<N>, couple: N) -> Vec2<N> {
    d.perp() * (couple / d.norm2())
}
