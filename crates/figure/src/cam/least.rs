//! Draws the s′–s diagram with the least base circle for an allowed pressure angle: the wedges that
//! decide, the region of the cam's centre that keeps the angles, and the nearest place in it.

use super::{CamDrawing, heading};
use hodograph_base::cam::{Follower, LeastCam, PressureDiagram, PressureWedge};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::tr;
use hodograph_board::construct::scale::choose_in;
use hodograph_paper::paper::item::{Colour, Dash, Figure, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_paper::paper::style::Style;
use hodograph_report::cam::{LeastCams, Report};
use hodograph_scene::{Kind, Lang};
use std::f64::consts::FRAC_PI_2;

/// Approximate length of the drawing's larger side (mm).
const SIZE_MM: f64 = 150.0;
/// Radius of the arc of an allowed angle (mm).
const ARC_MM: f64 = 13.0;
/// Length of the axis of a wedge, and of its side beyond the apex (mm).
const AXIS_MM: f64 = 22.0;
const BEYOND_MM: f64 = 6.0;
/// Extent of the region below the start of the rise, as a multiple of the base circle.
const BELOW: f64 = 2.2;
const REGION: Colour = Colour::grey(222);

/// Draws the figure.
pub fn figure(report: &Report, least: &LeastCams, style: &Style, lang: Lang) -> Figure {
    let Some(diagram) = PressureDiagram::of(&report.turning.disc, least.allowed) else {
        return CamDrawing::new(report, style, 1.0).finish(1.0, String::new(), "", lang);
    };
    let start = diagram.start();
    // The lift goes up.
    let lift = diagram.wedges.first().map_or(Vec2::new(0.0, 1.0), |w| -w.inward);
    let upright = Vec2::from_angle(FRAC_PI_2 - lift.angle());
    let below =
        least.best.pitch_base.max(least.kept.as_ref().map_or(0.0, |k| k.pitch_base)) * BELOW;
    let about = start - lift * (0.5 * below);
    let region = diagram.region(about, 0.5 * below);
    let far = diagram.wedges.iter().map(|w| (w.apex - about).norm()).fold(0.6 * below, f64::max);
    let unit =
        report.scene.book.chosen(Kind::Length).map_or(1.0, hodograph_scene::book::BookUnit::size);
    let mu = choose_in(unit, [2.0 * far; 2], [SIZE_MM; 2]);
    let shown = diagram.wedges.iter().flat_map(|w| [w.apex, w.at]).chain(region.iter().copied());
    let about = middle(shown.chain([start]).map(|p| p.rotate_by(upright)))
        .rotate_by(Vec2::new(upright.x, -upright.y));
    let mut d = AlphaDrawing { d: CamDrawing::new(report, style, mu), about, upright };
    d.region(&region);
    d.axes(report, start, &diagram.wedges);
    d.curve(&diagram.wedges);
    for (k, (w, side)) in least.best.touched.iter().enumerate() {
        d.wedge(k, w, *side, &least.best, lang);
    }
    d.centre("O", start, &least.best);
    if let Some(kept) = least
        .kept
        .as_ref()
        .filter(|k| (k.centre - least.best.centre).norm() > 0.02 * least.best.pitch_base)
    {
        d.centre("O′", start, kept);
    }
    let title = tr!(lang, "least base circle");
    let caption = match report.turning.disc.follower {
        Follower::Translating { .. } => tr!(
            lang,
            "thick: s′–s diagram; grey: places of the cam's centre that keep the angles; O: the best, O′: with the given offset"
        ),
        Follower::Oscillating { .. } => tr!(
            lang,
            "thick: apices of the wedges; grey: places of the cam's centre that keep the angles; O: the best; P: pivot"
        ),
    };
    let title = heading(report.scene, title, lang);
    d.d.finish(mu, title, caption, lang)
}

/// Returns the middle of the box around some places.
fn middle(places: impl Iterator<Item = Vec2>) -> Vec2 {
    let wide = |[low, high]: [Vec2; 2], p: Vec2| {
        [Vec2::new(low.x.min(p.x), low.y.min(p.y)), Vec2::new(high.x.max(p.x), high.y.max(p.y))]
    };
    let none =
        [Vec2::new(f64::INFINITY, f64::INFINITY), Vec2::new(f64::NEG_INFINITY, f64::NEG_INFINITY)];
    let [low, high] = places.fold(none, wide);
    (low + high) * 0.5
}

/// The drawing, turned so that the lift goes up.
struct AlphaDrawing<'a> {
    d: CamDrawing<'a>,
    /// The place at the middle of the paper.
    about: Vec2,
    upright: Vec2,
}

impl AlphaDrawing<'_> {
    fn at(&self, place: Vec2) -> Point {
        self.d.at((place - self.about).rotate_by(self.upright))
    }

    fn along(&self, way: Vec2) -> Vec2 {
        way.rotate_by(self.upright)
    }

    fn region(&mut self, region: &[Vec2]) {
        if region.len() < 3 {
            return;
        }
        let points: Vec<Point> = region.iter().map(|p| self.at(*p)).collect();
        let shape = Shape::Polyline { points, closed: true, stroke: None, fill: Some(REGION) };
        self.d.draw("region", shape, None);
    }

    fn dot(&mut self, class: &str, at: Point) {
        let shape = Shape::Circle {
            centre: at,
            radius_mm: self.d.style.dot_radius_mm,
            stroke: None,
            fill: Some(Colour::BLACK),
        };
        self.d.draw(class, shape, None);
    }

    /// Draws the path of the follower's point; the axis of s′ for one that slides, the pivot for one
    /// that turns.
    fn axes(&mut self, report: &Report, start: Vec2, wedges: &[PressureWedge]) {
        let (stroke, head) = (self.d.style.thin, self.d.style.thin_head);
        let chain = stroke.dashed(Dash::DashDot);
        let points: Vec<Point> = wedges.iter().map(|w| self.at(w.at)).collect();
        let path = Shape::Polyline { points, closed: false, stroke: Some(chain), fill: None };
        self.d.draw("path", path, None);
        let from = self.at(start);
        match report.turning.disc.follower {
            Follower::Translating { .. } => {
                let reach = |w: &PressureWedge| (self.at(w.apex) - self.at(w.at)).x;
                let [low, high] = wedges
                    .iter()
                    .map(reach)
                    .fold([0.0f64; 2], |[low, high], x| [low.min(x), high.max(x)]);
                // The axis points to where the rise is.
                let rising = wedges.iter().find(|w| w.rising && w.apex != w.at).map_or(1.0, reach);
                let [tail, tip] = if rising < 0.0 { [high, low] } else { [low, high] };
                let sign = if rising < 0.0 { -1.0 } else { 1.0 };
                let tip = from + Vec2::new(tip + sign * 2.0 * BEYOND_MM, 0.0);
                let tail = from + Vec2::new(tail, 0.0);
                self.d.draw("axis", Shape::Arrow { from: tail, to: tip, stroke, head }, None);
                self.d.label("\\text{d}s/\\text{d}\\varphi", tip, 0.8, Vec2::new(sign, 0.0));
                let top = wedges.iter().map(|w| self.at(w.at).y).fold(from.y, f64::max);
                let top = Point::new(from.x, top + 2.0 * BEYOND_MM);
                self.d.draw("axis", Shape::Arrow { from, to: top, stroke, head }, None);
                self.d.label("s", top, 0.8, Vec2::new(0.0, 1.0));
            }
            Follower::Oscillating { pivot, .. } => {
                let pivot = self.at(pivot);
                self.d.draw("arm", Shape::Line { from: pivot, to: from, stroke }, None);
                self.dot("pivot", pivot);
                self.d.label("P", pivot, 1.0, Vec2::ZERO);
            }
        }
        self.dot("start", from);
        self.d.label("B_0", from, 1.0, Vec2::ZERO);
    }

    /// Draws the apices of the wedges.
    fn curve(&mut self, wedges: &[PressureWedge]) {
        let link = Some(self.d.report.cam.follower.0);
        for rising in [true, false] {
            let own = wedges.iter().filter(|w| w.rising == rising);
            let points: Vec<Point> = own.map(|w| self.at(w.apex)).collect();
            let stroke = Some(self.d.style.link);
            let shape = Shape::Polyline { points, closed: false, stroke, fill: None };
            self.d.draw("diagram", shape, link);
        }
    }

    /// Draws the side of a wedge that decides, with its angle.
    fn wedge(&mut self, k: usize, w: &PressureWedge, side: usize, least: &LeastCam, lang: Lang) {
        let (thin, dashed) = (self.d.style.thin, self.d.style.thin.dashed(Dash::Dashed));
        let turn = if side == 0 { w.most } else { -w.most };
        let apex = self.at(w.apex);
        let inward = self.along(w.inward);
        let way = inward.rotate_by(Vec2::from_angle(turn));
        let reach = (self.at(least.centre) - apex).norm() + 3.0 * BEYOND_MM;
        let (from, to) = (apex - way * BEYOND_MM, apex + way * reach);
        self.d.draw("limit", Shape::Line { from, to, stroke: thin }, None);
        let axis = Shape::Line { from: apex, to: apex + inward * AXIS_MM, stroke: dashed };
        self.d.draw("limit-axis", axis, None);
        let (from_rad, to_rad) = (inward.angle(), inward.angle() + turn);
        let arc = Shape::Arc { centre: apex, radius_mm: ARC_MM, from_rad, to_rad, stroke: thin };
        self.d.draw("allowed", arc, None);
        let name = match (w.rising, lang) {
            (true, _) => "[\\alpha]",
            (false, _) => "[\\alpha′]",
        };
        let label = Label::math(name).in_fonts(&self.d.style.fonts);
        let (small, fonts) = (self.d.style.small_mm, [from_rad, to_rad]);
        self.d.want(LabelRequest::along_arc(label, small, apex, ARC_MM, fonts, 0.2));
        self.dot(&format!("apex-{k}"), apex);
    }

    /// Draws a centre of the cam with the radius of its base circle.
    fn centre(&mut self, name: &str, start: Vec2, of: &LeastCam) {
        let (at, from) = (self.at(of.centre), self.at(start));
        let (stroke, head) = (self.d.style.thin, self.d.style.thin_head);
        self.d.draw("radius", Shape::Arrow { from: at, to: from, stroke, head }, None);
        if name == "O" {
            let label = Label::math("r_b").in_fonts(&self.d.style.fonts);
            self.d.want(LabelRequest::along(label, self.d.style.small_mm, at, from, 0.2));
        }
        self.dot("centre", at);
        self.d.label(name, at, 1.0, Vec2::new(0.0, -1.0));
    }
}
