//! Masses, forces, springs.

use super::{Givens, as_written, inked};
use hodograph_board::plan::names::name_label;
use hodograph_scene::{Given, Lang, Mass, Size};

impl Givens<'_> {
    /// Given masses, loads and springs, a line for each.
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
            all.push(format!("{}{}", self.tr("masses: ", "质量："), masses.join(self.tr("; ", "；"))));
        }
        let applied: Vec<String> = loads
            .applied
            .iter()
            .map(|a| {
                let link = name_label(self.scene.link_name(a.link));
                let at = a.at.map(|p| self.point(p));
                let amount = |given: &Given, unit| self.amount(given, unit);
                match (&a.size, at, self.lang()) {
                    (Size::Couple(m), _, Lang::En) => format!("${}$ on link {link}", amount(m, "N·m")),
                    (Size::Couple(m), _, Lang::Zh) => format!("构件 {link} 上 ${}$", amount(m, "N·m")),
                    (Size::AgainstTurning(m), _, Lang::En) => format!("${}$ on link {link}, against its turning", amount(m, "N·m")),
                    (Size::AgainstTurning(m), _, Lang::Zh) => format!("构件 {link} 上 ${}$，与转向相反", amount(m, "N·m")),
                    (Size::AgainstMotion(f), Some(p), Lang::En) => {
                        format!("${}$ at {p} of link {link}, against its motion", amount(f, "N"))
                    }
                    (Size::AgainstMotion(f), Some(p), Lang::Zh) => format!("构件 {link} 的 {p} 点 ${}$，与运动方向相反", amount(f, "N")),
                    (Size::Components([x, y]), Some(p), Lang::En) => {
                        format!("$({}, {})$ at {p} of link {link}", amount(x, "N"), amount(y, "N"))
                    }
                    (Size::Components([x, y]), Some(p), Lang::Zh) => {
                        format!("构件 {link} 的 {p} 点 $({}, {})$", amount(x, "N"), amount(y, "N"))
                    }
                    (Size::Directed { force, line, angle }, Some(p), lang) => {
                        let mut direction = line.map_or_else(String::new, |(a, b)| format!("{}{}", self.point(a), self.point(b)));
                        if let Some(angle) = angle {
                            direction = [direction, format!("${}$", self.angle(angle))]
                                .into_iter()
                                .filter(|s| !s.is_empty())
                                .collect::<Vec<_>>()
                                .join(" + ");
                        }
                        match lang {
                            Lang::En => format!("${}$ at {p} of link {link}, along {direction}", amount(force, "N")),
                            Lang::Zh => format!("构件 {link} 的 {p} 点 ${}$，方向 {direction}", amount(force, "N")),
                        }
                    }
                    (Size::AgainstMotion(f) | Size::Directed { force: f, .. }, None, _) => format!("${}$", amount(f, "N")),
                    (Size::Components([x, y]), None, _) => format!("$({}, {})$", amount(x, "N"), amount(y, "N")),
                }
            })
            .collect();
        if !applied.is_empty() {
            all.push(format!("{}{}", self.tr("loads: ", "载荷："), applied.join(self.tr("; ", "；"))));
        }
        let springs: Vec<String> = loads
            .springs
            .iter()
            .map(|s| {
                let [a, b] = s.ends.map(|(p, _)| self.point(p));
                format!("{a}{b}: $k = {}$, $l_0 = {}$", self.amount(&s.stiffness, "N/m"), self.length(&s.free))
            })
            .collect();
        if !springs.is_empty() {
            all.push(format!("{}{}", self.tr("springs: ", "弹簧："), springs.join(self.tr("; ", "；"))));
        }
        all
    }

    fn mass(&self, mass: &Mass) -> String {
        let link = name_label(self.scene.link_name(mass.link));
        let mut parts = Vec::new();
        match (&mass.weight, &mass.m) {
            (Some(weight), _) => parts.push(format!("$G_{{{link}}} = {}$", self.amount(weight, "N"))),
            (None, Some(m)) => parts.push(format!("$m_{{{link}}} = {}$", self.amount(m, "kg"))),
            (None, None) => {}
        }
        let at = mass.at.map(|p| self.point(p));
        parts.extend(mass.j.as_ref().map(|j| format!("$J_{{{link}}} = {}$", self.amount(j, "kg·m^2"))));
        if let Some(p) = at {
            parts.push(self.tr("at ", "质心 ").to_owned() + &p);
        }
        parts.join(self.tr(", ", "，"))
    }

    /// An amount as it is written where that is a number with its unit, else in SI units.
    fn amount(&self, given: &Given, si: &str) -> String {
        let text = given.text.trim();
        let end = text.find(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | '-'))).unwrap_or(text.len());
        let (digits, unit) = (&text[..end], text[end..].trim());
        let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '*' | '/' | '^');
        let (digits, unit) = match !digits.is_empty() && !unit.is_empty() && unit.chars().all(plain) {
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
