//! The given data as a list, with numbers as the scene writes them: lengths, fixed points, guides
//! ([`guide`]), masses and forces ([`loads`]), gears and wheels ([`rolling`]), belts and chains
//! ([`belts`]), cams ([`cams`]), drivers, laws of time ([`law`]).

mod belts;
mod cams;
mod guide;
pub mod law;
mod loads;
mod rolling;

use super::amount::{number, scale};
use hodograph_base::digits::{self, shortest};
use hodograph_base::lang::{say, tr};
use hodograph_board::plan::names::name_label;
use hodograph_board::plan::text::point_label;
use hodograph_paper::paper::phrase::Phrase;
use hodograph_paper::paper::words::{Words, words};
use hodograph_scene::{
    Angle, Book, DriverKind, GivenQuantity, Kind, Lang, LinkId, PointId, PointPlace, QuantityText,
    Scene,
};

/// Digits of a given number that the scene computes, as in `2*r`.
const DIGITS: usize = 6;

/// Longest pair of coordinates, in characters, that fits beside a drawing.
const LONG: usize = 24;

/// The given data of a scene, in words.
#[derive(Clone, Copy)]
pub struct GivenSentences<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The language of the words.
    pub lang: Lang,
}

impl GivenSentences<'_> {
    fn lang(&self) -> Lang {
        self.lang
    }

    fn words(&self) -> &'static Words {
        words(self.lang)
    }

    /// Returns the list of given data.
    pub fn list(&self) -> Vec<Phrase> {
        let mut all = self.lengths(|_, _| true);
        all.extend(self.others());
        all.iter().map(|s| Phrase::new(s)).collect()
    }

    /// Returns all given data except the lengths that a figure shows.
    pub fn beside(&self, shown: impl Fn(PointId, PointId) -> bool) -> Vec<Phrase> {
        let mut all = self.lengths(|a, b| !shown(a, b));
        all.extend(self.others());
        all.iter().map(|s| Phrase::new(s)).collect()
    }

    fn lengths(&self, wanted: impl Fn(PointId, PointId) -> bool) -> Vec<String> {
        let mut all = Vec::new();
        // The ends in the order of the scene, as in the equations.
        let ends = |a: PointId, b: PointId| {
            name_label(&format!("{}{}", self.name(a.min(b)), self.name(a.max(b))))
        };
        let written =
            self.scene.lengths.iter().filter(|l| ![l.a, l.b].iter().any(|p| self.is_of_cam(*p)));
        let lengths: Vec<String> = written
            .filter(|l| wanted(l.a, l.b))
            .map(|l| format!("$l_{{{}}} = {}$", ends(l.a, l.b), self.length(&l.value)))
            .collect();
        if !lengths.is_empty() {
            all.push(format!(
                "{}{}",
                tr!(self.lang, "lengths: "),
                lengths.join(self.lang().comma())
            ));
        }
        all
    }

    fn others(&self) -> Vec<String> {
        let mut all = Vec::new();
        // Points that only belong to the replacement of a cam are not in the file.
        let places: Vec<String> = (0..self.scene.points.len())
            .map(PointId)
            .filter(|p| !self.is_of_cam(*p))
            .filter_map(|p| self.place(p))
            .collect();
        if !places.is_empty() {
            all.push(format!(
                "{}{}",
                tr!(self.lang, "points: "),
                places.join(self.lang.semicolon())
            ));
        }
        // Guides that belong to rolling pairs and cams are not in the file.
        let guides = self
            .scene
            .guides
            .iter()
            .enumerate()
            .filter(|(g, guide)| guide.rolling.is_none() && !self.is_contact(*g));
        all.extend(guides.map(|(_, g)| self.guide(g)));
        all.extend(self.scene.rolling.iter().map(|pair| self.rolling(pair)));
        all.extend(self.scene.cams.iter().map(|c| self.cam(c)));
        all.extend(
            (0..self.scene.drivers.len())
                .filter(|d| !self.scene.is_led(*d))
                .map(|d| self.driver(d)),
        );
        all.extend(self.loads());
        all.push(say!(self.lang(), "link {} is fixed", self.link(self.scene.ground)));
        all
    }

    fn name(&self, p: PointId) -> &str {
        self.scene.point_name(p)
    }

    /// Returns a point as a formula.
    pub fn point(&self, p: PointId) -> String {
        format!("${}$", point_label(self.name(p)))
    }

    fn link(&self, l: LinkId) -> &str {
        self.scene.link_name(l)
    }

    fn place(&self, p: PointId) -> Option<String> {
        let symbol = point_label(self.name(p));
        Some(match &self.scene.points[p.0].place {
            PointPlace::Unknown => return None,
            PointPlace::At([x, y]) => {
                let (x, y) = (self.length(x), self.length(y));
                // A line may break between coordinates of many digits.
                let between = if x.len() + y.len() > LONG { "$ $" } else { " " };
                format!("${symbol} = ({x},{between}{y})$")
            }
            PointPlace::InLink { base: (a, b), xy: [x, y] } => {
                let line =
                    format!("${}{}$", point_label(self.name(*a)), point_label(self.name(*b)));
                let (a, b) = (self.point(*a), self.point(*b));
                let back = x.value < 0.0;
                let size = self.unsigned(x);
                let along = match back {
                    true => say!(self.lang(), "${symbol}$ is ${size}$ from {a} away from {b}"),
                    false => say!(self.lang(), "${symbol}$ is ${size}$ from {a} toward {b}"),
                };
                let left = y.value > 0.0;
                let size = self.unsigned(y);
                match left {
                    _ if y.value == 0.0 => along,
                    true => say!(self.lang(), "{along} and ${size}$ to the left"),
                    false => say!(self.lang(), "{along} and ${size}$ to the right"),
                }
            }
            PointPlace::Polar { base: (a, b), length: l, angle: turn } => {
                let (from, to) = (point_label(self.name(*a)), point_label(self.name(*b)));
                let known = format!("${from}{symbol} = {}$", self.length(l));
                say!(
                    self.lang(),
                    "{known}, turned by ${}$ from ${from}{to}$ (counter-clockwise plus)",
                    self.angle(turn)
                )
            }
        })
    }

    fn driver(&self, d: usize) -> String {
        let driver = &self.scene.drivers[d];
        let comma = tr!(self.lang,"clause" => ", ");
        let mut out = match &driver.kind {
            DriverKind::Turn { link, against, angle: given, .. } => {
                let name = self.link(*link);
                let mut out = say!(self.lang(), "driver: link {name}");
                let number = if *against == self.scene.ground {
                    name.to_owned()
                } else {
                    out += &say!(self.lang(), ", turning relative to link {}", self.link(*against));
                    format!("{name}/{}", self.link(*against))
                };
                let number = name_label(&number);
                if let Some(law) = &driver.law {
                    return out + &self.by_law(d, law);
                }
                if let Some(a) = given {
                    out += &format!("{comma}$\\varphi_{{{number}}} = {}$", self.angle(a));
                }
                let (symbol, second) =
                    (format!("\\omega_{{{number}}}"), format!("\\alpha_{{{number}}}"));
                return self.driven(out, d, [&symbol, &second], [Kind::Omega, Kind::Alpha], true);
            }
            DriverKind::Slide { guide, position } => {
                let g = &self.scene.guides[guide.0];
                let what = g
                    .pin
                    .map(|p| self.point(p))
                    .or(g.slider.map(|s| self.link(s).to_owned()))
                    .unwrap_or_default();
                let mut out = say!(self.lang(), "driver: {what} along its guide");
                if let Some(law) = &driver.law {
                    return out + &self.by_law(d, law);
                }
                if let Some(s) = position {
                    out += &format!("{comma}$s = {}$", self.length(s));
                }
                out
            }
            DriverKind::Cylinder { a, b, length: given, .. } => {
                let ends = name_label(&format!("{}{}", self.name(*a), self.name(*b)));
                let mut out = say!(self.lang(), "driver: cylinder ${ends}$");
                if let Some(law) = &driver.law {
                    return out + &self.by_law(d, law);
                }
                if let Some(l) = given {
                    out += &format!("{comma}$l_{{{ends}}} = {}$", self.length(l));
                }
                out
            }
        };
        out = self.driven(out, d, ["v", "a"], [Kind::Velocity, Kind::Acceleration], false);
        out
    }

    /// Appends the rate of a driver and its acceleration.
    fn driven(
        &self,
        mut out: String,
        d: usize,
        symbols: [&str; 2],
        kinds: [Kind; 2],
        turns: bool,
    ) -> String {
        let driver = &self.scene.drivers[d];
        if !driver.rate_told {
            return out;
        }
        let comma = tr!(self.lang,"clause" => ", ");
        let told = |symbol: &str, given: &GivenQuantity, kind: Kind| {
            // The sense of rotation is given in words.
            let shown = |number: String| {
                if turns { number.trim_start_matches('−').to_owned() } else { number }
            };
            let amount = match self.scene.told(kind, &given.text, given.value) {
                QuantityText::AsWritten(number, unit) => unit.label(&shown(as_written(&number))),
                QuantityText::Computed(value, unit) => unit.label(&shown(inked(value))),
                QuantityText::Usual => Book::default().label(kind, &shown(inked(given.value))),
            };
            let sense = if turns { self.words().sense(given.value) } else { "" };
            format!("{comma}$ {symbol} = {amount}$ {sense}").trim_end().to_owned()
        };
        out += &told(symbols[0], &driver.rate, kinds[0]);
        match &driver.acceleration {
            Some(a) if a.value != 0.0 => out += &told(symbols[1], a, kinds[1]),
            _ => out += tr!(self.lang, " (constant)"),
        }
        out
    }

    /// Returns a length as it is given.
    pub fn length(&self, given: &GivenQuantity) -> String {
        match (self.scene.told(Kind::Length, &given.text, given.value), given.value) {
            (QuantityText::AsWritten(number, unit), _) => unit.label(&as_written(&number)),
            (QuantityText::Computed(value, unit), _) => unit.label(&inked(value)),
            (QuantityText::Usual, 0.0) => "0".into(),
            (QuantityText::Usual, metres) if metres.abs() >= 10.0 => format!("{} m", inked(metres)),
            (QuantityText::Usual, metres) => format!("{} mm", inked(metres * 1e3)),
        }
    }

    /// Returns a length without its sign, which is given in words.
    fn unsigned(&self, given: &GivenQuantity) -> String {
        self.length(given).trim_start_matches('−').to_owned()
    }

    /// Returns an angle as it is given; an angle written in degrees is reduced by full turns.
    pub fn angle(&self, given: &GivenQuantity<Angle>) -> String {
        match self.scene.told(Kind::Angle, &given.text, given.value.radians()) {
            QuantityText::AsWritten(number, unit) if !unit.is_degree() => {
                unit.label(&as_written(&number))
            }
            QuantityText::Computed(value, unit) if !unit.is_degree() => unit.label(&inked(value)),
            QuantityText::AsWritten(..) | QuantityText::Computed(..) | QuantityText::Usual => {
                format!("{}\\degree", inked(given.value.degrees()))
            }
        }
    }
}

/// Returns a number in the label language in its shortest form, limited to [`DIGITS`] if computed.
fn inked(value: f64) -> String {
    if shortest(value).len() > DIGITS + 2 {
        number(value, DIGITS)
    } else {
        scale(value).replace('-', "−")
    }
}

/// Returns a number in the label language with the digits with which it is written.
fn as_written(number: &str) -> String {
    digits::inked(&number.replace('E', "e"))
}
