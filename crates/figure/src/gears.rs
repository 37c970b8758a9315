//! Draws gear pairs as in textbooks: involute flanks around the pitch point, all circles, the line
//! of action with N and B, the points in contact; beside the drawing a table of sizes. A pair is
//! two gears, a gear in a ring, or a gear on a rack.
//!
//! The line of centres is vertical, the driver is below and turns clockwise, and two flanks touch
//! in the pitch point. In a ring and on a rack the gear is drawn as the driver. Large gears are
//! drawn around the pitch point only. The geometry is in [`hodograph_methods::gears`]. This module
//! reads the sizes from the scene and warns about defects of the gears; [`drawing`] draws the pair,
//! [`table`] writes its sizes.

mod drawing;
mod table;

use hodograph_base::diag::{Diagnostic, Faults, Warned, both};
use hodograph_base::digits::significant;
use hodograph_base::geom::Point;
use hodograph_board::plan::names::name_label;
use hodograph_methods::gears::{
    Basic, GearPair, Mate, distance_of, operating, standard, sum_of_shifts,
};
use hodograph_scene::{Flanks, LinkId, Normal, Rolling, Scene, Touch};

use super::list::Pages;
use super::sheet::SheetDrafter;
use hodograph_paper::paper::drawing::DrawingPart;
use hodograph_paper::paper::item::Figure;

/// Relative difference up to which two lengths in a file are equal.
const SAME: f64 = 1e-4;
/// Gap between the drawing and the table.
const TABLE_MM: f64 = 14.0;

/// Draws one page for each pair with numbers of teeth.
///
/// # Errors
/// `gear-no-teeth` if pairs have radii only; `gear-shift` if both profile shifts are given but do
/// not fit the centre distance; `gear-teeth` if the given sizes allow no teeth.
pub(super) fn pairs(maker: &SheetDrafter) -> Result<Warned<Pages>, Faults> {
    let scene = maker.scene;
    let all: Vec<(&Rolling, &Flanks)> =
        scene.rolling.iter().filter_map(|r| Some((r, r.flanks.as_ref()?))).collect();
    let one = all.len() == 1;
    let (mut pages, mut notes, mut faults) = (Pages::new(), Vec::new(), Faults::default());
    if let (true, Some(bare)) = (all.is_empty(), scene.rolling.iter().find(|r| r.kind.meshes())) {
        let at = scene.point_name(bare.at[0]);
        let message = both!("the gear pair at `{at}` has radii, but no numbers of teeth");
        faults.push(Diagnostic::error("gear-no-teeth", message).at(bare.span).help(both!(
            "give \"teeth\": [20, 40] and \"module\": \"2 mm\" in place of \"radii\""
        )));
    }
    for (rolling, flanks) in &all {
        match meant(maker, rolling, flanks) {
            Ok(pair) => {
                notes.extend(remarks(scene, rolling, &pair));
                let name = if one {
                    String::new()
                } else {
                    format!("-{}", scene.point_name(rolling.at[0]))
                };
                pages.push((
                    format!("gears{name}"),
                    DrawnGears { maker, rolling, pair, order: order(scene, rolling) }.figure(),
                ));
            }
            Err(fault) => faults.push(fault),
        }
    }
    if faults.has_errors() { Err(faults) } else { Ok(Warned { value: pages, notes }) }
}

/// The kind of the second member of a pair.
fn mate(rolling: &Rolling) -> Mate {
    match (rolling.touch(), rolling.hollow()) {
        (Touch::Point(Normal::Square { .. }), _) => Mate::Rack,
        (Touch::Point(Normal::Centres(_)) | Touch::Strand { .. }, Some(_)) => Mate::Ring,
        (Touch::Point(Normal::Centres(_)) | Touch::Strand { .. }, None) => Mate::Gear,
    }
}

/// The order in which a pair is drawn: of two gears, first the one that a driver turns; otherwise
/// the gear before ring or rack.
fn order(scene: &Scene, rolling: &Rolling) -> [usize; 2] {
    let driven = |l: LinkId| {
        scene.drivers.iter().any(|d| d.kind.turned().is_some_and(|(link, _)| link == l))
    };
    let second_first = match (mate(rolling), rolling.hollow()) {
        (Mate::Rack, _) | (Mate::Ring, Some(0)) => true,
        (Mate::Ring, _) => false,
        (Mate::Gear, _) => driven(rolling.links[1]) && !driven(rolling.links[0]),
    };
    if second_first { [1, 0] } else { [0, 1] }
}

/// The pair that a scene defines, at the distance of its centres (m).
fn meant(maker: &SheetDrafter, rolling: &Rolling, flanks: &Flanks) -> Result<GearPair, Diagnostic> {
    let scene = maker.scene;
    let fault = |code, message| Diagnostic::error(code, message).at(rolling.span);
    let impossible = || {
        fault("gear-teeth", both!("no involute teeth can be made with these sizes"))
            .help(both!("check module, teeth, shift and the distance of the centres"))
    };
    let mate = mate(rolling);
    let [i, j] = order(scene, rolling);
    let teeth = [i, j].map(|k| flanks.teeth[k].unwrap_or(0));
    let unit = |module| Basic {
        module,
        alpha: flanks.pressure_angle,
        addendum: flanks.addendum,
        clearance: flanks.clearance,
    };
    let distance = match mate {
        Mate::Rack => standard(&unit(flanks.module.ok_or_else(impossible)?), mate, teeth),
        Mate::Gear | Mate::Ring => {
            let place = |i: usize| {
                rolling.centres()[i].and_then(|p| maker.worked.configuration.points[p.0])
            };
            let (Some(p), Some(q)) = (place(0), place(1)) else { return Err(impossible()) };
            p.distance(q)
        }
    };
    // Given in the order of the links; for a rack, the gear's shift only.
    let shifts = |given: &[f64]| match mate {
        Mate::Rack => [given.first().copied().unwrap_or(0.0), 0.0],
        Mate::Gear | Mate::Ring => [i, j].map(|k| given.get(k).copied().unwrap_or(0.0)),
    };
    let given = shifts(&flanks.shifts);
    let sum = mate.shift(given);
    let (module, shifts) = match (flanks.module, &flanks.shifts[..]) {
        // Only teeth are given: the module follows from the distance.
        (None, _) => {
            (distance / distance_of(&unit(1.0), mate, teeth, sum).ok_or_else(impossible)?, given)
        }
        (Some(module), &[first]) if mate != Mate::Rack => {
            let angle = operating(&unit(module), mate, teeth, distance).ok_or_else(impossible)?;
            let sum = sum_of_shifts(&unit(module), mate, teeth, angle);
            // The given shift belongs to the first link; x₂ = Σ − x₁, in a ring Δ + x₁ or x₁ − Δ.
            let other = match (mate, i) {
                (Mate::Ring, 0) => sum + first,
                (Mate::Ring, _) => first - sum,
                (Mate::Gear | Mate::Rack, _) => sum - first,
            };
            (module, if i == 0 { [first, other] } else { [other, first] })
        }
        (Some(module), _) => {
            let wanted = distance_of(&unit(module), mate, teeth, sum).ok_or_else(impossible)?;
            if (wanted - distance).abs() > SAME * distance {
                let (wanted, distance) = (scene.length_words(wanted), scene.length_words(distance));
                return Err(fault(
                    "gear-shift",
                    both!(
                        "the profile shifts make the centres {wanted} apart without backlash, but they are {distance} apart"
                    ),
                )
                .help(both!(
                    "give one shift, \"shift\": [x1]: the other follows from the distance"
                )));
            }
            (module, given)
        }
    };
    GearPair::new(unit(module), mate, teeth, shifts, distance).ok_or_else(impossible)
}

/// Warnings for the manufacture of the gears.
fn remarks(scene: &Scene, rolling: &Rolling, pair: &GearPair) -> Vec<Diagnostic> {
    let at = scene.point_name(rolling.at[0]);
    let note = |code, message| Diagnostic::warning(code, message).at(rolling.span);
    let mut out = Vec::new();
    let larger = || both!("give the smaller gear a larger shift");
    if pair.interferes() {
        let message = both!(
            "at `{at}` a tip reaches beyond the line of action's end N: the flanks interfere"
        );
        out.push(note("gear-interference", message).help(larger()));
    }
    let [i, j] = order(scene, rolling);
    for (gear, k) in pair.gears.iter().zip([i, j]).take(if pair.mate == Mate::Gear { 2 } else { 1 })
    {
        let least = gear.least_shift(&pair.basic);
        if gear.shift < least {
            let (name, least) = (scene.link_name(rolling.links[k]), significant(least, 3));
            let message = both!(
                "gear {name} is undercut where a rack cuts it: its profile shift is below {least}"
            );
            out.push(
                note("gear-undercut", message)
                    .help(both!("\"shift\": [x1, x2] gives profile shifts; more teeth need none")),
            );
        }
    }
    if pair.without_involute() {
        let message = both!(
            "the ring's teeth at `{at}` reach inside its base circle, where they have no involute"
        );
        let help = both!("give the ring more teeth or a larger shift");
        out.push(note("gear-ring-tip", message).help(help));
    }
    if pair.tips_overlap() {
        let message = both!(
            "at `{at}` the tips of gear and ring overlap beside the line of action: their numbers of teeth are too near"
        );
        out.push(
            note("gear-overlap", message).help(both!("make the difference of the teeth larger")),
        );
    }
    if pair.gears.iter().any(|g| g.teeth > 0 && g.pointed(&pair.basic)) {
        out.push(note(
            "gear-pointed",
            both!(
                "at `{at}` a tooth is pointed before its tip circle, or a ring's space before its root"
            ),
        ));
    }
    if pair.contact_ratio() < 1.0 {
        let ratio = significant(pair.contact_ratio(), 3);
        out.push(note(
            "contact-ratio",
            both!("the contact ratio at `{at}` is {ratio}: below 1 the gears lose contact"),
        ));
    }
    out
}

/// A pair to be drawn.
struct DrawnGears<'a> {
    maker: &'a SheetDrafter<'a>,
    rolling: &'a Rolling,
    pair: GearPair,
    /// The order in which the two links are drawn.
    order: [usize; 2],
}

impl DrawnGears<'_> {
    fn figure(&self) -> Figure {
        let mut part = self.drawing();
        let mut table = self.table();
        table.stand_at(Point::new(part.bounds.max.x + TABLE_MM, part.bounds.max.y));
        part.items.extend(table.items);
        self.maker.alone(DrawingPart::of(part.items))
    }

    /// The name of a gear's link; index 0 is the driver.
    fn name(&self, i: usize) -> &str {
        self.maker.scene.link_name(self.rolling.links[self.order[i]])
    }

    /// A symbol with a gear's link as its index.
    fn symbol(&self, letter: &str, i: usize) -> String {
        format!("{letter}_{{{}}}", name_label(self.name(i)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sheet::SheetOptions;
    use hodograph_paper::paper::item::{FigureItem, Shape};
    use hodograph_scene::{Lang, read};
    use hodograph_worked::certified::certify;
    use hodograph_worked::worked::{Scope, work};

    fn text(gear: &str, distance: f64) -> String {
        format!(
            r#"{{"units": {{"length": "mm", "angle": "deg"}}, "links": {{"1": ["A", "D"], "2": ["A"], "3": ["D"]}}, "ground": "1",
                "points": {{"A": [0, 0], "D": [{distance}, 0]}}, "driver": {{"link": "2", "omega": "10 rad/s"}},
                "gears": [{{"links": ["2", "3"], "centres": ["A", "D"], "at": "K", {gear}}}], "find": ["omega_3"]}}"#
        )
    }

    fn drawn(gear: &str, distance: f64, lang: Lang) -> Result<Warned<Pages>, Faults> {
        let scene = read(text(gear, distance)).unwrap().value;
        let worked = work(&scene, Scope::Questions).unwrap().value;
        let options = SheetOptions::of_language(lang);
        pairs(&SheetDrafter {
            scene: &scene,
            worked: &worked,
            options: &options,
            certified: certify(&scene, &worked, 4),
        })
    }

    #[test]
    fn the_exercise_of_the_lecture_notes_is_in_the_table() {
        for lang in [Lang::En, Lang::Zh] {
            let pages = drawn(r#""teeth": [15, 32], "module": "2 mm", "shift": [0.6]"#, 50.0, lang)
                .unwrap();
            let [(name, figure)] = &pages.value[..] else { panic!("{} pages", pages.value.len()) };
            assert_eq!(name, "gears");
            let labels: Vec<&str> = figure
                .items
                .iter()
                .filter_map(|i| {
                    if let Shape::Label { label, .. } = &i.shape {
                        Some(label.source())
                    } else {
                        None
                    }
                })
                .collect();
            for wanted in ["27.96°", "1.801", "1.201", "47.000 mm", "50.000 mm", "N_{2}", "B_{3}"]
            {
                assert!(labels.contains(&wanted), "{wanted} is not among {labels:?}");
            }
            assert!(figure.items.iter().all(FigureItem::is_finite));
        }
    }

    #[test]
    fn teeth_alone_make_the_module() {
        let pages = drawn(r#""teeth": [20, 40]"#, 90.0, Lang::En).unwrap();
        assert!(pages.value[0].1.items.iter().any(
            |i| matches!(&i.shape, Shape::Label { label, .. } if label.source() == "3.0000 mm")
        ));
    }

    #[test]
    fn a_ring_and_a_rack_have_teeth() {
        let ring = r#""teeth": [20, 60], "ring": "3", "module": "2 mm", "shift": [0.2]"#;
        let pages = drawn(ring, 40.5, Lang::En).unwrap();
        let teeth = |f: &Figure| {
            f.items.iter().filter(|i| i.class.split(' ').any(|c| c == "teeth")).count()
        };
        assert_eq!(teeth(&pages.value[0].1), 2);
        assert!(pages.notes.is_empty(), "{:?}", pages.notes);
        let told = |text: &str, code: &str| {
            let notes = drawn(text, 40.5, Lang::Zh).unwrap().notes;
            assert!(notes.iter().any(|n| n.code == code), "{text}: {notes:?}");
        };
        told(r#""teeth": [20, 60], "ring": "3", "module": "2 mm", "shift": [-1]"#, "gear-undercut");
        let tight =
            text(r#""teeth": [40, 44], "ring": "3", "module": "2 mm", "shift": [0, 0]"#, 4.0);
        let scene = read(tight).unwrap().value;
        let worked = work(&scene, Scope::Questions).unwrap().value;
        let options = SheetOptions::of_language(Lang::En);
        let pages = pairs(&SheetDrafter {
            scene: &scene,
            worked: &worked,
            options: &options,
            certified: certify(&scene, &worked, 4),
        })
        .unwrap();
        assert!(pages.notes.iter().any(|n| n.code == "gear-overlap"), "{:?}", pages.notes);
        let rack = hodograph_scene::templates::get("rack-stroke-doubler").unwrap();
        let scene = read(rack).unwrap().value;
        let worked = work(&scene, Scope::Questions).unwrap().value;
        let pages = pairs(&SheetDrafter {
            scene: &scene,
            worked: &worked,
            options: &options,
            certified: certify(&scene, &worked, 4),
        })
        .unwrap();
        assert_eq!(pages.value.len(), 2);
        assert!(
            pages
                .value
                .iter()
                .all(|(_, f)| teeth(f) == 2 && f.items.iter().all(FigureItem::is_finite))
        );
        // Pairs with radii have no teeth: the diagnostic states the missing field.
        let bare = drawn(r#""radii": [13.5, 27]"#, 40.5, Lang::En).unwrap_err();
        assert_eq!(bare.list[0].code, "gear-no-teeth");
    }

    #[test]
    fn what_does_not_fit_is_told() {
        let faults =
            drawn(r#""teeth": [15, 32], "module": "2 mm", "shift": [0.5, 0.5]"#, 50.0, Lang::En)
                .unwrap_err();
        assert_eq!(faults.list[0].code, "gear-shift");
        let notes = drawn(r#""teeth": [8, 40], "module": "2 mm", "shift": [0, 0]"#, 48.0, Lang::En)
            .unwrap()
            .notes;
        assert!(notes.iter().any(|n| n.code == "gear-interference"), "{notes:?}");
        for (gear, code) in [
            (r#""radii": [20, 40], "shift": [0.5]"#, "gear-flanks"),
            (r#""teeth": [20, 40], "pressure_angle": "80 deg""#, "gear-flanks"),
            (r#""teeth": [20, 40], "shift": ["2 mm"]"#, "gear-flanks"),
            (r#""teeth": [20, 40], "addendum": 0"#, "gear-flanks"),
            (r#""teeth": [20, 40], "shift": [0, 0, 0]"#, "gear-flanks"),
        ] {
            let faults = read(text(gear, 60.0)).unwrap_err();
            assert!(faults.list.iter().any(|d| d.code == code), "{gear}: {:?}", faults.list);
        }
    }
}
