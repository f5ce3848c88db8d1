//! docs/scene.md holds the keys that a scene has, and no others.

use std::collections::BTreeSet;
use std::path::Path;

use pendular::capillary::AnyCapillary;
use pendular::lubrication::{NormalModel, TangentialModel};
use pendular::transfer::AnyRupture;
use serde::de::DeserializeOwned;

use crate::scene::*;

const PAGE: &str = include_str!("../../../docs/scene.md");
/// No key of anything.
const NONE: &str = "no_key_at_all";

/// What stands in backticks in serde's message about an unknown key or word, but that itself.
fn known(message: &str) -> BTreeSet<String> {
    let quoted = message.split('`').skip(1).step_by(2);
    quoted.filter(|word| *word != NONE).map(str::to_owned).collect()
}

/// All keys of a table, as serde lists them for one that it does not know.
pub(crate) fn keys_of<T: DeserializeOwned>(before: &str) -> BTreeSet<String> {
    let text = format!("{before}\n{NONE} = 1\n");
    let error = toml::from_str::<T>(&text).err().map(|e| e.message().to_owned());
    known(&error.unwrap())
}

fn words_of<T: DeserializeOwned>() -> BTreeSet<String> {
    let error = toml::Value::from(NONE).try_into::<T>().err();
    known(error.unwrap().message())
}

/// The part of the page under a heading or, in it, after a line.
fn under(heading: &str, line: &str) -> &'static str {
    let (_, after) = PAGE.split_once(&format!("\n## {heading}\n")).unwrap();
    let section = after.split("\n## ").next().unwrap();
    let (_, rest) = section.split_once(line).unwrap();
    rest
}

/// The keys in the first column of the first table of keys in a text.
fn listed(text: &str) -> BTreeSet<String> {
    let (_, table) = text.split_once("| key | type, unit |").unwrap();
    let rows = table.lines().skip(2).take_while(|line| line.starts_with("| `"));
    rows.map(|row| row.split('`').nth(1).unwrap().to_owned()).collect()
}

/// The page lists exactly the keys of `T` under a heading.
pub(crate) fn same<T: DeserializeOwned>(heading: &str, before: &str, line: &str) {
    let keys = keys_of::<T>(before);
    assert!(keys.len() > 1, "{heading}: serde lists {keys:?}");
    // The tag decides which struct it is; it has a table of its own.
    let keys: BTreeSet<_> = keys.into_iter().filter(|key| key != "from").collect();
    assert_eq!(listed(under(heading, line)), keys, "{heading} {line}");
}

#[test]
fn every_key_of_a_scene_is_listed_and_no_other() {
    same::<Scene>("Top level", "", "");
    same::<Material>("`[materials.NAME]`", "", "");
    same::<ContactPair>("`[[contacts]]`", "", "");
    same::<ContactLaw>("`[contact]`", "", "");
    same::<SizeClass>("`[[classes]]`", "", "");
    same::<Screen>("`[screen]`", "", "");
    same::<ScreenMotion>("`[motion]`", "", "");
    same::<HarmonicTerm>("`[[motion.terms]]`", "", "");
    same::<Housing>("`[housing]`", "", "");
    same::<PartFile>("`[[parts]]`", "", "");
    same::<LiquidSpec>("`[liquid]`", "", "");
    same::<GuardSpec>("`[guard]`", "", "");
    same::<Packing>("`[packing]`", "from = \"bin\"", "With `from = \"bin\"`");
    same::<Packing>("`[packing]`", "from = \"random\"", "With `from = \"random\"`");
    let file = listed(under("`[packing]`", "With `from = \"file\"`"));
    assert_eq!(keys_of::<Packing>("from = \"file\""), file);
}

#[test]
fn every_name_that_a_key_takes_is_listed() {
    let holds = |heading: &str, names: &[String]| {
        let section = under(heading, "");
        for name in names {
            assert!(section.contains(&format!("`{name}`")), "{heading}: {name}");
        }
    };
    let plain = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
    holds("`[liquid]`", &plain(&AnyCapillary::ALL.map(|law| law.name())));
    for names in [NormalModel::NAMES, TangentialModel::NAMES, &AnyRupture::NAMES] {
        holds("`[liquid]`", &plain(names));
    }
    let quoted = |words: BTreeSet<String>| -> Vec<String> {
        assert!(words.len() > 1, "{words:?}");
        words.into_iter().map(|word| format!("\"{word}\"")).collect()
    };
    holds("`[liquid]`", &quoted(words_of::<Drag>()));
    holds("`[liquid]`", &quoted(words_of::<DynamicRupture>()));
    holds("`[liquid]`", &quoted(words_of::<Transfer>()));
    holds("`[liquid]`", &quoted(words_of::<OutsideRange>()));
    holds("`[guard]`", &quoted(words_of::<Escapes>()));
    holds("`[screen]`", &quoted(words_of::<WireKind>()));
    let forms = keys_of::<Packing>("from = \"no_key_at_all\"");
    holds("`[packing]`", &quoted(forms));
}

#[test]
fn the_examples_are_scenes() {
    let demo = crate::builtin::find("demo").unwrap();
    let mut tried = 0;
    for block in PAGE.split("```toml\n").skip(1) {
        let block: toml::Table = block.split("```").next().unwrap().parse().unwrap();
        if block.contains_key("scene") {
            continue;
        }
        let mut scene: toml::Table = demo.parse().unwrap();
        scene.extend(block);
        // What the demo assumes about a motion or a screen may not be in the new one.
        scene.remove("assumed");
        Scene::parse(&scene.to_string(), Path::new("docs/scene.md")).unwrap();
        tried += 1;
    }
    assert_eq!(tried, 2);
}
