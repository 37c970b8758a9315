//! Points and links: those that the file lists, and those that a guide, the ground or a cylinder
//! adds.

use std::collections::HashMap;

use super::super::decode::{MAX_LINKS, MAX_POINTS};
use super::super::names;
use super::*;

/// The declared points and links, in the order of the file.
pub(super) struct Declared {
    pub points: Vec<NamedPoint>,
    pub links: Vec<Link>,
    /// The ground; `None` (with a fault) if the file names none or an impossible one.
    pub ground: Option<LinkId>,
    /// The places of contact of the rolling pairs, in the order of the pairs.
    pub contacts: Vec<[PointId; 2]>,
    /// The contacts of cams that questions name, each with its cam's index in the file.
    pub touches: Vec<(PointId, usize)>,
}

/// Collects points and links while the sections are read in order.
#[derive(Default)]
struct Register {
    points: Vec<NamedPoint>,
    links: Vec<Link>,
    by_point: HashMap<String, PointId>,
    by_link: HashMap<String, LinkId>,
}

impl Register {
    fn point(&mut self, word: &Word, faults: &mut Faults) -> PointId {
        if let Some(id) = self.by_point.get(&word.text) {
            return *id;
        }
        // A bad name is declared too, so that its other mentions are not reported again.
        faults.list.extend(names::check(word, names::Named::Point));
        let id = PointId(self.points.len());
        self.points.push(NamedPoint {
            name: word.text.clone(),
            place: PointPlace::Unknown,
            sketch: None,
            span: word.span,
        });
        self.by_point.insert(word.text.clone(), id);
        id
    }

    fn link(&mut self, word: &Word, points: Vec<PointId>, faults: &mut Faults) -> LinkId {
        faults.list.extend(names::check(word, names::Named::Link));
        let id = LinkId(self.links.len());
        self.links.push(Link { name: word.text.clone(), points, span: word.span });
        self.by_link.insert(word.text.clone(), id);
        id
    }
}

pub(super) fn declare(raw: &RawScene, faults: &mut Faults) -> Declared {
    let mut r = Register::default();
    for link in &raw.links {
        let mut points = Vec::with_capacity(link.points.len());
        for word in &link.points {
            let id = r.point(word, faults);
            if points.contains(&id) {
                let message = both!("link `{}` names point `{}` twice", link.name.text, word.text);
                faults.push(
                    Diagnostic::error("same-point", message)
                        .at(word.span)
                        .help(both!("name it once")),
                );
            } else {
                points.push(id);
            }
            if r.points.len() > MAX_POINTS {
                let message = both!("there are more than {MAX_POINTS} points");
                faults.push(Diagnostic::error("too-many", message).at(word.span));
                return Declared {
                    points: r.points,
                    links: r.links,
                    ground: None,
                    contacts: Vec::new(),
                    touches: Vec::new(),
                };
            }
        }
        r.link(&link.name, points, faults);
    }
    let listed = r.links.len();
    for guide in &raw.guides {
        let Some(slider) = &guide.slider else {
            loose_pin(raw, guide, &mut r, faults);
            continue;
        };
        let id = r.by_link.get(&slider.text).copied();
        match (id, &guide.pin) {
            // Two guides may share an unlisted slider: a block pinned at one point, or a
            // cross-shaped slider without a pin.
            (Some(id), Some(pin)) if id.0 >= listed => {
                let pin = r.point(pin, faults);
                if !r.links[id.0].points.contains(&pin) {
                    r.links[id.0].points.push(pin);
                }
            }
            (Some(_), _) => {}
            (None, pin) => {
                let points = pin.iter().map(|pin| r.point(pin, faults)).collect();
                r.link(slider, points, faults);
            }
        }
    }
    let ground = declare_ground(raw, &mut r, faults);
    for driver in &raw.drivers {
        let RawDriverKind::Cylinder { links, .. } = &driver.kind else { continue };
        for link in links {
            if !r.by_link.contains_key(&link.text) {
                r.link(link, Vec::new(), faults);
            }
        }
    }
    if r.links.len() > MAX_LINKS {
        faults.push(Diagnostic::error(
            "too-many",
            both!("there are {} links; at most {MAX_LINKS} are allowed", r.links.len()),
        ));
    } else if r.links.len() < 2 && !raw.links.is_empty() {
        let d = Diagnostic::error(
            "too-few-links",
            both!("a mechanism has at least two links, counting the ground; there is one"),
        );
        faults.push(d.at(raw.links[0].name.span));
    }
    empty_links(raw, &r, ground, faults);
    let contacts = raw.rolling.iter().map(|pair| contacts(pair, &mut r, faults)).collect();
    let touches = touches(raw, &mut r, faults);
    Declared { points: r.points, links: r.links, ground, contacts, touches }
}

/// Declares the contacts of cams that questions name: points on no link.
fn touches(raw: &RawScene, r: &mut Register, faults: &mut Faults) -> Vec<(PointId, usize)> {
    let asked: Vec<&str> =
        raw.find.iter().flatten().filter_map(|w| Some(w.text.split_once('_')?.1)).collect();
    let named = |w: &&Word| {
        asked.iter().any(|names| names.contains(&w.text)) && !r.by_point.contains_key(&w.text)
    };
    let new: Vec<(usize, &Word)> = raw
        .cams
        .iter()
        .enumerate()
        .filter_map(|(k, c)| Some((k, c.at.as_ref().filter(named)?)))
        .collect();
    new.into_iter().map(|(k, word)| (r.point(word, faults), k)).collect()
}

/// Declares the place of contact of a rolling pair, or both ends of a strand, under the names in
/// the file, or under the first free ones of the usual letters.
fn contacts(pair: &RawRolling, r: &mut Register, faults: &mut Faults) -> [PointId; 2] {
    let mut named = |word: &Option<Word>, usual: &[&str]| {
        if let Some(word) = word {
            return r.point(word, faults);
        }
        let usual = usual
            .iter()
            .map(|letter| (*letter).to_owned())
            .chain((1..).map(|n| format!("{}{n}", usual[0])));
        let name = usual.into_iter().find(|name| !r.by_point.contains_key(name));
        r.point(&Word { text: name.expect("the names do not end"), span: pair.span }, faults)
    };
    match &pair.strand {
        None => [named(&pair.at, &["Q", "S", "T", "U", "W"]); 2],
        Some(strand) => [named(&pair.at, &["M", "S", "U"]), named(&strand.end, &["N", "T", "W"])],
    }
}

/// Declares a bare pin that is on no link: in two slots it has a definite place.
fn loose_pin(raw: &RawScene, guide: &RawGuide, r: &mut Register, faults: &mut Faults) {
    let Some(pin) = &guide.pin else { return };
    let slots =
        raw.guides.iter().filter(|g| g.pin.as_ref().is_some_and(|p| p.text == pin.text)).count();
    if slots > 1 {
        r.point(pin, faults);
    }
}

fn declare_ground(raw: &RawScene, r: &mut Register, faults: &mut Faults) -> Option<LinkId> {
    let word = raw.ground.as_ref()?;
    if let Some(id) = r.by_link.get(&word.text) {
        return Some(*id);
    }
    let tracks = raw.rolling.iter().flat_map(|p| &p.sides).map(|s| &s.link);
    let carries = raw
        .guides
        .iter()
        .map(|g| &g.on)
        .chain(tracks)
        .any(|on| on.as_ref().is_none_or(|on| on.text == word.text));
    // If the ground has no other points, points given by coordinates can only be its fixed pivots.
    // If it carries guides, they may also be places of the pose.
    let pivots = if carries { Vec::new() } else { implied_pivots(raw, r) };
    // A ground that nothing joins is a misspelt name, not a link without points of its own.
    if !carries && pivots.is_empty() {
        let d = Diagnostic::error(
            "unknown-link",
            both!("the ground `{}` is not among the links and carries no guide", word.text),
        );
        let known = raw.links.iter().map(|l| l.name.text.as_str());
        let near = suggest(&word.text, known, both!("the links are"));
        faults.push(d.at(word.span).help(both!(
            "{}; list its fixed pivots, as in \"{}\": [\"A\", \"D\"]",
            near,
            word.text
        )));
        return None;
    }
    if !pivots.is_empty() {
        let names: Vec<&str> = pivots.iter().map(|p| r.points[p.0].name.as_str()).collect();
        let quoted: Vec<String> = names.iter().map(|n| format!("\"{n}\"")).collect();
        let message = both!(
            "{} taken as fixed: they have coordinates and sit on one link only",
            Both::names(&names)
        );
        let d = Diagnostic::note("implied-pivots", message).at(word.span);
        faults.push(d.help(both!(
            "to say it: \"{}\": [{}] in \"links\"",
            word.text,
            quoted.join(", ")
        )));
    }
    Some(r.link(word, pivots, faults))
}

/// Returns the fixed pivots of a ground that lists no points: points given by coordinates that join
/// nothing else.
fn implied_pivots(raw: &RawScene, r: &Register) -> Vec<PointId> {
    let runs =
        |name: &str| raw.guides.iter().any(|g| g.pin.as_ref().is_some_and(|p| p.text == name));
    (0..r.points.len())
        .map(PointId)
        .filter(|p| {
            let name = r.points[p.0].name.as_str();
            let placed = raw
                .points
                .iter()
                .any(|(w, place)| w.text == name && matches!(place, RawPlace::At(_)));
            placed && !runs(name) && r.links.iter().filter(|l| l.points.contains(p)).count() == 1
        })
        .collect()
}

/// Reports links without points that neither slide nor carry a guide and are not the ground:
/// nothing joins them to other links.
fn empty_links(raw: &RawScene, r: &Register, ground: Option<LinkId>, faults: &mut Faults) {
    for (i, link) in r.links.iter().enumerate() {
        let named = |w: &Option<Word>| w.as_ref().is_some_and(|w| w.text == link.name);
        let slides = raw.guides.iter().any(|g| named(&g.slider) || named(&g.on))
            || raw.rolling.iter().any(|p| p.sides.iter().any(|s| named(&s.link)));
        let cylinder = |d: &RawDriver| matches!(&d.kind, RawDriverKind::Cylinder { links, .. } if links.iter().any(|w| w.text == link.name));
        if link.points.is_empty()
            && !slides
            && ground != Some(LinkId(i))
            && !raw.drivers.iter().any(cylinder)
        {
            let d = Diagnostic::error(
                "no-points",
                both!("link `{}` has no points and no guide", link.name),
            )
            .at(link.span);
            faults.push(d.help(both!("name its points: [\"A\", \"B\"]")));
        }
    }
}
