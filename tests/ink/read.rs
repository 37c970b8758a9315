//! The ink of a written SVG in millimetres, y down: boxes of letters, straight pieces of lines.

use std::collections::HashMap;

use resvg::tiny_skia::{PathSegment, Point as Dot};
use resvg::usvg::{Group, Node, Options, Path, Tree};

/// usvg's pixels per millimetre.
const PX_PER_MM: f64 = 96.0 / 25.4;
/// Least number of straight pieces of a curve.
const PIECES: usize = 12;
/// This number of pieces times the root of a curve's extent (mm) keeps a quarter of a circle within
/// 0.04 mm of its chords.
const FINE: f64 = 2.8;

pub type P = [f64; 2];

/// A box: left, top, right, bottom.
#[derive(Clone, Copy, Debug)]
pub struct Box4 {
    pub lo: P,
    pub hi: P,
}

/// A label.
pub struct Text {
    pub id: String,
    pub class: String,
    pub text: String,
    pub ink: Box4,
}

/// A drawn item other than a label.
pub struct Line {
    pub id: String,
    pub class: String,
    pub width_mm: f64,
    pub pieces: Vec<(P, P)>,
}

#[derive(Default)]
pub struct Ink {
    pub texts: Vec<Text>,
    pub lines: Vec<Line>,
    /// Named places without ink.
    pub marks: Vec<(String, P)>,
}

/// Class, text and place by id.
type Told = HashMap<String, (String, String)>;

pub fn read(svg: &str) -> Ink {
    let document = roxmltree::Document::parse(svg).unwrap();
    let mut told = Told::new();
    let mut ink = Ink::default();
    for node in document.descendants().filter(|n| n.is_element()) {
        let Some(id) = node.attribute("id") else { continue };
        let of = |name: &str| node.attribute(name).unwrap_or_default().to_owned();
        if of("class").ends_with(" mark") {
            ink.marks.push((id.into(), [of("cx").parse().unwrap(), of("cy").parse().unwrap()]));
        }
        told.insert(id.into(), (of("class"), of("data-text")));
    }
    let tree = Tree::from_str(svg, &Options::default()).unwrap();
    group(tree.root(), &told, "", &mut ink);
    ink
}

fn group(g: &Group, told: &Told, named: &str, ink: &mut Ink) {
    let named = if g.id().is_empty() { named } else { g.id() };
    if let Some((class, text)) = told.get(named).filter(|t| !t.1.is_empty()) {
        let b = g.abs_bounding_box();
        let mm = |v: f32| f64::from(v) / PX_PER_MM;
        let ink_box = Box4 { lo: [mm(b.left()), mm(b.top())], hi: [mm(b.right()), mm(b.bottom())] };
        ink.texts.push(Text {
            id: named.into(),
            class: class.clone(),
            text: text.clone(),
            ink: ink_box,
        });
        return;
    }
    for child in g.children() {
        match child {
            Node::Group(g) => group(g, told, named, ink),
            Node::Path(p) => ink.lines.push(line(p, told, named)),
            Node::Image(_) | Node::Text(_) => panic!("a figure has outlines only"),
        }
    }
}

fn line(path: &Path, told: &Told, named: &str) -> Line {
    let id = if path.id().is_empty() { named } else { path.id() };
    let class = told.get(id).map(|t| t.0.clone()).unwrap_or_default();
    let scale = path.abs_transform().sx.hypot(path.abs_transform().ky);
    let width_mm = path.stroke().map_or(0.0, |s| f64::from(s.width().get() * scale) / PX_PER_MM);
    let data = path.data().clone().transform(path.abs_transform()).expect("finite");
    let mm = |p: Dot| [f64::from(p.x) / PX_PER_MM, f64::from(p.y) / PX_PER_MM];
    let (mut pieces, mut here, mut begin) = (Vec::new(), [0.0; 2], [0.0; 2]);
    for s in data.segments() {
        let curve = |points: [P; 4]| {
            let reach = (points[3][0] - points[0][0]).hypot(points[3][1] - points[0][1]);
            let pieces = PIECES.max((FINE * reach.sqrt()).ceil() as usize);
            (1..=pieces).map(move |k| bezier(points, k as f64 / pieces as f64))
        };
        let ends: Vec<P> = match s {
            PathSegment::MoveTo(p) => {
                (here, begin) = (mm(p), mm(p));
                continue;
            }
            PathSegment::LineTo(p) => vec![mm(p)],
            PathSegment::QuadTo(c, p) => {
                let (c, p) = (mm(c), mm(p));
                let third = |a: P| [(a[0] + 2.0 * c[0]) / 3.0, (a[1] + 2.0 * c[1]) / 3.0];
                curve([here, third(here), third(p), p]).collect()
            }
            PathSegment::CubicTo(a, b, p) => curve([here, mm(a), mm(b), mm(p)]).collect(),
            PathSegment::Close => vec![begin],
        };
        for end in ends {
            pieces.push((here, end));
            here = end;
        }
    }
    Line { id: id.into(), class, width_mm, pieces }
}

fn bezier([a, b, c, d]: [P; 4], t: f64) -> P {
    let s = 1.0 - t;
    [0, 1].map(|k| {
        s * s * s * a[k] + 3.0 * s * s * t * b[k] + 3.0 * s * t * t * c[k] + t * t * t * d[k]
    })
}
