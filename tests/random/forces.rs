//! Random mechanisms under random loads: drawing, rows of the whole mechanism and virtual work
//! agree, and the printed digits of the drivers' power are compared with 200 bits.

use crate::emit::{self, Ask, Pose};
use crate::free_bodies;
use crate::properties::{mechanism, seeds, style};
use crate::rng::Rng;
use crate::wide::every;
use hodograph::answer::{AnswerValue, MotionSource};
use hodograph::certified::certify;
use hodograph::certified::ladder::AnswerPart;
use hodograph::effort::truth;
use hodograph::equilibrium::ForceTotals;
use hodograph::geom::Vec2;
use hodograph::mechanism::Level;
use hodograph::number::{Big, Real, within};
use hodograph::scene::quantity::{Contact, contacts, parties};
use hodograph::scene::{self, LinkId, PointId, Scene};
use hodograph::worked::{Scope, Worked, work};
use serde_json::{Value as Json, json};

/// Requested digits of the power.
const DIGITS: usize = 10;

/// The loads of a link: a force and a couple at a point, where its mass is too.
pub struct Load {
    pub link: LinkId,
    pub at: PointId,
    pub force: [f64; 2],
    pub couple: f64,
    pub mass: f64,
    pub inertia: f64,
}

/// Loads on some of the links that have points.
fn loads(scene: &Scene, rng: &mut Rng) -> Vec<Load> {
    let links = (0..scene.links.len()).map(LinkId).filter(|l| *l != scene.ground);
    let mut all = Vec::new();
    for link in links {
        let Some(&at) = scene.links[link.0].points.last() else { continue };
        let mut load = Load { link, at, force: [0.0; 2], couple: 0.0, mass: 0.0, inertia: 0.0 };
        if rng.chance(0.6) {
            (load.force, load.couple) =
                ([rng.between(-50.0, 50.0), rng.between(-50.0, 50.0)], rng.between(-20.0, 20.0));
        }
        if rng.chance(0.5) {
            (load.mass, load.inertia) = (rng.between(0.5, 3.0), rng.between(0.1, 2.0));
        }
        all.push(load);
    }
    all
}

/// A force that balances the only driver at a point of its link, in a direction other than the
/// driver's.
fn balance(scene: &Scene, rng: &mut Rng) -> Option<Json> {
    let [driver] = &scene.drivers[..] else { return None };
    let fixed = |p: &PointId| scene.links[scene.ground.0].points.contains(p);
    let (link, at) = match driver.kind.turned() {
        Some((link, _)) => (link, *scene.links[link.0].points.iter().find(|p| !fixed(p))?),
        None => {
            let guide = &scene.guides[driver.kind.guide()?.0];
            let link = guide.slider.or_else(|| scene.carriers(guide.pin?).next())?;
            (link, *scene.links[link.0].points.first()?)
        }
    };
    Some(
        json!({"link": scene.link_name(link), "at": scene.point_name(at), "angle": format!("{:?} deg", rng.between(5.0, 80.0))}),
    )
}

/// The scene with loads, with balancing moments and the reactions of pins between two links asked
/// for.
fn asked(text: &str, scene: &Scene, loads: &[Load], balance: Option<Json>) -> String {
    let mut json: Json = serde_json::from_str(text).unwrap();
    let name = |l: LinkId| scene.link_name(l).to_owned();
    let mut forces = Vec::new();
    let mut masses = serde_json::Map::new();
    for l in loads {
        let at = scene.point_name(l.at);
        if l.couple != 0.0 {
            forces.push(
                json!({"on": name(l.link), "at": at, "F": l.force.map(|f| format!("{f:?} N"))}),
            );
            forces.push(json!({"on": name(l.link), "M": format!("{:?} N*m", l.couple)}));
        }
        if l.mass != 0.0 {
            masses.insert(name(l.link), json!({"m": format!("{:?} kg", l.mass), "J": format!("{:?} kg*m^2", l.inertia), "at": at}));
        }
    }
    let mut find: Vec<String> = Vec::new();
    for p in (0..scene.points.len()).map(PointId).filter(|p| parties(scene, *p) == 2) {
        if let [a, b] = scene.carriers(p).collect::<Vec<_>>()[..] {
            find.push(format!("F_{},{}", name(a), name(b)));
        }
    }
    for pair in &scene.rolling {
        let [a, b] = pair.links;
        if let [Contact::Rolling(..)] = contacts(scene, a, b)[..] {
            find.push(format!("F_{},{}", name(a), name(b)));
        }
    }
    for p in (0..scene.points.len()).map(PointId).filter(|p| parties(scene, *p) > 2) {
        find.extend(scene.carriers(p).map(|l| format!("F_{}{}", scene.point_name(p), name(l))));
    }
    for (d, driver) in scene.drivers.iter().enumerate() {
        let letter = if driver.kind.turns() && balance.is_none() { "M" } else { "F" };
        find.push(if d == 0 { format!("{letter}_b") } else { format!("{letter}_b{}", d + 1) });
    }
    find.push("P".into());
    json["forces"] = json!(forces);
    json["masses"] = Json::Object(masses);
    json["find"] = json!(find);
    if let Some(balance) = balance {
        json["balance"] = balance;
    }
    json.to_string()
}

/// The power of the drivers, opposite to that of all loads, in 200 bits.
fn by_work(scene: &Scene, worked: &Worked, loads: &[Load]) -> Option<Big> {
    let motion = truth::differences(scene, worked).ok()?;
    let big = Big::from_f64;
    let mut power = big(0.0);
    for l in loads {
        let v = motion.vector(Level::Velocity, l.at, None)?;
        let omega = motion.turning(Level::Velocity, l.link)?;
        power = power + v.dot(Vec2::new(big(l.force[0]), big(l.force[1]))) + omega * big(l.couple);
        if l.mass != 0.0 {
            let a = motion.vector(Level::Acceleration, l.at, None)?;
            power = power
                - v.dot(a) * big(l.mass)
                - omega * motion.turning(Level::Acceleration, l.link)? * big(l.inertia);
        }
    }
    Some(big(0.0) - power)
}

/// The requested force, from the forces of pins on links: `F_a,b` of a pin of two links, `F_Pl` of
/// one of more.
fn of_pin(scene: &Scene, find: &str, all: &[(PointId, LinkId, Vec2<Big>)]) -> Option<Vec2<Big>> {
    let asks = |(p, on, _): &&(PointId, LinkId, Vec2<Big>)| {
        let link = scene.link_name(*on);
        let alone = find == format!("F_{}{link}", scene.point_name(*p));
        let others = scene
            .carriers(*p)
            .filter(|l| l != on)
            .map(|l| format!("F_{},{link}", scene.link_name(l)));
        alone || parties(scene, *p) == 2 && others.into_iter().any(|text| text == find)
    };
    all.iter().find(asks).map(|(.., force)| *force)
}

/// The direction of a vector in degrees.
fn degrees(v: Vec2<Big>) -> f64 {
    (v.y.atan2(v.x) * Big::from_f64(180.0) / (Big::from_f64(0.0).atan2(Big::from_f64(-1.0))))
        .approx()
}

/// One unit of the last of this number of significant digits.
fn last_place(value: f64, digits: usize) -> f64 {
    10f64.powi(value.abs().log10().floor() as i32 + 1 - digits as i32)
}

#[test]
fn random_loads_are_balanced_three_ways() {
    let (mut whole, mut compared, mut drawn, mut balanced, mut proven, mut digits, mut reactions) =
        (0, 0, 0, 0, 0, 0, 0);
    let mut failures = Vec::new();
    for seed in seeds(400) {
        let Some(m) = mechanism(seed).filter(|m| !m.coordinates_only && m.groups.len() <= 8) else {
            continue;
        };
        let plain = emit::scene(&m, &style(Pose::Lengths, Ask::Velocities, seed));
        let Ok(read) = scene::read(&plain) else { continue };
        let loads = loads(&read.value, &mut Rng::new(seed ^ 0xF0));
        let mut rng = Rng::new(seed ^ 0xBA);
        let balance = if rng.chance(0.3) { balance(&read.value, &mut rng) } else { None };
        let text = asked(&plain, &read.value, &loads, balance.clone());
        let scene = match scene::read(&text) {
            Ok(scene) => scene.value,
            Err(why) => panic!("seed {seed}: {why}\n{text}"),
        };
        let Ok(worked) = work(&scene, Scope::Figure) else { continue };
        let worked = worked.value;
        if worked.solution.condition > 1e4 {
            continue;
        }
        // All links together, where every reaction of the ground is drawn.
        let together = worked.equilibrium.as_ref().and_then(|of| {
            Some((of.forces.largest, ForceTotals::of(&scene, &worked.configuration, of)?))
        });
        if let Some((largest, all)) = together {
            whole += 1;
            if (all.loads + all.ground).norm() > 1e-9 * largest {
                failures.push(format!(
                    "seed {seed}: the ground bears {:?}, the loads are {:?}",
                    all.ground, all.loads
                ));
            }
        }
        for r in &worked.results {
            compared += 1;
            drawn += usize::from(r.drawn.is_some());
            balanced += usize::from(
                r.drawn.is_some() && balance.is_some() && scene.find[r.find].text == "F_b",
            );
            if let Some(a) = r.agreement.filter(|a| !a.holds()) {
                failures.push(format!("seed {seed}: {} {a:?}", scene.find[r.find].text));
            }
        }
        let told = certify(&scene, &worked, DIGITS);
        if balance.is_none() {
            within(truth::BITS, || {
                let Some(true_values) = free_bodies::reactions(&scene, &worked, &loads) else {
                    return;
                };
                for (r, c) in worked.results.iter().zip(&told) {
                    let find = &scene.find[r.find].text;
                    let Some(value) = of_pin(&scene, find, &true_values) else { continue };
                    let numbers = [
                        (AnswerPart::Magnitude, value.norm().approx()),
                        (AnswerPart::Direction, degrees(value)),
                    ];
                    for (part, value) in numbers.into_iter().filter(|(_, value)| value.abs() > 1e-9)
                    {
                        let Some((printed, count)) = c.part(part).and_then(|n| n.text(DIGITS))
                        else {
                            continue;
                        };
                        reactions += 1;
                        let off = (printed.parse::<f64>().unwrap() - value).abs();
                        if off.min((off - 360.0).abs()) > 0.5001 * last_place(value, count) {
                            failures.push(format!("seed {seed}: {find} is printed as {printed}, by the free bodies {value}"));
                        }
                    }
                }
            });
        }
        let Some(k) = worked.results.iter().position(|r| scene.find[r.find].text == "P") else {
            continue;
        };
        within(truth::BITS, || {
            let Some(true_value) = by_work(&scene, &worked, &loads) else { return };
            let AnswerValue::Scalar(computed) = worked.results[k].computed else { return };
            let value = true_value.approx();
            if value.abs() < 1e-6 {
                return;
            }
            proven += 1;
            if (computed - value).abs() > 1e-9 * value.abs().max(1.0) {
                failures.push(format!(
                    "seed {seed}: P is {computed}, by the work of the loads {value}"
                ));
            }
            if let Some((printed, _)) =
                told[k].part(AnswerPart::Scalar).and_then(|n| n.text(DIGITS))
            {
                digits += 1;
                let off: f64 = (printed.parse::<f64>().unwrap() - value).abs();
                if off > 0.5001 * last_place(value, DIGITS) {
                    failures.push(format!(
                        "seed {seed}: P is printed as {printed}, by the work of the loads {value}"
                    ));
                }
            }
        });
    }
    println!(
        "{compared} answers, {drawn} drawn, {balanced} balancing forces among them, {proven} powers by work, {digits} printed, {reactions} printed numbers of reactions, {whole} mechanisms as a whole"
    );
    assert!(failures.is_empty(), "{} failures\n{}", failures.len(), failures.join("\n"));
    assert!(
        compared > 1500 / every(8)
            && drawn > 500 / every(8)
            && balanced > 4 / every(8)
            && digits > 100 / every(8)
            && reactions > 400 / every(8),
        "{compared} answers, {drawn} drawn, {digits} powers and {reactions} numbers of reactions printed"
    );
}
