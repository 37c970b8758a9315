//! `hodograph edit`: the page (`web`) on this machine, with one file that it reads and saves.

mod desk;
mod http;

use super::target::is_stream;
use super::{CommandResult, Failure, args, files, lang, stop};
use crate::diag::{Diagnostic, both};
use crate::scene::Lang;
use desk::Desk;
use http::{Request, Response};
use std::io;
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

/// The page in one file, as `npm run build` writes it.
#[cfg(feature = "page")]
const BUILT_IN: Option<&[u8]> = Some(include_bytes!("../../../web/dist/hodograph.html"));
#[cfg(not(feature = "page"))]
const BUILT_IN: Option<&[u8]> = None;

/// Most connections at a time: a browser opens six to one server.
const CONNECTIONS: usize = 32;
/// Time between two looks for a request to stop.
const PAUSE: Duration = Duration::from_millis(50);
/// The rule for connections of the page's script, in the single file and here.
const CONNECT: [&str; 2] = ["connect-src 'none'", "connect-src 'self'"];
const CHARSET: &str = "<meta charset=\"utf-8\">";

/// Runs the command.
pub fn run(a: args::EditArgs) -> CommandResult {
    let file = PathBuf::from(&a.scene);
    let fault = |d: Diagnostic| Failure::input(d, &a.scene, "");
    if is_stream(&a.scene) {
        let d = Diagnostic::error(
            "cannot-edit",
            both!("{} is not a file that can be saved", "{} 不是可保存的文件", a.scene),
        );
        return Err(fault(d.help(both!("name a file", "请指定文件"))));
    }
    match files::read_now(&file).map_err(fault)? {
        Some(bytes) if std::str::from_utf8(&bytes).is_err() => {
            let d = Diagnostic::error(
                "cannot-edit",
                both!("{} is not UTF-8 text", "{} 不是 UTF-8 文本", a.scene),
            );
            let help = both!(
                "save the file as UTF-8: the page would lose the letters that it cannot read",
                "请将文件存为 UTF-8：页面会丢失不能识别的字符"
            );
            return Err(fault(d.help(help)));
        }
        None if !a.new => {
            let missing = io::ErrorKind::NotFound.into();
            let help = both!(
                "`hodograph new crank-rocker -o {0}` writes a first scene, `hodograph edit {0} --new` begins with an empty one",
                "`hodograph new crank-rocker -o {0}` 生成一个机构文件，`hodograph edit {0} --new` 从空白的机构文件开始",
                a.scene
            );
            return Err(fault(files::unreadable(&file, &missing).help(help)));
        }
        Some(_) | None => {}
    }
    let page = page(a.page.as_deref(), &a.scene)?;
    let port = a.port.to_string();
    let no_port = |e: io::Error| {
        let d = Diagnostic::error(
            "no-port",
            both!("port {} cannot be used: {}", "不能使用端口 {}：{}", port, files::reason(&e)),
        );
        let help = both!("without --port a free one is taken", "不写 --port 时自动选用空闲端口");
        Failure::argument("--port", &port, d.help(help))
    };
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, a.port)).map_err(no_port)?;
    // The loop looks up between two connections.
    listener.set_nonblocking(true).map_err(no_port)?;
    let word = word().map_err(no_port)?;
    let port = listener.local_addr().map_err(no_port)?.port();
    let desk = Arc::new(Desk::new(file, page, &word, port));
    stop::watch();
    let address = desk.address();
    let end = both!("Ctrl-C ends", "按 Ctrl-C 结束");
    files::print(&format!("{address}\n{}: {}\n", a.scene, lang::of(&end)))?;
    if !a.no_open {
        open(&address);
    }
    serve(&listener, &desk);
    Ok(ExitCode::SUCCESS)
}

/// Answers requests until the user asks to stop.
fn serve(listener: &TcpListener, desk: &Arc<Desk>) {
    let _looking = stop::Looking::begin();
    let open = Arc::new(AtomicUsize::new(0));
    while !stop::asked() {
        match listener.accept() {
            Ok((mut stream, _)) => {
                let before = open.fetch_add(1, Ordering::AcqRel);
                let one = OpenConnection(Arc::clone(&open));
                // The kind of the listener is taken over on some systems.
                if before >= CONNECTIONS || stream.set_nonblocking(false).is_err() {
                    continue;
                }
                let desk = Arc::clone(desk);
                // Without a free thread the connection ends.
                let _ = thread::Builder::new().spawn(move || {
                    let _one = one;
                    converse(&mut stream, &desk);
                });
            }
            Err(_) => thread::sleep(PAUSE),
        }
    }
    // A save in progress ends first.
    drop(desk.at_rest());
}

/// A connection that is counted as long as it is open.
struct OpenConnection(Arc<AtomicUsize>);

impl Drop for OpenConnection {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::AcqRel);
    }
}

fn converse(stream: &mut TcpStream, desk: &Desk) {
    let answer = match Request::read(stream, files::LARGEST) {
        Ok(request) => desk.answer(&request),
        Err(Some(refusal)) => refusal,
        Err(None) => return,
    };
    // A client that is gone needs no answer.
    let _: io::Result<()> = Response::send(&answer, stream);
}

/// A word of 128 random bits for the address.
fn word() -> io::Result<String> {
    let mut bytes = [0; 16];
    getrandom::fill(&mut bytes).map_err(io::Error::other)?;
    Ok(bytes.iter().map(|b| format!("{b:02x}")).collect())
}

/// Returns the page of a file: the named one, the one in the program, or one near the program.
fn page(named: Option<&str>, scene: &str) -> Result<Vec<u8>, Failure> {
    let read = |path: &Path| {
        std::fs::read_to_string(path).map_err(|e| {
            let help = both!("name the page, hodograph.html", "请指定页面文件 hodograph.html");
            files::unreadable(path, &e).help(help)
        })
    };
    let text = match (named, BUILT_IN) {
        (Some(path), _) => {
            read(Path::new(path)).map_err(|d| Failure::argument("--page", path, d))?
        }
        (None, Some(bytes)) => String::from_utf8_lossy(bytes).into_owned(),
        (None, None) => near().iter().find_map(|path| read(path).ok()).ok_or_else(|| {
            let d = Diagnostic::error(
                "no-page",
                both!("the page is not built", "页面尚未构建"),
            );
            let help = both!(
                "`npm ci` and `npm run engine && npm run build` in the folder web build it; --page FILE names one that is elsewhere",
                "在 web 文件夹中运行 `npm ci` 和 `npm run engine && npm run build` 即可构建；--page FILE 指定其他位置的页面"
            );
            Failure::input(d.help(help), "", "")
        })?,
    };
    served(&text, scene).ok_or_else(|| {
        let d = Diagnostic::error(
            "no-page",
            both!("this is not the page of hodograph in one file", "这不是 hodograph 的单文件页面"),
        );
        let help = both!(
            "`npm run build` in the folder web writes it to dist/hodograph.html",
            "在 web 文件夹中运行 `npm run build`，得到 dist/hodograph.html"
        );
        Failure::argument("--page", named.unwrap_or_default(), d.help(help))
    })
}

/// Places of the page near the program: beside it, and in the checkout in whose folder `target` it
/// is.
fn near() -> Vec<PathBuf> {
    let Ok(program) = std::env::current_exe() else { return Vec::new() };
    let beside = program.parent().map(|folder| folder.join("hodograph.html"));
    let above = program.ancestors().skip(1).take(4);
    beside.into_iter().chain(above.map(|up| up.join("web/dist/hodograph.html"))).collect()
}

/// Returns the page for a file: its script may connect to this server, and knows the file's name
/// and the language that the user asks for. `None` if the text is not the page.
fn served(page: &str, scene: &str) -> Option<Vec<u8>> {
    let (head, body) = page.split_once("<body>")?;
    if !head.contains(CONNECT[0]) || !head.contains(CHARSET) {
        return None;
    }
    let name = Path::new(scene).file_name()?.to_string_lossy().into_owned();
    let name = name.replace('&', "&amp;").replace('"', "&quot;").replace('<', "&lt;");
    let lang = lang::asked().map_or("", |l| match l {
        Lang::En => "en",
        Lang::Zh => "zh",
    });
    let known = format!(
        "{CHARSET}\n<meta name=\"hodograph-file\" content=\"{name}\" data-lang=\"{lang}\">"
    );
    let head = head.replacen(CHARSET, &known, 1).replacen(CONNECT[0], CONNECT[1], 1);
    Some(format!("{head}<body>{body}").into_bytes())
}

/// Opens an address in the user's browser; a machine without one still has the printed address.
fn open(address: &str) {
    let mut command = if cfg!(windows) {
        let mut shell = Command::new("cmd");
        shell.args(["/C", "start", ""]);
        shell
    } else if cfg!(target_os = "macos") {
        Command::new("open")
    } else {
        Command::new("xdg-open")
    };
    command.arg(address).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    if let Ok(mut child) = command.spawn() {
        thread::spawn(move || child.wait());
    }
}
