//! Given and wanted quantities of a motion without a mechanism, in words.

use crate::diag::{Both, both};
use crate::notation::Notation;
use crate::paper::phrase::Phrase;
use crate::particle::law::{PathLaw, PlateRotation};
use crate::particle::plate::PlateComponent;
use crate::particle::{
    Mutual, ParticleMotion, ParticleMotionKind, ParticleProblem, ParticleQuantity, Plate,
};
use crate::report::given::law::printed;
use crate::report::particle::symbol;
use crate::scene::Lang;
use crate::scene::front::Law;

/// An expression in print; a single parameter is replaced by its value.
fn printed_law(problem: &ParticleProblem, law: &Law) -> String {
    let value = problem
        .parameters
        .iter()
        .find(|(name, _)| name == law.text.trim())
        .map(|(_, value)| value.as_str());
    printed(value.unwrap_or(&law.text))
}

/// Parameters, plates, motions and the instant, one line each.
pub fn given(problem: &ParticleProblem, lang: Lang) -> Vec<Phrase> {
    let mut out: Vec<Both> = Vec::new();
    if !problem.parameters.is_empty() {
        let all: Vec<String> = problem
            .parameters
            .iter()
            .map(|(name, value)| format!("{} = {}", printed(name), printed(value)))
            .collect();
        out.push(Both { en: all.join(", "), zh: all.join("，") });
    }
    out.extend(problem.plates.iter().map(|p| plate(problem, p)));
    out.extend(problem.motions.iter().map(|m| motion(problem, m)));
    out.push(both!("the instant: t = {}", printed_law(problem, &problem.time)));
    out.iter().map(|said| Phrase::new(lang.of(said))).collect()
}

fn plate(problem: &ParticleProblem, p: &Plate) -> Both {
    let axis = p.axis.letter();
    let place = match &p.offset {
        Some(offset) => both!("lies {} beside the axis {}", printed_law(problem, offset), axis),
        None => both!("contains the axis {axis}"),
    };
    let turning = match &p.turning {
        PlateRotation::Law(law) => both!("φ = {}", printed_law(problem, law)),
        PlateRotation::Now { angle, omega, alpha } => {
            let alpha = alpha
                .as_ref()
                .map_or_else(Both::default, |a| both!(", α = {0}", printed_law(problem, a)));
            both!(
                "at the instant φ = {}, ω = {}{}",
                printed_law(problem, angle),
                printed_law(problem, omega),
                alpha
            )
        }
    };
    let from = p.axis.order()[0];
    both!(
        "plate {} {} and turns about it; {}, φ from the axis {}",
        p.link,
        place,
        turning,
        ["x", "y", "z"][from]
    )
}

fn motion(problem: &ParticleProblem, m: &ParticleMotion) -> Both {
    let at = |place: &[Law; 2]| {
        format!("({}, {})", printed_law(problem, &place[0]), printed_law(problem, &place[1]))
    };
    let point = &m.point;
    match &m.kind {
        ParticleMotionKind::Toward { from, target, speed } => both!(
            "${point}$ starts at {} and always runs toward ${}$ with the speed {}",
            at(from),
            problem.motions[*target].point,
            printed_law(problem, speed)
        ),
        ParticleMotionKind::Fixed(PathLaw::Free(place))
            if place.iter().all(|law| !law.depends_on_time()) =>
        {
            both!("${point}$ is at rest at {}", at(place))
        }
        ParticleMotionKind::Fixed(way) => {
            path(problem, point, &both!("moves"), way, &both!("from the axis x"))
        }
        ParticleMotionKind::OnPlate(k, way) => {
            let link = &problem.plates[*k].link;
            path(problem, point, &both!("moves on plate {link}"), way, &both!("from the axis"))
        }
    }
}

fn path(
    problem: &ParticleProblem,
    point: &str,
    moves: &Both,
    way: &PathLaw,
    measured: &Both,
) -> Both {
    let at = |place: &[Law; 2]| {
        format!("({}, {})", printed_law(problem, &place[0]), printed_law(problem, &place[1]))
    };
    match way {
        PathLaw::Line { from, angle, s, .. } => both!(
            "${point}$ {} along a line from {} at {} {}, s = {}",
            moves,
            at(from),
            printed_law(problem, angle),
            measured,
            printed_law(problem, s)
        ),
        PathLaw::Circle { centre, radius, angle, s } => both!(
            "${point}$ {} round a circle about {} of radius {}, s = {} of arc counter-clockwise from {}",
            moves,
            at(centre),
            printed_law(problem, radius),
            printed_law(problem, s),
            angle.as_ref().map_or_else(|| "0°".to_owned(), |a| printed_law(problem, a))
        ),
        PathLaw::Polar { pole, r, phi } => both!(
            "${point}$ {} about {}, r = {}, φ = {} (polar coordinates)",
            moves,
            at(pole),
            printed_law(problem, r),
            printed_law(problem, phi)
        ),
        PathLaw::Free([x, y]) => {
            both!(
                "${point}$ {} by x = {}, y = {}",
                moves,
                printed_law(problem, x),
                printed_law(problem, y)
            )
        }
    }
}

/// The wanted quantities: symbols with words.
pub fn wanted(problem: &ParticleProblem, lang: Lang, notation: &Notation) -> Vec<Phrase> {
    let colon = if lang == Lang::Zh { "：" } else { ": " };
    let line = |what: ParticleQuantity| {
        Phrase::new(&format!(
            "${}${colon}{}",
            symbol(problem, what, notation),
            lang.of(&asked(problem, what))
        ))
    };
    problem.find.iter().map(|f| line(f.what)).collect()
}

fn asked(problem: &ParticleProblem, what: ParticleQuantity) -> Both {
    let pair = |k: usize| {
        let m = &problem.motions[k];
        format!("{}{}", m.point, problem.chase(m).map_or("", |c| c.1))
    };
    let point = |k: usize| &problem.motions[k].point;
    match what {
        ParticleQuantity::MeetingTime(_) => both!("time of meeting"),
        ParticleQuantity::MeetingPlace(_) => both!("place of meeting"),
        ParticleQuantity::Distance(k) => {
            both!("length of the line ${}$", pair(k))
        }
        ParticleQuantity::LineOmega(k) => {
            both!("angular velocity of the line ${}$", pair(k))
        }
        ParticleQuantity::Place(k) => both!("place of ${}$", point(k)),
        ParticleQuantity::Velocity(k) => both!("velocity of ${}$", point(k)),
        ParticleQuantity::Acceleration(k) => {
            both!("acceleration of ${}$", point(k))
        }
        ParticleQuantity::Curvature(k) => {
            both!("radius of curvature of the path of ${}$", point(k))
        }
        ParticleQuantity::Part(k, part) => {
            both!("{} of ${}$", named(part), point(k))
        }
        ParticleQuantity::Between([a, b], m) => {
            let (a, b) = (point(a), point(b));
            match m {
                Mutual::Distance => both!("distance of ${a}$ and ${b}$"),
                Mutual::Turning => {
                    both!("angular velocity of the line ${a}{b}$")
                }
                Mutual::Velocity => {
                    both!("velocity of ${a}$ relative to ${b}$")
                }
                Mutual::Acceleration => {
                    both!("acceleration of ${a}$ relative to ${b}$")
                }
            }
        }
    }
}

fn named(part: PlateComponent) -> Both {
    match part {
        PlateComponent::TransportVelocity => both!("transport velocity"),
        PlateComponent::RelativeVelocity => both!("relative velocity"),
        PlateComponent::Transport => both!("transport acceleration"),
        PlateComponent::TransportNormal => both!("normal transport acceleration"),
        PlateComponent::TransportTangential => {
            both!("tangential transport acceleration")
        }
        PlateComponent::Relative => both!("relative acceleration"),
        PlateComponent::RelativeNormal => both!("normal relative acceleration"),
        PlateComponent::RelativeTangential => {
            both!("tangential relative acceleration")
        }
        PlateComponent::Coriolis => both!("Coriolis acceleration"),
    }
}
