//! Words on stdout and stderr that are no reason to fail: whoever read along may have gone, as
//! `head` does when it has its lines.

use std::fmt::Arguments;
use std::io::Write;

/// A line on stdout.
pub(crate) fn line(words: Arguments<'_>) {
    let _ = writeln!(std::io::stdout(), "{words}");
}

/// A text on stdout, its line ends its own.
pub(crate) fn text(words: &str) {
    let _ = write!(std::io::stdout(), "{words}");
}

/// A line on stderr.
pub(crate) fn note(words: Arguments<'_>) {
    let _ = writeln!(std::io::stderr(), "{words}");
}
