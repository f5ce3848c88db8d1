//! What a scene assumes: the values of keys that it lists as `assumed`, since no source gives them.

use serde_json::{Value as Json, json};
use toml::Value;

use crate::document::find;
use crate::error::SceneError;
use crate::scene::Scene;

/// Checks that every key that is assumed is one of the scene.
pub(crate) fn check(scene: &Scene) -> Result<(), SceneError> {
    for (k, key) in scene.assumed.iter().enumerate() {
        if find(&scene.document, key).is_none() {
            let allowed = "a key of this scene, such as `screen.diameter_mm`";
            return Err(scene.fail(&format!("assumed[{k}]"), format!("`{key}`"), allowed));
        }
    }
    Ok(())
}

/// Every assumed key with its value; a table gives all keys in it.
pub(crate) fn list(scene: &Scene) -> Vec<(String, Json)> {
    let mut all = Vec::new();
    for key in &scene.assumed {
        // What the command line may give in the scene's place.
        match (key.as_str(), find(&scene.document, key)) {
            ("time", _) => all.push((key.clone(), json!(scene.time))),
            ("time_step", _) => all.push((key.clone(), json!(scene.time_step))),
            ("seed", _) => all.push((key.clone(), json!(scene.seed))),
            (_, Some(value)) => leaves(key, value, &mut all),
            (_, None) => {}
        }
    }
    all
}

fn leaves(key: &str, value: &Value, all: &mut Vec<(String, Json)>) {
    match value {
        Value::Table(table) => {
            table.iter().for_each(|(name, inner)| leaves(&format!("{key}.{name}"), inner, all));
        }
        other => all.push((key.to_owned(), json!(other))),
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    fn scene(assumed: &str) -> Result<Scene, SceneError> {
        let demo = crate::builtin::find("demo").unwrap();
        let (before, after) = demo.split_once("assumed = [").unwrap();
        let (_, after) = after.split_once("]\n").unwrap();
        Scene::parse(&format!("{before}assumed = [{assumed}]\n{after}"), Path::new("s.toml"))
    }

    #[test]
    fn assumed_keys_come_with_their_values_and_tables_with_all_their_keys() {
        let mut scene = scene("\"classes[1].count\", \"housing\", \"seed\"").unwrap();
        scene.seed = 7;
        let list = list(&scene);
        let keys: Vec<&str> = list.iter().map(|(key, _)| key.as_str()).collect();
        let housing = ["material", "outlet_length_mm", "plate_angle_deg", "plate_gap_mm"];
        let housing = housing.map(|name| format!("housing.{name}"));
        assert_eq!(keys[0], "classes[1].count");
        assert_eq!(keys[1..5], housing);
        assert_eq!((&list[0].1, &list[1].1), (&json!(99), &json!("steel")));
        assert_eq!(list[5], ("seed".to_owned(), json!(7)));
    }

    #[test]
    fn a_key_that_is_not_there_is_refused_with_its_line() {
        for wrong in ["screen.diameter", "classes[9].count", "", "seed.x"] {
            let said = scene(&format!("\"seed\", \"{wrong}\"")).unwrap_err().to_string();
            assert!(said.contains("s.toml, line ") && said.contains("assumed[1]"), "{said}");
        }
    }

    #[test]
    fn every_built_in_scene_says_what_it_assumes() {
        for (name, text) in crate::builtin::SCENES {
            let scene = Scene::parse(text, Path::new(name)).unwrap();
            assert_eq!(list(&scene).len(), 8, "{name}");
        }
    }
}
