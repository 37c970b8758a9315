//! The link that carries a cam and its follower, and their places in it.
//!
//! A law, and the choice of a piece from lengths alone, need one angle of the cam and one
//! coordinate of the follower, both measured in one link. On this link the cam turns about a pivot,
//! driven, and the follower slides or turns. It is usually the ground; a crank, a coupler or a
//! slide is possible too, and so is a carrier that is driven round a fixed cam. Places are texts in
//! the axes of that link (origin at its first point, x toward the second), so that higher-precision
//! numbers can be read from them as from the file.

use super::super::model::*;
use super::super::raw::RawQuantity;
use super::super::units::RequiredQuantity;
use super::expand::CamReplacement;
use super::place::{
    CarriedFollower, NumberText, OnPivot, PointTexts, apart, direction, locals, spot,
};
use hodograph_base::diag::{Both, Faults, both};

/// The fault that prevents placing a cam, and its remedy.
#[derive(Clone, Debug)]
pub(super) struct Lacking {
    pub what: Both,
    pub help: Both,
}

impl CamReplacement<'_> {
    /// Returns the cam and its follower on the link that carries both, or the missing data.
    pub(super) fn carried(
        &self,
        cam: LinkId,
        follower: LinkId,
    ) -> Result<(OnPivot, CarriedFollower), Lacking> {
        let all = self.carriers(cam, follower);
        let mut first = None;
        for (frame, pivot) in &all {
            match self
                .on_pivot(cam, *frame, *pivot)
                .and_then(|on| Ok((on, self.follower_in(follower, *frame)?)))
            {
                Ok(placed) => return Ok(placed),
                // If several links might carry both, the ground (the first) determines the message.
                Err(lacking) => drop(first.get_or_insert(lacking)),
            }
        }
        Err(first.unwrap_or_else(|| {
            let (cam, follower) = (&self.raw.cam.text, &self.raw.follower.text);
            Lacking {
                what: both!(
                    "no link carries both: cam `{cam}` has to turn about a pin of the link in which `{follower}` slides or turns"
                ),
                help: both!(
                    "let one link carry the pivot of the cam and the guide or pivot of the follower"
                ),
            }
        }))
    }

    /// Returns the links on which the cam turns about one point and the follower slides or turns,
    /// the ground first.
    fn carriers(&self, cam: LinkId, follower: LinkId) -> Vec<(LinkId, PointId)> {
        let scene = self.bare;
        let pivot = |link: LinkId, frame: LinkId| {
            let mut shared = scene.links[link.0]
                .points
                .iter()
                .copied()
                .filter(|p| scene.links[frame.0].points.contains(p));
            shared.next().filter(|_| shared.next().is_none())
        };
        let slides = |frame: LinkId| {
            scene.guides.iter().any(|g| g.slider == Some(follower) && g.on == frame)
        };
        let one = |f: LinkId| {
            let carries = f != cam && f != follower && (slides(f) || pivot(follower, f).is_some());
            pivot(cam, f).filter(|_| carries).map(|p| (f, p))
        };
        let others = (0..scene.links.len()).map(LinkId).filter(|f| *f != scene.ground);
        std::iter::once(scene.ground).chain(others).filter_map(one).collect()
    }

    fn on_pivot(&self, cam: LinkId, frame: LinkId, pivot: PointId) -> Result<OnPivot, Lacking> {
        let scene = self.bare;
        let (cam_name, frame_name) = (scene.link_name(cam), scene.link_name(frame));
        let lacking = |what: Both, help: Both| Lacking { what, help };
        let turned = self.turns(cam, frame).ok_or_else(|| lacking(
            both!(
                "no driver turns cam `{cam_name}` against link `{frame_name}`, which carries it and its follower, nor a wheel that meshes with it"
            ),
            both!(
                "give {{\"link\": \"{cam_name}\", \"against\": \"{frame_name}\", \"angle\": \"30 deg\", \"omega\": ...}} as its driver: the angle between the first two points of the one and of the other"
            ),
        ))?;
        let own = self
            .raw
            .angle
            .as_ref()
            .filter(|_| !turned.direct())
            .and_then(|q| self.number_text(q, RequiredQuantity::Angle, &mut Faults::default()));
        let angle = own
            .or_else(|| self.given_angle(cam, frame, &turned, &mut Vec::new()))
            .ok_or_else(|| self.no_angle(cam, &turned))?;
        let unplaced = |p: PointId| self.unplaced(p, frame);
        let spot = self.spot_in(frame, pivot).ok_or_else(|| unplaced(pivot))?;
        // The direction of the cam's axes in the fixed plane equals its own angle only if the
        // ground carries it.
        let world = if frame == scene.ground {
            angle.value
        } else {
            self.line_of(cam).map_or(0.0, |t| t.value)
        };
        let local = locals(scene, cam, pivot, world).ok_or_else(|| {
            lacking(
                both!("the points of cam `{cam_name}` are not placed in it"),
                both!("give their distances in \"lengths\", or their coordinates"),
            )
        })?;
        let d = &scene.drivers[turned.driver];
        let rate = |given: &GivenQuantity, unit: &str| {
            let text = if given.value == 0.0 { format!("0 {unit}") } else { given.text.clone() };
            if given.value == 0.0 { text } else { turned.text(&text) }
        };
        let a = d.acceleration.as_ref();
        let way = turned.ratio;
        let from = if turned.direct() {
            0.0
        } else {
            angle.value - way * self.stated(turned.driver).map_or(0.0, |t| t.value)
        };
        Ok(OnPivot {
            frame,
            pivot,
            spot,
            driver: turned.driver,
            way,
            from,
            angle,
            rate: way * d.rate.value,
            rate_text: rate(&d.rate, "rad/s"),
            acceleration: a.map_or(0.0, |a| way * a.value),
            acceleration_text: a.map_or_else(|| "0 rad/s^2".into(), |a| rate(a, "rad/s^2")),
            local,
        })
    }

    fn unplaced(&self, p: PointId, frame: LinkId) -> Lacking {
        let (point, link) = (self.bare.point_name(p), self.bare.link_name(frame));
        Lacking {
            what: both!("where {point} stands in link `{link}` is not told"),
            help: both!(
                "give its coordinates, in the plane or in the link, or its distances from the first two points of the link"
            ),
        }
    }

    /// Returns the follower if it slides in a guide of the carrying link or turns about a pivot of
    /// it.
    fn follower_in(&self, link: LinkId, frame: LinkId) -> Result<CarriedFollower, Lacking> {
        let scene = self.bare;
        let Some(g) = scene.guides.iter().find(|g| g.slider == Some(link) && g.on == frame) else {
            let mut shared = scene.links[link.0]
                .points
                .iter()
                .copied()
                .filter(|p| scene.links[frame.0].points.contains(p));
            let pivot = shared.next().ok_or_else(|| self.guide_faulty(link))?;
            let spot = self.spot_in(frame, pivot).ok_or_else(|| self.unplaced(pivot, frame))?;
            return Ok(CarriedFollower::Pivot { pivot, spot });
        };
        let (Some(pin), GuidePath::Line { through, direction: along, offset: None }) =
            (g.pin, &g.path)
        else {
            return Err(self.guide_faulty(link));
        };
        let grounded = frame == scene.ground;
        let through = match through {
            Through::At(xy) => PointTexts::of(xy),
            Through::Point(p) => self.spot_in(frame, *p).ok_or_else(|| self.unplaced(*p, frame))?,
            Through::Pin => {
                spot(scene, pin).filter(|_| grounded).ok_or_else(|| self.guide_faulty(link))?
            }
        };
        let angle = match along {
            GuideDirection::Instant(angle) if grounded => NumberText::angle(angle),
            GuideDirection::Along(a, b, turn) => {
                let [from, to] =
                    [a, b].map(|p| self.spot_in(frame, *p).ok_or_else(|| self.unplaced(*p, frame)));
                let (from, to) = (from?, to?);
                let (value, text) = ((to.at() - from.at()).angle(), direction(&from, &to));
                match turn {
                    Some(t) => NumberText {
                        value: value + t.value.radians(),
                        text: format!("({text})+({})", NumberText::angle(t).text),
                    },
                    None => NumberText { value, text },
                }
            }
            GuideDirection::Instant(_) | GuideDirection::Own | GuideDirection::Slid(_) => {
                return Err(self.guide_faulty(link));
            }
        };
        Ok(CarriedFollower::Guide { through, angle, pin })
    }

    fn guide_faulty(&self, link: LinkId) -> Lacking {
        let name = self.bare.link_name(link);
        Lacking {
            what: both!(
                "the guide of follower `{name}` is not a straight one that is fixed in the link that carries the cam"
            ),
            help: both!(
                "give it a pin, a point that it passes through, and as its direction a `line` of that link (on the ground an `angle`)"
            ),
        }
    }

    /// Returns the place of a point of the carrying link in that link; for the ground, in the fixed
    /// plane.
    pub(super) fn spot_in(&self, frame: LinkId, p: PointId) -> Option<PointTexts> {
        if frame == self.bare.ground {
            return spot(self.bare, p);
        }
        let [x, y] = self.axes_texts(frame, p)?;
        let told = |text: String| {
            let q = RawQuantity { text, span: self.raw.span, bare: false };
            self.number_text(&q, RequiredQuantity::Length, &mut Faults::default())
        };
        Some(PointTexts { x: told(x)?, y: told(y)? })
    }

    /// Returns the texts of the coordinates of a point in the axes of its link.
    fn axes_texts(&self, link: LinkId, p: PointId) -> Option<[String; 2]> {
        let scene = self.bare;
        let [first, second, ..] = scene.links[link.0].points.as_slice() else { return None };
        let zero = || "0 mm".to_owned();
        if p == *first {
            return Some([zero(), zero()]);
        }
        let d = apart(scene, *first, *second)?.text;
        if p == *second {
            return Some([d, zero()]);
        }
        // A base in the opposite sense turns both axes by 180°.
        let from_base = |base: (PointId, PointId), [x, y]: [String; 2]| match base {
            (a, b) if (a, b) == (*first, *second) => Some([x, y]),
            (a, b) if (a, b) == (*second, *first) => {
                Some([format!("({d})-({x})"), format!("-({y})")])
            }
            _ => None,
        };
        match &scene.points[p.0].place {
            PointPlace::InLink { base, xy } => {
                from_base(*base, [&xy[0], &xy[1]].map(|g| NumberText::length(g).text))
            }
            PointPlace::Polar { base, length, angle } => {
                let (l, t) = (NumberText::length(length).text, NumberText::angle(angle).text);
                from_base(*base, [format!("({l})*cos({t})"), format!("({l})*sin({t})")])
            }
            PointPlace::Unknown | PointPlace::At(_) => {
                if let (Some(a), Some(b), Some(c)) =
                    (spot(scene, *first), spot(scene, *second), spot(scene, p))
                {
                    let ([ex, ey], [wx, wy]) = (a.way_to(&b), a.way_to(&c));
                    return Some([
                        format!("({wx}*{ex}+{wy}*{ey})/({d})"),
                        format!("({wy}*{ex}-{wx}*{ey})/({d})"),
                    ]);
                }
                let (ra, rb) = (apart(scene, *first, p)?.text, apart(scene, *second, p)?.text);
                let foot = format!("((({d})^2+({ra})^2-({rb})^2)/(2*({d})))");
                let said = scene.sides.iter().find(|s| {
                    s.point == p && [(*first, *second), (*second, *first)].contains(&(s.from, s.to))
                });
                let sign = if said.is_none_or(|s| s.left == (s.from == *first)) { "" } else { "-" };
                Some([foot.clone(), format!("{sign}sqrt(({ra})^2-{foot}^2)")])
            }
        }
    }
}
