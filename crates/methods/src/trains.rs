//! Gear trains: Willis' method for all gears with centres on one link, the arm.
//!
//! Relative to the arm h, every mesh is a mesh of two gears with fixed axes: (ω_j − ω_h)/(ω_i −
//! ω_h) = −z_i/z_j, with a plus if one of the two is a ring. The tabular method follows: hold the
//! arm and turn one gear by x, then turn the whole train by y, and add. Two known angular
//! velocities (of the ground, of drivers) give x and y. This module uses numbers of teeth or radii
//! alone; the report compares the results with polygons and loop equations.
//!
//! # Source
//! R. Willis, *Principles of Mechanism*, 1841.

use hodograph_scene::exact::Inputs;
use hodograph_scene::{LinkId, PointId, Relation, RollingId, Scene, Touch};

/// The gears of one arm that mesh with one another.
#[derive(Clone, Debug, PartialEq)]
pub struct GearTrain {
    /// The link that carries all centres; the ground for gears with fixed axes.
    pub arm: LinkId,
    /// The centre about which most of the gears turn.
    pub axis: PointId,
    /// The gears; the first is the one that the table turns.
    pub gears: Vec<TrainGear>,
    /// The meshes.
    pub meshes: Vec<RollingId>,
}

/// A gear of a train.
#[derive(Clone, Debug, PartialEq)]
pub struct TrainGear {
    /// The link.
    pub link: LinkId,
    /// The centre of the gear.
    pub centre: PointId,
    /// (ω − ω_h)/(ω₁ − ω_h), where ω₁ belongs to the first gear of the train.
    pub ratio: TrainRatio,
}

/// A ratio of angular velocities, as a product of sizes.
#[derive(Clone, Debug, PartialEq)]
pub struct TrainRatio {
    /// The value of the ratio.
    pub value: f64,
    /// The sizes in the numerator, in the label language: `z_{2}`, `r'_{3}`.
    pub above: Vec<String>,
    /// The sizes in the denominator.
    pub below: Vec<String>,
}

/// The angular velocities in the two parts of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrainSpeeds {
    /// The arm's angular velocity (rad/s): y.
    pub arm: f64,
    /// The first gear's angular velocity relative to the arm (rad/s): x.
    pub first: f64,
}

impl TrainRatio {
    const ONE: TrainRatio = TrainRatio { value: 1.0, above: Vec::new(), below: Vec::new() };

    /// Returns the ratio after one more mesh, from the gear of size `i` to the gear of size `j`; a
    /// ring has a negative size.
    fn then(&self, [i, j]: [f64; 2], [above, below]: [String; 2]) -> TrainRatio {
        let mut next = TrainRatio { value: -self.value * i / j, ..self.clone() };
        // The size of an idler cancels.
        let put = |size: String, into: &mut Vec<String>, other: &mut Vec<String>| match other
            .iter()
            .position(|s| *s == size)
        {
            Some(k) => drop(other.remove(k)),
            None => into.push(size),
        };
        put(above, &mut next.above, &mut next.below);
        put(below, &mut next.below, &mut next.above);
        next
    }

    /// Returns the reciprocal.
    pub fn inverse(&self) -> TrainRatio {
        TrainRatio { value: 1.0 / self.value, above: self.below.clone(), below: self.above.clone() }
    }

    /// Returns the formula without its sign: `z_{2}/z_{3}`.
    pub fn magnitude(&self) -> String {
        let product = |list: &[String]| match list {
            [] => "1".to_owned(),
            [one] => one.clone(),
            more => format!("({})", more.join(" ")),
        };
        match &self.below[..] {
            [] => product(&self.above),
            below => format!("{}/{}", product(&self.above), product(below)),
        }
    }

    /// Returns the formula.
    pub fn formula(&self) -> String {
        format!("{}{}", if self.value < 0.0 { "−" } else { "" }, self.magnitude())
    }
}

impl GearTrain {
    /// Returns the angular velocity of a gear (rad/s).
    pub fn rate(&self, gear: usize, t: TrainSpeeds) -> f64 {
        t.arm + self.gears[gear].ratio.value * t.first
    }

    /// Returns x and y of the table from two members with angular velocities in `known`; `None` if
    /// fewer are known, or if all known ones have the same ratio.
    pub fn turns(&self, known: impl Fn(LinkId) -> Option<f64>) -> Option<TrainSpeeds> {
        let members = self.gears.iter().map(|g| (g.link, g.ratio.value));
        let told: Vec<(f64, f64)> = std::iter::once((self.arm, 0.0))
            .chain(members)
            .filter_map(|(link, e)| Some((e, known(link)?)))
            .collect();
        let (e, w) = *told.first()?;
        // ω = y + e x for both: gears of the same ratio always have the same angular velocity.
        let (f, v) = *told.iter().find(|(f, _)| *f != e)?;
        let first = (v - w) / (f - e);
        Some(TrainSpeeds { arm: w - e * first, first })
    }

    /// Returns the index of the gear that is part of a link.
    pub fn gear(&self, link: LinkId) -> Option<usize> {
        self.gears.iter().position(|g| g.link == link)
    }
}

/// Returns the angular velocity of a link that the scene gives at once: zero for the ground, the
/// driver's rate for a link driven relative to it.
pub fn given(scene: &Scene, link: LinkId) -> Option<f64> {
    let driven = scene.drivers.iter().find(|d| d.kind.turned() == Some((link, scene.ground)));
    if link == scene.ground { Some(0.0) } else { driven.map(|d| d.rate.value) }
}

/// A mesh between two circles of one arm.
struct TrainMesh {
    id: RollingId,
    arm: LinkId,
    links: [LinkId; 2],
    centres: [PointId; 2],
    sizes: [f64; 2],
    symbols: [String; 2],
}

/// Returns the trains of a scene, in the order of their first meshes.
pub fn trains(scene: &Scene) -> Vec<GearTrain> {
    let mut left = meshes(scene);
    let mut out = Vec::new();
    while !left.is_empty() {
        let mut together = vec![left.remove(0)];
        // All meshes that share a gear with the train.
        while let Some(k) = left.iter().position(|m| {
            m.arm == together[0].arm
                && together.iter().any(|t| t.links.iter().any(|l| m.links.contains(l)))
        }) {
            together.push(left.remove(k));
        }
        together.sort_by_key(|m| m.id);
        out.extend(train(scene, &together));
    }
    out
}

fn meshes(scene: &Scene) -> Vec<TrainMesh> {
    let inputs = Inputs::<f64>::of(scene);
    // The sizes of each link in the order of occurrence: the symbol of the second one has a prime.
    let mut seen: Vec<(LinkId, f64)> = Vec::new();
    let mut out = Vec::new();
    for (k, pair) in scene.rolling.iter().enumerate() {
        // A wheel on its track is no mesh; a belt or chain turns its wheels like an idler between
        // them.
        let Relation::Turnings(centres) = pair.relation() else { continue };
        let toothed = match pair.touch() {
            Touch::Point(_) => pair.flanks.as_ref().map(|f| f.teeth),
            Touch::Strand { .. } => pair.teeth().map(|z| z.map(Some)),
        };
        let carries = |l: usize| centres.iter().all(|c| scene.links[l].points.contains(c));
        let Some(arm) = (0..scene.links.len()).find(|l| carries(*l)).map(LinkId) else { continue };
        if pair.links.contains(&arm) && arm != scene.ground {
            continue;
        }
        let letter = if toothed.is_some() { 'z' } else { 'r' };
        let values = pair.sizes(&inputs);
        let mut symbol = |i: usize| {
            let (link, size) =
                (pair.links[i], toothed.and_then(|z| z[i]).map_or(values[i].abs(), f64::from));
            if !seen.contains(&(link, size)) {
                seen.push((link, size));
            }
            let before = seen.iter().filter(|s| s.0 == link).position(|s| s.1 == size).unwrap_or(0);
            format!("{letter}{}_{{{}}}", "'".repeat(before), scene.link_name(link))
        };
        let symbols = [symbol(0), symbol(1)];
        out.push(TrainMesh {
            id: RollingId(k),
            arm,
            links: pair.links,
            centres,
            sizes: values,
            symbols,
        });
    }
    out
}

fn train(scene: &Scene, meshes: &[TrainMesh]) -> Option<GearTrain> {
    let arm = meshes[0].arm;
    let count = |p: PointId| meshes.iter().filter(|m| m.centres.contains(&p)).count();
    let centres = || meshes.iter().flat_map(|m| m.centres);
    // Among equal centres the fixed one takes precedence, then the first.
    let still = |p: PointId| scene.links[scene.ground.0].points.contains(&p);
    let axis = centres().rev().max_by_key(|p| (count(*p), still(*p)))?;
    let about = meshes
        .iter()
        .flat_map(|m| [0, 1].map(|i| (m.links[i], m.centres[i])))
        .filter(|(_, c)| *c == axis);
    let (first, centre) =
        about.min_by_key(|(l, _)| (*l == scene.ground, given(scene, *l).is_none()))?;
    let mut gears = vec![TrainGear { link: first, centre, ratio: TrainRatio::ONE }];
    loop {
        let step = meshes.iter().find_map(|m| {
            [[0, 1], [1, 0]].into_iter().find_map(|[i, j]| {
                let from = gears.iter().find(|g| g.link == m.links[i])?;
                let new = gears.iter().all(|g| g.link != m.links[j]);
                let symbols = [m.symbols[i].clone(), m.symbols[j].clone()];
                new.then(|| TrainGear {
                    link: m.links[j],
                    centre: m.centres[j],
                    ratio: from.ratio.then([m.sizes[i], m.sizes[j]], symbols),
                })
            })
        });
        match step {
            Some(gear) => gears.push(gear),
            None => break,
        }
    }
    Some(GearTrain { arm, axis, gears, meshes: meshes.iter().map(|m| m.id).collect() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use hodograph_mechanism::answer::MotionSource;
    use hodograph_mechanism::mechanism::Level;
    use hodograph_scene::read;
    use hodograph_worked::worked::{Scope, work};

    /// A train: links, gears, drivers; then ratios to the driver's angular velocity as printed in
    /// books.
    type TrainCase = (&'static str, &'static str, &'static str, &'static [(&'static str, f64)]);

    const TRAINS: &[TrainCase] = &[
        // Shigley, example 13-6: sun 20, planet 30, ring 80 held, sun at −100 rpm.
        (
            r#""1": ["O"], "2": ["O", "Q"], "3": ["Q"], "4": ["O"]"#,
            r#"{"links": ["4", "3"], "centres": ["O", "Q"], "teeth": [20, 30]},
               {"links": ["3", "1"], "centres": ["Q", "O"], "teeth": [30, 80], "ring": "1"}"#,
            r#"{"link": "4", "omega": "-100 rpm"}"#,
            &[("2", -20.0), ("3", 100.0 / 3.0), ("4", -100.0)],
        ),
        // Khurmi, example 13.5: reverted train, B held, arm at −100 rpm.
        (
            r#""1": ["O"], "2": ["O", "Q"], "3": ["Q"], "4": ["O"]"#,
            r#"{"links": ["1", "3"], "centres": ["O", "Q"], "teeth": [75, 45]},
               {"links": ["3", "4"], "centres": ["Q", "O"], "teeth": [90, 30]}"#,
            r#"{"link": "2", "omega": "-100 rpm"}"#,
            &[("3", -800.0 / 3.0), ("4", 400.0)],
        ),
        // Ferguson's paradox (Norton, example 9-6).
        (
            r#""1": ["O"], "2": ["O", "Q"], "3": ["Q"], "4": ["O"], "5": ["O"]"#,
            r#"{"links": ["1", "3"], "centres": ["O", "Q"], "teeth": [100, 20]},
               {"links": ["4", "3"], "centres": ["O", "Q"], "teeth": [99, 20]},
               {"links": ["5", "3"], "centres": ["O", "Q"], "teeth": [101, 20]}"#,
            r#"{"link": "2", "omega": "100 rpm"}"#,
            &[("3", 600.0), ("4", -100.0 / 99.0), ("5", 100.0 / 101.0)],
        ),
        // Two drivers (Taiwan, civil service): A at −60, arm at 30.
        (
            r#""1": ["O"], "2": ["O", "Q"], "3": ["Q"], "4": ["O"]"#,
            r#"{"links": ["4", "3"], "centres": ["O", "Q"], "teeth": [80, 40]}"#,
            r#"[{"link": "4", "omega": "-60 rpm"}, {"link": "2", "omega": "30 rpm"}]"#,
            &[("3", 210.0)],
        ),
    ];

    fn scene(links: &str, gears: &str, driver: &str) -> Scene {
        let text = format!(
            r#"{{"units": {{"length": "mm", "angle": "deg"}}, "links": {{{links}}}, "ground": "1",
                "points": {{"O": [0, 0], "Q": [36, 48]}}, "gears": [{gears}], "driver": {driver}}}"#
        );
        read(text).unwrap().value
    }

    #[test]
    fn willis_gives_the_rates_of_the_books_and_of_the_loop_equations() {
        let rpm = std::f64::consts::PI / 30.0;
        for (links, gears, driver, rates) in TRAINS {
            let scene = scene(links, gears, driver);
            let all = trains(&scene);
            let [train] = &all[..] else { panic!("{gears}: {} trains", all.len()) };
            let turns = train.turns(|l| given(&scene, l)).expect("two rates are known");
            let worked = work(&scene, Scope::Figure).unwrap().value;
            for (name, wanted) in *rates {
                let link = LinkId(scene.links.iter().position(|l| l.name == *name).unwrap());
                let by_willis = train.gear(link).map_or(turns.arm, |g| train.rate(g, turns));
                assert!(
                    (by_willis / rpm - wanted).abs() < 1e-12 * wanted.abs().max(100.0),
                    "{name}: {}",
                    by_willis / rpm
                );
                let solved = worked.solution.turning(Level::Velocity, link).unwrap();
                assert!(
                    (solved - by_willis).abs() < 1e-10 * by_willis.abs(),
                    "{name}: {solved} and {by_willis}"
                );
            }
        }
    }

    #[test]
    fn formulas_name_the_sizes_and_idlers_drop_out() {
        let formula = |case: usize, name: &str| {
            let (links, gears, driver, _) = TRAINS[case];
            let scene = scene(links, gears, driver);
            let train = trains(&scene).remove(0);
            train
                .gears
                .iter()
                .find(|g| scene.link_name(g.link) == name)
                .map(|g| g.ratio.formula())
                .unwrap()
        };
        assert_eq!(formula(0, "4"), "1");
        assert_eq!(formula(0, "3"), "−z_{4}/z_{3}");
        // The planet is an idler; the ring's mesh does not reverse the sense.
        assert_eq!(formula(0, "1"), "−z_{4}/z_{1}");
        // A compound planet has two sizes.
        assert_eq!(formula(1, "1"), "(z_{4} z_{3})/(z'_{3} z_{1})");
    }
}
