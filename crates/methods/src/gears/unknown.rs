//! The number of teeth of a gear in a mechanism for a wanted angular velocity or ratio: each number
//! is put into the scene, which is solved again.
//!
//! Places are kept: the pitch circles share the distance of the centres in the ratio of the teeth.

use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_mechanism::answer::AnswerValue;
use hodograph_scene::quantity::Rate;
use hodograph_scene::{Asked, Kind, Scene, edit, read_asking};
use hodograph_worked::worked::{Scope, work};
use serde_json::{Value as Json, json};

/// A wanted value of a mechanism with a gear of unknown teeth.
#[derive(Clone, Copy, Debug)]
pub struct WantedGear<'a> {
    /// The link of the gear.
    pub gear: &'a str,
    /// The quantity, such as `omega_5` or `i_52`.
    pub quantity: &'a str,
    /// Its value as written, such as `3 rad/s`.
    pub value: &'a str,
    /// The least and the greatest number of teeth.
    pub teeth: [u32; 2],
    /// The greatest relative deviation.
    pub within: f64,
}

/// The link of a gear in mesh with another, and its number of teeth.
pub type GearMate = (String, u32);

/// A number of teeth with the value that it gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GearCandidate {
    /// The number of teeth.
    pub teeth: u32,
    /// The value (SI).
    pub value: f64,
}

/// The numbers of teeth of a gear.
#[derive(Clone, Debug)]
pub struct FoundGear {
    /// The scene as given.
    pub scene: Scene,
    /// The wanted value (SI).
    pub wanted: f64,
    /// The kind of the quantity.
    pub kind: Kind,
    /// The gears in mesh with it: their links and numbers of teeth, without those that follow its
    /// own.
    pub mates: Vec<GearMate>,
    /// Numbers of teeth that give the value within its deviation, the best first.
    pub found: Vec<GearCandidate>,
    /// The number of teeth that comes nearest to the value.
    pub nearest: Option<GearCandidate>,
}

impl FoundGear {
    /// Returns the relative deviation of a value.
    pub fn off(&self, value: f64) -> f64 {
        value / self.wanted - 1.0
    }
}

/// Finds the numbers of teeth of a gear.
///
/// # Errors
/// The faults of the scene and of the wanted value; `no-teeth` for a link that is no gear with
/// teeth, and for a quantity that is neither an angular velocity nor a ratio.
pub fn unknown_teeth(text: &str, wish: &WantedGear) -> Result<FoundGear, Faults> {
    let scene = read_asking(text, wish.quantity)?.value;
    let asked = match &scene.find[..] {
        [one] => one.what,
        _ => return Err(kinds(wish).into()),
    };
    let (kind, wanted) = match asked {
        Asked::Turning(t) if t.rate == Rate::Velocity => {
            (Kind::Omega, Some(edit::turning(wish.value)?))
        }
        Asked::Ratio(_) => (Kind::Number, wish.value.parse().ok().filter(|x: &f64| x.is_finite())),
        Asked::Turning(_)
        | Asked::PointMotion(_)
        | Asked::Relative(_)
        | Asked::Sliding(_)
        | Asked::Composite(_)
        | Asked::Place(_)
        | Asked::Curvature(_)
        | Asked::CamQuantity(_)
        | Asked::FromCentre(_)
        | Asked::InstantCentre(_)
        | Asked::RollerSpin(_)
        | Asked::Transmission(_)
        | Asked::Force(_)
        | Asked::Combined(_) => return Err(kinds(wish).into()),
    };
    let wanted = wanted.filter(|x| *x != 0.0).ok_or_else(|| kinds(wish))?;
    let mut root: Json = serde_json::from_str(text).map_err(|_| no_gear(wish))?;
    let (sizes, mut mates) = meshes(&scene, wish.gear);
    let places = GearPlaces::of(&root, wish.gear);
    // The wheels of a compound gear have numbers of their own.
    if sizes.first().is_none_or(|first| sizes.iter().any(|z| z != first)) {
        return Err(no_gear(wish).into());
    }
    let mut all = Vec::new();
    let mut refused = None;
    for teeth in wish.teeth[0]..=wish.teeth[1] {
        places.set(&mut root, teeth);
        match solved(&root.to_string(), wish.quantity) {
            Ok((changed, value)) => {
                all.extend(value.map(|value| GearCandidate { teeth, value }));
                // A mate whose number follows that of the gear has none to name.
                let (_, now) = meshes(&changed, wish.gear);
                mates.retain(|mate| now.contains(mate));
            }
            Err(faults) => refused = refused.or(Some(faults)),
        }
    }
    if let (true, Some(faults)) = (all.is_empty(), refused) {
        return Err(faults);
    }
    let mut out = FoundGear { scene, wanted, kind, mates, found: Vec::new(), nearest: None };
    all.sort_by(|a, b| out.off(a.value).abs().total_cmp(&out.off(b.value).abs()));
    out.nearest = all.first().copied();
    all.retain(|c| out.off(c.value).abs() <= wish.within + ROUNDING);
    out.found = all;
    Ok(out)
}

/// Deviations below this are rounding errors.
const ROUNDING: f64 = 1e-9;

/// Returns the numbers of teeth of a gear in its meshes, and its mates.
fn meshes(scene: &Scene, gear: &str) -> (Vec<u32>, Vec<GearMate>) {
    let (mut sizes, mut mates) = (Vec::new(), Vec::new());
    for mesh in &scene.rolling {
        let Some(flanks) = &mesh.flanks else { continue };
        for (own, other) in [(0, 1), (1, 0)] {
            if let Some(z) = flanks.teeth[own].filter(|_| scene.link_name(mesh.links[own]) == gear)
            {
                let mate = scene.link_name(mesh.links[other]).to_owned();
                sizes.push(z);
                mates.extend(flanks.teeth[other].map(|z| (mate, z)));
            }
        }
    }
    (sizes, mates)
}

/// The places of a file that hold the number of teeth of a gear.
#[derive(Default)]
struct GearPlaces {
    /// Entries of `teeth`, each with the index of its mesh.
    entries: Vec<(usize, usize)>,
    /// Parameters that are entries of `teeth`.
    parameters: Vec<String>,
}

impl GearPlaces {
    fn of(root: &Json, gear: &str) -> GearPlaces {
        let mut out = GearPlaces::default();
        let all = root["gears"].as_array().map_or(&[][..], Vec::as_slice);
        for (k, mesh) in all.iter().enumerate() {
            let count = mesh["teeth"].as_array().map_or(0, Vec::len);
            for end in (0..2).filter(|end| mesh["links"][*end] == gear) {
                // A rack has no number of teeth, and its gear the only one.
                let entry = if count == 1 { 0 } else { end };
                match mesh["teeth"][entry].as_str().map(str::trim) {
                    Some(name) if root["parameters"].get(name).is_some() => {
                        out.parameters.push(name.to_owned());
                    }
                    Some(_) | None => out.entries.push((k, entry)),
                }
            }
        }
        out
    }

    fn set(&self, root: &mut Json, teeth: u32) {
        for (mesh, entry) in &self.entries {
            root["gears"][*mesh]["teeth"][*entry] = json!(teeth);
        }
        for name in &self.parameters {
            root["parameters"][name] = json!(teeth);
        }
    }
}

/// Returns a scene with the value of a quantity; `None` if the pose has none.
fn solved(text: &str, quantity: &str) -> Result<(Scene, Option<f64>), Faults> {
    let scene = read_asking(text, quantity)?.value;
    let worked = work(&scene, Scope::Questions)?.value;
    let value = worked.results.first().and_then(|r| match r.value() {
        AnswerValue::Scalar(x) => Some(x),
        AnswerValue::Vector(_) | AnswerValue::Point(_) => None,
    });
    Ok((scene, value))
}

fn no_gear(wish: &WantedGear) -> Diagnostic {
    let gear = wish.gear;
    refused(both!("link {gear} is no gear with one number of teeth in \"gears\""))
}

fn kinds(wish: &WantedGear) -> Diagnostic {
    let WantedGear { quantity, value, .. } = wish;
    refused(both!("`{quantity}={value}` is no angular velocity or ratio with a value other than 0"))
}

fn refused(message: Both) -> Diagnostic {
    Diagnostic::error("no-teeth", message).help(both!(
        "as in `hodograph teeth scene.json --gear 5 --want omega_5=3rad/s` or `--want i_52=3`"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A gear on the coupler of a four-bar with AB and CD square to BC: ω_5 = ω_2 (1 + z_3/z_5).
    const SCENE: &str = r#"{
        "units": {"length": "mm"},
        "links": {"1": ["A", "D"], "2": ["A", "B"], "3": ["B", "C"], "4": ["C", "D"], "5": ["A"]},
        "ground": "1",
        "points": {"A": [0, 0], "B": [0, 45], "C": [90, 45], "D": [90, 10]},
        "gears": [{"links": ["3", "5"], "centres": ["B", "A"], "teeth": [30, 20]}],
        "driver": {"link": "2", "omega": "1 rad/s"},
        "find": ["omega_5"]
    }"#;

    fn wish<'a>(quantity: &'a str, value: &'a str) -> WantedGear<'a> {
        WantedGear { gear: "5", quantity, value, teeth: [10, 60], within: 0.0 }
    }

    #[test]
    fn teeth_are_found_for_an_angular_velocity_and_for_a_ratio() {
        for (quantity, value) in [("omega_5", "3 rad/s"), ("i_52", "3")] {
            let all = unknown_teeth(SCENE, &wish(quantity, value)).unwrap();
            let teeth: Vec<u32> = all.found.iter().map(|c| c.teeth).collect();
            assert_eq!(teeth, [15], "{quantity}");
            assert_eq!(all.mates, [("3".to_owned(), 30)]);
        }
        // Every number of teeth follows the formula.
        let wide = WantedGear { within: 0.5, ..wish("omega_5", "3 rad/s") };
        let all = unknown_teeth(SCENE, &wide).unwrap();
        assert!(all.found.len() > 10);
        for c in &all.found {
            assert!((c.value - (1.0 + 30.0 / f64::from(c.teeth))).abs() < 1e-12, "{c:?}");
        }
    }

    #[test]
    fn a_compound_gear_has_no_one_number_of_teeth() {
        let compound = SCENE.replace(
            "\"teeth\": [30, 20]}",
            "\"teeth\": [30, 20]}, {\"links\": [\"3\", \"5\"], \"centres\": [\"B\", \"A\"], \"teeth\": [15, 35]}",
        );
        let refused = unknown_teeth(&compound, &wish("omega_5", "3 rad/s")).unwrap_err();
        assert!(refused.list.iter().any(|d| d.code == "no-teeth"), "{refused:?}");
    }

    #[test]
    fn named_teeth_are_found_and_quantities_of_the_name_follow() {
        // R = r_s + 2 r_p: the ring's teeth follow those of the planet; i_23 = 1 + z_1/z_2.
        let train = r#"{
            "parameters": {"z_2": 30, "z_4": 21, "a": "(1 mm)*(z_2 + z_4)"},
            "links": {"1": ["O"], "2": ["O"], "3": ["O", "P"], "4": ["P"]},
            "ground": "1",
            "points": {"O": [0, 0], "P": ["a", 0]},
            "gears": [
                {"links": ["2", "4"], "centres": ["O", "P"], "teeth": ["z_2", "z_4"], "module": "2 mm"},
                {"links": ["4", "1"], "centres": ["P", "O"], "teeth": ["z_4", "z_2 + 2*z_4"], "module": "2 mm", "ring": "1"}
            ],
            "driver": {"link": "2", "omega": "1 rad/s"},
            "find": ["i_23"]
        }"#;
        for (gear, teeth, value, mates) in
            [("4", 45, "5", vec![("2", 30)]), ("2", 14, "5", vec![("4", 21)])]
        {
            let wish = WantedGear { gear, ..wish("i_23", value) };
            let all = unknown_teeth(train, &wish).unwrap();
            let found: Vec<u32> = all.found.iter().map(|c| c.teeth).collect();
            assert_eq!(found, [teeth], "{gear}");
            let mates: Vec<_> = mates.into_iter().map(|(link, z)| (link.to_owned(), z)).collect();
            assert_eq!(all.mates, mates);
        }
    }

    #[test]
    fn the_gear_of_a_rack_has_the_only_number_of_teeth() {
        let rack = r#"{
            "links": {"1": ["A"], "2": ["A"]},
            "ground": "1",
            "points": {"A": [0, 0]},
            "guides": [{"slider": "3", "on": "1", "through": [0, "-0.1 m"], "angle": "0 deg"}],
            "gears": [{"links": ["3", "2"], "centres": ["A"], "teeth": [24], "module": "5 mm", "rack": "3", "angle": "0 deg", "at": "Q"}],
            "driver": {"link": "2", "omega": "1 rad/s"},
            "find": ["omega_2"]
        }"#;
        let wish = WantedGear { gear: "2", ..wish("omega_2", "1 rad/s") };
        assert!(!unknown_teeth(rack, &wish).unwrap().found.is_empty());
    }

    #[test]
    fn nothing_is_found_where_no_whole_number_fits() {
        let all = unknown_teeth(SCENE, &wish("omega_5", "2.99 rad/s")).unwrap();
        assert!(all.found.is_empty());
        assert_eq!(all.nearest.unwrap().teeth, 15);
    }

    #[test]
    fn links_without_teeth_and_other_quantities_are_refused() {
        let of_code = |wish: &WantedGear| {
            unknown_teeth(SCENE, wish).unwrap_err().list.iter().map(|d| d.code).collect::<Vec<_>>()
        };
        assert_eq!(of_code(&WantedGear { gear: "4", ..wish("omega_5", "3 rad/s") }), ["no-teeth"]);
        assert_eq!(of_code(&wish("v_B", "3 m/s")), ["no-teeth"]);
        assert_eq!(of_code(&wish("omega_5", "3 m")), ["dimension"]);
    }
}
