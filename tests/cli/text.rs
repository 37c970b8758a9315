//! Texts that are code in some format: every format reproduces any title literally, and characters
//! that no figure can show and a terminal would obey are refused at their place.

use super::wide::every;
use super::{hodograph, text};
use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use typst_syntax::{SyntaxKind, SyntaxNode};

/// Words that are code in one of the formats.
const WORDS: [&str; 25] = [
    "~~~ fence",
    "~~struck~~ and ~sub~ ^sup^",
    "&copy; &#60; &amp;",
    "---",
    "-- a --- b ... c -1 -?",
    "- item",
    "/ term: x",
    "+ item",
    "1. item",
    "2) item",
    "= heading =",
    "# heading #",
    "costs $5 and $6$",
    "<b>bold</b> <!-- c --> <script>",
    "]]> <![CDATA[ ?>",
    "</title></script><!--<script>",
    "{{data}} {{script}} }}{{",
    "`code` *emphasis* __strong__ _e_",
    "[link](http://x) ![image](y) <http://z>",
    "a | b || c",
    "#let x = 1; @ref <label> // comment /* c */",
    "\"quoted\" 'single' \\n \\u{41} \\",
    "%TeX {group} \\frac",
    "曲柄 & 摇杆 \u{fffc} \u{feff}",
    "=1+1,@SUM(A1),\"\"",
];

fn scene(words: &str) -> String {
    let mut scene: Value =
        serde_json::from_str(&fs::read_to_string("templates/crank-rocker.json").unwrap()).unwrap();
    scene["title"] = json!(words);
    // In a statement, dollar signs and braces have a meaning unless they are escaped.
    let stated = words.replace('{', "{{").replace('}', "}}").replace('$', "\\$");
    scene["statement"] = json!(format!("{stated}\n{stated}"));
    scene.to_string()
}

fn written(folder: &Path, words: &str, command: &str, name: &str) -> String {
    let out = folder.join(name);
    hodograph()
        .args(command.split(' '))
        .arg("-")
        .arg("-o")
        .arg(&out)
        .write_stdin(scene(words))
        .assert()
        .success();
    fs::read_to_string(out).unwrap()
}

/// The words of headings and paragraphs, as a reader of Markdown sees them, and the targets of
/// images.
fn markdown(source: &str) -> (Vec<String>, Vec<String>) {
    let options = Options::ENABLE_MATH
        | Options::ENABLE_STRIKETHROUGH
        | Options::ENABLE_TABLES
        | Options::ENABLE_SUBSCRIPT;
    let (mut blocks, mut images, mut here) = (Vec::new(), Vec::new(), String::new());
    for event in Parser::new_ext(source, options) {
        match event {
            Event::Start(Tag::Heading { .. } | Tag::Paragraph) => here.clear(),
            Event::End(TagEnd::Heading(_) | TagEnd::Paragraph) => blocks.push(here.clone()),
            Event::Start(Tag::Image { dest_url, .. }) => images.push(dest_url.to_string()),
            Event::Text(t) => here.push_str(&t),
            Event::Start(
                Tag::Strong
                | Tag::Emphasis
                | Tag::Link { .. }
                | Tag::CodeBlock(_)
                | Tag::Strikethrough,
            ) => here.push('\0'),
            Event::Html(h) | Event::InlineHtml(h) => panic!("HTML in Markdown: {h}"),
            Event::Code(c) => panic!("code in Markdown: {c}"),
            Event::Rule => panic!("a rule in Markdown"),
            _ => {}
        }
    }
    (blocks, images)
}

/// The words of a Typst document with escapes resolved; a node other than words, a string or an own
/// formula becomes a zero.
fn typst(node: &SyntaxNode, out: &mut String) {
    match node.kind() {
        SyntaxKind::Text | SyntaxKind::Space => out.push_str(node.leaf_text()),
        SyntaxKind::Escape => out.push_str(&node.leaf_text()[1..]),
        SyntaxKind::Parbreak => out.push('\n'),
        SyntaxKind::Shorthand
        | SyntaxKind::SmartQuote
        | SyntaxKind::Link
        | SyntaxKind::Strong
        | SyntaxKind::Emph
        | SyntaxKind::Ref => out.push('\0'),
        _ => node.children().for_each(|c| typst(c, out)),
    }
}

#[test]
fn words_are_words_in_every_format() {
    let folder = tempfile::tempdir().unwrap();
    for words in WORDS.into_iter().step_by(every(2)) {
        let plain = words.split_whitespace().collect::<Vec<_>>().join(" ");
        let svg = written(folder.path(), words, "draw", "a.svg");
        let document =
            roxmltree::Document::parse(&svg).unwrap_or_else(|e| panic!("{words:?}: {e}"));
        assert!(
            document
                .descendants()
                .filter(|n| n.has_tag_name("title"))
                .any(|n| n.text() == Some(words)),
            "{words:?}"
        );

        let html = written(folder.path(), words, "worksheet", "a.html");
        let document = roxmltree::Document::parse(html.trim_start_matches("<!DOCTYPE html>"))
            .unwrap_or_else(|e| panic!("{words:?}: {e}"));
        let said = |tag: &str| {
            document
                .descendants()
                .filter(|n| n.tag_name().name() == tag)
                .filter(|n| n.text() == Some(&plain))
                .count()
        };
        assert!(said("title") >= 1 && said("h1") == 1 && said("p") == 2, "{words:?}");

        let md = written(folder.path(), words, "worksheet", "a.md");
        let (blocks, images) = markdown(&md);
        // The title, the statement twice, and the words of each picture.
        assert_eq!(
            blocks.iter().filter(|b| **b == plain).count(),
            3 + images.len(),
            "{words:?} in\n{}",
            &md[..800.min(md.len())]
        );
        assert!(
            images.iter().all(|i| folder.path().join(i).exists()) && !images.is_empty(),
            "{images:?}"
        );

        let typ = written(folder.path(), words, "worksheet", "a.typ");
        let root = typst_syntax::parse(&typ);
        assert!(
            root.errors_and_warnings().0.is_empty(),
            "{words:?}: {:?}",
            root.errors_and_warnings().0
        );
        let mut said = String::new();
        typst(&root, &mut said);
        // The title in its box, the statement in two paragraphs.
        assert_eq!(said.matches(plain.as_str()).count(), 3, "{words:?} in\n{said}");

        // For a page: the title in the markup, and in the data of a script that ends correctly.
        let page = written(folder.path(), words, "lesson --positions 8", "lesson.html");
        assert!(
            page.contains(&format!("<h1 id=\"title\">{}</h1>", hodograph::render::escaped(words))),
            "{words:?}"
        );
        let data = hodograph::lesson::told(&page)
            .unwrap_or_else(|| panic!("{words:?}: the page is told nothing"));
        let data: Value = serde_json::from_str(&data).unwrap_or_else(|e| panic!("{words:?}: {e}"));
        assert_eq!(data["title"][0], words);

        let table: Value = serde_json::from_str(&written(
            folder.path(),
            words,
            "sweep --steps 4 --find v_C",
            "a.json",
        ))
        .unwrap();
        assert_eq!(table["title"], words);
        let out = folder.path().join("a.pdf");
        hodograph()
            .args(["worksheet", "-", "-o"])
            .arg(&out)
            .write_stdin(scene(words))
            .assert()
            .success();
        assert!(fs::read(&out).unwrap().starts_with(b"%PDF-1.7"));
    }
}

/// A line break in a title does not end a heading; the pictures of a document with a strange name
/// are found.
#[test]
fn line_breaks_and_names_of_files_are_quoted() {
    let folder = tempfile::tempdir().unwrap();
    let words = "a\n\n= b\n# c\n- d";
    assert!(
        written(folder.path(), words, "worksheet", "a.md").starts_with("# a = b \\# c - d\n\n")
    );
    assert!(written(folder.path(), words, "worksheet", "a.typ").contains("[a \\= b \\# c - d])\n"));
    let svg = written(folder.path(), words, "draw", "a.svg");
    roxmltree::Document::parse(&svg).unwrap();
    let strange = "a<b>(c)&amp; %41 \\[d]\"e\n曲";
    let (_, images) = markdown(&written(folder.path(), "x", "worksheet", &format!("{strange}.md")));
    for image in &images {
        let mut bytes = Vec::new();
        let mut rest = image.bytes();
        while let Some(b) = rest.next() {
            let mut digit = || char::from(rest.next().unwrap()).to_digit(16).unwrap() as u8;
            bytes.push(if b == b'%' { digit() * 16 + digit() } else { b });
        }
        assert!(folder.path().join(String::from_utf8(bytes).unwrap()).exists(), "{image}");
    }
    assert!(!images.is_empty());
    let typ = written(folder.path(), "x", "worksheet", &format!("{strange}.typ"));
    let root = typst_syntax::parse(&typ);
    assert!(root.errors_and_warnings().0.is_empty(), "{:?}", root.errors_and_warnings().0);
    assert!(typ.contains("image(\"a<b>(c)&amp; %41 \\\\[d]\\\"e\\u{a}曲-mechanism.svg\""));
}

/// Every character that no figure can show, literally or as an escape, in every text of a scene.
#[test]
fn what_cannot_be_shown_is_refused_at_its_place() {
    let plain = fs::read_to_string("templates/crank-rocker.json").unwrap();
    let at = plain.find("Crank").unwrap();
    for c in [
        "\0",
        "\u{1}",
        "\u{8}",
        "\r",
        "\u{b}",
        "\u{c}",
        "\u{1b}",
        "\u{1f}",
        "\u{7f}",
        "\u{85}",
        "\u{9b}",
        "\u{fdd0}",
        "\u{fffe}",
        "\u{ffff}",
        "\u{1fffe}",
    ] {
        let units: String = c.encode_utf16().map(|u| format!("\\u{u:04X}")).collect();
        for as_written in [c, &units] {
            let source = format!("{}曲柄 {as_written}{}", &plain[..at], &plain[at..]);
            let faults = hodograph::scene::read(&source).unwrap_err();
            let first = faults.list.first().unwrap();
            assert_eq!(
                first.span.map(|s| &source[s.start..s.end]),
                Some(as_written),
                "{c:?}: {first:?}"
            );
            let run = hodograph()
                .args(["draw", "-", "-o", "never.svg"])
                .write_stdin(source)
                .assert()
                .code(2);
            let said = text(&run.get_output().stderr);
            let (line, column) = (
                plain[..at].matches('\n').count() + 1,
                at - plain[..at].rfind('\n').map_or(0, |i| i + 1) + 4,
            );
            assert!(
                said.contains(&format!(":{line}:{column}]")),
                "columns count characters: {said}"
            );
            assert!(!said.contains(|c: char| c.is_control() && c != '\n'), "{said:?}");
        }
    }
    assert!(!Path::new("never.svg").exists());
    let mut every: Value = serde_json::from_str(&plain).unwrap();
    for key in ["title", "ground", "find", "links", "lengths", "driver"] {
        let saved = every[key].clone();
        every[key] = match key {
            "find" => json!(["v_B\u{1b}"]),
            "links" => json!({"1": ["A", "B\u{1b}"]}),
            "lengths" => json!({"AB\u{1b}": "100 mm\u{1b}"}),
            _ => json!("x\u{1b}"),
        };
        let faults = hodograph::scene::read(every.to_string()).unwrap_err();
        assert!(faults.list.iter().any(|d| d.code == "text"), "{key}");
        every[key] = saved;
    }
    // People write line breaks and tabs.
    every["statement"] = json!("one\n\ttwo");
    assert!(hodograph::scene::read(every.to_string()).is_ok());
    let style =
        format!("{{ \"name\": \"{}\", \"notation\": {{ \"pole\": \"\\u001b\" }} }}", "x\u{9b}");
    assert_eq!(
        hodograph::paper::style::read(style.as_bytes())
            .unwrap_err()
            .list
            .iter()
            .filter(|d| d.code == "text")
            .count(),
        2
    );
}

#[test]
fn nothing_reaches_the_terminal_raw() {
    let folder = tempfile::tempdir().unwrap();
    let evil = "\u{1b}]0;owned\u{7}\u{9b}2J";
    let scene = "templates/crank-rocker.json";
    let commands: [&[&str]; 11] = [
        &["solve", evil],
        &["draw", scene, "--style", evil],
        &["draw", scene, "--font", evil],
        &["draw", scene, "-o", evil, "--digits", evil],
        &["draw", scene, "--path", evil],
        &["sweep", scene, "--find", evil],
        &["sweep", scene, "--over", evil],
        &["sweep", scene, "--from", evil],
        &["batch", scene, "--vary", evil, "-o", "x.csv"],
        &["new", evil],
        &["new", "shaper", "--set", evil],
    ];
    for arguments in commands {
        let run = hodograph().args(arguments).assert().code(2);
        let said = text(&run.get_output().stderr) + &text(&run.get_output().stdout);
        assert!(!said.contains(|c: char| c.is_control() && c != '\n'), "{arguments:?}: {said:?}");
    }
    let out = folder.path().join(evil).join("a.csv");
    fs::write(folder.path().join(evil), "").unwrap();
    let run = hodograph().args(["sweep", scene, "-o"]).arg(out).assert().code(1);
    assert!(!text(&run.get_output().stderr).contains('\u{1b}'));
}

/// Faults of arguments are shown in the argument, with its name.
#[test]
fn faults_of_arguments_point_at_the_argument() {
    let scene = "templates/crank-rocker.json";
    let commands: [(&[&str], &str); 17] = [
        (&["sweep", scene, "--from", "1 parsec"], "[--from:1:3]"),
        (&["sweep", scene, "--to", "1 mm"], "[--to:1:1]"),
        (&["sweep", scene, "--over", "l_XY"], "[--over:1:1]"),
        (&["sweep", scene, "--over", "l_BC"], "[--over:1:1]"),
        (&["sweep", scene, "--over", "l_BC", "--from", "1 mm", "--to", "1 s"], "[--to:1:1]"),
        (&["sweep", scene, "--find", "v_C, v_Q"], "[--find:1:6]"),
        (&["curves", scene, "--find", "v_C,a_Q", "-o", "x.svg"], "[--find:1:5]"),
        (&["curves", scene, "--from", "x", "-o", "x.svg"], "[--from:1:1]"),
        (&["batch", scene, "--vary", "l_BC=60...120:3", "-o", "x.csv"], "[--vary:1:8]"),
        (&["batch", scene, "--vary", "l_BC=60..120 s:3", "-o", "x.csv"], "[--vary:1:10]"),
        (&["batch", scene, "--vary", "l_Q=60..120:3", "-o", "x.csv"], "[--vary:1:1]"),
        (&["batch", scene, "--vary", "l_BC", "-o", "x.csv"], "[--vary:1:1]"),
        (&["path", scene, "--point", "E,Q", "-o", "x.svg"], "[--point:1:3]"),
        (&["draw", scene, "--path", "E,曲,Q"], "[--path:1:3]"),
        (&["draw", scene, "--style", "nosuch.json"], "[--style:1:1]"),
        (&["new", "shaper", "--set", "l_O2B=1 parsec"], "[--set:1:1]"),
        (&["limits", scene, "--over", "phi_9"], "[--over:1:1]"),
    ];
    for (arguments, place) in commands {
        let run = hodograph().args(arguments).assert().code(2);
        let said = text(&run.get_output().stderr);
        assert!(said.contains(place), "{arguments:?}: no {place} in\n{said}");
        assert!(!said.contains(&format!("[{scene}")), "{arguments:?}: {said}");
    }
    let run = hodograph()
        .args(["batch", scene, "--vary", "l_BC=60...120:3", "-o", "x.csv"])
        .assert()
        .code(2);
    assert!(text(&run.get_output().stderr).contains("two dots"));
    let run = hodograph().args(["draw", scene, "--style", "nosuch.json"]).assert().code(2);
    assert!(!text(&run.get_output().stderr).contains("scene file"), "a style is no scene");
    assert!(!Path::new("x.csv").exists() && !Path::new("x.svg").exists());
}
