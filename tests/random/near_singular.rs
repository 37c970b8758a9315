//! Poses near singular ones: the answers converge to those of the singular pose, and no number is
//! large or short of digits without a remark.

use crate::properties::seeds;
use crate::rng::Rng;
use crate::singular::{FOUR_BAR, FRAMES, RATES, close, drive, number, run, scene_in};
use hodograph::answer::AnswerValue;
use hodograph::geom::Vec2;
use hodograph::worked::Outcome;

/// The crank passes the rocker's reversal with the motion of the rocker's drive: its jerk vanishes
/// there.
#[test]
fn accelerations_at_a_limit_agree_with_the_other_drive() {
    let omega = (1.0f64 / 0.7).sqrt();
    let alpha = |t: f64| {
        let rest = format!(
            r#""driver": {{"link": "1", "angle": "{:e} rad", "omega": "{:e} rad/s", "alpha": "{} rad/s^2"}}, "find": ["alpha_3"]"#,
            omega * t + 1.5 / 7.0 * t * t,
            omega + 3.0 / 7.0 * t,
            3.0 / 7.0
        );
        let text = format!(
            r#"{{"links": {FOUR_BAR}, "ground": "0", "points": {{"A": ["0 m", "0 m"], "D": ["4 m", "-4 m"]}},
            "lengths": {{"AB": "2 m", "BC": "5 m", "CD": "5 m"}}, "sketch": {{"C": ["7 m", "0 m"]}}, {rest}}}"#
        );
        let (_, done, _) = run(&text).unwrap_or_else(|e| panic!("{e}\n{text}"));
        number(done.results[0].value())
    };
    assert!(close(alpha(0.0), 1.0, 1.0));
    for h in [1e-2, 1e-3] {
        let jerk = (alpha(h) - alpha(-h)) / (2.0 * h);
        assert!(jerk.abs() < 20.0 * h * h + 1e-9, "jerk {jerk:e} at {h}");
    }
}

/// A four-bar that can be folded flat, 2 + 5 = 3 + 4: both motions at the change point are the
/// limits of those near it.
#[test]
fn both_motions_are_limits_of_those_nearby() {
    let at = |angle: f64, side: &str| {
        let text = format!(
            r#"{{"links": {FOUR_BAR}, "ground": "0", "lengths": {{"AB": "2 m", "BC": "3 m", "CD": "5 m", "AD": "4 m"}}, "side": {{"C": "{side} of BD"}},
            "driver": {{"link": "1", "angle": "{angle:e} rad", "omega": "1 rad/s"}}, "find": ["omega_2", "omega_3"]}}"#
        );
        let (_, done, notes) = run(&text).unwrap_or_else(|e| panic!("{e}\n{text}"));
        (done.results.iter().map(|o| number(o.value())).collect::<Vec<_>>(), notes)
    };
    for side in ["left", "right"] {
        let (here, _) = at(0.0, side);
        for h in [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-12] {
            let (near, notes) = at(h, side);
            let warned = notes.iter().any(|d| ["near-singular", "change-point"].contains(&d.code));
            // The motions differ from their limit by h²; positions are rounded from certified ones,
            // so that velocities lose ε/h.
            let rounding = 1e-14 / h;
            for (a, b) in near.iter().zip(&here) {
                assert!(
                    (a - b).abs() <= 10.0 * h * h + rounding.min(1e-6),
                    "{side} at {h:e}: {near:?}, limit {here:?}"
                );
                assert!(rounding < 1e-6 || warned, "{side} at {h:e}: no word of it");
            }
        }
    }
}

/// Poses by coordinates near a dead centre: the answers grow with 1/h, are true to the last digits
/// at any distance, and are printed.
#[test]
fn near_a_dead_point() {
    for f in FRAMES {
        for k in (1..=16).chain([20, 30, 60]) {
            let h = 10f64.powi(-k);
            let points = [("A", 0.0, 0.0), ("B", 2.0, 0.0), ("C", 7.0, 5.0 * h), ("D", 4.0, -4.0)];
            let text = scene_in(f, FOUR_BAR, &points, &format!("{}, {RATES}", drive(3, 1.0, 0.0)));
            let (_, done, notes) = run(&text).unwrap_or_else(|e| panic!("{e}\n{text}"));
            // v_C·(C − B) = v_B·(C − B): ω₁ = DC⊥·BC / AB⊥·BC.
            let (ab, bc, dc) =
                (Vec2::new(2.0, 0.0), Vec2::new(5.0, 5.0 * h), Vec2::new(3.0, 4.0 + 5.0 * h));
            let expected = dc.perp().dot(bc) / ab.perp().dot(bc);
            let got = number(done.results[0].value());
            // Shifted coordinates are rounded at their own size.
            let rounding = 1e-15 * if f.shift == Vec2::ZERO { 1.0 } else { 8.0 };
            let longer = done.results[0].longer.is_some();
            let bound = if longer { 1e-14 } else { 4.0 * rounding / h };
            assert!(
                (got - expected).abs() <= bound * expected.abs(),
                "h {h:e}: {got:e} {expected:e}\n{text}"
            );
            assert!(longer || k < 14, "h {h:e}\n{text}");
            let warned = notes.iter().any(|d| {
                d.code == "near-singular" && d.message.en.contains("link 1 (AB) and link 2 (BC)")
            });
            assert!(warned || rounding / h < 1e-6, "h {h:e}: {got:e} without a word\n{text}");
        }
    }
}

/// Lengths of a crank-rocker, and crank and coupler in line: +1 stretched, −1 folded.
struct CrankRocker {
    crank: f64,
    coupler: f64,
    rocker: f64,
    ground: f64,
    sense: f64,
}

impl CrankRocker {
    fn random(seed: u64) -> Option<CrankRocker> {
        let mut rng = Rng::new(seed);
        let mut length = || (rng.between(0.2, 2.0) * 1e4).round() / 1e4;
        let (coupler, rocker, ground) = (length(), length(), length());
        let crank = (rng.between(0.05, 0.5) * 1e4).round() / 1e4;
        let sense = if rng.chance(0.5) { 1.0 } else { -1.0 };
        let longest = coupler.max(rocker).max(ground);
        let sum = crank + coupler + rocker + ground;
        // The crank is the shortest, with a margin: no change point is near.
        let fits =
            crank < 0.9 * coupler.min(rocker).min(ground) && 2.0 * (crank + longest) < 0.97 * sum;
        fits.then_some(CrankRocker { crank, coupler, rocker, ground, sense })
    }

    /// Distance AC.
    fn reach(&self) -> f64 {
        self.coupler + self.sense * self.crank
    }

    /// Direction of AC, by the cosine law.
    fn angle(&self) -> f64 {
        let (s, g, r) = (self.reach(), self.ground, self.rocker);
        libm::acos((s * s + g * g - r * r) / (2.0 * s * g))
    }

    fn places(&self) -> [(&'static str, f64, f64); 4] {
        let u = Vec2::from_angle(self.angle());
        let (b, c) = (u * (self.sense * self.crank), u * self.reach());
        [("A", 0.0, 0.0), ("B", b.x, b.y), ("C", c.x, c.y), ("D", self.ground, 0.0)]
    }

    /// α₃ for ω₁ = 1: a_C along AC is −a ω² (σ + a/b), produced by α₃ on the component of DC
    /// perpendicular to AC.
    fn alpha(&self) -> f64 {
        let u = Vec2::from_angle(self.angle());
        let dc = u * self.reach() - Vec2::new(self.ground, 0.0);
        -self.crank * (self.sense + self.crank / self.coupler) / dc.perp().dot(u)
    }

    fn by_lengths(&self, driver: &str) -> String {
        format!(
            r#"{{"links": {FOUR_BAR}, "ground": "0", "lengths": {{"AB": "{} m", "BC": "{} m", "CD": "{} m", "AD": "{} m"}},
            "sketch": {{"C": ["{} m", "{} m"], "B": ["{} m", "{} m"]}}, {driver}, {RATES}}}"#,
            self.crank,
            self.coupler,
            self.rocker,
            self.ground,
            self.places()[2].1,
            self.places()[2].2,
            self.places()[1].1,
            self.places()[1].2
        )
    }
}

/// True if `o` is too large for rounding alone at a pose that rounding has moved off its dead
/// centre.
fn huge(o: &Outcome) -> bool {
    number(o.value()).abs() > 1e4
}

#[test]
fn random_crank_rockers_at_their_limits() {
    let (mut dead, mut near, mut tried) = (0, 0, 0);
    for seed in seeds(1500) {
        let Some(m) = CrankRocker::random(seed) else { continue };
        tried += 1;
        let turn = if m.sense > 0.0 { m.angle() } else { m.angle() + std::f64::consts::PI };
        let crank =
            format!(r#""driver": {{"link": "1", "angle": "{turn:?} rad", "omega": "1 rad/s"}}"#);
        let rocker_line = Vec2::new(m.places()[2].1 - m.ground, m.places()[2].2);
        let rocker = format!(
            r#""driver": {{"link": "3", "angle": "{:?} rad", "omega": "1 rad/s"}}"#,
            rocker_line.angle()
        );
        let coordinates = |driver: String| {
            scene_in(FRAMES[1], FOUR_BAR, &m.places(), &format!("{driver}, {RATES}"))
        };
        for text in [m.by_lengths(&crank), coordinates(drive(1, 1.0, 0.0))] {
            let (_, done, _) = run(&text).unwrap_or_else(|e| panic!("seed {seed}: {e}\n{text}"));
            let (omega, alpha) =
                (number(done.results[2].computed), number(done.results[5].value()));
            assert!(omega.abs() < 1e-13, "seed {seed}: omega_3 is {omega:e} at the limit\n{text}");
            assert!(
                close(alpha, m.alpha(), m.alpha().abs() * 10.0),
                "seed {seed}: alpha_3 is {alpha:e}, not {:e}\n{text}",
                m.alpha()
            );
        }
        for text in [m.by_lengths(&rocker), coordinates(drive(3, 1.0, 0.0))] {
            match run(&text) {
                Ok((_, done, notes)) => {
                    near += 1;
                    let finite = |v: AnswerValue| number(v).is_finite();
                    assert!(
                        done.results.iter().all(|o| finite(o.value()) && finite(o.computed)),
                        "seed {seed}\n{text}"
                    );
                    let warned = notes.iter().any(|d| d.code == "near-singular");
                    assert!(
                        warned || !done.results.iter().any(huge),
                        "seed {seed}: {:?}\n{text}",
                        done.results
                    );
                }
                Err(e) => {
                    dead += 1;
                    let said = e.list.iter().all(|d| {
                        d.code == "dead-centre"
                            && d.message.en.contains("link 1 (AB) and link 2 (BC) lie in line")
                    });
                    assert!(said, "seed {seed}: {e}\n{text}");
                }
            }
        }
    }
    println!(
        "{tried} crank-rockers at a limit; driven by the rocker: {dead} dead points, {near} answered with a warning"
    );
}
