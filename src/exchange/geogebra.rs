//! Constructions for GeoGebra: a file .ggb, the archive of `geogebra.xml`.
//!
//! The construction protocol is that of the drawing board, in millimetres: the crank pin is a point
//! of the crank's circle and can be dragged, further joints are crossings of circles and lines about
//! joints placed before. A crossing is chosen by its side of the line between the centres, not by its
//! number, which depends on the program. The velocity polygon depends on the mechanism: from the tip
//! of a known vector perpendicular to the link, as on paper.
//!
//! # Source
//! The reference of the format: *Reference: XML*, and the command names of `geogebra.xml`, in the
//! GeoGebra wiki.

use super::linkage::Linkage;
use super::placing::{PlacedJoint, PlacingRule, order};
use crate::diag::Faults;
use crate::geom::Point;
use crate::render::escaped;
use crate::zip::{ArchiveFile, zip};
use std::fmt::Write as _;

/// Free space beside the mechanism, in parts of its width.
const AIR: f64 = 0.35;

/// Returns the archive.
///
/// # Errors
/// The errors of [`order`].
pub fn ggb(linkage: &Linkage) -> Result<Vec<u8>, Faults> {
    let bytes = xml(linkage)?.into_bytes();
    Ok(zip(&[ArchiveFile { path: "geogebra.xml".into(), bytes }]))
}

/// Returns the construction as XML.
///
/// # Errors
/// The errors of [`order`].
pub fn xml(linkage: &Linkage) -> Result<String, Faults> {
    let placed = order(linkage)?;
    let names = names(linkage);
    let mut p = Protocol { linkage, names: &names, out: String::new() };
    for (j, joint) in linkage.joints.iter().enumerate().filter(|(_, joint)| joint.fixed) {
        p.point(&names[j], joint.at, true);
    }
    for (k, slide) in linkage.slides.iter().enumerate().filter(|(_, s)| s.on.is_none()) {
        let at = linkage.joints[slide.joint].at;
        let [from, to] = [format!("G_{{{}}}", k + 1), format!("H_{{{}}}", k + 1)];
        p.point(&from, at, false);
        p.point(&to, at + slide.direction * 100.0, false);
        p.command("Line", &[&from, &to], &[&format!("g_{{{}}}", k + 1)]);
        p.element("line", &format!("g_{{{}}}", k + 1), true, false);
    }
    for step in &placed {
        p.place(step);
    }
    for (b, body) in linkage.bodies.iter().enumerate() {
        let all: Vec<&str> = body.joints.iter().map(|j| names[*j].as_str()).collect();
        match all[..] {
            [a, c] => p.segment(&format!("s_{{{}}}", b + 1), a, c),
            [_, _, _, ..] => {
                let sides: Vec<String> =
                    (0..all.len()).map(|k| format!("s_{{{},{}}}", b + 1, k + 1)).collect();
                let body = format!("t_{{{}}}", b + 1);
                let out: Vec<&str> = std::iter::once(body.as_str())
                    .chain(sides.iter().map(String::as_str))
                    .collect();
                p.command("Polygon", &all, &out);
                p.element("polygon", &body, true, false);
                sides.iter().for_each(|side| p.element("segment", side, true, false));
            }
            _ => {}
        }
    }
    p.polygon(&placed);
    Ok(document(linkage, &p.out))
}

/// The text around the construction, with a view of the mechanism and its polygon.
fn document(linkage: &Linkage, construction: &str) -> String {
    let (low, high) = extent(linkage);
    let (wide, tall) = (2.2 * (high.x - low.x).max(1.0), 1.6 * (high.y - low.y).max(1.0));
    let pixels = (1000.0 / wide).min(640.0 / tall);
    let zero = [(60.0 - low.x * pixels), 640.0 + low.y * pixels];
    let title = escaped(&linkage.title);
    format!(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<geogebra format=\"5.0\" version=\"5.0.0.0\" app=\"classic\">\n\
         <euclidianView>\n<size width=\"1100\" height=\"700\"/>\n\
         <coordSystem xZero=\"{}\" yZero=\"{}\" scale=\"{pixels}\" yscale=\"{pixels}\"/>\n\
         <evSettings axes=\"false\" grid=\"false\" pointCapturing=\"0\" rightAngleStyle=\"1\"/>\n</euclidianView>\n\
         <kernel>\n<continuous val=\"true\"/>\n<decimals val=\"2\"/>\n<angleUnit val=\"degree\"/>\n</kernel>\n\
         <construction title=\"{title}\" author=\"\" date=\"\">\n{construction}</construction>\n</geogebra>\n",
        zero[0], zero[1]
    )
}

fn extent(linkage: &Linkage) -> (Point, Point) {
    let all = linkage.joints.iter().map(|j| j.at);
    all.fold(
        (
            Point::new(f64::INFINITY, f64::INFINITY),
            Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY),
        ),
        |(low, high), at| {
            (
                Point::new(low.x.min(at.x), low.y.min(at.y)),
                Point::new(high.x.max(at.x), high.y.max(at.y)),
            )
        },
    )
}

/// The construction while it is written.
struct Protocol<'a> {
    linkage: &'a Linkage,
    names: &'a [String],
    out: String,
}

impl Protocol<'_> {
    fn at(&self, joint: usize) -> Point {
        self.linkage.joints[joint].at
    }

    fn element(&mut self, kind: &str, label: &str, shown: bool, named: bool) {
        let _ = writeln!(
            self.out,
            "<element type=\"{kind}\" label=\"{}\">\n<show object=\"{shown}\" label=\"{named}\"/>\n</element>",
            escaped(label)
        );
    }

    /// A point at a place; a point of a path keeps to the path.
    fn point(&mut self, label: &str, at: Point, shown: bool) {
        let _ = writeln!(
            self.out,
            "<element type=\"point\" label=\"{}\">\n<show object=\"{shown}\" label=\"{shown}\"/>\n\
             <coords x=\"{}\" y=\"{}\" z=\"1.0\"/>\n</element>",
            escaped(label),
            at.x,
            at.y
        );
    }

    fn number(&mut self, label: &str, value: f64) {
        let _ = writeln!(
            self.out,
            "<element type=\"numeric\" label=\"{}\">\n<value val=\"{value}\"/>\n\
             <show object=\"false\" label=\"false\"/>\n</element>",
            escaped(label)
        );
    }

    fn command(&mut self, name: &str, from: &[&str], to: &[&str]) {
        let list = |of: &[&str]| -> String {
            of.iter().enumerate().map(|(k, a)| format!(" a{k}=\"{}\"", escaped(a))).collect()
        };
        let (from, to) = (list(from), list(to));
        let _ = writeln!(
            self.out,
            "<command name=\"{name}\">\n<input{from}/>\n<output{to}/>\n</command>"
        );
    }

    fn expression(&mut self, label: &str, kind: &str, of: &str) {
        let _ = writeln!(
            self.out,
            "<expression label=\"{}\" exp=\"{}\" type=\"{kind}\"/>",
            escaped(label),
            escaped(of)
        );
    }

    fn segment(&mut self, label: &str, a: &str, b: &str) {
        self.command("Segment", &[a, b], &[label]);
        self.element("segment", label, true, false);
    }

    /// A circle about a joint through the joint that is placed, by its given length.
    fn circle(&mut self, label: &str, centre: usize, joint: usize) {
        let names = self.names;
        let length = format!("l_{{{}{}}}", plain(&names[centre]), plain(&names[joint]));
        self.number(&length, self.linkage.length(centre, joint));
        self.command("Circle", &[&names[centre], &length], &[label]);
        self.element("conic", label, false, false);
    }

    fn place(&mut self, step: &PlacedJoint) {
        let (j, names) = (step.joint, self.names);
        let name = names[j].as_str();
        let [k, m] = ["k", "m"].map(|letter| format!("{letter}_{{{}}}", plain(name)));
        let at = self.at(j);
        match &step.rule {
            PlacingRule::Crank => {
                self.circle(&k, self.linkage.pivot, j);
                self.command("Point", &[&k], &[name]);
                self.point(name, at, true);
            }
            PlacingRule::Carried { base: [a, b], parts: [along, left] } => {
                let of = carried(&names[*a], &names[*b], [along, left].map(f64::to_string));
                self.expression(name, "point", &of);
                self.point(name, at, true);
            }
            PlacingRule::Slotted { pivot, pin, parts: [along, left] } => {
                let (a, b) = (&names[*pivot], &names[*pin]);
                let d = format!("d_{{{}}}", plain(name));
                self.command("Distance", &[a, b], &[&d]);
                self.element("numeric", &d, false, false);
                let of = carried(a, b, [format!("{along} / {d}"), format!("{left} / {d}")]);
                self.expression(name, "point", &of);
                self.point(name, at, true);
            }
            PlacingRule::Circles { centres: [a, b], left, .. } => {
                self.circle(&k, *a, j);
                self.circle(&m, *b, j);
                let (p, q) = (&names[*a], &names[*b]);
                let sense = if *left { ">" } else { "<" };
                self.chosen(name, [&k, &m], at, |c| {
                    format!(
                        "(x({q}) - x({p})) * (y({c}) - y({p})) - (y({q}) - y({p})) * (x({c}) - x({p})) {sense} 0"
                    )
                });
            }
            PlacingRule::OnLine { centre, slide, ahead, .. } => {
                self.circle(&k, *centre, j);
                let [line, g, h] = ["g", "G", "H"].map(|l| format!("{l}_{{{}}}", slide + 1));
                let (p, sense) = (&names[*centre], if *ahead { ">" } else { "<" });
                self.chosen(name, [&k, &line], at, |c| {
                    format!(
                        "(x({h}) - x({g})) * (x({c}) - x({p})) + (y({h}) - y({g})) * (y({c}) - y({p})) {sense} 0"
                    )
                });
            }
        }
    }

    /// The crossing of two lines that fulfils a condition.
    fn chosen(
        &mut self,
        name: &str,
        lines: [&str; 2],
        at: Point,
        condition: impl Fn(&str) -> String,
    ) {
        let [one, two] = ["1", "2"].map(|k| format!("X_{{{},{k}}}", plain(name)));
        self.command("Intersect", &lines, &[&one, &two]);
        self.point(&one, at, false);
        self.point(&two, at, false);
        self.command("If", &[&condition(&one), &one, &two], &[name]);
        self.point(name, at, true);
    }

    /// The velocity polygon: pole, tips, vectors.
    fn polygon(&mut self, placed: &[PlacedJoint]) {
        let (names, linkage) = (self.names, self.linkage);
        let (low, high) = extent(linkage);
        let (wide, radius) = (
            (high.x - low.x).max(high.y - low.y).max(1.0),
            placed.first().map_or(1.0, |p| linkage.length(linkage.pivot, p.joint)),
        );
        let scale = 0.5 * wide / (radius * linkage.rate.abs()).max(f64::MIN_POSITIVE);
        let pole = "p_{0}";
        let at = Point::new(high.x + AIR * wide, (low.y + high.y) / 2.0);
        self.number("ω", linkage.rate);
        self.number("k", scale);
        self.point(pole, at, true);
        let tip = |j: usize| match linkage.joints[j].fixed {
            true => pole.to_owned(),
            false => format!("p_{{{}}}", plain(&names[j])),
        };
        for PlacedJoint { joint: j, rule } in placed {
            let name = tip(*j);
            let helper = |letter: &str| format!("{letter}_{{p,{}}}", plain(&names[*j]));
            match rule {
                PlacingRule::Crank => {
                    let (a, b) = (&names[linkage.pivot], &names[*j]);
                    let of = format!("{pole} + k * ω * (y({a}) - y({b}), x({b}) - x({a}))");
                    self.expression(&name, "point", &of);
                }
                PlacingRule::Carried { base: [a, b], parts } => {
                    let of = carried(&tip(*a), &tip(*b), parts.map(|p| p.to_string()));
                    self.expression(&name, "point", &of);
                }
                // The point of the lever under the pin, then the image of the lever.
                PlacingRule::Slotted { pivot, pin, parts } => {
                    let [bar, line, along, under] = ["ns", "n", "o", "q"].map(helper);
                    self.command("Segment", &[&names[*pivot], &names[*pin]], &[&bar]);
                    self.element("segment", &bar, false, false);
                    self.command("OrthogonalLine", &[&tip(*pivot), &bar], &[&line]);
                    self.element("line", &line, false, false);
                    self.command("Line", &[&tip(*pin), &bar], &[&along]);
                    self.element("line", &along, false, false);
                    self.command("Intersect", &[&line, &along], &[&under]);
                    self.point(&under, at, false);
                    let d = format!("d_{{{}}}", plain(&names[*j]));
                    let of = carried(&tip(*pivot), &under, parts.map(|p| format!("{p} / {d}")));
                    self.expression(&name, "point", &of);
                }
                PlacingRule::Circles { centres, .. } => {
                    let lines = [(centres[0], "n"), (centres[1], "o")].map(|(centre, letter)| {
                        let (bar, line) = (helper(&format!("{letter}s")), helper(letter));
                        self.command("Segment", &[&names[centre], &names[*j]], &[&bar]);
                        self.element("segment", &bar, false, false);
                        self.command("OrthogonalLine", &[&tip(centre), &bar], &[&line]);
                        self.element("line", &line, false, false);
                        line
                    });
                    self.command("Intersect", &[&lines[0], &lines[1]], &[&name]);
                }
                PlacingRule::OnLine { centre, slide, .. } => {
                    let [bar, line, along] = ["ns", "n", "o"].map(helper);
                    self.command("Segment", &[&names[*centre], &names[*j]], &[&bar]);
                    self.element("segment", &bar, false, false);
                    self.command("OrthogonalLine", &[&tip(*centre), &bar], &[&line]);
                    self.element("line", &line, false, false);
                    self.command("Line", &[pole, &format!("g_{{{}}}", slide + 1)], &[&along]);
                    self.element("line", &along, false, false);
                    self.command("Intersect", &[&line, &along], &[&name]);
                }
            }
            self.point(&name, at, false);
            let vector = format!("v_{{{}}}", plain(&names[*j]));
            self.command("Vector", &[pole, &name], &[&vector]);
            self.element("vector", &vector, true, true);
        }
    }
}

/// The expression of a point fixed to two others.
fn carried(a: &str, b: &str, [along, left]: [String; 2]) -> String {
    format!(
        "{a} + ({along}) * (x({b}) - x({a}), y({b}) - y({a})) + ({left}) * (y({a}) - y({b}), x({b}) - x({a}))"
    )
}

/// The names of the joints as labels: a letter, then an index.
fn names(linkage: &Linkage) -> Vec<String> {
    let label = |name: &str| {
        let letters: String = name.chars().take_while(|c| c.is_alphabetic()).collect();
        let rest: String =
            name[letters.len()..].chars().filter(|c| c.is_alphanumeric() || *c == '\'').collect();
        let letters = if letters.is_empty() { "P".to_owned() } else { letters };
        if rest.is_empty() { letters } else { format!("{letters}_{{{rest}}}") }
    };
    linkage.joints.iter().map(|j| label(&j.name)).collect()
}

/// A label without its marks, for the index of another.
fn plain(label: &str) -> String {
    label.chars().filter(|c| !matches!(c, '_' | '{' | '}')).collect()
}
