//! Belts and chains of an inversion: they run in the same way for every ground.

use super::pairs::metres;
use hodograph_scene::{Contours, Rolling, RollingKind, Scene};
use serde_json::{Value as Json, json};
use std::f64::consts::TAU;

/// Returns the sections `belts` and `chains`.
pub(super) fn sections(scene: &Scene) -> [Vec<Json>; 2] {
    [RollingKind::Belt, RollingKind::Chain].map(|kind| {
        let strands: Vec<&Rolling> = scene.rolling.iter().filter(|r| r.kind == kind).collect();
        strands
            .chunk_by(|a, b| a.belt() == b.belt())
            .filter_map(|strands| entry(scene, kind, strands))
            .collect()
    })
}

/// Returns one belt or chain with consecutive strands.
fn entry(scene: &Scene, kind: RollingKind, strands: &[&Rolling]) -> Option<Json> {
    let (mut links, mut centres, mut radii, mut teeth, mut at) =
        (Vec::new(), Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let (mut reversed, mut back) = (Vec::new(), false);
    for pair in strands {
        let Contours::Belt { centres: c, radii: r, teeth: z, crossed, right, .. } = &pair.contours
        else {
            return None;
        };
        if links.is_empty() && *right {
            reversed.push(scene.link_name(pair.links[0]));
            back = true;
        }
        back ^= crossed;
        // The first wheel of a strand is the second wheel of the previous strand.
        for k in usize::from(!links.is_empty())..2 {
            links.push(scene.link_name(pair.links[k]));
            centres.push(scene.point_name(c[k]));
            radii.push(r[k].value);
            teeth.extend(z.map(|z| z[k]));
        }
        if back {
            reversed.push(scene.link_name(pair.links[1]));
        }
        at.extend(pair.at.map(|p| scene.point_name(p)));
    }
    let mut out = match kind.is_toothed() {
        true => {
            let pitch = TAU * radii.first()? / f64::from(*teeth.first()?);
            json!({"sprockets": links, "centres": centres, "teeth": teeth, "pitch": metres(pitch)})
        }
        false => {
            json!({"pulleys": links, "centres": centres, "radii": radii.into_iter().map(metres).collect::<Vec<_>>()})
        }
    };
    if !reversed.is_empty() {
        out["reversed"] = json!(reversed);
    }
    out["at"] = json!(at);
    Some(out)
}
