//! Every printed digit of gear trains, belts and rolling wheels is true: compared with ratios of
//! teeth, intersections of circles and lines and differences of these in 640-bit arithmetic
//! ([`crate::wheel_truth`]).

use crate::compared::{Compared, by_text};
use crate::properties::seeds;
use crate::rng::Rng;
use crate::wheel_truth::{Told, drawn, in_a_row, planetary};
use crate::wide::every;
use hodograph::number::within;
use hodograph::scene::read;
use hodograph::worked::{Scope, work};

/// The error of the true value, relative to it.
const OFF: f64 = 1e-60;

fn compare(what: &str, own: u64, least: usize, make: impl Fn(&mut Rng) -> Told) {
    let (mut all, mut refused) = (Compared::default(), Vec::new());
    for seed in seeds(own) {
        let told = within(128, || make(&mut Rng::new(seed + 31)));
        let scene = match read(&told.text) {
            Ok(scene) => scene.value,
            Err(f) => panic!("{what} {seed}: {f}\n{}", told.text),
        };
        match work(&scene, Scope::Questions) {
            Ok(worked) => all.scene(&format!("{what} {seed}"), &scene, &worked.value, OFF, || {
                by_text(&scene, &(told.truth)())
            }),
            Err(f) => refused.push(format!("{what} {seed}: {f}\n{}", told.text)),
        }
    }
    assert!(refused.len() * 10 <= all.scenes, "{} refused, first {}", refused.len(), refused[0]);
    all.done(what, least);
}

#[test]
fn printed_digits_are_true_of_planetary_gears() {
    compare("planetary gears", 40, 600 / every(8), planetary);
}

#[test]
fn printed_digits_are_true_of_wheels_in_a_row() {
    compare("wheels in a row", 40, 600 / every(8), in_a_row);
}

#[test]
fn printed_digits_are_true_of_rolling_wheels() {
    compare("rolling wheels", 40, 600 / every(8), drawn);
}
