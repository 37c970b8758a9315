//! Where a follower is beyond the instant that moves with other links than its cam.
//!
//! It follows from the whole mechanism and not from one angle, so this room cannot tell it: who can move mechanisms hands in a [`Course`], and from then
//! on the follower is a driver of its own like any other that a cam leads.

use std::fmt;
use std::sync::Arc;

/// A follower as its cam leads it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Led {
    /// The coordinate of the driver that stands for the contact, and its first two derivatives by the time (SI).
    pub place: [f64; 3],
    /// The piece that is touched.
    pub piece: usize,
}

/// Knows where a cam leads its follower.
pub trait Leads: Send + Sync {
    /// The follower where the drivers stand, as fast as they move (position, rate, acceleration of each, SI); `None` where it cannot be followed.
    fn led(&self, drivers: &[[f64; 3]]) -> Option<Led>;
}

/// One that is shared by all copies of a scene.
#[derive(Clone)]
pub struct Course(pub Arc<dyn Leads>);

impl fmt::Debug for Course {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Course")
    }
}

/// The same one.
impl PartialEq for Course {
    fn eq(&self, other: &Course) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}
