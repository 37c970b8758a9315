//! A Chromium controlled over the DevTools protocol: JSON messages, each ended by a zero byte, on
//! two named pipes that the browser has as its descriptors 3 and 4.

use serde_json::{Value, json};
use std::collections::VecDeque;
use std::fs::File;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};

/// Longest response time of the browser: a busy machine starts it in seconds.
const PATIENCE: Duration = Duration::from_secs(60);

/// A browser with one page.
pub struct Browser {
    child: Child,
    to: File,
    from: Receiver<Value>,
    next: u64,
    session: String,
    /// Events since the last look.
    events: VecDeque<Value>,
    /// Pipes and profile; removed at the end.
    _folder: tempfile::TempDir,
}

/// The browser on this machine: `$CHROMIUM`, or one of the usual names on the path.
pub fn found() -> Option<PathBuf> {
    if let Some(named) = std::env::var_os("CHROMIUM") {
        return Some(PathBuf::from(named)).filter(|p| p.is_file());
    }
    let path = std::env::var_os("PATH")?;
    let names = ["chromium", "chromium-browser", "google-chrome"];
    names
        .iter()
        .flat_map(|n| std::env::split_paths(&path).map(move |p| p.join(n)))
        .find(|p| p.is_file())
}

impl Browser {
    /// Starts a browser with an empty page.
    pub fn start(program: &Path) -> Browser {
        let folder = tempfile::tempdir().unwrap();
        let [to, from] = ["to", "from"].map(|n| folder.path().join(n));
        assert!(Command::new("mkfifo").args([&to, &from]).status().unwrap().success());
        // The shell opens the pipes in the order in which this side does.
        let line = r#"exec 3<"$1" 4>"$2"; shift 2; exec "$@""#;
        let child = Command::new("sh")
            .args(["-c", line, "sh"])
            .args([&to, &from])
            .arg(program)
            .args([
                "--headless",
                "--no-sandbox",
                "--disable-gpu",
                "--disable-quic",
                "--no-first-run",
                "--disable-background-networking",
            ])
            .args([
                "--disable-component-update",
                "--disable-sync",
                "--disable-dev-shm-usage",
                "--remote-debugging-pipe",
            ])
            .arg(format!("--user-data-dir={}", folder.path().join("profile").display()))
            .arg("about:blank")
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let writer = File::options().write(true).open(&to).unwrap();
        let mut reader = File::open(&from).unwrap();
        let (send, receive) = channel();
        std::thread::spawn(move || {
            let (mut rest, mut buffer) = (Vec::new(), vec![0; 1 << 16]);
            while let Ok(n) = reader.read(&mut buffer) {
                if n == 0 {
                    return;
                }
                rest.extend_from_slice(&buffer[..n]);
                while let Some(end) = rest.iter().position(|b| *b == 0) {
                    let message: Vec<u8> = rest.drain(..=end).collect();
                    let Ok(value) = serde_json::from_slice(&message[..end]) else { return };
                    if send.send(value).is_err() {
                        return;
                    }
                }
            }
        });
        let mut browser = Browser {
            child,
            to: writer,
            from: receive,
            next: 0,
            session: String::new(),
            events: VecDeque::new(),
            _folder: folder,
        };
        let target =
            browser.call("Target.createTarget", json!({"url": "about:blank"}))["targetId"].clone();
        let attached =
            browser.call("Target.attachToTarget", json!({"targetId": target, "flatten": true}));
        browser.session = attached["sessionId"].as_str().unwrap().to_owned();
        for domain in ["Page", "Runtime", "Network", "Log"] {
            browser.call(&format!("{domain}.enable"), json!({}));
        }
        browser
    }

    /// Calls a method and waits for its result.
    pub fn call(&mut self, method: &str, params: Value) -> Value {
        self.next += 1;
        let id = self.next;
        let mut message = json!({"id": id, "method": method, "params": params});
        if !self.session.is_empty() {
            message["sessionId"] = json!(self.session);
        }
        let mut bytes = message.to_string().into_bytes();
        bytes.push(0);
        self.to.write_all(&bytes).unwrap();
        let answer =
            self.until(|m| m["id"] == id).unwrap_or_else(|| panic!("no answer to {method}"));
        assert!(answer.get("error").is_none(), "{method}: {answer}");
        answer["result"].clone()
    }

    /// Waits for a message; all others are kept.
    fn until(&mut self, wanted: impl Fn(&Value) -> bool) -> Option<Value> {
        let end = Instant::now() + PATIENCE;
        loop {
            match self.from.recv_timeout(end.saturating_duration_since(Instant::now())) {
                Ok(m) if wanted(&m) => return Some(m),
                Ok(m) => self.events.push_back(m),
                Err(RecvTimeoutError::Timeout | RecvTimeoutError::Disconnected) => return None,
            }
        }
    }

    /// Opens a file in a window of this size and waits until it has loaded.
    pub fn open(&mut self, file: &Path, [width, height]: [u32; 2]) {
        let size =
            json!({"width": width, "height": height, "deviceScaleFactor": 1, "mobile": false});
        self.call("Emulation.setDeviceMetricsOverride", size);
        self.events.clear();
        self.call("Page.navigate", json!({"url": format!("file://{}", file.display())}));
        let loaded = |m: &Value| m["method"] == "Page.loadEventFired";
        if !self.events.iter().any(loaded) {
            let event = self.until(loaded).expect("the page loads");
            self.events.push_back(event);
        }
        // A lesson opens its data and reports when it is ready.
        let ready = "new Promise((done) => { const look = () => document.documentElement.dataset.ready === '' ? done() : setTimeout(look, 10); look(); })";
        self.eval(ready);
    }

    /// The value of an expression in the page.
    pub fn eval(&mut self, expression: &str) -> Value {
        let params = json!({"expression": expression, "returnByValue": true, "awaitPromise": true});
        let result = self.call("Runtime.evaluate", params);
        assert!(result.get("exceptionDetails").is_none(), "{expression}: {result}");
        result["result"]["value"].clone()
    }

    /// Presses and releases a key.
    pub fn key(&mut self, key: &str) {
        self.key_with(key, 0);
    }

    /// Presses and releases a key with modifiers (1 Alt, 2 Ctrl, 8 Shift).
    pub fn key_with(&mut self, key: &str, modifiers: u32) {
        let code = match key {
            "ArrowLeft" => 37,
            "ArrowUp" => 38,
            "ArrowRight" => 39,
            "ArrowDown" => 40,
            "Tab" => 9,
            "Enter" => 13,
            " " => 32,
            "Home" => 36,
            "End" => 35,
            "PageUp" => 33,
            "PageDown" => 34,
            k => u32::from(k.chars().next().unwrap().to_ascii_uppercase()),
        };
        let text = match key {
            "Enter" => Some("\r"),
            k if k.chars().count() == 1 => Some(k),
            _ => None,
        };
        let mut down = json!({"type": "keyDown", "key": key, "windowsVirtualKeyCode": code, "modifiers": modifiers});
        if let Some(text) = text {
            down["text"] = json!(text);
        }
        self.call("Input.dispatchKeyEvent", down);
        self.call("Input.dispatchKeyEvent", json!({"type": "keyUp", "key": key, "windowsVirtualKeyCode": code, "modifiers": modifiers}));
    }

    /// Sends a mouse event at a place of the window.
    pub fn mouse(&mut self, kind: &str, [x, y]: [f64; 2]) {
        let buttons = u32::from(kind != "mouseReleased");
        let params = json!({"type": kind, "x": x, "y": y, "button": "left", "buttons": buttons, "clickCount": 1});
        self.call("Input.dispatchMouseEvent", params);
    }

    /// Returns the addresses requested since the page was opened, and the messages of the console.
    pub fn asked_and_said(&self) -> (Vec<String>, Vec<String>) {
        let text = |v: &Value| v.as_str().unwrap_or_default().to_owned();
        let of = |method: &'static str| self.events.iter().filter(move |m| m["method"] == method);
        let asked =
            of("Network.requestWillBeSent").map(|m| text(&m["params"]["request"]["url"])).collect();
        let said = of("Runtime.consoleAPICalled").map(|m| m["params"]["args"].to_string());
        let thrown =
            of("Runtime.exceptionThrown").map(|m| m["params"]["exceptionDetails"].to_string());
        let logged = of("Log.entryAdded").map(|m| m["params"]["entry"].to_string());
        (asked, said.chain(thrown).chain(logged).collect())
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        // The browser closes its own children; if it does not respond, it is killed.
        let _ = self.to.write_all(b"{\"id\":0,\"method\":\"Browser.close\"}\0");
        let end = Instant::now() + Duration::from_secs(5);
        while Instant::now() < end && matches!(self.child.try_wait(), Ok(None)) {
            std::thread::sleep(Duration::from_millis(20));
        }
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
