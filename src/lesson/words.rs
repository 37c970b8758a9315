//! The words around the drawings of a page, in both languages, as one table.

use crate::scene::Lang;

/// Key, English, Chinese. The page fills in `{}`.
const WORDS: [(&str, &str, &str); 101] = [
    ("lesson", "Lesson", "教学演示"),
    ("first", "First step", "第一步"),
    ("previous", "Previous step", "上一步"),
    ("next", "Next step", "下一步"),
    ("last", "Show all steps", "显示全部步骤"),
    ("step", "Step {} of {}", "第 {} 步，共 {} 步"),
    ("task", "The task", "题目"),
    ("coming", "Next", "下一步"),
    ("speaker", "Window of the speaker", "讲者窗口"),
    ("play", "Turn forward", "顺原动件转向转动"),
    ("play_back", "Turn back", "反向转动"),
    ("slide", "Move forward", "向前运动"),
    ("slide_back", "Move back", "向后运动"),
    ("pause", "Stop", "停止"),
    ("speed", "Speed", "快慢"),
    ("home", "Back to the given position", "回到给定位置"),
    ("polygons", "Polygons", "多边形"),
    ("tab_velocity", "Velocities", "速度"),
    ("tab_acceleration", "Accelerations", "加速度"),
    ("tab_force", "Forces", "力"),
    ("nearer", "Zoom in", "放大"),
    ("farther", "Zoom out", "缩小"),
    ("whole", "Whole drawing", "显示全图"),
    ("show", "Show …", "显示……"),
    ("show_velocity", "Velocities", "速度"),
    ("show_acceleration", "Accelerations", "加速度"),
    ("show_path", "Paths", "轨迹"),
    ("show_hodograph", "Hodographs", "矢端图"),
    ("points", "Points", "各点"),
    ("answers", "Answers", "答案"),
    ("predict", "Predict", "先画后看"),
    ("predict_title", "Lay off each vector before it is shown", "先自己画出每个矢量，再看答案"),
    ("tip", "Tip of {}", "{} 的箭头端"),
    ("less", "Less", "减小"),
    ("more", "More", "增大"),
    ("check", "Check", "检查"),
    ("give_up", "Show it", "看答案"),
    ("go_on", "Next vector", "下一个矢量"),
    ("ask_direction", "Lay off {}: set its direction and sense.", "画 {}：先定方向和指向。"),
    ("ask_length", "Now the length of {}, to the scale {}.", "再按比例尺 {1} 截取 {0} 的长度。"),
    ("ask_line", "Draw the line along which {} lies.", "画出 {} 所在的方向线。"),
    ("ask_crossing", "Mark where the two lines intersect.", "标出两条方向线的交点。"),
    ("right", "Right.", "正确。"),
    ("right_now", "Correct.", "正确。"),
    ("right_direction", "The direction is right.", "方向正确。"),
    ("shown", "This is the answer.", "答案如图。"),
    ("score", "{} of {} at the first try.", "一次画对 {} 个，共 {} 个。"),
    ("score_helped", "{} with a hint.", "经提示画对 {} 个。"),
    ("score_shown", "{} shown.", "看答案 {} 个。"),
    ("predict_done", "The construction is complete.", "作图完成。"),
    ("clue", "Hint", "提示"),
    ("clue_square", "It is square to {}.", "它垂直于 {}。"),
    ("clue_along", "It is along {}.", "它平行于 {}。"),
    ("clue_sense", "Its sense follows from that of {}.", "其指向由 {} 的转向决定。"),
    (
        "clue_coriolis",
        "Turn the relative velocity by 90° in the sense of {}.",
        "将相对速度沿 {} 的转向转过 90°。",
    ),
    ("clue_centre", "It points to the centre of the circular path.", "它指向圆周运动的圆心。"),
    ("clue_angle", "Look at the mechanism: the line is drawn there.", "看机构图：该方向线在图上。"),
    ("clue_length", "Divide the magnitude by the scale, {}.", "用大小除以比例尺 {}。"),
    (
        "clue_crossing",
        "Both lines are drawn: the point lies on each.",
        "两条方向线均已画出，该点同在两线上。",
    ),
    (
        "wrong_sense",
        "The line is right, the sense is not: it follows from the sense of {}.",
        "方向线正确，指向相反：指向由 {} 的转向决定。",
    ),
    (
        "wrong_coriolis",
        "The sense is opposite: turn the relative velocity by 90° in the sense of {}.",
        "指向相反：应将相对速度沿 {} 的转向转过 90°。",
    ),
    (
        "wrong_centre",
        "The sense is opposite: it points to the centre, {}.",
        "指向相反：应指向圆心，{}。",
    ),
    (
        "wrong_way",
        "The line is right, the sense along {} is opposite.",
        "方向线正确，但沿 {} 的指向相反。",
    ),
    ("wrong_opposite", "The line is right, the sense is opposite.", "方向线正确，指向相反。"),
    ("wrong_square", "It is square to {}, not along it.", "应垂直于 {}，而不是沿着它。"),
    ("wrong_along", "It is along {}, not square to it.", "应沿着 {}，而不是垂直于它。"),
    ("wrong_off", "The direction is {}° off: it must be {}.", "方向偏差 {}°：应为 {}。"),
    ("wrong_angle", "The direction is {}° off.", "方向偏差 {}°。"),
    (
        "wrong_long",
        "Too long by {} mm: divide the magnitude by the scale, {}.",
        "长了 {} mm：应以大小除以比例尺 {}。",
    ),
    (
        "wrong_short",
        "Too short by {} mm: divide the magnitude by the scale, {}.",
        "短了 {} mm：应以大小除以比例尺 {}。",
    ),
    ("wrong_place", "{} mm from the point of intersection.", "离交点 {} mm。"),
    ("theme", "Light or dark", "浅色或深色"),
    ("language", "中文", "English"),
    ("print", "Print", "打印"),
    ("results", "Results", "结果"),
    ("drag", "Drag the crank, or use the arrow keys on it.", "可拖动曲柄，或选中后用方向键转动。"),
    (
        "drag_slide",
        "Drag the driver along its line, or use the arrow keys on it.",
        "可沿导路拖动原动件，或选中后用方向键移动。",
    ),
    (
        "drag_time",
        "Drag the ringed point along its path through time, or use the arrow keys on it.",
        "可沿轨迹拖动圆圈标出的点以改变时间，或选中后用方向键移动。",
    ),
    ("handle", "Driver", "原动件"),
    ("given", "given position", "给定位置"),
    (
        "rates",
        "The driver has the same speed in every position.",
        "原动件在各位置的速度（角速度）不变。",
    ),
    (
        "rates_time",
        "Each position has the velocities of its time.",
        "各位置采用该时刻的速度（角速度）。",
    ),
    ("scales", "One set of scales for all positions.", "各位置采用同一组比例尺。"),
    (
        "scales_cut",
        "One set of scales for all positions but those next to a limit, where the vectors leave the paper.",
        "除极限位置附近（矢量超出图纸）外，各位置采用同一组比例尺。",
    ),
    (
        "scales_window",
        "A polygon is seen as large as it can be at the given position; once a vector would leave the paper, all positions are seen at one smaller size.",
        "给定位置的多边形按尽可能大的幅面显示；矢量将超出图纸时，改用一种较小的幅面显示所有位置。",
    ),
    ("limit", "The driver can go no farther.", "原动件已到极限位置，不能再继续运动。"),
    (
        "limit_toggle",
        "The driver can go no farther: {}.",
        "原动件已到极限位置，不能再继续运动：{}。",
    ),
    (
        "limit_far",
        "The lesson ends here: beyond, a joint leaves the paper.",
        "演示到此为止：再往前，运动副将超出图纸。",
    ),
    (
        "off_velocity",
        "Too large for the paper: next to the limit the velocities tend to infinity.",
        "超出图纸：接近极限位置时，速度趋于无穷大。",
    ),
    (
        "off_acceleration",
        "Too large for the paper: next to the limit the accelerations tend to infinity.",
        "超出图纸：接近极限位置时，加速度趋于无穷大。",
    ),
    (
        "off_force",
        "Too large for the paper: near this position the forces tend to infinity.",
        "超出图纸：在该位置附近，力趋于无穷大。",
    ),
    ("keys", "Keys", "键盘操作"),
    (
        "keys_steps",
        "→ or Page Down: next step; ← or Page Up: previous; Home: first; End: all; T: the other polygon; R: answers",
        "→ 或 Page Down：下一步；← 或 Page Up：上一步；Home：第一步；End：全部；T：切换多边形；R：答案",
    ),
    (
        "keys_crank",
        "+ and −: move the driver, with Shift by more; Space: run or stop; B: back; < and >: slower, faster; 0: to the given position",
        "+ 和 −：移动原动件（按住 Shift 加快）；空格：运动或停止；B：反向；< 和 >：减慢、加快；0：回到给定位置",
    ),
    (
        "keys_show",
        "V: velocities; A: accelerations; C: paths; H: hodographs",
        "V：速度；A：加速度；C：轨迹；H：矢端图",
    ),
    (
        "keys_predict",
        "Q: predict; then arrow keys turn or lengthen the vector, with Shift to the next set square direction or by 5 mm; Enter: check; ?: hint; Page Down: show it",
        "Q：先画后看；方向键改变矢量的方向或长度（按住 Shift 转到下一个三角板方向或改变 5 mm）；Enter：检查；?：提示；Page Down：看答案",
    ),
    (
        "keys_zoom",
        "Zoom: two fingers, Ctrl and wheel, or the buttons of a drawing; drag it to move it",
        "缩放：双指、Ctrl 加滚轮或图上的按钮；拖动可平移",
    ),
    (
        "keys_view",
        "L: language; D: light or dark; P: print, six steps on a page; S: window of the speaker",
        "L：切换语言；D：浅色或深色；P：打印（每页六步）；S：讲者窗口",
    ),
    ("diagram", "The mechanism, drawn to scale.", "按比例尺绘制机构运动简图。"),
    ("steps", "Construction", "作图步骤"),
    (
        "noscript",
        "The page needs JavaScript to move; without it, it shows the given position.",
        "本页需启用 JavaScript 才能运动；未启用时仅显示给定位置。",
    ),
];

/// Returns a word.
///
/// # Panics
/// If the table lacks the key; a test asks for every key that the page uses.
pub fn word(key: &str, lang: Lang) -> &'static str {
    let (_, en, zh) = WORDS.iter().find(|w| w.0 == key).unwrap_or_else(|| panic!("no word {key}"));
    lang.pick([en, zh])
}

/// Returns all words of a language, for the page.
pub fn table(lang: Lang) -> serde_json::Map<String, serde_json::Value> {
    WORDS.iter().map(|(key, ..)| ((*key).to_owned(), word(key, lang).into())).collect()
}
