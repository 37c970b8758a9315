//! Given and wanted quantities of a motion without a mechanism, in words.

use crate::diag::{Both, both};
use crate::notation::Notation;
use crate::paper::phrase::Phrase;
use crate::particle::law::{Turning, Way};
use crate::particle::plate::Part;
use crate::particle::{Asked, Kind, Motion, Mutual, Plate, Problem};
use crate::report::given::law::printed;
use crate::report::particle::symbol;
use crate::scene::Lang;
use crate::scene::front::Law;

/// An expression in print; a single parameter is replaced by its value.
fn told(problem: &Problem, law: &Law) -> String {
    let value = problem.parameters.iter().find(|(name, _)| name == law.text.trim()).map(|(_, value)| value.as_str());
    printed(value.unwrap_or(&law.text))
}

/// Parameters, plates, motions and the instant, one line each.
pub fn given(problem: &Problem, lang: Lang) -> Vec<Phrase> {
    let mut out: Vec<Both> = Vec::new();
    if !problem.parameters.is_empty() {
        let all: Vec<String> = problem.parameters.iter().map(|(name, value)| format!("{} = {}", printed(name), printed(value))).collect();
        out.push(Both { en: all.join(", "), zh: all.join("，") });
    }
    out.extend(problem.plates.iter().map(|p| plate(problem, p)));
    out.extend(problem.motions.iter().map(|m| motion(problem, m)));
    out.push(both!("the instant: t = {}", "所求时刻：t = {}", told(problem, &problem.time)));
    out.iter().map(|said| Phrase::new(lang.of(said))).collect()
}

fn plate(problem: &Problem, p: &Plate) -> Both {
    let axis = p.axis.letter();
    let place = match &p.offset {
        Some(offset) => both!("lies {} beside the axis {}", "与 {1} 轴相距 {0}", told(problem, offset), axis),
        None => both!("contains the axis {axis}", "过 {axis} 轴"),
    };
    let turning = match &p.turning {
        Turning::Law(law) => both!("φ = {}", "φ = {}", told(problem, law)),
        Turning::Now { angle, omega, alpha } => {
            let alpha = alpha.as_ref().map_or_else(Both::default, |a| both!(", α = {0}", "，α = {0}", told(problem, a)));
            both!("at the instant φ = {}, ω = {}{}", "该时刻 φ = {}，ω = {}{}", told(problem, angle), told(problem, omega), alpha)
        }
    };
    let from = p.axis.order()[0];
    both!(
        "plate {} {} and turns about it; {}, φ from the axis {}",
        "平板 {} {}，并绕其转动；{}，φ 自 {} 轴量起",
        p.link,
        place,
        turning,
        ["x", "y", "z"][from]
    )
}

fn motion(problem: &Problem, m: &Motion) -> Both {
    let at = |place: &[Law; 2]| format!("({}, {})", told(problem, &place[0]), told(problem, &place[1]));
    let point = &m.point;
    match &m.kind {
        Kind::Toward { from, target, speed } => both!(
            "${point}$ starts at {} and always runs toward ${}$ with the speed {}",
            "${point}$ 自 {} 出发，始终朝向 ${}$ 运动，速率 {}",
            at(from),
            problem.motions[*target].point,
            told(problem, speed)
        ),
        Kind::Fixed(Way::Free(place)) if place.iter().all(|law| !law.depends_on_time()) => {
            both!("${point}$ is at rest at {}", "${point}$ 静止于 {}", at(place))
        }
        Kind::Fixed(way) => path(problem, point, &both!("moves", "运动："), way, &both!("from the axis x", "与 x 轴夹角")),
        Kind::OnPlate(k, way) => {
            let link = &problem.plates[*k].link;
            path(problem, point, &both!("moves on plate {link}", "在平板 {link} 上运动："), way, &both!("from the axis", "与转轴夹角"))
        }
    }
}

fn path(problem: &Problem, point: &str, moves: &Both, way: &Way, measured: &Both) -> Both {
    let at = |place: &[Law; 2]| format!("({}, {})", told(problem, &place[0]), told(problem, &place[1]));
    match way {
        Way::Line { from, angle, s, .. } => both!(
            "${point}$ {} along a line from {} at {} {}, s = {}",
            "${point}$ {}沿直线，起点 {}，角度 {}（{}），s = {}",
            moves,
            at(from),
            told(problem, angle),
            measured,
            told(problem, s)
        ),
        Way::Circle { centre, radius, angle, s } => both!(
            "${point}$ {} round a circle about {} of radius {}, s = {} of arc counter-clockwise from {}",
            "${point}$ {}沿圆周，圆心 {}，半径 {}，弧长 s = {}，自 {} 逆时针量起",
            moves,
            at(centre),
            told(problem, radius),
            told(problem, s),
            angle.as_ref().map_or_else(|| "0°".to_owned(), |a| told(problem, a))
        ),
        Way::Polar { pole, r, phi } => both!(
            "${point}$ {} about {}, r = {}, φ = {} (polar coordinates)",
            "${point}$ {}极点 {}，极坐标 r = {}，φ = {}",
            moves,
            at(pole),
            told(problem, r),
            told(problem, phi)
        ),
        Way::Free([x, y]) => {
            both!("${point}$ {} by x = {}, y = {}", "${point}$ {}x = {}，y = {}", moves, told(problem, x), told(problem, y))
        }
    }
}

/// The wanted quantities: symbols with words.
pub fn wanted(problem: &Problem, lang: Lang, notation: &Notation) -> Vec<Phrase> {
    let colon = if lang == Lang::Zh { "：" } else { ": " };
    let line = |what: Asked| Phrase::new(&format!("${}${colon}{}", symbol(problem, what, notation), lang.of(&asked(problem, what))));
    problem.find.iter().map(|f| line(f.what)).collect()
}

fn asked(problem: &Problem, what: Asked) -> Both {
    let pair = |k: usize| {
        let m = &problem.motions[k];
        format!("{}{}", m.point, problem.chase(m).map_or("", |c| c.1))
    };
    let point = |k: usize| &problem.motions[k].point;
    match what {
        Asked::MeetingTime(_) => both!("time of meeting", "相遇的时间"),
        Asked::MeetingPlace(_) => both!("place of meeting", "相遇的地点"),
        Asked::Distance(k) => both!("length of the line ${}$", "连线 ${}$ 的长度", pair(k)),
        Asked::LineOmega(k) => both!("angular velocity of the line ${}$", "连线 ${}$ 的角速度", pair(k)),
        Asked::Place(k) => both!("place of ${}$", "${}$ 的位置", point(k)),
        Asked::Velocity(k) => both!("velocity of ${}$", "${}$ 的速度", point(k)),
        Asked::Acceleration(k) => both!("acceleration of ${}$", "${}$ 的加速度", point(k)),
        Asked::Curvature(k) => both!("radius of curvature of the path of ${}$", "${}$ 的轨迹的曲率半径", point(k)),
        Asked::Part(k, part) => both!("{} of ${}$", "${1}$ 的{0}", named(part), point(k)),
        Asked::Between([a, b], m) => {
            let (a, b) = (point(a), point(b));
            match m {
                Mutual::Distance => both!("distance of ${a}$ and ${b}$", "${a}$ 与 ${b}$ 的距离"),
                Mutual::Turning => both!("angular velocity of the line ${a}{b}$", "连线 ${a}{b}$ 的角速度"),
                Mutual::Velocity => both!("velocity of ${a}$ relative to ${b}$", "${a}$ 相对 ${b}$ 的速度"),
                Mutual::Acceleration => both!("acceleration of ${a}$ relative to ${b}$", "${a}$ 相对 ${b}$ 的加速度"),
            }
        }
    }
}

fn named(part: Part) -> Both {
    match part {
        Part::TransportVelocity => both!("transport velocity", "牵连速度"),
        Part::RelativeVelocity => both!("relative velocity", "相对速度"),
        Part::Transport => both!("transport acceleration", "牵连加速度"),
        Part::TransportNormal => both!("normal transport acceleration", "法向牵连加速度"),
        Part::TransportTangential => both!("tangential transport acceleration", "切向牵连加速度"),
        Part::Relative => both!("relative acceleration", "相对加速度"),
        Part::RelativeNormal => both!("normal relative acceleration", "法向相对加速度"),
        Part::RelativeTangential => both!("tangential relative acceleration", "切向相对加速度"),
        Part::Coriolis => both!("Coriolis acceleration", "科氏加速度"),
    }
}
