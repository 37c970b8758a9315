//! Fits a figure to a given width or paper. First everything is reduced, type only as far as it
//! stays legible; then some content is left out; at last a diagnostic states the space needed. The
//! page is never larger than requested.
//!
//! This module decides the order of the attempts. A reduced drawing is drawn again to coarser
//! scales μ, so that its scales remain true.

use std::borrow::Cow;

use hodograph_base::diag::{Both, Diagnostic, Faults, Warned, both};
use hodograph_base::geom::Vec2;
use hodograph_board::construct::scale::coarser;
use hodograph_scene::{ByKind, DiagramKind, PageFormat, SHEET_BORDER_MM, Scene};
use hodograph_worked::worked::Worked;

use super::forces;
use super::list::{Extras, FigureEntry, FigureInput, Pages, USUAL};
use super::sheet::{Fewer, SheetOptions, drawing, sheet_in};
use super::steps::StepFigures;
use hodograph_paper::paper::extent::{bounds, translate};
use hodograph_paper::paper::item::Figure;

/// Size factors that are tried one after the other, in steps of about the series of scales. The
/// last drawings are as wide as a thumb.
const PARTS: [f64; 7] = [1.0, 0.8, 0.64, 0.5, 0.4, 0.32, 0.25];
/// The last of the size factors.
const LAST_PART: f64 = PARTS[PARTS.len() - 1];
/// A drawing that exceeds the page by more than this factor, reduced to the last size factor, fits
/// at none: a scale of the series makes it at most twice as small as its factor.
const FAR: f64 = 2.5;
/// Drawings larger than the page by more than this factor do not fit, whatever space their boxes
/// leave around the ink.
const MAY_FIT: f64 = 1.25;
/// Smallest factor at which drawings are reduced to save a page, for each point of the type: labels
/// of a slide need a drawing twice as large as those of a book.
const LEAST_OF_FEWER: f64 = 0.5 / 9.0;
/// Below this factor, forces that are too wide are left out of a sheet in type of a fixed size.
const LEAST_FORCES: f64 = 0.4;
/// Below this factor the type does not become smaller: text keeps its width, and content is left
/// out.
const LEAST_TYPE: f64 = 0.64;
/// Centres the figure on a page of this format. A page of several begins at its upper border.
///
/// # Errors
/// The size of its ink (mm) if it is too large.
pub(super) fn on_page(
    format: &PageFormat,
    mut figure: Figure,
    several: bool,
) -> Result<Figure, [f64; 2]> {
    let Some(ink) = bounds(&figure.items) else { return Ok(figure) };
    let (size, inner) = ([ink.width_mm(), ink.height_mm()], format.inner_mm());
    if size[0] > inner[0] || size[1] > inner[1] {
        return Err(size);
    }
    let [width, height] = format.sides_mm(size[1]);
    let centre = ink.centre();
    let up = if several { height - format.border_mm - ink.max.y } else { height / 2.0 - centre.y };
    translate(&mut figure.items, Vec2::new(width / 2.0 - centre.x, up));
    Ok(Figure { width_mm: width, height_mm: height, ..figure })
}

/// Draws the pages of a figure: in this format, or else on the scene's paper, if any. A figure that
/// fits that paper is returned unchanged.
///
/// # Errors
/// The errors of [`pages`].
pub fn drawn(
    entry: &FigureEntry,
    w: &FigureInput,
    format: Option<&PageFormat>,
) -> Result<Warned<Pages>, Faults> {
    if let Some(format) = format {
        return pages(entry, w, format);
    }
    let made = (entry.draw)(w);
    let Some([x, y]) = w.scene.paper.size_mm else { return made };
    let fits = |pages: &Pages| pages.iter().all(|(_, f)| f.width_mm <= x && f.height_mm <= y);
    match made {
        Ok(made) if fits(&made.value) => Ok(made),
        Err(faults) if faults.list.iter().all(|d| d.code != "paper-too-small") => Err(faults),
        Ok(_) | Err(_) => pages(entry, w, &PageFormat::paper([x, y])),
    }
}

/// Draws the pages of a figure in a given space.
///
/// # Errors
/// `paper-too-small` if the smallest legible figure is larger than the space; and the errors of the
/// figure itself.
///
/// ```
/// use hodograph_figure::{fit::pages, list::{Extras, FigureInput, named}, sheet::SheetOptions};
/// use hodograph_scene::{self as scene, Lang, PageFormat, templates};
/// use hodograph_worked::worked::{Scope, work};
/// let scene = scene::read(templates::get("slider-crank").unwrap())?.value;
/// let worked = work(&scene, Scope::Figure)?.value;
/// let (options, extras) = (SheetOptions::of_language(Lang::En), Extras::default());
/// let wanted = FigureInput { scene: &scene, worked: &worked, options: &options, extras: &extras };
/// let made = pages(named("mechanism").unwrap(), &wanted, &PageFormat::column(80.0))?.value;
/// assert_eq!(made[0].1.width_mm, 80.0);
/// # Ok::<(), hodograph_base::diag::Faults>(())
/// ```
pub fn pages(
    entry: &FigureEntry,
    w: &FigureInput,
    format: &PageFormat,
) -> Result<Warned<Pages>, Faults> {
    if entry.name == USUAL.name && w.extras.poses == 0 {
        return sheet_pages(w, format);
    }
    let (mut needs, mut tried) = ([0.0_f64; 2], Vec::new());
    for part in PARTS {
        let reduced = Reduced::of(w, part, &ByKind::default(), format);
        if !reduced.is_new(&mut tried, ()) {
            continue;
        }
        let smaller = reduced.drawn()?;
        let Warned { value, notes } = (entry.draw)(&smaller.wanted(w.extras))?;
        let placed: Result<Vec<_>, [f64; 2]> =
            value.into_iter().map(|(word, f)| Ok((word, on_page(format, f, false)?))).collect();
        match placed {
            Ok(value) => return Ok(Warned { value, notes }),
            Err(size) => needs = size,
        }
    }
    Err(too_small(entry.name, needs, format).into())
}

/// Draws the sheet at the largest size factor that fits, or at a smaller one that saves pages: the
/// product of their number and of the root of the reduction is least.
fn sheet_pages(w: &FigureInput, format: &PageFormat) -> Result<Warned<Pages>, Faults> {
    let mut needs = [0.0_f64; 2];
    let mut best: Option<(f64, Warned<Pages>)> = None;
    let mut tried = Vec::new();
    let least = LEAST_OF_FEWER * format.type_pt.unwrap_or_default();
    for part in PARTS {
        if best.is_some() && part < least {
            break;
        }
        let reduced = Reduced::of(w, part, &ByKind::default(), format);
        if !reduced.is_new(&mut tried, fewer(part, format)) {
            continue;
        }
        let smaller = reduced.drawn()?;
        match sheet_of(&smaller.wanted(w.extras), part, format) {
            Ok(made) if format.height_mm.is_infinite() => {
                return Ok(if part == 1.0 { None } else { grown(w, part, format)? }.unwrap_or(made));
            }
            Ok(made) if made.value.len() == 1 => return Ok(made),
            Ok(made) => {
                let cost = made.value.len() as f64 / part.sqrt();
                if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                    best = Some((cost, made));
                }
            }
            Err(size) => needs = size,
        }
    }
    best.map(|(_, made)| made).ok_or_else(|| too_small(USUAL.name, needs, format).into())
}

/// Draws the steps of the construction, one page each. In a given format all pages have one size,
/// so that slides do not jump.
///
/// # Errors
/// `paper-too-small` if the smallest legible pages are larger than the format.
pub fn steps(w: &FigureInput, format: Option<&PageFormat>) -> Result<Pages, Faults> {
    let pages =
        |steps: &StepFigures| -> Pages { steps.words().into_iter().zip(steps.figures()).collect() };
    let Some(format) = format else {
        return Ok(pages(&StepFigures::of(w.scene, w.worked, w.options, None)));
    };
    first_that_fits("steps", w, format, false, |w, stacked| {
        let inner = format.inner_mm();
        let within = Within { width_mm: inner[0], stacked };
        let steps = StepFigures::of(w.scene, w.worked, w.options, Some(within));
        // A figure for each step is drawn only where the drawings may fit.
        let needs = steps.drawings_mm();
        match (0..2).any(|k| needs[k] > MAY_FIT * inner[k]) {
            true => Ok(Err(needs)),
            false => Ok(alike(pages(&steps), format)),
        }
    })
}

/// The space between the margins of a page, and the arrangement of drawings in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Within {
    /// The width (mm).
    pub width_mm: f64,
    /// True if drawings are one below the other, false if side by side.
    pub stacked: bool,
}

/// Returns the first attempt that fits: drawings side by side as long as their type is easily
/// legible, then one below the other (`true`), each at decreasing sizes. With `alike` both are one
/// drawing, and no size is tried twice. `draw` returns the size (mm) of a drawing that does not fit.
///
/// # Errors
/// `paper-too-small` if the smallest legible one does not fit; and the errors of `draw`.
pub fn first_that_fits<T>(
    name: &str,
    w: &FigureInput,
    format: &PageFormat,
    alike: bool,
    mut draw: impl FnMut(&FigureInput, bool) -> Result<Result<T, [f64; 2]>, Faults>,
) -> Result<T, Faults> {
    let (mut needs, mut tried) = ([0.0_f64; 2], Vec::new());
    let (inner, mut far) = (format.inner_mm(), false);
    let beside = PARTS.into_iter().filter(|part| *part >= LEAST_TYPE).map(|part| (part, false));
    let below = PARTS.into_iter().filter(|part| !alike || *part < LEAST_TYPE);
    for (part, stacked) in beside.chain(below.map(|part| (part, true))) {
        let is_last = stacked && part <= LAST_PART;
        if far && !is_last {
            continue;
        }
        let reduced = Reduced::of(w, part, &ByKind::default(), format);
        if !reduced.is_new(&mut tried, stacked) {
            continue;
        }
        let smaller = reduced.drawn()?;
        match draw(&smaller.wanted(w.extras), stacked)? {
            Ok(made) => return Ok(made),
            Err(size) => {
                // One below the other, two drawings have at least half the width.
                let least = [if stacked { size[0] } else { 0.5 * size[0] }, size[1]];
                far |= (0..2).any(|k| {
                    // Labels need their space: a far too large drawing that does not shrink stays so.
                    let keeps = needs[k] > 0.0 && size[k] >= needs[k];
                    least[k] * LAST_PART / part > FAR * inner[k]
                        || keeps && size[k] > inner[k] / LAST_PART
                });
                needs = size;
            }
        }
    }
    let help = both!("give more room; scales that the scene fixes are kept");
    Err(too_small(name, needs, format).help(help).into())
}

/// Centres figures on pages of one size, all shifted alike.
///
/// # Errors
/// The size (mm) of all ink together if it is too large.
fn alike(mut figures: Pages, format: &PageFormat) -> Result<Pages, [f64; 2]> {
    let ink = figures.iter().filter_map(|(_, f)| bounds(&f.items)).reduce(|a, b| a.union(b));
    let Some(ink) = ink else { return Ok(figures) };
    let (size, inner) = ([ink.width_mm(), ink.height_mm()], format.inner_mm());
    if size[0] > inner[0] || size[1] > inner[1] {
        return Err(size);
    }
    let [width, height] = format.sides_mm(size[1]);
    let shift = Vec2::new(width / 2.0, height / 2.0) - Vec2::new(ink.centre().x, ink.centre().y);
    for (_, figure) in &mut figures {
        translate(&mut figure.items, shift);
        (figure.width_mm, figure.height_mm) = (width, height);
    }
    Ok(figures)
}

/// The sheet at this size factor, if it fits.
fn sheet_of(w: &FigureInput, part: f64, format: &PageFormat) -> Result<Warned<Pages>, [f64; 2]> {
    let (figures, out) =
        sheet_in(w.scene, w.worked, w.options, format.inner_mm(), fewer(part, format))?;
    let several = figures.len() > 1;
    let paged = |(k, figure)| Ok((page_word(k, several), on_page(format, figure, several)?));
    Ok(Warned {
        value: figures.into_iter().enumerate().map(paged).collect::<Result<_, [f64; 2]>>()?,
        notes: left_out(&out, format).into_iter().collect(),
    })
}

/// The word of a page for its file: `a`, `b`, and numbers after `z`; empty for the only one.
fn page_word(page: usize, several: bool) -> String {
    match u8::try_from(page) {
        _ if !several => String::new(),
        Ok(k) if k < 26 => char::from(b'a' + k).to_string(),
        _ => (page + 1).to_string(),
    }
}

/// The sheet at this size factor in a column of free height, with each drawing as large as the
/// column holds by itself. `None` if nothing can be enlarged, or everything together becomes too
/// wide.
fn grown(w: &FigureInput, part: f64, format: &PageFormat) -> Result<Option<Warned<Pages>>, Faults> {
    let mut parts = ByKind::default();
    for on in DiagramKind::OF_MOTION {
        // Upwards to the first factor that is too wide: the slow placing of crowded names is then
        // rare.
        for larger in PARTS.into_iter().rev().filter(|p| *p > part) {
            let others = ByKind::default().with(on.kind(), Some(larger));
            let tried = Reduced::of(w, part, &others, format).drawn()?;
            let wanted = tried.wanted(w.extras);
            let fits = |width_mm: f64| width_mm <= format.inner_mm()[0];
            // Drawings with lines that are too wide need no names.
            let lines_fit =
                wanted.worked.construction.polygon(on).is_none_or(|p| fits(p.extent()[0] / p.mu));
            let drawn = || drawing(wanted.scene, wanted.worked, wanted.options, on);
            let links_fit = || {
                on != DiagramKind::Plane
                    || fits(forces::widest_mm(wanted.scene, wanted.worked, wanted.options))
            };
            if !lines_fit
                || !drawn().is_none_or(|figure| fits(figure.width_mm - 2.0 * SHEET_BORDER_MM))
                || !links_fit()
            {
                break;
            }
            parts.set(on.kind(), Some(larger));
        }
    }
    if parts == ByKind::default() {
        return Ok(None);
    }
    let smaller = Reduced::of(w, part, &parts, format).drawn()?;
    Ok(sheet_of(&smaller.wanted(w.extras), part, format).ok())
}

/// The content that may be left out of a sheet at this size factor. Type of a fixed size does not
/// become narrower with the drawings.
fn fewer(part: f64, format: &PageFormat) -> Fewer {
    if part == LAST_PART {
        Fewer::Drawings
    } else if format.type_pt.is_some() && part > LEAST_FORCES {
        Fewer::Broken
    } else if part > LEAST_TYPE {
        Fewer::No
    } else {
        Fewer::Words
    }
}

/// Places finished figures on pages of this format, at their size. If they are one drawing that
/// grows (`growing`), all pages have one size and the drawing keeps its place.
///
/// # Errors
/// `paper-too-small` for each that is larger.
pub fn placed(figures: Pages, format: &PageFormat, growing: bool) -> Result<Pages, Faults> {
    if growing {
        let name = figures.first().map(|(word, _)| word.clone()).unwrap_or_default();
        return alike(figures, format).map_err(|size| too_small(&name, size, format).into());
    }
    let (mut out, mut faults) = (Pages::new(), Faults::default());
    for (word, figure) in figures {
        match on_page(format, figure, false) {
            Ok(figure) => out.push((word, figure)),
            Err(size) => faults.push(too_small(&word, size, format)),
        }
    }
    if faults.has_errors() { Err(faults) } else { Ok(out) }
}

fn too_small(name: &str, needs: [f64; 2], format: &PageFormat) -> Diagnostic {
    let [w, h] = needs.map(|mm| mm + 2.0 * format.border_mm);
    let name = if name.is_empty() { USUAL.name } else { name };
    let (x, y) = (format.width_mm, format.height_mm);
    let message = if y.is_infinite() {
        both!(
            "the figure `{name}` needs {w:.0} mm in the smallest type that can be read; the width is {x} mm"
        )
    } else {
        both!(
            "the figure `{name}` needs {w:.0} mm by {h:.0} mm in the smallest type that can be read; the paper has {x} by {y}"
        )
    };
    Diagnostic::error("paper-too-small", message).help(both!(
        "give more room, or ask for parts of it by --figure; scales that the scene fixes are kept"
    ))
}

fn left_out(what: &[Both], format: &PageFormat) -> Option<Diagnostic> {
    let parts = Both::join(what, [", ", "、"]);
    let [w, _] = format.inner_mm();
    (!what.is_empty()).then(|| {
        Diagnostic::note("left-out", both!("left out for want of room ({w:.0} mm): {}", parts))
            .help(both!("draw it by itself with --figure, or give more room"))
    })
}

/// Returns the scene at scales at which everything has at most this size factor, except scales that
/// the scene fixes; `None` if the solution fails at these scales.
pub fn to_part(
    scene: &Scene,
    worked: &Worked,
    options: &SheetOptions,
    part: f64,
) -> Option<(Scene, Worked)> {
    let extras = Extras::default();
    let w = FigureInput { scene, worked, options, extras: &extras };
    let reduced = Reduced::of(&w, part, &ByKind::default(), &PageFormat::paper([0.0; 2]));
    let Reduced { scene, worked, .. } = reduced.drawn().ok()?;
    match worked {
        Cow::Owned(worked) => Some((scene, worked)),
        Cow::Borrowed(_) => None,
    }
}

/// Everything for a figure at a given size factor.
struct Reduced<'a> {
    scene: Scene,
    /// The construction at the scales of `scene` once it is drawn; before, as it is given.
    worked: Cow<'a, Worked>,
    options: SheetOptions,
    /// True if the construction is drawn to other scales or on other paper than the given one.
    again: bool,
}

impl<'a> Reduced<'a> {
    /// Reduces the ink to this factor, and the scales of all diagrams except those with a factor in
    /// `others`. The construction is drawn by [`Reduced::drawn`].
    fn of(w: &FigureInput<'a>, part: f64, others: &ByKind, format: &PageFormat) -> Reduced<'a> {
        let mut scene = w.scene.clone();
        // The size of the paper is checked here, so the sheet itself has no fixed size.
        scene.paper.size_mm = None;
        let style = &w.options.style;
        let style = format.type_pt.map_or_else(|| style.reduced(part), |pt| style.typeset(pt));
        let options = SheetOptions { style, ..w.options.clone() };
        if part < 1.0 {
            for on in DiagramKind::ALL {
                let (kind, paper) = (on.kind(), &scene.paper);
                let part = others.get(kind).unwrap_or(part);
                let coarser =
                    |mu| if part < 1.0 { coarser(paper.unit(kind), mu, 1.0 / part) } else { mu };
                let mu = paper.scales.get(kind).or_else(|| w.worked.scale(on).map(coarser));
                scene.paper.scales.set(kind, mu);
            }
        }
        let again = part < 1.0 || w.scene.paper.size_mm.is_some();
        Reduced { scene, worked: Cow::Borrowed(w.worked), options, again }
    }

    /// Draws the construction to the scales.
    fn drawn(self) -> Result<Reduced<'a>, Faults> {
        if !self.again {
            return Ok(self);
        }
        let worked = Cow::Owned(self.worked.to_scales(&self.scene)?);
        Ok(Reduced { worked, ..self })
    }

    /// Returns false if the same has been tried: the scales of a series are coarser than the size
    /// factors. `with` is anything else that the drawing depends on.
    fn is_new<T: PartialEq>(&self, tried: &mut Vec<(ByKind, SheetOptions, T)>, with: T) -> bool {
        let this = (self.scene.paper.scales.clone(), self.options.clone(), with);
        let is_new = !tried.contains(&this);
        tried.push(this);
        is_new
    }

    fn wanted<'b>(&'b self, extras: &'b Extras) -> FigureInput<'b> {
        FigureInput { scene: &self.scene, worked: &self.worked, options: &self.options, extras }
    }
}
