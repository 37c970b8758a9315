//! Stub until the real one is merged.

use super::model::{Angle, Given, Scene};
use crate::number::Real;
use std::marker::PhantomData;

/// The given numbers of a scene in numbers of one kind.
#[derive(Clone, Debug)]
pub struct Inputs<'a, N> {
    scene: &'a Scene,
    kind: PhantomData<N>,
}

impl<'a, N: Real> Inputs<'a, N> {
    /// Of a scene.
    pub fn of(scene: &'a Scene) -> Self {
        Inputs { scene, kind: PhantomData }
    }

    /// SI.
    pub fn number(&self, given: &Given) -> N {
        let _ = self.scene;
        N::from_bounded(given.value, 0.0).unwrap_or(N::from_f64(given.value))
    }

    /// Sine and cosine.
    pub fn sin_cos(&self, given: &Given<Angle>) -> (N, N) {
        match given.value {
            Angle::Deg(d) => N::from_f64(d).sin_cos_degrees(),
            Angle::Rad(r) => N::from_f64(r).sin_cos(),
        }
    }
}
