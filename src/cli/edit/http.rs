//! The part of HTTP/1.1 that one page on one machine needs (RFC 9112): a request with its body, one
//! response, and the end of the connection.
//!
//! Sizes and times are bounded. A head that is not plain is refused: two headers of one name, blanks
//! before a colon, a body in chunks.

use std::io::{self, Read, Write};
use std::net::{Shutdown, TcpStream};
use std::time::{Duration, Instant};

/// Largest head (bytes).
const LARGEST_HEAD: usize = 16 << 10;
/// Time for a request, and time for its response.
const PATIENCE: Duration = Duration::from_secs(20);
/// Time in which the rest of a refused request is thrown away, so that its sender reads the refusal.
const LEFTOVERS: Duration = Duration::from_secs(1);

/// A request.
#[derive(Debug)]
pub struct Request {
    pub method: String,
    /// Path of the target, without a query.
    pub path: String,
    headers: Vec<(String, String)>,
    pub body: Vec<u8>,
}

impl Request {
    /// Returns a header by its name in lower case.
    pub fn header(&self, name: &str) -> Option<&str> {
        self.headers.iter().find(|(n, _)| n == name).map(|(_, value)| value.as_str())
    }

    /// Reads a request with at most this many bytes of body.
    ///
    /// # Errors
    /// A refusal for the client; `None` if it is gone or too slow.
    pub fn read(stream: &mut TcpStream, largest_body: u64) -> Result<Request, Option<Response>> {
        let until = Instant::now() + PATIENCE;
        let (head, mut body) = head(stream, until)?;
        let mut request = parsed(&head).ok_or(Some(Response::empty("400 Bad Request")))?;
        if request.header("transfer-encoding").is_some() {
            return Err(Some(Response::empty("411 Length Required")));
        }
        let length = match request.header("content-length") {
            None => 0,
            Some(digits) if digits.bytes().all(|b| b.is_ascii_digit()) && !digits.is_empty() => {
                // More digits than a number has are too many bytes.
                digits.parse().unwrap_or(u64::MAX)
            }
            Some(_) => return Err(Some(Response::empty("400 Bad Request"))),
        };
        if length > largest_body {
            return Err(Some(Response::empty("413 Content Too Large")));
        }
        let length = usize::try_from(length).unwrap_or(usize::MAX);
        while body.len() < length {
            more(stream, &mut body, until)?;
        }
        body.truncate(length);
        request.body = body;
        Ok(request)
    }
}

/// Reads up to the empty line; returns the head, and what has come of the body.
fn head(stream: &mut TcpStream, until: Instant) -> Result<(Vec<u8>, Vec<u8>), Option<Response>> {
    let mut bytes = Vec::new();
    let mut seen: usize = 0;
    loop {
        // The mark may begin in the bytes that were there before.
        let from = seen.saturating_sub(3);
        if let Some(at) = bytes[from..].windows(4).position(|w| w == b"\r\n\r\n") {
            let body = bytes.split_off(from + at + 4);
            bytes.truncate(from + at);
            return Ok((bytes, body));
        }
        if bytes.len() > LARGEST_HEAD {
            return Err(Some(Response::empty("431 Request Header Fields Too Large")));
        }
        seen = bytes.len();
        more(stream, &mut bytes, until)?;
    }
}

/// Reads the bytes that are there, and waits for some if there are none.
fn more(
    stream: &mut TcpStream,
    bytes: &mut Vec<u8>,
    until: Instant,
) -> Result<(), Option<Response>> {
    let left = until.saturating_duration_since(Instant::now());
    if left.is_zero() || stream.set_read_timeout(Some(left)).is_err() {
        return Err(None);
    }
    let mut piece = [0; 8 << 10];
    match stream.read(&mut piece) {
        Ok(count) if count > 0 => bytes.extend_from_slice(&piece[..count]),
        Err(e) if e.kind() == io::ErrorKind::Interrupted => {}
        Ok(_) | Err(_) => return Err(None),
    }
    Ok(())
}

/// Returns the request of a head, without its body.
fn parsed(head: &[u8]) -> Option<Request> {
    let mut lines = std::str::from_utf8(head).ok()?.split("\r\n");
    let mut words = lines.next()?.split(' ');
    let (method, target, version) = (words.next()?, words.next()?, words.next()?);
    if words.next().is_some() || !version.starts_with("HTTP/1.") || !target.starts_with('/') {
        return None;
    }
    let mut headers: Vec<(String, String)> = Vec::new();
    for line in lines {
        let (name, value) = line.split_once(':')?;
        let name = name.to_ascii_lowercase();
        let plain = |b: u8| b.is_ascii_alphanumeric() || b == b'-' || b == b'_';
        if name.is_empty() || !name.bytes().all(plain) || headers.iter().any(|(n, _)| *n == name) {
            return None;
        }
        headers.push((name, value.trim().to_owned()));
    }
    let path = target.split('?').next().unwrap_or(target).to_owned();
    Some(Request { method: method.to_owned(), path, headers, body: Vec::new() })
}

/// A response.
#[derive(Debug)]
pub struct Response {
    status: &'static str,
    headers: Vec<(&'static str, String)>,
    body: Vec<u8>,
}

impl Response {
    /// Returns a response of a status, which is also the body of a refusal.
    pub fn empty(status: &'static str) -> Response {
        let refused = status.starts_with('4');
        let body = if refused { format!("{status}\n") } else { String::new() };
        Response::new(status, "text/plain", body.into_bytes())
    }

    /// Returns a response with a body of a type, in UTF-8.
    pub fn new(status: &'static str, kind: &str, body: Vec<u8>) -> Response {
        let kind = ("Content-Type", format!("{kind}; charset=utf-8"));
        Response { status, headers: vec![kind], body }
    }

    /// Returns the response with a further header.
    pub fn with(mut self, name: &'static str, value: impl Into<String>) -> Response {
        self.headers.push((name, value.into()));
        self
    }

    /// Sends the response and ends the connection.
    pub fn send(&self, stream: &mut TcpStream) -> io::Result<()> {
        let mut head = format!("HTTP/1.1 {}\r\n", self.status);
        // No other page may frame this one or read from it, and no cache may keep it.
        head.push_str(
            "Connection: close\r\nCache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\n\
             X-Frame-Options: DENY\r\nReferrer-Policy: no-referrer\r\n\
             Cross-Origin-Resource-Policy: same-origin\r\n",
        );
        // These have no content, and so no length (RFC 9110, 8.6).
        if !["204", "304"].iter().any(|s| self.status.starts_with(s)) {
            head += &format!("Content-Length: {}\r\n", self.body.len());
        }
        for (name, value) in &self.headers {
            head += &format!("{name}: {value}\r\n");
        }
        head.push_str("\r\n");
        stream.set_write_timeout(Some(PATIENCE))?;
        stream.write_all(head.as_bytes())?;
        stream.write_all(&self.body)?;
        stream.shutdown(Shutdown::Write)?;
        let until = Instant::now() + LEFTOVERS;
        let mut rest = Vec::new();
        // It ends with the client's end of the connection.
        while more(stream, &mut rest, until).is_ok() {
            rest.clear();
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_head_is_plain_or_refused() {
        let read = |head: &str| parsed(head.as_bytes());
        let request = read("GET /a/b?c HTTP/1.1\r\nHost: x:1\r\nOrigin:  y ").unwrap();
        assert_eq!((request.method.as_str(), request.path.as_str()), ("GET", "/a/b"));
        assert_eq!((request.header("host"), request.header("origin")), (Some("x:1"), Some("y")));
        for wrong in [
            "",
            "GET /",
            "GET  / HTTP/1.1",
            "GET / HTTP/2",
            "GET http://x/ HTTP/1.1",
            "GET / HTTP/1.1\r\nHost: a\r\nhost: b",
            "GET / HTTP/1.1\r\nHost : a",
            "GET / HTTP/1.1\r\nHost: a\r\n folded",
            "GET / HTTP/1.1\r\nnothing",
        ] {
            assert!(read(wrong).is_none(), "{wrong}");
        }
    }
}
