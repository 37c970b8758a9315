//! The lesson of a motion without a mechanism: names are legible from the last row, nothing is cut
//! off, every step shows its items, and a moved instant shows the answers of the library.

use super::*;
use hodograph::lesson::motion;
use hodograph::notation::Notation;
use hodograph::particle::{self, solve};
use hodograph::report::particle::lines;
use serde_json::json;

const SMALL_PROJECTOR: [u32; 2] = [1280, 720];

#[test]
fn motions_go_through_their_steps_and_their_instants() {
    let Some(mut b) = browser() else { return };
    for name in particle::templates::names() {
        let problem = particle::read(particle::templates::get(name).unwrap()).unwrap().value;
        let options = motion::MotionOptions {
            lang: Lang::En,
            style: Style::default(),
            positions: 8,
            motion: 0,
        };
        let path =
            PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("lesson-motion-{name}.html"));
        std::fs::write(&path, motion::lesson(&problem, &options).unwrap()).unwrap();
        for (window, least) in [(SMALL_PROJECTOR, 14.0), (PHONE, 11.0)] {
            b.open(&path, window);
            let told = format!("{name} at {window:?}");
            let over =
                b.eval("document.documentElement.scrollWidth - innerWidth").as_f64().unwrap();
            assert!(over <= 0.0, "{told} is {over} pixels too wide");
            let seen = b.eval(design::DRAWINGS);
            assert_eq!(seen["cut"], json!([]), "{told}");
            assert!(
                seen["count"].as_f64().unwrap() > 3.0 && seen["least"].as_f64().unwrap() >= least,
                "{told}: {seen}"
            );
            stepped(&mut b, &told);
        }
        moved(&mut b, name, &problem);
        assert_quiet(&b, name);
    }
}

/// Goes through all steps in both languages.
fn stepped(b: &mut Browser, told: &str) {
    for language in 0..2 {
        b.key("Home");
        let mut before = 0.0;
        for step in 1..20 {
            assert_eq!(
                b.eval(design::WORDS),
                json!([]),
                "{told}, step {step}, language {language}"
            );
            assert!(
                b.eval("document.getElementById('sentence').textContent.length").as_f64().unwrap()
                    > 3.0,
                "{told}, step {step}"
            );
            let now = b.eval(design::SEEN).as_f64().unwrap();
            assert!(now > before, "{told}: step {step} brings nothing");
            before = now;
            if b.eval("document.getElementById('next').disabled") == json!(true) {
                assert!(step >= 4, "{told}: {step} steps");
                break;
            }
            b.key("ArrowRight");
        }
        b.key("l");
    }
}

/// At another instant the page shows the library's answers; then it returns to the given one.
fn moved(b: &mut Browser, name: &str, problem: &particle::ParticleProblem) {
    b.key("0");
    let home = b.eval("document.getElementById('travel').textContent");
    let drawn = b.eval("document.querySelector('.moving').innerHTML");
    b.key("+");
    assert_ne!(
        b.eval("document.querySelector('.moving').innerHTML"),
        drawn,
        "{name}: nothing moves"
    );
    let t = b
        .eval("parseFloat(document.getElementById('travel').textContent.slice(4))")
        .as_f64()
        .unwrap();
    let at = problem.at(t, None).unwrap();
    let first = |text: &str| {
        text.split("= ")
            .nth(1)
            .map(|s| s.chars().take_while(|c| !c.is_ascii_alphabetic()).collect::<String>())
            .unwrap()
    };
    let wanted = lines(&at, &solve(&at).unwrap(), 3, Lang::En, &Notation::of_language(Lang::En));
    let said = b.eval("[...document.querySelectorAll('#answers li')].map((e) => e.textContent)");
    for (line, said) in wanted
        .iter()
        .zip(said.as_array().unwrap())
        .filter(|(l, _)| l.plain().contains(" = ") && !l.plain().contains("= ("))
    {
        let number = |text: &str| {
            first(text).replace(['−', '('], "-").trim().parse::<f64>().unwrap_or(f64::NAN)
        };
        let (a, b) = (number(&line.plain()), number(said.as_str().unwrap()));
        // The instant is given to five digits.
        assert!(
            a.is_nan() && b.is_nan() || (a - b).abs() <= 2e-2 * a.abs() + 1e-9,
            "{name} at {t}: {} | {said}",
            line.plain()
        );
    }
    b.key("0");
    assert_eq!(b.eval("document.getElementById('travel').textContent"), home, "{name}");
}
