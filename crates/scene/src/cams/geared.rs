//! Rotation and angle of a cam in the link that carries it: from its own driver, or through gears,
//! belts and chains from another.
//!
//! The axes of all wheels of the train are on the carrying link, so that the cam turns by the ratio
//! of the train. Its angle follows from the train as the position of wheels does
//! ([`Rolling::phase`]): ρ₁(φ₁ − β) + ρ₂(φ₂ − β) = ρ₂·phase, β being the direction of the line of
//! centres. Alternatively the cam has an `angle`, which determines the phase.

use super::super::model::*;
use super::super::raw::{RawDriverKind, RawQuantity, RawScene};
use super::super::rolling::{Contours, Rolling, Sizes};
use super::super::units::RequiredQuantity;
use super::carrier::Lacking;
use super::expand::CamReplacement;
use super::place::{NumberText, OnPivot, direction, spot};
use hodograph_base::diag::{Diagnostic, Faults, both};
use hodograph_base::trig::turns_of;
use std::f64::consts::TAU;

/// The driver that turns a link in the carrying link.
#[derive(Clone, Debug)]
pub(super) struct TurningDriver {
    /// Index into the scene's list.
    pub driver: usize,
    /// Ratio of the link's rotation to the driver's.
    pub ratio: f64,
    /// For a train of wheels: the text of the ratio, and the indices of the pairs into the scene's
    /// list, from the link to the driver.
    train: Option<(String, Vec<usize>)>,
}

impl TurningDriver {
    /// True if there is no train of wheels.
    pub fn direct(&self) -> bool {
        self.train.is_none()
    }

    /// Returns the text of the ratio times a number.
    pub fn text(&self, number: &str) -> String {
        match &self.train {
            Some((ratio, _)) => format!("({ratio})*({number})"),
            None if self.ratio < 0.0 => format!("-({number})"),
            None => number.to_owned(),
        }
    }
}

/// A wheel and the wheel on which it rolls, both with their axes on one link.
struct WheelMesh {
    /// The wheel on which it rolls.
    other: LinkId,
    /// Ratio of its rotation to that of the other wheel, with the text.
    ratio: NumberText,
    /// Direction of the line of centres, from the pair's first to its second.
    line: NumberText,
    /// True if it is the pair's second link.
    second: bool,
}

impl CamReplacement<'_> {
    /// Returns the driver that turns a link in the carrying link, directly or through the shortest
    /// train of wheels.
    pub(super) fn turns(&self, link: LinkId, frame: LinkId) -> Option<TurningDriver> {
        let direct = |l: LinkId| self.turned_by(l, frame);
        if let Some((driver, ratio)) = direct(link) {
            return Some(TurningDriver { driver, ratio, train: None });
        }
        let mut reached: Vec<(LinkId, NumberText, Vec<usize>)> =
            vec![(link, NumberText { value: 1.0, text: "1".into() }, Vec::new())];
        let mut next = 0;
        while next < reached.len() {
            let (wheel, so_far, path) = reached[next].clone();
            next += 1;
            for i in 0..self.bare.rolling.len() {
                let Some(mesh) = self
                    .mesh(i, wheel, frame)
                    .filter(|m| reached.iter().all(|(l, ..)| *l != m.other))
                else {
                    continue;
                };
                let ratio = NumberText {
                    value: so_far.value * mesh.ratio.value,
                    text: if path.is_empty() {
                        mesh.ratio.text
                    } else {
                        format!("{}*({})", so_far.text, mesh.ratio.text)
                    },
                };
                let path: Vec<usize> = path.iter().copied().chain([i]).collect();
                if let Some((driver, way)) = direct(mesh.other) {
                    let text = if way < 0.0 { format!("-({})", ratio.text) } else { ratio.text };
                    return Some(TurningDriver {
                        driver,
                        ratio: way * ratio.value,
                        train: Some((text, path)),
                    });
                }
                reached.push((mesh.other, ratio, path));
            }
        }
        None
    }

    /// Returns the driver that directly turns a link in another, with +1, or −1 if it turns the
    /// other link instead.
    fn turned_by(&self, link: LinkId, frame: LinkId) -> Option<(usize, f64)> {
        let scene = self.bare;
        let plain = |link: LinkId, line: &Option<(PointId, PointId)>| match (
            line,
            scene.links[link.0].points.as_slice(),
        ) {
            (None, _) => true,
            (Some(line), [first, second, ..]) => link != scene.ground && *line == (*first, *second),
            (Some(_), _) => false,
        };
        scene.drivers.iter().enumerate().find_map(|(i, d)| match &d.kind {
            DriverKind::Turn { link: of, against, line, against_line, .. }
                if plain(*of, line) && plain(*against, against_line) =>
            {
                match (*of, *against) {
                    (l, a) if (l, a) == (link, frame) => Some((i, 1.0)),
                    (l, a) if (l, a) == (frame, link) => Some((i, -1.0)),
                    _ => None,
                }
            }
            DriverKind::Turn { .. } | DriverKind::Slide { .. } | DriverKind::Cylinder { .. } => {
                None
            }
        })
    }

    /// Returns a rolling pair from the point of view of one of its wheels, if the other has its
    /// axis on the same link.
    fn mesh(&self, pair: usize, wheel: LinkId, frame: LinkId) -> Option<WheelMesh> {
        let r = &self.bare.rolling[pair];
        let (second, other) = (r.links[1] == wheel, r.other(wheel)?);
        let centres =
            r.round().filter(|c| c.iter().all(|p| self.bare.links[frame.0].points.contains(p)))?;
        let [from, to] = centres.map(|p| self.spot_in(frame, p));
        let (from, to) = (from?, to?);
        let line = NumberText { value: (to.at() - from.at()).angle(), text: direction(&from, &to) };
        Some(WheelMesh { other, ratio: ratio(r, second)?, line, second })
    }

    /// Returns the angle of a link's first two points in the carrying link, if a driver,
    /// coordinates or phases give it.
    pub(super) fn given_angle(
        &self,
        link: LinkId,
        frame: LinkId,
        turned: &TurningDriver,
        beyond: &mut Vec<LinkId>,
    ) -> Option<NumberText> {
        let own = self.turned_by(link, frame);
        let by_places = || {
            let (of, from) = (self.line_of(link)?, self.line_of(frame)?);
            let text = if frame == self.bare.ground {
                of.text
            } else {
                format!("({})-({})", of.text, from.text)
            };
            Some(NumberText { value: of.value - from.value, text })
        };
        let by_driver = own.and_then(|(driver, way)| {
            let t = self.stated(driver)?;
            Some(if way < 0.0 { NumberText { value: -t.value, text: negative(&t) } } else { t })
        });
        if let Some(told) = by_driver.or_else(by_places) {
            return Some(told);
        }
        beyond.push(link);
        let path = turned.train.as_ref().map_or(&[][..], |(_, path)| path);
        let by_phase = path.iter().find_map(|i| {
            let mesh = self.mesh(*i, link, frame).filter(|m| !beyond.contains(&m.other))?;
            let phase = NumberText::angle(self.bare.rolling[*i].phase.as_ref()?);
            let others = self.against_line(&mesh, frame, turned, beyond)?;
            let (line, ratio) = (&mesh.line, &mesh.ratio);
            Some(if mesh.second {
                let value = line.value + phase.value + others.value * ratio.value;
                NumberText {
                    value,
                    text: format!(
                        "({})+({})+({})*({})",
                        line.text, phase.text, others.text, ratio.text
                    ),
                }
            } else {
                let value = line.value + (others.value - phase.value) * ratio.value;
                NumberText {
                    value,
                    text: format!(
                        "({})+(({})-({}))*({})",
                        line.text, others.text, phase.text, ratio.text
                    ),
                }
            })
        });
        // A wheel with only its centre has no line: its axes have the direction of the carrying
        // link's.
        let centre = || self.bare.links[link.0].points.len() == 1;
        by_phase.or_else(|| centre().then(|| NumberText { value: 0.0, text: "0 deg".into() }))
    }

    /// Returns the angle of the other wheel from the line of centres, in the convention for
    /// positions of wheels: with whole turns if its own driver gives it, else within half a turn.
    fn against_line(
        &self,
        mesh: &WheelMesh,
        frame: LinkId,
        turned: &TurningDriver,
        beyond: &mut Vec<LinkId>,
    ) -> Option<NumberText> {
        let stands = self.given_angle(mesh.other, frame, turned, beyond)?;
        // A train's driver without an angle begins at 0.
        let is_written = |d: usize| d == turned.driver || self.stated(d).is_some();
        let written = frame == self.bare.ground
            && self.turned_by(mesh.other, frame).is_some_and(|(d, _)| is_written(d));
        let value = stands.value - mesh.line.value;
        let text = format!("({})-({})", stands.text, mesh.line.text);
        let turns = if written { 0.0 } else { turns_of(value) };
        Some(if turns == 0.0 {
            NumberText { value, text }
        } else {
            NumberText { value: value - turns * TAU, text: format!("{text}-({turns}*360 deg)") }
        })
    }

    /// Adds the data of a cam driven through wheels to the scene: the angle of the cam becomes the
    /// phase of the next pair. Returns `None` after a reported fault.
    pub(super) fn behind_wheels(
        &self,
        raw: &mut RawScene,
        cam: LinkId,
        on: Option<&OnPivot>,
        faults: &mut Faults,
    ) -> Option<()> {
        let frame = on.map_or(self.bare.ground, |on| on.frame);
        if let Some(on) = on.filter(|_| self.turned_by(cam, frame).is_none()) {
            self.begun(raw, on.driver);
        }
        let Some(q) = &self.raw.angle else { return Some(()) };
        let help = both!(
            "`angle` says how a cam stands that gears, a belt or a chain turn; leave it away"
        );
        let mut wrong = |message| {
            faults.push(Diagnostic::error("cam-angle", message).at(q.span).help(help.clone()))
        };
        let name = &self.raw.cam.text;
        let turned = self.turns(cam, frame).filter(|t| !t.direct());
        let Some((turned, pair)) = turned.and_then(|t| {
            t.train.as_ref().and_then(|(_, path)| path.first().copied()).map(|i| (t, i))
        }) else {
            wrong(both!("no wheels turn cam `{name}`: its driver says how it stands"));
            return None;
        };
        if self.bare.rolling[pair].phase.is_some() || self.line_of(cam).is_some() {
            wrong(both!(
                "the phase of its wheel, or coordinates, say already how cam `{name}` stands"
            ));
            return None;
        }
        let angle = self.number_text(q, RequiredQuantity::Angle, faults)?;
        let mesh = self.mesh(pair, cam, frame)?;
        let others = self.against_line(&mesh, frame, &turned, &mut vec![cam])?.text;
        let (line, ratio) = (&mesh.line.text, &mesh.ratio.text);
        let text = if mesh.second {
            format!("({})-({line})-({others})*({ratio})", angle.text)
        } else {
            format!("({others})-(({})-({line}))/({ratio})", angle.text)
        };
        raw.rolling[pair].phase = Some(RawQuantity { text, span: q.span, bare: false });
        Some(())
    }

    /// Gives the angle 0 to a driver whose wheel has only its centre, so that other positions of
    /// the cam that it drives through wheels are defined.
    fn begun(&self, raw: &mut RawScene, driver: usize) {
        if let Some(RawDriverKind::Turn { angle: angle @ None, .. }) =
            raw.drivers.get_mut(driver).map(|d| &mut d.kind)
        {
            *angle = Some(RawQuantity { text: "0 deg".into(), span: self.raw.span, bare: false });
        }
    }

    /// Returns the angle of a driver as written.
    pub(super) fn stated(&self, driver: usize) -> Option<NumberText> {
        match &self.bare.drivers[driver].kind {
            DriverKind::Turn { angle, .. } => angle.as_ref().map(|a| {
                NumberText::angle(&GivenQuantity { text: self.values.text_of(a), ..a.clone() })
            }),
            DriverKind::Slide { .. } | DriverKind::Cylinder { .. } => None,
        }
    }

    /// Returns the direction of a link's first two points in the fixed plane; for the ground, the x
    /// axis.
    pub(super) fn line_of(&self, link: LinkId) -> Option<NumberText> {
        if link == self.bare.ground {
            return Some(NumberText { value: 0.0, text: "0 deg".into() });
        }
        let [a, b, ..] = self.bare.links[link.0].points.as_slice() else { return None };
        let (a, b) = (spot(self.bare, *a)?, spot(self.bare, *b)?);
        Some(NumberText { value: (b.at() - a.at()).angle(), text: direction(&a, &b) })
    }

    /// The fault of a cam without an angle.
    pub(super) fn no_angle(&self, cam: LinkId, turned: &TurningDriver) -> Lacking {
        let name = self.bare.link_name(cam);
        if turned.direct() {
            return Lacking {
                what: both!("the driver of cam `{name}` has no angle"),
                help: both!("add \"angle\" to it"),
            };
        }
        Lacking {
            what: both!("wheels turn cam `{name}`, and nothing says at which angle it stands"),
            help: both!(
                "add \"angle\": \"30 deg\" to the cam, the angle of its first two points (of a cam with one point the one from which its law counts), or \"phase\" to the pair"
            ),
        }
    }
}

/// Returns the ratio of one wheel's rotation to the other's.
fn ratio(r: &Rolling, second: bool) -> Option<NumberText> {
    let (sizes, same): ([NumberText; 2], bool) = match &r.contours {
        Contours::Circles { sizes: Sizes::Teeth(teeth), hollow, .. } => {
            (teeth.map(whole), hollow.is_some())
        }
        Contours::Circles { sizes: Sizes::Radii(radii), hollow, .. } => {
            (radii.each_ref().map(NumberText::length), hollow.is_some())
        }
        Contours::Belt { teeth: Some(teeth), crossed, .. } => (teeth.map(whole), !crossed),
        Contours::Belt { radii, crossed, .. } => {
            (radii.each_ref().map(NumberText::length), !crossed)
        }
        Contours::Track { .. } => return None,
    };
    let [mine, its] = if second { [&sizes[1], &sizes[0]] } else { [&sizes[0], &sizes[1]] };
    let (value, text) = (its.value / mine.value, format!("({})/({})", its.text, mine.text));
    Some(if same {
        NumberText { value, text }
    } else {
        NumberText { value: -value, text: format!("-({text})") }
    })
}

fn whole(teeth: u32) -> NumberText {
    NumberText { value: f64::from(teeth), text: teeth.to_string() }
}

/// Returns the text of the negative of a number; a written zero remains.
fn negative(told: &NumberText) -> String {
    if told.value == 0.0 { told.text.clone() } else { format!("-({})", told.text) }
}
