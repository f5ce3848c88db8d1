//! Which parts of a scene are tables and which are lists of tables: one pair of brackets too many or
//! too few is told as that, not as a value of a wrong type somewhere inside.

use toml::{Table, Value};

use crate::error::SceneError;
use crate::place::Origin;

const TABLES: [&str; 7] = ["contact", "guard", "housing", "liquid", "motion", "packing", "screen"];
const LISTS: [&str; 4] = ["classes", "contacts", "motion.terms", "parts"];

/// Checks the brackets of a scene.
pub(crate) fn check(document: &Table, origin: &Origin) -> Result<(), SceneError> {
    let wrong = |key: &str, written: String, allowed: String| {
        let message = format!("{written} is not allowed; allowed: {allowed}");
        Err(SceneError::Syntax { place: origin.place(key), key: key.to_owned(), message })
    };
    let materials = document.get("materials").and_then(Value::as_table);
    let materials = materials.into_iter().flat_map(|all| all.keys());
    let tables = TABLES.map(str::to_owned).into_iter();
    for key in tables.chain(materials.map(|name| format!("materials.{name}"))) {
        if let Some(Value::Array(_)) = at(document, &key) {
            return wrong(&key, format!("a list, `[[{key}]]`,"), format!("one table, `[{key}]`"));
        }
    }
    for key in LISTS {
        if let Some(Value::Table(_)) = at(document, key) {
            let allowed = format!("`[[{key}]]`, for each entry of the list");
            return wrong(key, format!("a single table, `[{key}]`,"), allowed);
        }
    }
    Ok(())
}

/// A value one table deep at most; the name of a material may itself hold dots.
fn at<'t>(document: &'t Table, key: &str) -> Option<&'t Value> {
    match key.split_once('.') {
        None => document.get(key),
        Some((table, name)) => document.get(table)?.get(name),
    }
}
