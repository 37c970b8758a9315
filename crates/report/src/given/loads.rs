//! Masses, forces and springs in the given data.

use super::{GivenSentences, as_written, inked};
use hodograph_board::plan::names::name_label;
use hodograph_scene::{Abscissa, GivenQuantity, Lang, LoadCourse, LoadSize, LoadTravel, Mass, Rub};

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
            all.push(match (self.lang(), down) {
                (Lang::En, true) => format!("gravity {amount}, downward"),
                (Lang::Zh, true) => format!("重力加速度 {amount}，方向向下"),
                (Lang::En, false) => format!("gravity {amount}, at ${direction}\\degree$"),
                (Lang::Zh, false) => format!("重力加速度 {amount}，方向角 ${direction}\\degree$"),
            });
        }
        let masses: Vec<String> = loads.masses.iter().map(|m| self.mass(m)).collect();
        if !masses.is_empty() {
            all.push(format!(
                "{}{}",
                self.tr("masses: ", "质量："),
                masses.join(self.tr("; ", "；"))
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
                let told = match (&a.size, at, self.lang()) {
                    (LoadSize::Couple(m), _, Lang::En) => {
                        format!("${}$ on link {link}", amount(m, "N·m"))
                    }
                    (LoadSize::Couple(m), _, Lang::Zh) => {
                        format!("构件 {link} 上 ${}$", amount(m, "N·m"))
                    }
                    (LoadSize::AgainstTurning(m), _, Lang::En) => {
                        format!("${}$ on link {link}, against its turning", amount(m, "N·m"))
                    }
                    (LoadSize::AgainstTurning(m), _, Lang::Zh) => {
                        format!("构件 {link} 上 ${}$，与转向相反", amount(m, "N·m"))
                    }
                    (LoadSize::AgainstMotion(f), Some(p), Lang::En) => {
                        format!("${}$ at {p} of link {link}, against its motion", amount(f, "N"))
                    }
                    (LoadSize::AgainstMotion(f), Some(p), Lang::Zh) => {
                        format!("构件 {link} 的 {p} 点 ${}$，与运动方向相反", amount(f, "N"))
                    }
                    (LoadSize::Components([x, y]), Some(p), Lang::En) => {
                        format!("$({}, {})$ at {p} of link {link}", amount(x, "N"), amount(y, "N"))
                    }
                    (LoadSize::Components([x, y]), Some(p), Lang::Zh) => {
                        format!("构件 {link} 的 {p} 点 $({}, {})$", amount(x, "N"), amount(y, "N"))
                    }
                    (LoadSize::Directed { force, line, angle }, Some(p), lang) => {
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
                        match lang {
                            Lang::En => format!(
                                "${}$ at {p} of link {link}, along {direction}",
                                amount(force, "N")
                            ),
                            Lang::Zh => format!(
                                "构件 {link} 的 {p} 点 ${}$，方向 {direction}",
                                amount(force, "N")
                            ),
                        }
                    }
                    (LoadSize::AgainstMotion(f) | LoadSize::Directed { force: f, .. }, None, _) => {
                        format!("${}$", amount(f, "N"))
                    }
                    (LoadSize::Components([x, y]), None, _) => {
                        format!("$({}, {})$", amount(x, "N"), amount(y, "N"))
                    }
                };
                told + &course
            })
            .collect();
        if !applied.is_empty() {
            all.push(format!(
                "{}{}",
                self.tr("loads: ", "载荷："),
                applied.join(self.tr("; ", "；"))
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
                self.tr("springs: ", "弹簧："),
                springs.join(self.tr("; ", "；"))
            ));
        }
        let friction: Vec<String> = loads.friction.iter().map(|f| self.friction(&f.at)).collect();
        if !friction.is_empty() {
            all.push(format!(
                "{}{}",
                self.tr("friction: ", "摩擦："),
                friction.join(self.tr("; ", "；"))
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
                match (self.lang(), self.scene.carriers(*point).count() > 2) {
                    (Lang::En, false) => format!("friction circle $\\rho = {circle}$ at {pin}"),
                    (Lang::En, true) => format!(
                        "friction circle $\\rho = {circle}$ at {pin}, whose pin is fast in link {fast}"
                    ),
                    (Lang::Zh, false) => format!("{pin} 处摩擦圆半径 $\\rho = {circle}$"),
                    (Lang::Zh, true) => {
                        format!("{pin} 处摩擦圆半径 $\\rho = {circle}$，销固定在构件 {fast} 上")
                    }
                }
            }
            Rub::Guide { guide, f } => {
                let own = &self.scene.guides[guide.0];
                let slider = own.slider.map(|s| name_label(self.scene.link_name(s)));
                let (link, f) = (
                    slider.or_else(|| own.pin.map(|p| self.point(p))).unwrap_or_default(),
                    inked(f.value),
                );
                match self.lang() {
                    Lang::En => format!("$f = {f}$ in the guide of {link}"),
                    Lang::Zh => format!("{link} 的导路 $f = {f}$"),
                }
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
        let along = match (&course.along, self.lang()) {
            (LoadTravel::Stroke { point, .. }, Lang::En) => {
                format!("the working stroke of {}", self.point(*point))
            }
            (LoadTravel::Stroke { point, .. }, Lang::Zh) => {
                format!("{} 的工作行程", self.point(*point))
            }
            (LoadTravel::Turn { driver, .. }, lang) => {
                let link = self.scene.drivers[*driver]
                    .kind
                    .turned()
                    .map_or("", |(l, _)| self.scene.link_name(l));
                let angle = format!("$\\varphi_{{{}}}$", name_label(link));
                if lang == Lang::En {
                    format!("the angle {angle}")
                } else {
                    format!("转角 {angle}")
                }
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
        match (points.is_empty(), self.lang()) {
            (true, Lang::En) => format!(", from {from} to {to} of {along}"),
            (true, Lang::Zh) => format!("，作用于{along} {from} 至 {to}"),
            (false, Lang::En) => format!(", over {along} ({})", points.join("; ")),
            (false, Lang::Zh) => format!("，随{along}变化（{}）", points.join("；")),
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
            parts.push(self.tr("at ", "质心 ").to_owned() + &p);
        }
        parts.join(self.tr(", ", "，"))
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
