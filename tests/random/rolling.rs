//! Random mechanisms with gears, planets and rolling wheels, attached to dyads: the drawing, the
//! loop equations, differences of positions and the theory of rolling contact agree.

use crate::properties::{seeds, worked};
use crate::rng::Rng;
use crate::wide::every;
use hodograph::answer::{AnswerValue, MotionSource};
use hodograph::geom::{Point, Vec2};
use hodograph::mechanism::Level;
use hodograph::position::newton;
use hodograph::scene::{Contours, Scene};
use hodograph::worked::Worked;

/// A circle with which gears may mesh: the link, its centre, its radius.
#[derive(Clone, Copy)]
struct Wheel {
    link: usize,
    centre: usize,
    radius: f64,
}

/// The mechanism so far: link 0 is ground.
#[derive(Default)]
struct Grown {
    points: Vec<Point>,
    links: Vec<Vec<usize>>,
    wheels: Vec<Wheel>,
    gears: Vec<String>,
    rolling: Vec<String>,
    belts: Vec<String>,
    /// Contact points with the two links.
    contacts: Vec<(String, [usize; 2])>,
}

impl Grown {
    fn point(&mut self, at: Point) -> usize {
        self.points.push(at);
        self.points.len() - 1
    }

    fn link(&mut self, points: Vec<usize>) -> usize {
        self.links.push(points);
        self.links.len() - 1
    }

    fn contact(&mut self, links: [usize; 2]) -> String {
        let name = format!("K{}", self.contacts.len());
        self.contacts.push((name.clone(), links));
        name
    }

    fn gear(
        &mut self,
        [a, b]: [usize; 2],
        [p, q]: [usize; 2],
        [r, s]: [f64; 2],
        ring: Option<usize>,
    ) {
        let at = self.contact([a, b]);
        let ring = ring.map_or(String::new(), |l| format!(", \"ring\": \"{l}\""));
        self.gears.push(format!(
            "{{\"links\": [\"{a}\", \"{b}\"], \"centres\": [\"P{p}\", \"P{q}\"], \"radii\": [\"{r:?} m\", \"{s:?} m\"], \"at\": \"{at}\"{ring}}}"
        ));
    }

    /// A gear pinned to a link that carries the centre of a wheel, in mesh with it.
    fn meshed(&mut self, rng: &mut Rng) {
        let on = self.wheels[rng.below(self.wheels.len())];
        let arms: Vec<usize> = (0..self.links.len())
            .filter(|l| *l != on.link && self.links[*l].contains(&on.centre))
            .collect();
        if arms.is_empty() {
            return;
        }
        let (arm, radius, inside) = (rng.pick(&arms), rng.between(0.4, 1.5), rng.chance(0.3));
        // Internal: the new one is a ring about the existing one.
        let radius = if inside { on.radius + radius } else { radius };
        let distance = if inside { radius - on.radius } else { radius + on.radius };
        let centre = self.point(self.points[on.centre] + rng.direction() * distance);
        self.links[arm].push(centre);
        let end = self.point(self.points[centre] + rng.direction() * rng.between(0.5, 1.5));
        let link = self.link(vec![centre, end]);
        self.gear(
            [on.link, link],
            [on.centre, centre],
            [on.radius, radius],
            inside.then_some(link),
        );
        if !inside {
            self.wheels.push(Wheel { link, centre, radius });
        }
    }

    /// A pulley on a link that carries the centre of a wheel, and a belt round both, open or
    /// crossed.
    fn belted(&mut self, rng: &mut Rng) {
        let on = self.wheels[rng.below(self.wheels.len())];
        let arms: Vec<usize> = (0..self.links.len())
            .filter(|l| *l != on.link && self.links[*l].contains(&on.centre))
            .collect();
        if arms.is_empty() {
            return;
        }
        let (arm, radius, crossed) = (rng.pick(&arms), rng.between(0.3, 1.5), rng.chance(0.5));
        let distance = (on.radius + radius) * rng.between(1.1, 2.0);
        let centre = self.point(self.points[on.centre] + rng.direction() * distance);
        self.links[arm].push(centre);
        let end = self.point(self.points[centre] + rng.direction() * rng.between(0.5, 1.5));
        let link = self.link(vec![centre, end]);
        let (n, first) = (self.belts.len(), on.link);
        self.belts.push(format!(
            "{{\"pulleys\": [\"{first}\", \"{link}\"], \"centres\": [\"P{}\", \"P{centre}\"], \"radii\": [\"{:?} m\", \"{radius:?} m\"], \"crossed\": {crossed}, \"at\": [\"M{n}\", \"N{n}\"]}}",
            on.centre, on.radius
        ));
        self.wheels.push(Wheel { link, centre, radius });
    }

    /// An arm about a wheel on the ground with a planet between it and a fixed ring.
    fn planet(&mut self, rng: &mut Rng) {
        let Some(sun) =
            self.wheels.iter().copied().find(|w| w.link != 0 && self.links[0].contains(&w.centre))
        else {
            return;
        };
        let radius = rng.between(0.3, 0.9);
        let centre = self.point(self.points[sun.centre] + rng.direction() * (sun.radius + radius));
        let end = self.point(self.points[centre] + rng.direction() * rng.between(0.3, 1.0));
        self.link(vec![sun.centre, centre]);
        let planet = self.link(vec![centre, end]);
        self.gear([sun.link, planet], [sun.centre, centre], [sun.radius, radius], None);
        self.gear([planet, 0], [centre, sun.centre], [radius, sun.radius + 2.0 * radius], Some(0));
        self.wheels.push(Wheel { link: planet, centre, radius });
    }

    /// A point of a moving link.
    fn mover(&self, rng: &mut Rng) -> usize {
        let moving: Vec<usize> = self.links[1..]
            .iter()
            .flatten()
            .copied()
            .filter(|p| !self.links[0].contains(p))
            .collect();
        rng.pick(&moving)
    }

    /// A rod from a moving point to the centre of a wheel that rolls on a straight track, or on a
    /// round one outside or inside.
    fn rolls(&mut self, rng: &mut Rng) {
        let from = self.mover(rng);
        let (along, length) = (rng.direction(), rng.between(1.5, 3.0));
        let centre = self.point(self.points[from] + along * length);
        let end = self.point(self.points[centre] + rng.direction() * rng.between(0.3, 0.8));
        self.link(vec![from, centre]);
        let wheel = self.link(vec![centre, end]);
        let radius = rng.between(0.3, 0.8);
        let at = self.contact([0, wheel]);
        // The centre's path is nearly along the rod, so that the two loci intersect well.
        let way = along.rotate_by(Vec2::from_angle(rng.between(-0.8, 0.8)));
        let head = format!(
            "\"wheel\": \"{wheel}\", \"centre\": \"P{centre}\", \"radius\": \"{radius:?} m\", \"at\": \"{at}\""
        );
        let track = match rng.below(3) {
            0 => format!("{{{head}, \"angle\": \"{:?} rad\"}}", way.angle()),
            kind => {
                let track = radius + rng.between(0.8, 2.0);
                let distance = if kind == 1 { track + radius } else { track - radius };
                let middle = self.point(self.points[centre] + way.perp() * distance);
                self.links[0].push(middle);
                format!(
                    "{{{head}, \"track\": \"P{middle}\", \"track_radius\": \"{track:?} m\", \"inside\": {}}}",
                    kind == 2
                )
            }
        };
        self.rolling.push(track);
        self.wheels.push(Wheel { link: wheel, centre, radius });
    }

    /// Two bars from a moving point to the ground.
    fn dyad(&mut self, rng: &mut Rng) {
        let from = self.mover(rng);
        let along = rng.direction();
        let joint = self.point(self.points[from] + along * rng.between(1.0, 2.5));
        let across = along.rotate_by(Vec2::from_angle(rng.between(0.8, 2.3)));
        let pivot = self.point(self.points[joint] + across * rng.between(1.0, 2.5));
        self.links[0].push(pivot);
        self.link(vec![from, joint]);
        let rocker = self.link(vec![joint, pivot]);
        self.wheels.push(Wheel { link: rocker, centre: joint, radius: rng.between(0.3, 0.8) });
    }

    /// Three links from a moving point to the ground, the first in mesh with the last while neither
    /// is known before the other.
    fn waiting(&mut self, rng: &mut Rng) {
        let from = self.mover(rng);
        loop {
            let (arm, part) = (rng.direction() * rng.between(0.8, 2.0), rng.between(0.3, 0.7));
            let first = self.points[from] + rng.direction() * rng.between(0.8, 2.0);
            let second = first + arm;
            let pivot = second + rng.direction() * rng.between(0.8, 2.0);
            // As the two are pinned at their contact, this is a dyad.
            let contact = first + arm * part;
            let (Some(u), Some(w)) =
                ((contact - self.points[from]).unit(), (pivot - contact).unit())
            else {
                continue;
            };
            if u.cross(w).abs() < 0.4 {
                continue;
            }
            let [c, d, e] = [first, second, pivot].map(|p| self.point(p));
            let one = self.link(vec![from, c]);
            self.link(vec![c, d]);
            let other = self.link(vec![d, e]);
            self.links[0].push(e);
            self.gear([one, other], [c, d], [arm.norm() * part, arm.norm() * (1.0 - part)], None);
            return;
        }
    }

    fn scene(&self, rng: &mut Rng) -> String {
        let links: Vec<String> = self
            .links
            .iter()
            .enumerate()
            .map(|(l, points)| {
                let points: Vec<String> = points.iter().map(|p| format!("\"P{p}\"")).collect();
                format!("\"{l}\": [{}]", points.join(", "))
            })
            .collect();
        let points: Vec<String> = self
            .points
            .iter()
            .enumerate()
            .map(|(i, p)| format!("\"P{i}\": [\"{:?} m\", \"{:?} m\"]", p.x, p.y))
            .collect();
        let moving = (0..self.points.len()).filter(|p| !self.links[0].contains(p));
        let mut find: Vec<String> =
            moving.flat_map(|p| [format!("\"v_P{p}\""), format!("\"a_P{p}\"")]).collect();
        find.extend(
            (1..self.links.len())
                .flat_map(|l| [format!("\"omega_{l}\""), format!("\"alpha_{l}\"")]),
        );
        for (name, links) in &self.contacts {
            let moving = links.iter().filter(|l| **l != 0);
            find.extend(
                moving.flat_map(|l| [format!("\"v_{name},{l}\""), format!("\"a_{name},{l}\"")]),
            );
        }
        find.retain(|f| !f.contains(','));
        format!(
            "{{\"links\": {{{}}}, \"ground\": \"0\", \"points\": {{{}}}, \"gears\": [{}], \"rolling\": [{}], \"belts\": [{}], \"driver\": {{\"link\": \"1\", \"omega\": \"{:?} rad/s\", \"alpha\": \"{:?} rad/s^2\"}}, \"find\": [{}]}}",
            links.join(", "),
            points.join(", "),
            self.gears.join(", "),
            self.rolling.join(", "),
            self.belts.join(", "),
            rng.between(0.5, 2.0),
            rng.between(-1.0, 1.0),
            find.join(", "),
        )
    }
}

fn grown(seed: u64) -> (Grown, String) {
    let mut rng = Rng::new(seed);
    let mut g = Grown::default();
    let pivot = g.point(Point::new(0.0, 0.0));
    let end = g.point(Point::ORIGIN + rng.direction() * rng.between(0.6, 1.2));
    g.link(vec![pivot]);
    g.link(vec![pivot, end]);
    g.wheels.push(Wheel { link: 1, centre: pivot, radius: rng.between(0.5, 1.5) });
    // A fixed wheel about the same pivot: planets on the crank roll on it.
    g.wheels.push(Wheel { link: 0, centre: pivot, radius: rng.between(0.5, 1.5) });
    for _ in 0..1 + rng.below(5) {
        match rng.below(5) {
            0 | 1 => g.meshed(&mut rng),
            2 => g.planet(&mut rng),
            3 => g.rolls(&mut rng),
            _ => g.dyad(&mut rng),
        }
    }
    if seed % 3 == 2 {
        g.belted(&mut rng);
        g.dyad(&mut rng);
        g.belted(&mut rng);
    }
    // In every second one, a pair is solved as a whole.
    if seed % 2 == 1 {
        g.waiting(&mut rng);
    }
    let text = g.scene(&mut rng);
    (g, text)
}

/// Poses with a worse intersection of loci are grown, but judged only by the agreement's own bound.
const WELL: f64 = 1e4;

fn size(v: AnswerValue) -> f64 {
    v.magnitude()
}

fn apart(a: AnswerValue, b: AnswerValue) -> f64 {
    match (a, b) {
        (AnswerValue::Vector(a), AnswerValue::Vector(b)) => (a - b).norm(),
        (AnswerValue::Scalar(a), AnswerValue::Scalar(b)) => (a - b).abs(),
        _ => f64::INFINITY,
    }
}

fn largest(w: &Worked, level: Level, scene: &Scene) -> f64 {
    let of = w.results.iter().filter(|r| scene.find[r.find].what.level() == level);
    of.map(|r| size(r.computed)).fold(1e-9, f64::max)
}

fn each(own: u64, mut check: impl FnMut(u64, &Grown, &Scene, &Worked)) {
    let mut solved = 0;
    for seed in seeds(own) {
        let (g, text) = grown(seed);
        match worked(seed, &text) {
            Ok((scene, w)) => {
                solved += 1;
                check(seed, &g, &scene, &w);
            }
            Err(f) => {
                let dead = f.list.iter().all(|d| {
                    ["dead-centre", "disagreement", "singular"].contains(&d.code) || !f.has_errors()
                });
                assert!(dead, "seed {seed}: {f}\n{text}");
            }
        }
    }
    let tried = seeds(own).end;
    assert!(solved * 20 > tried * 19, "{solved} of {tried} solved");
}

/// The drawing agrees with the loop equations.
#[test]
fn rolling_is_drawn_as_it_is_computed() {
    each(150, |seed, _, scene, w| {
        for r in &w.results {
            let text = &scene.find[r.find].text;
            let Some(drawn) = &r.drawn else {
                assert!(!w.plan.undrawable.is_empty(), "seed {seed}: {text} is not drawn");
                continue;
            };
            let level = scene.find[r.find].what.level();
            let off = apart(drawn.value, r.computed) / largest(w, level, scene);
            assert!(
                off < 1e-11 * w.solution.condition.max(1.0),
                "seed {seed}: {text} is off by {off:e} (condition {:e})",
                w.solution.condition
            );
        }
    });
}

/// Velocities and accelerations agree with differences of the positions by Newton's method,
/// including rolled wheels.
#[test]
fn rolling_moves_as_its_rates_say() {
    const STEP: f64 = 1e-4;
    each(60, |seed, g, scene, w| {
        if w.solution.condition > WELL {
            return;
        }
        let values = newton::driver_values(scene, &w.configuration);
        let at = |h: f64| {
            let mut v = values.clone();
            v.0[0] += h;
            newton::moved(scene, &w.mechanism, &w.configuration, &v)
                .unwrap_or_else(|| panic!("seed {seed}: not moved"))
        };
        let (minus, plus) = (at(-STEP), at(STEP));
        let driver = &scene.drivers[0];
        let (rate, acceleration) =
            (driver.rate.value, driver.acceleration.as_ref().map_or(0.0, |a| a.value));
        for (p, point) in scene.points.iter().enumerate().take(g.points.len()) {
            let (a, b, c) = (
                minus.points[p].unwrap(),
                w.configuration.points[p].unwrap(),
                plus.points[p].unwrap(),
            );
            let slope = (c - a) * (0.5 / STEP);
            let bend = ((c - b) - (b - a)) * (1.0 / (STEP * STEP));
            let (v, acc) = (slope * rate, bend * (rate * rate) + slope * acceleration);
            let of = |level| w.solution.vector(level, hodograph::scene::PointId(p), None);
            let (Some(v0), Some(a0)) = (of(Level::Velocity), of(Level::Acceleration)) else {
                continue;
            };
            let (sv, sa) =
                (largest(w, Level::Velocity, scene), largest(w, Level::Acceleration, scene));
            assert!(
                (v - v0).norm() < 1e-4 * sv,
                "seed {seed}: v of {} is {v0:?}, differences say {v:?}",
                point.name
            );
            assert!(
                (acc - a0).norm() < 1e-3 * sa.max(sv),
                "seed {seed}: a of {} is {a0:?}, differences say {acc:?}",
                point.name
            );
        }
    });
}

/// At a contact both points have the same velocity, and their accelerations differ by (ω₂ − ω₁)²
/// ρ₁ρ₂/(ρ₁ + ρ₂) along the normal.
#[test]
fn contacts_roll() {
    let mut contacts = 0;
    each(100, |seed, _, scene, w| {
        if w.solution.condition > WELL {
            return;
        }
        let (sv, sa) = (largest(w, Level::Velocity, scene), largest(w, Level::Acceleration, scene));
        for (r, pair) in scene.rolling.iter().enumerate() {
            let of = |level, i: usize| w.solution.vector(level, pair.at[i], Some(pair.links[i]));
            let omega = |i: usize| w.solution.turning(Level::Velocity, pair.links[i]);
            let (Some(v1), Some(v2), Some(a1), Some(a2), Some(w1), Some(w2)) = (
                of(Level::Velocity, 0),
                of(Level::Velocity, 1),
                of(Level::Acceleration, 0),
                of(Level::Acceleration, 1),
                omega(0),
                omega(1),
            ) else {
                continue;
            };
            let [r1, r2] = w.configuration.shapes.rolling[r];
            let delta = match pair.contours {
                Contours::Circles { .. } => r1 * r2 / (r1 + r2),
                Contours::Track { .. } => r2,
                // Its ends are at two places: see tests/wheels/belts.rs.
                Contours::Belt { .. } => continue,
            };
            let n = w.configuration.normal(scene, hodograph::scene::RollingId(r)).unwrap();
            let expected = n * ((w2 - w1) * (w2 - w1) * delta);
            assert!(
                (v2 - v1).norm() < 1e-10 * sv,
                "seed {seed}: {} slips by {:?}",
                scene.point_name(pair.at[0]),
                v2 - v1
            );
            let off = (a2 - a1 - expected).norm() / sa;
            assert!(
                off < 1e-9,
                "seed {seed}: at {} the accelerations differ by {:?}, not {expected:?}",
                scene.point_name(pair.at[0]),
                a2 - a1
            );
            contacts += 1;
        }
    });
    assert!(contacts > 100 / every(8), "{contacts} contacts");
}
