//! Fits a figure to a given width or paper. First everything is reduced, type only as far as it
//! stays legible; then some content is left out; at last a diagnostic states the space needed. The
//! page is never larger than requested.
//!
//! This module decides the order of the attempts. A reduced drawing is drawn again to coarser
//! scales μ, so that its scales remain true.

use hodograph_base::diag::{Both, Diagnostic, Faults, Warned, both};
use hodograph_base::geom::Vec2;
use hodograph_board::construct::scale::coarser;
use hodograph_scene::{ByKind, DiagramKind, Scene};
use hodograph_worked::worked::{Scope, Worked, work};

use super::forces;
use super::list::{Extras, FigureEntry, FigureInput, Pages, USUAL};
use super::sheet::{Fewer, SheetOptions, drawing, sheet_in};
use super::steps::StepFigures;
use hodograph_paper::paper::extent::{bounds, translate};
use hodograph_paper::paper::item::Figure;

/// Size factors that are tried one after the other, in steps of about the series of scales. The
/// last drawings are as wide as a thumb.
const PARTS: [f64; 7] = [1.0, 0.8, 0.64, 0.5, 0.4, 0.32, 0.25];
/// Below this factor the type does not become smaller: text keeps its width, and content is left
/// out.
const LEAST_TYPE: f64 = 0.64;
/// Border of a page in a column of a book.
const BORDER_MM: f64 = 2.0;
/// Border of a sheet of paper: the strip that a printer cannot reach.
const MARGIN_MM: f64 = super::sheet::MARGIN_MM;

/// The space for pages.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Room {
    /// A column: pages have exactly this width (mm); their height is free.
    Column(f64),
    /// A sheet of paper (mm): pages have exactly this size.
    Paper([f64; 2]),
}

impl Room {
    fn border_mm(self) -> f64 {
        match self {
            Room::Column(_) => BORDER_MM,
            Room::Paper(_) => MARGIN_MM,
        }
    }

    /// The space within the border.
    fn inner(self) -> [f64; 2] {
        match self {
            Room::Column(w) => [w - 2.0 * BORDER_MM, f64::INFINITY],
            Room::Paper(sides) => sides.map(|mm| mm - 2.0 * MARGIN_MM),
        }
    }

    /// The size of the page around ink of this size (mm).
    fn sides(self, ink: [f64; 2]) -> [f64; 2] {
        match self {
            Room::Column(w) => [w, ink[1] + 2.0 * self.border_mm()],
            Room::Paper(sides) => sides,
        }
    }

    /// Centres the figure on a page of this size.
    ///
    /// # Errors
    /// The size of its ink (mm) if it is too large.
    pub fn page(self, mut figure: Figure) -> Result<Figure, [f64; 2]> {
        let Some(ink) = bounds(&figure.items) else { return Ok(figure) };
        let (size, inner) = ([ink.width_mm(), ink.height_mm()], self.inner());
        if size[0] > inner[0] || size[1] > inner[1] {
            return Err(size);
        }
        let [width, height] = self.sides(size);
        let centre = ink.centre();
        translate(&mut figure.items, Vec2::new(width / 2.0 - centre.x, height / 2.0 - centre.y));
        Ok(Figure { width_mm: width, height_mm: height, ..figure })
    }
}

/// Draws the pages of a figure: in a column of this width, or else on the scene's paper, if any. A
/// figure that fits that paper is returned unchanged.
///
/// # Errors
/// The errors of [`pages`].
pub fn drawn(
    entry: &FigureEntry,
    w: &FigureInput,
    width_mm: Option<f64>,
) -> Result<Warned<Pages>, Faults> {
    if let Some(width_mm) = width_mm {
        return pages(entry, w, Room::Column(width_mm));
    }
    let made = (entry.draw)(w);
    let Some([x, y]) = w.scene.paper.size_mm else { return made };
    let fits = |pages: &Pages| pages.iter().all(|(_, f)| f.width_mm <= x && f.height_mm <= y);
    match made {
        Ok(made) if fits(&made.value) => Ok(made),
        Err(faults) if faults.list.iter().all(|d| d.code != "paper-too-small") => Err(faults),
        Ok(_) | Err(_) => pages(entry, w, Room::Paper([x, y])),
    }
}

/// Draws the pages of a figure in a given space.
///
/// # Errors
/// `paper-too-small` if the smallest legible figure is larger than the space; and the errors of the
/// figure itself.
///
/// ```
/// use hodograph_figure::{fit::{Room, pages}, list::{Extras, FigureInput, named}, sheet::SheetOptions};
/// use hodograph_scene::{self as scene, Lang, templates};
/// use hodograph_worked::worked::{Scope, work};
/// let scene = scene::read(templates::get("slider-crank").unwrap())?.value;
/// let worked = work(&scene, Scope::Figure)?.value;
/// let (options, extras) = (SheetOptions::of_language(Lang::En), Extras::default());
/// let wanted = FigureInput { scene: &scene, worked: &worked, options: &options, extras: &extras };
/// let made = pages(named("mechanism").unwrap(), &wanted, Room::Column(80.0))?.value;
/// assert_eq!(made[0].1.width_mm, 80.0);
/// # Ok::<(), hodograph_base::diag::Faults>(())
/// ```
pub fn pages(entry: &FigureEntry, w: &FigureInput, room: Room) -> Result<Warned<Pages>, Faults> {
    let mut needs = [0.0_f64; 2];
    let of_sheet = entry.name == USUAL.name && w.extras.poses == 0;
    for part in PARTS {
        let smaller = Smaller::of(w, part, &ByKind::default())?;
        let wanted = smaller.wanted(w.extras);
        if of_sheet {
            match sheet_of(&wanted, part, room) {
                Ok(made) if part == 1.0 => return Ok(made),
                Ok(made) => return Ok(grown(w, part, room)?.unwrap_or(made)),
                Err(size) => needs = size,
            }
            continue;
        }
        let Warned { value, notes } = (entry.draw)(&wanted)?;
        let placed: Result<Vec<_>, [f64; 2]> =
            value.into_iter().map(|(word, f)| Ok((word, room.page(f)?))).collect();
        match placed {
            Ok(value) => return Ok(Warned { value, notes }),
            Err(size) => needs = size,
        }
    }
    let name = if entry.name.is_empty() { USUAL.name } else { entry.name };
    Err(too_small(name, needs, room).into())
}

/// Draws the steps of the construction, one page each. In a column of this width all pages have one
/// size, so that slides do not jump.
///
/// # Errors
/// `paper-too-small` if the smallest legible pages are wider than the column.
pub fn steps(w: &FigureInput, width_mm: Option<f64>) -> Result<Pages, Faults> {
    let pages = |w: &FigureInput, within| -> Pages {
        let steps = StepFigures::of(w.scene, w.worked, w.options, within);
        steps.words().into_iter().zip(steps.figures()).collect()
    };
    let Some(room) = width_mm.map(Room::Column) else { return Ok(pages(w, None)) };
    first_that_fits("steps", w, room, |w, stacked| {
        Ok(alike(pages(w, Some(Within { width_mm: room.inner()[0], stacked })), room))
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
/// legible, then one below the other (`true`), each at decreasing sizes. `draw` returns the size
/// (mm) of a drawing that does not fit.
///
/// # Errors
/// `paper-too-small` if the smallest legible one does not fit; and the errors of `draw`.
pub fn first_that_fits<T>(
    name: &str,
    w: &FigureInput,
    room: Room,
    draw: impl Fn(&FigureInput, bool) -> Result<Result<T, [f64; 2]>, Faults>,
) -> Result<T, Faults> {
    let mut needs = [0.0_f64; 2];
    let beside = PARTS.into_iter().filter(|part| *part >= LEAST_TYPE).map(|part| (part, false));
    for (part, stacked) in beside.chain(PARTS.map(|part| (part, true))) {
        match draw(&Smaller::of(w, part, &ByKind::default())?.wanted(w.extras), stacked)? {
            Ok(made) => return Ok(made),
            Err(size) => needs = size,
        }
    }
    let help = both!(
        "give more room; scales that the scene fixes are kept",
        "请给更大的幅面；机构文件规定的比例尺保持不变"
    );
    Err(too_small(name, needs, room).help(help).into())
}

/// Places finished figures of one size in a given space, all shifted alike.
///
/// # Errors
/// `paper-too-small` if one of them is larger.
pub fn placed_alike(figures: Pages, room: Room) -> Result<Pages, Faults> {
    let name = figures.first().map(|(word, _)| word.clone()).unwrap_or_default();
    alike(figures, room).map_err(|size| too_small(&name, size, room).into())
}

/// Works like [`placed_alike`], but returns the size (mm) of all ink together as its error.
fn alike(mut figures: Pages, room: Room) -> Result<Pages, [f64; 2]> {
    let ink = figures.iter().filter_map(|(_, f)| bounds(&f.items)).reduce(|a, b| a.union(b));
    let Some(ink) = ink else { return Ok(figures) };
    let (size, inner) = ([ink.width_mm(), ink.height_mm()], room.inner());
    if size[0] > inner[0] || size[1] > inner[1] {
        return Err(size);
    }
    let [width, height] = room.sides(size);
    let shift = Vec2::new(width / 2.0, height / 2.0) - Vec2::new(ink.centre().x, ink.centre().y);
    for (_, figure) in &mut figures {
        translate(&mut figure.items, shift);
        (figure.width_mm, figure.height_mm) = (width, height);
    }
    Ok(figures)
}

/// The sheet at this size factor, if it fits.
fn sheet_of(w: &FigureInput, part: f64, room: Room) -> Result<Warned<Pages>, [f64; 2]> {
    let (figure, out) = sheet_in(w.scene, w.worked, w.options, room.inner()[0], fewer(part));
    let figure = room.page(figure)?;
    Ok(Warned {
        value: vec![(String::new(), figure)],
        notes: left_out(&out, room).into_iter().collect(),
    })
}

/// The sheet at this size factor in a column of free height, with each drawing as large as the
/// column holds by itself. `None` if the space is not a column, nothing can be enlarged, or
/// everything together becomes too wide.
fn grown(w: &FigureInput, part: f64, room: Room) -> Result<Option<Warned<Pages>>, Faults> {
    let Room::Column(_) = room else { return Ok(None) };
    let mut parts = ByKind::default();
    for on in DiagramKind::OF_MOTION {
        // Upwards to the first factor that is too wide: the slow placing of crowded names is then
        // rare.
        for larger in PARTS.into_iter().rev().filter(|p| *p > part) {
            let tried = Smaller::of(w, part, &ByKind::default().with(on.kind(), Some(larger)))?;
            let wanted = tried.wanted(w.extras);
            let fits = |width_mm: f64| width_mm <= room.inner()[0];
            // Drawings with lines that are too wide need no names.
            let lines_fit =
                wanted.worked.construction.polygon(on).is_none_or(|p| fits(p.extent()[0] / p.mu));
            let drawn = || drawing(wanted.scene, wanted.worked, wanted.options, on);
            let links_fit = || {
                on != DiagramKind::Plane
                    || fits(forces::widest_mm(wanted.scene, wanted.worked, wanted.options))
            };
            if !lines_fit
                || !drawn().is_none_or(|figure| fits(figure.width_mm - 2.0 * MARGIN_MM))
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
    let smaller = Smaller::of(w, part, &parts)?;
    Ok(sheet_of(&smaller.wanted(w.extras), part, room).ok())
}

/// The content that may be left out of a sheet at this size factor.
fn fewer(part: f64) -> Fewer {
    if part > LEAST_TYPE {
        Fewer::No
    } else if part > PARTS[PARTS.len() - 1] {
        Fewer::Words
    } else {
        Fewer::Drawings
    }
}

/// Places finished figures in a given space, at their size.
///
/// # Errors
/// `paper-too-small` for each that is larger.
pub fn placed(figures: Pages, room: Room) -> Result<Pages, Faults> {
    let (mut out, mut faults) = (Pages::new(), Faults::default());
    for (word, figure) in figures {
        match room.page(figure) {
            Ok(figure) => out.push((word, figure)),
            Err(size) => faults.push(too_small(&word, size, room)),
        }
    }
    if faults.has_errors() { Err(faults) } else { Ok(out) }
}

fn too_small(name: &str, needs: [f64; 2], room: Room) -> Diagnostic {
    let [w, h] = needs.map(|mm| mm + 2.0 * room.border_mm());
    let message = match room {
        Room::Column(width) => both!(
            "the figure `{name}` needs {w:.0} mm in the smallest type that can be read; the width is {width} mm",
            "图 `{name}` 用可读的最小字号也需宽 {w:.0} mm，而给定宽度为 {width} mm"
        ),
        Room::Paper([x, y]) => both!(
            "the figure `{name}` needs {w:.0} mm by {h:.0} mm in the smallest type that can be read; the paper has {x} by {y}",
            "图 `{name}` 用可读的最小字号也需 {w:.0} mm × {h:.0} mm，而图纸为 {x} × {y}"
        ),
    };
    Diagnostic::error("paper-too-small", message).help(both!(
        "give more room, or ask for parts of it by --figure; scales that the scene fixes are kept",
        "请给更大的幅面，或用 --figure 只画其中的部分；机构文件规定的比例尺保持不变"
    ))
}

fn left_out(what: &[Both], room: Room) -> Option<Diagnostic> {
    let list =
        |of: fn(&Both) -> &str, comma: &str| what.iter().map(of).collect::<Vec<_>>().join(comma);
    let (en, zh) = (list(|b| &b.en, ", "), list(|b| &b.zh, "、"));
    let [w, _] = room.inner();
    (!what.is_empty()).then(|| {
        Diagnostic::note(
            "left-out",
            both!(
                "left out for want of room ({w:.0} mm): {en}",
                "因幅面不够（{w:.0} mm）而略去：{zh}"
            ),
        )
        .help(both!(
            "draw it by itself with --figure, or give more room",
            "请用 --figure 单独画，或给更大的幅面"
        ))
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
    let Smaller { scene, worked, .. } = Smaller::of(
        &FigureInput { scene, worked, options, extras: &extras },
        part,
        &ByKind::default(),
    )
    .ok()?;
    Some((scene, worked?))
}

/// Everything for a figure at a given size factor.
struct Smaller {
    scene: Scene,
    worked: Option<Worked>,
    before: Worked,
    options: SheetOptions,
}

impl Smaller {
    /// Reduces the ink to this factor, and all diagrams except those with a factor in `others`.
    fn of(w: &FigureInput, part: f64, others: &ByKind) -> Result<Smaller, Faults> {
        let mut scene = w.scene.clone();
        // The size of the paper is checked here, so the sheet itself has no fixed size.
        scene.paper.size_mm = None;
        let options = SheetOptions { style: w.options.style.reduced(part), ..w.options.clone() };
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
        let worked = if again { Some(work(&scene, Scope::Figure)?.value) } else { None };
        let worked =
            worked.map(|k| if w.worked.drafting.is_some() { k.with_drafting(&scene) } else { k });
        Ok(Smaller { scene, worked, before: w.worked.clone(), options })
    }

    fn wanted<'a>(&'a self, extras: &'a Extras) -> FigureInput<'a> {
        FigureInput {
            scene: &self.scene,
            worked: self.worked.as_ref().unwrap_or(&self.before),
            options: &self.options,
            extras,
        }
    }
}
