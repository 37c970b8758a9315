//! The enlargement of drawings for a wanted tolerance.

use super::drafting::DraftedConstruction;
use hodograph_board::construct::Layout;
use hodograph_board::construct::scale::finer;
use hodograph_board::equilibrium::Equilibrium;
use hodograph_scene::{ByKind, DiagramKind, Kind, Paper};

/// The relative tolerance that an engineering drawing is expected to give.
const WANTED: f64 = 0.01;

/// ISO 216 sheets, upright, in mm, the smallest first.
const SHEETS: [(&str, [f64; 2]); 5] = [
    ("A4", [210.0, 297.0]),
    ("A3", [297.0, 420.0]),
    ("A2", [420.0, 594.0]),
    ("A1", [594.0, 841.0]),
    ("A0", [841.0, 1189.0]),
];

/// The margin on each side of a sheet (mm).
const BORDER_MM: f64 = 10.0;

/// The drawings enlarged until a reading is within 1 %.
///
/// All drawings that the reading depends on (diagram, velocity polygon, acceleration polygon) are
/// enlarged alike: the tolerance is then exactly in inverse proportion. To enlarge one of them
/// alone would not suffice in general, because the marks of the others stay.
#[derive(Clone, Debug, PartialEq)]
pub struct Larger {
    /// The factor of the enlargement; not more than 1 if the drawing is large enough.
    pub factor: f64,
    /// The scales for that (SI per mm): the next of the series, the present one if it suffices,
    /// none for a drawing that the reading does not depend on.
    pub scales: ByKind,
    /// Width and height of the largest of these enlarged drawings (mm).
    pub size_mm: [f64; 2],
}

impl Larger {
    /// Returns the factor to tenths, from 10 on to whole numbers, rounded up: a little larger does
    /// no harm, a little smaller would not suffice.
    pub fn rounded(&self) -> f64 {
        if self.factor < 10.0 { (self.factor * 10.0).ceil() / 10.0 } else { self.factor.ceil() }
    }

    /// Returns the smallest sheet that holds the largest of the drawings, upright or across; `None`
    /// if A0 does not.
    pub fn sheet(&self) -> Option<&'static str> {
        let [w, h] = self.size_mm;
        let (short, long) = (w.min(h) + 2.0 * BORDER_MM, w.max(h) + 2.0 * BORDER_MM);
        SHEETS.iter().find(|(_, [a, b])| short <= *a && long <= *b).map(|s| s.0)
    }
}

/// The enlargement for a relative tolerance; `parts` is positive for the drawings that matter.
pub(super) fn larger(
    paper: &Paper,
    drawn: &DraftedConstruction,
    layout: &Layout,
    relative: f64,
    parts: &ByKind,
) -> Larger {
    let factor = relative / WANTED;
    let mut present = layout.scales.clone().with(Kind::Length, Some(layout.mu));
    present.set(Kind::Force, drawn.equilibrium.map(Equilibrium::mu));
    let mut scales = ByKind::default();
    let mut size_mm = [0.0f64; 2];
    for on in DiagramKind::ALL {
        let Some(now) =
            present.get(on.kind()).filter(|_| parts.get(on.kind()).is_some_and(|part| part > 0.0))
        else {
            continue;
        };
        let then = if factor > 1.0 { finer(paper.unit(on.kind()), now, factor) } else { now };
        let on_paper = drawn.size_mm(on).map(|mm| mm * now / then);
        if on_paper[0].max(on_paper[1]) > size_mm[0].max(size_mm[1]) {
            size_mm = on_paper;
        }
        scales.set(on.kind(), Some(then));
    }
    Larger { factor, scales, size_mm }
}
