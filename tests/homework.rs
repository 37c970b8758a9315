//! Homework: thirty variants of five templates are set, solved and marked. The keys are compared
//! with a fresh solution of each variant's scene; right answers have full marks; typical mistakes,
//! wrong senses and mixed-up units are named.

use hodograph::answer::AnswerValue;
use hodograph::homework::platforms::{self, PlatformSet, QtiVersion};
use hodograph::homework::{
    HomeworkRequest, HomeworkVariant, MarkList, keys, mark, names, sheets, variants,
};
use hodograph::problem::{self, Look, Options, templates};
use hodograph::scene::Lang;
use hodograph::worksheet::{WorksheetSides, pages};

/// A template with the ranges of its parameters.
const SETS: [(&str, &[&str]); 5] = [
    ("crank-rocker", &["l_AB=80..120/5", "phi_1=20..160/10"]),
    ("shaper", &["l_O1A=90..130/5", "phi_1=0..350/10", "omega_1=4..8/0.5"]),
    ("slider-crank", &["phi_1=20..160/5", "omega_1=10..20/1"]),
    ("whitworth", &["phi_1=0..350/5", "omega_1=4..10/1"]),
    ("oscillating-cylinder", &["phi_1=0..350/5", "omega_1=6..14/1"]),
];

fn set(name: &str, vary: &[&str], count: usize, seed: u64) -> Vec<HomeworkVariant> {
    let text = templates::text(name, &[]).unwrap();
    let vary: Vec<String> = vary.iter().map(|v| v.to_string()).collect();
    let request = HomeworkRequest { vary: &vary, count, seed, students: &[] };
    variants(&text, &request).unwrap_or_else(|f| panic!("{name}: {f:?}")).value
}

/// The rows of a class in which each student answers his own variant with some values.
fn answers(
    all: &[HomeworkVariant],
    value: impl Fn(&hodograph::homework::KeyEntry) -> String,
) -> String {
    let mut out = "student,variant,question,value,unit\n".to_owned();
    for v in all {
        for k in &v.key {
            out += &format!("s{},{},{},{},{}\n", v.number, v.number, k.question, value(k), k.unit);
        }
    }
    out
}

fn marked(all: &[HomeworkVariant], answers: &str) -> MarkList {
    mark(answers, &keys::csv(all)).unwrap_or_else(|f| panic!("{f:?}"))
}

#[test]
fn thirty_variants_of_five_templates_are_set_solved_and_marked() {
    for (name, vary) in SETS {
        let all = set(name, vary, 30, 7);
        assert_eq!(all.len(), 30, "{name}");
        for v in &all {
            fresh(name, v);
        }
        let right = marked(&all, &answers(&all, |k| k.value.to_string()));
        assert!(
            right.marks.iter().all(|m| m.mark == 1.0 && m.remark.is_empty()),
            "{name}: {right:?}"
        );
        // Each typical value is the answer of a student of its own.
        let (mut rows, mut typical) =
            ("student,variant,question,value,unit\n".to_owned(), Vec::new());
        for v in &all {
            for (k, m) in v.key.iter().flat_map(|k| k.mistakes.iter().map(move |m| (k, m))) {
                let student = typical.len();
                rows += &format!("s{student},{},{},{},\n", v.number, k.question, m.value);
                typical.push((k, m));
            }
        }
        let list = marked(&all, &rows);
        let (mut named, mut near) = (0, 0);
        for (student, (k, m)) in typical.into_iter().enumerate() {
            let own = |x: &&hodograph::homework::MarkedAnswer| {
                x.student == format!("s{student}") && x.question == k.question
            };
            let got = list.marks.iter().find(own).unwrap();
            if (m.value + k.value).abs() <= k.tolerance * 1.001 {
                near += 1;
                continue;
            }
            let words = m.words();
            assert_eq!(got.mark, 0.25, "{name} {got:?} {m:?}");
            assert!(got.remark.en.contains(&words.en), "{name} {got:?} {words:?}");
            assert!(got.remark.zh.contains(&words.zh), "{name} {got:?}");
            named += 1;
        }
        assert!(
            named > 30 && near * 20 < named,
            "{name}: {named} named, {near} like a wrong sense"
        );
    }
}

/// The key against a solution of the variant's text, read anew.
fn fresh(name: &str, v: &HomeworkVariant) {
    let problem = problem::read(&v.text).unwrap().value;
    let solved = problem::solve(&problem, &Options::default()).unwrap();
    let (scene, _) = solved.mechanism().unwrap();
    for (parameter, value) in &v.values {
        let written = scene.parameters.iter().find(|p| p.0 == *parameter).unwrap();
        assert!(written.1.text.starts_with(value.as_str()), "{name}: {parameter} {value}");
    }
    let mut count = 0;
    for a in solved.answers(&Look::default()) {
        let value = a.value.unwrap();
        let parts = match value {
            AnswerValue::Scalar(s) => vec![(a.find.clone(), s)],
            AnswerValue::Vector(u) => vec![(a.find.clone(), libm::hypot(u.x, u.y))],
            AnswerValue::Point(p) => {
                vec![(format!("{}.x", a.find), p.x), (format!("{}.y", a.find), p.y)]
            }
        };
        for (question, si) in parts {
            let k = v.key.iter().find(|k| k.question == question).unwrap();
            let off = (k.value - si).abs();
            assert!(off <= 1e-5 * si.abs(), "{name} {question}: {} against {si}", k.value);
            assert!(
                k.tolerance > 0.0 && (si == 0.0 || k.tolerance <= 0.11 * si.abs()),
                "{name} {question}: {si} ± {}",
                k.tolerance
            );
            count += 1;
        }
    }
    assert_eq!(count, v.key.len(), "{name}");
}

#[test]
fn slips_of_sense_unit_and_pencil_are_named() {
    let all = set("crank-rocker", &["l_AB=80..120/5", "phi_1=20..160/10"], 3, 7);
    let v = &all[..1];
    let given = |value: &dyn Fn(&hodograph::homework::KeyEntry) -> String| {
        let list = marked(&all, &answers(v, value));
        list.marks.into_iter().map(|m| (m.question, m.mark, m.remark.en)).collect::<Vec<_>>()
    };
    for (question, mark, remark) in given(&|k| (-k.value).to_string()) {
        let words = if question.contains('_')
            && question.starts_with(['o', 'a'])
            && !question.starts_with("a_")
        {
            "the sense is wrong"
        } else {
            "the sign is wrong"
        };
        assert_eq!((mark, remark.as_str()), (0.5, words), "{question}");
    }
    for (question, mark, _) in given(&|k| {
        if !k.kind.turns() {
            k.value.to_string()
        } else if k.value < 0.0 {
            format!("{} cw", -k.value)
        } else {
            format!("{} 逆时针", k.value)
        }
    }) {
        assert_eq!(mark, 1.0, "{question}");
    }
    for (question, mark, remark) in given(&|k| (k.value * 1000.0).to_string()) {
        assert_eq!((mark, remark.as_str()), (0.5, "unit mixed up: a factor of 1000"), "{question}");
    }
    for (question, mark, remark) in given(&|k| (k.value + 2.0 * k.tolerance).to_string()) {
        let mistake = remark.contains("likely mistake");
        assert!(mistake || mark == 0.5 && remark.contains("inaccurate"), "{question}: {remark}");
    }
    for (_, mark, remark) in given(&|k| (k.value + 0.999 * k.tolerance).to_string()) {
        assert_eq!((mark, remark.as_str()), (1.0, ""));
    }
    for (_, mark, remark) in given(&|_| String::new()) {
        assert_eq!((mark, remark.as_str()), (0.0, "no answer"));
    }
    let other = "student,variant,question,value,unit\nA,1,v_C,1000,mm/s\nA,1,omega_3,10,rpm\n";
    let keys = "variant,question,value,unit,tolerance,mistakes\n1,v_C,1,m/s,0.001,\n1,omega_3,1.0472,rad/s,0.001,\n";
    assert!(mark(other, keys).unwrap().marks.iter().all(|m| m.mark == 1.0));
    let csv = mark(other, keys).unwrap().csv(Lang::Zh);
    assert_eq!(csv.lines().last(), Some("A,1,total,2,满分 2"));
}

#[test]
fn bad_rows_are_reported_all_at_once_with_their_places() {
    let keys = "variant,student,question,value,unit,tolerance,mistakes\n1,Ada,v_C,1,m/s,0.1,\n";
    let answers = "student,variant,question,value,unit\nAda,9,v_C,1,m/s\nBob,1,v_C,1,m/s\nAda,1,v_Q,1,m/s\n\
                   Ada,1,v_C,\"1,5\",m/s\nAda,1,v_C,1,mm\nAda,1,v_C,3 cw,m/s\n";
    let faults = mark(answers, keys).unwrap_err().answers.list;
    let places: Vec<&str> =
        faults.iter().map(|d| d.span.map(|s| &answers[s.start..s.end]).unwrap()).collect();
    assert_eq!(places, ["9", "1", "v_Q", "\"1,5\"", "mm", "3 cw"]);
    let broken = keys.replace("0.1", "nan").replace("m/s", "furlong");
    let faults = mark("student,variant,question,value\n", &broken).unwrap_err().keys.list;
    assert_eq!(faults.len(), 2, "{faults:?}");
}

#[test]
fn same_seed_gives_the_same_bytes_and_another_seed_others() {
    let vary = ["l_AB=80..120/5", "phi_1=20..160/10"];
    let of = |seed| {
        let all = set("crank-rocker", &vary, 4, seed);
        let problems = sheets::pdf(&all, WorksheetSides::Problem, &Look::default()).unwrap().value;
        (keys::csv(&all), problems)
    };
    assert!(of(7) == of(7));
    assert_ne!(of(7).0, of(8).0);
}

#[test]
fn too_few_variants_are_counted_with_their_reasons() {
    let text = templates::text("crank-rocker", &[]).unwrap();
    let few = |vary: &str, count| {
        let vary = [vary.to_owned()];
        let request = HomeworkRequest { vary: &vary, count, seed: 1, students: &[] };
        let faults: hodograph::diag::Faults = variants(&text, &request).unwrap_err().into();
        faults.list[0].message.en.clone()
    };
    assert_eq!(few("phi_1=20..60/10", 9), "5 of 9 variants were found in 5 of 5 poses");
    let same = few("phi_1=20..20.01/0.001", 3);
    assert!(same.contains("10 have the answers of another variant"), "{same}");
    let apart = few("l_AB=600..640/10", 2);
    assert!(apart.contains("5 cannot be assembled"), "{apart}");
    let short = few("phi_1=39.4..40/0.1", 7);
    assert!(short.contains("too short to be read") || short.contains("another variant"), "{short}");
}

#[test]
fn sheets_carry_number_name_and_the_numbers_of_the_variant() {
    let text = templates::text("crank-rocker", &[]).unwrap();
    let vary = ["l_AB=80..120/5".to_owned(), "phi_1=20..160/10".to_owned()];
    let students = names("name\nAda\n李雷\n").unwrap();
    let request = HomeworkRequest { vary: &vary, count: 3, seed: 2, students: &students };
    let all = variants(&text, &request).unwrap().value;
    assert_eq!(
        all.iter().map(|v| v.student.as_deref()).collect::<Vec<_>>(),
        [Some("Ada"), Some("李雷"), None]
    );
    for lang in [Lang::En, Lang::Zh] {
        let look = Look { lang: Some(lang), ..Look::default() };
        for v in &all {
            let problem = sheets::document(v, WorksheetSides::Problem, &look).unwrap();
            let told = format!("{problem:?}");
            let length = v.values[0].1.split(' ').next().unwrap();
            assert!(told.contains(&format!("= {length} mm")), "{}", v.values[0].1);
            assert!(told.contains(v.student.as_deref().unwrap_or("________")));
            assert!(problem.title.contains(&v.number.to_string()));
            assert!(!pages::pages(&problem).is_empty());
        }
    }
}

#[test]
fn statements_with_numbers_are_left_out() {
    let text = templates::text("crank-rocker", &[]).unwrap();
    let text = text.replace("turns at constant speed", "of 100 mm turns at constant speed");
    let vary = ["l_AB=80..90/5".to_owned()];
    let request = HomeworkRequest { vary: &vary, count: 1, seed: 2, students: &[] };
    let read = variants(&text, &request).unwrap();
    assert_eq!(read.notes[0].code, "variants-statement");
    let sheet =
        sheets::document(&read.value[0], WorksheetSides::Problem, &Look::default()).unwrap();
    assert!(!format!("{sheet:?}").contains("of 100 mm"));
}

#[test]
fn grids_of_decimals_are_written_as_decimals() {
    let all = set("crank-rocker", &["omega_1=0.1..0.5/0.1"], 5, 3);
    let mut values: Vec<&str> = all.iter().map(|v| v.values[0].1.as_str()).collect();
    values.sort_unstable();
    assert_eq!(values, ["0.1", "0.2", "0.3", "0.4", "0.5"]);
    let all = set("crank-rocker", &["phi_1=50 deg..60 deg:3"], 3, 3);
    let mut values: Vec<&str> = all.iter().map(|v| v.values[0].1.as_str()).collect();
    values.sort_unstable();
    assert_eq!(values, ["50 deg", "55 deg", "60 deg"]);
}

/// The files of an archive whose files are stored, by their local headers.
fn unzipped(bytes: &[u8]) -> Vec<(String, Vec<u8>)> {
    let (mut all, mut at) = (Vec::new(), 0);
    let number = |at: usize, n: usize| {
        bytes[at..at + n].iter().rev().fold(0_usize, |all, b| all << 8 | usize::from(*b))
    };
    while bytes[at..].starts_with(b"PK\x03\x04") {
        assert_eq!(number(at + 8, 2), 0, "stored");
        let (length, name) = (number(at + 18, 4), number(at + 26, 2));
        let begin = at + 30 + name + number(at + 28, 2);
        let path = String::from_utf8(bytes[at + 30..at + 30 + name].to_vec()).unwrap();
        all.push((path, bytes[begin..begin + length].to_vec()));
        at = begin + length;
    }
    let end = bytes.len() - 22;
    assert!(bytes[end..].starts_with(b"PK\x05\x06"));
    assert_eq!([number(end + 10, 2), number(end + 16, 4)], [all.len(), at]);
    all
}

fn exported() -> (Vec<HomeworkVariant>, PlatformSet) {
    let all = set("shaper", &["l_O1A=90..130/5", "phi_1=0..350/10"], 3, 7);
    let set = platforms::questions(&all, &Look::default()).unwrap();
    (all, set)
}

#[test]
fn moodle_has_each_question_with_its_picture_and_tolerances() {
    let (all, set) = exported();
    let text = platforms::moodle(&set).unwrap();
    let document = roxmltree::Document::parse(&text).unwrap();
    let questions: Vec<_> =
        document.descendants().filter(|n| n.attribute("type") == Some("numerical")).collect();
    assert_eq!(questions.len(), all.iter().map(|v| v.key.len()).sum::<usize>());
    let child = |n: roxmltree::Node, name: &str| {
        n.descendants()
            .find(|c| c.has_tag_name(name))
            .and_then(|c| c.text())
            .unwrap_or("")
            .to_owned()
    };
    for (q, k) in questions.iter().zip(all.iter().flat_map(|v| &v.key)) {
        let answers: Vec<_> = q.children().filter(|c| c.has_tag_name("answer")).collect();
        let number = |n: roxmltree::Node, name: &str| child(n, name).parse::<f64>().unwrap();
        assert_eq!(number(answers[0], "text"), k.value);
        assert_eq!(number(answers[0], "tolerance"), k.tolerance);
        assert_eq!(answers[0].attribute("fraction"), Some("100"));
        for m in &k.mistakes {
            let own = answers
                .iter()
                .find(|a| a.attribute("fraction") == Some("0") && number(**a, "text") == m.value);
            assert!(
                own.unwrap()
                    .descendants()
                    .any(|n| n.text().is_some_and(|t| t.contains(&m.words().en)))
            );
        }
        assert!(child(*q, "file").starts_with("iVBORw0KGgo"));
        assert_eq!(child(*q, "showunits"), "3");
    }
}

/// The score of an item for a response, as its response processing says; elements by the end of
/// their names in both versions.
fn scored(item: &str, response: Option<f64>) -> f64 {
    let document = roxmltree::Document::parse(item).unwrap();
    let named = |n: &roxmltree::Node, name: &str| {
        n.tag_name().name().replace("qti-", "").replace('-', "").eq_ignore_ascii_case(name)
    };
    let find = |n: roxmltree::Node, name: &str| {
        n.descendants().find(|c| named(c, name)).map(|c| c.id()).unwrap()
    };
    let condition = document.get_node(find(document.root(), "responsecondition")).unwrap();
    for branch in condition.children().filter(roxmltree::Node::is_element) {
        let number = |name: &str| -> f64 {
            let n = document.get_node(find(branch, name)).unwrap();
            document.get_node(find(n, "basevalue")).unwrap().text().unwrap().parse().unwrap()
        };
        let not_null = document.get_node(find(branch, "not")).unwrap();
        assert!(not_null.descendants().any(|c| named(&c, "isnull")));
        if response.is_some_and(|r| number("gte") <= r && r <= number("lte")) {
            return number("setoutcomevalue");
        }
    }
    0.0
}

#[test]
fn qti_items_of_both_versions_score_alike() {
    let (all, set) = exported();
    for version in [QtiVersion::Two, QtiVersion::Three] {
        let files = unzipped(&platforms::qti(&set, version));
        let text = |path: &str| {
            let file = files.iter().find(|f| f.0 == path).unwrap_or_else(|| panic!("{path}"));
            String::from_utf8(file.1.clone()).unwrap()
        };
        let manifest = text("imsmanifest.xml");
        let manifest = roxmltree::Document::parse(&manifest).unwrap();
        for file in manifest.descendants().filter_map(|n| n.attribute("href")) {
            assert!(files.iter().any(|f| f.0 == file), "{file}");
        }
        for (v, task) in all.iter().zip(&set.tasks) {
            for (k, q) in v.key.iter().zip(&task.questions) {
                let item = text(&format!("items/{}.xml", q.name));
                let plain = version == QtiVersion::Two;
                assert_eq!(plain, !item.contains("qti-"), "{item}");
                assert_eq!(scored(&item, Some(k.value)), 1.0);
                assert_eq!(scored(&item, Some(k.value + 0.9 * k.tolerance)), 1.0);
                assert_eq!(scored(&item, None), 0.0);
                assert_eq!(scored(&item, Some(1e6 + k.value)), 0.0);
                if k.kind.turns() {
                    assert_eq!(scored(&item, Some(-k.value)), 0.5);
                }
            }
        }
    }
}

#[test]
fn canvas_and_prairielearn_have_the_numbers_of_the_keys() {
    let (all, set) = exported();
    let files = unzipped(&platforms::canvas(&set));
    let own = files.iter().filter(|f| f.0.ends_with(".xml") && f.0 != "imsmanifest.xml");
    let mut keys = all.iter().flat_map(|v| &v.key);
    for (path, bytes) in own {
        let text = String::from_utf8(bytes.clone()).unwrap();
        let document = roxmltree::Document::parse(&text).unwrap();
        for item in document
            .descendants()
            .filter(|n| n.has_tag_name(("http://www.imsglobal.org/xsd/ims_qtiasiv1p2", "item")))
        {
            let number = |name: &str| -> f64 {
                let n = item.descendants().find(|n| n.tag_name().name() == name).unwrap();
                n.text().unwrap().parse().unwrap()
            };
            let k = keys.next().unwrap_or_else(|| panic!("{path}"));
            assert_eq!(number("varequal"), k.value);
            assert!(number("vargte") < k.value && k.value < number("varlte"));
        }
    }
    assert!(keys.next().is_none());
    let files = platforms::prairielearn(&set);
    let json = |name: &str| -> serde_json::Value {
        let file = files.iter().find(|f| f.path.ends_with(name)).unwrap();
        serde_json::from_slice(&file.bytes).unwrap()
    };
    assert_eq!(json("info.json")["type"], "v3");
    let variants = json("variants.json");
    assert_eq!(variants.as_array().unwrap().len(), 3);
    assert_eq!(variants[1]["questions"][2]["value"], all[1].key[2].value);
    let picture = variants[2]["picture"].as_str().unwrap();
    assert!(files.iter().any(|f| f.path.ends_with(&format!("clientFilesQuestion/{picture}"))));
}
