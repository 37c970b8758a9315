//! Draws the mechanism apart 拆杆组: the driven part with its ground, every group by itself, and
//! links that are redundant, each in its pose.
//!
//! A pair between two parts is shown in both: the pin as a circle, the block on its guide. Only the
//! driven part has its supports.

use super::form::LinkForm;
use super::{MechanismDraft, SeriesFeatures};
use hodograph_base::notation::Notation;
use hodograph_mechanism::mechanism::{Assur, Opened, Passive};
use hodograph_paper::paper::drawing::Drawing;
use hodograph_paper::paper::style::Style;
use hodograph_scene::{Guide, GuideId, GuidePath, LinkId, PointId, Scene};
use hodograph_worked::worked::Worked;

/// The part of a mechanism that is shown.
#[derive(Clone, Debug, Default)]
pub struct Only {
    links: Vec<bool>,
    drivers: Vec<bool>,
    /// Pins of the part that belong to none of its links.
    pins: Vec<PointId>,
}

/// The kind of a part of the mechanism.
#[derive(Clone, Debug)]
pub enum MechanismPiece<'a> {
    /// The driven links, with the ground.
    Driven,
    /// An Assur group.
    Group(Assur<'a>),
    /// A redundant link (virtual constraint).
    Repeats,
}

/// Returns the parts in solving order, before their labels are placed.
pub fn apart<'a>(
    style: &Style,
    scene: &Scene,
    worked: &'a Worked,
    notation: &Notation,
) -> Vec<(MechanismPiece<'a>, Drawing)> {
    let course = SeriesFeatures::of_one(style, scene, worked, notation);
    let m = &worked.mechanism;
    let draw = |only: Only| {
        let mut draft = MechanismDraft::new(style, scene, worked, notation, &course);
        draft
            .forms
            .iter_mut()
            .zip(&only.links)
            .filter(|(_, shown)| !**shown)
            .for_each(|(form, _)| *form = None::<LinkForm>);
        draft.only = Some(only);
        draft.pieces_of_it();
        draft.d
    };
    let nothing = || Only {
        links: vec![false; scene.links.len()],
        drivers: vec![false; scene.drivers.len()],
        pins: Vec::new(),
    };
    let mut driven = nothing();
    let groups = m.assur(scene);
    groups
        .iter()
        .filter(|g| g.class().is_none() && !g.is_carried())
        .for_each(|g| driven.add(scene, worked, g));
    let mut parts = Vec::new();
    // Cylinders drive within their groups.
    if driven.drivers.contains(&true) {
        driven.links[scene.ground.0] = true;
        parts.push((MechanismPiece::Driven, draw(driven)));
    }
    for g in groups.into_iter().filter(|g| g.class().is_some()) {
        let mut only = nothing();
        only.add(scene, worked, &g);
        parts.push((MechanismPiece::Group(g), draw(only)));
    }
    for opened in m.redundant.iter().map(|r| &r.opened) {
        if let Opened::Link(l) = opened {
            let mut only = nothing();
            only.links[l.0] = true;
            parts.push((MechanismPiece::Repeats, draw(only)));
        }
    }
    parts
}

/// Draws some links with their joints, before their labels are placed.
pub fn links(
    style: &Style,
    scene: &Scene,
    worked: &Worked,
    notation: &Notation,
    links: &[LinkId],
) -> Drawing {
    let course = SeriesFeatures::of_one(style, scene, worked, notation);
    let shown: Vec<bool> = (0..scene.links.len()).map(|l| links.contains(&LinkId(l))).collect();
    let mut draft = MechanismDraft::new(style, scene, worked, notation, &course);
    draft
        .forms
        .iter_mut()
        .zip(&shown)
        .filter(|(_, shown)| !**shown)
        .for_each(|(form, _)| *form = None::<LinkForm>);
    // Forces of a curved guide pass through its centre.
    let centre = |g: &Guide| match g.path {
        GuidePath::Arc { centre, .. } => g.slider.filter(|s| shown[s.0]).map(|_| centre),
        GuidePath::Line { .. } => None,
    };
    let pins = scene.guides.iter().filter_map(centre).collect();
    draft.only = Some(Only { links: shown, drivers: vec![false; scene.drivers.len()], pins });
    draft.pieces_of_it();
    draft.d
}

impl Only {
    /// Adds a group with its blocks and with its drivers.
    fn add(&mut self, scene: &Scene, worked: &Worked, g: &Assur) {
        let m = &worked.mechanism;
        g.links.iter().for_each(|l| self.links[l.0] = true);
        let pins = g.pins();
        for (l, passive) in m.passive.iter().enumerate() {
            let Some(Passive::Block(guide)) = passive else { continue };
            let guide = &scene.guides[guide.0];
            self.links[l] |=
                g.links.contains(&guide.on) || guide.pin.is_some_and(|p| pins.contains(&p));
        }
        self.pins.extend(pins);
        for d in g.drivers(m) {
            self.pins.extend(scene.drivers[d].kind.ends().into_iter().flatten());
            self.drivers[d] = true;
        }
    }
}

impl MechanismDraft<'_> {
    /// True if a link is shown.
    pub(super) fn shows(&self, l: LinkId) -> bool {
        self.only.as_ref().is_none_or(|o| o.links[l.0])
    }

    /// True if a driver is shown.
    pub(super) fn shows_driver(&self, d: usize) -> bool {
        self.only.as_ref().is_none_or(|o| o.drivers[d])
    }

    /// True if a point belongs to a moving link that is shown, or is a pin of the part.
    pub(super) fn shows_point(&self, p: PointId) -> bool {
        let Some(only) = &self.only else { return true };
        only.pins.contains(&p)
            || self.scene.carriers(p).any(|l| l != self.scene.ground && only.links[l.0])
    }

    /// True if the runner of a guide is shown.
    pub(super) fn shows_runner(&self, g: GuideId) -> bool {
        let guide = &self.scene.guides[g.0];
        guide.pin.is_none_or(|p| self.shows_point(p)) && guide.slider.is_none_or(|s| self.shows(s))
    }

    /// Draws the part, from back to front.
    fn pieces_of_it(&mut self) {
        self.ground_guides();
        self.wheels();
        self.plates(true);
        self.carriers();
        self.blocks();
        self.plates(false);
        self.bars();
        self.cylinders();
        self.joints();
        self.drivers();
        self.numbers();
        self.letters();
    }
}
