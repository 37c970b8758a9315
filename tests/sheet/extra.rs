//! Whether the figures of `--figure composite` and `--figure attempts` can be read: every template, in both languages, at a few positions of its
//! driver that differ from template to template, so that all together many are looked at.

use crate::legible::{SMALLEST_MM, look};
use hodograph::accuracy::toggle::limit;
use hodograph::figure::item::{Colour, Shape};
use hodograph::figure::list::{self, Extras, Wanted};
use hodograph::figure::sheet::{Options, drawing};
use hodograph::figure::style::Style;
use hodograph::mechanism::Level;
use hodograph::scene::{self, DriverKind, Lang, Scene, driver_position, templates, with_driver_at};
use hodograph::worked::{Scope, work};

/// Positions of a template.
const POSES: usize = 2;

/// The pose of the file, and others around the turn or between the limits, begun elsewhere for each template.
fn poses(scene: &Scene, shift: usize) -> Vec<Scene> {
    let mut all = vec![scene.clone()];
    let Some(start) = driver_position(scene, 0) else { return all };
    let turns = matches!(scene.drivers[0].kind, DriverKind::Turn { .. });
    let [low, high] = match [limit(scene, 0, false), limit(scene, 0, true)] {
        [Some(low), Some(high)] => [low, high],
        _ if turns => [start, start + std::f64::consts::TAU],
        _ => [start * 0.8, start * 1.2],
    };
    let share = |k: usize| ((k as f64 + 0.37 * shift as f64) / POSES as f64).fract() * 0.9 + 0.05;
    all.extend((1..POSES).map(|k| with_driver_at(scene, 0, low + (high - low) * share(k))));
    all
}

fn every_page_can_be_read(name: &str) {
    let only = std::env::var("HODOGRAPH_ONLY").unwrap_or_default();
    let entry = list::named(name).unwrap();
    let (mut faults, mut pages, mut labels) = (Vec::new(), 0, 0);
    for (t, template) in templates::list().iter().enumerate() {
        if !only.is_empty() && !only.split(',').any(|o| o == template.name) {
            continue;
        }
        let scene = scene::read(templates::get(template.name).unwrap()).unwrap().value;
        // Every vector of more links than a page holds is not asked to be read on it.
        if scene.links.len() > 7 {
            continue;
        }
        for (k, pose) in poses(&scene, t).iter().enumerate() {
            let Ok(worked) = work(pose, Scope::Figure) else { continue };
            for lang in [Lang::En, Lang::Zh] {
                let options = Options::of_language(lang);
                let wanted = Wanted { scene: pose, worked: &worked.value, options: &options, extras: &Extras::default() };
                let drawn = match (entry.draw)(&wanted) {
                    Ok(drawn) => drawn.value,
                    // A named mistake may change nothing elsewhere than in the pose of the file.
                    Err(_) if k > 0 => continue,
                    Err(f) => panic!("{} pose {k}: {f}", template.name),
                };
                for (page, figure) in &drawn {
                    let found = look(figure, pose.links.len());
                    pages += 1;
                    labels += figure.labels_placed();
                    if found.overlaps + found.outside > 0 || found.smallest_mm < SMALLEST_MM {
                        let (o, out, least) = (found.overlaps, found.outside, found.smallest_mm);
                        faults.push(format!(
                            "{} pose {k} {lang:?} {page}: {o} overlaps, {out} outside, smallest type {least:.2} mm",
                            template.name
                        ));
                    }
                }
            }
        }
    }
    println!("{name}: {pages} pages, {labels} labels");
    assert!(!only.is_empty() || pages > 40, "only {pages} pages of {name}");
    assert!(faults.is_empty(), "{} pages:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn composite_motions_can_be_read() {
    every_page_can_be_read("composite");
}

#[test]
fn wrong_solutions_can_be_read() {
    every_page_can_be_read("attempts");
}

/// In a style of colours every moving link that has a number has one colour, of its number as of its lines, and no two share one.
#[test]
fn twelve_links_have_twelve_colours() {
    let scene = scene::read(templates::get("excavator").unwrap()).unwrap().value;
    let worked = work(&scene, Scope::Figure).unwrap().value;
    for style in ["slides", "dark"] {
        let options = Options { style: Style::named(style).unwrap(), ..Options::of_language(Lang::En) };
        let figure = drawing(&scene, &worked, &options, Level::Position).unwrap();
        let mut colours: Vec<(usize, Colour)> = Vec::new();
        for item in &figure.items {
            let (Some(link), Shape::Line { stroke, .. } | Shape::Polyline { stroke: Some(stroke), .. }) = (item.link, &item.shape) else {
                continue;
            };
            match colours.iter().find(|(l, _)| *l == link) {
                Some((_, c)) => assert_eq!(*c, stroke.colour, "{style}: {}", item.id),
                None => {
                    let twin = colours.iter().find(|(_, c)| *c == stroke.colour);
                    assert!(twin.is_none(), "{style}: links {link} and {twin:?} share a colour");
                    colours.push((link, stroke.colour));
                }
            }
        }
        assert_eq!(colours.len(), scene.links.len() - 1, "{style}: every moving link is drawn in its colour");
    }
}
