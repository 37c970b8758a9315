//! The symbols of mechanism drawings, after ISO 3952 (GB/T 4460) in the form of the textbooks: pure
//! functions from positions to items.
//!
//! Positions are on the paper, in millimetres; angles are counter-clockwise from x. A symbol's
//! items are in drawing order and each has a class: `pin`, `ground`, `link`, `slider`, `slot`,
//! `plate`, `cylinder`, `rotation`, `angle`, `dimension`, `scale`, `spring`. Draw links first, then
//! supports and blocks, pins last. The obstacles for labels are derived from the items themselves
//! ([`super::place::Obstacles::of`]).

mod joint;
mod link;
mod mark;
mod slide;

pub use joint::{dot, fixed_pivot, ground_arc, ground_line, pin, wedge};
pub use link::{dashed, link, plate, round_body, spring, weld};
pub use mark::{angle, dimension, dimension_line, rotation, scale_bar};
pub use slide::{GuideForm, block, cylinder, guide, slot, slot_arc};

#[cfg(test)]
mod tests;
