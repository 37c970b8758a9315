//! Weights and sizes of the ink, in millimetres on A4. Each says what it answers for.

use super::arrow::Head;
use super::item::{Colour, Stroke};

/// How the symbols of a figure are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Links: ISO 128's thick line, the darkest thing on the page, as the mechanism is the subject.
    pub link: Stroke,
    /// Outlines of joints, blocks and supports: below the links and above the auxiliary lines.
    pub outline: Stroke,
    /// Hatching, dimensions, angles, centre lines: half the outline, so that areas of hatching stay grey.
    pub thin: Stroke,
    /// Vectors: their length is read with a ruler to 0.2 mm, so the line may not be wider than twice that.
    pub vector: Stroke,
    /// Head of a vector.
    pub head: Head,
    /// Head of an angle's or dimension's arrow.
    pub thin_head: Head,
    /// Radius of a revolute joint's circle, to the middle of its line: its white must show between 0.7 mm links.
    pub pin_radius_mm: f64,
    /// Radius of the dot at a pole: larger than a line's width, smaller than a joint.
    pub dot_radius_mm: f64,
    /// Height of a fixed pivot's triangle, from the joint's centre to the ground line.
    pub pivot_height_mm: f64,
    /// Half the triangle's base.
    pub pivot_half_base_mm: f64,
    /// Half the length of a fixed pivot's ground line.
    pub ground_half_mm: f64,
    /// Distance between hatch strokes: closer than 1 mm they fill in at 150 dpi.
    pub hatch_pitch_mm: f64,
    /// Depth of the hatching, across the ground line.
    pub hatch_depth_mm: f64,
    /// Length of a slider's block, along its guide.
    pub block_length_mm: f64,
    /// Width of a slider's block, across its guide: shows the joint's circle with air on both sides.
    pub block_width_mm: f64,
    /// Clear width of a slot and distance of a pair of guide lines: a joint's circle fits in.
    pub slot_width_mm: f64,
    /// The area of a link with more than two joints: light enough for a label to be read on it.
    pub plate: Colour,
    /// Size of the type at points and vectors.
    pub label_mm: f64,
    /// Size of the type in tables and captions.
    pub caption_mm: f64,
    /// Size of the type at scales and dimensions: its scripts (70 %) stay above 2 mm, the smallest that prints.
    pub small_mm: f64,
}

impl Style {
    /// The look of the Chinese and German textbooks: black ink only.
    pub const TEXTBOOK: Style = Style {
        link: Stroke::new(0.7).round(),
        outline: Stroke::new(0.4),
        thin: Stroke::new(0.25),
        vector: Stroke::new(0.4),
        head: Head::VECTOR,
        thin_head: Head::THIN,
        pin_radius_mm: 1.1,
        dot_radius_mm: 0.6,
        pivot_height_mm: 4.4,
        pivot_half_base_mm: 2.9,
        ground_half_mm: 5.6,
        hatch_pitch_mm: 1.4,
        hatch_depth_mm: 1.8,
        block_length_mm: 8.0,
        block_width_mm: 4.4,
        slot_width_mm: 3.4,
        plate: Colour::grey(232),
        label_mm: 4.7,
        caption_mm: 4.1,
        small_mm: 3.5,
    };
}

impl Default for Style {
    fn default() -> Style {
        Style::TEXTBOOK
    }
}
