//! Laws of time: as given in a problem, and their values at the instant, as at the start of a
//! solution.

use super::GivenSentences;
use hodograph_base::lang::tr;
use hodograph_board::plan::names::name_label;
use hodograph_paper::paper::label::greek;
use hodograph_paper::paper::phrase::Phrase;
use hodograph_scene::{Kind, Position, TimeLaw};

/// Returns an expression as it is printed: `2*omega*t` is `2·ω·t`, `60 deg` is `60°`.
pub fn printed(text: &str) -> String {
    let plain = text.replace("^2", "²").replace("^3", "³").replace('*', "·").replace('-', "−");
    let mut out = String::new();
    let mut rest = plain.as_str();
    while let Some(c) = rest.chars().next() {
        // A name starts with a letter and continues with letters, digits and underscores.
        let name = |c: char| c.is_alphanumeric() || c == '_';
        let end = if c.is_alphabetic() {
            rest.find(|c| !name(c)).unwrap_or(rest.len())
        } else {
            c.len_utf8()
        };
        let (word, behind) = rest.split_at(end);
        let letters = word.split('_').next().unwrap_or(word);
        match greek(letters) {
            _ if word == "deg" && out.trim_end().ends_with(|c: char| c.is_ascii_digit()) => {
                out.truncate(out.trim_end().len());
                out.push('°');
            }
            Some(letter) => {
                out.push(letter);
                out.push_str(&word[letters.len()..]);
            }
            None => out.push_str(word),
        }
        rest = behind;
    }
    out
}

/// Symbols of a driver in the label language. The rates of a length have none, because v and a are
/// those of points.
struct Symbols {
    position: String,
    rates: Option<[String; 2]>,
}

impl GivenSentences<'_> {
    /// Returns the values of the laws of time at the instant, one line each; empty if the scene has
    /// no laws.
    pub fn laws(&self) -> Vec<Phrase> {
        let drivers = (0..self.scene.drivers.len())
            .filter(|d| self.scene.drivers[*d].law.is_some() && !self.scene.is_led(*d));
        drivers.map(|d| Phrase::new(&self.differentiated(d))).collect()
    }

    /// Returns the law of a driver with the values of its parameters, in place of its position and
    /// rates.
    pub(super) fn by_law(&self, d: usize, law: &TimeLaw) -> String {
        let position = self.symbols(d).position;
        let comma = tr!(self.lang,"clause" => ", ");
        let named = law
            .parameters
            .iter()
            .map(|(name, value)| format!("{comma}{name} = {}", printed(value)));
        format!("{comma}${position}$ = {}{}", printed(&law.text), named.collect::<String>())
    }

    fn differentiated(&self, d: usize) -> String {
        let driver = &self.scene.drivers[d];
        let Symbols { position, rates } = self.symbols(d);
        let at = driver.kind.position().map(|at| match at {
            Position::Angle(angle) => self.angle(angle),
            Position::Length(length) => self.length(length),
        });
        let kinds = if driver.kind.turns() {
            [Kind::Omega, Kind::Alpha]
        } else {
            [Kind::Velocity, Kind::Acceleration]
        };
        let amount = |value: f64, kind: Kind| {
            self.scene.book.label(kind, &super::inked(self.scene.book.value(kind, value)))
        };
        let mut all: Vec<String> =
            at.map(|at| format!("${position} = {at}$")).into_iter().collect();
        let a = driver.acceleration.as_ref().map_or(0.0, |a| a.value);
        let (first, second) = match rates {
            Some([rate, second]) => {
                (format!("{rate} = d{position}/dt"), format!("{second} = d{rate}/dt"))
            }
            None => (format!("d{position}/dt"), format!("d^2{position}/dt^2")),
        };
        all.push(format!("${first} = {}$", amount(driver.rate.value, kinds[0])));
        all.push(format!("${second} = {}$", amount(a, kinds[1])));
        all.join(tr!(self.lang,"clause" => ", "))
    }

    fn symbols(&self, d: usize) -> Symbols {
        let length = |letter: &str, name: &str| Symbols {
            position: format!("{letter}_{{{}}}", name_label(name)),
            rates: None,
        };
        let kind = &self.scene.drivers[d].kind;
        if let Some((link, against)) = kind.turned() {
            let name = self.link(link).to_owned();
            let number = if against == self.scene.ground {
                name
            } else {
                format!("{name}/{}", self.link(against))
            };
            let [position, rate, second] = ["\\varphi", "\\omega", "\\alpha"]
                .map(|s| format!("{s}_{{{}}}", name_label(&number)));
            return Symbols { position, rates: Some([rate, second]) };
        }
        if let Some(guide) = kind.guide() {
            let g = &self.scene.guides[guide.0];
            return length(
                "s",
                g.pin.map(|p| self.name(p)).or(g.slider.map(|s| self.link(s))).unwrap_or_default(),
            );
        }
        length("l", &kind.ends().into_iter().flatten().map(|p| self.name(p)).collect::<String>())
    }
}
