//! Linkages of PMKS, the Planar Mechanism Kinematic Simulator: a text with a line for each joint,
//! its links, its kind, its place and the angle of its guide.
//!
//! ```text
//! ground,link1,R,0,0
//! link1,link2,R,50,86.6
//! link2,link3,R,280,0
//! ground,link3,P,280,0,0
//! ```
//! The first joint is the driven one. `R` is a pin, `P` a block in a guide of the first link, `RP` a
//! bare pin in a slot of the first link. Lengths are in millimetres, angles in degrees. Commas and
//! spaces separate alike. A pin of three links has two lines with one place.
//!
//! # Source
//! The examples of PMKS (M. Campbell, Design Engineering Lab).

use super::linkage::{Linkage, LinkageBody, LinkageJoint, LinkageSlide};
use crate::diag::{Both, Diagnostic, Faults, Span, both};
use crate::geom::{Point, Vec2};

/// The ground's name.
const GROUND: &str = "ground";

/// Returns the text.
pub fn text(linkage: &Linkage) -> String {
    let name = |b: Option<usize>| match b {
        Some(b) => format!("link{}", linkage.bodies[b].name.replace([',', ' '], "_")),
        None => GROUND.to_owned(),
    };
    let mut lines = Vec::new();
    let mut line = |links: &[Option<usize>], kind: &str, at: Point, direction: Option<Vec2>| {
        let links: Vec<String> = links.iter().map(|b| name(*b)).collect();
        let angle = direction.map(|u| format!(",{}", u.angle().to_degrees())).unwrap_or_default();
        lines.push(format!("{},{kind},{},{}{angle}\n", links.join(","), at.x, at.y));
    };
    line(&[None, Some(linkage.crank)], "R", linkage.joints[linkage.pivot].at, None);
    for (j, joint) in linkage.joints.iter().enumerate() {
        let ground = joint.fixed.then_some(None);
        let mut links: Vec<Option<usize>> =
            ground.into_iter().chain(linkage.carriers(j).map(Some)).collect();
        if j == linkage.pivot {
            links.retain(|b| *b != Some(linkage.crank));
        }
        match links.len() {
            0 => {}
            1 if j == linkage.pivot => {}
            1 => line(&links, "R", joint.at, None),
            _ => links.windows(2).for_each(|two| line(two, "R", joint.at, None)),
        }
    }
    for slide in &linkage.slides {
        let at = linkage.joints[slide.joint].at;
        let (kind, runner) = match slide.block {
            Some(block) => ("P", Some(block)),
            None => ("RP", linkage.carriers(slide.joint).find(|b| Some(*b) != slide.on)),
        };
        if runner.is_some() {
            line(&[slide.on, runner], kind, at, Some(slide.direction));
        }
    }
    lines.concat()
}

/// A line of the text.
struct JointLine<'a> {
    links: Vec<&'a str>,
    kind: String,
    at: Point,
    angle: Option<f64>,
    driven: bool,
}

/// Reads the text.
///
/// # Errors
/// `import` at each line that is not a joint, and for a driven joint that is not a pin on the
/// ground.
pub fn read(source: &str) -> Result<Linkage, Faults> {
    let mut faults = Faults::default();
    let mut lines = Vec::new();
    let mut start = 0;
    for row in source.split_inclusive('\n') {
        let span = Span::new(start, start + row.trim_end().len());
        start += row.len();
        let words: Vec<&str> =
            row.split(|c: char| c == ',' || c.is_whitespace()).filter(|w| !w.is_empty()).collect();
        // Settings, such as the accuracy `d=0`, follow the joints.
        if words.is_empty() || row.contains('=') || row.starts_with('#') {
            continue;
        }
        match joint_line(&words) {
            Some(line) => lines.push(line),
            None => faults.push(wrong(both!("`{}` is not a joint", row.trim())).at(span)),
        }
    }
    if faults.has_errors() {
        return Err(faults);
    }
    linkage(&lines).map_err(|why| wrong(why).into())
}

fn joint_line<'a>(words: &[&'a str]) -> Option<JointLine<'a>> {
    let number = |w: &&str| w.parse::<f64>().ok().filter(|v| v.is_finite());
    let kind = (1..words.len()).find(|k| {
        ["R", "P", "RP"].iter().any(|kind| words[*k].eq_ignore_ascii_case(kind))
            && words.get(k + 1).and_then(number).is_some()
    })?;
    let numbers: Vec<f64> = words[kind + 1..].iter().map_while(number).collect();
    let (links, place) = (words[..kind].to_vec(), numbers.get(..2)?);
    // The fourth of four marks is that of the driver.
    let mark = words.get(kind + 1 + numbers.len()).and_then(|w| w.chars().nth(3));
    Some(JointLine {
        links,
        kind: words[kind].to_uppercase(),
        at: Point::new(place[0], place[1]),
        angle: numbers.get(2).copied(),
        driven: mark.is_some_and(|c| matches!(c, '+' | 't' | 'T')),
    })
    .filter(|line| line.links.len() <= 2 && (line.kind == "R" || line.links.len() == 2))
}

fn is_ground(name: &str) -> bool {
    let name = name.to_lowercase();
    name.starts_with(GROUND) || name == "gnd"
}

fn linkage(lines: &[JointLine]) -> Result<Linkage, Both> {
    let Some(driven) = lines.iter().find(|l| l.driven).or(lines.first()) else {
        return Err(both!("it has no joints"));
    };
    let mut bodies: Vec<LinkageBody> = Vec::new();
    for name in lines.iter().flat_map(|l| &l.links).filter(|name| !is_ground(name)) {
        if bodies.iter().all(|b| b.name != **name) {
            bodies.push(LinkageBody { name: (*name).to_owned(), joints: Vec::new() });
        }
    }
    let body = |name: &str| bodies.iter().position(|b| b.name == name);
    // Pins first: a block is placed by its pin.
    let mut joints: Vec<(LinkageJoint, Vec<usize>)> = Vec::new();
    let mut put = |at: Point, links: &[&str]| {
        let of: Vec<usize> = links.iter().filter_map(|name| body(name)).collect();
        let fixed = links.iter().any(|name| is_ground(name));
        let shared = |(joint, on): &(LinkageJoint, Vec<usize>)| {
            joint.at == at && (joint.fixed && fixed || on.iter().any(|b| of.contains(b)))
        };
        let k = joints.iter().position(shared).unwrap_or_else(|| {
            let joint = LinkageJoint { name: letter(joints.len()), at, fixed: false };
            joints.push((joint, Vec::new()));
            joints.len() - 1
        });
        joints[k].0.fixed |= fixed;
        for b in of {
            if !joints[k].1.contains(&b) {
                joints[k].1.push(b);
            }
        }
        k
    };
    let mut slides = Vec::new();
    for line in lines.iter().filter(|l| l.kind == "R") {
        put(line.at, &line.links);
    }
    for line in lines.iter().filter(|l| l.kind == "RP") {
        slides.push((put(line.at, &line.links[1..]), line, None));
    }
    for line in lines.iter().filter(|l| l.kind == "P") {
        // The ground carries the guide, whichever comes first.
        let [first, second] = line.links[..] else { continue };
        let block = body(if is_ground(second) { first } else { second });
        let pin = block.and_then(|b| joints.iter().position(|(j, on)| !j.fixed && on.contains(&b)));
        let pin = match pin {
            Some(pin) => pin,
            None => {
                let name = letter(joints.len());
                joints.push((
                    LinkageJoint { name, at: line.at, fixed: false },
                    block.into_iter().collect(),
                ));
                joints.len() - 1
            }
        };
        slides.push((pin, line, block));
    }
    let slides = slides
        .into_iter()
        .map(|(joint, line, block)| LinkageSlide {
            joint,
            on: body(line.links[0]).filter(|b| Some(*b) != block),
            block,
            direction: Vec2::from_angle(line.angle.unwrap_or_default().to_radians()),
        })
        .collect();
    let crank = driven.links.iter().find_map(|name| body(name));
    let pivot = joints.iter().position(|(j, _)| j.at == driven.at && j.fixed);
    let (Some(crank), Some(pivot)) = (crank, pivot.filter(|_| driven.kind == "R")) else {
        return Err(both!("the driven joint is not a pin of a link on the ground"));
    };
    for (j, (_, on)) in joints.iter().enumerate() {
        on.iter().for_each(|b| bodies[*b].joints.push(j));
    }
    let joints = joints.into_iter().map(|(joint, _)| joint).collect();
    let title = String::new();
    Ok(Linkage { title, joints, bodies, slides, crank, pivot, rate: 1.0 })
}

/// The name of a joint: A to Z, then A1, B1 and so on.
fn letter(k: usize) -> String {
    let letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ".as_bytes();
    let letter = char::from(letters[k % letters.len()]);
    match k / letters.len() {
        0 => letter.to_string(),
        round => format!("{letter}{round}"),
    }
}

fn wrong(why: Both) -> Diagnostic {
    Diagnostic::error("import", both!("not a linkage of PMKS: {}", why)).help(both!(
        "a joint is a line such as `ground,link1,R,0,0`, a guide `ground,link3,P,280,0,0`"
    ))
}
