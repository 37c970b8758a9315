//! The choice of variants: values are drawn without replacement from the product of the grids, and
//! each pose is judged by the solution of its scene.

use super::grid::{ParameterGrid, grids};
use super::keys::key;
use super::{HomeworkRequest, HomeworkVariant, KeyEntry, MOST_VARIANTS};
use crate::diag::{Both, Diagnostic, Faults, Warned, both};
use crate::problem::range::RangeFault;
use crate::problem::{self, Options, Problem, Solved, Verdict};
use crate::report::statement;
use crate::scene::{Kind, Lang, Scene, edit};
use crate::worked::Worked;
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use std::collections::BTreeMap;

/// Largest tolerance of a reading, as a part of it: a length on paper of some ten pencil errors.
const READABLE: f64 = 0.1;
/// Poses that are tried for each variant, and in addition.
const TRIES_EACH: u64 = 10;
const TRIES_MORE: u64 = 50;

/// The reason why a pose is no variant.
enum Refused {
    /// The scene cannot be read or solved with these values.
    Impossible,
    /// A crossing under less than 10°, a singular pose, or a question without a finite answer.
    NearSingular,
    /// A reading of this question is not well above the tolerance.
    Unreadable(String),
    /// All answers agree with those of another variant within the tolerances.
    Equal,
}

/// The number of poses that were refused, for each reason.
#[derive(Default)]
struct RefusalCount {
    tried: u64,
    impossible: u64,
    singular: u64,
    unreadable: BTreeMap<String, u64>,
    equal: u64,
}

/// Returns the variants of a scene.
///
/// ```
/// use hodograph::homework::{HomeworkRequest, variants};
/// use hodograph::problem::templates;
/// let text = templates::text("crank-rocker", &[])?;
/// let vary = ["phi_1=20..160/10".to_owned()];
/// let request = HomeworkRequest { vary: &vary, count: 2, seed: 7, students: &[] };
/// let all = variants(&text, &request).unwrap().value;
/// assert_eq!((all.len(), all[0].key[0].question.as_str()), (2, "v_C"));
/// # Ok::<(), hodograph::diag::Faults>(())
/// ```
///
/// # Errors
/// `variants` if there are fewer than wanted, with the number of poses refused for each reason;
/// faults of the scene and of the ranges.
pub fn variants(
    text: &str,
    request: &HomeworkRequest,
) -> Result<Warned<Vec<HomeworkVariant>>, RangeFault> {
    let base = solved(text).map_err(RangeFault::Scene)?;
    let Some((scene, worked)) = base.mechanism() else {
        let message = both!("variants are made of a mechanism");
        return Err(RangeFault::Scene(Diagnostic::error("not-a-scene", message).into()));
    };
    let grids = grids(scene, request.vary)?;
    let stated = !grids.is_empty() && states_quantities(scene);
    let zeros = zeros(worked);
    drop(base);
    let count = request.count.clamp(1, MOST_VARIANTS);
    let total = grids.iter().fold(1_u64, |all, g| all.saturating_mul(g.count));
    let tries = total.min(TRIES_EACH * count as u64 + TRIES_MORE);
    let (mut out, mut refused) = (Vec::<HomeworkVariant>::new(), RefusalCount::default());
    let mut order = ShuffledOrder::new(total, request.seed);
    while out.len() < count && refused.tried < tries {
        refused.tried += 1;
        let values = values(&grids, order.take());
        match candidate(text, &values, &zeros, &out) {
            Ok(mut variant) => {
                variant.number = out.len() + 1;
                variant.student = request.students.get(out.len()).cloned();
                out.push(variant);
            }
            Err(Refused::Impossible) => refused.impossible += 1,
            Err(Refused::NearSingular) => refused.singular += 1,
            Err(Refused::Unreadable(find)) => *refused.unreadable.entry(find).or_default() += 1,
            Err(Refused::Equal) => refused.equal += 1,
        }
    }
    if out.len() < count {
        return Err(RangeFault::Scene(too_few(out.len(), count, &refused, total).into()));
    }
    let notes = stated.then(statement_left_out).into_iter().collect();
    Ok(Warned { value: out, notes })
}

fn solved(text: &str) -> Result<Solved, Faults> {
    problem::solve(&problem::read(text)?.value, &Options::with_figures())
}

/// Returns the values with an index in the product of the grids.
fn values(grids: &[ParameterGrid], index: u64) -> Vec<(String, String)> {
    let mut rest = index;
    let mut of = |g: &ParameterGrid| {
        let k = rest % g.count;
        rest /= g.count;
        (g.name.clone(), g.value(k))
    };
    grids.iter().map(&mut of).collect()
}

/// Returns the questions whose answer is exactly zero.
fn zeros(worked: &Worked) -> Vec<usize> {
    worked.results.iter().filter(|r| r.value().magnitude() == 0.0).map(|r| r.find).collect()
}

fn candidate(
    text: &str,
    values: &[(String, String)],
    zeros: &[usize],
    others: &[HomeworkVariant],
) -> Result<HomeworkVariant, Refused> {
    let pairs: Vec<(&str, &str)> = values.iter().map(|(n, v)| (n.as_str(), v.as_str())).collect();
    let text = edit::with_parameters(text, &pairs).map_err(|_| Refused::Impossible)?;
    let Ok(Warned { value: Problem::Scene(mut scene), .. }) = problem::read(&text) else {
        return Err(Refused::Impossible);
    };
    if !values.is_empty() && states_quantities(&scene) {
        scene.statement = None;
    }
    let solved = problem::solve(&Problem::Scene(scene), &Options::with_figures())
        .map_err(|_| Refused::Impossible)?;
    let (scene, worked) = solved.mechanism().ok_or(Refused::Impossible)?;
    judged(scene, worked, solved.verdict(), zeros)?;
    let key = key(scene, worked);
    if others.iter().any(|o| agree(&o.key, &key)) {
        return Err(Refused::Equal);
    }
    Ok(HomeworkVariant { number: 0, student: None, values: values.to_vec(), text, solved, key })
}

fn judged(
    scene: &Scene,
    worked: &Worked,
    verdict: Verdict,
    zeros: &[usize],
) -> Result<(), Refused> {
    let singular = |r: &crate::worked::Outcome| {
        r.next_order.is_some() || r.longer.is_some() || !r.others.is_empty()
    };
    if verdict != Verdict::Answered
        || !worked.bad_angles.is_empty()
        || !worked.at_infinity.is_empty()
        || worked.results.iter().any(singular)
    {
        return Err(Refused::NearSingular);
    }
    let by_hand = worked.by_hand(scene);
    for r in &worked.results {
        let find = &scene.find[r.find];
        let Some(tolerance) = by_hand.tolerances.get(r.find).and_then(Option::as_ref) else {
            continue;
        };
        // Coordinates and angles have an arbitrary zero: their tolerance counts as it is.
        let anywhere = matches!(find.what.kind(), Kind::Length | Kind::Angle);
        let readable = match tolerance.relative {
            Some(relative) => relative <= READABLE,
            None => anywhere || zeros.contains(&r.find),
        };
        if !readable {
            return Err(Refused::Unreadable(find.text.clone()));
        }
    }
    Ok(())
}

/// True if no answer tells two variants apart.
fn agree(a: &[KeyEntry], b: &[KeyEntry]) -> bool {
    a.len() == b.len()
        && a.iter().zip(b).all(|(a, b)| (a.value - b.value).abs() <= a.tolerance + b.tolerance)
}

/// The numbers below a limit in random order, without replacement (Fisher and Yates), of which only
/// those that were taken are kept.
struct ShuffledOrder {
    rest: u64,
    moved: BTreeMap<u64, u64>,
    rng: Pcg64Mcg,
}

impl ShuffledOrder {
    fn new(total: u64, seed: u64) -> ShuffledOrder {
        ShuffledOrder { rest: total, moved: BTreeMap::new(), rng: Pcg64Mcg::seed_from_u64(seed) }
    }

    fn take(&mut self) -> u64 {
        let at = self.rng.next_u64() % self.rest.max(1);
        self.rest = self.rest.saturating_sub(1);
        let taken = self.moved.get(&at).copied().unwrap_or(at);
        let last = self.moved.remove(&self.rest).unwrap_or(self.rest);
        if at != self.rest {
            self.moved.insert(at, last);
        }
        taken
    }
}

fn too_few(found: usize, count: usize, refused: &RefusalCount, total: u64) -> Diagnostic {
    let mut reasons: Vec<Both> = Vec::new();
    if refused.impossible > 0 {
        reasons.push(both!("{} cannot be assembled or solved", refused.impossible));
    }
    if refused.singular > 0 {
        reasons.push(both!("{} are near-singular", refused.singular));
    }
    for (find, n) in &refused.unreadable {
        reasons.push(both!("{n} give {find} too short to be read"));
    }
    if refused.equal > 0 {
        reasons.push(both!("{} have the answers of another variant", refused.equal));
    }
    let reasons = match reasons[..] {
        [] => Both::default(),
        _ => both!(": {}", Both::join(&reasons, [", ", "，"])),
    };
    let message = both!(
        "{found} of {count} variants were found in {} of {total} poses{}",
        refused.tried,
        reasons
    );
    Diagnostic::error("variants", message).help(both!(
        "widen the ranges of --vary, make the steps smaller, or ask for fewer variants; a question that is too short everywhere is better left out of \"find\""
    ))
}

/// True if the statement contains quantities, which may differ in the variants.
fn states_quantities(scene: &Scene) -> bool {
    let paragraphs =
        [Lang::En, Lang::Zh].into_iter().flat_map(|lang| statement::paragraphs(scene, lang));
    paragraphs.into_iter().any(|p| has_quantity(&p.plain()))
}

/// True if a text has a number with a unit or a decimal point.
fn has_quantity(text: &str) -> bool {
    let chars: Vec<char> = text.chars().collect();
    (0..chars.len()).any(|k| {
        let begins = chars[k].is_ascii_digit()
            && (k == 0 || !chars[k - 1].is_alphanumeric() && chars[k - 1] != '.');
        if !begins {
            return false;
        }
        let rest: String = chars[k..].iter().collect();
        let after = rest.trim_start_matches(|c: char| c.is_ascii_digit() || c == '.');
        let after = after.trim_start_matches([' ', '\u{a0}', '\u{202f}']);
        let unit = after.split(|c: char| !c.is_alphabetic() && c != '°').next().unwrap_or("");
        ["mm", "cm", "m", "rad", "rpm", "r", "deg", "°", "N", "s", "in", "ft"].contains(&unit)
    })
}

fn statement_left_out() -> Diagnostic {
    let message =
        both!("the statement contains numbers: the variants leave it out and list what is given");
    Diagnostic::warning("variants-statement", message).help(both!(
        "write the statement without numbers; each sheet lists the given data of its variant"
    ))
}
