//! The order in which the joints of a linkage are placed with ruler and compasses.

use super::linkage::{Linkage, not_exported};
use crate::diag::{Faults, both};
use crate::geom::{Point, Vec2};

/// The way to place a joint from those placed before.
#[derive(Clone, Debug, PartialEq)]
pub enum PlacingRule {
    /// On the crank, about the pivot.
    Crank,
    /// Fixed to two joints of its link: from the first, these parts of the vector to the second,
    /// along it and to its left.
    Carried {
        /// The two joints.
        base: [usize; 2],
        /// The parts.
        parts: [f64; 2],
    },
    /// At given distances from two joints.
    Circles {
        /// The two joints.
        centres: [usize; 2],
        /// The bodies that keep the distances.
        bodies: [usize; 2],
        /// True if it is to the left of the line from the first to the second.
        left: bool,
    },
    /// On a lever about a joint, with a slot through that joint in which a placed pin runs.
    Slotted {
        /// The joint about which the lever turns.
        pivot: usize,
        /// The pin in the slot.
        pin: usize,
        /// From the pivot, the distances (mm) toward the pin and to its left.
        parts: [f64; 2],
    },
    /// At a given distance from a joint, on a line.
    OnLine {
        /// The joint.
        centre: usize,
        /// The body that keeps the distance.
        body: usize,
        /// The guide.
        slide: usize,
        /// True if it is ahead of the foot of the perpendicular from the joint, in the direction of
        /// the guide.
        ahead: bool,
    },
}

/// A joint with its rule.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedJoint {
    /// The joint.
    pub joint: usize,
    /// Its rule.
    pub rule: PlacingRule,
}

impl PlacedJoint {
    /// Returns the joints from which it is placed.
    pub fn from(&self) -> Vec<usize> {
        match &self.rule {
            PlacingRule::Crank => Vec::new(),
            PlacingRule::Carried { base, .. } => base.to_vec(),
            PlacingRule::Circles { centres, .. } => centres.to_vec(),
            PlacingRule::Slotted { pivot, pin, .. } => vec![*pivot, *pin],
            PlacingRule::OnLine { centre, .. } => vec![*centre],
        }
    }
}

/// Returns the moving joints in the order in which they are placed, each with its rule.
///
/// # Errors
/// `export` if a group needs more than circles and lines on the ground.
pub fn order(linkage: &Linkage) -> Result<Vec<PlacedJoint>, Faults> {
    let at = |j: usize| linkage.joints[j].at;
    let mut known: Vec<bool> = linkage.joints.iter().map(|j| j.fixed).collect();
    let mut all: Vec<PlacedJoint> = Vec::new();
    let tip = linkage.bodies[linkage.crank]
        .joints
        .iter()
        .copied()
        .find(|j| !known[*j] && at(*j) != at(linkage.pivot));
    if let Some(tip) = tip {
        known[tip] = true;
        all.push(PlacedJoint { joint: tip, rule: PlacingRule::Crank });
    }
    loop {
        let unknown = || (0..known.len()).filter(|j| !known[*j]);
        let next = unknown()
            .find_map(|joint| Some((joint, carried(linkage, &known, joint)?)))
            .or_else(|| unknown().find_map(|joint| Some((joint, slotted(linkage, &known, joint)?))))
            .or_else(|| unknown().find_map(|joint| Some((joint, on_line(linkage, &known, joint)?))))
            .or_else(|| {
                unknown().find_map(|joint| Some((joint, circles(linkage, &known, joint)?)))
            });
        match next {
            Some((joint, rule)) => {
                known[joint] = true;
                all.push(PlacedJoint { joint, rule });
            }
            None if known.iter().all(|k| *k) => return Ok(all),
            None => {
                let what = both!(
                    "groups that circles about placed joints and lines on the ground do not place"
                );
                return Err(not_exported(what).into());
            }
        }
    }
}

fn carried(linkage: &Linkage, known: &[bool], joint: usize) -> Option<PlacingRule> {
    let at = |j: usize| linkage.joints[j].at;
    linkage.carriers(joint).find_map(|b| {
        let placed: Vec<usize> =
            linkage.bodies[b].joints.iter().copied().filter(|j| known[*j]).collect();
        let [first, ..] = placed[..] else { return None };
        let second = placed.iter().copied().find(|j| at(*j) != at(first))?;
        let (along, to) = (at(second) - at(first), at(joint) - at(first));
        let size = along.norm2();
        let parts = [along.dot(to) / size, along.cross(to) / size];
        Some(PlacingRule::Carried { base: [first, second], parts })
    })
}

/// Sine of the angle between a slot and the line to the pivot that counts as none: the places have
/// some fourteen digits.
const THROUGH: f64 = 1e-9;

fn slotted(linkage: &Linkage, known: &[bool], joint: usize) -> Option<PlacingRule> {
    let at = |j: usize| linkage.joints[j].at;
    linkage.slides.iter().filter(|s| known[s.joint]).find_map(|slide| {
        let lever = slide.on.filter(|b| linkage.bodies[*b].joints.contains(&joint))?;
        let pivot = linkage.bodies[lever].joints.iter().copied().find(|j| known[*j])?;
        let toward = (at(slide.joint) - at(pivot)).unit()?;
        let to = at(joint) - at(pivot);
        let parts = [toward.dot(to), toward.cross(to)];
        let through = toward.cross(slide.direction).abs() < THROUGH;
        through.then_some(PlacingRule::Slotted { pivot, pin: slide.joint, parts })
    })
}

fn on_line(linkage: &Linkage, known: &[bool], joint: usize) -> Option<PlacingRule> {
    let slide = linkage.slides.iter().position(|s| s.joint == joint && s.on.is_none())?;
    let (centre, body) = arms(linkage, known, joint).next()?;
    let to = linkage.joints[joint].at - linkage.joints[centre].at;
    let ahead = to.dot(linkage.slides[slide].direction) >= 0.0;
    Some(PlacingRule::OnLine { centre, body, slide, ahead })
}

fn circles(linkage: &Linkage, known: &[bool], joint: usize) -> Option<PlacingRule> {
    let mut arms = arms(linkage, known, joint);
    let (first, one) = arms.next()?;
    let (second, other) = arms.find(|(j, _)| *j != first)?;
    let at = |j: usize| linkage.joints[j].at;
    let left = (at(second) - at(first)).cross(at(joint) - at(first)) >= 0.0;
    Some(PlacingRule::Circles { centres: [first, second], bodies: [one, other], left })
}

/// The placed joints from which a joint has a constant distance, each with the link that keeps it.
fn arms<'a>(
    linkage: &'a Linkage,
    known: &'a [bool],
    joint: usize,
) -> impl Iterator<Item = (usize, usize)> + 'a {
    linkage
        .carriers(joint)
        .filter_map(move |b| linkage.bodies[b].joints.iter().find(|j| known[**j]).map(|j| (*j, b)))
}

impl Linkage {
    /// Returns the distance of two joints (mm).
    pub fn length(&self, a: usize, b: usize) -> f64 {
        self.joints[a].at.distance(self.joints[b].at)
    }

    /// Returns a point of a guide (mm) and its direction.
    pub fn line(&self, slide: usize) -> (Point, Vec2) {
        let slide = &self.slides[slide];
        (self.joints[slide.joint].at, slide.direction)
    }
}
