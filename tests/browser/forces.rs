//! Forces in a lesson: polygons that move with the crank, steps that show the items they name,
//! vectors to predict.

use super::*;
use hodograph::equilibrium::{Act, GroupForces};
use hodograph::figure::{forces, sheet};
use hodograph::paper::item::FigureItem;
use hodograph::report::forces::ForceWriter;

/// The items of a group's force polygon at the scale of the page, with their ids in the page.
fn items(b: &mut Browser, (scene, worked): (&Scene, &Worked), k: usize) -> Vec<FigureItem> {
    let options = sheet::SheetOptions::of_language(Lang::En);
    let key = format!("force-{}", k + 1);
    let mu = b
        .eval(&format!("document.querySelector('#{key} svg').dataset.mu"))
        .as_str()
        .unwrap()
        .parse()
        .unwrap();
    let of = worked.equilibrium.as_ref().unwrap().to_scale(mu);
    let links = of.groups[k].links.clone();
    let worked = Worked { equilibrium: Some(of), ..worked.clone() };
    let mut items = forces::polygon(scene, &worked, &options, &links).unwrap().finish().items;
    items.iter_mut().for_each(|i| i.id = i.id.replacen("force", &key, 1));
    items
}

/// The arrows of a group's force polygon as the page shows them: tail and tip in mm from the first
/// vertex, y up.
fn arrows(b: &mut Browser, k: usize) -> Ends {
    let script = format!(
        r##"(() => {{
        const svg = document.querySelector("#force-{} svg"), [x, y] = svg.dataset.origin.split(" ").map(Number), out = {{}};
        for (const e of svg.querySelectorAll(".ink:not([display]) > g:not([display]):not(.label)")) {{
            const line = e.querySelector("line");
            if (!line || !/side|diagonal/.test(e.getAttribute("class"))) continue;
            const [tx, ty] = e.querySelector("path:last-child").getAttribute("d").match(/-?[\d.]+/g).map(Number);
            out[e.id || e.dataset.id] = [Number(line.getAttribute("x1")) - x, y - Number(line.getAttribute("y1")), tx - x, y - ty];
        }}
        return out;
    }})()"##,
        k + 1
    );
    let value = b.eval(&script);
    let ends = |v: &serde_json::Value| std::array::from_fn(|i| v[i].as_f64().unwrap());
    value.as_object().unwrap().iter().map(|(id, v)| (id.clone(), ends(v))).collect()
}

#[test]
fn force_polygons_move_with_the_crank() {
    let Some(mut b) = browser() else { return };
    let mut compared = 0;
    for name in
        ["press-forces", "class-iv-six-bar", "four-bar-forces"].into_iter().step_by(every(2))
    {
        let scene = template(name);
        b.open(&page(name, &scene), PROJECTOR);
        let start = driver_position(&scene, 0).unwrap();
        let (_, first) = worked_at(&mut b, &scene, 0.0);
        let (centre, radius) = crank(&scene, &first);
        let on = |angle: f64| [centre[0] + radius * angle.cos(), centre[1] + radius * angle.sin()];
        let groups = first.equilibrium.as_ref().unwrap().groups.len();
        for turned in [0.0, 0.13, 0.3] {
            b.eval("document.querySelector('#tabs button')?.click()");
            let from = travel(&mut b);
            let grip = in_window(&mut b, on(start + from));
            b.mouse("mousePressed", grip);
            let place = in_window(&mut b, on(start + turned));
            b.mouse("mouseMoved", place);
            let gone = travel(&mut b);
            let (there, worked) = worked_at(&mut b, &scene, gone);
            let of = worked.equilibrium.as_ref().unwrap();
            for k in 0..groups {
                let shown = arrows(&mut b, k);
                let drawn: Ends = items(&mut b, (&there, &worked), k)
                    .into_iter()
                    .filter_map(|i| match i.shape {
                        Shape::Arrow { from, to, .. } => Some((i.id, [from.x, from.y, to.x, to.y])),
                        _ => None,
                    })
                    .collect();
                assert!(
                    drawn.keys().filter(|id| !shown.contains_key(*id)).count() * 4 <= drawn.len(),
                    "{name} {turned}: {:?} {:?}",
                    shown.keys(),
                    drawn.keys()
                );
                for (id, want) in drawn.iter().filter(|(id, _)| shown.contains_key(*id)) {
                    let worst =
                        shown[id].iter().zip(want).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                    assert!(
                        worst < 2e-2,
                        "{name} at {turned}: {id} is off by {worst} mm: {:?} instead of {want:?}",
                        shown[id]
                    );
                    compared += 1;
                }
                // With a group, the mechanism shows the group's free bodies and no others.
                b.eval(&format!("document.getElementById('tab-force-{}').click()", k + 1));
                let bodies = r##"[...document.querySelectorAll("#mechanism .ink:not([display]) [data-id^=group-]")].map((e) => e.dataset.id.split("-")[1])"##;
                let seen: BTreeSet<String> = serde_json::from_value(b.eval(bodies)).unwrap();
                assert_eq!(
                    seen,
                    BTreeSet::from([(k + 1).to_string()]),
                    "{name}: {:?}",
                    of.groups[k].links
                );
            }
            b.eval("document.querySelector('#tabs button')?.click()");
            let place = in_window(&mut b, on(start + turned));
            let_go(&mut b, place);
        }
        assert_quiet(&b, name);
    }
    assert!(compared > 60, "{compared}");
}

#[test]
fn every_step_of_forces_reveals_what_it_names() {
    let Some(mut b) = browser() else { return };
    let scene = template("loader-forces");
    b.open(&page("loader-steps", &scene), PROJECTOR);
    b.key("Home");
    let worked = work(&scene, Scope::Figure).unwrap().value;
    let of = worked.equilibrium.as_ref().unwrap();
    let notation = Notation::of_language(Lang::En);
    let w = ForceWriter { scene: &scene, notation: &notation, lang: Lang::En, of };
    let mut before: BTreeSet<String> = BTreeSet::new();
    for (k, group) in of.groups.iter().enumerate() {
        let visible = format!(
            r##"[...document.querySelectorAll("#force-{} .ink > *")].filter((e) => getComputedStyle(e).visibility !== "hidden" && !e.getAttribute("display"))
            .map((e) => e.id || e.dataset.id).filter((id) => !id.includes("label"))"##,
            k + 1
        );
        let items: Vec<FigureItem> = items(&mut b, (&scene, &worked), k)
            .into_iter()
            .filter(|i| !i.id.contains("label"))
            .collect();
        for (n, phrase) in w.steps(group).iter().enumerate() {
            b.key("ArrowRight");
            let said = b.eval("document.getElementById('sentence').textContent");
            assert_eq!(bare(said.as_str().unwrap()), bare(&phrase.plain()), "group {k} step {n}");
            let now: BTreeSet<String> = serde_json::from_value(b.eval(&visible)).unwrap();
            let new: BTreeSet<&str> = now.difference(&before).map(String::as_str).collect();
            let want: BTreeSet<&str> = items
                .iter()
                .filter(|i| i.steps().min().map_or(0, |s| s + 1) == n)
                .map(|i| i.id.as_str())
                .collect();
            assert_eq!(new, want, "group {k} step {n}: {}", phrase.plain());
            before = now;
        }
        before.clear();
    }
    assert_eq!(b.eval("document.getElementById('next').disabled"), true);
    assert_quiet(&b, "steps of forces");
}

/// The vectors that the groups lay off, in order, and the number of vertices found by intersection.
fn laid(worked: &Worked) -> (Vec<[f64; 2]>, usize) {
    let of = worked.equilibrium.as_ref().unwrap();
    let acts = |group: &GroupForces| of.acts(group);
    let all: Vec<Act> = of.groups.iter().flat_map(acts).collect();
    let vector = |act: &Act| match act {
        Act::Lay(side) => of
            .vector_mm(side.vector)
            .map(|[from, to]| to - from)
            .map(|v| [v.y.atan2(v.x).to_degrees(), v.norm()]),
        _ => None,
    };
    (
        all.iter().filter_map(vector).collect(),
        all.iter().filter(|a| matches!(a, Act::Cross(_))).count(),
    )
}

#[test]
fn force_polygons_are_predicted() {
    let Some(mut b) = browser() else { return };
    let scene = template("loader-forces");
    b.open(&page("loader-predict", &scene), [1280, 720]);
    let worked = work(&scene, Scope::Figure).unwrap().value;
    let (vectors, crossings) = laid(&worked);
    b.key("q");
    let mut asked = 0;
    for [degrees, mm] in vectors {
        // Crossings are shown, vectors are laid off.
        while predict::text(&mut b, "sentence").contains("intersect") {
            b.key("PageDown");
            b.key("Enter");
            asked += 1;
        }
        assert!(predict::asking(&mut b), "{degrees}°");
        predict::turn_to(&mut b, degrees + 180.0);
        b.key("Enter");
        assert_eq!(predict::text(&mut b, "verdict"), "The line is right, the sense is opposite.");
        predict::turn_to(&mut b, degrees);
        b.key("Enter");
        assert_eq!(predict::text(&mut b, "verdict"), "The direction is right.");
        predict::lengthen_to(&mut b, mm);
        b.key("Enter");
        assert!(
            predict::text(&mut b, "verdict").starts_with("Correct."),
            "{}",
            predict::text(&mut b, "verdict")
        );
        b.key("Enter");
    }
    while predict::asking(&mut b) {
        b.key("PageDown");
        b.key("Enter");
        asked += 1;
    }
    assert_eq!(asked, crossings);
    assert_quiet(&b, "forces predicted");
}
