//! Golden files: of every template plan and construction as text, for some the plan as JSON, the sheet as SVG (outlines folded to a hash) and PNG.
//!
//! To accept what the program now makes, look at the new files and run `HODOGRAPH_ACCEPT=1 cargo test --test golden`.

#[path = "golden/pdf.rs"]
mod pdf;
#[path = "golden/worksheet.rs"]
mod worksheet;

use hodograph::accuracy::{certify, steps};
use hodograph::effort::Work;
use hodograph::figure::curves::{self, Diagram};
use hodograph::figure::mechanism::Overlay;
use hodograph::figure::sheet::{Options, Single, diagram, sheet, single};
use hodograph::figure::steps as steps_of;
use hodograph::figure::style::Style;
use hodograph::figure::{path, poses};
use hodograph::lesson;
use hodograph::mechanism::{Level, Mechanism};
use hodograph::plan::notation::Notation;
use hodograph::plan::text::Writer;
use hodograph::render::{png as raster, svg};
use hodograph::report::{answers, construction, drafting, plan, plan_json};
use hodograph::scene::{self, Angle, Lang, PointId, edit, templates};
use hodograph::sweep::{self, Placed, Stations, Width, extreme};
use hodograph::worked::{Scope, work};
use std::path::{Path, PathBuf};

const HOW: &str = "if this is what you want, look at it and run: HODOGRAPH_ACCEPT=1 cargo test --test golden";

/// Templates whose plan is kept as JSON too: Coriolis, in both languages; a triad; cylinders.
const PLANS_AS_JSON: [(&str, &str); 4] = [("shaper", "en"), ("shaper", "zh"), ("class-iii-six-bar", "en"), ("excavator", "en")];

fn accept() -> bool {
    std::env::var_os("HODOGRAPH_ACCEPT").is_some_and(|v| v == "1")
}

/// FNV-1a: any stable hash will do.
fn hash(text: &str) -> String {
    format!("#{:016x}", text.bytes().fold(0xcbf2_9ce4_8422_2325u64, |h, b| (h ^ u64::from(b)).wrapping_mul(0x100_0000_01b3)))
}

/// Outlines, and the letters of a label, as `#` and a hash: a changed letter still shows, and the file stays readable.
fn folded(svg: &str) -> String {
    let mut out = String::with_capacity(svg.len() / 3);
    let mut rest = svg;
    loop {
        let outline = rest.find(" d=\"").map(|i| (i + 4, rest[i + 4..].find('"').expect("an attribute ends"), ""));
        // All letters of a label follow one another.
        let letters = rest.find("<use ").map(|i| (i, rest[i..].find("</g>").expect("a label ends"), "<use/>"));
        let Some((start, length, mark)) = [outline, letters].into_iter().flatten().min() else { break };
        let text = &rest[start..start + length];
        out.push_str(&rest[..start]);
        out.push_str(mark);
        out.push_str(&if length > 80 || !mark.is_empty() { hash(text) } else { text.to_owned() });
        rest = &rest[start + length..];
    }
    out.push_str(rest);
    out
}

fn check_text(path: &Path, now: &str, failures: &mut Vec<String>) {
    if accept() {
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, now).unwrap();
        return;
    }
    let was = std::fs::read_to_string(path).unwrap_or_default();
    if was == now {
        return;
    }
    let line = was.lines().zip(now.lines()).position(|(a, b)| a != b).unwrap_or(was.lines().count().min(now.lines().count()));
    let at = |t: &str| t.lines().nth(line).unwrap_or("(nothing)").chars().take(160).collect::<String>();
    failures.push(format!("{}:{}\n    expected: {}\n    actual:   {}\n    {HOW}", path.display(), line + 1, at(&was), at(now)));
}

fn pixels(bytes: &[u8]) -> Option<(u32, u32, png::ColorType, Vec<u8>)> {
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().ok()?;
    let mut buffer = vec![0; reader.output_buffer_size()?];
    let info = reader.next_frame(&mut buffer).ok()?;
    buffer.truncate(info.buffer_size());
    Some((info.width, info.height, info.color_type, buffer))
}

fn check_png(path: &Path, now: &[u8], failures: &mut Vec<String>) {
    if accept() {
        std::fs::write(path, now).unwrap();
        return;
    }
    let was = std::fs::read(path).unwrap_or_default();
    let (Some(a), Some(b)) = (pixels(&was), pixels(now)) else {
        failures.push(format!("{}: there is no golden picture\n    {HOW}", path.display()));
        return;
    };
    if (a.0, a.1, a.2) != (b.0, b.1, b.2) {
        failures.push(format!("{}: {}x{} expected, {}x{} drawn\n    {HOW}", path.display(), a.0, a.1, b.0, b.1));
        return;
    }
    let off: Vec<u8> = a.3.iter().zip(&b.3).map(|(x, y)| x.abs_diff(*y)).collect();
    let bad = off.iter().filter(|d| **d > 1).count();
    if bad > 0 {
        let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
        let name =
            format!("{}-{}", path.parent().unwrap().file_name().unwrap().to_string_lossy(), path.file_name().unwrap().to_string_lossy());
        let (actual, difference) = (folder.join(format!("actual-{name}")), folder.join(format!("difference-{name}")));
        std::fs::write(&actual, now).unwrap();
        let mut encoder = png::Encoder::new(std::fs::File::create(&difference).unwrap(), a.0, a.1);
        encoder.set_color(a.2);
        encoder.write_header().unwrap().write_image_data(&off.iter().map(|d| 255 - d.saturating_mul(4)).collect::<Vec<_>>()).unwrap();
        failures.push(format!(
            "{}: {bad} values differ by more than 1\n    actual:     {}\n    difference: {}\n    {HOW}",
            path.display(),
            actual.display(),
            difference.display()
        ));
    }
}

/// A lesson: its markup with outlines folded, its data with what is packed folded; style and script are files of their own.
fn lesson_text(page: &str) -> String {
    fn fold(value: &mut serde_json::Value) {
        match value {
            serde_json::Value::String(s) if s.len() > 80 => *s = format!("{} {}", s.len(), hash(s)),
            serde_json::Value::Array(list) => list.iter_mut().for_each(fold),
            serde_json::Value::Object(fields) => fields.values_mut().for_each(fold),
            _ => {}
        }
    }
    let between = |from: &str, to: &str| page.split(from).nth(1).unwrap().split(to).next().unwrap();
    let mut data: serde_json::Value = serde_json::from_str(between("id=\"data\">", "</script>")).unwrap();
    data["words"] = "…".into();
    fold(&mut data);
    let lines: Vec<String> = data.as_object().unwrap().iter().map(|(key, value)| format!("{key}: {value}")).collect();
    let markup = folded(&page.replace(between("<style>", "</style>"), ""));
    format!("{}\n{}\n", markup.split("<script").next().unwrap(), lines.join("\n").replace("],[\"", "],\n[\""))
}

/// A crank that turns fully, and one that is stopped.
#[test]
fn lessons_stay_as_accepted() {
    let mut failures = Vec::new();
    for name in ["crank-rocker", "five-bar"] {
        let scene = scene::read(templates::get(name).unwrap()).unwrap().value;
        let page = lesson::lesson(&scene, &lesson::Options::of_language(Lang::En)).unwrap_or_else(|f| panic!("{name}: {f}")).value;
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden").join(name).join("lesson.html.txt");
        check_text(&path, &lesson_text(&page), &mut failures);
        let worked = work(&scene, Scope::Figure).unwrap().value;
        let fragment = lesson::reveal(&scene, &worked, &Options::of_language(Lang::En)).unwrap().value;
        check_text(&path.with_file_name("reveal.html.txt"), &folded(&fragment), &mut failures);
    }
    assert!(failures.is_empty(), "{} golden files differ:\n{}", failures.len(), failures.join("\n"));
}

#[test]
fn templates_look_as_accepted() {
    let mut failures = Vec::new();
    let schema = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/plan.schema.json")).unwrap();
    let schema = jsonschema::validator_for(&serde_json::from_str(&schema).unwrap()).unwrap();
    for t in templates::list() {
        let scene = scene::read(templates::get(t.name).unwrap()).unwrap().value;
        let worked = work(&scene, Scope::Figure).unwrap_or_else(|f| panic!("{}: {f}", t.name)).value;
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden").join(t.name);
        for (lang, suffix) in [(Lang::En, "en"), (Lang::Zh, "zh")] {
            let notation = Notation::of_language(lang);
            let w = Writer { scene: &scene, plan: &worked.plan, notation: &notation, lang };
            check_text(&folder.join(format!("plan.{suffix}.txt")), &plan::text(&scene, &worked.mechanism, &w), &mut failures);
            check_text(
                &folder.join(format!("construction.{suffix}.txt")),
                &construction::text(&w, &worked.construction, &steps(&scene, &worked, None)),
                &mut failures,
            );
            if t.name == "shaper" {
                let asked = work(&scene, Scope::Questions).unwrap().value.with_drafting(&scene);
                let w = Writer { plan: &asked.plan, ..w };
                let text = format!(
                    "{}\n{}",
                    answers::text(&scene, &asked, &certify(&scene, &asked, answers::DIGITS), answers::DIGITS, lang),
                    drafting::text(&w, &asked, &steps(&scene, &asked, asked.drafting.as_ref().map(|d| d.pencil_mm)))
                );
                check_text(&folder.join(format!("drafting.{suffix}.txt")), &text, &mut failures);
            }
            let figure = sheet(&scene, &worked, &Options { notation: notation.clone(), ..Options::of_language(lang) })
                .unwrap_or_else(|f| panic!("{}: {f}", t.name));
            let done = Work::of(&worked).with_certified(&certify(&scene, &worked, answers::DIGITS)).with_figure(&figure);
            let json = plan_json::json(&worked.mechanism, &worked.demand, &w, Some((&worked, done)), &[]);
            failures.extend(schema.iter_errors(&json).map(|e| format!("{}: docs/plan.schema.json: {}: {e}", t.name, e.instance_path())));
            if PLANS_AS_JSON.contains(&(t.name, suffix)) {
                check_text(&folder.join(format!("plan.{suffix}.json")), &format!("{json:#}\n"), &mut failures);
            }
            let drawn = svg::write(&figure).unwrap_or_else(|f| panic!("{}: {f}", t.name));
            assert!(drawn.notes.is_empty(), "{}: {:?}", t.name, drawn.notes);
            check_text(&folder.join(format!("sheet.{suffix}.svg.txt")), &folded(&drawn.value), &mut failures);
            check_png(&folder.join(format!("sheet.{suffix}.png")), &raster::render(&drawn.value, 110.0).unwrap(), &mut failures);
        }
    }
    assert!(failures.is_empty(), "{} golden files differ:\n{}", failures.len(), failures.join("\n"));
}

/// One picture of every kind of figure: an inset, styles, single figures, steps, vectors, positions and a path.
#[test]
fn kinds_of_figures_look_as_accepted() {
    let mut failures = Vec::new();
    let style = |name: &str| Style::named(name).unwrap();
    for (name, kind, style) in [
        ("class-iii-six-bar", "inset", style("print")),
        ("shaper", "slides", style("slides")),
        ("jansen-leg", "dark", style("dark")),
        ("offset-slider-crank", "overlay", style("slides")),
        ("slotted-lever", "step", style("print")),
        ("crank-rocker", "equations", style("print")),
    ] {
        let scene = scene::read(templates::get(name).unwrap()).unwrap().value;
        let worked = work(&scene, Scope::Figure).unwrap().value;
        let options = Options { style, ..Options::of_language(Lang::En) };
        let figure = match kind {
            "inset" => single(&scene, &worked, &options, Single::Polygon(Level::Acceleration)).unwrap(),
            "equations" => single(&scene, &worked, &options, Single::Equations).unwrap(),
            "step" => steps_of::figures(&scene, &worked, &options).swap_remove(11),
            "overlay" => {
                let point = PointId(scene.points.iter().position(|p| p.name == "S").unwrap());
                let overlay = Overlay { vectors: Some(Level::Velocity), ..Overlay::default() }.with_motion(&scene, &worked, 6, &[point]);
                diagram(&scene, &worked, &options, &overlay)
            }
            _ => sheet(&scene, &worked, &options).unwrap(),
        };
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden").join(name).join(format!("{kind}.png"));
        let drawn = svg::write(&figure).unwrap().value;
        check_png(&path, &raster::render(&drawn, 110.0).unwrap(), &mut failures);
    }
    assert!(failures.is_empty(), "{} golden files differ:\n{}", failures.len(), failures.join("\n"));
}

/// A slider's displacement, velocity and acceleration: signs, extremes between the stations, what turns unwound.
#[test]
fn line_diagrams_look_as_accepted() {
    let mut failures = Vec::new();
    let source = edit::with_find(templates::get("shaper").unwrap(), &["x_C", "phi_3", "v_C", "v_B", "a_C"]).unwrap();
    let scene = scene::read(source).unwrap().value;
    let mechanism = Mechanism::new(&scene).unwrap().value;
    let placed = Placed::new(&scene, &mechanism).unwrap();
    let table = sweep::run(&placed, 0, &Stations::turned(Angle::Deg(0.0), Angle::Deg(360.0), 360), Width::Widest).unwrap();
    for (lang, suffix) in [(Lang::En, "en"), (Lang::Zh, "zh")] {
        let diagram = Diagram::of(&placed, 0, &table, &Notation::of_language(lang));
        let figure = curves::figure(&scene, &diagram, &Style::default(), lang);
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("golden/shaper/curves.{suffix}.png"));
        check_png(&path, &raster::render(&svg::write(&figure).unwrap().value, 110.0).unwrap(), &mut failures);
        // The ram stands where the lever turns back: its extremes are those that `limits` locates by Newton's method.
        let limits = extreme::limits(&scene, &mechanism, 0).unwrap();
        let stroke = diagram.panels[0].curves[0]
            .extremes
            .iter()
            .map(|e| e.1)
            .fold([f64::NEG_INFINITY, f64::INFINITY], |[h, l], v| [h.max(v), l.min(v)]);
        let found = stroke[0] - stroke[1];
        let nearest = limits.swings.iter().filter_map(|s| s.stroke).map(|m| (m * 1e3 - found).abs()).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-6, "stroke {found} mm, {nearest} mm from that of the limits");
    }
    assert!(failures.is_empty(), "{} golden files differ:\n{}", failures.len(), failures.join("\n"));
}

/// Paths with their hodographs: a coupler curve, a foot in other positions too, a crank that is stopped, a slider and its pin;
/// and the sheet of many poses, with hodographs behind its polygons.
#[test]
fn pictures_of_motion_look_as_accepted() {
    let mut failures = Vec::new();
    for (name, points, poses, style) in [
        ("crank-rocker", &["E"][..], 0, "print"),
        ("jansen-leg", &["G"], 6, "slides"),
        ("class-iii-six-bar", &["P"], 0, "print"),
        ("offset-slider-crank", &["C", "S"], 0, "dark"),
    ] {
        let scene = scene::read(templates::get(name).unwrap()).unwrap().value;
        let worked = work(&scene, Scope::Figure).unwrap().value;
        let of = |name: &&str| PointId(scene.points.iter().position(|p| p.name == **name).unwrap());
        let wanted = path::Wanted { points: points.iter().map(of).collect(), driver: 0, marks: 12, poses };
        for (lang, suffix) in [(Lang::En, "en"), (Lang::Zh, "zh")] {
            let options = Options { style: Style::named(style).unwrap(), ..Options::of_language(lang) };
            let figure = path::figure(&scene, &worked, &options, &wanted).unwrap_or_else(|f| panic!("{name}: {f}")).value;
            let drawn = svg::write(&figure).unwrap();
            assert!(drawn.notes.is_empty(), "{name}: {:?}", drawn.notes);
            let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("golden/{name}/path.{suffix}.png"));
            check_png(&file, &raster::render(&drawn.value, 110.0).unwrap(), &mut failures);
        }
    }
    for (name, point, count) in [("crank-rocker", Some("E"), 12), ("shaper", None, 4), ("class-iii-six-bar", None, 5)] {
        let scene = scene::read(templates::get(name).unwrap()).unwrap().value;
        let worked = work(&scene, Scope::Figure).unwrap().value;
        let of = |name: &str| PointId(scene.points.iter().position(|p| p.name == name).unwrap());
        let wanted = poses::Wanted { count, driver: 0, points: point.map(of).into_iter().collect() };
        for (lang, suffix) in [(Lang::En, "en"), (Lang::Zh, "zh")] {
            let pages = poses::sheets(&scene, &worked, &Options::of_language(lang), &wanted).unwrap_or_else(|f| panic!("{name}: {f}"));
            let drawn = svg::write(&pages.value[0]).unwrap();
            assert!(drawn.notes.is_empty(), "{name}: {:?}", drawn.notes);
            let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("golden/{name}/poses.{suffix}.png"));
            check_png(&file, &raster::render(&drawn.value, 60.0).unwrap(), &mut failures);
        }
    }
    assert!(failures.is_empty(), "{} golden files differ:\n{}", failures.len(), failures.join("\n"));
}

/// The gallery shows every template there is.
#[test]
fn the_gallery_is_current() {
    let mut failures = Vec::new();
    let mut page = String::from(
        "# Gallery\n\nEvery template as its sheet. `HODOGRAPH_ACCEPT=1 cargo test --test golden` makes the pictures and this page anew; the same test\n\
         without it checks that they are current. Any of them: `hodograph new NAME > scene.json && hodograph draw scene.json -o out/`.\n",
    );
    for t in templates::list() {
        page += &format!("\n## {}\n`{}` · {}\n\n![{}](../golden/{}/sheet.en.png)\n", t.title.en, t.name, t.title.zh, t.title.en, t.name);
    }
    check_text(&Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/gallery.md"), &page, &mut failures);
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
