//! Curvature: drawing with the ruler against accelerations, both against reference cases and
//! against differences of places.

#[path = "curvature/figures.rs"]
mod figures;

use hodograph::construct::pencil::{Blunt, Hand};
use hodograph::curvature::by_hand::CurvatureTolerances;
use hodograph::curvature::drawing::{CurvatureDrawing, RayMethod};
use hodograph::curvature::known::CurvaturePlaces;
use hodograph::curvature::motion::{Bend, PlaneState};
use hodograph::curvature::{
    CurvatureRequest, LinkCurvatures, OfLink, centrodes, couplers, curvature,
};
use hodograph::geom::{Point, Vec2};
use hodograph::mechanism::{Demand, Mechanism};
use hodograph::position::configure;
use hodograph::scene::{self, LinkId, PointId, Scene, templates};
use serde_json::Value as Json;

fn read(text: &str) -> Scene {
    scene::read(text).unwrap_or_else(|f| panic!("{f}\n{text}")).value
}

fn template(name: &str, values: &[(&str, &str)]) -> Scene {
    read(&templates::instantiate(name, values).unwrap())
}

fn all(scene: &Scene) -> LinkCurvatures {
    let asked = CurvatureRequest { links: couplers(scene), ..CurvatureRequest::default() };
    curvature(scene, &asked).unwrap_or_else(|f| panic!("{f}")).value
}

fn link(scene: &Scene, name: &str) -> LinkId {
    LinkId(scene.links.iter().position(|l| l.name == name).unwrap())
}

fn point(scene: &Scene, name: &str) -> PointId {
    PointId(scene.points.iter().position(|p| p.name == name).unwrap())
}

/// The cases by the ruler: no velocity enters P, J and E₀.
#[test]
fn cases_by_drawing() {
    let mut values = 0;
    for name in ["curv-fourbar", "curv-slider-crank", "curv-cardan"] {
        let path = format!("{}/tests/cases/{name}.json", env!("CARGO_MANIFEST_DIR"));
        let case: Json = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
        let scene = read(&case["scene"].to_string());
        let found = all(&scene);
        let of = &found.list[0];
        let drawn = of.drawn().unwrap();
        let e = of.points.iter().find(|p| scene.point_name(p.point) == "E").unwrap();
        let centre = e.drawn.unwrap().centre.at().unwrap();
        let (j, k, u) = (
            drawn.pole + drawn.normal,
            drawn.acceleration_pole.unwrap(),
            drawn.pole_velocity.unwrap(),
        );
        for expected in case["expect"].as_array().unwrap() {
            let value = match expected["name"].as_str().unwrap() {
                "P_x" => drawn.pole.x,
                "P_y" => drawn.pole.y,
                "J_x" => j.x,
                "J_y" => j.y,
                "d_inflection" => drawn.normal.norm(),
                "K_x" => k.x,
                "K_y" => k.y,
                "rho_E" => centre.distance(e.at),
                "E0_x" => centre.x,
                "E0_y" => centre.y,
                "u_P" => u.norm(),
                other => panic!("{other}"),
            };
            let exact: f64 = expected["exact"].as_str().unwrap().parse().unwrap();
            let size = expected["size"].as_f64().unwrap_or(exact.abs());
            assert!(
                (value - exact).abs() < 1e-10 * size,
                "{name} {}: {value}, expected {exact}",
                expected["name"]
            );
            values += 1;
        }
        assert!(of.apart().unwrap() < 1e-11, "{name}: {:?}", of.apart());
    }
    assert_eq!(values, 33);
}

#[test]
fn the_collineation_point_is_where_the_rod_crosses_the_ground() {
    let found = all(&template(
        "crank-rocker",
        &[("l_AB", "100"), ("l_BC", "250"), ("l_CD", "200"), ("l_AD", "300"), ("phi_1", "60")],
    ));
    let CurvatureDrawing::Rays(rays) = &found.list[0].drawing else {
        panic!("two cranks are two rays")
    };
    let q = rays.collineation.unwrap().at().unwrap();
    assert!(q.distance(Point::new(-0.123_487_028_874_023_54, 0.0)) < 1e-12, "{q:?}");
    assert!(rays.how.iter().all(|h| matches!(h, RayMethod::Collineation(_))));
}

/// Every template with a coupler, at many positions: both methods agree, also on Ball's point.
#[test]
fn drawing_is_analysis_everywhere() {
    let (mut poses, mut balls, mut faults) = (0, 0, Vec::new());
    for t in templates::list() {
        let turns = t.parameters.iter().any(|(name, _)| name == "phi_1");
        for k in 0..if turns { 12 } else { 1 } {
            let angle = format!("{} deg", 7 + 30 * k);
            let values: Vec<(&str, &str)> =
                if turns { vec![("phi_1", angle.as_str())] } else { Vec::new() };
            let Ok(text) = templates::instantiate(t.name, &values) else { continue };
            let Ok(scene) = scene::read(&text) else { continue };
            let asked =
                CurvatureRequest { links: couplers(&scene.value), ..CurvatureRequest::default() };
            let Ok(found) = curvature(&scene.value, &asked) else { continue };
            for of in &found.value.list {
                let Some(apart) = of.apart() else { continue };
                poses += 1;
                balls += usize::from(
                    of.drawn().unwrap().ball.is_some()
                        && of.pole().is_some_and(|p| p.ball.is_some()),
                );
                // The curvature at a joint beside the pole loses digits with the third power of
                // its distance.
                let pole = of.pole().unwrap().pole;
                let near = of.points.iter().map(|p| p.at.distance(pole)).fold(1.0, f64::min);
                let most = 1e-8_f64.max(1e-15 * (of.motion.size / near).powi(3));
                if apart.is_nan() || apart > most {
                    faults.push(format!(
                        "{} {values:?} link {}: {apart:e}",
                        t.name,
                        scene.value.link_name(of.link)
                    ));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{} of {poses}:\n{}", faults.len(), faults.join("\n"));
    assert!(poses > 200 && balls > 100, "{poses} poses, {balls} Ball's points");
}

/// Tolerances of hand drawing go with the pencil, hold the readings of other drawings of as blunt a
/// pencil, and vanish with it: the hand draws the exact construction.
#[test]
fn tolerances_of_hand_drawing_go_with_the_pencil() {
    let mut compared = 0;
    for name in
        ["crank-rocker", "slider-crank", "whitworth", "geared-five-bar", "hypocycloid", "shaper"]
    {
        let with = |pencil_mm: f64| {
            let mut scene = template(name, &[]);
            scene.paper.pencil_mm = Some(pencil_mm);
            all(&scene).with_drafting()
        };
        let (fine, blunt) = (with(0.01), with(0.02));
        for (a, b) in fine.list.iter().zip(&blunt.list) {
            let (Some(a), Some(b)) = (&a.by_hand, &b.by_hand) else { continue };
            let bounds = |t: &CurvatureTolerances| {
                [t.pole, t.inflection_pole, t.diameter, t.ball]
                    .into_iter()
                    .chain(t.radii.clone())
                    .collect::<Vec<_>>()
            };
            for (x, y) in bounds(a).into_iter().zip(bounds(b)).filter_map(|(x, y)| Some((x?, y?))) {
                // A reading of the given, without any mark between, is exact.
                if x > 0.0 {
                    compared += 1;
                    assert!((1.6..2.4).contains(&(y / x)), "{name}: {x} {y}");
                }
            }
        }
    }
    assert!(compared > 20, "{compared}");
    // A pencil without error draws what the ruler finds.
    let scene = template("crank-rocker", &[]);
    let found = all(&scene);
    let hand = Hand::with(Blunt::new(0.0, 1), found.worked.construction.diagram.mu);
    let places = CurvaturePlaces {
        scene: &found.scene,
        at: &found.worked.configuration,
        against: found.against,
        hand: &hand,
    };
    let drawing = places.drawing_behind(found.list[0].link, &[]);
    assert_eq!(drawing, found.list[0].drawing);
}

/// Pseudo-random numbers that repeat on every machine (xorshift64*).
struct Random(u64);

impl Random {
    fn next(&mut self, from: f64, to: f64) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let unit = (self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11) as f64 / (1u64 << 53) as f64;
        from + unit * (to - from)
    }
}

/// A four-bar with a coupler point E; with `more` a dyad from E to a further pivot G.
struct Linkage {
    lengths: [f64; 6],
    pivot: [f64; 2],
    dyad: [f64; 2],
    omega: f64,
    six: bool,
}

impl Linkage {
    fn random(r: &mut Random, six: bool) -> Linkage {
        let ad = r.next(80.0, 120.0);
        let ab = r.next(20.0, 45.0);
        let lengths = [
            ab,
            r.next(80.0, 130.0),
            r.next(60.0, 110.0),
            ad,
            r.next(30.0, 90.0),
            r.next(-60.0, 60.0),
        ];
        let pivot = [ad + r.next(30.0, 120.0), r.next(-30.0, 60.0)];
        Linkage {
            lengths,
            pivot,
            dyad: [r.next(120.0, 160.0), r.next(70.0, 130.0)],
            omega: r.next(2.0, 8.0),
            six,
        }
    }

    /// The scene with its crank at an angle (degrees).
    fn scene(&self, angle: f64) -> Result<Scene, String> {
        let [ab, bc, cd, ad, x, y] = self.lengths;
        let [gx, gy] = self.pivot;
        let [ef, fg] = self.dyad;
        let (links, points, lengths) = if self.six {
            (
                r#", "5": ["E", "F"], "6": ["F", "G"], "4": ["A", "D", "G"]"#,
                format!(r#", "G": [{gx}, {gy}]"#),
                format!(r#", "EF": {ef}, "FG": {fg}"#),
            )
        } else {
            (r#", "4": ["A", "D"]"#, String::new(), String::new())
        };
        let text = format!(
            r#"{{"units": {{"length": "mm", "angle": "deg", "omega": "rad/s"}},
            "links": {{"1": ["A", "B"], "2": ["B", "C", "E"], "3": ["C", "D"]{links}}}, "ground": "4",
            "points": {{"A": [0, 0], "D": [{ad}, 0], "E": {{"base": "BC", "x": {x}, "y": {y}}}{points}}},
            "lengths": {{"AB": {ab}, "BC": {bc}, "CD": {cd}{lengths}}},
            "side": {{"C": "left of BD"{side}}},
            "driver": {{"link": "1", "angle": "{angle:.17} deg", "omega": {omega}}}, "find": ["v_C"]}}"#,
            side = if self.six { r#", "F": "left of EG""# } else { "" },
            omega = self.omega,
        );
        scene::read(&text).map(|s| s.value).map_err(|f| f.to_string())
    }

    /// The place of a point with the crank at an angle, from positions alone.
    fn place(&self, p: &str, angle: f64) -> Option<Point> {
        let scene = self.scene(angle).ok()?;
        let m = Mechanism::new(&scene).ok()?.value;
        let demand = Demand::of(&scene, &m).with_all_positions();
        configure(&scene, &m, &demand).ok()?.value.points[point(&scene, p).0]
    }
}

/// First and second time derivative from seven places, to the sixth order in the step.
fn derivatives(at: [Point; 7], step: f64) -> (Vec2, Vec2) {
    let first = [-1.0, 9.0, -45.0, 0.0, 45.0, -9.0, 1.0];
    let second = [2.0, -27.0, 270.0, -490.0, 270.0, -27.0, 2.0];
    let sum = |c: [f64; 7], over: f64| {
        at.iter().zip(c).fold(Vec2::ZERO, |s, (p, c)| s + (*p - at[3]) * (c / over))
    };
    (sum(first, 60.0 * step), sum(second, 180.0 * step * step))
}

/// The places of a point at seven positions of the crank.
fn seven(linkage: &Linkage, p: &str, angle: f64, step_deg: f64) -> Option<[Point; 7]> {
    let mut out = [Point::ORIGIN; 7];
    for (k, place) in out.iter_mut().enumerate() {
        *place = linkage.place(p, angle + (k as f64 - 3.0) * step_deg)?;
    }
    Some(out)
}

/// Radius and centre of curvature against differences of the path; pole velocity against
/// differences of P; on random four-bars and six-bars.
#[test]
fn curvature_is_that_of_the_path() {
    let mut r = Random(20);
    let (mut points, mut poles) = (0, 0);
    let step_deg: f64 = 0.25;
    for k in 0..60 {
        let linkage = Linkage::random(&mut r, k % 2 == 1);
        let angle = r.next(0.0, 360.0);
        let Ok(scene) = linkage.scene(angle) else { continue };
        let asked = CurvatureRequest { links: couplers(&scene), ..CurvatureRequest::default() };
        let Ok(found) = curvature(&scene, &asked) else { continue };
        let step = step_deg.to_radians() / linkage.omega;
        for of in &found.value.list {
            let Some(pole) = of.pole() else { continue };
            assert!(of.apart().is_none_or(|a| a < 1e-9), "{k}: {:?}", of.apart());
            for q in &of.points {
                let Bend::About(centre, radius) = q.bend else { continue };
                let Some(at) = seven(&linkage, scene.point_name(q.point), angle, step_deg) else {
                    continue;
                };
                let (v, a) = derivatives(at, step);
                let turn = v.cross(a);
                if turn.abs() < 0.05 * v.norm() * a.norm() {
                    continue;
                }
                let expected = v.norm().powi(3) / turn.abs();
                assert!(
                    (radius - expected).abs() < 1e-6 * expected,
                    "{k} {}: {radius}, by the path {expected}",
                    scene.point_name(q.point)
                );
                let expected = at[3] + v.perp() * (v.norm2() / turn);
                assert!(centre.distance(expected) < 1e-6 * radius, "{k}: {centre:?} {expected:?}");
                points += 1;
            }
            // P as the drawing finds it, from places alone, at seven positions.
            let mut all = [Point::ORIGIN; 7];
            let drawn = |i: usize| {
                let scene = linkage.scene(angle + (i as f64 - 3.0) * step_deg).ok()?;
                let asked =
                    CurvatureRequest { links: vec![of.link], ..CurvatureRequest::default() };
                curvature(&scene, &asked).ok()?.value.list.first()?.drawn().map(|d| d.pole)
            };
            if !(0..7).all(|i| {
                drawn(i).is_some_and(|p| {
                    all[i] = p;
                    true
                })
            }) || pole.pole.distance(Point::ORIGIN) > 0.5
            {
                continue;
            }
            let (u, _) = derivatives(all, step);
            assert!(
                (u - pole.pole_velocity).norm() < 1e-4 * u.norm(),
                "{k}: {u:?} {:?}",
                pole.pole_velocity
            );
            poles += 1;
        }
    }
    assert!(points > 80 && poles > 20, "{points} points, {poles} poles");
}

/// At Ball's point the curvature of the path is zero, and stays zero to the next order: the path
/// differs from a straight line by the fourth power.
#[test]
fn balls_point_runs_straight_to_the_third_order() {
    let mut r = Random(7);
    let mut seen = 0;
    for k in 0..20 {
        let mut linkage = Linkage::random(&mut r, false);
        let angle = r.next(0.0, 360.0);
        let Ok(scene) = linkage.scene(angle) else { continue };
        let found = all(&scene);
        let Some(ball) = found.list[0].pole().and_then(|p| p.ball) else { continue };
        let at = &found.worked.configuration;
        let [b, c] = ["B", "C"].map(|p| at.points[point(&scene, p).0].unwrap());
        let local = (ball - b).divide_by((c - b).unit().unwrap()) * 1e3;
        if local.norm() > 500.0 {
            continue;
        }
        [linkage.lengths[4], linkage.lengths[5]] = [local.x, local.y];
        let places = |h: f64| [-1.0, 1.0].map(|s| linkage.place("E", angle + s * h));
        let (Some(middle), [Some(a1), Some(a2)], [Some(b1), Some(b2)]) =
            (linkage.place("E", angle), places(4.0), places(2.0))
        else {
            continue;
        };
        // The even part of the motion across the tangent: of second order for a curved path, of
        // fourth order here.
        let t = (b2 - b1).unit().unwrap();
        let across = |p: Point, q: Point| (t.cross(p - middle) + t.cross(q - middle)).abs();
        let (far, near) = (across(a1, a2), across(b1, b2));
        let odd = |p: Point, q: Point| (t.cross(p - middle) - t.cross(q - middle)).abs();
        let (of, on) = (odd(a1, a2), odd(b1, b2));
        assert!(far < 1e-12 || far / near > 12.0, "{k}: {far:e} against {near:e}");
        // The direction of the chord has a third-order error: the remainder is then also of third
        // order, not of first.
        assert!(of < 1e-12 || on < 1e-12 || of / on > 6.0, "{k}: {of:e} against {on:e}");
        seen += 1;
    }
    assert!(seen > 5, "{seen}");
}

/// The centrodes roll on one another: seen from the link they are the moving one, and they have a
/// common tangent at the pole.
#[test]
fn centrodes_touch_in_the_pole() {
    for name in [
        "crank-rocker",
        "slider-crank",
        "shaper",
        "watt-six-bar",
        "elliptic-trammel",
        "oscillating-cylinder",
    ] {
        let scene = template(name, &[]);
        let found = all(&scene);
        for of in &found.list {
            let paths =
                centrodes::centrodes(&found.scene, &found.worked, of.link, found.against, 720)
                    .unwrap();
            let pole = of.pole().unwrap();
            let k = paths.stations.iter().position(|s| s.is_some_and(|s| s.travel == 0.0)).unwrap();
            let at = |k: usize| paths.stations[k % paths.stations.len()].unwrap();
            assert!(at(k).pole().distance(pole.pole) < 1e-9 * of.motion.size, "{name}");
            let moving = |s: centrodes::PoleStation| (s.moving * (1.0 / s.omega)).to_point();
            assert!(moving(at(k)).distance(pole.pole) < 1e-9 * of.motion.size, "{name}");
            let n = paths.stations.len();
            let (fixed, moved) = (
                at(k + 1).pole() - at(k + n - 1).pole(),
                moving(at(k + 1)) - moving(at(k + n - 1)),
            );
            // Equal arcs: they roll without slip.
            assert!((fixed - moved).norm() < 2e-3 * fixed.norm(), "{name}: {fixed:?} {moved:?}");
        }
    }
}

/// Cardan's circles: the fixed centrode of the trammel's bar is a circle about the intersection of
/// its guides, the moving one is half as large.
#[test]
fn cardans_centrodes_are_circles() {
    let scene = template("elliptic-trammel", &[]);
    let found = all(&scene);
    let bar = found.list.iter().find(|of| scene.links[of.link.0].points.len() > 1).unwrap();
    let paths =
        centrodes::centrodes(&found.scene, &found.worked, bar.link, found.against, 360).unwrap();
    let poles: Vec<Point> =
        paths.stations.iter().flatten().map(|s| s.pole()).filter(|p| p.is_finite()).collect();
    let radius = bar.pole().unwrap().diameter();
    let centre = bar.pole().unwrap().inflection_pole();
    assert!(
        poles.len() > 100
            && poles.iter().all(|p| (p.distance(centre) - radius).abs() < 1e-9 * radius)
    );
}

/// The moving centrode of a wheel is its contour, and is dashed all round although the pole goes
/// round it many times.
#[test]
fn the_moving_centrode_of_a_planet_is_one_dashed_circle() {
    use hodograph::figure::list::{Extras, FigureInput, named};
    use hodograph::figure::sheet::SheetOptions;
    use hodograph::paper::item::{Dash, Shape};
    use hodograph::worked::{Scope, work};
    let scene = read(
        r#"{"links": {"1": ["O"], "2": ["O", "Q"], "3": ["Q", "M"]}, "ground": "1",
        "points": {"O": [0, 0], "Q": ["60 mm*cos(35 deg)", "60 mm*sin(35 deg)"], "M": ["60 mm", "60 mm"]},
        "gears": [{"links": ["3", "1"], "centres": ["Q", "O"], "radii": ["40 mm", "100 mm"], "ring": "1"}],
        "driver": {"link": "2", "omega": "3 rad/s"}}"#,
    );
    let worked = work(&scene, Scope::Figure).unwrap().value;
    let options = SheetOptions::of_language(scene::Lang::En);
    let wanted = FigureInput {
        scene: &scene,
        worked: &worked,
        options: &options,
        extras: &Extras::default(),
    };
    let pages = (named("centrodes").unwrap().draw)(&wanted).unwrap().value;
    let (_, page) = pages.iter().find(|(_, p)| p.desc.contains("QM")).unwrap();
    let round = |i: &hodograph::paper::item::FigureItem| match i.shape {
        Shape::Arc { centre, radius_mm, stroke, .. } if radius_mm > 20.0 => {
            Some((centre, radius_mm, stroke.dash))
        }
        _ => None,
    };
    let circles: Vec<_> = page.items.iter().filter_map(round).collect();
    let dashed: Vec<_> = circles.iter().filter(|c| c.2 == Dash::Dashed).collect();
    let [(centre, radius, _)] = dashed[..] else { panic!("{circles:?}") };
    let over = circles
        .iter()
        .filter(|c| c.0.distance(*centre) < 1e-6 && (c.1 - radius).abs() < 1e-6)
        .count();
    assert_eq!(over, 1, "nothing is drawn over the dashes: {circles:?}");
}

/// Messages where a point or centre does not exist.
#[test]
fn degenerate_poses_are_reported() {
    let state = |name: &str, values: &[(&str, &str)]| {
        let scene = template(name, values);
        let found = all(&scene);
        let of: OfLink = found.list.into_iter().next().unwrap();
        (of.state, of.drawing, of.points)
    };
    // A parallelogram's coupler translates.
    let (s, drawing, _) = state("parallelogram", &[("phi_1", "70")]);
    assert!(
        matches!(s, PlaneState::Translation(_)) && matches!(drawing, CurvatureDrawing::Parallel(_)),
        "{s:?} {drawing:?}"
    );
    // The slider-crank at its dead centre: the crosshead is the pole, and its path has an end.
    let dead = read(
        r#"{"units": {"length": "mm", "angle": "deg"}, "links": {"1": ["A", "B"], "2": ["B", "C"], "3": ["C"], "4": ["A"]}, "ground": "4",
        "points": {"A": [0, 0]}, "lengths": {"AB": 100, "BC": 300}, "guides": [{"pin": "C", "slider": "3", "through": "A", "angle": 0}],
        "sketch": {"C": [400, 0]}, "driver": {"link": "1", "angle": 0, "omega": "10 rad/s"}, "find": ["v_C"]}"#,
    );
    let of = all(&dead).list.swap_remove(0);
    let (s, drawing, points) = (of.state, of.drawing, of.points);
    assert!(matches!(s, PlaneState::Turning(_)), "{s:?} {drawing:?}");
    assert!(points.iter().any(|p| p.bend == Bend::AtPole), "{points:?}");
    // With the crank perpendicular to the guide, the coupler translates.
    let (s, drawing, _) = state("slider-crank", &[("phi_1", "90")]);
    assert!(
        matches!(s, PlaneState::Translation(_)) && matches!(drawing, CurvatureDrawing::Parallel(_)),
        "{s:?} {drawing:?}"
    );
    // The crosshead of a slider-crank moves straight: its centre of curvature does not exist.
    let (_, _, points) = state("slider-crank", &[]);
    assert!(points.iter().any(|p| p.bend == Bend::Straight), "{points:?}");
    // A crank turns about its pin, permanently.
    let scene = template("crank-rocker", &[]);
    let asked = CurvatureRequest { links: vec![link(&scene, "1")], ..CurvatureRequest::default() };
    let found = curvature(&scene, &asked).unwrap().value;
    assert!(
        matches!(found.list[0].drawing, CurvatureDrawing::Hinge(_))
            && found.list[0].pole().unwrap().stands()
    );
    // Seen from the crank, the rocker has its pole where the ground has that of the coupler's rays.
    let asked = CurvatureRequest {
        links: vec![link(&scene, "3")],
        against: Some(link(&scene, "1")),
        ..CurvatureRequest::default()
    };
    let found = curvature(&scene, &asked).unwrap().value;
    assert!(found.list[0].apart().unwrap() < 1e-11, "{:?}", found.list[0].apart());
}
