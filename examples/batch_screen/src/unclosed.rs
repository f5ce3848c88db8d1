//! Brackets of a TOML text that are never closed. A parser only notices further on, where something
//! stands that cannot be inside of them, and points there.

/// A bracket that is never closed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Unclosed {
    /// Its byte in the text.
    pub(crate) at: usize,
    /// `{` or `[`.
    bracket: u8,
}

impl Unclosed {
    /// What begins with it.
    pub(crate) fn name(self) -> &'static str {
        if self.bracket == b'{' { "inline table" } else { "list" }
    }

    /// What would close it.
    pub(crate) fn closes(self) -> char {
        if self.bracket == b'{' { '}' } else { ']' }
    }
}

/// The first bracket in a value of a document that is never closed, or not by its own kind.
pub(crate) fn in_document(text: &str) -> Option<Unclosed> {
    find(text, true)
}

/// The same in a single value.
pub(crate) fn in_value(text: &str) -> Option<Unclosed> {
    find(text, false)
}

fn find(text: &str, tables: bool) -> Option<Unclosed> {
    let bytes = text.as_bytes();
    let mut open: Vec<Unclosed> = Vec::new();
    let mut at = 0;
    while let Some(&byte) = bytes.get(at) {
        match byte {
            b'#' => at = line_end(bytes, at),
            // In a text that does not end there is no telling what is a bracket.
            b'"' | b'\'' => at = string_end(bytes, at)?,
            // The name of a table, which ends with its line.
            b'[' if tables && open.is_empty() && begins_line(bytes, at) => at = line_end(bytes, at),
            b'{' | b'[' => open.push(Unclosed { at, bracket: byte }),
            b'}' | b']' => {
                let last = open.pop()?;
                if last.closes() != char::from(byte) {
                    return Some(last);
                }
            }
            _ => {}
        }
        at += 1;
    }
    open.first().copied()
}

fn line_end(bytes: &[u8], from: usize) -> usize {
    let length = bytes[from..].iter().position(|&byte| byte == b'\n');
    length.map_or(bytes.len(), |length| from + length)
}

fn begins_line(bytes: &[u8], at: usize) -> bool {
    let before = bytes[..at].iter().rev().take_while(|&&byte| byte != b'\n');
    before.into_iter().all(u8::is_ascii_whitespace)
}

/// Where the text that begins at `from` ends; one of a single line ends on it.
fn string_end(bytes: &[u8], from: usize) -> Option<usize> {
    let quote = bytes[from];
    let long = [quote; 3];
    let lines = bytes[from..].starts_with(&long);
    let mut at = from + if lines { 3 } else { 1 };
    while let Some(&byte) = bytes.get(at) {
        match byte {
            b'\n' if !lines => return None,
            b'\\' if quote == b'"' && bytes.get(at + 1) != Some(&b'\n') => at += 1,
            _ if lines && bytes[at..].starts_with(&long) => return Some(at + 2),
            _ if !lines && byte == quote => return Some(at),
            _ => {}
        }
        at += 1;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brackets_that_are_never_closed_are_found_where_they_begin() {
        for (text, wanted) in [
            ("a = { b = 1\nc = 2\n[t]\nd = [1, 2]\n", "{ b"),
            ("a = [1,\nb = [2, 3]\n", "[1"),
            ("a = [ { x = 1 }, { y = [1, 2 } ]\n", "[1, 2 "),
            ("[t]\na = 1 # {\nb = \"[ \\\" [\"\nc = { d = '}'\n", "{ d"),
            ("a = \"\"\"\n[ { \"\"\"\nb = [\n", "[\n"),
            ("a = \"é\"\nb = {\n", "{\n"),
        ] {
            let found = in_document(text).unwrap();
            assert!(text[found.at..].starts_with(wanted), "{text}: {found:?}");
        }
    }

    #[test]
    fn a_value_begins_no_table() {
        assert_eq!(in_value("[1, 2").map(|open| open.at), Some(0));
        assert_eq!(in_value("[1, 2]"), None);
    }

    #[test]
    fn what_is_closed_or_no_value_is_left_alone() {
        for text in [
            "",
            "[t]\na = [1, { b = 2 },\n]\n[[l]]\n",
            "[t\na = 1\n",
            "a = }\n",
            "a = \"[\nb = 1\n",
            "a = [\"x, 2]\nb = 1\n",
            "a = [\"x\\\nb = 1]\n",
            "a = '{' # [\n",
        ] {
            assert_eq!(in_document(text), None, "{text}");
        }
    }
}
