//! Figures of forces: free bodies with force polygons, and Zhukovsky's lever, at driver positions
//! all around.

use crate::legible::{look, poses};
use crate::wide::every;
use hodograph::figure::forces;
use hodograph::figure::sheet::SheetOptions;
use hodograph::scene::{self, Lang, templates};
use hodograph::worked::{Scope, work};

#[test]
fn forces_can_be_read() {
    let (mut drawn, mut labels) = (0, 0);
    let mut faults = Vec::new();
    for t in templates::list() {
        let scene = scene::read(templates::get(t.name).unwrap()).unwrap().value;
        if !scene.find.iter().any(|f| f.what.kind().is_of_forces()) {
            continue;
        }
        for (k, pose) in poses(&scene).iter().enumerate() {
            let Ok(worked) = work(pose, Scope::Figure) else { continue };
            for lang in [Lang::En, Lang::Zh] {
                let options = SheetOptions::of_language(lang);
                let figures = [
                    ("forces", forces::forces(pose, &worked.value, &options)),
                    ("lever", forces::lever(pose, &worked.value, &options)),
                ];
                for (name, figure) in
                    figures.into_iter().filter_map(|(name, figure)| Some((name, figure?)))
                {
                    let found = look(&figure, usize::MAX);
                    drawn += 1;
                    labels += figure.labels_placed();
                    if found.overlaps + found.outside > 0 {
                        faults.push(format!(
                            "{} pose {k} {lang:?} {name}: {} overlaps, {} outside",
                            t.name, found.overlaps, found.outside
                        ));
                    }
                }
            }
        }
    }
    println!("{drawn} figures of forces, {labels} labels");
    assert!(drawn > 500 / every(8), "only {drawn} figures");
    assert!(faults.is_empty(), "{} of {drawn} figures:\n{}", faults.len(), faults.join("\n"));
}
