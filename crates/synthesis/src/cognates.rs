//! Cognates 同源机构 (Roberts–Chebyshev), `"synthesis": "cognates"`: the two other four-bars that guide
//! a coupler point along the same path.
//!
//! λ = BE/BC as a rotation with scaling. The third pivot is F = A + λ·AD; the left cognate A A₁ P₁
//! F has A₁ = A + BE and P₁ = A₁ + λ·AB, the right one D D₁ P₂ F correspondingly with the letters
//! exchanged, λ' = CE/CB. ABEA₁ and DCED₁ are parallelograms; the three triangles on the couplers
//! are similar to BCE.
//!
//! # Source
//! S. Roberts, *On three-bar motion in plane space*, Proc. London Math. Soc. 7 (1875); P. L.
//! Chebyshev, 1878.

mod explained;

use super::board::{PaperLine, SynthesisBoard, Weight};
use super::candidate::{DesignNumber, Draft, WantedPosition};
use super::form::TaskForm;
use super::fourbar::{FourBar, Heading, named_lengths};
use super::{KindOfTask, Proof, Statement, TaskResult, USUAL_OMEGA, Wish};
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::each;
use hodograph_mechanism::mechanism::{Demand, Mechanism};
use hodograph_mechanism::position::{Configuration, configure};
use hodograph_scene::{self as scene, LinkId, PointId, Scene, templates};
use std::f64::consts::TAU;

/// Cognates as a kind of task.
pub const KIND: KindOfTask = KindOfTask {
    name: "cognates",
    what: each!("the two other four-bars with the same coupler curve"),
    keys: &["scene", "point"],
    read,
};

/// Number of positions in which the cognates' scenes are compared with the given linkage.
const POSITIONS: usize = 8;
/// Lengths below this share of the linkage's size count as zero.
const NONE: f64 = 1e-9;

/// A four-bar with a coupler point, and its cognates.
#[derive(Clone, Debug, PartialEq)]
pub struct Cognates {
    /// The given linkage: A, B, C, D, and E in the coupler.
    pub given: FourBar,
    /// E (m).
    pub e: Point,
    /// F, the third pivot.
    pub f: Point,
    /// A₁ and P₁.
    pub left: [Point; 2],
    /// D₁ and P₂.
    pub right: [Point; 2],
}

impl Cognates {
    /// Cognates by rotation and scaling; `None` where the coupler has zero length.
    pub fn of(given: FourBar, e: Point) -> Option<Cognates> {
        let FourBar { a, b, c, d, .. } = given;
        if b.distance(c) <= NONE * given.size() {
            return None;
        }
        // The third pivot, and two joints of the cognate on the pivot of the first crank.
        let side = |a: Point, b: Point, c: Point| {
            let ratio = (e - b).divide_by(c - b);
            let first = a + (e - b);
            [first, first + ratio.rotate_by(b - a)]
        };
        let f = a + (e - b).divide_by(c - b).rotate_by(d - a);
        Some(Cognates { left: side(a, b, c), right: side(d, c, b), f, e, given })
    }

    /// The left cognate, driven by A A₁, which rotates with BC; and the right one, driven by F P₂,
    /// which rotates with AB.
    pub fn four_bars(&self) -> [Option<FourBar>; 2] {
        let with = |a: Point, b: Point, c: Point, d: Point| {
            let axis = (c - b).unit().filter(|_| b.distance(c) > NONE * self.given.size())?;
            let whole = a.distance(b) > NONE * self.given.size()
                && c.distance(d) > NONE * self.given.size()
                && a.distance(d) > NONE * self.given.size();
            whole.then(|| FourBar { a, b, c, d, e: Some((self.e - b).divide_by(axis)) })
        };
        [
            with(self.given.a, self.left[0], self.left[1], self.f),
            with(self.f, self.right[1], self.right[0], self.given.d),
        ]
    }

    /// The cognates of a scene that is a four-bar with this coupler point.
    ///
    /// # Errors
    /// `not-a-four-bar`, with the required structure and that of the scene.
    pub fn of_scene(
        scene: &Scene,
        at: &Configuration,
        point: Option<PointId>,
    ) -> Result<Cognates, Diagnostic> {
        let (given, e) = four_bar(scene, at, point)?;
        let e_at = at.points[e.0].ok_or_else(|| none(scene))?;
        Cognates::of(given, e_at).ok_or_else(|| none(scene))
    }
}

fn none(scene: &Scene) -> Diagnostic {
    let message = both!(
        "cognates are of a four-bar of four pins with a point on its coupler; in this scene: links {}, guides {}",
        scene.links.len(),
        scene.guides.len()
    );
    let help =
        both!("write links 1: AB, 2: BCE, 3: CD, 4: AD, such as `hodograph new crank-rocker`");
    Diagnostic::error("not-a-four-bar", message).help(help)
}

/// The four-bar of a scene, driver first, and its coupler point.
fn four_bar(
    scene: &Scene,
    at: &Configuration,
    point: Option<PointId>,
) -> Result<(FourBar, PointId), Diagnostic> {
    let found = || {
        if scene.links.len() != 4 || !scene.guides.is_empty() || !scene.rolling.is_empty() {
            return None;
        }
        let points = |l: usize| &scene.links[l].points;
        let ground = scene.ground.0;
        let floating = (0..4)
            .find(|l| *l != ground && !points(*l).iter().any(|p| points(ground).contains(p)))?;
        let mut cranks: Vec<usize> = (0..4).filter(|l| *l != ground && *l != floating).collect();
        let driven = |l: usize| {
            scene.drivers.iter().any(|d| d.kind.turned().is_some_and(|(link, _)| link == LinkId(l)))
        };
        cranks.sort_by_key(|l| !driven(*l));
        let common = |k: usize, l: usize| points(k).iter().copied().find(|p| points(l).contains(p));
        let pins = [
            common(cranks[0], ground)?,
            common(cranks[0], floating)?,
            common(floating, cranks[1])?,
            common(cranks[1], ground)?,
        ];
        let free = |p: &PointId| points(floating).contains(p) && !pins.contains(p);
        let e = match point {
            Some(p) => Some(p).filter(free)?,
            None => points(floating).iter().copied().find(free)?,
        };
        let [a, b, c, d] = pins.map(|p| at.points[p.0]);
        let (a, b, c, d) = (a?, b?, c?, d?);
        let local = (at.points[e.0]? - b).divide_by((c - b).unit()?);
        Some((FourBar { a, b, c, d, e: Some(local) }, e))
    };
    found().ok_or_else(|| match point {
        Some(p)
            if scene.links.len() == 4
                && scene.guides.is_empty()
                && scene.carriers(p).count() > 1 =>
        {
            let name = scene.point_name(p);
            let message = both!("`{name}` is a pin, not a free point of the coupler");
            Diagnostic::error("not-a-four-bar", message)
                .help(both!("name a point that lies on the coupler alone"))
        }
        Some(_) | None => none(scene),
    })
}

/// A position of the given linkage: crank AB, coupler BC, and E.
type FourBarPose = (Vec2, Vec2, Point);
/// The vector of the given linkage that rotates with a cognate's driver.
type TurnsAs = fn(&FourBarPose) -> Vec2;

#[derive(Clone, Debug)]
struct CognatesTask {
    cognates: Cognates,
    /// The title if the file has none.
    name: Both,
    /// The angular velocity of the given scene's driver (rad/s).
    rate: f64,
}

fn read(form: &TaskForm) -> Option<Box<dyn Wish>> {
    let node = form.need("scene", "\"crank-rocker\"")?;
    let fault = |d: Diagnostic| form.fault(d.at(form.span("scene")));
    let text = match &node.kind {
        hodograph_base::json::NodeKind::Text(name) => match templates::get(name) {
            Ok(text) => text.to_owned(),
            Err(d) => {
                fault(d.help(both!(
                    "name a template, a scene file beside this one, or write the scene itself"
                )));
                return None;
            }
        },
        hodograph_base::json::NodeKind::Object(_) => node.text(),
        hodograph_base::json::NodeKind::Number(_)
        | hodograph_base::json::NodeKind::Bool(_)
        | hodograph_base::json::NodeKind::Null
        | hodograph_base::json::NodeKind::Array(_) => {
            return form.refuse(
                node,
                "scene",
                both!("the name of a template or scene file, or a scene"),
            );
        }
    };
    let made = || -> Result<(Scene, Configuration), Faults> {
        let scene = scene::read(&text)?.value;
        let mechanism = Mechanism::new(&scene)?.value;
        let demand = Demand::of(&scene, &mechanism).with_all_positions();
        let at = configure(&scene, &mechanism, &demand)?.value;
        Ok((scene, at))
    };
    let (scene, at) = match made() {
        Ok(made) => made,
        Err(faults) => {
            for d in faults.list {
                let message = both!("in the scene: {}", d.message);
                fault(Diagnostic { message, ..d });
            }
            return None;
        }
    };
    let point = match form.word("point") {
        Some(word) => {
            match (0..scene.points.len()).map(PointId).find(|p| scene.point_name(*p) == word.text) {
                Some(p) => Some(p),
                None => {
                    let d = Diagnostic::error(
                        "unknown-point",
                        both!("the scene has no point `{}`", word.text),
                    );
                    form.fault(d.at(word.span));
                    return None;
                }
            }
        }
        None => None,
    };
    match Cognates::of_scene(&scene, &at, point) {
        Ok(cognates) => {
            let name = if scene.title.en.is_empty() && scene.title.zh.is_empty() {
                both!("Cognates of a four-bar")
            } else {
                both!(
                    "Cognates of: {}",
                    Both { en: scene.title.en.clone(), zh: scene.title.zh.clone() }
                )
            };
            let rate =
                scene.drivers.iter().find(|d| d.kind.turns()).map_or(USUAL_OMEGA, |d| d.rate.value);
            Some(Box::new(CognatesTask { cognates, name, rate }))
        }
        Err(d) => {
            fault(d);
            None
        }
    }
}

impl CognatesTask {
    /// Positions of the given linkage over a turn of its crank, or over the range in which it
    /// closes: crank, coupler, E.
    fn positions(&self) -> Vec<FourBarPose> {
        let given = &self.cognates.given;
        let start = (given.b - given.a).angle();
        let place = |k: usize| {
            let (b, c) = given.at(start + TAU * k as f64 / POSITIONS as f64)?;
            Some((b - given.a, c - b, given.coupler_point(b, c)?))
        };
        (0..POSITIONS).map_while(place).collect()
    }

    fn draft(&self, which: Both, linkage: &FourBar, heading: &Heading, link: TurnsAs) -> Draft {
        let positions = self.positions();
        let first = positions.first().map_or(Vec2::new(1.0, 0.0), link);
        let crank = linkage.b - linkage.a;
        let wanted = positions.iter().map(|p| WantedPosition {
            driver: crank.rotate_by(link(p).divide_by(first)).angle(),
            places: vec![("E".into(), p.2)],
        });
        let mut numbers = named_lengths(linkage.lengths());
        numbers.push(DesignNumber::length(
            "BE",
            both!("from B to the coupler point"),
            linkage.b.distance(self.cognates.e),
        ));
        numbers.push(DesignNumber::length(
            "CE",
            both!("from C to the coupler point"),
            linkage.c.distance(self.cognates.e),
        ));
        Draft::new(which, linkage.scene(heading), numbers, wanted.collect())
    }
}

impl Wish for CognatesTask {
    fn title(&self) -> Both {
        self.name.clone()
    }

    fn rate(&self) -> f64 {
        self.rate
    }

    fn solve(&self, heading: &Heading) -> Result<TaskResult, Faults> {
        let c = &self.cognates;
        let mut notes = Vec::new();
        let mut drafts = vec![self.draft(both!("the given linkage"), &c.given, heading, |p| p.0)];
        let [left, right] = c.four_bars();
        let names = [
            both!("left cognate AA1P1F (its AB turns as the given BC)"),
            both!("right cognate FP2D1D (its AB turns as the given AB)"),
        ];
        let links: [TurnsAs; 2] = [|p| p.1, |p| p.0];
        for ((linkage, name), link) in [left, right].into_iter().zip(names).zip(links) {
            match linkage {
                Some(linkage) => drafts.push(self.draft(name, &linkage, heading, link)),
                None => {
                    let message =
                        both!("{}: a link has no length, for E lies on a pin of the coupler", name);
                    notes.push(Diagnostic::note("cognate-collapses", message));
                }
            }
        }
        let place = |name: &str, what: Both, p: Point| {
            [
                DesignNumber::length(&format!("{name}_x"), what.clone(), p.x),
                DesignNumber::length(&format!("{name}_y"), what, p.y),
            ]
        };
        let numbers = [
            place("F", both!("third pivot"), c.f),
            place("A1", both!("parallelogram A B E A1"), c.left[0]),
            place("P1", both!("triangle A1EP1, similar to BCE"), c.left[1]),
            place("D1", both!("parallelogram D C E D1"), c.right[0]),
            place("P2", both!("triangle ED1P2, similar to BCE"), c.right[1]),
        ];
        Ok(TaskResult { drafts, numbers: numbers.into_iter().flatten().collect(), notes })
    }

    fn construct(&self, draft: &Draft, board: &mut SynthesisBoard) -> Option<()> {
        let way = |k: usize| move |board: &mut SynthesisBoard| self.drawn(board, k);
        board.meant(draft, &[&way(0), &way(1), &way(2)])
    }

    fn statement(&self) -> Statement {
        self.stated()
    }

    fn proof(&self, draft: &Draft) -> Vec<Proof> {
        self.proved(draft)
    }
}

impl CognatesTask {
    /// Draws two parallelograms and three similar triangles; linkage `k` of the three is measured.
    fn drawn(&self, board: &mut SynthesisBoard, k: usize) -> Option<()> {
        let FourBar { a, b, c, d, .. } = self.cognates.given;
        let [a, b, c, d, e] = [a, b, c, d, self.cognates.e].map(|p| board.at(p));
        board.step(both!("Draw the given linkage ABCD with its coupler point E"));
        for (p, q) in [(a, b), (b, c), (c, d), (b, e), (c, e)] {
            board.line(p, q, Weight::Given);
        }
        board.mark("A", a).mark("B", b).mark("C", c).mark("D", d).mark("E", e);
        board.step(both!(
            "Draw the parallelograms ABEA1 and DCED1 (two openings of the compasses each)"
        ));
        let [a1, d1] = [(a, b), (d, c)].map(|(pivot, pin)| {
            let corner = pivot + (e - pin);
            board.arc(pivot, corner).arc(e, corner);
            board.line(pivot, corner, Weight::Thin).line(corner, e, Weight::Thin);
            corner
        });
        board.mark("A_1", a1).mark("D_1", d1);
        board.step(both!(
            "Draw triangles similar to BCE: over A1E the triangle A1EP1, over ED1 the triangle ED1P2, over AD the triangle ADF"
        ));
        let p1 = similar(board, [a1, e], [b, c, e])?;
        let p2 = similar(board, [d1, e], [c, b, e])?;
        let f = similar(board, [a, d], [b, c, e])?;
        board.mark("P_1", p1).mark("P_2", p2).mark("F", f);
        board.step(both!("The linkages AA1P1F and FP2D1D carry E too"));
        for [p, q, r, s] in [[a, a1, p1, f], [f, p2, d1, d]] {
            board.line(p, q, Weight::Result).line(q, r, Weight::Result).line(r, s, Weight::Result);
        }
        let [p, q, r, s] = [[a, b, c, d], [a, a1, p1, f], [f, p2, d1, d]][k];
        board.read("AB", p, q).read("BC", q, r).read("CD", r, s).read("AD", p, s);
        board.read("BE", q, e).read("CE", r, e);
        Some(())
    }
}

/// The third corner of a triangle over a base that is similar to a given one: its angles at both
/// ends are transferred; for a corner on the base itself the division ratio is.
fn similar(board: &mut SynthesisBoard, base: [Point; 2], to: [Point; 3]) -> Option<Point> {
    let [p, q] = base;
    let [u, v, w] = to;
    let carried = |at: Point, toward: Point, from: [Point; 2]| {
        let turn = (w - from[0]).divide_by((from[1] - from[0]).unit()?).unit()?;
        Some(PaperLine { at, along: (toward - at).unit()?.rotate_by(turn) })
    };
    let (one, other) = (carried(p, q, [u, v])?, carried(q, p, [v, u])?);
    // A pencil line's width over the length of a sheet: flatter triangles are degenerate.
    let corner = if one.along.cross(other.along).abs() > 1e-3 {
        one.cross(&other)?
    } else {
        let along = (v - u).unit()?;
        one.at
            + (q - p) * (along.dot(w - u) / u.distance(v))
            + (q - p).perp() * (along.cross(w - u) / u.distance(v))
    };
    board.line(p, corner, Weight::Thin).line(q, corner, Weight::Thin);
    Some(corner)
}
