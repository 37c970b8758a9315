//! Links and pairs of a mechanism in words, for a scene without a pose: all that counting the
//! degree of freedom needs.

use crate::diag::{Both, both};
use crate::mechanism::rolling_pair_words;
use crate::paper::phrase::Phrase;
use crate::plan::text::point_label;
use crate::scene::{DriverKind, Follows, Guide, GuideId, Lang, LinkId, PointId, RollingId, Scene};

/// One line for the links, one for each pair and each driver.
pub(super) fn listed(scene: &Scene, lang: Lang) -> Vec<Phrase> {
    let w = PairWords { scene };
    let mut all = vec![w.links()];
    all.extend((0..scene.points.len()).map(PointId).filter_map(|p| w.pin(p)));
    let cam = |g: usize| scene.cams.iter().any(|c| c.contact == Some(GuideId(g)));
    all.extend(
        scene
            .guides
            .iter()
            .enumerate()
            .filter(|(i, g)| g.rolling.is_none() && !cam(*i))
            .map(|(_, g)| w.guide(g)),
    );
    all.extend(scene.cams.iter().map(|c| w.cam(c.cam, c.follower, &c.follows)));
    all.extend((0..scene.rolling.len()).map(|r| rolling_pair_words(scene, RollingId(r))));
    all.extend(
        (0..scene.drivers.len())
            .filter(|d| !scene.is_led(*d))
            .map(|d| w.driver(&scene.drivers[d].kind)),
    );
    all.iter().map(|b| Phrase::new(if lang == Lang::En { &b.en } else { &b.zh })).collect()
}

struct PairWords<'a> {
    scene: &'a Scene,
}

impl PairWords<'_> {
    fn point(&self, p: PointId) -> String {
        format!("${}$", point_label(self.scene.point_name(p)))
    }

    fn names(&self, links: &[LinkId]) -> Both {
        let names: Vec<Both> = links.iter().map(|l| Both::same(self.scene.link_name(*l))).collect();
        Both::join(&names, [", ", "、"])
    }

    fn links(&self) -> Both {
        let moving: Vec<LinkId> =
            (0..self.scene.links.len()).map(LinkId).filter(|l| *l != self.scene.ground).collect();
        let ground = self.scene.link_name(self.scene.ground);
        both!("moving links {}; link {ground} is fixed", self.names(&moving))
    }

    /// A pin that joins links.
    fn pin(&self, p: PointId) -> Option<Both> {
        let links: Vec<LinkId> = self.scene.carriers(p).collect();
        let point = self.point(p);
        (links.len() > 1).then(|| both!("pin {point} joins links {}", self.names(&links)))
    }

    fn guide(&self, g: &Guide) -> Both {
        let on = self.scene.link_name(g.on);
        let pin = g.pin.map(|p| self.point(p));
        match (g.slider.map(|s| self.scene.link_name(s)), pin) {
            (Some(slider), Some(pin)) => both!("{slider} slides on {on} at {pin}"),
            (Some(slider), None) => {
                both!("{slider} slides on {on}")
            }
            (None, Some(pin)) => {
                both!("pin {pin} runs in a slot of {on}")
            }
            (None, None) => Both::default(),
        }
    }

    fn cam(&self, cam: LinkId, follower: LinkId, follows: &Follows) -> Both {
        let [cam, link] = [cam, follower].map(|l| self.scene.link_name(l));
        match follows {
            Follows::Edge(p) => {
                both!("the edge {} of {link} touches cam {cam}", self.point(*p))
            }
            Follows::Roller(p, _) => self.roller(cam, link, *p, follower),
            Follows::Arc(p, _) => {
                both!("the round end about {} of {link} touches cam {cam}", self.point(*p))
            }
            Follows::Face(_) => both!("the flat face of {link} touches cam {cam}"),
        }
    }

    /// A roller is a link of its own if a link hangs on its pin.
    fn roller(&self, cam: &str, follower: &str, pin: PointId, link: LinkId) -> Both {
        let own = self
            .scene
            .carriers(pin)
            .find(|l| *l != link && self.scene.links[l.0].points.len() == 1);
        let point = self.point(pin);
        match own.map(|l| self.scene.link_name(l)) {
            Some(roller) => both!("roller {roller} of {follower} about {point} touches cam {cam}"),
            None => {
                both!("the roller of {follower} about {point} touches cam {cam}")
            }
        }
    }

    fn driver(&self, kind: &DriverKind) -> Both {
        if let Some((link, _)) = kind.turned() {
            return both!("{} is driven", self.scene.link_name(link));
        }
        if let Some(g) = kind.guide().map(|g| &self.scene.guides[g.0]) {
            let what = g
                .slider
                .map(|s| self.scene.link_name(s).to_owned())
                .or(g.pin.map(|p| self.point(p)))
                .unwrap_or_default();
            return both!("{what} is driven along its guide");
        }
        let [a, b] = kind.ends().map(|ends| ends.map(|p| self.point(p))).unwrap_or_default();
        both!("the cylinder from {a} to {b} is driven")
    }
}
