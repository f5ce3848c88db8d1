//! Words on stdout and stderr that are no reason to fail: whoever read along may have gone, as
//! `head` does when it has its lines.

use std::fmt::Arguments;
use std::io::{ErrorKind, Write};

use crate::error::RunError;

/// A line on stdout.
pub(crate) fn line(words: Arguments<'_>) {
    let _ = writeln!(std::io::stdout(), "{words}");
}

/// A text on stdout, its line ends its own.
pub(crate) fn text(words: &str) {
    let _ = write!(std::io::stdout(), "{words}");
}

/// A text on stdout that is all a command is asked for: a part of it is not done.
pub(crate) fn product(words: &str) -> Result<(), RunError> {
    let mut out = std::io::stdout();
    match out.write_all(words.as_bytes()).and_then(|()| out.flush()) {
        Err(source) if source.kind() != ErrorKind::BrokenPipe => {
            Err(RunError::Write { path: "stdout".into(), source })
        }
        _ => Ok(()),
    }
}

/// A line on stderr.
pub(crate) fn note(words: Arguments<'_>) {
    let _ = writeln!(std::io::stderr(), "{words}");
}
