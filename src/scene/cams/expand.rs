//! Every cam of the raw scene into the pairs, points and drivers that stand for it.

use std::collections::HashSet;

use super::super::model::*;
use super::super::names::Names;
use super::super::raw::{RawQuantity, RawScene};
use super::super::units::Wanted;
use super::super::values::Values;
use super::law::{self, LawText, StageText};
use super::pairs::{Contact, Worded, fresh, numbers};
use super::place::{self, Carried, OnPivot, Told};
use super::raw::*;
use super::{Cam, Follows, Turning};
use crate::cam::outline::{Broken, segments};
use crate::cam::{Disc, Follower, Law, Motion, Program, Side, Stage, Touch, Way};
use crate::diag::{Both, Diagnostic, Faults, Span, both};
use crate::geom::Vec2;
use crate::json::Word;
use crate::digits::significant;

/// A scene whose cams are written as other pairs, and the cams themselves by the names of their points.
pub(in crate::scene) struct Expanded {
    pub raw: RawScene,
    cams: Vec<Pending>,
    /// Parameters that only a piece uses which is not touched.
    pub used: HashSet<String>,
}

struct Pending {
    cam: String,
    follower: String,
    point: String,
    follows: fn(PointId, f64) -> Follows,
    radius: f64,
    at: Option<String>,
    circle: Option<(String, f64)>,
    disc: Option<(String, Turning)>,
    contact: Option<usize>,
    span: Span,
}

/// A cam whose link has one point gets a second one on its base circle, from which its angle is told; so does a lever with a flat face whose
/// motion a law gives.
pub(in crate::scene) fn marked(raw: &RawScene) -> RawScene {
    let mut out = raw.clone();
    for cam in &raw.cams {
        let radius = match &cam.profile {
            RawProfile::Law { base, .. } => Some(base),
            RawProfile::Parts(parts) => parts.iter().find_map(|p| match p {
                RawPart::Circle { radius, .. } => Some(radius),
                RawPart::Corner(_) | RawPart::Tangent(_) | RawPart::Flank(_) => None,
            }),
        };
        let law = matches!(cam.profile, RawProfile::Law { .. });
        let lever = law && matches!(cam.follows, RawFollows::Face(_)) && !raw.guides.iter().any(|g| named(&g.slider, &cam.follower.text));
        for (link, proposed) in [(Some(&cam.cam), "M"), (Some(&cam.follower).filter(|_| lever), "W")] {
            let (Some(link), Some(radius)) = (link, radius) else { continue };
            let name = fresh(&out, &[proposed]);
            let Some(found) = out.links.iter_mut().find(|l| l.name.text == link.text && l.points.len() == 1) else { continue };
            let pair = format!("{},{name}", found.points[0].text);
            found.points.push(Word { text: name, span: cam.span });
            out.lengths.push((Word { text: pair, span: cam.span }, radius.clone()));
        }
    }
    out
}

fn named(word: &Option<Word>, text: &str) -> bool {
    word.as_ref().is_some_and(|w| w.text == text)
}

/// Writes the pairs of all cams. `bare` is the scene without them.
pub(in crate::scene) fn expand(raw: RawScene, source: &str, bare: &Scene, faults: &mut Faults) -> Expanded {
    let parameters = raw.parameters.clone();
    let (values, _) = Values::new(source, &raw.units, &parameters, &mut Faults::default());
    let mut out = Expanded { raw: raw.clone(), cams: Vec::new(), used: HashSet::new() };
    for (i, cam) in raw.cams.iter().enumerate() {
        let one = One { bare, values: &values, names: Names::new(&bare.points, &bare.links), raw: cam, name: format!("cam{}", i + 1) };
        out.cams.extend(one.write(&mut out.raw, faults));
    }
    out.used = values.used_names();
    out
}

/// One cam at work.
struct One<'a> {
    bare: &'a Scene,
    values: &'a Values<'a>,
    names: Names<'a>,
    raw: &'a RawCam,
    name: String,
}

fn note<T>(result: Result<T, Diagnostic>, faults: &mut Faults) -> Option<T> {
    result.map_err(|d| faults.push(d)).ok()
}

impl One<'_> {
    fn told(&self, q: &RawQuantity, wanted: Wanted, faults: &mut Faults) -> Option<Told> {
        if wanted == Wanted::Angle {
            let given = self.values.angle(q, faults)?;
            return Some(Told { value: given.value.radians(), text: given.text });
        }
        let given = self.values.si(q, wanted, faults)?;
        Some(Told { value: given.value, text: if given.value == 0.0 { "0 mm".into() } else { given.text } })
    }

    fn positive(&self, q: &RawQuantity, faults: &mut Faults) -> Option<Told> {
        let given = self.values.positive_length(q, both!("the radius", "半径"), faults)?;
        Some(Told { value: given.value, text: given.text })
    }

    fn write(&self, raw: &mut RawScene, faults: &mut Faults) -> Option<Pending> {
        let cam = note(self.names.link(&self.raw.cam), faults);
        let follower = note(self.names.link(&self.raw.follower), faults);
        let point = match self.raw.follows.pin() {
            Some(word) => note(self.names.point(word), faults),
            None => None,
        };
        let end = match self.raw.follows.radius() {
            Some(q) => Some(self.positive(q, faults)?),
            None => None,
        };
        let (cam, follower) = (cam?, follower?);
        let Some(point) = point else {
            if self.raw.follows.pin().is_none() {
                let message =
                    both!("a face passes through a point of the follower, not through coordinates", "平底应通过从动件上的点，而非坐标");
                faults.push(Diagnostic::error("cam-follower", message).at(self.raw.span));
            }
            return None;
        };
        if cam == follower {
            let message = both!("link `{}` cannot be cam and follower at once", "构件 `{}` 不能既是凸轮又是从动件", self.raw.cam.text);
            faults.push(Diagnostic::error("cam-follower", message).at(self.raw.follower.span));
            return None;
        }
        if !self.bare.links[follower.0].points.contains(&point) {
            let message = both!(
                "`{}` is not a point of the follower `{}`",
                "`{}` 不是从动件 `{}` 上的点",
                self.bare.point_name(point),
                self.raw.follower.text
            );
            faults.push(Diagnostic::error("not-on-link", message).at(self.raw.follows.pin()?.span));
            return None;
        }
        let mut pending = Pending {
            cam: self.raw.cam.text.clone(),
            follower: self.raw.follower.text.clone(),
            point: self.bare.point_name(point).to_owned(),
            follows: match self.raw.follows {
                RawFollows::Edge(_) => |p, _| Follows::Edge(p),
                RawFollows::Roller { .. } => Follows::Roller,
                RawFollows::Arc { .. } => Follows::Arc,
                RawFollows::Face(_) => |p, _| Follows::Face(p),
            },
            radius: end.as_ref().map_or(0.0, |r| r.value),
            at: self.raw.at.as_ref().map(|w| w.text.clone()),
            circle: None,
            disc: None,
            contact: None,
            span: self.raw.span,
        };
        let placed = place::cam(self.bare, cam).zip(place::follower(self.bare, follower));
        match &self.raw.profile {
            RawProfile::Parts(parts) => self.by_parts(raw, parts, (cam, point), end, placed, &mut pending, faults)?,
            RawProfile::Law { base, start, clockwise, stages } => {
                let law = self.law(
                    base,
                    start,
                    *clockwise,
                    stages,
                    placed.as_ref().is_some_and(|p| matches!(p.1, Carried::Pivot { .. })),
                    faults,
                )?;
                self.by_law(raw, law, point, end, placed, &mut pending, faults)?;
            }
        }
        Some(pending)
    }

    /// The face of the follower: as it is written with what the cam's place adds, how far out it lies, and in which sense it goes out.
    fn face(&self, carried: Option<&Carried>, face: &RawFace, faults: &mut Faults) -> Option<(RawFace, Option<Told>, f64)> {
        let offset = match &face.offset {
            Some(q) => Some(self.told(q, Wanted::Length, faults)?),
            None => None,
        };
        let mut face = face.clone();
        if let Some(Carried::Guide { angle: guide, .. }) = carried {
            match &face.angle {
                None if face.line.is_none() => {
                    face.angle = Some(RawQuantity { text: format!("({})+90 deg", guide.text), span: self.raw.span, bare: false });
                    face.left = Some(true);
                }
                Some(q) if face.left.is_none() => {
                    let u = Vec2::from_angle(self.told(q, Wanted::Angle, faults)?.value);
                    face.left = Some(u.perp().dot(Vec2::from_angle(guide.value)) < 0.0);
                }
                _ => {}
            }
        }
        let sense = if face.left.unwrap_or(true) { -1.0 } else { 1.0 };
        Some((face, offset, sense))
    }

    /// The geometry of the follower; `None` where it is not that of a cam on the ground.
    fn follower(
        &self,
        placed: &(OnPivot, Carried),
        point: PointId,
        offset: Option<&Told>,
        sense: f64,
    ) -> Option<(Follower, Touch, Option<Told>)> {
        let (cam, carried) = placed;
        let face = matches!(self.raw.follows, RawFollows::Face(_));
        let (arm, sense) = match carried {
            Carried::Guide { pin, .. } if *pin == point => (None, 1.0),
            Carried::Guide { .. } => return None,
            Carried::Pivot { pivot, .. } if face => {
                return (*pivot == point).then(|| {
                    let lever = offset.map_or(0.0, |o| o.value) * sense;
                    (place::geometry(carried, cam.spot.at(), 0.0, sense), Touch::Flat { lever }, None)
                });
            }
            Carried::Pivot { pivot, spot } => {
                let arm = place::apart(self.bare, *pivot, point)?;
                (Some(arm), place::sense(self.bare, *pivot, cam.pivot, point, [spot.at(), cam.spot.at()]))
            }
        };
        let geometry = place::geometry(carried, cam.spot.at(), arm.as_ref().map_or(0.0, |a| a.value), sense);
        let touch = if face { Touch::Flat { lever: 0.0 } } else { Touch::Point { radius: 0.0 } };
        Some((geometry, touch, arm))
    }

    fn by_parts(
        &self,
        raw: &mut RawScene,
        parts: &[RawPart],
        (cam, point): (LinkId, PointId),
        end: Option<Told>,
        placed: Option<(OnPivot, Carried)>,
        pending: &mut Pending,
        faults: &mut Faults,
    ) -> Option<()> {
        let worded = self.worded(cam, parts, faults)?;
        let (follows, offset, sense) = match &self.raw.follows {
            RawFollows::Face(face) => {
                let (face, offset, sense) = self.face(placed.as_ref().map(|p| &p.1), face, faults)?;
                (RawFollows::Face(face), offset, sense)
            }
            round => (round.clone(), None, 1.0),
        };
        if let [Worded::Circle { centre, radius }] = worded.as_slice() {
            pending.circle = Some((centre.clone(), radius.value));
        }
        let geometry = placed.as_ref().and_then(|p| self.follower(p, point, offset.as_ref(), sense));
        let contact = Contact {
            cam: &self.raw.cam.text,
            follower: &self.raw.follower.text,
            follows: &follows,
            end: end.clone(),
            offset,
            span: self.raw.span,
        };
        let mut touched = 0;
        if let (Some((on, carried)), Some((follower, touch, _))) = (&placed, geometry) {
            let local = |name: &str| {
                let id = self.names.point(&Word { text: name.to_owned(), span: self.raw.span }).ok()?;
                on.local.iter().find(|(p, _)| *p == id).map(|(_, at)| *at)
            };
            let Some(parts) = worded.iter().map(|w| numbers(w, local)).collect::<Option<Vec<_>>>() else {
                return self.no_pose(faults);
            };
            let segments = segments(&parts).map_err(|broken| self.broken(broken, faults)).ok()?;
            let touch = match touch {
                Touch::Point { .. } => Touch::Point { radius: end.as_ref().map_or(0.0, |r| r.value) },
                Touch::Flat { lever } => Touch::Flat { lever },
            };
            let backward = on.rate < 0.0 || on.rate == 0.0 && on.acceleration < 0.0;
            let turn = if backward { -1.0 } else { 1.0 };
            let disc = Disc { follower, touch, motion: Motion::Profile(segments), sense: turn };
            let phi = turn * on.angle.value;
            let Some(found) = disc.touched(phi, Side::After) else { return self.no_contact(faults) };
            touched = found;
            self.joint(&disc, phi, on, faults);
            self.sketch(raw, &disc, phi, on);
            let (origin, outward) = place::origin(carried, on.spot.at(), follower_sense(&disc));
            let turning = Turning {
                pivot: PointId(0),
                disc,
                phi,
                driver: on.driver,
                by_law: None,
                start: 0.0,
                origin,
                outward,
                touched: Some(found),
                side: Side::After,
            };
            pending.disc = Some((self.bare.point_name(on.pivot).to_owned(), turning));
        } else if worded.len() > 1 {
            return self.no_pose(faults);
        }
        pending.contact = Some(raw.guides.len());
        contact.write(raw, &worded, touched)
    }

    /// The parts with texts and checked numbers.
    fn worded(&self, cam: LinkId, parts: &[RawPart], faults: &mut Faults) -> Option<Vec<Worded>> {
        let n = parts.len();
        let centre = |i: usize| match &parts[i % n] {
            RawPart::Circle { centre, .. } | RawPart::Corner(centre) => Some(centre),
            RawPart::Tangent(_) | RawPart::Flank(_) => None,
        };
        let mut out = Vec::new();
        let before = faults.list.len();
        for (i, part) in parts.iter().enumerate() {
            if let Some(word) = centre(i)
                && let Some(p) = note(self.names.point(word), faults)
                && !self.bare.links[cam.0].points.contains(&p)
            {
                let message =
                    both!("centre `{}` is not a point of the cam `{}`", "圆心 `{}` 不是凸轮 `{}` 上的点", word.text, self.raw.cam.text);
                faults.push(
                    Diagnostic::error("not-on-link", message)
                        .at(word.span)
                        .help(both!("name it in \"links\" among the points of the cam", "请在 \"links\" 中把它写入凸轮的点")),
                );
            }
            match part {
                RawPart::Circle { centre, radius } => {
                    let radius = self.positive(radius, faults);
                    out.extend(radius.map(|radius| Worded::Circle { centre: centre.text.clone(), radius }));
                }
                RawPart::Corner(p) => {
                    out.push(Worded::Circle { centre: p.text.clone(), radius: Told { value: 0.0, text: "0 mm".into() } });
                }
                RawPart::Flank(radius) => out.extend(self.told(radius, Wanted::Length, faults).map(|radius| Worded::Flank { radius })),
                RawPart::Tangent(span) => {
                    let ends = centre(i + n - 1).zip(centre(i + 1));
                    let ids = ends.and_then(|(a, b)| self.names.point(a).ok().zip(self.names.point(b).ok()));
                    let Some((a, b)) = ids else { continue };
                    match place::apart(self.bare, a, b) {
                        Some(apart) => out.push(Worded::Tangent { apart }),
                        None => {
                            let [a, b] = [a, b].map(|p| self.bare.point_name(p));
                            let message = both!(
                                "the tangent of the circles about {a} and {b} needs their distance",
                                "求绕 {a} 和 {b} 两圆的公切线须知两圆心的距离"
                            );
                            faults.push(
                                Diagnostic::error("cam-centres", message)
                                    .at(*span)
                                    .help(both!("add \"{a},{b}\" to \"lengths\"", "请在 \"lengths\" 中加上 \"{a},{b}\"")),
                            );
                        }
                    }
                }
            }
        }
        if out.len() < n && faults.list.len() == before {
            let at = parts.iter().position(|p| matches!(p, RawPart::Tangent(_))).unwrap_or(0);
            self.broken(Broken::NoNeighbour(at), faults);
        }
        (faults.list.len() == before && out.len() == n && n > 0).then_some(out)
    }

    fn broken(&self, broken: Broken, faults: &mut Faults) {
        let message = match broken {
            Broken::NoCircle => both!("the profile has no circle", "廓线中没有圆"),
            Broken::NoNeighbour(i) => {
                both!("part {} of the profile has no circle on both sides", "廓线第 {} 段的两侧不都是圆", i + 1)
            }
            Broken::Apart(i) => both!(
                "part {} of the profile cannot touch its neighbours: their centres are too near or too far apart",
                "廓线第 {} 段不能与相邻两段相切：圆心过近或过远",
                i + 1
            ),
        };
        faults.push(Diagnostic::error("cam-profile", message).at(self.raw.span).help(both!(
            "list arcs and lines counter-clockwise round the cam: a circle, \"tangent\" or {{\"radius\"}}, the next circle, ...",
            "请沿凸轮逆时针列出各段：圆、\"tangent\" 或 {{\"radius\"}}、下一圆……"
        )));
    }

    fn no_pose<T>(&self, faults: &mut Faults) -> Option<T> {
        let d = Diagnostic::error(
            "cam-pose",
            both!(
                "which part of the profile of cam `{}` is touched is told only where cam and follower are on the ground",
                "只有凸轮和从动件都装在机架上时，才能判断凸轮 `{}` 的哪一段廓线接触",
                self.raw.cam.text
            ),
        );
        faults.push(d.at(self.raw.span).help(both!(
            "a pivot of the cam among the points of the ground, a driver with \"angle\" for it, and a guide or pivot of the follower on the ground through the point that touches; or a profile of one circle",
            "请给出：机架上的凸轮轴心、带 \"angle\" 的凸轮原动件、从动件在机架上的导路（通过接触点）或转轴；或只用一个圆作廓线"
        )));
        None
    }

    fn no_contact<T>(&self, faults: &mut Faults) -> Option<T> {
        let d = Diagnostic::error(
            "no-contact",
            both!(
                "the follower `{}` does not reach the profile of cam `{}` in this pose",
                "在此位置从动件 `{}` 够不到凸轮 `{}` 的廓线",
                self.raw.follower.text,
                self.raw.cam.text
            ),
        );
        faults.push(
            d.at(self.raw.span)
                .help(both!("check the radii, the offset of the guide and the length of the arm", "请检查各半径、导路的偏距和摆杆长度")),
        );
        None
    }

    /// At a joint of two pieces the acceleration jumps: both are told.
    fn joint(&self, disc: &Disc, phi: f64, on: &OnPivot, faults: &mut Faults) {
        let sides = [Side::Before, Side::After].map(|side| disc.coordinate(phi, side));
        let [Some(before), Some(after)] = sides else { return };
        if disc.touched(phi, Side::Before) == disc.touched(phi, Side::After) && matches!(disc.motion, Motion::Profile(_)) {
            return;
        }
        let a = [before, after].map(|q| q.0[2] * on.rate * on.rate + q.0[1] * on.acceleration * disc.sense);
        if (a[0] - a[1]).abs() <= 1e-9 * a[0].abs().max(a[1].abs()) {
            return;
        }
        let unit = match disc.follower {
            Follower::Translating { .. } => "m/s²",
            Follower::Oscillating { .. } => "rad/s²",
        };
        let [b, a] = a.map(|a| significant(a, 4));
        let message = both!(
            "two pieces of the profile meet here: the acceleration of `{}` jumps from {b} to {a} {unit}; drawn is what follows",
            "此处为廓线两段的接点：`{}` 的加速度由 {b} 跃变为 {a} {unit}；图中取其后一段",
            self.raw.follower.text
        );
        faults.push(Diagnostic::note("joint", message).at(self.raw.span));
    }

    /// Says which of the assemblies is meant: the point of the follower where it touches.
    fn sketch(&self, raw: &mut RawScene, disc: &Disc, phi: f64, on: &OnPivot) {
        let (Some(pin), Touch::Point { .. }) = (self.raw.follows.pin(), disc.touch) else { return };
        let said = raw.sketch.iter().any(|(w, _)| w.text == pin.text) || raw.points.iter().any(|(w, _)| w.text == pin.text);
        let Some(q) = disc.coordinate(phi, Side::After).filter(|_| !said) else { return };
        let at = on.spot.at() + disc.follower.point(q).order(0);
        let quantity = |x: f64| RawQuantity { text: format!("({x:?}) m"), span: self.raw.span, bare: false };
        raw.sketch.push((Word { text: pin.text.clone(), span: self.raw.span }, [quantity(at.x), quantity(at.y)]));
    }

    /// The law as numbers and texts.
    fn law(
        &self,
        base: &RawQuantity,
        start: &Option<RawQuantity>,
        clockwise: bool,
        stages: &[RawStage],
        turning: bool,
        faults: &mut Faults,
    ) -> Option<(f64, f64, LawText, Program)> {
        let before = faults.list.len();
        let base = self.positive(base, faults);
        let start = match start {
            Some(q) => self.told(q, Wanted::Angle, faults),
            None => Some(Told { value: 0.0, text: "0 deg".into() }),
        };
        let (mut texts, mut program) = (Vec::new(), Program::default());
        let mut lift = 0.0f64;
        for stage in stages {
            let over = self.told(&stage.over, Wanted::Angle, faults);
            if let Some(over) = over.as_ref().filter(|o| !(o.value > 0.0)) {
                let message = both!("a stage goes over {}; it must be greater than zero", "该段转角为 {}，应大于零", over.text);
                faults.push(Diagnostic::error("not-positive", message).at(stage.over.span));
            }
            let mut gain = |q: &RawQuantity| {
                if turning {
                    let g = self.values.angle(q, faults)?;
                    Some(Given { value: g.value.radians(), radius: g.radius, text: g.text, span: g.span })
                } else {
                    self.values.si(q, Wanted::Length, faults)
                }
            };
            let kind = |w: &Word| Law::named(&w.text);
            let (way, text) = match &stage.way {
                RawWay::Dwell => (Some(Way::Dwell), None),
                RawWay::Rise(q, law) => {
                    let g = gain(q);
                    (g.as_ref().zip(kind(law)).map(|(g, law)| Way::Rise(g.value, law)), g)
                }
                RawWay::Return(q, law) => {
                    let g = gain(q);
                    (g.as_ref().zip(kind(law)).map(|(g, law)| Way::Return(g.value, law)), g)
                }
            };
            let (Some(way), Some(over)) = (way, over) else { continue };
            let stage = Stage { way, over: over.value };
            lift += stage.gain();
            program.stages.push(stage);
            texts.push(StageText { gain: text, over: over.text });
        }
        if faults.list.len() > before {
            return None;
        }
        let sum: f64 = program.stages.iter().map(|s| s.over).sum();
        let open = |message: Both, help: Both, faults: &mut Faults| {
            faults.push(Diagnostic::error("law-open", message).at(self.raw.span).help(help));
        };
        // A law is written in degrees; nine digits tell a slip of the pen from rounding.
        if (sum - std::f64::consts::TAU).abs() > 1e-9 {
            let degrees = significant(sum.to_degrees(), 6);
            open(
                both!("the stages of the law go over {degrees}°, not 360°", "运动规律各段共转 {degrees}°，不是 360°"),
                both!("make up the rest with {{\"dwell\": ...}}", "其余可用 {{\"dwell\": ...}} 补足"),
                faults,
            );
        }
        if lift.abs() > 1e-9 * program.stroke().abs() {
            open(
                both!(
                    "what the law rises it does not return: the follower ends elsewhere than it began",
                    "升程与回程不等：从动件转完一周没有回到起点"
                ),
                both!("make the returns as large as the rises", "请使各回程之和等于各升程之和"),
                faults,
            );
        }
        let (base, start) = (base?, start?);
        let text = LawText { base: base.text, start: start.text, clockwise, stages: texts };
        (faults.list.len() == before).then_some((base.value, start.value, text, program))
    }

    fn by_law(
        &self,
        raw: &mut RawScene,
        (base, start, text, program): (f64, f64, LawText, Program),
        point: PointId,
        end: Option<Told>,
        placed: Option<(OnPivot, Carried)>,
        pending: &mut Pending,
        faults: &mut Faults,
    ) -> Option<()> {
        let (face, offset, sense) = match &self.raw.follows {
            RawFollows::Face(face) => {
                let (face, offset, sense) = self.face(placed.as_ref().map(|p| &p.1), face, faults)?;
                (Some(face), offset, sense)
            }
            RawFollows::Edge(_) | RawFollows::Roller { .. } | RawFollows::Arc { .. } => (None, None, 1.0),
        };
        let Some(placed) = placed else { return self.no_pose(faults) };
        let Some((follower, touch, arm)) = self.follower(&placed, point, offset.as_ref(), sense) else { return self.no_pose(faults) };
        let (on, carried) = placed;
        let touch = match touch {
            Touch::Point { .. } => Touch::Point { radius: end.as_ref().map_or(0.0, |r| r.value) },
            Touch::Flat { lever } => Touch::Flat { lever },
        };
        let turn = if text.clockwise { -1.0 } else { 1.0 };
        let disc = Disc { follower, touch, motion: Motion::Law { base, program: program.clone() }, sense: turn };
        if !disc.rest(base).is_finite() {
            return self.no_contact(faults);
        }
        let phi = turn * (on.angle.value - start);
        let along = if on.rate * turn < 0.0 { Side::Before } else { Side::After };
        // The mark that tells the direction of a lever with a face is the last point of its link.
        let point = match (&carried, &face) {
            (Carried::Pivot { .. }, Some(_)) => {
                let id = self.names.link(&self.raw.follower).ok()?;
                *self.bare.links[id.0].points.iter().find(|p| **p != point)?
            }
            _ => point,
        };
        let radius = match touch {
            Touch::Point { .. } => Some(end.map_or_else(|| "0 mm".to_owned(), |r| r.text)),
            Touch::Flat { .. } => None,
        };
        let lever = offset.map(|o| if sense < 0.0 { format!("-({})", o.text) } else { o.text });
        let at = law::At {
            scene: self.bare,
            cam: &on,
            carried: &carried,
            point,
            radius,
            arm: arm.map(|a| a.text),
            lever,
            follower: &self.raw.follower.text,
            span: self.raw.span,
        };
        let written = law::driver(&at, &disc, &program, &text, (phi, along), &self.name)?;
        self.joint(&disc, phi, &on, faults);
        let quantity = |text: String| RawQuantity { text, span: self.raw.span, bare: false };
        for (name, text) in written.parameters {
            raw.parameters.push((Word { text: name, span: self.raw.span }, quantity(text)));
        }
        let by_law = Some(raw.drivers.len());
        raw.drivers.push(written.driver);
        let (origin, outward) = place::origin(&carried, on.spot.at(), follower_sense(&disc));
        let turning =
            Turning { pivot: PointId(0), disc, phi, driver: on.driver, by_law, start, origin, outward, touched: None, side: along };
        pending.disc = Some((self.bare.point_name(on.pivot).to_owned(), turning));
        Some(())
    }
}

/// The sense in which an oscillating follower goes out.
fn follower_sense(disc: &Disc) -> f64 {
    match disc.follower {
        Follower::Translating { .. } => 1.0,
        Follower::Oscillating { sense, .. } => sense,
    }
}

impl Expanded {
    /// The cams of the scene that has been made of it.
    pub fn cams(self, scene: &Scene) -> Vec<Cam> {
        let point = |name: &str| scene.points.iter().position(|p| p.name == name).map(PointId);
        let link = |name: &str| scene.links.iter().position(|l| l.name == name).map(LinkId);
        let one = |p: Pending| {
            let disc = p.disc.and_then(|(pivot, turning)| Some(Turning { pivot: point(&pivot)?, ..turning }));
            Some(Cam {
                cam: link(&p.cam)?,
                follower: link(&p.follower)?,
                follows: (p.follows)(point(&p.point)?, p.radius),
                at: p.at,
                circle: p.circle.and_then(|(c, r)| Some((point(&c)?, r))),
                disc,
                contact: p.contact.map(GuideId),
                span: p.span,
            })
        };
        self.cams.into_iter().filter_map(one).collect()
    }
}
