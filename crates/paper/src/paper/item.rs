//! The display list: what is on the paper, in millimetres, x to the right and **y up**.
//!
//! Decided here: nothing about looks. An item is finished: its writer needs no style, no scene and no solution.
//! Items are drawn in the order of the list. Only the SVG writer turns y over.

use hodograph_base::diag::{Diagnostic, both};
use hodograph_base::geom::Point;
use std::collections::HashSet;

use super::arrow::Head;
use super::font::own::Fonts;
use super::label::Label;
use super::shown::Shown;

/// A drawing on a sheet.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Width of the paper.
    pub width_mm: f64,
    /// Height of the paper.
    pub height_mm: f64,
    /// A title for readers who do not see the figure.
    pub title: String,
    /// What the figure shows, in words.
    pub desc: String,
    /// Language tag of title and description, such as `en` or `zh`.
    pub lang: String,
    /// Colour of the paper; any but white is painted.
    pub paper: Colour,
    /// What is drawn, from back to front.
    pub items: Vec<Item>,
}

impl Figure {
    /// Labels for which a place was searched among the lines of a drawing; captions, tables and results have theirs given.
    pub fn labels_placed(&self) -> usize {
        let placed = |i: &&Item| matches!(i.shape, Shape::Label { .. }) && i.class.split(' ').next_back() == Some(PLACED);
        self.items.iter().filter(placed).count()
    }

    /// What the reader of the figure should know of how it was made: that its labels were too many for a careful search.
    pub fn remarks(&self) -> Vec<Diagnostic> {
        let coarse = |i: &&Item| i.class.rsplit(' ').nth(1) == Some(COARSE);
        let count = self.items.iter().filter(coarse).count();
        let message = both!(
            "{count} labels are more than can be weighed against one another: each took the best place that was left",
            "{count} 个标注过多，不能统一优化：各取所余的最佳位置"
        );
        let help = both!(
            "draw fewer points, or ask for less in \"find\"; --figure draws one part alone",
            "请少画一些点，或在 \"find\" 中少求一些；--figure 可只画一部分"
        );
        (count > 0).then(|| Diagnostic::note("coarse-labels", message).help(help)).into_iter().collect()
    }
}

/// The last word of the class of every label that was placed by search.
pub const PLACED: &str = "label";

/// The word before it where there were so many that they were placed one after the other.
pub const COARSE: &str = "coarse";

/// One element of a figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// A name unique in the figure; may be empty.
    pub id: String,
    /// Stable words for step-by-step reveal, such as `velocity edge unknown`; may be empty.
    pub class: String,
    /// The link that it belongs to, by its place in the scene: styles may colour it.
    pub link: Option<usize>,
    /// The quantity that it shows, of vectors and marks.
    pub shown: Option<Box<Shown>>,
    /// What is drawn.
    pub shape: Shape,
}

/// A colour of the ink.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Colour {
    /// Red.
    pub r: u8,
    /// Green.
    pub g: u8,
    /// Blue.
    pub b: u8,
}

impl Colour {
    /// Black ink.
    pub const BLACK: Colour = Colour::grey(0);
    /// Paper.
    pub const WHITE: Colour = Colour::grey(255);

    /// A grey: 0 black, 255 white.
    pub const fn grey(level: u8) -> Colour {
        Colour { r: level, g: level, b: level }
    }

    /// The colour with these components.
    pub const fn rgb(r: u8, g: u8, b: u8) -> Colour {
        Colour { r, g, b }
    }
}

/// The pattern of a line (ISO 128-2 names).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Dash {
    /// Continuous.
    #[default]
    Solid,
    /// Dashed: hidden edges, directions laid off before their length is known.
    Dashed,
    /// Long dash, dot: centre lines and paths.
    DashDot,
    /// Dotted.
    Dotted,
}

impl Dash {
    /// Lengths of strokes and gaps in mm; empty for a continuous line.
    pub const fn pattern_mm(self) -> &'static [f64] {
        match self {
            Dash::Solid => &[],
            Dash::Dashed => &[1.4, 0.8],
            Dash::DashDot => &[4.0, 0.8, 0.4, 0.8],
            Dash::Dotted => &[0.3, 0.7],
        }
    }
}

/// How a line ends and turns.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Cap {
    /// Cut off at its end, mitred corners.
    #[default]
    Butt,
    /// Round ends and corners: links.
    Round,
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// Width of the line.
    pub width_mm: f64,
    /// Its pattern.
    pub dash: Dash,
    /// Its ends.
    pub cap: Cap,
    /// Its colour.
    pub colour: Colour,
}

impl Stroke {
    /// A continuous black line with cut ends.
    pub const fn new(width_mm: f64) -> Stroke {
        Stroke { width_mm, dash: Dash::Solid, cap: Cap::Butt, colour: Colour::BLACK }
    }

    /// The same with a pattern.
    pub const fn dashed(self, dash: Dash) -> Stroke {
        Stroke { dash, ..self }
    }

    /// The same with round ends.
    pub const fn round(self) -> Stroke {
        Stroke { cap: Cap::Round, ..self }
    }

    /// The same with cut ends.
    pub const fn flat(self) -> Stroke {
        Stroke { cap: Cap::Butt, ..self }
    }

    /// The same in another colour.
    pub const fn coloured(self, colour: Colour) -> Stroke {
        Stroke { colour, ..self }
    }
}

/// Which point of a label's line is meant, from left to right.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
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
pub enum Piece {
    /// Begins anew elsewhere, as between the strokes of a hatching.
    Move(Point),
    /// A straight line to the point.
    Line(Point),
    /// An arc that begins where the path is and ends at `centre` + radius · (cos `to_rad`, sin `to_rad`);
    /// counter-clockwise when `to_rad` > `from_rad`.
    Arc {
        /// Centre of the arc.
        centre: Point,
        /// Its radius.
        radius_mm: f64,
        /// Angle of its beginning.
        from_rad: f64,
        /// Angle of its end.
        to_rad: f64,
    },
}

/// What is drawn.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Shape {
    /// A straight line.
    Line {
        /// Beginning.
        from: Point,
        /// End.
        to: Point,
        /// How it is drawn.
        stroke: Stroke,
    },
    /// A chain of straight lines, or a polygon.
    Polyline {
        /// Its corners.
        points: Vec<Point>,
        /// Whether the last corner is joined to the first.
        closed: bool,
        /// Its line, if any.
        stroke: Option<Stroke>,
        /// Its area's colour, if any.
        fill: Option<Colour>,
    },
    /// Lines and arcs in one stroke.
    Path {
        /// Where it begins.
        start: Point,
        /// What follows.
        pieces: Vec<Piece>,
        /// Whether it is closed.
        closed: bool,
        /// Its line, if any.
        stroke: Option<Stroke>,
        /// Its area's colour, if any.
        fill: Option<Colour>,
    },
    /// A circle or disc.
    Circle {
        /// Centre.
        centre: Point,
        /// Radius.
        radius_mm: f64,
        /// Its line, if any.
        stroke: Option<Stroke>,
        /// Its area's colour, if any.
        fill: Option<Colour>,
    },
    /// A piece of a circle, counter-clockwise when `to_rad` > `from_rad`.
    Arc {
        /// Centre.
        centre: Point,
        /// Radius.
        radius_mm: f64,
        /// Angle of its beginning, counter-clockwise from x.
        from_rad: f64,
        /// Angle of its end.
        to_rad: f64,
        /// How it is drawn.
        stroke: Stroke,
    },
    /// A vector; its head is at `to`.
    Arrow {
        /// Tail.
        from: Point,
        /// Tip.
        to: Point,
        /// Its shaft.
        stroke: Stroke,
        /// Its head.
        head: Head,
    },
    /// A bent arrow, with its head at `to_rad`; counter-clockwise when `to_rad` > `from_rad`.
    ArcArrow {
        /// Centre.
        centre: Point,
        /// Radius.
        radius_mm: f64,
        /// Angle of the tail.
        from_rad: f64,
        /// Angle of the tip.
        to_rad: f64,
        /// Its shaft.
        stroke: Stroke,
        /// Its head.
        head: Head,
    },
    /// A label in one line that is turned about its anchor, the middle of its baseline, as the numbers of dimensions are.
    Turned {
        /// The anchor's place.
        at: Point,
        /// The direction of reading.
        angle_rad: f64,
        /// What is written.
        label: Label,
        /// Size of the type (its em).
        size_mm: f64,
        /// Its colour.
        colour: Colour,
    },
    /// A label in one line.
    Label {
        /// The anchor's place on the baseline.
        at: Point,
        /// What is written.
        label: Label,
        /// Size of the type (its em).
        size_mm: f64,
        /// Which point of the line stands at `at`.
        anchor: Anchor,
        /// Its colour.
        colour: Colour,
    },
}

impl Item {
    /// The same with its letters in these fonts of the author's.
    pub fn in_fonts(mut self, fonts: &Fonts) -> Item {
        if let Shape::Label { label, .. } | Shape::Turned { label, .. } = &mut self.shape
            && label.fonts() != fonts
        {
            *label = label.clone().in_fonts(fonts);
        }
        self
    }

    /// An item without a name.
    pub fn new(class: impl Into<String>, shape: Shape) -> Item {
        Item { id: String::new(), class: class.into(), link: None, shown: None, shape }
    }

    /// The steps of the construction that draw it, by their classes `step-N`.
    pub fn steps(&self) -> impl Iterator<Item = usize> {
        self.class.split(' ').filter_map(|word| word.strip_prefix("step-")?.parse().ok())
    }

    /// Sets the quantity that the item shows.
    pub fn showing(mut self, shown: Shown) -> Item {
        self.shown = Some(Box::new(shown));
        self
    }

    /// The same with a name.
    pub fn with_id(mut self, id: impl Into<String>) -> Item {
        self.id = id.into();
        self
    }
}

/// Puts words before the class of each item, such as the step that brings it.
pub fn tag(items: &mut [Item], words: &str) {
    for item in items {
        item.class = format!("{words} {}", item.class).trim_end().to_owned();
    }
}

/// Makes ids unique: a second item of an id gets `-2`, a third `-3`. Items without one are named after their class.
pub fn distinct(items: &mut [Item]) {
    let mut taken: HashSet<String> = HashSet::new();
    for item in items {
        let base = if item.id.is_empty() { item.class.trim().replace([' ', '_'], "-") } else { std::mem::take(&mut item.id) };
        let mut id = base.clone();
        let mut count = 1;
        while !taken.insert(id.clone()) {
            count += 1;
            id = format!("{base}-{count}");
        }
        item.id = id;
    }
}
