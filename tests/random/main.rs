//! Random mechanisms and hostile input: properties of every scene, not only of chosen ones.
//!
//! Seeds are fixed, so that every run gives the same result. For a longer search,
//! `HODOGRAPH_SEEDS=100 cargo test --test random -- --nocapture` takes a hundred times as many.
//! Without it and without `HODOGRAPH_WIDE=1`, a part of them is taken.

mod asked;
mod bad;
mod cam_digits;
mod cam_laws;
mod cam_truth;
mod cam_turn_digits;
mod cams;
mod centres;
mod compared;
mod composite;
mod dead;
mod digits;
mod emit;
mod forces;
mod free_bodies;
mod groups;
mod grown;
mod higher;
mod hostile;
mod invariance;
mod kept;
mod later;
mod long;
mod mech;
mod near_singular;
mod numbers;
mod pose_digits;
mod poses;
mod properties;
mod readings;
mod regressions;
mod rng;
mod rolling;
mod singular;
mod speeds;
mod step_numbers;
mod synth_digits;
mod synth_truth;
mod wheel_digits;
mod wheel_truth;
#[path = "../wide/mod.rs"]
mod wide;
