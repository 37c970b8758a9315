//! Mobility (degrees of freedom) as text and JSON: the counts with reasons, redundant constraints,
//! Assur groups from the far end.

use super::plan::{dyad, grade, group_words};
use super::replaced;
use hodograph_base::diag::{Both, both};
use hodograph_base::digits::minus;
use hodograph_base::lang::{say, tr};
use hodograph_board::plan::names::name_label;
use hodograph_mechanism::mechanism::{
    Assur, Counts, ForDrivers, Local, MobilitySurvey, Opened, PairItem,
};
use hodograph_mechanism::position::redundant::{
    Checked, RedundancyVerdict, RepeatReason, by_topology, look, opened_words,
};
use hodograph_paper::paper::phrase::Phrase;
use hodograph_scene::{GuideId, Lang, PointId, Rolling, Scene};
use serde_json::{Value as Json, json};

/// The known state of a redundant pair.
#[derive(Clone, Copy, PartialEq, Eq)]
enum RedundantState {
    Repeats,
    Locks,
    Open,
}

fn known(checked: Option<&Checked>) -> RedundantState {
    match checked.map(|c| c.verdict) {
        Some(RedundancyVerdict::Virtual | RedundancyVerdict::Almost) => RedundantState::Repeats,
        Some(RedundancyVerdict::Shaky | RedundancyVerdict::Locked) => RedundantState::Locks,
        None => RedundantState::Open,
    }
}

/// Largest number of drivers that is tried if the file has none and the count requires fewer.
const MOST_DRIVERS: usize = 4;

/// Returns the number of equations that are certainly redundant, and of those that may be.
fn repeated(survey: &MobilitySurvey, checked: &[Option<Checked>]) -> (usize, usize) {
    let of = |wanted: RedundantState| {
        let all =
            survey.redundant().iter().zip(checked).filter(|(_, c)| known(c.as_ref()) == wanted);
        all.map(|(r, _)| r.equations).sum()
    };
    (of(RedundantState::Repeats), of(RedundantState::Open))
}

/// Returns the counts and the checks of redundant pairs by the lengths.
///
/// With redundant pairs the count does not determine the number of drivers: as long as a further
/// driver moves the mechanism with its redundant pairs, it is one of the degrees of freedom.
pub fn surveyed(scene: &Scene) -> (MobilitySurvey, Vec<Option<Checked>>) {
    let mut survey = MobilitySurvey::of(scene);
    let mut found = checked(&survey);
    if scene.drivers.is_empty() && survey.choices.is_empty() {
        // By count alone the mechanism has too few degrees of freedom: redundant pairs are found
        // only with all drivers present.
        let more =
            (2..=MOST_DRIVERS).map(|drivers| (drivers, MobilitySurvey::driven_by(scene, drivers)));
        let mut sure = more
            .filter(|(_, s)| !s.choices.is_empty())
            .map(|(drivers, s)| (drivers, checked(&s), s));
        let moves = |verdicts: &[Option<Checked>]| {
            verdicts.iter().all(|c| known(c.as_ref()) == RedundantState::Repeats)
        };
        if let Some((_, verdicts, s)) = sure.find(|(drivers, verdicts, s)| {
            moves(verdicts) && freedom(s, verdicts) == *drivers as i64
        }) {
            (survey, found) = (s, verdicts);
        }
    }
    while scene.drivers.is_empty() && !found.is_empty() {
        let drivers = survey.choices.first().map_or(0, |c| c.scene.drivers.len());
        let more = MobilitySurvey::driven_by(scene, drivers + 1);
        let verdicts = checked(&more);
        if more.choices.is_empty() || freedom(&more, &verdicts) != drivers as i64 + 1 {
            break;
        }
        (survey, found) = (more, verdicts);
    }
    let apart = not_kept_apart(&survey);
    if apart > 0 {
        survey.counts.higher += apart;
        (survey.choices, found) = (Vec::new(), Vec::new());
    }
    (survey, found)
}

/// Number of gear pairs with a centre distance that other pairs change.
fn not_kept_apart(survey: &MobilitySurvey) -> usize {
    let Some(first) = survey.choices.first() else { return 0 };
    let looked = |opened: &Opened| {
        survey.choices.iter().find_map(|c| look(&c.scene, &c.mechanism, opened).ok())
    };
    first
        .mechanism
        .kept_apart(&first.scene)
        .filter(|g| known(looked(&Opened::Guide(*g)).as_ref()) == RedundantState::Locks)
        .count()
}

/// Returns the check by the lengths of each pair that is redundant by topology; `None` if lengths
/// are missing.
fn checked(survey: &MobilitySurvey) -> Vec<Option<Checked>> {
    let Some(first) = survey.choices.first() else { return Vec::new() };
    let (scene, m) = (&first.scene, &first.mechanism);
    // Independent of the drivers: if one choice of drivers does not determine the pose, another
    // may.
    let looked = |opened: &Opened| {
        survey.choices.iter().find_map(|c| {
            c.mechanism.is_opened(opened).then(|| look(&c.scene, &c.mechanism, opened).ok())?
        })
    };
    survey
        .redundant()
        .iter()
        .map(|r| looked(&r.opened).or_else(|| by_topology(scene, m, &r.opened)))
        .collect()
}

/// Degree of freedom F, as far as it is known.
fn freedom(survey: &MobilitySurvey, checked: &[Option<Checked>]) -> i64 {
    survey.counts.freedom(repeated(survey, checked).0, survey.local.len())
}

/// Returns the reason why a pair is redundant, or what is known of it.
fn repeats_words(survey: &MobilitySurvey, i: usize, checked: Option<&Checked>) -> Both {
    let Some(first) = survey.choices.first() else { return Both::default() };
    let (scene, m) = (&first.scene, &first.mechanism);
    let (what, _) = opened_words(scene, &m.redundant[i].opened);
    match checked {
        Some(c) if known(checked) == RedundantState::Repeats => {
            both!("{}: {}", what, c.reason.words(scene, c.positions))
        }
        Some(Checked { reason: reason @ RepeatReason::Triangle(_), positions, .. }) => {
            both!("{} is none: {}", what, reason.words(scene, *positions))
        }
        Some(Checked { verdict: RedundancyVerdict::Shaky, off_m, .. }) => {
            let off = scene.length_words(*off_m);
            both!(
                "{} is none: shaky, mobile to first order, it locks at a finite turn, off by {off}",
                what
            )
        }
        Some(c) => {
            let off = scene.length_words(c.off_m);
            both!("{} is none: it locks the mechanism, off by {off}", what)
        }
        None => both!("{} may be one: lengths decide", what),
    }
}

fn local_words(l: &Local) -> Both {
    if l.bare {
        return both!("pin {} turns in its slots without moving anything", l.pin);
    }
    both!("link {} turns about {} alone and moves nothing else", l.link, l.pin)
}

/// Returns F = 3n − (2 p_l + p_h − p′) − F′ with its numbers.
fn formula(c: &Counts, repeated: usize, local: usize) -> String {
    let Counts { moving, lower, higher } = *c;
    let f = minus(&c.freedom(repeated, local).to_string());
    format!(
        "F = 3n − (2p_l + p_h − p′) − F′ = 3·{moving} − (2·{lower} + {higher} − {repeated}) − {local} = {f}"
    )
}

fn class_of(class: &'static str, lang: Lang) -> &'static str {
    if lang == Lang::Zh { grade(class) } else { class }
}

/// Returns the class of a mechanism for a choice of drivers: `II`, `Ⅱ级`.
pub fn class(choice: &ForDrivers, lang: Lang) -> &'static str {
    class_of(choice.class(), lang)
}

/// Returns the groups for a choice of drivers from the far end, each by class and kind:
/// `II RRR, III`.
pub fn kinds(choice: &ForDrivers, lang: Lang) -> String {
    let kind = |g: &Assur| {
        let class = class_of(g.class().unwrap_or_default(), lang);
        dyad(g).map_or(class.to_owned(), |kind| format!("{class} {kind}"))
    };
    let replaced = choice.replaced();
    let groups = replaced.as_ref().unwrap_or(choice).from_the_far_end();
    groups.iter().map(kind).collect::<Vec<_>>().join(lang.comma())
}

/// The counts of a scene, with all reasons.
pub struct Counted {
    /// The counts and the groups.
    pub survey: MobilitySurvey,
    checked: Vec<Option<Checked>>,
    /// Number of virtual constraints proved by the lengths.
    pub sure: usize,
}

impl Counted {
    /// Counts a scene; redundant pairs are checked where it has lengths.
    pub fn of(scene: &Scene) -> Counted {
        let (survey, checked) = surveyed(scene);
        let (sure, _) = repeated(&survey, &checked);
        Counted { survey, checked, sure }
    }

    /// Returns the degree of freedom, and its formula with numbers in the label language.
    pub fn formula(&self) -> (i64, String) {
        let Counts { moving, lower, higher } = self.survey.counts;
        let (repeated, local) = (self.sure, self.survey.local.len());
        let f = self.survey.counts.freedom(repeated, local);
        let text = format!(
            "F = 3n - (2p_l + p_h - p') - F' = 3 \\times {moving} - (2 \\times {lower} + {higher} - {repeated}) - {local} = {f}"
        );
        (f, text)
    }

    /// Returns the remarks on the count of lower pairs, with points as formulas.
    pub fn lower(&self, scene: &Scene, lang: Lang) -> Vec<Phrase> {
        lower_set(scene, &self.survey.compound, lang)
    }

    /// Returns the local degrees of freedom.
    pub fn local(&self) -> Vec<Both> {
        self.survey.local.iter().map(local_words).collect()
    }

    /// Returns the redundant pairs with their reasons.
    pub fn repeats(&self) -> Vec<Both> {
        self.checked
            .iter()
            .enumerate()
            .map(|(i, c)| repeats_words(&self.survey, i, c.as_ref()))
            .collect()
    }

    /// Returns the counts without local degrees of freedom and virtual constraints, with higher
    /// pairs replaced by lower ones.
    pub fn substituted(&self) -> Counts {
        self.survey.substituted(|i| {
            self.checked.get(i).is_some_and(|c| known(c.as_ref()) != RedundantState::Locks)
        })
    }
}

fn compound_words(name: &str, links: usize) -> Both {
    both!("{name} joins {links} links: compound hinge, {} pairs", links - 1)
}

/// Returns the reasons for the count of lower pairs: pins of more than two links, and rolling
/// without slipping.
fn lower_words(
    scene: &Scene,
    compound: &[(PointId, usize)],
    point: impl Fn(&str) -> String,
) -> Vec<Both> {
    let hinges =
        compound.iter().map(|(p, links)| compound_words(&point(scene.point_name(*p)), *links));
    let rolls = scene.rolling.iter().filter(|r| r.kind.is_lower()).map(|r| {
        let contact = point(scene.point_name(r.at[0]));
        both!("{contact}: rolling without slipping takes two freedoms and counts as a lower pair")
    });
    hinges.chain(rolls).collect()
}

/// Returns the reason why a toothed pair counts as two: no other pair keeps the distance of its
/// links.
fn doubled(scene: &Scene, survey: &MobilitySurvey) -> Vec<Both> {
    let holds = |g: GuideId| {
        survey
            .choices
            .first()
            .is_none_or(|c| c.mechanism.constraints.iter().any(|c| c.item() == PairItem::Guide(g)))
    };
    let (higher, slots) = (
        |r: &&Rolling| !r.kind.is_lower(),
        scene.guides.iter().filter(|g| g.rolling.is_none() && g.slider.is_none()).count(),
    );
    let twice: Vec<&Rolling> =
        scene.rolling.iter().filter(higher).filter(|r| r.guide().is_some_and(holds)).collect();
    // Without drivers that move the mechanism, only a count in which all of them hold is
    // conclusive.
    let all = scene.rolling.iter().filter(higher).count() + slots + twice.len();
    if survey.choices.is_empty() && (survey.counts.higher != all || !scene.cams.is_empty()) {
        return Vec::new();
    }
    twice
        .into_iter()
        .map(|r| {
            let [a, b] = r.links.map(|l| scene.link_name(l));
            both!(
                "links {a} and {b}: no other pair keeps their distance, the teeth touch on both flanks and count two"
            )
        })
        .collect()
}

/// Returns the remarks on the count of lower pairs, with points as formulas.
pub fn lower_set(scene: &Scene, compound: &[(PointId, usize)], lang: Lang) -> Vec<Phrase> {
    let told = lower_words(scene, compound, |name| format!("${}$", name_label(name)));
    told.iter().map(|b| Phrase::new(lang.of(b))).collect()
}

/// Returns the report as text.
pub fn text(
    scene: &Scene,
    survey: &MobilitySurvey,
    checked: &[Option<Checked>],
    lang: Lang,
) -> String {
    let mut out = String::new();
    let mut line = |text: String| {
        out.push_str(&text);
        out.push('\n');
    };
    let say = |b: Both| if lang == Lang::Zh { b.zh } else { b.en };
    let title = lang.of(&scene.title);
    if !title.is_empty() {
        line(title.to_owned());
    }
    let Counts { moving, lower, higher } = survey.counts;
    line(say(both!("moving links n = {moving}")));
    line(say(both!("lower pairs p_l = {lower}")));
    lower_words(scene, &survey.compound, str::to_owned)
        .into_iter()
        .for_each(|why| line(format!("  {}", say(why))));
    line(say(both!("higher pairs p_h = {higher}")));
    doubled(scene, survey).into_iter().for_each(|why| line(format!("  {}", say(why))));
    line(say(both!("local freedoms F′ = {}", survey.local.len())));
    survey.local.iter().for_each(|l| line(format!("  {}", say(local_words(l)))));
    let (sure, open) = repeated(survey, checked);
    line(say(both!("virtual constraints p′ = {sure}")));
    for (i, c) in checked.iter().enumerate() {
        line(format!("  {}", say(repeats_words(survey, i, c.as_ref()))));
    }
    line(formula(&survey.counts, sure, survey.local.len()));
    if open > 0 {
        let f = survey.counts.freedom(sure + open, survey.local.len());
        line(say(both!("F = {f} if what may repeat others does")));
    }
    let s = survey.substituted(|i| {
        checked.get(i).is_some_and(|c| known(c.as_ref()) != RedundantState::Locks)
    });
    if s != survey.counts {
        let f = s.freedom(0, 0);
        let (n, p) = (s.moving, s.lower);
        line(say(both!(
            "without these, higher pairs replaced by lower ones: n = {n}, p_l = {p}, F = 3·{n} − 2·{p} = {f}"
        )));
        let scene = survey.choices.first().map(|c| &c.scene);
        for words in scene.into_iter().flat_map(replaced::replaced_words) {
            line(format!("  {}", say(words)));
        }
    }
    let locked = checked.iter().any(|c| known(c.as_ref()) == RedundantState::Locks);
    if locked || survey.choices.is_empty() {
        line(tr!(lang, "no choice of drivers on ground moves it as they say").into());
    }
    for choice in survey.choices.iter().filter(|_| !locked) {
        line(String::new());
        line(choice_words(choice, lang));
        let replaced = choice.replaced();
        let choice = replaced.as_ref().unwrap_or(choice);
        for (i, g) in choice.from_the_far_end().iter().enumerate() {
            line(format!(
                "  {}. {}",
                i + 1,
                group_words(&choice.scene, &choice.mechanism, g, lang)
            ));
        }
    }
    out
}

fn choice_words(choice: &ForDrivers, lang: Lang) -> String {
    let names = choice.names().join(lang.comma());
    let class = class(choice, lang);
    let given = if choice.given { tr!(lang, " (given)") } else { "" };
    say!(lang, "driven by {names}{given}: mechanism of class {class}; groups from the far end")
}

/// Returns the report as JSON.
pub fn json(scene: &Scene, survey: &MobilitySurvey, checked: &[Option<Checked>]) -> Json {
    let (sure, open) = repeated(survey, checked);
    let counts = |c: &Counts| json!({"n": c.moving, "p_l": c.lower, "p_h": c.higher});
    let words = |b: Both| json!({"en": b.en, "zh": b.zh});
    let local = survey.local.len();
    let compound: Vec<Json> = survey
        .compound
        .iter()
        .map(|(p, k)| json!({"point": scene.point_name(*p), "links": k, "pairs": k - 1}))
        .collect();
    let idle: Vec<Json> = survey
        .local
        .iter()
        .map(|l| json!({"link": l.link, "pin": l.pin, "why": words(local_words(l))}))
        .collect();
    let repeats: Vec<Json> = survey
        .redundant()
        .iter()
        .zip(checked)
        .enumerate()
        .map(|(i, (r, c))| {
            json!({
                "equations": r.equations,
                "verdict": c.as_ref().map(|c| verdict(c.verdict)),
                "off_m": c.as_ref().map(|c| c.off_m),
                "positions": c.as_ref().map(|c| c.positions),
                "why": words(repeats_words(survey, i, c.as_ref())),
            })
        })
        .collect();
    let group = |choice: &ForDrivers, g: &Assur| {
        let links: Vec<&str> = g.links.iter().map(|l| choice.scene.link_name(*l)).collect();
        let pins: Vec<&str> = g.pins().into_iter().map(|p| choice.scene.point_name(p)).collect();
        json!({"class": g.class(), "kind": g.kind(), "links": links, "pins": pins})
    };
    let locked = checked.iter().any(|c| known(c.as_ref()) == RedundantState::Locks);
    let choices: Vec<Json> = survey
        .choices
        .iter()
        .filter(|_| !locked)
        .map(|c| {
            let replaced = c.replaced();
            let listed = replaced.as_ref().unwrap_or(c);
            let groups: Vec<Json> =
                listed.from_the_far_end().iter().map(|g| group(listed, g)).collect();
            json!({"drivers": c.names(), "given": c.given, "class": c.class(), "groups": groups})
        })
        .collect();
    json!({
        "counts": counts(&survey.counts),
        "F_counted": survey.counts.freedom(0, 0),
        "F_local": local,
        "p_virtual": sure,
        "F": survey.counts.freedom(sure, local),
        "F_if_virtual": (open > 0).then(|| survey.counts.freedom(sure + open, local)),
        "compound": compound,
        "local": idle,
        "virtual": repeats,
        "substituted": counts(&survey.substituted(|i| checked.get(i).is_some_and(|c| known(c.as_ref()) != RedundantState::Locks))),
        "replaced": survey.choices.first().and_then(|c| {
            c.scene.replaced(|_| None).map(|of| replaced::json(&c.scene, &of))
        }),
        "choices": choices,
    })
}

fn verdict(v: RedundancyVerdict) -> &'static str {
    match v {
        RedundancyVerdict::Virtual => "virtual",
        RedundancyVerdict::Almost => "almost-virtual",
        RedundancyVerdict::Shaky => "shaky",
        RedundancyVerdict::Locked => "locked",
    }
}
