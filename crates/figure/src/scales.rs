//! The scales below a drawing: formulas such as μ_l = 0.005 m/mm, each with a graphic scale, which
//! stays true when the page is printed smaller or larger.

use hodograph_base::geom::{Point, Vec2};
use hodograph_board::construct::scale::finer;
use hodograph_paper::paper::drawing::DrawingPart;
use hodograph_paper::paper::item::FigureItem;
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::style::Style;
use hodograph_paper::paper::symbols::scale_bar;
use hodograph_report::amount::{scale, scale_formula};
use hodograph_scene::{Book, DiagramKind};

/// Greatest length of a graphic scale (mm).
const LONGEST_MM: f64 = 20.0;
/// Gap between two graphic scales (mm).
const APART_MM: f64 = 6.0;

/// The scales of a drawing.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct DrawingScales {
    /// The formulas, with other words on the same line.
    pub text: String,
    /// The length (mm) of each graphic scale and the amount at its end, in the label language.
    bars: Vec<(f64, String)>,
}

impl DrawingScales {
    /// The scale μ (SI units per mm) of a diagram.
    pub fn of(book: &Book, on: DiagramKind, mu: f64) -> DrawingScales {
        let per_mm = book.value(on.kind(), mu);
        let amount = finer(1.0, LONGEST_MM * per_mm, 1.0);
        let bar = (amount / per_mm, book.label(on.kind(), &scale(amount)));
        DrawingScales { text: scale_formula(book, on, mu), bars: vec![bar] }
    }

    /// Words instead of a scale.
    pub fn words(text: impl Into<String>) -> DrawingScales {
        DrawingScales { text: text.into(), bars: Vec::new() }
    }

    /// Appends other scales to the line.
    pub fn and(mut self, other: DrawingScales) -> DrawingScales {
        self.text = format!("{},\\quad {}", self.text, other.text);
        self.bars.extend(other.bars);
        self
    }

    /// The graphic scales in one row; `id` distinguishes them from those of other drawings.
    pub fn bars(&self, style: &Style, id: &str) -> Vec<FigureItem> {
        let mut row = Vec::new();
        let mut right_mm = 0.0;
        for (k, (length_mm, amount)) in self.bars.iter().enumerate() {
            let ends = [Label::math("0"), Label::math(amount)];
            let ends = ends.map(|label| label.in_fonts(&style.fonts));
            let mut bar = DrawingPart::of(scale_bar(style, Point::ORIGIN, *length_mm, ends));
            bar.translate(Vec2::new(right_mm - bar.bounds.min.x, 0.0));
            right_mm = bar.bounds.max.x + APART_MM;
            for (n, item) in bar.items.iter_mut().enumerate() {
                item.id = format!("scale-bar-{id}-{}", 10 * k + n + 1);
            }
            row.extend(bar.items);
        }
        row
    }
}
