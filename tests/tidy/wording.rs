//! Consistent terms in all Chinese texts of the sources and templates, and words that a reader of
//! mechanics does not expect.

use super::catalogues::{CatalogueEntry, entries};
use super::{files, finish, sources};

/// Words that must not occur, each with the one that the books have.
const TERMS: &[(&str, &str)] = &[
    ("速比系数", "行程速度变化系数"),
    ("哥氏", "科氏"),
    ("柯氏", "科氏"),
    ("回路方程", "封闭矢量方程（解析法）"),
    ("II级", "Ⅱ级"),
    ("II 级", "Ⅱ级"),
    ("III级", "Ⅲ级"),
    ("III 级", "Ⅲ级"),
    ("没有编译形式", "不能预编译，逐位置求解（较慢）"),
    ("种装配中", "种装配形式中"),
    ("种装配\"", "种装配形式"),
    ("于 φ", "φ = … 时"),
    ("位于 {", "（… 时）"),
    ("\"位于\"", "（… 时）"),
    ("没有写点", "未指定点"),
    ("请写文件夹", "请指定文件夹"),
    ("原文件", "原题"),
    ("动点变换", "不是固定点"),
    ("速度恒定", "原动件匀速"),
    ("\"休止\"", "远休止、近休止"),
    ("\"无缺陷", "无运动缺陷"),
    ("\"判断\"", "结论"),
];

/// English phrases that no textbook has.
const ENGLISH: &[(&str, &str)] = &[
    ("\"Right now.", "Correct."),
    ("right at once", "at the first try"),
    (", locating $", "which gives $"),
    ("on the law of the cycloid", "with cycloidal motion"),
    ("or better (", "within ±"),
];

#[test]
fn one_thing_has_one_term() {
    let texts =
        [sources(&["rs", "js", "html", "po"]), files("po", &["po"]), files("templates", &["json"])]
            .concat();
    assert!(texts.len() > 300, "only {} files", texts.len());
    let mut faults = Vec::new();
    for (file, text) in &texts {
        for (n, line) in text.lines().enumerate() {
            let said = line
                .split_once("//")
                .map_or(line, |(code, _)| if code.contains('"') { line } else { code });
            let found = TERMS.iter().chain(ENGLISH).filter(|(wrong, _)| said.contains(wrong));
            faults.extend(
                found.map(|(wrong, right)| format!("{file}:{}: {wrong}; write {right}", n + 1)),
            );
        }
    }
    finish(&faults, "One thing has one term, that of the books.");
}

/// A Chinese word next to a half-width mark or bracket.
fn half_width(text: &str) -> Option<String> {
    let chinese = |c: char| ('\u{4e00}'..='\u{9fff}').contains(&c);
    let quoted = |mark: char, text: &str| text.split(mark).step_by(2).collect::<Vec<_>>().join("Q");
    let text = quoted('`', &text.replace("\\\"", "\""));
    let text = quoted('"', &text);
    let chars: Vec<char> = text.chars().collect();
    chars
        .windows(2)
        .find(|w| chinese(w[0]) && [',', ':', ';', '?', '!'].contains(&w[1]))
        .map(|w| w.iter().collect())
}

#[test]
fn no_half_width_mark_follows_chinese() {
    let found = |e: &CatalogueEntry| {
        Some(format!("{}:{}: {} in {:?}", e.file, e.line, half_width(&e.zh)?, e.zh))
    };
    let faults: Vec<String> = entries().iter().filter_map(found).collect();
    finish(&faults, "Chinese has its own colon, comma and semicolon.");
}
