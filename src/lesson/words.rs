//! The words around the drawings of a page, in both languages, as one table.

use crate::scene::Lang;
use hodograph_base::lang::each;

/// Key, both languages. The page fills in `{}`.
const WORDS: [(&str, [&str; 2]); 101] = [
    ("lesson", each!("Lesson")),
    ("first", each!("First step")),
    ("previous", each!("Previous step")),
    ("next", each!("Next step")),
    ("last", each!("Show all steps")),
    ("step", each!("Step {} of {}")),
    ("task", each!("The task")),
    ("coming", each!("Next")),
    ("speaker", each!("Window of the speaker")),
    ("play", each!("Turn forward")),
    ("play_back", each!("Turn back")),
    ("slide", each!("Move forward")),
    ("slide_back", each!("Move back")),
    ("pause", each!("Stop")),
    ("speed", each!("Speed")),
    ("home", each!("Back to the given position")),
    ("polygons", each!("Polygons")),
    ("tab_velocity", each!("Velocities")),
    ("tab_acceleration", each!("Accelerations")),
    ("tab_force", each!("page" => "Forces")),
    ("nearer", each!("Zoom in")),
    ("farther", each!("Zoom out")),
    ("whole", each!("Whole drawing")),
    ("show", each!("Show …")),
    ("show_velocity", each!("Velocities")),
    ("show_acceleration", each!("Accelerations")),
    ("show_path", each!("Paths")),
    ("show_hodograph", each!("Hodographs")),
    ("points", each!("Points")),
    ("answers", each!("page" => "Answers")),
    ("predict", each!("Predict")),
    ("predict_title", each!("Lay off each vector before it is shown")),
    ("tip", each!("Tip of {}")),
    ("less", each!("Less")),
    ("more", each!("More")),
    ("check", each!("Check")),
    ("give_up", each!("Show it")),
    ("go_on", each!("Next vector")),
    ("ask_direction", each!("Lay off {}: set its direction and sense.")),
    ("ask_length", each!("Now the length of {}, to the scale {}.")),
    ("ask_line", each!("Draw the line along which {} lies.")),
    ("ask_crossing", each!("Mark where the two lines intersect.")),
    ("right", each!("Right.")),
    ("right_now", each!("Correct.")),
    ("right_direction", each!("The direction is right.")),
    ("shown", each!("This is the answer.")),
    ("score", each!("{} of {} at the first try.")),
    ("score_helped", each!("{} with a hint.")),
    ("score_shown", each!("{} shown.")),
    ("predict_done", each!("The construction is complete.")),
    ("clue", each!("Hint")),
    ("clue_square", each!("It is square to {}.")),
    ("clue_along", each!("It is along {}.")),
    ("clue_sense", each!("Its sense follows from that of {}.")),
    ("clue_coriolis", each!("Turn the relative velocity by 90° in the sense of {}.")),
    ("clue_centre", each!("It points to the centre of the circular path.")),
    ("clue_angle", each!("Look at the mechanism: the line is drawn there.")),
    ("clue_length", each!("Divide the magnitude by the scale, {}.")),
    ("clue_crossing", each!("Both lines are drawn: the point lies on each.")),
    ("wrong_sense", each!("The line is right, the sense is not: it follows from the sense of {}.")),
    (
        "wrong_coriolis",
        each!("The sense is opposite: turn the relative velocity by 90° in the sense of {}."),
    ),
    ("wrong_centre", each!("The sense is opposite: it points to the centre, {}.")),
    ("wrong_way", each!("The line is right, the sense along {} is opposite.")),
    ("wrong_opposite", each!("The line is right, the sense is opposite.")),
    ("wrong_square", each!("It is square to {}, not along it.")),
    ("wrong_along", each!("It is along {}, not square to it.")),
    ("wrong_off", each!("The direction is {}° off: it must be {}.")),
    ("wrong_angle", each!("The direction is {}° off.")),
    ("wrong_long", each!("Too long by {} mm: divide the magnitude by the scale, {}.")),
    ("wrong_short", each!("Too short by {} mm: divide the magnitude by the scale, {}.")),
    ("wrong_place", each!("{} mm from the point of intersection.")),
    ("theme", each!("Light or dark")),
    ("language", each!("中文")),
    ("print", each!("Print")),
    ("results", each!("Results")),
    ("drag", each!("Drag the crank, or use the arrow keys on it.")),
    ("drag_slide", each!("Drag the driver along its line, or use the arrow keys on it.")),
    (
        "drag_time",
        each!("Drag the ringed point along its path through time, or use the arrow keys on it."),
    ),
    ("handle", each!("Driver")),
    ("given", each!("given position")),
    ("rates", each!("The driver has the same speed in every position.")),
    ("rates_time", each!("Each position has the velocities of its time.")),
    ("scales", each!("One set of scales for all positions.")),
    (
        "scales_cut",
        each!(
            "One set of scales for all positions but those next to a limit, where the vectors leave the paper."
        ),
    ),
    (
        "scales_window",
        each!(
            "A polygon is seen as large as it can be at the given position; once a vector would leave the paper, all positions are seen at one smaller size."
        ),
    ),
    ("limit", each!("The driver can go no farther.")),
    ("limit_toggle", each!("The driver can go no farther: {}.")),
    ("limit_far", each!("The lesson ends here: beyond, a joint leaves the paper.")),
    (
        "off_velocity",
        each!("Too large for the paper: next to the limit the velocities tend to infinity."),
    ),
    (
        "off_acceleration",
        each!("Too large for the paper: next to the limit the accelerations tend to infinity."),
    ),
    (
        "off_force",
        each!("Too large for the paper: near this position the forces tend to infinity."),
    ),
    ("keys", each!("Keys")),
    (
        "keys_steps",
        each!(
            "→ or Page Down: next step; ← or Page Up: previous; Home: first; End: all; T: the other polygon; R: answers"
        ),
    ),
    (
        "keys_crank",
        each!(
            "+ and −: move the driver, with Shift by more; Space: run or stop; B: back; < and >: slower, faster; 0: to the given position"
        ),
    ),
    ("keys_show", each!("V: velocities; A: accelerations; C: paths; H: hodographs")),
    (
        "keys_predict",
        each!(
            "Q: predict; then arrow keys turn or lengthen the vector, with Shift to the next set square direction or by 5 mm; Enter: check; ?: hint; Page Down: show it"
        ),
    ),
    (
        "keys_zoom",
        each!("Zoom: two fingers, Ctrl and wheel, or the buttons of a drawing; drag it to move it"),
    ),
    (
        "keys_view",
        each!(
            "L: language; D: light or dark; P: print, six steps on a page; S: window of the speaker"
        ),
    ),
    ("diagram", each!("The mechanism, drawn to scale.")),
    ("steps", each!("Construction")),
    (
        "noscript",
        each!("The page needs JavaScript to move; without it, it shows the given position."),
    ),
];

/// Returns a word.
///
/// # Panics
/// If the table lacks the key; a test asks for every key that the page uses.
pub fn word(key: &str, lang: Lang) -> &'static str {
    let found = WORDS.iter().find(|w| w.0 == key).unwrap_or_else(|| panic!("no word {key}"));
    lang.pick(found.1)
}

/// Returns all words of a language, for the page.
pub fn table(lang: Lang) -> serde_json::Map<String, serde_json::Value> {
    WORDS.iter().map(|(key, ..)| ((*key).to_owned(), word(key, lang).into())).collect()
}
