//! Additions to the drawing of the mechanism, by the names of a request.

use super::Extent;
use super::range::WrongValue;
use crate::diag::{Diagnostic, Faults, Span, both};
use crate::figure::list::{Extras, FigureEntry};
use crate::scene::{self, DiagramKind, PageFormat, PointId, Scene};
use crate::worked::Worked;
use hodograph_base::json::fields::suggest;

/// Requested additions to the drawing of the mechanism.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Additions<'a> {
    /// Vectors at its points: `velocity` or `acceleration`.
    pub vectors: Option<&'a str>,
    /// True if the given lengths are drawn as dimensions.
    pub dimensions: bool,
    /// Number of positions of the first driver.
    pub poses: usize,
    /// Names of points with their paths shown.
    pub path: &'a [String],
}

/// Returns the items that are drawn with the mechanism.
///
/// # Errors
/// `no-figure`: vectors that are not drawn for the questions; `unknown-point`.
pub fn extras(
    scene: &Scene,
    worked: &Worked,
    wanted: &Additions,
) -> Result<Extras, Vec<WrongValue>> {
    let vectors = |name| {
        [DiagramKind::Velocity, DiagramKind::Acceleration].into_iter().find(|on| on.word() == name)
    };
    let mut wrong = Vec::new();
    let on = wanted.vectors.and_then(vectors);
    if let Some(word) = wanted.vectors
        && on.is_none_or(|on| worked.construction.polygon(on).is_none())
    {
        let kind = on.unwrap_or(DiagramKind::Velocity).vectors();
        let d = Diagnostic::error("no-figure", both!("the scene's questions call for no {}", kind))
            .help(both!("ask for one in \"find\""));
        wrong.push(WrongValue::new("vectors", word, d));
    }
    match points_named(scene, wanted.path, "path") {
        Ok(points) if wrong.is_empty() => {
            let Additions { dimensions, poses, .. } = *wanted;
            Ok(Extras { vectors: on, dimensions, poses, points })
        }
        Ok(_) => Err(wrong),
        Err(unknown) => {
            wrong.push(unknown);
            Err(wrong)
        }
    }
}

/// Returns the points with the names that a value `of` a request lists.
///
/// # Errors
/// `unknown-point` for each name that the scene does not have.
pub fn points_named(
    scene: &Scene,
    names: &[String],
    of: &'static str,
) -> Result<Vec<PointId>, WrongValue> {
    let mut faults = Faults::default();
    let mut points = Vec::new();
    let mut start = 0;
    for whole in names {
        let name = whole.trim();
        match (0..scene.points.len()).map(PointId).find(|p| scene.point_name(*p) == name) {
            Some(p) if points.contains(&p) => {}
            Some(p) => points.push(p),
            None => {
                let known = (0..scene.points.len()).map(|p| scene.point_name(PointId(p)));
                let d =
                    Diagnostic::error("unknown-point", both!("the scene has no point `{name}`"))
                        .at(Span::new(start, start + whole.len()));
                faults.push(d.help(suggest(name, known, both!("the points are"))));
            }
        }
        start += whole.len() + 1;
    }
    if faults.has_errors() {
        Err(WrongValue::new(of, &names.join(","), faults))
    } else {
        Ok(points)
    }
}

/// Reads the page of a sheet to draw on, such as `a4`.
///
/// # Errors
/// `paper` if it is no format of a sheet of paper or of a slide.
pub fn whole_page(text: &str) -> Result<PageFormat, WrongValue> {
    let page = scene::page(text).map_err(|faults| WrongValue::new("page", text, faults))?;
    if page.whole {
        return Ok(page);
    }
    let message = both!("{text} is not a sheet of paper");
    let d = Diagnostic::error("paper", message).help(both!("write --page a4 or --page a3"));
    Err(WrongValue::new("page", text, d))
}

impl Extent {
    /// Returns the part of a scene on which figures depend.
    pub fn of(figures: &[&FigureEntry]) -> Extent {
        let still = |e: &&FigureEntry| {
            matches!(e.name, "centres" | "curvature" | "centrodes" | "inversions")
        };
        if !figures.is_empty() && figures.iter().all(still) { Extent::Pose } else { Extent::Motion }
    }
}
