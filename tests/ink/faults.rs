//! Ambiguities: parts of a drawing that a reader would misread.

use crate::read::{Box4, Ink, Line, P, Text};

/// Lines of at least this width are main lines; thinner ones are auxiliary.
const THICK_MM: f64 = 0.33;
/// A box that a line only grazes is still legible.
const GRAZE_MM: f64 = 0.3;
/// Two boxes that touch by rounding do not overlap.
const TOUCH_MM2: f64 = 0.01;
/// A name may be nearer to another line by this distance, which the eye does not see.
const NEARER_MM: f64 = 0.15;

/// Two places nearer than this are one: an inset enlarges some ten times at most.
const ONE_MM: f64 = 0.02;

/// Largest distance between the dot of a leader line and its item.
const DOT_MM: f64 = 1.0;

/// Two letters' widths: a number farther away is not read as a factor.
const FACTOR_MM: f64 = 4.0;

#[derive(Default)]
pub struct Faults {
    pub counts: [usize; NAMES.len()],
    pub list: Vec<String>,
    /// Number of leader lines: not a fault, but few are better.
    pub leaders: usize,
}

const NAMES: [&str; 12] = [
    "label on label",
    "label under a thick line",
    "arrow in hatching",
    "hatching on hatching",
    "two names on one mark of an inset",
    "nearer to another line",
    "nearer to another mark",
    "label crossed by a thin line",
    "number behind the name of a rate",
    "angle or leader in hatching",
    "leader through an arc",
    "leader through a label",
];
/// Kinds of fault that must not occur.
const FORBIDDEN: [usize; 11] = [0, 1, 2, 3, 4, 5, 6, 8, 9, 10, 11];
/// Kinds of fault of which one in a number of sheets is accepted: where arcs, links and vectors are
/// many and short, no place is free of them.
const RARE: [usize; 1] = [7];
const ONE_IN: usize = 70;

impl Faults {
    pub fn add(&mut self, other: Faults) {
        self.counts.iter_mut().zip(other.counts).for_each(|(a, b)| *a += b);
        self.list.extend(other.list);
        self.leaders += other.leaders;
    }

    /// True if this number of sheets is legible.
    pub fn can_be_read(&self, sheets: usize) -> bool {
        let sum = |kinds: &[usize]| kinds.iter().map(|k| self.counts[*k]).sum::<usize>();
        sum(&FORBIDDEN) == 0 && sum(&RARE) * ONE_IN <= sheets.max(ONE_IN * 2)
    }

    pub fn table(&self) -> String {
        let faults = NAMES.iter().zip(self.counts).map(|(name, n)| format!("{n:>5}  {name}"));
        faults.chain([format!("{:>5}  leader lines", self.leaders)]).collect::<Vec<_>>().join("\n")
    }

    fn note(&mut self, kind: usize, what: String) {
        self.counts[kind] += 1;
        self.list.push(format!("{}: {what}", NAMES[kind]));
    }
}

pub fn of(ink: &Ink) -> Faults {
    let mut f = Faults::default();
    for (k, a) in ink.texts.iter().enumerate() {
        for b in ink.texts[..k].iter().filter(|b| overlap(a.ink, b.ink) > TOUCH_MM2) {
            f.note(0, format!("{} on {}", a.id, b.id));
        }
        let through = |l: &&Line| {
            let half = l.width_mm / 2.0;
            l.pieces.iter().map(|p| clipped(*p, a.ink, half)).sum::<f64>() > GRAZE_MM
        };
        let drawn = || ink.lines.iter().filter(|l| l.width_mm > 0.0 && !l.class.contains("gap"));
        for l in drawn().filter(|l| l.width_mm >= THICK_MM).filter(through) {
            f.note(1, format!("{} under {}", a.id, l.id));
        }
        for l in drawn().filter(|l| l.width_mm < THICK_MM).filter(through) {
            f.note(7, format!("{} and {}", a.id, l.id));
        }
        if has(&a.class, "inset")
            && let Some(wide) = spread(ink, a)
        {
            f.note(4, format!("{} names places {wide:.4} mm apart", a.id));
        }
    }
    hatchings(ink, &mut f);
    leaders(ink, &mut f);
    factors(ink, &mut f);
    nearest(ink, &mut f);
    f
}

/// Distance between the places that one label names, unless they are one place.
fn spread(ink: &Ink, label: &Text) -> Option<f64> {
    let kind = label.id.split('-').next()?;
    let place = |name: &str| {
        ink.marks.iter().find(|m| m.0 == format!("{kind}-mark-image-{name}")).map(|m| m.1)
    };
    let places: Vec<P> =
        label.text.split(", ").filter_map(|letter| place(&point_of(letter)?)).collect();
    let first = *places.first()?;
    let wide = places.iter().map(|p| (p[0] - first[0]).hypot(p[1] - first[1])).fold(0.0, f64::max);
    // Numbers of the file are rounded to a thousandth of a millimetre.
    (wide > ONE_MM).then_some(wide)
}

/// The name of the point with an image of this letter: `c'` of C, `a_3` of A3. Names that are
/// longer, or have a number, are left out.
fn point_of(letter: &str) -> Option<String> {
    let plain = letter.replace(['{', '}', '_', '\''], "").to_uppercase();
    plain.chars().all(|c| c.is_ascii_alphanumeric()).then_some(plain)
}

fn has(class: &str, word: &str) -> bool {
    class.split_whitespace().any(|w| w == word)
}

fn hatchings(ink: &Ink, f: &mut Faults) {
    let hatches: Vec<&Line> = ink.lines.iter().filter(|l| has(&l.class, "hatch")).collect();
    let crossed =
        |h: &Line, pieces: &[(P, P)]| h.pieces.iter().any(|a| pieces.iter().any(|b| cross(*a, *b)));
    for line in &ink.lines {
        let kind = match line {
            l if has(&l.class, "leader")
                || has(&l.class, "angle") && !has(&l.class, "reference") =>
            {
                9
            }
            l if has(&l.class, "rotation")
                || has(&l.class, "driver") && !has(&l.class, "reference") =>
            {
                2
            }
            _ => continue,
        };
        // The ground's number may point to the hatching, but not through it.
        let pieces = if has(&line.class, "leader") { vec![way(line)] } else { line.pieces.clone() };
        for h in hatches.iter().filter(|h| crossed(h, &pieces)) {
            f.note(kind, format!("{} in {}", line.id, h.id));
        }
    }
    for (k, a) in hatches.iter().enumerate() {
        for b in &hatches[..k] {
            if a.pieces.iter().any(|p| b.pieces.iter().any(|q| cross(*p, *q))) {
                f.note(3, format!("{} on {}", a.id, b.id));
            }
        }
    }
}

/// Leader lines may cross lines, but neither arcs nor texts.
fn leaders(ink: &Ink, f: &mut Faults) {
    let arcs: Vec<&Line> = ink
        .lines
        .iter()
        .filter(|l| {
            has(&l.class, "rotation") || has(&l.class, "angle") && !has(&l.class, "reference")
        })
        .collect();
    for leader in ink.lines.iter().filter(|l| has(&l.class, "leader")) {
        f.leaders += 1;
        let way = way(leader);
        for arc in arcs.iter().filter(|a| a.pieces.iter().any(|p| cross(*p, way))) {
            f.note(10, format!("{} through {}", leader.id, arc.id));
        }
        for text in ink.texts.iter().filter(|t| clipped(way, t.ink, 0.0) > GRAZE_MM) {
            f.note(11, format!("{} through {}", leader.id, text.id));
        }
    }
}

/// A leader line without its dot.
fn way(leader: &Line) -> (P, P) {
    // The straight part comes last, from the dot at the named item.
    let &(dot, end) = leader.pieces.last().expect("a leader line has ink");
    let off = (DOT_MM / (end[0] - dot[0]).hypot(end[1] - dot[1])).min(1.0);
    ([0, 1].map(|k| dot[k] + (end[k] - dot[k]) * off), end)
}

/// A link's number on one line with the name of an angular velocity, and close behind it, is read
/// as its factor.
fn factors(ink: &Ink, f: &mut Faults) {
    let numbers = ink.texts.iter().filter(|t| has(&t.class, "number"));
    for number in numbers {
        let beside = |rate: &&Text| {
            let [a, b] = [number.ink, rate.ink];
            let level = (a.hi[1].min(b.hi[1]) - a.lo[1].max(b.lo[1])) > 0.5 * (a.hi[1] - a.lo[1]);
            level && a.lo[0] > b.hi[0] && a.lo[0] - b.hi[0] < FACTOR_MM
        };
        for rate in ink.texts.iter().filter(|t| has(&t.class, "driver")).filter(beside) {
            f.note(8, format!("{} behind {}", number.id, rate.id));
        }
    }
}

/// A vector's name is nearer to its vector than to any other, a point's letter nearer to its point.
fn nearest(ink: &Ink, f: &mut Faults) {
    let leads = |id: &str| ink.lines.iter().any(|l| l.id == format!("{id}-leader"));
    for text in ink.texts.iter().filter(|t| !leads(&t.id)) {
        let Some((kind, name)) = text.id.split_once("-label-") else { continue };
        if kind == "mechanism" {
            continue;
        }
        let shafts = |l: &&Line| {
            l.width_mm >= THICK_MM
                && l.id.starts_with(kind)
                && (has(&l.class, "edge") || has(&l.class, "absolute"))
        };
        let shafts: Vec<&Line> = ink.lines.iter().filter(shafts).collect();
        let inset = has(&text.class, "inset");
        let own = [
            format!("{kind}-{name}"),
            format!("{kind}-inset-{}", name.trim_start_matches("inset-")),
        ];
        if let Some(own) =
            shafts.iter().find(|l| own.contains(&l.id) && has(&l.class, "inset") == inset)
        {
            // The head is part of the vector.
            let mine = ink
                .lines
                .iter()
                .filter(|l| l.id == own.id)
                .map(|l| apart(text, l))
                .fold(f64::INFINITY, f64::min);
            for other in shafts.iter().filter(|l| l.id != own.id && !along(own, l)) {
                let theirs = apart(text, other);
                if theirs < mine - NEARER_MM {
                    f.note(
                        5,
                        format!(
                            "{} nearer to {} ({theirs:.2} mm, {mine:.2} to its own)",
                            text.id, other.id
                        ),
                    );
                }
            }
        } else if !inset
            && let Some((_, at)) = ink.marks.iter().find(|m| m.0 == format!("{kind}-{name}"))
        {
            let mine = off(text.ink, *at);
            let nearer =
                |m: &&(String, P)| m.0.starts_with(kind) && off(text.ink, m.1) < mine - NEARER_MM;
            for m in ink.marks.iter().filter(nearer) {
                f.note(
                    6,
                    format!(
                        "{} nearer to {} ({:.2} mm, {mine:.2} to its own)",
                        text.id,
                        m.0,
                        off(text.ink, m.1)
                    ),
                );
            }
        }
    }
}

/// True if one vector covers the other: no side then belongs to one of them.
fn along(a: &Line, b: &Line) -> bool {
    let ends = |l: &Line| [l.pieces[0].0, l.pieces[l.pieces.len() - 1].1];
    let covers = |s: &Line, l: &Line| {
        ends(l).iter().all(|p| s.pieces.iter().any(|q| to_piece(*p, *q) < 0.35))
    };
    covers(a, b) || covers(b, a)
}

fn overlap(a: Box4, b: Box4) -> f64 {
    let side = |k: usize| (a.hi[k].min(b.hi[k]) - a.lo[k].max(b.lo[k])).max(0.0);
    side(0) * side(1)
}

fn apart(text: &Text, line: &Line) -> f64 {
    line.pieces.iter().map(|p| box_to_piece(text.ink, *p)).fold(f64::INFINITY, f64::min)
}

fn off(b: Box4, p: P) -> f64 {
    let d = [0, 1].map(|k| (b.lo[k] - p[k]).max(p[k] - b.hi[k]).max(0.0));
    d[0].hypot(d[1])
}

fn box_to_piece(b: Box4, piece: (P, P)) -> f64 {
    if clipped(piece, b, 0.0) > 0.0 {
        return 0.0;
    }
    let corners = [b.lo, b.hi, [b.lo[0], b.hi[1]], [b.hi[0], b.lo[1]]];
    let by_corner = corners.iter().map(|c| to_piece(*c, piece)).fold(f64::INFINITY, f64::min);
    by_corner.min(off(b, piece.0)).min(off(b, piece.1))
}

fn to_piece(p: P, (a, b): (P, P)) -> f64 {
    let d = [b[0] - a[0], b[1] - a[1]];
    let n = d[0] * d[0] + d[1] * d[1];
    let t = if n > 0.0 {
        (((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / n).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (a[0] + d[0] * t - p[0]).hypot(a[1] + d[1] * t - p[1])
}

/// Length of a piece inside a box, by halving.
fn clipped((a, b): (P, P), r: Box4, grown: f64) -> f64 {
    const PARTS: usize = 64;
    let far = |k: usize| a[k].max(b[k]) < r.lo[k] - grown || a[k].min(b[k]) > r.hi[k] + grown;
    if far(0) || far(1) {
        return 0.0;
    }
    let at = |t: f64| [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t];
    let length = (b[0] - a[0]).hypot(b[1] - a[1]);
    // Parts of a tenth of a millimetre.
    let parts = PARTS.max((length * 10.0) as usize);
    let inside = |p: P| (0..2).all(|k| p[k] > r.lo[k] - grown && p[k] < r.hi[k] + grown);
    let hits = (0..parts).filter(|k| inside(at((*k as f64 + 0.5) / parts as f64))).count();
    hits as f64 / parts as f64 * length
}

fn cross((a, b): (P, P), (c, d): (P, P)) -> bool {
    let side = |p: P, q: P, r: P| (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}
