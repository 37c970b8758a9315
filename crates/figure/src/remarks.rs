//! Remarks of a sheet on its own accuracy: intersections at a bad angle with remedies, tolerances,
//! and singularities of the pose.

use hodograph_analytic::SingularKind;
use hodograph_base::diag::Both;
use hodograph_base::digits::{shortest, significant};
use hodograph_board::construct::{conditions, pencil_mm};
use hodograph_board::plan::names::name_label;
use hodograph_board::plan::text::{point_label, vertex_name};
use hodograph_mechanism::mechanism::{Core, Opened};
use hodograph_mechanism::position::redundant::Checked;
use hodograph_paper::paper::phrase::{Phrase, fill};
use hodograph_report::answers::worst;
use hodograph_report::drafting;
use hodograph_scene::{DiagramKind, Scene};
use hodograph_worked::accuracy::{BadAngle, relative_tolerances};
use hodograph_worked::worked::{Outcome, Worked};

use super::results::ResultsContent;
use super::sheet::swept_symbol;
use super::tables::constraint_line;
use hodograph_paper::paper::words::Words;
use hodograph_report::amount::{amount, number, sense, symbol};

/// Returns the remarks, one per line.
pub fn remarks(answers: &ResultsContent) -> Vec<Phrase> {
    let ResultsContent { scene, worked, words, .. } = *answers;
    let mut lines = singular(answers);
    if let Some(d) = &worked.drafting {
        lines.push(fill(words.by_hand, &[("", &shortest(d.pencil_mm))]));
    }
    lines.extend(worked.redundant.iter().flat_map(|r| repeats(answers, r)));
    for bad in &worked.bad_angles {
        lines.extend(bad_angle(scene, worked, words, bad));
    }
    lines.iter().map(|l| Phrase::new(l)).collect()
}

/// The effect of a pencil on the results: the largest tolerance, and the results lost in it; empty
/// if each result has its own tolerance beside it.
pub(crate) fn pencil(answers: &ResultsContent) -> Vec<Phrase> {
    let ResultsContent { scene, worked, notation, words, .. } = *answers;
    if worked.drafting.is_some() {
        return Vec::new();
    }
    let pencil_mm = pencil_mm(&scene.paper);
    let mm = shortest(pencil_mm);
    let tolerances = relative_tolerances(&worked.drawn(scene), pencil_mm);
    let told = scene.find.iter().zip(tolerances).filter_map(|(find, t)| Some((find, t?)));
    let (read, lost): (Vec<_>, Vec<_>) = told.partition(|(_, part)| *part < 1.0);
    let worst = read.into_iter().filter(|(_, part)| *part > 0.0).max_by(|a, b| a.1.total_cmp(&b.1));
    let worst = worst.map(|(find, part)| {
        let percent = significant(part * 100.0, drafting::DIGITS);
        fill(words.pencil, &[("", &mm), ("1", &percent), ("symbol", &symbol(find, notation))])
    });
    let lost: Vec<String> =
        lost.into_iter().map(|(find, _)| format!("${}$", symbol(find, notation))).collect();
    let lost = (!lost.is_empty())
        .then(|| fill(words.pencil_lost, &[("", &mm), ("1", &lost.join(words.comma))]));
    worst.into_iter().chain(lost).map(|line| Phrase::new(&line)).collect()
}

/// Returns the number of digits to which drawing and loop equations agree; `None` if there is
/// nothing to compare.
pub fn agreement(worked: &Worked, words: &Words) -> Option<Phrase> {
    let digits = libm::floor(-libm::log10(worst(worked)?.max(f64::EPSILON / 2.0)));
    Some(Phrase::new(&fill(words.agreement, &[("", &format!("{:.0}", digits.max(0.0)))])))
}

/// The redundant part, the reason, and the values on paper of the conditions that no intersection
/// used.
fn repeats(answers: &ResultsContent, repeats: &Checked) -> Vec<String> {
    let ResultsContent { scene, worked, words, .. } = *answers;
    let what = repeats.what(scene);
    let why = repeats.reason.words(scene, repeats.positions);
    let zh = words.tag == "zh";
    let of = |text: &'_ Both| if zh { text.zh.clone() } else { text.en.clone() };
    let conditions = conditions(
        scene,
        &worked.mechanism,
        &worked.configuration,
        &worked.plan,
        &worked.construction,
    );
    let checked = conditions
        .iter()
        .filter(|c| worked.mechanism.redundant[c.index].opened == repeats.opened)
        .map(|c| {
            let [a, b] = [c.pins.0, c.pins.1].map(|p| name_label(scene.point_name(p)));
            let (v, n, line) =
                (format!("v_{{{b}{a}}}"), format!("a_{{{b}{a}}}^n"), format!("l_{{{a}{b}}}"));
            let mm = format!("{:.2}", c.off_mm);
            match c.on {
                DiagramKind::Acceleration => fill(
                    words.along_acceleration,
                    &[("a", &n), ("w", &v), ("", &line), ("mm", &mm)],
                ),
                DiagramKind::Velocity | DiagramKind::Plane | DiagramKind::Force => {
                    fill(words.along_velocity, &[("v", &v), ("", &format!("{a}{b}")), ("mm", &mm)])
                }
            }
        });
    let checked: Vec<String> = checked.collect();
    let said = match repeats.opened {
        // The contact of a wheel is a point of contact, which is drawn like any other.
        Opened::Guide(g) if scene.guides[g.0].rolling.is_some() => words.repeats_alike,
        Opened::Link(_) | Opened::Guide(_) => words.repeats,
        Opened::Rolling(_) | Opened::Pin(..) => words.repeats_alike,
    };
    let said = fill(said, &[("", &of(&what)), ("why", &of(&why))]);
    [said, checked.join(words.semicolon)].into_iter().filter(|line| !line.is_empty()).collect()
}

/// The singularities of the pose, and the first answer that differs on the other motion; `solve`
/// prints all of them.
fn singular(answers: &ResultsContent) -> Vec<String> {
    let ResultsContent { scene, worked, certified, notation, words, digits } = *answers;
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
    if let Some((r, c, other)) =
        worked.results.iter().zip(certified).find_map(|(r, c)| Some((r, c, differs(r)?)))
    {
        let find = &scene.find[r.find];
        let sense = sense(find, other, c, words, digits).plain();
        let value = format!(
            "${} = {}$ {sense}",
            symbol(find, notation),
            amount(&scene.book, find, other, c, digits)
        );
        lines.push(fill(words.other_motion, &[("", value.trim_end())]));
    }
    lines
}

/// One intersection, and below it each remedy. Angles and lengths have two digits, because they are
/// advice.
fn bad_angle(scene: &Scene, worked: &Worked, words: &Words, bad: &BadAngle) -> Vec<String> {
    let two = |x: f64| significant(x, 2).replace('-', "−");
    let name = point_label(&vertex_name(scene, &worked.plan, bad.crossing.target));
    let angle = format!("{}\\degree", number(bad.crossing.angle_deg(), 2));
    let moves = bad
        .crossing
        .moves_on_paper_mm()
        .map_or(words.off_paper.into(), |mm| fill(words.by_mm, &[("", &two(mm))]));
    let mut lines = vec![fill(
        words.bad_angle,
        &[("1", &angle), ("2", &shortest(bad.pencil_mm)), ("3", &moves), ("", &name)],
    )];
    if let Some(factor) = bad.larger {
        lines.push(fill(words.bad_larger, &[("", &shortest(factor))]));
    }
    if let Some(p) = bad.special
        && let Core::Link { link, legs } = &worked.mechanism.groups[p.group].core
    {
        let [a, b] = [p.legs.0, p.legs.1].map(|k| {
            legs[k].line().map_or_else(String::new, |line| constraint_line(scene, words, line))
        });
        lines.push(fill(
            words.bad_special,
            &[("1", &a), ("2", &b), ("3", &two(p.worst_deg)), ("", scene.link_name(*link))],
        ));
    }
    if let Some(p) = bad.pose {
        let (text, turn) = p.to_deg.map_or((words.bad_turn, p.turn_deg), |to| (words.bad_pose, to));
        let (driver, turn) = (swept_symbol(scene, p.driver).0, shortest(turn).replace('-', "−"));
        lines.push(fill(text, &[("driver", &driver), ("", &turn), ("1", &two(p.crossing_deg))]));
    }
    lines
}
