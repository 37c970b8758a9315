//! The linkage in place of a mechanism with cams 高副低代, over the thin profiles, rollers and faces.

use hodograph_base::notation::Notation;
use hodograph_paper::paper::drawing::Drawing;
use hodograph_paper::paper::style::Style;
use hodograph_scene::Scene;
use hodograph_worked::worked::Worked;

use super::cams::contact_dot;
use super::{MechanismDraft, SeriesFeatures};

/// Draws the linkage `linkage` in place of the mechanism; labels are not yet placed.
pub fn replaced(
    style: &Style,
    (scene, worked): (&Scene, &Worked),
    linkage: (&Scene, &Worked),
    notation: &Notation,
) -> Drawing {
    let alone = SeriesFeatures::default();
    let thin = Style { outline: style.thin, link: style.thin, ..style.clone() };
    let mut given = MechanismDraft::new(&thin, scene, worked, notation, &alone);
    let mut draft = MechanismDraft::new(style, linkage.0, linkage.1, notation, &alone);
    given.d = Drawing::new("given", thin.clone());
    given.cams();
    given.followers();
    draft.everything();
    for (i, cam) in scene.cams.iter().enumerate() {
        if let Some((contact, _)) = given.contact(cam) {
            contact_dot(&mut draft.d, style, (i, cam), contact);
        }
    }
    let items = given.d.finish().items;
    draft.d.behind(|d| {
        d.draw("given", "given", items);
    });
    draft.d
}
