//! The rows of the Jacobian and of its right-hand sides.
//!
//! Lengths are divided by a power of two near the size of the mechanism: rows of lengths and of
//! angles are then comparable, and scaling the scene by 2^k changes no digit.

use super::cams::is_of_law;
use super::relation::{
    BodyPoint, EquationPair, EquationRow, PositionEquation, along_line, distance, projection,
};
use super::{LinkRates, Solution};
use hodograph_base::geom::{Point, Vec2};
use hodograph_mechanism::mechanism::{
    Demand, Level, Mechanism, Opened, PairForm, PairItem, Runner, constraints_of,
};
use hodograph_mechanism::position::{Configuration, Path};
use hodograph_scene::quantity::met_at;
use hodograph_scene::{GuideId, LinkId, PointId, Relation as Linear, RollingId, Scene};
use nalgebra::DVector;

/// The way in which the other links at a point constrain a link there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum PinConstraint {
    /// Completely, as at every pin.
    Whole,
    /// Completely, but after all others there: the link only repeats their constraints.
    Last,
    /// At the second pin of such a link: square to the line from the first.
    Across(PointId),
    /// At a further pin of such a link: not at all.
    Not,
}

/// The unknowns of one level: the links and pins that the demand covers there.
pub(super) struct UnknownLayout {
    pub links: Vec<LinkId>,
    pub bare: Vec<PointId>,
    pub unknowns: usize,
    /// For each link of the scene its index among the unknown ones.
    index: Vec<Option<usize>>,
    /// True if everything here is requested up to its acceleration.
    pub second: bool,
    pub origins: Vec<Option<Point>>,
    /// 1 / (power of two near the mechanism's size).
    pub scale: f64,
    /// The opened items, which only repeat other constraints; for a link with the two pins at which
    /// it is held.
    opened: Vec<(Opened, Option<(PointId, PointId)>)>,
    /// For each guide true if it constrains: a guide between gears may only repeat other pairs.
    holds: Vec<bool>,
    /// Links that turn together because a block that takes no part runs in guides of both, with one
    /// of the guides.
    together: Vec<(LinkId, LinkId, GuideId)>,
}

impl UnknownLayout {
    /// Creates the layout of everything that the demand requests at `level` (velocity or
    /// acceleration), with its prerequisites.
    pub fn new(
        scene: &Scene,
        m: &Mechanism,
        at: &Configuration,
        demand: &Demand,
        level: Level,
    ) -> UnknownLayout {
        let links = super::taking_part(scene, m, at, demand, level);
        let mut index = vec![None; scene.links.len()];
        for (i, l) in links.iter().enumerate() {
            index[l.0] = Some(i);
        }
        // A pin may be requested without the links on it, which only follow it.
        let bare: Vec<PointId> = m
            .pins
            .iter()
            .copied()
            .filter(|p| m.group_of_pin[p.0].is_some_and(|g| demand.wants(g, level)))
            .filter(|p| !scene.carriers(*p).any(|l| l == scene.ground || index[l.0].is_some()))
            .collect();
        // The origin of a link's unknowns is one of its own points, so that arms are short and an
        // offset of all coordinates costs no digits.
        let mut origins = vec![None; scene.links.len()];
        for &l in links.iter().chain([&scene.ground]) {
            origins[l.0] = met_at(scene, l)
                .find_map(|p| at.points[p.0])
                .or_else(|| at.poses[l.0].map(|p| p.origin));
        }
        let unknowns = 3 * links.len() + 2 * bare.len();
        let second =
            level == Level::Acceleration || (0..m.groups.len()).all(|g| deepest(demand, g));
        let scale = hodograph_mechanism::position::kernel::power_of_two_scale(at.extent());
        let pins = |o: &Opened| if let Opened::Link(l) = o { m.held(*l) } else { None };
        let opened = m.redundant.iter().map(|r| (r.opened.clone(), pins(&r.opened))).collect();
        let holds = scene
            .guides
            .iter()
            .enumerate()
            .map(|(g, guide)| m.guide_holds(guide, GuideId(g)))
            .collect();
        let locked = m.constraints.iter().filter_map(|c| match c.item() {
            PairItem::Guide(g) => c.form().locks().map(|(a, b)| (a, b, g)),
            PairItem::Pin(..) | PairItem::Driver(_) | PairItem::Rolling(_) => None,
        });
        let together =
            locked.filter(|(.., g)| scene.guides[g.0].slider.is_some_and(|s| !links.contains(&s)));
        let together = together
            .filter(|(a, b, _)| [a, b].iter().all(|l| **l == scene.ground || links.contains(l)))
            .collect();
        UnknownLayout {
            links,
            bare,
            unknowns,
            index,
            second,
            origins,
            scale,
            opened,
            holds,
            together,
        }
    }

    /// Returns the rates of this layout's unknowns, from those of a larger layout.
    pub fn rates_from(
        &self,
        scene: &Scene,
        at: &Configuration,
        whole: &UnknownLayout,
        rates: &DVector<f64>,
    ) -> Option<DVector<f64>> {
        let mut out = Vec::with_capacity(self.unknowns);
        for l in &self.links {
            let i = 3 * whole.index[l.0]?;
            out.extend([rates[i], rates[i + 1], rates[i + 2]]);
        }
        for &p in &self.bare {
            // A pin without a link here may be on a link there.
            let v = whole.pin(scene, p, at.points[p.0]?)?.velocity(rates);
            out.extend([v.x, v.y]);
        }
        Some(DVector::from_vec(out))
    }

    /// Returns the first unknown of a link.
    pub fn first_of(&self, l: LinkId) -> Option<usize> {
        self.index[l.0].map(|i| 3 * i)
    }

    /// Returns the link whose unknowns represent a pin in the rows; `None` for a bare pin.
    pub fn handle_of(&self, scene: &Scene, p: PointId) -> Option<LinkId> {
        let bare = self.bare.contains(&p);
        scene.carriers(p).find(|l| !bare && (*l == scene.ground || self.index[l.0].is_some()))
    }

    pub(super) fn body(&self, scene: &Scene, l: LinkId, p: Point) -> Option<BodyPoint> {
        if l == scene.ground {
            return Some(BodyPoint { first: None, turns: false, r: Vec2::ZERO });
        }
        let i = self.index[l.0]?;
        Some(BodyPoint {
            first: Some(3 * i),
            turns: true,
            r: (p - self.origins[l.0]?) * self.scale,
        })
    }

    /// Returns the link of an unknown; `None` for an unknown of a bare pin.
    pub fn link_of(&self, unknown: usize) -> Option<LinkId> {
        self.links.get(unknown / 3).copied()
    }

    /// Returns the bare pin of an unknown.
    pub fn bare_of(&self, unknown: usize) -> Option<PointId> {
        self.bare.get(unknown.checked_sub(3 * self.links.len())? / 2).copied()
    }

    /// Returns the relative rounding of the coefficients: arms are differences of positions, which
    /// are rounded at their own size.
    pub fn rounding(&self, at: &Configuration) -> f64 {
        let far = at.points.iter().flatten().map(|p| p.x.abs().max(p.y.abs())).fold(0.0, f64::max);
        f64::EPSILON * (far * self.scale).max(1.0)
    }

    /// Returns the moving body at a pin: a link that carries it, or the bare pin.
    fn pin(&self, scene: &Scene, p: PointId, at: Point) -> Option<BodyPoint> {
        if let Some(i) = self.bare.iter().position(|q| *q == p) {
            return Some(BodyPoint {
                first: Some(3 * self.links.len() + 2 * i),
                turns: false,
                r: Vec2::ZERO,
            });
        }
        scene.carriers(p).find_map(|l| self.body(scene, l, at))
    }

    pub fn rows(&self, scene: &Scene, at: &Configuration) -> Vec<EquationRow> {
        let mut rows = Vec::new();
        self.by_laws(scene, at, &mut rows);
        self.of_pairs(scene, at, |g| !is_of_law(scene, g), rows)
    }

    /// Returns the rows with which links press on each other: a cam with a law touches its
    /// follower, which the row of the law does not express.
    pub fn rows_of_contacts(&self, scene: &Scene, at: &Configuration) -> Vec<EquationRow> {
        self.of_pairs(scene, at, |_| true, Vec::new())
    }

    fn of_pairs(
        &self,
        scene: &Scene,
        at: &Configuration,
        guides: impl Fn(GuideId) -> bool,
        by_laws: Vec<EquationRow>,
    ) -> Vec<EquationRow> {
        let mut rows = Vec::new();
        self.revolutes(scene, at, &mut rows);
        rows.extend(by_laws);
        let demanded = |item: PairItem, of: EquationPair| {
            constraints_of(scene, item).map(move |c| (c.form(), of))
        };
        for g in (0..scene.guides.len()).map(GuideId).filter(|g| self.holds[g.0] && guides(*g)) {
            let (turning, places): (Vec<_>, Vec<_>) =
                demanded(PairItem::Guide(g), EquationPair::Guide(g))
                    .partition(|(form, _)| matches!(form, PairForm::Angles { .. }));
            turning.into_iter().for_each(|(form, of)| self.demand(scene, at, form, of, &mut rows));
            self.block_on_arc(scene, at, g, &mut rows);
            places.into_iter().for_each(|(form, of)| self.demand(scene, at, form, of, &mut rows));
        }
        rows.extend(
            self.together
                .iter()
                .filter_map(|&(a, b, g)| self.lock(scene, a, b, [0.0; 2], EquationPair::Guide(g))),
        );
        let rolling =
            (0..scene.rolling.len()).map(RollingId).filter(|r| self.keeps(&Opened::Rolling(*r)));
        let rolling =
            rolling.flat_map(|r| demanded(PairItem::Rolling(r), EquationPair::Rolling(r)));
        rolling.for_each(|(form, of)| self.demand(scene, at, form, of, &mut rows));
        for d in 0..scene.drivers.len() {
            demanded(PairItem::Driver(d), EquationPair::Driver(d))
                .for_each(|(form, of)| self.demand(scene, at, form, of, &mut rows));
            self.parts(scene, at, d, &mut rows);
        }
        rows
    }

    /// Adds the rows of a form.
    fn demand(
        &self,
        scene: &Scene,
        at: &Configuration,
        form: PairForm,
        of: EquationPair,
        rows: &mut Vec<EquationRow>,
    ) {
        // First and second derivative prescribed by a driver; lengths are in the layout's unit.
        let drive = |unit: f64| match form.driver().map(|d| &scene.drivers[d]) {
            Some(driver) => [
                driver.rate.value * unit,
                driver.acceleration.as_ref().map_or(0.0, |a| a.value) * unit,
            ],
            None => [0.0; 2],
        };
        match form {
            // The links at a pin are joined to one another, without the pin: see `revolutes`.
            PairForm::Meet { .. } => {}
            PairForm::Angles { of: a, against: b, .. } => {
                if self.links.contains(&a) || self.links.contains(&b) {
                    rows.extend(self.lock(scene, a, b, drive(1.0), of));
                }
            }
            PairForm::OnPath { runner, guide, on } => {
                rows.extend(self.on_path(scene, at, (runner, guide, on), of))
            }
            PairForm::AlongPath { runner, guide, on, .. } => {
                rows.extend(self.along_path(scene, at, (runner, guide, on), drive(self.scale), of));
            }
            PairForm::Distance { from, to, .. } => {
                let (Some(pa), Some(pb)) = (at.points[from.0], at.points[to.0]) else { return };
                let (Some(ha), Some(hb)) = (self.pin(scene, from, pa), self.pin(scene, to, pb))
                else {
                    return;
                };
                rows.push(distance(hb, ha, (pb - pa) * self.scale, drive(self.scale), of));
            }
            PairForm::Related { pair, .. } => rows.extend(self.rolling(scene, at, pair)),
        }
    }

    /// Returns true if a pair is not opened.
    fn keeps(&self, what: &Opened) -> bool {
        self.opened.iter().all(|(o, _)| o != what)
    }

    /// Returns the way in which the other links at a point constrain a link there.
    fn held_at(&self, l: LinkId, p: PointId) -> PinConstraint {
        match self.opened.iter().find(|(o, _)| *o == Opened::Link(l)).and_then(|(_, pins)| *pins) {
            None => PinConstraint::Whole,
            Some((a, _)) if a == p => PinConstraint::Last,
            Some((a, b)) if b == p => PinConstraint::Across(a),
            Some(_) => PinConstraint::Not,
        }
    }

    /// All links at a pin have its velocity. A link that only repeats other constraints is held at
    /// its first pin, and at its second pin square to the line of both: along the line the other
    /// links hold it, which remains to be checked.
    fn revolutes(&self, scene: &Scene, at: &Configuration, rows: &mut Vec<EquationRow>) {
        // Links in the order of the scene at each point, without those that take no part.
        let taking_part = |l: &LinkId| *l == scene.ground || self.index[l.0].is_some();
        let mut carried: Vec<(PointId, LinkId)> = (0..scene.links.len())
            .map(LinkId)
            .filter(taking_part)
            .flat_map(|l| scene.links[l.0].points.iter().map(move |p| (*p, l)))
            .filter(|(p, l)| {
                self.keeps(&Opened::Pin(*p, *l)) && self.held_at(*l, *p) != PinConstraint::Not
            })
            .collect();
        // Passive links come last at each point, so that all others stay joined without them.
        carried.sort_by_key(|(p, l)| (p.0, self.held_at(*l, *p) != PinConstraint::Whole));
        for pair in carried.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
            let [(p, a), (_, b)] = [pair[0], pair[1]];
            let Some(place) = at.points[p.0] else { continue };
            let (Some(a), Some(b)) = (self.body(scene, a, place), self.body(scene, b, place))
            else {
                continue;
            };
            let directions = match self.held_at(pair[1].1, p) {
                PinConstraint::Across(from) => at.points[from.0].map_or(vec![], |from| {
                    vec![(place - from).perp() * (1.0 / (place - from).norm())]
                }),
                PinConstraint::Whole | PinConstraint::Last | PinConstraint::Not => {
                    vec![Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0)]
                }
            };
            for k in directions {
                let mut c = Vec::new();
                a.add(&mut c, k);
                b.add(&mut c, -k);
                rows.push(EquationRow {
                    coefficients: c,
                    rate: 0.0,
                    relation: PositionEquation::Meet { p: a, q: b, k },
                    of: EquationPair::Pin(p),
                });
            }
        }
    }

    /// ω_a − ω_b = rate.
    pub(super) fn lock(
        &self,
        scene: &Scene,
        a: LinkId,
        b: LinkId,
        drive: [f64; 2],
        of: EquationPair,
    ) -> Option<EquationRow> {
        let (ha, hb) = (self.body(scene, a, Point::ORIGIN)?, self.body(scene, b, Point::ORIGIN)?);
        let mut c = Vec::new();
        if let Some(i) = ha.first {
            c.push((i + 2, 1.0));
        }
        if let Some(i) = hb.first {
            c.push((i + 2, -1.0));
        }
        Some(EquationRow {
            coefficients: c,
            rate: drive[0],
            relation: PositionEquation::Turn { a: ha, b: hb, drive },
            of,
        })
    }

    /// Returns the runner of a guide, and its position.
    fn runner(
        &self,
        scene: &Scene,
        at: &Configuration,
        runner: Runner,
        on: LinkId,
    ) -> Option<(BodyPoint, Point)> {
        match runner {
            Runner::Pin(p) => at.points[p.0].and_then(|x| Some((self.pin(scene, p, x)?, x))),
            Runner::Link(slider) => {
                let x = self.origins[slider.0].or(self.origins[on.0])?;
                Some((self.body(scene, slider, x)?, x))
            }
        }
    }

    fn on_path(
        &self,
        scene: &Scene,
        at: &Configuration,
        (runner, guide, on): (Runner, GuideId, LinkId),
        of: EquationPair,
    ) -> Option<EquationRow> {
        let (path, (runner, place)) = (at.guides[guide.0]?, self.runner(scene, at, runner, on)?);
        match path {
            Path::Line { through, direction } => {
                let carrier = self.body(scene, on, through)?;
                let moves = runner.first.is_some() || carrier.first.is_some();
                // n·(P − Q) = const, n and Q fixed in the carrier.
                moves.then(|| {
                    projection(
                        runner,
                        carrier,
                        direction.perp(),
                        (place - through) * self.scale,
                        [0.0; 2],
                        of,
                    )
                })
            }
            Path::Arc { centre, .. } => {
                let carrier = self.body(scene, on, centre)?;
                Some(distance(runner, carrier, (place - centre) * self.scale, [0.0; 2], of))
            }
        }
    }

    pub(super) fn along_path(
        &self,
        scene: &Scene,
        at: &Configuration,
        (runner, guide, on): (Runner, GuideId, LinkId),
        drive: [f64; 2],
        of: EquationPair,
    ) -> Option<EquationRow> {
        let ((runner, place), path) = (self.runner(scene, at, runner, on)?, at.guides[guide.0]?);
        match path {
            Path::Line { through, direction } => {
                let carrier = self.body(scene, on, through)?;
                let moves = runner.first.is_some() || carrier.first.is_some();
                moves.then(|| {
                    projection(
                        runner,
                        carrier,
                        direction,
                        (place - through) * self.scale,
                        drive,
                        of,
                    )
                })
            }
            Path::Arc { centre, radius } => {
                // s = ρ (angle of the radius − angle of the carrier).
                let carrier = self.body(scene, on, centre)?;
                let rho = radius * self.scale;
                Some(along_line(
                    carrier,
                    runner,
                    carrier,
                    (place - centre) * self.scale,
                    drive.map(|x| x / rho),
                    of,
                ))
            }
        }
    }

    /// A block in a curved slot turns with the radius to its pin.
    fn block_on_arc(
        &self,
        scene: &Scene,
        at: &Configuration,
        g: GuideId,
        rows: &mut Vec<EquationRow>,
    ) {
        let guide = &scene.guides[g.0];
        let (Some(s), Some(Path::Arc { centre, .. }), Some(p)) =
            (guide.slider, at.guides[g.0], guide.pin)
        else {
            return;
        };
        let Some(place) = at.points[p.0] else { return };
        if let (Some(body), Some(pin), Some(carrier)) = (
            self.body(scene, s, place),
            self.pin(scene, p, place),
            self.body(scene, guide.on, centre),
        ) && self.links.contains(&s)
        {
            rows.push(along_line(
                body,
                pin,
                carrier,
                (place - centre) * self.scale,
                [0.0; 2],
                EquationPair::Guide(g),
            ));
        }
    }

    /// Rolling without slip: ω₁ρ₁ + ω₂ρ₂ = ω_h(ρ₁ + ρ₂), h the line of centres (Willis); on a track
    /// ṡ + ρ(ω₂ − ω₁) = 0.
    fn rolling(&self, scene: &Scene, at: &Configuration, r: RollingId) -> Option<EquationRow> {
        let pair = &scene.rolling[r.0];
        if !pair.links.iter().any(|l| self.links.contains(l)) {
            return None;
        }
        let bodies = pair.links.map(|l| self.body(scene, l, Point::ORIGIN));
        let [a, b] = [bodies[0]?, bodies[1]?];
        let [r1, r2] = at.shapes.rolling[r.0];
        let mut c = Vec::new();
        let relation = match pair.relation() {
            Linear::Turnings([k1, k2]) => {
                let (q, p) = (at.points[k1.0]?, at.points[k2.0]?);
                let d = (p - q) * self.scale;
                let [q, p] =
                    [self.body(scene, pair.links[0], q)?, self.body(scene, pair.links[1], p)?];
                let size = r1.abs().max(r2.abs());
                let weights = [r1 / size, r2 / size];
                let k = d.perp() * (-(weights[0] + weights[1]) / d.norm2());
                p.add(&mut c, k);
                q.add(&mut c, -k);
                c.extend([a, b].iter().zip(weights).filter_map(|(h, w)| Some((h.first? + 2, w))));
                PositionEquation::Roll { bodies: [a, b], weights, p, q, d }
            }
            Linear::Slide { centre, guide } => {
                let Some(Path::Line { through, direction }) = at.guides[guide.0] else {
                    return None;
                };
                let place = at.points[centre.0]?;
                let (p, q) = (
                    self.body(scene, pair.links[1], place)?,
                    self.body(scene, pair.links[0], through)?,
                );
                let (arm, rho) = ((place - through) * self.scale, r2 * self.scale);
                c = projection(p, q, direction, arm, [0.0; 2], EquationPair::Rolling(r))
                    .coefficients;
                c.extend(
                    [(b, rho), (a, -rho)].iter().filter_map(|(h, w)| Some((h.first? + 2, *w))),
                );
                PositionEquation::Track { body: b, rho, p, q, k: direction, arm }
            }
        };
        Some(EquationRow { coefficients: c, rate: 0.0, relation, of: EquationPair::Rolling(r) })
    }

    /// Barrel and rod of a cylinder: each is on its end and turns with the line.
    fn parts(&self, scene: &Scene, at: &Configuration, d: usize, rows: &mut Vec<EquationRow>) {
        let Some([a, b]) = scene.drivers[d].kind.ends() else { return };
        let (Some(pa), Some(pb)) = (at.points[a.0], at.points[b.0]) else { return };
        let (Some(ha), Some(hb)) = (self.pin(scene, a, pa), self.pin(scene, b, pb)) else { return };
        for (i, l) in scene.drivers[d].kind.parts().iter().enumerate() {
            let (end, place) = if i == 0 { (ha, pa) } else { (hb, pb) };
            if let Some(body) = self.body(scene, *l, place)
                && self.links.contains(l)
            {
                if !scene.links[l.0].points.contains(&a) && !scene.links[l.0].points.contains(&b) {
                    for k in [Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0)] {
                        let mut c = Vec::new();
                        body.add(&mut c, k);
                        end.add(&mut c, -k);
                        let relation = PositionEquation::Meet { p: body, q: end, k };
                        rows.push(EquationRow {
                            coefficients: c,
                            rate: 0.0,
                            relation,
                            of: EquationPair::Driver(d),
                        });
                    }
                }
                rows.push(along_line(
                    body,
                    hb,
                    ha,
                    (pb - pa) * self.scale,
                    [0.0; 2],
                    EquationPair::Driver(d),
                ));
            }
        }
    }

    /// Removes unsolved values from a solution: `order` returns for an unknown 0 if nothing, 1 if
    /// its rate, or 2 if also its acceleration is known.
    pub fn keep(&self, order: impl Fn(usize) -> usize, out: &mut Solution) {
        let least =
            |first: usize, many: usize| (first..first + many).map(&order).min().unwrap_or(0);
        for (i, l) in self.links.iter().enumerate() {
            match (least(3 * i, 3), &mut out.links[l.0]) {
                (0, motion) => *motion = None,
                (1, Some(motion)) => motion.second = None,
                _ => {}
            }
        }
        let first = 3 * self.links.len();
        for (level, bare) in out.bare.iter_mut().enumerate() {
            bare.retain(|b| {
                self.bare
                    .iter()
                    .position(|p| *p == b.0)
                    .is_some_and(|i| least(first + 2 * i, 2) > level)
            });
        }
    }

    /// Stores the velocities of the layout's links and pins.
    pub fn unpack_rates(&self, x: &DVector<f64>, out: &mut Solution) {
        for (i, l) in self.links.iter().enumerate() {
            out.links[l.0] =
                Some(LinkRates { v: self.vector(x, 3 * i), omega: x[3 * i + 2], second: None });
        }
        for (i, p) in self.bare.iter().enumerate() {
            out.bare[0].push((*p, self.vector(x, 3 * self.links.len() + 2 * i)));
        }
    }

    /// Stores the accelerations of the layout's links and pins; their velocities are already
    /// stored.
    pub fn unpack_accelerations(&self, x: &DVector<f64>, out: &mut Solution) {
        for (i, l) in self.links.iter().enumerate() {
            if let Some(motion) = &mut out.links[l.0] {
                motion.second = Some((self.vector(x, 3 * i), x[3 * i + 2]));
            }
        }
        for (i, p) in self.bare.iter().enumerate() {
            out.bare[1].push((*p, self.vector(x, 3 * self.links.len() + 2 * i)));
        }
    }

    fn vector(&self, x: &DVector<f64>, i: usize) -> Vec2 {
        Vec2::new(x[i], x[i + 1]) * (1.0 / self.scale)
    }
}

/// Returns true if a group is requested up to its acceleration, or not in motion at all.
fn deepest(demand: &Demand, group: usize) -> bool {
    demand.wants(group, Level::Acceleration) || !demand.wants(group, Level::Velocity)
}
