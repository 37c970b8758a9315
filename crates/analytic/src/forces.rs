//! Reactions and balancing moments from all constraint rows at once.
//!
//! Without friction a pair does no work: the reactions are λ times the coefficients of its rows,
//! and the equilibrium of all links is Jᵀ λ = −Q. Each reaction is read from the rows of its pair.

use super::relation::{BodyPoint, EquationPair, EquationRow, PositionEquation};
use super::rows::UnknownLayout;
use super::{LoopSystem, Solution};
use hodograph_base::geom::Vec2;
use hodograph_mechanism::force::{
    Load, between_teeth, completed, is_determined, loads, pressed_apart, rubbing, settled,
    unit_balance, with_friction,
};
use hodograph_mechanism::mechanism::{Demand, Level, Mechanism};
use hodograph_mechanism::position::Configuration;
use hodograph_scene::quantity::{Forces, Wrench};
use hodograph_scene::{GuideId, LinkId, PointId, RollingId, Scene, Touch};
use nalgebra::DVector;

/// From this condition number on, `f64` leaves no correct digit of a reaction.
const UNBOUNDED: f64 = 1e13;

/// All rows of a pose with the multipliers of its loads.
struct LoadMultipliers<'a> {
    scene: &'a Scene,
    layout: &'a UnknownLayout,
    rows: &'a [EquationRow],
    lambda: DVector<f64>,
}

/// The reactions under all loads.
struct BalancedLoads<'a> {
    loads: Vec<Load>,
    teeth: Vec<Load>,
    found: LoadMultipliers<'a>,
    balance: Option<f64>,
    power: f64,
}

/// Returns the forces at an instant, with the accelerations of `solution`.
///
/// `None` if the reactions are unbounded or not determined, or if a motion that a load needs is not
/// known.
pub(super) fn forces(
    scene: &Scene,
    m: &Mechanism,
    at: &Configuration,
    demand: &Demand,
    solution: &Solution,
) -> Option<Forces> {
    let loads = loads(scene, at, solution)?;
    // Equilibrium of all placed links, whatever level of motion is requested.
    let still = Demand {
        groups: demand.groups.iter().map(|g| g.map(|_| Level::Velocity)).collect(),
        ..demand.clone()
    };
    let layout = UnknownLayout::new(scene, m, at, &still, Level::Velocity);
    let rows = layout.rows_of_contacts(scene, at);
    let system = LoopSystem::of_rows(rows, layout.unknowns).ok()?;
    if system.condition.is_nan() || system.condition >= UNBOUNDED {
        return None;
    }
    let balanced = |loads: &[Load]| -> Option<LoadMultipliers> {
        let mut q = DVector::zeros(layout.unknowns);
        for load in loads {
            layout.body(scene, load.link, load.place)?.loaded(&mut q, load.wrench, layout.scale);
        }
        Some(LoadMultipliers {
            scene,
            layout: &layout,
            rows: &system.rows,
            lambda: system.solve_transposed(&-q)?,
        })
    };
    let whole = |mut loads: Vec<Load>| -> Option<BalancedLoads> {
        let mut found = balanced(&loads)?;
        let drivers = found.drivers();
        let power = scene.drivers.iter().zip(&drivers).map(|(d, x)| x * d.rate.value).sum();
        let mut balance = None;
        if let Some(unit) = unit_balance(scene, at) {
            let (own, by_unit) = (*drivers.first()?, *balanced(&[unit])?.drivers().first()?);
            let nothing =
                f64::EPSILON.sqrt() * if scene.drivers[0].kind.turns() { at.extent() } else { 1.0 };
            if by_unit.abs() <= nothing {
                return None;
            }
            let size = -own / by_unit;
            loads.push(Load {
                wrench: Wrench {
                    force: unit.wrench.force * size,
                    couple: unit.wrench.couple * size,
                },
                ..unit
            });
            found = balanced(&loads)?;
            balance = Some(size);
        }
        let tangential: Vec<(RollingId, Vec2)> = (0..scene.rolling.len())
            .map(RollingId)
            .filter_map(|r| Some((r, found.tangential(r)?)))
            .collect();
        let teeth = between_teeth(scene, at, &tangential);
        if !teeth.is_empty() {
            let all: Vec<Load> = loads.iter().chain(&teeth).copied().collect();
            found = balanced(&all)?;
        }
        Some(BalancedLoads { loads, teeth, found, balance, power })
    };
    let guides_of = |found: &LoadMultipliers| -> Vec<(GuideId, Wrench)> {
        (0..scene.guides.len()).map(GuideId).filter_map(|g| Some((g, found.guide(g)?))).collect()
    };
    let smooth = whole(loads.clone())?;
    let (rubs, _) = rubbing(scene, at, solution)?;
    let (smooth, BalancedLoads { loads, teeth, found, balance, power }) =
        if scene.loads.friction.is_empty() {
            (None, smooth)
        } else {
            // Friction depends on reactions, which are not determined in this case.
            if !is_determined(scene, m) {
                return None;
            }
            let under = |friction: &[Load]| {
                whole(loads.iter().chain(friction).copied().collect()).ok_or(())
            };
            let read = |w: &BalancedLoads| (w.found.pins(at), guides_of(&w.found));
            (Some(smooth.power), settled(scene, &rubs, under, read).ok()??)
        };
    let pins = found.pins(at);
    let guides = with_friction(guides_of(&found), &rubs);
    let reactions = Forces {
        rolling: (0..scene.rolling.len())
            .map(RollingId)
            .filter_map(|r| Some((r, found.rolling(r, &guides, &teeth)?)))
            .collect(),
        drivers: found.drivers(),
        determinate: is_determined(scene, m),
        balance,
        power,
        smooth,
        pins,
        guides,
        ..Forces::none()
    };
    Some(completed(scene, at, &loads, reactions))
}

impl BodyPoint {
    /// Adds a load at the point to the loads of the unknowns: a force divided by the scale of
    /// lengths, a couple unchanged.
    fn loaded(&self, q: &mut DVector<f64>, wrench: Wrench, scale: f64) {
        let Some(i) = self.first else { return };
        let force = wrench.force * (1.0 / scale);
        q[i] += force.x;
        q[i + 1] += force.y;
        if self.turns {
            q[i + 2] += wrench.couple + self.r.cross(force);
        }
    }
}

/// Returns the force of a row on the first point of its relation, for λ = 1 in a mechanism of size
/// one.
fn on_first(relation: &PositionEquation) -> Vec2 {
    match *relation {
        PositionEquation::Meet { k, .. }
        | PositionEquation::Along { k, .. }
        | PositionEquation::Track { k, .. } => k,
        PositionEquation::Turn { .. } => Vec2::ZERO,
        PositionEquation::Distance { d, .. } => d * (1.0 / d.norm()),
        PositionEquation::Line { d, .. } => d.perp() * (1.0 / d.norm2()),
        PositionEquation::Roll { weights: [u, w], d, .. } => d.perp() * (-(u + w) / d.norm2()),
    }
}

impl LoadMultipliers<'_> {
    /// Returns the force (N) of a row on the first point of its relation.
    fn force(&self, k: usize) -> Vec2 {
        on_first(&self.rows[k].relation) * (self.lambda[k] * self.layout.scale)
    }

    fn rows_of(&self, of: EquationPair) -> impl Iterator<Item = (usize, &EquationRow)> {
        self.rows.iter().enumerate().filter(move |(_, row)| row.of == of)
    }

    /// Returns the balancing moment or force of each driver.
    fn drivers(&self) -> Vec<f64> {
        let of = |d: usize| {
            let kind = &self.scene.drivers[d].kind;
            let (slides, stretches) = (kind.guide().is_some(), kind.ends().is_some());
            let driven = |(k, row): (usize, &EquationRow)| {
                let scale = self.layout.scale;
                // A rotary driver has rows of angles; along an arc s = ρψ, and the moment is
                // divided by the radius.
                let unit = match (row.relation, kind.turns()) {
                    (PositionEquation::Turn { .. }, true) => 1.0,
                    (PositionEquation::Along { .. }, false) if slides => scale,
                    (PositionEquation::Distance { .. }, false) if stretches => scale,
                    (PositionEquation::Line { d, .. }, false) if slides => scale / d.norm(),
                    (_, true | false) => return None,
                };
                Some(self.lambda[k] * unit)
            };
            self.rows_of(EquationPair::Driver(d)).find_map(driven).unwrap_or(0.0)
        };
        (0..self.scene.drivers.len()).map(of).collect()
    }

    /// Returns the force on the runner of a guide, and the couple on its slider.
    fn guide(&self, g: GuideId) -> Option<Wrench> {
        let slider = self.scene.guides[g.0].slider.and_then(|s| self.layout.first_of(s));
        let mut rows = self.rows_of(EquationPair::Guide(g)).peekable();
        rows.peek()?;
        Some(rows.fold(Wrench::zero(), |sum, (k, row)| {
            let is_slider = |h: BodyPoint| slider.is_some() && h.first == slider;
            let turned = match row.relation {
                PositionEquation::Turn { a, b, .. } => {
                    f64::from(u8::from(is_slider(a))) - f64::from(u8::from(is_slider(b)))
                }
                PositionEquation::Line { body, .. } if is_slider(body) => -1.0,
                PositionEquation::Meet { .. }
                | PositionEquation::Along { .. }
                | PositionEquation::Distance { .. }
                | PositionEquation::Line { .. }
                | PositionEquation::Roll { .. }
                | PositionEquation::Track { .. } => 0.0,
            };
            sum.plus(Wrench { force: self.force(k), couple: turned * self.lambda[k] })
        }))
    }

    /// Returns the force of the first link of a rolling pair on the second along their common
    /// tangent.
    fn tangential(&self, r: RollingId) -> Option<Vec2> {
        let (k, _) = self.rows_of(EquationPair::Rolling(r)).next()?;
        matches!(self.scene.rolling[r.0].touch(), Touch::Point(_)).then(|| self.force(k))
    }

    /// Returns the complete force of a rolling pair: the guide that holds the two in contact
    /// carries a part, and teeth press them apart.
    fn rolling(&self, r: RollingId, guides: &[(GuideId, Wrench)], teeth: &[Load]) -> Option<Vec2> {
        let pair = &self.scene.rolling[r.0];
        let held = pair
            .guide()
            .and_then(|g| guides.iter().find(|(own, _)| *own == g))
            .map_or(Vec2::ZERO, |(_, w)| w.force);
        Some(self.tangential(r)? + held + pressed_apart(self.scene, teeth, r))
    }

    /// Returns the forces of rows on pins, each with the link on which it acts; a row itself
    /// assigns its force to the first link that carries the pin.
    fn attached(&self) -> Vec<(PointId, Option<LinkId>, Vec2)> {
        let mut out = Vec::new();
        for (k, row) in self.rows.iter().enumerate() {
            let force = self.force(k);
            let mut guided = |g: GuideId| {
                let guide = &self.scene.guides[g.0];
                out.extend(
                    guide
                        .pin
                        .filter(|_| !matches!(row.relation, PositionEquation::Turn { .. }))
                        .map(|p| (p, guide.slider, force)),
                );
            };
            match row.of {
                EquationPair::Guide(g) => guided(g),
                EquationPair::Driver(d) => {
                    let kind = &self.scene.drivers[d].kind;
                    if let Some(guide) = kind.guide() {
                        guided(guide);
                    }
                    if let Some([a, b]) = kind.ends() {
                        let part = |k: usize| kind.parts().get(k).copied();
                        out.extend([(b, part(1), force), (a, part(0), -force)]);
                    }
                }
                EquationPair::Pin(_) | EquationPair::Rolling(_) => {}
            }
        }
        out
    }

    /// Returns the force of each pin on each of its links.
    fn pins(&self, at: &Configuration) -> Vec<(PointId, LinkId, Vec2)> {
        let attached = self.attached();
        let mut out = Vec::new();
        for p in (0..self.scene.points.len()).map(PointId).filter(|p| at.points[p.0].is_some()) {
            let part = |l: &LinkId| *l == self.scene.ground || self.layout.first_of(*l).is_some();
            let carriers: Vec<LinkId> = self.scene.carriers(p).filter(part).collect();
            let here: Vec<_> = attached.iter().filter(|(own, ..)| *own == p).collect();
            if carriers.len() + here.len() < 2 {
                continue;
            }
            // The ground has no unknowns: its force is what the sum of all forces leaves.
            let mut sum = Vec2::ZERO;
            for l in carriers.iter().filter(|l| **l != self.scene.ground) {
                let first = self.layout.first_of(*l);
                let of_row = |(k, row): (usize, &EquationRow)| {
                    let PositionEquation::Meet { p, q, k: u } = row.relation else {
                        return Vec2::ZERO;
                    };
                    let sign = f64::from(u8::from(p.first == first))
                        - f64::from(u8::from(q.first == first));
                    u * (sign * self.lambda[k] * self.layout.scale)
                };
                let mut force = self
                    .rows_of(EquationPair::Pin(p))
                    .fold(Vec2::ZERO, |sum, row| sum + of_row(row));
                for (_, owner, x) in &here {
                    if self.layout.handle_of(self.scene, p) == Some(*l) {
                        force += *x;
                    }
                    if *owner == Some(*l) {
                        force += -*x;
                    }
                }
                sum += force;
                out.push((p, *l, force));
            }
            if carriers.contains(&self.scene.ground) {
                let unowned = here.iter().filter(|(_, owner, _)| {
                    owner.is_none_or(|l| l == self.scene.ground || !part(&l))
                });
                let others = unowned.fold(Vec2::ZERO, |sum, (.., x)| sum + *x);
                out.push((p, self.scene.ground, others - sum));
            }
        }
        out
    }
}
