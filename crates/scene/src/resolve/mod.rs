//! Raw scene to [`Scene`]: names to ids, texts to SI values, and all checks that concern one file.
//!
//! Each file reads one section and continues after a fault, so that one run reports all faults;
//! parts that depend on a faulty part are skipped silently. Other modules decide whether the data
//! determine the mechanism.

mod answers;
mod applied;
mod attempts;
mod belts;
mod composite;
mod declare;
mod drivers;
mod find;
mod free;
mod friction;
mod guides;
mod lengths;
mod loads;
mod paper;
mod places;
mod rolling;
mod statement;

use super::book::Book;
use super::cams::{expand, marked, rollers};
use super::model::*;
use super::names::Names;
use super::raw::*;
use super::source::Source;
use super::units::RequiredQuantity;
use super::values::Values;
use hodograph_base::diag::{Both, Diagnostic, Faults, Span, both};
use hodograph_base::json::Word;
use hodograph_base::json::fields::suggest;
pub(super) use paper::SHEETS;

/// The common data of all sections.
struct Context<'a> {
    raw: &'a RawScene,
    values: &'a Values<'a>,
    names: Names<'a>,
    ground: LinkId,
    /// The places of contact of the rolling pairs.
    contacts: &'a [[PointId; 2]],
    /// The contacts of cams that are points of the scene, each with its cam's index in the file.
    touches: &'a [(PointId, usize)],
}

impl Context<'_> {
    fn carries(&self, link: LinkId, point: PointId) -> bool {
        self.names.links[link.0].points.contains(&point)
    }

    /// Returns the centre of a round contour on a link; `why` describes the contour for the fault.
    fn centre_on(
        &self,
        word: &Word,
        link: LinkId,
        why: Both,
        faults: &mut Faults,
    ) -> Option<PointId> {
        let centre = note(self.names.point(word), faults)?;
        if self.carries(link, centre) {
            return Some(centre);
        }
        let message =
            both!("centre `{}` is not on link `{}`, {}", word.text, self.link_name(link), why);
        faults.push(
            Diagnostic::error("not-on-link", message).at(word.span).help(self.points_of(link)),
        );
        None
    }

    /// Returns true if a point is the contact of a pair, on no link.
    fn is_contact(&self, point: PointId) -> bool {
        self.contacts.iter().any(|at| at.contains(&point))
            || self.touches.iter().any(|(at, _)| *at == point)
    }

    /// Returns true if a link is a wheel or the track of a wheel.
    fn rolls(&self, link: LinkId) -> bool {
        let named =
            |s: &RawRollingSide| s.link.as_ref().is_some_and(|w| w.text == self.link_name(link));
        self.raw.rolling.iter().any(|p| p.sides.iter().any(named))
    }

    /// Returns a link that carries both points.
    fn common(&self, a: PointId, b: PointId) -> Option<LinkId> {
        (0..self.names.links.len()).map(LinkId).find(|l| self.carries(*l, a) && self.carries(*l, b))
    }

    fn point_name(&self, p: PointId) -> &str {
        &self.names.points[p.0].name
    }

    fn link_name(&self, l: LinkId) -> &str {
        &self.names.links[l.0].name
    }

    /// Returns the points of a link, for a help line.
    fn points_of(&self, l: LinkId) -> Both {
        match self.names.links[l.0].points.as_slice() {
            [] => both!("link `{}` has no points", self.link_name(l)),
            points => {
                let names: Vec<_> = points.iter().map(|p| self.point_name(*p)).collect();
                both!("link `{}` has {}", self.link_name(l), Both::names(&names))
            }
        }
    }

    /// Returns a pair of points that must both be on `link`.
    fn line_on(&self, word: &Word, link: LinkId) -> Result<(PointId, PointId), Diagnostic> {
        let (a, b) = self.names.pair(word)?;
        match [a, b].into_iter().find(|p| !self.carries(link, *p)) {
            None => Ok((a, b)),
            Some(p) => {
                let message = both!(
                    "point `{}` is not on link `{}`",
                    self.point_name(p),
                    self.link_name(link)
                );
                Err(Diagnostic::error("not-on-link", message)
                    .at(word.span)
                    .help(self.points_of(link)))
            }
        }
    }
}

/// Records a fault and returns `None` in its place.
fn note<T>(result: Result<T, Diagnostic>, faults: &mut Faults) -> Option<T> {
    result.map_err(|d| faults.push(d)).ok()
}

pub(super) use find::{Question, begins_a_question};

/// Returns `Some(None)` for absent data, `None` for faulty data.
fn transpose<T>(found: Option<Option<T>>) -> Option<Option<T>> {
    match found {
        None => Some(None),
        Some(None) => None,
        Some(found) => Some(found),
    }
}

/// A quantity that is not in the file, such as the coordinates of a pivot at the origin.
fn zero(span: Span) -> GivenQuantity {
    GivenQuantity { value: 0.0, radius: 0.0, text: "0".to_owned(), span }
}

/// The data that other files share with a scene.
pub(super) struct SceneHeader {
    pub title: Option<Both>,
    pub language: Option<Lang>,
    pub paper: Paper,
    pub book: Book,
}

/// Resolves title, language, paper and units of a file other than a scene.
pub(super) fn front(raw: &RawScene, values: &Values, faults: &mut Faults) -> SceneHeader {
    let book = answers::book(raw, faults);
    let paper = paper::paper(raw, values, &book, faults);
    paper::notation(raw, faults);
    SceneHeader {
        title: localized(&raw.title),
        language: paper::language(raw, faults),
        paper,
        book,
    }
}

/// Resolves a whole scene. The result is valid only if no error has been added to `faults`.
pub(super) fn resolve(raw: &RawScene, source: &str, faults: &mut Faults) -> Option<Scene> {
    let mut found = Faults::default();
    let scene = with_cams(raw, source, &mut found);
    if !raw.links_sound {
        found.list.retain(|d| {
            !matches!(
                d.code,
                "unknown-point" | "unknown-link" | "not-on-link" | "no-points" | "too-few-links"
            )
        });
    }
    // After an error, notes on unused parameters have no value.
    let broken = faults.has_errors() || found.has_errors();
    faults.list.extend(found.list.into_iter().filter(|d| !broken || d.code != "unused-parameter"));
    scene
}

/// Resolves the sections of a scene after its cams have been replaced by other pairs; without cams,
/// the sections as they are.
fn with_cams(raw: &RawScene, source: &str, faults: &mut Faults) -> Option<Scene> {
    if raw.cams.is_empty() {
        let mut scene = sections(raw, source, faults)?;
        scene.source = (!scene.loads.is_empty()).then(|| Source::of(raw, source));
        return Some(scene);
    }
    let settled = rollers::settled(raw, faults);
    let marked = marked::marked(&settled);
    // Faults outside the cams are reported by the full reading.
    let Some(bare) = sections(&marked, source, &mut Faults::default()) else {
        return sections(&marked, source, faults);
    };
    let mut scene = expanded(raw, &marked, source, &bare, None, faults)?;
    for cam in 0..scene.cams.len() {
        let Some(pieces) = &scene.cams[cam].posed else { continue };
        let rest = (0..pieces.segments.len()).filter(|piece| *piece != pieces.touched);
        // A piece that cannot be touched gives no scene.
        let on = |piece| {
            Some((
                piece,
                expanded(raw, &marked, source, &bare, Some((cam, piece)), &mut Faults::default())?,
            ))
        };
        let others: Vec<(usize, Scene)> = rest.filter_map(on).collect();
        if let Some(pieces) = &mut scene.cams[cam].posed {
            pieces.others = others;
        }
    }
    scene.source = Some(Source::of(raw, source));
    Some(scene)
}

/// Resolves a scene with the cams replaced by other pairs; `on` puts the contact of a cam on a
/// piece of its profile.
fn expanded(
    raw: &RawScene,
    marked: &RawScene,
    source: &str,
    bare: &Scene,
    on: Option<(usize, usize)>,
    faults: &mut Faults,
) -> Option<Scene> {
    let expanded = expand::expand(marked.clone(), source, bare, on, faults);
    let broken = faults.has_errors();
    let mut rest = Faults::default();
    let scene = sections(&expanded.raw, source, &mut rest);
    // A parameter of an untouched piece counts as used.
    let unused = |d: &Diagnostic| {
        let named = raw.parameters.iter().find(|(name, _)| d.span == Some(name.span));
        d.code == "unused-parameter"
            && named.is_some_and(|(name, _)| expanded.used.contains(&name.text))
    };
    faults.list.extend(rest.list.into_iter().filter(|d| !unused(d)));
    let mut scene = scene.filter(|_| !broken)?;
    // A question about a roller keeps its text.
    for word in raw.find.iter().flatten() {
        scene
            .find
            .iter_mut()
            .filter(|f| f.span == word.span)
            .for_each(|f| f.text.clone_from(&word.text));
    }
    scene.cams = expanded.cams(&scene);
    Some(scene)
}

fn sections(raw: &RawScene, source: &str, faults: &mut Faults) -> Option<Scene> {
    let (values, parameters) = Values::new(source, &raw.units, &raw.parameters, faults);
    let declared = declare::declare(raw, faults);
    let scene = {
        let declare::Declared { points, links, ground, contacts, touches } = &declared;
        let (names, fixed) = (Names::new(points, links), ground.unwrap_or(LinkId(0)));
        let context = Context { raw, values: &values, names, ground: fixed, contacts, touches };
        // Without a ground, guides and drivers would be judged against the wrong link; the other
        // sections can still be read.
        let mut lengths = lengths::lengths(&context, faults);
        let mut places = places::places(&context, *ground, &lengths, faults);
        let sketch = places::sketch(&context, faults);
        let sides = places::sides(&context, faults);
        let guides = ground.map(|_| guides::guides(&context, &places, faults));
        let first_guide = guides.as_ref().map_or(0, Vec::len);
        let mut rolling = rolling::rolling(&context, &places, &lengths, first_guide, faults);
        if let Some(ground) = *ground {
            // The radii of two gears on fixed axes are a length between the pivots.
            places::pivots(&context, ground, &rolling.lengths, &mut places);
        }
        let drivers = guides.as_ref().map(|g| drivers::drivers(&context, g, &rolling, faults));
        let moving = guides.as_ref().zip(drivers.as_ref());
        let loads =
            moving.map(|(guides, drivers)| loads::loads(&context, (guides, drivers), faults));
        let find = ground.map(|_| find::find(&context, faults));
        if let (Some(drivers), Some(find)) = (&drivers, &find) {
            free::centres(&context, (&mut rolling, drivers, find), &mut places, &lengths, faults);
        }
        lengths.extend(rolling.lengths);
        let composite = composite::composite(&context, faults);
        let attempts = attempts::attempts(&context, faults);
        let book = answers::book(raw, faults);
        let paper = paper::paper(raw, &values, &book, faults);
        let length_unit = lengths::unit(&context);
        let (language, notation) = (paper::language(raw, faults), paper::notation(raw, faults));
        let statement = statement::statement(raw, &parameters, &values, source, faults);
        faults.list.extend(values.unused(&raw.parameters));
        let points = points
            .iter()
            .zip(places)
            .zip(sketch)
            .map(|((p, place), sketch)| NamedPoint { place, sketch, ..p.clone() })
            .collect();
        Scene {
            title: localized(&raw.title).unwrap_or_default(),
            statement,
            parameters,
            points,
            links: links.clone(),
            ground: (*ground)?,
            guides: guides?.into_iter().map(|g| g.0).chain(rolling.guides).collect(),
            cams: Vec::new(),
            rolling: rolling.rolling,
            lengths,
            drivers: drivers?,
            loads: loads?,
            sides,
            find: find?,
            composite,
            attempts,
            readings: raw.readings.iter().map(|w| w.text.clone()).collect(),
            language,
            notation,
            paper,
            length_unit,
            book,
            source: None,
        }
    };
    composite::judged(&scene, faults);
    Some(scene)
}

/// Returns the pencil error of a quantity outside a scene, in mm.
pub(super) fn pencil(quantity: &RawQuantity, source: &str, faults: &mut Faults) -> Option<f64> {
    let (values, _) = Values::new(source, &[], &[], faults);
    paper::pencil_mm(quantity, &values, faults)
}

pub(super) fn width(quantity: &RawQuantity, source: &str, faults: &mut Faults) -> Option<f64> {
    let (values, _) = Values::new(source, &[], &[], faults);
    paper::width_mm(quantity, &values, faults)
}

/// Returns a text in both languages; a text in one language serves for both.
pub(super) fn localized(raw: &Option<RawLocalized>) -> Option<Both> {
    let raw = raw.as_ref()?;
    let text = |word: &Option<Word>| word.as_ref().map(|w| w.text.clone());
    let en = text(&raw.en).or_else(|| text(&raw.zh))?;
    let zh = text(&raw.zh).unwrap_or_else(|| en.clone());
    Some(Both { en, zh })
}
