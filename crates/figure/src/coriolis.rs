//! The Coriolis acceleration at each slide: the mechanism with v_r and a_k, and the decision with its
//! reason; and the cases of the textbooks side by side.

use hodograph_base::diag::{Faults, Warned};
use hodograph_base::geom::Vec2;
use hodograph_base::lang::each;
use hodograph_board::construct::scale;
use hodograph_methods::composite::coriolis::{CoriolisVerdict, SlideCoriolis, coriolis};
use hodograph_paper::paper::drawing::DrawingPart;
use hodograph_paper::paper::item::Figure;
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::phrase::Phrase;
use hodograph_paper::paper::shown::{ShownLength, ShownQuantity};
use hodograph_report::composite::{CompositeWords, symbol};
use hodograph_scene::quantity::composite::CompositePart;
use hodograph_scene::templates::instantiate;
use hodograph_scene::{DiagramKind, Kind, Scene, read};
use hodograph_worked::worked::Worked;

use super::composite::named;
use super::extremes::with_rows;
use super::inversions::in_rows;
use super::list::{FigureEntry, FigureInput, Pages, page};
use super::mechanism::{Composed, ComposedVector, composed};
use super::sheet::SheetDrafter;
use crate::scales::DrawingScales;

/// The decision at each slide of the scene.
pub const ENTRY: FigureEntry = FigureEntry {
    name: "coriolis",
    about: each!("Coriolis acceleration at each slide: is there one, and why"),
    draw,
};
/// The cases of the textbooks.
pub const CASES_ENTRY: FigureEntry = FigureEntry {
    name: "coriolis-cases",
    about: each!("Eight slides of the textbooks: is there a Coriolis acceleration"),
    draw: cases,
};

/// Space for a mechanism.
const ROOM_MM: f64 = 80.0;
/// Space for the longest vector.
const VECTOR_MM: f64 = 25.0;
/// Drawings in a row of the cases.
const PER_ROW: usize = 3;

/// A case: a slide of a template.
struct CoriolisCase {
    template: &'static str,
    /// Values of its parameters.
    values: &'static [(&'static str, &'static str)],
    /// The pin of the slide.
    pin: &'static str,
    name: [&'static str; 2],
}

const fn case(
    template: &'static str,
    values: &'static [(&'static str, &'static str)],
    pin: &'static str,
    name: [&'static str; 2],
) -> CoriolisCase {
    CoriolisCase { template, values, pin, name }
}

/// The cases: a guide at rest, a translating one, four turning ones, and the two poses of a turning
/// guide in which there is none.
const CASES: [CoriolisCase; 8] = [
    case("offset-slider-crank", &[], "C", each!("Slider on a fixed guide")),
    case("scotch-yoke", &[("alpha_1", "0 rad/s^2")], "B", each!("Block in a translating guide")),
    case("slotted-lever", &[], "B", each!("Block on an oscillating guide")),
    case(
        "slotted-lever",
        &[("l_AB", "250 mm"), ("l_AC", "100 mm"), ("phi_1", "20 deg")],
        "B",
        each!("Block on a rotating guide"),
    ),
    case("oscillating-cylinder", &[], "B", each!("Rod in an oscillating block")),
    case("curved-slot", &[], "B", each!("Pin in a turning curved slot")),
    case(
        "slotted-lever",
        &[("phi_1", "acos(l_AB/l_AC) - 90 deg")],
        "B",
        each!("Guide at its extreme position"),
    ),
    case("slotted-lever", &[("phi_1", "90 deg")], "B", each!("Crank in line with the guide")),
];

fn draw(w: &FigureInput) -> Result<Warned<Pages>, Faults> {
    let (worked, slides) = coriolis(w.scene)?;
    if slides.is_empty() {
        return page(ENTRY.name, None);
    }
    let (mut cells, mut told) = (Vec::new(), Vec::new());
    for (k, s) in slides.iter().enumerate() {
        let name = words(w, w.scene).slide(s);
        let caption = match slides.len() {
            1 => name,
            _ => Phrase::new(&format!("({}) {}", k + 1, name.source())),
        };
        told.push(described(w, w.scene, &caption, s));
        cells.push(cell(w, (w.scene, &worked), s, caption, k));
    }
    page(ENTRY.name, Some(sheet(w, cells, told)))
}

fn cases(w: &FigureInput) -> Result<Warned<Pages>, Faults> {
    let (mut cells, mut told) = (Vec::new(), Vec::new());
    for (k, case) in CASES.iter().enumerate() {
        let mut scene = read(instantiate(case.template, case.values)?)?.value;
        let (placed, _) = coriolis(&scene)?;
        // All cases have drawings of one size.
        let extent = placed.configuration.extent();
        let mu = scale::choose_in(1.0, [extent, extent], [ROOM_MM, ROOM_MM]);
        scene.paper.scales.set(Kind::Length, Some(mu));
        let (worked, slides) = coriolis(&scene)?;
        let here = |s: &&SlideCoriolis| s.at.is_some_and(|p| scene.point_name(p) == case.pin);
        let Some(s) = slides.iter().find(here) else { continue };
        let name = w.options.lang.pick(case.name);
        let caption = Phrase::new(&format!("({}) {name}", k + 1));
        told.push(described(w, &scene, &caption, s));
        cells.push(cell(w, (&scene, &worked), s, caption, k));
    }
    page(CASES_ENTRY.name, Some(sheet(w, cells, told)))
}

fn words<'a>(w: &'a FigureInput, scene: &'a Scene) -> CompositeWords<'a> {
    CompositeWords { scene, lang: w.options.lang, notation: &w.options.notation }
}

fn described(w: &FigureInput, scene: &Scene, caption: &Phrase, s: &SlideCoriolis) -> String {
    let lines: Vec<String> = words(w, scene).coriolis(s).iter().map(Phrase::plain).collect();
    format!("{}: {}", caption.plain(), lines.join(", "))
}

fn sheet(w: &FigureInput, parts: Vec<DrawingPart>, told: Vec<String>) -> Figure {
    // Few drawings are in one row, four in two.
    let columns = match parts.len() {
        4 => 2,
        n => n.clamp(1, PER_ROW),
    };
    in_rows(w, parts, columns, told.join("; "))
}

/// Draws a slide: the mechanism with v_r and a_k at the point, and the decision below.
fn cell(
    w: &FigureInput,
    (scene, worked): (&Scene, &Worked),
    s: &SlideCoriolis,
    caption: Phrase,
    k: usize,
) -> DrawingPart {
    let options = w.options;
    let maker = SheetDrafter { scene, worked, options, certified: Vec::new() };
    let mut scales = maker.caption(DiagramKind::Plane).1;
    let mut vectors = Vec::new();
    let present = s.verdict == CoriolisVerdict::Present;
    let parts = [
        (
            CompositePart::RelativeVelocity,
            DiagramKind::Velocity,
            s.relative,
            ["relative", "vr"],
            true,
        ),
        (
            CompositePart::Coriolis,
            DiagramKind::Acceleration,
            s.acceleration(),
            ["coriolis", "ak"],
            present,
        ),
    ];
    let of = s.at.map_or("", |p| scene.point_name(p));
    let on_link = scene.link_name(scene.guides[s.guide.0].on);
    for (part, on, v, [key, letters], drawn) in parts {
        if !drawn || s.verdict == CoriolisVerdict::NoSliding || v == Vec2::ZERO {
            continue;
        }
        let most = [v.x.abs(), v.y.abs()];
        let mu = scale::choose_in(scene.paper.unit(on.kind()), most, [VECTOR_MM, VECTOR_MM]);
        let mm = v * (1.0 / mu);
        vectors.push(ComposedVector {
            symbol: symbol(Some(part), on, &options.notation),
            key: key.to_owned(),
            shown: ShownQuantity {
                names: vec![format!("{letters}_{of}/{on_link}")],
                length: Some(ShownLength { mm: mm.norm(), si: v.norm() }),
            },
            mm,
            absolute: false,
            step: None,
        });
        scales = scales.and(DrawingScales::of(&scene.book, on, mu));
    }
    let what =
        Composed { at: s.at, numbered: true, vectors, parallelogram: false, track: Vec::new() };
    let part = composed(&options.style, scene, worked, &options.notation, &what);
    let titled = maker.titled(part, caption.label(), &scales, ENTRY.name);
    let rows: Vec<Label> = words(w, scene).coriolis(s).iter().map(Phrase::label).collect();
    named(with_rows(options, titled, rows), ENTRY.name, k)
}
