//! Where a value of a scene was given: file and line, or the command line.

use std::fmt;
use std::path::{Path, PathBuf};

use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A file and, where it is known, a line in it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Place {
    pub(crate) file: PathBuf,
    pub(crate) line: Option<usize>,
}

impl Place {
    /// An option of the command line.
    pub(crate) fn option(name: &str) -> Self {
        Self { file: PathBuf::from(format!("command line, {name}")), line: None }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.file.display())?;
        self.line.map_or(Ok(()), |line| write!(f, ", line {line}"))
    }
}

/// Where the values of a scene come from: its text, and whatever was given beside it.
#[derive(Debug, Clone, Default)]
pub(crate) struct Origin {
    file: PathBuf,
    text: String,
    given: Vec<(String, Place)>,
}

impl Origin {
    /// All from one text.
    pub(crate) fn new(file: &Path, text: &str) -> Self {
        Self { file: file.to_path_buf(), text: text.to_owned(), given: Vec::new() }
    }

    /// The same, but that the value of `key` was given at another place.
    pub(crate) fn give(&mut self, key: &str, place: Place) {
        self.given.push((key.to_owned(), place));
    }

    /// Where the value of `key` was given; for one that is not there, the table it should be in.
    pub(crate) fn place(&self, key: &str) -> Place {
        let covers = |(given, _): &&(String, Place)| {
            key.strip_prefix(given.as_str())
                .is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
        };
        if let Some((_, place)) = self.given.iter().rev().find(covers) {
            return place.clone();
        }
        Place { file: self.file.clone(), line: line_of(&self.text, key) }
    }
}

/// Line of a key such as `classes[0].count` in a TOML text; that of the deepest table around it
/// where the key is not there.
pub(crate) fn line_of(text: &str, key: &str) -> Option<usize> {
    let document = DeTable::parse(text).ok()?;
    let offset = in_table(document.get_ref(), key).unwrap_or(0);
    Some(line_at(text, offset))
}

/// Line of a byte of a text.
pub(crate) fn line_at(text: &str, offset: usize) -> usize {
    text.as_bytes().iter().take(offset).filter(|&&b| b == b'\n').count() + 1
}

/// Column of a byte of a text, in characters from 1.
pub(crate) fn column_at(text: &str, offset: usize) -> usize {
    let before = text.get(..offset).unwrap_or_default();
    before.chars().rev().take_while(|&c| c != '\n').count() + 1
}

fn in_table(table: &DeTable<'_>, key: &str) -> Option<usize> {
    // A name may itself hold dots: the longest one that fits is meant.
    let fits = |name: &str| {
        let rest = key.strip_prefix(name)?;
        (rest.is_empty() || rest.starts_with(['.', '['])).then_some(rest)
    };
    let found = table.iter().filter_map(|(name, value)| {
        let rest = fits(name.get_ref())?;
        Some((name, value, rest))
    });
    let (name, value, rest) = found.min_by_key(|(_, _, rest)| rest.len())?;
    Some(in_value(value, rest).unwrap_or(name.span().start))
}

fn in_value(value: &Spanned<DeValue<'_>>, rest: &str) -> Option<usize> {
    if let Some(key) = rest.strip_prefix('.') {
        return in_table(value.get_ref().as_table()?, key);
    }
    let (index, rest) = rest.strip_prefix('[')?.split_once(']')?;
    let element = value.get_ref().as_array()?.get(index.parse::<usize>().ok()?)?;
    Some(in_value(element, rest).unwrap_or(element.span().start))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "\
time = 1.0
[screen]
aperture_mm = 8
[[classes]]
name = \"a\"
[[classes]]
name = \"b\"
shares = [
  1,
  2,
]
[materials.\"x.y\"]
angle = 3
";

    #[test]
    fn lines_of_keys() {
        for (key, line) in [
            ("time", 1),
            ("screen", 2),
            ("screen.aperture_mm", 3),
            ("screen.missing", 2),
            ("classes[0].name", 5),
            ("classes[1]", 6),
            ("classes[1].name", 7),
            ("classes[1].shares[1]", 10),
            ("classes[7].name", 4),
            ("materials.x.y.angle", 13),
            ("nothing", 1),
        ] {
            assert_eq!(line_of(TEXT, key), Some(line), "{key}");
        }
    }

    #[test]
    fn what_was_given_elsewhere_is_named() {
        let mut origin = Origin::new(Path::new("a.toml"), TEXT);
        origin.give("classes[1]", Place::option("--set"));
        assert_eq!(origin.place("classes[1].name").to_string(), "command line, --set");
        assert_eq!(origin.place("classes[0].name").to_string(), "a.toml, line 5");
    }
}
