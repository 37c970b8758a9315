//! Numbers of teeth for a ratio.

use super::{hodograph, text};
use serde_json::Value as Json;

fn found(args: &[&str]) -> Json {
    let run = hodograph().arg("teeth").args(args).args(["--json", "--count", "5000"]).assert();
    serde_json::from_slice(&run.success().get_output().stdout).unwrap()
}

/// inv α = tan α − α.
fn inv(a: f64) -> f64 {
    a.tan() - a
}

/// All pairs are those of a search through every pair of numbers: ratio, and a helix angle or a sum
/// of shifts within limits; each fits its distance by the equation of textbooks.
#[test]
fn every_pair_for_a_distance_is_found_and_fits_it() {
    let (distance, module, ratio) = (0.150, 2.5e-3, 3.15);
    let table = found(&["--ratio", "3.15", "--distance", "150mm", "--module", "2.5"]);
    let pairs = table["pairs"].as_array().unwrap();
    let alpha = 20.0_f64.to_radians();
    let mut wanted = [0, 0];
    for z1 in 17..=120 {
        for z2 in 17..=120 {
            if ((f64::from(z2) / f64::from(z1)) / ratio - 1.0_f64).abs() > 0.01 {
                continue;
            }
            let sum = f64::from(z1 + z2);
            let own = 0.5 * module * sum;
            if (8.0..=20.0).contains(&(own / distance).acos().to_degrees()) {
                wanted[0] += 1;
            }
            let operating = (own * alpha.cos() / distance).acos();
            let x = sum * (inv(operating) - inv(alpha)) / (2.0 * alpha.tan());
            if (-0.5..=1.5).contains(&x) {
                wanted[1] += 1;
            }
        }
    }
    let helical = pairs.iter().filter(|p| p["drive"] == "helical").count();
    assert_eq!([helical, pairs.len() - helical], wanted, "{table}");
    assert!(wanted[0] > 0 && wanted[1] > 0);
    for p in pairs {
        let [z1, z2] = [0, 1].map(|k| p["teeth"][k].as_f64().unwrap());
        let own = 0.5 * module * (z1 + z2);
        if let Some(beta) = p["helix_angle"].as_f64() {
            assert!((own / beta.cos() - distance).abs() < 1e-12);
            continue;
        }
        let (x, at) =
            (p["sum_of_shifts"].as_f64().unwrap(), p["operating_pressure_angle"].as_f64().unwrap());
        assert!((own * alpha.cos() / at.cos() - distance).abs() < 1e-12);
        let kind = match x {
            x if x > 1e-12 => "positive drive",
            x if x < -1e-12 => "negative drive",
            _ => "standard gears",
        };
        assert_eq!(p["drive"], kind);
    }
}

/// The textbook pair z = 24, 76 of module 3 has its standard distance of 150 mm.
#[test]
fn a_pair_at_its_standard_distance_has_no_shifts() {
    let args = ["--ratio", "76/24", "--distance", "150mm", "--module", "3", "--within", "0"];
    let table = found(&args);
    let pair = table["pairs"].as_array().unwrap().iter().find(|p| p["teeth"][0] == 24).unwrap();
    assert!(pair["drive"] == "standard gears" && pair["sum_of_shifts"] == 0.0, "{pair}");
    // ε = [z₁(tan α_a1 − tan α) + z₂(tan α_a2 − tan α)]/2π.
    let alpha = 20.0_f64.to_radians();
    let part = |z: f64| z * ((z * alpha.cos() / (z + 2.0)).acos().tan() - alpha.tan());
    let wanted = (part(24.0) + part(76.0)) / std::f64::consts::TAU;
    assert!((pair["contact_ratio"].as_f64().unwrap() - wanted).abs() < 1e-9, "{pair}");
}

/// Three stages of a press: the product of the ratios is the total one, and the shares fall by the
/// factor.
#[test]
fn the_ratios_of_the_stages_make_the_total_ratio() {
    let table = found(&["--ratio", "31.5", "--stages", "3", "--taper", "1.25"]);
    let shares: Vec<f64> =
        table["shares"].as_array().unwrap().iter().map(|s| s.as_f64().unwrap()).collect();
    assert!((shares.iter().product::<f64>() / 31.5 - 1.0).abs() < 1e-12);
    assert!(shares.windows(2).all(|w| (w[0] / w[1] - 1.25).abs() < 1e-12), "{shares:?}");
    let trains = table["trains"].as_array().unwrap();
    assert!(!trains.is_empty());
    let mut before = 0.0;
    for train in trains {
        let stage = |k: usize| {
            let [a, b] = [0, 1].map(|i| train["teeth"][k][i].as_u64().unwrap());
            assert!((17..=120).contains(&a) && (17..=120).contains(&b));
            b as f64 / a as f64
        };
        let ratios = [0, 1, 2].map(stage);
        assert!(
            ratios.iter().zip(&shares).all(|(i, share)| (i / share - 1.0).abs() <= 0.05 + 1e-9)
        );
        let off = (ratios.iter().product::<f64>() / 31.5 - 1.0).abs();
        assert!(off <= 0.01 && off >= before - 1e-9, "the best come first");
        before = off;
    }
    assert!((trains[0]["ratio"].as_f64().unwrap() / 31.5 - 1.0).abs() < 1e-4);
}

#[test]
fn both_languages_name_the_kind_of_drive_and_wrong_values_are_refused() {
    let args = ["teeth", "--ratio", "3", "--distance", "150mm", "--module", "2.5"];
    for (lang, word) in [("en", "helical"), ("zh", "斜齿轮传动")] {
        let run = hodograph().args(args).args(["--lang", lang]).assert().success();
        assert!(text(&run.get_output().stdout).contains(word));
    }
    for wrong in [
        ["--ratio", "3", "--stages", "5"],
        ["--stages=2", "--ratio=3", "--taper", "2.1"],
        ["--ratio", "0.5", "--stages", "2"],
        ["--ratio", "3", "--teeth", "9..3"],
        ["--ratio", "3", "--within", "50%"],
        ["--ratio", "3", "--module", "0"],
    ] {
        let run = hodograph().arg("teeth").args(wrong).args(["--errors", "json"]).assert();
        run.code(2);
    }
}
