//! An installed Chromium, driven over a pipe by its own protocol
//! (<https://chromedevtools.github.io/devtools-protocol/>): real pointers and keys, and all that
//! it complains about.

use std::env;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{ChildStdin, ChildStdout, Command, Stdio};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use tempfile::TempDir;

use crate::common::child::Started;

/// After which a browser counts as hung, and is ended.
const LIMIT: Duration = Duration::from_secs(60);

/// How long a page may take to come to a state.
const PATIENCE: Duration = Duration::from_secs(20);

/// A browser with one page. It ends with its owner.
#[derive(Debug)]
pub struct Browser {
    input: ChildStdin,
    output: BufReader<ChildStdout>,
    /// Before the profile, which the browser writes to.
    _watch: Watch,
    _profile: TempDir,
    session: Option<String>,
    next: u64,
    /// Errors, warnings, and requests to anywhere.
    pub complaints: Vec<String>,
    loaded: bool,
}

/// The browser on the path, by the names that distributions give it.
pub fn installed() -> Option<String> {
    let names = ["chromium", "chromium-browser", "google-chrome"];
    let path = env::var_os("PATH")?;
    let found =
        |name: &&str| env::split_paths(&path).any(|directory| directory.join(name).is_file());
    names.into_iter().find(found).map(str::to_owned)
}

impl Browser {
    /// Starts it, with an empty page.
    pub fn start(program: &str) -> Self {
        let profile = tempfile::tempdir().expect("a directory for the profile");
        let mut child = spawn(program, profile.path());
        let input = child.stdin.take().expect("a pipe to the browser");
        let output = BufReader::new(child.stdout.take().expect("a pipe from the browser"));
        let mut browser = Self {
            input,
            output,
            _watch: Watch::over(child),
            _profile: profile,
            session: None,
            next: 0,
            complaints: Vec::new(),
            loaded: false,
        };
        let target = browser.call("Target.createTarget", json!({"url": "about:blank"}));
        let attach = json!({"targetId": target["targetId"], "flatten": true});
        let session = browser.call("Target.attachToTarget", attach);
        browser.session = session["sessionId"].as_str().map(str::to_owned);
        for domain in ["Page", "Runtime", "Log", "Network"] {
            browser.call(&format!("{domain}.enable"), json!({}));
        }
        browser
    }

    /// The size of the view, in pixels of the page.
    pub fn resize(&mut self, [width, height]: [u32; 2]) {
        let metrics = json!({"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600});
        self.call("Emulation.setDeviceMetricsOverride", metrics);
    }

    /// Whether it has fingers.
    pub fn touch(&mut self, enabled: bool) {
        self.call("Emulation.setTouchEmulationEnabled", json!({"enabled": enabled}));
    }

    /// Opens a file and waits until it is loaded and its scripts have run.
    pub fn open(&mut self, file: &Path) {
        self.loaded = false;
        self.call("Page.navigate", json!({"url": format!("file://{}", file.display())}));
        while !self.loaded {
            let message = self.receive();
            self.note(&message);
        }
    }

    /// The value of a JavaScript expression; a promise is waited for.
    pub fn value(&mut self, expression: &str) -> Value {
        let asked = json!({"expression": expression, "returnByValue": true, "awaitPromise": true});
        let answer = self.call("Runtime.evaluate", asked);
        let failure = &answer["exceptionDetails"];
        assert!(failure.is_null(), "{expression}: {failure}");
        answer["result"]["value"].clone()
    }

    /// A text that an expression gives.
    pub fn text(&mut self, expression: &str) -> String {
        let value = self.value(expression);
        value.as_str().unwrap_or_else(|| panic!("{expression} is {value}, not a text")).to_owned()
    }

    /// A number that an expression gives.
    pub fn number(&mut self, expression: &str) -> f64 {
        let value = self.value(expression);
        value.as_f64().unwrap_or_else(|| panic!("{expression} is {value}, not a number"))
    }

    /// Waits until an expression is true.
    pub fn until(&mut self, expression: &str) {
        let start = Instant::now();
        while self.value(expression) != json!(true) {
            assert!(start.elapsed() < PATIENCE, "never true: {expression}; {:?}", self.complaints);
            thread::sleep(Duration::from_millis(20));
        }
    }

    /// The middle of an element, scrolled into view.
    pub fn middle(&mut self, selector: &str) -> [f64; 2] {
        let middle = self.value(&format!(
            "(() => {{ const element = document.querySelector({selector:?});
              element.scrollIntoView({{block: 'center', inline: 'nearest'}});
              const box = element.getBoundingClientRect();
              return [box.x + box.width / 2, box.y + box.height / 2]; }})()"
        ));
        [0, 1].map(|axis| middle[axis].as_f64().expect("an element has a place"))
    }

    /// Moves the pointer.
    pub fn point(&mut self, place: [f64; 2]) {
        self.mouse("mouseMoved", place, false);
    }

    /// Clicks with the left button.
    pub fn click(&mut self, place: [f64; 2]) {
        self.drag(place, place);
    }

    /// Drags with the left button.
    pub fn drag(&mut self, from: [f64; 2], to: [f64; 2]) {
        self.point(from);
        self.mouse("mousePressed", from, true);
        if from != to {
            self.mouse("mouseMoved", to, true);
        }
        self.mouse("mouseReleased", to, true);
    }

    fn mouse(&mut self, kind: &str, [x, y]: [f64; 2], held: bool) {
        let (button, buttons) = if held { ("left", 1) } else { ("none", 0) };
        let event = json!({"type": kind, "x": x, "y": y, "button": button, "buttons": buttons,
                           "clickCount": u8::from(kind != "mouseMoved")});
        self.call("Input.dispatchMouseEvent", event);
    }

    /// Presses and lets go of a key that is named as in `KeyboardEvent.key`.
    pub fn key(&mut self, key: &str) {
        let code = match key {
            "Enter" => 13,
            "ArrowLeft" => 37,
            "ArrowUp" => 38,
            "ArrowRight" => 39,
            "ArrowDown" => 40,
            _ => 0,
        };
        let text = if key == "Enter" { "\r" } else { "" };
        for kind in ["keyDown", "keyUp"] {
            let event = json!({"type": kind, "key": key, "code": key, "text": text,
                               "windowsVirtualKeyCode": code});
            self.call("Input.dispatchKeyEvent", event);
        }
    }

    /// Chooses an option of a `<select>`, or sets a slider, as users do.
    pub fn set(&mut self, selector: &str, value: &str) {
        self.value(&format!(
            "(() => {{ const control = document.querySelector({selector:?});
              control.value = {value:?};
              for (const kind of ['input', 'change'])
                control.dispatchEvent(new Event(kind, {{bubbles: true}})); }})()"
        ));
    }

    /// Calls a method of the protocol.
    pub fn call(&mut self, method: &str, parameters: Value) -> Value {
        self.next += 1;
        let mut message = json!({"id": self.next, "method": method, "params": parameters});
        if let Some(session) = &self.session {
            message["sessionId"] = json!(session);
        }
        let sent = self.input.write_all(format!("{message}\0").as_bytes());
        sent.expect("the browser listens");
        loop {
            let message = self.receive();
            if message["id"] == json!(self.next) {
                assert!(message["error"].is_null(), "{method}: {message}");
                return message["result"].clone();
            }
            self.note(&message);
        }
    }

    fn receive(&mut self) -> Value {
        let mut message = Vec::new();
        self.output.read_until(0, &mut message).expect("the browser answers");
        assert_eq!(message.pop(), Some(0), "the browser ended, or was ended after {LIMIT:?}");
        serde_json::from_slice(&message).expect("JSON from the browser")
    }

    fn note(&mut self, message: &Value) {
        let parameters = &message["params"];
        let method = message["method"].as_str().unwrap_or_default();
        let is_bad = match method {
            "Page.loadEventFired" => {
                self.loaded = true;
                false
            }
            "Runtime.exceptionThrown" => true,
            "Runtime.consoleAPICalled" => {
                ["error", "warning", "assert"].iter().any(|kind| parameters["type"] == *kind)
            }
            "Log.entryAdded" => {
                ["error", "warning"].iter().any(|level| parameters["entry"]["level"] == *level)
            }
            "Network.requestWillBeSent" => {
                let address = parameters["request"]["url"].as_str().unwrap_or_default();
                !["file:", "data:", "blob:"].iter().any(|scheme| address.starts_with(scheme))
            }
            _ => false,
        };
        if is_bad {
            self.complaints.push(message.to_string());
        }
    }
}

/// The protocol is on file descriptors 3 and 4, which a shell makes of its own input and output.
fn spawn(program: &str, profile: &Path) -> Started {
    let mut shell = Command::new("sh");
    shell
        .args(["-c", "exec \"$0\" \"$@\" 3<&0 4>&1 </dev/null >/dev/null", program])
        .args(["--headless=new", "--remote-debugging-pipe", "--no-sandbox", "--disable-gpu"])
        .args(["--no-first-run", "--disable-background-networking", "--disable-extensions"])
        .args(["--disable-dev-shm-usage", "--hide-scrollbars", "--force-color-profile=srgb"])
        .arg(format!("--user-data-dir={}", profile.display()))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null());
    Started::of(&mut shell)
}

/// Ends the browser when it is dropped, or when the time is over.
#[derive(Debug)]
struct Watch {
    alive: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl Watch {
    fn over(browser: Started) -> Self {
        let (alive, ended) = mpsc::channel();
        let thread = thread::spawn(move || {
            if ended.recv_timeout(LIMIT) == Err(RecvTimeoutError::Timeout) {
                eprintln!("the browser hangs; it is ended");
            }
            drop(browser);
        });
        Self { alive: Some(alive), thread: Some(thread) }
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        drop(self.alive.take());
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}
