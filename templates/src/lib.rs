//! The texts of the templates: files for the reader of their kind, with their names.
//!
//! The crate is in the folder of its files, so that each package holds the files that it includes.

#![forbid(unsafe_code)]
#![warn(missing_docs)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

/// Scenes, in the order of the printed list.
pub const SCENES: &[(&str, &str)] = &[
    // name, text
    ("crank-rocker", include_str!("../crank-rocker.json")),
    ("pump-jack", include_str!("../pump-jack.json")),
    ("drag-link", include_str!("../drag-link.json")),
    ("crossed-four-bar", include_str!("../crossed-four-bar.json")),
    ("parallelogram", include_str!("../parallelogram.json")),
    ("third-crank", include_str!("../third-crank.json")),
    ("slider-crank", include_str!("../slider-crank.json")),
    ("offset-slider-crank", include_str!("../offset-slider-crank.json")),
    ("oblique-guide", include_str!("../oblique-guide.json")),
    ("slotted-lever", include_str!("../slotted-lever.json")),
    ("whitworth", include_str!("../whitworth.json")),
    ("oscillating-cylinder", include_str!("../oscillating-cylinder.json")),
    ("scotch-yoke", include_str!("../scotch-yoke.json")),
    ("elliptic-trammel", include_str!("../elliptic-trammel.json")),
    ("oldham-coupling", include_str!("../oldham-coupling.json")),
    ("curved-slot", include_str!("../curved-slot.json")),
    ("two-slots", include_str!("../two-slots.json")),
    ("shaper", include_str!("../shaper.json")),
    ("shaper-centres", include_str!("../shaper-centres.json")),
    ("toggle-press", include_str!("../toggle-press.json")),
    ("four-bar-forces", include_str!("../four-bar-forces.json")),
    ("press-forces", include_str!("../press-forces.json")),
    ("shaper-forces", include_str!("../shaper-forces.json")),
    ("engine-forces", include_str!("../engine-forces.json")),
    ("compressor-friction", include_str!("../compressor-friction.json")),
    ("toggle-clamp", include_str!("../toggle-clamp.json")),
    ("loader-forces", include_str!("../loader-forces.json")),
    ("watt-six-bar", include_str!("../watt-six-bar.json")),
    ("stephenson-six-bar", include_str!("../stephenson-six-bar.json")),
    ("class-iii-six-bar", include_str!("../class-iii-six-bar.json")),
    ("class-iv-six-bar", include_str!("../class-iv-six-bar.json")),
    ("double-butterfly", include_str!("../double-butterfly.json")),
    ("five-bar", include_str!("../five-bar.json")),
    ("robot-arm", include_str!("../robot-arm.json")),
    ("excavator", include_str!("../excavator.json")),
    ("pantograph", include_str!("../pantograph.json")),
    ("atkinson", include_str!("../atkinson.json")),
    ("radial-engine", include_str!("../radial-engine.json")),
    ("jansen-leg", include_str!("../jansen-leg.json")),
    ("wiper", include_str!("../wiper.json")),
    ("radar-dish", include_str!("../radar-dish.json")),
    ("flying-shear", include_str!("../flying-shear.json")),
    ("level-luffing-crane", include_str!("../level-luffing-crane.json")),
    ("treadle", include_str!("../treadle.json")),
    ("camera-claw", include_str!("../camera-claw.json")),
    ("mixer", include_str!("../mixer.json")),
    ("planetary-gear", include_str!("../planetary-gear.json")),
    ("three-planets", include_str!("../three-planets.json")),
    ("hypocycloid", include_str!("../hypocycloid.json")),
    ("sun-and-planet", include_str!("../sun-and-planet.json")),
    ("geared-five-bar", include_str!("../geared-five-bar.json")),
    ("five-bar-centres", include_str!("../five-bar-centres.json")),
    ("gear-linkage", include_str!("../gear-linkage.json")),
    ("belt-crank-rocker", include_str!("../belt-crank-rocker.json")),
    ("hoist", include_str!("../hoist.json")),
    ("rack-stroke-doubler", include_str!("../rack-stroke-doubler.json")),
    ("wheel-in-groove", include_str!("../wheel-in-groove.json")),
    ("cam-eccentric", include_str!("../cam-eccentric.json")),
    ("cam-centres", include_str!("../cam-centres.json")),
    ("cam-valve-train", include_str!("../cam-valve-train.json")),
    ("cam-offset-roller", include_str!("../cam-offset-roller.json")),
    ("cam-on-arm", include_str!("../cam-on-arm.json")),
    ("eccentric-three-ways", include_str!("../eccentric-three-ways.json")),
    ("turning-plate", include_str!("../turning-plate.json")),
    ("plate-by-law", include_str!("../plate-by-law.json")),
    ("cart-by-law", include_str!("../cart-by-law.json")),
    ("disc-on-rod", include_str!("../disc-on-rod.json")),
    ("lathe", include_str!("../lathe.json")),
    ("ships", include_str!("../ships.json")),
    ("flat-face-mistake", include_str!("../flat-face-mistake.json")),
    ("flat-face-mistake-2", include_str!("../flat-face-mistake-2.json")),
];

/// Tasks of synthesis, each with the name of its kind.
pub const TASKS: &[(&str, &str)] = &[
    // name, text
    ("function", include_str!("../synthesis/function.json")),
    ("body", include_str!("../synthesis/body.json")),
    ("time-ratio", include_str!("../synthesis/time-ratio.json")),
    ("limits", include_str!("../synthesis/limits.json")),
    ("path", include_str!("../synthesis/path.json")),
    ("cognates", include_str!("../synthesis/cognates.json")),
    ("straight-line", include_str!("../synthesis/straight-line.json")),
];

/// Motions without a mechanism.
pub const MOTIONS: &[(&str, &str)] = &[
    // name, text
    ("pursuit", include_str!("../particle/pursuit.json")),
    ("pursuit-of-a-ship", include_str!("../particle/pursuit-of-a-ship.json")),
    ("plate-in-space", include_str!("../particle/plate-in-space.json")),
    ("ring-in-space", include_str!("../particle/ring-in-space.json")),
];

/// Vector equations, one for each solvable case.
pub const EQUATIONS: &[(&str, &str)] = &[
    ("closing-side", include_str!("../equation/closing-side.json")),
    ("two-magnitudes", include_str!("../equation/two-magnitudes.json")),
    ("two-directions", include_str!("../equation/two-directions.json")),
    ("magnitude-and-direction", include_str!("../equation/magnitude-and-direction.json")),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_file_is_in_a_list() {
        for (folder, list) in
            [("", SCENES), ("synthesis", TASKS), ("particle", MOTIONS), ("equation", EQUATIONS)]
        {
            let files =
                std::fs::read_dir(std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(folder))
                    .unwrap();
            let files: Vec<_> = files
                .map(|f| f.unwrap().path())
                .filter(|f| f.extension().is_some_and(|e| e == "json"))
                .collect();
            assert_eq!(files.len(), list.len(), "{folder}");
            for file in files {
                let name = file.file_stem().unwrap();
                assert!(
                    list.iter().any(|(n, _)| *n == name),
                    "add {} to the list of templates/src/lib.rs",
                    file.display()
                );
            }
        }
    }
}
