//! Cams of the case collection, numbers to ten digits; profiles against envelopes.

use super::jet::CamJet;
use super::outline::{ProfilePart, segments};
use super::*;
use crate::geom::Vec2;

fn deg(a: f64) -> f64 {
    a.to_radians()
}

fn near(got: f64, exact: f64, what: &str) {
    assert!((got - exact).abs() <= 1e-9 * exact.abs().max(1.0), "{what}: {got}, it is {exact}");
}

fn program(stages: &[(StageMotion, f64)]) -> StageProgram {
    StageProgram::new(
        stages.iter().map(|(way, over)| Stage { way: *way, over: deg(*over) }).collect(),
    )
}

fn upward(offset: f64) -> Follower {
    Follower::Translating { direction: Vec2::new(0.0, 1.0), offset }
}

/// Case cam-law-offset-roller.
fn offset_roller() -> Disc {
    let stages = [
        (StageMotion::Rise(20.0, MotionLaw::Cycloidal), 120.0),
        (StageMotion::Dwell, 60.0),
        (StageMotion::Return(20.0, MotionLaw::Harmonic), 120.0),
        (StageMotion::Dwell, 60.0),
    ];
    let motion = CamMotion::Law { base: 30.0, program: program(&stages) };
    Disc { follower: upward(10.0), touch: FollowerTip::Point { radius: 10.0 }, motion, sense: 1.0 }
}

#[test]
fn offset_roller_by_a_law() {
    let disc = offset_roller();
    let s = disc.station(deg(70.0), PieceSide::After).unwrap();
    near(s.pressure.to_degrees(), 8.553_423_323_410_39, "pressure angle");
    near(s.rho_pitch, 39.832_677_797_992_6, "rho of the pitch curve");
    near(s.rho, 29.832_677_797_992_6, "rho of the profile");
    near(s.pitch.x, 52.272_987_973_521_1, "pitch x");
    near(s.pitch.y, 8.384_033_953_757_73, "pitch y");
    near(s.contact.x, 43.489_269_756_237_8, "profile x");
    near(s.contact.y, 3.604_254_222_497_54, "profile y");
    let survey = CamSurvey::of(&disc);
    let start = disc.station(0.0, PieceSide::After).unwrap();
    near(start.pressure.abs().to_degrees(), 14.477_512_185_929_9, "pressure at the start");
    let (phi, most) = survey.pressure[0].unwrap();
    assert_eq!(
        (phi, most),
        (0.0, start.pressure),
        "the greatest of the rise, because of the offset"
    );
    near(survey.least_rho.unwrap().1, 37.257_387_229_340_7, "least convex radius");
    assert!((survey.least_rho.unwrap().0.to_degrees() - 83.217_655_123_592_9).abs() < 1e-3);
    near(survey.stroke, 20.0, "stroke");
    let angles = [(1, false), (0, true), (-1, false), (0, false)]
        .map(|(way, out)| survey.angle(way, out).to_degrees());
    assert!(
        angles.iter().zip([120.0, 60.0, 120.0, 60.0]).all(|(a, b)| (a - b).abs() < 1e-9),
        "{angles:?}"
    );
    assert!(
        survey.jumps.iter().all(|j| j.shock == Shock::Soft) && survey.jumps.len() == 2,
        "{:?}",
        survey.jumps
    );
}

#[test]
fn oscillating_roller_by_a_law_in_both_senses() {
    let stages = [
        (StageMotion::Rise(deg(25.0), MotionLaw::ModifiedSine), 110.0),
        (StageMotion::Dwell, 250.0),
    ];
    let pivot = Vec2::new(100.0, 0.0);
    // The arm is above the line of centres: it is to the right, as seen from the pivot toward the
    // cam.
    let follower = Follower::Oscillating { pivot, arm: 80.0, sense: -1.0 };
    let motion = CamMotion::Law { base: 40.0, program: program(&stages) };
    for (sense, pressure, pitch, profile) in [
        (1.0, 29.315_303_483_730_4, 56.066_852_543_308_6, 48.066_852_543_308_6),
        (-1.0, 20.240_193_766_388_1, 59.277_613_252_833_0, 51.277_613_252_833_0),
    ] {
        let disc = Disc {
            follower,
            touch: FollowerTip::Point { radius: 8.0 },
            motion: motion.clone(),
            sense,
        };
        let s = disc.station(deg(60.0), PieceSide::After).unwrap();
        near(disc.rest(40.0).to_degrees(), 28.236_770_917_176_4, "psi0");
        near((s.q.value() - disc.rest(40.0)).to_degrees(), 14.490_504_756_657_3, "psi");
        near(6.0 * s.q.0[1], 2.366_938_147_963_52, "omega");
        near(s.pressure.abs().to_degrees(), pressure, "pressure angle");
        near(s.rho_pitch, pitch, "rho of the pitch curve");
        near(s.rho, profile, "rho of the profile");
    }
}

#[test]
fn oscillating_flat_face_by_a_law() {
    let stages =
        [(StageMotion::Rise(deg(15.0), MotionLaw::Harmonic), 120.0), (StageMotion::Dwell, 240.0)];
    let follower = Follower::Oscillating { pivot: Vec2::new(90.0, 0.0), arm: 0.0, sense: -1.0 };
    let motion = CamMotion::Law { base: 30.0, program: program(&stages) };
    let disc = Disc { follower, touch: FollowerTip::Flat { lever: -8.0 }, motion, sense: 1.0 };
    let s = disc.station(deg(50.0), PieceSide::After).unwrap();
    near(-4.0 * s.q.0[1], -0.758_636_369_945_597, "omega");
    near(-16.0 * s.q.0[2], -1.219_656_016_054_81, "alpha");
    near(s.rho, 40.071_739_924_852_3, "rho");
    // The contact in the frame of the ground.
    let at = s.contact.rotate_by(Vec2::from_angle(deg(50.0)));
    near(at.x, 29.810_343_919_18, "contact x");
    near(at.y, 26.214_324_630_840_2, "contact y");
    near((s.contact - s.pitch).norm(), 65.161_227_083_124_1, "from the foot");
}

#[test]
fn undercut_is_found_with_the_base_circle_that_avoids_it() {
    let stages =
        [(StageMotion::Rise(20.0, MotionLaw::Harmonic), 50.0), (StageMotion::Dwell, 310.0)];
    let motion = |base: f64, over: f64| CamMotion::Law {
        base,
        program: program(&[(stages[0].0, over), (StageMotion::Dwell, 360.0 - over)]),
    };
    let roller = Disc {
        follower: upward(0.0),
        touch: FollowerTip::Point { radius: 25.0 },
        motion: motion(15.0, 50.0),
        sense: 1.0,
    };
    let survey = CamSurvey::of(&roller);
    let Some(Fault::Undercut { phi, rho, least_base: Some(base) }) =
        survey.faults.iter().find(|f| matches!(f, Fault::Undercut { .. }))
    else {
        panic!("{:?}", survey.faults)
    };
    near(*rho, 18.987_341_772_151_9, "rho_min");
    near(*rho - 25.0, -6.012_658_227_848_1, "rho of the profile");
    near(phi.to_degrees(), 50.0, "its place");
    let better =
        CamSurvey::of(&Disc { motion: motion(base * (1.0 + 1e-9), 50.0), ..roller.clone() });
    assert!(
        !better.faults.iter().any(|f| matches!(f, Fault::Undercut { .. })),
        "{base}: {:?}",
        better.faults
    );
    let worse = CamSurvey::of(&Disc { motion: motion(base * (1.0 - 1e-6), 50.0), ..roller });
    assert!(worse.faults.iter().any(|f| matches!(f, Fault::Undercut { .. })));
    let flat = Disc {
        follower: upward(0.0),
        touch: FollowerTip::Flat { lever: 0.0 },
        motion: motion(20.0, 60.0),
        sense: 1.0,
    };
    let survey = CamSurvey::of(&flat);
    let Some(Fault::Undercut { rho, least_base: Some(base), .. }) = survey.faults.first() else {
        panic!("{:?}", survey.faults)
    };
    near(*rho, -50.0, "rho of the face");
    near(*base, 70.0, "least base circle");
}

/// Case khurmi-20.17-tangent: r1 30, roller 17.5, ascent 75°, lift 17.5.
fn tangent_cam() -> Disc {
    let (r1, lift, c) = (30.0, 17.5, libm::cos(deg(75.0)));
    let r2 = (r1 - (r1 + lift) * c) / (1.0 - c);
    let q = Vec2::new(r1 + lift - r2, 0.0);
    let parts = [
        ProfilePart::Circle(Vec2::ZERO, r1),
        ProfilePart::Tangent,
        ProfilePart::Circle(q, r2),
        ProfilePart::Tangent,
    ];
    let motion = CamMotion::Profile(segments(&parts).unwrap());
    Disc { follower: upward(0.0), touch: FollowerTip::Point { radius: 17.5 }, motion, sense: 1.0 }
}

#[test]
fn tangent_cam_with_both_accelerations_at_its_joints() {
    let disc = tangent_cam();
    let w = 600.0 * std::f64::consts::TAU / 60.0;
    let a = |phi: f64, side: PieceSide| 1e-3 * w * w * disc.coordinate(phi, side).unwrap().0[2];
    // The nose points up after the cam has turned by 90°; the rise begins 75° earlier.
    let (start, top) = (deg(90.0 - 75.0), deg(90.0));
    near(a(start, PieceSide::Before), 0.0, "on the dwell");
    near(a(start, PieceSide::After), 187.522_483_620_698, "at the start");
    let end = start + deg(25.647_322_912_090_4);
    near(a(end, PieceSide::Before), 303.925_890_252_233, "end of the flank");
    near(a(end, PieceSide::After), -57.560_898_874_488_1, "start of the nose");
    near(a(top, PieceSide::After), -146.386_701_193_958, "apex");
    near(
        1e-3 * w * disc.coordinate(end, PieceSide::After).unwrap().0[1],
        1.589_584_399_949_42,
        "velocity",
    );
    let survey = CamSurvey::of(&disc);
    near(survey.stroke, 17.5, "stroke");
    assert_eq!(survey.jumps.len(), 4, "{:?}", survey.jumps);
    assert!((survey.angle(1, false).to_degrees() - 75.0).abs() < 1e-6, "{:?}", survey.phases);
    assert!((survey.angle(0, false).to_degrees() - 210.0).abs() < 1e-6, "{:?}", survey.phases);
}

/// Case circular-arc-cam-flat.
#[test]
fn circular_arc_cam_with_a_flat_face() {
    let (oq, flank) = (45.0, 82.422_115_269_221_6);
    let parts = [
        ProfilePart::Circle(Vec2::ZERO, 30.0),
        ProfilePart::Flank(flank),
        ProfilePart::Circle(Vec2::new(oq, 0.0), 5.0),
        ProfilePart::Flank(flank),
    ];
    let motion = CamMotion::Profile(segments(&parts).unwrap());
    let disc =
        Disc { follower: upward(0.0), touch: FollowerTip::Flat { lever: 0.0 }, motion, sense: 1.0 };
    let w = 600.0 * std::f64::consts::TAU / 60.0;
    let a = |phi: f64, side: PieceSide| 1e-3 * w * w * disc.coordinate(phi, side).unwrap().0[2];
    let (start, top) = (deg(15.0), deg(90.0));
    let end = start + deg(34.154_359_666_108_2);
    near(a(start, PieceSide::After), 206.954_215_830_209, "start");
    near(a(end, PieceSide::Before), 171.260_419_261_936, "end of the flank");
    near(a(end, PieceSide::After), -134.389_840_579_167, "start of the nose");
    near(a(top, PieceSide::After), -177.652_879_219_608, "apex");
    let s = disc.station(end, PieceSide::After).unwrap();
    near((s.contact - s.pitch).norm(), 29.431_052_967_262_5, "contact from the axis");
}

/// An oscillating face with an offset from its pivot is not pushed along its own normal: its
/// pressure angle is the angle of the line from the pivot to the contact.
#[test]
fn a_face_beside_its_pivot_has_a_pressure_angle() {
    let parts = [ProfilePart::Circle(Vec2::new(12.0, 0.0), 30.0)];
    for (lever, sense, cam) in
        [(8.0, 1.0, 1.0), (-6.0, 1.0, -1.0), (8.0, -1.0, 1.0), (0.0, 1.0, 1.0)]
    {
        let follower = Follower::Oscillating { pivot: Vec2::new(90.0, 5.0), arm: 0.0, sense };
        let disc = Disc {
            follower,
            touch: FollowerTip::Flat { lever },
            motion: CamMotion::Profile(segments(&parts).unwrap()),
            sense: cam,
        };
        for k in 0..12 {
            let s = disc.station(deg(30.0 * k as f64 + 4.0), PieceSide::After).unwrap();
            // From the foot of the pivot on the face to the contact, and from the pivot to the
            // face.
            let along = (s.contact - s.pitch).norm();
            near(s.pressure.abs(), (lever.abs() / along).atan(), "pressure angle");
        }
    }
}

/// Curvature and contact of a profile of arcs are those of the arcs: inversion recovers the
/// profile.
#[test]
fn inversion_finds_the_profile_from_which_the_motion_was_made() {
    let disc = tangent_cam();
    let CamMotion::Profile(parts) = &disc.motion else { panic!() };
    let h = 1e-5;
    for k in 0..360 {
        let phi = deg(k as f64 + 0.37);
        let [low, here, high] =
            [phi - h, phi, phi + h].map(|p| disc.station(p, PieceSide::After).unwrap());
        let rho = parts[disc.touched(phi, PieceSide::After).unwrap()].radius();
        assert_eq!(here.rho, rho, "{k}");
        let turned = low.normal.cross(high.normal) / (high.contact - low.contact).norm();
        assert!((turned.abs() - 1.0 / rho).abs() < 1e-6, "{k}: {turned} {rho}");
    }
}

/// Cams in numbers that know their error: their enclosures contain the results of longer
/// numbers and of double precision.
#[test]
fn longer_numbers_find_the_same_places() {
    use crate::number::{Ball, Big, Dd, Real, decimal::Certain, within};
    fn asked<N: Real>(disc: &Disc, survey: &Surveyed) -> Vec<Option<N>> {
        let number = |x: f64| N::from_f64(x);
        let v = |v: Vec2| Vec2::new(number(v.x), number(v.y));
        let follower = match disc.follower {
            Follower::Translating { direction, offset } => {
                Follower::Translating { direction: v(direction), offset: number(offset) }
            }
            Follower::Oscillating { pivot, arm, sense } => {
                Follower::Oscillating { pivot: v(pivot), arm: number(arm), sense }
            }
        };
        let touch = match disc.touch {
            FollowerTip::Point { radius } => FollowerTip::Point { radius: number(radius) },
            FollowerTip::Flat { lever } => FollowerTip::Flat { lever: number(lever) },
        };
        let motion = match &disc.motion {
            CamMotion::Law { base, program } => {
                let stage = |s: &Stage| Stage {
                    way: match s.way {
                        StageMotion::Rise(h, law) => StageMotion::Rise(number(h), law),
                        StageMotion::Dwell => StageMotion::Dwell,
                        StageMotion::Return(h, law) => StageMotion::Return(number(h), law),
                    },
                    over: number(s.over),
                };
                CamMotion::Law {
                    base: number(*base),
                    program: StageProgram::new(program.stages().iter().map(stage).collect()),
                }
            }
            CamMotion::Profile(segments) => {
                let segment = |s: &ProfileSegment| match *s {
                    ProfileSegment::Arc { centre, radius, normals } => ProfileSegment::Arc {
                        centre: v(centre),
                        radius: number(radius),
                        normals: normals.map(number),
                    },
                    ProfileSegment::Line { normal, distance, ends } => ProfileSegment::Line {
                        normal: number(normal),
                        distance: number(distance),
                        ends: ends.map(number),
                    },
                };
                CamMotion::Profile(segments.iter().map(segment).collect())
            }
        };
        let exact = ExactCam::new(
            disc,
            survey,
            ExactDisc::new(Disc { follower, touch, motion, sense: disc.sense }),
        );
        let at = |phi: f64| (phi, PieceSide::After);
        let mut out =
            vec![exact.stroke(), exact.angle(1, false), exact.angle(0, false), exact.least_rho()];
        for phi in [0.3, 1.1, 2.9, 4.7] {
            out.push(exact.lift(at(phi), number(phi)));
            out.push(exact.station(at(phi), number(phi)).map(|s| s.pressure));
        }
        out
    }
    for disc in [offset_roller(), tangent_cam()] {
        let survey = Surveyed::default();
        let plain = asked::<f64>(&disc, &survey);
        within(400, || {
            let truth: Vec<_> = asked::<Ball<Big>>(&disc, &survey)
                .into_iter()
                .map(|x| x.and_then(Certain::enclosure))
                .collect();
            let seen = |all: Vec<Option<crate::number::decimal::Enclosure>>, most: f64| {
                for (k, (seen, truth)) in all.iter().zip(&truth).enumerate() {
                    let (Some(seen), Some(truth)) = (seen, truth) else {
                        panic!("{k}: {seen:?} {truth:?}")
                    };
                    assert!(seen.meets(truth), "{k}: {seen:?} {truth:?}");
                    assert!(seen.radius <= most * truth.approx.abs().max(1.0), "{k}: {seen:?}");
                }
            };
            seen(
                asked::<Ball<f64>>(&disc, &survey)
                    .into_iter()
                    .map(|x| x.and_then(Certain::enclosure))
                    .collect(),
                1e-9,
            );
            seen(
                asked::<Ball<Dd>>(&disc, &survey)
                    .into_iter()
                    .map(|x| x.and_then(Certain::enclosure))
                    .collect(),
                1e-24,
            );
            for (k, (plain, truth)) in plain.iter().zip(&truth).enumerate() {
                let (plain, truth) = (plain.unwrap(), truth.as_ref().unwrap().approx);
                assert!(
                    (plain - truth).abs() <= 1e-11 * truth.abs().max(1.0),
                    "{k}: {plain} {truth}"
                );
            }
        });
    }
}

/// The profile is the envelope of rollers and faces: neighbouring positions cross it at the
/// contact.
#[test]
fn profiles_are_envelopes() {
    let h = 1e-5;
    let disc = offset_roller();
    for k in 0..72 {
        let phi = deg(5.0 * k as f64 + 1.3);
        let [low, here, high] =
            [phi - h, phi, phi + h].map(|p| disc.station(p, PieceSide::After).unwrap());
        let along = high.contact - low.contact;
        assert!((here.contact - here.pitch).norm() - 10.0 < 1e-12);
        // The tangent of the profile is square to the normal, and the curvature is the change of
        // the normal's direction per length of arc.
        assert!(along.unit().unwrap().dot(here.normal).abs() < 1e-6, "{k}");
        let turned = low.normal.cross(high.normal) / along.norm();
        assert!((turned.abs() - (1.0 / here.rho).abs()).abs() < 1e-6, "{k}: {turned} {}", here.rho);
    }
}

#[test]
fn hollow_flanks_take_a_roller_that_is_small_enough() {
    let q = Vec2::new(45.0, 0.0);
    let parts = [
        ProfilePart::Circle(Vec2::ZERO, 30.0),
        ProfilePart::Flank(-60.0),
        ProfilePart::Circle(q, 12.0),
        ProfilePart::Flank(-60.0),
    ];
    let with = |radius: f64| Disc {
        follower: upward(0.0),
        touch: FollowerTip::Point { radius },
        motion: CamMotion::Profile(segments(&parts).unwrap()),
        sense: 1.0,
    };
    let survey = CamSurvey::of(&with(10.0));
    assert!(
        !survey
            .faults
            .iter()
            .any(|f| matches!(f, Fault::RollerTooLarge { .. } | Fault::NoContact { .. })),
        "{:?}",
        survey.faults
    );
    near(survey.stroke, 27.0, "stroke");
    assert!(
        CamSurvey::of(&with(61.0)).faults.iter().any(|f| matches!(f, Fault::RollerTooLarge { .. }))
    );
}

#[test]
fn an_eccentric_disc_moves_a_face_harmonically() {
    let parts = [ProfilePart::Circle(Vec2::new(12.0, 0.0), 30.0)];
    let motion = CamMotion::Profile(segments(&parts).unwrap());
    let disc =
        Disc { follower: upward(0.0), touch: FollowerTip::Flat { lever: 0.0 }, motion, sense: 1.0 };
    for k in 0..24 {
        let phi = deg(15.0 * k as f64);
        let q = disc.coordinate(phi, PieceSide::After).unwrap();
        let s = CamJet::variable(phi).sine_cosine().0 * 12.0;
        assert!((q.value() - 30.0 - s.value()).abs() < 1e-12 && (q.0[3] - s.0[3]).abs() < 1e-12);
    }
    let survey = CamSurvey::of(&disc);
    near(survey.stroke, 24.0, "stroke");
    assert!((survey.angle(1, false).to_degrees() - 180.0).abs() < 1e-6, "{:?}", survey.phases);
    assert!(survey.jumps.is_empty());
}

/// A profile of circles on an oval, with tangents or flanks of a radius between them.
fn oval(circles: usize, between: ProfilePart) -> Vec<ProfileSegment> {
    let circle = |k: usize| {
        let at = Vec2::from_angle(std::f64::consts::TAU * k as f64 / circles as f64);
        ProfilePart::Circle(Vec2::new(60.0 * at.x + 7.0, 45.0 * at.y), 5.0)
    };
    let parts: Vec<ProfilePart> = (0..circles).flat_map(|k| [circle(k), between]).collect();
    segments(&parts).unwrap()
}

/// The pieces that a prepared disc leaves out are nowhere touched, for each kind of follower and of
/// piece.
#[test]
fn a_prepared_disc_touches_the_same_pieces() {
    let pivot = Vec2::new(110.0, 20.0);
    let swings = |arm: f64, sense: f64| Follower::Oscillating { pivot, arm, sense };
    let (point, flat) =
        (|radius| FollowerTip::Point { radius }, |lever| FollowerTip::Flat { lever });
    let ends = [
        (upward(0.0), point(9.0)),
        (upward(-12.0), point(0.0)),
        (upward(40.0), point(3.0)),
        (swings(95.0, 1.0), point(9.0)),
        (swings(80.0, -1.0), point(0.5)),
        (swings(140.0, 1.0), point(4.0)),
        (upward(5.0), flat(0.0)),
        (swings(0.0, -1.0), flat(-8.0)),
        (swings(0.0, 1.0), flat(15.0)),
    ];
    let mut seen = std::collections::BTreeSet::new();
    for (k, between) in
        [ProfilePart::Tangent, ProfilePart::Flank(300.0), ProfilePart::Flank(-150.0)]
            .into_iter()
            .enumerate()
    {
        for (follower, touch) in ends {
            for sense in [1.0, -1.0] {
                let motion = CamMotion::Profile(oval(9, between));
                let disc = Disc { follower, touch, motion, sense };
                let prepared = PreparedDisc::of(&disc);
                let corners = prepared.corners();
                let beside = corners.iter().flat_map(|c| [c - 1e-9, *c, c + 1e-9]);
                for phi in (0..2000).map(|i| 0.005 * f64::from(i) - 2.0).chain(beside) {
                    for side in [PieceSide::Before, PieceSide::After] {
                        let piece = disc.touched(phi, side);
                        assert_eq!(prepared.touched(phi, side), piece, "{phi} {disc:?}");
                        seen.extend(piece.map(|i| (k, i)));
                    }
                }
            }
        }
    }
    assert!(seen.len() >= 3 * 17, "nearly all pieces are touched somewhere: {}", seen.len());
}

/// Many equal stages need the base circle of one of them; a stage that needs more decides.
#[test]
fn the_stage_that_needs_most_decides_on_the_least_base() {
    let least = |stages: &[(StageMotion, f64)], touch: FollowerTip| {
        let motion = CamMotion::Law { base: 30.0, program: program(stages) };
        least_base(&Disc { follower: upward(0.0), touch, motion, sense: 1.0 }).unwrap()
    };
    let pair = |h: f64, over: f64| {
        [
            (StageMotion::Rise(h, MotionLaw::Cycloidal), over),
            (StageMotion::Return(h, MotionLaw::Cycloidal), over),
        ]
    };
    for touch in [FollowerTip::Flat { lever: 0.0 }, FollowerTip::Point { radius: 6.0 }] {
        let one: Vec<_> = pair(1.0, 9.0).into_iter().chain([(StageMotion::Dwell, 342.0)]).collect();
        let many: Vec<_> = (0..20).flat_map(|_| pair(1.0, 9.0)).collect();
        let more: Vec<_> =
            (0..20).flat_map(|k| pair(if k == 7 { 1.5 } else { 1.0 }, 9.0)).collect();
        near(least(&many, touch), least(&one, touch), "equal stages");
        assert!(least(&more, touch) > 1.1 * least(&one, touch), "{touch:?}");
        // min(s + s″) of a cycloidal return: s″ = −2πh/β² sin 2πx, at its end part.
        let exact = (1..200_000)
            .map(|i| {
                let (x, b) = (f64::from(i) / 200_000.0, deg(9.0));
                let angle = std::f64::consts::TAU * x;
                let s = x - libm::sin(angle) / std::f64::consts::TAU;
                -(s + std::f64::consts::TAU / (b * b) * libm::sin(angle))
            })
            .fold(0.0, f64::max);
        if matches!(touch, FollowerTip::Flat { .. }) {
            assert!((least(&many, touch) / exact - 1.0).abs() < 1e-9, "{exact}");
        }
    }
}
