//! Questions without an answer: the words printed instead of the number, and the reason.

use hodograph_analytic::{RefusalReason as Refusal, RefusedPart};
use hodograph_base::lang::{tr, zh_format};
use hodograph_scene::{Lang, Scene};
use hodograph_worked::worked::{NoAnswer, Unanswered};

/// Returns the words printed instead of a missing answer.
pub fn verdict(u: &Unanswered, lang: Lang) -> &'static str {
    match &u.why {
        NoAnswer::NoValue(_) => tr!(lang, "not defined"),
        NoAnswer::Infinite(_) => "∞",
        NoAnswer::NoMotion(refused) => match refused.why {
            Refusal::DeadPoint => tr!(lang, "unbounded"),
            Refusal::Locked => tr!(lang, "no motion"),
            Refusal::Loose | Refusal::Several | Refusal::NoAcceleration => {
                tr!(lang, "motion" => "not determined")
            }
        },
    }
}

/// Returns the reason why a question has no answer, with the links.
pub fn reason(scene: &Scene, u: &Unanswered, lang: Lang) -> String {
    let RefusedPart { why, named, words, .. } = match &u.why {
        NoAnswer::NoMotion(refused) => &**refused,
        NoAnswer::NoValue(words) | NoAnswer::Infinite(words) => {
            return lang.of(words).to_owned();
        }
    };
    let names: Vec<_> = named.iter().map(|l| scene.link_name(*l)).collect();
    let links = names.join("、");
    match (lang, why) {
        (Lang::En, Refusal::DeadPoint) => format!("dead centre: {}", words.en),
        (Lang::En, _) => words.en.clone(),
        (Lang::Zh, Refusal::DeadPoint) => zh_format!("links {links} are in a dead centre"),
        (Lang::Zh, Refusal::Locked) => zh_format!("links {links} are locked"),
        (Lang::Zh, Refusal::Loose | Refusal::Several) => {
            zh_format!("links {links} have a freedom too many")
        }
        (Lang::Zh, Refusal::NoAcceleration) => {
            zh_format!("the accelerations of links {links} are not determined")
        }
    }
}
