//! What the program says: results on standard output; errors, notes, logs and the progress bar on standard
//! error. A result that cannot be printed is an error; what standard error does not take is lost, for nobody is
//! left to be told.

use crate::audience::Audience;
use crate::output::cause;
use crate::{Error, Result};
use indicatif::{MultiProgress, ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde::Serialize;
use std::fmt::Display;
use std::io::{self, ErrorKind, IsTerminal, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use tracing_subscriber::EnvFilter;

/// Where output goes, and in which form.
#[derive(Debug, Clone)]
pub struct Console {
    quiet: bool,
    json: bool,
    bars: MultiProgress,
    /// Whether the reader of standard output went away before all was printed.
    unread: Arc<AtomicBool>,
}

impl Console {
    /// `quiet` leaves progress and notes out; `json` is for machines, and quiet too.
    pub fn new(quiet: bool, json: bool) -> Self {
        let bars = MultiProgress::new();
        if quiet || json || !io::stderr().is_terminal() {
            bars.set_draw_target(ProgressDrawTarget::hidden());
        }
        Self { quiet: quiet || json, json, bars, unread: Arc::default() }
    }

    /// Sends log lines to standard error, as many as `RUST_LOG` asks for (default: warnings).
    pub(super) fn start_logging(&self) {
        let bars = self.bars.clone();
        let filter = EnvFilter::try_from_default_env().unwrap_or_else(|_| EnvFilter::new("warn"));
        // A second subscriber (in tests) is not an error: the first goes on.
        let _ = tracing_subscriber::fmt()
            .with_env_filter(filter)
            .with_ansi(io::stderr().is_terminal())
            .with_writer(move || AboveBars { bars: bars.clone() })
            .try_init();
    }

    /// Prints a command's result: its `Display` form, or JSON.
    ///
    /// # Errors
    /// The result cannot be written as JSON, or not to standard output.
    pub fn result(&self, result: &(impl Display + Serialize)) -> Result<()> {
        if self.json {
            let text = serde_json::to_string_pretty(result)
                .map_err(|error| Error::Internal(format!("the result is not JSON: {error}")))?;
            self.print(&format!("{text}\n"))
        } else {
            self.print(&format!("{}\n", result.to_string().trim_end()))
        }
    }

    /// Prints text as it stands. A reader that goes away (`| head`) has seen what it wanted: the command goes on, and
    /// [`Self::unread`] remembers.
    ///
    /// # Errors
    /// Standard output cannot be written.
    pub(super) fn print(&self, text: &str) -> Result<()> {
        match print(text) {
            Err(error) if error.kind() == ErrorKind::BrokenPipe => {
                self.unread.store(true, Ordering::Relaxed);
                Ok(())
            }
            printed => printed.map_err(|error| not_printed(&error)),
        }
    }

    /// Whether the reader of standard output went away before all was printed.
    pub(super) fn unread(&self) -> bool {
        self.unread.load(Ordering::Relaxed)
    }

    /// Prints a line that is good to know.
    pub fn note(&self, text: &str) {
        if !self.quiet {
            self.bars.suspend(|| complain(text));
        }
    }

    /// Prints an error as one line, or as one JSON object.
    pub(super) fn error(&self, error: &Error) {
        self.bars.suspend(|| print_error(&error.to_string(), kind(error), error.exit_code(), self.json));
    }

    /// A progress bar over `steps` steps; hidden where nobody would see it.
    pub fn progress(&self, steps: u64) -> Progress {
        let style = ProgressStyle::with_template("{msg:24} [{bar:40}] {pos}/{len} frames, {eta} left")
            .unwrap_or_else(|_| ProgressStyle::default_bar())
            .progress_chars("=> ");
        Progress(self.bars.add(ProgressBar::new(steps).with_style(style)))
    }
}

/// A progress bar; it goes when dropped.
#[derive(Debug)]
pub struct Progress(ProgressBar);

impl Progress {
    /// Says what is under way, such as a run's name.
    pub fn say(&self, text: &str) {
        self.0.set_message(text.to_owned());
    }

    /// There are `steps` steps in all.
    pub fn set_length(&self, steps: u64) {
        self.0.set_length(steps);
    }

    /// `steps` more are to be done.
    pub fn lengthen(&self, steps: u64) {
        self.0.inc_length(steps);
    }

    /// `steps` steps need not be done.
    pub fn skip(&self, steps: u64) {
        self.0.set_length(self.0.length().unwrap_or(0).saturating_sub(steps));
    }

    /// One step is done.
    pub fn advance(&self) {
        self.0.inc(1);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

/// The bar over the frames that are known to come, with notes above it.
pub struct FrameBar<'a> {
    progress: Progress,
    console: &'a Console,
}

impl<'a> FrameBar<'a> {
    /// No frame is known to come yet.
    pub fn new(console: &'a Console) -> Self {
        Self { progress: console.progress(0), console }
    }
}

impl Audience for FrameBar<'_> {
    fn say(&self, what: &str) {
        self.progress.say(what);
    }

    fn more(&self, frames: u64) {
        self.progress.lengthen(frames);
    }

    fn advance(&self) {
        self.progress.advance();
    }

    fn skip(&self, frames: u64) {
        self.progress.skip(frames);
    }

    fn note(&self, text: &str) {
        self.console.note(text);
    }
}

/// Standard error, with the bars out of the way while a log line is written. It never fails: the subscriber would
/// complain to standard error itself, and panic.
struct AboveBars {
    bars: MultiProgress,
}

impl Write for AboveBars {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let _ = self.bars.suspend(|| io::stderr().write_all(bytes));
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Writes to standard output, all of it.
pub(super) fn print(text: &str) -> io::Result<()> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes())?;
    out.flush()
}

/// What is said where standard output cannot be written.
pub(super) fn not_printed(error: &io::Error) -> Error {
    Error::file("standard output", format!("cannot be written: {}", cause(error)))
}

/// Writes a line to standard error, or nothing where that cannot be written.
pub(super) fn complain(line: &str) {
    let _ = io::stderr().write_all(format!("{line}\n").as_bytes());
}

/// Writes `error: ...` on one line, or `{"error": {...}}`, to standard error.
pub(super) fn print_error(message: &str, kind: &str, exit_code: u8, json: bool) {
    let message = message.lines().map(str::trim).collect::<Vec<_>>().join(" ");
    let line = if json {
        serde_json::json!({ "error": { "kind": kind, "message": message, "exit_code": exit_code } })
            .to_string()
    } else {
        format!("error: {message}")
    };
    complain(&line);
}

fn kind(error: &Error) -> &'static str {
    match error {
        Error::Input(_) => "input",
        Error::File { .. } => "file",
        Error::Device(_) => "device",
        Error::Internal(_) => "internal",
        Error::Failures(_) => "failures",
        Error::Difference(_) => "difference",
        Error::Unfit(_) => "unfit",
        Error::Interrupted(_) => "interrupted",
    }
}
