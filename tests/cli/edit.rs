//! `hodograph edit` over real connections: who is answered, what is written, and how it ends.

use super::{hodograph, text};
use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

/// The beginning of the built page, as far as the program looks at it.
const PAGE: &str = "<html><head>\n<meta charset=\"utf-8\">\n<meta content=\"connect-src 'none'\">\n</head>\n<body></body></html>";

/// A running `hodograph edit`.
struct Served {
    run: Child,
    folder: tempfile::TempDir,
    file: PathBuf,
    host: String,
    word: String,
}

impl Served {
    /// Starts the program on a file with this text, or on a new one.
    fn start(text: Option<&str>) -> Served {
        let folder = tempfile::tempdir().unwrap();
        let (file, page) = (folder.path().join("a&b.json"), folder.path().join("page.html"));
        fs::write(&page, PAGE).unwrap();
        if let Some(text) = text {
            fs::write(&file, text).unwrap();
        }
        let mut run = Command::new(env!("CARGO_BIN_EXE_hodograph"));
        run.args(["edit", "--no-open", "--new", "--lang", "zh", "--page"]).arg(&page).arg(&file);
        let mut run = run.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let mut line = String::new();
        BufReader::new(run.stdout.as_mut().unwrap()).read_line(&mut line).unwrap();
        let (host, word) = line
            .trim()
            .strip_prefix("http://")
            .unwrap()
            .trim_end_matches('/')
            .split_once('/')
            .unwrap();
        let (host, word) = (host.to_owned(), word.to_owned());
        Served { run, folder, file, host, word }
    }

    /// The answer to these bytes: status, head, body.
    fn raw(&self, bytes: &[u8]) -> (u16, String, Vec<u8>) {
        let mut stream = TcpStream::connect(&self.host).unwrap();
        // The program may have answered and left before all is sent.
        let _ = stream.write_all(bytes);
        let mut answer = Vec::new();
        let _ = stream.read_to_end(&mut answer);
        let at = answer.windows(4).position(|w| w == b"\r\n\r\n").expect("an answer with a head");
        let head = text(&answer[..at]);
        (head[9..12].parse().unwrap(), head, answer[at + 4..].to_vec())
    }

    /// The answer to a request with headers, one a line, and a body.
    fn ask(&self, line: &str, headers: &[String], body: &str) -> (u16, String, Vec<u8>) {
        let line = line.replace("WORD", &self.word);
        let headers: String = headers.iter().map(|h| format!("{h}\r\n")).collect();
        let length = body.len();
        self.raw(
            format!("{line} HTTP/1.1\r\n{headers}Content-Length: {length}\r\n\r\n{body}")
                .as_bytes(),
        )
    }

    fn host(&self) -> String {
        format!("Host: {}", self.host)
    }

    fn origin(&self) -> String {
        format!("Origin: http://{}", self.host)
    }

    /// The tag of the file as it is.
    fn tag(&self) -> String {
        let (status, head, _) = self.ask("GET /WORD/file", &[self.host()], "");
        assert_eq!(status, 200);
        head.lines().find_map(|l| l.strip_prefix("ETag: ")).unwrap().to_owned()
    }

    /// The answer to a save over the text with a tag.
    fn save(&self, tag: &str, body: &str) -> (u16, String, Vec<u8>) {
        let of = format!("If-Match: {tag}");
        self.ask("PUT /WORD/file", &[self.host(), self.origin(), of], body)
    }

    fn file(&self) -> String {
        fs::read_to_string(&self.file).unwrap()
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        let _ = self.run.kill();
        let mut said = String::new();
        let _ = self.run.stderr.take().unwrap().read_to_string(&mut said);
        let _ = self.run.wait();
        assert!(!said.contains("panicked"), "{said}");
        let left = fs::read_dir(self.folder.path()).unwrap().count();
        assert!(left <= 2, "{left} files in the folder of the scene and the page");
    }
}

#[test]
fn edit_serves_its_page_to_who_has_the_word_and_names_this_machine() {
    let served = Served::start(Some("{}"));
    assert_eq!(served.word.len(), 32);
    assert_ne!(served.word, Served::start(Some("{}")).word);
    let (status, head, body) = served.ask("GET /WORD/", &[served.host()], "");
    let page = text(&body);
    assert_eq!(status, 200);
    assert!(head.contains("X-Frame-Options: DENY") && head.contains("no-store"), "{head}");
    assert!(page.contains("connect-src 'self'") && !page.contains("connect-src 'none'"), "{page}");
    assert!(page.contains("content=\"a&amp;b.json\" data-lang=\"zh\""), "{page}");
    let port = served.host.rsplit(':').next().unwrap();
    let ok = format!("Host: localhost:{port}");
    assert_eq!(served.ask("GET /WORD/file", &[ok], "").0, 200);
    for (line, headers, due) in [
        ("GET /", vec![served.host()], 404),
        ("GET /WORD", vec![served.host()], 404),
        ("GET /WORDS/", vec![served.host()], 404),
        ("GET /WORD/../file", vec![served.host()], 404),
        ("GET /WORD/other", vec![served.host()], 404),
        ("GET /0123456789abcdef0123456789abcdef/file", vec![served.host()], 404),
        ("GET /WORD/", vec![], 403),
        ("GET /WORD/file", vec!["Host: evil.example".to_owned()], 403),
        ("GET /WORD/file", vec![format!("Host: evil.example:{port}")], 403),
        ("GET /WORD/file", vec!["Host: 127.0.0.1".to_owned()], 403),
        ("GET /WORD/file", vec![served.host(), "Origin: http://evil.example".to_owned()], 403),
        ("GET /WORD/file", vec![served.host(), "Origin: null".to_owned()], 403),
        ("GET /WORD/file", vec![served.host(), served.host()], 400),
        ("POST /WORD/", vec![served.host()], 405),
        ("DELETE /WORD/file", vec![served.host(), served.origin()], 405),
        ("OPTIONS /WORD/file", vec![served.host()], 405),
        ("TRACE /WORD/file", vec![served.host()], 405),
    ] {
        assert_eq!(served.ask(line, &headers, "").0, due, "{line} {headers:?}");
    }
}

#[test]
fn edit_saves_over_the_text_that_the_page_has_seen_and_no_other() {
    let served = Served::start(Some("{\"a\": 1}"));
    let tag = served.tag();
    let known = [served.host(), format!("If-None-Match: {tag}")];
    let (status, _, body) = served.ask("GET /WORD/file", &known, "");
    assert_eq!((status, body.len()), (304, 0));
    let (status, head, _) = served.save(&tag, "{\"a\": 2}\n");
    assert_eq!((status, served.file().as_str()), (204, "{\"a\": 2}\n"));
    let next = served.tag();
    assert!(head.contains(&next) && next != tag, "{head}");
    // Another editor writes; the page does not know it yet.
    fs::write(&served.file, "{\"other\": 3}").unwrap();
    let (status, head, body) = served.save(&next, "mine");
    assert_eq!((status, text(&body).as_str()), (412, "{\"other\": 3}"));
    assert_eq!(served.file(), "{\"other\": 3}");
    assert!(head.contains(&served.tag()), "{head}");
    let (status, ..) = served.save(&served.tag(), "mine");
    assert_eq!((status, served.file().as_str()), (204, "mine"));
    fs::remove_file(&served.file).unwrap();
    assert_eq!(served.tag(), "none");
    assert_eq!(served.save("none", "{}").0, 204);
    assert_eq!(served.file(), "{}");
}

#[test]
fn edit_writes_nothing_for_others_and_nothing_that_is_no_text() {
    let served = Served::start(Some("{}"));
    let tag = format!("If-Match: {}", served.tag());
    let (host, own) = (served.host(), served.origin());
    for (headers, due) in [
        (vec![host.clone(), tag.clone()], 403),
        (vec![host.clone(), tag.clone(), "Origin: http://evil.example".to_owned()], 403),
        (vec![host.clone(), tag.clone(), "Origin: https://localhost".to_owned()], 403),
        (vec![own.clone(), tag.clone(), "Host: evil.example".to_owned()], 403),
        (vec![host.clone(), own.clone()], 428),
        (
            vec![host.clone(), own.clone(), tag.clone(), "Transfer-Encoding: chunked".to_owned()],
            411,
        ),
    ] {
        assert_eq!(served.ask("PUT /WORD/file", &headers, "evil").0, due, "{headers:?}");
    }
    let word = &served.word;
    let head = format!("PUT /{word}/file HTTP/1.1\r\n{host}\r\n{own}\r\n{tag}\r\n");
    let put = |more: &str, body: &[u8]| {
        let bytes = [head.as_bytes(), more.as_bytes(), b"\r\n\r\n", body].concat();
        served.raw(&bytes).0
    };
    assert_eq!(put("Content-Length: 2", &[0xff, 0xfe]), 400);
    assert_eq!(put("Content-Length: -1", b""), 400);
    assert_eq!(put("Content-Length: 99999999999999999999999", b""), 413);
    assert_eq!(put("Content-Length: 16777217", &vec![b' '; 1 << 20]), 413);
    assert_eq!(put(&format!("Cookie: {}", "x".repeat(40_000)), b""), 431);
    assert_eq!(put("Content-Length: 1\r\nContent-Length: 2", b"ab"), 400);
    for nonsense in
        [&b"\r\n\r\n"[..], b"\x16\x03\x01\x02\0\r\n\r\n", b"GET\r\n\r\n", b"PRI * HTTP/2.0\r\n\r\n"]
    {
        assert_eq!(served.raw(nonsense).0, 400, "{nonsense:?}");
    }
    assert_eq!(served.file(), "{}");
    // Bodies up to the limit are taken.
    let large = "x".repeat(3 << 20);
    assert_eq!(served.save(&served.tag(), &large).0, 204);
    assert_eq!(served.file().len(), large.len());
}

#[test]
fn edit_answers_while_others_are_silent() {
    let served = Served::start(Some("{}"));
    let silent: Vec<TcpStream> =
        (0..12).map(|_| TcpStream::connect(&served.host).unwrap()).collect();
    assert_eq!(served.ask("GET /WORD/file", &[served.host()], "").0, 200);
    drop(silent);
    // More than are held at once; the program lives on.
    let many: Vec<TcpStream> =
        (0..100).map(|_| TcpStream::connect(&served.host).unwrap()).collect();
    drop(many);
    std::thread::sleep(std::time::Duration::from_millis(300));
    assert_eq!(served.ask("GET /WORD/file", &[served.host()], "").0, 200);
}

#[test]
fn edit_refuses_what_it_cannot_save_and_says_how_the_page_is_built() {
    let folder = tempfile::tempdir().unwrap();
    let (page, latin) = (folder.path().join("page.html"), folder.path().join("latin.json"));
    fs::write(&page, PAGE).unwrap();
    fs::write(&latin, b"{\"title\": \"\xe9\"}").unwrap();
    let refused = |arguments: &[&str], page: &Path| {
        let run =
            hodograph().args(["edit", "--no-open", "--page"]).arg(page).args(arguments).assert();
        text(&run.code(2).get_output().stderr)
    };
    let absent = folder.path().join("absent.json");
    let absent = absent.to_str().unwrap();
    let said = refused(&[absent], &page);
    assert!(said.contains("cannot-read") && said.contains("--new"), "{said}");
    for file in ["-", latin.to_str().unwrap()] {
        let said = refused(&[file], &page);
        assert!(said.contains("cannot-edit"), "{said}");
    }
    let said = refused(&["templates/shaper.json"], Path::new("Cargo.toml"));
    assert!(said.contains("no-page") && said.contains("npm run build"), "{said}");
    let other = folder.path().join("none.html");
    assert!(refused(&["templates/shaper.json"], &other).contains("cannot-read"));
    // A port that is taken.
    let taken = std::net::TcpListener::bind(("127.0.0.1", 0)).unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    let said = refused(&["templates/shaper.json", "--port", &port], &page);
    assert!(said.contains("no-port"), "{said}");
}

#[test]
fn a_live_lesson_is_the_page_with_the_scene_inside() {
    use base64::{Engine as _, prelude::BASE64_STANDARD};
    let folder = tempfile::tempdir().unwrap();
    let (page, out) = (folder.path().join("page.html"), folder.path().join("lesson.html"));
    fs::write(&page, PAGE).unwrap();
    let lesson = |more: &[&str]| {
        let mut run = hodograph();
        run.args(["lesson", "templates/crank-rocker.json", "--live", "--page"]).arg(&page);
        run.arg("-o").arg(&out).args(more).assert()
    };
    lesson(&["--set", "l_AB=90", "--lang", "zh"]).success();
    let told = fs::read_to_string(&out).unwrap();
    let (_, rest) = told.split_once("<meta name=\"hodograph-lesson\" content=\"").unwrap();
    let (scene, rest) = rest.split_once('"').unwrap();
    assert!(rest.starts_with(" data-lang=\"zh\">"), "{told}");
    let scene = text(&BASE64_STANDARD.decode(scene).unwrap());
    let set = hodograph().args(["new", "crank-rocker", "--set", "l_AB=90"]).assert().success();
    assert_eq!(scene, text(&set.get_output().stdout));
    // It connects to nothing.
    assert_eq!(
        told.replace(
            &told[told.find("\n<meta name=").unwrap()..told.find("\n<meta content").unwrap()],
            ""
        ),
        PAGE
    );
    for other in [&["--method", "centres"][..], &["--reveal"], &["--style", "dark"]] {
        lesson(other).code(2);
    }
    fs::write(&page, "<html><body></body></html>").unwrap();
    assert!(text(&lesson(&[]).code(2).get_output().stderr).contains("no-page"));
}

#[cfg(unix)]
#[test]
fn edit_ends_with_success_when_it_is_asked_to() {
    let mut served = Served::start(None);
    assert_eq!(served.save("none", "{}").0, 204);
    let id = served.run.id().to_string();
    assert!(Command::new("kill").args(["-INT", &id]).status().unwrap().success());
    assert_eq!(served.run.wait().unwrap().code(), Some(0));
    assert_eq!(served.file(), "{}");
}
