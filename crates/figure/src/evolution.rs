//! The evolution of a four-bar: each stage in one pose, with the change and the motion of the link
//! that it keeps or changes.

use hodograph_base::diag::{Faults, Warned};
use hodograph_base::geom::Point;
use hodograph_base::lang::{each, say, tr};
use hodograph_board::construct::scale;
use hodograph_board::plan::names::{name_label, point_label};
use hodograph_mechanism::answer::MotionSource;
use hodograph_mechanism::mechanism::Level;
use hodograph_methods::inversions::evolution::{
    DrivingCrank, EvolutionStage, EvolutionStep, evolution,
};
use hodograph_methods::inversions::is_bore;
use hodograph_paper::paper::drawing::DrawingPart;
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::phrase::Phrase;
use hodograph_scene::{DiagramKind, Kind, Lang};
use hodograph_worked::worked::{Scope, work};

use super::composite::named;
use super::extremes::{amount, with_rows};
use super::inversions::in_rows;
use super::list::{FigureEntry, FigureInput, Pages, page};
use super::mechanism::{AROUND_MM, eccentric, numbered, rod_in_block};
use super::sheet::SheetDrafter;

/// The evolution.
pub const ENTRY: FigureEntry = FigureEntry {
    name: "evolution",
    about: each!("Evolution of the four-bar: far pivot, enlarged pin, exchanged slide"),
    draw,
};

/// Space for a mechanism.
const ROOM_MM: f64 = 80.0;
/// Least length of the crank in a disc.
const CRANK_MM: f64 = 18.0;
/// Drawings in a row.
const PER_ROW: usize = 2;

fn draw(w: &FigureInput) -> Result<Warned<Pages>, Faults> {
    let mut stages = evolution(w.scene, w.worked)?;
    let unit = w.scene.paper.unit(Kind::Length);
    let mu = scale::choose_in(unit, [extent(&stages); 2], [ROOM_MM; 2]);
    // All stages have one scale, but letters need space in the disc of a short crank.
    let scale_of = |s: &EvolutionStage| match s.step {
        EvolutionStep::Disc => scale::finer(unit, mu, (CRANK_MM * mu / s.arm()).max(1.0)),
        EvolutionStep::FourBar
        | EvolutionStep::ArcSlider
        | EvolutionStep::Straight
        | EvolutionStep::Lever
        | EvolutionStep::Exchanged => mu,
    };
    // A disc that would cover other joints is left out.
    stages.retain(|s| s.step != EvolutionStep::Disc || is_free(s, scale_of(s)));
    for s in &mut stages {
        s.scene.paper.scales.set(Kind::Length, Some(scale_of(s)));
        s.worked = work(&s.scene, Scope::Figure)?.value;
    }
    let (mut parts, mut told) = (Vec::new(), Vec::new());
    for (k, s) in stages.iter().enumerate() {
        let lines = words(w.options.lang, s, k);
        told.push(lines.iter().map(Phrase::plain).collect::<Vec<_>>().join(", "));
        parts.push(cell(w, s, lines, k));
    }
    page(ENTRY.name, Some(in_rows(w, parts, PER_ROW.min(stages.len()), told.join("; "))))
}

/// Returns the size of the largest stage (m).
fn extent(stages: &[EvolutionStage]) -> f64 {
    stages.iter().map(|s| s.worked.configuration.extent()).fold(0.0, f64::max)
}

/// Returns true if the ring around the crank's disc covers no other point.
fn is_free(s: &EvolutionStage, mu: f64) -> bool {
    let at = &s.worked.configuration.points;
    let DrivingCrank { pivot, pin, .. } = s.crank;
    let (Some(axis), Some(centre)) = (at[pivot.0], at[pin.0]) else { return false };
    let ring = axis.distance(centre) + AROUND_MM * mu;
    let other = |(k, _): &(usize, &Option<Point>)| *k != pivot.0 && *k != pin.0;
    at.iter().enumerate().filter(other).all(|(_, p)| p.is_none_or(|p| p.distance(centre) > ring))
}

fn cell(w: &FigureInput, s: &EvolutionStage, lines: Vec<Phrase>, k: usize) -> DrawingPart {
    let options = w.options;
    let (style, notation) = (&options.style, &options.notation);
    let maker = SheetDrafter { scene: &s.scene, worked: &s.worked, options, certified: Vec::new() };
    let part = match s.step {
        EvolutionStep::Disc => eccentric(style, &s.scene, &s.worked, notation, s.crank),
        EvolutionStep::Exchanged if s.slides_on_ground() => {
            rod_in_block(style, &s.scene, &s.worked, notation, s.crank.pivot)
        }
        EvolutionStep::FourBar
        | EvolutionStep::ArcSlider
        | EvolutionStep::Straight
        | EvolutionStep::Lever
        | EvolutionStep::Exchanged => numbered(style, &s.scene, &s.worked, notation),
    };
    let mut lines = lines.into_iter().map(|l| l.label());
    let caption = lines.next().unwrap_or_else(|| Label::text(""));
    let titled =
        maker.titled(part.finish(), caption, &maker.caption(DiagramKind::Plane).1, ENTRY.name);
    named(with_rows(options, titled, lines.collect()), ENTRY.name, k)
}

/// Returns the caption of a stage, the change, and the motion of the next link.
fn words(lang: Lang, s: &EvolutionStage, k: usize) -> Vec<Phrase> {
    let (scene, book) = (&s.scene, &s.scene.book);
    let link = |l: hodograph_scene::LinkId| scene.link_name(l);
    let [pivot, pin] = [s.crank.pivot, s.crank.pin].map(|p| point_label(scene.point_name(p)));
    let guide = scene.guides.first();
    let centre = guide
        .and_then(|g| match g.path {
            hodograph_scene::GuidePath::Arc { centre, .. } => Some(centre),
            hodograph_scene::GuidePath::Line { .. } => None,
        })
        .map_or_else(String::new, |p| point_label(scene.point_name(p)));
    let slider = guide.and_then(|g| g.slider).map_or("", link);
    let on = guide.map_or("", |g| link(g.on));
    let rocker = s.rocker.map(|l| amount(book, Kind::Length, l));
    let (caption, change) = match s.step {
        EvolutionStep::FourBar => (tr!(lang, "Four-bar").to_owned(), None),
        EvolutionStep::ArcSlider => (
            say!(lang, "The rocker as a slider in an arc about ${centre}$"),
            rocker.map(|r| say!(lang, "radius ${r}$, the length of the rocker: the same motion")),
        ),
        EvolutionStep::Straight => (
            tr!(lang, "Slider-crank: the pivot of the rocker at infinity").to_owned(),
            Some(
                tr!(lang, "the arc is its tangent: $\\omega$ is the same at the instant")
                    .to_owned(),
            ),
        ),
        EvolutionStep::Disc => (
            say!(lang, "Pin ${pin}$ enlarged until it surrounds ${pivot}$: eccentric disc"),
            Some(say!(lang, "$e = l_{{{pivot}{pin}}}$: the same motion")),
        ),
        EvolutionStep::Lever | EvolutionStep::Exchanged => {
            // The slider of a slider-crank becomes the rod.
            let bore = s.slides_on_ground() || is_bore(scene);
            let (rod, block) = if bore { (slider, on) } else { (on, slider) };
            let caption = match bore {
                true => say!(lang, "Rod {rod} in block {block}"),
                false => say!(lang, "Block {block} on guide {rod}"),
            };
            let change = (s.step == EvolutionStep::Exchanged).then(|| {
                tr!(lang, "elements of the slide exchanged: the same relative motion").to_owned()
            });
            (caption, change)
        }
    };
    let mut lines = vec![format!("({}) {caption}", k + 1)];
    lines.extend(change);
    let rate = |level| s.worked.solution.turning(level, s.follower);
    let index = name_label(link(s.follower));
    let rates: Vec<String> = [
        ("\\omega", Kind::Omega, rate(Level::Velocity)),
        ("\\alpha", Kind::Alpha, rate(Level::Acceleration)),
    ]
    .into_iter()
    .filter_map(|(letter, kind, value)| {
        Some(format!("{letter}_{{{index}}} = {}", amount(book, kind, value?)))
    })
    .collect();
    lines.push(format!("${}$", rates.join(",\\quad ")));
    lines.iter().map(|l| Phrase::new(l)).collect()
}
