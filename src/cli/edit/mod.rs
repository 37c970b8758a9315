//! `hodograph edit`: the page (`web`) on this machine, with one file that it reads and saves.

mod desk;
mod http;

use super::page::PageText;
use super::target::is_stream;
use super::{CommandResult, Failure, args, files, lang, stop};
use crate::diag::{Diagnostic, both};
use desk::Desk;
use http::{Request, Response};
use std::io;
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::path::PathBuf;
use std::process::{Command, ExitCode, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

/// Most connections at a time: a browser opens six to one server.
const CONNECTIONS: usize = 32;
/// Time between two looks for a request to stop.
const PAUSE: Duration = Duration::from_millis(50);
/// The rule for connections of the page's script: to this server.
const CONNECT: &str = "connect-src 'self'";

/// Runs the command.
pub fn run(a: args::EditArgs) -> CommandResult {
    let file = PathBuf::from(&a.scene);
    let fault = |d: Diagnostic| Failure::input(d, &a.scene, "");
    if is_stream(&a.scene) {
        let d =
            Diagnostic::error("cannot-edit", both!("{} is not a file that can be saved", a.scene));
        return Err(fault(d.help(both!("name a file"))));
    }
    match files::read_now(&file).map_err(fault)? {
        Some(bytes) if std::str::from_utf8(&bytes).is_err() => {
            let d = Diagnostic::error("cannot-edit", both!("{} is not UTF-8 text", a.scene));
            let help = both!(
                "save the file as UTF-8: the page would lose the letters that it cannot read"
            );
            return Err(fault(d.help(help)));
        }
        None if !a.new => {
            let missing = io::ErrorKind::NotFound.into();
            let help = both!(
                "`hodograph new crank-rocker -o {0}` writes a first scene, `hodograph edit {0} --new` begins with an empty one",
                a.scene
            );
            return Err(fault(files::unreadable(&file, &missing).help(help)));
        }
        Some(_) | None => {}
    }
    let name = file.file_name().map(|name| name.to_string_lossy().into_owned());
    let page = PageText::read(a.page.as_deref())?;
    let page = page.knowing("file", &name.unwrap_or_default(), CONNECT).into_bytes();
    let port = a.port.to_string();
    let no_port = |e: io::Error| {
        let d = Diagnostic::error(
            "no-port",
            both!("port {} cannot be used: {}", port, files::reason(&e)),
        );
        let help = both!("without --port a free one is taken");
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
    let end = both!("Ctrl-C ends");
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
