//! The parts of a composite motion, found as questions of the scene are.

use super::contact::Slip;
use super::{Choice, Staged};
use hodograph_base::diag::{Faults, Warned};
use hodograph_base::geom::Vec2;
use hodograph_mechanism::mechanism::Level;
use hodograph_mechanism::position::Path;
use hodograph_scene::quantity::composite::Part;
use hodograph_scene::quantity::{Composite, Frame, PointMotion, Rate, RelativePath, relative_path};
use hodograph_scene::{Asked, Find, Guide, GuidePath, LinkId, OnLink, PointId, Scene};
use hodograph_worked::worked::{Outcome, Worked};

/// The parts of one choice.
#[derive(Clone, Debug)]
pub struct Solved {
    /// The moving point and the frame.
    pub choice: Choice,
    /// v_a, v_e, v_r.
    pub velocity: [Vec2; 3],
    /// a_a and its parts in the order of [`Part`]; empty where the scene does not call for accelerations.
    pub acceleration: Vec<(Option<Part>, Vec2)>,
    /// What is known of the relative motion, where the moving point is a momentary point of contact.
    pub slip: Option<Slip>,
    /// The turning that follows from the wanted motion.
    pub turning: Option<Turned>,
    /// Whether v_a is known before v_e (the point is nearer to the driver than the frame).
    pub known: Known,
    /// How the equation is closed.
    pub closure: Closure,
    /// Of a point that runs on a circle about a fixed point the direction to that (unit vector).
    pub circle: Option<Vec2>,
}

/// How the equation of a choice is closed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Closure {
    /// Two magnitudes are unknown, each along a known direction.
    Crossing,
    /// The wanted motion is unknown in magnitude and direction, and all else is known.
    Side,
    /// There are more unknowns.
    Open,
}

/// Turning about a fixed axis that follows from the motion of a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turned {
    /// The link.
    pub link: LinkId,
    /// The fixed axis.
    pub axis: PointId,
    /// Whether the link is the frame, so that it follows from v_e and a_eᵗ; else from v_a and a_aᵗ.
    pub of_frame: bool,
    /// ω (rad/s).
    pub omega: f64,
    /// α (rad/s²), where accelerations are found.
    pub alpha: Option<f64>,
}

/// What of v_a and v_e is known beforehand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Known {
    /// The motion of the point; that of the frame is wanted.
    Absolute,
    /// The motion of the frame; that of the point is wanted.
    Transport,
    /// Both, for they rest on no common group.
    Both,
}

/// The parts of an acceleration, in the order in which they are drawn.
///
/// a_k and a_rⁿ lie on one line, so that one after the other they would be drawn over one another.
const PARTS: [Part; 5] = [Part::TransportNormal, Part::TransportTangential, Part::RelativeNormal, Part::RelativeTangential, Part::Coriolis];

/// The scene asking for the parts of these choices alone, and its work.
///
/// # Errors
/// Those of the scene: a dead centre has no motion to part.
pub(super) fn solved(staged: &Staged, choices: &[Choice], level: Level) -> Result<Warned<(Worked, Vec<Solved>)>, Faults> {
    let scene = &staged.scene;
    let mut asking = scene.clone();
    asking.find = choices.iter().flat_map(|c| questions(scene, c, level)).collect();
    let Warned { value: worked, notes } = staged.work(&asking)?;
    let each = choices.iter().filter_map(|c| parts(staged, &asking, &worked, c, level)).collect();
    Ok(Warned { value: (worked, each), notes })
}

/// As `find` would write it.
fn named(scene: &Scene, what: &Asked, c: &Choice) -> Find {
    let frame = match c.frame {
        Frame::Link(l) => scene.link_name(l).to_owned(),
        Frame::Point(p) => super::name_of(scene, &p),
    };
    let (symbol, point) = (what.entry().symbol, super::name_of(scene, &c.of));
    let text = if matches!(what, Asked::Composite(_)) { format!("{symbol}_{point}/{frame}") } else { format!("{symbol}_{point}") };
    Find { what: *what, text, span: Default::default() }
}

fn absolute(c: &Choice, rate: Rate) -> Asked {
    PointMotion { rate, of: c.of }.into()
}

fn part(c: &Choice, part: Part) -> Asked {
    Composite { part, of: c.of, frame: c.frame }.into()
}

/// The parts that a frame has: one that translates has no Coriolis part.
fn has(c: &Choice) -> impl Fn(&Part) -> bool {
    let (turns, straight) = (matches!(c.frame, Frame::Link(_)), matches!(c.path, RelativePath::Unknown));
    move |p| match p {
        Part::Coriolis => turns,
        Part::RelativeNormal | Part::RelativeTangential => !straight,
        Part::Relative => straight,
        Part::TransportVelocity
        | Part::RelativeVelocity
        | Part::Transport
        | Part::TransportNormal
        | Part::TransportTangential
        | Part::Path => true,
    }
}

fn questions(scene: &Scene, c: &Choice, level: Level) -> Vec<Find> {
    let mut all = vec![absolute(c, Rate::Velocity), part(c, Part::TransportVelocity), part(c, Part::RelativeVelocity)];
    if level == Level::Acceleration {
        all.push(absolute(c, Rate::Acceleration));
        let whole = [Part::Transport, Part::Relative];
        all.extend(PARTS.iter().chain(&whole).filter(|p| has(c)(p)).map(|p| part(c, *p)));
    }
    all.iter().map(|what| named(scene, what, c)).collect()
}

fn parts(staged: &Staged, scene: &Scene, worked: &Worked, c: &Choice, level: Level) -> Option<Solved> {
    let value = |what: &Asked| {
        let of = |r: &&Outcome| scene.find[r.find].what == *what;
        match worked.results.iter().find(of)?.value() {
            hodograph_mechanism::answer::Value::Vector(v) => Some(v),
            hodograph_mechanism::answer::Value::Scalar(_) | hodograph_mechanism::answer::Value::Point(_) => None,
        }
    };
    let velocity =
        [value(&absolute(c, Rate::Velocity))?, value(&part(c, Part::TransportVelocity))?, value(&part(c, Part::RelativeVelocity))?];
    let mut acceleration = Vec::new();
    if level == Level::Acceleration {
        acceleration.push((None, value(&absolute(c, Rate::Acceleration))?));
        for p in PARTS.iter().chain(&[Part::Relative]).filter(|p| has(c)(p)) {
            acceleration.push((Some(*p), value(&part(c, *p))?));
        }
    }
    let slip = staged.slip(c, worked, velocity[2]);
    if let Some(slip) = slip {
        parted(&mut acceleration, slip.normal);
    }
    let known = known(scene, worked, c);
    let turning = turning(scene, worked, c, known, velocity, &acceleration);
    let (closure, circle) = (closure(scene, worked, c, known), circle(scene, worked, c));
    Some(Solved { choice: *c, velocity, acceleration, slip, turning, known, closure, circle })
}

/// How the equation is closed: of the wanted motion the direction is known where a pair of the ground gives the path.
fn closure(scene: &Scene, worked: &Worked, c: &Choice, known: Known) -> Closure {
    let ground = Frame::Link(scene.ground);
    let runs = |of: OnLink| relative_path(scene, of, ground) != RelativePath::Unknown;
    match known {
        Known::Both => Closure::Crossing,
        Known::Transport if runs(c.of) => Closure::Crossing,
        Known::Transport if follows(worked, c.of) => Closure::Side,
        Known::Transport => Closure::Open,
        Known::Absolute => {
            let slides = |l: LinkId| {
                let on_ground = |g: &Guide| {
                    let straight = matches!(g.path, GuidePath::Line { .. });
                    straight && ((g.slider, g.on) == (Some(l), scene.ground) || (g.slider, g.on) == (Some(scene.ground), l))
                };
                scene.guides.iter().any(on_ground)
            };
            let told = match c.frame {
                Frame::Link(l) => c.frame.axis(scene, c.of).is_some() || slides(l),
                Frame::Point(p) => runs(p),
            };
            if told { Closure::Crossing } else { Closure::Open }
        }
    }
}

/// Whether the motion of a point follows from that of its link or from a driver, so that no equation crosses two loci for it.
fn follows(worked: &Worked, of: OnLink) -> bool {
    let m = &worked.mechanism;
    m.group_of_pin[of.point.0].is_none_or(|g| m.groups[g].class().is_none())
}

/// The direction from a point to the fixed centre of the circle on which it runs.
fn circle(scene: &Scene, worked: &Worked, c: &Choice) -> Option<Vec2> {
    let at = &worked.configuration;
    let own = at.points[c.of.point.0]?;
    let centre = match relative_path(scene, c.of, Frame::Link(scene.ground)) {
        RelativePath::Circle(k) => at.points[k.0]?,
        RelativePath::Guide(g) => match at.guides[g.0]? {
            Path::Arc { centre, .. } => centre,
            Path::Line { .. } => return None,
        },
        RelativePath::Unknown => return None,
    };
    (centre - own).unit()
}

/// The frame's turning where its motion is wanted, that of the point's link where that is; none where it has no fixed axis at another place.
fn turning(
    scene: &Scene,
    worked: &Worked,
    c: &Choice,
    known: Known,
    [v_a, v_e, _]: [Vec2; 3],
    acceleration: &[(Option<Part>, Vec2)],
) -> Option<Turned> {
    let of_frame = match known {
        Known::Absolute => true,
        Known::Transport => false,
        Known::Both => return None,
    };
    let point = c.of.point;
    let (link, axis) = if of_frame {
        let Frame::Link(l) = c.frame else { return None };
        (l, c.frame.axis(scene, c.of)?)
    } else {
        let own = c.of.link.map_or_else(|| scene.carriers(point).find(|l| *l != scene.ground), Some)?;
        (own, Frame::Link(own).axis(scene, c.of)?)
    };
    let at = &worked.configuration.points;
    let arm = at[point.0]? - at[axis.0]?;
    let about = |v: Vec2| arm.cross(v) / arm.norm2();
    let of = |wanted: &[Option<Part>]| acceleration.iter().filter(|(part, _)| wanted.contains(part)).map(|(_, v)| *v).reduce(|a, b| a + b);
    let whole = if of_frame { of(&[Some(Part::TransportNormal), Some(Part::TransportTangential)]) } else { of(&[None]) };
    let omega = about(if of_frame { v_e } else { v_a });
    let above = |x: f64, size: f64| if x.abs() <= ROUNDING * size { 0.0 } else { x };
    let alpha = whole.map(|a| above(about(a), a.norm() / arm.norm()));
    (arm.norm() > 0.0).then_some(Turned { link, axis, of_frame, omega, alpha })
}

/// What is below this part of its size is rounding.
const ROUNDING: f64 = 1e-12;

/// a_r in its parts along a normal and square to it, a_k behind them as everywhere.
fn parted(acceleration: &mut Vec<(Option<Part>, Vec2)>, normal: Vec2) {
    let Some(k) = acceleration.iter().position(|(part, _)| *part == Some(Part::Relative)) else { return };
    let whole = acceleration.remove(k).1;
    let along = normal * normal.dot(whole);
    let at = acceleration.iter().position(|(part, _)| *part == Some(Part::Coriolis)).unwrap_or(acceleration.len());
    acceleration.splice(at..at, [(Some(Part::RelativeNormal), along), (Some(Part::RelativeTangential), whole - along)]);
}

/// Which of the two motions a plan knows first: that of the earlier group.
fn known(scene: &Scene, worked: &Worked, c: &Choice) -> Known {
    use hodograph_mechanism::mechanism::{Need, Node, nodes_of};
    let m = &worked.mechanism;
    let latest = |need: Need| nodes_of(scene, m, need).into_iter().filter_map(|n: Node| m.group_of(n)).max();
    let of_point = latest(Need::Point(c.of.point, c.of.link));
    let of_frame = match c.frame {
        Frame::Link(l) => latest(Need::Turning(l)),
        Frame::Point(p) => latest(Need::Point(p.point, p.link)),
    };
    let rests = |a: Option<usize>, b: Option<usize>| {
        let (Some(a), Some(b)) = (a, b) else { return false };
        let mut open = vec![a];
        while let Some(g) = open.pop() {
            if g == b {
                return true;
            }
            open.extend(&m.groups[g].upstream);
        }
        false
    };
    // Of two in one group neither is known first.
    match (rests(of_point, of_frame), rests(of_frame, of_point)) {
        (true, false) => Known::Transport,
        (false, true) => Known::Absolute,
        (true, true) => Known::Transport,
        (false, false) => Known::Both,
    }
}
