//! The parts of a composite motion, found like the answers to questions of the scene.

use super::contact::ContactSlip;
use super::{ContactScene, FrameChoice};
use hodograph_base::diag::{Faults, Warned};
use hodograph_base::geom::Vec2;
use hodograph_mechanism::mechanism::Level;
use hodograph_mechanism::position::Path;
use hodograph_scene::quantity::composite::CompositePart;
use hodograph_scene::quantity::{Composite, Frame, PointMotion, Rate, RelativePath, relative_path};
use hodograph_scene::{Asked, Find, Guide, GuidePath, LinkId, OnLink, PointId, Scene};
use hodograph_worked::worked::{Outcome, Worked};

/// The parts of one choice.
#[derive(Clone, Debug)]
pub struct ChoiceSolution {
    /// The moving point and the frame.
    pub choice: FrameChoice,
    /// v_a, v_e, v_r.
    pub velocity: [Vec2; 3],
    /// a_a and its parts in the order of [`CompositePart`]; empty if the scene does not ask for
    /// accelerations.
    pub acceleration: Vec<(Option<CompositePart>, Vec2)>,
    /// The sliding at the contact, if the moving point is a momentary point of contact.
    pub slip: Option<ContactSlip>,
    /// The rotation that follows from the wanted motion.
    pub turning: Option<AxisRotation>,
    /// The motion that is known before the other: v_a is known first if the point is nearer to the
    /// driver than the frame.
    pub known: KnownMotion,
    /// The number and kind of unknowns of the equation.
    pub closure: ChoiceUnknowns,
    /// The direction from the point to the fixed centre of its circular path (unit vector), if it
    /// has one.
    pub circle: Option<Vec2>,
}

/// The unknowns of the equation of a choice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ChoiceUnknowns {
    /// Two magnitudes are unknown, each along a known direction.
    Crossing,
    /// The wanted motion is unknown in magnitude and direction, and everything else is known.
    Side,
    /// There are more unknowns.
    Open,
}

/// A rotation about a fixed axis that follows from the motion of a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisRotation {
    /// The link.
    pub link: LinkId,
    /// The fixed axis.
    pub axis: PointId,
    /// True if the link is the frame: the rotation then follows from v_e and a_eᵗ, otherwise from
    /// v_a and a_aᵗ.
    pub of_frame: bool,
    /// ω (rad/s).
    pub omega: f64,
    /// α (rad/s²), if accelerations are found.
    pub alpha: Option<f64>,
}

/// The part of v_a and v_e that is known beforehand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KnownMotion {
    /// The motion of the point; the frame's motion is wanted.
    Absolute,
    /// The motion of the frame; the point's motion is wanted.
    Transport,
    /// Both motions, because neither depends on the other.
    Both,
}

/// The parts of an acceleration, in the order in which they are drawn.
///
/// a_k and a_rⁿ are parallel: drawn one directly after the other they would overlap.
const PARTS: [CompositePart; 5] = [
    CompositePart::TransportNormal,
    CompositePart::TransportTangential,
    CompositePart::RelativeNormal,
    CompositePart::RelativeTangential,
    CompositePart::Coriolis,
];

/// Solves the scene with questions for the parts of these choices only.
///
/// # Errors
/// The faults of the scene; at a dead centre there is no motion to resolve.
pub(super) fn solved(
    staged: &ContactScene,
    choices: &[FrameChoice],
    level: Level,
) -> Result<Warned<(Worked, Vec<ChoiceSolution>)>, Faults> {
    let scene = &staged.scene;
    let mut asking = scene.clone();
    asking.find = choices.iter().flat_map(|c| questions(scene, c, level)).collect();
    let Warned { value: worked, notes } = staged.work(&asking)?;
    let each = choices.iter().filter_map(|c| parts(staged, &asking, &worked, c, level)).collect();
    Ok(Warned { value: (worked, each), notes })
}

/// Returns the question in the form that `find` uses.
fn named(scene: &Scene, what: &Asked, c: &FrameChoice) -> Find {
    let frame = match c.frame {
        Frame::Link(l) => scene.link_name(l).to_owned(),
        Frame::Point(p) => super::name_of(scene, &p),
    };
    let (symbol, point) = (what.entry().symbol, super::name_of(scene, &c.of));
    let text = if matches!(what, Asked::Composite(_)) {
        format!("{symbol}_{point}/{frame}")
    } else {
        format!("{symbol}_{point}")
    };
    Find { what: *what, text, span: Default::default() }
}

fn absolute(c: &FrameChoice, rate: Rate) -> Asked {
    PointMotion { rate, of: c.of }.into()
}

fn part(c: &FrameChoice, part: CompositePart) -> Asked {
    Composite { part, of: c.of, frame: c.frame }.into()
}

/// Returns a test for the parts that a choice has: a translating frame has no Coriolis part.
fn has(c: &FrameChoice) -> impl Fn(&CompositePart) -> bool {
    let (turns, straight) =
        (matches!(c.frame, Frame::Link(_)), matches!(c.path, RelativePath::Unknown));
    move |p| match p {
        CompositePart::Coriolis => turns,
        CompositePart::RelativeNormal | CompositePart::RelativeTangential => !straight,
        CompositePart::Relative => straight,
        CompositePart::TransportVelocity
        | CompositePart::RelativeVelocity
        | CompositePart::Transport
        | CompositePart::TransportNormal
        | CompositePart::TransportTangential
        | CompositePart::Path => true,
    }
}

fn questions(scene: &Scene, c: &FrameChoice, level: Level) -> Vec<Find> {
    let mut all = vec![
        absolute(c, Rate::Velocity),
        part(c, CompositePart::TransportVelocity),
        part(c, CompositePart::RelativeVelocity),
    ];
    if level == Level::Acceleration {
        all.push(absolute(c, Rate::Acceleration));
        let whole = [CompositePart::Transport, CompositePart::Relative];
        all.extend(PARTS.iter().chain(&whole).filter(|p| has(c)(p)).map(|p| part(c, *p)));
    }
    all.iter().map(|what| named(scene, what, c)).collect()
}

fn parts(
    staged: &ContactScene,
    scene: &Scene,
    worked: &Worked,
    c: &FrameChoice,
    level: Level,
) -> Option<ChoiceSolution> {
    let value = |what: &Asked| {
        let of = |r: &&Outcome| scene.find[r.find].what == *what;
        match worked.results.iter().find(of)?.value() {
            hodograph_mechanism::answer::AnswerValue::Vector(v) => Some(v),
            hodograph_mechanism::answer::AnswerValue::Scalar(_)
            | hodograph_mechanism::answer::AnswerValue::Point(_) => None,
        }
    };
    let velocity = [
        value(&absolute(c, Rate::Velocity))?,
        value(&part(c, CompositePart::TransportVelocity))?,
        value(&part(c, CompositePart::RelativeVelocity))?,
    ];
    let mut acceleration = Vec::new();
    if level == Level::Acceleration {
        acceleration.push((None, value(&absolute(c, Rate::Acceleration))?));
        for p in PARTS.iter().chain(&[CompositePart::Relative]).filter(|p| has(c)(p)) {
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
    Some(ChoiceSolution {
        choice: *c,
        velocity,
        acceleration,
        slip,
        turning,
        known,
        closure,
        circle,
    })
}

/// Returns the kind of unknowns of the equation: the direction of the wanted motion is known if a
/// pair of the ground gives the path.
fn closure(scene: &Scene, worked: &Worked, c: &FrameChoice, known: KnownMotion) -> ChoiceUnknowns {
    let ground = Frame::Link(scene.ground);
    let runs = |of: OnLink| relative_path(scene, of, ground) != RelativePath::Unknown;
    match known {
        KnownMotion::Both => ChoiceUnknowns::Crossing,
        KnownMotion::Transport if runs(c.of) => ChoiceUnknowns::Crossing,
        KnownMotion::Transport if follows(worked, c.of) => ChoiceUnknowns::Side,
        KnownMotion::Transport => ChoiceUnknowns::Open,
        KnownMotion::Absolute => {
            let slides = |l: LinkId| {
                let on_ground = |g: &Guide| {
                    let straight = matches!(g.path, GuidePath::Line { .. });
                    straight
                        && ((g.slider, g.on) == (Some(l), scene.ground)
                            || (g.slider, g.on) == (Some(scene.ground), l))
                };
                scene.guides.iter().any(on_ground)
            };
            let told = match c.frame {
                Frame::Link(l) => c.frame.axis(scene, c.of).is_some() || slides(l),
                Frame::Point(p) => runs(p),
            };
            if told { ChoiceUnknowns::Crossing } else { ChoiceUnknowns::Open }
        }
    }
}

/// True if the motion of a point follows from its link or from a driver, so that no equation
/// crosses two loci for it.
fn follows(worked: &Worked, of: OnLink) -> bool {
    let m = &worked.mechanism;
    m.group_of_pin[of.point.0].is_none_or(|g| m.groups[g].class().is_none())
}

/// Returns the direction from a point to the fixed centre of its circular path.
fn circle(scene: &Scene, worked: &Worked, c: &FrameChoice) -> Option<Vec2> {
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

/// Returns the rotation of the link with the wanted motion: the frame, or the point's link. `None`
/// if the link has no fixed axis at another place.
fn turning(
    scene: &Scene,
    worked: &Worked,
    c: &FrameChoice,
    known: KnownMotion,
    [v_a, v_e, _]: [Vec2; 3],
    acceleration: &[(Option<CompositePart>, Vec2)],
) -> Option<AxisRotation> {
    let of_frame = match known {
        KnownMotion::Absolute => true,
        KnownMotion::Transport => false,
        KnownMotion::Both => return None,
    };
    let point = c.of.point;
    let (link, axis) = if of_frame {
        let Frame::Link(l) = c.frame else { return None };
        (l, c.frame.axis(scene, c.of)?)
    } else {
        let own =
            c.of.link.map_or_else(|| scene.carriers(point).find(|l| *l != scene.ground), Some)?;
        (own, Frame::Link(own).axis(scene, c.of)?)
    };
    let at = &worked.configuration.points;
    let arm = at[point.0]? - at[axis.0]?;
    let about = |v: Vec2| arm.cross(v) / arm.norm2();
    let of = |wanted: &[Option<CompositePart>]| {
        acceleration
            .iter()
            .filter(|(part, _)| wanted.contains(part))
            .map(|(_, v)| *v)
            .reduce(|a, b| a + b)
    };
    let whole = if of_frame {
        of(&[Some(CompositePart::TransportNormal), Some(CompositePart::TransportTangential)])
    } else {
        of(&[None])
    };
    let omega = about(if of_frame { v_e } else { v_a });
    let above = |x: f64, size: f64| if x.abs() <= ROUNDING * size { 0.0 } else { x };
    let alpha = whole.map(|a| above(about(a), a.norm() / arm.norm()));
    (arm.norm() > 0.0).then_some(AxisRotation { link, axis, of_frame, omega, alpha })
}

/// A value below this fraction of its size is a rounding error.
const ROUNDING: f64 = 1e-12;

/// Splits a_r into the parts along a normal and square to it, and puts them before a_k as
/// everywhere.
fn parted(acceleration: &mut Vec<(Option<CompositePart>, Vec2)>, normal: Vec2) {
    let Some(k) = acceleration.iter().position(|(part, _)| *part == Some(CompositePart::Relative))
    else {
        return;
    };
    let whole = acceleration.remove(k).1;
    let along = normal * normal.dot(whole);
    let at = acceleration
        .iter()
        .position(|(part, _)| *part == Some(CompositePart::Coriolis))
        .unwrap_or(acceleration.len());
    acceleration.splice(
        at..at,
        [
            (Some(CompositePart::RelativeNormal), along),
            (Some(CompositePart::RelativeTangential), whole - along),
        ],
    );
}

/// Returns the motion that a plan knows first: the motion of the earlier group.
fn known(scene: &Scene, worked: &Worked, c: &FrameChoice) -> KnownMotion {
    use hodograph_mechanism::mechanism::{GraphNode, Need, nodes_of};
    let m = &worked.mechanism;
    let latest = |need: Need| {
        nodes_of(scene, m, need).into_iter().filter_map(|n: GraphNode| m.group_of(n)).max()
    };
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
    // If neither group depends on the other, both motions are known.
    match (rests(of_point, of_frame), rests(of_frame, of_point)) {
        (true, false) => KnownMotion::Transport,
        (false, true) => KnownMotion::Absolute,
        (true, true) => KnownMotion::Transport,
        (false, false) => KnownMotion::Both,
    }
}
