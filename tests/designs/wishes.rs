//! Tasks of the other kinds from random linkages: presses, shapers, cognates, straight lines. Their
//! motion is calculated here with angles and roots alone.

use crate::{Mixed, crank_rocker, design, found, is, mm};
use serde_json::json;
use std::f64::consts::PI;

#[test]
fn presses_are_found_from_their_limits() {
    let mut r = Mixed(41);
    let mut seen = 0;
    while seen < 15 {
        let (p, q) = (r.between(0.9, 1.4), r.between(1.7, 2.3));
        let (de, ce_cd, ef_de) =
            (r.between(100.0, 200.0), r.between(0.3, 1.2), r.between(0.3, 0.8));
        let (x1, y) = (r.between(20.0, 80.0), r.between(180.0, 320.0));
        let x2 = de * r.between(0.85, 1.0);
        // Limits count from the upward vertical, clockwise; F hangs below E on the line x = x2.
        let ram = |angle: f64| {
            let aside = x2 - de * angle.sin();
            de * angle.cos() - ((ef_de * de).powi(2) - aside * aside).sqrt()
        };
        let stroke = ram(p) - ram(q);
        let cd = de / (1.0 + ce_cd);
        let far = [p, q].map(|a| (cd * a.sin() - x1).hypot(cd * a.cos() + y));
        let (ab, bc) = ((far[0] - far[1]) / 2.0, (far[0] + far[1]) / 2.0);
        let frame = x1.hypot(y);
        let longest = bc.max(cd).max(frame);
        if stroke.is_nan()
            || ab < 5.0
            || ab + longest > (ab + bc + cd + frame) / 2.0 * 0.98
            || ab > bc.min(cd).min(frame)
        {
            continue;
        }
        let task = json!({"synthesis": "limits", "linkage": "press", "x1": mm(x1), "x2": mm(x2), "y": mm(y), "stroke": mm(stroke),
            "angles": [format!("{p} rad"), format!("{q} rad")], "CE/CD": ce_cd, "EF/DE": ef_de});
        found(&task, &[("AB", ab), ("BC", bc), ("CD", cd), ("DE", de), ("EF", ef_de * de)]);
        seen += 1;
    }
}

#[test]
fn shapers_are_found_from_their_time_ratio() {
    let mut r = Mixed(42);
    for _ in 0..15 {
        let crank = r.between(40.0, 120.0);
        let frame = crank * r.between(1.5, 4.0);
        let half = (crank / frame).asin();
        let lever = frame * r.between(1.6, 2.2);
        let link = lever * r.between(0.2, 0.6);
        // The guide halves the rise of D's arc.
        let height = lever * (1.0 + half.cos()) / 2.0;
        let task = json!({"synthesis": "time-ratio", "linkage": "shaper", "K": (PI + 2.0 * half) / (PI - 2.0 * half),
            "stroke": mm(2.0 * lever * half.sin()), "link": mm(link), "crank": mm(crank)});
        found(&task, &[("AB", crank), ("AC", frame), ("CD", lever), ("DE", link), ("y", height)]);
    }
}

#[test]
fn cognates_have_the_lengths_of_similar_triangles() {
    let mut r = Mixed(43);
    for _ in 0..15 {
        let [a, b, c, d] = crank_rocker(&mut r);
        let (u, v) = (b * r.between(0.1, 0.9), b * r.between(0.2, 0.8));
        let (be, ce) = (u.hypot(v), (b - u).hypot(v));
        let scene = json!({"links": {"1": ["A", "B"], "2": ["B", "C", "E"], "3": ["C", "D"], "4": ["A", "D"]}, "ground": "4",
            "lengths": {"AB": mm(a), "BC": mm(b), "CD": mm(c), "AD": mm(d), "BE": mm(be), "CE": mm(ce)},
            "driver": {"link": "1", "angle": "80 deg", "omega": "10 rad/s"}});
        let design = design(&json!({"synthesis": "cognates", "scene": scene, "point": "E"}));
        assert_eq!(design.candidates.len(), 3);
        let (left, right) = (be / b, ce / b);
        for lengths in [
            [a, b, c, d],
            [b * left, a * left, c * left, d * left],
            [a * right, c * right, b * right, d * right],
        ] {
            let names = ["AB", "BC", "CD", "AD"];
            let wanted: Vec<(&str, f64)> = names.into_iter().zip(lengths).collect();
            assert!(design.candidates.iter().any(|c| is(c, &wanted)), "{scene}: {wanted:?}");
        }
        // All trace one curve wherever their drivers reach: E is where the given linkage has it.
        for c in &design.candidates {
            assert!(
                c.judged.off_m <= 1e-12 * c.judged.size_m,
                "{scene}: {} of {}",
                c.judged.off_m,
                c.judged.size_m
            );
        }
    }
}

#[test]
fn straight_lines_are_as_long_as_their_linkage_makes_them() {
    let mut r = Mixed(44);
    for _ in 0..12 {
        let k = r.between(20.0, 80.0);
        // Hoeken's: BE twice the rod; E is along BC from B, C where the rods cross the frame's
        // bisector of BD.
        let rod = r.between(2.3, 4.0);
        let frame = r.between(1.6, (2.0 * rod - 1.0).min(3.0));
        let e = |angle: f64| {
            let (x, y) = (frame - angle.cos(), -angle.sin());
            let l = x.hypot(y);
            let high = (rod * rod - l * l / 4.0).sqrt();
            // BE = 2 BC, and C is left of BD where the crank points away from D.
            angle.cos() + x - 2.0 * high * y / l
        };
        let length = (e(PI / 2.0) - e(3.0 * PI / 2.0)).abs() * k;
        let task = json!({"synthesis": "straight-line", "linkage": "hoeken", "length": mm(length), "ratios": [frame, rod]});
        found(&task, &[("AB", k), ("BC", rod * k), ("AD", frame * k)]);
        let half = r.between(0.2, 0.9);
        let of = |linkage: &str, length: f64| json!({"synthesis": "straight-line", "linkage": linkage, "length": mm(length), "swing": format!("{} rad", 2.0 * half)});
        found(&of("scott-russell", 4.0 * half.sin() * k), &[("AB", k), ("CE", 2.0 * k)]);
        // OC · OE = 6² − 2.5², C on the circle about K through O.
        let reach = 29.75 * 2.0 * half.sin() / (8.0 * (1.0 + half.cos()));
        found(
            &of("peaucellier", 2.0 * reach * k),
            &[("KC", 2.0 * k), ("OX", 6.0 * k), ("CX", 2.5 * k)],
        );
        let chebyshev = design(
            &json!({"synthesis": "straight-line", "linkage": "chebyshev", "length": mm(4.0 * k)}),
        )
        .candidates
        .remove(0);
        assert!(is(&chebyshev, &[("AB", 5.0 * k), ("AD", 4.0 * k)]));
        // Its line ends in dead centres, next to which half of the digits remain.
        assert!(chebyshev.judged.off_m <= 1e-9 * chebyshev.judged.size_m);
    }
}
