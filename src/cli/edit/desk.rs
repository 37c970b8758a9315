//! The answers of `hodograph edit`: its page, and the one file that the page reads and writes.
//!
//! Three checks keep others away. The path begins with a random word, which only the page knows.
//! The `Host` is this machine by number or by name, so that no name of another site that leads here
//! is accepted (DNS rebinding). An `Origin`, which a write must have, is the page's own.

use super::super::Failure;
use super::super::files::{read_now, write};
use super::http::{Request, Response};
use crate::diag::Both;
use std::hash::{DefaultHasher, Hasher as _};
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The tag of a file that does not exist.
const ABSENT: &str = "none";

/// A file on the desk of a page.
pub struct Desk {
    file: PathBuf,
    page: Vec<u8>,
    /// Path of the page: `/` and the random word.
    root: String,
    hosts: [String; 2],
    writing: Mutex<()>,
}

impl Desk {
    /// Returns the desk of a file with a page under a random word, at a port of this machine.
    pub fn new(file: PathBuf, page: Vec<u8>, word: &str, port: u16) -> Desk {
        let hosts = ["127.0.0.1", "localhost"].map(|name| match port {
            // Browsers leave out the port of HTTP.
            80 => name.to_owned(),
            _ => format!("{name}:{port}"),
        });
        Desk { file, page, root: format!("/{word}"), hosts, writing: Mutex::default() }
    }

    /// Returns the address of the page.
    pub fn address(&self) -> String {
        format!("http://{}{}/", self.hosts[0], self.root)
    }

    /// Prevents writing while the guard is held.
    pub fn at_rest(&self) -> MutexGuard<'_, ()> {
        self.writing.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Answers a request.
    pub fn answer(&self, request: &Request) -> Response {
        let here = |host: &str| self.hosts.iter().any(|h| h == host);
        let own = |origin: &str| origin.strip_prefix("http://").is_some_and(here);
        if !request.header("host").is_some_and(here) || !request.header("origin").is_none_or(own) {
            return Response::empty("403 Forbidden");
        }
        let method = request.method.as_str();
        match request.path.strip_prefix(&self.root) {
            Some("/") if method == "GET" => Response::new("200 OK", "text/html", self.page.clone()),
            Some("/") => Response::empty("405 Method Not Allowed").with("Allow", "GET"),
            Some("/file") if method == "GET" => self.read(request),
            Some("/file") if method == "PUT" => self.save(request),
            Some("/file") => Response::empty("405 Method Not Allowed").with("Allow", "GET, PUT"),
            _ => Response::empty("404 Not Found"),
        }
    }

    /// Answers a reading: the file, or nothing if the page has it.
    fn read(&self, request: &Request) -> Response {
        match self.now() {
            Ok((tag, _)) if request.header("if-none-match") == Some(tag.as_str()) => {
                Response::empty("304 Not Modified").with("ETag", tag)
            }
            Ok((tag, text)) => Response::new("200 OK", "text/plain", text).with("ETag", tag),
            Err(why) => failed(&why),
        }
    }

    /// Answers a save of the page's text in place of the text whose tag it names.
    fn save(&self, request: &Request) -> Response {
        if request.header("origin").is_none() {
            return Response::empty("403 Forbidden");
        }
        if std::str::from_utf8(&request.body).is_err() {
            return Response::empty("400 Bad Request");
        }
        let Some(of) = request.header("if-match") else {
            return Response::empty("428 Precondition Required");
        };
        let _writing = self.at_rest();
        match self.now() {
            Ok((tag, text)) if tag != of => {
                Response::new("412 Precondition Failed", "text/plain", text).with("ETag", tag)
            }
            Ok(_) => match write(&self.file, &request.body) {
                Ok(()) => Response::empty("204 No Content").with("ETag", tag(&request.body)),
                Err(Failure::Output(why) | Failure::Interrupted(why)) => failed(&why),
                Err(Failure::Input(all)) => {
                    let first = all.iter().find_map(|f| f.faults.list.first());
                    failed(&first.map_or(Both::default(), |d| d.message.clone()))
                }
            },
            Err(why) => failed(&why),
        }
    }

    /// Returns the file's tag and its bytes; a file that is not there is empty.
    fn now(&self) -> Result<(String, Vec<u8>), Both> {
        match read_now(&self.file) {
            Ok(Some(bytes)) => Ok((tag(&bytes), bytes)),
            Ok(None) => Ok((ABSENT.to_owned(), Vec::new())),
            Err(d) => Err(d.message),
        }
    }
}

/// A failure of this machine, in both languages.
fn failed(why: &Both) -> Response {
    let body = why.json().to_string().into_bytes();
    Response::new("500 Internal Server Error", "application/json", body)
}

/// A tag of a file's content, as in `ETag`.
fn tag(bytes: &[u8]) -> String {
    let mut sum = DefaultHasher::new();
    sum.write(bytes);
    format!("\"{:016x}\"", sum.finish())
}
