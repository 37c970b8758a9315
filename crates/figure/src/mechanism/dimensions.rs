//! Draws the given lengths as dimensions (GB/T 4458.4, ISO 129-1): numbers run along their lines,
//! readable from below or from the right, and cover no body.
//!
//! This module chooses the side and the distance of each dimension: the first place at which its
//! number covers nothing and its lines cross least. A dimension without such a place is not drawn;
//! the list of given values contains it instead. More than a hundred dimensions are placed on a
//! raster of occupied cells, so that the time for one dimension does not depend on the number of
//! others.

use std::f64::consts::{FRAC_PI_2, PI};

use hodograph_base::digits::{inked, shortest};
use hodograph_base::geom::{Point, Vec2};
use hodograph_mechanism::position::Path;
use hodograph_paper::paper::drawing::{Drawing, id};
use hodograph_paper::paper::extent::turned_corners;
use hodograph_paper::paper::item::{COARSE, Colour, Dash, FigureItem, PLACED, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::{InkRaster, Obstacles, is_coarse};
use hodograph_paper::paper::symbols as sym;
use hodograph_scene::{
    Cam, GivenQuantity, GuideId, GuidePath, Kind, PointId, PointPlace, QuantityText, Scene, Through,
};

use super::{MechanismDraft, form};

/// Distance of the nearest dimension line, clear of the letters of the joints, distance of the next
/// ones, and their number.
const FIRST_MM: f64 = 9.0;
const NEXT_MM: f64 = 5.0;
const LEVELS: i32 = 9;
/// Distance from the dimension line up to its number.
const GAP_MM: f64 = 0.8;
/// Clear space around a number.
pub(super) const AIR_MM: f64 = 0.7;
/// Costs of a place: a dimension or extension line crosses another line; the dimension line passes
/// over a body; one step farther away; on the side of the mechanism's middle; the number away from
/// the middle of its line; the number beyond the end of its line.
pub(super) const CROSSED_COST: f64 = 8.0;
const OVER_COST: f64 = 12.0;
const FAR_COST: f64 = 1.0;
const INSIDE_COST: f64 = 2.5;
const ASIDE_COST: f64 = 0.8;
const BEYOND_COST: f64 = 2.0;
/// Space around the drawing and around all places of dimensions: a number beyond the end of its
/// line.
const BORDER_MM: f64 = 20.0;
/// Extension of an axis beyond a foot on it.
const FOOT_MM: f64 = 4.0;
/// Positions of a number along its line, as parts of it; after these, beyond either end.
const STATIONS: [f64; 5] = [0.5, 0.35, 0.65, 0.22, 0.78];

/// Returns the name of the dimension between two points.
pub fn name_of(scene: &Scene, a: PointId, b: PointId) -> String {
    format!("dimension-{}-{}", scene.point_name(a), scene.point_name(b))
}

/// Returns the id of a dimension's line in a drawing.
pub fn id_of(scene: &Scene, a: PointId, b: PointId) -> String {
    id("mechanism", &name_of(scene, a, b))
}

/// The two end points of a dimension, its name, and its number.
type DimensionRequest = (Point, Point, String, String);

/// A placed dimension.
pub(super) struct PlacedDimension {
    /// The dimension line with its arrowheads and other lines.
    pub lines: Vec<FigureItem>,
    /// The number.
    pub number: FigureItem,
}

/// A place of a number: its base point and its direction, its cost, and the line that continues
/// under it if it is beyond an end.
pub(super) struct NumberSpot {
    at: Point,
    angle_rad: f64,
    /// The cost.
    pub cost: f64,
    /// The line that continues under the number.
    pub beyond: Option<[Point; 2]>,
}

/// Bodies that no number may cover.
struct Bodies {
    areas: Vec<Vec<Point>>,
    discs: Vec<(Point, f64)>,
}

impl Bodies {
    fn cover(&self, p: Point) -> bool {
        self.areas.iter().any(|a| form::inside(p, a))
            || self.discs.iter().any(|(c, r)| c.distance(p) < *r)
    }
}

/// The method that finds obstacles.
enum ObstacleSearch {
    /// By comparison with everything drawn.
    Each(Bodies),
    /// By occupied cells.
    Cells(InkRaster),
}

impl ObstacleSearch {
    fn new(d: &Drawing, bodies: Bodies, dimensions: usize) -> ObstacleSearch {
        if !is_coarse(dimensions) {
            return ObstacleSearch::Each(bodies);
        }
        let mut raster = InkRaster::of(
            d.obstacles(),
            d.bounds().grown(FIRST_MM + NEXT_MM * f64::from(LEVELS) + BORDER_MM),
        );
        bodies.areas.iter().for_each(|a| raster.add_area(a));
        bodies.discs.iter().for_each(|(c, r)| raster.add_disc(*c, *r));
        ObstacleSearch::Cells(raster)
    }

    /// The cost of the lines of a dimension.
    fn crossed(&mut self, d: &Drawing, (p, q): (Point, Point), lines: &[FigureItem]) -> f64 {
        match self {
            ObstacleSearch::Each(bodies) => {
                let crossed = CROSSED_COST * d.met_by(&lines[2..], AIR_MM) as f64
                    + d.met_by(&lines[..2], 0.1) as f64;
                let over = (1..8).any(|k| bodies.cover(p + (q - p) * (f64::from(k) / 8.0)));
                crossed + if over { OVER_COST } else { 0.0 }
            }
            ObstacleSearch::Cells(raster) => {
                let (met, over) = raster.met_on(p, q);
                let extensions = lines[..2].iter().map(|line| {
                    let Shape::Line { from, to, .. } = line.shape else { return 0 };
                    raster.met_on(from, to).0
                });
                let crossed = CROSSED_COST * met as f64 + extensions.sum::<usize>() as f64;
                crossed + if over { OVER_COST } else { 0.0 }
            }
        }
    }

    /// True if a number with these corners covers nothing.
    fn is_free(&mut self, d: &Drawing, [a, b, c, e]: [Point; 4]) -> bool {
        let part = |p: Point, q: Point, t: f64| p + (q - p) * t;
        match self {
            ObstacleSearch::Each(bodies) => {
                let column =
                    |i: i32| (part(a, b, f64::from(i) / 4.0), part(e, c, f64::from(i) / 4.0));
                let mut grid = (0..=4)
                    .flat_map(|i| [0.0, 0.5, 1.0].map(|j| part(column(i).0, column(i).1, j)));
                !grid.any(|p| bodies.cover(p))
                    && d.met(&Obstacles::of_turned([a, b, c, e]), AIR_MM) == 0
            }
            ObstacleSearch::Cells(raster) => {
                let [along, up] =
                    [(a, b), (a, e)].map(|(p, q)| (q - p).unit().unwrap_or(Vec2::ZERO) * AIR_MM);
                raster.is_free([a - along - up, b + along - up, c + along + up, e - along + up])
            }
        }
    }

    /// Records a dimension that has been drawn.
    fn take(&mut self, placed: &PlacedDimension) {
        if let ObstacleSearch::Cells(raster) = self {
            raster.add(&Obstacles::of(&placed.lines));
            raster.add(&Obstacles::of(std::slice::from_ref(&placed.number)));
        }
    }
}

/// The corners of a number at a place.
pub(super) fn turned(level: &[Point; 4], spot: &NumberSpot) -> [Point; 4] {
    let turn = Vec2::from_angle(spot.angle_rad);
    level.map(|corner| spot.at + corner.to_vec2().rotate_by(turn))
}

impl MechanismDraft<'_> {
    /// Draws all dimensions; radii only if there are few enough to be compared with everything
    /// drawn.
    pub(super) fn dimensions(&mut self) {
        self.feet();
        let wanted = self.lengths();
        if !is_coarse(wanted.len()) && !is_coarse(self.scene.rolling.len()) {
            self.radii();
        }
        let mut ways = ObstacleSearch::new(&self.d, self.bodies(), wanted.len());
        self.draw_dimensions(wanted, &mut ways);
    }

    fn draw_dimensions(&mut self, wanted: Vec<DimensionRequest>, ways: &mut ObstacleSearch) {
        let places: Vec<Point> =
            (0..self.scene.points.len()).filter_map(|p| self.point(PointId(p))).collect();
        let middle = places
            .iter()
            .fold(Point::ORIGIN, |m, p| m + p.to_vec2() * (1.0 / places.len().max(1) as f64));
        let class = if matches!(ways, ObstacleSearch::Cells(_)) {
            format!("dimension {COARSE} {PLACED}")
        } else {
            "dimension".to_owned()
        };
        for (a, b, name, text) in wanted {
            let label = Label::math(text).in_fonts(&self.style.fonts);
            let Some(placed) = self.place_dimension(a, b, &label, middle, ways) else { continue };
            ways.take(&placed);
            self.d.draw(&name, "", placed.lines);
            self.d.draw(&format!("{name}-number"), &class, vec![placed.number]);
        }
    }

    /// The given lengths between two points: these points, a name, and the number.
    fn lengths(&self) -> Vec<DimensionRequest> {
        // The longest come last, because they are farthest out.
        let mut wanted: Vec<DimensionRequest> = Vec::new();
        let of_cam =
            |p: PointId| self.scene.cams.iter().any(|c| c.span == self.scene.points[p.0].span);
        for length in self.scene.lengths.iter().filter(|l| !of_cam(l.a) && !of_cam(l.b)) {
            let (Some(a), Some(b)) = (self.point(length.a), self.point(length.b)) else { continue };
            wanted.push((
                a,
                b,
                name_of(self.scene, length.a, length.b),
                self.dimension(&length.value),
            ));
        }
        for p in (0..self.scene.points.len()).map(PointId).filter(|p| !of_cam(*p)) {
            let Some(at) = self.point(p) else { continue };
            match &self.scene.points[p.0].place {
                PointPlace::InLink { base: (a, b), xy: [x, y] } => {
                    let (Some(a), Some(b)) = (self.point(*a), self.point(*b)) else { continue };
                    let Some(u) = (b - a).unit() else { continue };
                    let foot = a + u * (at - a).dot(u);
                    let name = self.scene.point_name(p);
                    let mut add = |from: Point, to: Point, axis: &str, given: &GivenQuantity| {
                        if from.distance(to) > super::SAME_MM {
                            wanted.push((
                                from,
                                to,
                                format!("dimension-{axis}-{name}"),
                                self.dimension(given),
                            ));
                        }
                    };
                    add(a, foot, "x", x);
                    add(foot, at, "y", y);
                }
                PointPlace::Polar { base: (a, _), length, .. } => {
                    let Some(from) = self.point(*a) else { continue };
                    wanted.push((from, at, name_of(self.scene, *a, p), self.dimension(length)));
                }
                PointPlace::At(_) | PointPlace::Unknown => {}
            }
        }
        wanted.extend(self.offsets().into_iter().map(|(_, offset)| offset));
        wanted.sort_by(|a, b| a.0.distance(a.1).total_cmp(&b.0.distance(b.1)));
        wanted
    }

    /// The offsets of guides, measured from the point that the guide would pass through without an
    /// offset, and those of the followers of cams, from the cam's pivot.
    fn offsets(&self) -> Vec<(GuideId, DimensionRequest)> {
        let mut out = Vec::new();
        for (g, guide) in self.scene.guides.iter().enumerate().filter(|(_, g)| g.rolling.is_none())
        {
            let GuidePath::Line { through, offset, .. } = &guide.path else { continue };
            let follows =
                |c: &&Cam| Some(c.follower) == guide.slider && guide.pin == Some(c.follows.point());
            let cam = self.scene.cams.iter().find(follows).and_then(|c| c.disc.as_ref());
            let from = match (through, offset, cam) {
                (Through::At(_), None, Some(cam)) => self.point(cam.pivot),
                (_, None, _) | (Through::Pin, _, _) => None,
                (Through::Point(p), Some(_), _) => self.point(*p),
                (Through::At([x, y]), Some(_), _) => Some(self.paper(Point::new(x.value, y.value))),
            };
            let (Some(from), Some(Path::Line { through, direction })) =
                (from, self.guide(GuideId(g)))
            else {
                continue;
            };
            let foot = through + direction * (from - through).dot(direction);
            if from.distance(foot) > super::SAME_MM {
                let size = from.distance(foot) / self.mm(1.0);
                let number = match offset {
                    Some(offset) => self.dimension(offset),
                    None => self.length_of("", size),
                };
                out.push((GuideId(g), (from, foot, format!("dimension-offset-{g}"), number)));
            }
        }
        out
    }

    /// Draws the axis of each guide with an offset from its runner to the foot of the offset, which
    /// is marked by nothing else.
    fn feet(&mut self) {
        for (g, (_, foot, ..)) in self.offsets() {
            let pin = self.scene.guides[g.0].pin.and_then(|p| self.point(p));
            let Some(pin) = pin else { continue };
            let Some(u) = (foot - pin).unit() else { continue };
            let stroke = self.style.thin.dashed(Dash::DashDot);
            let shape = Shape::Line { from: pin, to: foot + u * FOOT_MM, stroke };
            self.d.shape(&format!("axis-{}", g.0), "centre", shape);
        }
    }

    /// Plates, wheels and cams.
    fn bodies(&self) -> Bodies {
        let areas = self
            .forms
            .iter()
            .flatten()
            .filter(|f| !f.plate.is_empty())
            .map(|f| f.plate.clone())
            .collect();
        let mut discs = Vec::new();
        for pair in &self.scene.rolling {
            let round = |i: usize| {
                let centre = self.point(pair.centres()[i]?)?;
                Some((centre, centre.distance(self.point(pair.at[i])?)))
            };
            discs
                .extend([0, 1].into_iter().filter(|i| pair.hollow() != Some(*i)).filter_map(round));
        }
        for c in &self.scene.cams {
            if let Some((centre, radius)) = c.circle
                && let Some(centre) = self.point(centre)
            {
                discs.push((centre, self.mm(radius)));
            }
        }
        Bodies { areas, discs }
    }

    fn place_dimension(
        &self,
        a: Point,
        b: Point,
        label: &Label,
        middle: Point,
        ways: &mut ObstacleSearch,
    ) -> Option<PlacedDimension> {
        let along = (b - a).unit()?;
        let level = turned_corners(Point::ORIGIN, 0.0, label, self.style.small_mm)?;
        let inside = along.cross(middle - a).signum();
        let mut best: Option<(f64, f64, NumberSpot)> = None;
        for step in 0..LEVELS {
            for side in [-inside, inside] {
                let side = if side == 0.0 { 1.0 } else { side };
                let offset = side * (FIRST_MM + NEXT_MM * f64::from(step));
                let base =
                    FAR_COST * f64::from(step) + if side == inside { INSIDE_COST } else { 0.0 };
                let ends = sym::dimension_line(a, b, offset);
                let mut crossed = None;
                for spot in self.spots(ends, &level) {
                    let dearer = |best: &Option<(f64, f64, NumberSpot)>, cost: f64| {
                        best.as_ref().is_some_and(|(least, ..)| *least <= cost)
                    };
                    if dearer(&best, base + spot.cost)
                        || !ways.is_free(&self.d, turned(&level, &spot))
                    {
                        continue;
                    }
                    let crossed = *crossed.get_or_insert_with(|| {
                        ways.crossed(&self.d, ends, &sym::dimension(self.style, a, b, offset))
                    });
                    let cost = base + crossed + spot.cost;
                    if !dearer(&best, cost) {
                        best = Some((cost, offset, spot));
                    }
                }
            }
        }
        let (_, offset, spot) = best?;
        let mut lines = sym::dimension(self.style, a, b, offset);
        let beyond = |[from, to]: [Point; 2]| {
            FigureItem::new("dimension", Shape::Line { from, to, stroke: self.style.thin })
        };
        lines.extend(spot.beyond.map(beyond));
        Some(PlacedDimension { lines, number: self.written(&spot, label) })
    }

    /// A number at its place.
    pub(super) fn written(&self, spot: &NumberSpot, label: &Label) -> FigureItem {
        let shape = Shape::Turned {
            at: spot.at,
            angle_rad: spot.angle_rad,
            label: label.clone(),
            size_mm: self.style.small_mm,
            colour: Colour::BLACK,
        };
        FigureItem::new("", shape)
    }

    /// The places of a number along its line; `level` has the corners of its box in horizontal
    /// position.
    pub(super) fn spots(&self, (p, q): (Point, Point), level: &[Point; 4]) -> Vec<NumberSpot> {
        let length = p.distance(q);
        let Some(along) = (q - p).unit() else { return Vec::new() };
        // Readable from below, or from the right.
        let mut angle_rad = along.angle();
        if angle_rad > FRAC_PI_2 + 1e-6 {
            angle_rad -= PI;
        } else if angle_rad <= -FRAC_PI_2 + 1e-6 {
            angle_rad += PI;
        }
        let up = Vec2::from_angle(angle_rad).perp();
        let [c0, c1, ..] = level;
        let (wide, below) = (c1.x - c0.x, -c0.y);
        let spot = |at: Point, cost: f64, beyond| NumberSpot {
            at: at + up * (GAP_MM + below.max(0.0)),
            angle_rad,
            cost,
            beyond,
        };
        let heads = 2.0 * self.style.thin_head.length_mm;
        let mut out = Vec::new();
        for (k, part) in STATIONS.into_iter().enumerate() {
            if part.min(1.0 - part) * length >= wide / 2.0 + if k == 0 { 0.0 } else { heads / 2.0 }
                && length >= wide + 1.0
            {
                out.push(spot(p + along * (part * length), ASIDE_COST * k as f64, None));
            }
        }
        for (end, out_of) in [(q, along), (p, -along)] {
            out.push(spot(
                end + out_of * (wide / 2.0 + 1.2),
                BEYOND_COST,
                Some([end, end + out_of * (wide + 2.0)]),
            ));
        }
        out
    }

    /// A given length at its dimension line, without its sign: the picture shows the side.
    fn dimension(&self, given: &GivenQuantity) -> String {
        let size = given.value.abs();
        let text = given.text.trim_start_matches(['-', '−']);
        self.length_of(text, size)
    }

    /// A length as the number of a dimension, as it is written where a text is given.
    pub(super) fn length_of(&self, text: &str, value: f64) -> String {
        number(&self.scene.told(Kind::Length, text, value), value)
    }
}

/// A length as the number of a dimension: millimetres, rounded to a micrometre, without their name;
/// all else with its unit.
fn number(told: &QuantityText, si: f64) -> String {
    let rounded = |value: f64| inked(&shortest((value * 1e3).round() / 1e3));
    match told {
        QuantityText::AsWritten(number, unit) if unit.name() != "mm" => unit.label(&inked(number)),
        QuantityText::Computed(value, unit) if unit.name() != "mm" => unit.label(&rounded(*value)),
        QuantityText::AsWritten(..) | QuantityText::Computed(..) | QuantityText::Usual => {
            shortest((si * 1e6).round() / 1e3)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hodograph_base::notation::Notation;
    use hodograph_paper::paper::style::Style;
    use hodograph_scene as scene;
    use hodograph_worked::worked::{Scope, work};

    /// A crank-rocker with `n` points on its coupler, each with two coordinates.
    fn scene_of(n: usize) -> Scene {
        let names: Vec<String> = (0..n).map(|k| format!("\"P{k}\"")).collect();
        let place = |k: usize| {
            format!(
                r#"{{"base": "BC", "x": "{} mm", "y": "{} mm"}}"#,
                5 + 240 * k / n,
                20 + (37 * k) % 61
            )
        };
        let points: Vec<String> =
            names.iter().enumerate().map(|(k, name)| format!("{name}: {}", place(k))).collect();
        let text = format!(
            r#"{{"links": {{"1": ["A", "B"], "2": ["B", "C", {}], "3": ["C", "D"], "4": ["A", "D"]}}, "ground": "4", "points": {{{}}}, "side": {{"C": "left of BD"}},
            "lengths": {{"AB": "100 mm", "BC": "250 mm", "CD": "200 mm", "AD": "300 mm"}}, "driver": {{"link": "1", "angle": "60 deg", "omega": "10 rad/s"}},
            "find": ["omega_3"]}}"#,
            names.join(", "),
            points.join(", ")
        );
        scene::read(&text).unwrap().value
    }

    /// More than a hundred dimensions: twice as many take twice the work, and their class says that
    /// they are placed coarsely.
    #[test]
    fn work_grows_with_the_number_of_dimensions() {
        let (style, notation, course) = (
            Style::default(),
            Notation::of_language(hodograph_scene::Lang::En),
            super::super::SeriesFeatures::default(),
        );
        let mut last: Option<f64> = None;
        for n in [60, 120, 240, 480] {
            let scene = scene_of(n);
            let worked = work(&scene, Scope::Figure).unwrap().value;
            let mut draft = MechanismDraft::new(&style, &scene, &worked, &notation, &course);
            draft.everything();
            let wanted = draft.lengths();
            let count = wanted.len() as f64;
            let mut ways = ObstacleSearch::new(&draft.d, draft.bodies(), wanted.len());
            let before = if let ObstacleSearch::Cells(raster) = &ways {
                raster.touched()
            } else {
                panic!("{n} are few")
            };
            draft.draw_dimensions(wanted, &mut ways);
            let ObstacleSearch::Cells(raster) = &ways else { panic!("{n} are few") };
            let each = (raster.touched() - before) as f64 / count;
            assert!(
                last.is_none_or(|last| each < 1.2 * last),
                "{n} points: {each} cells for each dimension, {last:?} before"
            );
            let coarse = draft
                .d
                .finish()
                .items
                .iter()
                .filter(|i| i.class.contains("dimension coarse label"))
                .count();
            assert!(coarse > 3, "{n} points: {coarse}");
            last = Some(each);
        }
    }

    /// The base circle and the roller of a cam have radii, and the offset of the follower has a
    /// dimension without a sign; the centre of curvature, which the file does not place, has none.
    #[test]
    fn cams_and_rollers_are_dimensioned() {
        let text = scene::templates::get("cam-offset-roller").unwrap();
        let scene = scene::read(text).unwrap().value;
        let worked = work(&scene, Scope::Figure).unwrap().value;
        let (style, notation) =
            (Style::default(), Notation::of_language(hodograph_scene::Lang::En));
        let course = super::super::SeriesFeatures::default();
        let mut draft = MechanismDraft::new(&style, &scene, &worked, &notation, &course);
        draft.everything();
        draft.dimensions();
        let part = draft.d.finish();
        let mut numbers: Vec<&str> = part
            .items
            .iter()
            .filter_map(|i| match &i.shape {
                Shape::Turned { label, .. } => Some(label.source()),
                _ => None,
            })
            .collect();
        numbers.sort_unstable();
        assert_eq!(numbers, ["10", "R10", "R30"]);
        assert!(part.items.iter().any(|i| i.id == "mechanism-axis-0"), "the foot is marked");
    }
}
