//! Draws rolling pairs: pitch circles of gears in chain lines, wheels and their tracks in full
//! lines, and the contacts.
//!
//! Teeth are not drawn: the pitch circle is the rolling contour. Hollow contours, and those on the
//! ground, are hatched on the side of their material.

use hodograph_board::construct::scale::DWARFS;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};

use hodograph_base::geom::{Point, Vec2};
use hodograph_mechanism::mechanism::Opened;
use hodograph_paper::paper::extent::{Rect, on_circle};
use hodograph_paper::paper::item::{Dash, LineStroke, PathPiece, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_paper::paper::symbols as sym;
use hodograph_scene::{GuideId, LinkId, Normal, PointId, Rolling, RollingId, Touch};

use super::MechanismDraft;
use super::letters::NumberPlace;
use super::slides::GUIDE_MM;

/// Half the side of the cross at a contact.
const CROSS_MM: f64 = 1.1;
/// Distance of a ring's rim outside its pitch circle.
const RIM_MM: f64 = 1.6;
/// Half the angle over which the rim of the ground is hatched beside a contact.
const HATCHED_RAD: f64 = FRAC_PI_4;
/// Length of a rack on either side of the contact.
pub(super) const RACK_HALF_MM: f64 = 22.0;

/// Half length of the arc drawn of a ring too large for the figure, as a part of the rest of the
/// figure: the arc passes behind all of it.
const ARC_PART: f64 = 0.6;
/// Range of angles for the number of teeth, measured from the middle of the side away from the
/// contact.
const TEETH_RAD: [f64; 2] = [0.3, 1.1];

/// A round contour of a pair, on paper.
struct Round {
    link: LinkId,
    centre: Point,
    radius_mm: f64,
    hollow: bool,
    teeth: Option<u32>,
}

impl MechanismDraft<'_> {
    /// The round contours of a pair.
    fn rounds(&self, pair: &Rolling) -> Vec<Round> {
        let teeth = pair.flanks.as_ref().map(|f| f.teeth);
        let round = |i: usize| {
            let (centre, contact) = (self.point(pair.centres()[i]?)?, self.point(pair.at[i])?);
            let (radius_mm, hollow) = (centre.distance(contact), pair.hollow() == Some(i));
            Some(Round {
                link: pair.links[i],
                centre,
                radius_mm,
                hollow,
                teeth: teeth.and_then(|z| z[i]),
            })
        };
        [0, 1].into_iter().filter_map(round).collect()
    }

    /// The largest rolling circle about a link's centre, if any: centre and radius; for a ring, the
    /// radius of its rim.
    pub(super) fn wheel(&self, l: LinkId) -> Option<(Point, f64)> {
        let of_link = |hollow| move |r: &Round| r.link == l && r.hollow == hollow;
        let largest = |hollow: bool| {
            let all = self
                .scene
                .rolling
                .iter()
                .flat_map(|pair| self.rounds(pair))
                .filter(of_link(hollow));
            all.max_by(|a, b| a.radius_mm.total_cmp(&b.radius_mm))
        };
        let rim = |r: Round| (r.centre, r.radius_mm + RIM_MM);
        largest(false).map(|r| (r.centre, r.radius_mm)).or_else(|| largest(true).map(rim))
    }

    /// The range of angles over which a circle is drawn: the full circle, or an arc about the
    /// contact if the circle would dwarf the figure.
    fn span(&self, pair: &Rolling, round: &Round) -> [f64; 2] {
        let points = (0..self.scene.points.len()).filter_map(|p| self.point(PointId(p)));
        let wheels = self.scene.rolling.iter().flat_map(|p| self.rounds(p)).filter(|r| !r.hollow);
        let boxes = points
            .map(|p| Rect::new(p, p))
            .chain(wheels.map(|r| Rect::new(r.centre, r.centre).grown(r.radius_mm)));
        let rest = boxes.reduce(Rect::union).map_or(0.0, |b| b.width_mm().max(b.height_mm()));
        match self.point(pair.at_of(round.link)) {
            Some(contact) if round.hollow && 2.0 * round.radius_mm > DWARFS * rest => {
                let (middle, half) =
                    ((contact - round.centre).angle(), ARC_PART * rest / round.radius_mm);
                [middle - half, middle + half]
            }
            Some(_) | None => [0.0, TAU],
        }
    }

    /// Draws all wheels and tracks, behind the links.
    pub(super) fn wheels(&mut self) {
        let scene = self.scene;
        let mut drawn: Vec<(LinkId, Point, f64)> = Vec::new();
        for pair in &scene.rolling {
            for round in
                self.rounds(pair).into_iter().filter(|r| self.shows(r.link)).collect::<Vec<_>>()
            {
                // Gears of one link about one centre that mesh twice are drawn once.
                let same = |d: &(LinkId, Point, f64)| {
                    d.0 == round.link
                        && d.1.distance(round.centre) < super::SAME_MM
                        && (d.2 - round.radius_mm).abs() < super::SAME_MM
                };
                if !drawn.iter().any(same) {
                    drawn.push((round.link, round.centre, round.radius_mm));
                    self.round(pair, &round);
                }
                if round.link == scene.ground || round.hollow && !pair.kind.is_toothed() {
                    self.hatched_rim(pair, &round);
                }
            }
            if let Touch::Point(Normal::Square { guide, .. }) = pair.touch()
                && self.shows(pair.links[0])
            {
                match pair.kind.is_flexible() {
                    true => self.rope(pair, guide),
                    false => self.track(pair, guide),
                }
            }
        }
        self.belts();
    }

    /// The stroke of a contour: a chain line for the pitch line of teeth, otherwise a full line.
    pub(super) fn contour_stroke(&self, pair: &Rolling) -> LineStroke {
        if pair.kind.is_toothed() {
            self.style.outline.dashed(Dash::DashDot)
        } else {
            self.style.outline
        }
    }

    /// True if a wheel on a moving axis has a redundant mesh.
    fn repeats(&self, round: &Round) -> bool {
        let still = self.scene.links[round.link.0].points.iter().any(|p| self.on_ground(*p));
        let opened = |(k, pair): (usize, &Rolling)| {
            pair.links.contains(&round.link)
                && self.worked.mechanism.is_opened(&Opened::Rolling(RollingId(k)))
        };
        round.link != self.scene.ground
            && !still
            && self.scene.rolling.iter().enumerate().any(opened)
    }

    /// Draws the circle itself.
    fn round(&mut self, pair: &Rolling, round: &Round) {
        let ground = round.link == self.scene.ground;
        let l = (!ground).then_some(round.link.0);
        let id = format!("wheel-{}", self.scene.link_name(round.link));
        let class = if ground { "ground wheel" } else { "wheel" };
        // A redundant planet is in the background.
        let stroke = if self.repeats(round) {
            self.style.thin.dashed(Dash::Dashed)
        } else {
            self.contour_stroke(pair)
        };
        self.d.of_link(l);
        // A line, not a disc: labels may be inside.
        let [from_rad, to_rad] = self.span(pair, round);
        let circle = |radius_mm, stroke| Shape::Arc {
            centre: round.centre,
            radius_mm,
            from_rad,
            to_rad,
            stroke,
        };
        let traced = self.rolling.is_some_and(|links| {
            round.link == links[0] && pair.links.iter().all(|l| links.contains(l))
        });
        let owner =
            if traced { 0 } else { self.d.shape(&id, class, circle(round.radius_mm, stroke)) };
        if round.hollow && pair.kind.is_toothed() && !ground {
            self.d.shape(&id, class, circle(round.radius_mm + RIM_MM, self.style.outline));
        }
        let contact = self.point(pair.at_of(round.link)).unwrap_or(round.centre);
        let away = (round.centre - contact).unit().unwrap_or(Vec2::new(0.0, 1.0));
        if let Some(teeth) = round.teeth {
            let angles = TEETH_RAD.map(|a| away.angle() + a);
            let text = Label::math(format!("z = {teeth}"));
            let request = LabelRequest::along_arc(
                text,
                self.style.small_mm,
                round.centre,
                round.radius_mm,
                angles,
                stroke.width_mm / 2.0,
            );
            self.d.label(
                &format!("teeth-{}", self.scene.link_name(round.link)),
                "teeth",
                request.owned(owner).optional(true),
            );
        }
        self.d.of_link(None);
        // A wheel without a bar has its number inside its rim, away from the contact.
        let has_bars = self
            .forms
            .get(round.link.0)
            .is_some_and(|f| f.as_ref().is_some_and(|f| !f.segments().is_empty()));
        if !ground && !has_bars && self.number_at[round.link.0].is_none() {
            let along = away.rotate_by(Vec2::from_angle(-FRAC_PI_4));
            let (from, to) = (
                on_circle(round.centre, round.radius_mm, along.angle()),
                on_circle(round.centre, round.radius_mm, away.angle()),
            );
            self.number_at[round.link.0] = Some(NumberPlace::Along(from, to, owner));
        }
    }

    /// Hatches a rim beside its contact: outside a hollow one, inside a full one.
    fn hatched_rim(&mut self, pair: &Rolling, round: &Round) {
        let at = pair.at_of(round.link);
        let Some(contact) = self.point(at) else { return };
        let middle = (contact - round.centre).angle();
        let (sign, base) =
            if round.hollow { (1.0, round.radius_mm) } else { (-1.0, round.radius_mm) };
        let half = HATCHED_RAD.min(GUIDE_MM / round.radius_mm);
        // The strokes remain fixed while the contact moves along the rim: each is drawn when its
        // part of the rim is near the contact.
        let around = (TAU * round.radius_mm / self.style.hatch_pitch_mm).floor().max(1.0);
        let step = TAU / around;
        let count = (2.0 * half / step).floor().max(1.0) as i64;
        let first = ((middle - half) / step).ceil() as i64;
        let mut strokes: Vec<i64> = (first..first + count).collect();
        strokes.sort_by_key(|k| k.rem_euclid(count));
        let feet: Vec<Point> =
            strokes.into_iter().map(|k| on_circle(round.centre, base, k as f64 * step)).collect();
        let depth = |p: Point| {
            let out = (p - round.centre).unit().unwrap_or(Vec2::ZERO);
            p + (out * sign + out.perp()) * self.style.hatch_depth_mm
        };
        let pieces = feet
            .iter()
            .flat_map(|p| [PathPiece::Move(*p), PathPiece::Line(depth(*p))])
            .skip(1)
            .collect();
        let id = format!("track-{}", self.scene.point_name(at));
        self.d.shape(
            &id,
            "ground hatch",
            Shape::Path {
                start: feet[0],
                pieces,
                closed: false,
                stroke: Some(self.style.thin),
                fill: None,
            },
        );
        let (from_rad, to_rad) = (middle - half, middle + half);
        let arc = Shape::Arc {
            centre: round.centre,
            radius_mm: base,
            from_rad,
            to_rad,
            stroke: self.style.outline,
        };
        self.d.shape(&id, "ground line", arc);
    }

    /// Draws a straight track or rack under its wheel.
    fn track(&mut self, pair: &Rolling, guide: GuideId) {
        let (Some(at), Some(hodograph_mechanism::position::Path::Line { direction, .. })) =
            (self.point(pair.at[0]), self.guide(guide))
        else {
            return;
        };
        let on = pair.links[0];
        let [back, ahead] = self.travel(guide);
        let half = (self.wheel(pair.links[1]).map_or(0.0, |w| w.1) / 2.0).max(GUIDE_MM / 2.0);
        let id = format!("track-{}", self.scene.point_name(pair.at[0]));
        if on == self.scene.ground {
            // The material is on the right of the direction, because the wheel is on its left.
            let items = sym::ground_line(
                self.style,
                at + direction * (back - half),
                at + direction * (ahead + half),
            );
            self.d.draw(&id, "", items);
            return;
        }
        self.d.of_link(Some(on.0));
        let half = half.max(RACK_HALF_MM);
        // The rack extends to the points of its link, and holds them by a stem if none is on it.
        let held: Vec<Point> =
            self.scene.links[on.0].points.iter().filter_map(|p| self.point(*p)).collect();
        let foot = |p: &Point| at + direction * (*p - at).dot(direction);
        let reach = held
            .iter()
            .map(|p| (*p - at).dot(direction))
            .fold([back - half, ahead + half], |[a, b], s| [a.min(s), b.max(s)]);
        let [from, to] = reach.map(|s| at + direction * s);
        // Like a ring: the pitch line as a chain line, the body behind it as a full line.
        let toothed = pair.kind.is_toothed();
        let behind = if toothed { -direction.perp() * RIM_MM } else { Vec2::ZERO };
        let owner = if toothed {
            let stroke = self.style.outline;
            self.d.shape(
                &id,
                "wheel",
                Shape::Line { from, to, stroke: stroke.dashed(Dash::DashDot) },
            );
            let pieces = vec![
                PathPiece::Line(from + behind),
                PathPiece::Line(to + behind),
                PathPiece::Line(to),
            ];
            self.d.shape(
                &id,
                "wheel",
                Shape::Path {
                    start: from,
                    pieces,
                    closed: false,
                    stroke: Some(stroke),
                    fill: None,
                },
            )
        } else {
            self.d.draw(&id, "", sym::link(self.style, &[from, to]))
        };
        let nearest =
            held.iter().min_by(|p, q| p.distance(foot(p)).total_cmp(&q.distance(foot(q))));
        if let Some(p) = nearest.filter(|p| p.distance(foot(p)) > super::SAME_MM) {
            let near = if (*p - foot(p)).dot(behind) > 0.0 { foot(p) + behind } else { foot(p) };
            self.d.draw(&id, "", sym::link(self.style, &[*p, near]));
        }
        self.d.of_link(None);
        if self.number_at[on.0].is_none() && self.forms[on.0].is_none() {
            self.number_at[on.0] = Some(NumberPlace::Along(from, at, owner));
        }
    }

    /// Draws crosses at the contacts, with their arms between the normal and the tangent: along
    /// either direction bars and contours would hide them.
    pub(super) fn contacts(&mut self) {
        let scene = self.scene;
        for pair in &scene.rolling {
            // Both ends of a strand; of a contact its one point.
            for p in pair.at.into_iter().skip(usize::from(pair.contact().is_some())) {
                let Some(at) = self.point(p) else { continue };
                let normal = self.rounds(pair).first().map_or(0.0, |r| (at - r.centre).angle());
                let arm = |k: f64| Vec2::from_angle(normal + FRAC_PI_4 + FRAC_PI_2 * k) * CROSS_MM;
                let pieces = vec![
                    PathPiece::Line(at - arm(0.0)),
                    PathPiece::Move(at + arm(1.0)),
                    PathPiece::Line(at - arm(1.0)),
                ];
                let shape = Shape::Path {
                    start: at + arm(0.0),
                    pieces,
                    closed: false,
                    stroke: Some(self.style.outline),
                    fill: None,
                };
                self.d.shape(&format!("contact-{}", scene.point_name(p)), "contact", shape);
            }
        }
    }

    /// The place for the arrow of a driven wheel without a line of its own: its centre, a direction
    /// free of contacts, and the radius.
    pub(super) fn free_side(&self, l: LinkId) -> Option<(Point, Vec2, f64)> {
        let (centre, radius) = self.wheel(l)?;
        let contacts: Vec<Vec2> = self
            .scene
            .rolling
            .iter()
            .filter(|r| r.links.contains(&l))
            .filter_map(|r| (self.point(r.at_of(l))? - centre).unit())
            .chain(self.scene.links[l.0].points.iter().flat_map(|p| self.leaving(*p)))
            .collect();
        let nearest = |u: &Vec2| contacts.iter().map(|c| c.dot(*u)).fold(-1.0, f64::max);
        let sides = (0..16).map(|k| Vec2::from_angle(TAU * f64::from(k) / 16.0));
        let free = sides.min_by(|a, b| nearest(a).total_cmp(&nearest(b)))?;
        Some((centre, free, radius))
    }
}
