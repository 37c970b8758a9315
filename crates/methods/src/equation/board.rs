//! The drawing of a vector equation: the known vectors laid off from one pole, the two sides of the
//! equation each as a chain; then lines of known direction and arcs of known radius, whose
//! crossings close the polygon.
//!
//! Lengths are laid off in millimetres, crossings are those of ruler and compasses, and the answers
//! are measured. Nothing here is shared with [`super::solve`].

use super::{EquationCase, VectorEquation, VectorTerm};
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::digits::significant;
use hodograph_base::geom::{Point, Vec2, cross_lines};
use hodograph_base::lang::each;
use hodograph_base::number::{Big, Real, within};
use hodograph_board::construct::scale::{extent, fitted};
use hodograph_mechanism::position::kernel::crossing;
use hodograph_scene::DiagramKind;

/// The space for the polygon (mm).
const ROOM_MM: [f64; 2] = [110.0, 90.0];
/// Bits in which the given numbers are evaluated before they are rounded.
const BITS: usize = 256;
/// Extension of a line of known direction beyond its marks (mm).
const BEYOND_MM: f64 = 9.0;
/// Extension of an arc beyond its marks (mm).
const SWING_MM: f64 = 7.0;
/// Line and circle, or two circles, that miss one another by no more than this part of a radius are
/// drawn as touching: the rounding of double precision.
const TOUCH: f64 = 1e-12;

/// The drawing of an equation; all coordinates in mm, the pole at the origin.
#[derive(Clone, Debug, PartialEq)]
pub struct EquationDrawing {
    /// The diagram.
    pub on: DiagramKind,
    /// The scale (SI per mm).
    pub mu: f64,
    /// The steps, one sentence each.
    pub steps: Vec<Both>,
    /// The vectors.
    pub arrows: Vec<EquationArrow>,
    /// Lines of known direction and arcs of known radius.
    pub loci: Vec<(EquationLocus, usize)>,
    /// The marks; the first is the pole.
    pub marks: Vec<EquationMark>,
    /// The measured vectors, solution after solution.
    pub readings: Vec<EquationReading>,
}

/// A drawn vector.
#[derive(Clone, Debug, PartialEq)]
pub struct EquationArrow {
    /// The index of the vector.
    pub term: usize,
    /// The solution that it belongs to; `None` for a known vector.
    pub root: Option<usize>,
    /// The tail.
    pub from: Point,
    /// The tip.
    pub to: Point,
    /// The index of its step.
    pub step: usize,
}

/// A place that a mark must be on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EquationLocus {
    /// A line, from end to end.
    Line(Point, Point),
    /// An arc: centre, radius, first and last angle (rad, counter-clockwise).
    Arc(Point, f64, [f64; 2]),
}

/// A mark on the paper.
#[derive(Clone, Debug, PartialEq)]
pub struct EquationMark {
    /// Its name in the label language; the pole has none.
    pub name: String,
    /// The place.
    pub at: Point,
    /// The index of its step.
    pub step: usize,
}

/// The letter of the start of a diagram without a pole.
pub const START: &str = "O";

impl EquationMark {
    /// Returns its name in a sentence about a diagram.
    fn words(&self, on: DiagramKind) -> Both {
        match self.name.as_str() {
            "" if DiagramKind::POLYGONS.contains(&on) => both!("the pole"),
            "" => spaced(&format!("${START}$")),
            name => spaced(&format!("${name}$")),
        }
    }
}

/// A measured vector.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EquationReading {
    /// The index of the vector.
    pub term: usize,
    /// The solution.
    pub root: usize,
    /// The vector on paper (mm).
    pub on_paper: Vec2,
}

impl EquationDrawing {
    /// Returns the reading of a vector in a solution (SI). Where the drawing has fewer crossings
    /// than solutions, two of them coincide on paper.
    pub fn read(&self, term: usize, root: usize) -> Option<Vec2> {
        let last = self.readings.iter().rfind(|r| r.term == term && r.root <= root);
        last.map(|r| r.on_paper * self.mu)
    }
}

/// The given data of a vector: magnitude (SI) and unit vector.
type TermData = (Option<f64>, Option<Vec2>);

/// Draws an equation to a round scale, or to that of the file.
///
/// # Errors
/// `equation-unknowns`; quantities without a value.
pub fn draw(problem: &VectorEquation) -> Result<EquationDrawing, Diagnostic> {
    let case = EquationCase::of(&problem.terms)?;
    let data = |t: &VectorTerm| -> Result<TermData, Diagnostic> {
        let (size, unit) = within(BITS, || {
            Ok::<_, Diagnostic>((
                t.size::<Big>()?.map(Real::approx),
                t.unit::<Big>()?.map(|u| u.approx()),
            ))
        })?;
        Ok((size, unit))
    };
    let given = problem.terms.iter().map(data).collect::<Result<Vec<_>, _>>()?;
    // A first drawing, a millimetre for each unit, gives the size.
    let first = EquationBoard::drawn(problem, case, &given, 1.0);
    let size = extent(first.marks.iter().map(|m| m.at));
    let mu = fitted(&problem.paper, problem.on.kind(), size, ROOM_MM);
    Ok(EquationBoard::drawn(problem, case, &given, mu))
}

/// The paper while it is drawn on.
struct EquationBoard<'a> {
    problem: &'a VectorEquation,
    given: &'a [TermData],
    out: EquationDrawing,
}

impl EquationBoard<'_> {
    fn drawn(
        problem: &VectorEquation,
        case: EquationCase,
        given: &[TermData],
        mu: f64,
    ) -> EquationDrawing {
        let pole = EquationMark { name: String::new(), at: Point::ORIGIN, step: 0 };
        let out = EquationDrawing {
            on: problem.on,
            mu,
            steps: Vec::new(),
            arrows: Vec::new(),
            loci: Vec::new(),
            marks: vec![pole],
            readings: Vec::new(),
        };
        let mut board = EquationBoard { problem, given, out };
        let ends = [false, true].map(|left| board.chain(left));
        board.close(case, ends);
        board.out.steps = board.out.steps.into_iter().map(|s| closed_up(s).sentence()).collect();
        board.out
    }

    fn symbol(&self, term: usize) -> String {
        format!("${}$", self.problem.terms[term].symbol(0))
    }

    /// Opening of the compasses for a known magnitude (mm).
    fn opening(&self, term: usize) -> f64 {
        self.given[term].0.unwrap_or(0.0) / self.out.mu
    }

    /// A known direction in words: `⊥ AB`, `at 30°`.
    fn along(&self, term: usize) -> Both {
        match self.problem.terms[term]
            .direction
            .as_ref()
            .and_then(|d| d.line.as_ref().zip(Some(d.across)))
        {
            Some((line, across)) => Both::same(format!("{}{line}", if across { "⊥" } else { "∥" })),
            None => {
                both!("at {}°", degrees(self.given[term].1.unwrap_or(Vec2::ZERO)))
            }
        }
    }

    fn mark(&mut self, name: String, at: Point) -> usize {
        self.out.marks.push(EquationMark { name, at, step: self.out.steps.len() });
        self.out.marks.len() - 1
    }

    /// The next letter: a, b, c, without those of poles and crossings.
    fn letter(&self) -> String {
        let free = ('a'..='z').filter(|c| !matches!(c, 'm' | 'o' | 'p'));
        let used = self.out.marks.len() - 1;
        let letter = free.clone().nth(used).unwrap_or('z');
        format!("{letter}{}", self.out.on.prime())
    }

    /// Lays off the known vectors of one side from the pole; returns the mark of their end.
    fn chain(&mut self, left: bool) -> usize {
        let mut end = 0;
        for (k, term) in self.problem.terms.iter().enumerate() {
            let (Some(_), Some(unit)) = self.given[k] else { continue };
            if term.left != left {
                continue;
            }
            let length = self.opening(k);
            let (from, letter) = (self.out.marks[end].clone(), self.letter());
            let to = from.at + unit * length;
            let text = both!(
                "From {} lay off {}, {} mm {}, which gives ${letter}$",
                from.words(self.problem.on),
                self.symbol(k),
                mm(length),
                self.along(k)
            );
            end = self.mark(letter, to);
            self.arrow(k, None, from.at, to);
            self.out.steps.push(text);
        }
        end
    }

    fn arrow(&mut self, term: usize, root: Option<usize>, from: Point, to: Point) {
        let step = self.out.steps.len();
        self.out.arrows.push(EquationArrow { term, root, from, to, step });
    }

    /// Closes the polygon between the ends of the right and the left chain.
    fn close(&mut self, case: EquationCase, [right, left]: [usize; 2]) {
        let terms = &self.problem.terms;
        let wanted = case.vectors();
        let x = wanted[0];
        let [from, to] = if terms[x].left { [left, right] } else { [right, left] };
        let [p, q] = [from, to].map(|k| self.out.marks[k].clone());
        let Some(&y) = wanted.get(1) else {
            self.out.steps.push(both!(
                "Both sides of the equation end at one mark: {} closes the polygon from {} to {}",
                self.symbol(x),
                p.words(self.problem.on),
                q.words(self.problem.on)
            ));
            let step = self.out.steps.len() - 1;
            self.out.arrows.push(EquationArrow {
                term: x,
                root: Some(0),
                from: p.at,
                to: q.at,
                step,
            });
            self.read(0, &[(x, q.at - p.at)]);
            return;
        };
        let meets = match case {
            EquationCase::Vector(_) => Vec::new(),
            EquationCase::Magnitudes(_) => {
                let [u, w] = [x, y].map(|k| self.given[k].1.unwrap_or(Vec2::ZERO));
                vec![cross_lines(p.at, u, q.at, w).at]
            }
            EquationCase::Directions(_) => arcs(p.at, self.opening(x), q.at, self.opening(y)),
            EquationCase::Mixed { .. } => {
                cut(p.at, self.given[x].1.unwrap_or(Vec2::ZERO), q.at, self.opening(y))
            }
        };
        let meets: Vec<Point> = meets.into_iter().filter(|m| m.is_finite()).collect();
        self.locus(x, &p, &meets);
        self.locus(y, &q, &meets);
        self.crossings(case, &p, &q, &meets);
    }

    /// Draws the line or the arc of a vector with an unknown, from the mark where its chain ends.
    fn locus(&mut self, term: usize, at: &EquationMark, meets: &[Point]) {
        let step = self.out.steps.len();
        let symbol = self.symbol(term);
        match self.given[term] {
            (None, Some(u)) => {
                let reach = meets.iter().map(|m| u.dot(*m - at.at));
                let (low, high) = reach.fold((0.0_f64, 0.0_f64), |(l, h), s| (l.min(s), h.max(s)));
                let line = EquationLocus::Line(
                    at.at + u * (low - BEYOND_MM),
                    at.at + u * (high + BEYOND_MM),
                );
                self.out.loci.push((line, step));
                self.out.steps.push(both!(
                    "Through {} draw the direction of {symbol}, {}",
                    at.words(self.problem.on),
                    self.along(term)
                ));
            }
            (Some(_), _) | (None, None) => {
                let radius = self.opening(term);
                self.out.loci.extend(arc(at.at, radius, meets).map(|a| (a, step)));
                self.out.steps.push(both!(
                    "About {} strike an arc with the length of {symbol}, {} mm, as radius",
                    at.words(self.problem.on),
                    mm(radius)
                ));
            }
        }
    }

    /// Marks the crossings, draws the vectors to them, and measures.
    fn crossings(
        &mut self,
        case: EquationCase,
        p: &EquationMark,
        q: &EquationMark,
        meets: &[Point],
    ) {
        let wanted = case.vectors();
        let (x, y) = (wanted[0], wanted[1]);
        let same_side = self.problem.terms[x].left == self.problem.terms[y].left;
        let prime = self.out.on.prime();
        let names: Vec<String> = match meets {
            [_] => vec![format!("m{prime}")],
            _ => (1..=meets.len()).map(|k| format!("m{prime}_{k}")).collect(),
        };
        let letters: Vec<Both> = names.iter().map(|n| spaced(&format!("${n}$"))).collect();
        let list = Both::listed(&letters);
        let [a, b] = [x, y].map(|k| self.symbol(k));
        let met = match case {
            EquationCase::Magnitudes(_) | EquationCase::Vector(_) => {
                both!("The lines intersect at {}", list)
            }
            EquationCase::Directions(_) => both!("The arcs intersect at {}", list),
            EquationCase::Mixed { .. } => {
                both!("Line and arc intersect at {}", list)
            }
        };
        let ends = |from: &Both, to: &Both| both!("from {} to {}", from, to);
        let [and, or] = [each!(" and "), each!(" or ")];
        let m = Both { en: list.en.replace(and[0], or[0]), zh: list.zh.replace(and[1], or[1]) };
        let of_y = if same_side {
            ends(&m, &q.words(self.problem.on))
        } else {
            ends(&q.words(self.problem.on), &m)
        };
        let drawn =
            both!("{}: {a} goes {}, {b} {}", met, ends(&p.words(self.problem.on), &m), of_y);
        let drawn = match meets {
            [_, _] => both!("{}; both polygons are solutions", drawn),
            _ => drawn,
        };
        for (k, (at, name)) in meets.iter().zip(names).enumerate() {
            self.mark(name, *at);
            let (from, to) = if same_side { (*at, q.at) } else { (q.at, *at) };
            self.arrow(x, Some(k), p.at, *at);
            self.arrow(y, Some(k), from, to);
        }
        self.out.steps.push(drawn);
        for (k, at) in meets.iter().enumerate() {
            let v = if same_side { q.at - *at } else { *at - q.at };
            self.read(k, &[(x, *at - p.at), (y, v)]);
        }
    }

    /// The remark on a vector that points against its given angle.
    fn reversed(&self, term: usize, v: Vec2) -> Both {
        let given = self.problem.terms[term].direction.as_ref().filter(|d| d.line.is_none());
        let against = self.given[term].1.is_some_and(|u| u.dot(v) < 0.0);
        if given.is_some() && against {
            both!(", against the given direction")
        } else {
            Both::default()
        }
    }

    /// Measures vectors of a solution.
    fn read(&mut self, root: usize, all: &[(usize, Vec2)]) {
        let kind = self.out.on.kind();
        let book = &self.problem.book;
        let primes = usize::from(EquationCase::of(&self.problem.terms).is_ok_and(|case| {
            !matches!(case, EquationCase::Vector(_) | EquationCase::Magnitudes(_))
        }));
        let told: Vec<Both> = all
            .iter()
            .map(|(term, v)| {
                both!(
                    "${}$ = {} mm · $\\mu_{}$ = {} at {}°{}",
                    self.problem.terms[*term].symbol(primes * (root + 1)),
                    mm(v.norm()),
                    self.out.on.letter(),
                    book.text(kind, &mm(book.value(kind, v.norm() * self.out.mu))),
                    degrees(*v),
                    self.reversed(*term, *v)
                )
            })
            .collect();
        for (term, on_paper) in all {
            self.out.readings.push(EquationReading { term: *term, root, on_paper: *on_paper });
        }
        self.out.steps.push(both!("Measure {}", Both::join(&told, ["; ", "；"])));
    }
}

/// A letter in a sentence: in Chinese between spaces, which [`closed_up`] drops before signs.
fn spaced(letter: &str) -> Both {
    Both { en: letter.to_owned(), zh: format!(" {letter} ") }
}

/// Drops spaces before and after the punctuation of Chinese.
fn closed_up(step: Both) -> Both {
    let mut zh = step.zh.trim_end().to_owned();
    for sign in ["，", "；", "：", "、"] {
        zh = zh.replace(&format!(" {sign}"), sign).replace(&format!("{sign} "), sign);
    }
    Both { en: step.en, zh }
}

/// A number to four digits.
fn mm(x: f64) -> String {
    significant(x, 4).replace('-', "−")
}

/// The direction of a vector in degrees.
fn degrees(v: Vec2) -> String {
    mm(hodograph_base::digits::direction_degrees(v.angle()))
}

/// The crossings of two circles, that left of the line of centres first.
fn arcs(p: Point, r: f64, q: Point, s: f64) -> Vec<Point> {
    if let Some([left, right]) = crossing(p, r, q, s) {
        return if left == right { vec![left] } else { vec![left, right] };
    }
    let apart = p.distance(q);
    let gap = (apart - r - s).max((r - s).abs() - apart);
    match (q - p).unit() {
        Some(along) if gap <= TOUCH * r.max(s) => {
            vec![p + along * if r >= s || apart > s { r } else { -r }]
        }
        _ => Vec::new(),
    }
}

/// The crossings of a line and a circle, the one farther along the line first.
fn cut(p: Point, along: Vec2, centre: Point, radius: f64) -> Vec<Point> {
    let foot = p + along * along.dot(centre - p);
    let off = foot.distance(centre);
    let square = (radius - off) * (radius + off);
    if square.abs() <= TOUCH * radius * radius {
        return vec![foot];
    }
    if square < 0.0 {
        return Vec::new();
    }
    let half = along * libm::sqrt(square);
    vec![foot + half, foot - half]
}

/// The arc about a centre through all crossings, on the shorter way between them.
fn arc(centre: Point, radius: f64, meets: &[Point]) -> Option<EquationLocus> {
    let first = (*meets.first()? - centre).unit()?;
    let turns: Vec<f64> = meets
        .iter()
        .filter_map(|m| (*m - centre).unit())
        .map(|u| u.divide_by(first).angle())
        .collect();
    let more = SWING_MM / radius;
    let (low, high) = turns.iter().fold((0.0_f64, 0.0_f64), |(l, h), t| (l.min(*t), h.max(*t)));
    let start = first.angle();
    Some(EquationLocus::Arc(centre, radius, [start + low - more, start + high + more]))
}
