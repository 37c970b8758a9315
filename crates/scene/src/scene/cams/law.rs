//! A law as a driver: the texts of the follower's place, rate and acceleration.
//!
//! The texts are those of the scene put into formulas, so that longer numbers certify answers of a law cam as those of any other mechanism.
//! Parts that are used more than once become parameters beside those of the file (`cam1_x`, `cam1_s`, ...).

use super::super::model::{Given, PointId, Scene};
use super::super::raw::{RawDriver, RawDriverKind, RawQuantity};
use super::place::{Carried, OnPivot, direction, distance, outward};
use crate::cam::{Disc, Program, Side, Touch, Way};
use crate::diag::Span;
use crate::json::Word;

/// A stage as it is written.
pub(super) struct StageText {
    /// The lift of what moves.
    pub gain: Option<Given>,
    /// Text of the angle.
    pub over: String,
}

/// What of a law is written beside its numbers.
pub(super) struct LawText {
    pub base: String,
    pub start: String,
    pub clockwise: bool,
    pub stages: Vec<StageText>,
}

/// Where the contact is on the follower.
pub(super) struct At<'a> {
    pub scene: &'a Scene,
    pub cam: &'a OnPivot,
    pub carried: &'a Carried,
    /// The follower's point, or the mark that tells its direction.
    pub point: PointId,
    /// Radius of the round end, as a text.
    pub radius: Option<String>,
    /// From the pivot to the point, as a text.
    pub arm: Option<String>,
    /// How far out a face lies from its pivot, as a text.
    pub lever: Option<String>,
    pub follower: &'a str,
    pub span: Span,
}

/// Parameters beside those of the file, and the driver that stands for the contact.
pub(super) struct Written {
    pub parameters: Vec<(String, String)>,
    pub driver: RawDriver,
}

/// Writes the driver of a law at an angle φ; `name` begins the names of its parameters.
pub(super) fn driver(at: &At, disc: &Disc, program: &Program, law: &LawText, (phi, side): (f64, Side), name: &str) -> Option<Written> {
    let turning = matches!(at.carried, Carried::Pivot { .. });
    let unit = if turning { "deg" } else { "mm" };
    let (i, _, _) = program.stage(phi, side)?;
    let stage = &program.stages[i];
    let mut parameters: Vec<(String, String)> = Vec::new();
    let mut define = |what: &str, text: String| {
        let full = format!("{name}_{what}");
        parameters.push((full.clone(), text));
        full
    };
    // The angle from the start of the law, less whole turns, less the stages before.
    let turned =
        if law.clockwise { format!("({})-({})", law.start, at.cam.angle.text) } else { format!("({})-({})", at.cam.angle.text, law.start) };
    let turns = libm::floor((phi - crate::cam::in_turn(phi)) / std::f64::consts::TAU + 0.5);
    let mut before = String::new();
    let mut lift = String::from("0 ") + unit;
    for (text, stage) in law.stages.iter().zip(&program.stages).take(i) {
        before += &format!("-({})", text.over);
        match (&text.gain, stage.way) {
            (Some(gain), Way::Rise(..)) => lift += &format!("+({})", gain.text),
            (Some(gain), Way::Return(..)) => lift += &format!("-({})", gain.text),
            (None, _) | (_, Way::Dwell) => {}
        }
    }
    let whole = if turns == 0.0 { String::new() } else { format!("-({turns}*360 deg)") };
    let over = &law.stages[i].over;
    let (s, rates) = match (&law.stages[i].gain, stage.law()) {
        (Some(gain), Some(motion)) => {
            let x = define("x", format!("({turned}{whole}{before})/({over})"));
            let sign = if matches!(stage.way, Way::Return(..)) { "-" } else { "" };
            let in_stage = (crate::cam::in_turn(phi) - program.joints()[i]) / stage.over;
            let [s, ds, dds] = motion.text(in_stage.clamp(0.0, 1.0), &x);
            let gain = format!("{sign}({})", gain.text);
            let s = define("s", format!("{lift}{}{gain}*({s})", if sign.is_empty() { "+" } else { "" }));
            let ds = define("ds", format!("{gain}/({over})*({ds})"));
            let dds = define("dds", format!("{gain}/({over})^2*({dds})"));
            (s, Some((ds, dds)))
        }
        _ => (define("s", lift), None),
    };
    let w = if law.clockwise { format!("(-({}))", at.cam.rate_text) } else { format!("({})", at.cam.rate_text) };
    let a = if law.clockwise { format!("(-({}))", at.cam.acceleration_text) } else { format!("({})", at.cam.acceleration_text) };
    let (rate_unit, unit_2) = if turning { ("rad/s", "rad/s^2") } else { ("mm/s", "mm/s^2") };
    let (mut rate, mut acceleration) = match &rates {
        Some((ds, dds)) => (format!("{ds}*{w}"), format!("{dds}*{w}^2+{ds}*{a}")),
        None => (format!("0 {rate_unit}"), format!("0 {unit_2}")),
    };
    let out = if outward(at.carried, &disc.follower) < 0.0 { "-" } else { "+" };
    if out == "-" {
        (rate, acceleration) = (format!("-({rate})"), format!("-({acceleration})"));
    }
    let word = |text: String| Word { text, span: at.span };
    let quantity = |text: String| RawQuantity { text, span: at.span, bare: false };
    let kind = match at.carried {
        Carried::Guide { through, angle, .. } => {
            let [x, y] = at.cam.spot.way_to(through);
            let t = &angle.text;
            // The coordinate counts from `through`; the foot of the centre lies so far before it.
            let foot = define("foot", format!("-({x}*cos({t})+{y}*sin({t}))"));
            let reach = match (&at.radius, disc.touch) {
                (Some(r), Touch::Point { .. }) => {
                    let e = define("e", format!("{x}*sin({t})-{y}*cos({t})"));
                    format!("sqrt((({})+({r}))^2-{e}^2)", law.base)
                }
                _ => format!("({})", law.base),
            };
            let place = define("place", if out == "-" { format!("{foot}-{reach}-({s})") } else { format!("{foot}+{reach}+{s}") });
            RawDriverKind::Slide { slide: word(at.follower.to_owned()), position: Some(quantity(place)) }
        }
        Carried::Pivot { pivot, spot } => {
            let centre = define("d", distance(spot, &at.cam.spot));
            let rest = match (&at.radius, &at.arm, &at.lever) {
                (Some(r), Some(l), _) => {
                    format!("acos(({centre}^2+({l})^2-(({})+({r}))^2)/(2*{centre}*({l})))", law.base)
                }
                (_, _, lever) => {
                    let lever = lever.clone().unwrap_or_else(|| "0 mm".into());
                    format!("asin((({})-({lever}))/{centre})", law.base)
                }
            };
            let rest = define("rest", rest);
            let place = define("place", format!("{}{out}({rest}+{s})", direction(spot, &at.cam.spot)));
            let line = format!("{},{}", at.scene.point_name(*pivot), at.scene.point_name(at.point));
            RawDriverKind::Turn {
                link: word(at.follower.to_owned()),
                against: (at.cam.frame != at.scene.ground).then(|| word(at.scene.link_name(at.cam.frame).to_owned())),
                line: Some(word(line)),
                against_line: None,
                angle: Some(quantity(place)),
            }
        }
    };
    let driver = RawDriver { kind, rate: Some(quantity(rate)), acceleration: Some(quantity(acceleration)), law: None, span: at.span };
    Some(Written { parameters, driver })
}
