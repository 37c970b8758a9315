//! What a sheet says of its own worth: crossings under a bad angle with what helps, what its tolerances are, and what is
//! singular in its pose.

use crate::accuracy::BadAngle;
use crate::analytic::SingularKind;
use crate::digits::{shortest, significant};
use crate::mechanism::Core;
use crate::plan::text::{point_label, vertex_name};
use crate::report::phrase::{Phrase, fill};
use crate::scene::Scene;
use crate::worked::{Outcome, Worked};

use super::results::{Answers, amount, number, sense, symbol};
use super::sheet::driver_symbol;
use super::tables::constraint_line;
use super::words::Words;

/// The remarks, one a line.
pub(crate) fn remarks(answers: &Answers) -> Vec<Phrase> {
    let Answers { scene, worked, words, .. } = *answers;
    let mut lines = singular(answers);
    if let Some(d) = &worked.drafting {
        lines.push(fill(words.by_hand, &[("", &shortest(d.pencil_mm))]));
    }
    for bad in &worked.bad_angles {
        lines.extend(bad_angle(scene, worked, words, bad));
    }
    lines.iter().map(|l| Phrase::new(l)).collect()
}

/// What is singular in the pose, and the first answer that is another on the other motion; all of them `solve` tells.
fn singular(answers: &Answers) -> Vec<String> {
    let Answers { scene, worked, certified, notation, words, digits } = *answers;
    let mut lines = Vec::new();
    for s in &worked.solution.singular {
        let links: Vec<&str> = s.named.iter().map(|l| scene.link_name(*l)).collect();
        let text = match s.kind {
            SingularKind::ChangePoint => words.change_point,
            SingularKind::Limit => words.driver_at_limit,
            SingularKind::Rest => words.at_rest,
        };
        lines.push(fill(text, &[("", &links.join(words.comma))]));
    }
    let differs = |r: &Outcome| r.others.first().copied().filter(|v| *v != r.value());
    if let Some((r, c, other)) = worked.results.iter().zip(certified).find_map(|(r, c)| Some((r, c, differs(r)?))) {
        let find = &scene.find[r.find];
        let sense = sense(find, other, c, words, digits).plain();
        let value = format!("${} = {}$ {sense}", symbol(find, notation), amount(&scene.book, find, other, c, digits));
        lines.push(fill(words.other_motion, &[("", value.trim_end())]));
    }
    lines
}

/// One crossing, and below it each thing that helps. Angles and lengths are told to two digits, for they are advice.
fn bad_angle(scene: &Scene, worked: &Worked, words: &Words, bad: &BadAngle) -> Vec<String> {
    let two = |x: f64| significant(x, 2).replace('-', "−");
    let name = point_label(&vertex_name(scene, &worked.plan, bad.crossing.target));
    let angle = format!("{}\\degree", number(bad.crossing.angle_deg(), 2));
    let moves = bad.crossing.moves_on_paper_mm().map_or(words.off_paper.into(), |mm| fill(words.by_mm, &[("", &two(mm))]));
    let mut lines = vec![fill(words.bad_angle, &[("1", &angle), ("2", &shortest(bad.pencil_mm)), ("3", &moves), ("", &name)])];
    if let Some(factor) = bad.larger {
        lines.push(fill(words.bad_larger, &[("", &shortest(factor))]));
    }
    if let Some(p) = bad.special
        && let Core::Link { link, legs } = &worked.mechanism.groups[p.group].core
    {
        let [a, b] = [p.legs.0, p.legs.1].map(|k| constraint_line(scene, words, &legs[k]));
        lines.push(fill(words.bad_special, &[("1", &a), ("2", &b), ("3", &two(p.worst_deg)), ("", scene.link_name(*link))]));
    }
    if let Some(p) = bad.pose {
        let (text, turn) = p.to_deg.map_or((words.bad_turn, p.turn_deg), |to| (words.bad_pose, to));
        let (driver, turn) = (driver_symbol(scene, p.driver).0, shortest(turn).replace('-', "−"));
        lines.push(fill(text, &[("driver", &driver), ("", &turn), ("1", &two(p.crossing_deg))]));
    }
    lines
}
