//! Draws the poses of a motion one after the other: figures of one size, with ground and poles at
//! the same place in all of them.
//!
//! This module arranges a frame. The conversion of frames to an animation is in `render::gif` and
//! `render::moving`.

use super::cells::PoseColumn;
use super::{PoseTable, Poses, PosesContent, text};
use crate::sheet::{MARGIN_MM, SheetDrafter, SheetOptions, swept_symbol};
use hodograph_base::diag::{Faults, Warned};
use hodograph_base::geom::Point;
use hodograph_board::construct::scale::{self, Boxes};
use hodograph_paper::paper::item::{Anchor, Figure, FigureItem};
use hodograph_paper::paper::label::Label;
use hodograph_report::amount::scale_formula;
use hodograph_scene::{DiagramKind, Scene, Swept};
use hodograph_worked::worked::Worked;

/// Gap between drawings.
const GAP_MM: f64 = 10.0;
/// Space for the drawings of a frame.
const BOXES: Boxes = Boxes { diagram: [90.0, 80.0], polygon: [95.0, 80.0] };
/// Distance from the title to the drawings.
const TITLE_MM: f64 = 12.0;
/// Distance from the drawings to the caption's baseline, and from there to the scale's.
const CAPTION_MM: f64 = 8.0;
const SCALE_MM: f64 = 5.6;

/// A motion as figures.
#[derive(Clone, Debug, PartialEq)]
pub struct PoseFrames {
    /// One figure for each pose, all of one size.
    pub frames: Vec<Figure>,
    /// True if the first frame follows the last one: after a full turn, and where time advances.
    /// Otherwise the motion returns the way it came.
    pub full: bool,
}

impl PoseFrames {
    /// Returns the frames of one period, in the order of time.
    pub fn period(&self) -> Vec<&Figure> {
        let back = self.frames.iter().rev().skip(1).take(self.frames.len().saturating_sub(2));
        self.frames.iter().chain(back.filter(|_| !self.full)).collect()
    }
}

/// Draws the poses at equal steps of a driver as figures of one size. Width and height are even
/// multiples of `step_mm`, because animations need even numbers of pixels.
///
/// # Errors
/// `no-motion` if the mechanism cannot be followed from its pose.
pub fn turn(
    scene: &Scene,
    worked: &Worked,
    options: &SheetOptions,
    wanted: &PosesContent,
    step_mm: f64,
) -> Result<Warned<PoseFrames>, Faults> {
    let poses = Poses::of(scene, worked, wanted, (BOXES, scale::filling))?;
    let table = poses.table(options, wanted.swept, true);
    let columns = table.columns();
    let width: f64 = columns.iter().map(|c| c.bounds.width_mm()).sum::<f64>()
        + GAP_MM * columns.len().saturating_sub(1) as f64;
    let height = columns.iter().map(|c| c.bounds.height_mm()).fold(0.0, f64::max);
    let even = |mm: f64| (mm / (2.0 * step_mm)).ceil() * 2.0 * step_mm;
    let size = [
        even(width + 2.0 * MARGIN_MM),
        even(height + TITLE_MM + CAPTION_MM + SCALE_MM + 2.0 * MARGIN_MM),
    ];
    let frames = (0..poses.rows.len()).map(|k| frame(&table, &columns, k, size)).collect();
    Ok(Warned {
        value: PoseFrames { frames, full: poses.full || wanted.swept == Swept::Time },
        notes: poses.notes(scene, wanted),
    })
}

fn frame(table: &PoseTable, columns: &[PoseColumn], k: usize, size: [f64; 2]) -> Figure {
    let (options, row) = (table.options, &table.rows[k]);
    let maker =
        SheetDrafter { scene: &row.scene, worked: &row.worked, options, certified: Vec::new() };
    let foot = MARGIN_MM + SCALE_MM + CAPTION_MM;
    let room = size[1] - MARGIN_MM - TITLE_MM - foot;
    let mut items = Vec::new();
    if let Some(mut title) = maker.title() {
        title.stand_at(Point::new(MARGIN_MM, size[1] - MARGIN_MM));
        items.extend(title.items);
    }
    let style = &options.style;
    let mut put = |id: &str, at: Point, label: Label, size_mm: f64, anchor: Anchor| {
        items.push(text("caption", at, label, size_mm, anchor).with_id(id).in_fonts(&style.fonts));
    };
    let (symbol, value) = (swept_symbol(&row.scene, table.swept).0, table.position(k));
    let corner = Point::new(size[0] - MARGIN_MM, size[1] - MARGIN_MM - style.caption_mm);
    put(
        "position",
        corner,
        Label::math(format!("{symbol} = {value}")),
        style.caption_mm,
        Anchor::End,
    );
    let used: f64 = columns.iter().map(|c| c.bounds.width_mm()).sum::<f64>()
        + GAP_MM * columns.len().saturating_sub(1) as f64;
    let mut edge = (size[0] - used) / 2.0;
    let mut drawn: Vec<FigureItem> = Vec::new();
    for column in columns {
        let middle = Point::new(edge + column.bounds.width_mm() / 2.0, foot + room / 2.0);
        let mut part = column.parts[k].clone();
        let absent = part.items.iter().any(|i| i.class == "absent");
        let held = if absent { part.bounds.centre() } else { column.bounds.centre() };
        part.translate(middle - held);
        drawn.extend(part.items);
        let (on, name) = (column.on, column.on.prefix());
        let (words, mu) = maker.caption(on);
        // A pose without a polygon has no scale of its own.
        let own = table.scales.mu.get(on.kind()).filter(|_| on > DiagramKind::Plane);
        let mu = own.map_or(mu.text, |mu| scale_formula(&row.scene.book, on, mu));
        let at = Point::new(middle.x, foot - CAPTION_MM);
        put(&format!("caption-{name}"), at, Label::text(words), style.caption_mm, Anchor::Middle);
        put(
            &format!("scale-{name}"),
            Point::new(at.x, at.y - SCALE_MM),
            Label::math(mu),
            style.small_mm,
            Anchor::Middle,
        );
        edge += column.bounds.width_mm() + GAP_MM;
    }
    items.extend(drawn);
    maker.figure(items, size)
}
