//! Draws the construction of pole, inflection circle and centres of curvature over the mechanism,
//! with its steps and values as text below.
//!
//! All places are those that the ruler finds ([`hodograph_methods::curvature::drawing`]). Where the
//! ruler finds no pole (a dead centre, parallel rays, too few known paths), pole, inflection circle
//! and centres are at the places that the analysis computes, and the figure says so.

use crate::list::FigureInput;
use crate::mechanism;
use crate::sheet::SheetDrafter;
use hodograph_base::geom::{Point, Vec2};
use hodograph_board::plan::names::name_label;
use hodograph_methods::curvature::drawing::{CurvatureDrawing as Ruler, RayMethod, Rays};
use hodograph_methods::curvature::known::CurvatureRay;
use hodograph_methods::curvature::motion::Bend;
use hodograph_methods::curvature::plane::PlanePoint;
use hodograph_methods::curvature::{LinkCurvatures, OfLink};
use hodograph_paper::paper::drawing::{Drawing, DrawingPart};
use hodograph_paper::paper::extent::Rect;
use hodograph_paper::paper::grid::{self, Cell, Row};
use hodograph_paper::paper::item::{Anchor, Colour, Dash, Figure, LineStroke, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::lines::wrapped;
use hodograph_paper::paper::phrase::Phrase;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_report::curvature::CurvatureWords;
use hodograph_report::curvature_steps::CurvatureStage;
use hodograph_scene::{DiagramKind, Link, PointId};

use super::ball;
use super::board::CurvatureBoard;

/// Distance around the mechanism within which places are drawn in position.
const REACH_MM: f64 = 80.0;
/// Margin around the outermost place.
const EDGE_MM: f64 = 7.0;
/// Places of a construction closer than this (m) to a joint are the joint.
const SAME_M: f64 = 1e-9;
/// In mechanisms with more links only the names that the construction uses are written.
const LINKS_NAMED: usize = 7;
/// Colour of lines in the background.
const LINES: Colour = Colour::grey(120);
/// Extension of a line beyond its last place.
const BEYOND_MM: f64 = 4.0;
/// Maximum half length of the pole tangent.
const TANGENT_MM: f64 = 60.0;
/// Length of the arrow of the pole velocity, which is not to scale.
const SENSE_MM: f64 = 14.0;
/// Width and line spacing of the text below.
const TEXT_MM: f64 = 170.0;
const ROW_MM: f64 = 5.2;
/// Gap between drawing and text.
const GAP_MM: f64 = 9.0;

/// Draws the figure of one link.
pub fn figure(w: &FigureInput, found: &LinkCurvatures, of: &OfLink) -> Figure {
    let maker = SheetDrafter {
        scene: w.scene,
        worked: w.worked,
        options: w.options,
        certified: Vec::new(),
    };
    let words = CurvatureWords { found, lang: w.options.lang };
    let (_, mu) = maker.caption(DiagramKind::Plane);
    let caption =
        Label::text(format!("{} – ", maker.words().curvature)).then(words.heading_set(of).label());
    let (drawn, undrawn) = part(w, &words, of, &[]);
    let mut drawing = maker.titled(drawn, caption, &mu, "curvature");
    let mut below = text(w, &words, of, &undrawn);
    drawing.stand_at(Point::ORIGIN);
    below.stand_at(Point::new(
        (drawing.bounds.width_mm() - below.bounds.width_mm()).max(0.0) / 2.0,
        drawing.bounds.min.y - GAP_MM,
    ));
    let shift = (below.bounds.width_mm() - drawing.bounds.width_mm()).max(0.0) / 2.0;
    drawing.translate(Vec2::new(shift, 0.0));
    let mut figure =
        maker.alone(DrawingPart::of(drawing.items.into_iter().chain(below.items).collect()));
    let told = words.values(of).iter().map(|r| r.join(" ")).collect::<Vec<_>>();
    figure.desc = format!("{}. {}", words.heading(of), told.join("; "));
    figure
}

/// Steps and values as wrapped text, with the names of the steps that the drawing lacks.
fn text(w: &FigureInput, words: &CurvatureWords, of: &OfLink, undrawn: &[String]) -> DrawingPart {
    let style = &w.options.style;
    let mut lines: Vec<Label> = Vec::new();
    let mut add =
        |phrase: &Phrase| lines.extend(wrapped(phrase, TEXT_MM, style.small_mm, &style.fonts));
    words.remarks(of).iter().for_each(&mut add);
    if of.pole().is_some() && of.drawn().is_none() {
        add(&words.calculated());
    }
    for (k, step) in words.steps(of).iter().enumerate() {
        add(&Phrase::of_pieces(
            Phrase::new(&format!("{}. ", k + 1))
                .pieces()
                .iter()
                .chain(step.pieces())
                .cloned()
                .collect(),
        ));
    }
    words.undrawn(undrawn).iter().for_each(&mut add);
    words.told(of).iter().for_each(&mut add);
    words.legend(of).iter().for_each(&mut add);
    let row = |(k, label): (usize, Label)| {
        let cell = Cell {
            label,
            size_mm: style.small_mm,
            anchor: Anchor::Start,
            class: "remark".into(),
            id: format!("curvature-line-{}", k + 1),
        };
        Row { cells: vec![Some(cell)], height_mm: ROW_MM }
    };
    DrawingPart::of(grid::set(&lines.into_iter().enumerate().map(row).collect::<Vec<_>>(), 0.0))
}

/// The drawing, and the names of places that the paper does not hold. The class of each item of the
/// construction names the place of its stage in `stages` (`step-2`); without stages it has no step.
pub(super) fn part(
    w: &FigureInput,
    words: &CurvatureWords,
    of: &OfLink,
    stages: &[Option<CurvatureStage>],
) -> (DrawingPart, Vec<String>) {
    let diagram = &w.worked.construction.diagram;
    let to_paper = |p: Point| ((p - diagram.origin) * (1.0 / diagram.mu)).to_point();
    let mut d = mechanism::numbered(&w.options.style, w.scene, w.worked, &w.options.notation);
    if w.scene.links.len() > LINKS_NAMED {
        only_named_what_is_used(w, of, &mut d);
    }
    let lines = d.bounds();
    let reach = lines.grown(REACH_MM);
    let within = |p: &Point| {
        (reach.min.x..=reach.max.x).contains(&p.x) && (reach.min.y..=reach.max.y).contains(&p.y)
    };
    let to_ball: Vec<Point> =
        if let Ruler::Rays(rays) = &of.drawing { ball::places(rays) } else { Vec::new() };
    let to_ball: Vec<Point> = to_ball.into_iter().map(to_paper).collect();
    let to_ball = if to_ball.iter().all(within) { to_ball } else { Vec::new() };
    let near = places(of).into_iter().map(to_paper).filter(within).chain(to_ball);
    let window = near.fold(lines, |all, p| all.union(Rect::new(p, p))).grown(EDGE_MM);
    let board = CurvatureBoard::new(&w.options.style, d, window);
    let mut over = CurvatureOverlay {
        w,
        words,
        of,
        to_paper: &to_paper,
        board,
        thin: w.options.style.thin.coloured(LINES),
        undrawn: Vec::new(),
        stages,
    };
    over.everything();
    (over.board.d.finish(), over.undrawn)
}

/// In a large mechanism keeps only the names that the construction uses: the link, its joints, and
/// the links that hold them.
fn only_named_what_is_used(w: &FigureInput, of: &OfLink, d: &mut Drawing) {
    let scene = w.scene;
    let rays = match &of.drawing {
        Ruler::Rays(rays) => rays.known.to_vec(),
        Ruler::Parallel(known) | Ruler::OneLine(known) => known.to_vec(),
        Ruler::Rolling(_) | Ruler::Hinge(_) | Ruler::NoRays => Vec::new(),
    };
    let places: Vec<Point> =
        rays.iter().flat_map(|k| [k.moving, k.fixed]).filter_map(PlanePoint::at).collect();
    let placed = |p: PointId| {
        w.worked.configuration.points[p.0]
            .is_some_and(|at| places.iter().any(|q| q.distance(at) < SAME_M))
    };
    let on_link = |p: &PointId| scene.links[of.link.0].points.contains(p);
    let points: Vec<PointId> =
        (0..scene.points.len()).map(PointId).filter(|p| on_link(p) || placed(*p)).collect();
    let holds = |l: &Link| {
        l.points.iter().any(|p| on_link(p) && points.contains(p))
            && l.points.iter().any(|p| placed(*p) && !on_link(p))
    };
    let named = |k: usize, l: &Link| k == of.link.0 || k == scene.ground.0 || holds(l);
    let links: Vec<String> = scene
        .links
        .iter()
        .enumerate()
        .filter(|(k, l)| named(*k, l))
        .map(|(_, l)| l.name.clone())
        .collect();
    let letters: Vec<&str> = points.iter().map(|p| scene.point_name(*p)).collect();
    d.only_named(|name| match name.strip_prefix("number-") {
        Some(link) => links.iter().any(|l| l == link),
        None => letters.contains(&name) || scene.points.iter().all(|p| p.name != name),
    });
}

/// The places that the paper should hold.
fn places(of: &OfLink) -> Vec<Point> {
    let mut out = Vec::new();
    if let Ruler::Rays(rays) = &of.drawing {
        out.extend(rays.straight);
        out.extend(rays.collineation.and_then(PlanePoint::at));
        out.extend(rays.known.iter().flat_map(|k| [k.moving, k.fixed]).filter_map(PlanePoint::at));
    }
    if let Some(pole) = of.shown() {
        out.extend([pole.pole, pole.inflection_pole(), pole.acceleration_pole]);
        out.extend(pole.ball);
    }
    out.extend(
        of.points.iter().filter_map(|p| {
            if let Bend::About(centre, _) = p.shown() { Some(centre) } else { None }
        }),
    );
    out
}

/// The construction under way over the mechanism.
pub(super) struct CurvatureOverlay<'a, 'b> {
    w: &'a FigureInput<'a>,
    pub(super) words: &'a CurvatureWords<'b>,
    of: &'a OfLink,
    to_paper: &'a dyn Fn(Point) -> Point,
    pub(super) board: CurvatureBoard<'a>,
    pub(super) thin: LineStroke,
    /// Names of places that the paper does not hold, in the order of the steps.
    undrawn: Vec<String>,
    /// The stages of the steps, in their order.
    stages: &'a [Option<CurvatureStage>],
}

impl CurvatureOverlay<'_, '_> {
    /// Assigns what is drawn next to the step of a stage; what has no step of its own belongs to that
    /// of the inflection circle.
    pub(super) fn begin(&mut self, stage: CurvatureStage) {
        let place = |s| self.stages.iter().position(|t| *t == Some(s));
        let instead = [stage, CurvatureStage::Rolling, CurvatureStage::Circle];
        let step = instead.into_iter().find_map(place);
        self.board.d.at_step(step);
    }

    fn everything(&mut self) {
        match &self.of.drawing {
            Ruler::Rays(rays) => self.rays(rays),
            Ruler::Parallel(known) | Ruler::OneLine(known) => {
                for k in known {
                    self.ray_alone(k);
                }
            }
            Ruler::Rolling(_) | Ruler::Hinge(_) | Ruler::NoRays => {}
        }
        if let Some(pole) = self.of.shown() {
            self.circles(pole);
            self.centres();
        }
        if let Ruler::Rays(rays) = &self.of.drawing
            && let Some(ball) = rays.ball()
        {
            self.ball(rays, &ball);
        }
        self.board.spots();
    }

    pub(super) fn at(&self, p: Point) -> Point {
        (self.to_paper)(p)
    }

    fn is_joint(&self, at: Point) -> bool {
        let points = &self.w.worked.configuration.points;
        self.w
            .worked
            .mechanism
            .pins
            .iter()
            .filter_map(|p| points[p.0])
            .any(|p| self.at(p).distance(at) < 0.1)
    }

    /// Names a place, or notes that the paper does not hold it.
    pub(super) fn spot(&mut self, label: &str, at: Point) {
        if !self.board.holds(at) {
            self.leave_out(label);
            return;
        }
        let joint = self.is_joint(at);
        let name = Label::math(label).plain();
        self.board.spot(&name, Label::math(label), at, joint);
    }

    /// Notes a name of the steps that is not drawn.
    pub(super) fn leave_out(&mut self, label: &str) {
        if !self.undrawn.iter().any(|l| l == label) {
            self.undrawn.push(label.to_owned());
        }
    }

    /// Draws a line from the first to the last of some collinear places, extended a little.
    pub(super) fn chain(&mut self, name: &str, places: &[Point]) -> u32 {
        let Some((from, to)) = ends(places) else { return 0 };
        let beyond = (to - from).unit().unwrap_or(Vec2::ZERO) * BEYOND_MM;
        let cut = self.board.cut(from - beyond, to + beyond);
        self.board.line(name, "curvature line", cut, self.thin)
    }

    fn ray_alone(&mut self, k: &CurvatureRay) {
        let (Some(through), Some(along)) = (k.ray().through, k.ray().unit()) else { return };
        let across = self.board.across(self.at(through), along);
        self.board.line("ray", "curvature line", across, self.thin);
    }

    /// Draws rays, collineation axis, the points of the rays with straight paths, and their
    /// perpendiculars.
    fn rays(&mut self, rays: &Rays) {
        let (pole, j) = (self.at(rays.pole), self.at(rays.inflection));
        let stands = rays.normal() == Vec2::ZERO;
        for k in [0, 1] {
            let known = &rays.known[k];
            let straight = self.at(rays.straight[k]);
            let on: Vec<Point> = [known.moving, known.fixed]
                .into_iter()
                .filter_map(PlanePoint::at)
                .map(|p| self.at(p))
                .chain([pole, straight])
                .collect();
            self.begin(CurvatureStage::Ray(k));
            self.chain("ray", &on);
            if !stands {
                self.begin(CurvatureStage::Inflection);
                let cut = self.board.cut(straight, j);
                self.board.line(
                    "perpendicular",
                    "curvature line",
                    cut,
                    self.thin.dashed(Dash::DashDot),
                );
                if rays.how[k] != RayMethod::Given {
                    self.begin(CurvatureStage::Straight(k));
                    self.spot(&self.words.straight(known), straight);
                }
            }
            if known.why.moving().is_some()
                && known.why.fixed().is_none()
                && let (PlanePoint::At(c), Some(p)) = (known.fixed, known.why.moving())
            {
                self.begin(CurvatureStage::Ray(k));
                self.spot(&self.words.centre(p), self.at(c));
            }
        }
        let Some(q) = rays.collineation else { return };
        let [b, c] = &rays.known;
        self.begin(CurvatureStage::Collineation);
        if let PlanePoint::At(q) = q {
            let q = self.at(q);
            for pair in [[b.moving, c.moving], [b.fixed, c.fixed]] {
                let on: Vec<Point> = pair
                    .into_iter()
                    .filter_map(PlanePoint::at)
                    .map(|p| self.at(p))
                    .chain([q])
                    .collect();
                self.chain("collineation", &on);
            }
            self.spot(self.words.on_axis(), q);
        }
        let helpers: Vec<Point> = rays
            .how
            .iter()
            .filter_map(|h| {
                if let RayMethod::Collineation(PlanePoint::At(q)) = h {
                    Some(self.at(*q))
                } else {
                    None
                }
            })
            .collect();
        let axis: Vec<Point> = q
            .at()
            .map(|q| self.at(q))
            .into_iter()
            .chain(helpers.iter().copied())
            .chain([pole])
            .collect();
        self.chain("axis", &axis);
        for k in [0, 1] {
            let RayMethod::Collineation(helper) = rays.how[k] else { continue };
            self.begin(CurvatureStage::Straight(k));
            let other = &rays.known[1 - k];
            let PlanePoint::At(helper) = helper else {
                if let PlanePoint::At(b) = other.moving {
                    self.chain("join", &[self.at(b), self.at(rays.straight[k])]);
                }
                continue;
            };
            let helper = self.at(helper);
            if let PlanePoint::At(a) = other.fixed {
                self.chain("parallel", &[self.at(a), helper]);
            }
            if let PlanePoint::At(b) = other.moving {
                self.chain("join", &[self.at(b), helper, self.at(rays.straight[k])]);
            }
            self.spot(&format!("{}_{{{}}}", self.words.on_axis(), 2 - k), helper);
        }
    }

    /// Draws inflection circle, pole tangent and normal, Bresse's circle, and the poles.
    fn circles(&mut self, pole: hodograph_methods::curvature::motion::PoleMotion) {
        let style = self.board.style;
        let mu = self.w.worked.construction.diagram.mu;
        let (at, j) = (self.at(pole.pole), self.at(pole.inflection_pole()));
        let symbol = self.words.pole(self.of);
        self.begin(CurvatureStage::Pole);
        if !self.board.holds(at) {
            self.far(&symbol, at);
        } else {
            self.spot(&symbol, at);
        }
        if pole.stands() {
            return;
        }
        self.begin(CurvatureStage::Circle);
        let normal = pole.normal * (1.0 / mu);
        let circle = LineStroke { width_mm: style.outline.width_mm, ..style.outline };
        let arc = self.board.circle(
            "inflection-circle",
            "curvature inflection",
            at + normal * 0.5,
            normal.norm() / 2.0,
            circle,
        );
        if let Some((from, to)) = arc {
            let label = Label::math(self.words.letter("w", self.of));
            self.board.d.label(
                "inflection-circle",
                "curvature",
                LabelRequest::along(label, style.small_mm, from, to, circle.width_mm)
                    .optional(true),
            );
        }
        if let Some(d) = pole.bresse {
            let d = d * (1.0 / mu);
            let arc = self.board.circle(
                "bresse-circle",
                "curvature bresse",
                at + d * 0.5,
                d.norm() / 2.0,
                self.thin.dashed(Dash::Dashed),
            );
            if let Some((from, to)) = arc {
                let label = Label::math(self.words.letter("b", self.of));
                self.board.d.label(
                    "bresse-circle",
                    "curvature",
                    LabelRequest::along(label, style.small_mm, from, to, 0.2).optional(true),
                );
            }
        }
        let normal_line = self.board.cut(at, j);
        self.board.line("normal", "curvature line", normal_line, self.thin);
        self.tangent(at, normal, pole.pole_velocity);
        for (letter, stage, place) in [
            ("J", CurvatureStage::Inflection, Some(j)),
            ("K", CurvatureStage::AccelerationPole, Some(self.at(pole.acceleration_pole))),
            ("U", CurvatureStage::Ball(1), pole.ball.map(|p| self.at(p))),
        ] {
            let Some(place) = place else { continue };
            self.begin(stage);
            let symbol = self.words.letter(letter, self.of);
            if self.board.holds(place) {
                self.spot(&symbol, place);
            } else if self.board.holds(at) {
                let label =
                    self.distance(&self.words.pole(self.of), &symbol, place.distance(at) * mu);
                let along = self.board.cut(at, place);
                if letter != "J" {
                    self.board.line(
                        letter,
                        "curvature line",
                        along,
                        self.thin.dashed(Dash::Dotted),
                    );
                }
                self.board.arrow(&Label::math(&symbol).plain(), label, at, place - at, self.thin);
            }
        }
    }

    /// Half of the length of the tangent (mm); the pole is in its middle.
    pub(super) fn half_tangent(&self) -> f64 {
        let diameter_mm = self.of.shown().map_or(0.0, |pole| pole.diameter())
            / self.w.worked.construction.diagram.mu;
        TANGENT_MM.min(diameter_mm.max(2.0 * SENSE_MM))
    }

    /// Draws the pole tangent and an arrow in the direction of the pole velocity.
    fn tangent(&mut self, at: Point, normal: Vec2, u: Vec2) {
        let style = self.board.style;
        let (Some(t), true) = (normal.perp().unit(), self.board.holds(at)) else { return };
        let half = self.half_tangent();
        let cut = self.board.cut(at - t * half, at + t * half);
        let owner = self.board.line(
            "tangent",
            "curvature tangent",
            cut,
            style.outline.dashed(Dash::DashDot),
        );
        if let Some([from, to]) = cut {
            let far = if from.distance(at) > to.distance(at) {
                (from, from + (at - from) * 0.3)
            } else {
                (to, to + (at - to) * 0.3)
            };
            let label = LabelRequest::along(
                Label::math("t"),
                style.label_mm,
                far.0,
                far.1,
                style.outline.width_mm / 2.0,
            );
            self.board.d.label("tangent", "curvature", label.owned(owner));
        }
        let Some(sense) = u.unit() else { return };
        let to = at + sense * SENSE_MM;
        let shape = Shape::Arrow { from: at, to, stroke: style.vector, head: style.head };
        let owner = self.board.d.shape("pole-velocity", "curvature pole-velocity", shape);
        let label = Label::math(self.words.letter("u", self.of));
        self.board.d.label(
            "pole-velocity",
            "curvature",
            LabelRequest::along(label, style.small_mm, at, to, style.vector.width_mm / 2.0)
                .owned(owner),
        );
    }

    /// Draws the centres of the points' paths, with the lines that find them.
    fn centres(&mut self) {
        let Some(pole) = self.of.shown() else { return };
        let (p, j) = (self.at(pole.pole), self.at(pole.inflection_pole()));
        let given = |point: PointId| match &self.of.drawing {
            Ruler::Rays(r) => r.known.iter().any(|k| k.why.moving() == Some(point)),
            Ruler::Rolling(_)
            | Ruler::Hinge(_)
            | Ruler::Parallel(_)
            | Ruler::OneLine(_)
            | Ruler::NoRays => false,
        };
        let asked: Vec<_> = self.of.points.iter().filter(|q| !given(q.point)).cloned().collect();
        for q in asked {
            self.begin(CurvatureStage::Centre(q.point));
            let e = self.at(q.at);
            let Bend::About(centre, radius) = q.shown() else {
                if q.bend == Bend::Straight {
                    self.chain("ray", &[e, p]);
                }
                continue;
            };
            let centre = self.at(centre);
            self.chain("ray", &[e, p, centre]);
            if let (Some(drawn), false) = (q.drawn, pole.stands())
                && let PlanePoint::At(h) = drawn.helper
            {
                let h = self.at(h);
                // Lines to a distant auxiliary point explain nothing.
                let stepped = matches!(self.of.drawing, Ruler::Rays(_) | Ruler::Rolling(_));
                if stepped && !self.board.holds(h) {
                    self.leave_out(self.words.helper());
                } else if stepped && h.distance(p) > 1.0 {
                    self.chain("helper", &[p, h]);
                    let to_j = self.board.cut(e, j);
                    let toward = if (h - e).dot(j - e) >= 0.0 && h.distance(e) > j.distance(e) {
                        self.board.cut(e, h)
                    } else {
                        to_j
                    };
                    self.board.line(
                        "helper",
                        "curvature line",
                        toward,
                        self.thin.dashed(Dash::Dashed),
                    );
                    self.chain("helper", &[e, h]);
                    self.chain("helper", &[h, centre]);
                    self.spot(self.words.helper(), h);
                }
            }
            let symbol = self.words.centre(q.point);
            if self.board.holds(centre) {
                self.spot(&symbol, centre);
            } else {
                let label = self.distance(&self.named(q.point), &symbol, radius);
                self.board.arrow(&Label::math(&symbol).plain(), label, e, centre - e, self.thin);
            }
        }
    }

    /// `P_{24}J_{2} = 2.52 m`: a place off the paper with its distance.
    fn distance(&self, from: &str, symbol: &str, m: f64) -> Label {
        Label::math(format!("{from}{symbol} = ")).then(Label::text(self.w.scene.length_words(m)))
    }

    /// The name of a point in formulas.
    fn named(&self, p: PointId) -> String {
        name_label(self.w.scene.point_name(p))
    }

    /// Draws an arrow to a pole off the paper: from the first point, with the distance, or else
    /// from the middle of the paper.
    fn far(&mut self, symbol: &str, at: Point) {
        let own = self
            .of
            .points
            .first()
            .map(|q| (self.named(q.point), self.at(q.at)))
            .filter(|(_, p)| self.board.holds(*p));
        let mu = self.w.worked.construction.diagram.mu;
        let (from, label) = match own {
            Some((name, from)) => (from, self.distance(&name, symbol, at.distance(from) * mu)),
            None => (self.board.window.centre(), Label::math(symbol)),
        };
        self.board.arrow(&Label::math(symbol).plain(), label, from, at - from, self.thin);
    }
}

/// The two of some collinear places that are farthest apart.
fn ends(places: &[Point]) -> Option<(Point, Point)> {
    let mut best: Option<(f64, Point, Point)> = None;
    for (i, a) in places.iter().enumerate() {
        for b in &places[i + 1..] {
            let far = a.distance(*b);
            if best.is_none_or(|(d, ..)| far > d) && far.is_finite() {
                best = Some((far, *a, *b));
            }
        }
    }
    best.map(|(_, a, b)| (a, b))
}
