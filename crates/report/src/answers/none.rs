//! Questions without an answer: the words printed instead of the number, and the reason.

use hodograph_analytic::{RefusalReason as Refusal, RefusedPart};
use hodograph_paper::paper::phrase::tr;
use hodograph_scene::{Lang, Scene};
use hodograph_worked::worked::{NoAnswer, Unanswered};

/// Returns the words printed instead of a missing answer.
pub fn verdict(u: &Unanswered, lang: Lang) -> &'static str {
    match &u.why {
        NoAnswer::NoValue(_) => tr(lang, "not defined", "无定义"),
        NoAnswer::Infinite(_) => "∞",
        NoAnswer::NoMotion(refused) => match refused.why {
            Refusal::DeadPoint => tr(lang, "unbounded", "无界"),
            Refusal::Locked => tr(lang, "no motion", "不能运动"),
            Refusal::Loose | Refusal::Several | Refusal::NoAcceleration => {
                tr(lang, "not determined", "不确定")
            }
        },
    }
}

/// Returns the reason why a question has no answer, with the links.
pub fn reason(scene: &Scene, u: &Unanswered, lang: Lang) -> String {
    let RefusedPart { why, named, words, .. } = match &u.why {
        NoAnswer::NoMotion(refused) => &**refused,
        NoAnswer::NoValue(words) | NoAnswer::Infinite(words) => {
            return match lang {
                Lang::En => words.en.clone(),
                Lang::Zh => words.zh.clone(),
            };
        }
    };
    let names: Vec<_> = named.iter().map(|l| scene.link_name(*l)).collect();
    match (lang, why) {
        (Lang::En, Refusal::DeadPoint) => format!("dead centre: {}", words.en),
        (Lang::En, _) => words.en.clone(),
        (Lang::Zh, Refusal::DeadPoint) => format!("构件 {} 处于死点位置", names.join("、")),
        (Lang::Zh, Refusal::Locked) => format!("构件 {} 在该位置被锁住", names.join("、")),
        (Lang::Zh, Refusal::Loose | Refusal::Several) => {
            format!("构件 {} 在该位置有多余的自由度", names.join("、"))
        }
        (Lang::Zh, Refusal::NoAcceleration) => {
            format!("构件 {} 在该位置的加速度不确定", names.join("、"))
        }
    }
}
