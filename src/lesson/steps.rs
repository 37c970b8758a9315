//! The sentences of each step of the construction, and the answers, in all frames.

use crate::budget::here;
use hodograph_base::lang::tr;
use serde_json::{Value, json};

use rayon::prelude::*;

use crate::certified::ladder::Certified;
use crate::certified::{CertifiedSteps, certify, steps as certified_steps};
use crate::equilibrium::GroupForces;
use crate::figure::results::DIGITS;
use crate::notation::Notation;
use crate::paper::phrase::Phrase;
use crate::paper::words::words;
use crate::plan::text::PlanWriter;
use crate::report::amount::{amount, sense, symbol};
use crate::report::construction::sentences;
use crate::report::forces::ForceWriter;
use crate::scene::{DiagramKind, Lang, LinkId, Swept, driver_position};

use super::bank::{self, Formulas};
use super::frames::{Frames, SolvedFrame};
use super::scenery::Shows;

/// Both languages of the page.
pub const LANGS: [Lang; 2] = [Lang::En, Lang::Zh];

/// The steps after those of the mechanism: the key of the drawing, the index of the action in its
/// polygon (−1 for the pole), and the sentences in English and Chinese.
pub fn steps(frames: &Frames, notation: &Notation, formulas: &mut Formulas) -> Vec<Value> {
    let mut steps = Vec::new();
    let here = here();
    let told: Vec<CertifiedSteps> = frames
        .list
        .par_iter()
        .map(|f| here.enter(|| certified_steps(&f.scene, &f.worked, None)))
        .collect();
    for on in DiagramKind::POLYGONS {
        let of = |lang| {
            frames
                .list
                .iter()
                .zip(&told)
                .map(|(f, t)| polygon_sentences(f, t, on, notation, lang))
                .collect::<Vec<_>>()
        };
        let split = frames.split.of(on.kind());
        let shows = |n: usize| Shows { on, part: split.map(|s| s.part_of(n.checked_sub(1))) };
        listed(LANGS.map(of), shows, formulas, &mut steps);
    }
    for (group, links) in frames.groups.iter().enumerate() {
        let of = |lang| {
            frames
                .list
                .iter()
                .map(|f| group_sentences(f, links, notation, lang))
                .collect::<Vec<_>>()
        };
        listed(
            LANGS.map(of),
            |_| Shows { on: DiagramKind::Force, part: Some(group) },
            formulas,
            &mut steps,
        );
    }
    steps
}

/// Adds the steps of one list: for each language and frame its sentences.
fn listed(
    mut said: [Vec<Vec<String>>; 2],
    shows: impl Fn(usize) -> Shows,
    formulas: &mut Formulas,
    steps: &mut Vec<Value>,
) {
    let count = said[0].iter().map(Vec::len).max().unwrap_or(0);
    // A pose in which fewer vectors are drawn gets a sentence for the steps of the others, too.
    for (lang, frames) in LANGS.into_iter().zip(&mut said) {
        let rest = tr!(lang, "In this position nothing more is drawn.");
        frames.iter_mut().filter(|s| !s.is_empty()).for_each(|s| s.resize(count, rest.to_owned()));
    }
    for n in 0..count {
        let [en, zh] = in_both(|l| said[l].iter().map(|s| s.get(n).cloned()).collect(), formulas);
        steps.push(json!([shows(n).key(), n as i64 - 1, en, zh]));
    }
}

/// Sentences in English and in Chinese; numbers that are the same in both are stored once.
fn in_both(said: impl Fn(usize) -> Vec<Option<String>>, formulas: &mut Formulas) -> [Value; 2] {
    let [en, mut zh] = [0, 1].map(|l| bank::packed_sentences(&said(l), formulas));
    if en[2] == zh[2] {
        zh[2] = json!(0);
    }
    [en, zh]
}

fn polygon_sentences(
    frame: &SolvedFrame,
    told: &CertifiedSteps,
    on: DiagramKind,
    notation: &Notation,
    lang: Lang,
) -> Vec<String> {
    let Some(p) = frame.worked.construction.polygon(on).filter(|_| !frame.end) else {
        return Vec::new();
    };
    let w = PlanWriter { scene: &frame.scene, plan: &frame.worked.plan, notation, lang };
    sentences(&w, &frame.worked.construction, p, told).iter().map(Phrase::source).collect()
}

/// The sentences of a group's equilibrium in a frame; none where the pose does not draw it.
fn group_sentences(
    frame: &SolvedFrame,
    links: &[LinkId],
    notation: &Notation,
    lang: Lang,
) -> Vec<String> {
    let Some((w, group)) = writer(frame, links, notation, lang) else { return Vec::new() };
    w.steps(group).iter().map(Phrase::source).collect()
}

/// The writer of a group's forces in a frame that shows them.
pub(super) fn writer<'a>(
    frame: &'a SolvedFrame,
    links: &[LinkId],
    notation: &'a Notation,
    lang: Lang,
) -> Option<(ForceWriter<'a>, &'a GroupForces)> {
    let of =
        frame.worked.equilibrium.as_ref().filter(|_| frame.shown.contains(&DiagramKind::Force))?;
    Some((ForceWriter { scene: &frame.scene, notation, lang, of }, of.group_of(links)?))
}

/// The answers: for each question its value in all frames, English and Chinese.
pub fn answers(
    frames: &Frames,
    swept: Swept,
    notation: &Notation,
    formulas: &mut Formulas,
) -> Vec<Value> {
    let here = here();
    let certified: Vec<Vec<Certified>> =
        frames.list.par_iter().map(|f| here.enter(|| certified(f, swept))).collect();
    let finds = frames.list.first().map_or(0, |f| f.scene.find.len());
    (0..finds)
        .map(|i| {
            let said = |l: usize| {
                frames
                    .list
                    .iter()
                    .zip(&certified)
                    .map(|(f, c)| answer(f, c, i, notation, LANGS[l]))
                    .collect()
            };
            let [en, zh] = in_both(said, formulas);
            json!([en, zh])
        })
        .collect()
}

/// The certified digits. Where a pose is given by coordinates, only the scene's own pose is written
/// down; the others are not certified.
pub(super) fn certified(frame: &SolvedFrame, swept: Swept) -> Vec<Certified> {
    if frame.end {
        return Vec::new();
    }
    let said = |d: usize| driver_position(&frame.scene, d).is_some();
    let told = match swept {
        Swept::Driver(d) => said(d),
        Swept::Time => (0..frame.scene.drivers.len()).all(said),
    };
    let told = told || frame.travel == 0.0;
    let mut list = certify(&frame.scene, &frame.worked, DIGITS);
    if !told {
        list.iter_mut().for_each(|c| (c.parts, c.reading) = (Vec::new(), None));
    }
    list
}

pub(super) fn answer(
    frame: &SolvedFrame,
    certified: &[Certified],
    i: usize,
    notation: &Notation,
    lang: Lang,
) -> Option<String> {
    // At a dead centre some questions have no answer.
    let (r, c) = frame.worked.results.iter().zip(certified).find(|(r, _)| r.find == i)?;
    let find = &frame.scene.find[r.find];
    let sense = sense(find, r.value(), c, words(lang), DIGITS).plain();
    Some(
        format!(
            "${} = {}$ {sense}",
            symbol(find, notation),
            amount(&frame.scene.book, find, r.value(), c, DIGITS)
        )
        .trim_end()
        .to_owned(),
    )
}
