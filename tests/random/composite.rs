//! Composite motion of random mechanisms: for every pair of moving bodies the parts add up to the
//! absolute vector, drawing and analysis agree on each, and each agrees with differences of
//! positions seen in the frame.

use crate::emit::{self, Ask};
use crate::properties::{Case, Motion, mechanism, seeds, solve, style};
use crate::wide::every;
use hodograph::answer::AnswerValue;
use hodograph::composite::{ChoiceVerdict, FrameChoice, choices, name_of};
use hodograph::geom::{Point, Vec2};
use hodograph::position::Configuration;
use hodograph::scene::quantity::composite::CompositePart;
use hodograph::scene::quantity::{Composite, Frame, PointMotion, Rate};
use hodograph::scene::{Asked, DiagramKind, Find, Scene};
use hodograph::worked::{Scope, Worked, work};

/// Largest number of choices examined in one mechanism.
const MOST: usize = 12;

fn ask(scene: &Scene, c: &FrameChoice, what: Asked) -> Find {
    let frame = match c.frame {
        Frame::Link(l) => scene.link_name(l).to_owned(),
        Frame::Point(p) => name_of(scene, &p),
    };
    Find {
        what,
        text: format!("{}_{}/{frame}", what.entry().symbol, name_of(scene, &c.of)),
        span: Default::default(),
    }
}

fn parts(c: &FrameChoice) -> Vec<CompositePart> {
    let turns = matches!(c.frame, Frame::Link(_));
    CompositePart::ALL
        .into_iter()
        .filter(|p| *p != CompositePart::Path && (turns || *p != CompositePart::Coriolis))
        .collect()
}

/// The mechanism of a seed with questions for every part of some choices, solved.
fn parted(seed: u64) -> Option<(Case, Vec<FrameChoice>, Scene, Worked)> {
    let m = mechanism(seed).filter(|m| m.groups.len() <= 8)?;
    let pose = if m.coordinates_only { emit::Pose::Coordinates } else { emit::Pose::of(seed) };
    let case = solve(seed, &m, &style(pose, Ask::Everything, seed));
    let usable =
        |c: &FrameChoice| !matches!(c.verdict, ChoiceVerdict::SameBody | ChoiceVerdict::FrameFixed);
    let chosen: Vec<FrameChoice> =
        choices(&case.scene).into_iter().filter(usable).take(MOST).collect();
    let mut scene = case.scene.clone();
    scene.find.clear();
    for c in &chosen {
        let absolute = Rate::ALL.map(|rate| {
            let what = Asked::from(PointMotion { rate, of: c.of });
            Find {
                what,
                text: format!("{}_{}", what.entry().symbol, name_of(&scene, &c.of)),
                span: Default::default(),
            }
        });
        scene.find.extend(absolute);
        let all: Vec<Find> = parts(c)
            .into_iter()
            .map(|part| ask(&scene, c, Composite { part, of: c.of, frame: c.frame }.into()))
            .collect();
        scene.find.extend(all);
    }
    let asked: Vec<&str> = scene.find.iter().map(|f| f.text.as_str()).collect();
    let run = || work(&scene, Scope::Questions);
    let worked = std::panic::catch_unwind(std::panic::AssertUnwindSafe(run))
        .unwrap_or_else(|_| panic!("seed {seed}: a panic on\n{}\n{asked:?}", case.text));
    let worked = worked.unwrap_or_else(|f| panic!("seed {seed}: {f}\n{}", case.text)).value;
    Some((case, chosen, scene, worked))
}

/// The answer to a question: by analysis, and by drawing if it is drawn.
fn values(scene: &Scene, worked: &Worked, what: Asked) -> [Option<Vec2>; 2] {
    let vector = |v: AnswerValue| if let AnswerValue::Vector(v) = v { Some(v) } else { None };
    let Some(r) = worked.results.iter().find(|r| scene.find[r.find].what == what) else {
        return [None; 2];
    };
    [vector(r.computed), r.drawn.as_ref().and_then(|d| vector(d.value))]
}

/// The place of the point in a frame, by the positions.
fn seen(scene: &Scene, c: &FrameChoice, now: &Configuration, at: &Configuration) -> Option<Vec2> {
    let place = |at: &Configuration, p: hodograph::scene::PointId| at.points[p.0];
    Some(match (c.frame, c.of.link) {
        (Frame::Point(f), _) => place(at, c.of.point)? - place(at, f.point)?,
        (Frame::Link(l), own) => {
            // A point that is only at the contact is carried by its link.
            let p = match own.filter(|l| !scene.links[l.0].points.contains(&c.of.point)) {
                Some(own) => {
                    at.poses[own.0]?.to_world(now.poses[own.0]?.to_local(place(now, c.of.point)?))
                }
                None => place(at, c.of.point)?,
            };
            // In the axes of the frame, in their present direction.
            now.poses[l.0]?.turn(at.poses[l.0]?.to_local(p).to_vec2())
        }
    })
}

/// The later place of the frame's point that coincides with the moving point at the instant.
fn carried(c: &FrameChoice, now: &Configuration, at: &Configuration) -> Option<Point> {
    match c.frame {
        Frame::Link(l) => {
            Some(at.poses[l.0]?.to_world(now.poses[l.0]?.to_local(now.points[c.of.point.0]?)))
        }
        Frame::Point(f) => at.points[f.point.0],
    }
}

#[test]
fn parts_of_a_composite_motion_add_up_and_are_differences_of_positions() {
    let (mut added, mut compared, mut drawn_parts) = (0, 0, 0);
    for seed in seeds(120) {
        let Some((case, chosen, scene, worked)) = parted(seed) else { continue };
        let fail = |what: String| -> ! { panic!("seed {seed}: {what}\n{}", case.text) };
        let sizes = DiagramKind::POLYGONS
            .map(|l| worked.construction.polygon(l).map_or(0.0, |p| p.largest()));
        let extent = worked.configuration.extent();
        let omega = sizes[0] / extent;
        let rates = worked
            .construction
            .rates
            .iter()
            .filter(|r| r.on == DiagramKind::Velocity)
            .map(|r| r.value.abs())
            .fold(omega, f64::max);
        let scale = [sizes[0].max(1e-3), sizes[1].max(sizes[0] * rates).max(1e-3)];
        let well = worked.solution.condition < 2e2 && rates < 20.0;
        let h = 2e-3 / rates.max(1.0);
        let moved = if well { Motion::of(&case, h) } else { None };
        for c in &chosen {
            let name = format!(
                "{:?} {}",
                c.verdict,
                ask(&scene, c, PointMotion { rate: Rate::Velocity, of: c.of }.into()).text
            );
            for way in [0, 1] {
                let part = |p: CompositePart| {
                    values(&scene, &worked, Composite { part: p, of: c.of, frame: c.frame }.into())
                        [way]
                };
                let whole =
                    |rate| values(&scene, &worked, PointMotion { rate, of: c.of }.into())[way];
                let sum = |parts: &[CompositePart]| {
                    parts.iter().map(|p| part(*p)).try_fold(Vec2::ZERO, |s, v| Some(s + v?))
                };
                let coriolis: &[CompositePart] = if matches!(c.frame, Frame::Link(_)) {
                    &[CompositePart::Coriolis]
                } else {
                    &[]
                };
                let sums = [
                    (
                        0,
                        whole(Rate::Velocity),
                        sum(&[CompositePart::TransportVelocity, CompositePart::RelativeVelocity]),
                    ),
                    (
                        1,
                        whole(Rate::Acceleration),
                        sum(&[&[CompositePart::Transport, CompositePart::Relative], coriolis]
                            .concat()),
                    ),
                    (
                        1,
                        part(CompositePart::Transport),
                        sum(&[CompositePart::TransportNormal, CompositePart::TransportTangential]),
                    ),
                    (
                        1,
                        part(CompositePart::Relative),
                        sum(&[CompositePart::RelativeNormal, CompositePart::RelativeTangential]),
                    ),
                ];
                for (k, (on, whole, parts)) in sums.into_iter().enumerate() {
                    let (Some(whole), Some(parts)) = (whole, parts) else { continue };
                    let near = 1e-10 * worked.solution.condition.max(1e2) * scale[on];
                    if (whole - parts).norm() > near {
                        fail(format!("{name}, sum {k} by way {way}: {whole:?} is not {parts:?}"));
                    }
                    added += 1;
                    drawn_parts += way;
                }
            }
            let Some(moved) = &moved else { continue };
            let now = &moved.at[0];
            let there = |at: &Configuration| seen(&scene, c, now, at).unwrap_or(Vec2::ZERO);
            let seat = |at: &Configuration| carried(c, now, at).map_or(Vec2::ZERO, Point::to_vec2);
            if seen(&scene, c, now, now).is_none() || carried(c, now, now).is_none() {
                continue;
            }
            let differences = [
                (0, CompositePart::TransportVelocity, moved.first(h, seat)),
                (0, CompositePart::RelativeVelocity, moved.first(h, there)),
                (1, CompositePart::Transport, moved.second(h, seat)),
                (1, CompositePart::Relative, moved.second(h, there)),
            ];
            for (on, p, difference) in differences {
                let [computed, drawn] =
                    values(&scene, &worked, Composite { part: p, of: c.of, frame: c.frame }.into());
                for solved in [computed, drawn].into_iter().flatten() {
                    let allowed = if on == 0 { 1e-6 } else { 1e-5 };
                    if (difference - solved).norm() > allowed * scale[on] {
                        fail(format!(
                            "{name} {p:?}: differences say {difference:?}, solved {solved:?}"
                        ));
                    }
                    compared += 1;
                }
            }
        }
    }
    println!(
        "{added} sums ({drawn_parts} of drawn parts), {compared} parts against differences of positions"
    );
    assert!(
        added > 1000 / every(8) && drawn_parts > 300 / every(8) && compared > 500 / every(8),
        "{added} sums ({drawn_parts} drawn), {compared} compared"
    );
}
