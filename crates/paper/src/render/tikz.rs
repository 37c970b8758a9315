//! A figure as a TikZ picture: lines as paths, labels as formulas in the fonts of the document.
//!
//! The picture needs the packages `tikz`, `amsmath` and `amssymb`. Lengths are in millimetres.

use super::math::tex;
use super::not_finite;
use super::number::mm;
use crate::paper::arrow;
use crate::paper::extent::on_circle;
use crate::paper::item::{
    Anchor, Cap, Colour, Figure, FigureItem, LineStroke, PLACED, PathPiece, Shape,
};
use crate::paper::label::Label;
use crate::paper::text;
use hodograph_base::diag::{Faults, both};
use hodograph_base::geom::Point;
use std::collections::BTreeSet;
use std::fmt::Write as _;

/// TeX points (1/72.27 in) in a millimetre.
const PT_PER_MM: f64 = 72.27 / 25.4;
/// Distance of baselines in sizes of the type.
const LEADING: f64 = 1.2;

/// Returns the picture, an environment `tikzpicture` for `\input`.
///
/// # Errors
/// `not-finite` if a coordinate is not a number.
///
/// ```
/// use hodograph_paper::paper::item::{Colour, Figure, FigureItem, LineStroke, Shape};
/// use hodograph_base::geom::Point;
/// let (from, to) = (Point::new(0.0, 0.0), Point::new(4.0, 3.0));
/// let line = FigureItem::new("", Shape::Line { from, to, stroke: LineStroke::new(0.4) });
/// let figure = Figure { width_mm: 10.0, height_mm: 10.0, title: "A line".into(), desc: String::new(),
///     lang: "en".into(), paper: Colour::WHITE, items: vec![line] };
/// let picture = hodograph_paper::render::tikz::tikz(&figure)?;
/// assert!(picture.contains("\\draw[line width=0.4mm] (0,0) -- (4,3);"));
/// # Ok::<(), hodograph_base::diag::Faults>(())
/// ```
pub fn tikz(figure: &Figure) -> Result<String, Faults> {
    let mut faults = Faults::default();
    for item in figure.items.iter().filter(|item| !item.is_finite()) {
        let name = if item.id.is_empty() { &item.class } else { &item.id };
        faults.push(not_finite(both!("item `{name}` has a coordinate that is not a number")));
    }
    if faults.has_errors() {
        return Err(faults);
    }
    let mut picture = Picture::default();
    let corner = format!("({},{})", mm(figure.width_mm), mm(figure.height_mm));
    if figure.paper != Colour::WHITE {
        let fill = picture.colour(figure.paper);
        picture.line(format!("\\fill[{fill}] (0,0) rectangle {corner};"));
    }
    figure.items.iter().for_each(|item| picture.item(item));
    let title: String = figure.title.chars().filter(|c| !c.is_control()).collect();
    let mut out = format!("% {title}\n% needs \\usepackage{{tikz,amsmath,amssymb}}\n");
    out += "\\begin{tikzpicture}[x=1mm,y=1mm,inner sep=0pt,outer sep=0pt]\n";
    for name in &picture.colours {
        let _ = writeln!(out, "\\definecolor{{hg{name}}}{{HTML}}{{{name}}}");
    }
    let _ = writeln!(out, "\\useasboundingbox (0,0) rectangle {corner};");
    Ok(out + &picture.body + "\\end{tikzpicture}\n")
}

#[derive(Default)]
struct Picture {
    body: String,
    /// The colours other than black, as six hexadecimal digits.
    colours: BTreeSet<String>,
}

impl Picture {
    fn line(&mut self, command: String) {
        self.body += &command;
        self.body.push('\n');
    }

    /// The name of a colour.
    fn colour(&mut self, colour: Colour) -> String {
        if colour == Colour::BLACK {
            return "black".into();
        }
        let name = format!("{:02X}{:02X}{:02X}", colour.r, colour.g, colour.b);
        let used = format!("hg{name}");
        self.colours.insert(name);
        used
    }

    /// The options of a stroke.
    fn stroke(&mut self, stroke: &LineStroke) -> String {
        let mut options = format!("line width={}mm", mm(stroke.width_mm));
        let pattern = stroke.dash.pattern_mm();
        if !pattern.is_empty() {
            options += ",dash pattern=";
            for (k, length) in pattern.iter().enumerate() {
                let word = if k % 2 == 0 { "on" } else { "off" };
                let _ = write!(options, "{}{word} {}mm", if k > 0 { " " } else { "" }, mm(*length));
            }
        }
        if stroke.cap == Cap::Round {
            options += ",line cap=round,line join=round";
        }
        if stroke.colour != Colour::BLACK {
            let _ = write!(options, ",draw={}", self.colour(stroke.colour));
        }
        options
    }

    /// A path with its outline and its fill.
    fn path(&mut self, path: &str, stroke: Option<&LineStroke>, fill: Option<Colour>) {
        let stroke = stroke.map(|s| self.stroke(s));
        let fill = fill.map(|f| self.colour(f));
        match (stroke, fill) {
            (Some(stroke), None) => self.line(format!("\\draw[{stroke}] {path};")),
            (Some(stroke), Some(fill)) => {
                self.line(format!("\\filldraw[{stroke},fill={fill}] {path};"));
            }
            (None, Some(fill)) => self.line(format!("\\fill[{fill}] {path};")),
            (None, None) => {}
        }
    }

    fn arrow(&mut self, shaft: &str, stroke: &LineStroke, head: &[Point]) {
        self.path(shaft, Some(stroke), None);
        if !head.is_empty() {
            self.path(&chain(head, true), None, Some(stroke.colour));
        }
    }

    /// A label; `place` are further options of its node.
    fn node(&mut self, at: Point, place: &str, label: &Label, size_mm: f64, colour: Colour) {
        let size = size_mm * PT_PER_MM;
        let (size, leading) = (mm(size), mm(size * LEADING));
        let mut options = format!("{place},font=\\fontsize{{{size}}}{{{leading}}}\\selectfont");
        if colour != Colour::BLACK {
            let _ = write!(options, ",text={}", self.colour(colour));
        }
        self.line(format!("\\node[{options}] at {} {{${}$}};", point(at), tex(label)));
    }

    fn item(&mut self, item: &FigureItem) {
        match &item.shape {
            Shape::Line { from, to, stroke } => {
                self.path(&chain(&[*from, *to], false), Some(stroke), None);
            }
            Shape::Polyline { points, closed, stroke, fill } => {
                self.path(&chain(points, *closed), stroke.as_ref(), *fill);
            }
            Shape::Path { start, pieces, closed, stroke, fill } => {
                let mut path = point(*start);
                for piece in pieces {
                    path += &match *piece {
                        PathPiece::Move(p) => format!(" {}", point(p)),
                        PathPiece::Line(p) => format!(" -- {}", point(p)),
                        PathPiece::Arc { radius_mm, from_rad, to_rad, .. } => {
                            arc(radius_mm, from_rad, to_rad)
                        }
                    };
                }
                let end = if *closed { " -- cycle" } else { "" };
                self.path(&(path + end), stroke.as_ref(), *fill);
            }
            // A circle without ink is a mark for programs that measure on the drawing.
            Shape::Circle { centre, radius_mm, stroke, fill } => {
                let path = format!("{} circle[radius={}]", point(*centre), mm(*radius_mm));
                self.path(&path, stroke.as_ref(), *fill);
            }
            Shape::Arc { centre, radius_mm, from_rad, to_rad, stroke } => {
                self.path(&whole_arc(*centre, *radius_mm, *from_rad, *to_rad), Some(stroke), None);
            }
            Shape::Arrow { from, to, stroke, head } => {
                let parts = arrow::straight(*from, *to, *head);
                self.arrow(&chain(&[*from, parts.shaft_end], false), stroke, &parts.head);
            }
            Shape::ArcArrow { centre, radius_mm, from_rad, to_rad, stroke, head } => {
                let parts = arrow::bent(*centre, *radius_mm, *from_rad, *to_rad, *head);
                let shaft = whole_arc(*centre, *radius_mm, *from_rad, parts.shaft_end_rad);
                self.arrow(&shaft, stroke, &parts.head);
            }
            Shape::Turned { at, angle_rad, label, size_mm, colour } => {
                let place = format!("anchor=base,rotate={}", mm(angle_rad.to_degrees()));
                self.node(*at, &place, label, *size_mm, *colour);
            }
            Shape::Label { at, label, size_mm, anchor, colour } => {
                // A label among the lines of a drawing keeps its middle in fonts of other widths.
                let placed = item.class.split(' ').next_back() == Some(PLACED);
                let width = text::set(label).width_em * size_mm;
                let (at, place) = match anchor {
                    Anchor::Start if placed => {
                        (Point::new(at.x + width / 2.0, at.y), "anchor=base")
                    }
                    Anchor::Start => (*at, "anchor=base west"),
                    Anchor::Middle => (*at, "anchor=base"),
                    Anchor::End => (*at, "anchor=base east"),
                };
                self.node(at, place, label, *size_mm, *colour);
            }
        }
    }
}

fn point(p: Point) -> String {
    format!("({},{})", mm(p.x), mm(p.y))
}

fn chain(points: &[Point], closed: bool) -> String {
    let mut path = points.iter().map(|p| point(*p)).collect::<Vec<_>>().join(" -- ");
    if closed {
        path += " -- cycle";
    }
    path
}

fn arc(radius_mm: f64, from_rad: f64, to_rad: f64) -> String {
    let [from, to] = [from_rad, to_rad].map(|a| mm(a.to_degrees()));
    format!(" arc[start angle={from},end angle={to},radius={}]", mm(radius_mm))
}

fn whole_arc(centre: Point, radius_mm: f64, from_rad: f64, to_rad: f64) -> String {
    let start = on_circle(centre, radius_mm, from_rad);
    point(start) + &arc(radius_mm, from_rad, to_rad)
}
