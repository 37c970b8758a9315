//! The display list: the content of the paper, in millimetres, x to the right and **y up**.
//!
//! An item is finished: its writer needs no style, no scene and no solution. Items are drawn in the
//! order of the list. The writers of files turn y over where their format needs it.

use hodograph_base::diag::{Diagnostic, both};
use hodograph_base::geom::Point;
use std::collections::HashSet;

use super::arrow::ArrowHead;
use super::font::own::Fonts;
use super::label::Label;
use super::shown::ShownQuantity;

/// A drawing on a sheet.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Width of the paper.
    pub width_mm: f64,
    /// Height of the paper.
    pub height_mm: f64,
    /// A title for readers who do not see the figure.
    pub title: String,
    /// Description of the figure in words.
    pub desc: String,
    /// Language tag of title and description, such as `en` or `zh`.
    pub lang: String,
    /// Colour of the paper; any colour but white is painted.
    pub paper: Colour,
    /// The items to draw, from back to front.
    pub items: Vec<FigureItem>,
}

impl Figure {
    /// Number of labels that were placed by search among the lines of a drawing; captions, tables
    /// and results have given positions and do not count.
    pub fn labels_placed(&self) -> usize {
        let placed = |i: &&FigureItem| {
            matches!(i.shape, Shape::Label { .. }) && i.class.split(' ').next_back() == Some(PLACED)
        };
        self.items.iter().filter(placed).count()
    }

    /// Remarks on the figure for its reader: a note if it had too many labels for a full search.
    pub fn remarks(&self) -> Vec<Diagnostic> {
        let coarse = |i: &&FigureItem| i.class.rsplit(' ').nth(1) == Some(COARSE);
        let count = self.items.iter().filter(coarse).count();
        let message = both!(
            "{count} labels are more than can be weighed against one another: each took the best place that was left"
        );
        let help =
            both!("draw fewer points, or ask for less in \"find\"; --figure draws one part alone");
        (count > 0)
            .then(|| Diagnostic::note("coarse-labels", message).help(help))
            .into_iter()
            .collect()
    }
}

/// The last word of the class of every label that was placed by search.
pub const PLACED: &str = "label";

/// The word before [`PLACED`] if there were so many labels that they were placed one after the
/// other.
pub const COARSE: &str = "coarse";

/// One element of a figure.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "wire", derive(serde::Serialize, serde::Deserialize))]
pub struct FigureItem {
    /// A name unique in the figure; may be empty.
    pub id: String,
    /// Fixed words for step-by-step display, such as `velocity edge unknown`; may be empty.
    pub class: String,
    /// The link that the item belongs to, by its index in the scene: styles may colour it.
    pub link: Option<usize>,
    /// The quantity that a vector or mark shows.
    #[cfg_attr(feature = "wire", serde(skip))]
    pub shown: Option<Box<ShownQuantity>>,
    /// The shape to draw.
    pub shape: Shape,
}

/// A colour of ink or paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "wire", derive(serde::Serialize, serde::Deserialize))]
pub struct Colour {
    /// Red component.
    pub r: u8,
    /// Green component.
    pub g: u8,
    /// Blue component.
    pub b: u8,
}

impl Colour {
    /// Black ink.
    pub const BLACK: Colour = Colour::grey(0);
    /// White paper.
    pub const WHITE: Colour = Colour::grey(255);

    /// Returns a grey: 0 is black, 255 white.
    pub const fn grey(level: u8) -> Colour {
        Colour { r: level, g: level, b: level }
    }

    /// Returns the colour with these components.
    pub const fn rgb(r: u8, g: u8, b: u8) -> Colour {
        Colour { r, g, b }
    }
}

/// The pattern of a line (names as in ISO 128-2).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "wire", derive(serde::Serialize, serde::Deserialize))]
pub enum Dash {
    /// Continuous.
    #[default]
    Solid,
    /// Dashed: hidden edges, and directions drawn before their length is known.
    Dashed,
    /// Long dash, dot: centre lines and paths.
    DashDot,
    /// Dotted.
    Dotted,
}

impl Dash {
    /// Returns the lengths of strokes and gaps (mm); empty for a continuous line.
    pub const fn pattern_mm(self) -> &'static [f64] {
        match self {
            Dash::Solid => &[],
            Dash::Dashed => &[1.4, 0.8],
            Dash::DashDot => &[4.0, 0.8, 0.4, 0.8],
            Dash::Dotted => &[0.3, 0.7],
        }
    }
}

/// The form of a line's ends and corners.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "wire", derive(serde::Serialize, serde::Deserialize))]
pub enum Cap {
    /// Cut off at the end, with mitred corners.
    #[default]
    Butt,
    /// Round ends and corners: links.
    Round,
}

/// The appearance of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "wire", derive(serde::Serialize, serde::Deserialize))]
pub struct LineStroke {
    /// Width of the line.
    pub width_mm: f64,
    /// Line pattern.
    pub dash: Dash,
    /// Form of the ends and corners.
    pub cap: Cap,
    /// Line colour.
    pub colour: Colour,
}

impl LineStroke {
    /// Returns a continuous black line with cut ends.
    pub const fn new(width_mm: f64) -> LineStroke {
        LineStroke { width_mm, dash: Dash::Solid, cap: Cap::Butt, colour: Colour::BLACK }
    }

    /// Returns the stroke with a pattern.
    pub const fn dashed(self, dash: Dash) -> LineStroke {
        LineStroke { dash, ..self }
    }

    /// Returns the stroke with round ends.
    pub const fn round(self) -> LineStroke {
        LineStroke { cap: Cap::Round, ..self }
    }

    /// Returns the stroke with cut ends.
    pub const fn flat(self) -> LineStroke {
        LineStroke { cap: Cap::Butt, ..self }
    }

    /// Returns the stroke in another colour.
    pub const fn coloured(self, colour: Colour) -> LineStroke {
        LineStroke { colour, ..self }
    }
}

/// The reference point of a label's line, from left to right.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "wire", derive(serde::Serialize, serde::Deserialize))]
pub enum Anchor {
    /// Start of the baseline.
    #[default]
    Start,
    /// Middle of the baseline.
    Middle,
    /// End of the baseline.
    End,
}

/// A piece of a [`Shape::Path`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "wire", derive(serde::Serialize, serde::Deserialize))]
pub enum PathPiece {
    /// Starts at another point, as between the strokes of a hatching.
    Move(Point),
    /// A straight line to the point.
    Line(Point),
    /// An arc from the current point to `centre` + radius · (cos `to_rad`, sin `to_rad`);
    /// counter-clockwise if `to_rad` > `from_rad`.
    Arc {
        /// Centre of the arc.
        centre: Point,
        /// Radius of the arc.
        radius_mm: f64,
        /// Angle at the start.
        from_rad: f64,
        /// Angle at the end.
        to_rad: f64,
    },
}

/// The shape of an item.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "wire", derive(serde::Serialize, serde::Deserialize))]
pub enum Shape {
    /// A straight line.
    Line {
        /// Start point.
        from: Point,
        /// End point.
        to: Point,
        /// Line appearance.
        stroke: LineStroke,
    },
    /// A chain of straight lines, or a polygon.
    Polyline {
        /// Corners in order.
        points: Vec<Point>,
        /// True if the last corner is joined to the first.
        closed: bool,
        /// Outline, if any.
        stroke: Option<LineStroke>,
        /// Fill colour, if any.
        fill: Option<Colour>,
    },
    /// Lines and arcs in one stroke.
    Path {
        /// Start point.
        start: Point,
        /// The pieces after the start point.
        pieces: Vec<PathPiece>,
        /// True if the path is closed.
        closed: bool,
        /// Outline, if any.
        stroke: Option<LineStroke>,
        /// Fill colour, if any.
        fill: Option<Colour>,
    },
    /// A circle or disc.
    Circle {
        /// Centre.
        centre: Point,
        /// Radius.
        radius_mm: f64,
        /// Outline, if any.
        stroke: Option<LineStroke>,
        /// Fill colour, if any.
        fill: Option<Colour>,
    },
    /// An arc of a circle, counter-clockwise if `to_rad` > `from_rad`.
    Arc {
        /// Centre.
        centre: Point,
        /// Radius.
        radius_mm: f64,
        /// Angle at the start, counter-clockwise from x.
        from_rad: f64,
        /// Angle at the end.
        to_rad: f64,
        /// Line appearance.
        stroke: LineStroke,
    },
    /// A vector with its head at `to`.
    Arrow {
        /// Tail.
        from: Point,
        /// Tip.
        to: Point,
        /// Shaft.
        stroke: LineStroke,
        /// Head.
        head: ArrowHead,
    },
    /// A bent arrow with its head at `to_rad`; counter-clockwise if `to_rad` > `from_rad`.
    ArcArrow {
        /// Centre.
        centre: Point,
        /// Radius.
        radius_mm: f64,
        /// Angle at the tail.
        from_rad: f64,
        /// Angle at the tip.
        to_rad: f64,
        /// Shaft.
        stroke: LineStroke,
        /// Head.
        head: ArrowHead,
    },
    /// A label in one line, turned about its anchor, the middle of its baseline, as the numbers of
    /// dimensions are.
    Turned {
        /// Position of the anchor.
        at: Point,
        /// Reading direction.
        angle_rad: f64,
        /// The text.
        label: Label,
        /// Type size (em).
        size_mm: f64,
        /// Text colour.
        colour: Colour,
    },
    /// A label in one line.
    Label {
        /// Position of the anchor on the baseline.
        at: Point,
        /// The text.
        label: Label,
        /// Type size (em).
        size_mm: f64,
        /// The point of the line that is placed at `at`.
        anchor: Anchor,
        /// Text colour.
        colour: Colour,
    },
}

impl FigureItem {
    /// Returns the item with its letters in the author's fonts `fonts`.
    pub fn in_fonts(mut self, fonts: &Fonts) -> FigureItem {
        if let Shape::Label { label, .. } | Shape::Turned { label, .. } = &mut self.shape
            && label.fonts() != fonts
        {
            *label = label.clone().in_fonts(fonts);
        }
        self
    }

    /// Returns an item without a name.
    pub fn new(class: impl Into<String>, shape: Shape) -> FigureItem {
        FigureItem { id: String::new(), class: class.into(), link: None, shown: None, shape }
    }

    /// Returns the construction steps that draw the item, from its classes `step-N`.
    pub fn steps(&self) -> impl Iterator<Item = usize> {
        self.class.split(' ').filter_map(|word| word.strip_prefix("step-")?.parse().ok())
    }

    /// Sets the quantity that the item shows.
    pub fn showing(mut self, shown: ShownQuantity) -> FigureItem {
        self.shown = Some(Box::new(shown));
        self
    }

    /// Returns the item with a name.
    pub fn with_id(mut self, id: impl Into<String>) -> FigureItem {
        self.id = id.into();
        self
    }
}

/// Puts words before the class of each item, such as the construction step that draws it.
pub fn tag(items: &mut [FigureItem], words: &str) {
    for item in items {
        item.class = format!("{words} {}", item.class).trim_end().to_owned();
    }
}

/// Makes ids unique: the second item with an id gets `-2`, the third `-3`. Items without an id are
/// named after their class.
pub fn distinct(items: &mut [FigureItem]) {
    let mut taken: HashSet<String> = HashSet::new();
    for item in items {
        let base = if item.id.is_empty() {
            item.class.trim().replace([' ', '_'], "-")
        } else {
            std::mem::take(&mut item.id)
        };
        let mut id = base.clone();
        let mut count = 1;
        while !taken.insert(id.clone()) {
            count += 1;
            id = format!("{base}-{count}");
        }
        item.id = id;
    }
}
