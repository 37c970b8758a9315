//! What the page says around the drawings, in both languages: one table.

use crate::scene::Lang;

/// Key, English, Chinese. `{}` is filled in by the page.
const WORDS: [(&str, &str, &str); 37] = [
    ("lesson", "Lesson", "教学演示"),
    ("first", "First step", "第一步"),
    ("previous", "Previous step", "上一步"),
    ("next", "Next step", "下一步"),
    ("last", "Show all steps", "显示全部步骤"),
    ("step", "Step {} of {}", "第 {} 步，共 {} 步"),
    (
        "finished",
        "All steps are drawn. “First step” (key Home) starts the construction.",
        "作图已全部完成。按“第一步”（Home 键）从头逐步演示。",
    ),
    ("play", "Turn", "转动"),
    ("slide", "Move", "运动"),
    ("pause", "Stop", "停止"),
    ("home", "Back to the given position", "回到给定位置"),
    ("theme", "Light or dark", "浅色或深色"),
    ("language", "中文", "English"),
    ("print", "Print", "打印"),
    ("results", "Results", "结果"),
    ("drag", "Drag the crank, or use the arrow keys on it.", "可拖动曲柄，或选中后用方向键转动。"),
    ("drag_slide", "Drag the driver along its line, or use the arrow keys on it.", "可沿导路拖动原动件，或选中后用方向键移动。"),
    ("handle", "Driver", "原动件"),
    ("given", "given position", "给定位置"),
    ("rates", "The driver has the same rate in every position.", "原动件在各位置的速度（角速度）不变。"),
    ("scales", "One set of scales for all positions.", "各位置采用同一组比例尺。"),
    (
        "scales_cut",
        "One set of scales for all positions but those next to a limit, where the vectors leave the paper.",
        "除极限位置附近（矢量超出图纸）外，各位置采用同一组比例尺。",
    ),
    (
        "scales_steps",
        "One set of scales, but for positions in which a polygon is much larger: its caption then tells the coarser scale.",
        "各位置一般采用同一组比例尺；个别位置的多边形过大时改用较粗的比例尺，见图下所注。",
    ),
    (
        "scales_steps_cut",
        "One set of scales, but for positions in which a polygon is much larger: its caption then tells the coarser scale. Next to a limit the vectors leave the paper.",
        "各位置一般采用同一组比例尺；个别位置的多边形过大时改用较粗的比例尺，见图下所注；极限位置附近矢量超出图纸。",
    ),
    ("smaller", "drawn smaller here", "此处缩小绘制"),
    ("limit", "The driver can go no farther.", "原动件已到极限位置，不能再继续运动。"),
    ("limit_toggle", "The driver can go no farther: {}.", "原动件已到极限位置，不能再继续运动：{}。"),
    ("limit_far", "The lesson ends here: beyond, a joint leaves the paper.", "演示到此为止：再往前，运动副将超出图纸。"),
    (
        "off_velocity",
        "Too large for the paper: next to the limit the velocities grow beyond all bounds.",
        "超出图纸：接近极限位置时速度趋于无穷大。",
    ),
    (
        "off_acceleration",
        "Too large for the paper: next to the limit the accelerations grow beyond all bounds.",
        "超出图纸：接近极限位置时加速度趋于无穷大。",
    ),
    ("keys", "Keys", "键盘操作"),
    (
        "keys_steps",
        "→ or Page Down: next step; ← or Page Up: previous; Home: first; End: all",
        "→ 或 Page Down：下一步；← 或 Page Up：上一步；Home：第一步；End：全部",
    ),
    (
        "keys_crank",
        "+ and −: move the driver, with Shift by more; Space: run or stop; 0: back to the given position",
        "+ 和 −：移动原动件（按住 Shift 加快）；空格：转动或停止；0：回到给定位置",
    ),
    ("keys_view", "L: language; D: light or dark; P: print", "L：切换语言；D：浅色或深色；P：打印"),
    ("diagram", "The mechanism, drawn to scale.", "按比例尺绘制机构运动简图。"),
    ("steps", "Construction", "作图步骤"),
    (
        "noscript",
        "The page needs JavaScript to move; without it, it shows the given position.",
        "本页需启用 JavaScript 才能运动；未启用时仅显示给定位置。",
    ),
];

/// A word.
///
/// # Panics
/// On a key that the table does not have: a test asks for every key that the page uses.
pub fn word(key: &str, lang: Lang) -> &'static str {
    let (_, en, zh) = WORDS.iter().find(|w| w.0 == key).unwrap_or_else(|| panic!("no word {key}"));
    match lang {
        Lang::En => en,
        Lang::Zh => zh,
    }
}

/// All words of a language, for the page.
pub fn table(lang: Lang) -> serde_json::Map<String, serde_json::Value> {
    WORDS.iter().map(|(key, ..)| ((*key).to_owned(), word(key, lang).into())).collect()
}
