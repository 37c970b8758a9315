//! TikZ pictures have an item for each item of the figure, and LaTeX sets them where it is there.

use hodograph::figure::sheet::{SheetOptions, sheet};
use hodograph::paper::item::{Figure, Shape};
use hodograph::render::tikz::tikz;
use hodograph::scene::{self, Lang, templates};
use hodograph::worked::{Scope, work};
use std::path::Path;
use std::process::Command;

fn drawn(template: &str) -> Figure {
    let scene = scene::read(templates::get(template).unwrap()).unwrap().value;
    let worked = work(&scene, Scope::Figure).unwrap().value;
    sheet(&scene, &worked, &SheetOptions::of_language(Lang::En)).unwrap()
}

#[test]
fn each_label_is_a_node_and_each_arrow_a_line_with_a_head() {
    for template in templates::list() {
        let figure = drawn(template.name);
        let picture = tikz(&figure).unwrap();
        let lines = |start: &str| picture.lines().filter(|l| l.starts_with(start)).count();
        let items = |is: fn(&Shape) -> bool| figure.items.iter().filter(|i| is(&i.shape)).count();
        let labels = items(|s| matches!(s, Shape::Label { .. } | Shape::Turned { .. }));
        assert_eq!(lines("\\node["), labels, "{}", template.name);
        let arrows = items(|s| matches!(s, Shape::Arrow { .. } | Shape::ArcArrow { .. }));
        assert!(lines("\\fill[black]") >= arrows.min(1), "{}", template.name);
        let mut depth = 0_i32;
        for c in picture.replace("\\{", "").replace("\\}", "").chars() {
            depth += i32::from(c == '{') - i32::from(c == '}');
            assert!(depth >= 0, "{}", template.name);
        }
        assert_eq!(depth, 0, "{}", template.name);
        // In a formula a space between words is a command.
        assert!(!picture.contains("} \\text{"), "{}", template.name);
    }
}

/// Sets a document in a folder with an engine of LaTeX; `None` if it is not there.
fn set(engine: &str, folder: &Path, document: &str) -> Option<String> {
    let program = Path::new(env!("CARGO_BIN_EXE_hodograph")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap_or_default());
    let out = Command::new(engine)
        .args(["-shell-escape", "-interaction=nonstopmode", "-halt-on-error", document])
        .current_dir(folder)
        .env("PATH", path)
        .output()
        .ok()?;
    let log = String::from_utf8_lossy(&out.stdout).into_owned();
    assert!(out.status.success(), "{engine}: {log}");
    Some(log)
}

#[test]
fn latex_sets_sheets_and_the_package_of_the_examples() {
    let folder = tempfile::tempdir().unwrap();
    let names = ["shaper", "crank-rocker", "planetary-gear", "press-forces", "cam-offset-roller"];
    let mut document = String::from(
        "\\documentclass{article}\\usepackage{lmodern,tikz,amsmath,amssymb}\\begin{document}\n",
    );
    for name in names {
        std::fs::write(folder.path().join(format!("{name}.tikz")), tikz(&drawn(name)).unwrap())
            .unwrap();
        document += &format!("\\resizebox{{\\linewidth}}{{!}}{{\\input{{{name}.tikz}}}}\n");
    }
    std::fs::write(folder.path().join("sheets.tex"), document + "\\end{document}\n").unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let demo = std::fs::read_to_string(root.join("examples/latex/demo.tex")).unwrap();
    let demo = demo.replace("../../templates", &root.join("templates").display().to_string());
    std::fs::write(folder.path().join("demo.tex"), demo).unwrap();
    std::fs::copy(root.join("examples/latex/hodograph.sty"), folder.path().join("hodograph.sty"))
        .unwrap();
    for engine in ["pdflatex", "lualatex"] {
        for document in ["sheets.tex", "demo.tex"] {
            if set(engine, folder.path(), document).is_none() {
                println!("{engine} is not there: skipped");
            }
        }
    }
}
