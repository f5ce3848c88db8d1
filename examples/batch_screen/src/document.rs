//! TOML documents, and values set in them from outside.

use std::path::Path;

use serde::de::DeserializeOwned;
use toml::{Table, Value};

use crate::error::SceneError;
use crate::place::{Origin, Place, column_at, line_at};
use crate::unclosed::{self, Unclosed};

/// The text of a file; where it is none, the line from which on it is none.
pub(crate) fn decode(bytes: Vec<u8>, file: &Path) -> Result<String, SceneError> {
    // UTF-16 and binary files may be UTF-8 by their bytes, but no text has a zero in it.
    let valid = std::str::from_utf8(&bytes).map_or_else(|e| e.valid_up_to(), str::len);
    let end = bytes.iter().position(|&b| b == 0).unwrap_or(valid).min(valid);
    if end == bytes.len() {
        return Ok(String::from_utf8(bytes).unwrap_or_default());
    }
    let line = Some(bytes[..end].iter().filter(|&&b| b == b'\n').count() + 1);
    Err(SceneError::NotText { place: Place { file: file.to_path_buf(), line } })
}

/// Reads a document; what is wrong is named by key and place.
pub(crate) fn read<T: DeserializeOwned>(text: &str, origin: &Origin) -> Result<T, SceneError> {
    let document = toml::Deserializer::parse(text).map_err(|e| syntax(text, origin, &e))?;
    serde_path_to_error::deserialize(document).map_err(|e| {
        let message = e.inner().message().trim_end();
        let key = key_of(&e.path().to_string(), message);
        let of_words = ["wanted string or table", "variant identifier"];
        let message = match of_words.iter().any(|end| message.ends_with(end)) {
            true => words_of::<T>(text, &key),
            false => plain(message),
        };
        SceneError::Syntax { place: origin.place(&key), key, message }
    })
}

/// What is said of a value that should be one of a few words.
fn words_of<T: DeserializeOwned>(text: &str, key: &str) -> String {
    let words = allowed_words::<T>(text, key).unwrap_or_else(|| "a text".into());
    format!("invalid type; allowed: {words}")
}

/// The words that a key takes: what is said of one that it does not know.
fn allowed_words<T: DeserializeOwned>(text: &str, key: &str) -> Option<String> {
    let mut root = Value::Table(text.parse().ok()?);
    let (value, place) = (Value::String("?".into()), Place::option(""));
    put(&mut root, &Set { key: key.to_owned(), value, place }).ok()?;
    let message = plain(T::deserialize(root).err()?.message());
    Some(message.strip_prefix("unknown variant `?`; allowed: ")?.trim_end().to_owned())
}

fn syntax(text: &str, origin: &Origin, error: &toml::de::Error) -> SceneError {
    let (at, what) = wrong(error, unclosed::in_document(text));
    let mut place = origin.place("");
    place.line = Some(line_at(text, at));
    let source = text.lines().nth(line_at(text, at) - 1).unwrap_or_default();
    let key = source.split('=').next().unwrap_or_default().trim().to_owned();
    let twice = error.message().starts_with("duplicate key");
    if let Some(table) = twice.then(|| single(source)).flatten() {
        let message = format!(
            "`[{table}]` is there twice; allowed: once, or `[[{table}]]` for each entry of a list"
        );
        return SceneError::Syntax { place, key: table.to_owned(), message };
    }
    SceneError::Syntax { place, key, message: format!("column {}: {what}", column_at(text, at)) }
}

/// The name in a line that begins a single table.
fn single(line: &str) -> Option<&str> {
    let name = line.trim().strip_prefix('[')?.split(']').next()?.trim();
    (!name.starts_with('[')).then_some(name)
}

/// From which byte on a text is no TOML, and what is wrong there. A bracket that is never closed is
/// told where it begins: the parser gets on to another line before it stumbles.
fn wrong(error: &toml::de::Error, open: Option<Unclosed>) -> (usize, String) {
    let at = error.span().map_or(0, |span| span.start);
    match open.filter(|open| open.at <= at) {
        Some(open) => {
            let (name, closes) = (open.name(), open.closes());
            let what = format!(
                "the {name} that begins here is not closed; allowed: a `{closes}` at its end"
            );
            (open.at, what)
        }
        None => (at, format!("{}; allowed: TOML", error.message().trim_end())),
    }
}

/// The key that is meant: a table's error names the field only in its message.
fn key_of(path: &str, message: &str) -> String {
    let field = ["unknown field `", "missing field `", "duplicate field `"]
        .iter()
        .find_map(|start| message.strip_prefix(start)?.split('`').next());
    match (path, field) {
        (".", Some(field)) => field.to_owned(),
        (path, Some(field)) if !path.ends_with(field) => format!("{path}.{field}"),
        (path, _) => path.to_owned(),
    }
}

/// A message of serde in the words of scene files.
fn plain(message: &str) -> String {
    let message = message.replace(", expected one of ", "; allowed: ");
    let message = message.replace(", expected ", "; allowed: ");
    let types = [
        ("allowed: f64", "allowed: a number"),
        ("allowed: u64", "allowed: a whole number from 0"),
        ("allowed: u32", "allowed: a whole number from 0"),
        ("allowed: a string", "allowed: a text"),
        ("allowed: path string", "allowed: a text"),
        ("allowed: a boolean", "allowed: true or false"),
        ("allowed: an array of length", "allowed: a list of"),
        ("allowed: a sequence", "allowed: a list"),
        ("allowed: a map", "allowed: a table"),
        ("allowed: internally tagged enum Packing", "allowed: a table with the key `from`"),
    ];
    let told = types.iter().fold(message, |m, (from, to)| m.replace(from, to));
    let told = no_type_names(&told);
    if told == "floating-point number overflowed" {
        return format!("{told}; allowed: a number up to {:e}", f64::MAX);
    }
    if told.ends_with(" value was too large") {
        return format!("the number is too large; allowed: a whole number up to {}", i64::MAX);
    }
    if told.starts_with("missing field") {
        format!("{told}; allowed: a value for it")
    } else {
        told
    }
}

/// Types have names in the program only: a `struct Screen` is a table.
fn no_type_names(message: &str) -> String {
    match message.split_once("allowed: struct ") {
        Some((before, name)) => {
            let rest = name.trim_start_matches(|c: char| c.is_alphanumeric() || c == '_');
            format!("{before}allowed: a table{}", rest.trim_start_matches(" with 1 element"))
        }
        None => message.to_owned(),
    }
}

/// A value that takes the place of a document's.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Set {
    /// Dotted key, such as `liquid.viscosity` or `classes[0].count`.
    pub(crate) key: String,
    pub(crate) value: Value,
    /// Where it was said.
    pub(crate) place: Place,
}

impl Set {
    /// Reads `KEY=VALUE` of the command line; a word that is no TOML is a text.
    pub(crate) fn parse(argument: &str) -> Result<Self, SceneError> {
        let place = Place::option("--set");
        let (key, value) = argument.split_once('=').unwrap_or((argument, ""));
        let (key, value) = (key.trim().to_owned(), value.trim());
        for (part, missing) in [(key.as_str(), "key"), (value, "value")] {
            if part.is_empty() {
                return Err(SceneError::SetForm { argument: argument.to_owned(), missing });
            }
        }
        let value = match value.parse() {
            Ok(value) => value,
            // What begins like this was meant to be TOML.
            Err(error) if value.starts_with(['{', '[', '"', '\'']) => {
                let (at, what) = wrong(&error, unclosed::in_value(value));
                let message = format!("`{value}`, column {}: {what}", column_at(value, at));
                return Err(SceneError::Syntax { place, key, message });
            }
            Err(_) => Value::String(value.to_owned()),
        };
        Ok(Self { key, value, place })
    }
}

/// The text of a document with values set in it.
pub(crate) fn with(text: &str, origin: &mut Origin, sets: &[Set]) -> Result<String, SceneError> {
    if sets.is_empty() {
        return Ok(text.to_owned());
    }
    let mut root = Value::Table(read::<Table>(text, origin)?);
    for set in sets {
        put(&mut root, set)?;
        origin.give(&set.key, set.place.clone());
    }
    forget_assumed(&mut root, sets);
    let unwritable = |e: toml::ser::Error| SceneError::Syntax {
        place: origin.place(""),
        key: ".".into(),
        message: e.to_string(),
    };
    toml::to_string(&root).map_err(unwritable)
}

/// A table that was given anew may lack keys whose values the document assumed.
fn forget_assumed(root: &mut Value, sets: &[Set]) {
    let Some(table) = root.as_table().cloned() else { return };
    let Some(Value::Array(assumed)) = root.get_mut("assumed") else { return };
    let in_a_set = |key: &str| {
        let mut keys = sets.iter().map(|set| set.key.as_str());
        keys.any(|set| key.strip_prefix(set).is_some_and(|rest| rest.starts_with(['.', '['])))
    };
    assumed
        .retain(|key| key.as_str().is_none_or(|key| find(&table, key).is_some() || !in_a_set(key)));
}

/// The value of a key such as `classes[0].density`.
pub(crate) fn find<'t>(table: &'t Table, key: &str) -> Option<&'t Value> {
    let spaced = key.replace('[', ".[");
    let mut steps = spaced.split('.');
    let mut at = table.get(steps.next()?)?;
    for step in steps {
        at = match step.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')) {
            Some(index) => at.as_array()?.get(index.parse::<usize>().ok()?)?,
            None => at.as_table()?.get(step)?,
        };
    }
    Some(at)
}

fn put(root: &mut Value, set: &Set) -> Result<(), SceneError> {
    let mut at = root;
    for step in set.key.replace('[', ".[").split('.') {
        at = inside(at, step).map_err(|allowed| SceneError::Value {
            place: set.place.clone(),
            key: set.key.clone(),
            value: format!("`{step}`"),
            allowed,
        })?;
    }
    *at = set.value.clone();
    Ok(())
}

/// What a step of a key leads to, or what it could have been.
fn inside<'v>(at: &'v mut Value, step: &str) -> Result<&'v mut Value, String> {
    let index = step.strip_prefix('[').and_then(|s| s.strip_suffix(']'));
    match (at, index) {
        (Value::Array(list), index) => {
            let allowed = format!("an index in brackets, below {}", list.len());
            let index = index.and_then(|text| text.parse::<usize>().ok());
            index.and_then(|k| list.get_mut(k)).ok_or(allowed)
        }
        (Value::Table(table), index) => {
            if index.is_some() || step.is_empty() {
                return Err(table.keys().cloned().collect::<Vec<_>>().join(", "));
            }
            Ok(table.entry(step).or_insert_with(|| Value::Table(Table::new())))
        }
        _ => Err("nothing: this is a single value".into()),
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    const TEXT: &str = "a = 1\n[t]\nb = \"x\"\n[[l]]\nc = 1\n[[l]]\nc = 2\n";

    fn set(arguments: &[&str]) -> Result<Table, SceneError> {
        let sets: Vec<Set> =
            arguments.iter().map(|a| Set::parse(a)).collect::<Result<_, SceneError>>()?;
        let mut origin = Origin::new(Path::new("a.toml"), TEXT);
        let text = with(TEXT, &mut origin, &sets)?;
        Ok(text.parse().unwrap())
    }

    #[test]
    fn values_are_set_by_dotted_key() {
        let table = set(&["t.b=lambert", "l[1].c=[1, 2.5]", "t.new.deep=true", "a=1e-3"]).unwrap();
        assert_eq!(table["t"]["b"].as_str(), Some("lambert"));
        assert_eq!(table["l"][1]["c"][1].as_float(), Some(2.5));
        assert_eq!(table["l"][0]["c"].as_integer(), Some(1));
        assert_eq!(table["t"]["new"]["deep"].as_bool(), Some(true));
        assert_eq!(table["a"].as_float(), Some(1e-3));
    }

    #[test]
    fn a_table_given_anew_takes_what_was_assumed_in_it_along() {
        let text =
            "assumed = [\"t.b\", \"a\", \"t.typo\", \"l[0].c\"]\na = 1\n[t]\nb = 2\n[[l]]\nc = 1\n";
        let assumed = |arguments: &[&str]| {
            let sets: Vec<Set> = arguments.iter().map(|a| Set::parse(a).unwrap()).collect();
            let mut origin = Origin::new(Path::new("a.toml"), text);
            let table: Table = with(text, &mut origin, &sets).unwrap().parse().unwrap();
            table["assumed"].as_array().unwrap().len()
        };
        // A key that was never there stays, to be refused.
        assert_eq!(assumed(&["t.b=3"]), 4);
        assert_eq!(assumed(&["t={x=1}"]), 2);
        assert_eq!(assumed(&["t={b=1}"]), 3);
        assert_eq!(assumed(&["l=[]"]), 3);
    }

    #[test]
    fn a_table_that_is_there_twice_may_have_been_meant_as_a_list() {
        let text = "a = 1\n[l]\nb = 1\n[l]\nb = 2\n";
        let said = read::<Table>(text, &Origin::new(Path::new("a.toml"), text)).unwrap_err();
        let wanted = "a.toml, line 4: key `l`: `[l]` is there twice; allowed: once, or `[[l]]` for";
        assert!(said.to_string().starts_with(wanted), "{said}");
    }

    #[test]
    fn what_cannot_be_set_says_why() {
        for (argument, wanted) in [
            ("a", "`a` has no value; allowed: KEY=VALUE, such as liquid.viscosity=2e-3"),
            ("a=", "`a=` has no value"),
            ("=3", "`=3` has no key"),
            ("t={b=1", "key `t`: `{b=1`, column 1: the inline table that begins here is not"),
            ("t={b=[1, 2}", "column 4: the list that begins here is not closed"),
            ("t=[1, 2", "key `t`: `[1, 2`, column 1: the list that begins here is not closed"),
            ("t={b=1 c=2}", "key `t`: `{b=1 c=2}`, column 7: "),
            ("t.b=\"x", "key `t.b`: `\"x`, column"),
            ("l[2].c=1", "below 2"),
            ("a.b=1", "single value"),
            ("t[0]=1", "allowed: b"),
            ("l.c=1", "below 2"),
        ] {
            let said = set(&[argument]).unwrap_err().to_string();
            assert!(said.contains(wanted) && said.contains("--set"), "{argument}: {said}");
        }
    }
}
