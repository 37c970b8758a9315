//! The kinematic diagram to scale μ_l, from topology and positions only.
//!
//! This module decides the drawing order and the names. [`form`] gives the form of each link,
//! [`parted`] displaces overlapping bars, [`slides`] draws guides, blocks and cylinders, [`wheels`]
//! rolling bodies, [`marks`] the drivers' angles, [`rates`] their arrows, [`special`] the special
//! points of triads, [`supports`] chooses the side of a pivot's support, [`swings`] draws swinging
//! blocks, [`crosses`] blocks in two slots, [`dimensions`] the given lengths, [`directions`] guides
//! that tables call t, [`letters`] numbers and letters, [`overlay`] everything over and behind the
//! mechanism, [`composed`] the vectors of a composite motion, [`looped`] closed vectors, [`evolved`]
//! an eccentric disc and a rod in a block, [`positions`] other positions with angles and lengths,
//! [`replaced`] the linkage in place of cams. Links and points without a position are left out.

mod apart;
mod belts;
mod cams;
mod composed;
mod crosses;
pub(crate) mod dimensions;
mod directions;
mod evolved;
mod form;
mod letters;
mod looped;
mod marks;
mod overlay;
mod parted;
mod positions;
mod radii;
mod rates;
mod replaced;
mod slides;
pub(crate) mod special;
pub(crate) mod supports;
mod swings;
mod wheels;

use hodograph_base::geom::{Point, Vec2};
use hodograph_base::notation::Notation;
use hodograph_mechanism::mechanism::Opened;
use hodograph_mechanism::position::Path;
use hodograph_scene::{Guide, GuideId, GuidePath, LinkId, PointId, Scene, Through};
use hodograph_worked::worked::Worked;

pub use composed::{Composed, ComposedVector, SHORTEST_MM, composed};
pub use evolved::{AROUND_MM, eccentric, rod_in_block};
use form::LinkForm;
use hodograph_paper::paper::drawing::{Drawing, DrawingPart};
use hodograph_paper::paper::item::{Colour, FigureItem, LineStroke, Shape};
use hodograph_paper::paper::style::Style;
use hodograph_paper::paper::symbols as sym;

pub use apart::{MechanismPiece, apart, links};
pub use looped::{LoopArrow, looped};
pub use overlay::{Overlay, PointTrack, overlaid};
pub use positions::{MarkedAngle, MarkedLength, OtherPosition, PositionMarks, positions};
pub use replaced::replaced;

/// Two places closer than this on paper are one: a tenth of a link's width.
const SAME_MM: f64 = 0.07;

/// Gap in the lower bar on either side of a bar that crosses it.
const GAP_MM: f64 = 0.9;
/// Bars that cross at a smaller angle (sine), or nearer to one of their ends, have no gap: it would
/// reach the joint.
const CROSSING_SINE: f64 = 0.25;
const CROSSING_FREE_MM: f64 = 5.0;

/// Draws the mechanism with the diagram's origin at the origin.
pub fn mechanism(
    style: &Style,
    scene: &Scene,
    worked: &Worked,
    notation: &Notation,
) -> DrawingPart {
    drawing(style, scene, worked, notation, &SeriesFeatures::default()).finish()
}

/// Features that a drawing takes from the whole series, so that the ground remains unchanged and no
/// link changes its form; each list may be empty.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SeriesFeatures {
    /// For each guide, the travel (mm) of its runner behind and ahead of its present position,
    /// along the guide: the first ≤ 0, the second ≥ 0.
    pub travel_mm: Vec<[f64; 2]>,
    /// For each point, the side of its support.
    pub supports: Vec<Vec2>,
    /// For each guide on the ground with hatching on one side, that side.
    pub hatched: Vec<Option<Vec2>>,
}

impl SeriesFeatures {
    /// Returns the sides that a single drawing chooses.
    pub fn of_one(
        style: &Style,
        scene: &Scene,
        worked: &Worked,
        notation: &Notation,
    ) -> SeriesFeatures {
        let alone = SeriesFeatures::default();
        let mut draft = MechanismDraft::new(style, scene, worked, notation, &alone);
        draft.ground_guides();
        let supports = (0..scene.points.len()).map(|p| draft.support_side(PointId(p))).collect();
        SeriesFeatures { travel_mm: Vec::new(), supports, hatched: draft.hatched }
    }
}

/// Draws the mechanism, before its labels are placed.
pub fn drawing(
    style: &Style,
    scene: &Scene,
    worked: &Worked,
    notation: &Notation,
    course: &SeriesFeatures,
) -> Drawing {
    let mut draft = MechanismDraft::new(style, scene, worked, notation, course);
    draft.everything();
    draft.d
}

/// Draws the mechanism with its links numbered, and without special points and directions, which
/// belong to the polygons; labels are not yet placed.
pub fn numbered(style: &Style, scene: &Scene, worked: &Worked, notation: &Notation) -> Drawing {
    let alone = SeriesFeatures::default();
    let mut draft = MechanismDraft::new(style, scene, worked, notation, &alone);
    draft.constructed = false;
    draft.everything();
    draft.numbers();
    draft.d
}

/// Draws the mechanism without the contours on which one of its links rolls on another, which are
/// its centrodes; labels are not yet placed.
pub fn rolling(
    style: &Style,
    scene: &Scene,
    worked: &Worked,
    notation: &Notation,
    links: [LinkId; 2],
) -> Drawing {
    let alone = SeriesFeatures::default();
    let mut draft = MechanismDraft::new(style, scene, worked, notation, &alone);
    draft.constructed = false;
    draft.rolling = Some(links);
    draft.everything();
    draft.numbers();
    draft.d
}

/// The diagram under construction.
struct MechanismDraft<'a> {
    style: &'a Style,
    scene: &'a Scene,
    worked: &'a Worked,
    notation: &'a Notation,
    d: Drawing,
    /// The form of each link; `None` for the ground and for links without a position.
    forms: Vec<Option<LinkForm>>,
    /// The displacement of the bars of each link that overlap those of another.
    parted: Vec<Vec<Vec2>>,
    /// The side of the support of each point, used for fixed pivots.
    supports: Vec<Vec2>,
    /// The place of each link's number.
    number_at: Vec<Option<letters::NumberPlace>>,
    /// For each guide on the ground with hatching on one side, that side.
    hatched: Vec<Option<Vec2>>,
    /// The arrows of rotations: their centres, and the places of their names.
    turned_at: Vec<(Point, Point)>,
    /// The features shared by a whole series.
    course: &'a SeriesFeatures,
    /// True if the diagram belongs to a construction: links are numbered, special points and
    /// directions named.
    constructed: bool,
    /// True if given angles are written with their values.
    dimensioned: bool,
    /// Two links with their contours left out where they roll on each other; the first one moves.
    rolling: Option<[LinkId; 2]>,
    /// The part that is shown of a mechanism drawn apart; `None` for all of it.
    only: Option<apart::Only>,
}

impl<'a> MechanismDraft<'a> {
    fn new(
        style: &'a Style,
        scene: &'a Scene,
        worked: &'a Worked,
        notation: &'a Notation,
        course: &'a SeriesFeatures,
    ) -> Self {
        let d = Drawing::new("mechanism", style.clone());
        let (number_at, hatched) = (vec![None; scene.links.len()], vec![None; scene.guides.len()]);
        let mut draft = MechanismDraft {
            style,
            scene,
            worked,
            notation,
            d,
            forms: Vec::new(),
            parted: Vec::new(),
            supports: Vec::new(),
            number_at,
            hatched,
            turned_at: Vec::new(),
            course,
            constructed: true,
            dimensioned: false,
            rolling: None,
            only: None,
        };
        draft.forms = (0..scene.links.len()).map(|l| draft.form(LinkId(l))).collect();
        draft.parted = draft.parted();
        draft.supports = draft.support_sides();
        draft
    }

    /// Draws the mechanism, from back to front.
    fn everything(&mut self) {
        self.ground_guides();
        self.wheels();
        self.cams();
        self.plates(true);
        self.carriers();
        self.blocks();
        self.plates(false);
        self.followers();
        self.bars();
        self.cylinders();
        self.equivalents();
        self.joints();
        self.swinging();
        self.contacts();
        self.drivers();
        if self.constructed {
            self.special_points();
            self.directions();
            self.numbers();
        }
        self.letters();
    }

    /// Maps the plane (m) to paper (mm).
    fn paper(&self, p: Point) -> Point {
        let diagram = &self.worked.construction.diagram;
        ((p - diagram.origin) * (1.0 / diagram.mu)).to_point()
    }

    /// Position of a point on paper.
    fn point(&self, p: PointId) -> Option<Point> {
        self.worked.configuration.points[p.0].map(|p| self.paper(p))
    }

    /// A guide on paper.
    fn guide(&self, g: GuideId) -> Option<Path> {
        let mu = self.worked.construction.diagram.mu;
        Some(match self.worked.configuration.guides[g.0]? {
            Path::Line { through, direction } => {
                Path::Line { through: self.paper(through), direction }
            }
            Path::Arc { centre, radius } => {
                Path::Arc { centre: self.paper(centre), radius: radius / mu }
            }
        })
    }

    /// Travel (mm) of a guide's runner behind and ahead of its present position, in a series.
    fn travel(&self, g: GuideId) -> [f64; 2] {
        self.course.travel_mm.get(g.0).copied().unwrap_or([0.0, 0.0])
    }

    /// Position of a guide's pin or block, and the tangent there.
    fn runner(&self, g: GuideId) -> Option<(Point, Vec2)> {
        let guide = &self.scene.guides[g.0];
        let path = self.guide(g)?;
        let at = match guide.pin {
            Some(p) => self.point(p)?,
            None => match path {
                Path::Line { through, .. } => through,
                Path::Arc { .. } => return None,
            },
        };
        Some((at, path.tangent_at(at)))
    }

    /// Items of a pair, dashed if the pair is redundant.
    fn as_opened(&self, what: Opened, items: Vec<FigureItem>) -> Vec<FigureItem> {
        if self.worked.mechanism.is_opened(&what) { sym::dashed(items) } else { items }
    }

    fn is_pin(&self, p: PointId) -> bool {
        self.worked.mechanism.pins.contains(&p)
    }

    fn on_ground(&self, p: PointId) -> bool {
        self.scene.links[self.scene.ground.0].points.contains(&p)
    }

    /// True if the point is a revolute joint on the ground.
    fn is_fixed_pivot(&self, p: PointId) -> bool {
        let cylinder_end =
            self.scene.drivers.iter().filter_map(|d| d.kind.ends()).any(|ends| ends.contains(&p));
        let joined = self.scene.carriers(p).any(|l| l != self.scene.ground) || cylinder_end;
        self.on_ground(p) && joined && self.shows(self.scene.ground) && self.shows_point(p)
    }

    /// True if a guide, or the direction of a flat face, names the point: it is then shown as a
    /// dot.
    fn is_reference(&self, p: PointId) -> bool {
        if self.on_face(p) {
            return true;
        }
        self.scene.guides.iter().any(|g| match &g.path {
            GuidePath::Line { through, .. } => *through == Through::Point(p),
            GuidePath::Arc { centre, .. } => *centre == p,
        })
    }

    /// True if the point runs, as a bare pin, in a slot of the ground.
    fn in_fixed_slot(&self, p: PointId) -> bool {
        let slot = |g: &Guide| {
            g.pin == Some(p)
                && g.slider.is_none()
                && g.rolling.is_none()
                && g.on == self.scene.ground
        };
        self.scene.guides.iter().any(slot)
    }

    /// The guide with its block around the point.
    fn block_at(&self, p: PointId) -> Option<GuideId> {
        let block = |g: &GuideId| {
            let guide = &self.scene.guides[g.0];
            guide.pin == Some(p) && guide.slider.is_some() && !self.is_bore(*g)
        };
        (0..self.scene.guides.len()).map(GuideId).find(block)
    }

    /// Directions in which links leave a point (unit vectors).
    fn leaving(&self, p: PointId) -> Vec<Vec2> {
        let Some(at) = self.point(p) else { return Vec::new() };
        let mut out = self.rods_leaving(p);
        for l in self.scene.carriers(p).filter(|l| *l != self.scene.ground) {
            let Some(form) = &self.forms[l.0] else { continue };
            for (a, b) in form.segments() {
                if a.distance(at) < SAME_MM {
                    out.extend((b - at).unit());
                } else if b.distance(at) < SAME_MM {
                    out.extend((a - at).unit());
                } else if form::on_segment(at, a, b, SAME_MM) {
                    out.extend([(a - at).unit(), (b - at).unit()].into_iter().flatten());
                }
            }
        }
        for [a, b] in self.scene.drivers.iter().filter_map(|d| d.kind.ends()) {
            let other = if a == p {
                Some(b)
            } else if b == p {
                Some(a)
            } else {
                None
            };
            out.extend(other.and_then(|q| (self.point(q)? - at).unit()));
        }
        out
    }

    /// Draws plates: those with guides under the blocks that slide on them, all others over the
    /// blocks that they are pinned to.
    fn plates(&mut self, with_guides: bool) {
        for l in 0..self.forms.len() {
            let Some(LinkForm { plate, .. }) = &self.forms[l] else { continue };
            if plate.is_empty() || with_guides != self.scene.guides.iter().any(|g| g.on.0 == l) {
                continue;
            }
            let items = self.as_opened(Opened::Link(LinkId(l)), sym::plate(self.style, plate));
            self.d.of_link(Some(l));
            self.d.draw(&self.link_id(l), "", items);
        }
        self.d.of_link(None);
    }

    /// Draws bars that are not guides, and the marks of their rigid corners.
    fn bars(&mut self) {
        for l in 0..self.forms.len() {
            let Some(form) = self.forms[l].clone() else { continue };
            let id = self.link_id(l);
            for (k, bar) in form.bars.iter().enumerate() {
                self.gaps(l, *bar);
                self.d.of_link(Some(l));
                let aside = self.aside(LinkId(l), k);
                let items = sym::link(self.style, &[bar.0 + aside, bar.1 + aside]);
                let items = self.as_opened(Opened::Link(LinkId(l)), items);
                self.d.draw(&id, "", items);
            }
            self.d.of_link(Some(l));
            for (corner, one, other) in &form.corners {
                self.d.draw(
                    &format!("{id}-corner"),
                    "",
                    sym::weld(self.style, *corner, *one, *other),
                );
            }
        }
        self.d.of_link(None);
    }

    /// Interrupts the bars of earlier links where a bar passes over them, because two bars that
    /// only cross are not joined.
    fn gaps(&mut self, l: usize, (a, b): (Point, Point)) {
        let Some(u) = (b - a).unit() else { return };
        let width = self.style.link.width_mm;
        let mut gaps = Vec::new();
        for (c, d) in
            self.forms[..l].iter().flatten().flat_map(|f| f.bars.iter().chain(&f.guide_bars))
        {
            let Some(v) = (*d - *c).unit() else { continue };
            let crossing = hodograph_base::geom::cross_lines(a, u, *c, v);
            let free = |p: Point, q: Point| {
                crossing.at.distance(p).min(crossing.at.distance(q)) > CROSSING_FREE_MM
            };
            let on = |p: Point, q: Point| form::on_segment(crossing.at, p, q, SAME_MM);
            let clear =
                || !self.forms.iter().flatten().any(|f| form::inside(crossing.at, &f.plate));
            if crossing.sine.abs() > CROSSING_SINE
                && on(a, b)
                && on(*c, *d)
                && free(a, b)
                && free(*c, *d)
                && clear()
            {
                let half = v * ((width / 2.0 + GAP_MM) / crossing.sine.abs());
                gaps.push((crossing.at - half, crossing.at + half));
            }
        }
        self.d.of_link(None);
        for (from, to) in gaps {
            let stroke = LineStroke::new(width * 1.5).coloured(Colour::WHITE);
            self.d.frame(
                &format!("{}-over", self.link_id(l)),
                "link gap",
                Shape::Line { from, to, stroke },
            );
        }
    }

    fn link_id(&self, l: usize) -> String {
        format!("link-{}", self.scene.links[l].name)
    }

    /// Draws supports, pins and dots, over everything else.
    fn joints(&mut self) {
        for p in (0..self.scene.points.len()).map(PointId) {
            let Some(at) = self.point(p).filter(|_| self.shows_point(p)) else { continue };
            let name = self.scene.point_name(p).to_owned();
            if self.is_fixed_pivot(p) {
                let items = sym::fixed_pivot(self.style, at, self.support_side(p));
                self.d.draw(&format!("pivot-{name}"), "", items);
            } else if let Some(away) = self.knife_edge(p) {
                self.d.draw(
                    &format!("edge-{name}"),
                    "knife-edge",
                    vec![sym::wedge(self.style, at, away)],
                );
            } else if self.is_pin(p) && !self.in_cross(p) {
                self.d.draw(&format!("pin-{name}"), "", sym::pin(self.style, at));
            } else if self.is_reference(p)
                || self.scene.carriers(p).any(|l| self.forms[l.0].is_some())
            {
                self.d.draw(&format!("point-{name}"), "point", sym::dot(self.style, at));
            }
            if self.is_pin(p) {
                self.through_bars(p, at, &name);
            }
        }
    }

    /// Draws a bar across the circle of a joint in its middle: the bar is one link.
    fn through_bars(&mut self, p: PointId, at: Point, name: &str) {
        let others = self.scene.carriers(p).filter(|l| *l != self.scene.ground).count();
        let supported = self.is_fixed_pivot(p);
        if others + usize::from(supported) < 2 || self.block_at(p).is_some() {
            return;
        }
        let mut across = Vec::new();
        for l in self.scene.carriers(p) {
            let Some(form) = &self.forms[l.0] else { continue };
            let through = |(_, (a, b)): &(usize, &(Point, Point))| {
                form::on_segment(at, *a, *b, SAME_MM)
                    && a.distance(at) > SAME_MM
                    && b.distance(at) > SAME_MM
            };
            if form.plate.is_empty() {
                let bars = form.bars.iter().chain(&form.guide_bars).enumerate();
                across.extend(bars.filter(through).take(1).map(|(k, bar)| (l, k, *bar)));
            }
        }
        // Two bars that both continue would look welded: the circle then stays empty.
        if let [(l, k, (a, b))] = across[..] {
            let u = (b - a).unit().unwrap_or(Vec2::ZERO) * self.style.pin_radius_mm;
            let at = at + self.aside(l, k);
            let shape = Shape::Line { from: at - u, to: at + u, stroke: self.style.link.flat() };
            self.d.of_link(Some(l.0));
            self.d.shape(&format!("through-{name}"), "link through", shape);
            self.d.of_link(None);
        }
    }
}
