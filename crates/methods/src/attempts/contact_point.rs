//! The mistake of treating the momentary point of contact of a cam and its follower as a permanent
//! coincident point, like a pin in a straight slot along the common tangent: E of the follower in a
//! slot of the cam, or E of the cam in a slot of the follower. Both versions are printed; their
//! numbers differ.
//!
//! Each version is a separate mechanism and is planned and drawn as such, in the same pose. Its
//! velocities are right. The accelerations lack the part along the normal, because the profiles
//! roll and slide on one another and the point of contact changes on both.

use super::{AttemptScene, EquationPart, Missing, Site, SolutionSide, Topology};
use hodograph_base::diag::{Both, both};
use hodograph_base::digits::significant;
use hodograph_base::geom::Vec2;
use hodograph_board::plan::{TermKind, TurningBody};
use hodograph_mechanism::position::{Configuration, Path};
use hodograph_scene::quantity::{Meaning, PointMotion, Rate};
use hodograph_scene::{
    Angle, Cam, DiagramKind, Find, Follows, GivenQuantity, Guide, GuideDirection, GuidePath, Kind,
    LinkId, OnLink, PointId, Scene, Through,
};
use hodograph_worked::worked::Worked;
use hodograph_worked::worked::contact::{name, with_contact, work_at};

/// Digits of the missing part in the table.
const DIGITS: usize = 4;

/// Returns each circular cam with a follower that is a face or a round end: for an edge or a roller
/// another point is named. The point is assumed to slide in a slot of the cam, then of the
/// follower.
pub fn sites(t: &Topology) -> Vec<Site> {
    let offers = |c: &Cam| {
        c.circle.is_some()
            && c.contact.is_some()
            && c.cam != t.scene.ground
            && matches!(c.follows, Follows::Face(_) | Follows::Arc(..))
    };
    let cams = t.scene.cams.iter().enumerate().filter(|(_, c)| offers(c));
    cams.flat_map(|(k, c)| [c.cam, c.follower].map(|frame| Site::ContactPoint(k, frame))).collect()
}

/// True for questions that a mechanism without the guide answers too: whole vectors and angular
/// quantities.
fn asked_as_well(scene: &Scene, f: &Find) -> bool {
    matches!(f.what.meaning(scene), Some(Meaning::Vector(_) | Meaning::Turning(..)))
}

/// Returns the right solution with the point of contact in it, the wrong one, and the equation with
/// its missing part; `frame` is the link in which the point is assumed to slide.
pub fn slid(
    scene: &Scene,
    at: &Configuration,
    index: usize,
    frame: LinkId,
) -> Option<(AttemptScene, AttemptScene, EquationPart)> {
    let cam = &scene.cams[index];
    let touched = at.touch(scene, cam)?;
    let owner = if frame == cam.cam { cam.follower } else { cam.cam };
    let (mut right, right_at, own) = with_contact(scene, at, index, owner, touched.at)?;
    let span = cam.span;
    for link in [None, Some(frame)] {
        for rate in [Rate::Velocity, Rate::Acceleration] {
            let what = PointMotion { rate, of: OnLink { point: own, link } }.into();
            right.find.push(Find { what, text: format!("contact {}", right.find.len()), span });
        }
    }
    // The cam's guide represents the contact in both mechanisms; the other properties of a cam do
    // not belong to the wrong mechanism.
    right.cams.clear();
    let unanswered: Vec<bool> = right.find.iter().map(|f| asked_as_well(&right, f)).collect();
    let mut answered = unanswered.into_iter();
    right.find.retain(|_| answered.next().unwrap_or(false));
    let (mut wrong, mut wrong_at) = (right.clone(), right_at.clone());
    let tangent = touched.normal.perp();
    let angle = GivenQuantity {
        value: Angle::Rad(tangent.angle()),
        radius: f64::EPSILON,
        text: format!("{} rad", tangent.angle()),
        span,
    };
    let path = GuidePath::Line {
        through: Through::Pin,
        direction: GuideDirection::Instant(angle),
        offset: None,
    };
    let guide = cam.contact?.0;
    wrong.guides[guide] =
        Guide { pin: Some(own), slider: None, on: frame, path, length: None, rolling: None, span };
    let pose = at.poses[frame.0]?;
    wrong_at.guides[guide] = Some(Path::Line { through: touched.at, direction: tangent });
    wrong_at.shapes.guides[guide] =
        Some(Path::Line { through: pose.to_local(touched.at), direction: pose.turn_back(tangent) });
    let stage = |scene: Scene, at: Configuration| {
        work_at(&scene, at).map(|worked| AttemptScene { scene, worked })
    };
    let (right, wrong) = (stage(right, right_at)?, stage(wrong, wrong_at)?);
    // A frame that does not turn has no Coriolis part: the equation is then identified by the
    // sliding.
    let with = |kind| {
        EquationPart::with(
            &wrong.worked.plan,
            DiagramKind::Acceleration,
            SolutionSide::Wrong,
            |t| t.kind == kind,
        )
    };
    let mut shown = with(TermKind::Coriolis).or_else(|| with(TermKind::Slide))?;
    shown.framed.clear();
    shown.missing = Some(missing(scene, [owner, frame], own, &right, tangent.perp())?);
    Some((right, wrong, shown))
}

/// Returns the acceleration of the owner's point relative to the frame, along the normal.
fn missing(
    scene: &Scene,
    [owner, frame]: [LinkId; 2],
    own: PointId,
    right: &AttemptScene,
    normal: Vec2,
) -> Option<Missing> {
    let (s, w): (&Scene, &Worked) = (&right.scene, &right.worked);
    let vector = |on, link| {
        let v = w.plan.find_vertex(s, own, link)?;
        w.construction.vector(on, v)
    };
    let relative = |on| Some(vector(on, None)? - vector(on, Some(frame))?);
    let omega = w.construction.rate(DiagramKind::Velocity, TurningBody::Link(frame))?;
    let coriolis = relative(DiagramKind::Velocity)?.perp() * (2.0 * omega);
    let along = (relative(DiagramKind::Acceleration)? - coriolis).dot(normal);
    let book = &scene.book;
    let number = significant(book.value(Kind::Acceleration, along.abs()), DIGITS);
    let (e, owner, frame) = (&s.points[own.0].name, scene.link_name(owner), scene.link_name(frame));
    Some(Missing {
        symbol: format!("a^{{n}}_{{{e}{owner}{e}{frame}}}"),
        direction: "\\parallel n\\text{–}n".into(),
        magnitude: book.label(Kind::Acceleration, &hodograph_base::digits::inked(&number)),
    })
}

/// Explains why the point is no coincident point.
pub fn why(scene: &Scene, index: usize, frame: LinkId) -> Both {
    let cam = &scene.cams[index];
    let owner = if frame == cam.cam { cam.follower } else { cam.cam };
    let (e, owner, frame) = (name(scene, index), scene.link_name(owner), scene.link_name(frame));
    let centre = cam.circle.map_or("", |c| scene.point_name(c.0));
    both!(
        "${e}$ is the point of contact at this instant only: the point of link {owner} at ${e}$ does not move along the tangent of link {frame}, so its relative acceleration has a component along the common normal $n\\text{{–}}n$ as well. ${centre}$, the centre of the profile, stays the same point of its link: take it as the coincident point."
    )
}
