//! The links in place of the contacts of cams 高副低代, in words.

use hodograph_base::diag::{Both, both};
use hodograph_scene::cams::{ReplacedScene, ReplacingLink};
use hodograph_scene::{Follows, Scene};
use serde_json::{Value as Json, json};

/// Returns a link in place of a contact in words: its pairs with cam and follower; `scene` is the
/// one with cams.
pub fn replacing_words(scene: &Scene, of: &ReplacedScene, link: &ReplacingLink) -> Both {
    let c = &scene.cams[link.cam];
    let (own, point) = (of.scene.link_name(link.link), |p| of.scene.point_name(p));
    let (cam, follower) = (scene.link_name(c.cam), scene.link_name(c.follower));
    match (link.on_cam.map(point), link.on_follower.map(point)) {
        (Some(k), Some(b)) => {
            let end = match c.follows {
                Follows::Edge(_) => both!("the edge"),
                Follows::Roller(..) => both!("the roller's centre"),
                Follows::Arc(..) | Follows::Face(_) => both!("the centre of the end"),
            };
            both!(
                "link {own}: bar {k}{b} from the centre of curvature {k} of cam {cam} to {} {b} of link {follower}",
                end
            )
        }
        (None, b) => {
            let b = b.unwrap_or_default();
            both!(
                "link {own}: block pinned at {b} to link {follower}, sliding on cam {cam} along its straight profile"
            )
        }
        (Some(k), None) => both!(
            "link {own}: block pinned at {k}, the centre of curvature of cam {cam}, sliding on link {follower} along its face"
        ),
    }
}

/// Returns the links in place of the contacts of a scene in words; none without cams, and with
/// contacts that no lower pairs replace.
pub fn replaced_words(scene: &Scene) -> Vec<Both> {
    let Some(of) = scene.replaced(|_| None) else { return Vec::new() };
    of.links.iter().map(|l| replacing_words(scene, &of, l)).collect()
}

/// Returns the remark that the linkage is right at the instant only.
pub fn momentary() -> Both {
    both!(
        "this linkage has the velocities and accelerations of this instant; it changes with the position"
    )
}

/// Returns the links in place of contacts as JSON.
pub fn json(scene: &Scene, of: &ReplacedScene) -> Json {
    let point = |p| of.scene.point_name(p);
    let one = |l: &ReplacingLink| {
        let c = &scene.cams[l.cam];
        let Both { en, zh } = replacing_words(scene, of, l);
        json!({
            "link": of.scene.link_name(l.link),
            "cam": scene.link_name(c.cam),
            "follower": scene.link_name(c.follower),
            "on_cam": l.on_cam.map(point),
            "on_follower": l.on_follower.map(point),
            "why": {"en": en, "zh": zh},
        })
    };
    of.links.iter().map(one).collect::<Vec<_>>().into()
}
