//! Forms of the same motion: a crank whose pin is enlarged until it surrounds the pivot, which is an
//! eccentric disc in the ring of the next link; and a slider as a rod in a fixed block.

use hodograph_base::geom::{Point, Vec2};
use hodograph_base::notation::Notation;
use hodograph_board::plan::names::name_label;
use hodograph_methods::inversions::evolution::DrivingCrank;
use hodograph_paper::paper::drawing::Drawing;
use hodograph_paper::paper::item::{Dash, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::place::LabelRequest;
use hodograph_paper::paper::style::Style;
use hodograph_paper::paper::symbols as sym;
use hodograph_scene::{GuideId, PointId, Scene};
use hodograph_worked::worked::Worked;

use super::{MechanismDraft, SAME_MM, SeriesFeatures};

/// The disc beyond the pivot, and the width of the ring.
const BEYOND_MM: f64 = 5.0;
const RING_MM: f64 = 3.0;
/// The ring beyond the pivot.
pub const AROUND_MM: f64 = BEYOND_MM + RING_MM;

/// Draws the mechanism with the pin of a crank as a disc; labels are not yet placed.
pub fn eccentric(
    style: &Style,
    scene: &Scene,
    worked: &Worked,
    notation: &Notation,
    DrivingCrank { link, pivot, pin }: DrivingCrank,
) -> Drawing {
    let alone = SeriesFeatures::default();
    let mut draft = MechanismDraft::new(style, scene, worked, notation, &alone);
    draft.constructed = false;
    let (Some(axis), Some(centre)) = (draft.point(pivot), draft.point(pin)) else {
        draft.everything();
        return draft.d;
    };
    let radius_mm = axis.distance(centre) + BEYOND_MM;
    let ring_mm = axis.distance(centre) + AROUND_MM;
    draft.forms[link.0] = None;
    // The bar of the next link begins at the ring.
    let cut = |(from, to): (Point, Point)| {
        let from_ring = |at: Point, other: Point| match (other - at).unit() {
            Some(u) if at.distance(centre) < SAME_MM => at + u * ring_mm,
            Some(_) | None => at,
        };
        (from_ring(from, to), from_ring(to, from))
    };
    for form in draft.forms.iter_mut().flatten() {
        form.bars.iter_mut().for_each(|bar| *bar = cut(*bar));
    }
    let id = draft.link_id(link.0);
    draft.d.shape("ring", "link", sym::round_body(style, centre, ring_mm));
    draft.d.of_link(Some(link.0));
    draft.d.shape(&id, "link", sym::round_body(style, centre, radius_mm));
    draft.d.of_link(None);
    let eccentricity =
        Shape::Line { from: axis, to: centre, stroke: style.thin.dashed(Dash::DashDot) };
    let owner = draft.d.shape("eccentricity", "axis", eccentricity);
    let request = LabelRequest::along(Label::math("e"), style.small_mm, axis, centre, 0.2);
    draft.d.label("eccentricity", "axis", request.owned(owner));
    draft.everything();
    draft.numbers();
    let inside = centre + Vec2::new(0.0, -radius_mm * 0.6);
    let number = Label::math(name_label(scene.link_name(link)));
    draft.d.label(&id, "number", LabelRequest::at_point(number, style.label_mm, inside, 0.0));
    draft.d
}

/// The block of a rod: distance from the pin, and length of the rod beyond it.
const BLOCK_MM: f64 = 22.0;
const ROD_BEYOND_MM: f64 = 12.0;
/// Ground beside a block, in its lengths.
const GROUND: f64 = 0.8;

/// Draws a slider-crank with its slider as a rod in a fixed block; labels are not yet placed.
pub fn rod_in_block(
    style: &Style,
    scene: &Scene,
    worked: &Worked,
    notation: &Notation,
    pivot: PointId,
) -> Drawing {
    let alone = SeriesFeatures::default();
    let mut draft = MechanismDraft::new(style, scene, worked, notation, &alone);
    draft.constructed = false;
    let Some((pin, tangent)) = draft.runner(GuideId(0)) else { return draft.d };
    let inward = draft.point(pivot).is_some_and(|p| (p - pin).dot(tangent) > 0.0);
    let along = if inward { -tangent } else { tangent };
    let seat = pin + along * BLOCK_MM;
    let tip = seat + along * ROD_BEYOND_MM;
    let slider = scene.guides[0].slider.map_or("", |l| scene.link_name(l));
    let id = format!("link-{slider}");
    draft.d.draw(&id, "", sym::link(style, &[pin, tip]));
    draft.d.draw("block", "", sym::block(style, seat, along.angle(), true));
    // The ground is below the block.
    let right = if along.x < 0.0 { -along } else { along };
    let half = right * (style.block_length_mm * GROUND);
    let below = right.perp() * (-style.block_width_mm / 2.0);
    draft.d.draw("ground", "", sym::ground_line(style, seat + below - half, seat + below + half));
    draft.plates(false);
    draft.bars();
    draft.joints();
    draft.drivers();
    draft.letters();
    draft.numbers();
    let number = Label::math(name_label(slider));
    let request = LabelRequest::along(number, style.label_mm, pin, seat, style.link.width_mm / 2.0);
    draft.d.label(&id, "number", request);
    draft.d
}
