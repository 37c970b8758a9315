//! Masses, forces and springs in the given data.

use super::{GivenSentences, as_written, inked};
use hodograph_base::lang::{say, tr};
use hodograph_board::plan::names::name_label;
use hodograph_scene::{Abscissa, GivenQuantity, LoadCourse, LoadSize, LoadTravel, Mass, Rub};

impl GivenSentences<'_> {
    /// Returns the given masses, loads and springs, one line each.
    pub(super) fn loads(&self) -> Vec<String> {
        let loads = &self.scene.loads;
        let mut all = Vec::new();
        if let Some([x, y]) = &loads.gravity {
            let size = libm::hypot(x.value, y.value);
            let down = x.value == 0.0 && y.value < 0.0;
            let amount = format!("$g = {}\\,\\text{{m/s}}^2$", inked(size));
            let direction = inked(libm::atan2(y.value, x.value).to_degrees());
            all.push(match down {
                true => say!(self.lang(), "gravity {amount}, downward"),
                false => say!(self.lang(), "gravity {amount}, at ${direction}\\degree$"),
            });
        }
        let masses: Vec<String> = loads.masses.iter().map(|m| self.mass(m)).collect();
        if !masses.is_empty() {
            all.push(format!(
                "{}{}",
                tr!(self.lang, "masses: "),
                masses.join(self.lang.semicolon())
            ));
        }
        let applied: Vec<String> = loads
            .applied
            .iter()
            .map(|a| {
                let link = name_label(self.scene.link_name(a.link));
                let at = a.at.map(|p| self.point(p));
                let course =
                    a.course.as_ref().map_or_else(String::new, |c| self.course(c, a.at.is_none()));
                let graph = a
                    .course
                    .as_ref()
                    .is_some_and(|c| c.stations.iter().any(|s| s.amount.is_some()));
                // The amounts of a diagram follow.
                let amount = |given: &GivenQuantity, unit| match (graph, a.at) {
                    (true, Some(_)) => "F".to_owned(),
                    (true, None) => "M".to_owned(),
                    (false, _) => self.amount(given, unit),
                };
                let lang = self.lang();
                let told = match (&a.size, at) {
                    (LoadSize::Couple(m), _) => {
                        say!(lang, "${}$ on link {link}", amount(m, "N·m"))
                    }
                    (LoadSize::AgainstTurning(m), _) => {
                        say!(lang, "${}$ on link {link}, against its turning", amount(m, "N·m"))
                    }
                    (LoadSize::AgainstMotion(f), Some(p)) => {
                        say!(lang, "${}$ at {p} of link {link}, against its motion", amount(f, "N"))
                    }
                    (LoadSize::Components([x, y]), Some(p)) => say!(
                        lang,
                        "$({}, {})$ at {p} of link {link}",
                        amount(x, "N"),
                        amount(y, "N")
                    ),
                    (LoadSize::Directed { force, line, angle }, Some(p)) => {
                        let mut direction = line.map_or_else(String::new, |(a, b)| {
                            format!("{}{}", self.point(a), self.point(b))
                        });
                        if let Some(angle) = angle {
                            direction = [direction, format!("${}$", self.angle(angle))]
                                .into_iter()
                                .filter(|s| !s.is_empty())
                                .collect::<Vec<_>>()
                                .join(" + ");
                        }
                        say!(
                            lang,
                            "${}$ at {p} of link {link}, along {direction}",
                            amount(force, "N")
                        )
                    }
                    (LoadSize::AgainstMotion(f) | LoadSize::Directed { force: f, .. }, None) => {
                        format!("${}$", amount(f, "N"))
                    }
                    (LoadSize::Components([x, y]), None) => {
                        format!("$({}, {})$", amount(x, "N"), amount(y, "N"))
                    }
                };
                told + &course
            })
            .collect();
        if !applied.is_empty() {
            all.push(format!(
                "{}{}",
                tr!(self.lang, "loads: "),
                applied.join(self.lang.semicolon())
            ));
        }
        let springs: Vec<String> = loads
            .springs
            .iter()
            .map(|s| {
                let [a, b] = s.ends.map(|(p, _)| self.point(p));
                format!(
                    "{a}{b}: $k = {}$, $l_0 = {}$",
                    self.amount(&s.stiffness, "N/m"),
                    self.length(&s.free)
                )
            })
            .collect();
        if !springs.is_empty() {
            all.push(format!(
                "{}{}",
                tr!(self.lang, "springs: "),
                springs.join(self.lang.semicolon())
            ));
        }
        let friction: Vec<String> = loads.friction.iter().map(|f| self.friction(&f.at)).collect();
        if !friction.is_empty() {
            all.push(format!(
                "{}{}",
                tr!(self.lang, "friction: "),
                friction.join(self.lang.semicolon())
            ));
        }
        all
    }

    fn friction(&self, at: &Rub) -> String {
        match at {
            Rub::Pin { point, fast, circle } => {
                let (pin, circle, fast) = (
                    self.point(*point),
                    self.length(circle),
                    name_label(self.scene.link_name(*fast)),
                );
                match self.scene.carriers(*point).count() > 2 {
                    false => say!(self.lang(), "friction circle $\\rho = {circle}$ at {pin}"),
                    true => say!(
                        self.lang(),
                        "friction circle $\\rho = {circle}$ at {pin}, whose pin is fast in link {fast}"
                    ),
                }
            }
            Rub::Guide { guide, f } => {
                let own = &self.scene.guides[guide.0];
                let slider = own.slider.map(|s| name_label(self.scene.link_name(s)));
                let (link, f) = (
                    slider.or_else(|| own.pin.map(|p| self.point(p))).unwrap_or_default(),
                    inked(f.value),
                );
                say!(self.lang(), "$f = {f}$ in the guide of {link}")
            }
        }
    }

    /// Returns the part of the motion over which a load acts, with its amounts there.
    fn course(&self, course: &LoadCourse, couple: bool) -> String {
        let place = |x: &Abscissa| match x {
            Abscissa::Part(x) => format!("${}$", inked(x.value)),
            Abscissa::Way(x) => format!("${}$", self.length(x)),
            Abscissa::Angle(a) => format!("${}$", self.angle(a)),
        };
        let ends = course
            .stations
            .first()
            .zip(course.stations.last())
            .map(|(a, b)| [place(&a.at), place(&b.at)]);
        let Some([from, to]) = ends else { return String::new() };
        let lang = self.lang();
        let along = match &course.along {
            LoadTravel::Stroke { point, .. } => {
                say!(lang, "the working stroke of {}", self.point(*point))
            }
            LoadTravel::Turn { driver, .. } => {
                let link = self.scene.drivers[*driver]
                    .kind
                    .turned()
                    .map_or("", |(l, _)| self.scene.link_name(l));
                say!(lang, "the angle $\\varphi_{{{}}}$", name_label(link))
            }
        };
        let unit = if couple { "N·m" } else { "N" };
        let points: Vec<String> = course
            .stations
            .iter()
            .filter_map(|s| {
                Some(format!("{}: ${}$", place(&s.at), self.amount(s.amount.as_ref()?, unit)))
            })
            .collect();
        match points.is_empty() {
            true => say!(self.lang(), ", from {from} to {to} of {along}"),
            false => say!(self.lang(), ", over {along} ({})", points.join(self.lang().semicolon())),
        }
    }

    fn mass(&self, mass: &Mass) -> String {
        let link = name_label(self.scene.link_name(mass.link));
        let mut parts = Vec::new();
        match (&mass.weight, &mass.m) {
            (Some(weight), _) => {
                parts.push(format!("$G_{{{link}}} = {}$", self.amount(weight, "N")))
            }
            (None, Some(m)) => parts.push(format!("$m_{{{link}}} = {}$", self.amount(m, "kg"))),
            (None, None) => {}
        }
        let at = mass.at.map(|p| self.point(p));
        parts.extend(
            mass.j.as_ref().map(|j| format!("$J_{{{link}}} = {}$", self.amount(j, "kg·m^2"))),
        );
        if let Some(p) = at {
            parts.push(tr!(self.lang, "at ").to_owned() + &p);
        }
        parts.join(tr!(self.lang,"clause" => ", "))
    }

    /// Returns an amount as it is written if it is a number with its unit, else in SI units.
    fn amount(&self, given: &GivenQuantity, si: &str) -> String {
        let text = given.text.trim();
        let end = text
            .find(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | '-')))
            .unwrap_or(text.len());
        let (digits, unit) = (&text[..end], text[end..].trim());
        let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '*' | '/' | '^');
        let (digits, unit) = match !digits.is_empty() && !unit.is_empty() && unit.chars().all(plain)
        {
            true => (as_written(digits), unit.replace('*', "·")),
            false => (inked(given.value), si.to_owned()),
        };
        let upright: Vec<String> = unit
            .split('^')
            .enumerate()
            .map(|(k, part)| match (k, part.get(..1)) {
                (0, _) => format!("\\text{{{part}}}"),
                (_, Some(power)) if part.len() > 1 => format!("^{power}\\text{{{}}}", &part[1..]),
                _ => format!("^{part}"),
            })
            .collect();
        format!("{digits}\\,{}", upright.concat())
    }
}
