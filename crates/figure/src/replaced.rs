//! Draws a mechanism with cams beside the linkage of lower pairs in place of it 高副低代, with a line
//! for each link in place of a contact.

use super::groups::side_by_side;
use super::mechanism::{SeriesFeatures, drawing, replaced};
use super::sheet::SheetOptions;
use hodograph_base::diag::{Diagnostic, Faults, both};
use hodograph_base::lang::tr;
use hodograph_paper::paper::item::Figure;
use hodograph_report::replaced::{momentary, replacing_words};
use hodograph_scene::Scene;
use hodograph_worked::worked::{Worked, work_replaced};

/// Draws the figure.
///
/// # Errors
/// `no-replacement` for a scene without cams, and for a contact that no lower pairs replace.
pub fn figure(scene: &Scene, worked: &Worked, options: &SheetOptions) -> Result<Figure, Faults> {
    let (style, notation, lang) = (&options.style, &options.notation, options.lang);
    let Some((of, linkage)) = work_replaced(scene, worked)? else {
        return Err(none(scene).into());
    };
    let given = drawing(style, scene, worked, notation, &SeriesFeatures::default());
    let lower = replaced(style, (scene, worked), (&of.scene, &linkage), notation);
    let parts = vec![
        (given.finish(), tr!(lang, "with higher pairs").to_owned()),
        (lower.finish(), tr!(lang, "with lower pairs only").to_owned()),
    ];
    let mut lines: Vec<String> =
        of.links.iter().map(|l| lang.of(&replacing_words(scene, &of, l)).to_owned()).collect();
    lines.extend(scene.has_momentary_cams().then(|| lang.of(&momentary()).to_owned()));
    let heading = tr!(lang, "Higher pairs replaced by lower ones");
    let about = lines.join(lang.semicolon());
    let about = format!("{about}{}", tr!(lang, "."));
    Ok(side_by_side(scene, parts, (heading, &about, &lines), style, lang))
}

/// Returns the reason for which there is no such linkage.
fn none(scene: &Scene) -> Diagnostic {
    match scene.cams.iter().find(|c| c.contact.is_none()) {
        None => Diagnostic::error(
            "no-replacement",
            both!("the scene has no cam"),
        )
        .help(both!(
            "add \"cams\"; `hodograph new cam-eccentric` writes an example"
        )),
        Some(cam) => Diagnostic::error(
            "no-replacement",
            both!(
                "at this instant the profile of cam `{}` is straight where it touches `{}`: its centre of curvature is infinitely far away",
                scene.link_name(cam.cam),
                scene.link_name(cam.follower)
            ),
        )
        .at(cam.span)
        .help(both!("choose another angle of the cam")),
    }
}
