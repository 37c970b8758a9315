//! Random tasks of synthesis, and their numbers by closed formulas of this file in long numbers:
//! circles through three places, linear equations by determinants, arcs with an inscribed angle,
//! similar triangles.

use crate::cam_truth::{Number, whole};
use crate::rng::Rng;
use hodograph::geom::{Vec2, cross_lines};
use hodograph::number::{Big, Real};

type V = Vec2<Big>;

/// The numbers of one candidate by name, lengths in metres and angles in radians.
pub type Numbers = Vec<(String, Big)>;

/// A task, and the numbers of all its candidates, in a region of long numbers.
pub struct Task {
    pub text: String,
    pub truth: Box<dyn Fn() -> Vec<Numbers>>,
}

fn named(list: &[(&str, Big)]) -> Numbers {
    list.iter().map(|(name, x)| ((*name).to_owned(), *x)).collect()
}

fn place(name: &str, at: V) -> [(String, Big); 2] {
    [(format!("{name}_x"), at.x), (format!("{name}_y"), at.y)]
}

fn absolute(x: Big) -> Big {
    if x.approx() < 0.0 { -x } else { x }
}

fn half(x: Big) -> Big {
    x / whole(2)
}

/// The centre of the circle through three places.
fn centre([a, b, c]: [V; 3]) -> V {
    let (p, q) = (a - b, c - b);
    b + (p.perp() * q.norm2() - q.perp() * p.norm2()) * (whole(1) / (whole(2) * p.cross(q)))
}

/// Both intersections of two circles.
fn crossings(a: V, ra: Big, b: V, rb: Big) -> [V; 2] {
    let way = b - a;
    let d = way.norm();
    let foot = half((d * d + ra * ra - rb * rb) / d);
    let height = (ra * ra - foot * foot).sqrt();
    let u = way * (whole(1) / d);
    [height, -height].map(|h| a + u * foot + u.perp() * h)
}

/// A position of a body: its origin and its direction.
#[derive(Clone, Copy)]
struct Position(V, V);

impl Position {
    fn out(self, local: V) -> V {
        self.0 + local.rotate_by(self.1)
    }

    fn back(self, at: V) -> V {
        (at - self.0).divide_by(self.1)
    }

    /// The pole of the rotation to another position.
    fn pole(self, to: Position) -> V {
        let own = -(to.0 - self.0).divide_by(to.1 - self.1);
        self.out(own)
    }
}

/// The lengths of a four-bar linkage ABCD.
fn four_bar(a: V, b: V, c: V, d: V) -> Numbers {
    named(&[
        ("AB", (b - a).norm()),
        ("BC", (c - b).norm()),
        ("CD", (d - c).norm()),
        ("AD", (d - a).norm()),
    ])
}

fn pair(rng: &mut Rng, [x, y]: [[f64; 2]; 2]) -> [Number; 2] {
    [Number::of(rng, x[0], x[1]), Number::of(rng, y[0], y[1])]
}

fn at(p: &[Number; 2]) -> V {
    V::new(p[0].metres(), p[1].metres())
}

fn mm(p: &[Number; 2]) -> String {
    format!(r#"["{} mm", "{} mm"]"#, p[0].0, p[1].0)
}

/// Three positions of a coupler, with its pins or its pivots given.
pub fn body(rng: &mut Rng) -> Task {
    let ranges =
        [[[-5.0, 5.0], [-5.0, 5.0]], [[30.0, 70.0], [15.0, 45.0]], [[70.0, 120.0], [60.0, 110.0]]];
    let origins = ranges.map(|r| pair(rng, r));
    let angles = [[0.0, 10.0], [20.0, 45.0], [55.0, 95.0]].map(|r| Number::of(rng, r[0], r[1]));
    let moving = rng.chance(0.5);
    let pins = match moving {
        true => {
            [pair(rng, [[-20.0, 10.0], [-10.0, 20.0]]), pair(rng, [[40.0, 80.0], [-20.0, 30.0]])]
        }
        false => {
            [pair(rng, [[-40.0, -10.0], [40.0, 70.0]]), pair(rng, [[60.0, 90.0], [-50.0, -20.0]])]
        }
    };
    let rows: Vec<String> = origins
        .iter()
        .zip(&angles)
        .map(|(o, a)| format!(r#"["{} mm", "{} mm", "{} deg"]"#, o[0].0, o[1].0, a.0))
        .collect();
    let keys = if moving { ["moving", "B", "C"] } else { ["ground", "A", "D"] };
    let text = format!(
        r#"{{"synthesis": "body", "positions": [{}], "{}": {{"{}": {}, "{}": {}}}}}"#,
        rows.join(", "),
        keys[0],
        keys[1],
        mm(&pins[0]),
        keys[2],
        mm(&pins[1])
    );
    let truth = move || {
        let all =
            [0, 1, 2].map(|k| Position(at(&origins[k]), Vec2::from_angle(angles[k].radians())));
        let given = pins.each_ref().map(at);
        let [[a, d], [b, c]] = match moving {
            true => [given.map(|p| centre(all.map(|s| s.out(p)))), given.map(|p| all[0].out(p))],
            false => [given, given.map(|p| all[0].out(centre(all.map(|s| s.back(p)))))],
        };
        let mut numbers = four_bar(a, b, c, d);
        for (name, at) in [("A", a), ("B1", b), ("C1", c), ("D", d)] {
            numbers.extend(place(name, at));
        }
        for (name, [i, j]) in [("P12", [0, 1]), ("P13", [0, 2]), ("P23", [1, 2])] {
            numbers.extend(place(name, all[i].pole(all[j])));
        }
        vec![numbers]
    };
    Task { text, truth: Box::new(truth) }
}

/// A coupler point through three places.
pub fn path(rng: &mut Rng) -> Task {
    let ranges = [
        [[120.0, 145.0], [200.0, 220.0]],
        [[60.0, 90.0], [200.0, 215.0]],
        [[0.0, 20.0], [140.0, 160.0]],
    ];
    let points = ranges.map(|r| pair(rng, r));
    let (frame, crank, arm) = (
        Number::of(rng, 250.0, 330.0),
        Number::of(rng, 90.0, 110.0),
        Number::of(rng, 140.0, 165.0),
    );
    let rows: Vec<String> = points.iter().map(mm).collect();
    let text = format!(
        r#"{{"synthesis": "path", "points": [{}], "ground": {{"A": ["0 mm", "0 mm"], "D": ["{} mm", "0 mm"]}}, "crank": "{} mm", "BE": "{} mm", "side": {{"B": "right of AE"}}}}"#,
        rows.join(", "),
        frame.0,
        crank.0,
        arm.0
    );
    let truth = move || {
        let (a, d) = (V::zero(), V::new(frame.metres(), whole(0)));
        let pins = points.each_ref().map(|e| {
            let e = at(e);
            let right = crossings(a, crank.metres(), e, arm.metres())[1];
            Position(right, (e - right) * (whole(1) / arm.metres()))
        });
        let (b, c) = (pins[0].0, pins[0].out(centre(pins.map(|s| s.back(d)))));
        let mut numbers = four_bar(a, b, c, d);
        numbers.extend(named(&[("BE", arm.metres()), ("CE", (at(&points[0]) - c).norm())]));
        numbers.extend(place("B1", b).into_iter().chain(place("C1", c)));
        numbers.extend((1..4).map(|k| (format!("crank_{k}"), pins[k - 1].0.angle())));
        vec![numbers]
    };
    Task { text, truth: Box::new(truth) }
}

/// Three pairs of angles, the starting angles given.
pub fn function(rng: &mut Rng) -> Task {
    let [a, b] = [[20.0, 60.0], [30.0, 90.0]].map(|r| Number::of(rng, r[0], r[1]));
    let steps: Vec<[f64; 2]> =
        (0..2).map(|_| [rng.between(10.0, 40.0), rng.between(8.0, 35.0)]).collect();
    let told = |x: f64| Number(format!("{x:.3}"));
    let (p, q) = (a.approx() + steps[0][0], b.approx() + steps[0][1]);
    let pairs = [[a, b], [told(p), told(q)], [told(p + steps[1][0]), told(q + steps[1][1])]];
    let frame = Number::of(rng, 80.0, 300.0);
    let rows: Vec<String> =
        pairs.iter().map(|[a, b]| format!(r#"["{} deg", "{} deg"]"#, a.0, b.0)).collect();
    let text = format!(
        r#"{{"synthesis": "function", "pairs": [{}], "frame": "{} mm"}}"#,
        rows.join(", "),
        frame.0
    );
    let truth = move || {
        // K₁ cos ψ − K₂ cos θ + K₃ = cos(θ − ψ).
        let rows = pairs.each_ref().map(|[t, p]| {
            let (t, p) = (t.radians(), p.radians());
            [p.sin_cos().1, -t.sin_cos().1, whole(1), (t - p).sin_cos().1]
        });
        let determinant = |c: [usize; 3]| {
            let m = |i: usize, j: usize| rows[i][c[j]];
            m(0, 0) * (m(1, 1) * m(2, 2) - m(1, 2) * m(2, 1))
                - m(0, 1) * (m(1, 0) * m(2, 2) - m(1, 2) * m(2, 0))
                + m(0, 2) * (m(1, 0) * m(2, 1) - m(1, 1) * m(2, 0))
        };
        let whole_of = determinant([0, 1, 2]);
        let [k1, k2, k3] = [[3, 1, 2], [0, 3, 2], [0, 1, 3]].map(|c| determinant(c) / whole_of);
        let d = frame.metres();
        let (a, c) = (d / k1, d / k2);
        let b = (a * a + c * c + d * d - whole(2) * a * c * k3).sqrt();
        vec![named(&[
            ("K1", k1),
            ("K2", k2),
            ("K3", k3),
            ("AB", absolute(a)),
            ("BC", b),
            ("CD", absolute(c)),
            ("AD", d),
        ])]
    };
    Task { text, truth: Box::new(truth) }
}

/// The cognates of a four-bar linkage, by similar triangles.
pub fn cognates(rng: &mut Rng) -> Task {
    let [ab, bc, cd, ad] = [[60.0, 100.0], [220.0, 260.0], [180.0, 210.0], [250.0, 300.0]]
        .map(|r| Number::of(rng, r[0], r[1]));
    let [be, ce] = [[130.0, 190.0], [120.0, 180.0]].map(|r| Number::of(rng, r[0], r[1]));
    let text = format!(
        r#"{{"synthesis": "cognates", "scene": {{"links": {{"1": ["A","B"], "2": ["B","C","E"], "3": ["C","D"], "4": ["A","D"]}}, "ground": "4",
        "lengths": {{"AB": "{} mm", "BC": "{} mm", "CD": "{} mm", "AD": "{} mm", "BE": "{} mm", "CE": "{} mm"}},
        "driver": {{"link": "1", "angle": "60 deg", "omega": "10 rad/s"}}}}, "point": "E"}}"#,
        ab.0, bc.0, cd.0, ad.0, be.0, ce.0
    );
    let truth = move || {
        let [a, b, c, d, e, f] = [&ab, &bc, &cd, &ad, &be, &ce].map(Number::metres);
        let lengths = |l: [Big; 6]| {
            ["AB", "BC", "CD", "AD", "BE", "CE"]
                .iter()
                .map(|n| (*n).to_owned())
                .zip(l)
                .collect::<Numbers>()
        };
        let (left, right) = (e / b, f / b);
        vec![
            lengths([a, b, c, d, e, f]),
            lengths([a * right, c * right, f, d * right, c * left, c]),
            lengths([e, a * left, c * left, d * left, a, a * right]),
        ]
    };
    Task { text, truth: Box::new(truth) }
}

/// θ of a time ratio.
fn theta(k: &Number) -> Big {
    Big::pi() * (k.exact() - whole(1)) / (k.exact() + whole(1))
}

/// A crank-rocker by its time ratio, the frame and one limit of the rocker, or its swing.
pub fn crank_rocker(rng: &mut Rng) -> Task {
    let k = Number(format!("1.{:03}", 40 + rng.below(200)));
    let rocker = Number::of(rng, 60.0, 80.0);
    let by_limit = rng.chance(0.5);
    let (frame, angle) = match by_limit {
        true => (Number::of(rng, 95.0, 120.0), Number::of(rng, 30.0, 60.0)),
        false => (Number::of(rng, 85.0, 110.0), Number::of(rng, 35.0, 55.0)),
    };
    let key = if by_limit { "limit" } else { "swing" };
    let text = format!(
        r#"{{"synthesis": "time-ratio", "linkage": "crank-rocker", "K": {}, "rocker": "{} mm", "frame": "{} mm", "{key}": "{} deg"}}"#,
        k.0, rocker.0, frame.0, angle.0
    );
    let truth = move || {
        let (theta, c, d, angle) = (theta(&k), rocker.metres(), frame.metres(), angle.radians());
        let linkage = |a: V, at: V, ends: [V; 2]| {
            let [p, q] = ends.map(|e| (e - a).norm());
            let (u, w) = (ends[0] - at, ends[1] - at);
            let swing = absolute(u.cross(w).atan2(u.dot(w)));
            named(&[
                ("AB", half(absolute(p - q))),
                ("BC", half(p + q)),
                ("CD", c),
                ("AD", d),
                ("theta", theta),
                ("psi", swing),
            ])
        };
        if by_limit {
            let a = V::zero();
            let pivot = V::new(d, whole(0));
            let first = pivot + Vec2::from_angle(Big::pi() - angle) * c;
            // C₂ is on the ray AC₁ turned by θ either way, at both intersections with the rocker's
            // circle.
            let rays = [theta, -theta]
                .map(|t| first.rotate_by(Vec2::from_angle(t)) * (whole(1) / first.norm()));
            let on = |u: V| {
                let (along, aside) = (pivot.dot(u), pivot.cross(u));
                let room = c * c - aside * aside;
                let h = if room.approx() > 0.0 { Some(room.sqrt()) } else { None };
                h.into_iter()
                    .flat_map(move |h| [along + h, along - h])
                    .map(move |s| u * s)
                    .collect::<Vec<_>>()
            };
            return rays
                .into_iter()
                .flat_map(on)
                .map(|second| linkage(a, pivot, [first, second]))
                .collect();
        }
        let up = |turn: Big| Vec2::from_angle(half(Big::pi()) + turn) * c;
        let ends = [up(half(angle)), up(-half(angle))];
        let (s, co) = half(angle).sin_cos();
        let radius = c * s / theta.sin_cos().0;
        let off = radius * theta.sin_cos().1;
        // A sees both ends under θ: it is on an arc about a point of the middle line, on either
        // side of the chord.
        let middles = [c * co + off, c * co - off].map(|y| V::new(whole(0), y));
        let all = middles.into_iter().flat_map(|m| crossings(m, radius, V::zero(), d));
        all.filter(|a| a.x.approx().is_finite()).map(|a| linkage(a, V::zero(), ends)).collect()
    };
    Task { text, truth: Box::new(truth) }
}

/// The quick-return linkages with textbook formulas: slider-crank, slotted lever, shaper,
/// Whitworth; and the press by the limits of its rocker.
pub fn quick_return(rng: &mut Rng) -> Task {
    let k = Number(format!("1.{:03}", 100 + rng.below(850)));
    let kind = rng.below(5);
    let [crank, stroke] = [Number::of(rng, 40.0, 90.0), Number::of(rng, 200.0, 300.0)];
    let text = match kind {
        0 => {
            let k = &k.0;
            format!(
                r#"{{"synthesis": "time-ratio", "linkage": "slider-crank", "K": {k}, "stroke": "{} mm", "offset": "{} mm"}}"#,
                stroke.0, crank.0
            )
        }
        1 => format!(
            r#"{{"synthesis": "time-ratio", "linkage": "slotted-lever", "K": {}, "crank": "{} mm"}}"#,
            k.0, crank.0
        ),
        2 => format!(
            r#"{{"synthesis": "time-ratio", "linkage": "shaper", "K": {}, "crank": "{} mm", "link": "150 mm", "stroke": "{} mm"}}"#,
            k.0, crank.0, stroke.0
        ),
        3 => format!(
            r#"{{"synthesis": "time-ratio", "linkage": "whitworth", "K": {}, "crank": "{} mm", "stroke": "{} mm"}}"#,
            k.0, crank.0, stroke.0
        ),
        _ => format!(
            r#"{{"synthesis": "limits", "linkage": "press", "x1": "{} mm", "x2": "140 mm", "y": "{} mm", "angles": ["60 deg", "120 deg"], "stroke": "150 mm", "CE/CD": "1/2", "EF/DE": "1/4"}}"#,
            crank.0, stroke.0
        ),
    };
    let truth = move || {
        let (theta, crank, stroke) = (theta(&k), crank.metres(), stroke.metres());
        let (s, c) = theta.sin_cos();
        let (hs, hc) = half(theta).sin_cos();
        vec![match kind {
            0 => {
                let difference = stroke * crank / s;
                let sum = half(stroke * stroke) + difference * c / whole(1);
                named(&[
                    ("AB", half(sum - difference).sqrt()),
                    ("BC", half(sum + difference).sqrt()),
                    ("theta", theta),
                ])
            }
            1 => named(&[("AB", crank), ("AC", crank / hs), ("theta", theta)]),
            2 => {
                let lever = half(stroke) / hs;
                named(&[
                    ("AC", crank / hs),
                    ("CD", lever),
                    ("y", half(lever * (whole(1) + hc))),
                    ("theta", theta),
                ])
            }
            3 => {
                let back = whole(2) * Big::pi() / (k.exact() + whole(1));
                named(&[
                    ("alpha_return", back),
                    ("AC", crank * half(back).sin_cos().1),
                    ("CD", half(stroke)),
                ])
            }
            _ => {
                let (cd, de) = (whole(1) / whole(10), whole(15) / whole(100));
                let a = V::new(crank, stroke);
                let turn = Big::pi() / whole(3);
                let ends =
                    [turn, whole(2) * turn].map(|b| V::new(b.sin_cos().0, b.sin_cos().1) * cd - a);
                let [p, q] = ends.map(Vec2::norm);
                let theta = absolute(ends[0].cross(ends[1]).atan2(ends[0].dot(ends[1])));
                let ratio = (Big::pi() + theta) / (Big::pi() - theta);
                let bars = [
                    ("AB", half(absolute(p - q))),
                    ("BC", half(p + q)),
                    ("CD", cd),
                    ("DE", de),
                    ("theta", theta),
                    ("K", ratio),
                ];
                named(&bars)
            }
        }]
    };
    Task { text, truth: Box::new(truth) }
}

/// Two positions of a coupler with its pins, and a line for each pivot: the pivot is where it
/// intersects the middle line of the pin's two places.
pub fn two_positions(rng: &mut Rng) -> Task {
    let origins = [pair(rng, [[-5.0, 5.0], [-5.0, 5.0]]), pair(rng, [[30.0, 60.0], [15.0, 45.0]])];
    let angles = [[0.0, 10.0], [25.0, 45.0]].map(|r| Number::of(rng, r[0], r[1]));
    let pins = [pair(rng, [[-20.0, 0.0], [0.0, 15.0]]), pair(rng, [[45.0, 70.0], [10.0, 30.0]])];
    let low = Number::of(rng, -40.0, -15.0);
    let rows: Vec<String> = origins
        .iter()
        .zip(&angles)
        .map(|(o, a)| format!(r#"["{} mm", "{} mm", "{} deg"]"#, o[0].0, o[1].0, a.0))
        .collect();
    let text = format!(
        r#"{{"synthesis": "body", "positions": [{}], "moving": {{"B": {}, "C": {}}}, "line": {{"through": ["0 mm", "{} mm"]}}}}"#,
        rows.join(", "),
        mm(&pins[0]),
        mm(&pins[1]),
        low.0
    );
    let truth = move || {
        let all = [0, 1].map(|k| Position(at(&origins[k]), Vec2::from_angle(angles[k].radians())));
        let pivot = |pin: V| {
            let [p, q] = all.map(|s| s.out(pin));
            let middle = p + (q - p) * (whole(1) / whole(2));
            cross_lines(
                middle.to_point(),
                (q - p).perp(),
                V::new(whole(0), low.metres()).to_point(),
                Vec2::unit_x(),
            )
            .at
            .to_vec2()
        };
        let given = pins.each_ref().map(at);
        let [a, d] = given.map(pivot);
        let [b, c] = given.map(|p| all[0].out(p));
        vec![four_bar(a, b, c, d)]
    };
    Task { text, truth: Box::new(truth) }
}
