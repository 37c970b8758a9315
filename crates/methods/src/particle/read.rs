//! Reads the file: its keys, and their consistency.

use super::ask;
use super::law::{PathLaw, PlateRotation, jet};
use super::peek::{member, named, texts};
use super::rest;
use super::{ParticleMotion, ParticleMotionKind, ParticleProblem, Plate, SpaceAxis};
use hodograph_base::diag::{Both, Diagnostic, Faults, Span, Warned, both};
use hodograph_base::json::fields::{Fields, list, object, suggest, word};
use hodograph_base::json::{self, Node, NodeKind, Word};
use hodograph_scene::front::{self, Front, Law, RawFront, TIME};
use hodograph_scene::units::RequiredQuantity;

/// The keys in addition to those of the front.
pub(super) const KEYS: [&str; 6] = ["statement", "time", "points", "plates", "motions", "find"];
/// The keys of a motion.
pub(super) const MOTION: [&str; 14] = [
    "point", "on", "angle", "to_axis", "centre", "radius", "s", "x", "y", "r", "phi", "toward",
    "speed", "from",
];
/// The keys of a plate.
pub(super) const PLATE: [&str; 6] = ["link", "axis", "angle", "omega", "alpha", "offset"];
/// The largest permitted number of points.
const MOST: usize = 20;
/// Keys that only scenes have.
const OF_SCENES: [&str; 4] = ["links", "ground", "driver", "synthesis"];

/// True if a file describes motions without a mechanism: it has `motions`, and no key of a linkage.
pub fn is_problem(source: &[u8]) -> bool {
    json::parse(source, &mut Faults::default()).is_ok_and(|(_, root)| match &root.kind {
        NodeKind::Object(members) => {
            let has = |key: &str| members.iter().any(|(k, _)| k.text == key);
            has("motions") && !OF_SCENES.iter().any(|key| has(key))
        }
        NodeKind::Text(_)
        | NodeKind::Number(_)
        | NodeKind::Bool(_)
        | NodeKind::Null
        | NodeKind::Array(_) => false,
    })
}

/// Reads a file: JSON in UTF-8.
///
/// # Errors
/// All faults of the file in one list, each with its place as byte offsets into `source`.
pub fn read(source: impl AsRef<[u8]>) -> Result<Warned<ParticleProblem>, Faults> {
    let mut faults = Faults::default();
    let (text, root) = json::parse(source.as_ref(), &mut faults)?;
    let found = problem(&root, text, &mut faults);
    match found {
        Some(value) if !faults.has_errors() => Ok(Warned { value, notes: faults.list }),
        _ => {
            faults.list.retain(|d| !matches!(d.code, "unused-parameter" | "unused-point"));
            faults.list.sort_by_key(|d| d.span.map_or(0, |s| s.start));
            Err(faults)
        }
    }
}

/// The file, with a list of its faults.
struct ParticleReader<'a> {
    front: &'a Front<'a>,
    faults: &'a mut Faults,
    /// The places of points: name, coordinates.
    places: Vec<(Word, [Law; 2])>,
    /// The instant (s).
    now: f64,
    /// Points with places that could not be read.
    misplaced: Vec<String>,
    /// The points of motions that could not be read; `None` if even the point is unknown.
    faulty: Vec<Option<String>>,
}

fn problem(root: &Node, text: &str, faults: &mut Faults) -> Option<ParticleProblem> {
    let keys: Vec<&str> = front::KEYS.iter().chain(&KEYS).copied().collect();
    let f = Fields::open(root, both!("a file of motions without a mechanism"), &keys, faults)?;
    let raw = RawFront::decode(root, faults);
    let front = Front::new(&raw, text, faults);
    let zero = Law::zero();
    let time = match f.get("time") {
        Some(node) => front.time(node, "\"time\"", faults)?,
        None => zero,
    };
    let now = time.at(0.0).map_or(0.0, |v| v.number.0[0]);
    if now < 0.0 {
        let d = Diagnostic::error("time", both!("the instant is {now} s"));
        faults.push(
            d.at(f.get("time").map_or(f.span(), |n| n.span))
                .help(both!("it counts from the start, 0 s")),
        );
    }
    if let Some(name) = f.get("parameters").and_then(|n| member(n, TIME)) {
        let d = Diagnostic::error("name", both!("`t` is the time in the laws of motions"));
        faults.push(d.at(name.span).help(both!("call it `t0`")));
        return None;
    }
    let mut r = ParticleReader {
        front: &front,
        faults,
        places: Vec::new(),
        now,
        misplaced: Vec::new(),
        faulty: Vec::new(),
    };
    r.points(f.get("points"));
    let plates = r.plates(f.get("plates"));
    let motions = r.motions(&f, &plates);
    let faulty = r.faulty.clone();
    let questions = f.get("find").map(texts).unwrap_or_default();
    let statement = f.get("statement").and_then(|n| front.statement(n, r.faults));
    let title = front
        .title
        .as_ref()
        .map_or_else(|| usual_title(&motions), |t| Both { en: t.en.clone(), zh: t.zh.clone() });
    let mut out = ParticleProblem {
        title,
        statement,
        language: front.language,
        parameters: front.parameters(),
        paper: front.paper.clone(),
        book: front.book.clone(),
        time,
        plates,
        motions,
        find: Vec::new(),
    };
    let used = |name: &Word, motions: &[ParticleMotion]| {
        motions.iter().any(|m| m.point == name.text)
            || faulty.iter().any(|n| n.as_ref().is_none_or(|n| *n == name.text))
    };
    let idle = r.places.iter().filter(|(name, _)| !used(name, &out.motions));
    out.motions.extend(rest::asked(&out, idle, &questions));
    for (name, _) in r.places.iter().filter(|(name, _)| !used(name, &out.motions)) {
        let d = Diagnostic::warning(
            "unused-point",
            both!("the point `{}` has no motion, and nothing asks for it", name.text),
        );
        r.faults.push(d.at(name.span));
    }
    // Questions are checked even if other parts have faults; those about motions that could not be
    // read are not reported.
    let before = r.faults.has_errors();
    let found = r.find(&f, &out);
    if !before {
        out.find = found;
    }
    r.faults.list.extend(front.unused());
    Some(out)
}

fn usual_title(motions: &[ParticleMotion]) -> Both {
    let any = |is: fn(&ParticleMotionKind) -> bool| motions.iter().any(|m| is(&m.kind));
    if any(|k| matches!(k, ParticleMotionKind::Toward { .. })) {
        both!("Pursuit")
    } else if any(|k| matches!(k, ParticleMotionKind::OnPlate(..))) {
        both!("A point on a turning plate")
    } else {
        both!("Motion by laws of time")
    }
}

impl ParticleReader<'_> {
    fn fault(&mut self, code: &'static str, at: Span, message: Both, help: Both) {
        self.faults.push(Diagnostic::error(code, message).at(at).help(help));
    }

    /// Reads the radius of a circle: a length greater than zero at the instant.
    fn radius(&mut self, f: &Fields) -> Option<Law> {
        let law = self.need(f, "radius", RequiredQuantity::Length, "\"200 mm\"")?;
        // A law without a value is reported when it is evaluated.
        let Some(value) = jet(&law, self.now).ok().map(|r| r.0[0]).filter(|r| *r <= 0.0) else {
            return Some(law);
        };
        let at = f.get("radius").map_or(f.span(), |n| n.span);
        let message = both!("the radius `{}` is {value} m", law.text);
        self.fault("not-positive", at, message, both!("give a length greater than 0"));
        None
    }

    fn law(&mut self, node: &Node, wanted: RequiredQuantity, key: &str) -> Option<Law> {
        self.front.law(node, wanted, self.now, &format!("\"{key}\""), self.faults)
    }

    fn word(&mut self, f: &Fields, key: &'static str, example: &str) -> Option<Word> {
        let node = f.need(key, example, self.faults)?;
        word(node, &format!("\"{key}\""), self.faults)
    }

    fn need(
        &mut self,
        f: &Fields,
        key: &'static str,
        wanted: RequiredQuantity,
        example: &str,
    ) -> Option<Law> {
        let node = f.need(key, example, self.faults)?;
        self.law(node, wanted, key)
    }

    fn may(&mut self, f: &Fields, key: &'static str, wanted: RequiredQuantity) -> Option<Law> {
        let node = f.get(key)?;
        self.law(node, wanted, key)
    }

    /// Reads two lengths.
    fn two(&mut self, node: &Node, key: &str) -> Option<[Law; 2]> {
        let items = list(node, &format!("\"{key}\""), self.faults)?;
        let [x, y] = items else {
            let message = both!("\"{key}\" has two coordinates, this has {}", items.len());
            self.fault("wrong-count", node.span, message, both!("write [\"0 m\", \"3 km\"]"));
            return None;
        };
        let (x, y) = (
            self.law(x, RequiredQuantity::Length, key),
            self.law(y, RequiredQuantity::Length, key),
        );
        Some([x?, y?])
    }

    fn points(&mut self, node: Option<&Node>) {
        let Some(members) = node.and_then(|n| object(n, "\"points\"", self.faults)) else { return };
        for (name, place) in members {
            match self.two(place, &name.text) {
                Some(at) => self.places.push((name.clone(), at)),
                None => self.misplaced.push(name.text.clone()),
            }
        }
    }

    fn place(&self, name: &str) -> Option<[Law; 2]> {
        self.places.iter().find(|(n, _)| n.text == name).map(|(_, at)| at.clone())
    }

    fn plates(&mut self, node: Option<&Node>) -> Vec<Plate> {
        let items = node.and_then(|n| list(n, "\"plates\"", self.faults)).unwrap_or_default();
        let all: Vec<Plate> = items.iter().take(MOST).filter_map(|n| self.plate(n)).collect();
        for (k, node) in items.iter().enumerate().take(MOST).skip(1) {
            if all.len() == items.len() && all[..k].iter().any(|p| p.link == all[k].link) {
                let message = both!("there are two plates `{}`", all[k].link);
                self.fault("twice", node.span, message, both!("give each a number of its own"));
            }
        }
        all
    }

    fn plate(&mut self, node: &Node) -> Option<Plate> {
        let f = Fields::open(node, both!("a plate"), &PLATE, self.faults)?;
        let link = self.word(&f, "link", "\"2\"");
        let axis = match f.get("axis") {
            Some(n) => {
                let found = word(n, "\"axis\"", self.faults)?;
                let axis = SpaceAxis::ALL.into_iter().find(|a| a.letter() == found.text);
                if axis.is_none() {
                    let message = both!("there is no axis `{}`", found.text);
                    self.fault("unknown-word", found.span, message, both!("the axes are x, y, z"));
                }
                axis?
            }
            None => SpaceAxis::Z,
        };
        let angle = self.need(
            &f,
            "angle",
            RequiredQuantity::Angle,
            "\"90 deg\", or a law such as \"1/3 rad/s*t\"",
        );
        let offset = self.may(&f, "offset", RequiredQuantity::Length);
        let (omega, alpha) = (
            self.may(&f, "omega", RequiredQuantity::Omega),
            self.may(&f, "alpha", RequiredQuantity::Alpha),
        );
        let angle = angle?;
        let turning = if angle.depends_on_time() {
            for key in ["omega", "alpha"] {
                if let Some(n) = f.get(key) {
                    let message = both!("the angle is a law of time, which says `{key}` already");
                    self.fault("given-twice", n.span, message, both!("leave `{key}` out"));
                }
            }
            PlateRotation::Law(angle)
        } else {
            let omega = if f.get("omega").is_some() {
                omega
            } else {
                self.need(&f, "omega", RequiredQuantity::Omega, "\"2 rad/s\"")
            };
            PlateRotation::Now { angle, omega: omega?, alpha }
        };
        if let Some(law) = offset.as_ref().filter(|law| law.depends_on_time()) {
            let at = f.get("offset").map_or(node.span, |n| n.span);
            let message = both!("the distance of the plate from the axis changes: `{}`", law.text);
            self.fault("law", at, message, both!("it is a length that stays"));
        }
        Some(Plate { link: link?.text, axis, turning, offset })
    }

    fn motions(&mut self, f: &Fields, plates: &[Plate]) -> Vec<ParticleMotion> {
        let node = f.need(
            "motions",
            "[{\"point\": \"A\", \"toward\": \"B\", \"speed\": \"5 m/s\"}]",
            self.faults,
        );
        let items = node.and_then(|n| list(n, "\"motions\"", self.faults)).unwrap_or_default();
        if items.is_empty() || items.len() > MOST {
            let message = both!("\"motions\" has {} entries; 1 to {MOST} are wanted", items.len());
            self.fault(
                "wrong-count",
                node.map_or(f.span(), |n| n.span),
                message,
                both!("say how points move"),
            );
            return Vec::new();
        }
        let (mut all, mut toward): (Vec<ParticleMotion>, Vec<(usize, Word)>) =
            (Vec::new(), Vec::new());
        let mut astray: Vec<Word> = Vec::new();
        for node in items {
            let Some((point, kind, target)) = self.motion(node, plates) else {
                self.faulty.push(named(node, "point").map(|w| w.text));
                astray.extend(named(node, "toward"));
                continue;
            };
            if all.iter().any(|m| m.point == point.text) {
                let message = both!("the point `{}` has two motions", point.text);
                self.fault("twice", point.span, message, both!("keep one of them"));
            }
            toward.extend(target.map(|t| (all.len(), t)));
            all.push(ParticleMotion { point: point.text, kind });
        }
        for (k, name) in toward {
            let unread = self.faulty.iter().any(|n| n.as_ref().is_none_or(|n| *n == name.text));
            let found = all.iter().position(|m| m.point == name.text).or_else(|| {
                let place = self.places.iter().find(|(n, _)| n.text == name.text && !unread)?;
                all.push(rest::still(place));
                Some(all.len() - 1)
            });
            match found.map(|t| (t, &all[t].kind)) {
                Some((t, ParticleMotionKind::Fixed(_))) => {
                    if let ParticleMotionKind::Toward { target, .. } = &mut all[k].kind {
                        *target = t;
                    }
                }
                Some((_, ParticleMotionKind::Toward { .. } | ParticleMotionKind::OnPlate(..))) => {
                    let message = both!(
                        "`{}` is no target: it has no law of its own in the plane",
                        name.text
                    );
                    let help = both!(
                        "the target moves by a law: along a line, round a circle, or by x and y"
                    );
                    self.fault("pursuit", name.span, message, help);
                }
                // The fault of that motion is reported elsewhere.
                None if unread || self.misplaced.contains(&name.text) => {}
                None => self.no_motion(&name, &all),
            }
        }
        // Targets of motions that could not be read.
        for name in astray {
            let known = all.iter().any(|m| m.point == name.text)
                || self.faulty.iter().any(|n| n.as_ref().is_none_or(|n| *n == name.text));
            if !known {
                self.no_motion(&name, &all);
            }
        }
        all
    }

    fn no_motion(&mut self, name: &Word, all: &[ParticleMotion]) {
        let message = both!("the point `{}` has no motion", name.text);
        let near = suggest(
            &name.text,
            all.iter().map(|m| m.point.as_str()),
            both!("points that move are"),
        );
        self.fault("unknown-point", name.span, message, near);
    }

    fn motion(
        &mut self,
        node: &Node,
        plates: &[Plate],
    ) -> Option<(Word, ParticleMotionKind, Option<Word>)> {
        let f = Fields::open(node, both!("a motion"), &MOTION, self.faults)?;
        let point = self.word(&f, "point", "\"A\"")?;
        if f.get("toward").is_some() || f.get("speed").is_some() {
            let wrong = ["on", "angle", "to_axis", "centre", "radius", "s", "x", "y", "r", "phi"];
            self.none_of(&f, &wrong, &both!("a point that runs toward another one"));
            let target = self.word(&f, "toward", "\"B\"");
            let speed = self.need(&f, "speed", RequiredQuantity::Velocity, "\"5 m/s\"");
            let from = self.from(&f, &point, true);
            return Some((
                point,
                ParticleMotionKind::Toward { from: from?, target: 0, speed: speed? },
                Some(target?),
            ));
        }
        let plate = match f.get("on") {
            None => None,
            Some(n) => {
                let on = word(n, "\"on\"", self.faults)?;
                let found = plates.iter().position(|p| p.link == on.text);
                if found.is_none() {
                    let message = both!("there is no plate `{}`", on.text);
                    let near = suggest(
                        &on.text,
                        plates.iter().map(|p| p.link.as_str()),
                        both!("the plates are"),
                    );
                    self.fault("unknown-plate", on.span, message, near);
                }
                Some(found?)
            }
        };
        let way = self.way(&f, &point, plate.is_some())?;
        Some((
            point,
            plate.map_or(ParticleMotionKind::Fixed(way.clone()), |k| {
                ParticleMotionKind::OnPlate(k, way)
            }),
            None,
        ))
    }

    fn none_of(&mut self, f: &Fields, wrong: &[&'static str], what: &Both) {
        for key in wrong {
            if let Some(n) = f.get(key) {
                let message = both!("{} has no `{key}`", what);
                self.fault("motion", n.span, message, both!("leave `{key}` out"));
            }
        }
    }

    /// Reads the place of a point at the start: from `from`, or from `points`.
    fn from(&mut self, f: &Fields, point: &Word, needed: bool) -> Option<[Law; 2]> {
        if let Some(n) = f.get("from") {
            return self.two(n, "from");
        }
        let known = self.place(&point.text);
        if known.is_none() && !needed {
            return Some([Law::zero(), Law::zero()]);
        }
        // The fault of its place is reported there.
        if known.is_none() && !self.misplaced.contains(&point.text) {
            let message = both!("where `{}` starts is not said", point.text);
            let help = both!("add \"points\": {{\"{}\": [0, 0]}}", point.text);
            self.fault("missing-key", point.span, message, help);
        }
        known
    }

    fn way(&mut self, f: &Fields, point: &Word, on_plate: bool) -> Option<PathLaw> {
        let has = |key: &str| f.get(key).is_some();
        if has("r") || has("phi") {
            let wrong = ["angle", "to_axis", "centre", "radius", "s", "x", "y"];
            self.none_of(f, &wrong, &both!("a motion by polar coordinates"));
            let (r, phi) = (
                self.need(f, "r", RequiredQuantity::Length, "\"4 m/s*t\""),
                self.need(f, "phi", RequiredQuantity::Angle, "\"2 rad/s*t\""),
            );
            let pole = self.from(f, point, false);
            return Some(PathLaw::Polar { pole: pole?, r: r?, phi: phi? });
        }
        if has("x") || has("y") {
            self.none_of(
                f,
                &["angle", "to_axis", "centre", "radius", "s", "from"],
                &both!("a motion by coordinates"),
            );
            let (x, y) = (
                self.need(f, "x", RequiredQuantity::Length, "\"4 m/s*t\""),
                self.need(f, "y", RequiredQuantity::Length, "\"3 km\""),
            );
            return Some(PathLaw::Free([x?, y?]));
        }
        let s = self.need(f, "s", RequiredQuantity::Length, "\"4 m/s*t\"");
        if has("centre") {
            self.none_of(f, &["to_axis", "from"], &both!("a motion on a circle"));
            let centre = f.get("centre").and_then(|n| self.two(n, "centre"));
            let radius = self.radius(f);
            let angle = self.may(f, "angle", RequiredQuantity::Angle);
            return Some(PathLaw::Circle { centre: centre?, radius: radius?, angle, s: s? });
        }
        self.none_of(f, &["radius"], &both!("a motion along a line"));
        let from = self.from(f, point, !on_plate);
        let (key, example) = if on_plate {
            ("to_axis", "\"60 deg\", from the axis")
        } else {
            ("angle", "\"0 deg\"")
        };
        let other = if on_plate { "angle" } else { "to_axis" };
        self.none_of(
            f,
            &[other],
            &if on_plate { both!("a line on a plate") } else { both!("a line in the fixed plane") },
        );
        let angle = self.need(f, key, RequiredQuantity::Angle, example);
        Some(PathLaw::Line { from: from?, angle: angle?, from_axis: on_plate, s: s? })
    }

    fn find(&mut self, f: &Fields, problem: &ParticleProblem) -> Vec<ask::ParticleQuestion> {
        let Some(node) = f.get("find") else { return ask::all(problem) };
        let items = list(node, "\"find\"", self.faults).unwrap_or_default();
        let mut out = Vec::new();
        for n in items {
            let Some(text) = word(n, "\"find\"", self.faults) else { continue };
            match ask::meaning(problem, &text.text, text.span) {
                Ok(found) => out.push(found),
                Err(_)
                    if self
                        .faulty
                        .iter()
                        .any(|n| n.as_ref().is_none_or(|n| text.text.contains(n.as_str()))) => {}
                Err(d) => self.faults.push(d),
            }
        }
        out
    }
}
